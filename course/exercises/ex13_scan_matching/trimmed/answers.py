# %% way: kept by a quantile
def trimmed_icp(source, target, T, rounds, share):
    for _ in range(rounds):
        moved = carry(T, source)
        distances, rows = nearest(moved, target)
        kept = distances <= np.quantile(distances, share)
        T = best_motion(moved[kept], target[rows[kept]]) @ T
    return T

# %% way: kept by partition, rounded up
def trimmed_icp(source, target, T, rounds, share):
    keep = int(share * len(source))
    tree = cKDTree(target)
    for _ in range(rounds):
        moved = carry(T, source)
        distances, rows = tree.query(moved)
        kept = np.argpartition(distances, keep)[: keep + 1]
        T = best_motion(moved[kept], target[rows[kept]]) @ T
    return T

# %% way: rounded, sorted pairs
def trimmed_icp(source, target, T, rounds, share):
    keep = round(share * len(source))
    for _ in range(rounds):
        moved = source @ T[:2, :2].T + T[:2, 2]
        apart = np.linalg.norm(moved[:, None] - target[None], axis=-1)
        pairs = sorted((apart[k].min(), k, int(apart[k].argmin())) for k in range(len(source)))
        _, k, j = zip(*pairs[:keep])
        T = best_motion(moved[list(k)], target[list(j)]) @ T
    return T

# %% way: long pairs deleted, fitted from the source as given
def trimmed_icp(source, target, T, rounds, share):
    for _ in range(rounds):
        distances, rows = nearest(carry(T, source), target)
        drop = np.argsort(-distances)[: len(source) - int(np.ceil(share * len(source)))]
        T = best_motion(np.delete(source, drop, axis=0), target[np.delete(rows, drop)])
    return T

# %% way: ICP of one round on what is kept
def trimmed_icp(source, target, T, rounds, share):
    for _ in range(rounds):
        distances, _ = nearest(carry(T, source), target)
        limit = np.sort(distances)[int(len(source) * share) - 1]
        T = icp(source[distances <= limit], target, T, 1)
    return T

# %% right: argpartition in place of a sort
def trimmed_icp(source, target, T, rounds, share):
    keep = max(2, int(np.ceil(share * len(source) - 1e-9)))
    for _ in range(rounds):
        at = carry(T, source)
        d, row = nearest(at, target)
        best = np.argpartition(d, keep - 1)[:keep]
        T = best_motion(source[best], target[row[best]])
    return T

# %% right: argpartition, source fitted itself
def trimmed_icp(source, target, T, rounds, share):
    T = np.array(T, float)
    keep = int(np.floor(share * len(source)))
    for _ in range(rounds):
        d, rows = nearest(carry(T, source), target)
        best = np.argpartition(d, keep - 1)[:keep]
        T = best_motion(source[best], target[rows[best]])
    return T

# %% right: sorted list of pairs, rounded up
def trimmed_icp(source, target, T, rounds, share):
    count = min(len(source), int(np.ceil(share * len(source) - 1e-9)))
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        pairs = sorted(zip(d, range(len(d)), rows))[:count]
        i = np.array([pair[1] for pair in pairs])
        j = np.array([pair[2] for pair in pairs])
        T = best_motion(moved[i], target[j]) @ T
    return T

# %% wrong: drops the share instead of keeping it
def trimmed_icp(source, target, T, rounds, share):
    keep = max(int((1 - share) * len(source)), 2)
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        kept = np.argsort(d)[:keep]
        T = best_motion(moved[kept], target[rows[kept]]) @ T
    return T

# %% wrong: one pair too few: off by one
def trimmed_icp(source, target, T, rounds, share):
    keep = max(int(share * len(source)) - 1, 2)
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        order = np.argsort(d)
        T = best_motion(moved[order[:keep]], target[rows[order[:keep]]]) @ T
    return T

# %% wrong: distances of the untouched source decide
def trimmed_icp(source, target, T, rounds, share):
    keep = int(share * len(source))
    d0, _ = nearest(source, target)
    for _ in range(rounds):
        moved = carry(T, source)
        _, rows = nearest(moved, target)
        kept = np.argsort(d0)[:keep]
        T = best_motion(moved[kept], target[rows[kept]]) @ T
    return T
