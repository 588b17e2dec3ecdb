# %% way: known ones first
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids, known = list(ids), [i in ids for i in seen]
    for i, one, old in zip(seen, z, known):
        if old:
            x, P = update(x, P, one, ids.index(i), R)
    for i, one, old in zip(seen, z, known):
        if not old:
            x, P = augment(x, P, one, R)
            ids.append(i)
    return x, P, ids

# %% way: one update for the whole scan
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    old = [k for k, i in enumerate(seen) if i in ids]
    if old:
        js = [ids.index(seen[k]) for k in old]
        H = np.vstack([H_full(x, j) for j in js])
        v = np.array([z[k] - h(x[:3], x[3 + 2 * j : 5 + 2 * j]) for k, j in zip(old, js)])
        v[:, 1] = wrap(v[:, 1])
        S = H @ P @ H.T + np.kron(np.eye(len(js)), R)
        K = P @ H.T @ np.linalg.inv(S)
        x, P = x + K @ v.ravel(), P - K @ S @ K.T
    for k, i in enumerate(seen):
        if k not in old:
            x, P = augment(x, P, z[k], R)
            ids = ids + [i]
    return x, P, np.array(ids)

# %% way: new ones first
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    known = list(ids)
    for i, one in zip(seen, z):
        if i not in known:
            x, P = augment(x, P, one, R)
            ids = ids + [i]
    for i, one in zip(seen, z):
        if i in known:
            x, P = update(x, P, one, ids.index(i), R)
    return x, P, tuple(ids)

# %% right: known ones first, then the rest, index kept in a dict
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

# %% right: an array of ids comes back, and floats at that
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

# %% wrong: only two measurements of a scan
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    for i, one in list(zip(seen, z))[:2]:
        if i in ids:
            x, P = update(x, P, one, ids.index(i), R)
        else:
            x, P, ids = *augment(x, P, one, R), [*ids, i]
    return x, P, ids

# %% wrong: only one new landmark in each scan
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    before = ids
    for i, one in zip(seen, z):
        if i in ids:
            x, P = update(x, P, one, ids.index(i), R)
        elif ids == before:
            x, P, ids = *augment(x, P, one, R), [*ids, i]
    return x, P, ids

# %% wrong: every innovation of a scan from the predicted state
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    x_predicted = x
    for i, one in zip(seen, z):
        if i in ids:
            start = np.append(x_predicted, x[len(x_predicted):])
            y, P = update(start, P, one, ids.index(i), R)
            x = x + y - start
        else:
            x, P, ids = *augment(x, P, one, R), [*ids, i]
    return x, P, ids

# %% wrong: new landmarks placed from the predicted pose
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    pose = x[:3]
    for i, one in zip(seen, z):
        if i in ids:
            x, P = update(x, P, one, ids.index(i), R)
        else:
            _, P = augment(x, P, one, R)
            x, ids = np.append(x, g(pose, one)), [*ids, i]
    return x, P, ids

# %% wrong: ids in place
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    for i, sight in zip(seen, z):
        if i in ids:
            x, P = update(x, P, sight, ids.index(i), R)
        else:
            x, P = augment(x, P, sight, R)
            ids.append(i)
    return x, P, ids

# %% wrong: id used as index of the landmark
def slam_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    for i, one in zip(seen, z, strict=True):
        if i in ids:
            x, P = update(x, P, one, i, R)
        else:
            x, P = augment(x, P, one, R)
            ids = [*ids, i]
    return x, P, ids

# %% wrong: correlation thrown away after predicting
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

# %% wrong: stacked update forgets to wrap the bearings
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
