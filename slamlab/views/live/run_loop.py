"""Run loop (event loop) of a live view: steps an estimator, shows frames, waits until drawn."""

import asyncio
from dataclasses import replace
from math import inf
from time import monotonic

from slamlab.views.live.drive_commands import COMMANDS, velocities
from slamlab.views.live.drive_control import DriveControl
from slamlab.views.live.frame_packing import Scene
from slamlab.views.widget_errors import error_line

FRAME_RATE = 20  # frames a second, at most; faster steps share a frame [1/s]
MIN_PAUSE = 0.005  # [s] left to the kernel between two frames, to hear of a press
MAX_BURST = 0.1  # [s] of steps in a row, then a frame
IDLE_POLL = 0.02  # [s] between looks whether a robot that stands has got a command
READING_TIMEOUT = 0.02  # [s] that all else in the kernel waits for a source's readings, a frame

_running = None  # the one loop that runs: a cell that is run again leaves none behind


class RunLoop:
    """Run loop: runs, pauses, steps, resets and drives a stepper, and shows its scenes on a screen.

    Parameters
    ----------
    pair : Stepper, a pair of source and estimator, reset already
    screen : Screen
    seed : int, of the pair as it stands
    speed : float, steps a second
    tops : (speed, turn rate) of commands [m/s, rad/s]
    play : bool, whether it runs as soon as a browser shows it whose reader likes motion
    frame_rate : float, frames a second at most, or None for FRAME_RATE

    ``on_change()`` is called when it begins or ceases to run or gets another source.
    """

    def __init__(
        self, pair, screen, seed=0, speed=5.0, tops=(0.4, 0.6), play=False, frame_rate=None
    ):
        self.pair, self.screen, self.seed, self.speed = pair, screen, seed, speed
        self.tops, self.play, self.error, self._frame_rate = tops, play, "", frame_rate
        self.on_change = lambda: None
        self.drive_control = DriveControl(self)
        self._task, self._scene, self._released = None, Scene([]), False
        screen.on_ready, screen.on_closed, screen.on_key = self._ready, self.close, self.drive

    @property
    def frame_rate(self):
        """float, frames a second at most; faster steps share a frame."""
        return self._frame_rate or FRAME_RATE

    @property
    def running(self):
        """bool, whether the loop runs, not paused."""
        return self._task is not None

    def run(self):
        """Run step after step; from the start where the end was reached or the source released."""
        if (self._at_end or self._released) and not self.attempt(self._restart):
            self.show()
        else:
            self._start()

    def pause(self):
        """Pause after the step that is being made; a robot that drives by itself is stopped."""
        global _running
        if self.running:
            self.drive_control.release()
        self._task = None
        if _running is self:
            _running = None
        self.on_change()

    def step(self):
        """Single step, as soon as there is a reading, then pause."""
        self.pause()
        before = self.pair.count
        self.attempt(lambda: self.pair.step(READING_TIMEOUT))
        self._run_until(before + 1)
        self.show()

    def close(self):
        """Close the view: pause, and close a source that was made for it."""
        self.pause()
        self.attempt(self.pair.close)

    def reset(self, seed=None, pair=None):
        """Reset: make source and estimator anew from a seed, then pause.

        Parameters
        ----------
        seed : int, or None for the same
        pair : Stepper to go on with, or None for the same
        """
        self.close()
        self.seed = self.seed if seed is None else seed
        self.pair = self.pair if pair is None else pair
        self.attempt(self._restart)
        self._run_until(1)
        self.on_change()
        self.show()

    def drive(self, name):
        """Drive the robot by a named command (teleoperation, keyboard driving).

        While it runs, steer; else drive one step. A robot with a clock of its own is told.

        Parameters
        ----------
        name : str, one of COMMANDS; others, which a browser may send, are ignored
        """
        if name in COMMANDS and self.drive_control.set_velocity(velocities(name, self.tops)):
            self.show()

    def release(self):
        """Release the source (its devices) until it runs or begins anew."""
        self.close()
        self._released = True

    def show(self):
        """Offer the screen the current scene; an error in it goes to the status line."""
        error = self.error
        self.error = (self.attempt(self._update_scene) and error) or self.error
        scene = self._scene
        if self.error:
            scene = replace(scene, status=f"⚠ {self.error}")
        self.screen.offer(scene)

    def _update_scene(self):
        scene = self.pair.scene()
        _ = scene.drawables  # what cannot be drawn is found here, not on the way to the browser
        self._scene = scene

    def _restart(self):
        self._released = False
        self.pair.reset(self.seed, READING_TIMEOUT)

    def _run_until(self, count):
        """Run until so many readings are processed, where the source keeps one waiting."""
        if not self.error and self.pair.count < count and self.pair.waited:
            self._start(count)

    def _start(self, until=inf):
        global _running
        stop()
        _running = self
        self._task = asyncio.get_running_loop().create_task(self._run(until))
        self.on_change()

    def attempt(self, function):
        """Call a function; an error has no cell to fail in: it stops the loop and is shown."""
        self.error = ""
        try:
            function()
        except Exception as error:
            self.error = error_line(error)
            self.pause()
        return not self.error

    def _ready(self):
        self.show()
        if self.play and not self.running and not self.screen.calm:
            self.play = False
            self.run()

    async def _run(self, until):
        # JupyterLab may run messages and cells in two threads, and a task is cancelled safely only
        # from its own: so it asks whether it is still the one that runs
        mine, late = asyncio.current_task(), 0
        while self._task is mine:
            began = monotonic()
            made = self._step_batch(mine, until)
            if made or self.error or int(self.pair.waited) > late:
                self.show()
            late = int(self.pair.waited)
            if self.pair.count >= until or (not made and self._at_end):
                self.pause()
            await asyncio.sleep(max(self._frame_period(made) - (monotonic() - began), MIN_PAUSE))
            while self._task is mine and not self.screen.free and not self.pair.live:
                await self.screen.wait_until_drawn()

    @property
    def _at_end(self):
        return self.pair.exhausted and not self.pair.drivable

    def _frame_period(self, made):
        """Time from one frame to the next [s], the inverse of the frame rate."""
        if made:
            return max(1 / self.speed, 1 / self.frame_rate)
        return MIN_PAUSE if self.pair.waited else IDLE_POLL

    def _step_batch(self, mine, until):
        """Make the steps of one frame; how many there were."""
        began, first = monotonic(), self.pair.count
        most = min(first + max(self.speed / self.frame_rate, 1), until)
        while self._task is mine and self.pair.count < most:
            before, spent = self.pair.count, monotonic() - began
            timeout = 0 if self.pair.waited else max(READING_TIMEOUT - spent, 0)
            done = self.attempt(lambda timeout=timeout: self.pair.step(timeout))
            if not done or self.pair.count == before:
                break
            self.drive_control.steer()
            if monotonic() - began > MAX_BURST:
                break
        return self.pair.count - first


def stop():
    """Stop the run loop that runs; harmless when none does."""
    if _running is not None:
        _running.pause()
