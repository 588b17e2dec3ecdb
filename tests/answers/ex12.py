"""Independent answers to exercise 12: right ones, and students' mistakes."""

RIGHT = [
    (
        "12-odometry",
        "radius of the arc, straight apart",
        """
def odometry(left, right, tick, base):
    d = (left + right) * tick / 2
    turn = (right - left) * tick / base
    if left == right:
        return np.array([d, 0.0, 0.0])
    radius = d / turn
    return np.array([radius * np.sin(turn), radius * (1 - np.cos(turn)), turn])
""",
    ),
    (
        "12-odometry",
        "chord by hand, theta wrapped at the end",
        """
def odometry(left, right, tick, base):
    l, r = tick * left, tick * right
    half = (r - l) / base / 2
    d = 0.5 * (l + r)
    ratio = np.sin(half) / half if half != 0 else 1.0
    return np.array([d * ratio * np.cos(half), d * ratio * np.sin(half), float(wrap(2 * half))])
""",
    ),
    (
        "12-lost",
        "walk backwards from the end",
        """
def lost_since(errors, limit):
    since = -1
    for k in range(len(errors) - 1, -1, -1):
        if errors[k] <= limit:
            break
        since = k
    return since
""",
    ),
    (
        "12-lost",
        "remember where it left last",
        """
def lost_since(errors, limit):
    since = None
    for k, error in enumerate(errors):
        if error > limit:
            since = k if since is None else since
        else:
            since = None
    return -1 if since is None else since
""",
    ),
    (
        "12-lost",
        "cumulative product from behind",
        """
def lost_since(errors, limit):
    beyond = (np.asarray(errors) > limit).astype(int)
    tail = int(np.cumprod(beyond[::-1]).sum())
    return len(beyond) - tail if tail else -1
""",
    ),
    (
        "12-interval",
        "abc formula",
        """
def interval(k, n):
    z2 = 1.96**2
    share = k / n
    a = 1 + z2 / n
    b = -(2 * share + z2 / n)
    c = share**2
    root = np.sqrt(max(b * b - 4 * a * c, 0.0))
    return max(0.0, (-b - root) / (2 * a)), min(1.0, (-b + root) / (2 * a))
""",
    ),
    (
        "12-interval",
        "Clopper-Pearson from scipy",
        """
def interval(k, n):
    from scipy.stats import beta
    low = beta.ppf(0.025, k, n - k + 1) if k > 0 else 0.0
    high = beta.ppf(0.975, k + 1, n - k) if k < n else 1.0
    return float(low), float(high)
""",
    ),
    (
        "12-paired",
        "order statistics found by walking up",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        n_good = 0
        for ea, eb in zip(a, b):
            if ea > limit or eb > limit:
                break
            n_good += 1
        if n_good:
            rms = [np.sqrt(np.sum(e[:n_good] ** 2) / n_good) for e in (a, b)]
            d.append(rms[0] - rms[1])
    d.sort()
    n, total, j = len(d), 0.0, 0
    while total + comb(n, j) / 2**n <= 0.025:
        total += comb(n, j) / 2**n
        j += 1
    return d[j - 1], d[n - j]
""",
    ),
    (
        "12-paired",
        "masks and the binomial of scipy",
        """
def compare(errors_a, errors_b, limit):
    from scipy.stats import binom
    ok = np.cumprod((errors_a <= limit) & (errors_b <= limit), axis=1).astype(bool)
    count = ok.sum(axis=1)
    use = count > 0
    rms_a = np.sqrt((errors_a**2 * ok).sum(axis=1)[use] / count[use])
    rms_b = np.sqrt((errors_b**2 * ok).sum(axis=1)[use] / count[use])
    d = np.sort(rms_a - rms_b)
    n = len(d)
    few = int(np.sum(binom.cdf(np.arange(n + 1), n, 0.5) <= 0.025))
    return d[few - 1], d[n - few]
""",
    ),
    (
        "12-relocalise",
        "hypotheses in a list, guesses made at every scan, log scores",
        """
def relocalise(start, motions, sights, posts):
    tracks = [(0.0, np.array(start, dtype=float))]
    result = []
    for told, seen in zip(motions, sights):
        best = max(s for s, _ in tracks)
        poses = corrected(compose(np.array([x for _, x in tracks]), told), seen, posts)
        scores = np.array([s for s, _ in tracks]) + fit(poses, seen, posts)
        if len(seen) >= 2:
            new = guesses(seen, posts)
            if len(new):
                f = fit(new, seen, posts)
                new = new[np.argsort(f)[-150:]]
                new = corrected(new, seen, posts)
                poses = np.vstack([poses, new])
                scores = np.concatenate([scores, best - 12 + fit(new, seen, posts)])
        tracks = []
        for i in np.argsort(-scores):
            far = [np.hypot(*(poses[i] - x)[:2]) > 0.15 or abs(wrap(poses[i] - x)[2]) > 0.2
                   for _, x in tracks]
            if all(far):
                tracks.append((scores[i], poses[i]))
            if len(tracks) == 25:
                break
        result.append(tracks[0][1])
    return np.array(result)
""",
    ),
    (
        "12-relocalise",
        "looks back: forward with hypotheses, then follows the winner's ancestors",
        """
def relocalise(start, motions, sights, posts):
    poses, scores = np.array([start], dtype=float), np.zeros(1)
    layers_, parents = [], []
    for told, seen in zip(motions, sights):
        moved = corrected(compose(poses, told), seen, posts)
        value = scores + fit(moved, seen, posts)
        parent = np.arange(len(moved))
        if len(seen) > 1:
            new = guesses(seen, posts)
            if len(new):
                new = new[np.argsort(-fit(new, seen, posts))[:100]]
                new = corrected(new, seen, posts)
                moved = np.vstack([moved, new])
                value = np.append(value, scores.max() - 13 + fit(new, seen, posts))
                parent = np.append(parent, np.full(len(new), np.argmax(scores)))
        order, keep, taken = np.argsort(-value), [], set()
        for i in order:
            cell = tuple(np.round(moved[i] / 0.2).astype(int))
            if cell not in taken:
                taken.add(cell)
                keep.append(i)
            if len(keep) == 30:
                break
        poses, scores = moved[keep], value[keep]
        layers_.append(poses)
        parents.append(parent[keep])
    track_back, i = [], int(np.argmax(scores))
    for layer, parent in zip(layers_[::-1], parents[::-1]):
        track_back.append(layer[i])
        i = parent[i]
    return np.array(track_back[::-1])
""",
    ),
]

WRONG = [
    (
        "12-odometry",
        "drives d straight along the new heading",
        """
def odometry(left, right, tick, base):
    l, r = left * tick, right * tick
    d, turn = (l + r) / 2, (r - l) / base
    return np.array([d * np.cos(turn), d * np.sin(turn), turn])
""",
    ),
    (
        "12-odometry",
        "length of the arc along half the turn, no chord",
        """
def odometry(left, right, tick, base):
    d = (left + right) / 2 * tick
    turn = (right - left) * tick / base
    return np.array([d * np.cos(turn / 2), d * np.sin(turn / 2), turn])
""",
    ),
    (
        "12-odometry",
        "0/0 when it drives straight on",
        """
def odometry(left, right, tick, base):
    l, r = left * tick, right * tick
    d, turn = (l + r) / 2, (r - l) / base
    chord = d * np.sin(turn / 2) / (turn / 2)
    return np.array([chord * np.cos(turn / 2), chord * np.sin(turn / 2), turn])
""",
    ),
    (
        "12-odometry",
        "small turns count as straight",
        """
def odometry(left, right, tick, base):
    l, r = left * tick, right * tick
    d, turn = (l + r) / 2, (r - l) / base
    if abs(turn) < 1e-2:
        return np.array([d, 0.0, 0.0])
    radius = d / turn
    return np.array([radius * np.sin(turn), radius * (1 - np.cos(turn)), turn])
""",
    ),
    (
        "12-odometry",
        "turns to the wrong side",
        """
def odometry(left, right, tick, base):
    l, r = left * tick, right * tick
    turn = (l - r) / base
    chord = (l + r) / 2 * np.sinc(turn / (2 * np.pi))
    return np.array([chord * np.cos(turn / 2), chord * np.sin(turn / 2), turn])
""",
    ),
    (
        "12-odometry",
        "half the base",
        """
def odometry(left, right, tick, base):
    d = tick * (left + right) / 2
    turn = tick * (right - left) / (base / 2)
    if turn == 0:
        return np.array([d, 0, 0])
    return np.array([d / turn * np.sin(turn), d / turn * (1 - np.cos(turn)), turn])
""",
    ),
    (
        "12-odometry",
        "np.sinc without the pi",
        """
def odometry(left, right, tick, base):
    d = (left + right) * tick / 2
    turn = (right - left) * tick / base
    chord = d * np.sinc(turn / 2)
    return np.array([chord * np.cos(turn / 2), chord * np.sin(turn / 2), turn])
""",
    ),
    (
        "12-odometry",
        "wraps the turn before the arc: wrong beyond half a round",
        """
def odometry(left, right, tick, base):
    d = (left + right) * tick / 2
    turn = float(wrap((right - left) * tick / base))
    chord = d * np.sinc(turn / 2 / np.pi)
    return np.array([chord * np.cos(turn / 2), chord * np.sin(turn / 2), turn])
""",
    ),
    (
        "12-odometry",
        "turn from ticks, not metres",
        """
def odometry(left, right, tick, base):
    d = (left + right) / 2 * tick
    turn = (right - left) / base
    chord = d * np.sinc(turn / (2 * np.pi))
    return np.array([chord * np.cos(turn / 2), chord * np.sin(turn / 2), turn])
""",
    ),
    (
        "12-odometry",
        "chord points along the whole turn",
        """
def odometry(left, right, tick, base):
    l, r = left * tick, right * tick
    turn = (r - l) / base
    half = turn / 2
    chord = (l + r) / 2 if turn == 0 else (l + r) / 2 * np.sin(half) / half
    return np.array([chord * np.cos(turn), chord * np.sin(turn), turn])
""",
    ),
    (
        "12-odometry",
        "sideways way has the wrong sign",
        """
def odometry(left, right, tick, base):
    l, r = left * tick, right * tick
    d, turn = (l + r) / 2, (r - l) / base
    if turn == 0:
        return np.array([d, 0.0, 0.0])
    R = d / turn
    return np.array([R * np.sin(turn), R * (np.cos(turn) - 1), turn])
""",
    ),
    (
        "12-odometry",
        "returns at once when a wheel stands still",
        """
def odometry(left, right, tick, base):
    if not left or not right:
        return np.zeros(3)
    l, r = left * tick, right * tick
    turn = (r - l) / base
    chord = (l + r) / 2 * np.sinc(turn / (2 * np.pi))
    return np.array([chord * np.cos(turn / 2), chord * np.sin(turn / 2), turn])
""",
    ),
    (
        "12-odometry",
        "ten little straight steps",
        """
def odometry(left, right, tick, base):
    x = y = theta = 0.0
    for _ in range(10):
        d = (left + right) * tick / 20
        theta += (right - left) * tick / base / 10
        x += d * np.cos(theta)
        y += d * np.sin(theta)
    return np.array([x, y, theta])
""",
    ),
    (
        "12-odometry",
        "rolling backwards taken as forwards",
        """
def odometry(left, right, tick, base):
    l, r = left * tick, right * tick
    d, turn = abs(l + r) / 2, (r - l) / base
    chord = d * np.sinc(turn / (2 * np.pi))
    return np.array([chord * np.cos(turn / 2), chord * np.sin(turn / 2), turn])
""",
    ),
    (
        "12-lost",
        "the first reading beyond the limit, ever",
        """
def lost_since(errors, limit):
    beyond = np.flatnonzero(errors > limit)
    return beyond[0] if len(beyond) and errors[-1] > limit else -1
""",
    ),
    (
        "12-lost",
        "an equal error counts as beyond",
        """
def lost_since(errors, limit):
    since = -1
    for k in range(len(errors))[::-1]:
        if errors[k] < limit:
            break
        since = k
    return since
""",
    ),
    (
        "12-lost",
        "last reading within instead of the one after",
        """
def lost_since(errors, limit):
    near = np.flatnonzero(errors <= limit)
    if len(near) == 0:
        return 0
    return near[-1] if near[-1] < len(errors) - 1 else -1
""",
    ),
    (
        "12-lost",
        "never within the limit: crashes",
        """
def lost_since(errors, limit):
    near = np.flatnonzero(errors <= limit)
    if near[-1] == len(errors) - 1:
        return -1
    return near[-1] + 1
""",
    ),
    (
        "12-lost",
        "never within the limit: says not lost",
        """
def lost_since(errors, limit):
    near = np.flatnonzero(errors <= limit)
    if len(near) == 0 or near[-1] == len(errors) - 1:
        return -1
    return near[-1] + 1
""",
    ),
    (
        "12-lost",
        "last excursion, although it came back",
        """
def lost_since(errors, limit):
    beyond = errors > limit
    starts = [k for k in range(len(errors)) if beyond[k] and (k == 0 or not beyond[k - 1])]
    return starts[-1] if starts else -1
""",
    ),
    (
        "12-lost",
        "argmax from behind: forgets the run that is lost from the start",
        """
def lost_since(errors, limit):
    if errors[-1] <= limit:
        return -1
    back = np.argmax(errors[::-1] <= limit)
    return len(errors) - back
""",
    ),
    (
        "12-lost",
        "counts from 1",
        """
def lost_since(errors, limit):
    k = len(errors)
    while k > 0 and errors[k - 1] > limit:
        k -= 1
    return k + 1 if k < len(errors) else -1
""",
    ),
    (
        "12-lost",
        "crossings by np.diff: none if it starts beyond",
        """
def lost_since(errors, limit):
    beyond = (errors > limit).astype(int)
    out = np.flatnonzero(np.diff(beyond) == 1) + 1
    return int(out[-1]) if beyond[-1] and len(out) else -1
""",
    ),
    (
        "12-lost",
        "not lost gives the length instead of -1",
        """
def lost_since(errors, limit):
    k = len(errors)
    while k and errors[k - 1] > limit:
        k -= 1
    return k
""",
    ),
    (
        "12-lost",
        "loop leaves out the last reading",
        """
def lost_since(errors, limit):
    since = -1
    for k in range(len(errors) - 1):
        if errors[k] > limit and since < 0:
            since = k
        elif errors[k] <= limit:
            since = -1
    return since
""",
    ),
    (
        "12-lost",
        "subtracts the limit in place",
        """
def lost_since(errors, limit):
    errors -= limit
    near = np.flatnonzero(errors <= 0)
    last = near[-1] if len(near) else -1
    return last + 1 if last + 1 < len(errors) else -1
""",
    ),
    (
        "12-lost",
        "start of the longest excursion",
        """
def lost_since(errors, limit):
    best, best_at, run = 0, -1, 0
    for k, e in enumerate(errors):
        run = run + 1 if e > limit else 0
        if run > best:
            best, best_at = run, k - run + 1
    return best_at if errors[-1] > limit else -1
""",
    ),
    (
        "12-lost",
        "returns True or False",
        """
def lost_since(errors, limit):
    return bool(errors[-1] > limit)
""",
    ),
    (
        "12-interval",
        "Wald: k/n plus and minus",
        """
def interval(k, n):
    p = k / n
    s = np.sqrt(p * (1 - p) / n)
    return p - 1.96 * s, p + 1.96 * s
""",
    ),
    (
        "12-interval",
        "Wald, clipped to 0..1",
        """
def interval(k, n):
    p = k / n
    half = 1.96 * (p * (1 - p) / n) ** 0.5
    return max(0.0, p - half), min(1.0, p + half)
""",
    ),
    (
        "12-interval",
        "upper end first",
        """
def interval(k, n):
    z = 1.96
    middle = (k / n + z**2 / (2 * n)) / (1 + z**2 / n)
    half = z * np.sqrt(k / n * (1 - k / n) / n + z**2 / (4 * n**2)) / (1 + z**2 / n)
    return min(middle + half, 1.0), max(middle - half, 0.0)
""",
    ),
    (
        "12-interval",
        "z of a one-sided 95 %",
        """
def interval(k, n):
    z, p = 1.645, k / n
    a, b, c = 1 + z**2 / n, 2 * p + z**2 / n, p**2
    root = np.sqrt(b**2 - 4 * a * c)
    return max((b - root) / (2 * a), 0.0), min((b + root) / (2 * a), 1.0)
""",
    ),
    (
        "12-interval",
        "half width not divided by 1 + z²/n",
        """
def interval(k, n):
    z, p = 1.96, k / n
    middle = (p + z**2 / (2 * n)) / (1 + z**2 / n)
    half = z * np.sqrt(p * (1 - p) / n + z**2 / (4 * n**2))
    return max(middle - half, 0), min(middle + half, 1)
""",
    ),
    (
        "12-interval",
        "no shift of the middle",
        """
def interval(k, n):
    z, p = 1.96, k / n
    half = z * np.sqrt(p * (1 - p) / n + z**2 / (4 * n**2)) / (1 + z**2 / n)
    return max(p - half, 0.0), min(p + half, 1.0)
""",
    ),
    (
        "12-interval",
        "z instead of z² in the inequality",
        """
def interval(k, n):
    z, p = 1.96, k / n
    a, b, c = 1 + z / n, -(2 * p + z / n), p * p
    root = np.sqrt(b * b - 4 * a * c)
    return (-b - root) / (2 * a), (-b + root) / (2 * a)
""",
    ),
    (
        "12-interval",
        "nothing lost: says 0 to 0; all lost: 1 to 1",
        """
def interval(k, n):
    if k == 0:
        return 0.0, 0.0
    if k == n:
        return 1.0, 1.0
    z = 1.96
    middle = (k + z**2 / 2) / (n + z**2)
    half = z / (n + z**2) * np.sqrt(k * (n - k) / n + z**2 / 4)
    return middle - half, middle + half
""",
    ),
    (
        "12-interval",
        "Clopper-Pearson with 5 % on each side",
        """
def interval(k, n):
    from scipy.stats import beta
    low = beta.ppf(0.05, k, n - k + 1) if k else 0.0
    high = beta.ppf(0.95, k + 1, n - k) if k < n else 1.0
    return low, high
""",
    ),
    (
        "12-interval",
        "Clopper-Pearson, nan at k = 0 and k = n",
        """
def interval(k, n):
    from scipy.stats import beta
    return beta.ppf(0.025, k, n - k + 1), beta.ppf(0.975, k + 1, n - k)
""",
    ),
    (
        "12-interval",
        "tries a grid of whole per cents: too coarse for many runs",
        """
def interval(k, n):
    possible = [p / 100 for p in range(101) if (k / n - p / 100) ** 2 <= 1.96**2 * p / 100 * (1 - p / 100) / n]
    return min(possible), max(possible)
""",
    ),
    (
        "12-interval",
        "whole-number division",
        """
def interval(k, n):
    z = 1.96
    p = k // n
    middle = (p + z**2 / (2 * n)) / (1 + z**2 / n)
    half = z * np.sqrt(p * (1 - p) / n + z**2 / (4 * n**2)) / (1 + z**2 / n)
    return max(middle - half, 0.0), min(middle + half, 1.0)
""",
    ),
    (
        "12-interval",
        "bootstrap: of none lost it draws none lost",
        """
def interval(k, n):
    rng = np.random.default_rng(0)
    shares = rng.binomial(n, k / n, 2000) / n
    low, high = np.quantile(shares, [0.025, 0.975])
    return low, high
""",
    ),
    (
        "12-interval",
        "binomial sums with powers: overflows for many runs",
        """
def interval(k, n):
    def at_most(j, p):
        return sum(comb(n, i) * p**i * (1 - p) ** (n - i) for i in range(j + 1))

    def solve(f):
        a, b = 0.0, 1.0
        for _ in range(50):
            m = (a + b) / 2
            a, b = (m, b) if f(m) else (a, m)
        return a

    low = 0.0 if k == 0 else solve(lambda p: 1 - at_most(k - 1, p) < 0.025)
    high = 1.0 if k == n else solve(lambda p: at_most(k, p) > 0.025)
    return low, high
""",
    ),
    (
        "12-interval",
        "per cents",
        """
def interval(k, n):
    z = 1.96
    middle = (k / n + z**2 / (2 * n)) / (1 + z**2 / n)
    half = z * np.sqrt(k / n * (1 - k / n) / n + z**2 / (4 * n**2)) / (1 + z**2 / n)
    return 100 * max(middle - half, 0.0), 100 * min(middle + half, 1.0)
""",
    ),
    (
        "12-paired",
        "mean and t-like interval instead of the median",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        end = bad[0] if len(bad) else len(a)
        if end:
            d.append(np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2)))
    d = np.array(d)
    half = 1.96 * d.std(ddof=1) / np.sqrt(len(d))
    return d.mean() - half, d.mean() + half
""",
    ),
    (
        "12-paired",
        "the straying reading is counted too",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        end = bad[0] + 1 if len(bad) else len(a)
        if end > 1 or not len(bad):
            d.append(np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2)))
    d, n = np.sort(d), len(d)
    few = np.sum(np.cumsum([comb(n, k) / 2**n for k in range(n + 1)]) <= 0.025)
    return d[few - 1], d[n - few]
