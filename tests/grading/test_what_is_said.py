"""What checks and hints say of an answer is true of it: which laws hold, what it returned."""

import re

import numpy as np
import pytest
from scipy.stats import binom

from course.programs import SOLUTION, namespace
from slamlab.checks import ladder
from slamlab.exercises import catalogue
from slamlab.exercises.reading import READINGS
from slamlab.exercises.report import format_verdict
from slamlab.exercises.task import OPEN_SEED
from slamlab.exercises.tasks.ex11 import draw, kidnapped
from tests.grading.saying import OF, broken, edited, told

HEAP = """
def draw(weights, rng):
    return np.full(len(weights), rng.choice(len(weights), p=weights))
"""
TICKETS = "def draw(weights, rng):\n    return rng.choice(len(weights), len(weights), p=weights)\n"


@pytest.mark.parametrize("source", [TICKETS, HEAP], ids=["tickets", "one sample, n times"])
def test_who_draws_right_on_average_is_not_said_to_draw_wrong_on_average(source):
    verdicts = [OF["11-draw"].verdict(source, b"said %d" % k) for k in range(20)]
    assert [broken(verdict) for verdict in verdicts] == [{"share"}] * 20


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


def test_a_mean_that_is_off_breaks_its_law_whatever_else_strays():
    off = "w = weights**2\n    return rng.choice(len(w), len(w), p=w / w.sum())\n"
    half = edited("11-draw", ("rng.random()", "rng.random() / 2"))
    for source in (f"def draw(weights, rng):\n    {off}", half):
        for k in range(10):
            assert "fair" in broken(OF["11-draw"].verdict(source, b"said %d" % k))


RIGHT_ROT = ("b - T[:2, :2] @ a", "b - a")
WRONG_ROT = ("Vt.T @ U.T\n", "U @ Vt\n")


@pytest.mark.parametrize(
    ("edit", "laws"),
    [(RIGHT_ROT, {"shift"}), (WRONG_ROT, {"turn", "mirror"})],
    ids=["wrong t", "wrong Rot"],
)
def test_rot_and_t_are_judged_each_by_itself(edit, laws):
    verdict = told("13-best-motion", edited("13-best-motion", edit))
    assert broken(verdict) == laws
    assert verdict.points == (3.5 if laws == {"shift"} else 0)


def test_t_of_a_rot_that_is_mended_later_is_wrong_where_it_was_mended():
    source = OF["13-best-motion"].ways["mirror mended by a diagonal"]
    source = source.replace("b - Rot @ a", "b - Vt.T @ U.T @ a")
    verdict = told("13-best-motion", source)
    assert broken(verdict) == {"shift"}


def test_of_who_always_draws_a_case_is_shown_in_which_that_is_wrong():
    always = """
def localise(rows, weights, u, C, p, z, R, rng):
    rows = move(rows, u, C, rng)
    w = normalise(np.log(weights) + log_likelihoods(rows, p, z, R))
    return rows[draw(w, rng)], np.full(len(rows), 1 / len(rows))
"""
    case = told("11-localise", always).case
    worth, n = re.search(
        r"you drew, though the weighed cloud was worth (\S+) of (\d+)", case
    ).groups()
    assert float(worth) > int(n) / 2
    one, task = OF["11-localise"], OF["11-localise"].task
    law = next(law for law in task.laws if law.name == "drawn")
    for k in range(5):  # whose answers are the solution's they are not said to be wrong
        sets = task.draw(b"said %d" % k)
        mine, right = (one.answers(s, sets) for s in (always, one.ways[SOLUTION]))
        for name in sets:
            if task.judges(law, name):
                off = [np.abs(mine[name][o] - right[name][o]) for o in ("rows", "weights")]
                same = np.all([o.reshape(len(o), -1).max(axis=1) < 1e-6 for o in off], axis=0)
                assert not task.broken(law, sets[name], mine[name])[same].any()


STRANGERS = """
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
def test_strangers_who_are_there_are_not_said_to_be_missing(k, set):
    one, source = OF["11-kidnapped"], STRANGERS.format(k=k, set=set.strip())
    for seed in (OPEN_SEED, b"said 1", b"said 2"):
        sets = one.task.draw(seed)
        answers = one.answers(source, sets)
        verdict = one.task.judge(sets, answers)
        near = kidnapped.at_hand(sets[""], answers[""])
        assert (near >= 0.5) == (verdict.diagnosis == "outweighed") == (k == 100)
        assert verdict.diagnosis in {"outweighed", "lost-before", "deceived", "never-back"}


@pytest.mark.slow
def test_who_sets_no_sample_anew_is_told_to():
    one = OF["11-kidnapped"]
    assert one.verdict(one.module.STEP, OPEN_SEED).diagnosis == "never-back"


@pytest.mark.parametrize("id", ["11-draw", "13-best-motion", "13-icp", "11-weigh"])
def test_the_points_of_all_laws_sum_up_to_those_of_the_task(id):
    one = OF[id]
    for slip in one.slips:
        verdict = told(id, one.source(slip.programs[0]))
        if verdict.laws:
            assert sum(law.max_points for law in verdict.laws) == one.task.points
            said = format_verdict(one.task, verdict)
            lines = re.findall(r"\((?:0 of )?(\S+) points?(?:\)|:)", re.sub(r"\n\s+", " ", said))
            assert sum(map(float, lines)) == one.task.points


def test_infinite_logarithms_are_shown_as_they_came():
    source = edited("11-weigh", ("return logs", "return np.log(np.exp(logs))"))
    case = told("11-weigh", source).case
    assert re.search(r"it returns\n\s+\[-inf, -390\.9, -inf", case)
    assert "finite =" not in case


def test_samples_are_counted_from_0():
    source = edited("11-weigh", ("return logs", "return logs + (np.arange(len(logs)) == 1)"))
    case = told("11-weigh", source).case
    assert "The logarithm of sample 1 less that of sample 0 (they are counted from 0)" in case


def test_of_a_draw_the_call_is_shown_that_strays_most():
    case = told("11-draw", TICKETS).case
    seed = int(re.search(r"seed = (\d+)", case)[1])
    shown = [int(k) for k in re.search(r"in order\n\s+\[(.*)\]", case)[1].split(", ")]
    w = OF["11-draw"].task.draw(OPEN_SEED)["two samples"]["weights"]
    assert any(sorted(np.random.default_rng(seed).choice(2, 2, p=each)) == shown for each in w)
    for name in ("seeds =", "copies =", "again ="):
        assert name not in case


@pytest.mark.parametrize("id", READINGS)
def test_a_reading_is_of_a_task_and_can_show_a_failure(id):
    task = catalogue.task(id)
    rows = {name: array[0] for name, array in task.draw(OPEN_SEED)[""].items()}
    inputs, outputs = READINGS[id].shown(rows, {})
    assert set(inputs) <= set(rows) | {"seed"}
    assert outputs == {}


def test_the_last_hint_is_repeated_without_the_case(monkeypatch):
    monkeypatch.setattr(ladder, "_climbed", {})
    names = namespace("11", TICKETS)
    first, second, third, fourth = (ladder.next_rung(OF["11-draw"].task, names) for _ in range(4))
    assert "weights = " not in first
    assert "weights = " in second
    assert third == fourth
    assert "weights = " not in third
    assert third.startswith("A question: ")
    assert "copies asked for" in third
    assert third.endswith("That was the last hint on this law.")
