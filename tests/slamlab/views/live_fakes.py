"""A source, an estimator and a screen without a browser, for the live view's tests."""

import asyncio

import numpy as np

from slamlab.layers import Points, Poses
from slamlab.live.back_pressure import Screen
from slamlab.readings import Reading, Trajectory
from slamlab.sources.base import Source
from tests.timeouts import PATIENCE


class Walk(Source):
    """A recorded walk along x whose steps the seed decides."""

    name = "a walk"

    def __init__(self, rng, length=5):
        super().__init__()
        self._steps = [np.array([d, 0.0, 0.0]) for d in rng.uniform(0.1, 1.0, length)]

    def __len__(self):
        return len(self._steps)

    def __iter__(self):
        for i in range(len(self)):
            yield Reading(time=float(i), odometry=self._steps[i])

    @property
    def truth(self):
        x = np.cumsum([step[0] for step in self._steps])
        return Trajectory(np.arange(len(x)), np.column_stack([x, 0 * x, 0 * x]))


class Car(Walk):
    """A walk that can be driven on."""

    name = "a car"

    def __init__(self, rng):
        super().__init__(rng, length=1)
        self.commands = []

    def drive(self, command):
        self.commands.append(command)
        self._steps.append(np.array([command[0], 0.0, 0.0]))
        return Reading(time=float(len(self)), odometry=self._steps[-1])


class Sum:
    """An estimator that adds odometry up; it can be made to fail at a step."""

    def __init__(self, fails_at=None):
        self.pose, self.status, self.skipped = np.zeros(3), "", 0
        self._track, self._fails_at = [], fails_at

    def step(self, reading):
        if len(self._track) == self._fails_at:
            raise ZeroDivisionError("too\n  small")
        self.pose = self.pose + reading.odometry
        self._track.append(self.pose)

    def trajectory(self):
        return Trajectory(np.arange(len(self._track)), np.array(self._track))

    def layers(self):
        return [Points("map", np.array(self._track)[:, :2]), Poses("corrected", self.pose[None])]


class FakeScreen(Screen):
    """Screen that records the scenes it was sent; acknowledged by hand, or at once."""

    def __init__(self, at_once=True):
        super().__init__(acknowledged=True)
        self.scenes, self.most, self.at_once = [], 0, at_once

    def _send_frame(self, scene):
        self.scenes.append(scene)
        self.most = max(self.most, self.sent - self.drawn)
        if self.at_once:
            asyncio.get_running_loop().call_soon(self.draw)

    def draw(self):
        """The browser has drawn the last frame."""
        self._acknowledge(self.sent)

    def open(self):
        """The browser is ready."""
        self._client_ready()


async def until(done, patience=PATIENCE):
    """Wait for something to come true."""
    async with asyncio.timeout(patience):
        while not done():
            await asyncio.sleep(0.001)
