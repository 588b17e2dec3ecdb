# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 06 · EKF-SLAM: the MAK filter
#
# **You will be able to** build EKF-SLAM from its three steps, explain how each block of its covariance
# arises, watch a loop closure correct a whole map, and measure when the filter becomes inconsistent.
#
# **60 minutes. Before:** lessons [03](03_kalman_filter.ipynb) (update, NEES),
# [04](04_models_and_jacobians.ipynb) (the models $f$, $h$, $g$ and their Jacobians) and
# [05](05_localisation_and_mapping.ipynb) (localisation and mapping, separately).
#
# *Key:* robot and map have one joint state and one joint covariance, which contains all their
# correlations.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The first half of the lesson builds the filter. Derive its three steps in front of
# the class with block matrices, and let the students name each block before it appears. The second half
# runs the filter round a loop. If time is short, leave out "An outlier" and "The order of the three
# steps". MAK stands for map-augmented Kalman filter, the thesis's name for EKF-SLAM. Questions for a
# poll: the second measurement, the new landmark, and the ellipses at the loop closure.

# %% slideshow={"slide_type": "skip"} tags=["folded"]
from dataclasses import replace
from functools import lru_cache, partial

import numpy as np
import sympy as sp

from classroom.checks import ask, compare
from classroom.derivation import blockwise, derive, symmetric
from course.studies import consistency
from course.studies import ekf_slam_faults as faults
from course.studies import localisation_and_mapping as ekf_runs
from slamlab import models, views
from slamlab.estimators import run
from slamlab.estimators.ekf_slam import EkfSlam, predict
from slamlab.evaluation import band, correlation, nees
from slamlab.filters import MAK
from slamlab.geometry import compose, wrap
from slamlab.layers import Ellipses, Points, Poses, Segments
from slamlab.sources.landmark_runs import LandmarkRun, Loop

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## The second measurement of a landmark
#
# The pose of a robot is uncertain: its standard deviations are $\sigma = 0.15$ m in x and y, and 0.08
# rad in the heading. The robot measures a landmark at a range of 5 m for the first time and enters it
# into its map. Then it measures the same landmark again, without having moved.
#
# How large will the innovation be? The bearings of the sensor have a standard deviation of 0.02 rad.
# The standard deviation of the robot's heading is four times as large.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-the-second-measurement-of-a-landmark"
# *For the lecturer:* Most students choose the σ of the heading. Ask those who have done lesson 05 where they
# have met this mistake before. If time is short, skip the analogy of the sailor.

