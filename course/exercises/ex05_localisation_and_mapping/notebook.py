# %% [markdown]
# # Exercise 05 · Localisation and mapping, apart
#
# **You will be able to** localise a robot in a known map with an EKF that you have written yourself,
# and alternate localisation and mapping. You also write the update for a new sensor, and you
# localise a robot with an unknown initial heading from measurements of which 30 % are outliers.
#
# **60 minutes. Before:** lesson [05 · Localisation and mapping, apart](../notebooks/05_localisation_and_mapping.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it. You can repeat this as often as you like. A check tries random inputs and special cases that
# the text allows. If your answer breaks a law, the check shows a small input that breaks it.
# `hint("05-locate")` in a cell of your own asks a guiding question.
#
# All lengths are in metres, all angles in radians. A pose is `[x, y, θ]`, a control input `u = [d,
# Δθ]`, and a measurement `z = [r, β]` is a range and a bearing. The check compares angles modulo
# $2\pi$. A belief is a mean and a covariance, and functions return both: `return x, P`. All given
# covariances are positive definite, but they need not be diagonal. A function must not change its
# arguments.

# %%
import numpy as np
from scipy.special import gammaincinv

from classroom.checks import ask, attempt, check
from slamlab import layers, views
from slamlab.geometry import wrap
from slamlab.models import A_odometry, H_landmark, H_robot, J_xr, J_z, W_odometry, f_odometry, g, h

# %% [markdown]
# ## What you are given
#
# These are the models of lesson 04 and their Jacobians:
#
# | model | its Jacobians |
# | --- | --- |
# | `f_odometry(x, u)`: move ahead by $d$, then turn by $\Delta\theta$ | `A_odometry(x, u)`, `W_odometry(x, u)` |
# | `h(x, p)`: range and bearing of landmark $p$ | `H_robot(x, p)`, `H_landmark(x, p)` |
# | `g(x, z)`: position of the landmark measured by $z$ | `J_xr(x, z)`, `J_z(x, z)` |
#
# `wrap(angle)` returns an angle in $(-\pi, \pi]$. `h` takes one pose or a stack of them, `(k, 3)`.
#
# The prediction is also given. It is equation (05.4) with $o = (d, 0, \Delta\theta)$. The errors of
# $d$ and $\Delta\theta$ have the covariance $C$, a $2 \times 2$ matrix, so $Q = W C W^{\mathsf T}$:
#
# $$\hat x \leftarrow f(\hat x, u), \qquad P \leftarrow A P A^{\mathsf T} + W C W^{\mathsf T}.$$


# %%
def predict(x, P, u, C):
    """The belief of the pose after a control input u of covariance C; returns x, P."""
    A, W = A_odometry(x, u), W_odometry(x, u)
    return f_odometry(x, u), A @ P @ A.T + W @ C @ W.T


# %% [markdown]
# ## 1 · Update of the pose: one known landmark
#
# The robot measures a landmark by $z$. The position $p$ of the landmark is known exactly. With the
# innovation $v = z - h(\hat x, p)$ and the Jacobian $H$ of $h$ with respect to the pose, the update
# is (05.5).
#
# **Your task.** Return the belief after the update. The landmark may be near or far, but not at the
# position of the robot. Use every measurement, even if it contradicts the prior. The range is a
# length and is not wrapped. The check compares your result with the least squares estimate from
# prior and measurement, with $h$ linearised at the prior.


