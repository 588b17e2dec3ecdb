"""A notebook with live views, for the tests and the benchmark to open."""

import nbformat

SETUP = """\
from functools import partial
from slamlab import estimators, sources, views
from slamlab.layers import Segments"""

DRIVEN = """\
loop = views.live(
    {
        name.capitalize(): partial(sources.simulation, name, tour=False)
        for name in ("room", "corridor")
    },
    partial(estimators.make, "icp"),
    "A robot and the points it has seen.",
    steps=1,
    speed=20,
    extra=lambda source, _: [Segments("walls", source.world.outline())],
)"""

PLAYED = """\
loop = views.live(
    partial(sources.simulation, "landmarks"),
    partial(estimators.make, "mak"),
    "A robot on a loop among landmarks.",
    beside={"naive": lambda source: estimators.Odometry()},
    speed=20,
)"""


def notebook(*cells):
    """A notebook that was never run.

    Parameters
    ----------
    cells : str each

    Returns
    -------
    NotebookNode
    """
    made = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in cells])
    made.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3"}
    return made
