# %% [markdown] slideshow={"slide_type": "slide"}
# # 13 · Scan matching
#
# **You will be able to** derive the motion that lays one cloud of points over another, write ICP in
# fifteen lines, point to point and point to line, watch it work round by round, say when it should
# stop, what leads it astray, from how far off it finds home and how sure it may be of the result.
#
# **120 minutes** (40 for the first derivation, 40 for ICP, 40 for point to line and what it knows).
# **Before:** lesson 01 for poses and scans; lesson 03 for covariances; the singular value
# decomposition, as "every matrix is a rotation, a stretch, a rotation".
#
# Source: Tuček, chapter 3 and the listings `icp.py` and `slam.py`.
#
# *Key:* if you knew the pairs you would know the motion; if you knew the motion you would know the
# pairs. So guess one, and improve both in turn.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Three lectures' worth if all is derived: (1) the motion of paired points,
# down to the determinant; (2) ICP, watched, its end, the polygon, partial overlap, the listing's
# mistake; (3) point to line, the basin, the covariance, the corridor. Part 2 stands alone for a
# class that believes the SVD formula; part 3 needs part 2.

# %% slideshow={"slide_type": "skip"}
from dataclasses import replace

import numpy as np
import sympy as sp
from scipy.spatial import cKDTree

from slamlab import estimators, sources, views
from slamlab.estimators import runner
from slamlab.evaluation import load_relations, relations_error
from slamlab.geometry import between, compose, transform
from slamlab.layers import Points, Poses, Segments
from slamlab.scanmatching import match, normals, point_to_line, point_to_point
from slamlab.simulation import RPLIDAR_A2
from slamlab.sources import simulation
from slamlab.worlds import World
from slamlab.worlds import box, ring

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Two scans of one place
#
# A cardboard polygon with a box and a cylinder in it. The robot scans it, turns by −45°, drives
# 27.3 cm and scans again. Its odometry is badly wrong: it claims −35° and 15 cm.

# %% slideshow={"slide_type": "fragment"}
readings = list(simulation("polygon-wrong", np.random.default_rng(1)))
first, second = readings[0].scan.points(), readings[1].scan.points()
guess = readings[1].odometry
true_motion = np.array([0.273 * np.cos(np.pi / 4), -0.273 * np.sin(np.pi / 4), -np.pi / 4])


# %% slideshow={"slide_type": "fragment"}
def off(pose, truth=true_motion):
    """How far a pose lies from the truth: millimetres, degrees."""
    dx, dy, turn = between(truth, pose)
    return 1000 * np.hypot(dx, dy), abs(np.degrees(turn))


def told(pose, truth=true_motion):
    """The same in words."""
    return "{:.0f} mm and {:.1f}° off".format(*off(pose, truth))


