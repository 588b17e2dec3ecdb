# %% way: entry by entry
def jacobians(x_i, x_j, z):
    a = x_i[2] + z[2]
    c, s = np.cos(a), np.sin(a)
    dx, dy = x_j[:2] - x_i[:2]
    A = np.array([[-c, -s, c * dy - s * dx], [s, -c, -c * dx - s * dy], [0, 0, -1]], dtype=float)
    B = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]], dtype=float)
    return A, B

# %% way: matrices
def jacobians(x_i, x_j, z):
    def R(a):
        return np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])

    quarter = np.array([[0, -1], [1, 0]])
    A, B = np.zeros((3, 3)), np.eye(3)
    B[:2, :2] = R(x_i[2] + z[2]).T
    A[:2, :2] = -B[:2, :2]
    A[:2, 2] = R(z[2]).T @ (quarter @ R(x_i[2])).T @ (x_j - x_i)[:2]
    A[2, 2] = -1
    return A, B

# %% way: by the chain rule
def jacobians(x_i, x_j, z):
    def back(angle):
        c, s = np.cos(angle), np.sin(angle)
        return np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])

    way = back(x_i[2]) @ (x_j - x_i)
    swing = np.array([way[1], -way[0], 0])
    by_i = -back(x_i[2]) + np.column_stack([np.zeros((3, 2)), swing])
    return [back(z[2]) @ by_i, back(z[2]) @ back(x_i[2])]

# %% way: A of B and the way
def jacobians(x_i, x_j, z):
    a = x_i[2] + z[2]
    B = np.diag([np.cos(a), np.cos(a), 1.0])
    B[0, 1] = np.sin(a)
    B[1, 0] = -B[0, 1]
    dx, dy, _ = x_j - x_i
    T = np.eye(3)
    T[:2, 2] = -dy, dx
    return -B @ T, B

# %% right: complex numbers
def jacobians(x_i, x_j, z):
    w = np.exp(-1j * (x_i[2] + z[2]))
    d = complex(x_j[0] - x_i[0], x_j[1] - x_i[1])
    B = np.array([[w.real, -w.imag, 0], [w.imag, w.real, 0], [0, 0, 1.0]])
    A = -B.copy()
    swing = -1j * w * d
    A[0, 2], A[1, 2] = swing.real, swing.imag
    return A, B

# %% right: complex-step derivative of the unwrapped error
def jacobians(x_i, x_j, z):
    def e(v):
        a = v[2] + z[2]
        c, s, ci, si = np.cos(a), np.sin(a), np.cos(z[2]), np.sin(z[2])
        dx, dy = v[3] - v[0], v[4] - v[1]
        return np.array([
            c * dx + s * dy - (ci * z[0] + si * z[1]),
            c * dy - s * dx - (ci * z[1] - si * z[0]),
            v[5] - v[2] - z[2],
        ])

    v = np.concatenate([x_i, x_j]).astype(complex)
    J = np.zeros((3, 6))
    for k in range(6):
        w = v.copy()
        w[k] += 1e-20j
        J[:, k] = e(w).imag / 1e-20
    return J[:, :3], J[:, 3:]

# %% wrong: central differences of the unwrapped error, with exact steps of a power of two
def jacobians(x_i, x_j, z):
    def e(x_i, x_j):
        a = x_i[2] + z[2]
        d = x_j[:2] - x_i[:2]
        return np.array([
            np.cos(a) * d[0] + np.sin(a) * d[1],
            np.cos(a) * d[1] - np.sin(a) * d[0],
            x_j[2] - x_i[2],
        ])

    H = 2.0**-17 * np.eye(3)
    A = [(e(x_i + h, x_j) - e(x_i - h, x_j)) * 2.0**16 for h in H]
    B = [(e(x_i, x_j + h) - e(x_i, x_j - h)) * 2.0**16 for h in H]
    return np.array(A).T, np.array(B).T

# %% wrong: B with the identity for its rotation
def jacobians(x_i, x_j, z):
    t = x_i[2] + z[2]
    c, s = np.cos(t), np.sin(t)
    R = np.array([[c, s], [-s, c]])
    d = x_j[:2] - x_i[:2]
    A = np.zeros((3, 3))
    A[:2, :2], A[:2, 2], A[2, 2] = -R, R @ [d[1], -d[0]], -1
    return A, np.eye(3)

# %% wrong: rotation not transposed
def jacobians(x_i, x_j, z):
    t = x_i[2] + z[2]
    c, s = np.cos(t), np.sin(t)
    B = np.eye(3)
    B[:2, :2] = [[c, -s], [s, c]]
    A = -B
    dx, dy = x_j[:2] - x_i[:2]
    A[:2, 2] = [c * dy - s * dx, -c * dx - s * dy]
    return A, B

# %% wrong: differences that push the caller's own poses
def jacobians(x_i, x_j, z):
    h, out = 1e-6, []
    for x in (x_i, x_j):
        J = np.zeros((3, 3))
        for k in range(3):
            p = x
            before = error(x_i, x_j, z)
            p[k] += h
            d = error(x_i, x_j, z) - before
            d[2] = wrap(d[2])
            J[:, k] = d / h
        out.append(J)
    return out[0], out[1]

# %% wrong: derivative by a motion in each robot's own frame
def jacobians(x_i, x_j, z):
    def R(a):
        return np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])

    seen = between(x_i, x_j)
    A, B = -np.eye(3), np.eye(3)
    A[:2, :2] = -R(z[2]).T
    A[:2, 2] = R(z[2]).T @ np.array([seen[1], -seen[0]])
    B[:2, :2] = R(seen[2] - z[2])
    return A, B

# %% wrong: whole numbers: cos and sin are cut off in an int matrix
def jacobians(x_i, x_j, z):
    t = x_i[2] + z[2]
    B = np.diag([1, 1, 1])
    B[0, :2] = np.cos(t), np.sin(t)
    B[1, :2] = -np.sin(t), np.cos(t)
    A = -1.0 * B
    d = x_j[:2] - x_i[:2]
    A[0, 2] = B[1, :2] @ d
    A[1, 2] = -B[0, :2] @ d
    return A, B

# %% wrong: A and B are the same array
def jacobians(x_i, x_j, z):
    t = x_i[2] + z[2]
    c, s = np.cos(t), np.sin(t)
    B = np.array([[c, s, 0.0], [-s, c, 0.0], [0, 0, 1]])
    A = B
    A *= -1
    A[:2, 2] = c * (x_j[1] - x_i[1]) - s * (x_j[0] - x_i[0]), -c * (x_j[0] - x_i[0]) - s * (
        x_j[1] - x_i[1]
    )
    return A, B
