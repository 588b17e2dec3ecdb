"""Right ways and slips of 13-trimmed."""

from course.tasks import Slip, Stumble

TASK = "13-trimmed"

WAYS = {
    "kept by a quantile": """
def trimmed_icp(source, target, T, rounds, share):
    for _ in range(rounds):
        moved = carry(T, source)
        distances, rows = nearest(moved, target)
        kept = distances <= np.quantile(distances, share)
        T = best_motion(moved[kept], target[rows[kept]]) @ T
    return T
""",
    "kept by partition, rounded up": """
def trimmed_icp(source, target, T, rounds, share):
    keep = int(share * len(source))
    tree = cKDTree(target)
    for _ in range(rounds):
        moved = carry(T, source)
        distances, rows = tree.query(moved)
        kept = np.argpartition(distances, keep)[: keep + 1]
        T = best_motion(moved[kept], target[rows[kept]]) @ T
    return T
""",
    "rounded, sorted pairs": """
def trimmed_icp(source, target, T, rounds, share):
    keep = round(share * len(source))
    for _ in range(rounds):
        moved = source @ T[:2, :2].T + T[:2, 2]
        apart = np.linalg.norm(moved[:, None] - target[None], axis=-1)
        pairs = sorted((apart[k].min(), k, int(apart[k].argmin())) for k in range(len(source)))
        _, k, j = zip(*pairs[:keep])
        T = best_motion(moved[list(k)], target[list(j)]) @ T
    return T
""",
    "long pairs deleted, fitted from the source as given": """
def trimmed_icp(source, target, T, rounds, share):
    for _ in range(rounds):
        distances, rows = nearest(carry(T, source), target)
        drop = np.argsort(-distances)[: len(source) - int(np.ceil(share * len(source)))]
        T = best_motion(np.delete(source, drop, axis=0), target[np.delete(rows, drop)])
    return T
""",
    "ICP of one round on what is kept": """
def trimmed_icp(source, target, T, rounds, share):
    for _ in range(rounds):
        distances, _ = nearest(carry(T, source), target)
        limit = np.sort(distances)[int(len(source) * share) - 1]
        T = icp(source[distances <= limit], target, T, 1)
    return T
""",
}

KEEP = "keep = int(share * len(source))"
KEPT = "kept = np.argsort(distances)[:keep]"
FIT = "T = best_motion(moved[kept], target[rows[kept]]) @ T"
LOOP = "for _ in range(rounds):"
PAIRS = "distances, rows = nearest(moved, target)"
RETURN = "return T"