""",
    ),
    (
        "12-paired",
        "an error equal to the limit strays",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        ok = (a < limit) & (b < limit)
        end = len(a) if ok.all() else np.argmin(ok)
        if end:
            d.append(np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2)))
    d, n = np.sort(d), len(d)
    few = np.sum(np.cumsum([comb(n, k) / 2**n for k in range(n + 1)]) <= 0.025)
    return d[few - 1], d[n - few]
""",
    ),
    (
        "12-paired",
        "each filter up to its own first straying",
        """
def compare(errors_a, errors_b, limit):
    def rms(e):
        bad = np.flatnonzero(e > limit)
        end = bad[0] if len(bad) else len(e)
        return np.sqrt(np.mean(e[:end] ** 2)) if end else np.nan

    d = np.array([rms(a) - rms(b) for a, b in zip(errors_a, errors_b)])
    d = np.sort(d[~np.isnan(d)])
    n = len(d)
    few = np.sum(np.cumsum([comb(n, k) / 2**n for k in range(n + 1)]) <= 0.025)
    return d[few - 1], d[n - few]
""",
    ),
    (
        "12-paired",
        "drives without a reading count as difference 0",
        """
def compare(errors_a, errors_b, limit):
    d = np.zeros(len(errors_a))
    for i, (a, b) in enumerate(zip(errors_a, errors_b)):
        bad = np.flatnonzero((a > limit) | (b > limit))
        end = bad[0] if len(bad) else len(a)
        if end > 0:
            d[i] = np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2))
    d, n = np.sort(d), len(d)
    few = np.sum(np.cumsum([comb(n, k) / 2**n for k in range(n + 1)]) <= 0.025)
    return d[few - 1], d[n - few]
""",
    ),
    (
        "12-paired",
        "B less A",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero(np.maximum(a, b) > limit)
        end = bad[0] if bad.size else a.size
        if end:
            d.append(np.sqrt(np.mean(b[:end] ** 2)) - np.sqrt(np.mean(a[:end] ** 2)))
    d, n = np.sort(d), len(d)
    few = np.sum(np.cumsum([comb(n, k) / 2**n for k in range(n + 1)]) <= 0.025)
    return d[few - 1], d[n - few]
""",
    ),
    (
        "12-paired",
        "quantiles of the differences: how they scatter, not how sure the median is",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        end = bad[0] if len(bad) else len(a)
        if end:
            d.append(np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2)))
    return tuple(np.quantile(d, [0.025, 0.975]))
""",
    ),
    (
        "12-paired",
        "one order statistic too far in",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        end = bad[0] if len(bad) else len(a)
        if end:
            d.append(np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2)))
    d, n, total = sorted(d), len(d), 0
    for k in range(n):
        total += comb(n, k) / 2**n
        if total > 0.025:
            return d[k], d[n - 1 - k]
