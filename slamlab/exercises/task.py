"""Task: random inputs and probes, a student's functions, and the laws their outputs are judged by.

This is the autograder's side, the judge's. It never sees student code, only the arrays that came
out of it.
"""

import hashlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from slamlab.exercises import outputs as came_back
from slamlab.exercises.drives import Arrays, Drive, StudentError
from slamlab.exercises.drives.arguments import CHANGED, NAMES
from slamlab.exercises.drives.input_sets import MAIN
from slamlab.exercises.law import Diagnosis, Law, Mistake, one_judging
from slamlab.exercises.verdict import LawResult, Verdict

OPEN_SEED = b"open"
"""The open seed: inputs in a notebook are the same at every check; grading has a secret seed."""

UNCHANGED = Law(
    "unchanged",
    0.5,
    "the arguments are after the call what they were before it",
    lambda inputs, outputs: outputs[CHANGED].size == 0,
    asks="Which line writes into an array that was given to the function? Where could it take a "
    "copy?",
    alone=False,
)
"""The law of every task: what is changed in place spoils what the caller does next."""

IDLE = Mistake(
    "idle",
    "Whatever it is given, the answer is the same or is one of the arguments: compute it from "
    "them.",
)
"""What is said of a degenerate answer: it may obey a law by chance, but earns nothing."""


@dataclass(frozen=True)
class Probe:
    """A probe: inputs at the edge of what a task promises, such as an empty map.

    Parameters
    ----------
    name : str, completes "with …": "an empty map"
    inputs : rng -> name to array; sizes are its own
    laws : names of the laws that are judged on it; None for all
    """

    name: str
    inputs: Callable[[np.random.Generator], dict[str, np.ndarray]]
    laws: tuple[str, ...] | None = None


@dataclass(frozen=True)
class Task:
    """A task: functions that a student writes, with inputs, probes, laws and diagnoses.

    Parameters
    ----------
    id : str, such as "04-h-robot"; stable, human
    title : str
    drive : Drive, the worker's side
    inputs : rng -> name to array; generic ones, so that no two mistakes look alike
    shapes : output name to shape, None for any length; or inputs -> such a dict
    laws : what a right solution obeys
    diagnoses : mistakes told by a property of the outputs, tried in order where a law failed on
        the set that they look at
    needs : ids of earlier tasks of the exercise that must be solved first
    probes : edges of what is promised
    parts : (inputs, outputs) -> name to array: what can be wrong by itself, in a form all right
        solutions share (angles wrapped, sets sorted), for recognising slips; None: the outputs
    rounds : whether inputs stay inputs when their numbers are rounded, for showing a case: bool, or
        inputs -> bool or (n,) bool, whether they keep what the task's text promises
    """

    id: str
    title: str
    drive: Drive
    inputs: Callable[[np.random.Generator], dict[str, np.ndarray]]
    shapes: Mapping | Callable[[Arrays], Mapping]
    laws: tuple[Law, ...]
    diagnoses: tuple[Diagnosis, ...] = ()
    needs: tuple[str, ...] = ()
    probes: tuple[Probe, ...] = ()
    parts: Callable[[Arrays, Arrays], Arrays] | None = None
    rounds: bool | Callable[[Arrays], np.ndarray | bool] = True

    @property
    def all_laws(self):
        """Its own laws, and that of the arguments."""
        return (*self.laws, UNCHANGED)

    @property
    def points(self):
        """The maximum score of the task."""
        return sum(law.points for law in self.all_laws)

    def draw(self, seed: bytes) -> dict[str, dict[str, np.ndarray]]:
        """Draw the sets of inputs of a seed (the open seed in a notebook, a secret one at grading).

        Parameters
        ----------
        seed : bytes; the same for all tasks of a submission

        Returns
        -------
        set's name (``MAIN``, then the probes') to name to array
        """
        digest = hashlib.sha256(seed + b"\0" + self.id.encode()).digest()
        rng = np.random.default_rng(np.frombuffer(digest, dtype="<u4"))
        return {MAIN: self.inputs(rng)} | {probe.name: probe.inputs(rng) for probe in self.probes}

    def are_inputs(self, inputs) -> bool:
        """Whether inputs, perhaps rounded ones, keep what the task's text promises."""
        if not callable(self.rounds):
            return self.rounds
        with np.errstate(all="ignore"):
            return bool(np.all(_safely(self.rounds, inputs)))

    def judges(self, law, name):
        """Whether a law is judged on a set of inputs: on ``MAIN``, or on a probe by its name."""
        if name == MAIN:
            return law.main
        laws = next(probe.laws for probe in self.probes if probe.name == name)
        return law is UNCHANGED or (law.main if laws is None else law.name in laws)

    def sets_judged(self, law_name):
        """On how many sets of inputs a law is judged, by its name; none where there is no such."""
        names = (MAIN, *(probe.name for probe in self.probes))
        laws = [law for law in self.all_laws if law.name == law_name]
        return sum(self.judges(law, name) for law in laws for name in names)

    def failed(self, kind, problem) -> Verdict:
        """The verdict of a failure: no outputs that can be judged.

        Parameters
        ----------
        kind, problem : str

        Returns
        -------
        Verdict
        """
        return Verdict(self.id, 0.0, self.points, problem=problem, kind=kind)

    def judge(self, sets: Mapping[str, Arrays], answers: Mapping) -> Verdict:
        """Judge the outputs of a student's functions by the laws, and diagnose mistakes.

        Parameters
        ----------
        sets : what :meth:`draw` made
        answers : set's name to what :attr:`drive` brought back, or to the StudentError it met; not
            to be trusted

        Returns
        -------
        Verdict
        """
        found = came_back.all_measured(self, sets, answers)
        if isinstance(found[MAIN], StudentError):
            return self.failed(found[MAIN].kind, found[MAIN].message)
        with np.errstate(all="ignore"), one_judging():
            idle = came_back.degenerate(sets[MAIN], found[MAIN])
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
        named = (mistake.name, mistake.hint) if mistake else (None, None)
        return Verdict(self.id, earned, self.points, results, *named)

    def _of_nothing(self, results):
        """Results of a degenerate answer: a law that it obeys by chance holds, and earns nothing;
        one that obeys all of them is refused."""
        *own, unchanged = (replace(result, points=0.0) for result in results)
        if not any(result.failed for result in own):
            own = [replace(result, failed=result.tried, where={MAIN: None}) for result in own]
        return (*own, unchanged)

    def _worth_something(self, results):
        """Results of which those of laws that earn nothing alone earn beside others only."""
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
        """The names of the arguments that were changed in some call."""
        names = NAMES.get(self.id) or list(sets[MAIN])
        told = [of[CHANGED] for of in found.values() if not isinstance(of, StudentError)]
        return [name for k, name in enumerate(names) if any(np.any(which == k) for which in told)]

    def broken(self, law, inputs, outputs):
        """(n,) bool, which inputs of a set broke a law; one entry where it is judged as a whole."""
        if isinstance(outputs, StudentError):
            return np.array([law is not UNCHANGED])  # a call that fails has changed nothing by that
        holds = _safely(law.holds, inputs, outputs)
        return ~np.atleast_1d(np.asarray(holds, dtype=bool))


def _safely(claim, *arrays):
    # what came back can be such that a decomposition, an index or a size fails: then nothing holds
    try:
        return claim(*arrays)
    except Exception:
        return False
