# %% [markdown]
# # Exercise 15 · Pose-graph SLAM: closing the loop
#
# **You will be able to** write the back end of a pose-graph SLAM: the Jacobians of an edge, and a
# Gauss–Newton step. You will then derive an edge that measures only a distance, decide whether a
# loop closure may be trusted, and map a building from data with false loop closures.
#
# **60 minutes for tasks 1 to 4, and 45 for task 5. Before:** lesson [15 · Pose-graph SLAM: closing the loop](../notebooks/15_pose_graph_slam.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it. You can repeat this as often as you like. A check tries random graphs and special cases that
# the text allows. If your answer breaks a law, the check shows a small input that breaks it.
# `hint("15-step")` in a cell of your own asks a guiding question.
#
# Lengths are in metres and angles in radians. A pose is `[x, y, θ]`, an array of three numbers, and
# its heading lies between $-\pi$ and $\pi$. A function must not change its arguments.
#
# The code and the hints use other symbols, which are common in the literature: `A` is $J_i$, `B` is
# $J_j$, `H` is $\Lambda_x$, `b` is $g$ of (15.5), and `R` is a rotation matrix.

# %%
import numpy as np

from classroom.checks import ask, attempt, check
from slamlab import views
from slamlab.geometry import between, compose, wrap
from slamlab.layers import Points, Poses, Segments

# %% [markdown]
# ## 1 · The Jacobians of an edge
#
# An edge $(i, j, z)$ measures pose $j$ in the frame of pose $i$. From pose $i$ and $z$, the
# predicted pose $j$ is $x_i \oplus z$. The **residual** $e$ (error) is pose $j$ in the frame of the
# predicted pose (15.2), and its last component is wrapped:
#
# $$e = \ominus z \oplus (\ominus x_i \oplus x_j) = \begin{bmatrix} \mathrm{Rot}(\theta_z)^{\mathsf T} \left(
# \mathrm{Rot}(\theta_i)^{\mathsf T} (p_j - p_i) - p_z \right) \\ \theta_j - \theta_i - \theta_z \end{bmatrix},
# \qquad p = \begin{bmatrix} x \\ y \end{bmatrix}.$$


# %% name="error"
def error(x_i, x_j, z):
    """The residual of an edge (3,) [m, m, rad]; x_i, x_j, z : (3,) poses of real numbers."""
    return between(z, between(x_i, x_j))


# %% [markdown]
# The back end needs the derivatives of $e$ with respect to both poses: $J_i = \partial e/\partial
# x_i$ and $J_j = \partial e/\partial x_j$. The lesson derived most entries in (15.3):
#
# - If pose $j$ moves, $e$ changes by the same motion, expressed in a frame with the heading
#   $\theta_i + \theta_z$.
# - If pose $i$ moves, $e$ changes by the opposite motion.
# - If pose $i$ *turns*, the predicted pose moves on a circle round pose $i$. In (15.2) $\theta_i$
#   occurs in $\mathrm{Rot}(\theta_i)^{\mathsf T}(p_j - p_i)$ and in the angle. So the heading
#   column is the derivative of the first expression, rotated by $\mathrm{Rot}(\theta_z)^{\mathsf
#   T}$.
#
# **Your task.** Derive the heading column of $J_i$. Return $J_i$ and $J_j$. An edge may connect any
# two poses, also two poses at the same position, and $z$ may be zero. Only rounding errors are allowed: the error of
# an entry may be $3\cdot 10^{-14}$ times the largest number among the coordinates and entries. For edges with
# coordinates up to $10^7$ m, it may be $10^{-8}$ times the largest entry. A difference quotient of two values has larger
# errors at any step width, but a complex step is exact, and you may use it with a formula of your own (`error` takes
# real numbers).


