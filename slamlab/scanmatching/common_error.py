"""Errors that the points of whole walls have in common, measured by the residuals of a match.

Noise differs from beam to beam. Motion during a scan, walls not upright and a range that is off
shift many points alike; no rigid motion takes it away, and it does not average out.
"""

import numpy as np

SAME_WALL = 0.98  # least cosine between the normals of two points of one wall [1]
CHANCE = 1.5  # standard deviations of the sum that chance may make [1]
MAX_RESIDUAL = 3.0  # in kernel widths: a residual beyond it is of another surface [1]


def residual_covariance(source, pairs, kernel_width):
    """Covariance of the residuals of two points of a wall, too far apart to share a fitted line.

    Σ r_i r_{i+k} / n, k one more than the points of a line: without errors in common it is zero.

    Parameters
    ----------
    source : Surface, a scan
    pairs : Pairs, correspondences at the minimum
    kernel_width : float c of the robust weights [m]

    Returns
    -------
    float, float, int : the sum over the pairs of points [m²], that of its squares [m⁴], and their
        number n; zeros for a cloud without an order of beams
    """
    if source.fits.windows is None:
        return 0.0, 0.0, 0
    lag = int(source.fits.windows.count.max()) + 1
    if lag >= len(source):
        return 0.0, 0.0, 0
    nx, ny, r = source.fits.nx, source.fits.ny, pairs.residuals
    usable = pairs.association.used & (np.abs(r) < MAX_RESIDUAL * kernel_width)
    alike = nx[:-lag] * nx[lag:] + ny[:-lag] * ny[lag:] > SAME_WALL
    both = usable[:-lag] & usable[lag:] & alike
    products = (r[:-lag] * r[lag:])[both]
    return float(products.sum()), float(products @ products), len(products)


class CommonError:
    """The errors in common of all matches so far, as one standard deviation."""

    def __init__(self):
        self._sum, self._squares, self._count = 0.0, 0.0, 0

    def add(self, source, pairs, kernel_width):
        """Take in the residuals of a match; see ``residual_covariance``."""
        total, squares, count = residual_covariance(source, pairs, kernel_width)
        self._sum, self._squares = self._sum + total, self._squares + squares
        self._count += count

    @property
    def sigma(self):
        """Standard deviation [m]; 0 where the residuals show none beyond chance."""
        shown = self._sum - CHANCE * np.sqrt(self._squares)
        return float(np.sqrt(max(shown, 0.0) / max(self._count, 1)))
