# %% [markdown]
# # Exercise 09 · SLAM with walls
#
# **You will be able to** run EKF-SLAM on walls: place one, see it again, keep count of its life,
# drive a corridor, and draw no more points than needed.
#
# **50 minutes. Before:** lesson 09; exercise 06 for the filter on points.
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it, as often as you like. A check tries random inputs and tells you which law is broken.
#
# A wall is the line of all points (a, b) with a cos α + b sin α = ρ. The robot at `[x, y, θ]` sees
# it at `z = [ρ', α']`: how far from the robot, and where the normal points, counted from the
# heading. The state is `x = [x, y, θ, ρ_0, α_0, ρ_1, α_1, …]`. Metres and radians throughout;
# `wrap` takes an angle to (−π, π].

# %%
import numpy as np

from slamlab import views
from slamlab.checks import attempt, check
from slamlab.geometry import wrap
from slamlab.layers import Points, Poses, Segments

# %% [markdown]
# ## Place a wall
#
# The robot at `x`, which errs with covariance `P` (3, 3), sees a wall at `z`, which errs with `R`
# (2, 2). With α = θ + α',
#
# $$\rho = \rho' + x \cos\alpha + y \sin\alpha$$
#
# **Predict first.** The robot stands far from the world's origin and is unsure of θ. Which of the
# wall's two numbers suffers? Which errors does the wall share with the robot?
#
# **Your task.** The line (ρ, α) in the world, its covariance C = J_x P J_xᵀ + J_z R J_zᵀ, and
# X = J_x P, which it shares with the pose. J_x (2, 3) and J_z (2, 2) are the slopes of the line by
# the pose and by z: derive them, and mind that α is inside the cosine, too. Where ρ comes out
# negative, leave it so: the normal goes on pointing away from the robot.


# %%
def place(x, P, z, R):
    """A wall was seen at z; returns line (2,), C (2, 2), X (2, 3).

    x : (3,) pose;  P : (3, 3);  z : (2,) ρ' [m], α' [rad];  R : (2, 2)
    """
    ### BEGIN SOLUTION
    alpha = wrap(x[2] + z[1])
    c, s = np.cos(alpha), np.sin(alpha)
    lever = -x[0] * s + x[1] * c
    J_x = np.array([[c, s, lever], [0, 0, 1]])
    J_z = np.array([[1, lever], [0, 1]])
    line = np.array([z[0] + x[0] * c + x[1] * s, alpha])
    return line, J_x @ P @ J_x.T + J_z @ R @ J_z.T, J_x @ P
    ### END SOLUTION


# %%
check("09-place")

# %% [markdown]
# Your function at work. The same wall, seen 2 m ahead, from a robot that is unsure of its heading
# by 2°: at the origin, then 5 m to the side of it. Before you run it: in which of the two is ρ
# worse known?


# %%
@attempt
def _():
    P, R = np.diag([0.02, 0.02, np.radians(2)]) ** 2, np.diag([0.01, 0.005]) ** 2
    for name, pose in (("at the origin", [0.0, 0, 0]), ("5 m to the side", [0.0, 5, 0])):
        line, C, _ = place(np.array(pose), P, np.array([2.0, 0.0]), R)
        sigma = 100 * np.sqrt(C[0, 0])
        print(f"{name:16} ρ = {line[0]:.2f} m, σ of ρ: {sigma:.1f} cm")


# %% [markdown]
# ## See it again
#
# Wall `j` is seen again, at `z`. From the robot it should be at
#
# $$\rho' = \rho - x \cos\alpha - y \sin\alpha, \qquad \alpha' = \alpha - \theta$$
#
# **Predict first.** H has 2 rows. Which columns are not zero? Which entry would be wrong if angles
# were in degrees?
#
# **Your task.** x and P after the update, over the whole state: v = z − h, S = H P Hᵀ + R,
# K = P Hᵀ S⁻¹, x ← x + K v, P ← P − K S Kᵀ.


