# %% [markdown]
# # Exercise 08 · Landmarks from scans
#
# **You will be able to** fit a wall of any direction, say where two walls meet and how sure that is,
# decide which wall of the map was seen, find round pillars as well, and take a whole scan apart into
# its walls.
#
# **60 minutes. Before:** lesson [08 · Landmarks from
# scans](../notebooks/08_landmarks_from_scans.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it, as often as you like. A check tries random inputs, and inputs at the edge of what the task
# promises, and tells you which law is broken.
#
# Metres and radians throughout. A line is `[ρ, α]`: all points $p = (p_x, p_y)$ with
# $p_x\cos\alpha + p_y\sin\alpha = \rho$, as in (08.2).

# %%
import numpy as np

from slamlab import layers, views
from slamlab.checks import ask, attempt, check
from slamlab.geometry import wrap

# %% [markdown]
# ## 1 · Fit a wall
#
# To try your function, take five points of a wall straight ahead: $p_x$ is 2.0 m for all of them, and $p_y$ runs
# from −1 to 1 m. You know what $\rho$ and $\alpha$ must be.
#
# **Your task.** Return the $\rho \ge 0$ and the $\alpha$ of the line whose sum of squared distances to the points
# is least. It goes through the centroid, and its normal is the direction in which the points scatter least. How
# you find it is up to you.
#
# You get two points or more. They are not all in one place, but they may lie exactly on a line. The line does not
# pass through the origin. Do not change the points that you are given.


# %%
def fit_line(points):
    """The line of total least squares.

    points : (n, 2) [m];  returns rho, alpha with rho ≥ 0 [m], [rad]
    """
    ### BEGIN SOLUTION
    centre = points.mean(axis=0)
    off = points - centre
    _, vectors = np.linalg.eigh(off.T @ off)
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
# ## 2 · Where two walls meet
#
# You have two lines of one scan, each with its covariance `R`. The errors of $\rho$ and $\alpha$ of a line are
# correlated; those of different lines are independent. The corner $p$ lies on both lines. With
# $n = (\cos\alpha, \sin\alpha)$ for the normal of a line,
#
# $$n_1 \cdot p = \rho_1, \qquad n_2 \cdot p = \rho_2.$$

# %%
ask(
    "ex08-corner",
    "Two walls meet at a right angle. The second one is known exactly, and of the first only the "
    "direction $\\alpha$ is unsure. **Along which wall is the corner unsure?**",
    {
        "along the first, whose direction is unsure": "the corner also lies on the second wall, which does not move.",
        "along the second": "the first wall swings, and the place where it cuts the second one slides along that.",
        "along both": "it cannot leave the second wall, which is known exactly.",
    },
    right="along the second",
)

# %% [markdown]
# **Your task.** Return the corner and its covariance `P`, as in (08.9). You need not solve for $p$ by hand to
# differentiate it. Differentiate both sides of $n \cdot p = \rho$ instead:
#
# $$n \cdot \mathrm dp = \mathrm d\rho - (n' \cdot p)\, \mathrm d\alpha, \qquad
# n' = (-\sin\alpha, \cos\alpha).$$
#
# The walls are at least 10° from parallel. $\rho$ may be zero or negative, and $\alpha$ may be any angle. A line that
# is known exactly has a covariance of zero. Do not change the arguments.


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
# Below are the corners of 500 scans. Of every 100, some 95 should lie inside your ellipse.


# %%
@attempt
def _():
    rng = np.random.default_rng(5)
    z1, R1 = np.array([2.0, 0.2]), np.diag([0.02, 0.03]) ** 2
    z2, R2 = np.array([1.5, 1.4]), np.diag([0.02, 0.01]) ** 2
    firsts, seconds = (rng.multivariate_normal(z, R, 500) for z, R in ((z1, R1), (z2, R2)))
    seen = [corner(a, R1, b, R2)[0] for a, b in zip(firsts, seconds, strict=True)]
    fig, _ = views.cloud(seen, {"your P, 95 %": corner(z1, R1, z2, R2)[1]})
    views.show(fig, alt=f"{len(seen)} corners as seen, and the ellipse of your P.")


