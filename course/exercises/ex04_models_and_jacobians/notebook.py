# %% [markdown]
# # Exercise 04 · Motion and measurement models, Jacobians and the EKF
#
# **You will be able to** write the Jacobians of EKF-SLAM as functions, derive the Jacobian of a new
# sensor, compute the covariance of a new landmark and its cross-covariance with the pose, and
# predict a pose with an uncertain heading better than linearisation does.
#
# **60 minutes. Before:** lesson [04 · Motion and measurement models, Jacobians and the EKF](../notebooks/04_models_and_jacobians.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it. You can repeat this as often as you like. A check tries random inputs and special cases that
# the text allows. If your answer breaks a law, the check shows a small input that breaks it.
# `hint("04-camera")` in a cell of your own asks a guiding question.
#
# All lengths are in metres, all angles in radians. `x` is a pose `[x, y, θ]`, `p` is the position
# of a landmark, `u = [d, Δθ]` is a control input, and `z = [r, β]` is a range and a bearing. (In
# task 4, `u` is another number.) Bearings are measured counter-clockwise from the heading of the
# robot. Angles may be any number, also beyond $\pi$. A function must not change its arguments.

# %%
import numpy as np

from classroom.checks import ask, attempt, check
from slamlab import layers, views
from slamlab.models import f_odometry, g, h

# %% [markdown]
# ## 1 · The Jacobian H of the measurement model
#
# The measurement model `h(x, p)` (04.8) gives the range and bearing of a landmark at $p$ from a robot
# at the pose $x$:
#
# $$r = \sqrt{(p_x-x)^2+(p_y-y)^2}, \qquad \beta = \operatorname{atan2}(p_y-y,\ p_x-x) - \theta$$

# %%
ask(
    "ex04-left",
    "The robot stands at the origin with the heading 0, and a landmark is 2 m ahead of it. Now the "
    "robot moves 1 cm to its left. **How do range and bearing change, to first order?** (Which "
    "entry of $H_{\\mathrm r}$ describes this?)",
    {
        "the range grows, the bearing stays 0": "the range grows by only 25 µm, which is an effect "
        "of second order. But the landmark is no longer straight ahead.",
        "the range stays, the bearing becomes positive": "bearings are positive to the left. Is "
        "the landmark now to the left or to the right of the heading?",
        "the range stays, the bearing becomes negative": "the landmark is now to the right of the heading, at a bearing of −0.01 m / 2 m = −0.005 rad.",
        "neither changes: the robot moves across the line of sight": "such a motion does not change the range to first order, but it changes the bearing.",
    },
    right="the range stays, the bearing becomes negative",
)

# %% [markdown]
# **Your task.** Return $H_{\mathrm r}$, the 2 × 3 Jacobian of $h$ with respect to $x$, $y$ and
# $\theta$ of the robot. The landmark may lie in any direction, also behind the robot, but never at
# the position of the robot: the check uses distances from 0.1 mm to 30 m. It allows errors of
# $10^{-8}$ of the largest entry of each row.
#
# Derive the formulas. In tasks 1, 2 and 4 the check also uses the coordinates of surveyors, up to
# $10^7$ m, and in task 4 headings after hundreds of thousands of turns. There finite differences
# with any step have larger errors.


# %%
def H_robot(x, p):
    """∂h/∂x: the Jacobian of range and bearing of landmark p with respect to the pose x.

    x : (3,) pose [m, m, rad];  p : (2,) landmark [m];  returns (2, 3)
    """
    ### BEGIN SOLUTION
    dx, dy = p[0] - x[0], p[1] - x[1]
    q = dx**2 + dy**2
    r = np.sqrt(q)
    return np.array([[-dx / r, -dy / r, 0], [dy / q, -dx / q, -1]])
    ### END SOLUTION


# %%
check("04-h-robot")

# %% [markdown]
# The next cell compares your $H_{\mathrm r}$ with the model itself: it changes the pose by a small
# step and computes the change of $h$. The two rows of each pair should be almost equal. They differ
# because $h$ is not linear. If the step is ten times smaller, the difference is about a hundred
# times smaller.