# %%
def update(x, P, z, j, R):
    """Wall j was seen at z; returns x (n,), P (n, n).

    x : (n,) state;  P : (n, n);  z : (2,) ρ' [m], α' [rad];  j : int, from 0;  R : (2, 2)
    """
    ### BEGIN SOLUTION
    at = 3 + 2 * j
    rho, alpha = x[at : at + 2]
    c, s = np.cos(alpha), np.sin(alpha)
    v = z - np.array([rho - x[0] * c - x[1] * s, alpha - x[2]])
    v[1] = wrap(v[1])
    H = np.zeros((2, len(x)))
    H[:, :3] = [[-c, -s, 0], [0, 0, -1]]
    H[:, at : at + 2] = [[1, x[0] * s - x[1] * c], [0, 1]]
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
    ### END SOLUTION


# %%
check("09-update")

# %% [markdown]
# ## Sightings and lives
#
# A book says of each wall how often it was seen and how many lives it has left:
# `book[id] = (sightings, lives left)`. Each scan gives `seen`, a list of ids.
#
# - A new id comes into the book with one sighting and all `lives`.
# - A wall that is seen counts one sighting more and gets all its lives back. Of two sightings of
# one   wall in a scan the second is dropped.
# - A wall that is not seen loses a life; at 0 it leaves the book. If it comes back, it is new.
# - `used` are the walls of *this scan* that have been seen `N` times or more, this time included.
#
# **Predict first.** With `lives = 3`, a wall is seen, missed in two scans, and seen again. Is it in
# the book all the time? And with three scans missed?
#
# **Your task.** The book after the scan, and the list of ids used.


# %%
def keep_book(book, seen, N, lives):
    """One scan; returns book, used.

    book : dict, id to (sightings, lives left);  seen : list of ids;  N, lives : int
    """
    ### BEGIN SOLUTION
    after = {}
    for i, (count, left) in book.items():
        if i not in seen and left > 1:
            after[i] = (count, left - 1)
    for i in set(seen):
        count = book[i][0] if i in book else 0
        after[i] = (count + 1, lives)
    used = [i for i in sorted(set(seen)) if after[i][0] >= N]
    return after, used
    ### END SOLUTION


# %%
check("09-life")

# %% [markdown]
# ## Through a corridor
#
# Here is the robot's part, as in exercise 06:


# %%
def predict(x, P, u, C):
    """The robot drives u = [d, Δθ], which errs with covariance C; returns x, P."""
    d, (c, s) = u[0], (np.cos(x[2]), np.sin(x[2]))
    F, W = np.eye(len(x)), np.zeros((len(x), 2))
    F[:2, 2] = -d * s, d * c
    W[:3] = [[c, 0], [s, 0], [0, 1]]
    x = x.copy()
    x[:3] += [d * c, d * s, u[1]]
    return x, F @ P @ F.T + W @ C @ W.T


# %% [markdown]
# One step: the robot drove `u`, then saw walls; `seen[k]` is the id of the one seen at `z[k]`, each
# with covariance `R`. `ids` are the ids of the walls in the state, in its order.
#
# A new wall shares errors with *everything* the pose is correlated with. `place` gives X = J_x P
# for the pose alone; over the whole state the new rows are J_x P[:3], and with
# `G = X @ np.linalg.inv(P[:3, :3])`, which is J_x, you need not derive it again.
#
# **Predict first.** All walls are parallel to the corridor. What will the filter know after 8 steps
# about its place across, its heading, its place along?
#
# **Your task.** The step. The check drives your filter through 20 runs of one corridor, and asks
# whether robot and map err as much as P says, and whether P is as sure as least squares is over the
# whole run.


# %%
def slam_step(x, P, ids, u, seen, z, C, R):
    """One step of SLAM with walls; returns x, P, ids.

    x : (n,), P : (n, n), ids : list of int    the state, and which walls are in it
    u : (2,) the drive, of covariance C (2, 2)
    seen : list of m int;  z : (m, 2) what was seen of them, each of covariance R (2, 2)
    """
    ### BEGIN SOLUTION
    x, P = predict(x, P, u, C)
    for i, one in zip(seen, z, strict=True):
        if i in ids:
            x, P = update(x, P, one, ids.index(i), R)
        else:
            line, C_line, X = place(x[:3], P[:3, :3], one, R)
            row = X @ np.linalg.inv(P[:3, :3]) @ P[:3]
            x, P = np.append(x, line), np.block([[P, row.T], [row, C_line]])
            ids = [*ids, i]
    return x, P, ids
    ### END SOLUTION


# %%
check("09-walls")

# %% [markdown]
# Ten metres down a corridor. Before you run it: which of three σ grow, that of the place along the
# corridor, of the place across it, of the distance from the left wall?