# %% name="jacobians"
def jacobians(x_i, x_j, z):
    """A = ∂e/∂x_i and B = ∂e/∂x_j, each (3, 3): one row per component of e.

    x_i, x_j, z : (3,) [m, m, rad]
    """
    ### BEGIN SOLUTION
    angle = x_i[2] + z[2]
    c, s = np.cos(angle), np.sin(angle)
    dx, dy = x_j[0] - x_i[0], x_j[1] - x_i[1]
    A = np.array([[-c, -s, c * dy - s * dx], [s, -c, -c * dx - s * dy], [0, 0, -1]])
    B = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
    return A, B
    ### END SOLUTION


# %%
check("15-jacobians")

# %% [markdown]
# ## 2 · One Gauss–Newton step
#
# The cost of all edges is $\chi^2 = \sum e^{\mathsf T}\Lambda\,e$. $\Lambda$ is the information
# matrix of $e$, which is the inverse of its covariance. Linearised, $e(x + \delta) \approx e +
# J\delta$, and by the normal equations (15.5) the best $\delta$ solves
#
# $$\Lambda_x\, \delta = -g, \qquad \Lambda_x = \sum J^{\mathsf T}\Lambda\, J, \qquad g = \sum J^{\mathsf T}\Lambda\, e.$$
#
# The $J$ of an edge has $J_i$ in the columns of pose $i$, $J_j$ in the columns of pose $j$, and
# zeros elsewhere. So each edge adds to four blocks of $\Lambda_x$ and to two parts of $g$.
#
# Edges measure relative poses only, so $\Lambda_x$ is singular (gauge freedom). Therefore **fix
# pose 0**. Then add $\delta$ to the poses, component by component, and wrap the headings.
#
# **Your task.** Take exactly one step, and return the new poses. Use `error` and your
# `jacobians`: if the latter is wrong, the check uses a correct one in its place. The graph has at
# least two poses, and a chain of edges connects each pose to pose 0. The edges can have any order.
# They may point backwards ($i$ larger than $j$), and several edges may connect the same two poses.


# %% name="step"
def step(poses, edges):
    """The poses after one Gauss–Newton step; pose 0 is fixed.

    poses : (n, 3) [m, m, rad]
    edges : list of (i, j, z, information): two indices, z (3,), Λ (3, 3) of e
    returns (n, 3), headings wrapped
    """
    ### BEGIN SOLUTION
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, information in edges:
        J = np.zeros((3, 3 * n))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        H += J.T @ information @ J
        b += J.T @ information @ error(poses[i], poses[j], z)
    delta = -np.linalg.solve(H[3:, 3:], b[3:])
    better = poses.copy()
    better[1:] += delta.reshape(-1, 3)
    better[:, 2] = wrap(better[:, 2])
    return better
    ### END SOLUTION


# %%
check("15-step")

# %%
ask(
    "ex15-steps",
    "A robot drives round a hall, with ten poses. Its odometry measures each turn of 36° as 31°. "
    "At the end, scan matching measures the first pose, which is one step ahead. **After how many "
    "Gauss–Newton steps do the poses no longer change visibly?**",
    {
        "one: one step solves a least squares problem": "this would be right if e were linear in the poses. For such large changes of heading e is not linear.",
        "three": "the first step is inaccurate, because e is not linear over such large changes. Afterwards e is nearly linear.",
        "about twenty: each step is a small correction": "gradient descent would need many steps. A Gauss–Newton step goes to the "
        "minimum of the linearised problem.",
    },
    right="three",
)


# %% name="hall"
CERTAIN, UNCERTAIN = np.diag([2500.0, 2500.0, 3000.0]), np.diag([100.0, 100.0, 100.0])


def hall():
    """Ten poses by odometry (10, 3), nine odometry edges and a loop."""
    poses, edges = [np.zeros(3)], []
    for k in range(9):
        z = np.array([1.5, 0.0, np.radians(31)])  # the true turn is 36 degrees
        edges.append((k, k + 1, z, UNCERTAIN))
        poses.append(compose(poses[-1], z))
    edges.append((9, 0, np.array([1.5, 0.0, np.radians(36)]), CERTAIN))
    return np.array(poses), edges


def chi2(poses, edges):
    """The sum of eᵀΛe."""
    found = [(error(poses[i], poses[j], z), information) for i, j, z, information in edges]
    return sum(e @ information @ e for e, information in found)


