"""Rejection of outlier edges: truncated least squares by graduated non-convexity, several starts.

The truncated cost has a local minimum for nearly every choice of loops. A search begins with the
loops that agree best with the present poses, given a drift of odometry; it optimises, reduces the
drift that it allows, and chooses again (Yang et al. 2020 graduate the cost instead). Many files
state too little information, so that false loops seem to fit: χ² has a scale, estimated and at
most 1. Of all results the most likely one counts.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from slamlab.posegraph.optimisation import optimise
from slamlab.posegraph.spanning_tree import SpanningTree, covariances

# of each search: share of the robust edges that it begins with, share of the drift and multiple of
# Φ that it allows at first [1]
STARTS = (0.1, 0, 1), (0.3, 1, 1), (0.5, 0, 1), (0.3, 0.1, 1), (0.1, 1, 1), (1, 0, 1e4), (1, 0, 1e6)
FACTOR = 0.25  # of what is allowed, in each round [1]
LEAST_DRIFT = 1e-4  # a smaller share of the drift counts as none [1]
MAX_SCHEDULE, STEPS = 25, 2  # steps of a schedule, iterations of the optimiser in each
PRIOR_FREEDOM = 30.0  # degrees of freedom with which a scale of 1 enters its estimate [1]
SAFETY = 3.0  # of the estimated scale, since noise is seldom Gaussian [1]
VIOLATED = 3.0  # a trusted edge above so many Φ starts a search [1]
SAME = 100.0  # squared distance of two results that agree [1]
AMBIGUOUS = 3.0  # largest difference of the costs of two ambiguous results, in Φ [1]


class Search(NamedTuple):
    """Result of one search: poses (n, 3), the mask (m,) of the accepted edges, χ² (m,) of all
    edges, the scale of χ², and the cost: −2 log likelihood but for a constant."""

    poses: np.ndarray
    accepted: np.ndarray
    chi2: np.ndarray
    scale: float
    cost: float

    def distance(self, other):
        """Squared distance of another result, in χ² of the edges that this one accepts."""
        return float((other.chi2 - self.chi2)[self.accepted].sum()) / self.scale


def reject_outliers(problem, poses, fixed, dropped, phi, settings):
    """Optimise poses (n, 3) without the robust edges that contradict the others.

    fixed : numbers (f,) of the fixed nodes; dropped : mask (m,) of the edges that were rejected
    before; settings : of ``optimise``. Returns poses and an Optimum.
    """
    tree = SpanningTree(poses, fixed, problem.pairs, problem.information, problem.robust)
    trusted = ~problem.robust | tree.needed
    found, optimum = _unchanged(problem, poses, ~dropped | trusted, trusted, phi, settings)
    if optimum is not None:
        return found, optimum
    results = []
    for result in _searches(problem, poses, trusted, tree, phi):
        results = sorted([*results, result], key=lambda each: each.cost)
        if len(results) > 1 and results[0].distance(results[1]) < SAME:
            break
    results += [_opposite(problem, results[0], trusted, tree, phi)]
    results.sort(key=lambda each: each.cost)
    best, accepted = results[0], results[0].accepted
    found, optimum = optimise(problem.select(accepted), best.poses, *settings)
    others = [each for each in results if best.distance(each) >= SAME]
    if others:
        away = np.hypot(*(others[0].poses - found)[:, :2].T)
        runner_up = others[0].cost - best.cost, float(np.sqrt(np.mean(away**2)))
        ambiguous = runner_up[0] < AMBIGUOUS * phi
        optimum = replace(optimum, runner_up=runner_up, ambiguous=bool(ambiguous))
    return found, _completed(problem, found, optimum, accepted, phi)


def _unchanged(problem, poses, accepted, trusted, phi, settings):
    """Optimise with the edges accepted before, or return None if these or the others surprise."""
    found, optimum = optimise(problem.select(accepted), poses, *settings)
    scale = 1.0 if accepted.all() else _scale(problem, found, accepted)
    # false loops that bend odometry fit, but odometry does not
    fits = problem.errors(found)[1] <= np.where(trusted, VIOLATED * phi, phi * scale)
    if not optimum.converged or (fits != accepted).any():
        return poses, None
    return found, _completed(problem, found, optimum, accepted, phi)


def _completed(problem, poses, optimum, accepted, phi):
    """Return the Optimum with the truncated cost and the weights of all edges."""
    cost = optimum.chi2 + phi * np.count_nonzero(~accepted)
    return replace(optimum, chi2=float(cost), weights=accepted.astype(float))


def _searches(problem, poses, trusted, tree, phi):
    """Yield a Search from each start, without the ``trusted`` edges, which none rejects."""
    k, tried = np.flatnonzero(~trusted), set()
    noise, drift = covariances(problem.information[k]), tree.drift(problem.pairs[k])
    e = problem.errors(poses)[0][k]
    for share, allowed, factor in STARTS:
        d2 = squared_distances(e, noise + allowed * drift)
        chosen = d2 <= np.quantile(d2, share)
        if allowed or factor > 1:
            chosen &= d2 <= max(2, factor) * phi
        if (start := (chosen.tobytes(), allowed > 0, factor)) not in tried:
            tried.add(start)
            yield _search(problem, poses, trusted, chosen, (noise, allowed * drift, factor), phi)


def _opposite(problem, best, trusted, tree, phi):
    """Search from the edges that the best result rejects, as far as the drift allows them."""
    k = np.flatnonzero(~trusted)
    noise, drift = covariances(problem.information[k]), tree.drift(problem.pairs[k])
    d2 = squared_distances(problem.errors(best.poses)[0][k], noise + drift)
    chosen = ~best.accepted[k] & (d2 <= 2 * phi)
    return _search(problem, best.poses, trusted, chosen, (noise, 0 * drift, 1.0), phi)


def _search(problem, poses, trusted, chosen, schedule, phi):
    """Search from the ``chosen`` edges, a mask (c,) of those that are not trusted."""
    noise, drift, factor = schedule
    allowed, scale, k = 1.0, 1.0, np.flatnonzero(~trusted)
    for _ in range(MAX_SCHEDULE):
        accepted = trusted.copy()
        accepted[k] = chosen
        poses, optimum = optimise(problem.select(accepted), poses, STEPS, tolerance=1.0)
        e, chi2 = problem.errors(poses)
        new = _scale(problem, poses, accepted)
        scale = min(scale, new)  # a false loop does not make room for others
        allowed = FACTOR * allowed if allowed > LEAST_DRIFT else 0.0
        factor = max(1.0, FACTOR * factor)
        d2 = squared_distances(e[k], noise + allowed * drift)
        before, chosen = chosen, d2 <= phi * scale * factor
        if not allowed and optimum.converged and (chosen == before).all():
            break
    cost = chi2[accepted].sum() / new + _freedom(problem, accepted) * np.log(new)
    return Search(poses, accepted, chi2, new, float(cost + phi * np.count_nonzero(~accepted)))


def _freedom(problem, accepted):
    return 3 * np.count_nonzero(accepted) - np.count_nonzero(problem.free)


def _scale(problem, poses, accepted):
    """Estimate the scale of χ² from accepted edges, at most 1 (reduced χ²)."""
    chi2 = problem.errors(poses)[1][accepted].sum()
    reduced = (chi2 + PRIOR_FREEDOM) / (_freedom(problem, accepted) + PRIOR_FREEDOM)
    return min(1.0, SAFETY * reduced)


def squared_distances(e, covariance):
    """Squared Mahalanobis distances (c,) of residuals e (c, 3), given covariances (c, 3, 3)."""
    return np.einsum("ca,ca->c", e, np.linalg.solve(covariance, e[..., None])[..., 0])
