"""Notebooks of the fake exercise, and the catalogue that knows it."""

import functools
import json

import pytest

from slamlab.exercises import catalogue
from slamlab.grading import isolation, sandbox
from slamlab.grading.worker_pool import WorkerPool
from tests.grading import fake


@functools.cache
def workers():
    """Workers as bounded as this machine can have them, shared by all tests of a process."""
    return WorkerPool(
        next(level for level in reversed(sandbox.LEVELS) if not lacks(level)), warm=False
    )


@functools.cache
def lacks(level):
    """What this machine lacks for a level, None for nothing."""
    return None if level == sandbox.NONE else isolation.missing_requirement(level)


@pytest.fixture(autouse=True, scope="session")
def _no_zygote_stays():
    yield
    workers().close()


@pytest.fixture(autouse=True)
def _fake_exercise_is_known(monkeypatch):
    know_the_fake(monkeypatch)


def know_the_fake(monkeypatch):
    """Put the fake exercise into the catalogue."""
    known = {id: catalogue.EXERCISES for id in catalogue.EXERCISES}
    monkeypatch.setattr(catalogue, "EXERCISES", _Known(known))


class _Known(dict):
    """The true catalogue, imported as late as ever, and the fake."""

    def __init__(self, true):
        super().__init__(true | {"99": None})

    def __getitem__(self, id):
        true = super().__getitem__(id)
        return fake.EXERCISE if id == "99" else true[id]


def notebook(*cells, exercise="99", **more):
    """A notebook of code cells as the text of its file."""
    metadata = {"slamlab": {"exercise": exercise}} if exercise else {}
    made = [
        {
            "cell_type": "code",
            "metadata": {},
            "source": cell,
            "outputs": [],
            "execution_count": None,
        }
        for cell in cells
    ]
    content = {"cells": made, "metadata": metadata, "nbformat": 4, "nbformat_minor": 5}
    return json.dumps(content | more)
