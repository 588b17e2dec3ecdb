"""Independent answers to 01-next-pose: right ones, and students' mistakes."""

RIGHT = [
    (
        "01-next-pose",
        "rotation matrix and modulo",
        """
def next_pose(pose, step):
    th = pose[2]
    R = np.array([[np.cos(th), -np.sin(th)], [np.sin(th), np.cos(th)]])
    p = pose[:2] + R @ step[:2]
    new = (th + step[2] + np.pi) % (2 * np.pi) - np.pi
    return np.array([p[0], p[1], new])
""",
    ),
    (
        "01-next-pose",
        "complex numbers",
        """
def next_pose(pose, step):
    turn = np.exp(1j * pose[2])
    z = complex(pose[0], pose[1]) + turn * complex(step[0], step[1])
    return np.array([z.real, z.imag, np.angle(turn * np.exp(1j * step[2]))])
""",
    ),
    (
        "01-next-pose",
        "polar form of the step, while loops",
        """
def next_pose(pose, step):
    length = np.hypot(step[0], step[1])
    direction = pose[2] + np.arctan2(step[1], step[0])
    heading = pose[2] + step[2]
    while heading > np.pi:
        heading -= 2 * np.pi
    while heading <= -np.pi:
        heading += 2 * np.pi
    return np.array([pose[0] + length * np.cos(direction), pose[1] + length * np.sin(direction), heading])
""",
    ),
]

WRONG = [
    (
        "01-next-pose",
        "moves along the new heading",
        """
def next_pose(pose, step):
    heading = pose[2] + step[2]
    heading = np.arctan2(np.sin(heading), np.cos(heading))
    c, s = np.cos(heading), np.sin(heading)
    return np.array([
        pose[0] + c * step[0] - s * step[1],
        pose[1] + s * step[0] + c * step[1],
        heading,
    ])
""",
    ),
    (
        "01-next-pose",
        "adds the step in the world's frame",
        """
def next_pose(pose, step):
    new = pose + step
    new[2] = (new[2] + np.pi) % (2 * np.pi) - np.pi
    return new
""",
    ),
    (
        "01-next-pose",
        "heading not wrapped",
        """
def next_pose(pose, step):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    R = np.array([[c, -s], [s, c]])
    return np.append(pose[:2] + R @ step[:2], pose[2] + step[2])
""",
    ),
    (
        "01-next-pose",
        "rotation transposed",
        """
def next_pose(pose, step):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    R = np.array([[c, s], [-s, c]])
    xy = pose[:2] + R @ step[:2]
    a = pose[2] + step[2]
    return np.array([*xy, np.arctan2(np.sin(a), np.cos(a))])
""",
    ),
    (
        "01-next-pose",
        "the sideways part is forgotten",
        """
def next_pose(pose, step):
    x, y, t = pose
    d, _, dt = step
    a = t + dt
    return np.array([x + d * np.cos(t), y + d * np.sin(t), np.arctan2(np.sin(a), np.cos(a))])
""",
    ),
    (
        "01-next-pose",
        "left taken as right",
        """
def next_pose(pose, step):
    x, y, th = pose
    f, l, t = step
    right_of = th - np.pi / 2
    x = x + f * np.cos(th) + l * np.cos(right_of)
    y = y + f * np.sin(th) + l * np.sin(right_of)
    return np.array([x, y, np.angle(np.exp(1j * (th + t)))])
""",
    ),
    (
        "01-next-pose",
        "wrapped to 0..2pi",
        """
def next_pose(pose, step):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    return np.array([
        pose[0] + c * step[0] - s * step[1],
        pose[1] + s * step[0] + c * step[1],
        (pose[2] + step[2]) % (2 * np.pi),
    ])
""",
    ),
    (
        "01-next-pose",
        "only wraps upward overflow",
        """
def next_pose(pose, step):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    theta = pose[2] + step[2]
    if theta > np.pi:
        theta -= 2 * np.pi
    return np.array([pose[0] + c * step[0] - s * step[1], pose[1] + s * step[0] + c * step[1], theta])
""",
    ),
    (
        "01-next-pose",
        "changes the pose in place",
        """
def next_pose(pose, step):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    pose[0] += c * step[0] - s * step[1]
    pose[1] += s * step[0] + c * step[1]
    pose[2] = np.arctan2(np.sin(pose[2] + step[2]), np.cos(pose[2] + step[2]))
    return pose
""",
    ),
    (
        "01-next-pose",
        "moves the whole length straight ahead",
        """
def next_pose(pose, step):
    length = np.sqrt(step[0] ** 2 + step[1] ** 2)
    x = pose[0] + length * np.cos(pose[2])
    y = pose[1] + length * np.sin(pose[2])
    h = pose[2] + step[2]
    return np.array([x, y, np.arctan2(np.sin(h), np.cos(h))])
""",
    ),
    (
        "01-next-pose",
        "half the turn (arc midpoint) for the direction",
        """
def next_pose(pose, step):
    mid = pose[2] + step[2] / 2
    c, s = np.cos(mid), np.sin(mid)
    h = pose[2] + step[2]
    return np.array([
        pose[0] + c * step[0] - s * step[1],
        pose[1] + s * step[0] + c * step[1],
        np.arctan2(np.sin(h), np.cos(h)),
    ])
""",
    ),
    (
        "01-next-pose",
        "arctan(step) loses backward steps",
        """
def next_pose(pose, step):
    length = np.hypot(step[0], step[1])
    way = pose[2] + (np.arctan(step[1] / step[0]) if step[0] != 0 else np.sign(step[1]) * np.pi / 2)
    h = pose[2] + step[2]
    return np.array([pose[0] + length * np.cos(way), pose[1] + length * np.sin(way),
                     np.arctan2(np.sin(h), np.cos(h))])
""",
    ),
    (
        "01-next-pose",
        "wraps with fmod, which keeps the sign",
        """
def next_pose(pose, step):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    h = np.fmod(pose[2] + step[2] + np.pi, 2 * np.pi) - np.pi
    return np.array([pose[0] + c * step[0] - s * step[1], pose[1] + s * step[0] + c * step[1], h])
""",
    ),
]
