"""What one sighting says of object, robot and heading, each sharpened by the others in turn."""

from slamlab.filters.bor.angles import angles, bearings, enclosing, intersection
from slamlab.filters.bor.clip import clipped
from slamlab.filters.bor.edges import edges, reversed_edges, sighting
from slamlab.filters.bor.intervals import widened, width

NOTICEABLE = 0.01  # share that some side must shrink by for another round
ROUNDS = 20


class EmptyIntersection(ValueError):
    """A sighting and what is believed have nothing in common: the guarantee was broken before."""


def sharpened(robot, heading, box, z, bounds):
    """The boxes after a sighting, again and again while they noticeably shrink (5.2.10).

    Parameters
    ----------
    robot, box : (x_min, x_max, y_min, y_max) of the robot and of what it sees [m]
    heading : (right, left) [rad]
    z, bounds : (range, bearing) and the most that they are off [m, rad]

    Returns
    -------
    robot, heading, box : none larger than before

    Raises
    ------
    EmptyIntersection
    """
    believed = robot, heading, box
    for _ in range(ROUNDS):
        sharper = once(*believed, z, bounds)
        shrunk = _noticeably(believed, sharper)
        believed = sharper
        if not shrunk:
            break
    return believed


def once(robot, heading, box, z, bounds):
    """One round: object, then robot, then heading; see :func:`sharpened`."""
    direction, d_abs = sighting(heading, z, bounds)
    box = clipped(box, edges(z, bounds, direction, d_abs, robot))
    if box is None:
        raise _empty("it is seen outside of its box")
    robot = clipped(robot, reversed_edges(z, bounds, direction, d_abs, box))
    if robot is None:
        raise _empty("the robot would stand outside of its box")
    heading = oriented(heading, robot, box, z, bounds)
    if heading is None:
        raise _empty("the robot would look outside of its heading's interval")
    return robot, heading, box


def oriented(heading, robot, box, z, bounds):
    """The heading after a sighting: all bearings between two boxes, turned back by β ± d_β (5.2.8).

    θ ∈ bearings − [β − d_β, β + d_β]. An intersection of two pieces is enclosed by one interval.

    Parameters
    ----------
    heading : (right, left) [rad]
    robot, box : (x_min, x_max, y_min, y_max) of the robot and of what it sees [m]
    z, bounds : (range, bearing) and the most that they are off [m, rad]

    Returns
    -------
    (right, left) [rad], never wider; None where nothing is left
    """
    right, left = widened(bearings(robot, box), bounds[1])
    told = angles(*widened((right - z[1], left - z[1])))
    pieces = intersection(heading, told)
    return enclosing(pieces) if pieces else None


def _noticeably(before, after):
    """Whether some interval has shrunk by more than a noticeable share."""
    return any(
        width(new[k : k + 2]) < (1 - NOTICEABLE) * width(old[k : k + 2])
        for old, new in zip(before, after, strict=True)
        for k in range(0, len(old), 2)
    )


def _empty(how):
    return EmptyIntersection(
        f"{how}. A noise was outside its bounds, or another object was seen: from here on no box "
        "can be trusted. Widen the bounds and run again, or see that sightings are told apart"
    )
