"""Programs of task 03-ghosts."""

from course.tasks import Slip, Stumble

TASK = "03-ghosts"

MUTANTS = 200  # a run takes long

WAYS = {
    "by logarithms": """
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x, P = F @ x + u, F @ P @ F.T + Q
        v, S = z - H @ x, H @ P @ H.T + R
        K = np.linalg.solve(S, H @ P).T
        odds = np.log((1 - GHOSTS) / GHOSTS * REACH) - v @ np.linalg.solve(S, v) / 2
        odds = odds - np.linalg.slogdet(2 * np.pi * S)[1] / 2
        share = 1 / (1 + np.exp(-odds))
        rest = np.eye(2) - K @ H
        taken = rest @ P @ rest.T + K @ R @ K.T
        a, b = x, x + K @ v
        x = (1 - share) * a + share * b
        P = (1 - share) * (P + np.outer(a - x, a - x)) + share * (taken + np.outer(b - x, b - x))
        xs.append(x)
        Ps.append(P)
    return xs, Ps
""",
    "number by number": """
def wary_filter(x, P, us, zs, F, Q, H, R):
    noise = R[0, 0]
    xs, Ps = np.zeros_like(us), np.zeros((len(us), 2, 2))
    for k in range(len(us)):
        x = F @ x + us[k]
        P = F @ P @ F.T + Q
        S = P[0, 0] + noise
        v = zs[k, 0] - x[0]
        real = 0.75 * np.exp(-0.5 * v**2 / S) / np.sqrt(2 * np.pi * S)
        w = real / (real + 0.25 / 10)
        K = P[:, 0] / S
        P = P - (w - w * (1 - w) * v**2 / S) * S * np.outer(K, K)
        x = x + w * v * K
        xs[k], Ps[k] = x, P
    return xs, Ps
""",
    "several cases": """
def wary_filter(x, P, us, zs, F, Q, H, R):
    weights, means, doubts, xs, Ps = np.ones(1), x[None], P[None], [], []
    for u, z in zip(us, zs):
        means, doubts = means @ F.T + u, F @ doubts @ F.T + Q
        v, S = z[0] - means[:, 0], doubts[:, 0, 0] + R[0, 0]
        K = doubts[:, :, 0] / S[:, None]
        real = (1 - GHOSTS) * np.exp(-v * v / S / 2) / np.sqrt(2 * np.pi * S)
        weights = np.append(weights * GHOSTS / REACH, weights * real)
        doubts = np.append(doubts, doubts - np.einsum("c,ci,cj->cij", S, K, K), axis=0)
        means = np.append(means, means + K * v[:, None], axis=0)
        best = np.argsort(weights)[-4:]
        weights, means, doubts = weights[best] / weights[best].sum(), means[best], doubts[best]
        xs.append(weights @ means)
        off = means - xs[-1]
        Ps.append(np.einsum("c,cij->ij", weights, doubts) + (weights * off.T) @ off)
    return xs, Ps
""",
    "a guess of one third": """
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x, P = predict(x, P, F, Q)
        x = x + u
        v, S = innovation(x, P, z, H, R)
        K = P @ H.T @ np.linalg.inv(S)
        ghost = np.sqrt(S[0, 0]) / 8
        share = 1 / (1 + ghost * np.exp(min(v[0] ** 2 / S[0, 0] / 2, 700)))
        P = P - share * K @ H @ P + share * (1 - share) * np.outer(K @ v, K @ v)
        x = x + share * K @ v
        xs.append(x)
        Ps.append(P)
    return xs, Ps
""",
}

ORDINARY = """
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x, P = predict(x, P, F, Q)
        x, P = update(x + u, P, z, H, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
"""

PASTED = {
    "the lesson's filter": ORDINARY,
    "Joseph's form": """
def wary_filter(x, P, us, zs, F, Q, H, R):
    beliefs = []
    for u, z in zip(us, zs):
        x, P = F @ x + u, F @ P @ F.T + Q
        v = z - H @ x
        S = H @ P @ H.T + R
        K = P @ H.T @ np.linalg.inv(S)
        rest = np.eye(len(P)) - K @ H
        x, P = x + K @ v, rest @ P @ rest.T + K @ R @ K.T
        beliefs.append((x, P))
    return [np.array(values) for values in zip(*beliefs, strict=True)]
""",
    "task 3 with the pushes left out": """
def wary_filter(x, P, us, zs, F, Q, H, R):
    return kalman_filter(x, P, zs, F, Q, H, R)
""",
}

SHARE = "share = real / (real + GHOSTS / REACH)"


def gate(sigmas, refused="x, P"):
    """A filter that takes a reading in only if it lies within so many σ."""
    return f"""
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x, P = predict(x, P, F, Q)
        x = x + u
        v, S = innovation(x, P, z, H, R)
        x, P = update(x, P, z, H, R) if v @ np.linalg.inv(S) @ v < {sigmas**2} else ({refused})
        xs.append(x)
        Ps.append(P)
    return xs, Ps
"""


