"""Live view (visualisation) in a notebook: its widgets, and the still picture that is stored."""

import ipywidgets
import numpy as np

from slamlab.layers import Points
from slamlab.views.colours import COLOURS, in_legends
from slamlab.views.figures import UNIT, axes
from slamlab.views.layer_drawing import draw
from slamlab.views.legends import legend_below
from slamlab.views.live.cell_views import loops_of_this_cell
from slamlab.views.live.controls import Controls
from slamlab.views.live.drive_commands import velocities
from slamlab.views.live.raster import RasterScreen
from slamlab.views.live.run_loop import RunLoop, stop
from slamlab.views.live.stepper import Stepper
from slamlab.views.showing import bundle, show_beside_still

FIRST_READING_TIMEOUT = 3.0  # [s] that a notebook's cell waits for a reading


def live(
    source,
    estimator,
    alt,
    *,
    steps=20,
    script=(),
    beside=None,
    extra=None,
    note=None,
    curves=None,
    truth=True,
    colours=None,
    title="",
    seed=0,
    speed=5,
    tops=(0.4, 0.6),
    play=False,
    size=(720, 480),
    raster=False,
):
    """Live view: run an estimator on a source and store a still picture of its first steps.

    The first steps are made at once, so that a mistake surfaces as any other; the picture after
    them is a display of its own, which a notebook keeps, and where a browser shows the live view,
    it goes on from there. Calling this stops whatever runs, so that a cell can be run again.

    A source may wait for a device: all else in the notebook goes on meanwhile. One made here is
    closed when the cell is run again or the view is gone; one handed in ready-made stays open.

    Parameters
    ----------
    source : callable(rng) -> Source, such as ``partial(sources.simulation, "room")``; or a Source;
        or a dict of them by title, for a button each, the first one first
    estimator : callable(source) -> Estimator, such as ``partial(estimators.make, "icp")``; or an
        Estimator, which then cannot be reset
    alt : str, what the still picture shows
    steps : int, readings taken in for the still picture; fewer where a source gives none for 3 s
    script : sequence of names of commands that follow them, such as ``["forward", "left"]``
    beside : dict or None, name to callable(source) -> Estimator, whose track is drawn, too
    extra : callable(pair) -> layers to draw beneath, or None
    note : callable(pair) -> str, more for the status line, or None
    curves : dict or None, title of a panel below the map, such as "error [m]", to a dict of a
        line's name to callable(pair) -> float, called after each step
    truth : bool, whether the true track is drawn where it is known
    colours : dict or None, name to colour where it is not the usual one
    title : str
    seed : int, what source and estimator are made anew from
    speed : float, steps a second
    tops : (speed, turn rate) that the buttons command [m/s, rad/s]
    play : bool, whether it runs as soon as a browser shows it whose reader likes motion
    size : (width, height) [pixels]
    raster : bool, a picture of plain ipywidgets, for where anywidget is missing or not let in

    What is called with the pair may look at its ``source``, ``estimator``, ``others`` (by name),
    ``count`` (readings taken in) and ``time`` [s].

    Returns
    -------
    RunLoop, to look at or drive from another cell

    Raises
    ------
    ValueError : without a text; a script for what cannot be driven
    """
    stop()
    loops = loops_of_this_cell()
    given = source if isinstance(source, dict) else {title: source}
    steppers = {
        name: Stepper(each, estimator, beside, extra, note, curves, truth, colours)
        for name, each in given.items()
    }
    stepper = next(iter(steppers.values()))
    shown = _screen_class(raster)(alt=alt, title=title, size=size)
    loop = RunLoop(stepper, shown, seed, speed, tops, play)
    loops.append(loop)
    stepper.reset(seed, FIRST_READING_TIMEOUT)
    while 0 < stepper.count < steps and stepper.step(FIRST_READING_TIMEOUT):
        pass
    for name in script:
        stepper.drive(velocities(name, tops))
    still = bundle(still_picture(stepper.scene(), title, size), alt)
    loop.show()
    show_beside_still(ipywidgets.VBox([Controls(loop, steppers).widget, shown.widget]), still)
    return loop


def still_picture(scene, title, size):
    """Still picture of a scene: a figure with the map and the panels of curves.

    Parameters
    ----------
    scene : Scene
    title : str
    size : (width, height) [pixels]

    Returns
    -------
    Figure
    """
    count = len(scene.curves)
    wide, high = size[0] / UNIT, size[1] / UNIT + count
    fig, ax = axes(title or None, (wide, high))
    panels = []
    if count:
        grid = fig.add_gridspec(1 + count, 1, height_ratios=[size[1] / UNIT - 1, *[1] * count])
        ax.set_subplotspec(grid[0])
        panels = [fig.add_subplot(grid[row + 1]) for row in range(count)]
    for below, (panel, lines) in zip(panels, scene.curves.items(), strict=True):
        below.set(ylabel=panel)
        below.grid(color=COLOURS["guide"], linewidth=0.5)
        for name, values in lines.items():
            below.plot(*np.transpose(values), color=scene.line_colour(name), label=in_legends(name))
    if panels:
        panels[-1].set_xlabel("t [s]")
    named = set()
    for layer, drawable in zip(scene.layers, scene.drawables, strict=False):
        # one entry in the legend for all that has a name
        label = f"_{layer.name}" if layer.name in named else in_legends(layer.name)
        named.add(layer.name)
        few = isinstance(layer, Points) and len(layer.xy) <= 300
        style = {"markersize": 7} if few else {}
        draw(ax, layer, color=drawable.colour, label=label, **style)
    if named:
        legend_below(fig)
    fig.suptitle(scene.status, fontsize=9)
    return fig


def _screen_class(raster):
    """Class of screen to draw on; anywidget is imported late: most notebooks need none."""
    if raster:
        return RasterScreen
    try:
        from slamlab.views.live.canvas import LiveCanvas
    except ImportError:
        return RasterScreen
    return LiveCanvas
