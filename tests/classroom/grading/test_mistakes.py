"""Programs of the tasks: right ones keep all points, mistakes lose some, mutants are killed."""

import functools
import os
import re
import warnings

import numpy as np
import pytest

from classroom.exercises import catalogue, fingerprints
from classroom.exercises.function_calls import StudentError
from classroom.exercises.mistake_families import MISTAKE_FAMILIES
from classroom.exercises.run_task import add_mistake_and_hint
from classroom.exercises.task import OPEN_SEED
from course import fingerprints as compiler
from course import mutation_testing
from course.task_programs import EXERCISES, folder_of, programs

SEEDS = int(os.environ.get("SLAMLAB_SLIP_SEEDS", "1"))  # beside the open one; make soak: many more
SAMPLE = (
    12 if SEEDS > 1 else 4
)  # mutants of each solution; python -m course.mutation_testing tries all
PROGRAMS = {one.task.id: one for id in catalogue.EXERCISES for one in programs(id)}
# a mutant is tried in seconds: many runs, or searches
COSTLY = {"04-moments", "05-lost", "08-pillar", "08-segments", "09-clean-map", "10-narrow",
          "11-kidnapped", "13-overlap", "15-false-loops"}  # fmt: skip
RIGHT_PROGRAMS = [(id, name) for id, one in PROGRAMS.items() for name in one.ways]
MISTAKES = [
    pytest.param(id, mistake, k, id=f"{id}-{mistake.name}-{k}")
    for id, one in PROGRAMS.items()
    for mistake in one.mistakes
    for k in range(len(mistake.programs))
]
STUMBLES = [
    pytest.param(id, stumble.kind, program, id=f"{id}-{stumble.kind}-{k}")
    for id, one in PROGRAMS.items()
    for stumble in one.file.stumbles
    for k, program in enumerate(stumble.programs)
]
PASTED = [
    pytest.param(id, answer.source, id=f"{id}-{answer.what}")
    for id, one in PROGRAMS.items()
    for answer in one.answers
    if answer.kind == "pasted"
]


HIDDEN = [b"slip %d" % k for k in range(SEEDS)]


@functools.cache
def drawn(id, seed):
    """A task's inputs, drawn once for all its programs, which get copies."""
    sets = PROGRAMS[id].task.draw_inputs(seed)
    for inputs in sets.values():
        for array in inputs.values():
            array.flags.writeable = False
    return sets


@functools.cache
def report(id, source):
    """Explain a program on the open inputs, with the recognised mistake."""
    one, sets = PROGRAMS[id], drawn(id, OPEN_SEED)
    verdict, answers = judged(one, source, sets)
    return (
        verdict
        if verdict.full
        else add_mistake_and_hint(one.task, verdict, lambda: (sets, answers))
    )


def judged(one, source, sets):
    """A program's verdict, and its answers where it has some."""
    try:
        answers = one.outputs(source, sets)
    except StudentError as error:
        return one.task.failed(error.kind, error.message), None
    with np.errstate(all="ignore"), warnings.catch_warnings(action="ignore"):
        return one.task.judge(sets, answers), answers


def hidden(id, source):
    """The verdict of each hidden seed."""
    return [judged(PROGRAMS[id], source, drawn(id, seed))[0] for seed in HIDDEN]


@pytest.mark.parametrize(("id", "way"), RIGHT_PROGRAMS, ids=lambda value: value)
def test_a_right_answer_keeps_all_points(id, way):
    verdict = report(id, PROGRAMS[id].ways[way])
    lost = [(law.name, law.where) for law in verdict.laws if law.failed]
    assert verdict.full, (verdict.problem, lost)


@pytest.mark.slow
@pytest.mark.parametrize("id", PROGRAMS)
def test_hidden_inputs_give_the_same_verdicts(id):
    one = PROGRAMS[id]
    for way, source in one.ways.items():
        assert all(verdict.full for verdict in hidden(id, source)), way
    for mistake in one.mistakes:
        for program in mistake.programs:
            full = [verdict.full for verdict in hidden(id, one.source(program))]
            assert not any(full), mistake.name


