"""Independent answers to 06-false-sights: right ones, and students' mistakes."""

RIGHT = [
    (
        "06-false-sights",
        "nearest first: best sight taken, all gated anew",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)

    def distance(k):
        j = ids.index(seen[k])
        v = z[k] - h(x[:3], x[3 + 2 * j:5 + 2 * j])
        v[1] = wrap(v[1])
        H = H_full(x, j)
        return v @ np.linalg.inv(H @ P @ H.T + R) @ v

    todo = [k for k, i in enumerate(seen) if i in ids]
    fresh = [k for k, i in enumerate(seen) if i not in ids]
    while todo:
        best = min(todo, key=distance)
        if distance(best) > 12:
            break
        x, P = update(x, P, z[best], ids.index(seen[best]), R)
        todo.remove(best)
    for k in fresh:
        if seen[k] in ids:
            continue
        x, P = augment(x, P, z[k], R)
        ids.append(seen[k])
    return x, P, ids
""",
    ),
    (
        "06-false-sights",
        "gate at 99 %, whitened by Cholesky, own update inline",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = ids.copy()
    for k in range(len(seen)):
        if seen[k] not in ids:
            x, P = augment(x, P, z[k], R)
            ids.append(seen[k])
            continue
        j = ids.index(seen[k])
        H = H_full(x, j)
        L = np.linalg.cholesky(H @ P @ H.T + R)
        v = z[k] - h(x[:3], x[3 + 2 * j:5 + 2 * j])
        v[1] = wrap(v[1])
        w = np.linalg.solve(L, v)
        if w @ w > -2 * np.log(0.005):
            continue
        B = np.linalg.solve(L, H @ P)
        x, P = x + B.T @ w, P - B.T @ B
        x[2] = wrap(x[2])
    return x, P, ids
""",
    ),
]

