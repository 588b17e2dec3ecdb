"""Exercise 11, weigh: differences of log likelihoods are half those of squared distances."""

import numpy as np

from slamlab.exercises.drives.ex11 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.geometry import wrap
from slamlab.models.observation import g, h

SCANS, NEAR, BEHIND, FAR, MARKS = 6, 8, 6, 4, 5
SAMPLES = NEAR + BEHIND + FAR
IS_NEAR, IS_BEHIND = slice(0, NEAR), slice(NEAR, NEAR + BEHIND)
TOLERANCE = 1e-6  # of a log likelihood, absolute and as a share


def scans(rng):
    """Samples near a pose, some turned so that a landmark is right behind, some far off.

    Landmark 0 lies right behind: as it is seen its bearing is just on one side of ±π, and for the
    samples of ``IS_BEHIND`` just on the other.
    """
    parts = [_scan(rng) for _ in range(SCANS)]
    return {name: np.array([part[name] for part in parts]) for name in parts[0]}


def _scan(rng):
    x = np.array([*rng.uniform(-3, 3, 2), rng.uniform(-3, 3)])
    side = rng.choice([-1.0, 1.0])
    bearing = np.append(side * (np.pi - 0.25), rng.uniform(-2.2, 2.2, MARKS - 1))
    r = rng.uniform(2, 6, MARKS)
    z = np.column_stack([r, bearing])
    p = g(x, z)
    rows = np.tile(x, (SAMPLES, 1)) + rng.normal(0, [0.05, 0.05, 0.01], (SAMPLES, 3))
    # turned about the seam: the landmark behind is expected on its other side
    rows[IS_BEHIND, 2] = x[2] - side * rng.uniform(0.32, 0.4, BEHIND)
    rows[NEAR + BEHIND :, :2] += rng.choice([-1, 1], (FAR, 2)) * rng.uniform(2.5, 3.5, (FAR, 2))
    sigma = np.array([rng.uniform(0.06, 0.1), rng.uniform(0.05, 0.08)])
    R = np.diag(sigma**2)
    R[0, 1] = R[1, 0] = rng.choice([-1, 1]) * rng.uniform(0.3, 0.5) * sigma.prod()
    noise = rng.normal(0, 0.4, (MARKS, 2)) * sigma
    noise[0, 1] = 0
    return {"rows": rows, "p": p, "z": z + noise, "R": R}


def squared(i, change=lambda v: v, R=None, over=np.sum):
    """(k, n) squared Mahalanobis distances of the scan, summed over its landmarks.

    Parameters
    ----------
    i : inputs
    change : (k, n, m, 2) innovations, not wrapped -> the same, as a mistake makes them
    R : (k, 2, 2), or None for the right one
    over : what to do with a scan's distances
    """
    v = change(i["z"][:, None] - h(i["rows"][:, :, None], i["p"][:, None]))
    inverse = np.linalg.inv(i["R"] if R is None else R)
    return over(np.einsum("knma,kab,knmb->knm", v, inverse, v), axis=-1)


def wrapped(v):
    """Innovations with their bearings wrapped."""
    return np.stack([v[..., 0], wrap(v[..., 1])], axis=-1)


def _same(o, want, rows=np.s_[:]):
    """Whether logarithms are these but for a constant; the first sample of each scan is near."""
    got, want = (a - a[:, :1] for a in (o["logs"], want))
    close = np.abs(got - want) <= TOLERANCE * (1 + np.abs(want))
    return (close & (o["finite"] > 0))[:, rows]


def _law(rows):
    return lambda i, o: _same(o, -0.5 * squared(i, wrapped), rows).all(axis=1)


def _told_apart(i, o):
    """Far samples have finite logarithms, and not all the same."""
    far = slice(NEAR + BEHIND, None)
    logs = o["logs"][:, far]
    return (o["finite"][:, far] > 0).all(axis=1) & (np.ptp(logs, axis=1) > 1)


# ---- mistakes -------------------------------------------------------------------------------


def _is(name, hint, *wrong, rows=np.s_[:]):
    return Diagnosis(name, hint, lambda i, o: any(_same(o, w(i), rows).all() for w in wrong))


def _other(change=wrapped, R=None, factor=-0.5, over=np.sum):
    return lambda i: factor * squared(i, change, None if R is None else R(i["R"]), over)


def _degrees(v):
    return wrapped(v) * [1, 180 / np.pi]


def _is_likelihood(i, o):
    """No logarithm: the density itself, as product or as sum, up to a factor."""
    near = slice(0, NEAR)
    right = -0.5 * squared(i, wrapped)[:, near]
    with np.errstate(divide="ignore"):
        logs = np.log(o["logs"][:, near])
    return np.abs((logs - logs[:, :1]) - (right - right[:, :1])).max() < 1e-6


