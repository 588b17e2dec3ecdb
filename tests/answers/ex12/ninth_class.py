"""A ninth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "12-odometry",
        "arc by its radius where the turn is large, Taylor series of sin and 1 - cos over the turn where it is small",
        """
def odometry(left, right, tick, base):
    sl, sr = left * tick, right * tick
    d, a = (sl + sr) / 2, (sr - sl) / base
    if abs(a) > 1e-2:
        return np.array([d / a * np.sin(a), 2 * d / a * np.sin(a / 2) ** 2, a])
    x = d * (1 - a**2 / 6 + a**4 / 120)
    y = d * (a / 2 - a**3 / 24 + a**5 / 720)
    return np.array([x, y, a])
""",
    ),
    (
        "12-lost",
        "walks back from the end while the error is beyond the limit",
        """
def lost_since(errors, limit):
    k = len(errors)
    while k > 0 and errors[k - 1] > limit:
        k -= 1
    return k if k < len(errors) else -1
""",
    ),
    (
        "12-interval",
        "roots of the quadratic a p^2 + b p + c, the far one first and the other by Vieta",
        """
def interval(k, n):
    k, n = float(k), float(n)
    z2 = 1.96**2
    a, b, c = 1 + z2 / n, -(2 * k / n + z2 / n), (k / n) ** 2
    root = max(b * b - 4 * a * c, 0.0) ** 0.5
    high = (-b + root) / (2 * a)
    low = c / (a * high)
    return max(0.0, low), min(1.0, high)
""",
    ),
]

WRONG = [
    (
        "12-odometry",
        "divides by the turn (radius of the arc): fails or gives nan where both wheels roll alike",
        """
def odometry(left, right, tick, base):
    sl, sr = left * tick, right * tick
    turn = (sr - sl) / base
    r = (sl + sr) / 2 / turn
    return np.array([r * np.sin(turn), r * (1 - np.cos(turn)), turn])
""",
    ),
    (
        "12-odometry",
        "drives the whole arc straight along the heading at the start (no half turn, no chord)",
        """
def odometry(left, right, tick, base):
    d = (left + right) * tick / 2
    return np.array([d, 0.0, (right - left) * tick / base])
""",
    ),
    (
        "12-odometry",
        "arc length instead of the chord: the half turn is there, the shortening by the sine is not",
        """
def odometry(left, right, tick, base):
    s_left, s_right = tick * left, tick * right
    way = 0.5 * (s_left + s_right)
    theta = (s_right - s_left) / base
    return np.array([way * np.cos(theta / 2), way * np.sin(theta / 2), theta])
""",
    ),
    (
        "12-odometry",
        "np.sinc is taken for sin(x)/x: the factor pi in its argument is forgotten",
        """
def odometry(left, right, tick, base):
    l, r = left * tick, right * tick
    turn = (r - l) / base
    chord = (l + r) / 2 * np.sinc(turn / 2)
    return np.array([chord * np.cos(turn / 2), chord * np.sin(turn / 2), turn])
""",
    ),
    (
        "12-odometry",
        "straight on already for turns below 0.01 rad: a few ticks of difference lose their sideways motion and their turn",
        """
def odometry(left, right, tick, base):
    sl, sr = left * tick, right * tick
    turn, d = (sr - sl) / base, (sl + sr) / 2
    if abs(turn) < 0.01:
        return np.array([d, 0.0, 0.0])
    radius = d / turn
    return np.array([radius * np.sin(turn), radius * (1 - np.cos(turn)), turn])
""",
    ),
    (
        "12-odometry",
        "turn is left minus right: the robot turns the wrong way",
        """
def odometry(left, right, tick, base):
    sl, sr = left * tick, right * tick
    turn = (sl - sr) / base
    chord = (sl + sr) / 2 * np.sinc(turn / (2 * np.pi))
    return np.array([chord * np.cos(turn / 2), chord * np.sin(turn / 2), turn])
""",
    ),
    (
        "12-odometry",
        "the end points along the whole turn instead of half of it",
        """
def odometry(left, right, tick, base):
    d = (left + right) * tick / 2
    a = (right - left) * tick / base
    chord = d if a == 0 else 2 * d / a * np.sin(a / 2)
    return np.array([chord * np.cos(a), chord * np.sin(a), a])
""",
    ),
    (
        "12-odometry",
        "integrates the arc in a hundred straight pieces along the heading at the start of each: a little off",
        """
def odometry(left, right, tick, base):
    n = 100
    d = (left + right) * tick / 2 / n
    a = (right - left) * tick / base / n
    x = y = th = 0.0
    for _ in range(n):
        x += d * np.cos(th)
        y += d * np.sin(th)
        th += a
    return np.array([x, y, th])
""",
    ),
    (
        "12-lost",
        "the first reading beyond the limit at all, although the run came back afterwards",
        """
def lost_since(errors, limit):
    beyond = np.asarray(errors) > limit
    if not beyond[-1]:
        return -1
    return int(np.argmax(beyond))
