# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 16 · Your own SLAM: benchmarks and evaluation
#
# **You will be able to** evaluate your own SLAM with the standard metrics of the field for its
# trajectory, its map and its covariance; compare two versions in the same worlds; determine by an
# ablation which part helps; and distinguish real progress from luck.
#
# **60 minutes. Before:** lesson [03](03_kalman_filter.ipynb) for NEES, lesson
# [13](13_scan_matching.ipynb) for matching, lesson [15](15_pose_graph_slam.ipynb) for loop closing.
#
# *Key:* to improve a SLAM, measure its errors, and measure them in more than one run.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* This lesson is about evaluation, and the project begins after it. Show "Absolute
# and relative trajectory errors" and "The best of many" in full: these two sections have the largest
# effect on the project. The questions on the two heading errors, on the map full of points, and on
# fifty versions are suitable for a poll. `slamlab contest` runs the contest, which docs/contest.md
# describes.

# %% slideshow={"slide_type": "skip"} tags=["folded"]
from dataclasses import replace

import numpy as np
from scipy.optimize import brentq
from scipy.spatial import cKDTree
from scipy.stats import chi2, ttest_1samp, ttest_ind, ttest_rel

from classroom.checks import ask, compare
from classroom.project.baselines import ROBOT, Baseline
from classroom.project.estimate_errors import OFF_WALL, ON_WALL, aligned, map_score, relative_errors
from classroom.project.estimator_runs import run_estimator
from classroom.project.point_scale import NEES_BAND, inconsistency_penalty
from classroom.project.scores import prepare
from classroom.project.world_generation import generate_world
from classroom.project.world_parameters import WORLD_FAMILIES, WorldFamily
from slamlab import views
from slamlab.estimators.graph_slam import GraphSlam
from slamlab.estimators.icp_slam import ODOMETRY_SIGMA, IcpSlam
from slamlab.evaluation import nees
from slamlab.geometry import between, compose, transform
from slamlab.layers import Poses, Segments
from slamlab.scanmatching import point_to_line

# %% [markdown] slideshow={"slide_type": "slide"} minutes=9
# ## Absolute and relative trajectory errors
#
# The project evaluates your SLAM by a **benchmark**: a fixed set of worlds, with rules and a score,
# which allows a comparison of all programs. The next cell generates such a world, a random furnished
# building, and a run through it. The world is simulated, so we know the **ground truth**: the true
# poses and the true walls. A **metric** is a number computed from an estimate and the ground truth.
# Which metric is suitable?
#
# The usual first choice is the **absolute trajectory error** (ATE) of lesson 12. A SLAM chooses its own
# frame, so its trajectory is first aligned with the true trajectory by the best rigid motion (*rigid
# alignment*, Horn, Umeyama). The ATE is the root mean square of the remaining distances. We test this
# metric on a SLAM with a single error: it measures *one* turn with an error of a few degrees, and all
# other motions correctly.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let the class defend the ATE first, then move `at` and read both numbers of the
# title aloud. The usual misconception is that a smaller number means a better SLAM.

# %% slideshow={"slide_type": "fragment"}
world = generate_world(WORLD_FAMILIES["plain"], np.random.default_rng([16, 0]), 30.0)
truth, metres = world.truth.poses, world.metres
walls = Segments("walls", world.floor.outline())
inner = np.flatnonzero((metres > 5) & (metres < metres[-1] - 5))  # at least 5 m from both ends
print(f"{len(world)} readings, {metres[-1]:.0f} m travelled, {len(walls.rows)} walls")

# %% slideshow={"slide_type": "fragment"}
ask(
    "16-once",
    "One SLAM measures one turn in the middle of its run with an error of 10°; another SLAM makes the same error 5 m "
    "before the end. All other motions are right. **Which of the two is the better SLAM?**",
    {
        "the second: its ATE is smaller": "its ATE is smaller because the error affects only a short part of the run. "
        "This is luck, and not the quality of the SLAM.",
        "the first: later measurements reduce its error": "no later measurement corrects the error: all later poses are "
        "rotated by the same 10°.",
        "neither": "both SLAMs made one error of the same size. A metric that differs between them depends on the time "
        "of the error.",
    },
    right="neither",
)


# %% slideshow={"slide_type": "subslide"} answers="16-once"
def with_heading_error(at, degrees):
    """The true poses, except for the error of one turn."""
    after = compose(truth[at + 1], [0.0, 0.0, np.radians(degrees)])  # right position, wrong heading
    later = compose(after, between(truth[at + 1], truth[at + 1 :]))  # by the true motions
    return np.concatenate([truth[: at + 1], later])


# %% slideshow={"slide_type": "fragment"} answers="16-once"
def ate_and_rpe(poses):
    """ATE after rigid alignment, and mean relative pose error over pieces of 5 m [m]."""
    away = transform(aligned(poses, truth), poses[:, :2]) - truth[:, :2]
    ate = np.sqrt(np.mean(np.sum(away**2, axis=1)))
    return ate, relative_errors(poses, truth, metres, 5.0).mean()


