# %% way: blocks one by one
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        A, B = jacobians(poses[i], poses[j], z)
        e = error(poses[i], poses[j], z)
        I, J = slice(3 * i, 3 * i + 3), slice(3 * j, 3 * j + 3)
        H[I, I] += A.T @ L @ A
        H[I, J] += A.T @ L @ B
        H[J, I] += B.T @ L @ A
        H[J, J] += B.T @ L @ B
        b[I] += A.T @ L @ e
        b[J] += B.T @ L @ e
    delta = np.zeros(3 * n)
    delta[3:] = -np.linalg.solve(H[3:, 3:], b[3:])
    moved = poses + delta.reshape(n, 3)
    moved[:, 2] = wrap(moved[:, 2])
    return moved

# %% way: pose 0 held by a strong prior
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((n, n, 3, 3)), np.zeros((n, 3))
    for i, j, z, L in edges:
        A, B = jacobians(poses[i], poses[j], z)
        e = error(poses[i], poses[j], z)
        for k, K in ((i, A), (j, B)):
            b[k] += K.T @ L @ e
            for m, M in ((i, A), (j, B)):
                H[k, m] += K.T @ L @ M
    H[0, 0] += 1e9 * np.eye(3)
    delta = np.linalg.solve(H.transpose(0, 2, 1, 3).reshape(3 * n, 3 * n), b.ravel())
    moved = poses - delta.reshape(n, 3)
    moved[:, 2] = np.arctan2(np.sin(moved[:, 2]), np.cos(moved[:, 2]))
    return moved

# %% way: rows of pose 0 replaced by the identity
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        J = np.zeros((3, n, 3))
        J[:, i], J[:, j] = jacobians(poses[i], poses[j], z)
        J = J.reshape(3, 3 * n)
        H += J.T @ L @ J
        b += J.T @ L @ error(poses[i], poses[j], z)
    H[:3], H[:, :3], b[:3] = 0, 0, 0
    H[:3, :3] = np.eye(3)
    delta = -np.linalg.inv(H) @ b
    better = np.array(poses)
    for k in range(n):
        better[k] = poses[k] + delta[3 * k : 3 * k + 3]
        better[k, 2] = wrap(better[k, 2])
    return better

# %% way: whitened least squares, no H
def step(poses, edges):
    rows, right = [], []
    for i, j, z, L in edges:
        A, B = jacobians(poses[i], poses[j], z)
        U = np.linalg.cholesky(L).T
        J = np.zeros((3, poses.size))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = U @ A, U @ B
        rows.append(J)
        right.append(-U @ error(poses[i], poses[j], z))
    delta = np.linalg.lstsq(np.vstack(rows)[:, 3:], np.concatenate(right), rcond=None)[0]
    better = np.array(poses)
    better[1:] += delta.reshape(-1, 3)
    better[:, 2] = wrap(better[:, 2])
    return better

# %% way: sparse, with scipy
def step(poses, edges):
    from scipy.sparse import csc_array, lil_array
    from scipy.sparse.linalg import spsolve
    n = len(poses)
    J, L, e = lil_array((3 * len(edges), 3 * n)), lil_array((3 * len(edges),) * 2), []
    for k, (i, j, z, information) in enumerate(edges):
        A, B = jacobians(poses[i], poses[j], z)
        at = slice(3 * k, 3 * k + 3)
        J[at, 3 * i : 3 * i + 3], J[at, 3 * j : 3 * j + 3] = A, B
        L[at, at] = information
        e.append(error(poses[i], poses[j], z))
    J, L = csc_array(J)[:, 3:], csc_array(L)
    delta = spsolve(csc_array(J.T @ L @ J), -(J.T @ L @ np.concatenate(e)))
    better = poses.copy()
    better[1:] += delta.reshape(-1, 3)
    better[:, 2] = wrap(better[:, 2])
    return better

# %% way: covariances, by Lagrange's multiplier
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n + 3, 3 * n + 3)), np.zeros(3 * n + 3)
    for i, j, z, L in edges:
        J = np.zeros((3, 3 * n + 3))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        JtL = np.linalg.solve(np.linalg.inv(L), J).T
        H += JtL @ J
        b -= JtL @ error(poses[i], poses[j], z)
    H[3 * n :, :3] = H[:3, 3 * n :] = np.eye(3)
    delta = np.linalg.solve(H, b)[: 3 * n].reshape(n, 3)
    return [[x, y, wrap(float(turn))] for x, y, turn in poses + delta]

# %% right: four blocks, H held by a stiff prior on pose 0
def step(poses, edges):
    n = len(poses)
    H = np.zeros((n, 3, n, 3))
    b = np.zeros((n, 3))
    for i, j, z, L in edges:
        A, B = jacobians(poses[i], poses[j], z)
        e = error(poses[i], poses[j], z)
        H[i, :, i] += A.T @ L @ A
        H[i, :, j] += A.T @ L @ B
        H[j, :, i] += B.T @ L @ A
        H[j, :, j] += B.T @ L @ B
        b[i] += A.T @ L @ e
        b[j] += B.T @ L @ e
    H[0, :, 0] += np.trace(H.reshape(3 * n, 3 * n)) / n * np.eye(3)
    delta = np.linalg.solve(H.reshape(3 * n, 3 * n), -b.ravel()).reshape(n, 3)
    delta[0] = 0
    x = poses + delta
    x[1:, 2] = wrap(x[1:, 2])
    return x

# %% wrong: poses changed in place
def step(poses, edges):
    n = 3 * len(poses)
    H, b = np.zeros((n, n)), np.zeros(n)
    for i, j, z, L in edges:
        A, B = jacobians(poses[i], poses[j], z)
        J = np.zeros((3, n))
        J[:, 3 * i:3 * i + 3], J[:, 3 * j:3 * j + 3] = A, B
        H += J.T @ L @ J
        b += J.T @ L @ error(poses[i], poses[j], z)
    poses[1:] -= np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
    poses[:, 2] = wrap(poses[:, 2])
    return poses

# %% wrong: pose 0 is set to the origin
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        J = np.zeros((3, 3 * n))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        H += J.T @ L @ J
        b += J.T @ L @ error(poses[i], poses[j], z)
    new = np.zeros((n, 3))
    new[1:] = poses[1:] - np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
    new[:, 2] = wrap(new[:, 2])
    return new

# %% wrong: number of poses counted from a chain of edges
def step(poses, edges):
    n = max(j for _, j, _, _ in edges) + 1
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        J = np.zeros((3, 3 * n))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        H += J.T @ L @ J
        b += J.T @ L @ error(poses[i], poses[j], z)
    new = poses.copy()
    new[1:] -= np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
    new[:, 2] = wrap(new[:, 2])
    return new

# %% wrong: only x and y of pose 0 are held, its heading goes free (least squares)
def step(poses, edges):
    n = len(poses)
    J, e, k = np.zeros((3 * len(edges), 3 * n)), np.zeros(3 * len(edges)), 0
    for i, j, z, L in edges:
        U = np.linalg.cholesky(L).T
        A, B = jacobians(poses[i], poses[j], z)
        J[k : k + 3, 3 * i : 3 * i + 3] = U @ A
        J[k : k + 3, 3 * j : 3 * j + 3] = U @ B
        e[k : k + 3] = U @ error(poses[i], poses[j], z)
        k += 3
    delta = np.zeros(3 * n)
    delta[2:] = -np.linalg.lstsq(J[:, 2:], e, rcond=1e-10)[0]
    new = poses + delta.reshape(n, 3)
    new[:, 2] = wrap(new[:, 2])
    return new
