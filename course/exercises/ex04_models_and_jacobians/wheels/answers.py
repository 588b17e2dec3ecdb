# %% way: radius of the circle
def predict_wheels(x, P, s, B, k):
    (l, r), t = s, x[2]
    d, a = (l + r) / 2, (r - l) / B
    c0, s0, c1, s1 = np.cos(t), np.sin(t), np.cos(t + a), np.sin(t + a)
    if r == l:
        dx, dy = d * c0, d * s0
        by_d, by_a = [c0, s0, 0], [-d * s0 / 2, d * c0 / 2, 1]
    else:
        dx, dy = d / a * (s1 - s0), d / a * (c0 - c1)
        by_d = [(s1 - s0) / a, (c0 - c1) / a, 0]
        by_a = [d * c1 / a - dx / a, d * s1 / a - dy / a, 1]
    A = np.array([[1, 0, -dy], [0, 1, dx], [0, 0, 1]])
    by_d, by_a = np.array(by_d), np.array(by_a)
    W = np.column_stack([by_d / 2 - by_a / B, by_d / 2 + by_a / B])
    C = np.diag([k * k * abs(l), k * k * abs(r)])
    return x + np.array([dx, dy, a]), A @ P @ A.T + W @ C @ W.T, A, W

# %% way: complex step
def predict_wheels(x, P, s, B, k):
    def end(v):
        d, a = (v[3] + v[4]) / 2, (v[4] - v[3]) / B
        half = a / 2
        ratio = 1 - half**2 / 6 if abs(half) < 1e-9 else np.sin(half) / half
        return np.array([d * ratio * np.cos(v[2] + half), d * ratio * np.sin(v[2] + half), v[2] + a])
    v = np.array([*x, *s])
    J = np.column_stack([end(v + 1e-30j * one).imag / 1e-30 for one in np.eye(5)])
    J[0, 0] = J[1, 1] = 1
    joint = np.zeros((5, 5))
    joint[:3, :3], joint[3:, 3:] = P, k**2 * np.diag(np.abs(s))
    return end(v).real + [x[0], x[1], 0], J @ joint @ J.T, J[:, :3], J[:, 3:]

# %% right: a transform about the centre of rotation, as lists
def predict_wheels(x, P, s, B, k):
    left, right = float(s[0]), float(s[1])
    turn = (right - left) / B
    z0 = complex(np.cos(x[2]), np.sin(x[2]))
    z1 = z0 * complex(np.cos(turn), np.sin(turn))
    mid = (left + right) / 2
    if left == right:
        step, by_mid, by_turn = mid * z0, z0, 0.5j * mid * z0
    else:
        step = -1j * mid / turn * (z1 - z0)
        by_mid = step / mid if mid else -1j * (z1 - z0) / turn
        by_turn = mid * z1 / turn - step / turn
    wl, wr = by_mid / 2 - by_turn / B, by_mid / 2 + by_turn / B
    A = np.array([[1, 0, -step.imag], [0, 1, step.real], [0, 0, 1]])
    W = np.array([[wl.real, wr.real], [wl.imag, wr.imag], [-1 / B, 1 / B]])
    C = [[k**2 * abs(left), 0], [0, k**2 * abs(right)]]
    return [x[0] + step.real, x[1] + step.imag, x[2] + turn], A @ P @ A.T + W @ C @ W.T, A, W

# %% wrong: Jacobians of the lesson's model with the mean of the arc
def predict_wheels(x, P, s, B, k):
    d, a = (s[0] + s[1]) / 2, (s[1] - s[0]) / B
    A = np.array([[1, 0, -d * np.sin(x[2])], [0, 1, d * np.cos(x[2])], [0, 0, 1]])
    W = np.array([[np.cos(x[2]), 0], [np.sin(x[2]), 0], [0, 1]]) @ np.array([[0.5, 0.5], [-1 / B, 1 / B]])
    chord = d * np.sinc(a / 2 / np.pi)
    C = k**2 * np.diag(abs(s))
    end = x + [chord * np.cos(x[2] + a / 2), chord * np.sin(x[2] + a / 2), a]
    return end, A @ P @ A.T + W @ C @ W.T, A, W

# %% wrong: central differences
def predict_wheels(x, P, s, B, k):
    def end(x, s):
        d, a = (s[0] + s[1]) / 2, (s[1] - s[0]) / B
        chord = d * np.sinc(a / 2 / np.pi)
        return x + np.array([chord * np.cos(x[2] + a / 2), chord * np.sin(x[2] + a / 2), a])
    h = 1e-4
    A = np.column_stack([(end(x + h * e, s) - end(x - h * e, s)) / (2 * h) for e in np.eye(3)])
    W = np.column_stack([(end(x, s + h * e) - end(x, s - h * e)) / (2 * h) for e in np.eye(2)])
    C = k**2 * np.diag(np.abs(s))
    return end(x, s), A @ P @ A.T + W @ C @ W.T, A, W
