"""Covariance of a scan match (Censi), and its degenerate, under-constrained directions."""

from dataclasses import dataclass

import numpy as np

from slamlab.scanmatching.registration import information_floor, robust_kernel, robust_weights


@dataclass(frozen=True)
class Observability:
    """Observability of a match: eigenvalues of the information matrix Λ of [x, y, θ reach].

    A degenerate direction, such as that along a corridor, is one that no wall constrains.

    Parameters
    ----------
    eigenvalues : (3,) increasing [1/m²]
    directions : (3, 3) their unit vectors in columns
    floor : float, a direction with no more information than that is degenerate [1/m²]
    reach : float, root mean square distance of the source's points [m]
    """

    eigenvalues: np.ndarray
    directions: np.ndarray
    floor: float
    reach: float

    @property
    def fixed(self):
        """Observable directions, (3,) bool: those that walls fix (constrain)."""
        return self.eigenvalues > self.floor

    @property
    def degenerate(self):
        """Degenerate directions, (3,) bool: under-constrained, no wall fixes them."""
        return ~self.fixed

    def in_words(self):
        """Which directions are degenerate, in words; empty where all are observable."""
        free = self.directions[:, self.degenerate].T
        if len(free) == 0:
            return ""
        if len(free) > 1:
            return f"degenerate: {('two', 'three')[len(free) - 2]} directions are free"
        x, y, turn = free[0]
        if abs(turn) > np.hypot(x, y):
            return "degenerate: turns freely"
        return f"degenerate: slides along {np.degrees(np.arctan2(y, x)) % 180:.0f}°"


def observability(source, target, pairs, kernel_width):
    """Observability at a minimum of Σ ρ(r), ρ' = w r: eigenvalues of the information matrix.

    Parameters
    ----------
    source, target : Surface
    pairs : Pairs at the minimum
    kernel_width : float c of the robust weights [m]

    Returns
    -------
    Observability; (3, n) the sensitivity ∂g/∂r of its gradient g to each residual
    """
    # ρ'' turns negative for far pairs, which hold nothing
    kernel = robust_kernel(pairs, kernel_width)
    w = robust_weights(pairs, kernel, True)
    sensitivity = pairs.J * np.maximum(w * (4 * kernel - 3), 0.0)
    values, axes = np.linalg.eigh(sensitivity @ pairs.J.T)
    floor = information_floor(pairs, w, target, values.sum())
    return Observability(values, axes, floor, source.reach), sensitivity


def censi(source, target, pairs, kernel_width):
    """Censi's covariance of the pose that minimises Σ ρ(r), from the measurement noise alone.

    P = Λ⁻¹ (∂γ/∂z) cov(z) (∂γ/∂z)ᵀ Λ⁻¹ with the gradient γ of Σ ρ and Λ its derivative (Censi 2007,
    "An accurate closed-form estimate of ICP's covariance"), Equation (13.14). A point of the source
    has one residual; one of the target has a share in every line that is fitted through it. In a
    degenerate direction the standard deviation is the width of the surface.

    Parameters
    ----------
    source, target : Surface
    pairs : Pairs at the minimum
    kernel_width : float c of the robust weights [m]

    Returns
    -------
    (3, 3) covariance of [x, y, θ] [m, m, rad]
    """
    seen, g = observability(source, target, pairs, kernel_width)
    M = (g * source.fits.across_variance) @ g.T + _target_noise(g, pairs.association, target)
    axes, degenerate = seen.directions, seen.degenerate
    back = axes * (~degenerate / np.where(degenerate, 1, seen.eigenvalues))
    P = back @ (axes.T @ M @ axes) @ back.T + (axes * (degenerate * seen.reach**2)) @ axes.T
    scale = np.array([1, 1, 1 / seen.reach])
    return P * scale * scale[:, None]


def _target_noise(g, association, target):
    """Share of the target's noise: Σ_j G_j G_jᵀ v_j, G_j the summed sensitivity to its point j."""
    target_index, windows = association.target_index, target.fits.windows
    if windows is not None:
        g = g / windows.count[target_index]
    G = np.array([np.bincount(target_index, row, len(target)) for row in g])
    if windows is not None:  # a line is the mean of its points, each has its share in it
        G = windows.sums(G)
    return (G * target.fits.across_variance) @ G.T
