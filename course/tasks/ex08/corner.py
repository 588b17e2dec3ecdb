"""Programs of 08-corner."""

from course.tasks import Edit, Slip, Stumble

TASK = "08-corner"

_LINES = "N = np.array([[np.cos(z[1]), np.sin(z[1])] for z in (z1, z2)])"
_HALVES = """
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z1[1]), np.sin(z1[1])], [np.cos(z2[1]), np.sin(z2[1])]])
    p = np.linalg.solve(N, np.array([z1[0], z2[0]]))
    T = np.array([[-N[0, 1], N[0, 0]], [-N[1, 1], N[1, 0]]])
    lever = T @ p
    D = np.zeros((2, 2))
    D[0, 0] = R1[0, 0] - 2 * lever[0] * R1[0, 1] + lever[0] ** 2 * R1[1, 1]
    D[1, 1] = R2[0, 0] - 2 * lever[1] * R2[0, 1] + lever[1] ** 2 * R2[1, 1]
    half = np.linalg.solve(N, D)
    return p, np.linalg.solve(N, half.T).T
"""

WAYS = {
    "solve instead of inv": _HALVES,
    "by differences": """
def corner(z1, R1, z2, R2):
    def place(v):
        N = [[np.cos(v[1]), np.sin(v[1])], [np.cos(v[3]), np.sin(v[3])]]
        return np.linalg.solve(N, v[[0, 2]])
    R = np.zeros((4, 4))
    R[:2, :2], R[2:, 2:] = R1, R2
    v, h = np.concatenate([z1, z2]), 1e-5
    J = np.column_stack([(place(v + e) - place(v - e)) / (2 * h) for e in h * np.eye(4)])
    return list(place(v)), J @ R @ J.T
""",
    "written out": """
def corner(z1, R1, z2, R2):
    (r1, a1), (r2, a2) = z1, z2
    s = np.sin(a2 - a1)
    c = np.cos(a2 - a1)
    x = (r1 * np.sin(a2) - r2 * np.sin(a1)) / s
    y = (r2 * np.cos(a1) - r1 * np.cos(a2)) / s
    first = np.array([np.sin(a2), -np.cos(a2)]) / s
    second = np.array([-np.sin(a1), np.cos(a1)]) / s
    J1 = np.column_stack([first, first * (r1 * c - r2) / s])
    J2 = np.column_stack([second, second * (r1 - r2 * c) / s])
    return (x, y), J1 @ R1 @ J1.T + J2 @ R2 @ J2.T
""",
    "one Jacobian of four columns": """
def corner(z1, R1, z2, R2):
    n = [np.array([np.cos(z[1]), np.sin(z[1])]) for z in (z1, z2)]
    back = np.linalg.inv(np.vstack(n))
    p = back @ [z1[0], z2[0]]
    inner = np.zeros((2, 4))
    for k in range(2):
        inner[k, 2 * k : 2 * k + 2] = 1, p[0] * n[k][1] - p[1] * n[k][0]
    J = back @ inner
    R = np.block([[R1, np.zeros((2, 2))], [np.zeros((2, 2)), R2]])
    return p, np.einsum("ia,ab,jb->ij", J, R, J)
""",
    "complex numbers": """
def corner(z1, R1, z2, R2):
    n1, n2 = np.exp(1j * z1[1]), np.exp(1j * z2[1])
    det = (n1.conjugate() * n2).imag
    p = 1j * (z2[0] * n1 - z1[0] * n2) / det
    P = 0
    for n, away, R in ((n1, -1j * n2, R1), (n2, 1j * n1, R2)):
        lever = (1j * n * p.conjugate()).real
        size = np.array([1, -lever]) @ R @ np.array([1, -lever]) / det**2
        P = P + size * np.outer([away.real, away.imag], [away.real, away.imag])
    return [p.real, p.imag], P
""",
}

