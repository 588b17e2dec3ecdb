"""Right ways and slips of 06-false-sights."""

from course.tasks import Slip, Stumble

TASK = "06-false-sights"

WAYS = {
    "sights that doubt themselves": """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    ids = list(ids)
    for i, one in zip(seen, z):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids.append(i)
            continue
        j = ids.index(i)
        v = one - h(x[:3], x[3 + 2 * j : 5 + 2 * j])
        v[1] = wrap(v[1])
        H = H_full(x, j)
        far = v @ np.linalg.inv(H @ P @ H.T + R) @ v
        # a sight counts for less the farther off it is, and for next to nothing far away
        x, P = update(x, P, one, j, R * (1 if far < 9 else 1e6))
    return x, P, ids
""",
    "a gate of range and bearing apart": """
def careful_step(x, P, ids, u, seen, z, C, R):
    x, P = predict(x, P, u, C)
    for i, one in zip(seen, z):
        if i in ids:
            j = ids.index(i)
            v = one - h(x[:3], x[3 + 2 * j : 5 + 2 * j])
            v[1] = (v[1] + np.pi) % (2 * np.pi) - np.pi
            H = H_full(x, j)
            sigma = np.sqrt(np.diag(H @ P @ H.T + R))
            if np.all(np.abs(v) < 3.5 * sigma):
                x, P = update(x, P, one, j, R)
        else:
            x, P = augment(x, P, one, R)
            ids = ids + [i]
    return x, P, ids
""",
}

_S = "v @ np.linalg.solve(H @ P @ H.T + R, v) < 13.8"

SLIPS = (
    Slip(
        "every-sight-believed",
        "Every sight was believed, the false ones too. Before it updates anything: does this sight agree "
        "with what the filter expects, as far as the filter knows?",
        ("< 13.8", "< np.inf"),
        ("< 13.8", "< 1000"),
    ),
    Slip(
        "nothing-believed",
        "Hardly any sight was believed, so that the robot only counts its wheels. How far off may a true "
        "sight be?",
        ("< 13.8", "< 0"),
        ("< 13.8", "< 0.05"),
    ),
    Slip(
        "eyes-shut",
        "No landmark ever comes into the map. One that is new has to be augmented, and one that is known "
        "corrects the pose, unless its sight is false.",
        "def careful_step(x, P, ids, u, seen, z, C, R):\n    return *predict(x, P, u, C), list(ids)\n",
    ),
    Slip(
        "gate-of-one-size",
        "Your gate has one size. When the robot has just seen landmarks, a true sight is a few "
        "centimetres off, and after it has turned for long a radian: the filter knows which of the "
        "two it is. Where does it say so?",
        *((_S, f"np.hypot(*v) < {most}") for most in (0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1)),
        *(
            (_S, f"np.all(np.abs(v) < {most})")
            for most in ([0.3, 0.2], [0.5, 0.3], [0.5, 0.5], [1, 0.5])
        ),
        (_S, "abs(v[0]) < 0.5"),
        *(
            (_S, f"np.hypot(*(g(x[:3], one) - x[3 + 2 * j : 5 + 2 * j])) < {most}")
            for most in (0.5, 1, 2)
        ),
    ),
    Slip(
        "gate-turned",
        "Sights that agree were thrown away and those that do not were used: the inequality is turned.",
        ("< 13.8", "> 13.8"),
    ),
    Slip(
        "gate-without-P",
        "The gate looks at R only. An innovation holds the error of pose and landmark as well, and after "
        "a drive that is most of it: measure it by S.",
        *((_S, f"v @ np.linalg.solve(R, v) < {most}") for most in (2, 9, 14, 25, 50, 100, 400)),
        (_S, "np.all(np.abs(v) < 3 * np.sqrt(np.diag(R)))"),
    ),
)

STUMBLES = (Stumble("malformed", ("return x, P, ids", "return x, P")),)

PASTED = {
    "slam_step": """
def careful_step(x, P, ids, u, seen, z, C, R):
    return slam_step(x, P, ids, u, seen, z, C, R)
"""
}

MUTANTS = 60

EQUIVALENT = {"": "the task is open: whatever reaches the highest step is right"}
