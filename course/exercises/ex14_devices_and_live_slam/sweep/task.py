"""Task 14-sweep, the applied task: decode the packets of a lidar that the lesson does not show.

A packet: 0x54, number of points, first angle, three bytes for each point, last angle, and the sum
of these bytes modulo 256. The angles are evenly spaced.
"""

import numpy as np

from classroom.exercises.correctness_laws import Law
from classroom.exercises.task import Probe, Task
from course.exercises.ex14_devices_and_live_slam.calls import CALLS

PACKETS = 10
SUMS = (  # each checksum is also right by another, wrong rule
    (0, 0, [[90, 3]]),
    (0, 0, [[168, 0]]),
    (0, 0, [[170, 1]]),
    (85, 0, [[300, 7], [600, 9]]),
)
HEAD, TURN = 0x54, 36000
EXACT = 1e-9  # [rad, m]: a dozen roundings of numbers below 400 and 70


def packet(first, turned, points, head=HEAD, count=None, end=()):
    """Encode a packet with the right checksum.
    first, turned : first angle, and angle between first and last point [1/100°]; points : (n, 2)
    distance [mm] and strength; head, count : bytes 0 and 1; end : bytes before the checksum.
    """
    data = [head, len(points) if count is None else count, *_word(first)]
    for distance, strength in points:
        data += [*_word(distance), int(strength)]
    data += [*_word((first + turned) % TURN), *end]
    return [*data, sum(data) % 256]


def _word(number):
    return int(number) % 256, int(number) // 256


def _points(rng, n, empty=1):
    """Return (n, 2) points, some without an echo, independent of their strength."""
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
    """Packets, some across 0°, some corrupted: {"data": (n, k), −1 after the end}."""
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
    return lambda rng: _filled([packet(*each) for each in make(rng)])


def _damaged(rng):
    """Packets with one fault each; only the last ones have a wrong checksum."""
    first, turned = rng.integers(3000, 30000), rng.integers(1100, 2500)
    wrong = [{"head": HEAD + 1}, {"head": HEAD - 1}, {"head": 0}, {"count": 4}, {"count": 6}]
    made = [packet(first, turned, _points(rng, 5), **each) for each in [*wrong, {"end": [7]}]]
    made.append([*packet(first, turned, _points(rng, 5)), 7])
    sums = [packet(first, turned, _points(rng, 5)) for _ in range(2)]
    for each, off in zip(sums, (1, 128), strict=True):
        each[-1] = (each[-1] + off) % 256
    return _filled([*made, *sums])


def one(data):
    """Decode a packet to (n, 2): angle [°, clockwise], distance [m]; None if corrupted."""
    n = data[1]
    if data[0] != HEAD or len(data) != 3 * n + 7 or sum(data[:-1]) % 256 != data[-1]:
        return None
    first, last = data[2] + 256 * data[3], data[-3] + 256 * data[-2]
    points = np.reshape(data[4:-3], (n, 3))
    angle = first + np.arange(n) * ((last - first) % TURN) / max(n - 1, 1)
    distance = (points[:, 0] + 256 * points[:, 1]) / 1000
    return np.column_stack([angle / 100, distance])


def whole(i):
    """Return the decoded points of each packet, None for a corrupted packet."""
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
    """Return (n, m, 2) the returned rows that are wanted, NaN if unknown."""
    want = _wanted(i)
    found = np.full(want["rays"].shape, np.nan)
    for k, (said, count) in enumerate(zip(whole(i), o["count"], strict=True)):
        if said is not None and o["taken"][k] and count in (len(said), want["count"][k]):
            rays = o["rays"][k, : int(count)]
            rays = rays[said[:, 1] > 0] if count == len(said) else rays
            found[k, : len(rays)] = rays
    return found


def _ray_law(column):
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
    """Return which packets were accepted, the numbers of rows, and both columns."""
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
        "number of bytes that byte 1 requires": 3 * data[1] + 7,
        "sum of all bytes but the last": sum(data[:-1]),
        "angle of the first point": data[2] + 256 * data[3],
        "angle of the last point": data[-3] + 256 * data[-2],
    }


SWEEP = Task(
    id="14-sweep",
    title="Decode the packets of another lidar",
    call=CALLS["14-sweep"],
    inputs=inputs,
    shapes=lambda i: {
        "taken": (len(i["data"]),),
        "count": (len(i["data"]),),
        "received": (len(i["data"]),),
        "rays": (len(i["data"]), i["data"].shape[1] // 3, 2),
    },
    laws=(
        Law(
            "damage refused",
            1,
            "the result is None for corrupted packets, and for no others",
            lambda i, o: (o["taken"] > 0) == _good(i),
            _wanted,
            asks="A packet can have three faults. Which of your conditions detects which fault? "
            "Is the checksum itself part of the sum?",
            step=_steps,
        ),
        Law(
            "nothing left out",
            1,
            "there is one row for each point with an echo, and none for the others",
            lambda i, o: (o["count"] == _wanted(i)["count"]) & (o["taken"] > 0) | ~_good(i),
            _wanted,
            asks="How many points does byte 1 announce, and how does a packet mark a point "
            "without an echo?",
            step=_steps,
            after=("damage refused",),
        ),
        Law(
            "range",
            1,
            "each range equals the distance that was sent [m]",
            _ray_law(1),
            _wanted,
            asks="At which byte does the third point begin, and how many millimetres are one "
            "metre?",
            step=_steps,
            after=("damage refused", "nothing left out"),
        ),
        Law(
            "angle",
            3,
            "each angle equals the one at which the point was measured, counter-clockwise [rad]",
            _ray_law(0),
            _wanted,
            asks="Draw a packet of four points, the first at 350° and the last at 20°. How many "
            "intervals are between them, and how large is one? Where is the third point if the "
            "second has no echo?",
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
            "no echo at all",
            _probe(lambda rng: [(777, 900, [[0, 5]] * 3), (35990, 0, [[0, 0]])]),
        ),
        Probe(
            "points without an echo at both ends",
            _probe(lambda rng: [(35000, 1500, [[0, 7], *_points(rng, 4, 1), [0, 0]])]),
        ),
        Probe(
            "more than half a revolution",
            _probe(lambda rng: [(rng.integers(TURN), 24000, _points(rng, 9))]),
        ),
        Probe(
            "a lidar that does not turn",
            _probe(lambda rng: [(rng.integers(TURN), 0, _points(rng, 4))]),
        ),
        Probe(
            "many points", _probe(lambda rng: [(rng.integers(TURN), 9000, _points(rng, 255, 20))])
        ),
        Probe(
            "the shortest and the longest distance",
            _probe(lambda rng: [(0, 300, [[1, 1], [255, 0], [256, 2], [65535, 3]])]),
        ),
        Probe("packets with one fault each", _damaged),
        Probe("small sums and a sum of 256", _probe(lambda rng: SUMS)),
    ),
    parts=parts,
    may_round=False,
    begins=(
        "How many bytes has a packet of two points, and which of them is the checksum?",
        "A packet has three points, the first at 10° and the last at 20°. At which "
        "angle is the second one?",
    ),
)
