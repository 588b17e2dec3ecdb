"""Pose-graph optimisation (optimization, smoothing): nonlinear least squares by Gauss-Newton and
Levenberg-Marquardt, which gives a maximum a posteriori estimate."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from slamlab.geometry import wrap
from slamlab.posegraph import edge_error
from slamlab.posegraph.edge_jacobians import J_i, J_j
from slamlab.posegraph.normal_equations import NormalEquations, factorise
from slamlab.posegraph.robust_kernels import LeastSquares

STEP_TOLERANCE = 1e-3  # converged: squared length of a step in standard deviations [1]
NO_KERNEL = LeastSquares()
MIN_DAMPING, MAX_DAMPING = 1e-7, 1e12  # below the least: no damping; above the most: give up


@dataclass(frozen=True)
class Optimum:
    """Result of a pose-graph optimisation.

    Parameters
    ----------
    chi2 : float, the cost Σ eᵀΛe, for robust edges Σ ρ(eᵀΛe)
    iterations : int, iterations
    converged : bool; False if the maximum number of iterations was reached
    weights : (m,) weights of the edges; 1 for edges that are not robust, 0 for rejected ones
    runner_up : if a search found another solution, how much less likely it is (−2 log of the
        ratio) and its distance from this one [m, rms]
    ambiguous : bool, whether the runner-up is nearly as likely
    """

    chi2: float
    iterations: int
    converged: bool
    weights: np.ndarray
    runner_up: tuple | None = None
    ambiguous: bool = False


class LeastSquaresProblem:
    """Least-squares problem of a pose graph: its m edges as arrays; the methods take poses.

    pairs : (m, 2) the poses' numbers, −1 for the world frame; free : see ``NormalEquations``.
    """

    def __init__(self, pairs, measured, information, robust, free):
        self.pairs, self.free = pairs, free
        self.measured, self.information, self.robust = measured, information, robust

    @cached_property
    def equations(self):
        """The NormalEquations of these edges."""
        return NormalEquations(self.pairs, self.free)

    def select(self, edges):
        """Return the problem of some edges, mask (m,)."""
        arrays = self.pairs, self.measured, self.information, self.robust
        return LeastSquaresProblem(*(array[edges] for array in arrays), self.free)

    def errors(self, poses):
        """Return the residuals e (m, 3) and χ² (m,) of all edges."""
        e = edge_error.error(*self._ends(poses), self.measured)
        return e, np.einsum("ma,mab,mb->m", e, self.information, e)

    def _ends(self, poses):
        return np.vstack([poses, np.zeros(3)])[self.pairs.T]  # number −1, the world frame

    def linearise(self, poses, e, weights):
        """Linearise: return the information matrix H and the gradient g at these poses."""
        at = *self._ends(poses), self.measured
        J = np.concatenate([J_i(*at), J_j(*at)], axis=-1)
        return self.equations.linearise(J, weights[:, None, None] * self.information, e)


def optimise(problem, poses, max_iterations, tolerance=STEP_TOLERANCE, kernel=NO_KERNEL):
    """Optimise (optimize) poses (n, 3): Gauss-Newton with Levenberg-Marquardt damping.

    kernel : of the robust edges, of ``robust_kernels``, for iteratively reweighted least squares.
    """

    def evaluated(poses):
        e, chi2 = problem.errors(poses)
        return e, chi2, np.where(problem.robust, kernel.cost(chi2), chi2).sum()

    def weights(chi2):
        return np.where(problem.robust, kernel.weight(chi2), 1.0)

    e, chi2, cost = evaluated(poses)
    damping, iterations, converged = 0.0, 0, not problem.free.any()
    while iterations < max_iterations and not converged:
        iterations += 1
        H, g = problem.linearise(poses, e, weights(chi2))
        step = -factorise(problem.equations.damped(H, damping) if damping else H).solve(g)
        candidate = poses + problem.equations.to_poses(step)
        candidate[:, 2] = wrap(candidate[:, 2])
        new = evaluated(candidate)
        converged = -(g @ step) < tolerance  # δᵀHδ, the step in standard deviations
        if converged or new[2] <= cost:  # NaN counts as worse
            poses, (e, chi2, cost) = candidate, new
            damping = damping / 3 if damping > MIN_DAMPING else 0.0
        else:
            damping = max(10 * damping, MIN_DAMPING)
            if damping > MAX_DAMPING:
                break
    return poses, Optimum(float(cost), iterations, bool(converged), weights(chi2))
