"""Task 06-consistent: NIS and NEES of the student's own filter, and intervals of their means."""

import numpy as np
from scipy.stats import chi2

from classroom.exercises.correctness_laws import equals, once
from classroom.exercises.task import Probe, Task
from course.exercises.ex06_ekf_slam.calls import CALLS
from course.exercises.ex06_ekf_slam.runs import STEPS, runs, truth
from slamlab import models
from slamlab.evaluation import nees
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.geometry import wrap
from slamlab.models import jacobians

TAILS = [0.025, 0.975]


def experiments(rng, count=3, repeated=6, known=True, steps=STEPS, **how):
    """Experiments of some runs each; the filter's C and R are right, or wrong by a factor."""
    found = []
    for _ in range(count):
        one = runs(rng, **how)
        end = truth(one)[2][steps - 1] + [0, 0, 2 * np.pi * rng.integers(-1, 2)]
        one |= {"x": one["x"][:repeated], "seen": one["seen"][:steps]}
        one |= {name: one[name][:repeated, :steps] for name in ("u", "z")}
        one |= {name: one[name] * rng.choice([0.3, 1.0, 3.0]) for name in ("C", "R")}
        found.append(one | {"end": end if known else np.full(3, np.nan)})
    return {name: np.array([one[name] for one in found]) for name in found[0]}


def _mixed(rng):
    """Experiments as usual, with landmarks behind the robot, and without the true pose."""
    kinds = experiments(rng, 2), experiments(rng, 2, behind=True), experiments(rng, 1, known=False)
    return {name: np.concatenate([kind[name] for kind in kinds]) for name in kinds[0]}


def _statistics(row):
    """NIS of all repeated measurements, NEES of the final poses, of all runs of an experiment."""
    x, P, u, seen, z, C, R, end = row
    all_nis, all_nees = [], []
    for start, inputs, scans in zip(x, u, z, strict=True):
        slam = MAK(start, P)
        for one, ids, scan in zip(inputs, seen.tolist(), scans, strict=True):
            W = jacobians.W_odometry(slam.pose, one)
            slam.predict(models.f_odometry(slam.pose, one), W @ C @ W.T)
            for i, measured in zip(ids, scan, strict=True):
                if i in slam.ids:
                    all_nis.append(slam.update([i], measured[None], R).nis)
                elif i >= 0:
                    slam.add([i], measured[None], R)
        error = slam.pose - end
        error[2] = wrap(error[2])
        all_nees.append(nees(error, slam.P[:3, :3]))
    return np.array(all_nis), np.array(all_nees)


@once
def want(inputs):
    """Means and intervals: {"nis": (rows, 3), "nees": (rows, 3), 0 without the truth, "known"}."""
    found = {"nis": [], "nees": []}
    for row in zip(*inputs.values(), strict=True):
        for name, size, values in zip(found, (2, 3), _statistics(row), strict=True):
            interval = chi2.ppf(TAILS, size * len(values)) / len(values)
            found[name].append([values.mean(), *interval])
    known = ~np.isnan(inputs["end"][:, 0])
    found = {name: np.array(values) for name, values in found.items()}
    found["nees"] = np.where(known[:, None], found["nees"], 0.0)
    return found | {"known": known.astype(float)}


def _of(*names):
    return lambda inputs: {name: want(inputs)[name] for name in names}


def _first(inputs):
    all_nis, all_nees = _statistics([array[0] for array in inputs.values()])
    return {"number of NIS": np.array(len(all_nis)), "the first three": all_nis[:3]} | (
        {} if np.isnan(all_nees[0]) else {"NEES of the runs": all_nees}
    )


def _law(name, points, says, outputs, parts, asks, **more):
    return equals(name, points, says, _of(*outputs), parts, asks=asks, step=_first, **more)


MEAN, INTERVAL = np.s_[0], np.s_[1:]

CONSISTENT = Task(
    id="06-consistent",
    title="NIS and NEES of your filter",
    call=CALLS["06-consistent"],
    inputs=_mixed,
    shapes={"nis": (None, 3), "nees": (None, 3), "known": (None,)},
    may_round=False,
    laws=(
        _law(
            "nis",
            1.5,
            "the mean NIS is that of all measurements of landmarks that were in the map",
            ("nis",),
            {"nis": MEAN},
            "Which estimate predicts a measurement, the one before the update or the one after "
            "it? Which measurements have an innovation at all?",
        ),
        _law(
            "nees",
            1,
            "the mean NEES is that of the last poses of all runs",
            ("nees",),
            {"nees": MEAN},
            "Which errors does the NEES of a pose contain, and which block of P belongs to them?",
        ),
        _law(
            "intervals",
            1,
            "the intervals contain the mean of a consistent filter with a probability of 95 %",
            ("nis", "nees"),
            {"nis": INTERVAL, "nees": INTERVAL},
            "How many squares of standard normal numbers are there in the sum of all NIS, and how "
            "many in that of all NEES?",
        ),
        _law(
            "truth",
            0.5,
            "without the truth nees is None, and with it a NEES",
            ("known",),
            None,
            "Which of the two tests compares the filter with a quantity that no sensor measures? "
            "What does the text ask you to return in its place, None or numbers such as nan?",
            alone=False,
        ),
    ),
    probes=(
        Probe("a run of three steps", lambda rng: experiments(rng, 2, 1, steps=3)),
        Probe("two runs of three steps", lambda rng: experiments(rng, 2, 2, steps=3)),
        # with scans of two landmarks of the map; its number of NIS is not that of its steps
        Probe("a run of six steps", lambda rng: experiments(rng, 2, 1, steps=6)),
        Probe(
            "landmarks behind the robot", lambda rng: experiments(rng, 3, 1, steps=6, behind=True)
        ),
        Probe("an unknown true pose", lambda rng: experiments(rng, 2, 1, known=False, steps=3)),
    ),
    needs=("06-augment", "06-update"),
    begins=(
        "Begin with your slam_step. In which of its lines do you know an innovation, and its S?",
        "For which measurements is there no innovation?",
    ),
)
