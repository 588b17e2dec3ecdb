"""Solutions of exercise 03 that are wrong in a classic way, and right ones that look different.

The base writes each function for itself, so that a mistake in one leaves the others right.
"""

from tests.bank import Right, Wrong

PREDICT = """
def predict(x, P, F, Q):
    return {x}, {P}
"""

INNOVATION = """
def innovation(x, P, z, H, R):
    return {v}, {S}
"""

GAIN = """
def gain(P, H, R):
    S = {S}
    return {K}
"""

UPDATE = """
def update(x, P, z, H, R):
    I = np.eye(len(x))
    v = {v}
    S = {S}
    K = {K}
    {then}
    return {x}, {P}
"""

FILTER = """
def kalman_filter(x, P, zs, F, Q, H, R):
    x0, P0 = x, P
    xs, Ps = [], []
    for z in zs:
        {before}
        x, P = {predicted}
        {between}
        S = H @ P @ H.T + R
        K = P @ H.T @ np.linalg.inv(S)
        x, P = {updated}
        {after}
    return {result}
"""


def predict(x="F @ x", P="F @ P @ F.T + Q"):
    return PREDICT.format(x=x, P=P)


def innovation(v="z - H @ x", S="H @ P @ H.T + R"):
    return INNOVATION.format(v=v, S=S)


def gain(K="P @ H.T @ np.linalg.inv(S)", S="H @ P @ H.T + R"):
    return GAIN.format(K=K, S=S)


def update(**changes):
    parts = {
        "v": "z - H @ x",
        "S": "H @ P @ H.T + R",
        "K": "P @ H.T @ np.linalg.inv(S)",
        "then": "pass",
        "x": "x + K @ v",
        "P": "P - K @ S @ K.T",
    }
    return UPDATE.format(**(parts | changes))


def filter(**changes):
    parts = {
        "before": "pass",
        "predicted": "F @ x, F @ P @ F.T + Q",
        "between": "pass",
        "updated": "x + K @ (z - H @ x), P - K @ S @ K.T",
        "after": "xs.append(x); Ps.append(P)",
        "result": "xs, Ps",
    }
    return FILTER.format(**(parts | changes))


BASE = "import numpy as np\n" + predict() + innovation() + gain() + update() + filter()

INV = "np.linalg.inv(S)"
P_X, P_P = {"03-predict:mean"}, {"03-predict:covariance"}
I_V, I_S = {"03-innovation:innovation"}, {"03-innovation:covariance"}
K = {"03-gain"}
U_X, U_P = {"03-update:estimate"}, {"03-update:covariance"}
F_X, F_P = {"03-filter:estimates"}, {"03-filter:covariances"}
ALL_F = {"03-filter"}
LUCK = {"03-filter:honest"}  # a wrong filter may look honest at the end of many drives

