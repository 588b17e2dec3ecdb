# %% [markdown]
# # Exercise 13 · Scan matching: ICP
#
# **You will be able to** align two scans whose correspondences are unknown, keep outliers out of the alignment, combine
# walls and odometry in one step with a covariance, and match two scans of which only about half overlaps.
#
# **60 minutes. Before:** lesson [13 · Scan matching: ICP](../notebooks/13_scan_matching.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below it, as often
# as you like. A check tries random point clouds, and special cases that the text allows. If your answer breaks a law, the
# check names the law and the inputs. If it recognises your mistake, it also shows a hint.
# `hint("13-icp")` in a cell of your own asks a guiding question. Tasks 1 to 3 build ICP. Task 4 derives a point-to-line
# step that is not in the lesson. Task 5 is open: any method is allowed, and better results earn more points.
#
# All lengths are in metres, all angles in radians. A point cloud is an array `(n, 2)` with one point per row. A motion is
# the homogeneous matrix
#
# $$T = \begin{bmatrix} \mathrm{Rot} & t\\ 0 & 1\end{bmatrix}$$
#
# of shape `(3, 3)`: it rotates a point by $\mathrm{Rot}$ and then translates it by $t$. A function must not change its
# arguments.

# %%
import numpy as np
from scipy.spatial import cKDTree

from classroom.checks import ask, attempt, check
from slamlab import views
from slamlab.layers import Points, Segments
from slamlab.simulation import RPLIDAR_A2, worlds

# %% [markdown]
# You may use two functions: `carry` transforms a point cloud by a motion, and `nearest` finds the nearest target point of
# each source point.


# %% name="helpers"
def carry(T, points):
    """The points (n, 2), transformed by T (3, 3)."""
    return points @ T[:2, :2].T + T[:2, 2]


def nearest(source, target):
    """For each source point: distance (n,) [m] and row (n,) of the nearest target point."""
    return cKDTree(target).query(source)


# %% [markdown]
# ## 1 · Rigid alignment with known correspondences
#
# Row $i$ of `source`, the point $a_i$, and row $i$ of `target`, the point $b_i$, are a correspondence: both are the same spot.
#
# **Your task.** Return the motion $T$ that minimises
#
# $$\sum_i \left|\mathrm{Rot}\,a_i + t - b_i\right|^2.$$
#
# The translation is given by (13.2). For the rotation you can choose between two methods. In the plane, the arctangent
# (13.4) gives the angle. In any dimension, you can use the singular value decomposition (SVD) of the lesson's first *Deeper*
# section: subtract its centroid from each cloud, compute $M = \sum_i a_i'\,b_i'^{\mathsf T}$ and its singular vectors $U$ and
# $V$, and take $\mathrm{Rot} = V U^{\mathsf T}$.
#
# **A rotation, never a reflection.** A robot scans one straight wall twice. Along the wall the two scans agree. Across it
# there is only noise, and sometimes a reflection fits this noise better than any rotation. Then $V U^{\mathsf T}$ is a
# reflection, and its determinant is −1. No robot can move like that, so your function must return the best *rotation* in that
# case, too. If you use the SVD, see (13.13) for the correction. If you use the arctangent, why can it not give a reflection?
#
# There are at least two correspondences, and the points of a cloud are not all equal. They may lie on one line or far from
# the origin, and their coordinates may be integers (`int`). The check compares your rotation with the best one. It judges
# $t$ by your own rotation: $T$ must map the centroid of the source to that of the target.


# %% name="best-motion"
def best_motion(source, target):
    """The motion that aligns two clouds with known correspondences by least squares.

    source, target : (n, 2) [m], row i of both is correspondence i
    returns T (3, 3), which transforms the source
    """
    ### BEGIN SOLUTION
    a, b = source.mean(axis=0), target.mean(axis=0)
    M = (source - a).T @ (target - b)
    U, _, Vt = np.linalg.svd(M)
    if np.linalg.det(Vt.T @ U.T) < 0:
        Vt[1] *= -1
    T = np.eye(3)
    T[:2, :2] = Vt.T @ U.T
    T[:2, 2] = b - T[:2, :2] @ a
    return T
    ### END SOLUTION


