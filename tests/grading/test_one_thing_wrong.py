"""One thing that is wrong breaks the law that speaks of it, no other, and that law says why."""

import re

import numpy as np
import pytest

from course.programs import SOLUTION
from slamlab.exercises.drives.input_sets import MAIN
from slamlab.exercises.report import BROKEN, marked_laws
from slamlab.exercises.task import OPEN_SEED
from slamlab.exercises.tasks.ex10 import poses
from slamlab.exercises.tasks.ex12 import hall
from tests.grading.saying import OF, broken, changed, edited, slip, told


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
    "no point is misplaced of which nobody knows whose it is": (
        "02-to-points",
        edited("02-to-points", ("back = millimetres > 0", "back = millimetres > 3000")),
        {"nothing left out"},
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
        "03-ghosts",
        changed("03-ghosts", "out = out[0] + [0.5, 0], out[1]"),
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


def test_how_near_a_robot_is_hangs_on_no_P():
    one = OF["06-false-sights"]
    sets = one.task.draw(OPEN_SEED)
    answers = one.answers(one.ways[SOLUTION], sets)
    for factor, laws in ((100, {"careful", "honest"}), (0.01, {"careful", "honest"})):
        told_so = {MAIN: answers[MAIN] | {"P": factor * answers[MAIN]["P"]}}
        assert broken(one.task.judge(sets, told_so)) == laws


@pytest.mark.parametrize(
    ("id", "by"),
    [
        ("03-ghosts", "out = out[0], 0 * np.array(out[1])"),
        ("04-unsure-drive", "out = out[0], 0 * out[1]"),
        ("05-lost", "out = out[0], 0 * out[1]"),
        ("06-slam", "out = out[0], 0 * out[1], out[2]"),
        ("06-false-sights", "out = out[0], 0 * out[1], out[2]"),
        ("07-mornings", "out = out[0], 0 * out[1]"),
    ],
)
def test_of_a_P_that_is_none_it_is_said_that_it_is_none(id, by):
    verdict = told(id, changed(id, by))
    if id != "05-lost":  # there it is counted how many robots know how far off they are
        assert "covariance" in verdict.case
    assert verdict.case
    assert not re.search(r"\b(nan|inf)\b", verdict.case)
    assert verdict.diagnosis not in {"shut-out", "boasts"}


def test_of_an_answer_that_only_changes_its_arguments_nothing_else_is_said():
    drawn = """
def unsure_drive(x, P, u, C):
    rng, n = np.random.default_rng(1), 200_000
    P[0, 0] += 1e-12
    x, u = rng.multivariate_normal(x, P, n).T, rng.multivariate_normal(u, C, n).T
    ends = np.array([x[0] + u[0] * np.cos(x[2]), x[1] + u[0] * np.sin(x[2]), x[2] + u[1]])
    return ends.mean(axis=1), np.cov(ends)
"""
    verdict = OF["04-unsure-drive"].verdict(drawn, OPEN_SEED)
    assert broken(verdict) == {"unchanged"}
    assert verdict.diagnosis is None


@pytest.mark.parametrize("by", ["{k: (p, 2 * P)}", "{k: (p + 1e-3, P)}"])
def test_a_case_does_not_point_to_an_array_that_is_right(by):
    by = f"out = {by[:-1]} for k, (p, P) in out.items()}}"
    case = told("05-map", changed("05-map", by)).case
    assert "should return" in case
    assert "most of all" not in case  # what is wrong can be seen, and the rest is rounding


@pytest.mark.parametrize(
    ("id", "source", "not_so"),
    [
        ("02-echo", changed("02-echo", "out = 1.01 * out"), "a-fan-of-beams"),
        ("02-noise", noisy(lost="2 * dropouts"), "all-or-none"),
        ("02-noise", noisy("0"), "one-number-for-all"),
    ],
)
def test_a_property_is_not_told_of_who_does_not_have_it(id, source, not_so):
    for seed in (OPEN_SEED, b"said 1", b"said 2"):
        verdict = OF[id].verdict(source, seed)
        assert not verdict.full
        assert verdict.diagnosis != not_so


@pytest.mark.parametrize("id", OF)
def test_each_law_tells_what_it_wants_or_why_an_answer_cannot_be(id):
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
        (slip("08-pillar", "radius-squared"), "08-pillar circle"),
        (slip("08-corner", "sum-of-feet"), "08-corner place"),
        (slip("09-place", "foot-of-the-robot"), "09-place line"),
        (edited("09-life", ("left > 1", "left > 0")), "09-life inside"),
        (edited("09-life", ("left > 1", "left > 2")), "09-life inside"),
        (slip("10-narrow", "shaved"), "10-narrow sound"),
        (edited("12-odometry", ("/ 2), turn]", "/ 2), -turn]")), "12-odometry turn"),
        (edited("12-paired", *NOT_LEFT_OUT), "12-paired left out"),
        (slip("12-relocalise", "no-memory"), "12-relocalise keeps"),
        (slip("14-nodes", "starts only"), "14-nodes whole nodes"),
        (slip("14-sweep", "xor"), "14-sweep damage refused"),
        (slip("14-command", "no end"), "14-command form"),
        (slip("14-command", "no begin"), "14-command form"),
        (edited("15-step", *PINV), "15-step anchored"),
        (slip("15-range", "arms-exchanged"), "15-range e"),
    ],
)  # fmt: skip
def test_what_follows_from_a_broken_law_is_not_said_to_be_broken_itself(source, law):
    id, law = law.split(" ", 1)
    marked = marked_laws(told(id, source), OF[id].task)
    assert [result.name for result, mark in marked if mark == BROKEN] == [law]


