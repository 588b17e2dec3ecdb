# %% [markdown]
# # Exercise 07 · Correlations, consistency and cost of EKF-SLAM
#
# **You will be able to** compute how two landmarks become correlated, extend an update of some
# state entries to the whole state, fuse correlated estimates consistently, derive the lower bound
# of the map's covariance, and estimate a common error of unknown variance.
#
# **60 minutes. Before:** lessons [03](../notebooks/03_kalman_filter.ipynb) to
# [07 · Correlations, consistency and cost of EKF-SLAM](../notebooks/07_correlations.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it. You can repeat this as often as you like. A check tries random inputs and special cases that
# the text allows. If your answer breaks a law, the check shows a small input that breaks it.
# `hint("07-fuse")` in a cell of your own asks a guiding question. A function must not change its
# arguments.
#
# All lengths are in metres, all angles in radians. A given covariance is symmetric and positive definite, unless the
# task states otherwise. An error, marked by a tilde, is the true value minus the estimate.

# %%
import numpy as np

from classroom.checks import ask, attempt, check
from slamlab import views
from slamlab.geometry import compose
from slamlab.models import H_robot

# %% [markdown]
# The entries of a covariance are in m², m·rad and rad², which are hard to compare. The correlation
# coefficient (07.7) is a number without a unit, from −1 to 1. The figures use this function, which
# computes the correlation matrix:


# %%
def correlation(P):
    """The correlation coefficients ρ_ij = P_ij / (σ_i σ_j) of a covariance (n, n)."""
    sigma = np.sqrt(np.diag(P))
    return P / np.outer(sigma, sigma)


# %% [markdown]
# ## 1 · Two landmarks, two measurements
#
# This task uses the example of the lesson. The state consists of the robot's pose (three entries)
# and two landmarks, $p_1$ and $p_2$ (two entries each). The robot measures $p_1$ and then $p_2$. It
# does not move between the two measurements. `H_1` and `H_2` are the (2, 7) Jacobians $[H_{\mathrm
# r}\ \ H_{\mathrm p}\ \ 0]$ and $[H_{\mathrm r}\ \ 0\ \ H_{\mathrm p}]$ of (07.2).

# %%
ask(
    "ex07-learn",
    "In a corridor a position is one number. The errors of the robot, of $p_1$ and of $p_2$ are "
    "independent, with the variance 1 m² each, and the sensor has no noise. The robot measures $p_1$, "
    "and then $p_2$, without moving. **What is the variance of $p_1$ at the end?**",
    {
        "½ m²: it was measured only once": "this is the variance after the first measurement. The second one also corrects the robot, and $p_1$ with it.",
        "⅓ m²": "the measurements give the exact distances, so the three estimates become three independent estimates of one position.",
        "0: the sensor has no noise": "the sensor measures differences only. A shift of all three positions changes no measurement.",
        "1 m²: the position of the robot is unknown": "the prior of the robot also contains information about $p_1$, once their distance is known.",
    },
    right="⅓ m²",
)

# %% [markdown]
# **Your task.** Return the covariance after the first measurement and the covariance after both
# measurements, (7, 7) each. `P` and `R` may be diagonal or full. The units may differ from metres
# and radians. (The MAK thesis prints these formulas with several errors, so derive the formulas and
# do not copy them.) The check compares both covariances with least squares from the prior and all
# measurements.


# %%
def two_updates(P, H_1, H_2, R):
    """The covariances after the measurement of the first landmark, and after both measurements.

    P : (7, 7);  H_1, H_2 : (2, 7) Jacobians;  R : (2, 2) covariance of each measurement
    returns P_first (7, 7), P_both (7, 7)
    """

    ### BEGIN SOLUTION
    def update(P, H):
        S = H @ P @ H.T + R
        K = P @ H.T @ np.linalg.inv(S)
        return P - K @ S @ K.T

    P_first = update(P, H_1)
    P_both = update(P_first, H_2)
    return P_first, P_both
    ### END SOLUTION


# %%
check("07-two-updates")

# %% [markdown]
# The figure shows the correlation matrices before and after each measurement:


