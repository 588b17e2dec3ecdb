"""A button that moves a slider by itself, in the kernel: what the reader sees is drawn live."""

import asyncio
from time import monotonic

import ipywidgets

FRAME = 0.25  # [s] from one picture to the next, where drawing is no slower
BREATH = 0.05  # [s] left to the kernel between two pictures, to hear of a second press

_playing = None  # the one player that runs: a cell that is run again leaves none behind


class Player:
    """A button beside a slider: pressed, the slider steps to its end; pressed again, it stops.

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
        self._rest()

    def _pressed(self, _):
        running = self._task is not None
        stop()
        if not running:
            self._start()

    def _start(self):
        global _playing
        _playing = self
        self.button.description = "■ stop"
        self._task = asyncio.get_running_loop().create_task(self._run())

    async def _run(self):
        # JupyterLab may run buttons and cells in two threads, and a task is cancelled safely only
        # from its own: so it asks whether it is still the one that plays
        mine, slider = asyncio.current_task(), self.slider
        if slider.value >= slider.max:
            slider.value = slider.min
            await asyncio.sleep(FRAME)
        while self._task is mine and slider.value < slider.max:
            began = monotonic()
            slider.value = min(slider.value + slider.step, slider.max)
            await asyncio.sleep(max(FRAME - (monotonic() - began), BREATH))
        if self._task is mine:
            self._rest()

    def _rest(self):
        global _playing
        self._task = None
        self.button.description = "▶ play"
        if _playing is self:
            _playing = None


def stop():
    """Stop whatever plays; harmless when nothing does."""
    if _playing is not None:
        _playing._rest()
