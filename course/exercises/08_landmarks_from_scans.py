# %% [markdown]
# # 08 · Landmarks from scans: exercise
#
# **You will be able to** fit a wall of any direction, find it among readings that are not its own,
# say where two walls meet and how sure that is, predict how a wall looks from a pose, and decide
# which wall of the map was seen.
#
# **50 minutes. Before:** lesson 08.
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it, as often as you like. A check tries random inputs and tells you which law is broken.
#
# Metres and radians throughout. A line is `[ρ, α]`: all points (a, b) with
# $a\cos\alpha + b\sin\alpha = \rho$.

# %%
import numpy as np

from slamlab import layers, views
from slamlab.checks import attempt, check
from slamlab.geometry import wrap

# %% [markdown]
# ## Fit a wall
#
# **Predict first.** Five points of a wall straight ahead: all x are 2.0 m, the y are −1 to 1 m.
# What are ρ and α? And what would `np.polyfit(x, y, 1)` say?
#
# **Your task.** The ρ ≥ 0 and α whose line has the least sum of squared distances to the points.
# The best line goes through the centroid; its normal is the direction in which the points scatter
# least. The check does not care which way you find it.


# %%
def fit_line(points):
    """The line of total least squares.

    points : (n, 2) [m];  returns rho, alpha with rho ≥ 0 [m], [rad]
    """
    ### BEGIN SOLUTION
    centre = points.mean(axis=0)
    _, vectors = np.linalg.eigh(np.cov((points - centre).T))
    normal = vectors[:, 0]
    rho, alpha = normal @ centre, np.arctan2(normal[1], normal[0])
    if rho < 0:
        rho, alpha = -rho, wrap(alpha + np.pi)
    return rho, alpha
    ### END SOLUTION


# %%
check("08-fit-line")

# %% [markdown]
# Your line on two walls, one of them vertical:


# %%
@attempt
def _():
    rng = np.random.default_rng(8)
    walls = {"ahead": [(2.0, -1.0), (2.0, 1.0)], "at a slant": [(-2.0, 1.0), (1.0, 2.2)]}
    fig, ax = views.axes("Two walls and your lines")
    for name, (start, end) in walls.items():
        start, end = np.array(start), np.array(end)
        points = start + np.linspace(0, 1, 25)[:, None] * (end - start)
        points += 0.03 * rng.standard_normal(points.shape)
        rho, alpha = fit_line(points)
        print(f"{name}: ρ = {rho:.2f} m, α = {np.degrees(alpha):.0f}°")
        foot, way = (np.array([np.cos(a), np.sin(a)]) for a in (alpha, alpha + np.pi / 2))
        ends = rho * foot + np.outer([-2, 2], way)
        views.draw(ax, layers.Points("scan", points), markersize=6)
        views.draw(ax, layers.Segments("landmark", [ends.ravel()]), label="_line")
    views.show(fig, alt="Points of two walls and your lines through them.")


# %% [markdown]
# ## Find it among others
#
# Half of these points are on one wall, the others are of chairs, people, other walls. They come in
# no order, so "neighbours" means nothing here.
#
# **Predict first.** A line through two points drawn at random: how likely are both on the wall? How
# likely is it that none of 60 such guesses is good?
#
# **Your task.** RANSAC. `tries` times: draw two different points with `rng`, take the line through
# them, count who lies within `band` of it. Of the guess with the most, refit the line on those that
# agreed with it (your `fit_line` does both). Where the best guess has fewer than `needed`, there is
# no wall: return `None`.


# %%
def find_wall(points, band, needed, tries, rng):
    """The wall most points agree on, or None.

    points : (n, 2) [m];  band : [m];  needed, tries : int;  rng : numpy.random.Generator
    returns rho, alpha, inside: the line fitted to points[inside], inside (n,) bool; or None
    """
    ### BEGIN SOLUTION
    best = np.zeros(len(points), dtype=bool)
    for _ in range(tries):
        pair = rng.choice(len(points), 2, replace=False)
        rho, alpha = fit_line(points[pair])
        inside = np.abs(points @ [np.cos(alpha), np.sin(alpha)] - rho) <= band
        if inside.sum() > best.sum():
            best = inside
    if best.sum() < needed:
        return None
    return *fit_line(points[best]), best
    ### END SOLUTION


# %%
check("08-ransac")

# %% [markdown]
# At work:


# %%
@attempt
def _():
    rng = np.random.default_rng(3)
    wall = np.column_stack([rng.uniform(-2, 2, 40), 1.5 + 0.02 * rng.standard_normal(40)])
    points = np.vstack([wall, rng.uniform(-3, 3, (30, 2))])
    found = find_wall(points, 0.05, 25, 60, rng)
    print("found:", found if found is None else f"ρ = {found[0]:.2f} m, α = {found[1]:.2f} rad")
    fig, ax = views.axes("Who agrees")
    views.draw(ax, layers.Points("points", points), markersize=5)
    if found is not None:
        views.draw(ax, layers.Points("corrected", points[found[2]]), markersize=9, label="inside")
    views.legend(ax)
    views.show(fig, alt="Points of a wall among others, and those your function takes for it.")


# %% [markdown]
# ## Where two walls meet
#
# Two lines of one scan, each with its covariance `R` (of ρ and α, which hang together), and
# independent of each other. Their corner **p** lies on both: n₁·p = ρ₁ and n₂·p = ρ₂, with
# n = (cos α, sin α).
#
# **Predict first.** Two walls at a right angle; only the α of the first is unsure. Along which wall
# is the corner unsure?
#
# **Your task.** The corner and its covariance `P`. Differentiate n·p = ρ on both sides:
# n·dp = dρ − (n′·p) dα, with n′ = (−sin α, cos α).


