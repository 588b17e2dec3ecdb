"""Task 05-map: a separate filter for each landmark, judged by batch least squares."""
# The sensor's errors are a tenth of a millimetre: h is linear wherever a filter may evaluate its H,
# so that every way to weight all measurements of a landmark ends at the same position.

import numpy as np

from classroom.exercises.correctness_laws import Law, once
from classroom.exercises.task import Probe, Task
from course.exercises.ex05_localisation_and_mapping.calls import CALLS
from course.exercises.ex05_localisation_and_mapping.sights import T, covariances, each
from slamlab import models
from slamlab.geometry import wrap
from slamlab.models import jacobians

OFTEN = (1, 1, 2, 3, 4)  # how often each landmark is seen
SIGMA = np.array([1e-4, 3e-5])  # of r [m] and β [rad]
TOLERANCE = 1e-2
"""In standard deviations: an H taken 3 σ off moves a place by some 10 σ²/r, 3e-4 of σ; where r
and β err nearly alike it is ten times as much: 3.3e-3 at most, over 10⁴ seeds."""


def courses(rng, rows=3, often=OFTEN, far=(3.0, 5.0), ids=None, behind=False):
    """Known poses all over a room, each measures one landmark: landmark k ``often[k]`` times, (low,
    high) ``far`` from the middle [m]."""
    made = [_course(rng, np.array(often, dtype=int), far, ids, behind) for _ in range(rows)]
    return {name: np.array([one[name] for one in made]) for name in made[0]}


def _course(rng, often, far, ids, behind):
    count, steps = len(often), often.sum()
    ids = rng.choice(np.arange(5, 90), count, replace=False) if ids is None else np.array(ids)
    angle = (np.arange(count) + 0.7 * rng.random(count)) * 2 * np.pi / max(count, 1)
    places = rng.uniform(*far, (count, 1)) * np.column_stack([np.cos(angle), np.sin(angle)])
    rows = rng.permutation(np.repeat(np.arange(count), often))
    xs = np.column_stack([rng.uniform(-0.9, 0.9, (steps, 2)), rng.uniform(-3, 3, steps)])
    if behind:
        away = places[rows] - xs[:, :2]
        xs[:, 2] = wrap(np.arctan2(away[:, 1], away[:, 0]) + np.pi)
    sigma = SIGMA / [1, max(1, far[0] / 5)]  # aside in metres, which is what bends h, as near by
    R = covariances(rng, sigma[None])[0]
    return {"xs": xs, "ids": ids[rows], "zs": _measured(rng, xs, places[rows], R), "R": R}


def _measured(rng, xs, places, R):
    # errors of 0.5 to 1.5 σ, alternating in sign
    sides = rng.choice([-1.0, 1.0], 2) * (-1.0) ** np.arange(len(xs))[:, None]
    errors = sides * rng.uniform(0.5, 1.5, (len(xs), 2))
    zs = models.h(xs, places) + errors @ np.linalg.cholesky(R).T
    zs[:, 1] = wrap(zs[:, 1])
    return zs


def _standing_still(rng):
    inputs = courses(rng, 1, (3, 1))
    xs, ids = inputs["xs"][0, :1].repeat(4, axis=0), inputs["ids"][0]
    places = np.where(ids[:, None] == ids[0], [[4.0, 1.0]], [[-2.0, 3.0]])
    zs = _measured(rng, xs, places, inputs["R"][0])
    return inputs | {"xs": xs[None], "zs": zs[None]}


def batch(xs, zs, R):
    """Least-squares position of one landmark and its covariance, by Gauss–Newton."""
    p, weight = models.g(xs[0], zs[0]), np.linalg.inv(R)
    for _ in range(3):
        H = each(lambda x, p=p: jacobians.H_landmark(x, p), xs)
        v = zs - models.h(xs, p)
        v[:, 1] = wrap(v[:, 1])
        P = np.linalg.inv((T(H) @ weight @ H).sum(axis=0))
        p = p + P @ (T(H) @ weight @ v[..., None]).sum(axis=0)[:, 0]
    return p, P


