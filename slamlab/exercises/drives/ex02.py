"""Drives of exercise 02: infinity and NaN are honest answers here, so they travel as flags."""

import numpy as np

from slamlab.exercises.drives import Drive, StudentError, numbers, rows

FAR = 1e6  # a line nearly along the beam may be met anywhere; farther than this says no more [m]
NOTHING, FINITE, INFINITE = 0, 1, 2  # NaN, a number, infinity


def one_beam(functions, inputs):
    """Call ray_wall once per beam.

    Parameters
    ----------
    functions : "ray_wall"
    inputs : places p (n, 2), directions phi (n,), walls (n, 4)

    Returns
    -------
    {"met": (n,) whether a number came back, "distance": (n,) it, else 0}

    Raises
    ------
    StudentError : "malformed" when a call does not return one number, or returns NaN
    """
    results = [numbers(functions["ray_wall"](*row), "ray_wall") for row in rows(inputs)]
    wrong = next((r.shape for r in results if r.size != 1), None)
    if wrong is not None:
        raise StudentError("malformed", f"ray_wall returned shape {wrong}, expected one number")
    distance = np.array([r.item() for r in results])
    if np.isnan(distance).any():
        raise StudentError("malformed", "ray_wall returned NaN: a beam that meets nothing is inf")
    met = np.isfinite(distance)
    distance = np.where(met, np.clip(distance, -FAR, FAR), 0.0)
    return {"met": met.astype(float), "distance": distance}


def whole_scan(functions, inputs):
    """Call scan once per scene.

    Parameters
    ----------
    functions : "scan"
    inputs : p (n, 2), directions (n, k), walls (n, w, 4), range_max (n,)

    Returns
    -------
    {"state": (n, k) of NOTHING, FINITE, INFINITE, "ranges": (n, k), 0 where not finite}

    Raises
    ------
    StudentError : "malformed" when a call does not return one number for each beam
    """
    beams = inputs["directions"].shape[1]
    return _flagged([_row(functions["scan"](*row), "scan", beams) for row in rows(inputs)])


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
    {"state": (3, n, k) of NOTHING, FINITE, INFINITE, "ranges": (3, n, k), 0 where not finite}

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
    return {name: np.array([flags[name] for flags in calls]) for name in ("state", "ranges")}


def fitted(functions, inputs):
    """Call fit on every set of scans, and on the first few once more in millimetres.

    Parameters
    ----------
    functions : "fit"
    inputs : scans (n, k, beams) [m], again (m,), of which only the length counts

    Returns
    -------
    {"fit": (n, 2) error and dropouts, "in_mm": (m, 2)}

    Raises
    ------
    StudentError : "malformed" when a call does not return two numbers, or returns NaN
    """
    scans, call = inputs["scans"], functions["fit"]
    few = scans[: len(inputs["again"])]
    return {
        "fit": np.array([_two(call(each.copy())) for each in scans]),
        "in_mm": np.array([_two(call(1000 * each)) for each in few]),
    }


def _two(result):
    if not isinstance(result, tuple | list | np.ndarray) or len(result) != 2:
        raise StudentError("malformed", "fit must end with: return error, dropouts")
    parts = [numbers(part, "fit") for part in result]
    if any(part.size != 1 for part in parts):
        shapes = " and ".join(str(part.shape) for part in parts)
        raise StudentError("malformed", f"fit returned shapes {shapes}, expected two numbers")
    values = [part.item() for part in parts]
    if np.isnan(values).any():
        raise StudentError(
            "malformed",
            "fit returned NaN: the scans hold NaN, and a sum or a mean with a NaN in it is NaN",
        )
    return values


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
    "02-ray-wall": Drive(("ray_wall",), run=one_beam),
    "02-scan": Drive(("scan",), run=whole_scan),
    "02-to-points": Drive(("to_points",), run=placed),
    "02-noise": Drive(("noisy",), run=thrice),
    "02-fit": Drive(("fit",), run=fitted),
}
