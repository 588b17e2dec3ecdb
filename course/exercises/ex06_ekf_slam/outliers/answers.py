# %% way: outliers with a large R
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids.append(i)
            continue
        j = ids.index(i)
        v = one - h(x[:3], x[3 + 2 * j : 5 + 2 * j])
        v[1] = wrap(v[1])
        H = H_full(x, j)
        far = v @ np.linalg.inv(H @ P @ H.T + R) @ v
        # an outlier gets a weight near zero
        x, P = update(x, P, one, j, R * (1 if far < 9 else 1e6))
    return x, P, ids

# %% way: a gate of range and bearing apart
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    for i, one in zip(seen, z):
        if i in ids:
            j = ids.index(i)
            v = one - h(x[:3], x[3 + 2 * j : 5 + 2 * j])
            v[1] = (v[1] + np.pi) % (2 * np.pi) - np.pi
            H = H_full(x, j)
            sigma = np.sqrt(np.diag(H @ P @ H.T + R))
            if np.all(np.abs(v) < 3.5 * sigma):
                x, P = update(x, P, one, j, R)
        else:
            x, P = augment(x, P, one, R)
            ids = ids + [i]
    return x, P, ids

# %% pasted: slam_step
def careful_step(x, P, ids, u, seen, z, C, R):
    return slam_step(x, P, ids, u, seen, z, C, R)

# %% right: nearest first: best sight taken, all gated anew
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

# %% right: gate at 99 %, whitened by Cholesky, own update inline
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

# %% wrong: everything trusted less: R ten times as large
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

# %% wrong: P always of one size
last = [None]


def careful_step(x, P, ids, u, seen, z, C, R):
    P = last[0] if ids else P
    x, P = predict(x, P, u, C)
    for i, one in zip(seen, z):
        if i not in ids:
            x, P, ids = *augment(x, P, one, R), [*ids, i]
            continue
        j = ids.index(i)
        v = one - h(x[:3], x[3 + 2 * j : 5 + 2 * j])
        v[1] = wrap(v[1])
        H = H_full(x, j)
        if v @ np.linalg.solve(H @ P @ H.T + R, v) < 13.8:
            x, P = update(x, P, one, j, R)
    last[0] = P
    return x, np.diag([0.1, 0.1, 0.03, *[0.1] * (len(x) - 3)]) ** 2, ids

# %% wrong: seven tenths of R
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    for i, one in zip(seen, z):
        if i not in ids:
            x, P, ids = *augment(x, P, one, R), [*ids, i]
            continue
        j = ids.index(i)
        v = one - h(x[:3], x[3 + 2 * j : 5 + 2 * j])
        v[1] = wrap(v[1])
        H = H_full(x, j)
        if v @ np.linalg.solve(H @ P @ H.T + R, v) < 13.8:
            x, P = update(x, P, one, j, 0.7 * R)
    return x, P, ids

# %% wrong: a rejected measurement changes P
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    for i, one in zip(seen, z):
        if i not in ids:
            x, P, ids = *augment(x, P, one, R), [*ids, i]
            continue
        j = ids.index(i)
        v = one - h(x[:3], x[3 + 2 * j : 5 + 2 * j])
        v[1] = wrap(v[1])
        H = H_full(x, j)
        good = v @ np.linalg.solve(H @ P @ H.T + R, v) < 9.21
        y, P = update(x, P, one, j, R)
        x = y if good else x
    return x, P, ids

# %% wrong: gate without R
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    for i, one in zip(seen, z):
        if i not in ids:
            x, P, ids = *augment(x, P, one, R), [*ids, i]
            continue
        j = ids.index(i)
        v = one - h(x[:3], x[3 + 2 * j : 5 + 2 * j])
        v[1] = wrap(v[1])
        H = H_full(x, j)
        if v @ np.linalg.solve(H @ P @ H.T, v) < 9.21:
            x, P = update(x, P, one, j, R)
    return x, P, ids

# %% wrong: false sight is taken for a landmark that moved: placed anew, the old one forgotten
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

# %% wrong: bearing not wrapped in the gate, absolute thresholds in metres and radians
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

# %% wrong: gate computed before predicting
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
