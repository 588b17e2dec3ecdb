# %% [markdown]
# # Exercise 06 · EKF-SLAM: the MAK filter
#
# **You will be able to** write EKF-SLAM yourself: state augmentation, update, and the loop that
# calls them. You will also test whether your filter is consistent, by NIS and NEES, and make it robust
# against outliers.
#
# **60 minutes. Before:** lesson [06 · EKF-SLAM: the MAK filter](../notebooks/06_ekf_slam.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it. You can repeat this as often as you like. A check tries random inputs and special cases that
# the text allows, such as an empty map or a map of many landmarks. If your answer breaks a law, the
# check shows a small input that breaks it. `hint("06-augment")` in a cell of your own asks a
# guiding question.
#
# All lengths are in metres, all angles in radians. The joint state (06.1) is `x = [x, y, θ, p_0x,
# p_0y, p_1x, p_1y, …]`, and `P` is its covariance. Landmarks are numbered from 0. A control input
# is `u = [d, Δθ]`, and a measurement `z = [r, β]` is a range and a bearing. You have the models
# and, from exercise 04, their Jacobians. The data association is known. A heading may be any
# number, also beyond $\pi$, in the arguments and in your results. A function must not change its
# arguments.

# %%
import numpy as np
from scipy.special import gammaincinv

from classroom.checks import ask, attempt, check
from slamlab import views
from slamlab.geometry import wrap
from slamlab.layers import Ellipses, Points, Poses
from slamlab.models import A_odometry, H_landmark, H_robot, J_xr, J_z, W_odometry, f_odometry, g, h

# %% [markdown]
# ## What you are given
#
# A control input $u$ whose errors have the covariance $C$ changes the pose and no landmark (06.3), with the
# process noise $Q = W C W^{\mathsf T}$. A measurement of landmark $j$ depends on the pose and on this landmark
# only, so only five columns of $H$ are not zero (06.7):
#
# $$P_{\mathrm{rr}} \leftarrow A P_{\mathrm{rr}} A^{\mathsf T} + W C W^{\mathsf T}, \qquad P_{\mathrm ri} \leftarrow A P_{\mathrm ri}, \qquad
# H = \begin{bmatrix} H_{\mathrm r} & 0 & \cdots & H_{\mathrm p} & \cdots & 0 \end{bmatrix}.$$
#
# Prediction and $H$ are given.


# %%
def predict(x, P, u, C):
    """Prediction with the control input u; returns x (n,), P (n, n)."""
    A, W = A_odometry(x[:3], u), W_odometry(x[:3], u)
    x, P = x.copy(), P.copy()
    x[:3] = f_odometry(x[:3], u)
    P[:3, :3] = A @ P[:3, :3] @ A.T + W @ C @ W.T
    P[:3, 3:] = A @ P[:3, 3:]
    P[3:, :3] = P[:3, 3:].T
    return x, P


def H_full(x, j):
    """Jacobian of h(x, p_j) with respect to the whole state: (2, n)."""
    its = slice(2 * j + 3, 2 * j + 5)
    H = np.zeros((2, len(x)))
    H[:, :3], H[:, its] = H_robot(x[:3], x[its]), H_landmark(x[:3], x[its])
    return H


# %% [markdown]
# ## 1 · State augmentation: a new landmark
#
# The robot measures a landmark for the first time. The measurement is `z`, and its errors have the
# covariance `R` (2, 2). The position of the landmark is `g(x[:3], z)` (06.4).
#
# **Your task.** Append the new landmark to the state, and its two rows and columns to the
# covariance. The map may be empty. The pose may be known exactly, so that its block of $P$ is zero.
# The check judges the old parts of `x` and `P`, the new position, and each new block of `P`.


# %%
def augment(x, P, z, R):
    """A new landmark was measured; returns x (n + 2,), P (n + 2, n + 2).

    x : (n,) state;  P : (n, n);  z : (2,) r [m], β [rad];  R : (2, 2) covariance of z
    """
    ### BEGIN SOLUTION
    Jxr, Jz = J_xr(x[:3], z), J_z(x[:3], z)
    row = Jxr @ P[:3]
    P_nn = Jxr @ P[:3, :3] @ Jxr.T + Jz @ R @ Jz.T
    return np.append(x, g(x[:3], z)), np.block([[P, row.T], [row, P_nn]])
    ### END SOLUTION


