"""Each wrong solution loses what it should and gets its own hint; each right one loses nothing."""

import os

import numpy as np
import pytest

from tests.bank import harness

SEEDS = int(os.environ.get("SLAMLAB_BANK_SEEDS", "30"))
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
def test_each_diagnosis_is_given_to_some_wrong_solution(id):
    bank = BANKS[id]
    theirs = {d.name for task in bank.exercise.tasks for d in task.diagnoses}
    assert theirs == {wrong.diagnosis for wrong in bank.wrong} - {None}


@pytest.mark.parametrize("id", BANKS)
def test_each_law_takes_its_points_from_some_wrong_solution(id):
    bank, taken = BANKS[id], set()
    for wrong in bank.wrong:
        with np.errstate(all="ignore"):
            found = harness.verdicts(bank, harness.namespace(bank, wrong), 0)
        taken |= harness.lost(found)[0]
    assert taken == {(task.id, law.name) for task in bank.exercise.tasks for law in task.laws}


@pytest.mark.parametrize("id", BANKS)
def test_the_names_of_entries_and_laws_are_told_apart(id):
    bank = BANKS[id]
    names = [entry.name for entry in bank.entries]
    assert len(set(names)) == len(names)
    for task in bank.exercise.tasks:
        assert len({law.name for law in task.laws}) == len(task.laws) > 0


def _first(missed):
    return next(iter(missed.items()), None)
