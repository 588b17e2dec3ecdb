"""ICP covariance of a scan match (Censi); detection of degenerate directions (unobservable)."""

from dataclasses import dataclass

import numpy as np

from slamlab.scanmatching.registration import information_floor, robust_kernel, robust_weights


@dataclass(frozen=True)
class Observability:
    """Eigenvalues (3,) [1/m²] and ``directions`` (eigenvectors) (3, 3) of the information matrix of
    [x, y, θ reach]. A direction is degenerate if its eigenvalue is below ``floor``."""

    eigenvalues: np.ndarray
    directions: np.ndarray
    floor: float
    reach: float

    @property
    def fixed(self):
        return self.eigenvalues > self.floor

    @property
    def degenerate(self):
        """Whether each direction is degenerate, (3,) bool: no wall constrains it."""
        return ~self.fixed

    def in_words(self):
        """Describe the degenerate directions, or return ""."""
        free = self.directions[:, self.degenerate].T
        if len(free) == 0:
            return ""
        if len(free) > 1:
            return f"degenerate in {('two', 'three')[len(free) - 2]} directions"
        x, y, turn = free[0]
        if abs(turn) > np.hypot(x, y):
            return "degenerate in rotation"
        return f"degenerate along {np.degrees(np.arctan2(y, x)) % 180:.0f}°"


def observability(source, target, correspondences, kernel_width):
    """Return Observability at a minimum of the cost Σ ρ(r), ρ' = w r, with sensitivity ∂g/∂r."""
    # ρ'' is negative for large residuals, which do not constrain the pose
    kernel = robust_kernel(correspondences, kernel_width)
    w = robust_weights(correspondences, kernel, True)
    sensitivity = correspondences.J * np.maximum(w * (4 * kernel - 3), 0.0)
    values, axes = np.linalg.eigh(sensitivity @ correspondences.J.T)
    floor = information_floor(correspondences, w, target, values.sum())
    return Observability(values, axes, floor, source.reach), sensitivity


def icp_covariance(source, target, correspondences, kernel_width):
    """Compute the covariance (3, 3) of the matched pose due to the measurement noise: P = Λ⁻¹
    (∂γ/∂z) cov(z) (∂γ/∂z)ᵀ Λ⁻¹ with the gradient γ of the cost Σ ρ and its Hessian Λ (Censi 2007,
    "An accurate closed-form estimate of ICP's covariance"). Equation (13.14). The standard
    deviation of a degenerate direction is the extent of the source."""
    seen, g = observability(source, target, correspondences, kernel_width)
    M = (g * source.fits.across_variance) @ g.T + _target_noise(
        g, correspondences.association, target
    )
    axes, degenerate = seen.directions, seen.degenerate
    back = axes * (~degenerate / np.where(degenerate, 1, seen.eigenvalues))
    P = back @ (axes.T @ M @ axes) @ back.T + (axes * (degenerate * seen.reach**2)) @ axes.T
    scale = np.array([1, 1, 1 / seen.reach])
    return P * scale * scale[:, None]


def _target_noise(g, association, target):
    """Return the effect of the target's noise, Σ_j G_j G_jᵀ v_j; G_j: sensitivity to point j."""
    target_index, windows = association.target_index, target.fits.windows
    if windows is not None:
        g = g / windows.count[target_index]
    G = np.array([np.bincount(target_index, row, len(target)) for row in g])
    if windows is not None:  # each point of a window contributes equally to its line
        G = windows.sums(G)
    return (G * target.fits.across_variance) @ G.T
