"""Beams, walls and intersections of their lines, for rays and echoes."""

import numpy as np

TOLERANCE = 1e-6  # [m]; a way that works by small differences errs by less


def unit(angle):
    """Unit vectors (..., 2) in directions (...)."""
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def crossing(p, phi, wall):
    """Intersections of lines: t (n,) along the beam [m], s (n,) as share of the wall (n, 4)."""
    u, w, d = unit(phi), wall[:, 2:] - wall[:, :2], wall[:, :2] - p
    return cross(d, w) / cross(u, w), cross(d, u) / cross(u, w)


def distance_is(inputs, outputs, right):
    """(n,) whether a distance, or infinity, came back where ``right`` (n,) has one."""
    met = np.isfinite(right)
    with np.errstate(invalid="ignore"):
        near = abs(outputs["distance"] - right) <= TOLERANCE
    return (outputs["met"] == met) & (near | ~met)


def as_outputs(right):
    """Distances (n,) as the drive's {"met", "distance"}."""
    met = np.isfinite(right)
    return {"met": met.astype(float), "distance": np.where(met, right, 0.0)}
