"""The film on the site's first page: EKF-SLAM with walls in situation 2."""

import numpy as np

from course.site.moving_pictures import shipped
from slamlab import estimators, sources
from slamlab.live import films
from slamlab.live.run_scene import run_scene

NAME = "situation-2"
TITLE = "A robot maps unknown rooms by their walls"
ALT = (
    "Film of a growing map, x across, y up: a robot drives around a corner through rooms; laser "
    "points accumulate along walls, and lines fitted to the points form the map."
)
PLACE = (
    f'<div class="slamlab-film" data-folder="_static/" data-file="{NAME}.js">'
    f"<p>Film: {TITLE}.</p></div>"
)


def files(cache):
    """Return the film as a script, newly recorded or from the cache.

    Parameters
    ----------
    cache : Path

    Returns
    -------
    dict, name of the file to bytes
    """
    script = cache / f"{NAME}.js"
    if not script.exists():
        cache.mkdir(parents=True, exist_ok=True)
        source = sources.simulation(NAME, np.random.default_rng(1))
        estimator, naive = estimators.make("walls", source), estimators.DeadReckoning()
        film = cache / f"{NAME}.film"
        with films.FilmRecorder(film, TITLE, ALT) as recorder:
            for count, reading in enumerate(source, 1):
                estimator.step(reading)
                naive.step(reading)
                scene = run_scene(source, estimator, {"naive": naive}, count, reading.time)
                recorder.add(scene)
        shipped(film)
    return {f"_static/{script.name}": script.read_bytes()}
