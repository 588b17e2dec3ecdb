# %% way: mirror mended by a diagonal
def best_motion(source, target):
    a, b = np.mean(source, axis=0), np.mean(target, axis=0)
    U, _, Vt = np.linalg.svd((source - a).T @ (target - b))
    Rot = Vt.T @ np.diag([1, np.linalg.det(Vt.T @ U.T)]) @ U.T
    return np.block([[Rot, (b - Rot @ a)[:, None]], [np.zeros(2), np.ones(1)]])

# %% way: mirror mended in U, M by a loop
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    M = np.zeros((2, 2))
    for p, q in zip(source - a, target - b):
        M += np.outer(p, q)
    U, _, Vt = np.linalg.svd(M)
    U[:, 1] *= np.sign(np.linalg.det(U) * np.linalg.det(Vt))
    Rot = (U @ Vt).T
    T = np.eye(3)
    T[:2, :2], T[:2, 2] = Rot, b - Rot @ a
    return T

# %% way: angle in closed form
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    p, q = source - a, target - b
    sine, cosine = np.sum(p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]), np.sum(p * q)
    theta = np.arctan2(sine, cosine)
    c, s = np.cos(theta), np.sin(theta)
    x, y = b - np.array([[c, -s], [s, c]]) @ a
    return [[c, -s, x], [s, c, y], [0, 0, 1]]

# %% way: complex numbers
def best_motion(source, target):
    z, w = source @ [1, 1j], target @ [1, 1j]
    turn = np.vdot(z - z.mean(), w - w.mean())
    turn /= abs(turn)
    t = w.mean() - turn * z.mean()
    return np.array(
        [[turn.real, -turn.imag, t.real], [turn.imag, turn.real, t.imag], [0, 0, 1]]
    )

# %% way: scipy's Kabsch
def best_motion(source, target):
    from scipy.spatial.transform import Rotation

    a, b = source.mean(axis=0), target.mean(axis=0)
    flat = lambda points: np.column_stack([points, np.zeros(len(points))])
    wide = Rotation.align_vectors(
        np.vstack([flat(target - b), [0, 0, 1e3]]), np.vstack([flat(source - a), [0, 0, 1e3]])
    )[0].as_matrix()
    T = np.eye(3)
    T[:2, :2] = wide[:2, :2]
    T[:2, 2] = b - T[:2, :2] @ a
    return T

# %% way: three motions after one another
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    M = (source - a).T @ (target - b)
    turn = np.array([[M[0, 0] + M[1, 1], M[1, 0] - M[0, 1]], [M[0, 1] - M[1, 0], M[0, 0] + M[1, 1]]])
    away, about, back = np.eye(3), np.eye(3), np.eye(3)
    away[:2, 2], back[:2, 2] = -a, b
    about[:2, :2] = turn / np.hypot(*turn[0])
    return back @ about @ away

# %% way: eigenvectors instead of singular ones
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    M = (source - a).T @ (target - b)
    c, s = np.trace(M), M[0, 1] - M[1, 0]
    _, vectors = np.linalg.eigh(np.array([[c, s], [s, -c]]))  # of half the angle
    x, y = vectors[:, -1]
    Rot = np.array([[x * x - y * y, -2 * x * y], [2 * x * y, x * x - y * y]])
    T = np.identity(3)
    T[:2, :2], T[:2, 2] = Rot, b - Rot @ a
    return T

# %% right: SVD with diag(1, det)
def best_motion(source, target):
    n = len(source)
    a, b = source.sum(axis=0) / n, target.sum(axis=0) / n
    H = np.zeros((2, 2))
    for p, q in zip(source, target):
        H += np.outer(p - a, q - b)
    U, S, Vt = np.linalg.svd(H)
    V = Vt.T
    R = V @ np.diag([1.0, np.sign(np.linalg.det(V @ U.T))]) @ U.T
    return np.block([[R, (b - R @ a)[:, None]], [np.zeros((1, 2)), np.ones((1, 1))]])

# %% wrong: one number as centroid: mean without the axis
def best_motion(source, target):
    a, b = source.mean(), target.mean()
    U, _, Vt = np.linalg.svd((source - a).T @ (target - b))
    if np.linalg.det(Vt.T @ U.T) < 0:
        Vt[1] *= -1
    R = Vt.T @ U.T
    T = np.eye(3)
    T[:2, :2] = R
    T[:2, 2] = target.mean(axis=0) - R @ source.mean(axis=0)
    return T

# %% wrong: takes the centroids off in place
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    source -= a
    target -= b
    U, _, Vt = np.linalg.svd(source.T @ target)
    if np.linalg.det(Vt.T @ U.T) < 0:
        Vt[1] *= -1
    T = np.eye(3)
    T[:2, :2] = Vt.T @ U.T
    T[:2, 2] = b - T[:2, :2] @ a
    return T

# %% wrong: only the first and the last pair
def best_motion(source, target):
    d, e = source[-1] - source[0], target[-1] - target[0]
    angle = np.arctan2(e[1], e[0]) - np.arctan2(d[1], d[0])
    c, s = np.cos(angle), np.sin(angle)
    R = np.array([[c, -s], [s, c]])
    T = np.eye(3)
    T[:2, :2], T[:2, 2] = R, target.mean(axis=0) - R @ source.mean(axis=0)
    return T

# %% wrong: matrix of the clouds' type: whole numbers cut it off
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    U, _, Vt = np.linalg.svd((source - a).T @ (target - b))
    if np.linalg.det(Vt.T @ U.T) < 0:
        Vt[1] *= -1
    R = Vt.T @ U.T
    T = np.zeros((3, 3), dtype=source.dtype)
    T[:2, :2], T[:2, 2], T[2, 2] = R, b - R @ a, 1
    return T
