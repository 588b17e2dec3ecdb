"""Revolutions (turns): assembled from nodes, and converted to scans in the robot's frame."""

from dataclasses import dataclass

import numpy as np

from slamlab.devices.rplidar.measurement_nodes import TURN_Q6
from slamlab.readings import Scan

MIN_SPAN = 330  # a complete turn covers at least this [degree]
MAX_GAP = 10  # and has no gap larger than this [degree]
MAX_TRAVEL = (360 + 12) * 64  # after this the start flag must have been lost [1/64 degree]
MAX_NODES = 1 << 15  # nodes of a turn: more come only from a lidar that does not turn


def robot_frame(angle_deg, range_mm, front_deg=0.0):
    """Convert the sensor's clockwise degrees and millimetres to the robot's frame; the only place.

    Equation (14.4).

    Parameters
    ----------
    angle_deg : (n,) clockwise from the sensor's front, seen from above [degree]
    range_mm : (n,) [mm]; 0 where nothing came back
    front_deg : float, where the robot's front lies for the sensor [degree]

    Returns
    -------
    angles : (n,) counter-clockwise from the robot's +x [rad], in (-π, π] where it need not wrap
    ranges : (n,) [m]; NaN where nothing came back
    """
    angles = np.radians(front_deg - np.asarray(angle_deg, dtype=float))
    range_mm = np.asarray(range_mm, dtype=float)
    return angles, np.where(range_mm > 0, range_mm / 1000, np.nan)


@dataclass(frozen=True)
class Turn:
    """One revolution of the lidar as it came: clockwise, in degrees and millimetres.

    Parameters
    ----------
    angle_deg : (n,) [degree]
    range_mm : (n,) 0 where nothing came back [mm]
    quality : (n,) int, 0 to 63
    times : (n,) when each point was measured, on the driver's clock [s]
    complete : bool: it began and ended with the device's mark, goes round, and has no gap
    gaps : int, places where bytes were lost
    after_gap : bool, whether the connection was lost before it, and found again
    period : float, from one sample to the next [s]
    """

    angle_deg: np.ndarray
    range_mm: np.ndarray
    quality: np.ndarray
    times: np.ndarray
    complete: bool
    gaps: int
    after_gap: bool
    period: float

    def __len__(self):
        return len(self.angle_deg)

    @property
    def valid(self):
        """Valid points (n,) bool: something came back; elsewhere angles are not to be trusted."""
        return self.range_mm > 0

    @property
    def rate(self):
        """Rotation rate [Hz], float, by the number of samples, empty ones too."""
        return 1 / (self.period * len(self))

    def scan(self, range_max=np.inf, range_min=0.0, front_deg=0.0):
        """Convert the revolution to a scan in the robot's frame.

        Parameters
        ----------
        range_max, range_min : float [m]
        front_deg : float, see :func:`robot_frame`

        Returns
        -------
        Scan
        """
        angles, ranges = robot_frame(self.angle_deg, self.range_mm, front_deg)
        return Scan(angles, ranges, range_max, range_min)


class RevolutionAssembler:
    """Assembles revolutions from a stream of nodes; the first, partial one is dropped.

    Parameters
    ----------
    period : float, from one sample to the next [s]
    after_gap : bool, whether the stream follows a lost connection
    """

    def __init__(self, period, after_gap=False):
        self._period, self._after_gap = period, after_gap
        self._nodes, self._times = [], []
        self._count, self._travel, self._last = 0, 0, None
        self._begun = False  # whether a mark began this turn
        self._first = True

    def feed(self, nodes, times):
        """Append nodes as they come.

        Parameters
        ----------
        nodes : (n,) array of NODE_DTYPE
        times : (n,) [s]

        Returns
        -------
        list of Turn, those that ended
        """
        if not len(nodes):
            return []
        steps = self._angle_steps(nodes["angle_q6"])
        turns, begin, search = [], 0, 0
        while True:
            end, marked = self._find_end(nodes["start"][search:], steps[begin:], search - begin)
            end += begin
            self._append(nodes[begin:end], times[begin:end], steps[begin:end])
            if end == len(nodes):
                return turns
            turns += self._finish_turn(marked)
            self._begun, steps[end] = marked, 0
            begin, search = end, end + 1  # the node that ends one turn begins the next

    def _angle_steps(self, angle):
        """Unwrapped angle step from node to node, (n,), the shorter way round [1/64 degree]."""
        steps = np.empty(len(angle), np.int64)
        steps[0] = 0 if self._last is None else angle[0] - self._last
        np.subtract(angle[1:], angle[:-1], out=steps[1:])
        self._last = int(angle[-1])
        return (steps + TURN_Q6 // 2) % TURN_Q6 - TURN_Q6 // 2

    def _find_end(self, start, steps, own):
        """How many nodes still belong to this turn, and whether a start flag ends it.

        ``own`` of them do, whatever their marks; ``start`` are the marks of the rest.
        """
        at = int(start.argmax()) if len(start) else 0
        marked = len(start) > 0 and bool(start[at])
        n = own + at if marked else len(steps)
        reached = self._travel + np.add.accumulate(steps[:n])
        if n and reached.max() > MAX_TRAVEL:
            n, marked = int((reached > MAX_TRAVEL).argmax()), False
        if self._count + n > MAX_NODES:
            n, marked = MAX_NODES - self._count, False
        return n, marked

    def _append(self, nodes, times, steps):
        if len(nodes):
            self._travel += int(steps.sum())
            self._count += len(nodes)
            self._nodes.append(nodes)
            self._times.append(times)

    def _finish_turn(self, marked):
        """Finish the turn so far: a list of it, empty for the first, partial one."""
        turns = []
        if not self._first and self._count:
            nodes, times = np.concatenate(self._nodes), np.concatenate(self._times)
            turns = [self._make_turn(nodes, times, marked)]
            self._after_gap = False
        self._first = False
        self._nodes, self._times = [], []
        self._count = self._travel = 0
        return turns

    def _make_turn(self, nodes, times, marked):
        gaps = int(nodes["after_gap"].sum())
        steps = (np.diff(nodes["angle_q6"]) + TURN_Q6 // 2) % TURN_Q6 - TURN_Q6 // 2
        round_it_goes = steps.sum() >= MIN_SPAN * 64 and steps.max(initial=0) <= MAX_GAP * 64
        return Turn(
            angle_deg=nodes["angle_q6"] / 64,
            range_mm=nodes["distance_q2"] / 4,
            quality=nodes["quality"],
            times=times,
            complete=bool(self._begun and marked and not gaps and round_it_goes),
            gaps=gaps,
            after_gap=self._after_gap,
            period=self._period,
        )