# %%
check("06-augment")

# %% [markdown]
# In the next cell a robot starts at an exactly known pose and adds three landmarks, one after each metre. The
# figure shows their correlation matrix. A white block would mean that two landmarks are uncorrelated.


# %%
@attempt
def _():
    from slamlab.evaluation import correlation

    x, P = np.zeros(3), np.zeros((3, 3))
    C, R = np.diag([0.05, 0.05]) ** 2, np.diag([0.05, 0.02]) ** 2
    for z in ([2.0, 0.8], [3.0, -0.6], [2.5, 1.1]):
        for _ in range(4):
            x, P = predict(x, P, np.array([0.25, 0.05]), C)
        x, P = augment(x, P, np.array(z), R)
    fig, _ = views.correlation(correlation(P), ["robot", "0", "1", "2"], size=(8, 6.5))
    views.show(fig, alt="The correlation matrix of a robot and three landmarks.")


# %% [markdown]
# No block should be white. The position of each landmark was computed from the pose, so it contains
# the error of the pose.

# %% [markdown]
# ## 2 · Update: a known landmark
#
# The robot measures landmark `j` again, by `z`. With $v = z - h(x_{\mathrm r}, p_j)$ and $S = H P
# H^{\mathsf T} + R$, the update is (06.9):
#
# $$K = P H^{\mathsf T} S^{-1}, \qquad x \leftarrow x + K v, \qquad P \leftarrow P - K S K^{\mathsf T}.$$
#
# **Your task.** Return the state and the covariance after the update. `H_full` above computes $H$.
# The map contains at least one landmark, and $P$ is positive definite. The check compares
# your `x` and `P` with the least squares estimate from the prior and the measurement, with $h$
# linearised at the prior.


# %%
def update(x, P, z, j, R):
    """Landmark j was measured; returns x (n,), P (n, n).

    x : (n,) state;  P : (n, n);  z : (2,) r [m], β [rad];  j : int;  R : (2, 2) covariance of z
    """
    ### BEGIN SOLUTION
    at = 3 + 2 * j
    v = z - h(x[:3], x[at : at + 2])
    v[1] = wrap(v[1])
    H = H_full(x, j)
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    x = x + K @ v
    x[2] = wrap(x[2])
    return x, P - K @ S @ K.T
    ### END SOLUTION


# %%
check("06-update")

# %%
ask(
    "ex06-who",
    "A robot started at an exactly known pose and added landmarks 0, 1 and 2. It drove one metre "
    "after each of them. Now it measures landmark 0 again, and the range is 20 cm shorter than "
    "predicted. **Which of the three landmarks does the update move most?**",
    {
        "landmark 0, which was measured": "it was added from a known pose, so its variance is the smallest. The update corrects mainly "
        "the pose, whose variance is larger.",
        "only landmark 0: the others were not measured": "the errors of the other landmarks are correlated with the present error of the pose, so the update corrects them, too.",
        "landmark 1": "landmark 1 moves, but the error of the pose was larger when the robot added landmark 2.",
        "landmark 2, the last one added": "the variance of the pose was largest when the robot "
        "added landmark 2, so the error of landmark 2 has the strongest correlation with the "
        "present error of the pose.",
    },
    right="landmark 2, the last one added",
)


# %% answers="ex06-who"
@attempt
def _():
    x, P = np.zeros(3), np.zeros((3, 3))
    C, R = np.diag([0.05, 0.05]) ** 2, np.diag([0.05, 0.02]) ** 2
    for z in ([5.0, 0.2], [3.0, -0.6], [2.5, 1.1]):
        x, P = augment(x, P, np.array(z), R)
        for _ in range(4):
            x, P = predict(x, P, np.array([0.25, 0.05]), C)
    after, P_after = update(x, P, h(x[:3], x[3:5]) - [0.2, 0], 0, R)
    for name, k in [("robot", 0), ("landmark 0", 3), ("landmark 1", 5), ("landmark 2", 7)]:
        far = 100 * np.hypot(*(after - x)[k : k + 2])
        sigma, now = (100 * np.sqrt(M[k, k] + M[k + 1, k + 1]) for M in (P, P_after))
        print(f"{name:11} moves {far:4.1f} cm, its σ goes from {sigma:4.1f} to {now:4.1f} cm")


