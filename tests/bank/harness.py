"""Runs the entries of the bank over many seeds and says how they came out."""

import ast
import contextlib
import importlib
import io
import json
import pkgutil
import re
import warnings
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import tests.bank
from slamlab.exercises import catalogue
from slamlab.exercises.exercise import Exercise
from slamlab.exercises.run_task import run
from tests.bank import Right, Wrong

ROOT = Path(__file__).resolve().parents[2]


@dataclass(frozen=True)
class Bank:
    """The entries of one exercise, on the base they differ from."""

    exercise: Exercise
    base: tuple[str, ...]
    wrong: tuple[Wrong, ...]
    right: tuple[Right, ...]

    @property
    def entries(self):
        """All of them, the base itself first."""
        return (Right("the solution", ""), *self.right, *self.wrong)


def banked():
    """The numbers of the exercises that have a bank."""
    names = (re.fullmatch(r"ex(\d\d)", m.name) for m in pkgutil.iter_modules(tests.bank.__path__))
    return sorted(match[1] for match in names if match)


def load(id) -> Bank:
    """The bank of an exercise."""
    module = importlib.import_module(f"tests.bank.ex{id}")
    exercise = catalogue.exercise(id)
    base = (module.BASE,) if hasattr(module, "BASE") else _solution(exercise)
    return Bank(exercise, base, tuple(module.WRONG), tuple(module.RIGHT))


def _solution(exercise):
    notebook = json.loads((ROOT / "solutions" / exercise.file).read_text("utf-8"))
    cells = ("".join(c["source"]) for c in notebook["cells"] if c["cell_type"] == "code")
    return tuple(c for c in cells if not c.lstrip().startswith(("check(", "%", "!")))


def namespace(bank, entry):
    """The names a notebook with that solution in it would define."""
    names = {"__name__": "__main__"}
    with contextlib.redirect_stdout(io.StringIO()):
        for source in (*bank.base, entry.code):
            # attempts draw pictures, which no task looks at
            source = re.sub(r"^from slamlab\.checks import .*$", _STUBS, source, flags=re.M)
            exec(compile(source, f"<cell {entry.name}>", "exec"), names)
    return names


_STUBS = "check = attempt = validate = lambda *_: None"


def verdicts(bank, names, seed, only=None):
    """What the judge says of the tasks, with the inputs of one seed."""
    seed = f"bank {seed}".encode()
    with np.errstate(all="ignore"), warnings.catch_warnings(action="ignore"):
        return bank.exercise.verdicts(lambda task: run(task, names, task.draw(seed)), only)


def touched(bank, entry):
    """The tasks one of whose functions the entry defines."""
    defined = set()
    for node in ast.walk(ast.parse(entry.code)):
        if isinstance(node, ast.FunctionDef):
            defined.add(node.name)
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            defined.add(node.id)
    return [t for t in bank.exercise.tasks if defined.intersection(t.drive.functions)]


def expected(bank, entry):
    """The (task, law) pairs an entry must lose, those lost by needs included."""
    tasks, own = bank.exercise.tasks, touched(bank, entry)
    must = set()
    for item in entry.loses:
        whole = [(t.id, law.name) for t in tasks if t.id == item for law in t.laws]
        exact = [(t.id, law.name) for t in tasks for law in t.laws if f"{t.id}:{law.name}" == item]
        named = [(t.id, law.name) for t in own for law in t.laws if law.name == item]
        if not whole + exact + named:
            raise ValueError(f"{entry.name}: no law or task {item!r} among those it defines")
        must.update(whole + exact + named)
    for task in tasks:  # in order, so that a need of a need counts as well
        if set(task.needs) & {id for id, _ in must}:
            must.update((task.id, law.name) for law in task.laws)
    return must


def lost(bank, found):
    """The (task, law) pairs that verdicts took points for."""
    pairs = set()
    for task in bank.exercise.tasks:
        verdict = found.get(task.id)
        if verdict and verdict.problem:
            pairs.update((task.id, law.name) for law in task.laws)
        elif verdict:
            pairs.update((task.id, law.name) for law in verdict.laws if law.failed)
    return pairs


def wrongness(bank, entry, must, found):
    """How the verdicts on an entry differ from what they should be; None when they do not."""
    gone = lost(bank, found)
    luck = {tuple(item.split(":")) for item in entry.may_lose}
    luck |= {(task.id, "unchanged") for task in bank.exercise.tasks}
    if not must <= gone <= must | luck:
        said = "; ".join(f"{v.task}: {v.problem}" for v in found.values() if v.problem)
        return f"lost {sorted(gone)} instead of {sorted(must)} {said}"
    for verdict in found.values():
        if verdict.solved or verdict.kind == "needs":
            continue
        if (verdict.diagnosis, verdict.kind) != (entry.diagnosis, entry.problem):
            return (
                f"{verdict.task}: diagnosis {verdict.diagnosis}, problem {verdict.kind}: "
                f"{verdict.problem}; expected {entry.diagnosis}, {entry.problem}"
            )
    return None


def missed(bank, entry, seeds):
    """The seeds of which an entry came out otherwise than it should, with how.

    Parameters
    ----------
    seeds : int, seeds 0, 1, … are tried

    Returns
    -------
    seed to str
    """
    names, must, bad = namespace(bank, entry), expected(bank, entry), {}
    only = None
    for seed in range(seeds):
        found = verdicts(bank, names, seed, only)
        how = wrongness(bank, entry, must, found)
        if how:
            bad[seed] = how
        if only is None and entry.code:  # a task it does not touch runs the base: once is enough
            only = {t.id for t in touched(bank, entry)} | {
                v.task for v in found.values() if not v.full
            }
    return bad