""",
    ),
    (
        "12-paired",
        "5 % on either side",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        end = bad[0] if len(bad) else len(a)
        if end:
            d.append(np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2)))
    d, n = np.sort(d), len(d)
    few = np.sum(np.cumsum([comb(n, k) / 2**n for k in range(n + 1)]) <= 0.05)
    return d[few - 1], d[n - few]
""",
    ),
    (
        "12-paired",
        "mean error instead of RMS",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        end = bad[0] if len(bad) else len(a)
        if end:
            d.append(np.mean(a[:end]) - np.mean(b[:end]))
    d, n = np.sort(d), len(d)
    few = np.sum(np.cumsum([comb(n, k) / 2**n for k in range(n + 1)]) <= 0.025)
    return d[few - 1], d[n - few]
""",
    ),
    (
        "12-paired",
        "readings after coming back count again",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        ok = (a <= limit) & (b <= limit)
        if ok[0]:
            d.append(np.sqrt(np.mean(a[ok] ** 2)) - np.sqrt(np.mean(b[ok] ** 2)))
    d, n = np.sort(d), len(d)
    few = np.sum(np.cumsum([comb(n, k) / 2**n for k in range(n + 1)]) <= 0.025)
    return d[few - 1], d[n - few]
""",
    ),
    (
        "12-paired",
        "RMS of the difference of the errors",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        end = bad[0] if len(bad) else len(a)
        if end:
            d.append(np.sqrt(np.mean((a[:end] - b[:end]) ** 2)))
    d, n = np.sort(d), len(d)
    few = np.sum(np.cumsum([comb(n, k) / 2**n for k in range(n + 1)]) <= 0.025)
    return d[few - 1], d[n - few]
""",
    ),
    (
        "12-paired",
        "normal approximation of the coins, rounded",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        end = bad[0] if len(bad) else len(a)
        if end:
            d.append(np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2)))
    d, n = np.sort(d), len(d)
    j = max(int(round(n / 2 - 1.96 * np.sqrt(n) / 2)), 0)
    return d[j], d[n - 1 - j]
""",
    ),
    (
        "12-paired",
        "marks what comes after straying as nan in the caller's arrays",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        if len(bad):
            a[bad[0]:] = np.nan
            b[bad[0]:] = np.nan
            if bad[0] == 0:
                continue
        d.append(np.sqrt(np.nanmean(a**2)) - np.sqrt(np.nanmean(b**2)))
    d, n = np.sort(d), len(d)
    few = np.sum(np.cumsum([comb(n, k) / 2**n for k in range(n + 1)]) <= 0.025)
    return d[few - 1], d[n - few]
""",
    ),
    (
        "12-paired",
        "coins of all drives, also those left out",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        end = bad[0] if len(bad) else len(a)
        if end:
            d.append(np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2)))
    n = len(errors_a)
    few = np.sum(np.cumsum([comb(n, k) / 2**n for k in range(n + 1)]) <= 0.025)
    d = np.sort(d)
    return d[few - 1], d[-few]
""",
    ),
    (
        "12-paired",
        "forgets to sort",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        end = bad[0] if len(bad) else len(a)
        if end:
            d.append(np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2)))
    n = len(d)
    few = np.sum(np.cumsum([comb(n, k) / 2**n for k in range(n + 1)]) <= 0.025)
    return min(d[few - 1], d[n - few]), max(d[few - 1], d[n - few])
