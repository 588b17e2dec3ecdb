"""Runs the entries of the bank over many seeds and says how they came out."""

import ast
import contextlib
import importlib
import io
import json
import pkgutil
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import tests.bank
from slamlab.checks import catalogue
from slamlab.checks.task import Exercise
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
    notebook = json.loads((ROOT / "solutions" / f"{exercise.notebook}.ipynb").read_text("utf-8"))
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


_STUBS = "check = attempt = lambda *_: None"


def verdicts(bank, names, seed):
    """What the judge says of all tasks, with the inputs of one seed."""
    seed = f"bank {seed}".encode()
    return bank.exercise.verdicts(lambda task: task.run(names, task.draw(seed)))


def touched(bank, entry):
    """The tasks one of whose functions the entry defines."""
    tree = ast.parse(entry.code)
    defined = {n.name for n in ast.walk(tree) if isinstance(n, ast.FunctionDef)}
    defined |= {n.id for n in ast.walk(tree) if isinstance(n, ast.Name)}
    return [t for t in bank.exercise.tasks if defined.intersection(t.drive.functions)]


def expected(bank, entry):
    """The (task, law) pairs an entry must lose, those lost by needs included."""
    tasks, own = bank.exercise.tasks, touched(bank, entry)
    lost = set()
    for item in entry.loses:
        whole = [(t.id, law.name) for t in tasks if t.id == item for law in t.laws]
        exact = [(t.id, law.name) for t in tasks for law in t.laws if f"{t.id}:{law.name}" == item]
        named = [(t.id, law.name) for t in own for law in t.laws if law.name == item]
        if not whole + exact + named:
            raise ValueError(f"{entry.name}: no law or task {item!r} among those it defines")
        lost.update(whole + exact + named)
    for task in tasks:  # in order, so that a need of a need counts as well
        if set(task.needs) & {t for t, _ in lost}:
            lost.update((task.id, law.name) for law in task.laws)
    return lost


def lost(found):
    """The (task, law) pairs that were lost, and those among them that a law itself took."""
    laws = {(v.task, law.name) for v in found.values() for law in v.laws if law.failed}
    tasks = {v.task for v in found.values() if v.problem}
    return laws, tasks


def wrongness(bank, entry, names, seed):
    """How the verdicts on an entry differ from what they should be; None when they do not."""
    found = verdicts(bank, names, seed)
    laws, failed = lost(found)
    all_lost = laws | {
        (t.id, x.name) for t in bank.exercise.tasks if t.id in failed for x in t.laws
    }
    must = expected(bank, entry)
    if all_lost != must:
        said = "; ".join(f"{v.task}: {v.problem}" for v in found.values() if v.problem)
        return f"lost {sorted(all_lost)} instead of {sorted(must)} {said}"
    for verdict in found.values():
        if verdict.full or verdict.kind == "needs":
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
    names = namespace(bank, entry)
    with np.errstate(all="ignore"):
        tried = ((seed, wrongness(bank, entry, names, seed)) for seed in range(seeds))
        return {seed: how for seed, how in tried if how}
