"""Drives of exercise 08: lines and pairs come back as tuples, a wall or none, lists with gaps."""

import numpy as np

from slamlab.exercises.drives import Drive, StudentError, numbers, rows


def fitted(functions, inputs):
    """Call fit_line on every cloud and on the same cloud turned.

    Parameters
    ----------
    functions : "fit_line"
    inputs : points (n, k, 2), turned (n, k, 2)

    Returns
    -------
    {"line": (n, 2), "again": (n, 2)}

    Raises
    ------
    StudentError : "malformed" when a call does not return two numbers
    """
    fit_line = functions["fit_line"]
    return {
        output: np.array([_array(fit_line(p.copy()), "fit_line", (2,)) for p in inputs[name]])
        for output, name in (("line", "points"), ("again", "turned"))
    }


def found(functions, inputs):
    """Call find_wall on every cloud, each with a generator of its own.

    Parameters
    ----------
    functions : "find_wall", and "fit_line", which it calls
    inputs : points (n, k, 2), band, needed, tries, seed (n,)

    Returns
    -------
    {"found": (n,) 0 or 1, "line": (n, 2), "inside": (n, k)}; zeros where there is no wall

    Raises
    ------
    StudentError : "malformed" when a call returns neither None nor two numbers and a mask
    """
    count, k = inputs["points"].shape[:2]
    out = {"found": np.zeros(count), "line": np.zeros((count, 2)), "inside": np.zeros((count, k))}
    for row, (points, band, needed, tries, seed) in enumerate(rows(inputs)):
        rng = np.random.default_rng(int(seed))
        wall = functions["find_wall"](points, band, int(needed), int(tries), rng)
        if wall is None:
            continue
        if not isinstance(wall, tuple | list) or len(wall) != 3:
            raise StudentError("malformed", "find_wall must return rho, alpha, inside, or None")
        out["found"][row] = 1
        out["line"][row] = _array(wall[:2], "find_wall's rho, alpha", (2,))
        out["inside"][row] = _mask(wall[2], k)
    return out


def _mask(inside, k):
    """Which points were taken, from a mask or from a list of rows."""
    array = numbers(inside, "find_wall's inside")
    if array.shape != (k,) or not np.isin(array, [0, 1]).all():
        raise StudentError(
            "malformed", f"find_wall's inside is a bool for each point: shape ({k},), True or False"
        )
    return array


def cornered(functions, inputs):
    """Call corner on every pair of lines.

    Parameters
    ----------
    functions : "corner"
    inputs : z1 (n, 2), R1 (n, 2, 2), z2, R2

    Returns
    -------
    {"p": (n, 2), "P": (n, 2, 2)}

    Raises
    ------
    StudentError : "malformed" when a call does not return two arrays of these shapes
    """
    pairs = [_pair(functions["corner"](*row), "corner", "p, P") for row in rows(inputs)]
    return {
        "p": np.array([_array(p, "corner's p", (2,)) for p, _ in pairs]),
        "P": np.array([_array(P, "corner's P", (2, 2)) for _, P in pairs]),
    }


def observed(functions, inputs):
    """Call h_line and H_lines on every pose and line.

    Parameters
    ----------
    functions : "h_line" and "H_lines"
    inputs : x (n, 3), line (n, 2)

    Returns
    -------
    {"z": (n, 2), "H_r": (n, 2, 3), "H_p": (n, 2, 2)}

    Raises
    ------
    StudentError : "malformed" when a result is no array of that shape
    """
    z = [_array(functions["h_line"](*row), "h_line", (2,)) for row in rows(inputs)]
    pairs = [_pair(functions["H_lines"](*row), "H_lines", "H_r, H_p") for row in rows(inputs)]
    return {
        "z": np.array(z),
        "H_r": np.array([_array(H_r, "H_lines' H_r", (2, 3)) for H_r, _ in pairs]),
        "H_p": np.array([_array(H_p, "H_lines' H_p", (2, 2)) for _, H_p in pairs]),
    }


def associated(functions, inputs):
    """Call associate on every scene.

    Parameters
    ----------
    functions : "associate"
    inputs : z (n, m, 2), expected (n, N, 2), S (n, N, 2, 2), gate (n,)

    Returns
    -------
    {"pairs": (n, m)}, −1 for None

    Raises
    ------
    StudentError : "malformed" when a call does not return m whole numbers below N, or None
    """
    count, walls = inputs["z"].shape[1], inputs["expected"].shape[1]
    out = []
    for row in rows(inputs):
        pairs = functions["associate"](*row)
        if pairs is None or isinstance(pairs, str | dict) or not hasattr(pairs, "__len__"):
            raise StudentError("malformed", "associate must return a list, an entry a sighting")
        if len(pairs) != count:
            raise StudentError(
                "malformed", f"associate returned {len(pairs)} entries for {count} sightings"
            )
        out.append([-1 if entry is None else _number(entry, walls) for entry in pairs])
    return {"pairs": np.array(out, dtype=float)}


def _number(entry, walls):
    number = numbers(entry, "associate's entry")
    if number.shape != () or number != np.floor(number) or not 0 <= number < walls:
        raise StudentError(
            "malformed", f"associate: each entry is a wall's number, 0 to {walls - 1}, or None"
        )
    return float(number)


def _pair(value, function, names):
    if not isinstance(value, tuple | list) or len(value) != 2:
        raise StudentError("malformed", f"{function} must end with: return {names}")
    return value


def _array(value, what, shape):
    array = numbers(value, what)
    if array.shape != shape:
        raise StudentError("malformed", f"{what} has shape {array.shape}, expected {shape}")
    return array


DRIVES = {
    "08-fit-line": Drive(("fit_line",), run=fitted),
    "08-ransac": Drive(("find_wall",), run=found),
    "08-corner": Drive(("corner",), run=cornered),
    "08-h-line": Drive(("h_line", "H_lines"), run=observed),
    "08-associate": Drive(("associate",), run=associated),
}
