# %% [markdown]
# # Exercise 04 · Motion and measurement models, Jacobians and the EKF
#
# **You will be able to** write the Jacobians of EKF-SLAM as functions, derive and write the
# prediction of an EKF, derive the Jacobian of a new sensor, and predict a pose with an uncertain
# heading better than linearisation does.
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
    "A landmark is 2 m to the left of the robot, at the bearing +90°. The robot drives 1 cm straight "
    "ahead. **By which turn on the spot does it get the bearing +90° again, to first order?** (Which "
    "two entries of $H_{\\mathrm r}$ describe this?)",
    {
        "0.005 rad to the left": "the bearing has grown by 0.01 m / 2 m, because the landmark has fallen behind. A turn to the left reduces all bearings by its angle.",
        "0.005 rad to the right": "the landmark is now behind +90°. Does a turn to the right bring it forward?",
        "0.01 rad to the left": "the sign is right, but the same motion changes the bearing of a far landmark less.",
        "none: the robot moves across the line of sight": "such a motion does not change the range to first order, but it changes the bearing.",
    },
    right="0.005 rad to the left",
)

# %% [markdown]
# **Your task.** Return $H_{\mathrm r}$, the 2 × 3 Jacobian of $h$ with respect to $x$, $y$ and
# $\theta$ of the robot. The landmark may lie in any direction, also behind the robot, but never at
# the position of the robot: the check uses distances from 0.1 mm to 30 m. It allows errors of
# $10^{-8}$ of the largest entry of each row.
#
# Derive the formulas. In tasks 1, 2 and 4 the check also uses the coordinates of surveyors, up to
# $10^7$ m, and in task 4 headings after hundreds of thousands of turns. There finite differences at
# these coordinates have larger errors with any step.


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
# A heading error of 0.01 rad moves the landmark. Compare this change with the prediction of your `J_xr`:


# %%
@attempt
def _():
    x, z, error = np.array([1, 2, 0.3]), np.array([8, 0.5]), np.array([0, 0, 0.01])
    print("g changes by  ", (g(x + error, z) - g(x, z)).round(4))
    print("J_xr predicts ", (J_xr(x, z) @ error).round(4))


# %% [markdown]
# ## 3 · The prediction of a robot with two wheels
#
# A robot has two driven wheels at the distance $B$ from each other. In one step the left wheel rolls
# $s_1$ and the right wheel $s_2$, both at a constant speed. So both wheels and the middle of the
# axle move on arcs about one centre, which lies on the line of the axle. By (01.2) the robot turns
# by $\Delta\theta = (s_2 - s_1)/B$. The pose is that of the middle of the axle.
#
# Each wheel slips at random. The error of its distance has the variance $k^2$ times the distance
# that this wheel rolls, whether forwards or backwards, and the errors of both wheels are
# independent.

# %%
ask(
    "ex04-bend",
    "A robot drives 1 m straight ahead, but its right wheel rolls 1 mm farther than measured. "
    "**Where does it end, compared with the estimated end?** (The wheels are 0.2 m apart.)",
    {
        "0.5 mm farther ahead; only its heading is wrong": "this would be right if it turned at the end of the step. It turns during the whole step.",
        "0.5 mm farther ahead and 2.5 mm to the left": "the heading error grows from 0 to 5 mrad, so on average it is 2.5 mrad over 1 m.",
        "0.5 mm farther ahead and 5 mm to the left": "this would be right if the robot had its last heading, with an error of 5 mrad, from the start.",
        "1 mm farther ahead and 2.5 mm to the right": "the middle moves by half of what one wheel rolls. The right wheel rolls farther, so the robot turns to the left.",
    },
    right="0.5 mm farther ahead and 2.5 mm to the left",
)

# %% [markdown]
# **Your task.** Derive the end of the arc $f(x, s)$, its Jacobians $A = \partial f/\partial x$ and $W =
# \partial f/\partial s$, and the covariance $C$ of the errors of $s$. Return the prediction of the EKF
# (04.7), and both Jacobians. The wheels roll equally far, or the robot turns by at least 0.01 rad.
# Wheels may stand still, roll backwards, or turn the robot by more than a full turn. $B$ may be a
# millimetre or a thousand kilometres. You may wrap $\theta$ or not.
#
# | what is judged | allowed error | points |
# | --- | --- | --- |
# | `x` | 0.001 % of its largest entry | 1 |
# | `A`, also for large coordinates and headings | rounding errors only | 1 |
# | `W`, also for small and large robots | $10^{-8}$ of its largest entry | 1 |
# | `P`, computed with the right `A` and `W` or with yours | 0.001 % of its largest entry | 1 |
#
# `x` and `P` also count if you compute `A` and `W` by finite differences. The rows of `A` and `W`
# require exact derivatives.


