"""The judge's end: asks a worker for cells and tasks, each with a time limit of its own."""

import contextlib
import queue
import threading
import time

from slamlab.checks.drives import StudentError
from slamlab.grading import said, wire
from slamlab.grading.workers import CannotStart

START_SECONDS = 120.0
CELL_SECONDS = 10.0
TOTAL_SECONDS = 300.0
GLANCE = 0.2
"""How often it is looked whether to stop [s]."""


class Gone(Exception):
    """A worker hangs or is dead; ``kind`` is "time" or "died"."""

    def __init__(self, kind):
        super().__init__(kind)
        self.kind = kind


class Client:
    """A student's notebook in a worker, started again without what made it hang or die.

    Parameters
    ----------
    exercise : Exercise
    cells : list of (number, source), the student's code cells in order
    start : exercise -> worker, such as ``Workers.start``
    stop : threading.Event or None; once it is set, nothing is waited for any more
    tell : bool, whether failures are told in full, which tells of the inputs, too
    """

    def __init__(self, exercise, cells, start, stop=None, tell=False):
        self._exercise, self._cells, self._start = exercise, cells, start
        self._stop, self._tell = stop or threading.Event(), tell
        self._process, self._thread, self._turn = None, None, 0
        self._questions, self._answers = queue.SimpleQueue(), queue.SimpleQueue()
        self._lethal = set()
        self._deadline = time.monotonic() + TOTAL_SECONDS
        self.problems = {}
        """What went wrong in a cell, by its number."""
        self.cpu = 0.0
        """Seconds of CPU that ended workers took."""

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._end()

    def run(self, task, inputs):
        """Drive a task's functions on inputs.

        Parameters
        ----------
        task : Task
        inputs : name to array

        Returns
        -------
        name to array, not to be trusted

        Raises
        ------
        StudentError : when nothing came back that could be judged
        CannotStart
        """
        self.load()
        try:
            head, arrays = self._ask({"do": "task", "task": task.id}, inputs, task.drive.seconds)
        except Gone as gone:
            self._end()
            raise StudentError(gone.kind, _say(gone.kind, task.drive.seconds)) from None
        if head.get("problem") is not None:
            kind = head.get("kind") if head.get("kind") in said.KINDS else "raised"
            problem = _text(head["problem"])
            if not self._tell:
                problem = said.told(kind, problem, task, self._exercise, self._cells)
            raise StudentError(kind, problem)
        return arrays

    def load(self):
        """Have a worker in which all cells ran that can run."""
        while self._process is None:
            self._begin()
            for number, source in self._cells:
                if number in self._lethal:
                    continue
                try:
                    self._load_cell(number, source)
                except Gone as gone:
                    self._end()
                    self._lethal.add(number)
                    self.problems[number] = _say(gone.kind, CELL_SECONDS)
                    break

    def _load_cell(self, number, source):
        self.problems.pop(number, None)
        try:
            question = {"do": "cell", "number": number, "source": source}
            head, _ = self._ask(question, {}, CELL_SECONDS)
        except wire.WireError:
            self.problems[number] = "too long to be run"
            return
        if head.get("problem") is not None:
            self.problems[number] = _text(head["problem"])

    def _begin(self):
        if time.monotonic() >= self._deadline:
            raise StudentError("time", f"the notebook took more than {TOTAL_SECONDS:g} s in all")
        self._process = self._start(self._exercise)
        self._questions, self._answers = queue.SimpleQueue(), queue.SimpleQueue()
        # in a thread of its own: a worker may also hang by not reading
        pair = self._questions, self._answers
        self._thread = threading.Thread(target=_talk, args=(self._process, *pair), daemon=True)
        self._thread.start()
        self._turn = None
        try:
            head, _ = self._exchange(b"", START_SECONDS)
        except Gone as gone:
            why = self._process.errors()
            self._end()
            raise CannotStart(f"the worker did not start ({gone.kind}): {why}") from None
        if head.get("ready") is not True:
            self._end()
            raise CannotStart("the worker did not say that it is ready")
        self._turn = 0

    def _ask(self, head, arrays, seconds):
        frame = wire.pack(head | {"turn": self._turn + 1}, arrays)
        self._turn += 1
        return self._exchange(frame, min(seconds, max(self._deadline - time.monotonic(), 0.1)))

    def _exchange(self, frame, seconds):
        self._questions.put(frame)
        try:
            answer, kind = self._wait(seconds), "died"
        except queue.Empty:
            answer, kind = None, "time"
        if answer is None or answer[0].get("turn") != self._turn:
            raise Gone(kind)
        return answer

    def _wait(self, seconds):
        end = time.monotonic() + seconds
        while not self._stop.is_set():
            left = end - time.monotonic()
            try:
                return self._answers.get(timeout=max(min(left, GLANCE), 0))
            except queue.Empty:
                if left <= GLANCE:
                    raise
        raise CannotStart("grading was stopped")

    def _end(self):
        if self._process is None:
            return
        process, self._process = self._process, None
        process.kill()
        self._questions.put(None)
        self.cpu += process.cpu
        self._thread.join(1.0)
        if not self._thread.is_alive():  # else a process that escaped still holds the pipe
            for stream in (process.sending, process.receiving):
                with contextlib.suppress(OSError):
                    stream.close()


def _talk(process, questions, answers):
    while (frame := questions.get()) is not None:
        try:
            process.sending.write(frame)
            process.sending.flush()
            answers.put(wire.receive(process.receiving))
        except (OSError, ValueError, wire.WireError):
            answers.put(None)


def _say(kind, seconds):
    if kind == "time":
        return f"still running after {seconds:g} s"
    return "ended the whole Python process"


def _text(value):
    return str(value)[:500]
