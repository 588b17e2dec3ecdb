"""A fifth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = []

WRONG = [
    (
        "09-end",
        "range of the end from the origin",
        """
def end_point(x, P, j, beta, sigma):
    def f(s):
        rho, a, t = s[3 + 2 * j], s[4 + 2 * j], s[2] + s[-1]
        u = np.array([np.cos(t), np.sin(t)])
        return s[:2] + rho / np.cos(t - a) * u
    s = np.append(x, beta)
    J = np.array([(f(s + e) - f(s - e)) / 2e-6 for e in 1e-6 * np.eye(len(s))]).T
    C = np.zeros((len(s), len(s)))
    C[:-1, :-1], C[-1, -1] = P, sigma ** 2
    return f(s), J @ C @ J.T, J[:, :-1] @ P
""",
    ),
    (
        "09-place",
        "R in place of J_z R J_zᵀ",
        """
def place(x, P, z, R):
    a = x[2] + z[1]
    c, s = np.cos(a), np.sin(a)
    J = np.array([[c, s, x[1] * c - x[0] * s], [0, 0, 1]])
    return np.array([z[0] + x[0] * c + x[1] * s, a]), J @ P @ J.T + R, J @ P
""",
    ),
]
