"""Worker client, judge's side: run cells and tasks in a worker, each with a timeout."""

import contextlib
import queue
import threading
import time

from classroom.exercises.function_calls import StudentError, run_and_pack
from classroom.exercises.references import MAX_CALLS
from classroom.grading import redaction, wire_protocol
from classroom.grading.worker_pool import WorkerStartError

START_TIMEOUT = 120.0  # of a worker [s]
CELL_TIMEOUT = 10.0  # [s]
NOTEBOOK_TIMEOUT = 300.0  # of all cells and tasks [s]
CALL_SECONDS = 0.005  # added to a task's time for each call of a right function [s]
BATCH_CHARACTERS = 50_000  # of cells in one frame; a character takes at most 12 bytes of JSON
POLL_SECONDS = 0.2
"""Polling interval of the stop event [s]."""


class WorkerLost(Exception):
    """A worker hangs (timeout) or has died; ``kind`` is "time" or "died"."""

    def __init__(self, kind):
        super().__init__(kind)
        self.kind = kind


class WorkerClient:
    """A student's notebook in a worker. If a cell (number, source) makes the worker hang or die,
    the worker restarts without this cell. Setting ``stop`` ends all waiting. If ``unredacted``,
    messages of failures may reveal inputs.
    """

    def __init__(self, exercise, cells, start, stop=None, unredacted=False):
        self._exercise, self._cells, self._start = exercise, cells, start
        self._stop, self._unredacted = stop or threading.Event(), unredacted
        self._process, self._thread, self._turn = None, None, 0
        self._requests, self._responses = queue.SimpleQueue(), queue.SimpleQueue()
        self._skipped_cells, self._inputs_known = set(), False
        self._deadline = time.monotonic() + NOTEBOOK_TIMEOUT
        self.problems = {}
        """Problems by cell number, recorded only before the notebook receives inputs."""
        self.cpu = 0.0
        """CPU time of ended workers [s]."""

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._stop_worker()

    def run(self, task, sets, references):
        """Call a task's functions on input sets, given as a dict from set name to arrays by name.
        ``references`` (ReferenceCalls) answers calls of the functions that it replaces. Return
        untrusted arrays or a StudentError for each set. Raises StudentError or WorkerStartError.
        """
        self.load()
        self._inputs_known = True
        request = {"do": "task", "task": task.id, "sets": list(sets)}
        request["replaced"] = list(references.names)
        try:
            self._send(request, run_and_pack.pack_sets(sets))
            end = time.monotonic() + task.call.seconds
            head, arrays = self._answer(task.call.seconds)
            while references.names and "ask" in head:
                self._requests.put((_reply(references, head["ask"], arrays), 1))
                end += CALL_SECONDS if references.count <= MAX_CALLS else 0
                head, arrays = self._next_answer(max(end - time.monotonic(), 0))
        except WorkerLost as gone:
            self._stop_worker()
            raise StudentError(gone.kind, _loss_message(gone.kind, task.call.seconds)) from None
        if head.get("problem") is not None:
            raise self._student_error(head.get("kind"), head["problem"], task)
        answers, failed = run_and_pack.unpack_sets(list(sets), arrays), head.get("failed")
        for name, error in failed.items() if isinstance(failed, dict) else ():
            if name in answers and isinstance(error, list) and len(error) == 2:
                answers[name] = self._student_error(*error, task)
        return answers

    def cpu_so_far(self):
        """Return the CPU time [s] of all workers of this notebook; workers cannot forge it."""
        running = self._process.cpu_so_far() if self._process is not None else 0.0
        return self.cpu + running

    def _student_error(self, kind, problem, task):
        """Return a worker's error, redacted so that it reveals nothing about the inputs."""
        kind = kind if kind in redaction.PROBLEM_KINDS else "raised"
        problem = _text(problem)
        if not self._unredacted:
            problem = redaction.redact(kind, problem, task, self._exercise.calls)
        return StudentError(kind, problem)

    def load(self):
        """Start a worker if none is running, and run all cells except those that ended a worker."""
        while self._process is None:
            self._start_worker()
            cells = [cell for cell in self._cells if cell[0] not in self._skipped_cells]
            for some in _batches(cells):
                if not self._load_cells(some):
                    break

    def _load_cells(self, cells):
        """Run cells sent in one frame; return False if one of them ended the worker."""
        for number, _ in cells:
            self._note(number, None)
        try:
            self._send({"do": "cells", "cells": [list(cell) for cell in cells]}, {}, len(cells))
        except wire_protocol.WireError:
            for number, _ in cells:
                self._note(number, "the cell is too long to run")
            return True
        for number, _ in cells:
            try:
                head, _ = self._answer(CELL_TIMEOUT)
            except WorkerLost as gone:
                self._stop_worker()
                self._skipped_cells.add(number)
                self._note(number, _loss_message(gone.kind, CELL_TIMEOUT))
                return False
            if head.get("problem") is not None:
                self._note(number, _text(head["problem"]))
        return True

    def _note(self, number, problem):
        """Record a cell's problem, unless the cell runs again after the notebook received inputs.

        A worker could pass inputs to the next worker through file times, the clock, or the cell at
        which it dies.
        """
        if not self._inputs_known:
            self.problems.pop(number, None)
            if problem is not None:
                self.problems[number] = problem

    def _start_worker(self):
        if time.monotonic() >= self._deadline:
            message = f"the notebook took more than {NOTEBOOK_TIMEOUT:g} s in total"
            raise StudentError("time", message)
        self._process = self._start(self._exercise)
        self._requests, self._responses = queue.SimpleQueue(), queue.SimpleQueue()
        # in a separate thread, because a worker may also hang by not reading
        pair = self._requests, self._responses
        self._thread = threading.Thread(
            target=_exchange_frames, args=(self._process, *pair), daemon=True
        )
        self._thread.start()
        self._turn = None
        self._requests.put((b"", 1))
        try:
            head, _ = self._next_answer(START_TIMEOUT)
        except WorkerLost as gone:
            why = self._process.last_error()
            self._stop_worker()
            raise WorkerStartError(f"the worker did not start ({gone.kind}): {why}") from None
        if head.get("ready") is not True:
            self._stop_worker()
            raise WorkerStartError("the worker did not report that it was ready")
        self._turn = 0

    def _send(self, head, arrays, answers=1):
        self._requests.put((wire_protocol.pack(head | {"turn": self._turn + 1}, arrays), answers))

    def _answer(self, seconds):
        self._turn += 1
        return self._next_answer(min(seconds, max(self._deadline - time.monotonic(), 0.1)))

    def _next_answer(self, seconds):
        try:
            answer, kind = self._next_response(seconds), "died"
        except queue.Empty:
            answer, kind = None, "time"
        if answer is None or answer[0].get("turn") != self._turn:
            raise WorkerLost(kind)
        return answer

    def _next_response(self, seconds):
        end = time.monotonic() + seconds
        while not self._stop.is_set():
            left = end - time.monotonic()
            try:
                return self._responses.get(timeout=max(min(left, POLL_SECONDS), 0))
            except queue.Empty:
                if left <= POLL_SECONDS:
                    raise
        raise WorkerStartError("grading was stopped")

    def _stop_worker(self):
        if self._process is None:
            return
        process, self._process = self._process, None
        process.kill()
        self._requests.put(None)
        self.cpu += process.cpu
        self._thread.join(1.0)
        if not self._thread.is_alive():  # otherwise an escaped process still holds the pipe
            for stream in (process.sending, process.receiving):
                with contextlib.suppress(OSError):
                    stream.close()


def _exchange_frames(process, requests, responses):
    while (request := requests.get()) is not None:
        frame, answers = request
        try:
            process.sending.write(frame)
            process.sending.flush()
            for _ in range(answers):
                responses.put(wire_protocol.receive(process.receiving))
        except (OSError, ValueError, wire_protocol.WireError):
            responses.put(None)


def _reply(references, name, given):
    """Return the frame that answers a worker's call of a right function."""
    try:
        values = references.values(name, given)
        return wire_protocol.pack({}, {str(k): value for k, value in enumerate(values)})
    except (ValueError, wire_protocol.WireError) as problem:
        return wire_protocol.pack({"problem": str(problem)})


def _batches(cells):
    """Yield batches of cells that fit into one frame; a longer cell forms a separate batch."""
    some, letters = [], 0
    for number, source in cells:
        if some and letters + len(source) > BATCH_CHARACTERS:
            yield some
            some, letters = [], 0
        some.append((number, source))
        letters += len(source)
    if some:
        yield some


def _loss_message(kind, seconds):
    if kind == "time":
        return f"still running after {seconds:g} s, so it was stopped"
    return "ended the whole Python process; possible causes: too much memory, os._exit(), a crash"


def _text(value):
    return str(value)[:500]
