# %% way: least squares over fewer unknowns
def merge(x, P, i, j):
    n = len(x)
    M = np.eye(n)
    M[3 + 2 * j : 5 + 2 * j] = M[3 + 2 * i : 5 + 2 * i]
    M = np.delete(M, [3 + 2 * j, 4 + 2 * j], axis=1)
    W = np.linalg.inv(P)
    small = np.linalg.inv(M.T @ W @ M)
    return small @ M.T @ W @ x, small

# %% way: j stays, and takes the place of i
def merge(x, P, i, j):
    a, b = slice(3 + 2 * i, 5 + 2 * i), slice(3 + 2 * j, 5 + 2 * j)
    B = P[:, a] - P[:, b]
    S = B[a] - B[b]
    K = np.linalg.solve(S, B.T).T
    x, P = x + K @ (x[b] - x[a]), P - K @ B.T
    order = [k for k in range(len(x)) if k not in (3 + 2 * i, 4 + 2 * i)]
    at = order.index(3 + 2 * j)
    both = order[at : at + 2]
    rest = order[:at] + order[at + 2 :]
    to = 3 + 2 * (i - (j < i))
    order = rest[:to] + both + rest[to:]
    return x[order], P[np.ix_(order, order)]

# %% way: one coordinate after the other
def merge(x, P, i, j):
    x, P = x.copy(), P.copy()
    for k in range(2):
        d = np.zeros(len(x))
        d[3 + 2 * i + k], d[3 + 2 * j + k] = 1, -1
        gain = P @ d / (d @ P @ d)
        x = x - gain * (d @ x)
        P = P - np.outer(gain, d @ P)
    keep = np.ones(len(x), dtype=bool)
    keep[3 + 2 * j : 5 + 2 * j] = False
    return x[keep], P[keep][:, keep]

# %% way: Joseph's form
def merge(x, P, i, j):
    D = np.zeros((2, len(x)))
    for k in range(2):
        D[k, 3 + 2 * j + k], D[k, 3 + 2 * i + k] = 1, -1
    K = P @ D.T @ np.linalg.inv(D @ P @ D.T)
    I_KD = np.eye(len(x)) - K @ D
    gone = np.s_[3 + 2 * j : 5 + 2 * j]
    new = I_KD @ P @ I_KD.T
    return np.delete(I_KD @ x, gone), np.delete(np.delete(new, gone, 0), gone, 1)

# %% pasted: the lesson's update, the two compared as measurements
def merge(x, P, i, j):
    a, b = 3 + 2 * i, 3 + 2 * j
    H = np.zeros((2, len(x)))
    H[:, :3], H[:, a : a + 2] = H_robot(x[:3], x[a : a + 2]), H_landmark(x[:3], x[a : a + 2])
    v = h(x[:3], x[b : b + 2]) - h(x[:3], x[a : a + 2])
    S = H @ P @ H.T + 1e-9 * np.eye(2)
    K = P @ H.T @ np.linalg.inv(S)
    x, P = x + K @ v, P - K @ S @ K.T
    gone = [b, b + 1]
    return np.delete(x, gone), np.delete(np.delete(P, gone, axis=0), gone, axis=1)

# %% pasted: the lesson's removal of a landmark
def merge(x, P, i, j):
    keep = [k for k in range(len(x)) if k not in (3 + 2 * j, 4 + 2 * j)]
    return x[keep], P[np.ix_(keep, keep)]

# %% right: the information of a certain difference, by an orthogonal projection
def merge(x, P, i, j):
    n = len(x)
    H = np.zeros((2, n))
    H[:, 3 + 2 * i:5 + 2 * i] = np.eye(2)
    H[:, 3 + 2 * j:5 + 2 * j] -= np.eye(2)
    K = np.linalg.solve(H @ P @ H.T, H @ P).T
    A = np.eye(n) - K @ H
    x, P = A @ x, A @ P @ A.T
    keep = [k for k in range(n) if k not in (3 + 2 * j, 4 + 2 * j)]
    return x[keep], P[np.ix_(keep, keep)]

# %% right: changes to the coordinates (all without j, difference) and conditions the Gaussian on difference 0
def merge(x, P, i, j):
    n = len(x)
    keep = [k for k in range(n) if k not in (3 + 2 * j, 4 + 2 * j)]
    T = np.vstack([np.eye(n)[keep], np.zeros((2, n))])
    for k in range(2):
        T[n - 2 + k, 3 + 2 * i + k] = 1
        T[n - 2 + k, 3 + 2 * j + k] = -1
    y, Q = T @ x, T @ P @ T.T
    m = n - 2
    G = np.linalg.solve(Q[m:, m:], Q[m:, :m]).T
    return y[:m] - G @ y[m:], Q[:m, :m] - G @ Q[m:, :m]

# %% right: condition on the difference, blocks by index
def merge(x, P, i, j):
    a, b = np.array([3, 4]) + 2 * i, np.array([3, 4]) + 2 * j
    cross = P[:, a] - P[:, b]              # cov(state, p_i - p_j)
    S = cross[a] - cross[b]
    gain = np.linalg.solve(S, cross.T).T
    mean = x - gain @ (x[a] - x[b])
    cov = P - gain @ cross.T
    left = np.setdiff1d(np.arange(len(x)), b)
    return mean[left], cov[np.ix_(left, left)]

