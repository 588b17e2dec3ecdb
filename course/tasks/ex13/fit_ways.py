"""Right ways through 13-best-motion, and other methods that go wrong."""

WAYS = {
    "mirror mended by a diagonal": """
def best_motion(source, target):
    a, b = np.mean(source, axis=0), np.mean(target, axis=0)
    U, _, Vt = np.linalg.svd((source - a).T @ (target - b))
    Rot = Vt.T @ np.diag([1, np.linalg.det(Vt.T @ U.T)]) @ U.T
    return np.block([[Rot, (b - Rot @ a)[:, None]], [np.zeros(2), np.ones(1)]])
""",
    "mirror mended in U, M by a loop": """
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
""",
    "angle in closed form": """
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    p, q = source - a, target - b
    sine, cosine = np.sum(p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]), np.sum(p * q)
    theta = np.arctan2(sine, cosine)
    c, s = np.cos(theta), np.sin(theta)
    x, y = b - np.array([[c, -s], [s, c]]) @ a
    return [[c, -s, x], [s, c, y], [0, 0, 1]]
""",
    "complex numbers": """
def best_motion(source, target):
    z, w = source @ [1, 1j], target @ [1, 1j]
    turn = np.vdot(z - z.mean(), w - w.mean())
    turn /= abs(turn)
    t = w.mean() - turn * z.mean()
    return np.array(
        [[turn.real, -turn.imag, t.real], [turn.imag, turn.real, t.imag], [0, 0, 1]]
    )
""",
    "scipy's Kabsch": """
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
""",
    "three motions after one another": """
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    M = (source - a).T @ (target - b)
    turn = np.array([[M[0, 0] + M[1, 1], M[1, 0] - M[0, 1]], [M[0, 1] - M[1, 0], M[0, 0] + M[1, 1]]])
    away, about, back = np.eye(3), np.eye(3), np.eye(3)
    away[:2, 2], back[:2, 2] = -a, b
    about[:2, :2] = turn / np.hypot(*turn[0])
    return back @ about @ away
""",
    "eigenvectors instead of singular ones": """
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
""",
}

# other methods, which go wrong
AFFINE = """
def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    A = np.linalg.lstsq(source - a, target - b, rcond=None)[0].T
    {turn}
    T = np.eye(3)
    T[:2, :2], T[:2, 2] = Rot, b - Rot @ a
    return T
"""
MAIN_AXES = """
def best_motion(source, target):
    def main(points):
        off = points - points.mean(axis=0)
        axis = {axis}
        return np.arctan2(axis[1], axis[0])
    t = main(target) - main(source)
    T = np.array([[np.cos(t), -np.sin(t), 0], [np.sin(t), np.cos(t), 0], [0, 0, 1]])
    T[:2, 2] = target.mean(axis=0) - T[:2, :2] @ source.mean(axis=0)
    return T
"""
STEPWISE = """
def best_motion(source, target):
    angle, t = 0.0, np.zeros(2)
    for _ in range({steps}):
        c, s = np.cos(angle), np.sin(angle)
        moved = source @ np.array([[c, s], [-s, c]])
        J = np.zeros((len(source), 2, 3))
        J[:, 0, 0] = J[:, 1, 1] = 1
        J[:, 0, 2], J[:, 1, 2] = -moved[:, 1], moved[:, 0]
        e = (target - moved - t).ravel()
        step = np.linalg.lstsq(J.reshape(-1, 3), e, rcond=None)[0]
        t, angle = t + step[:2], angle + step[2]
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, t[0]], [s, c, t[1]], [0, 0, 1]])
"""
