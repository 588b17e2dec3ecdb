# %% [markdown]
# # Exercise 05 · Two easy halves
#
# **You will be able to** find a robot in a map that is known, and draw a map from poses that are
# known: all that an EKF needs, written by you.
#
# **40 minutes. Before:** lesson [05 · Two easy halves](../notebooks/05_two_easy_halves.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it, as often as you like. A check tries random inputs, says which law is broken, and what the
# mistake is where it knows it.
#
# Metres and radians. A pose is `[x, y, θ]`, a drive `u = [d, Δθ]`, a sighting `z = [r, β]`. A
# belief is a mean and a covariance; functions return both: `return x, P`.

# %%
import numpy as np

from slamlab import layers, views
from slamlab.checks import attempt, check
from slamlab.geometry import wrap
from slamlab.models import A_odometry, H_landmark, H_robot, J_z, W_odometry
from slamlab.models import f_odometry, g, h

# %% [markdown]
# What lesson 04 derived is there, ready to use:
#
# | model | its Jacobians |
# | --- | --- |
# | `f_odometry(x, u)`: drive d, then turn by Δθ | `A_odometry(x, u)`, `W_odometry(x, u)` |
# | `h(x, p)`: range and bearing of landmark p | `H_robot(x, p)`, `H_landmark(x, p)` |
# | `g(x, z)`: the landmark seen at z | `J_z(x, z)` |
#
# and `wrap(angle)`, which brings an angle into (−π, π].
#
# ## 1 · Predict: drive, and doubt more
#
# The robot drives u, and its wheels err: d and Δθ have the covariance C (2, 2).
#
# $$x \leftarrow f(x, u), \qquad P \leftarrow A P A^{\mathsf T} + W C W^{\mathsf T}$$
#
# f is lesson 04's `f_odometry`: along the old heading, then turn. It is *not* the arc of lesson 05's
# lap, so A and W are not that arc's, either: take those of the table.
#
# **Predict first.** A and W are computed at a pose: the one before the drive, or the one after?


# %%
def predict(x, P, u, C):
    """The belief of the pose after a drive.

    x : (3,) pose;  P : (3, 3) its covariance;  u : (2,) d [m], Δθ [rad];  C : (2, 2) covariance of u
    returns x (3,), P (3, 3)
    """
    ### BEGIN SOLUTION
    A, W = A_odometry(x, u), W_odometry(x, u)
    return f_odometry(x, u), A @ P @ A.T + W @ C @ W.T
    ### END SOLUTION


# %%
check("05-predict")

# %% [markdown]
# A robot drives ten steps with its eyes shut. **Before you run it:** which way will the ellipses
# be long, along the way or across it? And at the end?


# %%
@attempt
def _():
    x, P, C = np.zeros(3), np.zeros((3, 3)), np.diag([0.05, 0.08]) ** 2
    xs, Ps = [], []
    for _ in range(10):
        x, P = predict(x, P, np.array([0.5, 0.15]), C)
        xs.append(x)
        Ps.append(P[:2, :2])
    fig, ax = views.axes("ten drives, nothing seen", size=(6, 4))
    views.draw(ax, layers.Poses("corrected", xs), label="the way, as believed")
    views.draw(ax, layers.Ellipses("robot", np.array(xs)[:, :2], Ps))
    ax.legend()
    views.show(fig, alt="The way of ten drives with ellipses that grow, most of all across it.")


# %% [markdown]
# ## 2 · Locate: one landmark that is known
#
# The landmark at p was seen at z, and its place is known exactly. The innovation v is what was
# measured minus what was to be expected, and H says how that changes with the pose. Then, as in
# lesson 03,
#
# $$S = H P H^{\mathsf T} + R, \quad K = P H^{\mathsf T} S^{-1}, \quad x \leftarrow x + K v, \quad P
# \leftarrow P - K S K^{\mathsf T}$$
#
# **Predict first.** The landmark is right behind the robot. It is expected at 179° and seen at
# −179°. What is v?


