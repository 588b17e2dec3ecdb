"""Films: size relative to the live view's frames, and time to seek a frame.

To seek a frame, a film is replayed from its first frame, so the last frame takes longest. Goals for
a run of 290 frames: 100 kB with walls, 800 kB with point clouds, and 7 ms.
"""

import json
import statistics
import sys
import tempfile
from pathlib import Path

import numpy as np

from benchmarks.common import Missing, main, row
from classroom.lecturing.headless import Unavailable, chromium
from slamlab import estimators, sources
from slamlab.live import films
from slamlab.live.frame_packing import FramePacker
from slamlab.live.run_scene import run_scene

TITLE = "Films of runs, played in headless Chromium (wall time)"
RUNS = {  # world, estimator, goal [kB]
    "walls": ("situation-1", "walls", 100),
    "clouds": ("situation-1", "icp", 800),
}
GOAL_MS = 7
LIVE = "the live view's frames"

# milliseconds from the first frame to the last one, each time
REPLAY = """async (times) => {
    const film = await Film.read(filmOfPage()), found = [];
    for (let time = 0; time < times; time++) {
        film.seek(0);
        const begin = performance.now();
        film.seek(film.last);
        found.push(performance.now() - begin);
    }
    return found;
}"""


def filmed(path, world, estimator):
    """Record a run.

    Parameters
    ----------
    path : Path, of the film
    world, estimator : str

    Returns
    -------
    int, bytes that a live view sends of the same frames
    """
    source = sources.simulation(world, np.random.default_rng(0))
    made, packer, sent = estimators.make(estimator, source), FramePacker(), 0
    with films.FilmRecorder(path, world, "a run") as film:
        for count, reading in enumerate(source, 1):
            made.step(reading)
            scene = run_scene(source, made, {}, count, reading.time)
            layers, rows = packer.pack(scene.drawables)
            sent += len(json.dumps([scene.status, layers])) + len(rows)
            film.add(scene)
    return sent


def run(quick):
    """Make rows for each run: size relative to the live view's frames and the goal, and replay
    time."""
    found = []
    with tempfile.TemporaryDirectory() as folder:
        try:
            with chromium() as browser:
                page = browser.new_page(reduced_motion="reduce")
                for name, (world, estimator, goal) in RUNS.items():
                    path = Path(folder, f"{name}.film")
                    sent = filmed(path, world, estimator)
                    size = path.stat().st_size / 1e3
                    shown = path.with_suffix(".html")
                    shown.write_text(films.page(path), encoding="utf-8")
                    page.goto(shown.as_uri())
                    page.locator(".slamlab-live[data-frame]").wait_for()
                    # a browser's clock may stand for a tenth of a millisecond, or longer
                    took = max(statistics.median(page.evaluate(REPLAY, 9 if quick else 99)), 0.05)
                    found += [
                        row(f"size: {name}", size / 1e3, "kB", LIVE, sent / size),
                        row(
                            f"size: {name}", size / 1e3, "kB", f"goal {goal} kB", goal * 1e3 / size
                        ),
                        row(f"replay: {name}", took, "ms", f"goal {GOAL_MS} ms", GOAL_MS / took),
                    ]
        except Unavailable as reason:
            raise Missing(str(reason)) from None
    return found


if __name__ == "__main__":
    sys.exit(main({TITLE: run}, "python -m benchmarks.films"))
