"""Task 11-fastslam: one step of FastSLAM with one landmark, without resampling."""

import numpy as np

from classroom.exercises.correctness_laws import Diagnosis, Law, equals, once
from classroom.exercises.task import Probe, Task
from course.exercises.ex11_particle_filters.calls import CALLS
from slamlab.geometry import wrap
from slamlab.models.jacobians import H_landmark
from slamlab.models.observation import g, h

SURE = 1e-9  # standard deviation of nearly exact odometry [m] and [rad]
NOISY, FAR_OFF = "noisy odometry", "particles whose likelihoods are zero as floats"
TOLERANCE = 1e-5


def steps(rng, count=5, samples=6, bearing=2.2, sigma=(0.1, 0.6), blunt=1.0, far=(2, 6)):
    """Particles with a landmark each, nearly exact odometry, and a measurement of the landmark.
    bearing : largest magnitude [rad]; sigma : of the landmarks [m]; blunt : factor of R's σ.
    """
    x = np.column_stack([rng.uniform(-3, 3, (count, 2)), rng.uniform(-np.pi, np.pi, count)])
    rows = x[:, None] + rng.normal(0, [0.3, 0.3, 0.1], (count, samples, 3))
    rows[..., 2] = wrap(rows[..., 2])
    weights = rng.uniform(0.2, 1, (count, samples))
    u = np.column_stack([rng.uniform(0.2, 1, count), rng.uniform(-0.6, 0.6, count)])
    R = blunt**2 * _covariances(rng, (count,), (0.08, 0.2))
    P = _covariances(rng, (count, samples), sigma)
    z = np.column_stack([rng.uniform(*far, count), rng.uniform(-bearing, bearing, count)])
    noise = 0.5 * rng.standard_normal((2, count, samples, 2))
    seen = z[:, None] + _scaled(R[:, None], noise[0])
    found = {"rows": rows, "weights": weights / weights.sum(axis=1, keepdims=True)}
    found["p"] = g(moved(found | {"u": u}), seen) + _scaled(P, noise[1])
    C = np.tile(SURE**2 * np.eye(2), (count, 1, 1))
    seeds = rng.integers(1, 2**31, count).astype(float)
    return found | {"P": P, "u": u, "C": C, "z": z, "R": R, "seed": seeds}


def _covariances(rng, shape, sigma):
    sigma = rng.uniform(*sigma, (*shape, 2))
    C = sigma[..., :, None] * sigma[..., None, :]
    C[..., [0, 1], [1, 0]] *= (rng.choice([-1, 1], shape) * rng.uniform(0.3, 0.6, shape))[..., None]
    return C


def _scaled(covariance, white):
    return (np.linalg.cholesky(covariance) @ white[..., None])[..., 0]


def _behind(rng):
    i = steps(rng, 4, 5, far=(3, 5))
    side = np.array([1, -1, 1, -1])
    off = np.stack([np.zeros((4, 5)), side[:, None] * rng.uniform(0.05, 0.3, (4, 5))], axis=-1)
    i["z"][:, 1] = side * (np.pi - 0.02)
    i["p"] = g(moved(i), i["z"][:, None] + off)  # bearings beyond ±π
    return i


def _noisy(rng):
    i = steps(rng, 3, 500, blunt=2.0)
    return i | {"C": _covariances(rng, (3,), (0.05, 0.1))}


def _far(rng):
    i = steps(rng, 3, 5, far=(4, 6))
    i["rows"] = i["rows"][:, :1] + 1e-3 * rng.standard_normal((3, 5, 3))
    i["P"] = np.tile(0.05**2 * np.eye(2), (3, 5, 1, 1))
    i["R"] = np.tile(0.05**2 * np.eye(2), (3, 1, 1))
    i["p"] = g(moved(i), i["z"][:, None] + [4, 0]) + 1e-3 * rng.standard_normal((3, 5, 2))
    return i


def moved(i):
    """Rows (k, n, 3) after the motion u without noise."""
    (d, turn), (x, y, theta) = i["u"].T[..., None], np.moveaxis(i["rows"], -1, 0)
    return np.stack([x + d * np.cos(theta), y + d * np.sin(theta), wrap(theta + turn)], axis=-1)


def _innovations(i, rows):
    """v (k, n, 2), S (k, n, 2, 2) and K (k, n, 2, 2) at the poses rows."""
    H, P, v = H_landmark(rows, i["p"]), i["P"], i["z"][:, None] - h(rows, i["p"])
    v[..., 1] = wrap(v[..., 1])
    S = H @ P @ np.swapaxes(H, -1, -2) + i["R"][:, None]
    return v, S, P @ np.swapaxes(H, -1, -2) @ np.linalg.inv(S)


def _updated(i, rows):
    """Weights, p and P that belong to the poses rows."""
    v, S, K = _innovations(i, rows)
    squares = np.einsum("kna,knab,knb->kn", v, np.linalg.inv(S), v)
    logs = np.log(i["weights"]) - (squares + np.log(np.linalg.det(S))) / 2
    weights = np.exp(logs - logs.max(axis=1, keepdims=True))
    return {
        "weights": weights / weights.sum(axis=1, keepdims=True),
        "p": i["p"] + (K @ v[..., None])[..., 0],
        "P": i["P"] - K @ S @ np.swapaxes(K, -1, -2),
    }


@once
def want(i):
    rows = moved(i)
    return {"rows": rows} | _updated(i, rows)


def _law(name, points, says, outputs, asks, **more):
    def right(i):
        return {output: want(i)[output] for output in outputs}

    return equals(name, points, says, right, asks=asks, step=_step, **more)


