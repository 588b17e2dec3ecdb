"""Questions of a lesson on its page: each choice unfolds to what is to be said of it."""

import html
from dataclasses import dataclass

import nbformat

from course.asking import asked
from slamlab.checks.stored_questions import stored_question


@dataclass(frozen=True)
class Question:
    """What a cell that calls :func:`slamlab.checks.ask` asks.

    Parameters
    ----------
    text : str, Markdown
    choices : dict, text of a choice (or a number with its unit) to what is said of it, Markdown
    right : str, the one that is right
    """

    text: str
    choices: dict
    right: str

    def as_cell(self, id):
        """The question as a Markdown cell, without JavaScript: a fold a choice."""
        folds = [_fold(choice, said, choice == self.right) for choice, said in self.choices.items()]
        return nbformat.v4.new_markdown_cell("\n\n".join([self.text, *folds]), id=id)


def question(code):
    """The question that a cell of code asks, or None; what is computed there cannot be told here.

    Parameters
    ----------
    code : str

    Returns
    -------
    Question
    """
    try:
        told = asked(code)
    except ValueError:  # no literal
        return None
    if told and "text" not in told:
        told |= stored_question(told["id"])
    return _read(told) if told else None


def _read(told):
    right = told["right"]
    if "choices" in told:
        return Question(told["text"], told["choices"], right)
    unit = f" {told['unit']}" if told.get("unit") else ""
    found = {f"{right:g}{unit}": told.get("reason", "")}
    wrong = {f"{value:g}{unit}": why for value, why in told.get("wrong", {}).items()}
    ordered = sorted((found | wrong).items(), key=lambda each: float(each[0].split()[0]))
    return Question(told["text"], dict(ordered), f"{right:g}{unit}")


def _fold(choice, said, is_right):
    verdict = "✓ Right" if is_right else "✗ Not so"
    words = f"**{verdict}:** {said}" if said else f"**{verdict}.**"
    # a formula is left to Markdown as it is
    summary = choice if "$" in choice else html.escape(choice)
    head = f'<details class="choice"><summary>\n\n{summary}\n\n</summary>'
    return f"{head}\n\n{words}\n\n</details>"