# %% slideshow={"slide_type": "fragment"}
ask(
    "06-second",
    "A robot whose heading has a standard deviation of **0.08 rad** entered a landmark into its map "
    "and measures it again. The noise of its bearings has a standard deviation of **0.02 rad**. How "
    "large is the standard deviation of the second bearing's innovation?",
    {
        "about 0.08 rad: that of the heading": "the robot computed the landmark's position with "
        "this heading, and predicts the bearing with the same heading. The error of the heading "
        "cancels.",
        "about 0.03 rad: that of two independent bearings": "each measurement has its own "
        "noise. The error of the pose is also contained in the landmark, so it cancels in the "
        "difference.",
        "zero: the robot has not moved": "the innovation would be zero only if the sensor had "
        "no noise.",
    },
    right="about 0.03 rad: that of two independent bearings",
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### A thousand robots measure twice
#
# We simulate 1000 robots that measure the landmark twice. All of them have the same estimated pose, but
# each has a different true pose. We draw their innovations, and the 95 % ellipses of the innovation
# covariances that two filters predict. One filter keeps $P_{\mathrm ri}$, the cross-covariance of robot
# and landmark; the other filter drops it.

# %% slideshow={"slide_type": "fragment"}
# innovations of 1000 robots with one estimated pose and different true poses
ESTIMATED, MEASURED = np.array([0, 0, 0.4]), np.array([5.0, 0.8])
R = np.diag([0.1, 0.02]) ** 2


def innovations(P_rr):
    """Innovations (1000, 2) of the second measurement; the true poses scatter by P_rr."""
    rng = np.random.default_rng(6)
    poses = rng.multivariate_normal(ESTIMATED, P_rr, 1000)
    first, second = rng.multivariate_normal([0, 0], R, (2, 1000))
    landmarks = models.g(poses, MEASURED - first)
    v = models.h(poses, landmarks) + second - models.h(ESTIMATED, models.g(ESTIMATED, MEASURED))
    return np.column_stack([v[:, 0], wrap(v[:, 1])])


# %% slideshow={"slide_type": "fragment"}
# the S that two filters predict, without P_ri and with it
def predicted_S(P_rr):
    """Innovation covariance S of that measurement, without P_ri and with it."""
    mak = MAK(ESTIMATED, P_rr)
    mak.add(["a"], [MEASURED], R)
    without = mak.P
    without[:3, 3:] = without[3:, :3] = 0
    step = mak.update(["a"], [MEASURED], R)
    return step.H @ without @ step.H.T + R, step.S


# %% slideshow={"slide_type": "subslide"} answers="06-second" tags=["folded"]
def second_measurement(position_sigma, heading_sigma):
    P_rr = np.diag([position_sigma, position_sigma, heading_sigma]) ** 2
    v, (without, with_it) = innovations(P_rr), predicted_S(P_rr)
    fig, ax = views.chart("innovation of the range [m]", "innovation of the bearing [rad]")
    fig.set_size_inches(7, 4)
    layers = {
        "1000 robots": Points("sample", v),
        "S without $P_{ri}$, 95 %": Ellipses("naive", [[0, 0]], [without]),
        "S with $P_{ri}$, 95 %": Ellipses("corrected", [[0, 0]], [with_it]),
    }
    for label, layer in layers.items():
        views.draw(ax, layer, linewidth=2, label=label)
    ax.set(xlim=(-1.5, 1.5), ylim=(-0.5, 0.5))
    views.legend(ax, loc="upper right")
    return fig


views.explore(
    second_measurement,
    lambda position_sigma, heading_sigma: (
        f"With σ = {position_sigma:.2f} m and {heading_sigma:.2f} rad the robots' innovations "
        "contain only the noise of two measurements and fill the ellipse of the filter with "
        "P_ri; the ellipse of the filter without P_ri grows with the uncertainty of the pose."
    ),
    position_sigma=(0.0, 0.3, 0.15),
    heading_sigma=(0.0, 0.15, 0.08),
)
P_start = np.diag([0.15, 0.15, 0.08]) ** 2
sigma_measured = innovations(P_start)[:, 1].std()
sigma_without, sigma_with = (np.sqrt(S[1, 1]) for S in predicted_S(P_start))

# %% [markdown] slideshow={"slide_type": "subslide"} answers="06-second"
# The standard deviation of the 1000 bearing innovations is {= sigma_measured:.3f =} rad. The filter
# that keeps $P_{\mathrm ri}$ predicts {= sigma_with:.3f =} rad, the other filter
# {= sigma_without:.3f =} rad. The innovations are equally small for other pose errors, as the sliders of the
# figure show, because each landmark is displaced *together with* its robot.
#
# The filter without $P_{\mathrm ri}$ treats the second measurement as independent information about the
# pose, so its $P$ shrinks for any value of $v$. In fact the measurement contains no information about
# the pose. (The innovations are far smaller than its $S$ predicts, and this reveals the fault.) The
# careful student of lesson 05 made the same mistake.

# %% [markdown] slideshow={"slide_type": "subslide"} answers="06-second"
# Here is an analogy. A sailor who does not know the position of his boat throws a buoy overboard and
# measures its distance and bearing. These measurements never determine the position of the boat: if
# boat and buoy are shifted or rotated together, every measurement stays the same. A combination of
# state components that the measurements do not determine is **unobservable**. **Observability**
# analysis finds out which combinations they determine (lesson 07). In SLAM, position and orientation of
# robot and map *as a whole* are unobservable.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** At the second measurement the error of the pose cancels, and only the noise of two
# bearings remains. Compute the standard deviation of the innovation.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
sigma_bearing = ...  # of the difference of two independent bearings [rad]
compare(sigma_bearing, np.sqrt(predicted_S(P_start)[1][1, 1]))

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# sigma_bearing = np.sqrt(0.02**2 + 0.02**2)
# ```
#
# The variances of independent errors add, so the standard deviation is $\sqrt 2 \cdot 0.02$ rad.
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## The joint state and its covariance
#
# An innovation depends on the robot's error *and* on the landmark's, so its covariance also depends on
# the correlation of the two errors (05.2). Neither a filter for the robot alone nor a filter for the
# landmark alone contains this correlation. So we put the pose and all landmarks into one state. The
# **joint state and covariance** (also *augmented state*) are
#
# $$x = \begin{bmatrix} x_{\mathrm r} \\ p_1 \\ \vdots \\ p_N \end{bmatrix}, \qquad
# P = \begin{bmatrix} P_{\mathrm{rr}} & P_{\mathrm r1} & \cdots & P_{\mathrm rN} \\
# P_{1\mathrm r} & P_{11} & \cdots & P_{1N} \\ \vdots & \vdots & \ddots & \vdots \\
# P_{N\mathrm r} & P_{N1} & \cdots & P_{NN} \end{bmatrix}. \tag{06.1}$$
#
# Now the innovation depends, to first order, only on the error of the state and on the sensor's noise.
# The Kalman filter of lesson 03 requires this. The disadvantage is the size of the problem: the state
# has $3 + 2N$ components, and $P$ has $(3 + 2N)^2$ entries.
#
# No measurement determines the position and orientation of the map's frame. This property is the
# **gauge freedom** of SLAM. The filter fixes the gauge by starting at $x_{\mathrm r} = (0, 0, 0)$,
# usually with $P_{\mathrm{rr}} = 0$.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-the-joint-state-and-its-covariance"
# *For the lecturer:* Ask for the size of $P$ with 100 landmarks. Students often believe that the robot
# *knows* its first pose; in fact this pose defines the frame.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **EKF-SLAM** (in the MAK thesis: the *map-augmented Kalman filter*) is the extended Kalman filter for
# this state. *Extended* means that $f$, $h$ and $g$ are linearised at the estimate: all equations below
# hold to first order.
#
# The filter approximates the posterior $p(x_{\mathrm r, t}, m \mid z_{1:t}, u_{1:t})$ of the current pose
# and the map by *one* Gaussian, with this mean and this covariance. Past poses are not estimated, so this
# is *online* SLAM.
#
# We assume white, mutually independent noises and **known data association**: each measurement includes
# the number of its landmark (lesson 08 drops this assumption). The filter needs three steps:
#
# | step | when | what it does |
# | --- | --- | --- |
# | **prediction** | the robot has moved | changes the robot's three components |
# | **augmentation** | a landmark is measured for the first time | appends two components |
# | **update** | a landmark is measured again | corrects every component whose error is correlated with the innovation |

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** The state of a filter contains 100 landmarks, numbered from 0. Extract the
# cross-covariance $P_{\mathrm r7}$ of the robot and landmark 7 from its $P$.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
mak = MAK(np.zeros(3), P_start)
mak.add(range(100), np.tile([5.0, 0.8], (100, 1)) + 0.01 * np.arange(200).reshape(100, 2), R)
P = mak.P
P_r7 = ...  # some rows and columns of P
compare(P_r7, mak.blocks()[1][7].T)

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# mak = MAK(np.zeros(3), P_start)
# mak.add(range(100), np.tile([5.0, 0.8], (100, 1)) + 0.01 * np.arange(200).reshape(100, 2), R)
# P = mak.P
# P_r7 = P[:3, 17:19]
# ```
#
# Landmark $i$ has the rows and columns $3 + 2i$ and $4 + 2i$.
#
# </details>

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The three steps in pictures

# %% slideshow={"slide_type": "fragment"} tags=["folded"]
STARS = np.array([[1.2, 1.6], [2.6, 1.9], [3.6, 0.6], [2.4, -0.9]])
rng, R_STAR = np.random.default_rng(1), np.diag([0.1, 0.04]) ** 2
POSES = {"truth": np.array([1.3, -0.1, 0.0]), "predicted": np.array([1.3, 0.25, 0.2])}
measured = [models.h(pose, STARS) for pose in (np.zeros(3), POSES["truth"])]
measured = [z + rng.multivariate_normal([0, 0], R_STAR, len(STARS)) for z in measured]
one = MAK(np.zeros(3), np.zeros((3, 3)))
one.add(range(4), measured[0], R_STAR)
maps = [one.landmarks()]
one.predict(POSES["predicted"], np.diag([0.2, 0.3, 0.15]) ** 2)
one.update(range(4), measured[1], R_STAR)
maps.append(one.landmarks())
still_off = 100 * np.hypot(*(one.pose - POSES["truth"])[:2])
was_off = 100 * np.hypot(*(POSES["predicted"] - POSES["truth"])[:2])
estimated = {name: Poses(name, [pose]) for name, pose in POSES.items()}
old, updated = (Points("landmark", each) for each in maps)
placed = Points("scan", models.g(POSES["predicted"], measured[1]))
pictures = {
    "augmentation": [old, Poses("truth", [np.zeros(3)])],
    "prediction, measurement": {"landmark": old, "measured again": placed, **estimated},
    "update": [updated, *estimated.values(), Poses("corrected", [one.pose])],
}
fig, _ = views.side_by_side(pictures, size=(9.2, 3.8))
for marks in fig.findobj(lambda artist: getattr(artist, "get_marker", str)() == "."):
    marks.set(marker="*", markersize=10)
views.show(
    fig,
    "A robot enters four landmarks into its map. After a motion with an odometry error, all "
    "four measurements lie beside the mapped landmarks. The update reduces the robot's position "
    f"error from {was_off:.0f} cm to {still_off:.0f} cm.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The stars are landmarks. The robot enters four of them into its map from an exactly known pose. Then
# it moves, and its odometry has an error. The new measurements (orange) are displaced from all four
# landmarks in the same way. A single pose error is a more likely cause of this than four landmark
# errors. The update reduces the position error from {= was_off:.0f =} cm to {= still_off:.0f =} cm. The
# remaining error comes from the sensor's noise and from the linearisation.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Prediction: the landmarks are static
#
# The robot moves, and the landmarks do not. So the motion model of the whole state applies the robot's
# $f$ to the pose and leaves the landmarks unchanged:
#
# $$x_{\mathrm r} \leftarrow f(x_{\mathrm r}, u), \qquad p_i \leftarrow p_i. \tag{06.2}$$

# %% [markdown] slideshow={"slide_type": "notes"} name="note-prediction-the-landmarks-are-static"
# *For the lecturer:* Compute the block product on the board, and let the class state each block before you
# press a key. "Only the robot's own" is the usual answer to the poll.

# %% slideshow={"slide_type": "fragment"}
ask(
    "06-drive",
    "The errors of robot and landmarks are correlated. The robot drives 30 cm and measures nothing. Which "
    "blocks of $P$ change?",
    {
        "only the robot's own, $P_{\\mathrm{rr}}$": "this block changes. But the motion also "
        "changes the covariance of the robot's error with each landmark.",
        "$P_{\\mathrm{rr}}$, and the cross-covariances $P_{\\mathrm ri}$": "the landmarks' own "
        "blocks do not change, because the motion gives no information about the map.",
        "all blocks": "no landmark moves and no landmark is measured, so the map's own blocks "
        "do not change.",
    },
    right="$P_{\\mathrm{rr}}$, and the cross-covariances $P_{\\mathrm ri}$",
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# The Jacobian of (06.2) consists of lesson 04's $A$ for the robot and an identity matrix for the map.
# One landmark $i$ is enough to show the structure.

# %% slideshow={"slide_type": "fragment"}
P_rr, P_ii, Q, R_ = symmetric("P_rr", 3), symmetric("P_ii", 2), symmetric("Q", 3), symmetric("R", 2)
P_ri, A = sp.MatrixSymbol("P_ri", 3, 2), sp.MatrixSymbol("A", 3, 3)
O, I = sp.ZeroMatrix, sp.Identity
P = sp.BlockMatrix([[P_rr, P_ri], [P_ri.T, P_ii]])
J_drive = sp.BlockMatrix([[A, O(3, 2)], [O(2, 3), I(2)]])
noise = sp.BlockMatrix([[Q, O(3, 2)], [O(2, 3), O(2, 2)]])

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="06-drive"
driven = derive("P", J_drive * P * J_drive.T + noise, "covariance propagation")
driven.step("multiply block by block", blockwise)

# %% [markdown] slideshow={"slide_type": "subslide"}
# The process noise acts on the robot alone, so $Q$ is added only to the robot's block:
#
# $$P_{\mathrm{rr}} \leftarrow A P_{\mathrm{rr}} A^{\mathsf T} + Q, \qquad P_{\mathrm ri} \leftarrow A P_{\mathrm ri},
# \qquad P_{ij} \leftarrow P_{ij}. \tag{06.3}$$
#
# The cross-covariances are only multiplied by $A$. Only the covariance of the robot itself increases by
# $Q$. The map's blocks do not change.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="06-drive"
STEP, Q_STEP = np.array([0.3, 0.01, 0.1]), np.diag([0.02, 0.01, 0.012]) ** 2
before = mak.P
A_step = mak.predict(compose(mak.pose, STEP), Q_STEP)
changed = np.sum(before != mak.P)
print(
    f"100 landmarks: a prediction changes {changed} of the {views.grouped(before.size)} numbers in P"
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="06-drive"
# These are the 9 entries of the robot's block and 8 of 12 entries of the two cross blocks of each
# landmark. So the computing time of a prediction grows with $N$, not with $N^2$.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** `before` is $P$ before the prediction, and `A_step` is the robot's Jacobian $A$.
# Predict all cross-covariances of the robot with the map at once.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
P_rm = ...  # (3, 200), by (06.3)
compare(P_rm, mak.P[:3, 3:])

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# P_rm = A_step @ before[:3, 3:]
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## State augmentation: a new landmark
#
# **State augmentation** (landmark initialisation) appends a new landmark $n$ to the state. Lesson 04's
# inverse measurement model $g$ computes its position from the robot's pose and the measurement $z$:
#
# $$p_n = g(x_{\mathrm r}, z). \tag{06.4}$$
#
# The position has two sources of error: the error of the pose, multiplied by the Jacobian
# $J_{\mathrm r}$ of $g$, and the error of the measurement, multiplied by $J_z$. No other estimate
# changes. (This requires that one measurement determines the position. A single bearing does not
# determine a position, so a camera needs two poses for a new landmark.)

# %% [markdown] slideshow={"slide_type": "notes"} name="note-state-augmentation-a-new-landmark"
# *For the lecturer:* Let the class fill the last row of the Jacobian before it appears. If time is short,
# skip the program of the Monte Carlo check and show its figure.

# %% slideshow={"slide_type": "fragment"}
ask(
    "06-strangers",
    "The map holds landmark $i$, and the robot now adds landmark $n$. No single measurement involved "
    "both. Is $P_{ni}$, the cross-covariance of their errors, zero?",
    {
        "yes: nothing was measured between them": "no measurement between them is needed: both "
        "positions contain the robot's error.",
        "no, if the robot's error is correlated with that of $i$": "the position of $n$ is computed "
        "from the robot's pose, so $n$ gets the robot's error with all its correlations.",
        "no: in one state all errors are correlated": "a landmark that was added from an exactly "
        "known pose is correlated with nothing else.",
    },
    right="no, if the robot's error is correlated with that of $i$",
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# Before the augmentation three quantities are uncertain: the robot's pose, landmark $i$, and the
# measurement. The measurement noise is independent of the two other errors. After the augmentation the
# state contains the robot, $i$ and $n$.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="06-strangers"
J_r, J_z = sp.MatrixSymbol("J_r", 2, 3), sp.MatrixSymbol("J_z", 2, 2)
J_new = sp.BlockMatrix([[I(3), O(3, 2), O(3, 2)], [O(2, 3), I(2), O(2, 2)], [J_r, O(2, 2), J_z]])
P_z = sp.BlockMatrix([[P_rr, P_ri, O(3, 2)], [P_ri.T, P_ii, O(2, 2)], [O(2, 3), O(2, 2), R_]])
grown = derive("P", J_new * P_z * J_new.T, "covariance propagation; rows: robot, i, n")
grown.step("multiply block by block", blockwise)

# %% [markdown] slideshow={"slide_type": "subslide"}
# The last block on the diagonal is new. It is the sum of the covariances of pose and measurement, each
# propagated by its Jacobian:
#
# $$P_{nn} = J_{\mathrm r} P_{\mathrm{rr}} J_{\mathrm r}^{\mathsf T} + J_z R J_z^{\mathsf T}. \tag{06.5}$$
#
# The other new blocks follow one rule. The new landmark is correlated with the others only through the
# robot, so **its rows are the robot's rows, multiplied by $J_{\mathrm r}$**:
#
# $$P_{n\mathrm r} = J_{\mathrm r} P_{\mathrm{rr}}, \qquad P_{ni} = J_{\mathrm r} P_{\mathrm ri}. \tag{06.6}$$

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### A Monte Carlo check of (06.6)
#
# By (06.6) the errors of $i$ and $n$ are correlated, though no measurement involved both of them. We
# test (06.6) with 20 000 simulated robots. All of them record the same measurements; each has its own
# errors in its first pose, in both measurements, and in the motion between them.

# %% slideshow={"slide_type": "fragment"}
# 20 000 robots, each with its own errors in its poses and measurements
R_SHARP, Z_I, Z_N = np.diag([0.05, 0.01]) ** 2, np.array([4.0, 0.8]), np.array([3.0, -0.9])
MOTION, P_FIRST, ROBOTS = np.array([1.0, 0.1, 0.2]), np.diag([0.15, 0.15, 0.06]) ** 2, 20_000
mak = MAK([0, 0, 0.4], P_FIRST)
mak.add(["i"], [Z_I], R_SHARP)
mak.predict(compose(mak.pose, MOTION), Q_STEP)
mak.add(["n"], [Z_N], R_SHARP)

rng = np.random.default_rng(6)
poses = rng.multivariate_normal([0, 0, 0.4], P_FIRST, ROBOTS)  # the truth of each robot
p_i = models.g(poses, Z_I - rng.multivariate_normal([0, 0], R_SHARP, ROBOTS))
poses = compose(poses, MOTION) + rng.multivariate_normal([0, 0, 0], Q_STEP, ROBOTS)
p_n = models.g(poses, Z_N - rng.multivariate_normal([0, 0], R_SHARP, ROBOTS))

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="06-strangers"
samples, sigma = np.hstack([poses, p_i, p_n]), np.sqrt(np.diag(mak.P))
off = np.abs(np.cov(samples.T) - mak.P) / np.outer(sigma, sigma)
for name, rows in {"P_nn": np.s_[5:, 5:], "P_nr": np.s_[5:, :3], "P_ni": np.s_[5:, 3:5]}.items():
    print(f"{name}: robots and formula differ by at most {off[rows].max():.3f} σᵢσⱼ")
rho_in = correlation(mak.P)[4, 6]

# %% slideshow={"slide_type": "subslide"} answers="06-strangers" tags=["folded"]
pair = mak.P[np.ix_([4, 6], [4, 6])]
ellipses = {"$P$ with $P_{ni}$, 95 %": pair, "$P_{ni}$ dropped, 95 %": np.diag(np.diag(pair))}
fig, ax = views.cloud(
    samples[:500][:, [4, 6]], ellipses, "An old landmark and a new one", size=(8, 5)
)
ax.set(xlabel="y of landmark i [m]", ylabel="y of landmark n [m]")
views.show(
    fig,
    f"The robots form an inclined ellipse (correlation {rho_in:.2f}); the ellipse with P_ni "
    "covers them, and the ellipse without P_ni does not.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="06-strangers"
# If the true y of landmark $i$ is larger than its estimate, the true y of $n$ usually is larger, too:
# the correlation is {= rho_in:.2f =}. The reason is that the same robot added both landmarks. Without
# $P_{ni}$ the filter would predict cases that hardly ever occur (upper left) and exclude cases that do
# occur (upper right).

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** Compute this correlation coefficient from `mak.P`: the covariance of the two y errors,
# divided by the product of their σ. The rows and columns are x, y, θ of the robot, x and y of landmark
# $i$, x and y of landmark $n$.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
rho_y = ...  # of y of landmark i and y of landmark n
compare(rho_y, correlation(mak.P)[4, 6])

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# rho_y = mak.P[4, 6] / np.sqrt(mak.P[4, 4] * mak.P[6, 6])
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Correlations after each step
#
# Here is a small example. The robot starts at an exactly known pose, adds landmark $a$, drives 3 m, and
# adds landmark $b$. After each event we draw the **correlations** $P_{ij} / (\sigma_i \sigma_j)$.
# Correlations have no unit, so one picture can show positions, headings and landmarks.
#
# Before you continue: which blocks will be white (zero) after each of the three events, and why?
# (Blocks whose variance is zero are white, too.)

# %% [markdown] slideshow={"slide_type": "notes"} name="note-correlations-after-each-step"
# *For the lecturer:* Let everybody sketch the three patterns, white or coloured, before you show the picture.
# The answer to the last question is the next section: $a$ is measured again.

# %% slideshow={"slide_type": "fragment"}
# add a, drive 3 m, add b; the correlations after each event
Q_SLIP, moments = np.diag([0.05, 0.03, 0.02]) ** 2, {}
story = MAK(np.zeros(3), np.zeros((3, 3)))
story.add(["a"], [[2.0, 0.9]], R_SHARP)
moments["a is added"] = correlation(story.P)
for _ in range(10):
    story.predict(compose(story.pose, STEP), Q_SLIP)
moments["3 m later"] = correlation(story.P)
story.add(["b"], [[2.5, 0.5]], R_SHARP)
moments["b is added"] = correlation(story.P)

# %% slideshow={"slide_type": "subslide"}
fig, _ = views.correlations(moments, ["robot", "a", "b"], size=(9.2, 3.6))
views.show(
    fig,
    "At first only the block of a has a colour; after the motion the robot's block has one, "
    "too; then b is correlated with the robot and uncorrelated with a.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Landmark $a$ was added from an exact pose. Its error comes only from the sensor's noise, which is
# independent of all other errors. After the motion the robot's own block has a colour: now the pose has
# an error, and the components of this error are correlated. Then $b$ is added. It is correlated with
# the robot but not with $a$, because the errors of the robot and of $a$ are independent.
#
# Which event will make the last white blocks nonzero?

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## Update: the gain of every landmark
#
# Landmark $i$ is measured again. The predicted measurement $h(x_{\mathrm r}, p_i)$ depends on five
# components of the state: three of the robot and two of the landmark. So most columns of its Jacobian
# are zero:
#
# $$H = \begin{bmatrix} H_{\mathrm r} & 0 & \cdots & H_{\mathrm p} & \cdots & 0 \end{bmatrix}. \tag{06.7}$$
#
# The robot is the first part of the state, so $H_{\mathrm r}$ is the first block of $H$. The block
# $H_{\mathrm p}$ stands in the columns of landmark $i$.

# %% slideshow={"slide_type": "subslide"}
ask(
    "06-unseen",
    "In the example, the robot turns round and measures $a$ again, to the left of the predicted "
    "bearing. Landmark $b$ is not measured. What happens to the estimate of $b$?",
    {
        "nothing: $H$ is zero at $b$": "$H$ is zero there, but the gain is $P H^{\\mathsf T} "
        "S^{-1}$, and in $P$ the errors of $b$ and of the robot are correlated.",
        "it changes, and its variance shrinks": "the innovation is correlated with the pose "
        "error, and so with the error of every landmark that was added from this pose.",
        "it changes, but its variance does not": "a correction reduces the variance, because $K "
        "S K^{\\mathsf T}$ is subtracted.",
    },
    right="it changes, and its variance shrinks",
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# The gain is $K = P H^{\mathsf T} S^{-1}$. $H$ has only two blocks that are not zero, so each row of
# the gain has two terms. For a landmark $j$ that was not measured, lesson 05 derived (05.12):
#
# $$K_j = \left( P_{j\mathrm r} H_{\mathrm r}^{\mathsf T} + P_{ji} H_{\mathrm p}^{\mathsf T} \right) S^{-1}. \tag{06.8}$$
#
# The innovation corrects $j$ through its correlation with the robot, and through its correlation with
# the measured landmark. A landmark that is correlated with neither of them keeps its estimate. The two
# terms can also cancel, as at the second measurement from an unchanged pose. With this gain, lesson
# 03's update corrects the whole joint state and covariance at once:
#
# $$x \leftarrow x + K v, \qquad P \leftarrow P - K S K^{\mathsf T}. \tag{06.9}$$
#
# As always, the program wraps the angles: the bearing in $v$, and the heading in $x$.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Students usually make three mistakes here. The bearing in $v$ is not wrapped; the
# heading is not wrapped after the correction; the gain is applied to the robot and the measured
# landmark only. The exercise detects the first and the last mistake. It accepts the second, since
# headings that differ by $2\pi$ are equal.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The first landmark is measured again
#
# The robot turns round, drives 1.5 m back, and measures $a$ again, 0.2 rad to the left of the predicted
# bearing. (Here σ of a position is $\sqrt{\sigma_x^2 + \sigma_y^2}$, the root of the trace of its block.)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="06-unseen"
# the robot drives back and measures a again
story.predict(compose(story.pose, [0, 0, np.pi]), Q_SLIP)
for _ in range(5):
    story.predict(compose(story.pose, STEP * [1, 1, 0]), Q_SLIP)
x, P_was = story.x.copy(), story.P
z = models.h(x[:3], x[3:5]) + np.array([0, 0.2])
step_a = story.update(["a"], [z], R_SHARP)
parts = {"robot": np.s_[:2], "a": np.s_[3:5], "b": np.s_[5:7]}
far = {name: 100 * np.hypot(*(story.x - x)[rows]) for name, rows in parts.items()}
for name, rows in parts.items():
    was, now = (100 * np.sqrt(np.trace(each[rows, rows])) for each in (P_was, story.P))
    print(f"{name:5} moves {far[name]:4.1f} cm, its σ goes from {was:4.1f} to {now:4.1f} cm")

# %% slideshow={"slide_type": "subslide"} answers="06-unseen" tags=["folded"]
fig, ax = views.axes("Landmark a was measured again", size=(8, 6))
for name, label, mean, cov in [
    ("predicted", "predicted, 95 %", x, P_was),
    ("corrected", "corrected, 95 %", story.x, story.P),
]:
    ellipses = Ellipses(
        name, [mean[s] for s in parts.values()], [cov[s, s] for s in parts.values()]
    )
    views.draw(ax, ellipses, label=label)
moves = [[*x[rows], *story.x[rows]] for rows in parts.values()]
views.draw(ax, Segments("truth", moves), linewidth=2.5, label="correction")
for name, rows in parts.items():
    ax.annotate(name, story.x[rows], xytext=(18, 12), textcoords="offset points", fontsize=12)
views.legend(ax)
views.show(
    fig,
    f"The ellipses of the robot and of b shrink, and both move, by {far['robot']:.0f} and "
    f"{far['b']:.0f} cm; a moves by {far['a']:.1f} cm.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="06-unseen"
# Landmark $b$ was not measured, and yet its estimate moved by {= far["b"]:.0f =} cm, and its σ shrank.
# The robot had added this landmark with its own pose error, and the innovation gives information about
# this error. Landmark $a$ moved by only {= far["a"]:.1f =} cm, because its variance was already small.
# If several errors contribute to an innovation, the update corrects those with a larger variance more.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** Compute the gain of landmark $b$ by (06.8). `P_was` is $P$ before the update, with rows
# and columns 0–2 for the robot, 3–4 for $a$, 5–6 for $b$.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
H_robot, H_a, S_inv = step_a.H[:, :3], step_a.H[:, 3:], np.linalg.inv(step_a.S)
K_b = ...  # (2, 2)
compare(K_b, step_a.K[5:7])

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# H_robot, H_a, S_inv = step_a.H[:, :3], step_a.H[:, 3:], np.linalg.inv(step_a.S)
# K_b = (P_was[5:7, :3] @ H_robot.T + P_was[5:7, 3:5] @ H_a.T) @ S_inv
# ```
#
# The second term is zero here: $a$ and $b$ are uncorrelated before this update.
#
# </details>

# %% slideshow={"slide_type": "subslide"} answers="06-unseen"
# the correlations before and after the update
pictures = {"before the update": correlation(P_was), "after": correlation(story.P)}
fig, _ = views.correlations(pictures, ["robot", "a", "b"], size=(9, 4.5))
weakest = np.abs(pictures["after"][5:7, 3:5]).max()
views.show(
    fig,
    "Before the update a is uncorrelated with the others; after the update every block has a "
    f"colour, and the correlation of a and b reaches {weakest:.2f}.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="06-unseen"
# After one update no block is white. From now on all errors are correlated, so $N$ small matrices
# cannot replace $P$. Lesson 07 tries such a replacement.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## The algorithm on a loop
#
# > **Algorithm: EKF-SLAM with known data association** (Smith, Self and Cheeseman 1990; *Probabilistic
# > Robotics*, table 10.1)
# >
# > Input: $\hat x$, $P$; control input $u$; measurements $z_k$ of landmarks $i_k$; $Q$, $R$.
# >
# > 1. Prediction: $\hat x_{\mathrm r} \leftarrow f(\hat x_{\mathrm r}, u)$, $\;P_{\mathrm{rr}} \leftarrow A P_{\mathrm{rr}} A^{\mathsf T} + Q$, $\;P_{\mathrm ri} \leftarrow A P_{\mathrm ri}$ for all $i$.
# > 2. For all $z_k$ of landmarks in the map, stacked: innovations $v_k = z_k - h(\hat x_{\mathrm r}, \hat p_{i_k})$, bearings wrapped; the rows of $H$ by (06.7).
# > 3. $S = H P H^{\mathsf T} + R$, $\;K = P H^{\mathsf T} S^{-1}$.
# > 4. Update: $\hat x \leftarrow \hat x + K v$ (heading wrapped), $\;P \leftarrow P - K S K^{\mathsf T}$.
# > 5. For every $z_k$ of a new landmark $n$: $\hat p_n = g(\hat x_{\mathrm r}, z_k)$, appended to $\hat x$.
# > 6. Augmentation: $P_{nn}$ by (06.5), $P_{n\mathrm r} = J_{\mathrm r} P_{\mathrm{rr}}$, $P_{ni} = J_{\mathrm r} P_{\mathrm ri}$, appended to $P$.
# >
# > Output: $\hat x$, $P$ of pose and map.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-the-algorithm-on-a-loop"
# *For the lecturer:* Compare the box with that of lesson 04: only the augmentation is new. Ask why new
# landmarks come last; a later section shows what happens otherwise.

# %% [markdown] slideshow={"slide_type": "subslide"}
# In the library the filter is `MAK`, and the estimator `EkfSlam` applies it to a run: `step` performs
# the algorithm for one reading. (The book processes one landmark after another; the difference is of
# second order.) Our run is simulated: the robot drives on a circle of 4 m radius among twenty landmarks
# and measures those within 2.5 m (its sensor range). One lap takes 84 steps, and we simulate 100 steps.

# %% slideshow={"slide_type": "fragment"}
# simulate 100 steps on the circle, and keep the filter after each step
LOOP = Loop(steps=100)
source = LandmarkRun(LOOP, np.random.default_rng(16))
kept = []  # the filter after each step


def keep(reading, slam):
    kept.append(slam.filter.marginal(slam.filter.ids))  # a copy


result = run(source, EkfSlam(source.robot, source.sensor), keep)

# %% slideshow={"slide_type": "subslide"}
ask(
    "06-drift",
    "The robot starts at an exactly known pose and drives one lap among landmarks that are all "
    "new. How does its position error develop until the first landmarks come into range again?",
    {
        "it stays small: there is always a landmark in range": "the robot itself added each of "
        "them, with its own error. Such a map does not determine where the robot is.",
        "it grows, if mostly more slowly than odometry's": "each landmark is measured for some "
        "steps. Then it leaves the sensor range, and newer landmarks are added with the pose "
        "error of that moment.",
        "it grows exactly as odometry's does": "while a landmark stays in range, its "
        "measurements give information about the motion of the robot.",
    },
    right="it grows, if mostly more slowly than odometry's",
)

# %% slideshow={"slide_type": "fragment"} tags=["folded", "nbval-check-output"] answers="06-drift"
runs = [LandmarkRun(LOOP, np.random.default_rng(seed)) for seed in range(20)]
estimates = [faults.run_filter(one, MAK(np.zeros(3), np.zeros((3, 3))))[0] for one in runs]
steps_before = np.s_[:70]


def rms_before(poses, one):
    return np.sqrt(np.mean(np.sum((poses - one.truth.poses)[steps_before, :2] ** 2, axis=1)))


by_filter = np.array([rms_before(*each) for each in zip(estimates, runs, strict=True)])
by_odometry = np.array([rms_before(ekf_runs.odometry_poses(one), one) for one in runs])
print(f"20 runs, 70 steps: median of the rms error {np.median(by_filter):.2f} m, odometry ", end="")
print(f"{np.median(by_odometry):.2f} m; EKF-SLAM better in {np.sum(by_filter < by_odometry)} runs")


# %% slideshow={"slide_type": "subslide"} answers="06-drift" tags=["folded"]
def distance(poses):
    return np.hypot(*(poses - source.truth.poses)[:, :2].T)


own, by_wheels = distance(result.trajectory.poses), distance(result.naive.poses)
sigmas = [np.sqrt(np.trace(each.block([0, 1]))) for each in kept]
errors = {"error of EKF-SLAM": own, "error of odometry": by_wheels, "σ of EKF-SLAM, √trace": sigmas}
fig, ax = views.curves(np.arange(101), errors, "step", "position error, σ [m]", size=(8.5, 4.2))
views.show(
    fig,
    f"The filter's error grows to {own.max():.1f} m at step {own.argmax()} and falls to "
    f"{100 * own[-1]:.0f} cm, and so does its σ; the error of odometry grows further, to "
    f"{by_wheels[-1]:.1f} m.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="06-drift"
# While all landmarks are new, the estimate drifts: a map that the robot itself has made does not
# determine where the robot is. In this run the position error reaches {= own.max():.1f =} m. In
# {= np.sum(by_filter < by_odometry) =} of 20 such runs its rms error over 70 steps is smaller than that
# of odometry. The filter also *predicts* its drift: σ grows together with the error. At step
# {= own.argmax() + 1 =} the error of the filter falls suddenly, and that of odometry does not.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Loop closure
#
# The robot has nearly completed its lap, and the first landmarks come into range again.

# %% slideshow={"slide_type": "fragment"}
ask(
    "06-shrink",
    "The robot measures its first landmarks again. Which ellipses shrink clearly in the next six steps?",
    {
        "those of the landmarks it measures now": "these are the most certain landmarks of the "
        "whole map, so they can improve least.",
        "those of the last ones, which it has just left": "these ellipses do shrink; but were "
        "no other landmarks added with a large pose error?",
        "those of most landmarks": "every landmark that the robot added contains its error, and "
        "the loop closure gives information about this error.",
    },
    right="those of most landmarks",
)

# %% slideshow={"slide_type": "fragment"}
first = set(kept[0].ids)
closing = next(k for k in range(40, 101) if set(source.seen(source.truth.poses[k])) & first)
before, after = kept[closing - 1], kept[closing + 5]


# %% slideshow={"slide_type": "fragment"} answers="06-shrink" tags=["folded"]
def map_of(source, mak, trajectory, naive, k):
    """The map after step k, beside the truth: layers by their labels."""
    return {
        "true trajectory": Poses("truth", source.truth.poses[: k + 1]),
        "odometry alone": Poses("naive", naive[: k + 1]),
        "EKF-SLAM": Poses("corrected", trajectory[: k + 1]),
        "true landmarks": Points("truth", source.landmarks[mak.ids]),
        "landmarks, 95 %": Ellipses("landmark", mak.landmarks(), mak.blocks()[2]),
        "robot, 95 %": Ellipses("robot", [mak.x[:2]], [mak.block([0, 1])]),
    }


def draw_map(ax, layers):
    for label, layer in layers.items():
        cross = {"marker": "+", "mew": 1, "markersize": 7} if label == "true landmarks" else {}
        views.draw(ax, layer, label=label, **cross)


def at(k):
    return map_of(source, kept[k], result.trajectory.poses, result.naive.poses, k)


# %% slideshow={"slide_type": "subslide"} answers="06-shrink" tags=["folded"]
titles = [f"step {closing - 1}, before the closure", f"step {closing + 5}, after it"]
fig, both = views.panels(titles, size=(9.2, 5))
for ax, k in zip(both, (closing - 1, closing + 5), strict=True):
    draw_map(ax, at(k))
views.legend_below(fig)


def areas(mak):
    """The landmarks' ellipses, in the order of the older map: their areas but for a factor."""
    return np.sqrt(np.linalg.det(mak.blocks()[2]))[: len(before.ids)]


shrunk = 1 - areas(after) / areas(before)
views.show(
    fig,
    f"Before the closure the ellipses grow along the loop; six steps later {np.sum(shrunk > 0.25)} of "
    f"{len(shrunk)} are smaller by more than a quarter.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="06-shrink"
# Within six steps {= np.sum(shrunk > 0.25) =} of {= len(shrunk) =} ellipses lost more than a quarter of
# their area. Some of their landmarks are on the far side of the loop and have long been out of range.
# The following list shows the share of the area that each ellipse lost, in the order in which the
# landmarks were added:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="06-shrink"
print(" ".join(f"{100 * share:.0f} %" for share in shrunk))
print(
    f"position error: {100 * own[closing - 1]:.0f} cm before, {100 * own[closing + 5]:.0f} cm after"
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# The first landmarks were added from an almost exact pose, so they could improve little. The landmarks
# that were added late, with a large pose error, improved most. The correlations in $P$ determine how
# much each landmark is corrected.
#
# Step through the run and watch the map and its correlations side by side.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The loop closure is the central point of the lesson; plan enough time for it. Ask
# whether a program that stores only a 2 × 2 covariance for each landmark could do the same.


# %% slideshow={"slide_type": "subslide"} tags=["folded"]
def at_step(step):
    mak = kept[step]
    fig, (left, right) = views.panels([f"step {step}", "correlations"], (9.2, 4.6), shared=False)
    for ax in (left, right):
        ax.set_aspect("equal", adjustable="box")
    draw_map(left, at(step))
    left.set(xlim=(-6.5, 6.5), ylim=(-2.8, 10.5))
    views.correlation(correlation(mak.P), ["r", *map(str, range(len(mak.ids)))], ax=right)
    right.set(xlabel="landmarks, first to last added", ylabel=None)
    views.colour_bar(right)
    return fig


# %% slideshow={"slide_type": "fragment"}
# the map and its correlations at each step
views.explore(
    at_step,
    lambda step: (
        f"The map after step {step}, with {len(kept[step].ids)} landmarks: early ones have weak "
        "correlations with the others; later ones have stronger correlations."
    ),
    play="step",
    step=(1, 100, closing - 1),
)
rho = np.abs(correlation(before.P))
of_two = np.kron(1 - np.eye(5), np.ones((2, 2))) > 0  # of different landmarks
early, late = rho[3:13, 3:13][of_two].mean(), rho[-10:, -10:][of_two].mean()

# %% [markdown] slideshow={"slide_type": "fragment"}
# The animation starts just before the loop closure. The landmarks are in the order in which they were
# added. The blocks of the first ones are pale: the absolute correlations between the first five are
# {= early:.2f =} on average. Those between the last five are {= late:.2f =}, since each of these was
# added with a large pose error. Now start the animation: at the loop closure almost every block
# changes, even the blocks of landmarks that were never in range together.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## Linearisation error and inconsistency
#
# Is the covariance $P$ correct? If a filter is *consistent* (lesson 03), the NEES of its pose is 3 on
# average, since the pose has three components. A larger average means that the filter is overconfident.
# In the runs so far the sensor range is 2.5 m, and the turn rate has a standard deviation of 0.7°/s. We
# now shorten the sensor range and make the odometry worse. The filter is given both values exactly.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-linearisation-error-and-inconsistency"
# *For the lecturer:* Do not quote the mean NEES, because two of the twelve runs dominate it. Ask with which
# length the position error has to be compared. (The distance to the landmark.)

# %% slideshow={"slide_type": "fragment"}
ask(
    "06-honest",
    "The sensor range is only **1.5 m**, and the turn rate is **2.5 times** as noisy. The filter is "
    "given both values. Is it still consistent?",
    {
        "yes: it knows every noise, and it keeps every correlation": "this would be enough if "
        "$f$ and $h$ were linear, or if the errors were small compared with the distances to "
        "the landmarks.",
        "no, it is overconfident": "at the loop closure the position error is nearly as large as the "
        "sensor range, and a first-order Taylor polynomial does not describe $h$ over such an error.",
        "no, it is conservative": "more noise makes $P$ larger, but it makes the errors larger, "
        "too.",
    },
    right="no, it is overconfident",
)


# %% slideshow={"slide_type": "fragment"}
# 12 runs with another sensor range and another noise of the turn rate
@lru_cache(4)
def runs_with(sensor_range, turn_noise):
    """12 runs of a loop with this sensor range [m] and noise of the turn rate [°/s]."""
    loop = replace(LOOP, range_max=sensor_range, omega_sigma=np.radians(turn_noise))
    runs = [LandmarkRun(loop, np.random.default_rng(seed)) for seed in range(12)]
    filters = [MAK(np.zeros(3), np.zeros((3, 3))) for _ in runs]
    return [
        (one, *faults.run_filter(one, mak), mak) for one, mak in zip(runs, filters, strict=True)
    ]


SETTLED, LIMITS = 10, band(3, 12)  # P is zero at first: NEES is undefined there


def mean_nees(some):
    return ekf_runs.mean_nees([each[:3] for each in some], SETTLED)


# %% slideshow={"slide_type": "fragment"} answers="06-honest" tags=["folded"]
def off_at_closing(one, poses, *_):
    """Position error just before one of the first landmarks is measured again [m]."""
    in_range = [set(one.seen(pose)) for pose in one.truth.poses]
    first = set.union(*in_range[:10])
    k = next(k for k in range(50, 101) if in_range[k] & first)
    return np.hypot(*(poses - one.truth.poses)[k - 1, :2])


at_closing = {
    sensor_range: np.median([off_at_closing(*each) for each in runs_with(sensor_range, 1.8)])
    for sensor_range in (1.5, 4.0)
}
of_run = {
    sensor_range: [
        ekf_runs.mean_nees([each[:3]], SETTLED).mean() for each in runs_with(sensor_range, 1.8)
    ]
    for sensor_range in (1.5, 4.0)
}

# %% slideshow={"slide_type": "subslide"} answers="06-honest" tags=["folded"]
as_before = mean_nees(runs_with(2.5, 0.7))


def range_and_noise(sensor_range, turn_noise):
    some = runs_with(sensor_range, turn_noise)
    one, poses, _, mak = some[4]
    values = mean_nees(some)
    fig, (left, right) = views.panels(["one of 12 runs", "all 12 runs"], (9.2, 4.8), shared=False)
    left.set_aspect("equal", adjustable="box")
    draw_map(left, map_of(one, mak, poses, ekf_runs.odometry_poses(one), 100))
    right.set_aspect("auto")
    steps = np.arange(SETTLED, 101)
    right.plot(steps, values, color=views.COLOURS["corrected"], lw=2, label="chosen values")
    before = views.COLOURS["before"]
    right.plot(steps, as_before, color=before, lw=2, ls="dashed", label="2.5 m, 0.7°/s")
    views.band(right, *LIMITS, "95 % χ² interval")
    right.set(
        xlabel="step", ylabel="mean NEES [1]", yscale="log", ylim=(1, max(100, 1.5 * values.max()))
    )
    views.legend_below(fig)
    return fig


# %% slideshow={"slide_type": "fragment"} answers="06-honest"
views.explore(
    range_and_noise,
    lambda sensor_range, turn_noise: (
        f"With a sensor range of {sensor_range:.1f} m and turn rates with σ = "
        f"{turn_noise:.1f}°/s: the map of one run, and the mean NEES of all runs beside the mean "
        "NEES with the first values, which stays near its χ² interval."
    ),
    sensor_range=(1.0, 5.0, 1.5),
    turn_noise=(0.2, 3.0, 1.8),
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="06-honest"
# With the short sensor range, the median of the 12 runs' mean NEES is {= np.median(of_run[1.5]):.1f =}.
# Two runs reach {= sorted(of_run[1.5])[-2]:.0f =} and {= max(of_run[1.5]):.0f =}; the run with the larger
# value causes almost the whole peak of the curve. With the same odometry and a sensor range of 4 m the median
# is {= np.median(of_run[4.0]):.1f =}.
#
# No block of $P$ is missing here. When the robot measures its first landmarks again, its position error
# is {= at_closing[1.5]:.1f =} m (median), and these landmarks are at most 1.5 m away. With a sensor range
# of 4 m the error is {= at_closing[4.0]:.2f =} m. What does the EKF neglect when an error is so large?

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="06-honest"
for off, ahead in ((at_closing[1.5], 1.5), (at_closing[4.0], 4.0)):
    landmark, moved = np.array([ahead, 0.0]), np.array([0.0, off, 0.0])
    exact = models.h(moved, landmark)
    linear = models.h(np.zeros(3), landmark) + models.H_robot(np.zeros(3), landmark) @ moved
    print(
        f"{off:.2f} m to the side, landmark {ahead} m ahead: h and its linearisation differ by",
        end=" ",
    )
    print(f"{exact[0] - linear[0]:.3f} m and {exact[1] - linear[1]:.3f} rad")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="06-honest"
# This difference is the **linearisation error**: the terms of second and higher order of the Taylor
# series, which the EKF drops. The standard deviations of the sensor are {= source.sensor.range_sigma =}
# m and {= source.sensor.bearing_sigma:.3f =} rad, so for the short range the linearisation error is
# several times as large. $P$ includes the noise but not the linearisation error. So the filter becomes
# overconfident. This is called the **inconsistency** of EKF-SLAM (Julier and Uhlmann 2001).

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** Here is the pose error of one of the 12 runs at its last step, and the covariance that
# the filter reports. Compute NEES.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
one, poses, covariances, _ = runs_with(1.5, 1.8)[8]
error, P_rr_last = poses[-1] - one.truth.poses[-1], covariances[-1]
NEES = ...  # from error and P_rr_last
compare(NEES, nees(error, P_rr_last))

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# one, poses, covariances, _ = runs_with(1.5, 1.8)[8]
# error, P_rr_last = poses[-1] - one.truth.poses[-1], covariances[-1]
# NEES = error @ np.linalg.solve(P_rr_last, error)
# ```
#
# The average of NEES over many runs should be 3.
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## First-estimates Jacobians
#
# An EKF evaluates its Jacobians at its current estimate, which changes from step to step. In a
# simulation we can evaluate them at the truth instead (the *ideal* filter). **First-estimates
# Jacobians** (FEJ; Huang, Mourikis and Roumeliotis) are possible on a real robot: every Jacobian of a
# landmark is evaluated at the landmark's first estimate, and $A$ at predicted poses. The linearisation
# point then never changes. Which of the two methods makes the filter more consistent in our 12 runs?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# the same 12 runs with other Jacobians
worse = replace(LOOP, range_max=1.5, omega_sigma=np.radians(1.8))
others = ("ideal", "first estimates")
tried = [consistency.errors_of(seed, worse, others) for seed in range(12)]
of_runs = {"standard": np.array(of_run[1.5])} | {
    name: np.array([nees(*(each[SETTLED:] for each in one[name][:2])).mean() for one in tried])
    for name in others
}
for name, values in of_runs.items():
    fewer = np.sum(values < of_runs["standard"])
    print(f"{name:15} NEES median {np.median(values):.1f}, mean {values.mean():4.1f}", end="")
    print(f", below standard in {fewer} of 12 runs" if name != "standard" else "")

# %% slideshow={"slide_type": "fragment"} tags=["folded"]
colours = {"standard": "naive", "ideal": "truth", "first estimates": "corrected"}
rows = {name: (colours[name], values) for name, values in of_runs.items()}
fig, _ = views.strips(rows, {"consistent": 3}, (1, 600), "NEES, mean over a run [1]", size=(8, 3.4))
views.show(
    fig,
    "Each dot is a run. The largest NEES of the standard filter is "
    f"{of_runs['standard'].max():.0f}, that of the ideal filter {of_runs['ideal'].max():.0f}, "
    f"and that with first estimates {of_runs['first estimates'].max():.0f}.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# First-estimates Jacobians reduce NEES in
# {= np.sum(of_runs["first estimates"] < of_runs["standard"]) =} of 12 runs, and Jacobians at the truth
# reduce it in {= np.sum(of_runs["ideal"] < of_runs["standard"]) =}. (Twelve runs are few; lesson 07 compares
# the three filters in 400 runs.) The medians are
# {= np.median(of_runs["standard"]):.1f =} (standard), {= np.median(of_runs["ideal"]):.1f =} (at the
# truth) and {= np.median(of_runs["first estimates"]):.1f =} (first estimates). The mean of a consistent
# filter is 3, and its median is a little lower. So part of the inconsistency comes from Jacobians that
# change: lesson 07 derives why. But after large errors the estimate can still diverge, even with
# Jacobians at the truth: one run reaches {= of_runs["ideal"].max():.0f =} and dominates the mean. For
# such errors the first-order approximation itself is too coarse. Four methods reduce the problem: a
# longer sensor range, better odometry, an iterated update (lesson 04), or the repeated linearisation of
# all measurements together (lesson 15).

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Neighbouring steps of a run have correlated errors, so ten consecutive steps
# outside the interval count as one event. `python -m course.studies.consistency --runs 400`
# simulates runs of seven laps, with standard, first-estimates and ideal Jacobians on the same readings,
# and writes the table that lesson 07 shows.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## The order of the three steps

# %% [markdown] slideshow={"slide_type": "notes"} name="note-the-order-of-the-three-steps"
# *For the lecturer:* If time is short, leave out this section. Ask how one could find such a mistake by
# looking at the map alone. (Hardly.)

# %% slideshow={"slide_type": "fragment"}
ask(
    "06-order",
    "A program first adds the new landmarks of a scan, then predicts the motion, then updates. The "
    "robot drives 0.3 m per step. What happens?",
    {
        "nothing: in the end all three steps are done": "the measurement was made *after* the "
        "motion, but the landmark is added from the pose before the motion.",
        "the errors average out over many measurements": "each landmark is displaced by one "
        "step backwards along the trajectory. This error is a bias, not noise.",
        "landmarks are displaced by one step, and $P$ does not contain this error": "the filter "
        "then corrects the robot with a map whose covariance is too small.",
    },
    right="landmarks are displaced by one step, and $P$ does not contain this error",
)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="06-order"
# ten runs with each order of the steps
ten = runs[:10]
right_order = faults.final_errors(ten)
wrong_order = faults.final_errors(ten, landmarks_first=True)
last = [(ekf_runs.odometry_poses(one) - one.truth.poses)[-1, :2] for one in ten]
odometry_last = np.sqrt(np.mean(np.sum(np.square(last), axis=1)))
print(f"{'rms of 10 runs, last step':30} map [m]  robot [m]  √trace [m]  NEES")
table = {"predict, update, augment": right_order, "augment, predict, update": wrong_order}
for name, end in table.items():
    print(f"{name:30} {end.landmarks:7.2f} {end.robot:10.2f} {end.claimed:11.2f} {end.nees:5.1f}")
print(f"{'odometry alone':30} {odometry_last:18.2f}")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="06-order"
# (√trace is the σ of the robot's position according to $P$.) The errors of the map are
# {= wrong_order.landmarks / right_order.landmarks:.1f =} times as large, and the mean NEES is
# {= wrong_order.nees:.1f =} instead of {= right_order.nees:.1f =}. The map still looks plausible, and
# the pose is still more accurate than odometry. Such a mistake is found only if somebody computes NEES
# or, without a ground truth, NIS.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## An outlier
#
# One innovation corrects the whole map. What happens if the measurement is wrong? We return to the loop
# closure and make the measured range of an old landmark too long. Such a measurement is an **outlier**.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-an-outlier"
# *For the lecturer:* Ask whether the ellipses show that something went wrong. They do not, since $P$ does not
# depend on the innovation. The question how to refuse such a measurement leads to the gate of lesson 08.

# %% slideshow={"slide_type": "fragment"}
# make one range of the oldest landmark in range too long
readings = list(source)
NOISE = ekf_runs.R(source)


def with_outlier(k, too_long):
    """The filter after step k + 1 with one measurement, of the oldest landmark, `too_long` [m]."""
    mak = kept[k].marginal(kept[k].ids)
    predict(mak, readings[k + 1], source.robot)
    scan = readings[k + 1].observations
    known = [j for j, id in enumerate(scan.ids) if id in mak.ids]
    j = min(known, key=lambda j: mak.ids.index(scan.ids[j]))
    return mak, mak.update([scan.ids[j]], [scan.z[j] + [too_long, 0]], NOISE)


# %% slideshow={"slide_type": "subslide"} tags=["folded"]
def outlier_map(range_too_long_by):
    (mak, step), (correct, _) = (
        with_outlier(closing - 1, range_too_long_by),
        with_outlier(closing - 1, 0.0),
    )
    fig, ax = views.axes(f"NIS of this measurement: {step.nis:.1f}", size=(8, 6))
    moves = np.hstack([correct.landmarks(), mak.landmarks()])
    layers = map_of(source, mak, [mak.pose], [], closing)
    del layers["odometry alone"], layers["EKF-SLAM"]
    draw_map(ax, layers | {"moved by the outlier": Segments("naive", moves)})
    views.draw(ax, Poses("robot", mak.pose), label="robot")
    views.legend_below(fig)
    return fig


# %% slideshow={"slide_type": "fragment"}
# the map after one outlier
views.explore(
    outlier_map,
    lambda range_too_long_by: (
        f"A single range that is {range_too_long_by:.1f} m too long moves the robot and the "
        "landmarks that were added late; a large outlier moves them far out of their ellipses."
    ),
    range_too_long_by=(0.0, 3.0, 2.0),
)
NIS = [with_outlier(k, 0.0)[1].nis for k in range(1, 100)]
(misled, outlier_step), (correct, _) = (with_outlier(closing - 1, each) for each in (2.0, 0.0))
carried = np.hypot(*(misled.landmarks() - correct.landmarks()).T)

# %% [markdown] slideshow={"slide_type": "fragment"}
# One range that is 2 m too long moves {= np.sum(carried > 0.3) =} of the {= len(carried) =} landmarks
# by more than 0.3 m; the largest displacement is {= carried.max():.1f =} m. The ellipses are as small
# as after a correct measurement, since the new $P$ in (06.9) does not depend on $v$.
#
# But the filter could have detected the outlier. It computes $S$ before it uses the measurement, and
# $S$ predicts the size of the innovation. Lesson 03's $v^{\mathsf T} S^{-1} v$ (NIS) is 2 on average
# for a measurement of range and bearing. In {= len(NIS) =} steps of this run the NIS of the oldest
# landmark in range was {= np.mean(NIS):.1f =} on average, and at most {= max(NIS):.0f =}. The NIS of
# the outlier is {= outlier_step.nis:.0f =}.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Literature
#
# R. Smith, M. Self and P. Cheeseman, "Estimating uncertain spatial relationships in robotics", in *Autonomous Robot
# Vehicles*, Springer, 1990: the joint state of robot and map, with all its covariances.
#
# M. W. M. G. Dissanayake, P. Newman, S. Clark, H. F. Durrant-Whyte and M. Csorba, "A solution to the simultaneous
# localization and map building (SLAM) problem", *IEEE Transactions on Robotics and Automation* 17(3), 2001: why the
# correlations have to be kept, and their limit.
#
# S. J. Julier and J. K. Uhlmann, "A counter example to the theory of simultaneous localization and map building",
# *IEEE International Conference on Robotics and Automation*, 2001; T. Bailey, J. Nieto, J. Guivant, M. Stevens and
# E. Nebot, "Consistency of the EKF-SLAM algorithm", *IROS*, 2006; S. Huang and G. Dissanayake, "Convergence and
# consistency analysis for extended Kalman filter based SLAM", *IEEE Transactions on Robotics* 23(5), 2007: the
# inconsistency.
#
# **Read next:** H. Durrant-Whyte and T. Bailey, "Simultaneous localization and mapping: part I", *IEEE Robotics and
# Automation Magazine* 13(2), 2006.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-literature"
# *For the lecturer:* The counterexample of Julier and Uhlmann contains a robot that does not even move. A
# student can rebuild it with `MAK` as a project.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## What you can do now
#
# You can build EKF-SLAM from three steps, explain how each block of its covariance arises, watch a loop closure
# correct a whole map, and detect by NEES that the filter has become inconsistent.
#
# **What comes next:** [lesson 07](07_correlations.ipynb) analyses the correlations: why they cannot be
# dropped, what they cost, which combinations of the state are unobservable, and how the filter performs
# on a real log.
#
# The sections below this one are optional.
#
# **Exercise:** [06 · EKF-SLAM: the MAK filter](../exercises/ex06_ekf_slam.ipynb). You write
# augmentation, update and the whole filter, test its consistency by NIS and NEES, and make the filter
# robust against outliers.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-what-you-can-do-now"
# *For the lecturer:* Ask which of the three steps has to change if the numbers of the landmarks are not
# given. The answer leads to lesson 08.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: gauge freedom and the initial covariance
#
# In this lesson $P$ starts at zero: the origin of the map's frame is the robot's first pose, which
# fixes the gauge. Smolec warns against this (section 2.6): without a variance on the diagonal of $P$, a
# matrix often becomes singular, so one should set a variance even if the start is known. Does an
# initial $P$ of zero cause an error, and what is the effect of the variance?

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-gauge-freedom-and-the-initial-cov"
# *For the lecturer:* Ask what an exact filter would do with the variance of the start: it would add this
# variance to the map, but not rotate the map.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# the same runs with a wide initial covariance
P_WIDE = np.diag([0.1, 0.1, np.radians(5)]) ** 2
first_estimates = partial(MAK, first_estimates=True)
table = {
    "standard, P = 0": right_order,
    "standard, 10 cm, 5°": faults.final_errors(ten, P_start=P_WIDE),
    "first estimates, P = 0": faults.final_errors(ten, first_estimates),
    "first estimates, 10 cm, 5°": faults.final_errors(ten, first_estimates, P_WIDE),
}
print(f"{'rms of 10 runs, last step':30} map [m]  robot [m]  √trace [m]  NEES")
for name, end in table.items():
    print(f"{name:30} {end.landmarks:7.2f} {end.robot:10.2f} {end.claimed:11.2f} {end.nees:5.1f}")

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
maps = {}
for name, start in (("zero", 0 * P_WIDE), ("wide", P_WIDE)):
    mak = MAK(np.zeros(3), start)
    faults.run_filter(source, mak)
    maps[name] = mak.landmarks()
between = [np.hypot(*(each[:, None] - each).T) for each in maps.values()]  # all distances in a map
apart = 100 * np.hypot(*(maps["zero"] - maps["wide"]).T).max()
print(f"standard: landmarks differ by up to {apart:.0f} cm,", end=" ")
print(f"distances between landmarks by up to {100 * np.abs(between[0] - between[1]).max():.0f} cm")

# %% [markdown] slideshow={"slide_type": "subslide"}
# An initial $P$ of zero causes no error. The filter inverts $S = H P H^{\mathsf T} + R$, and $R$ alone
# makes $S$ invertible. Only quantities that need the inverse of $P$ itself, such as NEES, are undefined
# in the first steps.
#
# The true error of the start is 0 in both cases, so an exact filter would make nearly the same map.
# With first estimates our filter also makes nearly the same map. (Its NEES of
# {= table["first estimates, 10 cm, 5°"].nees:.1f =} is correct: $P$ contains a variance of the start, which
# has no error in these runs.) With standard Jacobians the map of the lesson's run has nearly the same shape,
# but it is shifted and rotated as a whole. The reason is that the variance of the initial heading allows the filter to rotate the map by spurious information
# (lesson 07). The initial $P$ should contain a variance if the frame is given from outside, for example
# by an earlier map. In this case use first-estimates Jacobians.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: external measurements, and the removal of landmarks
#
# Nothing in (06.8) and (06.9) requires a range and a bearing. They need a measurement model $h$ of the
# state, its Jacobian $H$ with respect to the *whole* state, and a covariance $R$. Suppose that a
# surveyor measures the position of landmark $b$ of our example, with a standard deviation of 1 cm. Then
# $h$ is $p_b$ itself: $H$ is an identity matrix in the columns of $b$ and zero in all other columns.
# (`correct` takes $H$ without its columns of zeros, and the indices of the other columns.)

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-external-measurements-and-the-rem"
# *For the lecturer:* Ask what a GPS receiver would measure in terms of $H$: it would be an identity matrix in
# the columns of the robot's position.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
surveyed, R_PLAN = story.landmarks()[1] + [0.03, -0.04], np.eye(2) * 0.01**2
x, sigma = story.x.copy(), np.sqrt(np.diag(story.P))
story.correct(surveyed - x[5:7], np.eye(2), story.rows(["b"]), R_PLAN)
now = np.sqrt(np.diag(story.P))
for name, rows in parts.items():
    moved, was, is_now = np.hypot(*(story.x - x)[rows]), *(np.hypot(*s[rows]) for s in (sigma, now))
    print(f"{name:5} moves {100 * moved:.1f} cm, σ from {100 * was:.1f} to {100 * is_now:.1f} cm")

# %% [markdown] slideshow={"slide_type": "subslide"}
# The robot's estimate moves as well, though its sensor measured nothing. A more precise external
# measurement has a smaller $R$. An exact measurement has $R = 0$, which is possible as long as $S$ can
# be inverted.
#
# A landmark can also be removed, for example a chair that has been moved. To *marginalise out* a
# landmark, delete its rows and columns of $x$ and $P$. The other estimates do not change, and they keep
# the information of its measurements.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
P_left = story.P[np.ix_([0, 1, 2, 5, 6], [0, 1, 2, 5, 6])]
story.remove(["a"])
print("left:", story.ids, " P of robot and b unchanged:", np.array_equal(story.P, P_left))

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: how the library saves time
#
# `MAK` computes (06.9) with less work than the equation suggests. $P$ is symmetric, so only one
# triangle of it is stored. In addition, a scan of $m$ landmarks is processed in a single update. With
# the Cholesky factor $L$ of $S = L L^{\mathsf T}$ and $M = P H^{\mathsf T} L^{-\mathsf T}$ (`B` in the
# code), this update is $P \leftarrow P - M M^{\mathsf T}$. This form needs neither a gain nor an
# inverse.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-how-the-library-saves-time"
# *For the lecturer:* Only students who implement the filter themselves need this section.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# the product B Bᵀ of the library's update
mak = kept[60].marginal(kept[60].ids)
P_then, last_ids = mak.P, mak.ids[-3:]
step = mak.update(
    last_ids, models.h(mak.pose, mak.landmarks()[-3:]) + np.array([0.05, 0.01]), NOISE
)
print("B", step.B.shape, " K", step.K.shape)
print(f"B Bᵀ and K S Kᵀ agree: {np.allclose(step.B @ step.B.T, step.K @ step.S @ step.K.T)}")
print(f"P − B Bᵀ is the new P: {np.allclose(mak.P, P_then - step.B @ step.B.T)}")

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: a smoothed display
#
# The EKF note adds a step: after the update, a recursive filter smooths the pose that is *shown*. Our
# copy of the note does not contain its formula. The simplest filter keeps a share $\lambda$ of the
# difference between the shown pose and the estimate:
#
# $$x_{\text{shown}} \leftarrow x_{\text{shown}} \oplus o, \qquad x_{\text{shown}} \leftarrow \hat x + \lambda\,(x_{\text{shown}} - \hat x), \tag{06.10}$$
#
# where $o$ is the motion measured by odometry. A landmark does not move, so it needs only the second
# assignment. `EkfSlam` implements both cases. Is the shown pose more accurate for some $\lambda > 0$,
# or only smoother?

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-a-smoothed-display"
# *For the lecturer:* Ask before the table whether smoothing makes the pose more accurate or only less jumpy.


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
def shown(share, count=4):
    """Rms error of the shown pose after the loop closure, its jumps, error of shown landmarks [cm]."""
    squares = []
    for one in runs[:count]:
        slam = EkfSlam(one.robot, one.sensor, smoothing=share, landmark_smoothing=share)
        poses = run(one, slam).trajectory.poses
        by_odometry = compose(poses[:-1], [reading.odometry for reading in list(one)[1:]])
        landmarks = slam.landmarks() - one.landmarks[slam.filter.ids]
        differences = [(poses - one.truth.poses)[84:], poses[1:] - by_odometry, landmarks]
        squares.append([np.mean(np.sum(each[:, :2] ** 2, axis=1)) for each in differences])
    return 100 * np.sqrt(np.mean(squares, axis=0))


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
smoothed = {share: shown(share) for share in (0.0, 0.5, 0.9)}
for share, (error, jump, landmark) in smoothed.items():
    print(f"λ {share:.2f}: error of the pose {error:4.1f} cm, jumps {jump:3.1f} cm; ", end="")
    print(f"error of the landmarks {landmark:.1f} cm")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The shown pose is smoother, but its rms error over these four runs is not smaller. The estimate uses every
# measurement so far, and the old difference contains the error that the last measurement has just
# corrected. For a display, smoothness may be more important than this error; a controller should use
# the estimate.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: from the command line
#
# You can run the same filter from a terminal. The cell below calls the same command. The source
# `sim:landmarks` is a run of about seven laps. With the option `--out FOLDER` the command also writes
# the trajectory, the map and a summary.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-from-the-command-line"
# *For the lecturer:* `slamlab run --list-estimators` lists the other estimators that can process the same
# run.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-ignore-output"]
from slamlab.cli import main

# in a terminal: slamlab run sim:landmarks --estimator mak
code = main(["run", "sim:landmarks", "--estimator", "mak"])
