"""A task: random inputs and edge cases (probes), functions to write, laws that judge outputs.

The judge uses this module; it sees no student code, only the returned arrays."""

import hashlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from classroom.exercises import outputs as came_back
from classroom.exercises.correctness_laws import Diagnosis, Law, Mistake, cache_within_judging
from classroom.exercises.function_calls import Arrays, FunctionCall, StudentError
from classroom.exercises.function_calls.changed_arguments import ARGUMENT_NAMES, CHANGED
from classroom.exercises.function_calls.run_and_pack import MAIN
from classroom.exercises.references import Reference
from classroom.exercises.verdict import LawResult, Verdict

OPEN_SEED = b"open"
"""The seed of a notebook's checks, whose inputs never change; grading has a secret seed."""

UNCHANGED = Law(
    "unchanged",
    0.5,
    "the arguments are unchanged after the call",
    lambda inputs, outputs: outputs[CHANGED].size == 0,
    asks="Which line writes into an array that the function was given? Where could it make a copy?",
    alone=False,
)
"""The law of every task: an argument that is changed in place corrupts the caller's data."""

IDLE = Mistake(
    "idle",
    "The answer is the same for all inputs, or it is one of the arguments. Compute it from the "
    "arguments.",
    asks="On which of the arguments does your answer depend, and on which should it depend?",
)
"""The mistake of a degenerate answer, which may obey a law by chance but earns nothing."""


@dataclass(frozen=True)
class Probe:
    """A probe: inputs at the limits of a task's specification (edge cases)."""

    name: str  # completes "with …": "an empty map"
    inputs: Callable[[np.random.Generator], dict[str, np.ndarray]]  # of any size
    laws: tuple[str, ...] | None = None  # names of the laws judged on it; None for all


