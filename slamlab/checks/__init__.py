"""Checks of the exercises, for notebooks: ``check("04-h-robot")``, ``attempt`` and ``validate``."""

import os
import sys

from slamlab.checks.drives import describe

OPEN_SEED = b"open"
"""Inputs in a notebook are the same at every check; grading draws its own."""


def check(task_id):
    """Run a task on the functions defined in the notebook and print the verdict.

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


def validate():
    """Run this notebook, as it stands in its file, as grading will, and print what it earns."""
    if "NBGRADER_EXECUTION" in os.environ:  # nbgrader is at it already
        return
    from slamlab.checks import validation

    validation.validate_running(sys._getframe(1).f_globals)


def attempt(function):
    """Call a function at once; where it rests on something unsolved, say so and go on.

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


def _check(task_id, namespace):
    # imported late: a notebook that only attempts needs no laws
    from slamlab.checks import catalogue, report

    try:
        exercise = catalogue.exercise(str(task_id)[:2])
        task = catalogue.task(task_id)
    except KeyError as error:
        print(f"✗ {error.args[0]}")
        return 0.0
    printed = {}

    def judge_one(one):
        verdict, printed[one.id] = _run(one, namespace)
        return verdict

    verdict = exercise.verdicts(judge_one, only=[task.id])[task.id]
    if printed.get(task.id):
        print(f"your code printed:\n{printed[task.id]}\n")
    print(report.say(task, verdict))
    return float(min(verdict.points, task.points))


def _run(task, namespace):
    from slamlab.checks import limits

    if not limits.can_limit_time():
        print("no time limit can be set here: should the check hang, interrupt the kernel")
    with limits.printing_kept() as printed:
        try:
            with limits.time_limit(task.drive.seconds):
                verdict = task.run(namespace, task.draw(OPEN_SEED))
            if verdict.kind == "missing":
                verdict = task.failed("missing", f"{verdict.problem} yet: run the cell above")
        except limits.OutOfTime:
            verdict = task.failed("time", f"still running after {task.drive.seconds:g} s")
        except KeyboardInterrupt:
            verdict = task.failed("stopped", "stopped before it was done")
    return verdict, printed.text
