# %% way: the box of differences
def sharpen(heading, robot, box, bearing, bound):
    x, y = (box[0] - robot[1], box[1] - robot[0]), (box[2] - robot[3], box[3] - robot[2])
    if x[0] <= 0 <= x[1] and y[0] <= 0 <= y[1]:
        return np.array(heading)
    seen = np.array([complex(u, v) for u in x for v in y])
    middle = complex(sum(x), sum(y))
    off = np.angle(seen / middle)
    straight = np.angle(middle) - bearing
    here = np.mean(heading)
    straight = here + np.angle(np.exp(1j * (straight + off.min() / 2 + off.max() / 2 - here)))
    half = (off.max() - off.min()) / 2 + bound
    return max(heading[0], straight - half), min(heading[1], straight + half)

# %% way: counted from right
def sharpen(heading, robot, box, bearing, bound):
    if (robot[1] >= box[0] and box[1] >= robot[0]) and (robot[3] >= box[2] and box[3] >= robot[2]):
        return heading.copy()
    places = [(x, y) for x in robot[:2] for y in robot[2:]]
    targets = [(x, y) for x in box[:2] for y in box[2:]]
    seen = np.array([np.arctan2(v - y, u - x) for x, y in places for u, v in targets])
    off = wrap(seen - seen[0])
    first, wide = seen[0] + off.min() - bearing - bound, np.ptp(off) + 2 * bound
    behind = (first - heading[0]) % (2 * np.pi)
    if behind > heading[1] - heading[0] + 1e-9:
        behind -= 2 * np.pi
    low, high = max(0, behind), min(heading[1] - heading[0], behind + wide)
    return heading[0] + np.array([low, high])

# %% way: turns rounded
def sharpen(heading, robot, box, bearing, bound):
    apart = robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]
    if apart:
        dx, dy = np.meshgrid([box[0] - robot[1], box[1] - robot[0]], [box[2] - robot[3], box[3] - robot[2]])
        middle = np.arctan2(dy.mean(), dx.mean())
        off = wrap(np.arctan2(dy, dx) - middle)
        right, left = middle + off.min() - bearing - bound, middle + off.max() - bearing + bound
        turns = 2 * np.pi * np.round((np.mean(heading) - (right + left) / 2) / (2 * np.pi))
        heading = [max(heading[0], right + turns), min(heading[1], left + turns)]
    return np.array(heading)

# %% way: turned so that the heading is 0
def sharpen(heading, robot, box, bearing, bound):
    if not (robot[1] < box[0] or box[1] < robot[0] or robot[3] < box[2] or box[3] < robot[2]):
        return list(heading)
    middle, half = (heading[0] + heading[1]) / 2, (heading[1] - heading[0]) / 2
    ahead = [(box[0] + box[1] - robot[0] - robot[1]), (box[2] + box[3] - robot[2] - robot[3])]
    toward = np.arctan2(ahead[1], ahead[0])
    c, s = np.cos(toward), np.sin(toward)
    off = []
    for dx in (box[0] - robot[1], box[1] - robot[0]):
        for dy in (box[2] - robot[3], box[3] - robot[2]):
            off.append(np.arctan2(c * dy - s * dx, c * dx + s * dy))
    right, left = min(off) - bound, max(off) + bound
    between = wrap(float(toward - bearing - middle + (right + left) / 2)) - (right + left) / 2
    return [middle + max(-half, between + right), middle + min(half, between + left)]

# %% right: complex numbers, everything counted from the heading's middle
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

# %% wrong: overlap only noticed if the robot's middle lies in the object's box
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

# %% wrong: heading changed in place
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