WRONG = [
    # prediction
    Wrong("x stays", predict(x="x"), P_X, "x-not-moved"),
    Wrong("x as a row", predict(x="x @ F"), P_X, "x-transposed"),
    Wrong(
        "slip drawn for x",
        predict(x="F @ x + np.random.default_rng(5).multivariate_normal(0 * x, Q)"),
        P_X,
        "x-shaken",
    ),
    Wrong("deviations added to x", predict(x="F @ x + np.sqrt(np.diag(Q))"), P_X, "x-shaken"),
    Wrong("x a column", predict(x="(F @ x)[:, None]"), {"03-predict"}, None, "malformed"),
    Wrong("no Q", predict(P="F @ P @ F.T"), P_P, "Q-forgotten"),
    Wrong("P not carried", predict(P="P + Q"), P_P, "P-not-carried"),
    Wrong("P as it was", predict(P="P"), P_P, "P-not-carried"),
    Wrong("P is Q", predict(P="Q"), P_P, "P-not-carried"),
    Wrong("Fᵀ P F", predict(P="F.T @ P @ F + Q"), P_P, "transposed"),
    Wrong("F P F", predict(P="F @ P @ F + Q"), P_P, "transpose-missing"),
    Wrong("F P", predict(P="F @ P + Q"), P_P, "transpose-missing"),
    Wrong("P Fᵀ", predict(P="P @ F.T + Q"), P_P, "transpose-missing"),
    Wrong("minus Q", predict(P="F @ P @ F.T - Q"), P_P, "Q-subtracted"),
    Wrong("Q carried, too", predict(P="F @ (P + Q) @ F.T"), P_P, "Q-carried"),
    Wrong("Q squared", predict(P="F @ P @ F.T + Q @ Q"), P_P, "Q-deviation"),
    Wrong("Q squared by entries", predict(P="F @ P @ F.T + Q**2"), P_P, "Q-deviation"),
    Wrong("root of Q", predict(P="F @ P @ F.T + np.sqrt(Q)"), P_P, "Q-deviation"),
    Wrong("F by entries", predict(P="F * P * F.T + Q"), P_P),
    Wrong("x by entries", predict(x="F * x"), {"03-predict"}, None, "malformed"),
    Wrong(
        "only P",
        "def predict(x, P, F, Q):\n    return F @ P @ F.T + Q\n",
        {"03-predict"},
        None,
        "malformed",
    ),
    Wrong(
        "P and x swapped",
        predict(x="F @ P @ F.T + Q", P="F @ x"),
        {"03-predict"},
        None,
        "malformed",
    ),
    Wrong(
        "nothing returned",
        "def predict(x, P, F, Q):\n    pass\n",
        {"03-predict"},
        None,
        "malformed",
    ),
    Wrong("nan", predict(P="np.nan * P"), {"03-predict"}, None, "malformed"),
    # innovation
    Wrong("expected minus measured", innovation(v="H @ x - z"), I_V, "sign"),
    Wrong("z itself", innovation(v="z"), I_V, "no-difference"),
    Wrong("the expected one", innovation(v="H @ x"), I_V, "no-difference"),
    Wrong("without its sign", innovation(v="abs(z - H @ x)"), I_V, "absolute"),
    Wrong("S: no R", innovation(S="H @ P @ H.T"), I_S, "R-forgotten"),
    Wrong("S: no P", innovation(S="R"), I_S, "P-forgotten"),
    Wrong("H Hᵀ", innovation(S="H @ H.T + R"), I_S, "P-forgotten"),
    Wrong("S: R squared", innovation(S="H @ P @ H.T + R @ R"), I_S, "R-deviation"),
    Wrong("R squared by entries", innovation(S="H @ P @ H.T + R**2"), I_S, "R-deviation"),
    Wrong("S: root of R", innovation(S="H @ P @ H.T + R**0.5"), I_S, "R-deviation"),
    Wrong("S: minus R", innovation(S="H @ P @ H.T - R"), I_S, "R-subtracted"),
    Wrong("S inverted", innovation(S="np.linalg.inv(H @ P @ H.T + R)"), I_S, "inverted"),
    Wrong("v vᵀ", innovation(S="np.outer(z - H @ x, z - H @ x)"), I_S, "one-innovation"),
    Wrong("Hᵀ P H", innovation(S="H.T @ P @ H + R"), {"03-innovation"}, None, "raised"),
    Wrong("S of the state", innovation(S="P"), {"03-innovation"}, None, "malformed"),
    # gain
    Wrong("P Hᵀ", gain("P @ H.T"), K, "S-missing"),
    Wrong("P Hᵀ S", gain("P @ H.T @ S"), K, "S-not-inverted"),
    Wrong("one over S", gain("P @ H.T @ (1 / S)"), K, "one-over"),
    Wrong("S ** -1", gain("P @ H.T @ S**-1.0"), K, "one-over"),
    Wrong("gain: no P", gain("H.T @ " + INV), K, "P-missing"),
    Wrong("gain: no R", gain(S="H @ P @ H.T"), K, "R-forgotten"),
    Wrong("H inverted", gain("np.linalg.pinv(H)"), K, "R-forgotten", may_lose=()),
    Wrong("R for S", gain(S="R"), K, "R-for-S"),
    Wrong("gain: R squared", gain(S="H @ P @ H.T + R @ R"), K, "R-deviation"),
    Wrong("gain: root of R", gain(S="H @ P @ H.T + np.sqrt(R)"), K, "R-deviation"),
    Wrong("gain: minus R", gain(S="H @ P @ H.T - R"), K, "R-subtracted"),
    Wrong("minus", gain("-P @ H.T @ " + INV), K, "sign"),
    Wrong("half of it", gain("P @ H.T @ np.linalg.inv(S) / 2"), K),
    Wrong("transposed", gain("(P @ H.T @ np.linalg.inv(S)).T"), K, None, "malformed"),
    Wrong("H for Hᵀ", gain("P @ H @ np.linalg.inv(S)"), K, None, "raised"),
    Wrong("zeros", gain("np.zeros((3, 2))"), K, "idle"),
    Wrong("text", gain("'K'"), K, None, "malformed"),
    # update
    Wrong("x = K v", update(x="K @ v"), U_X, "x-lost"),
    Wrong("x as it was", update(x="x"), U_X, "x-unchanged"),
    Wrong("x − K v", update(x="x - K @ v"), U_X, "sign"),
    Wrong("innovation's sign", update(v="H @ x - z"), U_X, "sign"),
    Wrong("K z", update(v="z"), U_X, "z-for-v"),
    Wrong("gain without S⁻¹", update(K="P @ H.T"), U_X | U_P, "S-missing"),
    Wrong("gain with S", update(K="P @ H.T @ S"), U_X | U_P, "S-not-inverted"),
    Wrong("update without R", update(S="H @ P @ H.T"), U_X | U_P, "R-forgotten"),
    Wrong("update with R squared", update(S="H @ P @ H.T + R @ R"), U_X | U_P, "R-deviation"),
    Wrong("update with R's root", update(S="H @ P @ H.T + R**0.5"), U_X | U_P, "R-deviation"),
    Wrong(
        "P first",
        "def update(x, P, z, H, R):\n"
        "    S = H @ P @ H.T + R\n"
        "    P = P - P @ H.T @ np.linalg.inv(S) @ H @ P\n"
        "    return x + P @ H.T @ np.linalg.inv(S) @ (z - H @ x), P\n",
        U_X,
        "P-too-early",
    ),
    Wrong(
        "P first, S anew",
        "def update(x, P, z, H, R):\n"
        "    P = P - P @ H.T @ np.linalg.inv(H @ P @ H.T + R) @ H @ P\n"
        "    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)\n"
        "    return x + K @ (z - H @ x), P\n",
        U_X,
        "P-too-early",
    ),
    Wrong("update: P as it was", update(P="P"), U_P, "P-unchanged"),
    Wrong("P grows", update(P="P + K @ S @ K.T"), U_P, "P-grew"),
    Wrong("(I + K H) P", update(P="(I + K @ H) @ P"), U_P, "P-grew"),
    Wrong("I − K H", update(P="I - K @ H"), U_P, "P-factor-lost"),
    Wrong("P − K H", update(P="P - K @ H"), U_P, "P-factor-lost"),
    Wrong("P (I − K H)", update(P="P @ (I - K @ H)"), U_P, "P-other-side"),
    Wrong("(I − K H)ᵀ P", update(P="(I - K @ H).T @ P"), U_P, "P-other-side"),
    Wrong("P − K S⁻¹ Kᵀ", update(P="P - K @ np.linalg.inv(S) @ K.T"), U_P, "S-inverted-in-P"),
    Wrong("P − K R Kᵀ", update(P="P - K @ R @ K.T"), U_P, "R-in-P"),
    Wrong("half of Joseph", update(P="(I - K @ H) @ P @ (I - K @ H).T"), U_P, "noise-lost"),
    Wrong("what was learned", update(P="K @ S @ K.T"), U_P, "only-the-learned"),
    Wrong("P − K S K", update(P="P - K @ S @ K"), {"03-update"}, None, "raised"),
    Wrong("Kᵀ v", update(x="x + K.T @ v"), {"03-update"}, None, "raised"),
    Wrong("K kept from P", update(x="K", P="P"), {"03-update"}, None, "malformed"),
    # filter
    Wrong(
        "measurement first",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [], []
    for z in zs:
        x, P = update(x, P, z, H, R)
        x, P = predict(x, P, F, Q)
        xs.append(x)
        Ps.append(P)
    return xs, Ps
""",
        F_X | F_P,
        "wrong-order",
        may_lose=LUCK,
    ),
    Wrong(
        "measurement first, told before the step",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    xs, Ps = [], []
    for z in zs:
        x, P = update(x, P, z, H, R)
        xs.append(x)
        Ps.append(P)
        x, P = predict(x, P, F, Q)
    return xs, Ps
""",
        F_X | F_P,
        "wrong-order",
        may_lose=LUCK,
    ),
    Wrong(
        "predictions told",
        filter(between="xs.append(x); Ps.append(P)", after="pass"),
        F_X | F_P,
        "predictions-told",
        may_lose=LUCK,
    ),
    Wrong("never updated", filter(updated="x, P"), F_X | F_P, "never-updated", may_lose=LUCK),
    Wrong("never predicted", filter(predicted="x, P"), F_X | F_P, "never-predicted", may_lose=LUCK),
    Wrong(
        "from the start again",
        filter(before="x, P = x0, P0"),
        F_X | F_P,
        "begins-again",
        may_lose=LUCK,
    ),
    Wrong(
        "P from the start again", filter(before="P = P0"), F_X | F_P, "begins-again", may_lose=LUCK
    ),
    Wrong(
        "P never updated",
        filter(updated="x + K @ (z - H @ x), P"),
        F_X | F_P,
        "P-never-updated",
        may_lose=LUCK,
    ),
    Wrong("x not moved", filter(predicted="x, F @ P @ F.T + Q"), F_X, "x-not-moved", may_lose=LUCK),
    Wrong(
        "filter: no Q",
        filter(predicted="F @ x, F @ P @ F.T"),
        F_X | F_P,
        "Q-forgotten",
        may_lose=LUCK,
    ),
    Wrong(
        "one array, changed in place",
        filter(
            predicted="x, F @ P @ F.T + Q",
            between="x[:] = F @ x",
            updated="x, P - K @ S @ K.T",
            after="x += K @ (z - H @ x); xs.append(x); Ps.append(P)",
        ),
        F_X,
        "one-object",
    ),
    Wrong(
        "start told first",
        filter(result="[x0, *xs[:-1]], [P0, *Ps[:-1]]"),
        F_X | F_P,
        "start-told",
        may_lose=LUCK,
    ),
    Wrong("start told, too", filter(result="[x0, *xs], [P0, *Ps]"), ALL_F, None, "malformed"),
    Wrong("last belief only", filter(result="x, P"), ALL_F, None, "malformed"),
    Wrong("states only", filter(result="np.array(xs)"), ALL_F, None, "malformed"),
    Wrong("returns within the loop", filter(after="return [x], [P]"), ALL_F, None, "malformed"),
    Wrong(
        "variances only", filter(result="xs, [np.diag(P) for P in Ps]"), ALL_F, None, "malformed"
    ),
    Wrong("P ten times too small", filter(result="xs, [P / 10 for P in Ps]"), F_P | LUCK),
    Wrong("P ten times too large", filter(result="xs, [P * 10 for P in Ps]"), F_P | LUCK),
]

