"""How exercise 14, the eMIR system, is driven: bytes and texts go in, numbers come back."""

import numpy as np

from slamlab.exercises.drives import Drive, StudentError, numbers, rows

LONGEST = 24
"""Characters of a command that are looked at; a right one has ten."""


def _table(value, function, columns, most, told):
    """What a function returned, as (n, columns), n up to a limit."""
    found = numbers(value, function)
    if found.size == 0:
        found = np.zeros((0, columns))
    if found.ndim != 2 or found.shape[1] != columns or len(found) > most:
        turned = " (transposed?)" if found.ndim == 2 and found.shape[0] == columns else ""
        raise StudentError(
            "malformed", f"{function} returned shape {found.shape}, expected {told}{turned}"
        )
    if np.isnan(found).any():
        raise StudentError("malformed", f"{function} returned NaN")
    return found


def _filled(tables, most):
    """Tables of different lengths as one array, filled up with zeros, and their lengths."""
    columns = tables[0].shape[1]
    filled = np.zeros((len(tables), most, columns))
    for row, table in zip(filled, tables, strict=True):
        row[: len(table)] = table
    return filled, np.array([float(len(table)) for table in tables])


def decoded(functions, inputs):
    """The nodes of every packet of bytes.

    Parameters
    ----------
    functions : "nodes"
    inputs : data (n, 5 k) bytes

    Returns
    -------
    {"nodes": (n, k, 4), "count": (n,) how many rows came back}
    """
    call, most = functions["nodes"], inputs["data"].shape[1] // 5
    found = [call(bytes(data.astype(int).tolist())) for (data,) in rows(inputs)]
    nodes, count = _filled([_table(f, "nodes", 4, most, "(n, 4)") for f in found], most)
    return {"nodes": nodes, "count": count}


def commanded(functions, inputs):
    """The command for every pair of speeds, as codes of its characters.

    Parameters
    ----------
    functions : "command"
    inputs : speed (n,), turn (n,) whole numbers

    Returns
    -------
    {"codes": (n, LONGEST), 0 behind the end, "length": (n,)}
    """
    codes, length = np.zeros((len(inputs["speed"]), LONGEST)), []
    for row, (speed, turn) in zip(codes, rows(inputs), strict=True):
        text = functions["command"](int(speed), int(turn))
        if isinstance(text, bytes):
            text = text.decode("latin-1")
        if not isinstance(text, str):
            what = "nothing: is there a return at its end?" if text is None else type(text).__name__
            raise StudentError("malformed", f"command returned {what}, expected a text (str)")
        shown = [min(ord(character), 255) for character in text[:LONGEST]]
        row[: len(shown)] = shown
        length.append(float(len(text)))
    return {"codes": codes, "length": np.array(length)}


def reported(functions, inputs):
    """What is read in every status frame, or that it was refused.

    Parameters
    ----------
    functions : "status"
    inputs : codes (n, 36) of the characters

    Returns
    -------
    {"taken": (n,) 0 where None came back, "values": (n, 5)}
    """
    taken, values = [], []
    for (codes,) in rows(inputs):
        found = functions["status"]("".join(map(chr, codes.astype(int).tolist())))
        taken.append(float(found is not None))
        five = np.zeros(5) if found is None else numbers(found, "status")
        if five.shape != (5,):
            raise StudentError(
                "malformed", f"status returned shape {five.shape}, expected five numbers or None"
            )
        values.append(five)
    return {"taken": np.array(taken), "values": np.array(values)}


def placed(functions, inputs):
    """The points of every turn.

    Parameters
    ----------
    functions : "points"
    inputs : degrees (n, k), millimetres (n, k), front (n,)

    Returns
    -------
    {"points": (n, k, 2), "count": (n,) how many rows came back}
    """
    call, most = functions["points"], inputs["degrees"].shape[1]
    found = [call(*row) for row in rows(inputs)]
    points, count = _filled([_table(f, "points", 2, most, "(k, 2)") for f in found], most)
    return {"points": points, "count": count}


DRIVES = {
    "14-nodes": Drive(("nodes",), decoded),
    "14-command": Drive(("command",), commanded),
    "14-status": Drive(("status",), reported),
    "14-unwrap": Drive(("unwrap",)),
    "14-points": Drive(("points",), placed),
}
