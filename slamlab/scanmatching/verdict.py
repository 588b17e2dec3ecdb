"""Whether a match is to be believed: what lies on the other surface, and what contradicts it."""

from dataclasses import dataclass

import numpy as np

from slamlab.geometry import inverse
from slamlab.scanmatching.align import paired

ON = 3.0, 0.01  # standard deviations, and share of the range, within which a point lies on a line
BEFORE = 4.0, 0.03  # the same by which a point stands before what was seen behind it
# the shares are for what real scans are beside noisy: taken on the move, of walls not quite upright
OVERLAP = 0.3  # least share of the source's points that must lie on the target
PLENTY = 0.7  # share of the points on the target that leaves nothing to ask the target's points
AGREEMENT = 0.8  # least share of these among them and the points that contradict


@dataclass(frozen=True)
class Fit:
    """How two surfaces fit at a pose.

    Parameters
    ----------
    inliers : (n,) bool, the source's points that lie on the target
    overlap : float, their share of the source's points [1]
    agreement : float, their share of themselves and of the points that contradict: that stand where
        the other's scanner looked through; of the target's only where the overlap is not plenty [1]
    """

    inliers: np.ndarray
    overlap: float
    agreement: float

    @property
    def good(self):
        """Whether enough overlaps and agrees."""
        return self.overlap >= OVERLAP and self.agreement >= AGREEMENT

    def in_words(self):
        """Why this is no good; empty where it is."""
        if self.overlap < OVERLAP:
            return f"poor: {self.overlap:.0%} of the points lie on the other surface"
        if self.agreement < AGREEMENT:
            against = 1 - self.agreement
            return f"poor: {against:.0%} of the points stand where the other scan looked through"
        return ""

    @property
    def score(self):
        """The better the higher, to choose among poses [1]."""
        return self.overlap * self.agreement


def fit(source, target, pairs):
    """Judge a pose.

    Parameters
    ----------
    source, target : Surface
    pairs : Pairs at that pose

    Returns
    -------
    Fit
    """
    inliers = pairs.seen & (np.abs(pairs.residuals) < tolerance(pairs, *ON))
    hits, against = np.count_nonzero(inliers), contradictions(pairs, target)
    if source.bearings is not None and hits < PLENTY * len(inliers):
        against += contradictions(paired(target, source, inverse(pairs.pose)), source)
    return Fit(inliers, hits / len(inliers), hits / max(hits + against, 1))


def contradictions(pairs, target):
    """How many points stand clearly nearer to the target's scanner than what it saw there."""
    if target.bearings is None:
        return 0
    off = tolerance(pairs, *BEFORE)
    short = target.ranges[pairs.place] - pairs.ranges > off
    return np.count_nonzero(pairs.seen & short & (np.abs(pairs.residuals) > off))


def tolerance(pairs, deviations, share):
    """(n,) how far a point may be off [m]."""
    return deviations * np.sqrt(pairs.variance) + share * pairs.ranges
