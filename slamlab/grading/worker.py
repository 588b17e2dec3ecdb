"""Worker: the sandboxed process that runs a student's cells and calls the functions they define.

It answers each frame with one frame, cells with one each. It holds the modules its exercise allows
and no truth, and nothing that it says is believed: the judge judges the arrays that come back.
"""

import builtins
import importlib
import os
import sys
import threading
import time
import types

from slamlab.exercises.drives import StudentError, describe, input_sets
from slamlab.grading import sandbox, wire_protocol

# cell magics whose cell is run; all other magics do nothing
MAGICS_THAT_RUN = {"time", "timeit", "capture", "prun"}


def main(drives):
    """Run a spawned worker, where none can be forked: macOS and Windows.

    Parameters
    ----------
    drives : str, the module that holds the exercise's DRIVES
    """
    sandbox.restrict_process()
    threading.Thread(target=_exit_with_parent, args=(os.getppid(),), daemon=True).start()
    serve(importlib.import_module(drives).DRIVES)


def serve(drives):
    """Serve requests until the judge closes the connection.

    Parameters
    ----------
    drives : task id to Drive
    """
    receiving, sending = _redirect_streams()
    names = fresh_namespace()
    wire_protocol.send(sending, {"ready": True})
    while (frame := wire_protocol.receive(receiving)) is not None:
        head, arrays = frame
        answers = (
            _run_cells(head, names)
            if head["do"] == "cells"
            else [_drive(head, arrays, drives, names)]
        )
        for turn, (answer_head, answer_arrays) in enumerate(answers, head["turn"]):
            answer_head["turn"] = turn
            try:
                wire_protocol.send(sending, answer_head, answer_arrays)
            except wire_protocol.WireError:
                too_much = {"kind": "malformed", "problem": "returned more than can be judged"}
                wire_protocol.send(sending, too_much | {"turn": turn})


def fresh_namespace():
    """A fresh namespace for a notebook, that of the module ``__main__``."""
    notebook = types.ModuleType("__main__")
    sys.modules["__main__"] = notebook
    names = vars(notebook)
    names["__builtins__"] = builtins
    names["get_ipython"] = lambda: _Shell(names)
    names["hint"] = lambda task_id=None: None  # to a student's kernel slamlab.checks offers it, too
    return names


def run_cell(source, number, names):
    """Run one cell of a notebook in its namespace.

    Parameters
    ----------
    source : str
    number : int, its place in the notebook
    names : the notebook's names, changed in place

    Returns
    -------
    str or None, what went wrong
    """
    try:
        exec(_compiled(source, f"<cell {number}>"), names)
    except NotImplementedError:
        return "not attempted yet"
    except BaseException as error:  # a cell that fails, or calls sys.exit(), is noted, no more
        return describe(error)
    return None


def _run_cells(head, names):
    for number, source in head["cells"]:
        yield {"problem": run_cell(source, number, names)}, {}


def _drive(head, inputs, drives, names):
    try:
        sets = input_sets.parted(head["sets"], inputs)
        answers = input_sets.run_sets(drives[head["task"]], names, sets)
        failed = {
            name: [str(answer.kind), str(answer.message)]
            for name, answer in answers.items()
            if isinstance(answer, StudentError)
        }
        return {"failed": failed}, input_sets.joined(answers)
    except StudentError as error:
        return {"kind": str(error.kind), "problem": str(error.message)}, {}
    except BaseException as error:
        return {"kind": "raised", "problem": describe(error)}, {}


def _compiled(source, name):
    try:
        return compile(source, name, "exec", dont_inherit=True)
    except SyntaxError:
        # perhaps magics or shell lines; imported only now because it takes long
        from IPython.core.inputtransformer2 import TransformerManager

        return compile(TransformerManager().transform_cell(source), name, "exec", dont_inherit=True)


class _Shell:
    """What ``get_ipython()`` gives in a worker: magics and shell lines do nothing."""

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
    # the pipe moves away from where prints go, also those of C code
    receiving, sending = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    nowhere = os.open(os.devnull, os.O_RDWR)
    for number in (0, 1, 2):
        os.dup2(nowhere, number)
    os.close(nowhere)
    return receiving, sending


def _exit_with_parent(judge):
    # a cell that never ends would outlive a judge that was killed
    while os.getppid() == judge:  # on Windows it never changes
        time.sleep(1.0)
    os._exit(1)
