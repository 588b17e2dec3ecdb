"""Line extraction as in Smolec's printed listing; see ``ransac`` for the corrected version."""

import numpy as np


def ordinary_least_squares(points):
    """Fit y = m x + c to points (n, 2) by ordinary least squares; return (ρ ≥ 0 [m], α [rad]): m =
    σ_xy / σ_x², c = ȳ − m x̄, normal along (−m, 1). Equation (08.1)."""
    centre = points.mean(axis=0)
    x, y = (points - centre).T
    alpha = np.arctan2(x @ x, -(x @ y))
    rho = centre @ [np.cos(alpha), np.sin(alpha)]
    return (rho, alpha) if rho >= 0 else (-rho, alpha - np.pi)


def sampled_lines(points, rng, ransac, samples, fit):
    """Find lines (ρ, α) at ``samples`` random points: fit a window, count inliers, refit (Smolec
    §4.3). ``points`` (n, 2) [m] are in the order of the beams; ``fit(points)`` returns (ρ, α)."""
    if len(points) < ransac.window:
        return []
    found = []
    around = np.arange(ransac.window) - ransac.window // 2
    for seed in rng.choice(len(points), min(samples, len(points)), replace=False):
        near = points[(seed + around) % len(points)]  # the first and last beam are neighbours
        rho, alpha = fit(near)
        inliers = near[np.abs(near @ [np.cos(alpha), np.sin(alpha)] - rho) < ransac.band]
        if len(inliers) >= ransac.min_inliers:
            found.append(fit(inliers))
    return found