def _noise(i, o):
    """Noise of [d, Δθ] (k, n, 2) that moved each particle, and its way across its heading."""
    way, theta = o["rows"] - i["rows"], i["rows"][..., 2]
    c, s = np.cos(theta), np.sin(theta)
    d, across = c * way[..., 0] + s * way[..., 1], c * way[..., 1] - s * way[..., 0]
    return np.stack([d, wrap(way[..., 2])], axis=-1) - i["u"][:, None], np.abs(across)


@once
def _sampled(i, o):
    """The mean and the covariance of the whitened noise of all particles, less 0 and I, divided by
    their standard deviations; the largest way across a heading; the error of weights, p or P,
    whichever is the least: a mistake in one of them is judged by another law.
    """
    noise, across = _noise(i, o)
    white = np.linalg.solve(np.linalg.cholesky(i["C"])[:, None], noise[..., None])[..., 0]
    white = white.reshape(-1, 2)
    mean, spread = white.mean(axis=0), white.T @ white / len(white) - np.eye(2)
    chance = np.array([*mean, spread[0, 1], *np.diag(spread) / np.sqrt(2)]) * np.sqrt(len(white))
    right = _updated(i, o["rows"])
    off = min(np.abs(o[name] - right[name]).max() / np.abs(right[name]).max() for name in right)
    return np.abs(chance).max(), across.max(), off


def _samples(i, o):
    chance, across, off = _sampled(i, o)
    return chance < 6 and across < TOLERANCE and off < TOLERANCE


def _why_samples(i, o):
    chance, across, off = _sampled(i, o)
    if chance < 6 and across < TOLERANCE:
        return f"Weights, p and P do not belong to the returned poses: relative errors ≥ {off:.2g}."
    mean, sigma = (f(_noise(i, o)[0].reshape(-1, 2), axis=0) for f in (np.mean, np.std))
    return (
        f"The errors of d and Δθ of all particles have the means {mean[0]:.3g}, {mean[1]:.3g} and "
        f"the standard deviations {sigma[0]:.3g}, {sigma[1]:.3g}; {across:.2g} m are across."
    )


def _step(i):
    v, S, _ = _innovations(i, moved(i))
    return {"rows after the motion": moved(i), "innovation of each particle": v, "its S": S}


def _promised(i):
    """Positive weights that sum to one; no landmark at a particle."""
    away = np.linalg.norm(i["p"] - moved(i)[..., :2], axis=-1).min(axis=1) > 0.2
    sums = np.abs(i["weights"].sum(axis=1) - 1) < 1e-9
    return away & sums & (i["weights"] > 0).all(axis=1) & (i["z"][:, 0] > 0)


ALL = ("moved", "map", "weights")

FASTSLAM = Task(
    id="11-fastslam",
    title="One step of FastSLAM",
    call=CALLS["11-fastslam"],
    inputs=steps,
    shapes=lambda i: {name: i[name].shape for name in ("rows", "weights", "p", "P")},
    laws=(
        _law(
            "moved",
            0.5,
            "if odometry is nearly exact, each pose moves by u along its own heading",
            ["rows"],
            "Which function of this exercise samples the motion model?",
            angles={"rows": 2},
            alone=False,
        ),
        _law(
            "map",
            1,
            "p and P of each particle are those of an EKF of its landmark, given its pose",
            ["p", "P"],
            "Given the pose of a particle, what is uncertain in the expected measurement? "
            "By which derivative does it get there?",
        ),
        _law(
            "weights",
            1,
            "each weight is multiplied by the likelihood of z under the particle's pose and map",
            ["weights"],
            "Which errors does the innovation of one particle contain? How large is the density of "
            "this innovation at its maximum?",
        ),
        _law(
            "far",
            0.5,
            "the weights are also right if all likelihoods are zero as floats",
            ["weights"],
            "Do you need the likelihood itself, or only its logarithm?",
            main=False,
            after=("weights",),
        ),
        Law(
            "sampled",
            1,
            "if odometry is noisy, the poses are samples of the motion model, and the map or the "
            "weights belong to these poses",
            _samples,
            why=_why_samples,
            asks="Do two particles with equal poses move equally? At which pose of a particle "
            "do you compute its expected measurement?",
            step="Compare the poses that you return with those at which you compute h. Then print "
            "S for a particle: its pose is given, so which covariances does S contain?",
            main=False,
            after=ALL,
        ),
    ),
    diagnoses=(
        Diagnosis(
            "no-own-noise",
            "All particles move by the same d and Δθ. Each particle has its own sample of the "
            "odometry noise.",
            lambda i, o: np.ptp(_noise(i, o)[0], axis=1).max() < 1e-6,
            asks="Two particles are at the same pose. Where are they after your motion?",
            on=NOISY,
        ),
    ),
    probes=(
        Probe(NOISY, _noisy, ("sampled",)),
        Probe("a landmark behind the robot", _behind, ALL),
        Probe(FAR_OFF, _far, ("far",)),
        Probe(
            "a landmark 40 cm away", lambda r: steps(r, 4, far=(0.4, 0.5), sigma=(0.02, 0.05)), ALL
        ),
        Probe("an accurate map", lambda r: steps(r, 3, sigma=(0.001, 0.003)), ALL),
        Probe("an accurate sensor", lambda r: steps(r, 3, blunt=0.02), ALL),
        Probe("one particle", lambda r: steps(r, 3, 1), ALL),
        Probe("two particles", lambda r: steps(r, 3, 2), ALL),
    ),
    may_round=_promised,
    begins=(
        "Take one particle. Which of its pose and its landmark is sampled, and which is computed?",
        "Where does the particle expect the landmark, as range and bearing, after its motion?",
    ),
)
