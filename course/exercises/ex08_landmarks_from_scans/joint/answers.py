# %% way: branch and bound
def associate_jointly(z, expected, H, P, R, gates):
    best = [0.0, []]

    def extend(i, walls):
        pairs = [(k, j) for k, j in enumerate(walls) if j is not None]
        if len(pairs) + len(z) - i < sum(j is not None for j in best[1]):
            return
        if i == len(z):
            d2 = joint(pairs, z, expected, H, P, R)
            better = (len(pairs), -d2) > (sum(j is not None for j in best[1]), -best[0])
            if d2 <= gates[2 * len(pairs)] and (better or not best[1]):
                best[:] = d2, walls
            return
        for j in range(len(expected)):
            if j not in walls and joint([(i, j)], z, expected, H, P, R) <= gates[2]:
                extend(i + 1, [*walls, j])
        extend(i + 1, [*walls, None])

    extend(0, [])
    return best[1], best[0]


def joint(pairs, z, expected, H, P, R):
    k = len(pairs)
    if k == 0:
        return 0.0
    S = np.zeros((2 * k, 2 * k))
    v = np.zeros(2 * k)
    for a, (i, j) in enumerate(pairs):
        v[2 * a : 2 * a + 2] = z[i, 0] - expected[j, 0], wrap(z[i, 1] - expected[j, 1])
        for b, (_, other) in enumerate(pairs):
            S[2 * a : 2 * a + 2, 2 * b : 2 * b + 2] = H[j] @ P @ H[other].T + (R if a == b else 0)
    white = np.linalg.solve(np.linalg.cholesky(S), v)
    return white @ white

# %% way: an update for each pair
def associate_jointly(z, expected, H, P, R, gates):
    found = [(0, 0.0, [None] * len(z))]

    def follow(i, walls, x, P, d2):
        used = [j for j in walls if j is not None]
        if i == len(z):
            if d2 <= gates[2 * len(used)]:
                found.append((len(used), -d2, walls))
            return
        follow(i + 1, [*walls, None], x, P, d2)
        for j in set(range(len(expected))) - set(used):
            off = z[i] - expected[j]
            off = np.array([off[0], wrap(off[1])])
            if off @ np.linalg.inv(H[j] @ P0 @ H[j].T + R) @ off > gates[2]:
                continue
            v, S = off - H[j] @ x, H[j] @ P @ H[j].T + R
            K = P @ H[j].T @ np.linalg.inv(S)
            follow(i + 1, [*walls, j], x + K @ v, P - K @ S @ K.T, d2 + v @ np.linalg.solve(S, v))

    P0 = P
    follow(0, [], np.zeros(len(P)), P, 0.0)
    most = max(found, key=lambda each: each[:2])
    return most[2], -most[1] + 0.0

# %% right: the d² as the minimum over the state
def associate_jointly(z, expected, H, P, R, gates):
    from itertools import permutations
    slots = list(range(len(expected))) + [None] * len(z)
    root = np.linalg.cholesky(R)
    A = np.linalg.cholesky(P + 1e-15 * np.eye(len(P)))

    def cost(pairs):
        M, b = [np.eye(len(P))], [np.zeros(len(P))]
        for i, j in pairs:
            v = z[i] - expected[j]
            v[1] = wrap(v[1])
            M.append(np.linalg.solve(root, H[j] @ A))
            b.append(np.linalg.solve(root, v))
        M, b = np.vstack(M), np.concatenate(b)
        s = np.linalg.lstsq(M, b, rcond=None)[0]
        return np.sum((M @ s - b) ** 2)

    best = (0, 0.0, tuple([None] * len(z)))
    for walls in set(permutations(slots, len(z))):
        pairs = [(i, j) for i, j in enumerate(walls) if j is not None]
        if not pairs or any(cost([p]) > gates[2] for p in pairs):
            continue
        c = cost(pairs)
        if c <= gates[2 * len(pairs)] and (-len(pairs), c) < best[:2]:
            best = (-len(pairs), c, walls)
    return list(best[2]), best[1]

# %% wrong: nearest neighbours, of which the worst pair is removed until they are compatible
def associate_jointly(z, expected, H, P, R, gates):
    def d2(pairs):
        if not pairs:
            return 0.0
        v = np.concatenate([[z[i, 0] - expected[j, 0], wrap(z[i, 1] - expected[j, 1])] for i, j in pairs])
        G = np.concatenate([H[j] for _, j in pairs])
        S = G @ P @ G.T
        for k in range(len(pairs)):
            S[2 * k : 2 * k + 2, 2 * k : 2 * k + 2] += R
        return v @ np.linalg.solve(S, v)

    pairs = []
    for d, i, j in sorted((d2([(i, j)]), i, j) for i in range(len(z)) for j in range(len(expected))):
        if d <= gates[2] and i not in [a for a, _ in pairs] and j not in [b for _, b in pairs]:
            pairs.append((i, j))
    while pairs and d2(pairs) > gates[2 * len(pairs)]:
        pairs.remove(max(pairs, key=lambda p: d2([p])))
    return [dict(pairs).get(i) for i in range(len(z))], d2(pairs)

# %% wrong: the pose's covariance alone, and gates of the number of pairs
def associate_jointly(z, expected, H, P, R, gates):
    from itertools import product
    best = (0, 0.0, [None] * len(z))
    for walls in product([None, *range(len(expected))], repeat=len(z)):
        pairs = [(i, j) for i, j in enumerate(walls) if j is not None]
        if len({j for _, j in pairs}) < len(pairs) or not pairs:
            continue
        G = np.concatenate([H[j][:, :3] for _, j in pairs])
        v = np.concatenate([z[i] - expected[j] for i, j in pairs])
        v[1::2] = wrap(v[1::2])
        S = G @ P[:3, :3] @ G.T + np.kron(np.eye(len(pairs)), R)
        d2 = v @ np.linalg.solve(S, v)
        if d2 <= gates[len(pairs)] and (-len(pairs), d2) < best[:2]:
            best = (-len(pairs), d2, list(walls))
    return best[2], best[1]

# %% wrong: every pair is tested with the one before it
def associate_jointly(z, expected, H, P, R, gates):
    x, walls, total = np.zeros(len(P)), [], 0.0
    for i in range(len(z)):
        options = []
        for j in range(len(expected)):
            if j in walls:
                continue
            v = z[i] - expected[j]
            v[1] = wrap(v[1])
            v = v - H[j] @ x
            S = H[j] @ P @ H[j].T + R
            options.append((v @ np.linalg.solve(S, v), j, v, S))
        near = min(options, key=lambda each: each[0]) if options else None
        if near is None or near[0] > gates[2]:
            walls.append(None)
            continue
        d, j, v, S = near
        K = P @ H[j].T @ np.linalg.inv(S)
        x, P = x + K @ v, P - K @ S @ K.T
        walls.append(j)
        total += d
    return walls, total