# %% name="watch" answers="ex15-steps"
@attempt
def _():
    start, edges = hall()

    def draw(steps):
        poses = start
        for _ in range(steps):
            poses = step(poses, edges)
        loops = [[*poses[i, :2], *poses[j, :2]] for i, j, *_ in edges[9:]]
        title = f"after {steps} steps: χ² = {chi2(poses, edges):.1f}"
        fig, ax = views.axes(title, size=(5.5, 4.5))
        views.draw(ax, Segments("loop", loops))
        views.draw(ax, Poses("corrected", poses), marker=".", markersize=6)
        views.legend(ax, loc="center")
        return fig

    views.explore(
        draw, alt="A ring of ten poses and its loop after some Gauss–Newton steps.", steps=(0, 6, 3)
    )


# %% [markdown] answers="ex15-steps"
# The first step treats $e$ as linear over large changes of heading, so it only halves $\chi^2$. The
# second step corrects nearly the whole error, and after the third step the poses no longer change
# visibly. The correction is distributed over all turns.


# %% [markdown]
# ## 3 · An edge that measures a distance
#
# Two robots have radios. The time of flight of a signal gives the **distance** $r$ between the two
# radios, but no direction and no heading. A radio is usually not at the centre of the robot: $a_i$
# and $a_j$ are the positions of the radios in the robot frames. The vector from one radio to the
# other, and the residual of the edge, are
#
# $$d = \left(p_j + \mathrm{Rot}(\theta_j)\,a_j\right) - \left(p_i + \mathrm{Rot}(\theta_i)\,a_i\right), \qquad
# e = \lVert d\rVert - r.$$
#
# A pose graph can also contain such edges. Then $e$ is a single number, and $J_i$ and $J_j$ are
# single rows. How does $d$ change with pose $i$, and how does the length of $d$ change with $d$?
#
# You can check one case easily: if a radio is at the centre of robot $i$, one entry of $J_i$ is
# zero. Which entry is zero, and why?
#
# **Your task.** Return $e$ and the two rows. The radios are at least 10 cm apart. They may be at
# the centres of the robots, and the headings are arbitrary. The rows may have the same errors as in
# task 1.


# %% name="range"
def range_edge(x_i, x_j, r, a_i, a_j):
    """The residual of a measured distance, and its Jacobians.

    x_i, x_j : (3,) poses [m, m, rad];  r : float, the measured distance [m]
    a_i, a_j : (2,) position of each radio in its robot's frame [m]
    returns e, a float [m], and A = ∂e/∂x_i and B = ∂e/∂x_j, each (3,)
    """
    ### BEGIN SOLUTION

    def radio(x, a):
        c, s = np.cos(x[2]), np.sin(x[2])
        arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
        return x[:2] + arm, np.array([-arm[1], arm[0]])

    (from_i, turned_i), (from_j, turned_j) = radio(x_i, a_i), radio(x_j, a_j)
    d = from_j - from_i
    distance = np.hypot(d[0], d[1])
    u = d / distance
    A = np.array([-u[0], -u[1], -u @ turned_i])
    B = np.array([u[0], u[1], u @ turned_j])
    return distance - r, A, B
    ### END SOLUTION


# %%
check("15-range")

# %%
ask(
    "ex15-nine",
    "The robot drives round the hall again, but without the loop closure. A radio stands at the "
    "start, and the robot's radio measures its distance at each of the nine later poses. **Can "
    "nine distances correct the nine turns?**",
    {
        "no: a distance contains no direction": "a single distance contains no direction. But "
        "odometry measures each step, and few shapes of the trajectory agree with odometry and all "
        "distances.",
        "nearly": "odometry and the distances together determine the shape of the trajectory, except for a small error.",
        "only with a second radio: with one radio the whole trajectory may turn about it": "pose 0 is fixed, including its heading, so the trajectory cannot turn.",
    },
    right="nearly",
)


