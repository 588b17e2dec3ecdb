# %% [markdown]
# # Exercise 04 · Models and Jacobians
#
# **You will be able to** write the Jacobians of EKF-SLAM as functions, derive the Jacobian of a
# sensor that is in no book, say how unsure a new landmark is and with what it shares its error, and
# do better than a tangent where the tangent fails.
#
# **60 minutes. Before:** lesson [04 · Models and
# Jacobians](../notebooks/04_models_and_jacobians.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it, as often as you like. A check tries random inputs and others that are as special as the text
# allows. Where a law is broken it shows a small input that breaks it, and `hint("04-camera")` in a
# cell of your own leads on.
#
# All lengths are in metres, all angles in radians. `x` is a pose `[x, y, θ]`, `p` a landmark, `u = [d,
# Δθ]` a drive, `z = [r, β]` a range and a bearing; bearings count counter-clockwise from the robot's
# heading. Angles may be any number, also beyond $\pi$. No function may change the arrays it is given.

# %%
import numpy as np

from slamlab import layers, views
from slamlab.checks import ask, attempt, check
from slamlab.models import f_odometry, g, h

# %% [markdown]
# ## 1 · H: what a step of the robot does to what it sees
#
# `h(x, p)` says at which range and bearing a robot at the pose $x$ sees a landmark at $p$:
#
# $$r = \sqrt{(p_x-x)^2+(p_y-y)^2}, \qquad \beta = \operatorname{atan2}(p_y-y,\ p_x-x) - \theta$$

# %%
ask(
    "ex04-left",
    "The robot stands at the origin, looks along the x axis and sees a landmark 2 m ahead. Now it "
    "steps 1 cm to its left. **What happens to range and bearing?** (One entry of $H_{\\mathrm r}$ "
    "says so. Which?)",
    {
        "the range grows, the bearing stays 0": "by Pythagoras the range grows by 25 µm, which no derivative sees. But the landmark is no longer "
        "straight ahead.",
        "the range stays, the bearing grows": "bearings count counter-clockwise, to the left. On which side of its nose has the robot now got "
        "the landmark?",
        "the range stays, the bearing shrinks below 0": "the landmark is now to the right of where the robot looks, by 1 cm in 2 m, 0.005 rad.",
        "neither changes: the step is across the line of sight": "a step across the line of sight leaves the range alone. It is the bearing that notices it.",
    },
    right="the range stays, the bearing shrinks below 0",
)

# %% [markdown]
# **Your task.** Return the 2 × 3 matrix of the derivatives of $h$ with respect to $x$, $y$ and
# $\theta$ of the robot. The landmark may lie in any direction, behind the robot too, but never at the
# robot itself.