# %% answers="ex07-learn"
@attempt
def _():
    P = np.diag([0.2, 0.2, 0.1, 0.5, 0.5, 0.5, 0.5]) ** 2
    H_a, H_b = (H_robot(np.array([0, 0, 0.3]), p) for p in ([2.0, 1.0], [1.0, -2.0]))
    none = np.zeros((2, 2))
    H_1, H_2 = np.hstack([H_a, -H_a[:, :2], none]), np.hstack([H_b, none, -H_b[:, :2]])
    P_first, P_both = two_updates(P, H_1, H_2, np.diag([0.05, 0.03]) ** 2)
    fig, axes = views.panels(["before", "after p1", "after p1 and p2"], (10, 3.4), shared=False)
    for ax, covariance in zip(axes, [P, P_first, P_both], strict=True):
        views.correlation(correlation(covariance), ["r", "p1", "p2"], ax=ax)
        ax.set(xlabel="", ylabel="", aspect="equal", adjustable="box")
    views.colour_bar(axes)
    views.show(fig, alt="Three correlation matrices: diagonal, then two blocks filled, then all.")
    sigmas = [np.sqrt(C[3, 3]) for C in (P, P_first, P_both)]
    print("σ of p1's x [m], before and after each measurement:", np.round(sigmas, 3))


# %% [markdown] answers="ex07-learn"
# **See:** the last matrix has no white block. The robot did not measure the distance from $p_1$ to
# $p_2$, but their errors are correlated, because both errors contain the error of the pose. The
# measurement of $p_2$ also reduced $\sigma$ of $p_1$ a little.

# %% [markdown]
# ## 2 · Update of landmarks that are not measured
#
# In task 1 a measurement of $p_2$ corrected $p_1$. In a large map this is expensive, because each
# measurement changes every landmark. The compressed EKF of the lesson avoids this cost. This task
# uses another method: a second, small filter estimates only the robot and the few landmarks in
# view. It starts from their entries in the large map and uses any number of measurements. Then it
# reports `x_seen` and `P_seen`, the new estimate of these entries and its covariance. It does not
# report its measurements, so there is no $H$, no $R$ and no innovation. It has not measured any
# other landmark.
#
# But the estimates of the other landmarks must change as well. Let $s$ be the indices of the
# entries in view. Split the error of all entries into a linear function of the errors in view, and
# a remainder that is uncorrelated with these errors:
#
# $$\tilde x = G\,\tilde x_s + \text{rest}$$
#
# You know such a matrix $G$ from lesson 03: it is a gain. The measurements depend on $x_s$ only.
# Therefore they contain no information about the remainder, and they change neither the remainder
# nor $G$. The new $\hat x$ and $P$ follow from this.
#
# Test your formula in two cases. If the small filter returns `P_seen = 0`, its entries are known
# exactly. What is then the covariance of the other entries? How do the other entries change if they
# are uncorrelated with the entries in view?
#
# **Your task.** Return the new state (n,) and its covariance (n, n). `seen` contains the indices of
# the entries of `x` that are in view, counted from 0, in any order, each once. At least one entry
# is in view, and all entries may be in view. `x_seen` and `P_seen` have the same order. No entry is
# an angle, so nothing has to be wrapped. `P` is positive definite; `P_seen` may be 0. The check
# judges the state, the rows and columns of `P` in view, and the rest of `P`.


# %%
def update_rest(x, P, seen, x_seen, P_seen):
    """Update of the whole state from a new estimate of some of its entries.

    x : (n,), P : (n, n) before;  seen : (k,) int, indices of the entries in view
    x_seen : (k,), P_seen : (k, k), new estimate of these entries
    returns x (n,), P (n, n)
    """
    ### BEGIN SOLUTION
    P_ss = P[np.ix_(seen, seen)]
    G = P[:, seen] @ np.linalg.inv(P_ss)
    return x + G @ (x_seen - x[seen]), P - G @ (P_ss - P_seen) @ G.T
    ### END SOLUTION


# %%
check("07-update-rest")

# %% [markdown]
# The next cell uses the loop of the lesson at the time of its loop closure, when the robot measures
# the first landmarks again. The filter of the lesson updates the whole map with this measurement.
# Your function gets only the new estimate of the robot and of the landmarks in view.


