"""Scaffold a new task: a folder with its three files, and its place in the exercise."""

import keyword
import re

from course.task_programs import EXERCISES, folder_of

TASK = '''"""Task {id}: …"""

import numpy as np

from classroom.exercises.correctness_laws import equals
from classroom.exercises.task import Probe, Task
from course.exercises.{exercise}.calls import CALLS


def _steps(rng):
    """Random inputs: an array for each argument, one row for each call."""
    return {{"step": rng.uniform(-2, 2, (12, 3))}}


def _want(inputs):
    """The correct outputs."""
    return {{"result": np.hypot(*inputs["step"][:, :2].T)}}


def _squares(inputs):
    """Intermediate results, which the second hint shows."""
    return {{"squares of forward and left [m²]": inputs["step"][0, :2] ** 2}}


def _turn(rng):
    """An edge case that the task's text allows."""
    return {{"step": np.array([[0, 0, 1.0]])}}


{constant} = Task(
    id="{id}",
    title="…",
    call=CALLS["{id}"],
    inputs=_steps,
    shapes={{"result": ()}},  # of the output for one row
    probes=(Probe("a turn on the spot", _turn),),
    laws=(  # 2: the points
        equals(
            "length",
            2,
            "a turn adds no length",
            _want,
            asks="Does a turn move the robot?",
            step=_squares,
        ),
    ),
    begins=("How long is a step of 3 m forward and 4 m to the left?",),
)
'''
MISTAKES = """\
## no-root
? Which unit does your result have if the step is in metres?
The result is the square of the length. What is the length of a vector?
- np.hypot(step[0], step[1])
+ step[0] ** 2 + step[1] ** 2

## not judged: malformed
= def {name}(step):
|     return step
"""
ANSWERS = """\
# %% way: with the norm
def {name}(step):
    return np.linalg.norm(step[:2])

# %% right: an independent answer, written from the lesson and the text alone
def {name}(step):
    return (step[0] ** 2 + step[1] ** 2) ** 0.5

# %% wrong: an independent wrong answer
def {name}(step):
    return abs(step[0]) + abs(step[1])
"""
CELLS = '''# %% [markdown]
# ## {number} · …
#
# Complete `{name}`: …


# %% name="{id}-code"
def {name}(step):
    """The length of a step [x, y, θ] (m, m, rad) in m."""
    ### BEGIN SOLUTION
    return np.hypot(step[0], step[1])
    ### END SOLUTION


# %%
check("{id}")

'''
LAST = "# %% [markdown]\n"
"""Begins the last cell of a notebook, before which a task is added."""


class InvalidTask(Exception):
    """A name is invalid, or the exercise already has a task of this name."""


def begin(exercise, name):
    """Write the files of a new task, and enter it in its exercise, as an example that runs.

    Parameters
    ----------
    exercise : str, number such as "06"
    name : str, such as "gate" or "wall-gate"

    Returns
    -------
    list of Path : the files to edit

    Raises
    ------
    InvalidTask
    """
    if not re.fullmatch(r"[a-z][a-z0-9]*(-[a-z0-9]+)*", name) or keyword.iskeyword(name):
        raise InvalidTask(
            f"{name!r} is not a valid task name: use lower-case letters, such as wall-gate"
        )
    id, folder = f"{exercise}-{name}", folder_of(f"{exercise}-{name}")
    if folder.exists():
        raise InvalidTask(f"{id} already exists: {folder.relative_to(EXERCISES.parents[1])}")
    function, home = folder.name, folder.parent
    words = {"id": id, "name": function, "constant": function.upper(), "exercise": home.name}
    folder.mkdir()
    texts = {"task.py": TASK, "mistakes.txt": MISTAKES, "answers.py": ANSWERS}
    for file, text in texts.items():
        folder.joinpath(file).write_text(text.format(**words), "utf-8")
    _edit(home / "calls.py", r"\n}\n\Z", f'\n    "{id}": FunctionCall(("{function}",)),\n}}\n')
    _edit(home / "exercise.py", r"tasks=\(([^)]*?),?\)", rf"tasks=(\1, {words['constant']})")
    _import(
        home / "exercise.py", f"course.exercises.{home.name}.{function}.task", words["constant"]
    )
    notebook = home / "notebook.py"
    text = notebook.read_text("utf-8")
    words["number"] = len(re.findall(r"^# ## \d+ · ", text, re.MULTILINE)) + 1
    before, last, after = text.rpartition(LAST)
    notebook.write_text(before + CELLS.format(**words) + last + after, "utf-8")
    files = [home / name for name in ("notebook.py", "calls.py", "exercise.py")]
    return [*files, *(folder / file for file in texts)]


def _edit(file, pattern, new):
    text, count = re.subn(pattern, new, file.read_text("utf-8"), count=1)
    if not count:
        raise ValueError(f"{file}: there is no place for the task: {pattern!r} is not found")
    file.write_text(text, "utf-8")


def _import(file, module, name):
    """Add an import below the last import of the block that precedes it in the alphabet."""
    lines = file.read_text("utf-8").splitlines(keepends=True)
    before = [k for k, line in enumerate(lines) if line[:5] == "from " and line[5:] < module]
    lines.insert(before[-1] + 1 if before else 0, f"from {module} import {name}\n")
    file.write_text("".join(lines), "utf-8")
