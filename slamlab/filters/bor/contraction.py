"""Contraction by constraint propagation: landmark, robot and heading narrow each other in turn.

A box is never bisected: what contraction leaves is kept whole."""

from slamlab.filters.bor.angle_intervals import angle_interval, bearing_interval, hull, intersection
from slamlab.filters.bor.clipping import clip_all
from slamlab.filters.bor.half_planes import absolute_bearing, edges, reversed_edges
from slamlab.filters.bor.intervals import widened, width

MIN_SHRINKAGE = 0.01  # share that some side must shrink by for another round
MAX_ROUNDS = 20  # of constraint propagation for one observation


class EmptyIntersection(ValueError):
    """Inconsistent observation: empty intersection with the boxes; a bound was violated before."""


def contract(robot, heading, box, z, bounds):
    """Contract the boxes by an observation (contractor), until they hardly shrink (5.2.10).

    Parameters
    ----------
    robot, box : (x_min, x_max, y_min, y_max) of the robot and of the landmark [m]
    heading : (right, left) [rad]
    z, bounds : (range, bearing) and their error bounds [m, rad]

    Returns
    -------
    robot, heading, box : none larger than before

    Raises
    ------
    EmptyIntersection
    """
    believed = robot, heading, box
    for _ in range(MAX_ROUNDS):
        contracted = contract_once(*believed, z, bounds)
        shrunk = _has_shrunk(believed, contracted)
        believed = contracted
        if not shrunk:
            break
    return believed


def contract_once(robot, heading, box, z, bounds):
    """One round of constraint propagation: landmark, robot, heading; see :func:`contract`."""
    direction, d_abs = absolute_bearing(heading, z, bounds)
    box = clip_all(box, edges(z, bounds, direction, d_abs, robot))
    if box is None:
        raise _empty("it is seen outside of its box")
    robot = clip_all(robot, reversed_edges(z, bounds, direction, d_abs, box))
    if robot is None:
        raise _empty("the robot would stand outside of its box")
    heading = contract_heading(heading, robot, box, z, bounds)
    if heading is None:
        raise _empty("the robot would look outside of its heading's interval")
    return robot, heading, box


def contract_heading(heading, robot, box, z, bounds):
    """Contract the heading: bearings between two boxes, turned back by β ± d_β (5.2.8).

    θ ∈ bearings − [β − d_β, β + d_β]. An intersection of two pieces is enclosed by one interval.
    Equation (10.10).

    Parameters
    ----------
    heading : (right, left) [rad]
    robot, box : (x_min, x_max, y_min, y_max) of the robot and of the landmark [m]
    z, bounds : (range, bearing) and their error bounds [m, rad]

    Returns
    -------
    (right, left) [rad], never wider; None where nothing is left
    """
    right, left = widened(bearing_interval(robot, box), bounds[1])
    observed = angle_interval(*widened((right - z[1], left - z[1])))
    pieces = intersection(heading, observed)
    return hull(pieces) if pieces else None


def _has_shrunk(before, after):
    """Whether some interval has shrunk by more than MIN_SHRINKAGE."""
    return any(
        width(new[k : k + 2]) < (1 - MIN_SHRINKAGE) * width(old[k : k + 2])
        for old, new in zip(before, after, strict=True)
        for k in range(0, len(old), 2)
    )


def _empty(how):
    return EmptyIntersection(
        f"{how}. A noise was outside its bounds, or another object was seen: from here on no box "
        "can be trusted. Widen the bounds and run again, or check the data association"
    )


once = contract_once  # name in the first edition
