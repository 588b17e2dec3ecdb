"""Task, law and diagnosis: random inputs, a student's functions, property-based tests (laws).

This is the autograder's side, the judge's. It never sees student code, only the arrays that came out of it.
"""

import hashlib
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from slamlab.exercises.drives import Arrays, Drive, StudentError
from slamlab.exercises.verdict import LawResult, Verdict

MAX_MAGNITUDE = 1e9
"""Largest absolute output: beyond it a law's own rounding could hide how wrong a number is."""
MAX_ROWS = 2000
"""Most rows of an output of any length: a law may compare each entry with each."""


@dataclass(frozen=True)
class Law:
    """A law: a property that every correct solution has (property-based test).

    Parameters
    ----------
    name : str, short; stands in the record
    points : float, what it is worth
    says : str, the law as a sentence for the student
    holds : (inputs, outputs) -> bool, or (n,) bool with one entry per input
    """

    name: str
    points: float
    says: str
    holds: Callable[[Arrays, Arrays], np.ndarray | bool]


@dataclass(frozen=True)
class Diagnosis:
    """A diagnosis: a classic mistake (misconception) and the hint for it.

    Parameters
    ----------
    name : str, short; stands in the record
    hint : str, for the student
    matches : (inputs, outputs) -> bool
    """

    name: str
    hint: str
    matches: Callable[[Arrays, Arrays], bool]


IDLE = Diagnosis(
    "idle",
    "Whatever it is given, the answer is the same: compute it from the arguments.",
    lambda inputs, outputs: True,
)
"""Diagnosis of a constant answer: it may obey a law by chance, but earns nothing."""


@dataclass(frozen=True)
class Task:
    """A task: functions that a student writes, with inputs, laws and diagnoses.

    Parameters
    ----------
    id : str, such as "04-h-robot"; stable, human
    title : str
    drive : Drive, the worker's side
    inputs : rng -> name to array; generic ones, so that no two mistakes look alike
    shapes : output name to shape, None for any length
    laws : what a right solution obeys
    diagnoses : classic mistakes, tried in order when a law failed
    needs : ids of earlier tasks of the exercise that must be solved first
    """

    id: str
    title: str
    drive: Drive
    inputs: Callable[[np.random.Generator], dict[str, np.ndarray]]
    shapes: dict[str, tuple[int | None, ...]]
    laws: tuple[Law, ...]
    diagnoses: tuple[Diagnosis, ...] = ()
    needs: tuple[str, ...] = ()

    @property
    def points(self):
        """The maximum score of the task."""
        return sum(law.points for law in self.laws)

    def draw(self, seed: bytes) -> dict[str, np.ndarray]:
        """Draw the random inputs of a seed (the open seed in a notebook, a secret one at grading).

        Parameters
        ----------
        seed : bytes; the same for all tasks of a submission

        Returns
        -------
        name to array
        """
        digest = hashlib.sha256(seed + b"\0" + self.id.encode()).digest()
        return self.inputs(np.random.default_rng(np.frombuffer(digest, dtype="<u4")))

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

    def judge(self, inputs: Arrays, outputs: Arrays) -> Verdict:
        """Judge the outputs of a student's functions by the laws, and diagnose mistakes.

        Parameters
        ----------
        inputs : what :attr:`inputs` made
        outputs : what :attr:`drive` brought back; not to be trusted

        Returns
        -------
        Verdict
        """
        problem = self._malformed(inputs, outputs)
        if problem:
            return self.failed("malformed", problem)
        outputs = {name: np.asarray(outputs[name], dtype=float) for name in self.shapes}
        with np.errstate(all="ignore"):
            idle = _constant_outputs(outputs)
            results = tuple(self._apply(law, inputs, outputs, idle) for law in self.laws)
            found = None
            if any(result.failed for result in results):
                matching = (d for d in self.diagnoses if _holds_safely(d.matches, inputs, outputs))
                found = next(matching, IDLE if idle else None)
        return Verdict(
            self.id,
            sum(result.points for result in results),
            self.points,
            results,
            found.name if found else None,
            found.hint if found else None,
        )

    def run(self, namespace, inputs) -> Verdict:
        """Call the functions and judge their outputs in one process, as a notebook does.

        Parameters
        ----------
        namespace : the student's names
        inputs : what :attr:`inputs` made

        Returns
        -------
        Verdict
        """
        try:
            return self.judge(inputs, self.drive(namespace, inputs))
        except StudentError as error:
            return self.failed(error.kind, error.message)

    def _apply(self, law, inputs, outputs, idle):
        holds = False if idle else _holds_safely(law.holds, inputs, outputs)
        holds = np.atleast_1d(np.asarray(holds, dtype=bool))
        failed = int(np.count_nonzero(~holds))
        points = 0.0 if failed else law.points
        return LawResult(law.name, law.says, points, law.points, failed, holds.size)

    def _malformed(self, inputs, outputs):
        count = min(len(a) for a in inputs.values())
        function = self.drive.functions[0]
        for name, shape in self.shapes.items():
            what = function if name == "result" else f"{function}'s {name}"
            if name not in outputs:
                return f"{what} is missing from what came back"
            got, want = outputs[name].shape, shape
            if name == "result":  # one per input: the student thinks of a single call
                if got[:1] != (count,):
                    return f"{what} answered {got[0] if got else 0} of {count} calls"
                got = got[1:]
            if len(got) != len(want) or any(
                w not in (None, g) for g, w in zip(got, want, strict=True)
            ):
                turned = " (transposed?)" if got == want[::-1] else ""
                return f"{what} returned shape {got}, expected {_shape(want)}{turned}"
            longest = max((g for g, w in zip(got, want, strict=True) if w is None), default=0)
            if longest > MAX_ROWS:
                return f"{what} returned {longest} entries: too many"
            if not np.isfinite(outputs[name]).all():
                return f"{what} returned NaN or infinity"
            if outputs[name].size and np.abs(outputs[name].astype(float)).max() > MAX_MAGNITUDE:
                return f"{what} returned numbers larger than any that is asked for"
        return None


def _constant_outputs(outputs):
    """Whether nothing in the outputs changes from one input to the next."""
    rows = [array for array in outputs.values() if array.ndim and len(array) > 1]
    return bool(rows) and all((array == array[:1]).all() for array in rows)


def _holds_safely(claim, inputs, outputs):
    # what came back can be such that a decomposition, an index or a size fails: then nothing holds
    try:
        return claim(inputs, outputs)
    except Exception:
        return False


def _shape(shape):
    if not shape:
        return "() (one number)"
    sizes = ", ".join("n" if n is None else str(n) for n in shape)
    return f"({sizes},)" if len(shape) == 1 else f"({sizes})"
