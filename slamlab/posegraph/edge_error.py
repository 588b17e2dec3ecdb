"""Residual (error) of a pose-graph edge: a measured relative pose against that of two poses."""

from slamlab.geometry import between


def error(x_i, x_j, z):
    """Residual e = z⁻¹ ⊕ (x_i⁻¹ ⊕ x_j): zero where pose j is as measured (Grisetti et al. 2010).

    Parameters
    ----------
    x_i, x_j : (..., 3) poses [m, m, rad]
    z : (..., 3) measured pose of j as seen from i [m, m, rad]

    Returns
    -------
    (..., 3) [m, m, rad], the angle wrapped
    """
    return between(z, between(x_i, x_j))
