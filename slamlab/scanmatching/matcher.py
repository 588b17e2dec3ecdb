"""Scan matching: point-to-line registration, with correlative search where that fails.

As wide a basin as point-to-point ICP, as accurate as point-to-line; it says how far to trust it.
"""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from slamlab.geometry import wrap
from slamlab.scanmatching.correlative_search import candidate_poses
from slamlab.scanmatching.correspondences import Pairs
from slamlab.scanmatching.match_covariance import Observability, censi, observability
from slamlab.scanmatching.match_quality import MatchQuality, assess
from slamlab.scanmatching.match_result import Match, Round, check_pose
from slamlab.scanmatching.registration import align, min_pairs
from slamlab.scanmatching.surfaces import surface


@dataclass(frozen=True)
class Alignment(Match):
    """Result of ``match``: the pose with its covariance, degenerate directions and match quality.

    Its error is the mean point-to-line residual, its share that of the inliers.

    Parameters
    ----------
    fit : MatchQuality, overlap and contradictions
    good : bool, accepted: converged, and enough overlaps and agrees
    searched : bool, the correlative search was made
    """

    fit: MatchQuality = None
    good: bool = False
    searched: bool = False
    _solution: tuple = field(default=None, repr=False, compare=False)

    @cached_property
    def covariance(self):
        """Covariance (3, 3) of x, y and θ of the pose, in the target's frame [m, m, rad].

        From the measurement noise alone; see ``censi``.
        """
        return censi(*self._solution)

    def inflated_covariance(self, sigma):
        """Inflated covariance: the points' own noise, and errors that whole walls have in common.

        Errors that points have in common, above all by motion during a scan, do not average out: in
        a direction that holds its full share of the information they shift the pose by as much, in
        one that few points fix by more.

        Parameters
        ----------
        sigma : float, how far walls are off [m]

        Returns
        -------
        (3, 3) [m, m, rad]
        """
        seen = self.observability
        values = np.where(seen.fixed, seen.eigenvalues, np.inf)
        common = sigma**2 * seen.eigenvalues.sum() / 3 / np.maximum(values, 1e-300)
        scale = np.array([1, 1, 1 / seen.reach])
        common = (seen.directions * common) @ seen.directions.T
        return self.covariance + common * scale * scale[:, None]

    def add_residuals(self, common_error):
        """Add the residuals at this pose to a CommonError."""
        source, _, pairs, kernel_width = self._solution
        common_error.add(source, pairs, kernel_width)

    @cached_property
    def observability(self) -> Observability:
        """Observability of the pose: its degenerate (under-constrained) directions."""
        return observability(*self._solution)[0]


def match(source, target, initial=(0.0, 0.0, 0.0), *, search=None, max_rounds=30, history=False):
    """Match scans: register a source point cloud to a target, a scan or a submap (scan-to-map).

    Parameters
    ----------
    source, target : (n, 2), (m, 2) points [m], a scan's in the order of its beams; or Surfaces made
        of them before
    initial : (3,) initial guess of the source's frame in the target's [m, m, rad]
    search : float, correlative search in all places and all turns this far from the guess first
        [rad]; None: only where the guess leads to a poor match, then in all turns; 0: never
    max_rounds : int, iterations at most
    history : bool, keep a Round for every iteration

    Returns
    -------
    Alignment

    Raises
    ------
    ValueError : fewer than 3 points, wrong shapes, NaN, max_rounds below 1
    """
    initial = check_pose(initial)
    if max_rounds < 1:
        raise ValueError(f"max_rounds must be at least 1, got {max_rounds}")
    source, target = surface(source, "source"), surface(target, "target")
    rounds_kept, found, searched = [], None, bool(search)
    keep = (lambda pairs: rounds_kept.append(_as_round(pairs, source, target))) if history else None
    if not search:
        found = _register_from(source, target, initial, max_rounds, keep)
        searched = search is None and not found.fit.good
    if searched:
        turn = np.pi if search is None else search
        for guess in candidate_poses(source, target, initial, turn):
            other = _register_from(source, target, guess, max_rounds, keep)
            if found is None or other.fit.score > found.fit.score:
                found = other
            if found.fit.good:
                break
    return _as_alignment(found, source, target, searched, rounds_kept)


@dataclass(frozen=True)
class _Attempt:
    """Registration from one initial guess, and its match quality."""

    pairs: Pairs
    rounds: int
    converged: bool
    kernel_width: float
    well_constrained: bool
    fit: MatchQuality


def _register_from(source, target, guess, max_rounds, callback):
    """Register from one initial guess and assess the result."""
    aligned = align(source, target, guess, max_rounds, callback)
    return _Attempt(*aligned, assess(source, target, aligned[0]))


def _as_alignment(found, source, target, searched, rounds_kept):
    """The best attempt as an Alignment, with its status in words."""
    pairs, solution = found.pairs, (source, target, found.pairs, found.kernel_width)
    ending = "fits" if found.converged else _reason_not_converged(found, source)
    verdict = found.fit.in_words() or ending
    free = "" if found.well_constrained else observability(*solution)[0].in_words()
    if free:
        verdict += f", but {free}"
    return Alignment(
        pose=_wrapped_pose(pairs),
        rounds=found.rounds,
        error=_mean_residual(pairs),
        share=np.count_nonzero(pairs.association.used) / len(source),
        converged=found.converged,
        verdict=verdict,
        history=tuple(rounds_kept),
        fit=found.fit,
        good=found.fit.good and found.converged,
        searched=searched,
        _solution=solution,
    )


def _reason_not_converged(found, source):
    """Why an attempt did not converge, in words."""
    if np.count_nonzero(found.pairs.association.used) < min_pairs(source):
        return "lost: too few correspondences agree"
    return f"still moving after {found.rounds} rounds"


def _wrapped_pose(pairs):
    """Pose (3,) of pairs, its heading wrapped."""
    x, y, theta = pairs.pose
    return np.array([x, y, wrap(float(theta))])


def _mean_residual(pairs):
    """Mean point-to-line residual of the inlier pairs [m]; NaN without any."""
    sizes = np.abs(pairs.residuals[pairs.association.used])
    return float(sizes.sum()) / len(sizes) if len(sizes) else np.nan


def _as_round(pairs, source, target):
    """An iteration as a Round, its pairs by the rows of the clouds that came in."""
    used = np.flatnonzero(pairs.association.used)
    rows = source.original_index(used), target.original_index(pairs.association.target_index[used])
    return Round(_wrapped_pose(pairs), _mean_residual(pairs), np.column_stack(rows))
