# %% way: complex numbers
def next_pose(pose, step):
    z = complex(*pose[:2]) + complex(*step[:2]) * np.exp(1j * pose[2])
    return [z.real, z.imag, np.angle(np.exp(1j * (pose[2] + step[2])))]

# %% way: homogeneous matrices
def next_pose(pose, step):
    def T(p):
        c, s = np.cos(p[2]), np.sin(p[2])
        return np.array([[c, -s, p[0]], [s, c, p[1]], [0, 0, 1]])

    M = T(pose) @ T(step)
    return np.array([M[0, 2], M[1, 2], np.arctan2(M[1, 0], M[0, 0])])

# %% way: the math module, wrapped by ifs
def next_pose(pose, step):
    import math

    x, y, t = (float(value) for value in pose)
    side = t + math.pi / 2
    heading = t + step[2]
    if heading > math.pi:
        heading -= 2 * math.pi
    elif heading < -math.pi:
        heading += 2 * math.pi
    return (
        x + step[0] * math.cos(t) + step[1] * math.cos(side),
        y + step[0] * math.sin(t) + step[1] * math.sin(side),
        heading,
    )

# %% way: a copy that is changed
def next_pose(pose, step):
    new = pose.copy()
    c, s = np.cos(pose[2]), np.sin(pose[2])
    new[:2] += np.array([[c, -s], [s, c]]) @ step[:2]
    new[2] = (pose[2] + step[2] + np.pi) % (2 * np.pi) - np.pi
    return new

# %% way: distance and direction
def next_pose(pose, step):
    far, way = np.hypot(step[0], step[1]), np.arctan2(step[1], step[0]) + pose[2]
    heading = np.remainder(pose[2] + step[2] + np.pi, 2 * np.pi) - np.pi
    return np.array([pose[0] + far * np.cos(way), pose[1] + far * np.sin(way), heading])

# %% way: by the package
def next_pose(pose, step):
    from slamlab.geometry import compose
    return compose(pose, step)

# %% right: rounding the turns away with floor
def next_pose(pose, step):
    t = pose[2]
    M = np.array([[np.cos(t), -np.sin(t), 0], [np.sin(t), np.cos(t), 0], [0, 0, 1]])
    q = pose + M @ step
    q[2] -= 2 * np.pi * np.floor((q[2] + np.pi) / (2 * np.pi))
    return q

# %% right: rotation matrix and modulo
def next_pose(pose, step):
    th = pose[2]
    R = np.array([[np.cos(th), -np.sin(th)], [np.sin(th), np.cos(th)]])
    p = pose[:2] + R @ step[:2]
    new = (th + step[2] + np.pi) % (2 * np.pi) - np.pi
    return np.array([p[0], p[1], new])

# %% wrong: into an array of whole numbers
def next_pose(pose, step):
    new = np.zeros(3, dtype=int)
    c, s = np.cos(pose[2]), np.sin(pose[2])
    new[0] = pose[0] + c * step[0] - s * step[1]
    new[1] = pose[1] + s * step[0] + c * step[1]
    new[2] = pose[2] + step[2]
    return new

# %% wrong: prints and returns nothing
def next_pose(pose, step):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    x = pose[0] + c * step[0] - s * step[1]
    y = pose[1] + s * step[0] + c * step[1]
    print(x, y, pose[2] + step[2])

# %% wrong: changes the pose in place
def next_pose(pose, step):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    pose[0] += c * step[0] - s * step[1]
    pose[1] += s * step[0] + c * step[1]
    pose[2] = np.arctan2(np.sin(pose[2] + step[2]), np.cos(pose[2] + step[2]))
    return pose

# %% wrong: arctan(step) loses backward steps
def next_pose(pose, step):
    length = np.hypot(step[0], step[1])
    way = pose[2] + (np.arctan(step[1] / step[0]) if step[0] != 0 else np.sign(step[1]) * np.pi / 2)
    h = pose[2] + step[2]
    return np.array([pose[0] + length * np.cos(way), pose[1] + length * np.sin(way),
                     np.arctan2(np.sin(h), np.cos(h))])

# %% wrong: rounded to millimetres
def next_pose(pose, step):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    theta = pose[2] + step[2]
    theta = np.arctan2(np.sin(theta), np.cos(theta))
    return np.round([pose[0] + c * step[0] - s * step[1], pose[1] + s * step[0] + c * step[1],
                     theta], 3)
