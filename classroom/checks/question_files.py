"""Load questions from the files of the course, so that a notebook's code reveals no answers."""

import json

from classroom import installed_course
from classroom.exercises import catalogue


def load_question(id):
    """Load the arguments of :func:`classroom.checks.ask` for an id, or raise ValueError."""
    file = _file(id.split("-")[0])
    asked = json.loads(file.read_text(encoding="utf-8")) if file.is_file() else {}
    if id not in asked:
        raise ValueError(f"no question {id!r} is stored: give its text and the right answer")
    question = asked[id]
    if "wrong" in question:
        question["wrong"] = dict(question["wrong"])  # pairs, because keys in JSON are strings
    return question


def _file(notebook):
    if notebook.startswith("ex"):
        return catalogue.file(notebook.removeprefix("ex"), "questions.json")
    return installed_course.file("questions", f"{notebook}.json")
