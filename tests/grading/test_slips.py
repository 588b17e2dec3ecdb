"""Programs of the tasks: right ways keep all points, slips lose some and are named, mutants die."""

import functools
import os
import re
import warnings

import numpy as np
import pytest

from course import fingerprints as compiler
from course import mutants
from course.programs import programs
from slamlab.exercises import catalogue, fingerprints
from slamlab.exercises.drives import StudentError
from slamlab.exercises.families import FAMILIES
from slamlab.exercises.run_task import recognised
from slamlab.exercises.task import OPEN_SEED

SEEDS = int(os.environ.get("SLAMLAB_SLIP_SEEDS", "1"))  # beside the open one; make soak: many more
SAMPLE = 12 if SEEDS > 1 else 4  # mutants of each solution; python -m course.mutants tries all
PROGRAMS = {one.task.id: one for id in catalogue.EXERCISES for one in programs(id)}
# a mutant is tried in seconds: many runs, or searches
COSTLY = {"04-unsure-drive", "05-lost", "08-pillar", "08-segments", "09-ghosts", "10-narrow",
          "11-kidnapped", "13-overlap", "15-liars"}  # fmt: skip
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


HIDDEN = [b"slip %d" % k for k in range(SEEDS)]


@functools.cache
def drawn(id, seed):
    """A task's inputs, drawn once for all its programs, which get copies."""
    sets = PROGRAMS[id].task.draw(seed)
    for inputs in sets.values():
        for array in inputs.values():
            array.flags.writeable = False
    return sets


@functools.cache
def told(id, source):
    """What is said of a program on the open inputs, with the slip that it is recognised as."""
    one, sets = PROGRAMS[id], drawn(id, OPEN_SEED)
    verdict, answers = judged(one, source, sets)
    return verdict if verdict.full else recognised(one.task, verdict, lambda: (sets, answers))


def judged(one, source, sets):
    """A program's verdict, and its answers where it has some."""
    try:
        answers = one.answers(source, sets)
    except StudentError as error:
        return one.task.failed(error.kind, error.message), None
    with np.errstate(all="ignore"), warnings.catch_warnings(action="ignore"):
        return one.task.judge(sets, answers), answers


def verdicts(id, source):
    """Seed and verdict, of the open seed first."""
    yield OPEN_SEED, told(id, source)
    for seed in HIDDEN:
        yield seed, judged(PROGRAMS[id], source, drawn(id, seed))[0]


@pytest.mark.parametrize(("id", "way"), WAYS, ids=lambda value: value)
def test_a_right_way_keeps_all_points(id, way):
    one = PROGRAMS[id]
    for seed, verdict in verdicts(id, one.ways[way]):
        lost = [(law.name, law.where) for law in verdict.laws if law.failed]
        assert verdict.full, (seed, verdict.problem, lost)


@pytest.mark.parametrize(("id", "slip", "k"), SLIPS)
def test_a_slip_loses_points_and_is_named(id, slip, k):
    one = PROGRAMS[id]
    source = one.source(slip.programs[k])
    for seed, verdict in verdicts(id, source):
        assert not verdict.full, seed
    named = told(id, source).diagnosis
    others = {other.name for other in one.slips if slip.name in other.before}
    if slip.shaky and named != slip.name:  # what it has, and where it fails, is so all the same
        assert named not in {other.name for other in one.slips} - others | set(FAMILIES)
    else:
        assert named in {slip.name} | others


@pytest.mark.slow
@pytest.mark.parametrize(("id", "kind", "program"), STUMBLES)
def test_a_stumble_is_told_as_what_it_is(id, kind, program):
    one = PROGRAMS[id]
    verdict = told(id, one.source(program))
    assert (verdict.points, verdict.kind) == (0, kind)


@pytest.mark.parametrize(("id", "name"), PASTED, ids=lambda value: value)
def test_a_function_of_the_lesson_under_a_new_name_earns_a_fifth_at_most(id, name):
    one = PROGRAMS[id]
    earned = [verdict.points for _, verdict in verdicts(id, one.module.PASTED[name])]
    assert np.mean(earned) <= 0.2 * one.task.points


@pytest.mark.parametrize("id", PROGRAMS)
def test_each_law_is_broken_by_some_slip_and_asks_something(id):
    one = PROGRAMS[id]
    broken = set()
    for slip in one.slips:
        for program in slip.programs:
            verdict = told(id, one.source(program))
            broken |= {law.name for law in verdict.laws if law.failed}
    laws = {law.name for law in one.task.laws}
    assert laws <= broken
    assert all(law.asks for law in one.task.laws)


def test_an_id_in_place_of_an_index_is_told_in_plain_words():
    one = PROGRAMS["06-slam"]
    (raised,) = (stumble for stumble in one.module.STUMBLES if stumble.kind == "raised")
    said = told("06-slam", one.source(raised.programs[0])).problem
    j, wanted = re.search(
        r"j = (\d+) is a landmark's id; what is wanted is its place .* is ids\.index\((\d+)\)$",
        said,
    ).groups()
    assert j == wanted


@pytest.mark.parametrize("id", PROGRAMS)
def test_no_hint_is_a_solution_and_no_name_stands_twice(id):
    one = PROGRAMS[id]
    names = [slip.name for slip in one.slips]
    assert len(set(names)) == len(names)
    for slip in one.slips:
        assert slip.hint.endswith((".", "?"))
        assert "\n" not in slip.hint and "return " not in slip.hint


@pytest.mark.parametrize(
    "id", [pytest.param(id, marks=[pytest.mark.slow] * (id in COSTLY)) for id in PROGRAMS]
)
def test_a_sample_of_mutants_dies_or_is_right_as_well(id):
    found, tried = mutants.survivors(PROGRAMS[id], 3, SAMPLE, np.random.default_rng(6))
    assert tried
    alive = [s.mutant.text for s in found if s.differs and not s.reason]
    assert alive == []


@pytest.mark.parametrize("exercise_id", sorted({id[:2] for id in PROGRAMS}))
def test_the_fingerprints_are_those_of_these_sources(exercise_id):
    kept = compiler.stored(exercise_id)
    old = [o.task.id for o in programs(exercise_id) if f"{o.task.id}/digest" not in kept]
    assert old == [], f"python -m course.fingerprints {exercise_id}"
    for id, table in fingerprints.tables(exercise_id).items():
        assert set(table.parts), id


@pytest.mark.slow
@pytest.mark.parametrize("id", PROGRAMS)
def test_what_cannot_be_run_on_a_probe_costs_that_probe_only(id):
    one = PROGRAMS[id]
    sets = drawn(id, OPEN_SEED)
    answers = one.answers(one.ways["solution"], sets)
    for probe in one.task.probes:
        verdict = one.task.judge(sets, answers | {probe.name: StudentError("raised", "x")})
        assert not verdict.full
        judged = [law for law in one.task.laws if one.task.judges(law, probe.name)]
        assert {law.name for law in verdict.laws if law.failed} == {law.name for law in judged}


def test_no_program_is_left_out():
    for id in catalogue.EXERCISES:
        for file in (compiler.ROOT / "course" / "tasks" / f"ex{id}").glob("[a-z]*.py"):
            others = (f.read_text("utf-8") for f in file.parent.glob("*.py") if f != file)
            is_task = re.search(r"^TASK = ", file.read_text("utf-8"), re.M)
            assert is_task or any(
                re.search(rf"import.*\b{file.stem}\b|\.{file.stem} import", t) for t in others
            ), file
