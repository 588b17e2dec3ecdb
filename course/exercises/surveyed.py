"""Inputs far from the origin, on which derivatives are judged: finite differences fail there.

Coordinates of 10⁷ m are rounded to 2e-9 m. Differences over any step are then wrong by more than
:data:`EXACT`, a derived formula is not."""

from dataclasses import replace

import numpy as np

from classroom.exercises.correctness_laws import Diagnosis, equals

EXACT = 1e-8
"""Tolerance of a derivative, relative to the largest entry."""
ROUNDED = 3e-14
"""Tolerance of :func:`rounded`, relative to the largest coordinate or entry: 130 roundings."""
ORIGIN = np.array([7.1e5, 9.3e6])
"""A surveyor's easting and northing [m]."""
FAR = 1e6
"""Distance of walls from the origin [m]: their lines turn about it."""
FARTHEST = 1e9
"""Distance [m] along a normal α = 0: x sin α is exactly 0, but differences of any order fail."""
NAME = "surveyors' coordinates"


def surveyed(inputs, *names):
    """Move the positions of poses or points, in place, and return the inputs."""
    for name in names:
        inputs[name][..., :2] += ORIGIN
    return inputs


def vague(inputs, variances, sigmas=()):
    """Enlarge variances to square metres, so that no small number hides an error."""
    larger = {name: 1e4 * inputs[name] for name in variances}
    return inputs | larger | {name: 100 * inputs[name] for name in sigmas}


def corrections(name, points, says, want, **more):
    """Create the law that x is changed as expected: at large coordinates, x itself hides errors."""

    def change(inputs, x):
        return {"x": x - inputs["x"]}

    law = equals(name, points, says, lambda i: change(i, want(i)["x"]), tolerance=1e-7, **more)
    return replace(
        law,
        holds=lambda i, o: law.holds(i, o | change(i, o["x"])),
        want=lambda i: {"x": want(i)["x"]},
    )


def rounded(law, want):
    """Require of a derivative, besides a law, that it has no larger errors than those of rounding.

    Coordinates near the origin leave no room for the errors of a difference quotient."""

    def holds(inputs, outputs):
        largest = [_largest(array) for array in inputs.values()]
        right = want(inputs)
        exact = [
            _largest(outputs[name] - right[name])
            <= ROUNDED * np.maximum.reduce([*largest, _largest(right[name])])
            for name in law.want(inputs)
        ]
        return law.holds(inputs, outputs) & np.logical_and.reduce(exact)

    return replace(law, holds=holds)


def _largest(array):
    """Return the largest magnitude of each row."""
    return np.abs(array.reshape(len(array), -1)).max(axis=1, initial=0.0)


def differences(want, on=NAME, exact=lambda inputs: {}, law=None):
    """Create the diagnosis of outputs that are right but for rounding, on the probe ``on``;
    the outputs ``exact`` are no derivatives, so they are right. Where ``law`` holds, the
    derivatives are exact."""

    def nearly_right(inputs, outputs):
        return not (law and law.holds(inputs, outputs).all()) and all(
            (np.abs(outputs[name] - right) <= share * np.abs(right).max()).all()
            for share, of in ((0.02, want), (1e-6, exact))
            for name, right in of(inputs).items()
        )

    return Diagnosis(
        "differences",
        "Your result is nearly right, but not exact. Either you use finite differences: derive "
        "formulas, and subtract positions from each other before you multiply them. Or a small "
        "term is missing.",
        nearly_right,
        on,
        asks="Which terms does the formula have? If you use differences: how many digits remain in "
        "a difference of two numbers that are nearly equal?",
    )
