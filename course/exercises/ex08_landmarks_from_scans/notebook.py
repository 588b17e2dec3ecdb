# %% [markdown]
# # Exercise 08 · Landmarks from scans: feature extraction and data association
#
# **You will be able to** fit a line to a wall of any direction, associate the walls of a scan with
# the walls of a map, each alone and all jointly, find round pillars with RANSAC, and segment a whole
# scan into its walls.
#
# **60 minutes. Before:** lesson [08 · Landmarks from scans: feature extraction and data association](../notebooks/08_landmarks_from_scans.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it. You can repeat this as often as you like. A check tries random inputs and special cases that
# the text allows. If your answer breaks a law, the check shows a small input that breaks it.
# `hint("08-fit-line")` in a cell of your own asks a guiding question.
#
# All lengths are in metres, all angles in radians. A line is `[ρ, α]` in Hessian normal form. It
# contains all points $p = (p_x, p_y)$ with $p_x\cos\alpha + p_y\sin\alpha = \rho$ (08.2). A
# function must not change its arguments.

# %%
from itertools import product

import numpy as np

from classroom.checks import ask, attempt, check
from slamlab import layers, views
from slamlab.geometry import wrap

# %% [markdown]
# ## 1 · Total least squares: the line of a wall
#
# You can test your function with five points of a wall straight ahead: $p_x$ is 2.0 m for all
# points, and $p_y$ goes from −1 to 1 m. What are $\rho$ and $\alpha$ of this wall?
#
# **Your task.** Return $\rho \ge 0$ [m] and $\alpha$ [rad] of the line with the smallest sum of
# squared distances to the points. This line goes through the centroid, and its normal is the
# direction in which the variance of the points is smallest. You can use any method, and you may add
# any multiple of $2\pi$ to $\alpha$.
#
# `points` contains at least two points. They are not all at the same position, but they may lie
# exactly on a line. The line does not pass through the origin. The check judges the sign of
# $\rho$ and the sum of squared distances. This sum may exceed the minimum by 0.01 %, plus
# $10^{-12}$ m² for each point, so rounding errors are allowed even if the minimum is 0.


# %%
def fit_line(points):
    """The line by total least squares.

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
# The figure shows your lines for two walls. One wall is straight ahead, so its $p_x$ is constant.


# %%
@attempt
def _():
    rng = np.random.default_rng(8)
    walls = {"ahead": [(2.0, -1.0), (2.0, 1.0)], "oblique": [(-2.0, 1.0), (1.0, 2.2)]}
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
# ## 2 · Data association
#
# The scan shows $m$ walls: each row of `z` (m, 2) is a measurement $(\rho, \alpha)$. The map has
# $N$ walls. The predicted measurements of the walls are `expected` (N, 2), and `S` (N, 2, 2)
# contains the innovation covariance of each wall.
#
# **Your task.** Associate measurements with walls by the square of the Mahalanobis distance (08.11),
#
# $$d^2 = v^{\mathsf T} S^{-1} v.$$
#
# The innovation $v$ is the measurement minus the predicted measurement, with a wrapped angle. Use
# greedy nearest-neighbour association: of all pairs with $d^2 \le$ `gate`, associate the pair with
# the smallest $d^2$ first. Then associate the pair with the smallest $d^2$ of the remaining pairs,
# and so on. Use each wall and each measurement at most once.
#
# Return a list of $m$ entries: the number of the wall (0 to $N - 1$), or `None` for a new wall. The
# map may be empty ($N = 0$), and the scan may be empty ($m = 0$). The check judges whether no wall
# is used twice, no pair exceeds the gate, and the nearest pairs are associated first.


# %%
def associate(z, expected, S, gate):
    """The wall of the map for each measurement.

    z, expected : (m, 2), (N, 2) ρ [m], α [rad];  S : (N, 2, 2);  gate : float, the largest d²
    returns a list of m: the number 0 … N−1 of the wall, or None for a new wall
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
# This is the example of the lesson: the heading is uncertain, and the position is known accurately.
# By the Euclidean distance, wall 1 is the nearest. Which wall does your function choose?


