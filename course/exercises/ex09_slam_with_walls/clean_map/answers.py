# %% way: lives that only walls in view pay
def clean_map(x, P, us, C, scans, R, far):
    walls = []  # of each that is in the state: a list of its own
    for t, scan in enumerate(scans):
        if t:
            x, P = predict(x, P, us[t - 1], C)
        had = set()
        for z in scan:
            n = np.array([np.cos(x[4::2]), np.sin(x[4::2])])
            v = np.column_stack([z[0] - x[3::2] + x[:2] @ n, wrap(z[1] - x[4::2] + x[2])])
            d = np.abs(v / [0.5, 0.16]).max(axis=1)
            d[list(had)] = np.inf
            if len(d) and d.min() < 1:
                j = int(d.argmin())
                if walls[j][0] > 1:
                    x, P = update(x, P, z, j, R)
            else:
                j = len(walls)
                x, P = add(x, P, z, R)
                walls.append([0, 0])
            had.add(j)

        gap = x[3::2] - np.cos(x[4::2]) * x[0] - np.sin(x[4::2]) * x[1]
        for j, wall in enumerate(walls):
            if j in had:
                wall[0], wall[1] = wall[0] + 1, 0
            elif 0.1 < gap[j] < far - 0.1:
                wall[1] += 1
        keep = [j for j, wall in enumerate(walls) if wall[1] < (3 if wall[0] < 5 else 5)]
        at = [0, 1, 2] + [k for j in keep for k in (3 + 2 * j, 4 + 2 * j)]
        x, P, walls = x[at], P[at][:, at], [walls[j] for j in keep]
    return [[x[3 + 2 * j], x[4 + 2 * j]] for j in range(len(walls)) if walls[j][0] > 4]

# %% way: all kept, judged at the end
def clean_map(x, P, us, C, scans, R, far):
    way, walls = [], []  # of each that is in the state: a list of its own
    for t, scan in enumerate(scans):
        if t:
            way.append(x[:3])
            x, P = predict(x, P, us[t - 1], C)
        had = set()
        for z in scan:
            n = np.array([np.cos(x[4::2]), np.sin(x[4::2])])
            v = np.column_stack([z[0] - x[3::2] + x[:2] @ n, wrap(z[1] - x[4::2] + x[2])])
            d = np.abs(v / [0.5, 0.16]).max(axis=1)
            d[list(had)] = np.inf
            if len(d) and d.min() < 1:
                j = int(d.argmin())
                walls[j].append(t)
                if len(walls[j]) > 2:
                    x, P = update(x, P, z, j, R)
            else:
                j = len(walls)
                x, P = add(x, P, z, R)
                walls.append([t])
            had.add(j)

        young = [len(w) > 2 or t - w[-1] < 8 for w in walls]
        at = np.append([0, 1, 2], 3 + np.flatnonzero(np.repeat(np.array(young, dtype=bool), 2)))
        x, P, walls = x[at], P[np.ix_(at, at)], [w for w, y in zip(walls, young) if y]
    way = np.array([*way, x[:3]])
    kept = []
    for (rho, alpha), times in zip(x[3:].reshape(-1, 2), walls):
        gap = rho - way[:, 0] * np.cos(alpha) - way[:, 1] * np.sin(alpha)
        due = ((gap > 0.05) & (gap < far - 0.05)).sum()
        if len(times) > 4 and len(times) > 0.6 * due:
            kept.append((rho, alpha))
    return np.array(kept)

# %% way: odds
def clean_map(x, P, us, C, scans, R, far):
    walls = []  # of each that is in the state: a list of its own
    for t, scan in enumerate(scans):
        if t:
            x, P = predict(x, P, us[t - 1], C)
        had = set()
        for z in scan:
            n = np.array([np.cos(x[4::2]), np.sin(x[4::2])])
            v = np.column_stack([z[0] - x[3::2] + x[:2] @ n, wrap(z[1] - x[4::2] + x[2])])
            d = np.abs(v / [0.5, 0.16]).max(axis=1)
            d[list(had)] = np.inf
            if len(d) and d.min() < 1:
                j = int(d.argmin())
                if walls[j][1] > 1:
                    x, P = update(x, P, z, j, R)
            else:
                j = len(walls)
                x, P = add(x, P, z, R)
                walls.append([0.0, 0])
            had.add(j)

        gap = x[3::2] - np.cos(x[4::2]) * x[0] - np.sin(x[4::2]) * x[1]
        for j, wall in enumerate(walls):
            if j in had:
                wall[0], wall[1] = min(wall[0] + 1.0, 6), wall[1] + 1
            elif 0.1 < gap[j] < far - 0.1:
                wall[0] -= 1.6  # a wall that is in view is missed once in five scans
        good = np.array([wall[0] > -1 for wall in walls], dtype=bool)
        at = np.append([0, 1, 2], 3 + np.flatnonzero(np.repeat(good, 2)))
        x, P, walls = x[at], P[np.ix_(at, at)], [w for w, g in zip(walls, good) if g]
    return x[3:].reshape(-1, 2)[[wall[0] > 1.5 and wall[1] > 4 for wall in walls]]

