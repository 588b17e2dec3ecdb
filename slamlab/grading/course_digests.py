"""Digests of the course: which laws judged a task, and what its worker held.

A version's number says when the course was released; these say whether a task is still the same.
"""

import functools
import hashlib

from slamlab.exercises import fingerprints
from slamlab.grading.import_closure import closure

SHOWN = 16  # hexadecimal digits
JUDGES = ("slamlab.exercises.run_task", "slamlab.exercises.task")


def task_digest(task):
    """The digest of what judges a task: its inputs, its laws, the table of its mistakes.

    Parameters
    ----------
    task : Task

    Returns
    -------
    str
    """
    told = task.id, task.title, task.needs, [_law(law) for law in task.all_laws]
    parts = [repr(told), _sources((*JUDGES, *sorted(_modules(task))), False), _table(task)]
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()[:SHOWN]


def worker_digest(exercise):
    """The digest of the course's modules that a worker holds, by which answers come about.

    Parameters
    ----------
    exercise : Exercise

    Returns
    -------
    str
    """
    return _sources((exercise.drives, *exercise.allows), True)[:SHOWN]


def _law(law):
    return law.name, law.points, law.says, law.main, law.alone


def _modules(task):
    """The modules in which the functions of a task are defined."""
    laws = [getattr(law, name) for law in task.laws for name in ("holds", "want")]
    mistakes = [mistake.matches for mistake in task.diagnoses]
    probes = [probe.inputs for probe in task.probes]
    made = [task.inputs, task.shapes, task.parts, *laws, *mistakes, *probes]
    return {function.__module__ for function in made if hasattr(function, "__module__")}


def _table(task):
    """The hash of what recognises a task's mistakes."""
    table = fingerprints.tables(task.id[:2]).get(task.id)
    if table is None:
        return ""
    numbers = table.prints.tobytes() + table.labels.tobytes()
    return hashlib.sha256(repr((table.names, table.hints)).encode() + numbers).hexdigest()


@functools.cache
def _sources(modules, with_packages):
    """The hash of the modules that some modules import; the package's version is none of it."""
    total = hashlib.sha256()
    for name, file in sorted(closure(modules, with_packages=with_packages).items()):
        if "." in name:
            total.update(f"{name}\0{file.read_text('utf-8')}\0".encode())
    return total.hexdigest()