SLIPS = (
    Slip(
        "polar",
        "p is given as range and bearing. It is asked for as x and y.",
        ("return p, P", "return [np.hypot(*p), np.arctan2(p[1], p[0])], P"),
    ),
    Slip(
        "N-transposed",
        "N stands transposed: each line is a row, since n₁·p = ρ₁ and n₂·p = ρ₂.",
        ("p = np.linalg.solve(N, ", "p = np.linalg.solve(N.T, "),
        ("for z in (z1, z2)])", "for z in (z1, z2)]).T"),
    ),
    Slip(
        "direction-for-normal",
        "α is the direction of the wall's *normal*, (cos α, sin α), not that of the wall.",
        (_LINES, "N = np.array([[-np.sin(z[1]), np.cos(z[1])] for z in (z1, z2)])"),
        (_LINES, "N = np.array([[np.sin(z[1]), -np.cos(z[1])] for z in (z1, z2)])"),
    ),
    Slip(
        "sine-for-cosine",
        "Sine and cosine have changed places in the normal: it is (cos α, sin α).",
        (_LINES, "N = np.array([[np.sin(z[1]), np.cos(z[1])] for z in (z1, z2)])"),
    ),
    Slip(
        "sum-of-feet",
        "The feet of the perpendiculars were added up. That is the corner only where the walls meet at "
        "a right angle; solve n₁·p = ρ₁ and n₂·p = ρ₂.",
        ("np.linalg.solve(N, [z1[0], z2[0]])", "N.T @ [z1[0], z2[0]]"),
    ),
    Slip(
        "mean-of-feet",
        "The feet of the perpendiculars were averaged. A corner is a point that lies on both lines.",
        ("np.linalg.solve(N, [z1[0], z2[0]])", "N.T @ [z1[0], z2[0]] / 2"),
    ),
    Slip(
        "rho-swapped",
        "The ρ of the first line stands beside the normal of the second.",
        ("[z1[0], z2[0]]", "[z2[0], z1[0]]"),
    ),
    Slip(
        "rho-positive",
        "ρ was taken without its sign. A negative ρ is a line on the other side of the origin.",
        ("[z1[0], z2[0]]", "[abs(z1[0]), abs(z2[0])]"),
    ),
    Slip(
        "multiplied",
        "N p = ρ, so p = N⁻¹ ρ: the equations have to be solved.",
        ("np.linalg.solve(N, [z1[0], z2[0]])", "N @ [z1[0], z2[0]]"),
    ),
    Slip(
        "alpha-ignored",
        "P has only the doubt in ρ in it. When α is wrong the wall turns, and the corner slides: "
        "n·dp = dρ − (n′·p) dα.",
        ("[1, -(across @ p)]", "[1, 0]"),
    ),
    Slip(
        "rho-ignored",
        "P has only the doubt in α in it. When ρ is wrong the wall moves, and the corner with it: "
        "n·dp = dρ − (n′·p) dα.",
        ("[1, -(across @ p)]", "[0, -(across @ p)]"),
    ),
    Slip(
        "no-lever",
        "An error dα moves the wall at the corner by (n′·p) dα: the farther the corner, the more. The "
        "factor n′·p is missing.",
        ("[1, -(across @ p)]", "[1, -1]"),
        ("[1, -(across @ p)]", "[1, 1]"),
    ),
    Slip(
        "lever-sign",
        "The sign before (n′·p) dα is turned: n·dp = dρ − (n′·p) dα. It matters because the errors of ρ "
        "and α are correlated.",
        ("[1, -(across @ p)]", "[1, across @ p]"),
    ),
    Slip(
        "lever-is-normal",
        "The lever is n·p, which is just ρ. The derivative of (cos α, sin α) is (−sin α, cos α), a "
        "quarter turn from the normal.",
        ("[-N[k, 1], N[k, 0]]", "N[k]"),
    ),
    Slip(
        "lever-is-distance",
        "The lever is how far the corner is *along* the wall from the foot of the perpendicular, not "
        "how far it is from the origin.",
        ("-(across @ p)", "-np.hypot(*p)"),
    ),
    Slip(
        "same-line-twice",
        "Both lines are carried to the corner by the same derivative, or with the same covariance. "
        "Each has its own.",
        ("np.linalg.inv(N)[:, k]", "np.linalg.inv(N)[:, 0]"),
        ("enumerate((R1, R2))", "enumerate((R1, R1))"),
        ("np.array([-N[k, 1], N[k, 0]])", "np.array([-N[0, 1], N[0, 0]])"),
    ),
    Slip(
        "lines-swapped",
        "The covariance of the first line stands with the derivative of the second.",
        ("enumerate((R1, R2))", "enumerate((R2, R1))"),
        ("np.linalg.inv(N)[:, k]", "np.linalg.inv(N)[:, 1 - k]"),
    ),
    Slip(
        "tie-ignored",
        "Only the variances of R are used. The errors of ρ and α are correlated: use the whole matrix.",
        ("J @ R @ J.T", "J @ np.diag(np.diag(R)) @ J.T"),
    ),
    Slip(
        "one-line",
        "P has only one of the two lines' errors in it. Both err, independently of each other: their "
        "shares add up.",
        ("P = P + J @ R @ J.T", "P = J @ R @ J.T"),
        ("enumerate((R1, R2))", "enumerate((R1,))"),
    ),
    Slip(
        "difference",
        "The two shares of P are subtracted. Independent errors add their covariances.",
        ("P = P + J @ R @ J.T", "P = J @ R @ J.T - P"),
        ("P = P + J @ R @ J.T", "P = P - J @ R @ J.T"),
    ),
    Slip(
        "halved",
        "The two shares of P are averaged. Independent errors add their covariances.",
        ("return p, P", "return p, P / 2"),
    ),
    Slip(
        "standard-deviation",
        "R1 and R2 hold variances already: look where you take a root or a square of them.",
        ("J @ R @ J.T", "J @ (R @ R) @ J.T"),
        ("J @ R @ J.T", "J @ R**2 @ J.T"),
        ("J @ R @ J.T", "J @ np.sqrt(np.abs(R)) @ J.T"),
    ),
    Slip(
        "J-transposed",
        "JᵀR J stands where J R Jᵀ should: the rows of J are x and y, its columns are ρ and α.",
        ("J @ R @ J.T", "J.T @ R @ J"),
    ),
    Slip(
        "N-for-its-inverse",
        "N·dp = …, so dp = N⁻¹·…: the derivatives need the columns of the inverse of N, not N.",
        ("np.linalg.inv(N)[:, k]", "N[:, k]"),
        ("np.linalg.inv(N)[:, k]", "N[k]"),
    ),
    Slip(
        "rows-of-the-inverse",
        "The columns of N⁻¹ are needed, not its rows: line k alone moves the corner by N⁻¹ times the "
        "k-th unit vector.",
        ("np.linalg.inv(N)[:, k]", "np.linalg.inv(N)[k]"),
    ),
    Slip(
        "entries",
        "1 / N inverts every entry. The inverse of the matrix is np.linalg.inv(N).",
        ("np.linalg.inv(N)[:, k]", "(1 / N)[:, k]"),
    ),
    Slip(
        "root-of-P",
        "P is given as standard deviations. It is asked for as a covariance, [m²].",
        ("return p, P", "return p, np.sqrt(np.abs(P))"),
    ),
    Slip(
        "diagonal",
        "P lacks its covariance: the errors of x and y are correlated.",
        ("return p, P", "return p, np.diag(np.diag(P))"),
    ),
    Slip(
        "degrees",
        "α is in radians already: convert nothing.",
        ("[np.cos(z[1]), np.sin(z[1])]", "[np.cos(np.radians(z[1])), np.sin(np.radians(z[1]))]"),
        ("[np.cos(z[1]), np.sin(z[1])]", "[np.cos(np.degrees(z[1])), np.sin(np.degrees(z[1]))]"),
    ),
    Slip(
        "in-place",
        "An argument is changed in place: work on a copy of it.",
        [("P = np.zeros((2, 2))", "P = 0"), ("J = np.outer", "R *= 1.5\n        J = np.outer")],
    ),
    Slip(
        "lever-is-alpha",
        "The lever is how far the corner is along the wall, n′·p: the angle itself is not in it.",
        ("-(across @ p)", "-(z1, z2)[k][1]"),
    ),
)

STUMBLES = (
    Stumble("malformed", ("return p, P", "return P")),
    Stumble("malformed", ("return p, P", "return P, p")),
    Stumble("malformed", ("return p, P", "return p, np.sqrt(np.diag(P))")),
    Stumble("malformed", Edit("written out", (("return (x, y), ", "return x, y, "),))),
    Stumble("raised", ("np.linalg.inv(N)[:, k]", "np.linalg.inv(N)[:, k + 1]")),
    Stumble("not attempted", "def corner(z1, R1, z2, R2):\n    raise NotImplementedError"),
)

EQUIVALENT = {"1e-05": "another step of the differences, as good"}
