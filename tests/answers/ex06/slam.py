"""Independent answers to 06-slam: right ones, and students' mistakes."""

RIGHT = [
    (
        "06-slam",
        "known ones first, then the rest, index kept in a dict",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    where = {name: k for k, name in enumerate(ids)}
    late = []
    for k in range(len(seen)):
        if seen[k] in where:
            x, P = update(x, P, z[k], where[seen[k]], R)
        else:
            late.append(k)
    for k in late:
        if seen[k] in where:
            x, P = update(x, P, z[k], where[seen[k]], R)
        else:
            x, P = augment(x, P, z[k], R)
            where[seen[k]] = len(ids)
            ids.append(seen[k])
    return x, P, ids
""",
    ),
    (
        "06-slam",
        "all known sights in one stacked update",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    new_ids = ids.copy()
    known = [k for k, i in enumerate(seen) if i in new_ids]
    if known:
        js = [new_ids.index(seen[k]) for k in known]
        H = np.vstack([H_full(x, j) for j in js])
        v = np.array([z[k] - h(x[:3], x[3 + 2 * j:5 + 2 * j]) for k, j in zip(known, js)])
        v[:, 1] = wrap(v[:, 1])
        S = H @ P @ H.T + np.kron(np.eye(len(js)), R)
        K = np.linalg.solve(S, H @ P).T
        x, P = x + K @ v.ravel(), P - K @ S @ K.T
        x[2] = wrap(x[2])
    for k, i in enumerate(seen):
        if k in known:
            continue
        if i in new_ids:
            x, P = update(x, P, z[k], new_ids.index(i), R)
        else:
            x, P = augment(x, P, z[k], R)
            new_ids.append(i)
    return x, P, new_ids
""",
    ),
    (
        "06-slam",
        "an array of ids comes back, and floats at that",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = np.array(ids, dtype=float)
    for i, one in zip(seen, z):
        at = np.flatnonzero(ids == i)
        if at.size:
            x, P = update(x, P, one, int(at[0]), R)
        else:
            x, P = augment(x, P, one, R)
            ids = np.append(ids, i)
    return x, P, ids
""",
    ),
]

WRONG = [
    (
        "06-slam",
        "sees first, drives afterwards",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    ids = list(ids)
    for i, one in zip(seen, z):
        if i in ids:
            x, P = update(x, P, one, ids.index(i), R)
        else:
            x, P = augment(x, P, one, R)
            ids.append(i)
    x, P = predict(x, P, u, C)
    return x, P, ids
""",
    ),
    (
        "06-slam",
        "places new landmarks before predicting",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    old = list(ids)
    names = list(ids)
    for k, i in enumerate(seen):
        if i not in names:
            x, P = augment(x, P, z[k], R)
            names.append(i)
    x, P = predict(x, P, u, C)
    for k, i in enumerate(seen):
        if i in old:
            x, P = update(x, P, z[k], old.index(i), R)
    return x, P, names
""",
    ),
    (
        "06-slam",
        "appends to the caller's ids",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    for k in range(len(seen)):
        if seen[k] in ids:
            x, P = update(x, P, z[k], ids.index(seen[k]), R)
        else:
            x, P = augment(x, P, z[k], R)
            ids.append(seen[k])
    return x, P, ids
""",
    ),
    (
        "06-slam",
        "id used as index of the landmark",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    for i, one in zip(seen, z, strict=True):
        if i in ids:
            x, P = update(x, P, one, i, R)
        else:
            x, P = augment(x, P, one, R)
            ids = [*ids, i]
    return x, P, ids
""",
    ),
    (
        "06-slam",
        "predicts once for each sight",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    ids = list(ids)
    for i, one in zip(seen, z, strict=True):
        x, P = predict(x, P, u, C)
        if i in ids:
            x, P = update(x, P, one, ids.index(i), R)
        else:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
    ),
    (
        "06-slam",
        "nothing seen: returns without having driven",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    if len(seen) == 0:
        return x, P, ids
    x, P = predict(x, P, u, C)
    ids = ids[:]
    for i, one in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids += [i]
        else:
            x, P = update(x, P, one, ids.index(i), R)
    return x, P, ids
""",
    ),
    (
        "06-slam",
        "a new landmark is updated at once with the same sight",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids.append(i)
        x, P = update(x, P, one, ids.index(i), R)
    return x, P, ids
""",
    ),
    (
        "06-slam",
        "return inside the loop",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i in ids:
            x, P = update(x, P, one, ids.index(i), R)
        else:
            x, P = augment(x, P, one, R)
            ids.append(i)
        return x, P, ids
    return x, P, ids
""",
    ),
    (
        "06-slam",
        "each update starts from the prediction, only the last counts",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    x0, P0 = predict(x, P, u, C)
    x, P = x0, P0
    known = [(ids.index(i), one) for i, one in zip(seen, z) if i in ids]
    for j, one in known:
        x, P = update(x0, P0, one, j, R)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
    ),
    (
        "06-slam",
        "ids kept sorted, the state is not",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    for i, one in zip(seen, z):
        if i in ids:
            x, P = update(x, P, one, ids.index(i), R)
        else:
            x, P = augment(x, P, one, R)
            ids = sorted([*ids, i])
    return x, P, ids
""",
    ),
    (
        "06-slam",
        "known means id below the number of landmarks",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for k, i in enumerate(seen):
        if i < (len(x) - 3) // 2:
            x, P = update(x, P, z[k], i, R)
        else:
            x, P = augment(x, P, z[k], R)
            ids.append(i)
    return x, P, ids
""",
    ),
    (
        "06-slam",
        "new ids not returned",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    known = list(ids)
    for i, one in zip(seen, z):
        if i in known:
            x, P = update(x, P, one, known.index(i), R)
        else:
            x, P = augment(x, P, one, R)
            known.append(i)
    return x, P, ids
""",
    ),
    (
        "06-slam",
        "correlation thrown away after predicting",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P_moved = predict(x, P, u, C)
    P = P.copy()
    P[:3, :3] = P_moved[:3, :3]       # the robot moved, the landmarks did not
    ids = list(ids)
    for i, one in zip(seen, z):
        if i in ids:
            x, P = update(x, P, one, ids.index(i), R)
        else:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
    ),
    (
        "06-slam",
        "known landmarks are never updated, half finished",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for k, i in enumerate(seen):
        if i in ids:
            continue
        x, P = augment(x, P, z[k], R)
        ids.append(i)
    return x, P, ids
""",
    ),
    (
        "06-slam",
        "stacked update forgets to wrap the bearings",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    pairs = [(ids.index(i), one) for i, one in zip(seen, z) if i in ids]
    if pairs:
        H = np.vstack([H_full(x, j) for j, _ in pairs])
        v = np.concatenate([one - h(x[:3], x[3 + 2 * j:5 + 2 * j]) for j, one in pairs])
        S = H @ P @ H.T + np.kron(np.eye(len(pairs)), R)
        K = P @ H.T @ np.linalg.inv(S)
        x, P = x + K @ v, P - K @ S @ K.T
    for i, one in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
    ),
    (
        "06-slam",
        "stacked R in the wrong Kronecker order",
        """
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    pairs = [(ids.index(i), one) for i, one in zip(seen, z) if i in ids]
    if pairs:
        H = np.vstack([H_full(x, j) for j, _ in pairs])
        v = np.array([one - h(x[:3], x[3 + 2 * j:5 + 2 * j]) for j, one in pairs])
        v[:, 1] = wrap(v[:, 1])
        S = H @ P @ H.T + np.kron(R, np.eye(len(pairs)))
        K = P @ H.T @ np.linalg.inv(S)
        x, P = x + K @ v.ravel(), P - K @ S @ K.T
    for i, one in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids
""",
    ),
]