# %%
def H_robot(x, p):
    """∂h/∂x: how range and bearing of landmark p change with the pose x.

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
# Now compare your $H_{\mathrm r}$ with the model itself: move the robot by a little, and see what
# changes. The two rows of each pair should be almost equal. The difference comes from the curvature
# of $h$, and shrinks faster than the step does.


# %%
@attempt
def _():
    x, p = np.array([1.0, 0.5, 0.3]), np.array([3.1, 1.4])
    H = H_robot(x, p)
    for name, step in zip(["x", "y", "θ"], 0.01 * np.eye(3), strict=True):
        print(f"step along {name}:  h changes by", (h(x + step, p) - h(x, p)).round(4))
        print("                  H says       ", (H @ step).round(4))


# %% [markdown]
# ## 2 · Where a new landmark comes from
#
# A landmark that is seen for the first time is put where the robot believes that it sees it, at `g(x, z)`:
#
# $$p_x = x + r\cos(\theta+\beta), \qquad p_y = y + r\sin(\theta+\beta)$$

# %%
ask(
    "ex04-lever",
    "The heading of the robot is 0.01 rad off, and everything else is exact. **How far off does it "
    "place a "
    "landmark that it sees 8 m away?**",
    {
        "1 cm, as at any distance: an angle is an angle": "it is 1 cm at 1 m. The same angle reaches farther, the longer the arm.",
        "8 cm, along the line of sight": "the range is exact. A wrong heading swings the landmark round the robot.",
        "8 cm, across the line of sight": "the landmark swings round the robot on an arm of 8 m, in whatever direction it stands.",
        "it depends on whether the landmark is ahead or to the side": "in which direction it is off depends on that. How far does not.",
    },
    right="8 cm, across the line of sight",
)

# %% [markdown]
# **Your task.** Return the derivatives of $g$ with respect to the pose, $J_{\mathrm r}$ (2 × 3, `J_xr` in the
# code), and with respect to the measurement, $J_z$ (2 × 2), for any range $r > 0$.


# %%
def J_xr(x, z):
    """∂g/∂x: how a new landmark moves with the pose x it was seen from.

    x : (3,) pose [m, m, rad];  z : (2,) range r [m], bearing β [rad];  returns (2, 3)
    """
    ### BEGIN SOLUTION
    r, direction = z[0], x[2] + z[1]
    return np.array([[1, 0, -r * np.sin(direction)], [0, 1, r * np.cos(direction)]])
    ### END SOLUTION


# %%
def J_z(x, z):
    """∂g/∂z: how a new landmark moves with the range and bearing it was seen at.

    x : (3,) pose [m, m, rad];  z : (2,) range r [m], bearing β [rad];  returns (2, 2)
    """
    ### BEGIN SOLUTION
    r, c, s = z[0], np.cos(x[2] + z[1]), np.sin(x[2] + z[1])
    return np.array([[c, -r * s], [s, r * c]])
    ### END SOLUTION


# %%
check("04-jxr-jz")

# %% [markdown]
# ## 3 · How sure is a new landmark?
#
# The pose has the covariance $P$ (3 × 3), the measurement has the covariance $R$ (2 × 2), and the two errors
# have nothing to do with each other. The landmark that is computed from both has a covariance of its own,
# $P_{nn}$ (2 × 2), and one with the pose, $P_{\mathrm rn}$ (3 × 2), whose rows are for $x$, $y$, $\theta$ of the
# robot and whose columns are for $x$ and $y$ of the landmark.
#
# **Your task.** Return both, to first order, with your `J_xr` and `J_z`. `P` and `R` may be full matrices:
# the errors of $x$, $y$ and $\theta$ may go together, and so may those of range and bearing. The heading is
# known to 0.05 rad or better. The check takes the slopes of $g$ itself and carries $P$ and $R$ through
# them.


# %%
def new_landmark(x, P, z, R):
    """Covariance of a new landmark, and between the pose and it.

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
# Now the picture: 500 robots stand where the belief says they may be, and each places the landmark where it sees
# it. About 95 of 100 should lie inside your ellipse.


# %%
@attempt
def _():
    rng = np.random.default_rng(4)
    x, P = np.array([0, 0, 0.4]), np.diag([0.15, 0.15, 0.06]) ** 2
    z, R = np.array([5.0, 0.6]), np.diag([0.1, 0.02]) ** 2
    P_nn, _ = new_landmark(x, P, z, R)
    poses, seen = rng.multivariate_normal(x, P, 500), rng.multivariate_normal(z, R, 500)
    placed = np.array([g(pose, one) for pose, one in zip(poses, seen, strict=True)])
    line = layers.Poses("the line of sight", [x, [*g(x, z), x[2] + z[1]]])
    fig, _ = views.cloud(placed, {"your P_nn, 95 %": P_nn}, layers=[line], centre=g(x, z))
    views.show(
        fig, alt=f"{len(placed)} places where the landmark may be, and the ellipse of your P_nn."
    )


