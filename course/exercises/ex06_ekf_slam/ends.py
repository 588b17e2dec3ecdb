"""The ends of many runs of a filter, judged by the truth and by least squares."""

import numpy as np

from classroom.exercises.correctness_laws import once
from course.exercises.ex06_ekf_slam.runs import least_squares, truth
from slamlab.evaluation import band, nees
from slamlab.geometry import wrap

MAP = slice(3, None)
NO_COVARIANCE = "a P at the end is not a covariance: it has an eigenvalue of 0 or below"
HONEST = 1 - 5e-7  # a right filter lies inside a band in this share of gradings
APART = 0.2  # of x from least squares, mean square [σ²]: 0.06 at most for right filters, 3500 seeds
SLACK = 1.15  # the Jacobians are taken at estimates: bands are this much wider


def whole(inputs, outputs):
    """Whether the map holds each landmark once."""
    ids, met = outputs["ids"], np.unique(inputs["seen"][inputs["seen"] >= 0])
    runs = len(inputs["x"])
    fits = ids.shape == (runs, len(met)) and outputs["x"].shape == (runs, 3 + 2 * len(met))
    return bool(fits and (np.sort(ids, axis=1) == met).all())


def counted(inputs, outputs):
    """How many landmarks were measured, and how many are in the map."""
    met = np.unique(inputs["seen"][inputs["seen"] >= 0]).size
    found, ids = (outputs["x"].shape[1] - 3) / 2, outputs["ids"].shape[1]
    return f"{met} landmarks were measured; x contains {found:g}, and ids {ids}"


class Ends:
    """The ends of runs among landmarks of a ``kind``; ``sure`` is (low, high) of variances in units
    of those of least squares, ``mean`` limits their mean minus 1, ``apart`` limits :meth:`apart`.
    """

    def __init__(self, kind, sure, apart=APART, mean=np.inf):
        self.kind, self.sure_within, self.most, self.mean = kind, sure, apart, mean

    def in_order(self, inputs, x, P, ids):
        """x (r, n), P (r, n, n) with landmarks in the order of meeting."""
        met = list(truth(inputs, self.kind)[3])
        x, P = x.copy(), P.copy()
        for r, mine in enumerate(ids.tolist()):
            first = 3 + 2 * np.array([mine.index(i) for i in met])
            rows = np.concatenate([[0, 1, 2], np.column_stack([first, first + 1]).ravel()])
            x[r], P[r] = x[r, rows], P[r][np.ix_(rows, rows)]
        return x, P

    @once
    def of(self, inputs, outputs):
        """The final x and P, landmarks in the order of meeting."""
        return self.in_order(inputs, outputs["x"], outputs["P"], outputs["ids"])

    def wrapped(self, error):
        """Errors (..., n) of states, angles wrapped."""
        error[..., 2] = wrap(error[..., 2])
        return error

    def errors(self, inputs, x):
        """Estimate minus truth, (r, n)."""
        _, _, way, landmarks = truth(inputs, self.kind)
        return self.wrapped(x - np.concatenate([way[-1], *landmarks.values()]))

    def honest(self, part):
        """A law: the errors of a part of the state are consistent with P."""

        def holds(inputs, outputs):
            if not whole(inputs, outputs):
                return False
            x, P = self.of(inputs, outputs)
            error = self.errors(inputs, x)[:, part]
            # the runs' common mean costs one of them
            low, high = band(error.shape[1], len(x) - 1, HONEST)
            return low / SLACK <= nees(error, P[:, part, part]).mean() <= high * SLACK

        return holds

    def ratios(self, inputs, outputs):
        """Variances of the mean P along its principal directions, in units of least squares'."""
        P = self.of(inputs, outputs)[1]
        root = np.linalg.inv(np.linalg.cholesky(self.best(inputs)[1]))
        return np.linalg.eigvalsh(root @ P.mean(axis=0) @ root.T)

    @once
    def best(self, inputs):
        """Least squares over whole runs: estimates minus truth, and their covariance."""
        return least_squares(inputs, self.kind)

    def apart(self, inputs, outputs):
        """Mean squared normalised distance of x from least squares."""
        best, P = self.best(inputs)
        off = self.wrapped(self.errors(inputs, self.of(inputs, outputs)[0]) - best)
        return nees(off, P).mean() / off.shape[1]

    def sure(self, inputs, outputs):
        """A law: x is that of least squares, and the mean of P has its variances."""
        if not whole(inputs, outputs):
            return False
        ratios, (low, high) = self.ratios(inputs, outputs), self.sure_within
        near = abs(ratios.mean() - 1) <= self.mean and self.apart(inputs, outputs) <= self.most
        return near and low <= ratios.min() and ratios.max() <= high

    def ratios_told(self, inputs, outputs):
        if not whole(inputs, outputs):
            return "the map does not contain each measured landmark exactly once"
        ratios = self.ratios(inputs, outputs)
        if (apart := self.apart(inputs, outputs)) > self.most:
            return f"the rms difference of x from least squares is {apart**0.5:.2g} σ"
        return (
            f"in one direction of the state the variance by P is {ratios.min():.2g} times that of "
            f"least squares, in another {ratios.max():.2g} times, on average {ratios.mean():.3g}"
        )
