"""Right ways and slips of 15-liars: some methods that draw right maps, and some that do not."""

from course.tasks import Slip, Stumble

TASK = "15-liars"
MUTANTS = 24

LINEAR = '''
def close_loops(poses, edges, loops):
    n = len(poses)

    def linear(some, at):
        J, e = np.zeros((len(some), 3, n, 3)), np.zeros((len(some), 3))
        for k, (i, j, z, information) in enumerate(some):
            U = np.linalg.cholesky(information).T
            A, B = jacobians(at[i], at[j], z)
            J[k, :, i], J[k, :, j], e[k] = U @ A, U @ B, U @ error(at[i], at[j], z)
        return J.reshape(-1, 3 * n)[:, 3:], e.ravel()

    def settled(some, at, rounds=3):
        at = at.copy()
        for _ in range(rounds):
            J, e = linear(some, at)
            at[1:] -= np.linalg.solve(J.T @ J, J.T @ e).reshape(-1, 3)
            at[:, 2] = wrap(at[:, 2])
        return at

    def loops_at(at):
        """What the wheels expect of all loops together, near some poses: v, and its covariance."""
        J, e = linear(edges, at)
        P = np.linalg.inv(J.T @ J)
        K, v = linear(loops, at)
        return v - K @ (P @ (J.T @ e)), K @ P @ K.T + np.eye(len(v))

    def cost(some, v, S):
        """χ² of some loops together."""
        at = np.ravel([[3 * k, 3 * k + 1, 3 * k + 2] for k in some])
        return v[at] @ np.linalg.solve(S[np.ix_(at, at)], v[at])
'''

GROWING = """
    def grown(first, v, S):
        chosen, others = [first], set(range(len(loops))) - {first}
        spent = cost(chosen, v, S)
        while others:
            prices = {k: cost([*chosen, k], v, S) - spent for k in others}
            best = min(prices, key=prices.get)
            if prices[best] > GATE:
                break
            chosen, spent = [*chosen, best], spent + prices[best]
            others.remove(best)
        return spent - GATE * len(chosen), chosen
"""

WAYS = {
    "grown from every loop, once": LINEAR
    + GROWING.replace("GATE", "20")
    + """
    v, S = loops_at(poses)
    best, seen = (0.0, []), set()
    for first in range(len(loops)):
        if first not in seen:
            best = min(best, grown(first, v, S))
            seen |= set(best[1])
    return settled([*edges, *(loops[k] for k in best[1])], poses)
""",
    "the largest crowd of pairs that agree": LINEAR
    + """
    found = poses
    for _ in range(2):
        v, S = loops_at(found)
        m = len(loops)
        agree = np.zeros((m, m), dtype=bool)
        for a in range(m):
            for b in range(a + 1):
                agree[a, b] = agree[b, a] = cost([a, b] if a != b else [a], v, S) < 30
        crowds = []
        for first in np.flatnonzero(np.diag(agree)):
            crowd = [first]
            for k in sorted(np.flatnonzero(agree[first]), key=lambda k: cost([first, k], v, S) if k != first else 0):
                if k not in crowd and agree[k, crowd].all() and cost([*crowd, k], v, S) < 16 * (len(crowd) + 1):
                    crowd.append(k)
            crowds.append(crowd)
        crowd = max(crowds, key=lambda c: 16 * len(c) - cost(c, v, S), default=[])
        found = settled([*edges, *(loops[k] for k in crowd)], found)
    return found
""",
    "each loop trusted once, then voted on": LINEAR
    + """
    v, S = loops_at(poses)
    rows = np.arange(len(v)).reshape(-1, 3)
    found = poses
    for again in range(2):
        best = []
        for first in rows:
            G = S[:, first] @ np.linalg.inv(S[np.ix_(first, first)])
            w, T = v - G @ v[first], S - G @ S[first]
            fits = [rows.tolist().index(first.tolist())] if v[first] @ np.linalg.solve(
                S[np.ix_(first, first)], v[first]) < 20 else []
            while fits:
                d2 = np.array([w[r] @ np.linalg.solve(T[np.ix_(r, r)] + 1e-9 * np.eye(3), w[r]) for r in rows])
                d2[fits] = np.inf
                k = int(np.argmin(d2))
                if d2[k] > 18:
                    break
                fits.append(k)
                r = rows[k]
                G = T[:, r] @ np.linalg.inv(T[np.ix_(r, r)])
                w, T = w - G @ w[r], T - G @ T[r]
            best = max(best, fits, key=len)
        found = settled([*edges, *(loops[k] for k in best)], found)
        v, S = loops_at(found)
    return found
""",
    "cheapest of several beginnings": LINEAR
    + GROWING.replace("GATE", "16")
    + """
    v, S = loops_at(poses)
    groups = sorted(grown(first, v, S) for first in range(0, len(loops), 2))
    maps = []
    for price, group in groups[:2]:
        at = settled([*edges, *(loops[k] for k in group)], poses)
        for _ in range(2):  # whom this map believes
            v, S = loops_at(at)
            price, group = min(grown(first, v, S) for first in group[:2])
            at = settled([*edges, *(loops[k] for k in group)], at, 2)
        maps.append((price, at.tolist()))
    return min(maps)[1]
""",
}

