"""A single error breaks only the law about it, and this law explains why."""

import re

import numpy as np
import pytest

from classroom.exercises.function_calls.run_and_pack import MAIN
from classroom.exercises.task import OPEN_SEED
from classroom.exercises.verdict_text import BROKEN, marked_laws
from course.exercises.ex10_set_membership_slam.narrow import poses
from course.exercises.ex12_three_filters.relocalise import hall
from course.task_programs import SOLUTION
from tests.classroom.grading.program_verdicts import (
    OF,
    broken,
    changed,
    edited,
    explained_verdict,
    mistake,
)


def noisy(errors="error * ranges * rng.standard_normal(len(ranges))", lost="dropouts", first=""):
    """A noisy of which one thing is another."""
    return f"""
def noisy(ranges, error, dropouts, rng):
    {first}
    measured = ranges + {errors}
    measured[rng.random(len(ranges)) < {lost}] = np.nan
    return measured
"""


ONE_THING_WRONG = {
    "a heading that is wrong is not said to lie beyond π": (
        "01-next-pose",
        changed("01-next-pose", "out[2] = 0.5 * out[2]"),
        {"heading"},
    ),
    "who meets no wall meets none behind, beside or along": (
        "02-ray-wall",
        "def ray_wall(p, phi, wall):\n    return np.inf",
        {"reached"},
    ),
    "a density that is wrong far from the wall is right near it": (
        "02-beam",
        edited(
            "02-beam",
            (
                "np.logaddexp(np.logaddexp(hit, short), random)",
                "np.log(np.exp(hit) + np.exp(short) + np.exp(random))",
            ),
        ),
        {"far"},
    ),
    "errors that are too large average out": (
        "02-noise",
        noisy("10 * error * ranges * rng.standard_normal(len(ranges))"),
        {"spread"},
    ),
    "errors that do not grow average out": (
        "02-noise",
        noisy("error * rng.standard_normal(len(ranges))"),
        {"spread"},
    ),
    "beams that are lost twice as often are lost one by one": (
        "02-noise",
        noisy(lost="2 * dropouts"),
        {"dropouts"},
    ),
    "who always draws the same errs as much as is asked": (
        "02-noise",
        noisy(first="rng = np.random.default_rng(1)"),
        {"dropouts", "seed"},
    ),
    "nobody asks how honest a filter is that is far off": (
        "03-outliers",
        changed("03-outliers", "out = out[0] + [0.5, 0], out[1]"),
        {"better", "close"},
    ),
    "nobody asks how a map errs that is none": (
        "06-slam",
        changed("06-slam", "out = *out[:2], out[2][:2]"),
        {"ids"},
    ),
}


@pytest.mark.parametrize("what", ONE_THING_WRONG)
def test_one_thing_wrong_breaks_no_law_that_speaks_of_another(what):
    id, source, laws = ONE_THING_WRONG[what]
    for seed in (OPEN_SEED, b"said 1", b"said 2"):
        verdict = OF[id].verdict(source, seed)
        marked = marked_laws(verdict, OF[id].task)
        assert {law.name for law, mark in marked if mark == BROKEN} == laws


def test_the_distance_of_a_robot_does_not_depend_on_P():
    one = OF["06-outliers"]
    sets = one.task.draw_inputs(OPEN_SEED)
    answers = one.outputs(one.ways[SOLUTION], sets)
    for factor, laws in ((100, {"careful", "honest"}), (0.01, {"careful", "honest"})):
        inflated = {MAIN: answers[MAIN] | {"P": factor * answers[MAIN]["P"]}}
        assert broken(one.task.judge(sets, inflated)) == laws


