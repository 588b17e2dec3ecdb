"""Laser geometry of a CARMEN log: field of view, extrinsic calibration, units, maximum range.

The geometry is derived from the messages, the PARAM lines, and the poses of laser and robot.
"""

import numpy as np

from slamlab.geometry import between, wrap
from slamlab.sources.carmen_beam_angles import (
    GFS_BEAMS,
    RADIANS,
    RESOLUTIONS,
    angles_by_count,
    angles_by_settings,
)

RANGE_MAX = 80.0  # [m]; a SICK LMS reports 81.83 or 81.91 m for no return
MILLIMETRES, LEAST_MILLIMETRES = 150.0, 100.0  # least median and range of a log in millimetres
WIDE = 400  # number of beams of lidars with a field of view of mostly 240° to 270° [1]
# names of the front and the rear laser in PARAM lines
PARAM_NAMES = {1: ("front_laser", "frontlaser"), 2: ("rear_laser", "rearlaser")}

SAME_POSITION, SAME_ANGLE = 0.01, 0.01  # tolerance of a constant mounting [m, rad]
MAX_MOUNT = 3.0  # largest distance of a laser from the robot's centre [m]
MIN_TURN = 0.3  # least rotation, by which mounting and different frames are distinguished [rad]

SATURATION_BAND = 0.995  # share of the largest range beyond which ranges mean no return [1]
MIN_SATURATED, SATURATION_RATIO = 20, 5.0  # least number, absolute and relative to those below [1]
SATURATION_DISTANCE = 3.0  # least ratio to the median of the other ranges; below it: a wall [1]


class LaserGeometry:
    """Geometry of one laser (1 front, 2 rear), from a sample of ScanMessages and the numbers of the
    PARAM lines: ``unit`` of the ranges [m], ``mount`` (3,) on the robot, ``range_max`` [m].

    ``labelled``: whether the first pose of a message is certainly the laser's pose. Sentences about
    missing or contradictory data are appended to ``notes``.
    """

    def __init__(self, params, laser, labelled, sample, notes):
        self._names = *PARAM_NAMES.get(laser, ()), f"laser{laser}"
        self._params, self._notes = params, notes
        self._by_count, self.clockwise = {}, False
        ranges = [message.ranges for message in sample]
        self.unit = _unit(np.concatenate(ranges))
        if self.unit != 1.0:
            notes.append("ranges are read as millimetres; for centimetres, add --range-scale 10")
        self.mount = self._mounting(laser, labelled, sample)
        given = [message.range_max for message in sample if message.range_max > 0]
        limit = self._param("robot_{}_max") or RANGE_MAX
        if given:
            limit = min(RANGE_MAX, float(np.median(given)) * self.unit)
        self.range_max = no_return_range([r * self.unit for r in ranges], limit)

    def angles(self, message):
        """Return the beam angles (n,) [rad] of a ScanMessage."""
        if message.settings is not None:
            angles = angles_by_settings(*message.settings)
        else:
            angles = self._by_count[len(message.ranges)]
        return -angles if self.clockwise else angles

    @property
    def declared_upside_down(self):
        """Whether a PARAM line states that the laser is mounted upside down."""
        return bool(self._param("laser_{}_flipped"))

    def lengths(self, lengths, gfs):
        """Return the usable beam counts, given those (n,) of the scans without a field of view."""
        counts, times = np.unique(lengths, return_counts=True)
        usual = int(counts[np.argmax(times)])
        for count in counts.tolist():
            same = RESOLUTIONS.get(count) == RESOLUTIONS.get(usual, 0.0)
            if count == usual or same:
                self._by_count[count] = self._angles_by_count(count, gfs)
        return list(self._by_count)

    def _angles_by_count(self, count, gfs):
        """Compute beam angles from the number of beams and from PARAM lines, if given."""
        if gfs and count in GFS_BEAMS:
            first, step = GFS_BEAMS[count]
            return first + step * np.arange(count)
        view, step = (self._param(f"laser_{{}}_{what}") for what in ("fov", "resolution"))
        if view is None and step is None and count >= WIDE and count not in RESOLUTIONS:
            self._notes.append(
                f"the field of view is unknown, so the {count} ranges cover 180°, as in CARMEN. "
                "A line 'PARAM laser_front_laser_fov DEGREES' sets the field of view"
            )
        try:
            return angles_by_count(count, view, step)
        except ValueError as error:
            if count not in RESOLUTIONS:
                raise
            self._notes.append(f"{error}; the geometry of a SICK is used")
            return angles_by_count(count)

    def _mounting(self, laser, labelled, sample):
        offsets = [self._param(f"robot_{{}}_{what}offset") for what in ("", "side_", "angular_")]
        given = [offset or 0.0 for offset in offsets] if offsets != [None] * 3 else None
        poses = ([getattr(m, key) for m in sample] for key in ("laser", "robot"))
        mount = mounting(*map(np.array, poses), given, labelled)
        if mount is None and laser != 1:
            self._notes.append(
                "the mounting of the laser is unknown; the laser is assumed at the robot's centre, "
                "pointing ahead"
            )
        return np.zeros(3) if mount is None else mount

    def _param(self, name):
        """Return the value of a PARAM line of the laser, or None."""
        for laser in self._names:
            value = self._params.get(name.format(laser))
            if value is not None:
                return value
        return None


