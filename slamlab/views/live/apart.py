"""Two maps of one estimator side by side: layers of some names are drawn elsewhere."""

from dataclasses import fields, replace

import numpy as np

from slamlab.layers import Points, Poses, Segments


def apart(make, **shifts):
    """An estimator's maker whose estimators show some of their layers beside the others.

    Parameters
    ----------
    make : callable(source) -> Estimator
    shifts : by a layer's name: (dx, dy) by which it is drawn away from where it is [m]

    Returns
    -------
    callable(source) -> Estimator
    """
    return lambda source: _Apart(make(source), shifts)


class _Apart:
    """An estimator, but for where its layers are drawn."""

    def __init__(self, estimator, shifts):
        self.estimator, self._shifts = estimator, shifts

    def __getattr__(self, name):
        return getattr(self.estimator, name)

    def layers(self):
        """The estimator's layers, those with a shift moved."""
        return [_moved(layer, self._shifts.get(layer.name)) for layer in self.estimator.layers()]


def _moved(layer, shift):
    if shift is None:
        return layer
    if not isinstance(layer, Points | Poses | Segments):
        raise TypeError(f"cannot draw {type(layer).__name__} elsewhere")
    _, rows = fields(layer)
    moved = np.array(getattr(layer, rows.name), dtype=float)
    for column in {Points: (0,), Poses: (0,), Segments: (0, 2)}[type(layer)]:
        moved[:, column : column + 2] += shift
    return replace(layer, **{rows.name: moved})
