# %% way: Joseph's form
def locate(x, P, z, p, R):
    v = z - h(x, p)
    v[1] = wrap(v[1])
    H = H_robot(x, p)
    S = H @ P @ H.T + R
    K = np.linalg.solve(S, H @ P).T
    keep = np.eye(3) - K @ H
    return x + K @ v, keep @ P @ keep.T + K @ R @ K.T

# %% way: information
def locate(x, P, z, p, R):
    v = z - h(x, p)
    v[1] = (v[1] + np.pi) % (2 * np.pi) - np.pi
    H, weight = H_robot(x, p), np.linalg.inv(R)
    P = np.linalg.inv(np.linalg.inv(P) + H.T @ weight @ H)
    return x + P @ H.T @ weight @ v, P

# %% way: (I − K H) P, heading wrapped
def locate(x, P, z, p, R):
    v = z - h(x, p)
    v = np.array([v[0], np.arctan2(np.sin(v[1]), np.cos(v[1]))])
    H = H_robot(x, p)
    K = P @ H.T @ np.linalg.pinv(H @ P @ H.T + R)
    x = x + K @ v
    x[2] = wrap(x[2])
    return [x.tolist(), ((np.eye(3) - K @ H) @ P).tolist()]

# %% way: least squares
def locate(x, P, z, p, R):
    v = z - h(x, p)
    v[1] = wrap(v[1])
    belief, sight = (np.linalg.cholesky(np.linalg.inv(M)).T for M in (P, R))
    M = np.vstack([belief, sight @ H_robot(x, p)])
    step = np.linalg.lstsq(M, np.r_[np.zeros(3), sight @ v], rcond=None)[0]
    return x + step, np.linalg.inv(M.T @ M)

# %% way: H by differences
def locate(x, P, z, p, R):
    columns = []
    for e in 1e-6 * np.eye(3):
        d = h(x + e, p) - h(x - e, p)
        columns.append([d[0] / 2e-6, wrap(d[1]) / 2e-6])
    H = np.array(columns).T
    r, b = z - h(x, p)
    v = np.array([r, b - 2 * np.pi * np.round(b / (2 * np.pi))])
    S = H @ P @ H.T + R
    return x + P @ H.T @ np.linalg.solve(S, v), P - P @ H.T @ np.linalg.solve(S, H @ P)

# %% way: one number after the other, once they share nothing
def locate(x, P, z, p, R):
    L = np.linalg.cholesky(R)
    v = z - h(x, p)
    v[1] = wrap(v[1])
    H, v, here = np.linalg.solve(L, H_robot(x, p)), np.linalg.solve(L, v), x
    for k in range(2):
        K = P @ H[k] / (H[k] @ P @ H[k] + 1)
        here = here + K * (v[k] - H[k] @ (here - x))
        P = P - np.outer(K, H[k] @ P)
    return here, P

# %% right: (I - KH) P, heading wrapped at the end
def locate(x, P, z, p, R):
    H = H_robot(x, p)
    K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R)
    v = z - h(x, p)
    v[1] = np.arctan2(np.sin(v[1]), np.cos(v[1]))
    new = x + K @ v
    new[2] = wrap(new[2])
    return new, (np.eye(3) - K @ H) @ P

# %% wrong: divides by S[0, 0] instead of the inverse
def locate(x, P, z, p, R):
    H = H_robot(x, p)
    S = H @ P @ H.T + R
    K = P @ H.T / S[0, 0]
    v = z - h(x, p)
    v[1] = wrap(v[1])
    return x + K @ v, P - K @ S @ K.T

# %% wrong: the Jacobian at the new pose for P
def locate(x, P, z, p, R):
    def gain(at):
        H = H_robot(at, p)
        S = H @ P @ H.T + R
        return P @ H.T @ np.linalg.inv(S), S

    v = z - h(x, p)
    v[1] = wrap(v[1])
    K, S = gain(x)
    x = x + K @ v
    K, S = gain(x)
    return x, P - K @ S @ K.T

# %% wrong: wraps once by hand: with pi instead of 2 pi
def locate(x, P, z, p, R):
    v = z - h(x, p)
    if v[1] > np.pi:
        v[1] -= np.pi
    elif v[1] < -np.pi:
        v[1] += np.pi
    H = H_robot(x, p)
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T

# %% wrong: changes the sight z in place
def locate(x, P, z, p, R):
    z -= h(x, p)
    z[1] = wrap(z[1])
    H = H_robot(x, p)
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ z, P - K @ S @ K.T

# %% wrong: the sight is turned into a place in the world, and the pose moved by what that is off
def locate(x, P, z, p, R):
    place = g(x, z)
    J = J_z(x, z)
    a = x[2] + z[1]
    H = np.array([[1, 0, -z[0] * np.sin(a)], [0, 1, z[0] * np.cos(a)]])
    S = H @ P @ H.T + J @ R @ J.T
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (p - place), P - K @ S @ K.T
