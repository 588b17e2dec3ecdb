# %% way: with complex numbers
def trajectory_errors(estimate, truth, steps):
    p, q = (poses[:, :2] @ [1, 1j] for poses in (estimate, truth))
    a, b = p - p.mean(), q - q.mean()
    turn = np.vdot(a, b)
    turn = turn / abs(turn) if abs(turn) > 0 else 1.0
    m = [(z[steps:] - z[:-steps]) * np.exp(-1j * poses[:-steps, 2]) for z, poses in ((p, estimate), (q, truth))]
    return np.sqrt(np.mean(abs(turn * a - b) ** 2)), np.sqrt(np.mean(abs(m[0] - m[1]) ** 2))

# %% way: by an SVD
def trajectory_errors(estimate, truth, steps):
    a, b = (poses[:, :2] - poses[:, :2].mean(axis=0) for poses in (estimate, truth))
    U, _, Vt = np.linalg.svd(a.T @ b)
    R = Vt.T @ np.diag([1, np.linalg.det(Vt.T @ U.T)]) @ U.T
    ate = np.linalg.norm(a @ R.T - b) / np.sqrt(len(a))
    squares = []
    for i in range(len(truth) - steps):
        m, found = between(truth[i], truth[i + steps]), between(estimate[i], estimate[i + steps])
        squares.append(np.sum((found - m)[:2] ** 2))
    return [ate, np.sqrt(np.mean(squares))]

# %% way: from the sums of squares, without aligned positions
def trajectory_errors(estimate, truth, steps):
    a, b = (poses[:, :2] - poses[:, :2].mean(axis=0) for poses in (estimate, truth))
    M = a.T @ b
    most = np.hypot(M[0, 0] + M[1, 1], M[0, 1] - M[1, 0])
    angle = np.arctan2(M[0, 1] - M[1, 0], M[0, 0] + M[1, 1])
    c, s = np.cos(angle), np.sin(angle)
    off = np.column_stack([c * a[:, 0] - s * a[:, 1] - b[:, 0], s * a[:, 0] + c * a[:, 1] - b[:, 1]])
    m, found = (between(poses[:-steps], poses[steps:]) for poses in (truth, estimate))
    return np.sqrt(np.mean(np.sum(off * off, axis=1))), np.sqrt(2 * np.mean((found - m)[:, :2] ** 2))

# %% pasted: the lesson's ATE of trajectories that begin at the same pose
def trajectory_errors(estimate, truth, steps):
    off = (estimate - truth)[:, :2]
    return np.sqrt(np.mean(np.sum(off**2, axis=1))), np.sqrt(np.mean(np.sum(np.diff(off, axis=0) ** 2, axis=1)))

# %% right: the angle by numerical search, refined
def trajectory_errors(estimate, truth, steps):
    from scipy.optimize import minimize_scalar
    a = estimate[:, :2] - estimate[:, :2].mean(0)
    b = truth[:, :2] - truth[:, :2].mean(0)

    def cost(t):
        c, s = np.cos(t), np.sin(t)
        return np.mean(np.sum((a @ np.array([[c, s], [-s, c]]) - b) ** 2, axis=1))

    grid = np.linspace(-np.pi, np.pi, 60)
    t = grid[np.argmin([cost(t) for t in grid])]
    best = minimize_scalar(cost, bounds=(t - 0.2, t + 0.2), method="bounded", options={"xatol": 1e-9})
    e = [between(between(truth[i], truth[i + steps]), between(estimate[i], estimate[i + steps]))[:2]
         for i in range(len(truth) - steps)]
    return np.sqrt(min(best.fun, cost(t))), np.sqrt(np.mean(np.sum(np.square(e), axis=1)))

# %% right: homogeneous matrices
def trajectory_errors(estimate, truth, steps):
    def matrix(pose):
        c, s = np.cos(pose[2]), np.sin(pose[2])
        return np.array([[c, -s, pose[0]], [s, c, pose[1]], [0, 0, 1]])

    E, T = [matrix(p) for p in estimate], [matrix(p) for p in truth]
    squares = []
    for i in range(len(T) - steps):
        true = np.linalg.solve(T[i], T[i + steps])
        seen = np.linalg.solve(E[i], E[i + steps])
        squares.append(np.sum(np.linalg.solve(true, seen)[:2, 2] ** 2))
    P, Q = np.array([m[:2, 2] for m in E]), np.array([m[:2, 2] for m in T])
    P, Q = P - P.mean(0), Q - Q.mean(0)
    S, C = np.sum(P[:, 0] * Q[:, 1] - P[:, 1] * Q[:, 0]), np.sum(P * Q)
    R = matrix([0, 0, np.arctan2(S, C)])[:2, :2]
    return np.sqrt(np.mean(np.sum((P @ R.T - Q) ** 2, axis=1))), np.sqrt(np.mean(squares))

# %% wrong: the estimate is moved by the mean error and the mean heading error
def trajectory_errors(estimate, truth, steps):
    off = wrap(truth[:, 2] - estimate[:, 2])
    turn = np.arctan2(np.mean(np.sin(off)), np.mean(np.cos(off)))
    moved = compose(np.array([0, 0, turn]), estimate)[:, :2]
    moved = moved + (truth[:, :2] - moved).mean(axis=0)
    e = between(between(truth[:-steps], truth[steps:]), between(estimate[:-steps], estimate[steps:]))
    return np.sqrt(np.mean(np.sum((moved - truth[:, :2]) ** 2, 1))), np.sqrt(np.mean(np.sum(e[:, :2] ** 2, 1)))

# %% wrong: RPE of the aligned positions
def trajectory_errors(estimate, truth, steps):
    a, b = (poses[:, :2] - poses[:, :2].mean(axis=0) for poses in (estimate, truth))
    angle = np.arctan2(np.sum(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]), np.sum(a * b))
    c, s = np.cos(angle), np.sin(angle)
    off = a @ np.array([[c, s], [-s, c]]) - b
    return np.sqrt(np.mean(np.sum(off**2, 1))), np.sqrt(np.mean(np.sum((off[steps:] - off[:-steps]) ** 2, 1)))

# %% wrong: SVD without its determinant
def trajectory_errors(estimate, truth, steps):
    a, b = (poses[:, :2] - poses[:, :2].mean(axis=0) for poses in (estimate, truth))
    U, _, Vt = np.linalg.svd(a.T @ b)
    e = between(between(truth[:-steps], truth[steps:]), between(estimate[:-steps], estimate[steps:]))
    return np.sqrt(np.mean(np.sum((a @ (U @ Vt) - b) ** 2, 1))), np.sqrt(np.mean(np.sum(e[:, :2] ** 2, 1)))
