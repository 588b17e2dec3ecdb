"""Quantisation (rounding to a grid) of a layer's rows to 16-bit integers, and their packing.

A column's numbers become whole multiples of a step: 1 mm, 0.1 mrad. Where a number is too large for
16 bits, the step is: the smallest of 1, 2, 5, 10, 20 … times the usual one with which all fit.
Columns that are drawn together, such as x and y, have their step in common.
"""

import numpy as np

LARGEST, NO_NUMBER = 32767, -32768  # the latter stands for what is not finite
FINEST = {
    "metres": 1e-3,  # places
    "axes": 1e-3,  # half axes of an ellipse [m]; of what is unknown they are large
    "weight": 1e-3,  # of a sample, where the mean is 1
    "radians": 1e-4,  # an angle is wrapped first, so the step stays
    "seconds": 1e-3,
    "value": 1e-6,  # of a curve, in its own unit
}
COLUMNS = {
    "points": ("metres",) * 2,
    "segments": ("metres",) * 4,
    "boxes": ("metres",) * 4,
    "poses": ("metres", "metres", "radians"),
    "ellipses": ("metres", "metres", "axes", "axes", "radians"),
    "samples": ("metres", "metres", "weight"),
    "curve": ("seconds", "value"),
}
"""What each column of a kind of layer (:class:`slamlab.views.live.frame_packing.Drawable`) is."""


def steps(kind, rows, known=None):
    """Choose the step of each column, no finer than before.

    Parameters
    ----------
    kind : str, of the layer
    rows : (n, width) float
    known : list of float or None, steps in use so far

    Returns
    -------
    list of float, a column
    """
    found = list(known or (FINEST[what] for what in COLUMNS[kind]))
    sizes = np.max(np.abs(rows), axis=0, initial=0.0, where=np.isfinite(rows))
    for what in set(COLUMNS[kind]) - {"radians"}:
        columns = [at for at, each in enumerate(COLUMNS[kind]) if each == what]
        step = max(found[columns[0]], _rounded_up(max(sizes[columns]) / LARGEST))
        for at in columns:
            found[at] = step
    return found


def _rounded_up(least):
    """The smallest of … 0.1, 0.2, 0.5, 1, 2, 5, 10 … that is no smaller."""
    if least <= 0:
        return 0.0
    power = int(np.floor(np.log10(least)))
    choices = (float(f"{digit}e{power}") for digit in (1, 2, 5, 10, 20))
    return next(step for step in choices if step >= least)


def quantise(kind, rows, steps):
    """Quantise rows: each number to the nearest multiple of its column's step.

    Parameters
    ----------
    kind : str, of the layer
    rows : (n, width) float
    steps : list of float, from :func:`steps`

    Returns
    -------
    (n, width) int16; ``NO_NUMBER`` for what is not finite
    """
    rows = np.array(rows, dtype=float)
    turning = [what == "radians" for what in COLUMNS[kind]]
    rows[~np.isfinite(rows)] = np.nan
    rows[:, turning] = np.angle(np.exp(1j * rows[:, turning]))
    whole = np.rint(rows / steps)
    return np.where(np.isnan(whole), NO_NUMBER, whole).astype(np.int16)


def restore(whole, steps):
    """Undo :func:`quantise`, but for half a step: (n, width) float, NaN for what was not finite."""
    return np.where(whole == NO_NUMBER, np.nan, whole * np.array(steps))


def pack(whole):
    """Pack rows: differences down each column, all of their low bytes, then all high ones.

    Neighbours in a scan are near each other, so most high bytes are alike, and gzip packs them.

    Parameters
    ----------
    whole : (n, width) int16

    Returns
    -------
    bytes, 2·n·width
    """
    differences = np.diff(whole.astype(np.uint16), axis=0, prepend=np.uint16(0)).T.ravel()
    low, high = differences & 0xFF, differences >> 8
    return np.concatenate([low, high]).astype(np.uint8).tobytes()


def unpack(data, width):
    """Undo :func:`pack`: (n, width) int16."""
    low, high = np.frombuffer(data, np.uint8).astype(np.uint16).reshape(2, width, -1)
    return np.cumsum(low | high << 8, axis=1, dtype=np.uint16).T.astype(np.int16)
