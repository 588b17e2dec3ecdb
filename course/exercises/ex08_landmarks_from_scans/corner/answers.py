# %% way: solve instead of inv
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z1[1]), np.sin(z1[1])], [np.cos(z2[1]), np.sin(z2[1])]])
    p = np.linalg.solve(N, np.array([z1[0], z2[0]]))
    T = np.array([[-N[0, 1], N[0, 0]], [-N[1, 1], N[1, 0]]])
    lever = T @ p
    D = np.zeros((2, 2))
    D[0, 0] = R1[0, 0] - 2 * lever[0] * R1[0, 1] + lever[0] ** 2 * R1[1, 1]
    D[1, 1] = R2[0, 0] - 2 * lever[1] * R2[0, 1] + lever[1] ** 2 * R2[1, 1]
    half = np.linalg.solve(N, D)
    return p, np.linalg.solve(N, half.T).T

# %% way: written out
def corner(z1, R1, z2, R2):
    (r1, a1), (r2, a2) = z1, z2
    s = np.sin(a2 - a1)
    c = np.cos(a2 - a1)
    x = (r1 * np.sin(a2) - r2 * np.sin(a1)) / s
    y = (r2 * np.cos(a1) - r1 * np.cos(a2)) / s
    first = np.array([np.sin(a2), -np.cos(a2)]) / s
    second = np.array([-np.sin(a1), np.cos(a1)]) / s
    J1 = np.column_stack([first, first * (r1 * c - r2) / s])
    J2 = np.column_stack([second, second * (r1 - r2 * c) / s])
    return (x, y), J1 @ R1 @ J1.T + J2 @ R2 @ J2.T

# %% way: one Jacobian of four columns
def corner(z1, R1, z2, R2):
    n = [np.array([np.cos(z[1]), np.sin(z[1])]) for z in (z1, z2)]
    back = np.linalg.inv(np.vstack(n))
    p = back @ [z1[0], z2[0]]
    inner = np.zeros((2, 4))
    for k in range(2):
        inner[k, 2 * k : 2 * k + 2] = 1, p[0] * n[k][1] - p[1] * n[k][0]
    J = back @ inner
    R = np.block([[R1, np.zeros((2, 2))], [np.zeros((2, 2)), R2]])
    return p, np.einsum("ia,ab,jb->ij", J, R, J)

# %% way: complex numbers
def corner(z1, R1, z2, R2):
    n1, n2 = np.exp(1j * z1[1]), np.exp(1j * z2[1])
    det = (n1.conjugate() * n2).imag
    p = 1j * (z2[0] * n1 - z1[0] * n2) / det
    P = 0
    for n, away, R in ((n1, -1j * n2, R1), (n2, 1j * n1, R2)):
        lever = (1j * n * p.conjugate()).real
        size = np.array([1, -lever]) @ R @ np.array([1, -lever]) / det**2
        P = P + size * np.outer([away.real, away.imag], [away.real, away.imag])
    return [p.real, p.imag], P

# %% right: complex-step derivative of the corner
def corner(z1, R1, z2, R2):
    def meet(r1, a1, r2, a2):
        D = np.sin(a2 - a1)
        return np.array([r1 * np.sin(a2) - r2 * np.sin(a1), r2 * np.cos(a1) - r1 * np.cos(a2)]) / D

    z = np.concatenate([z1, z2]).astype(complex)
    J = np.column_stack([meet(*(z + 1e-30j * e)).imag / 1e-30 for e in np.eye(4)])
    return meet(*z).real, J[:, :2] @ R1 @ J[:, :2].T + J[:, 2:] @ R2 @ J[:, 2:].T

# %% right: variances of n.p of both lines, carried through the inverse of N
def corner(z1, R1, z2, R2):
    a = np.array([z1[1], z2[1]])
    N, N_dash = np.stack([np.cos(a), np.sin(a)], 1), np.stack([-np.sin(a), np.cos(a)], 1)
    inverse = np.linalg.inv(N)
    p = inverse @ np.array([z1[0], z2[0]])
    g = np.stack([np.ones(2), -(N_dash @ p)], 1)
    var = np.einsum("ki,kij,kj->k", g, np.stack([R1, R2]), g)
    return p, inverse @ np.diag(var) @ inverse.T

# %% wrong: finite differences of the corner
def corner(z1, R1, z2, R2):
    def at(q):
        N = np.array([[np.cos(q[1]), np.sin(q[1])], [np.cos(q[3]), np.sin(q[3])]])
        return np.linalg.solve(N, [q[0], q[2]])
    q = np.array([*z1, *z2], float)
    J = np.array([(at(q + d) - at(q - d)) / 2e-6 for d in 1e-6 * np.eye(4)]).T
    C = np.zeros((4, 4))
    C[:2, :2], C[2:, 2:] = R1, R2
    return at(q), J @ C @ J.T

# %% wrong: N transposed: normals as columns
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z1[1]), np.cos(z2[1])], [np.sin(z1[1]), np.sin(z2[1])]])
    Ni = np.linalg.inv(N)
    p = Ni @ [z1[0], z2[0]]
    P = np.zeros((2, 2))
    for k, (z, R) in enumerate([(z1, R1), (z2, R2)]):
        n_dash = np.array([-np.sin(z[1]), np.cos(z[1])])
        J = np.outer(Ni[:, k], [1, -n_dash @ p])
        P += J @ R @ J.T
    return p, P

# %% wrong: information form: fails for a line that is known exactly
def corner(z1, R1, z2, R2):
    p = np.linalg.solve(
        [[np.cos(z1[1]), np.sin(z1[1])], [np.cos(z2[1]), np.sin(z2[1])]], [z1[0], z2[0]]
    )
    info = np.zeros((2, 2))
    for (rho, alpha), R in ((z1, R1), (z2, R2)):
        n, n_dash = np.array([np.cos(alpha), np.sin(alpha)]), np.array([-np.sin(alpha), np.cos(alpha)])
        g = np.array([1, -n_dash @ p])
        info += np.outer(n, n) / (g @ R @ g)
    return p, np.linalg.inv(info)

# %% wrong: walls taken for perpendicular
def corner(z1, R1, z2, R2):
    n1 = np.array([np.cos(z1[1]), np.sin(z1[1])])
    n2 = np.array([np.cos(z2[1]), np.sin(z2[1])])
    p = z1[0] * n1 + z2[0] * n2
    P = np.zeros((2, 2))
    for n, R in ((n1, R1), (n2, R2)):
        g = np.array([1, -(np.array([-n[1], n[0]]) @ p)])
        P += (g @ R @ g) * np.outer(n, n)
    return p, P

# %% wrong: sum begun in R1: argument changed
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z[1]), np.sin(z[1])] for z in (z1, z2)])
    Ni = np.linalg.inv(N)
    p = Ni @ [z1[0], z2[0]]
    Js = [np.outer(Ni[:, k], [1, N[k, 1] * p[0] - N[k, 0] * p[1]]) for k in (0, 1)]
    P = R1
    P[:] = Js[0] @ R1 @ Js[0].T
    P += Js[1] @ R2 @ Js[1].T
    return p, P

# %% wrong: both errors treated as one: (J1 + J2)(R1 + R2)(J1 + J2)'
def corner(z1, R1, z2, R2):
    N = np.array([[np.cos(z[1]), np.sin(z[1])] for z in (z1, z2)])
    Ni = np.linalg.inv(N)
    p = Ni @ [z1[0], z2[0]]
    J = sum(np.outer(Ni[:, k], [1, N[k, 1] * p[0] - N[k, 0] * p[1]]) for k in (0, 1))
    return p, J @ (R1 + R2) @ J.T
