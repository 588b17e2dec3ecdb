"""Drives of exercise 08: pairs come back as tuples, a pillar or none, lists with gaps."""

import numpy as np

from slamlab.exercises.drives import Drive, StudentError, numbers, rows, shaped


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
    pairs = [_parts(functions["corner"](*row), "corner", "p, P") for row in rows(inputs)]
    return {
        "p": np.array([shaped(p, "corner's p", (2,)) for p, _ in pairs]),
        "P": np.array([shaped(P, "corner's P", (2, 2)) for _, P in pairs]),
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
    (n, count), walls = inputs["z"].shape[:2], inputs["expected"].shape[1]
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
    return {"pairs": np.array(out, dtype=float).reshape(n, count)}


def _number(entry, walls):
    number = numbers(entry, "associate's entry")
    if number.shape != () or number != np.floor(number) or not 0 <= number < walls:
        which = f"a wall's number, 0 to {walls - 1}, or None" if walls else "None: no wall is known"
        raise StudentError("malformed", f"associate: each entry is {which}")
    return float(number)


def pillars(functions, inputs):
    """Call fit_circle on every arc, and find_pillar on every cloud, each with its own generator.

    Parameters
    ----------
    functions : "fit_circle", "find_pillar"
    inputs : arc (n, j, 2), points (n, k, 2), band, largest, needed, tries, seed (n,)

    Returns
    -------
    {"circle": (n, 3), "found": (n,) 0 or 1, "pillar": (n, 3), "inside": (n, k)}; the last two are
    zeros where there is none

    Raises
    ------
    StudentError : "malformed" when a call returns something else
    """
    n, k = inputs["points"].shape[:2]
    circle = [_circle(functions["fit_circle"](arc.copy()), "fit_circle") for arc in inputs["arc"]]
    out = {"found": np.zeros(n), "pillar": np.zeros((n, 3)), "inside": np.zeros((n, k))}
    clouds = {name: array for name, array in inputs.items() if name != "arc"}
    for row, (points, band, largest, needed, tries, seed) in enumerate(rows(clouds)):
        rng = np.random.default_rng(int(seed))
        found = functions["find_pillar"](points, band, largest, int(needed), int(tries), rng)
        if found is None:
            continue
        if not isinstance(found, tuple | list) or len(found) != 3:
            raise StudentError(
                "malformed", "find_pillar must return centre, radius, inside, or None"
            )
        out["found"][row] = 1
        out["pillar"][row] = _circle(found[:2], "find_pillar")
        out["inside"][row] = _mask(found[2], k)
    return {"circle": np.array(circle)} | out


def _circle(value, function):
    centre, radius = _parts(value, function, "centre, radius")
    centre = shaped(centre, f"{function}'s centre", (2,))
    return np.append(centre, shaped(radius, f"{function}'s radius", ()))


def _mask(inside, k):
    array = numbers(inside, "find_pillar's inside")
    if array.shape != (k,) or not np.isin(array, [0, 1]).all():
        raise StudentError(
            "malformed",
            f"find_pillar's inside is a bool for each point: shape ({k},), True or False",
        )
    return array


def segmented(functions, inputs):
    """Call segment on every scan.

    Parameters
    ----------
    functions : "segment"
    inputs : points (n, k, 2), share (n,)

    Returns
    -------
    {"labels": (n, k)}

    Raises
    ------
    StudentError : "malformed" when a call does not return k whole numbers from −1 on
    """
    k = inputs["points"].shape[1]
    labels = [shaped(functions["segment"](*row), "segment", (k,)) for row in rows(inputs)]
    if any((one != np.floor(one)).any() or (one < -1).any() for one in labels):
        raise StudentError("malformed", "segment: labels are whole numbers from 0 on, or −1")
    return {"labels": np.array(labels)}


def _parts(value, function, names):
    if not isinstance(value, tuple | list) or len(value) != 2:
        raise StudentError("malformed", f"{function} must end with: return {names}")
    return value


DRIVES = {
    "08-fit-line": Drive(("fit_line",)),
    "08-corner": Drive(("corner",), run=cornered),
    "08-associate": Drive(("associate",), run=associated),
    "08-pillar": Drive(("fit_circle", "find_pillar"), run=pillars),
    "08-segments": Drive(("segment",), run=segmented),
}
