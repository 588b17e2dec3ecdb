"""Drives of exercise 03: one call per belief; a whole filter once per drive of the cart."""

import numpy as np

from slamlab.exercises.drives import Drive, StudentError, numbers, rows


def pairs(**like):
    """A drive that keeps the two results of each call apart.

    Parameters
    ----------
    like : the result's name to that of the argument whose shape it has

    Returns
    -------
    (functions, inputs) -> {name: (n, ...)}
    """

    def run(functions, inputs):
        (function, call), *_ = functions.items()
        shapes = [inputs[name].shape[1:] for name in like.values()]
        found = {name: [] for name in like}
        for row in rows(inputs):
            result = _pair(call(*row), function, like)
            for name, part, shape in zip(like, result, shapes, strict=True):
                what = f"{function}'s {name}"
                found[name].append(_shaped(numbers(part, what), what, shape))
        return {name: np.array(parts) for name, parts in found.items()}

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
            for entry in array:
                _shaped(entry, f"an entry of kalman_filter's {name}s", inputs[name].shape)
            found.append(array)
    return {name: np.array(found) for name, found in beliefs.items()}


def _pair(result, function, names):
    if not isinstance(result, tuple | list) or len(result) != 2:
        raise StudentError("malformed", f"{function} must end with: return {', '.join(names)}")
    return result


def _list(part):
    # what a generator or zip holds is as good as a list of it
    return list(part) if hasattr(part, "__next__") else part


def _shaped(array, what, shape):
    """The array, when it has the shape expected: that of one call, as the student sees it."""
    if np.shape(array) != shape:
        raise StudentError("malformed", f"{what} has shape {np.shape(array)}, expected {shape}")
    return array


DRIVES = {
    "03-predict": Drive(("predict",), pairs(x="x", P="P")),
    "03-innovation": Drive(("innovation",), pairs(v="z", S="R")),
    "03-gain": Drive(("gain",)),
    "03-update": Drive(("update",), pairs(x="x", P="P")),
    "03-filter": Drive(("kalman_filter",), filtered),
}
