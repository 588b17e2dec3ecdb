"""One matcher for all: as wide as point to point, as accurate as point to line, and it says so."""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from slamlab.geometry import wrap
from slamlab.scanmatching.align import Pairs, align, least
from slamlab.scanmatching.coarse import candidates
from slamlab.scanmatching.covariance import Observability, censi, observability
from slamlab.scanmatching.result import Match, Round, checked_pose
from slamlab.scanmatching.surfaces import surface
from slamlab.scanmatching.verdict import Fit, fit


@dataclass(frozen=True)
class Alignment(Match):
    """A match with how well it is known and whether it is to be believed.

    Its error is the mean distance across the walls, its share that of the points in use.

    Parameters
    ----------
    fit : Fit, what overlaps and what contradicts
    good : bool, it came to rest, enough overlaps and agrees
    searched : bool, the coarse search was made
    """

    fit: Fit = None
    good: bool = False
    searched: bool = False
    _end: tuple = field(default=None, repr=False, compare=False)

    @cached_property
    def covariance(self):
        """(3, 3) covariance of the pose by the points' noise [m, m, rad]; see ``censi``."""
        return censi(*self._end)

    def doubt(self, sigma):
        """Covariance where, beside the points' own noise, whole walls are off.

        Errors that points have in common do not average out: in a direction that holds its full
        share of the information they shift the pose by as much, in one that few points fix by more.

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

    @cached_property
    def observability(self) -> Observability:
        """What the walls fix."""
        return observability(*self._end)[0]


def match(source, target, initial=(0.0, 0.0, 0.0), *, search=None, max_rounds=30, history=False):
    """Lay a source over a target: where was the source's scan taken, seen from the target's?

    Parameters
    ----------
    source, target : (n, 2), (m, 2) points [m], a scan's in the order of its beams; or Surfaces made
        of them before
    initial : (3,) first guess of the source's frame in the target's [m, m, rad]
    search : float, look for the source in all places and all turns this far from the guess first
        [rad]; None: only where the guess leads to a poor match, then in all turns; 0: never
    max_rounds : int
    history : bool, keep a Round for every look

    Returns
    -------
    Alignment

    Raises
    ------
    ValueError : fewer than 3 points, wrong shapes, NaN, a senseless limit
    """
    initial = checked_pose(initial)
    if max_rounds < 1:
        raise ValueError(f"max_rounds must be at least 1, got {max_rounds}")
    source, target = surface(source, "source"), surface(target, "target")
    past, found, searched = [], None, bool(search)
    watch = (lambda pairs: past.append(looked(pairs, source, target))) if history else None
    if not search:
        found = attempt(source, target, initial, max_rounds, watch)
        searched = search is None and not found.fit.good
    if searched:
        turn = np.pi if search is None else search
        for guess in candidates(source, target, initial, turn):
            other = attempt(source, target, guess, max_rounds, watch)
            if found is None or other.fit.score > found.fit.score:
                found = other
            if found.fit.good:
                break
    return told(found, source, target, searched, past)


@dataclass(frozen=True)
class Attempt:
    """Where a guess led, and how good that is."""

    pairs: Pairs
    rounds: int
    rest: bool
    width: float
    fixed: bool
    fit: Fit


def attempt(source, target, guess, max_rounds, watch):
    """Align from a guess and judge what comes out."""
    aligned = align(source, target, guess, max_rounds, watch)
    return Attempt(*aligned, fit(source, target, aligned[0]))


def told(found, source, target, searched, past):
    """An attempt as an Alignment."""
    pairs, end = found.pairs, (source, target, found.pairs, found.width)
    verdict = found.fit.in_words() or ("fits" if found.rest else unrest(found, source))
    free = "" if found.fixed else observability(*end)[0].in_words()
    if free:
        verdict += f", but {free}"
    return Alignment(
        pose=settled(pairs),
        rounds=found.rounds,
        error=mean_size(pairs),
        share=np.count_nonzero(pairs.use) / len(source),
        converged=found.rest,
        verdict=verdict,
        history=tuple(past),
        fit=found.fit,
        good=found.fit.good and found.rest,
        searched=searched,
        _end=end,
    )


def unrest(found, source):
    """Why an attempt did not come to rest."""
    if np.count_nonzero(found.pairs.use) < least(source):
        return "lost: too few pairs of walls agree"
    return f"still moving after {found.rounds} rounds"


def settled(pairs):
    """(3,) the pose of pairs, its heading wrapped."""
    x, y, theta = pairs.pose
    return np.array([x, y, wrap(float(theta))])


def mean_size(pairs):
    """Mean distance across the walls of the pairs in use [m]; NaN without any."""
    return float(np.abs(pairs.residuals[pairs.use]).mean()) if pairs.use.any() else np.nan


def looked(pairs, source, target):
    """A look as a Round, its pairs by the rows of the clouds that came in."""
    used = np.flatnonzero(pairs.use)
    rows = source.row(used), target.row(pairs.place[used])
    return Round(settled(pairs), mean_size(pairs), np.column_stack(rows))
