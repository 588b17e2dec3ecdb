# %% [markdown] slideshow={"slide_type": "slide"}
# # 05 · Two easy halves
#
# **You will be able to** find a robot in a map that is known (EKF localisation), build a map from
# poses that are known (one little filter a landmark), say why each is easy, and show by a number
# that doing both in turn is not SLAM.
#
# **50 minutes. Before:** lesson 03 (predict, update, COIN, NEES) and lesson 04 (h, g, A, W, H,
# J_z).
#
# Sources: MAK thesis, sections 4.1 and 4.2.
#
# *Key:* an update is easy when only one of the two, pose or landmark, is unknown.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Two halves of 20 minutes and a finale of 10. If time is short, keep "An
# update, block by block" and the finale: lesson 06 stands on these. The rest is what students can
# redo in the exercise.

# %% slideshow={"slide_type": "skip"}
import filterpy.kalman
import numpy as np
import sympy as sp

from slamlab import models, views
from slamlab.models import jacobians
from slamlab.evaluation import band, nees
from slamlab.filters import (
    linear_kalman,
    ekf_localisation,
    known_pose_mapping,
)
from slamlab.geometry import compose, wrap
from slamlab.layers import Ellipses, Points, Poses
from slamlab.sources.landmark_runs import LandmarkRun, Loop

# %% [markdown] slideshow={"slide_type": "slide"}
# ## A lap, and two things nobody knows
#
# A robot drives one lap, counts its wheels' turns, and sees eight landmarks that it can tell apart,
# each only from near by. Where is it? And where are they?

# %% slideshow={"slide_type": "fragment"}
LAP = Loop(landmarks=8, steps=84, range_max=2.0, v_sigma=0.03, omega_sigma=0.03)
run = LandmarkRun(LAP, np.random.default_rng(8))
by_odometry = [np.zeros(3)]
for reading in list(run)[1:]:
    by_odometry.append(compose(by_odometry[-1], reading.odometry))

