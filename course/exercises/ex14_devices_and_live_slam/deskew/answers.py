# %% way: beam by beam, with matrices
def deskew(bearings, ranges, begin, period, times, poses):
    def matrix(pose):
        c, s = np.cos(pose[2]), np.sin(pose[2])
        return np.array([[c, -s, pose[0]], [s, c, pose[1]], [0, 0, 1]])

    def pose_at(t):
        k = min(max(np.searchsorted(times, t) - 1, 0), len(times) - 2)
        share = (t - times[k]) / (times[k + 1] - times[k])
        step = poses[k + 1] - poses[k]
        step[2] = np.arctan2(np.sin(step[2]), np.cos(step[2]))
        return poses[k] + share * step

    all_t = [begin + (bearings[0] - b) % (2 * np.pi) / (2 * np.pi) * period for b in bearings]
    last, found = np.linalg.inv(matrix(pose_at(all_t[-1]))), []
    for t, b, r in zip(all_t, bearings, ranges):
        if np.isfinite(r):
            found.append((last @ matrix(pose_at(t)) @ [r * np.cos(b), r * np.sin(b), 1])[:2])
    return found

# %% way: complex numbers
def deskew(bearings, ranges, begin, period, times, poses):
    turned = np.mod(bearings[0] - bearings, 2 * np.pi)
    t = begin + period / (2 * np.pi) * turned
    z = np.interp(t, times, poses[:, 0]) + 1j * np.interp(t, times, poses[:, 1])
    theta = np.interp(t, times, np.unwrap(poses[:, 2]))
    seen = (z - z[-1] + ranges * np.exp(1j * (theta + bearings))) * np.exp(-1j * theta[-1])
    seen = seen[np.isfinite(ranges)]
    return np.stack([seen.real, seen.imag], axis=1)

# %% pasted: the lesson's points of a scan from one pose
def deskew(bearings, ranges, begin, period, times, poses):
    back = np.isfinite(ranges)
    return np.column_stack([ranges * np.cos(bearings), ranges * np.sin(bearings)])[back]

# %% right: turn to the last beam, then the remaining way, with bearings unwrapped
def deskew(bearings, ranges, begin, period, times, poses):
    b = np.unwrap(bearings)
    t = begin + (b[0] - b) * period / 2 / np.pi
    head = [poses[0, 2]]
    for k in range(1, len(poses)):
        head.append(head[-1] + (poses[k, 2] - poses[k - 1, 2] + np.pi) % (2 * np.pi) - np.pi)
    th = np.interp(t, times, head)
    xs, ys = np.interp(t, times, poses[:, 0]), np.interp(t, times, poses[:, 1])
    bearing_now = b + th - th[-1]
    gx, gy = xs - xs[-1], ys - ys[-1]
    fx = gx * np.cos(th[-1]) + gy * np.sin(th[-1]) + ranges * np.cos(bearing_now)
    fy = -gx * np.sin(th[-1]) + gy * np.cos(th[-1]) + ranges * np.sin(bearing_now)
    keep = ranges == ranges
    return np.array([fx[keep], fy[keep]]).T

# %% right: scipy's interpolation of poses
from scipy.interpolate import interp1d

def deskew(bearings, ranges, begin, period, times, poses):
    full = poses.copy()
    full[:, 2] = np.unwrap(full[:, 2])
    at = interp1d(times, full, axis=0)
    t = begin + period * (((bearings[0] - bearings) / (2 * np.pi)) % 1.0)
    end = at(t[-1])
    R = np.array([[np.cos(end[2]), np.sin(end[2])], [-np.sin(end[2]), np.cos(end[2])]])
    out = []
    for b, r, p in zip(bearings, ranges, at(t)):
        if np.isnan(r):
            continue
        out.append(R @ (p[:2] + r * np.array([np.cos(p[2] + b), np.sin(p[2] + b)]) - end[:2]))
    return np.array(out)

# %% wrong: constant velocity between the poses at the first and the last beam
def deskew(bearings, ranges, begin, period, times, poses):
    turned = (bearings[0] - bearings) % (2 * np.pi)
    t = begin + period * turned / (2 * np.pi)
    head = np.unwrap(poses[:, 2])
    a, b = (np.array([np.interp(s, times, c) for c in (*poses[:, :2].T, head)]) for s in t[[0, -1]])
    share = turned / max(turned[-1], 1e-9)
    x, y, th = (a + share[:, None] * (b - a)).T
    dx = x + ranges * np.cos(th + bearings) - b[0]
    dy = y + ranges * np.sin(th + bearings) - b[1]
    c, s = np.cos(b[2]), np.sin(b[2])
    return np.column_stack([c * dx + s * dy, c * dy - s * dx])[~np.isnan(ranges)]

# %% wrong: headings by interpolated sine and cosine
def deskew(bearings, ranges, begin, period, times, poses):
    t = begin + period * ((bearings[0] - bearings) % (2 * np.pi)) / (2 * np.pi)
    x, y = (np.interp(t, times, c) for c in poses[:, :2].T)
    th = np.arctan2(np.interp(t, times, np.sin(poses[:, 2])), np.interp(t, times, np.cos(poses[:, 2])))
    dx = x + ranges * np.cos(th + bearings) - x[-1]
    dy = y + ranges * np.sin(th + bearings) - y[-1]
    c, s = np.cos(th[-1]), np.sin(th[-1])
    return np.column_stack([c * dx + s * dy, c * dy - s * dx])[~np.isnan(ranges)]

# %% wrong: the motion is undone with the wrong sign
def deskew(bearings, ranges, begin, period, times, poses):
    t = begin + period * ((bearings[0] - bearings) % (2 * np.pi)) / (2 * np.pi)
    x, y, th = (np.interp(t, times, c) for c in (*poses[:, :2].T, np.unwrap(poses[:, 2])))
    gx, gy = x[-1] - x, y[-1] - y
    c, s = np.cos(th[-1]), np.sin(th[-1])
    b = bearings + th[-1] - th
    px, py = c * gx + s * gy + ranges * np.cos(b), c * gy - s * gx + ranges * np.sin(b)
    return np.column_stack([px, py])[~np.isnan(ranges)]