# %%
@attempt
def _():
    seen, expected = np.array([[2.98, 0.05]]), np.array([[3.0, 0.3], [2.78, 0.05]])
    S = np.array([np.diag([0.06, 0.15]) ** 2] * 2)
    print("Euclidean distances:", np.hypot(*(seen - expected).T).round(2))
    print("your association:   ", associate(seen, expected, S, 5.99))


# %% [markdown]
# ## 3 · Joint compatibility
#
# All measurements of a scan are made from one pose. If its heading is wrong, all innovations show
# this error, so they are correlated. The innovations of $k$ pairs are stacked to one vector $v$ of
# $2k$ numbers, with one covariance $S$. The joint $d^2 = v^{\mathsf T} S^{-1} v$ of $k$ correct pairs
# is $\chi^2$ distributed with $2k$ degrees of freedom.

# %%
ask(
    "ex08-joint",
    "Only the heading is uncertain, with $\\sigma$ = 0.10 rad, and a measurement of $\\alpha$ has a "
    "$\\sigma$ of 0.02 rad. Of two pairs, the innovations of $\\alpha$ are 0.2 and −0.2 rad, which gives "
    "a $d^2$ of 3.8 for each alone. **How large is their joint $d^2$?**",
    {
        "3.8": "this would be nearly right for two innovations of 0.2 rad: both then show the same error of the heading.",
        "7.7": "this is the sum. It is right only for independent innovations.",
        "200": "the difference of the innovations, 0.4 rad, contains no error of the heading. Its variance is only 2 · 0.02², and 0.4² / 0.0008 = 200.",
    },
    right="200",
)

# %% [markdown]
# The filter's state is the pose and all $N$ walls; `P` is its covariance, which is singular if the map
# has no errors. `H[j]` is the Jacobian of the predicted measurement of wall $j$ by the whole state,
# (08.10). Each measurement has the covariance `R`, which is positive definite. The errors of different measurements are independent of each other and of the state.
#
# An association gives each measurement a wall, or none. It is **compatible** if
#
# - it uses no wall twice,
# - each of its pairs *alone* has a $d^2$ within the gate,
# - all its pairs *jointly* have a $d^2$ within the gate.
#
# `gates[f]` is the largest $d^2$ for $f$ degrees of freedom, and `gates[0]` is 0.
#
# **Your task.** Return the compatible association with the most pairs as a list of $m$ entries, as in
# task 2, and its joint $d^2$. Of several with as many pairs, choose the one with the smallest joint
# $d^2$. Without any pair, $d^2$ is 0. You may try all associations: there are at most three
# measurements and four walls, or none. (JCBB finds the same association without trying all.)
#
# | judged | points |
# | --- | --- |
# | $d^2$ is the joint $d^2$ of the pairs that you return, with a relative error of at most $10^{-6}$; you return two pairs or more in at least half of the scenes that have them | 1.5 |
# | the association is compatible | 0.5 |
# | it is the best one; the second best, and every gate, differ by more than 1 % | 1.5 |


# %%
def associate_jointly(z, expected, H, P, R, gates):
    """The best jointly compatible association, and its squared Mahalanobis distance.

    z, expected : (m, 2), (N, 2) ρ [m], α [rad];  H : (N, 2, n);  P : (n, n), n = 3 + 2N;  R : (2, 2)
    gates : (f,) largest d² by degrees of freedom
    returns a list of m: the number 0 … N−1 of the wall, or None; d2 : float
    """
    ### BEGIN SOLUTION

    def distance(pairs):
        if not pairs:
            return 0.0
        v = np.array([z[i] - expected[j] for i, j in pairs])
        v[:, 1] = wrap(v[:, 1])
        rows = np.concatenate([H[j] for _, j in pairs])
        S = rows @ P @ rows.T + np.kron(np.eye(len(pairs)), R)
        return v.ravel() @ np.linalg.solve(S, v.ravel())

    best = (0, 0.0, [None] * len(z))
    for walls in product([None, *range(len(expected))], repeat=len(z)):
        pairs = [(i, j) for i, j in enumerate(walls) if j is not None]
        used = [j for _, j in pairs]
        d2 = distance(pairs)
        alone = all(distance([pair]) <= gates[2] for pair in pairs)
        if len(set(used)) == len(used) and alone and d2 <= gates[2 * len(pairs)]:
            best = min(best, (-len(pairs), d2, walls), key=lambda each: each[:2])
    return list(best[2]), best[1]
    ### END SOLUTION


