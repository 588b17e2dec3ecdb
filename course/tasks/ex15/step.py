"""Right ways and slips of 15-step."""

from itertools import combinations

from course.tasks import Edit, Slip, Stumble
from course.tasks.ex15.step_ways import BLOCKS, WAYS

__all__ = ["SLIPS", "STUMBLES", "TASK", "WAYS"]

TASK = "15-step"


def _in(*pairs):
    return Edit("blocks one by one", pairs)


TERMS = {
    "H[I, I]": "A.T @ L @ A",
    "H[I, J]": "A.T @ L @ B",
    "H[J, I]": "B.T @ L @ A",
    "H[J, J]": "B.T @ L @ B",
    "b[I]": "A.T @ L @ e",
    "b[J]": "B.T @ L @ e",
}


def _terms(*others):
    """The program with other terms in H and b, in their order; None for those that stay."""
    pairs = zip(TERMS.items(), others, strict=False)
    return _in(*((f"{at} += {right}", f"{at} += {wrong}") for (at, right), wrong in pairs if wrong))


SOLVED = "delta[3:] = -np.linalg.solve(H[3:, 3:], b[3:])"
ADDED = "moved = poses + delta.reshape(n, 3)"
WRAPPED = "    moved[:, 2] = wrap(moved[:, 2])\n"
ERROR = "e = error(poses[i], poses[j], z)"
TURNED = "; t = np.eye(3); c, s = np.cos(z[2]), np.sin(z[2]); t[:2, :2] = [[c, -s], [s, c]]; L = {}"
GAUGE = (
    "Pose 0 moved. Edges tell where poses lie to each other, not where all of them lie: H is "
    "singular, and what solves it is one of many. Hold pose 0: leave out its three rows and columns."
)
TRANSPOSED = (
    "A transpose is missing or on the wrong side. H is the sum of JᵀΛJ and b that of JᵀΛe: the "
    "*first* J of each is transposed."
)


def _several(count):
    return f"""
def step(poses, edges):
    for _ in range({count}):
        poses = one_step(poses, edges)
    return poses


def one_step(poses, edges):
{BLOCKS.split(chr(10), 2)[2]}"""


