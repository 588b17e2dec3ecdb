"""Questions of a notebook: choices or a number, a reason for each answer; none is graded."""

import html
from dataclasses import dataclass

import ipywidgets

from slamlab.coursework import progress_records
from slamlab.displays import grouped, show_bundle, show_controls


@dataclass(frozen=True)
class Answer:
    """What is said of an answer: whether it is right, and why."""

    right: bool
    reason: str


class Question:
    """A question on the page: its text, the controls to answer it, what is said of the answer.

    The text and the reason are displays of their own, so that a file keeps them.

    Parameters
    ----------
    id : str such as "04-leaning"
    text : str, Markdown
    judge : callable(answer) -> Answer
    """

    def __init__(self, id, text, judge):
        self.id, self._judge = id, judge
        self._text = text
        self._told = None  # the display of what is said, once it is shown

    def show(self, *controls):
        """Show text, controls with one that opens the answer, and an empty place for the reason.

        Parameters
        ----------
        controls : Widgets
        """
        tell = ipywidgets.Button(description="show me", tooltip="open the answer without guessing")
        tell.on_click(lambda _: self.tell())
        row = ipywidgets.HBox([*controls, tell], layout=ipywidgets.Layout(flex_flow="row wrap"))
        show_bundle({"text/markdown": self._text, "text/plain": self._text})
        show_controls(row, "Run this cell to answer.")
        self._told = show_bundle({"text/html": "", "text/plain": ""})

    def answer(self, given):
        """Take an answer: say what is to be said of it, and keep it in the progress.

        Parameters
        ----------
        given : str or float
        """
        answer = self._judge(given)
        shown = given if isinstance(given, str) else grouped(f"{given:.15g}")
        self._say(f"{'✓' if answer.right else '✗'} {shown}: {answer.reason}")
        progress_records.keep_answer(self.id, given, answer.right)

    def tell(self):
        """Open the answer to who does not want to guess; nothing is kept."""
        self._say("The cells below answer it.")

    def _say(self, said):
        # the labextension unfolds the cells that answer the question (answers.js)
        shown = f'<p data-slamlab-answered="{html.escape(self.id)}">{html.escape(said)}</p>'
        self._told.update({"text/html": shown, "text/plain": said}, raw=True)


def by_letters(choices):
    """The choices of a question by their letters; dict."""
    return dict(zip("ABCDEFGH", choices, strict=False))


def wording(text, choices=None):
    """What a question shows: its text and, below it, its choices by their letters.

    Parameters
    ----------
    text : str, Markdown
    choices : iterable of str, or None where a number is asked for

    Returns
    -------
    str, Markdown
    """
    if choices is None:
        return text
    listed = "".join(f"\n- **{letter}** {choice}" for letter, choice in by_letters(choices).items())
    return f"{text}\n{listed}"


def ask_choice(id, text, choices, right):
    """Ask a question with choices: a button each.

    Parameters
    ----------
    id : str
    text : str, Markdown
    choices : dict, choice to the reason why it is right or wrong, both plain text
    right : str, the right choice

    Returns
    -------
    Question

    Raises
    ------
    ValueError : fewer than two choices, or the right one is none of them
    """
    if len(choices) < 2 or right not in choices:
        raise ValueError(f"{id}: give two choices or more, the right one among them")
    letters = by_letters(choices)
    reasons = {
        letter: Answer(choice == right, choices[choice]) for letter, choice in letters.items()
    }
    question = Question(id, wording(text, choices), reasons.__getitem__)
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
    """Ask for a number: a field to type it in.

    Parameters
    ----------
    id : str
    text : str, Markdown
    right, tolerance : float
    unit : str
    reason : str, why it is the right one
    wrong : dict, a wrong number that somebody may have to the reason why it is wrong

    Returns
    -------
    Question

    Raises
    ------
    ValueError : a tolerance that is not positive, or a wrong number that would be right
    """
    if not tolerance > 0 or any(abs(number - right) <= tolerance for number in wrong):
        raise ValueError(f"{id}: a positive tolerance, which holds none of the wrong numbers")

    def judge(given):
        if abs(given - right) <= tolerance:
            return Answer(True, reason)
        for number, why in wrong.items():
            if abs(given - number) <= tolerance:
                return Answer(False, why)
        return Answer(False, f"off by more than {tolerance:g} {unit}".strip() + "; run and see")

    question = Question(id, text, judge)
    field = ipywidgets.FloatText(
        description=f"answer [{unit}]" if unit else "answer",
        style={"description_width": "initial"},
        layout=ipywidgets.Layout(width="14em"),
    )
    button = ipywidgets.Button(description="answer", tooltip="say whether this is right")
    button.on_click(lambda _: question.answer(field.value))
    question.show(field, button)
    return question
