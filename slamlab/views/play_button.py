"""Play button (animation): the kernel advances a slider."""

import asyncio
from time import monotonic

from slamlab.extras import needs

with needs("notebook"):
    import ipywidgets

FRAME_PERIOD = 0.25  # [s] between two frames, unless drawing is slower
MIN_PAUSE = 0.05  # [s] between two frames, in which the kernel handles a second press

_playing = None  # the one player that runs


class Player:
    """Play button of a slider; each step waits until the previous one is drawn. ValueError: the
    widget is not a slider.
    """

    def __init__(self, slider):
        if not all(slider.has_trait(name) for name in ("min", "max", "step")):
            raise ValueError("play: only a slider can be played. Name a slider")
        self.slider = slider
        self.button = ipywidgets.Button(tooltip="Move the slider automatically")
        self.button.on_click(self._pressed)
        self._task = None
        self._stop()

    def _pressed(self, _):
        running = self._task is not None
        stop()
        if not running:
            self._start()

    def _start(self):
        global _playing
        _playing = self
        self.button.description = "❚❚ pause"
        self._task = asyncio.get_running_loop().create_task(self._run())

    async def _run(self):
        # JupyterLab may run buttons and cells in two threads, and a task can be cancelled safely
        # only from its own thread: so it checks whether it is still the current task
        mine, slider = asyncio.current_task(), self.slider
        if slider.value >= slider.max:
            slider.value = slider.min
            await asyncio.sleep(FRAME_PERIOD)
        while self._task is mine and slider.value < slider.max:
            began = monotonic()
            slider.value = min(slider.value + slider.step, slider.max)
            await asyncio.sleep(max(FRAME_PERIOD - (monotonic() - began), MIN_PAUSE))
        if self._task is mine:
            self._stop()

    def _stop(self):
        global _playing
        self._task = None
        self.button.description = "▶ play"
        if _playing is self:
            _playing = None


def stop():
    if _playing is not None:
        _playing._stop()