# %%
@attempt
def _():
    from slamlab.estimators.ekf_slam import EkfSlam, Q_arc
    from slamlab.sources.landmark_runs import LandmarkRun, Loop

    loop = Loop(landmarks=16, steps=96, v_sigma=0.04, omega_sigma=0.03, range_max=2.2)
    source = LandmarkRun(loop, np.random.default_rng(7))
    slam = EkfSlam(source.robot, source.sensor)
    *before, closing = list(source)[:77]
    for reading in before:
        slam.step(reading)
    whole, pose, odometry = slam.filter, slam.filter.pose, closing.odometry
    whole.predict(compose(pose, odometry), Q_arc(pose, odometry, source.robot))
    x, P = whole.x.copy(), whole.P.copy()
    ids = closing.observations.ids.tolist()
    R = np.diag([loop.range_sigma, loop.bearing_sigma]) ** 2
    whole.update(ids, closing.observations.z, R)
    seen = np.array([0, 1, 2, *whole.rows(ids)])
    reported = whole.x[seen], whole.P[np.ix_(seen, seen)]
    yours_x, yours_P = update_rest(x.copy(), P.copy(), seen, *reported)
    off = max(abs(yours_x - whole.x).max(), abs(yours_P - whole.P).max())
    print(f"in view: {ids}; largest difference from the whole filter: {off:.9f}")

    def spread(P):
        return 100 * np.sqrt(np.diag(P)[3:].reshape(-1, 2).sum(axis=1))

    ys = {
        "before the measurement": spread(P),
        "the whole filter": spread(whole.P),
        "yours": spread(yours_P),
    }
    fig, _ = views.curves(
        np.arange(len(whole.ids)), ys, "landmark, in the order of the first measurement", "σ [cm]"
    )
    views.show(
        fig, alt="σ of each landmark before and after: nearly all decrease, measured or not."
    )


# %% [markdown]
# **See:** the two lower curves coincide. The landmarks that were added last have the largest σ, and
# their σ decreases most when the first landmarks are measured again. Your function computed this
# without the measurements. Therefore a filter can postpone the update of far landmarks without
# loss, as the compressed EKF does.

# %% [markdown]
# ## 3 · Fusion of correlated estimates
#
# A robot has estimated the same landmark twice from the same pose, as $a$ and as $b$. Both
# estimates contain the error of the pose. The errors $\tilde a$ and $\tilde b$ have the covariances
# `P_a` and `P_b`, and the cross-covariance $P_{ab} = E[\tilde a\,\tilde b^{\mathsf T}]$. We look
# for $x = a + K\,(b - a)$.
#
# Take $b - a$ as the innovation. From lesson 03 you know the best gain, $K = S_{xv} S^{-1}$. Here
# $S_{xv}$ is the cross-covariance of $\tilde a$ and $\tilde a - \tilde b$, and $S$ is the
# covariance of $\tilde a - \tilde b$. Then $P = P_a - K S K^{\mathsf T}$. What are $S_{xv}$ and
# $S$?

# %%
ask(
    "ex07-twice",
    "Each of the two estimates has the variance 1, in x and in y, and their correlation coefficient "
    "is nearly 1. **What is the variance of the best estimate from both?**",
    {
        "nearly ½": "this would be right for independent errors. The mean of the two estimates does not reduce an error that is common to both.",
        "nearly 1": "the two errors are nearly equal, so the second estimate contains hardly any new information.",
        "nearly 0: they agree with each other": "their agreement shows only that they have the same error.",
    },
    right="nearly 1",
)

# %% [markdown]
# **Your task.** Return the minimum variance estimate $x$ (2,) [m] and its covariance `P` (2, 2)
# [m²]. The errors may be uncorrelated, strongly correlated or negatively correlated, and `P_ab`
# need not be symmetric. `P_a`, `P_b` and `P_ab` together are the covariance (4, 4) of both errors,
# and this matrix is invertible. The check compares $x$ and `P` with least squares.


# %%
def fuse(a, P_a, b, P_b, P_ab):
    """The minimum variance estimate from two correlated estimates, and its covariance.

    a, b : (2,) [m];  P_a, P_b : (2, 2) [m²];  P_ab : (2, 2) [m²], rows for the error of a, columns for b
    returns x (2,), P (2, 2)
    """
    ### BEGIN SOLUTION
    S = P_a + P_b - P_ab - P_ab.T
    K = (P_a - P_ab) @ np.linalg.inv(S)
    return a + K @ (b - a), P_a - K @ S @ K.T
    ### END SOLUTION


