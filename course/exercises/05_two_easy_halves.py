# %% [markdown]
# # Exercise 05 · Two easy halves
#
# **You will be able to** find a robot in a map that is known, and draw a map from poses that are
# known, with an EKF that you have written yourself. Then you meet a sensor that the lesson has not
# met, and a robot that is lost and lied to.
#
# **60 minutes. Before:** lesson [05 · Two easy halves](../notebooks/05_two_easy_halves.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it, as often as you like. A check tries random inputs and others that are as special as the text
# allows. Where a law is broken it shows a small input that breaks it, and `hint("05-locate")` in a
# cell of your own leads on.
#
# All lengths are in metres, all angles in radians. A pose is `[x, y, θ]`, a drive `u = [d, Δθ]`, a
# sight `z = [r, β]`. Angles count modulo $2\pi$. A belief is a mean and a covariance, and functions
# return both: `return x, P`. All covariances that you are given are positive definite, and they need
# not be diagonal. No function may change the arrays it is given, because whoever called it still needs
# them.

# %%
import numpy as np

from slamlab import layers, views
from slamlab.checks import ask, attempt, check
from slamlab.geometry import wrap
from slamlab.models import A_odometry, H_landmark, H_robot, J_z, W_odometry
from slamlab.models import f_odometry, g, h

# %% [markdown]
# ## What you are given
#
# What lesson 04 derived is there, ready to use:
#
# | model | its Jacobians |
# | --- | --- |
# | `f_odometry(x, u)`: drive $d$, then turn by $\Delta\theta$ | `A_odometry(x, u)`, `W_odometry(x, u)` |
# | `h(x, p)`: range and bearing of landmark $p$ | `H_robot(x, p)`, `H_landmark(x, p)` |
# | `g(x, z)`: the landmark seen at $z$ | `J_z(x, z)` |
#
# There is also `wrap(angle)`, which brings an angle into $(-\pi, \pi]$. `h` takes one pose or a stack of
# them, `(k, 3)`.
#
# The drive, too, is written already. The wheels err: $d$ and $\Delta\theta$ have the covariance $C$, a
# $2 \times 2$ matrix. Hence
#
# $$\hat x \leftarrow f(\hat x, u), \qquad P \leftarrow A P A^{\mathsf T} + W C W^{\mathsf T}.$$


# %%
def predict(x, P, u, C):
    """The belief of the pose after a drive u that errs with covariance C; returns x, P."""
    A, W = A_odometry(x, u), W_odometry(x, u)
    return f_odometry(x, u), A @ P @ A.T + W @ C @ W.T


# %% [markdown]
# ## 1 · Locate: one landmark that is known
#
# The landmark at $p$ was seen at $z$, and its place is known exactly. The innovation $v$ is what was
# measured minus what was to be expected, and $H$ says how the expected sight changes with the pose. Then
# (05.5) holds:
#
# $$S = H P H^{\mathsf T} + R, \quad K = P H^{\mathsf T} S^{-1}, \quad \hat x \leftarrow \hat x + K v, \quad P
# \leftarrow P - K S K^{\mathsf T}.$$
#
# **Your task.** Return the belief after the sight. The landmark may be anywhere but under the robot,
# near or far, and the sight may contradict the belief. The range is a length, and is not wrapped.


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
# The check knows no formula for $K$. It solves the least squares problem that $K$ solves, and compares.
#
# The next cell shows what one landmark tells, and what it does not.

# %%
ask(
    "ex05-one",
    "The robot is unsure of its place by 0.5 m in every direction, and of its heading by 0.2 rad. Now "
    "it sees one known landmark, 3 m to the east, with a good sensor. **Of what is it still unsure?**",
    {
        "of nothing: a range and a bearing fix a place": "they would, if it knew its heading. Two numbers cannot fix three.",
        "of x, along the line of sight": "along it the range is measured, to 5 cm.",
        "of y, across the line of sight, and of its heading": "if it moves round the landmark and turns along, it sees the same. Only both together are known better.",
        "of its heading alone": "place and heading go together: each other place round the "
        "landmark has a heading with which the robot would see the same.",
    },
    right="of y, across the line of sight, and of its heading",
)


# %% answers="ex05-one"
@attempt
def _():
    x, P, R = np.zeros(3), np.diag([0.5, 0.5, 0.2]) ** 2, np.diag([0.05, 0.02]) ** 2
    p = np.array([3.0, 0.0])
    _, P_after = locate(x, P, h(x, p), p, R)
    for name, covariance in (("before", P), ("after", P_after)):
        sigmas = np.sqrt(np.diag(covariance))
        print(f"{name:7} σ of x {sigmas[0]:.2f} m, y {sigmas[1]:.2f} m, θ {sigmas[2]:.2f} rad")