# %% [markdown]
# ## 3 · Which wall was it?
#
# The scan shows $m$ walls: each row of `z` (m, 2) is a $\rho$ and an $\alpha$. Of the map's $N$ walls the robot
# expects to see `expected` (N, 2), and for each of them the innovation has the covariance `S` (N, 2, 2).
#
# **Your task.** Pair sightings with walls by the square of the Mahalanobis distance (08.11),
#
# $$d^2 = v^{\mathsf T} S^{-1} v,$$
#
# where the innovation $v$ is the sighting minus what is expected, with its angle wrapped. Of all pairs with
# $d^2 \le$ `gate`, make the nearest first, then the nearest of those that are left, and so on. Each wall and each
# sighting is used at most once. The map may be empty ($N = 0$), and so may the scan ($m = 0$). Do not change the
# arguments.


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
# This is the lesson's example, with a heading that is unsure and a place that is not. By Pythagoras wall 0 is the
# farther one. By your function?


# %%
@attempt
def _():
    seen, expected = np.array([[2.98, 0.05]]), np.array([[3.0, 0.3], [2.78, 0.05]])
    S = np.array([np.diag([0.06, 0.15]) ** 2] * 2)
    print("by Pythagoras:", np.hypot(*(seen - expected).T).round(2))
    print("your pairing: ", associate(seen, expected, S, 5.99))


# %% [markdown]
# ## 4 · A round pillar
#
# The lesson's RANSAC sometimes takes the side of a pillar for a wall. Let us look for the pillars themselves. A
# reading $p$ on a circle round the centre $c$ obeys $|p - c|^2 = \text{radius}^2$, which is not linear in what we
# look for. But multiply it out, and give $\text{radius}^2 - |c|^2$ a name of its own, $d$:
#
# $$2\,c \cdot p + d = |p|^2.$$
#
# This *is* linear, in $c_x$, $c_y$ and $d$. Three points determine the three of them; with more points, least
# squares does.

# %%
ask(
    "ex08-share",
    "60 % of the readings are of the pillar. **Which share of the guesses is made of readings of the "
    "pillar alone?**",
    right=22,
    tolerance=2,
    unit="%",
    reason="a circle takes three readings, and 0.6³ is 0.216.",
    wrong={
        60: "that is the share of the readings. All readings of a guess must be of the pillar.",
        36: "0.6² would do for a line, through two readings. A circle takes three.",
    },
)

# %% [markdown]
# Also think of a guess whose readings are all of a *wall*: which centre does it get, and which radius?
#
# **Your task** is two functions. `fit_circle` returns the circle whose $c$ and $d$ make the sum of the squared
# differences between the two sides of the equation least, over all points. It is given three points or more, which
# are not all on one line.
#
# `find_pillar` is RANSAC. It guesses `tries` times: draw three different readings with `rng`, and take the circle
# through them. A guess whose radius is above `largest` [m] is no pillar and does not count. For each of the others,
# count the readings that are within `band` [m] of the circle, on either side of it. Take the guess on which most
# readings agree, refit the circle to these readings with your `fit_circle`, and return it together with them. If
# fewer than `needed` (3 or more) agree with the best guess, return `None`.
#
# The readings come in no order. There may be fewer than three. Some that you draw may lie *exactly* on one line; no
# circle goes through those, and your function has to go on. Whether you pass over such a guess or let least squares
# make some circle of it is up to you: too few agree with it to be the best. Do not change the points that you are
# given. The check stops after 10 s.


# %%
def fit_circle(points):
    """The circle of least squares of 2 c·p + d = |p|².

    points : (n, 2) [m], n ≥ 3;  returns centre (2,) [m], radius [m]
    """
    ### BEGIN SOLUTION
    A = np.column_stack([2 * points, np.ones(len(points))])
    *centre, d = np.linalg.lstsq(A, np.sum(points**2, axis=1))[0]
    return np.array(centre), np.sqrt(d + centre[0] ** 2 + centre[1] ** 2)
    ### END SOLUTION


