"""Independent answers to 05-ranges: right ones, and students' mistakes."""

RIGHT = [
    (
        "05-ranges",
        "information form, loop over beacons",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    ax = x[0] + c * a[0] - s * a[1]
    ay = x[1] + s * a[0] + c * a[1]
    info, vector = np.linalg.inv(P), np.zeros(3)
    for r, b in zip(rs, beacons):
        dx, dy = ax - b[0], ay - b[1]
        e = np.hypot(dx, dy)
        row = np.array([dx, dy, dx * (-s * a[0] - c * a[1]) + dy * (c * a[0] - s * a[1])]) / e
        info = info + np.outer(row, row) / sigma ** 2
        vector = vector + row * (r - e) / sigma ** 2
    P_new = np.linalg.inv(info)
    return x + P_new @ vector, P_new
""",
    ),
    (
        "05-ranges",
        "one range after the other, H and expectation at the given pose",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    t = x[2]
    R = np.array([[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]])
    dR = np.array([[-np.sin(t), -np.cos(t)], [np.cos(t), -np.sin(t)]])
    antenna = x[:2] + R @ a
    m, S_x = x.copy(), P.copy()
    for r, b in zip(rs, beacons):
        d = antenna - b
        dist = np.sqrt(d @ d)
        H = np.append(d, d @ (dR @ a)) / dist
        expected = dist + H @ (m - x)
        k = S_x @ H / (H @ S_x @ H + sigma ** 2)
        m = m + k * (r - expected)
        S_x = S_x - np.outer(k, H @ S_x)
    return m, S_x
""",
    ),
]

WRONG = [
    (
        "05-ranges",
        "the antenna sits on the axle",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    d = x[:2] - beacons
    r = np.hypot(d[:, 0], d[:, 1])
    H = np.column_stack([d[:, 0] / r, d[:, 1] / r, np.zeros(len(r))])
    S = H @ P @ H.T + sigma ** 2 * np.eye(len(r))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "the antenna is expected rightly, but the heading column is zero",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    at = x[:2] + np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    d = at - beacons
    r = np.linalg.norm(d, axis=1)
    H = np.zeros((len(rs), 3))
    H[:, :2] = d / r[:, None]
    S = H @ P @ H.T + sigma ** 2 * np.eye(len(rs))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "the arm is not turned with the robot",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    d = x[:2] + a - beacons
    r = np.linalg.norm(d, axis=1)
    swing = np.array([-a[1], a[0]])
    H = np.column_stack([d, d @ swing]) / r[:, None]
    S = H @ P @ H.T + sigma ** 2 * np.eye(len(rs))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "the arm is turned the wrong way",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = a @ np.array([[c, -s], [s, c]])
    d = x[:2] + arm - beacons
    r = np.linalg.norm(d, axis=1)
    H = np.column_stack([d, d @ [-arm[1], arm[0]]]) / r[:, None]
    S = H @ P @ H.T + sigma ** 2 * np.eye(len(rs))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "sigma instead of sigma squared",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    d = x[:2] + arm - beacons
    r = np.linalg.norm(d, axis=1)
    H = np.column_stack([d, d @ [-arm[1], arm[0]]]) / r[:, None]
    S = H @ P @ H.T + sigma * np.eye(len(rs))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "one after the other, H anew at each new pose",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    for z, b in zip(rs, beacons):
        c, s = np.cos(x[2]), np.sin(x[2])
        arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
        d = x[:2] + arm - b
        r = np.hypot(*d)
        H = np.array([[d[0], d[1], d @ [-arm[1], arm[0]]]]) / r
        S = H @ P @ H.T + sigma ** 2
        K = P @ H.T / S
        x = x + K[:, 0] * (z - r)
        P = P - K @ S @ K.T
    return x, P
""",
    ),
    (
        "05-ranges",
        "sign of the swing",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    d = x[:2] + arm - beacons
    r = np.linalg.norm(d, axis=1)
    H = np.column_stack([d, d @ [arm[1], -arm[0]]]) / r[:, None]
    S = H @ P @ H.T + sigma ** 2 * np.eye(len(rs))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "the heading column from the unturned arm",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    d = x[:2] + np.array([[c, -s], [s, c]]) @ a - beacons
    r = np.linalg.norm(d, axis=1)
    H = np.empty((len(rs), 3))
    for i in range(len(rs)):
        H[i] = d[i, 0] / r[i], d[i, 1] / r[i], (-a[1] * d[i, 0] + a[0] * d[i, 1]) / r[i]
    S = H @ P @ H.T + sigma ** 2 * np.eye(len(rs))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "the sign of d: from antenna to beacon, without the minus",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    d = beacons - x[:2] - arm
    r = np.linalg.norm(d, axis=1)
    H = np.column_stack([d, d @ [-arm[1], arm[0]]]) / r[:, None]
    S = H @ P @ H.T + sigma ** 2 * np.eye(len(rs))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "for exactly three beacons",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    H, e = np.zeros((3, 3)), np.zeros(3)
    for i in range(min(3, len(rs))):
        d = x[:2] + arm - beacons[i]
        r = np.hypot(*d)
        H[i] = d[0] / r, d[1] / r, d @ [-arm[1], arm[0]] / r
        e[i] = rs[i] - r
    S = H @ P @ H.T + sigma ** 2 * np.eye(3)
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ e, P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "a beacon that is heard twice counts once",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    _, first = np.unique(beacons, axis=0, return_index=True)
    rs, beacons = rs[first], beacons[first]
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    d = x[:2] + arm - beacons
    r = np.linalg.norm(d, axis=1)
    H = np.column_stack([d, d @ [-arm[1], arm[0]]]) / r[:, None]
    S = H @ P @ H.T + sigma ** 2 * np.eye(len(rs))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "distances below half a metre are set to half a metre, against division by zero",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    d = x[:2] + arm - beacons
    r = np.maximum(np.linalg.norm(d, axis=1), 0.5)
    H = np.column_stack([d, d @ [-arm[1], arm[0]]]) / r[:, None]
    S = H @ P @ H.T + sigma ** 2 * np.eye(len(rs))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "H by the pose's distance, expectation by the antenna's",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    expected = np.linalg.norm(x[:2] + arm - beacons, axis=1)
    d = x[:2] - beacons
    r = np.linalg.norm(d, axis=1)
    H = np.column_stack([d, d @ [-arm[1], arm[0]]]) / r[:, None]
    S = H @ P @ H.T + sigma ** 2 * np.eye(len(rs))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - expected), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "S without the matrix: sigma^2 added everywhere",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    d = x[:2] + arm - beacons
    r = np.linalg.norm(d, axis=1)
    H = np.column_stack([d, d @ [-arm[1], arm[0]]]) / r[:, None]
    S = H @ P @ H.T + sigma ** 2
    K = P @ H.T @ np.linalg.pinv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
""",
    ),
    (
        "05-ranges",
        "fails when nothing is heard",
        """
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
    rows, v = [], []
    for r, b in zip(rs, beacons):
        d = x[:2] + arm - b
        e = np.hypot(*d)
        rows.append([d[0] / e, d[1] / e, (arm[0] * d[1] - arm[1] * d[0]) / e])
        v.append(r - e)
    H = np.vstack(rows)
    S = H @ P @ H.T + sigma ** 2 * np.eye(len(v))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ np.array(v), P - K @ S @ K.T
""",
    ),
]
