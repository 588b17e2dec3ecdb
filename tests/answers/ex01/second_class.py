"""Quick ideas for 01-home: what one lap, or each lap by itself, tells."""

HEAD = "def home(start, steps, docked):\n    steps = steps.copy()\n"
WRONG = [
    (
        "01-home",
        "factor from the last lap, laps begun anew",
        HEAD
        + """
    a = docked[-2] if len(docked) > 1 else 0
    last = steps[a:docked[-1], 2].sum()
    steps[:, 2] /= abs(last) / (2 * np.pi)
    out, i = [np.array([start])], 0
    for j in [*docked, len(steps)]:
        out.append(track(start, steps[i:j])[1:])
        i = j
    return np.concatenate(out)
""",
    ),
    (
        "01-home",
        "only the last lap mended, the others begun anew",
        HEAD
        + """
    out, i = [np.array([start])], 0
    for j in docked:
        lap = steps[i:j].copy()
        if j == docked[-1]:
            t = lap[:, 2].sum()
            lap[:, 2] += (2 * np.pi * np.sign(t) - t) / len(lap)
        told = track(start, lap)
        if j == docked[-1]:
            told[:, :2] += np.linspace(0, 1, len(told))[:, None] * (start[:2] - told[-1, :2])
        out.append(told[1:])
        i = j
    out.append(track(start, steps[i:])[1:])
    return np.concatenate(out)
""",
    ),
    (
        "01-home",
        "the last lap's factor for all, gaps not shared",
        HEAD
        + """
    a = docked[-2] if len(docked) > 1 else 0
    steps[:, 2] /= abs(steps[a:docked[-1], 2].sum()) / (2 * np.pi)
    return track(start, steps)
""",
    ),
    (
        "01-home",
        "last lap's factor, headings left, places shared",
        HEAD
        + """
    a = docked[-2] if len(docked) > 1 else 0
    steps[:, 2] /= abs(steps[a:docked[-1], 2].sum()) / (2 * np.pi)
    out, i = [np.array([start])], 0
    for j in docked:
        told = track(start, steps[i:j])
        told[:, :2] += np.linspace(0, 1, len(told))[:, None] * (start[:2] - told[-1, :2])
        out.append(told[1:])
        i = j
    out.append(track(start, steps[i:])[1:])
    return np.concatenate(out)
""",
    ),
    (
        "01-home",
        "each lap's own factor, nothing shared, way beyond by the last lap's",
        HEAD
        + """
    out, i, f = [np.array([start])], 0, 1.0
    for j in docked:
        f = abs(steps[i:j, 2].sum()) / (2 * np.pi)
        steps[i:j, 2] /= f
        out.append(track(start, steps[i:j])[1:])
        i = j
    steps[i:, 2] /= f
    out.append(track(start, steps[i:])[1:])
    return np.concatenate(out)
""",
    ),
]

RIGHT = [
    (
        "01-home",
        "each lap's own factor and places shared, way beyond by the last lap's",
        HEAD
        + """
    out, i, f = [np.array([start])], 0, 1.0
    for j in docked:
        f = abs(steps[i:j, 2].sum()) / (2 * np.pi)
        steps[i:j, 2] /= f
        told = track(start, steps[i:j])
        told[:, :2] += np.linspace(0, 1, len(told))[:, None] * (start[:2] - told[-1, :2])
        out.append(told[1:])
        i = j
    steps[i:, 2] /= f
    out.append(track(start, steps[i:])[1:])
    return np.concatenate(out)
""",
    ),
]
