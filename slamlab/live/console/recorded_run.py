"""Estimator run of the console, with dead reckoning for comparison, recorded as a film."""

import numpy as np

from slamlab.estimators.dead_reckoning import DeadReckoning
from slamlab.live.estimator_run import EstimatorRun
from slamlab.live.run_scene import run_layers
from slamlab.views.colours import COLOURS

NAIVE = "naive"


class RecordedRun(EstimatorRun):
    """Estimator run with the odometry-only track in grey; records each step while ``filming``."""

    def __init__(self, make_source, make_estimator, film=None):
        naive = {NAIVE: lambda source: DeadReckoning()}
        grey = {NAIVE: COLOURS["before"]}
        super().__init__(make_source, make_estimator, beside=naive, colours=grey, note=_pose)
        self._film, self.filming = film, film is not None

    @property
    def filmed(self):
        return self._film is not None

    def _process(self, reading):
        super()._process(reading)
        if self.filming:
            self._film.add(self.scene())

    def _layers(self):
        # some estimators show a naive map of their own; without odometry there is no naive track
        own = {layer.name for layer in self.estimator.layers()}
        if not self.others[NAIVE].has_odometry:
            own.add(NAIVE)
        beside = {name: each for name, each in self.others.items() if name not in own}
        return run_layers(self.source, self.estimator, beside, self.count)


def _pose(run):
    x, y, theta = run.estimator.pose
    return f"pose {x:.3f} m, {y:.3f} m, {np.degrees(theta):.1f}°"
