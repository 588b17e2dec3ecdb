# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# # 07 · Correlations
#
# **You will be able to** say where the correlations of a map come from, block by block, what breaks
# when they are dropped, what they cost, and which ways round that cost give nothing away.
#
# **100 minutes** (50 for where they come from, 50 for what they are good for). **Before:** lesson
# 06, which builds the filter; what NEES is (lesson 03); the errata's method (lesson 04).
#
# Sources: MAK thesis, sections 4.3.3 to 4.4 and chapter 5.
#
# *Key:* a landmark seen from a robot that is lost is lost with it. The covariance must say so.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The first half (to the errata) is a lecture at the blackboard with a machine
# that checks each line; the second is an afternoon of experiments.
#
# *In 90 minutes:* all but the three sections on the thesis' print ("The printed formulas", "The
# corrections of x", "Three sentences"). *In 45:* the head, the two sightings with their
# derivations, "A whole loop", "Second half: drop them", and the last slide, which is 44.

# %% slideshow={"slide_type": "skip"}
import json
from copy import deepcopy
from importlib.resources import files
from itertools import pairwise
from time import perf_counter

import numpy as np
import sympy as sp
from IPython.display import Markdown

from slamlab import models, views
from slamlab.derivation import blockwise, derive, symmetric
from slamlab.estimators.mak_slam import MakSlam, Q_arc
from slamlab.evaluation import band, correlation, nees
from slamlab.filters import CompressedMAK
from slamlab.filters import JoinedMap
from slamlab.filters import MAK
from slamlab.filters.relative_map import relative_vector
from slamlab.geometry import compose, wrap
from slamlab.layers import Points, Poses
from slamlab.sources.landmark_runs import LandmarkRun, Loop
from slamlab.studies.consistency import errors_of

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Two landmarks, two sightings
#
# A robot r and two landmarks, 1 and 2. Nobody knows anything of anybody: the covariance is block
# diagonal. Now the robot sees landmark 1, then landmark 2.
#
# **Question.** Which of the six blocks P_rr, P_r1, P_r2, P_11, P_12, P_22 are zero after the first
# sighting, and which after the second?
#
# **Predict** it, and write it down.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
Z, of = sp.ZeroMatrix, sp.MatrixSymbol
P_rr, P_11, P_22 = symmetric("P_rr", 3), symmetric("P_11", 2), symmetric("P_22", 2)
P = sp.BlockMatrix([[P_rr, Z(3, 2), Z(3, 2)], [Z(2, 3), P_11, Z(2, 2)], [Z(2, 3), Z(2, 2), P_22]])
P

# %% [markdown] slideshow={"slide_type": "fragment"}
# A sighting of landmark 1 says something about the robot (H_r) and about landmark 1 (H_p), nothing
# about 2:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
H_r, H_p, R, S = of("H_r", 2, 3), of("H_p", 2, 2), of("R", 2, 2), symmetric("S", 2)
H_1 = sp.BlockMatrix([[H_r, H_p, Z(2, 2)]])
H_1

# %% [markdown] slideshow={"slide_type": "slide"} minutes=10
# ## The first sighting, line by line
#
# First, how the errors of the state and the innovation hang together, P Hᵀ. **Predict** its third
# block.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
PHt = sp.block_collapse(P * H_1.T)
PHt

# %% [markdown] slideshow={"slide_type": "fragment"}
# Landmark 2 shares nothing with robot and landmark 1, so nothing with the innovation. The
# innovation's own covariance:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
S_1 = sp.block_collapse(H_1 * P * H_1.T) + R
S_1

# %% [markdown] slideshow={"slide_type": "fragment"}
# We keep calling it S. With the gain W = P Hᵀ S⁻¹ (the thesis' letter for our K) the robot moves,
# landmark 1 moves, landmark 2 stays. What happens to the covariance, for any P and any H?

# %% slideshow={"slide_type": "slide"} tags=["nbval-check-output"]
any_P, any_H, W = symmetric("P", 7), of("H", 2, 7), of("W", 7, 2)
update = (
    derive("P_new", any_P - W * S * W.T, "an update takes away W S Wᵀ")
    .step("put the gain in", given={W: any_P * any_H.T * S.I})
    .step("multiply: S⁻¹ S falls out, and S and P are symmetric", lambda line: line.doit())
)
update

# %% [markdown] slideshow={"slide_type": "fragment"}
# Now in blocks. P Hᵀ is a column, as above:


# %% slideshow={"slide_type": "fragment"}
def sighting(P, H):
    PHt, given = blockwise(P * H.T), {any_P: P, any_H: H}
    return (
        derive("P_new", update.result, "any update, as derived")
        .step("in blocks; P Hᵀ is a column", P - PHt * S.I * PHt.T, given)
        .step("multiply block by block", blockwise)
    )


# %% [markdown] slideshow={"slide_type": "slide"}
# **Predict** which blocks are zero after the first sighting.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
seen = H_1  # what is seen: change this line
sighting(P, seen)