@pytest.mark.parametrize(
    ("id", "by"),
    [
        ("03-outliers", "out = out[0], 0 * np.array(out[1])"),
        ("04-moments", "out = out[0], 0 * out[1]"),
        ("05-lost", "out = out[0], 0 * out[1]"),
        ("06-slam", "out = out[0], 0 * out[1], out[2]"),
        ("06-outliers", "out = out[0], 0 * out[1], out[2]"),
        ("07-mornings", "out = out[0], 0 * out[1]"),
    ],
)
def test_an_invalid_covariance_P_is_reported(id, by):
    verdict = explained_verdict(id, changed(id, by))
    if id != "05-lost":  # there it is counted how many robots know how far off they are
        assert "covariance" in verdict.case
    assert verdict.case
    assert not re.search(r"\b(nan|inf)\b", verdict.case)
    assert verdict.diagnosis not in {"shut-out", "boasts"}


def test_for_an_answer_that_only_changes_its_arguments_nothing_else_is_reported():
    at = "t = np.linspace(-6, 6, 25)"
    changing = edited("04-moments", (at, f"P[0, 0] += 1e-12\n    {at}"))
    verdict = OF["04-moments"].verdict(changing, OPEN_SEED)
    assert broken(verdict) == {"unchanged"}
    assert verdict.diagnosis is None


@pytest.mark.parametrize("by", ["{k: (p, 2 * P)}", "{k: (p + 1e-3, P)}"])
def test_a_case_does_not_point_to_an_array_that_is_right(by):
    by = f"out = *out[:2], {by[:-1]} for k, (p, P) in out[2].items()}}"
    case = explained_verdict("05-alternate", changed("05-alternate", by)).case
    assert "should return" in case
    assert "the largest error" not in case  # what is wrong can be seen, and the rest is rounding


@pytest.mark.parametrize(
    ("id", "source", "not_so"),
    [
        ("02-echo", changed("02-echo", "out = 1.01 * out"), "a-fan-of-beams"),
        ("02-noise", noisy(lost="2 * dropouts"), "all-or-none"),
        ("02-noise", noisy("0"), "one-number-for-all"),
    ],
)
def test_a_property_that_an_answer_lacks_is_not_reported(id, source, not_so):
    for seed in (OPEN_SEED, b"said 1", b"said 2"):
        verdict = OF[id].verdict(source, seed)
        assert not verdict.full
        assert verdict.diagnosis != not_so


@pytest.mark.parametrize("id", OF)
def test_each_law_states_its_requirement_or_why_an_answer_is_impossible(id):
    for law in OF[id].task.laws:
        assert law.want or law.why, law.name


NOT_LEFT_OUT = (
    ("end > 0", "True"),
    ("a[:end] ** 2", "a[: max(end, 1)] ** 2"),
    ("b[:end] ** 2", "b[: max(end, 1)] ** 2"),
)
PINV = (
    ("-np.linalg.solve(H[3:, 3:], b[3:])", "-np.linalg.pinv(H) @ b"),
    ("better[1:] +=", "better +="),
)


@pytest.mark.parametrize(
    ("source", "law"),
    [
        (edited("08-pillar", ("best.sum() < needed", "best.sum() < 3")), "08-pillar inside"),
        (mistake("08-pillar", "radius-squared"), "08-pillar circle"),
        (mistake("09-place", "foot-of-the-robot"), "09-place line"),
        (edited("09-life", ("left > 1", "left > 0")), "09-life inside"),
        (edited("09-life", ("left > 1", "left > 2")), "09-life inside"),
        (mistake("10-narrow", "shaved"), "10-narrow sound"),
        (edited("12-odometry", ("/ 2), turn]", "/ 2), -turn]")), "12-odometry turn"),
        (edited("12-paired", *NOT_LEFT_OUT), "12-paired left out"),
        (mistake("12-relocalise", "no-memory"), "12-relocalise keeps"),
        (mistake("14-nodes", "starts only"), "14-nodes whole nodes"),
        (mistake("14-sweep", "xor"), "14-sweep damage refused"),
        (mistake("14-deskew", "lost-beams-as-points"), "14-deskew counted"),
        (edited("15-step", *PINV), "15-step anchored"),
        (mistake("15-range", "arms-exchanged"), "15-range e"),
    ],
)  # fmt: skip
def test_what_follows_from_a_broken_law_is_not_reported_as_broken_itself(source, law):
    id, law = law.split(" ", 1)
    marked = marked_laws(explained_verdict(id, source), OF[id].task)
    assert [result.name for result, mark in marked if mark == BROKEN] == [law]


