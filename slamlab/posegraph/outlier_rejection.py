"""Rejection of outlier edges: truncated least squares by graduated non-convexity, several starts.

The truncated cost has a local minimum for nearly every choice of loops. A search begins with loops
that the drift of odometry explains best and gradually rejects those of large χ² (Yang et al. 2020
graduate the cost instead). Then loops that the drift along the accepted ones explains are
readmitted, as long as this reduces the cost. Many files state covariances that are too large, so
that false loops seem to fit. Therefore a scale of χ², at most 1, is estimated. The result is the
most likely one of all searches.
"""

from dataclasses import replace

import numpy as np

from slamlab.posegraph import outlier_search
from slamlab.posegraph.optimisation import optimise
from slamlab.posegraph.spanning_tree import SpanningTree

WIDE = 100.0  # multiple of Φ that a search allows at first [1]
# of each search: share of the robust edges that it begins with, share of the drift that explains
# them, multiple of Φ that it allows at first [1]
STARTS = (0.1, 1, WIDE), (0.5, 0, 1), (0.3, 1, WIDE), (0.05, 1, WIDE), (1, 0, 1e6)
PRUNINGS = 8  # at most, of the best result
AMBIGUOUS = 3.0  # largest difference of the costs of two ambiguous results, in Φ [1]


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
    for result in _searches(problem, poses, fixed, trusted, phi):
        results, _ = _ranked([*results, result], phi)
        if len(results) > 1 and results[0].agrees(results[1]):
            break
    results[0] = _pruned(problem, results[0], fixed, trusted, phi)
    results += [_opposite(problem, results[0], fixed, trusted, phi)]
    (best, *others), costs = _ranked(results, phi)
    found, optimum = optimise(best.problem, best.poses, *settings)
    for other, cost in zip(others, costs[1:], strict=True):
        if not best.agrees(other):
            runner_up = cost - costs[0], best.distance(other)
            ambiguous = runner_up[0] < AMBIGUOUS * phi
            optimum = replace(optimum, runner_up=runner_up, ambiguous=ambiguous)
            break
    return found, _completed(problem, found, optimum, best.accepted, phi)


def _ranked(results, phi):
    """Sort results by their costs; return the results and the costs. All costs are computed with
    the scale of the most likely result, so that they are comparable."""
    scale = min(results, key=lambda each: each.cost(phi, each.scale)).scale
    ranked = sorted(results, key=lambda each: each.cost(phi, scale))
    return ranked, [each.cost(phi, scale) for each in ranked]


def _unchanged(problem, poses, accepted, trusted, phi, settings):
    """Optimise with the edges accepted before; return an Optimum of None if this does not converge,
    or if any edge's χ² calls for the opposite decision."""
    few = min(settings[0], outlier_search.MORE_STEPS), settings[1]
    some = problem.select(accepted)
    found, optimum = optimise(some, poses, *few)
    chi2 = problem.errors(found)[1]
    scale = 1.0 if accepted.all() else outlier_search.estimated_scale(some, chi2[accepted])
    acceptable = outlier_search.acceptable_chi2(phi, scale)
    # false loops that bend odometry fit, but odometry does not
    fits = chi2 <= np.where(trusted, outlier_search.VIOLATED * phi, acceptable)
    if not optimum.converged or (fits != accepted).any():
        return poses, None
    return found, _completed(problem, found, optimum, accepted, phi)


def _completed(problem, poses, optimum, accepted, phi):
    """Return the Optimum with the truncated cost and the weights of all edges."""
    cost = optimum.chi2 + phi * np.count_nonzero(~accepted)
    return replace(optimum, chi2=float(cost), weights=accepted.astype(float))


def _searches(problem, poses, fixed, trusted, phi):
    """Yield a Search from each start; no search rejects the ``trusted`` edges."""
    tried = set()
    for share, drifts, factor in STARTS:
        d2 = outlier_search.drift_distances(problem, poses, fixed, trusted if drifts else None)
        limit = 2 * phi if drifts else factor * phi if factor > 1 else np.inf
        chosen = (d2 <= min(limit, np.quantile(d2[~trusted], share))) & ~trusted
        if (start := (chosen.tobytes(), factor)) not in tried:
            tried.add(start)
            found = outlier_search.search(problem, poses, trusted, chosen, factor, phi)
            yield outlier_search.with_readmitted(problem, found, fixed, trusted, phi)


def _pruned(problem, found, fixed, trusted, phi):
    """Reject loops that no other one supports, then loops that bend the others, while this pays."""
    lone = outlier_search.lone_loops(problem, found, trusted)
    found, _ = _without(lone, problem, found, fixed, trusted, phi)
    for _ in range(PRUNINGS):
        costliest = outlier_search.costliest_loops(found, trusted, phi)
        found, better = _without(costliest, problem, found, fixed, trusted, phi)
        if not better:
            break
    return found


def _without(suspects, problem, found, fixed, trusted, phi):
    """Reject loops, given their numbers, and readmit what then fits; return the more likely result
    and whether it is new."""
    if not len(suspects):
        return found, False
    chosen = found.accepted & ~trusted
    chosen[suspects] = False
    fewer = outlier_search.search(problem, found.poses, trusted, chosen, 1.0, phi)
    fewer = outlier_search.with_readmitted(problem, fewer, fixed, trusted, phi)
    (best, _), costs = _ranked([found, fewer], phi)
    better = best is fewer and costs[1] - costs[0] > phi  # one true edge in 100 costs more than Φ
    return (fewer if better else found), better


def _opposite(problem, best, fixed, trusted, phi):
    """Search from the edges that the best result rejects and that the drift can explain."""
    d2 = outlier_search.drift_distances(problem, best.poses, fixed, trusted)
    chosen = ~best.accepted & (d2 <= 2 * phi)
    return outlier_search.search(problem, best.poses, trusted, chosen, 1.0, phi)