# %% [markdown] answers="ex05-one"
# The robot now knows $x$, its distance to the landmark. It knows $y$, across the line of sight, much less
# well: if it moves round the landmark and turns so as to keep it at the same bearing, nothing that it
# sees changes.

# %% [markdown]
# ## 2 · Localise: a whole run
#
# A run repeats two steps: drive, look, drive, look. After drive $k$ (counted from 0) the robot saw landmark
# `ids[k]` at `zs[k]`, or it saw nothing: then `ids[k]` is −1 and `zs[k]` means nothing. `landmarks[id]` is
# where a landmark stands.
#
# **Your task.** Return the belief after every step, computed with `predict` and your `locate`. There is at
# least one step and one landmark; perhaps nothing is ever seen. The robot may stand or drive backwards.


# %%
def localise(x, P, drives, ids, zs, landmarks, C, R):
    """The belief of the pose after every drive of a run and what was seen after it.

    x : (3,), P : (3, 3) at the start;  drives : (n, 2);  ids : (n,) int, -1: nothing seen
    zs : (n, 2);  landmarks : (N, 2), row id;  C : (2, 2) of a drive;  R : (2, 2) of a sight
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
# Here is a lap to try it on: the truth, and what the robot is told of it. The cell after it draws the
# lap twice, once with the robot's eyes shut.


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
# On the left the ellipses grow and stay large, since nothing is seen. On the right they grow where no
# landmark is near, and shrink where one is seen.
#
# ## 3 · The whole map
#
# Now the other half: the poses are known exactly, and each landmark's place is a belief with a covariance
# of its own, a $2 \times 2$ matrix. What a sight does to one landmark is ready below, in the form that adds
# up *information*, the inverse of a covariance, as in (05.6). The covariance of the robot does not come in,
# because it is zero.


# %%
def update_landmark(p, P, x, z, R):
    """The belief of a landmark after it was seen at z from the known pose x; returns p, P."""
    off = z - h(x, p)
    off[1] = wrap(off[1])
    H, weight = H_landmark(x, p), np.linalg.inv(R)
    P = np.linalg.inv(np.linalg.inv(P) + H.T @ weight @ H)
    return p + P @ H.T @ weight @ off, P


# %% [markdown]
# From the pose `xs[k]`, landmark `ids[k]` was seen at `zs[k]`. An id is any whole number from 0 on. A new
# landmark is placed where it is seen, with what the sensor's noise means there, as in (05.8):
#
# $$\hat p = g(x, z), \qquad P = J_z R J_z^{\mathsf T}.$$
#
# One that is in the map already is corrected by `update_landmark`.
#
# **Your task.** Return a dict from each id to its pair `(p, P)`, of the landmarks seen and no others. Perhaps
# nothing was seen (`n = 0`). The check's sensor is a surveyor's, good to a tenth of a millimetre.


# %%
def build_map(xs, ids, zs, R):
    """The beliefs of all landmarks seen in a run with known poses.

    xs : (n, 3) poses;  ids : (n,) int;  zs : (n, 2);  R : (2, 2) of a sight
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
# The next cell draws the map of the lap twice, from the true poses and from those that the wheels alone tell.
# Compare the ellipses on both sides.


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
            layers.Poses("truth" if poses is true else "naive", poses),
            layers.Ellipses("landmark", p, P),
            layers.Points("true landmark", landmarks),
        ]
    fig, both = views.side_by_side(maps, size=(9, 4.5))
    for ax in both:
        ax.lines[-1].set(marker="x", markersize=7, markeredgewidth=1.5)
        ax.lines[-1].set(color=views.COLOURS["truth"], label="true landmark")
    views.legend_below(fig)
    views.show(
        fig,
        alt="Left the ellipses are hidden by the crosses of the true landmarks; right they are as small, and beside them.",
    )


# %% [markdown]
# On the right they are as small, and they miss the landmarks. A filter believes what it is told, and here it was told
# that the poses are exact.
#
# ## 4 · Beacons that tell only how far they are
#
# A radio in the robot asks beacons on the walls how far away they are. It hears no bearing, and its antenna
# does not stand where the pose is. It is fixed to the robot at `a = [forward, left]` of the pose, so that it
# swings round when the robot turns. Beacon $i$ stands at $b_i$, which is `beacons[i]` and known exactly, and
# was measured at
#
# $$r_i = |\text{antenna} - b_i| + \varepsilon_i.$$
#
# All $\varepsilon_i$ have the standard deviation `sigma` and are independent of each other. The
# lesson's sensor was another one, but its derivation covers this one, too. What changes is $h$, and
# with it $H$, which has one row for each beacon: `(m, 3)`.