@dataclass(frozen=True)
class Task:
    """A task: functions that a student writes, with inputs, probes, laws and diagnoses.

    parts : (inputs, outputs) -> name to array: outputs that can be wrong independently, in a form
    that all correct solutions share (angles wrapped, sets sorted); None for the outputs themselves.
    may_round : whether rounded inputs are valid inputs: bool, or inputs -> bool or (n,) bool."""

    id: str  # such as "04-h-robot"; stable, human
    title: str
    call: FunctionCall  # the worker's side
    inputs: Callable[[np.random.Generator], dict[str, np.ndarray]]  # generic
    shapes: Mapping | Callable[[Arrays], Mapping]  # by output, None for any length
    laws: tuple[Law, ...]  # a right solution obeys all of them
    diagnoses: tuple[Diagnosis, ...] = ()  # tried in order if a law fails on their set
    needs: tuple[str, ...] = ()  # earlier tasks whose functions a solution calls
    references: tuple[Reference, ...] = ()  # right functions, for the tasks that need this one
    begins: tuple[str, ...] = ()  # questions that help to begin, for hint
    probes: tuple[Probe, ...] = ()  # edge cases
    parts: Callable[[Arrays, Arrays], Arrays] | None = None
    may_round: bool | Callable[[Arrays], np.ndarray | bool] = True

    @property
    def all_laws(self):
        return (*self.laws, UNCHANGED)

    @property
    def points(self):
        return sum(law.points for law in self.all_laws)

    def draw_inputs(self, seed: bytes) -> dict[str, dict[str, np.ndarray]]:
        """Draw the sets of inputs of a seed, by name: ``MAIN`` first, then the probes."""
        digest = hashlib.sha256(seed + b"\0" + self.id.encode()).digest()
        rng = np.random.default_rng(np.frombuffer(digest, dtype="<u4"))
        return {MAIN: self.inputs(rng)} | {probe.name: probe.inputs(rng) for probe in self.probes}

    def are_inputs(self, inputs) -> bool:
        """Whether (perhaps rounded) inputs are valid inputs of this task."""
        if not callable(self.may_round):
            return self.may_round
        with np.errstate(all="ignore"):
            return bool(np.all(_safely(self.may_round, inputs)))

    def judges(self, law, name):
        """Whether a law is judged on the set with this name."""
        if name == MAIN:
            return law.main
        laws = next(probe.laws for probe in self.probes if probe.name == name)
        return law is UNCHANGED or (law.main if laws is None else law.name in laws)

    def sets_judged(self, law_name):
        names = (MAIN, *(probe.name for probe in self.probes))
        laws = [law for law in self.all_laws if law.name == law_name]
        return sum(self.judges(law, name) for law in laws for name in names)

    def failed(self, kind, problem) -> Verdict:
        return Verdict(self.id, 0.0, self.points, problem=problem, kind=kind)

    def judge(self, sets: Mapping[str, Arrays], answers: Mapping) -> Verdict:
        """Judge outputs by the laws, and diagnose mistakes.

        answers : the outputs of :attr:`call` (untrusted) or its StudentError, by name of the set"""
        found = came_back.all_checked_outputs(self, sets, answers)
        if isinstance(found[MAIN], StudentError):
            return self.failed(found[MAIN].kind, found[MAIN].message)
        with np.errstate(all="ignore"), cache_within_judging():
            idle = came_back.is_degenerate(sets[MAIN], found[MAIN])
            results = tuple(self._result(law, sets, found) for law in self.all_laws)
            if idle:
                results = self._of_nothing(results)
            own = results[: len(self.laws)]
            wrong = {name for result in own for name in result.where}
            suspected = (d for d in self.diagnoses if d.on in wrong)
            matching = (d for d in suspected if _safely(d.matches, sets[d.on], found[d.on]))
            mistake = next(matching, IDLE if idle else None)
        results = self._worth_something(results)
        earned = sum(result.points for result in results)
        verdict = Verdict(self.id, earned, self.points, results)
        return verdict.explained_by(mistake) if mistake else verdict

    def _of_nothing(self, results):
        """Remove the points of a degenerate answer, and fail it even if it obeys all laws."""
        *own, unchanged = (replace(result, points=0.0) for result in results)
        if not any(result.failed for result in own):
            own = [replace(result, failed=result.tried, where={MAIN: None}) for result in own]
        return (*own, unchanged)

    def _worth_something(self, results):
        """Remove the points of ``alone=False`` laws if no other law earns points."""
        pairs = zip(self.all_laws, results, strict=True)
        if any(result.points for law, result in pairs if law.alone):
            return results
        return tuple(replace(result, points=0.0) for result in results)

    def _result(self, law, sets, found):
        failed = tried = 0
        where = {}
        for name, outputs in found.items():
            if not self.judges(law, name):
                continue
            lost = self.broken(law, sets[name], outputs)
            tried, failed = tried + lost.size, failed + int(lost.sum())
            if lost.any():
                where[name] = outputs.message if isinstance(outputs, StudentError) else None
        points = 0.0 if failed else law.points
        says = law.says
        if law is UNCHANGED and (changed := self._changed(sets, found)):
            says += f", but {' and '.join(changed)} changed"
        return LawResult(law.name, says, points, law.points, failed, tried, where)

    def _changed(self, sets, found):
        names = ARGUMENT_NAMES.get(self.id) or list(sets[MAIN])
        all_changed = [of[CHANGED] for of in found.values() if not isinstance(of, StudentError)]
        return [name for k, name in enumerate(names) if any(np.any(of == k) for of in all_changed)]

    def broken(self, law, inputs, outputs):
        """Return (n,) bool: whether each input breaks a law; or (1,) if sets are judged whole."""
        if isinstance(outputs, StudentError):
            return np.array([law is not UNCHANGED])  # a failed call does not break UNCHANGED
        holds = _safely(law.holds, inputs, outputs)
        return ~np.atleast_1d(np.asarray(holds, dtype=bool))


def _safely(claim, *arrays):
    # malformed outputs can make a decomposition, an index or a size fail: then no law holds
    try:
        return claim(*arrays)
    except Exception:
        return False
