"""A notebook with a robot to drive, as lesson 14 has it, and what can be seen and done there."""

import re

import numpy as np

from tests.browser.live import View, fresh

NAME = "driving.ipynb"

# emulators and our drivers between, in simulated time: nothing hangs on how busy the machine is;
# odometry by the thesis' scale factors, so 3 % and 7 % off, and wheels that slip
DRIVEN = """\
from functools import partial
from slamlab import estimators, views, worlds
from slamlab.devices.clock import SimulatedClock
from slamlab.sources.emulated_devices import EmulatedDevices
from slamlab.geometry import between

def told(pair):
    true = pair.source.truth.poses[: pair.count][-1]
    named = {"true": true, "naive": pair.estimator.naive_pose, "corrected": pair.estimator.pose}
    return " ".join(f"{name} [{x:.4f} {y:.4f} {a:.4f}]" for name, (x, y, a) in named.items())

seen = views.live(
    lambda rng: EmulatedDevices(worlds.room(), rng, clock=SimulatedClock()),
    views.apart(partial(estimators.make, "icp"), naive=(-8.5, 0)),
    "Naive and corrected map of a room.",
    note=told,
    truth=False,
    steps=1,
    speed=20,  # twice as fast as a lidar turns, where the machine can
    tops=(0.3, 0.8),
)"""

STATS = "print(seen.pair.source.lidar.stats, seen.pair.source.emir.stats)"


def notebook():
    """A notebook never run: a robot to drive, and a cell that tells what its drivers counted."""
    return fresh(DRIVEN, STATS)


class Robot(View):
    """The robot of the first cell, as it is driven and told of in the page."""

    def __init__(self, visit):
        super().__init__(visit.page, 0)
        self.line = self.cell.get_by_placeholder("distance, angle")

    def poses(self):
        """True, naive and corrected pose by name, (3,) each [m, m, rad]."""
        found = re.findall(r"(\w+) \[(\S+) (\S+) (\S+)\]", self.status())
        return {name: np.array(pose, dtype=float) for name, *pose in found}

    def at_rest(self):
        """Wait until the robot stands; its poses then."""
        last, same = None, 0
        while same < 5:
            self.wait(self.frame() + 2)
            poses = self.poses()
            moved = last is None or np.abs(poses["true"] - last).max() > 1e-4
            last, same = poses["true"], 0 if moved else same + 1
        return poses

    def tell(self, text):
        """Type a line, as into Tuček's console."""
        self.line.fill(text)
        self.line.press("Enter")

    def go_to(self, x, y):
        """Drive to a place of the corrected map by a turn and a straight way."""
        from_x, from_y, heading = self.poses()["corrected"]
        turn = np.angle(np.exp(1j * (np.arctan2(y - from_y, x - from_x) - heading)))
        self.tell(f"{np.hypot(x - from_x, y - from_y):.3f}, {np.degrees(turn):.2f}")
        return self.at_rest()
