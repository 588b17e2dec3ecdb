"""Programs of task 07-hearsay."""

from course.tasks import Slip, Stumble

TASK = "07-hearsay"

WAYS = {
    "block by block": """
def hearsay(x, P, seen, x_seen, P_seen):
    rest = np.array([k for k in range(len(x)) if k not in seen], dtype=int)
    G = P[np.ix_(rest, seen)] @ np.linalg.inv(P[np.ix_(seen, seen)])
    found, new = x.copy(), np.zeros_like(P)
    found[seen], found[rest] = x_seen, x[rest] + G @ (x_seen - x[seen])
    new[np.ix_(seen, seen)] = P_seen
    new[np.ix_(rest, seen)] = G @ P_seen
    new[np.ix_(seen, rest)] = (G @ P_seen).T
    left = P[np.ix_(rest, rest)] - G @ P[np.ix_(seen, rest)]
    new[np.ix_(rest, rest)] = left + G @ P_seen @ G.T
    return found, new
""",
    "entry by entry": """
def hearsay(x, P, seen, x_seen, P_seen):
    n, s = len(x), [int(k) for k in seen]
    own = P[s][:, s]
    G = [np.linalg.solve(own, P[s, k]) for k in range(n)]
    learned = own - P_seen
    moved = np.asarray(x_seen) - x[s]
    found = [x[k] + G[k] @ moved for k in range(n)]
    return found, [[P[k, l] - G[k] @ learned @ G[l] for l in range(n)] for k in range(n)]
""",
    "what follows and what stays": """
def hearsay(x, P, seen, x_seen, P_seen):
    G = np.linalg.solve(P[np.ix_(seen, seen)], P[seen]).T
    stays = P - G @ P[seen]
    return x - G @ x[seen] + G @ x_seen, stays + G @ P_seen @ G.T
""",
    "pinv and a selection": """
def hearsay(x, P, seen, x_seen, P_seen):
    E = np.eye(len(x))[seen]
    own = E @ P @ E.T
    G = P @ E.T @ np.linalg.pinv(own)
    L = np.eye(len(x)) - G @ E
    return (L @ x + G @ x_seen).tolist(), (L @ P @ L.T + G @ P_seen @ G.T).tolist()
""",
    "least squares": """
def hearsay(x, P, seen, x_seen, P_seen):
    G = np.linalg.lstsq(P[seen][:, seen], P[seen], rcond=None)[0]
    change = np.asarray(P_seen) - P[seen][:, seen]
    return x + (x_seen - x[seen]) @ G, P + np.einsum("ak,ab,bl->kl", G, change, G)
""",
}

_G = "P[:, seen] @ np.linalg.inv(P_ss)"
_x, _P = "x + G @ (x_seen - x[seen])", "P - G @ (P_ss - P_seen) @ G.T"
_PAIR = "return x + G @ (x_seen - x[seen]), P - G @ (P_ss - P_seen) @ G.T"
_MEASURED = """
def hearsay(x, P, seen, x_seen, P_seen):
    H = np.eye(len(x))[seen]
    S = H @ P @ H.T + P_seen
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (x_seen - H @ x), P - K @ S @ K.T
"""
_WRITTEN = """
def hearsay(x, P, seen, x_seen, P_seen):
    x, P = x.copy(), P.copy()
    x[seen] = x_seen
    P[np.ix_(seen, seen)] = P_seen
    {more}
    return x, P
"""
_BLOCKS = """
def hearsay(x, P, seen, x_seen, P_seen):
    rest = np.setdiff1d(np.arange(len(x)), seen)
    G = P[np.ix_(rest, seen)] @ np.linalg.inv(P[np.ix_(seen, seen)])
    x, new = x.copy(), P.copy()
    x[rest] += G @ (x_seen - x[seen])
    x[seen] = x_seen
    {cross}
    {rest}
    new[np.ix_(seen, seen)] = P_seen
    return x, new
"""
_CROSS = "new[np.ix_(rest, seen)] = G @ P_seen; new[np.ix_(seen, rest)] = P_seen @ G.T"
_REST = "new[np.ix_(rest, rest)] -= G @ (P[np.ix_(seen, seen)] - P_seen) @ G.T"


