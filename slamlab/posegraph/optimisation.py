"""Pose-graph optimisation (optimization): least squares by Gauss-Newton, Levenberg-Marquardt.

Nonlinear: the residuals are linearised (linearized) anew in every round.

A step is damped only where Gauss-Newton's does not help. Robust edges are tightened from round to
round, as graduated non-convexity does (Yang et al. 2020): at first every edge has its full weight,
or drift alone would make the true ones look like outliers.
"""

from dataclasses import dataclass

import numpy as np

from slamlab.geometry import wrap
from slamlab.posegraph import edge_error, robust_kernel
from slamlab.posegraph.edge_jacobians import J_i, J_j
from slamlab.posegraph.normal_equations import NormalEquations, factorise

GNC_FACTOR = 4.0  # graduated non-convexity: Φ is divided by this a round, down to its value [1]
STEP_TOLERANCE = 1e-6  # converged: squared length of a step in standard deviations [1]
MIN_DAMPING, MAX_DAMPING = 1e-7, 1e12  # below the least none is used, beyond the most none helps


@dataclass(frozen=True)
class Optimum:
    """Result of a pose-graph optimisation: cost, rounds (iterations), convergence, edge weights.

    Parameters
    ----------
    chi2 : float, the cost Σ eᵀΛe, for robust edges Σ ρ(eᵀΛe)
    rounds : int, iterations: linear systems solved
    converged : bool, whether a further step would change nothing; False: the rounds were used up
    weights : (m,) robust kernel's weight of each edge, in their order; 1 for those not robust
    """

    chi2: float
    rounds: int
    converged: bool
    weights: np.ndarray


class Problem:
    """Least-squares problem of a pose graph: its edges as arrays, poses given with each call.

    Parameters
    ----------
    pairs : (m, 2) int
    measured : (m, 3) [m, m, rad]
    information : (m, 3, 3) of the residuals
    robust : (m,) bool
    free : (n,) bool
    """

    def __init__(self, pairs, measured, information, robust, free):
        self.i, self.j = pairs.T
        self.measured, self.information, self.robust = measured, information, robust
        self.equations = NormalEquations(pairs, free)

    def errors(self, poses):
        """Residuals e (m, 3) and χ² (m,) of every edge."""
        e = edge_error.error(poses[self.i], poses[self.j], self.measured)
        return e, np.einsum("ma,mab,mb->m", e, self.information, e)

    def cost(self, chi2, phi):
        """Cost: Σ χ² of trusted edges and Σ ρ(χ²) of robust ones."""
        return chi2[~self.robust].sum() + robust_kernel.cost(chi2[self.robust], phi).sum()

    def weights(self, chi2, phi):
        """Weights (m,) of the edges by the robust kernel; 1 for those not robust."""
        weights = np.ones(len(chi2))
        weights[self.robust] = robust_kernel.weight(chi2[self.robust], phi)
        return weights

    def linearise(self, poses, e, weights):
        """Linearise at these poses: information matrix H and gradient g."""
        at = poses[self.i], poses[self.j], self.measured
        J = np.concatenate([J_i(*at), J_j(*at)], axis=-1)
        return self.equations.linearise(J, weights[:, None, None] * self.information, e)


def optimise(problem, poses, max_rounds, phi, tolerance=STEP_TOLERANCE):
    """Optimise (optimize) the poses: Gauss-Newton with Levenberg-Marquardt damping.

    Parameters
    ----------
    problem : Problem
    poses : (n, 3) initial guesses [m, m, rad]
    max_rounds : int
    phi : float, Φ of the robust edges [1]
    tolerance : float, squared length of a step in standard deviations that ends it [1]

    Returns
    -------
    (n, 3) poses, Optimum
    """
    e, chi2 = problem.errors(poses)
    phi_now = max([phi, *chi2[problem.robust]])
    damping, rounds, converged = 0.0, 0, not problem.equations.count
    while rounds < max_rounds and not converged:
        rounds += 1
        H, g = problem.linearise(poses, e, problem.weights(chi2, phi_now))
        step = -factorise(problem.equations.damped(H, damping) if damping else H).solve(g)
        candidate = poses + problem.equations.to_poses(step)
        candidate[:, 2] = wrap(candidate[:, 2])
        e_candidate, chi2_candidate = problem.errors(candidate)
        small_step = -(g @ step) < tolerance  # δᵀHδ, the step in standard deviations
        # not a number counts as worse
        better = problem.cost(chi2_candidate, phi_now) <= problem.cost(chi2, phi_now)
        if small_step or better:
            poses, e, chi2 = candidate, e_candidate, chi2_candidate
            damping = damping / 3 if damping > MIN_DAMPING else 0.0
            converged = small_step and phi_now <= phi
            # nothing changes until Φ comes down to the worst edge
            phi_now = max(phi, min(phi_now / GNC_FACTOR, chi2[problem.robust].max(initial=0)))
        else:
            damping = max(10 * damping, MIN_DAMPING)
            if damping > MAX_DAMPING:
                break
    weights = problem.weights(chi2, phi_now)
    return poses, Optimum(float(problem.cost(chi2, phi_now)), rounds, converged, weights)
