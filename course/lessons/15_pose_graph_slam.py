# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 15 · Pose-graph SLAM: closing the loop
#
# **You will be able to** write a SLAM that recognises known places. You will be able to derive and
# solve the normal equations of a pose graph, compute the information matrix of each edge, and decide
# which loop closures to accept.
#
# **98 minutes**, in two parts: the back end, a graph of poses (46), and the front end, which finds
# loops (52). **Before:** lesson [04](04_models_and_jacobians.ipynb) for $\oplus$ and Jacobians, lesson
# [13](13_scan_matching.ipynb) for scan matching.
#
# *Key:* odometry and scan matching only accumulate errors. A robot that returns to a known place can
# measure the accumulated error, and correct every step of its trajectory.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Derive part one at the board: the Jacobians, the frame of Λ, and the square by
# hand. You can teach part two alone to a class that knows least squares. If time is short, leave out
# the occupancy grid. The questions on the ends, on the sides of the square, on the error half way, and
# on five false loops are suitable for a poll.

# %% slideshow={"slide_type": "skip"} tags=["folded"]
from copy import deepcopy
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import sympy as sp

from classroom.checks import ask, compare
from course.studies import edge_covariance_frames, intel_maps, odometry_graphs
from course.studies import false_loop_closures as false_loops
from course.studies.odometry_graphs import least_squares_problem, odometry_graph, total_information
from slamlab import estimators, sources, views
from slamlab.estimators import loop_closure as loops
from slamlab.estimators.runner import run
from slamlab.geometry import between, compose, transform, wrap
from slamlab.gridmap import OccupancyGrid, map_server
from slamlab.gridmap.occupancy_grid import CLAMP, FREE, HIT, MISS, log_odds
from slamlab.layers import Ellipses, Points, Poses, Segments
from slamlab.posegraph import edge_error, edge_symbolic
from slamlab.posegraph.robust_kernels import DCS, Cauchy, Huber, Truncated
from slamlab.posegraph.edge_jacobians import J_i, J_j
from slamlab.posegraph.normal_equations import factorise
from slamlab.scanmatching import match, preprocess
from slamlab.simulation import RPLIDAR_A2
from slamlab.simulation.worlds import World


# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Drift and loop closure
#
# A robot drives once round a corridor of 42 m and ends where it began. The figure shows the map by
# odometry alone.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Before the vote, let the class state which two scans `icp` compares. Students
# who choose "0 cm" assume that it compares the last scan with the first.


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
def scan_layers(poses, clouds, name="corrected"):
    """A trajectory and the scans placed along it, by their legend entries."""
    xy = [transform(pose, cloud[::4]) for pose, cloud in zip(poses, clouds, strict=True)]
    words = {"naive": "odometry", "corrected": "estimate"}[name]
    points = Points(name, np.vstack(xy))
    return {f"scans, {words}": points, f"trajectory, {words}": Poses(name, poses)}


