# %% [markdown]
# # Exercise 13 · Scan matching
#
# **You will be able to** lay one scan over another without being told which points belong together, keep people who walk
# through the picture from spoiling it, say how sure a match is and in which direction it knows nothing, and find home
# although half of what one scan saw is hidden from the other.
#
# **60 minutes. Before:** lesson [13 · Scan matching](../notebooks/13_scan_matching.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, and run the check below
# it, as often as you like. A check tries random clouds. It says which law is broken, by which
# input, and, if it recognises the mistake, what the mistake is. Tasks 1 to 3 build ICP. Task 4
# takes the step across walls to a case that the lesson has not treated. Task 5 is open: any method
# is allowed, and better ones earn more.
#
# All lengths are in metres and all angles in radians. A cloud is an array `(n, 2)`, one point a row. A motion is the homogeneous
# matrix
#
# $$T = \begin{bmatrix} \mathrm{Rot} & t\\ 0 & 1\end{bmatrix},$$
#
# with the shape `(3, 3)`: it turns a point by $\mathrm{Rot}$ and then shifts it by $t$. No function may change its arguments.

# %%
import numpy as np
from scipy.spatial import cKDTree

from slamlab import views, worlds
from slamlab.checks import ask, attempt, check
from slamlab.layers import Points, Segments
from slamlab.simulation import RPLIDAR_A2

# %% [markdown]
# Here are two helpers to use as you like. One carries a cloud by a motion; the other finds, for every source point, the nearest
# target point.


# %% name="helpers"
def carry(T, points):
    """The points (n, 2), turned and shifted by T (3, 3)."""
    return points @ T[:2, :2].T + T[:2, 2]


def nearest(source, target):
    """For each source point: distance [m] (n,) and row (n,) of the nearest target point."""
    return cKDTree(target).query(source)


# %% [markdown]
# ## 1 · The best motion of paired points
#
# Row $i$ of `source`, the point $a_i$, and row $i$ of `target`, the point $b_i$, are the same spot. Return the motion $T$ that makes
#
# $$\sum_i \left|\mathrm{Rot}\,a_i + t - b_i\right|^2$$
#
# as small as it can be. For the shift, use (13.2). For the rotation you have the choice. In the plane there is the
# arctangent (13.4). In any dimension there is the singular value decomposition of the lesson's first *Deeper* section: count
# both clouds from their centroids, sum $M = \sum_i a_i'\,b_i'^{\mathsf T}$, find its singular vectors $U$ and $V$, and turn by
# $V U^{\mathsf T}$.
#
# **A rotation, never a mirror.** A robot looks at one straight wall, twice. Along the wall the points fit. Across it there is
# nothing but noise, and sometimes the noise fits better when the wall is turned inside out. Then $V U^{\mathsf T}$ is a mirror,
# and its determinant is −1. No robot moves like that, so your function must return the best *rotation* in that case, too. If
# you decompose, (13.13) tells what to change. If you take the arctangent, ask yourself why it cannot happen.
#
# There are at least two pairs, and not all points of a cloud lie in one spot. They may lie on one line, or far from the origin,
# and they may be whole numbers (`int`).