# %% pasted: the lesson's rule: three observations, then for good
def clean_map(x, P, us, C, scans, R, far):
    book = []  # observations and lives of each wall in the state
    for t, scan in enumerate(scans):
        if t:
            x, P = predict(x, P, us[t - 1], C)
        seen = set()
        for z in scan:
            a = x[4::2]
            ahead = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
            off = np.hypot((z[0] - ahead) / 0.45, wrap(z[1] - a + x[2]) / 0.14)
            j = int(off.argmin()) if len(off) else -1
            if j >= 0 and off[j] < 1:
                x, P = update(x, P, z, j, R)
            else:
                j = len(book)
                x, P = add(x, P, z, R)
                book.append((0, 3))
            book[j] = (book[j][0] + (j not in seen), 3)
            seen.add(j)
        book = [(n, k if j in seen or n >= 3 else k - 1) for j, (n, k) in enumerate(book)]
        alive = [j for j, (n, k) in enumerate(book) if k > 0]
        at = [0, 1, 2] + [k for j in alive for k in (3 + 2 * j, 4 + 2 * j)]
        x, P, book = x[at], P[np.ix_(at, at)], [book[j] for j in alive]
    return x[3:].reshape(-1, 2)[[n >= 3 for n, k in book]]

# %% pasted: the book of 09-life
def clean_map(x, P, us, C, scans, R, far):
    book = []  # observations and lives of each wall in the state
    for t, scan in enumerate(scans):
        if t:
            x, P = predict(x, P, us[t - 1], C)
        seen = set()
        for z in scan:
            a = x[4::2]
            ahead = x[3::2] - x[0] * np.cos(a) - x[1] * np.sin(a)
            off = np.hypot((z[0] - ahead) / 0.45, wrap(z[1] - a + x[2]) / 0.14)
            j = int(off.argmin()) if len(off) else -1
            if j >= 0 and off[j] < 1:
                x, P = update(x, P, z, j, R)
            else:
                j = len(book)
                x, P = add(x, P, z, R)
                book.append((0, 3))
            book[j] = (book[j][0] + (j not in seen), 3)
            seen.add(j)
        book = [(n, k if j in seen or False else k - 1) for j, (n, k) in enumerate(book)]
        alive = [j for j, (n, k) in enumerate(book) if k > 0]
        at = [0, 1, 2] + [k for j in alive for k in (3 + 2 * j, 4 + 2 * j)]
        x, P, book = x[at], P[np.ix_(at, at)], [book[j] for j in alive]
    return x[3:].reshape(-1, 2)[[n >= 3 for n, k in book]]

# %% pasted: no wall at all
def clean_map(x, P, us, C, scans, R, far):
    return np.empty((0, 2))

# %% pasted: all that the first scan saw
def clean_map(x, P, us, C, scans, R, far):
    return [place(x, P, z, R)[0] for z in scans[0]]

# %% right: the whole drive first, then found / in view along the way
def clean_map(x, P, us, C, scans, R, far):
    found, way = np.zeros(0), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, us[t - 1], C)
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

# %% wrong: the eight that were found most often
def clean_map(x, P, us, C, scans, R, far):
    found, way = np.zeros(0), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, us[t - 1], C)
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

# %% wrong: nothing at all
def clean_map(x, P, us, C, scans, R, far):
    return np.zeros((0, 2))

# %% wrong: a guess: eight walls round the start
def clean_map(x, P, us, C, scans, R, far):
    return np.column_stack([np.full(8, 4.0), wrap(np.arange(8) * np.pi / 4)])

# %% wrong: the lines in the robot's frame, of all scans
def clean_map(x, P, us, C, scans, R, far):
    return np.vstack([s for s in scans if len(s)])

# %% wrong: keeps whatever was found five times: nothing asks in how many scans it was in view and not found, so the things stay
def clean_map(x, P, us, C, scans, R, far):
    hits = []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, us[t - 1], C)
        for z in scan:
            al = x[4::2]
            d = np.abs(z[0] - (x[3::2] - x[0] * np.cos(al) - x[1] * np.sin(al)))
            a = np.abs(wrap(z[1] - al + x[2]))
            near = np.flatnonzero((d < 0.5) & (a < 0.15))
            if near.size == 0:
                x, P = add(x, P, z, R)
                hits.append(1)
            else:
                k = near[np.argmin(d[near] + 3 * a[near])]
                hits[k] += 1
                if hits[k] > 2:
                    x, P = update(x, P, z, k, R)
    return x[3:].reshape(-1, 2)[np.array(hits) >= 5]

# %% wrong: a wall is what was sighted eight times, by the wheels alone
def clean_map(x, P, us, C, scans, R, far):
    x, walls = x.copy(), []
    for t, scan in enumerate(scans):
        if t > 0:
            x, P = predict(x, P, us[t - 1], C)
        for z in scan:
            a = wrap(x[2] + z[1])
            line = np.array([z[0] + x[0] * np.cos(a) + x[1] * np.sin(a), a])
            for wall in walls:
                mean = wall[0] / wall[1]
                if abs(line[0] - mean[0]) < 0.5 and abs(wrap(line[1] - mean[1])) < 0.2:
                    wall[0], wall[1] = wall[0] + line, wall[1] + 1
                    break
            else:
                walls.append([line, 1])
    return np.array([s / n for s, n in walls if n >= 8])
