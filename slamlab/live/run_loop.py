"""Event loop of a live view: steps an estimator, shows frames, and waits until they are drawn."""

import asyncio
from dataclasses import replace
from math import inf
from time import monotonic

from slamlab.live.drive_control import COMMANDS, DriveControl, velocities
from slamlab.live.frame_packing import Scene

FRAME_RATE = 20  # frames a second, at most; faster steps share a frame [1/s]
MIN_PAUSE = 0.005  # [s] between two frames, in which the kernel handles other messages
MAX_BURST = 0.1  # [s] of steps in a row, then a frame
IDLE_POLL = 0.02  # [s] between two checks for a command while the robot stands
READING_TIMEOUT = 0.02  # [s] a frame for which a source's reading may block the kernel

_running = None  # the one loop that runs


class RunLoop:
    """Runs, pauses, steps, resets and drives an EstimatorRun, and shows its scenes on a screen.
    ``pair`` (source and estimator) must already be reset. ``speed`` is in steps/s; ``tops`` are the
    top velocities of commands [m/s, rad/s]. With ``play``, the loop runs as soon as a browser shows
    the view, unless the reader prefers reduced motion. ``on_change()`` is called when the loop
    runs, pauses or gets another source.
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
        return self._frame_rate or FRAME_RATE

    @property
    def running(self):
        return self._task is not None

    def run(self):
        """Run; if the source has ended or was released, start again from the first reading."""
        if (self._at_end or self._released) and not self.attempt(self._restart):
            self.show()
        else:
            self._start()

    def pause(self):
        """Pause after this step, and stop a real robot."""
        global _running
        if self.running:
            self.drive_control.release()
        self._task = None
        if _running is self:
            _running = None
        self.on_change()

    def step(self):
        """Perform one step, then pause."""
        self.pause()
        before = self.pair.count
        self.attempt(lambda: self.pair.step(READING_TIMEOUT))
        self._run_until(before + 1)
        self.show()

    def close(self):
        self.pause()
        self.attempt(self.pair.close)

    def reset(self, seed=None, pair=None):
        """Create a new source and estimator, or those of another run, then pause."""
        self.close()
        self.seed = self.seed if seed is None else seed
        self.pair = self.pair if pair is None else pair
        self.attempt(self._restart)
        self._run_until(1)
        self.on_change()
        self.show()

    def drive(self, name):
        """Execute a named command: steer while the loop runs, otherwise drive one step."""
        if name in COMMANDS and self.drive_control.set_velocity(velocities(name, self.tops)):
            self.show()

    def release(self):
        """Release the source (its devices) until the next run or reset."""
        self.close()
        self._released = True

    def show(self):
        error = self.error
        self.error = (self.attempt(self._update_scene) and error) or self.error
        scene = self._scene
        if self.error:
            scene = replace(scene, status=f"⚠ {self.error}")
        self.screen.offer(scene)

    def _update_scene(self):
        scene = self.pair.scene()
        _ = scene.drawables  # raises an error here, not while the frame is sent
        self._scene = scene

    def _restart(self):
        self._released = False
        self.pair.reset(self.seed, READING_TIMEOUT)

    def _run_until(self, count):
        """If the source delays its readings, run until ``count`` readings are processed."""
        if not self.error and self.pair.count < count and self.pair.waited:
            self._start(count)

    def _start(self, until=inf):
        global _running
        stop()
        _running = self
        self._task = asyncio.get_running_loop().create_task(self._run(until))
        self.on_change()

    def attempt(self, function):
        """Call a function and return whether it succeeds. An error stops the loop and is shown."""
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
        # JupyterLab may run messages and cells in two threads, and a task can be cancelled safely
        # only from its own thread: so it checks whether it is still the current task
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
        if made:
            return max(1 / self.speed, 1 / self.frame_rate)
        return MIN_PAUSE if self.pair.waited else IDLE_POLL

    def _step_batch(self, mine, until):
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
    if _running is not None:
        _running.pause()


def error_line(error):
    """Return an exception's text in one line; for a ValueError, without its type."""
    text = " ".join(str(error).split()) or "no message"
    # a ValueError is raised with a complete message
    return text if isinstance(error, ValueError) else f"{type(error).__name__}: {text}"
