# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 13 · Scan matching: ICP
#
# **You will be able to** derive the motion that aligns two point clouds with known correspondences,
# explain each iteration of ICP, choose a stopping rule, make ICP robust, and judge a match by its basin
# of convergence, its covariance, and its degenerate directions.
#
# **104 minutes**, in two parts: how ICP works (53), and how reliable a match is (51).
# **Before:** lesson [01](01_why_slam.ipynb) for poses and scans, lesson [03](03_kalman_filter.ipynb) for
# covariances.
#
# *Key:* if we knew the correspondences, we could compute the motion. If we knew the motion, we could
# find the correspondences. So we start with a guess of the motion, and improve correspondences and
# motion alternately.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Each part is a lecture. Derive part one at the board as far as (13.5): one
# derivative shows why the centroids coincide, and with complex numbers (13.4) takes one line, since θ
# is the argument of the sum of conj(a′) b′. You can teach part two alone to a class that accepts the
# results of part one. If time is short, leave out "Stopping rules" and "Four poses, one map". The
# questions on what can grow, on exact odometry, on the wall ahead, and on the corridor are suitable for
# a poll.

# %% slideshow={"slide_type": "skip"} tags=["folded"]
from dataclasses import replace

import numpy as np
import sympy as sp
from scipy.spatial import cKDTree

from classroom.checks import ask, compare
from course.studies import intel_maps
from course.studies.paired_statistics import percent, share_interval
from slamlab import views
from slamlab.geometry import between, compose, transform, wrap
from slamlab.layers import Points, Poses, Segments
from slamlab.scanmatching import match, normals, point_to_line, point_to_point, rigid_fit
from slamlab.simulation import RPLIDAR_A2
from slamlab.simulation.worlds import World, box, ring
from slamlab.sources import simulation

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Two scans of one place
#
# A robot is inside a polygon of cardboard walls that also contains a box and a cylinder. The robot
# scans, turns by −45°, drives 27.3 cm, and scans again. Its odometry has large errors: it measures −35°
# and 15 cm. **Scan matching** computes the motion between the two scans from the scans themselves. (All
# scans in this lesson are simulated, except in the last section of part two.)

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let a student align two transparencies (or two windows) by hand before you
# mention an algorithm, and ask what the hand minimises. Most students expect equal points; sketch one
# wall hit by beams from two positions.

# %% slideshow={"slide_type": "skip"}
run = simulation("polygon-wrong", np.random.default_rng(1))
readings = list(run)
first, second = readings[0].scan.points(), readings[1].scan.points()
guess, true_motion = readings[1].odometry, between(*run.truth.poses[:2])


def error_of(pose, truth=true_motion):
    """The error of a pose: millimetres, degrees."""
    dx, dy, turn = between(truth, pose)
    return 1000 * np.hypot(dx, dy), abs(np.degrees(turn))


def in_words(pose, truth=true_motion):
    """The error of a pose as text."""
    return "error of {:.0f} mm and {:.1f}°".format(*error_of(pose, truth))


# %% slideshow={"slide_type": "subslide"} tags=["folded"]
title = f"both scans, aligned by odometry: {in_words(guess)}"
fig, _ = views.overlay(first, transform(guess, second), title=title, size=(8, 5))
views.show(
    fig,
    f"The second scan, with an {in_words(guess)}, draws the walls of the polygon a second time.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Every wall appears twice, and you can easily imagine how to rotate the second scan until it fits the
# first. But the scans do not show which point of one scan corresponds to which point of the other. How
# can a program find the motion?

# %% slideshow={"slide_type": "subslide"}
ask(
    "13-same-spots",
    "Each scan has 398 points. Suppose the second scan is transformed by the *true* motion. **How many of "
    "its points then lie within a millimetre of a point of the first scan?**",
    {
        "nearly all of them": "the walls coincide. But the beams of the second scan start from another pose, and "
        "hit the walls at other spots.",
        "about half: some walls are in one scan only": "these walls explain only a small part. On walls that are in both "
        "scans, the beams hit different spots as well.",
        "a few, by chance": "the two scans contain the same walls, but not the same points. A nearest point is only "
        "another point of the same wall.",
    },
    right="a few, by chance",
)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="13-same-spots"
again = next(iter(simulation("polygon-wrong", np.random.default_rng(2)))).scan.points()
clouds = {"after the true motion": transform(true_motion, second), "same pose, new noise": again}
for name, cloud in clouds.items():
    apart, _ = cKDTree(first).query(cloud)
    near, median = np.sum(apart < 1e-3), 1000 * np.median(apart)
    print(f"{name}: {near} of {len(cloud)} points within 1 mm, median distance {median:.1f} mm")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="13-same-spots"
# A second scan from the same pose shows the effect of the lidar's noise alone. After the motion far
# fewer points are near: hardly any point of the second scan has a true counterpart in the first. We
# begin with the assumption that every point has a counterpart, since this leads to a formula that we
# need. Later we measure the errors that this assumption causes, and part two does not need it.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=12
# ## Rigid alignment with known correspondences
#
# A **correspondence** is a pair of points, one from each scan, that are assumed to be the same spot: $a_i$ of the second scan, the
# **source**, and $b_i$ of the first scan, the **target**. (In this lesson $a$ and $b$ are points, not poses.) Suppose that
# the correspondences are known. Which rotation and translation $t$ move the source onto the target? The difference
# $\mathrm{Rot}(\theta)\,a_i + t - b_i$ is the **residual** of a correspondence. We look for the motion that minimises the
# **cost function**
#
# $$E(\theta, t) = \sum_i \left|\,\mathrm{Rot}(\theta)\,a_i + t - b_i\,\right|^2. \tag{13.1}$$
#
# This is **rigid alignment**, a form of the orthogonal *Procrustes* problem. Its solution is named after *Kabsch* and *Umeyama*.
# Three correspondences suffice for the derivation.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* At the board, show one derivative for the translation and the argument of a
# complex number for the rotation, and use the cells only as a check. Ask which points determine the
# angle best: those far from the centroid.

# %% slideshow={"slide_type": "subslide"}
theta, t_x, t_y = sp.symbols("theta t_x t_y", real=True)
a = sp.Matrix(2, 3, sp.symbols("a_x1:4 a_y1:4", real=True))
b = sp.Matrix(2, 3, sp.symbols("b_x1:4 b_y1:4", real=True))
Rot = sp.Matrix([[sp.cos(theta), -sp.sin(theta)], [sp.sin(theta), sp.cos(theta)]])
t, ones = sp.Matrix([t_x, t_y]), sp.ones(1, 3)


def squares(M):
    return sum(entry**2 for entry in M)


E = squares(Rot * a + t * ones - b)

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### First the translation
#
# At the minimum the **gradient** of $E$, the vector of its partial derivatives, is zero. **Your turn.** What is the gradient
# with respect to $t$ at `pose`, for three correspondences?

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
source, target, pose = second[:3], first[:3], guess
residuals = transform(pose, source) - target  # (3, 2)
gradient = ...  # (2,), with respect to t
numbers = [*source.T.ravel(), *target.T.ravel(), *pose]
values = dict(zip([*a, *b, t_x, t_y, theta], numbers, strict=True))
compare(gradient, [float(E.diff(along).subs(values)) for along in (t_x, t_y)])

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# source, target, pose = second[:3], first[:3], guess
# residuals = transform(pose, source) - target  # (3, 2)
# gradient = 2 * residuals.sum(axis=0)
# numbers = [*source.T.ravel(), *target.T.ravel(), *pose]
# values = dict(zip([*a, *b, t_x, t_y, theta], numbers, strict=True))
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "subslide"}
# So the residuals must add up to zero. This gives two linear equations for $t$, whose solution is
#
# $$t = \bar b - \mathrm{Rot}(\theta)\,\bar a, \tag{13.2}$$
#
# where a bar means the mean of all points, their **centroid**. So for every rotation, the best
# translation makes the two centroids coincide. We solve the equations with sympy, and subtract (13.2)
# from the solution:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
best_t = sp.solve([E.diff(t_x), E.diff(t_y)], [t_x, t_y], dict=True)[0]
mean_a, mean_b = a * ones.T / 3, b * ones.T / 3
sp.simplify(t.subs(best_t) - (mean_b - Rot * mean_a)).T

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Then the rotation
#
# Now we express all points relative to their centroids, $a_i' = a_i - \bar a$ and
# $b_i' = b_i - \bar b$. Then (13.1) no longer contains the translation. A rotation changes no length,
# so in each square only the mixed term depends on $\theta$:
#
# $$E = \sum_i |a_i'|^2 + \sum_i |b_i'|^2 - 2\Bigl(\cos\theta \sum_i a_i' \cdot b_i' + \sin\theta \sum_i a_i' \times
# b_i'\Bigr). \tag{13.3}$$
#
# Here $a \times b$ is $a_x b_y - a_y b_x$. We compute the difference of both sides:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
a_c, b_c = a - mean_a * ones, b - mean_b * ones
dot = sum(a_c[0, i] * b_c[0, i] + a_c[1, i] * b_c[1, i] for i in range(3))
cross = sum(a_c[0, i] * b_c[1, i] - a_c[1, i] * b_c[0, i] for i in range(3))
gain = sp.cos(theta) * dot + sp.sin(theta) * cross
sp.simplify(E.subs(best_t) - (squares(a_c) + squares(b_c) - 2 * gain))