# %% name="best-motion"
def best_motion(source, target):
    """The motion that lays paired points over each other with the least sum of squares.

    source, target : (n, 2) [m], paired by row;  returns T (3, 3), which carries the source
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
# Here is such a wall, with an F in front of it. Nobody measured the F: your $T$ carries it along, to show what $T$ does.


# %% name="wall-picture"
@attempt
def _():
    along = np.linspace(-1, 1, 12)
    across = 0.03 * np.array([1, -1, 0, 1, -1, 1, -1, 0, 1, -1, 1, -1])
    wall, again = np.column_stack([along, across]), np.column_stack([along + 0.4, 0.8 - across])
    F = np.array([[0, -0.6, 0, -0.2], [0, -0.2, 0.25, -0.2], [0, -0.4, 0.18, -0.4]])
    T = best_motion(wall, again)
    fig, ax = views.axes(f"det Rot = {np.linalg.det(T[:2, :2]):+.0f}", size=(7, 4.5))
    views.draw(ax, Points("scan", wall), label="wall, first look", markersize=8)
    views.draw(ax, Points("map", again), label="wall, second look", markersize=8)
    views.draw(ax, Segments("scan", F), label="F, first look")
    ends = carry(T, F.reshape(-1, 2)).reshape(-1, 4)
    views.draw(ax, Segments("map", ends), label="F, carried by T")
    views.legend(ax, loc="lower right")
    views.show(fig, alt="Two looks at a wall, and an F in front of it, carried by the motion.")


# %% [markdown]
# With a rotation the F stays an F, on the same side of the wall. A mirror would turn it over and put it behind the wall, although
# the points of the wall itself would fit a little better.

# %% [markdown]
# ## 2 · ICP
#
# Now nobody tells which points belong together, so take **the nearest ones** for pairs. Find the best motion of these pairs, move the
# source, and pair anew, from where the source lies now. Return $T$ after exactly the given number of rounds, which may be 0.
#
# Mind that your `best_motion` gets a source that $T$ has carried already. In whose frame is the motion that it finds, and on which
# side of $T$ does it belong?
#
# Source and target have at least two points, in any order. Either may have more than the other.


# %% name="icp"
def icp(source, target, T, rounds):
    """Lay a source cloud over a target cloud.

    source : (n, 2) [m];  target : (m, 2) [m], another number of points in another order
    T : (3, 3) first guess of the motion that carries the source;  rounds : int
    returns T (3, 3) after so many rounds
    """
    ### BEGIN SOLUTION
    for _ in range(rounds):
        moved = carry(T, source)
        _, rows = nearest(moved, target)
        T = best_motion(moved, target[rows]) @ T
    return T
    ### END SOLUTION


# %%
check("13-icp")

# %%
ask(
    "ex13-rounds",
    "Here are the two scans of the lesson's polygon. Between them the robot turned by −45° and drove "
    "27 cm. Its wrong odometry says −35° and 15 cm. **How many rounds of ICP will it take until you "
    "see no more change?**",
    {
        "one: the best motion is found in closed form": "it is the best for pairs that are mostly wrong.",
        "about five": "the shift is nearly right by then. The turn is not: each round's pairs hold the cloud back.",
        "about fifteen": "the nearest points slip along the walls only a little in each round, so the turn comes slowly.",
        "more than a hundred": "pairs change only finitely often, and here they soon settle.",
    },
    right="about fifteen",
)


# %% name="polygon"
def step(turn, distance):
    """The motion of a robot that turns (degrees), then drives (metres)."""
    c, s = np.cos(np.radians(turn)), np.sin(np.radians(turn))
    return np.array([[c, -s, distance * c], [s, c, distance * s], [0, 0, 1]])


TRUE, WRONG = step(-45, 0.273), step(-35, 0.150)


def pose(T):
    """x [m], y [m], θ [rad] of a motion."""
    return np.array([T[0, 2], T[1, 2], np.arctan2(T[1, 0], T[0, 0])])


def polygon_scans(seed):
    """Two scans of the polygon, before and after the true step, each in the robot's frame."""
    rng = np.random.default_rng(seed)
    return [RPLIDAR_A2.scan(worlds.polygon(), pose(T), rng).points() for T in (np.eye(3), TRUE)]


# %% name="rounds" answers="ex13-rounds"
@attempt
def _():
    scans = polygon_scans(seed=1)

    def draw(rounds):
        T = icp(scans[1], scans[0], WRONG, rounds)
        off = pose(T) - pose(TRUE)
        error = f"{1000 * np.hypot(*off[:2]):.0f} mm and {abs(np.degrees(off[2])):.1f}° off"
        title = f"round {rounds}: {error}"
        return views.overlay(scans[0], carry(T, scans[1]), title=title)[0]

    views.explore(draw, alt="Second scan over the first after some rounds.", rounds=(0, 20, 4))


# %% [markdown] answers="ex13-rounds"
# Two rounds put most of the shift right, while the turn takes some fifteen. Then hardly anything moves any more, yet 9 mm and 0.7° are left.
# Some walls were seen from one place only, and their points are paired all the same.

# %% [markdown]
# ## 3 · Trimmed ICP
#
# Points that only one scan saw have no partner. They get one all the same, far away. So sort the pairs by their length and fit
# only the **share** of them that is shortest. Seek the pairs and sort them anew in every round.
#
# There are as many pairs as source points. Of $n$ pairs keep `share` · $n$, rounded down or up, as you like; this is never less
# than two.


