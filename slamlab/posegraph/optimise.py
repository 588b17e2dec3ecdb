"""Least squares over a pose graph: Gauss-Newton, damped where its step does not help (Marquardt).

Robust edges are tightened from round to round, as graduated non-convexity does (Yang et al. 2020):
at first every edge has its full say, or drift alone would make the true ones look false.
"""

from dataclasses import dataclass

import numpy as np

from slamlab.geometry import wrap
from slamlab.posegraph import edges, scaling
from slamlab.posegraph.jacobians import J_i, J_j
from slamlab.posegraph.system import System, factor

TIGHTER = 4.0  # Φ shrinks by this a round, until it is the one that was asked for [1]
SETTLED = 1e-6  # a step whose squared length in standard deviations is below this is none [1]
LEAST, MOST = 1e-7, 1e12  # damping: below the least none is used, beyond the most nothing helps


@dataclass(frozen=True)
class Optimum:
    """What optimising a pose graph came to.

    Parameters
    ----------
    chi2 : float, the cost Σ eᵀΛe, for robust edges Σ ρ(eᵀΛe)
    rounds : int, linear systems solved
    converged : bool, whether a further step would change nothing; False: the rounds were used up
    weights : (m,) what each edge counts, in the order they were added; 1 for those not robust
    """

    chi2: float
    rounds: int
    converged: bool
    weights: np.ndarray


class Problem:
    """The edges of a graph as arrays, for poses given with each call.

    Parameters
    ----------
    pairs : (m, 2) int
    measured : (m, 3) [m, m, rad]
    information : (m, 3, 3)
    robust : (m,) bool
    free : (n,) bool
    """

    def __init__(self, pairs, measured, information, robust, free):
        self.i, self.j = pairs.T
        self.measured, self.information, self.robust = measured, information, robust
        self.system = System(pairs, free)

    def errors(self, poses):
        """e (m, 3) and χ² (m,) of every edge."""
        e = edges.error(poses[self.i], poses[self.j], self.measured)
        return e, np.einsum("ma,mab,mb->m", e, self.information, e)

    def cost(self, chi2, phi):
        """Σ χ² of trusted edges, Σ ρ(χ²) of robust ones."""
        return chi2[~self.robust].sum() + scaling.cost(chi2[self.robust], phi).sum()

    def weights(self, chi2, phi):
        """(m,) what each edge counts."""
        weights = np.ones(len(chi2))
        weights[self.robust] = scaling.weight(chi2[self.robust], phi)
        return weights

    def normal(self, poses, e, weights):
        """H and g at these poses."""
        at = poses[self.i], poses[self.j], self.measured
        J = np.concatenate([J_i(*at), J_j(*at)], axis=-1)
        return self.system.normal(J, weights[:, None, None] * self.information, e)


def optimise(problem, poses, max_rounds, phi):
    """The poses that fit the edges best, near those given.

    Parameters
    ----------
    problem : Problem
    poses : (n, 3) guesses [m, m, rad]
    max_rounds : int
    phi : float, Φ of the robust edges [1]

    Returns
    -------
    (n, 3) poses, Optimum
    """
    e, chi2 = problem.errors(poses)
    now = max([phi, *chi2[problem.robust]])
    damping, rounds, converged = 0.0, 0, not problem.system.count
    while rounds < max_rounds and not converged:
        rounds += 1
        H, g = problem.normal(poses, e, problem.weights(chi2, now))
        step = -factor(problem.system.damped(H, damping) if damping else H).solve(g)
        tried = poses + problem.system.spread(step)
        tried[:, 2] = wrap(tried[:, 2])
        e_tried, chi2_tried = problem.errors(tried)
        settled = -(g @ step) < SETTLED  # δᵀHδ, the step in standard deviations
        # not a number counts as worse
        better = problem.cost(chi2_tried, now) <= problem.cost(chi2, now)
        if settled or better:
            poses, e, chi2 = tried, e_tried, chi2_tried
            damping = damping / 3 if damping > LEAST else 0.0
            converged = settled and now <= phi
            # nothing changes until Φ comes down to the worst edge
            now = max(phi, min(now / TIGHTER, chi2[problem.robust].max(initial=0)))
        else:
            damping = max(10 * damping, LEAST)
            if damping > MOST:
                break
    weights = problem.weights(chi2, now)
    return poses, Optimum(float(problem.cost(chi2, now)), rounds, converged, weights)