# %% slideshow={"slide_type": "subslide"}
ask(
    "13-valleys",
    "The clouds have 400 correspondences. **How many minima can $E$ have for $\\theta$ between 0° and 360°?**",
    {
        "one": "the terms of all correspondences add up to one cosine and one sine, and so to one sinusoid, which has "
        "one minimum in 360°.",
        "up to 400: one for each correspondence": "each correspondence has its own best angle. But a sum of sinusoids "
        "that all have a period of 360° is again a sinusoid with that period.",
        "two, half a turn apart": "half a turn away from the minimum, each cosine has changed its sign, so the maximum "
        "is there.",
    },
    right="one",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="13-valleys"
# ### One minimum
#
# The parenthesis in (13.3) is one sinusoid in $\theta$. Within 360° it has one maximum. There the
# tangent of $\theta$ is the factor of the sine divided by the factor of the cosine:
#
# $$\theta = \operatorname{atan2}\Bigl(\sum_i a_i' \times b_i',\; \sum_i a_i' \cdot b_i'\Bigr). \tag{13.4}$$
#
# So with known correspondences we need no search, and the cost has no other **local minimum**. (If both
# sums are zero, all angles have the same cost.) For any number of points, two sums determine the angle.
# Points far from the centroid have more weight, since a rotation moves them farther.
#
# We test these formulas with known correspondences: we transform the first scan by the inverse of the
# true motion, and add noise of σ = 5 mm to $x$ and to $y$. The library's `rigid_fit` returns the motion
# of (13.2) and (13.4).

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="13-valleys"
noise = 0.005 * np.random.default_rng(2).standard_normal(first.shape)
known = transform(between(true_motion, np.zeros(3)), first) + noise
paired = rigid_fit(known, first)
print("found", np.round(paired, 4), " true", np.round(true_motion, 4))
print("error {:.1f} mm and {:.2f}°".format(*error_of(paired)))

# %% [markdown] slideshow={"slide_type": "fragment"} answers="13-valleys"
# The noise of {= len(first) =} correspondences averages out. Most textbooks find the rotation by a singular
# value decomposition (SVD). In the plane the SVD gives the same angle, and in space it is the usual
# method. The first *Deeper* section derives this method, and shows in which case it needs a correction.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=11
# ## ICP: unknown correspondences
#
# Now the correspondences are unknown. The idea of **iterative closest point**, ICP, is to guess them: each source point
# corresponds to the **nearest** target point. Rigid alignment of these correspondences gives a better pose, the better pose
# gives better correspondences, and so on. One search for correspondences and one alignment form an
# *iteration*. We run ICP on our two scans:

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The question is about the difference between what is minimised and what is
# measured. Write (13.5) with the two inequalities apart, and ask for each which step of the algorithm
# makes it true.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
watched = point_to_point(second, first, guess, history=True)
print("odometry:", in_words(guess))
print(f"ICP:      {in_words(watched.pose)}, after {watched.iterations} iterations")

# %% [markdown] slideshow={"slide_type": "fragment"}
# At the start most correspondences are wrong, but the position error at the end is
# {= error_of(guess)[0] / error_of(watched.pose)[0]:.0f =} times smaller than that of odometry. Why does
# an alignment of wrong correspondences help?

# %% slideshow={"slide_type": "subslide"}
ask(
    "13-can-grow",
    "After every iteration we measure the lengths of all correspondences. **What can grow from one iteration to the next?**",
    {
        "nothing: every iteration improves every measure": "an alignment minimises one measure. Other measures may "
        "grow.",
        "the sum of their squares, but not their mean": "the alignment minimises exactly this sum for the given "
        "correspondences, and new nearest points can only make the sum smaller.",
        "their mean, but not the sum of their squares": "the alignment minimises squares. It makes many short correspondences a "
        "little longer if one long correspondence then becomes much shorter, and then the mean can grow.",
        "both, since the correspondences change": "the correspondences change, but only to points that are nearer.",
    },
    right="their mean, but not the sum of their squares",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="13-can-grow"
# ### Convergence
#
# Let $d_i$ be the length of correspondence $i$ before an iteration, and $d_i'$ after it. Let $\hat d_i$
# be its length with the new pose, but before the new search for correspondences. Then
#
# $$\sum_i d_i'^{\,2} \;\le\; \sum_i \hat d_i^{\,2} \;\le\; \sum_i d_i^{\,2}. \tag{13.5}$$
#
# The right inequality holds because the alignment gives the *least* sum of squares for these
# correspondences. The left inequality holds because the nearest point is no farther away than the old
# counterpart. For the mean length the left inequality holds as well, but the right inequality may fail.
# We start 60 runs from bad initial guesses, and count the runs in which each measure grew:


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output", "code"] answers="13-can-grow"
def lengths(state):
    """Lengths of the correspondences in an iteration [m]."""
    source, target = state.pairs.T
    return np.hypot(*(transform(state.pose, second[source]) - first[target]).T)


rng, runs = np.random.default_rng(0), []
for _ in range(60):
    wrong = [*rng.uniform(-0.6, 0.6, 2), rng.uniform(-np.pi, np.pi)]
    start = true_motion + wrong
    runs.append(point_to_point(second, first, start, tolerance=1e-15, history=True).history)
measures, grew = {"sum of squares": lambda d: np.sum(d**2), "mean length": np.mean}, {}
for name, measure in measures.items():
    values = [np.array([measure(lengths(state)) for state in states]) for states in runs]
    grew[name] = sum(np.any(np.diff(v) > 1e-9 * v[:-1]) for v in values)
    print(f"{name:14} grew at some time in {grew[name]:2} of {len(runs)} runs")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="13-can-grow"
# The sum of squares never grew, in agreement with (13.5). The number of possible sets of
# correspondences is finite, and no set recurs once a smaller sum has been reached. So ICP always
# **converges** to *a* local minimum. (13.5) does not show whether this minimum is near the true motion.

# %% [markdown] slideshow={"slide_type": "slide"}
# > **Algorithm: ICP, point-to-point** (Besl and McKay 1992)
# >
# > **Input:** source points $a_i$, target points $b_j$, initial guess of the pose $(t, \theta)$, tolerance.
# >
# > 1. Transform the source: $p_i = \mathrm{Rot}(\theta)\,a_i + t$.
# > 2. Correspondences: for each $p_i$ the nearest target point, $b_{c(i)}$, found by a k-d tree.
# > 3. Rejection (an option of later variants): drop the longest correspondences.
# > 4. Rigid alignment of all $p_i$ and $b_{c(i)}$ by (13.2) and (13.4): the motion $(\Delta t, \Delta\theta)$.
# > 5. Compose: $(t, \theta) \leftarrow (\Delta t, \Delta\theta) \oplus (t, \theta)$. The motion is in the target's frame, so
# >    it is the left operand.
# > 6. Repeat from step 1 until the mean length of the correspondences (in the paper: their mean square) changes by less than
# >    the tolerance.
# >
# > **Output:** the pose $(t, \theta)$ and the correspondences.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
icp = point_to_point(second, first, guess, tolerance=1e-6, history=True)
for k, state in enumerate(icp.history):
    if k in (0, 1, 2, 5, 10, icp.iterations):
        cost, mean = np.sum(lengths(state) ** 2), 1000 * state.error
        print(
            f"iteration {k:2}: E = {cost:6.3f} m², mean length {mean:3.0f} mm, {in_words(state.pose)}"
        )

# %% [markdown] slideshow={"slide_type": "subslide"}
# Comparing each of $n$ source points with all $m$ target points requires $nm$ distances. A **k-d tree**
# divides the set of target points into halves repeatedly, alternately by $x$ and by $y$. A search
# descends to the cell of the source point, and then visits only cells that can contain a nearer point.
# On average it takes about $\log m$ steps for each point.
#
# **Your turn.** Call a source point an **inlier** if its nearest target point is within 3 cm, at the
# pose that ICP found. The share of inliers is the *overlap*. Compute the overlap.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
tree, points = cKDTree(first), transform(icp.pose, second)  # a k-d tree
distances, rows = tree.query(points)  # of the nearest target points
overlap = ...
compare(overlap, sum(map(bool, tree.query_ball_point(points, 0.03))) / len(points))

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# tree, points = cKDTree(first), transform(icp.pose, second)  # a k-d tree
# distances, rows = tree.query(points)  # of the nearest target points
# overlap = np.mean(distances < 0.03)
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Iteration by iteration
#
# Each grey line is a correspondence. The heading of the guess is 10° too far to the left. Look at
# iteration 0 first: where are the lines long, and in which direction does the alignment move the scan?
# Then continue, iteration by iteration. After that, try a worse heading.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Stop at iteration 0 and let the class predict the direction of the first step
# from the grey lines. Point at one wall: the components of the lines across the wall move the scan,
# and the components along it hinder.


# %% slideshow={"slide_type": "subslide"} tags=["folded"]
def state_of(iteration, heading_error):
    start = [*guess[:2], true_motion[2] + np.radians(heading_error)]
    states = point_to_point(second, first, start, history=True).history
    return states[min(iteration, len(states) - 1)]


def watch(iteration, heading_error):
    state = state_of(iteration, heading_error)
    title = f"iteration {iteration}: {in_words(state.pose)}"
    return views.overlay(first, transform(state.pose, second), state.pairs, title, (8, 5))[0]


views.explore(
    watch,
    lambda iteration, heading_error: (
        f"Grey lines connect each point of the second scan with the nearest of the first, in iteration {iteration} from "
        f"a heading error of {heading_error}°: {in_words(state_of(iteration, heading_error).pose)}."
    ),
    play="iteration",
    iteration=(0, 40, 1),
    heading_error=(-180, 180, 10),
)
shift, turn = 1 - np.divide(error_of(watched.history[1].pose), error_of(guess))

# %% [markdown] slideshow={"slide_type": "fragment"}
# From the guess by odometry, the first iteration removed {= 100 * shift:.0f =} % of the position error,
# but only {= 100 * turn:.0f =} % of the heading error. The nearest target point is usually not the true
# spot on the wall, but a spot *beside* it. So the correspondences move the two scans of a wall towards
# each other, but resist a shift along the wall.
#
# At the end the correspondences are still {= 1000 * watched.error:.0f =} mm long on average, although
# the noise of the lidar is much smaller. This length has two reasons: the beams of the two scans hit
# different spots of a wall, and some walls appear in one scan only.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Stopping rules
#
# A loop needs a stopping rule. Two rules are obvious. **A bound:** stop as soon as the mean length of
# the correspondences is small enough. **A change:** stop as soon as the mean length hardly changes in
# an iteration.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Students want a bound on the error, but ICP does not know the error. If time is
# short, show only the last two rows of the output.

# %% slideshow={"slide_type": "fragment"}
ask(
    "13-bound",
    "The standard deviation of the lidar's noise is one or two millimetres. So we let ICP continue **until the mean length of the correspondences is below "
    "2 mm**. What happens on the polygon?",
    {
        "it stops when the match is accurate to two millimetres": "the lengths of the correspondences are not the error of "
        "the pose. Even at the true pose, half of them are longer than 5 mm.",
        "it never stops": "beams of two scans hit a wall at different spots, so the correspondences do not become shorter than "
        "the distances between these spots, and the bound is below these distances.",
        "it stops too early": "ICP stops too early if the bound is too large. This bound is too small.",
    },
    right="it never stops",
)


# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output", "code"] answers="13-bound"
def first_stop(states, rule):
    """The iteration after which a rule (mean length now, before) stops; None: never."""
    means = [state.error for state in states]
    return next((k for k in range(1, len(means)) if rule(means[k], means[k - 1])), None)


RULES = {
    "below 2 mm": lambda now, before: now < 2e-3,
    "below 50 mm": lambda now, before: now < 50e-3,
    "change below 1 mm": lambda now, before: abs(now - before) < 1e-3,
    "change below 0.001 mm": lambda now, before: abs(now - before) < 1e-6,
}
states = point_to_point(second, first, guess, tolerance=1e-15, history=True).history
for name, rule in RULES.items():
    k = first_stop(states, rule)
    print(f"{name:22}", f"after {k:2}: {in_words(states[k].pose)}" if k else "never stops")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="13-bound"
# A suitable bound is unknown, and both bounds are bad: ICP never reaches 2 mm, and it reaches 50 mm too
# soon, with a heading error of {= error_of(states[first_stop(states, RULES["below 50 mm"])].pose)[1]:.1f =}°. The change of the mean length shows when further
# iterations hardly help, for any noise. But the tolerance must be small, because ICP converges slowly:
# with a tolerance of 1 mm ICP stops before the rotation is complete. (The mean length at the end has
# another use. If it is much larger than expected, ICP has converged to a wrong local minimum.)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Four poses, one map
#
# The robot scans the polygon from four poses. We match each scan with the previous scan, with odometry
# as the initial guess, and compose the matched motions. For comparison we show dead reckoning by
# odometry alone.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The second figure is the one to show: exact odometry, and ICP makes it worse.
# Let the class look for the cause before the next section gives it.


# %% slideshow={"slide_type": "skip"} tags=["folded"]
def trajectories_of(source, matcher):
    """Poses (n, 3) by odometry alone and by matching, and the scans."""
    naive, corrected, scans = [np.zeros(3)], [np.zeros(3)], []
    for reading in source:
        points = reading.scan.points()
        if scans:
            naive.append(compose(naive[-1], reading.odometry))
            step = matcher(points, scans[-1], reading.odometry).pose
            corrected.append(compose(corrected[-1], step))
        scans.append(points)
    return np.array(naive), np.array(corrected), scans


def maps_of(source, matcher):
    """A figure of both maps, and the errors of both last poses [mm], [°]."""
    *both, scans = trajectories_of(source, matcher)
    titles, shown, ends = {"naive": "odometry alone", "corrected": "with ICP"}, {}, {}
    for name, poses in zip(titles, both, strict=True):
        ends[name] = error_of(poses[-1], source.truth.poses[-1])
        xy = np.vstack([transform(pose, scan) for pose, scan in zip(poses, scans, strict=True)])
        title = f"{titles[name]}: last error {ends[name][0]:.0f} mm"
        shown[title] = {
            f"scans, {titles[name]}": Points(name, xy),
            "trajectory": Poses("robot", poses),
        }
    return views.side_by_side(shown, size=(9, 4.2))[0], ends


# %% slideshow={"slide_type": "subslide"} tags=["folded"]
fig, by_wrong = maps_of(simulation("polygon-wrong", np.random.default_rng(1)), point_to_point)
views.show(
    fig,
    f"Odometry alone draws four rotated polygons, with an error of {by_wrong['naive'][0]:.0f} mm at the end. ICP draws "
    f"one polygon, with an error of {by_wrong['corrected'][0]:.0f} mm.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The left map shows four polygons, which are rotated relative to each other. The right map shows one
# polygon with its box and its cylinder.

# %% slideshow={"slide_type": "subslide"}
ask(
    "13-right-already",
    "Now consider the same four scans with odometry that is **exactly right**. **What is the error of the last pose after ICP?**",
    {
        "0 mm: at the true motion the cost is least": "points on walls that only one scan contains have no true "
        "correspondence. They get false correspondences, which shift the minimum of the cost.",
        "about a millimetre: the noise of the lidar": "the noise averages out, as with known correspondences. "
        "Correspondences that are all wrong in the same direction do not average out.",
        "about as large as from the wrong odometry": "the result does not depend on the initial guess if the guess is "
        "accurate enough. From both guesses ICP converges to the same local minimum, which is not the true motion.",
    },
    right="about as large as from the wrong odometry",
)

# %% slideshow={"slide_type": "fragment"} answers="13-right-already" tags=["folded"]
fig, by_right = maps_of(simulation("polygon", np.random.default_rng(1)), point_to_point)
views.show(
    fig,
    f"Exact odometry alone draws a sharp map, with an error of {by_right['naive'][0]:.0f} mm. ICP draws thicker walls, "
    f"with an error of {by_right['corrected'][0]:.0f} mm.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="13-right-already"
# ICP made the map *worse*: the last error is {= by_right["corrected"][0]:.0f =} mm, compared with {= by_wrong["corrected"][0]:.0f =}
# mm from the wrong odometry. Walls at the top and at the bottom of the right map are thicker. So another cause than noise
# moves the scans away from their true poses.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=9
# ## Partial overlap and trimmed ICP
#
# ICP assigns a correspondence to **every** source point. A source point on a wall that the target scan
# does not contain has no true counterpart. Such a point is an **outlier**, but its correspondence still
# affects the alignment.
#
# Now we make the problem worse. Many robots have a scanner with a field of view of only 180°. After a
# turn of −45° a quarter of the second scan shows new walls.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Point at one fan and follow its lines to the single point at their end. In the
# table, read the right column against the left one: a small share is best from the truth and worst
# from a wrong guess.

# %% slideshow={"slide_type": "fragment"}
ask(
    "13-new-quarter",
    "ICP starts **from the true motion**. **How large is its heading error at the end?**",
    {
        "below 1°": "a quarter of the correspondences are wrong, and all of them rotate the scan in the same "
        "direction.",
        "about 9°": "the new part lies at one side of the scan. Its points correspond to the outermost "
        "points of the old scan, and these correspondences rotate the whole scan.",
        "45°: one scan on the other, beam by beam": "the walls that both scans contain resist the rotation. ICP ends "
        "at the minimum of the sum of both costs.",
    },
    right="about 9°",
)

# %% slideshow={"slide_type": "subslide"} answers="13-new-quarter" tags=["folded"]
ahead = replace(RPLIDAR_A2, field_of_view=np.pi, beams=200)
half = [r.scan.points() for r in simulation("polygon", np.random.default_rng(1), lidar=ahead)]


def trimmed(share_kept, heading_error):
    start = true_motion + np.array([0, 0, np.radians(heading_error)])
    return point_to_point(half[1], half[0], start, keep=share_kept, history=True)


def draw_trimmed(share_kept, heading_error):
    end = trimmed(share_kept, heading_error).history[-1]
    title = f"the shortest {100 * share_kept:.0f} %: {in_words(end.pose)}"
    return views.overlay(half[0], transform(end.pose, half[1]), end.pairs, title, (8, 5))[0]


views.explore(
    draw_trimmed,
    lambda share_kept, heading_error: (
        f"Scans of a half turn, aligned with the shortest {100 * share_kept:.0f} % of their correspondences, "
        f"{in_words(trimmed(share_kept, heading_error).pose)}; with all of them, many lines end at a few points."
    ),
    share_kept=(0.1, 1.0, 1.0),
    heading_error=(-90, 90, 0),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="13-new-quarter"
# The figure shows **fans** of lines: dozens of points on new walls correspond to the outermost points
# of the first scan. These correspondences rotate the whole scan away from the true motion. The initial
# guess was exact, and the noise is small. The *method* causes the error of
# {= error_of(trimmed(1.0, 0).pose)[1]:.0f =}°.
#
# The correspondences of the fans are the longest. So in every iteration **trimmed ICP** sorts the
# correspondences by length, and uses only a given share of them, the shortest ones. Move the first
# slider from 1 to 0.8: the fans disappear. (The inequality (13.5) still holds, for the sum over the
# shortest correspondences.)
#
# Is a smaller share always better? Set the share to 0.1, and then start with a heading error of 10°.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="13-new-quarter"
print("share kept    from the truth        initial error 10°")
by_share = {}
for share in (1.0, 0.9, 0.8, 0.7, 0.5, 0.3, 0.1):
    by_share[share] = [error_of(trimmed(share, start).pose) for start in (0, 10)]
    ends = ["{:5.0f} mm, {:4.1f}°".format(*end) for end in by_share[share]]
    print(f"{share:10.1f}    {ends[0]:20}  {ends[1]}")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="13-new-quarter"
# If ICP starts from the truth, a share of a tenth seems best. But the shortest correspondences are
# those that *already* fit, so an alignment of only a few of them changes the pose little: from a
# heading error of 10°, a share of 0.1 ends with an error of {= by_share[0.1][1][1]:.0f =}°. The right
# share depends on the overlap, which is unknown beforehand. (Here the overlap is about three quarters.)
# *This is a good place for a break.*

# %% [markdown] slideshow={"slide_type": "slide"} minutes=12
# ## Part two: point-to-line ICP
#
# The beams of two scans hit a wall at different spots. So the distance **along** the wall between a
# point and its counterpart contains no information, but in the cost this distance resists a correct
# shift along the wall. **Point-to-line** ICP (in space: *point-to-plane*) minimises only the distance
# **across** the wall. With the **normal** $n_i$, the unit vector across the wall at the target point
# $b_i$, the residual is
#
# $$e_i = n_i^{\mathsf T} (\mathrm{Rot}(\theta)\,a_i + t - b_i). \tag{13.6}$$

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Draw a wall, two points beside each other, and the two residuals; ask which one
# a shift along the wall changes. Students assume that (13.5) still holds: it does not.

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
normal = normals(first)
spikes = np.hstack([first, first + 0.12 * normal])[::6]
layers = {
    "normals": Segments("normals", spikes[~np.isnan(spikes).any(axis=1)]),
    "first scan": Points("map", first),
}
fig, _ = views.side_by_side({"the first scan and its normals": layers}, size=(8, 5))
views.show(
    fig,
    "Short lines at every sixth point are perpendicular to the walls of the first scan. At corners their direction is "
    "between the normals of both walls.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **Normal estimation** fits a line to each point and its neighbours. The normal is the eigenvector of the smallest eigenvalue of
# the neighbours' covariance (a *principal component analysis*). At a corner the neighbours lie on two
# walls, so the direction of the normal is between the normals of both walls. If the neighbours do not
# lie along a line, the point gets no normal, as for {= np.isnan(normal).any(axis=1).sum() =} of these
# {= len(first) =} points. Point-to-line ICP ignores correspondences without a normal.

# %% slideshow={"slide_type": "subslide"}
ask(
    "13-wall-ahead",
    "All points of a scan lie on **one straight wall, square ahead** of the robot, with $x$ ahead and $y$ to the "
    "left. **About which unknowns do the point-to-line residuals contain information?**",
    {
        "$x$ alone": "a rotation moves one end of the wall nearer and the other end farther away, so the distances across the wall change.",
        "$x$ and $\\theta$": "a step to the side shifts the points along the wall, and changes no distance across the wall.",
        "$x$ and $y$, but not $\\theta$": "a step to the side shifts the points along the wall. A rotation moves one end of the wall nearer.",
        "all three": "a straight wall looks the same after a step to the side.",
    },
    right="$x$ and $\\theta$",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="13-wall-ahead"
# ### The Jacobian
#
# We shift the pose by $d_x$ and $d_y$, and rotate it by $d_\theta$ about the robot's position $t$. The
# rotation turns the **arm**, the vector $\mathrm{arm}_i = \mathrm{Rot}(\theta)\,a_i$ from the robot to
# the point. The derivatives of $e$ at zero motion are:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="13-wall-ahead"
d_x, d_y, d_theta = sp.symbols("d_x d_y d_theta", real=True)
n, arm, at, partner = (
    sp.Matrix(sp.symbols(f"{name}_x {name}_y", real=True)) for name in ("n", "arm", "t", "b")
)
point = at + sp.Matrix([d_x, d_y]) + Rot.subs(theta, d_theta) * arm
e = n.T * (point - partner)
e.jacobian([d_x, d_y, d_theta]).subs(d_theta, 0)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="13-wall-ahead"
# So each correspondence contributes one row to the **Jacobian**:
#
# $$J_i = \begin{bmatrix} n_x & n_y & \mathrm{arm}_i \times n_i \end{bmatrix}. \tag{13.7}$$
#
# For a wall square ahead, $n = (1, 0)$. The second entry is zero, and the third entry is
# $-\mathrm{arm}_y$: its absolute value grows with the sideways distance of the point.
#
# **Your turn.** Write the row of a correspondence, and compare it with central differences.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"] answers="13-wall-ahead"
normal_i, arm_i = np.array([0.6, 0.8]), np.array([2.0, 0.5])
row = ...  # [.., .., ..] by (13.7)
shifts = 1e-6 * np.eye(3)
moved = [transform(d, arm_i[None])[0] - transform(-d, arm_i[None])[0] for d in shifts]
compare(row, [normal_i @ each / 2e-6 for each in moved])

# %% [markdown] slideshow={"slide_type": "fragment"} answers="13-wall-ahead"
# <details><summary>Answer</summary>
#
# ```python
# normal_i, arm_i = np.array([0.6, 0.8]), np.array([2.0, 0.5])
# row = [0.6, 0.8, 2.0 * 0.8 - 0.5 * 0.6]
# shifts = 1e-6 * np.eye(3)
# moved = [transform(d, arm_i[None])[0] - transform(-d, arm_i[None])[0] for d in shifts]
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "subslide"} answers="13-wall-ahead"
# ### The Gauss–Newton step
#
# (13.4) does not minimise this cost, since (13.3) contains both components of each residual. (In the
# plane, the solution follows from a polynomial of degree four, Censi 2008.) The usual method is to
# linearise. After a small motion $\delta = (d_x, d_y, d_\theta)$ every residual is about
# $e_i + J_i\,\delta$. We stack the residuals of all correspondences in one vector. The cost function is
# then quadratic in $\delta$, and at its minimum the gradient is zero:
#
# $$\begin{aligned} E(\delta) &\approx |e + J\delta|^2, \qquad \nabla E = 2\,J^{\mathsf T}(e + J\delta) = 0, \\ J^{\mathsf T}J\,
# \delta &= -J^{\mathsf T} e \quad\Longrightarrow\quad \delta = -(J^{\mathsf T}J)^{-1} J^{\mathsf T} e. \end{aligned} \tag{13.8}$$
#
# This is a **Gauss–Newton** step. The equations $J^{\mathsf T}J\,\delta = -J^{\mathsf T} e$ are its
# *normal equations*: these are three equations for any number of points. A rotation is not linear in
# $d_\theta$, so the step is not exact. After each step we find new correspondences, and compute another
# step. (The inequality (13.5) does not hold for point-to-line ICP: the search chooses the nearest
# points, but the cost contains only the distances across the walls. So this cost may grow from one
# iteration to the next.)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="13-wall-ahead"
# ### A robust kernel
#
# Outliers have large residuals, and the squares give these residuals the most weight. A **robust
# kernel** replaces $e^2$ by a cost that grows more slowly. The library's `point_to_line` uses Cauchy's
# kernel, $\rho(e) = c^2 \log(1 + e^2/c^2)$, where $c$ is the size of an ordinary
# residual. By the chain rule the gradient of $\rho(e)$ is the gradient of $e^2$ times the weight
# $w = \rho'(e) / 2e$. So each correspondence gets the weight $w_i$ in (13.8), and each iteration
# computes the weights again.
#
# **Your turn.** Differentiate $\rho$, and compute the weight of a residual of 6 cm for $c$ = 2 cm.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"] answers="13-wall-ahead"
residual, c = 0.06, 0.02
weight = ...  # ρ'(e) / 2e
rho = [c**2 * np.log(1 + x**2 / c**2) for x in (residual - 1e-6, residual + 1e-6)]
compare(weight, (rho[1] - rho[0]) / 2e-6 / (2 * residual), tolerance=1e-5)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="13-wall-ahead"
# <details><summary>Answer</summary>
#
# ```python
# residual, c = 0.06, 0.02
# weight = 1 / (1 + residual**2 / c**2)
# rho = [c**2 * np.log(1 + x**2 / c**2) for x in (residual - 1e-6, residual + 1e-6)]
# ```
#
# A residual of $3c$ has the weight 0.1, and a residual of $10c$ has a weight of about 0.01.
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## Point-to-point or point-to-line?
#
# Plain ICP needed two dozen iterations on the polygon. The library's `point_to_line` not only minimises
# distances across walls. It also has **gates**, which reject correspondences that are too long (more
# than 1 m at first, 10 cm in the end) or whose normals differ too much, and the robust kernel. To
# separate these effects, we also run a *bare* version: its limits are so wide that it neither rejects
# nor down-weights any correspondence. We compare four methods on the same two scans, from the same
# initial guess:

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The experiment separates two changes. Ask which row of the table shows the
# effect of the residuals alone (*bare*), and which the effect of gates and kernel.

# %% slideshow={"slide_type": "fragment"}
# heading error after each iteration, from the same initial guess, by four methods
WIDE = {"gate": (1e3, 1e3), "normal_gate": np.pi}  # [m], [rad]
METHODS = {
    "point to point": point_to_point,
    "trimmed, 80 %": lambda p, q, start, **how: point_to_point(p, q, start, keep=0.8, **how),
    "point to line": point_to_line,
    "bare": lambda p, q, start, **how: point_to_line(p, q, start, **WIDE, **how),
}

turned = {}
for name, matcher in METHODS.items():
    states = matcher(second, first, guess, history=True).history[:21]
    turned[name] = np.pad([error_of(s.pose)[1] for s in states], (0, 21 - len(states)), "edge")

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
fig, ax = views.curves(np.arange(21), turned, "iteration", "heading error [°]", size=(8, 4.2))
ax.set_yscale("log")
views.legend(ax)
views.show(
    fig,
    f"The error of point to line is at most {turned['point to line'][2:].max():.3f}° from iteration two on, and that of bare "
    f"{turned['bare'][3:].max():.3f}° from iteration three on; the other methods converge slowly, to "
    f"{turned['trimmed, 80 %'][20]:.1f}° and {turned['point to point'][20]:.1f}° after twenty iterations.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The vertical axis is logarithmic. After three iterations the heading error of point-to-line ICP is
# {= turned["point to line"][3]:.2f =}°, and that of the bare version is {= turned["bare"][3]:.2f =}°.
# The heading error of plain ICP is {= turned["point to point"][3]:.1f =}° after three iterations, and
# {= turned["point to point"][20]:.1f =}° after twenty. So here the residuals across the walls cause the
# faster convergence.
#
# Is this result typical? We apply these methods and `match`, the library's best matcher (described
# below), to ten simulated runs through the polygon, with both scanners. Each run has three steps, the
# same odometry, and new noise.


# %% slideshow={"slide_type": "skip"} tags=["folded"]
def errors_of_steps(matcher, lidar, seeds=10):
    """Errors of odometry's steps and of a matcher's: (n, 2) each [mm], [°]."""
    found = []
    for seed in range(seeds):
        source = simulation("polygon-wrong", np.random.default_rng(seed), lidar=lidar)
        *both, _ = trajectories_of(source, matcher)
        true, *steps = (between(p[:-1], p[1:]) for p in (source.truth.poses, *both))
        found += [[error_of(p, q) for p, q in zip(step, true, strict=True)] for step in steps]
    return np.concatenate(found[::2]), np.concatenate(found[1::2])


# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
# errors of five matchers in 30 steps, with both fields of view
medians, nearer = {}, {}
for width, lidar in {"whole turn": RPLIDAR_A2, "half a turn": ahead}.items():
    for name, matcher in (METHODS | {"match": match}).items():
        odometry, matched = errors_of_steps(matcher, lidar)
        medians[width, name] = np.median(matched, axis=0)
        nearer[width, name] = np.sum(np.all(matched < odometry, axis=1))
        words = "median {:5.1f} mm, {:.2f}°".format(*medians[width, name])
        print(f"{width:>11}, {name:14}: {words}; better in {nearer[width, name]} of 30 steps")
print("odometry: median {:.0f} mm, {:.1f}°".format(*np.median(odometry, axis=0)))

# %% [markdown] slideshow={"slide_type": "fragment"}
# The errors of this odometry are so large that every method is better, in position and in heading, in
# {= "each" if min(nearer.values()) == 30 else f"{min(nearer.values())} or more" =} of the 30 steps.
# With a field of view of 360°, residuals across the walls alone (*bare*) reduce the median position
# error from {= medians["whole turn", "point to point"][0]:.0f =} mm to
# {= medians["whole turn", "bare"][0]:.1f =} mm. With a field of view of 180° the median of *bare* is
# still {= medians["half a turn", "bare"][0]:.0f =} mm, and that of plain ICP
# {= medians["half a turn", "point to point"][0]:.0f =} mm: points that appear in only one scan cause
# these errors. Trimmed ICP removes most of the error, if the share is suitable. Gates and the robust
# kernel do so as well: with them, the median of point-to-line ICP is
# {= medians["half a turn", "point to line"][0]:.1f =} mm. Then we need not choose a share, but we must
# choose limits.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=10
# ## The basin of convergence
#
# ICP searches only in the neighbourhood of its initial guess. The set of initial guesses from which ICP
# converges to the true motion is its **basin of convergence**. In the next figure, 24 matches start
# with headings in all directions, and each line is one match. We count a match as *converged to the
# truth* if it ends within 5 cm and 2° of the true motion.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let the class vote twice, once for accuracy and once for the basin: the winner
# differs. Warn that a difference of a few tries proves nothing.


# %% slideshow={"slide_type": "subslide"} tags=["folded"]
def is_correct(pose, truth=true_motion):
    return error_of(pose, truth)[0] < 50 and error_of(pose, truth)[1] < 2


def heading_errors(method, share_kept, metres_off):
    """24 matches from all headings: their heading errors by iteration [°], and which are correct."""
    matcher, found = METHODS[method], []
    for degrees in range(-180, 180, 15):
        start = true_motion + np.array([metres_off, 0, np.radians(degrees)])
        how = {"keep": share_kept, "max_iterations": 80, "history": True}
        states = matcher(second, first, start, **how).history
        turns = np.unwrap([wrap(state.pose[2] - true_motion[2]) for state in states])
        found.append((np.degrees(turns), is_correct(states[-1].pose)))
    return found


def draw_basin(method, share_kept, metres_off):
    found = heading_errors(method, share_kept, metres_off)
    title = f"{sum(correct for _, correct in found)} of {len(found)} converge to the truth"
    fig, ax = views.chart("iteration", "heading error [°]", title, size=(8, 4.8))
    for turns, correct in found:
        name, line = ("corrected", "solid") if correct else ("naive", "dashed")
        ax.plot(turns, color=views.COLOURS[name], linestyle=line)
    ax.plot([], color=views.COLOURS["corrected"], label="converges to the truth")
    ax.plot([], color=views.COLOURS["naive"], linestyle="dashed", label="local minimum")
    views.legend_below(fig)
    return fig


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
views.explore(
    draw_basin,
    lambda method, share_kept, metres_off: (
        f"Heading errors by iteration, of {method} matches from all headings with a position error of {metres_off:.2f} m: "
        f"{sum(correct for _, correct in heading_errors(method, share_kept, metres_off))} converge to the truth."
    ),
    method=["point to point", "point to line"],
    share_kept=(0.3, 1.0, 1.0),
    metres_off=(0.0, 1.0, 0.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The blue lines converge to zero. The red lines end at wrong local minima, where the error no longer
# changes either. Now change the method, the share, and the position error of the guess. Which of these
# changes reduces the number of blue lines?

# %% slideshow={"slide_type": "subslide"}
ask(
    "13-basin",
    "Point-to-line ICP with its gates was far more accurate than plain point-to-point ICP. **Whose basin of convergence is "
    "larger, if the guess is wrong in position and heading?**",
    {
        "that of point to line: it is more accurate": "near the truth, the gates reject wrong correspondences. Far from the "
        "truth nearly all correspondences are long, and the gates also reject some that would reduce the error.",
        "that of point to point": "point-to-point ICP converges slowly. But it uses all correspondences, even very long ones, "
        "and so it often converges to the truth from a metre away.",
        "they are the same: both use nearest points": "both use nearest points, but point-to-line ICP also rejects or "
        "down-weights correspondences.",
    },
    right="that of point to point",
)

# %% slideshow={"slide_type": "subslide"} answers="13-basin" tags=["folded"]
places = [r.scan.points() for r in simulation("polygon", np.random.default_rng(1))]
true_steps = between(run.truth.poses[:-1], run.truth.poses[1:])
degrees_off, metres_off = [0, 15, 30, 45, 60, 90, 180], [0, 0.25, 0.5, 1.0]


def share_correct(matcher, degrees, metres, rng, tries=9):
    """The share of guesses with these errors, in random directions, that converge to the truth."""
    correct = []
    for k in np.arange(tries) % 3:
        direction, sign = rng.uniform(-np.pi, np.pi), rng.choice([-1, 1])
        shift = [metres * np.cos(direction), metres * np.sin(direction)]
        start = true_steps[k] + [*shift, sign * np.radians(degrees)]
        correct.append(is_correct(matcher(places[k + 1], places[k], start).pose, true_steps[k]))
    return np.mean(correct)


basins = {}
for name in ("point to point", "bare", "point to line", "match"):
    rng, matcher = np.random.default_rng(0), (METHODS | {"match": match})[name]  # same guesses
    basins[name] = np.array(
        [[share_correct(matcher, row, x, rng) for x in metres_off] for row in degrees_off]
    )

# %% slideshow={"slide_type": "subslide"} answers="13-basin" tags=["folded"]
labels = "position error [m]", "heading error of the guess [°]"
tried = 9 * 2 * len(metres_off)  # guesses with heading errors of 45° and 60°


def share_of(name, first, end):
    """The share of guesses in some rows that converge to the truth, with its 95 % interval."""
    row = basins[name][first:end]
    return percent(share_interval(round(9 * row.sum()), 9 * row.size))


fig, _ = views.cells(basins, metres_off, degrees_off, *labels, size=(9.5, 4.2))
shares = ", ".join(f"{name} {100 * np.mean(table):.0f} %" for name, table in basins.items())
views.show(
    fig,
    f"Shares of guesses that converge to the truth, by the error of the guess; over all cells {shares}.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="13-basin"
# Of the {= tried =} guesses with heading errors of 45° and 60°, these shares converge to the truth (with 95 %
# intervals, lesson 12): with plain ICP {= share_of("point to point", 3, 5) =}, with bare point-to-line ICP
# {= share_of("bare", 3, 5) =}, and with gates and kernel {= share_of("point to line", 3, 5) =}. Up to 30°, the
# shares are {= share_of("point to point", 0, 3) =}, {= share_of("bare", 0, 3) =} and
# {= share_of("point to line", 0, 3) =}. Gates and kernels exclude points that appear in only one scan, but they
# make the basin smaller. The last method, `match`, converged to the truth in {= share_of("match", 0, 7) =} of all tries.
# How does `match` find the truth?

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Correlative matching
#
# `match` **verifies** its own result. Do enough points lie on the other scan's walls? Does a point lie
# where a beam of the other scan passed through? If the result is poor, `match` searches all poses: this
# is **correlative matching** (Olson 2009). Both scans are converted into coarse grids. The
# cross-correlation of two grids counts, for every translation at once, how many points coincide.
# `match` computes it for each of many rotations. (Olson searches a coarse grid first and then a fine
# one; the library uses a Fourier transform.) ICP then starts again from the
# best candidates. The search does not depend on a basin of convergence, but it needs a grid that is
# fine enough. The next cell runs `match` without the search:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for degrees in (0, 30, 60, 120):
    start = compose(true_motion, [0, 0, np.radians(degrees)])
    end = match(second, first, start, search=0)
    print(f"initial error {degrees:3}°: {in_words(end.pose):>29}: {end.verdict}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# In these four tries the verdict identifies each failure; the mean length of the correspondences alone
# does not. If the scans from two poses are equal, no verdict can identify a failure: in a rectangular
# room a match with an error of 180° fits as well as the right match.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=9
# ## The covariance of a match
#
# A filter (lesson 06) or a pose graph (lesson 15) must weight a match, so it needs an **ICP
# covariance**. How does noise cause an error of the match? At the end of the loop the step (13.8) is
# zero. If correspondences and normals stay the same, noise $\varepsilon$ in the residuals shifts the
# minimum according to the same formula:
#
# $$\delta = -(J^{\mathsf T}J)^{-1} J^{\mathsf T} \varepsilon. \tag{13.9}$$
#
# As in lesson 03, the covariance of the pose is the expected value of $\delta\,\delta^{\mathsf T}$. Let the noise of the residuals
# be independent, with the variance $\sigma^2$ for each. Then the expected value of $\varepsilon\,\varepsilon^{\mathsf T}$ is $\sigma^2 I$, and
#
# $$P = (J^{\mathsf T}J)^{-1} J^{\mathsf T}\,\sigma^2 I\,J\,(J^{\mathsf T}J)^{-1} = \sigma^2 (J^{\mathsf T}J)^{-1} = \Lambda^{-1}.
# \tag{13.10}$$
#
# $\Lambda = J^{\mathsf T}J / \sigma^2$ is the **information matrix** of the match. More
# correspondences, walls in more directions and longer arms all increase the information.
#
# **Your turn.** Three points lie on the wall ahead, and one on a wall to the right. What is the covariance of
# the match, if $\sigma$ is 1 cm?

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask what is missing from (13.10) before you list it: every error that is not
# noise of the ranges. The covariance that is computed at a wrong local minimum looks as good as any
# other.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
J, sigma = np.array([[1, 0, -1], [1, 0, 0], [1, 0, 1], [0, 1, 2.0]]), 0.01  # [m]
P = ...  # (13.10)
gain = np.linalg.pinv(J)  # δ = −gain ε
compare(P, gain @ np.diag(np.full(4, sigma**2)) @ gain.T)

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# J, sigma = np.array([[1, 0, -1], [1, 0, 0], [1, 0, 1], [0, 1, 2.0]]), 0.01  # [m]
# P = sigma**2 * np.linalg.inv(J.T @ J)
# gain = np.linalg.pinv(J)  # δ = −gain ε
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### One match compared with a hundred
#
# A robot drives 30 cm along a corridor towards a cupboard, and turns to the left. We simulate its two
# scans a hundred times, each time with new noise, and match them. Does the covariance that `match`
# computes for *one* pair agree with the covariance of the hundred results? (This covariance is (13.10),
# refined as in the last *Deeper* section.)

# %% slideshow={"slide_type": "fragment"}
corridor = [[-60, -1, 60, -1], [-60, 1.2, 60, 1.2]]
cupboard = ring([(2, 0.2), (3, 0.2), (3, 1.19), (2, 1.19)])
here, there = np.array([[0, 0, -0.2], [0.3, 0, 0.2]])
moved_by = between(here, there)


def two_scans(walls, rng):
    """The scan after moving and the one before."""
    return [RPLIDAR_A2.scan(World(walls), pose, rng).points() for pose in (there, here)]


rng, furnished = np.random.default_rng(0), np.vstack([corridor, cupboard])
hundred = [match(*two_scans(furnished, rng), [0.2, 0, 0.3]) for _ in range(100)]

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
errors = np.array([m.pose for m in hundred]) - moved_by
ellipses = {"95 %, by the first match": 1e6 * hundred[0].covariance}
ellipses["95 %, of the hundred"] = 1e6 * np.cov(errors.T)
fig, ax = views.cloud(1000 * errors, ellipses, size=(8, 4.8))
ax.set(xlabel="error of x [mm]", ylabel="error of y [mm]")
ax.lines[0].set(markersize=7, alpha=1, label="errors of a hundred matches")
views.legend(ax)
spread = np.sqrt(np.linalg.eigvalsh(np.cov(errors[:, :2].T)))
longest = (
    np.array([np.linalg.eigvalsh(m.covariance[:2, :2])[1] for m in hundred]) ** 0.5 / spread[1]
)
ratio = spread[1] / spread[0]
views.show(
    fig,
    f"A hundred errors form a slanted cloud, {ratio:.1f} times as long as wide; the two ellipses have nearly the same shape.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The standard deviation along the corridor is {= ratio:.1f =} times that across it, since only the
# cupboard's short side determines the position along the corridor. The solid ellipse, from the
# covariance that a **single** match computes, nearly coincides with the dashed ellipse, which is
# computed from a hundred matches. (The first match is an example with good agreement: the ellipses of
# the hundred matches are {= longest.min():.1f =} to {= longest.max():.1f =} times as long as the dashed
# ellipse. The axes are those of the robot frame, which points 11° to the right of the corridor.)
#
# How closely do the covariances agree with the errors? With three unknowns the mean NEES (lesson 03)
# should be 3. For a hundred consistent matches the mean lies between 2.5 and 3.5 in 95 % of all cases.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
nees = [d @ np.linalg.solve(m.covariance, d) for d, m in zip(errors, hundred, strict=True)]
print(f"mean NEES of the hundred: {np.mean(nees):.1f}")
claimed = np.sqrt(np.mean([np.diag(m.covariance) for m in hundred], axis=0))
ratios = dict(zip(("x", "y", "θ"), claimed / np.sqrt(np.mean(errors**2, axis=0)), strict=True))
print("σ by the matches / σ of the errors:", {k: round(float(r), 2) for k, r in ratios.items()})

# %% [markdown] slideshow={"slide_type": "fragment"}
# The mean NEES is outside the interval. The components show the reason: the σ of the position is right
# or a little too large, and the σ of the heading is, in these hundred matches,
# {= 100 * (1 - ratios["θ"]):.0f =} % too small, so the match is slightly overconfident about its
# heading. A filter can tolerate such a difference, but not a factor of ten. An ICP covariance does not
# include errors from other causes, such as walls that are not straight, a robot that moves during a
# scan, and a wrong local minimum.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Degenerate directions: the corridor
#
# Now we remove the cupboard. Two straight walls remain, each 120 m long. The robot moves by 30 cm, but
# odometry measures 0 cm in one test and 60 cm in another.

# %% slideshow={"slide_type": "fragment"}
ask(
    "13-corridor",
    "The scans show only two straight walls. Odometry has an error of 30 cm along the walls. **What should a good matcher return?**",
    {
        "the true 30 cm: its noise is only millimetres": "no beam contains information about the position along the walls: scans at "
        "both poses fit equally well.",
        "an error: this match failed": "the walls determine the position across the corridor and the heading, and this "
        "information should not be discarded.",
        "odometry along the walls, the match across them, and a warning": "the matcher corrects the components that the walls "
        "determine, keeps odometry for the other component, and warns the user of the match.",
    },
    right="odometry along the walls, the match across them, and a warning",
)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="13-corridor"
bare = two_scans(corridor, np.random.default_rng(0))
slid = [match(*bare, between(here, [x, 0, 0.1])) for x in (0.0, 0.6)]
for x, m in zip((0, 60), slid, strict=True):
    along, aside, _ = 100 * np.abs(compose(here, m.pose) - there)
    print(f"odometry {x:2} cm: error {along:.0f} cm along, {aside:.0f} cm across")
    print(f"                {m.verdict}")

# %% slideshow={"slide_type": "subslide"} answers="13-corridor" tags=["folded"]
shown = {
    f"odometry {x} cm": {
        "first scan": Points("map", bare[1]),
        "second scan, matched": Points("scan", transform(m.pose, bare[0])),
        "pose by the match": Poses("robot", [m.pose]),
        "true pose": Poses("truth", [moved_by]),
    }
    for x, m in zip((0, 60), slid, strict=True)
}
fig, (ax, _) = views.side_by_side(shown, size=(9, 4.2))
ax.set(xlim=(-3, 3), ylim=(-2.4, 2.4))
views.show(
    fig,
    "In both panels the two scans coincide on the same two walls; the matched pose is behind the true pose on the left, and "
    "ahead of it on the right.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="13-corridor"
# The scans fit equally well in both figures, and do not show which match is right. The matcher kept the
# initial guess along the walls, corrected the other components, and **reported the degenerate
# direction**.
#
# The matcher finds this direction from the information matrix. All normals point across the corridor,
# so one **eigenvalue** of $\Lambda$ is nearly zero, and its eigenvector, which points along the
# corridor, is the **degenerate direction**. (Only eigenvalues with the same unit can be compared. So
# the matcher first multiplies $\theta$ by the reach of the scan, which gives a length.) The next cell
# prints the smallest eigenvalue as a share of the largest:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="13-corridor"
for name, m in {"with the cupboard": hundred[0], "bare": slid[0]}.items():
    seen = m.observability
    share = seen.eigenvalues[0] / seen.eigenvalues[-1]
    print(f"{name:>17}: {share:.4f}, {seen.in_words() or 'all is fixed'}")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="13-corridor"
# In the bare corridor the share is not exactly zero, because noisy normals add spurious information
# along the walls. The matcher computes the noise of the normals, and sets its threshold accordingly.
# Information about the position along the walls must come from another
# source, such as odometry or a door farther along the corridor.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* In a round room the heading is degenerate. Let the class build a round room with
# `World` and print the verdict of `match`. Plain ICP gives no warning in the bare corridor: it
# converges to an arbitrary position along the corridor.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Real data: a building
#
# So far all scans were simulated. A real robot drove through the Intel Research Lab for
# {= intel_maps.stored().minutes:.0f =} minutes. Its {= intel_maps.stored().readings =} scans cover
# 180° ahead. We matched each scan with the previous scan (**scan-to-scan matching**), once by plain ICP
# (`icp-plain`), and once by the estimator `icp`, which uses point-to-line residuals, gates, a robust
# kernel, and odometry as a prior. The map and the errors are stored with the course;
# `slamlab data get --lesson 13` fetches the log.
#
# The true poses are unknown. But Kümmerle and others published **relations**: the pose of one scan relative
# to that of another, checked by hand. The next cell prints the mean errors over the relations between
# our scans.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask why plain ICP may fail here, although it was good enough in the polygon: the
# scanner covers 180° only. Let the class find a wall that appears twice; it leads to lesson 15.

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
intel = intel_maps.stored()
fig, _ = views.side_by_side(
    {"Intel Research Lab, estimator icp": {"scans": Points("map", intel.points["icp"])}},
    size=(7.5, 5),
)
views.show(
    fig,
    f"A floor plan {np.ptp(intel.points['icp'], axis=0).max():.0f} m across, with rooms on both sides of a corridor that forms a "
    "loop; some walls appear twice.",
)
for name in ("odometry", "icp-plain", "icp"):
    print(
        f"{name:>9}: {intel.off[name]:.2f} m and {np.degrees(intel.turned[name]):4.1f}° on average"
    )

# %% [markdown] slideshow={"slide_type": "fragment"}
# On this run plain ICP is no better than odometry, and its headings are worse. The result in the
# polygon suggests the reason: with a field of view of 180°, the new part of the scan after each turn
# causes an error of the match. The error of `icp` is {= intel.off["odometry"] / intel.off["icp"]:.0f =}
# times smaller than that of odometry. (The two methods differ in several parts, so the comparison, from
# one run of one robot, does not show which part helps most.)
#
# The matches give a floor plan. But where the robot returns to a place, walls appear twice:
# scan-to-scan matching does not compare the scan with the earlier scans of that place.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Literature
#
# P. J. Besl and N. D. McKay, "A method for registration of 3-D shapes", *IEEE Trans. Pattern Analysis and Machine
# Intelligence* 14(2), 1992: ICP, and the proof of its convergence.
#
# Y. Chen and G. Medioni, "Object modelling by registration of multiple range images", *Image and Vision Computing* 10(3),
# 1992: residuals across the surface.
#
# K. S. Arun, T. S. Huang and S. D. Blostein, "Least-squares fitting of two 3-D point sets", *IEEE Trans. Pattern
# Analysis and Machine Intelligence* 9(5), 1987, and S. Umeyama, the same journal 13(4), 1991: the rotation by the SVD.
#
# D. Chetverikov, D. Svirko, D. Stepanov and P. Krsek, "The trimmed iterative closest point algorithm", *ICPR* 2002.
#
# E. Olson, "Real-time correlative scan matching", *ICRA* 2009.
#
# A. Censi, "An accurate closed-form estimate of ICP's covariance", *ICRA* 2007.
#
# F. Pomerleau, F. Colas, R. Siegwart and S. Magnenat, "Comparing ICP variants on real-world data sets", *Autonomous Robots* 34,
# 2013.
#
# **Read next:** A. Censi, "An ICP variant using a point-to-line metric", *ICRA* 2008.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## What you can do now
#
# You can align two point clouds with and without known correspondences, choose a stopping rule, make
# ICP robust for scans that overlap only in part, compute Gauss–Newton steps of point-to-line ICP, and
# compute the covariance and the degenerate directions of a match.
#
# **What comes next:** every match has a small error, and over many matches the errors accumulate like those of odometry, only more slowly.
# [Lesson 14](14_devices_and_live_slam.ipynb) runs ICP on a live robot;
# [lesson 15](15_pose_graph_slam.ipynb) closes the loop.
#
# **Exercise:** [13 · Scan matching: ICP](../exercises/ex13_scan_matching.ipynb). You write ICP
# with and without a robust kernel, combine odometry and walls in one step, and match two scans that overlap by half.
#
# The sections below this one are optional.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: rigid alignment by an SVD
#
# In space a rotation has three angles, and a single arctangent does not give them. The following method
# works in any dimension. It uses the correspondences only through one small matrix, their
# cross-covariance (times their number),
#
# $$M = \sum_i a_i'\, b_i'^{\mathsf T}, \qquad \sum_i b_i'^{\mathsf T}\,\mathrm{Rot}\, a_i' = \operatorname{tr}(\mathrm{Rot}\, M),
# \tag{13.11}$$
#
# and this trace is the parenthesis in (13.3). So we need the rotation for which this trace is largest. The
# **singular value decomposition** writes $M$ as $U D V^{\mathsf T}$, with
# $D = \operatorname{diag}(D_1 \ge D_2 \ge 0)$. $U$ and $V$ are *orthogonal*:
# their columns are orthonormal, so each of them is a rotation or a reflection. (The three letters have this meaning in this section
# only.)

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Only needed for 3-D, or if the class knows the SVD from another course. Let the
# class guess how often the reflection wins; most say never.

# %% [markdown] slideshow={"slide_type": "subslide"}
# Let $Z = V^{\mathsf T}\, \mathrm{Rot}\, U$, so that $\mathrm{Rot} = V Z U^{\mathsf T}$. A product of orthogonal matrices is
# orthogonal, so $Z$ is too. The trace of a product does not change when the last factor is moved to the
# front:
#
# $$\operatorname{tr}(\mathrm{Rot}\, M) = \operatorname{tr}(V Z U^{\mathsf T}\, U D V^{\mathsf T}) = \operatorname{tr}(Z D) =
# \sum_k Z_{kk} D_k. \tag{13.12}$$
#
# No entry of an orthogonal matrix exceeds 1. So the sum is at most $\sum_k D_k$, and $Z = I$ reaches this bound: $V U^{\mathsf T}$
# is the best **orthogonal** matrix. But it need not be a rotation. Because $\det \mathrm{Rot} = 1$,
# $\det Z = \det(V)\det(U) = \det(V U^{\mathsf T})$. If this determinant is −1, then $Z = I$ is not
# allowed: $Z$ must be a reflection. What is the trace in the plane if $Z$ is a rotation by $\varphi$,
# and if $Z$ is a reflection followed by such a rotation?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
phi = sp.symbols("varphi", real=True)
D_1, D_2 = sp.symbols("D_1 D_2", nonnegative=True)
Z_turn = Rot.subs(theta, phi)
for Z in (Z_turn, Z_turn * sp.diag(1, -1)):
    print(sp.factor((Z * sp.diag(D_1, D_2)).trace()))

# %% [markdown] slideshow={"slide_type": "subslide"}
# Both traces are greatest at $\varphi = 0$. For $\det(V U^{\mathsf T}) = 1$ the best $Z$ is the
# identity, with the trace $D_1 + D_2$. For $\det(V U^{\mathsf T}) = -1$ the best $Z$ is
# $\operatorname{diag}(1, -1)$, with the trace $D_1 - D_2$: the trace decreases least if the −1 is at
# the smallest singular value. In both cases
#
# $$\mathrm{Rot} = V \begin{bmatrix} 1 & 0\\ 0 & \det(V U^{\mathsf T})\end{bmatrix} U^{\mathsf T}. \tag{13.13}$$
#
# (If the determinant is −1 and $D_1 = D_2$, the trace is 0 for every angle, so all rotations are
# equally good.)

# %% slideshow={"slide_type": "subslide"}
ask(
    "13-mirror",
    "A robot is in front of **one straight wall**, and scans it twice without moving. Only the noise differs. **How "
    "often is $V U^{\\mathsf T}$ a reflection?**",
    {
        "never: a scan does not contain mirrored objects": "across the wall the scans contain only noise, and noise does not "
        "distinguish one side of the wall from the other.",
        "in about half of the cases": "if most points in front of the wall in the first scan lie behind it in the second, "
        "the reflection fits better. The probability of this case is about one half.",
        "only if all points lie exactly on a line": "then both fit equally well. With noise, one of them fits better, "
        "and this may be the reflection.",
    },
    right="in about half of the cases",
)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="13-mirror"
# 1000 pairs of scans of one wall: how often is the best matrix a reflection?
rng, along = np.random.default_rng(7), np.linspace(-1.0, 1.0, 15)


def scan_of_wall():
    return np.column_stack([along, 1.0 + 0.01 * rng.standard_normal(15)])


pairs_of_scans = [(scan_of_wall(), scan_of_wall()) for _ in range(1000)]
crossed = [(p - p.mean(axis=0)).T @ (q - q.mean(axis=0)) for p, q in pairs_of_scans]
mirrors = np.linalg.det(crossed) < 0  # det M has the sign of det V Uᵀ
print(f"{mirrors.sum()} of {len(mirrors)} are reflections")

# %% [markdown] slideshow={"slide_type": "subslide"} answers="13-mirror"
# What is the effect of a reflection? We use one of these pairs of scans. The best reflection is the
# best rotation of a source that was mirrored first. A chest of drawers stands at the wall on the left,
# and we apply both fits to the chest and to the robot.

# %% slideshow={"slide_type": "subslide"} tags=["folded", "nbval-check-output"] answers="13-mirror"
old, new = pairs_of_scans[np.flatnonzero(mirrors)[0]]
things = np.vstack([ring([(-0.15, 0), (0.15, 0), (0, 0.35)]), box((-0.7, 0.6), (0.4, 0.25))])
fig, ax = views.axes(None, size=(8, 4.6))
views.draw(ax, Points("wall", np.vstack([old, new])), markersize=6)
for name, flip in {"naive": [1, -1], "corrected": [1, 1]}.items():
    fitted = rigid_fit(old * flip, new)
    ends = transform(fitted, things.reshape(-1, 2) * flip).reshape(-1, 4)
    rms = 1000 * np.sqrt(np.mean(np.sum((transform(fitted, old * flip) - new) ** 2, axis=1)))
    words = "reflection" if flip[1] < 0 else "rotation"
    views.draw(ax, Segments(name, ends), label=f"{words}: RMS {rms:.2f} mm")
for name, place in {"robot": (0.2, 0.1), "chest": (-0.45, 0.7)}.items():
    ax.text(*place, name, va="center")
views.legend_below(fig)
views.show(fig, "The reflection puts robot and chest behind the wall, the rotation in front of it.")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="13-mirror"
# The reflection fits the wall a little better, but puts the mirrored robot and chest *behind* the wall.
# The rotation fits nearly as well, and keeps robot and chest in front of the wall. A robot often scans
# one long wall, so the determinant matters. `rigid_fit` computes (13.13). Does (13.13) minimise (13.1),
# as (13.4) does?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# is any other rotation better than that of `rigid_fit`, in 1000 random clouds?
worse = 0
for p, q in rng.standard_normal((1000, 2, 8, 2)):
    p_c, q_c = p - p.mean(axis=0), q - q.mean(axis=0)
    angle = rigid_fit(p, q)[2] + np.array([0, *np.linspace(0.01, 2 * np.pi - 0.01, 40)])
    costs = [np.sum((transform([0, 0, each], p_c) - q_c) ** 2) for each in angle]
    worse += min(costs[1:]) < costs[0]
print(f"in {worse} of 1000 random clouds another angle has a smaller cost")

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: the limits of the stopping rule
#
# By (13.5) the sum of *squares* decreases until the end. The stopping rule uses the *mean length*,
# which may fall, reach a minimum and rise again. Near its minimum the mean length hardly changes. Did
# the rule stop any of our 60 runs too early?

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask for a rule that cannot stop too early: stop when no correspondence changes.
# Ask for its price.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# where does the rule stop the 60 runs?
early = []
for states in runs:
    k = first_stop(states, RULES["change below 0.001 mm"])
    early.append(error_of(states[k].pose, states[-1].pose)[0] if k else 0.0)
early = np.array(early)
print(f"stopped more than 1 mm before the end: {np.sum(early > 1)} of {len(runs)} runs")
print(f"at most {early.max():.0f} mm before it")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The rule stopped {= np.sum(early > 1) =} of {= len(runs) =} runs from these bad guesses too early. A
# loop that continues until no correspondence changes any more ends at a local minimum by (13.5).

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: a more accurate covariance
#
# (13.10) assumes that all residuals are independent and equally noisy. This assumption is not true: the
# range of a far point has more noise than that of a near point, and a target point contributes to the
# normals of all its neighbours. Censi's covariance takes these effects into account. Let $\gamma$ be
# the gradient of the cost at its minimum, and $z$ the measured ranges of both scans. An error of $z$
# shifts the minimum by $-\Gamma^{-1}\, \partial\gamma/\partial z$ times this error. So
#
# $$P = \Gamma^{-1}\, \frac{\partial \gamma}{\partial z}\, \operatorname{cov}(z)\, \frac{\partial \gamma}{\partial z}^{\mathsf T} \Gamma^{-1},
# \qquad \Gamma = \frac{\partial \gamma}{\partial x}, \tag{13.14}$$
#
# where $\Gamma$ is the derivative of $\gamma$ with respect to the pose $x$ (the Hessian of the cost).
# With equal, independent noise in the residuals, (13.14) is the same as (13.10).
# `match(...).covariance` returns (13.14).

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The formula is the implicit function theorem; a class that knows it needs only
# one line. Compare with (13.10) by asking which two assumptions are dropped.
