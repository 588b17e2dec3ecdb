"""Lesson 00 and the appendix "Notation" agree with the code, and the map is that of the course."""

import importlib
import inspect
import re

import numpy as np
import pytest

from course.source import ROOT, read
from slamlab.filters import kalman_filter

LESSONS = ROOT / "course" / "lessons"
PAGES = LESSONS / "00_start_here.py", ROOT / "course" / "appendices" / "notation.py"
MODULES = {
    "geometry": ["slamlab.geometry"],
    "models": ["slamlab.models.motion", "slamlab.models.observation"],
    "jacobians": ["slamlab.models.jacobians"],
    "noise": ["slamlab.models.noise"],
}
ANY_LENGTH = 5  # what the table calls n


def tables(name):
    """The tables in a cell of either page, each a list of rows of texts; their heads left out."""
    cells = {cell.id: cell for page in PAGES for cell in read(page).cells}
    found = re.findall(r"(?:^\|.*\n?)+", cells[name].text, re.MULTILINE)
    return [
        [[text.strip() for text in line.strip("|").split("|")] for line in lines.splitlines()[2:]]
        for lines in found
    ]


def table(name):
    """The rows of the first table in a cell."""
    return tables(name)[0]


def shape(text):
    """Parse the shape in a text such as "(n, 2)"."""
    sizes = text.strip("()").replace("n", str(ANY_LENGTH)).split(",")
    return tuple(int(size) for size in sizes if size.strip())


ROWS = [(re.findall(r"`([^`]+)`", code), shape(size)) for _, code, size, *_ in table("notation")]
FUNCTIONS = [(codes[0], size) for codes, size in ROWS if "." in codes[0]]
ARGUMENTS = {code: size for codes, size in ROWS if "." not in codes[0] for code in codes}
# results of other rows, or defined in their text
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
    before = kalman_filter.belief(np.ones(3), root @ root.T)
    b = kalman_filter.predict(before, np.eye(3), np.eye(3))
    b, step = kalman_filter.update(b, np.ones(2), root[:2, :3], np.eye(2))
    rows = tables("notation")[1]
    assert len(rows) == 8
    for _, code, size, _ in rows:
        owner, _, field = code.strip("`").partition(".")
        if owner == "linear":
            function, names = re.fullmatch(r"(\w+)\((.*)\)", field).groups()
            parameters = list(inspect.signature(getattr(kalman_filter, function)).parameters)
            assert names.split(", ") == parameters[: names.count(",") + 1]
        else:
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


def test_a_letter_is_listed_once_with_its_usual_meaning_and_is_all_that_symbols_use():
    def letters_of(rows):
        return [letter for symbol, *_ in rows for letter in letters(symbol)]

    listed = letters_of(table("letters"))
    assert len(set(listed)) == len(listed) > 25
    assert r"\nu" not in listed  # it looks like v
    meanings = [meaning for _, meaning in table("letters")]
    assert len(set(meanings)) == len(meanings)
    several = letters_of(table("overloaded"))
    assert len(set(several)) == len(several)
    assert all(usually != also for _, usually, also in table("overloaded"))
    assert {*several, *(x for rows in tables("notation") for x in letters_of(rows))} <= {*listed}


def test_the_first_notation_is_part_of_the_whole():
    whole = {code: (symbol, meaning) for symbol, code, _, _, meaning in table("notation")}
    for symbol, code, meaning in table("first-notation"):
        if "(" in code:
            assert whole[code] == (symbol, meaning)


def test_the_nis_is_m_if_s_is_right_and_less_if_the_filter_is_conservative():
    rng, H, R = np.random.default_rng(4), np.eye(2, 3), np.diag([0.5, 2.0])
    P = np.diag([1.0, 2.0, 3.0])
    # the given covariances, relative to the true ones
    for share, wanted in ((1.0, 2.0), (4.0, 0.5)):
        belief = kalman_filter.belief(np.zeros(3), share * P)
        draws = rng.multivariate_normal(np.zeros(2), H @ P @ H.T + R, 4000)
        nis = [kalman_filter.update(belief, z, H, share * R)[1].nis for z in draws]
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


def test_the_map_holds_every_lesson_with_its_title_and_its_minutes():
    def minutes(text):
        return re.search(r"\d+\s*min", text)[0]

    rows = table("map-of-lessons") + table("map-of-lessons-2")
    stems = [re.search(r"\((\w+)\.ipynb\)", title)[1] for _, title, *_ in rows]
    assert sorted(stems) == sorted(path.stem for path in LESSONS.glob("*.py"))
    for stem, (number, title, _, lesson, exercise) in zip(stems, rows, strict=True):
        first = read(LESSONS / f"{stem}.py").cells[0].text
        assert f"# {number} · {title[1 : title.index(']')]}" in first
        assert lesson == minutes(first), stem
        task = ROOT / "course" / "exercises" / f"ex{stem}" / "notebook.py"
        assert exercise == (minutes(read(task).cells[0].text) if task.exists() else ""), stem
