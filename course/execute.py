"""Execute a notebook in a fresh kernel and clean its outputs for storage."""

import copy
import os
import re
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError, CellTimeoutError, DeadKernelError

from classroom.coursework.folder import OFF
from course import computed_values
from course.source import ROOT
from slamlab.parallel import THREAD_VARIABLES

WIDGET = "application/vnd.jupyter.widget-view+json"
TIMEOUT = 300  # of one cell [s]


class ExecutionError(Exception):
    """A cell failed; ``cell`` is its index, and the message contains the error's last lines."""

    def __init__(self, cell, message):
        super().__init__(message)
        self.cell = cell


def executed(notebook):
    """Return whether every code cell of a stored notebook was executed."""
    return all(c.execution_count for c in notebook.cells if c.cell_type == "code")


def same_code(derived, stored):
    """Return whether two notebooks run the same code, cell by cell, and compute the same values."""

    def code(notebook):
        return [(c.id, c.source) for c in notebook.cells if c.cell_type == "code"]

    return code(derived) == code(stored) and computed_values.carry(derived, stored) is not None


def carry_outputs(derived, stored):
    """Copy the outputs and values of a stored notebook to a derived notebook with the same code."""
    notebook, outputs = computed_values.carry(derived, stored), {c.id: c for c in stored.cells}
    for cell in notebook.cells:
        if cell.cell_type == "code":
            cell.outputs = outputs[cell.id].outputs
            cell.execution_count = outputs[cell.id].execution_count
    return notebook


def execute(derived, folder):
    """Execute a notebook in its folder, in a fresh kernel of this Python.

    Parameters
    ----------
    derived : NotebookNode, left as it is
    folder : Path, of the notebook

    Returns
    -------
    NotebookNode : with outputs that can be stored

    Raises
    ------
    ExecutionError : a cell fails, takes too long or kills the kernel
    """
    notebook = computed_values.with_computing_cells(copy.deepcopy(derived))
    folder.mkdir(exist_ok=True)
    client = NotebookClient(
        notebook,
        timeout=TIMEOUT,
        kernel_name="python3",
        resources={"metadata": {"path": str(folder)}},
        store_widget_state=False,
        record_timing=False,
        coalesce_streams=True,  # the division of a print into messages is random
        extra_arguments=["--log-level=ERROR"],
    )
    env = os.environ | {
        "MPLBACKEND": "module://matplotlib_inline.backend_inline",
        "PYTHONHASHSEED": "0",
        "JUPYTER_PREFER_ENV_PATH": "1",
    }
    env["NO_COLOR"] = "1"  # stored outputs are plain text
    env[OFF] = "1"  # no student's progress is recorded
    env |= dict.fromkeys(THREAD_VARIABLES, "1")  # measured times are those of one core
    if "SLAMLAB_DATA" in env:  # the kernel runs in another folder
        env["SLAMLAB_DATA"] = str(Path(env["SLAMLAB_DATA"]).resolve())
    try:
        with TemporaryDirectory() as profile:  # without the user's own profile
            client.execute(env=env | {"IPYTHONDIR": profile})
    except (CellExecutionError, CellTimeoutError, DeadKernelError) as error:
        begun = [n for n, c in enumerate(notebook.cells) if c.get("execution_count")]
        before = notebook.cells[: begun[-1] if begun else 0]
        index = sum(not computed_values.is_computing(cell) for cell in before)
        raise ExecutionError(index, _last_lines(error)) from None
    computed_values.take_computed(notebook)
    notebook.metadata = copy.deepcopy(derived.metadata)  # the kernel adds its version
    for number, cell in enumerate(c for c in notebook.cells if c.cell_type == "code"):
        cell.execution_count = number + 1
        cell.outputs = [_clean_output(output, number + 1) for output in cell.outputs]
    return notebook


def _clean_output(output, number):
    """Clean an output: remove widgets without a model, machine paths and counts."""
    if "execution_count" in output:
        output["execution_count"] = number
    data = output.get("data", {})
    if WIDGET in data:
        # a stored widget has no model, which Jupyter would report
        del data[WIDGET]
    for holder, key in [(output, "text"), (output, "evalue"), *((data, mime) for mime in data)]:
        text = holder.get(key)
        if isinstance(text, str) and "data:image/" not in text and not key.startswith("image/"):
            holder[key] = _without_paths(text)
    if "traceback" in output:
        output["traceback"] = [_without_paths(line) for line in output["traceback"]]
    return output


def _without_paths(text):
    places = {str(ROOT): ".", sys.prefix: "python", os.path.expanduser("~"): "~"}
    if "SLAMLAB_DATA" in os.environ:
        data = os.environ["SLAMLAB_DATA"]
        places |= {data: "data", str(Path(data).resolve()): "data"}
    for place in sorted(places, key=len, reverse=True):
        text = text.replace(place, places[place])
    return re.sub(r"\S*ipykernel_\d+/\d+\.py", "<cell>", text)


def _last_lines(error):
    text = re.sub(r"\x1b\[[0-9;]*m", "", str(error)).strip()
    return "\n    ".join(text.splitlines()[-12:])
