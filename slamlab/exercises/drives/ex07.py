"""How exercise 07, correlations, is driven: one call per input, the corridor run step by step."""

import numpy as np

from slamlab.exercises.drives import Drive, StudentError, numbers, rows

UNDEFINED = 9.0
"""Stands for NaN and infinity among correlations, so that all others can still be judged."""


def _correlations(functions, inputs):
    """Every correlation matrix, and where it holds NaN or infinity."""
    found = [numbers(functions["correlation"](P), "correlation") for (P,) in rows(inputs)]
    wrong = next((a.shape for a in found if a.shape != inputs["P"].shape[1:]), None)
    if wrong is not None:
        raise StudentError("malformed", f"correlation returned shape {wrong}, expected that of P")
    result = np.array(found)
    undefined = ~np.isfinite(result)
    return {"result": np.where(undefined, UNDEFINED, result), "undefined": undefined.astype(float)}


def _updates(functions, inputs):
    """Both covariances of every pair of observations."""
    calls = [functions["two_updates"](*row) for row in rows(inputs)]
    return _kept_apart(calls, "two_updates", {"P_first": (7, 7), "P_both": (7, 7)})


def _relatives(functions, inputs):
    """Every relative vector with its covariance; landmarks are counted by whole numbers."""
    calls = [
        functions["relative"](x, P, int(i), int(j))
        for x, P, i, j in rows({name: inputs[name] for name in ("x", "P", "i", "j")})
    ]
    return _kept_apart(calls, "relative", {"delta": (2,), "P_delta": (2, 2)})


def _fused(functions, inputs):
    """Every pair of estimates fused; all pairs of a case have the same covariances."""
    cases, pairs = inputs["a"].shape[:2]
    each = {name: np.repeat(inputs[name], pairs, axis=0) for name in ("P_a", "P_b", "P_ab")}
    each |= {name: inputs[name].reshape(-1, 2) for name in ("a", "b")}
    names = "a", "P_a", "b", "P_b", "P_ab"
    calls = [functions["fuse"](*row) for row in rows({name: each[name] for name in names})]
    found = _kept_apart(calls, "fuse", {"x": (2,), "P": (2, 2)})
    return {name: a.reshape(cases, pairs, *a.shape[1:]) for name, a in found.items()}


def _walked(functions, inputs):
    """The end of every walk along the corridor: each step starts from what the last returned."""
    step, ends = functions["step"], []
    names = "d", "q", "i", "z", "r"
    size = inputs["x"].shape[1]
    shapes = {"x": (size,), "P": (size, size)}
    for run in range(len(inputs["x"])):
        x, P = inputs["x"][run].copy(), inputs["P"][run].copy()
        for d, q, i, z, r in zip(*(inputs[name][run].tolist() for name in names), strict=True):
            x, P = _parts(step(x.copy(), P.copy(), d, q, int(i), z, r), "step", shapes)
        ends.append((x, P))
    x, P = zip(*ends, strict=True)
    return {"x": np.array(x), "P": np.array(P)}


def _linearised(functions, inputs):
    """A and H of every run."""
    steps = inputs["predicted"].shape[1]
    calls = [functions["first_estimates"](*row) for row in rows(inputs)]
    return _kept_apart(calls, "first_estimates", {"A": (steps - 1, 3, 3), "H": (steps, 2, 5)})


def _kept_apart(calls, function, shapes):
    """What calls returned, stacked by name."""
    found = [_parts(call, function, shapes) for call in calls]
    return {name: np.array([parts[k] for parts in found]) for k, name in enumerate(shapes)}


def _parts(returned, function, shapes):
    """The arrays that one call returned, of the shapes asked for."""
    names = ", ".join(shapes)
    if not isinstance(returned, tuple | list) or len(returned) != len(shapes):
        raise StudentError("malformed", f"{function} must end with: return {names}")
    parts = []
    for value, (name, shape) in zip(returned, shapes.items(), strict=True):
        part = numbers(value, f"{function}'s {name}")
        if part.shape != shape:
            turned = " (transposed?)" if part.shape == shape[::-1] != shape else ""
            raise StudentError(
                "malformed",
                f"{function}'s {name} has shape {part.shape}, expected {shape}{turned}",
            )
        parts.append(part)
    return parts


DRIVES = {
    "07-correlation": Drive(("correlation",), _correlations),
    "07-two-updates": Drive(("two_updates",), _updates),
    "07-relative": Drive(("relative",), _relatives),
    "07-fuse": Drive(("fuse",), _fused),
    "07-corridor": Drive(("step",), _walked),
    "07-first-estimates": Drive(("first_estimates",), _linearised),
}
