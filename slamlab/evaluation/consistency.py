"""Filter consistency: NEES, NIS, their chi-squared (χ²) bands, and the test of the definition.

Is a filter overconfident? One run says little: the laws below are about averages over independent
runs, all at the same step.
"""

from dataclasses import dataclass

import numpy as np

# Tracy and Widom's law as a shifted gamma distribution: shape, scale, shift (Chiani 2014, table 1)
TRACY_WIDOM = 46.446, 0.186054, 9.84801


def nees(error, P):
    """NEES, normalised estimation error squared, x̃ᵀ P⁻¹ x̃ (Bar-Shalom, Li, Kirubarajan 2001, 5.4).

    χ² with n degrees of freedom, so n on average, where P is the covariance of the error.

    Parameters
    ----------
    error : (..., n) estimate minus truth, angles wrapped
    P : (..., n, n) what the filter believes of it

    Returns
    -------
    (...,)

    Raises
    ------
    ValueError : shapes that do not fit, or a P that is not positive definite
    """
    white = _whiten(error, P)
    return np.sum(white**2, axis=-1)


def nis(innovation, S):
    """NIS, normalised innovation squared, vᵀ S⁻¹ v: what :func:`nees` is where no truth is known.

    Parameters
    ----------
    innovation : (..., m) v = z − h(x), bearings wrapped
    S : (..., m, m) H P Hᵀ + R

    Returns
    -------
    (...,)

    Raises
    ------
    ValueError : shapes that do not fit, or an S that is not positive definite
    """
    return nees(innovation, S)


def band(size, runs, probability=0.95):
    """Chi-squared band (acceptance interval) of the average NEES or NIS over Monte Carlo runs.

    For a consistent filter runs · average ~ χ² with runs · size degrees of freedom, at one step:
    the steps of a run hang together, so an average over steps has no such law.

    Parameters
    ----------
    size : int, of the error or the innovation
    runs : int, independent ones
    probability : float, how often a consistent filter lies inside [1]

    Returns
    -------
    (low, high) : floats

    Raises
    ------
    ValueError
    """
    from scipy.special import gammaincinv  # scipy.stats takes a third of a second to load

    if size < 1 or runs < 1:
        raise ValueError(f"a band needs a size and runs of at least 1, not {size} and {runs}")
    _check_probability(probability)
    tails = np.array([1 - probability, 1 + probability]) / 2
    low, high = 2 * gammaincinv(runs * size / 2, tails) / runs
    return float(low), float(high)


@dataclass(frozen=True)
class Consistency:
    """Result of the consistency test of P − E[x̃ x̃ᵀ] ⪰ 0.

    Parameters
    ----------
    largest : float, largest mean square of an error in units of its variance, over all directions;
        the definition asks for at most 1 in expectation [1]
    limit : float, what a filter with P = E[x̃ x̃ᵀ] stays below with the probability asked for [1]
    direction : (n,) where the worst error points, by whitened components
    """

    largest: float
    limit: float
    direction: np.ndarray

    @property
    def refuted(self):
        """Whether the runs show the filter to be inconsistent, too sure of itself (overconfident).

        False is no proof: it says that so many runs hold nothing against the filter.
        """
        return self.largest > self.limit


def consistency(errors, P, probability=0.95):
    """Test consistency by its definition, P − E[x̃ x̃ᵀ] ⪰ 0 (MAK thesis, chapter 2).

    With P = L Lᵀ it says that no eigenvalue of E[w wᵀ], w = L⁻¹ x̃, is above 1. The mean over n
    runs always has one above 1 by chance; how far, its law tells: n times the mean is Wishart
    distributed (Johnstone 2001; Chiani 2014).

    Parameters
    ----------
    errors : (runs, n) estimate minus truth at one step, angles wrapped
    P : (runs, n, n) what the filter believed in each run
    probability : float, how often a filter with P = E[x̃ x̃ᵀ] is not refuted [1]

    Returns
    -------
    Consistency

    Raises
    ------
    ValueError : fewer runs than components of the error, or what :func:`nees` refuses
    """
    white = np.atleast_2d(_whiten(errors, P))
    runs, n = white.shape
    if runs < n:
        raise ValueError(f"{runs} runs say nothing of a {n} × {n} covariance: make at least {n}")
    values, vectors = np.linalg.eigh(white.T @ white / runs)
    return Consistency(float(values[-1]), largest_eigenvalue(n, runs, probability), vectors[:, -1])


def largest_eigenvalue(size, runs, probability=0.95):
    """Quantile of the largest eigenvalue of a mean of w wᵀ, w standard normal (Wishart).

    Johnstone's centre and spread, Tracy–Widom's law; the probability is met within 1 %.

    Parameters
    ----------
    size : int, of w
    runs : int
    probability : float [1]

    Returns
    -------
    float
    """
    from scipy.special import gammaincinv

    _check_probability(probability)
    shape, scale, shift = TRACY_WIDOM
    a, b = np.sqrt(runs - 0.5), np.sqrt(size - 0.5)
    spread = (a + b) * (1 / a + 1 / b) ** (1 / 3)
    quantile = scale * gammaincinv(shape, probability) - shift
    return float(((a + b) ** 2 + spread * quantile) / runs)


def _whiten(error, P):
    error, P = np.asarray(error, dtype=float), np.asarray(P, dtype=float)
    if error.ndim < 1 or P.shape[-2:] != 2 * error.shape[-1:]:
        raise ValueError(f"an error of shape {error.shape} has no covariance of shape {P.shape}")
    try:
        root = np.linalg.cholesky(P)
    except np.linalg.LinAlgError:
        raise ValueError("P is not positive definite: its error cannot be normalised") from None
    return np.linalg.solve(root, error[..., None])[..., 0]


def _check_probability(probability):
    if not 0 < probability < 1:
        raise ValueError(f"probability is between 0 and 1, such as 0.95, not {probability}")
