"""Makes the pictures of the README: ``python docs/make_pictures.py [NAME ...]``.

The Intel map needs the recording (``SLAMLAB_DATA`` or ``data/``), the picture of a check Chromium.
"""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import nbformat
import numpy as np
from nbclient import NotebookClient
from nbconvert import HTMLExporter

from slamlab import estimators, sources, views
from slamlab.estimators.runner import run
from slamlab.geometry import transform
from slamlab.layers import Points, Poses

DOCS = Path(__file__).resolve().parent
MOST = 150_000  # of a picture [bytes]

SET_UP = "import numpy as np\nfrom slamlab.checks import check"
MISTAKE = '''\
def next_pose(pose, step):
    """The pose after a step: forward, left and turn, measured in the frame of the pose before."""
    x, y, theta = pose
    forward, left, turn = step
    c, s = np.cos(theta + turn), np.sin(theta + turn)
    return np.array([x + c * forward - s * left, y + s * forward + c * left, theta + turn])'''


def intel():
    """A real robot's log: what its wheels draw, and what scans and closed loops make of it."""
    source = sources.open(sources.recording("intel"))
    title = "Intel Research Lab: "
    return before_and_after(source, "graph", (11, 5.5), title, thin=2, shared=False)


def polygon():
    """The cardboard polygon of the thesis, given odometry that is wrong on purpose."""
    source = sources.open("sim:polygon-wrong", np.random.default_rng(1))
    return before_and_after(source, "icp", (9, 4.4), "Cardboard polygon: ")


def situations():
    """Smolec's two situations: walls in blue, what EKF-SLAM with walls makes of the scans."""
    panels = {}
    for name in ("situation-1", "situation-2"):
        source = sources.open(f"sim:{name}", np.random.default_rng(1))
        result = run(source, estimators.make("walls", source))
        wheels = Poses("naive", result.naive.poses)
        panels[f"{name}: EKF-SLAM with walls"] = [wheels, *result.estimator.layers()]
    return views.png(views.side_by_side(panels, (11, 5.2), shared=False)[0])


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
    """A wrong solution and what the check says of it, as the notebook shows them."""
    cells = [nbformat.v4.new_code_cell(text) for text in (SET_UP, MISTAKE, 'check("01-next-pose")')]
    notebook = nbformat.v4.new_notebook(cells=cells)
    NotebookClient(notebook, kernel_name="python3").execute()
    del notebook.cells[0]
    page, _ = HTMLExporter(mathjax_url="", require_js_url="").from_notebook_node(notebook)
    return photograph(page, (1000, 465))


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


PICTURES = {"intel": intel, "polygon": polygon, "situations": situations, "check": check}


def main(names):
    """Make the pictures named, all without a name."""
    for name in names or PICTURES:
        if name not in PICTURES:
            sys.exit(f"no picture {name!r}: there are {', '.join(PICTURES)}")
        picture = PICTURES[name]()
        if len(picture) > MOST:
            sys.exit(f"{name}: {len(picture)} bytes, more than {MOST}")
        (DOCS / f"{name}.png").write_bytes(picture)
        print(f"docs/{name}.png: {len(picture) // 1000} kB")


if __name__ == "__main__":
    main(sys.argv[1:])
