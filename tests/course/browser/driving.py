"""A notebook with a robot to drive, as in lesson 14, and what a test can see and do there."""

import re

import numpy as np

from tests.course.browser.live import View, fresh

NAME = "driving.ipynb"

# emulators and our drivers between, in simulated time, which stands while the robot has nothing to
# do: so a drive is the same however busy the machine is; odometry by the thesis' scale factors, so
# 3 % and 7 % off, and wheels that slip
DRIVEN = """\
import threading
import numpy as np
from functools import partial
from slamlab import estimators, live
from slamlab.simulation import worlds
from slamlab.devices.clock import SimulatedClock
from slamlab.sources.emulated_devices import EmulatedDevices
from slamlab.geometry import between

class Driven(EmulatedDevices):
    rest, stood = 10, 0  # readings while it stands

    def __init__(self, *rest, **named):
        self.closed = threading.Event()
        super().__init__(*rest, **named)

    def _revolutions(self):
        for turn in super()._revolutions():
            self.stood = 0 if np.any(self._command) else self.stood + 1
            yield turn
            while self.stood >= self.rest and not np.any(self._command):
                if self.closed.wait(0.005):
                    return

    def close(self):
        self.closed.set()
        super().close()

def told(pair):
    true = pair.source.truth.poses[: pair.count][-1]
    named = {"true": true, "naive": pair.estimator.naive_pose, "corrected": pair.estimator.pose}
    poses = " ".join(f"{name} [{x:.4f} {y:.4f} {a:.4f}]" for name, (x, y, a) in named.items())
    return poses + (" at rest" if pair.source.stood >= pair.source.rest else "")

seen = live.watch(
    lambda rng: Driven(worlds.room(), rng, clock=SimulatedClock()),
    live.shift_layers(partial(estimators.make, "icp"), naive=(-8.5, 0)),
    "Naive and corrected map of a room.",
    note=told,
    truth=False,
    steps=1,
    speed=20,  # twice as fast as a lidar turns, where the machine can
    tops=(0.3, 0.8),
)"""

STATS = "print(seen.pair.source.lidar.stats, seen.pair.source.emir.stats)"


def notebook():
    """A notebook never run: a robot to drive, and a cell that shows the counts of its drivers."""
    return fresh(DRIVEN, STATS)


class Robot(View):
    """The robot of the first cell, driven and shown in the page."""

    def __init__(self, visit):
        super().__init__(visit.page, 0)
        self.rested = ""  # step at which it was last seen to stand
        self.line = self.cell.get_by_placeholder("distance, angle")

    def poses(self):
        """True, naive and corrected pose by name, (3,) each [m, m, rad]."""
        found = re.findall(r"(\w+) \[(\S+) (\S+) (\S+)\]", self.status())
        return {name: np.array(pose, dtype=float) for name, *pose in found}

    def at_rest(self):
        """Wait until the robot stops after a command; its poses then."""
        self.page.wait_for_function(
            r"""([status, last]) => {
                const text = status.textContent;
                return text.includes("at rest") && /step \d+/.exec(text)[0] !== last;
            }""",
            arg=[self.root.locator(".slamlab-status").element_handle(), self.rested],
        )
        self.rested = re.search(r"step \d+", self.status())[0]
        return self.poses()

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
