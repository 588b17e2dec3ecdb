"""Task 11-proposal: weights p/q of samples that were drawn otherwise than the wheels err."""

import numpy as np

from slamlab.exercises.drives.ex11 import DRIVES
from slamlab.exercises.law import equals
from slamlab.exercises.task import Probe, Task
from slamlab.geometry import wrap

COUNT, SAMPLES = 6, 8


def looks(rng, count=COUNT, samples=SAMPLES, backwards=False, far=0.0, alike=False):
    """Samples, each driven by a drive that was drawn with a mean and covariance of its own.

    Parameters
    ----------
    rng : numpy.random.Generator
    count, samples : int
    backwards : bool
    far : float, how many deviations of the wheels' distance lie between u and the means
    alike : bool, whether all samples have one covariance
    """
    before = rng.uniform(-3, 3, (count, samples, 3))
    turn = rng.choice([-1, 1], count) * rng.uniform(0.3, 0.8, count)
    u = np.column_stack([(-1) ** backwards * rng.uniform(0.5, 1.5, count), turn])
    C = _covariances(rng, (count,), 0.1, 0.14)
    D = _covariances(rng, (count, 1 if alike else samples), 0.05, 0.12)
    D = np.tile(D, (1, samples, 1, 1)) if alike else D
    calm = 0.02 if far else 1.0  # far off all alike: else one sample would have all the weight
    off = calm * rng.normal(0, 0.7, (count, samples, 2))
    m = u[:, None] + np.einsum("kab,knb->kna", np.linalg.cholesky(C), off) + [0.1 * far, 0]
    drive = m + np.einsum(
        "knab,knb->kna", np.linalg.cholesky(D), calm * rng.normal(0, 0.8, m.shape)
    )
    weights = rng.uniform(0.2, 1, (count, samples))
    return {
        "before": before,
        "after": _driven(before, drive),
        "weights": weights / weights.sum(axis=1, keepdims=True),
        "u": u,
        "C": C,
        "m": m,
        "D": D,
    }


def _covariances(rng, shape, low, high):
    sigma = rng.uniform(low, high, (*shape, 2))
    C = sigma[..., :, None] * sigma[..., None, :]
    rho = rng.choice([-1, 1], shape) * rng.uniform(0.3, 0.6, shape)
    C[..., [0, 1], [1, 0]] *= rho[..., None]
    return C


def _driven(rows, drive):
    (x, y, theta), (d, turn) = np.moveaxis(rows, -1, 0), np.moveaxis(drive, -1, 0)
    return np.stack([x + d * np.cos(theta), y + d * np.sin(theta), wrap(theta + turn)], axis=-1)


def _drives(i):
    """(k, n, 2) what each sample has driven."""
    step, theta = i["after"] - i["before"], i["before"][..., 2]
    d = step[..., 0] * np.cos(theta) + step[..., 1] * np.sin(theta)
    return np.stack([d, wrap(step[..., 2])], axis=-1)


def _log_density(off, covariance):
    squares = np.sum(off * np.linalg.solve(covariance, off[..., None])[..., 0], axis=-1)
    return -0.5 * (squares + np.log(np.linalg.det(covariance)))


def _logs(i):
    off_u, off_m = _drives(i) - i["u"][:, None], _drives(i) - i["m"]
    wheels = np.broadcast_to(i["C"][:, None], i["D"].shape)
    return _log_density(off_u, wheels) - _log_density(off_m, i["D"])


def _wanted(i):
    logs = np.log(i["weights"]) + _logs(i)
    weights = np.exp(logs - logs.max(axis=1, keepdims=True))
    return {"result": weights / weights.sum(axis=1, keepdims=True)}


def _at_the_seam(rng):
    """Turns that take headings across ±π, in both directions."""
    i = looks(rng, 4)
    theta = np.where(i["u"][:, 1:] > 0, 3.0, -3.0) + rng.uniform(-0.1, 0.1, (4, SAMPLES))
    drives = _drives(i)
    i["before"][..., 2] = theta
    return i | {"after": _driven(i["before"], drives)}


def _along_y(rng):
    """Robots that head along y: nothing of their way is in x."""
    i = looks(rng, 4)
    drives, up = _drives(i), np.where(np.arange(SAMPLES) % 2, 1, -1) * np.pi / 2
    i["before"][..., 2] = up
    return i | {"after": _driven(i["before"], drives)}


def _as_the_wheels(rng):
    """Drawn as the wheels err: the weights stay as they are."""
    i = looks(rng, 4)
    C = np.repeat(i["C"][:, None], SAMPLES, axis=1)
    return i | {"m": np.repeat(i["u"][:, None], SAMPLES, axis=1), "D": C}


def _at_rest(rng):
    i = looks(rng, 3)
    return i | {"after": i["before"].copy(), "u": 0 * i["u"], "m": i["m"] - i["u"][:, None]}


def _law(name, points, says, asks, main=False, after=()):
    def step(i):
        less = "log density of the wheels less that of the drawing"
        return {"d and Δθ of each sample": _drives(i), less: _logs(i)}

    more = {"asks": asks, "step": step, "main": main, "after": after}
    return equals(name, points, says, _wanted, tolerance=1e-6, **more)


ALL = ("weights",)


def _promised(i):
    """(k,) whether samples go where they look, and positive weights sum to one."""
    went = np.abs(_driven(i["before"], _drives(i)) - i["after"])[..., :2].max(axis=(1, 2)) < 1e-9
    return went & (i["weights"] > 0).all(axis=1) & (np.abs(i["weights"].sum(axis=1) - 1) < 1e-9)


PROPOSAL = Task(
    id="11-proposal",
    title="Samples from another drawing",
    drive=DRIVES["11-proposal"],
    inputs=looks,
    shapes=lambda i: {"result": i["weights"].shape[1:]},
    laws=(
        _law(
            "alike",
            1.5,
            "weights are right where all samples were drawn with one covariance",
            "Which two densities does a sample's weight need? At which drive are both to be taken?",
        ),
        _law(
            "weights",
            2,
            "so they are where each sample has a covariance of its own",
            "How high is the hill of a wide Gaussian, and how high that of a narrow one?",
            main=True,
            after=("alike",),
        ),
        _law(
            "far",
            1,
            "so they are where densities are too small for a float",
            "Is p itself ever needed? Which number may be taken off all logarithms without "
            "changing a weight?",
            after=("weights",),
        ),
    ),
    probes=(
        Probe("one covariance for all", lambda r: looks(r, 4, alike=True), ("alike",)),
        Probe("samples that are hundreds of σ off", lambda r: looks(r, 4, far=50.0), ("far",)),
        Probe("headings that cross ±π", _at_the_seam, ALL),
        Probe("headings along y", _along_y, ALL),
        Probe("robots that drive backwards", lambda r: looks(r, 3, backwards=True), ALL),
        Probe("samples drawn as the wheels err", _as_the_wheels, ALL),
        Probe("samples that stay where they are", _at_rest, ALL),
        Probe("one sample", lambda r: looks(r, 2, 1), ALL),
        Probe("two samples", lambda r: looks(r, 3, 2), ALL),
        Probe("many samples", lambda r: looks(r, 2, 60), ALL),
    ),
    rounds=_promised,
)
