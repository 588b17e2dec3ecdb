"""Verdicts and hints make true statements: which laws hold, what was returned."""

import re

import numpy as np
import pytest
from scipy.stats import binom

from classroom.exercises import catalogue
from classroom.exercises.case_presentation import PRESENTATIONS
from classroom.exercises.task import OPEN_SEED
from classroom.exercises.verdict_text import format_verdict
from course.exercises.ex11_particle_filters.draw import task as draw
from course.exercises.ex11_particle_filters.kidnapped import task as kidnapped
from course.task_programs import SOLUTION
from tests.classroom.grading.program_verdicts import OF, broken, edited, explained_verdict

DRAW = "def draw(weights, rng):\n    n = len(weights)\n    return {}\n"
HEAP = DRAW.format("np.full(n, rng.choice(n, p=weights))")
MULTINOMIAL = DRAW.format("rng.choice(n, n, p=weights)")


@pytest.mark.parametrize("source", [MULTINOMIAL, HEAP], ids=["tickets", "one sample, n times"])
def test_right_draws_on_average_are_not_reported_as_wrong_on_average(source):
    verdicts = [OF["11-draw"].verdict(source, b"said %d" % k) for k in range(10)]
    assert [broken(verdict) for verdict in verdicts] == [{"share"}] * 10


def test_chance_breaks_the_law_of_the_mean_less_than_once_in_a_million():
    """Each sum of copies over all seeds is binomial, by tickets of n draws, by a comb of one."""
    i = draw.clouds(np.random.default_rng(0))
    n, seeds = draw.SAMPLES, draw.SEEDS
    for w in i["weights"].ravel():
        rest = n * w % 1
        for number, p in ((seeds * n, w), (seeds, rest)):
            variance = max(number * p * (1 - p) / seeds, rest * (1 - rest))
            band = seeds * draw.BAND * np.sqrt((variance + 0.01) / seeds)
            out = binom.cdf(number * p - band, number, p) + binom.sf(number * p + band, number, p)
            assert out * i["weights"].size < 1e-7


def test_a_wrong_mean_breaks_its_law_whatever_else_is_wrong():
    off = DRAW.format("rng.choice(n, n, p=weights**2 / (weights**2).sum())")
    half = edited("11-draw", ("rng.random()", "rng.random() / 2"))
    for source in (off, half):
        for k in range(5):
            assert "fair" in broken(OF["11-draw"].verdict(source, b"said %d" % k))


RIGHT_ROT = ("b - T[:2, :2] @ a", "b - a")
WRONG_ROT = ("Vt.T @ U.T\n", "U @ Vt\n")


def test_rot_and_t_are_judged_each_by_itself():
    corrected = OF["13-best-motion"].ways["mirror mended by a diagonal"]
    for source, laws in (
        (edited("13-best-motion", RIGHT_ROT), {"shift"}),
        (edited("13-best-motion", WRONG_ROT), {"turn", "mirror"}),
        (corrected.replace("b - Rot @ a", "b - Vt.T @ U.T @ a"), {"shift"}),  # too early
    ):
        verdict = explained_verdict("13-best-motion", source)
        assert broken(verdict) == laws
        assert verdict.points == (3.5 if laws == {"shift"} else 0)


def test_an_answer_that_always_draws_gets_a_case_where_that_is_wrong():
    always = """
def localise(rows, weights, u, C, p, z, R, rng):
    rows = move(rows, u, C, rng)
    w = normalise(np.log(weights) + log_likelihoods(rows, p, z, R))
    return rows[draw(w, rng)], np.full(len(rows), 1 / len(rows))
"""
    case = explained_verdict("11-localise", always).case
    worth, n = re.search(r"you resampled, although n_eff was (\S+) of (\d+)", case).groups()
    assert float(worth) > int(n) / 2
    one, task = OF["11-localise"], OF["11-localise"].task
    law = next(law for law in task.laws if law.name == "drawn")
    for k in range(5):  # answers equal to the solution's are not reported as wrong
        sets = task.draw_inputs(b"said %d" % k)
        mine, right = (one.outputs(s, sets) for s in (always, one.ways[SOLUTION]))
        for name in sets:
            if task.judges(law, name):
                off = [np.abs(mine[name][o] - right[name][o]) for o in ("rows", "weights")]
                same = np.all([o.reshape(len(o), -1).max(axis=1) < 1e-6 for o in off], axis=0)
                assert not task.broken(law, sets[name], mine[name])[same].any()