# %%
def find_pillar(points, band, largest, needed, tries, rng):
    """The pillar most readings agree on, or None.

    points : (n, 2) [m];  band, largest : [m];  needed, tries : int;  rng : numpy.random.Generator
    returns centre (2,), radius, inside: the circle fitted to points[inside], inside (n,) bool; or None
    """
    ### BEGIN SOLUTION
    if len(points) < 3:
        return None
    best = np.zeros(len(points), dtype=bool)
    for _ in range(tries):
        three = points[rng.choice(len(points), 3, replace=False)]
        (ax, ay), (bx, by) = three[1:] - three[0]
        if abs(ax * by - ay * bx) < 1e-9:
            continue
        centre, radius = fit_circle(three)
        inside = np.abs(np.hypot(*(points - centre).T) - radius) <= band
        if radius <= largest and inside.sum() > best.sum():
            best = inside
    if best.sum() < needed:
        return None
    return *fit_circle(points[best]), best
    ### END SOLUTION


# %%
check("08-pillar")

# %% [markdown]
# Here is a pillar of 40 cm in front of a wall, with some clutter. The wall has more readings than
# the pillar has.


# %%
@attempt
def _():
    rng = np.random.default_rng(6)
    turn = np.linspace(1.7, 4.6, 30)
    pillar = [2.0, 0.5] + 0.2 * np.column_stack([np.cos(turn), np.sin(turn)])
    wall = np.column_stack([np.full(36, 2.9), np.linspace(-1.4, 1.7, 36)])
    points = np.vstack([pillar, wall]) + 0.004 * rng.standard_normal((66, 2))
    points = np.vstack([points, rng.uniform([0.2, -1.5], [2.8, 1.7], (8, 2))])
    found = find_pillar(points, 0.02, 0.5, 15, 300, rng)
    fig, ax = views.axes("A pillar, and who agrees")
    views.draw(ax, layers.Points("points", points), markersize=5)
    views.draw(ax, layers.Poses("robot", [np.zeros(3)]))
    if found is not None:
        centre, radius, inside = found
        print(f"centre ({centre[0]:.3f}, {centre[1]:.3f}) m, radius {radius:.3f} m")
        round_it = np.linspace(0, 2 * np.pi, 60)
        circle = centre + radius * np.column_stack([np.cos(round_it), np.sin(round_it)])
        pieces = np.hstack([circle[:-1], circle[1:]])
        views.draw(ax, layers.Points("corrected", points[inside]), markersize=8, label="inside")
        views.draw(ax, layers.Segments("landmark", pieces), label="your circle")
    views.legend(ax)
    views.show(fig, alt="A pillar before a wall, and the circle that your function found.")


# %% [markdown]
# ## 5 · Make it better: all walls of a scan
#
# One wall is a beginning, but a map needs all of them. In these rooms a quarter of the beams meet something that is
# no wall: people, bags, the legs of chairs. A window of 25 neighbours is hardly ever free of clutter there.

# %%
ask(
    "ex08-nine",
    "A quarter of the readings are clutter. **How likely is it that nine neighbouring readings are "
    "all of the wall?**",
    right=7.5,
    tolerance=1.5,
    unit="%",
    reason="0.75⁹ is 0.075. Two neighbours are both of the wall in 56 % of the cases.",
    wrong={
        75: "that is one reading. Nine must be of the wall at once.",
        56: "that is two neighbours. Each further one costs another quarter.",
    },
)

# %% [markdown]
# **Your task.** Give each reading the number of its wall. Readings of one wall get the same number,
# those of another wall another one, and clutter gets −1. All readings of one *straight line* are of
# one wall, even where something stands in front of its middle. Which numbers you use does not
# matter, as long as they are whole and 0 or more.
#
# Any method will do. The readings `points` are one turn of a lidar that stands at the origin. They come in the order
# of their bearing, so the last one is the neighbour of the first. Each range errs by `share` of itself ($1\sigma$,
# along the beam). A scan has 180 readings or more, of some six to ten walls. Do not change the points, and keep an eye
# on the time: a scan should not take much longer than 10 ms.
#
# **How it is scored.** Each of your walls stands for at most one true wall, and each true wall for at most one of
# yours. In the pairing that suits you best, the readings that both have are *right*. Your share is
#
# $$\frac{2 \cdot \text{right}}{\text{readings of true walls} + \text{readings you gave a number}},$$
#
# averaged over scans; it is 1 if all is right. True walls with fewer than eight readings are passed over. There are
# four steps, from 0.7 to 0.92. The grader draws other rooms, so leave some margin above the step that you aim at.
# The check stops after 10 s.
#
# If you do not know how to begin: find the line that most readings agree on, take these readings away, and look for
# the next. Then ask yourself three questions. Which guesses are worth making? How wide should the band be near and
# far, straight on and at a slant (the lesson's "How sure is that line?")? And who gets a reading that two lines want?


