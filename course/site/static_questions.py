"""Questions of a lesson on its page: each choice unfolds to its explanation."""

import html
from dataclasses import dataclass

import nbformat

from classroom.checks.question_files import load_question
from course.question_cells import asked


@dataclass(frozen=True)
class Question:
    """The question of a cell that calls :func:`classroom.checks.ask`.

    Parameters
    ----------
    text : str, Markdown
    choices : dict, text of a choice (or a number with its unit) to its explanation, Markdown
    right : str, the correct choice
    """

    text: str
    choices: dict
    right: str

    def as_cell(self, id):
        """Return the question as a Markdown cell whose choices unfold without JavaScript."""
        folds = [
            _fold(choice, explanation, choice == self.right)
            for choice, explanation in self.choices.items()
        ]
        return nbformat.v4.new_markdown_cell("\n\n".join([self.text, *folds]), id=id)


def question(code):
    """Return the question of a code cell, or None if the cell asks no question or computes it.

    Parameters
    ----------
    code : str

    Returns
    -------
    Question
    """
    try:
        given = asked(code)
    except ValueError:  # no literal
        return None
    if given and "text" not in given:
        given |= load_question(given["id"])
    return _read(given) if given else None


def _read(given):
    right = given["right"]
    if "choices" in given:
        return Question(given["text"], given["choices"], right)
    unit = f" {given['unit']}" if given.get("unit") else ""
    found = {f"{right:g}{unit}": given.get("reason", "")}
    wrong = {f"{value:g}{unit}": why for value, why in given.get("wrong", {}).items()}
    ordered = sorted((found | wrong).items(), key=lambda each: float(each[0].split()[0]))
    return Question(given["text"], dict(ordered), f"{right:g}{unit}")


def _fold(choice, explanation, is_right):
    verdict = "✓ Right" if is_right else "✗ Wrong"
    words = f"**{verdict}:** {explanation}" if explanation else f"**{verdict}.**"
    # a formula is left to Markdown as it is
    summary = choice if "$" in choice else html.escape(choice)
    head = f'<details class="choice"><summary>\n\n{summary}\n\n</summary>'
    return f"{head}\n\n{words}\n\n</details>"
