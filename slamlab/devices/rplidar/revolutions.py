"""Revolutions of the lidar, assembled from measurement nodes and converted to scans."""

from dataclasses import dataclass

import numpy as np

from slamlab.devices.rplidar.measurement_nodes import TURN_Q6
from slamlab.readings import Scan

MIN_SPAN = 330  # a complete revolution covers at least this [degree]
MAX_GAP = 10  # and has no gap larger than this [degree]
MAX_TRAVEL = (360 + 12) * 64  # beyond this angle the start flag was lost [1/64 degree]
MAX_NODES = 1 << 15  # nodes of a revolution: a lidar that does not rotate sends more


def robot_frame(angle_deg, range_mm, front_deg=0.0):
    """Transform angles and ranges to the robot's frame. Equation (14.4).

    ``angle_deg``: (n,) clockwise from the sensor's front; ``range_mm``: (n,), 0 for no return;
    ``front_deg``: angle of the robot's front in the sensor's frame. Returns unwrapped angles (n,),
    counter-clockwise from +x [rad], and ranges (n,), NaN for no return [m].
    """
    angles = np.radians(front_deg - np.asarray(angle_deg, dtype=float))
    range_mm = np.asarray(range_mm, dtype=float)
    return angles, np.where(range_mm > 0, range_mm / 1000, np.nan)


@dataclass(frozen=True)
class Revolution:
    """One measured revolution of the lidar: clockwise angles in degrees, ranges in millimetres.

    ``times``: times of the samples on the driver's clock [s]; ``complete``: whether the
    revolution has both start flags, spans a full circle and has no gap; ``gaps``: number of gaps
    with lost bytes; ``after_gap``: whether the connection was lost before the revolution;
    ``period``: sample period [s].
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
        """Mask (n,) of the samples with a return; angles without a return are unreliable."""
        return self.range_mm > 0

    @property
    def rate(self):
        """Rotation rate [Hz], computed from the number of samples."""
        return 1 / (self.period * len(self))

    def scan(self, range_max=np.inf, range_min=0.0, front_deg=0.0):
        """Return the Scan in the robot's frame, with range limits [m]."""
        angles, ranges = robot_frame(self.angle_deg, self.range_mm, front_deg)
        return Scan(angles, ranges, range_max, range_min)


class RevolutionAssembler:
    """Assembles revolutions from a stream of nodes; drops the first one, which is partial."""

    def __init__(self, period, after_gap=False):
        self._period, self._after_gap = period, after_gap
        self._nodes, self._times = [], []
        self._count, self._travel, self._last = 0, 0, None
        self._begun = False  # whether a start flag began this revolution
        self._first = True

    def feed(self, nodes, times):
        """Add nodes measured at times (n,) [s] and return the completed revolutions."""
        if not len(nodes):
            return []
        steps = self._angle_steps(nodes["angle_q6"])
        revolutions, begin, search = [], 0, 0
        while True:
            end, marked = self._find_end(nodes["start"][search:], steps[begin:], search - begin)
            end += begin
            self._append(nodes[begin:end], times[begin:end], steps[begin:end])
            if end == len(nodes):
                return revolutions
            revolutions += self._finish_revolution(marked)
            self._begun, steps[end] = marked, 0
            begin, search = end, end + 1  # the node that ends a revolution begins the next

    def _angle_steps(self, angle):
        """Return the angle increments (n,) from node to node, in [−180°, 180°) [1/64 degree]."""
        steps = np.empty(len(angle), np.int64)
        steps[0] = 0 if self._last is None else angle[0] - self._last
        np.subtract(angle[1:], angle[:-1], out=steps[1:])
        self._last = int(angle[-1])
        return (steps + TURN_Q6 // 2) % TURN_Q6 - TURN_Q6 // 2

    def _find_end(self, start, steps, own):
        """Return how many nodes belong to this revolution, and whether a start flag ends it.

        ``own``: number of nodes that surely belong to it; ``start``: flags of the other nodes.
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

    def _finish_revolution(self, marked):
        """Return a list of the completed revolution; the list is empty for the first revolution."""
        revolutions = []
        if not self._first and self._count:
            nodes, times = np.concatenate(self._nodes), np.concatenate(self._times)
            revolutions = [self._make_revolution(nodes, times, marked)]
            self._after_gap = False
        self._first = False
        self._nodes, self._times = [], []
        self._count = self._travel = 0
        return revolutions

    def _make_revolution(self, nodes, times, marked):
        gaps = int(nodes["after_gap"].sum())
        steps = (np.diff(nodes["angle_q6"]) + TURN_Q6 // 2) % TURN_Q6 - TURN_Q6 // 2
        full_circle = steps.sum() >= MIN_SPAN * 64 and steps.max(initial=0) <= MAX_GAP * 64
        return Revolution(
            angle_deg=nodes["angle_q6"] / 64,
            range_mm=nodes["distance_q2"] / 4,
            quality=nodes["quality"],
            times=times,
            complete=bool(self._begun and marked and not gaps and full_circle),
            gaps=gaps,
            after_gap=self._after_gap,
            period=self._period,
        )
