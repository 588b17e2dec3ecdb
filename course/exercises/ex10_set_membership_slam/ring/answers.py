# %% way: arrays
def ring(robot, box, r, bound):
    robot, box = np.reshape(robot, (2, 2)), np.reshape(box, (2, 2))
    near, far = max(0.0, r - bound), r + bound
    low, high = box[:, 0] - robot[:, 1], box[:, 1] - robot[:, 0]
    least, most = np.maximum(0, np.maximum(low, -high)), np.maximum(abs(low), abs(high))
    if np.hypot(*least) > far or np.hypot(*most) < near:
        return None
    outer = np.sqrt(far**2 - least[::-1] ** 2)
    inner = np.sqrt(np.clip(near**2 - most[::-1] ** 2, 0, None))
    west = np.array([robot[:, 0] - outer, robot[:, 1] - inner]).T
    east = np.array([robot[:, 0] + inner, robot[:, 1] + outer]).T
    found = []
    for k in range(2):
        kept = [np.clip(side[k], *box[k]) for side in (west, east) if meets(side[k], box[k])]
        found += [min(k[0] for k in kept), max(k[1] for k in kept)]
    return np.array(found)
def meets(a, b):
    return a[0] <= b[1] and b[0] <= a[1]

# %% way: differences first
def ring(robot, box, r, bound):
    near, far = r - bound, r + bound
    x = box[0] - robot[1], box[1] - robot[0]
    y = box[2] - robot[3], box[3] - robot[2]
    def smallest(low, high):
        return 0.0 if low <= 0 <= high else min(abs(low), abs(high))
    def allowed(along, across):
        most = far**2 - smallest(*across) ** 2
        least = near**2 - max(across[0] ** 2, across[1] ** 2) if near > 0 else 0
        if most < 0:
            return []
        a, b = np.sqrt(max(least, 0)), np.sqrt(most)
        pieces = [(max(along[0], s), min(along[1], t)) for s, t in ((-b, -a), (a, b))]
        return [piece for piece in pieces if piece[0] <= piece[1]]
    found = []
    for k, along, across in ((0, x, y), (2, y, x)):
        pieces = allowed(along, across)
        if not pieces:
            return None
        found.append(max(box[k], robot[k] + pieces[0][0]))
        found.append(min(box[k + 1], robot[k + 1] + pieces[-1][1]))
    return found

# %% way: side by side
def ring(robot, box, r, bound):
    found = []
    near, far = max(r - bound, 0), r + bound
    for k, m in ((0, 2), (2, 0)):
        dy = [box[m] - robot[m + 1], box[m + 1] - robot[m]]
        off = 0 if dy[0] * dy[1] < 0 else min(np.abs(dy))
        if off > far:
            return None
        reach = (far**2 - off**2) ** 0.5
        hole = max(near**2 - max(np.abs(dy)) ** 2, 0) ** 0.5
        low, high = max(box[k], robot[k] - reach), min(box[k + 1], robot[k + 1] + reach)
        # what lies between the two pieces, if anything does
        gap = robot[k + 1] - hole, robot[k] + hole
        if gap[0] < gap[1]:
            low = gap[1] if gap[0] < low < gap[1] else low
            high = gap[0] if gap[0] < high < gap[1] else high
        if low > high:
            return None
        found.extend((low, high))
    return tuple(found)

# %% pasted: the drive's box
def ring(robot, box, r, bound):
    seen = predict(robot, (-np.pi, np.pi), (r - bound, r + bound), (0.0, 0.0))
    low, high = np.maximum(box, seen)[::2], np.minimum(box, seen)[1::2]
    if (low > high).any():
        return None
    return np.array([low[0], high[0], low[1], high[1]])

# %% pasted: the square's edges
def ring(robot, box, r, bound):
    for a, b in ((1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)):
        c = r + bound + max(a * robot[0], a * robot[1]) + max(b * robot[2], b * robot[3])
        box = None if box is None else clip(box, (a, b, c))
    return box

# %% right: the largest and smallest |Δx| by the nearest and farthest |Δy|, then signs apart
def ring(robot, box, r, bound):
    lo, hi = max(r - bound, 0.0), r + bound
    def one(a0, a1, b0, b1, c0, c1, e0, e1):
        # a: robot along, b: object along; c, e: across
        y0, y1 = e0 - c1, e1 - c0
        near = 0.0 if y0 <= 0 <= y1 else min(abs(y0), abs(y1))
        far = max(abs(y0), abs(y1))
        if near > hi:
            return None
        largest = np.sqrt(hi ** 2 - near ** 2)
        smallest = np.sqrt(max(lo ** 2 - far ** 2, 0.0))
        pieces = []
        for p, q in ((-largest, -smallest), (smallest, largest)):
            p, q = max(p, b0 - a1), min(q, b1 - a0)
            if p <= q:
                pieces.append((max(b0, a0 + p), min(b1, a1 + q)))
        if not pieces:
            return None
        return min(p for p, q in pieces), max(q for p, q in pieces)
    x = one(robot[0], robot[1], box[0], box[1], robot[2], robot[3], box[2], box[3])
    y = one(robot[2], robot[3], box[2], box[3], robot[0], robot[1], box[0], box[1])
    return None if x is None or y is None else np.array([*x, *y])

