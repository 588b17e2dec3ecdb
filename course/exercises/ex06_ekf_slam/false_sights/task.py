"""Task 06-false-sights: EKF-SLAM where one measurement in ten is an outlier."""
# The truth is in no array: errors have mean 0 over all runs; outliers come in pairs.

import numpy as np

from classroom.exercises.correctness_laws import Diagnosis, Law, once
from classroom.exercises.task import Probe, Task
from course.exercises.ex06_ekf_slam.beliefs import either_sign
from course.exercises.ex06_ekf_slam.calls import CALLS
from course.exercises.ex06_ekf_slam.ends import NO_COVARIANCE, Ends, counted, whole
from course.exercises.ex06_ekf_slam.runs import (
    EYES,
    RUNS,
    START,
    STEPS,
    driven,
    measured,
    runs,
    truth,
)
from slamlab import models
from slamlab.evaluation import nees
from slamlab.filters.data_association import squared_distances
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.filters.landmark_models import POINTS
from slamlab.geometry import wrap
from slamlab.models import jacobians

# right programs have variances of 0.98 to 1.2 times those of least squares, on average 1.01 to
# 1.04, and are at most 0.34 apart; without R in the gate they have 1.16 on average
ENDS = Ends(POINTS, sure=(0.92, 1.42), apart=0.6, mean=0.06)
NEAR = Ends(POINTS, sure=(0.4, 2.5), apart=1)
"""Limits in the runs without outliers: of the best step, and of the step before it."""
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
COARSE = 5
"""How many times larger the measurement errors are in the runs without outliers."""
LEAST = 0.5
"""Mean NEES of the pose below which P is far too large to be useful."""
CLAIMED = 0.975
"""Least variances by P in units of those of a filter that knows the outliers: 1.00 to 1.01 for
right programs; 0.95 at most if rejected measurements change P."""
CLOSE = 0.27
"""Distance from a filter that knows the outliers, in units of that filter's error, of a filter that
rejects outliers."""


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
    sigmas, evenly = (START, SLIPPERY, EYES), lambda shape: rng.uniform(-MOST, MOST, shape)
    inputs = measured(rng, start, drives, p, SCANS, sigmas, draw=evenly)
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


def doubt(inputs, outputs):
    """Mean NEES of the final pose over all runs; 3 is consistent."""
    x, P = ENDS.of(inputs, outputs)
    return nees(ENDS.errors(inputs, x)[:, :3], P[:, :3, :3]).mean()


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


