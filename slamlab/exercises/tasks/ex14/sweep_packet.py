"""Exercise 14, the applied task: rays of a lidar whose packets the lesson has not seen.

A packet: 0x54, how many points, the first one's angle, three bytes a point, the last one's angle,
and the sum of all of these modulo 256. Angles between the two lie evenly.
"""

import numpy as np

from slamlab.exercises.drives.ex14 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Probe, Task

PACKETS = 10
SUMS = (  # each is as it should be by another, wrong rule, too
    (0, 0, [[90, 3]]),
    (0, 0, [[168, 0]]),
    (0, 0, [[170, 1]]),
    (85, 0, [[300, 7], [600, 9]]),
)
HEAD, TURN = 0x54, 36000
EXACT = 1e-9  # [rad, m]: a dozen roundings of numbers below 400 and 70


def packet(first, turned, points, head=HEAD, count=None, end=()):
    """The bytes of a packet, with the right sum.

    Parameters
    ----------
    first, turned : int, angle of the first point, and from there to the last one [1/100 degree]
    points : (n, 2) int, distance [mm] and strength
    head, count : int, what stands in bytes 0 and 1; None: how many points there are
    end : some bytes more, before the sum

    Returns
    -------
    list of int
    """
    data = [head, len(points) if count is None else count, *_word(first)]
    for distance, strength in points:
        data += [*_word(distance), int(strength)]
    data += [*_word((first + turned) % TURN), *end]
    return [*data, sum(data) % 256]


def _word(number):
    return int(number) % 256, int(number) // 256


def _points(rng, n, empty=1):
    """(n, 2) points of which some did not come back; the strength does not say which ones."""
    points = np.column_stack([rng.integers(300, 65536, n), rng.integers(1, 256, n)])
    points[rng.permutation(n)[:2], 1] = 0
    points[rng.permutation(n)[:empty], 0] = 0
    return points


def _filled(packets):
    data = np.full((len(packets), max(map(len, packets))), -1)
    for row, each in zip(data, packets, strict=True):
        row[: len(each)] = each
    return {"data": data}


