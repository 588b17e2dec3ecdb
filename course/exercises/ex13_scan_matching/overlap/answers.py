# %% way: votes, then robust ICP, then across
def match(source, target, T):
    tree, normals, Q = cKDTree(target), normals_of(target), np.diag([1.0, 1.0, 1.0])

    def near(T, gate=0.1):
        return np.sum(tree.query(carry(T, source))[0] < gate)

    def across(T, gates):
        for gate in gates:
            distances, rows = tree.query(carry(T, source))
            k = distances < gate
            sigma = np.full(k.sum(), 0.02)
            x, y, turn = line_step(source[k], target[rows[k]], normals[rows[k]], sigma, T, Q)[0]
            c, s = np.cos(turn), np.sin(turn)
            T = T @ np.array([[c, -s, x], [s, c, y], [0, 0, 1]])
        return T

    def motion(angle, shift):
        T = np.eye(3)
        T[:2, :2], T[:2, 2] = turned(angle), shift
        return T

    def best(starts, iterations=(0.5, 0.4, 0.3, 0.25, 0.2)):
        ends = [across(start, iterations) for start in starts]
        return across(max(ends, key=near), (0.15, 0.12, 0.1, 0.1, 0.1, 0.1))

    voted = []
    for angle in np.radians(np.arange(0, 360, 8)):
        shifts = (target[::2, None] - source[::2] @ turned(angle).T).reshape(-1, 2)
        H, x, y = np.histogram2d(*shifts.T, bins=(np.arange(-9, 9, 0.3), np.arange(-9, 9, 0.3)))
        i, j = np.unravel_index(H.argmax(), H.shape)
        voted.append((H[i, j], angle, x[i] + 0.15, y[j] + 0.15))
    starts = [motion(angle, (x, y)) for _, angle, x, y in sorted(voted)[-10:]]
    return best([robust_icp(source, target, start, 10, 0.3) for start in starts], (0.15, 0.15))

# %% way: turns by the walls' directions, shifts by votes
def match(source, target, T):
    tree, normals, Q = cKDTree(target), normals_of(target), np.diag([1.0, 1.0, 1.0])

    def near(T, gate=0.1):
        return np.sum(tree.query(carry(T, source))[0] < gate)

    def across(T, gates):
        for gate in gates:
            distances, rows = tree.query(carry(T, source))
            k = distances < gate
            sigma = np.full(k.sum(), 0.02)
            x, y, turn = line_step(source[k], target[rows[k]], normals[rows[k]], sigma, T, Q)[0]
            c, s = np.cos(turn), np.sin(turn)
            T = T @ np.array([[c, -s, x], [s, c, y], [0, 0, 1]])
        return T

    def motion(angle, shift):
        T = np.eye(3)
        T[:2, :2], T[:2, 2] = turned(angle), shift
        return T

    def best(starts, iterations=(0.5, 0.4, 0.3, 0.25, 0.2)):
        ends = [across(start, iterations) for start in starts]
        return across(max(ends, key=near), (0.15, 0.12, 0.1, 0.1, 0.1, 0.1))

    def directions(points):
        n = normals_of(points)
        return np.bincount(np.floor(np.degrees(np.arctan2(*n.T[::-1])) / 4).astype(int) % 90, minlength=90)

    first, now = directions(target), directions(source)
    alike = [now @ np.roll(np.convolve(np.tile(first, 3), [1, 2, 1], "same")[90:180], -k) for k in range(90)]
    starts = []
    for k in np.argsort(alike)[-36:]:
        angle = np.radians(4 * k)
        shifts = (target[:, None] - source[::2] @ turned(angle).T).reshape(-1, 2)
        cells, votes = np.unique(np.floor(shifts / 0.3) @ [1, 1j], return_counts=True)
        cell = cells[votes.argmax()]
        starts.append((votes.max(), k, motion(angle, 0.3 * np.array([cell.real, cell.imag]) + 0.15)))
    return best([start for _, _, start in sorted(starts, key=lambda s: s[:2])[-12:]])

