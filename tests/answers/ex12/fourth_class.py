"""A fourth class of answers, written from the lesson and the exercise's text alone."""

RIGHT = [
    (
        "12-lost",
        "backwards with a counter",
        """
def lost_since(errors, limit):
    since = -1
    for k in range(len(errors) - 1, -1, -1):
        if errors[k] > limit:
            since = k
        else:
            break
    return since
""",
    ),
    (
        "12-odometry",
        "a chord by sinc",
        """
def odometry(left, right, tick, base):
    d, turn = tick * (left + right) / 2, tick * (right - left) / base
    chord = d * np.sinc(turn / 2 / np.pi)
    return chord * np.cos(turn / 2), chord * np.sin(turn / 2), turn
""",
    ),
]

WRONG = [
    (
        "12-odometry",
        "straight ahead, then turned",
        """
def odometry(left, right, tick, base):
    d, turn = tick * (left + right) / 2, tick * (right - left) / base
    return np.array([d, 0, turn])
""",
    ),
    (
        "12-odometry",
        "small turns counted as none",
        """
def odometry(left, right, tick, base):
    d, turn = tick * (left + right) / 2, tick * (right - left) / base
    if abs(turn) < 0.01:
        return np.array([d, 0, 0])
    r = d / turn
    return np.array([r * np.sin(turn), r * (1 - np.cos(turn)), turn])
""",
    ),
    (
        "12-odometry",
        "arc in place of chord, along half the turn",
        """
def odometry(left, right, tick, base):
    d, turn = tick * (left + right) / 2, tick * (right - left) / base
    return np.array([d * np.cos(turn / 2), d * np.sin(turn / 2), turn])
""",
    ),
    (
        "12-odometry",
        "divides by zero on the straight",
        """
def odometry(left, right, tick, base):
    sl, sr = left * tick, right * tick
    turn = (sr - sl) / base
    r = base / 2 * (sl + sr) / (sr - sl)
    return np.array([r * np.sin(turn), r * (1 - np.cos(turn)), turn])
""",
    ),
    (
        "12-odometry",
        "left less right",
        """
def odometry(left, right, tick, base):
    d, turn = tick * (left + right) / 2, tick * (left - right) / base
    chord = d * np.sinc(turn / 2 / np.pi)
    return np.array([chord * np.cos(turn / 2), chord * np.sin(turn / 2), turn])
""",
    ),
    (
        "12-lost",
        "the first reading beyond, if the last is",
        """
def lost_since(errors, limit):
    if errors[-1] <= limit:
        return -1
    return int(np.argmax(errors > limit))
""",
    ),
    (
        "12-lost",
        "the last reading that was good",
        """
def lost_since(errors, limit):
    good = np.flatnonzero(errors <= limit)
    return good[-1] if errors[-1] > limit else -1
""",
    ),
    (
        "12-lost",
        "equal is beyond",
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
        "None where it is not lost",
        """
def lost_since(errors, limit):
    k = len(errors)
    while k > 0 and errors[k - 1] > limit:
        k -= 1
    return k if k < len(errors) else None
""",
    ),
    (
        "12-interval",
        "p ± 1.96 σ of the share itself",
        """
def interval(k, n):
    p = k / n
    s = 1.96 * np.sqrt(p * (1 - p) / n)
    return max(p - s, 0), min(p + s, 1)
""",
    ),
    (
        "12-interval",
        "sign of the middle term",
        """
def interval(k, n):
    q = 1.96 ** 2 / n
    p = k / n
    a, b, c = 1 + q, -(2 * p - q), p ** 2
    d = np.sqrt(max(b ** 2 - 4 * a * c, 0))
    return (-b - d) / 2 / a, (-b + d) / 2 / a
""",
    ),
    (
        "12-interval",
        "1.96 not squared",
        """
def interval(k, n):
    q = 1.96 / n
    p = k / n
    a, b, c = 1 + q, -(2 * p + q), p ** 2
    d = np.sqrt(b ** 2 - 4 * a * c)
    return (-b - d) / 2 / a, (-b + d) / 2 / a
""",
    ),
    (
        "12-paired",
        "whole drives",
        """
def compare(errors_a, errors_b, limit):
    d = np.sort(np.sqrt((errors_a ** 2).mean(axis=1)) - np.sqrt((errors_b ** 2).mean(axis=1)))
    n = len(d)
    total, k = 0.0, 0
    while total + comb(n, k) / 2 ** n <= 0.025:
        total += comb(n, k) / 2 ** n
        k += 1
    return d[k - 1], d[n - k]
""",
    ),
    (
        "12-paired",
        "the first reading beyond is counted, too",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        end = bad[0] + 1 if len(bad) else len(a)
        if len(bad) and bad[0] == 0:
            continue
        d.append(np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2)))
    d, n = np.sort(d), len(d)
    total, k = 0.0, 0
    while total + comb(n, k) / 2 ** n <= 0.025:
        total += comb(n, k) / 2 ** n
        k += 1
    return d[k - 1], d[n - k]
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
    d, n = np.sort(d), len(d)
    total, k = 0.0, 0
    while total + comb(n, k) / 2 ** n <= 0.025:
        total += comb(n, k) / 2 ** n
        k += 1
    return d[k], d[n - k - 1]
""",
    ),
    (
        "12-paired",
        "normal interval of the mean",
        """
def compare(errors_a, errors_b, limit):
    d = []
    for a, b in zip(errors_a, errors_b):
        bad = np.flatnonzero((a > limit) | (b > limit))
        end = bad[0] if len(bad) else len(a)
        if end:
            d.append(np.sqrt(np.mean(a[:end] ** 2)) - np.sqrt(np.mean(b[:end] ** 2)))
    s = 1.96 * np.std(d, ddof=1) / np.sqrt(len(d))
    return np.mean(d) - s, np.mean(d) + s
""",
    ),
    (
        "12-relocalise",
        "searches anew in each scan",
        """
def relocalise(start, motions, sights, posts):
    pose, out = np.array(start), []
    for told, seen in zip(motions, sights):
        pose = corrected(compose(pose, told)[None], seen, posts)[0]
        if len(seen) > 1 and fit(pose[None], seen, posts)[0] < -6:
            all_poses = guesses(seen, posts)
            if len(all_poses):
                pose = all_poses[np.argmax(fit(all_poses, seen, posts))]
        out.append(pose)
    return np.array(out)
""",
    ),
]