# %% right: as a difference variable that is conditioned on
def merge(x, P, i, j):
    n = len(x)
    T = np.eye(n)
    T[3 + 2 * j, 3 + 2 * i] = T[4 + 2 * j, 4 + 2 * i] = -1
    y, Q = T @ x, T @ P @ T.T
    d = [3 + 2 * j, 4 + 2 * j]
    o = [k for k in range(n) if k not in d]
    G = np.linalg.solve(Q[np.ix_(d, d)], Q[np.ix_(d, o)]).T
    return y[o] - G @ y[d], Q[np.ix_(o, o)] - G @ Q[np.ix_(d, o)]

# %% wrong: plain mean of the two places (half of each) whatever P says: no weights, and the rest of the state learns nothing
def merge(x, P, i, j):
    T = np.eye(len(x))
    ri, rj = [3 + 2 * i, 4 + 2 * i], [3 + 2 * j, 4 + 2 * j]
    T[ri, ri] = 0.5
    T[ri, rj] = 0.5
    T = np.delete(T, rj, axis=0)
    return T @ x, T @ P @ T.T

# %% wrong: robot and bystanders get no gain
def merge(x, P, i, j):
    D = np.zeros((2, len(x)))
    for k in range(2):
        D[k, 3 + 2 * i + k], D[k, 3 + 2 * j + k] = 1, -1
    S = D @ P @ D.T
    K = P @ D.T @ np.linalg.inv(S)
    K[:3] = 0                              # nobody has measured anything from the robot
    x, P = x - K @ D @ x, P - K @ S @ K.T
    keep = [k for k in range(len(x)) if k not in (3 + 2 * j, 4 + 2 * j)]
    return x[keep], P[np.ix_(keep, keep)]

# %% wrong: with a noise of 3 cm, so that S is not singular
def merge(x, P, i, j):
    D = np.zeros((2, len(x)))
    D[:, 3 + 2 * i:5 + 2 * i] = np.eye(2)
    D[:, 3 + 2 * j:5 + 2 * j] = -np.eye(2)
    S = D @ P @ D.T + 0.03**2 * np.eye(2)
    K = P @ D.T @ np.linalg.inv(S)
    v = np.zeros(2) - D @ x
    x, P = x + K @ v, P - K @ S @ K.T
    gone = [3 + 2 * j, 4 + 2 * j]
    return np.delete(x, gone), np.delete(np.delete(P, gone, axis=0), gone, axis=1)

# %% wrong: deletes one after the other, indices moved meanwhile
def merge(x, P, i, j):
    D = np.zeros((2, len(x)))
    D[:, 3 + 2 * i:5 + 2 * i] = np.eye(2)
    D[:, 3 + 2 * j:5 + 2 * j] = -np.eye(2)
    S = D @ P @ D.T
    K = P @ D.T @ np.linalg.inv(S)
    x, P = x - K @ D @ x, P - K @ S @ K.T
    for k in (3 + 2 * j, 4 + 2 * j):
        k = min(k, len(x) - 1)
        x = np.delete(x, k)
        P = np.delete(np.delete(P, k, 0), k, 1)
    return x, P

# %% wrong: strikes j out first, then finds i at its old number
def merge(x, P, i, j):
    xj = x[3 + 2 * j:5 + 2 * j]
    Pj = P[3 + 2 * j:5 + 2 * j, 3 + 2 * j:5 + 2 * j]
    gone = [3 + 2 * j, 4 + 2 * j]
    cross = np.delete(P[gone], gone, axis=1)
    x, P = np.delete(x, gone), np.delete(np.delete(P, gone, 0), gone, 1)
    H = np.zeros((2, len(x)))
    its = slice(3 + 2 * i, 5 + 2 * i)
    H[:, its] = np.eye(2)
    C = P @ H.T - cross.T
    S = H @ P @ H.T + Pj - H @ cross.T - cross @ H.T
    K = C @ np.linalg.inv(S)
    return x - K @ (H @ x - xj), P - K @ S @ K.T

# %% wrong: merged landmark goes to the end
def merge(x, P, i, j):
    n = len(x)
    D = np.zeros((2, n))
    D[:, 3 + 2 * i:5 + 2 * i] = np.eye(2)
    D[:, 3 + 2 * j:5 + 2 * j] = -np.eye(2)
    S = D @ P @ D.T
    K = P @ D.T @ np.linalg.inv(S)
    x, P = x - K @ D @ x, P - K @ S @ K.T
    both = {3 + 2 * i, 4 + 2 * i, 3 + 2 * j, 4 + 2 * j}
    order = [k for k in range(n) if k not in both] + [3 + 2 * i, 4 + 2 * i]
    return x[order], P[np.ix_(order, order)]

# %% wrong: the correction is made in the caller's arrays
def merge(x, P, i, j):
    a, b = np.arange(2) + 3 + 2 * i, np.arange(2) + 3 + 2 * j
    C = P[:, a] - P[:, b]
    S = C[a] - C[b]
    K = C @ np.linalg.inv(S)
    x -= K @ (x[a] - x[b])
    P -= K @ S @ K.T
    left = np.setdiff1d(np.arange(len(x)), b)
    return x[left], P[np.ix_(left, left)]

# %% wrong: with a noise of 1 cm
def merge(x, P, i, j):
    D = np.zeros((2, len(x)))
    D[:, 3 + 2 * i : 5 + 2 * i] = np.eye(2)
    D[:, 3 + 2 * j : 5 + 2 * j] = -np.eye(2)
    S = D @ P @ D.T + 1e-4 * np.eye(2)
    K = P @ D.T @ np.linalg.inv(S)
    x, P = x - K @ D @ x, P - K @ S @ K.T
    keep = np.delete(np.arange(len(x)), [3 + 2 * j, 4 + 2 * j])
    return x[keep], P[np.ix_(keep, keep)]
