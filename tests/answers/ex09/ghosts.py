"""Independent answers to 09-ghosts: right ones, and students' mistakes."""

RIGHT = [
    (
        "09-ghosts",
        "the whole drive first, then found / in view along the way",
        """
def clean_map(x, P, drives, C, scans, R, far):
    found, way = np.zeros(0), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            j = -1
            if len(x) > 3:
                a = x[4::2]
                r = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
                off = np.hypot((z[0] - r) / 0.45, wrap(z[1] - a + x[2]) / 0.14)
                if off.min() < 1:
                    j = int(off.argmin())
            if j < 0:
                x, P = add(x, P, z, R)
                found = np.append(found, 1)
            else:
                found[j] += 1
                if found[j] > 2:
                    x, P = update(x, P, z, j, R)
        way.append(x[:2].copy())
    walls = x[3:].reshape(-1, 2)
    way = np.array(way)
    keep = []
    for k, (rho, alpha) in enumerate(walls):
        gap = rho - way @ [np.cos(alpha), np.sin(alpha)]
        due = np.sum((gap > 0.1) & (gap < far - 0.3))
        if found[k] >= 5 and found[k] >= 0.6 * due:
            keep.append(k)
    return walls[keep]
""",
    ),
]

WRONG = [
    (
        "09-ghosts",
        "everything that was found",
        """
def clean_map(x, P, drives, C, scans, R, far):
    found, way = np.zeros(0), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            j = -1
            if len(x) > 3:
                a = x[4::2]
                r = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
                off = np.hypot((z[0] - r) / 0.45, wrap(z[1] - a + x[2]) / 0.14)
                if off.min() < 1:
                    j = int(off.argmin())
            if j < 0:
                x, P = add(x, P, z, R)
                found = np.append(found, 1)
            else:
                found[j] += 1
                if found[j] > 2:
                    x, P = update(x, P, z, j, R)
        way.append(x[:2].copy())
    walls = x[3:].reshape(-1, 2)
    return walls
""",
    ),
    (
        "09-ghosts",
        "three sightings",
        """
def clean_map(x, P, drives, C, scans, R, far):
    found, way = np.zeros(0), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            j = -1
            if len(x) > 3:
                a = x[4::2]
                r = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
                off = np.hypot((z[0] - r) / 0.45, wrap(z[1] - a + x[2]) / 0.14)
                if off.min() < 1:
                    j = int(off.argmin())
            if j < 0:
                x, P = add(x, P, z, R)
                found = np.append(found, 1)
            else:
                found[j] += 1
                if found[j] > 2:
                    x, P = update(x, P, z, j, R)
        way.append(x[:2].copy())
    walls = x[3:].reshape(-1, 2)
    return walls[found >= 3]
""",
    ),
    (
        "09-ghosts",
        "ten sightings",
        """
def clean_map(x, P, drives, C, scans, R, far):
    found, way = np.zeros(0), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            j = -1
            if len(x) > 3:
                a = x[4::2]
                r = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
                off = np.hypot((z[0] - r) / 0.45, wrap(z[1] - a + x[2]) / 0.14)
                if off.min() < 1:
                    j = int(off.argmin())
            if j < 0:
                x, P = add(x, P, z, R)
                found = np.append(found, 1)
            else:
                found[j] += 1
                if found[j] > 2:
                    x, P = update(x, P, z, j, R)
        way.append(x[:2].copy())
    walls = x[3:].reshape(-1, 2)
    return walls[found >= 10]
""",
    ),
    (
        "09-ghosts",
        "twenty sightings",
        """
def clean_map(x, P, drives, C, scans, R, far):
    found, way = np.zeros(0), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            j = -1
            if len(x) > 3:
                a = x[4::2]
                r = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
                off = np.hypot((z[0] - r) / 0.45, wrap(z[1] - a + x[2]) / 0.14)
                if off.min() < 1:
                    j = int(off.argmin())
            if j < 0:
                x, P = add(x, P, z, R)
                found = np.append(found, 1)
            else:
                found[j] += 1
                if found[j] > 2:
                    x, P = update(x, P, z, j, R)
        way.append(x[:2].copy())
    walls = x[3:].reshape(-1, 2)
    return walls[found >= 20]
""",
    ),
    (
        "09-ghosts",
        "the eight that were found most often",
        """
def clean_map(x, P, drives, C, scans, R, far):
    found, way = np.zeros(0), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            j = -1
            if len(x) > 3:
                a = x[4::2]
                r = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
                off = np.hypot((z[0] - r) / 0.45, wrap(z[1] - a + x[2]) / 0.14)
                if off.min() < 1:
                    j = int(off.argmin())
            if j < 0:
                x, P = add(x, P, z, R)
                found = np.append(found, 1)
            else:
                found[j] += 1
                if found[j] > 2:
                    x, P = update(x, P, z, j, R)
        way.append(x[:2].copy())
    walls = x[3:].reshape(-1, 2)
    best = np.argsort(-found)[:8]
    return walls[best]
""",
    ),
    (
        "09-ghosts",
        "share of all scans, whether in view or not",
        """
def clean_map(x, P, drives, C, scans, R, far):
    found, way = np.zeros(0), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            j = -1
            if len(x) > 3:
                a = x[4::2]
                r = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
                off = np.hypot((z[0] - r) / 0.45, wrap(z[1] - a + x[2]) / 0.14)
                if off.min() < 1:
                    j = int(off.argmin())
            if j < 0:
                x, P = add(x, P, z, R)
                found = np.append(found, 1)
            else:
                found[j] += 1
                if found[j] > 2:
                    x, P = update(x, P, z, j, R)
        way.append(x[:2].copy())
    walls = x[3:].reshape(-1, 2)
    return walls[found >= 0.4 * len(scans)]
""",
    ),
    (
        "09-ghosts",
        "a gate so narrow that walls are doubled",
        """
def clean_map(x, P, drives, C, scans, R, far):
    found, way = np.zeros(0), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            j = -1
            if len(x) > 3:
                a = x[4::2]
                r = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
                off = np.hypot((z[0] - r) / 0.1, wrap(z[1] - a + x[2]) / 0.03)
                if off.min() < 1:
                    j = int(off.argmin())
            if j < 0:
                x, P = add(x, P, z, R)
                found = np.append(found, 1)
            else:
                found[j] += 1
                if found[j] > 2:
                    x, P = update(x, P, z, j, R)
        way.append(x[:2].copy())
    walls = x[3:].reshape(-1, 2)
    way = np.array(way)
    gap = walls[:, 0] - way @ np.array([np.cos(walls[:, 1]), np.sin(walls[:, 1])])
    due = np.sum((gap > 0) & (gap < far), axis=0)
    return walls[(found >= 5) & (found >= 0.6 * due)]
""",
    ),
    (
        "09-ghosts",
        "a gate so wide that walls become one",
        """
def clean_map(x, P, drives, C, scans, R, far):
    found, way = np.zeros(0), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            j = -1
            if len(x) > 3:
                a = x[4::2]
                r = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
                off = np.hypot((z[0] - r) / 3, wrap(z[1] - a + x[2]) / 1.0)
                if off.min() < 1:
                    j = int(off.argmin())
            if j < 0:
                x, P = add(x, P, z, R)
                found = np.append(found, 1)
            else:
                found[j] += 1
                if found[j] > 0:
                    x, P = update(x, P, z, j, R)
        way.append(x[:2].copy())
    walls = x[3:].reshape(-1, 2)
    way = np.array(way)
    gap = walls[:, 0] - way @ np.array([np.cos(walls[:, 1]), np.sin(walls[:, 1])])
    due = np.sum((gap > 0) & (gap < far), axis=0)
    return walls[(found >= 5) & (found >= 0.6 * due)]
""",
    ),
    (
        "09-ghosts",
        "nothing at all",
        """
def clean_map(x, P, drives, C, scans, R, far):
    return np.zeros((0, 2))
""",
    ),
    (
        "09-ghosts",
        "a guess: eight walls round the start",
        """
def clean_map(x, P, drives, C, scans, R, far):
    return np.column_stack([np.full(8, 4.0), wrap(np.arange(8) * np.pi / 4)])
""",
    ),
    (
        "09-ghosts",
        "by wheels alone, no update",
        """
def clean_map(x, P, drives, C, scans, R, far):
    walls, found, way = np.zeros((0, 2)), np.zeros(0), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            line = place(x, P, z, R)[0]
            off = np.hypot((walls[:, 0] - line[0]) / 0.5, wrap(walls[:, 1] - line[1]) / 0.2)
            if len(off) and off.min() < 1:
                found[off.argmin()] += 1
            else:
                walls = np.vstack([walls, line])
                found = np.append(found, 1)
        way.append(x[:2])
    gap = walls[:, 0] - np.array(way) @ np.array([np.cos(walls[:, 1]), np.sin(walls[:, 1])])
    due = np.sum((gap > 0) & (gap < far), axis=0)
    return walls[(found >= 5) & (found > 0.6 * due)]
""",
    ),
    (
        "09-ghosts",
        "a book of lives: walls left behind are forgotten",
        """
def clean_map(x, P, drives, C, scans, R, far):
    count, left = [], []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        seen = set()
        for z in scan:
            a = x[4::2]
            r = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
            off = np.hypot((z[0] - r) / 0.45, wrap(z[1] - a + x[2]) / 0.14)
            if len(off) and off.min() < 1:
                j = int(off.argmin())
                x, P = update(x, P, z, j, R)
                count[j] += 1
            else:
                x, P = add(x, P, z, R)
                j = len(count)
                count.append(1)
                left.append(5)
            seen.add(j)
        left = [5 if i in seen else n - 1 for i, n in enumerate(left)]
        stay = [i for i, n in enumerate(left) if n > 0]
        at = [0, 1, 2] + [k for i in stay for k in (3 + 2 * i, 4 + 2 * i)]
        x, P = x[at], P[np.ix_(at, at)]
        count, left = [count[i] for i in stay], [left[i] for i in stay]
    return x[3:].reshape(-1, 2)[np.array(count, dtype=int) >= 3]
""",
    ),
    (
        "09-ghosts",
        "the lines in the robot's frame, of all scans",
        """
def clean_map(x, P, drives, C, scans, R, far):
    return np.vstack([s for s in scans if len(s)])
""",
    ),
    (
        "09-ghosts",
        "drives one late: predicts after the scan with the same index, first scan driven",
        """
def clean_map(x, P, drives, C, scans, R, far):
    found, way = np.zeros(0), []
    for u, scan in zip(drives, scans):
        x, P = predict(x, P, u, C)
        for z in scan:
            a = x[4::2]
            r = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
            off = np.hypot((z[0] - r) / 0.45, wrap(z[1] - a + x[2]) / 0.14)
            if len(off) == 0 or off.min() > 1:
                x, P = add(x, P, z, R)
                found = np.append(found, 1)
            else:
                found[off.argmin()] += 1
                x, P = update(x, P, z, int(off.argmin()), R)
    return x[3:].reshape(-1, 2)[found >= 8]
""",
    ),
    (
        "09-ghosts",
        "found / in view, but in view counts walls behind the robot too",
        """
def clean_map(x, P, drives, C, scans, R, far):
    found, way = np.zeros(0), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            j = -1
            if len(x) > 3:
                a = x[4::2]
                r = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
                off = np.hypot((z[0] - r) / 0.45, wrap(z[1] - a + x[2]) / 0.14)
                if off.min() < 1:
                    j = int(off.argmin())
            if j < 0:
                x, P = add(x, P, z, R)
                found = np.append(found, 1)
            else:
                found[j] += 1
                if found[j] > 2:
                    x, P = update(x, P, z, j, R)
        way.append(x[:2].copy())
    walls = x[3:].reshape(-1, 2)
    way = np.array(way)
    gap = abs(walls[:, 0] - way @ np.array([np.cos(walls[:, 1]), np.sin(walls[:, 1])]))
    due = np.sum(gap < 3 * far, axis=0)
    return walls[(found >= 5) & (found >= 0.6 * due)]
""",
    ),
    (
        "09-ghosts",
        "the wrong columns: alpha first",
        """
def clean_map(x, P, drives, C, scans, R, far):
    found, way = np.zeros(0), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, drives[t - 1], C)
        for z in scan:
            j = -1
            if len(x) > 3:
                a = x[4::2]
                r = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
                off = np.hypot((z[0] - r) / 0.45, wrap(z[1] - a + x[2]) / 0.14)
                if off.min() < 1:
                    j = int(off.argmin())
            if j < 0:
                x, P = add(x, P, z, R)
                found = np.append(found, 1)
            else:
                found[j] += 1
                if found[j] > 2:
                    x, P = update(x, P, z, j, R)
        way.append(x[:2].copy())
    walls = x[3:].reshape(-1, 2)
    way = np.array(way)
    gap = walls[:, 0] - way @ np.array([np.cos(walls[:, 1]), np.sin(walls[:, 1])])
    due = np.sum((gap > 0.1) & (gap < far - 0.3), axis=0)
    return walls[(found >= 5) & (found >= 0.6 * due)][:, ::-1]
""",
    ),
]
