"""Right ways and slips of 05-lost: some methods that find the robot, and some that do not."""

from course.tasks import Slip, Stumble

TASK = "05-lost"
MUTANTS = 24

HEAD = "def find_yourself(x, P, drives, ids, zs, landmarks, C, R):\n"
TOOLS = '''
def surprise(x, P, z, p, R):
    """How far a sight is off, in units of what is expected: χ² with two degrees of freedom."""
    v = z - h(x, p)
    v[1] = wrap(v[1])
    H = H_robot(x, p)
    return v @ np.linalg.solve(H @ P @ H.T + R, v)


def gated(x, P, drives, ids, zs, landmarks, C, R, gate=11):
    """Beliefs after every step, and the sum of all surprises, each as large as the gate at most."""
    xs, Ps, cost = [], [], 0.0
    for u, id, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        if id >= 0:
            d2 = surprise(x, P, z, landmarks[id], R)
            cost += min(d2, gate)
            if d2 < gate:
                x, P = locate(x, P, z, landmarks[id], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps), cost


def headed(x, P, heading, sigma=0.15):
    """The start's belief with a heading of one's own."""
    P = P.copy()
    P[2], P[:, 2], P[2, 2] = 0, 0, sigma**2
    return np.array([x[0], x[1], heading]), P

'''

WAYS = {
    "a bank of filters for the first steps": TOOLS
    + HEAD
    + """    def cost(heading):
        return gated(*headed(x, P, heading), drives[:14], ids[:14], zs[:14], landmarks, C, R)[2]

    best = min(np.arange(20) * np.pi / 10, key=cost)
    return gated(*headed(x, P, best), drives, ids, zs, landmarks, C, R)[:2]
""",
    "where most sights would turn it": TOOLS
    + HEAD
    + """    turned, place, votes = 0.0, [0j], []
    for u, id, z in list(zip(drives, ids, zs))[:24]:
        place.append(place[-1] + u[0] * np.exp(1j * turned))
        turned += u[1]
        if id >= 0:
            # as seen with heading 0 at the start, and where it is: the angle between them
            seen = place[-1] + z[0] * np.exp(1j * (turned + z[1]))
            there = complex(*(landmarks[id] - x[:2]))
            if abs(abs(seen) - abs(there)) < 0.7:
                votes.append(np.angle(there / seen))
    votes = np.array(votes)
    near = np.abs(wrap(votes[:, None] - votes)) < 0.25
    best = near.sum(axis=1).argmax()
    heading = votes[best] + wrap(votes[near[best]] - votes[best]).mean()
    return gated(*headed(x, P, heading), drives, ids, zs, landmarks, C, R, 9.5)[:2]
""",
    "the best of many tracks, place and heading": TOOLS
    + HEAD
    + """    off = np.array([(i, j) for i in (-0.2, 0, 0.2) for j in (-0.2, 0, 0.2)])
    headings = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    start = np.array([[x[0] + i, x[1] + j, t] for t in headings for i, j in off])
    at, cost = start, 0.0
    for u, id, z in list(zip(drives, ids, zs))[:18]:
        at = f_odometry(at.T, u).T
        if id >= 0:
            v = z - h(at, landmarks[id])
            cost = cost + np.minimum((v[:, 0] / 0.3) ** 2 + (wrap(v[:, 1]) / 0.1) ** 2, 8)
    return gated(*headed(x, P, start[np.argmin(cost)][2]), drives, ids, zs, landmarks, C, R)[:2]
""",
}

GATED = TOOLS + HEAD + "    return gated(x, P, drives, ids, zs, landmarks, C, R)[:2]\n"
FIXED = "abs(z[0] - h(x, landmarks[id])[0])", "np.hypot(*(z - h(x, landmarks[id])))"
BY_ONE = (
    TOOLS
    + HEAD
    + """    k = np.flatnonzero(ids >= 0)[0]
    ahead = h(np.array([x[0], x[1], 0]), landmarks[ids[k]])[1]
    heading = ahead - zs[k][1] - drives[: k + 1, 1].sum()
    x, P = headed(x, P, heading)
    return gated(x, P, drives, ids, zs, landmarks, C, R)[:2]
"""
)
PLAIN = HEAD + "    return localise(x, P, drives, ids, zs, landmarks, C, R)\n"

SLIPS = (
    Slip(
        "localise",
        "This is the lesson's filter: it believes every sight, and begins with a heading that tells nothing. "
        "Which headings are possible, and what speaks for each?",
        PLAIN,
    ),
    Slip(
        "every-sight-believed",
        "The heading may be right, but every sight is believed, the false ones too. Does a sight agree with "
        "what the filter expects, as far as the filter knows?",
        ("< 9.2", "< np.inf"),
        ("< 9.2", "< 1e4"),
    ),
    Slip(
        "nothing-believed",
        "Hardly any sight was believed, so that the robot only counts its wheels. How far off may a true "
        "sight be?",
        ("< 9.2", "< 0"),
        ("< 9.2", "< 0.02"),
    ),
    Slip(
        "gate-turned", "Sights that agree were thrown away and the others used.", ("< 9.2", "> 9.2")
    ),
    Slip(
        "heading-of-the-start",
        "The filter doubts its sights, but begins with a heading that tells nothing: with it, true sights "
        "look false as well.",
        *(GATED.replace("gate=11", f"gate={most}") for most in (5.99, 9, 9.21, 11, 13.8, 16, 25)),
        *(GATED.replace("d2 < gate", f"{off} < {most}") for off in FIXED for most in (0.5, 1, 2)),
    ),
    Slip(
        "heading-by-one-sight",
        "The heading was taken from a single sight, which may be false: ask several.",
        BY_ONE,
    ),
    Slip(
        "worst-heading",
        "The heading was chosen with which the sights agree least.",
        ("np.argmin", "np.argmax"),
    ),
    Slip(
        "P-made-up",
        "P does not say how far the robots are off: nobody is so sure, or so unsure.",
        ("Ps.append(P)", "Ps.append(P / 100)"),
        ("Ps.append(P)", "Ps.append(100 * P)"),
        ("Ps.append(P)", "Ps.append(np.eye(3))"),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        ("return np.array(xs), np.array(Ps)", "return x, P"),
        ("return np.array(xs), np.array(Ps)", "return np.array(xs)"),
    ),
    Stumble("raised", ("np.argmin(np.sum(costs, axis=0))", "np.sum(costs, axis=0)")),
)

PASTED = {
    "the lesson's filter": PLAIN,
    "the lesson's filter with doubtful sights": PLAIN.replace("C, R)\n", "C, 10 * R)\n").replace(
        "landmarks, C, 10 * R):", "landmarks, C, R):"
    ),
}

EQUIVALENT = {"": "any method goes: whatever reaches the highest step is right"}