# %%
ask(
    "ex05-axle",
    "The antenna stands right where the pose is, `a = 0`, so a range is the same whatever the "
    "heading. **Can one range change the estimate of the heading all the same?**",
    {
        "no: the range says nothing about the heading": "by itself it says nothing. But it corrects the place, and the errors of place and heading may "
        "be related.",
        "yes, if the errors of place and heading are related": "a robot that drove here with a "
        "wrong heading is now off to one side because of it. So what corrects the place also "
        "tells how wrong the heading is.",
        "yes, always: the heading is part of the state": "if P is diagonal, nothing passes from place to heading.",
    },
    right="yes, if the errors of place and heading are related",
)

# %% [markdown]
# **Your task.** Return the belief after the $m$ ranges, which are heard all at once: take $H$ for all of them
# at the pose you are given. `m` may be 0, and then nothing was learned; it may be larger than 3, and a beacon
# may be heard twice. The robot may stand right over a beacon; the antenna may come within centimetres of
# one, but never to the very point. Ranges may contradict each other and the belief.


# %%
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    """The belief of the pose after ranges from the antenna to known beacons.

    x : (3,) pose;  P : (3, 3);  rs : (m,) ranges [m];  beacons : (m, 2)
    a : (2,) the antenna in the robot's frame, forward and left [m];  sigma : float [m], of each range
    returns x (3,), P (3, 3)
    """
    ### BEGIN SOLUTION
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([[c, -s], [s, c]]) @ a
    d = x[:2] + arm - beacons
    r = np.linalg.norm(d, axis=1)
    swing = np.array([-arm[1], arm[0]])  # of the antenna, for each radian that the robot turns
    H = np.column_stack([d, d @ swing]) / r[:, None]
    S = H @ P @ H.T + sigma**2 * np.eye(len(rs))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
    ### END SOLUTION


# %%
check("05-ranges")

# %% [markdown]
# A robot in a hall of 12 m hears one beacon, then two, then three. Look at the
# shape of the ellipse after each.


# %% name="beacons"
@attempt
def _():
    beacons = np.array([[6.0, 1.0], [-5.0, 2.0], [1.0, -4.0]])
    x, P, a = np.zeros(3), np.diag([0.6, 0.6, 0.3]) ** 2, np.array([0.3, 0.1])
    rs = np.linalg.norm(x[:2] + a - beacons, axis=1)
    shown = {}
    for m in (1, 2, 3):
        at, left = locate_by_ranges(x, P, rs[:m], beacons[:m], a, 0.05)
        sigma = np.degrees(np.sqrt(left[2, 2]))
        shown[f"{m} heard: heading ±{sigma:.0f}°"] = [
            layers.Points("landmark", beacons[:m]),
            layers.Ellipses("robot", [x[:2], at[:2]], [P[:2, :2], left[:2, :2]]),
        ]
    fig, _ = views.side_by_side(shown, size=(9, 3.4))
    views.show(fig, alt="Three maps: a robot's doubt after one, two and three ranges.")


# %% [markdown]
# One range cuts the large ellipse to a strip across the line to the beacon. A second beacon, which is not quite
# opposite, shortens the strip, and a third from below leaves a spot. The heading gains only through the
# arm, which is a third of a metre long, and therefore gains hardly anything.
#
# ## 5 · Make it better: lost, and lied to
#
# Somebody switches the robot on near a known place, with a covariance `P` as always, but turned *any way at
# all*: `x[2]` tells nothing, and the standard deviation of $\theta$ in `P` is 1.8 rad. What is worse, three
# sights in ten are false: they are range and bearing of something else, anywhere around the robot, under the
# landmark's id. Of the first four sights, every second one is false.

# %%
ask(
    "ex05-led",
    "`localise` begins with a heading that may be anything, and three sights in ten are false. "
    "**Where does it end, after forty steps?**",
    {
        "near the truth: the true sights win in the end": "an EKF goes downhill from where it starts, and false sights push it about as hard as true ones.",
        "far off, and its ellipses are large": "P does not depend on how well a sight fits. It shrinks with every sight, true or false.",
        "far off, and its ellipses are small": "on eight such runs, those of the seeds 0 to 7 "
        "below, it ended 0.7 m to 2.5 m off, and each time it claimed a σ of less than 10 cm.",
    },
    right="far off, and its ellipses are small",
)