def inputs(rng):
    """Packets of which some pass 0° and some are damaged, each in another way.

    Parameters
    ----------
    rng : numpy.random.Generator

    Returns
    -------
    {"data": (n, k) bytes, -1 behind the end}
    """
    told = []
    for k in range(PACKETS):
        turned = rng.integers(1100, 2500)
        first = TURN - turned // 3 if k % 2 else rng.integers(3000, 30000)
        told.append((first, turned, _points(rng, rng.integers(5, 9), 1 + k // 2 % 2)))
    made = [packet(*each) for each in told]
    made[0][5] = (made[0][5] + rng.integers(1, 256)) % 256
    made[1] = packet(*told[1], head=rng.integers(1, HEAD))
    made[2] = packet(*told[2], count=len(told[2][2]) + 1)
    made[3] = packet(*told[3], count=len(told[3][2]) - 1)
    return _filled([made[k] for k in rng.permutation(PACKETS)])


def _probe(make):
    """Inputs of a few packets: ``make(rng)`` gives their arguments."""
    return lambda rng: _filled([packet(*each) for each in make(rng)])


def _damaged(rng):
    """Packets with one thing wrong, whose sum is right but for the last ones."""
    first, turned = rng.integers(3000, 30000), rng.integers(1100, 2500)
    wrong = [{"head": HEAD + 1}, {"head": HEAD - 1}, {"head": 0}, {"count": 4}, {"count": 6}]
    made = [packet(first, turned, _points(rng, 5), **each) for each in [*wrong, {"end": [7]}]]
    made.append([*packet(first, turned, _points(rng, 5)), 7])
    sums = [packet(first, turned, _points(rng, 5)) for _ in range(2)]
    for each, off in zip(sums, (1, 128), strict=True):
        each[-1] = (each[-1] + off) % 256
    return _filled([*made, *sums])


def one(data):
    """(n, 2) of a whole packet: angle [degree, clockwise], distance [m]; None of a damaged one."""
    n = data[1]
    if data[0] != HEAD or len(data) != 3 * n + 7 or sum(data[:-1]) % 256 != data[-1]:
        return None
    first, last = data[2] + 256 * data[3], data[-3] + 256 * data[-2]
    points = np.reshape(data[4:-3], (n, 3))
    angle = first + np.arange(n) * ((last - first) % TURN) / max(n - 1, 1)
    distance = (points[:, 0] + 256 * points[:, 1]) / 1000
    return np.column_stack([angle / 100, distance])


def whole(i):
    """What each packet says, None where it is damaged."""
    return [one(data[data >= 0].tolist()) for data in i["data"].astype(int)]


def _good(i):
    return np.array([each is not None for each in whole(i)])


def _wanted(i):
    said = whole(i)
    rays = np.zeros((len(said), i["data"].shape[1] // 3, 2))
    came = [np.zeros((0, 2)) if each is None else each[each[:, 1] > 0] for each in said]
    for row, each in zip(rays, came, strict=True):
        row[: len(each)] = np.column_stack([_wrapped(-np.radians(each[:, 0])), each[:, 1]])
    count = np.array([float(len(each)) for each in came])
    return {"taken": _good(i).astype(float), "count": count, "rays": rays}


def _wrapped(angle):
    return np.remainder(angle + np.pi, 2 * np.pi) - np.pi


def read(i, o):
    """(n, m, 2) what came back of the rays that are wanted, NaN where that is not known."""
    want = _wanted(i)
    found = np.full(want["rays"].shape, np.nan)
    for k, (said, count) in enumerate(zip(whole(i), o["count"], strict=True)):
        if said is not None and o["taken"][k] and count in (len(said), want["count"][k]):
            rays = o["rays"][k, : int(count)]
            rays = rays[said[:, 1] > 0] if count == len(said) else rays
            found[k, : len(rays)] = rays
    return found


def _ray_law(column):
    """Per packet: whether a column of its rays is as it was sent, angles modulo 2π."""

    def holds(i, o):
        want = _wanted(i)
        off = (read(i, o) - want["rays"])[..., column]
        off = np.abs(_wrapped(off) if column == 0 else off) <= EXACT
        beyond = np.arange(off.shape[1]) >= want["count"][:, None]
        read_at_all = (o["taken"] > 0) & ((o["count"] == want["count"]) | (o["count"] == _slots(i)))
        return ((off | beyond).all(axis=1) & read_at_all) | ~_good(i)

    return holds


def _slots(i):
    return np.array([0 if each is None else len(each) for each in whole(i)])


def parts(i, o):
    """Which packets were taken, how many rays, and both columns, angles as a direction."""
    angle, distance = np.moveaxis(read(i, o), -1, 0)
    direction = np.stack([np.cos(angle), np.sin(angle)])
    columns = {"angle": direction, "range": distance}
    return {"taken": o["taken"], "count": o["count"]} | {
        name: np.nan_to_num(column, nan=-9.0) for name, column in columns.items()
    }


def _steps(i):
    data = i["data"][0][i["data"][0] >= 0].astype(int).tolist()
    return {
        "bytes": len(data),
        "bytes asked for by byte 1": 3 * data[1] + 7,
        "sum of all but the last": sum(data[:-1]),
        "angle of the first point": data[2] + 256 * data[3],
        "angle of the last point": data[-3] + 256 * data[-2],
    }


SWEEP = Task(
    id="14-sweep",
    title="A lidar that the lesson has not seen",
    drive=DRIVES["14-sweep"],
    inputs=inputs,
    shapes=lambda i: {
        "taken": (len(i["data"]),),
        "count": (len(i["data"]),),
        "heard": (len(i["data"]),),
        "rays": (len(i["data"]), i["data"].shape[1] // 3, 2),
    },
    laws=(
        Law(
            "damage refused",
            1,
            "None comes back for packets that are damaged, and for no others",
            lambda i, o: (o["taken"] > 0) == _good(i),
            _wanted,
            asks="Three things can be wrong with a packet. Which of them does each of your "
            "conditions look at, and is it the sum of all bytes or of all but one?",
            step=_steps,
        ),
        Law(
            "nothing left out",
            1,
            "there is a ray for each point that came back, and none for the others",
            lambda i, o: (o["count"] == _wanted(i)["count"]) & (o["taken"] > 0) | ~_good(i),
            _wanted,
            asks="How many points does byte 1 promise, and how does a point say that it did not "
            "come back?",
            step=_steps,
            after=("damage refused",),
        ),
        Law(
            "range",
            1,
            "each ray is as long as was sent [m]",
            _ray_law(1),
            _wanted,
            asks="At which bytes does the third point begin, and how many millimetres are in a "
            "metre?",
            step=_steps,
            after=("damage refused", "nothing left out"),
        ),
        Law(
            "angle",
            3,
            "each ray has the angle at which it was taken, counter-clockwise [rad]",
            _ray_law(0),
            _wanted,
            asks="Draw a packet of four points, the first at 350° and the last at 20°: how many "
            "gaps are between them, how wide is one, and which point is the third if the second "
            "did not come back?",
            step=_steps,
            after=("damage refused", "nothing left out"),
        ),
    ),
    probes=(
        Probe(
            "a single point",
            _probe(lambda rng: [(rng.integers(TURN), 0, [[rng.integers(300, 9000), 9]])]),
        ),
        Probe("two points", _probe(lambda rng: [(rng.integers(9000), 150, _points(rng, 2, 0))])),
        Probe(
            "nothing that came back",
            _probe(lambda rng: [(777, 900, [[0, 5]] * 3), (35990, 0, [[0, 0]])]),
        ),
        Probe(
            "gaps at both ends",
            _probe(lambda rng: [(35000, 1500, [[0, 7], *_points(rng, 4, 1), [0, 0]])]),
        ),
        Probe(
            "more than half a turn",
            _probe(lambda rng: [(rng.integers(TURN), 24000, _points(rng, 9))]),
        ),
        Probe(
            "a lidar that stands still",
            _probe(lambda rng: [(rng.integers(TURN), 0, _points(rng, 4))]),
        ),
        Probe(
            "many points", _probe(lambda rng: [(rng.integers(TURN), 9000, _points(rng, 255, 20))])
        ),
        Probe(
            "the shortest and the longest way",
            _probe(lambda rng: [(0, 300, [[1, 1], [255, 0], [256, 2], [65535, 3]])]),
        ),
        Probe("packets with one thing wrong", _damaged),
        Probe("small sums and sums of 256", _probe(lambda rng: SUMS)),
    ),
    parts=parts,
    rounds=False,
)