# %% right: the same question asked along x and y by cases: which sides survive, written out with intervals
def ring(robot, box, r, bound):
    near, far = max(0.0, r - bound), r + bound
    result = []
    for k in (0, 2):
        o = 2 - k
        lo, hi = box[o] - robot[o + 1], box[o + 1] - robot[o]
        farthest = max(abs(lo), abs(hi))
        closest = 0.0 if lo <= 0 <= hi else min(abs(lo), abs(hi))
        if closest > far:
            return None
        big = (far**2 - closest**2) ** 0.5
        small = (near**2 - farthest**2) ** 0.5 if near > farthest else 0.0
        ends = []
        a, b = max(box[k], robot[k] + small), min(box[k + 1], robot[k + 1] + big)
        if a <= b:
            ends += [a, b]
        a, b = max(box[k], robot[k] - big), min(box[k + 1], robot[k + 1] - small)
        if a <= b:
            ends += [a, b]
        if not ends:
            return None
        result += [min(ends), max(ends)]
    return np.array(result)

# %% right: mirror: only objects to the right are treated, four times
def ring(robot, box, r, bound):
    inner_radius, outer_radius = max(0.0, r - bound), r + bound

    def towards_larger(me, it, low_other, high_other):
        """Interval of the object's coordinate that is not less than the robot's."""
        if low_other > outer_radius:
            return None
        most = (outer_radius**2 - low_other**2) ** 0.5
        least = max(0.0, inner_radius**2 - high_other**2) ** 0.5
        low, high = max(it[0], me[0] + least), min(it[1], me[1] + most)
        return (low, high) if low <= high else None

    def axis(me, it, me2, it2):
        gaps = it2[0] - me2[1], it2[1] - me2[0]
        low_other = 0.0 if gaps[0] <= 0 <= gaps[1] else min(abs(gaps[0]), abs(gaps[1]))
        high_other = max(abs(gaps[0]), abs(gaps[1]))
        found = []
        plus = towards_larger(me, it, low_other, high_other)
        if plus:
            found.append(plus)
        minus = towards_larger((-me[1], -me[0]), (-it[1], -it[0]), low_other, high_other)
        if minus:
            found.append((-minus[1], -minus[0]))
        if not found:
            return None
        return min(f[0] for f in found), max(f[1] for f in found)

    rx, ry, bx, by = robot[:2], robot[2:], box[:2], box[2:]
    x, y = axis(rx, bx, ry, by), axis(ry, by, rx, bx)
    if x is None or y is None:
        return None
    return np.array([x[0], x[1], y[0], y[1]], dtype=float)

# %% right: one axis after the other, the second with the first's result
def ring(robot, box, r, bound):
    R0, R1 = (r - bound if r > bound else 0.0), r + bound
    result = np.array(box, dtype=float)
    for k in (0, 2):
        o = 2 - k
        d = np.array([result[o] - robot[o + 1], result[o + 1] - robot[o]])
        far_off = np.abs(d).max()
        near_off = 0.0 if d[0] * d[1] <= 0 else np.abs(d).min()
        if near_off > R1:
            return None
        big = np.sqrt(R1**2 - near_off**2)
        small = np.sqrt(R0**2 - far_off**2) if R0 > far_off else 0.0
        pieces = np.array(
            [[robot[k] - big, robot[k + 1] - small], [robot[k] + small, robot[k + 1] + big]]
        )
        pieces = np.clip(pieces, [[result[k]] * 2] * 2, None)[
            (pieces[:, 1] >= result[k]) & (pieces[:, 0] <= result[k + 1])
        ]
        if len(pieces) == 0:
            return None
        result[k], result[k + 1] = pieces[:, 0].min(), min(pieces[:, 1].max(), result[k + 1])
    return result

# %% wrong: always an array, NaN where nothing is left
def ring(robot, box, r, bound):
    dx0, dx1 = box[0] - robot[1], box[1] - robot[0]
    dy0, dy1 = box[2] - robot[3], box[3] - robot[2]
    hi = r + bound
    ny = 0 if dy0 <= 0 <= dy1 else min(abs(dy0), abs(dy1))
    nx = 0 if dx0 <= 0 <= dx1 else min(abs(dx0), abs(dx1))
    X, Y = np.sqrt(hi ** 2 - ny ** 2), np.sqrt(hi ** 2 - nx ** 2)
    return np.array([max(box[0], robot[0] - X), min(box[1], robot[1] + X),
                     max(box[2], robot[2] - Y), min(box[3], robot[3] + Y)])