# %% slideshow={"slide_type": "subslide"}
title = f"by odometry: {told(guess)}"
fig, _ = views.overlay(first, transform(guess, second), title=title)
views.show(fig, "Two scans of the polygon that do not fit: the second is turned and shifted.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the same walls twice, 10° and 13 cm apart. Your eye already turns the orange scan until
# it fits. Nobody told you which orange point belongs to which blue one.
#
# **Question.** How does a machine do that? **Predict:** what would you need to know to work out the
# motion exactly? How many points of each scan are really *the same spot* on the wall?

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The answer to the last one is: none. Beams hit where they hit. So "the pairs"
# do not even exist; nearest points only stand for the same wall. That is why point to point keeps
# an error however long it runs, and why point to line (below) is better.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## If the pairs were known
#
# Source point $a_i$ is seen at target point $b_i$. Which rotation R and shift t make
#
# $$E(R, t) = \sum_i \left|R\,a_i + t - b_i\right|^2$$
#
# smallest? Four numbers in R, but only one freedom: the angle θ. Let three symbolic pairs stand for
# all.

# %% slideshow={"slide_type": "fragment"}
theta, t_x, t_y = sp.symbols("theta t_x t_y", real=True)
a = sp.Matrix(2, 3, sp.symbols("a_x1:4 a_y1:4", real=True))
b = sp.Matrix(2, 3, sp.symbols("b_x1:4 b_y1:4", real=True))
R = sp.Matrix([[sp.cos(theta), -sp.sin(theta)], [sp.sin(theta), sp.cos(theta)]])
t = sp.Matrix([t_x, t_y])


# %% slideshow={"slide_type": "fragment"}
def squares(M):
    """Sum of the squares of a matrix's entries."""
    return sum(entry**2 for entry in M)


E = squares(R * a + t * sp.ones(1, 3) - b)

# %% [markdown] slideshow={"slide_type": "fragment"}
# ### Line 1: the shift, whatever the rotation
#
# At the least E its slopes along $t_x$ and $t_y$ are zero. Two equations, two unknowns:

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* "Why centroids?" is answered here, by two derivatives, not by custom. In
# Tuček's steps this is number 3; he shifts first and turns then, which is the same.

# %% slideshow={"slide_type": "fragment"}
best_t = sp.solve([E.diff(t_x), E.diff(t_y)], [t_x, t_y], dict=True)[0]
mean_a, mean_b = a * sp.ones(3, 1) / 3, b * sp.ones(3, 1) / 3

# %% [markdown] slideshow={"slide_type": "fragment"}
# The claim is $t = \bar b - R\,\bar a$: **the centroids land on each other**. Solution less claim:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
sp.simplify(t.subs(best_t) - (mean_b - R * mean_a)).T

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Line 2: count everything from the centroids
#
# With that t, and $a_i' = a_i - \bar a$, $b_i' = b_i - \bar b$, only the angle is left in E. Is it
# $\sum|R a_i' - b_i'|^2$? The difference:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
a_c, b_c = a - mean_a * sp.ones(1, 3), b - mean_b * sp.ones(1, 3)
E_theta = E.subs(best_t)
sp.simplify(E_theta - squares(R * a_c - b_c))

# %% [markdown] slideshow={"slide_type": "fragment"}
# ### Line 3: what depends on the angle
#
# $|R a' - b'|^2 = |a'|^2 + |b'|^2 - 2\,b'^{\mathsf T} R\, a'$, and turning changes no length. So
# the least E is the greatest
#
# $$\sum_i b_i'^{\mathsf T} R\,a_i' = \operatorname{tr}(R H), \qquad
# H = \sum_i a_i'\,b_i'^{\mathsf T}$$

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
H = a_c * b_c.T
sp.simplify(E_theta - (squares(a_c) + squares(b_c) - 2 * (R * H).trace()))

# %% [markdown] slideshow={"slide_type": "fragment"}
# However many points there are, all that matters of them is four numbers: the 2 × 2 matrix H.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Line 4: in the plane, one arctangent
#
# **Predict:** tr(R H) is a sum of sines and cosines of θ. How many maxima has it in a full turn?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
h = sp.Matrix(2, 2, sp.symbols("h_11 h_12 h_21 h_22", real=True))
gain = sp.collect(sp.expand((R * h).trace()), [sp.cos(theta), sp.sin(theta)])
gain

# %% [markdown] slideshow={"slide_type": "fragment"}
# $p\cos\theta + q\sin\theta$ has one maximum, at $\theta = \operatorname{atan2}(q, p)$: no false
# minimum to be caught in. In the plane we are done, without an SVD:
#
# $$\theta = \operatorname{atan2}(h_{12} - h_{21},\ h_{11} + h_{22})$$

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The four-line product of complex numbers says the same: θ is the argument of
# Σ conj(a′) b′. Then why do thesis and textbooks take the SVD? Because it works in three
# dimensions, too, where there is no arctangent. Derive it all the same: the determinant is a trap
# that people fall into.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Why the SVD
#
# In space there is no single angle. The SVD works in any dimension: $H = U S V^{\mathsf T}$ with
# $U, V$ orthonormal and $S = \operatorname{diag}(s_1 \ge s_2 \ge 0)$.
#
# Put $R = V Z U^{\mathsf T}$. Any R can be written so, with $Z = V^{\mathsf T} R\, U$ orthonormal.
# Under a trace, factors may go round in a circle:
#
# $$\operatorname{tr}(R H) = \operatorname{tr}(V Z U^{\mathsf T} U S V^{\mathsf T})
# = \operatorname{tr}(Z S)$$

# %% [markdown] slideshow={"slide_type": "fragment"}
# In the plane Z is a rotation by some φ, or a mirror. What is tr(Z S) for each?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
phi = sp.symbols("phi", real=True)
s_1, s_2 = sp.symbols("s_1 s_2", nonnegative=True)
Z_turn = R.subs(theta, phi)
Z_mirror = Z_turn * sp.diag(1, -1)
for Z in (Z_turn, Z_mirror):
    print(sp.factor((Z * sp.diag(s_1, s_2)).trace()))

# %% [markdown] slideshow={"slide_type": "fragment"}
# Both are greatest at φ = 0. The rotation wins with $s_1 + s_2$, and then Z = I:
#
# $$R = V U^{\mathsf T}$$

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Pause here. "Greatest at φ = 0" holds for the mirror because s_1 ≥ s_2. Ask
# what happens when s_1 = s_2 (every mirror is as good) and when s_2 = 0 (all points on a line:
# both win alike).

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Why the determinant
#
# $V U^{\mathsf T}$ is the best **orthonormal** matrix. If $\det(V U^{\mathsf T}) = -1$, it is a
# mirror. R is a rotation then only if Z is the mirror, which earns at most $s_1 - s_2$:
#
# $$R = V \begin{bmatrix} 1 & 0\\ 0 & \det(V U^{\mathsf T})\end{bmatrix} U^{\mathsf T}$$
#
# The −1 stands where it costs least, at the smallest singular value.
#
# **Question.** When does this happen? Points of the real world are never seen mirrored.
# **Predict** before you turn the page.


# %% slideshow={"slide_type": "fragment"}
def best_motion(source, target, mirrors=False):
    """The pose (3,) that lays paired points over each other, and its block R."""
    a, b = source.mean(axis=0), target.mean(axis=0)
    U, _, Vt = np.linalg.svd((source - a).T @ (target - b))
    D = np.diag([1, 1 if mirrors else np.linalg.det(Vt.T @ U.T)])
    R = Vt.T @ D @ U.T
    x, y = b - R @ a
    return np.array([x, y, np.arctan2(R[1, 0], R[0, 0])]), R


# %% [markdown] slideshow={"slide_type": "fragment"}
# A robot stands in front of one straight wall and scans it twice, without moving. All that differs
# is the lidar's noise, 1 cm.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
rng = np.random.default_rng(7)
along = np.linspace(-1.0, 1.0, 15)
looks = [np.column_stack([along, 1.0 + 0.01 * rng.standard_normal(15)]) for _ in range(2)]
for mirrors in (True, False):
    _, R_wall = best_motion(*looks, mirrors)
    left = looks[0] @ R_wall.T - looks[1]
    left -= left.mean(axis=0)
    rms = 1000 * np.sqrt((left**2).sum(axis=1).mean())
    print(f"det R = {np.linalg.det(R_wall):+.0f}, left between the points: {rms:.2f} mm")


# %% slideshow={"slide_type": "subslide"}
def carried(R, points):
    """Points carried by R about the wall's centroids."""
    return (points - looks[0].mean(axis=0)) @ R.T + looks[1].mean(axis=0)


robot, chest = ring([(-0.15, 0), (0.15, 0), (0, 0.35)]), box((-0.7, 0.6), (0.4, 0.25))
inside = np.vstack([robot, chest]).reshape(-1, 2)
fig, ax = views.axes("one wall, two looks, two fits", size=(6.4, 3.8))
views.draw(ax, Points("wall", np.vstack(looks)), markersize=6)
for name, mirrors in {"naive": True, "corrected": False}.items():
    _, R_wall = best_motion(*looks, mirrors)
    ends = carried(R_wall, inside).reshape(-1, 4)
    views.draw(ax, Segments(name, ends), label=f"carried with det {np.linalg.det(R_wall):+.0f}")
views.legend(ax, loc="lower right")
views.show(fig, "Mirrored, robot and chest lie behind the wall; turned, in front of it.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** red, the better fit of the wall, by 0.7 mm; and the robot with the chest of drawers at
# its left stands inside out *behind* it, the chest at its right. Blue, the mended R: the wall fits
# all but as well, and nothing has moved. A long wall is the everyday case: across it there is only
# noise, and noise does not know left from right.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Draw by hand which two signs the noise can have: if points that stood a
# little out in the first look stand a little in in the second, the mirror is the better fit. That
# happens every second time. The thesis' listing has this right.

# %% [markdown] slideshow={"slide_type": "fragment"}
# SVD and arctangent are the same formula in the plane. A thousand random clouds:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
most = 0.0
for _ in range(1000):
    p, q = rng.standard_normal((2, 8, 2))
    p_c, q_c = p - p.mean(axis=0), q - q.mean(axis=0)
    h_ = p_c.T @ q_c
    angle = np.arctan2(h_[0, 1] - h_[1, 0], h_[0, 0] + h_[1, 1])
    most = max(most, abs(np.exp(1j * angle) - np.exp(1j * best_motion(p, q)[0][2])))
print("never differ by more than 1e-12:", most < 1e-12)

# %% [markdown] slideshow={"slide_type": "slide"}
# ## ICP: the pairs are not known
#
# Tuček's five steps: pair each source point with the **nearest** target point; centroids; shift;
# turn by the SVD; again, until it is good enough.
#
# **Question.** Most of the first pairs are wrong. Why should a fit to wrong pairs help?
# **Predict:** can the sum of squares grow from one round to the next?


# %% slideshow={"slide_type": "fragment"}
def icp(source, target, pose, tolerance=1e-6, max_rounds=500):
    """Lay a source cloud over a target cloud, from a first guess (3,) [m, m, rad]."""
    tree, last = cKDTree(target), np.inf
    for _ in range(max_rounds):
        moved = transform(pose, source)
        distances, rows = tree.query(moved)
        step, _ = best_motion(moved, target[rows])
        pose = compose(step, pose)
        if abs(last - distances.mean()) < tolerance:
            break
        last = distances.mean()
    return pose


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
pose = icp(second, first, guess)
watched = point_to_point(second, first, guess, history=True)
print("before:", told(guess), "  after:", told(pose))
print("the package's ICP agrees:", np.allclose(pose, watched.pose, atol=1e-12))

# %% [markdown] slideshow={"slide_type": "fragment"}
# It cannot grow. With the pairs held, the fit takes the *least* sum of squares there is. With the
# source held, new nearest points can only be nearer than the old partners. Both halves of a round
# go downhill: ICP always ends, in *a* valley, though not always in the right one.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The step is found in the target's frame, after the pose has been applied: it
# goes to the left, step ⊕ pose. A widely copied ICP multiplies on the other side: its exercise
# diagnosis is "wrong-side". Let the class find what that does when the turn is 90° or more (it
# runs away).

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Watch it
#
# Each grey line is a pair. **Predict**, for round 0: where are the lines long, and which way will
# the sum of all of them pull? Then move the slider.


# %% slideshow={"slide_type": "fragment"}
def watch(round):
    now = watched.history[round]
    title = f"round {round}: pairs {1000 * now.error:.0f} mm, {told(now.pose)}"
    return views.overlay(first, transform(now.pose, second), now.pairs, title)[0]


views.explore(
    watch,
    lambda round: f"Round {round}: lines from each point of the second scan to the nearest first.",
    round=(0, watched.rounds, 1),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See** in round 1: two thirds of the shift are gone, but only a quarter of the turn. Along a
# wall, a point's nearest partner is beside it, not where it came from: the pairs pull the walls
# together but let them **slide**, and each round turns only a part of the way.

# %% slideshow={"slide_type": "subslide"}
errors = np.array([off(r.pose) for r in watched.history])
fig, ax = views.curves(
    np.arange(len(errors)),
    {
        "mean distance of the pairs [mm]": 1000 * np.array([r.error for r in watched.history]),
        "position off [mm]": errors[:, 0],
        "heading off [0.1°]": 10 * errors[:, 1],
    },
    "round",
    "error",
    "What the robot sees of its error, and what it is",
    (5, 2.9),
)
views.show(fig, "All three errors fall in the first ten rounds, then stand still above zero.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** fast at first, then slower and slower. And all three stop above zero: the pairs of the
# last round are still 14 mm long, because beams hit different spots, and because some walls were
# seen only once.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## When to stop
#
# The thesis has two rules. Its text (§3.1, step 5) goes on while **the error** is above the
# largest allowed. Its listing stops when **the error's change** is below a tolerance of 0.001, in
# any case after 500 rounds.
#
# **Predict:** what does the first rule do when it is given 1 mm? When it is given 50 mm?


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
def stop(rule):
    """Rounds done when a rule (error now, error before) says stop, and the pose then."""
    looks = point_to_point(second, first, guess, tolerance=1e-15, max_rounds=500, history=True)
    looks = looks.history
    ends = (k for k in range(1, len(looks)) if rule(looks[k].error, looks[k - 1].error))
    k = next(ends, None)
    return f"after {k:3d} rounds: {told(looks[k].pose)}" if k else "never"


print("error below 1 mm:         ", stop(lambda now, before: now < 1e-3))
print("error below 50 mm:        ", stop(lambda now, before: now < 50e-3))
print("change below 0.001 m:     ", stop(lambda now, before: abs(now - before) < 1e-3))
print("change below 0.001 mm:    ", stop(lambda now, before: abs(now - before) < 1e-6))

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** an absolute bound has to be guessed, and here both guesses are bad: below the noise it
# is never reached, above it is reached too soon, with 4.4° to go. The change tells when nothing
# more is to be had, whatever the noise. But mind its **unit**: the listing's 0.001 are
# millimetres, as its data are. The same number read as metres stops after 10 rounds, before the
# turn is done.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Both rules have their place: the change ends the loop, the error that is left
# says whether to believe the match. An error far above the noise after convergence means: the
# wrong valley.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## The polygon: four places, four pictures
#
# Tuček scans from four places. The first scan is the map; every further one is matched with the one
# before, from odometry's step, and its pose is put together from all matches so far. Beside it runs
# the **naive** pose: odometry alone.


# %% slideshow={"slide_type": "fragment"}
def walk(source, matcher):
    """Naive and corrected poses (n, 3) of a source, and its scans."""
    naive, corrected, scans = [np.zeros(3)], [np.zeros(3)], []
    for reading in source:
        points = reading.scan.points()
        if scans:
            naive.append(compose(naive[-1], reading.odometry))
            step = matcher(points, scans[-1], reading.odometry).pose
            corrected.append(compose(corrected[-1], step))
        scans.append(points)
    return np.array(naive), np.array(corrected), scans


# %% slideshow={"slide_type": "fragment"}
def laid(name, poses, scans):
    """A track and the map it makes, as layers."""
    xy = np.vstack([transform(pose, scan) for pose, scan in zip(poses, scans, strict=True)])
    return [Points(name, xy), Poses("poses", poses)]


def pictures(source, matcher):
    """Naive map beside corrected map, and what each pose is off by."""
    naive, corrected, scans = walk(source, matcher)
    tracks, truth, shown = {"naive": naive, "corrected": corrected}, source.truth.poses, {}
    for name, poses in tracks.items():
        errors = [told(p, q) for p, q in zip(poses, truth, strict=True)]
        print(f"{name:>9}: " + " | ".join(errors[1:]))
        shown[f"{name}: {errors[-1]} at the end"] = laid(name, poses, scans)
    fig, _ = views.side_by_side(shown, size=(7.2, 3.3))
    return fig


# %% [markdown] slideshow={"slide_type": "subslide"}
# **True odometry** (figures 3.14 and 3.15). Steps of −45° and 27.3 cm, −45° and 32.5 cm, 0° and
# 18.8 cm. His were measured by hand, so his naive picture is a little smeared; ours are exact.
#
# **Predict:** what will ICP make of poses that are already right?

# %% slideshow={"slide_type": "fragment"}
fig = pictures(simulation("polygon", np.random.default_rng(1)), point_to_point)
views.show(fig, "Naive map of true odometry: sharp. The map after plain ICP: walls doubled.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** plain ICP makes it *worse*. Look at the lower walls on the right: they are twice as
# thick. Keep that in mind for the next section.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Wrong odometry** (figures 3.16 and 3.17): he gives out −35° and 15 cm, −60° and 45 cm, +20° and
# 10 cm instead.

# %% slideshow={"slide_type": "fragment"}
fig = pictures(simulation("polygon-wrong", np.random.default_rng(1)), point_to_point)
views.show(fig, "Naive map of wrong odometry: four polygons askew. After plain ICP: one polygon.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** on the left four polygons askew, a shape that cannot exist. On the right one polygon
# with its box and cylinder: the same 4 cm off as before, whatever the odometry said. ICP forgets
# its first guess once it is near enough.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The naive error does not simply grow: the second wrong step happens to undo a
# part of the first. Ask which of the naive pictures a robot could tell from a good one without
# knowing the truth.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## What only one scan saw
#
# Plain ICP pairs **every** source point. What the target never saw has no partner, gets one all the
# same, and pulls.
#
# Make it worse: a scanner that looks ahead only, half a turn, as many robots have. After a turn of
# −45° a quarter of what it sees is new. Odometry is exactly **right** here.
#
# **Predict:** how far will plain ICP be off when it starts from the truth?

# %% slideshow={"slide_type": "fragment"}
ahead = replace(RPLIDAR_A2, field_of_view=np.pi, beams=200)
half = list(simulation("polygon", np.random.default_rng(1), lidar=ahead))
target, source = half[0].scan.points(), half[1].scan.points()
matchers = {
    "plain": lambda p, q, start: point_to_point(p, q, start),
    "best 90 %": lambda p, q, start: point_to_point(p, q, start, keep=0.9),
    "best 80 %": lambda p, q, start: point_to_point(p, q, start, keep=0.8),
}

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for name, matcher in matchers.items():
    mm, degrees = off(matcher(source, target, true_motion).pose)
    print(f"{name:>14}: {mm / 10:2.0f} cm and {degrees:.0f}° off")

# %% slideshow={"slide_type": "subslide"}
dragged = point_to_point(source, target, true_motion, history=True)
last = dragged.history[-1]
title = f"plain ICP, started from the truth: {told(last.pose)}"
fig, _ = views.overlay(target, transform(last.pose, source), last.pairs, title)
views.show(fig, "Long fans of pairs end on the last points of the first scan and turn the second.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See** the fans: dozens of points that the first scan never saw are tied to its outermost
# points, and drag the whole scan round until the fans' pull and the walls' are in balance. The
# odometry was right and the noise is small: it is the *method* that is off by 9°.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **The cure: trim.** Sort the pairs by length in each round and fit the shortest share. The fans
# are the longest pairs: with the best 80 % they are gone. How much to keep depends on the overlap,
# which nobody knows beforehand.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Point to line
#
# Two scans hit a wall at different spots. So how far a point lies from its partner **along** the
# wall means nothing; it only holds the walls back from sliding into place. Count the distance
# **across** the wall alone, with n the wall's normal at the partner b:
#
# $$r = n^{\mathsf T}(p - b), \qquad p = R\,a + t$$
#
# **Question.** Of the three unknowns, which does a pair on a wall straight ahead tell something
# about, and which not? **Predict:** will the tidy solution by centroids and SVD survive?

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* A wall straight ahead tells how far ahead, and the turn; nothing of the way to
# the side. The tidy solution is gone: tr(RH) came from |b|² and |Ra|² being constant, and now only
# one component of each is counted. Censi (2008, PLICP) still solves it in closed form, by a
# quartic; most take a Gauss-Newton step, as below.

# %% slideshow={"slide_type": "subslide"}
n = normals(first)
spikes = np.hstack([first, first + 0.12 * n])[::6]
layers = [Segments("normals", spikes[~np.isnan(spikes).any(axis=1)]), Points("map", first)]
fig, _ = views.side_by_side({"the first scan and its normals": layers}, size=(4.5, 3.4))
views.show(fig, "Short lines stand across the walls of the first scan; none at corners.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** a line through each point's neighbours gives its normal; at corners there is none.

# %% [markdown] slideshow={"slide_type": "slide"}
# ### Line 1: what a small motion does to r
#
# Shift by dx, dy and turn by dθ about the robot, which stands at t. What turns is the **arm**
# $p - t$. The slopes of r, at no motion:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
d_x, d_y, d_theta = sp.symbols("d_x d_y d_theta", real=True)
n_, arm_, t_, b_ = (sp.Matrix(sp.symbols(f"{v}_x {v}_y", real=True)) for v in ("n", "p", "t", "b"))
p_ = t_ + sp.Matrix([d_x, d_y]) + R.subs(theta, d_theta) * arm_
r_ = (n_.T * (p_ - b_))[0]
J_ = sp.Matrix([r_]).jacobian([d_x, d_y, d_theta]).subs(d_theta, 0)
J_

# %% [markdown] slideshow={"slide_type": "fragment"}
# Here $(p_x, p_y)$ is the arm. So $J = [n_x,\ n_y,\ \text{arm} \times n]$: a shift counts by how
# squarely it meets the wall, a turn by its lever.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Line 2: the step
#
# For a small motion δ every r becomes $r + J\delta$. The sum of squares is a bowl in δ; at its
# bottom the slope is zero:
#
# $$\left|r + J\delta\right|^2 \to \min \quad\Longrightarrow\quad
# J^{\mathsf T}(r + J\delta) = 0 \quad\Longrightarrow\quad
# \delta = -(J^{\mathsf T}J)^{-1}\,J^{\mathsf T} r$$
#
# Three unknowns, whatever the number of points. A turn is no straight line, so the step is not
# exact: take it, pair again, step again.


# %% slideshow={"slide_type": "fragment"}
def line_step(pose, moved, partners, n):
    """The Gauss-Newton step (3,) that lowers Σ r², the residuals r (k,) and their slopes J (k, 3)."""
    arm = moved - pose[:2]
    r = np.sum(n * (moved - partners), axis=1)
    J = np.column_stack([n, arm[:, 0] * n[:, 1] - arm[:, 1] * n[:, 0]])
    return np.linalg.lstsq(J, -r)[0], r, J


# %% slideshow={"slide_type": "fragment"}
def icp_to_line(source, target, pose, rounds, share=0.8):
    """The poses (rounds + 1, 3) on the way; fits the shortest share of the pairs."""
    tree, n, poses = cKDTree(target), normals(target), [pose]
    for _ in range(rounds):
        moved = transform(poses[-1], source)
        distances, rows = tree.query(moved)
        near = (distances <= np.quantile(distances, share)) & ~np.isnan(n[rows, 0])
        step, _, _ = line_step(poses[-1], moved[near], target[rows[near]], n[rows[near]])
        poses.append(poses[-1] + step)
    return np.array(poses)


# %% [markdown] slideshow={"slide_type": "subslide"}
# **Predict:** plain ICP took two dozen rounds on the polygon. How many will this take?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
stepped = icp_to_line(second, first, guess, 6)
for k, pose in enumerate(stepped):
    print(f"round {k}: {off(pose)[0]:5.0f} mm, {off(pose)[1]:4.1f}° off")

# %% slideshow={"slide_type": "subslide"}
rounds = 25
trimmed = point_to_point(second, first, guess, keep=0.8, history=True).history
ways = {
    "plain": [r.pose for r in watched.history[: rounds + 1]],
    "best 80 %": [r.pose for r in trimmed[: rounds + 1]],
    "point to line": icp_to_line(second, first, guess, rounds),
}
turned = {k: np.pad([off(p)[1] for p in v], (0, 26 - len(v)), "edge") for k, v in ways.items()}
fig, ax = views.curves(np.arange(26), turned, "round", "heading off [°]", size=(5, 2.9))
ax.set_yscale("log")
views.show(
    fig, "Point to line falls a hundredfold in three rounds; both others creep down for twenty."
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** each gridline is ten times less. Point to line is there in three rounds; plain ICP creeps
# and stops at 0.7°; trimmed, it creeps farther. Nothing holds the walls back any more.
#
# `point_to_line` of the package also drops pairs whose walls point elsewhere or that are far apart,
# and weighs the rest. All four methods, wrong odometry, ten seeds, every step:

# %% slideshow={"slide_type": "subslide"}
matchers["point to line"] = lambda p, q, start: point_to_line(p, q, start)
for title, lidar in {"whole turn": RPLIDAR_A2, "half a turn": ahead}.items():
    for name, matcher in matchers.items():
        found = []
        for seed in range(10):
            run = simulation("polygon-wrong", np.random.default_rng(seed), lidar=lidar)
            _, poses, _ = walk(run, matcher)
            steps, true_steps = between(poses[:-1], poses[1:]), run.truth.poses
            true_steps = between(true_steps[:-1], true_steps[1:])
            found += [off(p, q) for p, q in zip(steps, true_steps, strict=True)]
        mm, degrees = np.median(found, axis=0)
        print(f"{title:>11}, {name:>13}: median {mm:4.1f} mm, {degrees:.2f}°")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** trimming takes away most of the error, if the share is guessed well; point to line needs
# no guess and is the best of all.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Why not always point to line? It needs walls: in a heap of points there are
# no normals. And from a bad first guess it gets lost sooner: see the basin below.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## The second scan's motion
#
# The listing `slam.py` as printed, in its own logic: the first scan becomes the map, the **second
# is only remembered**, matching begins with the third.
#
# **Predict:** four scans, three motions. Where will the robot believe to be at the end?


# %% slideshow={"slide_type": "fragment"}
def as_printed(source, matcher):
    """Tuček's add_new_scan and calculate_transformation, as they are printed."""
    points, previous, current = None, None, np.zeros(3)
    for reading in source:
        scan = reading.scan.points()
        if points is None:
            points = scan
        elif previous is None:
            previous = scan
        else:
            current = compose(current, matcher(scan, previous, reading.odometry).pose)
            points = np.vstack([points, transform(current, scan)])
            previous = scan
    return current, points


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
run = simulation("polygon-wrong", np.random.default_rng(1))
printed, printed_map = as_printed(run, point_to_line)
_, mended, scans = walk(run, point_to_line)
poses = {"truth": run.truth.poses[-1], "as printed": printed, "mended": mended[-1]}
for name, (x, y, heading) in poses.items():
    print(f"{name:>10}: {x:.2f} m, {y:.2f} m, {np.degrees(heading):.0f}°")

# %% slideshow={"slide_type": "subslide"}
fig, _ = views.side_by_side(
    {
        "as printed": [Points("naive", printed_map), Poses("pose", [printed])],
        "mended": laid("corrected", mended, scans),
    },
    size=(6.4, 3),
)
apart = abs(np.degrees(printed[2] - mended[-1][2]))
views.show(fig, f"As printed: two polygons, turned by {apart:.0f}°. Mended: one polygon.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the first motion is lost, all that follows hangs on the wrong place, and the second scan
# is in no map. Yet every match was good. Figures 3.15 and 3.17 of the thesis cannot come from this
# listing. Two lines mend it: the first scan is the map **and** the previous scan.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* A good case for reading code against its pictures. The same happens after any
# scan with fewer than three points, which clears previous_points: the next motion is lost again.
# `slamlab.estimators` mends both, each with a test of its own.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## How bad may the first guess be?
#
# ICP goes downhill from where it starts. The guesses that lead home are its **basin**. Start from a
# wrong heading *and* a wrong place, in all directions, and count who finds home, to 5 cm and 2°.
#
# A third matcher joins in: `match`, the package's best. It steps across walls, too, and pairs by
# bearing: what two scans see in the same direction is the same wall, and nothing nearest has to be
# looked for. And it **judges** its own result. With `search=0` it stays where it ends; without, a
# result that it finds poor makes it look at all turns and places, then start again from there.
#
# **Predict:** up to which turn will plain ICP come home? Point to line is the more accurate: is it
# the more patient, too?


# %% slideshow={"slide_type": "fragment"}
places = list(simulation("polygon", np.random.default_rng(1)))
turns, metres = [0, 15, 30, 45, 60, 75, 90, 135, 180], [0, 0.25, 0.5, 0.75, 1.0]


def home(matcher, turn, way, rng, tries=6):
    """The share of guesses so far off (degrees, metres) that lead home."""
    found = []
    for k in range(tries):
        before, now = places[k % 3], places[k % 3 + 1]
        where = rng.uniform(-np.pi, np.pi)
        wrong = [way * np.cos(where), way * np.sin(where), np.radians(turn) * rng.choice([-1, 1])]
        end = matcher(now.scan.points(), before.scan.points(), now.odometry + wrong).pose
        mm, degrees = off(end, now.odometry)
        found.append(mm < 50 and degrees < 2)
    return np.mean(found)


# %% slideshow={"slide_type": "subslide"}
patient = {
    "plain": matchers["plain"],
    "match(search=0)": lambda p, q, start: match(p, q, start, search=0),
    "match": match,
}
basins = {}
for name, matcher in patient.items():
    rng = np.random.default_rng(0)  # the same guesses for all
    basins[name] = [[home(matcher, turn, way, rng) for way in metres] for turn in turns]
fig, _ = views.cells(
    basins, metres, turns, "place off by [m]", "heading off by [°]", size=(8.5, 3.6)
)
shares = ", ".join(f"{name} {np.mean(table):.0%}" for name, table in basins.items())
views.show(fig, f"Who comes home from how far, a table each; from all places: {shares}.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** left, the basin of plain ICP: it forgives a metre, but hardly more than 45°. In the
# middle the sharper matcher: almost all up to 30°, little beyond. Sliding along walls is slow, but
# it is patient. Right: whoever *knows* that a result is poor can look elsewhere, and comes home
# from anywhere. No cell is an accident of symmetry: this polygon looks like itself from one side
# only.

# %% [markdown] slideshow={"slide_type": "subslide"}
# How does it know? By what the two scans say of each other: too few points lie on the other's
# walls, or points stand where the other's beams went through.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for turn in (0, 30, 60, 120):
    lost = match(second, first, compose(true_motion, [0, 0, np.radians(turn)]), search=0)
    print(f"{turn:3d}° off: {told(lost.pose):>20}: {lost.verdict}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** where it is lost it says so, and why. That is all the search waits for.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The search correlates two grids by FFT, for every turn, all shifts at once;
# it costs about as much as five plain matches (`python -m benchmarks.icp`). It is why
# `match` searches only after a poor result. In a rectangular hall it would find two answers as
# good, half a turn apart; then the one nearer the guess should win.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## How sure is a match?
#
# An answer without a doubt is worth little: a filter (lesson 06) or a pose graph (lesson 15) has to
# weigh it. Where does its error come from? At the end the step is zero. Noise e on the
# residuals moves the bottom of the bowl, by the same formula as every step:
#
# $$\delta = -(J^{\mathsf T}J)^{-1} J^{\mathsf T} e$$
#
# With $\operatorname{cov}(e) = \sigma^2 I$ and the rule $\operatorname{cov}(M e) = M
# \operatorname{cov}(e) M^{\mathsf T}$ of lesson 03:
#
# $$P = (J^{\mathsf T}J)^{-1} J^{\mathsf T}\,\sigma^2 I\,J\,(J^{\mathsf T}J)^{-1}
# = \sigma^2\,(J^{\mathsf T}J)^{-1}$$

# %% [markdown] slideshow={"slide_type": "fragment"}
# $J^{\mathsf T}J$ is the **information**: what all walls together say about x, y and θ.
#
# A robot swerves by 30 cm along a corridor, a cupboard ahead. **Predict:** in which direction is the
# match least sure? Will one match know that of itself?


# %% slideshow={"slide_type": "fragment"}
corridor = [[-60, -1, 60, -1], [-60, 1.2, 60, 1.2]]
cupboard = ring([(2, 0.2), (3, 0.2), (3, 1.19), (2, 1.19)])
here, there = np.array([[0, 0, -0.2], [0.3, 0, 0.2]])
moved_by = between(here, there)


def two_looks(walls, rng):
    """The scan after moving and the one before."""
    return [RPLIDAR_A2.scan(World(walls), pose, rng).points() for pose in (there, here)]


# %% slideshow={"slide_type": "fragment"}
rng = np.random.default_rng(0)
furnished = np.vstack([corridor, cupboard])
hundred = [match(*two_looks(furnished, rng), [0.2, 0, 0.3]) for _ in range(100)]

# %% slideshow={"slide_type": "subslide"}
errors = 1000 * (np.array([m.pose for m in hundred]) - moved_by)
told_by_one = hundred[0].covariance * 1e6
claims = {"told by the first match": told_by_one, "of the hundred": np.cov(errors.T)}
fig, ax = views.cloud(errors, claims, "A hundred matches with new noise each", size=(5.4, 3.6))
ax.set(xlabel="error along x [mm]", ylabel="error along y [mm]")
ax.lines[0].set(markersize=7, alpha=1)
views.show(
    fig, "A narrow cloud of errors, five times as long as wide, and two ellipses of one shape."
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** along the corridor the matches scatter five times as far as across it: only the
# cupboard's short side holds them there. And the blue ellipse, which **one** match told of itself,
# is nearly the dashed one, which took a hundred. Errors measured by what each match claims (lesson
# 03: NEES, here of three numbers, so 3 is expected):

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
nees = [e @ np.linalg.solve(1e6 * m.covariance, e) for e, m in zip(errors, hundred, strict=True)]
print(f"mean NEES of the hundred: {np.mean(nees):.1f}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Not 3, yet near it: these matches are about 15 % surer of themselves than they should be. A filter
# can live with that; with a factor of ten it could not.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The package goes one step beyond σ²(JᵀJ)⁻¹: noise grows with the range, and a
# point of the target has a share in the lines of all its neighbours, so the residuals are not
# independent. Censi (2007) writes that as H⁻¹ (∂g/∂z) cov(z) (∂g/∂z)ᵀ H⁻¹. What no covariance of
# this kind knows: walls that are not straight, a robot that moves while it scans, the wrong valley.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## The corridor that slides along itself
#
# Now take the cupboard away. Two straight walls, 120 m long, are left. Let odometry say of the way
# along them 0 cm, or 60 cm. 30 cm is true.
#
# **Predict:** the error after each match. And what does $J^{\mathsf T}J$ look like?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
bare = two_looks(corridor, np.random.default_rng(0))
slid = [match(*bare, between(here, [way, 0, 0.1])) for way in (0.0, 0.6)]
for m in slid:
    along, across = np.abs(compose(here, m.pose) - there)[:2]
    print(f"{100 * along:.0f} cm off along, {100 * across:.0f} cm across: {m.verdict}")

# %% slideshow={"slide_type": "subslide"}
shown = {
    f"from {way} cm: {told(m.pose, moved_by)}": [
        Points("map", bare[1]),
        Points("scan", transform(m.pose, bare[0])),
        Poses("robot", [m.pose]),
    ]
    for way, m in zip((0, 60), slid, strict=True)
}
fig, (ax, _) = views.side_by_side(shown, size=(7.2, 3.3))
ax.set(xlim=(-3, 3), ylim=(-2.4, 2.4))
views.show(fig, "The same two walls twice, covered by both scans; the robot stands farther on.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** both pictures fit, to the noise. No one could say which is right: two straight walls look
# the same from everywhere along them. The matcher leaves the guess there as it was, fixes what the
# walls fix, and **says so**.

# %% [markdown] slideshow={"slide_type": "subslide"}
# It reads that off the information: all normals point across the corridor, so one **eigenvalue** is
# next to nothing, and its direction is the free one. Its share of the largest, with and without the
# cupboard:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for name, m in {"with the cupboard": hundred[0], "bare": slid[0]}.items():
    seen = m.observability
    share = seen.eigenvalues[0] / seen.eigenvalues[-1]
    words = seen.in_words() or "all is fixed"
    print(f"{name:>17}: smallest eigenvalue {share:.4f} of the largest: {words}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Not zero, for normals are noisy, too, and a crooked normal sees a bit of the way along. The
# matcher knows how noisy they are and discounts just that. What is left over must come from
# somewhere else: odometry, or a door farther on. Lesson 15's graph uses both.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* A round silo leaves the turn free, a single wall one shift. Let the class
# build them with `World` and ask `match` for its verdict. Plain ICP fails silently here: its answer
# is the guess, with a mean error as small as anywhere.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## A real robot
#
# The Intel Research Lab: 910 scans in 44 minutes, a scanner of half a turn, raw odometry. The
# estimator `icp-plain` is the thesis' way; `icp` matches point to line, gated and weighed, and
# keeps to odometry where no wall decides. Both match each scan with the one before.
#
# **Predict** from what you saw: what will plain ICP do with half a turn and fast turns?

# %% slideshow={"slide_type": "fragment"}
try:
    log, title = sources.open("intel"), "Intel Research Lab"
except sources.SourceError as absent:
    log, title = sources.open("sim:corridor"), "SIMULATED drive round a corridor"
    print(f"{absent}.\nHere instead: a {title}.")

# %% slideshow={"slide_type": "fragment"}
plain = runner.run(log, estimators.make("icp-plain", log))

# %% slideshow={"slide_type": "fragment"}
real = runner.run(log, estimators.make("icp", log))

# %% slideshow={"slide_type": "subslide"}
xy = [transform(p, r.scan.points()[::5]) for p, r in zip(real.trajectory.poses, log, strict=True)]
fig, _ = views.side_by_side({f"{title}: icp": [Points("map", np.vstack(xy[::2]))]}, size=(5, 4.2))
views.show(
    fig, "A floor plan: rooms on both sides of a corridor that goes round; some walls stand twice."
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** scans matched point to line, gated and weighed, give a floor plan. Look closely, though:
# where the robot comes back, walls stand twice. Nothing here knows that it has been in a place
# before.

# %% [markdown] slideshow={"slide_type": "subslide"}
# How good is that in numbers, when nobody knows the truth? Kümmerle and others published
# **relations**: poses seen from other poses, checked by hand. No frame has to be fitted, and no
# old error is counted twice.

# %% slideshow={"slide_type": "fragment"}
tracks = {"naive": real.naive, "icp-plain": plain.trajectory, "icp": real.trajectory}
try:
    relations = load_relations(sources.recording("intel-relations"))
    for name, track in tracks.items():
        error = relations_error(track, relations)
        print(
            f"{name:>9}: {error.translation:.2f} m and {np.degrees(error.rotation):.1f}° "
            f"in the mean of {error.count} relations"
        )
except (sources.SourceError, ValueError) as absent:
    print(absent)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** plain ICP is worth no more than the wheels here: what a scanner of half a turn sees anew
# in a fast turn drags it off, as in the polygon. The robust one is over ten times better. What is
# left of its error is mostly loops that were never closed: lesson 15.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Without the recordings this section runs on a simulated corridor and says so;
# the stored output is of the real log. Only relations whose two stamps lie within 2 ms of a scan
# are counted.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## What you can do now
#
# Lay two clouds over each other with and without known pairs, name what the determinant guards
# against, choose a rule to stop by, mend ICP where scans overlap in part, step across walls instead
# of to points, and say of a match how sure it is and in which direction it knows nothing.
#
# **Next:** every match is a little off, and over many matches the errors add up, as odometry's did,
# only more slowly. Lesson 14 puts ICP on a live robot; lesson 15 closes the loop.
#
# **Exercise:** [write the best motion, ICP, trimmed ICP and a step across walls that knows how sure
# it is, and match two scans that share only half](../exercises/ex13_scan_matching.ipynb).
