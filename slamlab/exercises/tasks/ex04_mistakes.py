"""How a classic mistake of exercise 04 is recognised: by computing it on the same inputs."""

import numpy as np

from slamlab.exercises.law import Diagnosis
from slamlab.exercises.tasks.ex04_laws import close

DEGREE = np.pi / 180


def matrix(rows):
    """One matrix per input from a nested list of numbers and (n,) arrays.

    Parameters
    ----------
    rows : list of rows of numbers or (n,) arrays

    Returns
    -------
    (n, a, b)
    """
    entries = np.broadcast_arrays(*(np.asarray(e, dtype=float) for row in rows for e in row))
    return np.moveaxis(np.array(entries), 0, -1).reshape(-1, len(rows), len(rows[0]))


def mistake(name, hint, *wrong, part=np.s_[:], output="result", sizes_only=False):
    """A diagnosis: an output, or a part of it, equals one of the wrong formulas.

    Parameters
    ----------
    name, hint : str
    wrong : inputs -> (n, ...), each a form the mistake takes
    part : index into one matrix, such as np.s_[1, 1]; the whole of it by default
    output : str, the output looked at
    sizes_only : bool, compare without signs

    Returns
    -------
    Diagnosis
    """

    def matches(inputs, outputs):
        got = _part(outputs, output, part)
        return any(_same(got, formula(inputs), sizes_only) for formula in wrong)

    return Diagnosis(name, hint, matches)


def sign_mistake(name, hint, right, part=np.s_[:], output="result"):
    """A diagnosis: every entry has its right size, and not every one its sign.

    Parameters
    ----------
    name, hint, part, output : as for :func:`mistake`
    right : inputs -> (n, ...), with the right signs

    Returns
    -------
    Diagnosis
    """

    def matches(inputs, outputs):
        got, want = _part(outputs, output, part), right(inputs)
        return _same(got, want, sizes_only=True) and not _same(got, want)

    return Diagnosis(name, hint, matches)


def _part(outputs, output, part):
    return outputs[output][:, *(part if isinstance(part, tuple) else (part,))]


def _same(got, want, sizes_only=False):
    want = np.broadcast_to(want, got.shape)
    if sizes_only:
        got, want = np.abs(got), np.abs(want)
    return close(got, want).all()