# %%
def segment(points, share):
    """The wall of each reading of a scan.

    points : (n, 2) [m], in the order of their bearing;  share : float, σ of a range / range
    returns (n,) int: the number of its wall, −1 where it is of none
    """
    ### BEGIN SOLUTION
    far = np.hypot(*points.T)
    beams = points / far[:, None]

    def off(normal, rho):
        # in standard deviations: a range's error counts as far as its beam goes across the line
        sigma = share * far * np.abs(normal @ beams.T) + 0.005
        return np.abs(normal @ points.T - np.expand_dims(rho, -1)) / sigma

    # guesses: lines through two readings, some beams apart
    first = np.tile(np.arange(len(points)), 6)
    second = (first + np.repeat([4, 6, 9, 13, 18, 24], len(points))) % len(points)
    way = points[second] - points[first]
    normals = np.column_stack([-way[:, 1], way[:, 0]]) / np.hypot(*way.T)[:, None]
    near = off(normals, np.sum(normals * points[first], axis=1)) < 2.5

    free, lines = np.ones(len(points), dtype=bool), []
    for _ in range(14):
        votes = (near & free).sum(axis=1)
        if votes.max() < 9:
            break
        inside = near[votes.argmax()] & free
        for _ in range(3):
            weight = 1 / far[inside] ** 2
            centre = weight @ points[inside] / weight.sum()
            x, y = (points[inside] - centre).T * np.sqrt(weight)
            alpha = 0.5 * np.arctan2(-2 * x @ y, y @ y - x @ x)
            line = np.array([np.cos(alpha), np.sin(alpha)]), centre @ [np.cos(alpha), np.sin(alpha)]
            inside = inside & (off(*line) < 3)
        lines.append(line)
        free = free & ~inside & (off(*line) >= 3)
    if not lines:
        return np.full(len(points), -1)
    # who is wanted by several goes to the nearest
    distances = np.array([off(*line) for line in lines])
    labels = np.where(distances.min(axis=0) < 3, distances.argmin(axis=0), -1)
    small = np.bincount(labels + 1, minlength=len(lines) + 1)[1:] < 7
    return np.where(np.isin(labels, np.flatnonzero(small)), -1, labels)
    ### END SOLUTION


# %%
check("08-segments")

# %% [markdown]
# Here is one of these rooms; each of your walls has a colour and a mark.


# %%
@attempt
def _():
    rng = np.random.default_rng(4)
    angles = np.linspace(-np.pi, np.pi, 180, endpoint=False)
    beams = np.column_stack([np.cos(angles), np.sin(angles)])
    # walls as (ρ, α) round the robot: the range to each along each beam
    room = [(2.0, 0.3), (1.6, 1.87), (3.1, -2.84), (1.2, -1.27), (2.2, 0.95)]
    reach = np.full(180, np.inf)
    for rho, alpha in room:
        towards = np.cos(angles - alpha)
        reach = np.minimum(reach, np.where(towards > 1e-6, rho / np.maximum(towards, 1e-6), np.inf))
    reach *= 1 + 0.015 * rng.standard_normal(180)
    clutter = rng.random(180) < 0.25
    reach[clutter] *= rng.uniform(0.2, 0.95, clutter.sum())
    points = reach[:, None] * beams
    labels = np.asarray(segment(points.copy(), 0.015))
    fig, ax = views.axes("Your walls, and in grey what is of none")
    for k in np.unique(labels):
        colour, _, mark = views.SERIES[int(k) % len(views.SERIES)]
        style = {"color": colour, "marker": mark, "markersize": 4}
        grey = {"color": views.COLOURS["walls"], "markersize": 4}
        of = layers.Points("scan", points[labels == k])
        views.draw(ax, of, label="_walls", **(grey if k < 0 else style))
    views.draw(ax, layers.Poses("robot", [np.zeros(3)]))
    views.show(fig, alt="A scan of a room with clutter; the readings of each wall in a colour.")


# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then says what the grader will say about it; the grader draws other inputs.
# **Next:** lesson [09 · SLAM with walls](../notebooks/09_slam_with_walls.ipynb) puts walls into a filter that drives.