def _summed_likelihoods(i, o):
    """The logarithm of a sum of densities over landmarks, instead of the sum of logarithms."""
    each = squared(i, wrapped, over=lambda d, axis: d)
    return _same(o, np.log(np.exp(-0.5 * each).sum(axis=-1)))[:, :NEAR].all()


WEIGH = Task(
    id="11-weigh",
    title="Weigh: logarithms of likelihoods",
    drive=DRIVES["11-weigh"],
    inputs=scans,
    shapes={"logs": (SCANS, SAMPLES), "finite": (SCANS, SAMPLES)},
    laws=(
        Law("near", 2, "samples differ by half the difference of vᵀ R⁻¹ v, summed", _law(IS_NEAR)),
        Law("behind", 1, "so they do where a landmark is right behind", _law(IS_BEHIND)),
        Law("far", 1, "samples far off have finite logarithms that tell them apart", _told_apart),
    ),
    diagnoses=(
        Diagnosis(
            "underflow",
            "Far samples have the logarithm −∞: the likelihood was computed first and was zero "
            "(e⁻⁷⁴⁶ is). Add up logarithms: −v R⁻¹ v / 2 needs no exponential at all.",
            lambda i, o: (o["finite"] == 0).any() and _law(IS_NEAR)(i, o).all(),
        ),
        Diagnosis(
            "no-logarithm",
            "These are likelihoods, not their logarithms. Far samples get zero, whatever else they "
            "are: leave the exponential out.",
            _is_likelihood,
        ),
        _is(
            "unwrapped",
            "The innovation's bearing leaves (−π, π]: a landmark right behind, expected at 179° "
            "and seen at −179°, is 2° off, not 358°. Wrap z − h, not z and h one by one.",
            _other(lambda v: v),
            rows=IS_BEHIND,
        ),
        _is(
            "from-zero",
            "% (2π) brings the innovation's bearing into [0, 2π): what is a little to the right "
            "becomes almost a full turn. It belongs in (−π, π]: wrap.",
            _other(lambda v: np.stack([v[..., 0], v[..., 1] % (2 * np.pi)], axis=-1)),
        ),
        _is(
            "sign",
            "The logarithm grows with the distance: the farther off, the likelier. It is "
            "−v R⁻¹ v / 2.",
            _other(factor=0.5),
            _other(factor=1.0),
        ),
        _is(
            "half-forgotten",
            "The factor ½ is missing: the logarithm of a Gaussian is −v R⁻¹ v / 2. Without it the "
            "sensor is believed to have half its variance.",
            _other(factor=-1.0),
        ),
        _is(
            "R-not-inverted",
            "R stands where R⁻¹ belongs: a good sensor would count for little.",
            _other(R=np.linalg.inv),
        ),
        _is(
            "standard-deviation",
            "R holds variances and is divided by as it is: look where you take a root or a square "
            "of it.",
            _other(R=lambda R: R @ R),
            _other(R=lambda R: np.sqrt(R * np.eye(2))),
            _other(R=lambda R: (R * np.eye(2)) ** 2),
        ),
        _is(
            "correlation-forgotten",
            "Only the diagonal of R counts in yours. Range and bearing may err together: use "
            "R⁻¹ as a matrix.",
            _other(R=lambda R: R * np.eye(2)),
        ),
        _is(
            "degrees",
            "The innovation's bearing is in degrees, while R counts in radians.",
            _other(_degrees),
        ),
        _is(
            "one-of-two",
            "Only the range or only the bearing counts. A sighting is both: v has two entries.",
            _other(lambda v: wrapped(v) * [1, 0], lambda R: R * np.eye(2)),
            _other(lambda v: wrapped(v) * [0, 1], lambda R: R * np.eye(2)),
        ),
        Diagnosis(
            "all-alike",
            "All samples get the same: what each expects to see, h of its own pose, is missing.",
            lambda i, o: (np.ptp(o["logs"], axis=1) == 0).all(),
        ),
        _is(
            "mean-over-landmarks",
            "You take the mean over the landmarks: then ten sightings tell no more than one. "
            "Sightings err independently: their logarithms add up.",
            _other(over=np.mean),
        ),
        _is(
            "one-landmark",
            "Only one landmark counts: do you return, or start anew, inside the loop?",
            _other(over=lambda d, axis: d[..., 0]),
            _other(over=lambda d, axis: d[..., -1]),
        ),
        _is(
            "largest-only",
            "Only the worst or the best sighting counts. All of them do: add up.",
            _other(over=np.max),
            _other(over=np.min),
        ),
        Diagnosis(
            "likelihoods-summed",
            "You add up likelihoods over the landmarks. Independent sightings multiply; their "
            "logarithms add up.",
            _summed_likelihoods,
        ),
    ),
)