# %%
@attempt
def _():
    x, p = np.array([1.0, 0.5, 0.3]), np.array([3.1, 1.4])
    H = H_robot(x, p)
    for name, step in zip(["x", "y", "θ"], 0.01 * np.eye(3), strict=True):
        print(f"step along {name}:  h changes by", (h(x + step, p) - h(x, p)).round(4))
        print("               H predicts  ", (H @ step).round(4))


# %% [markdown]
# ## 2 · The Jacobians of the inverse measurement model
#
# When the robot measures a landmark for the first time, the inverse measurement model `g(x, z)`
# (04.13) gives its position:
#
# $$p_x = x + r\cos(\theta+\beta), \qquad p_y = y + r\sin(\theta+\beta)$$

# %%
ask(
    "ex04-lever",
    "The estimated heading of the robot has an error of 0.01 rad, and everything else is exact. **How "
    "large is the position error of a new landmark at a range of 8 m?**",
    {
        "1 cm, as at any range": "the error is 1 cm at a range of 1 m. The position error is the angle times the range.",
        "8 cm, along the line of sight": "the range is exact. A heading error rotates the landmark about the robot.",
        "8 cm, across the line of sight": "the error rotates the landmark about the robot, on a circle with the radius 8 m. The bearing has no effect on the size of the error.",
        "it depends on whether the landmark is ahead or to the side": "the direction of the error depends on the bearing, but its size does not.",
    },
    right="8 cm, across the line of sight",
)

# %% [markdown]
# **Your task.** Return the Jacobians of $g$ with respect to the pose, $J_{\mathrm r}$ (2 × 3, `J_xr` in the
# code), and with respect to the measurement, $J_z$ (2 × 2), for any range $r > 0$. The check allows
# errors of $10^{-8}$ of the largest entry of each matrix.


# %%
def J_xr(x, z):
    """∂g/∂x: the Jacobian of a new landmark with respect to the pose x.

    x : (3,) pose [m, m, rad];  z : (2,) range r [m], bearing β [rad];  returns (2, 3)
    """
    ### BEGIN SOLUTION
    r, direction = z[0], x[2] + z[1]
    return np.array([[1, 0, -r * np.sin(direction)], [0, 1, r * np.cos(direction)]])
    ### END SOLUTION


# %%
def J_z(x, z):
    """∂g/∂z: the Jacobian of a new landmark with respect to range and bearing.

    x : (3,) pose [m, m, rad];  z : (2,) range r [m], bearing β [rad];  returns (2, 2)
    """
    ### BEGIN SOLUTION
    r, c, s = z[0], np.cos(x[2] + z[1]), np.sin(x[2] + z[1])
    return np.array([[c, -r * s], [s, r * c]])
    ### END SOLUTION


# %%
check("04-jxr-jz")

# %% [markdown]
# ## 3 · The covariance of a new landmark
#
# The pose has the covariance $P$ (3 × 3), the measurement has the covariance $R$ (2 × 2), and the two errors
# are uncorrelated. The landmark that is computed from both has the covariance $P_{nn}$ (2 × 2). Its
# cross-covariance with the pose is $P_{\mathrm rn}$ (3 × 2). The rows of $P_{\mathrm rn}$ belong to $x$, $y$,
# $\theta$ of the robot, its columns to $x$ and $y$ of the landmark.
#
# **Your task.** Return both matrices, to first order, with your `J_xr` and `J_z`. (You must solve
# task 2 first.) `P` and `R` may be full matrices: the errors of $x$, $y$ and $\theta$ may be
# correlated, and the errors of range and bearing may be correlated. $\sigma$ of the heading and
# $\sigma$ of the bearing are at most 0.02 rad. The check allows errors of 0.1 % of the largest
# entry of each matrix, so effects of higher order are negligible. The scatter of a million samples
# is too large.


# %%
def new_landmark(x, P, z, R):
    """Covariance of a new landmark, and its cross-covariance with the pose.

    x : (3,) pose;  P : (3, 3) its covariance;  z : (2,) range, bearing;  R : (2, 2) its covariance
    returns P_nn (2, 2) and P_rn (3, 2)
    """
    ### BEGIN SOLUTION
    Jxr, Jz = J_xr(x, z), J_z(x, z)
    P_nn = Jxr @ P @ Jxr.T + Jz @ R @ Jz.T
    P_rn = P @ Jxr.T
    return P_nn, P_rn
    ### END SOLUTION


