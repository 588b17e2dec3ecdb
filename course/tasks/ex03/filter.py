"""Programs of task 03-filter."""

from course.tasks import Edit, Slip, Stumble

TASK = "03-filter"

WAYS = {
    "anew": """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [], []
    for z in zs:
        x, P = F @ x, F @ P @ F.T + Q
        S = H @ P @ H.T + R
        K = P @ H.T @ np.linalg.inv(S)
        x, P = x + K @ (z - H @ x), P - K @ S @ K.T
        xs.append(x)
        Ps.append(P)
    return xs, Ps
""",
    "pairs": """
def kalman_filter(x, P, zs, F, Q, H, R):
    beliefs = []
    for z in zs:
        beliefs.append(update(*predict(x, P, F, Q), z, H, R))
        x, P = beliefs[-1]
    return tuple(zip(*beliefs))
""",
    "filled": """
def kalman_filter(x, P, zs, F, Q, H, R):
    x, P = x.copy(), P.copy()
    xs, Ps = np.zeros((len(zs), len(x))), np.zeros((len(zs), *P.shape))
    for k in range(len(zs)):
        x[:] = F @ x
        P[:] = F @ P @ F.T + Q
        K = np.linalg.solve(H @ P @ H.T + R, H @ P).T
        x += K @ (zs[k] - H @ x)
        P -= K @ H @ P
        xs[k], Ps[k] = x, P
    return xs, Ps
""",
    "columns": """
def kalman_filter(x, P, zs, F, Q, H, R):
    x, out = x.reshape(-1, 1), []
    for z in zs:
        x, P = F @ x, F @ P @ F.T + Q
        K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
        x = x + K @ (z.reshape(-1, 1) - H @ x)
        J = np.eye(len(x)) - K @ H
        P = J @ P @ J.T + K @ R @ K.T
        out.append((x.ravel(), P))
    return [x for x, _ in out], [P for _, P in out]
""",
    "information": """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps, weight = [], [], H.T @ np.linalg.inv(R)
    for z in zs:
        ahead = np.linalg.inv(F @ P @ F.T + Q)
        P = np.linalg.inv(ahead + weight @ H)
        x = P @ (ahead @ F @ x + weight @ z)
        xs += [x]
        Ps += [P]
    return np.stack(xs), np.stack(Ps)
""",
    "recursive": """
def kalman_filter(x, P, zs, F, Q, H, R):
    if len(zs) == 0:
        return np.zeros((0, len(x))), np.zeros((0, *P.shape))
    x, P = update(*predict(x, P, F, Q), zs[0], H, R)
    xs, Ps = kalman_filter(x, P, zs[1:], F, Q, H, R)
    return np.vstack([x, xs]), np.concatenate([P[None], Ps])
""",
}

STEP = "x, P = predict(x, P, F, Q)\n        x, P = update(x, P, z, H, R)"