# %% name="received-ranges" answers="ex15-nine"
@attempt
def _():
    start, edges = hall()
    mast, station, steps = np.array([0.3, 0.4]), np.zeros(2), [np.zeros(3)]
    for _ in range(9):
        steps.append(compose(steps[-1], np.array([1.5, 0.0, np.radians(36)])))
    truth = np.array(steps)
    r = [range_edge(truth[0], x, 0.0, station, mast)[0] for x in truth]
    poses = start.copy()
    for _ in range(6):
        H, b = np.zeros((30, 30)), np.zeros(30)
        for i, j, z, L in edges[:9]:
            J = np.zeros((3, 30))
            at_i, at_j = slice(3 * i, 3 * i + 3), slice(3 * j, 3 * j + 3)
            J[:, at_i], J[:, at_j] = jacobians(poses[i], poses[j], z)
            H, b = H + J.T @ L @ J, b + J.T @ L @ error(poses[i], poses[j], z)
        for k in range(1, 10):
            e, _, B = range_edge(poses[0], poses[k], r[k], station, mast)
            at = slice(3 * k, 3 * k + 3)
            H[at, at] += 2500 * np.outer(B, B)
            b[at] += 2500 * np.array(B) * e
        poses[1:] -= np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
    shown = {
        title: {"truth": Poses("truth", truth), name: track, "radio": Points("landmark", [station])}
        for title, name, track in (
            ("odometry", "odometry alone", Poses("naive", start)),
            ("odometry and nine distances", "estimate", Poses("corrected", poses)),
        )
    }
    fig, _ = views.side_by_side(shown, size=(9, 3.8))
    views.show(
        fig,
        alt="On the left an open ring of poses beside the true ring, on the right a ring close to the true ring.",
    )


# %% [markdown] answers="ex15-nine"
# The nine distances nearly correct the turns. Each distance constrains one direction of a pose, and
# odometry connects the poses. Together they correct most of the error. A small error remains in
# directions that the distances do not measure.


# %% [markdown]
# ## 4 · Gating a loop closure
#
# The front end proposes a loop $(i, j, z, \Lambda)$. Before you add it to the graph, test whether it
# agrees with the graph. Its residual $v = e$ at the poses of the graph has a covariance $S$, if the
# loop is true, and
#
# $$d^2 = v^{\mathsf T} S^{-1} v$$
#
# is its squared Mahalanobis distance (15.8). In the lesson pose $i$ was fixed, so only pose $j$ and the
# match had errors. Here both poses can have errors, and these are correlated: an inaccurate turn
# near pose 0 moves both. Which part of such an error reaches the residual?
#
# You are given the poses of least cost, and $\Lambda_x$ of task 2 at these poses, without the rows and
# columns of pose 0, which is fixed. The inverse is the joint covariance of all other poses. For a
# large graph it is expensive. You need only a few of its columns, and these are the solution of a
# system of linear equations.
#
# If the loop is true, $d^2$ has a χ² distribution. `gates[k]` bounds $d^2$ for $k$ degrees of freedom
# with some probability, such as 99 %.
#
# **Your task.** Return $d^2$, and whether the loop may be accepted: whether $d^2$ is not above the gate.
# The loop is not an edge of the graph yet, and its errors are independent of those of the graph. It
# may point backwards, and pose $i$ or pose $j$ may be pose 0, but not both. Use `error` and your
# `jacobians`.


# %% name="gate"
def gate_loop(poses, H, loop, gates):
    """The squared Mahalanobis distance of a proposed loop, and whether it may be accepted.

    poses : (n, 3) of least cost [m, m, rad]; pose 0 is fixed
    H : (3n − 3, 3n − 3), Λ_x of the graph without the rows and columns of pose 0
    loop : (i, j, z, information), two indices, z (3,), Λ (3, 3) of e
    gates : (7,), gates[k] for k degrees of freedom
    returns d2, a float, and accepted, True or False
    """
    ### BEGIN SOLUTION
    i, j, z, information = loop
    J = np.zeros((3, 3 * len(poses)))
    J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
    J = J[:, 3:]
    S = J @ np.linalg.solve(H, J.T) + np.linalg.inv(information)
    v = error(poses[i], poses[j], z)
    d2 = v @ np.linalg.solve(S, v)
    return d2, d2 <= gates[3]
    ### END SOLUTION


