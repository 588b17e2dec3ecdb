"""Shifted layers: maps of one estimator side by side."""

from dataclasses import fields, replace

import numpy as np

from slamlab.layers import Points, Poses, Segments


def shift_layers(make, **shifts):
    """Wrap an estimator factory so that some layers are shifted or omitted. Returns
    callable(source) -> Estimator.

    Parameters
    ----------
    make : callable(source) -> Estimator
    shifts : by a layer's name: (dx, dy) to shift it [m], or None to omit it
    """
    return lambda source: _ShiftedLayers(make(source), shifts)


class _ShiftedLayers:
    def __init__(self, estimator, shifts):
        self.estimator, self._shifts = estimator, shifts

    def __getattr__(self, name):
        return getattr(self.estimator, name)

    def layers(self):
        return [
            _shift(layer, self._shifts[layer.name]) if layer.name in self._shifts else layer
            for layer in self.estimator.layers()
            if self._shifts.get(layer.name, ()) is not None
        ]


def _shift(layer, shift):
    if not isinstance(layer, Points | Poses | Segments):
        raise TypeError(f"cannot shift a layer of type {type(layer).__name__}")
    _, rows = fields(layer)
    moved = np.array(getattr(layer, rows.name), dtype=float)
    for column in {Points: (0,), Poses: (0,), Segments: (0, 2)}[type(layer)]:
        moved[:, column : column + 2] += shift
    return replace(layer, **{rows.name: moved})
