"""Quick ideas for 05-lost: some ask one sight, some ask several."""

GATE = """
def run(x, P, drives, ids, zs, landmarks, C, R, gate):
    xs, Ps = [], []
    for u, id, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        if id >= 0:
            v = z - h(x, landmarks[id])
            v[1] = wrap(v[1])
            H = H_robot(x, landmarks[id])
            if v @ np.linalg.solve(H @ P @ H.T + R, v) < gate:
                x, P = locate(x, P, z, landmarks[id], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)


def implied(x, drives, ids, zs, landmarks):
    turned, place, found = 0.0, 0j, []
    for u, id, z in zip(drives, ids, zs):
        place += u[0] * np.exp(1j * turned)
        turned += u[1]
        if id >= 0:
            there = complex(*(landmarks[id] - x[:2]))
            found.append(np.angle(there / (place + z[0] * np.exp(1j * (turned + z[1])))))
    return np.array(found)

"""
HEAD = "def find_yourself(x, P, drives, ids, zs, landmarks, C, R):\n"


def by(count, how, sigma=0.3, gate=9):
    return (
        GATE
        + HEAD
        + f"""
    a = implied(x, drives, ids, zs, landmarks)[:{count}]
    t = {how}
    P = P.copy()
    P[2] = P[:, 2] = 0
    P[2, 2] = {sigma}**2
    return run(np.array([x[0], x[1], t]), P, drives, ids, zs, landmarks, C, R, {gate})
"""
    )


MIDDLE = "a[np.argmin(np.abs(wrap(a[:, None] - a)).sum(axis=1))]"
RIGHT = [
    ("05-lost", "circular median of nine sights", by(9, MIDDLE)),
    ("05-lost", "circular mean of nine sights", by(9, "np.angle(np.exp(1j * a).sum())")),
    ("05-lost", "mean of all sights", by(99, "np.angle(np.exp(1j * a).sum())")),
]
WRONG = [
    ("05-lost", "circular median of five sights", by(5, MIDDLE)),
    ("05-lost", "circular median of nine sights, every sight believed", by(9, MIDDLE, gate=1e9)),
    ("05-lost", "the fifth sight", by(5, "a[-1]")),
    ("05-lost", "median of nine, wide start, wide gate", by(9, MIDDLE, 0.8, 50)),
]