WRONG = [
    (
        "06-false-sights",
        "slam_step itself",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    return slam_step(x, P, ids, u, seen, z, C, R)
""",
    ),
    (
        "06-false-sights",
        "eyes shut: wheels only",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    return x, P, ids
""",
    ),
    (
        "06-false-sights",
        "first sights only, since those are never false",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
    ),
    (
        "06-false-sights",
        "everything trusted less: R ten times as large",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i in ids:
            x, P = update(x, P, one, ids.index(i), 10 * R)
        else:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
    ),
    (
        "06-false-sights",
        "gate by the sensor's noise alone",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    sigma = np.sqrt(np.diag(R))
    for i, one in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids.append(i)
            continue
        j = ids.index(i)
        v = one - h(x[:3], x[3 + 2 * j:5 + 2 * j])
        v[1] = wrap(v[1])
        if np.all(np.abs(v) < 2 * sigma):
            x, P = update(x, P, one, j, R)
    return x, P, ids
""",
    ),
    (
        "06-false-sights",
        "gate far too tight (d^2 < 1)",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i in ids:
            j = ids.index(i)
            v = one - h(x[:3], x[3 + 2 * j:5 + 2 * j])
            v[1] = wrap(v[1])
            H = H_full(x, j)
            if v @ np.linalg.solve(H @ P @ H.T + R, v) < 1:
                x, P = update(x, P, one, j, R)
        else:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
    ),
    (
        "06-false-sights",
        "bound on the distance, its square forgotten: never rejects",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i in ids:
            j = ids.index(i)
            v = one - h(x[:3], x[3 + 2 * j:5 + 2 * j])
            v[1] = wrap(v[1])
            H = H_full(x, j)
            d = np.sqrt(v @ np.linalg.solve(H @ P @ H.T + R, v))
            if d < 13.8:
                x, P = update(x, P, one, j, R)
        else:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
    ),
    (
        "06-false-sights",
        "gate with S instead of its inverse",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i in ids:
            j = ids.index(i)
            v = one - h(x[:3], x[3 + 2 * j:5 + 2 * j])
            v[1] = wrap(v[1])
            H = H_full(x, j)
            if v @ (H @ P @ H.T + R) @ v < 9.21:
                x, P = update(x, P, one, j, R)
        else:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
    ),
    (
        "06-false-sights",
        "false sight is taken for a landmark that moved: placed anew, the old one forgotten",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        ok = False
        if i in ids:
            j = ids.index(i)
            v = one - h(x[:3], x[3 + 2 * j:5 + 2 * j])
            v[1] = wrap(v[1])
            H = H_full(x, j)
            ok = v @ np.linalg.inv(H @ P @ H.T + R) @ v < 9.21
        if ok:
            x, P = update(x, P, one, j, R)
        else:
            if i in ids:
                ids[ids.index(i)] = -1
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
    ),
    (
        "06-false-sights",
        "looks at the range only",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i in ids:
            j = ids.index(i)
            r = h(x[:3], x[3 + 2 * j:5 + 2 * j])[0]
            if abs(one[0] - r) < 1.0:
                x, P = update(x, P, one, j, R)
        else:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
    ),
    (
        "06-false-sights",
        "rejected sight also leaves the whole step undriven",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    x0, P0, ids0 = x, P, list(ids)
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i in ids:
            j = ids.index(i)
            v = one - h(x[:3], x[3 + 2 * j:5 + 2 * j])
            v[1] = wrap(v[1])
            H = H_full(x, j)
            if v @ np.linalg.inv(H @ P @ H.T + R) @ v > 13.8:
                return x0, P0, ids0
            x, P = update(x, P, one, j, R)
        else:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
    ),
    (
        "06-false-sights",
        "one bad sight throws away the whole scan, new ones too",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    far = []
    for i, one in zip(seen, z):
        if i in ids:
            j = ids.index(i)
            v = one - h(x[:3], x[3 + 2 * j:5 + 2 * j])
            v[1] = wrap(v[1])
            far.append(np.hypot(v[0], v[1]))
    if far and max(far) > 0.3:
        return x, P, ids
    for i, one in zip(seen, z):
        if i in ids:
            x, P = update(x, P, one, ids.index(i), R)
        else:
            x, P = augment(x, P, one, R)
            ids = [*ids, i]
    return x, P, ids
""",
    ),
    (
        "06-false-sights",
        "drops one sight in ten at random",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    rng = np.random.default_rng(len(x))
    for i, one in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids.append(i)
        elif rng.random() > 0.1:
            x, P = update(x, P, one, ids.index(i), R)
    return x, P, ids
""",
    ),
    (
        "06-false-sights",
        "innovation clipped to two sigma of the sensor, then updated as usual",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    bound = 2 * np.sqrt(np.diag(R))
    for i, one in zip(seen, z):
        if i in ids:
            j = ids.index(i)
            expected = h(x[:3], x[3 + 2 * j:5 + 2 * j])
            v = one - expected
            v[1] = wrap(v[1])
            x, P = update(x, P, expected + np.clip(v, -bound, bound), j, R)
        else:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
    ),
    (
        "06-false-sights",
        "gate without absolute value: whatever is too near or too far right passes",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids.append(i)
            continue
        j = ids.index(i)
        v = one - h(x[:3], x[3 + 2 * j:5 + 2 * j])
        v[1] = wrap(v[1])
        H = H_full(x, j)
        sigma = np.sqrt(np.diag(H @ P @ H.T + R))
        if (v < 3.5 * sigma).all():
            x, P = update(x, P, one, j, R)
    return x, P, ids
""",
    ),
    (
        "06-false-sights",
        "gates nothing but inflates the result: P at least a fixed size",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P, ids = slam_step(x, P, ids, u, seen, z, C, R)
    P = P.copy()
    P[:3, :3] += np.diag([0.1, 0.1, 0.05]) ** 2      # be humble
    return x, P, ids
""",
    ),
    (
        "06-false-sights",
        "bearing not wrapped in the gate, absolute thresholds in metres and radians",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids.append(i)
            continue
        j = ids.index(i)
        dr, db = one - h(x[:3], x[3 + 2 * j:5 + 2 * j])
        if abs(dr) < 0.15 and abs(db) < 0.06:
            x, P = update(x, P, one, j, R)
    return x, P, ids
""",
    ),
    (
        "06-false-sights",
        "gate computed before predicting",
        """
def careful_step(x, P, ids, u, seen, z, C, R):
    good = []
    for i, one in zip(seen, z):
        if i in ids:
            j = ids.index(i)
            v = one - h(x[:3], x[3 + 2 * j:5 + 2 * j])
            v[1] = wrap(v[1])
            H = H_full(x, j)
            good.append(v @ np.linalg.solve(H @ P @ H.T + R, v) < 13.8)
        else:
            good.append(True)
    x, P = predict(x, P, u, C)
    for ok, i, one in zip(good, seen, z):
        if not ok:
            continue
        if i in ids:
            x, P = update(x, P, one, ids.index(i), R)
        else:
            x, P = augment(x, P, one, R)
            ids = [*ids, i]
    return x, P, ids
""",
    ),
]
