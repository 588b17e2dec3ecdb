# %% way: by indices, arrays filled
def localise(x, P, us, ids, zs, landmarks, C, R):
    n = len(ids)
    xs, Ps = np.zeros((n, 3)), np.zeros((n, 3, 3))
    for k in range(n):
        x, P = predict(x, P, us[k], C)
        if ids[k] != -1:
            x, P = locate(x, P, zs[k], landmarks[ids[k]], R)
        xs[k], Ps[k] = x, P
    return xs, Ps

# %% way: lists of lists, symmetry kept
def localise(x, P, us, ids, zs, landmarks, C, R):
    beliefs = []
    for k, id in enumerate(ids):
        x, P = predict(x, P, us[k], C)
        x, P = locate(x, P, zs[k], landmarks[int(id)], R) if id > -1 else (x, P)
        P = (P + P.T) / 2
        beliefs.append([x.tolist(), P.tolist()])
    return [b[0] for b in beliefs], [b[1] for b in beliefs]

# %% way: all in one, in copies
def localise(x, P, us, ids, zs, landmarks, C, R):
    x, P, history = x.copy(), P.copy(), []
    for u, id, z in zip(us, ids, zs):
        c, s = np.cos(x[2]), np.sin(x[2])
        A = np.array([[1, 0, -u[0] * s], [0, 1, u[0] * c], [0, 0, 1]])
        W = np.array([[c, 0], [s, 0], [0, 1]])
        x += [u[0] * c, u[0] * s, u[1]]
        P[:] = A @ P @ A.T + W @ C @ W.T
        if id >= 0:
            v = z - h(x, landmarks[id])
            v[1] = wrap(v[1])
            H = H_robot(x, landmarks[id])
            K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
            x += K @ v
            P -= K @ H @ P
        history.append((x.copy(), P.copy()))
    return np.array([x for x, _ in history]), np.array([P for _, P in history])

# %% way: update only for ids in the map
def localise(x, P, us, ids, zs, landmarks, C, R):
    xs, Ps = [x], [P]
    for k in range(len(us)):
        x, P = predict(xs[-1], Ps[-1], us[k], C)
        if ids[k] in range(len(landmarks)):
            x, P = locate(x, P, zs[k], landmarks[ids[k]], R)
        xs, Ps = xs + [x], Ps + [P]
    return np.array(xs[1:]), np.array(Ps[1:])

# %% right: a generator of beliefs
def localise(x, P, us, ids, zs, landmarks, C, R):
    def beliefs(x, P):
        for k, i in enumerate(ids):
            x, P = predict(x, P, us[k], C)
            yield (x, P) if i < 0 else locate(x, P, zs[k], landmarks[i], R)
            if i >= 0:
                x, P = locate(x, P, zs[k], landmarks[i], R)

    xs, Ps = zip(*beliefs(x, P))
    return np.stack(xs), np.stack(Ps)

# %% right: recursion over the steps
def localise(x, P, us, ids, zs, landmarks, C, R):
    def rest(x, P, k):
        if k == len(us):
            return []
        x, P = predict(x, P, us[k], C)
        if ids[k] != -1:
            x, P = locate(x, P, zs[k], landmarks[ids[k]], R)
        return [(x, P), *rest(x, P, k + 1)]
    xs, Ps = zip(*rest(x, P, 0))
    return np.stack(xs), np.stack(Ps)

# %% wrong: stale P: locate gets the covariance before the drive
def localise(x, P, us, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    for u, i, z in zip(us, ids, zs):
        x_new, P_new = predict(x, P, u, C)
        if i >= 0:
            x_new, P_new = locate(x_new, P, z, landmarks[i], R)
        x, P = x_new, P_new
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)

# %% wrong: the observations are counted: zs is read as a list of what was seen
def localise(x, P, us, ids, zs, landmarks, C, R):
    xs, Ps, seen = [], [], 0
    for u, i in zip(us, ids):
        x, P = predict(x, P, u, C)
        if i >= 0:
            x, P = locate(x, P, zs[seen], landmarks[i], R)
            seen += 1
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)

# %% wrong: only the last belief
def localise(x, P, us, ids, zs, landmarks, C, R):
    for u, i, z in zip(us, ids, zs):
        x, P = predict(x, P, u, C)
        if i >= 0:
            x, P = locate(x, P, z, landmarks[i], R)
    return x, P

# %% wrong: each time from the start: P is predicted, x is summed up by the wheels
def localise(x, P, us, ids, zs, landmarks, C, R):
    xs, Ps = [], []
    wheels = x
    for u, i, z in zip(us, ids, zs):
        _, P = predict(wheels, P, u, C)
        wheels = f_odometry(wheels, u)
        y = wheels
        if i != -1:
            y, P = locate(wheels, P, z, landmarks[i], R)
        xs.append(y)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