""",
    ),
    (
        "12-relocalise",
        "the usual filter",
        """
def relocalise(start, motions, sights, posts):
    return track(start, motions, sights, posts)
""",
    ),
    (
        "12-relocalise",
        "dead reckoning",
        """
def relocalise(start, motions, sights, posts):
    pose, found = start, []
    for told in motions:
        pose = compose(pose, told)
        found.append(pose)
    return np.array(found)
""",
    ),
    (
        "12-relocalise",
        "always the pose that fits this scan best, no memory",
        """
def relocalise(start, motions, sights, posts):
    pose, found = start, []
    for told, seen in zip(motions, sights):
        pose = compose(pose, told)
        if len(seen) >= 2:
            many = guesses(seen, posts)
            if len(many):
                many = corrected(many, seen, posts)
                pose = many[np.argmax(fit(many, seen, posts))]
        found.append(pose)
    return np.array(found)
""",
    ),
    (
        "12-relocalise",
        "jumps to the best guess at the first scan that fits badly, one pose only",
        """
def relocalise(start, motions, sights, posts):
    pose, found = start[None], []
    for told, seen in zip(motions, sights):
        pose = corrected(compose(pose, told), seen, posts)
        if len(seen) >= 2 and fit(pose, seen, posts)[0] < -1.0 * len(seen):
            many = guesses(seen, posts)
            if len(many):
                pose = many[[np.argmax(fit(many, seen, posts))]]
        found.append(pose[0])
    return np.array(found)