# %%
check("15-gate")

# %%
ask(
    "ex15-order",
    "In the hall of task 2, by odometry alone, the true loop has $d^2 = 8.6$. A false loop measures the "
    "first pose 0.8 m away from its true position, and has $d^2 = 5.1$. The 99 % gate is 11.3, so both "
    "pass. You accept the false loop and optimise. **What is $d^2$ of the true loop now?**",
    {
        "still 8.6: it is as true as before": "d² compares a loop with the graph. The graph now contains the false loop.",
        "a little more, and it passes: the false loop is only 0.8 m away": "the false loop claims to be accurate to 2 cm. "
        "In units of this σ, 0.8 m is a lot.",
        "several hundred: it is rejected": "after the false loop, the graph predicts the last pose accurately, at a wrong position.",
    },
    right="several hundred: it is rejected",
)


# %% name="order" answers="ex15-order"
def information_matrix(poses, edges):
    """Λ_x without pose 0, by difference quotients of all residuals."""

    def whitened(x):
        at = np.vstack([poses[:1], poses[1:] + x.reshape(-1, 3)])
        return np.ravel([np.linalg.cholesky(L).T @ error(at[i], at[j], z) for i, j, z, L in edges])

    steps = 1e-5 * np.eye(3 * len(poses) - 3)
    J = np.transpose([(whitened(x) - whitened(-x)) / 2e-5 for x in steps])
    return J.T @ J


@attempt
def _():
    start, edges = hall()
    odometry, true = edges[:9], edges[9]
    loops = {"true": true, "false": (9, 0, np.array([2.2, 0.3, 0.8]), CERTAIN)}
    gates, shown = [0, 6.6, 9.2, 11.3, 13.3, 15.1, 16.8], {}

    def line(x, loop):
        return [[*x[loop[0], :2], *compose(x[loop[0]], loop[2])[:2]]]

    for first in ("no", *loops):
        graph, poses = [*odometry, *([loops[first]] if first in loops else [])], start
        for _ in range(6):
            poses = step(poses, graph)
        H, found = information_matrix(poses, graph), []
        for name in loops.keys() - {first}:
            d2, accepted = gate_loop(poses, H, loops[name], gates)
            found.append(f"{name} loop {d2:.1f}{'' if accepted else ', rejected'}")
        shown[f"{first} loop accepted; d²:\n{', '.join(sorted(found))}"] = {
            "poses": Poses("corrected", poses),
            "pose 0 as the true loop measures it": Segments("landmark", line(poses, true)),
            "pose 0 as the false loop measures it": Segments("naive", line(poses, loops["false"])),
        }
    fig, _ = views.side_by_side(shown, size=(11, 4.2))
    views.show(
        fig,
        alt="Ten poses, and two lines from the last pose to the first one as each loop measures it: by odometry neither line ends there; with an accepted loop, only the line of this loop does.",
    )


# %% [markdown] answers="ex15-order"
# Whichever loop you accept first, the other one is rejected. A gate compares a loop with the graph, and
# an accepted false loop is a part of the graph. So a gate in the order in which loops arrive can lock
# out all true loops. In the last task you compare maps by different loops.


# %% [markdown]
# ## 5 · A map in spite of false loops
#
# Two doors that look alike can cause a false loop. The lesson uses a robust kernel: if the $\chi^2$
# of a loop is larger than $\Phi$, the cost (15.9) replaces it. The optimiser then multiplies the
# $\Lambda$ of the loop by the derivative of this cost. This is the weight (15.10), which is given:


# %% name="weight"
def weight(chi2, phi):
    """The weight of an edge by dynamic covariance scaling, in (0, 1]."""
    return min(1.0, 2 * phi / (phi + chi2)) ** 2


