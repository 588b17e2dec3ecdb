# %% [markdown]
# # Exercise 06 · EKF-SLAM
#
# **You will be able to** write EKF-SLAM yourself: augment, update, and the loop that calls them. You will tell
# the filter something that no sensor has measured, and keep it from believing lies.
#
# **60 minutes. Before:** lesson [06 · EKF-SLAM](../notebooks/06_ekf_slam.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below it, as
# often as you like. A check tries random inputs and others that are as special as the text allows: an empty
# map, or a map of many landmarks. Where a law is broken it shows a small input that breaks it, and
# `hint("06-augment")` in a cell of your own leads on.
#
# All lengths are in metres, all angles in radians. The state is `x = [x, y, θ, p_0x, p_0y, p_1x, p_1y, …]`, and
# its covariance `P` has as many rows. Landmarks are counted from 0. A drive is `u = [d, Δθ]`, a sight
# `z = [r, β]`. You have the models and, from exercise 04, their Jacobians. No function may change the arrays it is
# given, because whoever called it still needs them.

# %%
import numpy as np

from slamlab import views
from slamlab.checks import ask, attempt, check
from slamlab.geometry import wrap
from slamlab.models import A_odometry, H_landmark, H_robot, J_xr, J_z, W_odometry
from slamlab.layers import Ellipses, Points, Poses
from slamlab.models import f_odometry, g, h

# %% [markdown]
# ## What you are given
#
# A drive $u$ of covariance $C$ moves the robot and no landmark, as (06.3) says. The sight of landmark $j$
# depends on the pose and on this landmark, so only five columns of $H$ are not zero (06.7):
#
# $$P_{\mathrm{rr}} \leftarrow A P_{\mathrm{rr}} A^{\mathsf T} + W C W^{\mathsf T}, \qquad P_{\mathrm ri} \leftarrow A P_{\mathrm ri}, \qquad
# H = \begin{bmatrix} H_{\mathrm r} & 0 & \cdots & H_{\mathrm p} & \cdots & 0 \end{bmatrix}.$$
#
# Both are written already.


# %%
def predict(x, P, u, C):
    """The robot drives u; returns x (n,), P (n, n)."""
    A, W = A_odometry(x[:3], u), W_odometry(x[:3], u)
    x, P = x.copy(), P.copy()
    x[:3] = f_odometry(x[:3], u)
    P[:3, :3] = A @ P[:3, :3] @ A.T + W @ C @ W.T
    P[:3, 3:] = A @ P[:3, 3:]
    P[3:, :3] = P[:3, 3:].T
    return x, P


def H_full(x, j):
    """∂h/∂x of landmark j over the whole state: (2, n)."""
    its = slice(2 * j + 3, 2 * j + 5)
    H = np.zeros((2, len(x)))
    H[:, :3], H[:, its] = H_robot(x[:3], x[its]), H_landmark(x[:3], x[its])
    return H


# %% [markdown]
# ## 1 · Augment: a new landmark
#
# A landmark is seen for the first time, at `z`, which errs with covariance `R` (2, 2). It is placed at
# `g(x[:3], z)` and appended.
#
# **Your task.** Return the state with two more numbers, and the covariance with two more rows and columns. The
# map may still be empty. The pose may be known exactly, so that its block of $P$ is zero.


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
# The next cell drives a robot that starts exactly known and lets it see three landmarks, one after each metre.
# A white block would mean that two of them have nothing to do with each other.


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
# No block should be white: one robot placed all three, and its error is in each of them.

# %% [markdown]
# ## 2 · Update: a landmark seen again
#
# Landmark `j` was seen at `z`. With $v = z - h$ and $S = H P H^{\mathsf T} + R$, (06.9) holds:
#
# $$K = P H^{\mathsf T} S^{-1}, \qquad x \leftarrow x + K v, \qquad P \leftarrow P - K S K^{\mathsf T}.$$
#
# **Your task.** Return the state and the covariance after the sight. `H_full` above is $H$. The map holds one
# landmark or more, and $P$ is positive definite. Bearings, and what you get when you subtract two of them,
# count modulo $2\pi$.


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

