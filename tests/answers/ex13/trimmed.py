"""Independent answers to 13-trimmed: right ones, and students' mistakes."""

RIGHT = [
    (
        "13-trimmed",
        "argpartition, source fitted itself",
        """
def trimmed_icp(source, target, T, rounds, share):
    T = np.array(T, float)
    keep = int(np.floor(share * len(source)))
    for _ in range(rounds):
        d, rows = nearest(carry(T, source), target)
        best = np.argpartition(d, keep - 1)[:keep]
        T = best_motion(source[best], target[rows[best]])
    return T
""",
    ),
    (
        "13-trimmed",
        "sorted list of pairs, rounded up",
        """
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
""",
    ),
]

WRONG = [
    (
        "13-trimmed",
        "keeps the longest pairs",
        """
def trimmed_icp(source, target, T, rounds, share):
    keep = int(share * len(source))
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        kept = np.argsort(d)[::-1][:keep]
        T = best_motion(moved[kept], target[rows[kept]]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "drops the share instead of keeping it",
        """
def trimmed_icp(source, target, T, rounds, share):
    keep = max(int((1 - share) * len(source)), 2)
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        kept = np.argsort(d)[:keep]
        T = best_motion(moved[kept], target[rows[kept]]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "partners by the source's row numbers",
        """
def trimmed_icp(source, target, T, rounds, share):
    keep = int(share * len(source))
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        kept = np.argsort(d)[:keep]
        T = best_motion(moved[kept], target[rows][:keep]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "sorted once, before the first round",
        """
def trimmed_icp(source, target, T, rounds, share):
    d, _ = nearest(carry(T, source), target)
    kept = np.argsort(d)[: int(share * len(source))]
    for _ in range(rounds):
        moved = carry(T, source[kept])
        _, rows = nearest(moved, target)
        T = best_motion(moved, target[rows]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "trims what is left again in each round",
        """
def trimmed_icp(source, target, T, rounds, share):
    left = source
    for _ in range(rounds):
        moved = carry(T, left)
        d, rows = nearest(moved, target)
        kept = np.argsort(d)[: max(2, int(share * len(left)))]
        T = best_motion(moved[kept], target[rows[kept]]) @ T
        left = left[kept]
    return T
""",
    ),
    (
        "13-trimmed",
        "share of the target's points",
        """
def trimmed_icp(source, target, T, rounds, share):
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        kept = np.argsort(d)[: int(share * len(target))]
        T = best_motion(moved[kept], target[rows[kept]]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "share of the longest distance as a gate",
        """
def trimmed_icp(source, target, T, rounds, share):
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        near = d <= share * d.max()
        if near.sum() < 2:
            near[:] = True
        T = best_motion(moved[near], target[rows[near]]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "the first points of the cloud instead of the shortest pairs",
        """
def trimmed_icp(source, target, T, rounds, share):
    keep = int(share * len(source))
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        T = best_motion(moved[:keep], target[rows[:keep]]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "forgets to trim: share is not used",
        """
def trimmed_icp(source, target, T, rounds, share):
    return icp(source, target, T, rounds)
""",
    ),
    (
        "13-trimmed",
        "one pair too few: off by one",
        """
def trimmed_icp(source, target, T, rounds, share):
    keep = max(int(share * len(source)) - 1, 2)
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        order = np.argsort(d)
        T = best_motion(moved[order[:keep]], target[rows[order[:keep]]]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "sorts the distances apart from the rows",
        """
def trimmed_icp(source, target, T, rounds, share):
    keep = int(share * len(source))
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        kept = np.sort(rows)[:keep]
        order = np.argsort(d)[:keep]
        T = best_motion(moved[order], target[kept]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "distances of the untouched source decide",
        """
def trimmed_icp(source, target, T, rounds, share):
    keep = int(share * len(source))
    d0, _ = nearest(source, target)
    for _ in range(rounds):
        moved = carry(T, source)
        _, rows = nearest(moved, target)
        kept = np.argsort(d0)[:keep]
        T = best_motion(moved[kept], target[rows[kept]]) @ T
    return T
""",
    ),
    (
        "13-trimmed",
        "composes on the wrong side",
        """
def trimmed_icp(source, target, T, rounds, share):
    for _ in range(rounds):
        moved = carry(T, source)
        d, rows = nearest(moved, target)
        kept = np.argpartition(d, int(share * len(d)) - 1)[: int(share * len(d))]
        T = T @ best_motion(moved[kept], target[rows[kept]])
    return T
""",
    ),
]
