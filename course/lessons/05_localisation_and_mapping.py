# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 05 · Localisation and mapping, apart
#
# **You will be able to** localise a robot in a known map, map landmarks from known poses, name the blocks
# of the covariance that make each problem easy, and show with numbers why two filters that alternate
# without a cross-covariance are inconsistent.
#
# **60 minutes. Before:** lesson [03](03_kalman_filter.ipynb) (prediction, update, NEES) and lesson
# [04](04_models_and_jacobians.ipynb) (the models $f$, $h$, $g$ and their Jacobians).
#
# The main idea: a measurement is easy to use if either the pose or the landmark is known exactly.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The lesson has two halves, localisation and mapping, of about 25 minutes each, and a final
# part, "Alternating localisation and mapping". If time is short, keep "The innovation and its covariance" and
# the final part, because lesson 06 needs them; the exercise repeats the rest. Good questions for a poll are the
# first, the question on a single landmark, and the last.

# %% slideshow={"slide_type": "skip"} tags=["folded"]
from dataclasses import replace
from functools import cache

import numpy as np
import sympy as sp

from classroom.checks import ask, compare
from classroom.derivation import blockwise, derive, symmetric
from course.studies import alternating_filters, pose_posterior_samples
from course.studies import localisation_and_mapping as ekf_runs
from slamlab import models, views
from slamlab.estimators.ekf_slam import EkfSlam, Q_arc
from slamlab.evaluation import band
from slamlab.filters import MAK, Belief, KnownPoseMap, ekf_localisation
from slamlab.filters.landmark_models import difference
from slamlab.geometry import compose, wrap
from slamlab.layers import Ellipses, Points, Poses
from slamlab.models import jacobians
from slamlab.sources.landmark_runs import LandmarkRun, Loop

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## One lap by odometry
#
# A robot drives one lap on a circle. Its odometry counts the revolutions of its wheels. The robot also measures
# the range and bearing of every landmark within 2 m, and it knows which landmark it measures: the *data
# association* is known. All runs of this lesson are simulated, so we know the ground truth, but the robot does
# not.
#
# Where is the robot, and where are the landmarks?

# %% [markdown] slideshow={"slide_type": "notes"} name="note-one-lap-by-odometry"
# *For the lecturer:* Keep this short: the lap only motivates the question after it. In the poll, ask those
# who choose "always" where the predicted measurement comes from.

# %% slideshow={"slide_type": "fragment"}
# simulate one lap, and compute its poses from the odometry alone
LAP = Loop(landmarks=8, v=0.6, steps=42, range_max=2.0, v_sigma=0.03, omega_sigma=0.015)


def simulated_run(seed, loop=LAP):
    return LandmarkRun(loop, np.random.default_rng(seed))