# %% [markdown] slideshow={"slide_type": "fragment"}
# There it is, P_r1: a product of five matrices, none of them zero. One sighting corrected both, so
# both now share its error. And landmark 2? Untouched: two zeros and the old P_22. A **correlation**
# is born where one sighting corrects two estimates.
#
# **Try** `sp.BlockMatrix([[Z(2, 3), -H_p, H_p]])`, a sensor that tells only how landmark 2 lies to
# landmark 1: the robot's row stays as it was, and P_12 is born at once.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Say it with people: two friends correct their watches by each other. From then
# on, if one watch is wrong, the other is wrong the same way. That is P_r1.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## The second sighting
#
# Now P has a block P_r1. Driving in between changes numbers, not the pattern. The robot sees
# landmark 2: H has its H_p in the third place.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
P_r1 = of("P_r1", 3, 2)
P_then = sp.BlockMatrix([[P_rr, P_r1, Z(3, 2)], [P_r1.T, P_11, Z(2, 2)], [Z(2, 3), Z(2, 2), P_22]])
H_2 = sp.BlockMatrix([[H_r, Z(2, 2), H_p]])
sp.block_collapse(P_then * H_2.T)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **Predict** from this column: does landmark 1 move when landmark 2 is seen?
#
# It does: its entry P_r1ᵀ H_rᵀ is not zero. The robot was corrected, and landmark 1 was placed by
# that robot.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
sighting(P_then, H_2)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Look at P_12, the second row's last block: two landmarks that were **never seen together** are
# correlated, by way of the robot. And nothing is zero any more:

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Compare with what the class wrote down. The usual mistake is P_12 = 0 at the
# end: "they have nothing to do with each other". Ask then what happens to 1 when we learn that the
# robot stood 10 cm further left.


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
def by_name(blocks):
    names = "r12"
    return {a + b: blocks[i, j] for i, a in enumerate(names) for j, b in enumerate(names) if j >= i}


first, second = (by_name(sighting(*pair).result.blocks) for pair in ((P, H_1), (P_then, H_2)))
for when, blocks in (("first", first), ("second", second)):
    zero = [f"P_{block}" for block, value in blocks.items() if value.is_ZeroMatrix]
    print(f"zero after the {when} sighting:", ", ".join(zero) or "none")

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## The same with numbers
#
# A derivation may be mistyped. We let `slamlab`'s filter do the two updates and put its numbers
# into our symbols. Its start is made block diagonal by the switch that this lesson is about:

# %% slideshow={"slide_type": "fragment"}
P_pose = np.array([[0.04, 0.01, -0.004], [0.01, 0.03, 0.006], [-0.004, 0.006, 0.01]])
R_seen = np.array([[0.02, 0.003], [0.003, 0.006]])
mak = MAK([1.2, -0.7, 0.9], P_pose, drop_cross_terms_for_demonstration=True)
mak.add([1, 2], [[2.1, 0.6], [3.3, -1.1]], R_seen)
mak.drop_cross_terms = False  # from here on everything is kept
PARTS = {"r": slice(0, 3), "1": slice(3, 5), "2": slice(5, 7)}
stages, steps = [mak.P], []
for id, z in ((1, [2.25, 0.52]), (2, [3.2, -1.02])):
    steps.append(mak.update([id], [z], R_seen))
    stages.append(mak.P)

# %% slideshow={"slide_type": "fragment"}
SYMBOLS = (P_rr, P_r1, P_11, P_22, H_r, H_p, S)


