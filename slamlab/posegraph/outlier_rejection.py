"""Rejection of outlier edges: truncated least squares by graduated non-convexity, several starts.

The truncated cost has a local minimum for nearly every choice of loops. A search begins with loops
that the drift of odometry explains best and gradually rejects those of large χ² (Yang et al. 2020
graduate the cost instead). Then loops that the drift along the accepted ones explains are
readmitted, while this pays. Many files state too little information, so that false loops seem to
fit: χ² has a scale, estimated and at most 1. Of all results the most likely one counts.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from slamlab.posegraph.edge_error import squared_distances
from slamlab.posegraph.marginal_covariances import leave_one_out
from slamlab.posegraph.optimisation import optimise
from slamlab.posegraph.spanning_tree import SpanningTree, covariances

WIDE, FACTOR = 100.0, 0.25  # multiple of Φ that a search allows at first, change per round [1]
# of each search: share of the robust edges that it begins with, share of the drift that explains
# them, multiple of Φ that it allows at first [1]
STARTS = (0.1, 1, WIDE), (0.5, 0, 1), (0.3, 1, WIDE), (0.05, 1, WIDE), (1, 0, 1e6)
STAGES, STEPS, MORE_STEPS = 25, 2, 10  # of a search, and iterations of the optimiser in each
READMISSIONS = 8  # at most, of each search
TESTED = 30  # accepted edges, of the largest χ², without which the cost is computed
PRIOR_FREEDOM = 30.0  # degrees of freedom with which a scale of 1 enters its estimate [1]
SAFETY = 3.0  # of the estimated scale, since noise is seldom Gaussian [1]
VIOLATED = 3.0  # a trusted edge above so many Φ starts a search, an edge that costs more ends [1]
SAME = 100.0  # squared distance of two results that agree [1]
AMBIGUOUS = 3.0  # largest difference of the costs of two ambiguous results, in Φ [1]


class Search(NamedTuple):
    """Result of one search: poses (n, 3), the mask (m,) of the accepted edges, χ² (m,) of all
    edges, the scale of χ², and the degrees of freedom of the accepted edges."""

    poses: np.ndarray
    accepted: np.ndarray
    chi2: np.ndarray
    scale: float
    freedom: int

    def cost(self, phi, scale):
        """Compute −2 log likelihood up to a constant, given the scale of χ²."""
        chi2 = self.chi2[self.accepted].sum() / scale + self.freedom * np.log(scale)
        return float(chi2 + phi * np.count_nonzero(~self.accepted))

    def distance(self, other):
        """Squared distance to another result: the increase in χ² of the edges accepted here."""
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
    for result in _searches(problem, poses, fixed, trusted, phi):
        results, _ = _ranked([*results, result], phi)
        if len(results) > 1 and results[0].distance(results[1]) < SAME:
            break
    results += [_opposite(problem, results[0], fixed, trusted, phi)]
    (best, *others), costs = _ranked(results, phi)
    found, optimum = optimise(problem.select(best.accepted), best.poses, *settings)
    for other, cost in zip(others, costs[1:], strict=True):
        if best.distance(other) >= SAME:
            away = np.hypot(*(other.poses - found)[:, :2].T)
            runner_up = cost - costs[0], float(np.sqrt(np.mean(away**2)))
            ambiguous = runner_up[0] < AMBIGUOUS * phi
            optimum = replace(optimum, runner_up=runner_up, ambiguous=ambiguous)
            break
    return found, _completed(problem, found, optimum, best.accepted, phi)


def _ranked(results, phi):
    """Sort results by their costs, given the scale of the most likely one; return the costs, too,
    which one scale makes comparable."""
    scale = min(results, key=lambda each: each.cost(phi, each.scale)).scale
    ranked = sorted(results, key=lambda each: each.cost(phi, scale))
    return ranked, [each.cost(phi, scale) for each in ranked]


def _unchanged(problem, poses, accepted, trusted, phi, settings):
    """Optimise with the edges accepted before, or return None if these or the others surprise."""
    few = min(settings[0], MORE_STEPS), settings[1]
    found, optimum = optimise(problem.select(accepted), poses, *few)
    scale = 1.0 if accepted.all() else _scale(problem, found, accepted)
    # false loops that bend odometry fit, but odometry does not
    fits = problem.errors(found)[1] <= np.where(trusted, VIOLATED * phi, _limit(phi, scale))
    if not optimum.converged or (fits != accepted).any():
        return poses, None
    return found, _completed(problem, found, optimum, accepted, phi)


def _completed(problem, poses, optimum, accepted, phi):
    """Return the Optimum with the truncated cost and the weights of all edges."""
    cost = optimum.chi2 + phi * np.count_nonzero(~accepted)
    return replace(optimum, chi2=float(cost), weights=accepted.astype(float))


def _searches(problem, poses, fixed, trusted, phi):
    """Yield a Search from each start, without the ``trusted`` edges, which none rejects."""
    tried = set()
    for share, drifts, factor in STARTS:
        d2 = _distances(problem, poses, fixed, trusted if drifts else None)
        limit = 2 * phi if drifts else factor * phi if factor > 1 else np.inf
        chosen = (d2 <= min(limit, np.quantile(d2[~trusted], share))) & ~trusted
        if (start := (chosen.tobytes(), factor)) not in tried:
            tried.add(start)
            found = _search(problem, poses, trusted, chosen, factor, phi)
            yield _with_readmitted(problem, found, fixed, trusted, phi)


def _distances(problem, poses, fixed, trusted=None):
    """Squared Mahalanobis distances (m,) of all edges, given the drift along ``trusted`` edges."""
    covariance = covariances(problem.information)
    if trusted is not None:
        tree = SpanningTree(poses, fixed, problem.pairs, problem.information, ~trusted)
        covariance += tree.drift(problem.pairs)
    return squared_distances(problem.errors(poses)[0], covariance)


def _with_readmitted(problem, found, fixed, trusted, phi):
    """Readmit the edges that the drift along the accepted ones explains, while this pays."""
    for _ in range(READMISSIONS):
        d2 = _distances(problem, found.poses, fixed, found.accepted)
        chosen = (found.accepted | (d2 <= phi)) & ~trusted
        if (chosen <= found.accepted).all():
            break
        more = _search(problem, found.poses, trusted, chosen, WIDE, phi)
        if more.cost(phi, found.scale) >= found.cost(phi, found.scale):
            break
        found = more
    return found


def _opposite(problem, best, fixed, trusted, phi):
    """Search from the edges that the best result rejects, as far as the drift allows them."""
    d2 = _distances(problem, best.poses, fixed, trusted)
    chosen = ~best.accepted & (d2 <= 2 * phi)
    return _search(problem, best.poses, trusted, chosen, 1.0, phi)


def _search(problem, poses, trusted, chosen, factor, phi):
    """Search from the ``chosen`` edges, a mask (m,), with a multiple of Φ that is reduced to 1."""
    start, before, scale, settled = poses, ~chosen, 1.0, False
    for _ in range(STAGES):
        accepted = trusted | chosen
        some = problem.select(accepted)
        poses, optimum = optimise(some, poses, STEPS, tolerance=1.0)
        if not optimum.converged and (chosen == before).all():  # bent by edges rejected since
            poses, optimum = optimise(some, start, MORE_STEPS, tolerance=1.0)
        chi2, new = problem.errors(poses)[1], _scale(problem, poses, accepted)
        factor = max(1.0, FACTOR * factor)
        before, scale = chosen, min(scale, new)  # a false loop does not make room for others
        if not settled:
            chosen = (chi2 <= phi * scale * factor) & ~trusted
            settled = factor == 1 and optimum.converged and (chosen == before).all()
        if settled:
            limit = _limit(phi, new)
            chosen = before | ((chi2 <= limit) & ~trusted)
            if optimum.converged and (chosen == before).all():
                costly = _costly(some, poses, np.flatnonzero(accepted), trusted, chi2, limit)
                if not len(costly):
                    break
                chosen[costly] = False
    return Search(poses, accepted, chi2, new, _freedom(problem, accepted))


def _costly(some, poses, numbers, trusted, chi2, limit):
    """Return which of the accepted edges cost far more than ``limit`` (the decrease of χ² without
    one); of these only the costliest, since they burden the others."""
    tested = np.flatnonzero(~trusted[numbers])
    tested = tested[np.argsort(-chi2[numbers[tested]])[:TESTED]]
    saved = leave_one_out(some, poses, tested)
    return numbers[tested[saved > max(VIOLATED * limit, saved.max(initial=0) / 2)]]


def _limit(phi, scale):
    """Return the χ² of an edge whose acceptance and rejection cost the same."""
    return scale * (phi - 3 * np.log(scale))


def _freedom(problem, accepted):
    return 3 * np.count_nonzero(accepted) - np.count_nonzero(problem.free)


def _scale(problem, poses, accepted):
    """Estimate the scale of χ² from accepted edges, at most 1 (reduced χ²)."""
    chi2 = problem.errors(poses)[1][accepted].sum()
    reduced = (chi2 + PRIOR_FREEDOM) / (_freedom(problem, accepted) + PRIOR_FREEDOM)
    return min(1.0, SAFETY * reduced)
