"""Checks of the exercises, for notebooks: ``check("04-h-robot")``, hint, ask, attempt, validate.

Read in this order:

- here: check, hint, ask, attempt, validate
- ``borrowed``: what a student took from the package that grading does not hold
- ``unread_cells``: a syntax error, behind which an older function is judged
- ``ladder``: what hint says; ``questions``: what ask shows, ``stored_questions``: of lessons
- ``notebook_file``: where this notebook stands, what of it is not saved
- ``validation``: a whole notebook judged as grading judges it
- ``setup_check``: whether this machine has what the course needs
"""

import os
import sys
import warnings
from difflib import get_close_matches

from slamlab.exercises.drives import describe

WARNINGS = 3  # of Python's that a check tells
NOT_RUN = ("missing", "needs")  # kinds of a problem in a fresh kernel: what was earned stays


def check(task_id=None):
    """Check a task on the functions defined in the notebook and print the verdict.

    Parameters
    ----------
    task_id : str such as "04-h-robot"

    Returns
    -------
    None; under nbgrader the points as a float, which it reads as the cell's grade
    """
    namespace = sys._getframe(1).f_globals
    points = _check(task_id, namespace)
    # nbgrader gives full marks to a check cell that neither raises nor has a value
    return points if "NBGRADER_EXECUTION" in os.environ else None


def hint(task_id=None):
    """Print a hint on a task, at each call one rung further: a question, then a step on the way.

    Parameters
    ----------
    task_id : str such as "04-h-robot"
    """
    if "NBGRADER_EXECUTION" in os.environ:  # a grader has no use for it
        return
    from slamlab.checks import ladder, unread_cells
    from slamlab.exercises import time_limit

    task = _task(task_id)
    if task is None:
        return
    unread = unread_cells.unread(task.drive.functions, _shell())
    with time_limit.capture_output():
        try:
            said = ladder.next_rung(task, sys._getframe(1).f_globals)
        except time_limit.TimeLimitExceeded:
            said = _too_slow(task)
    print("\n".join(filter(None, [unread, said])))


def ask(id, text=None, choices=None, right=None, *, tolerance=None, unit="", reason="", wrong=None):
    """Ask a question of a notebook, with choices or for a number; the answer opens what follows.

    Each answer gets its reason. It goes into the progress and nowhere else: nothing is graded.

    Parameters
    ----------
    id : str such as "04-leaning", of an exercise "ex04-sign"; a cell that is marked
        ``answers="04-leaning"`` opens when it is answered
    text : str, the question, Markdown; None: all but the id is stored, as of the whole course
    choices : dict or None, choice to the reason why it is right or wrong; None asks for a number
    right : str or float, the right choice or number
    tolerance : float, how far a number may be off
    unit : str, of the number
    reason : str, why the number is right
    wrong : dict or None, a number that somebody may have to the reason why it is wrong

    Raises
    ------
    ValueError : choices without the right one, a number without a tolerance, an unknown id
    """
    if "NBGRADER_EXECUTION" in os.environ:  # nobody is there to answer
        return
    from slamlab.checks import questions, stored_questions

    if text is None:
        return ask(id, **stored_questions.stored_question(id))
    if choices is not None:
        questions.ask_choice(id, text, choices, right)
    else:
        questions.ask_number(id, text, right, tolerance or 0.0, unit, reason, wrong or {})


def validate():
    """Validate this notebook: run its saved file as grading will, and print what it earns."""
    if "NBGRADER_EXECUTION" in os.environ:  # nbgrader is at it already
        return
    from slamlab.checks import validation

    validation.validate_current_notebook(sys._getframe(1).f_globals)


def attempt(function):
    """Attempt to call a function at once; where something it needs is unsolved, say so and go on.

    Also a decorator: the cell then shows what the function displays.

    Parameters
    ----------
    function : callable without arguments

    Returns
    -------
    what the function returns, None where it could not
    """
    try:
        return function()
    except NotImplementedError:
        print("not attempted yet")
    except (Exception, SystemExit) as error:
        print(f"this cell could not go on: {describe(error)}")
    return None


