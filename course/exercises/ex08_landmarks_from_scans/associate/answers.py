# %% way: a table, sorted
def associate(z, expected, S, gate):
    d2 = np.empty((len(z), len(expected)))
    for i in range(len(z)):
        for j in range(len(expected)):
            v = z[i] - expected[j]
            v[1] = wrap(v[1])
            d2[i, j] = v @ np.linalg.solve(S[j], v)
    pairs = [None] * len(z)
    for k in np.argsort(d2, axis=None):
        i, j = divmod(int(k), len(expected))
        if d2[i, j] <= gate and pairs[i] is None and j not in pairs:
            pairs[i] = j
    return pairs

# %% way: all at once
def associate(z, expected, S, gate):
    v = z[:, None] - expected
    v[..., 1] = wrap(v[..., 1])
    d2 = np.einsum("mni,nij,mnj->mn", v, np.linalg.inv(S), v)
    pairs = [None] * len(z)
    for _ in range(d2.size):
        if d2.min() > gate:
            break
        i, j = np.unravel_index(d2.argmin(), d2.shape)
        pairs[i] = np.int64(j)
        d2[i], d2[:, j] = np.inf, np.inf
    return tuple(pairs)

# %% way: whitened
def associate(z, expected, S, gate):
    found = {}
    all_pairs = [(i, j) for i in range(len(z)) for j in range(len(expected))]
    def d2(pair):
        v = np.array([z[pair[0]][0] - expected[pair[1]][0], wrap(z[pair[0]][1] - expected[pair[1]][1])])
        return np.sum(np.linalg.solve(np.linalg.cholesky(S[pair[1]]), v) ** 2)
    for i, j in sorted((p for p in all_pairs if d2(p) <= gate), key=d2):
        if i not in found and j not in found.values():
            found[i] = j
    return [found.get(i) for i in range(len(z))]

# %% way: a heap
def associate(z, expected, S, gate):
    import heapq
    heap, pairs, taken = [], [None for _ in z], set()
    for i, seen in enumerate(z):
        for j, (place, cov) in enumerate(zip(expected, S)):
            v = seen - place
            v = np.array([v[0], (v[1] + np.pi) % (2 * np.pi) - np.pi])
            heapq.heappush(heap, (float(v @ np.linalg.pinv(cov) @ v), i, j))
    for _ in range(len(heap)):
        d, i, j = heapq.heappop(heap)
        if d > gate:
            break
        if pairs[i] is None and j not in taken:
            pairs[i] = j
            taken.add(j)
    return pairs

# %% right: matrix of distances, smallest taken out until none is in the gate
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

# %% right: recursion on what is left, wrapped by arctan2
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

# %% wrong: angles of the sightings changed in place
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

# %% wrong: an empty scan: min of nothing
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

# %% wrong: wall 0 taken for no wall
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

# %% wrong: rows and columns deleted: the numbers shift
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

# %% wrong: -1 for a new one
def associate(z, expected, S, gate):
    pairs, out = [], [-1] * len(z)
    for i in range(len(z)):
        for j in range(len(expected)):
            v = z[i] - expected[j]
            v[1] = wrap(v[1])
            pairs.append((v @ np.linalg.inv(S[j]) @ v, i, j))
    used = []
    for d, i, j in sorted(pairs):
        if d <= gate and out[i] == -1 and j not in used:
            out[i] = j
            used.append(j)
    return out
