"""Execute a notebook in a fresh kernel and clean its outputs for storage."""

import copy
import os
import re
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError, CellTimeoutError, DeadKernelError

from course import values
from course.source import ROOT
from slamlab.coursework.folder import OFF
from slamlab.parallel import THREAD_VARIABLES

WIDGET = "application/vnd.jupyter.widget-view+json"
TIMEOUT = 300  # of one cell [s]


class ExecutionError(Exception):
    """A cell failed; ``cell`` is its position, the message the error's last lines."""

    def __init__(self, cell, message):
        super().__init__(message)
        self.cell = cell


def executed(notebook):
    """Whether every code cell of a stored notebook was run."""
    return all(c.execution_count for c in notebook.cells if c.cell_type == "code")


def same_code(derived, stored):
    """Whether two notebooks run the same code, cell by cell, and compute the same values."""

    def code(notebook):
        return [(c.id, c.source) for c in notebook.cells if c.cell_type == "code"]

    return code(derived) == code(stored) and values.carry(derived, stored) is not None


def carry_outputs(derived, stored):
    """Copy outputs and values of a stored notebook to the derived one that runs the same code."""
    notebook, outputs = values.carry(derived, stored), {c.id: c for c in stored.cells}
    for cell in notebook.cells:
        if cell.cell_type == "code":
            cell.outputs = outputs[cell.id].outputs
            cell.execution_count = outputs[cell.id].execution_count
    return notebook


def execute(derived, folder):
    """Execute a notebook from its folder in a fresh kernel of this Python.

    Parameters
    ----------
    derived : NotebookNode, left as it is
    folder : Path, where the notebook is to stand

    Returns
    -------
    NotebookNode : with its outputs, fit to be stored

    Raises
    ------
    ExecutionError : when a cell fails, takes too long or kills the kernel
    """
    notebook = values.with_computing_cells(copy.deepcopy(derived))
    folder.mkdir(exist_ok=True)
    client = NotebookClient(
        notebook,
        timeout=TIMEOUT,
        kernel_name="python3",
        resources={"metadata": {"path": str(folder)}},
        store_widget_state=False,
        record_timing=False,
        coalesce_streams=True,  # how a print is cut into messages is chance
        extra_arguments=["--log-level=ERROR"],
    )
    env = os.environ | {
        "MPLBACKEND": "module://matplotlib_inline.backend_inline",
        "PYTHONHASHSEED": "0",
        "JUPYTER_PREFER_ENV_PATH": "1",
    }
    env["NO_COLOR"] = "1"  # what is stored is plain text
    env[OFF] = "1"  # nobody learns here
    env |= dict.fromkeys(THREAD_VARIABLES, "1")  # measured times are those of one core
    if "SLAMLAB_DATA" in env:  # the kernel stands in another folder
        env["SLAMLAB_DATA"] = str(Path(env["SLAMLAB_DATA"]).resolve())
    try:
        with TemporaryDirectory() as profile:  # nobody's own profile takes part
            client.execute(env=env | {"IPYTHONDIR": profile})
    except (CellExecutionError, CellTimeoutError, DeadKernelError) as error:
        begun = [n for n, c in enumerate(notebook.cells) if c.get("execution_count")]
        before = notebook.cells[: begun[-1] if begun else 0]
        place = sum(not values.is_computing(cell) for cell in before)
        raise ExecutionError(place, _last_lines(error)) from None
    values.take_computed(notebook)
    notebook.metadata = copy.deepcopy(derived.metadata)  # the kernel adds its version
    for number, cell in enumerate(c for c in notebook.cells if c.cell_type == "code"):
        cell.execution_count = number + 1
        cell.outputs = [_clean_output(output, number + 1) for output in cell.outputs]
    return notebook


def _clean_output(output, number):
    """Clean an output: words in place of a widget, no machine paths, no counts."""
    if "execution_count" in output:
        output["execution_count"] = number
    data = output.get("data", {})
    if WIDGET in data:
        # a stored widget has no model behind it: Jupyter would say that there is none
        del data[WIDGET]
    for holder, key in [(output, "text"), (output, "evalue"), *((data, mime) for mime in data)]:
        text = holder.get(key)
        if isinstance(text, str) and "data:image/" not in text and not key.startswith("image/"):
            holder[key] = _without_paths(text)
    if "traceback" in output:
        output["traceback"] = [_without_paths(line) for line in output["traceback"]]
    return output


def _without_paths(text):
    places = {str(ROOT): ".", sys.prefix: "python", str(Path.home()): "~"}
    if "SLAMLAB_DATA" in os.environ:
        data = os.environ["SLAMLAB_DATA"]
        places |= {data: "data", str(Path(data).resolve()): "data"}
    for place in sorted(places, key=len, reverse=True):
        text = text.replace(place, places[place])
    return re.sub(r"\S*ipykernel_\d+/\d+\.py", "<cell>", text)


def _last_lines(error):
    text = re.sub(r"\x1b\[[0-9;]*m", "", str(error)).strip()
    return "\n    ".join(text.splitlines()[-12:])