# %%
ask(
    "ex06-who",
    "A robot that started exactly known has placed landmarks 0, 1 and 2, driving a metre after each. "
    "Now it sees landmark 0 again, 20 cm nearer than it expects. **Which of the three landmarks does "
    "the update move most?**",
    {
        "landmark 0, which was seen": "it was placed from a pose that was known, so it is the surest of all. The filter rather believes "
        "that the robot is elsewhere.",
        "none but landmark 0: the others were not seen": "they were placed from poses whose error the robot still carries along.",
        "landmark 1, half way": "it moves, but the robot had gathered more error when it placed the next one.",
        "landmark 2, the last one placed": "the robot was least sure of itself when it placed it, and shares most of its error with it.",
    },
    right="landmark 2, the last one placed",
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
# The robot takes nearly all of the 20 cm for its own error, since it is far less sure of itself than of landmark
# 0, and it takes along whatever it placed with that error.

# %% [markdown]
# ## 3 · The whole filter
#
# In one step of SLAM the robot drives `u`, then sees some landmarks: `seen[k]` is the id of the one seen at
# `z[k]`. `ids` holds the ids of the landmarks in the state, in its order, so `ids[j]` is the id of landmark
# `j`.
#
# **Your task.** Return the state, the covariance and the ids after the step, computed with your functions. The
# check drives your filter through twenty runs. It asks whether robot and map err as much as $P$ says, and whether
# $P$ is as sure as least squares over the whole run is: nothing lost, and nothing counted twice.
# The check stops after 10 s.


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

# %%
ask(
    "ex06-largest",
    "The next cell drives your filter round a loop of 25 m, with landmarks on either side that are "
    "seen from 2.5 m away, and a little beyond the start. **Whose ellipses are largest at the end?**",
    {
        "those of the landmarks seen last, where most error has gathered": "that was right until "
        "the loop closed. Now they are tied to the first ones, which are known well.",
        "those half way round": "seen from the start, they are the farthest away in either direction.",
        "those seen first, which have been out of sight the longest": "they were placed from a pose that was known, and no ellipse grows while it is out of sight.",
        "none: when the loop closes, all become equally sure": "all become surer. But each stays "
        "as unsure as the path from the start to it makes it.",
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
    views.show(fig, alt="True and estimated track round a loop, landmarks with their ellipses.")


# %% [markdown] answers="ex06-largest"
# Look closely at the left. In the last third of the round the blue track is 10 to 20 cm away
# from the black one, and it jumps back where the first landmarks come into view again. The ellipses are small
# at both ends of the round, and largest far from the start, at the top. About one true landmark in twenty may
# lie outside its ellipse.

# %% [markdown]
# ## 4 · Two landmarks turn out to be one
#
# A map was begun at both ends of a corridor. Then somebody tells the robot that what it calls landmark $i$ and
# landmark $j$ is one and the same post. Nobody has measured anything, and yet the filter has learned something,
# and for certain:
#
# $$p_i - p_j = 0.$$
#
# This is an observation like any other: some $h$ of the state was "seen" to be 0, and it does not err at all.
# The lesson has not coded it, but its derivation covers it.

# %%
ask(
    "ex06-post",
    "The two estimates of the post were 10 cm apart. Nobody has seen anything at this moment. **Does "
    "the estimate of the *robot* move?**",
    {
        "no: no sensor has said anything about it": "nobody has measured anything, and yet something is now known: how wrong the difference of the "
        "two estimates was.",
        "yes, by half of the 10 cm": "how far depends on P: on how much of its error the robot shares with either of the two.",
        "yes, if its error is related to that of their difference": "what shares an error with the difference is corrected with it. What shares none stays.",
    },
    right="yes, if its error is related to that of their difference",
)

# %% [markdown]
# **Your task.** Return the state and the covariance when both are known to be one. Landmark `j` leaves the
# state, and those behind it move up; landmark `i` keeps its order among the rest. `i` may stand before or
# behind `j`. $P$ is positive definite.


# %%
def merge(x, P, i, j):
    """Landmarks i and j are one; returns x (n - 2,), P (n - 2, n - 2), without landmark j.

    x : (n,) state;  P : (n, n);  i, j : int, from 0, i ≠ j
    """
    ### BEGIN SOLUTION
    D = np.zeros((2, len(x)))
    D[:, 3 + 2 * i : 5 + 2 * i] = np.eye(2)
    D[:, 3 + 2 * j : 5 + 2 * j] = -np.eye(2)
    S = D @ P @ D.T
    K = P @ D.T @ np.linalg.inv(S)
    x, P = x - K @ D @ x, P - K @ S @ K.T
    gone = [3 + 2 * j, 4 + 2 * j]
    return np.delete(x, gone), np.delete(np.delete(P, gone, axis=0), gone, axis=1)
    ### END SOLUTION


# %%
check("06-same")

# %% [markdown]
# ## 5 · Make it better: one sight in ten is false
#
# The sensor now lies. One sight in ten shows another range, or another bearing, half a metre or 0.4 rad
# away from the right one or farther, and nobody says which. Half-way the robot turns on the spot, twice
# round, and sees nothing meanwhile, so that it hardly knows where it heads when it looks again. Then it sees all
# landmarks at once. These sights are never false, and neither is a landmark's *first* one. The wheels are worse
# than before, so a robot that ignores its eyes is lost as well.
#
# One false sight moves the robot, and with it every landmark that shares its error. How could you notice that a
# sight cannot be true *before* it has done its harm? What does the filter know about how far off a true sight
# may be, when it has just seen others and when it has seen nothing for long?
#
# **Your task.** Write another step of SLAM, called as `slam_step` is, as good as you can make it. The check
# drives it through twenty runs of 81 steps and looks at the pose at the end: how far it is from where a filter
# has it that is *told* which sights are false, in units of what that one errs (the two worst runs are left
# out), and whether yours knows how far off it is (NEES, 3 on average). Points come in four steps; `slam_step`
# itself reaches the lowest at most. The check stops after 10 s.


# %%
def careful_step(x, P, ids, u, seen, z, C, R):
    """One step of EKF-SLAM among false sights; returns x, P, ids. Arguments as those of slam_step."""
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
        # χ² with two degrees of freedom: a true sight is farther off once in a thousand times
        if v @ np.linalg.solve(H @ P @ H.T + R, v) < 13.8:
            x, P = update(x, P, one, j, R)
    return x, P, ids
    ### END SOLUTION


# %%
check("06-false-sights")

# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then says what the grader will say about it; the grader draws other inputs.
# **Next:** [lesson 07](../notebooks/07_correlations.ipynb) asks what the blocks off the diagonal are worth, by
# throwing them away.