# %% [markdown]
# The next cell uses the hall with its true loop and with a false loop. The false loop measures pose
# 6 beside pose 1. The figure shows three maps: with the true loop alone, with both loops at full
# weight, and with robust weights. With the poses from odometry, the true loop also has a large
# $\chi^2$. Therefore $\Phi$ begins at $10^5$ and is halved in each iteration (graduated
# non-convexity).


# %% name="false-loop"
@attempt
def _():
    start, edges = hall()
    edges = [*edges, (1, 6, np.array([0.2, 0.1, 0.3]), CERTAIN)]

    def weighted(poses, k):
        scaled, phi = list(edges[:9]), max(11.3, 1e5 / 2**k)
        for i, j, z, information in edges[9:]:
            e = error(poses[i], poses[j], z)
            scaled.append((i, j, z, weight(e @ information @ e, phi) * information))
        return scaled

    def settled(graph):
        poses = start
        for k in range(40):
            poses = step(poses, graph(poses, k))
        return poses

    graphs = {"true loop only": lambda *_: edges[:10], "both trusted": lambda *_: edges}
    graphs["both weighted"] = weighted
    shown = {}
    for title, graph in graphs.items():
        poses = settled(graph)
        lines = [[*poses[i, :2], *compose(poses[i], z)[:2]] for i, j, z, _ in edges[9:]]
        shown[title] = {"poses": Poses("corrected", poses)}
        shown[title]["pose as the true loop measures it"] = Segments("landmark", lines[:1])
        shown[title]["pose as the false loop measures it"] = Segments("naive", lines[1:])
    fig, _ = views.side_by_side(shown, size=(11, 4.2))
    views.show(
        fig,
        alt="A ring closed by the true loop, a path folded by a false loop, and a ring closed in spite of the false loop.",
    )


# %% [markdown]
# The weight rejects this single false loop. Now a robot drives two laps round a building with
# inaccurate odometry (σ of 5° per step). Its front end reports eighteen loops. Ten loops are true.
# Two loops are false and have independent errors. The other six loops are false but **agree with
# each other**: in consecutive scans the front end confused a place with a similar place 2.5 m away,
# as in the twin rooms of the lesson. With robust weights alone, the map depends on the initial
# $\Phi$, as in the lesson. If $\Phi$ begins at the largest $\chi^2$ of any loop, every loop has its
# full weight at first, and most of these maps are wrong.
#
# **Your task.** Return poses with the smallest possible error. Any method is allowed. If your `step`
# or your `gate_loop` is wrong, the check uses a correct one in its place. For example, you can gate
# the loops before you use them, search for loops that agree with each other, weight the loops, or
# try several initial values and compare the costs. Guiding questions:
#
# - How large is $d^2$ of each loop by odometry alone (`gate_loop`)?
# - An accepted loop reduces the covariance of the other poses. How does this change $d^2$ of the
#   loops that you have not judged yet?
# - If you weight the loops, with which $\Phi$ do you begin? How can you choose between the results
#   of two initial values without ground truth?
# - How can you compare a map that uses one group of loops with a map that uses another group?
#
# The error of a map is the rms position error of all its poses, without alignment, since pose 0
# is known. The check computes the maps of sixteen runs. Each row of the table that you reach adds
# its points, whether or not you reach the others. Row 2 requires that half of the maps are
# accurate, and row 3 that most maps are roughly right.
#
# | row | maps, of 16 | error below | points |
# | --- | --- | --- | --- |
# | 1 | at least 8 | 0.9 m | 0.5 |
# | 2 | at least 8 | 0.38 m | 2 |
# | 3 | at least 11 | 0.6 m | 3 |
#
# Together with 0.5 points for unchanged arguments, these are the 6 points of the task. For row 1,
# the check also uses two smaller sets of shorter runs without false loops: in four runs there are
# six true loops, and in twelve runs there is a single true loop. In each of the two sets, at
# least half of the maps must also have an error below 0.9 m. Odometry alone, and the map with all
# loops, typically have errors above one metre. The check stops after 10 s.
#
# The odometry edges connect each pose to the next pose, in order, and none of them is false.
# `poses` are computed from the odometry edges alone. Every run has at least one loop. The σ of a
# true loop is about 5 cm and 1°, as in its $\Lambda$. Runs may differ in their numbers of poses
# and of loops, loops have any order, and all loops of a run may be true.