# %% name="trimmed-icp"
def trimmed_icp(source, target, T, rounds, share):
    """ICP that fits only the shortest pairs.

    source, target, T, rounds : as for icp
    share : float between 0 and 1, how many of the pairs to keep;  returns T (3, 3)
    """
    ### BEGIN SOLUTION
    keep = int(share * len(source))
    for _ in range(rounds):
        moved = carry(T, source)
        distances, rows = nearest(moved, target)
        kept = np.argsort(distances)[:keep]
        T = best_motion(moved[kept], target[rows[kept]]) @ T
    return T
    ### END SOLUTION


# %%
check("13-trimmed")

# %%
ask(
    "ex13-trim",
    "These are the same two places, but about one point in eight of the second scan is now of people. "
    "**Which share of the pairs is best kept?**",
    {
        "all: the more pairs, the better": "the points of people have partners on some wall, and pull at them.",
        "some 50 to 80 %": "that leaves out the people, and what only one scan saw. What is left is enough to pull the cloud home.",
        "the best 20 %: the shortest pairs are the surest": "the shortest pairs are those that fit already. With so few of them nothing pulls any more.",
    },
    right="some 50 to 80 %",
)


# %% name="people" answers="ex13-trim"
@attempt
def _():
    scans = polygon_scans(seed=1)
    people = np.random.default_rng(2).uniform([0.1, 0.5], [0.6, 0.9], (60, 2))
    crowd = np.vstack([scans[1], people])
    for share in (1.0, 0.95, 0.9, 0.8, 0.7, 0.5, 0.2):
        off = pose(trimmed_icp(crowd, scans[0], WRONG, 60, share)) - pose(TRUE)
        print(
            f"share {share:4.2f}: {1000 * np.hypot(*off[:2]):4.0f} mm "
            f"and {abs(np.degrees(off[2])):4.1f}° off"
        )


# %% [markdown] answers="ex13-trim"
# Keeping everything is bad, and keeping too little is bad as well. The shortest pairs are those that fit already, so with too
# few of them nothing pulls any more.

# %% [markdown]
# ## 4 · A step across walls, and how sure it is
#
# How far a point lies from its partner *along* a wall means nothing, so we count the distance **across** the wall alone, (13.6).
# The lesson takes a step in the target's frame, (13.8), where all pairs count alike and nothing is known but the walls. A
# filter or a graph of poses asks for more. So derive three things anew:
#
# - The correction $\delta = (d_x, d_y, d_\theta)$ is wanted **as the robot sees it**, in the source's own frame. $T$ becomes
#   $T\,D(\delta)$, where $D(\delta)$ turns by $d_\theta$ about the robot and shifts by $d = (d_x, d_y)$, both in the robot's
#   frame. The distance of pair $i$ across its wall is then
#
# $$e_i(\delta) = n_i^{\mathsf T}\left(\mathrm{Rot}\,\bigl(\mathrm{Rot}(d_\theta)\,a_i + d\bigr) + t - b_i\right).$$
#
# - Far points are measured worse than near ones. Pair $i$ errs by a standard deviation $\sigma_i$ of its own.
# - $T$ is not just any guess. **Odometry** told it, and it knows how far it may be off. Before we look at a wall, $\delta$ has the
#   mean 0 and the covariance $Q$.
#
# Take $e_i(\delta) \approx e_i + J_i\,\delta$ near $\delta = 0$, and return the $\delta$ that makes
#
# $$\sum_i \frac{(e_i + J_i\,\delta)^2}{\sigma_i^2} \;+\; \delta^{\mathsf T} Q^{-1}\,\delta$$
#
# as small as it can be. Return with it the covariance $P$ of what is left in doubt: the inverse of all the information that walls
# and odometry have together.
#
# In a bare corridor all normals point across. Will you have to invert a singular matrix? And what if there is no pair at all?
#
# Normals have the length 1; it does not matter to which side of its wall a normal points. All
# $\sigma_i$ are positive, and $Q$ has an inverse; errors of $x$, $y$ and $\theta$ may be
# correlated. There may be any number of pairs, also one or none, and coordinates may be whole
# numbers (`int`).


