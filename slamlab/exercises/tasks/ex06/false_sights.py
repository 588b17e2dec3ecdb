"""Task 06-false-sights: one sight in ten is false; a filter that believes all of them is lost.

The truth is in no array: errors have the mean 0 over all runs, false sights too, which come in
pairs.
"""

import numpy as np

from slamlab import models
from slamlab.evaluation import nees
from slamlab.exercises.drives.ex06 import DRIVES
from slamlab.exercises.law import Diagnosis, Law, once
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex06.beliefs import either_sign
from slamlab.exercises.tasks.ex06.ends import NO_COVARIANCE, Ends, whole
from slamlab.exercises.tasks.ex06.runs import EYES, RUNS, START, driven, measured, runs, truth
from slamlab.filters.data_association import squared_distances
from slamlab.filters.landmark_models import POINTS
from slamlab.filters.mak import MAK
from slamlab.geometry import wrap
from slamlab.models import jacobians

ENDS = Ends(POINTS, sure=(0.0, np.inf))
LANDMARKS = 5
SLIPPERY = np.array([0.02, 0.05])  # σ of d, Δθ: who only drives is soon lost
ALL, TURNS = [0, 1, 2, 3, 4], 64
BEFORE = [[1, 2], [3, 4], [0, 2], [1, 3], [4, 0], [2, 3]]
AFTER = [[1, 2], [3], [4, 0], [2], [1, 3], [4], [0, 2], [3, 4], [1]]
SEEN = [ALL, *BEFORE, *TURNS * [[]], ALL, *AFTER]
SCANS = np.array([[*seen, -1, -1, -1, -1, -1][:LANDMARKS] for seen in SEEN])
ON_THE_SPOT = slice(1 + len(BEFORE), 2 + len(BEFORE) + TURNS)
"""The steps in which the robot turns, and sees nothing but in the last. There a true bearing is as
far off as a false one elsewhere, so no gate of a fixed size fits both."""
FALSER = np.geomspace(1, 4, 12)  # a bearing that is 0.6 rad off becomes 2.4 at most
FAR = 40  # d² beyond which nobody's gate takes a sight for true
MOST = np.sqrt(3)
"""In σ: what is measured errs by no more, evenly spread. With normal errors a right gate refuses a
true sight at the wrong moment, and loses a robot, with one seed in a thousand."""
LEAST = 0.5
"""Mean NEES of the pose below which a P is no claim."""
AS_TOLD = 0.4
"""So far from a filter that is told all may the best step be, as a share of that one's error."""


def lies(rng):
    """Runs of one way; of each sight but those of all landmarks, two runs are told another."""
    start = np.array([*either_sign(rng, 0.5, 3, 2), either_sign(rng, 0.3, 2.5)])
    turns = either_sign(rng, 1, 1) * rng.uniform(0.1, 0.3, len(SCANS))
    drives = np.column_stack([rng.uniform(0.4, 0.6, len(SCANS)), turns])
    drives[ON_THE_SPOT] = 0, either_sign(rng, 1, 1) * 4 * np.pi / TURNS
    around = rng.uniform(-np.pi, np.pi) + np.arange(LANDMARKS) * 2 * np.pi / LANDMARKS
    far = rng.uniform(5.0, 6.0, (LANDMARKS, 1))
    middle = driven(start, drives)[:, :2].mean(axis=0)
    p = middle + far * np.column_stack([np.cos(around), np.sin(around)])
    sigmas, evenly = (START, SLIPPERY, EYES), lambda shape: rng.uniform(-MOST, MOST, shape)
    inputs = measured(rng, start, drives, p, SCANS, sigmas, draw=evenly)
    _turned(rng, inputs["u"][:, ON_THE_SPOT, 1], drives[ON_THE_SPOT, 1])
    off = np.zeros(inputs["z"].shape)
    for step, seen in enumerate(SEEN):
        for k in range(len(seen)) if seen != ALL else ():
            lie = either_sign(rng, [0.5, 0.4], [1.2, 0.6])
            lie[(step + k) % 2] = 0  # either the range or the bearing is false
            told, untold = rng.choice(RUNS, 2, replace=False)
            off[told, step, k], off[untold, step, k] = lie, -lie
    inputs["z"] += off * _falser(inputs, off)
    inputs["z"][..., 1] = wrap(inputs["z"][..., 1])
    return inputs


