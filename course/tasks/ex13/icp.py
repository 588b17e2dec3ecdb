"""Right ways and slips of 13-icp."""

from course.tasks import Edit, Slip, Stumble

TASK = "13-icp"

WAYS = {
    "brute force neighbours": """
def icp(source, target, T, rounds):
    T = np.array(T)
    for _ in range(rounds):
        moved = source @ T[:2, :2].T + T[:2, 2]
        apart = np.linalg.norm(moved[:, None] - target, axis=2)
        T = best_motion(moved, target[apart.argmin(axis=1)]) @ T
    return T
""",
    "homogeneous columns, refitted at the end as the thesis does": """
def icp(source, target, T, rounds):
    moved = T @ np.vstack([source.T, np.ones(len(source))])
    tree = cKDTree(target)
    for _ in range(rounds):
        _, rows = tree.query(moved[:2].T)
        moved = best_motion(moved[:2].T, target[rows]) @ moved
    return best_motion(source, moved[:2].T)
""",
    "the fit alone, from the source as given": """
def icp(source, target, T, rounds):
    for k in range(rounds):
        moved = carry(T, source)
        rows = nearest(moved, target)[1]
        T = best_motion(source, target[rows])
    return T
""",
    "stops when nothing changes": """
def icp(source, target, T, rounds):
    last = np.inf
    for _ in range(rounds):
        moved = carry(T, source)
        distances, rows = nearest(moved, target)
        T = best_motion(moved, target[rows]) @ T
        if abs(last - distances.mean()) < 1e-12:
            break
        last = distances.mean()
    return T
""",
    "recursion": """
def icp(source, target, T, rounds):
    if rounds == 0:
        return T
    moved = carry(T, source)
    partners = [target[np.hypot(*(target - p).T).argmin()] for p in moved]
    return icp(source, target, best_motion(moved, np.array(partners)) @ T, rounds - 1)
""",
    "the source moved on, steps collected": """
def icp(source, target, T, rounds):
    moved, steps = carry(T, source), []
    for _ in range(rounds):
        steps.append(best_motion(moved, target[nearest(moved, target)[1]]))
        moved = carry(steps[-1], moved)
    for step in steps:
        T = step @ T
    return T.tolist()
""",
}

FIT = "T = best_motion(moved, target[rows]) @ T"
MOVED = "moved = carry(T, source)"
LOOP = "for _ in range(rounds):"
PAIRS = "_, rows = nearest(moved, target)"
RETURN = "return T"

