# %% way: complex numbers
def to_points(degrees, millimetres, mount, pose):
    z = millimetres * 1e-3 * np.exp(-1j * np.deg2rad(degrees))
    z = z[millimetres != 0]
    for frame in (mount, pose):
        z = z * np.exp(1j * frame[2]) + complex(frame[0], frame[1])
    return np.column_stack([z.real, z.imag])

# %% way: the package's poses
from slamlab.geometry import compose, transform

def to_points(degrees, millimetres, mount, pose):
    r, b = millimetres / 1000, np.radians(360 - degrees)
    xy = np.column_stack([r * np.cos(b), r * np.sin(b)])[r > 0]
    return transform(compose(pose, mount), xy)

# %% way: lists and matrices
def to_points(degrees, millimetres, mount, pose):
    def T(f):
        return np.array([[np.cos(f[2]), -np.sin(f[2]), f[0]], [np.sin(f[2]), np.cos(f[2]), f[1]],
                         [0, 0, 1]])
    out = []
    for a, mm in zip(degrees, millimetres):
        if mm == 0:
            continue
        q = [mm / 1000 * np.cos(np.radians(a)), -mm / 1000 * np.sin(np.radians(a)), 1]
        x, y, _ = T(pose) @ T(mount) @ q
        out.append([x, y])
    return out

# %% way: angles added up
def to_points(degrees, millimetres, mount, pose):
    heading = pose[2] + mount[2]
    x = pose[0] + np.cos(pose[2]) * mount[0] - np.sin(pose[2]) * mount[1]
    y = pose[1] + np.sin(pose[2]) * mount[0] + np.cos(pose[2]) * mount[1]
    points = np.empty((len(degrees), 2))
    points[:, 0] = x + millimetres / 1000 * np.cos(heading - np.pi / 180 * degrees)
    points[:, 1] = y + millimetres / 1000 * np.sin(heading - np.pi / 180 * degrees)
    return np.delete(points, np.flatnonzero(millimetres <= 0), axis=0)

# %% way: columns
def to_points(degrees, millimetres, mount, pose):
    turn = lambda a: np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])
    seen = np.nonzero(millimetres)
    r, a = millimetres[seen].copy(), np.copy(degrees)[seen]
    r /= 1e3
    a *= np.pi / 180
    q = np.vstack((r * np.cos(a), -r * np.sin(a)))
    q = turn(mount[2]) @ q + mount[:2, None]
    return (turn(pose[2]) @ q + pose[:2].reshape(2, 1)).T

# %% right: complex numbers, reading by reading
def to_points(degrees, millimetres, mount, pose):
    found = []
    for deg, mm in zip(degrees, millimetres):
        if mm > 0:
            z = mm / 1000 * np.exp(-1j * np.radians(deg))
            z = (mount[0] + 1j * mount[1]) + z * np.exp(1j * mount[2])
            z = (pose[0] + 1j * pose[1]) + z * np.exp(1j * pose[2])
            found.append([z.real, z.imag])
    return np.array(found).reshape(-1, 2)

# %% right: compose the poses by hand, then one rotation
def to_points(degrees, millimetres, mount, pose):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    x = pose[0] + c * mount[0] - s * mount[1]
    y = pose[1] + s * mount[0] + c * mount[1]
    theta = pose[2] + mount[2]
    hit = millimetres != 0
    angle = theta - np.deg2rad(degrees[hit])
    r = millimetres[hit] * 1e-3
    return np.stack([x + r * np.cos(angle), y + r * np.sin(angle)], axis=1)

# %% right: a loop, reshape for no rows
def to_points(degrees, millimetres, mount, pose):
    def matrix(q):
        return np.array([[np.cos(q[2]), -np.sin(q[2]), q[0]], [np.sin(q[2]), np.cos(q[2]), q[1]], [0, 0, 1]])

    T = matrix(pose) @ matrix(mount)
    points = []
    for d, mm in zip(degrees, millimetres):
        if mm > 0:
            a, r = np.radians(-d), mm / 1000
            points.append((T @ [r * np.cos(a), r * np.sin(a), 1])[:2])
    return np.array(points).reshape(-1, 2)

# %% right: rows appended to a list, of which none is np.array([])
def to_points(degrees, millimetres, mount, pose):
    c, s = np.cos(pose[2]), np.sin(pose[2])
    x0, y0 = pose[0] + c * mount[0] - s * mount[1], pose[1] + s * mount[0] + c * mount[1]
    rows = []
    for d, mm in zip(degrees, millimetres):
        if mm > 0:
            a = pose[2] + mount[2] - np.radians(d)
            rows.append([x0 + mm / 1000 * np.cos(a), y0 + mm / 1000 * np.sin(a)])
    return np.array(rows)

# %% wrong: NaN rows for what did not come back
def to_points(degrees, millimetres, mount, pose):
    r = np.where(millimetres > 0, millimetres / 1000, np.nan)
    a = -np.radians(degrees)
    q = np.column_stack([r * np.cos(a), r * np.sin(a)])
    for f in (mount, pose):
        c, s = np.cos(f[2]), np.sin(f[2])
        q = q @ np.array([[c, s], [-s, c]]) + f[:2]
    return q

# %% wrong: sorted by angle
def to_points(degrees, millimetres, mount, pose):
    order = np.argsort(degrees)
    degrees, millimetres = degrees[order], millimetres[order]
    back = millimetres > 0
    a, r = -np.radians(degrees[back]), millimetres[back] / 1000
    q = np.column_stack([r * np.cos(a), r * np.sin(a)])
    for f in (mount, pose):
        c, s = np.cos(f[2]), np.sin(f[2])
        q = q @ np.array([[c, s], [-s, c]]) + f[:2]
    return q

# %% wrong: shape (2, k)
def to_points(degrees, millimetres, mount, pose):
    back = millimetres > 0
    a, r = -np.radians(degrees[back]), millimetres[back] / 1000
    q = np.array([r * np.cos(a), r * np.sin(a)])
    for f in (mount, pose):
        c, s = np.cos(f[2]), np.sin(f[2])
        q = np.array([[c, -s], [s, c]]) @ q + f[:2, None]
    return q