# %% wrong: least and most swapped: inner with the least across, outer with the most
def ring(robot, box, r, bound):
    near, far = max(r - bound, 0), r + bound

    def apart(k):
        low, high = box[k] - robot[k + 1], box[k + 1] - robot[k]
        return max(0, low, -high), max(-low, high)

    def left_along(k, across):
        least, most = apart(across)
        if least > far:
            return None
        outer, inner = np.sqrt(max(far**2 - most**2, 0)), np.sqrt(max(near**2 - least**2, 0))
        sides = (robot[k] - outer, robot[k + 1] - inner), (robot[k] + inner, robot[k + 1] + outer)
        pieces = [(max(low, box[k]), min(high, box[k + 1])) for low, high in sides]
        kept = [(low, high) for low, high in pieces if low <= high]
        return (kept[0][0], kept[-1][1]) if kept else None

    x, y = left_along(0, 2), left_along(2, 0)
    return None if x is None or y is None else np.array([*x, *y])

# %% wrong: both ends of a piece from the same end of the robot's box
def ring(robot, box, r, bound):
    near, far = max(r - bound, 0), r + bound
    out = np.empty(4)
    for k in (0, 2):
        o = 2 - k
        d = box[o] - robot[o + 1], box[o + 1] - robot[o]
        least, most = max(0, d[0], -d[1]), max(-d[0], d[1])
        if least > far:
            return None
        big, small = np.sqrt(far**2 - least**2), np.sqrt(max(0, near**2 - most**2))
        values = []
        for low, high in ((robot[k] - big, robot[k] - small), (robot[k + 1] + small, robot[k + 1] + big)):
            low, high = max(low, box[k]), min(high, box[k + 1])
            if low <= high:
                values += [low, high]
        if not values:
            return None
        out[k], out[k + 1] = min(values), max(values)
    return out

# %% wrong: where the ring crosses twice only the first piece is kept
def ring(robot, box, r, bound):
    near, far = max(r - bound, 0), r + bound

    def along(k, o):
        low, high = box[o] - robot[o + 1], box[o + 1] - robot[o]
        least, most = max(0, low, -high), max(-low, high)
        if least > far:
            return None
        big, small = np.sqrt(far**2 - least**2), np.sqrt(max(near**2 - most**2, 0))
        if small == 0:
            pieces = [(robot[k] - big, robot[k + 1] + big)]
        else:
            pieces = [(robot[k] - big, robot[k + 1] - small), (robot[k] + small, robot[k + 1] + big)]
        for a, b in pieces:
            a, b = max(a, box[k]), min(b, box[k + 1])
            if a <= b:
                return a, b
        return None

    x, y = along(0, 2), along(2, 0)
    return None if x is None or y is None else np.array([*x, *y])

# %% wrong: pieces tested one by one but the hull spans both: an empty piece is not left out
def ring(robot, box, r, bound):
    near, far = max(r - bound, 0), r + bound
    out = []
    for k, o in ((0, 2), (2, 0)):
        low, high = box[o] - robot[o + 1], box[o + 1] - robot[o]
        least, most = max(0, low, -high), max(-low, high)
        if least > far:
            return None
        big, small = np.sqrt(far**2 - least**2), np.sqrt(max(near**2 - most**2, 0))
        left = max(box[k], robot[k] - big), min(box[k + 1], robot[k + 1] - small)
        right = max(box[k], robot[k] + small), min(box[k + 1], robot[k + 1] + big)
        if left[0] > left[1] and right[0] > right[1]:
            return None
        out += [left[0], right[1]]
    return np.array(out)

# %% wrong: the box is changed in place
def ring(robot, box, r, bound):
    near, far = max(r - bound, 0), r + bound
    for k, o in ((0, 2), (2, 0)):
        low, high = box[o] - robot[o + 1], box[o + 1] - robot[o]
        least, most = max(0, low, -high), max(-low, high)
        if least > far:
            return None
        big, small = np.sqrt(far**2 - least**2), np.sqrt(max(near**2 - most**2, 0))
        values = []
        for a, b in ((robot[k] - big, robot[k + 1] - small), (robot[k] + small, robot[k + 1] + big)):
            a, b = max(a, box[k]), min(b, box[k + 1])
            if a <= b:
                values += [a, b]
        if not values:
            return None
        box[k], box[k + 1] = min(values), max(values)
    return box

# %% wrong: whole box or nothing: only the distances of the boxes are compared
def ring(robot, box, r, bound):
    near, far = max(r - bound, 0), r + bound
    gap_x = max(0, box[0] - robot[1], robot[0] - box[1])
    gap_y = max(0, box[2] - robot[3], robot[2] - box[3])
    span_x = max(box[1] - robot[0], robot[1] - box[0])
    span_y = max(box[3] - robot[2], robot[3] - box[2])
    if np.hypot(gap_x, gap_y) > far or np.hypot(span_x, span_y) < near:
        return None
    return np.array(box, dtype=float)