# %%
@attempt
def _():
    C, R = np.diag([0.02, 0.01]) ** 2, np.diag([0.02, 0.01]) ** 2
    rng, walls = np.random.default_rng(9), np.array([[1.5, np.pi / 2], [1.2, -np.pi / 2]])
    x, P, ids, sigmas = np.zeros(3), np.diag([0.01, 0.01, 0.005]) ** 2, [], []
    for _ in range(50):
        u, z = rng.multivariate_normal([0.2, 0], C), walls + rng.multivariate_normal([0, 0], R, 2)
        x, P, ids = slam_step(x, P, ids, u, [0, 1], z, C, R)
        c, s = np.cos(x[4]), np.sin(x[4])
        H = np.array([-c, -s, 0, 1, x[0] * s - x[1] * c])  # of the distance from the left wall
        sigmas.append(100 * np.sqrt([P[0, 0], P[1, 1], H @ P[:5, :5] @ H]))
    names = ("along", "across", "from the left wall")
    curves = dict(zip(names, np.transpose(sigmas), strict=True))
    fig, _ = views.curves(0.2 * np.arange(1, 51), curves, "driven [m]", "σ [cm]")
    views.show(fig, alt="What the filter believes of its place along and across a corridor.")


# %% [markdown]
# **See:** along the corridor σ should grow as the wheels' noise does: nothing measures it. The
# distance from the wall should stay known to a centimetre. And yet the place *across* is less and
# less known: the whole corridor hangs on the heading with which its walls were placed, and the
# farther away, the more that swings.
#
# ## Thin the points
#
# For people the points are drawn, but none that is closer than `spacing` to one already drawn.
#
# **Predict first.** Two points in different cells of a grid of that width: how near may they be?
# In which cells must you look for those that are too near?
#
# **Your task.** `kept` (n, 2) are drawn; of the points of a new scan (m, 2) add those that keep the
# distance, from the old ones and from each other. Return all, the old ones first. (A loop over all
# pairs passes the check. A grid is faster.)


# %%
def thin(kept, points, spacing):
    """The points drawn after a scan: (k, 2).

    kept : (n, 2) drawn before;  points : (m, 2) [m];  spacing : float [m]
    """
    ### BEGIN SOLUTION
    cells = {}
    drawn = []

    def add(point):
        drawn.append(point)
        cells.setdefault(tuple(np.floor(point / spacing).astype(int)), []).append(point)

    for point in kept:
        add(point)
    for point in points:
        i, j = np.floor(point / spacing).astype(int)
        around = [(i + a, j + b) for a in (-1, 0, 1) for b in (-1, 0, 1)]
        near = [p for cell in around for p in cells.get(cell, [])]
        if all(np.hypot(*(p - point)) > spacing for p in near):
            add(point)
    return np.array(drawn).reshape(-1, 2)
    ### END SOLUTION


# %%
check("09-thin")

# %% [markdown]
# Forty scans of a corner, thinned to 60 mm. Before you run it: how many of 4000 points remain on
# 4 m of wall that is 3 cm "thick" with noise?


# %%
@attempt
def _():
    rng, drawn, offered = np.random.default_rng(3), np.empty((0, 2)), []
    for _ in range(40):
        along, side = rng.uniform(0, 2, 100), rng.integers(0, 2, 100)[:, None]
        wall = np.column_stack([along, 0 * along])
        scan = np.where(side, wall, wall[:, ::-1]) + 0.015 * rng.standard_normal((100, 2))
        offered.append(scan)
        drawn = thin(drawn, scan, 0.06)
    shown = {
        "all 4000": [Points("scan", np.concatenate(offered)), Poses("robot", [[1, 1, 0.5]])],
        f"{len(drawn)} of them": [
            Segments("walls", [[0, 0, 2, 0], [0, 0, 0, 2]]),
            Points("scan", drawn),
            Poses("robot", [[1, 1, 0.5]]),
        ],
    }
    fig, _ = views.side_by_side(shown, size=(9, 4))
    views.show(fig, alt="All points of forty scans of a corner, and the few that were kept.")


# %% [markdown]
# **See:** to the right the corner should look the same, with about sixty points.
#
# ## Done?
#
# Save the notebook. The cell below then says what the grader will say about it;
# the grader draws other inputs. Then drive the robot yourself: lesson 09 has the buttons.
