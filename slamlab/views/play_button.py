"""Play button (animation): moves a slider by itself, in the kernel, one frame a step."""

import asyncio
from time import monotonic

import ipywidgets

FRAME_PERIOD = 0.25  # [s] from one frame to the next, where drawing is no slower
MIN_PAUSE = 0.05  # [s] left to the kernel between two frames, to hear of a second press

_playing = None  # the one player that runs: a cell that is run again leaves none behind


class Player:
    """Play button of a slider: pressed, the slider steps to its end; pressed again, it pauses.

    Each step waits until the one before is drawn, so nothing piles up behind a slow drawing.

    Parameters
    ----------
    slider : of ipywidgets, whose observers draw

    Raises
    ------
    ValueError : when it is no slider
    """

    def __init__(self, slider):
        if not all(slider.has_trait(name) for name in ("min", "max", "step")):
            raise ValueError("play: only a slider can be played, name one of them")
        self.slider = slider
        self.button = ipywidgets.Button(tooltip="move the slider by itself")
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
        # JupyterLab may run buttons and cells in two threads, and a task is cancelled safely only
        # from its own: so it asks whether it is still the one that plays
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
    """Stop the animation that plays; harmless when none does."""
    if _playing is not None:
        _playing._stop()
