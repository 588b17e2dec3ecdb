"""Each wrong solution loses what it should and gets its own hint; each right one loses nothing."""

import os

import pytest

from slamlab.exercises.task import IDLE
from tests.bank import harness

SEEDS = int(os.environ.get("SLAMLAB_BANK_SEEDS", "5"))  # make soak: many more
BANKS = {id: harness.load(id) for id in harness.banked()}
ENTRIES = [
    pytest.param(id, entry, id=f"{id}-{type(entry).__name__.lower()}-{entry.name}")
    for id, bank in BANKS.items()
    for entry in bank.entries
]


@pytest.mark.parametrize(("id", "entry"), ENTRIES)
def test_an_entry_loses_just_what_it_should_and_gets_its_own_hint(id, entry):
    missed = harness.missed(BANKS[id], entry, SEEDS)
    allowed = 0.001 * SEEDS if isinstance(entry, harness.Wrong) else 0
    assert len(missed) <= allowed, f"{len(missed)} of {SEEDS} seeds, such as {_first(missed)}"


@pytest.mark.parametrize("id", BANKS)
def test_each_law_and_each_diagnosis_of_each_task_is_met_by_some_wrong_solution(id):
    bank = BANKS[id]
    laws, diagnoses = set(), set()
    for wrong in bank.wrong:
        own = [task.id for task in harness.touched(bank, wrong)]
        for verdict in harness.verdicts(bank, harness.namespace(bank, wrong), 0, own).values():
            laws.update((verdict.task, law.name) for law in verdict.laws if law.failed)
            diagnoses.add((verdict.task, verdict.diagnosis))
    tasks = bank.exercise.tasks
    laws = {(task, law) for task, law in laws if law != "unchanged"}
    assert laws == {(task.id, law.name) for task in tasks for law in task.laws}
    given = {(task, name) for task, name in diagnoses if name not in (None, IDLE.name)}
    assert given == {(task.id, d.name) for task in tasks for d in task.diagnoses}


@pytest.mark.parametrize("id", BANKS)
def test_the_names_of_entries_and_laws_are_told_apart(id):
    bank = BANKS[id]
    names = [entry.name for entry in bank.entries]
    assert len(set(names)) == len(names)
    for task in bank.exercise.tasks:
        assert len({law.name for law in task.laws}) == len(task.laws) > 0


def _first(missed):
    return next(iter(missed.items()), None)
