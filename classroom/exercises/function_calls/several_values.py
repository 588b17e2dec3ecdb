"""Check and stack the values of a student's function that returns several values."""

import numpy as np

from classroom.exercises.function_calls import StudentError, to_shaped_array


def split_values(value, function, shapes):
    """Convert returned values to float arrays. Raises StudentError "malformed".

    shapes : shape of each value by name, in the order of the return statement."""
    if not isinstance(value, tuple | list) or len(value) != len(shapes):
        raise StudentError("malformed", f"{function} must end with: return {', '.join(shapes)}")
    named = zip(value, shapes.items(), strict=True)
    return [to_shaped_array(part, f"{function}'s {name}", shape) for part, (name, shape) in named]


def stack_values(values, function, shapes):
    """Apply :func:`split_values` to many calls; return (n, *shape) arrays by name."""
    found = [split_values(value, function, shapes) for value in values]
    return {name: np.array([each[k] for each in found]) for k, name in enumerate(shapes)}