# %% way: grids correlated by FFT
def match(source, target, T):
    tree, normals, Q = cKDTree(target), normals_of(target), np.diag([1.0, 1.0, 1.0])

    def near(T, gate=0.1):
        return np.sum(tree.query(carry(T, source))[0] < gate)

    def across(T, gates):
        for gate in gates:
            distances, rows = tree.query(carry(T, source))
            k = distances < gate
            sigma = np.full(k.sum(), 0.02)
            x, y, turn = line_step(source[k], target[rows[k]], normals[rows[k]], sigma, T, Q)[0]
            c, s = np.cos(turn), np.sin(turn)
            T = T @ np.array([[c, -s, x], [s, c, y], [0, 0, 1]])
        return T

    def motion(angle, shift):
        T = np.eye(3)
        T[:2, :2], T[:2, 2] = turned(angle), shift
        return T

    def best(starts, iterations=(0.5, 0.4, 0.3, 0.25, 0.2)):
        ends = [across(start, iterations) for start in starts]
        return across(max(ends, key=near), (0.15, 0.12, 0.1, 0.1, 0.1, 0.1))

    size, cell = 96, 0.2

    def raster(points):
        grid = np.zeros((size, size))
        i, j = np.floor(points / cell).astype(int).T % size
        grid[i, j] = 1
        return grid

    walls = raster(target)
    walls = np.maximum(walls, 0.5 * sum(np.roll(walls, s, a) for s in (-1, 1) for a in (0, 1)).clip(0, 1))
    seen, found = np.fft.rfft2(walls), []
    for angle in np.radians(np.arange(0, 360, 6)):
        score = np.fft.irfft2(seen * np.conj(np.fft.rfft2(raster(source @ turned(angle).T))))
        ij = np.array(np.unravel_index(score.argmax(), score.shape))
        found.append((score.max(), angle, (ij + size // 2) % size - size // 2))
    return best([motion(angle, cell * ij) for _, angle, ij in sorted(found, key=lambda f: f[:2])[-12:]])

# %% way: steps across from many turns and places
def match(source, target, T):
    tree, normals, Q = cKDTree(target), normals_of(target), np.diag([1.0, 1.0, 1.0])

    def near(T, gate=0.1):
        return np.sum(tree.query(carry(T, source))[0] < gate)

    def across(T, gates):
        for gate in gates:
            distances, rows = tree.query(carry(T, source))
            k = distances < gate
            sigma = np.full(k.sum(), 0.02)
            x, y, turn = line_step(source[k], target[rows[k]], normals[rows[k]], sigma, T, Q)[0]
            c, s = np.cos(turn), np.sin(turn)
            T = T @ np.array([[c, -s, x], [s, c, y], [0, 0, 1]])
        return T

    def motion(angle, shift):
        T = np.eye(3)
        T[:2, :2], T[:2, 2] = turned(angle), shift
        return T

    def best(starts, iterations=(0.5, 0.4, 0.3, 0.25, 0.2)):
        ends = [across(start, iterations) for start in starts]
        return across(max(ends, key=near), (0.15, 0.12, 0.1, 0.1, 0.1, 0.1))

    starts = []
    for x, y in ((0, 0), (0.6, 0), (-0.6, 0), (0, 0.6), (0, -0.6)):
        for angle in np.radians(np.arange(0, 360, 12)):
            starts.append(across(motion(angle, T[:2, 2] + [x, y]), (0.6, 0.5, 0.4)))
    starts = sorted(starts, key=lambda start: near(start, 0.2))[-30:]
    return best([across(start, (0.4, 0.3, 0.3)) for start in starts], (0.25, 0.2))

# %% pasted: plain ICP
def match(source, target, T):
    return icp(source, target, T, 60)

# %% pasted: robust ICP
def match(source, target, T):
    return robust_icp(source, target, T, 60, 0.3)

# %% pasted: the best motion of the rows
def match(source, target, T):
    return best_motion(source[: len(target)], target[: len(source)])

# %% pasted: the lesson's steps across the walls, best 80 %
def match(source, target, T):
    tree, n = cKDTree(target), normals_of(target)
    for _ in range(25):
        moved = carry(T, source)
        distances, rows = tree.query(moved)
        k = distances <= np.quantile(distances, 0.8)
        arm, wall = (moved - T[:2, 2])[k], n[rows[k]]
        r = np.sum(wall * (moved[k] - target[rows[k]]), axis=1)
        J = np.column_stack([wall, arm[:, 0] * wall[:, 1] - arm[:, 1] * wall[:, 0]])
        x, y, turn = np.linalg.lstsq(J, -r, rcond=None)[0]
        T = T.copy()
        T[:2, :2], T[:2, 2] = turned(turn) @ T[:2, :2], T[:2, 2] + [x, y]
    return T

# %% right: starts from many turns, votes for the shift, gated steps, counts close pairs
def match(source, target, T):
    tree = cKDTree(target)
    n = normals_of(target)
    found = []
    for angle in np.radians(np.arange(0, 360, 8)):
        R = turned(angle)
        shifts = (target[None, :, :] - (source[::2] @ R.T)[:, None, :]).reshape(-1, 2)
        H, ex, ey = np.histogram2d(shifts[:, 0], shifts[:, 1], bins=(60, 60), range=((-9, 9), (-9, 9)))
        i, j = np.unravel_index(np.argmax(H), H.shape)
        found.append((H[i, j], angle, (ex[i] + ex[i + 1]) / 2, (ey[j] + ey[j + 1]) / 2))
    found.sort(reverse=True)

    def refine(R, t, gates):
        for gate in gates:
            moved = source @ R.T + t
            d, rows = tree.query(moved)
            ok = d < gate
            if ok.sum() < 6:
                break
            m, q, nn = moved[ok], target[rows[ok]], n[rows[ok]]
            arm = m - t
            r = np.sum(nn * (m - q), axis=1)
            J = np.c_[nn, arm[:, 0] * nn[:, 1] - arm[:, 1] * nn[:, 0]]
            delta = np.linalg.solve(J.T @ J + 1e-3 * np.eye(3), -J.T @ r)
            R, t = turned(delta[2]) @ R, t + delta[:2]
        return R, t

    best = None
    for votes, angle, x, y in found[:10]:
        R, t = refine(turned(angle), np.array([x, y]), (0.6, 0.5, 0.4, 0.3, 0.25, 0.2))
        good = np.sum(tree.query(source @ R.T + t)[0] < 0.1)
        if best is None or good > best[0]:
            best = good, R, t
    R, t = refine(best[1], best[2], [0.15] * 3 + [0.1] * 8)
    out = np.eye(3)
    out[:2, :2], out[:2, 2] = R, t
    return out

# %% wrong: robust ICP from the guess
def match(source, target, T):
    return robust_icp(source, target, T, 50, 0.2)

# %% wrong: best of the voted turns, but the inverse motion is returned
def match(source, target, T):
    best = (-1, None, None)
    for angle in np.radians(np.arange(0, 360, 6)):
        R = turned(angle)
        shifts = (target[:, None] - source[::2] @ R.T).reshape(-1, 2)
        H, ex, ey = np.histogram2d(*shifts.T, bins=60, range=((-9, 9), (-9, 9)))
        i, j = np.unravel_index(H.argmax(), H.shape)
        if H[i, j] > best[0]:
            best = (H[i, j], R, np.array([ex[i] + 0.15, ey[j] + 0.15]))
    S = np.eye(3)
    S[:2, :2], S[:2, 2] = best[1], best[2]
    return np.linalg.inv(robust_icp(source, target, S, 40, 0.2))