# %% [markdown]
# ## 4 · A camera beside the robot's centre
#
# A camera measures no range. It tells in which column of its image a landmark appears, and it seldom
# sits at the centre of the robot. Ours is mounted at `mount = [a, b]`, $a$ metres ahead of the centre
# and $b$ metres to the left of it (either may be negative), and it looks along the robot's heading. In
# the camera's own frame, with $X$ ahead and $Y$ to the left, a landmark appears in the column
#
# $$u = -F\,\frac{Y}{X},$$
#
# counted from the middle of the image to the right, in pixels. $F$, the focal length, is in pixels,
# too. No book prints the Jacobian of *this* camera on *this* robot, and you do not need a book.

# %%
ask(
    "ex04-camera",
    "The robot turns a little to the left, and its camera sits at its centre. Two landmarks appear in "
    "the same column, one of them 1 m away, the other 10 m. **Whose column moves farther?**",
    {
        "that of the near one": "that would be right if the camera moved. At the centre it only "
        "turns.",
        "that of the far one": "it swings past on a longer arm, but it is also seen from that much farther away.",
        "both move by the same": "a turn about the camera moves all directions alike. A camera ahead of the centre is also carried "
        "sideways, and then the near landmark moves farther.",
    },
    right="both move by the same",
)

# %% [markdown]
# **Your task.** First write $X$ and $Y$ in terms of $x$, $y$, $\theta$, $p_x$, $p_y$, $a$ and $b$. Then
# differentiate the quotient. Return `u` and its derivatives `H` with respect to $x$, $y$, $\theta$, $p_x$,
# $p_y$, in this order. The landmark is always in front of the camera ($X \ge 0.5$ m).


