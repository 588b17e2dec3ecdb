"""Mends of Smolec's listing: what is printed, what runs instead, and what harm the print does.

``FootSlam`` runs what is printed, a :data:`MENDS` name switches one mend on. Of the listing there
are figures only, so "printed" is his text and his formulas. Some things cannot run as printed, or
are not printed at all, and are the same with every switch:

- (15) X = K · innovation would throw the state away at each update, and P's update is not printed:
  X + K · innovation and P − K S Kᵀ. That bearings are wrapped is not said either.
- (4) has no step length; its §4.1 adds the odometry's Δx, Δy, Δθ, and so do we. Where (6) and (8)
  have Δt, (7) has Δθ, which is meant. (18) does not multiply; its blocks follow (17).
- (1) tan⁻¹ of a quotient is read as atan2: landmarks behind the robot would be seen before it.
- A foot on which the robot stands is left out: (2) divides by its distance.
- Lives, LANDMARKOFFSET, RANSAC_SAMPLE, c of Q and P at the start stand in figures, so ours are
  arguments of ``FootSlam``. R's 1 % and 1° are the text's examples, its r in the state's mm.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Mend:
    """One place of the listing that is mended: what is printed, what runs instead, the harm."""

    printed: str
    mended: str
    harm: str


MENDS = {
    "predict-first": Mend(
        "predict() is called after the association: feet are computed through the pose before the "
        "drive, and so are their range and bearing",
        "predict, then compute feet",
        "the foot says that the robot has not moved along the wall: it is held back, each scan",
    ),
    "nearest": Mend(
        "§4.4: the first landmark under LANDMARKOFFSET",
        "the nearest one under it",
        "a wrong wall, where two feet are near",
    ),
    "orthogonal-fit": Mend(
        "least squares for y = a x + b, in the world's frame",
        "total least squares",
        "a wall along the world's y axis has no a: hardly ever found, and turned when it is",
    ),
    "distinct-lines": Mend(
        "RANSAC_SAMPLE random readings, a line round each, whoever else has the readings",
        "readings of a found line are used up; the search ends when it fails 40 times in a row",
        "heaps of landmarks for one wall, some walls missed by chance",
    ),
    "radians": Mend(
        "θ in degrees (§2.6), in Jacobians that are those for radians",
        "radians throughout",
        "lever arms 57 times too long, and a bearing that hangs 57 times too little on the place",
    ),
    "H": Mend(
        "(2): ∂β/∂y = (λx − x)/r²",
        "(x − λx)/r²",
        "corrections across the line of sight go the wrong way along y",
    ),
    "J": Mend(
        "(10), (11): J_xr and J_z without the range, J_xr without the bearing",
        "[1 0 −r sin(θ+β); 0 1 r cos(θ+β)] and [cos(θ+β) −r sin(θ+β); sin(θ+β) r cos(θ+β)]",
        "a far landmark enters as sure as a near one",
    ),
    "Q": Mend(
        "(8): Q = c [Δx Δy Δθ]ᵀ [Δx Δy Δθ], of rank one",
        "Q = W C Wᵀ of the robot's own odometry, slip included",
        "P grows in one direction a step only: the turn is never in doubt on a straight drive",
    ),
    "R": Mend(
        "(9): diag(r c, 1°²) with c = 0.01: linear in r, where r is in mm",
        "diag(σ_r², σ_β²), as the sensor errs",
        "too sure far away, by how much hangs on the unit of length",
    ),
    "joint-update": Mend(
        "one landmark at a time, each linearised where the last one left the state",
        "all landmarks of a scan at once",
        "none of its own: it makes the harm of a wrong H depend on the order of the landmarks",
    ),
    "exact-start": Mend(
        "P starts with some doubt on its diagonal, against singular matrices",
        "P = 0: where the robot starts is the origin, by definition",
        "none that is seen: P says that the frame it defines is itself in doubt",
    ),
}
"""Every mend by its name; ``FootSlam(…, mends=MENDS)`` is the listing with all of them."""


def checked(mends):
    """Check names of mends.

    Parameters
    ----------
    mends : collection of str

    Returns
    -------
    frozenset of str

    Raises
    ------
    ValueError : one is none of MENDS; the text lists those there are
    """
    names = [mends] if isinstance(mends, str) else list(mends)
    unknown = [name for name in names if name not in MENDS]
    if unknown:
        raise ValueError(f"no mend {unknown[0]!r}; there are: {', '.join(MENDS)}")
    return frozenset(names)
