"""Drives of exercise 03: one call per belief; a whole filter once per drive of the cart."""

import numpy as np

from slamlab.checks.drives import Drive, StudentError, numbers, rows


def pairs(*names):
    """A drive that keeps the two results of each call apart.

    Parameters
    ----------
    names : str, what the two results are called

    Returns
    -------
    (functions, inputs) -> {name: (n, ...)}
    """

    def run(functions, inputs):
        (function, call), *_ = functions.items()
        results = [_pair(call(*row), function, names) for row in rows(inputs)]
        return {
            name: _stacked([result[i] for result in results], f"{function}'s {name}")
            for i, name in enumerate(names)
        }

    return run


def filtered(functions, inputs):
    """Run the filter on every drive of the cart: the same start and matrices, other measurements.

    Parameters
    ----------
    functions : "kalman_filter"
    inputs : x (n,), P, F, Q (n, n), H (m, n), R (m, m), z (drives, steps, m)

    Returns
    -------
    {"x": (drives, steps, n), "P": (drives, steps, n, n)}

    Raises
    ------
    StudentError : "malformed" when there is not one belief per measurement
    """
    call, steps = functions["kalman_filter"], inputs["z"].shape[1]
    beliefs = {"x": [], "P": []}
    for z in inputs["z"]:
        start = [inputs[name].copy() for name in ("x", "P")]
        matrices = [inputs[name].copy() for name in ("F", "Q", "H", "R")]
        result = _pair(call(*start, z.copy(), *matrices), "kalman_filter", ("xs", "Ps"))
        for (name, found), part in zip(beliefs.items(), result, strict=True):
            array = numbers(_list(part), f"kalman_filter's {name}s")
            if len(np.atleast_1d(array)) != steps:
                raise StudentError(
                    "malformed",
                    f"kalman_filter's {name}s has {len(np.atleast_1d(array))} entries for {steps} "
                    "measurements: one after each of them, the start left out",
                )
            found.append(array)
    return {name: _stacked(found, f"kalman_filter's {name}s") for name, found in beliefs.items()}


def _pair(result, function, names):
    if not isinstance(result, tuple | list) or len(result) != 2:
        raise StudentError("malformed", f"{function} must end with: return {', '.join(names)}")
    return result


def _list(part):
    # what a generator or zip holds is as good as a list of it
    return list(part) if hasattr(part, "__next__") else part


def _stacked(results, what):
    arrays = [numbers(result, what) for result in results]
    shapes = sorted({array.shape for array in arrays})
    if len(shapes) > 1:
        raise StudentError("malformed", f"{what} has different shapes: {shapes[0]}, {shapes[1]}")
    return np.array(arrays)


DRIVES = {
    "03-predict": Drive(("predict",), pairs("x", "P")),
    "03-innovation": Drive(("innovation",), pairs("v", "S")),
    "03-gain": Drive(("gain",)),
    "03-update": Drive(("update",), pairs("x", "P")),
    "03-filter": Drive(("kalman_filter",), filtered),
}
