"""Right ways and slips of 13-best-motion."""

from course.tasks import Edit, Slip, Stumble
from course.tasks.ex13 import fit_ways

TASK = "13-best-motion"

WAYS = fit_ways.WAYS

D = "mirror mended by a diagonal"
M = "M = (source - a).T @ (target - b)"
Rot = "T[:2, :2] = Vt.T @ U.T"
SHIFT = "T[:2, 2] = b - T[:2, :2] @ a"
MEND = "Vt[1] *= -1"
GUARD = "if np.linalg.det(Vt.T @ U.T) < 0:"
RETURN = "return T"
MEAN_TURN = "(lambda off: np.angle(np.exp(1j * off).mean()))"


def _mended(how):
    """The program in which Rot is mended otherwise after it has been multiplied."""
    return [(MEND, "pass"), (Rot, f"{Rot}\n    if np.linalg.det(T[:2, :2]) < 0:\n        {how}")]


SLIPS = (
    Slip(
        "rotation-transposed",
        "Rot turns the wrong way: it is the transpose of the right one. Which of U and V belongs to the "
        "source depends on which cloud stands on the left in M.",
        (Rot, "T[:2, :2] = U @ Vt"),
        (M, "M = (target - b).T @ (source - a)"),
    ),
    Slip(
        "not-centred",
        "The centroids were left on one or both clouds when M was summed. Turning is about the "
        "centroids, not about the origin.",
        (M, "M = source.T @ target"),
    ),
    Slip(
        "one-number-centroid",
        "The centroid has two numbers, the mean of x and that of y: without an axis, mean takes all "
        "numbers together.",
        (
            "a, b = source.mean(axis=0), target.mean(axis=0)",
            "a, b = source.mean() * np.ones(2), target.mean() * np.ones(2)",
        ),
    ),
    Slip(
        "centroid-not-turned",
        "The source's centroid has to be turned by Rot before it is compared with the target's.",
        (SHIFT, "T[:2, 2] = b - a"),
    ),
    Slip(
        "centroid-turned-back",
        "In t the source's centroid is turned the wrong way round: by the transpose of Rot.",
        (SHIFT, "T[:2, 2] = b - T[:2, :2].T @ a"),
        (SHIFT, "T[:2, 2] = b - a @ T[:2, :2]"),
    ),
    Slip(
        "centroids-swapped",
        "The centroids have changed places in t, or its sign is wrong: T carries the source, so Rot meets "
        "the source's centroid.",
        (SHIFT, "T[:2, 2] = a - T[:2, :2] @ b"),
        (SHIFT, "T[:2, 2] = T[:2, :2] @ a - b"),
    ),
    Slip(
        "target-turned",
        "Rot was put on the difference of the centroids, or on the target's. Only the source is turned.",
        (SHIFT, "T[:2, 2] = T[:2, :2] @ (b - a)"),
        (SHIFT, "T[:2, 2] = T[:2, :2] @ b - a"),
    ),
    Slip(
        "shift-only",
        "Nothing is turned: Rot is the identity. The clouds are turned against each other.",
        (Rot, "pass"),
    ),
    Slip(
        "no-shift",
        "T turns, but does not shift: t is missing.",
        (SHIFT, "pass"),
    ),
    Slip(
        "first-pair-for-centroid",
        "t lays one point on its partner. All points err: the centroids are what is laid over each "
        "other.",
        (SHIFT, "T[:2, 2] = target[0] - T[:2, :2] @ source[0]"),
        ("a, b = source.mean(axis=0), target.mean(axis=0)", "a, b = source[0], target[0]"),
    ),
    Slip(
        "medians",
        "The middle of least squares is the mean, not the median or the middle of the extremes.",
        (
            "a, b = source.mean(axis=0), target.mean(axis=0)",
            "a, b = ((c.min(axis=0) + c.max(axis=0)) / 2 for c in (source, target))",
        ),
        (
            "a, b = source.mean(axis=0), target.mean(axis=0)",
            "a, b = np.median(source, axis=0), np.median(target, axis=0)",
        ),
    ),
    Slip(
        "inverted",
        "This is the inverse motion: it lays the target over the source. T has to carry the source.",
        (RETURN, "return np.linalg.inv(T)"),
    ),
    Slip(
        "for-rows",
        "T is transposed: matrices act on column vectors here, so that t stands in the last column.",
        (RETURN, "return T.T"),
    ),
    Slip(
        "singular-values-left",
        "The singular values were left in Rot. They say how far the clouds spread, and a rotation does "
        "not stretch.",
        Edit(
            D, (("U, _, Vt", "U, S, Vt"), ("np.diag([1, np.linalg.det(Vt.T @ U.T)])", "np.diag(S)"))
        ),
        Edit(
            D,
            (
                ("U, _, Vt", "U, S, Vt"),
                (
                    "Rot = Vt.T",
                    "Rot = np.sign(np.linalg.det(Vt.T @ U.T)) * Vt.T @ np.diag(S / S[0])",
                ),
                (" @ np.diag([1, np.linalg.det(Vt.T @ U.T)])", ""),
            ),
        ),
    ),
    Slip(
        "affine",
        "This is the best linear map, which may stretch and shear. A robot only turns and drives.",
        (Rot, "T[:2, :2] = (np.linalg.pinv(source - a) @ (target - b)).T"),
    ),
    Slip(
        "turn-of-an-affine-map",
        "The best linear map was sought first, and the rotation nearest to it taken. By then its stretch and "
        "shear have swallowed some of the errors: seek the best among rotations alone.",
        *(
            fit_ways.AFFINE.format(turn=turn)
            for turn in (
                "U, _, Vt = np.linalg.svd(A); Rot = U @ np.diag([1, np.linalg.det(U @ Vt)]) @ Vt",
                "U, _, Vt = np.linalg.svd(A); Rot = U @ Vt",
                "Rot, up = np.linalg.qr(A); Rot = Rot * np.sign(np.diag(up))",
                "t = np.arctan2(A[1, 0], A[0, 0]); "
                "Rot = np.array([[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]])",
            )
        ),
        shaky=True,  # of points on a line the map is not determined across it
    ),
    Slip(
        "mirrored",
        "det Rot = −1: the wall is turned inside out. Find out when V Uᵀ is a mirror, and which column of "
        "V costs least to turn over.",
        (MEND, "pass"),
    ),
    Slip(
        "v-for-vt",
        "numpy's svd returns the transpose of V. In the plane V is often its own transpose, which hides "
        "the mistake as long as there is no mirror.",
        [(MEND, "pass"), (Rot, "T[:2, :2] = Vt @ U.T")],
    ),
    Slip(
        "negated",
        "In the plane det(−Rot) = det Rot: negating the whole matrix leaves a mirror a mirror. One column "
        "has to be turned over.",
        _mended("T[:2, :2] *= -1"),
    ),
    Slip(
        "first-flipped",
        "The wrong column was turned over: the first one has the largest singular value, the wall's own "
        "direction. Which one costs least?",
        (MEND, "Vt[0] *= -1"),
    ),
    Slip(
        "product-flipped",
        "A row or a column of Rot itself, or a row of V, was turned over: that is a rotation, but not the "
        "best one. svd gives the transpose of V: which column of V costs least?",
        _mended("T[1, :2] *= -1"),
        (MEND, "Vt[:, 0] *= -1"),
        _mended("T[0, :2] *= -1"),
        _mended("T[:2, 1] *= -1"),
        _mended("T[:2, 0] *= -1"),
    ),
    Slip(
        "always-flipped",
        "A column is turned over where there is no mirror, or the inequality is the wrong way round: "
        "look at the sign of the determinant.",
        (GUARD, "if np.linalg.det(Vt.T @ U.T) > 0:"),
        (GUARD, "if True:"),
    ),
    Slip(
        "no-turn-for-a-mirror",
        "Where V Uᵀ is a mirror, nothing was turned at all. There still is a best rotation.",
        _mended("T[:2, :2] = np.eye(2)"),
    ),
    Slip(
        "sign-in-the-angle",
        "A sign is turned in the angle's sine or cosine: one sums inner products of the pairs, the other "
        "cross products. Which of them has a minus?",
        Edit("angle in closed form", (("q[:, 1] - p[:, 1]", "q[:, 1] + p[:, 1]"),)),
        Edit(
            "angle in closed form",
            (("np.sum(p * q)", "np.sum(p[:, 0] * q[:, 0] - p[:, 1] * q[:, 1])"),),
        ),
    ),
    Slip(
        "angles-of-pairs",
        "The angle is that of one pair, or the mean of all pairs' angles. Far points tell it better than "
        "near ones, and angles jump by 2π: sum sines and cosines.",
        *(
            Edit(
                "angle in closed form",
                (
                    (
                        "np.arctan2(sine, cosine)",
                        f"{of}(np.arctan2(*q.T[::-1]) - np.arctan2(*p.T[::-1]))",
                    ),
                ),
            )
            for of in ("np.mean", "np.median", "(lambda off: off[0])", MEAN_TURN)
        ),
    ),
    Slip(
        "main-axes",
        "The main axes of both clouds were laid over each other. An axis has no sense, so the cloud may come "
        "out turned by half a turn, and which point belongs to which was not used at all.",
        *(
            fit_ways.MAIN_AXES.format(axis=axis)
            for axis in ("np.linalg.eigh(off.T @ off)[1][:, -1]", "np.linalg.svd(off)[2][0]")
        ),
        shaky=True,
    ),
    Slip(
        "too-few-steps",
        "The angle was sought by steps, from no turn at all, and had not arrived when you stopped. In the "
        "plane it has a closed form, which needs no steps.",
        *(fit_ways.STEPWISE.format(steps=steps) for steps in (1, 2, 3, 4, 5)),
        shaky=True,
    ),
    Slip(
        "turned-by-cosine",
        "An angle by arccos or by arctan has lost its quadrant or its sign: it takes a sine and a cosine.",
        Edit(
            "angle in closed form",
            (("np.arctan2(sine, cosine)", "np.arccos(cosine / np.hypot(sine, cosine))"),),
        ),
        Edit("angle in closed form", (("np.arctan2(sine, cosine)", "np.arctan(sine / cosine)"),)),
    ),
    Slip(
        "cast-to-int",
        "T holds whole numbers only: an array that is made like another one takes over its type.",
        ("T = np.eye(3)", "T = np.zeros((3, 3), dtype=source.dtype)\n    T[2, 2] = 1"),
    ),
    Slip(
        "nine-points",
        "M was divided, or a mean taken, by a number of points that is not that of the clouds.",
        (
            "a, b = source.mean(axis=0), target.mean(axis=0)",
            "a, b = source.sum(axis=0) / 9, target.sum(axis=0) / 9",
        ),
        (
            "a, b = source.mean(axis=0), target.mean(axis=0)",
            "a, b = (c.sum(axis=0) / (len(c) - 1) for c in (source, target))",
        ),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        (RETURN, "return (T[:2, :2], T[:2, 2])"),
        (RETURN, "return np.array([*T[:2, 2], np.arctan2(T[1, 0], T[0, 0])])"),
        (RETURN, "return T[:2]"),
        (RETURN, "pass"),
    ),
    Stumble("raised", (M, "M = (source - a) @ (target - b)")),
)

EQUIVALENT = {}
"""Text of a mutation to the reason why it is right as well."""
