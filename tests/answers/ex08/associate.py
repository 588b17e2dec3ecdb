"""Independent answers to 08-associate: right ones, and students' mistakes."""

RIGHT = [
    (
        "08-associate",
        "matrix of distances, smallest taken out until none is in the gate",
        """
def associate(z, expected, S, gate):
    m, N = len(z), len(expected)
    answer = [None] * m
    if m == 0 or N == 0:
        return answer
    v = z[:, None, :] - expected[None, :, :]
    v[..., 1] = wrap(v[..., 1])
    D = np.einsum("ijk,jkl,ijl->ij", v, np.linalg.inv(S), v)
    while True:
        i, j = np.unravel_index(np.argmin(D), D.shape)
        if not D[i, j] <= gate:
            return answer
        answer[i] = int(j)
        D[i, :] = np.inf
        D[:, j] = np.inf
        if np.isinf(D).all():
            return answer
""",
    ),
    (
        "08-associate",
        "recursion on what is left, wrapped by arctan2",
        """
def associate(z, expected, S, gate):
    def d2(i, j):
        dr, da = z[i][0] - expected[j][0], z[i][1] - expected[j][1]
        v = np.array([dr, np.arctan2(np.sin(da), np.cos(da))])
        return v @ np.linalg.solve(S[j], v)

    table = {(i, j): d2(i, j) for i in range(len(z)) for j in range(len(expected))}

    def pair(left):
        if not left:
            return {}
        i, j = min(left, key=left.get)
        return {i: j} | pair({k: d for k, d in left.items() if k[0] != i and k[1] != j})

    found = pair({k: d for k, d in table.items() if d <= gate})
    return [found.get(i) for i in range(len(z))]
""",
    ),
]

