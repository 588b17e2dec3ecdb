# %% way: brute force neighbours
def icp(source, target, T, iterations):
    T = np.array(T)
    for _ in range(iterations):
        moved = source @ T[:2, :2].T + T[:2, 2]
        apart = np.linalg.norm(moved[:, None] - target, axis=2)
        T = best_motion(moved, target[apart.argmin(axis=1)]) @ T
    return T

# %% way: homogeneous columns, refitted at the end as the thesis does
def icp(source, target, T, iterations):
    moved = T @ np.vstack([source.T, np.ones(len(source))])
    tree = cKDTree(target)
    for _ in range(iterations):
        _, rows = tree.query(moved[:2].T)
        moved = best_motion(moved[:2].T, target[rows]) @ moved
    return best_motion(source, moved[:2].T)

# %% way: the fit alone, from the source as given
def icp(source, target, T, iterations):
    for k in range(iterations):
        moved = carry(T, source)
        rows = nearest(moved, target)[1]
        T = best_motion(source, target[rows])
    return T

# %% way: stops when nothing changes
def icp(source, target, T, iterations):
    last = np.inf
    for _ in range(iterations):
        moved = carry(T, source)
        distances, rows = nearest(moved, target)
        T = best_motion(moved, target[rows]) @ T
        if abs(last - distances.mean()) < 1e-12:
            break
        last = distances.mean()
    return T

# %% way: recursion
def icp(source, target, T, iterations):
    if iterations == 0:
        return T
    moved = carry(T, source)
    partners = [target[np.hypot(*(target - p).T).argmin()] for p in moved]
    return icp(source, target, best_motion(moved, np.array(partners)) @ T, iterations - 1)

# %% way: the source moved on, steps collected
def icp(source, target, T, iterations):
    moved, steps = carry(T, source), []
    for _ in range(iterations):
        steps.append(best_motion(moved, target[nearest(moved, target)[1]]))
        moved = carry(steps[-1], moved)
    for step in steps:
        T = step @ T
    return T.tolist()

# %% right: fits the source itself, not what was moved
def icp(source, target, T, iterations):
    T = T.copy()
    tree = cKDTree(target)
    k = 0
    while k < iterations:
        partners = tree.query(source @ T[:2, :2].T + T[:2, 2])[1]
        T = best_motion(source, target[partners])
        k += 1
    return T

# %% right: pairs by brute force, moved by steps
def icp(source, target, T, iterations):
    at = carry(T, source.astype(float))
    for _ in range(iterations):
        far = ((at[:, None] - target[None]) ** 2).sum(axis=2)
        M = best_motion(at, target[far.argmin(axis=1)])
        at, T = carry(M, at), M @ T
    return T

# %% wrong: the target is carried, not the source
def icp(source, target, T, iterations):
    for _ in range(iterations):
        moved = carry(np.linalg.inv(T), target)
        _, rows = nearest(source, moved)
        T = best_motion(source, target[rows])
        T = T + 0
        if iterations > 10 ** 6:
            break
        T[2] = 0, 0, 2
    return T

# %% wrong: seeks from where the source was, not from where it lies now
def icp(source, target, T, iterations):
    for _ in range(iterations):
        _, rows = nearest(source, target)
        T = best_motion(source, target[rows])
    return T

# %% wrong: pairs by row, cut to the shorter cloud
def icp(source, target, T, iterations):
    n = min(len(source), len(target))
    for _ in range(iterations):
        moved = carry(T, source)
        T = best_motion(moved[:n], target[:n]) @ T
    return T

# %% wrong: changes the guess in place
def icp(source, target, T, iterations):
    for _ in range(iterations):
        moved = carry(T, source)
        _, rows = nearest(moved, target)
        T[:] = best_motion(moved, target[rows]) @ T
    return T

# %% wrong: no iterations: T is never set
def icp(source, target, T, iterations):
    moved = carry(T, source)
    for _ in range(iterations):
        _, rows = nearest(moved, target)
        result = best_motion(source, target[rows])
        moved = carry(result, source)
    return result