run = simulated_run(74)
odometry_poses = ekf_runs.odometry_poses(run)

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
fig, ax = views.axes("One lap by odometry", size=(8, 5.5))
views.draw(ax, Poses("truth", run.truth.poses))
views.draw(ax, Poses("naive", odometry_poses), label="odometry")
views.draw(ax, Points("landmark", run.landmarks), label="landmarks")
views.legend(ax, loc="center")
gap = np.hypot(*(odometry_poses - run.truth.poses)[-1, :2])
views.show(fig, f"The true lap closes; the lap by odometry ends {gap:.1f} m from the true end.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The true lap closes. The lap by odometry alone ends {= gap:.1f =} m from the robot's true position, because
# each small error of the heading rotates all of the path that follows.
#
# Measurements of the landmarks can correct the odometry. A list of landmark positions is a **feature map**, the
# kind of map used in this
# lesson. Estimating the pose in a given map is **localisation**. Estimating the map from given poses is
# **mapping with known poses**. In SLAM neither the map nor the poses are given. A measurement $z$, a range and
# a bearing, gives the position of the landmark only *relative to the robot*, so it relates two unknowns.

# %% slideshow={"slide_type": "subslide"}
ask(
    "05-unknown",
    "The innovation is the measurement minus the predicted measurement. When does it depend "
    "only on the error of the **pose** and the measurement noise?",
    {
        "always: the robot makes the measurement": "the predicted measurement depends on the "
        "estimated position of the landmark, and an error of this position also enters the "
        "innovation.",
        "when the landmark's position is known exactly": "then the predicted measurement contains "
        "no other error than that of the pose.",
        "when the sensor has no noise": "this removes the noise, but an error of the landmark's "
        "position still enters the predicted measurement.",
    },
    right="when the landmark's position is known exactly",
)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## The innovation and its covariance
#
# The innovation covariance is a sum of five terms. In localisation and in mapping with known poses, three of
# the five terms are zero.
#
# The robot estimates its pose as $\hat x$ and the position of landmark $i$ as $\hat p_i$. It measures
# $z = h(x, p_i) + \varepsilon$, where $\varepsilon$ has the covariance $R$. With the errors
# $\tilde x = x - \hat x$ and $\tilde p_i = p_i - \hat p_i$, the linearised innovation is
#
# $$v = z - h(\hat x, \hat p_i) \approx H_{\mathrm r}\,\tilde x + H_{\mathrm p}\,\tilde p_i +
# \varepsilon. \tag{05.1}$$
#
# Lesson 04 derived the Jacobians $H_{\mathrm r}$ (robot) and $H_{\mathrm p}$ (landmark). So three errors
# contribute to one innovation. We assume that the noise $\varepsilon$ is independent of the other two errors.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-the-innovation-and-its-covariance"
# *For the lecturer:* Let the class name the terms that vanish with an exact map before the computer
# simplifies (05.2). Keep the answer to the *Your turn*, $2R$, on the board: the last section needs it.

# %% [markdown] slideshow={"slide_type": "subslide"}
# How large is the innovation typically? We stack the two errors in one column vector. The covariance of this
# vector has four blocks: $P_{\mathrm{rr}}$ of the robot, $P_{ii}$ of the landmark, the **cross-covariance**
# $P_{\mathrm ri}$ of the two, and its transpose.

# %% slideshow={"slide_type": "fragment"}
P_rr, P_ii, R_ = symmetric("P_rr", 3), symmetric("P_ii", 2), symmetric("R", 2)
P_ri = sp.MatrixSymbol("P_ri", 3, 2)
H_r, H_p = sp.MatrixSymbol("H_r", 2, 3), sp.MatrixSymbol("H_p", 2, 2)
H = sp.BlockMatrix([[H_r, H_p]])
P = sp.BlockMatrix([[P_rr, P_ri], [P_ri.T, P_ii]])

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
S_steps = (
    derive("S", H * P * H.T + R_, "the covariance of v: H P Hᵀ + R, as in lesson 03")
    .step("multiply block by block", blockwise)
    .step("expand the products", sp.expand)
)
S_steps

# %% [markdown] slideshow={"slide_type": "subslide"}
# The pose, the landmark, their cross-covariance (twice) and the sensor each contribute one term to
# the innovation covariance:
#
# $$S = H_{\mathrm r} P_{\mathrm{rr}} H_{\mathrm r}^{\mathsf T} + H_{\mathrm r} P_{\mathrm ri}
# H_{\mathrm p}^{\mathsf T} + H_{\mathrm p} P_{\mathrm ri}^{\mathsf T} H_{\mathrm r}^{\mathsf T} +
# H_{\mathrm p} P_{ii} H_{\mathrm p}^{\mathsf T} + R. \tag{05.2}$$
#
# As an example, the robot below has a σ of 0.2 m in $x$ and $y$, and of 0.1 rad in the heading. It has just
# initialised a landmark from one measurement (lesson 04), so the errors of pose and landmark are correlated.

# %% slideshow={"slide_type": "fragment"} tags=["code"]
x_here, z_here, R = np.array([0.5, 0.2, 0.4]), np.array([1.9, 0.3]), ekf_runs.R(run)
P_robot = np.diag([0.2, 0.2, 0.1]) ** 2
J_xr, J_z = jacobians.J_xr(x_here, z_here), jacobians.J_z(x_here, z_here)
P_landmark, P_cross = J_xr @ P_robot @ J_xr.T + J_z @ R @ J_z.T, P_robot @ J_xr.T
p_here = models.g(x_here, z_here)
H_robot, H_mark = jacobians.H_robot(x_here, p_here), jacobians.H_landmark(x_here, p_here)
H_both = np.hstack([H_robot, H_mark])
S_joint = H_both @ np.block([[P_robot, P_cross], [P_cross.T, P_landmark]]) @ H_both.T + R
print("variance of the range: ", np.round(S_joint[0, 0], 4), "m², of which R:", R[0, 0].round(4))

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** Compute the innovation covariance (05.2) from `H_robot`, `H_mark`, `P_robot`,
# `P_cross`, `P_landmark` and `R`, term by term.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
S_terms = ...  # five terms
compare(S_terms, S_joint)

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# S_terms = H_robot @ P_robot @ H_robot.T + H_robot @ P_cross @ H_mark.T
# S_terms = S_terms + H_mark @ P_cross.T @ H_robot.T + H_mark @ P_landmark @ H_mark.T + R
# ```
#
# The result is $2R$. The robot computed the landmark's position from this pose, so the error of the pose
# cancels in the innovation. Only the noise of the two measurements remains. The last part of this lesson uses
# this result.
#
# </details>

# %% [markdown] slideshow={"slide_type": "subslide"}
# A quantity that is known exactly has no error, and hence no covariance with any other quantity. So we set
# blocks of $P$
# to zero, and the computer simplifies (05.2).


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="05-unknown"
def left_of(expression, *known):
    zeros = {block: sp.ZeroMatrix(*block.shape) for block in known}
    return sp.expand(expression.subs(zeros).doit())


print("map known:  S =", left_of(S_steps.result, P_ii, P_ri))
print("pose known: S =", left_of(S_steps.result, P_rr, P_ri))

# %% [markdown] slideshow={"slide_type": "subslide"}
# $$S = H_{\mathrm r} P_{\mathrm{rr}} H_{\mathrm r}^{\mathsf T} + R \;\text{ (map known)}, \qquad
# S = H_{\mathrm p} P_{ii} H_{\mathrm p}^{\mathsf T} + R \;\text{ (pose known)} \tag{05.3}$$
#
# In both cases one covariance and $R$ remain. These two problems are easy because the cross-covariance is zero:
# a small filter for the pose alone, or for one landmark alone, then loses no information. The MAK thesis calls
# such an innovation
# *constrained*, COIN for short.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## EKF localisation in a known map
#
# The state is the pose, which has three components. The **prediction** uses the odometry: a motion $o$ in the robot's
# own frame. Lesson 04's $A$ is valid for each such motion (the first section under *Deeper* shows why):
#
# $$\hat x \leftarrow \hat x \oplus o, \qquad P_{\mathrm{rr}} \leftarrow A P_{\mathrm{rr}} A^{\mathsf T} + Q, \qquad
# A = \begin{bmatrix} 1 & 0 & -\Delta y \\ 0 & 1 & \Delta x \\ 0 & 0 & 1 \end{bmatrix}. \tag{05.4}$$
#
# Here $(\Delta x, \Delta y)$ is the displacement in the world frame, and $Q = W C W^{\mathsf T}$ is the
# process noise of the odometry. As $\det A = 1$ and $Q$ is added, no prediction ever lowers the
# determinant of $P_{\mathrm{rr}}$.

# %% [markdown] slideshow={"slide_type": "subslide"}
# The **update** lowers this determinant. In a known map, the update of lesson 03 with the $S$ of (05.3) becomes
#
# $$S = H_{\mathrm r} P_{\mathrm{rr}} H_{\mathrm r}^{\mathsf T} + R, \quad
# K = P_{\mathrm{rr}} H_{\mathrm r}^{\mathsf T} S^{-1}, \quad
# \hat x \leftarrow \hat x + K v, \quad
# P_{\mathrm{rr}} \leftarrow P_{\mathrm{rr}} - K S K^{\mathsf T}. \tag{05.5}$$
#
# $H_{\mathrm r}$ is linearised at the predicted $\hat x$, and the bearing in $v$ is wrapped, as in
# lesson 04. A step without a measurement consists of the prediction only.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask which of the two equations can make the ellipse grow. Then ask why (05.5) cannot. (The
# matrix $K S K^{\mathsf T}$ is positive semidefinite.) After the figure of the laps, ask why the ellipses
# without a map shrink on the way back. (The error of the heading at the start rotates the whole lap about the
# start.)

# %% [markdown] slideshow={"slide_type": "subslide"}
# > **Algorithm: EKF localisation** with known correspondences (Leonard and Durrant-Whyte 1991;
# > *Probabilistic Robotics*, table 7.2)
# >
# > **Input:** belief $\hat x$, $P_{\mathrm{rr}}$; odometry $o$ with $Q$; measurements $z_i$ with $R$;
# > feature map with the positions $p_i$
# >
# > 1. Predict the pose: $\hat x \leftarrow \hat x \oplus o$.
# > 2. Predict its covariance: $P_{\mathrm{rr}} \leftarrow A P_{\mathrm{rr}} A^{\mathsf T} + Q$, (05.4).
# > 3. For each measured landmark $i$ of the map, take $H_{\mathrm r}$ at $(\hat x, p_i)$ and the
# >    innovation $z_i - h(\hat x, p_i)$. Wrap its bearing. Stack them into one $H_{\mathrm r}$ and one
# >    $v$, with a block-diagonal $R$. (Table 7.2 updates with one landmark at a time.)
# > 4. Innovation covariance: $S = H_{\mathrm r} P_{\mathrm{rr}} H_{\mathrm r}^{\mathsf T} + R$.
# > 5. Kalman gain: $K = P_{\mathrm{rr}} H_{\mathrm r}^{\mathsf T} S^{-1}$.
# > 6. Update: $\hat x \leftarrow \hat x + K v$, $P_{\mathrm{rr}} \leftarrow P_{\mathrm{rr}} - K S K^{\mathsf T}$,
# >    (05.5). Wrap the heading.
# >
# > **Output:** belief $\hat x$, $P_{\mathrm{rr}}$ after the motion and its measurements

# %% slideshow={"slide_type": "subslide"} tags=["code"]
P_START = np.diag([0.2, 0.2, 0.1]) ** 2
START = Belief(np.random.default_rng(5).multivariate_normal(np.zeros(3), P_START), P_START)
reading = list(run)[1]
motion, seen = reading.odometry, reading.observations
x_predicted = compose(START.x, motion)
dx, dy = x_predicted[:2] - START.x[:2]
A, Q = np.array([[1, 0, -dy], [0, 1, dx], [0, 0, 1]]), Q_arc(START.x, motion, run.robot)
predicted = ekf_localisation.predict(START, x_predicted, A, Q)
corrected, _ = ekf_localisation.update(predicted, seen.z, run.landmarks[seen.ids], R)
for name, b in {"start": START, "predicted": predicted, "updated": corrected}.items():
    print(f"{name:10} σ of x, y [m] and θ [rad]:", np.sqrt(np.diag(b.P)).round(3))

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** Predict the covariance of this first step from `A`, `START.P` and `Q`. (The function
# `ekf_runs.locate` repeats such steps over a whole run. In the exercise you write your own version,
# `localise`; its `locate` is a single update.)

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
P_predicted = ...
compare(P_predicted, predicted.P)

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# P_predicted = A @ START.P @ A.T + Q
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Localisation over a lap

# %% [markdown] slideshow={"slide_type": "notes"} name="note-localisation-over-a-lap"
# *For the lecturer:* Students who remember lesson 01 answer "at the end". In the right panel, point at the
# longest ellipse and ask where the nearest landmark is.

# %% slideshow={"slide_type": "fragment"}
ask(
    "05-largest",
    "The robot drives the lap and knows the whole map. Where on the lap are its ellipses largest?",
    {
        "at the end, because errors add up": "errors of the odometry add up, but each "
        "measurement of a known landmark corrects them, at any distance from the start.",
        "where it has measured no landmark for a while": "between measurements there are only "
        "predictions (05.4), and the ellipse grows; the next update makes it small again.",
        "they are equally large everywhere": "this would require measurements at every step that "
        "determine the pose equally well.",
    },
    right="where it has measured no landmark for a while",
)


# %% slideshow={"slide_type": "subslide"} answers="05-largest" tags=["folded"]
whole_map = dict(enumerate(run.landmarks))
poses, P_poses = ekf_runs.locate(run, whole_map, START)
without_map, P_without = ekf_runs.locate(run, {}, START)


def lap(run, poses, P, name="corrected", every=3):
    return [
        Poses("truth", run.truth.poses),
        Poses(name, poses),
        Ellipses("robot", poses[::every, :2], P[::every, :2, :2]),
        Points("landmark", run.landmarks),
    ]


laps = {
    "no map: prediction only": lap(run, without_map, P_without, "predicted"),
    "whole map known": lap(run, poses, P_poses),
}
fig, _ = views.side_by_side(laps, size=(9.5, 5.2))
longest = [ekf_runs.ellipse_length(P[5:]).max() for P in (P_without, P_poses)]  # after the start
views.show(
    fig,
    f"Without a map the confidence ellipses grow to a length of {longest[0]:.1f} m, with the map to "
    f"{longest[1]:.1f} m.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="05-largest"
# Each ellipse contains the true position with a probability of 95 %, if the errors are Gaussian and $P$
# is right. Without a map the ellipses grow to a length of {= longest[0]:.1f =} m on the far side of the
# lap. (On the way back they shrink again. Most of the uncertainty comes from the heading at the start: the
# heading error rotates the whole lap about the start.) With the map the longest ellipse after the start is
# {= longest[1]:.1f =} m long, at a position without near landmarks. The last ellipse is
# {= ekf_runs.ellipse_length(P_poses)[-1]:.1f =} m long.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** Compute the length of the last ellipse, from end to end, from `P_last`. Along the long
# axis the variance is the largest eigenvalue of the position's 2 × 2 block. By lesson 04 the 95 % ellipse
# extends $2.45\,\sigma$ (more precisely, $2.4477\,\sigma$) from its centre to either side.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
P_last = P_poses[-1, :2, :2]
length = ...  # np.linalg.eigvalsh returns the eigenvalues in rising order
compare(length, ekf_runs.ellipse_length(P_last))

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# P_last = P_poses[-1, :2, :2]
# length = 2 * 2.4477 * np.sqrt(np.linalg.eigvalsh(P_last)[-1])
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## Localisation in a partial map
#
# The map may contain only some of the landmarks, and the sensor may have a shorter or a longer range.
# Move a slider and observe where the ellipses grow.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-localisation-in-a-partial-map"
# *For the lecturer:* Set the number of landmarks to zero and ask which picture this is. (The left panel of
# the slide before.) If time is short, skip this section.


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
def in_part_of_a_map(landmarks_in_the_map, sensor_range):
    run = simulated_run(74, replace(LAP, range_max=sensor_range))
    part = dict(list(whole_map.items())[:landmarks_in_the_map])
    poses, P = ekf_runs.locate(run, part, START)
    title = f"longest 95 % ellipse {ekf_runs.ellipse_length(P[5:]).max():.1f} m"
    fig, ax = views.axes(title, size=(8, 5.5))
    for layer in lap(run, poses, P)[:3]:
        views.draw(ax, layer)
    marks, grey = Points("landmark", run.landmarks), views.COLOURS["before"]
    views.draw(ax, marks, color=grey, label="not in the map")
    views.draw(ax, Points("landmark", np.reshape([*part.values()], (-1, 2))), label="in the map")
    views.legend(ax, loc="center")
    return fig


# %% slideshow={"slide_type": "fragment"}
views.explore(
    in_part_of_a_map,
    lambda landmarks_in_the_map, sensor_range: (
        f"With {landmarks_in_the_map} landmarks in the map and a sensor range of "
        f"{sensor_range:.1f} m the ellipses are small near landmarks of the map and grow elsewhere."
    ),
    landmarks_in_the_map=(0, 8, 4),
    sensor_range=(1.0, 5.0, 2.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# With the upper four of the eight landmarks in the map, the covariance of the pose grows and shrinks. It grows
# at the lower right, where no landmark of the map is within range, and shrinks at the first landmark within
# range. So the covariance of a *pose* can grow. The covariance of a stationary landmark never grows, as the
# second half shows.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## One landmark: an unobservable direction
#
# A measurement has two components, and a pose has three.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-one-landmark-an-unobservable-direction"
# *For the lecturer:* Walk round a chair and always face it: your measurement does not change. Ask the class
# for the three components of this motion; they are (05.7).

# %% slideshow={"slide_type": "fragment"}
ask(
    "05-circle",
    "A robot has no prior for its position, and only a rough prior for its heading. It measures "
    "range and bearing of **one** known landmark, 2 m away. Where may the robot be?",
    {
        "at one point: range and bearing determine it": "this would require an exactly known heading, "
        "because the bearing is relative to the heading.",
        "on an arc around the landmark": "the range gives the distance to the landmark, and the "
        "bearing only gives the heading relative to the line to the landmark.",
        "in a disc around the landmark": "the range has a σ of a decimetre, so the robot cannot be "
        "inside the disc.",
    },
    right="on an arc around the landmark",
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# Lesson 03 showed that information, the inverse of a covariance, adds up. A measurement adds the second term to
# the information on the pose:
#
# $$P_{\text{after}}^{-1} = P_{\text{before}}^{-1} + H_{\mathrm r}^{\mathsf T} R^{-1} H_{\mathrm r}.
# \tag{05.6}$$
#
# In a direction $n$ with $H_{\mathrm r}\, n = 0$ the second term is zero: the measurement gives no information
# about this direction. Such a direction is **unobservable** from this measurement. An unobservable direction
# exists because $H_{\mathrm r}$ has two rows and three columns.

# %% slideshow={"slide_type": "fragment"} tags=["folded"]
x_one, p_one = np.array([1.0, 0.0, 0.3]), np.array([3.0, 1.0])
null = np.linalg.svd(jacobians.H_robot(x_one, p_one))[2][-1]
null = null / null[2]

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** The robot is at $(1, 0)$, the landmark at $(3, 1)$. Which small motion of the robot
# changes neither range nor bearing? Give its direction $n$ as `[x, y, θ]`, with $\theta = 1$.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
n_here = ...  # a list of three numbers; the last one is 1
compare(n_here, null)

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# n_here = [1, -2, 1]
# ```
#
# To keep the range, the robot moves at right angles to the vector to the landmark, which is $(2, 1)$. To keep
# the bearing, the robot turns as well. A rotation by a small angle $\theta$ about the landmark moves the robot
# by $\theta\,(1, -2)$.
#
# </details>

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
x, y, theta, p_x, p_y = sp.symbols("x y theta p_x p_y", real=True)
h_ = sp.Matrix([sp.sqrt((p_x - x) ** 2 + (p_y - y) ** 2), sp.atan2(p_y - y, p_x - x) - theta])
n = sp.Matrix([p_y - y, x - p_x, 1])
H_n = derive("H n", h_.jacobian([x, y, theta]) * n, "Jacobian of h by the pose, times n")
H_n.step("simplify", sp.simplify)

# %% [markdown] slideshow={"slide_type": "fragment"}
# $$H_{\mathrm r}\, n = 0 \quad\text{for}\quad n = (p_y - y,\; x - p_x,\; 1)^{\mathsf T} \tag{05.7}$$
#
# This $n$ is a rotation of the robot *about* the landmark: a step on a circle around the landmark, with the
# turn that keeps the bearing. This rotation does not change the measurement.

# %% slideshow={"slide_type": "subslide"}
# one update by range and bearing, and samples of the posterior without linearisation
CORNER, prior_mean = np.array([[1.7, 1.0], [0.4, -1.6], [-1.5, 0.8]]), np.array([0, 0, 0.3])


def where_may_it_be(landmarks_measured, heading_sigma):
    marks, rng = CORNER[:landmarks_measured], np.random.default_rng(5)
    z = models.h(prior_mean, marks)
    b = Belief(prior_mean, np.diag([5, 5, heading_sigma]) ** 2)
    b, _ = ekf_localisation.update(b, z, marks, R)
    samples = pose_posterior_samples.sample_posterior(
        marks, z, prior_mean[2], heading_sigma, R, rng
    )
    return marks, b, samples


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
def draw_where(**values):
    marks, b, samples = where_may_it_be(**values)
    layers = {
        "samples of the posterior": Points("sample", samples[:400, :2]),
        "EKF, 95 % ellipse": Ellipses("corrected", [b.x[:2]], [b.P[:2, :2]]),
        "landmark": Points("landmark", marks),
    }
    share = 100 * pose_posterior_samples.share_in_ellipse(b, samples)
    return views.side_by_side(
        {f"{share:.0f} % of the samples lie in the ellipse": layers}, (8, 5.5)
    )[0]


# %% slideshow={"slide_type": "fragment"} answers="05-circle"
# where the robot may be
views.explore(
    draw_where,
    lambda landmarks_measured, heading_sigma: (
        f"Landmarks measured: {landmarks_measured}, prior σ of the heading {heading_sigma:.2f} rad: "
        "the samples of the posterior form an arc around a single landmark, and a spot with two "
        "or more."
    ),
    landmarks_measured=(1, 3, 1),
    heading_sigma=(0.02, 1.5, 0.5),
)
held = {s: pose_posterior_samples.share_in_ellipse(*where_may_it_be(1, s)[1:]) for s in (0.1, 1.5)}

# %% [markdown] slideshow={"slide_type": "fragment"} answers="05-circle"
# With one landmark the samples of the posterior, drawn without linearisation, lie on an arc. The filter's 95 %
# ellipse is narrow towards the landmark and long in the unobservable direction of (05.7). With a second
# landmark, the samples form a small spot.
#
# Now select one landmark again and change the prior of the heading. The samples lie on a curved arc, which an
# ellipse cannot represent.
# With a prior σ of 0.1 rad the 95 % ellipse contains {= 100 * held[0.1]:.0f =} % of the samples, with a prior σ
# of 1.5 rad only {= 100 * held[1.5]:.0f =} %: the linearisation error is too large.

# %% [markdown] slideshow={"slide_type": "subslide"}
# An EKF therefore needs a prior near the true pose. Localisation with such a prior is called **pose tracking**
# (also *position tracking*). Localisation without such a prior is **global localisation**. One method is to try
# several headings and to keep the heading that agrees with the measurements, as in the exercise. Lesson 11 uses
# particles for global localisation.
#
# The filter (05.5) also works with other measurements than range and bearing. Another sensor has another
# measurement model $h$.
# Its Jacobian $H_{\mathrm r}$ has one row for each number measured, and $R$ is the covariance of that
# sensor's noise. If a sensor measures only the distance to a beacon, $H_{\mathrm r}$ has one row, so *two*
# directions are unobservable from this measurement.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Consistency, and an error in the map
#
# One lap is not a proof. We simulate 40 laps, each with its own landmarks, noise and start, and compute the
# NEES at every step: the squared error of the pose, normalised by its covariance. For a consistent filter, the
# expected value of the NEES is 3, the number of components of the pose.


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
def localised_laps(off, count):
    return ekf_runs.localised_laps(LAP, P_START, off, count)


exact, (low, high) = ekf_runs.mean_nees(localised_laps(0, 40)), band(3, 40)
within = np.mean((exact > low) & (exact < high))
print(
    f"mean NEES {exact.mean():.2f}; from {low:.2f} to {high:.2f} at {100 * within:.0f} % of the steps"
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# These laps give no evidence that the filter is inconsistent. (The 95 % χ² interval applies to each single
# step. Errors of neighbouring steps are correlated, so the share of steps inside the interval need not be 95
# %.)

# %% slideshow={"slide_type": "subslide"}
ask(
    "05-wrong-map",
    "Now the map is wrong: each landmark is 0.3 m from its position in the map, each in a different "
    "direction. The filter still treats the map as exact. The σ of the range is 0.1 m. How does "
    "the NEES change?",
    {
        "it stays near 3: errors average out": "the noise differs at each measurement and averages "
        "out; an error of the map is the same every time.",
        "it rises at first, then returns to 3": "this would require a map with a covariance that "
        "could grow; in this filter it is zero.",
        "it rises far above 3 and stays there": "each update lowers the covariance, although the "
        "estimated position has an error of a few decimetres.",
    },
    right="it rises far above 3 and stays there",
)


# %% slideshow={"slide_type": "fragment"}
# the mean NEES of laps whose map is wrong by some metres
@cache
def nees_off_by(metres):
    return ekf_runs.mean_nees(localised_laps(metres, 20))


def wrong_map(landmarks_off_by):
    wrong = nees_off_by(landmarks_off_by)
    name = f"map off by {landmarks_off_by:.2f} m"
    values = {"exact map": exact, name: wrong}
    title, steps = f"{name}: mean NEES {wrong.mean():.1f}", np.arange(len(run))
    return views.against_band(steps, values, (low, high), "step", "mean NEES [1]", title)[0]


# %% slideshow={"slide_type": "fragment"} answers="05-wrong-map"
views.explore(
    wrong_map,
    lambda landmarks_off_by: (
        f"NEES with an exact map and with landmarks off by {landmarks_off_by:.2f} m. With the exact map "
        "the NEES stays in the χ² interval; it grows with the error of the landmarks."
    ),
    landmarks_off_by=(0.0, 0.5, 0.3),
)
off = {metres: nees_off_by(metres).mean() for metres in (0.05, 0.3)}

# %% [markdown] slideshow={"slide_type": "fragment"} answers="05-wrong-map"
# The scale is logarithmic. If the landmarks are wrong by 0.3 m, the NEES is {= off[0.3]:.0f =} on average
# instead of 3, and it stays high: with $P_{ii} = 0$ the filter treats every landmark as exact. The filter is **overconfident**.
# Even with a map error of 0.05 m, half the σ of the range, the NEES is {= off[0.05]:.1f =}.
#
# **No real map is exact.** So landmarks need covariances, too. The second half derives these covariances.

# %% [markdown] slideshow={"slide_type": "subslide"}
# A robot cannot compute the NEES, because it does not know its true pose. But it can compute the NIS,
# $v^{\mathsf T} S^{-1} v$ (lesson 03), from the $v$ and $S$ of (05.5). If the NIS is far above its χ² interval,
# the pose, the map, a covariance or the measurement itself (an *outlier*) is wrong.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* A student may propose a larger $R$. A larger $R$ helps to some extent. But $R$ describes
# noise that is independent at each measurement: thirty measurements average out this noise, but not the error
# of a wrong map.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Mapping with known poses
#
# Now the poses are known exactly, for example from a camera on the ceiling, and the feature map is the state.
# When the robot measures a landmark for the first time, the inverse measurement model $g$ gives its position.
# This step is called **landmark initialisation**. The pose has no error, so the covariance contains only the
# measurement noise, propagated by the $J_z$ of lesson 04:
#
# $$\hat p_i = g(x, z), \qquad P_{ii} = J_z R J_z^{\mathsf T}. \tag{05.8}$$
#
# At every later measurement (05.5) updates this estimate, with $H_{\mathrm p}$ and $P_{ii}$ in place of
# $H_{\mathrm r}$ and $P_{\mathrm{rr}}$. The filter needs no prediction, because landmarks do not move.
#
# $N$ landmarks have $2N$ coordinates. Does the filter need a covariance of size $2N \times 2N$?

# %% [markdown] slideshow={"slide_type": "notes"} name="note-mapping-with-known-poses"
# *For the lecturer:* Many students answer "slightly better", because the landmarks are close to each other.
# Ask which error the two estimates have in common. (None, since the poses are exact.)

# %% slideshow={"slide_type": "subslide"}
ask(
    "05-cross",
    "The poses are known. The robot has measured landmarks 1 and 2, which are close to each other. "
    "Now it measures landmark 1 again. What happens to the estimate of landmark 2?",
    {
        "it becomes slightly better": "this would require correlated errors; but each landmark was "
        "initialised from an exact pose by a measurement with its own noise.",
        "it does not change": "their errors are uncorrelated, so a measurement of one gives no "
        "information about the other.",
        "it becomes worse: its information is diluted": "a measurement never reduces the information.",
    },
    right="it does not change",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The gain is $K = P H^{\mathsf T} S^{-1}$. So a measurement of $i$ corrects the parts of the state whose rows
# of $P H^{\mathsf T}$ are not zero. The rows belong to the robot, to landmark $i$ itself, and to any other
# landmark $j$.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="05-cross"
P_jr, P_ji = sp.MatrixSymbol("P_jr", 2, 3), sp.MatrixSymbol("P_ji", 2, 2)
columns = sp.BlockMatrix([[P_rr, P_ri], [P_ri.T, P_ii], [P_jr, P_ji]])
gain_steps = derive("P Hᵀ", columns * H.T, "rows: the robot, i, j").step("by blocks", blockwise)
gain_steps

# %% [markdown] slideshow={"slide_type": "fragment"}
# With the pose known, $P_{j\mathrm r} = 0$, and row $j$ is $P_{ji} H_{\mathrm p}^{\mathsf T}$. The update
# therefore changes the cross-covariance of two landmarks by
#
# $$P_{ji} \leftarrow P_{ji} - P_{ji} H_{\mathrm p}^{\mathsf T} S^{-1} H_{\mathrm p} P_{ii}. \tag{05.9}$$
#
# If $P_{ji}$ is zero, it stays zero. At the beginning $P_{ji}$ is zero, because each landmark is initialised by
# a separate measurement with independent noise, from a pose without error. **So one filter of size $2N$
# separates into $N$ filters of size 2**, and the time per measurement does not depend on the size of the
# map.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## How the covariance of a landmark shrinks

# %% [markdown] slideshow={"slide_type": "notes"} name="note-how-the-covariance-of-a-landmark-shrinks"
# *For the lecturer:* The usual wrong answer is 64, the factor of the variance. Ask what would change if the
# noise were the same each time.


# %% slideshow={"slide_type": "fragment"}
# the map after landmark initialisation, and after the whole lap
def mean_length(found):
    return np.mean([ekf_runs.ellipse_length(b.P) for b in found.landmarks.values()])


first, whole = KnownPoseMap(), ekf_runs.map_from_poses(run, run.truth.poses)
for x, id, z in ekf_runs.single_observations(run, run.truth.poses):
    if id not in first.landmarks:
        first.update(x, id, z, R)


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
def drawn(found, poses, name="truth"):
    ellipses = Ellipses("landmark", found.points(), [b.P for b in found.landmarks.values()])
    return [Poses(name, poses), ellipses, Points("truth", run.landmarks)]


def crossed(ax):
    ax.lines[-1].set(marker="x", markersize=7, markeredgewidth=1.5, label="true landmark")


maps = {"after landmark initialisation": first, "after the whole lap": whole}
layers = {title: drawn(found, run.truth.poses) for title, found in maps.items()}
fig, both = views.side_by_side(layers, size=(9.5, 5.2))
at_first, at_last = (mean_length(found) for found in maps.values())
both[0].set(xlim=(-6.5, -3.6), ylim=(3.1, 6.0))  # two of the eight
for ax in both:
    crossed(ax)
views.legend_below(fig)
views.show(
    fig,
    "Two of the eight landmarks: confidence ellipses after landmark initialisation and after the lap. "
    f"The mean length of all eight shrinks from {at_first:.2f} m to {at_last:.2f} m.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The figure shows two of the eight landmarks. After landmark initialisation the 95 % ellipses of all eight
# landmarks are {= at_first:.2f =} m long on average, and after the lap {= at_last:.2f =} m. The ellipse of a
# landmark never grows: (05.5) subtracts $K S K^{\mathsf T}$, and no prediction adds process noise.

# %% slideshow={"slide_type": "subslide"}
ask(
    "05-root",
    "A robot stands still, at a known pose, and measures one landmark 64 times, with independent "
    "noise. By what factor is its σ smaller after 64 measurements than after the first?",
    right=8,
    tolerance=0.5,
    reason="the variance falls as 1/k, like that of the mean of k numbers, and σ is its root.",
    wrong={
        64: "this is the factor of the variance; σ is its root.",
        1: "this would be right if the noise were the same at every measurement.",
        4096: "this would be a variance that falls as 1/k⁴, but variances fall as 1/k.",
    },
)

# %% slideshow={"slide_type": "fragment"}
# 100 robots measure one landmark 64 times
at, mark, counts = np.array([0.5, 0.2, 0.4]), np.array([2.0, 1.5]), [1, 2, 4, 8, 16, 32, 64]
rng, squared = np.random.default_rng(1), np.zeros((100, 64))
for errors in squared:
    found = KnownPoseMap()
    for k, eps in enumerate(rng.multivariate_normal([0, 0], R, 64)):
        found.update(at, 0, models.h(at, mark) + eps, R)
        errors[k] = np.sum((found.landmarks[0].x - mark) ** 2)
mean_squared = squared.mean(axis=0)[np.array(counts) - 1]

# %% slideshow={"slide_type": "fragment"} answers="05-root" tags=["folded"]
J = jacobians.J_z(at, models.h(at, mark))
variance_once = np.trace(J @ R @ J.T)
fig, ax = views.growth(
    counts,
    {"mean squared error of 100 robots": mean_squared},
    {"trace of (05.10)": variance_once / np.array(counts)},
    "measurements k",
    "squared error [m²]",
    size=(8, 4),
)
views.show(
    fig,
    f"The squared errors follow a line that falls as one over k, over {counts[-1]} measurements.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The mean squared errors of 100 robots follow a line that falls as $1/k$. After $k$ measurements from one pose,
# the covariance is
#
# $$P_{ii} \approx \tfrac{1}{k}\, J_z R J_z^{\mathsf T}, \tag{05.10}$$
#
# since (05.6), with $H_{\mathrm p} = J_z^{-1}$, adds the same information each time. After 64 measurements
# $\sigma$ is smaller by a factor of 8 than after the first. The root-mean-square error of these 100 robots is
# smaller by a factor of
# {= np.sqrt(mean_squared[0] / mean_squared[-1]):.1f =}.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Mapping as weighted least squares
#
# The filter processes one measurement after another. **Batch least squares** keeps all measurements and
# computes the estimate from all of them at once. For one landmark, it computes the $p$ that minimises the cost
#
# $\displaystyle \quad \chi^2(p) = \sum_k e_k^{\mathsf T} R^{-1} e_k, \qquad e_k = z_k - h(x_k, p).$
#
# For independent Gaussian noise this $p$ maximises the likelihood: it is the *maximum-likelihood* estimate.
# We linearise each residual at the current $\bar p$: a step $\delta$ changes $e_k$ to
# $v_k - H_k \delta$, with the innovation $v_k$ and the Jacobian $H_k = H_{\mathrm p}$ at $\bar p$. The
# gradient of the linearised cost is zero where
#
# $\displaystyle \quad \Bigl(\sum_k H_k^{\mathsf T} R^{-1} H_k\Bigr)\,\delta = \sum_k H_k^{\mathsf T} R^{-1} v_k.$

# %% [markdown] slideshow={"slide_type": "notes"} name="note-mapping-as-weighted-least-squares"
# *For the lecturer:* If your students know least squares from statistics, begin with the normal equations and
# present the filter as their recursive form. If time is short, leave out this section.

# %% [markdown] slideshow={"slide_type": "fragment"}
# These equations are called the *normal equations*. Their matrix is the sum of the information in (05.6), with
# $H_{\mathrm p}$ in place of $H_{\mathrm r}$. A filter that stores this sum (and the sum on the right-hand side) instead of $P$ and $\hat p$ is an **information filter**: its update is an addition.


# %% slideshow={"slide_type": "subslide"} tags=["code"]
def normal_equations(p, poses, zs):
    """Matrix (2, 2) and right side (2,) of the normal equations of one landmark at p."""
    matrix, right_side = np.zeros((2, 2)), np.zeros(2)
    for x, z in zip(poses, zs, strict=True):
        H_k, v_k = jacobians.H_landmark(x, p), difference(z, models.h(x, p))
        matrix += H_k.T @ np.linalg.inv(R) @ H_k
        right_side += H_k.T @ np.linalg.inv(R) @ v_k
    return matrix, right_side


measured = [(x, z) for x, id, z in ekf_runs.single_observations(run, run.truth.poses) if id == 3]
poses_3, zs_3 = zip(*measured, strict=True)
p_bar = models.g(poses_3[0], zs_3[0])  # from the first measurement
matrix, right_side = normal_equations(p_bar, poses_3, zs_3)

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** Compute the step $\delta$ that solves the normal equations, from `matrix` and
# `right_side`.

# %% slideshow={"slide_type": "-"} tags=["folded"]
# the same step without normal equations: one system with all rows, each divided by its σ
sigmas = np.tile(np.sqrt(np.diag(R)), len(zs_3))
rows = np.vstack([jacobians.H_landmark(x, p_bar) for x in poses_3]) / sigmas[:, None]
residuals = np.hstack([difference(z, models.h(x, p_bar)) for x, z in measured]) / sigmas
delta_stacked = np.linalg.lstsq(rows, residuals)[0]

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
delta = ...
compare(delta, delta_stacked)

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# delta = np.linalg.solve(matrix, right_side)
# ```
#
# </details>

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
for _ in range(5):  # Gauss–Newton: linearise again at the new position
    matrix, right_side = normal_equations(p_bar, poses_3, zs_3)
    p_bar = p_bar + np.linalg.solve(matrix, right_side)
filtered = whole.landmarks[3]
sigma = [np.sqrt(np.trace(P)) for P in (np.linalg.inv(matrix), filtered.P)]
print(f"{len(zs_3)} measurements; batch and filter differ by", end=" ")
print(f"{1000 * np.hypot(*(filtered.x - p_bar)):.1f} mm; √trace P: ", end="")
print(" and ".join(f"{1000 * s:.1f} mm" for s in sigma))

# %% [markdown] slideshow={"slide_type": "fragment"}
# Batch least squares and filter add the same information and differ only in the linearisation. The filter linearises
# each measurement once, at the current estimate; the batch linearises all of them again in each
# iteration.
#
# A filter estimates the current state from the measurements so far: **filtering**. An estimate of earlier
# states that also uses later measurements is **smoothing**, and a batch over all poses is a smoother. For a
# stationary landmark, filter and smoother agree at the end of the run, apart from the linearisation. For the
# earlier poses of a moving robot they differ: a section under *Deeper* smooths our lap.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## Mapping from poses with errors

# %% [markdown] slideshow={"slide_type": "notes"} name="note-mapping-from-poses-with-errors"
# *For the lecturer:* Most students expect larger ellipses. Ask which symbol in (05.8) contains the error of
# the pose. (None does.)

# %% slideshow={"slide_type": "fragment"}
ask(
    "05-trust",
    "We map the landmarks once more, but from the poses of the odometry, as if they were exact. "
    "How do the ellipses of the landmarks change?",
    {
        "they grow, because the poses are worse": "the errors of the poses do not enter the "
        "filter: it computes P from R, the Jacobians and the number of measurements.",
        "they stay nearly the same": "P depends on R and the Jacobians, but not on the errors of "
        "the poses.",
        "they shrink": "the number of measurements is the same as before.",
    },
    right="they stay nearly the same",
)


# %% slideshow={"slide_type": "subslide"} tags=["folded"]
def from_wrong_poses(share_of_the_odometry_error):
    error_of_poses = ekf_runs.pose_errors(run, odometry_poses)
    believed = run.truth.poses + share_of_the_odometry_error * error_of_poses
    nees_of_map = ekf_runs.landmark_nees(run, believed)
    title = f"mean NEES of a landmark {nees_of_map:.0f}; 2 is consistent"
    fig, ax = views.axes(title, size=(8, 5.5))
    for layer in drawn(ekf_runs.map_from_poses(run, believed), believed, "naive"):
        views.draw(ax, layer)
    ax.lines[0].set_label("poses treated as exact")
    crossed(ax)
    views.legend(ax, loc="center")
    return fig


def missed(found):
    """How many landmarks lie outside their 95 % ellipse."""
    pairs = [(b.x - run.landmarks[id], b.P) for id, b in found.landmarks.items()]
    return sum(e @ np.linalg.solve(P, e) > 5.991 for e, P in pairs)


# %% slideshow={"slide_type": "fragment"} answers="05-trust"
views.explore(
    from_wrong_poses,
    lambda share_of_the_odometry_error: (
        f"The map from poses with {100 * share_of_the_odometry_error:.0f} % of the odometry's error: "
        "small ellipses beside the crosses of the true landmarks; without errors they surround "
        "the crosses."
    ),
    share_of_the_odometry_error=(0.0, 1.0, 1.0),
)
by_odometry = ekf_runs.map_from_poses(run, odometry_poses)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="05-trust"
# {= missed(by_odometry) =} of the {= len(run.landmarks) =} true landmarks lie outside their 95 % ellipse, and the
# ellipses are as small as before: {= mean_length(by_odometry):.2f =} m long on average, against
# {= at_last:.2f =} m with the true poses. Now set the share to 0: {= missed(whole) =} of
# {= len(run.landmarks) =} are outside. The next cell tests thirty laps, because one lap may be an exception.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
thirty = [simulated_run(seed) for seed in range(30)]
known = np.mean([ekf_runs.landmark_nees(one, one.truth.poses) for one in thirty])
trusted = np.array([ekf_runs.landmark_nees(one, ekf_runs.odometry_poses(one)) for one in thirty])
print(f"mean NEES of a landmark, true poses: {known:.1f}")
print(f"odometry poses: {trusted.mean():.0f}, from {trusted.min():.0f} to {trusted.max():.0f}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The lap is not an exception: a consistent filter has a mean NEES of 2, and the best of the thirty laps has
# {= trusted.min():.0f =}. The filter assumes $P_{\mathrm{rr}} = 0$, and for poses by odometry this assumption
# is false. A covariance is only as good as the model that it is computed from.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## Alternating localisation and mapping
#
# In SLAM both pose and map are uncertain, and we have a filter for each of them. A first idea is to alternate.
# At each measurement, one filter updates the pose as if the map were exact, and the other updates the map as if
# the predicted pose were exact.
#
# A careful student proposes a second scheme: each filter does not treat the other estimate as exact, but adds
# its covariance. Each filter then uses
#
# $$S = H_{\mathrm r} P_{\mathrm{rr}} H_{\mathrm r}^{\mathsf T} + H_{\mathrm p} P_{ii} H_{\mathrm p}^{\mathsf T} + R.
# \tag{05.11}$$

# %% slideshow={"slide_type": "subslide"}
ask(
    "05-turns",
    "The two filters of the careful student run for two laps. Is the NEES of their pose near 3?",
    {
        "yes: S contains all uncertainty": "S contains the covariances of pose and landmark; compare "
        "(05.11) with (05.2), term by term.",
        "no, far above 3: they are overconfident": "two terms of (05.2) are missing, the terms "
        "with the cross-covariance of pose and landmark.",
        "no, far below 3: they are conservative": "a larger S does make each single update smaller, "
        "but the filters neglect the common error of landmark and pose.",
    },
    right="no, far above 3: they are overconfident",
)

# %% slideshow={"slide_type": "fragment"}
# three schemes on the same 20 runs of two laps each
BEGIN, RUNS = 3, 20  # the start is exact, with P = 0, so NEES is undefined there
schemes = {
    "one joint filter (lesson 06)": alternating_filters.together,
    "each treats the other as exact": lambda one: alternating_filters.alternate(one, careful=False),
    "each adds the other's covariance": lambda one: alternating_filters.alternate(
        one, careful=True
    ),
}
runs = [simulated_run(seed, replace(LAP, steps=84)) for seed in range(RUNS)]
results = {name: [(one, *scheme(one)) for one in runs] for name, scheme in schemes.items()}
NEES = {name: ekf_runs.mean_nees(result, BEGIN) for name, result in results.items()}

# %% slideshow={"slide_type": "subslide"} answers="05-turns" tags=["folded"]
steps = BEGIN + np.arange(len(runs[0]) - BEGIN)
title, (low_20, high_20) = f"Two laps, {RUNS} runs", band(3, RUNS)
fig, _ = views.against_band(steps, NEES, (low_20, high_20), "step", "mean NEES [1]", title)
peaks = [values.max() for values in NEES.values()]
left = [steps[values > high_20][0] for values in list(NEES.values())[1:]]
alt = f"NEES of both alternating schemes rises to {min(peaks[1:]):.0f} or more; that of the joint filter "
views.show(fig, f"{alt}to {peaks[0]:.1f}, about where the χ² interval ends.")
joint = NEES["one joint filter (lesson 06)"]
outside = np.sum((joint > high_20) | (joint < low_20))

# %% [markdown] slideshow={"slide_type": "fragment"} answers="05-turns"
# Both alternating schemes leave the χ² interval by step {= max(left) =} and rise to {= peaks[1]:.0f =}
# and {= peaks[2]:.0f =}. At these peaks the normalised errors are about {= np.sqrt(peaks[1] / 3):.0f =} and
# {= np.sqrt(peaks[2] / 3):.0f =} times as large as those of a consistent filter.
# The joint filter for pose and map, which keeps $P_{\mathrm ri}$, uses the same runs and the same models.
# Its NEES is outside the 95 % interval at {= outside =} of {= len(joint) =} steps. The NEES of the two
# alternating schemes falls near the beginning of the second lap (step 42). From this step on, the robot again
# measures the landmarks that it initialised while its pose was still accurate.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
# the position errors of all filters
believed = {"odometry alone": [ekf_runs.odometry_poses(one) for one in runs]}
believed |= {name: [poses for _, poses, _ in result] for name, result in results.items()}
rms = {n: np.array(list(map(ekf_runs.rms, runs, poses))) for n, poses in believed.items()}
odometry_rms, together_rms, _, careful_rms = rms.values()
for name, errors in rms.items():
    wins = f"less than odometry's in {np.sum(errors < odometry_rms):2} of {RUNS} runs"
    print(f"{name:33} median rms error {np.median(errors):.2f} m, {wins}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# In most of these runs the poses of both schemes are better than those of odometry alone. But their covariance
# is wrong. A program that uses this covariance to associate a landmark or to avoid a wall may make wrong
# decisions. The joint filter has a smaller rms error than the careful scheme in
# {= np.sum(together_rms < careful_rms) =} of {= RUNS =} runs.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let the class argue for the careful scheme first. The idea is reasonable, and the reason
# why it does not help leads to lesson 06. The added covariances are not too small; the fault is that both
# filters treat the errors as independent.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The missing cross-covariance
#
# In (05.11), the two terms of (05.2) with the cross-covariance $P_{\mathrm ri}$ are missing. These terms are
# not small. The landmark was initialised from the robot's pose, so its estimate contains the error of the pose
# at that time.
#
# When the robot measures the landmark again, this common error cancels in the innovation. In the joint filter
# $P_{\mathrm ri}$ describes this common error: $P H^{\mathsf T}$ is small, and the update lowers $P$ only a
# little. The two separate filters have no $P_{\mathrm ri}$. They treat each such measurement as independent
# information and lower $P$ each time.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Where alternating schemes are useful
#
# So these two alternating *filters* are not consistent. (The *covariance intersection* of Julier and
# Uhlmann is conservative without $P_{\mathrm ri}$, at the price of larger covariances.) But alternation is not
# wrong in general. Many SLAM systems localise in the current map and then extend the map, for example the scan
# matching of lesson 01. With a camera, PTAM and ORB-SLAM track the pose in the current map,
# which they keep fixed. A second thread adds points, and then optimises points and earlier poses
# *together*, by batch least squares (*bundle adjustment*).
#
# A batch method may alternate, too: if steps of the poses and steps of the map lower *one common* cost until it
# converges, the method counts no measurement twice.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Landmarks that are not measured
#
# A measurement also affects other landmarks. Block row $j$ of the gain, for a landmark that is *not*
# measured, is
#
# $$K_j = (P_{j\mathrm r} H_{\mathrm r}^{\mathsf T} + P_{ji} H_{\mathrm p}^{\mathsf T})\, S^{-1}, \tag{05.12}$$
#
# which is in general not zero if neither pose nor map is known: a measurement of $i$ also corrects $j$. So the
# $N$ small filters become one filter, whose state also contains the pose.

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
slam = EkfSlam(run.robot, run.sensor)  # the joint filter of lesson 06, over our lap
for reading in run:
    slam.step(reading)
P_joint, p_i = slam.filter.block(np.arange(7)), slam.filter.landmarks()[0]
P_j_robot, P_j_i = P_joint[5:, :3], P_joint[5:, 3:5]
H_robot, H_mark = jacobians.H_robot(slam.pose, p_i), jacobians.H_landmark(slam.pose, p_i)
H_joint = np.hstack([H_robot, H_mark, np.zeros((2, 2))])
S_inverse = np.linalg.inv(H_joint @ P_joint @ H_joint.T + R)
K_joint = P_joint @ H_joint.T @ S_inverse

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** Consider the joint filter of lesson 06 at the end of our lap; $i$ and $j$ are the first two
# landmarks.
# Compute $K_j$ from `P_j_robot`, `P_j_i`, `H_robot`, `H_mark` and `S_inverse`.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
K_j = ...
compare(K_j, K_joint[5:])

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# K_j = (P_j_robot @ H_robot.T + P_j_i @ H_mark.T) @ S_inverse
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Literature
#
# J. J. Leonard and H. F. Durrant-Whyte, "Mobile robot localization by tracking geometric beacons", *IEEE
# Transactions on Robotics and Automation* 7(3), 1991: EKF localisation, with sonar.
#
# R. Smith, M. Self and P. Cheeseman, "Estimating uncertain spatial relationships in robotics", in *Autonomous
# Robot Vehicles*, Springer, 1990: why the cross-covariances must be kept in one state.
#
# S. J. Julier and J. K. Uhlmann, "A non-divergent estimation algorithm in the presence of unknown correlations",
# *American Control Conference*, 1997: an update that is conservative where $P_{\mathrm ri}$ cannot be kept.
#
# G. Klein and D. Murray, "Parallel tracking and mapping for small AR workspaces", *ISMAR*, 2007: PTAM, which
# tracks the camera in the map and extends the map, in two threads.
#
# R. Mur-Artal, J. M. M. Montiel and J. D. Tardós, "ORB-SLAM: a versatile and accurate monocular SLAM
# system", *IEEE Transactions on Robotics* 31(5), 2015: ORB-SLAM.
#
# **Read next:** S. Thrun, W. Burgard and D. Fox, *Probabilistic Robotics*, MIT Press, 2005, chapter 7.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-literature"
# *For the lecturer:* The two threads of PTAM are the two halves of this lesson. Ask which of its steps
# minimises one common cost.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## Summary
#
# You can localise a robot in a known map. You can map landmarks from known poses, by a filter or by batch
# least squares. You know which blocks of $P$ make each problem easy, and why two filters that alternate
# without $P_{\mathrm ri}$ are inconsistent.
#
# **What comes next:** [lesson 06](06_ekf_slam.ipynb) puts robot and landmarks into one state and keeps
# $P_{\mathrm ri}$. This filter is called EKF-SLAM.
#
# The sections below this one are optional.
#
# **Exercise:** [05 · Localisation and mapping, apart](../exercises/ex05_localisation_and_mapping.ipynb).
# You write EKF localisation and mapping, add a new sensor, and solve a global localisation problem:
# the initial heading is unknown, and some measurements are outliers.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-summary"
# *For the lecturer:* Before you show it, ask which block of $P$ was zero in each half, and why neither is
# zero in SLAM.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: A is the same for every odometry model
#
# Equation (05.4) uses one $A$, although an increment $o = (o_x, o_y, o_\theta)$ may come from a straight step
# or from an arc. The position part of $\hat x \oplus o$ is the old position plus the increment rotated by the
# heading. We differentiate $\hat x \oplus o$ with respect to the pose:

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-a-is-the-same-for-every-odometry"
# *For the lecturer:* Ask why the increment itself has no derivative with respect to the pose.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
x, y, theta, o_x, o_y, o_theta, dx, dy = sp.symbols("x y theta o_x o_y o_theta Δx Δy", real=True)
rotation = sp.Matrix([[sp.cos(theta), -sp.sin(theta)], [sp.sin(theta), sp.cos(theta)]])
position = sp.Matrix([x, y]) + rotation * sp.Matrix([o_x, o_y])
composed = sp.Matrix([*position, theta + o_theta])
same = sp.Matrix([[1, 0, -dy], [0, 1, dx], [0, 0, 1]])
A_steps = derive("A", composed.jacobian([x, y, theta]), "the derivatives of x ⊕ o by the pose")
A_steps.step("with Δx, Δy", same, given={dx: composed[0] - x, dy: composed[1] - y})

# %% [markdown] slideshow={"slide_type": "fragment"}
# The increment is measured in the robot's frame, so it does not depend on the pose. Only $W$ and $C$ depend on
# the odometry model.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: smoothing a lap
#
# The filter's estimate of a pose uses no later measurement. A *Rauch–Tung–Striebel smoother* processes the
# filter's results backwards in time and adds the information of the later measurements to each pose. With the
# gain
# $G = P A^{\mathsf T} P_{\text{pred}}^{-1}$, where $P_{\text{pred}}$ is the predicted covariance of the next
# step, the smoother adds $G$ times the correction of the next pose. The robot has a map of four landmarks.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-smoothing-a-lap"
# *For the lecturer:* Ask at which step filter and smoother must agree. (At the last one.)

# %% slideshow={"slide_type": "fragment"} tags=["code"]
readings, part = list(run), {id: whole_map[id] for id in range(4)}
filtered_x, filtered_P = ekf_runs.locate(run, part, START)
smoothed_x, smoothed_P = filtered_x.copy(), filtered_P.copy()
for k in range(len(readings) - 2, -1, -1):
    b = Belief(filtered_x[k], filtered_P[k])
    after = ekf_runs.predict(b, readings[k + 1].odometry, run.robot)
    dx, dy = after.x[:2] - b.x[:2]
    G = b.P @ np.array([[1, 0, -dy], [0, 1, dx], [0, 0, 1]]).T @ np.linalg.inv(after.P)
    correction = smoothed_x[k + 1] - after.x
    correction[2] = wrap(correction[2])
    smoothed_x[k] = b.x + G @ correction
    smoothed_P[k] = b.P + G @ (smoothed_P[k + 1] - after.P) @ G.T

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
lengths = {
    "filtered": ekf_runs.ellipse_length(filtered_P),
    "smoothed": ekf_runs.ellipse_length(smoothed_P),
}
fig, ax = views.curves(
    np.arange(len(run)), lengths, "step", "length of the 95 % ellipse [m]", size=(8, 4)
)
errors = [ekf_runs.rms(run, poses) for poses in (filtered_x, smoothed_x)]
views.show(
    fig,
    "The filtered ellipse grows step by step and shrinks suddenly at a landmark; the smoothed one "
    "grows and shrinks gradually and is never longer.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The longest filtered ellipse is {= lengths["filtered"].max():.1f =} m long, the longest smoothed one
# {= lengths["smoothed"].max():.1f =} m. On this lap the rms position error falls from {= errors[0]:.2f =}
# m to {= errors[1]:.2f =} m. In the last part of the lap filter and smoother agree: the robot measures no
# landmark of the map there, so no later measurements exist.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: does the order of the measurements matter?
#
# By (05.6) information adds up, and a sum does not depend on the order of its terms. The next cell checks
# (05.6) once, and then uses the measurements of the lap in another order.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-does-the-order-of-the-measurement"
# *For the lecturer:* Ask before you run the cell whether the order would matter for a linear sensor.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# the information of a measurement; then all measurements in another order
x, p = np.array([1, 2, 0.4]), np.array([3, 2.5])
H_there, P_before = jacobians.H_robot(x, p), np.diag([0.1, 0.2, 0.05]) ** 2
b, _ = ekf_localisation.update(Belief(x, P_before), [models.h(x, p)], [p], R)
gained = np.linalg.inv(b.P) - np.linalg.inv(P_before)
print("(05.6) holds:", np.allclose(gained, H_there.T @ np.linalg.inv(R) @ H_there))

shuffled, seen = KnownPoseMap(), list(ekf_runs.single_observations(run, run.truth.poses))
for k in np.random.default_rng(5).permutation(len(seen)):
    shuffled.update(*seen[k], R)
moved = [shuffled.landmarks[i].x - b.x for i, b in whole.landmarks.items()]
print(f"in another order, coordinates change by up to {1000 * np.abs(moved).max():.1f} mm")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The order matters a little, because $h$ is linearised at the current estimate, which depends on the
# earlier measurements. With a linear sensor, $z = p + \varepsilon$, the order would not matter at all.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: one filter for the whole map
#
# By (05.9) one large filter computes the same result as $N$ small filters. We check this with the filter of
# lesson 06 and exact poses. The map of this filter must agree with our map, and its cross-covariances must be
# zero.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-one-filter-for-the-whole-map"
# *For the lecturer:* The printed zero is exact and not the result of rounding: no step of the filter ever
# adds to this block.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# one filter for all landmarks, with exact poses
large = MAK(np.zeros(3), np.zeros((3, 3)))
for x, reading in zip(run.truth.poses, run, strict=True):
    large.predict(x, np.zeros((3, 3)))
    for id, z in zip(reading.observations.ids.tolist(), reading.observations.z, strict=True):
        (large.update if id in large.ids else large.add)([id], [z], R)
small = np.array([whole.landmarks[id].x for id in large.ids])
print("means differ by less than 1e-9:", np.abs(large.landmarks() - small).max() < 1e-9)
P_map, own = large.block(np.arange(3, 19)), np.kron(np.eye(8), np.ones((2, 2))) == 1
print("largest cross-covariance:", np.abs(P_map[~own]).max())