""",
    ),
    (
        "12-relocalise",
        "hypotheses of one scan only, and the old pose thrown away at the first odd scan",
        """
def relocalise(start, motions, sights, posts):
    poses, scores, found = start[None], np.zeros(1), []
    for told, seen in zip(motions, sights):
        poses = corrected(compose(poses, told), seen, posts)
        scores = scores + fit(poses, seen, posts)
        if len(seen) > 2 and fit(poses, seen, posts).max() < -4.0:
            poses = guesses(seen, posts)
            scores = fit(poses, seen, posts)
        found.append(poses[np.argmax(scores)])
    return np.array(found)
""",
    ),
    (
        "12-relocalise",
        "a scan with fewer than two sights is left out: too few poses come back",
        """
def relocalise(start, motions, sights, posts):
    poses, scores, found = start[None], np.zeros(1), []
    for told, seen in zip(motions, sights):
        poses = compose(poses, told)
        if len(seen) < 2:
            continue
        new = guesses(seen, posts)
        scores = np.append(scores, np.full(len(new), scores.max() - 12))
        poses = corrected(np.vstack([poses, new]), seen, posts)
        scores = scores + fit(poses, seen, posts)
        best = np.argsort(-scores)[:60]
        poses, scores = poses[best], scores[best]
        found.append(poses[0])
    return np.array(found)
