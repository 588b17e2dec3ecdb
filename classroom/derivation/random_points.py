"""Random points: exact numbers for symbols, according to their assumptions."""

import numpy as np
import sympy as sp

SEED = 4  # the same points on every run, so that stored outputs stay the same


class Symmetric(sp.MatrixSymbol):
    """Symbol of a symmetric, positive definite matrix."""

    def _eval_transpose(self):
        return self


def generator():
    """Return a random generator for the points of one step."""
    return np.random.default_rng(SEED)


def random_point(symbols, rng):
    """Draw a point: multiples of 0.1 for numbers, integers for entries of matrices."""
    ordered = sorted(symbols, key=str)
    return {symbol: (_matrix if symbol.is_Matrix else _number)(symbol, rng) for symbol in ordered}


def _number(symbol, rng):
    size = sp.Integer(rng.integers(1, 40))
    if not symbol.is_integer:
        size /= 10
    sign = 1 if symbol.is_nonnegative else -1 if symbol.is_nonpositive else rng.choice([-1, 1])
    return size * int(sign)


def _matrix(symbol, rng):
    rows, columns = (int(size) for size in symbol.shape)
    entries = sp.Matrix(rows, columns, [int(e) for e in rng.integers(-4, 5, rows * columns)])
    if isinstance(symbol, Symmetric):
        entries = entries * entries.T + sp.eye(rows)
    return sp.ImmutableMatrix(entries)