# %%
def locate(x, P, z, p, R):
    """The belief of the pose after a known landmark was seen.

    x : (3,) pose;  P : (3, 3);  z : (2,) range, bearing;  p : (2,) the landmark;  R : (2, 2) of z
    returns x (3,), P (3, 3)
    """
    ### BEGIN SOLUTION
    v = z - h(x, p)
    v[1] = wrap(v[1])
    H = H_robot(x, p)
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
    ### END SOLUTION


# %%
check("05-locate")

# %% [markdown]
# The check knows no formula for K: it solves the least squares problem that K solves, and compares.
#
# What one landmark tells, and what it does not. **Before you run it:** the landmark is 3 m to the
# east. In which direction will the robot still be unsure?


# %%
@attempt
def _():
    x, P, R = np.zeros(3), np.diag([0.5, 0.5, 0.2]) ** 2, np.diag([0.05, 0.02]) ** 2
    p = np.array([3.0, 0.0])
    _, P_after = locate(x, P, h(x, p), p, R)
    for name, covariance in (("before", P), ("after", P_after)):
        sigmas = np.sqrt(np.diag(covariance))
        print(f"{name:7} σ of x {sigmas[0]:.2f} m, y {sigmas[1]:.2f} m, θ {sigmas[2]:.2f} rad")


# %% [markdown]
# The distance to the landmark is known now, x. Across the line of sight, y, much less: moving round
# the landmark while turning towards it changes nothing that the robot sees.
#
# ## 3 · Localise: a whole run
#
# Drive, look, drive, look. After drive k (from 0) the robot saw landmark `ids[k]` at `zs[k]`, or
# nothing: then `ids[k]` is −1 and `zs[k]` means nothing. `landmarks[id]` is where it stands.
#
# **Your task.** The belief after every step, with your `predict` and `locate`. The check lets forty
# robots drive the same way, each with errors of its own, and looks whether these are as large as
# your P says.