# %%
def predict_wheels(x, P, s, B, k):
    """EKF prediction of a robot with two wheels.

    x : (3,) pose;  P : (3, 3) its covariance;  s : (2,) distances of the left and right wheel [m]
    B : distance between the wheels [m];  k : noise of a wheel [√m]
    returns x (3,), P (3, 3) after the step, A (3, 3), W (3, 2)
    """
    ### BEGIN SOLUTION
    d = (s[0] + s[1]) / 2
    a = (s[1] - s[0]) / B
    heading = x[2] + a / 2  # of the chord; ratio is chord divided by arc, slope its derivative by a
    ratio = np.sinc(a / (2 * np.pi))
    slope = (np.cos(a / 2) - ratio) / a if a else 0.0
    cos, sin = np.cos(heading), np.sin(heading)
    A = np.eye(3)
    A[:2, 2] = d * ratio * np.array([-sin, cos])
    V = np.array([  # by d and a
        [ratio * cos, d * (slope * cos - ratio * sin / 2)],
        [ratio * sin, d * (slope * sin + ratio * cos / 2)],
        [0, 1],
    ])  # fmt: skip
    W = V @ np.array([[0.5, 0.5], [-1 / B, 1 / B]])
    C = k**2 * np.diag(np.abs(s))
    step = np.array([d * ratio * cos, d * ratio * sin, a])
    P_end = A @ P @ A.T + W @ C @ W.T
    return x + step, P_end, A, W
    ### END SOLUTION


# %%
check("04-wheels")

# %% [markdown]
# The figure shows 500 end points of a robot whose wheels roll 0.9 m and 1.1 m. About 95 % of them
# should lie inside your ellipse.


# %%
@attempt
def _():
    rng = np.random.default_rng(4)
    x, P = np.array([0, 0, 0.4]), np.diag([0.03, 0.03, 0.06]) ** 2
    s, B, k = np.array([0.9, 1.1]), 0.4, 0.04
    starts = rng.multivariate_normal(x, P, 500)
    rolled = s + k * np.sqrt(s) * rng.standard_normal((500, 2))
    ends = [predict_wheels(*each, B, k)[0] for each in zip(starts, [P] * 500, rolled, strict=True)]
    end, P_end, _, _ = predict_wheels(x, P, s, B, k)
    path = layers.Poses("start and estimated end", [x, end])
    ellipse = {"your P, 95 %": P_end[:2, :2]}
    fig, _ = views.cloud(np.array(ends), ellipse, layers=[path], centre=end)
    views.show(fig, alt=f"{len(ends)} end points of a robot with two wheels, and your ellipse.")


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
# | 1 | median loss of each of the six sets at most 3 nats | 0.5 |
# | 2 | median loss of each of the six sets at most 0.1 nat | 0.5 |
# | 3 | median loss of each of the six sets at most 0.01 nat | 1 |
# | 4 | loss of *every* motion of all sets at most 0.00001 nat | 2 |
#
# Each row includes the rows above it, and the points of all rows that you reach are added. Leaving
# the arguments unchanged is worth another 0.5 points. For comparison: the median loss of the
# linearisation in the set of random motions is about 11 nats. Random samples are welcome: ten
# thousand of them reach row 3. They do not reach row 4, which requires an exact average: a hundred
# thousand samples lose about 0.0001 nat.
#
# A loss of one nat means that the geometric mean of the likelihoods of the true end poses is
# $\mathrm e \approx 2.7$ times smaller than with the best Gaussian.


# %%
def moments(x, P, u, C):
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
check("04-moments")

# %% [markdown]
# The figure shows your ellipse over the same 500 end points. It is wide along the direction of the
# motion, where the ellipse of the linearisation was thin. A consistent filter must report this
# larger covariance.


# %%
@attempt
def _():
    show_drive(moments, "yours, 95 %")


# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then shows the grader's verdict. The grader draws other inputs.
# **Next:** [lesson 05](../notebooks/05_localisation_and_mapping.ipynb) uses $H$ and $A$ for
# localisation and mapping.