# %%
check("13-best-motion")

# %% [markdown]
# The next cell shows such a wall, with a letter F in front of it. The F is not measured: your $T$ transforms it, too, to show
# the effect of $T$.


# %% name="wall-picture"
@attempt
def _():
    along = np.linspace(-1, 1, 12)
    across = 0.03 * np.array([1, -1, 0, 1, -1, 1, -1, 0, 1, -1, 1, -1])
    wall, again = np.column_stack([along, across]), np.column_stack([along + 0.4, 0.8 - across])
    F = np.array([[0, -0.6, 0, -0.2], [0, -0.2, 0.25, -0.2], [0, -0.4, 0.18, -0.4]])
    T = best_motion(wall, again)
    fig, ax = views.axes(f"det Rot = {np.linalg.det(T[:2, :2]):+.0f}", size=(7, 4.5))
    views.draw(ax, Points("scan", wall), label="wall, first scan", markersize=8)
    views.draw(ax, Points("map", again), label="wall, second scan", markersize=8)
    views.draw(ax, Segments("scan", F), label="F, first scan")
    ends = carry(T, F.reshape(-1, 2)).reshape(-1, 4)
    views.draw(ax, Segments("map", ends), label="F, transformed by T")
    views.legend(ax, loc="lower right")
    views.show(fig, alt="Two scans of a wall, and an F in front of it, transformed by the motion.")


# %% [markdown]
# A rotation leaves the F as it is, on the same side of the wall. A reflection would mirror the F and put it behind the wall,
# although the points of the wall would fit a little better.

# %% [markdown]
# ## 2 · ICP
#
# Now the correspondences are unknown, so ICP uses **the nearest target points**. Each iteration transforms the source by the
# current $T$, finds the nearest target point of each transformed point, computes the best motion of these correspondences,
# and updates $T$ by it.
#
# **Your task.** Return $T$ after exactly the given number of iterations, `iterations`, which may be 0.
#
# In this loop, `best_motion` gets a source that $T$ has already transformed. In which frame is the motion that it returns?
# Is this motion the left or the right factor in the product with $T$?
#
# Source and target have at least two points each, in any order. Their numbers of points may differ. If your
# `best_motion` is wrong, the check of this task uses a correct one in its place.


# %% name="icp"
def icp(source, target, T, iterations):
    """Align a source cloud with a target cloud.

    source : (n, 2) [m];  target : (m, 2) [m], in another order, with another number of points
    T : (3, 3) initial guess of the motion that transforms the source
    iterations : int, number of iterations;  returns T (3, 3) after these iterations
    """
    ### BEGIN SOLUTION
    for _ in range(iterations):
        moved = carry(T, source)
        _, rows = nearest(moved, target)
        T = best_motion(moved, target[rows]) @ T
    return T
    ### END SOLUTION


# %%
check("13-icp")

# %%
ask(
    "ex13-iterations",
    "The next cell uses the two scans of the lesson's polygon. Between them the robot turned by −45° and drove "
    "27 cm. Its odometry is wrong: it measures −35° and 15 cm. **After how many iterations of ICP do you see "
    "no more change?**",
    {
        "one: the best motion is found in closed form": "it is the best motion for correspondences that are mostly wrong.",
        "about five": "the translation is nearly correct by then. The rotation is not: wrong correspondences slow it down in "
        "each iteration.",
        "about fifteen": "the correspondences move along the walls only a little in each iteration, so the rotation "
        "converges slowly.",
        "more than a hundred": "the correspondences can change only finitely often, and here they soon stay the same.",
    },
    right="about fifteen",
)


