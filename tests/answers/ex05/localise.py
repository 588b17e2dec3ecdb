"""Independent answers to 05-localise: right ones, and students' mistakes."""

RIGHT = [
    (
        "05-localise",
        "index loop into arrays",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    n = len(drives)
    xs, Ps = np.zeros((n, 3)), np.zeros((n, 3, 3))
    for k in range(n):
        x, P = predict(x, P, drives[k], C)
        if ids[k] != -1:
            x, P = locate(x, P, zs[k], landmarks[ids[k]], R)
        xs[k], Ps[k] = x, P
    return xs, Ps
""",
    ),
    (
        "05-localise",
        "a generator of beliefs",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    def beliefs(x, P):
        for k, i in enumerate(ids):
            x, P = predict(x, P, drives[k], C)
            yield (x, P) if i < 0 else locate(x, P, zs[k], landmarks[i], R)
            if i >= 0:
                x, P = locate(x, P, zs[k], landmarks[i], R)

    xs, Ps = zip(*beliefs(x, P))
    return np.stack(xs), np.stack(Ps)
""",
    ),
]

WRONG = [
    (
        "05-localise",
        "looks first, then drives",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        if i >= 0:
            x, P = locate(x, P, z, landmarks[i], R)
        x, P = predict(x, P, u, C)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "the start is in the list: n + 1 beliefs",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [x], [P]
    for u, i, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        if i >= 0:
            x, P = locate(x, P, z, landmarks[i], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "the start instead of the last",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        xs.append(x)
        Ps.append(P)
        x, P = predict(x, P, u, C)
        if i >= 0:
            x, P = locate(x, P, z, landmarks[i], R)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "landmark 0 counts as nothing",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        if i > 0:
            x, P = locate(x, P, z, landmarks[i], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "-1 is the last landmark",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for k in range(len(drives)):
        x, P = predict(x, P, drives[k], C)
        x, P = locate(x, P, zs[k], landmarks[ids[k]], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "nothing seen: asks the id for truth",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        if i:
            x, P = locate(x, P, z, landmarks[i], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "skips steps where nothing is seen",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        if i < 0:
            continue
        x, P = predict(x, P, u, C)
        x, P = locate(x, P, z, landmarks[i], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "keeps no belief where nothing is seen",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        if i >= 0:
            x, P = locate(x, P, z, landmarks[i], R)
            xs.append(x)
            Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "stale P: locate gets the covariance before the drive",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        x_new, P_new = predict(x, P, u, C)
        if i >= 0:
            x_new, P_new = locate(x_new, P, z, landmarks[i], R)
        x, P = x_new, P_new
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "the corrected belief is reported, but not driven on from",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        best = (x, P)
        if i >= 0:
            best = locate(x, P, z, landmarks[i], R)
        xs.append(best[0])
        Ps.append(best[1])
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "the predicted belief is reported",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        xs.append(x)
        Ps.append(P)
        if i >= 0:
            x, P = locate(x, P, z, landmarks[i], R)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "the sights are counted: zs is read as a list of what was seen",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps, seen = [], [], 0
    for u, i in zip(drives, ids):
        x, P = predict(x, P, u, C)
        if i >= 0:
            x, P = locate(x, P, zs[seen], landmarks[i], R)
            seen += 1
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "landmarks by step, not by id",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for k, u in enumerate(drives):
        x, P = predict(x, P, u, C)
        if ids[k] >= 0:
            x, P = locate(x, P, zs[k], landmarks[k % len(landmarks)], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "a standing robot does not predict (and so adds no noise of the turn)",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        if u[0] > 0:
            x, P = predict(x, P, u, C)
        if i >= 0:
            x, P = locate(x, P, z, landmarks[i], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "a zero sight is nothing: looks at zs instead of ids",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, i, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        if np.any(z != 0):
            x, P = locate(x, P, z, landmarks[i], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
""",
    ),
    (
        "05-localise",
        "only the last belief",
        """
def localise(x, P, drives, ids, zs, landmarks, C, R):
    for u, i, z in zip(drives, ids, zs):
        x, P = predict(x, P, u, C)
        if i >= 0:
            x, P = locate(x, P, z, landmarks[i], R)
    return x, P
""",
    ),
]