def test_what_is_asked_of_the_first_reading_is_not_asked_of_whole_numbers():
    assert broken(explained_verdict("12-paired", edited("12-paired", *NOT_LEFT_OUT))) == {
        "left out"
    }


def test_of_poses_that_leave_their_set_one_outside_is_shown():
    case = explained_verdict("10-narrow", mistake("10-narrow", "middles-of-pieces")).case
    assert "agrees with every measurement" in case


def test_for_boxes_that_are_too_wide_the_ratio_that_is_judged_is_reported():
    source = edited("10-narrow", ("heading = np.array([angles[0][0], angles[-1][1]])", "pass"))
    case = " ".join(explained_verdict("10-narrow", source).case.split())
    mean, *each, most = re.search(
        r"ratio is (\S+) \(x (\S+), y (\S+), heading (\S+)\), .* at most (\S+) is", case
    ).groups()
    assert float(mean) == pytest.approx(np.mean([float(ratio) for ratio in each]), abs=0.01)
    assert float(mean) > float(most)


def test_an_empty_box_is_reported_as_such():
    source = edited("10-narrow", ("np.array([x.min(), x.max()", "np.array([x.max(), x.min()"))
    assert "x_min > x_max" in explained_verdict("10-narrow", source).case


def test_results_for_one_robot_do_not_depend_on_the_others():
    given = OF["10-narrow"].task.draw_inputs(OPEN_SEED)[""]
    for k, found in enumerate(poses.extremes(given)):
        alone = poses.extremes({name: array[k : k + 1] for name, array in given.items()})
        np.testing.assert_allclose(alone[0], found, atol=1e-6)


@pytest.mark.parametrize(
    ("away", "hint"), [([4.0, 0], "wrong-bay"), ([1.0, 0.5], "nowhere")], ids=["twin", "between"]
)
def test_a_robot_lost_elsewhere_is_not_reported_as_in_a_similar_bay(away, hint):
    task = OF["12-relocalise"].task
    sets = task.draw_inputs(OPEN_SEED)
    where, after = hall.truth(sets[""])
    off = after & (np.arange(len(after)) % 2 > 0)[:, None]
    where[..., :2] += off[..., None] * np.array(away)
    assert task.judge(sets, {"": {"poses": where}}).diagnosis == hint


def test_an_interval_with_wrong_coverage_is_reported():
    source = edited("12-interval", ("return ", "half *= 1.3 if n == 160 else 1\n    return "))
    assert "With 160 runs the mean coverage" in explained_verdict("12-interval", source).case


def test_a_weight_that_grew_wrongly_is_reported():
    heavy = ("z, R))", "z, R) + np.log(2) * (np.arange(len(rows)) < 1))")
    case = " ".join(explained_verdict("11-localise", edited("11-localise", heavy)).case.split())
    wanted, got = re.search(r"should be less .* by (\S+), but it is less by (\S+)\.", case).groups()
    assert abs(float(wanted) - float(got)) == pytest.approx(np.log(2), rel=0.02)


def test_matrices_that_are_not_rigid_motions_are_not_reported_as_off():
    task = OF["13-overlap"].task
    sets = task.draw_inputs(OPEN_SEED)
    answers = OF["13-overlap"].outputs(OF["13-overlap"].ways[SOLUTION], sets)
    law = task.laws[0]
    skewed = {"result": answers[""]["result"] * [[1, 1.001, 1], [1, 1, 1], [1, 1, 1]]}
    assert "16 of the matrices are not rigid motions" in law.why(sets[""], skewed)
    assert task.judge(sets, answers | {"": skewed}).diagnosis is None


def test_the_maps_that_the_law_counts_are_counted():
    case = explained_verdict(
        "15-false-loops", "def close_loops(poses, edges, loops):\n    return poses * 1"
    ).case
    few, of = re.search(r"(\d+) of (\d+) maps have an rms error below 0.9 m", case).groups()
    assert int(few) < int(of) / 2