""",
    ),
    (
        "12-lost",
        "an error that equals the limit counts as beyond it",
        """
def lost_since(errors, limit):
    k = len(errors)
    while k > 0 and errors[k - 1] >= limit:
        k -= 1
    return k if k < len(errors) else -1
""",
    ),
    (
        "12-lost",
        "returns the last reading within the limit instead of the one after it",
        """
def lost_since(errors, limit):
    within = [k for k, e in enumerate(errors) if e <= limit]
    if not within:
        return 0
    return -1 if within[-1] == len(errors) - 1 else within[-1]
""",
    ),
    (
        "12-lost",
        "fails (index of an empty array) where the run is beyond the limit from the first reading on",
        """
def lost_since(errors, limit):
    if errors[-1] <= limit:
        return -1
    return np.flatnonzero(errors <= limit)[-1] + 1
""",
    ),
    (
        "12-lost",
        "a run that is never within the limit gives -1 instead of 0",
        """
def lost_since(errors, limit):
    since = -1
    for k in range(1, len(errors)):
        if errors[k] > limit and errors[k - 1] <= limit:
            since = k
        if errors[k] <= limit:
            since = -1
    return since
""",
    ),
    (
        "12-lost",
        "counts from the end: the length of the last stretch beyond the limit is returned, not where it begins",
        """
def lost_since(errors, limit):
    length = 0
    for e in errors[::-1]:
        if e <= limit:
            break
        length += 1
    return length if length else -1
""",
    ),
    (
        "12-interval",
        "the plain interval k/n +- 1.96 sqrt(s (1-s) / n): no width at 0 of n or n of n",
        """
def interval(k, n):
    s = k / n
    half = 1.96 * np.sqrt(s * (1 - s) / n)
    return max(0.0, s - half), min(1.0, s + half)
""",
    ),
    (
        "12-interval",
        "the square of 1.96 is forgotten in the quadratic",
        """
def interval(k, n):
    z = 1.96
    a = 1 + z / n
    b = -(2 * k / n + z / n)
    c = (k / n) ** 2
    root = np.sqrt(b * b - 4 * a * c)
    return (-b - root) / (2 * a), (-b + root) / (2 * a)
""",
    ),
    (
        "12-interval",
        "the share is taken as the middle of the interval: the middle is not pulled towards one half",
        """
def interval(k, n):
    z, s = 1.96, k / n
    half = z / (1 + z**2 / n) * np.sqrt(s * (1 - s) / n + z**2 / (4 * n**2))
    return max(s - half, 0.0), min(s + half, 1.0)
""",
    ),
    (
        "12-interval",
        "a grid of a thousand p is tried: the ends are off by up to a thousandth, too coarse for large n",
        """
def interval(k, n):
    p = np.linspace(0, 1, 1001)
    good = p[(k / n - p) ** 2 <= 1.96**2 * p * (1 - p) / n]
    if len(good) == 0:
        return k / n, k / n
    return good[0], good[-1]
""",
    ),
    (
        "12-interval",
        "one-sided z of 1.645 instead of 1.96: an interval of 90 %",
        """
def interval(k, n):
    z = 1.645
    m = (k + z * z / 2) / (n + z * z)
    half = z / (n + z * z) * np.sqrt(k * (n - k) / n + z * z / 4)
    return max(0.0, m - half), min(1.0, m + half)
""",
    ),
    (
        "12-interval",
        "the root's term z^2/(4 n^2) is written as z^2/(4 n)",
        """
def interval(k, n):
    z, s = 1.96, k / n
    den = 1 + z**2 / n
    mid = (s + z**2 / (2 * n)) / den
    half = z * np.sqrt(s * (1 - s) / n + z**2 / (4 * n)) / den
    return max(mid - half, 0.0), min(mid + half, 1.0)
""",
    ),
    (
        "12-paired",
        "each filter is cut where it strays itself: the two are compared over different readings",
        """
def compare(errors_a, errors_b, limit):
    def rms(run):
        beyond = np.flatnonzero(run > limit)
        end = beyond[0] if len(beyond) else len(run)
        return np.sqrt(np.mean(run[:end] ** 2)) if end else None

    d = []
    for a, b in zip(errors_a, errors_b):
        x, y = rms(a), rms(b)
        if x is not None and y is not None:
            d.append(x - y)
    d = np.sort(d)
    n = len(d)
    tail, few = 0.0, 0
    for k in range(n):
        tail += comb(n, k) / 2**n
        if tail > 0.025:
            break
        few += 1
    return d[few - 1], d[n - few]
