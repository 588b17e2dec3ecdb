# %% [markdown]
# # 04 · Models and Jacobians: exercise
#
# **You will be able to** write the Jacobians of EKF-SLAM as functions, test them without knowing
# the answer, and use them to say how uncertain a new landmark is, and with whom it shares its
# error.
#
# **45 minutes. Before:** lesson 04.
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it, as often as you like. A check tries random inputs and tells you which law is broken.
#
# Metres and radians throughout. `x` is a pose `[x, y, θ]`, `p` a landmark, `u = [d, Δθ]` a drive,
# `z = [r, β]` a range and a bearing, counter-clockwise from the robot's heading.

# %%
import numpy as np

from slamlab import layers, views
from slamlab.checks import attempt, check
from slamlab.models import f_odometry, g, h

# %% [markdown]
# ## H: what a step of the robot does to what it sees
#
# `h(x, p)` says at which range and bearing a robot at `x` sees a landmark at `p`:
#
# $$r = \sqrt{(p_x-x)^2+(p_y-y)^2}, \qquad \beta = \operatorname{atan2}(p_y-y,\ p_x-x) - \theta$$
#
# **Predict first.** The robot stands at the origin, looks along +x and sees a landmark 2 m ahead.
# It steps 1 cm to its left. Does the range change? Does the bearing grow or shrink? Which entry of
# H says so, and what must its sign be?
#
# **Your task.** The (2, 3) matrix of derivatives of `h` by the robot's x, y, θ.


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
# Your H against the model itself: move the robot by a little and compare. The two rows of each pair
# must agree but for a share of the step's size.


# %%
@attempt
def _():
    x, p = np.array([1.0, 0.5, 0.3]), np.array([3.1, 1.4])
    H = H_robot(x, p)
    for name, step in zip(["x", "y", "θ"], 0.01 * np.eye(3), strict=True):
        print(f"step along {name}:  h changes by", (h(x + step, p) - h(x, p)).round(4))
        print("                  H says       ", (H @ step).round(4))


# %% [markdown]
# ## H: what a step of the landmark does
#
# The filter's state holds landmarks too, so H has columns for them.
#
# **Predict first.** Robot and landmark both step 1 cm to the north. What changes in `h`? What does
# that say about the columns you are about to write and those you have?
#
# **Your task.** The (2, 2) matrix of derivatives of `h` by the landmark's x, y.


# %%
def H_landmark(x, p):
    """∂h/∂p: how range and bearing change with the landmark p.

    x : (3,) pose [m, m, rad];  p : (2,) landmark [m];  returns (2, 2)
    """
    ### BEGIN SOLUTION
    dx, dy = p[0] - x[0], p[1] - x[1]
    q = dx**2 + dy**2
    r = np.sqrt(q)
    return np.array([[dx / r, dy / r], [-dy / q, dx / q]])
    ### END SOLUTION


# %%
check("04-h-landmark")

# %% [markdown]
# ## A: what becomes of an error while driving
#
# `f_odometry(x, u)` drives a distance `d` along the heading it has, then turns by `Δθ`:
#
# $$x' = x + d\cos\theta, \qquad y' = y + d\sin\theta, \qquad \theta' = \theta + \Delta\theta$$
#
# **Predict first.** Two robots start at the same place, one with its heading 0.1 rad off. They
# drive 3 m. How far apart do they end? And if they drive 6 m?
#
# **Your task.** The (3, 3) matrix of derivatives of the new pose by the old one.


# %%
def A_odometry(x, u):
    """∂f/∂x: how the new pose changes with the old one.

    x : (3,) pose [m, m, rad];  u : (2,) distance d [m], turn Δθ [rad];  returns (3, 3)
    """
    ### BEGIN SOLUTION
    d, theta = u[0], x[2]
    return np.array([[1, 0, -d * np.sin(theta)], [0, 1, d * np.cos(theta)], [0, 0, 1]])
    ### END SOLUTION


# %%
check("04-a-odometry")

# %% [markdown]
# The same, as a picture: 500 robots that are unsure where they stand drive the same 3 m. Your
# A P Aᵀ is the ellipse; 95 of 100 robots should end inside.


# %%
@attempt
def _():
    rng = np.random.default_rng(4)
    x, u, P = np.array([0, 0, 0.5]), np.array([3.0, 0.4]), np.diag([0.1, 0.1, 0.08]) ** 2
    A = A_odometry(x, u)
    ends = np.array([f_odometry(start, u) for start in rng.multivariate_normal(x, P, 500)])
    way = layers.Poses("the way, as believed", [x, f_odometry(x, u)])
    fig, _ = views.cloud(ends, {"your A P Aᵀ, 95 %": A @ P @ A.T}, layers=[way])
    views.show(fig, alt="The end points of 500 robots and the ellipse of your A P Aᵀ.")


# %% [markdown]
# ## J_xr and J_z: where a new landmark comes from
#
# A landmark seen for the first time is put where the robot believes to see it, at `g(x, z)`:
#
# $$p_x = x + r\cos(\theta+\beta), \qquad p_y = y + r\sin(\theta+\beta)$$
#
# **Predict first.** The robot's heading is 0.01 rad off. By how much is a landmark misplaced that
# it sees at 1 m? At 8 m? Does it matter whether the landmark is ahead or to the side?
#
# **Your task.** The derivatives of `g` by the pose, `J_xr` (2, 3), and by the measurement, `J_z`
# (2, 2).


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
# ## How sure is a new landmark?
#
# The pose has the covariance `P` (3, 3), the measurement the covariance `R` (2, 2), and the two err
# independently. The landmark computed from both has a covariance of its own, `P_nn` (2, 2), and
# one with the pose, `P_rn` (3, 2): row for x, y, θ of the robot, column for x, y of the landmark.
#
# **Predict first.** If the robot truly stands 10 cm farther east than it believes, where is the
# landmark truly? Can `P_rn` be zero?
#
# **Your task.** Both, with your `J_xr` and `J_z`. The check draws poses and measurements, places
# the landmarks with `g`, and compares the covariances of what comes out with yours: no formula is
# consulted.


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
# And the picture: 500 robots where the belief says they may be, each placing the landmark where it
# sees it. 95 of 100 should lie inside your ellipse.


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
    fig, _ = views.cloud(placed, {"your P_nn, 95 %": P_nn}, layers=[line])
    views.show(fig, alt="500 places where the landmark may be and the ellipse of your P_nn.")


# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then says what the grader will say about it;
# the grader draws other inputs. The next lesson puts H and A to work: localisation in a known map,
# and a map from known poses.
