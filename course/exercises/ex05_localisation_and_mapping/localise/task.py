"""Task 05-localise: the beliefs of a whole run in a known map."""

import numpy as np

from classroom.exercises.correctness_laws import equals, once
from classroom.exercises.references import Reference
from classroom.exercises.task import Probe, Task
from course.exercises.ex05_localisation_and_mapping.calls import CALLS
from course.exercises.ex05_localisation_and_mapping.observations import (
    beliefs,
    covariances,
    driven,
    either_sign,
    filtered,
    with_wrapped_heading,
)
from slamlab import models
from slamlab.geometry import wrap


def runs(rng, rows=5, steps=7, landmarks=4, unseen=2, step=(0.4, 0.7), turn=1):
    """Runs, each in its own world. Landmark 0 and the last landmark are measured; ``unseen`` steps
    have no measurement."""
    made = [_run(rng, steps, landmarks, unseen, step, turn) for _ in range(rows)]
    return {name: np.array([one[name] for one in made]) for name in made[0]}


def _run(rng, steps, landmarks, unseen, step, turn):
    (x,), (P,) = beliefs(rng, 1)
    turns = turn * either_sign(rng, 1, 1) * rng.uniform(0.2, 0.5, steps)
    us = np.column_stack([rng.uniform(*step, steps), turns])
    way = driven(x, us)
    around = (np.arange(landmarks) + 0.6 * rng.random(landmarks)) * 2 * np.pi / landmarks
    far = rng.uniform(3.5, 5, (landmarks, 1))
    places = way[:, :2].mean(axis=0) + far * np.column_stack([np.cos(around), np.sin(around)])
    ids = np.full(steps, -1)
    often = rng.integers(landmarks, size=steps - unseen)
    often[:2] = [0, landmarks - 1][: len(often)]
    ids[rng.permutation(steps)[: len(often)]] = often
    zs = models.h(way, places[ids]) + either_sign(rng, [0.05, 0.02], [0.12, 0.05], (steps, 2))
    zs[:, 1] = wrap(zs[:, 1])
    zs[ids < 0] = rng.uniform(-3, 3, (steps, 2))[ids < 0]  # means nothing
    C = covariances(rng, rng.uniform(0.03, 0.06, (1, 2)))[0]
    R = covariances(rng, rng.uniform(0.04, 0.08, (1, 2)))[0]
    return {
        "x": x, "P": P, "us": us, "ids": ids, "zs": zs, "landmarks": places, "C": C, "R": R,
    }  # fmt: skip


def behind(rng):
    """Straight runs away from a landmark, whose bearings are near ±π."""
    inputs = runs(rng, 2, 5, 1, 0, turn=0)
    x, d = inputs["x"], inputs["us"][..., 0].cumsum(axis=1)
    inputs["landmarks"] = models.g(x, np.tile([2.0, np.pi], (2, 1)))[:, None]
    off = np.tile([0.03, -0.03, 0.05, -0.04, 0.03], (2, 1))
    inputs["zs"] = np.stack([2 + d, wrap(np.pi + off)], axis=-1)
    return inputs


@once
def want(inputs):
    xs, Ps = zip(*(filtered(*run) for run in zip(*inputs.values(), strict=True)), strict=True)
    return {"xs": np.array(xs), "Ps": np.array(Ps)}


def _of(output):
    return lambda inputs: {output: want(inputs)[output]}


def _predicted(inputs):
    runs = zip(*inputs.values(), strict=True)
    found = [filtered(x, P, u[:1], -np.ones(1), z[:1], *m) for x, P, u, _, z, *m in runs]
    xs, Ps = map(np.concatenate, zip(*found, strict=True))
    return {"x after the first control input": xs, "P after it, before a measurement": Ps}


LOCALISE = Task(
    id="05-localise",
    title="EKF localisation: a whole run",
    call=CALLS["05-localise"],
    inputs=runs,
    probes=(
        Probe("no measurements", lambda rng: runs(rng, 2, 3, 2, 3), ("unseen",)),
        Probe("one step", lambda rng: runs(rng, 2, 1, 3, 0)),
        Probe("one landmark, measured in every step", lambda rng: runs(rng, 2, 3, 1, 0)),
        Probe("more landmarks than steps", lambda rng: runs(rng, 2, 4, 9, 1)),
        Probe("thirty steps", lambda rng: runs(rng, 1, 30, 6, 8)),
        Probe("a robot that drives backwards", lambda rng: runs(rng, 2, 4, 3, 1, (-0.7, -0.4))),
        Probe("a robot that only turns", lambda rng: runs(rng, 2, 4, 3, 1, (0.0, 0.0))),
        Probe("a robot that stands still", lambda rng: runs(rng, 2, 4, 3, 1, (0.0, 0.0), 0)),
        Probe("a landmark right behind the robot", behind),
    ),
    shapes=lambda inputs: {
        "xs": (*inputs["ids"].shape, 3),
        "Ps": (*inputs["ids"].shape, 3, 3),
    },
    parts=with_wrapped_heading("xs"),
    laws=(
        equals(
            "unseen",
            1,
            "without measurements x follows f, and P grows by the process noise",
            want,
            angles={"xs": 2},
            asks="Which part of a step does the filter execute if there is no measurement?",
            step="A step without a measurement is the prediction alone. It begins with the belief "
            "after the step before it.",
            main=False,
        ),
        equals(
            "poses",
            1.5,
            "after every step, x is the estimate from all inputs and measurements so far",
            _of("xs"),
            angles={"xs": 2},
            asks="Which control inputs has the robot executed when zs[k] is measured?",
            step=_predicted,
        ),
        equals(
            "covariances",
            1.5,
            "after every step, P is the covariance of this estimate, with each input and "
            "measurement used once",
            _of("Ps"),
            asks="Which P is the input of the next step?",
            step=_predicted,
        ),
    ),
    needs=("05-locate",),
    references=(Reference("localise", "x P us ids zs landmarks C R", want, "xs Ps"),),
    begins=(
        "Which two functions of this exercise make one step, and in which order?",
        "What does a step without a measurement do to x and P?",
    ),
)
