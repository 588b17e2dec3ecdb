"""An eighth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = []

WRONG = [
    (
        "13-best-motion",
        "scipy's Procrustes, which standardises the clouds and may mirror",
        """
from scipy.linalg import orthogonal_procrustes

def best_motion(source, target):
    a, b = source.mean(axis=0), target.mean(axis=0)
    Rot, _ = orthogonal_procrustes(source - a, target - b)
    T = np.eye(3)
    T[:2, :2] = Rot.T
    T[:2, 2] = b - Rot.T @ a
    return T
""",
    ),
    (
        "13-icp",
        "first the centroids over each other, then the rounds",
        """
def icp(source, target, T, rounds):
    T = T.copy()
    T[:2, 2] += target.mean(axis=0) - carry(T, source).mean(axis=0)
    for _ in range(rounds):
        _, row = nearest(carry(T, source), target)
        T = best_motion(source, target[row])
    return T
""",
    ),
    (
        "13-trimmed",
        "weights that fall with the distance instead of a cut",
        """
def trimmed_icp(source, target, T, rounds, share):
    for _ in range(rounds):
        at = carry(T, source)
        d, row = nearest(at, target)
        w = np.exp(-((d / np.quantile(d, share)) ** 2))
        a, b = np.average(at, axis=0, weights=w), np.average(target[row], axis=0, weights=w)
        p, q = at - a, target[row] - b
        angle = np.arctan2(np.sum(w * (p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0])), np.sum(w * np.sum(p * q, axis=1)))
        M = np.eye(3)
        M[:2, :2] = turned(angle)
        M[:2, 2] = b - M[:2, :2] @ a
        T = M @ T
    return T
""",
    ),
    (
        "13-line-step",
        "five Gauss-Newton steps in a loop, T moved in between, the last δ returned",
        """
def line_step(source, target, normals, sigma, T, Q):
    for _ in range(5):
        Rot, t = T[:2, :2], T[:2, 2]
        e = np.sum(normals * (source @ Rot.T + t - target), axis=1)
        m = normals @ Rot
        J = np.column_stack([m, source[:, 0] * m[:, 1] - source[:, 1] * m[:, 0]])
        P = np.linalg.inv(np.linalg.inv(Q) + J.T @ (J / sigma[:, None] ** 2))
        delta = -P @ J.T @ (e / sigma**2)
        D = np.eye(3)
        D[:2, :2], D[:2, 2] = turned(delta[2]), delta[:2]
        T = T @ D
    return delta, P
""",
    ),
]
