"""Independent answers to 12-lost: right ones, and students' mistakes."""

RIGHT = [
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
]

WRONG = [
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
]
