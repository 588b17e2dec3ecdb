"""Side-by-side maps of one estimator, such as naive and corrected: some layers drawn shifted."""

from dataclasses import fields, replace

import numpy as np

from slamlab.layers import Points, Poses, Segments


def apart(make, **shifts):
    """Wrap an estimator factory so that some layers are drawn beside the others, or not at all.

    Parameters
    ----------
    make : callable(source) -> Estimator
    shifts : by a layer's name: (dx, dy) by which it is drawn away from where it is [m], or None
        where it is not to be drawn

    Returns
    -------
    callable(source) -> Estimator
    """
    return lambda source: _ShiftedLayers(make(source), shifts)


class _ShiftedLayers:
    """Proxy of an estimator whose layers are drawn with an offset."""

    def __init__(self, estimator, shifts):
        self.estimator, self._shifts = estimator, shifts

    def __getattr__(self, name):
        return getattr(self.estimator, name)

    def layers(self):
        """Layers of the estimator, those with a shift moved."""
        return [
            _shift(layer, self._shifts[layer.name]) if layer.name in self._shifts else layer
            for layer in self.estimator.layers()
            if self._shifts.get(layer.name, ()) is not None
        ]


def _shift(layer, shift):
    if not isinstance(layer, Points | Poses | Segments):
        raise TypeError(f"cannot draw {type(layer).__name__} elsewhere")
    _, rows = fields(layer)
    moved = np.array(getattr(layer, rows.name), dtype=float)
    for column in {Points: (0,), Poses: (0,), Segments: (0, 2)}[type(layer)]:
        moved[:, column : column + 2] += shift
    return replace(layer, **{rows.name: moved})
