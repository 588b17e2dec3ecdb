"""Contraction by constraint propagation: bounds of landmark, robot and heading in turn."""

from slamlab.filters.set_membership.angle_intervals import (
    angle_interval,
    bearing_interval,
    hull,
    intersection,
)
from slamlab.filters.set_membership.clipping import clip_all
from slamlab.filters.set_membership.half_planes import absolute_bearing, edges, reversed_edges
from slamlab.filters.set_membership.intervals import widened, width

MIN_SHRINKAGE = 0.01  # least relative shrinkage of a side for another iteration [1]
MAX_ITERATIONS = 20  # of constraint propagation for one observation


class EmptyIntersection(ValueError):
    """The intersection of an observation with the boxes is empty, so a bound was violated."""


def contract(robot, heading, box, z, bounds):
    """Contract robot, heading and landmark by an observation until they hardly shrink (5.2.10)."""
    bounded = robot, heading, box
    for _ in range(MAX_ITERATIONS):
        contracted = contract_once(*bounded, z, bounds)
        shrunk = _has_shrunk(bounded, contracted)
        bounded = contracted
        if not shrunk:
            break
    return bounded


def contract_once(robot, heading, box, z, bounds):
    """Contract landmark, robot and heading once (constraint propagation); see :func:`contract`."""
    direction, d_abs = absolute_bearing(heading, z, bounds)
    box = clip_all(box, edges(z, bounds, direction, d_abs, robot))
    if box is None:
        raise _empty("the observation is outside the landmark's box")
    robot = clip_all(robot, reversed_edges(z, bounds, direction, d_abs, box))
    if robot is None:
        raise _empty("the robot would be outside its box")
    heading = contract_heading(heading, robot, box, z, bounds)
    if heading is None:
        raise _empty("the heading would be outside its interval")
    return robot, heading, box


def contract_heading(heading, robot, box, z, bounds):
    """Contract the heading to bearings between the boxes − (β ± d_β) (5.2.8). Equation (10.10)."""
    right, left = widened(bearing_interval(robot, box), bounds[1])
    observed = angle_interval(*widened((right - z[1], left - z[1])))
    pieces = intersection(heading, observed)
    return hull(pieces) if pieces else None


def _has_shrunk(before, after):
    return any(
        width(new[k : k + 2]) < (1 - MIN_SHRINKAGE) * width(old[k : k + 2])
        for old, new in zip(before, after, strict=True)
        for k in range(0, len(old), 2)
    )


def _empty(how):
    return EmptyIntersection(
        f"{how}. A noise value exceeded its bounds, or the data association is wrong. From here "
        "on the boxes are not guaranteed. Widen the bounds and run again, or check the data "
        "association"
    )
