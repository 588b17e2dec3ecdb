"""Several values that a student's function returns at once: taken apart, checked, stacked."""

import numpy as np

from slamlab.exercises.drives import StudentError, shaped


def parts(value, function, shapes):
    """Convert the several values that a student's function returned to float arrays.

    Parameters
    ----------
    value : anything
    function : str, its name, for the message
    shapes : name of each value to its shape, in the order in which they are returned

    Returns
    -------
    list of arrays

    Raises
    ------
    StudentError : "malformed" when it is not so many arrays of these shapes
    """
    if not isinstance(value, tuple | list) or len(value) != len(shapes):
        raise StudentError("malformed", f"{function} must end with: return {', '.join(shapes)}")
    named = zip(value, shapes.items(), strict=True)
    return [shaped(part, f"{function}'s {name}", shape) for part, (name, shape) in named]


def stacked(values, function, shapes):
    """Convert what the calls of a student's function returned, as :func:`parts` does, and stack it.

    Parameters
    ----------
    values : iterable, a call each
    function, shapes : as of :func:`parts`

    Returns
    -------
    name to (n, *shape) array

    Raises
    ------
    StudentError : as of :func:`parts`
    """
    found = [parts(value, function, shapes) for value in values]
    return {name: np.array([each[k] for each in found]) for k, name in enumerate(shapes)}
