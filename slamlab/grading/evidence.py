"""Evidence: what a worker answered, kept so that an answer can be judged again without its code.

One frame of :mod:`wire_protocol` for each call of a task: the hash of the inputs, and the outputs.
As many are kept as there is room for, the smallest first; the others are run again when asked for.
"""

import hashlib
import io
import struct

from slamlab.exercises.drives import StudentError, input_sets
from slamlab.grading import course_digests, wire_protocol
from slamlab.grading.ledger import contents
from slamlab.grading.wire_protocol import WireError

GRADED, OPEN = "graded", "open"
"""The two calls of a task: on inputs of the secret seed, and on the open ones for its hint."""
HOPELESS = 4 * contents.MOST  # a frame that will not become small enough [bytes]
_LENGTH = struct.Struct("<I")


class NotKept(Exception):
    """What a worker answered to these inputs is not kept; the text says why."""


class Evidence:
    """What is kept of one attempt while it is judged.

    Parameters
    ----------
    exercise : Exercise
    before : KeptAnswers or None, of calls that are not made again
    """

    def __init__(self, exercise, before=None):
        self._worker = course_digests.worker_digest(exercise)
        self._frames = dict(before.frames) if before else {}

    def keep(self, task, call, sets, answers):
        """Keep what came back of a call.

        Parameters
        ----------
        task : Task
        call : str, GRADED or OPEN
        sets : set's name to name to array
        answers : set's name to name to array or to the StudentError met there; or a StudentError
        """
        head, arrays = {"task": task.id, "call": call, "worker": self._worker}, {}
        self._frames.pop((task.id, call), None)
        try:
            head |= {"inputs": inputs_hash(sets)}
            if isinstance(answers, StudentError):
                head |= {"problem": _plain(answers)}
            else:
                failed = {k: _plain(a) for k, a in answers.items() if isinstance(a, StudentError)}
                head |= {"sets": list(answers), "failed": failed}
                arrays = input_sets.joined(answers)
            self._frames[task.id, call] = wire_protocol.pack(head, arrays)
        except WireError:  # what is no honest answer is run again when it is asked for
            return

    def packed(self):
        """All there is room for, as it is kept; None for nothing.

        Returns
        -------
        bytes or None
        """
        kept = b""
        for frame in sorted(self._frames.values(), key=len):
            small = contents.packed(frame) if len(frame) <= HOPELESS else None
            if small is None or len(kept) + _LENGTH.size + len(small) > contents.MOST:
                break
            kept += _LENGTH.pack(len(small)) + small
        return kept or None


class KeptAnswers:
    """The answers that were kept of an attempt.

    Parameters
    ----------
    kept : bytes or None, what :meth:`Evidence.packed` gave
    exercise : Exercise

    Raises
    ------
    ContentError : it is damaged
    """

    def __init__(self, kept, exercise):
        self._worker, self._calls = course_digests.worker_digest(exercise), {}
        self.frames = {}
        try:
            for frame in _frames(kept or b""):
                head, arrays = wire_protocol.receive(io.BytesIO(frame))
                told = head["inputs"], head["worker"], _answers(head, arrays)
                self._calls[head["task"], head["call"]] = told
                self.frames[head["task"], head["call"]] = frame
        except (WireError, KeyError, TypeError, ValueError, struct.error) as error:
            raise contents.ContentError(f"outputs that are kept are damaged: {error}") from None

    def answer(self, task, call, sets):
        """What came back of a call on the same inputs.

        Parameters
        ----------
        task, call, sets : as of :meth:`Evidence.keep`

        Returns
        -------
        set's name to name to array, or to the StudentError met there

        Raises
        ------
        StudentError : what came of the whole call
        NotKept : nothing is kept of it, or inputs or the modules of the worker are others now
        """
        inputs, worker, answers = self._calls.get((task.id, call), (None, None, None))
        if inputs is None:
            raise NotKept(f"nothing is kept of {task.id}")
        if inputs != inputs_hash(sets) or worker != self._worker:
            raise NotKept(f"{task.id} is asked in another way now")
        if isinstance(answers, StudentError):
            raise answers
        return answers


def inputs_hash(sets):
    """The hash of a task's sets of inputs.

    Parameters
    ----------
    sets : set's name to name to array

    Returns
    -------
    str
    """
    frame = wire_protocol.pack({"sets": list(sets)}, input_sets.joined(sets))
    return hashlib.sha256(frame).hexdigest()


def _frames(kept):
    start = 0
    while start < len(kept):
        (size,) = _LENGTH.unpack_from(kept, start)
        start += _LENGTH.size + size
        yield contents.unpacked(kept[start - size : start])


def _plain(error):
    return [str(error.kind), str(error.message)]


def _answers(head, arrays):
    if "problem" in head:
        return StudentError(*head["problem"])
    answers = input_sets.parted(head["sets"], arrays)
    return answers | {name: StudentError(*told) for name, told in head["failed"].items()}