""",
    ),
    (
        "12-relocalise",
        "motion composed the wrong way round",
        """
def relocalise(start, motions, sights, posts):
    poses, scores, found = start[None], np.zeros(1), []
    for told, seen in zip(motions, sights):
        poses = corrected(compose(told, poses), seen, posts)
        best = scores.max()
        scores = scores + fit(poses, seen, posts)
        if len(seen) >= 2:
            new = guesses(seen, posts)
            new = corrected(new, seen, posts)
            poses = np.vstack([poses, new])
            scores = np.append(scores, best - 12 + fit(new, seen, posts))
        keep = np.argsort(-scores)[:60]
        poses, scores = poses[keep], scores[keep]
        found.append(poses[0])
    return np.array(found)
""",
    ),
    (
        "12-relocalise",
        "a random cloud round the last pose, best fit wins",
        """
def relocalise(start, motions, sights, posts):
    rng = np.random.default_rng(0)
    pose, found = start, []
    for told, seen in zip(motions, sights):
        cloud = compose(pose, told) + rng.normal(0, [0.3, 0.3, 0.2], (300, 3))
        if len(seen):
            cloud = corrected(cloud, seen, posts)
            pose = cloud[np.argmax(fit(cloud, seen, posts))]
        else:
            pose = compose(pose, told)
        found.append(pose)
    return np.array(found)