RIGHT = [
    Right("lists", predict(x="[row @ x for row in F]", P="(F @ P @ F.T + Q).tolist()")),
    Right("einsum", predict(x="F.dot(x)", P="np.einsum('ij,jk,lk->il', F, P, F) + Q")),
    Right(
        "in place",
        "def predict(x, P, F, Q):\n    x[:] = F @ x\n    P[:] = F @ P @ F.T\n    P += Q\n"
        "    return x, P\n",
    ),
    Right(
        "loops",
        """
def predict(x, P, F, Q):
    n = len(x)
    new, cov = np.zeros(n), Q.copy()
    for i in range(n):
        for j in range(n):
            new[i] += F[i, j] * x[j]
            for k in range(n):
                for l in range(n):
                    cov[i, j] += F[i, k] * P[k, l] * F[j, l]
    return new, cov
""",
    ),
    Right("tuple", innovation(v="tuple(z - H @ x)", S="R + np.dot(np.dot(H, P), H.T)")),
    Right(
        "pairs in a list",
        "def innovation(x, P, z, H, R):\n"
        "    return [-(H @ x) + z, np.matmul(H, np.matmul(P, H.T)) + R]\n",
    ),
    Right("stacked into one", innovation(v="np.subtract(z, x @ H.T)", S="H @ (H @ P).T + R")),
    Right("solve", gain("np.linalg.solve(S, H @ P).T")),
    Right("pseudo-inverse", gain("P @ H.T @ np.linalg.pinv(S)")),
    Right(
        "information",
        gain(
            "np.linalg.inv(np.linalg.inv(P) + H.T @ np.linalg.inv(R) @ H) @ H.T @ np.linalg.inv(R)"
        ),
    ),
    Right(
        "Cholesky",
        gain(
            "np.linalg.solve(L.T, np.linalg.solve(L, H @ P)).T",
            S="H @ P @ H.T + R; L = np.linalg.cholesky(S)",
        ),
    ),
    Right("matrix power", gain("P @ H.T @ np.linalg.matrix_power(S, -1)")),
    Right("Joseph", update(P="(I - K @ H) @ P @ (I - K @ H).T + K @ R @ K.T")),
    Right("(I − K H) P", update(P="(I - K @ H) @ P")),
    Right("P − P Hᵀ Kᵀ", update(P="P - P @ H.T @ K.T")),
    Right(
        "from the parts",
        "def update(x, P, z, H, R):\n    v, S = innovation(x, P, z, H, R)\n"
        "    K = gain(P, H, R)\n    return x + K @ v, P - K @ S @ K.T\n",
    ),
    Right(
        "information form",
        """
def update(x, P, z, H, R):
    old, seen = np.linalg.inv(P), H.T @ np.linalg.inv(R)
    P = np.linalg.inv(old + seen @ H)
    return P @ (old @ x + seen @ z), P
""",
    ),
    Right(
        "new P as a gain",
        """
def update(x, P, z, H, R):
    P = P - P @ H.T @ np.linalg.solve(H @ P @ H.T + R, H @ P)
    return x + P @ H.T @ np.linalg.inv(R) @ (z - H @ x), P
""",
    ),
    Right(
        "least squares",
        """
def update(x, P, z, H, R):
    A, B = np.linalg.inv(np.linalg.cholesky(P)), np.linalg.inv(np.linalg.cholesky(R))
    M = np.vstack([A, B @ H])
    x = np.linalg.lstsq(M, np.concatenate([A @ x, B @ z]), rcond=None)[0]
    return x, np.linalg.inv(M.T @ M)
""",
    ),
    Right(
        "one number after the other",
        """
def update(x, P, z, H, R):
    L = np.linalg.inv(np.linalg.cholesky(R))
    for row, seen in zip(L @ H, L @ z):
        K = P @ row / (row @ P @ row + 1)
        x, P = x + K * (seen - row @ x), P - np.outer(K, row @ P)
    return x, P
""",
    ),
    Right("arrays", filter(result="np.array(xs), np.stack(Ps)")),
    Right(
        "from the parts, in a loop",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
    beliefs = []
    for z in zs:
        beliefs.append(update(*predict(x, P, F, Q), z, H, R))
        x, P = beliefs[-1]
    return zip(*beliefs)
""".replace("return zip(*beliefs)", "return tuple(zip(*beliefs))"),
    ),
    Right(
        "filled arrays, changed in place",
        """
def kalman_filter(x, P, zs, F, Q, H, R):
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
    ),
    Right(
        "columns",
        """
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
    ),
]
