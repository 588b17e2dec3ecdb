"""Hints speak in the letters of the exercise and its lesson, not in those of the solution."""

import re

import pytest

from classroom.exercises import catalogue
from course.source import ROOT, numbered
from course.task_programs import programs

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
    message = re.findall(r"\$\$?(.*?)\$\$?", text, re.S) + re.findall(r"`([^`]+)`", text)
    message = " ".join(message + re.findall(r"^(?!#).*$", text, re.M))
    for name, letter in GREEK.items():
        message = re.sub(rf"\\?\b{name}\b", f" {letter} ", message)
    return set(re.findall(r"(?<![A-Za-z])([A-Za-zα-ω])(?![A-Za-z])", message))


def hints(id):
    """Return the texts of each task of an exercise: hints, questions and steps."""
    for one in programs(id):
        yield from (text for each in one.mistakes for text in (each.hint, each.asks))
        yield from one.file.questions.values()
    for task in catalogue.exercise(id).tasks:
        yield from (text for law in task.laws for text in (law.asks, law.step))
        yield from (text for each in task.diagnoses for text in (each.hint, each.asks))
        yield from task.begins


@pytest.mark.parametrize("id", EXERCISES)
def test_a_hint_names_what_a_student_has_seen(id):
    exercise = numbered(id, "exercises").read_text("utf-8")
    lesson = next((ROOT / "course" / "lessons").glob(f"{id}_*.py")).read_text("utf-8")
    text = "\n".join(line for line in lesson.splitlines() if line.startswith("#"))
    known = letters(SOLVED.sub("", exercise)) | letters(text) | set("aAI")
    for hint in filter(lambda text: isinstance(text, str), hints(id)):
        prose = re.sub(r"[’'][std]\b|\d\s?(?:m|s|V|A)\b", "", hint)
        assert set(re.findall(LETTER, prose)) <= known, hint