# %%
check("04-new-landmark")

# %% [markdown]
# The figure shows 500 samples of the landmark. Each sample is computed from a random pose with the
# covariance $P$ and a random measurement with the covariance $R$. About 95 % of the samples should
# lie inside your ellipse.


# %%
@attempt
def _():
    rng = np.random.default_rng(4)
    x, P = np.array([0, 0, 0.4]), np.diag([0.15, 0.15, 0.06]) ** 2
    z, R = np.array([5.0, 0.6]), np.diag([0.1, 0.02]) ** 2
    P_nn, _ = new_landmark(x, P, z, R)
    poses, zs = rng.multivariate_normal(x, P, 500), rng.multivariate_normal(z, R, 500)
    placed = np.array([g(pose, one) for pose, one in zip(poses, zs, strict=True)])
    line = layers.Poses("the line of sight", [x, [*g(x, z), x[2] + z[1]]])
    fig, _ = views.cloud(placed, {"your P_nn, 95 %": P_nn}, layers=[line], centre=g(x, z))
    views.show(
        fig, alt=f"{len(placed)} samples of the landmark's position, and the ellipse of your P_nn."
    )


# %% [markdown]
# ## 4 · A camera beside the robot's centre
#
# A camera measures no range. It measures the column of the image in which a landmark appears. A
# camera is usually not at the centre of the robot. This camera is mounted at `mount = [a, b]`, $a$
# metres ahead of the centre and $b$ metres to the left of the centre (both may be negative). Its
# optical axis has the direction of the heading. In the frame of the camera, with $X$ ahead and $Y$
# to the left, a landmark appears in the column
#
# $$u = -F\,\frac{Y}{X},$$
#
# in pixels, measured from the middle of the image to the right. $F$ is the focal length, also in
# pixels. (In this task $u$ is not the control input, and $F$ is not the matrix of lesson 03.) You
# will not find the Jacobian of this camera in a book, but you can derive it.

# %%
ask(
    "ex04-camera",
    "The robot turns a little to the left, and its camera is at its centre. Two landmarks appear "
    "in the same column, one at a distance of 1 m, the other at 10 m. **Which landmark's column "
    "changes more?**",
    {
        "that of the near one": "this would be right if the camera changed its position. A camera "
        "at the centre only turns.",
        "that of the far one": "in the frame of the camera, the far landmark moves ten times as far, but its distance is also ten times as large.",
        "both change by the same amount": "a turn about the camera changes both directions by the "
        "same angle. A camera ahead of the centre also moves sideways, so then the column of the "
        "near landmark would change more.",
    },
    right="both change by the same amount",
)

# %% [markdown]
# **Your task.** First write $X$ and $Y$ as functions of $x$, $y$, $\theta$, $p_x$, $p_y$, $a$ and
# $b$. Then differentiate the quotient. Return the column `u` [pixels] and its derivatives `H` (5,)
# with respect to $x$, $y$, $\theta$, $p_x$, $p_y$, in this order. The landmark is always in front
# of the camera ($X \ge 1$ mm). The check judges `u` and three parts of `H`: position, heading,
# landmark. It allows errors of 0.001 % of `u`, and of $10^{-8}$ of the largest entry of each part.


# %%
def camera(x, p, mount, F):
    """Column of a landmark in the camera's image, and its derivatives.

    x : (3,) pose [m, m, rad];  p : (2,) landmark [m];  mount : (2,) ahead, left [m]
    F : float, focal length [pixels]
    returns u (a number) [pixels] and H (5,), its derivatives with respect to x, y, θ, p_x, p_y
    """
    ### BEGIN SOLUTION
    dx, dy = p[0] - x[0], p[1] - x[1]
    c, s = np.cos(x[2]), np.sin(x[2])
    ahead, left = c * dx + s * dy, c * dy - s * dx  # the landmark in the robot's frame
    X, Y = ahead - mount[0], left - mount[1]
    X_by = np.array([-c, -s, left, c, s])
    Y_by = np.array([s, -c, -ahead, -s, c])
    return -F * Y / X, -F * (Y_by * X - Y * X_by) / X**2
    ### END SOLUTION