# %%
def camera(x, p, mount, F):
    """Column at which the camera sees a landmark, and how it changes with pose and landmark.

    x : (3,) pose [m, m, rad];  p : (2,) landmark [m];  mount : (2,) ahead, left [m]
    F : float, focal length [pixels]
    returns u (a number) [pixels] and H (5,), its derivatives by x, y, θ, p_x, p_y
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
# Does the mount matter? The robot turns on the spot, and the landmark is 2 m ahead. The slope of the solid curve
# at 0 is the third entry of your `H`; the dashed curve belongs to the same camera at the centre.


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
        fig, alt="Columns of a landmark for two mounts while the robot turns: one is steeper."
    )


# %% [markdown]
# ## 5 · Make it better: a drive with an unsure heading
#
# A robot was carried to another room. It knows its heading to 0.3 rad at best and to 0.8 rad at
# worst, and it drives a few metres. The linearised step of the lesson says that it is now at
# $f(\hat x, u)$, with the covariance $A P A^{\mathsf T} + W C W^{\mathsf T}$, where $C$ (2 × 2) is
# the covariance of the drive's own noise. Here is that step, ready to use, and a picture of where
# 500 robots really end:


# %%
def linearised(x, P, u, C):
    """Mean and covariance of the pose after a drive, linearised."""
    (d, turn), c, s = u, np.cos(x[2]), np.sin(x[2])
    A = np.array([[1, 0, -d * s], [0, 1, d * c], [0, 0, 1]])
    W = np.array([[c, 0], [s, 0], [0, 1]])
    return np.array([x[0] + d * c, x[1] + d * s, x[2] + turn]), A @ P @ A.T + W @ C @ W.T


START, BELIEVED = np.zeros(3), np.diag([0.1, 0.1, 0.5]) ** 2
DRIVE, WHEELS = np.array([4.0, 0.2]), np.diag([0.1, 0.05]) ** 2


def show_drive(method, name):
    """Show the ends of 500 robots and the ellipse of a method about its mean."""
    rng = np.random.default_rng(4)
    starts = rng.multivariate_normal(START, BELIEVED, 500)
    drives = rng.multivariate_normal(DRIVE, WHEELS, 500)
    ends = np.array([f_odometry(*pair) for pair in zip(starts, drives, strict=True)])
    mean, covariance = method(START, BELIEVED, DRIVE, WHEELS)
    ellipse = layers.Ellipses(name, np.array([mean[:2]]), np.array([covariance[:2, :2]]))
    fig, _ = views.cloud(ends, {}, layers=[ellipse])
    views.show(
        fig, alt=f"The ends of {len(ends)} robots bend like a banana; over them an ellipse: {name}."
    )


attempt(lambda: show_drive(linearised, "linearised, 95 %"))

# %% [markdown]
# The ellipse lies in front of most robots; it is too long and far too thin. A belief has one mean and one
# covariance, so it cannot draw a banana. Which ellipse would you draw?
#
# **Your task.** Return the `mean` (3,) and the `covariance` (3, 3) of the pose after the drive, by any method
# you like. `P` and `C` may be full matrices and are positive definite; the errors of pose and drive have
# nothing to do with each other, and both are Gaussian. The $\sigma$ of the heading is 0.8 rad at most (and may
# be tiny). The distance is 6 m at most, and may be zero or negative. The wheels err by 0.6 m and 0.3 rad at
# most. Whether you wrap the angle of the mean is up to you. But mind that `f_odometry` wraps the headings it
# returns, and think of what the average of 179° and −179° is.

# %% [markdown]
# ### How you are scored
#
# By *surprise*. If the robot ends at $e$, a belief with the mean $m$ and the covariance $P$ is surprised by
#
# $$\tfrac12 (e-m)^{\mathsf T} P^{-1} (e-m) + \tfrac12 \ln\det (2\pi P)$$
#
# nats: by much if the end is many standard deviations off (the first term is half the NEES), and also if
# the ellipse was drawn large to be on the safe side (the second term). On average over all ends, the
# Gaussian with their true mean and covariance is surprised least. The check knows these exactly, and
# counts how many nats you lose against them in twenty drives, and in special ones of five kinds. Half
# of the drives means half of each kind. There are four steps:
#
# | step | what you lose | for comparison |
# |---|---|---|
# | 1 | at most 1 nat in half of the drives | linearised: 11 |
# | 2 | at most 0.1 nat in half of the drives | |
# | 3 | at most 0.01 nat in half of the drives | |
# | 4 | at most 0.01 nat in *every* drive | |
#
# To lose one nat means that the true ends seem $\mathrm e \approx 2.7$ times less likely than they should.


# %%
def unsure_drive(x, P, u, C):
    """Mean and covariance of the pose after a drive, by any method that beats the linearised one.

    x : (3,) pose;  P : (3, 3) its covariance;  u : (2,) distance d [m], turn Δθ [rad]
    C : (2, 2) covariance of u;  returns mean (3,) and covariance (3, 3)
    """
    ### BEGIN SOLUTION
    # Only the heading bends. Given the heading, x, y, d and Δθ are Gaussian and enter straight: so
    # average over a fan of headings, from −6σ to 6σ, each with the weight that the belief gives it.
    t = np.linspace(-6, 6, 25)
    weights = np.exp(-(t**2) / 2)
    weights = weights / weights.sum()
    sigma = np.sqrt(P[2, 2])
    lean = P[:2, 2] / sigma  # where x and y are on average, per σ of the heading
    ahead = np.column_stack([np.cos(x[2] + sigma * t), np.sin(x[2] + sigma * t)])
    places = x[:2] + np.outer(t, lean) + u[0] * ahead
    ends = np.column_stack([places, x[2] + u[1] + sigma * t])
    mean = weights @ ends
    off = ends - mean
    covariance = off.T @ (weights[:, None] * off)  # of the averages; now what scatters about them
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
# Here is your ellipse over the same 500 robots. It is wide where the linearised one was thin: that much
# doubt an honest filter has to admit.


# %%
@attempt
def _():
    show_drive(unsure_drive, "yours, 95 %")


# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then says what the grader will say about it; the grader draws other
# inputs. **Next:** [lesson 05](../notebooks/05_two_easy_halves.ipynb) puts $H$ and $A$ to work.