# %%
check("08-joint")

# %% [markdown]
# This is the example of the lesson: after an inaccurate turn, the first measurement can only be wall
# A (0). The second is nearer to wall B (1) than to wall C (2). Which wall is compatible with the first?


# %%
@attempt
def _():
    z, expected = (
        np.array([[2.98, 0.05], [2.0, 1.75]]),
        np.array([[3, 0.3], [2, 1.55], [2.02, 2.02]]),
    )
    H = np.zeros((3, 2, 9))
    H[:, 0, 0], H[:, 0, 1], H[:, 1, 2] = -np.cos(expected[:, 1]), -np.sin(expected[:, 1]), -1
    for j in range(3):
        H[j, :, 3 + 2 * j : 5 + 2 * j] = np.eye(2)
    P, R = np.diag([0.05, 0.05, 0.15] + [0.02] * 6) ** 2, np.diag([0.02, 0.02]) ** 2
    print("each alone:", associate(z, expected, H @ P @ H.transpose(0, 2, 1) + R, 5.99))
    gates = np.array([0, 3.84, 5.99, 7.81, 9.49])
    walls, d2 = associate_jointly(z, expected, H, P, R, gates)
    print(f"jointly:    {walls}, d² = {d2:.1f}")


# %% [markdown]
# ## 4 · RANSAC for a round pillar
#
# The RANSAC of the lesson sometimes fits a line to the side of a pillar. This task detects the
# pillars themselves. A reading $p$ on a circle with the centre $c$ satisfies $|p - c|^2 =
# \text{radius}^2$. This equation is not linear in the unknowns. Expand the equation, and replace
# $\text{radius}^2 - |c|^2$ by a new unknown $d$:
#
# $$2\,c \cdot p + d = |p|^2.$$
#
# This equation is linear in $c_x$, $c_y$ and $d$. Three points determine the three unknowns. With
# more points, use least squares.

# %%
ask(
    "ex08-share",
    "60 % of the readings belong to the pillar. **Which fraction of the samples contains no outlier?**",
    right=22,
    tolerance=2,
    unit="%",
    reason="the minimal sample of a circle has three readings, and 0.6³ is 0.216.",
    wrong={
        60: "that is the fraction of inliers. All three readings of a sample must be inliers.",
        36: "0.6² is right for a line, which needs a minimal sample of two readings. A circle needs three.",
    },
)

# %% [markdown]
# Also consider a sample with all three readings on a *wall*. Which centre and which radius follow
# from this sample?
#
# **Your task.** Write two functions. `fit_circle` returns the centre $c$ (2,) [m] and the radius
# [m]. $c$ and $d$ must minimise the sum, over all points, of the squared difference between the
# two sides of the equation. The check calls it with three or more points, which are not all on
# one line.
#
# `find_pillar` is RANSAC with `tries` trials:
#
# 1. Draw a sample of three different readings with `rng`. The circle through them is the hypothesis.
# 2. If its radius is above `largest` [m], reject the hypothesis. (This limit is for hypotheses
#    only, not for the refitted circle below.)
# 3. Otherwise count its inliers. Inliers are the readings with a distance of at most `band` [m]
#    from the circle, inside or outside.
#
# Choose the hypothesis with the most inliers. If it has fewer than `needed` inliers, return
# `None` (`needed` is at least 3). Otherwise refit the circle to these inliers with your
# `fit_circle`. Return the centre, the radius, and an array `inside` (n,) of bool that is `True`
# for these inliers. Do not compute the inliers again after the refit, and do not compare the new
# radius with `largest`.
#
# The readings have no particular order. There may be fewer than three readings. A sample may lie
# *exactly* on one line. Then no circle goes through its readings, but your function must
# continue. You may skip such a sample. Or you may pass it to your `fit_circle` and use whatever
# circle least squares gives: with the readings of the check, this circle is never the best
# hypothesis.
#
# The check judges three results: `fit_circle`, whether the inliers are the readings of the pillar,
# and whether the returned circle is the fit to these inliers. The check stops after 10 s.


