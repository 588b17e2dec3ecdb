"""Independent answers to 13-icp: right ones, and students' mistakes."""

RIGHT = [
    (
        "13-icp",
        "moves the cloud along and multiplies the motions up",
        """
def icp(source, target, T, rounds):
    total = np.array(T, dtype=float)
    cloud = carry(total, source)
    for _ in range(rounds):
        rows = nearest(cloud, target)[1]
        move = best_motion(cloud, target[rows])
        cloud = carry(move, cloud)
        total = move @ total
    return total
""",
    ),
    (
        "13-icp",
        "fits the source itself, not what was moved",
        """
def icp(source, target, T, rounds):
    T = T.copy()
    tree = cKDTree(target)
    k = 0
    while k < rounds:
        partners = tree.query(source @ T[:2, :2].T + T[:2, 2])[1]
        T = best_motion(source, target[partners])
        k += 1
    return T
""",
    ),
]

WRONG = [
    (
        "13-icp",
        "composes on the wrong side",
        """
def icp(source, target, T, rounds):
    for _ in range(rounds):
        moved = carry(T, source)
        _, rows = nearest(moved, target)
        T = T @ best_motion(moved, target[rows])
    return T
""",
    ),
    (
        "13-icp",
        "partners are sought once",
        """
def icp(source, target, T, rounds):
    _, rows = nearest(carry(T, source), target)
    for _ in range(rounds):
        moved = carry(T, source)
        T = best_motion(moved, target[rows]) @ T
    return T
""",
    ),
    (
        "13-icp",
        "seeks from where the source was, not from where it lies now",
        """
def icp(source, target, T, rounds):
    for _ in range(rounds):
        _, rows = nearest(source, target)
        T = best_motion(source, target[rows])
    return T
""",
    ),
    (
        "13-icp",
        "returns the last step only",
        """
def icp(source, target, T, rounds):
    moved = carry(T, source)
    for _ in range(rounds):
        _, rows = nearest(moved, target)
        T = best_motion(moved, target[rows])
        moved = carry(T, moved)
    return T
""",
    ),
    (
        "13-icp",
        "one round too many",
        """
def icp(source, target, T, rounds):
    for _ in range(rounds + 1):
        moved = carry(T, source)
        T = best_motion(moved, target[nearest(moved, target)[1]]) @ T
    return T
""",
    ),
    (
        "13-icp",
        "stops early when little changes",
        """
def icp(source, target, T, rounds):
    last = np.inf
    for _ in range(rounds):
        moved = carry(T, source)
        distances, rows = nearest(moved, target)
        if abs(last - distances.mean()) < 1e-3:
            break
        last = distances.mean()
        T = best_motion(moved, target[rows]) @ T
    return T
""",
    ),
    (
        "13-icp",
        "nearest source point for each target point",
        """
def icp(source, target, T, rounds):
    for _ in range(rounds):
        moved = carry(T, source)
        _, rows = nearest(target, moved)
        T = best_motion(moved[rows], target) @ T
    return T
""",
    ),
    (
        "13-icp",
        "pairs by row, cut to the shorter cloud",
        """
def icp(source, target, T, rounds):
    n = min(len(source), len(target))
    for _ in range(rounds):
        moved = carry(T, source)
        T = best_motion(moved[:n], target[:n]) @ T
    return T
""",
    ),
    (
        "13-icp",
        "the first guess is ignored",
        """
def icp(source, target, T, rounds):
    T = np.eye(3)
    for _ in range(rounds):
        moved = carry(T, source)
        _, rows = nearest(moved, target)
        T = best_motion(moved, target[rows]) @ T
    return T
""",
    ),
    (
        "13-icp",
        "changes the guess in place",
        """
def icp(source, target, T, rounds):
    for _ in range(rounds):
        moved = carry(T, source)
        _, rows = nearest(moved, target)
        T[:] = best_motion(moved, target[rows]) @ T
    return T
""",
    ),
    (
        "13-icp",
        "no target point twice: the other pairs are dropped",
        """
def icp(source, target, T, rounds):
    for _ in range(rounds):
        moved = carry(T, source)
        distances, rows = nearest(moved, target)
        _, first = np.unique(rows, return_index=True)
        if len(first) < 2:
            break
        T = best_motion(moved[first], target[rows[first]]) @ T
    return T
""",
    ),
    (
        "13-icp",
        "fits the raw source, but adds it to T all the same",
        """
def icp(source, target, T, rounds):
    for _ in range(rounds):
        _, rows = nearest(carry(T, source), target)
        T = best_motion(source, target[rows]) @ T
    return T
""",
    ),
    (
        "13-icp",
        "no rounds: T is never set",
        """
def icp(source, target, T, rounds):
    moved = carry(T, source)
    for _ in range(rounds):
        _, rows = nearest(moved, target)
        result = best_motion(source, target[rows])
        moved = carry(result, source)
    return result
""",
    ),
]
