"""Lesson 00 keeps its word: the notation is that of the code, the map is that of the course."""

import importlib
import inspect
import re

import numpy as np
import pytest

from course.source import ROOT, read

LESSONS = ROOT / "course" / "lessons"
ROOMS = ("geometry", "models", "jacobians", "noise")
ANY_LENGTH = 5  # what the table calls n


def table(name):
    """The rows of the table in a cell of lesson 00, as lists of texts; its head left out."""
    cells = {cell.id: cell for cell in read(LESSONS / "00_start_here.py").cells}
    lines = [line for line in cells[name].text.splitlines() if line.startswith("|")]
    return [[text.strip() for text in line.strip("|").split("|")] for line in lines[2:]]


def shape(text):
    """The shape that a text such as "(n, 2)" says."""
    sizes = text.strip("()").replace("n", str(ANY_LENGTH)).split(",")
    return tuple(int(size) for size in sizes if size.strip())


ROWS = [(re.findall(r"`([^`]+)`", code), shape(size)) for _, code, size, *_ in table("notation")]
FUNCTIONS = [(codes[0], size) for codes, size in ROWS if "." in codes[0]]
ARGUMENTS = {code: size for codes, size in ROWS if "." not in codes[0] for code in codes}
# results of other rows, or said in the text of theirs
ARGUMENTS |= {"W": (3, 2), "C": (2, 2), "T": (3, 3), "points": (ANY_LENGTH, 2)}


@pytest.mark.parametrize(("code", "size"), FUNCTIONS, ids=[code for code, _ in FUNCTIONS])
def test_a_symbol_of_the_notation_is_a_function_that_returns_its_shape(code, size):
    room, name, names = re.fullmatch(r"(\w+)\.(\w+)\((.*)\)", code).groups()
    function = getattr(importlib.import_module(f"slamlab.{room}"), name)
    names = names.split(", ")
    assert names == list(inspect.signature(function).parameters)[: len(names)] or room == "geometry"
    rng = np.random.default_rng(1)
    sizes = [() if n == "T" and room != "geometry" else ARGUMENTS.get(n, ()) for n in names]
    result = function(*(rng.uniform(0.5, 1.5, s) for s in sizes))
    assert np.shape(result) == size
    assert np.isfinite(result).all()


@pytest.mark.parametrize("room", ROOMS)
def test_every_function_of_the_models_stands_in_the_notation(room):
    module = importlib.import_module(f"slamlab.{room}")
    public = {
        f"{room}.{name}"
        for name, value in vars(module).items()
        if inspect.isfunction(value)
        and value.__module__ == module.__name__
        and not name.startswith("_")
    }
    assert public == {code.split("(")[0] for code, _ in FUNCTIONS if code.startswith(room)}


def minutes(path):
    """The minutes that the first cell of a source says."""
    return int(re.search(r"(\d+)\s*min", read(path).cells[0].text)[1])


def test_the_map_holds_every_lesson_with_its_title_and_its_minutes():
    stated = {
        re.search(r"\((\w+)\.ipynb\)", title)[1]: (number, title, lesson, exercise)
        for number, title, _, lesson, exercise in table("map-of-lessons")
    }
    assert set(stated) == {path.stem for path in LESSONS.glob("*.py")}
    for stem, (number, title, lesson, exercise) in stated.items():
        source = read(LESSONS / f"{stem}.py")
        assert f"# {number} · {title[1 : title.index(']')]}" in source.cells[0].text
        assert lesson == f"{minutes(source.path)} min", stem
        task = ROOT / "course" / "exercises" / f"{stem}.py"
        assert exercise == (f"{minutes(task)} min" if task.exists() else ""), stem