SLIPS = (
    Slip(
        "ordinary",
        "This is the lesson's filter: it takes every ghost for a measurement. Which readings does it "
        "itself find hard to believe?",
        ORDINARY,
    ),
    Slip(
        "u-forgotten",
        "What the cart's own sensors tell is not in your prediction: u is added to the state in each "
        "step.",
        ("        x = x + u\n", ""),
        PASTED["task 3 with the pushes left out"],
    ),
    Slip(
        "nothing-believed",
        "No reading is taken in: three in four are good, and would tell where the cart is.",
        (SHARE, "share = 0"),
    ),
    Slip(
        "R-raised",
        "A larger R trusts all readings less, the good ones, too. What is wanted is less trust in those "
        "that do not fit.",
        ORDINARY.replace("z, H, R)\n", "z, H, 20 * R)\n"),
        ORDINARY.replace("z, H, R)\n", "z, H, R + REACH**2 / 12)\n"),
        ORDINARY.replace("z, H, R)\n", "z, H, R + GHOSTS * REACH**2 / 12)\n"),
    ),
    Slip(
        "narrow-gate",
        "Your gate refuses many right measurements, stays as sure as before, and refuses all the others "
        "once the belief is wrong.",
        gate(1),
        gate(1.5),
    ),
    Slip(
        "wide-gate",
        "A gate this wide lets ghosts through. After one of them the belief is wrong and sure of itself, "
        "and then everything right may be refused.",
        gate(6),
        gate(10),
    ),
    Slip(
        "gate-without-the-step",
        "Where a reading is refused, the belief has to be the prediction: the cart has moved all the "
        "same.",
        gate(3)
        .replace("xs, Ps = [], []", "xs, Ps, old = [], [], (x, P)")
        .replace("else (x, P)", "else old\n        old = x, P"),
    ),
    Slip(
        "gate-in-metres",
        "Your gate is as wide as R says. How far off a right reading may be depends on S: the belief "
        "errs, too.",
        gate(3).replace("np.linalg.inv(S)", "np.linalg.inv(R)"),
        gate(2).replace("np.linalg.inv(S)", "np.linalg.inv(R)"),
    ),
    Slip(
        "P-as-if-real",
        "x takes a share of the reading in, and P all of it. What is only half believed can only half "
        "reduce the doubt.",
        ("apart - share * S", "-S"),
    ),
    Slip(
        "P-never-updated",
        "P is only predicted: it grows, and soon every ghost fits.",
        ("P = P + (apart - share * S) * np.outer(K, K)", "P = P"),
    ),
    Slip(
        "ghosts-everywhere",
        "A ghost says any of ten metres: how likely is it that it says just this number? You took it for "
        "far more likely.",
        ("GHOSTS / REACH", "GHOSTS * REACH"),
    ),
    Slip(
        "exponent",
        "The exponent of the bell is wrong: it is minus one half of the squared innovation in units of "
        "its variance.",
        ("-(v**2) / S / 2", "-(v**2) * S / 2"),
        ("-(v**2) / S / 2", "-(v**2) / 2"),
    ),
    Slip(
        "R-for-S-in-the-bell",
        "The bell of a right reading is as wide as S says, not R: the belief errs, too.",
        (
            "np.exp(-(v**2) / S / 2) / np.sqrt(2 * np.pi * S)",
            "np.exp(-(v**2) / R.item() / 2) / np.sqrt(2 * np.pi * R.item())",
        ),
    ),
    Slip(
        "cases-swapped",
        "The two cases are swapped: you take in the share of the ghost, and leave the share of the "
        "measurement.",
        (
            SHARE,
            "share = GHOSTS / REACH / (real + GHOSTS / REACH)",
        ),
    ),
    Slip(
        "one-share",
        "The same share is taken in of every reading. A ghost shows by what it says: the share must "
        "depend on the innovation.",
        (SHARE, "share = 1 - GHOSTS"),
        (SHARE, "share = 0.5"),
    ),
    Slip(
        "clipped",
        "A ghost still moves your belief by a fixed length. What is too far off to be true should move it "
        "less and less, the farther off it is.",
        ORDINARY.replace(
            "x, P = update(x + u, P, z, H, R)",
            "x = x + u\n        v, S = innovation(x, P, z, H, R)\n"
            "        most = 2 * np.sqrt(S[0, 0])\n"
            "        x, P = update(x, P, H @ x + np.clip(v, -most, most), H, R)",
        ),
    ),
    Slip(
        "trusted-less",
        "Innovations that are too large are trusted less, which is a good beginning; but some of every "
        "ghost is left in x, and P knows nothing of it.",
        ORDINARY.replace(
            "x, P = update(x + u, P, z, H, R)",
            "x = x + u\n        v, S = innovation(x, P, z, H, R)\n"
            "        far = max(1, abs(v[0]) / np.sqrt(S[0, 0]) / 1.5)\n"
            "        x, P = update(x, P, z, H, far * S - H @ P @ H.T)",
        ),
    ),
    Slip(
        "doubt-inflated",
        "Your P is larger than the errors are: it is honest to doubt, but no more than one has to.",
        ("np.array(xs), np.array(Ps)", "np.array(xs), 3 * np.array(Ps)"),
        ("np.array(xs), np.array(Ps)", "np.array(xs), 100 * np.array(Ps)"),
    ),
    Slip(
        "too-sure",
        "Your P is smaller than the errors are.",
        ("np.array(xs), np.array(Ps)", "np.array(xs), np.array(Ps) / 3"),
        ("np.array(xs), np.array(Ps)", "np.array(xs), np.array(Ps) ** 2"),
    ),
    Slip(
        "start-told",
        "The start stands first and the last belief is missing: what is asked for is the belief after "
        "each reading.",
        [
            ("xs, Ps = [], []", "xs, Ps = [x], [P]"),
            ("np.array(xs), np.array(Ps)", "np.array(xs[:-1]), np.array(Ps[:-1])"),
        ],
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        ("np.array(xs), np.array(Ps)", "np.array(xs)"),
        ("np.array(xs), np.array(Ps)", "x, P"),
        ("xs, Ps = [], []", "xs, Ps = [x], [P]"),
    ),
    Stumble("raised", ("x = x + u", "x = x + G @ u")),
)

EQUIVALENT = {
    " -> ": "any method goes: what still clears the top step is as right as the solution",
}