# %% slideshow={"slide_type": "fragment"}
fig, ax = views.axes("One lap, counted by the wheels", size=(4.4, 4))
views.draw(ax, Poses("truth", run.truth.poses))
views.draw(ax, Poses("naive", by_odometry), label="odometry alone")
views.draw(ax, Points("landmark", run.landmarks), label="landmarks", markersize=9)
views.legend(ax, loc="center")
views.show(fig, "The true lap closes; odometry's lap ends more than two metres off.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the wheels lose the robot within one lap. Only the landmarks can help. But who says where
# *they* are?
#
# **Predict:** which is easier: to find the robot when the map is known, or to draw the map when the
# robot's way is known? And why is it not enough to be able to do both?

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Collect answers on the board and come back to them at the end. A common one
# to the last question is "first the one, then the other, and so on". That is the finale.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## An update, block by block
#
# Put robot r, the landmark i that is seen, and another one j into one state. **Question.** Which
# parts of P does an update need? Lesson 03's two formulas, with blocks for letters:

# %% slideshow={"slide_type": "fragment"}
size = {"r": 3, "i": 2, "j": 2}
P_ = {(a, b): sp.MatrixSymbol(f"P_{a}{b}", size[a], size[b]) for a in "rij" for b in "rij"}
H_r, H_p, R_ = (
    sp.MatrixSymbol("H_r", 2, 3),
    sp.MatrixSymbol("H_p", 2, 2),
    sp.MatrixSymbol("R", 2, 2),
)
H = sp.BlockMatrix([[H_r, H_p, sp.ZeroMatrix(2, 2)]])
P = sp.BlockMatrix([[P_[a, b] for b in "rij"] for a in "rij"])

# %% [markdown] slideshow={"slide_type": "fragment"}
# H has a block for the robot and one for the landmark that is seen; the other landmark has no part
# in the measurement. S, the innovation's covariance:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
S = sp.expand(sp.block_collapse(H * P * H.T)) + R_
S

# %% [markdown] slideshow={"slide_type": "fragment"}
# And P Hᵀ, of which the gain is K = P Hᵀ S⁻¹. A row each for the robot, i and j:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
PHt = sp.block_collapse(P * H.T)
PHt

# %% [markdown] slideshow={"slide_type": "fragment"}
# Everything correlates with everything. Now let the machine forget: **what is known exactly has no
# covariance, not even with others.**


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
def known(expression, names):
    """The expression when the parts of the state named are known exactly."""
    zeros = {P_[a, b]: sp.ZeroMatrix(size[a], size[b]) for a, b in P_ if a in names or b in names}
    return sp.block_collapse(expression.subs(zeros).doit())


print("map known:   S =", known(S, "ij"))
print("robot known: S =", known(S, "r"))

# %% [markdown] slideshow={"slide_type": "fragment"}
# In each half S holds one covariance and R: the innovation depends only on *one* error and the
# noise. That is lesson 03's COIN, and it is all that makes the halves easy.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## First half: where am I, in a known map?
#
# The state is the pose, three numbers. The robot predicts by its wheels.
#
# It turns *while* it drives, so a step of length d points half the turn off the old heading. That is
# not lesson 04's `f_odometry`, which drives along the old heading and then turns (the exercise keeps
# to it). One more model, f_arc, so one more pair of Jacobians:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
x, y, theta, d, turn = sp.symbols("x y θ d Δθ")
half = theta + turn / 2
f_arc = sp.Matrix([x + d * sp.cos(half), y + d * sp.sin(half), theta + turn])
f_arc.jacobian([x, y, theta])

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
f_arc.jacobian([d, turn])

# %% [markdown] slideshow={"slide_type": "slide"}
# ## The filter, in two functions
#
# C is the wheels' noise, R the sensor's: variances, in m² and rad².

# %% slideshow={"slide_type": "fragment"}
C = np.diag([0.03, 0.03]) ** 2
R = np.diag([0.1, np.radians(2)]) ** 2


def predict(x, P, u):
    """Drive u = (d, Δθ): x ← f_arc(x, u), P ← A P Aᵀ + W C Wᵀ."""
    d, turn = u
    c, s = np.cos(x[2] + turn / 2), np.sin(x[2] + turn / 2)
    A = np.array([[1, 0, -d * s], [0, 1, d * c], [0, 0, 1]])
    W = np.array([[c, -d / 2 * s], [s, d / 2 * c], [0, 1]])
    return x + np.array([d * c, d * s, turn]), A @ P @ A.T + W @ C @ W.T


# %% slideshow={"slide_type": "fragment"}
def update(x, P, z, p, R=R):
    """See the landmark at p, which is known, at z = (r, β)."""
    v = z - models.h(x, p)
    v[1] = wrap(v[1])
    H = jacobians.H_robot(x, p)
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T


# %% [markdown] slideshow={"slide_type": "slide"}
# ## COIN, in numbers
#
# With p known, v = h(x, p) + r − h(x̂, p) ≈ H x̃ + r: the pose's error x̃ and the noise r, nothing
# else. **Predict** the deviations of v from S; 2000 robots that stand where the belief allows tell.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
x_there, p_there, P_there = (
    np.array([1, 2, 0.4]),
    np.array([3, 2.5]),
    np.diag([0.1, 0.1, 0.05]) ** 2,
)
rng = np.random.default_rng(5)
stand = rng.multivariate_normal(x_there, P_there, 2000)
noise = rng.multivariate_normal([0, 0], R, 2000)
v = np.array([models.h(x, p_there) for x in stand]) + noise - models.h(x_there, p_there)
H_there = jacobians.H_robot(x_there, p_there)
S_there = H_there @ P_there @ H_there.T + R
print("robots ", v.std(axis=0).round(3), " √S", np.sqrt(np.diag(S_there)).round(3), "[m, rad]")

# %% [markdown] slideshow={"slide_type": "slide"}
# ## The loop
#
# That is all of it. What is left is a loop: drive, look, drive, look. At the start the robot knows
# its pose only roughly, P_START.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask which of the two functions makes the ellipse grow and which makes it
# shrink. Then ask whether `update` can ever make it grow. It cannot: K S Kᵀ is positive
# semidefinite.


# %% slideshow={"slide_type": "fragment"}
P_START = np.diag([0.2, 0.2, 0.1]) ** 2


def wheels(reading):
    """The step d and the turn Δθ that odometry counted."""
    return np.hypot(*reading.odometry[:2]), reading.odometry[2]


def localise(run, landmarks, start, update=update):
    """The pose and its covariance after every reading of a run."""
    x, P, history = start, P_START, []
    for reading in run:
        x, P = predict(x, P, wheels(reading)) if reading.time else (x, P)
        for id, z in zip(reading.observations.ids, reading.observations.z, strict=True):
            x, P = update(x, P, z, landmarks[id])
        history.append((x, P))
    poses, covariances = map(np.array, zip(*history, strict=True))
    return poses, covariances


# %% [markdown] slideshow={"slide_type": "slide"}
# ## The lap again, with a map
#
# **Predict:** where on the lap are the ellipses largest? Is the last one larger than the first?

# %% slideshow={"slide_type": "fragment"}
START = np.random.default_rng(5).multivariate_normal(np.zeros(3), P_START)
poses, covariances = localise(run, run.landmarks, START)


def eyes_shut(x, P, z, p):
    return x, P


def lap(run, poses, covariances, every=4, name="corrected"):
    """The layers of a lap: truth, estimate, an ellipse every so many steps."""
    return [
        Poses("truth", run.truth.poses),
        Poses(name, poses),
        Ellipses("robot", poses[::every, :2], covariances[::every, :2, :2]),
        Points("landmark", run.landmarks),
    ]


# %% slideshow={"slide_type": "slide"}
blind = localise(run, run.landmarks, START, eyes_shut)
laps = {
    "eyes shut: predict only": lap(run, *blind, every=12, name="predicted"),
    "located in a known map": lap(run, poses, covariances),
}
fig, both = views.side_by_side(laps, size=(8, 4))
for ax in both:
    ax.lines[-1].set(markersize=8)
    views.legend(ax, loc="center")
views.show(fig, "Left, ellipses that grow and stay large; right, small ones on the true lap.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** without eyes the ellipses grow, and nothing makes them small again. With a map they do
# not: they are as large at the end as in the middle, and larger only where no landmark is near.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## The robot's covariance breathes
#
# Look at one component over time, with the band that should hold it 95 times out of 100.

# %% slideshow={"slide_type": "fragment"}
steps = np.arange(len(run))
sigma_y = np.sqrt(covariances[:, 1, 1])
error_y = poses[:, 1] - run.truth.poses[:, 1]
lines = {"error of y": error_y, "± 2σ": 2 * sigma_y, "": -2 * sigma_y}
title = "The error and what the filter believes of it"
fig, ax = views.curves(steps, lines, "step", "[m]", title, size=(5.4, 3.1))
looking = np.array([len(reading.observations.ids) > 0 for reading in run])
ax.lines[2].set(color=ax.lines[1].get_color(), linestyle="dashed")
ax.plot(
    steps[looking],
    np.full(looking.sum(), -0.4),
    "|",
    color=views.COLOURS["truth"],
    label="sees a landmark",
)
ax.set_ylim(-0.45, 0.5)
views.legend(ax, loc="upper right", ncols=3)
views.show(fig, "The error of y stays within a band that widens where no landmark is seen.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** where the strip at the bottom has a gap, the band opens; at the next sighting it snaps
# shut. The robot's own covariance is *not* monotone. Keep that in mind: the map's will be.
#
# It also opens from step 8 to 20, where a landmark is in sight all the time, one and the same. Why?

# %% [markdown] slideshow={"slide_type": "slide"}
# ## What one landmark cannot tell
#
# A sighting is two numbers, a pose three. **Predict:** a robot that knows its heading to 0.4 rad,
# and nothing of its place, sees one landmark, at 2 m. Where may it be? Draw the set of poses.

# %% [markdown] slideshow={"slide_type": "fragment"}
# In lesson 03 a measurement added 1/R to 1/P. With matrices, what a sighting adds to the information
# P⁻¹ is HᵀR⁻¹H:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
P_after = update(x_there, P_there, models.h(x_there, p_there), p_there)[1]
gained = np.linalg.inv(P_after) - np.linalg.inv(P_there)
print("P⁻¹ after − P⁻¹ before:", gained.round(1), sep="\n")
print("is HᵀR⁻¹H:", np.allclose(gained, H_there.T @ np.linalg.inv(R) @ H_there))

# %% [markdown] slideshow={"slide_type": "fragment"}
# A direction that H does not feel gains nothing. Which one is it?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
p_x, p_y = sp.symbols("p_x p_y")
offset = sp.Matrix([p_x - x, p_y - y])
z_seen = sp.Matrix([offset.norm(), sp.atan2(offset[1], offset[0]) - theta])
symbols_real = {s: sp.Symbol(s.name, real=True) for s in (x, y, theta, p_x, p_y)}
H_seen = z_seen.subs(symbols_real).jacobian([symbols_real[s] for s in (x, y, theta)])
round_it = sp.Matrix([offset[1], -offset[0], 1]).subs(symbols_real)
sp.simplify(H_seen * round_it).T

# %% [markdown] slideshow={"slide_type": "fragment"}
# The direction (p_y − y, −(p_x − x), 1) is a step *round* the landmark, with a turn that keeps it
# in view: nothing changes in range or bearing. So a circle of poses remains.

# %% slideshow={"slide_type": "fragment"}
vague, P_vague = np.array([0, 0, 0.3]), np.diag([5, 5, 0.4]) ** 2
two = np.array([[1.7, 1.0], [0.4, -1.6]])
z_one, z_two = models.h(vague, two)

# poses from which the first landmark is seen at z_one: any heading, and the place that goes with it
rng = np.random.default_rng(5)
headings = rng.normal(vague[2], 0.4, 6000)
looks = rng.multivariate_normal(z_one, R, 6000)
turned = np.column_stack([np.zeros((6000, 2)), headings])
one_agrees = np.column_stack([two[0] - models.g(turned, looks), headings])

# of these, those that agree with the second sighting, too
v = np.array([models.h(pose, two[1]) for pose in one_agrees]) - z_two
v[:, 1] = wrap(v[:, 1])
both_agree = one_agrees[np.sum(v**2 / np.diag(R), axis=1) < 6]


# %% slideshow={"slide_type": "fragment"}
beliefs, P = {}, P_vague
for n, agreeing in ((1, one_agrees[:300]), (2, both_agree[:150])):
    P = update(vague, P, models.h(vague, two[n - 1]), two[n - 1])[1]
    beliefs[f"landmarks seen: {n}"] = [
        Points("poses that agree", agreeing[:, :2]),
        Ellipses("corrected", [vague[:2]], [P[:2, :2]]),
        Points("landmark", two[:n]),
    ]
fig, both = views.side_by_side(beliefs, size=(7.6, 3.6))
for ax in both:
    ax.lines[-1].set(markersize=9)
    views.legend(ax, loc="upper right")
views.show(fig, "With one landmark the poses form an arc round it; with two, a small cloud.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** with one landmark, the poses that agree lie on an arc round it; the filter's ellipse lies
# along the arc's tangent, narrow towards the landmark, wide across (and straight: lesson 04). The
# second landmark has an arc of its own: where the two cross, the robot is.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
H_one, H_two = jacobians.H_robot(vague, two[0]), jacobians.H_robot(vague, two).reshape(-1, 3)
print("rank of HᵀR⁻¹H: one landmark", np.linalg.matrix_rank(H_one), " two", end=" ")
print(np.linalg.matrix_rank(H_two))

# %% [markdown] slideshow={"slide_type": "slide"}
# ## How far must it see?
#
# **Predict** what becomes of the ellipses when the robot sees only 1.5 m far. 3 m? 1 m? Then move the
# slider.


# %% slideshow={"slide_type": "fragment"}
def with_eyes(metres):
    far = Loop(landmarks=8, steps=84, range_max=metres, v_sigma=0.03, omega_sigma=0.03)
    other = LandmarkRun(far, np.random.default_rng(8))
    poses, covariances = localise(other, other.landmarks, START)
    fig, ax = views.axes(f"Sees {metres:.1f} m far", size=(4.4, 4))
    for layer in lap(other, poses, covariances):
        views.draw(ax, layer)
    ax.lines[-1].set(markersize=8)
    return fig


views.explore(
    with_eyes,
    "The shorter its eyes reach, the larger the ellipses where no landmark is near.",
    metres=(0.8, 5.0, 1.5),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** with 1.5 m of sight the ellipses swell between landmarks, and the estimate leaves the true
# lap, yet the truth stays inside them. At 3 m they all but vanish. At 1.4 m and below the filter
# gets lost: the ellipse is as large as the distance to the landmark, H is taken at a place where
# the robot is not, and the correction goes astray. The small ellipses after that say nothing of it.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Is it honest? NEES over 100 runs
#
# One lap proves nothing (lesson 03). 100 laps, each with its own landmarks, noise and start: is the
# squared error, in units of the covariance, 3 on average?


# %% slideshow={"slide_type": "fragment"}
def nees_of(runs, localiser=localise, off=0.0, loop=LAP):
    """Mean NEES of the pose over runs, step by step; off: how wrong the map is [m]."""
    values = []
    for seed in range(runs):
        run, rng = LandmarkRun(loop, np.random.default_rng(seed)), np.random.default_rng([seed, 1])
        start = rng.multivariate_normal(np.zeros(3), P_START)
        way = rng.uniform(0, 2 * np.pi, loop.landmarks)
        landmarks = run.landmarks + off * np.column_stack([np.cos(way), np.sin(way)])
        poses, covariances = localiser(run, landmarks, start)
        error = poses - run.truth.poses
        error[:, 2] = wrap(error[:, 2])
        values.append(nees(error, covariances))
    return np.mean(values, axis=0)


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
honest, (low, high) = nees_of(100), band(3, 100)
inside = np.mean((honest > low) & (honest < high))
print(f"mean {honest.mean():.2f}, in the band {low:.2f} to {high:.2f} at {inside:.0%} of the steps")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The filter is what it claims to be. (Not just 95 % of the steps: those of a run hang together, so
# the curve wanders slowly.)

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Break it
#
# **Predict** what NEES does (1) when the innovation's bearing is not wrapped, (2) when the "known"
# map is wrong: every landmark stands 0.3 m off, each in a direction of its own.


# %% slideshow={"slide_type": "fragment"}
def update_unwrapped(x, P, z, p):
    v = z - models.h(x, p)
    H = jacobians.H_robot(x, p)
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T


def unwrapped(run, landmarks, start):
    return localise(run, landmarks, start, update_unwrapped)


# %% slideshow={"slide_type": "fragment"}
# eyes that reach 3 m see some landmarks right behind the robot
FAR = Loop(landmarks=8, steps=84, range_max=3.0, v_sigma=0.03, omega_sigma=0.03)
broken = {
    "honest": nees_of(100, loop=FAR),
    "bearing not wrapped": nees_of(100, unwrapped, loop=FAR),
    "map 0.3 m off": nees_of(100, off=0.3, loop=FAR),
}


def against_band(values, runs, title, begin=0):
    """NEES over the steps on a logarithmic scale, with the 95 % band."""
    steps = begin + np.arange(len(next(iter(values.values()))))
    fig, ax = views.curves(steps, values, "step", "mean NEES [1]", title, size=(5.4, 3.2))
    views.band(ax, *band(3, runs), "95 % band")
    ax.set(yscale="log", ylim=(2, 15 * max(map(np.max, values.values()))))
    views.legend(ax, loc="upper right", ncols=2)
    return fig


views.show(
    against_band(broken, 100, "100 laps, broken in two ways"),
    "NEES of the honest filter stays in the band; the two broken ones lie far above it.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the scale is logarithmic. An unwrapped bearing strikes only when a landmark is right
# behind the robot, and then throws it far off. A map that is 0.3 m wrong makes NEES thirty times
# too large, and it never gets better: the filter trusts the map completely, since P_ii = 0 says so.
#
# **Nobody has an exact map.** So landmarks need a covariance, too: the other half.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Someone will say "make R larger". It helps, up to a point: a wrong landmark
# errs the same way at every sighting, while R stands for noise that is drawn anew. Thirty sightings
# average noise away; they do not average a wrong map away.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## The tools of the trade agree
#
# filterpy's extended Kalman filter and `slamlab.filters.ekf_localisation`, step for step:


# %% slideshow={"slide_type": "fragment"}
def difference(z, z_predicted):
    """filterpy asks how measurements are subtracted: with the bearing wrapped."""
    v = z - z_predicted
    return np.array([v[0], wrap(v[1])])


def update_by_filterpy(x, P, z, p):
    peer = filterpy.kalman.ExtendedKalmanFilter(dim_x=3, dim_z=2)
    peer.x, peer.P, peer.R = x, P, R
    peer.update(z, jacobians.H_robot, models.h, args=(p,), hx_args=(p,), residual=difference)
    return peer.x, peer.P


def update_by_slamlab(x, P, z, p):
    after, _ = ekf_localisation.update(linear_kalman.Belief(x, P), [z], [p], R)
    return after.x, after.P


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for name, peer in (("filterpy", update_by_filterpy), ("slamlab", update_by_slamlab)):
    its_poses, its_covariances = localise(run, run.landmarks, START, peer)
    off = its_poses - poses
    off[:, 2] = wrap(off[:, 2])
    apart = max(np.abs(off).max(), np.abs(its_covariances - covariances).max())
    print(f"{name:9} differs by less than 1e-12: {apart < 1e-12}")

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Second half: where are they, if I know where I am?
#
# Now the poses are known exactly (say, by a camera on the ceiling). The state is the map.
#
# **Question.** N landmarks are 2N numbers. Is it one filter with a 2N × 2N covariance? Ask the
# blocks from above what an update of i does to j, when the robot is known:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
known(PHt, "r")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Row j is P_ji H_pᵀ. While P_ji = 0, seeing i tells nothing of j; and P_ij after the update is P_ij
# − K_i S K_jᵀ, zero again. When is it zero at the start? A new landmark is made from the pose and
# its measurement: the pose has no error, and each measurement has its own. **So the cross blocks
# are zero for ever: N little filters of size 2.**

# %% [markdown] slideshow={"slide_type": "slide"}
# ## A little filter
#
# First sight places the landmark: p = g(x, z), P = J_z R J_zᵀ. After that, updates, as above, with
# H_landmark for H_robot. There is no predict: landmarks do not move.


# %% slideshow={"slide_type": "fragment"}
def see(beliefs, x, id, z, R=R):
    """From the known pose x, landmark id was seen at z; beliefs: id to (p, P)."""
    if id not in beliefs:
        J_z = jacobians.J_z(x, z)
        beliefs[id] = models.g(x, z), J_z @ R @ J_z.T
        return
    p, P = beliefs[id]
    v = z - models.h(x, p)
    v[1] = wrap(v[1])
    H = jacobians.H_landmark(x, p)
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    beliefs[id] = p + K @ v, P - K @ S @ K.T


def sightings(run, poses):
    """Everything seen in a run: pose, id and z, one after the other."""
    for x, reading in zip(poses, run, strict=True):
        for id, z in zip(reading.observations.ids.tolist(), reading.observations.z, strict=True):
            yield x, id, z


# %% [markdown] slideshow={"slide_type": "fragment"}
# **Predict:** the map after a landmark's first sighting, and after the whole lap: which ellipses
# shrink, and by how much?

# %% slideshow={"slide_type": "fragment"}
first, whole = {}, {}
for x, id, z in sightings(run, run.truth.poses):
    if id not in first:
        see(first, x, id, z)
    see(whole, x, id, z)


def drawn(beliefs, poses):
    """The layers of a map: the way, the landmarks' ellipses, the truth."""
    p, P = zip(*beliefs.values(), strict=True)
    return [Poses("way", poses), Ellipses("landmark", p, P), Points("truth", run.landmarks)]


def maps(layers_by_title):
    """Maps side by side, true landmarks as crosses."""
    fig, both = views.side_by_side(layers_by_title, size=(7.6, 3.7))
    for ax in both:
        ax.lines[-1].set(marker="x", markersize=5, markeredgewidth=1, label="true landmark")
    views.legend_below(fig)
    return fig, both


titles = {"after first sight": first, "after the whole lap": whole}
layers = {title: drawn(beliefs, run.truth.poses) for title, beliefs in titles.items()}
fig, both = maps(layers)
both[0].set(xlim=(-3, -1.3), ylim=(3.4, 5.1))  # two of the eight
views.show(fig, "At first sight the ellipses are half a metre long; after the lap they are small.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** two of the eight landmarks, near by. Both ellipses have shrunk, the upper one (seen nine
# times) more than the lower one (five times), and the true landmarks are still in them, if only
# just: 95 % is not always.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## How fast does it shrink?
#
# A robot stands still and sees a landmark again and again, 64 times. **Predict** the variance after
# k sightings. 300 such robots tell the mean squared error.

# %% slideshow={"slide_type": "fragment"}
at, mark, looks = np.array([0.5, 0.2, 0.4]), np.array([2.0, 1.5]), [1, 2, 4, 8, 16, 32, 64]
rng = np.random.default_rng(5)
noise = rng.multivariate_normal([0, 0], R, (300, 64))
squared = np.zeros((300, 64))
for robot in range(300):
    beliefs = {}
    for k in range(64):
        see(beliefs, at, 0, models.h(at, mark) + noise[robot, k])
        squared[robot, k] = np.sum((beliefs[0][0] - mark) ** 2)

# %% slideshow={"slide_type": "fragment"}
mean_squared = squared.mean(axis=0)[np.array(looks) - 1]
J = jacobians.J_z(at, models.h(at, mark))
one_look = np.trace(J @ R @ J.T)
fig, ax = views.growth(
    looks,
    {"mean squared error of 300 robots": mean_squared},
    {"trace(J_z R J_zᵀ) / k": one_look / np.array(looks)},
    "sightings k",
    "squared error [m²]",
    size=(5, 3.3),
)
views.show(fig, f"The measured squared errors lie on the falling line over {looks[-1]} sightings.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** 1/k, as with the mean of k numbers: that is what each little filter computes.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## What it costs
#
# Each observation touches one filter of size 2, however large the map: O(1). Memory: 2 + 4 numbers
# a landmark (symmetry ignored), O(N). **Predict** the same for one big filter of 2N.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for N in (8, 100, 10_000):
    print(f"N = {N:6}: {6 * N:8,} numbers apart, {2 * N + (2 * N) ** 2:12,} in one filter")

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Apart or together: the same map
#
# Believe the blocks, but check. One filter with all eight landmarks in its state, same sightings,
# its full covariance kept:


# %% slideshow={"slide_type": "fragment"}
def together(run, poses):
    """One filter for the whole map: mean (2N,), covariance (2N, 2N), placed at first sight."""
    n = 2 * len(run.landmarks)
    m, P, placed = np.zeros(n), np.zeros((n, n)), set()
    for x, id, z in sightings(run, poses):
        i = slice(2 * id, 2 * id + 2)
        if id not in placed:
            placed.add(id)
            J_z = jacobians.J_z(x, z)
            m[i], P[i, i] = models.g(x, z), J_z @ R @ J_z.T
            continue
        v = z - models.h(x, m[i])
        H = np.zeros((2, n))
        H[:, i] = jacobians.H_landmark(x, m[i])
        S = H @ P @ H.T + R
        K = P @ H.T @ np.linalg.inv(S)
        m, P = m + K @ [v[0], wrap(v[1])], P - K @ S @ K.T
    return m, P


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
m, P = together(run, run.truth.poses)
blocks = P.reshape(8, 2, 8, 2).transpose(0, 2, 1, 3)
cross = blocks[~np.eye(8, dtype=bool)]
apart = max(np.abs(m[2 * i : 2 * i + 2] - p).max() for i, (p, _) in whole.items())
print("largest entry of all 56 cross blocks:", np.abs(cross).max())
print("means differ by less than 1e-12:", apart < 1e-12)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
peer = known_pose_mapping.KnownPoseMap()
for x, id, z in sightings(run, run.truth.poses):
    peer.see(x, id, z, R)
apart = max(np.abs(peer.landmarks[i].x - p).max() for i, (p, _) in whole.items())
print("KnownPoseMap of the package differs by less than 1e-12:", apart < 1e-12)

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Does the order matter?
#
# Information adds up, and a sum has no order: P⁻¹ = P_first⁻¹ + Σ HᵀR⁻¹H. **Predict:** play the
# lap's sightings in another order. Is the map the same, to rounding?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
shuffled, seen = {}, list(sightings(run, run.truth.poses))
for k in np.random.default_rng(5).permutation(len(seen)):
    see(shuffled, *seen[k])
moved = [np.linalg.norm(shuffled[i][0] - whole[i][0]) for i in whole]
sigma = [np.sqrt(np.trace(whole[i][1])) for i in whole]
print(f"EKF: moved by {np.max(np.divide(moved, sigma)):.2f} σ at most")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Nearly. H is taken at the estimate of the moment, and that depends on what came before. A sensor
# that measures x and y directly, H = I, is linear, and there the order is truly nothing:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
direct = rng.multivariate_normal(mark, 0.01 * np.eye(2), 30)
ends = []
for order in (range(1, 30), range(29, 0, -1)):
    b = linear_kalman.Belief(direct[0], 0.01 * np.eye(2))
    for k in order:
        b, _ = linear_kalman.update(b, direct[k], np.eye(2), 0.01 * np.eye(2))
    ends.append(b.x)
print("linear: the same to 1e-12 m:", np.abs(ends[0] - ends[1]).max() < 1e-12)

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Break it: poses that are not known
#
# Take odometry's poses for the truth. **Predict:** the ellipses will be … larger? The same?

# %% slideshow={"slide_type": "fragment"}
trusting = {}
for x, id, z in sightings(run, by_odometry):
    see(trusting, x, id, z)
layers = {
    "from the true poses": drawn(whole, run.truth.poses),
    "from odometry's poses": drawn(trusting, by_odometry),
}
fig, _ = maps(layers)
views.show(fig, "From odometry's poses the ellipses are as small, and far from the true landmarks.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the ellipses on the right are just as small, and they miss the true landmarks by many
# times their size. In numbers, over 50 laps:


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
def nees_of_map(seed, odometry):
    """Mean NEES of the landmarks of a run, mapped from its true poses or from odometry's."""
    run, beliefs, poses = LandmarkRun(LAP, np.random.default_rng(seed)), {}, [np.zeros(3)]
    for reading in list(run)[1:]:
        poses.append(compose(poses[-1], reading.odometry))
    for x, id, z in sightings(run, poses if odometry else run.truth.poses):
        see(beliefs, x, id, z)
    return np.mean([nees(p - run.landmarks[id], P) for id, (p, P) in beliefs.items()])


for name, odometry in (("true poses", False), ("odometry's poses", True)):
    mean = np.mean([nees_of_map(seed, odometry) for seed in range(50)])
    print(f"{name:17} mean NEES of a landmark {mean:6.1f} (2 is right)")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The filter was told P_rr = 0 and believed it. A covariance is only as good as what it was told.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Neither known: each half in turn?
#
# The obvious idea: at each sighting, correct the pose as if the map were exact, and the map as if
# the pose were exact. Both halves are written.
#
# A careful student objects: "Do not pretend. Tell each half how unsure the other is: add H_p P_ii
# H_pᵀ to the R of the one, and H_r P_rr H_rᵀ to the R of the other." Fair enough; we try that, too.


# %% slideshow={"slide_type": "fragment"}
def in_turn(run, careful):
    """Pose and covariance after every reading, from two halves that take turns."""
    x, P, beliefs, history = np.zeros(3), np.zeros((3, 3)), {}, []
    for reading in run:
        x, P = predict(x, P, wheels(reading)) if reading.time else (x, P)
        for id, z in zip(reading.observations.ids, reading.observations.z, strict=True):
            p, P_ii = beliefs.get(id, (models.g(x, z), np.zeros((2, 2))))
            H_r, H_p = jacobians.H_robot(x, p), jacobians.H_landmark(x, p)
            R_pose, R_map = R, R
            if careful:
                R_pose, R_map = R + H_p @ P_ii @ H_p.T, R + H_r @ P @ H_r.T
            pose_before, is_known = x, id in beliefs
            if is_known:
                x, P = update(x, P, z, p, R_pose)
            see(beliefs, pose_before, id, z, R_map)
        history.append((x, P))
    return history


# %% [markdown] slideshow={"slide_type": "fragment"}
# **Predict** NEES over two laps for both. The band is 2.4 to 3.7.

# %% slideshow={"slide_type": "fragment"}
TWO_LAPS = Loop(landmarks=8, steps=168, range_max=2.0, v_sigma=0.03, omega_sigma=0.03)
BEGIN = 5  # the start is exact, P = 0: its NEES has no meaning yet


def nees_in_turn(runs, careful):
    values = []
    for seed in range(runs):
        run = LandmarkRun(TWO_LAPS, np.random.default_rng(seed))
        poses, P = map(np.array, zip(*in_turn(run, careful), strict=True))
        error = poses - run.truth.poses
        error[:, 2] = wrap(error[:, 2])
        values.append(nees(error[BEGIN:], P[BEGIN:]))
    return np.mean(values, axis=0)


# %% slideshow={"slide_type": "slide"}
turns = {
    "each pretends the other is exact": nees_in_turn(50, careful=False),
    "each adds the other's covariance to R": nees_in_turn(50, careful=True),
}
fig = against_band(turns, 50, "Two laps of two halves in turn, 50 runs", BEGIN)
views.show(fig, "NEES of both schemes rises from near the band to hundreds within a lap.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** both leave the band at once and end at hundreds: an error over ten times what the filter
# believes. NEES falls round step 84, where the robot meets its first landmarks again, which it
# placed while its pose was still good; then it climbs again.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let the careful student win first: their scheme is better than pretending, and
# the reason why it fails is the reason for lesson 06. What fails is not the size of the covariances
# but that they are taken as independent: the robot placed the landmark with its own error, so
# seeing it again says nothing about that error. It is like asking for a second opinion and getting
# your own, by post.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Why
#
# Once more, what the innovation depends on when nothing is known:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
S

# %% [markdown] slideshow={"slide_type": "fragment"}
# Pretending keeps one term and R. The careful student keeps two. Both drop P_ri, the covariance
# *between* robot and landmark. It is not small: the robot placed the landmark, so they share one
# error. A robot that sees its own landmark again has learned nothing about that shared error, and
# only P_ri could tell it so.

# %% [markdown] slideshow={"slide_type": "fragment"}
# The gain's row for a landmark j that is *not* seen:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
PHt.blocks[2, 0]

# %% [markdown] slideshow={"slide_type": "fragment"}
# With neither known it is not zero: who sees i learns about j. The N filters have become one.
#
# (Before its (4.10) the thesis prints this row as P_jr H_rᵀ + P_ij H_pᵀ, where P_ji is meant, if our
# copy has the subscripts right, and S_rr⁻¹ in the gain, where our S, its S_vv, is meant. Sections 4.1
# and 4.2, the two halves, hold.)

# %% [markdown] slideshow={"slide_type": "slide"}
# ## What you can do now
#
# Find a robot in a known map, map from known poses, say which blocks of P make each easy, and
# refute a filter that takes them in turn.
#
# **Next:** [lesson 06](06_ekf_slam.ipynb) puts robot and landmarks into one state and keeps P_ri:
# the MAK filter, EKF-SLAM.
#
# **Exercise:** [write both halves](../exercises/ex05_two_easy_halves.ipynb), and have them judged by
# what honest filters obey.