def fitted(inputs):
    """Positions p (m, N, 2), covariances P (m, N, 2, 2), number of measurements (m, N); ids
    ascending."""
    found = []
    for xs, ids, zs, R in zip(*inputs.values(), strict=True):
        rows = [ids == id for id in np.unique(ids)]
        found.append([(*batch(xs[at], zs[at], R), at.sum()) for at in rows])
    shapes = (2,), (2, 2), ()
    return [
        np.array([[one[k] for one in course] for course in found]).reshape(len(found), -1, *shape)
        for k, shape in enumerate(shapes)
    ]


@once
def in_sigmas(inputs, outputs):
    """Errors of p (m, N, 2) and of P (m, N, 2, 2) in standard deviations, and number of
    measurements."""
    p, P, often = fitted(inputs)
    sigma = np.sqrt(np.diagonal(P, axis1=-2, axis2=-1))
    units = sigma[..., :, None] * sigma[..., None, :]
    return (outputs["p"] - p) / sigma, (outputs["P"] - P) / units, often


def _holds(which):
    def holds(inputs, outputs):
        p, P, often = in_sigmas(inputs, outputs)
        off = np.maximum(np.abs(p).max(axis=-1), np.abs(P).max(axis=(-1, -2)))
        return (np.where(which(often), off, 0) <= TOLERANCE).all(axis=1)

    return holds


def _want(inputs):
    p, P, _ = fitted(inputs)
    return {"p": p, "P": P}


def _parts(inputs, outputs):
    p, P, often = in_sigmas(inputs, outputs)
    once = often == 1
    return {"p once": p[once], "P once": P[once], "p again": p[~once], "P again": P[~once]}


def _placed(inputs):
    x, z, R = inputs["xs"][0, 0], inputs["zs"][0, 0], inputs["R"][0]
    J = jacobians.J_z(x, z)
    return {"p of the first measurement": models.g(x, z)[None], "its P": (J @ R @ J.T)[None]}


MAP = Task(
    id="05-map",
    title="Mapping with known poses",
    call=CALLS["05-map"],
    inputs=courses,
    probes=(
        Probe("no measurements", lambda rng: courses(rng, 2, ()), ("again",)),
        Probe("one measurement", lambda rng: courses(rng, 2, (1,)), ("first",)),
        Probe("one landmark, measured twice", lambda rng: courses(rng, 2, (2,)), ("again",)),
        Probe("one landmark, measured eight times", lambda rng: courses(rng, 1, (8,)), ("again",)),
        Probe("landmarks 0, 1 and 4000", lambda rng: courses(rng, 2, (1, 2, 2), ids=[1, 0, 4000])),
        Probe("thirty landmarks, measured once", lambda rng: courses(rng, 1, [1] * 30), ("first",)),
        Probe("landmarks right behind the robot", lambda rng: courses(rng, 2, (1, 4), behind=True)),
        Probe("landmarks fifty metres away", lambda rng: courses(rng, 2, (1, 2), far=(45, 55))),
        Probe("a robot that stands still", _standing_still),
    ),
    shapes=lambda inputs: {
        "p": (len(inputs["ids"]), len(np.unique(inputs["ids"][0])), 2),
        "P": (len(inputs["ids"]), len(np.unique(inputs["ids"][0])), 2, 2),
    },
    parts=_parts,
    laws=(
        Law(
            "first",
            2,
            "after one measurement, p is g(x, z), and P is R propagated by the Jacobian",
            _holds(lambda often: often == 1),
            want=_want,
            asks="R is the covariance of r and β. Which Jacobian converts R into the covariance "
            "of x and y?",
            step=_placed,
        ),
        Law(
            "again",
            3,
            "after several measurements, p and P are the least squares estimate from all of them "
            "and its covariance",
            _holds(lambda often: often > 1),
            want=_want,
            asks="What does a second measurement of a landmark change in the belief of this "
            "landmark, and in the beliefs of the others?",
            step=_placed,
        ),
    ),
    may_round=False,
    begins=(
        "Where does a landmark lie that is measured at range r and bearing β from the pose x?",
        "What do you know about a landmark before its first measurement?",
    ),
)
