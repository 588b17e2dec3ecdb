# %% [markdown]
# # Exercise 13 · Scan matching
#
# **You will be able to** lay one scan over another without being told which points belong
# together, keep people who walk through the picture from spoiling it, and join a row of scans to a
# map that is right although the odometry is not.
#
# **60 minutes. Before:** lesson [13 · Scan matching](../notebooks/13_scan_matching.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it, as often as you like. A check tries random clouds and says which law is broken, and what the
# mistake is where it knows it.
#
# Metres and radians. A cloud is `(n, 2)`, one point a row. A motion is a homogeneous matrix
# `T = [[R, t], [0, 1]]`, `(3, 3)`: it turns a point by R and shifts it by t.

# %%
import numpy as np
from scipy.spatial import cKDTree

from slamlab import views, worlds
from slamlab.checks import attempt, check
from slamlab.layers import Points, Poses, Segments
from slamlab.simulation import RPLIDAR_A2

# %% [markdown]
# Two helpers to use as you like: one carries a cloud by a motion, one finds for every source point
# the nearest target point.


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
# Row i of `source` and row i of `target` are the same spot. Return the T that makes
#
# $$\sum_i \left|R\,a_i + t - b_i\right|^2$$
#
# as small as it can be. The lesson's recipe: take the centroids off both clouds, sum
# $H = \sum_i a_i'\,b_i'^{\mathsf T}$, decompose it, $H = U S V^{\mathsf T}$, and turn by
# $R = V U^{\mathsf T}$. What is left for t?


# %% name="best-motion"
def best_motion(source, target):
    """The motion that lays paired points over each other with the least sum of squares.

    source, target : (n, 2) [m], paired by row;  returns T (3, 3), which carries the source
    """
    ### BEGIN SOLUTION
    a, b = source.mean(axis=0), target.mean(axis=0)
    H = (source - a).T @ (target - b)
    U, _, Vt = np.linalg.svd(H)
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
# ## 2 · A rotation, never a mirror
#
# A robot looks at one straight wall, twice. Along the wall the points fit; across it there is
# nothing but noise, and sometimes the noise fits better when the wall is turned inside out. Then
# $V U^{\mathsf T}$ is a mirror: its determinant is −1. No robot moves like that.
#
# **Your task:** make `best_motion` above give the best *rotation* in that case, too. The lesson
# shows what to change. Then come back here.

# %%
check("13-mirror")

# %% [markdown]
# Here is such a wall, with an F in front of it. The F was not measured: it is carried along by your
# T, to show what T does. **Before you run it:** how would a mirror show?


# %% name="wall-picture"
@attempt
def _():
    along = np.linspace(-1, 1, 12)
    across = 0.03 * np.array([1, -1, 0, 1, -1, 1, -1, 0, 1, -1, 1, -1])
    wall, again = np.column_stack([along, across]), np.column_stack([along + 0.4, 0.8 - across])
    F = np.array([[0, -0.6, 0, -0.2], [0, -0.2, 0.25, -0.2], [0, -0.4, 0.18, -0.4]])
    T = best_motion(wall, again)
    fig, ax = views.axes(f"det R = {np.linalg.det(T[:2, :2]):+.0f}", size=(7, 4.5))
    views.draw(ax, Points("scan", wall), label="wall, first look", markersize=8)
    views.draw(ax, Points("map", again), label="wall, second look", markersize=8)
    views.draw(ax, Segments("scan", F), label="F, first look")
    ends = carry(T, F.reshape(-1, 2)).reshape(-1, 4)
    views.draw(ax, Segments("map", ends), label="F, carried by T")
    ax.legend(loc="lower right")
    views.show(fig, alt="Two looks at a wall, and an F in front of it, carried by the motion.")


# %% [markdown]
# With a rotation the F stays an F, on the same side of the wall. A mirror turns it over and puts it
# behind the wall, although the wall's own points fit a little better.

# %% [markdown]
# ## 3 · ICP
#
# Now nobody tells which points belong together. Guess: **the nearest ones**. Fit, and guess again,
# from where the source lies now. Return T after the given number of rounds.


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

# %% [markdown]
# Tuček's polygon, scanned from two places. Between them the robot turned by −45° and drove 27 cm.
# His wrong odometry says −35° and 15 cm.
#
# **Before you run it:** how many rounds will it take until you see no more change? Then move the
# slider.


# %% name="polygon"
def step(turn, distance):
    """The motion of a robot that turns (degrees), then drives (metres)."""
    c, s = np.cos(np.radians(turn)), np.sin(np.radians(turn))
    return np.array([[c, -s, distance * c], [s, c, distance * s], [0, 0, 1]])


TRUE = [step(-45, 0.273), step(-45, 0.325), step(0, 0.188)]
WRONG = [step(-35, 0.150), step(-60, 0.450), step(20, 0.100)]


