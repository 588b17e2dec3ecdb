"""BOR: the robot's box, a box per object, and no correlation between any two (MAK thesis 5.2).

As long as every noise stays inside its bounds and every sighting is of the object it is taken for,
the truth is in the boxes. Four numbers an object; what a sighting costs hangs on N only where it
has to be found out which object was seen.
"""

from math import isfinite

import numpy as np

from slamlab.filters.bor.angles import angles, middle
from slamlab.filters.bor.clip import meeting
from slamlab.filters.bor.edges import edges, place, sighting
from slamlab.filters.bor.predict import moved
from slamlab.filters.bor.sharpen import EmptyIntersection, sharpened
from slamlab.filters.guards import vector


class BOR:
    """A robot and objects, each in a box that holds it.

    Parameters
    ----------
    robot : (4,) x_min, x_max, y_min, y_max at the start [m]
    heading : (2,) right, left at the start: counter-clockwise from right to left [rad]
    objects : {id: (4,) box}, a map that is known beforehand, or None
    capacity : int, objects to allocate memory for; more may come

    ``ambiguous`` counts the sightings that overlapped several objects and were ignored.

    Raises
    ------
    ValueError
    """

    def __init__(self, robot, heading, objects=None, capacity=100):
        self._robot = _box("robot", robot)
        right, left = vector("heading", heading, 2).tolist()
        if right > left:
            raise ValueError(f"heading: right {right} lies beyond left {left}; add 2π to left")
        self._heading = angles(right, left)
        self._sides = np.zeros((4, max(capacity, 1)))
        self._ids: list[int] = []
        self._row: dict[int, int] = {}  # column of each
        self.ambiguous = 0
        for i, box in (objects or {}).items():
            self._put(i, _box(f"object {i}", box))

    @property
    def robot(self):
        """(4,) the robot's x_min, x_max, y_min, y_max [m]."""
        return np.array(self._robot)

    @property
    def heading(self):
        """(2,) right in (−π, π] and left in [right, right + 2π] [rad]."""
        return np.array(self._heading)

    @property
    def pose(self):
        """(3,) the middle of the robot's box and of its heading [m, m, rad]."""
        x_min, x_max, y_min, y_max = self._robot
        return np.array([(x_min + x_max) / 2, (y_min + y_max) / 2, middle(self._heading)])

    @property
    def ids(self):
        """The objects' ids, oldest first."""
        return list(self._ids)

    def __len__(self):
        return len(self._ids)

    def __contains__(self, i):
        return i in self._row

    def boxes(self):
        """(N, 4) the objects' x_min, x_max, y_min, y_max, in the order of ``ids`` [m]."""
        return self._sides[:, : len(self._ids)].T.copy()

    def predict(self, way, direction, turn):
        """Move; the objects' boxes stay.

        Parameters
        ----------
        way, direction, turn : intervals, made by ``steered``, ``wheels`` or ``odometry`` of
            :mod:`slamlab.filters.bor.predict` [m, rad, rad]

        Raises
        ------
        ValueError
        """
        motion = [_interval(*i) for i in (("way", way), ("direction", direction), ("turn", turn))]
        self._robot, self._heading = moved(self._robot, self._heading, *motion)

    def update(self, i, z, bounds):
        """See an object again: clip its box, the robot's and the heading while they shrink.

        Parameters
        ----------
        i : id of the object
        z : (2,) range [m], bearing [rad]
        bounds : (2,) most that range and bearing are off [m, rad]

        Raises
        ------
        EmptyIntersection : some noise was outside its bounds, or another object was seen; nothing
            was changed
        ValueError : an unknown id, or numbers that are none
        """
        if i not in self._row:
            raise ValueError(f"object {i} is not in the map: add it instead")
        z, bounds = _sighting(z, bounds)
        row = self._row[i]
        box = tuple(self._sides[:, row].tolist())
        try:
            believed = sharpened(self._robot, self._heading, box, z, bounds)
        except EmptyIntersection as error:
            raise EmptyIntersection(f"object {i}: {error}") from None
        self._robot, self._heading, self._sides[:, row] = believed

    def add(self, i, z, bounds):
        """See an object for the first time: the box of all places where it may be.

        Parameters
        ----------
        i : int, a new id
        z, bounds : (2,) range [m], bearing [rad] and the most that they are off

        Raises
        ------
        ValueError : an id that is in the map already
        """
        if i in self._row:
            raise ValueError(f"object {i} is in the map already: update it instead")
        self._put(i, place(self._robot, self._heading, *_sighting(z, bounds)))

    def overlapping(self, z, bounds):
        """The objects that a sighting may be of: those whose boxes its region meets (5.2.9).

        Parameters
        ----------
        z, bounds : (2,) range [m], bearing [rad] and the most that they are off

        Returns
        -------
        list of ids
        """
        z, bounds = _sighting(z, bounds)
        region = place(self._robot, self._heading, z, bounds)
        direction, d_abs = sighting(self._heading, z, bounds)
        lines = edges(z, bounds, direction, d_abs, self._robot)
        return [self._ids[row] for row in meeting(self._sides[:, : len(self._ids)], region, lines)]

    def take(self, z, bounds):
        """Take a sighting of nobody knows what: update, add, or ignore it.

        The region overlaps one object: it is that one. None: a new one. Several: 5.2.9 is silent
        and 5.2.10 would add another object; here the sighting is ignored and counted.

        Parameters
        ----------
        z, bounds : (2,) range [m], bearing [rad] and the most that they are off

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

    def _put(self, i, box):
        row = len(self._ids)
        if row == self._sides.shape[1]:
            self._sides = np.hstack([self._sides, np.zeros_like(self._sides)])
        self._row[i] = row
        self._ids.append(i)
        self._sides[:, row] = box


def _box(name, box):
    x_min, x_max, y_min, y_max = vector(name, box, 4).tolist()
    if x_min > x_max or y_min > y_max:
        raise ValueError(f"{name}: expected x_min ≤ x_max, y_min ≤ y_max, got {box}")
    return x_min, x_max, y_min, y_max


def _sighting(z, bounds):
    try:
        (r, bearing), (dr, d_beta) = map(float, z), map(float, bounds)
    except (TypeError, ValueError):
        raise ValueError(f"z and bounds are a range and a bearing each: {z}, {bounds}") from None
    if not all(map(isfinite, (r, bearing, dr, d_beta))):
        raise ValueError("z or bounds hold NaN or infinity")
    if r <= 0 or dr < 0 or d_beta < 0:
        raise ValueError(f"a range is positive, bounds are not negative: {z}, {bounds}")
    return (r, bearing), (dr, d_beta)


def _interval(name, value):
    try:
        low, high = map(float, value)
    except (TypeError, ValueError):
        raise ValueError(f"{name} is an interval of two numbers, not {value!r}") from None
    if not -np.inf < low <= high < np.inf:
        raise ValueError(f"{name}: expected low ≤ high, both finite, got {value}")
    return low, high
