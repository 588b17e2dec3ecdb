# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 05 · Two easy halves
#
# **You will be able to** find a robot in a map that is known, draw a map from poses that are known,
# say which blocks of the covariance make each of the two easy, and show with numbers why doing them
# in turn is not SLAM.
#
# **50 minutes. Before:** lesson [03](03_kalman_filter.ipynb) (predict, update, NEES) and lesson
# [04](04_models_and_jacobians.ipynb) (the models $f$, $h$, $g$ and their Jacobians).
#
# *Key:* a sight is easy to use as long as only one of the two, pose or landmark, is unknown.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* There are two halves of some 20 minutes each and a finale. If time is short,
# keep "What an innovation depends on" and the finale, because lesson 06 builds on these; the
# exercise repeats the rest. Good questions for a poll of the class: the first, the one on one
# landmark, and the last.

# %% slideshow={"slide_type": "skip"} tags=["folded"]
from dataclasses import replace
from functools import cache

import numpy as np
import sympy as sp

from slamlab import models, views
from slamlab.checks import ask
from slamlab.derivation import blockwise, derive, symmetric
from slamlab.evaluation import band
from slamlab.filters import MAK, Belief, KnownPoseMap, ekf_localisation
from slamlab.layers import Ellipses, Points, Poses
from slamlab.models import jacobians
from slamlab.sources.landmark_runs import LandmarkRun, Loop
from slamlab.studies import agreeing_poses, halves_in_turn, two_halves

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## A lap, and two things nobody knows
#
# A robot drives once round a circle. It counts the turns of its wheels, and it sees every landmark
# within 2 m; it can tell the landmarks apart. Everything in this lesson is simulated, so that the
# truth is known to us, though not to the robot.
#
# Where is the robot? And where are the landmarks?

# %% slideshow={"slide_type": "fragment"}
LAP = Loop(landmarks=8, v=0.6, steps=42, range_max=2.0, v_sigma=0.03, omega_sigma=0.015)


def drive(seed, loop=LAP):
    return LandmarkRun(loop, np.random.default_rng(seed))


run = drive(74)
wheels = two_halves.by_wheels(run)

