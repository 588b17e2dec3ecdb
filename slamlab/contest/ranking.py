"""Ranking: scores with intervals, and ranks with ties, by a paired bootstrap over the worlds.

Other worlds of the same families would have given other scores. How much other is told by drawing
worlds from those that were driven, with replacement, in each family (Efron 1979); the same worlds
for all, so that a hard one is hard for all. Who is ahead in nearly all such draws is ahead.
"""

from dataclasses import dataclass

import numpy as np

DRAWS = 4000
LEVEL = 0.95  # of intervals, and of being ahead


@dataclass(frozen=True)
class Standing:
    """Where one stands.

    Parameters
    ----------
    rank : int, one more than how many are ahead beyond doubt; who is tied shares it
    score : float, 0 to 100
    low, high : float, the interval of the score
    families : (f,) median of each family
    """

    rank: int
    score: float
    low: float
    high: float
    families: np.ndarray


def by_families(points, families):
    """Points of each world as a table; a recorded log, a family of one world, is repeated.

    Parameters
    ----------
    points : (n,) of each world
    families : (n,) str, whose world it is; those of a family stand together

    Returns
    -------
    (families, worlds)
    """
    rows = {}
    for found, family in zip(points, families, strict=True):
        rows.setdefault(family, []).append(found)
    worlds = max(map(len, rows.values()))
    return np.array([np.resize(row, worlds) for row in rows.values()], dtype=float)


def scores(points):
    """Scores from (…, families, worlds) points: the median of each family, their mean."""
    return np.median(points, axis=-1).mean(axis=-1)


def standings(points, rng):
    """Rank a class.

    Parameters
    ----------
    points : (students, families, worlds)
    rng : numpy.random.Generator

    Returns
    -------
    list of Standing, in the students' order
    """
    if not len(points):
        return []
    points = np.asarray(points, dtype=float)
    _, families, worlds = points.shape
    drawn = rng.integers(worlds, size=(DRAWS, families, worlds))
    drawn_scores = np.array([scores(own[np.arange(families)[:, None], drawn]) for own in points])
    found = scores(points)
    low, high = np.quantile(drawn_scores, [(1 - LEVEL) / 2, (1 + LEVEL) / 2], axis=1)
    medians = np.median(points, axis=-1)
    ranks = [1 + int(_ahead(drawn_scores, drawn_scores[i]).sum()) for i in range(len(points))]
    # an interval of a skewed score may leave its own score out: it is widened to hold it
    low, high = np.minimum(low, found), np.maximum(high, found)
    return [
        Standing(ranks[i], float(found[i]), float(low[i]), float(high[i]), medians[i])
        for i in range(len(points))
    ]


def _ahead(all_scores, mine):
    """Which of the students have the better score in nearly all draws."""
    return (all_scores > mine).mean(axis=1) > (1 + LEVEL) / 2
