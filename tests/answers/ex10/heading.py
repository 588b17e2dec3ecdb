"""Independent answers to 10-heading: right ones, and students' mistakes."""

RIGHT = [
    (
        "10-heading",
        "box of differences, centre bearing, normalised right",
        """
def sharpen(heading, robot, box, bearing, bound):
    dx = box[0] - robot[1], box[1] - robot[0]
    dy = box[2] - robot[3], box[3] - robot[2]
    if dx[0] <= 0 <= dx[1] and dy[0] <= 0 <= dy[1]:
        return np.array(heading, dtype=float)
    centre = np.arctan2(dy[0] + dy[1], dx[0] + dx[1])
    off = [wrap(np.arctan2(y, x) - centre) for x in dx for y in dy]
    width = max(off) - min(off) + 2 * bound
    start = centre + min(off) - bearing - bound
    for k in range(-4, 5):
        low = max(heading[0], start + 2 * np.pi * k)
        high = min(heading[1], start + width + 2 * np.pi * k)
        if low <= high:
            right = wrap(float(low))
            return np.array([right, right + high - low])
    return np.array(heading, dtype=float)
""",
    ),
    (
        "10-heading",
        "complex numbers, everything counted from the heading's middle",
        """
def sharpen(heading, robot, box, bearing, bound):
    apart_x = max(robot[0], box[0]) > min(robot[1], box[1])
    apart_y = max(robot[2], box[2]) > min(robot[3], box[3])
    if not (apart_x or apart_y):
        return np.array([heading[0], heading[1]])
    mine = np.array([complex(x, y) for x in robot[:2] for y in robot[2:]])
    its = np.array([complex(x, y) for x in box[:2] for y in box[2:]])
    ways = (its[:, None] - mine[None, :]).ravel()
    main = its.mean() - mine.mean()
    rel = np.angle(ways / main)
    mid = (heading[0] + heading[1]) / 2
    told = np.angle(main) - bearing + np.array([rel.min() - bound, rel.max() + bound])
    shift = np.round((mid - told.mean()) / (2 * np.pi)) * 2 * np.pi
    return np.array([max(heading[0], told[0] + shift), min(heading[1], told[1] + shift)])
""",
    ),
]