# %%
check("07-fuse")

# %% [markdown]
# The figure shows the errors of your estimate for 500 pairs with strongly correlated errors. The second ellipse is
# the `P` that your function returns for $P_{ab} = 0$.


# %%
@attempt
def _():
    common, own = np.diag([0.30, 0.15]) ** 2, np.diag([0.10, 0.10]) ** 2
    P_a, P_b, P_ab = common + own, common + 2 * own, common
    joint = np.block([[P_a, P_ab], [P_ab.T, P_b]])
    pairs = np.random.default_rng(7).multivariate_normal(np.zeros(4), joint, 500)
    errors = np.array([fuse(e[:2], P_a, e[2:], P_b, P_ab)[0] for e in pairs])
    claims = {
        "your P, 95 %": fuse(np.zeros(2), P_a, np.zeros(2), P_b, P_ab)[1],
        "P_ab ignored": fuse(np.zeros(2), P_a, np.zeros(2), P_b, 0 * P_ab)[1],
    }
    fig, _ = views.cloud(errors, claims)
    views.show(fig, alt=f"The errors of {len(errors)} fused estimates and two ellipses for them.")


# %% [markdown]
# **See:** about 95 % of the errors should lie in your ellipse. The other ellipse is overconfident: it assumes that
# fusion averages out an error that is common to both estimates.

# %% [markdown]
# ## 4 · The lower bound of the map's covariance
#
# A robot starts at the estimated pose `x`, whose error has the covariance `P`. Its map is empty. It
# stands still and measures landmark $i$, at `p[i]` in the world frame, again and again. Each
# measurement of its position relative to the robot has an independent error, with the variance
# `sigma[i]`² on each of two perpendicular axes and without correlation between the axes. The mean
# of $n$ measurements has the variance `sigma[i]`²$/n$, but all measurements contain the same error
# of the start. This part of the map's covariance remains for $n \to \infty$. It is a *lower bound*,
# also if the robot drives on: no later measurement contains information about its start.
#
# How does a small error $(\tilde x, \tilde y, \tilde\theta)$ of the start move and turn the map? You
# have met such a common error of all landmarks in lesson 07. Now derive it yourself.
#
# **Your task.** Return two values. `L` (2m, 2m) is the limit of the covariance of all landmarks, in
# the order $x_0, y_0, x_1, y_1, \ldots$, linearised at `x` and `p`. `n` (m,) holds, for each
# landmark, the least number of measurements, at least one, after which the trace of its covariance
# (2, 2) is at most `1 + share` times the trace of its limit. `sigma` and `share` are above 0. There
# is at least one landmark, and it may be at the robot's position.
#
# | judged | how | points |
# | --- | --- | --- |
# | the (2, 2) blocks of `L` on the diagonal | only errors of rounding: at most $3\cdot 10^{-14}$ of the largest coordinate or entry | 1 |
# | all of `L` | as above | 1.5 |
# | `n` | exactly | 1 |
#
# A difference quotient of two values does not reach this accuracy. One set of inputs has coordinates
# of $10^9$ m, where an error of $10^{-8}$ of the largest entry is allowed.


# %%
def lower_bound(x, P, p, sigma, share):
    """The limit of the map's covariance, and how many measurements come close to it.

    x : (3,) start, P : (3, 3);  p : (m, 2) landmarks [m];  sigma : (m,) σ of a measurement [m]
    share : float above 0, by which the trace of a landmark's covariance may exceed its limit
    returns L (2m, 2m), n (m,)
    """
    ### BEGIN SOLUTION
    J = np.zeros((2 * len(p), 3))
    J[0::2, 0] = J[1::2, 1] = 1
    J[0::2, 2], J[1::2, 2] = -(p[:, 1] - x[1]), p[:, 0] - x[0]
    L = J @ P @ J.T
    trace = np.diag(L).reshape(-1, 2).sum(axis=1)
    n = np.ceil(2 * sigma**2 / (share * trace))
    return L, np.maximum(n, 1)
    ### END SOLUTION


# %%
check("07-bound")

# %% [markdown]
# The next cell tests your bound without any Jacobian. It draws 2000 errors of the start and places
# the mean of $n$ measurements of each landmark in the world frame by the estimated pose. The thick
# curves are the rms position errors of three landmarks. The thin lines are the roots of the traces
# of your `L`.


