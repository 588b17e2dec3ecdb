# %% way: the factor that closes the laps best
def home(start, steps, docked):
    bounds = [0, *docked]
    laps = [slice(a, b) for a, b in zip(bounds[:-1], bounds[1:])]

    def run(moves):
        headings = np.append(0, np.cumsum(moves[:, 2]))
        z = np.append(0, np.cumsum(moves[:, 0] * np.exp(1j * headings[:-1])))
        return z, headings

    def gaps(factor):
        total = 0.0
        for lap in laps:
            z, headings = run(steps[lap] / [1, 1, factor])
            total += abs(z[-1]) ** 2 + 9 * abs(np.exp(1j * headings[-1]) - 1) ** 2
        return total

    factor = min(np.linspace(0.8, 1.2, 201), key=gaps)
    steps = steps / [1, 1, factor]
    found, turn = [np.zeros(1)], np.exp(1j * start[2])
    for lap in laps:
        moves = steps[lap].copy()
        off = moves[:, 2].sum()
        moves[:, 2] -= (off - 2 * np.pi * np.round(off / (2 * np.pi))) / len(moves)
        z, _ = run(moves)
        found.append((z - z[-1] * np.linspace(0, 1, len(z)))[1:])
    found.append(run(steps[docked[-1] :])[0][1:])
    z = np.concatenate(found) * turn
    return [[start[0] + p.real, start[1] + p.imag, start[2]] for p in z]

# %% way: shared by turns and by lengths
def home(start, steps, docked):
    steps = steps.copy()
    factor = 1.0
    bounds = [0, *docked]
    told = [abs(steps[a:b, 2].sum()) for a, b in zip(bounds[:-1], bounds[1:])]
    factor = np.mean(told) / (2 * np.pi)
    steps[:, 2] /= factor
    poses, i = [np.array([start])], 0
    for j in docked:
        lap = steps[i:j].copy()
        turned = lap[:, 2].sum()
        lap[:, 2] += (2 * np.pi * np.round(turned / (2 * np.pi)) - turned) * (0.02 + np.abs(lap[:, 2])) / np.sum(0.02 + np.abs(lap[:, 2]))
        told = track(start, lap)
        told[:, :2] += (start[:2] - told[-1, :2]) * np.append(0, np.cumsum(lap[:, 0]) / np.sum(lap[:, 0]))[:, None]
        poses.append(told[1:])
        i = j
    return np.concatenate([*poses, track(start, steps[i:])[1:]])

# %% way: the middle of the laps' factors
def home(start, steps, docked):
    steps = steps.copy()
    factor = 1.0
    bounds = [0, *docked]
    told = [abs(steps[a:b, 2].sum()) for a, b in zip(bounds[:-1], bounds[1:])]
    factor = (np.median(told) + np.mean(told)) / (4 * np.pi)
    steps[:, 2] /= factor
    poses, i = [np.array([start])], 0
    for j in docked:
        lap = steps[i:j].copy()
        turned = lap[:, 2].sum()
        lap[:, 2] += (2 * np.pi * np.round(turned / (2 * np.pi)) - turned) * 1 / len(lap)
        told = track(start, lap)
        told[:, :2] += (start[:2] - told[-1, :2]) * np.linspace(0, 1, len(told))[:, None]
        poses.append(told[1:])
        i = j
    return np.concatenate([*poses, track(start, steps[i:])[1:]])

# %% pasted: dead reckoning
def home(start, steps, docked):
    return track(start, steps)

# %% pasted: dead reckoning from each docking on
def home(start, steps, docked):
    steps = steps.copy()
    factor = 1.0
    pass
    steps[:, 2] /= factor
    poses, i = [np.array([start])], 0
    for j in docked:
        lap = steps[i:j].copy()
        turned = lap[:, 2].sum()
        lap[:, 2] += (2 * np.pi * np.round(turned / (2 * np.pi)) - turned) * 0
        told = track(start, lap)
        told[:, :2] += (start[:2] - told[-1, :2]) * (np.arange(len(told)) == len(told) - 1)[:, None]
        poses.append(told[1:])
        i = j
    return np.concatenate([*poses, track(start, steps[i:])[1:]])

# %% right: factor by mean ratio, heading and gap shared by lap, helper functions
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

# %% right: least squares of the lap: small errors of each step, constraints of the end
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

# %% right: each lap's own factor and places shared, way beyond by the last lap's
def home(start, steps, docked):
    steps = steps.copy()

    out, i, f = [np.array([start])], 0, 1.0
    for j in docked:
        f = abs(steps[i:j, 2].sum()) / (2 * np.pi)
        steps[i:j, 2] /= f
        told = track(start, steps[i:j])
        told[:, :2] += np.linspace(0, 1, len(told))[:, None] * (start[:2] - told[-1, :2])
        out.append(told[1:])
        i = j
    steps[i:, 2] /= f
    out.append(track(start, steps[i:])[1:])
    return np.concatenate(out)

# %% wrong: corrects each lap's heading, but the way beyond keeps the worn tyre
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

# %% wrong: factor from the whole drive, the way beyond included
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

# %% wrong: works in place on the steps
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

# %% wrong: docked poses twice: n + laps + 2 rows
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

# %% wrong: the last lap's factor for all, gaps not shared
def home(start, steps, docked):
    steps = steps.copy()

    a = docked[-2] if len(docked) > 1 else 0
    steps[:, 2] /= abs(steps[a:docked[-1], 2].sum()) / (2 * np.pi)
    return track(start, steps)
