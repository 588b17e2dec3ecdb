"""Task 14-deskew: the points of a scan of a moving robot, in the frame of its last beam."""

import numpy as np

from classroom.exercises.correctness_laws import Law, equals, once
from classroom.exercises.task import Probe, Task
from course.exercises.ex14_devices_and_live_slam.calls import CALLS
from slamlab.geometry import wrap

TOLERANCE = 1e-6
COUNTED = "counted"
WHOLE = 2 * np.pi


def scans(rng, count=6, beams=12, poses=5, speed=(0.4, 1.5), turn=(1.0, 3.0), empty=2, first=None):
    """Scans of robots that change speed and turn rate from one odometry pose to the next.
    speed [m/s], turn [rad/s] : magnitudes; empty : beams without a return; first : bearing [rad].
    """
    period, begin = rng.uniform(0.1, 0.2, count), rng.uniform(5, 90, count)
    gaps = rng.uniform(0.5, 1.5, (count, beams))  # beams are not evenly spaced
    turned = np.cumsum(gaps, axis=1) - gaps[:, :1]
    turned *= rng.uniform(0.8, 0.97, (count, 1)) * WHOLE / gaps.sum(axis=1, keepdims=True)
    first = rng.uniform(-np.pi, np.pi, (count, 1)) if first is None else np.full((count, 1), first)
    # odometry begins before the scan and ends after it
    steps = rng.uniform(0.6, 1.4, (count, poses)) * period[:, None] * 1.5 / (poses - 1)
    times = np.cumsum(steps, axis=1)
    times += (begin + 0.5 * period - (times[:, 0] + times[:, -1]) / 2)[:, None]
    times[:, 0] = np.minimum(times[:, 0], begin - 0.01)
    times[:, -1] = np.maximum(times[:, -1], begin + period + 0.01)
    dt = np.diff(times, axis=1)
    sign = rng.choice([-1, 1], (2, count, 1))
    d, angle = (
        s * rng.uniform(*of, dt.shape) * dt for s, of in zip(sign, (speed, turn), strict=True)
    )
    begins = rng.uniform(-np.pi, np.pi, (count, 1))
    theta = np.hstack([begins, begins + np.cumsum(angle, axis=1)])
    way = np.cumsum(d[..., None] * _unit(theta[:, :-1] + angle / 2), axis=1)
    xy = rng.uniform(-5, 5, (count, 1, 2)) + np.concatenate([np.zeros((count, 1, 2)), way], axis=1)
    ranges = rng.uniform(0.5, 6, turned.shape)
    # a return is missing anywhere but at an end, where the probe of the ends has them
    inner = rng.permuted(np.tile(np.arange(beams) + 1, (count, 1))[:, : max(beams - 2, 0)], axis=1)
    np.put_along_axis(ranges, inner[:, :empty], np.nan, axis=1)
    return {
        "bearings": wrap(first - turned),
        "ranges": ranges,
        "begin": begin,
        "period": period,
        "times": times,
        "poses": np.dstack([xy, wrap(theta)]),
    }


def _unit(angle):
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def _at_the_seam(rng):
    """Headings that cross ±π within the scan."""
    i = scans(rng, 6, turn=(2.5, 4))
    middle = i["poses"][:, 2:3, 2]
    i["poses"][..., 2] = wrap(i["poses"][..., 2] - middle + np.pi - 0.01)
    return i


def _on_the_spot(rng):
    """Uniform turns away from ±π; scans that begin straight behind the robot."""
    i = scans(rng, 5, poses=2, speed=(0, 0), first=3.1)
    i["poses"][..., 2] = wrap(i["poses"][..., 2] - i["poses"][:, :1, 2])
    return i


def _no_ends(rng):
    i = scans(rng, 5, empty=0)
    i["ranges"][:, [0, -1]] = np.nan
    return i


def _no_return(rng):
    i = scans(rng, 2, 4)
    return i | {"ranges": np.full((2, 4), np.nan)}


def _times(i):
    """Time of each beam (n, k) [s]."""
    turned = np.mod(i["bearings"][:, :1] - i["bearings"], WHOLE)
    return i["begin"][:, None] + i["period"][:, None] * turned / WHOLE