SLIPS = (
    Slip(
        "start-told",
        "The start stands first and the last belief is missing: what is asked for is the belief after "
        "each measurement.",
        "def kalman_filter(x, P, zs, F, Q, H, R):\n    xs, Ps = [x], [P]\n    for z in zs:\n"
        "        x, P = update(*predict(x, P, F, Q), z, H, R)\n"
        "        xs.append(x)\n        Ps.append(P)\n    return xs[:-1], Ps[:-1]",
    ),
    Slip(
        "wrong-order",
        "The first measurement was taken in before the first step. The start is the belief before the "
        "cart moves: what has to come first?",
        (STEP, "x, P = update(x, P, z, H, R)\n        x, P = predict(x, P, F, Q)"),
        [
            ("x, P = predict(x, P, F, Q)\n        ", ""),
            ("Ps.append(P)", "Ps.append(P)\n        x, P = predict(x, P, F, Q)"),
        ],
    ),
    Slip(
        "predictions-told",
        "These are the predictions. What is asked for are the beliefs after each update.",
        (
            "x, P = update(x, P, z, H, R)\n        xs.append(x)\n        Ps.append(P)",
            "xs.append(x)\n        Ps.append(P)\n        x, P = update(x, P, z, H, R)",
        ),
    ),
    Slip(
        "never-updated",
        "No measurement has entered: these are predictions only.",
        ("x, P = update(x, P, z, H, R)\n        ", ""),
    ),
    Slip(
        "never-predicted",
        "The cart stands still in your filter: something has to happen before each update.",
        ("x, P = predict(x, P, F, Q)\n        ", ""),
    ),
    Slip(
        "begins-again",
        "Each step begins with the start again, or with its P alone. Go on with the x and the P of the "
        "step before.",
        (
            STEP,
            "a, b = predict(x, P, F, Q)\n        a, b = update(a, b, z, H, R)"
            "\n        xs.append(a)\n        Ps.append(b)\n        continue",
        ),
        [("xs, Ps = [], []", "xs, Ps, P0 = [], [], P"), ("predict(x, P,", "predict(x, P0,")],
        [("xs, Ps = [], []", "xs, Ps, x0 = [], [], x"), ("predict(x, P,", "predict(x0, P,")],
    ),
    Slip(
        "gain-kept",
        "The gain of the first step is kept in all others. It belongs to the belief: the surer that is, the "
        "smaller it gets.",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps, K = [], [], None
    for z in zs:
        x, P = predict(x, P, F, Q)
        K = gain(P, H, R) if K is None else K
        x, P = x + K @ (z - H @ x), P - K @ H @ P
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    Slip(
        "P-never-updated",
        "x goes on from update to update, and P is only predicted: it grows and grows. Keep both "
        "results of the update.",
        ("x, P = update(x, P, z, H, R)", "x = update(x, P, z, H, R)[0]"),
    ),
    Slip(
        "x-never-updated",
        "P shrinks with each measurement, and x never learns of any. Keep both results of the update.",
        ("x, P = update(x, P, z, H, R)", "P = update(x, P, z, H, R)[1]"),
    ),
    Slip(
        "x-not-moved",
        "P is predicted and x is not: x has to be moved by F in each step, too.",
        ("x, P = predict(x, P, F, Q)", "P = predict(x, P, F, Q)[1]"),
    ),
    Slip(
        "P-not-moved",
        "x is predicted and P is not: what is known of the state must grow older with every step.",
        ("x, P = predict(x, P, F, Q)", "x = predict(x, P, F, Q)[0]"),
    ),
    Slip(
        "Q-forgotten",
        "Q is missing in the prediction: the filter grows surer and surer, and stops to listen.",
        Edit("anew", ((" + Q", ""),)),
    ),
    Slip(
        "Q-twice-or-late",
        "Q is added twice in a step, or after the update: the truth slips once, before it is measured.",
        (STEP, STEP.replace("x, P = update(x, P,", "x, P = update(x, P + Q,")),
        (STEP, STEP.replace("(x, P, F, Q)", "(x, P, F, 0 * Q)") + "\n        P = P + Q"),
        (STEP, STEP + "\n        P = P + Q"),
    ),
    Slip(
        "Q-deviation",
        "Q holds variances already, in squared units: it is added as it is, without a square or root.",
        ("predict(x, P, F, Q)", "predict(x, P, F, Q @ Q)"),
        ("predict(x, P, F, Q)", "predict(x, P, F, Q**2)"),
        ("predict(x, P, F, Q)", "predict(x, P, F, np.sqrt(Q))"),
    ),
    Slip(
        "R-deviation",
        "R holds variances already, in squared units: it is used as it is, without a square or root.",
        ("update(x, P, z, H, R)", "update(x, P, z, H, R @ R)"),
        ("update(x, P, z, H, R)", "update(x, P, z, H, R**2)"),
        ("update(x, P, z, H, R)", "update(x, P, z, H, np.sqrt(R))"),
    ),
    Slip(
        "F-not-turned",
        "A covariance takes F from the left and Fᵀ from the right: here one of the two is missing, or "
        "they have changed sides.",
        Edit("anew", (("F @ P @ F.T", "F.T @ P @ F"),)),
        Edit("anew", (("F @ P @ F.T", "F @ P @ F"),)),
        Edit("anew", (("F @ P @ F.T", "F @ P"),)),
        Edit("anew", (("F @ P @ F.T", "P @ F.T"),)),
    ),
    Slip(
        "twice-a-step",
        "Something happens twice in each step: one step of the cart, and then one measurement.",
        ("x, P = update", "x, P = predict(x, P, F, Q)\n        x, P = update"),
        ("xs.append(x)", "x, P = update(x, P, z, H, R)\n        xs.append(x)"),
    ),
    Slip(
        "one-measurement",
        "The same measurement is taken in at every step. Each step has a row of its own.",
        ("update(x, P, z,", "update(x, P, zs[0],"),
        ("update(x, P, z,", "update(x, P, zs[-1],"),
        ("update(x, P, z,", "update(x, P, zs.mean(axis=0),"),
    ),
    Slip(
        "late-measurement",
        "The measurements are off by one step, or in the wrong order: after the k-th step the k-th row "
        "is measured.",
        ("for z in zs:", "for z in np.roll(zs, 1, axis=0):"),
        ("for z in zs:", "for z in np.roll(zs, -1, axis=0):"),
        ("for z in zs:", "for z in [zs[0], *zs[:-1]]:"),
        ("for z in zs:", "for z in zs[::-1]:"),
    ),
    Slip(
        "one-object",
        "All your beliefs are the same: a list holds the same array again and again, and that was "
        "changed in place. Write x = x + …, not x += …, or append a copy.",
        Edit(
            "filled",
            (
                (
                    "xs, Ps = np.zeros((len(zs), len(x))), np.zeros((len(zs), *P.shape))",
                    "xs, Ps = [], []",
                ),
                ("xs[k], Ps[k] = x, P", "xs.append(x)\n        Ps.append(P)"),
            ),
        ),
        ("np.array(xs), np.array(Ps)", "[x] * len(zs), [P] * len(zs)"),
        Edit("filled", (("xs[k], Ps[k] = x, P", "xs[:], Ps[:] = x, P"),)),
    ),
    Slip(
        "rounded",
        "Your numbers are rounded, or whole numbers: an array that was made of integers cuts off what "
        "is put into it.",
        ("np.array(xs), np.array(Ps)", "np.round(xs, 2), np.round(Ps, 2)"),
        ("np.array(xs), np.array(Ps)", "np.array(xs).astype(int), np.array(Ps)"),
    ),
    Slip(
        "P-scaled",
        "Your P are all too small or too large by one factor. What is reported is P as it is: the "
        "variances, not some band around them.",
        ("np.array(Ps)", "np.array(Ps) / 10"),
        ("np.array(Ps)", "np.array(Ps) * 10"),
        ("np.array(Ps)", "4 * np.array(Ps)"),
        ("np.array(Ps)", "np.sqrt(np.abs(Ps))"),
    ),
    Slip(
        "backwards",
        "The beliefs stand in the wrong order: the first row belongs to the first measurement.",
        ("np.array(xs), np.array(Ps)", "xs[::-1], Ps[::-1]"),
    ),
    Slip(
        "eight-steps",
        "A number of steps stands in the code. A drive has as many steps as there are rows in zs.",
        "def kalman_filter(x, P, zs, F, Q, H, R):\n    xs, Ps = np.zeros((len(zs), len(x))), "
        "np.zeros((len(zs), *P.shape))\n    for k in range(min(7, len(zs))):\n"
        "        x, P = update(*predict(x, P, F, Q), zs[k], H, R)\n"
        "        xs[k], Ps[k] = x, P\n    return xs, Ps",
    ),
    Slip(
        "update-not-carried-on",
        "What the update finds is told and then forgotten: the next step goes on from the prediction. Go "
        "on with the belief after the measurement.",
        (
            "x, P = update(x, P, z, H, R)\n        xs.append(x)\n        Ps.append(P)",
            "now, left = update(x, P, z, H, R)\n        xs.append(now)\n        Ps.append(left)",
        ),
    ),
)

STUMBLES = (
    Stumble(
        "malformed",
        ("np.array(xs), np.array(Ps)", "x, P"),
        ("np.array(xs), np.array(Ps)", "np.array(xs)"),
        ("xs, Ps = [], []", "xs, Ps = [x], [P]"),
        ("np.array(xs), np.array(Ps)", "xs, [np.diag(P) for P in Ps]"),
        ("Ps.append(P)\n    return", "Ps.append(P)\n        return"),
    ),
    Stumble("raised", ("update(x, P, z, H, R)", "update(x, P, H, z, R)")),
)

EQUIVALENT = {
    "-> P -= K @ H @ P.T": "P is symmetric but for its rounding, which a long drive adds up"
}
