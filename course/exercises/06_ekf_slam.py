# %% [markdown]
# # 06 · EKF-SLAM: exercise
#
# **You will be able to** write EKF-SLAM, block by block: predict, augment, update, and the loop that
# calls them; and to say from P who is related to whom.
#
# **60 minutes. Before:** lesson 06.
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it, as often as you like. A check tries random inputs and tells you which law is broken.
#
# The state is `x = [x, y, θ, p_0x, p_0y, p_1x, p_1y, …]`, its covariance `P` has as many rows.
# Landmarks are counted from 0. `u = [d, Δθ]` is a drive, `z = [r, β]` a range and a bearing. Metres
# and radians throughout. You have the models and, from exercise 04, their Jacobians.

# %%
import numpy as np

from slamlab import views
from slamlab.checks import attempt, check
from slamlab.geometry import wrap
from slamlab.models import A_odometry, H_landmark, H_robot, J_xr, J_z, W_odometry
from slamlab.layers import Ellipses, Points, Poses
from slamlab.models import f_odometry, g, h

# %% [markdown]
# ## Predict
#
# The robot drives `u`, which errs with covariance `C` (2, 2). The landmarks stand still.
#
# $$P_{rr} \leftarrow A P_{rr} A^T + W C W^T, \qquad P_{ri} \leftarrow A P_{ri}$$
#
# **Predict first.** There are N landmarks. Which blocks of P change? Which of them hold C's noise?
#
# **Your task.** The state and the covariance after the drive. Return new arrays, and mind that P is
# symmetric. (`A_odometry(x, u)` and `W_odometry(x, u)` take the pose *before* the drive;
# `f_odometry(x, u)` returns the one after.)


# %%
def predict(x, P, u, C):
    """The robot drives u; returns x (n,), P (n, n).

    x : (n,) state;  P : (n, n);  u : (2,) d [m], Δθ [rad];  C : (2, 2) covariance of u
    """
    ### BEGIN SOLUTION
    A, W = A_odometry(x[:3], u), W_odometry(x[:3], u)
    x, P = x.copy(), P.copy()
    x[:3] = f_odometry(x[:3], u)
    P[:3, :3] = A @ P[:3, :3] @ A.T + W @ C @ W.T
    P[:3, 3:] = A @ P[:3, 3:]
    P[3:, :3] = P[:3, 3:].T
    return x, P
    ### END SOLUTION


# %%
check("06-predict")

# %% [markdown]
# ## Augment
#
# A landmark is seen for the first time, at `z`, which errs with covariance `R` (2, 2). It is placed
# at `g(x[:3], z)` and appended.
#
# **Predict first.** The robot knows an old landmark i. Are the errors of i and of the new landmark
# related? Through whom?
#
# **Your task.** The state with two more numbers, the covariance with two more rows and columns.


# %%
def augment(x, P, z, R):
    """A new landmark was seen at z; returns x (n + 2,), P (n + 2, n + 2).

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
# Your two functions at work: a robot that starts exactly known drives and sees three landmarks, one
# after each metre. Before you run it: will any block of the correlation matrix be white?


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
    fig, _ = views.correlation(correlation(P), ["robot", "0", "1", "2"])
    views.show(fig, alt="The correlation matrix of a robot and three landmarks.")


# %% [markdown]
# **See:** no block should be white: one robot placed them all, and its error is in each of them.
#
# ## H over the whole state
#
# Landmark `j` is seen again. `h(x[:3], p)` depends on the pose and on that landmark only.
#
# **Predict first.** The state holds five landmarks and `j = 3`. Which shape has H, and which columns
# are not zero? Compare with (4.9) of the MAK thesis as printed: [0 0 H_r H_p 0 …].
#
# **Your task.** H, with the parts `H_robot(pose, p)` (2, 3) and `H_landmark(pose, p)` (2, 2) in
# their places.


# %%
def H_full(x, j):
    """∂h/∂x of landmark j over the whole state: (2, n).

    x : (n,) state;  j : int, from 0
    """
    ### BEGIN SOLUTION
    at = 3 + 2 * j
    H = np.zeros((2, len(x)))
    H[:, :3] = H_robot(x[:3], x[at : at + 2])
    H[:, at : at + 2] = H_landmark(x[:3], x[at : at + 2])
    return H
    ### END SOLUTION


# %%
check("06-h")

# %% [markdown]
# ## Update
#
# Landmark `j` was seen at `z`. With v = z − h and S = H P Hᵀ + R,
#
# $$K = P H^T S^{-1}, \qquad x \leftarrow x + K v, \qquad P \leftarrow P - K S K^T$$
#
# **Predict first.** Landmark i is not seen. When does it move all the same? And could the update
# make any variance *grow*?
#
# **Your task.** The state and the covariance after the sight, with your `H_full`. Bearings, and what
# you get when you subtract two of them, count modulo 2π.


# %%
def update(x, P, z, j, R):
    """Landmark j was seen at z; returns x (n,), P (n, n).

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

# %% [markdown]
# Who learns? The robot has placed three landmarks and now sees the first one again, 20 cm nearer
# than it expects. Your update in numbers:


# %%
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


# %% [markdown]
# ## The whole filter
#
# One step of SLAM: the robot drove `u`, then saw some landmarks; `seen[k]` is the id of the one seen
# at `z[k]`. `ids` are the ids of the landmarks in the state, in its order: `ids[j]` is landmark `j`.
#
# **Predict first.** In which order do you predict, update and augment, and why is it not free?
#
# **Your task.** The step, with your functions. Return the new `ids` too. The check drives your
# filter through ten runs, and asks whether robot and map err as much as P says, and whether P is as
# sure as least squares over the whole run is: nothing lost, nothing counted twice.


# %%
def slam_step(x, P, ids, u, seen, z, C, R):
    """One step of EKF-SLAM; returns x, P, ids.

    x : (n,), P : (n, n), ids : list of int    the state, and which landmarks are in it
    u : (2,) the drive, of covariance C (2, 2)
    seen : list of m int;  z : (m, 2) what was seen of them, each of covariance R (2, 2)
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

# %% [markdown]
# And round a loop of 25 m, with landmarks on either side that are seen from 2.5 m off. Before you
# run it: where will the ellipses be largest, and what happens to them when the loop closes?


# %%
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
    fig, ax = views.axes("Your filter", size=(6.4, 4.4))
    views.draw(ax, Points("truth", marks), marker="+", mew=1, markersize=7, label="true landmarks")
    views.draw(ax, Poses("truth", way))
    views.draw(ax, Poses("corrected", track))
    views.draw(ax, Ellipses("landmark", [x[s] for s in parts], [P[s, s] for s in parts]))
    views.legend(ax, loc="upper left", bbox_to_anchor=(1, 1))
    views.show(fig, alt="True and estimated track round a loop, landmarks with their ellipses.")


# %% [markdown]
# **See:** look closely, on the left: in the last third of the round the blue track is a hand's
# breadth or two off the black one, and it jumps back where the first landmarks come into view
# again. The ellipses are small at both ends of the round, and largest far from the start, at the
# top. The true landmarks should lie in them, but for one in twenty.
#
# ## Done?
#
# Save the notebook. The cell below then says what the grader will say about it;
# the grader draws other inputs. The next lesson asks what the off-diagonal blocks are worth, by
# throwing them away.
