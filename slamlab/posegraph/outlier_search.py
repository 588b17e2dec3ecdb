"""One search for the edges of a pose graph that are not outliers, and its likelihood."""

from typing import NamedTuple

import numpy as np
from scipy.spatial import KDTree

from slamlab.posegraph.edge_error import squared_distances
from slamlab.posegraph.marginal_covariances import leave_one_out
from slamlab.posegraph.optimisation import LeastSquaresProblem, optimise
from slamlab.posegraph.spanning_tree import SpanningTree, covariances

FACTOR = 0.25  # by which the multiple of Φ that a search allows changes in each stage [1]
STAGES, STEPS, MORE_STEPS = 25, 2, 10  # of a search, and iterations of the optimiser in each
READMISSIONS = 8  # at most, of each search
SAME_MAP, SAME_FIT = 0.1, 100.0  # limits below which two results agree [m, rms], [1]
NEAR = 5  # numbers of poses between two loops that support each other
TESTED = 30  # accepted edges, of the largest χ², without which the cost is computed
PRIOR_FREEDOM = 30.0  # degrees of freedom with which a scale of 1 enters its estimate [1]
SAFETY = 3.0  # of the estimated scale, since noise is seldom Gaussian [1]
VIOLATED = 3.0  # a trusted edge above so many Φ starts a search, an edge that costs more ends [1]


class Search(NamedTuple):
    """Result of one search: the problem of the accepted edges, mask (m,), poses (n, 3), χ² (m,) of
    all edges, and the scale of χ²."""

    problem: LeastSquaresProblem
    accepted: np.ndarray
    poses: np.ndarray
    chi2: np.ndarray
    scale: float

    def cost(self, phi, scale):
        """Compute −2 log likelihood up to a constant, given the scale of χ²."""
        chi2 = self.chi2[self.accepted].sum() / scale + _freedom(self.problem) * np.log(scale)
        return float(chi2 + phi * np.count_nonzero(~self.accepted))

    def distance(self, other):
        """Compute the rms distance of the positions of another result [m]."""
        return float(np.sqrt(2 * np.mean((other.poses - self.poses)[:, :2] ** 2)))

    def agrees(self, other):
        """Return whether another result is near this one or fits the edges accepted here."""
        increase = (other.chi2 - self.chi2)[self.accepted].sum() / self.scale
        return self.distance(other) < SAME_MAP or increase < SAME_FIT


def search(problem, poses, trusted, chosen, factor, phi):
    """Search from the ``chosen`` edges, a mask (m,), with a multiple of Φ that is reduced to 1."""
    start, before, scale, settled = poses, ~chosen, 1.0, False
    for _ in range(STAGES):
        accepted = trusted | chosen
        some = problem.select(accepted)
        poses, optimum = optimise(some, poses, STEPS, tolerance=1.0)
        if not optimum.converged and (chosen == before).all():  # bent by edges rejected since
            poses, optimum = optimise(some, start, MORE_STEPS, tolerance=1.0)
        chi2 = problem.errors(poses)[1]
        found = Search(some, accepted, poses, chi2, estimated_scale(some, chi2[accepted]))
        factor = max(1.0, FACTOR * factor)
        before, scale = (
            chosen,
            min(scale, found.scale),
        )  # a false loop does not make room for others
        if not settled:
            chosen = (chi2 <= phi * scale * factor) & ~trusted
            settled = factor == 1 and optimum.converged and (chosen == before).all()
        if settled:
            chosen = before | ((chi2 <= acceptable_chi2(phi, found.scale)) & ~trusted)
            if optimum.converged and (chosen == before).all():
                costly = costliest_loops(found, trusted, phi, VIOLATED)
                if not len(costly):
                    break
                chosen[costly] = False
    return found


def costliest_loops(found, trusted, phi, factor=1.0):
    """Return the accepted edges without which χ² decreases by more than ``factor`` times what an
    edge may cost. Return only the costliest of them, because these also burden the others."""
    numbers = np.flatnonzero(found.accepted)
    tested = np.flatnonzero(~trusted[numbers])
    tested = tested[np.argsort(-found.chi2[numbers[tested]])[:TESTED]]
    saved = leave_one_out(found.problem, found.poses, tested)
    limit = factor * acceptable_chi2(phi, found.scale)
    return numbers[tested[saved > max(limit, saved.max(initial=0) / 2)]]


def lone_loops(problem, found, trusted):
    """Return the accepted loops that have no other accepted loop between nearly the same poses."""
    loops = np.flatnonzero(found.accepted & ~trusted)
    pairs = np.sort(problem.pairs[loops], axis=1)
    distances, _ = KDTree(pairs).query(pairs, k=2, p=np.inf)
    return loops[distances[:, 1] > NEAR]


def acceptable_chi2(phi, scale):
    """Return the χ² of an edge whose acceptance and rejection cost the same."""
    return scale * (phi - 3 * np.log(scale))


def _freedom(problem):
    return 3 * len(problem.pairs) - np.count_nonzero(problem.free)


def estimated_scale(problem, chi2):
    """Estimate the scale of χ² from that of the accepted edges, at most 1 (reduced χ²)."""
    reduced = (chi2.sum() + PRIOR_FREEDOM) / (_freedom(problem) + PRIOR_FREEDOM)
    return min(1.0, SAFETY * reduced)


def with_readmitted(problem, found, fixed, trusted, phi):
    """Readmit edges that the drift along the accepted ones explains, while the cost decreases."""
    for _ in range(READMISSIONS):
        d2 = drift_distances(problem, found.poses, fixed, found.accepted)
        chosen = (found.accepted | (d2 <= phi)) & ~trusted
        if (chosen <= found.accepted).all():
            break
        more = search(problem, found.poses, trusted, chosen, 1.0, phi)
        if more.cost(phi, found.scale) >= found.cost(phi, found.scale):
            break
        found = more
    return found


def drift_distances(problem, poses, fixed, trusted=None):
    """Squared Mahalanobis distances (m,) of all edges, given the drift along ``trusted`` edges."""
    covariance = covariances(problem.information)
    if trusted is not None:
        tree = SpanningTree(poses, fixed, problem.pairs, problem.information, ~trusted)
        covariance += tree.drift(problem.pairs)
    return squared_distances(problem.errors(poses)[0], covariance)
