"""BOR: set-membership filter for SLAM; a box (bounds) for robot and each landmark (MAK thesis 5.2).

As long as every noise stays in its bounds and every data association is right, the truth is in the
boxes; there are no correlations. Landmarks are the thesis' objects: four numbers each, and an
observation costs O(1), data association O(N).
"""

from math import isfinite

import numpy as np

from slamlab.filters.argument_checks import vector
from slamlab.filters.bor.angle_intervals import angle_interval, hull, intersection, midpoint
from slamlab.filters.bor.clipping import overlapping_boxes
from slamlab.filters.bor.contraction import EmptyIntersection, contract
from slamlab.filters.bor.half_planes import absolute_bearing, edges, landmark_box
from slamlab.filters.bor.prediction import predict_box


class BOR:
    """Set-membership (bounded-error) SLAM: robot and landmarks (objects), each bounded by a box.

    Parameters
    ----------
    robot : (4,) x_min, x_max, y_min, y_max at the start [m]
    heading : (2,) right, left at the start: counter-clockwise from right to left [rad]
    objects : {id: (4,) box}, a map that is known beforehand, or None
    capacity : int, objects to allocate memory for; more may come

    ``ambiguous`` counts observations that overlapped several objects and were ignored.

    Raises
    ------
    ValueError
    """

    def __init__(self, robot, heading, objects=None, capacity=100):
        self._robot = _checked_box("robot", robot)
        right, left = vector("heading", heading, 2).tolist()
        if right > left:
            raise ValueError(f"heading: right {right} lies beyond left {left}; add 2π to left")
        self._heading = angle_interval(right, left)
        self._sides = np.zeros((4, max(capacity, 1)))
        self._ids: list[int] = []
        self._row: dict[int, int] = {}  # column of each
        self.ambiguous = 0
        for i, box in (objects or {}).items():
            self._add_box(i, _checked_box(f"object {i}", box))

    @property
    def robot(self):
        """(4,) the robot's box x_min, x_max, y_min, y_max [m]."""
        return np.array(self._robot)

    @property
    def heading(self):
        """(2,) interval of the heading: right in (−π, π] and left in [right, right + 2π] [rad]."""
        return np.array(self._heading)

    @property
    def pose(self):
        """(3,) pose estimate: the middle of the robot's box and of its heading [m, m, rad]."""
        x_min, x_max, y_min, y_max = self._robot
        return np.array([(x_min + x_max) / 2, (y_min + y_max) / 2, midpoint(self._heading)])

    @property
    def ids(self):
        """The landmark (object) ids, oldest first."""
        return list(self._ids)

    def __len__(self):
        return len(self._ids)

    def __contains__(self, i):
        return i in self._row

    def boxes(self):
        """(N, 4) landmark boxes x_min, x_max, y_min, y_max, in the order of ``ids`` [m]."""
        return self._sides[:, : len(self._ids)].T.copy()

    def predict(self, distance, direction, turn):
        """Prediction: move the robot's box and heading; landmark boxes stay.

        Parameters
        ----------
        distance, direction, turn : intervals, made by ``steered``, ``wheels`` or ``odometry`` of
            :mod:`slamlab.filters.bor.prediction` [m, rad, rad]

        Raises
        ------
        ValueError
        """
        named = ("distance", distance), ("direction", direction), ("turn", turn)
        motion = [_checked_interval(*interval) for interval in named]
        self._robot, self._heading = predict_box(self._robot, self._heading, *motion)

    def restrict(self, robot, heading):
        """Intersect the robot's box and heading with bounds that are known otherwise.

        Parameters
        ----------
        robot : (4,) x_min, x_max, y_min, y_max [m]
        heading : (2,) right, left [rad]

        Raises
        ------
        EmptyIntersection : nothing was changed
        ValueError
        """
        a, b = self._robot, _checked_box("robot", robot)
        box = max(a[0], b[0]), min(a[1], b[1]), max(a[2], b[2]), min(a[3], b[3])
        other = angle_interval(*vector("heading", heading, 2).tolist())
        pieces = intersection(self._heading, other)
        if box[0] > box[1] or box[2] > box[3] or not pieces:
            raise EmptyIntersection("the robot's box lies outside of what is known otherwise")
        self._robot, self._heading = box, hull(pieces)

    def update(self, i, z, bounds):
        """Measurement update by a known landmark: contract its box, the robot's and the heading.

        Parameters
        ----------
        i : id of the object
        z : (2,) range [m], bearing [rad]
        bounds : (2,) error bounds of range and bearing [m, rad]

        Raises
        ------
        EmptyIntersection : inconsistent: some noise was outside its bounds, or another object was
            seen; nothing was changed
        ValueError : an unknown id, or numbers that are none
        """
        if i not in self._row:
            raise ValueError(f"object {i} is not in the map: add it instead")
        z, bounds = _checked_observation(z, bounds)
        row = self._row[i]
        box = tuple(self._sides[:, row].tolist())
        try:
            believed = contract(self._robot, self._heading, box, z, bounds)
        except EmptyIntersection as error:
            raise EmptyIntersection(f"object {i}: {error}") from None
        self._robot, self._heading, self._sides[:, row] = believed

    def add(self, i, z, bounds):
        """Landmark initialisation: a new object, with the box of all places where it may be.

        Parameters
        ----------
        i : int, a new id
        z, bounds : (2,) range [m], bearing [rad] and their error bounds

        Raises
        ------
        ValueError : an id that is in the map already
        """
        if i in self._row:
            raise ValueError(f"object {i} is in the map already: update it instead")
        self._add_box(i, landmark_box(self._robot, self._heading, *_checked_observation(z, bounds)))

    def overlapping(self, z, bounds):
        """Data association candidates: objects whose boxes meet the observed region (5.2.9).

        Parameters
        ----------
        z, bounds : (2,) range [m], bearing [rad] and their error bounds

        Returns
        -------
        list of ids
        """
        z, bounds = _checked_observation(z, bounds)
        region = landmark_box(self._robot, self._heading, z, bounds)
        direction, d_abs = absolute_bearing(self._heading, z, bounds)
        lines = edges(z, bounds, direction, d_abs, self._robot)
        boxes = self._sides[:, : len(self._ids)]
        return [self._ids[row] for row in overlapping_boxes(boxes, region, lines)]

    def take(self, z, bounds):
        """Process an observation of unknown data association: update, add, or ignore it.

        The region overlaps one object: it is that one. None: a new one. Several: 5.2.9 is silent
        and 5.2.10 would add another object; here the observation is ignored and counted.

        Parameters
        ----------
        z, bounds : (2,) range [m], bearing [rad] and their error bounds

        Returns
        -------
        id, or None where it was ignored

        Raises
        ------
        EmptyIntersection : see :meth:`update`
        """
        found = self.overlapping(z, bounds)
        if len(found) > 1:
            self.ambiguous += 1
            return None
        if found:
            self.update(found[0], z, bounds)
            return found[0]
        new = len(self._ids)
        while new in self._row:  # a map that is known may name its objects as it likes
            new += 1
        self.add(new, z, bounds)
        return new

    def _add_box(self, i, box):
        row = len(self._ids)
        if row == self._sides.shape[1]:
            self._sides = np.hstack([self._sides, np.zeros_like(self._sides)])
        self._row[i] = row
        self._ids.append(i)
        self._sides[:, row] = box


def _checked_box(name, box):
    x_min, x_max, y_min, y_max = vector(name, box, 4).tolist()
    if x_min > x_max or y_min > y_max:
        raise ValueError(f"{name}: expected x_min ≤ x_max, y_min ≤ y_max, got {box}")
    return x_min, x_max, y_min, y_max


def _checked_observation(z, bounds):
    try:
        (r, bearing), (dr, d_beta) = map(float, z), map(float, bounds)
    except (TypeError, ValueError):
        raise ValueError(f"z and bounds are a range and a bearing each: {z}, {bounds}") from None
    if not all(map(isfinite, (r, bearing, dr, d_beta))):
        raise ValueError("z or bounds hold NaN or infinity")
    if r <= 0 or dr < 0 or d_beta < 0:
        raise ValueError(f"a range is positive, bounds are not negative: {z}, {bounds}")
    return (r, bearing), (dr, d_beta)


def _checked_interval(name, value):
    try:
        low, high = map(float, value)
    except (TypeError, ValueError):
        raise ValueError(f"{name} is an interval of two numbers, not {value!r}") from None
    if not -np.inf < low <= high < np.inf:
        raise ValueError(f"{name}: expected low ≤ high, both finite, got {value}")
    return low, high
