"""The film on the site's first page: a robot maps Smolec's second room by its walls."""

import numpy as np

from course.site.moving_pictures import shipped
from slamlab import estimators, films, sources
from slamlab.views.live.run_scene import run_scene

NAME = "situation-2"
TITLE = "A robot maps rooms that it has never seen, by their walls"
ALT = (
    "Film of a map as it grows, x across, y up: a robot drives round a corner through rooms; points "
    "of its laser gather along walls, and lines through them become its map."
)
PLACE = (
    f'<div class="slamlab-film" data-folder="_static/" data-file="{NAME}.js">'
    f"<p>Here a film plays: {TITLE}.</p></div>"
)


def files(cache):
    """The film as the site ships it, made now or before.

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
