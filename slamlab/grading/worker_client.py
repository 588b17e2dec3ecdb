"""Worker client, the judge's end: runs cells and tasks in a worker, each with a timeout."""

import contextlib
import queue
import threading
import time

from slamlab.exercises.drives import StudentError, input_sets
from slamlab.grading import redaction, wire_protocol
from slamlab.grading.worker_pool import WorkerStartError

START_TIMEOUT = 120.0  # of a worker [s]
CELL_TIMEOUT = 10.0  # [s]
NOTEBOOK_TIMEOUT = 300.0  # of all cells and tasks [s]
BATCH_CHARACTERS = 50_000  # of cells sent in one frame; each letter is 12 bytes of JSON at most
POLL_SECONDS = 0.2
"""Polling interval of the stop event [s]."""


class WorkerLost(Exception):
    """A worker hangs (timeout) or is dead; ``kind`` is "time" or "died"."""

    def __init__(self, kind):
        super().__init__(kind)
        self.kind = kind


class WorkerClient:
    """A student's notebook in a worker, restarted without the cells that made it hang or die.

    Parameters
    ----------
    exercise : Exercise
    cells : list of (number, source), the student's code cells in order
    start : exercise -> worker, such as ``WorkerPool.start``
    stop : threading.Event or None; once it is set, nothing is waited for any more
    unredacted : bool, whether failures are told without redaction, which reveals inputs, too
    """

    def __init__(self, exercise, cells, start, stop=None, unredacted=False):
        self._exercise, self._cells, self._start = exercise, cells, start
        self._stop, self._unredacted = stop or threading.Event(), unredacted
        self._process, self._thread, self._turn = None, None, 0
        self._requests, self._responses = queue.SimpleQueue(), queue.SimpleQueue()
        self._skipped_cells, self._inputs_known = set(), False
        self._deadline = time.monotonic() + NOTEBOOK_TIMEOUT
        self.problems = {}
        """Problems of cells, by cell number; as they were before the notebook had seen an input."""
        self.cpu = 0.0
        """CPU time of ended workers [s]."""

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._stop_worker()

    def run(self, task, sets):
        """Call a task's functions on sets of inputs in the worker.

        Parameters
        ----------
        task : Task
        sets : set's name to name to array

        Returns
        -------
        set's name to name to array, not to be trusted, or to the StudentError met there

        Raises
        ------
        StudentError : when nothing came back that could be judged
        WorkerStartError
        """
        self.load()
        self._inputs_known = True
        try:
            request = {"do": "task", "task": task.id, "sets": list(sets)}
            self._send(request, input_sets.joined(sets))
            head, arrays = self._answer(task.drive.seconds)
        except WorkerLost as gone:
            self._stop_worker()
            raise StudentError(gone.kind, _loss_message(gone.kind, task.drive.seconds)) from None
        if head.get("problem") is not None:
            raise self._told(head.get("kind"), head["problem"], task)
        answers, failed = input_sets.parted(list(sets), arrays), head.get("failed")
        for name, told in failed.items() if isinstance(failed, dict) else ():
            if name in answers and isinstance(told, list) and len(told) == 2:
                answers[name] = self._told(*told, task)
        return answers

    def cpu_so_far(self):
        """CPU time of all its workers [s], the one that runs included; not from the worker."""
        running = self._process.cpu_so_far() if self._process is not None else 0.0
        return self.cpu + running

    def _told(self, kind, problem, task):
        """What a worker says went wrong, with nothing in it of the inputs."""
        kind = kind if kind in redaction.PROBLEM_KINDS else "raised"
        problem = _text(problem)
        if not self._unredacted:
            problem = redaction.redact(kind, problem, task, self._exercise.drives)
        return StudentError(kind, problem)

    def load(self):
        """Start a worker if there is none and run all cells in it, those that hung it left out."""
        while self._process is None:
            self._start_worker()
            cells = [cell for cell in self._cells if cell[0] not in self._skipped_cells]
            for some in _batches(cells):
                if not self._load_cells(some):
                    break

    def _load_cells(self, cells):
        """Run cells that are sent in one frame; False when one of them cost the worker."""
        for number, _ in cells:
            self._note(number, None)
        try:
            self._send({"do": "cells", "cells": [list(cell) for cell in cells]}, {}, len(cells))
        except wire_protocol.WireError:
            for number, _ in cells:
                self._note(number, "too long to be run")
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
        """Note what went wrong in a cell, not when it is run again after its notebook saw inputs.

        Files' times, the clock, the cell at which it dies: by many ways could one worker tell the
        next what it was given.
        """
        if not self._inputs_known:
            self.problems.pop(number, None)
            if problem is not None:
                self.problems[number] = problem

    def _start_worker(self):
        if time.monotonic() >= self._deadline:
            raise StudentError("time", f"the notebook took more than {NOTEBOOK_TIMEOUT:g} s in all")
        self._process = self._start(self._exercise)
        self._requests, self._responses = queue.SimpleQueue(), queue.SimpleQueue()
        # in a thread of its own: a worker may also hang by not reading
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
            raise WorkerStartError("the worker did not say that it is ready")
        self._turn = 0

    def _send(self, head, arrays, answers=1):
        """Send a frame that so many answers are due to."""
        self._requests.put((wire_protocol.pack(head | {"turn": self._turn + 1}, arrays), answers))

    def _answer(self, seconds):
        """The next answer that is due."""
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
        if not self._thread.is_alive():  # else a process that escaped still holds the pipe
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


def _batches(cells):
    """Cells in order, as many at a time as one frame surely holds, or one that is longer."""
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
        return f"still running after {seconds:g} s"
    return "ended the whole Python process"


def _text(value):
    return str(value)[:500]