# %%
def locate(x, P, z, p, R):
    """The belief of the pose after the measurement of a known landmark.

    x : (3,) pose;  P : (3, 3) its covariance;  z : (2,) range, bearing;  p : (2,) the landmark
    R : (2, 2) covariance of z;  returns x (3,), P (3, 3)
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
# Which parts of the pose does the measurement of one landmark determine?

# %%
ask(
    "ex05-one",
    "The position of the robot has σ = 0.5 m in x and y, and the heading has σ = 0.2 rad. Now it measures one "
    "known landmark, 3 m to the east, with a precise sensor. **Which of these σ remain large?**",
    {
        "none of them: a range and a bearing determine the position": "this would be true if the heading were known. Two measured numbers cannot determine three unknown numbers.",
        "σ of x, along the line of sight": "the range measures x, with σ = 5 cm.",
        "σ of y, across the line of sight, and σ of the heading": "if the robot moves round the landmark and turns by the same angle, the measurement stays the same. So the robot measures only a combination of y and θ.",
        "σ of the heading alone": "the robot does not measure y and θ separately. Every "
        "position on the circle round the landmark, with a suitable heading, gives the same "
        "measurement.",
    },
    right="σ of y, across the line of sight, and σ of the heading",
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
# After the update, σ of $x$ is small, because the range measures $x$. σ of $y$, across the line of
# sight, stays much larger. If the robot moves round the landmark and turns so that the bearing
# stays the same, the measurement does not change. This is the unobservable direction (05.7).

# %% [markdown]
# ## 2 · EKF localisation: a whole run
#
# Each step of a run consists of a control input and then at most one measurement. After control
# input `us[k]` (counted from 0), the robot measured landmark `ids[k]` by `zs[k]`. If `ids[k]`
# is −1, the robot measured no landmark, and `zs[k]` has no meaning. `landmarks[id]` is the position
# of a landmark.
#
# **Your task.** Return the belief after every step, with `predict` and your `locate`. Every run has
# at least one step and one landmark. A run may contain no measurement at all. The robot may stand
# still or drive backwards. The check judges `xs` and `Ps` separately, and it also tests runs
# without measurements.


# %%
def localise(x, P, us, ids, zs, landmarks, C, R):
    """The belief of the pose after every step of a run.

    x : (3,), P : (3, 3) at the start;  us : (n, 2);  ids : (n,) int, -1: no measurement
    zs : (n, 2);  landmarks : (N, 2), row id is the position of landmark id
    C : (2, 2) covariance of each row of us;  R : (2, 2) covariance of each row of zs
    returns xs (n, 3), Ps (n, 3, 3)
    """
    ### BEGIN SOLUTION
    xs, Ps = [], []
    for u, id, z in zip(us, ids, zs, strict=True):
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
# The next cell simulates a lap: the true trajectory, and the data of the filter. The cell after it localises the
# robot twice, without measurements and with them.


# %% name="lap"
def lap(seed, steps=60):
    """A lap in a room with five landmarks. The robot measures the nearest one if it is within 2.5
    m.

    returns true poses (n, 3) after each drive, us (n, 2), ids (n,), zs (n, 2), landmarks, C, R
    """
    rng = np.random.default_rng(seed)
    C, R = np.diag([0.03, 0.03]) ** 2, np.diag([0.1, 0.03]) ** 2
    landmarks = np.array([[3, -1], [6, 3], [2, 7], [-1.5, 5.5], [-3.5, 1.5]])
    x, data = np.zeros(3), []
    for _ in range(steps):
        u = np.array([0.4, 2 * np.pi / steps])
        x = f_odometry(x, u)
        seen = h(x, landmarks)
        id = int(seen[:, 0].argmin()) if seen[:, 0].min() < 2.5 else -1
        z = seen[id] + rng.multivariate_normal([0, 0], R)
        data.append((x, rng.multivariate_normal(u, C), id, z if id >= 0 else np.zeros(2)))
    return *(np.array(part) for part in zip(*data, strict=True)), landmarks, C, R


# %%
@attempt
def _():
    true, us, ids, zs, landmarks, C, R = lap(seed=5)
    blind = np.full(len(ids), -1)
    maps = {}
    for title, seen in {"no measurements": blind, "in a known map": ids}.items():
        start = np.zeros(3), np.diag([0.05, 0.05, 0.02]) ** 2
        xs, Ps = localise(*start, us, seen, zs, landmarks, C, R)
        maps[title] = [
            layers.Poses("truth", true),
            layers.Poses("predicted" if seen is blind else "corrected", xs),
            layers.Ellipses("robot", xs[::4, :2], Ps[::4, :2, :2]),
            layers.Points("landmark", landmarks),
        ]
    fig, both = views.side_by_side(maps, size=(9, 4.5))
    for ax in both:
        ax.lines[-1].set(markersize=8)
    views.show(
        fig,
        alt="On the left the ellipses grow along the lap, on the right they are small near landmarks.",
    )


# %% [markdown]
# On the left the ellipses grow and stay large, because there is no measurement. On the right they
# grow where no landmark is in range, and shrink where the robot measures a landmark.
#
# ## 3 · Localisation and mapping in turn
#
# Now the map is unknown as well. Each landmark has its own belief: a position $p$ and a $2 \times 2$
# covariance. The update of a landmark that was measured from an *exactly known* pose is given below.
# It is written in information form, which adds the inverses of covariances as in (05.6).


# %%
def update_landmark(p, P, x, z, R):
    """The belief of a landmark after it was measured by z from the known pose x; returns p, P."""
    off = z - h(x, p)
    off[1] = wrap(off[1])
    H, weight = H_landmark(x, p), np.linalg.inv(R)
    P = np.linalg.inv(np.linalg.inv(P) + H.T @ weight @ H)
    return p + P @ H.T @ weight @ off, P


# %% [markdown]
# **Your task.** Write the careful student's scheme of the lesson. The belief of the pose is updated
# by `locate`, as if the landmark were known, and the belief of the landmark by `update_landmark`, as
# if the pose were known. But neither is known exactly. The *other* error is therefore a part of the
# measurement noise, in addition to $R$: derive its covariance (range and bearing) from the belief of
# the other. Both updates of a step begin with the beliefs *before* the measurement. The first
# measurement of a landmark only initialises its belief: $\hat p = g(\hat x, z)$, with the errors of
# the pose and of the measurement. Errors of pose, landmark and measurement are treated as
# uncorrelated.
#
# An id is a non-negative integer, or −1 if the robot measured no landmark in this step. Return the
# beliefs of the pose after every step, as `localise` does, and the map at the end: a dict from each
# measured id to its pair `(p, P)`.
#
# | what is judged | allowed error | points |
# | --- | --- | --- |
# | `p` and `P` of landmarks in runs that measure each landmark once | 0.001 % of the largest entry | 1.5 |
# | `xs` (heading modulo $2\pi$) | likewise | 1 |
# | `Ps` | likewise | 1 |
# | `p` and `P` of landmarks in all runs | likewise | 1.5 |


# %%
def alternate(x, P, us, ids, zs, C, R):
    """The beliefs of pose and landmarks in a run in an unknown map.

    x : (3,), P : (3, 3) at the start;  us : (n, 2);  ids : (n,) int, -1: no measurement
    zs : (n, 2);  C : (2, 2) covariance of each row of us;  R : (2, 2) of each row of zs
    returns xs (n, 3), Ps (n, 3, 3), and a dict: id -> (p (2,), P (2, 2))
    """
    ### BEGIN SOLUTION
    beliefs, xs, Ps = {}, [], []
    for u, id, z in zip(us, ids, zs, strict=True):
        x, P = predict(x, P, u, C)
        if id in beliefs:
            p, L = beliefs[id]
            Hr, Hp = H_robot(x, p), H_landmark(x, p)
            beliefs[id] = update_landmark(p, L, x, z, R + Hr @ P @ Hr.T)
            x, P = locate(x, P, z, p, R + Hp @ L @ Hp.T)
        elif id >= 0:
            Jr, Jz = J_xr(x, z), J_z(x, z)
            beliefs[id] = g(x, z), Jr @ P @ Jr.T + Jz @ R @ Jz.T
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps), beliefs
    ### END SOLUTION


# %%
check("05-alternate")

# %% [markdown]
# The figure shows the mean NEES of the pose in 20 laps, with the true map and with your own map. It
# should lie in its 95 % χ² interval. At which step does it leave the interval, and what happens at
# this step?


# %%
@attempt
def _():
    P, NEES = np.diag([0.05, 0.05, 0.02]) ** 2, {"in the true map": [], "in your own map": []}
    for seed in range(20):
        true, us, ids, zs, landmarks, C, R = lap(seed)
        x = np.random.default_rng([seed, 1]).multivariate_normal(np.zeros(3), P)
        found = (
            localise(x, P, us, ids, zs, landmarks, C, R),
            alternate(x, P, us, ids, zs, C, R),
        )
        for values, (xs, Ps, *_) in zip(NEES.values(), found, strict=True):
            off = np.array(xs) - true
            off[:, 2] = wrap(off[:, 2])
            values.append(np.einsum("ki,kij,kj->k", off, np.linalg.inv(Ps), off))
    means = {name: np.mean(values, axis=0) for name, values in NEES.items()}
    steps, band = np.arange(1, 61), 2 * gammaincinv(3 * 20 / 2, [0.025, 0.975]) / 20  # of χ²
    fig, _ = views.against_band(steps, means, band, "step", "mean NEES [1]", "20 laps")
    views.show(
        fig,
        alt=f"The mean NEES with the true map is {means['in the true map'].mean():.1f} on average; "
        f"with the own map it rises to {means['in your own map'].max():.0f}.",
    )


# %% [markdown]
# The mean NEES leaves the interval as soon as landmarks are measured again. The error of a landmark
# contains the error of the pose from which it was initialised, so both errors are correlated. The
# scheme treats each measurement as independent of the pose, so $P$ becomes much too small. Lesson 06
# keeps the cross-covariances.
#
# ## 4 · Localisation from ranges only
#
# A radio on the robot measures the ranges of beacons on the walls. The radio measures no bearings.
# Its antenna is not at the origin of the robot frame, but at `a = [forward, left]` in the robot
# frame. The position of the antenna in the world therefore depends on the heading. Beacon $i$ has
# the exactly known position $b_i$, `beacons[i]`. Its measured range is
#
# $$r_i = |\text{antenna} - b_i| + \varepsilon_i.$$
#
# All $\varepsilon_i$ have the standard deviation `sigma` and are independent of each other. The update (05.5)
# holds for this sensor as well, with another $h$ and its Jacobian $H$. $H$ has one row for each beacon:
# `(m, 3)`.

# %%
ask(
    "ex05-axle",
    "The antenna is at the origin of the robot frame, `a = 0`, so a range does not depend on the "
    "heading. **Can the update with one range change the estimate of the heading?**",
    {
        "no: the range does not depend on the heading": "the derivative of the range with respect "
        "to θ is zero. But the range corrects the position, and the errors of position and heading "
        "may be correlated.",
        "yes, if the errors of position and heading are correlated": "a robot that drove here with "
        "a wrong heading now also has a position error to one side. An innovation that shows the "
        "position error therefore corrects the heading as well.",
        "yes, always: the heading is part of the state": "if P is diagonal, the gain of the heading is zero.",
    },
    right="yes, if the errors of position and heading are correlated",
)

# %% [markdown]
# **Your task.** Return the belief after one update with all $m$ ranges. All ranges are measured at
# the same time, so compute all rows of $H$ at the given pose. If `m` is 0, the belief does not change. `m` may be
# larger than 3, and a beacon may occur twice. A beacon may be at the position of the robot, or a few centimetres from
# the antenna, but never at the antenna itself. Use every range, even if it contradicts the others or the prior. The
# check compares your result with the least squares estimate from prior and ranges. It allows errors of $10^{-6}$ of the
# correction of the pose and of $10^{-8}$ of the largest entry of $P$. It also uses the coordinates of surveyors, up to
# $10^7$ m, where differences of $h$ have larger errors: derive $H$.


# %%
def locate_by_ranges(x, P, rs, beacons, a, sigma):
    """The belief of the pose after ranges from the antenna to known beacons.

    x : (3,) pose;  P : (3, 3);  rs : (m,) ranges [m];  beacons : (m, 2)
    a : (2,) the antenna in the robot frame, forward and left [m];  sigma : float [m], of each range
    returns x (3,), P (3, 3)
    """
    ### BEGIN SOLUTION
    c, s = np.cos(x[2]), np.sin(x[2])
    arm = np.array([[c, -s], [s, c]]) @ a
    d = x[:2] + arm - beacons
    r = np.linalg.norm(d, axis=1)
    swing = np.array([-arm[1], arm[0]])  # derivative of the antenna's position by θ
    H = np.column_stack([d, d @ swing]) / r[:, None]
    S = H @ P @ H.T + sigma**2 * np.eye(len(rs))
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ (rs - r), P - K @ S @ K.T
    ### END SOLUTION


# %%
check("05-ranges")

# %% [markdown]
# The figure shows a robot in a hall of 12 m that measures the ranges of one, two and three beacons.
# Compare the shapes of the three ellipses.


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
        shown[f"{m} range{'s'[: m - 1]}: heading ±{sigma:.0f}°"] = [
            layers.Points("landmark", beacons[:m]),
            layers.Ellipses("robot", [x[:2], at[:2]], [P[:2, :2], left[:2, :2]]),
        ]
    fig, _ = views.side_by_side(shown, size=(9, 3.4))
    views.show(fig, alt="Three maps: the ellipse of the position after one, two and three ranges.")


# %% [markdown]
# After one range the ellipse is a narrow strip across the line to the beacon. A second beacon in
# nearly the opposite direction shortens the strip a little. With a third beacon, below the robot,
# the ellipse is small. σ of the heading hardly decreases. The ranges depend on the heading only
# because the antenna is a third of a metre from the origin of the robot frame.
#
# ## 5 · Make it better: global localisation with outliers
#
# A robot starts near a known position; `x` and `P` are its initial belief. Its initial heading is
# unknown: `x[2]` contains no information, and σ of the heading in `P` is 1.8 rad. In addition, 30 %
# of the measurements are outliers. An outlier has the id of a landmark, but its range is uniformly
# distributed between 1 and 6 m, and its bearing may be any angle. It does not depend on the pose.
# Each of the first four measurements is an outlier with a probability of one half.

# %%
ask(
    "ex05-led",
    "`localise` starts with an unknown heading, and 30 % of the measurements are outliers. "
    "**Where does its estimate end after forty steps?**",
    {
        "near the truth: most measurements are correct": "an EKF linearises at its own estimate, which has a wrong heading here, and it uses each outlier as a measurement.",
        "far from the truth, with large ellipses": "P does not depend on the innovations. It shrinks with every measurement, correct or not.",
        "far from the truth, with small ellipses": "in eight such runs (seeds 0 to 7 below) the "
        "final error was 0.7 m to 2.5 m, and σ was always below 10 cm.",
    },
    right="far from the truth, with small ellipses",
)

# %% [markdown]
# How can a filter detect an outlier while its own heading is uncertain? Suppose that you assume a
# heading. How can you detect after ten steps that this heading is wrong?
#
# **Your task.** Return the belief after every step. The function has the same arguments as
# `localise`. For each belief it may use the measurements of the whole run. The check runs your
# function on 60 robots with 40 steps and six landmarks each. 30 of them have better sensors: σ of
# their measurements is 6 times smaller, and σ of their odometry 1.5 times. Any method is allowed:
# the check judges only your results.
#
# - A robot is *localised* if the rms error of its position in the last ten steps is below 0.4 m.
# - The `P` of the localised robots is *consistent* if it fits their errors in the last 25 steps. The
#   check computes the mean NEES of each robot in these steps, and then the median over the robots.
#   For the pose, this median must be 2.3 to 3.7 (a consistent filter has 2.9). For each kind of
#   sensors, it must be 1.9 to 4.5 for the pose, 1.3 to 2.8 for the position alone, and 0.5 to 1.6 for
#   the heading alone. Every `P` of all 40 steps must be positive definite. In the last 25 steps, no
#   `P` may be diagonal, and `P` must not be the same in all steps of a run.
#
# Nothing else is judged: of the first 15 beliefs, only whether `P` is positive definite.
#
# | row | required | points |
# | --- | --- | --- |
# | 1 | at least 18 of the 60 robots are localised, and at least 2 of 6 other robots without outliers | 0.5 |
# | 2 | at least 36 of the 60 robots are localised | 1 |
# | 3 | at least 53 of the 60 robots are localised | 1.5 |
# | 4 | at least 53 of the 60 robots are localised, and `P` is consistent | 2 |
#
# The six other robots also start with an unknown heading. Their runs have 25 steps and four
# landmarks, and again the last ten steps are judged. The points of all rows that you reach are
# added, and leaving the arguments unchanged is worth another 0.5 points. `localise` itself reaches
# none of the rows. The check stops after 10 s.


# %%
def find_yourself(x, P, us, ids, zs, landmarks, C, R):
    """The beliefs after every step, with an unknown initial heading and outliers; arguments as of
    localise."""
    ### BEGIN SOLUTION
    headings = np.linspace(-np.pi, np.pi, 72, endpoint=False)
    poses = np.column_stack([np.tile(x[:2], (72, 1)), headings])
    # cost of each heading: innovations of the first measurements, with poses from odometry alone
    costs = []
    for u, id, z in list(zip(us, ids, zs, strict=True))[:20]:
        poses = f_odometry(poses.T, u).T
        if id >= 0:
            v = z - h(poses, landmarks[id])
            costs.append(np.minimum((v[:, 0] / 0.4) ** 2 + (wrap(v[:, 1]) / 0.15) ** 2, 9))
    x = np.array([x[0], x[1], headings[np.argmin(np.sum(costs, axis=0))]])
    P = P * [[1, 1, 0], [1, 1, 0], [0, 0, 0]] + np.diag([0, 0, 0.12**2])
    xs, Ps = [], []
    for u, id, z in zip(us, ids, zs, strict=True):
        x, P = predict(x, P, u, C)
        if id >= 0:
            v = z - h(x, landmarks[id])
            v[1] = wrap(v[1])
            H = H_robot(x, landmarks[id])
            # validation gate, χ² with two degrees of freedom: rejects one correct measurement in a hundred
            if v @ np.linalg.solve(H @ P @ H.T + R, v) < 9.2:
                x, P = locate(x, P, z, landmarks[id], R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
    ### END SOLUTION


# %%
check("05-lost")

# %% [markdown]
# The next cell simulates such a run and draws the true trajectory: 30 % of its measurements are
# outliers, but about half of the first four, as in the check. The picture on the left shows your
# `localise`.


# %% name="lost"
def lost(seed, steps=40):
    """A run with an unknown heading and outliers; true poses, then the arguments of localise."""
    rng = np.random.default_rng(seed)
    C, R = np.diag([0.03, 0.02]) ** 2, np.diag([0.08, 0.03]) ** 2
    landmarks = np.array([[3, -1.5], [5, 3], [2, 6], [-2.5, 5.5], [-4, 1.5], [-2, -2]])
    x, data, seen = np.zeros(3), [], 0
    for _ in range(steps):
        u = np.array([0.4, 2 * np.pi / steps])
        x, id = f_odometry(x, u), int(rng.integers(-1, 6))
        true = h(x, landmarks[id]) + rng.multivariate_normal([0, 0], R)
        false = np.array([rng.uniform(1, 6), rng.uniform(-np.pi, np.pi)])
        seen += id >= 0
        lie = rng.random() < (0.5 if seen <= 4 else 0.3) or id < 0  # -1: z has no meaning
        z = false if lie else true
        data.append((x, rng.multivariate_normal(u, C), id, z))
    way, us, ids, zs = (np.array(part) for part in zip(*data, strict=True))
    start = np.array([*rng.normal(0, 0.2, 2), rng.uniform(-np.pi, np.pi)])
    return way, start, np.diag([0.2, 0.2, 1.8]) ** 2, us, ids, zs, landmarks, C, R


# %% name="found" answers="ex05-led"
@attempt
def _():
    way, *data = lost(seed=3)
    shown = {}
    for title, method in {"localise": localise, "yours": find_yourself}.items():
        xs, Ps = map(np.array, method(*data))
        off = np.hypot(*(xs - way)[-10:, :2].T)
        shown[f"{title}: {np.sqrt(np.mean(off**2)):.2f} m error at the end"] = [
            layers.Poses("truth", way),
            layers.Poses("corrected", xs),
            layers.Ellipses("robot", xs[::6, :2], Ps[::6, :2, :2]),
            layers.Points("landmark", data[5]),
        ]
    fig, _ = views.side_by_side(shown, size=(9, 4.5))
    views.show(fig, alt="The true trajectory and the estimates of localise and of a better method.")


# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then shows the grader's verdict. The grader draws other inputs.
# **Next:** [lesson 06](../notebooks/06_ekf_slam.ipynb), where neither the pose nor the map is
# known.