# %% name="polygon"
def step(turn, distance):
    """The motion of a robot that turns (degrees), then drives straight (metres)."""
    c, s = np.cos(np.radians(turn)), np.sin(np.radians(turn))
    return np.array([[c, -s, distance * c], [s, c, distance * s], [0, 0, 1]])


TRUE, WRONG = step(-45, 0.273), step(-35, 0.150)


def pose(T):
    """x [m], y [m], θ [rad] of a motion."""
    return np.array([T[0, 2], T[1, 2], np.arctan2(T[1, 0], T[0, 0])])


def polygon_scans(seed):
    """Two scans of the polygon, before and after the true motion, each in the robot's frame."""
    rng = np.random.default_rng(seed)
    return [RPLIDAR_A2.scan(worlds.polygon(), pose(T), rng).points() for T in (np.eye(3), TRUE)]


# %% name="iterations" answers="ex13-iterations"
@attempt
def _():
    scans = polygon_scans(seed=1)

    def draw(iterations):
        T = icp(scans[1], scans[0], WRONG, iterations)
        off = pose(T) - pose(TRUE)
        error = f"{1000 * np.hypot(*off[:2]):.0f} mm and {abs(np.degrees(off[2])):.1f}°"
        title = f"iteration {iterations}: error {error}"
        return views.overlay(scans[0], carry(T, scans[1]), title=title)[0]

    views.explore(draw, alt="Both scans after some iterations of ICP.", iterations=(0, 20, 4))


# %% [markdown] answers="ex13-iterations"
# The first two iterations correct most of the translation, but the rotation needs about fifteen. Then hardly anything changes,
# but an error of 9 mm and 0.7° remains. The robot saw some walls from one pose only, and ICP gives their points a correspondence
# all the same.

# %% [markdown]
# ## 3 · A robust kernel
#
# Points that only one scan contains have no true correspondence. ICP gives them one all the same, and it is often a long one.
# The squares give the long ones the most weight. A **robust kernel** $\rho$ replaces the square of the length $e$ by a cost that
# grows more slowly. This is the kernel of Geman and McClure, where $c$ is the length of an ordinary correspondence:
#
# $$\rho(e) = \frac{c^2 e^2}{c^2 + e^2}.$$
#
# The sum of all $\rho(e_i)$ has the same gradient as $\sum_i w_i \left|\mathrm{Rot}\,a_i + t - b_i\right|^2$ with the constant weights
# $w_i = \rho'(e_i)/2e_i$. These depend on $T$. **Iteratively reweighted least squares** computes the weights for the current $T$,
# then minimises the weighted sum for these weights, and repeats this.
#
# **Your task.** Extend ICP by this kernel, with the same $c$ in all iterations. In each one, find all correspondences again, compute
# the weights from their lengths, and update $T$ by the motion that minimises the weighted sum. `best_motion` knows no weights: which parts of its
# derivation in the lesson change? Some correspondences have the length zero. `iterations` may be 0, and $c$ lies between 1 cm and
# 100 m. Each entry of $T$ may have an error of $10^{-5}$ of the largest entry:
#
# | required | points |
# | --- | --- |
# | $T$ after 0 or 1 iterations | 2 |
# | $T$ after more iterations | 2 |


