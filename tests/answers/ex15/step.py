"""Independent answers to 15-step: right ones, and students' mistakes."""

RIGHT = [
    (
        "15-step",
        "four blocks, H held by a stiff prior on pose 0",
        """
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
""",
    ),
    (
        "15-step",
        "least squares on the stacked, whitened edges",
        """
def step(poses, edges):
    n, rows, rhs = len(poses), [], []
    for i, j, z, L in edges:
        U = np.linalg.cholesky(L).T
        A, B = jacobians(poses[i], poses[j], z)
        row = np.zeros((3, n, 3))
        row[:, i] = U @ A
        row[:, j] = U @ B
        rows.append(row[:, 1:].reshape(3, -1))
        rhs.append(-U @ error(poses[i], poses[j], z))
    delta, *_ = np.linalg.lstsq(np.vstack(rows), np.concatenate(rhs), rcond=None)
    new = [np.array(poses[0])]
    for p, d in zip(poses[1:], delta.reshape(-1, 3)):
        q = p + d
        new.append(np.array([q[0], q[1], wrap(float(q[2]))]))
    return np.array(new)
""",
    ),
]

WRONG = [
    (
        "15-step",
        "goes uphill: the minus before b forgotten",
        """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        J = np.zeros((3, 3 * n))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        H += J.T @ L @ J
        b += J.T @ L @ error(poses[i], poses[j], z)
    delta = np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
    new = np.vstack([poses[:1], poses[1:] + delta])
    new[:, 2] = wrap(new[:, 2])
    return new
""",
    ),
    (
        "15-step",
        "headings are not wrapped",
        """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        A, B = jacobians(poses[i], poses[j], z)
        e = error(poses[i], poses[j], z)
        at = np.r_[3 * i : 3 * i + 3, 3 * j : 3 * j + 3]
        J = np.hstack([A, B])
        H[np.ix_(at, at)] += J.T @ L @ J
        b[at] += J.T @ L @ e
    delta = np.zeros(3 * n)
    delta[3:] = np.linalg.solve(H[3:, 3:], -b[3:])
    return poses + delta.reshape(n, 3)
""",
    ),
    (
        "15-step",
        "moves the caller's poses in place",
        """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((n, n, 3, 3)), np.zeros((n, 3))
    for i, j, z, L in edges:
        e, (A, B) = error(poses[i], poses[j], z), jacobians(poses[i], poses[j], z)
        for p, P in ((i, A), (j, B)):
            b[p] += P.T @ L @ e
            for q, Q in ((i, A), (j, B)):
                H[p, q] += P.T @ L @ Q
    H = H[1:, 1:].swapaxes(1, 2).reshape(3 * n - 3, 3 * n - 3)
    poses[1:] -= np.linalg.solve(H, b[1:].ravel()).reshape(-1, 3)
    poses[:, 2] = wrap(poses[:, 2])
    return poses
""",
    ),
    (
        "15-step",
        "iterates until nothing moves instead of one step",
        """
def step(poses, edges):
    x, n = poses.copy(), len(poses)
    for _ in range(20):
        H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
        for i, j, z, L in edges:
            J = np.zeros((3, 3 * n))
            J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(x[i], x[j], z)
            H += J.T @ L @ J
            b += J.T @ L @ error(x[i], x[j], z)
        delta = np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
        x[1:] -= delta
        x[:, 2] = wrap(x[:, 2])
        if np.abs(delta).max() < 1e-9:
            break
    return x
""",
    ),
    (
        "15-step",
        "nobody is held: the shortest step by the pseudo-inverse",
        """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        J = np.zeros((3, 3 * n))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        H += J.T @ L @ J
        b += J.T @ L @ error(poses[i], poses[j], z)
    new = poses - (np.linalg.pinv(H, rcond=1e-10) @ b).reshape(n, 3)
    new[:, 2] = wrap(new[:, 2])
    return new
""",
    ),
    (
        "15-step",
        "pseudo-inverse for all, then pose 0 is simply put back",
        """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        J = np.zeros((3, 3 * n))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        H += J.T @ L @ J
        b += J.T @ L @ error(poses[i], poses[j], z)
    delta = np.linalg.lstsq(H, -b, rcond=1e-10)[0].reshape(n, 3)
    delta[0] = 0.0
    new = poses + delta
    new[:, 2] = wrap(new[:, 2])
    return new
""",
    ),
    (
        "15-step",
        "blocks of H overwritten where edges share a pose",
        """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        A, B = jacobians(poses[i], poses[j], z)
        e = error(poses[i], poses[j], z)
        I, K = slice(3 * i, 3 * i + 3), slice(3 * j, 3 * j + 3)
        H[I, I] += A.T @ L @ A
        H[K, K] += B.T @ L @ B
        H[I, K] = A.T @ L @ B
        H[K, I] = B.T @ L @ A
        b[I] += A.T @ L @ e
        b[K] += B.T @ L @ e
    delta = np.linalg.solve(H[3:, 3:], -b[3:])
    out = poses.copy()
    out[1:] += delta.reshape(-1, 3)
    out[:, 2] = wrap(out[:, 2])
    return out
""",
    ),
    (
        "15-step",
        "several edges between two poses: a dict keeps only the last",
        """
def step(poses, edges):
    n = len(poses)
    between_two = {(i, j): (z, L) for i, j, z, L in edges}
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for (i, j), (z, L) in between_two.items():
        J = np.zeros((3, 3 * n))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        H += J.T @ L @ J
        b += J.T @ L @ error(poses[i], poses[j], z)
    better = poses.copy()
    better[1:] -= np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
    better[:, 2] = wrap(better[:, 2])
    return better
""",
    ),
    (
        "15-step",
        "only the upper blocks are filled and mirrored: edges that point back get lost",
        """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        A, B = jacobians(poses[i], poses[j], z)
        e = error(poses[i], poses[j], z)
        H[3 * i : 3 * i + 3, 3 * i : 3 * i + 3] += A.T @ L @ A
        H[3 * j : 3 * j + 3, 3 * j : 3 * j + 3] += B.T @ L @ B
        H[3 * i : 3 * i + 3, 3 * j : 3 * j + 3] += A.T @ L @ B
        b[3 * i : 3 * i + 3] += A.T @ L @ e
        b[3 * j : 3 * j + 3] += B.T @ L @ e
    H = np.triu(H) + np.triu(H, 1).T
    better = poses.copy()
    better[1:] -= np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
    better[:, 2] = wrap(better[:, 2])
    return better
""",
    ),
    (
        "15-step",
        "edges that point back are turned round by negating z",
        """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        if i > j:
            i, j, z = j, i, -np.asarray(z)
        J = np.zeros((3, 3 * n))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        H += J.T @ L @ J
        b += J.T @ L @ error(poses[i], poses[j], z)
    better = poses.copy()
    better[1:] -= np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
    better[:, 2] = wrap(better[:, 2])
    return better
""",
    ),
    (
        "15-step",
        "information taken for a covariance and inverted",
        """
def step(poses, edges):
    size = 3 * len(poses)
    H, b = np.zeros((size, size)), np.zeros(size)
    for i, j, z, covariance in edges:
        W = np.linalg.inv(covariance)
        J = np.zeros((3, size))
        A, B = jacobians(poses[i], poses[j], z)
        J[:, 3 * i : 3 * (i + 1)] = A
        J[:, 3 * j : 3 * (j + 1)] = B
        H = H + J.T @ W @ J
        b = b + J.T @ W @ error(poses[i], poses[j], z)
    delta = np.concatenate([np.zeros(3), -np.linalg.solve(H[3:, 3:], b[3:])])
    new = poses + delta.reshape(-1, 3)
    new[:, 2] = wrap(new[:, 2])
    return new
""",
    ),
    (
        "15-step",
        "only the diagonal of the information counts",
        """
def step(poses, edges):
    n, J, r = len(poses), [], []
    for i, j, z, L in edges:
        w = np.sqrt(np.diag(L))
        A, B = jacobians(poses[i], poses[j], z)
        row = np.zeros((3, 3 * n))
        row[:, 3 * i : 3 * i + 3] = w[:, None] * A
        row[:, 3 * j : 3 * j + 3] = w[:, None] * B
        J.append(row[:, 3:])
        r.append(w * error(poses[i], poses[j], z))
    delta = -np.linalg.lstsq(np.vstack(J), np.concatenate(r), rcond=None)[0]
    new = poses.copy()
    new[1:] += delta.reshape(-1, 3)
    new[:, 2] = wrap(new[:, 2])
    return new
""",
    ),
    (
        "15-step",
        "delta is composed on in the robot's frame, not added",
        """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        J = np.zeros((3, 3 * n))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        H += J.T @ L @ J
        b += J.T @ L @ error(poses[i], poses[j], z)
    delta = np.zeros((n, 3))
    delta[1:] = -np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
    return compose(poses, delta)
""",
    ),
    (
        "15-step",
        "damped (Levenberg): H + I",
        """
def step(poses, edges):
    m = 3 * (len(poses) - 1)
    H, b = np.eye(m + 3), np.zeros(m + 3)
    for i, j, z, L in edges:
        J = np.zeros((3, m + 3))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        H += J.T @ L @ J
        b += J.T @ L @ error(poses[i], poses[j], z)
    new = np.array(poses)
    new[1:] -= np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
    new[:, 2] = wrap(new[:, 2])
    return new
""",
    ),
    (
        "15-step",
        "wraps the whole array, metres too",
        """
def step(poses, edges):
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, L in edges:
        J = np.zeros((3, 3 * n))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        H += J.T @ L @ J
        b += J.T @ L @ error(poses[i], poses[j], z)
    d = np.zeros(3 * n)
    d[3:] = np.linalg.solve(H[3:, 3:], -b[3:])
    return wrap(poses + d.reshape(n, 3))
""",
    ),
    (
        "15-step",
        "pose 0 is set to the origin",
        """
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
""",
    ),
    (
        "15-step",
        "number of poses counted from a chain of edges",
        """
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
""",
    ),
    (
        "15-step",
        "only x and y of pose 0 are held, its heading goes free (least squares)",
        """
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
""",
    ),
    (
        "15-step",
        "edge by edge: pose j is moved where each edge wants it",
        """
def step(poses, edges):
    new = poses.copy()
    for i, j, z, L in edges:
        A, B = jacobians(new[i], new[j], z)
        H = B.T @ L @ B
        b = B.T @ L @ error(new[i], new[j], z)
        if j > 0:
            new[j] -= np.linalg.solve(H, b)
    new[:, 2] = wrap(new[:, 2])
    return new
""",
    ),
]