# %% [markdown]
# How could a filter notice that a sight cannot be true, while its own heading is in doubt? Suppose you
# were given a heading: how would you tell after ten steps that it was wrong?
#
# **Your task.** Return beliefs after every step, as good as you can make them. The function is called as
# `localise` is, and it may use the whole run, from its start to its end. The check drives thirty robots
# through forty steps and looks at the last ten: how far off they are, and whether $P$ knows how far (NEES,
# 3 on average). Other runs have at least 25 steps. Points come in four steps; `localise` reaches the
# lowest at most. The check stops after 10 s.


# %%
def find_yourself(x, P, drives, ids, zs, landmarks, C, R):
    """Beliefs after every step, from any heading, among false sights; arguments as localise's."""
    ### BEGIN SOLUTION
    headings = np.linspace(-np.pi, np.pi, 72, endpoint=False)
    poses = np.column_stack([np.tile(x[:2], (72, 1)), headings])
    # with which heading do most of the first sights agree? By wheels alone: roughly will do
    costs = []
    for u, id, z in list(zip(drives, ids, zs, strict=True))[:20]:
        poses = f_odometry(poses.T, u).T
        if id >= 0:
            v = z - h(poses, landmarks[id])
            costs.append(np.minimum((v[:, 0] / 0.4) ** 2 + (wrap(v[:, 1]) / 0.15) ** 2, 9))
    x = np.array([x[0], x[1], headings[np.argmin(np.sum(costs, axis=0))]])
    P = P * [[1, 1, 0], [1, 1, 0], [0, 0, 0]] + np.diag([0, 0, 0.12**2])
    xs, Ps = [], []
    for u, id, z in zip(drives, ids, zs, strict=True):
        x, P = predict(x, P, u, C)
        if id >= 0:
            v = z - h(x, landmarks[id])
            v[1] = wrap(v[1])
            H = H_robot(x, landmarks[id])
            # χ² of two: one true sight in a hundred is farther off
            if v @ np.linalg.solve(H @ P @ H.T + R, v) < 9.2:
                x, P = locate(x, P, z, landmarks[id], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
    ### END SOLUTION


# %%
check("05-lost")

# %% [markdown]
# To try your method, here is such a run, whose truth is known. The picture on the left is by your
# `localise`.


# %% name="lost"
def lost(seed, steps=40):
    """A run of a robot that is turned any way and lied to; true poses, then localise's arguments."""
    rng = np.random.default_rng(seed)
    C, R = np.diag([0.03, 0.02]) ** 2, np.diag([0.08, 0.03]) ** 2
    landmarks = np.array([[3, -1.5], [5, 3], [2, 6], [-2.5, 5.5], [-4, 1.5], [-2, -2]])
    x, told = np.zeros(3), []
    for _ in range(steps):
        u = np.array([0.4, 2 * np.pi / steps])
        x, id = f_odometry(x, u), int(rng.integers(-1, 6))
        true = h(x, landmarks[id]) + rng.multivariate_normal([0, 0], R)
        false = np.array([rng.uniform(1, 6), rng.uniform(-np.pi, np.pi)])
        told.append((x, rng.multivariate_normal(u, C), id, false if rng.random() < 0.3 else true))
    way, drives, ids, zs = (np.array(part) for part in zip(*told, strict=True))
    start = np.array([*rng.normal(0, 0.2, 2), rng.uniform(-np.pi, np.pi)])
    return way, start, np.diag([0.2, 0.2, 1.8]) ** 2, drives, ids, zs, landmarks, C, R


# %% name="found" answers="ex05-led"
@attempt
def _():
    way, *told = lost(seed=3)
    shown = {}
    for title, method in {"localise": localise, "yours": find_yourself}.items():
        xs, Ps = map(np.array, method(*told))
        off = np.hypot(*(xs - way)[-10:, :2].T)
        shown[f"{title}: {np.sqrt(np.mean(off**2)):.2f} m off at the end"] = [
            layers.Poses("truth", way),
            layers.Poses("corrected", xs),
            layers.Ellipses("robot", xs[::6, :2], Ps[::6, :2, :2]),
            layers.Points("landmark", told[5]),
        ]
    fig, _ = views.side_by_side(shown, size=(9, 4.5))
    views.show(fig, alt="The true way and a robot's beliefs, by localise and by a better method.")


# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then says what the grader will say about it; the grader draws other
# inputs. **Next:** [lesson 06](../notebooks/06_ekf_slam.ipynb), where neither the pose nor the map is
# known.