# %% name="robust-icp"
def robust_icp(source, target, T, iterations, c):
    """ICP with the kernel of Geman and McClure, by iteratively reweighted least squares.

    source, target, T, iterations : as for icp;  c : float, length of an ordinary correspondence [m]
    returns T (3, 3)
    """
    ### BEGIN SOLUTION
    for _ in range(iterations):
        moved = carry(T, source)
        distances, rows = nearest(moved, target)
        w = 1 / (1 + (distances / c) ** 2) ** 2
        a, b = w @ moved / w.sum(), w @ target[rows] / w.sum()
        p, q = moved - a, target[rows] - b
        cross, dot = p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0], np.sum(p * q, axis=1)
        angle = np.arctan2(w @ cross, w @ dot)
        step = np.eye(3)
        step[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
        step[:2, 2] = b - step[:2, :2] @ a
        T = step @ T
    return T
    ### END SOLUTION


# %%
check("13-kernel")

# %%
ask(
    "ex13-kernel",
    "These are scans from the same two poses, but about one point in eight of the second scan now belongs to people. The "
    "guess is off by 10° and 12 cm. **With which $c$ is the error of the match the smallest?**",
    {
        "1 cm, the noise of the ranges": "with the guess, nearly all correspondences are longer, so nearly all weights are close "
        "to zero. Those that fit already dominate, and the scan hardly moves.",
        "5 cm": "the people have weights near zero, and the correspondences of the guess still have enough weight to "
        "converge to the truth.",
        "1 m, so that no true correspondence is lost": "then the people have nearly the full weight, as in plain ICP.",
    },
    right="5 cm",
)


# %% name="people" answers="ex13-kernel"
@attempt
def _():
    scans = polygon_scans(seed=1)
    people = np.random.default_rng(2).uniform([0.1, 0.5], [0.6, 0.9], (60, 2))
    with_people = np.vstack([scans[1], people])
    for c in (0.01, 0.02, 0.05, 0.1, 0.2, 1.0, 10.0):
        off = pose(robust_icp(with_people, scans[0], WRONG, 60, c)) - pose(TRUE)
        print(
            f"c = {c:5.2f} m: error {1000 * np.hypot(*off[:2]):4.0f} mm "
            f"and {abs(np.degrees(off[2])):4.1f}°"
        )


# %% [markdown] answers="ex13-kernel"
# If $c$ is large, the kernel is a square, and the people pull the scan away from the truth. If $c$ is small, the correspondences
# that fit already outweigh the others, so an alignment of them changes little. Some programs therefore begin with a large $c$ and
# reduce it in each iteration.

# %% [markdown]
# ## 4 · A point-to-line step and its covariance
#
# The distance of a point from its *partner*, the nearest target point, contains no information *along* a wall. So point-to-line
# ICP uses only the distance **across** the wall, (13.6). The lesson computes a step in the target's frame, (13.8). There, all correspondences have the same
# weight, and the walls are the only information. A filter or a pose graph needs more. Derive a step with three changes:
#
# - The correction $\delta = (d_x, d_y, d_\theta)$ is **in the robot's frame**, which is the frame of the source. $T$ becomes
#   $T\,D(\delta)$, where $D(\delta)$ rotates by $d_\theta$ about the robot and translates by $d = (d_x, d_y)$. The
#   residual of correspondence $i$ is then
#
# $$e_i(\delta) = n_i^{\mathsf T}\left(\mathrm{Rot}\,\bigl(\mathrm{Rot}(d_\theta)\,a_i + d\bigr) + t - b_i\right).$$
#
# - Far points are measured less accurately than near ones. So residual $i$ has a standard deviation $\sigma_i$ of its own.
# - $T$ is measured by **odometry**, and the covariance of its error is known. This is the prior: before the walls are used,
#   $\delta$ has the mean 0 and the covariance $Q$.
#
# **Your task.** Linearise the residuals at $\delta = 0$: $e_i(\delta) \approx e_i + J_i\,\delta$. Return the $\delta$ that
# minimises
#
# $$\sum_i \frac{(e_i + J_i\,\delta)^2}{\sigma_i^2} \;+\; \delta^{\mathsf T} Q^{-1}\,\delta.$$
#
# Return also the covariance $P$ of the error that remains: the inverse of the information matrix of walls and odometry together.
#
# In a bare corridor all normals are parallel. Is the matrix that you invert singular then? Is it singular without any
# correspondence?
#
# Normals have the length 1, and may point to either side of the wall. All $\sigma_i$ are positive, and $Q$ is invertible. The
# errors of $x$, $y$ and $\theta$ may be correlated. There may be any number of correspondences, also one or none, and coordinates
# may be integers (`int`). Some targets have the coordinates of surveyors, up to $10^7$ m.
#
# Only rounding errors are allowed. Let $\kappa$ be the condition number of $P$, and $\ell$ the largest entry of `T` and `target`.
# A complex step is exact, and you may use it. A difference quotient has larger errors than these:
#
# | entry of | largest error | and at most |
# | --- | --- | --- |
# | $\delta$ | $3\cdot 10^{-14}\,\kappa\,\ell$ | $10^{-6}$ of the largest entry |
# | $P$ | $10^{-13}\,\kappa\,\ell$ of the largest entry | $10^{-8}$ of the largest entry |


# %% name="line-step"
def line_step(source, target, normals, sigma, T, Q):
    """The best small correction of T in the robot's frame, and its covariance.

    source : (n, 2) points a in the robot's frame [m];  target : (n, 2) their partners b [m]
    normals : (n, 2) of the walls at the partners, in the target's frame;  sigma : (n,) [m]
    T : (3, 3) motion measured by odometry;  Q : (3, 3) prior covariance of δ
    returns delta (3,) [m, m, rad] and P (3, 3)
    """
    ### BEGIN SOLUTION
    Rot, t = T[:2, :2], T[:2, 2]
    e = np.sum(normals * (source @ Rot.T + t - target), axis=1)
    seen = normals @ Rot
    lever = source[:, 0] * seen[:, 1] - source[:, 1] * seen[:, 0]
    J = np.column_stack([seen, lever])
    w = np.diag(1 / sigma**2)
    P = np.linalg.inv(np.linalg.inv(Q) + J.T @ w @ J)
    delta = -P @ J.T @ w @ e
    return delta, P
    ### END SOLUTION


# %%
check("13-line-step")

# %%
ask(
    "ex13-side",
    "A robot drives along a corridor in the direction of $x$. The standard deviations of its odometry are 20 cm for $x$ and for "
    "$y$, and 4° for $\\theta$. That of each point of a wall is 2 cm. **Which of the three unknowns does a "
    "single wall beside the robot correct?**",
    {
        "$y$ alone, the distance from it": "points in front and behind also contain information about the direction of the wall.",
        "$y$ and $\\theta$": "the wall determines the robot's distance from it and the heading relative to it. A motion along "
        "the wall changes no distance across it.",
        "all three": "if the robot moves along the wall, no distance across it changes.",
    },
    right="$y$ and $\\theta$",
)


# %% name="corridor" answers="ex13-side"
@attempt
def _():
    rng, Q = np.random.default_rng(1), np.diag([0.2, 0.2, np.radians(4)]) ** 2
    left = np.column_stack([rng.uniform(-3, 3, 15), np.full(15, 1.0)])
    right, end = left * [1, -1], np.column_stack([np.full(5, 3.0), rng.uniform(-1, 1, 5)])
    across, ahead = np.tile([0.0, 1.0], (15, 1)), np.tile([1.0, 0.0], (5, 1))
    walls = {
        "no wall": (left[:0], across[:0]),
        "one wall beside it": (left, across),
        "a corridor": (np.vstack([left, right]), np.vstack([across, across])),
        "with an end wall": (np.vstack([left, right, end]), np.vstack([across, across, ahead])),
    }
    for name, (points, normals) in walls.items():
        sigma = np.full(len(points), 0.02)
        _, P = line_step(points, points, normals, sigma, np.eye(3), Q)
        x, y, turn = np.sqrt(np.diag(P))
        print(f"{name:>20}: x {100 * x:4.1f} cm, y {100 * y:4.1f} cm, θ {np.degrees(turn):4.2f}°")


# %% [markdown] answers="ex13-side"
# Along the corridor the standard deviation remains that of odometry until the robot sees the wall at the end: the side walls
# contain no information about this direction, and $P$ shows this. Your code did not have to find the degenerate direction.
# Odometry contributes the information that the walls do not contain.

# %% [markdown]
# ## 5 · Partial overlap and a bad initial guess (open)
#
# A robot with a lidar whose field of view is 240° has turned by 60° to 115°. Boxes hide other parts of the room. So only about half
# of the two scans overlaps. The wheels slipped: the guess has an error of 50 cm to 120 cm and of 30° to 90°. From there, ICP
# converges to a wrong local minimum.
#
# **Your task.** Match 16 pairs of scans, by any method. A match is *correct* if its error is less than 20 cm and less than
# 5°. It is *accurate* if its error is less than 1.5 cm and less than 0.5°. A $T$ that is not a rigid motion (within
# $10^{-6}$) is neither. Each row of the table that you reach adds its points, whether or not you reach the others:
#
# | matches, of 16 | points |
# | --- | --- |
# | at least 4 correct | 0.5 |
# | at least 8 correct | 1 |
# | at least 12 correct | 2 |
# | at least 9 accurate | 1.5 |
#
# Together with 0.5 points for unchanged arguments, these are the 5.5 points of the task. The noise of the ranges has a
# standard deviation of 1 cm. Here are some ideas:
#
# - Start from many rotations, and choose the best result. Which number identifies it, when half of the points have no true
#   correspondence?
# - Suppose that the rotation is correct. Then each pair of a source point and a target point votes for one translation, and there
#   are thousands of such pairs. Which translation gets the most votes?
# - Finish with point-to-line steps.
#
# Both clouds are in the order of the beams, each in the frame of the robot at that time. Their sizes may differ, and each has
# at least 90 points. A room is about 7 m wide and has no right angles, and three boxes stand in it. The check also tries two
# more pairs, with a nearly correct guess and more overlap. The first row of the table also requires that at least one of
# these two matches is correct. The other rows do not depend on them. Aim at 0.05 s per match: the check stops after 10 s. You
# may use two functions:


# %% name="ready"
def turned(angle):
    """The rotation (2, 2) by an angle [rad]."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s], [s, c]])


def normals_of(points):
    """(n, 2) unit normals, each perpendicular to the line through the points before and after it."""
    along = np.gradient(points, axis=0)
    return along @ turned(np.pi / 2).T / np.hypot(*along.T)[:, None]


# %% name="match"
def match(source, target, T):
    """The motion between two scans of which about half overlaps.

    source : (n, 2), target : (m, 2) [m], in the order of the beams
    T : (3, 3) bad initial guess of the motion that transforms the source
    returns T (3, 3)
    """
    ### BEGIN SOLUTION
    tree, normals = cKDTree(target), normals_of(target)

    def most_wanted(Rot, cell=0.3):
        """How many pairs of points ask for one shift, and which shift most of them ask for."""
        shifts = (target[:, None] - source[::3] @ Rot.T).reshape(-1, 2)
        cells = np.floor(shifts / cell).astype(int)
        first = cells.min(axis=0)
        i, j = (cells - first).T
        width = j.max() + 1
        votes = np.bincount(i * width + j)
        best = votes.argmax()
        return votes[best], (np.array(divmod(best, width)) + first + 0.5) * cell

    def slid(Rot, shift, gates):
        """Steps across the walls, each with the pairs that are shorter than its gate."""
        for gate in gates:
            arm = source @ Rot.T
            distances, rows = tree.query(arm + shift)
            near = distances < gate
            arm, n = arm[near], normals[rows[near]]
            e = np.sum(n * (arm + shift - target[rows[near]]), axis=1)
            J = np.column_stack([n, arm[:, 0] * n[:, 1] - arm[:, 1] * n[:, 0]])
            A = J.T @ J + 1e-3 * np.eye(3)  # also where no wall fixes a direction
            delta = -np.linalg.solve(A, J.T @ e)
            Rot, shift = turned(delta[2]) @ Rot, shift + delta[:2]
        return Rot, shift

    voted = []
    for k in range(48):
        Rot = turned(2 * np.pi * k / 48)
        votes, shift = most_wanted(Rot)
        voted.append((votes, k, Rot, shift))
    ends = []
    for _, k, Rot, shift in sorted(voted)[-8:]:
        Rot, shift = slid(Rot, shift, (0.5, 0.4, 0.3, 0.25, 0.2))
        distances, _ = tree.query(source @ Rot.T + shift)
        ends.append((np.sum(distances < 0.1), k, Rot, shift))
    _, _, Rot, shift = max(ends)
    Rot, shift = slid(Rot, shift, (0.15, 0.12, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1))
    T = np.eye(3)
    T[:2, :2], T[:2, 2] = Rot, shift
    return T
    ### END SOLUTION


# %%
check("13-overlap")

# %% [markdown]
# The next cell shows such a pair of scans, with the second scan transformed by the guess, by the result of `robust_icp` from this
# guess, and by the result of your `match`.


# %% name="half"
@attempt
def _():
    rng = np.random.default_rng(3)
    room = [[-3, -2, 3.4, -2.5], [3.4, -2.5, 2.6, 2.2], [2.6, 2.2, -0.5, 3.2], [-0.5, 3.2, -3, -2]]
    box = [[1, 0.8, 1.6, 1], [1.6, 1, 1.4, 1.5], [1.4, 1.5, 0.8, 1.3], [0.8, 1.3, 1, 0.8]]
    world, ahead = worlds.World(np.array(room + box)), np.radians(np.linspace(-120, 120, 100))

    def look(x, y, turn):
        r = world.cast([x, y], np.radians(turn) + ahead) + 0.01 * rng.standard_normal(100)
        return r[:, None] * np.column_stack([np.cos(ahead), np.sin(ahead)])

    before, now = look(0, 0, 0), look(0.3, 0.2, 90)
    guess = step(30, 0.7)
    shown = {
        "guess": guess,
        "robust ICP": robust_icp(now, before, guess, 60, 0.3),
        "your match": match(now, before, guess),
    }
    layers = {
        name: [Points("map", before), Points("scan", carry(T, now))] for name, T in shown.items()
    }
    fig, _ = views.side_by_side(layers)
    views.show(
        fig, alt="The second scan over the first: by the guess, by robust ICP, and by your match."
    )


# %% [markdown]
# If the log of lesson 01 is on this computer, the last cell matches its first 200 scans by your `robust_icp`, with odometry as
# the guess, and draws the points along both trajectories. It is not judged. Which walls appear twice at the end of the lap?


# %% name="intel"
@attempt
def _():
    from slamlab import sources

    try:
        log = sources.open(sources.recording("intel"))
    except sources.SourceError as missing:
        print(missing)
        return
    motions, maps = {"odometry": np.eye(3), "your matches": np.eye(3)}, {}
    before = None
    for reading, _ in zip(log, range(200), strict=False):
        scan, (x, y, turn) = reading.scan.points(), reading.odometry
        T = step(0, 0)
        T[:2, :2], T[:2, 2] = turned(turn), (x, y)
        for name in motions if before is not None else ():
            better = robust_icp(scan, before, T, 30, 0.2) if name == "your matches" else T
            motions[name] = motions[name] @ better
        for name, motion in motions.items():
            maps.setdefault(name, []).append(carry(motion, scan)[::4])
        before = scan
    layers = {name: [Points("scan", np.vstack(points))] for name, points in maps.items()}
    fig, _ = views.side_by_side(layers)
    views.show(fig, alt="The points of all scans along odometry, and along your matches.")


# %% [markdown]
# A SLAM system needs matches with a covariance, and matches from any initial guess. The library's `match` provides both. It judges
# its own result: if too few points lie on the walls of the other scan, it searches all poses.
#
# ## Done?
#
# Save the notebook. The cell below then shows the grader's verdict; the grader draws other inputs.
#
# **Next:** the matcher uses only the previous scan. Each match has a small error, and the errors accumulate like those of odometry,
# only more slowly. [Lesson 14](../notebooks/14_devices_and_live_slam.ipynb) puts ICP on a live robot, and
# [lesson 15](../notebooks/15_pose_graph_slam.ipynb) closes the loop.
