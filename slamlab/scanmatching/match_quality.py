"""Match quality: overlap (inliers) and free-space contradictions, to accept or reject a match."""

from dataclasses import dataclass

import numpy as np

from slamlab.geometry import inverse
from slamlab.scanmatching.correspondences import find_correspondences

# standard deviations, and share of the range [1]: within these a point is an inlier of its line
INLIER_TOLERANCE = 3.0, 0.01
# the same, by which a point stands in free space: before what the other scan saw behind it
CONTRADICTION_TOLERANCE = 4.0, 0.03
# the shares are for what real scans are beside noisy: taken on the move, of walls not quite upright
MIN_OVERLAP = 0.3  # least share of the source's points that must be inliers [1]
AMPLE_OVERLAP = 0.7  # overlap from which the target's points are not tested as well [1]
MIN_AGREEMENT = 0.8  # least share of inliers among inliers and contradictions [1]


@dataclass(frozen=True)
class MatchQuality:
    """Quality of a match at a pose: inliers, overlap and agreement.

    Parameters
    ----------
    inliers : (n,) bool, the source's points that lie on the target; the others are outliers
    overlap : float, their share of the source's points [1]
    agreement : float, their share of themselves and of the points that contradict: that stand where
        the other's scanner looked through; of the target's only where the overlap is not plenty [1]
    """

    inliers: np.ndarray
    overlap: float
    agreement: float

    @property
    def good(self):
        """Whether the match is accepted: overlap and agreement above their thresholds."""
        return self.overlap >= MIN_OVERLAP and self.agreement >= MIN_AGREEMENT

    def in_words(self):
        """Why the match is rejected, in words; empty where it is accepted."""
        if self.overlap < MIN_OVERLAP:
            return f"poor: overlap {100 * self.overlap:.0f} % with the other surface"
        if self.agreement < MIN_AGREEMENT:
            against = 1 - self.agreement
            return f"poor: {100 * against:.0f} % of the points stand in the other scan's free space"
        return ""

    @property
    def score(self):
        """Score by which poses are compared, the higher the better [1]."""
        return self.overlap * self.agreement


def assess(source, target, pairs):
    """Assess the quality of a match at a pose: count inliers and free-space contradictions.

    Parameters
    ----------
    source, target : Surface
    pairs : Pairs, the correspondences at that pose

    Returns
    -------
    MatchQuality
    """
    near = np.abs(pairs.residuals) < _tolerance(pairs, *INLIER_TOLERANCE)
    inliers = pairs.association.in_view & near
    hits, against = np.count_nonzero(inliers), _count_contradictions(pairs, target)
    if source.bearings is not None and hits < AMPLE_OVERLAP * len(inliers):
        back = find_correspondences(target, source, inverse(pairs.pose))
        against += _count_contradictions(back, source)
    return MatchQuality(inliers, hits / len(inliers), hits / max(hits + against, 1))


def _count_contradictions(pairs, target):
    """How many points stand in free space: clearly nearer than what the target's beams hit."""
    if target.bearings is None:
        return 0
    off = _tolerance(pairs, *CONTRADICTION_TOLERANCE)
    short = target.ranges[pairs.association.target_index] - pairs.ranges > off
    return np.count_nonzero(pairs.association.in_view & short & (np.abs(pairs.residuals) > off))


def _tolerance(pairs, deviations, share):
    """Inlier tolerance: (n,) largest residual that the noise allows a point [m]."""
    return deviations * np.sqrt(pairs.association.variance) + share * pairs.ranges