# %%
def localise(x, P, drives, ids, zs, landmarks, C, R):
    """The belief of the pose after every drive of a run and what was seen after it.

    x : (3,), P : (3, 3) at the start;  drives : (n, 2);  ids : (n,) int, -1: nothing seen
    zs : (n, 2);  landmarks : (N, 2), row id;  C : (2, 2) of a drive;  R : (2, 2) of a sighting
    returns xs (n, 3), Ps (n, 3, 3)
    """
    ### BEGIN SOLUTION
    xs, Ps = [], []
    for u, id, z in zip(drives, ids, zs, strict=True):
        x, P = predict(x, P, u, C)
        if id >= 0:
            x, P = locate(x, P, z, landmarks[id], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
    ### END SOLUTION


# %%
check("05-localise")

# %% [markdown]
# A lap to try it on: the truth, and what the robot is told of it.


# %% name="lap"
def lap(seed, steps=60):
    """A lap in a room with five landmarks; the nearest is seen when it is within 2.5 m.

    returns true poses (n, 3) after each drive, drives (n, 2), ids (n,), zs (n, 2), landmarks, C, R
    """
    rng = np.random.default_rng(seed)
    C, R = np.diag([0.03, 0.03]) ** 2, np.diag([0.1, 0.03]) ** 2
    landmarks = np.array([[3, -1], [6, 3], [2, 7], [-1.5, 5.5], [-3.5, 1.5]])
    x, told = np.zeros(3), []
    for _ in range(steps):
        u = np.array([0.4, 2 * np.pi / steps])
        x = f_odometry(x, u)
        seen = h(x, landmarks)
        id = int(seen[:, 0].argmin()) if seen[:, 0].min() < 2.5 else -1
        z = seen[id] + rng.multivariate_normal([0, 0], R)
        told.append((x, rng.multivariate_normal(u, C), id, z if id >= 0 else np.zeros(2)))
    return *(np.array(part) for part in zip(*told, strict=True)), landmarks, C, R


# %% [markdown]
# **Before you run it:** where on the lap will the ellipses be largest?


# %%
@attempt
def _():
    true, drives, ids, zs, landmarks, C, R = lap(seed=5)
    blind = np.full(len(ids), -1)
    maps = {}
    for title, seen in {"eyes shut": blind, "in a known map": ids}.items():
        start = np.zeros(3), np.diag([0.05, 0.05, 0.02]) ** 2
        xs, Ps = localise(*start, drives, seen, zs, landmarks, C, R)
        maps[title] = [
            layers.Poses("truth", true),
            layers.Poses("predicted" if seen is blind else "corrected", xs),
            layers.Ellipses("robot", xs[::4, :2], Ps[::4, :2, :2]),
            layers.Points("landmark", landmarks),
        ]
    fig, both = views.side_by_side(maps, size=(9, 4.5))
    for ax in both:
        ax.lines[-1].set(markersize=8)
    views.show(fig, alt="Left ellipses that grow round the lap, right small ones near landmarks.")


# %% [markdown]
# On the left they grow, and nothing makes them small again. On the right they grow where no
# landmark is near, and shrink where one is seen.
#
# ## 4 · Now the map: one landmark from a known pose
#
# The other half. The pose x is known exactly; the landmark's place p is a belief with the
# covariance P (2, 2). It is seen at z.
#
# **Predict first.** What in `locate` must change, and what stays? Does P of the *robot* come in?


# %%
def update_landmark(p, P, x, z, R):
    """The belief of a landmark after it was seen from a known pose.

    p : (2,) landmark;  P : (2, 2) its covariance;  x : (3,) pose;  z : (2,) range, bearing
    R : (2, 2) of z;  returns p (2,), P (2, 2)
    """
    ### BEGIN SOLUTION
    v = z - h(x, p)
    v[1] = wrap(v[1])
    H = H_landmark(x, p)
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return p + K @ v, P - K @ S @ K.T
    ### END SOLUTION


# %%
check("05-landmark")

# %% [markdown]
# ## 5 · The whole map
#
# A robot that knows its poses, `xs[k]`, sees landmark `ids[k]` at `zs[k]`. An id is any number. A
# new landmark is placed where it is seen, with what the sighting's noise means there:
#
# $$p = g(x, z), \qquad P = J_z R J_z^{\mathsf T}$$
#
# One that is in the map already is corrected by your `update_landmark`.
#
# **Predict first.** Does a sighting of landmark 7 change anything for landmark 12?
#
# **Your task.** A dict: id to the pair `(p, P)`.


# %%
def build_map(xs, ids, zs, R):
    """The beliefs of all landmarks seen in a run with known poses.

    xs : (n, 3) poses;  ids : (n,) int;  zs : (n, 2);  R : (2, 2) of a sighting
    returns dict: id -> (p (2,), P (2, 2))
    """
    ### BEGIN SOLUTION
    beliefs = {}
    for x, id, z in zip(xs, ids, zs, strict=True):
        if id in beliefs:
            beliefs[id] = update_landmark(*beliefs[id], x, z, R)
        else:
            J = J_z(x, z)
            beliefs[id] = g(x, z), J @ R @ J.T
    return beliefs
    ### END SOLUTION


# %%
check("05-map")

# %% [markdown]
# The map of the lap, from the true poses, and from those that the wheels alone tell. **Before you
# run it:** will the ellipses on the right be larger?


# %%
@attempt
def _():
    true, drives, ids, zs, landmarks, _, R = lap(seed=5)
    wheels = [np.zeros(3)]
    for u in drives:
        wheels.append(f_odometry(wheels[-1], u))
    seen, maps = ids >= 0, {}
    for title, poses in {"true poses": true, "the wheels' poses": np.array(wheels[1:])}.items():
        p, P = zip(*build_map(poses[seen], ids[seen], zs[seen], R).values(), strict=True)
        maps[title] = [
            layers.Poses("corrected", poses),
            layers.Ellipses("landmark", p, P),
            layers.Points("truth", landmarks),
        ]
    fig, both = views.side_by_side(maps, size=(9, 4.5))
    for ax in both:
        ax.lines[-1].set(marker="x", markersize=5, markeredgewidth=1)
    views.show(fig, alt="Left ellipses round the true landmarks; right as small, and beside them.")


# %% [markdown]
# They are as small, and they miss. A filter believes what it is told, and here it was told that the
# poses are exact.
#
# ## Done?
#
# Save the notebook. The cell below then says what the grader will say about it;
# the grader draws other inputs. **Next:** [lesson 06](../notebooks/06_ekf_slam.ipynb), where neither
# the pose nor the map is known.
