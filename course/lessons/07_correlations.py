# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 07 · Correlations
#
# **You will be able to** say block by block where the correlations of a map come from, what breaks
# when they are dropped, what they cost, and how some of that cost can be avoided without losing
# anything.
#
# **90 minutes**, in two parts of 45: where correlations come from, and what they are good for.
# **Before:** lesson [06](06_ekf_slam.ipynb), which builds the filter, and NEES from lesson
# [03](03_kalman_filter.ipynb).
#
# *Key:* a landmark that is placed by a robot inherits the robot's error. The covariance has to
# remember that.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The first part is a lecture at the blackboard, with a machine that checks each
# line. The second is a series of experiments. Both take 45 minutes with their questions.
#
# *In 45 minutes:* the two sightings with their derivations, "A whole loop" without what the map errs
# by, "Part two: drop them", and the last slide. What stands behind the last slide is for reading at home.
#
# Good for a poll: the first question, the one on the far landmark, and the one on dropping.

# %% slideshow={"slide_type": "skip"} tags=["folded"]
from copy import deepcopy
from dataclasses import replace
from functools import cache
from itertools import pairwise
from time import perf_counter

import numpy as np
import sympy as sp
from IPython.display import Markdown

from slamlab import models, views
from slamlab.checks import ask
from slamlab.derivation import blockwise, derive, symmetric
from slamlab.estimators.mak_slam import MakSlam, Q_arc
from slamlab.evaluation import band, correlation
from slamlab.filters import MAK, CompressedMAK, JoinedMap
from slamlab.geometry import compose
from slamlab.layers import Points, Poses
from slamlab.sources.landmark_runs import LandmarkRun, Loop
from slamlab.studies import forgetting, observability, shared_errors, two_halves
from slamlab.studies.consistency import errors_of
from slamlab.studies.study_command import stored

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Two landmarks, two sightings
#
# A robot and two landmarks, 1 and 2: what happens to their covariance when the robot looks first at
# one and then at the other? This is the smallest example in which everything happens that happens
# in a large map. It comes from the MAK thesis.
#
# At the beginning the robot and both landmarks are each known from a source of their own. Their three
# errors have nothing in common, so the covariance is block-diagonal:
#
# $$P = \begin{bmatrix} P_{\mathrm{rr}} & 0 & 0 \\ 0 & P_{11} & 0 \\ 0 & 0 & P_{22} \end{bmatrix}
# \tag{07.1}$$

