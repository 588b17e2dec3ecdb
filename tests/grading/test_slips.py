"""Programs of the tasks: right ways keep all points, slips lose some and are named, mutants die."""

import os

import numpy as np
import pytest

from course import fingerprints as compiler
from course import mutants
from course.programs import programs
from slamlab.exercises import catalogue, fingerprints
from slamlab.exercises.drives import StudentError
from slamlab.exercises.run_task import recognised
from slamlab.exercises.task import OPEN_SEED

SEEDS = int(os.environ.get("SLAMLAB_SLIP_SEEDS", "2"))  # make soak: many more
SAMPLE = 12  # mutants of each solution, in make test
PROGRAMS = {one.task.id: one for id in catalogue.EXERCISES for one in programs(id)}
WAYS = [(id, name) for id, one in PROGRAMS.items() for name in one.ways]
SLIPS = [
    pytest.param(id, slip, k, id=f"{id}-{slip.name}-{k}")
    for id, one in PROGRAMS.items()
    for slip in one.slips
    for k in range(len(slip.programs))
]
STUMBLES = [
    pytest.param(id, stumble.kind, program, id=f"{id}-{stumble.kind}-{k}")
    for id, one in PROGRAMS.items()
    for stumble in getattr(one.module, "STUMBLES", ())
    for k, program in enumerate(stumble.programs)
]
PASTED = [(id, name) for id, one in PROGRAMS.items() for name in getattr(one.module, "PASTED", {})]


def seeds():
    return [OPEN_SEED, *(b"slip %d" % k for k in range(SEEDS))]


@pytest.mark.parametrize(("id", "way"), WAYS, ids=lambda value: value)
def test_a_right_way_keeps_all_points(id, way):
    one = PROGRAMS[id]
    for seed in seeds():
        verdict = one.verdict(one.ways[way], seed)
        lost = [(law.name, law.where) for law in verdict.laws if law.failed]
        assert verdict.full, (seed, verdict.problem, lost)


@pytest.mark.parametrize(("id", "slip", "k"), SLIPS)
def test_a_slip_loses_points_and_is_named(id, slip, k):
    one = PROGRAMS[id]
    source = one.source(slip.programs[k])
    for seed in seeds():
        assert not one.verdict(source, seed).full, seed
    verdict = one.verdict(source, OPEN_SEED)
    sets = one.task.draw(OPEN_SEED)
    told = recognised(one.task, verdict, lambda: (sets, one.answers(source, sets)))
    others = {other.name for other in one.slips if slip.name in other.before}
    assert told.diagnosis in {slip.name} | others


@pytest.mark.parametrize(("id", "kind", "program"), STUMBLES)
def test_a_stumble_is_told_as_what_it_is(id, kind, program):
    one = PROGRAMS[id]
    verdict = one.verdict(one.source(program), OPEN_SEED)
    assert (verdict.points, verdict.kind) == (0, kind)


@pytest.mark.parametrize(("id", "name"), PASTED, ids=lambda value: value)
def test_a_function_of_the_lesson_under_a_new_name_earns_a_fifth_at_most(id, name):
    one = PROGRAMS[id]
    earned = [one.verdict(one.module.PASTED[name], seed).points for seed in seeds()]
    assert np.mean(earned) <= 0.2 * one.task.points


@pytest.mark.parametrize("id", PROGRAMS)
def test_each_law_is_broken_by_some_slip_and_asks_something(id):
    one = PROGRAMS[id]
    broken = set()
    for slip in one.slips:
        for program in slip.programs:
            verdict = one.verdict(one.source(program), OPEN_SEED)
            broken |= {law.name for law in verdict.laws if law.failed}
    laws = {law.name for law in one.task.laws}
    assert laws <= broken
    assert all(law.asks for law in one.task.laws)


@pytest.mark.parametrize("id", PROGRAMS)
def test_no_hint_is_a_solution_and_no_name_stands_twice(id):
    one = PROGRAMS[id]
    names = [slip.name for slip in one.slips]
    assert len(set(names)) == len(names)
    for slip in one.slips:
        assert slip.hint.endswith((".", "?"))
        assert "\n" not in slip.hint and "return " not in slip.hint


@pytest.mark.parametrize("id", PROGRAMS)
def test_a_sample_of_mutants_dies_or_is_right_as_well(id):
    found, tried = mutants.survivors(PROGRAMS[id], 3, SAMPLE, np.random.default_rng(6))
    assert tried
    alive = [s.mutant.text for s in found if s.differs and not s.reason]
    assert alive == []


@pytest.mark.parametrize("exercise_id", sorted({id[:2] for id in PROGRAMS}))
def test_the_fingerprints_are_those_of_these_sources(exercise_id):
    with np.load(compiler.FOLDER / f"{exercise_id}.npz") as stored:
        same = str(stored["digest"]) == compiler.digest(exercise_id)
    assert same, f"python -m course.fingerprints {exercise_id}"
    for id, table in fingerprints.tables(exercise_id).items():
        assert set(table.parts), id


@pytest.mark.parametrize("id", PROGRAMS)
def test_what_cannot_be_run_on_a_probe_costs_that_probe_only(id):
    one = PROGRAMS[id]
    sets = one.task.draw(OPEN_SEED)
    answers = one.answers(one.ways["solution"], sets)
    for probe in one.task.probes:
        verdict = one.task.judge(sets, answers | {probe.name: StudentError("raised", "x")})
        assert not verdict.full
        judged = [law for law in one.task.laws if one.task.judges(law, probe.name)]
        assert {law.name for law in verdict.laws if law.failed} == {law.name for law in judged}
