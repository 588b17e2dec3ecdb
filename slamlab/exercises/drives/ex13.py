"""How exercise 13, scan matching, is driven: each pair of clouds is one call."""

import numpy as np

from slamlab.exercises.drives import Drive, StudentError, call_each, rows, shaped


def _matched(functions, inputs):
    """Each match after as many rounds as it is to have."""
    name, match = next(iter(functions.items()))

    def call(source, target, T, rounds, *share):
        return match(source, target, T, int(rounds), *share)

    return call_each({name: call}, inputs)


def _stepped(functions, inputs):
    """The step of every guess, and its covariance."""
    found = []
    for row in rows(inputs):
        value = functions["line_step"](*row)
        if not isinstance(value, tuple | list) or len(value) != 2:
            raise StudentError("malformed", "line_step must end with: return delta, P")
        delta, P = value
        found.append((shaped(delta, "line_step's delta", (3,)), shaped(P, "line_step's P", (3, 3))))
    delta, P = zip(*found, strict=True)
    return {"delta": np.array(delta), "P": np.array(P)}


DRIVES = {
    "13-best-motion": Drive(("best_motion",)),
    "13-icp": Drive(("icp",), _matched),
    "13-trimmed": Drive(("trimmed_icp",), _matched),
    "13-line-step": Drive(("line_step",), _stepped),
    "13-overlap": Drive(("match",)),
}
