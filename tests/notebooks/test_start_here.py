"""Lesson 00 keeps its word: a letter has one meaning, that of the code; the map is the course's."""

import importlib
import inspect
import re

import numpy as np
import pytest

from course.source import ROOT, read
from slamlab.filters import linear_kalman

LESSONS = ROOT / "course" / "lessons"
MODULES = {
    "geometry": ["slamlab.geometry"],
    "models": ["slamlab.models.motion", "slamlab.models.observation"],
    "jacobians": ["slamlab.models.jacobians"],
    "noise": ["slamlab.models.noise"],
}
ANY_LENGTH = 5  # what the table calls n


def tables(name):
    """The tables in a cell of lesson 00, each a list of rows of texts; their heads left out."""
    cells = {cell.id: cell for cell in read(LESSONS / "00_start_here.py").cells}
    found = re.findall(r"(?:^\|.*\n?)+", cells[name].text, re.MULTILINE)
    return [
        [[text.strip() for text in line.strip("|").split("|")] for line in lines.splitlines()[2:]]
        for lines in found
    ]


def table(name):
    """The rows of the first table in a cell."""
    return tables(name)[0]


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
    modules = map(importlib.import_module, MODULES[room])
    (function,) = (getattr(module, name) for module in modules if hasattr(module, name))
    names = names.split(", ")
    assert names == list(inspect.signature(function).parameters)[: len(names)] or room == "geometry"
    rng = np.random.default_rng(1)
    sizes = [() if n == "T" and room != "geometry" else ARGUMENTS.get(n, ()) for n in names]
    result = function(*(rng.uniform(0.5, 1.5, s) for s in sizes))
    assert np.shape(result) == size
    assert np.isfinite(result).all()


def test_a_symbol_of_the_filter_is_a_field_of_that_shape():
    sizes = {"n": 3, "m": 2}
    root = np.random.default_rng(2).standard_normal((3, 5))
    before = linear_kalman.belief(np.ones(3), root @ root.T)
    b = linear_kalman.predict(before, np.eye(3), np.eye(3))
    b, step = linear_kalman.update(b, np.ones(2), root[:2, :3], np.eye(2))
    rows = tables("notation")[1]
    assert len(rows) == 8
    for _, code, size, _ in rows:
        owner, _, field = code.strip("`").partition(".")
        if owner == "linear":
            function, names = re.fullmatch(r"(\w+)\((.*)\)", field).groups()
            parameters = list(inspect.signature(getattr(linear_kalman, function)).parameters)
            assert names.split(", ") == parameters[: names.count(",") + 1]
            continue
        want = tuple(sizes[letter] for letter in re.findall("[nm]", size))
        assert np.shape(getattr({"b": b, "step": step}[owner], field)) == want, code


def test_a_symbol_of_the_graph_is_a_function_that_returns_its_shape():
    rng, rows = np.random.default_rng(3), tables("notation")[2]
    assert len(rows) == 3
    for _, code, size, _ in rows:
        room, name, names = re.fullmatch(r"`(\w+)\.(\w+)\((.*)\)`", code).groups()
        function = getattr(importlib.import_module(f"slamlab.posegraph.{room}"), name)
        assert names.split(", ") == list(inspect.signature(function).parameters)
        assert np.shape(function(*rng.uniform(0.5, 1.5, (3, 3)))) == shape(size)


def letters(symbol):
    """The letters of a symbol such as "$\\ominus a \\oplus b$", its subscripts left out."""
    bare = re.sub(r"_(\{.*?\}|.)(?=[\s$^]|$)|\\[o]?(minus|plus)", "", symbol)
    return re.findall(r"Rot|\\[a-zA-Z]+|[A-Za-z]", bare.replace(r"\mathrm", ""))


def test_a_letter_has_one_meaning():
    listed = [letter for symbol, _ in table("letters") for letter in letters(symbol)]
    assert len(set(listed)) == len(listed) > 25
    assert r"\nu" not in listed  # no eye tells it from v
    meanings = [meaning for _, meaning in table("letters")]
    assert len(set(meanings)) == len(meanings)


def test_the_symbols_of_functions_are_letters_of_the_table():
    known = {letter for symbol, _ in table("letters") for letter in letters(symbol)}
    for rows in tables("notation"):
        assert {letter for symbol, *_ in rows for letter in letters(symbol)} <= known


def test_the_first_notation_is_part_of_the_whole():
    whole = {code: (symbol, meaning) for symbol, code, _, _, meaning in table("notation")}
    for symbol, code, meaning in table("first-notation"):
        if "(" in code:
            assert whole[code] == (symbol, meaning)


def test_the_nis_is_m_if_s_is_just_right_and_less_if_the_filter_is_too_modest():
    rng, H, R = np.random.default_rng(4), np.eye(2, 3), np.diag([0.5, 2.0])
    P = np.diag([1.0, 2.0, 3.0])
    for share, wanted in ((1.0, 2.0), (4.0, 0.5)):  # the covariances told, as a share of the true
        belief = linear_kalman.belief(np.zeros(3), share * P)
        draws = rng.multivariate_normal(np.zeros(2), H @ P @ H.T + R, 4000)
        nis = [linear_kalman.update(belief, z, H, share * R)[1].nis for z in draws]
        assert np.mean(nis) == pytest.approx(wanted, rel=0.1)


@pytest.mark.parametrize("room", MODULES)
def test_every_function_of_the_models_stands_in_the_notation(room):
    public = {
        f"{room}.{name}"
        for module in map(importlib.import_module, MODULES[room])
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
        + table("map-of-lessons-2")
    }
    assert set(stated) == {path.stem for path in LESSONS.glob("*.py")}
    for stem, (number, title, lesson, exercise) in stated.items():
        source = read(LESSONS / f"{stem}.py")
        assert f"# {number} · {title[1 : title.index(']')]}" in source.cells[0].text
        assert lesson == f"{minutes(source.path)} min", stem
        task = ROOT / "course" / "exercises" / f"{stem}.py"
        assert exercise == (f"{minutes(task)} min" if task.exists() else ""), stem