# %% name="line-step"
def line_step(source, target, normals, sigma, T, Q):
    """The best small correction of T, as the robot sees it, and its covariance.

    source : (n, 2) points a in the robot's frame [m];  target : (n, 2) b, their partners [m]
    normals : (n, 2) of the walls at the partners, in the target's frame;  sigma : (n,) [m]
    T : (3, 3) motion told by odometry;  Q : (3, 3) covariance of its error δ
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
    "A robot drives along a corridor. Its wheels may be off by 20 cm along $x$ and along $y$, and by "
    "4°. Each point of a wall is known to 2 cm. **Which of the three numbers does one wall at its "
    "side mend?**",
    {
        "$y$ alone, the distance from it": "points in front and behind say how the wall runs, too.",
        "$y$ and $\\theta$": "how far the wall is, and how it runs. Along the wall no distance across it says anything.",
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
        "one wall at its side": (left, across),
        "a corridor": (np.vstack([left, right]), np.vstack([across, across])),
        "and its end": (np.vstack([left, right, end]), np.vstack([across, across, ahead])),
    }
    for name, (points, normals) in walls.items():
        sigma = np.full(len(points), 0.02)
        _, P = line_step(points, points, normals, sigma, np.eye(3), Q)
        x, y, turn = np.sqrt(np.diag(P))
        print(f"{name:>20}: x {100 * x:4.1f} cm, y {100 * y:4.1f} cm, θ {np.degrees(turn):4.2f}°")


# %% [markdown] answers="ex13-side"
# The doubt of the wheels along the corridor stays exactly as it was, until the wall at its end is
# seen: no side wall says anything about it, and $P$ shows this. You did not have to look for that
# direction or to name it. Odometry fills in what the walls do not tell.

# %% [markdown]
# ## 5 · Half an overlap and a bad guess (open)
#
# A robot with a lidar that sees 240° has turned by 60° to 115°. So about half of what it sees now
# it has not seen before, and boxes hide much of the rest. Its odometry slipped: the guess is off by
# 50 cm to 120 cm and by 30° to 90°. ICP goes downhill from where it starts, and from there it goes
# into the wrong valley.
#
# **Your task.** Solve as many of 16 as you can, by any method. A match is *home* when it is off by less than 20 cm and 5°. There
# are points for four, for eight and for twelve that are home, and for nine that are off by less than 1.5 cm and 0.5° only. The ranges err by
# 1 cm. Here are some ideas:
#
# - Start from many turns and choose the best end. What number tells the best one, when half of the points have no partner?
# - Suppose that the turn is right. Then each pair of a source point and a target point asks for a shift, and there are thousands of
#   such pairs. Which shift do most of them ask for?
# - Finish across the walls.
#
# Both clouds come in the order of the beams, each in its robot's frame. They may differ in size, and each has 90 points at
# least. Rooms are about 7 m wide and have no right angles; three boxes stand about. In one more try the guess is nearly right, and
# more points are shared. Aim at 0.05 s a match: the check stops after 10 s. Here are two functions to use as you like.


# %% name="ready"
def turned(angle):
    """The rotation (2, 2) by an angle [rad]."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s], [s, c]])


def normals_of(points):
    """(n, 2) unit normals: each across the line through the points before and after it."""
    along = np.gradient(points, axis=0)
    return along @ turned(np.pi / 2).T / np.hypot(*along.T)[:, None]


# %% name="match"
def match(source, target, T):
    """The motion between two scans that share about half of what they see.

    source : (n, 2), target : (m, 2) [m], in the order of the beams
    T : (3, 3) a bad first guess of the motion that carries the source
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
# Here is one such pair of scans: the second scan as the guess lays it, as `trimmed_icp` leaves it from there, and as your `match` lays
# it.


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
        "trimmed ICP": trimmed_icp(now, before, guess, 60, 0.6),
        "your match": match(now, before, guess),
    }
    layers = {
        name: [Points("map", before), Points("scan", carry(T, now))] for name, T in shown.items()
    }
    fig, _ = views.side_by_side(layers)
    views.show(
        fig, alt="The second scan over the first: by the guess, by trimmed ICP, by your match."
    )


# %% [markdown]
# A SLAM needs matches that know how sure they are, and matches that find home from anywhere. The package's `match` does both. It judges
# itself: where few points lie on the walls of the other scan, it searches on.
#
# ## Done?
#
# Save the notebook. The cell below then says what the grader will say about it; the grader draws other inputs.
#
# **Next:** the matcher knows only the scan before. Every match is a little off, and the errors add up, as those of odometry did, only
# more slowly. [Lesson 14](../notebooks/14_the_emir_system.ipynb) drives a live robot, and
# [lesson 15](../notebooks/15_closing_the_loop.ipynb) closes the loop.
