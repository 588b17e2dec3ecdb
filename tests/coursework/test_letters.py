"""Hints speak in the letters of the exercise and its lesson, not in those of the solution."""

import importlib
import pkgutil
import re

import pytest

from course.source import ROOT
from slamlab.exercises import catalogue

GREEK = {
    **dict(theta="θ", beta="β", phi="φ", varphi="φ", sigma="σ", tau="τ", rho="ρ", alpha="α"),
    **dict(
        varepsilon="ε", gamma="γ", iota="ι", xi="ξ", eta="η", kappa="κ", pi="π", delta="δ", mu="μ"
    ),
}
LETTER = r"(?<![\w.])([A-Za-zα-ω])(?![\w])"
SOLVED = re.compile(r"### BEGIN SOLUTION.*?### END SOLUTION", re.S)
EXERCISES = [f"{number:02}" for number in range(1, 16)]


def letters(text):
    """The letters that a notebook's formulas and code use."""
    said = re.findall(r"\$\$?(.*?)\$\$?", text, re.S) + re.findall(r"`([^`]+)`", text)
    said = " ".join(said + re.findall(r"^(?!#).*$", text, re.M))
    for name, letter in GREEK.items():
        said = re.sub(rf"\\?\b{name}\b", f" {letter} ", said)
    return set(re.findall(r"(?<![A-Za-z])([A-Za-zα-ω])(?![A-Za-z])", said))


def hints(id):
    """What is said of each task of an exercise: hints of slips, questions of laws, diagnoses."""
    package = importlib.import_module(f"course.tasks.ex{id}")
    for found in pkgutil.iter_modules(package.__path__):
        slips = getattr(importlib.import_module(f"{package.__name__}.{found.name}"), "SLIPS", ())
        yield from (slip.hint for slip in slips)
    for task in catalogue.exercise(id).tasks:
        yield from (law.asks for law in task.laws if law.asks)
        yield from (diagnosis.hint for diagnosis in task.diagnoses)


@pytest.mark.parametrize("id", EXERCISES)
def test_a_hint_names_what_a_student_has_seen(id):
    exercise = next((ROOT / "course" / "exercises").glob(f"{id}_*.py")).read_text("utf-8")
    lesson = next((ROOT / "course" / "lessons").glob(f"{id}_*.py")).read_text("utf-8")
    told = "\n".join(line for line in lesson.splitlines() if line.startswith("#"))
    known = letters(SOLVED.sub("", exercise)) | letters(told) | set("aAI")
    for hint in hints(id):
        prose = re.sub(r"[’'][std]\b|\d\s?(?:m|s|V|A)\b", "", hint)
        assert set(re.findall(LETTER, prose)) <= known, hint