by_reading = np.array([ate_and_rpe(with_heading_error(at, 10)) for at in inner])


# %% slideshow={"slide_type": "fragment"} answers="16-once" tags=["folded"]
def one_heading_error(at, degrees):
    """The floor plan with the true trajectory and the aligned estimate, and both metrics."""
    poses = with_heading_error(at, degrees)
    ate, rpe = ate_and_rpe(poses)
    title = f"ATE {ate:.2f} m; relative pose error over 5 m {rpe:.3f} m"
    estimate = compose(aligned(poses, truth), poses)
    shown = [walls, Poses("truth", truth), Poses("corrected", estimate)]
    fig, _ = views.side_by_side({title: shown}, size=(9, 5))
    return fig


# %% slideshow={"slide_type": "fragment"} answers="16-once"
views.explore(
    one_heading_error,
    lambda at, degrees: (
        f"A floor plan with the true trajectory and an aligned estimate, which has a heading error of "
        f"{degrees}° from reading {at} on."
    ),
    at=(int(inner[0]), int(inner[-1]), int(inner[len(inner) // 2])),
    degrees=(-20, 20, 10),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="16-once"
# **Change `at`:** if the error of 10° occurs 5 m before the end instead of in the middle, the ATE
# decreases from {= by_reading[len(inner) // 2, 0]:.2f =} m to {= by_reading[-1, 0]:.2f =} m. The other
# number in the title, which we define next, stays between {= by_reading[:, 1].min():.3f =} m and
# {= by_reading[:, 1].max():.3f =} m for all positions of the error at least 5 m from both ends.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Relative pose error
#
# A heading error rotates all later poses. Therefore, the **relative pose error** (RPE) does not compare
# poses. It compares *relations* (Kümmerle): the pose $x_j$ relative to the pose $x_i$. The error of a
# relation is the estimated relation relative to the true relation; a star marks the truth:
#
# $$e_{ij} = \ominus\left(\ominus x^*_i \oplus x^*_j\right) \oplus \left(\ominus x_i \oplus x_j\right).
# \tag{16.1}$$
#
# The path between the two poses has a fixed length, such as 5 m. Our metric is the mean length of the
# position part of $e_{ij}$ over all such pairs (lesson 12 used the root mean square over pairs with a
# fixed number of scans between them). One heading error affects only the pairs that contain this error.
# Many benchmarks report the angle of $e_{ij}$ as well.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** Compute $e_{ij}$ for one pair of poses. `between(a, b)` is the pose
# $\ominus a \oplus b$. The check compares your result with the estimate $x_j$ relative to the pose that
# $x_i$ and the true relation predict.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
poses, i = with_heading_error(60, 10), 59
j = np.searchsorted(metres, metres[i] + 5.0 - 1e-9)  # 5 m farther
e_ij = ...  # (3,), from truth[i], truth[j], poses[i], poses[j]
compare(e_ij, [*between(compose(poses[i], between(truth[i], truth[j])), poses[j])])

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# poses, i = with_heading_error(60, 10), 59
# j = np.searchsorted(metres, metres[i] + 5.0 - 1e-9)  # 5 m farther
# e_ij = between(between(truth[i], truth[j]), between(poses[i], poses[j]))
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## Relative pose error over 1, 5 and 20 m
#
# Which distance between the two poses is suitable? Each distance shows a different property. We run the
# library's estimators in five smaller buildings with at most four rooms: odometry alone; `icp`, which
# matches each scan with the previous scan; and `graph`, with and without loop closing. Each estimator
# receives one reading after the other, as your SLAM will. A later section uses two more variants of
# `icp`.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask what each length measures before the figure: the noise of one match, the
# drift, the loop. Point at the curves of both versions of `graph`: they separate only at the right.


# %% slideshow={"slide_type": "fragment"} tags=["code"]
class Ablated(IcpSlam):
    """``icp``, with one setting of its matcher changed."""

    def __init__(self, **changed):
        super().__init__()
        self.settings = {"prior_sigmas": ODOMETRY_SIGMA} | changed

    def _scan_to_scan(self, points):
        return point_to_line(points, self._reference_scan, self._increment, **self.settings)


SMALL = WorldFamily("small", plans=(("crrc", "crc"),))  # four rooms at most
arenas = [prepare(generate_world(SMALL, np.random.default_rng([16, k]), 20.0)) for k in range(5)]
VARIANTS = {
    "icp, no distance gate": lambda: Baseline(Ablated(gate=(50.0, 50.0))),
    "icp, no normal gate": lambda: Baseline(Ablated(normal_gate=np.pi)),
    "graph, no loops": lambda: Baseline(GraphSlam(ROBOT, loops=False)),
}
runs = [
    dict(arena.runs)
    | {name: run_estimator(make, arena.readings) for name, make in VARIANTS.items()}
    for arena in arenas
]

# %% slideshow={"slide_type": "fragment"}
ask(
    "16-lengths",
    "`graph` with and without loop closing: **over which length will their errors differ most?**",
    {
        "over 1 m": "over 1 m both versions do the same: they match a scan with recent scans. No loop lies within one "
        "metre.",
        "over 5 m": "a closed loop corrects each step a little, and 5 m contain only a few steps.",
        "over 20 m": "over a long distance the drift of many steps accumulates, and loop closing corrects this drift.",
    },
    right="over 20 m",
)


# %% slideshow={"slide_type": "subslide"} answers="16-lengths"
# mean relative pose error over a length, in each building
def errors_over(length, name):
    found = []
    for arena, own in zip(arenas, runs, strict=True):
        poses, true = own[name].trajectory, arena.world.truth.poses
        found.append(relative_errors(poses, true, arena.world.metres, length).mean())
    return np.array(found)


# %% slideshow={"slide_type": "fragment"} answers="16-lengths" tags=["folded"]
lengths = np.array([0.5, 1, 2, 5, 10, 20])
errors = {
    name: np.array([errors_over(length, name).mean() for length in lengths])
    for name in ("graph", "odometry", "icp", "graph, no loops")
}
labels = "length of the pieces [m]", "mean relative pose error [m]"
fig, ax = views.curves(lengths, errors, *labels, size=(9, 4.4))
ticks = [f"{length:g}" for length in lengths]
ax.set(xscale="log", yscale="log", xticks=lengths, xticklabels=ticks)
views.legend(ax, loc="upper left")
views.show(
    fig,
    f"Four curves over the length of the pieces: odometry rises to {errors['odometry'][-1]:.1f} m over "
    f"{lengths[-1]:g} m, icp to {errors['icp'][-1]:.3f} m, graph without loop closing to "
    f"{errors['graph, no loops'][-1]:.3f} m, graph to {errors['graph'][-1]:.3f} m.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="16-lengths"
# The errors of the two versions of `graph` differ by
# {= 1000 * abs(errors["graph, no loops"][1] - errors["graph"][1]):.1f =} mm over 1 m, and by
# {= 1000 * (errors["graph, no loops"][-1] - errors["graph"][-1]):.0f =} mm over 20 m. The error over a
# short distance shows the noise of a match; the error over a long distance shows drift and the effect
# of loop closures. The project uses 1, 5 and 20 m, with equal weight. A difficult run is difficult for
# every program. So the score uses the *factor* by which your errors are smaller than those of odometry
# in the same run (its logarithm, averaged over the pairs; 5 mm are added to both errors).
#
# These runs are only {= min(a.world.metres[-1] for a in arenas):.0f =} to
# {= max(a.world.metres[-1] for a in arenas):.0f =} m long, so their pieces of 20 m overlap almost
# completely. The errors of such pieces are strongly correlated. Therefore, one building counts as one
# sample.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## Map metrics: recall and precision
#
# A map is a set of points. A map can have two faults: observed walls are missing, or points lie far
# from all walls. The **recall**, the share of the observed walls with a point within 5 cm, measures the
# first fault. The **precision**, here the share of the points within 15 cm of a wall, measures the
# second fault. The map score combines both metrics:
#
# $$\text{score} = \max\left(0,\; \text{recall} - (1 - \text{precision})\right). \tag{16.2}$$
#
# The score uses samples of the walls every 10 cm, and counts at most one point in each cell of 5 cm, so
# copies of a point have no effect.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Offer the class to cheat: which map has recall 1 without a measurement? After
# the answer, let them design a better metric, and cheat again. The *Your turn* cell can be left out.

# %% slideshow={"slide_type": "fragment"}
ask(
    "16-map",
    "A student submits a map with a point in **every** cell of 5 cm of the building. About 70 of 100 "
    "cells of this building are more than 15 cm away from all walls. **What is the score of the map?**",
    {
        "1: each wall has a point": "the recall is 1, but wrong points reduce the score.",
        "about 0.3": "the recall is 1, the precision about 0.3, and 1 − (1 − 0.3) = 0.3.",
        "0: the map contains no measurement": "the score does not depend on the origin of the points.",
    },
    right="about 0.3",
)


# %% slideshow={"slide_type": "subslide"} answers="16-map"
# recall and precision of a map, and four maps of the first building
def recall_and_precision(points):
    """Recall and precision of a map of the first building; the points lie in different cells."""
    recall = np.isfinite(cKDTree(points).query(seen, distance_upper_bound=ON_WALL)[0]).mean()
    return recall, np.isfinite(
        cKDTree(all_walls).query(points, distance_upper_bound=OFF_WALL)[0]
    ).mean()


seen, all_walls = arenas[0].walls
low, high = all_walls.min(axis=0), all_walls.max(axis=0)
grid = np.meshgrid(*(np.arange(a, b, 0.05) for a, b in zip(low, high, strict=True)))
everywhere = np.stack(grid, axis=-1).reshape(-1, 2)
graph = arenas[0].runs["graph"]
graph_map = transform(aligned(graph.trajectory, arenas[0].world.truth.poses), graph.points)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output", "nearly"] answers="16-map"
maps = {"the walls themselves": seen, "the walls, moved by 10 cm": seen + np.array([0.1, 0.0])}
maps |= {"a point everywhere": everywhere, "graph": graph_map}
print(f"{'':25} recall  precision  score")
for name, points in maps.items():
    recall, precision = recall_and_precision(points)
    print(f"{name:25} {recall:6.2f} {precision:10.2f} {map_score(points, seen, all_walls):6.2f}")

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** Compute the score of the map of `graph` from its recall and its precision.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
recall, precision = recall_and_precision(graph_map)
score = ...  # by (16.2); it is positive here
compare(score, map_score(graph_map, seen, all_walls), tolerance=0.02)

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# recall, precision = recall_and_precision(graph_map)
# score = recall - (1 - precision)
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### A misuse of the map score
#
# In the project the map contributes a fifth of the points, and its mark is limited to that of the
# trajectory. Before the evaluation, the map is moved by the rigid motion that aligns the *trajectory*
# with the true trajectory, because the choice of the frame should have no effect. How many points does
# the trajectory of `graph` get in the first building with different maps?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output", "nearly"]
# points of the same trajectory with three maps
back = between(aligned(graph.trajectory, arenas[0].world.truth.poses), np.zeros(3))
for name, points in {
    "no map": np.empty((0, 2)),
    "a point everywhere": transform(back, everywhere),
}.items():
    print(f"{name:20} {arenas[0].judge(replace(graph, points=points)).points:5.1f} points of 100")
print(f"{'its own map':20} {arenas[0].judge(graph).points:5.1f} points of 100")

# %% [markdown] slideshow={"slide_type": "fragment"}
# So a map full of points gets a few points here, but far fewer than a measured map. For every metric,
# ask this question: which methods give a high score without a good estimate?

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## Is the reported covariance consistent?
#
# A robot that drives through a door needs the uncertainty of its pose. Your SLAM may report a
# covariance $P$ for each pose, directly after the reading. The NEES of lesson 03 tests this covariance.
# For the error $e$ of the pose,
#
# $$\text{NEES} = e^\top P^{-1} e. \tag{16.3}$$
#
# The error and the covariance must be in the same frame. The project uses the frame of your SLAM: the
# true trajectory is moved so that its first pose is your first pose, and $e = x - x^*$ contains the
# differences in $x$, $y$ and $\theta$ along the axes of this frame, with the angle wrapped. The mean
# NEES is 3 if $e$ has mean zero and the covariance $P$, because a pose has three components.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Students answer 6, because half sounds like twice. In the figure, compare the
# distances from 1 on both sides: overconfidence costs points sooner than caution. Stress that a run
# is about one sample.

# %% slideshow={"slide_type": "fragment"}
ask(
    "16-half",
    "Your errors have mean zero and the covariance $P$. You report standard deviations that are **half** as "
    "large. **What is your mean NEES?**",
    right=12,
    tolerance=0.5,
    reason="half the σ gives a quarter of the variance. The inverse is four times as large, and 4 · 3 = 12.",
    wrong={
        6: "half the variance would double the NEES, but half the σ gives a quarter of the variance.",
        1.5: "a smaller covariance is *over*confident, and makes the NEES larger.",
        3: "this is the mean for a consistent covariance.",
    },
)


# %% slideshow={"slide_type": "subslide"} answers="16-half"
def share_that_loses(ratio):
    """The share of runs that lose points if the reported σ is ``ratio`` times the true σ."""
    low, high = NEES_BAND  # the NEES of a run is χ² with 3 degrees of freedom, over ratio²
    return 1 - chi2.cdf(high * ratio**2, 3) + chi2.cdf(low * ratio**2, 3)


# %% slideshow={"slide_type": "fragment"} answers="16-half" tags=["folded"]
def reported(ratio):
    """Points lost, at the expected NEES, by a reported σ of ``ratio`` times the true one."""
    ratios = np.geomspace(0.05, 20, 200)
    costs = {"at the expected NEES": [inconsistency_penalty(3 / s**2) for s in ratios]}
    fig, ax = views.curves(ratios, costs, "reported σ / true σ [1]", "points lost", size=(9, 4))
    lost = inconsistency_penalty(3 / ratio**2)
    ax.plot(ratio, lost, "o", color=views.COLOURS["robot"], markersize=11)
    share = f"{100 * share_that_loses(ratio):.0f} % of single runs lose points"
    ax.set(xscale="log", title=f"expected NEES {3 / ratio**2:.3g}: {lost:.1f} points; {share}")
    return fig


# %% slideshow={"slide_type": "fragment"} answers="16-half"
views.explore(
    reported,
    lambda ratio: (
        f"Points lost over the ratio of reported and true σ: no loss between {np.sqrt(3 / NEES_BAND[1]):.1f} "
        f"and {np.sqrt(3 / NEES_BAND[0]):.1f}, and an increasing loss on both sides; a dot at {ratio:g}."
    ),
    ratio=(0.1, 10.0, 0.5),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="16-half"
# A run loses no points if its NEES is inside the 95 % interval of one sample of χ² with three degrees
# of freedom, from {= NEES_BAND[0]:.2f =} to {= NEES_BAND[1]:.1f =}. A run counts as one sample, because
# the errors of neighbouring poses are correlated. The curve shows the expected NEES, and the NEES of
# single runs varies. If the errors are Gaussian and a run is one sample,
# {= 100 * share_that_loses(1):.0f =} % of the runs lose points with the true σ. With a σ that is
# {= np.sqrt(NEES_BAND[1] / 3):.1f =} times too small (overconfident), where the curve begins to rise,
# {= 100 * share_that_loses(np.sqrt(3 / NEES_BAND[1])):.0f =} % lose points. With a σ that is
# {= np.sqrt(3 / NEES_BAND[0]):.1f =} times too large (conservative),
# {= 100 * share_that_loses(np.sqrt(3 / NEES_BAND[0])):.0f =} % lose points. If you report no
# covariance, you lose no points. With a covariance near zero, you lose 20 points, the maximum.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Sources of the covariance
#
# - With odometry alone, $P$ grows with each step, as in lesson 04.
# - A match measures the *step*, not the pose: the new covariance is the sum of the covariances of the
#   previous pose and of the match, each transformed by its Jacobian of $\oplus$ (lesson 04).
# - Neighbouring points of a scan have correlated errors. A hundred points with the same error contain
#   as much information as one point.
# - After a loop closure, the covariance of the pose follows from those of the old pose and of the
#   match.
#
# If you have a formula for the covariance, compare it with your errors in practice worlds, and scale it
# so that the mean NEES is 3. This is a legitimate method, called **calibration**.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** The cell contains simulated errors of 1000 poses, and a covariance `P` that is too
# small. Find the factor for `P` that makes the mean NEES 3. The check compares your result with a
# numerical search.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
P = np.diag([0.05, 0.05, 0.01]) ** 2
simulated = np.random.default_rng(3).normal(0, [0.1, 0.08, 0.025], (1000, 3))
factor = ...  # from nees(simulated, P)
compare(factor, brentq(lambda c: nees(simulated, c * P).mean() - 3, 0.01, 100), tolerance=1e-4)

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# P = np.diag([0.05, 0.05, 0.01]) ** 2
# simulated = np.random.default_rng(3).normal(0, [0.1, 0.08, 0.025], (1000, 3))
# factor = nees(simulated, P).mean() / 3
# ```
#
# One factor corrects the mean, but not the three components: here their σ need different factors.
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=9
# ## Paired comparison of two versions in the same worlds
#
# You have changed your SLAM. Is the new version better? The next cell prints the errors of `graph` over
# 20 m in five buildings, with and without loop closing. The buildings differ more than the versions:
# some buildings are easy for both versions, and other buildings are hard for both.


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output", "nearly"]
NAMES = "odometry", "icp", *VARIANTS, "graph"
over_20 = {name: errors_over(20.0, name) for name in NAMES}
for name in ("graph, no loops", "graph"):
    print(f"{name:>15}:", "  ".join(f"{error:.3f}" for error in over_20[name]), "m")

# %% slideshow={"slide_type": "fragment"}
ask(
    "16-paired",
    "The means of both versions have wide confidence intervals, and the intervals overlap. **What follows?**",
    {
        "the versions cannot be distinguished": "this would follow if the versions had run in different buildings. Here "
        "most of the variation is that of the buildings, and it is common to both versions.",
        "nothing yet: compute the differences in each building": "the variation common to both versions cancels in the "
        "difference.",
        "the version with the better mean is better": "five buildings are few: a mean alone does not show the effect of chance.",
    },
    right="nothing yet: compute the differences in each building",
)

# %% slideshow={"slide_type": "subslide"} answers="16-paired" tags=["code"]
without, with_loops = np.log(over_20["graph, no loops"]), np.log(over_20["graph"])
tests = {
    "no loops [m]": ttest_1samp(without, 0),
    "graph [m]": ttest_1samp(with_loops, 0),
    "ratio, unpaired": ttest_ind(without, with_loops, equal_var=False),
    "ratio, paired": ttest_rel(without, with_loops),
}
intervals = {name: np.exp(test.confidence_interval()) for name, test in tests.items()}
for name, (low, high) in intervals.items():
    print(f"{name:>15}: from {low:.3f} to {high:.3f}")

# %% slideshow={"slide_type": "subslide"} answers="16-paired" tags=["folded"]
number = np.arange(1, len(arenas) + 1)
pair = {name: over_20[name] for name in ("graph", "graph, no loops")}
fig, ax = views.chart("building", "relative pose error over 20 m [m]", size=(9, 4))
ax.vlines(number, *pair.values(), color=views.COLOURS["limit"])
for (name, each), meaning, mark in zip(pair.items(), ("corrected", "naive"), "os", strict=True):
    ax.plot(number, each, mark, color=views.COLOURS[meaning], markersize=9, label=name)
ax.set(ylim=(0, 1.35 * max(over_20["graph, no loops"])), xticks=number)
views.legend(ax, loc="upper left", ncols=2)
views.show(
    fig,
    f"Errors in five buildings: without loop closing {over_20['graph, no loops'].min():.3f} to "
    f"{over_20['graph, no loops'].max():.3f} m, with loop closing {over_20['graph'].min():.3f} to {over_20['graph'].max():.3f} m, "
    "which is smaller in each building.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="16-paired"
# Without loop closing, the error is larger in every building. The cell computes 95 % confidence
# intervals of means of *logarithms*, because errors differ by factors, and converts them back to
# factors. The intervals of the two (geometric) means overlap. The interval of the ratio of the errors
# is {= intervals["ratio, unpaired"][0]:.1f =} to {= intervals["ratio, unpaired"][1]:.1f =} if we treat
# the two lists as samples of different buildings, and {= intervals["ratio, paired"][0]:.1f =} to
# {= intervals["ratio, paired"][1]:.1f =} if we use the differences in *the same* building. This is a
# **paired comparison**. Both versions also received the same readings, with the same noise: *common
# random numbers*.

# %% [markdown] slideshow={"slide_type": "subslide"} answers="16-paired"
# These are **t intervals**: they assume normally distributed logarithms, and they account for a standard
# deviation that is estimated from only five numbers. The **bootstrap** needs no distribution: it draws
# many samples from the sample, with replacement. How often do both intervals contain the true mean?

# %% slideshow={"slide_type": "fragment"} answers="16-paired" tags=["nbval-check-output", "nearly"]
# how often do t and bootstrap intervals contain the true mean?
rng = np.random.default_rng(0)
for size in (5, 30):
    samples = rng.standard_normal((4000, size))  # the true mean is 0
    shares = rng.multinomial(size, np.full(size, 1 / size), 1000) / size  # of each number
    ends = {
        "t": ttest_1samp(samples, 0, axis=1).confidence_interval(),
        "bootstrap": np.quantile(samples @ shares.T, [0.025, 0.975], axis=1),
    }
    for name, (low, high) in ends.items():
        share = np.mean((low < 0) & (high > 0))
        print(f"{size:2} worlds, {name:>9}: {100 * share:.0f} %")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="16-paired"
# With five buildings, the intervals of this (percentile) bootstrap are too narrow. Use it for larger
# samples: a contest compares students by a bootstrap of 35 worlds.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Write the two lists of five errors on the board, without the lines between the
# pairs, and ask which version is better. Then draw the lines. Five buildings are few: a two-sided sign
# test with five of five gives p = 1/16, so this test can never reach 0.05 here.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** The classical paired test is the **paired t-test**. Its statistic $t$ is the mean of
# the differences divided by its standard error, which is the standard deviation of the differences
# (`ddof=1`) divided by √n. The test assumes independent, normally distributed differences. Compute $t$
# for the logarithms.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
d = without - with_loops
t = ...  # from d
compare(t, ttest_rel(without, with_loops).statistic)

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# d = without - with_loops
# t = d.mean() / (d.std(ddof=1) / np.sqrt(len(d)))
# ```
#
# The paired test gives p = {= tests["ratio, paired"].pvalue:.3f =}. An unpaired t-test (Welch) gives p =
# {= tests["ratio, unpaired"].pvalue:.2f =} for the same ten numbers.
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Ablation
#
# A SLAM has many parts. Which of these parts reduce the error? An **ablation** removes **one** part,
# keeps all other parts, and runs in the same worlds. A comparison of the three systems `odometry`,
# `icp` and `graph` is *no* ablation, because they differ in many parts. But each of our three variants
# lacks one part. The **distance gate** of `icp` rejects correspondences whose points are too far apart;
# its **normal gate** rejects correspondences whose walls have different directions.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask which rows of the table differ in one part only. The usual, wrong answer is
# `icp` and `graph`.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output", "nearly"]
# errors of all variants, and the effect of each missing part
print(f"{'':>22} {'1 m':>7} {'5 m':>7} {'20 m':>7}   map")
for name in NAMES:
    found = [a.judge(own[name]).measures for a, own in zip(arenas, runs, strict=True)]
    row = " ".join(f"{error:7.3f}" for error in np.mean([m.errors for m in found], axis=0))
    print(f"{name:>22} {row} {np.mean([m.map for m in found]):5.2f}")
for name in VARIANTS:
    test = ttest_rel(np.log(over_20[name]), np.log(over_20[name.split(",")[0]]))
    low, high = np.exp(test.confidence_interval())
    print(f"{name}: error over 20 m times {low:.2f} to {high:.2f}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Without the distance gate, the error of `icp` over 20 m is
# {= np.mean(over_20["icp, no distance gate"]):.1f =} m, not far below the
# {= np.mean(over_20["odometry"]):.1f =} m of odometry: these buildings have doors, and points that
# appear in only one of the two scans must not get correspondences. Without loop closing, the error of
# `graph` over 20 m is {= low:.1f =} to {= high:.1f =} times as large (95 % interval), and hardly larger over
# 1 m. (`graph` without loops also lacks relocalisation, but no robot is kidnapped in these worlds.) We
# observe no effect of the normal gate here: its interval contains 1.
#
# A part without an effect still needs maintenance, so you may want to remove this part. But five
# buildings without people and without lost scans are a small sample. Remove a part only if it also has
# no effect in the other families of worlds. Choose the worlds and the metric for this decision *before*
# you see the results.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## The best of many: selection bias and generalisation
#
# Suppose that you try many versions that are all equally good. Their scores still differ by chance,
# because the worlds are random. You choose the version with the best score, and report this score.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* A demonstration without a computer: everybody tosses a coin six times, and the
# best "predictor" explains the method. If time is short, leave out the correlated scores.

# %% slideshow={"slide_type": "fragment"}
ask(
    "16-best",
    "Fifty versions are equally good. Their scores vary independently by chance, with a standard deviation of 3 "
    "points. The largest of fifty independent standard normal numbers is 2.25 on average. **By how many points does "
    "the best score exceed the true score on average?**",
    {
        "by 0 points: chance cancels": "chance cancels in the mean of all fifty scores, but the chosen score is the "
        "largest of them.",
        "by about 3 points": "this is the standard deviation of a single score. The largest of fifty scores is "
        "farther away from the mean.",
        "by about 7 points": "2.25 standard deviations of 3 points are 6.75 points.",
    },
    right="by about 7 points",
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Correlated scores
#
# The scores of versions that run in the *same* worlds are correlated. In our five buildings, the
# logarithms of the errors of `graph` over 20 m with and without loops have the sample correlation
# {= np.corrcoef(without, with_loops)[0, 1]:.2f =}. If the scores have the standard deviation $\sigma$
# and all pairs of scores have the same correlation $\varrho \ge 0$, we can write each score as
#
# $$s_k = \sigma \left(\sqrt{\varrho}\; c + \sqrt{1 - \varrho}\; \varepsilon_k\right), \tag{16.4}$$
#
# with a common part $c$ and an individual part $\varepsilon_k$, both standard normal. The common part
# is the same for all versions, so only the individual parts determine the best version.


# %% slideshow={"slide_type": "fragment"}
# the bias of the best score, in a simulation
def luck_of_best(versions, worlds, correlation, students=1000, spread=15.0):
    """The bias of the best score among equally good versions, for each student [points].

    spread : standard deviation of a version's points between worlds"""
    rng, sigma = np.random.default_rng(1), spread / np.sqrt(worlds)
    common, own = rng.standard_normal((students, 1)), rng.standard_normal((students, versions))
    scores = sigma * (np.sqrt(correlation) * common + np.sqrt(1 - correlation) * own)
    return scores.max(axis=1)


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
def best_of(versions, worlds, correlation):
    """Histogram of the bias of the best score over the students."""
    best = luck_of_best(versions, worlds, correlation)
    fig, ax = views.chart("bias of the best score [points]", "students", size=(9, 4))
    ax.hist(best, np.arange(-15, 45, 1), color=views.COLOURS["corrected"])
    title = f"best of {versions}, {worlds} worlds, ϱ = {correlation:g}: mean bias {best.mean():.1f} points"
    ax.set(title=title, ylim=(0, 420))
    return fig


# %% slideshow={"slide_type": "fragment"}
views.explore(
    best_of,
    lambda versions, worlds, correlation: (
        f"Histogram over the students of the bias of the best score among {versions} equally good versions "
        f"in {worlds} worlds, {luck_of_best(versions, worlds, correlation).mean():.1f} points on average."
    ),
    versions=(1, 100, 50),
    worlds=(1, 100, 25),
    correlation=(0.0, 1.0, 0.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Here the points of a version have σ = 15 in one world, so the score over 25 worlds has σ = 3. The
# score of a single version has no bias, but the best of fifty independent scores has a bias of 7
# points. With few worlds the bias is far larger, and with correlated scores it is smaller. This effect
# is called **selection bias** (also *winner's curse*, a problem of *multiple comparisons*).

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** How large is the selection bias for the best of fifty versions over 25 worlds, if their
# scores have the correlation 0.8? Use (16.4) and the value 2.25 from the question. The check compares
# your result with the simulated bias.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
bias = ...  # [points]
compare(bias, luck_of_best(50, 25, 0.8, students=4000).mean(), tolerance=0.06)

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# bias = 3 * np.sqrt(1 - 0.8) * 2.25
# ```
#
# The common part has mean zero. If all versions run in the same worlds, the comparison is fair, and the
# bias is smaller.
# </details>

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Validation worlds and test worlds
#
# The **generalisation** of a program is its performance in worlds that were not used to choose or to
# tune the program. **Overfitting** means tuning a program to the peculiarities of certain worlds: the
# score in these worlds is high, but the generalisation is poor. The remedy is to measure the score in
# worlds that were not used for any choice.
#
# - **Validation set:** use some practice worlds, for example `seed=1`, for all your choices.
# - **Test set** (*hold-out*): measure the score once, in other worlds, and change nothing afterwards.
# - A contest draws its test worlds from random bits that nobody knows beforehand. A hash of these bits
#   is published first, so the organiser cannot change the bits later (*commit and reveal*).
# - On a benchmark that is open for weeks, a student who submits fifty versions and uses the best score
#   causes selection bias again. The **Ladder** shows a new score only if it exceeds the best score so
#   far by more than a fixed step. Otherwise it repeats the best score so far.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Recommended steps
#
# 1. **Run the template** and look at the figure. Examine the errors of odometry before you correct
#    them.
# 2. **Match each scan with previous scans**, with odometry as the initial guess; reject correspondences
#    whose points are far apart. In our table `icp`, which matches each scan with the previous scan,
#    gives the largest improvement.
# 3. **Store keyframes**, about one per metre, and match with them. If you match each scan with the
#    previous scan only, the noise of all matches accumulates.
# 4. **Reject weak matches.** In a bare corridor a match can have a large error along the walls; after
#    lost scans its initial guess may be too inaccurate. In both cases, use odometry for this step.
# 5. **Close loops** with a pose graph, and return its poses in `trajectory()`.
# 6. **Report a covariance** at the end, when your errors no longer change.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let the class order the steps before they are shown. For the project, insist on
# the first one: most time is lost with corrections of errors that nobody has looked at.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Typical faults
#
# | fault | symptom | remedy |
# | --- | --- | --- |
# | false loop closure | the whole map is suddenly distorted | verify twice, use a robust kernel (lesson 15) |
# | walking people | blurred walls, points in free space | reject correspondences that do not fit |
# | ranges 1 % too long | the map is 1 % too large; errors at all lengths | compare with the distances from odometry |
# | kidnapped robot | two maps on top of each other | match the scan with the whole map |
# | time limit exceeded | the last worlds get no points | reduce the number of points, and match with fewer points |
#
# Find the *first* time at which the error grows: most later errors are consequences of this first
# error.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The kidnapped robot
#
# In the worlds of the family `kidnapped` the robot is carried to another place. Odometry does not
# measure this jump, but the scan changes: match the new scan with recent scans, and compute the share
# of its points that then lie near a wall. A small share indicates a jump, but people and lost scans
# also reduce the share. Plot the share over a run with a jump and over a run without a jump before you
# choose a threshold.
#
# After a jump, begin a second map. The task is then **relocalisation**, a *global localisation* in the
# first map: match a new keyframe with the first map, from many positions and headings. Accept a result
# only if the next keyframe agrees, and then combine the maps. `practise(MySlam, ["kidnapped"], seed=1)`
# in the exercise shows the gain.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## What you can do now
#
# You can evaluate a SLAM by its relative pose errors, its map and its covariance; compare two versions
# fairly; determine the effect of a part by an ablation; and avoid selection bias.
#
# **Literature.** R. Kümmerle and others, "On measuring the accuracy of SLAM algorithms", Autonomous Robots, 2009:
# relations. J. Sturm and others, "A benchmark for the evaluation of RGB-D SLAM systems", IROS 2012: ATE and RPE.
# A. Geiger, P. Lenz, R. Urtasun, "Are we ready for autonomous driving?", CVPR 2012: errors over lengths, and a
# hidden test set. B. Efron, "Bootstrap methods: another look at the jackknife", Annals of Statistics, 1979.
# A. Blum, M. Hardt, "The Ladder: a reliable leaderboard for machine learning competitions", ICML 2015. Read
# Kümmerle next.
#
# **What comes next:** [the project](../exercises/ex16_your_own_slam.ipynb). You start from a given
# class that runs, reach three milestones, and finally run your SLAM in unknown worlds.
