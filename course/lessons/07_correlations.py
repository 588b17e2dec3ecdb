# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 07 · Correlations, consistency and cost of EKF-SLAM
#
# **You will be able to** derive block by block where the correlations of a map come from, show what
# happens when they are dropped, state their cost, reduce this cost without losing accuracy, and derive
# why EKF-SLAM becomes inconsistent.
#
# **90 minutes**, in two parts of 40 and 50: where correlations come from, and what depends on them.
# **Before:** lesson [06](06_ekf_slam.ipynb), which builds the filter, and NEES from lesson
# [03](03_kalman_filter.ipynb).
#
# *Key:* a landmark that a robot adds to its map contains the robot's error. The covariance has to keep
# the resulting correlation.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The first part is a lecture at the blackboard, and sympy checks each line. This
# part takes 40 minutes with its questions. The second part, of 50 minutes, is a series of experiments.
#
# *In 45 minutes:* the two measurements with their derivations, "A whole loop" without the displacement of
# the map, "Part two: dropped correlations", Victoria Park, and the last slide. The sections after the
# last slide are for reading at home.
#
# Questions for a poll: the first one, the one on the far landmark, and the one on dropped correlations.

# %% slideshow={"slide_type": "skip"} tags=["folded"]
from copy import deepcopy
from dataclasses import replace
from functools import cache
from itertools import pairwise
from time import perf_counter

import numpy as np
import sympy as sp
from IPython.display import Markdown

from classroom.checks import ask, compare
from classroom.derivation import blockwise, derive, symmetric
from course.studies import dropped_correlations, landmark_correlations, observability, victoria_park
from course.studies import localisation_and_mapping as ekf_runs
from course.studies.consistency import errors_of
from course.studies.study_command import stored
from slamlab import models, sources, views
from slamlab.estimators.ekf_slam import EkfSlam, Q_arc
from slamlab.evaluation import band, correlation, nees
from slamlab.filters import MAK, CompressedEKF, JoinedMap
from slamlab.geometry import compose
from slamlab.layers import Ellipses, Points, Poses
from slamlab.sources import gtsam_text
from slamlab.sources.landmark_runs import LandmarkRun, Loop

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Two landmarks, two measurements
#
# A state consists of a robot and two landmarks, 1 and 2. How does its covariance change when the robot
# measures first landmark 1 and then landmark 2? This example from the MAK thesis is the smallest one
# that shows how all correlations of a large map arise.
#
# At the beginning the estimates of the robot and of both landmarks come from independent sources. Their
# three errors are uncorrelated, so the covariance is block-diagonal:
#
# $$P = \begin{bmatrix} P_{\mathrm{rr}} & 0 & 0 \\ 0 & P_{11} & 0 \\ 0 & 0 & P_{22} \end{bmatrix}
# \tag{07.1}$$

# %% [markdown] slideshow={"slide_type": "notes"} name="note-two-landmarks-two-measurements"
# *For the lecturer:* Let everybody fill a 3 × 3 pattern of zeros and crosses for each of the two measurements
# before the poll. The symmetric entries save half of the work.