WRONG = [
    (
        "10-heading",
        "plain min and max of arctan2: torn at the seam",
        """
def sharpen(heading, robot, box, bearing, bound):
    if not (robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]):
        return np.array(heading)
    angles = []
    for x in robot[:2]:
        for y in robot[2:]:
            for u in box[:2]:
                for v in box[2:]:
                    angles.append(np.arctan2(v - y, u - x))
    low, high = min(angles) - bearing - bound, max(angles) - bearing + bound
    turns = 2 * np.pi * np.round((np.mean(heading) - (low + high) / 2) / (2 * np.pi))
    return np.array([max(heading[0], low + turns), min(heading[1], high + turns)])
""",
    ),
    (
        "10-heading",
        "bearing added in place of subtracted",
        """
def sharpen(heading, robot, box, bearing, bound):
    apart = robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]
    if not apart:
        return heading
    u = [box[0] - robot[1], box[1] - robot[0]]
    v = [box[2] - robot[3], box[3] - robot[2]]
    mid = np.arctan2(sum(v), sum(u))
    off = [wrap(np.arctan2(b, a) - mid) for a in u for b in v]
    told = np.array([mid + min(off) + bearing - bound, mid + max(off) + bearing + bound])
    here = np.mean(heading)
    told += here + wrap(told.mean() - here) - told.mean()
    return np.array([max(heading[0], told[0]), min(heading[1], told[1])])
""",
    ),
    (
        "10-heading",
        "overlapping boxes give every direction",
        """
def sharpen(heading, robot, box, bearing, bound):
    u = [box[0] - robot[1], box[1] - robot[0]]
    v = [box[2] - robot[3], box[3] - robot[2]]
    if u[0] <= 0 <= u[1] and v[0] <= 0 <= v[1]:
        return np.array([np.pi, 3 * np.pi])
    mid = np.arctan2(sum(v), sum(u))
    off = [wrap(np.arctan2(b, a) - mid) for a in u for b in v]
    told = np.array([mid + min(off) - bearing - bound, mid + max(off) - bearing + bound])
    here = np.mean(heading)
    told += here + wrap(told.mean() - here) - told.mean()
    return np.array([max(heading[0], told[0]), min(heading[1], told[1])])
""",
    ),
    (
        "10-heading",
        "bound on the wrong side: interval made narrower",
        """
def sharpen(heading, robot, box, bearing, bound):
    apart = robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]
    if not apart:
        return heading
    seen = [
        np.arctan2(v - y, u - x)
        for x in robot[:2]
        for y in robot[2:]
        for u in box[:2]
        for v in box[2:]
    ]
    off = [wrap(angle - seen[0]) for angle in seen]
    right, left = seen[0] + min(off) - bearing + bound, seen[0] + max(off) - bearing - bound
    here, there = (heading[0] + heading[1]) / 2, (right + left) / 2
    turns = here + wrap(there - here) - there
    return np.array([max(heading[0], right + turns), min(heading[1], left + turns)])
""",
    ),
    (
        "10-heading",
        "only equal corners of the two boxes are paired",
        """
def sharpen(heading, robot, box, bearing, bound):
    if not (robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]):
        return np.array(heading)

    def corners(b):
        return np.array([(x, y) for x in b[:2] for y in b[2:]])

    d = corners(box) - corners(robot)
    seen = np.arctan2(d[:, 1], d[:, 0])
    off = wrap(seen - seen[0])
    right = seen[0] + off.min() - bearing - bound
    left = seen[0] + off.max() - bearing + bound
    k = np.round((np.mean(heading) - (right + left) / 2) / (2 * np.pi)) * 2 * np.pi
    return np.array([max(heading[0], right + k), min(heading[1], left + k)])
""",
    ),
    (
        "10-heading",
        "intervals compared on whatever turn they happen to be",
        """
def sharpen(heading, robot, box, bearing, bound):
    if not (robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]):
        return np.array(heading)
    u = [box[0] - robot[1], box[1] - robot[0]]
    v = [box[2] - robot[3], box[3] - robot[2]]
    mid = np.arctan2(sum(v), sum(u))
    off = [wrap(np.arctan2(b, a) - mid) for a in u for b in v]
    width = max(off) - min(off) + 2 * bound
    right = wrap(mid + min(off) - bearing - bound)
    left = right + width
    return np.array([max(heading[0], right), min(heading[1], left)])
""",
    ),
    (
        "10-heading",
        "boxes count as overlapping when they do so in x or in y",
        """
def sharpen(heading, robot, box, bearing, bound):
    overlap_x = robot[0] <= box[1] and box[0] <= robot[1]
    overlap_y = robot[2] <= box[3] and box[2] <= robot[3]
    if overlap_x or overlap_y:
        return np.array(heading)
    mid = np.arctan2(box[2] + box[3] - robot[2] - robot[3], box[0] + box[1] - robot[0] - robot[1])
    off = [
        wrap(np.arctan2(v - y, u - x) - mid)
        for x in robot[:2] for y in robot[2:] for u in box[:2] for v in box[2:]
    ]
    right, left = mid + min(off) - bearing - bound, mid + max(off) - bearing + bound
    k = np.round((np.mean(heading) - (right + left) / 2) / (2 * np.pi)) * 2 * np.pi
    return np.array([max(heading[0], right + k), min(heading[1], left + k)])
""",
    ),
    (
        "10-heading",
        "overlap only noticed if the robot's middle lies in the object's box",
        """
def sharpen(heading, robot, box, bearing, bound):
    x, y = (robot[0] + robot[1]) / 2, (robot[2] + robot[3]) / 2
    if box[0] <= x <= box[1] and box[2] <= y <= box[3]:
        return np.array(heading)
    u = [box[0] - robot[1], box[1] - robot[0]]
    v = [box[2] - robot[3], box[3] - robot[2]]
    mid = np.arctan2(sum(v), sum(u))
    off = [wrap(np.arctan2(b, a) - mid) for a in u for b in v]
    right, left = mid + min(off) - bearing - bound, mid + max(off) - bearing + bound
    k = np.round((np.mean(heading) - (right + left) / 2) / (2 * np.pi)) * 2 * np.pi
    return np.array([max(heading[0], right + k), min(heading[1], left + k)])
""",
    ),
    (
        "10-heading",
        "bearing from middle to middle, the boxes' size forgotten",
        """
def sharpen(heading, robot, box, bearing, bound):
    if not (robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]):
        return np.array(heading)
    dx = (box[0] + box[1] - robot[0] - robot[1]) / 2
    dy = (box[2] + box[3] - robot[2] - robot[3]) / 2
    theta = np.arctan2(dy, dx) - bearing
    here = (heading[0] + heading[1]) / 2
    theta = here + wrap(theta - here)
    return np.array([max(heading[0], theta - bound), min(heading[1], theta + bound)])
""",
    ),
    (
        "10-heading",
        "what is known already is thrown away: no intersection",
        """
def sharpen(heading, robot, box, bearing, bound):
    if not (robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]):
        return np.array(heading)
    u = [box[0] - robot[1], box[1] - robot[0]]
    v = [box[2] - robot[3], box[3] - robot[2]]
    mid = np.arctan2(sum(v), sum(u))
    off = [wrap(np.arctan2(b, a) - mid) for a in u for b in v]
    right = wrap(mid + min(off) - bearing - bound)
    return np.array([right, right + max(off) - min(off) + 2 * bound])
""",
    ),
    (
        "10-heading",
        "heading changed in place",
        """
def sharpen(heading, robot, box, bearing, bound):
    if not (robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]):
        return heading
    u = [box[0] - robot[1], box[1] - robot[0]]
    v = [box[2] - robot[3], box[3] - robot[2]]
    mid = np.arctan2(sum(v), sum(u))
    off = [wrap(np.arctan2(b, a) - mid) for a in u for b in v]
    right, left = mid + min(off) - bearing - bound, mid + max(off) - bearing + bound
    k = np.round((np.mean(heading) - (right + left) / 2) / (2 * np.pi)) * 2 * np.pi
    if right + k > heading[0]:
        heading[0] = right + k
    if left + k < heading[1]:
        heading[1] = left + k
    return heading
""",
    ),
    (
        "10-heading",
        "bearing from the object to the robot",
        """
def sharpen(heading, robot, box, bearing, bound):
    if not (robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]):
        return np.array(heading)
    corners = [(robot[i] - box[j], robot[k] - box[m])
               for i in (0, 1) for j in (0, 1) for k in (2, 3) for m in (2, 3)]
    first = np.arctan2(corners[0][1], corners[0][0])
    off = [wrap(np.arctan2(b, a) - first) for a, b in corners]
    right, left = first + min(off) - bearing - bound, first + max(off) - bearing + bound
    k = np.round((np.mean(heading) - (right + left) / 2) / (2 * np.pi)) * 2 * np.pi
    return np.array([max(heading[0], right + k), min(heading[1], left + k)])
""",
    ),
    (
        "10-heading",
        "both ends of the result wrapped: left may be less than right",
        """
def sharpen(heading, robot, box, bearing, bound):
    if not (robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]):
        return np.array(heading)
    u = [box[0] - robot[1], box[1] - robot[0]]
    v = [box[2] - robot[3], box[3] - robot[2]]
    mid = np.arctan2(sum(v), sum(u))
    off = [wrap(np.arctan2(b, a) - mid) for a in u for b in v]
    right, left = mid + min(off) - bearing - bound, mid + max(off) - bearing + bound
    k = np.round((np.mean(heading) - (right + left) / 2) / (2 * np.pi)) * 2 * np.pi
    return wrap(np.array([max(heading[0], right + k), min(heading[1], left + k)]))
""",
    ),
    (
        "10-heading",
        "told ends counted from the heading's right, from -pi to pi: wide headings torn",
        """
def sharpen(heading, robot, box, bearing, bound):
    if not (robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]):
        return np.array(heading)
    u = [box[0] - robot[1], box[1] - robot[0]]
    v = [box[2] - robot[3], box[3] - robot[2]]
    mid = np.arctan2(sum(v), sum(u))
    off = [wrap(np.arctan2(b, a) - mid) for a in u for b in v]
    width = max(off) - min(off) + 2 * bound
    start = wrap(mid + min(off) - bearing - bound - heading[0])
    whole = heading[1] - heading[0]
    return heading[0] + np.array([max(0.0, start), min(whole, start + width)])
""",
    ),
]
