"""Beams, walls, and where their lines cross: what the tasks of rays and echoes share."""

import numpy as np

TOLERANCE = 1e-6  # [m]; a way that works by small differences errs by less


def unit(angle):
    """(..., 2) unit vectors in directions (...)."""
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def cross(a, b):
    """(...) a × b of vectors (..., 2)."""
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def crossing(p, phi, wall):
    """Where the lines of beams and walls cross.

    Parameters
    ----------
    p, phi, wall : (n, 2), (n,), (n, 4)

    Returns
    -------
    t, s : (n,) the way along the beam [m] and the share of the wall
    """
    u, w, d = unit(phi), wall[:, 2:] - wall[:, :2], wall[:, :2] - p
    return cross(d, w) / cross(u, w), cross(d, u) / cross(u, w)


def distance_is(inputs, outputs, right):
    """(n,) whether what came back is a distance, or infinity where ``right`` (n,) is."""
    met = np.isfinite(right)
    with np.errstate(invalid="ignore"):
        near = abs(outputs["distance"] - right) <= TOLERANCE
    return (outputs["met"] == met) & (near | ~met)


def as_outputs(right):
    """What the drive makes of distances (n,): {"met", "distance"}."""
    met = np.isfinite(right)
    return {"met": met.astype(float), "distance": np.where(met, right, 0.0)}
