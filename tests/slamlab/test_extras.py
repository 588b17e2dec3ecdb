"""Without the packages of extras, figures and films work; the rest states what to install."""

import subprocess
import sys

import pytest

NOTEBOOK, LIVE = ("IPython", "ipywidgets", "anywidget", "traitlets"), ("tornado",)
BLOCKED = """
import sys

class Blocker:
    def find_spec(name, *_):
        if name.split(".")[0] in {names}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)

sys.meta_path.insert(0, Blocker)
"""

DRAWN = """
import numpy as np
from slamlab import views
from slamlab.layers import Points

p, P = np.zeros((2, 2)), np.eye(2)
rho, label = np.eye(7), ("x [m]", "y [m]")
fig, ax = views.axes("map")
views.draw(ax, Points("scan", p))
views.legend(ax)
views.legend_below(fig)
chart, across = views.chart(*label)
views.band(across, 0, 1)
views.two_sigma(across, np.arange(2), np.ones(2), np.ones(2), "a")
scene, at = views.boxes.scene("boxes", (-1, 1, -1, 1))
views.boxes.sector(at, (0, 0), (1, 2), (0, 1))
views.boxes.edges(at, [(1, 0, 1)], ["far"])
diagram = {"a": views.Box("step", "a", 1, 1), "b": views.Box("kept", "b", 4, 1)}
figures = [
    fig,
    chart,
    scene,
    views.panels(["a", "b"])[0],
    views.side_by_side({"a": [Points("map", p)]})[0],
    views.cloud(p + [[0, 0], [1, 1]], {"P": P})[0],
    views.curves([0, 1], {"a": [0, 1]}, *label)[0],
    views.against_band([0, 1], {"a": [2, 3]}, (1, 4), *label)[0],
    views.growth([1, 9], {"a": [1, 9]}, {"b": [1, 9]}, *label)[0],
    views.bits(b"ab", {"a": [(0, 1)]})[0],
    views.boxes.intervals({"a": (0, 1), "b": (0, 2)}, 1, *label)[0],
    views.cells({"a": [[0.5]]}, [1], [1], *label)[0],
    views.shares({"a": {"b": (0.5, 0.4, 0.6)}}, "share")[0],
    views.correlation(rho, ["r", "1", "2"])[0],
    views.correlations({"a": rho}, ["r", "1", "2"])[0],
    views.linked(p + [[0, 0], [1, 1]], rho, [1, 2])[0],
    views.overlay(p, p, np.zeros((1, 2), int))[0],
    views.strips({"a": ("scan", [1, 2])}, {"b": 3}, (1, 9), "x [m]")[0],
    views.wheel([0.5, 0.5], {"a": [0.1]})[0],
    views.frames((0, 0, 1), (2, 1)),
    views.encoder(8, 1.0),
    views.process(diagram, [("a", "b", "c")], (6, 2)),
]
for each in figures:
    assert views.png(each).startswith(b"\\x89PNG")
assert views.grouped(10000) == "10 000"
"""

FILMED = """
import numpy as np
from slamlab.layers import Points
from slamlab.live import shift_layers, films
from slamlab.live.frame_packing import Scene

with films.FilmRecorder(sys.argv[1], "a film", "A point.") as film:
    film.add(Scene([Points("map", np.zeros((1, 2)))], "step 1"))
((status, _),) = films.load(sys.argv[1])
assert status == "step 1"
assert "A point." in films.page(sys.argv[1])
"""

ASKED = """
from slamlab import live, views
from slamlab.extras import ExtraMissing

figure, _ = views.axes()
for ask in (
    lambda: views.show(figure, "A map."),
    lambda: views.explore(lambda a: figure, "A map.", a=True),
    lambda: live.watch,
    lambda: live.edit_world,
):
    try:
        ask()
    except ExtraMissing as error:
        print(error)
"""


def run(names, code, *words):
    """Run code in a Python of its own, in which packages of some names are not installed."""
    code = BLOCKED.format(names=names) + code
    return subprocess.run([sys.executable, "-c", code, *words], capture_output=True, text=True)


def report(package, extra):
    return f'{package} is not installed: pip install "slam-course-lab[{extra}]"\n'


@pytest.mark.parametrize("code", [DRAWN, FILMED], ids=["figures", "films"])
def test_without_any_extra_figures_are_drawn_and_films_recorded(code, tmp_path):
    ran = run(NOTEBOOK + LIVE, code, str(tmp_path / "a.film"))
    assert ran.returncode == 0, ran.stderr


def test_a_function_that_needs_a_notebook_states_in_one_line_what_to_install():
    ran = run(NOTEBOOK, ASKED)
    message = report("IPython", "notebook") + 3 * report("ipywidgets", "notebook")
    assert (ran.returncode, ran.stdout) == (0, message), ran.stderr


def test_the_command_line_prints_such_a_line_and_ends_with_2():
    code = "from slamlab.cli import main; sys.exit(main(['live', 'sim:room', '--no-open']))"
    ran = run(LIVE, code)
    message = f"slamlab live: {report('tornado', 'live')}"
    assert (ran.returncode, ran.stdout, ran.stderr) == (2, "", message)


def test_slamlab_live_needs_no_package_of_a_notebook():
    ran = run(
        NOTEBOOK, "from slamlab.live.console import control_panel, recorded_run, live_sources"
    )
    assert ran.returncode == 0, ran.stderr
