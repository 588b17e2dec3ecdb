"""Worker: the sandboxed process that runs a student's cells and calls their functions. The worker
can import the modules that its exercise allows, but no modules with answers. The judge does not
trust the worker's messages; it judges the arrays that the worker returns.
"""

import builtins
import importlib
import os
import sys
import threading
import time
import types

from classroom.exercises.function_calls import (
    StudentError,
    describe_exception,
    run_and_pack,
    stand_ins,
)
from classroom.grading import sandbox, wire_protocol

# cell magics that run their cell; all other magics do nothing
MAGICS_THAT_RUN = {"time", "timeit", "capture", "prun"}


def main(calls):
    """Run a spawned worker on systems without fork; ``calls`` names the module with CALLS."""
    sandbox.restrict_process()
    threading.Thread(target=_exit_with_parent, args=(os.getppid(),), daemon=True).start()
    serve(importlib.import_module(calls).CALLS)


def serve(calls):
    """Answer each task and each cell with one frame, until the connection closes."""
    receiving, sending = _redirect_streams()
    names = fresh_namespace()
    wire_protocol.send(sending, {"ready": True})
    while (frame := wire_protocol.receive(receiving)) is not None:
        head, arrays = frame

        def ask(name, given, turn=head["turn"]):
            wire_protocol.send(sending, {"ask": name, "turn": turn}, given)
            answer, values = wire_protocol.receive(receiving)
            if "problem" in answer:
                raise ValueError(answer["problem"])
            return stand_ins.as_returned(values.values())

        answers = (
            _run_cells(head, names)
            if head["do"] == "cells"
            else [_call_task(head, arrays, calls, names, ask)]
        )
        for turn, (answer_head, answer_arrays) in enumerate(answers, head["turn"]):
            answer_head["turn"] = turn
            try:
                wire_protocol.send(sending, answer_head, answer_arrays)
            except wire_protocol.WireError:
                too_much = {"kind": "malformed", "problem": "returned too much data to judge"}
                wire_protocol.send(sending, too_much | {"turn": turn})


def fresh_namespace():
    """Return the namespace of a new module ``__main__``."""
    notebook = types.ModuleType("__main__")
    sys.modules["__main__"] = notebook
    names = vars(notebook)
    names["__builtins__"] = builtins
    names["get_ipython"] = lambda: _Shell(names)
    names["hint"] = lambda task_id=None: (
        None
    )  # to a student's kernel classroom.checks offers it, too
    return names


def run_cell(source, number, names):
    """Run a cell in a notebook's namespace; return the problem, or None."""
    try:
        exec(_compiled(source, f"<cell {number}>"), names)
    except NotImplementedError:
        return "not attempted yet"
    except BaseException as error:  # also sys.exit(): a failed cell does not end the worker
        return describe_exception(error)
    return None


def _run_cells(head, names):
    for number, source in head["cells"]:
        yield {"problem": run_cell(source, number, names)}, {}


def _call_task(head, inputs, calls, names, ask):
    try:
        sets = run_and_pack.unpack_sets(head["sets"], inputs)
        with stand_ins.replaced(names, head["replaced"], ask):
            answers = run_and_pack.call_on_sets(calls[head["task"]], names, sets)
        failed = {
            name: [str(answer.kind), str(answer.message)]
            for name, answer in answers.items()
            if isinstance(answer, StudentError)
        }
        return {"failed": failed}, run_and_pack.pack_sets(answers)
    except StudentError as error:
        return {"kind": str(error.kind), "problem": str(error.message)}, {}
    except BaseException as error:
        return {"kind": "raised", "problem": describe_exception(error)}, {}


def _compiled(source, name):
    try:
        return compile(source, name, "exec", dont_inherit=True)
    except SyntaxError:
        # perhaps magics or shell lines; imported here because the import is slow
        from IPython.core.inputtransformer2 import TransformerManager

        return compile(TransformerManager().transform_cell(source), name, "exec", dont_inherit=True)


class _Shell:
    """Replacement for ``get_ipython()`` in a worker; magics and shell lines do nothing."""

    def __init__(self, names):
        self.user_ns = names

    def run_cell_magic(self, name, line, cell):
        if name in MAGICS_THAT_RUN:
            exec(_compiled(cell, f"<cell %%{name}>"), self.user_ns)

    def getoutput(self, command):
        return []

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return lambda *_, **__: None


def _redirect_streams():
    # move the pipe away from stdout, so that prints, also those of C code, do not reach it
    receiving, sending = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    nowhere = os.open(os.devnull, os.O_RDWR)
    for number in (0, 1, 2):
        os.dup2(nowhere, number)
    os.close(nowhere)
    return receiving, sending


def _exit_with_parent(judge):
    # a cell that never ends would survive a killed judge
    while os.getppid() == judge:  # on Windows it never changes
        time.sleep(1.0)
    os._exit(1)
