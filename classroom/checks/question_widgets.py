"""Widgets for questions in a notebook: choices or a number, with a reason for each answer."""

import html
from dataclasses import dataclass

import ipywidgets

from classroom.coursework import progress_records
from slamlab.views.notebook_output import grouped, show_bundle, show_controls


@dataclass(frozen=True)
class Answer:
    """The result of judging an answer: whether it is right, and why."""

    right: bool
    reason: str


class Question:
    """A question in a notebook: its text, controls, and the reason for the answer.

    Text and reason are separate displays, so that the saved file contains both. judge : answer ->
    Answer. solution : the right answer and its reason"""

    def __init__(self, id, text, judge, solution):
        self.id, self._judge, self._solution = id, judge, solution
        self._text = text
        self._reason = None  # the display of the reason, once the question is shown

    def show(self, *controls):
        reveal = ipywidgets.Button(description="show me", tooltip="show the answer without a guess")
        reveal.on_click(lambda _: self.reveal())
        row = ipywidgets.HBox([*controls, reveal], layout=ipywidgets.Layout(flex_flow="row wrap"))
        show_bundle({"text/markdown": self._text, "text/plain": self._text})
        show_controls(row, "Run this cell to answer.")
        self._reason = show_bundle({"text/html": "", "text/plain": ""})

    def answer(self, given):
        """Judge an answer, show the reason, and record the answer in the progress."""
        answer = self._judge(given)
        shown = given if isinstance(given, str) else grouped(f"{given:.15g}")
        self._show_reason(f"{'✓' if answer.right else '✗'} {shown}: {answer.reason}")
        progress_records.record_answer(self.id, given, answer.right)

    def reveal(self):
        """Show the answer although the student has not guessed, and record nothing."""
        self._show_reason(self._solution)

    def _show_reason(self, text):
        # the labextension unfolds the cells that answer the question (answers.js)
        shown = f'<p data-slamlab-answered="{html.escape(self.id)}">{html.escape(text)}</p>'
        self._reason.update({"text/html": shown, "text/plain": text}, raw=True)


def by_letters(choices):
    return dict(zip("ABCDEFGH", choices, strict=False))


def wording(text, choices=None):
    """Format a question in Markdown: its text, then its choices with letters."""
    if choices is None:
        return text
    listed = "".join(f"\n- **{letter}** {choice}" for letter, choice in by_letters(choices).items())
    return f"{text}\n{listed}"


def solution(right, choices=None, unit="", reason=""):
    """Return the right answer and its reason as a sentence.

    choices : maps each choice to its reason; None for the number ``right``"""
    if choices is None:
        shown = f"{grouped(f'{right:.4g}')} {unit}".strip()
    else:
        shown, reason = "ABCDEFGH"[list(choices).index(right)], choices[right]
    return f"The answer is {shown}" + (f": {reason}" if reason else ".")


def ask_choice(id, text, choices, right):
    """Ask a question with a button for each choice. Raises ValueError.

    choices : maps each choice to the reason why it is right or wrong"""
    if len(choices) < 2 or right not in choices:
        raise ValueError(f"{id}: give at least two choices, including the right one")
    letters = by_letters(choices)
    reasons = {
        letter: Answer(choice == right, choices[choice]) for letter, choice in letters.items()
    }
    question = Question(id, wording(text, choices), reasons.__getitem__, solution(right, choices))
    buttons = []
    for letter, choice in letters.items():
        button = ipywidgets.Button(
            description=letter, tooltip=choice, layout=ipywidgets.Layout(width="4em")
        )
        button.on_click(lambda _, letter=letter: question.answer(letter))
        buttons.append(button)
    question.show(*buttons)
    return question


def ask_number(id, text, right, tolerance, unit, reason, wrong):
    """Ask for a number; ``wrong`` maps wrong numbers to reasons. Raises ValueError."""
    if not tolerance > 0 or any(abs(number - right) <= tolerance for number in wrong):
        raise ValueError(f"{id}: the tolerance must be positive and must not accept wrong numbers")

    def judge(given):
        if abs(given - right) <= tolerance:
            return Answer(True, reason)
        for number, why in wrong.items():
            if abs(given - number) <= tolerance:
                return Answer(False, why)
        text = f"off by more than {tolerance:g} {unit}".strip()
        return Answer(False, f"{text}. Run the next cells to see the answer.")

    question = Question(id, text, judge, solution(right, None, unit, reason))
    field = ipywidgets.FloatText(
        description=f"answer [{unit}]" if unit else "answer",
        style={"description_width": "initial"},
        layout=ipywidgets.Layout(width="14em"),
    )
    button = ipywidgets.Button(description="answer", tooltip="check this answer")
    button.on_click(lambda _: question.answer(field.value))
    question.show(field, button)
    return question
