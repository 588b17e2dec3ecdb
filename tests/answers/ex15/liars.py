"""Independent answers to 15-liars: right ones, and students' mistakes."""

RIGHT = [
    (
        "15-liars",
        "pairwise consistency, then the cheapest group",
        """
def close_loops(poses, edges, loops):
    n, m = len(poses), len(loops)

    def rows(edge, x):
        i, j, z, _ = edge
        J = np.zeros((3, 3 * n))
        A, B = jacobians(x[i], x[j], z)
        J[:, 3 * i : 3 * i + 3] += A
        J[:, 3 * j : 3 * j + 3] += B
        return J[:, 3:], error(x[i], x[j], z)

    def judge(x):
        H, b = np.zeros((3 * n - 3, 3 * n - 3)), np.zeros(3 * n - 3)
        for edge in edges:
            J, e = rows(edge, x)
            H += J.T @ edge[3] @ J
            b += J.T @ edge[3] @ e
        P = np.linalg.inv(H)
        K, v = zip(*(rows(edge, x) for edge in loops))
        K, v = np.vstack(K), np.concatenate(v)
        v = v - K @ P @ b
        S = K @ P @ K.T
        for k in range(m):
            S[3 * k : 3 * k + 3, 3 * k : 3 * k + 3] += np.linalg.inv(loops[k][3])

        def d2(group):
            at = np.concatenate([np.arange(3 * k, 3 * k + 3) for k in group])
            return v[at] @ np.linalg.solve(S[np.ix_(at, at)], v[at])

        alone = [d2([k]) for k in range(m)]
        best = (0.0, [])
        for seed in range(m):
            if alone[seed] > 25:
                continue
            group = [seed]
            rest = [
                k
                for k in range(m)
                if k != seed and d2([seed, k]) - max(alone[seed], alone[k]) < 16
            ]
            while rest:
                costs = [d2([*group, k]) for k in rest]
                k = int(np.argmin(costs))
                if costs[k] - d2(group) > 16:
                    break
                group.append(rest.pop(k))
            best = min(best, (d2(group) - 16 * len(group), sorted(group)))
        return best[1]

    x = np.array(poses, dtype=float)
    for _ in range(3):
        graph = [*edges, *(loops[k] for k in judge(x))]
        for _ in range(3):
            x = step(x, graph)
    return x
""",
    ),
    (
        "15-liars",
        "loops one after the other, in several orders; the cheapest map wins",
        """
def close_loops(poses, edges, loops):
    def fit(x, some, rounds=3):
        for _ in range(rounds):
            x = step(x, [*edges, *some])
        return x, chi2(x, [*edges, *some])

    in_time = sorted(range(len(loops)), key=lambda k: max(loops[k][0], loops[k][1]))
    orders = [in_time, in_time[::-1]]
    for first in range(1, len(loops), 3):
        orders.append(in_time[first:] + in_time[:first])
    best, least = np.array(poses, dtype=float), np.inf
    for order in orders:
        x, paid, kept = np.array(poses, dtype=float), 0.0, []
        for k in order:
            new, cost = fit(x, [*kept, loops[k]], 1 if len(kept) > 2 else 3)
            if cost - paid < 16:
                x, paid, kept = new, cost, [*kept, loops[k]]
        x, paid = fit(x, kept, 4)
        if paid - 16 * len(kept) < least:
            best, least = x, paid - 16 * len(kept)
    return best
""",
    ),
]

