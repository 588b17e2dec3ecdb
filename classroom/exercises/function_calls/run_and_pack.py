"""Call functions on all sets of inputs of a task, and pack the sets into one message.

``Task.draw_inputs`` draws the sets: random inputs and probes."""

import numpy as np

from classroom.exercises.function_calls import StudentError

MAIN = ""
"""Name of the set of random inputs; the other sets are probes."""


def call_on_sets(call, namespace, sets):
    """Call functions on each set; return, by name, the outputs or the StudentError of a probe.

    A StudentError on the random inputs is raised."""
    answers = {}
    for name, inputs in sets.items():
        try:
            answers[name] = call(namespace, inputs)
        except StudentError as error:
            if name == MAIN:
                raise
            answers[name] = error
    return answers


def pack_sets(sets) -> dict[str, np.ndarray]:
    """Pack the arrays of all sets into one dict, with keys "number of the set/name"."""
    return {
        f"{k}/{name}": array
        for k, inputs in enumerate(sets.values())
        if not isinstance(inputs, StudentError)
        for name, array in inputs.items()
    }


def unpack_sets(names, arrays) -> dict[str, dict[str, np.ndarray]]:
    """Unpack the sets of :func:`pack_sets`; drop untrusted arrays that belong to no set."""
    sets = {name: {} for name in names}
    numbered = {str(k): name for k, name in enumerate(names)}
    for key, array in arrays.items():
        number, slash, name = key.partition("/")
        if slash and number in numbered:
            sets[numbered[number]][name] = array
    return sets