SLIPS = (
    Slip(
        "wrong-side",
        "The step was put on the wrong side. It is found in the target's frame, after T has been "
        "applied: which of the two acts first?",
        (FIT, "T = T @ best_motion(moved, target[rows])"),
    ),
    Slip(
        "step-only",
        "What came back is the last step alone. Each step starts where those before it left the source: "
        "collect them.",
        [
            (LOOP, "step = T\n    for _ in range(rounds):"),
            (FIT, "step = best_motion(moved, target[rows])\n        T = step @ T"),
            (RETURN, "return step"),
        ],
    ),
    Slip(
        "step-for-T",
        "Each round forgets the motion so far and keeps the step only, while the step was found from the "
        "moved source.",
        (FIT, "T = best_motion(moved, target[rows])"),
    ),
    Slip(
        "by-row",
        "Points were paired by their rows. Two scans do not list the same spots in the same order.",
        (PAIRS, "rows = np.arange(len(source)) % len(target)"),
    ),
    Slip(
        "guess-ignored",
        "The first guess was not used: the first pairs are sought from where T lays the source.",
        (LOOP, "T = np.eye(3)\n    for _ in range(rounds):"),
    ),
    Slip(
        "begun-at-the-centroids",
        "The clouds' centroids were laid over each other before the first round. The first pairs are sought "
        "from where T lays the source, and one cloud may see what the other does not.",
        (
            LOOP,
            "T = np.array(T)\n    T[:2, 2] += (target.mean(axis=0) - carry(T, source).mean(axis=0))"
            f" * (rounds > 0)\n    {LOOP}",
        ),
        (
            LOOP,
            f"T = np.array(T)\n    T[:2, 2] += target.mean(axis=0) - carry(T, source).mean(axis=0)\n    {LOOP}",
        ),
    ),
    Slip(
        "paired-as-given",
        "The pairs were sought with the source as it was given, not as T lays it.",
        (PAIRS, "_, rows = nearest(source, target)"),
    ),
    Slip(
        "source-not-moved",
        "The motion was fitted to the source as it was given and then put on top of T, which moves it "
        "twice.",
        (FIT, "T = best_motion(source, target[rows]) @ T"),
    ),
    Slip(
        "moved-on-without-T",
        "The source is moved by each step from where it was given: the steps before it are forgotten.",
        [
            (
                FIT,
                "step = best_motion(moved, target[rows])\n        moved = carry(step, source)\n        T = step @ T",
            ),
            (LOOP, MOVED + "\n    " + LOOP),
            ("        " + MOVED + "\n", ""),
        ],
    ),
    Slip(
        "moved-twice",
        "The source is moved on by the whole T although it has been moved already: either move it on by "
        "the step, or move the source as given by T.",
        [
            (LOOP, "moved = source\n    " + LOOP),
            ("        " + MOVED, "        moved = carry(T, moved)"),
        ],
    ),
    Slip(
        "inverted",
        "This is the inverse motion. T has to carry the source onto the target.",
        (RETURN, "return np.linalg.inv(T)"),
        (MOVED, "moved = carry(np.linalg.inv(T), source)"),
    ),
    Slip(
        "fitted-backwards",
        "The motion was fitted from the target's points to the source's: it leads back.",
        (FIT, "T = best_motion(target[rows], moved) @ T"),
    ),
    Slip(
        "partners-of-the-target",
        "For each target point the nearest source point was sought. Each source point needs a partner, "
        "and the other way round it is not the same.",
        [
            (PAIRS, "_, rows = nearest(target, moved)"),
            (FIT, "T = best_motion(moved[rows], target) @ T"),
        ],
    ),
    Slip(
        "same-step-again",
        "Every round takes the step of the first: the pairs and the source are those of the beginning.",
        [(LOOP, MOVED + "\n    " + LOOP), ("        " + MOVED + "\n", "")],
    ),
    Slip(
        "pairs-sought-once",
        "The pairs are sought before the loop only. Once the source has moved, others are the nearest.",
        [
            (LOOP, "_, rows = nearest(carry(T, source), target)\n    " + LOOP),
            ("        " + PAIRS + "\n", ""),
        ],
        before=("one-round-only",),
    ),
    Slip(
        "one-round-only",
        "More rounds change nothing: the loop ends after one.",
        (FIT, FIT + "\n        return T"),
        (LOOP, "for _ in range(min(rounds, 1)):"),
    ),
    Slip(
        "round-too-few",
        "There is one round less than asked for.",
        (LOOP, "for _ in range(rounds - 1):"),
        (LOOP, "for _ in range(1, rounds):"),
    ),
    Slip(
        "round-too-many",
        "There is one round more than asked for. With 0 rounds T comes back as it was.",
        (LOOP, "for _ in range(rounds + 1):"),
        (LOOP, "for _ in range(max(rounds, 1)):"),
    ),
    Slip(
        "stops-early",
        "The loop stops before the rounds are over, when little changes or after some number of rounds. "
        "That is a good rule elsewhere; here the number of rounds is told.",
        (
            FIT,
            "old = T\n        "
            + FIT
            + "\n        if np.abs(T - old).max() < 0.1:\n            break",
        ),
        Edit("stops when nothing changes", (("1e-12", "1e-3"),)),
        (LOOP, "for _ in range(min(rounds, 10)):"),
    ),
    Slip(
        "rounds-ignored",
        "The number of rounds is a fixed one, or that of the points.",
        (LOOP, "for _ in range(20):"),
        (LOOP, "for _ in range(50):"),
    ),
    Slip(
        "shift-only",
        "The step shifts and does not turn. Fit a whole motion.",
        (
            FIT,
            "step = np.eye(3)\n        step[:2, 2] = np.mean(target[rows] - moved, axis=0)\n        T = step @ T",
        ),
    ),
    Slip(
        "farthest",
        "These are pairs of the farthest points.",
        Edit("brute force neighbours", (("argmin", "argmax"),)),
    ),
    Slip(
        "each-partner-once",
        "A target point may be the nearest of several source points: here each was used once only.",
        (
            PAIRS,
            PAIRS
            + "\n        rows, first = np.unique(rows, return_index=True)\n        moved = moved[first]",
        ),
    ),
    Slip(
        "only-pairs-that-choose-each-other",
        "Only pairs were fitted in which each is the other's nearest. Here each source point has a partner, "
        "even if that one has somebody nearer.",
        (
            PAIRS,
            PAIRS
            + "\n        both = nearest(target, moved)[1][rows] == np.arange(len(rows))"
            + "\n        moved, rows = moved[both], rows[both]",
        ),
    ),
    Slip(
        "far-pairs-dropped",
        "The long pairs were dropped. That is the next task: here all pairs are fitted.",
        (
            PAIRS,
            "distances, rows = nearest(moved, target)\n        near = distances <= np.median(distances)\n        moved, rows = moved[near], rows[near]",
        ),
    ),
)

STUMBLES = (
    Stumble("raised", (FIT, "T = best_motion(moved, target) @ T")),
    Stumble("malformed", (RETURN, "return carry(T, source)"), (RETURN, "return T, rows")),
    Stumble("malformed", (RETURN, "pass")),
)

EQUIVALENT = {}
