"""Corrections of Smolec's printed system, which ``FootPointSlam`` applies by name.

"Printed" refers to text and formulas; the program is shown only in figures. Always corrected:

- (15) states X = K · v: here X + K · v and P − K S Kᵀ, with wrapped bearings in v.
- (4) has no step length; as in §4.1, the odometry's Δx, Δy, Δθ are added. Δt in (6) and (8) is Δθ,
  as in (7). The dimensions of (18) do not match; its blocks follow (17).
- (1) uses tan⁻¹ of a quotient: here atan2. (2) leaves out a foot point at the robot's position.
- Lives, LANDMARKOFFSET, RANSAC_SAMPLE, c of Q and the first P are in figures; they are arguments of
  ``FootPointSlam``. The 1 % and 1° of R are examples in the text, with r in mm.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Correction:
    """A correction: printed version, corrected version, and the effect of the printed version."""

    printed: str
    corrected: str
    effect: str


CORRECTIONS = {
    "predict-first": Correction(
        "predict() is called after the data association: foot points, ranges and bearings are "
        "computed from the pose before the motion",
        "predict, then compute foot points",
        "the foot points contradict the motion along the wall, so each update pulls the robot back",
    ),
    "nearest": Correction(
        "§4.4: the first landmark closer than LANDMARKOFFSET",
        "the nearest landmark closer than it",
        "a wrong association if two foot points are close",
    ),
    "orthogonal-fit": Correction(
        "least squares for y = a x + b, in the world frame",
        "total least squares",
        "a wall along the world's y axis has no finite a: it is rarely found, with a wrong angle",
    ),
    "distinct-lines": Correction(
        "a line is fitted at each of RANSAC_SAMPLE random points, and lines may share points",
        "the points of a line are removed; the search ends after 40 failures in a row",
        "many landmarks for one wall, some walls missed by chance",
    ),
    "radians": Correction(
        "θ in degrees (§2.6), in Jacobians for radians",
        "radians throughout",
        "lever arms 57 times too long, and bearings 57 times too insensitive to the position",
    ),
    "H": Correction(
        "(2): ∂β/∂y = (λx − x)/r²",
        "(x − λx)/r²",
        "corrections across the bearing have the wrong sign along y",
    ),
    "J": Correction(
        "(10), (11): J_xr and J_z without the range, J_xr without the bearing",
        "[1 0 −r sin(θ+β); 0 1 r cos(θ+β)] and [cos(θ+β) −r sin(θ+β); sin(θ+β) r cos(θ+β)]",
        "a distant landmark has the same initial covariance as a near one",
    ),
    "Q": Correction(
        "(8): Q = c [Δx Δy Δθ]ᵀ [Δx Δy Δθ], of rank one",
        "Q = W C Wᵀ of the robot's odometry with slip",
        "P grows in only one direction per step: straight motion adds no heading uncertainty",
    ),
    "R": Correction(
        "(9): diag(r c, 1°²) with c = 0.01: linear in r, with r in mm",
        "diag(σ_r², σ_β²) of the sensor",
        "overconfident at large ranges, by an amount that depends on the unit of length",
    ),
    "joint-update": Correction(
        "one landmark at a time, each linearised at the state after the previous one",
        "all landmarks of a scan at once",
        "no direct effect: the effect of a wrong H depends on the order of the landmarks",
    ),
    "exact-start": Correction(
        "the initial P has a positive diagonal, to avoid singular matrices",
        "P = 0: the initial pose is the origin, by definition",
        "none visible: P includes an uncertainty of the frame that the initial pose defines",
    ),
}
"""All corrections by name; ``FootPointSlam(…, corrections=CORRECTIONS)`` applies all of them."""


def checked(corrections):
    """Return names as a frozenset. Raises ValueError if a name is not among CORRECTIONS."""
    names = [corrections] if isinstance(corrections, str) else list(corrections)
    unknown = [name for name in names if name not in CORRECTIONS]
    if unknown:
        raise ValueError(f"unknown correction {unknown[0]!r}; choose from {', '.join(CORRECTIONS)}")
    return frozenset(names)
