"""Quantisation of rows as 16-bit multiples of a step (1 mm, 0.1 mrad), and their packing. For large
numbers, the default step is multiplied by the smallest of 1, 2, 5, 10 … for which all values fit.
"""

import numpy as np

LARGEST, NO_NUMBER = 32767, -32768  # the latter stands for non-finite values
FINEST = {
    "metres": 1e-3,  # positions
    "axes": 1e-3,  # half axes of an ellipse [m], which may be very large
    "weight": 1e-3,  # of a particle, relative to the mean
    "radians": 1e-4,  # angles are wrapped first, so the step is fixed
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
"""Quantity in each column, by kind of layer (:class:`slamlab.live.frame_packing.Drawable`)."""


def steps(kind, rows, known=None):
    """Return the step of each column, not finer than the ``known`` steps: list of float."""
    found = list(known or (FINEST[what] for what in COLUMNS[kind]))
    sizes = np.max(np.abs(rows), axis=0, initial=0.0, where=np.isfinite(rows))
    for what in set(COLUMNS[kind]) - {"radians"}:
        columns = [at for at, each in enumerate(COLUMNS[kind]) if each == what]
        step = max(found[columns[0]], _rounded_up(max(sizes[columns]) / LARGEST))
        for at in columns:
            found[at] = step
    return found


def _rounded_up(least):
    """Return the smallest of … 0.1, 0.2, 0.5, 1, 2 … that is not less than ``least``."""
    if least <= 0:
        return 0.0
    power = int(np.floor(np.log10(least)))
    choices = (float(f"{digit}e{power}") for digit in (1, 2, 5, 10, 20))
    return next(step for step in choices if step >= least)


def quantise(kind, rows, steps):
    """Quantise rows to int16, with ``NO_NUMBER`` for non-finite values."""
    rows = np.array(rows, dtype=float)
    turning = [what == "radians" for what in COLUMNS[kind]]
    rows[~np.isfinite(rows)] = np.nan
    rows[:, turning] = np.angle(np.exp(1j * rows[:, turning]))
    whole = np.rint(rows / steps)
    return np.where(np.isnan(whole), NO_NUMBER, whole).astype(np.int16)


def restore(whole, steps):
    """Undo :func:`quantise`, with NaN for non-finite values."""
    return np.where(whole == NO_NUMBER, np.nan, whole * np.array(steps))


def pack(whole):
    """Pack int16 rows as differences down each column: all low bytes, then all high bytes.
    Neighbours in a scan are close together, so most high bytes are equal.
    """
    differences = np.diff(whole.astype(np.uint16), axis=0, prepend=np.uint16(0)).T.ravel()
    low, high = differences & 0xFF, differences >> 8
    return np.concatenate([low, high]).astype(np.uint8).tobytes()


def unpack(data, width):
    low, high = np.frombuffer(data, np.uint8).astype(np.uint16).reshape(2, width, -1)
    return np.cumsum(low | high << 8, axis=1, dtype=np.uint16).T.astype(np.int16)
