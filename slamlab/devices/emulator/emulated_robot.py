"""Hardware of the emulated robot: differential drive, encoder counters, infrared and compass."""

import threading
from collections import deque

import numpy as np

from slamlab.geometry import wrap
from slamlab.simulation.differential_drive import DifferentialDrive, Simulator
from slamlab.simulation.worlds.ray_casting import cast_each_ray

TIME_STEP = 0.01  # of the simulation [s]
POSE_HISTORY = 300  # number of stored poses
IR_DIRECTIONS = np.radians([60, 20, -20, -60, -120, 120])  # assumed: undocumented
IR_RANGE = 0.10, 0.80  # of the infrared sensors [m]
EMIR = DifferentialDrive(base=0.3, slip=0.01, radius=0.15)  # drive of the emulated eMIR [m]
# path and angle of one count, from a program for eMIR (thesis: 1 cm, 2°) [m, rad]
COUNT_SIZE = 0.0103, np.radians(2.14)
TOP_SPEEDS = 0.4, np.radians(100)  # speed and turn rate at 100 % [m/s, rad/s]


class EmulatedRobot:
    """Thread-safe differential-drive robot in a world, with the true start pose ``pose``.

    ``counts``: distance and angle per count, (2,) [m, rad]; ``tops``: speed and turn rate at 100 %,
    (2,) [m/s, rad/s].
    """

    def __init__(
        self, world, rng, pose=(0.0, 0.0, 0.0), robot=EMIR, counts=COUNT_SIZE, tops=TOP_SPEEDS
    ):
        self.world, self._simulator = world, Simulator(robot, rng, pose)
        self._counts = np.array(counts)
        self._tops = np.array(tops)
        self._rolled = np.zeros(2)  # path and rotation by the encoders [m, rad]
        self._speeds, self._lock = np.zeros(2), threading.RLock()
        self._time, self._poses = None, deque(maxlen=POSE_HISTORY)

    @property
    def pose(self):
        """Current true pose (ground truth), (3,) [m, m, rad]."""
        return self._simulator.pose.copy()

    def advance(self, v, omega, now):
        """Set the speed and the turn rate [%], then simulate until the time ``now`` [s]."""
        with self._lock:
            self._speeds = self._tops * [v, omega] / 100
            self._simulate_until(now)

    def counters(self):
        """Return the encoder counters (distance, angle) in whole counts, without wrap-around."""
        return tuple(int(n) for n in np.floor(self._rolled / self._counts))

    def azimuth(self):
        """Return the compass heading from 0 to 2π [rad]."""
        return float(np.mod(self._simulator.pose[2], 2 * np.pi))

    def proximity(self):
        """Return the distances (6,) that the infrared sensors measure from the robot's rim [m]."""
        x, y, theta = self._simulator.pose
        ranges = self.world.cast((x, y), theta + IR_DIRECTIONS) - self._simulator.robot.radius
        return np.clip(ranges, *IR_RANGE)

    def pose_at(self, times):
        """Return true poses (n, 3), unwrapped, at ascending times (n,) [s] within the last 3 s."""
        with self._lock:
            self._simulate_until(times[-1] + TIME_STEP)
            known = []
            for entry in reversed(self._poses):
                known.append(entry)
                if entry[0] <= times[0]:
                    break
        at, poses = np.array([t for t, _ in known[::-1]]), np.array([p for _, p in known[::-1]])
        poses[:, 2] = np.unwrap(poses[:, 2])
        return np.column_stack([np.interp(times, at, column) for column in poses.T])

    def cast(self, times, poses, bearings):
        """Cast a ray from each pose (n, 3) along its bearing (n,) [rad]; return ranges (n,) [m]."""
        walls, circles = self.world.walls, self.world.circles
        return cast_each_ray(poses[:, :2], poses[:, 2] + bearings, walls, circles)

    def _simulate_until(self, now):
        if self._time is None:  # the first call sets the start time
            self._time = now
            self._poses.append((now, self.pose))
        while self._time + TIME_STEP <= now:
            v, omega = self._speeds
            steps = 1
            if v or omega:
                self._step(0.0 if self._blocked(v) else v, omega)
            else:  # at rest: one step for all the time
                steps = max(int((now - self._time) / TIME_STEP), 1)
            self._time += steps * TIME_STEP
            self._poses.append((self._time, self.pose))

    def _step(self, v, omega):
        dx, dy, turn = self._simulator.step(v, omega, TIME_STEP)
        # length of the arc from its chord; negative if its end lies behind the robot
        length = np.hypot(dx, dy) / np.sinc(wrap(turn) / 2 / np.pi)
        self._rolled += [np.copysign(length, dx), turn]

    def _blocked(self, v):
        """Return whether the robot collides with an obstacle in its direction of travel."""
        fan = (np.pi if v < 0 else 0) + np.linspace(-1, 1, 9)
        pose = np.broadcast_to(self._simulator.pose, (len(fan), 3))
        reach = abs(v) * TIME_STEP + self._simulator.robot.radius
        return v != 0 and self.cast(self._time, pose, fan).min() < reach
