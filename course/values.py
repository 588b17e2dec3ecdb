"""Values in prose: ``{= error:.2f =}`` in a text is computed where it stands, as an f-string would.

The kernel that runs the notebook computes them, and the notebook keeps them beside the text, so
that a notebook that is derived again without being run has them still.
"""

import copy
import json
import re

import nbformat

from slamlab.displays import grouped

MARK = re.compile(r"\{=\s*(.+?)\s*=\}", re.DOTALL)
_MINUS = re.compile(r"(?<!\w)-(?=[\d.])")
_PER_CENT = re.compile(r"(?<=\d)%")
_ADDED = "slamlab_values"  # metadata of a computing cell


def expressions(cell):
    """The expressions in a cell's text, in their order.

    Parameters
    ----------
    cell : NotebookNode

    Returns
    -------
    list of str, each as in an f-string: an expression, a format
    """
    return MARK.findall(cell.source) if cell.cell_type == "markdown" else []


def with_computing_cells(notebook):
    """A notebook with a cell of code before each text that has values; its output is those.

    Parameters
    ----------
    notebook : NotebookNode, derived; left as it is

    Returns
    -------
    NotebookNode
    """
    computing = copy.copy(notebook)
    computing.cells = []
    for cell in notebook.cells:
        if wanted := expressions(cell):
            computing.cells.append(_computing(wanted))
        computing.cells.append(cell)
    return computing


def take_computed(notebook):
    """Take the computing cells out of a notebook that was run, and their values into its texts.

    Parameters
    ----------
    notebook : NotebookNode, changed in place
    """
    cells, computed = [], None
    for cell in notebook.cells:
        if is_computing(cell):
            computed = json.loads(cell.outputs[0].text)
            continue
        if wanted := expressions(cell):
            _fill(cell, dict(zip(wanted, computed, strict=True)))
        cells.append(cell)
    notebook.cells = cells


def carry(derived, stored):
    """Carry values over: the derived notebook, its texts filled with what a stored one keeps.

    Parameters
    ----------
    derived : NotebookNode, left as it is
    stored : NotebookNode

    Returns
    -------
    NotebookNode, or None where the stored one lacks a value
    """
    filled, kept = copy.deepcopy(derived), {cell.id: _kept(cell) for cell in stored.cells}
    for cell in filled.cells:
        wanted = expressions(cell)
        values = kept.get(cell.id, {})
        if set(wanted) - set(values):
            return None
        if wanted:
            _fill(cell, {each: values[each] for each in wanted})
    return filled


def is_computing(cell):
    """Whether a cell was added to compute values."""
    return _ADDED in cell.metadata


def _computing(wanted):
    # not by names: what a lesson calls json, or text, stays its own
    values = ", ".join(f"f'''{{{each}}}'''" for each in wanted)
    code = f"print(__import__('json').dumps([{values}]))"
    return nbformat.v4.new_code_cell(code, metadata={_ADDED: True})


def _fill(cell, values):
    cell.source = MARK.sub(lambda found: _typeset(values[found[1]]), cell.source)
    told = cell.metadata.get("slamlab", {})
    cell.metadata["slamlab"] = nbformat.from_dict(told | {"values": values})


def _typeset(value):
    """A value as the text writes numbers: −3, 38 %, 10 000."""
    return grouped(_PER_CENT.sub(" %", _MINUS.sub("−", value)))


def _kept(cell):
    return cell.metadata.get("slamlab", {}).get("values", {})
