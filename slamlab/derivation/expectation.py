"""Expected value of sums of products in which two random columns meet: a covariance, or zero."""

import sympy as sp


def expectation(covariances):
    """Make E[·] of random columns of mean zero; where no covariance is said, two are unrelated.

    Matrices that are not random go through; a pair of random columns becomes its covariance.

    Parameters
    ----------
    covariances : dict, product such as ``q * q.T`` to its covariance (a matrix symbol)

    Returns
    -------
    function of a sum of products, each of which holds one random column and the transpose of one
    (ValueError where one does not), to its expected value
    """
    random = {factor for pair in covariances for factor in pair.args if factor.is_symbol}

    def expected(products):
        total = sp.ZeroMatrix(*products.shape)
        for term in sp.Add.make_args(sp.expand(products)):
            number, factors = term.as_coeff_matrices()
            at = [k for k, factor in enumerate(factors) if factor.atoms(sp.MatrixSymbol) & random]
            if len(at) != 2 or at[1] != at[0] + 1:
                raise ValueError(f"{term}: two random columns have to meet, one of them transposed")
            covariance = covariances.get(factors[at[0]] * factors[at[1]])
            if covariance is not None:
                total += number * sp.MatMul(*factors[: at[0]], covariance, *factors[at[1] + 1 :])
        return total

    return expected