# %% slideshow={"slide_type": "subslide"}
ask(
    "07-blocks",
    "The robot measures landmark 1 and then landmark 2, but never both at once. Of the three cross "
    "blocks $P_{\\mathrm r1}$, $P_{\\mathrm r2}$, $P_{12}$, **which are still zero after the second "
    "measurement?**",
    {
        "all three": "each measurement has its own noise, but it corrects robot and landmark by "
        "the same innovation.",
        "only the one between the two landmarks": "no measurement connects the two landmarks "
        "directly, but both errors now depend on the same robot.",
        "none": "the robot's error is correlated with landmark 1, so the second innovation is "
        "correlated with landmark 1, too.",
    },
    right="none",
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The Jacobian of a measurement
#
# By lesson 05, the innovation depends to first order on two errors: on that of the robot, with the
# Jacobian $H_{\mathrm r}$, and on that of the measured landmark, with the Jacobian $H_{\mathrm p}$. The
# innovation does not depend on any other landmark:
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

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## The first measurement, step by step
#
# Which estimates does a measurement correct? The gain is $K = P H^{\mathsf T} S^{-1}$, so we look at
# $P H^{\mathsf T}$, the covariance of the state's error with the innovation:

# %% [markdown] slideshow={"slide_type": "notes"} name="note-the-first-measurement-step-by-step"
# *For the lecturer:* Read (07.4) as a path: from the robot through the innovation to the landmark. The *Try*
# shows that a correlation can also arise without the robot.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
sp.block_collapse(P * H_1.T)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The third block is zero: the error of landmark 2 is uncorrelated with the errors of the robot and of
# landmark 1, so it is uncorrelated with the innovation, too. The robot and landmark 1 are corrected;
# landmark 2 is not.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Any covariance, any measurement
#
# Lesson 03 derived $P - K S K^{\mathsf T}$. We insert the gain:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
any_P, any_H, K = symmetric("P", 7), of("H", 2, 7), of("K", 7, 2)
update = (
    derive("P_new", any_P - K * S * K.T, "an update subtracts K S Kᵀ")
    .step("insert the gain", given={K: any_P * any_H.T * S.I})
    .step("multiply: S⁻¹ S cancels, and S and P are symmetric", lambda line: line.doit())
)
update

# %% [markdown] slideshow={"slide_type": "fragment"}
# So everything depends on the column $P H^{\mathsf T}$ from above:
#
# $$P \leftarrow P - P H^{\mathsf T} S^{-1} H P \tag{07.3}$$
#
# Now we write $P$ and $H$ in blocks, and sympy multiplies them:


# %% slideshow={"slide_type": "fragment"}
# the update of a covariance in blocks, as a derivation
def measurement(P, H):
    """Update of a covariance in blocks by a measurement, as a derivation."""
    PHt, given = blockwise(P * H.T), {any_P: P, any_H: H}
    return (
        derive("P_new", update.result, "any update, as derived")
        .step("in blocks; P Hᵀ is a column", P - PHt * S.I * PHt.T, given)
        .step("multiply block by block", blockwise)
    )


# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="07-blocks"
measured = H_1  # what is measured: change this line
measurement(P, measured)

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The first cross-covariance
#
# The second block of the first row was zero. Now it is
#
# $$P_{\mathrm r1} = -P_{\mathrm{rr}} H_{\mathrm r}^{\mathsf T} S^{-1} H_{\mathrm p} P_{11}, \tag{07.4}$$
#
# a product of five matrices. The same innovation, with the same noise, has corrected both robot and
# landmark 1, so now their errors are correlated. (Two watches that were set by the same clock have
# correlated errors for the same reason.) The blocks of landmark 2 have not changed: they are two zeros
# and the old $P_{22}$.
#
# **Try** `measured = sp.BlockMatrix([[Z(2, 3), -H_p, H_p]])`, a sensor that measures only the position
# of landmark 2 relative to landmark 1. The robot's row stays as it was, and $P_{12}$ becomes nonzero at
# once.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** Evaluate (07.4) with numbers: the robot and landmark 1 are uncorrelated, and landmark 1
# is measured. The library's filter has computed the answer.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
stages, steps = landmark_correlations.two_observations(0.3, heading_sigma=0.05)
(before, after, _), (first_step, _) = stages, steps
Hr, Hp, S_inv = first_step.H[:, :3], first_step.H[:, 3:], np.linalg.inv(first_step.S)
P_r1_new = ...  # from before[:3, :3], before[3:5, 3:5], Hr, Hp and S_inv
compare(P_r1_new, after[:3, 3:5])

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# stages, steps = landmark_correlations.two_observations(0.3, heading_sigma=0.05)
# (before, after, _), (first_step, _) = stages, steps
# Hr, Hp, S_inv = first_step.H[:, :3], first_step.H[:, 3:], np.linalg.inv(first_step.S)
# P_r1_new = -before[:3, :3] @ Hr.T @ S_inv @ Hp @ before[3:5, 3:5]
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## The second measurement
#
# Before the robot measures landmark 2, it may move. Lesson 06 derived what this does to the blocks:
#
# $$P_{\mathrm{rr}} \leftarrow A P_{\mathrm{rr}} A^{\mathsf T} + Q, \qquad
# P_{\mathrm ri} \leftarrow A P_{\mathrm ri}, \qquad P_{ij} \leftarrow P_{ij} \tag{07.5}$$
#
# The numbers in the robot's row change, but a zero block remains zero, and the map's blocks do not
# change. So $P$ keeps the pattern of the first measurement. (From here on, the symbols denote the
# current blocks.) Which estimates does the second measurement correct?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
P_r1 = of("P_r1", 3, 2)
P_then = sp.BlockMatrix([[P_rr, P_r1, Z(3, 2)], [P_r1.T, P_11, Z(2, 2)], [Z(2, 3), Z(2, 2), P_22]])
sp.block_collapse(P_then * H_2.T)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The second measurement corrects all three. Landmark 1 is **not measured**, and yet its block
# $P_{\mathrm r1}^{\mathsf T} H_{\mathrm r}^{\mathsf T}$ is not zero. The innovation of landmark 2 is
# correlated with the robot's error, and since the first measurement the robot's error has been
# correlated with that of landmark 1.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="07-blocks"
measurement(P_then, H_2)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="07-blocks"
# ### Two landmarks that were never measured together
#
# Look at the last block of the second row:
#
# $$P_{12} = -P_{\mathrm r1}^{\mathsf T} H_{\mathrm r}^{\mathsf T} S^{-1} H_{\mathrm p} P_{22}
# \tag{07.6}$$
#
# No single measurement involved both landmarks. They are correlated **through the robot**:
# $P_{\mathrm r1}$ is a factor of the product. Now no block of $P$ is zero. The same happens with every
# further measurement and every further landmark. In EKF-SLAM **all errors become correlated with all
# others**, and in general they stay correlated.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Compare this with the answers of the class. If somebody chose "only the one
# between the two landmarks", ask how the estimate of landmark 1 changes when we learn that the robot
# stood 10 cm farther to the left.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## The correlation coefficient
#
# A block that is not zero may still be small. The **correlation coefficient**
# $\rho = P_{ij} / (\sigma_i \sigma_j)$ measures the strength of a correlation by a dimensionless number
# between −1 and 1.
#
# Consider a corridor, where each position is a single number, and landmarks about which nothing was
# known before. Each landmark is added at the robot's estimated position plus the measured distance. Its
# error is the sum of the robot's error and the sensor's error. If the robot moves between the two
# measurements, which adds $Q$, then only the part with variance $P_{\mathrm{rr}}$ is common to both
# errors:
#
# $$\rho_{12} = \frac{P_{\mathrm{rr}}}{\sqrt{(P_{\mathrm{rr}} + R)\,(P_{\mathrm{rr}} + Q + R)}}
# \tag{07.7}$$

# %% [markdown] slideshow={"slide_type": "notes"} name="note-the-correlation-coefficient"
# *For the lecturer:* Ask for two limits of (07.7): a perfect sensor, $R \to 0$, and a motion without
# information, $Q \to \infty$.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** The robot's position has $\sigma = 0.3$ m, the motion adds another 0.3 m, and the ranges
# have $\sigma = 0.05$ m. Compute the correlation coefficient of the two landmarks.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
ahead = {"pose": np.zeros(3), "landmarks": np.array([[2.0, 0.0], [3.0, 0.0]])}
stages, _ = landmark_correlations.two_observations(0.3, 0.3, prior_sigma=1000, **ahead)
rho_12 = ...  # by (07.7)
compare(rho_12, correlation(stages[2])[3, 5])

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# ahead = {"pose": np.zeros(3), "landmarks": np.array([[2.0, 0.0], [3.0, 0.0]])}
# stages, _ = landmark_correlations.two_observations(0.3, 0.3, prior_sigma=1000, **ahead)
# rho_12 = 0.3**2 / np.sqrt((0.3**2 + 0.05**2) * (0.3**2 + 0.3**2 + 0.05**2))
# ```
#
# `compare` checks it against the correlation of the filter, which works in two dimensions.
#
# </details>

# %% [markdown] slideshow={"slide_type": "fragment"}
# The larger the robot's uncertainty is, compared with the sensor's noise, the more strongly its
# landmarks are correlated. A robot with an exactly known pose makes a map without correlations. This is
# the mapping with known poses of lesson 05.


# %% slideshow={"slide_type": "subslide"} answers="07-blocks" tags=["folded"]
def blocks_fill(robot_sigma, motion_sigma):
    stages, _ = landmark_correlations.two_observations(
        robot_sigma, motion_sigma, heading_sigma=0.02
    )
    strongest = abs(correlation(stages[2])[3:5, 5:]).max()
    titles = ["at first", "1 measured", f"2 measured: |ρ₁₂| up to {strongest:.2f}"]
    fig, axes = views.panels(titles, size=(9.2, 3.6))
    for ax, stage in zip(axes, stages, strict=True):
        views.correlation(correlation(stage), ["robot", "1", "2"], ax=ax)
        ax.set(xlabel="", ylabel="")
    views.colour_bar(axes)
    return fig


views.explore(
    blocks_fill,
    lambda robot_sigma, motion_sigma: (
        f"Three correlation matrices, σ of the robot {robot_sigma:.2f} m, of the motion "
        f"{motion_sigma:.2f} m: the first is block-diagonal, in the second the block of robot and "
        "landmark one has a colour, and in the third no block is zero."
    ),
    robot_sigma=(0.02, 0.5, 0.3),
    motion_sigma=(0.0, 1.0, 0.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-blocks"
# White means zero; red and blue mean strong correlations. The block of the two landmarks becomes
# nonzero last. Its correlations become weaker if you reduce the robot's uncertainty. They also become
# weaker if the motion between the measurements is uncertain, because the error of landmark 2 then comes
# mostly from this motion.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## A whole loop
#
# Now we simulate 16 landmarks round a loop. The robot starts with an exact pose, since this pose
# defines the origin of its map. The robot drives one lap, and its sensor range is 2.2 m. The landmarks
# are numbered in the order of their first measurement.

# %% slideshow={"slide_type": "fragment"}
# EKF-SLAM on the lap; keep P after each step
loop = Loop(landmarks=16, steps=96, v_sigma=0.04, omega_sigma=0.03, range_max=2.2)
drive = LandmarkRun(loop, np.random.default_rng(7))
slam, P_at, film = EkfSlam(drive.robot, drive.sensor), [], []
for k, reading in enumerate(drive):
    slam.step(reading)
    P_at.append(slam.filter.P)
    if k % 2 == 0:
        drawn = [Poses("truth", drive.truth.poses[: k + 1]), *slam.layers()[1:]]
        film.append((slam.filter.landmarks(), correlation(P_at[-1]), drawn))

# %% slideshow={"slide_type": "subslide"}
ask(
    "07-closing",
    "At the end of the lap the robot measures landmark 0 again, its very first one. Landmark 9 "
    "is at the far end of the loop, out of range. **What happens to its ellipse?**",
    {
        "nothing, until it is measured again": "this would be right if the errors of robot and "
        "landmark 9 were uncorrelated. But the robot added landmark 9 with its own error.",
        "it shrinks at once": "the innovation gives information about the pose error, which is "
        "correlated with the error of landmark 9.",
        "it grows, because the map is torn": "the filter corrects the whole map, and no update "
        "increases a variance.",
    },
    right="it shrinks at once",
)


# %% slideshow={"slide_type": "subslide"} answers="07-closing" tags=["folded"]
def frame(step, landmark):
    """Map and correlation matrix at a step, one landmark marked."""
    positions, rho, drawn = film[step]
    names, room = range(len(positions)), len(film[-1][0])
    marked = min(landmark, len(positions) - 1)
    view = (-7, 7, -3, 10.5)
    fig, (map_, _) = views.linked(positions, rho, names, marked, drawn, room, view, (9.2, 4.4))
    map_.set_title(f"{2 * step} s, marked: {marked}")
    return fig


views.explore(
    frame,
    lambda step, landmark: (
        f"A map with ellipses at {2 * step} s beside the correlation matrix; landmark {landmark} "
        "is framed, and the colours of the map show its correlations."
    ),
    play="step",
    step=(0, len(film) - 1, 37),
    landmark=(0, 15, 5),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-closing"
# The true trajectory is black, the estimate blue, and the ellipses contain 95 %. A landmark's colour
# shows its correlation with the landmark in the square, whose rows and columns are framed on the right.
# (The colour is the mean of two correlations, x with x and y with y.) Just before the loop closure, 5
# and its neighbours are red: their errors are strongly *correlated*. Landmark 0, measured from the
# start, is uncorrelated with them. Now press ▶. A single measurement of landmark 0 moves the estimated pose close to the true one,
# and moves the landmarks that were added with a large pose error in the same direction.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Play it twice: look at the map first, then at the matrix. Then mark landmark 12,
# go to the end, and ask why its neighbours have stronger correlations with it than distant landmarks.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="07-closing"
# σ of the robot and of landmark 9 around the loop closure
met = slam.filter.ids[0]  # the source's name of landmark 0
again = next(k for k, each in enumerate(drive) if k > 48 and met in each.observations.ids)
sigmas = {}
for k in (again - 1, again, again + 4, 96):
    both = [np.sqrt(np.trace(P_at[k][j : j + 2, j : j + 2])) for j in (0, 3 + 2 * 9)]
    sigmas[k] = 100 * np.array(both)
    print(f"{k} s: σ of the robot {sigmas[k][0]:2.0f} cm, of landmark 9 {sigmas[k][1]:2.0f} cm")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-closing"
# (Here σ is $\sqrt{\sigma_x^2 + \sigma_y^2}$, the root of the block's trace.) At {= again =} s the
# robot measures landmark 0 again. In this one second, σ of landmark 9, which is out of range, falls
# from {= sigmas[again - 1][1]:.0f =} cm to {= sigmas[again][1]:.0f =} cm. The reason is the same as for
# the second measurement of our example: the gain of landmark 9 contains its cross-covariances with the
# robot and with landmark 0. Without these blocks its gain would be zero.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## The rigid error of a map
#
# A matrix of 35 × 35 correlations is hard to interpret. But most of the correlations have a simple
# cause: the map is displaced, or rotated, **as a whole**. If it is rotated by a small angle $\delta$
# about the origin, landmark $i$ moves by
#
# $$\tilde p_i = \delta \begin{pmatrix} -y_i \\ x_i \end{pmatrix}. \tag{07.8}$$
#
# This displacement grows with the distance from the origin. So one unknown angle, with the variance
# $\sigma_\delta^2$, causes all these covariances:
#
# $$E[\tilde x_i \tilde x_j] = \sigma_\delta^2\, y_i y_j, \qquad
# E[\tilde x_i \tilde y_j] = -\sigma_\delta^2\, y_i x_j. \tag{07.9}$$

# %% slideshow={"slide_type": "subslide"}
ask(
    "07-sign",
    "The map has an unknown rotation about the start. **What is the sign of the correlation between "
    "the x error of landmark i and the y error of another landmark j?**",
    {
        "positive": "this is true for the x errors of two landmarks on the same side of the "
        "start, by (07.9).",
        "negative": "look at the signs in (07.9): the product is negative only if both "
        "factors have the same sign.",
        "it depends on where the two are": "the sign depends on whether i is to the left of the "
        "start, and on whether j is ahead of it.",
    },
    right="it depends on where the two are",
)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="07-sign"
positions, P_map = film[37][0], P_at[74][3:, 3:]
rho_xy = correlation(P_at[74])[3::2, 4::2]
predicted = -np.outer(positions[:, 1], positions[:, 0])  # the sign by (07.9)
strong = (abs(rho_xy) > 0.3) & ~np.eye(len(positions), dtype=bool)
as_predicted, negative = np.mean((rho_xy * predicted)[strong] > 0), np.mean(rho_xy[strong] < 0)
shifts, turn = landmark_correlations.rigid_share(P_map, positions)
print(f"{strong.sum()} strong correlations of x with y: {100 * negative:.0f} % are negative")
print(f"{100 * as_predicted:.0f} % have the sign that (07.9) predicts")
print(f"of the map's variance, {100 * shifts:.0f} % is translation and {100 * turn:.0f} % rotation")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-sign"
# Just before the loop closure, {= 100 * (shifts + turn):.0f =} % of the map's variance is caused by
# rigid displacements and rotations of the whole map. Only the rest deforms the map. So the *shape* of
# the map is known better than its position. Two later sections use this result.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* This is a good place for the break. You can demonstrate (07.8) with a sheet of
# paper that you shift and rotate on the desk. Ask which landmark moves most.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## Part two: dropped correlations
#
# The correlations fill the whole matrix, so they need memory and computing time. Could the filter keep
# only the diagonal blocks, $N + 1$ small covariances, and drop all other blocks after each step? The
# filter still gets the same measurements with the same noise. We test this idea on simulated laps, with
# a filter of the library that keeps a given share of the cross blocks (after each update and each
# augmentation):

# %% [markdown] slideshow={"slide_type": "notes"} name="note-part-two-dropped-correlations"
# *For the lecturer:* Ask first why anybody would want to drop correlations. The answer "conservative" is a
# good wrong answer: the filter loses information, but it does not know that it does.

# %% slideshow={"slide_type": "fragment"}
# simulated laps of a filter that keeps a share of every cross block
LAP, RUNS = Loop(steps=90), 16


@cache
def laps(share_kept, odometry_noise):
    """Simulated laps of a filter that keeps a share of every cross block after each step."""
    noise = {name: odometry_noise * getattr(LAP, name) for name in ("v_sigma", "omega_sigma")}
    return dropped_correlations.laps(replace(LAP, **noise), share_kept, RUNS)


def mean_nees(share_kept, odometry_noise=1.0):
    return np.mean([lap.nees for lap in laps(share_kept, odometry_noise)], axis=0)


# %% slideshow={"slide_type": "subslide"}
ask(
    "07-drop",
    "A filter drops all cross blocks after each step. **What is its NEES** (3 on average for "
    "a consistent filter) **on a lap of the loop?**",
    {
        "near 3: the correlations were small anyway": "just before the loop closure, many "
        "correlations were near 1.",
        "below 3: it has less information, so it is conservative": "the filter does lose "
        "information. But it treats each measurement as independent information, so its P "
        "becomes too small.",
        "far above 3: it is overconfident": "it treats each measurement as independent information, "
        "even where the landmark contains the robot's own error.",
    },
    right="far above 3: it is overconfident",
)


# %% slideshow={"slide_type": "subslide"} answers="07-drop" tags=["folded"]
def drop(share_kept, odometry_noise):
    """Mean NEES of the pose: all kept, and a share kept at each step."""
    some = "nothing kept" if share_kept == 0 else f"{share_kept:.2f} kept at each step"
    values = {
        name: mean_nees(s, odometry_noise) for name, s in (("all kept", 1.0), (some, share_kept))
    }
    times = dropped_correlations.BEGIN + np.arange(len(values["all kept"]))
    title = f"{RUNS} laps; highest {values[some].max():.0f}"
    return views.against_band(times, values, band(3, RUNS), "time [s]", "mean NEES [1]", title)[0]


views.explore(
    drop,
    lambda share_kept, odometry_noise: (
        f"With all cross blocks NEES stays near its χ² interval; with {share_kept:.2f} of them kept at "
        f"each step, and {odometry_noise:.1f} times the usual noise of odometry, it reaches "
        f"{mean_nees(share_kept, odometry_noise).max():.0f}."
    ),
    share_kept=(0.0, 1.0, 0.0),
    odometry_noise=(0.5, 2.0, 1.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-drop"
# With all cross blocks the mean NEES never exceeds {= mean_nees(1.0).max():.1f =}; the upper limit of
# the χ² interval is {= band(3, RUNS)[1]:.1f =}. Without cross blocks it rises to
# {= mean_nees(0.0).max():.0f =}: the errors are {= np.sqrt(mean_nees(0.0).max() / 3):.0f =} times as
# large as $P$ predicts. The NEES falls at the loop closure, because the first landmarks have small
# errors and correct the pose, but the filter remains overconfident. A filter that keeps a share of 0.9
# at each step still reaches {= mean_nees(0.9).max():.0f =}; with 0.95 it reaches
# {= mean_nees(0.95).max():.1f =}, and with 0.99 {= mean_nees(0.99).max():.1f =}. In this example only a
# share of about 0.99 causes no visible overconfidence.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="07-drop"
# the errors of the laps, with all cross blocks and with none
kept, dropped = laps(1.0, 1.0), laps(0.0, 1.0)
for name, some in (("all kept", kept), ("nothing kept", dropped)):
    better = sum(lap.rms < lap.wheels_rms for lap in some)
    inside = 100 * np.mean([lap.inside for lap in some])
    print(f"{name}: rms error {np.median([lap.rms for lap in some]):.2f} m (median),", end=" ")
    print(f"less than odometry's in {better} of {RUNS} laps;")
    print(f"  {inside:.0f} % of the 95 % ellipses contain their landmark")
odometry_rms = np.median([lap.wheels_rms for lap in kept])
closer = sum(a.rms < b.rms for a, b in zip(kept, dropped, strict=True))

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-drop"
# Odometry alone has an rms error of {= odometry_rms:.2f =} m. So the *estimates* without correlations
# are still useful: on most laps they are more accurate than odometry, and the full filter is nearer to
# the truth on only {= closer =} of {= RUNS =} laps. But the **covariance** of the filter without
# correlations is wrong.

# %% slideshow={"slide_type": "subslide"} answers="07-drop" tags=["folded"]
pictures = {}
for name, some in (("all kept", kept), ("nothing kept", dropped)):
    layers = some[3].slam.layers()
    pictures[name] = [Points("truth", some[3].run.landmarks), layers[1], layers[2]]
fig, axes = views.side_by_side(pictures, size=(9.2, 4))
for ax in axes:
    ax.set(xlim=(-4.8, 4.8), ylim=(4, 10.5))  # the far half of the loop
    ax.lines[0].set_markersize(5)
    ax.lines[0].set_label("true landmark")
views.legend_below(fig)
views.show(
    fig,
    f"{100 * kept[3].inside:.0f} % of the ellipses on the left contain their landmarks; on the "
    f"right the ellipses are tiny, and {100 * dropped[3].inside:.0f} % contain them.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-drop"
# The figure shows the far half of one of these laps. On the left, the 95 % ellipses contain the black
# points; on the right, the ellipses are tiny and do not contain them. The innovation of a landmark is
# small, and the update shrinks $P$ as if the measurement were independent information. But the same
# robot added the landmark *with its own error*. **The filter counts the same information twice.** (A
# reader who takes the reports of two newspapers for independent evidence makes the same mistake if both reports come from one news agency.)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Determinant and volume of a covariance
#
# The **determinant and volume of a covariance** are related: the area (in $n$ dimensions the volume) of
# a confidence ellipse is proportional to $\sqrt{\det P}$. While the robot drives without measurements,
# the determinant of its covariance grows. How do the determinants of the landmarks, and of the vectors
# between them, change meanwhile? The vector from landmark $i$ to landmark $j$ has the covariance
#
# $$\Delta p_{ij} = p_j - p_i, \qquad \Delta P_{ij} = P_{ii} - P_{ij} - P_{ji} + P_{jj}. \tag{07.10}$$

# %% [markdown] slideshow={"slide_type": "notes"} name="note-determinant-and-volume-of-a-covariance"
# *For the lecturer:* Students conclude that a map with shrinking ellipses is good. Remind them of the
# previous section: the ellipses of the overconfident filter shrink, too.

# %% slideshow={"slide_type": "fragment"}
ask(
    "07-grow",
    "We draw the areas of three ellipses over the loop: the robot's, that of landmark 5, that of the "
    "vector from 5 to 6. **Which of them can grow?**",
    {
        "all three, as long as the robot drives without measurements": "the landmarks do not "
        "move, and (07.5) does not change the map's blocks.",
        "the robot's only": "an update can only reduce a covariance, and the prediction adds "
        "process noise only to the robot's covariance.",
        "the robot's and the landmark's": "which step of the filter could increase the "
        "covariance of a landmark? Neither of them adds anything to its block.",
    },
    right="the robot's only",
)


# %% slideshow={"slide_type": "fragment"} answers="07-grow" tags=["folded"]
def parts(P):
    """The blocks P_ij of a map, (N, N, 2, 2), and the ΔP_ij of (07.10) likewise."""
    n = len(P) // 2 - 1
    blocks = P[3:, 3:].reshape(n, 2, n, 2).transpose(0, 2, 1, 3)
    own = blocks[np.arange(n), np.arange(n)]
    return blocks, own[:, None] + own[None] - blocks - blocks.swapaxes(0, 1)


def area(covariance):
    """Area of the 95 % ellipse [m²]."""
    return np.pi * 5.99 * np.sqrt(max(np.linalg.det(covariance), 0))


# %% slideshow={"slide_type": "subslide"} answers="07-grow" tags=["folded"]
sizes = {"robot": [], "landmark 5": [], "vector from 5 to 6": []}
for P_k in P_at:
    blocks, relative = parts(P_k)
    known = len(blocks) > 6
    sizes["robot"].append(area(P_k[:2, :2]))
    sizes["landmark 5"].append(area(blocks[5, 5]) if known else np.nan)
    sizes["vector from 5 to 6"].append(area(relative[5, 6]) if known else np.nan)
fig, ax = views.curves(np.arange(97), sizes, "time [s]", "area, 95 % ellipse [m²]", size=(8, 4))
for line, meaning in zip(ax.lines, ("robot", "landmark", "corrected"), strict=True):
    line.set_color(views.COLOURS[meaning])
views.legend(ax)
ax.set(yscale="log", ylim=(1e-3, 10))
views.show(
    fig,
    f"The robot's area rises to {max(sizes['robot']):.1f} square metres, falls at the loop "
    "closure and rises again; the areas of the landmark and of the vector only fall.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-grow"
# The robot's area rises until the loop closure, falls steeply, and rises again. The areas of landmark 5
# and of the vector from 5 to 6 only fall. The vector has a smaller uncertainty than the landmark,
# because the common error of the two landmarks cancels in their difference.
#
# In general, an update subtracts a positive semidefinite matrix from the map's block of $P$:
#
# $$P_{\mathrm{map}} \leftarrow P_{\mathrm{map}} - B B^{\mathsf T}, \qquad B = K_{\mathrm{map}}\,
# S^{1/2}. \tag{07.11}$$
#
# So no variance and no determinant of the map ever grows (*Deeper* checks this at every step of the
# lap). This holds for *any* Jacobians. For single landmarks it also holds in the filter without cross
# blocks, which was overconfident. **So a covariance that never grows does not prove that the filter is
# consistent.**

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** `P_end` is the covariance of the map at the end of the lap. Compute the covariance of
# the vector from landmark 5 to landmark 6 by (07.10).

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
P_end = P_at[-1][3:, 3:]  # landmark i has the rows and columns 2i and 2i + 1
P_vector = ...
compare(P_vector, parts(P_at[-1])[1][5, 6])

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# P_end = P_at[-1][3:, 3:]  # landmark i has the rows and columns 2i and 2i + 1
# P_vector = P_end[10:12, 10:12] - P_end[10:12, 12:14] - P_end[12:14, 10:12] + P_end[12:14, 12:14]
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## The limit of the map's covariance
#
# No variance of the map grows. Do all of them converge to zero? Suppose that a robot drives for ever.
# Its initial position has a standard deviation of 20 cm in x and in y. The robot has a perfect compass,
# so its heading is exact.

# %% slideshow={"slide_type": "fragment"}
ask(
    "07-limit",
    "**What is the final standard deviation of a landmark in centimetres, in x and in y each?**",
    right=20,
    tolerance=2,
    unit="cm",
    reason="the best possible value is that of the start: no measurement determines the "
    "position of the start, and every landmark depends on this position.",
    wrong={
        0: "the vectors between the landmarks become nearly exact, but the position of the "
        "whole map does not.",
        10: "averaging reduces independent noise, but the error of the start is the same in "
        "every measurement.",
        28: "this is the value for both axes together; the question is about each axis.",
    },
)

# %% slideshow={"slide_type": "fragment"} answers="07-limit" tags=["folded"]
long_run = cache(landmark_correlations.long_run)  # of (turn_noise, start_sigma)
_, own, vector, compass_map = long_run(0.0, 0.2)
exact_start = long_run(0.0, 0.0)[1]


# %% slideshow={"slide_type": "subslide"} answers="07-limit" tags=["folded"]
def for_ever(turn_noise, start_sigma):
    """σ of a landmark and of a vector over many laps, with a compass and with noisy turns."""
    found = {"compass": long_run(0.0, start_sigma)}
    if turn_noise:
        found["no compass"] = long_run(turn_noise, start_sigma)
    fig, ax = views.chart("laps", "σ of x and of y [m]", size=(8, 4))
    for (name, (laps_, *both, _)), line in zip(found.items(), ("-", "--"), strict=False):
        for what, sigma in zip(("landmark", "vector"), both, strict=True):
            colour = views.COLOURS["landmark" if what == "landmark" else "corrected"]
            ax.plot(laps_, sigma, line, color=colour, label=f"{what}, {name}")
    ax.axhline(
        start_sigma, color=views.COLOURS["limit"], ls="dashdot", lw=1, label="σ of the start"
    )
    ax.set_ylim(0, 2.4 * max(start_sigma, 0.2))
    views.legend(ax, ncols=2, loc="upper center")
    return fig


views.explore(
    for_ever,
    lambda turn_noise, start_sigma: (
        f"σ of the start is {start_sigma:.2f} m. With a compass σ of a landmark comes close to "
        "this value, and σ of the vector to the next landmark falls further; with a turn noise "
        f"of {turn_noise:.3f} rad/s both remain larger."
    ),
    turn_noise=(0.0, 0.03, 0.012),
    start_sigma=(0.0, 0.4, 0.2),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-limit"
# The grey line, σ of the start, is a *lower bound*. With a compass, σ of the landmark comes close to
# this bound: after twelve laps it is {= own[-1]:.3f =} m per axis. But σ does not reach the bound. Set
# σ of the start to 0: the bound is 0, and σ of the landmark is {= exact_start[-1]:.3f =} m, because
# only the first measurements and the noisy odometry connect the start with the map. The σ of the vector
# to the next landmark, {= vector[-1]:.3f =} m, keeps falling.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### One common error
#
# In the limit, and with exact headings, all landmarks have the same error. The map becomes *fully
# correlated*, and its vectors become exact:
#
# $$P_{ij} \to P_{\text{start}} + C \text{ for all } i, j, \qquad \Delta P_{ij} \to 0. \tag{07.12}$$
#
# $C \ge 0$ is the covariance of the map relative to the start that remains because of the noise of
# odometry and sensor. $C$ is zero only if odometry or sensor has no noise, so $P_{\text{start}}$ is a
# lower bound (Dissanayake and others 2001).

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="07-limit"
*_, turned_map = long_run(0.012, 0.2)
for name, mak in (("compass", compass_map), ("no compass", turned_map)):
    shifts, turn = landmark_correlations.rigid_share(mak.P[3:, 3:], mak.landmarks())
    rho = correlation(mak.P)[9, 11]  # x of one landmark and x of the next
    print(f"{name}: correlation of two neighbours {rho:.3f}; of the map's variance")
    shares = 100 * np.array([shifts, turn, 1 - shifts - turn])
    print("  {:.1f} % translation, {:.1f} % rotation, {:.1f} % deformation".format(*shares))

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-limit"
# Without a compass one more quantity stays unknown: **the rotation of the map relative to the start**.
# The heading at the start is exact here, by definition. But the robot had turned with some noise before
# it added most of its landmarks, and no later measurement can distinguish this heading error from a
# rotation of the whole map. The shape of the map nevertheless becomes precise: almost the whole
# remaining error is translation and rotation.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The classic proof assumes a linear system, in which headings are known. Ask which
# quantities of a map can become exact without a compass. (Answer: distances and angles.)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Computational complexity O(N²)
#
# A map of $N$ landmarks has a covariance of
#
# $$(3 + 2N)^2 \text{ numbers,} \tag{07.13}$$
#
# and each update changes all of them. So EKF-SLAM has a **computational complexity O(N²)** per
# measurement: for large $N$, the number of operations and the memory grow with $N^2$.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-computational-complexity-o-n2"
# *For the lecturer:* Ask for the memory of $P$ with 1600 landmarks. (82 MB.) If time is short, show the poll
# and the figure only.

# %% slideshow={"slide_type": "fragment"}
ask(
    "07-price",
    "The number of landmarks in a large map doubles. **By what factor does the number of "
    "entries of P that one update changes increase?**",
    right=4,
    tolerance=0.4,
    reason="P has twice as many rows, each of them twice as long, and every number changes.",
    wrong={
        2: "this is right for the state x, but P has a row and a column for each entry of x.",
        8: "the inversion of P would cost N³ operations, but the update inverts S, which has "
        "the size of the measurement.",
        1: "this would be right if the landmarks were uncorrelated, as in lesson 05.",
    },
)


# %% slideshow={"slide_type": "subslide"} answers="07-price" tags=["folded"]
def price(N, updates=40):
    """Bytes of P, and seconds of one step with four landmarks in range (the best of some)."""
    rng, R = np.random.default_rng(N), np.diag([0.1, 0.03]) ** 2
    mak = MAK([0.3, -0.2, 0.4], np.diag([0.02, 0.03, 0.01]), N)
    mak.add(range(N), np.column_stack([rng.uniform(1, 20, N), rng.uniform(-3, 3, N)]), R)
    took = []
    for _ in range(updates):
        began = perf_counter()
        mak.predict(mak.pose, 1e-6 * np.eye(3))
        mak.update(range(4), models.h(mak.pose, mak.landmarks()[:4]), R)
        took.append(perf_counter() - began)
    return mak.P.nbytes, min(took)


N_tried = np.array([50, 100, 200, 400, 800, 1600])
memory, seconds = np.array([price(N) for N in N_tried]).T
slope, _ = np.polyfit(np.log(N_tried[-3:]), np.log(seconds[-3:]), 1)
assert (memory == 8 * (3 + 2 * N_tried) ** 2).all()  # (07.13), eight bytes a number

# %% slideshow={"slide_type": "fragment"} answers="07-price" tags=["folded"]
fig, _ = views.growth(
    N_tried,
    {"time [ms]": 1e3 * seconds, "memory [MB]": memory / 1e6},
    {"grows as N²": 1e3 * seconds[-1] * (N_tried / N_tried[-1]) ** 2},
    "number N of landmarks",
    "time of a step [ms], memory of P [MB]",
    size=(8, 4),
)
views.show(
    fig, f"Memory is parallel to the line N²; for large N, time grows as N to the {slope:.1f}."
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-price"
# On these logarithmic axes a power of $N$ is a straight line, and its slope is the exponent. The memory
# follows (07.13). The computing time is nearly constant at first, because function calls take more time
# than the arithmetic. From 400 landmarks on it grows as $N^{ {= slope:.1f =} }$ on the machine that ran
# this. (The number of operations grows as $N^2$. The measured exponent also depends on how much of $P$
# fits into the processor's cache.) As long as every update changes every number of $P$, the cost cannot
# be lower than $O(N^2)$. Every faster method has to change fewer numbers.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## The compressed EKF
#
# Suppose that the robot works in one corner of its map. Is it necessary to update the distant landmarks
# at every measurement? J. Guivant and E. Nebot postpone these updates. Let region $a$ contain the robot
# and the landmarks around it, and region $b$ the rest. As long as the robot measures only $a$, three
# small quantities contain all information that the later update of $b$ needs: a product $\varphi$ (with
# $\varphi \leftarrow A\varphi$ at a prediction and $\varphi \leftarrow (I - KH)\varphi$ at an update),
# and two sums $\psi$ and $\vartheta$:
#
# $$P_{ab} \leftarrow \varphi P_{ab}, \qquad P_{bb} \leftarrow P_{bb} - P_{ba}\, \psi\, P_{ab}, \qquad
# \hat x_b \leftarrow \hat x_b + P_{ba}\, \vartheta. \tag{07.14}$$
#
# This *global update* is computed once, when the robot leaves the region.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-the-compressed-ekf"
# *For the lecturer:* If time is short, show the poll and the printed difference, and skip (07.14).

# %% slideshow={"slide_type": "subslide"}
ask(
    "07-delay",
    "The **compressed EKF** updates the far landmarks only once for many measurements. **How much "
    "accuracy does the delay cost?**",
    {
        "none": "as long as the robot measures only region a, P_ab is only multiplied by "
        "matrices from the left, and their product can be applied later in one step.",
        "a little, because the far landmarks are corrected too late": "nothing that happens in region "
        "a depends on the estimates of region b.",
        "much: their correlations are dropped": "they are not dropped; they are multiplied by φ later.",
    },
    right="none",
)

# %% slideshow={"slide_type": "fragment"} answers="07-delay"
# one lap by EKF-SLAM; from then on, the full filter and a compressed copy
wide = LandmarkRun(Loop(landmarks=40, steps=168), np.random.default_rng(7))
readings, slam = list(wide), EkfSlam(wide.robot, wide.sensor)
for reading in readings[:85]:  # the first lap makes the map
    slam.step(reading)
full, compressed = slam.filter, CompressedEKF(deepcopy(slam.filter))


def predict_and_update(filter, pose, reading):
    """One prediction and update of either filter."""
    Q, seen = Q_arc(pose, reading.odometry, wide.robot), reading.observations
    filter.predict(compose(pose, reading.odometry), Q)
    filter.update(seen.ids.tolist(), seen.z, ekf_runs.R(wide))


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="07-delay"
# the second lap, a quarter at a time, by both filters
for start in range(85, 169, 21):
    quarter = readings[start : start + 21]
    around = sorted({i for reading in quarter for i in reading.observations.ids.tolist()})
    compressed.focus(around)
    for reading in quarter:
        predict_and_update(full, full.pose, reading)
        predict_and_update(compressed, compressed.local.pose, reading)
    print(f"{len(quarter)} steps with {len(around)} of {len(full.ids)} landmarks")
compressed.settle()
off = max(abs(full.x - compressed.whole.x).max(), abs(full.P - compressed.whole.P).max())
print(f"largest difference of any number in x and P: {off:.9f}")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-delay"
# The delay costs no accuracy: both filters have the same result. The **compressed EKF** (CEKF) drops no
# correlation. It only postpones the update, and updates the whole map once per region instead of once
# per step. (The exercise has a simpler task: how are the other landmarks corrected if only the *result*
# in the region is known?)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## Submaps
#
# Another method divides the map into **submaps** (local maps), and begins a new one at intervals. Each
# submap starts at (0, 0, 0) with an exact pose, so its errors are uncorrelated with those of earlier
# maps. **Submap joining** starts with a block-diagonal $P$, as in our example. Two submaps share the
# pose where one ends and the next begins. They also share the landmarks that were measured in both
# submaps; the two estimates of such a landmark must agree.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-submaps"
# *For the lecturer:* Ask why the first pose of a submap has no error. (It is the origin of the submap, by
# definition.)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# one large filter, and submaps of 23 steps that are joined
trip = LandmarkRun(LAP, np.random.default_rng(7))
readings, one, joined = list(trip), EkfSlam(trip.robot, trip.sensor), JoinedMap()
for start in range(0, len(readings), 23):
    local = EkfSlam(trip.robot, trip.sensor)
    for reading in readings[start : start + 23]:
        one.step(reading)
        local.step(reading)
    joined.join(local.filter)
    print(f"{len(local.filter.ids)} landmarks in this submap, {len(joined.ids)} in the whole")

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
apart = one.filter.landmarks() - joined.landmarks()[[joined.ids.index(i) for i in one.filter.ids]]
apart = 100 * np.sqrt(np.mean(np.sum(apart**2, axis=1)))
sigma_map = 100 * np.sqrt(np.mean(np.trace(one.filter.blocks()[2], axis1=1, axis2=2)))
print(f"rms difference from one large filter {apart:.1f} cm; its own σ (√trace) {sigma_map:.1f} cm")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The results differ slightly, because the Jacobians are evaluated at other estimates. Here the
# difference is {= 100 * apart / sigma_map:.0f =} % of the large filter's σ. With submaps, the time of
# an update grows with the squared size of a *small* map. Joining takes time proportional to $N^2$, but
# only once for each submap.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Conditional independence and sparse information
#
# Suppose that the state contains *all* poses. Then no two landmarks are directly linked: each
# measurement links one pose with one landmark. The information matrix $\Lambda = P^{-1}$ shows this:
#
# $$\Lambda_{ij} = 0 \quad\Leftrightarrow\quad i \text{ and } j \text{ are independent, given all other
# variables.} \tag{07.15}$$
#
# This is **conditional independence** of Gaussian variables. The **marginal** distribution of the
# landmarks and the last pose results from integrating over the other poses. EKF-SLAM computes this
# marginal at every step. Here is a corridor with three poses and two landmarks:

# %% [markdown] slideshow={"slide_type": "notes"} name="note-conditional-independence-and-sparse-info"
# *For the lecturer:* Students read a zero of $\Lambda$ as "uncorrelated". Point at the printed correlation of
# $p_1$ and $p_2$, and then at their zero in $\Lambda$.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
links = [(0, 1), (1, 2), (0, 3), (1, 3), (1, 4), (2, 4)]  # x₀ x₁ x₂ p₁ p₂: odometry, measurements
Lambda = np.diag([100.0, 0, 0, 0, 0])  # the start, σ = 0.1 m
for i, j in links:
    row = np.eye(5)[j] - np.eye(5)[i]  # the Jacobian of x_j − x_i
    Lambda += 100 * np.outer(row, row)  # also with σ = 0.1 m
P_all = np.linalg.inv(Lambda)
print(Lambda.astype(int))
print(
    f"zeros of P: {np.sum(np.isclose(P_all, 0))}, correlation of p₁ and p₂: {correlation(P_all)[3, 4]:.2f}"
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** Marginalise out the first two poses: compute the information matrix of $x_2$, $p_1$ and
# $p_2$ alone. (In which of the two matrices, $P$ or $\Lambda$, may rows and columns simply be deleted?)

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
Lambda_marginal = ...  # (3, 3), from P_all
schur = Lambda[2:, :2] @ np.linalg.inv(Lambda[:2, :2]) @ Lambda[:2, 2:]
compare(Lambda_marginal, Lambda[2:, 2:] - schur)

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# Lambda_marginal = np.linalg.inv(P_all[2:, 2:])
# schur = Lambda[2:, :2] @ np.linalg.inv(Lambda[:2, :2]) @ Lambda[:2, 2:]
# ```
#
# Rows and columns may simply be deleted in $P$. For $\Lambda$ we need a Schur complement, and `compare`
# checks the result with it. No entry of the marginal $\Lambda$ is zero.
#
# </details>

# %% [markdown] slideshow={"slide_type": "fragment"}
# $P$ has no zeros. $\Lambda$ has a zero for every pair that neither odometry nor a measurement linked:
# **sparse information** (a sparse information matrix). Marginalising out the poses, as EKF-SLAM does,
# fills $\Lambda$ again. Several methods use the sparse matrix. Graph SLAM (lesson 15) keeps all poses
# and solves with the sparse $\Lambda$, without computing the dense $P$; sparse extended information
# filters approximate $\Lambda$ by a sparse matrix. And given the *whole* trajectory, the landmarks are
# conditionally independent, as in lesson 05's mapping: FastSLAM (lesson 11) samples trajectories and
# needs only $N$ small filters for each.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Observability and the EKF's inconsistency
#
# Suppose that we keep all correlations. Does the filter stay consistent? It evaluates its Jacobians at
# its estimates, and these change. So we ask which components of the first state all measurements of a
# run *together* determine. The **observability** matrix transforms each $H_k$ back to the start by the
# motions before it:
#
# $$O = \begin{bmatrix} H_1 A_1 \\ H_2 A_2 A_1 \\ \vdots \\ H_k A_k \cdots A_1 \end{bmatrix}
# \tag{07.16}$$
#
# With three landmarks the state has nine numbers. If robot and landmarks are shifted together along
# x or y, or rotated together, every measurement stays the same: the *gauge freedom* of lesson 06. These
# three directions are unobservable, so the rank of $O$ must be 6.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-observability-and-the-ekf-s-inconsistenc"
# *For the lecturer:* The answer 9 comes from students who think that enough data determine everything. Tick
# the box only after the class has stated what the three red values should be.

# %% slideshow={"slide_type": "subslide"}
ask(
    "07-rank",
    "**What is the rank of $O$, computed from the Jacobians that an ordinary EKF uses on such a run?**",
    {
        "6, as it must be": "it would be if all Jacobians were evaluated at one and the same state.",
        "7": "this is one direction too many: the filter gains spurious information about the "
        "rotation of the whole scene.",
        "9": "even all measurements together never determine a shift of the whole scene.",
    },
    right="7",
)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="07-rank"
# the rank of O, and how far O maps the three unobservable directions from zero
for name, first_estimates in (("standard", False), ("first estimates", True)):
    stack, state = observability.observability_matrix(first_estimates)
    gained = np.linalg.norm(stack @ observability.rigid_scene_motions(state), axis=0) + 0
    text = ", ".join(
        f"{way} {size:.3f}" for way, size in zip(("x", "y", "rotation"), gained, strict=True)
    )
    print(f"{name}: rank {np.linalg.matrix_rank(stack)} of {len(state)}; lengths of O G: {text}")


# %% slideshow={"slide_type": "subslide"} answers="07-rank" tags=["folded"]
def singular_values(noise, first_estimates):
    """Singular values of (07.16): how well each of nine directions is determined."""
    stack, _ = observability.observability_matrix(first_estimates, noise)
    values, rank = np.linalg.svd(stack)[1], np.linalg.matrix_rank(stack)
    title = f"rank {rank}"
    fig, ax = views.chart("direction", "singular value of O", title, size=(8, 4))
    colours = [views.COLOURS["corrected"]] * 6 + [views.COLOURS["naive"]] * 3
    ax.bar(np.arange(1, 10), np.maximum(values, 1e-17), color=colours, bottom=1e-18)
    ax.set(yscale="log", ylim=(1e-17, 1e3), xticks=range(1, 10))
    return fig


views.explore(
    singular_values,
    lambda noise, first_estimates: (
        f"Singular values for {noise:.1f} times the usual noise, Jacobians at "
        f"{'first' if first_estimates else 'current'} estimates: six bars are high; of the three "
        f"that must be zero, {'none' if first_estimates or not noise else 'one'} is large."
    ),
    noise=(0.0, 3.0, 1.0),
    first_estimates=False,
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="07-rank"
# All three red singular values should be zero, but one of them is not. (The other two are rounding
# errors.) The rank is 7: the filter gains spurious information about the *rotation* of the whole scene,
# which was never measured. The filter evaluates the Jacobians of one landmark at a different estimate
# each time, and their unobservable directions do not agree (derived under *Deeper*). Without noise, the
# rank is correct.
#
# **First-estimates Jacobians** (G. Huang, A. Mourikis and S. Roumeliotis) evaluate every $H$ at the
# first estimate of the landmark, and $A$ between predicted poses. This linearisation point is a little
# less accurate, but it is the same every time. Tick the box: the rank is now 6.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** `O_standard` is (07.16) for the standard EKF, and `G` has the three unobservable
# directions as columns: x, y, rotation. Compute how far $O$ maps each of them away from zero.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
O_standard, state = observability.observability_matrix(False)
G = observability.rigid_scene_motions(state)
lengths = ...  # the length of each column of O G, three numbers
compare(lengths, np.sqrt(np.diag(G.T @ O_standard.T @ O_standard @ G).clip(0)))

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# O_standard, state = observability.observability_matrix(False)
# G = observability.rigid_scene_motions(state)
# lengths = np.linalg.norm(O_standard @ G, axis=0)
# ```
#
# Only the length for the rotation is not zero.
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Consistency in simulation
#
# Three filters processed the same readings: *ideal*, with all Jacobians at the truth, which is known
# only in a simulation; *first estimates*; and *standard*. The runs, of seven laps each, were made
# beforehand, with good and with noisy odometry (`python -m course.studies.consistency`).

# %% [markdown] slideshow={"slide_type": "notes"} name="note-consistency-in-simulation"
# *For the lecturer:* Do not read the table row by row. Compare the two rows "standard", and ask why even the
# ideal filter leaves its χ² interval.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# the consistency of each filter in 400 simulated runs
heads = "odometry", "filter", "NEES, mean", "median run", "steps above", "steps below", "map, rms"
lines = [f"| {' | '.join(heads)} |", "|---" * len(heads) + "|"]
for odometry, table in (("good", "consistency"), ("noisy", "consistency-noisy")):
    study = stored(table)
    for name, row in study["filters"].items():
        lines.append(
            f"| {odometry} | {name} | {row['nees']:.2f} ± {row['nees_standard_error']:.2f} "
            f"| {row['nees_median_run']:.2f} | {100 * row['steps_above_band']:.0f} % "
            f"| {100 * row['steps_below_band']:.0f} % | {100 * row['landmark_rmse_m']:.1f} cm |"
        )
noisy, good = study["filters"], stored("consistency")["filters"]
Markdown("\n".join(lines))

# %% [markdown] slideshow={"slide_type": "fragment"}
# (The number after ± is the standard error of the mean.) For a consistent filter, the average over
# {= study["seeds"][1] + 1 =} runs at a single step lies between {= study["band_95"][0]:.2f =} and
# {= study["band_95"][1]:.2f =} with a probability of 95 %. With good odometry the three filters are close
# together; the ideal one is even a little conservative. With noisy odometry the standard filter has a
# mean NEES of {= noisy["standard"]["nees"]:.1f =} (median run
# {= noisy["standard"]["nees_median_run"]:.1f =}) and the largest map errors. With first estimates the map
# is nearly as accurate as the ideal filter's, but NEES is above the interval at more steps. Even the ideal
# filter leaves the interval at some steps, because it has a linearisation error as well.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## EKF-SLAM on a real log: Victoria Park
#
# A car with a laser scanner drove through Victoria Park in Sydney (E. Nebot and J. Guivant). A text
# file among the GTSAM examples contains its odometry and measured trees, with known data association
# and covariances, but no ground truth. Our reference is the *batch optimum*: least squares over all
# poses and trees together, relinearised until it converges (lesson 15). From the map of either filter,
# least squares converges to the same optimum. This optimum has errors as well, but a filter without
# linearisation error would end *at* it, because both use the same data and covariances. The cell below
# processes the first 600 lines of the file; the whole log was processed beforehand.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-ekf-slam-on-a-real-log-victoria-park"
# *For the lecturer:* Point out that the batch optimum is not the ground truth: the figures compare estimates
# from the same data. Ask where a filter without linearisation error would end.

# %% slideshow={"slide_type": "fragment"}
# EKF-SLAM on the beginning of the log
park = victoria_park.stored()
poses, measurements, trees = park["counts"].astype(int)
try:
    log = gtsam_text.load(sources.recording("victoria-park"))[:600]
    live = victoria_park.run(victoria_park.EkfSlam(), log)
    here = live.poses[:: victoria_park.EVERY]
    differ = np.hypot(*(here - park["standard"][: len(here)])[:, :2].T).max()
    print(
        f"{len(live.poses)} poses, {len(live.filter.ids)} trees; from the stored run: {differ:.2f} m"
    )
except sources.SourceError as missing:
    print(f"{missing}.\nThe stored run is shown below.")

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
fig, axes = views.panels(victoria_park.FILTERS, size=(9.2, 5))
for ax, name in zip(axes, victoria_park.FILTERS, strict=True):
    ellipses = Ellipses("landmark", park[f"{name} trees"], park[f"{name} trees P"])
    layers = {
        "batch optimum: trajectory": Poses("truth", park["batch"]),
        "batch optimum: trees": Points("truth", park["batch trees"]),
        "EKF-SLAM: trees, 95 %": ellipses,
    }
    for label, layer in layers.items():
        cross = {"marker": "+", "mew": 1, "markersize": 5} if label.endswith("m: trees") else {}
        views.draw(ax, layer, label=label, **cross)
views.legend_below(fig)
difference = {name: park[f"{name} trees"] - park["batch trees"] for name in victoria_park.FILTERS}
tree_off = {name: np.hypot(*each.T) for name, each in difference.items()}
inside = {
    name: np.sum(nees(each, park[f"{name} trees P"]) < 5.99) for name, each in difference.items()
}
as_complex = [(p - p.mean(0)) @ [1, 1j] for p in (park["batch trees"], park["standard trees"])]
rotation = np.degrees(np.angle(np.vdot(*as_complex)))  # of the best fit to the batch optimum
views.show(
    fig,
    f"On the left, the trees of the standard filter are up to {tree_off['standard'].max():.0f} m "
    "from those of the batch optimum, with tiny ellipses; on the right, with first estimates, "
    f"{inside['first estimates']} of {trees} ellipses contain them.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# On the left the map of the standard EKF is *rotated* relative to the batch optimum, by
# {= abs(rotation):.0f =}° clockwise. Its 95 % ellipses are far too small: the batch position
# of the tree, which is {= np.median(tree_off["standard"]):.0f =} m away (median), lies in only
# {= inside["standard"] =} of {= trees =}. On the right, with first-estimates Jacobians,
# the batch position is {= np.median(tree_off["first estimates"]):.2f =} m away (median), and
# {= inside["first estimates"] =} ellipses contain it. The noise covariances of the file are hardly the
# cause: with them, χ² of the batch optimum is {= np.divide(*park["chi2"]):.2f =} per degree of freedom.

# %% slideshow={"slide_type": "subslide"} tags=["folded", "nbval-check-output"]
checks = park["checkpoints"]  # pose, σ of the batch
# distance, σ, NEES by own P and by the batch's P
standard, first = (park[f"{name} checkpoints"].T for name in victoria_park.FILTERS)
worst = standard[0].argmax()
fig, ax = views.chart("pose of the log", "distance from the batch optimum, σ [m]", size=(8.5, 4.2))
for name, values, colour in (
    ("standard", standard, "naive"),
    ("first estimates", first, "corrected"),
):
    ax.plot(checks[:, 0], values[0], color=views.COLOURS[colour], lw=2, label=f"{name}: distance")
    ax.plot(
        checks[:, 0],
        values[1],
        color=views.COLOURS[colour],
        ls=":",
        lw=2,
        label=f"{name}: σ (√trace)",
    )
ax.set(yscale="log", ylim=(0.01, 100))
views.legend(ax, ncols=2, loc="upper left")
views.show(
    fig,
    f"The standard filter is up to {standard[0].max():.0f} m from the batch optimum, and at "
    f"{np.sum(standard[0] > standard[1])} of {len(checks)} poses this distance exceeds its σ; "
    "with first estimates the distance stays below σ.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# At {= len(checks) =} poses along the log we compared each filter with the batch optimum of the data
# *up to that pose*. The largest distance of the standard EKF is {= standard[0].max():.0f =} m, and its
# σ is {= standard[1][worst]:.1f =} m there. At the last pose the distance is {= standard[0][-1]:.1f =}
# m and σ is {= standard[1][-1]:.2f =} m (σ of the batch optimum is {= checks[-1, 1]:.2f =} m). Now we
# compute NEES with the batch optimum in place of the truth. Its median is
# {= np.median(standard[2]):.0f =} with the filter's own $P$ and {= np.median(standard[3]):.0f =} with
# the batch covariance; a filter without linearisation error would have 0, not 3. With first estimates
# the median is {= np.median(first[2]):.2f =}.
#
# The two filters differ only in the linearisation points of their Jacobians. With first estimates the
# filter stays close to the batch optimum. The standard filter is **inconsistent**: its distance from
# this optimum alone is about {= np.sqrt(np.median(standard[2]) / 3):.0f =} times as large as the whole
# error that its $P$ predicts.

# %% slideshow={"slide_type": "subslide"} tags=["folded", "nbval-check-output"]
heads = "method", "last pose off [m]", "in σ", "median NEES, own P", "by batch P", "CPU [s]"
lines = [f"| {' | '.join(heads)} |", "|---" * len(heads) + "|"]
for name in victoria_park.METHODS:
    off, sigma, _, _ = park[f"{name} checkpoints"][-1]
    own, by_batch = np.median(park[f"{name} checkpoints"][:, 2:], axis=0)
    lines.append(
        f"| {name} | {off:.2f} | {off / sigma:.1f} | {own:.3g} | {by_batch:.3g} "
        f"| {park[f'{name} seconds']:.1f} |"
    )
Markdown("\n".join(lines))

# %% [markdown] slideshow={"slide_type": "fragment"}
# Five methods of the course processed the same measurements; the table compares their poses with the
# batch optimum. Only the filter with first estimates ends within its σ of this optimum. The standard EKF ends
# {= standard[0][-1] / standard[1][-1]:.0f =} σ away, and the compressed EKF has exactly the same errors,
# because it computes the same filter. Joining submaps of {= victoria_park.SUBMAP =} poses ends
# {= park["submaps checkpoints"][-1, 0] / park["submaps checkpoints"][-1, 1]:.0f =} σ away: a join is
# linearised at the pose that is known then, and never again. FastSLAM with
# {= victoria_park.PARTICLES =} particles fails: the odometry alone moves its particles, resampling
# leaves copies of few of them, and their spread (σ = {= 100 * park["FastSLAM checkpoints"][-1, 1]:.1f =}
# cm) is far smaller than their error of {= park["FastSLAM checkpoints"][-1, 0]:.0f =} m.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Literature
#
# - **One state, all correlations:** R. Smith, M. Self and P. Cheeseman, "Estimating Uncertain Spatial
#   Relationships in Robotics", in *Autonomous Robot Vehicles*, Springer, 1990.
# - **The limit:** M. W. M. G. Dissanayake, P. Newman, S. Clark, H. F. Durrant-Whyte and M. Csorba, "A
#   Solution to the Simultaneous Localization and Map Building (SLAM) Problem", *IEEE Transactions on
#   Robotics and Automation* 17(3), 2001.
# - **Compressed filter, Victoria Park:** J. E. Guivant and E. M. Nebot, in the same issue.
# - **Inconsistency:** S. J. Julier and J. K. Uhlmann, "A Counter Example to the Theory of
#   Simultaneous Localization and Map Building", *ICRA*, 2001. **First estimates:** G. P. Huang, A. I.
#   Mourikis and S. I. Roumeliotis, *International Journal of Robotics Research* 29(5), 2010.
# - **Read next:** H. Durrant-Whyte and T. Bailey, "Simultaneous Localization and Mapping: Part I",
#   *IEEE Robotics & Automation Magazine* 13(2), 2006.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-literature"
# *For the lecturer:* A student who asks for the full proof of the rank finds it in the paper of Huang,
# Mourikis and Roumeliotis; *Deeper* shows the idea for one landmark.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## What you can do now
#
# | what is dropped or postponed | what happens |
# |---|---|
# | $P_{\mathrm ri}$ and $P_{ij}$ | the same information is counted many times: NEES far above its χ² interval |
# | the update of far landmarks, until the robot leaves | the same result: compressed EKF |
# | correlations between submaps (there are none) | a difference of a fraction of σ |
# | $P$ itself: all poses and sparse information instead | no information is lost: graph SLAM, lesson 15 |
# | correlations given the trajectory (conditional independence) | no information is lost for each trajectory: FastSLAM, lesson 11 |
# | the change of the Jacobians (first estimates) | NEES close to that of the ideal filter |
#
# **What comes next:** here the data association was known. [Lesson 08](08_landmarks_from_scans.ipynb)
# extracts landmarks from scans and associates them with the map.
#
# **Exercise:**
# [07 · Correlations, consistency and cost of EKF-SLAM](../exercises/ex07_correlations.ipynb). You update
# landmarks that were not measured, fuse correlated estimates, and estimate the size of a common error.
#
# The sections below this one are optional.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-what-you-can-do-now"
# *For the lecturer:* Cover the right column of the table and let the class fill it.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: no determinant of the map grows
#
# Let $M$ be some rows and columns of $P_{\mathrm{map}}$ before an update, and $M - B B^{\mathsf T}$
# after it, as in (07.11). The difference is a covariance, so $B$ can be written as $B = M^{1/2} C$, and
#
# $$\det(M - B B^{\mathsf T}) = \det M \cdot \det(I - C C^{\mathsf T}), \tag{07.17}$$
#
# where the eigenvalues of $I - C C^{\mathsf T}$ lie between 0 and 1: they are at least 0 since the
# difference is a covariance, and at most 1 since $C C^{\mathsf T}$ is positive semidefinite. So their
# product also lies between 0 and 1. A prediction does not change $M$, by (07.5). For the vectors of
# (07.10) the same holds with $D M D^{\mathsf T}$ and $D B$. We check this at every step of the lap from
# the tenth on, for every landmark and every pair:

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-no-determinant-of-the-map-grows"
# *For the lecturer:* Students of linear algebra can find the bounds of the eigenvalues of $I - C C^{\mathsf
# T}$ themselves before you show them.

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

# %% [markdown] slideshow={"slide_type": "fragment"}
# Only the robot's ratio is above 1. So determinant and volume of a covariance in the map never grow.
# The thesis concludes that "the map's certainty does not fall". This is always true for the covariance
# that the filter reports, so it does not prove that the map is correct.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: the unobservable directions, derived
#
# We shift or rotate the pose and one landmark together by a small amount. To first order the state
# changes along three directions, the columns of $G$ (the rotation is about the origin, as in (07.8)):
#
# $$G = \begin{bmatrix} 1 & 0 & -y \\ 0 & 1 & x \\ 0 & 0 & 1 \\ 1 & 0 & -p_y \\ 0 & 1 & p_x \end{bmatrix}
# \tag{07.18}$$
#
# Does a measurement change? To first order its change is $H G$:

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-the-unobservable-directions-deriv"
# *For the lecturer:* This section explains the inconsistency. In a graduate course it is worth more time than
# the compressed EKF.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
x, y, theta, p_x, p_y, a, b, e_x, e_y = sp.symbols("x y theta p_x p_y a b e_x e_y", real=True)
h = sp.Matrix([sp.sqrt((p_x - x) ** 2 + (p_y - y) ** 2), sp.atan2(p_y - y, p_x - x) - theta])
H = h.jacobian([x, y, theta, p_x, p_y])
directions = sp.Matrix([[1, 0, -y], [0, 1, x], [0, 0, 1], [1, 0, -p_y], [0, 1, p_x]])
sp.simplify(H * directions)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The measurement does not change in any of the three directions. Next, the robot moves by $(a, b)$. Its
# Jacobian $A$ should map the directions before the motion to those after it, $A G = G'$:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
A = sp.diag(sp.Matrix([[1, 0, -b], [0, 1, a], [0, 0, 1]]), sp.eye(2))
directions_after = directions.subs({x: x + a, y: y + b}, simultaneous=True)
sp.simplify(A * directions - directions_after)

# %% [markdown] slideshow={"slide_type": "fragment"}
# So each block of rows of (07.16) gives $H_k A_k \cdots A_1 G = H_k G_k = 0$, *if* all Jacobians are
# evaluated at one consistent set of points. Then the rank of $O$ is at most $n - 3$; in the run above
# it was exactly 6 of 9. These three directions are the gauge freedom. The EKF, however, evaluates $H$
# at a later estimate of the landmark, which differs by $(e_x, e_y)$ from the first estimate:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
H_later = H.subs({p_x: p_x + e_x, p_y: p_y + e_y}, simultaneous=True)
product = H_later * directions
at = {x: 0, y: 0, theta: 0, p_x: 3, p_y: 0}
print("translations:", sp.simplify(product[:, :2]).is_zero_matrix)
rotation = sp.simplify(product[:, 2].subs(at))
sp.Matrix.hstack(rotation, rotation.subs({e_x: 0, e_y: 0}))  # with both errors, and without

# %% [markdown] slideshow={"slide_type": "fragment"}
# The translations remain unobservable, because $H_{\mathrm p} = -H_{\mathrm r}$ in x and y at every
# linearisation point. The rotation does not remain unobservable: its column depends on $(e_x, e_y)$,
# and in this example it is zero only if both are zero. The EKF gains information about the rotation of
# the whole scene, which was never measured. First-estimates Jacobians set $(e_x, e_y)$ to zero by
# construction; for the motions, they evaluate $A$ between *predicted* poses, with the same effect.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
noisy_loop = Loop(steps=300, v_sigma=0.05, omega_sigma=0.05)
sample = [errors_of(seed, noisy_loop) for seed in range(2)]
for name in ("ideal", "first estimates", "standard"):
    variance = np.mean([run[name][1][-100:, 2, 2] for run in sample])
    print(f"{name}: σ of its heading {np.degrees(np.sqrt(variance)):.1f}° over the last 100 steps")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Two noisy runs of three and a half laps show the mechanism. From the same readings, the standard filter
# reports a smaller variance of its heading than the ideal filter: this is the spurious information.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: a relative map
#
# A further method stores the vectors (07.10) between neighbouring landmarks instead of the landmarks.
# The common error of two landmarks cancels in their difference, so the vectors should be less
# correlated. The matrix $D$ computes the differences:
#
# $$P_{\text{vectors}} = D\, P_{\text{map}}\, D^{\mathsf T} \tag{07.19}$$

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-a-relative-map"
# *For the lecturer:* Ask what the vectors round a closed loop must add up to, and whether a filter of
# independent vectors guarantees it.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
P_map = P_at[-1][3:, 3:]
D = np.kron(np.eye(15, 16, 1) - np.eye(15, 16), np.eye(2))  # row i: p_{i+1} − p_i
P_vectors = D @ P_map @ D.T
for name, covariance in (("landmarks", P_map), ("vectors", P_vectors)):
    rho = abs(correlation(covariance))
    far = abs(np.subtract.outer(*2 * [np.arange(len(rho)) // 2])) > 1
    print(f"{name}: mean |ρ| of pairs that are not neighbours: {rho[far].mean():.2f}")

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
blocks_only = P_vectors * np.kron(np.eye(15), np.ones((2, 2)))
for k in (8, 12):
    total = np.kron(np.r_[np.ones(k), np.zeros(15 - k)], np.eye(2))  # the vectors from 0 to k
    full, dropped_ = (np.sqrt(np.trace(total @ P @ total.T)) for P in (P_vectors, blocks_only))
    print(
        f"σ (√trace) of the vector from 0 to {k}: {full:.3f} m; correlations dropped {dropped_:.3f} m"
    )

# %% [markdown] slideshow={"slide_type": "fragment"}
# The vectors are less correlated, but not uncorrelated: without a compass all of them depend on the
# rotation of the map. (Distances and angles do not depend on it.) Without the remaining correlations, σ
# of the vectors between distant landmarks changes; here it becomes larger. And the vectors round a
# closed loop no longer add up to zero unless the program enforces this constraint.