# %%
@attempt
def _():
    rng, P = np.random.default_rng(7), np.diag([0.1, 0.1, 0.04]) ** 2
    p, sigma = np.array([[1.0, 0.5], [-2.0, 2.0], [5.0, -3.0]]), np.full(3, 0.4)
    L, n = lower_bound(np.zeros(3), P.copy(), p.copy(), sigma.copy(), 0.1)
    counts = np.unique(np.geomspace(1, 300, 25).astype(int))
    starts, ys = rng.multivariate_normal(np.zeros(3), P, 2000), {}
    for i, landmark in enumerate(p):
        turned = compose(starts, np.append(landmark, 0))[:, :2] - landmark
        own = rng.standard_normal((len(counts), len(starts), 2)) * sigma[i]
        errors = turned + own / np.sqrt(counts)[:, None, None]
        ys[f"landmark {i}, n = {n[i]:.0f}"] = 100 * np.sqrt(np.square(errors).sum(axis=2).mean(1))
    fig, ax = views.curves(counts, ys, "measurements of each landmark", "rms error [cm]")
    for i in range(3):
        limit = 100 * np.sqrt(np.trace(L[2 * i : 2 * i + 2, 2 * i : 2 * i + 2]))
        ax.axhline(limit, linestyle="--", color=views.SERIES[i][0], linewidth=1)
    ax.set(xscale="log", ylim=(0, None))
    views.show(fig, alt="Errors of three landmarks, which fall towards three limits.")


# %% [markdown]
# **See:** each curve falls to its thin line and not below it. The limit of the landmark far from the
# robot is the largest, because the error of the heading moves it most. This landmark needs the
# fewest measurements: further ones hardly improve a map whose start is uncertain.

# %% [markdown]
# ## 5 · A common error of unknown variance (open)
#
# This task is open: you can use any method. The check shows how good your method is.
#
# Every morning somebody puts the robot into the corridor and enters its position, with an error.
# The robot passes some doors and measures the position of each. Every reading has an independent
# error with the known standard deviation `sigma`. In addition, *all* readings of one morning
# contain the same error, because the initial position has an error. The common errors are Gaussian
# with mean 0 and the same variance on all mornings of a corridor, but this variance is unknown.
# Their standard deviation is 0.5 to 20 times `sigma`. Estimate the map and its covariance.
#
# The simplest method is the mean of each door's readings, with the variance `sigma`² divided by
# their number. This estimate is inaccurate, and its variances are overconfident.

# %%
ask(
    "ex07-way",
    "The common error of a morning is about 1 m, and `sigma` is 2 cm. On several mornings the "
    "robot passed two neighbouring doors. **How accurately can you estimate the distance between "
    "the two doors?**",
    {
        "to about a metre, the error of the readings": "each reading has this error, but the two readings of one morning have the same common error.",
        "to a metre divided by the root of the number of mornings": "this is the accuracy of the mean of each door's readings. The readings contain more information.",
        "to two or three centimetres, or better": "the common error of a morning is the same for both doors, so their difference does not contain it.",
    },
    right="to two or three centimetres, or better",
)

# %% [markdown]
# These questions may help you to begin. How accurate is the distance between two doors that the
# robot never passed on the same morning? What could be the state, and what would its covariance
# contain? How can you estimate the variance of the common errors from the readings? What happens in
# lesson 07 if the state of a filter does not contain such an error?
#
# **Your task.** Return the positions `p` (m,) [m] of the doors and their covariance `P` (m, m)
# [m²]. Reading `z[k]` belongs to morning `morning[k]` and door `door[k]`. Mornings and doors are
# numbered from 0, without gaps. Each morning has at least two readings, of different doors. Any two
# doors are connected by a chain of doors; each door of the chain and the next one were passed on
# the same morning. The number of doors varies. The check stops after 10 s.
#
# **How it is scored.** The check draws 96 corridors of eight doors. It judges three averages over
# the corridors:
#
# - The mean square error of the doors, divided by the smallest possible mean square error.
# - The NEES of the *distances*: the joint NEES of all $m - 1$ distances between neighbouring doors,
#   with their covariance by your `P`, divided by $m - 1$. Its expected value is 1.
# - The NEES of the *single doors*: the square error of each door divided by its variance in your
#   `P`, averaged over the doors. The entries of `P` beside the diagonal are not used. Its expected
#   value is 1. It is averaged twice: over the 48 corridors whose common errors are small in units of
#   `sigma`, and over the 24 others.
#
# | row | required | points |
# | --- | --- | --- |
# | 1 | mean square error at most 1.65 times the least possible | 1 |
# | 2 | mean square error at most 1.04 times the least possible | 1 |
# | 3 | row 1, and NEES of the distances from 0.9 to 1.1 | 1 |
# | 4 | row 1, and NEES of the single doors from 0.8 to 1.3 in both halves | 1.5 |
#
# Rows 3 and 4 require row 1, but not row 2, and row 4 does not require row 3. The points of all
# rows that you reach are added. Leaving the arguments unchanged is worth another 0.5 points. Row 1
# is also judged on 24 corridors of two doors and on 24 corridors of fourteen doors.


