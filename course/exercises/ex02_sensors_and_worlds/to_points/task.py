"""Task 02-to-points: a device's readings in the world frame; points are complex numbers x + iy."""

import numpy as np

from classroom.exercises.correctness_laws import Law
from classroom.exercises.task import Probe, Task
from course.exercises.ex02_sensors_and_worlds.calls import CALLS

TOLERANCE = 1e-6  # [m]
COUNTED = "nothing left out"
"""Name of the law that must hold before points can be assigned to readings."""


def turns(rng, scans=6, readings=20, empty=4, metres=(0.3, 6), offset=1.0, turn=(0.3, 2.8)):
    """Readings, ``empty`` of each scan lost; with offset 0 all frames share one origin."""

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
    # the text's example
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
    """(n, k) ranges [m], bearings [rad], which came back."""
    r = inputs["millimetres"] / 1000
    return r, -np.radians(inputs["degrees"]), r > 0


def _sensor(inputs):
    """(n, 1) the sensor's position in the world as x + iy, and heading."""
    (x, y, theta), (dx, dy, turn) = inputs["pose"].T[..., None], inputs["mount"].T[..., None]
    return x + 1j * y + (dx + 1j * dy) * np.exp(1j * theta), theta + turn


def want(inputs):
    """Points that came back, padded with zeros as the drive does."""
    (r, beta, came), (place, heading) = _polar(inputs), _sensor(inputs)
    z = place + r * np.exp(1j * (heading + beta))
    first = np.argsort(~came, axis=1, kind="stable")
    z = np.take_along_axis(np.where(came, z, 0), first, axis=1)
    points = np.stack([z.real, z.imag], axis=-1)
    return {"points": points, "count": came.sum(axis=1).astype(float)}


def _found(inputs, outputs):
    """(n, k) complex: the returned point of each valid reading, else NaN."""
    z = outputs["points"][..., 0] + 1j * outputs["points"][..., 1]
    found = np.full_like(z, np.nan)
    for row, count, came, to in zip(z, outputs["count"], _polar(inputs)[2], found, strict=True):
        if count == came.sum():
            to[came] = row[: came.sum()]
        elif count == len(came):
            to[came] = row[came]
    return found


def _none_wrong(inputs, off):
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
    return {"sensor pose in the world frame": np.column_stack([place.real, place.imag, heading])}


def _returned(inputs):
    return {"number of readings with a return": (inputs["millimetres"] > 0).sum(axis=1)[:1]}


def _in_metres(inputs):
    return {"ranges [m]": inputs["millimetres"][0] / 1000}


TO_POINTS = Task(
    id="02-to-points",
    title="From device readings to the world frame",
    call=CALLS["02-to-points"],
    inputs=turns,
    shapes=lambda inputs: {
        "points": (*inputs["degrees"].shape, 2),
        "count": inputs["degrees"].shape[:1],
    },
    laws=(
        _law(
            COUNTED,
            1,
            "there is one point for each reading with a return, and none for the others",
            lambda inputs, outputs: outputs["count"] == _polar(inputs)[2].sum(axis=1),
            "Which range does the device report for no return, and where would such a point lie?",
            alone=False,
            step=_returned,
        ),
        _law(
            "rigid",
            1,
            "the distances between the points agree with the readings, in their order",
            _rigid,
            "Which units do ranges and bearings have, and which unit do sine and cosine use?",
            after=(COUNTED,),
            step=_in_metres,
        ),
        _law(
            "range",
            1,
            "the distance of each point from the sensor is the measured range",
            _range,
            "What is the position of the sensor in the world frame, if the robot is at `pose`?",
            step=_on_the_way,
            after=(COUNTED,),
        ),
        _law(
            "bearing",
            2,
            "the direction of each point from the sensor agrees with the measured bearing",
            _bearing,
            "Which direction in the world frame has the bearing 0°, and on which side of this "
            "direction is 10°?",
            step=_on_the_way,
            after=(COUNTED,),
        ),
    ),
    probes=(
        Probe("no readings", _of(scans=2, readings=0, empty=0)),
        Probe("readings without any return", _of(scans=2, readings=5, empty=5)),
        Probe("a single reading", _of(scans=3, readings=1, empty=0)),
        Probe("two readings, one without a return", _of(scans=3, readings=2, empty=1)),
        Probe("bearings in any order", _in_any_order),
        Probe("a long scan", _of(scans=1, readings=200, empty=20)),
        Probe("readings of one millimetre", _of(scans=2, metres=(0.001, 0.001))),
        Probe("readings of 40 m", _of(scans=2, metres=(20, 40))),
        Probe("robot and sensor at the origin", _of(scans=2, offset=0.0)),
        Probe("frames with angles beyond π", _of(scans=3, turn=(3.3, 6))),
        Probe("whole metres and quarter turns", _squarely),
    ),
    begins=(
        "Where does a reading of 1 m at the bearing 90° lie in the sensor frame?",
        "Through which frames does a point go on its way from the sensor to the world?",
    ),
)
