"""Independent answers to 01-home: right ones, and students' mistakes."""

RIGHT = [
    (
        "01-home",
        "factor by mean ratio, heading and gap shared by lap, helper functions",
        """
def home(start, steps, docked):
    bounds = [0] + list(docked)
    ratios = []
    for i, j in zip(bounds[:-1], bounds[1:]):
        ratios.append(abs(steps[i:j, 2].sum()) / (2 * np.pi))
    factor = np.mean(ratios)
    fixed = np.array(steps, dtype=float)
    fixed[:, 2] = fixed[:, 2] / factor
    out = np.zeros((len(steps) + 1, 3))
    out[0] = start
    for i, j in zip(bounds[:-1], bounds[1:]):
        lap = fixed[i:j].copy()
        want = 2 * np.pi * np.sign(lap[:, 2].sum())
        lap[:, 2] += (want - lap[:, 2].sum()) / (j - i)
        poses = track(out[i] * 0 + start, lap)
        share = (np.arange(j - i + 1) / (j - i)).reshape(-1, 1)
        poses[:, :2] -= share * (poses[-1, :2] - start[:2])
        poses[-1] = start
        out[i + 1:j + 1] = poses[1:]
    rest = track(start, fixed[bounds[-1]:])
    out[bounds[-1] + 1:] = rest[1:]
    return out
""",
    ),
    (
        "01-home",
        "least squares of the lap: small errors of each step, constraints of the end",
        """
def home(start, steps, docked):
    begins = [0, *docked[:-1]]
    told = np.array([np.sum(steps[i:j, 2]) for i, j in zip(begins, docked)])
    k = np.sum(np.abs(told)) / (2 * np.pi * len(told))
    fixed = steps.copy()
    fixed[:, 2] /= k
    poses = [np.asarray(start, dtype=float)[None]]
    for i, j in zip(begins, docked):
        lap = fixed[i:j].copy()
        n = j - i
        want = 2 * np.pi * np.sign(lap[:, 2].sum())
        for _ in range(4):
            p = np.zeros((n + 1, 3))
            p[0] = start
            heading = start[2] + np.append(0, np.cumsum(lap[:, 2]))
            ways = lap[:, 0] * np.exp(1j * heading[:-1])
            z = np.append(0, np.cumsum(ways))
            arm = 1j * (z[-1] - z[1:])
            # residuals: place and total turn; unknowns: n lengths (0.0075 m), n turns (0.01 rad)
            J = np.zeros((3, 2 * n))
            unit = np.exp(1j * heading[:-1])
            J[0, :n], J[1, :n] = unit.real, unit.imag
            J[0, n:], J[1, n:] = arm.real, arm.imag
            J[2, n:] = 1
            W = np.append((0.015 * np.maximum(abs(lap[:, 0]), 1e-3)) ** 2, np.full(n, 0.01 ** 2))
            e = np.array([-z[-1].real, -z[-1].imag, want - lap[:, 2].sum()])
            d = W * (J.T @ np.linalg.solve(J * W @ J.T, e))
            lap[:, 0] += d[:n]
            lap[:, 2] += d[n:]
        poses.append(track(np.asarray(start, dtype=float), lap)[1:])
    poses.append(track(np.asarray(start, dtype=float), fixed[docked[-1]:])[1:])
    return np.vstack(poses)
""",
    ),
]

