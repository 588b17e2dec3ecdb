"""Function calls of exercise 16, a student's own SLAM."""

from functools import partial

import numpy as np

from classroom.exercises.function_calls import (
    FunctionCall,
    StudentError,
    argument_rows,
    to_shaped_array,
)
from classroom.exercises.function_calls.changed_arguments import WatchedFunction
from classroom.exercises.function_calls.student_estimator import StudentEstimator
from slamlab.geometry import compose
from slamlab.readings import Reading, Scan

NAME = "MySlam"
RANGE_MIN, RANGE_MAX = 0.1, 8.0  # of the lidar [m]
SHORT_RANGE = 4.0  # of the lidar in the loop: after a gap scans do not overlap earlier ones [m]
WHEELS_ONLY = "MySlam still uses odometry alone: its poses equal those of odometry"
WHEELS_AT_THE_END = "trajectory() returns the poses of odometry, but pose differs from them"
NO_COVARIANCE = "MySlam has no covariance: not attempted yet"
SECONDS = 20.0
VERDICTS = "A", "B", "cannot tell"


def _run_estimators(functions, inputs, range_max=RANGE_MAX):
    found = []
    for odometry, ranges in zip(inputs["odometry"], inputs["ranges"], strict=True):
        estimator, online, _ = _run_estimator(functions[NAME], odometry, ranges, range_max)
        offered = estimator.trajectory(len(odometry))
        trajectory = online if offered is None else offered
        if np.isfinite(trajectory).all():  # otherwise the map cannot be right
            _check_map(estimator)
        wheels = integrate_odometry(odometry)
        if np.allclose(trajectory, wheels, atol=1e-6):
            if np.allclose(online, wheels, atol=1e-6):
                raise StudentError("not attempted", WHEELS_ONLY)
            raise StudentError("malformed", WHEELS_AT_THE_END)
        found.append(trajectory)
    return {"trajectory": np.array(found)}


def _check_map(estimator):
    # a map may not be attempted yet
    try:
        estimator.map()
    except StudentError as error:
        if error.kind != "not attempted":
            raise


def _run_with_covariances(functions, inputs):
    runs = [
        _run_estimator(functions[NAME], odometry, ranges)[1:]
        for odometry, ranges in zip(inputs["odometry"], inputs["ranges"], strict=True)
    ]
    online, covariances = (np.array(arrays) for arrays in zip(*runs, strict=True))
    if np.isnan(covariances).all():
        raise StudentError("not attempted", NO_COVARIANCE)
    if np.allclose(online, odometry_poses(inputs), atol=1e-6):
        raise StudentError("not attempted", WHEELS_ONLY)
    return {"pose": online, "covariance": covariances}


def _run_estimator(make, odometry, ranges, range_max=RANGE_MAX):
    """Run a new estimator; return it, its online poses (n, 3) and P (n, 3, 3)."""
    estimator, angles = StudentEstimator(make), np.linspace(-np.pi, np.pi, ranges.shape[1] + 1)

    def read(u, r, k):
        return estimator.step(Reading(0.5 * k, u, Scan(angles[:-1], r, range_max, RANGE_MIN)))

    step = WatchedFunction(read)
    answers = [step(u, r, k) for k, (u, r) in enumerate(zip(odometry, ranges, strict=True))]
    getattr(make, "changed", set()).update(step.changed)
    online, covariances = (np.array(arrays) for arrays in zip(*answers, strict=True))
    return estimator, online, covariances


def integrate_odometry(increments):
    """Integrate odometry increments (n, 3) from (0, 0, 0) to poses (n, 3) [m, m, rad]."""
    poses = [np.zeros(3)]
    for increment in increments:
        poses.append(compose(poses[-1], increment))
    return np.array(poses[1:])


def odometry_poses(inputs):
    """Return the poses of odometry of each run."""
    return [integrate_odometry(odometry) for odometry in inputs["odometry"]]


def _call_comparison(functions, inputs):
    """Call compare_versions for each study; return low, high, better (in VERDICTS) and needed."""
    compare, found = functions["compare_versions"], []
    for row in argument_rows(inputs):
        value = compare(*row)
        if not isinstance(value, tuple | list) or len(value) != 4:
            must = "compare_versions must end with: return low, high, better, needed"
            raise StudentError("malformed", must)
        low, high, better, needed = value
        if str(better) not in VERDICTS:
            must = f"better must be one of {', '.join(map(repr, VERDICTS))}"
            raise StudentError("malformed", f"{must}, but it is {str(better)[:40]!r}")
        named = zip(("low", "high", "needed"), (low, high, needed), strict=True)
        low, high, needed = (to_shaped_array(each, f"its {name}", ()) for name, each in named)
        found.append([low, high, VERDICTS.index(str(better)), needed])
    return dict(zip(("low", "high", "better", "needed"), np.transpose(found), strict=True))


CALLS = {
    "16-corridor": FunctionCall((NAME,), _run_estimators, SECONDS),
    "16-loop": FunctionCall((NAME,), partial(_run_estimators, range_max=SHORT_RANGE), SECONDS),
    "16-sure": FunctionCall((NAME,), _run_with_covariances, SECONDS),
    "16-versions": FunctionCall(("compare_versions",), _call_comparison),
}
