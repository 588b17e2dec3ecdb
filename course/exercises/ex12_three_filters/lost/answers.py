# %% way: counted back from the end
def lost_since(errors, limit):
    since = len(errors)
    for k in range(len(errors) - 1, -1, -1):
        if errors[k] <= limit:
            break
        since = k
    return since if since < len(errors) else -1

# %% way: by products from behind
def lost_since(errors, limit):
    gone = np.cumprod((errors > limit)[::-1])[::-1]
    return np.argmax(gone) if gone.any() else -1

# %% way: forward, with a memory
def lost_since(errors, limit):
    since = -1
    for k, error in enumerate(errors):
        if error > limit:
            since = k if since == -1 else since
        else:
            since = -1
    return since

# %% way: the first date that holds
def lost_since(errors, limit):
    dates = [k for k in range(len(errors)) if all(errors[k:] > limit)]
    return min(dates, default=-1)

# %% way: by the least error still to come
def lost_since(errors, limit):
    least = np.minimum.accumulate(errors[::-1])[::-1]
    if least[-1] <= limit:
        return -1
    return np.searchsorted(least, limit, side="right")

# %% way: a text
def lost_since(errors, limit):
    text = "".join("x" if error > limit else "." for error in errors)
    return float(text.rfind(".") + 1) if text.endswith("x") else -1.0

# %% right: backwards with a counter
def lost_since(errors, limit):
    since = -1
    for k in range(len(errors) - 1, -1, -1):
        if errors[k] > limit:
            since = k
        else:
            break
    return since

# %% right: walk backwards from the end
def lost_since(errors, limit):
    since = -1
    for k in range(len(errors) - 1, -1, -1):
        if errors[k] <= limit:
            break
        since = k
    return since

# %% right: cumulative product from behind
def lost_since(errors, limit):
    beyond = (np.asarray(errors) > limit).astype(int)
    tail = int(np.cumprod(beyond[::-1]).sum())
    return len(beyond) - tail if tail else -1

# %% right: walks back from the end while the error is beyond the limit
def lost_since(errors, limit):
    k = len(errors)
    while k > 0 and errors[k - 1] > limit:
        k -= 1
    return k if k < len(errors) else -1

# %% wrong: the last reading that was good
def lost_since(errors, limit):
    good = np.flatnonzero(errors <= limit)
    return good[-1] if errors[-1] > limit else -1

# %% wrong: None where it is not lost
def lost_since(errors, limit):
    k = len(errors)
    while k > 0 and errors[k - 1] > limit:
        k -= 1
    return k if k < len(errors) else None

# %% wrong: subtracts the limit in place
def lost_since(errors, limit):
    errors -= limit
    near = np.flatnonzero(errors <= 0)
    last = near[-1] if len(near) else -1
    return last + 1 if last + 1 < len(errors) else -1