# %% slideshow={"slide_type": "subslide"}
ask(
    "07-blocks",
    "The robot sees landmark 1, and then landmark 2; never both at once. Of the three cross blocks "
    "$P_{\\mathrm r1}$, $P_{\\mathrm r2}$, $P_{12}$, **which are still zero after the second sighting?**",
    {
        "all three": "each sighting has noise of its own, but it corrects robot and landmark by one "
        "and the same innovation.",
        "only the one between the two landmarks": "nobody measured from one to the other; still, "
        "both now depend on the same robot.",
        "none": "the robot carries what it learned at landmark 1 over to landmark 2.",
    },
    right="none",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# We shall derive it, block by block, with a machine that checks each line.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### What a sighting looks at
#
# By lesson 05, the innovation depends on the error of the robot, by $H_{\mathrm r}$, and on that of
# the landmark in sight, by $H_{\mathrm p}$. About any other landmark it says nothing:
#
# $$H_1 = \begin{bmatrix} H_{\mathrm r} & H_{\mathrm p} & 0 \end{bmatrix}, \qquad
# H_2 = \begin{bmatrix} H_{\mathrm r} & 0 & H_{\mathrm p} \end{bmatrix} \tag{07.2}$$

# %% slideshow={"slide_type": "fragment"}
Z, of = sp.ZeroMatrix, sp.MatrixSymbol
P_rr, P_11, P_22 = symmetric("P_rr", 3), symmetric("P_11", 2), symmetric("P_22", 2)
P = sp.BlockMatrix([[P_rr, Z(3, 2), Z(3, 2)], [Z(2, 3), P_11, Z(2, 2)], [Z(2, 3), Z(2, 2), P_22]])
H_r, H_p, S = of("H_r", 2, 3), of("H_p", 2, 2), symmetric("S", 2)
H_1 = sp.BlockMatrix([[H_r, H_p, Z(2, 2)]])
H_2 = sp.BlockMatrix([[H_r, Z(2, 2), H_p]])

# %% [markdown] slideshow={"slide_type": "slide"} minutes=9
# ## The first sighting, line by line
#
# Who learns from a sighting? The gain is $K = P H^{\mathsf T} S^{-1}$, so we look at $P H^{\mathsf T}$,
# the covariance of the state's error with the innovation:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
sp.block_collapse(P * H_1.T)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The third block is zero: landmark 2 shares nothing with the robot and nothing with landmark 1, so
# it shares nothing with the innovation either. Robot and landmark 1 move, landmark 2 stays.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Any covariance, any sighting
#
# Lesson 03 left us with $P - K S K^{\mathsf T}$. We put the gain in:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
any_P, any_H, K = symmetric("P", 7), of("H", 2, 7), of("K", 7, 2)
update = (
    derive("P_new", any_P - K * S * K.T, "an update takes K S Kᵀ away")
    .step("put the gain in", given={K: any_P * any_H.T * S.I})
    .step("multiply: S⁻¹ S falls out, and S and P are symmetric", lambda line: line.doit())
)
update

# %% [markdown] slideshow={"slide_type": "fragment"}
# So everything depends on the column $P H^{\mathsf T}$ that we have just looked at:
#
# $$P \leftarrow P - P H^{\mathsf T} S^{-1} H P \tag{07.3}$$


# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Block by block
#
# Now we write $P$ and $H$ in blocks, and let the machine multiply:


# %% slideshow={"slide_type": "fragment"}
def sighting(P, H):
    """What a sighting makes of a covariance in blocks, as a derivation."""
    PHt, given = blockwise(P * H.T), {any_P: P, any_H: H}
    return (
        derive("P_new", update.result, "any update, as derived")
        .step("in blocks; P Hᵀ is a column", P - PHt * S.I * PHt.T, given)
        .step("multiply block by block", blockwise)
    )


# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="07-blocks"
seen = H_1  # what is seen: change this line
sighting(P, seen)

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### A correlation is born
#
# The first row's second block was zero. Now it is
#
# $$P_{\mathrm r1} = -P_{\mathrm{rr}} H_{\mathrm r}^{\mathsf T} S^{-1} H_{\mathrm p} P_{11}, \tag{07.4}$$
#
# a product of five matrices. One sighting has corrected both, robot and landmark 1, by the same
# innovation with the same noise in it, so from now on they share an error. Landmark 2 is untouched:
# two zeros and the old $P_{22}$.
#
# **Try** `seen = sp.BlockMatrix([[Z(2, 3), -H_p, H_p]])`, a sensor that tells only how landmark
# 2 lies relative to landmark 1. The robot's row stays as it was, and $P_{12}$ is born at once.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Say it with people. Two friends set their watches by each other. If one watch
# proves wrong later, the other is wrong in the same way. This is what a cross block keeps.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## The second sighting
#
# Before the robot looks at landmark 2 it may drive. Lesson 06 derived what this does to the blocks:
#
# $$P_{\mathrm{rr}} \leftarrow A P_{\mathrm{rr}} A^{\mathsf T} + Q, \qquad
# P_{\mathrm ri} \leftarrow A P_{\mathrm ri}, \qquad P_{ij} \leftarrow P_{ij} \tag{07.5}$$
#
# The numbers of the robot's row change, but a zero block stays zero, and the map's blocks do not
# change at all. So $P$ has the pattern that the first sighting has left. (From here on, the letters
# stand for the blocks as they are now.) Who learns from the second?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
P_r1 = of("P_r1", 3, 2)
P_then = sp.BlockMatrix([[P_rr, P_r1, Z(3, 2)], [P_r1.T, P_11, Z(2, 2)], [Z(2, 3), Z(2, 2), P_22]])
sp.block_collapse(P_then * H_2.T)

# %% [markdown] slideshow={"slide_type": "fragment"}
# All three. Landmark 1 is **not in sight**, and yet its block $P_{\mathrm r1}^{\mathsf T} H_{\mathrm
# r}^{\mathsf T}$ is not zero. Landmark 2 tells something about the robot, and landmark 1 was placed
# by that robot.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="07-blocks"
sighting(P_then, H_2)

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Two that were never seen together
#
# Look at the last block of the second row:
#
# $$P_{12} = -P_{\mathrm r1}^{\mathsf T} H_{\mathrm r}^{\mathsf T} S^{-1} H_{\mathrm p} P_{22}
# \tag{07.6}$$
#
# Nobody ever measured from one landmark to the other. They are correlated **by way of the robot**:
# $P_{\mathrm r1}$ stands in the product. And no block is zero any more:

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Compare with what the class answered. Whoever said "only the one between the
# landmarks": ask what happens to landmark 1 when we learn that the robot stood 10 cm further left.


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="07-blocks"
def by_name(blocks):
    """The six blocks of a symmetric matrix of 3 × 3 blocks: rr, r1, r2, 11, 12, 22."""
    return {a + b: blocks[i, j] for i, a in enumerate("r12") for j, b in enumerate("r12") if j >= i}


first, second = (by_name(sighting(*pair).result.blocks) for pair in ((P, H_1), (P_then, H_2)))
for when, blocks in (("first", first), ("second", second)):
    zero = [f"P_{block}" for block, value in blocks.items() if value.is_ZeroMatrix]
    print(f"zero after the {when} sighting:", ", ".join(zero) or "none")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-blocks"
# Every further sighting and every further landmark repeats this. In EKF-SLAM **all errors become
# correlated with all others**, and stay so.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## How strong is a correlation?
#
# A block that is not zero may still be small. So we look at the correlation, $\rho = P_{ij} /
# (\sigma_i \sigma_j)$, a pure number between −1 and 1.
#
# Take a corridor, where each place is a single number, and landmarks of which nothing was known before. Each
# is put where the robot believes that it sees it. Its error is the robot's, plus that of the sensor. If
# the robot drives between the two sightings, which adds $Q$, the two errors share
# $P_{\mathrm{rr}}$ and nothing else:
#
# $$\rho_{12} = \frac{P_{\mathrm{rr}}}{\sqrt{(P_{\mathrm{rr}} + R)\,(P_{\mathrm{rr}} + Q + R)}}
# \tag{07.7}$$

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
ahead = {"pose": np.zeros(3), "landmarks": np.array([[2.0, 0.0], [3.0, 0.0]])}
for robot_sigma, drive_sigma in ((0.02, 0.0), (0.3, 0.0), (0.3, 0.3)):
    stages, _ = shared_errors.two_sightings(robot_sigma, drive_sigma, prior_sigma=100, **ahead)
    P_robot, Q_drive, R_range = robot_sigma**2, drive_sigma**2, shared_errors.R[0, 0]
    formula = P_robot / np.sqrt((P_robot + R_range) * (P_robot + Q_drive + R_range))
    by_filter = correlation(stages[2])[3, 5]
    print(f"robot ±{robot_sigma} m, drive ±{drive_sigma} m: {formula:.3f}, filter {by_filter:.3f}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The filter agrees with (07.7). The worse the robot knows where it is, compared with what its
# sensor adds, the more its landmarks err together. A robot that knows its place makes a map without
# correlations: that was lesson 05's second half.


# %% slideshow={"slide_type": "subslide"} answers="07-blocks" tags=["folded"]
def blocks_fill(robot_sigma, drive_sigma):
    stages, _ = shared_errors.two_sightings(robot_sigma, drive_sigma, heading_sigma=0.02)
    strongest = abs(correlation(stages[2])[3:5, 5:]).max()
    titles = ["at first", "1 was seen", f"2 as well: |ρ₁₂| up to {strongest:.2f}"]
    fig, axes = views.panels(titles, size=(10, 3.8))
    for ax, stage in zip(axes, stages, strict=True):
        views.correlation(correlation(stage), ["robot", "1", "2"], ax=ax)
        ax.set(xlabel="", ylabel="")
    views.colour_bar(axes)
    return fig


views.explore(
    blocks_fill,
    lambda robot_sigma, drive_sigma: (
        f"Three correlation matrices, robot known to {robot_sigma:.2f} m, drive to {drive_sigma:.2f}: "
        "the first is block-diagonal, in the second robot and landmark one share a block, and in the "
        "third no block is empty."
    ),
    robot_sigma=(0.02, 0.5, 0.3),
    drive_sigma=(0.0, 1.0, 0.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-blocks"
# White is zero, red and blue are strong. The corner of the two landmarks fills last. Make the robot
# surer, and it pales; let the robot drive badly in between, and it pales as well, because landmark
# 2 then errs mostly by what happened on the way.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=9
# ## A whole loop
#
# Now 16 landmarks stand round a loop (simulated). The robot starts sure of its place, since that is
# where it lays the origin of its map. It drives round once, and sees landmarks only from near by.
# They are numbered as they come into sight.

# %% slideshow={"slide_type": "fragment"}
loop = Loop(landmarks=16, steps=96, v_sigma=0.04, omega_sigma=0.03, range_max=2.2)
drive = LandmarkRun(loop, np.random.default_rng(7))
slam, P_at, film = MakSlam(drive.robot, drive.sensor), [], []
for k, reading in enumerate(drive):
    slam.step(reading)
    P_at.append(slam.filter.P)
    if k % 2 == 0:
        drawn = [Poses("truth", drive.truth.poses[: k + 1]), *slam.layers()[1:]]
        film.append((slam.filter.landmarks(), correlation(P_at[-1]), drawn))

# %% slideshow={"slide_type": "subslide"}
ask(
    "07-closing",
    "At the end of the lap the robot meets landmark 0 again, the first it ever saw. Landmark 9 "
    "stands at the far end of the loop, out of sight. **What becomes of its ellipse?**",
    {
        "nothing, until it is seen again": "that would be right if the robot and landmark 9 shared "
        "no error; but it was this robot that placed it.",
        "it shrinks at once": "the robot learns by how much it was wrong, and so by how much it was "
        "wrong when it placed landmark 9.",
        "it grows, as the map is torn": "the filter moves the map as a whole, and it never loses "
        "certainty by a sighting.",
    },
    right="it shrinks at once",
)


# %% slideshow={"slide_type": "subslide"} answers="07-closing" tags=["folded"]
def frame(step, landmark):
    """Map and correlation matrix at a step, one landmark marked."""
    places, rho, drawn = film[step]
    names, room = range(len(places)), len(film[-1][0])
    marked = min(landmark, len(places) - 1)
    size = (10, 4.6)
    fig, (map_, _) = views.linked(places, rho, names, marked, drawn, room, (-7, 7, -3, 10.5), size)
    map_.set_title(f"{2 * step} s, marked: {marked}")
    return fig


views.explore(
    frame,
    lambda step, landmark: (
        f"A map with ellipses at {2 * step} s beside the correlation matrix, which fills as landmarks "
        f"are seen; landmark {landmark} is framed, the colours are its correlations."
    ),
    play="step",
    step=(0, len(film) - 1, 37),
    landmark=(0, 15, 5),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-closing"
# The true way is black, the estimate blue. A landmark's colour is its correlation with the one in
# the square, whose rows and columns are framed on the right (of the 2 × 2 block, the mean of x with
# x and y with y). Just before the loop closes, 5 and its neighbours are red: they err *together*.
# Number 0, seen from the start, errs alone. Now press ▶. At a single look at number 0 the robot
# jumps back to where it is, and what it had misplaced moves along.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Play it twice, once looking at the map, once at the matrix. Then mark number 12,
# go to the end, and ask why its neighbours are redder than landmarks far away.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="07-closing"
met = slam.filter.ids[0]  # the source's name of landmark 0
again = next(k for k, each in enumerate(drive) if k > 48 and met in each.observations.ids)
spreads = {}
for second_of_run in (again - 1, again, again + 4, 96):
    P_k = P_at[second_of_run]
    both = [np.sqrt(np.trace(P_k[j : j + 2, j : j + 2])) for j in (0, 3 + 2 * 9)]
    spreads[second_of_run] = 100 * np.array(both)
    print(
        "{} s: robot ±{:2.0f} cm, landmark 9 ±{:2.0f} cm".format(
            second_of_run, *100 * np.array(both)
        )
    )

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-closing"
# At {= again =} s the robot sees landmark 0 again. In that one second landmark 9, unseen, goes from
# ±{= spreads[again - 1][1]:.0f =} cm to ±{= spreads[again][1]:.0f =} cm. This is the second sighting of our
# example on a large scale: the robot's block with landmark 9 brings it the news. Without that block
# no word would reach it.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## What a map errs by
#
# A matrix of 35 × 35 correlations looks bewildering. Most of it has a simple cause: the map is
# displaced, or turned, **as a whole**. If it is turned by a small angle $\delta$ about the origin,
# landmark $i$ moves by
#
# $$\tilde p_i = \delta \begin{pmatrix} -y_i \\ x_i \end{pmatrix}. \tag{07.8}$$
#
# The farther out it stands, the more it moves. So one unknown angle, with the variance
# $\sigma_\delta^2$, makes all these covariances:
#
# $$E[\tilde x_i \tilde x_j] = \sigma_\delta^2\, y_i y_j, \qquad
# E[\tilde x_i \tilde y_j] = -\sigma_\delta^2\, y_i x_j. \tag{07.9}$$

# %% slideshow={"slide_type": "subslide"}
ask(
    "07-sign",
    "The map is uncertain by a turn about the start. **How do the x error of landmark i and the y "
    "error of another landmark j go together?**",
    {
        "alike": "so do the x errors of two landmarks on the same side of the start, by (07.9).",
        "against each other": "look at the signs in (07.9): the product is negative only if both "
        "factors have the same sign.",
        "it depends on where the two stand": "on whether i lies left of the start, and on whether j "
        "lies ahead of it.",
    },
    right="it depends on where the two stand",
)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="07-sign"
places, P_map = film[37][0], P_at[74][3:, 3:]
rho_xy = correlation(P_at[74])[3::2, 4::2]
foretold = -np.outer(places[:, 1], places[:, 0])  # the sign by (07.9)
strong = (abs(rho_xy) > 0.3) & ~np.eye(len(places), dtype=bool)
as_foretold, against = np.mean((rho_xy * foretold)[strong] > 0), np.mean(rho_xy[strong] < 0)
shifts, turn = shared_errors.rigid_share(P_map, places)
print(f"{strong.sum()} strong correlations of x with y: {100 * against:.0f} % are negative")
print(f"{100 * as_foretold:.0f} % have the sign that (07.9) foretells")
print(
    f"of all the map's variance, {100 * shifts:.0f} % is displacement and {100 * turn:.0f} % a turn"
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-sign"
# Just before the loop closes, {= 100 * (shifts + turn):.0f =} % of the map's variance is that of a
# stiff plate that is pushed about on a table. Only the rest bends the map. So the *shape* of the
# map is known better than its place. We shall meet this again, twice.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* This is a good place for the break. A sheet of paper on the desk, pushed and
# turned, shows (07.8) faster than any formula. Ask which landmark moves most.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=10
# ## Part two: drop them
#
# The correlations fill the whole matrix, and they cost memory and time. It is tempting to keep only
# the diagonal blocks, $N + 1$ small covariances, and to forget the rest after each step. The filter
# still sees the same landmarks with the same noise. We try it on simulated laps, with a filter of the
# package that keeps any share of the cross blocks:

# %% slideshow={"slide_type": "fragment"}
LAP, RUNS = Loop(steps=90), 16


@cache
def laps(share_kept, wheel_noise):
    """Simulated laps of a filter that keeps a share of every cross block after each step."""
    noise = {name: wheel_noise * getattr(LAP, name) for name in ("v_sigma", "omega_sigma")}
    return forgetting.laps(replace(LAP, **noise), share_kept, RUNS)


def mean_nees(share_kept, wheel_noise=1.0):
    return np.mean([lap.nees for lap in laps(share_kept, wheel_noise)], axis=0)


# %% slideshow={"slide_type": "subslide"}
ask(
    "07-drop",
    "A filter throws all cross blocks away after each step. **Where is its NEES** (3 on average for "
    "an honest filter) **on a lap of the loop?**",
    {
        "near 3: they were small anyway": "just before the loop closed, many were near 1.",
        "below 3: it knows less, so it claims less": "it does know less. But it takes each "
        "sighting for fresh news, so it does not know that it knows less.",
        "far above 3: it is too sure": "it takes each sighting for news, even where it hears its own "
        "error come back.",
    },
    right="far above 3: it is too sure",
)


# %% slideshow={"slide_type": "subslide"} answers="07-drop" tags=["folded"]
def forget(share_kept, wheel_noise):
    """Mean NEES of the pose: all kept, and a share kept at each step."""
    some = "nothing kept" if share_kept == 0 else f"{share_kept:.2f} kept at each step"
    values = {
        name: mean_nees(s, wheel_noise) for name, s in (("all kept", 1.0), (some, share_kept))
    }
    times = forgetting.BEGIN + np.arange(len(values["all kept"]))
    title = f"{RUNS} laps; highest {values[some].max():.0f}"
    return views.against_band(times, values, band(3, RUNS), "time [s]", "mean NEES [1]", title)[0]


views.explore(
    forget,
    lambda share_kept, wheel_noise: (
        f"With all cross blocks NEES stays about its band; with {share_kept:.2f} of them kept at each "
        f"step, and {wheel_noise:.1f} times the usual noise of the wheels, it reaches "
        f"{mean_nees(share_kept, wheel_noise).max():.0f}."
    ),
    share_kept=(0.0, 1.0, 0.0),
    wheel_noise=(0.5, 2.0, 1.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-drop"
# With all terms NEES never exceeds {= mean_nees(1.0).max():.1f =}, and the band ends at
# {= band(3, RUNS)[1]:.1f =}. With none it climbs to {= mean_nees(0.0).max():.0f =}: errors
# {= np.sqrt(mean_nees(0.0).max() / 3):.0f =} times as large as claimed. It falls when the loop
# closes, but the filter has not become honest: the first landmarks are well known, and they pull the
# robot back. Half measures do not help. A filter that keeps nine tenths at each step still reaches
# {= mean_nees(0.9).max():.0f =}.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="07-drop"
kept, dropped = laps(1.0, 1.0), laps(0.0, 1.0)
for name, some in (("all kept", kept), ("nothing kept", dropped)):
    better = sum(lap.rms < lap.wheels_rms for lap in some)
    print(f"{name}: rms error {np.median([lap.rms for lap in some]):.2f} m (median), smaller than")
    print(f"  that of the wheels alone in {better} of {RUNS} laps;")
    print(
        f"  {100 * np.mean([lap.inside for lap in some]):.0f} % of the 95 % ellipses hold their landmark"
    )
wheels_rms = np.median([lap.wheels_rms for lap in kept])
closer = sum(a.rms < b.rms for a, b in zip(kept, dropped, strict=True))

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-drop"
# The wheels alone err by {= wheels_rms:.2f =} m. So the forgetful filter's *estimates* are not that
# bad: on most laps it beats its wheels, and the full filter is nearer to the truth on no more than
# {= closer =} of {= RUNS =}. What it has lost is any idea of **how wrong it is**.

# %% slideshow={"slide_type": "subslide"} answers="07-drop" tags=["folded"]
pictures = {}
for name, some in (("all kept", kept), ("nothing kept", dropped)):
    layers = some[3].slam.layers()
    pictures[name] = [Points("truth", some[3].run.landmarks), layers[1], layers[2]]
fig, axes = views.side_by_side(pictures, size=(10, 4.2))
for ax in axes:
    ax.set(xlim=(-4.8, 4.8), ylim=(4, 10.5))  # the far half of the loop
    ax.lines[0].set_markersize(5)
    ax.lines[0].set_label("true landmark")
views.legend_below(fig)
views.show(
    fig,
    f"{100 * kept[3].inside:.0f} % of the ellipses on the left hold their landmarks; on the right the ellipses "
    f"are tiny, and {100 * dropped[3].inside:.0f} % do.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-drop"
# This is the far half of one of these laps. On the left, ellipses hold the black points; on the right,
# tiny ellipses stand beside them. The robot sees a landmark again where it expects it, and concludes that both were
# right. But the landmark was placed *by this robot*, and repeats the robot's own error. **One witness
# was asked twice, and counted as two.**

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The last sentence is the lesson; let it stand a moment. The correlation is the
# memory of who told whom. Ask where else this happens: rumours, two newspapers with one agency.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## The map's certainty never falls
#
# While the robot drives blind, it becomes less certain. What do the landmarks do meanwhile, and the
# vectors between them? The vector from landmark $i$ to landmark $j$ has the covariance
#
# $$\Delta p_{ij} = p_j - p_i, \qquad \Delta P_{ij} = P_{ii} - P_{ij} - P_{ji} + P_{jj}. \tag{07.10}$$

# %% slideshow={"slide_type": "fragment"}
ask(
    "07-grow",
    "We draw the areas of three ellipses over the loop: the robot's, that of landmark 5, that of the "
    "vector from 5 to 6. **Which of them ever grow?**",
    {
        "all three, as long as the robot drives blind": "landmarks do not move, and (07.5) leaves "
        "the map's blocks alone.",
        "the robot's only": "an update takes away from every ellipse, and only the robot's is ever "
        "added to.",
        "the robot's and the landmark's": "what should make a landmark less certain? Look for a step "
        "that adds to its block.",
    },
    right="the robot's only",
)


# %% slideshow={"slide_type": "subslide"} answers="07-grow" tags=["folded"]
def parts(P):
    """The blocks P_ij of a map, (N, N, 2, 2), and the ΔP_ij of (07.10) likewise."""
    n = len(P) // 2 - 1
    blocks = P[3:, 3:].reshape(n, 2, n, 2).transpose(0, 2, 1, 3)
    own = blocks[np.arange(n), np.arange(n)]
    return blocks, own[:, None] + own[None] - blocks - blocks.swapaxes(0, 1)


def area(covariance):
    """Of the 95 % ellipse [m²]."""
    return np.pi * 5.99 * np.sqrt(max(np.linalg.det(covariance), 0))


sizes = {"robot": [], "landmark 5": [], "vector from 5 to 6": []}
for P_k in P_at:
    blocks, relative = parts(P_k)
    known = len(blocks) > 6
    sizes["robot"].append(area(P_k[:2, :2]))
    sizes["landmark 5"].append(area(blocks[5, 5]) if known else np.nan)
    sizes["vector from 5 to 6"].append(area(relative[5, 6]) if known else np.nan)
fig, ax = views.curves(np.arange(97), sizes, "time [s]", "95 % ellipse [m²]", size=(8, 4))
for line, meaning in zip(ax.lines, ("robot", "landmark", "corrected"), strict=True):
    line.set_color(views.COLOURS[meaning])
views.legend(ax)
ax.set(yscale="log", ylim=(1e-3, 10))
views.show(
    fig,
    f"The robot's area rises to {max(sizes['robot']):.1f} square metres, falls as the loop closes and "
    "rises again; a landmark's and a vector's only fall.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-grow"
# The robot's curve rises until the loop closes, falls steeply, and rises again. Landmark 5 and the
# vector from 5 to 6 only go down. And the vector is known better than the landmark: what the two
# landmarks share drops out of their difference.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### A law, not a curve
#
# Take the rows of the map out of an update. What they lose is $K S K^{\mathsf T}$ in these rows, and
# that is a square:
#
# $$P_{\mathrm{map}} \leftarrow P_{\mathrm{map}} - B B^{\mathsf T}, \qquad B = K_{\mathrm{map}}\,
# S^{1/2}. \tag{07.11}$$
#
# No variance grows by this, in any direction, and neither does any determinant (the proof stands
# under *Deeper*). We check at every step, for every landmark and up to 120 pairs:

# %% slideshow={"slide_type": "fragment"} tags=["folded", "nbval-check-output"] answers="07-grow"
largest, det = (
    {"robot": [], "landmarks": [], "pairs of landmarks": [], "vectors": []},
    np.linalg.det,
)
for before, after in pairwise(P_at[9:]):
    n = len(before)
    (old, old_relative), (new, new_relative) = parts(before), parts(after[:n, :n])
    i, j = np.triu_indices(len(old), 1)
    largest["robot"].append(det(after[:3, :3]) / det(before[:3, :3]))
    own = [det(m[np.arange(len(m)), np.arange(len(m))]) for m in (new, old)]
    largest["landmarks"].append(max(own[0] / own[1]))
    pairs = [det(np.block([[m[i, i], m[i, j]], [m[j, i], m[j, j]]])) for m in (new, old)]
    largest["pairs of landmarks"].append(max(pairs[0] / pairs[1]))
    largest["vectors"].append(max(det(new_relative[i, j]) / det(old_relative[i, j])))
for name, ratios in largest.items():
    print(f"{name}: largest det after / det before = {max(ratios):.6f}")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-grow"
# Only the robot's is above 1. This is a law of the filter, whatever its Jacobians are. The filter
# that forgot its cross blocks obeys it as well, landmark by landmark, and was wrong all the time:
# **certainty that never falls is no proof of being right.**

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The thesis concludes that "the map's certainty does not fall". Ask whether that
# is good news, and for whom. For the filter's claim it always holds.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## In the limit
#
# Certainty never falls; does it rise without end? Let a robot drive for ever. It is not sure of its
# first place: ±20 cm in x and in y. It has a perfect compass, so it always knows its heading.

# %% slideshow={"slide_type": "fragment"}
ask(
    "07-limit",
    "**To how many centimetres, in x and in y, does it know a landmark's place in the end?**",
    right=20,
    tolerance=2,
    unit="cm",
    reason="no sighting ever tells where the start was, and every landmark depends on it.",
    wrong={
        0: "the vectors between the landmarks become exact; but where is the whole?",
        10: "averaging helps against noise that is drawn anew; the start's error is drawn once.",
        28: "that is both axes together; the question is about each.",
    },
)


# %% slideshow={"slide_type": "subslide"} answers="07-limit" tags=["folded"]
exact_turns = cache(lambda start_sigma: shared_errors.long_run(0.0, start_sigma))
_, own, vector, compass_map = exact_turns(0.2)


def for_ever(turn_noise, start_sigma):
    """σ of a landmark and of a vector over many rounds, with a compass and with noisy turns."""
    found = {"compass": exact_turns(start_sigma)}
    if turn_noise:
        found["no compass"] = shared_errors.long_run(turn_noise, start_sigma)
    fig, ax = views.chart("rounds", "σ of x and y [m]", size=(8, 4))
    for (name, (rounds, *both, _)), line in zip(found.items(), ("-", "--"), strict=False):
        for what, sigma in zip(("landmark", "vector"), both, strict=True):
            colour = views.COLOURS["landmark" if what == "landmark" else "corrected"]
            ax.plot(rounds, sigma, line, color=colour, label=f"{what}, {name}")
    ax.axhline(start_sigma, color=views.COLOURS["limit"], linestyle="dashdot", linewidth=1)
    ax.set_ylim(0, 2.4 * max(start_sigma, 0.2))
    views.legend(ax, ncols=2, loc="upper center")
    return fig


views.explore(
    for_ever,
    lambda turn_noise, start_sigma: (
        f"The start is known to {start_sigma:.2f} m. With a compass a landmark comes down to that, and "
        f"its vector to the next goes on falling; turns noisy by {turn_noise:.3f} rad/s leave more."
    ),
    turn_noise=(0.0, 0.03, 0.012),
    start_sigma=(0.0, 0.4, 0.2),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-limit"
# With a compass the landmark comes down to the grey line, the doubt about the start: after twelve
# rounds it is known to {= own[-1]:.3f =} m. The vector to the next landmark, at
# {= vector[-1]:.3f =} m, goes on falling.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### One error for all
#
# In the limit every landmark has one and the same error, the start's. The map becomes *fully
# correlated*, and exact in itself:
#
# $$P_{ij} \to P_{\text{start}} \text{ for all } i, j, \qquad \Delta P_{ij} \to 0. \tag{07.12}$$

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="07-limit"
*_, turned_map = shared_errors.long_run(0.012, 0.2)
for name, mak in (("compass", compass_map), ("no compass", turned_map)):
    shifts, turn = shared_errors.rigid_share(mak.P[3:, 3:], mak.landmarks())
    rho = correlation(mak.P)[9, 11]  # x of one landmark and x of the next
    print(f"{name}: correlation of two neighbours {rho:.3f}; of the map's variance")
    print(
        f"  {100 * shifts:.1f} % displacement, {100 * turn:.1f} % turn, {100 * (1 - shifts - turn):.1f} % left"
    )

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-limit"
# Without a compass one more thing stays unknown: **how the map is turned against the start**. The
# heading at the start is exact here, because we said so. But the robot had turned, with noise,
# before it placed most of its landmarks, and no later sighting can tell that turn from a turn of
# the whole map. The shape becomes well known all the same: hardly anything is left but displacement
# and turn.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The classic proof is about a linear system, in which headings are known. Ask
# which parts of a map can become exact without a compass: distances and angles.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## The price
#
# A map of $N$ landmarks has a covariance of
#
# $$(3 + 2N)^2 \text{ numbers,} \tag{07.13}$$
#
# and each sighting changes all of them.

# %% slideshow={"slide_type": "fragment"}
ask(
    "07-price",
    "A large map grows to twice as many landmarks. **How many times as many numbers does one sighting "
    "have to change?**",
    right=4,
    tolerance=0.4,
    reason="P has twice as many rows, each of them twice as long, and every number changes.",
    wrong={
        2: "that is right for the state x, but P has a row and a column for each of its entries.",
        8: "the cube would be the cost of inverting P; what is inverted is S, whose size is that of "
        "the sighting.",
        1: "that would be right if landmarks were independent, as in lesson 05.",
    },
)


# %% slideshow={"slide_type": "subslide"} answers="07-price" tags=["folded"]
def price(N, sightings=25):
    """Bytes of P, and seconds of one step with four landmarks in sight (the best of some)."""
    rng, R = np.random.default_rng(N), np.diag([0.1, 0.03]) ** 2
    mak = MAK([0.3, -0.2, 0.4], np.diag([0.02, 0.03, 0.01]), N)
    mak.add(range(N), np.column_stack([rng.uniform(1, 20, N), rng.uniform(-3, 3, N)]), R)
    took = []
    for _ in range(sightings):
        began = perf_counter()
        mak.predict(mak.pose, 1e-6 * np.eye(3))
        mak.update(range(4), models.h(mak.pose, mak.landmarks()[:4]), R)
        took.append(perf_counter() - began)
    return mak.P.nbytes, min(took)


N_tried = np.array([50, 100, 200, 400, 800, 1600])
memory, seconds = np.array([price(N) for N in N_tried]).T
slope, _ = np.polyfit(np.log(N_tried[-3:]), np.log(seconds[-3:]), 1)
assert (memory == 8 * (3 + 2 * N_tried) ** 2).all()  # (07.13), eight bytes a number
fig, ax = views.growth(
    N_tried,
    {"time [ms]": 1e3 * seconds, "memory [MB]": memory / 1e6},
    {"grows as N²": 1e3 * seconds[-1] * (N_tried / N_tried[-1]) ** 2},
    "landmarks N",
    "ms, MB",
    size=(8, 4),
)
views.show(fig, f"Memory runs beside the line N²; time grows as N to the {slope:.1f} at the end.")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-price"
# On these axes a power is a straight line, and its slope is the exponent. Memory follows (07.13).
# Time is flat at first, where calling functions costs more than arithmetic; from 400 landmarks on
# it grows as $N^{ {= slope:.1f =} }$ on the machine that ran this. As long as every number of $P$
# changes at every sighting, nothing better than $N^2$ can be had. Every way out has to change fewer
# numbers.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## A way out: settle later
#
# The robot works in one corner. Must the far landmarks hear of every sighting *now*? J. Guivant and
# E. Nebot let them wait. Call the robot and what is around it the region $a$, the rest $b$. As long
# as only $a$ is in sight, three small sums over the sightings, $\varphi$, $\psi$ and $\vartheta$, say
# all that $b$ will have to be told:
#
# $$P_{ab} \leftarrow \varphi P_{ab}, \qquad P_{bb} \leftarrow P_{bb} - P_{ba}\, \psi\, P_{ab}, \qquad
# \hat x_b \leftarrow \hat x_b + P_{ba}\, \vartheta. \tag{07.14}$$
#
# This is done once, when the robot leaves. What does the delay cost in accuracy?

# %% slideshow={"slide_type": "subslide"}
wide = LandmarkRun(Loop(landmarks=40, steps=168), np.random.default_rng(7))
readings, slam = list(wide), MakSlam(wide.robot, wide.sensor)
for reading in readings[:85]:  # the first round makes the map
    slam.step(reading)
full, compressed = slam.filter, CompressedMAK(deepcopy(slam.filter))


def move_and_see(filter, pose, reading):
    """The same two lines for both filters."""
    Q, seen = Q_arc(pose, reading.odometry, wide.robot), reading.observations
    filter.predict(compose(pose, reading.odometry), Q)
    filter.update(seen.ids.tolist(), seen.z, two_halves.R(wide))


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
# It costs nothing. The *compressed* EKF drops no correlation, it only waits, and pays for the whole
# map once per region instead of once per step. (The exercise asks for less: what can the others be
# told if only the *outcome* of the work in the corner is known?)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## A way out: small maps, joined
#
# Or begin a new map every now and then. Each starts at (0, 0, 0), sure of itself, so its errors have
# nothing in common with those of the maps before. Two of them are joined as our example began: with
# a block-diagonal $P$. What joins them is the pose where one ends and the next begins, and the
# landmarks that both have seen, which must stand at one place.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
trip = LandmarkRun(LAP, np.random.default_rng(7))
readings, one, joined = list(trip), MakSlam(trip.robot, trip.sensor), JoinedMap()
for start in range(0, len(readings), 23):
    local = MakSlam(trip.robot, trip.sensor)
    for reading in readings[start : start + 23]:
        one.step(reading)
        local.step(reading)
    joined.join(local.filter)
    print(f"{len(local.filter.ids)} landmarks in this map, {len(joined.ids)} in the whole")

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
apart = one.filter.landmarks() - joined.landmarks()[[joined.ids.index(i) for i in one.filter.ids]]
apart = 100 * np.sqrt(np.mean(np.sum(apart**2, axis=1)))
claimed = 100 * np.sqrt(np.mean(np.trace(one.filter.blocks()[2], axis1=1, axis2=2)))
print(f"from one large filter {apart:.1f} cm apart (rms), which itself claims ±{claimed:.1f} cm")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The result is not the same to the last digit, because the Jacobians are taken at other estimates.
# Here the difference is {= 100 * apart / claimed:.0f =} % of what the large filter claims to know.
# A sighting then costs a time that grows with the square of a *small* map; joining costs $N^2$, but
# only once for each map.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## A way out: a relative map
#
# Or keep the vectors between neighbours, (07.10), in place of the landmarks. What two landmarks share
# drops out of their difference, so the vectors should have less in common. $D$ takes the differences:
#
# $$P_{\text{vectors}} = D\, P_{\text{map}}\, D^{\mathsf T} \tag{07.15}$$

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
P_end = P_at[-1][3:, 3:]
D = np.kron(np.eye(15, 16, 1) - np.eye(15, 16), np.eye(2))  # row i: p_{i+1} − p_i
for name, covariance in (("landmarks", P_end), ("vectors", D @ P_end @ D.T)):
    rho = abs(correlation(covariance))
    far = abs(np.subtract.outer(*2 * [np.arange(len(rho)) // 2])) > 1
    print(f"{name}: mean |ρ| of those that are no neighbours: {rho[far].mean():.2f}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# They share less, but not nothing: without a compass all vectors share the turn of the map.
# Distances and angles do not even share that. Dropping what is left should do less harm than
# dropping $P_{ij}$, because it is less. But it *is* dropped, and the vectors round a closed loop no
# longer add up to zero unless the program makes them do so.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## What even the full filter gets wrong
#
# Suppose that we keep everything. Is the filter honest for ever? It takes its Jacobians at its
# estimates, and these change. Let us ask what all sightings of a run *together* say about the first
# state. Each $H_k$ is brought back to the start by the motions before it:
#
# $$O = \begin{bmatrix} H_1 A_1 \\ H_2 A_2 A_1 \\ \vdots \\ H_k A_k \cdots A_1 \end{bmatrix}
# \tag{07.16}$$
#
# With three landmarks the state has nine numbers. If robot and landmarks are shifted together along
# x or y, or turned together, every sighting stays the same. About these three directions nothing
# can ever be learned, so the rank of $O$ must be 6.

# %% slideshow={"slide_type": "subslide"}
ask(
    "07-rank",
    "**What is the rank of $O$, computed from the Jacobians that an ordinary EKF uses on such a run?**",
    {
        "6, as it must be": "it would be if all Jacobians were taken at one and the same state.",
        "7": "one direction too many; find out which.",
        "9": "even all sightings together never see a shift of the whole scene.",
    },
    right="7",
)


# %% slideshow={"slide_type": "subslide"} answers="07-rank" tags=["folded"]
def what_is_learnt(noise, first_estimates):
    """Singular values of (07.16): how much is learnt of each of nine directions."""
    stack, _ = observability.stacked_sightings(first_estimates, noise)
    values, rank = np.linalg.svd(stack)[1], np.linalg.matrix_rank(stack)
    title = f"rank {rank}"
    fig, ax = views.chart("direction", "singular value [1]", title, size=(8, 4))
    colours = [views.COLOURS["corrected"]] * 6 + [views.COLOURS["naive"]] * 3
    ax.bar(np.arange(1, 10), np.maximum(values, 1e-17), color=colours, bottom=1e-18)
    ax.set(yscale="log", ylim=(1e-17, 1e3), xticks=range(1, 10))
    return fig


views.explore(
    what_is_learnt,
    lambda noise, first_estimates: (
        f"Singular values for {noise:.1f} times the usual noise, Jacobians at "
        f"{'first' if first_estimates else 'current'} estimates: six bars are high; of the three that "
        f"must vanish, {'none' if first_estimates or not noise else 'one'} stands out."
    ),
    noise=(0.0, 3.0, 1.0),
    first_estimates=False,
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-rank"
# Of the three red bars, which must vanish, one does not. (What the other two show is rounding.)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="07-rank"
for name, first_estimates in (("standard", False), ("first estimates", True)):
    stack, state = observability.stacked_sightings(first_estimates)
    learnt = np.linalg.norm(stack @ observability.whole_scene(state), axis=0) + 0
    told = ", ".join(
        f"{way} {size:.6f}" for way, size in zip(("x", "y", "turn"), learnt, strict=True)
    )
    print(f"{name}: rank {np.linalg.matrix_rank(stack)} of {len(state)}; learnt of {told}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# ### A turn that nobody measured
#
# The rank is 7: the filter believes that it learns how the whole scene is *turned*. It cannot. But it
# sees the same landmark each time from a slightly different estimate, and takes the difference for
# news. Move the noise to 0, and the rank is right.
#
# **First estimates** (G. Huang, A. Mourikis and S. Roumeliotis) take every Jacobian of a landmark
# where that landmark was first placed, and $A$ between predicted poses. That point is a little worse,
# but it is the same every time. Tick the box: rank 6.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let someone say why a shift is safe: the robot's columns of H for x and y are
# minus its landmark columns wherever they are taken (lesson 04). A turn needs the landmark's *place*,
# and this is what changes.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## How much is that?
#
# Three filters saw the same readings: *ideal*, with all Jacobians at the truth, which only a
# simulation knows; *first estimates*; and *standard*. The runs, of seven rounds each, were made
# beforehand, with good wheels and with noisy ones (`python -m slamlab.studies.consistency`).

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
lines = ["| wheels | filter | NEES | steps above band | heading | landmarks |", "|---" * 6 + "|"]
for wheels, table in (("good", "consistency"), ("noisy", "consistency-noisy")):
    study = stored(table)
    for name, row in study["filters"].items():
        lines.append(
            f"| {wheels} | {name} | {row['nees']:.2f} ± {row['nees_standard_error']:.2f} "
            f"| {100 * row['steps_above_band']:.0f} % | {row['heading_rmse_deg']:.2f}° "
            f"| {100 * row['landmark_rmse_m']:.1f} cm |"
        )
noisy_nees = study["filters"]["standard"]["nees"]
Markdown("\n".join(lines))

# %% [markdown] slideshow={"slide_type": "fragment"}
# At a single step, 95 % of the averages of an honest filter over {= study["seeds"][1] + 1 =} runs
# lie between {= study["band_95"][0]:.2f =} and {= study["band_95"][1]:.2f =}. With good wheels the
# three filters are close together, and the standard one is a little worse. With noisy ones the
# standard filter's NEES is {= noisy_nees:.1f =}, and its heading and its map are the worst: it is
# surer, *and* farther off. First estimates come close to the ideal in heading and map, but are
# above the band at about twice as many steps as it. Even the ideal filter leaves the band at some
# steps, because it, too, puts straight lines in place of curved models (lesson 04).

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
noisy = Loop(v_sigma=0.05, omega_sigma=0.05)
sample = [errors_of(seed, noisy) for seed in range(2)]
for name in ("ideal", "first estimates", "standard"):
    believed = np.mean([run[name][1][-100:, 2, 2] for run in sample])
    print(f"{name}: believes its heading to ±{np.degrees(np.sqrt(believed)):.1f}° at the end")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Two of the noisy runs show the mechanism. From the same readings, the standard filter claims to
# know its heading better than the ideal one can.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Literature
#
# - **One state, all correlations:** R. Smith, M. Self and P. Cheeseman, "Estimating Uncertain Spatial
#   Relationships in Robotics", in *Autonomous Robot Vehicles*, Springer, 1990.
# - **The limit:** M. W. M. G. Dissanayake, P. Newman, S. Clark, H. F. Durrant-Whyte and M. Csorba, "A
#   Solution to the Simultaneous Localization and Map Building (SLAM) Problem", *IEEE Transactions on
#   Robotics and Automation* 17(3), 2001.
# - **Compressed filter:** J. E. Guivant and E. M. Nebot, in the same issue.
# - **False certainty:** S. J. Julier and J. K. Uhlmann, "A Counter Example to the Theory of
#   Simultaneous Localization and Map Building", *ICRA*, 2001. **First estimates:** G. P. Huang, A. I.
#   Mourikis and S. I. Roumeliotis, *International Journal of Robotics Research* 29(5), 2010.
# - **Read next:** H. Durrant-Whyte and T. Bailey, "Simultaneous Localization and Mapping: Part I",
#   *IEEE Robotics & Automation Magazine* 13(2), 2006.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## What you can do now
#
# | what is dropped or put off | what happens |
# |---|---|
# | $P_{\mathrm ri}$ and $P_{ij}$ | one witness counts many times: NEES far above its band |
# | the far landmarks' share, until the robot leaves | nothing: the compressed EKF |
# | the noise that small maps share (there is none) | next to nothing: joined maps |
# | the common error (relative maps) | little, if loops are made to add up |
# | the change of the Jacobians (first estimates) | NEES close to that of the ideal filter |
#
# **What comes next:** here every landmark told its name. A wall does not:
# [lesson 08](08_landmarks_from_scans.ipynb) finds landmarks in scans.
#
# **Exercise:** [07 · Correlations](../exercises/ex07_correlations.ipynb). You pass on what was learned
# out of sight, fuse estimates that share an error, and find out how large a shared error is.
#
# What stands below is optional.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: why no determinant of the map grows
#
# Let $M$ be some rows of the map's covariance, before a sighting, and $M - B B^{\mathsf T}$ after
# it, as in (07.11). What remains is a covariance, so $B$ can be written as $B = M^{1/2} C$, and
#
# $$\det(M - B B^{\mathsf T}) = \det M \cdot \det(I - C C^{\mathsf T}), \tag{07.17}$$
#
# where the eigenvalues of $I - C C^{\mathsf T}$ lie between 0 and 1: above 0 since a covariance is
# left, at most 1 since a square was taken away. So does their product. A prediction leaves $M$ as it
# was, by (07.5). For the vectors of (07.10) the same holds with $D M D^{\mathsf T}$ and $D B$.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## In print: what the thesis says otherwise (optional)
#
# The MAK thesis writes both updates out, (4.18) to (4.39), with $W$ for our gain $K$. For every block
# it prints a first line with $W$ and a second one with the blocks of $P$. You need this only if you
# read the original.
#
# | place | printed | right | harm |
# |---|---|---|---|
# | (4.22)–(4.27), (4.33)–(4.38), first lines | $P - [W S^{-1} W]$ | $P - W S W^{\mathsf T}$ | the robot's do not multiply; the others run, and are wrong by any amount |
# | (4.34), second line | begins with $P_{\mathrm r2}$ | $P_{\mathrm r1}$ | the robot forgets landmark 1 |
# | (4.37) | $P_{12}(1 \mid 0)$ | $P_{12}(2 \mid 1)$ | none: both are zero |
# | (4.19), (4.20), (4.30)–(4.32) | $P H^{\mathsf T} v$ | $P H^{\mathsf T} S^{-1} v$ | corrections of a wrong size and unit |

# %% [markdown] slideshow={"slide_type": "subslide"}
# | place | printed | right | harm |
# |---|---|---|---|
# | second update | $S$ from $P(2 \mid 2)$ | from $P(2 \mid 1)$ | $P(2 \mid 2)$ is made from $S$ |
# | second update | $x(2 \mid 2) = x(2 \mid 2) + W v$ | $x(2 \mid 1) + W v$ | holds only if nothing moves |
# | before (4.22) | without $H_{\mathrm r}$, only $v(1 \mid 0)$ is touched | $p_1(1 \mid 0)$ | an innovation is not updated |
# | 4.3.4 | a prediction does not change the covariance | the *map's* covariance | (07.5); the end of 4.3.5 has it right |
# | 4.3.5 | memory at least $o(N^2)$ | $\Omega(N^2)$ | $o(N^2)$ means *less* than $N^2$ |
#
# The gains (4.18) and (4.29) are right, and so are eleven of the twelve second lines. The machine
# finds all of this:

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
P_1r = P_r1.T
SECOND_LINES = [  # as printed, by block; P_r2, with which (4.34) begins, is zero before update 2
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

# %% [markdown] slideshow={"slide_type": "fragment"}
# We put the numbers of our example into the symbols, and compare with the filter. What is off is
# given as a multiple of the right correction:

# %% slideshow={"slide_type": "subslide"}
stages, steps = shared_errors.two_sightings(0.1, heading_sigma=0.05, prior_sigma=0.2)
ROWS = {"r": slice(0, 3), "1": slice(3, 5), "2": slice(5, 7)}


def numbers(expression, k):
    """A formula of blocks with the numbers of update k = 0, 1 put in."""
    known = [stages[k][ROWS[a], ROWS[b]] for a, b in ("rr", "r1", "11", "22")]
    known += [steps[k].H[:, :3], steps[k].H[:, 3:], steps[k].S]
    return sp.lambdify((P_rr, P_r1, P_11, P_22, H_r, H_p, S), expression)(*known)


def first_line(k, a, b):
    """P − [W_a S⁻¹ W_b], as printed."""
    W, S = steps[k].K, steps[k].S
    return stages[k][ROWS[a], ROWS[b]] - W[ROWS[a]] @ np.linalg.inv(S) @ W[ROWS[b]]


# %% slideshow={"slide_type": "subslide"} tags=["folded", "nbval-check-output"]
def off(value, k, a, b):
    """How far a block after update k is off, in units of the right correction."""
    before, after = (stages[k + j][ROWS[a], ROWS[b]] for j in (0, 1))
    size = np.linalg.norm(value - after)
    return size / np.linalg.norm(after - before) if size > 1e-9 else 0.0


lines, factors = ["| update | block | derived | first line | second line |", "|---" * 5 + "|"], []
for k, derived in enumerate((first, second)):
    for (a, b), printed in SECOND_LINES[k].items():
        try:
            factors.append(off(first_line(k, a, b), k, a, b))
            told = f"{factors[-1]:.3g}"
        except ValueError:
            told = "does not multiply"
        ours, theirs = (off(numbers(each, k), k, a, b) for each in (derived[a + b], printed))
        lines.append(f"| {k + 1} | {a}{b} | {ours:.3g} | {told} | {theirs:.3g} |")
Markdown("\n".join(lines))

# %% [markdown] slideshow={"slide_type": "fragment"}
# What we derived is what the filter does, twelve times. Of the first lines, only those in which
# nothing happens are right; the others are off by {= min(f for f in factors if f):.0f =} to
# {= max(factors):.0f =} times the correction. (In other units these would be other numbers, since
# $S^{-1}$ stands where $S$ belongs.) Of the second lines only that of $P_{\mathrm r1}$ in the second
# update, (4.34), is wrong.

# %% slideshow={"slide_type": "subslide"} tags=["folded", "nbval-check-output"]
gains = {
    "(4.18)": (P * H_1.T * S.I, [P_rr * H_r.T, P_11 * H_p.T, Z(2, 2)]),
    "(4.29)": (P_then * H_2.T * S.I, [P_rr * H_r.T, P_1r * H_r.T, P_22 * H_p.T]),
}
for number, (derived, printed) in gains.items():
    as_printed = sp.block_collapse(sp.BlockMatrix([[block] for block in printed]) * S.I)
    print(number, "right" if sp.block_collapse(derived) == as_printed else "wrong")
v = np.array([0.1, -0.05])  # any innovation
for k, equations in enumerate(({"r": 19, "1": 20}, {"r": 30, "1": 31, "2": 32})):
    for part, number in equations.items():
        W = steps[k].K[ROWS[part]]
        moved = np.linalg.norm(W @ steps[k].S @ v) / np.linalg.norm(W @ v)
        print(f"(4.{number}) moves x {moved:.3f} times as far as it should")

# %% slideshow={"slide_type": "subslide"} tags=["folded", "nbval-check-output"]
H = np.zeros((2, 7))
H[:, steps[1].columns] = steps[1].H
from_21, from_22 = (H @ stages[k] @ H.T + shared_errors.R for k in (1, 2))
print(f"S from P(2|1): off by {abs(from_21 - steps[1].S).max():.9f}", end="; ")
print(
    f"from P(2|2): off by {100 * np.linalg.norm(from_22 - from_21) / np.linalg.norm(from_21):.0f} %"
)
print(f"x(2|2) = x(2|2) + W v wants W v = 0; here |W v| = {np.linalg.norm(steps[1].K @ v):.3f}")
no_robot = sp.BlockMatrix([[Z(2, 3), H_p, Z(2, 2)]])
print("without H_r the gain is", sp.block_collapse(P * no_robot.T * S.I).blocks.T.tolist())
A, Q = of("A", 3, 3), of("Q", 3, 3)
F = sp.BlockMatrix([[A, Z(3, 2)], [Z(2, 3), sp.Identity(2)]])
known = sp.BlockMatrix([[P_rr, P_r1], [P_1r, P_11]])
moved = sp.block_collapse(F * known * F.T + sp.BlockMatrix([[Q, Z(3, 2)], [Z(2, 3), Z(2, 2)]]))
print("a prediction leaves of P:", [b for b in moved.blocks if b in (P_rr, P_r1, P_1r, P_11)])
N = sp.symbols("N", positive=True)
print("(3 + 2N)² / N² tends to", sp.limit((3 + 2 * N) ** 2 / N**2, N, sp.oo), "and not to 0")