def numbers(expression, stage):
    """A block's formula with the numbers of the first (0) or second (1) sighting put in."""
    P, step = stages[stage], steps[stage]
    blocks = (P[PARTS[a], PARTS[b]] for a, b in ("rr", "r1", "11", "22"))
    return sp.lambdify(SYMBOLS, expression)(*blocks, step.H[:, :3], step.H[:, 3:], step.S)


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for stage, formulas in enumerate((first, second)):
    rho = correlation(stages[stage + 1])
    for (a, b), formula in formulas.items():
        block = PARTS[a], PARTS[b]
        off = abs(numbers(formula, stage) - stages[stage + 1][block]).max()
        told = f"largest |ρ| {abs(rho[block]).max():.2f}" if a != b else ""
        print(f"update {stage + 1}, P_{a}{b}: formula − filter {off:.9f}   {told}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Twelve blocks, twelve times zero: the derivation and the filter agree.

# %% slideshow={"slide_type": "slide"}
fig, axes = views.panels(["at first", "1 was seen", "2 was seen"], size=(9, 3.6))
for ax, stage in zip(axes, stages, strict=True):
    views.correlation(correlation(stage), ["r", "1", "2"], ax=ax)
    ax.set(xlabel="", ylabel="")
views.show(
    fig, "Three correlation matrices: block diagonal, then two blocks joined, then all filled."
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** white is zero. First nobody knows anybody; then r and 1 do; then the corner P_12 has
# filled too, more faintly, since it came second-hand.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## A whole loop
#
# Now 16 landmarks round a loop. The robot starts sure of its place (there it puts the map's
# origin), drives round once, and sees each landmark only from near by.

# %% slideshow={"slide_type": "fragment"}
loop = Loop(landmarks=16, steps=96, v_sigma=0.04, omega_sigma=0.03, range_max=2.2)
drive = LandmarkRun(loop, np.random.default_rng(7))
slam, P_at, film = MakSlam(drive.robot, drive.sensor), [], []
for k, reading in enumerate(drive):
    slam.step(reading)
    P_at.append(slam.filter.P)
    if k % 2 == 0:
        drawn = [Poses("truth", drive.truth.poses[: k + 1]), *slam.layers()[1:]]
        # landmarks are numbered as they come into sight
        film.append((slam.filter.landmarks(), correlation(P_at[-1]), drawn))

# %% [markdown] slideshow={"slide_type": "slide"}
# **Question.** With which landmarks is number 5 correlated: with those near it, with those seen
# early, with all? And what happens at the end of the loop, when the robot sees number 0 again?
#
# **Predict**, then press ▶ or move the sliders.


# %% slideshow={"slide_type": "fragment"}
def frame(step, landmark):
    places, rho, drawn = film[step]
    names, room = range(len(places)), len(film[-1][0])
    marked = min(landmark, len(places) - 1)
    fig, (map_, _) = views.linked(places, rho, names, marked, drawn, room, (-7, 7, -3, 10.5))
    map_.set_title(f"{2 * step} s, marked: {marked}")
    return fig


views.explore(
    frame,
    lambda step, landmark: (
        "Map with ellipses beside the correlation matrix, which fills as landmarks are seen; "
        f"the frame is about landmark {landmark}, the colours are its correlations."
    ),
    play="step",
    step=(0, len(film) - 1, 37),
    landmark=(0, 15, 5),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** left, the true way is black, the estimate blue; the colour of a landmark is its
# correlation with the one in the square, whose rows and columns are framed on the right. (Of the
# 2×2 block of the two it is the mean of the diagonal: x with x and y with y.) Just
# before the loop closes, 5 and its neighbours are red: they err *together*. Number 0, seen
# from the start that is certain, errs alone: its rows are nearly white. From here press ▶: with one
# look at number 0 the robot jumps to its place, and what it had misplaced moves back with it.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Play it twice, once looking at the map, once at the matrix. Then mark number
# 12 and go to the end: ask why its neighbours are redder than the far ones (they were placed from
# the same lost poses). The checkerboard: the x errors of two landmarks go together, those of x and
# y against each other, as they do when a map is turned about its start.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## What the closing did, in numbers
#
# **Predict:** at 76 s the robot meets landmark 0 again. Landmark 9 is at the far end of the loop,
# out of sight. What becomes of its ellipse?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for second_of_run in (75, 76, 80, 96):
    P_k = P_at[second_of_run]
    robot, landmark_9 = (np.sqrt(np.trace(P_k[j : j + 2, j : j + 2])) for j in (0, 3 + 2 * 9))
    print(
        f"{second_of_run} s: robot ±{100 * robot:2.0f} cm, landmark 9 ±{100 * landmark_9:2.0f} cm"
    )

# %% [markdown] slideshow={"slide_type": "fragment"}
# It shrinks in the same second, unseen. That is the work of the robot's block with landmark 9: the
# second sighting of our example, on a large scale. Without that block no word would reach it.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## The printed formulas, by machine
#
# The thesis writes these two updates out, (4.18) to (4.39). For every block it prints a first line
# with W and a second with the blocks of P:
#
# $$P_{r1}(1|1) = P_{r1}(1|0) - [W_{x_r} S_1^{-1} W_{p_1}] = -[P_{rr} H_r^T S_1^{-1} H_p P_{11}]$$
#
# **Question.** We derived W S Wᵀ. What is [W S⁻¹ W]? **Predict:** for which blocks does it not even
# multiply?

# %% slideshow={"slide_type": "fragment"}
P_1r = P_r1.T
SECOND_LINES = [  # as printed, by block; (4.34) begins with P_r2, which is zero before update 2
    {
        "rr": P_rr - P_rr * H_r.T * S.I * H_r * P_rr,
        "r1": -P_rr * H_r.T * S.I * H_p * P_11,
        "r2": Z(3, 2),
        "11": P_11 - P_11 * H_p.T * S.I * H_p * P_11,
        "12": Z(2, 2),
        "22": P_22,
    },
    {
        "rr": P_rr - P_rr * H_r.T * S.I * H_r * P_rr,
        "r1": Z(3, 2) - P_rr * H_r.T * S.I * H_r * P_r1,
        "r2": -P_rr * H_r.T * S.I * H_p * P_22,
        "11": P_11 - P_1r * H_r.T * S.I * H_r * P_r1,
        "12": -P_1r * H_r.T * S.I * H_p * P_22,
        "22": P_22 - P_22 * H_p.T * S.I * H_p * P_22,
    },
]

# %% slideshow={"slide_type": "fragment"}
NUMBERS = {"rr": 22, "r1": 23, "r2": 24, "11": 25, "12": 26, "22": 27}  # (4.22) …, second + 11


def verdict(printed, derived, correction):
    """How far a printed value is off, as a multiple of the right correction."""
    off = np.linalg.norm(printed - derived)
    return "right" if off < 1e-9 else f"off by {off / np.linalg.norm(correction):.3g} ×"


def first_line(stage, a, b):
    """P − [W_a S⁻¹ W_b], as printed."""
    W, S = steps[stage].K, steps[stage].S
    return stages[stage][PARTS[a], PARTS[b]] - W[PARTS[a]] @ np.linalg.inv(S) @ W[PARTS[b]]


# %% slideshow={"slide_type": "slide"} tags=["nbval-check-output"]
lines = ["| formula | block | first line, W S⁻¹ W | second line |", "|---|---|---|---|"]
for stage in (0, 1):
    for (a, b), number in NUMBERS.items():
        at, name = (PARTS[a], PARTS[b]), f"P_{a}{b}({stage + 1}\\|{stage + 1})"
        derived, correction = stages[stage + 1][at], stages[stage + 1][at] - stages[stage][at]
        try:
            one = verdict(first_line(stage, a, b), derived, correction)
        except ValueError:
            one = "refused: 2×2 times 3×2"
        two = verdict(numbers(SECOND_LINES[stage][a + b], stage), derived, correction)
        lines.append(f"| (4.{number + 11 * stage}) | {name} | {one} | {two} |")
Markdown("\n".join(lines))

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** every first line with something in it is wrong, every second line is right but one. P_rr
# does not multiply, which is harmless: such a program stops. The others run. W S⁻¹ W takes off
# hundreds of times too much: it wants a transpose, and S where S⁻¹ stands.

# %% [markdown] slideshow={"slide_type": "fragment"}
# (4.34) begins its second line with P_r2, which is zero here, where P_r1 belongs: the robot forgets
# landmark 1. (4.37) starts from P_12(1|0) for (2|1): the wrong index, and no harm, both are zero.
#
# The gains (4.18) and (4.29), from which all this follows, are right:

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The second lines show that the author had the right formula in the hand; the
# first lines are a slip that was copied twelve times. Ask how one would notice it without numbers:
# by units. W is in m per unit of z, S in units of z squared, so W S Wᵀ is in m².

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
gains = {
    "(4.18)": (P * H_1.T * S.I, [P_rr * H_r.T, P_11 * H_p.T, Z(2, 2)]),
    "(4.29)": (P_then * H_2.T * S.I, [P_rr * H_r.T, P_1r * H_r.T, P_22 * H_p.T]),
}
for number, (derived, printed) in gains.items():
    as_printed = sp.block_collapse(sp.BlockMatrix([[block] for block in printed]) * S.I)
    print(number, "right" if sp.block_collapse(derived) == as_printed else "wrong")

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## The corrections of x
#
# (4.19), (4.20) and (4.30) to (4.32) print P Hᵀ v where the gain is P Hᵀ S⁻¹. The second update
# also forms S from P(2|2) and x from x(2|2).
#
# **Predict:** is a correction without S⁻¹ too large or too small?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for stage, equations in enumerate(({"r": 19, "1": 20, "2": 21}, {"r": 30, "1": 31, "2": 32})):
    step = steps[stage]
    for part, number in equations.items():
        W, v = step.K[PARTS[part]], step.innovation
        if W.any():
            size = np.linalg.norm(W @ step.S @ v) / np.linalg.norm(W @ v)
            print(f"(4.{number}): moves {size:.3f} times as far as it should")
        else:
            print(f"(4.{number}): right, nothing moves")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Far too small here; with S in other units it would be another number, which is the point. And the
# indices:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
step = steps[1]
H = np.zeros((2, 7))
H[:, step.columns] = step.H
S_derived, S_printed = (H @ stages[k] @ H.T + R_seen for k in (1, 2))
off = np.linalg.norm(S_printed - S_derived) / np.linalg.norm(S_derived)
print(f"S(2|1): derived − filter {abs(S_derived - step.S).max():.9f}")
print(f"S(2|1) from P(2|2), as printed: {off:.0%} off, and P(2|2) is made from S(2|1)")
print(f"x(2|2) = x(2|2) + W v holds where W v = 0; here |W v| = {np.linalg.norm(step.K @ v):.3f}")

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## Three sentences of chapter 4
#
# Before (4.22): were H_r zero, "the update would touch only v(1|0)". An innovation is not updated.
# Which estimate is it?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
no_robot = sp.BlockMatrix([[Z(2, 3), H_p, Z(2, 2)]])
sp.block_collapse(P * no_robot.T * S.I)

# %% [markdown] slideshow={"slide_type": "fragment"}
# p₁(1|0). Next, 4.3.4: "the prediction does not change the covariance matrix".

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
A, Q, P_12 = of("A", 3, 3), of("Q", 3, 3), of("P_12", 2, 2)
F = sp.BlockMatrix([[A, Z(3, 2)], [Z(2, 3), sp.Identity(2)]])
known = sp.BlockMatrix([[P_rr, P_r1], [P_1r, P_11]])
sp.block_collapse(F * known * F.T + sp.BlockMatrix([[Q, Z(3, 2)], [Z(2, 3), Z(2, 2)]]))

# %% [markdown] slideshow={"slide_type": "fragment"}
# True of the map's corner, P_11; false of the robot's row and column. (The thesis says so itself at
# the end of 4.3.5.) Last, 4.3.5: memory and time are "at least o(N²)":

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
N = sp.symbols("N", positive=True)
sp.limit((3 + 2 * N) ** 2 / N**2, N, sp.oo)

# %% [markdown] slideshow={"slide_type": "fragment"}
# o(N²) would be a limit of 0: *less* than N², which contradicts "at least". It is 4: Θ(N²), and a
# lower bound is written Ω(N²).

# %% [markdown] slideshow={"slide_type": "slide"} minutes=9
# ## Second half: drop them
#
# The correlations fill the whole matrix and cost memory and time. Many have dropped them and kept
# the diagonal blocks, N + 1 small covariances.
#
# **Question.** The filter still sees the same landmarks with the same noise. What does it lose?
#
# **Predict** NEES (3 on average where the filter is honest) over one loop.

# %% slideshow={"slide_type": "fragment"}
round_trip = Loop(steps=90)


def drive_round(seed, drop):
    """One loop: the squared errors of the pose in units of P, and what is left at the end."""
    run = LandmarkRun(round_trip, np.random.default_rng(seed))
    slam, P = MakSlam(run.robot, run.sensor), []
    slam.filter.drop_cross_terms = drop
    for reading in run:
        slam.step(reading)
        P.append(slam.filter.block([0, 1, 2]))
    errors = slam.trajectory().poses - run.truth.poses
    errors[:, 2] = wrap(errors[:, 2])
    return nees(errors[10:], np.array(P)[10:]), slam, run


# %% slideshow={"slide_type": "slide"}
runs = {
    "all kept": [drive_round(seed, False) for seed in range(25)],
    "cross terms dropped": [drive_round(seed, True) for seed in range(25)],
}
averages = {name: np.mean([each for each, _, _ in some], axis=0) for name, some in runs.items()}
low, high = band(3, 25)
fig, ax = views.curves(
    np.arange(10, 91), averages, "time [s]", "NEES of the pose", "Average of 25 runs"
)
views.band(ax, low, high, "95 % band")
ax.set_yscale("log")
views.legend(ax)
kept, dropped = (average.max() for average in averages.values())
views.show(fig, f"With all terms NEES stays below {kept:.1f}; without, it rises to {dropped:.0f}.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the solid curve stays in the grey band. The dashed one is out of it from the
# start, and at 300 the robot is off by ten times what it claims. It falls when the loop closes, not
# because the filter became honest: the first landmarks, well known, pull the robot back.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for name, some in runs.items():
    off = [slam.filter.landmarks() - run.landmarks[slam.filter.ids] for _, slam, run in some]
    inside = [
        nees(e, slam.filter.blocks()[2]) < 5.99 for e, (_, slam, _) in zip(off, some, strict=True)
    ]
    print(f"{name}: {np.mean(inside):.0%} of the 95 % ellipses hold their landmark")

# %% [markdown] slideshow={"slide_type": "slide"}
# Where does the certainty come from? Look at a map.

# %% slideshow={"slide_type": "fragment"}
pictures = {}
for name, some in runs.items():
    _, slam, run = some[3]
    layers = slam.layers()
    pictures[name] = [Points("truth", run.landmarks), layers[1], layers[2]]
fig, axes = views.side_by_side(pictures, size=(9, 4.2))
for ax in axes:
    ax.lines[0].set_markersize(5)
views.show(fig, "Ellipses that hold their landmarks, beside tiny ellipses that miss them.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** left, ellipses hold the black points. Right, they are much too small and stand beside
# them. The filter takes each sighting for news: "robot and landmark confirm each other". But the
# landmark was placed *by this robot*: it confirms the robot's own error. A witness was asked twice
# and counted as two.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* This is the lesson's main sentence; let it stand a moment. The correlation is
# the memory of who told whom. Ask where else this happens: rumours, two newspapers with one agency.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## The map's certainty never falls
#
# **Question.** While the robot drives blind it gets less certain. Does a landmark, too?
#
# An update takes W S Wᵀ off. What is taken off is a square, B Bᵀ with B = W S^½, and so it is for
# every choice of rows: for one landmark, for two, for the whole map. A prediction leaves the map's
# rows alone. So each of its blocks can only shrink, and the determinant with it (4.3.4). The same
# holds for a difference of two landmarks, Δp_ij = p_j − p_i (4.3.5).
#
# **Predict** which of the curves below will go up: robot, landmark, relative vector.


# %% slideshow={"slide_type": "fragment"}
def parts(P):
    """The blocks P_ij of the map, (N, N, 2, 2), and the relative vectors' ΔP_ij likewise."""
    n = len(P) // 2 - 1
    blocks = P[3:, 3:].reshape(n, 2, n, 2).transpose(0, 2, 1, 3)
    own = blocks[np.arange(n), np.arange(n)]
    return blocks, own[:, None] + own[None] - blocks - blocks.swapaxes(0, 1)


def area(covariance):
    """Of the 95 % ellipse [m²]."""
    return np.pi * 5.99 * np.sqrt(max(np.linalg.det(covariance), 0))


# %% slideshow={"slide_type": "slide"}
sizes = {"robot": [], "landmark 5": [], "relative vector 5 to 6": []}
for P_k in P_at:
    blocks, relative = parts(P_k)
    seen = len(blocks) > 6
    sizes["robot"].append(area(P_k[:2, :2]))
    sizes["landmark 5"].append(area(blocks[5, 5]) if seen else np.nan)
    sizes["relative vector 5 to 6"].append(area(relative[5, 6]) if seen else np.nan)
fig, ax = views.curves(np.arange(97), sizes, "time [s]", "area of the 95 % ellipse [m²]")
ax.set_yscale("log")
ax.set_ylim(1e-3, 10)
views.show(fig, "The robot's area rises and falls; a landmark's and a relative vector's only fall.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the robot's curve rises for 75 s, falls as the loop closes, and rises again. Landmark 5
# and the vector from 5 to 6 only go down. And the vector is known better than the landmark: what
# the two landmarks share drops out of their difference.

# %% [markdown] slideshow={"slide_type": "slide"}
# A curve is no claim. So: at every step, for every landmark and for every one of up to 120 pairs,
# the determinant after by the determinant before.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
largest = {"robot": [], "landmarks": [], "pairs, P_ij's four blocks": [], "relative vectors": []}
for before, after in pairwise(P_at[9:]):
    n, det = len(before), np.linalg.det
    (old, old_relative), (new, new_relative) = parts(before), parts(after[:n, :n])
    i, j = np.triu_indices(len(old), 1)
    largest["robot"].append(det(after[:3, :3]) / det(before[:3, :3]))
    own = [det(m[np.arange(len(m)), np.arange(len(m))]) for m in (new, old)]
    largest["landmarks"].append(max(own[0] / own[1]))
    pairs = [det(np.block([[m[i, i], m[i, j]], [m[j, i], m[j, j]]])) for m in (new, old)]
    largest["pairs, P_ij's four blocks"].append(max(pairs[0] / pairs[1]))
    largest["relative vectors"].append(max(det(new_relative[i, j]) / det(old_relative[i, j])))
for name, ratios in largest.items():
    print(f"{name}: largest det after / det before = {max(ratios):.6f}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# None above 1 but the robot's. That is a law of the filter, whatever the linearisation does, so it
# holds of an *inconsistent* filter too: certainty that never falls is no proof of being right.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The thesis concludes "the map's certainty does not fall". Ask whether that is
# good news. For the filter's claim, always; the dropped cross terms a minute ago obeyed the law,
# too.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## In the limit
#
# Let a robot drive for ever. It is not sure of its first place: ±20 cm in x and in y.
#
# **Question.** How well can it ever know where a landmark stands? And where one stands from
# another?
#
# **Predict** two numbers. First with a perfect compass (no noise in its turns), as the theory
# assumes, then without.


# %% slideshow={"slide_type": "fragment"}
def for_ever(omega_sigma, rounds=12):
    """σ per axis of a landmark, of its vector to the next and of that one's length, over time."""
    noisy = {"v_sigma": 0.1, "range_sigma": 0.3, "omega_sigma": omega_sigma}
    run = LandmarkRun(Loop(landmarks=8, steps=84 * rounds, **noisy), np.random.default_rng(7))
    slam, history = MakSlam(run.robot, run.sensor), []
    # first estimates: why, the end of this lesson tells
    slam.filter = MAK(np.zeros(3), np.diag([0.2, 0.2, 0]) ** 2, first_estimates=True)
    for reading in run:
        slam.step(reading)
        ids = slam.filter.ids
        if len(ids) > 4:
            own = slam.filter.block(slam.filter.rows(ids[3:4]))
            vector, P_vector = relative_vector(slam.filter, *ids[3:5])
            along = vector / np.hypot(*vector)
            variances = own.trace() / 2, P_vector.trace() / 2, along @ P_vector @ along
            history.append([reading.time / 84, *np.sqrt(variances)])
    return np.array(history).T


# %% slideshow={"slide_type": "slide"}
compass, no_compass = for_ever(0.0), for_ever(0.012)
fig, ax = views.curves(
    compass[0],
    {
        "landmark, compass": compass[1],
        "vector to the next, compass": compass[2],
        "landmark, no compass": no_compass[1],
        "vector to the next, no compass": no_compass[2],
    },
    "rounds",
    "σ of x and y [m]",
)
ax.axhline(0.2, color=views.COLOURS["walls"], linewidth=1)
ax.set_ylim(0, 0.47)
views.legend(ax, ncols=2, loc="upper center")
views.show(
    fig,
    f"With a compass the landmark falls to {compass[1][-1]:.2f} m, without one it stays at "
    f"{no_compass[1][-1]:.2f}; vectors go on falling, the compass's towards zero.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** with a compass the landmark comes down to the grey line, the robot's first uncertainty,
# and stays: no driving can tell where the start was. The vector to the next landmark falls on
# towards zero: the *relative* map becomes exact. Both landmarks then have one and the same error,
# the start's:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for name, (_, own, vector, length) in (("compass", compass), ("no compass", no_compass)):
    rho = 1 - vector[-1] ** 2 / (2 * own[-1] ** 2)  # var(p_j − p_i) = 2 σ² (1 − ρ)
    across = np.sqrt(2 * vector[-1] ** 2 - length[-1] ** 2)  # the trace is the same in any axes
    print(f"{name}, per axis: landmark ±{own[-1]:.3f} m, vector ±{vector[-1]:.3f} m", end="; ")
    print(f"correlation about {rho:.3f}")
    print(f"    the vector along itself ±{length[-1]:.3f} m, across ±{across:.3f} m")

# %% [markdown] slideshow={"slide_type": "fragment"}
# With a compass the correlation goes to 1: *fully correlated*. Without, one more thing stays
# unknown, how the whole map is turned: after the first moment, nothing can tell the heading at the
# start. A turn moves the vector's end across, not along: its direction keeps that error, its length
# goes on getting better.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The thesis' section and the classic proof are about a linear system, in which
# headings are known. Ask what of the map is exact in the end without a compass: distances and
# angles, which is the shape. A map up to a shift and a turn: lesson 04 said that h cannot tell.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## The price
#
# (3 + 2N)² numbers to store, and each sighting changes all of them.
#
# **Predict** the exponents: twice the landmarks, how much more memory, how much more time?


# %% slideshow={"slide_type": "fragment"}
def price(N, sightings=15):
    """Bytes of P and seconds of one step with four landmarks in sight (the best of some)."""
    rng = np.random.default_rng(N)
    mak = MAK([0.3, -0.2, 0.4], np.diag([0.02, 0.03, 0.01]), N)
    z = np.column_stack([rng.uniform(1, 20, N), rng.uniform(-3, 3, N)])
    mak.add(range(N), z, R_seen)
    took = []
    for _ in range(sightings):
        began = perf_counter()
        mak.predict(mak.pose, 1e-6 * np.eye(3))
        mak.update(range(4), models.h(mak.pose, mak.landmarks()[:4]), R_seen)
        took.append(perf_counter() - began)
    return mak.P.nbytes, min(took)


# %% slideshow={"slide_type": "slide"}
N_tried = np.array([50, 100, 200, 400, 800, 1600])
memory, seconds = np.array([price(N) for N in N_tried]).T
slope, _ = np.polyfit(np.log(N_tried[-3:]), np.log(seconds[-3:]), 1)
fig, ax = views.growth(
    N_tried,
    {"time [ms]": 1e3 * seconds, "memory [MB]": memory / 1e6},
    {"grows as N²": 1e3 * seconds[-1] * (N_tried / N_tried[-1]) ** 2},
    "landmarks N",
    "ms, MB",
    f"One step: time grows as N^{slope:.1f} from 400 on",
)
views.show(
    fig, "Memory runs beside the line N²; time joins the line once N is above a few hundred."
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** on these axes a power is a straight line, its slope the exponent. Memory is N² exactly.
# Time is flat at first, where calling functions costs more than arithmetic, then comes up to the
# same slope. (Times are of the machine that ran this, and of as many threads as its BLAS took.)
#
# `slamlab` writes one triangle of P in place: at N = 1000, one scan costs about 0.7 of what
# *copying* P costs. Better than N² there is nothing, as long as every number of P changes.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## A way out: settle later
#
# **Question.** The robot works in one corner. Must the far landmarks hear of every sighting *now*?
#
# Guivant and Nebot (chapter 5 names them): keep three small sums, and bring the far ones up to date
# when the robot leaves. **Predict** how much accuracy that costs.

# %% slideshow={"slide_type": "fragment"}
wide = LandmarkRun(Loop(landmarks=40, steps=168), np.random.default_rng(7))
readings, slam = list(wide), MakSlam(wide.robot, wide.sensor)
for reading in readings[:85]:  # the first round makes the map
    slam.step(reading)
full, compressed = slam.filter, CompressedMAK(deepcopy(slam.filter))
R_loop = np.diag([wide.loop.range_sigma, wide.loop.bearing_sigma]) ** 2


def move_and_see(filter, pose, reading):
    """The same two lines for both filters."""
    Q = Q_arc(pose, reading.odometry, wide.robot)
    filter.predict(compose(pose, reading.odometry), Q)
    filter.update(reading.observations.ids.tolist(), reading.observations.z, R_loop)


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for start in range(85, 169, 21):  # the second round, a quarter at a time
    quarter = readings[start : start + 21]
    around = sorted({i for reading in quarter for i in reading.observations.ids.tolist()})
    compressed.focus(around)
    for reading in quarter:
        move_and_see(full, full.pose, reading)
        move_and_see(compressed, compressed.local.pose, reading)
    print(f"{len(quarter)} steps with {len(around)} of {len(full.ids)} landmarks")
compressed.settle()
off = max(abs(full.x - compressed.whole.x).max(), abs(full.P - compressed.whole.P).max())
print(f"largest difference of any number in x and P: {off:.9f}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# None. 84 steps with 16 or 17 landmarks and 4 settlements, in place of 84 steps with 40: the
# *compressed* EKF drops nothing, it only waits. The price is N² per region, not per step.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## A way out: small maps, joined
#
# Chapter 5 names MAK on groups, joined by another MAK. Each group starts anew at (0, 0, 0), sure of
# itself; its errors have nothing to do with those of the groups before. So joining two of them
# starts as our example did: with a block diagonal P.
#
# **Predict:** what joins two groups, and does the result equal the one large filter?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
trip = LandmarkRun(round_trip, np.random.default_rng(7))
readings, one, joined = list(trip), MakSlam(trip.robot, trip.sensor), JoinedMap()
for start in range(0, len(readings), 23):
    local = MakSlam(trip.robot, trip.sensor)
    for reading in readings[start : start + 23]:
        one.step(reading)
        local.step(reading)
    joined.join(local.filter)
    print(f"{len(local.filter.ids)} landmarks in this group, {len(joined.ids)} in the whole")
same = one.filter.landmarks() - joined.landmarks()[[joined.ids.index(i) for i in one.filter.ids]]
P_ii = one.filter.blocks()[2]
print(f"apart by {100 * np.sqrt(np.mean(np.sum(same**2, axis=1))):.1f} cm (RMS), where the filter")
print(f"itself claims ±{100 * np.sqrt(np.mean(np.trace(P_ii, axis1=1, axis2=2))):.1f} cm")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Two things join them: the pose where one group ends and the next begins, and the landmarks both
# have seen, which must stand at one place. The result is not the same to the last digit, since the
# Jacobians are taken elsewhere; the difference is a tenth of what the filter claims to know. A scan
# costs the square of a *group*; joining costs N² once a group.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## A way out: a relative map
#
# Or keep the vectors between neighbours in place of the landmarks (chapter 5 again).
#
# **Question.** Landmarks are correlated by what they share. Are their differences?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
P_end = P_at[-1][3:, 3:]
D = np.kron(np.eye(15, 16, 1) - np.eye(15, 16), np.eye(2))  # row i: p_{i+1} − p_i
for name, covariance in (("landmarks", P_end), ("vectors", D @ P_end @ D.T)):
    rho = abs(correlation(covariance))
    far = abs(np.subtract.outer(*2 * [np.arange(len(rho)) // 2])) > 1
    print(f"{name}: mean |ρ| of those that are no neighbours: {rho[far].mean():.2f}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Less than the landmarks', but not none: without a compass all vectors share the map's turn.
# Distances and angles do not even share that. To drop what is left is cheaper than to drop P_ij;
# but it *is* dropped, and the vectors round a closed loop no longer add up to zero unless one sees
# to it.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## What even the full filter gets wrong
#
# Keep everything: is the filter honest for ever? It takes Jacobians at its estimates, and these
# change.
#
# **Question.** Robot and landmarks shifted together in x, in y, or turned together: no sighting
# can tell. That makes three directions of the state about which nothing may ever be learnt. Put all
# H's of a run below each other, each brought back to the first state by the A's before it: H_k A_k
# … A_1. With three landmarks the state has 9 numbers, so the **rank** of that tall matrix must be 6.
#
# **Predict** the rank for the filter's own Jacobians.


# %% slideshow={"slide_type": "fragment"}
def all_sightings(first_estimates, seed=7):
    """What a run's sightings say of its first state, by the filter's own A and H; that state."""
    small = Loop(landmarks=3, radius=2, spread=1, range_max=20, steps=30)
    run = LandmarkRun(small, np.random.default_rng(seed))
    mak = MAK(np.zeros(3), np.zeros((3, 3)), first_estimates=first_estimates)
    since_start, rows = np.eye(9), []
    for reading in run:
        seen, pose = reading.observations, mak.pose
        if not mak.ids:
            mak.add(seen.ids.tolist(), seen.z, R_loop)
            at_first = mak.x.copy()
            continue
        Q = Q_arc(pose, reading.odometry, run.robot)
        since_start[:3] = mak.predict(compose(pose, reading.odometry), Q) @ since_start[:3]
        step = mak.update(seen.ids.tolist(), seen.z, R_loop)
        H = np.zeros((len(step.H), 9))
        H[:, step.columns] = step.H
        rows.append(H @ since_start)
    return np.vstack(rows), at_first


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for name, first_estimates in (("standard", False), ("first estimates", True)):
    seen, state = all_sightings(first_estimates)
    x, y, marks = *state[:2], state[3:].reshape(-1, 2)
    shift = np.array([1, 0, 0, *np.tile([1, 0], 3)])
    turn = np.array([-y, x, 1, *np.column_stack([-marks[:, 1], marks[:, 0]]).ravel()])
    learnt = [np.linalg.norm(seen @ d) / np.linalg.norm(d) for d in (shift, turn)]
    print(
        f"{name}: rank {np.linalg.matrix_rank(seen)} of {len(state)}; "
        f"learnt of a shift {learnt[0]:.6f}, of a turn {learnt[1]:.6f}"
    )

# %% [markdown] slideshow={"slide_type": "fragment"}
# Rank 7: one direction too many. The filter believes that it learns how the whole scene is
# *turned*. It cannot; each sighting sees the landmark from a slightly other estimate, and the
# differences look like news.
#
# **First estimates** (Huang, Mourikis and Roumeliotis, 2010) take every Jacobian of a landmark
# where it was first placed, and A between predicted poses. That point is a little worse, and the
# same every time: rank 6.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let someone say in one sentence why the shift is safe: H's robot columns for x
# and y are minus its landmark columns wherever they are taken (lesson 04). The turn needs the
# landmark's *place*, and that is what changes.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## How much is that?
#
# Three filters on the same readings: *ideal* (all Jacobians at the truth, which only a simulation
# knows), *first estimates*, *standard*. 400 runs of seven rounds each were made beforehand
# (`python -m slamlab.studies.consistency`), with good wheels and with noisy ones.
#
# **Predict:** in which order do the three stand, and which world tells them apart?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
folder = files("slamlab") / "data" / "studies"
lines = ["| wheels | filter | NEES | steps above band | heading | landmarks |", "|---" * 6 + "|"]
for wheels, file in (("good", "consistency.json"), ("noisy", "consistency-noisy.json")):
    study = json.loads((folder / file).read_text(encoding="utf-8"))
    for name, row in study["filters"].items():
        lines.append(
            f"| {wheels} | {name} | {row['nees']:.2f} ± {row['nees_standard_error']:.2f} "
            f"| {row['steps_above_band']:.0%} | {row['heading_rmse_deg']:.2f}° "
            f"| {100 * row['landmark_rmse_m']:.1f} cm |"
        )
low, high = study["band_95"]
lines += ["", f"At one step, 95 % of averages over the runs lie from {low:.2f} to {high:.2f}."]
Markdown("\n".join(lines))

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** with good wheels the three are close together. With noisy ones the standard filter's NEES
# is twice what it may be, above the band nearly always, and its heading and map are the worst: it
# is surer, *and* farther off. First estimates come close to the ideal. Even the ideal is at the
# band's edge: with so much noise a straight map is not all of the truth (lesson 04's banana).
#
# A few runs again show the mechanism:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
noisy = Loop(v_sigma=0.05, omega_sigma=0.05)
sample = [errors_of(seed, noisy) for seed in range(4)]
for name in ("ideal", "first estimates", "standard"):
    believed = np.mean([run[name][1][-100:, 2, 2] for run in sample])
    print(f"{name}: believes its heading to ±{np.degrees(np.sqrt(believed)):.1f}° at the end")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Four runs prove nothing about NEES. But what a filter *believes* varies little, and there it is:
# from the same readings, the standard filter claims a better heading than the ideal one can have.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## What you can do now
#
# | dropped or put off | what happens |
# |---|---|
# | P_ri, P_ij | the filter counts one witness many times: NEES in the hundreds |
# | the far landmarks' share, until the robot leaves | nothing: the compressed EKF |
# | shared noise of groups that start anew | next to nothing: joined maps |
# | the common error (relative maps) | little, if loops are made to add up |
# | changing Jacobians (first estimates) | honesty for little money |
#
# **Next:** [lesson 08](08_landmarks_from_scans.ipynb), landmarks from scans: here every landmark
# told its name; a wall does not. [Lesson 13](13_scan_matching.ipynb) does without landmarks.
#
# **Exercise:** [correlations](../exercises/ex07_correlations.ipynb).
