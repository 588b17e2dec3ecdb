"""Filter consistency: NEES, NIS, χ² intervals for Monte Carlo runs, test by the definition."""

from dataclasses import dataclass

import numpy as np

# Tracy-Widom law as a shifted gamma distribution: shape, scale, shift (Chiani 2014, table 1)
TRACY_WIDOM = 46.446, 0.186054, 9.84801


def nees(error, P):
    """Compute the NEES (normalised estimation error squared) x̃ᵀ P⁻¹ x̃ (Bar-Shalom, Li,
    Kirubarajan 2001, 5.4). Returns (...,) χ² with n degrees of freedom if consistent. Raises
    ValueError for shapes that do not fit and for P that is not positive definite.

    Parameters
    ----------
    error : (..., n) estimate minus truth, angles wrapped
    P : (..., n, n) covariance by the filter
    """
    white = _whiten(error, P)
    return np.sum(white**2, axis=-1)


def nis(innovation, S):
    """Compute the NIS (normalised innovation squared) vᵀ S⁻¹ v. Returns (...,). Raises ValueError.

    Parameters
    ----------
    innovation : (..., m) v = z − h(x)
    S : (..., m, m) H P Hᵀ + R
    """
    return nees(innovation, S)


def band(size, runs, probability=0.95):
    """Chi-squared interval of the NEES consistency test (chi-squared band, χ² acceptance interval)
    for the average of Monte Carlo runs at one step: runs · average ~ χ² with runs · size degrees.
    Returns low and high. Raises ValueError.

    Parameters
    ----------
    size : int, of the error or the innovation
    runs : int, independent ones
    probability : float [1]
    """
    from scipy.special import gammaincinv  # scipy.stats takes a third of a second to load

    if size < 1 or runs < 1:
        raise ValueError(f"size and runs must be at least 1, not {size} and {runs}")
    _check_probability(probability)
    tails = np.array([1 - probability, 1 + probability]) / 2
    low, high = 2 * gammaincinv(runs * size / 2, tails) / runs
    return float(low), float(high)


@dataclass(frozen=True)
class Consistency:
    """Result of the test of P − E[x̃ x̃ᵀ] ⪰ 0.

    Parameters
    ----------
    largest : float, largest mean square error in units of its variance, over all directions [1]
    limit : float, its quantile for a filter with P = E[x̃ x̃ᵀ] [1]
    direction : (n,) of the worst error, in whitened components
    """

    largest: float
    limit: float
    direction: np.ndarray

    @property
    def refuted(self):
        """Whether the runs show the filter to be overconfident; False proves nothing."""
        return self.largest > self.limit


def consistency(errors, P, probability=0.95):
    """Test whether the covariance is conservative, P − E[x̃ x̃ᵀ] ⪰ 0 (which the MAK thesis, chapter
    2, calls consistent): with P = L Lᵀ and w = L⁻¹ x̃, all eigenvalues of E[w wᵀ] must be at most
    1. Returns a Consistency. Raises ValueError for fewer runs than components, and as :func:`nees`.

    Parameters
    ----------
    errors : (runs, n) estimate minus truth at one step, angles wrapped
    P : (runs, n, n) covariance by the filter
    probability : float, that a filter with P = E[x̃ x̃ᵀ] passes [1]
    """
    white = np.atleast_2d(_whiten(errors, P))
    runs, n = white.shape
    if runs < n:
        raise ValueError(f"{runs} runs are too few for a {n} × {n} covariance: use at least {n}")
    values, vectors = np.linalg.eigh(white.T @ white / runs)
    return Consistency(float(values[-1]), largest_eigenvalue(n, runs, probability), vectors[:, -1])


def largest_eigenvalue(size, runs, probability=0.95):
    """Return a quantile of the largest eigenvalue of a mean of w wᵀ for standard normal w (Wishart;
    Johnstone 2001, Chiani 2014); its probability is within 1 % of the given one."""
    from scipy.special import gammaincinv

    _check_probability(probability)
    shape, scale, shift = TRACY_WIDOM
    a, b = np.sqrt(runs - 0.5), np.sqrt(size - 0.5)
    width = (a + b) * (1 / a + 1 / b) ** (1 / 3)
    quantile = scale * gammaincinv(shape, probability) - shift
    return float(((a + b) ** 2 + width * quantile) / runs)


def _whiten(error, P):
    error, P = np.asarray(error, dtype=float), np.asarray(P, dtype=float)
    if error.ndim < 1 or P.shape[-2:] != 2 * error.shape[-1:]:
        raise ValueError(f"the error has shape {error.shape}, but its covariance has {P.shape}")
    try:
        root = np.linalg.cholesky(P)
    except np.linalg.LinAlgError:
        raise ValueError("P is not positive definite: its error cannot be normalised") from None
    return np.linalg.solve(root, error[..., None])[..., 0]


def _check_probability(probability):
    if not 0 < probability < 1:
        raise ValueError(f"probability must be between 0 and 1, such as 0.95, not {probability}")