corridor = sources.open("sim:corridor", np.random.default_rng(0))
readings, truth = list(corridor), corridor.truth.poses
trajectories = {"odometry": run(corridor, estimators.DeadReckoning()).trajectory.poses}
gaps = {"odometry": 100 * np.hypot(*(trajectories["odometry"][-1] - truth[-1])[:2])}
some = slice(0, None, 4)
clouds = [reading.scan.points() for reading in readings[some]]
odometry_map = scan_layers(trajectories["odometry"][some], clouds, "naive")
fig, _ = views.side_by_side({"odometry alone": odometry_map}, size=(6, 4.2))
views.show(
    fig, f"The map of a corridor whose end is {gaps['odometry'] / 100:.1f} m away from its start."
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# According to odometry, the end of the corridor is {= gaps["odometry"] / 100:.1f =} m away from its
# start. Two estimators have smaller errors with the same simulated readings: `icp` matches each scan
# with the previous scan (lesson 13), and `graph` is the subject of this lesson.

# %% slideshow={"slide_type": "fragment"}
ask(
    "15-ends",
    "The robot is back at its start, and its last scan looks like its first. **How far from the start is the end "
    "that the scan matcher `icp` estimates?**",
    {
        "0 cm: the last scan looks like the first": "the two scans look alike, but `icp` does not compare them. It matches "
        "each scan only with the previous scan.",
        "some centimetres": "each match has a small error, and the errors of more than a hundred matches "
        "accumulate.",
        "some metres, as with odometry": "the error of each match is far smaller than that of odometry.",
    },
    right="some centimetres",
)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="15-ends"
results = {name: run(corridor, estimators.make(name, corridor)) for name in ("icp", "graph")}
for name, result in results.items():
    trajectories[name] = result.trajectory.poses
    gaps[name] = 100 * np.hypot(*(trajectories[name][-1] - truth[-1])[:2])
for name, gap in gaps.items():
    print(f"{name:>8}: the end is {gap:5.1f} cm away from the start")

# %% slideshow={"slide_type": "subslide"} answers="15-ends" tags=["folded"]
shown = {"graph": scan_layers(trajectories["graph"][some], clouds)}
fig, _ = views.side_by_side(shown, size=(6, 4.2))
views.show(
    fig, f"The map is a closed rectangle; its end is {gaps['graph']:.1f} cm away from its start."
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="15-ends"
# On this run the matcher's error at the end is {= gaps["odometry"] / gaps["icp"]:.0f =} times smaller than that of
# odometry. The matcher's end is still {= gaps["icp"]:.0f =} cm away from the start, and further laps
# would increase this error. With `graph` the distance is at most
# {= max(1, np.ceil(gaps["graph"])):.0f =} cm, because `graph` has recognised the place.
#
# Recognising a place (**place recognition**) and correcting the map accordingly is called **closing the loop**, or
# **loop closure**.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Pose graphs
#
# This method needs no landmarks. The unknowns are **all** poses $x_0, x_1, \dots, x_n$ of the robot. A
# **pose graph** has a node for each pose, and an **edge** for each measured motion $z$ between two
# poses: pose $j$ relative to pose $i$. An edge may come from odometry, from a match of two consecutive
# scans, or from a match with a scan recorded ten minutes earlier. The graph treats all edges in the
# same way.
#
# The odometry edges connect each pose with the next pose, and form a chain. A **loop** is an edge
# between two poses that are far apart in the chain. The graph contains only one pose for every few
# readings: a **keyframe**.
#
# A SLAM system with a pose graph has two halves. The **back end** (part one) computes the poses that fit all edges
# best. The **front end** (part two) computes edges from sensor data: it matches scans and finds loops.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Draw the graph of the corridor at the board: a long chain and one edge that
# closes it. Ask what the state of EKF-SLAM contains instead: only the last pose, and the landmarks.
# Stress that a loop is an edge like all others, and that a false loop is one, too.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The residual of an edge
#
# Pose $i$ and the measurement $z$ predict pose $j$ as $x_i \oplus z$. The **residual** $e$ (error) of
# the edge is pose $j$ *relative to this prediction*:
#
# $$e = \ominus (x_i \oplus z) \oplus x_j = \ominus z \oplus (\ominus x_i \oplus x_j). \tag{15.1}$$
#
# Let $p$ be the position of a pose. Then the components of the residual are
#
# $$e = \begin{bmatrix} \mathrm{Rot}(\theta_z)^{\mathsf T} \left( \mathrm{Rot}(\theta_i)^{\mathsf T} (p_j - p_i) -
# p_z \right) \\ \theta_j - \theta_i - \theta_z \end{bmatrix}. \tag{15.2}$$
#
# The last component is an **angle** and must be wrapped to the interval $(-\pi, \pi]$. Otherwise a full
# turn of the robot would cause a residual of 360°.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Jacobians of an edge
#
# The back end changes the poses until the residuals are small. For this purpose it needs the Jacobians
# $J_i = \partial e / \partial x_i$ and $J_j = \partial e / \partial x_j$.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Students who choose $y$ read $e$ in the world frame: let them name the axes of
# the predicted pose. If time is short, show only (15.3) and the cell that compares the Jacobians.

# %% slideshow={"slide_type": "fragment"}
ask(
    "15-push",
    "Pose $i$ and $z$ together predict a pose that faces **north**: $\\theta_i + \\theta_z = 90°$. Pose $j$ moves "
    "1 cm to the north. **How does $e$ change?**",
    {
        "its x grows by 1 cm": "e is expressed in the frame of the predicted pose, whose x axis points north.",
        "its y grows by 1 cm": "north is y in the world frame, but e is expressed in the frame of the predicted pose.",
        "x and y change, each by less than 1 cm": "this happens if neither axis of the predicted pose points north. "
        "Here the x axis points north.",
    },
    right="its x grows by 1 cm",
)


# %% slideshow={"slide_type": "subslide"} answers="15-push" tags=["folded"]
def draw_edge(turn_of_pose_i, shift_of_pose_j):
    x_i, z = np.array([0, 0, np.radians(30 + turn_of_pose_i)]), np.array([2.0, 0.3, np.pi / 3])
    x_j = compose(np.array([0, 0, np.pi / 6]), z) + np.array([0, shift_of_pose_j, 0])
    predicted, (x, y, turn) = compose(x_i, z), edge_error.error(x_i, x_j, z)
    title = f"e = ({x:.2f} m, {y:.2f} m, {np.degrees(turn):.0f}°)".replace("-", "−")
    layers = {"pose i": Poses("robot", [x_i]), "predicted pose j": Poses("predicted", [predicted])}
    layers |= {"z": Segments("before", [[*x_i[:2], *predicted[:2]]])}
    layers |= {"e": Segments("naive", [[*predicted[:2], *x_j[:2]]])}
    layers |= {"pose j": Poses("corrected", [x_j])}
    fig, (ax,) = views.side_by_side({title: layers}, size=(8, 4.4))
    ax.set(xlim=(-1, 4), ylim=(-0.5, 2.6), adjustable="box")
    return fig


views.explore(
    draw_edge,
    lambda turn_of_pose_i, shift_of_pose_j: (
        f"Pose i, rotated by {turn_of_pose_i:.0f}°, and the predicted pose j; pose j, shifted by "
        f"{shift_of_pose_j:.1f} m to the north; the line e connects the predicted pose j with pose j."
    ),
    turn_of_pose_i=(-30, 30, 0),
    shift_of_pose_j=(0.0, 0.6, 0.4),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="15-push"
# The predicted pose faces north here, so pose $j$ moves *ahead* of the prediction, along the $x$ axis
# of $e$. Now rotate pose $i$: the predicted pose rotates about pose $i$, and $e$ rotates and grows.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The two Jacobians
#
# - **Pose $j$ moves:** $e$ changes by the same motion, expressed in a frame with the heading
#   $\theta_i + \theta_z$. So the motion is rotated back by this angle.
# - **Both poses are shifted by the same vector:** $e$ does not change. So the first two columns of
#   $J_i$ are minus those of $J_j$.
# - **Pose $i$ rotates:** the predicted pose rotates about pose $i$. Only this column is new, and it
#   depends on the difference $p_j - p_i$.
#
# $$J_j = \begin{bmatrix} \mathrm{Rot}(\theta_i + \theta_z)^{\mathsf T} & 0 \\ 0 & 1 \end{bmatrix}, \qquad
# J_i = \begin{bmatrix} -\mathrm{Rot}(\theta_i + \theta_z)^{\mathsf T} & \text{swing} \\ 0 & -1 \end{bmatrix}
# \tag{15.3}$$
#
# In the exercise you derive the entry *swing*. The next cell compares the library's Jacobians at an
# arbitrary point with central differences of the residual, and with the Jacobians that sympy derives.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# the Jacobians of the library, differences of the residual, and sympy
at = [np.array([1.2, -0.7, 2.9]), np.array([-0.4, 1.9, -2.2]), np.array([1.1, 0.6, 0.8])]
symbols = [*edge_symbolic.x_i, *edge_symbolic.x_j, *edge_symbolic.z]
numbers = dict(zip(symbols, np.concatenate(at), strict=True))
h = 1e-6 * np.eye(9).reshape(9, 3, 3)
derivatives = [(edge_error.error(*(at + k)) - edge_error.error(*(at - k))) / 2e-6 for k in h]
for k, J in enumerate((J_i, J_j)):
    by_differences = np.transpose(derivatives[3 * k : 3 * k + 3])
    by_sympy = np.array(getattr(edge_symbolic, J.__name__).subs(numbers), dtype=float)
    error = [abs(J(*at) - other).max() for other in (by_differences, by_sympy)]
    print(f"{J.__name__}: {error[0]:.6f} from differences, {error[1]:.6f} from sympy")

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## The maximum a posteriori estimate
#
# Which poses are the best? Not all edges are equally accurate: a match has a σ of about a millimetre,
# and odometry has a σ of some centimetres. So let the residual of edge $k$ at the true poses be
# Gaussian with mean 0 and covariance $\Lambda_k^{-1}$. The inverse covariance $\Lambda_k$ is the
# **information matrix** of the edge. If the errors of the edges are independent, Bayes' rule gives the
# posterior
#
# $$\begin{aligned} p(x \mid z) &\propto p(x) \prod_k p(z_k \mid x) \propto p(x) \prod_k \exp \left(
# -\tfrac12\, e_k^{\mathsf T} \Lambda_k\, e_k \right), \\ -2 \log p(x \mid z) &= \text{const} -2\log p(x) +
# \chi^2(x), \qquad \chi^2(x) = \sum_k e_k^{\mathsf T} \Lambda_k\, e_k. \end{aligned} \tag{15.4}$$
#
# With a flat prior $p(x)$, the poses that minimise the **cost function** $\chi^2$ are the **maximum a
# posteriori** (MAP) estimate. This estimate is then equal to the **maximum likelihood** estimate. So
# the *best* poses solve a *least-squares* problem.
#
# Each edge contributes one **factor** to this product, which depends on the edge's two poses only. A graph of
# unknowns and factors is a **factor graph**; in a pose graph the unknowns are poses, and each factor
# connects two poses. At the true poses each edge contributes 3 to $\chi^2$ on average, because its
# residual has three components.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Gauss–Newton
#
# The residual $e$ contains sines and cosines of the headings, so it is not linear in the poses. The
# **Gauss–Newton** method linearises $e$ in each iteration. Let $J$ be the Jacobian of a residual with
# respect to all poses, so $e(x + \delta) \approx e + J\delta$. The cost is then quadratic in the step
# $\delta$, and half its gradient at $\delta = 0$ is $g$. We set the gradient with respect to $\delta$
# to zero:
#
# $$\begin{aligned} \chi^2(x + \delta) &\approx \sum (e + J\delta)^{\mathsf T} \Lambda\, (e + J\delta), \\
# 2 \sum J^{\mathsf T} \Lambda\, (e + J\delta) &= 0, \qquad \text{so} \\
# \Lambda_x\, \delta &= -g, \qquad \Lambda_x = \sum J^{\mathsf T} \Lambda\, J, \qquad g = \sum J^{\mathsf T}
# \Lambda\, e. \end{aligned} \tag{15.5}$$
#
# The equations $\Lambda_x\, \delta = -g$ are the **normal equations**. We solve them, add $\delta$ to
# the poses, and repeat the linearisation, until $\delta$ is small.

# %% [markdown] slideshow={"slide_type": "fragment"}
# $\Lambda_x$ is the information matrix of all poses, as $\Lambda$ is that of one residual: the
# information of all edges is *added*. If one pose is fixed, the inverse of $\Lambda_x$ is, to first
# order, the covariance of the other poses.
#
# (In the literature, and in the hints of the exercise, $\Lambda_x$ is called $H$ and $g$ is called $b$. In this
# course $H$ is the Jacobian of a measurement model.)

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask why (15.5) does not contain the second derivative of $e$. Gauss–Newton
# neglects the term with this derivative, because the term is proportional to $e$, which is small near
# the solution.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## The frame of the information matrix
#
# $\Lambda$ weights the residual $e$. A matcher or an odometry model gives the covariance $R$ of the
# *measurement* $z$. Is $\Lambda$ then simply $R^{-1}$?
#
# A robot stands in a corridor. The walls determine its position *across* the corridor to a fraction of
# a millimetre. *Along* the corridor, where only niches and corners contribute information, $\sigma$ is
# many times as large. The robot turns left by 90°, and we match the new scan with the old scan. The
# measurement $z$ is expressed in the frame of the *old* pose, whose x axis is parallel to the corridor.
# So the $x$ of $z$ has the large $\sigma$.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let a student stand in the aisle of the hall, point along it, and turn by 90°:
# the aisle stays, but its direction in the student's frame changes. In rooms with walls in several
# directions this mistake hardly shows, so it remains undetected in many programs.

# %% slideshow={"slide_type": "fragment"}
ask(
    "15-frame",
    "**Which component of $e$ has the large $\\sigma$** after this turn of 90°?",
    {
        "x, as in z": "e is not expressed in the frame of the old pose, but in the frame of the predicted pose, which is "
        "rotated by 90°.",
        "y": "in the frame of the predicted pose, the corridor is parallel to the y axis.",
        "neither: e is a difference, so the large σ cancels": "a difference contains the errors of both terms, so e "
        "contains the whole error of z.",
    },
    right="y",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="15-frame"
# Let $z^\star$ be the true motion, and $z = z^\star + \varepsilon$ with noise $\varepsilon$ of covariance $R$. At the true
# poses $\ominus x_i \oplus x_j = z^\star$. So by (15.2) the residual $e$ is the difference
# $z^\star - z = -\varepsilon$, rotated back by the measured $\theta_z$:
#
# $$e = -T^{\mathsf T} \varepsilon, \qquad T = \begin{bmatrix} \mathrm{Rot}(\theta_z) & 0 \\ 0 & 1 \end{bmatrix},
# \tag{15.6}$$
#
# $$\operatorname{cov}(e) = T^{\mathsf T} R\, T, \qquad \Lambda = \left(T^{\mathsf T} R\, T\right)^{-1} = T^{\mathsf T}
# R^{-1}\, T. \tag{15.7}$$
#
# (15.6) is exact, and so is $e^{\mathsf T} \Lambda\, e = \varepsilon^{\mathsf T} R^{-1} \varepsilon$: with this
# $\Lambda$ the cost of an edge equals that of its measurement's error. (Equation (15.7) is the
# covariance of $e$ only for small heading errors, because it treats the measured $\theta_z$ as known.)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="15-frame"
# Do scan matches agree with (15.7)? We match sixty pairs of simulated scans for each of four turn
# angles. The mean NEES (lesson 03) of these matches should be 3. One column uses $R^{-1}$ for
# $\Lambda$, and the other column uses (15.7).

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="15-frame"
matches = {turn: edge_covariance_frames.matches(corridor.world, turn) for turn in (0, 45, 90, 180)}
nees = {turn: each.nees() for turn, each in matches.items()}
print("turn   NEES by R⁻¹   by Tᵀ R⁻¹ T")
for turn, (wrong, right) in nees.items():
    print(f"{turn:3d}° {wrong:12.1f} {right:12.1f}")


# %% slideshow={"slide_type": "subslide"} answers="15-frame" tags=["folded"]
def residuals_and_ellipses(turn):
    each = matches[turn]
    covariances = {"95 % by R": ("naive", each.R), "95 % by (15.7)": ("corrected", each.of_e())}
    fig, (ax,) = views.panels([f"turned by {turn}°"], (8, 4.6))
    for label, (name, P) in covariances.items():
        ellipse = Ellipses(name, np.zeros((1, 2)), 1e6 * P.mean(axis=0)[None, :2, :2])
        views.draw(ax, ellipse, label=label, linewidth=2)
    views.draw(ax, Points("scan", 1e3 * each.e[:, :2]), label="residuals e", markersize=8)
    ax.set(
        xlabel="x of e [mm]", ylabel="y of e [mm]", xlim=(-10, 10), ylim=(-7, 7), adjustable="box"
    )
    views.legend_below(fig)
    return fig


views.explore(
    residuals_and_ellipses,
    lambda turn: (
        f"Residuals of {len(matches[turn].e)} matches after a turn of {turn}°, and two ellipses; the blue ellipse agrees with "
        "the residuals, but after a quarter turn the red ellipse is perpendicular to them."
    ),
    turn=[90, 0, 45, 180],
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="15-frame"
# The residuals and the blue ellipse rotate with the robot. The red ellipse, that of $R$, does not
# rotate. At 90° the red ellipse is narrowest in the direction in which the match is least accurate, and
# the NEES is {= nees[90][0] / 3:.0f =} times as large as it should be. With (15.7) the NEES lies
# between {= min(right for _, right in nees.values()):.1f =} and
# {= max(right for _, right in nees.values()):.1f =}, so these covariances are consistent, and slightly
# conservative.
#
# If you choose 180°, the two ellipses coincide. So a test on a straight road, there
# and back, cannot detect the mistake.
#
# From here on $\Lambda$ is the information matrix of $e$, as in the widely used programs GTSAM and g2o.
# The function `edge_error.information(z, R)` computes this matrix.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=10
# ## A pose graph of five poses
#
# A robot drives round a square: four times it drives 2 m ahead, and then turns 90° to the left. Its
# odometry measures 2.1 m and 84° each time. At the end a scan match shows that the robot is back at its
# start.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let the class fill in the pattern of the blocks at the board before the cell
# prints it. Before the question on the sides, draw a closed square with sides of 2.1 m. If time is
# short, leave out *Your turn* and the box of the algorithm.


# %% slideshow={"slide_type": "fragment"}
# four odometry edges, and a loop from the last pose to the first
def square(sigma_of_loop=0.02):
    def information(metres, degrees):  # x and y alike, so that (15.7) changes nothing
        return np.diag(1 / np.square([metres, metres, np.radians(degrees)]))

    graph, of_odometry = (
        odometry_graph([[2.1, 0, np.radians(84)]] * 4, corridor.robot),
        information(0.1, 5),
    )
    graph.edges = [edge._replace(information=of_odometry) for edge in graph.edges]
    graph.add_edge(4, 0, np.zeros(3), information(sigma_of_loop, 50 * sigma_of_loop))
    return graph


# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** Compute the cost of the loop, its term in the $\chi^2$ of (15.4), at the poses by
# odometry.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
start, loop = square().poses, square().edges[-1]
e, Lambda = edge_error.error(start[loop.i], start[loop.j], loop.measured), loop.information
cost_of_loop = ...  # from e and Lambda
compare(cost_of_loop, least_squares_problem(square()).errors(start)[1][-1])

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# start, loop = square().poses, square().edges[-1]
# e, Lambda = edge_error.error(start[loop.i], start[loop.j], loop.measured), loop.information
# cost_of_loop = e @ Lambda @ e
# ```
#
# The cost of the four odometry edges is still zero, because the poses were computed from these edges.
#
# </details>

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The information matrix is sparse
#
# $\Lambda_x$ has a $3 \times 3$ block for each pair of the five poses. By (15.5) an edge contributes
# only to the blocks of its own two poses. Which blocks are not zero?


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# which 3 × 3 blocks of an information matrix are not zero?
def print_blocks(matrix):
    count, size = len(matrix) // 3, abs(matrix).max()
    for row in matrix.reshape(count, 3, count, 3):
        print(" ".join("■" if abs(row[:, k]).max() > 1e-9 * size else "·" for k in range(count)))


information = total_information(square())
print_blocks(information)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The blocks beside the diagonal come from odometry, and the two blocks in the corners come from the
# loop. For a thousand poses, $\Lambda_x$ has a million blocks, and nearly all of them are zero:
# $\Lambda_x$ is **sparse**. A covariance is full (lesson 07: all errors are correlated), but its
# inverse has non-zero blocks only for edges and on the diagonal. A **sparse Cholesky** factorisation
# uses this structure to solve the normal equations (see *Deeper*). Therefore, pose graphs are suitable
# for whole buildings.

# %% slideshow={"slide_type": "subslide"}
ask(
    "15-gauge",
    "$\\Lambda_x$ of the square has 15 rows and 15 eigenvalues. An eigenvalue of zero belongs to a motion of all poses "
    "that changes no residual. **How many are zero?**",
    right=3,
    tolerance=0.5,
    unit="eigenvalues",
    reason="edges measure only relative poses, so a shift to the east, a shift to the north, or a rotation of the whole trajectory changes no residual.",
    wrong={
        0: "then an edge would have to measure a pose in the world frame, but edges measure only relative poses.",
        1: "the rotation of the whole trajectory is one such motion. Which shifts also change no residual?",
        2: "the two shifts of the whole trajectory are such motions. Which other motion changes no residual?",
    },
)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="15-gauge"
# eigenvalues of zero, and three motions that change no residual
values, start = np.linalg.eigvalsh(information), square().poses
print("zero eigenvalues:", np.count_nonzero(values < 1e-9 * values[-1]), "of", len(values))
turned = np.column_stack([-start[:, 1], start[:, 0], np.ones(5)]).ravel()
motions = {"east": np.tile([1, 0, 0], 5), "north": np.tile([0, 1, 0], 5), "turned": turned}
for name, motion in motions.items():
    unchanged = abs(information @ motion).max() < 1e-9 * values[-1]
    print(f"all poses {name}: cost {'unchanged' if unchanged else 'changed'}")

# %% [markdown] slideshow={"slide_type": "subslide"} answers="15-gauge"
# Three eigenvalues are zero: no residual changes if the whole trajectory is shifted east, shifted
# north, or rotated. So $\Lambda_x$ is **singular**. This property is called **gauge freedom**. An
# ordinary solver fails, or returns correct relative poses at an arbitrary position and heading.
#
# The remedy is to delete the rows and columns of one pose, here pose 0, which then does not change. (An
# EKF that starts with $P = 0$ fixes the first pose, too. Another remedy is a prior factor on pose 0.)

# %% slideshow={"slide_type": "subslide"}
ask(
    "15-sides",
    "Odometry measured each side as 2.1 m instead of 2 m, and each turn as 84° instead of 90°. **What does the loop correct?**",
    {
        "sides and turns": "a square with sides of 2.1 m is as closed as one with sides of 2 m, so no edge contradicts the sides.",
        "the turns, and not the sides": "with four turns of 84° the end is not at the start, which contradicts the loop. "
        "Sides of 2.1 m contradict no edge.",
        "only the last pose, which the loop measures": "the poses of least cost distribute the correction over all "
        "steps.",
    },
    right="the turns, and not the sides",
)


# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="15-sides"
best = square()
optimum = best.optimise()
sides = between(best.poses[:-1], best.poses[1:])
for side in sides:
    print(f"{np.hypot(*side[:2]):.2f} m, {np.degrees(side[2]):.1f}°")


# %% slideshow={"slide_type": "subslide"} answers="15-sides" tags=["folded"]
def optimised_square(iterations, sigma_of_loop):
    graph = square(sigma_of_loop)
    optimum = graph.optimise(max_iterations=iterations)
    shown = {}
    for title, name, poses in (
        ("odometry", "naive", start),
        (f"after {iterations} iterations: χ² = {optimum.chi2:.1f}", "corrected", graph.poses),
    ):
        loop = Segments("before", [[*poses[4, :2], *poses[0, :2]]])
        shown[title] = {"the loop's two poses": loop, title.split(":")[0]: Poses(name, poses)}
    return views.side_by_side(shown, size=(9, 4.4))[0]


views.explore(
    optimised_square,
    lambda iterations, sigma_of_loop: (
        f"Left: a square that is not closed. Right: the same square after {iterations} iterations, with a loop of σ = "
        f"{sigma_of_loop:.2f} m; a smaller σ gives a smaller gap."
    ),
    play="iterations",
    iterations=(0, 5, 4),
    sigma_of_loop=(0.02, 2.0, 0.02),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="15-sides"
# The loop is an edge between poses 4 and 0 only, but **every** other pose has changed: each turn has
# increased by 6°, a quarter of the missing 24°. We can check $\chi^2$ by hand:
# $4 \cdot (6°/5°)^2 = 5.8$, and the cost of the graph is {= optimum.chi2:.1f =}. A filter that stores
# only the last pose cannot correct earlier poses: the graph is a *smoother* (lesson 05).
#
# The sides are still 2.1 m. **A loop corrects only errors that contradict the loop.** Set the number of
# iterations to 0 and press ▶: two iterations come close to the final result. Then give the loop a
# larger σ: the loop no longer closes the gap.

# %% [markdown] slideshow={"slide_type": "slide"}
# > **Algorithm: Gauss–Newton on a pose graph** (Lu and Milios 1997; Grisetti et al. 2010, algorithm 1)
# >
# > **Input:** poses $x$, edges $(i, j, z, \Lambda)$, the fixed pose 0.
# >
# > 1. Residuals: $e = \ominus z \oplus (\ominus x_i \oplus x_j)$ for each edge, the angle wrapped.
# > 2. Cost: $\chi^2 = \sum e^{\mathsf T} \Lambda\, e$. (A robust edge: $\Lambda \leftarrow w \Lambda$, see part two.)
# > 3. Jacobians: $J_i$ and $J_j$ for each edge, by (15.3).
# > 4. Normal equations: $\Lambda_x = \sum J^{\mathsf T} \Lambda\, J$ and $g = \sum J^{\mathsf T} \Lambda\, e$, without the rows
# >    and columns of pose 0.
# > 5. Solve $\Lambda_x\, \delta = -g$ by a sparse Cholesky (or LU) factorisation.
# > 6. $x \leftarrow x + \delta$, with all headings wrapped.
# > 7. Repeat from 1 until $\delta^{\mathsf T} \Lambda_x\, \delta$ is below a tolerance.
# >
# > **Output:** the poses $x$ of least cost, and $\Lambda_x$; $\Lambda_x^{-1}$ is their covariance to first order.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# Gauss–Newton on the square, by the steps of the box
problem, poses = least_squares_problem(square(), fixed=[0]), square().poses
for iteration in range(8):
    e, chi2 = problem.errors(poses)  # steps 1 and 2
    print(f"iteration {iteration}: χ² = {chi2.sum():.2f}")
    Lambda_x, g = problem.linearise(poses, e, np.ones(len(e)))  # steps 3 and 4
    delta = factorise(Lambda_x).solve(-g)  # step 5
    poses = poses + problem.equations.to_poses(delta)  # step 6
    poses[:, 2] = wrap(poses[:, 2])
    if delta @ Lambda_x @ delta < 1e-6:  # step 7
        break

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## One loop closure
#
# We return to the corridor, with odometry edges and a single loop: we match the last scan with the
# first scan. Every second reading is a keyframe.

# %% slideshow={"slide_type": "fragment"}
keyframes = np.arange(0, len(readings), 2)
surfaces = [preprocess(readings[k].scan.points()) for k in keyframes]
dead_reckoning = trajectories["odometry"][keyframes]
steps, last = between(dead_reckoning[:-1], dead_reckoning[1:]), len(keyframes) - 1
chain = odometry_graph(steps, corridor.robot)
closing = match(surfaces[last], surfaces[0], between(chain.poses[0], chain.poses[last]))

# %% slideshow={"slide_type": "fragment"}
ask(
    "15-halfway",
    "The loop connects the last pose with the first. **What happens to the error *half way* round?**",
    {
        "nothing: the loop measures only the ends": "odometry edges connect every pose in between with both ends. If the "
        "last pose changes, these poses change, too.",
        "it decreases, but is still the largest": "the poses half way are farthest from both ends, which are now "
        "known.",
        "it decreases to nearly 0, as at the end": "the match measures the last pose. It constrains the poses half way only "
        "through the odometry edges in between.",
    },
    right="it decreases, but is still the largest",
)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="15-halfway"
# add the loop, optimise, and compare with the truth
closed, certain = deepcopy(chain), loops.match_information(closing)
closed.add_edge(0, last, closing.pose, certain)
optimum, errors = closed.optimise(), {}
for name, graph in {"odometry": chain, "with one loop": closed}.items():
    errors[name] = np.hypot(*between(truth[keyframes], graph.poses)[:, :2].T)
    print(
        f"{name:>13}: error {errors[name][-1]:.2f} m at the end, at most {errors[name].max():.2f} m"
    )
print(f"χ² = {optimum.chi2:.0f}, with 3 more residuals than unknowns")


# %% slideshow={"slide_type": "subslide"} answers="15-halfway" tags=["folded"]
def growing_map(pose, with_loop):
    """Odometry up to a pose, and the graph, which gets the loop at the last pose."""
    shown = {}
    graph = closed if with_loop and pose == last else chain
    for title, name, each in (("odometry", "naive", chain), ("graph", "corrected", graph)):
        P, poses = each.covariances()[: pose + 1 : 10, :2, :2], each.poses[: pose + 1]
        shown[f"{title}, pose {pose}"] = scan_layers(
            poses[::2], [seen.points for seen in surfaces[: pose + 1 : 2]], name
        ) | {"95 % ellipses": Ellipses("robot", poses[::10, :2], P)}
    fig, all_axes = views.side_by_side(shown, size=(8.6, 4.2))
    all_axes[0].set(xlim=(-6, 18), ylim=(-6, 14))
    return fig


views.explore(
    growing_map,
    lambda pose, with_loop: (
        f"Pose {pose} of {last}. By odometry the corridor is not closed, and the ellipses grow from step to step; with the "
        "loop the corridor is closed, and the ellipses are largest half way."
    ),
    play="pose",
    pose=(0, last, last),
    with_loop=True,
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="15-halfway"
# Set the pose to 0 and press ▶: for a hundred poses both maps have the same error. At the last pose the
# loop is added, and the error of the right map decreases suddenly.

# %% [markdown] slideshow={"slide_type": "subslide"} answers="15-halfway"
# One of {= len(closed.edges) =} edges reduces the largest error from {= errors["odometry"].max():.1f =}
# m to {= 100 * errors["with one loop"].max():.0f =} cm.
#
# Each ellipse shows a **marginal covariance**: the block of $\Lambda_x^{-1}$ that belongs to one pose.
# With the loop the ellipses are largest *half way*, and small at both ends. (The inverse of a block of
# $\Lambda_x$ is the covariance *given* all other poses, which is far too small.)
#
# The cost $\chi^2$ is {= optimum.chi2:.0f =}. With three more residual components than unknowns,
# $\chi^2$ exceeds 11.3 by chance in only one of a hundred cases. A likely reason is that this odometry
# has a systematic error, but its model $Q$ treats the errors of all steps as independent.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** `covariance` is the 12 × 12 covariance of poses 1 to 4 of the square. What is
# the marginal covariance of pose 4?

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
of_poses = total_information(best)[3:, 3:]  # of poses 1 to 4; pose 0 is fixed
covariance = np.linalg.inv(of_poses)
marginal = ...  # (3, 3), of pose 4
compare(marginal, best.covariances()[4])

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# of_poses = total_information(best)[3:, 3:]  # of poses 1 to 4; pose 0 is fixed
# covariance = np.linalg.inv(of_poses)
# marginal = covariance[-3:, -3:]
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Without the loop $\chi^2$ was zero: the edges of a chain cannot contradict each
# other, so $\chi^2$ does not show the error of the chain. A loop that agrees with the chain changes no
# pose, but it reduces the ellipses, because $J^{\mathsf T} \Lambda J$ does not contain $e$. This is a
# good place for the break.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Part two: loop-closure candidates and their verification
#
# In part one the loop was given. The front end must find loops, in three steps: **propose, verify,
# optimise**.
#
# *Propose:* an old keyframe is a **loop-closure candidate** if, according to the estimated poses, the
# robot may be near this keyframe. In our corridor the error of odometry at the end is
# {= errors["odometry"][-1]:.1f =} m, so a search within 1.5 m of the estimated pose does not find the
# start. (Other systems propose candidates by appearance: a *bag of words* of image features, or a *scan
# context*, finds similar places without any pose.)
#
# **Verification** of a candidate: match the new scan with the old scan, and judge the match as in
# lesson 13. How many points lie on old walls (the *overlap*)? Do any points or beams contradict the
# match? Do the walls determine all three components of the pose?
#
# We match three pairs of scans: from the end and the start of our corridor, from two poses 3 m apart in a bare
# corridor, and from two different corners of our corridor.

# %% slideshow={"slide_type": "fragment"}
# three pairs of scans
bare, rng = World([[-30, -1, 30, -1], [-30, 1, 30, 1]]), np.random.default_rng(1)
alley = [preprocess(RPLIDAR_A2.scan(bare, p, rng).points()) for p in ((0, 0, 0), (3, 0.1, 0.1))]
pairs = {
    "end and start": (surfaces[last], surfaces[0]),
    "bare corridor": (alley[1], alley[0]),
    "two corners": (surfaces[30], surfaces[5]),
}

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output", "nearly"]
found = {name: match(new, old) for name, (new, old) in pairs.items()}
for name, m in found.items():
    fixed, verified = m.observability.fixed.sum(), loops.is_verified(m, *pairs[name])
    print(
        f"{name}: overlap {100 * m.fit.overlap:.0f} %, fixed {fixed} of 3, verified {verified}; {m.verdict}"
    )

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
shown = {
    name: {"old scan": Points("map", old.points)}
    | {"new scan": Points("scan", transform(found[name].pose, new.points))}
    for name, (new, old) in pairs.items()
}
fig, _ = views.side_by_side(shown, size=(9.5, 3.6), shared=False)
views.show(
    fig,
    f"{len(pairs)} pairs of scans; in each pair the new scan is aligned with the old scan, and all pairs appear to fit.",
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# All three matches appear to fit, but only the first is a true loop. The walls of the bare corridor do
# not determine the position along it: the two scans may come from poses 3 m apart, or from the same
# pose. Such a match must not close a loop.
#
# The third match is a false loop. {= 100 - 100 * found["two corners"].fit.overlap:.0f =} % of its
# points lie on no old wall, but a true loop between two more distant poses may have the same share. A
# threshold on the overlap cannot separate the two cases. This problem is called **perceptual
# aliasing**: different places look alike.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let the class suggest further tests for the corners, such as a submap of nine
# scans (as in the library), colours, or room numbers. All these tests help, but no test is a proof.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## Gating a loop closure
#
# The graph predicts pose $j$ relative to pose $i$, with a covariance. If a candidate differs from this
# prediction by far more than drift explains, we reject it. With the candidate's residual $v = e$ at the
# current poses, and its Jacobian $J$ with respect to all poses,
#
# $$d^2 = v^{\mathsf T} S^{-1} v, \qquad S = J \Lambda_x^{-1} J^{\mathsf T} + \Lambda^{-1}. \tag{15.8}$$
#
# The quantity $d^2$ is the same as in the gate of lesson 08: the **squared Mahalanobis distance** of an
# innovation, also called the normalised innovation squared. (15.8) assumes that the errors of the match
# are independent of those of the graph's edges.
#
# **Your turn.** Compute $d^2$ for the loop of the last section. Its first pose is fixed, so only the last
# pose contributes to $S$.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Most students look only at the column of wrong candidates. Ask what each
# rejected right candidate costs, and why *near* rejects six of the eight right ones: their keyframes
# are farther apart than the search radius, although the matches are right.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
ends = chain.poses[0], chain.poses[last], closing.pose
v, J, R = edge_error.error(*ends), J_j(*ends), np.linalg.inv(certain)
P = chain.covariances()[last]  # marginal covariance of the last pose
S = ...
d2 = ...
compare(d2, chain.squared_mahalanobis(0, last, closing.pose, certain))

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# ends = chain.poses[0], chain.poses[last], closing.pose
# v, J, R = edge_error.error(*ends), J_j(*ends), np.linalg.inv(certain)
# P = chain.covariances()[last]  # marginal covariance of the last pose
# S = J @ P @ J.T + R
# d2 = v @ np.linalg.solve(S, v)
# ```
#
# The distance $d^2$ is only {= chain.squared_mahalanobis(0, last, closing.pose, certain):.0f =},
# although the error of odometry was {= errors["odometry"][-1]:.1f =} m. After the loop closure $\chi^2$
# was {= optimum.chi2:.0f =}: (15.8) predicts this value with one linear step, so the two values differ
# a little.
#
# </details>

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Each test alone, and combinations
#
# The next test is harder than a real run: we match pairs of keyframes from all parts of the corridor,
# without an initial guess. *Near* means that the keyframe is within the search radius of a proposal,
# and *fits* that the matcher accepts the match. *Verified* requires a high overlap, three determined
# components, and no contradiction. *χ² gate* means that (15.8) is below 60. A match is false if its
# error exceeds 15 cm or 6°.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output", "nearly"]
# candidates that pass each test
slam = deepcopy(results["graph"].estimator)
slam.graph.edges = [edge for edge in slam.graph.edges if not edge.robust]  # without its loops
slam.graph.optimise()
wrong, gates = false_loops.verify_candidates(slam, false_loops.true_poses(slam, corridor))
gates = {"candidates": np.full(len(wrong), True)} | gates
gates["fits and χ² gate"] = gates["fits"] & gates["χ² gate"]
gates["all four"] = np.all(list(gates.values()), axis=0)
passed = {name: (np.sum(g & ~wrong), np.sum(g & wrong)) for name, g in gates.items()}
for name, (right, bad) in passed.items():
    print(f"{name:>16}: {right:3d} right, {bad:3d} wrong")

# %% [markdown] slideshow={"slide_type": "subslide"}
# The scans alone are not enough: of {= passed["candidates"][1] =} wrong candidates
# {= passed["fits"][1] =} *fit* at some pose, and {= passed["verified"][1] =} pass even the strict test.
# The χ² gate accepts {= passed["χ² gate"][0] =} right candidates and {= passed["χ² gate"][1] =} wrong
# one. The wrong candidate is a match with an error of more than a metre along a bare part of the
# corridor. Its own covariance in this direction is so large that $d^2$ is small. The scans show that
# this direction is degenerate.
#
# So two tests complement each other: *fits* and *χ² gate* together accept
# {= passed["fits and χ² gate"][0] =} of {= passed["candidates"][0] =} right candidates and
# {= passed["fits and χ² gate"][1] =} wrong candidates. All four tests together accept only
# {= passed["all four"][0] =} right candidates, as *near* alone does. **Every test can make two
# errors:** it can reject a right loop, and it can accept a false loop, which can ruin the map. (Eight
# right candidates of one run illustrate the principle, but are too few to estimate rates.)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## Perceptual aliasing: twin rooms
#
# Two rooms at one corridor, 7 m apart, have identical walls and furniture. To make the test harder,
# `graph` searches for loops within five times the usual distance. We run `graph` once with its gate,
# which rejects loops with a $d^2$ above 60, and once without the gate.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask before the run which measurement could distinguish the two rooms at all.
# Nothing in a scan can; only the path between the rooms does, and this is the information that the
# gate uses.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output", "nearly"]
# `graph` in the twin rooms, with a gate and without
twins = false_loops.drive_twin_rooms()
systems = {"gate at 60": twins.with_gate, "no gate": twins.without}
for name, slam in systems.items():
    rejected, bad = slam.counts["loops outside the gate"], twins.count_false(slam)
    error = twins.largest_error(slam.graph.poses, slam)
    print(f"{name}: {rejected} rejected, {bad} false edges, largest error {error:.2f} m")
trusted = false_loops.trust_all(twins.without.graph)
distortion = twins.largest_error(trusted.poses, twins.without)
print(f"no gate, every loop trusted: largest error {distortion:.1f} m")

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
of_trusted = [edge for edge in trusted.edges if abs(edge.i - edge.j) > 1]
shown = {}
for name, slam, graph, edges in (
    ("gate at 60", twins.with_gate, twins.with_gate.graph, None),
    ("no gate, every loop trusted", twins.without, trusted, of_trusted),
):
    loops = Segments("loop", false_loops.ends(graph, edges))
    shown[name] = scan_layers(graph.poses, false_loops.keyframe_points(slam)) | {"loops": loops}
fig, all_axes = views.side_by_side(shown, size=(9, 3.4))
all_axes[0].set(xlim=(-3, 16), ylim=(-2, 7))
views.show(
    fig,
    f"With the gate the map has two rooms at a corridor; without it, if every loop is trusted, the two rooms "
    f"coincide, with an error of {distortion:.1f} m.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The left map has two rooms, and no loop connects them. Without the gate, {= twins.count_false(twins.without) =}
# false loops become edges of the graph. If every loop is trusted, the two rooms and their furniture
# coincide (right map), and the corridor appears shorter than it is. The optimiser of `graph` does not trust
# every loop: it gives the false ones the weight zero, and its map is right even without the gate. The
# sections below derive how.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## The threshold of the gate
#
# A loop has three components, so with a correct model $d^2$ of a right loop is below 11.3 in 99 of 100
# cases. We use the {= np.sum(~twins.false) =} right loops of the first run, and
# {= np.sum(twins.false) =} false loops of the second run (those whose keyframes exist in both runs). The
# {= twins.with_gate.counts["loops outside the gate"] =} loops that the gate rejected in the first run are all false.
# For each of these loops we compute $d^2$ in a graph of **odometry alone**.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Move the second slider to 0.2 first, and let the class find a threshold for this
# model. The threshold and the covariance of the odometry cannot be chosen separately.

# %% slideshow={"slide_type": "fragment"}
ask(
    "15-width",
    "The gate is at 11.3, and one of the robot's wheels is always a little larger than the other. **How many of the right "
    "loops does the gate reject?**",
    {
        "about one in a hundred": "this would be the share if the odometry errors of different steps were independent, as "
        "the model Q assumes.",
        "many more than one in a hundred": "the error has the same sign in every step, so it grows faster than Q predicts. "
        "After a long path a right loop lies outside the gate.",
        "none: the graph predicts right loops": "a 99 % gate rejects one in a hundred right loops even with a correct model.",
    },
    right="many more than one in a hundred",
)


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output", "nearly"] answers="15-width"
# d² of all loops, for three standard deviations of odometry
def two_digits(d2):
    return views.grouped(int(float(f"{d2:.2g}")))  # further digits depend on the processor


by_scale = {scale: twins.squared_mahalanobis(scale) for scale in (0.2, 1, 3)}
print("σ of odometry ×   right ones up to   false ones from")
for scale, d2 in by_scale.items():
    most, least = d2[~twins.false].max(), d2[twins.false].min()
    print(f"{scale:15g} {two_digits(most):>18} {two_digits(least):>17}")
rejected = np.mean(by_scale[1][~twins.false] > 11.3)
print(f"rejected at 11.3: {100 * rejected:.1f} %")


# %% slideshow={"slide_type": "subslide"} answers="15-width" tags=["folded"]
from ipywidgets import SelectionSlider


def slider(name, options, first):
    named = {views.grouped(n): n for n in options}
    return SelectionSlider(options=named, value=first, description=name)


GATES = [1, 3, 11.3, 30, 60, 100, 300, 1000, 3000, 10_000, 30_000]


def gate_and_model(gate, scale):
    d2 = twins.squared_mahalanobis(scale)
    right, false = d2[~twins.false], d2[twins.false]
    rows = {"right": ("corrected", right), "false": ("naive", false)}
    title = f"{np.sum(right > gate)} of {len(right)} right loops rejected, {np.sum(false <= gate)} false ones accepted"
    return views.strips(
        rows, {"gate": gate}, (0.05, 1e5), "squared Mahalanobis distance d² [1]", title
    )[0]


views.explore(
    gate_and_model,
    lambda gate, scale: (
        f"Squared Mahalanobis distances of right and of false loops, two groups of dots; a gate at {gate:g}, the σ of "
        f"odometry multiplied by {scale:g}."
    ),
    gate=slider("gate", GATES, 11.3),
    scale=slider("σ of odometry ×", [0.1, 0.2, 0.3, 0.5, 1, 2, 3, 5], 1),
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="15-width"
# The share of right loops with a $d^2$ above 11.3 is {= 100 * rejected:.0f =} %. In 40 simulations with
# odometry errors drawn from $Q$ the share is {= 100 * twins.share_rejected_by_model(11.3):.0f =} % on average,
# so the systematic error is the likely cause. (The loops of one run depend on the same odometry errors, so
# they are not independent.) The largest $d^2$ of a right loop is {= two_digits(by_scale[1][~twins.false].max()) =},
# and the smallest $d^2$ of a false loop is {= two_digits(by_scale[1][twins.false].min()) =}. The threshold of the
# library's gate is 60, between these values.
#
# Now move the other slider: the $d^2$ of both groups change. **With an overconfident odometry model the
# gate rejects right loops**, and with a model that is too conservative it accepts false loops. A gate
# is only as reliable as the covariance that it uses.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## Robust kernels
#
# With a squared cost the gradient of an edge grows in proportion to its residual. So we give an edge
# that *may* be false a smaller cost: a **robust kernel** $\rho(\chi^2)$ of its
# $\chi^2 = e^{\mathsf T} \Lambda\, e$. (The minimiser is an **M-estimator**. It is the maximum likelihood
# estimate if $\rho$ is $-2 \log$ of the likelihood, up to a constant.) Up to a limit $\Phi$, the cost of *dynamic
# covariance scaling* (DCS) is that of least squares; beyond it, the cost levels off:
#
# $$\rho(\chi^2) = 3\Phi - \frac{4\Phi^2}{\Phi + \chi^2} \qquad (\chi^2 > \Phi). \tag{15.9}$$
#
# By the chain rule the gradient of $\rho(\chi^2)$ is $\rho'(\chi^2)$ times that of $\chi^2$. So the derivative $\rho'$ is
# the **weight** of the edge:
#
# $$w = \rho'(\chi^2) = \left( \frac{2\Phi}{\Phi + \chi^2} \right)^2 \qquad (\chi^2 > \Phi). \tag{15.10}$$
#
# In (15.5) the $\Lambda$ of a robust edge is replaced by $w\Lambda$, and $w$ is computed again in each iteration. This is
# **iteratively reweighted least squares**.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Students confuse the cost and the weight: the left panel shows the first, the
# right panel the second. As a picture for the weights, a squared cost is a spring, Huber's cost is a
# rope that pulls with a constant force, and a truncated cost is a spring that breaks. Show only DCS
# and truncated least squares if time is short.

# %% [markdown] slideshow={"slide_type": "subslide"}
# Other kernels are also widely used:
#
# | kernel | cost $\rho(\chi^2)$ | weight $\rho'(\chi^2)$ | largest cost |
# | --- | --- | --- | --- |
# | least squares | $\chi^2$ | $1$ | none |
# | **Huber** | $\chi^2$; beyond $\Phi$ $2\sqrt{\Phi\chi^2} - \Phi$ | $1$; beyond $\Phi$ $\sqrt{\Phi/\chi^2}$ | none |
# | **Cauchy** | $\Phi \log(1 + \chi^2/\Phi)$ | $\Phi / (\Phi + \chi^2)$ | none |
# | **Geman–McClure** | $\Phi\chi^2 / (\Phi + \chi^2)$ | the next cell | $\Phi$ |
# | DCS | $\chi^2$; beyond $\Phi$ (15.9) | $1$; beyond $\Phi$ (15.10) | $3\Phi$ |
# | **truncated least squares** | $\chi^2$; beyond $\Phi$ $\Phi$ | $1$; beyond $\Phi$ $0$ | $\Phi$ |
#
# **Your turn.** Differentiate the Geman–McClure cost, and compute its weight at $\chi^2 = 40$ for $\Phi = 11.3$.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
Phi, chi2 = 11.3, 40.0
weight = ...  # from Phi and chi2
cost = [Phi * c / (Phi + c) for c in (chi2 - 1e-3, chi2 + 1e-3)]
compare(weight, (cost[1] - cost[0]) / 2e-3)

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# Phi, chi2 = 11.3, 40.0
# weight = (Phi / (Phi + chi2)) ** 2
# cost = [Phi * c / (Phi + c) for c in (chi2 - 1e-3, chi2 + 1e-3)]
# ```
#
# </details>


# %% slideshow={"slide_type": "subslide"} tags=["folded"]
def kernels(phi):
    x = np.linspace(0.01, 60, 121)
    kinds = (Huber, Cauchy, DCS, Truncated)
    curves = {kind.__name__: (kind(phi).cost(x), kind(phi).weight(x)) for kind in kinds}
    fig, axes = views.panels([f"cost, Φ = {phi:.1f}", "weight"], (8.2, 3.6), shared=False)
    for (name, ys), (colour, line, _) in zip(curves.items(), views.SERIES, strict=True):
        for ax, y, label in zip(axes, ys, ("cost ρ [1]", "weight w [1]"), strict=True):
            ax.plot(x, y, color=colour, linestyle=line, linewidth=2, label=name)
            ax.set(xlabel="χ² of an edge [1]", ylabel=label, aspect="auto")
    views.legend_below(fig)
    return fig


views.explore(
    kernels,
    lambda phi: (
        f"Costs and weights of four kernels for Φ = {phi:.1f}. Huber and Cauchy grow without bound; "
        f"DCS stays below {3 * phi:.0f}, and truncated least squares below {phi:.0f}."
    ),
    phi=(1.0, 40.0, 11.35),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Huber's cost is convex in $e$, but the size of its gradient stays constant for large residuals, so a
# distant outlier still affects the estimate. The others are *redescending*: far beyond $\Phi$ the
# gradient approaches zero. At $\chi^2 = 40\,000$ the weight of a false loop is
# {= 1e7 * DCS().weight(40000):.1f =} $\cdot\, 10^{-7}$ with DCS, and 0 with truncated least squares. We use
# $\Phi = 11.3$: at the true poses 99 % of right edges have a $\chi^2$ below $\Phi$, if their $\Lambda$
# is correct.
#
# **A bounded cost has many local minima.** Choose some loops, and compute the poses that fit them. If all
# other loops are far beyond $\Phi$ there, their gradients are nearly zero. So no small change of the poses
# reduces the cost: these poses are a local minimum, whether or not the chosen loops are right.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=10
# ## Many false loops
#
# Now we test the kernel on the odometry graph of the twin rooms, with all right loops and some false
# loops, without a gate. At the poses of odometry, which have errors of metres, right loops also have
# large residuals, like outliers. So $\Phi$ must not begin at 11.3. It begins at a larger value, at which
# the cost is nearly convex, and is divided by 4 in each iteration, down to 11.3 (the last step iterates until
# it converges). Such annealing is called **graduated non-convexity** (GNC). A natural first value is the
# largest $\chi^2$ of any loop: then every loop has full weight at first.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Reduce the first $\Phi$ step by step, and let the class predict the map each
# time. Do not stop before 11.3: otherwise the class concludes that a smaller first value is always
# better.

# %% slideshow={"slide_type": "fragment"}
ask(
    "15-false-loops",
    "The graph has more than eighty right loops, and $\\Phi$ begins at the largest $\\chi^2$ of any loop. **What is the "
    "effect of all false loops?**",
    {
        "none: the right loops are the majority": "at first every loop has full weight, and the gradient of a loop with an "
        "error of 7 m is far larger than that of a right loop.",
        "they ruin the map": "in the first iterations the false loops have full weight, and they agree with each other. The "
        "poses fit the false loops then, and the residuals of the right loops become large.",
        "a small effect: each has a small weight": "up to the largest χ² every weight is 1 in the first iteration.",
    },
    right="they ruin the map",
)


# %% slideshow={"slide_type": "subslide"} answers="15-false-loops" tags=["folded"]
def annealed(iteration, first_phi):
    phi, weights, poses = (each[: iteration + 1] for each in twins.schedule(first_phi))
    words = f"largest error {twins.largest_error(poses[-1]):.1f} m"
    titles = f"iteration {len(phi) - 1}: Φ = {views.grouped(round(phi[-1]))}", words
    fig, (left, right_ax) = views.panels(titles, (9.5, 4.2), shared=False)
    for bad, name in ((False, "corrected"), (True, "naive")):
        chosen, label = weights[:, twins.false == bad], f"{'false' if bad else 'right'} loops, mean"
        left.plot(chosen, color=views.COLOURS[name], alpha=0.3)
        look = {"color": views.COLOURS[name], "linewidth": 3, "marker": "o", "label": label}
        left.plot(chosen.mean(axis=1), **look)
    left.set(xlim=(-0.5, 15.5), ylim=(-0.05, 1.05), aspect="auto")
    left.set(xlabel="iteration", ylabel="weight w [1]", xticks=range(0, 16, 3))
    scans = false_loops.keyframe_points(twins.with_gate)
    for label, layer in scan_layers(poses[-1], scans).items():
        views.draw(right_ax, layer, label=label)
    right_ax.set(xlim=(-7, 17), ylim=(-11, 9), adjustable="box")
    views.legend_below(fig)
    return fig


views.explore(
    annealed,
    lambda iteration, first_phi: (
        f"Left: the weights of the loops while Φ decreases from {views.grouped(first_phi)}, iteration {iteration}; right: "
        "the map. From the largest Φ most right loops lose their weight; from a smaller one only the false loops do."
    ),
    play="iteration",
    iteration=(0, 15, 15),
    first_phi=slider("first Φ", [11.3, 100, 1000, *(10**k for k in (4, 5, 6, 7, 9))], 10**9),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="15-false-loops"
# Set the iteration to 0 and press ▶. While all loops have full weight, the map fits the false loops as well;
# then most right loops lose their weight. Now reduce the first $\Phi$: from which value on is the map right,
# and at which small value is it wrong again? The largest $\chi^2$ is that of the worst outlier, so an outlier
# determines in how many iterations all loops have full weight.


# %% slideshow={"slide_type": "subslide"} answers="15-false-loops"
# the largest error by five methods: trusted, Huber, DCS from two first Φ, GNC in the library
def errors_with(loops):
    graphs = [
        twins.close_loops(loops, robust=False)[0],
        twins.close_loops(loops, kernel=Huber())[0],
    ]
    graphs += [twins.anneal(loops, start) for start in (1e9, 1e4)] + [twins.close_loops(loops)[0]]
    return [twins.largest_error(graph.poses) for graph in graphs]


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output", "nearly"] answers="15-false-loops"
# none to all of the false loops, and every third of them alone
right, single = twins.select_loops(0), np.flatnonzero(twins.false)[1::3]
print("false loops   trusted   Huber   DCS from 10⁹   DCS from 10⁴   library")
every = int(twins.false.sum())
by_count = {count: errors_with(twins.select_loops(count)) for count in (0, 1, 3, 10, every)}
for count, errors in by_count.items():
    words = (f"{error:.{0 if error > 1 else 1}f} m" for error in errors)
    print("{:11d} {:>9} {:>7} {:>14} {:>14} {:>9}".format(count, *words))
alone = np.array([errors_with([*right, one]) for one in single])
ruined = (alone > 2).sum(axis=0)  # errors of more than 2 m
row = "each alone {:7d} {:8d} {:13d} {:14d} {:10d}".format(*ruined)
print(f"{row}    of {len(single)} maps ruined")

# %% [markdown] slideshow={"slide_type": "subslide"} answers="15-false-loops"
# The last row adds a single false loop to all right loops: every third of the {= every =}, so {= len(single) =} maps.
# We call a map with an error above 2 m *ruined*. Without a kernel {= ruined[0] =} of these loops ruin the map, with
# Huber's kernel {= ruined[1] =}, and with DCS from 10⁹ {= ruined[2] =}. With DCS the result depends on the first $\Phi$: from 10⁹,
# three false loops together ruin this map; **from 10⁴ the error is {= by_count[every][3]:.1f =} m with all
# {= every =} false loops**. Another graph may need another value, which is not known in advance.
#
# So the library (`PoseGraph.optimise`) runs several searches. Each begins with another set of loops, and
# gradually lowers the $\chi^2$ that it accepts. The kernel is truncated least squares, whose cost is
# $-2 \log$ of a likelihood: a loop is either right, with Gaussian noise, or false, which costs $\Phi$. So the
# results can be compared, and the library takes that of **maximum likelihood**, here with
# {= by_count[every][4]:.1f =} m. It also returns the **runner-up**: by how much the next solution costs more, and
# how far away its poses are.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output", "nearly"] answers="15-false-loops"
for some_right in (84, 8, 3, 1):
    loops = np.concatenate(
        [right[:: len(right) // some_right][:some_right], np.flatnonzero(twins.false)[:3]]
    )
    graph, optimum = twins.close_loops(loops)
    bad = np.flatnonzero(optimum.weights[-len(loops) :] == 0) >= some_right
    print(
        f"{some_right:2} right, 3 false: {np.sum(~bad)} and {np.sum(bad)} of them rejected, error "
        f"{twins.largest_error(graph.poses):.1f} m, ambiguous: {optimum.ambiguous}"
    )
print("the runner-up of the last: cost + {:.1f}, {:.1f} m away (rms)".format(*optimum.runner_up))

# %% [markdown] slideshow={"slide_type": "fragment"} answers="15-false-loops"
# In all four rows the false loops are rejected: they agree with each other (*perceptual aliasing*), but they
# contradict the odometry, which counts as well. In the last row the result is **ambiguous**: the costs of two
# different maps differ by less than $3\Phi$. Here the runner-up rejects the right loop, too, and only further
# measurements can decide. (If many false loops agree with each other, and contradict the odometry by less than
# $\Phi$ each, even the most likely map is wrong.)
#
# A complete system uses both a gate and a kernel. Further methods are *switchable constraints* (DCS is
# their closed form), and *pairwise consistency maximisation*, which accepts the largest set of loops of
# which every two agree.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Occupancy grids
#
# A door may be closed at first, and open when the robot returns. A map of points only grows, and
# contains both states of the door. The remedy is the **occupancy grid** of Moravec and Elfes: each cell
# stores the probability that it is occupied ($o$). By Bayes' rule, after the scans $z_1, \dots, z_t$,
#
# $$\begin{aligned} \frac{p(o \mid z_{1:t})}{p(\bar o \mid z_{1:t})} &= \frac{p(z_t \mid o)}{p(z_t \mid \bar o)} \cdot
# \frac{p(o \mid z_{1:t-1})}{p(\bar o \mid z_{1:t-1})} = \frac{p(o \mid z_t)}{p(\bar o \mid z_t)} \cdot \frac{p(\bar o)}{p(o)} \cdot
# \frac{p(o \mid z_{1:t-1})}{p(\bar o \mid z_{1:t-1})}, \\ \ell_t &= \ell_{t-1} + \log \frac{p(o \mid z_t)}{1 - p(o \mid z_t)} -
# \ell_0, \qquad \ell = \log \frac{p(o)}{1 - p(o)}. \end{aligned} \tag{15.11}$$
#
# The first step assumes that scans are independent given the cell's state; the second is Bayes' rule again. $\ell$ is
# the cell's **log-odds**, which are 0 for even odds. $p(o \mid z_t)$ is the **inverse sensor model**: 0.7 for a cell
# in which a beam ends, 0.4 for a cell that a beam passes. So a beam needs one addition per cell. (The
# grid also treats neighbouring cells as independent.)

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask which state a cell has that was hit as often as it was passed. Most students
# say "unknown", but a hit changes the log-odds by 0.85 and a pass by only −0.41, so the grid calls
# the cell occupied.

# %% [markdown] slideshow={"slide_type": "fragment"}
# **Your turn.** Two beams end in a cell, and a third beam passes it. Compute its log-odds, with the
# initial value 0. For comparison, the loop in the next cell applies Bayes' rule to the probability
# itself.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
cell_log_odds = ...  # from log_odds(HIT) and log_odds(MISS)
p = 0.5
for seen in (HIT, HIT, MISS):
    p = p * seen / (p * seen + (1 - p) * (1 - seen))
compare(cell_log_odds, log_odds(p))

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# cell_log_odds = 2 * log_odds(HIT) + log_odds(MISS)
# p = 0.5
# for seen in (HIT, HIT, MISS):
#     p = p * seen / (p * seen + (1 - p) * (1 - seen))
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "subslide"}
# After 40 scans of a closed door, the odds that its cells are occupied are very large. So log-odds are
# **clamped**: the probability that a cell is occupied, or free, never exceeds 97 %. Now the door is
# open. In a ROS map a cell counts as free if its probability is below 0.196. After how many scans are
# the cells of the door free?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
needed = {}
for name, most in {"clamped": log_odds(CLAMP), "without a clamp": np.inf}.items():
    cell, needed[name] = min(40 * log_odds(HIT), most), 0
    while cell >= log_odds(FREE):
        cell, needed[name] = cell + log_odds(MISS), needed[name] + 1
    print(f"{name:>15}: free after {needed[name]} scans")

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
walls = [[0, 0, 6, 0], [6, 0, 6, 4], [6, 4, 0, 4], [0, 4, 0, 0], [3, 0, 3, 1.4], [3, 2.4, 3, 4]]
laps = World([*walls, [3, 1.4, 3, 2.4]], [(1.4, 2.9, 0.2)]), World(walls)
turn = np.linspace(0, 2 * np.pi, 40, endpoint=False)
lap = np.column_stack([1.5 + 0.7 * np.cos(turn), 1.8 + 0.9 * np.sin(turn), turn + np.pi / 2])
grid, rng, all_points = OccupancyGrid(0.05), np.random.default_rng(3), []
for world in laps:
    for pose in lap:
        scan = RPLIDAR_A2.scan(world, pose, rng)
        grid.add(pose, scan)
        all_points.append(transform(pose, scan.points()[::3]))
shown = {
    "points of both laps": {"points": Points("scan", np.vstack(all_points))},
    "grid after both laps": {"occupied": grid.layer()},
}
fig, _ = views.side_by_side(shown, size=(9, 4))
views.show(
    fig,
    f"The {len(np.vstack(all_points))} points contain a closed door and a person; the grid contains neither, but shows the "
    "room behind the door.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# A simulated robot drives round the left room and records 40 scans: the door is closed, and a person
# stands in the room. Then it records 40 more scans: the door is open, and the person has left. The map
# of points still contains the closed door and the person. The grid contains neither, and shows a part
# of the next room. Grey cells have not been observed.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Real data
#
# We return to the real log of lesson 01: {= intel_maps.stored().readings =} scans in
# {= intel_maps.stored().minutes:.0f =} minutes, on several laps through the Intel Research Lab. The
# maps are stored with the course; `slamlab data get --lesson 15` fetches the recording.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask the class to find a double wall in the left map before you name one. If time
# is short, leave out the public pose graphs.

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
intel = intel_maps.stored()
scans = {name: {"scans": Points("corrected", intel.points[name])} for name in ("icp", "graph")}
shown = scans | {"graph": {"loops": Segments("loop", intel.loops)} | scans["graph"]}
fig, _ = views.side_by_side(shown, size=(9.5, 4.6))
views.show(
    fig,
    f"Left: a floor plan with double walls. Right: the same floor plan with single walls, and "
    f"{len(intel.loops)} loops in all corridors.",
)
for name in intel.points:
    mean, spread = intel.off[name], intel.spread[name]
    print(f"{name:>8}: mean relative error {mean:.3f} m, standard deviation {spread:.3f} m")

# %% [markdown] slideshow={"slide_type": "fragment"}
# In the left map, walls appear twice where the robot returned to a place. In the right map
# {= len(intel.loops) =} loops connect the laps. The error is the mean over {= intel.relations =}
# *relations*: relative poses, checked by hand (Kümmerle et al. 2009). The error of `graph` is
# {= intel.off["icp"] / intel.off["graph"]:.0f =} times smaller than that of `icp`, and
# {= intel.off["odometry"] / intel.off["graph"]:.0f =} times smaller than that of odometry. (`graph` also
# matches each scan with several earlier scans, so loop closing is not the only difference to `icp`.)
#
# The authors state 0.031 ± 0.026 m for their graph (quoted from a secondary source), but over all 2984
# relations of a longer log. Our relations may be easier. So our error is of the same order, but the
# comparison does *not* show that our graph is better.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Public pose graphs
#
# Published pose graphs serve to compare back ends. If the files are on your computer, the next cells
# optimise two of these graphs, those of the Intel Research Lab and of MIT's CSAIL. Otherwise the cells
# use a simulated graph. The results of GTSAM are $\chi^2 = 45.00$ and $40.56$.

# %% slideshow={"slide_type": "fragment"}
public = odometry_graphs.public_graphs()
if not public:
    print("the files are not on this computer: the cell uses the simulated twin rooms instead")
    public = {"twin rooms": twins.close_loops(right, robust=False)[0]}
    public["twin rooms"].poses = odometry_graph(twins.steps, twins.robot).poses
before = {name: graph.poses.copy() for name, graph in public.items()}

# %% slideshow={"slide_type": "fragment"}
for name, graph in public.items():
    before_it = views.grouped(round(graph.optimise(max_iterations=0).chi2))
    optimum = graph.optimise()
    sizes = f"{len(graph)} poses, {len(graph.edges)} edges"
    print(
        f"{name}: {sizes}, χ² {before_it} → {optimum.chi2:.2f} in {optimum.iterations} iterations"
    )

# %% slideshow={"slide_type": "fragment"} tags=["folded"]
name = next(iter(public))
shown = {
    f"{name}: start": {"initial guess": Poses("naive", before[name])},
    f"{name}: optimised": {"optimised poses": Poses("corrected", public[name].poses)},
}
fig, _ = views.side_by_side(shown, size=(9, 4))
views.show(
    fig,
    f"The {len(public[name])} poses of {name} before and after the optimisation; afterwards the laps coincide.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The file of CSAIL contains edges but no poses. The library computes the initial guess from the edges by
# linear least squares: first all headings, then all positions. Therefore this guess is close to the
# optimum, and a few iterations suffice.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Literature
#
# F. Lu and E. Milios, "Globally consistent range scan alignment for environment mapping", *Autonomous Robots* 4,
# 1997.
#
# F. Dellaert and M. Kaess, "Factor graphs for robot perception", *Foundations and Trends in Robotics* 6, 2017.
#
# P. Agarwal, G. D. Tipaldi, L. Spinello, C. Stachniss and W. Burgard, "Robust map optimization using dynamic
# covariance scaling", *ICRA* 2013.
#
# H. Yang, P. Antonante, V. Tzoumas and L. Carlone, "Graduated non-convexity for robust spatial perception", *IEEE Robotics and Automation
# Letters* 5, 2020.
#
# H. Moravec and A. Elfes, "High resolution maps from wide angle sonar", *ICRA* 1985.
#
# R. Kümmerle et al., "On measuring the accuracy of SLAM algorithms", *Autonomous Robots* 27, 2009.
#
# **Read next:** G. Grisetti, R. Kümmerle, C. Stachniss and W. Burgard, "A tutorial on graph-based SLAM", *IEEE Intelligent
# Transportation Systems Magazine* 2(4), 2010.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## What you can do now
#
# You can build a pose graph, derive and solve its normal equations, fix its gauge, and transform a
# covariance to the right frame. You can propose, verify and gate loop-closure candidates, and explain
# the effect of $\Phi$ on robust kernels and graduated non-convexity.
#
# The course began with odometry that drifts, and you have now seen how to compute the map of a real
# building.
#
# **What comes next:** in [lesson 16](16_your_own_slam.ipynb) you write your own SLAM, and measure its
# errors. The command `slamlab run` also reads your own logs in the formats of CARMEN and BreezySLAM,
# and ROS bags.
#
# The sections below this one are optional.
#
# **Exercise:** [15 · Pose-graph SLAM: closing the loop](../exercises/ex15_pose_graph_slam.ipynb). You
# write the Jacobians of an edge and a Gauss–Newton step, derive an edge that measures only a distance,
# gate a loop closure by (15.8), and compute a map from loops of which some are false.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: the gradient of χ² with sympy
#
# Is (15.5) right? We check the equation for an edge with two residual components, two unknowns and a
# symmetric $\Lambda$. Is (15.10) the derivative of (15.9)?

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Show this if somebody doubts the factor 2. With a $\Lambda$ that is not
# symmetric the first difference is no longer zero: replace one `l_12` by another symbol.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output", "code"]
J = sp.Matrix(2, 2, sp.symbols("J_11 J_12 J_21 J_22"))
e, delta = sp.Matrix(sp.symbols("e_1 e_2")), sp.Matrix(sp.symbols("delta_1 delta_2"))
l_1, l_2, l_12 = sp.symbols("lambda_1 lambda_2 lambda_12")
Lambda = sp.Matrix([[l_1, l_12], [l_12, l_2]])
chi2 = ((e + J * delta).T * Lambda * (e + J * delta))[0]
gradient = sp.Matrix([chi2]).jacobian(delta).T
print("difference:", list(sp.expand(gradient - 2 * (J.T * Lambda * J * delta + J.T * Lambda * e))))
Phi, chi2 = sp.symbols("Phi chi2", positive=True)
cost, weight = 3 * Phi - 4 * Phi**2 / (Phi + chi2), (2 * Phi / (Phi + chi2)) ** 2
print("derivative minus weight:", sp.simplify(cost.diff(chi2) - weight))
print("cost and weight at Φ:", sp.simplify(cost.subs(chi2, Phi)), weight.subs(chi2, Phi))
print("the largest cost:", sp.limit(cost, chi2, sp.oo))

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: sparse Cholesky factorisation
#
# To solve $\Lambda_x\, \delta = -g$, we write $\Lambda_x = L L^{\mathsf T}$ with a lower triangular $L$
# (**Cholesky**), and then solve two triangular systems. The factor $L$ of a sparse $\Lambda_x$ also has
# non-zero blocks where $\Lambda_x$ is zero: the **fill-in**. The amount of fill-in depends on the order
# of the poses. For the graph of the twin rooms we compare the order of the trajectory with an order
# that reduces fill-in (*minimum degree*).

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let the class eliminate a star by hand, one pose in the middle of five: with the
# middle first, all others become connected; with the middle last, there is no fill-in.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
graph = twins.with_gate.graph
of_poses, in_order, reordered = odometry_graphs.fill_in(graph)
print(
    f"{len(graph)} poses, {len(graph.edges)} edges: Λ_x has {views.grouped(9 * (len(graph) - 1) ** 2)} numbers"
)
print(f"not zero: {of_poses} of Λ_x; {views.grouped(in_order)} of L, {reordered} if reordered")

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: Levenberg–Marquardt and the initial guess
#
# Far from the optimum a Gauss–Newton step may be too long, so that $\chi^2$ increases.
# **Levenberg–Marquardt** solves $(\Lambda_x + \lambda \operatorname{diag} \Lambda_x)\, \delta = -g$
# instead. If the step reduces the cost, the method accepts the step and reduces the damping $\lambda$.
# Otherwise it multiplies $\lambda$ by ten: the step becomes shorter, and its direction approaches the
# negative gradient (scaled by $\operatorname{diag} \Lambda_x$). We compare both methods on a ring of
# poses, from two random initial guesses of four poses.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Students often expect that damping avoids local minima. The second guess shows
# that it does not: damping guarantees only that the cost never increases.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# both methods and rotation averaging, from two random guesses
ring = odometry_graph([[1, 0, np.pi / 2]] * 4, corridor.robot)
ring.edges = [edge._replace(information=np.diag([100.0, 100, 400])) for edge in ring.edges]
ring.add_edge(4, 0, np.zeros(3), 2500 * np.eye(3))
for seed in (5, 0):
    guess = np.random.default_rng(seed).normal(0, 1, (4, 3)) * [1, 1, 1.2]
    for name in ("gauss_newton_costs", "levenberg_marquardt_costs"):
        ring.poses[1:] = guess
        chi2 = [round(each) for each in getattr(odometry_graphs, name)(ring, 14)]
        print(f"seed {seed}, {name}: {chi2[:5]} … {chi2[-1]}")
    ring.poses[1:] = guess
    ring.initialise()
    print(f"seed {seed}, rotation first: χ² {ring.optimise().chi2:.2f}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# From the first guess the first Gauss–Newton step is too long, and $\chi^2$ increases;
# Levenberg–Marquardt never increases $\chi^2$. From the second guess both methods stop at a **local
# minimum**, although the cost of the optimum is 0. So the **initial guess** matters. Odometry gives an
# initial guess. If it is poor, **rotation averaging** gives a better guess: it first estimates the
# headings from the measured turns alone, and then the positions, which are the solution of a linear
# problem if the headings are known. (LAGO and chordal initialisation are such methods.) From this guess,
# `PoseGraph.initialise`, the optimiser finds the optimum in both cases.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: marginalisation and the Schur complement
#
# During a whole day the graph of a robot becomes too large. To remove a pose without losing the
# information of its edges, we **marginalise** it out. Let $m$ be the removed pose and $r$ the remaining
# poses. If we eliminate $\delta_m$ from the normal equations, the remaining equations are
#
# $$\left( \Lambda_{rr} - \Lambda_{rm} \Lambda_{mm}^{-1} \Lambda_{mr} \right) \delta_r = -\left( g_r - \Lambda_{rm} \Lambda_{mm}^{-1}
# g_m \right). \tag{15.12}$$
#
# The matrix in brackets is the **Schur complement** of $\Lambda_{mm}$. Its inverse is the block $rr$ of
# the full covariance, which is the marginal covariance of the remaining poses.
#
# **Your turn.** Marginalise out pose 2 of the square.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask what happens if one simply deletes the rows and columns of pose 2 from
# $\Lambda_x$. The result belongs to a pose 2 that is known exactly (conditioning), so the covariance
# of the others becomes too small.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
Lambda_x, m = total_information(best)[3:, 3:], np.arange(3, 6)  # poses 1 to 4; pose 2
r = np.setdiff1d(np.arange(12), m)
schur = ...  # from Lambda_x[np.ix_(r, r)], Lambda_x[np.ix_(r, m)] …
compare(schur, np.linalg.inv(np.linalg.inv(Lambda_x)[np.ix_(r, r)]))

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# Lambda_x, m = total_information(best)[3:, 3:], np.arange(3, 6)  # poses 1 to 4; pose 2
# r = np.setdiff1d(np.arange(12), m)
# schur = Lambda_x[np.ix_(r, r)] - Lambda_x[np.ix_(r, m)] @ np.linalg.solve(
#     Lambda_x[np.ix_(m, m)], Lambda_x[np.ix_(m, r)]
# )
# ```
#
# </details>

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# marginalise out pose 2: blocks, and covariance of the other poses
print_blocks(Lambda_x)
print("without pose 2:")
rest = Lambda_x[np.ix_(r, r)]
product = np.linalg.solve(Lambda_x[np.ix_(m, m)], Lambda_x[np.ix_(m, r)])
rest = rest - Lambda_x[np.ix_(r, m)] @ product
print_blocks(rest)
change = np.linalg.inv(rest) - np.linalg.inv(Lambda_x)[np.ix_(r, r)]
print(f"the covariance of the other poses changes by {abs(change).max():.6f}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The covariance of the other poses stays the same. But the block of poses 1 and 3, which was zero, is
# now non-zero: this is **fill-in** again. In a graph with many loops, marginalising out many poses
# makes the information matrix dense. An EKF marginalises out every past pose, so its map is fully
# correlated (lesson 07).

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: a map for other programs
#
# The module `map_server` writes the files that ROS reads: an image, and a text file with the scale and
# the origin of this image.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
with TemporaryDirectory() as folder:
    path = map_server.save(grid, Path(folder) / "rooms")
    print(path.read_text(encoding="utf-8"))
    again = map_server.load(path)
print("read again, the same cells:", bool((again.states == grid.states).all()))