""",
    ),
    (
        "12-relocalise",
        "new poses cost nothing: it jumps between the bays",
        """
def relocalise(start, motions, sights, posts):
    poses, scores, found = start[None], np.zeros(1), []
    for told, seen in zip(motions, sights):
        poses = corrected(compose(poses, told), seen, posts)
        if len(seen) >= 2:
            poses = np.vstack([poses, guesses(seen, posts)])
        scores = fit(poses, seen, posts)
        keep = np.argsort(-scores, kind="stable")[:50][::-1]
        poses = poses[keep]
        found.append(poses[-1])
    return np.array(found)
""",
    ),
    (
        "12-relocalise",
        "does not move the other hypotheses",
        """
def relocalise(start, motions, sights, posts):
    pose, others, scores, found = start[None], np.zeros((0, 3)), np.zeros(0), []
    own = 0.0
    for told, seen in zip(motions, sights):
        pose = corrected(compose(pose, told), seen, posts)
        own += fit(pose, seen, posts)[0]
        if len(seen) >= 2:
            new = guesses(seen, posts)
            others = np.vstack([others, new])
            scores = np.append(scores, np.full(len(new), own - 15.0))
        scores = scores + fit(others, seen, posts)
        if len(scores) and scores.max() > own:
            pose, own = others[[np.argmax(scores)]], scores.max()
        found.append(pose[0])
    return np.array(found)