def _unit(ranges):
    """Return the unit of the ranges [m]: 0.001 if they are too large for any laser, otherwise 1."""
    ranges = ranges[ranges > 0]
    far = len(ranges) and np.median(ranges) > MILLIMETRES
    return 1e-3 if far and np.mean(ranges < LEAST_MILLIMETRES) < 0.02 else 1.0


def mounting(lasers, robots, offsets, labelled):
    """Return the mounting (extrinsic calibration): laser pose (3,) on the robot, or None.

    ``lasers`` and ``robots`` (n, 3) are NaN for a message without a pose; ``offsets`` of the PARAM
    lines [m, m, rad or degree] or None. ``labelled``: ``lasers`` are certainly poses of the laser.
    """
    given = None if offsets is None else np.array(offsets, dtype=float)
    if given is not None and abs(given[2]) > RADIANS:
        given[2] = np.radians(given[2])
    known = np.isfinite(lasers).all(axis=1) & np.isfinite(robots).all(axis=1)
    if not known.any():
        return given
    relative = between(robots[known], lasers[known])
    angle = relative[0, 2] + np.median(wrap(relative[:, 2] - relative[0, 2]))
    middle = np.array([*np.median(relative[:, :2], axis=0), angle])
    off = between(middle, relative)
    same = (np.hypot(off[:, 0], off[:, 1]) < SAME_POSITION) & (np.abs(off[:, 2]) < SAME_ANGLE)
    turned = np.ptp(np.unwrap(robots[known, 2])) > MIN_TURN
    # poses with a variable relation are results of another estimator
    if same.mean() < 0.9 or not (labelled or turned) or np.hypot(*middle[:2]) > MAX_MOUNT:
        return given
    at_robot = np.hypot(*middle[:2]) < SAME_POSITION and abs(middle[2]) < SAME_ANGLE
    return given if at_robot and given is not None else middle


def no_return_range(scans, range_max):
    """Return the range that means no return [m], or ``range_max``.

    This range is detected from the number of ranges at the largest value. Otherwise, beams without
    a return would look like a wall that moves with the robot.
    """
    ranges = np.concatenate(scans)
    ranges = ranges[ranges < range_max]
    if len(ranges) == 0:
        return range_max
    top = ranges.max()
    limit = SATURATION_BAND * top
    rest = ranges[ranges < limit]
    if len(rest) == 0 or top < SATURATION_DISTANCE * np.median(rest):
        return range_max
    saturated, below = len(ranges) - len(rest), np.count_nonzero(rest >= 0.9 * top)
    return limit if saturated > max(MIN_SATURATED, SATURATION_RATIO * below) else range_max
