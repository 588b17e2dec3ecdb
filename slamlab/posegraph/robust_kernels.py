"""Robust kernels against outlier edges: a cost ρ(χ²) in place of χ², with the weight w = ρ'(χ²).

An M-estimator minimises Σ ρ. Huber's cost is convex; those of DCS (dynamic covariance scaling,
Agarwal et al. 2013) and of truncated least squares are bounded and have many local minima.
"""

from dataclasses import dataclass

import numpy as np

PHI = 11.345  # 99 % of true edges have a χ² of 3 degrees of freedom below this [1]


@dataclass(frozen=True)
class LeastSquares:
    """No robust kernel. Its subclasses replace the cost and the weight, mostly of a χ² above Φ."""

    phi: float = PHI

    def cost(self, chi2):
        """Compute the cost ρ(χ²) of edges."""
        return 1.0 * chi2

    def weight(self, chi2):
        """Compute the weight ρ'(χ²) of edges."""
        return np.ones_like(chi2, dtype=float)


class Huber(LeastSquares):
    """Huber's kernel: beyond Φ the cost grows as the residual, not as its square."""

    def cost(self, chi2):
        beyond = 2 * np.sqrt(self.phi * chi2) - self.phi
        return np.where(chi2 <= self.phi, chi2, beyond)

    def weight(self, chi2):
        return np.sqrt(self.phi / np.maximum(chi2, self.phi))


class Cauchy(LeastSquares):
    """Cauchy's kernel: the cost Φ log(1 + χ²/Φ) grows ever more slowly."""

    def cost(self, chi2):
        return self.phi * np.log1p(chi2 / self.phi)

    def weight(self, chi2):
        return self.phi / (self.phi + chi2)


class DCS(LeastSquares):
    """Dynamic covariance scaling: beyond Φ the cost approaches 3Φ. Equations (15.9), (15.10)."""

    def cost(self, chi2):
        return np.where(
            chi2 <= self.phi, chi2, 3 * self.phi - 4 * self.phi * (self.phi / (self.phi + chi2))
        )

    def weight(self, chi2):
        return (2 * self.phi / (self.phi + np.maximum(chi2, self.phi))) ** 2


class Truncated(LeastSquares):
    """Truncated least squares: beyond Φ the cost is Φ and the weight is 0."""

    def cost(self, chi2):
        return np.minimum(chi2, self.phi)

    def weight(self, chi2):
        return np.where(chi2 <= self.phi, 1.0, 0.0)