# %% [markdown] answers="ex06-who"
# The update corrects mainly the pose, because the variance of the pose is far larger than the
# variance of landmark 0. It also moves the landmarks that contain the error of the pose.

# %% [markdown]
# ## 3 · The whole filter
#
# One step of SLAM consists of a control input `u` and then a scan: `z[k]` is the measurement of the
# landmark with the id `seen[k]`. A scan may be empty, or contain several new landmarks. `ids` is the list of the ids of all landmarks
# in the state: `ids[j]` is the id of landmark `j`.
#
# **Your task.** Return the state, the covariance and the ids after the step. Use your functions
# from tasks 1 and 2.
#
# The check runs your filter on twenty runs of 8 steps, with the same trajectory and the same four
# landmarks but different noise, and judges the last `x` and `P` of each run:
#
# * The map contains each measured landmark exactly once, in any order (1 point). The other items
#   require this one.
# * The pose is consistent: its mean NEES over the runs lies between 0.84 and 7.7; the expected
#   value is 3 (1 point). The map is consistent: the mean NEES of all eight landmark coordinates
#   lies between 3.7 and 15.5; the expected value is 8 (1 point). These χ² bands are so wide that a
#   consistent filter practically never fails by chance. They must also hold in twenty runs in which
#   the robot drives away from all landmarks.
# * The filter agrees with batch least squares over the whole run: it uses every measurement, and
#   none of them twice (2 points). Let $d$ be the difference of your `x` from the least squares
#   estimate, and $n$ the number of its entries. The mean of $d^{\mathsf T} P^{-1} d / n$ over the
#   runs, with your `P`, is at most 0.2: the rms difference is at most 0.45 σ of your `P`. Let $\bar
#   P$ be the mean of your twenty `P`, and $P_{\mathrm{LS}}$ the covariance of the least squares
#   estimate. For every vector $a$, the variance $a^{\mathsf T} \bar P a$ is 0.75 to 1.33 times the
#   variance $a^{\mathsf T} P_{\mathrm{LS}}\, a$. On average over all directions, it is 0.965 to
#   1.035 times as large: this is the trace of $P_{\mathrm{LS}}^{-1} \bar P$, divided by $n$.
#
# Leaving the arguments unchanged is worth another 0.5 points. The check stops after 10 s.


# %%
def slam_step(x, P, ids, u, seen, z, C, R):
    """One step of EKF-SLAM; returns x, P, ids.

    x : (n,), P : (n, n), ids : list of int    the state, and the ids of its landmarks
    u : (2,) control input, of covariance C (2, 2)
    seen : list of m ids;  z : (m, 2) their measurements, each of covariance R (2, 2)
    """
    ### BEGIN SOLUTION
    x, P = predict(x, P, u, C)
    for i, one in zip(seen, z, strict=True):
        if i in ids:
            x, P = update(x, P, one, ids.index(i), R)
        else:
            x, P = augment(x, P, one, R)
            ids = [*ids, i]
    return x, P, ids
    ### END SOLUTION


# %%
check("06-slam")

# %%
ask(
    "ex06-largest",
    "In the next cell your filter runs on a loop of 25 m and continues a little beyond the start. "
    "The robot measures the landmarks on both sides up to a range of 2.5 m. **Which landmarks have "
    "the largest ellipses at the end?**",
    {
        "those measured last, after the largest drift": "this was right before the loop closure. "
        "The loop closure corrects these landmarks strongly, because the robot measured the first "
        "landmarks shortly afterwards.",
        "those half way round": "along the loop, these landmarks are the farthest from the start in both directions.",
        "those measured first, which have been out of range the longest": "these landmarks were added from a known pose, and the covariance of a landmark does not grow while it is out of range.",
        "none: the loop closure makes all ellipses equal": "all ellipses become smaller. But the "
        "remaining variance depends on the distance from the start along the loop.",
    },
    right="those half way round",
)