# %%
def survey(morning, door, z, sigma):
    """A map of doors from readings with a common error of unknown variance on each morning.

    morning, door : (k,) int, counted from 0;  z : (k,) measured position of the door [m]
    sigma : float, standard deviation of a reading's independent error [m]
    returns p (m,) positions of the doors [m], P (m, m) their covariance [m²]
    """
    ### BEGIN SOLUTION
    m, n = door.max() + 1, morning.max() + 1
    # a reading is the position of its door, plus the common error, plus an independent one
    J = np.hstack([np.eye(m)[door], np.eye(n)[morning]])
    size = 10 * sigma  # standard deviation of the common errors: initial guess
    for _ in range(8):
        known = np.concatenate([np.zeros(m), np.full(n, 1 / size**2)])
        C = np.linalg.inv(J.T @ J / sigma**2 + np.diag(known))
        state = C @ J.T @ z / sigma**2
        # expected mean square of the common errors: estimates squared, plus their variances
        size = np.sqrt(np.mean(state[m:] ** 2 + np.diag(C)[m:]))
    return state[:m], C[:m, :m]
    ### END SOLUTION


# %%
check("07-mornings")

# %% [markdown]
# The next cell simulates 200 surveys of one corridor. Each survey has twelve mornings. The common
# error has $\sigma = 30$ cm, and the independent error has $\sigma = 4$ cm. For each door, the
# figure shows the rms error of the mean of its readings, the rms error of your estimate, and the σ
# from your `P`.


# %%
@attempt
def _():
    rng, sigma, errors = np.random.default_rng(7), 0.04, {"mean": [], "yours": []}
    doors, first = 3.0 * np.arange(8), np.rint(np.linspace(0, 5, 12)).astype(int)
    morning = np.repeat(np.arange(12), 3)
    door = (first[:, None] + np.arange(3)).ravel()
    claims = []
    for _ in range(200):
        z = doors[door] + 0.3 * rng.standard_normal(12)[morning]
        z += sigma * rng.standard_normal(len(door))
        p, P = survey(morning.copy(), door.copy(), z.copy(), sigma)
        errors["yours"].append(p - doors)
        errors["mean"].append(np.bincount(door, z) / np.bincount(door) - doors)
        claims.append(np.diag(P))
    rms = {name: 100 * np.sqrt(np.mean(np.square(e), axis=0)) for name, e in errors.items()}
    ys = {
        "yours": rms["yours"],
        "mean of readings": rms["mean"],
        "σ by your P": 100 * np.sqrt(np.mean(claims, axis=0)),
    }
    fig, ax = views.curves(np.arange(8), ys, "door", "error [cm]")
    ax.set_ylim(bottom=0)
    views.show(fig, alt="Error of each door by the mean of its readings and by your survey.")


# %% [markdown]
# **See:** the robot passed the first and the last door on two mornings only. The mean of the
# readings has an error about twice as large as necessary for these two doors. A map that keeps the
# correlations estimates them as accurately as the others: each of the twelve mornings contributes,
# even those without a reading of these doors.

# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then shows the grader's verdict. The grader draws other inputs.
# **Next:** in [lesson 08](../notebooks/08_landmarks_from_scans.ipynb) the identity of a landmark is
# not given, and data association uses $S$, with all its correlations.
