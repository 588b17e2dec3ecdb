"""Task 05-alternate: localisation and mapping in turn, each with the covariance of the other."""

import numpy as np

from classroom.exercises.correctness_laws import equals, once
from classroom.exercises.task import Probe, Task
from course.exercises.ex05_localisation_and_mapping.calls import CALLS
from course.exercises.ex05_localisation_and_mapping.localise.task import behind, runs
from course.exercises.ex05_localisation_and_mapping.observations import (
    filtered,
    with_wrapped_heading,
)
from slamlab import models
from slamlab.geometry import wrap
from slamlab.models import jacobians


def laps(rng, rows=4, steps=9, landmarks=3, unseen=2, step=(0.4, 0.7), turn=1):
    """Runs in which every landmark is measured, without the map."""
    made = []
    while len(made) < rows:
        one = runs(rng, 1, steps, landmarks, unseen, step, turn)
        if len(np.unique(one["ids"][one["ids"] >= 0])) == landmarks:
            made.append(one)
    return _mapless({name: np.concatenate([one[name] for one in made]) for name in made[0]})


def _mapless(inputs):
    return {name: array for name, array in inputs.items() if name != "landmarks"}


def _all_new(rng):
    inputs = laps(rng, 2, 5, 1, 0)
    return inputs | {"ids": np.tile([7, 3, 0, 12, 5], (2, 1))}


def _turned(x, P, us, ids, zs, C, R):
    """Beliefs of one run: xs, Ps, p and L by ascending ids; S of the first repeated measurement."""
    found, xs, Ps, first = {}, [], [], None
    for u, id, z in zip(us, ids, zs, strict=True):
        none = np.array([-1])
        (x,), (P,) = filtered(x, P, u[None], none, z[None], (), C, R)
        if id in found:
            p, L = found[id]
            H = np.hstack([jacobians.H_robot(x, p), jacobians.H_landmark(x, p)])
            joint = np.block([[P, np.zeros((3, 2))], [np.zeros((2, 3)), L]])
            S = H @ joint @ H.T + R
            first = S if first is None else first
            v = z - models.h(x, p)
            v[1] = wrap(v[1])
            K = np.linalg.solve(S, H @ joint).T
            x, found[id] = x + K[:3] @ v, (p + K[3:] @ v, L - K[3:] @ S @ K[3:].T)
            P = P - K[:3] @ S @ K[:3].T
        elif id >= 0:
            J = np.hstack([jacobians.J_xr(x, z), jacobians.J_z(x, z)])
            noise = np.block([[P, np.zeros((3, 2))], [np.zeros((2, 3)), R]])
            found[id] = models.g(x, z), J @ noise @ J.T
        xs.append(x)
        Ps.append(P)
    marks = [found[id] for id in sorted(found)]
    p, L = [m[0] for m in marks], [m[1] for m in marks]
    S = np.zeros((2, 2)) if first is None else first
    return np.array(xs), np.array(Ps), np.reshape(p, (-1, 2)), np.reshape(L, (-1, 2, 2)), S


@once
def want(inputs):
    found = [_turned(*run) for run in zip(*inputs.values(), strict=True)]
    return dict(zip(("xs", "Ps", "p", "L", "S"), map(np.array, zip(*found)), strict=True))  # noqa: B905


def _of(*names):
    return lambda inputs: {name: want(inputs)[name] for name in names}


def _again(inputs):
    return {"S of the first landmark measured again (0: none)": want(inputs)["S"]}


def _new(inputs):
    """The part of the pose in P of the landmark of the first step, in runs that measure one."""
    found, zs = want(inputs), inputs["zs"][:, 0]
    J = np.array([jacobians.J_xr(x, z) for x, z in zip(found["xs"][:, 0], zs, strict=True)])
    return {"part of the pose in P of the first landmark": J @ found["Ps"][:, 0] @ J.swapaxes(1, 2)}


def _shapes(inputs):
    runs, steps = inputs["ids"].shape
    N = (np.unique(inputs["ids"][0]) >= 0).sum()
    return {"xs": (runs, steps, 3), "Ps": (runs, steps, 3, 3), "p": (runs, N, 2),
            "L": (runs, N, 2, 2)}  # fmt: skip


UNMAPPED = ("poses", "covariances")
NEW = ("new", *UNMAPPED)

ALTERNATE = Task(
    id="05-alternate",
    title="Localisation and mapping in turn",
    call=CALLS["05-alternate"],
    inputs=laps,
    probes=(
        Probe("no measurements", lambda rng: _mapless(runs(rng, 2, 3, 2, 3)), UNMAPPED),
        Probe("one step", lambda rng: laps(rng, 2, 1, 1, 0), NEW),
        Probe("one landmark, measured in every step", lambda rng: laps(rng, 2, 4, 1, 0)),
        Probe("every landmark measured once", _all_new, NEW),
        Probe("thirty steps", lambda rng: laps(rng, 1, 30, 5, 6)),
        Probe("a robot that drives backwards", lambda rng: laps(rng, 2, 6, 2, 1, (-0.7, -0.4))),
        Probe("a robot that stands still", lambda rng: laps(rng, 2, 4, 2, 1, (0.0, 0.0), 0)),
        Probe("a landmark right behind the robot", lambda rng: _mapless(behind(rng))),
    ),
    shapes=_shapes,
    parts=with_wrapped_heading("xs"),
    laws=(
        equals(
            "new",
            1.5,
            "P of a landmark measured once contains the errors of the pose and of the measurement",
            _of("p", "L"),
            asks="A landmark is new: which errors does its position contain? How often do you use "
            "this first measurement, and for what?",
            step=_new,
            main=False,
        ),
        equals(
            "poses",
            1,
            "after every step, x is the estimate of a filter that treats the map as uncertain",
            _of("xs"),
            angles={"xs": 2},
            asks="Which errors does the innovation of a landmark contain that is itself uncertain? "
            "With which beliefs do both updates of a step begin?",
            step=_again,
        ),
        equals(
            "covariances",
            1,
            "after every step, P is the covariance that this filter reports",
            _of("Ps"),
            asks="Which covariance has the noise of the pose update, if the error of the landmark "
            "counts as a part of it?",
            step=_again,
        ),
        equals(
            "map",
            1.5,
            "at the end, p and P of every landmark are those of a filter that treats the pose as "
            "uncertain",
            _of("p", "L"),
            asks="A landmark is measured again: which covariance has the noise of its update, if "
            "the error of the pose counts as a part of it?",
            step=_again,
        ),
    ),
    needs=("05-locate",),
    may_round=False,
    begins=(
        "Which three kinds of steps are there: which measurement can occur, and what do you do?",
        "The error of the landmark changes the innovation of the pose. Which matrix propagates it?",
    ),
)