# %% answers="ex06-largest"
@attempt
def _():
    rng = np.random.default_rng(8)
    drive, C, R = np.array([0.3, 0.075]), np.diag([0.02, 0.012]) ** 2, np.diag([0.08, 0.03]) ** 2
    around, out = np.arange(16) * np.pi / 8, 4 + np.tile([0.9, -1.2, 1.6, -0.7], 4)
    marks = np.column_stack([out * np.cos(around), 4 + out * np.sin(around)])
    way, x, P, ids, track = [np.zeros(3)], np.zeros(3), np.zeros((3, 3)), [], []
    for _ in range(95):
        way.append(f_odometry(way[-1], drive))
        z = h(way[-1], marks)
        seen = np.flatnonzero(z[:, 0] < 2.5)
        z = z[seen] + rng.multivariate_normal([0, 0], R, len(seen))
        u = rng.multivariate_normal(drive, C)
        x, P, ids = slam_step(x, P, ids, u, seen.tolist(), z, C, R)
        track.append(x[:3])
    parts = [slice(k, k + 2) for k in range(3, len(x), 2)]
    fig, ax = views.axes("Your filter", size=(9, 6))
    views.draw(ax, Points("truth", marks), marker="+", mew=1, markersize=7, label="true landmarks")
    views.draw(ax, Poses("truth", way))
    views.draw(ax, Poses("corrected", track))
    views.draw(ax, Ellipses("landmark", [x[s] for s in parts], [P[s, s] for s in parts]))
    views.legend(ax, loc="upper left", bbox_to_anchor=(1, 1))
    views.show(fig, alt="True and estimated trajectory on a loop, landmarks with their ellipses.")


# %% [markdown] answers="ex06-largest"
# Look at the left side of the figure. In the last third of the lap the estimated trajectory (blue)
# is 10 to 20 cm away from the true trajectory (black). The estimate jumps back where the first
# landmarks come into range again. The ellipses are small at both ends of the lap. They are largest
# at the top, far from the start. About one true landmark in twenty may lie outside its 95 %
# ellipse.

# %% [markdown]
# ## 4 · NIS and NEES of your filter
#
# Is your filter consistent? Two quantities are tested, each normalised by the covariance that the
# filter itself reports. The **NIS** of a measurement is $v^{\mathsf T} S^{-1} v$, with the innovation
# $v$ and its covariance $S$ just before the update. The **NEES** of a pose is $e^{\mathsf T}
# P_{\mathrm{rr}}^{-1} e$, with its error $e$. In a consistent filter each is $\chi^2$ distributed, with
# as many degrees of freedom as $v$ or $e$ has numbers, and the sum of independent ones is $\chi^2$
# distributed with the sum of their degrees of freedom.

# %%
ask(
    "ex06-truth",
    "A robot has driven through an unknown building, and only its log is there. **What can you test?**",
    {
        "the NIS only": "an innovation compares a measurement with a prediction, and the robot has both. The error of a pose compares it with the true pose.",
        "the NEES only": "the error of the pose is its difference from the true pose, which no sensor of the robot measures.",
        "both": "the NEES needs the true pose, which is known in a simulation, or from an external measurement.",
        "neither": "the log contains all measurements, and the filter predicts each of them.",
    },
    right="the NIS only",
)