# %% name="false-loops"
def close_loops(poses, edges, loops):
    """The map of a run in which some loops may be false; pose 0 is fixed.

    poses : (n, 3) by odometry alone [m, m, rad]
    edges : list of (i, j, z, information), the odometry edges; none is false
    loops : list of the same kind; some may be false
    returns (n, 3) [m, m, rad]
    """
    ### BEGIN SOLUTION
    n = len(poses)

    def linear(some, at):
        """J without pose 0, and e, of some edges, whitened by their Λ."""
        i, j = np.array([edge[:2] for edge in some]).T
        z, information = (np.array([edge[k] for edge in some]) for k in (2, 3))
        angle, (dx, dy) = at[i, 2] + z[:, 2], (at[j] - at[i])[:, :2].T
        c, s, count = np.cos(angle), np.sin(angle), np.arange(len(some))
        B = np.zeros((len(some), 3, 3))
        B[:, 0, 0], B[:, 0, 1], B[:, 1, 0], B[:, 1, 1], B[:, 2, 2] = c, s, -s, c, 1
        A = -B
        A[:, 0, 2], A[:, 1, 2] = c * dy - s * dx, -c * dx - s * dy
        J = np.zeros((len(some), n, 3, 3))
        J[count, i], J[count, j] = A, B
        U = np.linalg.cholesky(information).swapaxes(1, 2)
        e = U @ between(z, between(at[i], at[j]))[..., None]
        return (U @ J.swapaxes(1, 2).reshape(-1, 3, 3 * n)).reshape(-1, 3 * n)[:, 3:], e.ravel()

    def optimised(some, at):
        """The best poses for some edges."""
        at = at.copy()
        for _ in range(3):
            J, e = linear(some, at)
            at[1:] -= np.linalg.solve(J.T @ J, J.T @ e).reshape(-1, 3)
            at[:, 2] = wrap(at[:, 2])
        return at

    def agreeing(at):
        """The set of least cost of loops that agree with odometry and with each other."""
        J, e = linear(edges, at)
        P = np.linalg.inv(J.T @ J)
        K, v = linear(loops, at)
        v, S = v - K @ P @ J.T @ e, K @ P @ K.T + np.eye(len(v))
        rows, best, tried = np.arange(len(v)).reshape(-1, 3), (0.0, []), set()
        for first in range(len(loops)):
            if first in tried:
                continue
            w, T, cost, chosen, k = v, S, 0.0, [], first
            while len(chosen) < len(loops):
                blocks = T[rows[:, :, None], rows[:, None, :]] + 1e-9 * np.eye(3)
                d2 = np.sum(w[rows] * np.linalg.solve(blocks, w[rows][..., None])[..., 0], axis=1)
                d2[chosen] = np.inf
                k = int(np.argmin(d2)) if chosen else first
                if d2[k] > 16:
                    break
                cost, at_k = cost + d2[k] - 16, rows[k]
                gain = T[:, at_k] @ np.linalg.inv(T[np.ix_(at_k, at_k)])
                w, T, chosen = w - gain @ w[at_k], T - gain @ T[at_k], [*chosen, k]
            best, tried = min(best, (cost, chosen)), tried.union(chosen)
        return [loops[k] for k in best[1]]

    found = poses
    for _ in range(2):  # the second time e is linearised nearer to the best poses
        found = optimised([*edges, *agreeing(found)], found)
    return found
    ### END SOLUTION


# %%
check("15-false-loops")

# %% [markdown]
# The next cell tests your method on a run with ground truth, and draws each loop that agrees with your
# map. Choose other runs, too. If the map of a run is wrong, which loops agree with it?


