"""Task 02-to-points: a device's readings in the world; the plane is read as x + iy."""

import numpy as np

from slamlab.exercises.drives.ex02 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Probe, Task

TOLERANCE = 1e-6  # [m]
COUNTED = "nothing left out"
"""Name of the law without which nobody knows which point is which reading's."""


def turns(rng, scans=6, readings=20, empty=4, metres=(0.3, 6), offset=1.0, turn=(0.3, 2.8)):
    """Readings of which some did not come back, mounts with an offset and a turn, any poses.

    Parameters
    ----------
    rng : numpy.random.Generator
    scans, readings, empty : int, how many; the last of each scan
    metres, turn : (low, high)
    offset : float, 0 for frames that all stand in one place
    """

    def frames(reach):
        angle = rng.uniform(*turn, scans)
        frame = np.column_stack([offset * rng.uniform(0.3 * reach, reach, (scans, 2)), angle])
        return frame * rng.choice([-1, 1], (scans, 3))

    degrees = np.sort(rng.uniform(0, 360, (scans, readings)), axis=1)
    millimetres = 1000 * rng.uniform(*metres, (scans, readings))
    for row in millimetres:
        row[rng.choice(readings, empty, replace=False)] = 0
    mount, pose = frames(0.4), frames(4.0)
    return {"degrees": degrees, "millimetres": millimetres, "mount": mount, "pose": pose}


def _of(**how):
    return lambda rng: turns(rng, **how)


def _squarely(rng):
    """Readings every 90°, whole metres, and frames that turn by quarters: the text's example."""
    return {
        "degrees": np.tile([0.0, 90.0, 180.0, 270.0, 360.0], (2, 1)),
        "millimetres": np.tile([2000.0, 1000.0, 0.0, 3000.0, 1000.0], (2, 1)),
        "mount": np.array([[-0.2, 0, np.pi], [0.1, 0.2, np.pi / 2]]),
        "pose": np.array([[0, 0, np.pi / 2], [1.0, 2.0, -np.pi / 2]]),
    }


def _in_any_order(rng):
    inputs = turns(rng, 3)
    return inputs | {"degrees": rng.permutation(inputs["degrees"], axis=1)}


def _polar(inputs):
    """(n, k) ranges [m], bearings, counter-clockwise [rad], and which of them came back."""
    r = inputs["millimetres"] / 1000
    return r, -np.radians(inputs["degrees"]), r > 0


def _sensor(inputs):
    """(n, 1) the sensor's place in the world as x + iy, and its heading."""
    (x, y, theta), (dx, dy, turn) = inputs["pose"].T[..., None], inputs["mount"].T[..., None]
    return x + 1j * y + (dx + 1j * dy) * np.exp(1j * theta), theta + turn


def want(inputs):
    """The points that came back, in their order, filled up with zeros as the drive does."""
    (r, beta, came), (place, heading) = _polar(inputs), _sensor(inputs)
    z = place + r * np.exp(1j * (heading + beta))
    first = np.argsort(~came, axis=1, kind="stable")
    z = np.take_along_axis(np.where(came, z, 0), first, axis=1)
    points = np.stack([z.real, z.imag], axis=-1)
    return {"points": points, "count": came.sum(axis=1).astype(float)}


def _found(inputs, outputs):
    """(n, k) complex: the points of readings that came back, whether others were kept; else NaN."""
    z = outputs["points"][..., 0] + 1j * outputs["points"][..., 1]
    found = np.full_like(z, np.nan)
    for row, count, came, to in zip(z, outputs["count"], _polar(inputs)[2], found, strict=True):
        if count == came.sum():
            to[came] = row[: came.sum()]
        elif count == len(came):
            to[came] = row[came]
    return found


def _none_wrong(inputs, off):
    """(n,) whether numbers (n, k, ...) are small where readings came back."""
    came = _polar(inputs)[2].reshape(off.shape[:2] + (1,) * (off.ndim - 2))
    return (~came | (abs(off) < TOLERANCE)).reshape(len(off), -1).all(axis=1)


def _range(inputs, outputs):
    off = abs(_found(inputs, outputs) - _sensor(inputs)[0]) - _polar(inputs)[0]
    return _none_wrong(inputs, off)


def _bearing(inputs, outputs):
    (place, heading), (r, beta, _) = _sensor(inputs), _polar(inputs)
    way = _found(inputs, outputs) - place
    with np.errstate(invalid="ignore"):
        return _none_wrong(inputs, r * (way / abs(way) - np.exp(1j * (heading + beta))))


def _rigid(inputs, outputs):
    def apart(z):
        return abs(z[:, :, None] - z[:, None])

    (r, beta, came), z = _polar(inputs), _found(inputs, outputs)
    off = apart(z) - apart(r * np.exp(1j * beta))
    return _none_wrong(inputs, np.where(came[:, None], off, 0))


def _law(name, points, says, holds, asks, **more):
    return Law(name, points, says, holds, want=want, asks=asks, **more)


def _on_the_way(inputs):
    place, heading = _sensor(inputs)
    return {"the sensor in the world": np.column_stack([place.real, place.imag, heading])}


TO_POINTS = Task(
    id="02-to-points",
    title="What the device says",
    drive=DRIVES["02-to-points"],
    inputs=turns,
    shapes=lambda inputs: {
        "points": (*inputs["degrees"].shape, 2),
        "count": inputs["degrees"].shape[:1],
    },
    laws=(
        _law(
            COUNTED,
            1,
            "there is a point for each reading that came back, and none for the others",
            lambda inputs, outputs: outputs["count"] == _polar(inputs)[2].sum(axis=1),
            "What does the device say where nothing came back, and where would that point lie?",
            alone=False,
        ),
        _law(
            "rigid",
            1,
            "the points, in the readings' order, are as far from each other as the readings say",
            _rigid,
            "In which units are ranges and angles, and which do cosine and sine take?",
            after=(COUNTED,),
        ),
        _law(
            "range",
            1,
            "each point is as far from the sensor's place as measured",
            _range,
            "Where in the world does the sensor stand, when the robot stands at its pose?",
            step=_on_the_way,
            after=(COUNTED,),
        ),
        _law(
            "bearing",
            2,
            "from the sensor's place each point lies where it was seen",
            _bearing,
            "In which direction of the world does the sensor look at 0°, and to which side of it "
            "does it look at 10°?",
            step=_on_the_way,
            after=(COUNTED,),
        ),
    ),
    probes=(
        Probe("no readings", _of(scans=2, readings=0, empty=0)),
        Probe("readings of which none came back", _of(scans=2, readings=5, empty=5)),
        Probe("a single reading", _of(scans=3, readings=1, empty=0)),
        Probe("two readings, one of them empty", _of(scans=3, readings=2, empty=1)),
        Probe("readings whose degrees do not ascend", _in_any_order),
        Probe("a long scan", _of(scans=1, readings=200, empty=20)),
        Probe("readings of one millimetre", _of(scans=2, metres=(0.001, 0.001))),
        Probe("readings of 40 m", _of(scans=2, metres=(20, 40))),
        Probe("robot and sensor at the origin", _of(scans=2, offset=0.0)),
        Probe("frames that turn by more than π", _of(scans=3, turn=(3.3, 6))),
        Probe("whole metres and quarter turns", _squarely),
    ),
)