""",
    ),
    (
        "12-paired",
        "readings that are within the limit count again after the first one beyond it",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        ok = (a <= limit) & (b <= limit)
        if ok[0]:
            d.append(np.sqrt(np.mean(a[ok] ** 2)) - np.sqrt(np.mean(b[ok] ** 2)))
    d, n = np.sort(d), len(d)
    chances = np.cumsum([comb(n, k) / 2**n for k in range(n + 1)])
    few = int(np.sum(chances <= 0.025))
    return d[few - 1], d[n - few]
""",
    ),
    (
        "12-paired",
        "the reading at which one is first beyond the limit is counted, too",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        if len(bad) and bad[0] == 0:
            continue
        end = bad[0] + 1 if len(bad) else len(a)
        d.append(np.sqrt((a[:end] ** 2).mean()) - np.sqrt((b[:end] ** 2).mean()))
    d, n = np.sort(d), len(d)
    chances = np.cumsum([comb(n, k) / 2**n for k in range(n + 1)])
    few = np.sum(chances <= 0.025)
    return d[few - 1], d[n - few]
""",
    ),
    (
        "12-paired",
        "the ends lie one difference too far inside: d[few] and d[n - 1 - few]",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        end = 0
        while end < len(a) and a[end] <= limit and b[end] <= limit:
            end += 1
        if end:
            d.append(np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2)))
    d.sort()
    n, tail, few = len(d), 0.0, 0
    while tail + comb(n, few) / 2**n <= 0.025:
        tail += comb(n, few) / 2**n
        few += 1
    return d[few], d[n - 1 - few]
""",
    ),
    (
        "12-paired",
        "5 % instead of 2.5 % on each side: the interval is too narrow",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b, strict=True):
        strayed = np.flatnonzero((a > limit) | (b > limit))
        end = strayed[0] if len(strayed) else len(a)
        if end > 0:
            d.append(np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2)))
    d, n = np.sort(d), len(d)
    chances = np.cumsum([comb(n, k) / 2**n for k in range(n + 1)])
    few = np.sum(chances <= 0.05)
    return d[few - 1], d[n - few]
""",
    ),
    (
        "12-paired",
        "mean difference plus and minus 1.96 standard errors: an interval of the mean, not of the median",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero(np.maximum(a, b) > limit)
        end = bad[0] if bad.size else a.size
        if end:
            d.append(np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2)))
    d = np.array(d)
    half = 1.96 * d.std(ddof=1) / np.sqrt(len(d))
    return d.mean() - half, d.mean() + half
""",
    ),
    (
        "12-paired",
        "mean of the errors instead of their root mean square",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        strayed = np.flatnonzero((a > limit) | (b > limit))
        end = strayed[0] if len(strayed) else len(a)
        if end > 0:
            d.append(np.mean(a[:end]) - np.mean(b[:end]))
    d, n = np.sort(d), len(d)
    chances = np.cumsum([comb(n, k) / 2**n for k in range(n + 1)])
    few = np.sum(chances <= 0.025)
    return d[few - 1], d[n - few]
""",
    ),
    (
        "12-relocalise",
        "the ready filter track as it is: it never notices the lift",
        """
def relocalise(start, motions, sights, posts):
    return track(start, motions, sights, posts)
""",
    ),
    (
        "12-relocalise",
        "jumps at once to the best guess whenever the present scan fits badly, and keeps one pose only: phantoms and like bays lead it astray",
        """
def relocalise(start, motions, sights, posts):
    pose, found = start[None], []
    for told, seen in zip(motions, sights):
        pose = corrected(compose(pose, told), seen, posts)
        if len(seen) > 1 and fit(pose, seen, posts)[0] < -len(seen):
            others = guesses(seen, posts)
            if len(others):
                pose = others[[np.argmax(fit(others, seen, posts))]]
        found.append(pose[0])
    return np.array(found)
""",
    ),
    (
        "12-relocalise",
        "in every scan the best of all guesses, without motion or memory: the bay is thrown anew each time",
        """
def relocalise(start, motions, sights, posts):
    pose, found = np.array(start), []
    for told, seen in zip(motions, sights):
        pose = compose(pose, told)
        others = guesses(seen, posts) if len(seen) > 1 else np.zeros((0, 3))
        if len(others):
            pose = others[np.argmax(fit(others, seen, posts))]
        found.append(pose)
    return np.array(found)
""",
    ),
    (
        "12-relocalise",
        "twenty random poses in the hall besides the tracked one, and the best by the last scan alone: too few to hit a pose",
        """
def relocalise(start, motions, sights, posts):
    rng = np.random.default_rng(0)
    poses, found = start[None], []
    for told, seen in zip(motions, sights):
        poses = compose(poses, told)
        extra = np.column_stack([rng.uniform(0, 12, 20), rng.uniform(0, 4, 20), rng.uniform(-np.pi, np.pi, 20)])
        poses = corrected(np.concatenate([poses, extra]), seen, posts)
        order = np.argsort(-fit(poses, seen, posts))
        poses = poses[order[:20]]
        found.append(poses[0])
    return np.array(found)
""",
    ),
    (
        "12-relocalise",
        "only the wheels: neither scans nor the lift are taken in",
        """
def relocalise(start, motions, sights, posts):
    found = [start]
    for told in motions:
        found.append(compose(found[-1], told))
    return np.array(found[1:])
""",
    ),
]