# %%
def fit_circle(points):
    """The circle by least squares of 2 c·p + d = |p|².

    points : (n, 2) [m], n ≥ 3;  returns centre (2,) [m], radius [m]
    """
    ### BEGIN SOLUTION
    A = np.column_stack([2 * points, np.ones(len(points))])
    *centre, d = np.linalg.lstsq(A, np.sum(points**2, axis=1))[0]
    return np.array(centre), np.sqrt(d + centre[0] ** 2 + centre[1] ** 2)
    ### END SOLUTION


# %%
def find_pillar(points, band, largest, needed, tries, rng):
    """The pillar with the most inliers, or None.

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
# The figure shows a pillar with a diameter of 40 cm in front of a wall, and some clutter. The wall
# has more readings than the pillar.


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
    fig, ax = views.axes("A pillar and its inliers")
    views.draw(ax, layers.Points("points", points), markersize=5)
    views.draw(ax, layers.Poses("robot", [np.zeros(3)]))
    if found is not None:
        centre, radius, inside = found
        print(f"centre ({centre[0]:.3f}, {centre[1]:.3f}) m, radius {radius:.3f} m")
        round_it = np.linspace(0, 2 * np.pi, 60)
        circle = centre + radius * np.column_stack([np.cos(round_it), np.sin(round_it)])
        pieces = np.hstack([circle[:-1], circle[1:]])
        views.draw(ax, layers.Points("corrected", points[inside]), markersize=8, label="inliers")
        views.draw(ax, layers.Segments("landmark", pieces), label="your circle")
    views.legend(ax)
    views.show(fig, alt="A pillar in front of a wall, and the circle that your function found.")


# %% [markdown]
# ## 5 · Make it better: segmentation of a whole scan
#
# A map needs all walls of a scan. In these rooms a quarter of the beams do not meet a wall, but
# people, bags or legs of chairs. These readings are clutter. A window of 25 neighbouring readings
# almost always contains clutter.

# %%
ask(
    "ex08-nine",
    "A quarter of the readings are clutter. **What is the probability that nine neighbouring "
    "readings are all of the wall?**",
    right=7.5,
    tolerance=1.5,
    unit="%",
    reason="0.75⁹ is 0.075. For two neighbours the probability is 0.56.",
    wrong={
        75: "that is right for one reading. All nine must be of the wall.",
        56: "that is right for two neighbours. Each further reading multiplies the probability by 0.75.",
    },
)

# %% [markdown]
# **Your task.** Return a label for each reading, as an array (n,) of int. Readings of one wall must
# have the same label, readings of different walls must have different labels, and clutter must have
# the label −1. All readings on one *straight line* belong to one wall, even if an object covers the
# middle of the wall. Labels of walls are integers ≥ 0, in any order.
#
# You can use any method. `points` are the readings of one turn of a lidar at the origin. They are
# ordered by their bearing, and the last reading is a neighbour of the first. Each reading has an
# error along the beam, with a standard deviation of `share` times the range. A scan has at least
# 180 readings and shows six to ten walls. Your function should not need much more than 10 ms for a
# scan, because the check stops after 10 s.
#
# **How it is scored.** Each label is matched with at most one true wall, and each true wall with at
# most one label. The check chooses the matching with the highest score. A reading is *right* if its
# label is matched with its wall. The score of a scan is
#
# $$\frac{2 \cdot \text{right}}{\text{readings of true walls} + \text{readings with a label of at least 0}},$$
#
# the $F_1$ score, which is the harmonic mean of precision and recall. It is 1 if all labels are
# right. Readings of true walls with fewer than eight readings are ignored: they count in none of
# these three numbers, whatever their labels are. The check averages the score over all 16 scans.
# Each row of the table that you reach adds its points.
#
# | step | mean score of at least | points |
# | --- | --- | --- |
# | 1 | 0.7 | 0.5 |
# | 2 | 0.84 | 1 |
# | 3 | 0.88 | 1.5 |
# | 4 | 0.92 | 1.5 |
#
# Together with 0.5 points for unchanged arguments, these are the 5 points of the task. The grader
# draws other rooms, so your score should be a little above these limits. For step 1, the mean
# score must also reach 0.7 in two scans of another lidar, which has 300 beams and a `share` of
# 0.008 instead of 0.015.
#
# You can begin as follows: find the line with the most inliers, remove these readings, and look for
# the next line. Then consider three questions. Which samples probably contain no clutter? How wide
# should the band be at short and long range, and at normal and oblique incidence (see "The
# covariance of a line" in the lesson)? To which line do you assign a reading that is an inlier of
# two lines?


# %%
def segment(points, share):
    """The wall of each reading of a scan.

    points : (n, 2) [m], in the order of their bearing;  share : float, σ of a range / range
    returns (n,) int: the label of its wall, −1 for clutter
    """
    ### BEGIN SOLUTION
    far = np.hypot(*points.T)
    beams = points / far[:, None]

    def off(normal, rho):
        # in standard deviations: σ of a range, times the cosine of the angle of incidence
        sigma = share * far * np.abs(normal @ beams.T) + 0.005
        return np.abs(normal @ points.T - np.expand_dims(rho, -1)) / sigma

    # hypotheses: lines through two readings, some beams apart
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
    # an inlier of several lines gets the nearest one
    distances = np.array([off(*line) for line in lines])
    labels = np.where(distances.min(axis=0) < 3, distances.argmin(axis=0), -1)
    small = np.bincount(labels + 1, minlength=len(lines) + 1)[1:] < 7
    return np.where(np.isin(labels, np.flatnonzero(small)), -1, labels)
    ### END SOLUTION


# %%
check("08-segments")

# %% [markdown]
# The figure shows a scan with such clutter. Each of your walls has its own colour and marker.


# %%
def draw_walls(points, share):
    """Draw a scan, and your walls."""
    labels = np.asarray(segment(points.copy(), share))
    fig, ax = views.axes("Your walls; clutter in grey")
    for k in np.unique(labels):
        colour, _, mark = views.SERIES[int(k) % len(views.SERIES)]
        style = {"color": colour, "marker": mark, "markersize": 4}
        grey = {"color": views.COLOURS["walls"], "markersize": 4}
        of = layers.Points("scan", points[labels == k])
        views.draw(ax, of, label="_walls", **(grey if k < 0 else style))
    views.draw(ax, layers.Poses("robot", [np.zeros(3)]))
    views.show(fig, alt="A scan of a room with clutter; each wall has its own colour.")


# %%
@attempt
def _():
    rng = np.random.default_rng(4)
    angles = np.linspace(-np.pi, np.pi, 180, endpoint=False)
    beams = np.column_stack([np.cos(angles), np.sin(angles)])
    # walls (ρ, α) around the robot, and the range to the nearest one along each beam
    room = [(2.0, 0.3), (1.6, 1.87), (3.1, -2.84), (1.2, -1.27), (2.2, 0.95)]
    reach = np.full(180, np.inf)
    for rho, alpha in room:
        towards = np.cos(angles - alpha)
        reach = np.minimum(reach, np.where(towards > 1e-6, rho / np.maximum(towards, 1e-6), np.inf))
    reach *= 1 + 0.015 * rng.standard_normal(180)
    clutter = rng.random(180) < 0.25
    reach[clutter] *= rng.uniform(0.2, 0.95, clutter.sum())
    draw_walls(reach[:, None] * beams, 0.015)


# %% [markdown]
# If the recording of the RPLIDAR A2 is on this computer, the last cell labels one of its revolutions. It is not judged.
# Which of your walls are not walls?


# %% name="a2"
@attempt
def _():
    from slamlab import sources

    try:
        log = sources.open(sources.recording("rplidar-a2-1"))
    except sources.SourceError as missing:
        print(missing)
        return
    points = list(log)[2].scan.points()
    draw_walls(points[np.argsort(np.arctan2(points[:, 1], points[:, 0]))], 0.01)


# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then shows the grader's verdict. The grader draws other inputs.
# **Next:** [lesson 09](../notebooks/09_slam_with_walls.ipynb) uses walls as the landmarks of
# EKF-SLAM.