# %% slideshow={"slide_type": "fragment"}
fig, ax = views.axes("One lap, counted by the wheels", size=(8, 5.5))
views.draw(ax, Poses("truth", run.truth.poses))
views.draw(ax, Poses("naive", wheels), label="by the wheels alone")
views.draw(ax, Points("landmark", run.landmarks), label="landmarks")
views.legend(ax, loc="center")
gap = np.hypot(*(wheels - run.truth.poses)[-1, :2])
views.show(fig, f"The true lap closes; the wheels' lap ends {gap:.1f} m beside it.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The true lap closes. By the wheels alone it ends {= gap:.1f =} m from where the robot really is,
# since each small error of a turn bends the whole path after it.
#
# The landmarks can help. But a sight $z$, a range and a bearing, only says where the landmark is *as
# seen from the robot*. It ties two unknown things together.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### When does a sight correct the pose?

# %% slideshow={"slide_type": "fragment"}
ask(
    "05-unknown",
    "The innovation is what was seen minus what was expected. When does it depend on nothing but "
    "the error of the **pose** and the sensor's noise?",
    {
        "always: the robot is what measures": "what the robot expects to see depends on where it "
        "believes the landmark to be; an error there enters the innovation just the same.",
        "when the landmark's place is known exactly": "then only the pose can be wrong in what the "
        "robot expects to see.",
        "when the sensor has no noise": "that removes the noise, but an error of the landmark's "
        "place is still in what the robot expects.",
    },
    right="when the landmark's place is known exactly",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The next section turns this into a formula with five terms. In each of the two easy halves, three of
# the five vanish.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## What an innovation depends on
#
# The robot believes that its pose is $\hat x$ and that landmark $i$ stands at $\hat p_i$. It sees
# $z = h(x, p_i) + \varepsilon$, where $\varepsilon$ has the covariance $R$. With the errors
# $\tilde x = x - \hat x$ and $\tilde p_i = p_i - \hat p_i$, the innovation is to first order
#
# $$v = z - h(\hat x, \hat p_i) \approx H_{\mathrm r}\,\tilde x + H_{\mathrm p}\,\tilde p_i +
# \varepsilon. \tag{05.1}$$
#
# The Jacobians $H_{\mathrm r}$ (robot) and $H_{\mathrm p}$ (landmark) are those of lesson 04. So three
# errors meet in one innovation.

# %% [markdown] slideshow={"slide_type": "subslide"}
# How large an innovation may we expect? Put both errors into one column. Its covariance has four
# blocks: $P_{\mathrm{rr}}$ of the robot, $P_{ii}$ of the landmark, and $P_{\mathrm ri}$ with its transpose,
# which says how the two errors go together.

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
    .step("and multiply out", sp.expand)
)
S_steps

# %% [markdown] slideshow={"slide_type": "subslide"}
# In words, the innovation is as uncertain as the robot, the landmark, their common error and the sensor
# make it:
#
# $$S = H_{\mathrm r} P_{\mathrm{rr}} H_{\mathrm r}^{\mathsf T} + H_{\mathrm r} P_{\mathrm ri}
# H_{\mathrm p}^{\mathsf T} + H_{\mathrm p} P_{\mathrm ri}^{\mathsf T} H_{\mathrm r}^{\mathsf T} +
# H_{\mathrm p} P_{ii} H_{\mathrm p}^{\mathsf T} + R. \tag{05.2}$$

# %% [markdown] slideshow={"slide_type": "fragment"}
# What is known exactly has no error, and hence no covariance with anything. So we set blocks of $P$ to
# zero and let the machine see what is left of (05.2).


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
# Either way one covariance and $R$ remain, and that is the case for which lesson 03 derived its gain.
# Nothing else makes the two halves easy. The MAK thesis calls such an innovation *constrained*, COIN for
# short.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## First half: where am I, in a known map?
#
# The state is the pose, three numbers. **Driving** carries pose and covariance along. The wheels report a
# motion $o$ in the robot's own frame, and for each such motion lesson 04's $A$ holds:
#
# $$\hat x \leftarrow \hat x \oplus o, \qquad P_{\mathrm{rr}} \leftarrow A P_{\mathrm{rr}} A^{\mathsf T} + Q, \qquad
# A = \begin{bmatrix} 1 & 0 & -\Delta y \\ 0 & 1 & \Delta x \\ 0 & 0 & 1 \end{bmatrix}. \tag{05.4}$$
#
# Here $(\Delta x, \Delta y)$ is the displacement in the world, and $Q = W C W^{\mathsf T}$ is what the wheels'
# noise adds. As $\det A = 1$ and $Q$ comes on top, no drive ever lowers the determinant of
# $P_{\mathrm{rr}}$.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Looking** lowers it. With the map known, (05.3) turns lesson 03's update into
#
# $$S = H_{\mathrm r} P_{\mathrm{rr}} H_{\mathrm r}^{\mathsf T} + R, \quad
# K = P_{\mathrm{rr}} H_{\mathrm r}^{\mathsf T} S^{-1}, \quad
# \hat x \leftarrow \hat x + K v, \quad
# P_{\mathrm{rr}} \leftarrow P_{\mathrm{rr}} - K S K^{\mathsf T}. \tag{05.5}$$
#
# $H_{\mathrm r}$ is taken at $\hat x$, the best guess there is at that moment, and the bearing in $v$ is
# wrapped, as lesson 04 insists.
#
# A run repeats these two: drive, look, drive, look. A step in which nothing is seen is a drive alone.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask which of the two equations can make the ellipse grow. Then ask whether
# (05.5) ever can. It cannot, since $K S K^{\mathsf T}$ is positive semidefinite. And why do the ellipses
# without a map shrink on the way home? The error of the heading at the start turns the whole lap about
# the start.

# %% slideshow={"slide_type": "fragment"}
P_START = np.diag([0.2, 0.2, 0.1]) ** 2
START = Belief(np.random.default_rng(5).multivariate_normal(np.zeros(3), P_START), P_START)
whole_map = dict(enumerate(run.landmarks))
poses, P_poses = two_halves.locate(run, whole_map, START)

# %% [markdown] slideshow={"slide_type": "fragment"}
# At the start the robot knows its place to 0.2 m and its heading to 0.1 rad. `locate` is a loop over
# (05.4) and (05.5), with `slamlab.filters.ekf_localisation`; you will write both in the exercise.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## The lap again, with a map

# %% slideshow={"slide_type": "fragment"}
ask(
    "05-largest",
    "The robot drives the lap with the whole map in its memory. Where on the lap are its ellipses "
    "largest?",
    {
        "at the end, because errors add up": "the wheels' errors do, but each sight of a known "
        "landmark is a fresh reference, which does not depend on how far it drove.",
        "where it has seen no landmark for a while": "between sights only (05.4) is at work, and "
        "the ellipse grows; the next sight makes it small again.",
        "they are equally large everywhere": "that needs a landmark in sight at every step, from "
        "all of which the pose is seen equally well.",
    },
    right="where it has seen no landmark for a while",
)


# %% slideshow={"slide_type": "fragment"}
def lap(run, poses, P, name="corrected", every=3):
    return [
        Poses("truth", run.truth.poses),
        Poses(name, poses),
        Ellipses("robot", poses[::every, :2], P[::every, :2, :2]),
        Points("landmark", run.landmarks),
    ]


def spread(P):
    return np.sqrt(P[..., 0, 0] + P[..., 1, 1])


# %% slideshow={"slide_type": "subslide"} answers="05-largest" tags=["folded"]
blind, P_blind = two_halves.locate(run, {}, START)
laps = {
    "no map: drive only": lap(run, blind, P_blind, "predicted"),
    "whole map known": lap(run, poses, P_poses),
}
fig, _ = views.side_by_side(laps, size=(11, 5.5))
largest = [spread(P[5:]).max() for P in (P_blind, P_poses)]  # after the start
views.show(
    fig, f"Without a map the spread grows to {largest[0]:.2f} m, with one to {largest[1]:.2f}."
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="05-largest"
# Without a map the ellipses swell to {= largest[0]:.2f =} m on the far side of the lap. (On the way
# home they shrink again: an error of the heading at the start turns the whole lap about its start.)
# With the map the largest ellipse after the start measures {= largest[1]:.2f =} m, in a stretch
# where no landmark is near, and the last one {= spread(P_poses)[-1]:.2f =} m.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## How much of a map is needed?
#
# The map may hold only some of the landmarks, and the robot may see less far, or farther.
# Move a slider, and watch where the ellipses swell.


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
def in_part_of_a_map(landmarks_in_the_map, sight):
    run = drive(74, replace(LAP, range_max=sight))
    part = dict(list(whole_map.items())[:landmarks_in_the_map])
    poses, P = two_halves.locate(run, part, START)
    fig, ax = views.axes(f"largest spread {spread(P[5:]).max():.2f} m", size=(8, 5.5))
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
    lambda landmarks_in_the_map, sight: (
        f"With {landmarks_in_the_map} landmarks in the map and a sight of {sight:.1f} m the ellipses "
        "are small near landmarks of the map and swell elsewhere."
    ),
    landmarks_in_the_map=(0, 8, 4),
    sight=(1.0, 5.0, 2.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# With the upper four of the eight landmarks in the map the robot's covariance rises and falls: it
# grows at the lower right, where nothing known is in sight, and shrinks at the first landmark of
# the map. Keep in mind that the covariance of a *robot* may grow. That of a landmark never does, as
# the second half will show.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## What one landmark cannot tell
#
# A sight is two numbers, and a pose is three.

# %% slideshow={"slide_type": "fragment"}
ask(
    "05-circle",
    "A robot has no idea of its place, and knows its heading only roughly. It sees **one** known "
    "landmark, 2 m away. Where may it be?",
    {
        "at one point: range and bearing fix it": "they would if the heading were known exactly; "
        "the bearing is measured from the heading.",
        "on an arc round the landmark": "the range says how far away the landmark is, and the "
        "bearing only says how the robot is turned towards it.",
        "in a disc round the landmark": "the range is known to a decimetre, so the inside "
        "of the disc is ruled out.",
    },
    right="on an arc round the landmark",
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# We can ask the algebra. Lesson 03 showed that information, the inverse of a covariance, adds up. What a
# sight adds to that of the pose is
#
# $$P_{\text{after}}^{-1} = P_{\text{before}}^{-1} + H_{\mathrm r}^{\mathsf T} R^{-1} H_{\mathrm r}.
# \tag{05.6}$$
#
# In a direction $n$ with $H_{\mathrm r}\, n = 0$ the second term is zero: there the sight tells nothing. Since
# $H_{\mathrm r}$ has two rows and three columns, there is such a direction. Here it is:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
x, y, theta, p_x, p_y = sp.symbols("x y theta p_x p_y", real=True)
seen = sp.Matrix([sp.sqrt((p_x - x) ** 2 + (p_y - y) ** 2), sp.atan2(p_y - y, p_x - x) - theta])
n = sp.Matrix([p_y - y, x - p_x, 1])
H_n = derive("H n", seen.jacobian([x, y, theta]) * n, "h by the pose, times n")
H_n.step("simplify", sp.simplify)

# %% [markdown] slideshow={"slide_type": "fragment"}
# $$H_{\mathrm r}\, n = 0 \quad\text{for}\quad n = (p_y - y,\; x - p_x,\; 1)^{\mathsf T} \tag{05.7}$$
#
# This $n$ is a step *round* the landmark, together with the turn that keeps the landmark at the same bearing.
# Nothing that the robot sees would change.

# %% slideshow={"slide_type": "subslide"}
CORNER, vague = np.array([[1.7, 1.0], [0.4, -1.6], [-1.5, 0.8]]), np.array([0, 0, 0.3])


def where_may_it_be(landmarks_seen, heading_sigma):
    marks, rng = CORNER[:landmarks_seen], np.random.default_rng(5)
    z, R = models.h(vague, marks), two_halves.R(run)
    b = Belief(vague, np.diag([5, 5, heading_sigma]) ** 2)
    b, _ = ekf_localisation.update(b, z, marks, R)
    agree = agreeing_poses.poses_that_agree(marks, z, vague[2], heading_sigma, R, rng)
    return marks, b, agree


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
def draw_where(**values):
    marks, b, agree = where_may_it_be(**values)
    layers = {
        "poses that agree": Points("sample", agree[:400, :2]),
        "estimate, 95 %": Ellipses("corrected", [b.x[:2]], [b.P[:2, :2]]),
        "landmark": Points("landmark", marks),
    }
    title = f"{100 * agreeing_poses.share_inside(b, agree):.0f} % of the poses lie in the ellipse"
    return views.side_by_side({title: layers}, size=(8, 5.5))[0]


# %% slideshow={"slide_type": "fragment"} answers="05-circle"
views.explore(
    draw_where,
    lambda landmarks_seen, heading_sigma: (
        f"Landmarks seen: {landmarks_seen}, heading known to {heading_sigma:.2f} rad: the poses that "
        "agree form an arc round a single landmark, and a spot once there are two."
    ),
    landmarks_seen=(1, 3, 1),
    heading_sigma=(0.02, 1.5, 0.5),
)
held = {s: agreeing_poses.share_inside(*where_may_it_be(1, s)[1:]) for s in (0.1, 1.5)}

# %% [markdown] slideshow={"slide_type": "fragment"} answers="05-circle"
# The poses that agree with one sight lie on an arc round the landmark. The filter's ellipse (95 %) is narrow
# towards the landmark and long across, as (05.7) says. Show it a second landmark, and a spot remains.
#
# Now go back to one landmark and change what is known of the heading. An arc bends, an ellipse cannot: at
# 0.1 rad it holds {= 100 * held[0.1]:.0f =} % of the poses, at 1.5 rad {= 100 * held[1.5]:.0f =} %. An EKF that
# starts with no idea of its heading cannot be trusted. It is better to try several headings and keep
# the one with which the sights agree.

# %% [markdown] slideshow={"slide_type": "subslide"}
# Nothing in (05.5) insists on a range and a bearing. Another sensor brings another $h$. Differentiate it, and
# you have $H_{\mathrm r}$, with one row for each number measured; $R$ is the covariance of that sensor's
# noise. A beacon that tells only its distance has an $H_{\mathrm r}$ of one row, and so says nothing about
# *two* directions.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Does the filter know how wrong it is?
#
# One lap proves nothing. We drive 40, each with landmarks, noise and a start of its own, and compute
# NEES at every step: the squared error of the pose in units of its covariance, which is 3 on average when
# the covariance is right.


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
def laps_located(off, count):
    return two_halves.laps_located(LAP, P_START, off, count)


exact, (low, high) = two_halves.mean_nees(laps_located(0, 40)), band(3, 40)
within = np.mean((exact > low) & (exact < high))
print(
    f"mean NEES {exact.mean():.2f}; from {low:.2f} to {high:.2f} at {100 * within:.0f} % of the steps"
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# On these laps nothing speaks against the filter. (Do not expect exactly 95 % of the steps: neighbouring steps of a run
# share their errors, so the curve wanders slowly.)

# %% slideshow={"slide_type": "subslide"}
ask(
    "05-wrong-map",
    "Now the map is wrong: each landmark stands 0.3 m from where the map says, each in a direction "
    "of its own. The sensor's range errs by 0.1 m. What does NEES do?",
    {
        "it stays near 3: errors average out": "noise is drawn anew at each sight and averages "
        "out; a wrong landmark errs the same way every time.",
        "it rises at first, then returns to 3": "it would, if the filter could doubt its map; "
        "it was told that the map is exact.",
        "it rises far above 3 and stays there": "each sight makes the filter surer of a place that "
        "is off by a few decimetres.",
    },
    right="it rises far above 3 and stays there",
)


# %% slideshow={"slide_type": "fragment"}
@cache
def nees_off_by(metres):
    return two_halves.mean_nees(laps_located(metres, 20))


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
        f"NEES with an exact map stays in its band; with landmarks off by {landmarks_off_by:.2f} m it "
        "lies above it, the farther the worse."
    ),
    landmarks_off_by=(0.0, 0.5, 0.3),
)
off = {metres: nees_off_by(metres).mean() for metres in (0.05, 0.3)}

# %% [markdown] slideshow={"slide_type": "fragment"} answers="05-wrong-map"
# The scale is logarithmic. With landmarks off by 0.3 m, NEES is {= off[0.3]:.0f =} on average instead of 3,
# and it does not recover: $P_{ii} = 0$ tells the filter that no landmark can be wrong. Even 0.05 m,
# half of what the sensor errs by, makes it {= off[0.05]:.1f =}.
#
# **Nobody has an exact map.** So landmarks need covariances, too, and that is the other half.

# %% [markdown] slideshow={"slide_type": "subslide"}
# A robot cannot compute NEES, because it does not know the truth. But it can compare each
# innovation $v$ with its covariance $S$, and (05.5) has both. A $v$ that is far larger than $S$
# allows says that something is wrong: the pose, the map, or the sight itself.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Someone will propose a larger $R$. It helps up to a point. But $R$ stands for
# noise that is drawn anew at each sight: thirty sights average this noise away, but not the error
# of a wrong map.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Second half: where are they, if I know where I am?
#
# Now the poses are known exactly, say from a camera under the ceiling, and the map is the state. A landmark
# that is seen for the first time is placed where it was seen. The pose has no error, so the only doubt is the
# sensor's, carried over by lesson 04's $J_z$:
#
# $$\hat p_i = g(x, z), \qquad P_{ii} = J_z R J_z^{\mathsf T}. \tag{05.8}$$
#
# At every later sight (05.5) corrects it, with $H_{\mathrm p}$ and $P_{ii}$ for $H_{\mathrm r}$ and
# $P_{\mathrm{rr}}$. There is nothing to predict, because landmarks do not move.

# %% [markdown] slideshow={"slide_type": "subslide"}
# $N$ landmarks are $2N$ numbers. Do we need one filter with a covariance of $2N \times 2N$?

# %% slideshow={"slide_type": "fragment"}
ask(
    "05-cross",
    "The poses are known. The robot has seen landmarks 1 and 2, which stand close to each other. "
    "Now it sees landmark 1 again. What happens to the estimate of landmark 2?",
    {
        "it gets a little better": "it would if the two erred together; each was placed from an "
        "exact pose by a sight with noise of its own.",
        "nothing": "their errors have nothing in common, so news of one is no news of the other.",
        "it gets worse: its information is diluted": "a measurement never takes information away.",
    },
    right="nothing",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The gain is $K = P H^{\mathsf T} S^{-1}$, so the rows of $P H^{\mathsf T}$ say who learns from a sight of $i$: the
# robot, landmark $i$ itself, and any other landmark $j$.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="05-cross"
P_jr, P_ji = sp.MatrixSymbol("P_jr", 2, 3), sp.MatrixSymbol("P_ji", 2, 2)
columns = sp.BlockMatrix([[P_rr, P_ri], [P_ri.T, P_ii], [P_jr, P_ji]])
gain_steps = derive("P Hᵀ", columns * H.T, "rows: the robot, i, j").step("by blocks", blockwise)
gain_steps

# %% [markdown] slideshow={"slide_type": "fragment"}
# With the pose known, $P_{j\mathrm r} = 0$, and row $j$ is $P_{ji} H_{\mathrm p}^{\mathsf T}$. What the update does to
# the cross block is therefore
#
# $$P_{ji} \leftarrow P_{ji} - P_{ji} H_{\mathrm p}^{\mathsf T} S^{-1} H_{\mathrm p} P_{ii}. \tag{05.9}$$
#
# Once it is zero, it stays zero. It is zero at the beginning, because each landmark is placed by a sight of
# its own, from a pose without error. **So one filter of size $2N$ falls apart into $N$ little filters of
# size 2**, and a sight costs the same however large the map is.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## How a landmark grows sure


# %% slideshow={"slide_type": "fragment"}
def mean_spread(found):
    return np.mean([spread(b.P) for b in found.landmarks.values()])


first, whole = KnownPoseMap(), two_halves.draw_map(run, run.truth.poses)
for x, id, z in two_halves.sights(run, run.truth.poses):
    if id not in first.landmarks:
        first.see(x, id, z, two_halves.R(run))


def drawn(found, poses, name="truth"):
    ellipses = Ellipses("landmark", found.points(), [b.P for b in found.landmarks.values()])
    return [Poses(name, poses), ellipses, Points("truth", run.landmarks)]


def crossed(ax):
    ax.lines[-1].set(marker="x", markersize=7, markeredgewidth=1.5, label="true landmark")


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
maps = {"after its first sight": first, "after the whole lap": whole}
layers = {title: drawn(found, run.truth.poses) for title, found in maps.items()}
fig, both = views.side_by_side(layers, size=(11, 5.5))
at_first, at_last = (mean_spread(found) for found in maps.values())
both[0].set(xlim=(-6.5, -3.6), ylim=(3.1, 6.0))  # two of the eight
for ax in both:
    crossed(ax)
views.legend_below(fig)
views.show(fig, f"Ellipses shrink from a mean spread of {at_first:.2f} m to {at_last:.2f} m.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# At first sight a landmark is uncertain by {= at_first:.2f =} m on average, and after the lap by
# {= at_last:.2f =} m. No landmark's ellipse ever grows: (05.5) takes $K S K^{\mathsf T}$ away, and
# there is no (05.4) that would add anything.

# %% slideshow={"slide_type": "subslide"}
ask(
    "05-root",
    "A robot stands still, at a known pose, and sees one landmark 64 times. By which factor is its "
    "σ smaller after 64 sights than after the first?",
    right=8,
    tolerance=0.5,
    reason="variances fall as 1/k, as those of the mean of k numbers do, and σ is the root.",
    wrong={
        64: "that is the factor of the variance; σ is its root.",
        1: "that would be so if the same noise came back at every sight.",
        4096: "that would be 1/k²; variances fall as 1/k.",
    },
)

# %% slideshow={"slide_type": "fragment"}
at, mark, looks = np.array([0.5, 0.2, 0.4]), np.array([2.0, 1.5]), [1, 2, 4, 8, 16, 32, 64]
rng, R = np.random.default_rng(1), two_halves.R(run)
squared = np.zeros((100, 64))
for robot in squared:
    found = KnownPoseMap()
    for k, eps in enumerate(rng.multivariate_normal([0, 0], R, 64)):
        found.see(at, 0, models.h(at, mark) + eps, R)
        robot[k] = np.sum((found.landmarks[0].x - mark) ** 2)
mean_squared = squared.mean(axis=0)[np.array(looks) - 1]

# %% slideshow={"slide_type": "fragment"} answers="05-root" tags=["folded"]
J = jacobians.J_z(at, models.h(at, mark))
one_look = np.trace(J @ R @ J.T)
fig, ax = views.growth(
    looks,
    {"mean squared error of 100 robots": mean_squared},
    {"trace of (05.10)": one_look / np.array(looks)},
    "sights k",
    "squared error [m²]",
    size=(8, 4),
)
views.show(fig, f"The squared errors fall as one over k, over {looks[-1]} sights, on the line.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The mean squared errors of 100 robots follow a line that falls as $1/k$. From one place, $k$
# sights leave
#
# $$P_{ii} \approx \tfrac{1}{k}\, J_z R J_z^{\mathsf T}, \tag{05.10}$$
#
# since (05.6), with $H_{\mathrm p}$, adds the same information each time. After 64 sights σ is
# {= np.sqrt(mean_squared[0] / mean_squared[-1]):.1f =} times smaller here.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## Poses that are only believed to be known

# %% slideshow={"slide_type": "fragment"}
ask(
    "05-trust",
    "We draw the map once more, but from the poses that the wheels report, as if they were exact. "
    "What do the ellipses of the landmarks do?",
    {
        "they grow, as the poses are worse": "nobody told the filter: it computes its ellipses "
        "from R and from how often it saw a landmark.",
        "they stay nearly the same": "P depends on R and the Jacobians, not on whether the poses "
        "are right.",
        "they shrink": "no more was seen than before.",
    },
    right="they stay nearly the same",
)


# %% slideshow={"slide_type": "subslide"} tags=["folded"]
def from_wrong_poses(share_of_the_wheels_error):
    believed = run.truth.poses + share_of_the_wheels_error * two_halves.off(run, wheels)
    error = two_halves.landmark_nees(run, believed)
    fig, ax = views.axes(f"mean NEES of a landmark {error:.0f}; 2 is right", size=(8, 5.5))
    for layer in drawn(two_halves.draw_map(run, believed), believed, "naive"):
        views.draw(ax, layer)
    ax.lines[0].set_label("poses taken for true")
    crossed(ax)
    views.legend(ax, loc="center")
    return fig


# %% slideshow={"slide_type": "fragment"} answers="05-trust"
views.explore(
    from_wrong_poses,
    lambda share_of_the_wheels_error: (
        f"With {100 * share_of_the_wheels_error:.0f} % of the wheels' error in the poses the ellipses are as "
        "small as without, and lie beside the true landmarks."
    ),
    share_of_the_wheels_error=(0.0, 1.0, 1.0),
)
by_the_wheels = mean_spread(two_halves.draw_map(run, wheels))

# %% [markdown] slideshow={"slide_type": "fragment"} answers="05-trust"
# The ellipses lie beside the crosses, and are as small as before. Now move the share to 0: the crosses
# return into the ellipses. Is this lap an exception? Here are thirty.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
thirty = [drive(seed) for seed in range(30)]
known = np.mean([two_halves.landmark_nees(one, one.truth.poses) for one in thirty])
trusted = np.mean([two_halves.landmark_nees(one, two_halves.by_wheels(one)) for one in thirty])
print(f"mean NEES of a landmark: true poses {known:.1f}, wheels' poses {trusted:.0f} (2 is right)")

# %% [markdown] slideshow={"slide_type": "fragment"}
# It is not. And on our lap the mean spread of the ellipses is {= 1000 * at_last:.0f =} mm with the true
# poses and {= 1000 * by_the_wheels:.0f =} mm with the wheels'. The filter was told that
# $P_{\mathrm{rr}} = 0$ and believed it. A covariance is only as good as what the filter was told.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## Neither known: can the two halves take turns?
#
# In SLAM both are unknown, and both halves are written. The first idea is to take turns: at each sight correct
# the pose as if the map were exact, and the map as if the pose were exact.
#
# A careful student objects: "Do not pretend. Tell each half how unsure the other one is." Each half then
# works with
#
# $$S = H_{\mathrm r} P_{\mathrm{rr}} H_{\mathrm r}^{\mathsf T} + H_{\mathrm p} P_{ii} H_{\mathrm p}^{\mathsf T} + R.
# \tag{05.11}$$

# %% slideshow={"slide_type": "subslide"}
ask(
    "05-turns",
    "The careful student's two filters drive two laps. Is their NEES of the pose near 3?",
    {
        "yes: all that is uncertain is in S": "all *variances* are; compare (05.11) with (05.2), term "
        "by term.",
        "no, far above 3: they are too sure": "two terms of (05.2) are missing, those that hold what "
        "pose and landmark have in common.",
        "no, far below 3: they are too modest": "adding terms to S does make each single update more "
        "modest; still, each sight counts as news though part of it is an echo.",
    },
    right="no, far above 3: they are too sure",
)

# %% slideshow={"slide_type": "fragment"}
BEGIN, RUNS = 3, 20  # the start is exact, P = 0: NEES means nothing yet
schemes = {
    "one filter for both (lesson 06)": halves_in_turn.together,
    "each takes the other for exact": lambda one: halves_in_turn.in_turn(one, careful=False),
    "each adds the other's covariance": lambda one: halves_in_turn.in_turn(one, careful=True),
}
runs = [drive(seed, replace(LAP, steps=84)) for seed in range(RUNS)]
results = {name: [(one, *scheme(one)) for one in runs] for name, scheme in schemes.items()}
NEES = {name: two_halves.mean_nees(result, BEGIN) for name, result in results.items()}

# %% slideshow={"slide_type": "subslide"} answers="05-turns"
steps = BEGIN + np.arange(len(runs[0]) - BEGIN)
title, (low_20, high_20) = f"Two laps, {RUNS} runs", band(3, RUNS)
fig, _ = views.against_band(steps, NEES, (low_20, high_20), "step", "mean NEES [1]", title)
peaks = [values.max() for values in NEES.values()]
left = [steps[values > high_20][0] for values in list(NEES.values())[1:]]
said = f"NEES of both schemes rises to {min(peaks[1:]):.0f} and more; of one filter, "
views.show(fig, f"{said}to {peaks[0]:.1f}, about where the band ends.")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="05-turns"
# Both schemes leave the band by step {= max(left) =} and climb to {= peaks[1]:.0f =} and
# {= peaks[2]:.0f =}. Their errors are then {= np.sqrt(peaks[1] / 3):.0f =} and
# {= np.sqrt(peaks[2] / 3):.0f =} times as large as they believe. One filter for pose and map, which keeps
# $P_{\mathrm ri}$, takes in the same runs with the same models; its NEES never exceeds
# {= peaks[0]:.1f =}, and the band ends at {= high_20:.1f =}. NEES falls as the second lap begins (step 42):
# the robot is back among landmarks that it placed while its pose was still good.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
believed = {"wheels alone": [two_halves.by_wheels(one) for one in runs]}
believed |= {name: [poses for _, poses, _ in result] for name, result in results.items()}
rms = {n: np.array(list(map(two_halves.rms, runs, poses))) for n, poses in believed.items()}
wheels_rms, together_rms, pretending_rms, careful_rms = rms.values()
for name, errors in rms.items():
    wins = f"smaller than the wheels' in {np.sum(errors < wheels_rms):2} of {RUNS} runs"
    print(f"{name:33} median error {np.median(errors):.2f} m, {wins}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The poses themselves are mostly better than the wheels'. What is wrong is the covariance, and a
# program that relies on it, to recognise a landmark or to avoid a wall, is misled. As for the
# errors themselves, the careful scheme does better than the pretending one in
# {= np.sum(careful_rms < pretending_rms) =} of {= RUNS =} runs, and one filter for both better than
# the careful scheme in {= np.sum(together_rms < careful_rms) =}.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let the careful student win first; the objection is fair, and the reason why it does not
# help is the reason for lesson 06. What fails is not the size of the covariances but that the errors are taken
# for independent. It is like asking for a second opinion and getting your own back, by post.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Why care is not enough
#
# Compare (05.11) with (05.2): the two terms with $P_{\mathrm ri}$, the covariance *between* robot
# and landmark, are gone. This covariance is not small. The robot placed the landmark from its own
# pose, so the error that the pose had then is in the landmark as well.
#
# When the robot sees the landmark again, the shared error cancels and the innovation is small. One filter
# expects that, knowing $P_{\mathrm ri}$, and learns little. Two filters take it each time for a
# confirmation that both were right.

# %% [markdown] slideshow={"slide_type": "subslide"}
# The landmark in sight is not the only one concerned. Row $j$ of the gain, for a landmark that is *not* seen, is
#
# $$K_j = (P_{j\mathrm r} H_{\mathrm r}^{\mathsf T} + P_{ji} H_{\mathrm p}^{\mathsf T})\, S^{-1}, \tag{05.12}$$
#
# and with neither known it is not zero: whoever sees $i$ also learns about $j$. The $N$ little filters have
# become one, and it holds the robot as well.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Literature
#
# J. J. Leonard and H. F. Durrant-Whyte, "Mobile robot localization by tracking geometric beacons", *IEEE
# Transactions on Robotics and Automation* 7(3), 1991: the first half, with sonar.
#
# R. Smith, M. Self and P. Cheeseman, "Estimating uncertain spatial relationships in robotics", in *Autonomous
# Robot Vehicles*, Springer, 1990: why the relations must be kept in one state.
#
# S. J. Julier and J. K. Uhlmann, "A non-divergent estimation algorithm in the presence of unknown correlations",
# *American Control Conference*, 1997: what can be done where $P_{\mathrm ri}$ cannot be kept.
#
# **Read next:** S. Thrun, W. Burgard and D. Fox, *Probabilistic Robotics*, MIT Press, 2005, chapter 7.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## What you can do now
#
# You can find a robot in a known map, draw a map from known poses, say which blocks of $P$ make each easy, and
# refute a scheme that takes turns.
#
# **What comes next:** [lesson 06](06_ekf_slam.ipynb) puts robot and landmarks into one state and keeps
# $P_{\mathrm ri}$. That is EKF-SLAM.
#
# The sections below this one are optional.
#
# **Exercise:** [05 · Two easy halves](../exercises/ex05_two_easy_halves.ipynb). You write both halves, meet a
# sensor that this lesson has not met, and find a robot that is lost and lied to.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: an arc has the same A
#
# A robot that turns *while* it drives goes along an arc, whose chord points half the turn off the old
# heading. That is not lesson 04's $f$, yet (05.4) uses its $A$. The machine agrees:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
x, y, theta, d, turn, dx, dy = sp.symbols("x y theta d Δθ Δx Δy", real=True)
half = theta + turn / 2
arc = sp.Matrix([x + d * sp.cos(half), y + d * sp.sin(half), theta + turn])
same = sp.Matrix([[1, 0, -dy], [0, 1, dx], [0, 0, 1]])
A_steps = derive("A", arc.jacobian([x, y, theta]), "the arc by the pose")
A_steps.step("its displacement has a name", same, given={dx: arc[0] - x, dy: arc[1] - y})

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: does the order of the sights matter?
#
# Information adds up, as (05.6) says, and a sum has no order. So we check (05.6) once, and then play the
# lap's sights in another order.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
x, p = np.array([1, 2, 0.4]), np.array([3, 2.5])
H_there, P_before = jacobians.H_robot(x, p), np.diag([0.1, 0.2, 0.05]) ** 2
b, _ = ekf_localisation.update(Belief(x, P_before), [models.h(x, p)], [p], R)
gained = np.linalg.inv(b.P) - np.linalg.inv(P_before)
print("(05.6) holds:", np.allclose(gained, H_there.T @ np.linalg.inv(R) @ H_there))

shuffled, seen = KnownPoseMap(), list(two_halves.sights(run, run.truth.poses))
for k in np.random.default_rng(5).permutation(len(seen)):
    shuffled.see(*seen[k], two_halves.R(run))
moved = [shuffled.landmarks[i].x - b.x for i, b in whole.landmarks.items()]
print(f"in another order landmarks end up to {1000 * np.abs(moved).max():.1f} mm elsewhere")

# %% [markdown] slideshow={"slide_type": "fragment"}
# It matters a little, because $H_{\mathrm p}$ is taken at the estimate of the moment, and that depends on what came
# before. With a linear sensor, $z = p + \varepsilon$, the order would not matter at all.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: one filter for the whole map
#
# (05.9) says that one large filter computes the same as $N$ little ones. Lesson 06's filter can be told that all
# poses are exact; then its map must be ours, and its cross blocks must be zero.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
large = MAK(np.zeros(3), np.zeros((3, 3)))
for x, reading in zip(run.truth.poses, run, strict=True):
    large.predict(x, np.zeros((3, 3)))
    for id, z in zip(reading.observations.ids.tolist(), reading.observations.z, strict=True):
        (large.update if id in large.ids else large.add)([id], [z], two_halves.R(run))
little = np.array([whole.landmarks[id].x for id in large.ids])
print("means differ by less than 1e-9:", np.abs(large.landmarks() - little).max() < 1e-9)
P_map, own = large.block(np.arange(3, 19)), np.kron(np.eye(8), np.ones((2, 2))) == 1
print("largest entry of all cross blocks:", np.abs(P_map[~own]).max())

# %% [markdown] slideshow={"slide_type": "slide"}
# ## In print
#
# Optional: how the MAK thesis prints this lesson's formulas, if our copy has its subscripts right.
# We found nothing wrong in its sections 4.1 and 4.2, which are the two halves.
#
# | place | printed | right | harm |
# | --- | --- | --- | --- |
# | gain, before (4.10) | $S_{\mathrm{rr}}^{-1}$ | $S_{vv}^{-1}$, our $S^{-1}$ | shapes do not fit |
# | row $j$, before (4.10) | $P_{j\mathrm r} H_{\mathrm r}^{\mathsf T} + P_{ij} H_{\mathrm p}^{\mathsf T}$ | $P_{ji}$, as in (05.12) | wrong gain for unseen landmarks |

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
right = sp.block_collapse(gain_steps.result).blocks[2, 0]
printed = P_jr * H_r.T + P_ji.T * H_p.T
print("row j, right − printed:", sp.expand(right - printed))
try:
    columns * H.T * P_rr.inverse()
except sp.ShapeError:
    print("P Hᵀ, two columns, times the inverse of the 3 × 3 block of the robot: refused")

# %% [markdown] slideshow={"slide_type": "fragment"}
# $P_{ij}$ is the transpose of $P_{ji}$ and has the same shape, so no program would complain.
