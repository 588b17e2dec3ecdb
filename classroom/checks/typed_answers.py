"""Comparison of a value that the reader of a lesson computes with the value that it should have."""

import numpy as np

UNANSWERED = "Replace the dots ... by your expression and run this cell again."


def describe_difference(yours, expected, tolerance):
    """Describe in a sentence how a reader's value differs from the expected value, which it omits.

    Parameters
    ----------
    yours : number, array, or sympy expression or matrix; ``...`` if it is unanswered
    expected : the same kind of value
    tolerance : float, largest accepted difference of an entry, relative to the largest entry
    """
    if yours is ...:
        return UNANSWERED
    if hasattr(expected, "free_symbols"):
        return _symbolic(yours, expected)
    try:
        yours, expected = np.asarray(yours, dtype=float), np.asarray(expected, dtype=float)
    except (TypeError, ValueError):
        return f"✗ Expected a number or an array of numbers, not {type(yours).__name__}."
    if yours.shape != expected.shape:
        return f"✗ The shape is {yours.shape}; it should be {expected.shape}."
    if yours.size == 0:
        return "✓ Correct."
    if not np.all(np.isfinite(yours)):
        return "✗ Not yet. Your value is not finite."
    difference = np.abs(yours - expected)
    wrong = difference > tolerance * np.max(np.abs(expected), initial=1e-12)
    if not np.any(wrong):
        return "✓ Correct."
    if yours.ndim == 0:
        return f"✗ Not yet. Your value differs by {difference:.3g}."
    index = tuple(map(int, np.unravel_index(np.argmax(difference), yours.shape)))
    return (
        f"✗ Not yet. {np.count_nonzero(wrong)} of {yours.size} entries differ. The largest "
        f"difference is {difference[index]:.3g} at index {index[0] if len(index) == 1 else index}."
    )


def _symbolic(yours, expected):
    import sympy as sp

    try:
        difference = sp.sympify(yours) - expected
    except Exception:  # sympy raises its own errors for shapes and for objects that it cannot read
        return f"✗ Expected an expression like {type(expected).__name__}, with the same shape."
    if hasattr(difference, "applyfunc"):
        entries = difference.applyfunc(sp.simplify)
        wrong = [index for index in np.ndindex(entries.shape) if entries[index] != 0]
        return f"✗ Not yet. Entry {wrong[0]} differs." if wrong else "✓ Correct."
    return "✓ Correct." if sp.simplify(difference) == 0 else "✗ Not yet. The expressions differ."
