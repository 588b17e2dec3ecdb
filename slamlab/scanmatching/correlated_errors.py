"""Correlated errors of wall points, such as motion distortion; averaging cannot reduce them."""

import numpy as np

SAME_WALL = 0.98  # least cosine between the normals of two points of one wall [1]
SIGNIFICANCE = 1.5  # a smaller sum, in standard deviations, is attributed to chance [1]
MAX_RESIDUAL = 3.0  # in kernel widths: a larger residual belongs to another surface [1]


class CorrelatedError:
    """Standard deviation of the correlated error, estimated from all matches so far."""

    def __init__(self):
        self._sum, self._squares, self._count = 0.0, 0.0, 0

    def add(self, source, correspondences, kernel_width):
        """Add products r_i r_{i+k} of residuals (autocorrelation) with a lag k so large that the
        two points share no fitted line."""
        if source.fits.windows is None:
            return
        lag = int(source.fits.windows.count.max()) + 1
        if lag >= len(source):
            return
        nx, ny, r = source.fits.nx, source.fits.ny, correspondences.residuals
        usable = correspondences.association.used & (np.abs(r) < MAX_RESIDUAL * kernel_width)
        parallel = nx[:-lag] * nx[lag:] + ny[:-lag] * ny[lag:] > SAME_WALL
        both = usable[:-lag] & usable[lag:] & parallel
        products = (r[:-lag] * r[lag:])[both]
        self._sum += float(products.sum())
        self._squares += float(products @ products)
        self._count += len(products)

    @property
    def sigma(self):
        """Standard deviation of the error [m]; 0 if it is not significant."""
        significant = self._sum - SIGNIFICANCE * np.sqrt(self._squares)
        return float(np.sqrt(max(significant, 0.0) / max(self._count, 1)))
