"""Trials of exercise 14: the solution finds every fault, weaknesses of trials are reported."""

import numpy as np
import pytest

from classroom.exercises.function_calls.run_and_pack import MAIN
from classroom.exercises.task import OPEN_SEED
from course.exercises.ex14_devices_and_live_slam.trials import faulty_drivers
from course.exercises.ex14_devices_and_live_slam.trials import task as driver_trials
from course.task_programs import programs

TRIALS = next(one for one in programs("14") if one.task.id == "14-trials")
WEAK = {  # the name of the diagnosis that belongs to some ways
    "none": "",
    "too much": "sequence(1, [127] * 999), sequence(1, [])",
    "no byte": "([0, 200], [0, 200])",
    "half a round": "sequence(0, [128])",
    "wrong counts": "([0, 5], [0, -5])",
    "no overflow": "sequence(1, [3] * 30)",
    "one direction": "sequence(1, [50] * 30)",
    "slow": "sequence(1, [50] * 30 + [-50] * 30)",
    "one sequence": "sequence(0, [127] * 30 + [-127] * 30)",
    "always from 0": "sequence(0, [127] * 30 + [-127] * 30), sequence(0, [])",
    "one way": "sequence(1, [127] * 30 + [-127] * 30), sequence(1, [])",
    "no shortest way": "*[sequence(1, [127] * 30 + [-127] * 30)] * 2",
    "never far": "*[sequence(1, [127] * 30 + [-127] * 30)] * 2, sequence(1, []), ([], [])",
    "not everything": "*[sequence(1, [c] * 260) for c in (127, -127)], sequence(1, []), ([], [])",
}


def ways_of(source):
    outputs = TRIALS.outputs(source, TRIALS.task.draw_inputs(OPEN_SEED))[MAIN]
    return [values.astype(int) for values, _ in driver_trials.ways_of(outputs)]


@pytest.mark.parametrize("fault", faulty_drivers.FAULTS)
def test_every_right_answer_distinguishes_each_faulty_driver_from_right_ones(fault):
    for source in TRIALS.ways.values():
        ways = ways_of(source)
        for parameter in faulty_drivers.FAULTS[fault][1]:
            assert faulty_drivers.is_detected((fault, parameter), ways), parameter


def test_a_hundred_drivers_are_drawn():
    assert len(faulty_drivers.drawn(np.random.default_rng(1))) == 100


@pytest.mark.parametrize("name", WEAK)
def test_a_weakness_of_trials_is_reported(name):
    verdict = TRIALS.verdict(f"def trials():\n    return [{WEAK[name]}]", OPEN_SEED)
    assert (verdict.full, verdict.diagnosis) == (False, name)


def test_each_weakness_that_is_reported_is_tried():
    assert {diagnosis.name for diagnosis in TRIALS.task.diagnoses} == set(WEAK)