def _task(task_id):
    """The task of an id; None, and said so, where there is none."""
    # imported late: a notebook that only attempts needs no laws
    from slamlab.exercises import catalogue

    try:
        return catalogue.task(task_id)
    except KeyError as error:
        print(f"✗ {error.args[0]}")
        return None


def _offer_hint():
    """Put hint among a notebook's names: exercises tell of it before the first check."""
    shell = _shell()
    if shell is not None:
        shell.user_ns.setdefault("hint", hint)


def _shell():
    """IPython's shell, without importing it; None outside of a notebook."""
    return sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None


def _check(task_id, namespace):
    from slamlab.checks import ladder
    from slamlab.checks.borrowed import borrowed
    from slamlab.checks.unread_cells import unread
    from slamlab.coursework import progress_records
    from slamlab.exercises import catalogue, report

    task = _task(task_id)
    if task is None:
        return 0.0
    printed, warned = {}, {}

    def judge_one(one):
        verdict, printed[one.id], warned[one.id] = _run(one, namespace, tell=one is task)
        return verdict

    namespace.setdefault("hint", hint)  # what a check offers is there to be called
    exercise = catalogue.exercise(task.id[:2])
    verdict = exercise.verdicts(judge_one, only=[task.id])[task.id]
    if taken := borrowed(task.drive.functions, namespace, exercise.answers):
        problem = f"{taken}, which answers this exercise: at grading it is not there"
        verdict = task.failed("borrowed", problem)
    if said := unread(task.drive.functions, _shell()):
        print(f"{said}\n")
    if printed.get(task.id):
        print(f"your code printed:\n{printed[task.id]}\n")
    if warned.get(task.id):
        print(f"{warned[task.id]}\n")
    print(report.coloured(report.format_verdict(task, verdict)))
    if verdict.kind not in NOT_RUN:
        progress_records.keep_check(task.id, float(verdict.points), float(task.points))
    if not verdict.full and (offered := ladder.offered(task, verdict)):
        print(f'    hint("{task.id}") {offered}.')
    return float(min(verdict.points, task.points))


def _run(task, namespace, tell):
    from slamlab.exercises import time_limit
    from slamlab.exercises.run_task import run, run_and_tell
    from slamlab.exercises.task import OPEN_SEED

    if not time_limit.can_limit_time():
        print("no time limit can be set here: should the check hang, interrupt the kernel")
    with time_limit.capture_output() as printed, warnings.catch_warnings(record=True) as caught:
        try:
            with time_limit.time_limit(task.drive.seconds):
                if tell:
                    verdict = run_and_tell(task, namespace)
                else:
                    verdict = run(task, namespace, task.draw(OPEN_SEED))
            if verdict.kind == "missing" and verdict.problem.endswith("is not defined"):
                near = get_close_matches(verdict.problem.split()[0], namespace, n=1, cutoff=0.8)
                meant = f"; there is {near[0]}: is it meant?" if near else ""
                problem = f"{verdict.problem} yet: run the cell above{meant}"
                verdict = task.failed("missing", problem)
        except time_limit.TimeLimitExceeded:
            verdict = task.failed("time", _too_slow(task))
        except KeyboardInterrupt:
            verdict = task.failed("stopped", "stopped before it was done")
    return verdict, printed.text, _told(caught)


def _too_slow(task):
    return f"still running after {task.drive.seconds:g} s: an endless loop, or too slow"


def _told(caught):
    """What Python warned of, each thing once; "" where it did not."""
    from slamlab.exercises.case_text import wrapped
    from slamlab.exercises.drives import place

    said = dict.fromkeys(
        f"{each.category.__name__}: {each.message}{place(each.filename, each.lineno)}"
        for each in caught
    )
    lines = [wrapped(f"Python warned: {one}") for one in list(said)[:WARNINGS]]
    if len(said) > WARNINGS:
        lines.append(f"… and of {len(said) - WARNINGS} more")
    return "\n".join(lines)


_offer_hint()