WRONG = [
    (
        "15-liars",
        "hands back the wheels",
        """
def close_loops(poses, edges, loops):
    return poses.copy()
""",
    ),
    (
        "15-liars",
        "trusts all loops",
        """
def close_loops(poses, edges, loops):
    best = poses
    for _ in range(10):
        best = step(best, [*edges, *loops])
    return best
""",
    ),
    (
        "15-liars",
        "judges loops by their own information, without the wheels' drift",
        """
def close_loops(poses, edges, loops):
    graph = list(edges)
    for i, j, z, L in loops:
        e = error(poses[i], poses[j], z)
        if e @ L @ e < 11.3:
            graph.append((i, j, z, L))
    x = poses
    for _ in range(6):
        x = step(x, graph)
    return x
""",
    ),
    (
        "15-liars",
        "all loops trusted, but each a hundredth",
        """
def close_loops(poses, edges, loops):
    weak = [(i, j, z, np.asarray(L) / 100) for i, j, z, L in loops]
    x = poses
    for k in range(8):
        x = step(x, edges + weak)
    return x
""",
    ),
    (
        "15-liars",
        "sorted the wrong way: keeps the half that errs most",
        """
def close_loops(poses, edges, loops):
    cost = []
    for i, j, z, L in loops:
        e = error(poses[i], poses[j], z)
        cost.append(e @ L @ e)
    order = np.argsort(cost)[::-1]
    kept = [loops[k] for k in order[: (len(loops) + 1) // 2]]
    x = poses
    for _ in range(6):
        x = step(x, [*edges, *kept])
    return x
""",
    ),
    (
        "15-liars",
        "weight turned round: the worse the loop the more it counts",
        """
def close_loops(poses, edges, loops):
    x = poses
    for _ in range(20):
        graph = list(edges)
        for i, j, z, L in loops:
            e = error(x[i], x[j], z)
            graph.append((i, j, z, (1 - 0.999 * weight(e @ L @ e, 11.3)) * L))
        x = step(x, graph)
    return x
""",
    ),
    (
        "15-liars",
        "cheat: ignores the loops, knows that all steps are 2 m and all corners 90 degrees",
        """
def close_loops(poses, edges, loops):
    x = [poses[0]]
    for _, _, z, _ in edges:
        corner = np.pi / 2 if z[2] > np.pi / 4 else 0.0
        x.append(compose(x[-1], np.array([2.0, 0.0, corner])))
    return np.array(x)
""",
    ),
    (
        "15-liars",
        "cheat: looks the truth up among the practice drives",
        """
def close_loops(poses, edges, loops):
    for number in range(40):
        truth, wheels, *_ = two_laps(number)
        if wheels.shape == poses.shape and np.allclose(wheels, poses):
            return truth
    return poses.copy()
""",
    ),
    (
        "15-liars",
        "counts on 24 poses",
        """
def close_loops(poses, edges, loops):
    out, x, kept = np.zeros((24, 3)), poses.copy(), []
    for loop in sorted(loops, key=lambda edge: max(edge[0], edge[1])):
        new = x
        for _ in range(4):
            new = step(new, [*edges, *kept, loop])
        if chi2(new, [*edges, *kept, loop]) - chi2(x, [*edges, *kept]) < 11.3:
            x, kept = new, [*kept, loop]
    for k in range(24):
        out[k] = x[k]
    return out
""",
    ),
    (
        "15-liars",
        "good idea, but refused loops are deleted from the caller's list",
        """
def close_loops(poses, edges, loops):
    loops.sort(key=lambda edge: max(edge[0], edge[1]))
    x, k = poses.copy(), 0
    while k < len(loops):
        new = x
        for _ in range(4):
            new = step(new, [*edges, *loops[: k + 1]])
        if chi2(new, [*edges, *loops[: k + 1]]) - chi2(x, [*edges, *loops[:k]]) < 11.3:
            x, k = new, k + 1
        else:
            del loops[k]
    return x
""",
    ),
    (
        "15-liars",
        "good idea, but the accepted loops are appended to the wheels' edges",
        """
def close_loops(poses, edges, loops):
    x, graph = poses.copy(), edges
    for loop in sorted(loops, key=lambda edge: max(edge[0], edge[1])):
        new = x
        for _ in range(4):
            new = step(new, graph + [loop])
        if chi2(new, graph + [loop]) - chi2(x, graph) < 11.3:
            x = new
            graph.append(loop)
    return x
""",
    ),
    (
        "15-liars",
        "good idea, but the map is laid over the wheels' middle: pose 0 moves",
        """
def close_loops(poses, edges, loops):
    x, kept = poses.copy(), []
    for loop in sorted(loops, key=lambda edge: max(edge[0], edge[1])):
        new = x
        for _ in range(4):
            new = step(new, [*edges, *kept, loop])
        if chi2(new, [*edges, *kept, loop]) - chi2(x, [*edges, *kept]) < 11.3:
            x, kept = new, [*kept, loop]
    x = x.copy()
    x[:, :2] += (poses - x)[:, :2].mean(axis=0)
    return x
""",
    ),
    (
        "15-liars",
        "good idea, but pairs of loops are needed: a single loop crashes it",
        """
def close_loops(poses, edges, loops):
    def fit(some):
        x = poses
        for _ in range(4):
            x = step(x, [*edges, *some])
        return x, chi2(x, [*edges, *some])

    pairs = [(fit([a, b])[1], k, m) for k, a in enumerate(loops) for m, b in enumerate(loops) if k < m]
    cost, k, m = min(pairs)
    kept = [loops[k], loops[m]]
    for n in np.argsort([loop[1] for loop in loops]):
        if n in (k, m):
            continue
        _, more = fit([*kept, loops[n]])
        if more - cost < 11.3:
            kept.append(loops[n])
            cost = more
    return fit(kept)[0]
""",
    ),
    (
        "15-liars",
        "no sharing: each loop carries pose j and all later ones to where it wants them",
        """
def close_loops(poses, edges, loops):
    x = poses.copy()
    for i, j, z, _ in sorted(loops, key=lambda loop: loop[1]):
        target = compose(x[i], z)
        later = between(x[j], x[j:])
        x[j:] = compose(target, later)
    return x
""",
    ),
]
