"""How exercise 14, the eMIR system, is driven: bytes and numbers go in, numbers come back."""

import numpy as np

from slamlab.exercises.drives import MAX_NUMBERS, Drive, StudentError, numbers, rows

LONGEST = 24
"""Characters of a command that are looked at; a right one has ten."""


def _table(value, function, columns, told):
    """What a function returned, as (n, columns)."""
    found = numbers(value, function)
    if found.size == 0:
        found = np.zeros((0, columns))
    if found.ndim != 2 or found.shape[1] != columns:
        turned = " (transposed?)" if found.ndim == 2 and found.shape[0] == columns else ""
        raise StudentError(
            "malformed", f"{function} returned shape {found.shape}, expected {told}{turned}"
        )
    if np.isnan(found).any():
        raise StudentError("malformed", f"{function} returned NaN")
    return found


def _filled(tables, most):
    """Tables of different lengths as one array, cut off or filled up with zeros; their lengths."""
    columns = tables[0].shape[1]
    filled = np.zeros((len(tables), most, columns))
    for row, table in zip(filled, tables, strict=True):
        row[: len(table)] = table[:most]
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
    nodes, count = _filled([_table(f, "nodes", 4, "(n, 4)") for f in found], most)
    return {"nodes": nodes, "count": count}


def commanded(functions, inputs):
    """The command for every pair of speeds, as codes of its characters.

    Parameters
    ----------
    functions : "command"
    inputs : speed (n,), turn (n,) whole numbers

    Returns
    -------
    {"codes": (n, LONGEST), 0 behind the end}
    """
    codes = np.zeros((len(inputs["speed"]), LONGEST))
    for row, (speed, turn) in zip(codes, rows(inputs), strict=True):
        text = functions["command"](int(speed), int(turn))
        if not isinstance(text, str):
            what = "None: is there a return at its end?" if text is None else type(text).__name__
            raise StudentError("malformed", f"command returned {what}, expected a text (str)")
        shown = [min(ord(character), 255) for character in text[:LONGEST]]
        row[: len(shown)] = shown
    return {"codes": codes}


def swept(functions, inputs):
    """The rays of every packet of the other lidar, or that it was refused.

    Parameters
    ----------
    functions : "sweep"
    inputs : data (n, k) bytes, -1 behind the end

    Returns
    -------
    {"taken": (n,) 0 where None came back, "count": (n,) how many rows, "rays": (n, m, 2),
    "heard": (n,) bytes of each packet, by which to refuse all is a mistake, not idleness}
    """
    found = []
    for (data,) in rows(inputs):
        found.append(functions["sweep"](bytes(data[data >= 0].astype(int).tolist())))
    taken = np.array([float(rays is not None) for rays in found])
    tables = [
        np.zeros((0, 2)) if rays is None else _table(rays, "sweep", 2, "(k, 2)") for rays in found
    ]
    rays, count = _filled(tables, inputs["data"].shape[1] // 3)
    heard = (inputs["data"] >= 0).sum(axis=1).astype(float)
    return {"taken": taken, "count": count, "rays": rays, "heard": heard}


def tried(functions, inputs):
    """The trials, one behind the other.

    Parameters
    ----------
    functions : "trials"
    inputs : not used, the function has no arguments

    Returns
    -------
    {"values", "counts": (n,) of all trials, "lengths": (k,) how many readings each has}
    """
    found = functions["trials"]()
    try:
        pairs = [(values, counts) for values, counts in found]
    except (TypeError, ValueError):
        raise StudentError(
            "malformed", "trials returned no list of pairs (values, counts)"
        ) from None
    values, counts = [np.zeros(0)], [np.zeros(0)]
    for k, pair in enumerate(pairs):
        two = [numbers(each, "trials") for each in pair]
        if two[0].ndim != 1 or two[0].shape != two[1].shape:
            shapes = " and ".join(str(each.shape) for each in two)
            raise StudentError(
                "malformed",
                f"values and counts of trials()[{k}] are of shape {shapes}, not both (n,)",
            )
        values.append(two[0])
        counts.append(two[1])
        if sum(map(len, values)) > MAX_NUMBERS:
            raise StudentError("malformed", "trials returned too many readings")
    lengths = [float(len(each)) for each in values[1:]]
    joined = np.concatenate(values), np.concatenate(counts)
    return {"values": joined[0], "counts": joined[1], "lengths": np.array(lengths)}


DRIVES = {
    "14-nodes": Drive(("nodes",), decoded),
    "14-command": Drive(("command",), commanded),
    "14-unwrap": Drive(("unwrap",)),
    "14-sweep": Drive(("sweep",), swept),
    "14-trials": Drive(("trials",), tried),
}
