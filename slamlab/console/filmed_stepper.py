"""Stepper of a console: dead reckoning runs beside, and each step may be filmed."""

import numpy as np

from slamlab.estimators.dead_reckoning import DeadReckoning
from slamlab.views.colours import COLOURS
from slamlab.views.live.run_scene import run_layers
from slamlab.views.live.stepper import Stepper

NAIVE = "naive"


class FilmedStepper(Stepper):
    """Pair of source and estimator with the naive track in grey, and a film of it where wanted.

    Parameters
    ----------
    make_source, make_estimator : see :class:`Stepper`
    film : FilmRecorder or None

    ``filming`` says whether steps go into the film.
    """

    def __init__(self, make_source, make_estimator, film=None):
        naive = {NAIVE: lambda source: DeadReckoning()}
        grey = {NAIVE: COLOURS["before"]}
        super().__init__(make_source, make_estimator, beside=naive, colours=grey, note=_pose)
        self._film, self.filming = film, film is not None

    @property
    def filmed(self):
        """bool, whether there is a film to go into."""
        return self._film is not None

    def _process(self, reading):
        super()._process(reading)
        if self.filming:
            self._film.add(self.scene())

    def _layers(self):
        # an estimator that has a naive map of its own shows that
        own = {layer.name for layer in self.estimator.layers()}
        beside = {name: each for name, each in self.others.items() if name not in own}
        return run_layers(self.source, self.estimator, beside, self.count)


def _pose(pair):
    x, y, theta = pair.estimator.pose
    return f"pose {x:.3f} m, {y:.3f} m, {np.degrees(theta):.1f}°"
