"""Task 11-weigh: differences of log likelihoods are half those of squared distances."""

import numpy as np

from slamlab.exercises.drives.ex11 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Probe, Task
from slamlab.geometry import wrap
from slamlab.models.observation import g, h

SCANS, NEAR, MARKS = 6, 8, 5
TOLERANCE = 1e-6  # of a log likelihood, absolute and as a share: a solve errs by 1e-12


def scans(rng, count=SCANS, samples=NEAR, marks=MARKS, far=(2, 6)):
    """Samples near a pose that sees landmarks; the errors of range and bearing are correlated."""
    x = np.column_stack([rng.uniform(-3, 3, (count, 2)), rng.uniform(-3, 3, count)])
    bearing = rng.uniform(-2.2, 2.2, (count, marks))
    return _seen(rng, x, np.stack([rng.uniform(*far, (count, marks)), bearing], axis=-1), samples)


def _seen(rng, x, z, samples):
    count, marks = z.shape[:2]
    rows = x[:, None] + rng.normal(0, [0.05, 0.05, 0.01], (count, samples, 3))
    sigma = np.column_stack([rng.uniform(0.06, 0.1, count), rng.uniform(0.05, 0.08, count)])
    rho = rng.choice([-1, 1], count) * rng.uniform(0.3, 0.5, count)
    R = sigma[:, :, None] * sigma[:, None, :]
    R[:, [0, 1], [1, 0]] *= rho[:, None]
    p, noise = g(x[:, None], z), rng.normal(0, 0.4, (count, marks, 2)) * sigma[:, None]
    z = z + noise
    return {"rows": rows, "p": p, "z": np.stack([z[..., 0], wrap(z[..., 1])], axis=-1), "R": R}


def _behind(rng):
    """Landmark 0 is seen a little on one side of ±π, and expected on both sides of it."""
    x = np.column_stack([rng.uniform(-3, 3, (4, 2)), [3.1, -3.1, 0.2, 1.0]])
    side = np.array([1, -1, 1, -1])
    bearing = np.column_stack([side * (np.pi - 0.2), rng.uniform(-2.2, 2.2, (4, 2))])
    i = _seen(rng, x, np.stack([rng.uniform(2, 6, (4, 3)), bearing], axis=-1), 6)
    i["rows"][:, 1:, 2] -= side[:, None] * rng.uniform(0.25, 0.45, (4, 5))
    i["rows"][..., 2] = wrap(i["rows"][..., 2])
    return i


def _far(rng):
    """Most samples are metres off, and as sure of it as e⁻¹⁰⁰⁰."""
    i = scans(rng, 4, 7, 6)
    i["rows"][:, 1:, :2] += rng.choice([-1, 1], (4, 6, 2)) * rng.uniform(2.5, 6, (4, 6, 2))
    return i


def _turned(rng):
    """Samples with all headings."""
    i = scans(rng, 3, 12, 3)
    i["rows"][..., 2] = rng.uniform(-np.pi, np.pi, (3, 12))
    return i


def _whole(rng):
    i = {name: np.rint(array) for name, array in scans(rng, 4, 5, 4, (8, 20)).items()}
    i["rows"][..., :2] += rng.integers(-1, 2, (4, 5, 2))  # no two samples on one place
    return {n: a.astype(int) for n, a in i.items()} | {"R": np.tile(np.diag([4, 1]), (4, 1, 1))}


def _right(i):
    """(k, n) the right logarithms, but for a constant."""
    v = i["z"][:, None] - h(i["rows"][:, :, None], i["p"][:, None])
    v[..., 1] = wrap(v[..., 1])
    return -0.5 * np.einsum("knma,kab,knmb->kn", v, np.linalg.inv(i["R"]), v)


def _differences(logs):
    return logs - logs[:, :1]


def _same(i, o):
    got, want = _differences(o["logs"]), _differences(_right(i))
    close = np.abs(got - want) <= TOLERANCE * (1 + np.abs(want))
    return (close & (o["finite"] > 0)).all(axis=1)


def _why(i, o):
    if (o["finite"] <= 0).any():
        return "Some of them are infinite or no numbers."
    got, want = (_differences(a) for a in (o["logs"], _right(i)))
    k, n = np.unravel_index(np.argmax(np.abs(got - want)), got.shape)
    return (
        f"The logarithm of sample {n} less that of sample 0 (they are counted from 0) is "
        f"{got[k, n]:.5g} in your answer, and {want[k, n]:.5g} is right."
    )


def _step(i):
    v = i["z"][:, 0] - h(i["rows"][:, 0], i["p"][:, 0])
    return {"v of sample 0 and landmark 0": np.column_stack([v[:, 0], wrap(v[:, 1])])}


def _law(name, points, says, asks, **more):
    return Law(name, points, says, _same, why=_why, asks=asks, step=_step, **more)


OTHERS = ("near",)


def _promised(i):
    """(k,) whether ranges are positive, and no sample is at a landmark."""
    off = i["rows"][:, :, None, :2] - i["p"][:, None]
    away = np.linalg.norm(off, axis=-1).min(axis=(1, 2)) > 0.1
    return away & (i["z"][..., 0] > 0).all(axis=1)


WEIGH = Task(
    id="11-weigh",
    title="Weigh: logarithms of likelihoods",
    drive=DRIVES["11-weigh"],
    inputs=scans,
    shapes=lambda i: dict.fromkeys(("logs", "finite"), i["rows"].shape[:2]),
    laws=(
        _law(
            "near",
            2,
            "samples differ by half the difference of vᵀ R⁻¹ v, summed over the landmarks",
            "What is v for one sample and one landmark? How many numbers are summed up?",
        ),
        _law(
            "behind",
            1,
            "so they do where a landmark is right behind",
            "A landmark is expected at 179° and seen at −179°. By how much was the sample wrong?",
            main=False,
            after=("near",),
        ),
        _law(
            "far",
            1,
            "so they do where samples are so far off that their likelihood is zero to a float",
            "What is the logarithm of e⁻¹⁰⁰⁰? And what does NumPy make of np.log(np.exp(-1000))?",
            main=False,
            after=("near",),
        ),
    ),
    probes=(
        Probe("a landmark right behind", _behind, ("behind",)),
        Probe("samples far off", _far, ("far",)),
        Probe("samples that look in all directions", _turned, OTHERS),
        Probe("one landmark", lambda rng: scans(rng, 3, 4, 1), OTHERS),
        Probe("two samples and many landmarks", lambda rng: scans(rng, 3, 2, 40), OTHERS),
        Probe("one sample", lambda rng: scans(rng, 2, 1, 2), OTHERS),
        Probe("as many samples as landmarks", lambda rng: scans(rng, 3, 5, 5, (20, 90)), OTHERS),
        Probe("whole numbers", _whole, OTHERS),
    ),
    parts=lambda i, o: {"logs": _differences(o["logs"]), "finite": o["finite"]},
    rounds=_promised,
)
