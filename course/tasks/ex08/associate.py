"""Programs of 08-associate."""

from course.tasks import Edit, Slip, Stumble
from course.tasks.ex08 import ways

TASK = "08-associate"
WAYS = ways.ASSOCIATE

_LOOPS = WAYS["a table, sorted"]
_NEAREST_FIRST = _LOOPS[_LOOPS.index("    for k in np") : _LOOPS.index("    return")]
_IN_TURN = """    for i in range(len(z)):
        free = [j for j in range(len(expected)) if d2[i, j] <= gate and j not in pairs]
        pairs[i] = {}
"""


def _loops(find, replace):
    return Edit("a table, sorted", ((find, replace),))


SLIPS = (
    Slip(
        "euclid",
        "This is Pythagoras: metres and radians are added as if they were alike. d² = vᵀ S⁻¹ v counts "
        "in standard deviations.",
        ("v @ np.linalg.inv(S[j]) @ v", "v @ v"),
    ),
    Slip(
        "best-in-total",
        "The pairs are chosen so that all of them together are nearest. The nearest pair of all comes "
        "first, whatever that leaves for the others.",
        """
def associate(z, expected, S, gate):
    from scipy.optimize import linear_sum_assignment

    m, N = len(z), len(expected)
    d2 = np.zeros((m, N))
    for i in range(m):
        for j in range(N):
            v = z[i] - expected[j]
            v[1] = wrap(v[1])
            d2[i, j] = v @ np.linalg.inv(S[j]) @ v
    pairs = zip(*linear_sum_assignment(np.minimum(d2, gate + 1e-6)))
    found = {i: int(j) for i, j in pairs if d2[i, j] <= gate}
    return [found.get(i) for i in range(m)]
""",
    ),
    Slip(
        "S-not-inverted",
        "S⁻¹ is needed, not S: the larger the doubt, the less a difference counts.",
        ("np.linalg.inv(S[j])", "S[j]"),
    ),
    Slip(
        "entries",
        "1 / S inverts every entry. The inverse of the matrix is np.linalg.inv(S), or use "
        "np.linalg.solve.",
        ("np.linalg.inv(S[j])", "(1 / S[j])"),
    ),
    Slip(
        "unwrapped",
        "The angle of v is not wrapped: a wall behind the robot, expected at 179° and seen at −179°, is "
        "2° off.",
        ("v[1] = wrap(v[1])", "pass"),
        ("v[1] = wrap(v[1])", "v = np.array([v[0], wrap(z[i, 1]) - wrap(expected[j, 1])])"),
    ),
    Slip(
        "distance-wrapped",
        "The first component was wrapped, which is a distance. The angle is the second.",
        ("v[1] = wrap(v[1])", "v[0] = wrap(v[0])"),
    ),
    Slip(
        "diagonal",
        "Only the variances of S are used. The errors are correlated: take the whole matrix.",
        ("v @ np.linalg.inv(S[j]) @ v", "np.sum(v**2 / np.diag(S[j]))"),
    ),
    Slip(
        "tie-sign",
        "The sign of S's covariance is turned: the ellipse leans to the other side.",
        ("np.linalg.inv(S[j])", "np.linalg.inv(S[j] * [[1, -1], [-1, 1]])"),
    ),
    Slip(
        "half-counted",
        "v has a sign, and vᵀ S⁻¹ v none: look where an absolute value is taken, or a part left out.",
        ("v @ np.linalg.inv(S[j]) @ v", "np.abs(v) @ np.linalg.inv(S[j]) @ np.abs(v)"),
        ("v @ np.linalg.inv(S[j]) @ v", "v[0] ** 2 / S[j, 0, 0]"),
        ("v @ np.linalg.inv(S[j]) @ v", "v[1] ** 2 / S[j, 1, 1]"),
    ),
    Slip(
        "S-of-the-first",
        "Every pair is measured with the S of the first wall. Each wall has its own.",
        ("S[j]", "S[0]"),
    ),
    Slip(
        "S-of-the-sighting",
        "The row of S is chosen by the sighting's number; S belongs to the walls.",
        ("S[j]", "S[i % len(S)]"),
    ),
    Slip(
        "not-squared",
        "The gate is for the squared distance: compare d² with it, not its root.",
        ("if d2 <= gate", "if np.sqrt(d2) <= gate"),
        ("if d2 <= gate", "if d2 <= gate**2"),
    ),
    Slip(
        "gate-rooted",
        "The gate is given for d² already: take no root of it.",
        ("if d2 <= gate", "if d2 <= np.sqrt(gate)"),
    ),
    Slip(
        "gate-fixed",
        "The gate is an argument: it may be another one in each call.",
        ("if d2 <= gate", "if d2 <= 9.21"),
        ("if d2 <= gate", "if d2 <= 5.99"),
    ),
    Slip(
        "gate-open",
        "A pair whose d² is just the gate is still in: d² ≤ gate.",
        ("if d2 <= gate", "if d2 < gate"),
    ),
    Slip(
        "gate-turned",
        "The gate is the wrong way round: a pair counts where d² is *at most* the gate.",
        ("if d2 <= gate", "if d2 > gate"),
    ),
    Slip(
        "gate-forgotten",
        "Every sighting found a wall, however far. Above the gate it is a new one, None.",
        ("d2 <= gate and ", ""),
        _loops(
            _NEAREST_FIRST,
            "    pairs = [int(np.argmin(row)) if len(row) else None for row in d2]\n",
        ),
    ),
    Slip(
        "first-found",
        "The first pair within the gate was made, not the nearest. Smolec's code does so, and the answer "
        "depends on the order of the map.",
        ("sorted(distances)", "distances"),
        _loops(_NEAREST_FIRST, _IN_TURN.format("free[0] if free else None")),
        _loops(
            _NEAREST_FIRST,
            "    pairs = [next((j for j, d in enumerate(r) if d <= gate), None) for r in d2]\n",
        ),
    ),
    Slip(
        "each-alone",
        "Two sightings got the same wall: each wall is used at most once, by the nearest.",
        (" and j not in pairs.values()", ""),
        _loops(
            _NEAREST_FIRST,
            "    pairs = [int(r.argmin()) if len(r) and r.min() <= gate else None for r in d2]\n",
        ),
    ),
    Slip(
        "overwritten",
        "A sighting that has its wall already gets another one later, which is farther away.",
        ("i not in pairs and ", ""),
    ),
    Slip(
        "in-turn",
        "The sightings choose in their turn, so an early one takes a wall that a later one is nearer "
        "to. Sort all pairs by d² and make the nearest first.",
        ("sorted(distances)", "sorted(distances, key=lambda d: (d[1], d[0]))"),
        _loops(
            _NEAREST_FIRST, _IN_TURN.format("min(free, key=lambda j: d2[i, j]) if free else None")
        ),
    ),
    Slip(
        "walls-in-turn",
        "The walls choose in their turn, so an early one takes a sighting that a later one is nearer "
        "to. Sort all pairs by d² and make the nearest first.",
        ("sorted(distances)", "sorted(distances, key=lambda d: (d[2], d[0]))"),
    ),
    Slip(
        "farthest-first",
        "The farthest pair is made first: sort upwards.",
        ("sorted(distances)", "sorted(distances, reverse=True)"),
    ),
    Slip(
        "least-sum",
        "This pairing has the least sum of all distances. The task asks for another: the nearest pair "
        "first, whatever it costs the others.",
        _loops(
            _NEAREST_FIRST,
            "    from scipy.optimize import linear_sum_assignment\n"
            "    for i, j in zip(*linear_sum_assignment(np.minimum(d2, 1e3 * (1 + d2 // gate)))):\n"
            "        pairs[i] = int(j) if d2[i, j] <= gate else None\n",
        ),
    ),
    Slip(
        "mutual",
        "Only who is each other's first choice was paired. Who lost a wall to a nearer one may still get "
        "the next of those that are left.",
        _loops(
            _NEAREST_FIRST,
            "    for i in range(len(z)):\n"
            "        j = int(d2[i].argmin()) if len(expected) else None\n"
            "        if j is not None and d2[i, j] <= gate and d2[:, j].argmin() == i:\n"
            "            pairs[i] = j\n",
        ),
    ),
    Slip(
        "zero-is-false",
        "Wall 0 is a wall, too, but an `if` takes the number 0 for False. Ask for `is None`.",
        (
            "return [pairs.get(i) for i in range(len(z))]",
            "return [pairs.get(i) or None for i in range(len(z))]",
        ),
    ),
    Slip(
        "zero-for-none",
        "A sighting of no wall got wall 0: a new one is None.",
        ("pairs.get(i)", "pairs.get(i, 0)"),
    ),
    Slip(
        "by-wall",
        "The answer is ordered by walls, or in the order in which pairs were made. Entry i is the wall "
        "of sighting i.",
        (
            "return [pairs.get(i) for i in range(len(z))]",
            "return [*pairs.values(), *[None] * (len(z) - len(pairs))]",
        ),
    ),
    Slip(
        "one-only",
        "The loop ends after the first pair: the next nearest of those left is made next.",
        ("            pairs[i] = j", "            pairs[i] = j\n            break"),
    ),
    Slip(
        "fixed-sizes",
        "Numbers of sightings or walls are written into the code: take them from z and expected.",
        (
            "for i in range(len(z)):\n        for j",
            "for i in range(min(6, len(z))):\n        for j",
        ),
        ("for j in range(len(expected))", "for j in range(min(5, len(expected)))"),
    ),
    Slip(
        "last-left-out",
        "The last wall, or the last sighting, is never looked at: range(n) ends at n − 1 by itself.",
        ("for j in range(len(expected))", "for j in range(len(expected) - 1)"),
        ("for i in range(len(z)):\n        for j", "for i in range(len(z) - 1):\n        for j"),
    ),
    Slip(
        "in-place",
        "An argument is changed in place. A row such as z[i] is a view: what you write into it stands in "
        "z afterwards.",
        (
            "v = z[i] - expected[j]",
            "z[i, 1] = wrap(z[i, 1] + 2e-3)\n            v = z[i] - expected[j]",
        ),
        ("v = z[i] - expected[j]", "v = z[i]\n            v -= expected[j]"),
    ),
)

STUMBLES = (
    Stumble("malformed", ("pairs.get(i)", "pairs.get(i, -1)")),
    Stumble(
        "malformed", ("return [pairs.get(i) for i in range(len(z))]", "return list(pairs.items())")
    ),
    Stumble("malformed", ("pairs[i] = j", "pairs[i] = j + 1")),
    Stumble("malformed", ("return [pairs.get(i) for i in range(len(z))]", "return pairs")),
    Stumble("raised", ("S[j]", "S[j + 1]")),
    Stumble("not attempted", "def associate(z, expected, S, gate):\n    raise NotImplementedError"),
)

EQUIVALENT = {}