""",
    ),
    (
        "12-relocalise",
        "middle of the hall, constant",
        """
def relocalise(start, motions, sights, posts):
    return np.tile([6.0, 2.0, 0.0], (len(motions), 1))
""",
    ),
    (
        "12-relocalise",
        "returns the start as well: one pose too many",
        """
def relocalise(start, motions, sights, posts):
    found = [start]
    for told, seen in zip(motions, sights):
        pose = corrected(compose(found[-1][None], told), seen, posts)
        found.append(pose[0])
    return np.array(found)
""",
    ),
    (
        "12-relocalise",
        "searches along the hall only by whole bays, same heading",
        """
def relocalise(start, motions, sights, posts):
    pose, found = start[None], []
    for told, seen in zip(motions, sights):
        pose = compose(pose, told)
        three = np.vstack([pose + [dx, 0, 0] for dx in (0, 4, -4)])
        three = corrected(three, seen, posts)
        pose = three[[np.argmax(fit(three, seen, posts))]]
        found.append(pose[0])
    return np.array(found)
""",
    ),
    (
        "12-relocalise",
        "moves the caller's start along",
        """
def relocalise(start, motions, sights, posts):
    found = []
    for told, seen in zip(motions, sights):
        start[:] = corrected(compose(start, told)[None], seen, posts)[0]
        found.append(start.copy())
    return np.array(found)
""",
    ),
]