WEIGHED = """
def close_loops(poses, edges, loops):
    def chi2(at, edge):
        i, j, z, information = edge
        e = error(at[i], at[j], z)
        return e @ information @ e

    phi = max(11.3, max(chi2(poses, loop) for loop in loops))
    for _ in range(12):
        scaled = [(*loop[:3], weight(chi2(poses, loop), phi) * loop[3]) for loop in loops]
        poses = step(poses, [*edges, *scaled])
        phi = max(11.3, phi / 4)
    return poses
"""
TRUSTED = """
def close_loops(poses, edges, loops):
    for _ in range(6):
        poses = step(poses, [*edges, *loops])
    return poses
"""
REFUSED = """
def close_loops(poses, edges, loops):
    kept = []
    for i, j, z, information in loops:
        e = error(poses[i], poses[j], z)
        if {test}:
            kept.append((i, j, z, information))
    for _ in range(6):
        poses = step(poses, [*edges, *kept])
    return poses
"""

SLIPS = (
    Slip(
        "all-trusted",
        "Every loop pulls with all its weight, the false ones as well. Before you draw a map, decide "
        "whom to believe.",
        TRUSTED,
    ),
    Slip(
        "one-step",
        "This is one step of Gauss and Newton with all loops. It takes several until nothing moves, and "
        "some of the loops are false.",
        "def close_loops(poses, edges, loops):\n    return step(poses, [*edges, *loops])\n",
    ),
    Slip(
        "weighed-only",
        "These are the weights of the lesson. They let single liars go, but liars that agree can pull "
        "the map to where the honest look false: choose whom to begin with.",
        WEIGHED,
    ),
    Slip(
        "refused-without-drift",
        "Hardly a loop was used: the maps are those of the wheels. If each was refused because the wheels say "
        "otherwise, by metres or by its own Λ: the wheels drift, so ask how far they may be off between "
        "these two poses.",
        REFUSED.format(test="np.hypot(e[0], e[1]) < 0.3"),
        REFUSED.format(test="e @ information @ e < 11.3"),
    ),
    Slip(
        "gate-of-one-size",
        "Each loop is measured by the wheels with one gate. The wheels drift: between poses far apart a true "
        "loop may contradict them by metres, and where liars lie nearer than that, one size refuses the true "
        "or keeps the false. What are the wheels' own doubts between the two poses, and what do other loops "
        "say?",
        *(
            REFUSED.format(test=f"np.hypot(e[0], e[1]) < {most}")
            for most in (0.5, 0.8, 1, 1.5, 2, 2.5, 3)
        ),
        *(REFUSED.format(test=f"e @ information @ e < {most}") for most in (100, 300, 1000, 3000)),
    ),
    Slip(
        "liars-kept",
        "The loops that agree with the wheels were thrown away, and the others kept: the inequality is "
        "turned.",
        REFUSED.format(test="np.hypot(e[0], e[1]) > 0.8"),
    ),
    Slip(
        "wheels-left-out",
        "Only loops were used, and the wheels hold the poses hardly or not at all.",
        "def close_loops(poses, edges, loops):\n"
        "    loose = [(i, j, z, 1e-3 * L) for i, j, z, L in edges]\n"
        "    for _ in range(4):\n"
        "        poses = step(poses, loose + loops)\n"
        "    return poses\n",
    ),
)

STUMBLES = (
    Stumble("malformed", ("return found", "return found, found")),
    Stumble("raised", "def close_loops(poses, edges, loops):\n    return poses[len(poses)]\n"),
    Stumble("malformed", "def close_loops(poses, edges, loops):\n    return poses[1:]\n"),
)

PASTED = {
    "the lesson's robust weights": WEIGHED,
    "a step of all edges, again and again": TRUSTED,
    "the lesson's gate of surprise, taken for χ² of the loop": REFUSED.format(
        test="e @ information @ e < 60"
    ),
}

EQUIVALENT = {
    " -> ": "any method goes: what draws as many right maps is a right way of its own",
}
