"""Function calls of exercise 02: infinity and NaN are valid results, encoded as flags."""

import numpy as np

from classroom.exercises.function_calls import (
    FunctionCall,
    StudentError,
    argument_rows,
    to_array,
    to_shaped_array,
)

FAR = 1e6  # clips the distance to a line that is nearly parallel to the beam [m]
NOTHING, FINITE, INFINITE = 0, 1, 2  # NaN, a number, infinity
NAMES = ("error", "blocked")


def distance_call(function):
    """Make the call of the named function; it returns {"met": (n,) 1 if finite, "distance": (n,) or
    0}. It raises StudentError "malformed" for NaN or if a result is not one number."""

    def run(functions, inputs):
        results = [to_array(functions[function](*row), function) for row in argument_rows(inputs)]
        wrong = next((r.shape for r in results if r.size != 1), None)
        if wrong is not None:
            raise StudentError("malformed", f"{function} returned shape {wrong}, not one number")
        distance = np.array([r.item() for r in results])
        if np.isnan(distance).any():
            raise StudentError(
                "malformed", f"{function} returned NaN: return inf for a beam that hits nothing"
            )
        met = distance != np.inf  # −inf would be nearer than any wall
        distance = np.where(met, np.clip(distance, -FAR, FAR), 0.0)
        return {"met": met.astype(float), "distance": distance}

    return run


def call_noisy(functions, inputs):
    """Call noisy twice with one seed, then with another; return {"state": (n, 3, k) of NOTHING,
    FINITE, INFINITE, "ranges": (n, 3, k), 0 where not finite}. Raise StudentError "malformed" if a
    call does not return one number per range."""
    call, beams, calls = functions["noisy"], inputs["ranges"].shape[1], []
    for other in (0, 0, 1):
        found = [
            call(ranges, error, dropouts, np.random.default_rng([int(seed), other]))
            for ranges, error, dropouts, seed in argument_rows(inputs)
        ]
        calls.append(_with_flags([_one_per_beam(result, "noisy", beams) for result in found]))
    return {name: np.stack([c[name] for c in calls], axis=1) for name in ("state", "ranges")}


def call_log_likelihood(functions, inputs):
    """Call log_likelihood for each scan; return {"log": (n,), 0 where not finite, "finite": (n,),
    1, or 0 for NaN, −1 for −∞, −2 for ∞}. Raise StudentError "malformed" if a result is not one
    number."""
    call = functions["log_likelihood"]
    results = [to_shaped_array(call(*row), "log_likelihood", ()) for row in argument_rows(inputs)]
    logs = np.array(results)
    finite = np.select([np.isfinite(logs), logs == -np.inf, logs == np.inf], [1.0, -1.0, -2.0])
    return {"log": np.where(finite > 0, logs, 0.0), "finite": finite}


def call_busy_fit(functions, inputs):
    """Call busy_fit with the scans (k, beams) [m] and step [m] of each sensor; return {"result":
    (n, 2)}. Raise StudentError "malformed" if a call does not return two numbers."""
    return {
        "result": np.array(
            [_two_numbers(functions["busy_fit"](*row)) for row in argument_rows(inputs)]
        )
    }


def _two_numbers(result):
    if not isinstance(result, tuple | list | np.ndarray) or len(result) != 2:
        raise StudentError("malformed", "busy_fit must end with: return error, blocked")
    return [
        to_shaped_array(part, f"busy_fit's {n}", ()) for part, n in zip(result, NAMES, strict=True)
    ]


def _one_per_beam(result, function, length):
    row = to_array(result, function)
    if row.shape != (length,):
        raise StudentError(
            "malformed",
            f"{function} returned shape {row.shape}, expected ({length},): one number per beam",
        )
    return row


def _with_flags(results):
    ranges = np.array(results)
    state = np.where(np.isnan(ranges), NOTHING, np.where(np.isinf(ranges), INFINITE, FINITE))
    return {"state": state.astype(float), "ranges": np.where(state == FINITE, ranges, 0.0)}


CALLS = {
    "02-ray-wall": FunctionCall(("ray_wall",), run=distance_call("ray_wall")),
    "02-echo": FunctionCall(("echo",), run=distance_call("echo")),
    "02-noise": FunctionCall(("noisy",), run=call_noisy),
    "02-beam": FunctionCall(("log_likelihood",), run=call_log_likelihood),
    "02-busy-room": FunctionCall(("busy_fit",), run=call_busy_fit),
}
