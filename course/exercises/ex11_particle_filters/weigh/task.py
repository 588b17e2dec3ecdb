"""Task 11-weigh: log likelihoods differ by half the squared distances."""

import numpy as np

from classroom.exercises.correctness_laws import Law
from classroom.exercises.references import Reference
from classroom.exercises.task import Probe, Task
from course.exercises.ex11_particle_filters.calls import CALLS
from slamlab.geometry import wrap
from slamlab.models.observation import g, h

SCANS, NEAR, MARKS = 6, 8, 5
TOLERANCE = 1e-6  # of a log likelihood, absolute and as a share: a solve errs by 1e-12


def scans(rng, count=SCANS, samples=NEAR, marks=MARKS, far=(2, 6)):
    """Particles near a pose; range and bearing errors are correlated."""
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
    x = np.column_stack([rng.uniform(-3, 3, (4, 2)), [3.1, -3.1, 0.2, 1.0]])
    side = np.array([1, -1, 1, -1])
    bearing = np.column_stack([side * (np.pi - 0.2), rng.uniform(-2.2, 2.2, (4, 2))])
    i = _seen(rng, x, np.stack([rng.uniform(2, 6, (4, 3)), bearing], axis=-1), 6)
    i["rows"][:, 1:, 2] -= side[:, None] * rng.uniform(0.25, 0.45, (4, 5))
    i["rows"][..., 2] = wrap(i["rows"][..., 2])
    return i


def _far(rng):
    i = scans(rng, 4, 7, 6)
    i["rows"][:, 1:, :2] += rng.choice([-1, 1], (4, 6, 2)) * rng.uniform(2.5, 6, (4, 6, 2))
    return i


def _turned(rng):
    i = scans(rng, 3, 12, 3)
    i["rows"][..., 2] = rng.uniform(-np.pi, np.pi, (3, 12))
    return i


def _whole(rng):
    i = {name: np.rint(array) for name, array in scans(rng, 4, 5, 4, (8, 20)).items()}
    i["rows"][..., :2] += rng.integers(-1, 2, (4, 5, 2))  # no two particles at one position
    return {n: a.astype(int) for n, a in i.items()} | {"R": np.tile(np.diag([4, 1]), (4, 1, 1))}


def _right(i):
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
        return "Some log-likelihoods are infinite or NaN."
    got, want = (_differences(a) for a in (o["logs"], _right(i)))
    k, n = np.unravel_index(np.argmax(np.abs(got - want)), got.shape)
    return (
        f"The log-likelihood of particle {n} minus that of particle 0 (counted from 0) is "
        f"{got[k, n]:.5g} in your answer; {want[k, n]:.5g} is right."
    )


def _step(i):
    v = i["z"][:, 0] - h(i["rows"][:, 0], i["p"][:, 0])
    return {"v of particle 0 and landmark 0": np.column_stack([v[:, 0], wrap(v[:, 1])])}


def _law(name, points, says, asks, **more):
    return Law(name, points, says, _same, why=_why, asks=asks, step=_step, **more)


OTHERS = ("near",)


def _promised(i):
    """Ranges are positive, and no particle is at a landmark."""
    off = i["rows"][:, :, None, :2] - i["p"][:, None]
    away = np.linalg.norm(off, axis=-1).min(axis=(1, 2)) > 0.1
    return away & (i["z"][..., 0] > 0).all(axis=1)


WEIGH = Task(
    id="11-weigh",
    title="Log-likelihoods",
    call=CALLS["11-weigh"],
    inputs=scans,
    shapes=lambda i: dict.fromkeys(("logs", "finite"), i["rows"].shape[:2]),
    laws=(
        _law(
            "near",
            2,
            "log-likelihoods differ by −½ times the difference of Σ vᵀ R⁻¹ v over all landmarks",
            "What is v for one particle and one landmark? Over which index do you sum?",
        ),
        _law(
            "behind",
            1,
            "these differences are also right if a landmark is straight behind the robot",
            "The expected bearing is 179°, the measured bearing is −179°. How large is the "
            "innovation?",
            main=False,
            after=("near",),
        ),
        _law(
            "far",
            1,
            "these differences are also right for particles so far away that their likelihood is "
            "zero as a float",
            "What is the logarithm of e⁻¹⁰⁰⁰? What is np.log(np.exp(-1000)) as a float?",
            main=False,
            after=("near",),
        ),
    ),
    probes=(
        Probe("a landmark right behind the robot", _behind, ("behind",)),
        Probe("particles far away", _far, ("far",)),
        Probe("particles with all headings", _turned, OTHERS),
        Probe("one landmark", lambda rng: scans(rng, 3, 4, 1), OTHERS),
        Probe("two particles and many landmarks", lambda rng: scans(rng, 3, 2, 40), OTHERS),
        Probe("one particle", lambda rng: scans(rng, 2, 1, 2), OTHERS),
        Probe("as many particles as landmarks", lambda rng: scans(rng, 3, 5, 5, (20, 90)), OTHERS),
        Probe("integers", _whole, OTHERS),
    ),
    parts=lambda i, o: {"logs": _differences(o["logs"]), "finite": o["finite"]},
    may_round=_promised,
    references=(Reference("log_likelihoods", "rows p z R", lambda i: {"result": _right(i)}),),
    begins=(
        "One particle and one landmark: which measurement do you expect?",
        "By how much does the log-likelihood decrease if the range error is one σ, "
        "and by how much if it is two σ?",
    ),
)