# %% name="two-laps"
def two_laps(number):
    """True poses of a run, poses from odometry, odometry edges, and loops."""
    rng = np.random.default_rng(number)
    odometry, match = np.array([0.1, 0.06, np.radians(5)]), np.array([0.05, 0.05, 0.015])
    truth, poses, edges = [np.zeros(3)], [np.zeros(3)], []
    for k in range(23):
        step = np.array([2.0, 0.0, np.pi / 2 if k % 3 == 2 else 0.0])
        step, z = step, step + odometry * rng.standard_normal(3)
        truth, poses = [*truth, compose(truth[-1], step)], [*poses, compose(poses[-1], z)]
        edges.append((k, k + 1, z, np.diag(1 / odometry**2)))
    truth, loops = np.array(truth), []
    slips = [np.zeros(3)] * 10 + [np.array([2.5, 0.2, 0.1])] * 6 + list(rng.uniform(-2, 2, (2, 3)))
    similar = rng.integers(11, 19) + np.arange(6)
    later = [*rng.integers(11, 24, 10), *similar, *rng.integers(11, 24, 2)]
    for j, slip in zip(later, slips, strict=True):
        i, twin = max(j - 12 + rng.integers(-1, 2), 0), truth[similar[0]]
        believed = compose(compose(twin, slip), between(twin, truth[j]))
        z = between(truth[i], believed) + match * rng.standard_normal(3)
        loops.append((int(i), int(j), z, np.diag(1 / match**2)))
    return truth, np.array(poses), edges, loops


# %% name="mapped"
@attempt
def _():
    def draw(run):
        truth, poses, edges, loops = two_laps(run)
        tracks = {"odometry": poses, "your map": np.asarray(close_loops(poses, edges, loops))}
        shown = {}
        for title, track in tracks.items():
            off = np.sqrt(np.mean(np.sum((track - truth)[:, :2] ** 2, axis=1)))
            name = "naive" if title == "odometry" else "corrected"
            fits = [(i, j) for i, j, z, L in loops if chi2(track, [(i, j, z, L)]) < 16]
            lines = [[*track[i, :2], *track[j, :2]] for i, j in fits]
            shown[f"{title}: {off:.2f} m rms, {len(fits)} of 18 loops agree"] = [
                Poses("truth", truth),
                Poses(name, track),
                Segments("loop", lines),
            ]
        return views.side_by_side(shown, size=(9, 4))[0]

    views.explore(
        draw,
        alt="Two laps: the poses from odometry, the poses of the map, the true poses, and the loops that agree.",
        run=(0, 20, 2),
    )


# %% [markdown]
# If the public pose graph of the Intel Research Lab is on this computer, the last cell optimises its first 300 poses by
# your `step`. It is not judged. Which edges close the loop?


# %% name="intel"
@attempt
def _():
    from slamlab import sources
    from slamlab.posegraph import g2o

    try:
        graph = g2o.load(sources.recording("intel.g2o"))
    except sources.SourceError as missing:
        print(missing)
        return
    found = [(e.i, e.j, e.measured, e.information) for e in graph.edges if max(e.i, e.j) < 300]
    odometry, start = {i: z for i, j, z, _ in found if j == i + 1}, [np.zeros(3)]
    for i in range(299):
        start.append(compose(start[-1], odometry[i]))
    poses = start = np.array(start)
    for _ in range(3):
        poses = step(poses, found)
    shown = {"consecutive edges": Poses("naive", start), "three steps": Poses("corrected", poses)}
    layers = {f"{name}: χ² = {chi2(each.rows, found):.1f}": [each] for name, each in shown.items()}
    fig, _ = views.side_by_side(layers)
    views.show(fig, alt="Poses of a real robot, before and after three Gauss–Newton steps.")


# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then shows the grader's verdict. The grader draws other graphs.
# To map the log of a real robot, run `slamlab data get intel` (3.7 MB) in a terminal, and then
# `slamlab run intel --estimator graph --out map`. With your own log, use its path instead of `intel`.
#
# **Next:** [lesson 16 · Your own SLAM](../notebooks/16_your_own_slam.ipynb) lets you write a whole
# SLAM system.
