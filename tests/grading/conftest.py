"""Notebooks of the fake exercise, and the catalogue that knows it."""

import json

import pytest

from slamlab.checks import catalogue
from tests.grading import fake


@pytest.fixture(autouse=True)
def _fake_exercise_is_known(monkeypatch):
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
