"""Function calls of exercise 14, drivers of devices."""

import numpy as np

from classroom.exercises.function_calls import (
    MAX_NUMBERS,
    FunctionCall,
    StudentError,
    argument_rows,
    to_array,
)


def _table(value, function, columns, expected):
    found = to_array(value, function)
    if found.size == 0:
        found = np.zeros((0, columns))
    if found.ndim != 2 or found.shape[1] != columns:
        turned = " (transposed?)" if found.ndim == 2 and found.shape[0] == columns else ""
        raise StudentError(
            "malformed", f"{function} returned shape {found.shape}, expected {expected}{turned}"
        )
    if np.isnan(found).any():
        raise StudentError("malformed", f"{function} returned NaN")
    return found


def _pad(tables, most):
    """Return tables as one array, truncated or padded with zeros, and their lengths."""
    columns = tables[0].shape[1]
    filled = np.zeros((len(tables), most, columns))
    for row, table in zip(filled, tables, strict=True):
        row[: len(table)] = table[:most]
    return filled, np.array([float(len(table)) for table in tables])


def call_nodes(functions, inputs):
    """Call "nodes"; return {"nodes": (n, k, 4), "count": (n,) numbers of rows}."""
    call, most = functions["nodes"], inputs["data"].shape[1] // 5
    found = [call(bytes(data.astype(int).tolist())) for (data,) in argument_rows(inputs)]
    nodes, count = _pad([_table(f, "nodes", 4, "(n, 4)") for f in found], most)
    return {"nodes": nodes, "count": count}


def call_sweep(functions, inputs):
    """Call "sweep"; return {"taken": (n,) 0 for None, "count": (n,) numbers of rows, "rays":
    (n, m, 2), `received`: (n,) bytes}.
    """
    found = []
    for (data,) in argument_rows(inputs):
        found.append(functions["sweep"](bytes(data[data >= 0].astype(int).tolist())))
    taken = np.array([float(rays is not None) for rays in found])
    tables = [
        np.zeros((0, 2)) if rays is None else _table(rays, "sweep", 2, "(k, 2)") for rays in found
    ]
    rays, count = _pad(tables, inputs["data"].shape[1] // 3)
    # with the number of bytes, refusing all packets is a mistake and not a degenerate answer
    length = (inputs["data"] >= 0).sum(axis=1).astype(float)
    return {"taken": taken, "count": count, "rays": rays, "received": length}


def call_deskew(functions, inputs):
    """Call "deskew" for each scan; return {"points": (n, k, 2), "count": (n,) of points}."""
    found = [functions["deskew"](*row) for row in argument_rows(inputs)]
    tables = [_table(points, "deskew", 2, "(m, 2)") for points in found]
    points, count = _pad(tables, inputs["ranges"].shape[1])
    return {"points": points, "count": count}


def call_trials(functions, inputs):
    """Call "trials" and concatenate its pairs; return {"values", "counts": (n,), "lengths":
    (k,)}."""
    found = functions["trials"]()
    try:
        pairs = [(values, counts) for values, counts in found]
    except (TypeError, ValueError):
        raise StudentError(
            "malformed", "trials must return a list of pairs (values, counts)"
        ) from None
    values, counts = [np.zeros(0)], [np.zeros(0)]
    for k, pair in enumerate(pairs):
        two = [to_array(each, "trials") for each in pair]
        if two[0].ndim != 1 or two[0].shape != two[1].shape:
            shapes = " and ".join(str(each.shape) for each in two)
            raise StudentError(
                "malformed",
                f"values and counts of trials()[{k}] have shapes {shapes}, expected (n,) for both",
            )
        values.append(two[0])
        counts.append(two[1])
        if sum(map(len, values)) > MAX_NUMBERS:
            raise StudentError("malformed", "trials returned too many readings")
    lengths = [float(len(each)) for each in values[1:]]
    joined = np.concatenate(values), np.concatenate(counts)
    return {"values": joined[0], "counts": joined[1], "lengths": np.array(lengths)}


CALLS = {
    "14-nodes": FunctionCall(("nodes",), call_nodes),
    "14-deskew": FunctionCall(("deskew",), call_deskew),
    "14-unwrap": FunctionCall(("unwrap",)),
    "14-sweep": FunctionCall(("sweep",), call_sweep),
    "14-trials": FunctionCall(("trials",), call_trials),
}
