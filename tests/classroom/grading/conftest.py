"""Fixtures: notebooks of the fake exercise, and a catalogue that contains it."""

import csv
import functools
import json
import os
import subprocess
import sys

import pytest

from classroom.exercises import catalogue
from classroom.grading import isolation, sandbox
from classroom.grading.worker_pool import WorkerPool
from tests.classroom.grading import fake

HTML = "<script>alert(1)</script><img src=x onerror=y>"
posix = pytest.mark.skipif(os.name != "posix", reason="folders and rights of POSIX")


@functools.cache
def workers():
    """Return workers at the highest isolation level of this machine, shared within a process."""
    return WorkerPool(
        next(level for level in reversed(sandbox.LEVELS) if not lacks(level)), warm=False
    )


@functools.cache
def lacks(level):
    """Return what this machine lacks for an isolation level, or None."""
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


def table(path):
    """The rows of a CSV file, by its titles."""
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def slamlab(*words, **more):
    """A running command."""
    start = "import sys; from slamlab.cli import main; sys.exit(main())"
    return subprocess.Popen([sys.executable, "-c", start, *words], **more)


def notebook(*cells, exercise="99", **more):
    """A notebook of code cells as the text of its file."""
    metadata = {"slamlab": {"exercise": exercise}} if exercise else {}
    plain = {"cell_type": "code", "metadata": {}, "outputs": [], "execution_count": None}
    made = [plain | {"source": cell} for cell in cells]
    content = {"cells": made, "metadata": metadata, "nbformat": 4, "nbformat_minor": 5}
    return json.dumps(content | more)
