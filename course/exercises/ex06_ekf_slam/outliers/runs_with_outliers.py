"""Runs of task 06-outliers, with and without outliers, and a filter that knows the outliers."""
# The truth is in no array: errors have mean 0 over all runs; outliers come in pairs.

import numpy as np

from classroom.exercises.correctness_laws import once
from course.exercises.ex06_ekf_slam.beliefs import either_sign
from course.exercises.ex06_ekf_slam.runs import EYES, RUNS, START, driven, measured, runs, truth
from slamlab import models
from slamlab.filters.data_association import squared_distances
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.geometry import wrap
from slamlab.models import jacobians

LANDMARKS = 5
SLIPPERY = np.array([0.02, 0.05])  # σ of d, Δθ: who only drives is soon lost
ALL, TURNS = [0, 1, 2, 3, 4], 64
BEFORE = [[1, 2], [3, 4], [0, 2], [1, 3], [4, 0], [2, 3]]
AFTER = [[1, 2], [3], [4, 0], [2], [1, 3], [4], [0, 2], [3, 4], [1]]
SEEN = [ALL, *BEFORE, *TURNS * [[]], [0, 2], *AFTER]
SCANS = np.array([[*seen, -1, -1, -1, -1, -1][:LANDMARKS] for seen in SEEN])
ON_THE_SPOT = slice(1 + len(BEFORE), 1 + len(BEFORE) + TURNS)
TRUE = 0, ON_THE_SPOT.stop
"""The scans without outliers. In the second a correct bearing has an innovation as large as an
outlier has elsewhere, so no gate of a fixed size is right for both. Only P tells it from others."""
FALSER = np.geomspace(1, 4, 12)  # a bearing that is 0.6 rad off becomes 2.4 at most
FAR = 40  # d² beyond which every gate rejects a measurement
MOST = np.sqrt(3)
"""Largest measurement error in σ; errors are uniform. With Gaussian errors a right gate rejects a
correct measurement at a critical moment, and loses a robot, with one seed in a thousand."""
STEADY = np.array([0.04, 0.02])  # σ of d, Δθ in runs without outliers


def _evenly(rng):
    return lambda shape: rng.uniform(-MOST, MOST, shape)


def free(rng, eyes=EYES):
    """Runs without outliers, where the robot drives away from all landmarks."""
    return runs(rng, behind=True, eyes=eyes, wheels=STEADY, draw=_evenly(rng))


def lies(rng):
    """Runs on one trajectory. Each measurement, except in scans of all landmarks, is an outlier in
    two runs."""
    start = np.array([*either_sign(rng, 0.5, 3, 2), either_sign(rng, 0.3, 2.5)])
    turns = either_sign(rng, 1, 1) * rng.uniform(0.1, 0.3, len(SCANS))
    drives = np.column_stack([rng.uniform(0.4, 0.6, len(SCANS)), turns])
    drives[ON_THE_SPOT] = 0, either_sign(rng, 1, 1) * 4 * np.pi / TURNS
    around = rng.uniform(-np.pi, np.pi) + np.arange(LANDMARKS) * 2 * np.pi / LANDMARKS
    far = rng.uniform(5.0, 6.0, (LANDMARKS, 1))
    middle = driven(start, drives)[:, :2].mean(axis=0)
    p = middle + far * np.column_stack([np.cos(around), np.sin(around)])
    sigmas = START, SLIPPERY, EYES
    inputs = measured(rng, start, drives, p, SCANS, sigmas, draw=_evenly(rng))
    _turned(rng, inputs["u"][:, ON_THE_SPOT, 1], drives[ON_THE_SPOT, 1])
    off = np.zeros(inputs["z"].shape)
    for step, seen in enumerate(SEEN):
        for k in range(len(seen)) if step not in TRUE else ():
            lie = either_sign(rng, [0.5, 0.4], [1.2, 0.6])
            lie[(step + k) % 2] = 0  # either the range or the bearing is false
            told, untold = rng.choice(RUNS, 2, replace=False)
            off[told, step, k], off[untold, step, k] = lie, -lie
    inputs["z"] += off * _falser(inputs, off)
    inputs["z"][..., 1] = wrap(inputs["z"][..., 1])
    return inputs


def _falser(inputs, off):
    """Factor (s, LANDMARKS, 1) that enlarges an outlier so that S rejects it in both runs."""
    # A robot that is off by 3 σ, as one in 400 is, would else accept a false bearing.
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
    # The sums of the turns' errors are spread evenly, at most 1.7 σ: with a heading that is off by
    # 3 σ, as one of 400 is, a right gate would reject all landmarks.
    even = np.linspace(-1, 1, RUNS)
    wanted = SLIPPERY[1] * np.sqrt(len(true)) * rng.permutation(even / even.std())
    told += ((wanted - (told - true).sum(axis=1)) / len(true))[:, None]


@once
def told(inputs):
    """Final positions (r, 2) [m] of a filter that knows the outliers, and its covariances P."""
    _, _, way, landmarks = truth(inputs)
    off = np.zeros(inputs["z"].shape)
    for step, (pose, seen) in enumerate(zip(way, inputs["seen"].tolist(), strict=True)):
        for k, i in enumerate(seen):
            if i >= 0:
                off[:, step, k] = inputs["z"][:, step, k] - models.h(pose, landmarks[i])
    off[..., 1] = wrap(off[..., 1])
    true = (np.abs(off) < 6 * EYES).all(axis=-1)
    runs = zip(range(RUNS), inputs["z"], true, strict=True)
    ends = [[slam for _, slam in _told(inputs, *run)][-1] for run in runs]  # after the last scan
    return np.array([slam.pose[:2] for slam in ends]), np.array([slam.P for slam in ends])


def _told(inputs, run, observations, true):
    slam = MAK(inputs["x"][run], inputs["P"])
    kept = true & (inputs["seen"] >= 0)
    for step, (u, seen) in enumerate(zip(inputs["u"][run], inputs["seen"], strict=True)):
        W = jacobians.W_odometry(slam.pose, u)
        slam.predict(models.f_odometry(slam.pose, u), W @ inputs["C"] @ W.T)
        yield step, slam
        known = np.isin(seen, slam.ids)
        for rows, use in ((known & kept[step], slam.update), (~known & kept[step], slam.add)):
            if rows.any():
                use(seen[rows].tolist(), observations[step, rows], inputs["R"])