WRONG = [
    (
        "01-home",
        "plain dead reckoning",
        """
def home(start, steps, docked):
    return track(start, steps)
""",
    ),
    (
        "01-home",
        "begins anew at the dock, nothing more",
        """
def home(start, steps, docked):
    poses = [np.array(start)]
    for k, step in enumerate(steps):
        p = next_pose(poses[-1], step)
        if k + 1 in docked:
            p = np.array(start)
        poses.append(p)
    return np.array(poses)
""",
    ),
    (
        "01-home",
        "shares the gap in place, but not the factor",
        """
def home(start, steps, docked):
    poses = [start[None]]
    i = 0
    for j in docked:
        lap = track(start, steps[i:j])
        gap = start[:2] - lap[-1, :2]
        lap[:, :2] += np.linspace(0, 1, len(lap))[:, None] * gap
        poses.append(lap[1:])
        i = j
    poses.append(track(start, steps[i:])[1:])
    return np.vstack(poses)
""",
    ),
    (
        "01-home",
        "corrects each lap's heading, but the way beyond keeps the worn tyre",
        """
def home(start, steps, docked):
    steps = steps.copy()
    out = [start[None]]
    i = 0
    for j in docked:
        total = steps[i:j, 2].sum()
        steps[i:j, 2] *= 2 * np.pi * np.sign(total) / total
        lap = track(start, steps[i:j])
        lap[:, :2] += np.outer(np.arange(len(lap)) / (len(lap) - 1), start[:2] - lap[-1, :2])
        out.append(lap[1:])
        i = j
    out.append(track(start, steps[i:])[1:])
    return np.concatenate(out)
""",
    ),
    (
        "01-home",
        "assumes all laps go to the left",
        """
def home(start, steps, docked):
    steps = steps.copy()
    laps = list(zip([0, *docked[:-1]], docked))
    factor = np.mean([steps[i:j, 2].sum() / (2 * np.pi) for i, j in laps])
    steps[:, 2] /= factor
    poses = [np.array([start])]
    for i, j in laps:
        lap = steps[i:j].copy()
        lap[:, 2] += (2 * np.pi - lap[:, 2].sum()) / len(lap)
        p = track(start, lap)
        p[:, :2] += np.linspace(0, 1, len(p))[:, None] * (start[:2] - p[-1, :2])
        poses.append(p[1:])
    poses.append(track(start, steps[docked[-1]:])[1:])
    return np.concatenate(poses)
""",
    ),
    (
        "01-home",
        "turns multiplied by the factor instead of divided",
        """
def home(start, steps, docked):
    s = steps.copy()
    edges = [0, *docked]
    factor = np.mean([abs(s[a:b, 2].sum()) for a, b in pairwise(edges)]) / (2 * np.pi)
    s[:, 2] *= factor
    out = [start]
    for a, b in pairwise(edges):
        p = track(start, s[a:b])
        p[:, :2] += np.linspace(0, 1, b - a + 1)[:, None] * (start[:2] - p[-1, :2])
        out.extend(p[1:])
    out.extend(track(start, s[edges[-1]:])[1:])
    return np.array(out)
""",
    ),
    (
        "01-home",
        "the factor alone, then dead reckoning all the way",
        """
def home(start, steps, docked):
    edges = [0, *docked]
    told = [abs(steps[a:b, 2].sum()) for a, b in pairwise(edges)]
    return track(start, steps / [1, 1, np.mean(told) / (2 * np.pi)])
""",
    ),
    (
        "01-home",
        "corrects only half of the factor, to be careful; the gap on the last step",
        """
def home(start, steps, docked):
    steps = steps.copy()
    edges = [0, *docked]
    told = [abs(steps[a:b, 2].sum()) for a, b in pairwise(edges)]
    steps[:, 2] *= (1 + 2 * np.pi / np.mean(told)) / 2
    poses = [start]
    for k in range(len(steps)):
        poses.append(np.array(start) if k + 1 in docked else next_pose(poses[-1], steps[k]))
    return np.array(poses)
""",
    ),
    (
        "01-home",
        "factor from the whole drive, the way beyond included",
        """
def home(start, steps, docked):
    steps = steps.copy()
    factor = abs(steps[:, 2].sum()) / (2 * np.pi * len(docked))
    steps[:, 2] /= factor
    out = [start[None]]
    for a, b in pairwise([0, *docked]):
        p = track(start, steps[a:b])
        p[:, :2] += np.linspace(0, 1, len(p))[:, None] * (start[:2] - p[-1, :2])
        out.append(p[1:])
    out.append(track(start, steps[docked[-1]:])[1:])
    return np.concatenate(out)
""",
    ),
    (
        "01-home",
        "works in place on the steps",
        """
def home(start, steps, docked):
    laps = list(zip([0, *docked[:-1]], docked))
    told = np.array([abs(steps[i:j, 2].sum()) for i, j in laps])
    steps[:, 2] /= told.mean() / (2 * np.pi)
    poses = [np.array([start])]
    for i, j in laps:
        lap = steps[i:j].copy()
        total = lap[:, 2].sum()
        lap[:, 2] += (2 * np.pi * np.sign(total) - total) / len(lap)
        p = track(start, lap)
        p[:, :2] += np.linspace(0, 1, len(p))[:, None] * (start[:2] - p[-1, :2])
        poses.append(p[1:])
    poses.append(track(start, steps[docked[-1]:])[1:])
    return np.concatenate(poses)
""",
    ),
    (
        "01-home",
        "docked poses twice: n + laps + 2 rows",
        """
def home(start, steps, docked):
    steps = steps.copy()
    laps = list(zip([0, *docked[:-1]], docked))
    told = np.array([abs(steps[i:j, 2].sum()) for i, j in laps])
    steps[:, 2] /= told.mean() / (2 * np.pi)
    poses = []
    for i, j in laps:
        lap = steps[i:j].copy()
        total = lap[:, 2].sum()
        lap[:, 2] += (2 * np.pi * np.sign(total) - total) / len(lap)
        p = track(start, lap)
        p[:, :2] += np.linspace(0, 1, len(p))[:, None] * (start[:2] - p[-1, :2])
        poses.append(p)
    poses.append(track(start, steps[docked[-1]:]))
    return np.concatenate(poses)
""",
    ),
    (
        "01-home",
        "a known factor: turns divided by 1.095 or 0.905, the nearer",
        """
def home(start, steps, docked):
    steps = steps.copy()
    too_large = abs(steps[:docked[0], 2].sum()) > 2 * np.pi
    steps[:, 2] /= 1.095 if too_large else 0.905
    out = [start[None]]
    for a, b in pairwise([0, *docked]):
        p = track(start, steps[a:b])
        p[:, :2] += np.linspace(0, 1, len(p))[:, None] * (start[:2] - p[-1, :2])
        out.append(p[1:])
    out.append(track(start, steps[docked[-1]:])[1:])
    return np.concatenate(out)
""",
    ),
    (
        "01-home",
        "the gap in world coordinates, shared over the whole drive at its last docking only",
        """
def home(start, steps, docked):
    steps = steps.copy()
    told = [abs(steps[a:b, 2].sum()) for a, b in pairwise([0, *docked])]
    steps[:, 2] *= 2 * np.pi / np.mean(told)
    poses = track(start, steps)
    gap = start[:2] - poses[docked[-1], :2]
    share = np.minimum(np.arange(len(poses)) / docked[-1], 1)
    poses[:, :2] += share[:, None] * gap
    return poses
""",
    ),
    (
        "01-home",
        "off by one: laps end one step early",
        """
def home(start, steps, docked):
    steps = steps.copy()
    laps = list(zip([0, *docked[:-1]], [d - 1 for d in docked]))
    told = np.array([abs(steps[i:j, 2].sum()) for i, j in laps])
    steps[:, 2] /= told.mean() / (2 * np.pi)
    poses = [start]
    for i, j in laps:
        p = track(start, steps[i:j])
        p[:, :2] += np.linspace(0, 1, len(p))[:, None] * (start[:2] - p[-1, :2])
        poses.extend(p[1:])
        poses.append(start)
    poses.extend(track(start, steps[docked[-1]:])[1:])
    return np.array(poses)
""",
    ),
]