SLIPS = (
    Slip(
        "sign-of-b",
        "The poses move away from the best ones: H δ = −b, with a minus. As it is, χ² grows.",
        _in((ADDED, "moved = poses - delta.reshape(n, 3)")),
    ),
    Slip(
        "half-a-step",
        "The step has the right direction and another length. δ is added as it is solved: a smaller "
        "one needs more rounds, a larger one overshoots.",
        _in((ADDED, "moved = poses + 0.5 * delta.reshape(n, 3)")),
        _in((ADDED, "moved = poses + 2 * delta.reshape(n, 3)")),
    ),
    Slip(
        "step-alone",
        "What came back is δ, the step. Add it to the poses.",
        _in((ADDED, "moved = delta.reshape(n, 3)")),
    ),
    Slip(
        "composed",
        "The step was put on with ⊕. A and B are slopes by x, y and θ themselves: add δ to the "
        "numbers, and then wrap.",
        _in((ADDED, "moved = compose(poses, delta.reshape(n, 3))")),
        _in((ADDED, "moved = compose(delta.reshape(n, 3), poses)")),
    ),
    Slip(
        "another-pose-held",
        "A pose stays where it is, but it is not pose 0: strike out the *first* three rows and columns.",
        _in((SOLVED, "delta[:-3] = -np.linalg.solve(H[:-3, :-3], b[:-3])")),
    ),
    Slip(
        "one-row-held",
        "Only one of pose 0's numbers is held. It has three, so three rows and columns are left out.",
        _in((SOLVED, "delta[1:] = -np.linalg.lstsq(H[1:, 1:], b[1:], rcond=1e-10)[0]")),
    ),
    Slip(
        "gauge-free",
        GAUGE,
        _in((SOLVED, "delta = -np.linalg.lstsq(H, b, rcond=1e-10)[0]")),
    ),
    Slip(
        "damped",
        "H was made regular by something on its diagonal. That shortens the step of every pose and "
        "still lets pose 0 move: hold pose 0 instead.",
        _in((SOLVED, "delta = -np.linalg.solve(H + 0.1 * np.eye(3 * n), b)")),
        _in((SOLVED, "delta = -np.linalg.solve(H + np.eye(3 * n), b)")),
        _in((SOLVED, "delta = -np.linalg.solve(H + 1e-3 * np.eye(3 * n), b)")),
    ),
    Slip(
        "put-back",
        "Pose 0 was put back after a step in which it had moved: the others were moved with it, and "
        "no longer fit. Leave its rows and columns out before you solve.",
        _in((SOLVED, "delta = -np.linalg.lstsq(H, b, rcond=1e-10)[0]; delta[:3] = 0")),
    ),
    Slip(
        "columns-not-held",
        "Pose 0 is struck out of H, but H has been solved with another b: rows, columns and b belong "
        "together.",
        _in((SOLVED, "delta[3:] = -np.linalg.solve(H[3:, 3:], b[:-3])")),
    ),
    Slip(
        "not-wrapped",
        "The step is right, but a heading went beyond π: wrap the headings after you have added δ.",
        _in((WRAPPED, "")),
        _in((WRAPPED, ""), (SOLVED, SOLVED + "; delta[2::3] = wrap(delta[2::3])")),
    ),
    Slip(
        "wrapped-to-a-turn",
        "The headings come back between 0 and 2π. They have to lie between −π and π.",
        _in((WRAPPED, "    moved[:, 2] %= 2 * np.pi\n")),
    ),
    Slip(
        "all-wrapped",
        "Metres are wrapped as if they were angles: only the third number of a pose is one.",
        _in((WRAPPED, "    moved = wrap(moved)\n")),
    ),
    Slip(
        "information-ignored",
        "Λ was not used: every edge counts alike, and metres as much as radians.",
        _in((ERROR, ERROR + "; L = np.eye(3)")),
    ),
    Slip(
        "information-diagonal",
        "Of Λ only the diagonal was used, or it was multiplied entry by entry. Errors of one edge are "
        "correlated: the whole matrix counts.",
        _in((ERROR, ERROR + "; L = np.diag(np.diag(L))")),
    ),
    Slip(
        "covariance-for-information",
        "Λ was inverted, but it is the information, the inverse of the covariance, already. A sure "
        "edge has a large Λ and pulls hard.",
        _in((ERROR, ERROR + "; L = np.linalg.inv(L)")),
    ),
    Slip(
        "information-squared",
        "Λ enters twice, or as its root: it stands once between Jᵀ and J, and once between Jᵀ and e.",
        _in((ERROR, ERROR + "; L = L @ L")),
        _in((ERROR, ERROR + "; L = np.linalg.cholesky(L)")),
    ),
    Slip(
        "information-turned",
        "Λ was turned by θ_z. It is the information of e already: whoever made the edge has turned it.",
        _in((ERROR, ERROR + TURNED.format("t.T @ L @ t"))),
        _in((ERROR, ERROR + TURNED.format("t @ L @ t.T"))),
    ),
    Slip(
        "information-in-one",
        "Λ stands in one of H and b only. Both come from eᵀΛe: H has JᵀΛJ, b has JᵀΛe.",
        _terms(*4 * [None], "A.T @ e", "B.T @ e"),
        _terms("A.T @ A", "A.T @ B", "B.T @ A", "B.T @ B"),
    ),
    Slip(
        "transpose",
        TRANSPOSED,
        _terms(*4 * [None], "A @ L @ e", "B @ L @ e"),
        _terms("A @ L @ A", "A @ L @ B", "B @ L @ A", "B @ L @ B"),
        _terms("A @ L @ A.T", "A @ L @ B.T", "B @ L @ A.T", "B @ L @ B.T"),
        _terms("A @ L @ A", "A @ L @ B", "B @ L @ A", "B @ L @ B", "A @ L @ e", "B @ L @ e"),
        _terms(
            "A @ L @ A.T", "A @ L @ B.T", "B @ L @ A.T", "B @ L @ B.T", "A @ L @ e", "B @ L @ e"
        ),
    ),
    Slip(
        "overwritten",
        "Each edge replaces what the edges before it wrote. A pose hangs on several edges, and their "
        "parts are added: += and not =.",
        *(
            _in(*((f"{part} +=", f"{part} =") for part in some))
            for k in range(1, 7)
            for some in combinations(TERMS, k)
        ),
        ("b += J.T", "b = J.T"),
        [
            ("H += J.T", "H = J.T"),
            ("b += J.T", "b = J.T"),
            ("np.linalg.solve(H[3:, 3:], b[3:])", "np.linalg.pinv(H[3:, 3:]) @ b[3:]"),
        ],
    ),
    Slip(
        "no-cross-blocks",
        "The blocks between the poses are missing. An edge ties i and j together: AᵀΛB stands in rows "
        "i, columns j, and BᵀΛA in rows j, columns i.",
        _in(("        H[I, J] += A.T @ L @ B\n", ""), ("        H[J, I] += B.T @ L @ A\n", "")),
    ),
    Slip(
        "half-of-cross",
        "Only one of the two blocks between i and j is there: H is symmetric, with AᵀΛB in rows i, "
        "columns j and its transpose in rows j, columns i.",
        _in(("        H[J, I] += B.T @ L @ A\n", "")),
        _in(("        H[I, J] += A.T @ L @ B\n", "")),
    ),
    Slip(
        "cross-exchanged",
        "Blocks have changed places: rows of i take Aᵀ, and rows of j take Bᵀ.",
        _terms(None, "B.T @ L @ A", "A.T @ L @ B"),
        _terms(*4 * [None], "B.T @ L @ e", "A.T @ L @ e"),
        _terms("B.T @ L @ B", None, None, "A.T @ L @ A"),
    ),
    Slip(
        "cross-sign",
        "The blocks between i and j have the wrong sign. A brings its own minus: none is added.",
        _terms(None, "-A.T @ L @ B", "-B.T @ L @ A"),
    ),
    Slip(
        "one-pose-only",
        "Only pose j feels its edges: pose i is part of every edge as well, through A.",
        _in(("        H[I, I] += A.T @ L @ A\n", ""), ("        b[I] += A.T @ L @ e\n", "")),
        _in(("        b[I] += A.T @ L @ e\n", "")),
    ),
    Slip(
        "edge-turned-round",
        "Some edges point back, from a later pose to an earlier one, and they were turned round. Their "
        "z is still pose j as seen from pose i.",
        _in(("        A, B =", "        i, j = min(i, j), max(i, j)\n        A, B =")),
    ),
    Slip(
        "loops-left-out",
        "Edges between poses that do not follow one another are left out: these are the loops.",
        _in(("        A, B =", "        if abs(i - j) > 1:\n            continue\n        A, B =")),
    ),
    Slip(
        "edge-left-out",
        "The last edge is left out.",
        _in(("in edges:", "in edges[:-1] or edges:")),
    ),
    Slip(
        "several-steps",
        "This is more than one step. Whoever calls step goes on as long as needed.",
        *(_several(count) for count in (2, 3, 4, 5, 10, 20)),
    ),
    Slip(
        "gradient",
        "The poses go down the slope b, but H is not used. H⁻¹ is what tells how far to go.",
        _in((SOLVED, "delta[3:] = -b[3:]")),
        _in((SOLVED, "delta[3:] = -b[3:] / np.diag(H)[3:]")),
    ),
    Slip(
        "turned-in-order",
        "δ has come out of order: it holds x, y and θ of pose 1, then those of pose 2, and so on.",
        _in((ADDED, "moved = poses + delta.reshape(3, n).T")),
    ),
)

STUMBLES = (
    Stumble("malformed", _in(("return moved", "return delta")), _in(("return moved", "pass"))),
    Stumble("raised", _in((SOLVED, "delta = -np.linalg.solve(H[3:, 3:], b)"))),
    Stumble("raised", _in(("n = len(poses)", "n = 3"))),
)
