"""Rules of a derivation: what leads from one line to the next."""

import sympy as sp

from slamlab.derivation.random_points import Symmetric


def symmetric(name, size):
    """Symbol of a symmetric, positive definite matrix: a covariance, whose transpose is itself.

    Parameters
    ----------
    name : str
    size : int, its rows

    Returns
    -------
    MatrixSymbol (size, size)
    """
    return Symmetric(name, size, size)


def partials(f, by):
    """Jacobian ∂f/∂x as it is defined: derivatives that nobody has worked out yet.

    Parameters
    ----------
    f : sympy column (m, 1)
    by : list of n symbols

    Returns
    -------
    Matrix (m, n) of Derivative
    """
    return sp.Matrix([[sp.Derivative(row, symbol) for symbol in by] for row in f])


def differentiate(*by):
    """Rule that works out the derivatives by some symbols, and leaves the others.

    Parameters
    ----------
    by : symbols; none for all derivatives

    Returns
    -------
    function of a line -> the next line
    """

    def worked_out(derivative):
        wanted = not by or set(derivative.variables) <= set(by)
        return derivative.doit() if wanted else derivative

    return lambda line: line.replace(lambda part: isinstance(part, sp.Derivative), worked_out)


def blockwise(line):
    """Rule that multiplies block matrices out, block by block.

    Parameters
    ----------
    line : matrix expression of BlockMatrix

    Returns
    -------
    BlockMatrix, or a matrix expression where there is one block
    """
    return sp.block_collapse(line)