WRONG = [
    (
        "08-associate",
        "angle not wrapped",
        """
def associate(z, expected, S, gate):
    cand = []
    for i, a in enumerate(z):
        for j, b in enumerate(expected):
            v = a - b
            cand.append((v @ np.linalg.solve(S[j], v), i, j))
    result, used = [None] * len(z), set()
    for d, i, j in sorted(cand):
        if d <= gate and result[i] is None and j not in used:
            result[i] = j
            used.add(j)
    return result
""",
    ),
    (
        "08-associate",
        "Euclid in place of Mahalanobis",
        """
def associate(z, expected, S, gate):
    pairs = []
    for i in range(len(z)):
        for j in range(len(expected)):
            v = z[i] - expected[j]
            pairs.append((v[0] ** 2 + wrap(v[1]) ** 2, i, j))
    result, used = [None] * len(z), set()
    for d, i, j in sorted(pairs):
        if d <= gate and result[i] is None and j not in used:
            result[i] = j
            used.add(j)
    return result
""",
    ),
    (
        "08-associate",
        "each sighting takes its nearest, walls used more than once",
        """
def associate(z, expected, S, gate):
    result = []
    for sighting in z:
        best, best_d = None, gate
        for j in range(len(expected)):
            v = sighting - expected[j]
            v[1] = wrap(v[1])
            d = v @ np.linalg.inv(S[j]) @ v
            if d <= best_d:
                best, best_d = j, d
        result.append(best)
    return result
""",
    ),
    (
        "08-associate",
        "greedy in the order of the sightings",
        """
def associate(z, expected, S, gate):
    free = set(range(len(expected)))
    result = []
    for sighting in z:
        best, best_d = None, gate
        for j in sorted(free):
            v = sighting - expected[j]
            v[1] = wrap(v[1])
            d = v @ np.linalg.inv(S[j]) @ v
            if d <= best_d:
                best, best_d = j, d
        if best is not None:
            free.remove(best)
        result.append(best)
    return result
""",
    ),
    (
        "08-associate",
        "greedy in the order of the walls",
        """
def associate(z, expected, S, gate):
    result = [None] * len(z)
    for j, (wall, cov) in enumerate(zip(expected, S)):
        inv = np.linalg.inv(cov)
        options = []
        for i in range(len(z)):
            if result[i] is None:
                v = np.array([z[i, 0] - wall[0], wrap(z[i, 1] - wall[1])])
                options.append((v @ inv @ v, i))
        if options and min(options)[0] <= gate:
            result[min(options)[1]] = j
    return result
""",
    ),
    (
        "08-associate",
        "d in place of d^2 under the gate",
        """
def associate(z, expected, S, gate):
    todo = []
    for i in range(len(z)):
        for j in range(len(expected)):
            v = z[i] - expected[j]
            v[1] = wrap(v[1])
            todo.append((np.sqrt(v @ np.linalg.inv(S[j]) @ v), i, j))
    out, taken = [None] * len(z), []
    for d, i, j in sorted(todo):
        if d <= gate and out[i] is None and j not in taken:
            out[i] = j
            taken.append(j)
    return out
""",
    ),
    (
        "08-associate",
        "a pair exactly at the gate refused",
        """
def associate(z, expected, S, gate):
    distances = []
    for i in range(len(z)):
        for j in range(len(expected)):
            v = z[i] - expected[j]
            v[1] = wrap(v[1])
            distances.append((v @ np.linalg.inv(S[j]) @ v, i, j))
    pairs = {}
    for d2, i, j in sorted(distances):
        if d2 < gate and i not in pairs and j not in pairs.values():
            pairs[i] = j
    return [pairs.get(i) for i in range(len(z))]
""",
    ),
    (
        "08-associate",
        "angles of the sightings changed in place",
        """
def associate(z, expected, S, gate):
    todo = []
    for i in range(len(z)):
        for j in range(len(expected)):
            v = z[i]
            v -= expected[j]
            v[1] = wrap(v[1])
            todo.append((v @ np.linalg.inv(S[j]) @ v, i, j))
            v += expected[j]
    out, taken = [None] * len(z), set()
    for d, i, j in sorted(todo):
        if d <= gate and out[i] is None and j not in taken:
            out[i] = j
            taken.add(j)
    return out
""",
    ),
    (
        "08-associate",
        "S of the first wall for all",
        """
def associate(z, expected, S, gate):
    if len(expected) == 0:
        return [None] * len(z)
    inverse = np.linalg.inv(S[0])
    todo = []
    for i in range(len(z)):
        for j in range(len(expected)):
            v = np.array([z[i, 0] - expected[j, 0], wrap(z[i, 1] - expected[j, 1])])
            todo.append((v @ inverse @ v, i, j))
    out, taken = [None] * len(z), set()
    for d, i, j in sorted(todo):
        if d <= gate and out[i] is None and j not in taken:
            out[i] = j
            taken.add(j)
    return out
""",
    ),
    (
        "08-associate",
        "only the variances of S",
        """
def associate(z, expected, S, gate):
    todo = []
    for i in range(len(z)):
        for j in range(len(expected)):
            dr, da = z[i, 0] - expected[j, 0], wrap(z[i, 1] - expected[j, 1])
            todo.append((dr**2 / S[j, 0, 0] + da**2 / S[j, 1, 1], i, j))
    out, taken = [None] * len(z), set()
    for d, i, j in sorted(todo):
        if d <= gate and out[i] is None and j not in taken:
            out[i] = j
            taken.add(j)
    return out
""",
    ),
    (
        "08-associate",
        "argmin of an empty map",
        """
def associate(z, expected, S, gate):
    out = [None] * len(z)
    if len(z) == 0:
        return out
    v = z[:, None] - expected[None]
    v[:, :, 1] = wrap(v[:, :, 1])
    D = np.einsum("ijk,jkl,ijl->ij", v, np.linalg.inv(S), v)
    for _ in range(len(z)):
        i, j = divmod(int(D.argmin()), D.shape[1])
        if D[i, j] > gate:
            break
        out[i] = j
        D[i], D[:, j] = np.inf, np.inf
    return out
""",
    ),
    (
        "08-associate",
        "an empty scan: min of nothing",
        """
def associate(z, expected, S, gate):
    if len(expected) == 0:
        return [None] * len(z)
    v = z[:, None] - expected[None]
    v[:, :, 1] = wrap(v[:, :, 1])
    D = np.einsum("ijk,jkl,ijl->ij", v, np.linalg.inv(S), v)
    out = [None] * len(z)
    while D.min() <= gate:
        i, j = np.unravel_index(D.argmin(), D.shape)
        out[i] = int(j)
        D[i, :] = D[:, j] = np.inf
    return out
""",
    ),
    (
        "08-associate",
        "-1 in place of None",
        """
def associate(z, expected, S, gate):
    out, used = [-1] * len(z), set()
    todo = []
    for i in range(len(z)):
        for j in range(len(expected)):
            v = z[i] - expected[j]
            v[1] = wrap(v[1])
            todo.append((float(v @ np.linalg.inv(S[j]) @ v), i, j))
    todo.sort()
    for d, i, j in todo:
        if d <= gate and out[i] < 0 and j not in used:
            out[i] = j
            used.add(j)
    return out
""",
    ),
    (
        "08-associate",
        "wall 0 taken for no wall",
        """
def associate(z, expected, S, gate):
    out, used = {}, set()
    todo = []
    for i in range(len(z)):
        for j in range(len(expected)):
            v = z[i] - expected[j]
            v[1] = wrap(v[1])
            todo.append((float(v @ np.linalg.inv(S[j]) @ v), i, j))
    for d, i, j in sorted(todo):
        if d <= gate and not out.get(i) and j not in used:
            out[i] = j
            used.add(j)
    return [out.get(i) or None for i in range(len(z))]
""",
    ),
    (
        "08-associate",
        "least sum of all distances (Hungarian), then the gate",
        """
def associate(z, expected, S, gate):
    from scipy.optimize import linear_sum_assignment

    out = [None] * len(z)
    if len(z) == 0 or len(expected) == 0:
        return out
    v = z[:, None] - expected[None]
    v[..., 1] = wrap(v[..., 1])
    D = np.einsum("ijk,jkl,ijl->ij", v, np.linalg.inv(S), v)
    for i, j in zip(*linear_sum_assignment(D)):
        if D[i, j] <= gate:
            out[i] = int(j)
    return out
""",
    ),
    (
        "08-associate",
        "both angles wrapped, not their difference",
        """
def associate(z, expected, S, gate):
    todo = []
    for i in range(len(z)):
        for j in range(len(expected)):
            v = np.array([z[i, 0] - expected[j, 0], wrap(z[i, 1]) - wrap(expected[j, 1])])
            todo.append((v @ np.linalg.inv(S[j]) @ v, i, j))
    out, taken = [None] * len(z), set()
    for d, i, j in sorted(todo):
        if d <= gate and out[i] is None and j not in taken:
            out[i] = j
            taken.add(j)
    return out
""",
    ),
    (
        "08-associate",
        "wrapped angle made positive: its sign lost",
        """
def associate(z, expected, S, gate):
    todo = []
    for i in range(len(z)):
        for j in range(len(expected)):
            da = abs(z[i, 1] - expected[j, 1]) % (2 * np.pi)
            da = min(da, 2 * np.pi - da)
            v = np.array([z[i, 0] - expected[j, 0], da])
            todo.append((v @ np.linalg.inv(S[j]) @ v, i, j))
    out, taken = [None] * len(z), set()
    for d, i, j in sorted(todo):
        if d <= gate and out[i] is None and j not in taken:
            out[i] = j
            taken.add(j)
    return out
""",
    ),
    (
        "08-associate",
        "rho wrapped as well",
        """
def associate(z, expected, S, gate):
    out, taken = [None] * len(z), set()
    todo = []
    for i, seen in enumerate(z):
        for j, wall in enumerate(expected):
            v = wrap(seen - wall)
            todo.append((v @ np.linalg.inv(S[j]) @ v, i, j))
    for d, i, j in sorted(todo):
        if d <= gate and out[i] is None and j not in taken:
            out[i] = j
            taken.add(j)
    return out
""",
    ),
    (
        "08-associate",
        "rows and columns deleted: the numbers shift",
        """
def associate(z, expected, S, gate):
    m, N = len(z), len(expected)
    out = [None] * m
    if m == 0 or N == 0:
        return out
    v = z[:, None] - expected[None]
    v[..., 1] = wrap(v[..., 1])
    D = np.einsum("ijk,jkl,ijl->ij", v, np.linalg.inv(S), v)
    while D.size and D.min() <= gate:
        i, j = np.unravel_index(D.argmin(), D.shape)
        out[i] = int(j)
        D = np.delete(np.delete(D, i, axis=0), j, axis=1)
    return out
""",
    ),
    (
        "08-associate",
        "only mutual nearest neighbours: no next nearest",
        """
def associate(z, expected, S, gate):
    m, N = len(z), len(expected)
    if m == 0 or N == 0:
        return [None] * m
    v = z[:, None] - expected[None]
    v[..., 1] = wrap(v[..., 1])
    D = np.einsum("ijk,jkl,ijl->ij", v, np.linalg.inv(S), v)
    out = []
    for i in range(m):
        j = int(D[i].argmin())
        out.append(j if D[i, j] <= gate and D[:, j].argmin() == i else None)
    return out
""",
    ),
    (
        "08-associate",
        "the first wall under the gate, not the nearest",
        """
def associate(z, expected, S, gate):
    out = []
    for seen in z:
        mine = None
        for j in range(len(expected)):
            v = seen - expected[j]
            v[1] = wrap(v[1])
            if j not in out and v @ np.linalg.solve(S[j], v) <= gate:
                mine = j
                break
        out.append(mine)
    return out
""",
    ),
]