@pytest.mark.parametrize(("id", "mistake", "k"), MISTAKES)
def test_a_mistake_loses_points_and_is_named(id, mistake, k):
    one = PROGRAMS[id]
    verdict = report(id, one.source(mistake.programs[k]))
    assert not verdict.full
    named = verdict.diagnosis
    if (
        mistake.shaky and named != mistake.name
    ):  # what it has, and where it fails, is so all the same
        others = {other.name for other in one.mistakes} - one.names_of(mistake)
        assert named not in others | set(MISTAKE_FAMILIES)
    else:
        assert named in one.names_of(mistake)


@pytest.mark.slow
@pytest.mark.parametrize(("id", "kind", "program"), STUMBLES)
def test_a_failure_to_run_is_reported_as_such(id, kind, program):
    one = PROGRAMS[id]
    verdict = report(id, one.source(program))
    assert (verdict.points, verdict.kind) == (0, kind)


@pytest.mark.parametrize(("id", "source"), PASTED)
def test_a_function_of_the_lesson_under_a_new_name_earns_a_fifth_at_most(id, source):
    verdicts = [report(id, source), *hidden(id, source)]
    assert np.mean([verdict.points for verdict in verdicts]) <= 0.2 * PROGRAMS[id].task.points


@pytest.mark.parametrize("id", PROGRAMS)
def test_each_law_is_broken_by_some_mistake_and_asks_a_question(id):
    one = PROGRAMS[id]
    broken = set()
    for mistake in one.mistakes:
        for program in mistake.programs:
            verdict = report(id, one.source(program))
            broken |= {law.name for law in verdict.laws if law.failed}
    laws = {law.name for law in one.task.laws}
    assert laws <= broken
    assert all(law.asks for law in one.task.laws)


def test_an_id_in_place_of_an_index_is_reported_in_plain_words():
    one = PROGRAMS["06-slam"]
    (raised,) = (stumble for stumble in one.file.stumbles if stumble.kind == "raised")
    message = report("06-slam", one.source(raised.programs[0])).problem
    j, wanted = re.search(
        r"j = (\d+) is the id of a landmark, but its index .* from 0: ids\.index\((\d+)\)$",
        message,
    ).groups()
    assert j == wanted


@pytest.mark.parametrize("id", PROGRAMS)
def test_no_hint_is_a_solution_and_no_name_stands_twice(id):
    one = PROGRAMS[id]
    names = [mistake.name for mistake in one.mistakes]
    assert len(set(names)) == len(names)
    for mistake in one.mistakes:
        assert mistake.hint.endswith((".", "?"))
        assert "\n" not in mistake.hint and "return " not in mistake.hint


@pytest.mark.parametrize(
    "id", [pytest.param(id, marks=[pytest.mark.slow] * (id in COSTLY)) for id in PROGRAMS]
)
def test_a_sample_of_mutants_dies_or_is_right_as_well(id):
    found, tried = mutation_testing.survivors(PROGRAMS[id], 3, SAMPLE, np.random.default_rng(6))
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
        one, shown = PROGRAMS[id], slice(1, 1 + table.mistakes)
        hints = tuple(mistake.hint for mistake in one.mistakes)
        asks = tuple(
            m.asks or asked for m, asked in zip(one.mistakes, table.asks[1:], strict=False)
        )
        asked = {text for text in table.questions if text} <= set(one.file.questions.values())
        same = (table.hints[shown], table.asks[shown], asked) == (hints, asks, True)
        assert same, f"python -m course.fingerprints {id[:2]}"


@pytest.mark.slow
@pytest.mark.parametrize("id", PROGRAMS)
def test_what_cannot_be_run_on_a_probe_costs_that_probe_only(id):
    one = PROGRAMS[id]
    sets = drawn(id, OPEN_SEED)
    answers = one.outputs(one.ways["solution"], sets)
    for probe in one.task.probes:
        verdict = one.task.judge(sets, answers | {probe.name: StudentError("raised", "x")})
        assert not verdict.full
        judged = [law for law in one.task.laws if one.task.judges(law, probe.name)]
        assert {law.name for law in verdict.laws if law.failed} == {law.name for law in judged}


def test_every_folder_of_a_task_belongs_to_a_task_of_its_exercise():
    tasks = {
        folder_of(task.id) for id in catalogue.folders() for task in catalogue.exercise(id).tasks
    }
    assert {file.parent for file in EXERCISES.glob("ex*/*/task.py")} == tasks
