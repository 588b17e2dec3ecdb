"""Digests (hashes) of a task's laws and of its worker's modules. Digests show whether a task is the
same in another version of the course.
"""

import functools
import hashlib

from classroom.exercises import fingerprints
from classroom.grading.import_closure import closure

DIGEST_LENGTH = 16  # hexadecimal digits
JUDGE_MODULES = ("classroom.exercises.run_task", "classroom.exercises.task")


def task_digest(task):
    """Return the digest of a task's inputs, laws and table of mistakes, which determine its
    verdicts.
    """
    description = task.id, task.title, task.needs, [_law(law) for law in task.all_laws]
    sources = _sources((*JUDGE_MODULES, *sorted(_modules(task))), False)
    parts = [repr(description), sources, _table(task)]
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()[:DIGEST_LENGTH]


def worker_digest(exercise):
    """Return the digest of the modules that a worker may import."""
    return _sources((exercise.calls, *exercise.allows), True)[:DIGEST_LENGTH]


def _law(law):
    return law.name, law.points, law.says, law.main, law.alone


def _modules(task):
    laws = [getattr(law, name) for law in task.laws for name in ("holds", "want")]
    mistakes = [mistake.matches for mistake in task.diagnoses]
    probes = [probe.inputs for probe in task.probes]
    made = [task.inputs, task.shapes, task.parts, *laws, *mistakes, *probes]
    return {function.__module__ for function in made if hasattr(function, "__module__")}


def _table(task):
    table = fingerprints.tables(task.id[:2]).get(task.id)
    if table is None:
        return ""
    numbers = b"".join(a.tobytes() for a in (table.prints, table.labels, table.where))
    texts = repr((table.names, table.hints, table.places))
    return hashlib.sha256(texts.encode() + numbers).hexdigest()


@functools.cache
def _sources(modules, with_packages):
    """Return the hash of the sources that some modules import, ignoring the package's version."""
    total = hashlib.sha256()
    for name, file in sorted(closure(modules, with_packages=with_packages).items()):
        if "." in name:
            total.update(f"{name}\0{file.read_text('utf-8')}\0".encode())
    return total.hexdigest()
