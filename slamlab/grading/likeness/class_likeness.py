"""A class's likeness: pairs ranked by the rarity of what they share, and two side by side.

What was handed out does not count, nor what more than half of the class have, for the task asks for
it. Any other k-gram that n of N have weighs log2((N + 1) / n). A pair's score is the weight of what
both have times its share of all that the one with less has: two who share a rare line by chance
share little of their work.
"""

import math
from collections import Counter
from dataclasses import dataclass

import numpy as np
from scipy import sparse

from slamlab.grading.likeness.code_tokens import grams

MOST_LETTERS = 50_000  # of a submission; nobody writes more by hand
MOST_PAIRS = 50
ALIKE, GIVEN, OWN = "alike", "given", "own"


@dataclass(frozen=True)
class Pair:
    """Two submissions that share something rare.

    Parameters
    ----------
    left, right : str
    share : float, of all that is rare in the one that has less of it [1]
    score : float, what pairs are ranked by [bits]
    """

    left: str
    right: str
    share: float
    score: float


class ClassLikeness:
    """The likeness of all submissions of an exercise.

    Parameters
    ----------
    cells : dict, name of a submission to list of (number, source)
    given : container of int, k-grams of what was handed out

    Attributes
    ----------
    count : int, how many are compared
    too_long : list of str, submissions that are not
    pairs : list of Pair, the MOST_PAIRS most alike, the most alike first
    """

    def __init__(self, cells, given=frozenset()):
        letters = {name: sum(len(source) for _, source in mine) for name, mine in cells.items()}
        self.too_long = sorted(name for name in cells if letters[name] > MOST_LETTERS)
        self._cells = {n: mine for n, mine in cells.items() if letters[n] <= MOST_LETTERS}
        own = {
            name: {gram for _, source in mine for gram, _, _ in grams(source)} - given
            for name, mine in self._cells.items()
        }
        self.count = count = len(own)
        held = Counter(gram for mine in own.values() for gram in mine)
        most = max(2, count / 2)
        self._weights = {g: math.log2((count + 1) / n) for g, n in held.items() if n <= most}
        self._rare = {name: mine & self._weights.keys() for name, mine in own.items()}
        self.pairs = self._ranked()

    def _ranked(self):
        names, known = list(self._rare), self._weights
        columns = {gram: column for column, gram in enumerate(known)}
        rows = [columns[gram] for name in names for gram in self._rare[name]]
        ends = np.cumsum([0, *(len(self._rare[name]) for name in names)])
        has = sparse.csr_array((np.ones(len(rows)), rows, ends), (len(names), len(columns)))
        shared = (has * np.fromiter(known.values(), float)[None, :]) @ has.T
        total = shared.diagonal()
        found = sparse.triu(shared, 1).tocoo()
        share = found.data / np.minimum(total[found.row], total[found.col])
        score = share * found.data
        # what is equally alike stands in the class's order
        best = np.lexsort((found.col, found.row, -score))[:MOST_PAIRS]
        return [
            Pair(names[found.row[i]], names[found.col[i]], float(share[i]), float(score[i]))
            for i in best
        ]

    def side_by_side(self, left, right):
        """Two submissions; cells in which nothing is their own are left out.

        Parameters
        ----------
        left, right : str

        Returns
        -------
        two lists of (number, lines); a line is (text, kind, place): ALIKE, with the place of what
        is like it, (number, line from 1) in the other one; GIVEN, to the class or by the task; OWN

        Raises
        ------
        KeyError : there is no such submission
        """
        both = self._rare[left] & self._rare[right]
        mine, theirs = self._cells[left], self._cells[right]
        return self._lines(left, both, _places(theirs)), self._lines(right, both, _places(mine))

    def _lines(self, name, both, places):
        shown = []
        for number, source in self._cells[name]:
            texts, alike, rare = source.split("\n"), {}, set()
            for gram, first, last in grams(source):
                covered = range(first, last + 1)
                if gram in both:
                    for line in covered:
                        alike.setdefault(line, places[gram])
                if gram in self._weights:
                    rare.update(covered)
            if not rare:
                continue
            kinds = [
                ALIKE if i in alike else OWN if i in rare else GIVEN for i in range(len(texts))
            ]
            lines = zip(texts, kinds, map(alike.get, range(len(texts))), strict=True)
            shown.append((number, list(lines)))
        return shown


def _places(cells):
    """k-gram to the first place, (number, line from 1), that it stands at."""
    found = {}
    for number, source in cells:
        for gram, first, _ in grams(source):
            found.setdefault(gram, (number, first + 1))
    return found