# %% [markdown]
# An experiment consists of $N$ runs with the same ids in each scan, and other noise. Each run begins
# with an empty map, with its own estimate `x[r]`, and with `P`. In step `k` of run `r`, the control
# input is `u[r][k]`, and then `z[r][k][m]` is the measurement of landmark `seen[k][m]`. `end` is the
# true last pose, which is the same in all runs, or `None` if it is unknown.
#
# **Your task.** Run your filter on all runs. Use your functions from tasks 1 and 2, one measurement
# after the other. Return `nis`: the mean NIS of all measurements of landmarks that were in the map
# already, and the lower and the upper bound of the interval that contains this mean with a
# probability of 95 % if the filter is consistent (2.5 % on each side). Return `nees`, the same for
# the NEES of the last poses of all runs. If `end` is `None`, `nees` must be `None`, not nan. `C` and `R` may be wrong, so
# the means need not be in their intervals. Some landmark is always measured again.
#
# | judged | allowed error | points |
# | --- | --- | --- |
# | the mean NIS | 0.001 % | 1.5 |
# | the mean NEES | 0.001 % | 1 |
# | both intervals | 0.001 % | 1 |
# | `nees` is `None` if, and only if, the true pose is unknown; another row must be right, too | | 0.5 |


# %%
def chi2_quantile(p, degrees):
    """The number below which χ² with these degrees of freedom lies with the probability p."""
    return 2 * gammaincinv(degrees / 2, p)


# %%
def consistency(x, P, u, seen, z, C, R, end=None):
    """NIS and NEES of EKF-SLAM on N runs, each as mean, lower and upper bound.

    x : (N, 3);  P : (3, 3);  u : (N, T, 2);  seen : list of T lists of ids
    z : list of N lists of T arrays (m, 2);  C, R : (2, 2);  end : (3,) true last pose, or None
    returns nis (3,) and nees (3,), or nis and None
    """
    ### BEGIN SOLUTION
    nis, nees = [], []
    for start, inputs, scans in zip(x, u, z, strict=True):
        state, cov, ids = start, P, []
        for one, names, scan in zip(inputs, seen, scans, strict=True):
            state, cov = predict(state, cov, one, C)
            for i, measured in zip(names, scan, strict=True):
                if i not in ids:
                    state, cov = augment(state, cov, measured, R)
                    ids = [*ids, i]
                    continue
                j = ids.index(i)
                v = measured - h(state[:3], state[3 + 2 * j : 5 + 2 * j])
                v[1] = wrap(v[1])
                H = H_full(state, j)
                nis.append(v @ np.linalg.solve(H @ cov @ H.T + R, v))
                state, cov = update(state, cov, measured, j, R)
        if end is not None:
            e = state[:3] - end
            e[2] = wrap(e[2])
            nees.append(e @ np.linalg.solve(cov[:3, :3], e))

    def test(values, size):
        n = len(values)
        return np.array([np.sum(values), *chi2_quantile([0.025, 0.975], size * n)]) / n

    return test(nis, 2), None if end is None else test(nees, 3)
    ### END SOLUTION


# %%
check("06-consistent")

# %% [markdown]
# ## 5 · Make it better: one measurement in ten is an outlier
#
# Now one measurement in ten is an outlier: its range is wrong by at least 0.5 m, or its bearing by
# at least 0.4 rad. Outliers are not marked. After a few steps the robot stops and makes two full
# turns on the spot. It measures no landmark during 64 steps of these turns, so the variance of its
# heading becomes large. In the next step it drives on and measures two landmarks. This scan contains
# no outliers, and the *first* measurement of each landmark is no outlier either. The turns of the
# odometry are less accurate than before: a filter that rejects all measurements diverges, too.
#
# One outlier corrupts the pose and, through the correlations, the whole map. How can the filter
# detect an outlier *before* the update? How large can the innovation of a correct measurement be
# just after other measurements, and how large after many steps without measurements?
#
# **Your task.** Write another step of SLAM, with the arguments of `slam_step`, that is robust
# against outliers. The check runs it on twenty runs of 81 steps and compares it with a reference
# filter, which knows the outliers and omits them; $e$ is the rms error of its last position. The map
# must contain each measured landmark exactly once. "Without outliers" means twenty runs of 8 steps as
# in task 3, and twenty such runs with a five times larger σ of the measurements (`R` says so).
#
# | judged | row 1 | row 2 | row 3 | row 4 |
# | --- | --- | --- | --- | --- |
# | rms distance of your last position from that of the reference filter, without the two worst runs | at most $0.4\,e$ | at most $0.27\,e$ | at most $0.27\,e$ | at most $0.27\,e$ |
# | mean NEES of your last pose; a consistent filter has 3 | | | 0.5 to 15 | 0.5 to 7 |
# | variances by your $P$, in units of those by the $P$ of the reference filter: median of the runs of the mean over all directions | | | | at least 0.975 |
# | without outliers: variances by your mean $P$, in units of those of least squares, in every direction | | | 0.4 to 2.5 | 0.92 to 1.42 |
# | without outliers: the same, on average over all directions | | | | 0.92 to 1.08 |
# | without outliers: rms difference of $x$ from least squares | | | at most 1 σ | at most 0.77 σ |
# | points | 0.5 | 1 | 1 | 1.5 |
#
# A row requires all conditions of its column and all rows before it. The points of all rows that you
# reach are added. Leaving the arguments unchanged is worth another 0.5 points. `slam_step` reaches no
# row. A filter that rejects one correct measurement in a hundred reaches all rows. One that rejects
# one in twenty or more can reach them in `check` and lose points in the grading, which draws other
# inputs. The check stops after 10 s.


