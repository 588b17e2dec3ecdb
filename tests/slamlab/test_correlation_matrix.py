"""Correlation matrices: free of units, one on the diagonal, and drawn block by block."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab import views
from slamlab.evaluation import correlation
from tests.slamlab.support import refuses

NAMES = ["robot", "p1", "p2"]


def covariance(seed, n=7):
    root = np.random.default_rng(seed).standard_normal((n, n + 2))
    return root @ root.T


@given(st.integers(0, 10**6))
def test_units_do_not_matter(seed):
    P, units = covariance(seed), np.random.default_rng(seed).uniform(1e-3, 1e3, 7)
    assert np.allclose(correlation(P), correlation(units[:, None] * P * units))


@given(st.integers(0, 10**6))
def test_they_are_the_covariance_of_normalised_components(seed):
    P = covariance(seed)
    scaled = np.linalg.cholesky(P) / np.sqrt(np.diag(P))[:, None]
    assert np.allclose(correlation(P), scaled @ scaled.T)
    assert np.abs(correlation(P)).max() <= 1


def test_a_certain_estimate_is_uncorrelated():
    P = covariance(3)
    P[:3] = P[:, :3] = 0
    rho = correlation(P)
    assert not rho[:3].any() and not rho[:, :3].any()
    assert np.allclose(np.diag(rho)[3:], 1)


test_an_invalid_covariance_is_refused = refuses(
    correlation,
    (np.ones((2, 3)), "square"),
    (np.diag([1.0, -1.0]), "negative variance"),
    (np.diag([1.0, np.nan]), "NaN"),
)


def test_the_picture_shows_each_entry_with_the_blocks_named():
    rho = correlation(covariance(1))
    _, ax = views.correlation(rho, NAMES, "after the first scan")
    (picture,) = ax.images
    assert np.array_equal(picture.get_array(), rho) and picture.get_clim() == (-1, 1)
    assert [label.get_text() for label in ax.get_xticklabels()] == NAMES
    assert ax.get_xticks().tolist() == [1, 3.5, 5.5]


def test_a_covariance_or_names_that_do_not_fit_are_refused():
    with pytest.raises(ValueError, match="not correlations"):
        views.correlation(covariance(1), NAMES)
    with pytest.raises(ValueError, match="2 blocks"):
        views.correlation(correlation(covariance(1)), NAMES[:2])