# %%
def corner(z1, R1, z2, R2):
    """Where two lines meet, and how sure that is.

    z1, z2 : (2,) ρ [m], α [rad];  R1, R2 : (2, 2) their covariances
    returns p (2,) [m] and P (2, 2) [m²]
    """
    ### BEGIN SOLUTION
    N = np.array([[np.cos(z[1]), np.sin(z[1])] for z in (z1, z2)])
    p = np.linalg.solve(N, [z1[0], z2[0]])
    P = np.zeros((2, 2))
    for k, R in enumerate((R1, R2)):
        across = np.array([-N[k, 1], N[k, 0]])
        J = np.outer(np.linalg.inv(N)[:, k], [1, -(across @ p)])
        P = P + J @ R @ J.T
    return p, P
    ### END SOLUTION


# %%
check("08-corner")

# %% [markdown]
# 500 scans of the same corner; 95 of 100 should lie inside your ellipse.


# %%
@attempt
def _():
    rng = np.random.default_rng(5)
    z1, R1 = np.array([2.0, 0.2]), np.diag([0.02, 0.03]) ** 2
    z2, R2 = np.array([1.5, 1.4]), np.diag([0.02, 0.01]) ** 2
    firsts, seconds = (rng.multivariate_normal(z, R, 500) for z, R in ((z1, R1), (z2, R2)))
    seen = [corner(a, R1, b, R2)[0] for a, b in zip(firsts, seconds, strict=True)]
    fig, _ = views.cloud(seen, {"your P, 95 %": corner(z1, R1, z2, R2)[1]})
    views.show(fig, alt="500 corners as seen, and the ellipse of your P.")


# %% [markdown]
# ## How a wall looks from a pose
#
# The map holds the wall as `line = [ρ, α]` in the world; the robot at `x = [x, y, θ]` sees it at
# ρ′, α′ in its own frame.
#
# **Predict first.** The robot drives 1 m along the wall. What changes? It turns 0.1 rad to the
# left. What changes? It drives through the wall: should ρ′ turn negative, or α′ jump by π?
#
# **Your task.** `h_line`, with α′ wrapped, and a normal that keeps pointing the way it did when the
# line was placed (so that nothing jumps). Then its derivatives by the pose, `H_r` (2, 3), and by
# the line, `H_p` (2, 2).


# %%
def h_line(x, line):
    """How a wall looks from a pose.

    x : (3,) pose [m, m, rad];  line : (2,) ρ [m], α [rad];  returns (2,) ρ′ [m], α′ [rad]
    """
    ### BEGIN SOLUTION
    rho, alpha = line
    return np.array([rho - x[0] * np.cos(alpha) - x[1] * np.sin(alpha), wrap(alpha - x[2])])
    ### END SOLUTION


# %%
def H_lines(x, line):
    """How that changes with the pose and with the line.

    x : (3,) pose [m, m, rad];  line : (2,) ρ [m], α [rad];  returns H_r (2, 3) and H_p (2, 2)
    """
    ### BEGIN SOLUTION
    c, s = np.cos(line[1]), np.sin(line[1])
    H_r = np.array([[-c, -s, 0], [0, 0, -1]])
    H_p = np.array([[1, x[0] * s - x[1] * c], [0, 1]])
    return H_r, H_p
    ### END SOLUTION


# %%
check("08-h-line")

# %% [markdown]
# ## Which wall was it?
#
# The scan shows some walls, `z` (m, 2). The map expects N walls at `expected` (N, 2), and for each
# the innovation has the covariance `S` (N, 2, 2).
#
# **Predict first.** A sighting is 0.1 m and 0.1 rad off what is expected of wall A, 0.3 m and 0 rad
# off wall B. Which is nearer? What do you have to know to answer?
#
# **Your task.** Pair by the squared Mahalanobis distance d² = vᵀ S⁻¹ v, v = z − expected with its
# angle wrapped: of all pairs with d² ≤ `gate` make the nearest first, then the next nearest of
# those left, and so on. Each wall and each sighting is used at most once.


# %%
def associate(z, expected, S, gate):
    """Which wall of the map each sighting is of.

    z : (m, 2);  expected : (N, 2);  S : (N, 2, 2);  gate : float, the largest d²
    returns a list of m: the number 0 … N−1 of the wall, or None for a new one
    """
    ### BEGIN SOLUTION
    distances = []
    for i in range(len(z)):
        for j in range(len(expected)):
            v = z[i] - expected[j]
            v[1] = wrap(v[1])
            distances.append((v @ np.linalg.inv(S[j]) @ v, i, j))
    pairs = {}
    for d2, i, j in sorted(distances):
        if d2 <= gate and i not in pairs and j not in pairs.values():
            pairs[i] = j
    return [pairs.get(i) for i in range(len(z))]
    ### END SOLUTION


# %%
check("08-associate")

# %% [markdown]
# The example of the lesson: the robot's heading is unsure, its place is not. Wall 0 is farther by
# Pythagoras, and yet:


# %%
@attempt
def _():
    seen, expected = np.array([[2.98, 0.05]]), np.array([[3.0, 0.3], [2.78, 0.05]])
    S = np.array([np.diag([0.06, 0.15]) ** 2] * 2)
    print("by Pythagoras:", np.hypot(*(seen - expected).T).round(2))
    print("your pairing: ", associate(seen, expected, S, 5.99))


# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then says what the grader will say about it;
# the grader draws other inputs. The next lesson puts these five into a filter that drives.