def pose(T):
    """x [m], y [m], θ [rad] of a motion."""
    return np.array([T[0, 2], T[1, 2], np.arctan2(T[1, 0], T[0, 0])])


def polygon_scans(seed):
    """The true poses (4, 3, 3) and the four scans of the polygon, each in the robot's frame."""
    rng, poses = np.random.default_rng(seed), [np.eye(3)]
    for T in TRUE:
        poses.append(poses[-1] @ T)
    return poses, [RPLIDAR_A2.scan(worlds.polygon(), pose(T), rng).points() for T in poses]


# %% name="rounds"
@attempt
def _():
    _, scans = polygon_scans(seed=1)

    def draw(rounds):
        T = icp(scans[1], scans[0], WRONG[0], rounds)
        off = pose(T) - pose(TRUE[0])
        error = f"{1000 * np.hypot(*off[:2]):.0f} mm and {abs(np.degrees(off[2])):.1f}° off"
        title = f"round {rounds}: {error}"
        return views.overlay(scans[0], carry(T, scans[1]), title=title)[0]

    views.explore(draw, alt="Second scan over the first after some rounds.", rounds=(0, 20, 4))


# %% [markdown]
# Two rounds put most of the shift right; the turn takes fifteen. Then nothing moves any more, yet
# it is not the truth: 9 mm and 0.7° are left. Some walls were seen from one place only, and their
# points are paired all the same.

# %% [markdown]
# ## 4 · Trimmed ICP
#
# Points that only one scan saw have no partner, yet they get one, far away. So sort the pairs by
# their distance and fit only the **share** of them that is shortest. Sort again in every round.


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

# %% [markdown]
# The same two places, and now the second scan with people in it. **Before you run it:** will more
# trimming always be better?


# %% name="people"
@attempt
def _():
    _, scans = polygon_scans(seed=1)
    people = np.random.default_rng(2).uniform([0.1, 0.5], [0.6, 0.9], (60, 2))
    crowd = np.vstack([scans[1], people])
    for share in (1.0, 0.95, 0.9, 0.8, 0.7, 0.5, 0.2):
        off = pose(trimmed_icp(crowd, scans[0], WRONG[0], 60, share)) - pose(TRUE[0])
        print(
            f"share {share:4.2f}: {1000 * np.hypot(*off[:2]):4.0f} mm "
            f"and {abs(np.degrees(off[2])):4.1f}° off"
        )


# %% [markdown]
# Keeping everything is bad, and so is keeping too little: the shortest pairs are those that already
# fit, so with too few of them nothing pulls any more.

# %% [markdown]
# ## 5 · A walk of several scans
#
# A robot scans, moves, scans, moves. Match each scan with the one before, from the step that the
# odometry tells, and say where each scan was taken, in the frame of the first. Take care of the
# second scan: the program printed in Tuček's thesis loses its motion.


# %% name="walk"
def walk(scans, steps, rounds):
    """Where each scan was taken.

    scans : list of n clouds, each in the robot's frame at that time [m]
    steps : list of n - 1 motions (3, 3): odometry's guess of pose i + 1 seen from pose i
    rounds : int, rounds of ICP for each match
    returns n motions (n, 3, 3) that carry each scan into the first one's frame
    """
    ### BEGIN SOLUTION
    poses = [np.eye(3)]
    for i, guess in enumerate(steps):
        poses.append(poses[-1] @ icp(scans[i + 1], scans[i], guess, rounds))
    return np.array(poses)
    ### END SOLUTION


# %%
check("13-walk")

# %% [markdown]
# All four places of the polygon, with the wrong odometry: what it says alone, and what your walk
# makes of it.


# %% name="maps"
@attempt
def _():
    truth, scans = polygon_scans(seed=1)
    naive = [np.eye(3)]
    for T in WRONG:
        naive.append(naive[-1] @ T)
    shown = {}
    for name, poses in {"naive": naive, "corrected": walk(scans, WRONG, 60)}.items():
        off = pose(poses[-1]) - pose(truth[-1])
        title = f"last pose {1000 * np.hypot(*off[:2]):.0f} mm and {np.degrees(off[2]):.1f}° off"
        xy = np.vstack([carry(T, s) for T, s in zip(poses, scans, strict=True)])
        track = np.array([pose(T) for T in poses])
        shown[f"{name}: {title}"] = [Points(name, xy), Poses("pose", track)]
    fig, _ = views.side_by_side(shown)
    views.show(fig, alt="Left four scans that do not fit, right the polygon with sharp walls.")


# %% [markdown]
# On the right the box, the cylinder and the walls come out sharp. Use `trimmed_icp` in your walk
# and look at the number again: what is left is the lidar's noise and the gaps between its beams.
#
# **Next:** the matcher knows only the scan before. Every match is a little off, and the errors add
# up, as odometry's did, only more slowly. Lesson 15 closes the loop.
