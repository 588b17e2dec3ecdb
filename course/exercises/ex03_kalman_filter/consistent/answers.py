# %% way: loops
def consistency(errors, Ps, vs, Ss):
    count = 0
    total = 0.0
    for e, P in zip(errors, Ps):
        total += e @ np.linalg.solve(P, e)
        count += len(e)
    N, T = len(errors), len(vs)
    nis = sum(v * v / S for v, S in zip(vs, Ss)) / T
    interval = [chi2_quantile(p, count) / N for p in (0.025, 0.975)]
    low, high = chi2_quantile(0.025, T), chi2_quantile(0.975, T)
    w = [v / S**0.5 for v, S in zip(vs, Ss)]
    r = np.corrcoef(w[1:], w[:-1])[0, 1]
    if low / T <= nis <= high / T:
        wrong = (0, 0)
    elif nis > 1:
        wrong = (1, 0) if r > 0 else (0, 1)
    else:
        wrong = (-1, 0) if r < 0 else (0, -1)
    return [total / N, *interval], [nis, low / T, high / T], wrong

# %% way: whitened
def consistency(errors, Ps, vs, Ss):
    white = np.linalg.solve(np.linalg.cholesky(Ps), errors[..., None])[..., 0]
    w = vs / np.sqrt(Ss)

    def test(squares, freedom):
        low, high = (chi2_quantile(p, freedom) for p in (0.025, 0.975))
        return np.array([squares.sum(), low, high]) / len(squares)

    nees, nis = test((white**2).sum(axis=1), white.size), test(w**2, w.size)
    size = np.sign(nis[0] - np.clip(nis[0], nis[1], nis[2]))
    same = np.sign(np.sum(w[1:] * w[:-1]))
    return nees, nis, [size * (same == size), size * (same != size)]

# %% right: signs counted instead of an autocorrelation
def consistency(errors, Ps, vs, Ss):
    N, n = errors.shape
    nees = np.mean([e @ np.linalg.inv(P) @ e for e, P in zip(errors, Ps)])
    nis = np.mean(vs**2 / Ss)
    a = chi2_quantile([0.025, 0.975], N * n) / N
    b = chi2_quantile([0.025, 0.975], len(vs)) / len(vs)
    correlated = np.mean(np.sign(vs[1:]) == np.sign(vs[:-1])) > 0.5
    wrong = [0, 0]
    if nis > b[1]:
        wrong[0 if correlated else 1] = 1
    if nis < b[0]:
        wrong[1 if correlated else 0] = -1
    return [nees, a[0], a[1]], [nis, b[0], b[1]], wrong

# %% wrong: which noise from the size of the NIS alone
def consistency(errors, Ps, vs, Ss):
    N, n = errors.shape
    nees = np.mean([e @ np.linalg.inv(P) @ e for e, P in zip(errors, Ps)])
    nis = np.mean(vs**2 / Ss)
    a, b = chi2_quantile([0.025, 0.975], N * n) / N, chi2_quantile([0.025, 0.975], len(vs)) / len(vs)
    wrong = [0, 0]
    if nis > b[1]:
        wrong = [0, 1] if nis > 2.5 else [1, 0]
    if nis < b[0]:
        wrong = [0, -1] if nis < 0.4 else [-1, 0]
    return [nees, *a], [nis, *b], wrong

# %% wrong: the interval of a single NEES, and the whole NIS
def consistency(errors, Ps, vs, Ss):
    n = errors.shape[1]
    each = np.array([e @ np.linalg.solve(P, e) for e, P in zip(errors, Ps)])
    nis = np.sum(vs**2 / Ss)
    w = vs / np.sqrt(Ss)
    r = np.sum(w[1:] * w[:-1])
    b = chi2_quantile([0.025, 0.975], len(vs))
    s = 1 if nis > b[1] else -1 if nis < b[0] else 0
    return [each.mean(), *chi2_quantile([0.025, 0.975], n)], [nis, *b], [s, 0] if s * r > 0 else [0, s]

# %% wrong: Gaussian intervals, and Q and R exchanged
def consistency(errors, Ps, vs, Ss):
    N, n = errors.shape
    nees = np.mean([e @ np.linalg.solve(P, e) for e, P in zip(errors, Ps)])
    nis = np.mean(vs**2 / Ss)
    a = n + 1.96 * np.sqrt(2 * n / N) * np.array([-1, 1])
    b = 1 + 1.96 * np.sqrt(2 / len(vs)) * np.array([-1, 1])
    r = np.mean(vs[1:] * vs[:-1])
    s = int(nis > b[1]) - int(nis < b[0])
    return [nees, *a], [nis, *b], [0, s] if s * r > 0 else [s, 0]