def _falser(inputs, off):
    """(s, LANDMARKS, 1) how many times a lie has to be told so that S lets it pass in neither run.

    A robot that is off by 3 σ, as one in 400 is, would else take a false bearing for a true one.
    """
    false = off.any(axis=-1)
    nearest = np.full((*false.shape[1:], len(FALSER)), np.inf)
    for run in range(RUNS):
        for step, slam in _told(inputs, run, inputs["z"][run], ~false[run]):
            for k in np.flatnonzero(false[run, step]):
                lies = inputs["z"][run, step, k] + FALSER[:, None] * off[run, step, k]
                possible, d2 = lies[:, 0] > 0, np.zeros(len(lies))
                known = slam.ids.index(inputs["seen"][step, k])
                d2[possible] = squared_distances(slam, lies[possible], inputs["R"])[:, known]
                nearest[step, k] = np.minimum(nearest[step, k], d2)
    # the least that is enough, else what is farthest
    return FALSER[np.minimum(nearest, FAR).argmax(axis=-1)][..., None]


def _turned(rng, told, true):
    """Spread evenly how far off the runs are after they turned: nobody is off by more than 1.7 σ.

    A heading that is off by 3 σ, as one of 400 is, would make a right gate refuse all landmarks.
    """
    even = np.linspace(-1, 1, RUNS)
    wanted = SLIPPERY[1] * np.sqrt(len(true)) * rng.permutation(even / even.std())
    told += ((wanted - (told - true).sum(axis=1)) / len(true))[:, None]


def doubt(inputs, outputs):
    """Mean NEES of the pose at the end, over all runs: 3 for a filter that errs as much as P
    says."""
    x, P = ENDS.of(inputs, outputs)
    return nees(ENDS.errors(inputs, x)[:, :3], P[:, :3, :3]).mean()


@once
def told(inputs):
    """(r, 2) where a filter that is told which sights are false believes the robots [m]."""
    _, _, way, landmarks = truth(inputs)
    off = np.zeros(inputs["z"].shape)
    for step, (pose, seen) in enumerate(zip(way, inputs["seen"].tolist(), strict=True)):
        for k, i in enumerate(seen):
            if i >= 0:
                off[:, step, k] = inputs["z"][:, step, k] - models.h(pose, landmarks[i])
    off[..., 1] = wrap(off[..., 1])
    true = (np.abs(off) < 6 * EYES).all(axis=-1)
    return np.array(
        [_end(inputs, *run) for run in zip(range(RUNS), inputs["z"], true, strict=True)]
    )


