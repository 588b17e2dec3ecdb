"""Make the pictures of README and guides: ``python docs/make_pictures.py [NAME ...]``.

The Intel map needs the recording (``SLAMLAB_DATA`` or ``data/``), the picture of a check Chromium.
"""

import argparse
import io
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import nbformat
import numpy as np
from nbclient import NotebookClient
from nbconvert import HTMLExporter
from PIL import Image

from slamlab import estimators, sources, views
from slamlab.estimators.runner import run
from slamlab.geometry import transform
from slamlab.layers import Points, Poses

DOCS = Path(__file__).resolve().parent
MOST = 150_000  # of a picture [bytes]

SET_UP = "import numpy as np\nfrom classroom.checks import check"
MISTAKE = '''\
def next_pose(pose, step):
    """The pose after a step: forward, left and turn, measured in the frame of the pose before."""
    x, y, theta = pose
    forward, left, turn = step
    c, s = np.cos(theta + turn), np.sin(theta + turn)
    return np.array([x + c * forward - s * left, y + s * forward + c * left, theta + turn])'''


def intel():
    """A real robot's log: the map by odometry alone, and by scan matching with closed loops."""
    source = sources.open(sources.recording("intel"))
    title = "Intel Research Lab: "
    return before_and_after(source, "graph", (11, 5.5), title, thin=2, shared=False)


def situations():
    """The two situations of lesson 09, mapped by EKF-SLAM with walls."""
    panels = {}
    for name in ("situation-1", "situation-2"):
        source = sources.open(f"sim:{name}", np.random.default_rng(1))
        result = run(source, estimators.make("walls", source))
        odometry = Poses("naive", result.naive.poses)
        panels[f"{name}: EKF-SLAM with walls"] = [odometry, *result.estimator.layers()]
    return views.png(views.side_by_side(panels, (11, 5.2), shared=False)[0])


def flat():
    """A simulated flat, mapped by the scans of a lidar in somebody's hand, and the path."""
    source = sources.open("sim:flat-carried")
    result = run(source, estimators.make("graph", source))
    figure, axes = views.axes("A flat, mapped by a lidar carried by hand", size=(8, 6))
    for layer in result.estimator.layers():
        if isinstance(layer, Points):
            views.draw(axes, layer, label="map")
    trajectory = Poses("robot", result.trajectory.poses)
    views.draw(axes, trajectory, label="estimated trajectory")
    views.legend_below(figure)
    return views.png(figure)


def before_and_after(source, estimator, size, title, thin=1, shared=True):
    """The map of a source's readings by odometry alone beside that of an estimator, by its name."""
    readings = list(source)
    result = run(source, estimators.make(estimator, source))
    panels = {}
    for name, kind, poses in (
        ("odometry alone", "naive", result.naive.poses),
        ("odometry and scans", "corrected", result.trajectory.poses),
    ):
        placed = [transform(p, r.scan.points()) for p, r in zip(poses, readings, strict=True)]
        panels[title + name] = [Points(kind, np.vstack(placed)[::thin])]
    return views.png(views.side_by_side(panels, size, shared)[0])


def check():
    """A wrong solution and the result of its check, as the notebook shows them."""
    cells = [nbformat.v4.new_code_cell(text) for text in (SET_UP, MISTAKE, 'check("01-next-pose")')]
    notebook = nbformat.v4.new_notebook(cells=cells)
    NotebookClient(notebook, kernel_name="python3").execute()
    del notebook.cells[0]
    page, _ = HTMLExporter(mathjax_url="", require_js_url="").from_notebook_node(notebook)
    return photograph(page, (1000, 465))


def library():
    """The picture that the first example of library.md draws."""
    text = (DOCS / "library.md").read_text(encoding="utf-8")
    code = re.search(r"^```python\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)[1]
    with tempfile.TemporaryDirectory() as folder:
        environment = os.environ | {"PYTHONPATH": str(DOCS.parent)}
        for words in (["-m", "slamlab", "convert", "sim:room", "robot.readings"], ["-c", code]):
            subprocess.run([sys.executable, *words], cwd=folder, env=environment, check=True)
        return Path(folder, "map.png").read_bytes()


def photograph(page, size):
    """A page of HTML as Chromium shows it, as PNG."""
    chromium = shutil.which("chromium") or shutil.which("google-chrome")
    if not chromium:
        sys.exit("the picture of a check needs Chromium: install it, or name only the others")
    with tempfile.TemporaryDirectory() as folder:
        html, png = Path(folder, "page.html"), Path(folder, "page.png")
        html.write_text(page, encoding="utf-8")
        flags = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking"]
        window = ["--hide-scrollbars", f"--window-size={size[0]},{size[1]}", f"--screenshot={png}"]
        subprocess.run([chromium, *flags, *window, html.as_uri()], check=True, capture_output=True)
        return png.read_bytes()


def with_few_colours(picture):
    """A PNG with a palette of 64 colours, which is a third as large and looks the same."""
    packed = io.BytesIO()
    Image.open(io.BytesIO(picture)).convert("RGB").quantize(64).save(packed, "PNG", optimize=True)
    return packed.getvalue()


PICTURES = {
    "intel": intel,
    "flat": flat,
    "situations": situations,
    "check": check,
    "library": library,
}


def main(argv=None):
    """Make the pictures named, all without a name."""
    parser = argparse.ArgumentParser(prog="make_pictures.py", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(PICTURES))
    parser.add_argument("--out", type=Path, default=DOCS, help="folder to write into (docs/)")
    options = parser.parse_args(argv)
    for name in options.names or PICTURES:
        if name not in PICTURES:
            sys.exit(f"no picture {name!r}: there are {', '.join(PICTURES)}")
        picture = with_few_colours(PICTURES[name]())
        if len(picture) > MOST:
            sys.exit(f"{name}: {len(picture)} bytes, more than {MOST}")
        file = options.out / f"{name}.png"
        file.write_bytes(picture)
        print(f"{file}: {len(picture) // 1000} kB")


if __name__ == "__main__":
    main()
