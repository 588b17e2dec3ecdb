"""Independent answers to 14-unwrap: right ones, and students' mistakes."""

RIGHT = [
    (
        "14-unwrap",
        "np.unwrap with a period",
        """
def unwrap(values):
    values = np.array(values, dtype=int)
    return np.unwrap(values, period=256) - values[0]
""",
    ),
    (
        "14-unwrap",
        "int8 wraps by itself",
        """
def unwrap(values):
    small = np.array(values).astype(np.int8)
    steps = np.diff(small).astype(np.int64)
    return np.append(0, steps.cumsum()).astype(int)
""",
    ),
    (
        "14-unwrap",
        "a loop, returns a list",
        """
def unwrap(values):
    total, result = 0, [0]
    for before, now in zip(values[:-1], values[1:]):
        step = int(now) - int(before)
        if step > 127:
            step -= 256
        if step < -127:
            step += 256
        total += step
        result.append(total)
    return result
""",
    ),
]

WRONG = [
    (
        "14-unwrap",
        "only overflow ahead",
        """
def unwrap(values):
    result, turns = [], 0
    for k, v in enumerate(values):
        if k and v - values[k - 1] < -128:
            turns += 1
        result.append(v + 256 * turns - values[0])
    return np.array(result)
""",
    ),
    (
        "14-unwrap",
        "a change of sign taken for an overflow",
        """
def unwrap(values):
    total = [0]
    for a, b in zip(values[:-1], values[1:]):
        if a > 0 and b < 0:
            total.append(total[-1] + b + 256 - a)
        elif a < 0 and b > 0:
            total.append(total[-1] + b - 256 - a)
        else:
            total.append(total[-1] + b - a)
    return np.array(total)
""",
    ),
    (
        "14-unwrap",
        "255 counts a turn",
        """
def unwrap(values):
    d = np.diff(values)
    d = np.where(d > 127, d - 255, d)
    d = np.where(d < -127, d + 255, d)
    return np.r_[0, np.cumsum(d)]
""",
    ),
    (
        "14-unwrap",
        "threshold at 200",
        """
def unwrap(values):
    d = np.diff(values)
    d = d - 256 * (d > 200) + 256 * (d < -200)
    return np.r_[0, np.cumsum(d)]
""",
    ),
    (
        "14-unwrap",
        "threshold at 64, fast steps are mended wrongly",
        """
def unwrap(values):
    d = np.array(np.diff(values))
    d[d > 64] -= 256
    d[d < -64] += 256
    return np.r_[0, np.cumsum(d)]
""",
    ),
    (
        "14-unwrap",
        "edge off by one, 127 ahead is 129 back",
        """
def unwrap(values):
    total, out = 0, [0]
    for a, b in zip(values, values[1:]):
        step = b - a
        if step >= 127:
            step -= 256
        elif step < -128:
            step += 256
        total += step
        out.append(total)
    return out
""",
    ),
    (
        "14-unwrap",
        "one side of the edge off by one, -127",
        """
def unwrap(values):
    steps = (np.diff(values) + 126) % 256 - 126
    return np.concatenate([[0], np.cumsum(steps)])
""",
    ),
    (
        "14-unwrap",
        "mended in place",
        """
def unwrap(values):
    values = np.asarray(values)
    for k in range(1, len(values)):
        step = (values[k] - values[k - 1] + 128) % 256 - 128
        values[k] = values[k - 1] + step
    return values - values[0]
""",
    ),
    (
        "14-unwrap",
        "the first subtracted in place",
        """
def unwrap(values):
    values -= values[0]
    steps = (np.diff(values) + 128) % 256 - 128
    return np.concatenate([[0], np.cumsum(steps)])
""",
    ),
    (
        "14-unwrap",
        "begins with the first value",
        """
def unwrap(values):
    steps = (np.diff(values) + 128) % 256 - 128
    return np.cumsum(np.concatenate([values[:1], steps]))
""",
    ),
    (
        "14-unwrap",
        "steps, not added up",
        """
def unwrap(values):
    steps = (np.diff(values, prepend=values[0]) + 128) % 256 - 128
    return steps
""",
    ),
    (
        "14-unwrap",
        "one value less",
        """
def unwrap(values):
    total, out = 0, []
    for a, b in zip(values[:-1], values[1:]):
        total += (b - a + 128) % 256 - 128
        out.append(total)
    return np.array(out)
""",
    ),
    (
        "14-unwrap",
        "adds up the way without its sign",
        """
def unwrap(values):
    steps = np.abs((np.diff(values) + 128) % 256 - 128)
    return np.concatenate([[0], np.cumsum(steps)])
""",
    ),
    (
        "14-unwrap",
        "whole way wrapped, not each step",
        """
def unwrap(values):
    values = np.asarray(values)
    return (values - values[0] + 128) % 256 - 128
""",
    ),
    (
        "14-unwrap",
        "made unsigned only",
        """
def unwrap(values):
    unsigned = np.asarray(values) % 256
    return unsigned - unsigned[0]
""",
    ),
    (
        "14-unwrap",
        "sum kept in a signed byte",
        """
def unwrap(values):
    small = np.asarray(values).astype(np.int8)
    return np.concatenate([[0], np.cumsum(np.diff(small), dtype=np.int8)])
""",
    ),
    (
        "14-unwrap",
        "sum kept in 16 bits",
        """
def unwrap(values):
    steps = (np.diff(values) + 128) % 256 - 128
    out = np.zeros(len(values), dtype=np.int16)
    out[1:] = np.cumsum(steps, dtype=np.int16)
    return out
""",
    ),
    (
        "14-unwrap",
        "compares with the mended value, one overflow only",
        """
def unwrap(values):
    out = [int(values[0])]
    for v in values[1:]:
        v = int(v)
        if v - out[-1] > 128:
            v -= 256
        elif v - out[-1] < -128:
            v += 256
        out.append(v)
    return np.array(out) - values[0]
""",
    ),
    (
        "14-unwrap",
        "overflow mended for one reading only",
        """
def unwrap(values):
    out = np.array(values, dtype=int)
    d = np.diff(values)
    out[1:][d < -128] += 256
    out[1:][d > 128] -= 256
    return out - out[0]
""",
    ),
    (
        "14-unwrap",
        "np.unwrap in radians, cut to int",
        """
def unwrap(values):
    angle = np.unwrap(np.asarray(values) / 128 * np.pi)
    return ((angle - angle[0]) / np.pi * 128).astype(int)
""",
    ),
    (
        "14-unwrap",
        "np.unwrap without a period",
        """
def unwrap(values):
    way = np.unwrap(np.asarray(values, dtype=float))
    return way - way[0]
""",
    ),
    (
        "14-unwrap",
        "wraps with fmod",
        """
def unwrap(values):
    steps = np.fmod(np.diff(values) + 128, 256) - 128
    return np.concatenate([[0], np.cumsum(steps)])
""",
    ),
    (
        "14-unwrap",
        "one reading gives nothing",
        """
def unwrap(values):
    if len(values) < 2:
        return np.array([])
    steps = (np.diff(values) + 128) % 256 - 128
    return np.concatenate([[0], np.cumsum(steps)])
""",
    ),
    (
        "14-unwrap",
        "one reading fails",
        """
def unwrap(values):
    before, total, out = values[0], 0, [0]
    now = values[1]
    for now in values[1:]:
        total += (now - before + 128) % 256 - 128
        before = now
        out.append(total)
    return out
""",
    ),
    (
        "14-unwrap",
        "only the last count",
        """
def unwrap(values):
    total = 0
    for k in range(1, len(values)):
        total += (values[k] - values[k - 1] + 128) % 256 - 128
    return total
""",
    ),
    (
        "14-unwrap",
        "counts back, sign of the difference",
        """
def unwrap(values):
    values = np.asarray(values)
    steps = (values[:-1] - values[1:] + 128) % 256 - 128
    return np.concatenate([[0], np.cumsum(steps)])
""",
    ),
]