def _poses(i):
    """Pose of the robot at each beam (n, k, 3), with a continuous heading."""
    headings, found = np.unwrap(i["poses"][..., 2], axis=1), []
    for t, times, xy, theta in zip(_times(i), i["times"], i["poses"], headings, strict=True):
        columns = (*xy[:, :2].T, theta)
        found.append(np.column_stack([np.interp(t, times, column) for column in columns]))
    return np.array(found)


@once
def want(i):
    poses, back = _poses(i), np.isfinite(i["ranges"])
    world = poses[..., :2] + i["ranges"][..., None] * _unit(poses[..., 2] + i["bearings"])
    off, c, s = world - poses[:, -1:, :2], *_unit(poses[:, -1:, 2]).transpose(2, 0, 1)
    seen = np.stack([c * off[..., 0] + s * off[..., 1], c * off[..., 1] - s * off[..., 0]], axis=-1)
    points = np.zeros(seen.shape)
    for row, of, here in zip(points, seen, back, strict=True):
        row[: here.sum()] = of[here]
    return {"points": points, "count": back.sum(axis=1).astype(float)}


def _step(i):
    poses = _poses(i)
    return {
        "time of each beam": _times(i),
        "pose at the first beam": poses[:, 0],
        "pose at the last beam": poses[:, -1],
    }


def _law(name, points, says, asks, **more):
    return equals(
        name,
        points,
        says,
        want,
        tolerance=TOLERANCE,
        asks=asks,
        step=_step,
        after=(COUNTED,),
        **more,
    )


def _promised(i):
    """The lidar turns clockwise by less than a revolution, and odometry covers the scan."""
    turned = np.mod(i["bearings"][:, :1] - i["bearings"], WHOLE)
    clockwise = (np.diff(turned, axis=1) > 0).all(axis=1) & (turned[:, -1] < 0.99 * WHOLE)
    covered = (i["times"][:, 0] <= i["begin"]) & (_times(i)[:, -1] <= i["times"][:, -1])
    ascending = (np.diff(i["times"], axis=1) > 0).all(axis=1)
    return clockwise & covered & ascending & (i["period"] > 0)


TURNING, DRIVING = "a robot that turns on the spot", "a robot that drives straight ahead"
BOTH = (COUNTED, "both")

DESKEW = Task(
    id="14-deskew",
    title="Deskewing a scan",
    call=CALLS["14-deskew"],
    inputs=scans,
    shapes=lambda i: {"points": (*i["ranges"].shape, 2), "count": i["begin"].shape},
    laws=(
        Law(
            COUNTED,
            0.5,
            "there is one point for each beam with a return",
            lambda i, o: o["count"] == want(i)["count"],
            want=lambda i: {"count": want(i)["count"]},
            asks="How many beams have a return? With one beam only, what do you divide by?",
            step=lambda i: {"beams with a return": np.isfinite(i["ranges"]).sum(axis=1)},
            alone=False,
        ),
        _law(
            "turning",
            1,
            "the points are right if the robot turns on the spot",
            "By how much has the robot turned between a beam and the last beam? To which side has "
            "a fixed point moved in its frame since then?",
            main=False,
        ),
        _law(
            "driving",
            1,
            "the points are right if the robot drives straight ahead",
            "How long before the last beam was a beam measured, and how far did the robot drive in "
            "this time?",
            main=False,
        ),
        _law(
            "both",
            1.5,
            "the points are right if the robot drives and turns, not always equally fast",
            "Between which two odometry poses is the time of a beam? Which pose is between them?",
        ),
    ),
    probes=(
        Probe(TURNING, _on_the_spot, (COUNTED, "turning")),
        Probe(
            DRIVING, lambda r: scans(r, 5, poses=2, turn=(0, 0), first=3.1), (COUNTED, "driving")
        ),
        Probe("headings that cross ±π", _at_the_seam, BOTH),
        Probe("first and last beams without a return", _no_ends, BOTH),
        Probe(
            "scans that begin straight behind the robot", lambda r: scans(r, 4, first=np.pi), BOTH
        ),
        Probe("two odometry poses", lambda r: scans(r, 4, poses=2), BOTH),
        Probe("a single beam", lambda r: scans(r, 3, 1, empty=0), BOTH),
        Probe("no return at all", _no_return, (COUNTED,)),
    ),
    may_round=_promised,
    begins=(
        "The first beam has the bearing −170°. By which angle has the lidar turned at the bearing "
        "170°, and how long does this take?",
        "Where is a single beam's point in the frame of the odometry, if you know the pose at the "
        "time of this beam?",
    ),
)