# %%
def careful_step(x, P, ids, u, seen, z, C, R):
    """One step of EKF-SLAM with outliers; returns x, P, ids. The arguments are those of
    slam_step."""
    ### BEGIN SOLUTION
    x, P = predict(x, P, u, C)
    for i, one in zip(seen, z, strict=True):
        if i not in ids:
            x, P = augment(x, P, one, R)
            ids = [*ids, i]
            continue
        j = ids.index(i)
        v = one - h(x[:3], x[3 + 2 * j : 5 + 2 * j])
        v[1] = wrap(v[1])
        H = H_full(x, j)
        # validation gate, χ² with two degrees of freedom: rejects one correct measurement in a thousand
        if v @ np.linalg.solve(H @ P @ H.T + R, v) < 13.8:
            x, P = update(x, P, one, j, R)
    return x, P, ids
    ### END SOLUTION


# %%
check("06-outliers")

# %% [markdown]
# If the log of Victoria Park is on this computer, the last cell runs your `slam_step` on its first 1000 lines: a car
# with a laser scanner measures the trunks of trees. It is not judged. Where does your estimate jump, and which trees
# does the car measure there?


# %% name="victoria-park"
@attempt
def _():
    from slamlab import sources
    from slamlab.sources import gtsam_text

    try:
        log = gtsam_text.load(sources.recording("victoria-park"))[:1000]
    except sources.SourceError as missing:
        print(missing)
        return
    x, P, ids, still = np.zeros(3), np.zeros((3, 3)), [], (np.zeros(2), np.zeros((2, 2)))
    odometry = track = x[None]
    for line in log:
        (u, C), seen, z, R = still, [], np.empty((0, 2)), np.eye(2)
        if line.of_landmark:
            r = np.hypot(*line.z)
            seen, z = [line.j], np.array([[r, np.arctan2(*line.z[::-1])]])
            R = line.covariance / [1, r**2]  # the same σ along and across the beam
        else:
            u, C = line.z[[0, 2]], line.covariance[np.ix_([0, 2], [0, 2])]
            odometry = np.vstack([odometry, f_odometry(odometry[-1], u)])
        x, P, ids = slam_step(x, P, ids, u, seen, z, C, R)
        track = np.vstack([track, x[:3]])
    parts = [slice(k, k + 2) for k in range(3, len(x), 2)]
    fig, ax = views.axes("Victoria Park, by your filter", size=(9, 5))
    views.draw(ax, Ellipses("landmark", [x[s] for s in parts], [P[s, s] for s in parts]))
    views.draw(ax, Poses("naive", odometry))
    views.draw(ax, Poses("corrected", track))
    views.legend(ax, loc="upper left", bbox_to_anchor=(1, 1))
    views.show(fig, alt="A car's trajectory by odometry and by your filter, trees with ellipses.")


# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then shows the grader's verdict. The grader draws other inputs.
# **Next:** [lesson 07](../notebooks/07_correlations.ipynb) removes the correlations, to show why a
# filter needs them.
