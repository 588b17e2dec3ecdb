"""Task 11-proposal: weights p/q of particles not drawn from the motion model."""

import numpy as np

from classroom.exercises.correctness_laws import equals
from classroom.exercises.task import Probe, Task
from course.exercises.ex11_particle_filters.calls import CALLS
from slamlab.geometry import wrap

COUNT, SAMPLES = 6, 8


def looks(rng, count=COUNT, samples=SAMPLES, backwards=False, far=0.0, alike=False):
    """Particles, each moved by a u of its own mean and covariance.
    far : of u from the means [σ]; alike : one covariance for all.
    """
    before = rng.uniform(-3, 3, (count, samples, 3))
    turn = rng.choice([-1, 1], count) * rng.uniform(0.3, 0.8, count)
    u = np.column_stack([(-1) ** backwards * rng.uniform(0.5, 1.5, count), turn])
    C = _covariances(rng, (count,), 0.1, 0.14)
    D = _covariances(rng, (count, 1 if alike else samples), 0.05, 0.12)
    D = np.tile(D, (1, samples, 1, 1)) if alike else D
    calm = 0.02 if far else 1.0  # far: all alike, or one particle would have all the weight
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
    i = looks(rng, 4)
    theta = np.where(i["u"][:, 1:] > 0, 3.0, -3.0) + rng.uniform(-0.1, 0.1, (4, SAMPLES))
    drives = _drives(i)
    i["before"][..., 2] = theta
    return i | {"after": _driven(i["before"], drives)}


def _along_y(rng):
    i = looks(rng, 4)
    drives, up = _drives(i), np.where(np.arange(SAMPLES) % 2, 1, -1) * np.pi / 2
    i["before"][..., 2] = up
    return i | {"after": _driven(i["before"], drives)}


def _as_the_wheels(rng):
    i = looks(rng, 4)
    C = np.repeat(i["C"][:, None], SAMPLES, axis=1)
    return i | {"m": np.repeat(i["u"][:, None], SAMPLES, axis=1), "D": C}


def _at_rest(rng):
    i = looks(rng, 3)
    return i | {"after": i["before"].copy(), "u": 0 * i["u"], "m": i["m"] - i["u"][:, None]}


def _law(name, points, says, asks, main=False, after=()):
    def step(i):
        less = "log density of the motion model minus that of the proposal"
        return {"d and Δθ of each particle": _drives(i), less: _logs(i)}

    more = {"asks": asks, "step": step, "main": main, "after": after}
    return equals(name, points, says, _wanted, tolerance=1e-6, **more)


ALL = ("weights",)


def _promised(i):
    """Particles move along their headings; weights are positive and sum to one."""
    went = np.abs(_driven(i["before"], _drives(i)) - i["after"])[..., :2].max(axis=(1, 2)) < 1e-9
    return went & (i["weights"] > 0).all(axis=1) & (np.abs(i["weights"].sum(axis=1) - 1) < 1e-9)


PROPOSAL = Task(
    id="11-proposal",
    title="Importance weights for another proposal",
    call=CALLS["11-proposal"],
    inputs=looks,
    shapes=lambda i: {"result": i["weights"].shape[1:]},
    laws=(
        _law(
            "alike",
            1.5,
            "the weights are right if all proposals have the same covariance",
            "Which two densities does the importance weight need? At which d and Δθ do you "
            "compute them, and with which entries of C and D?",
        ),
        _law(
            "weights",
            2,
            "the weights are right if each proposal has its own covariance",
            "How does the maximum of a Gaussian density depend on its covariance?",
            main=True,
            after=("alike",),
        ),
        _law(
            "far",
            1,
            "the weights are right if densities are too small for a float",
            "Do you need a density itself, or only its logarithm? Which number may you subtract "
            "from all logarithms without changing a weight?",
            after=("weights",),
        ),
    ),
    probes=(
        Probe("one covariance for all proposals", lambda r: looks(r, 4, alike=True), ("alike",)),
        Probe("particles hundreds of σ from a mean", lambda r: looks(r, 4, far=50.0), ("far",)),
        Probe("headings that cross ±π", _at_the_seam, ALL),
        Probe("headings along y", _along_y, ALL),
        Probe("motions backwards", lambda r: looks(r, 3, backwards=True), ALL),
        Probe("proposals equal to the motion model", _as_the_wheels, ALL),
        Probe("particles that do not move", _at_rest, ALL),
        Probe("one particle", lambda r: looks(r, 2, 1), ALL),
        Probe("two particles", lambda r: looks(r, 3, 2), ALL),
        Probe("many particles", lambda r: looks(r, 2, 60), ALL),
    ),
    may_round=_promised,
    begins=(
        "From which density was the motion of each particle sampled, and from which "
        "density should it come?",
        "Which d and Δθ lead from the pose before to the pose after?",
    ),
)
