"""Rules of derivations (rewriting rules): Jacobian, block matrices, expected value."""

import sympy as sp

from classroom.derivation.random_points import Symmetric


def symmetric(name, size):
    """Make the symbol of a symmetric, positive definite matrix, such as a covariance. Returns a
    MatrixSymbol (size, size).

    Parameters
    ----------
    name : str
    size : int, number of rows
    """
    return Symmetric(name, size, size)


def partials(f, by):
    """Return the Jacobian ∂f/∂x, a Matrix (m, n) of unevaluated partial derivatives.

    Parameters
    ----------
    f : sympy column (m, 1)
    by : list of n symbols
    """
    return sp.Matrix([[sp.Derivative(row, symbol) for symbol in by] for row in f])


def differentiate(*by):
    """Return a rule that evaluates derivatives with respect to symbols.

    by : symbols; without any, all derivatives are evaluated. Returns a function of a
    line -> the next line.
    """

    def evaluated(derivative):
        wanted = not by or set(derivative.variables) <= set(by)
        return derivative.doit() if wanted else derivative

    return lambda line: line.replace(lambda part: isinstance(part, sp.Derivative), evaluated)


def blockwise(line):
    """Rule that evaluates products of block matrices.

    line : matrix expression of BlockMatrix. Returns a BlockMatrix, or its only block.
    """
    return sp.block_collapse(line)


def expectation(covariances):
    """Return a rule that replaces products of zero-mean random columns with their expected value
    E[·].

    Returns
    -------
    function of a sum of products of a random column and a transposed one, to its expected value;
    ValueError

    covariances : dict, product such as ``q * q.T`` to its covariance; others are uncorrelated.
    """
    random = {factor for pair in covariances for factor in pair.args if factor.is_symbol}

    def expected(products):
        total = sp.ZeroMatrix(*products.shape)
        for term in sp.Add.make_args(sp.expand(products)):
            number, factors = term.as_coeff_matrices()
            at = [k for k, factor in enumerate(factors) if factor.atoms(sp.MatrixSymbol) & random]
            if len(at) != 2 or at[1] != at[0] + 1:
                raise ValueError(
                    f"{term}: two random columns must be adjacent, one of them transposed"
                )
            covariance = covariances.get(factors[at[0]] * factors[at[1]])
            if covariance is not None:
                total += number * sp.MatMul(*factors[: at[0]], covariance, *factors[at[1] + 1 :])
        return total

    return expected