RANDOM_PARTICLES = """
def find_again(rows, weights, u, C, p, z, R, rng):
    n, k = len(rows), {k}
    rows = move(rows, u, C, rng)
    {set}
    weights[:k] = 1 / n
    weights = normalise(np.log(weights) + log_likelihoods(rows, p, z, R))
    if effective_size(weights) < n / 2:
        rows, weights = rows[draw(weights, rng)], np.full(n, 1 / n)
    return rows, weights
"""
RING = """
    r, beta = rng.multivariate_normal(z[0], R, k).T
    a = rng.uniform(-np.pi, np.pi, k)
    rows[:k] = np.c_[p[0] + r[:, None] * np.c_[np.cos(a), np.sin(a)], wrap(a + np.pi - beta)]
"""
ANYWHERE = "rows[:k] = rng.uniform([-5, -4, -np.pi], [5, 4, np.pi], (k, 3))"


@pytest.mark.slow
@pytest.mark.parametrize(("k", "set"), [(100, RING), (30, ANYWHERE)], ids=["ring", "anywhere"])
def test_unknown_people_in_the_room_are_not_reported_as_missing(k, set):
    one, source = OF["11-kidnapped"], RANDOM_PARTICLES.format(k=k, set=set.strip())
    for seed in (OPEN_SEED, b"said 1", b"said 2"):
        sets = one.task.draw_inputs(seed)
        answers = one.outputs(source, sets)
        verdict = one.task.judge(sets, answers)
        near = kidnapped.at_hand(sets[""], answers[""])
        assert (near >= 0.5) == (verdict.diagnosis == "outweighed") == (k == 100)
        assert verdict.diagnosis in {"outweighed", "lost-before", "deceived", "never-back"}


@pytest.mark.slow
def test_an_answer_that_replaces_no_particle_gets_that_hint():
    one = OF["11-kidnapped"]
    (step,) = (mistake.programs[0] for mistake in one.mistakes if mistake.name == "localise")
    assert one.verdict(one.source(step), OPEN_SEED).diagnosis == "never-back"


@pytest.mark.parametrize("id", ["11-draw", "13-best-motion", "13-icp", "11-fastslam"])
def test_the_points_of_all_laws_sum_up_to_those_of_the_task(id):
    one = OF[id]
    for mistake in one.mistakes:
        verdict = one.verdict(one.source(mistake.programs[0]), OPEN_SEED)
        if verdict.laws:
            assert sum(law.max_points for law in verdict.laws) == one.task.points
            text = format_verdict(one.task, verdict)
            lines = re.findall(r"\((?:0 of )?(\S+) points?(?:\)|:)", re.sub(r"\n\s+", " ", text))
            assert sum(map(float, lines)) == one.task.points


def test_of_random_draws_the_call_with_the_largest_deviation_is_shown():
    case = explained_verdict("11-draw", MULTINOMIAL).case
    seed = int(re.search(r"seed = (\d+)", case)[1])
    shown = [int(k) for k in re.search(r"sorted, are\n\s+\[(.*)\]", case)[1].split(", ")]
    w = OF["11-draw"].task.draw_inputs(OPEN_SEED)["two particles"]["weights"]
    assert any(sorted(np.random.default_rng(seed).choice(2, 2, p=each)) == shown for each in w)
    for name in ("seeds =", "copies =", "again ="):
        assert name not in case


@pytest.mark.parametrize(
    ("wrong", "shown"),
    [
        ("test(nis, 2), (0, 0, 0) if end is None else test(nees, 3)", r"\[0, 0, 0\] None"),
        ("test(nis, 2), None", r"None \[.*\]"),
    ],
)
def test_none_is_shown_as_none(wrong, shown):
    returned = "test(nis, 2), None if end is None else test(nees, 3)"
    case = explained_verdict("06-consistent", edited("06-consistent", (returned, wrong))).case
    assert re.fullmatch(shown, " ".join(re.findall(r"nees = (.*)", case)))
    assert "known" not in case.replace("unknown true pose", "") and "nan" not in case
    assert ("end = None" in case) == shown.endswith("None")


@pytest.mark.parametrize("id", PRESENTATIONS)
def test_a_presentation_belongs_to_a_task_and_can_show_a_failure(id):
    task = catalogue.task(id)
    rows = {name: array[0] for name, array in task.draw_inputs(OPEN_SEED)[""].items()}
    inputs, outputs = PRESENTATIONS[id].shown(rows, {})
    assert set(inputs) <= set(rows) | {"seed"}
    assert outputs == {}
