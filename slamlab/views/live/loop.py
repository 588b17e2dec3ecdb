"""The loop behind a live view: steps a pair, shows each step, waits until it is drawn."""

import asyncio
from dataclasses import replace
from math import inf
from time import monotonic

from slamlab.views.live.commands import COMMANDS, velocities
from slamlab.views.live.packing import Scene
from slamlab.views.live.wheel import Wheel
from slamlab.views.mistakes import sentence

PICTURES = 20  # a second, at most; more steps than these share a picture
BREATH = 0.005  # [s] left to the kernel between two pictures, to hear of a press
BUSY = 0.1  # [s] of steps in a row, then a picture
STANDING = 0.1  # [s] between looks whether a robot that stands has got a command
SOON = 0.02  # [s] that all else in the kernel waits for a source's readings, a picture

_running = None  # the one loop that runs: a cell that is run again leaves none behind


class Loop:
    """Runs, pauses, steps, resets and drives a pair, on a screen.

    Parameters
    ----------
    pair : Pair, reset already
    screen : Screen
    seed : int, of the pair as it stands
    speed : float, steps a second
    tops : (speed, turn rate) of commands [m/s, rad/s]
    play : bool, whether it runs as soon as a browser shows it

    ``on_change()`` is called when it begins or ceases to run or gets another source.
    """

    def __init__(self, pair, screen, seed=0, speed=5.0, tops=(0.4, 0.6), play=False):
        self.pair, self.screen, self.seed, self.speed = pair, screen, seed, speed
        self.tops, self.play, self.trouble = tops, play, ""
        self.on_change = lambda: None
        self.wheel = Wheel(self)
        self._task, self._scene, self._left = None, Scene([]), False
        screen.on_ready, screen.on_closed, screen.on_key = self._ready, self.close, self.drive

    @property
    def running(self):
        """bool"""
        return self._task is not None

    def run(self):
        """Step after step; from the start where the end was reached or the source was let go of."""
        if (self._at_end or self._left) and not self.attempt(self._renew):
            self.show()
        else:
            self._start()

    def pause(self):
        """Stop after the step that is being made; a robot that drives by itself stands."""
        global _running
        if self.running:
            self.wheel.let_go()
        self._task = None
        if _running is self:
            _running = None
        self.on_change()

    def step(self):
        """One step, as soon as there is a reading, then pause."""
        self.pause()
        before = self.pair.count
        self.attempt(lambda: self.pair.step(SOON))
        self._await(before + 1)
        self.show()

    def close(self):
        """Nobody looks any more: pause, and close a source that was made for this view."""
        self.pause()
        self.attempt(self.pair.close)

    def reset(self, seed=None, pair=None):
        """Begin anew and pause.

        Parameters
        ----------
        seed : int, or None for the same
        pair : Pair to go on with, or None for the same
        """
        self.close()
        self.seed = self.seed if seed is None else seed
        self.pair = self.pair if pair is None else pair
        self.attempt(self._renew)
        self._await(1)
        self.on_change()
        self.show()

    def drive(self, name):
        """While it runs, steer; else drive one step. A robot with a clock of its own is told.

        Parameters
        ----------
        name : str, one of COMMANDS; others, which a browser may send, are ignored
        """
        if name in COMMANDS and self.wheel.turn(velocities(name, self.tops)):
            self.show()

    def leave(self):
        """Let go of the source until it runs or begins anew."""
        self.close()
        self._left = True

    def show(self):
        """Offer the screen what there is to see; a mistake in it is told as any other."""
        trouble = self.trouble
        self.trouble = (self.attempt(self._look) and trouble) or self.trouble
        scene = self._scene
        if self.trouble:
            scene = replace(scene, status=f"⚠ {self.trouble}")
        self.screen.offer(scene)

    def _look(self):
        scene = self.pair.scene()
        _ = scene.drawables  # what cannot be drawn is found here, not on the way to the browser
        self._scene = scene

    def _renew(self):
        self._left = False
        self.pair.reset(self.seed, SOON)

    def _await(self, count):
        """Go on until so many readings are taken in, where the source keeps one waiting."""
        if not self.trouble and self.pair.count < count and self.pair.waited:
            self._start(count)

    def _start(self, until=inf):
        global _running
        stop()
        _running = self
        self._task = asyncio.get_running_loop().create_task(self._run(until))
        self.on_change()

    def attempt(self, function):
        """Do it; a mistake has no cell to fail in, so it stops the loop and is told."""
        self.trouble = ""
        try:
            function()
        except Exception as error:
            self.trouble = sentence(error)
            self.pause()
        return not self.trouble

    def _ready(self):
        self.show()
        if self.play and not self.running:
            self.play = False
            self.run()

    async def _run(self, until):
        # JupyterLab may run messages and cells in two threads, and a task is cancelled safely only
        # from its own: so it asks whether it is still the one that runs
        mine, late = asyncio.current_task(), 0
        while self._task is mine:
            began = monotonic()
            made = self._steps(mine, until)
            if made or self.trouble or int(self.pair.waited) > late:
                self.show()
            late = int(self.pair.waited)
            if self.pair.count >= until or (not made and self._at_end):
                self.pause()
            await asyncio.sleep(max(self._pace(made) - (monotonic() - began), BREATH))
            while self._task is mine and not self.screen.free and not self.pair.live:
                await self.screen.until_drawn()

    @property
    def _at_end(self):
        return self.pair.over and not self.pair.drivable

    def _pace(self, made):
        """Time from one picture to the next [s]."""
        if made:
            return max(1 / self.speed, 1 / PICTURES)
        return BREATH if self.pair.waited else STANDING

    def _steps(self, mine, until):
        """Make the steps of one picture; how many there were."""
        began, first = monotonic(), self.pair.count
        most = min(first + max(self.speed / PICTURES, 1), until)
        while self._task is mine and self.pair.count < most:
            before, spent = self.pair.count, monotonic() - began
            patience = 0 if self.pair.waited else max(SOON - spent, 0)
            done = self.attempt(lambda patience=patience: self.pair.step(patience))
            if not done or self.pair.count == before:
                break
            self.wheel.steer()
            if monotonic() - began > BUSY:
                break
        return self.pair.count - first


def stop():
    """Stop whatever runs; harmless when nothing does."""
    if _running is not None:
        _running.pause()
