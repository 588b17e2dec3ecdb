# %% way: whitened innovations
def consistency(x, P, u, seen, z, C, R, end=None):
    whites, errors = [], []
    for r in range(len(x)):
        state, cov, ids = np.array(x[r]), np.array(P), []
        for k in range(len(seen)):
            state, cov = predict(state, cov, u[r][k], C)
            for i, one in zip(seen[k], z[r][k]):
                if i in ids:
                    j = ids.index(i)
                    v = one - h(state[:3], state[3 + 2 * j : 5 + 2 * j])
                    v[1] = wrap(v[1])
                    S = H_full(state, j) @ cov @ H_full(state, j).T + R
                    whites.append(np.linalg.solve(np.linalg.cholesky(S), v))
                    state, cov = update(state, cov, one, j, R)
                else:
                    ids.append(i)
                    state, cov = augment(state, cov, one, R)
        if end is not None:
            e = state[:3] - end
            e[2] = wrap(e[2])
            errors.append(np.linalg.solve(np.linalg.cholesky(cov[:3, :3]), e))
    return interval(whites), interval(errors) if end is not None else None


def interval(vectors):
    squares = np.square(vectors)
    low, high = chi2_quantile(0.025, squares.size), chi2_quantile(0.975, squares.size)
    return [squares.sum() / len(squares), low / len(squares), high / len(squares)]

# %% right: runs kept, statistics afterwards
def one_run(state, cov, controls, seen, scans, C, R):
    ids, kept = [], []
    for control, names, scan in zip(controls, seen, scans):
        state, cov = predict(state, cov, control, C)
        for i, one in zip(names, scan):
            if i in ids:
                j = ids.index(i)
                predicted = h(state[:3], state[2 * j + 3 : 2 * j + 5])
                kept.append((one - predicted, H_full(state, j) @ cov @ H_full(state, j).T + R))
                state, cov = update(state, cov, one, j, R)
            else:
                state, cov = augment(state, cov, one, R)
                ids += [i]
    return state, cov, kept


def consistency(x, P, u, seen, z, C, R, end=None):
    ends = [one_run(a, P, b, seen, c, C, R) for a, b, c in zip(x, u, z)]
    d2 = []
    for _, _, kept in ends:
        for v, S in kept:
            v = np.array([v[0], np.arctan2(np.sin(v[1]), np.cos(v[1]))])
            d2.append(v.T @ np.linalg.inv(S) @ v)
    m = len(d2)
    nis = np.array([sum(d2) / m, chi2_quantile(0.025, 2 * m) / m, chi2_quantile(0.975, 2 * m) / m])
    if end is None:
        return nis, None
    total = 0
    for state, cov, _ in ends:
        e = state[:3] - end
        e[2] = (e[2] + np.pi) % (2 * np.pi) - np.pi
        total += e @ np.linalg.pinv(cov[:3, :3]) @ e
    return nis, np.array([total, chi2_quantile(0.025, 3 * len(x)), chi2_quantile(0.975, 3 * len(x))]) / len(x)

# %% wrong: S and innovation after the update
def consistency(x, P, u, seen, z, C, R, end=None):
    nis, nees = [], []
    for r in range(len(x)):
        s, c, ids = x[r], P, []
        for k in range(len(seen)):
            s, c = predict(s, c, u[r][k], C)
            for i, one in zip(seen[k], z[r][k]):
                if i not in ids:
                    s, c = augment(s, c, one, R)
                    ids.append(i)
                else:
                    j = ids.index(i)
                    s, c = update(s, c, one, j, R)
                    v = one - h(s[:3], s[3 + 2 * j : 5 + 2 * j])
                    v[1] = wrap(v[1])
                    S = H_full(s, j) @ c @ H_full(s, j).T + R
                    nis.append(v @ np.linalg.inv(S) @ v)
        if end is not None:
            e = s[:3] - end
            e[2] = wrap(e[2])
            nees.append(e @ np.linalg.inv(c[:3, :3]) @ e)
    test = lambda a, d: [np.mean(a), chi2_quantile(0.025, d * len(a)) / len(a), chi2_quantile(0.975, d * len(a)) / len(a)]
    return test(nis, 2), None if end is None else test(nees, 3)

# %% wrong: each scan's mean is averaged, first measurements included
def consistency(x, P, u, seen, z, C, R, end=None):
    means, nees, steps = [], [], 0
    for r in range(len(x)):
        s, c, ids = x[r], P, []
        for k in range(len(seen)):
            s, c = predict(s, c, u[r][k], C)
            scan = []
            for i, one in zip(seen[k], z[r][k]):
                if i not in ids:
                    s, c = augment(s, c, one, R)
                    ids.append(i)
                j = ids.index(i)
                v = one - h(s[:3], s[3 + 2 * j : 5 + 2 * j])
                v[1] = wrap(v[1])
                S = H_full(s, j) @ c @ H_full(s, j).T + R
                scan.append(v @ np.linalg.inv(S) @ v)
                s, c = update(s, c, one, j, R)
            if scan:
                means.append(np.mean(scan))
        if end is not None:
            e = s[:3] - end
            nees.append(e @ np.linalg.inv(c[:3, :3]) @ e)
    test = lambda a, d: [np.mean(a), chi2_quantile(0.025, d * len(a)) / len(a), chi2_quantile(0.975, d * len(a)) / len(a)]
    return test(means, 2), None if end is None else test(nees, 3)

# %% wrong: intervals of single values, and a NEES of the position
def consistency(x, P, u, seen, z, C, R, end=None):
    nis, nees = [], []
    for r in range(len(x)):
        s, c, ids = x[r], P, []
        for k in range(len(seen)):
            s, c = predict(s, c, u[r][k], C)
            for i, one in zip(seen[k], z[r][k]):
                if i in ids:
                    j = ids.index(i)
                    v = one - h(s[:3], s[3 + 2 * j : 5 + 2 * j])
                    v[1] = wrap(v[1])
                    nis.append(v @ np.linalg.inv(H_full(s, j) @ c @ H_full(s, j).T + R) @ v)
                    s, c = update(s, c, one, j, R)
                else:
                    s, c = augment(s, c, one, R)
                    ids.append(i)
        if end is not None:
            e = s[:2] - end[:2]
            nees.append(e @ np.linalg.inv(c[:2, :2]) @ e)
    low, high = chi2_quantile(0.025, 2), chi2_quantile(0.975, 2)
    return [np.mean(nis), low, high], None if end is None else [np.mean(nees), low, high]
