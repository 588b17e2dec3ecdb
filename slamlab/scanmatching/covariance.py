"""How well a match is known: Censi's covariance, and the directions that no wall fixes."""

from dataclasses import dataclass

import numpy as np

from slamlab.scanmatching.align import least_information, weights


@dataclass(frozen=True)
class Observability:
    """The information H that the pairs hold on [x, y, θ reach], by its eigenvalues.

    Parameters
    ----------
    eigenvalues : (3,) increasing [1/m²]
    directions : (3, 3) their unit vectors in columns
    floor : float, a direction with no more information than that is not fixed [1/m²]
    reach : float, root mean square distance of the source's points [m]
    """

    eigenvalues: np.ndarray
    directions: np.ndarray
    floor: float
    reach: float

    @property
    def fixed(self):
        """(3,) bool, the directions that walls fix."""
        return self.eigenvalues > self.floor

    def in_words(self):
        """What is free to move; empty where all is fixed."""
        free = self.directions[:, ~self.fixed].T
        if len(free) == 0:
            return ""
        if len(free) > 1:
            return f"{('two', 'three')[len(free) - 2]} directions are free"
        x, y, turn = free[0]
        if abs(turn) > np.hypot(x, y):
            return "turns freely"
        return f"slides along {np.degrees(np.arctan2(y, x)) % 180:.0f}°"


def observability(source, target, pairs, width):
    """What the walls fix at a minimum of Σ ρ(r), ρ' = w r.

    Parameters
    ----------
    source, target : Surface
    pairs : Pairs at the minimum
    width : float c of the weights [m]

    Returns
    -------
    Observability; (3, n) the sensitivity ∂g/∂r of its gradient g to each residual
    """
    # ρ'' turns negative for far pairs, which hold nothing
    u, w = (pairs.residuals / width) ** 2, weights(pairs, width, True)
    sensitivity = pairs.J * np.maximum(w * (1 - 3 * u) / (1 + u), 0.0)
    values, axes = np.linalg.eigh(sensitivity @ pairs.J.T)
    floor = least_information(pairs, w, target, values.sum())
    return Observability(values, axes, floor, source.reach), sensitivity


def censi(source, target, pairs, width):
    """Covariance of the pose that minimises Σ ρ(r), from the noise of the points alone.

    P = H⁻¹ (∂g/∂z) cov(z) (∂g/∂z)ᵀ H⁻¹ with the gradient g of Σ ρ and H its derivative (Censi 2007,
    "An accurate closed-form estimate of ICP's covariance"). A point of the source has one residual;
    one of the target has a share in every line that is fitted through it. In a direction that no
    wall fixes the pose is as doubtful as the surface is wide.

    Parameters
    ----------
    source, target : Surface
    pairs : Pairs at the minimum
    width : float c of the weights [m]

    Returns
    -------
    (3, 3) covariance of [x, y, θ] [m, m, rad]
    """
    seen, g = observability(source, target, pairs, width)
    M = (g * source.fits.across) @ g.T + of_target(g, pairs.place, target)
    axes, fixed = seen.directions, seen.fixed
    back = axes * (fixed / np.where(fixed, seen.eigenvalues, 1))
    P = back @ (axes.T @ M @ axes) @ back.T + (axes * (~fixed * seen.reach**2)) @ axes.T
    scale = np.array([1, 1, 1 / seen.reach])
    return P * scale * scale[:, None]


def of_target(g, place, target):
    """Σ_j G_j G_jᵀ v_j over the target's points, G_j what all pairs' sensitivities to it sum to."""
    windows = target.fits.windows
    if windows is not None:
        g = g / windows.count[place]
    G = np.array([np.bincount(place, row, len(target)) for row in g])
    if windows is not None:  # a line is the mean of its points, each has its share in it
        G = windows.sums(G)
    return (G * target.fits.across) @ G.T
