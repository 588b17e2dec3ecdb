"""How exercise 13, scan matching, is driven: fits, matches after one and all rounds, walks."""

import numpy as np

from slamlab.checks.drives import Drive, StudentError, numbers, rows

ROUNDS = 14


def _motions(value, function, shape):
    """What a function returned, as homogeneous matrices; ``shape`` tells the student which."""
    T = numbers(value, function)
    if T.shape[-2:] != (3, 3) or T.ndim != shape.count(",") + 1:
        raise StudentError("malformed", f"{function} returned shape {T.shape}, expected {shape}")
    return T


def _matched(functions, inputs):
    """Each match after one round and after all of them."""
    name, match = next(iter(functions.items()))
    share = inputs.get("share")
    one, end = [], []
    for i, (source, target, guess) in enumerate(
        rows({key: inputs[key] for key in ("source", "target", "guess")})
    ):
        rest = () if share is None else (float(share[i]),)
        for rounds, into in ((1, one), (ROUNDS, end)):
            clouds = source.copy(), target.copy(), guess.copy()
            into.append(_motions(match(*clouds, rounds, *rest), name, "(3, 3)"))
    return {"one": np.array(one), "end": np.array(end)}


def _walked(functions, inputs):
    """The poses of every course, each a list of scans with a step between two."""
    walk = functions["walk"]
    poses = [
        _motions(walk(list(scans), list(steps), ROUNDS), "walk", "(n, 3, 3)")
        for scans, steps in rows(inputs)
    ]
    return {"poses": np.array(poses)}


DRIVES = {
    "13-best-motion": Drive(("best_motion",)),
    "13-mirror": Drive(("best_motion",)),
    "13-icp": Drive(("icp",), _matched),
    "13-trimmed": Drive(("trimmed_icp",), _matched),
    "13-walk": Drive(("walk",), _walked),
}
