"""Drives of exercise 02: infinity and NaN are honest answers here, so they travel as flags."""

import numpy as np

from slamlab.exercises.drives import Drive, StudentError, numbers, rows, shaped

FAR = 1e6  # a line nearly along the beam may be met anywhere; farther than this says no more [m]
NOTHING, FINITE, INFINITE = 0, 1, 2  # NaN, a number, infinity
NAMES = ("error", "blocked")


def distances(function):
    """Drive of a function that returns one distance, or infinity.

    Parameters
    ----------
    function : str, its name

    Returns
    -------
    run : (functions, inputs) -> {"met": (n,) whether a number came back, "distance": (n,) it, or 0}
    """

    def run(functions, inputs):
        results = [numbers(functions[function](*row), function) for row in rows(inputs)]
        wrong = next((r.shape for r in results if r.size != 1), None)
        if wrong is not None:
            raise StudentError("malformed", f"{function} returned shape {wrong}, not one number")
        distance = np.array([r.item() for r in results])
        if np.isnan(distance).any():
            raise StudentError(
                "malformed", f"{function} returned NaN: a beam that meets nothing is inf"
            )
        met = distance != np.inf  # −inf would be nearer than any wall
        distance = np.where(met, np.clip(distance, -FAR, FAR), 0.0)
        return {"met": met.astype(float), "distance": distance}

    return run


def placed(functions, inputs):
    """Call to_points once per scan; shorter answers are filled up with zeros.

    Parameters
    ----------
    functions : "to_points"
    inputs : degrees (n, k), millimetres (n, k), mount (n, 3), pose (n, 3)

    Returns
    -------
    {"points": (n, k, 2), "count": (n,) how many rows came back}

    Raises
    ------
    StudentError : "malformed" when a call returns no (k, 2) points, or too many, or NaN
    """
    most = inputs["degrees"].shape[1]
    points, count = np.zeros((len(inputs["degrees"]), most, 2)), []
    for i, row in enumerate(rows(inputs)):
        found = numbers(functions["to_points"](*row), "to_points")
        if not found.size:  # a list to which nothing was appended
            found = found.reshape(0, 2)
        if found.ndim != 2 or found.shape[1] != 2 or len(found) > most:
            turned = " (transposed?)" if found.ndim == 2 and found.shape[0] == 2 else ""
            raise StudentError(
                "malformed", f"to_points returned shape {found.shape}, expected (k, 2){turned}"
            )
        if np.isnan(found).any():
            raise StudentError(
                "malformed", "to_points returned NaN: leave out readings that did not come back"
            )
        points[i, : len(found)] = found
        count.append(float(len(found)))
    return {"points": points, "count": np.array(count)}


def thrice(functions, inputs):
    """Call noisy twice with the same seed, then with another one.

    Parameters
    ----------
    functions : "noisy"
    inputs : ranges (n, k), error (n,), dropouts (n,), seed (n,)

    Returns
    -------
    {"state": (n, 3, k) of NOTHING, FINITE, INFINITE, "ranges": (n, 3, k), 0 where not finite}

    Raises
    ------
    StudentError : "malformed" when a call does not return one number for each range
    """
    call, beams, calls = functions["noisy"], inputs["ranges"].shape[1], []
    for other in (0, 0, 1):
        found = [
            call(ranges, error, dropouts, np.random.default_rng([int(seed), other]))
            for ranges, error, dropouts, seed in rows(inputs)
        ]
        calls.append(_flagged([_row(result, "noisy", beams) for result in found]))
    return {name: np.stack([c[name] for c in calls], axis=1) for name in ("state", "ranges")}


def fitted(functions, inputs):
    """Call busy_fit on the scans of every sensor.

    Parameters
    ----------
    functions : "busy_fit"
    inputs : scans (n, k, beams) [m], step (n,) [m]

    Returns
    -------
    {"result": (n, 2) error and blocked}

    Raises
    ------
    StudentError : "malformed" when a call does not return two numbers
    """
    return {"result": np.array([_two(functions["busy_fit"](*row)) for row in rows(inputs)])}


def _two(result):
    if not isinstance(result, tuple | list | np.ndarray) or len(result) != 2:
        raise StudentError("malformed", "busy_fit must end with: return error, blocked")
    return [shaped(part, f"busy_fit's {n}", ()) for part, n in zip(result, NAMES, strict=True)]


def _row(result, function, length):
    row = numbers(result, function)
    if row.shape != (length,):
        raise StudentError(
            "malformed",
            f"{function} returned shape {row.shape}, expected ({length},): one number a beam",
        )
    return row


def _flagged(results):
    ranges = np.array(results)
    state = np.where(np.isnan(ranges), NOTHING, np.where(np.isinf(ranges), INFINITE, FINITE))
    return {"state": state.astype(float), "ranges": np.where(state == FINITE, ranges, 0.0)}


DRIVES = {
    "02-ray-wall": Drive(("ray_wall",), run=distances("ray_wall")),
    "02-echo": Drive(("echo",), run=distances("echo")),
    "02-to-points": Drive(("to_points",), run=placed),
    "02-noise": Drive(("noisy",), run=thrice),
    "02-busy-room": Drive(("busy_fit",), run=fitted),
}
