"""Scene of a run: layers of the source and its estimators, and the status line."""

import numpy as np

from slamlab.layers import Points, Poses
from slamlab.live.frame_packing import Scene
from slamlab.views.colours import COLOURS, in_legends
from slamlab.views.figures import UNIT, axes
from slamlab.views.layer_drawing import draw
from slamlab.views.legends import legend_below


def run_scene(source, estimator, beside, count, time):
    """Return the scene after ``count`` readings; ``beside`` maps a name to an Estimator."""
    layers = run_layers(source, estimator, beside, count)
    status = step_line(count, len(source), time, estimator.status)
    return Scene(layers, status, source.robot.radius)


def run_layers(source, estimator, beside, count, truth=True):
    """Return the layers: the true track, tracks of other estimators, the estimator's layers."""
    layers = []
    if truth and source.truth is not None:
        layers.append(Poses("truth", source.truth.poses[:count]))
    layers += [Poses(name, each.trajectory().poses) for name, each in beside.items()]
    return layers + estimator.layers()


def step_line(count, whole, time, *more):
    """Return the status line: reading count, total (0: unknown), time [s] and ``more`` texts."""
    step = f"step {count}" + (f" of {whole}" if whole > count else "")
    return " · ".join(part for part in (step, f"t = {time:.1f} s", *more) if part)


def still_picture(scene, title, size):
    """Draw a figure of a scene: a map, and time plots of curves; size in pixels."""
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
        if not len(drawable.rows):
            continue  # such as loops before the first one
        # one legend entry for each name
        label = f"_{layer.name}" if layer.name in named else in_legends(layer.name)
        named.add(layer.name)
        few = isinstance(layer, Points) and len(layer.xy) <= 300
        style = {"markersize": 7} if few else {}
        draw(ax, layer, color=drawable.colour, label=label, **style)
    if named:
        legend_below(fig)
    fig.suptitle(scene.status, fontsize=9)
    return fig
