# %% way: gains
def alternate(x, P, us, ids, zs, C, R):
    marks, history = {}, []
    for k in range(len(ids)):
        x, P = predict(x, P, us[k], C)
        i = int(ids[k])
        if i >= 0 and i not in marks:
            J = np.hstack([J_xr(x, zs[k]), J_z(x, zs[k])])
            big = np.zeros((5, 5))
            big[:3, :3], big[3:, 3:] = P, R
            marks[i] = g(x, zs[k]), J @ big @ J.T
        elif i >= 0:
            p, L = marks[i]
            A, B = H_robot(x, p), H_landmark(x, p)
            S = A @ P @ A.T + B @ L @ B.T + R
            v = zs[k] - h(x, p)
            v[1] = (v[1] + np.pi) % (2 * np.pi) - np.pi
            K, G = P @ A.T @ np.linalg.inv(S), L @ B.T @ np.linalg.inv(S)
            marks[i] = p + G @ v, L - G @ S @ G.T
            x, P = x + K @ v, P - K @ S @ K.T
        history.append((x, P))
    xs, Ps = zip(*history)
    return np.array(xs), np.array(Ps), marks

# %% way: the noise of a new landmark as that of an old one
def alternate(x, P, us, ids, zs, C, R):
    beliefs, xs, Ps = {}, [], []
    for u, id, z in zip(us, ids, zs):
        x, P = predict(x, P, u, C)
        if id >= 0:
            p, L = beliefs.get(id, (g(x, z), None))
            Hr, Hp = H_robot(x, p), H_landmark(x, p)
            seen = R + Hr @ P @ Hr.T
            if L is None:
                beliefs[id] = p, J_z(x, z) @ seen @ J_z(x, z).T
            else:
                beliefs[id] = update_landmark(p, L, x, z, seen)
                x, P = locate(x, P, z, p, R + Hp @ L @ Hp.T)
        xs.append(x.tolist())
        Ps.append(P.tolist())
    return xs, Ps, beliefs

# %% right: a class for the map
class Mark:
    def __init__(self, x, P, z, R):
        A, B = J_xr(x, z), J_z(x, z)
        self.p, self.L = g(x, z), A @ P @ A.T + B @ R @ B.T
    def extra(self, x):
        H = H_landmark(x, self.p)
        return H @ self.L @ H.T
    def again(self, x, P, z, R):
        H = H_robot(x, self.p)
        self.p, self.L = update_landmark(self.p, self.L, x, z, R + H @ P @ H.T)

def alternate(x, P, us, ids, zs, C, R):
    book, xs, Ps = {}, [], []
    for u, i, z in zip(us, ids, zs):
        x, P = predict(x, P, u, C)
        x_prior, P_prior = x, P
        if i in book:
            x, P = locate(x, P, z, book[i].p, R + book[i].extra(x))
            book[i].again(x_prior, P_prior, z, R)
        elif i != -1:
            book[i] = Mark(x, P, z, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps), {i: (m.p, m.L) for i, m in book.items()}

# %% right: information of the landmark
def alternate(x, P, us, ids, zs, C, R):
    xs, Ps, book = np.zeros((len(ids), 3)), np.zeros((len(ids), 3, 3)), dict()
    for k, (u, i, z) in enumerate(zip(us, ids, zs)):
        x, P = predict(x, P, u, C)
        if i >= 0:
            if i in book:
                p, L = book[i]
                B, A = H_landmark(x, p), H_robot(x, p)
                v = z - h(x, p)
                v = np.array([v[0], np.angle(np.exp(1j * v[1]))])
                M = np.linalg.inv(R + A @ P @ A.T)
                new = np.linalg.inv(np.linalg.inv(L) + B.T @ M @ B)
                book[i] = (p + new @ B.T @ M @ v, new)
                x, P = locate(x, P, z, p, R + B @ L @ B.T)
            else:
                J = J_xr(x, z)
                book[i] = (g(x, z), J @ P @ J.T + J_z(x, z) @ R @ J_z(x, z).T)
        xs[k], Ps[k] = x, P
    return xs, Ps, book