# %%
check("04-camera")

# %% [markdown]
# The next figure shows the effect of the mount. The robot turns on the spot at the origin, and the
# landmark is at (2 m, 0.6 m). The slope of the solid curve at 0 is the third entry of your `H`. The
# dashed curve belongs to a camera at the centre.


# %%
@attempt
def _():
    p, F = np.array([2.0, 0.6]), 500.0
    turns = np.linspace(-0.3, 0.3, 61)
    columns = {
        name: [camera(np.array([0, 0, turn]), p, mount, F)[0] for turn in turns]
        for name, mount in [
            ("30 cm ahead of the centre", np.array([0.3, 0.0])),
            ("at the centre", np.zeros(2)),
        ]
    }
    fig, _ = views.curves(turns, columns, "turn of the robot [rad]", "column u [pixels]")
    views.show(
        fig, alt="Columns of a landmark for two mounts while the robot turns: one curve is steeper."
    )


# %% [markdown]
# ## 5 · Make it better: a prediction with an uncertain heading
#
# A person has carried a robot to another room. $\sigma$ of its heading is now usually 0.3 to 0.8
# rad, and the robot drives a few metres. The prediction of the EKF is the pose $f(\hat x, u)$ with
# the covariance $A P A^{\mathsf T} + W C W^{\mathsf T}$ (04.7), where $C$ (2 × 2) is the covariance
# of the control noise. The next cell contains this prediction and a figure of 500 end points:


# %%
def linearised(x, P, u, C):
    """Mean and covariance of the pose after a motion, by linearisation."""
    (d, turn), c, s = u, np.cos(x[2]), np.sin(x[2])
    A = np.array([[1, 0, -d * s], [0, 1, d * c], [0, 0, 1]])
    W = np.array([[c, 0], [s, 0], [0, 1]])
    return np.array([x[0] + d * c, x[1] + d * s, x[2] + turn]), A @ P @ A.T + W @ C @ W.T


START, P_START = np.zeros(3), np.diag([0.1, 0.1, 0.5]) ** 2
MOTION, C_MOTION = np.array([4.0, 0.2]), np.diag([0.1, 0.05]) ** 2


def show_drive(method, name):
    """Show the end points of 500 robots and the ellipse of a method about its mean."""
    rng = np.random.default_rng(4)
    starts = rng.multivariate_normal(START, P_START, 500)
    motions = rng.multivariate_normal(MOTION, C_MOTION, 500)
    ends = np.array([f_odometry(*pair) for pair in zip(starts, motions, strict=True)])
    mean, covariance = method(START, P_START, MOTION, C_MOTION)
    ellipse = layers.Ellipses(name, np.array([mean[:2]]), np.array([covariance[:2, :2]]))
    fig, _ = views.cloud(ends, {}, layers=[ellipse])
    views.show(
        fig,
        alt=f"The end points of {len(ends)} robots form an arc, with an ellipse over them: {name}.",
    )


attempt(lambda: show_drive(linearised, "linearised, 95 %"))

# %% [markdown]
# The ellipse lies ahead of most end points, and it has the wrong shape: it is far too thin along
# the direction of the motion. A Gaussian density cannot represent the arc exactly. Which Gaussian
# is the best approximation?
#
# **Your task.** Return the `mean` (3,) and the `covariance` (3, 3) of the pose after the motion, by
# any method. The covariance must be symmetric and positive definite. `P` and `C` may be full
# matrices and are positive definite. The errors of pose and control input are independent and
# Gaussian. $\sigma$ of the heading is at most 0.8 rad, and the check also tries very small values.
# The distance is at most 6 m, and it may be zero or negative. $\sigma$ of the control noise is at
# most 0.6 m and 0.3 rad. The heading of the mean may be wrapped or not. Note that `f_odometry`
# wraps the headings that it returns. What is the right mean of 179° and −179°?

