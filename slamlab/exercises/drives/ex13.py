"""How exercise 13, scan matching, is driven: fits, matches after one and all rounds, walks."""

import numpy as np

from slamlab.exercises.drives import Drive, StudentError, numbers, rows

ROUNDS = 14


def _motions(value, function, shape):
    """What a function returned, as homogeneous matrices; ``shape`` tells the student which."""
    T = numbers(value, function)
    if T.shape[-2:] != (3, 3) or T.ndim != shape.count(",") + 1:
        raise StudentError("malformed", f"{function} returned shape {T.shape}, expected {shape}")
    return T


def _matched(functions, inputs):
    """Each match after one round and after all of them."""
    return _after(functions, inputs, {"one": 1, "end": ROUNDS})


def _trimmed(functions, inputs):
    """The same, and of scans whose guess is far off what the first two rounds make."""
    far = {key.removeprefix("far_"): a for key, a in inputs.items() if key.startswith("far_")}
    found = _after(functions, far, {"far_one": 1, "far_two": 2})
    return _matched(functions, inputs) | found


def _after(functions, inputs, stops):
    """Each match after as many rounds as each stop says."""
    name, match = next(iter(functions.items()))
    share = inputs.get("share")
    found = {stop: [] for stop in stops}
    for i, (source, target, guess) in enumerate(
        rows({key: inputs[key] for key in ("source", "target", "guess")})
    ):
        rest = () if share is None else (float(share[i]),)
        for stop, rounds in stops.items():
            clouds = source.copy(), target.copy(), guess.copy()
            found[stop].append(_motions(match(*clouds, rounds, *rest), name, "(3, 3)"))
    return {stop: np.array(motions) for stop, motions in found.items()}


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
    "13-trimmed": Drive(("trimmed_icp",), _trimmed),
    "13-walk": Drive(("walk",), _walked),
}