def share(inputs, outputs):
    """How far the robots are from where :func:`told` has them, in units of what that one errs.

    The worst tenth of the runs is left out: with one seed in some thousand a right gate loses one.
    """
    where, believed = truth(inputs)[2][-1, :2], told(inputs)
    off = np.square(ENDS.of(inputs, outputs)[0][:, :2] - believed).sum(axis=1)
    usual = np.sort(off)[: RUNS * 9 // 10]
    return np.sqrt(usual.mean() / np.square(believed - where).sum(axis=1).mean())


def _end(inputs, run, sights, true):
    """(2,) where the filter that is told which sights are true believes the robot at the end."""
    slam = [slam for _, slam in _told(inputs, run, sights, true)][-1]
    return slam.pose[:2]  # it has looked for the last time, too


def _told(inputs, run, sights, true):
    """The filter that is told which sights (s, LANDMARKS) of a run are true, as it is before it
    looks at each scan, and which."""
    slam = MAK(inputs["x"][run], inputs["P"])
    kept = true & (inputs["seen"] >= 0)
    for step, (u, seen) in enumerate(zip(inputs["u"][run], inputs["seen"], strict=True)):
        W = jacobians.W_odometry(slam.pose, u)
        slam.predict(models.f_odometry(slam.pose, u), W @ inputs["C"] @ W.T)
        yield step, slam
        known = np.isin(seen, slam.ids)
        for rows, use in ((known & kept[step], slam.update), (~known & kept[step], slam.add)):
            if rows.any():
                use(seen[rows].tolist(), sights[step, rows], inputs["R"])


def _step(name, points, says, far, doubt_below=None):
    """One step of the ladder; where no doubt is named, P may be anything."""

    def holds(inputs, outputs):
        if not whole(inputs, outputs) or share(inputs, outputs) > far:
            return False
        return doubt_below is None or LEAST < doubt(inputs, outputs) < doubt_below

    def why(inputs, outputs):
        if not whole(inputs, outputs):
            return "the map does not hold each landmark once"
        away = f"they are {share(inputs, outputs):.2f} e away"
        if np.linalg.eigvalsh(ENDS.of(inputs, outputs)[1][:, :3, :3]).min() <= 0:
            return f"{away}, and {NO_COVARIANCE}"
        return f"{away}, and the mean NEES of their poses is {doubt(inputs, outputs):.3g}"

    return Law(name, points, says, holds, why=why, asks=ASKS)


ASKS = "How long is the innovation of a true sight, measured by what S expects? And of a false one?"

STILL_LOST = Diagnosis(
    "lost-after-turning",
    "In some runs the heading is still unsure by more than 0.3 rad at the end: since the robot "
    "turned on the spot hardly a sight was believed. A true bearing may be a radian off there, and "
    "a fifth of that elsewhere: does what decides know which of the two it is? The filter does. If "
    "it knows, it is too tight: a gate that refuses one true sight in twenty refuses a few in "
    "every run, and one at the wrong moment is enough.",
    lambda inputs, outputs: 0 < np.mean(ENDS.of(inputs, outputs)[1][:, 2, 2] > 0.3**2) < 1,
)

# over 60 seeds gates by S of 9.2 to 25 are 0.21 times as far at most, with a NEES of 4.8; slam_step
# is 0.53 times as far at least, and 0.29 with ten times R, mostly 0.51. None of fifteen gates of a
# fixed size takes the last step, over 6 seeds: who is as near has a NEES above 7
FALSE_SIGHTS = Task(
    id="06-false-sights",
    title="Make it better: one sight in ten is false",
    drive=DRIVES["06-false-sights"],
    inputs=lies,
    shapes={"x": (RUNS, None), "P": (RUNS, None, None), "ids": (RUNS, None)},
    rounds=False,
    laws=(
        _step(
            "better",
            1,
            "at the end your robots are within 0.75 e of where a filter has them that is told "
            "which sights are false; e is how far that filter itself is off, and the worst tenth "
            "of the runs is left out",
            0.75,
        ),
        _step("good", 1, "they are within 0.5 e", 0.5),
        _step(
            "careful",
            1,
            f"they are, and the mean NEES of their poses is between {LEAST} and 15",
            0.5,
            15,
        ),
        _step(
            "honest",
            1,
            f"they are within {AS_TOLD} e, with a mean NEES between {LEAST} and 7, where 3 is "
            "right",
            AS_TOLD,
            7,
        ),
    ),
    probes=(  # who trusts all sights less is 0.41 e away there in the middle, a right gate 0.12
        Probe("no false sight", lambda rng: runs(rng, behind=True), ("honest",)),
    ),
    diagnoses=(STILL_LOST,),
    needs=("06-augment", "06-update"),
)
