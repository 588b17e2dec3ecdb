"""Stored answers of a worker, which can be rejudged without running the student's code. Each call
is stored as one frame of :mod:`wire_protocol` with its outputs and the hash of its inputs. The
smallest frames are stored first.
"""

import hashlib
import io
import struct

from classroom.exercises.function_calls import StudentError, run_and_pack
from classroom.exercises.references import NO_REFERENCES
from classroom.grading import course_digests, wire_protocol
from classroom.grading.ledger import contents
from classroom.grading.wire_protocol import WireError

GRADED, OPEN = "graded", "open"
"""The two calls of a task: on inputs from the secret seed, and on the open inputs for the hint."""
MAX_FRAME_BYTES = 4 * contents.MAX_BYTES  # compression does not make larger frames small enough
_LENGTH = struct.Struct("<I")


class NotStored(Exception):
    """A worker's answer to these inputs is not stored; the message states why."""


class AnswerRecorder:
    """Records the answers of an attempt; ``before`` contains the answers to calls that are not
    repeated.
    """

    def __init__(self, exercise, before=None):
        self._worker = course_digests.worker_digest(exercise)
        self._frames = dict(before.frames) if before else {}

    def keep(self, task, call, sets, answers, references=NO_REFERENCES):
        """Record the answers to a call: for each input set, arrays by name or a StudentError; or
        one StudentError for all sets. ``references`` are the ReferenceCalls of this call.
        """
        head, arrays = {"task": task.id, "call": call, "worker": self._worker}, {}
        head |= {"replaced": list(references.names), "asked": references.count}
        self._frames.pop((task.id, call), None)
        try:
            head |= {"inputs": inputs_hash(sets)}
            if isinstance(answers, StudentError):
                head |= {"problem": _plain(answers)}
            else:
                failed = {k: _plain(a) for k, a in answers.items() if isinstance(a, StudentError)}
                head |= {"sets": list(answers), "failed": failed}
                arrays = run_and_pack.pack_sets(answers)
            self._frames[task.id, call] = wire_protocol.pack(head, arrays)
        except WireError:  # an invalid answer is not stored: rejudging runs the code again
            return

    def packed(self):
        """Return as many compressed frames as fit into MAX_BYTES, or None if none fits."""
        kept = b""
        for frame in sorted(self._frames.values(), key=len):
            small = contents.packed(frame) if len(frame) <= MAX_FRAME_BYTES else None
            if small is None or len(kept) + _LENGTH.size + len(small) > contents.MAX_BYTES:
                break
            kept += _LENGTH.pack(len(small)) + small
        return kept or None


class StoredAnswers:
    """Answers read from :meth:`AnswerRecorder.packed`. Raises ContentError."""

    def __init__(self, kept, exercise):
        self._worker, self._calls = course_digests.worker_digest(exercise), {}
        self.frames = {}
        try:
            for frame in _frames(kept or b""):
                head, arrays = wire_protocol.receive(io.BytesIO(frame))
                about = head["inputs"], head["worker"], head.get("replaced", [])
                call = about, _answers(head, arrays)
                self._calls[head["task"], head["call"]] = call
                self.frames[head["task"], head["call"]] = frame
        except (WireError, KeyError, TypeError, ValueError, struct.error) as error:
            raise contents.ContentError(f"the stored outputs are damaged: {error}") from None

    def answer(self, task, call, sets, references=()):
        """Return the answers to a call on the same inputs and with the same functions replaced, or
        raise its StudentError. Raises NotStored.
        """
        about, answers = self._calls.get((task.id, call), (None, None))
        if about is None:
            raise NotStored(f"no answer to {task.id} is stored")
        names = [reference.function for reference in references]
        if about != (inputs_hash(sets), self._worker, names):
            raise NotStored(f"the inputs of {task.id} have changed")
        if isinstance(answers, StudentError):
            raise answers
        return answers


def inputs_hash(sets):
    frame = wire_protocol.pack({"sets": list(sets)}, run_and_pack.pack_sets(sets))
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
    answers = run_and_pack.unpack_sets(head["sets"], arrays)
    return answers | {name: StudentError(*error) for name, error in head["failed"].items()}
