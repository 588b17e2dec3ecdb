"""Code similarity (plagiarism) within a class: rank pairs of submissions, and compare two side by
side.

K-grams that occur in the original notebooks, or in more than half of the submissions, do not count.
Any other k-gram in n of N submissions has the weight log2((N + 1) / n). A pair's score is w² / m,
where w is the weight of the shared k-grams and m the smaller of the two submissions' weights.
"""

import math
from collections import Counter
from dataclasses import dataclass

import numpy as np
from scipy import sparse

from classroom.grading.similarity.code_tokens import grams

MAX_CHARACTERS = 50_000  # of a submission that is compared; nobody writes more by hand
MAX_PAIRS = 50
SHARED, GIVEN, OWN = "shared", "given", "own"


@dataclass(frozen=True)
class Pair:
    """Two submissions that share rare k-grams."""

    left: str
    right: str
    share: float  # weight of the shared k-grams, relative to the smaller submission's weight [1]
    score: float  # the rank's criterion [bits]


class ClassSimilarity:
    """Compares submissions, given as a dict from name to cells. ``given`` are the k-grams of the
    original notebooks. ``count`` submissions are compared, excluding those in ``too_long``;
    ``pairs`` are the MAX_PAIRS most similar pairs.
    """

    def __init__(self, cells, given=frozenset()):
        letters = {name: sum(len(source) for _, source in mine) for name, mine in cells.items()}
        self.too_long = sorted(name for name in cells if letters[name] > MAX_CHARACTERS)
        self._cells = {n: mine for n, mine in cells.items() if letters[n] <= MAX_CHARACTERS}
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
        # pairs of equal scores keep the order of the class
        best = np.lexsort((found.col, found.row, -score))[:MAX_PAIRS]
        return [
            Pair(names[found.row[i]], names[found.col[i]], float(share[i]), float(score[i]))
            for i in best
        ]

    def side_by_side(self, left, right):
        """Return two submissions as lists of (number, lines), without cells that contain only
        original code. A line is (text, kind, position); the position of SHARED code is its (cell,
        line) in the other submission. Raises KeyError.
        """
        both = self._rare[left] & self._rare[right]
        mine, theirs = self._cells[left], self._cells[right]
        return (
            self._lines(left, both, _positions(theirs)),
            self._lines(right, both, _positions(mine)),
        )

    def _lines(self, name, both, positions):
        shown = []
        for number, source in self._cells[name]:
            texts, shared, rare = source.split("\n"), {}, set()
            for gram, first, last in grams(source):
                covered = range(first, last + 1)
                if gram in both:
                    for line in covered:
                        shared.setdefault(line, positions[gram])
                if gram in self._weights:
                    rare.update(covered)
            if not rare:
                continue
            kinds = [
                SHARED if i in shared else OWN if i in rare else GIVEN for i in range(len(texts))
            ]
            lines = zip(texts, kinds, map(shared.get, range(len(texts))), strict=True)
            shown.append((number, list(lines)))
        return shown


def _positions(cells):
    found = {}
    for number, source in cells:
        for gram, first, _ in grams(source):
            found.setdefault(gram, (number, first + 1))
    return found
