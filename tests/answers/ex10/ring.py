"""Independent answers to 10-ring: right ones, and students' mistakes."""

RIGHT = [
    (
        "10-ring",
        "mirror: only objects to the right are treated, four times",
        '''
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
''',
    ),
    (
        "10-ring",
        "one axis after the other, the second with the first's result",
        """
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
""",
    ),
]

WRONG = [
    (
        "10-ring",
        "r - bound not taken as 0 where negative",
        """
def ring(robot, box, r, bound):
    near, far = r - bound, r + bound

    def reach(me, it, me2, it2):
        d = it2[0] - me2[1], it2[1] - me2[0]
        least, most = max(0, d[0], -d[1]), max(abs(d[0]), abs(d[1]))
        if least > far:
            return []
        out = (far**2 - least**2) ** 0.5
        hole = max(near**2 - most**2, 0) ** 0.5
        both = [(me[0] - out, me[1] - hole), (me[0] + hole, me[1] + out)]
        both = [(max(a, it[0]), min(b, it[1])) for a, b in both]
        return [v for a, b in both if a <= b for v in (a, b)]

    x = reach(robot[:2], box[:2], robot[2:], box[2:])
    y = reach(robot[2:], box[2:], robot[:2], box[:2])
    return np.array([min(x), max(x), min(y), max(y)]) if x and y else None
""",
    ),
    (
        "10-ring",
        "only the outer circle is used: the hole is forgotten",
        """
def ring(robot, box, r, bound):
    far = r + bound
    new = []
    for k, o in ((0, 2), (2, 0)):
        gap = max(0, box[o] - robot[o + 1], robot[o] - box[o + 1])
        if gap > far:
            return None
        reach = np.sqrt(far**2 - gap**2)
        low, high = max(box[k], robot[k] - reach), min(box[k + 1], robot[k + 1] + reach)
        if low > high:
            return None
        new += [low, high]
    return np.array(new)
""",
    ),
    (
        "10-ring",
        "a square round the robot's box, as the lesson does beyond a right angle",
        """
def ring(robot, box, r, bound):
    far = r + bound
    x_min, x_max = max(box[0], robot[0] - far), min(box[1], robot[1] + far)
    y_min, y_max = max(box[2], robot[2] - far), min(box[3], robot[3] + far)
    if x_min > x_max or y_min > y_max:
        return None
    return np.array([x_min, x_max, y_min, y_max])
""",
    ),
    (
        "10-ring",
        "least and most swapped: inner with the least across, outer with the most",
        """
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
""",
    ),
    (
        "10-ring",
        "the robot stands in the middle of its box",
        """
def ring(robot, box, r, bound):
    px, py = (robot[0] + robot[1]) / 2, (robot[2] + robot[3]) / 2
    near, far = max(r - bound, 0.0), r + bound

    def side(p, lo, hi, q, lo2, hi2):
        least = max(0.0, lo2 - q, q - hi2)
        most = max(hi2 - q, q - lo2)
        if least > far:
            return None
        out, hole = np.sqrt(far**2 - least**2), np.sqrt(max(0.0, near**2 - most**2))
        got = []
        for a, b in ((p - out, p - hole), (p + hole, p + out)):
            a, b = max(a, lo), min(b, hi)
            if a <= b:
                got += [a, b]
        return (min(got), max(got)) if got else None

    x = side(px, box[0], box[1], py, box[2], box[3])
    y = side(py, box[2], box[3], px, box[0], box[1])
    if x is None or y is None:
        return None
    return np.array(x + y)
""",
    ),
    (
        "10-ring",
        "both ends of a piece from the same end of the robot's box",
        """
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
""",
    ),
    (
        "10-ring",
        "the least distance across is never 0, even where the boxes overlap there",
        """
def ring(robot, box, r, bound):
    near, far = max(r - bound, 0), r + bound

    def along(k, o):
        ends = np.abs([box[o] - robot[o + 1], box[o + 1] - robot[o]])
        if ends.min() > far:
            return None
        big = np.sqrt(far**2 - ends.min() ** 2)
        small = np.sqrt(max(near**2 - ends.max() ** 2, 0))
        pieces = [(robot[k] - big, robot[k + 1] - small), (robot[k] + small, robot[k + 1] + big)]
        pieces = [(max(a, box[k]), min(b, box[k + 1])) for a, b in pieces]
        pieces = [p for p in pieces if p[0] <= p[1]]
        return (pieces[0][0], pieces[-1][1]) if pieces else None

    x, y = along(0, 2), along(2, 0)
    if x is None or y is None:
        return None
    return np.array([*x, *y])
""",
    ),
    (
        "10-ring",
        "None forgotten: a crossed box where no piece is left",
        """
def ring(robot, box, r, bound):
    near, far = max(r - bound, 0), r + bound

    def along(k, o):
        low, high = box[o] - robot[o + 1], box[o + 1] - robot[o]
        least, most = max(0, low, -high), max(-low, high)
        big = np.sqrt(max(far**2 - least**2, 0))
        small = np.sqrt(max(near**2 - most**2, 0))
        left = max(box[k], robot[k] - big), min(box[k + 1], robot[k + 1] - small)
        right = max(box[k], robot[k] + small), min(box[k + 1], robot[k + 1] + big)
        if left[0] > left[1]:
            return right
        if right[0] > right[1]:
            return left
        return left[0], right[1]

    return np.array([*along(0, 2), *along(2, 0)])
""",
    ),
    (
        "10-ring",
        "only the object's larger x and y side of the ring: negative d forgotten",
        """
def ring(robot, box, r, bound):
    near, far = max(r - bound, 0), r + bound
    kept = []
    for k, o in ((0, 2), (2, 0)):
        low, high = box[o] - robot[o + 1], box[o + 1] - robot[o]
        least, most = max(0, low, -high), max(abs(low), abs(high))
        if least > far:
            return None
        a = max(box[k], robot[k] + np.sqrt(max(near**2 - most**2, 0)))
        b = min(box[k + 1], robot[k + 1] + np.sqrt(far**2 - least**2))
        if a > b:
            return None
        kept += [a, b]
    return np.array(kept)
""",
    ),
    (
        "10-ring",
        "where the ring crosses twice only the first piece is kept",
        """
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
""",
    ),
    (
        "10-ring",
        "pieces tested one by one but the hull spans both: an empty piece is not left out",
        """
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
""",
    ),
    (
        "10-ring",
        "the box is changed in place",
        """
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
""",
    ),
    (
        "10-ring",
        "distances subtracted, not squares: inner = near - most, outer = far - least",
        """
def ring(robot, box, r, bound):
    near, far = max(r - bound, 0), r + bound

    def along(k, o):
        low, high = box[o] - robot[o + 1], box[o + 1] - robot[o]
        least, most = max(0, low, -high), max(-low, high)
        if least > far:
            return None
        outer, inner = far - least, max(near - most, 0)
        sides = [(robot[k] - outer, robot[k + 1] - inner), (robot[k] + inner, robot[k + 1] + outer)]
        kept = [(max(a, box[k]), min(b, box[k + 1])) for a, b in sides]
        kept = [(a, b) for a, b in kept if a <= b]
        return (kept[0][0], kept[-1][1]) if kept else None

    x, y = along(0, 2), along(2, 0)
    return None if x is None or y is None else np.array([*x, *y])
""",
    ),
    (
        "10-ring",
        "whole box or nothing: only the distances of the boxes are compared",
        """
def ring(robot, box, r, bound):
    near, far = max(r - bound, 0), r + bound
    gap_x = max(0, box[0] - robot[1], robot[0] - box[1])
    gap_y = max(0, box[2] - robot[3], robot[2] - box[3])
    span_x = max(box[1] - robot[0], robot[1] - box[0])
    span_y = max(box[3] - robot[2], robot[3] - box[2])
    if np.hypot(gap_x, gap_y) > far or np.hypot(span_x, span_y) < near:
        return None
    return np.array(box, dtype=float)
""",
    ),
]
