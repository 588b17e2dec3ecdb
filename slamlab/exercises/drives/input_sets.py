"""Sets of inputs of one task: the random ones and the probes, run one by one, sent in one
message."""

import numpy as np

from slamlab.exercises.drives import StudentError

MAIN = ""
"""Name of the set of random inputs; the others are probes."""


def run_sets(drive, namespace, sets):
    """Run a drive on each set; what fails on a probe costs that probe only.

    Parameters
    ----------
    drive : Drive
    namespace : the student's names
    sets : set's name to name to array

    Returns
    -------
    set's name to the drive's outputs, or to the StudentError it met

    Raises
    ------
    StudentError : where the random inputs could not be run
    """
    answers = {}
    for name, inputs in sets.items():
        try:
            answers[name] = drive(namespace, inputs)
        except StudentError as error:
            if name == MAIN:
                raise
            answers[name] = error
    return answers


def joined(sets) -> dict[str, np.ndarray]:
    """The arrays of all sets under one name each, "number of the set/name"."""
    return {
        f"{k}/{name}": array
        for k, inputs in enumerate(sets.values())
        if not isinstance(inputs, StudentError)
        for name, array in inputs.items()
    }


def parted(names, arrays) -> dict[str, dict[str, np.ndarray]]:
    """The sets that :func:`joined` made one of.

    Parameters
    ----------
    names : the sets' names in order
    arrays : name to array, not to be trusted: what belongs to no set is left out

    Returns
    -------
    set's name to name to array
    """
    sets = {name: {} for name in names}
    numbered = {str(k): name for k, name in enumerate(names)}
    for key, array in arrays.items():
        number, slash, name = key.partition("/")
        if slash and number in numbered:
            sets[numbered[number]][name] = array
    return sets
