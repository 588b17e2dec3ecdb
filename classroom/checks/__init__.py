"""Functions that notebooks call: ``check("04-h-robot")``, hint, ask, compare, attempt, validate.

Read in this order: this file; ``forbidden_imports`` (modules that grading lacks),
``syntax_errors``, ``timed_runs``, ``hint_levels``, ``question_widgets``, ``question_files``,
``typed_answers``, ``notebook_file``, ``validation``, ``setup_check``."""

import os
import sys

from classroom.exercises.function_calls import describe_exception

NOT_RUN = "missing"  # kind of problem in a fresh kernel: earned points stay


def check(task_id=None):
    """Check a task with the functions defined in the notebook, and print the verdict.

    task_id : str such as "04-h-robot". Returns None; under nbgrader the points as a float,
    which nbgrader reads as the cell's grade.
    """
    namespace = sys._getframe(1).f_globals
    points = _check(task_id, namespace)
    # nbgrader gives full marks to a check cell that neither raises nor has a value
    return points if "NBGRADER_EXECUTION" in os.environ else None


def hint(task_id=None):
    """Print the next hint for a task: a question, an intermediate result, what the mistake is.

    task_id : str such as "04-h-robot".
    """
    if "NBGRADER_EXECUTION" in os.environ:  # a grader needs no hint
        return
    from classroom.checks import hint_levels, syntax_errors, timed_runs
    from classroom.exercises import catalogue, time_limit

    task = _task(task_id)
    if task is None:
        return
    namespace, texts = sys._getframe(1).f_globals, []

    def judge_one(one, references):
        if one is not task:
            return timed_runs.run_task(one, namespace, references, explain=False)[0]
        with time_limit.capture_output():
            texts.append(hint_levels.next_hint(task, namespace, references))
        return task.failed("hint", texts[0])

    catalogue.exercise(task.id[:2]).verdicts(judge_one, only=[task.id])
    syntax_error = syntax_errors.describe_syntax_error(task.call.functions, _shell())
    print("\n".join(filter(None, [syntax_error, *texts])))


def ask(id, text=None, choices=None, right=None, *, tolerance=None, unit="", reason="", wrong=None):
    """Ask a multiple-choice or numeric question; the answer is not graded. Raises ValueError.

    Parameters
    ----------
    id : str such as "04-leaning", in an exercise "ex04-sign"; cells marked ``answers=id`` unfold
        when the question is answered
    text : str, Markdown; if None, everything except the id is read from a file
    choices : dict or None, choice to the reason why it is right or wrong; None asks for a number
    right : str or float
    tolerance : float, largest accepted error of the number
    unit, reason : str, for the right number
    wrong : dict or None, wrong number to the reason why it is wrong
    """
    if "NBGRADER_EXECUTION" in os.environ:  # nobody can answer
        return
    from classroom.checks import question_files, question_widgets

    if text is None:
        return ask(id, **question_files.load_question(id))
    if choices is not None:
        question_widgets.ask_choice(id, text, choices, right)
    else:
        question_widgets.ask_number(id, text, right, tolerance or 0.0, unit, reason, wrong or {})


def answers(ids):
    """Return the right answers to questions of the course, with their reasons, for the lecturer.

    ids : list of str such as "04-leaning". Returns a dict that maps ids to texts, without the
    questions that are stored nowhere.
    """
    from classroom.checks import question_files, question_widgets

    found = {}
    for id in ids:
        try:
            question = question_files.load_question(id)
        except ValueError:
            continue
        known = {name: question[name] for name in ("choices", "unit", "reason") if name in question}
        found[id] = question_widgets.solution(question["right"], **known)
    return found


def compare(yours, expected, tolerance=1e-6):
    """Print whether a value that the reader of a lesson computed is correct.

    Parameters
    ----------
    yours : number, array, or sympy expression or matrix; ``...`` if it is unanswered
    expected : the same kind of value
    tolerance : float, largest accepted difference of an entry, relative to the largest entry
    """
    from classroom.checks import typed_answers

    print(typed_answers.describe_difference(yours, expected, tolerance))


def validate():
    """Validate this notebook: run its saved file as grading does, and print its points."""
    if "NBGRADER_EXECUTION" in os.environ:  # nbgrader runs it already
        return
    from classroom.checks import validation

    validation.validate_current_notebook(sys._getframe(1).f_globals)


def attempt(function):
    """Call a function (or decorate it), and print a report if it fails or a task is unsolved.

    function : callable without arguments. Returns the function's return value, or None if it
    failed.
    """
    try:
        return function()
    except NotImplementedError:
        print("not attempted yet")
    except (Exception, SystemExit) as error:
        print(f"This cell stopped: {describe_exception(error)}")
    return None


def _task(task_id):
    # a late import: a notebook that only calls attempt() needs no laws
    from classroom.exercises import catalogue

    try:
        return catalogue.task(task_id)
    except KeyError as error:
        print(f"✗ {error.args[0]}")
        return None


def _offer_hint():
    shell = _shell()
    if shell is not None:
        shell.user_ns.setdefault("hint", hint)


def _shell():
    """Return IPython's shell without importing IPython, or None if it does not run."""
    return sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None


def _check(task_id, namespace):
    from classroom.checks import hint_levels, timed_runs
    from classroom.checks.forbidden_imports import find_forbidden_import
    from classroom.checks.syntax_errors import describe_syntax_error
    from classroom.coursework import progress_records
    from classroom.exercises import catalogue, verdict_text

    task = _task(task_id)
    if task is None:
        return 0.0
    printed, warned = {}, {}

    def judge_one(one, references):
        explain = one is task
        verdict, printed[one.id], warned[one.id] = timed_runs.run_task(
            one, namespace, references, explain
        )
        return verdict

    namespace.setdefault("hint", hint)  # the verdict may offer it
    exercise = catalogue.exercise(task.id[:2])
    verdict = exercise.verdicts(judge_one, only=[task.id])[task.id]
    if found := find_forbidden_import(task.call.functions, namespace, exercise):
        verdict = task.failed("borrowed", found)
    if error := describe_syntax_error(task.call.functions, _shell()):
        print(f"{error}\n")
    if printed.get(task.id):
        print(f"Your code printed:\n{printed[task.id]}\n")
    if warned.get(task.id):
        print(f"{warned[task.id]}\n")
    hint_levels.remember_check(task, verdict)
    at_once = hint_levels.shows_hint_at_once()
    print(verdict_text.coloured(verdict_text.format_verdict(task, verdict, at_once)))
    if verdict.kind != NOT_RUN:
        progress_records.record_check(task.id, float(verdict.points), float(task.points))
    if not verdict.full and (shows := hint_levels.describe_next_hint(task, verdict)):
        print(f'    hint("{task.id}") {shows}.')
    return float(min(verdict.points, task.points))


_offer_hint()