def share(inputs, outputs):
    """Distance from the positions of :func:`told`, in units of that filter's error."""
    # Without the worst tenth: with one seed in some thousand a right gate loses a run.
    where, believed = truth(inputs)[2][-1, :2], told(inputs)[0]
    off = np.square(ENDS.of(inputs, outputs)[0][:, :2] - believed).sum(axis=1)
    usual = np.sort(off)[: RUNS * 9 // 10]
    return np.sqrt(usual.mean() / np.square(believed - where).sum(axis=1).mean())


def claimed(inputs, outputs):
    """Mean variance by P in units of that by :func:`told`, the median of all runs."""
    ratios = np.linalg.solve(told(inputs)[1], ENDS.of(inputs, outputs)[1])
    return np.median(np.trace(ratios, axis1=1, axis2=2)) / ratios.shape[1]


def _told(inputs, run, sights, true):
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


def _step(name, points, says, asks, far=CLOSE, doubt_below=None, ends=ENDS, least=0.0):
    def holds(inputs, outputs):
        if inputs["u"].shape[1] == STEPS:  # without outliers
            return ends.sure(inputs, outputs)
        if not whole(inputs, outputs) or share(inputs, outputs) > far:
            return False
        honest = doubt_below is None or LEAST < doubt(inputs, outputs) < doubt_below
        return honest and claimed(inputs, outputs) >= least

    def why(inputs, outputs):
        if not whole(inputs, outputs):
            return counted(inputs, outputs)
        if inputs["u"].shape[1] == STEPS:
            return ends.ratios_told(inputs, outputs)
        away = f"the distance is {share(inputs, outputs):.2f} e"
        if np.linalg.eigvalsh(ENDS.of(inputs, outputs)[1][:, :3, :3]).min() <= 0:
            return f"{away}, and {NO_COVARIANCE}"
        return (
            f"{away}, the mean NEES of the pose is {doubt(inputs, outputs):.3g}, and the variances "
            f"by P are {claimed(inputs, outputs):.2g} times those of the reference filter"
        )

    return Law(name, points, says, holds, why=why, asks=asks, step=STEP)


STEP = (
    "For each measurement of a known landmark in one run, print vᵀ S⁻¹ v before the update, and "
    "how much x and P then change. For 99 % of the correct measurements vᵀ S⁻¹ v is below 9.2."
)
FREE, COARSELY = "no outlier", "no outlier and a less accurate sensor"


def _too_sure(inputs, outputs):
    near = whole(inputs, outputs) and ENDS.apart(inputs, outputs) < 5
    return near and ENDS.ratios(inputs, outputs).min() < ENDS.sure_within[0]


def _still_lost(inputs, outputs):
    return 0 < np.mean(ENDS.of(inputs, outputs)[1][:, 2, 2] > 0.3**2) < 1


def _poor(on):
    return Diagnosis(
        "poor-without-outliers",
        "Even in runs without outliers, x and P are not those of least squares. Either your gate "
        "rejects correct measurements, or another part of the step is wrong: let your gate accept "
        "everything, then your function must solve task 3.",
        lambda inputs, outputs: not ENDS.sure(inputs, outputs),
        on,
        asks="How good is your function if its gate accepts everything and there are no outliers? "
        "And which correct measurements does the gate reject?",
    )


DIAGNOSES = (
    Diagnosis(
        "map-incomplete",
        "Your map does not contain each measured landmark exactly once. If a landmark is not in "
        "ids, it is new: add it to the map, wherever it is.",
        lambda inputs, outputs: not whole(inputs, outputs),
        asks="Which landmarks does your map contain at the end, and when did each enter it?",
    ),
    Diagnosis(
        "too-sure",
        "Your P is too small even in runs without outliers, and no gate is the cause: a gate can "
        "only make P larger. Predict in each step, also if the scan is empty, and use no "
        "measurement twice.",
        _too_sure,
        FREE,
        asks="Without outliers, how often does each step predict, and how often does it use each "
        "measurement?",
    ),
    _poor(FREE),
    _poor(COARSELY),
    Diagnosis(
        "lost-after-turning",
        "In some runs σ of the heading is still above 0.3 rad at the end. After the turn on the "
        "spot a correct bearing may have an innovation of one radian, and elsewhere only a fifth "
        "of that; S describes this. Either your gate rejects such measurements, or your function "
        "loses the prediction or enlarges P where it rejects one.",
        _still_lost,
        asks="How large is σ of the heading at the end of a run, and what do x and P become in a "
        "step with an outlier?",
    ),
    Diagnosis(
        "rejected-but-counted",
        "Your positions are good, but your P is smaller than the P of a filter that omits the "
        "outliers. A rejected measurement must change neither x nor P.",
        lambda inputs, outputs: (
            share(inputs, outputs) <= CLOSE and claimed(inputs, outputs) < CLAIMED
        ),
        asks="Your function rejects a measurement. What are x and P afterwards, and what were they "
        "before?",
    ),
)

# Over 60 seeds gates by S of 9.2 to 25 are 0.21 times as far at most, with a NEES of 4.8; slam_step
# is 0.53 times as far at least. No gate of a fixed size takes the last steps: it rejects correct
# measurements of coarse sensors, or accepts outliers. Nor does a P of another size, or another R.
FALSE_SIGHTS = Task(
    id="06-false-sights",
    title="Make it better: one measurement in ten is an outlier",
    call=CALLS["06-false-sights"],
    inputs=lies,
    shapes={"x": (RUNS, None), "P": (RUNS, None, None), "ids": (RUNS, None)},
    may_round=False,
    laws=(
        _step(
            "better",
            0.5,
            "the map contains each measured landmark once, and the last position is within 0.4 e "
            "of that of a reference filter, which omits the outliers (e: rms error of this filter; "
            "without the two worst runs)",
            "How large may the innovation of a correct measurement be according to S, and how "
            "large is the innovation of an outlier?",
            0.4,
        ),
        _step(
            "good",
            1,
            f"the position is within {CLOSE} e",
            "The reference filter omits all outliers and nothing else. Does an outlier change your "
            "x, P or map, even a little, and which correct measurements do you not use?",
        ),
        _step(
            "careful",
            1,
            f"the position is within {CLOSE} e, with a mean NEES between {LEAST} and 15; without "
            "outliers, the variances by P are 0.4 to 2.5 times those of least squares",
            "Your positions are good, but does P fit their errors? Which measurements change your "
            "P, and by how much?",
            doubt_below=15,
            ends=NEAR,
        ),
        _step(
            "honest",
            1.5,
            f"the position is within {CLOSE} e, with a mean NEES between {LEAST} and 7, and the "
            f"variances by P are at least {CLAIMED} times those of the reference filter; without "
            "outliers, x and P are those of least squares, as in task 3",
            "Which measurements change your P, and by how much? Which correct measurements do you "
            "not use?",
            doubt_below=7,
            least=CLAIMED,
        ),
    ),
    probes=(
        Probe(FREE, lambda rng: runs(rng, behind=True, wheels=STEADY), ("careful", "honest")),
        Probe(
            COARSELY,
            lambda rng: runs(rng, behind=True, eyes=COARSE * EYES, wheels=STEADY),
            ("careful", "honest"),
        ),
    ),
    diagnoses=DIAGNOSES,
    needs=("06-augment", "06-update"),
    begins=(
        "Which line of slam_step would use an outlier? What do you know before this line?",
        "Which matrix states how large the innovation of a correct measurement can be?",
    ),
)
