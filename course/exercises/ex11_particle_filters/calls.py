"""Function calls of exercise 11, particle filters: seeds become generators."""

import numpy as np

from classroom.exercises.function_calls import (
    FunctionCall,
    StudentError,
    argument_rows,
    to_shaped_array,
)

AGAIN = 20  # seeds drawn twice: a single draw may be the same by chance


def call_draw(functions, inputs):
    """Call "draw" for each seed; return {"copies": (k, s, n), "again": (k, AGAIN, n)}; "again"
    repeats the first seeds. Raise StudentError unless "draw" returns n indices.
    """
    draw, copies, again = functions["draw"], [], []
    for weights, seeds in argument_rows(inputs):
        calls = [
            _count_copies(draw(weights, np.random.default_rng(int(seed))), len(weights))
            for seed in (*seeds, *seeds[:AGAIN])
        ]
        copies.append(calls[: len(seeds)])
        again.append(calls[len(seeds) :])
    return {"copies": np.array(copies), "again": np.array(again)}


def _count_copies(value, n):
    found = to_shaped_array(value, "draw's array", (n,))
    if not (np.isfinite(found).all() and (found == np.floor(found)).all()):
        raise StudentError("malformed", "draw must return integer indices")
    if found.min() < 0 or found.max() >= n:
        wrong = found.min() if found.min() < 0 else found.max()
        raise StudentError(
            "malformed", f"draw returned the index {wrong:.0f}, expected 0 to {n - 1}"
        )
    return np.bincount(found.astype(int), minlength=n)


def call_localise(functions, inputs):
    """Call "localise" step by step; return {"rows": (k, t, n, 3), "weights": (k, t, n)}.
    Raise StudentError for any other shape.
    """
    found = []
    for rows, weights, us, C, p, zs, R, seed in argument_rows(inputs):
        steps = _run_steps(functions, (rows, weights), us, C, [p] * len(us), zs, R, seed)
        found.append(zip(*steps, strict=True))
    rows, weights = zip(*found, strict=True)
    return {"rows": np.array(rows), "weights": np.array(weights)}


def call_fast_slam(functions, inputs):
    """Call "fast_slam" once for each row; return {"rows": (k, n, 3), "weights": (k, n), "p":
    (k, n, 2), "P": (k, n, 2, 2)}. Raise StudentError for any other shape.
    """
    step, names = functions["fast_slam"], ("rows", "weights", "p", "P")
    found = []
    for *given, seed in argument_rows(inputs):
        shapes = [array.shape for array in given[:4]]
        value = step(*given, np.random.default_rng(int(seed)))
        found.append(_check_particles(value, "fast_slam", shapes, names))
    return dict(zip(names, map(np.array, zip(*found, strict=True)), strict=True))


def call_find_again(functions, inputs):
    """Call "find_again" for all runs in turn, so that data which it stores outside its particles is
    from another run. Return {"places": (k, t, n, 2), "weights": (k, t, n)}. Raise StudentError.
    """
    runs = [
        _run_steps(functions, (rows, np.full(len(rows), 1 / len(rows))), *rest)
        for rows, *rest, _ in argument_rows(inputs)
    ]
    in_turn = list(zip(*runs, strict=True))
    places = np.array([[rows[:, :2] for rows, _ in estimates] for estimates in in_turn])
    weights = np.array([[weights for _, weights in estimates] for estimates in in_turn])
    return {"places": places.swapaxes(0, 1), "weights": weights.swapaxes(0, 1)}


def _run_steps(functions, particles, us, C, ps, zs, R, seed):
    name, step = next(iter(functions.items()))
    rng, shapes = np.random.default_rng(int(seed)), [part.shape for part in particles]
    for u, p, z in zip(us, ps, zs, strict=True):
        particles = _check_particles(step(*particles, u, C, p, z, R, rng), name, shapes)
        yield particles


def _check_particles(value, name, shapes, names=("rows", "weights")):
    if not isinstance(value, tuple | list) or len(value) != len(names):
        raise StudentError("malformed", f"{name} must end with: return {', '.join(names)}")
    parts = [
        to_shaped_array(part, f"{name}'s {which}", shape)
        for part, which, shape in zip(value, names, shapes, strict=True)
    ]
    if not all(np.isfinite(part).all() for part in parts):
        raise StudentError("malformed", f"{name} returned NaN or infinity")
    if (parts[1] < 0).any() or not parts[1].any():
        raise StudentError("malformed", f"{name}'s weights: one weight is negative, or all are 0")
    return parts


CALLS = {
    "11-draw": FunctionCall(("draw",), call_draw),
    "11-localise": FunctionCall(("localise",), call_localise),
    "11-proposal": FunctionCall(("reweigh",)),
    "11-fastslam": FunctionCall(("fast_slam",), call_fast_slam),
    "11-kidnapped": FunctionCall(("find_again",), call_find_again),
}
