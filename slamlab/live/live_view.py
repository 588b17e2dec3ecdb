"""Live view in a notebook: its widgets, and the still picture stored in the notebook."""

from slamlab.extras import needs
from slamlab.live.controls import Controls
from slamlab.live.drive_control import velocities
from slamlab.live.estimator_run import EstimatorRun
from slamlab.live.raster_screen import RasterScreen
from slamlab.live.run_loop import RunLoop, stop
from slamlab.live.run_scene import still_picture
from slamlab.views.figure_display import bundle, show_beside_still

with needs("notebook"):
    import ipywidgets
    from IPython import get_ipython

FIRST_READING_TIMEOUT = 3.0  # how long a notebook cell waits for a reading [s]
_shown = {}  # cell id to the id of its last run and the loops of its views


def watch(
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
    """Run an estimator on a source in a live view, and store a still picture of its first steps.

    Any other running view stops. A source created here is closed when the cell is run again or the
    view is closed. The functions below receive the run: ``source``, ``estimator``, ``others``,
    ``count`` (readings) and ``time`` [s]. Returns a RunLoop. Raises ValueError without alt text,
    and for a script if the source cannot be driven.

    Parameters
    ----------
    source : callable(rng) -> Source, or a Source, or a dict of them by title (a button for each)
    estimator : callable(source) -> Estimator, or an Estimator, which cannot be reset
    alt : str, description of the still picture
    steps : int, readings in the still picture; fewer if the source delivers none for 3 s
    script : names of drive commands that follow, such as ``["forward", "left"]``
    beside : dict or None, name to callable(source) -> Estimator, whose track is also drawn
    extra : callable(run) -> layers to draw beneath, or None
    note : callable(run) -> str for the status line, or None
    curves : dict or None, title of a panel to dict of a line's name to callable(run) -> float
    truth : bool, whether to draw the true track
    colours : dict or None, name to colour
    title : str
    seed : int
    speed : float [steps/s]
    tops : (speed, turn rate) of the buttons [m/s, rad/s]
    play : bool, whether to run at once, unless the reader prefers reduced motion
    size : (width, height) [pixels]
    raster : bool, without anywidget
    """
    stop()
    loops = _loops_of_this_cell()
    given = source if isinstance(source, dict) else {title: source}
    runs = {
        name: EstimatorRun(each, estimator, beside, extra, note, curves, truth, colours)
        for name, each in given.items()
    }
    first = next(iter(runs.values()))
    shown = _screen_class(raster)(alt=alt, title=title, size=size)
    loop = RunLoop(first, shown, seed, speed, tops, play)
    loops.append(loop)
    first.reset(seed, FIRST_READING_TIMEOUT)
    while 0 < first.count < steps and first.step(FIRST_READING_TIMEOUT):
        pass
    for name in script:
        first.drive(velocities(name, tops))
    still = bundle(still_picture(first.scene(), title, size), alt)
    loop.show()
    show_beside_still(ipywidgets.VBox([Controls(loop, runs).widget, shown.widget]), still)
    return loop


def _loops_of_this_cell():
    """Return the list of run loops of the current cell; close those of the cell's previous run."""
    shell = get_ipython()
    message = shell.get_parent() if hasattr(shell, "get_parent") else {}
    cell, run = message.get("metadata", {}).get("cellId"), message.get("msg_id")
    last, loops = _shown.get(cell, (None, []))
    if cell is None or last == run:
        return loops
    for loop in loops:
        loop.close()
    _shown[cell] = run, []
    return _shown[cell][1]


def _screen_class(raster):
    if raster:
        return RasterScreen
    try:
        from slamlab.live.canvas import LiveCanvas
    except ImportError:
        return RasterScreen
    return LiveCanvas
