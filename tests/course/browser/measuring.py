"""A notebook with live views and a peer, whose speed is measured."""

from tests.course.browser.live import fresh

NAME = "live_benchmark.ipynb"

# a map that grows by 20 points a step, and one that is another at each step; the same for both
WORLD = """\
import asyncio
import ipywidgets
import numpy as np
import time
from slamlab import live, views
from slamlab.layers import Points, Poses
from slamlab.readings import Reading
from slamlab.sources.base import Source
from slamlab.live import run_loop

run_loop.FRAME_RATE = 1000  # as many as the browser takes

class Clock(Source):
    def __iter__(self):
        step = 0
        while True:
            yield Reading(time=float(step))
            step += 1

class Late(Source):
    def __iter__(self):
        while True:
            time.sleep(1)
            yield Reading(time=time.monotonic())

class Cloud:
    status = ""
    def __init__(self, grows):
        self.grows, self.count = grows, 0
        self.rng = np.random.default_rng(0)
        self.points = self.rng.uniform(-5, 5, (20_000, 2))
    def step(self, reading):
        self.count += 1
        if self.grows:
            self.points = np.vstack([self.points, self.rng.uniform(-5, 5, (20, 2))])
        else:
            self.points = self.rng.uniform(-5, 5, (20_000, 2))
    def layers(self):
        x, y = np.cos(self.count / 20), np.sin(self.count / 20)
        return [Points("map", self.points), Poses("corrected", [[x, y, self.count / 20]])]"""

LIVE = """\
_ = live.watch(lambda rng: Clock(), lambda source: Cloud({grows}), "cloud", steps=1, speed=1000)"""

LATE = """\
_ = live.watch(lambda rng: Late(), lambda source: Cloud(True), "a device", steps=1)"""

REDRAWN = """\
image, cloud = ipywidgets.Image(), Cloud(True)
step, run = (ipywidgets.Button(description=text) for text in ("step", "run"))
def redraw(_=None):
    cloud.step(None)
    fig, ax = views.axes("", (7.2, 4.8))
    for layer in cloud.layers():
        views.draw(ax, layer)
    image.value = views.png(fig)
async def go():
    while running:
        redraw()
        await asyncio.sleep(0.005)
running = []
def toggle(_):
    if running:
        running.clear()
    else:
        running.append(asyncio.get_running_loop().create_task(go()))
redraw()
step.on_click(redraw)
run.on_click(toggle)
ipywidgets.VBox([step, run, image])"""


def notebook():
    """A notebook never run: a source and maps, two views of them, one of a device, an image.

    Returns
    -------
    NotebookNode
    """
    cells = [WORLD, LIVE.format(grows=True), LIVE.format(grows=False), LATE, REDRAWN]
    return fresh(*cells)