# %% [markdown]
# ### How your answer is scored
#
# The score is the mean *negative log-likelihood* of the true end poses. For an end pose $e$, a Gaussian with
# the mean $m$ and the covariance $P$ has the negative log-likelihood
#
# $$\tfrac12 (e-m)^{\mathsf T} P^{-1} (e-m) + \tfrac12 \ln\det (2\pi P),$$
#
# in nats. The first term is half the NEES: it is large if $e$ is many standard deviations from the
# mean. The second term is large if the covariance is large. The average over all end poses is
# smallest for the Gaussian with the true mean and covariance of the end poses. The check computes
# both exactly. Your **loss** is the difference between your average and this minimum, which is the
# *Kullback–Leibler divergence* of the two Gaussians.
#
# The check uses six sets of twenty motions: random motions with $\sigma$ of the heading from 0.3 to
# 0.8 rad, and motions with a very small $\sigma$ of the heading, with a short distance and a large
# control noise, with a negative distance, with a turn on the spot, and with a heading near
# $\pm\pi$. The *median loss* of a set is the median over its motions.
#
# | row | required | points |
# | --- | --- | --- |
# | 1 | median loss of each of the six sets at most 3 nats | 1 |
# | 2 | median loss of each of the six sets at most 0.1 nat | 1 |
# | 3 | median loss of each of the six sets at most 0.01 nat | 1 |
# | 4 | loss of *every* motion of all sets at most 0.00001 nat | 1 |
#
# Each row includes the rows above it, and the points of all rows that you reach are added. Leaving
# the arguments unchanged is worth another 0.5 points. For comparison: the median loss of the
# linearisation in the set of random motions is about 11 nats. Samples of the end pose do not reach
# row 4: a hundred thousand of them lose about 0.0001 nat.
#
# A loss of one nat means that the geometric mean of the likelihoods of the true end poses is
# $\mathrm e \approx 2.7$ times smaller than with the best Gaussian.


# %%
def unsure_drive(x, P, u, C):
    """Mean and covariance of the pose after a motion, more accurate than linearisation.

    x : (3,) pose;  P : (3, 3) its covariance;  u : (2,) distance d [m], turn Δθ [rad]
    C : (2, 2) covariance of u;  returns mean (3,) and covariance (3, 3)
    """
    ### BEGIN SOLUTION
    # f is nonlinear in the heading only. Given the heading, x, y, d and Δθ are Gaussian and enter
    # linearly: average over headings from −6σ to 6σ, with weights from the Gaussian density.
    t = np.linspace(-6, 6, 25)
    weights = np.exp(-(t**2) / 2)
    weights = weights / weights.sum()
    sigma = np.sqrt(P[2, 2])
    lean = P[:2, 2] / sigma  # conditional mean of x and y, per σ of the heading
    ahead = np.column_stack([np.cos(x[2] + sigma * t), np.sin(x[2] + sigma * t)])
    places = x[:2] + np.outer(t, lean) + u[0] * ahead
    ends = np.column_stack([places, x[2] + u[1] + sigma * t])
    mean = weights @ ends
    off = ends - mean
    covariance = off.T @ (weights[:, None] * off)  # of the conditional means; add the others
    covariance[:2, :2] += P[:2, :2] - np.outer(lean, lean)
    covariance[:2, :2] += C[0, 0] * ahead.T @ (weights[:, None] * ahead)
    together = C[0, 1] * weights @ ahead
    covariance[:2, 2] += together
    covariance[2, :2] += together
    covariance[2, 2] += C[1, 1]
    return mean, covariance
    ### END SOLUTION


# %%
check("04-unsure-drive")

# %% [markdown]
# The figure shows your ellipse over the same 500 end points. It is wide along the direction of the
# motion, where the ellipse of the linearisation was thin. A consistent filter must report this
# larger covariance.


# %%
@attempt
def _():
    show_drive(unsure_drive, "yours, 95 %")


# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then shows the grader's verdict. The grader draws other inputs.
# **Next:** [lesson 05](../notebooks/05_localisation_and_mapping.ipynb) uses $H$ and $A$ for
# localisation and mapping.
