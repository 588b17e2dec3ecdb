"""BOR, a set-membership filter for SLAM: a box for the robot and each landmark (MAK thesis 5.2).

While all noise is within its bounds and all data association is correct, the boxes contain the
truth. A measurement update takes O(1) time, and data association O(N).
"""

from math import isfinite

import numpy as np

from slamlab.filters.argument_checks import vector
from slamlab.filters.set_membership.angle_intervals import (
    angle_interval,
    hull,
    intersection,
    midpoint,
)
from slamlab.filters.set_membership.clipping import overlapping_boxes
from slamlab.filters.set_membership.contraction import EmptyIntersection, contract
from slamlab.filters.set_membership.half_planes import absolute_bearing, edges, landmark_box
from slamlab.filters.set_membership.prediction import predict_box


class BOR:
    """Set-membership (bounded-error) SLAM: a bounding box for the robot and each landmark. Raises
    ValueError.

    Parameters
    ----------
    robot : (4,) initial x_min, x_max, y_min, y_max [m]
    heading : (2,) initial right, left, counter-clockwise [rad]
    landmarks : {id: (4,) box}, a known map, or None
    capacity : int, landmarks to allocate memory for

    ``ambiguous`` counts observations that were ignored because several landmarks overlapped them.
    """

    def __init__(self, robot, heading, landmarks=None, capacity=100):
        self._robot = _checked_box("robot", robot)
        right, left = vector("heading", heading, 2).tolist()
        if right > left:
            raise ValueError(f"heading: right {right} is greater than left {left}; add 2π to left")
        self._heading = angle_interval(right, left)
        self._sides = np.zeros((4, max(capacity, 1)))
        self._row: dict[int, int] = {}  # column of each
        self.ambiguous = 0
        for i, box in (landmarks or {}).items():
            self._add_box(i, _checked_box(f"landmark {i}", box))

    @property
    def robot(self):
        """(4,) the robot's box x_min, x_max, y_min, y_max [m]."""
        return np.array(self._robot)

    @property
    def heading(self):
        """(2,) interval of the heading: right, left ≥ right [rad]."""
        return np.array(self._heading)

    @property
    def pose(self):
        """(3,) pose estimate: midpoints of the robot's box and of its heading [m, m, rad]."""
        x_min, x_max, y_min, y_max = self._robot
        return np.array([(x_min + x_max) / 2, (y_min + y_max) / 2, midpoint(self._heading)])

    @property
    def ids(self):
        """The landmark ids, beginning with the oldest landmark."""
        return list(self._row)

    def __len__(self):
        return len(self._row)

    def __contains__(self, i):
        return i in self._row

    def boxes(self):
        """Return landmark boxes (N, 4) x_min, x_max, y_min, y_max [m], in the order of ``ids``."""
        return self._sides[:, : len(self)].T.copy()

    def predict(self, distance, direction, turn):
        """Predict: move the robot's box and heading by interval arithmetic (see ``prediction``)."""
        named = ("distance", distance), ("direction", direction), ("turn", turn)
        motion = [_checked_interval(*interval) for interval in named]
        self._robot, self._heading = predict_box(self._robot, self._heading, *motion)

    def restrict(self, robot, heading):
        """Intersect robot's box and heading with bounds. Raises EmptyIntersection, ValueError."""
        a, b = self._robot, _checked_box("robot", robot)
        box = max(a[0], b[0]), min(a[1], b[1]), max(a[2], b[2]), min(a[3], b[3])
        other = angle_interval(*vector("heading", heading, 2).tolist())
        pieces = intersection(self._heading, other)
        if box[0] > box[1] or box[2] > box[3] or not pieces:
            raise EmptyIntersection("the robot's box is outside the other bounds")
        self._robot, self._heading = box, hull(pieces)

    def update(self, i, z, bounds):
        """Update by a known landmark: contract boxes and heading. z, bounds : (2,) [m, rad].

        Raises EmptyIntersection and leaves the filter unchanged if a bound is violated.
        """
        if i not in self._row:
            raise ValueError(f"landmark {i} is not in the map: add it instead")
        z, bounds = _checked_observation(z, bounds)
        row = self._row[i]
        box = tuple(self._sides[:, row].tolist())
        try:
            contracted = contract(self._robot, self._heading, box, z, bounds)
        except EmptyIntersection as error:
            raise EmptyIntersection(f"landmark {i}: {error}") from None
        self._robot, self._heading, self._sides[:, row] = contracted

    def add(self, i, z, bounds):
        """Initialise a landmark by the box of its feasible positions. ValueError for a known id."""
        if i in self._row:
            raise ValueError(f"landmark {i} is in the map already: update it instead")
        self._add_box(i, landmark_box(self._robot, self._heading, *_checked_observation(z, bounds)))

    def overlapping(self, z, bounds):
        """Find data association candidates: ids of boxes that overlap the observation (5.2.9)."""
        z, bounds = _checked_observation(z, bounds)
        region = landmark_box(self._robot, self._heading, z, bounds)
        direction, d_abs = absolute_bearing(self._heading, z, bounds)
        lines = edges(z, bounds, direction, d_abs, self._robot)
        ids, boxes = self.ids, self._sides[:, : len(self)]
        return [ids[row] for row in overlapping_boxes(boxes, region, lines)]

    def associate_and_update(self, z, bounds):
        """Associate by overlap, then update; return the landmark's id, or None.

        A single overlapping landmark is updated; if none overlaps, one is added; if several do, the
        observation is ignored (5.2.9 does not define this case, 5.2.10 would add a landmark).
        """
        found = self.overlapping(z, bounds)
        if len(found) > 1:
            self.ambiguous += 1
            return None
        if found:
            self.update(found[0], z, bounds)
            return found[0]
        new = len(self)
        while new in self._row:  # a known map may have any ids
            new += 1
        self.add(new, z, bounds)
        return new

    def _add_box(self, i, box):
        row = len(self)
        if row == self._sides.shape[1]:
            self._sides = np.hstack([self._sides, np.zeros_like(self._sides)])
        self._row[i] = row
        self._sides[:, row] = box


def _checked_box(name, box):
    x_min, x_max, y_min, y_max = vector(name, box, 4).tolist()
    if x_min > x_max or y_min > y_max:
        raise ValueError(f"{name}: expected x_min ≤ x_max and y_min ≤ y_max, got {box}")
    return x_min, x_max, y_min, y_max


def _checked_observation(z, bounds):
    try:
        (r, bearing), (dr, d_beta) = map(float, z), map(float, bounds)
    except (TypeError, ValueError):
        raise ValueError(f"z and bounds must each be range and bearing: {z}, {bounds}") from None
    if not all(map(isfinite, (r, bearing, dr, d_beta))):
        raise ValueError("z or bounds contain NaN or infinity")
    if r <= 0 or dr < 0 or d_beta < 0:
        raise ValueError(f"range must be positive and bounds must not be negative: {z}, {bounds}")
    return (r, bearing), (dr, d_beta)


def _checked_interval(name, value):
    try:
        low, high = map(float, value)
    except (TypeError, ValueError):
        raise ValueError(f"{name} must be an interval of two numbers, not {value!r}") from None
    if not -np.inf < low <= high < np.inf:
        raise ValueError(f"{name}: expected low ≤ high, both finite, got {value}")
    return low, high
