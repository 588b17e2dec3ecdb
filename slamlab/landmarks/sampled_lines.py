"""Lines of walls as Smolec's listing finds them: round a number of random readings, y = m x + c.

:mod:`slamlab.landmarks.ransac` is the same with what is mended: found readings are used up, and
every direction can be fitted.
"""

import numpy as np


def ordinary_least_squares(points):
    """Ordinary least squares of y = m x + c, as ρ and α: a line along y has no m.

    m = σ_xy / σ_x²,  c = ȳ − m x̄; the normal is along (−m, 1). Equation (08.1).

    Parameters
    ----------
    points : (n, 2) [m], at least two

    Returns
    -------
    rho, alpha : floats, rho ≥ 0 [m], [rad]
    """
    centre = points.mean(axis=0)
    x, y = (points - centre).T
    alpha = np.arctan2(x @ x, -(x @ y))
    rho = centre @ [np.cos(alpha), np.sin(alpha)]
    return (rho, alpha) if rho >= 0 else (-rho, alpha - np.pi)


def sampled_lines(points, rng, ransac, samples, fit):
    """Lines round random readings: fitted to neighbours, counted, fitted again (Smolec §4.3).

    Parameters
    ----------
    points : (n, 2) the scan's points in the order of the beams, in the world's frame [m]
    rng : numpy.random.Generator
    ransac : Ransac; its window, band and min_inliers
    samples : int, random readings, none of them twice
    fit : callable(points) -> (ρ, α)

    Returns
    -------
    list of (ρ, α) [m, rad], of one wall any number
    """
    if len(points) < ransac.window:
        return []
    found = []
    around = np.arange(ransac.window) - ransac.window // 2
    for seed in rng.choice(len(points), min(samples, len(points)), replace=False):
        near = points[(seed + around) % len(points)]  # readings are neighbours round the turn
        rho, alpha = fit(near)
        inliers = near[np.abs(near @ [np.cos(alpha), np.sin(alpha)] - rho) < ransac.band]
        if len(inliers) >= ransac.min_inliers:
            found.append(fit(inliers))
    return found
