"""Random points: exact numbers for the symbols of a formula, as they are assumed to be."""

import numpy as np
import sympy as sp

SEED = 4  # the same points on every run, so the same words in a stored notebook


class Symmetric(sp.MatrixSymbol):
    """A symbol of a symmetric, positive definite matrix, such as a covariance: P^T is P."""

    def _eval_transpose(self):
        return self


def generator():
    """The Generator that the points of one step are drawn from."""
    return np.random.default_rng(SEED)


def random_point(symbols, rng):
    """Draw a point: tenths for numbers, whole numbers for the entries of matrices.

    Parameters
    ----------
    symbols : iterable of Symbol and MatrixSymbol
    rng : numpy.random.Generator

    Returns
    -------
    dict, symbol to Rational or ImmutableMatrix; sorted by name
    """
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
