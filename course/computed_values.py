"""Computed values in prose: ``{= error:.2f =}`` in a text is evaluated like an f-string.

The kernel that runs the notebook computes the values, and the notebook stores them with the text.
Therefore, a notebook that is derived again without being run still contains the values.
"""

import copy
import json
import re

import nbformat

from slamlab.views.notebook_output import grouped

MARK = re.compile(r"\{=\s*(.+?)\s*=\}", re.DOTALL)
_LIST = re.compile(r"(?<=.\n)\{=[^{}]*=\}(?=\.\s)")
_MINUS = re.compile(r"(?<!\w)-(?=[\d.])")
_PER_CENT = re.compile(r"(?<=\d)%")
_ADDED = "slamlab_values"  # metadata of a computing cell


def expressions(cell):
    """List the expressions in a cell's text in order.

    Parameters
    ----------
    cell : NotebookNode

    Returns
    -------
    list of str, each as in an f-string: an expression, a format
    """
    return MARK.findall(cell.source) if cell.cell_type == "markdown" else []


def with_computing_cells(notebook):
    """Insert a code cell, which outputs the values, before each text with values.

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
    """Remove the computing cells from an executed notebook, and insert their values into its texts.

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
    """Insert the values of a stored notebook into the texts of a derived one.

    Parameters
    ----------
    derived : NotebookNode, left as it is
    stored : NotebookNode

    Returns
    -------
    NotebookNode, or None if the stored one lacks a value
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
    """Return whether a cell is a computing cell, which was added to compute values."""
    return _ADDED in cell.metadata


def _computing(wanted):
    # without new names, so that a lesson's own json or text is not overwritten
    values = ", ".join(f"f'''{{{each}}}'''" for each in wanted)
    code = f"print(__import__('json').dumps([{values}]))"
    return nbformat.v4.new_code_cell(code, metadata={_ADDED: True})


def _fill(cell, values):
    # a value that begins a line and ends a sentence would begin a list: "1. …"
    whole = _LIST.sub(r"\g<0>\\", cell.source)
    cell.source = MARK.sub(lambda found: _typeset(values[found[1]]), whole)
    known = cell.metadata.get("slamlab", {})
    cell.metadata["slamlab"] = nbformat.from_dict(known | {"values": values})


def _typeset(value):
    """Format a value for the text: −3, 38 %, 10 000."""
    return grouped(_PER_CENT.sub(" %", _MINUS.sub("−", value)))


def _kept(cell):
    return cell.metadata.get("slamlab", {}).get("values", {})