SLIPS = (
    Slip(
        "not-trimmed",
        "All pairs were fitted: those that are in one scan only drag the pose along.",
        (KEPT, "kept = np.arange(len(source))"),
    ),
    Slip(
        "longest-kept",
        "The longest pairs were kept, which are the worst ones: sort the other way.",
        (KEPT, "kept = np.argsort(distances)[-keep:]"),
        (KEPT, "kept = np.argsort(-distances)[:keep]"),
        (KEPT, "kept = np.argsort(distances)[::-1][:keep]"),
    ),
    Slip(
        "share-dropped",
        "The share says how many pairs to keep; here as many were dropped.",
        (KEPT, "kept = np.argsort(distances)[:-keep]"),
        (KEEP, "keep = int((1 - share) * len(source))"),
    ),
    Slip(
        "first-rows",
        "The first rows were kept, whatever their distance.",
        (KEPT, "kept = np.arange(keep)"),
    ),
    Slip(
        "nearest-to-the-robot",
        "What was sorted are not the pairs' distances: points near the robot, or partners with a low "
        "number, are not those that fit.",
        (KEPT, "kept = np.argsort(np.hypot(*moved.T))[:keep]"),
        (KEPT, "kept = np.argsort(np.hypot(*source.T))[:keep]"),
        (KEPT, "kept = np.argsort(rows)[:keep]"),
    ),
    Slip(
        "torn-pairs",
        "Source and target were put in different orders, or cut differently, which tears the pairs "
        "apart: take the same pairs of both.",
        (FIT, "T = best_motion(moved[kept], target[rows[:keep]]) @ T"),
        (FIT, "T = best_motion(moved[:keep], target[rows[kept]]) @ T"),
        (FIT, "T = best_motion(moved[kept], target[rows][:keep]) @ T"),
        (FIT, "T = best_motion(moved[kept], target[np.sort(rows[kept])]) @ T"),
    ),
    Slip(
        "kept-of-the-target",
        "The kept rows are those of the source. Their partners stand in other rows of the target.",
        (FIT, "T = best_motion(moved[kept], target[kept % len(target)]) @ T"),
    ),
    Slip(
        "wrong-side",
        "The step was put on the wrong side. It is found in the target's frame, after T has been applied.",
        (FIT, "T = T @ best_motion(moved[kept], target[rows[kept]])"),
    ),
    Slip(
        "step-for-T",
        "Each round forgets the motion so far, while the step was found from the moved source.",
        (FIT, "T = best_motion(moved[kept], target[rows[kept]])"),
    ),
    Slip(
        "source-not-moved",
        "The step was fitted to the source as given and then put on top of T: that moves it twice.",
        (FIT, "T = best_motion(source[kept], target[rows[kept]]) @ T"),
    ),
    Slip(
        "fitted-backwards",
        "The motion was fitted from the target's points to the source's.",
        (FIT, "T = best_motion(target[rows[kept]], moved[kept]) @ T"),
    ),
    Slip(
        "sorted-once",
        "The rows that were short in the first round are kept for ever. After a step others are: sort "
        "the pairs in every round.",
        [
            (
                LOOP,
                "distances, _ = nearest(carry(T, source), target)\n    " + KEPT + "\n    " + LOOP,
            ),
            ("        " + KEPT + "\n", ""),
        ],
    ),
    Slip(
        "pairs-sought-once",
        "The pairs are sought before the loop only. Once the source has moved, others are nearest.",
        [
            (LOOP, "distances, rows = nearest(carry(T, source), target)\n    " + LOOP),
            ("        " + PAIRS + "\n", ""),
        ],
        before=("one-round-only",),
    ),
    Slip(
        "trimmed-ever-more",
        "What was left out in one round is gone in the next, too, and each round trims again.",
        [
            (
                FIT,
                FIT
                + "\n        source = source[kept]\n        keep = max(int(share * len(source)), 2)",
            )
        ],
        (FIT, FIT + "\n        source = source[kept]\n        keep = int(share * len(source))"),
        (FIT, FIT + "\n        source = moved[kept]\n        keep = int(share * len(source))"),
    ),
    Slip(
        "trimmed-at-the-end",
        "Only the last round trims, or only the first: all rounds do.",
        (KEPT, "kept = np.argsort(distances)[: keep if _ == rounds - 1 else len(source)]"),
        (KEPT, "kept = np.argsort(distances)[: keep if _ == 0 else len(source)]"),
    ),
    Slip(
        "share-of-the-target",
        "The share is one of the pairs, and there are as many as source points, not as target points.",
        (KEEP, "keep = int(share * len(target))"),
        (KEEP, "keep = int(share * min(len(source), len(target)))"),
    ),
    Slip(
        "share-of-the-longest",
        "The share is one of the number of pairs, not of a distance: pairs below a share of the longest "
        "one, or of the mean, are fewer or more.",
        (KEPT, "kept = distances <= share * distances.max()"),
        (
            KEPT,
            "kept = distances <= share * distances.max()\n        "
            "kept = kept if kept.sum() > 1 else np.argsort(distances)[:2]",
        ),
        (KEPT, "kept = distances <= distances.mean()"),
        (KEPT, "kept = distances <= np.median(distances)"),
    ),
    Slip(
        "share-ignored",
        "The share that is kept is a fixed one. It is an argument.",
        (KEEP, "keep = int(0.8 * len(source))"),
        (KEEP, "keep = int(0.5 * len(source))"),
    ),
    Slip(
        "one-too-few",
        "One pair or more too few or too many are kept, beyond what rounding explains.",
        (KEPT, "kept = np.argsort(distances)[: keep - 1]"),
        (KEPT, "kept = np.argsort(distances)[1:keep]"),
        (KEPT, "kept = np.argsort(distances)[: keep + 2]"),
        (KEPT, "kept = np.argsort(distances)[1 : keep + 1]"),
    ),
    Slip(
        "one-round-only",
        "More rounds change nothing: the loop ends after one.",
        (FIT, FIT + "\n        return T"),
    ),
    Slip(
        "stops-early",
        "The loop stops before the rounds are over, when little changes. That is a good rule elsewhere; "
        "here the number of rounds is told.",
        (
            FIT,
            "old = T\n        "
            + FIT
            + "\n        if np.abs(T - old).max() < 0.02:\n            break",
        ),
    ),
    Slip(
        "rounds-off-by-one",
        "There is one round more or less than asked for. With 0 rounds T comes back as it was.",
        (LOOP, "for _ in range(rounds - 1):"),
        (LOOP, "for _ in range(rounds + 1):"),
    ),
    Slip(
        "guess-ignored",
        "The first guess was not used: the first pairs are sought from where T lays the source.",
        (LOOP, "T = np.eye(3)\n    for _ in range(rounds):"),
        (PAIRS, "distances, rows = nearest(source, target)"),
    ),
    Slip(
        "inverted",
        "This is the inverse motion. T has to carry the source onto the target.",
        (RETURN, "return np.linalg.inv(T)"),
    ),
)

STUMBLES = (
    Stumble(
        "raised",
        (KEEP, "keep = share * len(source)"),
        (FIT, "T = best_motion(moved[kept], target[rows]) @ T"),
    ),
    Stumble("malformed", (RETURN, "return T, keep"), (RETURN, "pass")),
)

ROUNDING = "a share may be rounded up or down"
EQUIVALENT = {
    "distances < np.quantile": ROUNDING,
    "argpartition(distances, keep)[:keep]": ROUNDING,
    "argpartition(distances, keep)[:keep + 0]": ROUNDING,
    "np.floor(share": ROUNDING,
    "int(len(source) * share)]": ROUNDING,
    "int(len(source) * share) - 0]": ROUNDING,
}
