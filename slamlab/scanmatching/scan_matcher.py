"""Scan matching: robust point-to-line ICP, and correlative matching if ICP fails."""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from slamlab.geometry import wrap
from slamlab.scanmatching.centroids import Centroids
from slamlab.scanmatching.correlative_matching import candidate_poses
from slamlab.scanmatching.correspondences import Correspondences
from slamlab.scanmatching.match_covariance import Observability, icp_covariance, observability
from slamlab.scanmatching.match_quality import MatchQuality, assess
from slamlab.scanmatching.match_result import Iteration, Match, check_pose
from slamlab.scanmatching.preprocessing import preprocess
from slamlab.scanmatching.registration import align, min_correspondences


@dataclass(frozen=True)
class Alignment(Match):
    """Result of ``match``: a Match with covariance, whose error is the mean point-to-line residual.

    Parameters
    ----------
    fit : MatchQuality
    good : bool, accepted: converged, with enough overlap and agreement
    searched : bool, the correlative search was made
    """

    fit: MatchQuality = None
    good: bool = False
    searched: bool = False
    _solution: tuple = field(default=None, repr=False, compare=False)
    _centres: Centroids = field(default=None, repr=False, compare=False)

    @cached_property
    def covariance(self):
        """Covariance (3, 3) of the match [m, m, rad] from measurement noise: ``icp_covariance``."""
        return self._outward(self._about_centres)

    @cached_property
    def _about_centres(self):
        return icp_covariance(*self._solution)

    def _outward(self, covariance):
        return self._centres.outward_covariance(covariance, self.pose[2])

    def inflated_covariance(self, sigma):
        """Return the covariance (3, 3), inflated by correlated errors of ``sigma`` [m], which have
        more effect in weakly constrained directions."""
        seen = self.observability
        values = np.where(seen.fixed, seen.eigenvalues, np.inf)
        common = sigma**2 * seen.eigenvalues.sum() / 3 / np.maximum(values, 1e-300)
        scale = np.array([1, 1, 1 / seen.reach])
        common = (seen.directions * common) @ seen.directions.T
        return self._outward(self._about_centres + common * scale * scale[:, None])

    def add_residuals(self, correlated_error):
        """Add the residuals to a CorrelatedError."""
        source, _, correspondences, kernel_width = self._solution
        correlated_error.add(source, correspondences, kernel_width)

    @cached_property
    def observability(self) -> Observability:
        """Observability; relative to the centroids if the clouds are far from the origin."""
        return observability(*self._solution)[0]


def match(
    source, target, initial=(0.0, 0.0, 0.0), *, search=None, max_iterations=30, history=False
):
    """Match scans: register a source point cloud to a target, which is a scan or a submap. Returns
    an Alignment. Raises ValueError for unusable points or max_iterations.

    Parameters
    ----------
    source, target : (n, 2), (m, 2) points [m], of a scan in the order of its beams; or PointClouds
    initial : (3,) initial guess of the source's frame in the target's [m, m, rad]
    search : float, correlative matching with rotations up to this from the guess [rad]; 0: never;
        None: all rotations, if the match from the guess is poor
    max_iterations : int
    history : bool, keep an Iteration for each step
    """
    initial = check_pose(initial)
    if max_iterations < 1:
        raise ValueError(f"max_iterations must be at least 1, got {max_iterations}")
    source, target = preprocess(source, "source"), preprocess(target, "target")
    centres = Centroids(source.centre, target.centre)
    source, target, initial = source.centred, target.centred, centres.inward(initial)
    iterations_kept, found, searched = [], None, bool(search)

    def kept(correspondences):
        iterations_kept.append(_as_iteration(correspondences, source, target, centres))

    keep = kept if history else None
    if not search:
        found = _register_from(source, target, initial, max_iterations, keep)
        searched = search is None and not found.fit.good
    if searched:
        turn = np.pi if search is None else search
        for guess in candidate_poses(source, target, initial, turn):
            other = _register_from(source, target, guess, max_iterations, keep)
            if found is None or other.fit.score > found.fit.score:
                found = other
            if found.fit.good:
                break
    return _as_alignment(found, source, target, centres, searched, iterations_kept)


@dataclass(frozen=True)
class _Attempt:
    correspondences: Correspondences
    iterations: int
    converged: bool
    kernel_width: float
    well_constrained: bool
    fit: MatchQuality


def _register_from(source, target, guess, max_iterations, callback):
    aligned = align(source, target, guess, max_iterations, callback)
    return _Attempt(*aligned, assess(source, target, aligned[0]))


def _as_alignment(found, source, target, centres, searched, iterations_kept):
    correspondences = found.correspondences
    solution = source, target, correspondences, found.kernel_width
    ending = "fits" if found.converged else _reason_not_converged(found, source)
    verdict = found.fit.in_words() or ending
    free = "" if found.well_constrained else observability(*solution)[0].in_words()
    if free:
        verdict += f", but {free}"
    return Alignment(
        pose=_wrapped_pose(correspondences, centres),
        iterations=found.iterations,
        error=_mean_residual(correspondences),
        inlier_ratio=np.count_nonzero(correspondences.association.used) / len(source),
        converged=found.converged,
        verdict=verdict,
        history=tuple(iterations_kept),
        fit=found.fit,
        good=found.fit.good and found.converged,
        searched=searched,
        _solution=solution,
        _centres=centres,
    )


def _reason_not_converged(found, source):
    if np.count_nonzero(found.correspondences.association.used) < min_correspondences(source):
        return "lost: too few correspondences"
    return f"still moving after {found.iterations} iterations"


def _wrapped_pose(correspondences, centres):
    x, y, theta = centres.outward(correspondences.pose)
    return np.array([x, y, wrap(float(theta))])


def _mean_residual(correspondences):
    """Return the mean absolute residual of the used correspondences [m]; NaN without any."""
    sizes = np.abs(correspondences.residuals[correspondences.association.used])
    return float(sizes.sum()) / len(sizes) if len(sizes) else np.nan


def _as_iteration(correspondences, source, target, centres):
    """Return an Iteration, with correspondences as rows of the original clouds."""
    association, pose = correspondences.association, _wrapped_pose(correspondences, centres)
    used = np.flatnonzero(association.used)
    rows = source.original_index(used), target.original_index(association.target_index[used])
    return Iteration(pose, _mean_residual(correspondences), np.column_stack(rows))