def _blocks(cross=_CROSS, rest=_REST):
    return _BLOCKS.format(cross=cross, rest=rest)


SLIPS = (
    Slip(
        "taken-for-a-measurement",
        "x_seen was taken for a new measurement with the noise P_seen. But the small program began "
        "with what you know: its answer contains yours already, and that would count it twice.",
        _MEASURED,
    ),
    Slip(
        "P_seen-inverted",
        "P_seen was inverted. It may be 0: the entries are known exactly then, and no inverse says so; pinv "
        "even says that nothing is known. G needs the inverse of the old covariance only.",
        *(
            f"""
def hearsay(x, P, seen, x_seen, P_seen):
    now, before = {inverse}, np.linalg.inv(P[np.ix_(seen, seen)])
    L = np.linalg.inv(P)
    b = L @ x
    L[np.ix_(seen, seen)] += now - before
    b[seen] += now @ x_seen - before @ x[seen]
    new = np.linalg.inv(L)
    return new @ b, new
"""
            for inverse in (
                "np.linalg.pinv(P_seen)",
                "np.linalg.inv(P_seen + 1e-6 * np.eye(len(seen)))",
            )
        ),
        shaky=True,
    ),
    Slip(
        "one-entry-after-the-other",
        "The entries in sight were taken one after the other, each with its variance alone. What they share "
        "among each other, before and now, is in P and P_seen: take them all at once.",
        """
def hearsay(x, P, seen, x_seen, P_seen):
    for k, i in enumerate(seen):
        G = P[:, i] / P[i, i]
        x, P = x + G * (x_seen[k] - x[i]), P + np.outer(G, G) * (P_seen[k, k] - P[i, i])
    return x, P
""",
    ),
    Slip(
        "rest-forgotten",
        "The covariance is that of G x̃_s alone. The others' errors have another part, the rest: nothing "
        "was learned of it, so it is as large as it was.",
        (_P, "G @ P_seen @ G.T"),
    ),
    Slip(
        "others-untouched",
        "The others stay as they were, but they share an error with those in sight: as these turn "
        "out to have been wrong, so were they.",
        _WRITTEN.format(more="pass"),
    ),
    Slip(
        "means-alone",
        "The means of the others follow, their covariances do not: to learn is to grow surer as well.",
        _blocks(cross="pass", rest="pass"),
    ),
    Slip(
        "cross-untouched",
        "What the others share with those in sight is as it was. Those in sight err less now, so "
        "there is less of their error that others could share.",
        _blocks(cross="pass"),
    ),
    Slip(
        "cross-dropped",
        "What the others share with those in sight was set to 0. It is less than before, but as "
        "long as those in sight err, the others err with them.",
        _blocks(cross="new[np.ix_(rest, seen)] = 0; new[np.ix_(seen, rest)] = 0"),
    ),
    Slip(
        "rest-untouched",
        "The covariance of the others is as it was, although they have followed: part of what they "
        "were unsure of was the error that has become smaller.",
        _blocks(rest="pass"),
    ),
    Slip(
        "those-in-sight-untouched",
        "The others follow, and those in sight stay as they were: of these x_seen and P_seen say all "
        "that is known now.",
        _blocks().replace("    x[seen] = x_seen\n", ""),
        _blocks().replace("    new[np.ix_(seen, seen)] = P_seen\n", ""),
    ),
    Slip(
        "gain-without-inverse",
        "P of all with those in sight says how they err together. To say how far one moves when "
        "the other does, it has to be divided by how far that one errs.",
        (_G, "P[:, seen]"),
    ),
    Slip(
        "gain-of-now",
        "G was made with P_seen. How the others follow those in sight is a matter of the errors "
        "that they shared before the sightings; these have not changed it.",
        (_G, "P[:, seen] @ np.linalg.pinv(P_seen)"),
        (_G, "P[:, seen] @ np.linalg.inv(P_ss + P_seen)"),
    ),
    Slip(
        "gain-by-variances",
        "Each entry was divided by the variance of one entry in sight. Those in sight share errors "
        "with each other, too: their whole covariance has to be inverted.",
        (_G, "P[:, seen] / np.diag(P_ss)"),
        (_G, "P[:, seen] @ np.diag(1 / np.diag(P_ss))"),
    ),
    Slip(
        "correlation-for-gain",
        "This G holds correlations, P_ij / (σ_i σ_j). They have no units, and do not say by how "
        "many metres one entry moves with another.",
        (_G, "P[:, seen] / np.sqrt(np.outer(np.diag(P), np.diag(P_ss)))"),
    ),
    Slip(
        "moved-backwards",
        "The others move the wrong way: what counts is what is known now less what was believed "
        "before.",
        (_x, "x - G @ (x_seen - x[seen])"),
        (_x, "x + G @ (x[seen] - x_seen)"),
    ),
    Slip(
        "moved-to",
        "G was multiplied by the places of those in sight. The others follow their *error*: by how "
        "far those have moved.",
        (_x, "x + G @ x_seen"),
        (_x, "G @ x_seen"),
        (_x, "G @ (x_seen - x[seen])"),
    ),
    Slip(
        "added",
        "What was learned was added to P: the others have grown less sure.",
        (_P, "P + G @ (P_ss - P_seen) @ G.T"),
        (_P, "P - G @ (P_seen - P_ss) @ G.T"),
    ),
    Slip(
        "as-if-exact",
        "The others grew surer as if those in sight were now known exactly. What they are still "
        "unsure of, P_seen, reaches the others as well.",
        (_P, "P - G @ P_ss @ G.T"),
        (_P, "P - G @ P[seen]"),
        _blocks(rest="new[np.ix_(rest, rest)] -= G @ P[np.ix_(seen, rest)]"),
    ),
    Slip(
        "what-is-left-for-what-is-learned",
        "What those in sight are still unsure of, P_seen, stands where what they have learned "
        "belongs, or the other way round. What they have learned is a difference.",
        (_P, "P - G @ P_seen @ G.T"),
        (_P, "P + G @ P_seen @ G.T"),
    ),
    Slip(
        "sandwich-open",
        "The change of P has G on one side only. Both sides of a covariance follow: G … Gᵀ.",
        [(_P, "P - np.eye(len(x))[:, seen] @ (P_ss - P_seen) @ G.T")],
        [(_P, "P - G @ (P_ss - P_seen) @ np.eye(len(x))[seen]")],
    ),
    Slip(
        "half",
        "Only half of the way was gone, or half of what was learned was taken off.",
        (_x, "x + G @ (x_seen - x[seen]) / 2"),
        (_P, "P - G @ (P_ss - P_seen) @ G.T / 2"),
        (_G, "P[:, seen] @ np.linalg.inv(P_ss) / 2"),
    ),
    Slip(
        "order-of-seen",
        "x_seen and P_seen are in the order of `seen`, which need not be that of the state.",
        [("P_ss = P[", "seen = np.sort(seen)\n    P_ss = P[")],
        [("P_ss = P[", "seen = np.arange(len(seen))\n    P_ss = P[")],
    ),
    Slip(
        "pairs-for-block",
        "P[seen, seen] picks single entries, here the variances of those in sight, not the block of "
        "their rows and columns.",
        ("P[np.ix_(seen, seen)]", "np.diag(P[seen, seen])"),
    ),
)

PASTED = {
    "an update with the answer as what was seen": _MEASURED,
    "an update with exact sights": """
def hearsay(x, P, seen, x_seen, P_seen):
    H = np.eye(len(x))[seen]
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T)
    return x + K @ (x_seen - H @ x), (np.eye(len(x)) - K @ H) @ P @ (np.eye(len(x)) - K @ H).T
""",
    "written into the state": _WRITTEN.format(more="pass"),
    "fused entry by entry": """
def hearsay(x, P, seen, x_seen, P_seen):
    x, P = x.copy(), P.copy()
    a, b = P[np.ix_(seen, seen)], P_seen
    K = a @ np.linalg.inv(a + b)
    x[seen] += K @ (x_seen - x[seen])
    P[np.ix_(seen, seen)] = a - K @ a
    return x, P
""",
}

STUMBLES = (
    Stumble("raised", ("P[np.ix_(seen, seen)]", "P[seen]")),
    Stumble(
        "malformed",
        (_PAIR, "return x + G @ (x_seen - x[seen])"),
        (_PAIR, "return x_seen, P_seen"),
        (_PAIR, "pass"),
    ),
)
