"""Match quality: overlap (share of inliers) and contradictions of free space in a scan match."""

from dataclasses import dataclass

import numpy as np

from slamlab.geometry import inverse
from slamlab.scanmatching.correspondences import find_correspondences

# inlier threshold: standard deviations, and share of the range [1]
INLIER_TOLERANCE = 3.0, 0.01
# threshold of a contradiction: the point is so much nearer than what the other scan observed there
CONTRADICTION_TOLERANCE = 4.0, 0.03
# the shares of the range allow for motion distortion and walls that are not quite vertical
MIN_OVERLAP = 0.3  # least share of the source's points that must be inliers [1]
AMPLE_OVERLAP = 0.7  # with more overlap the target's points are not tested in turn [1]
MIN_AGREEMENT = 0.8  # least share of inliers among inliers and contradictions [1]


@dataclass(frozen=True)
class MatchQuality:
    """``inliers`` (n,) of the source; ``overlap``: the inliers' share of the source; ``agreement``:
    the share of inliers among inliers and contradictions (points in the other's free space)."""

    inliers: np.ndarray
    overlap: float
    agreement: float

    @property
    def good(self):
        return self.overlap >= MIN_OVERLAP and self.agreement >= MIN_AGREEMENT

    def in_words(self):
        """Return the reason why the match is rejected, or "" if it is accepted."""
        if self.overlap < MIN_OVERLAP:
            return f"poor: only {100 * self.overlap:.0f} % overlap"
        if self.agreement < MIN_AGREEMENT:
            against = 1 - self.agreement
            return f"poor: {100 * against:.0f} % of the points are in the other scan's free space"
        return ""

    @property
    def score(self):
        return self.overlap * self.agreement


def assess(source, target, correspondences):
    """Count inliers and contradictions of the Correspondences at a pose."""
    near = np.abs(correspondences.residuals) < _tolerance(correspondences, *INLIER_TOLERANCE)
    inliers = correspondences.association.in_view & near
    hits, against = np.count_nonzero(inliers), _count_contradictions(correspondences, target)
    if source.bearings is not None and hits < AMPLE_OVERLAP * len(inliers):
        back = find_correspondences(target, source, inverse(correspondences.pose))
        against += _count_contradictions(back, source)
    return MatchQuality(inliers, hits / len(inliers), hits / max(hits + against, 1))


def _count_contradictions(correspondences, target):
    """Count the points that are clearly nearer than the hits of the target's beams."""
    if target.bearings is None:
        return 0
    off = _tolerance(correspondences, *CONTRADICTION_TOLERANCE)
    short = target.ranges[correspondences.association.target_index] - correspondences.ranges > off
    return np.count_nonzero(
        correspondences.association.in_view & short & (np.abs(correspondences.residuals) > off)
    )


def _tolerance(correspondences, deviations, share):
    """Return the largest residuals (n,) that the noise allows [m]."""
    return (
        deviations * np.sqrt(correspondences.association.variance) + share * correspondences.ranges
    )
