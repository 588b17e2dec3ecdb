"""Ranking: scores with confidence intervals, ranks with ties, by a paired bootstrap over worlds.

Worlds are drawn with replacement in each family (Efron 1979); all students get the same draws. A
student ranks ahead of another whose score is lower in nearly all draws."""

from dataclasses import dataclass

import numpy as np

DRAWS = 4000
LEVEL = 0.95  # confidence level of intervals and of differences


@dataclass(frozen=True)
class Standing:
    """Rank and score of one student."""

    rank: int  # one more than the number of students who are significantly ahead
    score: float  # 0 to 100
    low: float  # of the score's interval
    high: float
    families: np.ndarray  # (f,) median of each family


def by_families(points, families):
    """Arrange points (n,) in a table (families, worlds); repeat the single world of a log."""
    rows = {}
    for found, family in zip(points, families, strict=True):
        rows.setdefault(family, []).append(found)
    worlds = max(map(len, rows.values()))
    return np.array([np.resize(row, worlds) for row in rows.values()], dtype=float)


def scores(points):
    """Compute scores of points (…, families, worlds): the mean of the families' medians."""
    return np.median(points, axis=-1).mean(axis=-1)


def standings(points, rng):
    """Rank students by points (students, families, worlds); return Standings in this order."""
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
    # the interval of a skewed score may exclude the score: widen it
    low, high = np.minimum(low, found), np.maximum(high, found)
    return [
        Standing(ranks[i], float(found[i]), float(low[i]), float(high[i]), medians[i])
        for i in range(len(points))
    ]


def _ahead(all_scores, mine):
    return (all_scores > mine).mean(axis=1) > (1 + LEVEL) / 2
