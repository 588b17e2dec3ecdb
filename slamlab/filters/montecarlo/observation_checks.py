"""Argument checks of the particle filters: observations with a density, and their ids."""

import numpy as np

from slamlab.filters.argument_checks import observations


def nonsingular_observations(z, R, m=None):
    """Check observations: each needs a positive definite measurement noise (a density).

    Parameters
    ----------
    z : (m, 2) range [m] and bearing [rad]
    R : (2, 2) measurement noise of each, or (m, 2, 2)
    m : int or None, for any

    Returns
    -------
    (m, 2) z, (m, 2, 2) R

    Raises
    ------
    ValueError
    """
    z, R = observations(z, R, m)
    R = np.broadcast_to(R, (len(z), 2, 2))
    if not (R[:, 0, 0] * R[:, 1, 1] > R[:, 0, 1] ** 2).all():
        raise ValueError("R is singular: particle weights need a density, give each variance > 0")
    return z, R


def identified_observations(ids, z, R, known, new):
    """Check observations with ids: all landmarks known or all new, each once.

    Parameters
    ----------
    ids : (m,) int
    z, R : as for :func:`nonsingular_observations`
    known : ids that are there
    new : bool, whether these must not be

    Returns
    -------
    list of ids, (m, 2) z, (m, 2, 2) R

    Raises
    ------
    ValueError
    """
    ids = list(ids)
    z, R = nonsingular_observations(z, R, len(ids))
    if len(set(ids)) < len(ids):
        raise ValueError("a landmark is seen twice in one scan: leave one observation out")
    if new and (there := set(ids) & set(known)):
        raise ValueError(f"already there: {sorted(there)}; update them")
    if not new and (missing := set(ids) - set(known)):
        raise ValueError(f"not there yet: {sorted(missing)}; add them first")
    return ids, z, R