def test_what_is_asked_of_the_first_reading_is_not_asked_of_whole_numbers():
    assert broken(told("12-paired", edited("12-paired", *NOT_LEFT_OUT))) == {"left out"}


def test_of_who_lets_poses_go_one_is_shown_that_lies_outside():
    case = told("10-narrow", slip("10-narrow", "middles-of-pieces")).case
    assert "agrees with every sighting" in case


def test_of_a_box_that_is_too_wide_a_width_is_told_that_is():
    source = edited("10-narrow", ("heading = np.array([angles[0][0], angles[-1][1]])", "pass"))
    case = " ".join(told("10-narrow", source).case.split())
    numbers = re.search(r"This is x (\S+), y (\S+), the heading (\S+) times as wide", case).groups()
    assert max(map(float, numbers)) > 1


def test_what_is_found_of_a_robot_does_not_hang_on_the_others():
    given = OF["10-narrow"].task.draw(OPEN_SEED)[""]
    for k, found in enumerate(poses.extremes(given)):
        alone = poses.extremes({name: array[k : k + 1] for name, array in given.items()})
        np.testing.assert_allclose(alone[0], found, atol=1e-6)


@pytest.mark.parametrize(
    ("away", "hint"), [([4.0, 0], "wrong-bay"), ([1.0, 0.5], "nowhere")], ids=["twin", "between"]
)
def test_who_is_lost_elsewhere_is_not_said_to_be_in_a_bay_that_looks_alike(away, hint):
    task = OF["12-relocalise"].task
    sets = task.draw(OPEN_SEED)
    where, after = hall.truth(sets[""])
    off = after & (np.arange(len(after)) % 2 > 0)[:, None]
    where[..., :2] += off[..., None] * np.array(away)
    assert task.judge(sets, {"": {"poses": where}}).diagnosis == hint


def test_of_intervals_one_is_told_whose_coverage_is_wrong():
    source = edited("12-interval", ("return ", "half *= 1.3 if n == 160 else 1\n    return "))
    assert "With 160 runs it holds" in told("12-interval", source).case


def test_of_weights_one_is_told_that_grew_wrongly():
    heavy = ("z, R))", "z, R) + np.log(2) * (np.arange(len(rows)) < 1))")
    case = " ".join(told("11-localise", edited("11-localise", heavy)).case.split())
    wanted, got = re.search(r"should be less .* by (\S+), and is by (\S+)\.", case).groups()
    assert abs(float(wanted) - float(got)) == pytest.approx(np.log(2), rel=0.02)


def test_matrices_that_are_no_motions_are_not_said_to_be_off():
    task = OF["13-overlap"].task
    sets = task.draw(OPEN_SEED)
    answers = OF["13-overlap"].answers(OF["13-overlap"].ways[SOLUTION], sets)
    law = task.laws[0]
    skewed = {"result": answers[""]["result"] * [[1, 1.001, 1], [1, 1, 1], [1, 1, 1]]}
    assert "16 of the matrices are no motions" in law.why(sets[""], skewed)
    assert task.judge(sets, answers | {"": skewed}).diagnosis is None


def test_of_maps_those_are_counted_that_the_law_counts():
    case = told("15-liars", "def close_loops(poses, edges, loops):\n    return poses * 1").case
    few, of = re.search(r"Off by less than 0.9 m are (\d+) of (\d+) maps", case).groups()
    assert int(few) < int(of) / 2
