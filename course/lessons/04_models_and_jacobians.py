# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 04 · Motion and measurement models, Jacobians and the EKF
#
# **You will be able to** derive every Jacobian that EKF-SLAM needs, explain the meaning of its entries, test a
# Jacobian before you use it, run an extended Kalman filter, and state when its linearisation fails.
#
# **80 minutes,** in two parts (32 + 48). **Before:** lesson [00](00_start_here.ipynb) for the
# symbols, lesson [03](03_kalman_filter.ipynb) for covariances and the Kalman filter; partial
# derivatives.
#
# The main idea: a model predicts a pose or a measurement, and its Jacobian predicts the effect of a small error.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Part one is about motion, part two about measurements; each part can be a separate
# lecture. Each line of a derivation appears when you press a key, so ask the class for the next line
# before you press. Good questions for a poll are the first two, the questions on the moved hall and on the new
# landmark, and the last question. The sections after "What you can do now" are for reading at home.

# %% slideshow={"slide_type": "skip"} tags=["folded"]
import numpy as np
import sympy as sp
from scipy.linalg import null_space
from scipy.stats import chi2

from classroom.checks import ask, compare
from classroom.derivation import derive, differentiate, expectation, partials, symmetric
from course.studies import error_propagation
from course.studies.pose_posterior_samples import share_in_ellipse
from slamlab import models, views
from slamlab.evaluation import nees
from slamlab.filters import Belief
from slamlab.filters.ekf_localisation import predict
from slamlab.filters.kalman_filter import correct
from slamlab.geometry import wrap
from slamlab.layers import Ellipses, Points, Poses
from slamlab.models import jacobians, noise
from slamlab.models.finite_differences import numerical_jacobian

# %% [markdown] slideshow={"slide_type": "slide"} minutes=9
# ## Linearisation and covariance propagation
#
# How does a small error change when the robot moves? A matrix described the motion of the cart in lesson 03.
# The motion model of a robot in the plane is not linear: the robot drives in the direction of its heading,
# so the model contains sines and cosines. Can we still use the Kalman filter?
#
# Consider a robot whose estimated pose is the origin with the heading 0.7 rad (40°). The standard deviation is
# $\sigma$ = 5 cm in $x$ and in $y$, and 0.1 rad (6°) in the heading. The robot drives 3 m straight ahead and
# then turns by 0.3 rad. Its odometry is exact.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-linearisation-and-covariance-propagation"
# *For the lecturer:* Ask for 3 m times 0.1 rad before the figure appears. Point out that the ellipse was
# computed without any of the dots. If time is short, state the factor 2.45 and skip the section on it.

# %% slideshow={"slide_type": "fragment"}
ask(
    "04-streak",
    "We draw 1000 start poses from this Gaussian, and each robot makes the same motion. What does the "
    "distribution of the end points look like?",
    {
        "a round spot, 5 cm wide": "this is the distribution at the start. But with a "
        "heading error, the robot is farther from the estimated path after every metre.",
        "a streak along the path": "this would be the effect of an error of the distance. This "
        "odometry is exact: every robot drives 3 m.",
        "a streak across the path": "0.1 rad of heading times 3 m is 0.3 m to the side, six times "
        "the standard deviation of the start position.",
    },
    right="a streak across the path",
)

# %% slideshow={"slide_type": "subslide"}
x_hat, u = np.array([0, 0, 0.7]), np.array([3.0, 0.3])  # estimated pose; distance and turn
P, exact = np.diag([0.05, 0.05, 0.1]) ** 2, np.zeros((2, 2))
ends = error_propagation.sample_end_poses(x_hat, P, u, exact, np.random.default_rng(4))
end = models.f_odometry(x_hat, u)
path = Poses("the estimated path", [x_hat, end])

# %% slideshow={"slide_type": "fragment"} answers="04-streak"
fig, _ = views.cloud(ends, {}, "End points of 1000 robots", (8, 5), [path])
along, across = np.array([[np.cos(0.7), np.sin(0.7)], [-np.sin(0.7), np.cos(0.7)]])
sigmas = [np.std(ends[:, :2] @ axis) for axis in (along, across)]
views.show(
    fig,
    f"End points in a streak across the path: σ is {sigmas[1]:.2f} m across the path, "
    f"{sigmas[0]:.2f} m along the path.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="04-streak"
# The streak lies **across** the path: the standard deviation is {= sigmas[1]:.2f =} m to the side
# and {= sigmas[0]:.2f =} m ahead. The heading error moves the end point sideways by the distance times the error.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The Jacobian
#
# The **motion model** (also *process model*) $f$ gives the pose after a motion. This function is not linear.
# But our errors are small, and near one point a smooth function is almost linear. Replacing the function near
# this point by its **first-order Taylor** polynomial is called **linearisation**. With the error
# $\tilde x = x - \hat x$,
#
# $$f(\hat x + \tilde x) \approx f(\hat x) + A\,\tilde x. \tag{04.1}$$
#
# The matrix $A$ is the **Jacobian** of $f$. Each entry is a **partial derivative**: row $i$, column
# $j$ states how much the component $i$ of the end pose changes, per unit, when the component $j$ of
# the start pose changes slightly,
#
# $$A_{ij} = \left.\frac{\partial f_i}{\partial x_j}\right|_{\hat x}. \tag{04.2}$$
#
# By (04.1) the motion turns the error $\tilde x$ into $A \tilde x$, to first order. In lesson 03 the matrix $F$
# had the role of $A$. So the same derivation gives the covariance, to first order:
#
# $$P \leftarrow A P A^{\mathsf T} \tag{04.3}$$
#
# This step is called **covariance propagation** (also *error propagation*).

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The Jacobian of our motion
#
# We can approximate (04.2) without calculus: increase and decrease one component of the start pose by a
# millionth, compute the difference of the two end poses, and divide by the change. `numerical_jacobian`
# computes each column in this way, by *finite differences*.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
A_here = numerical_jacobian(lambda x: models.f_odometry(x, u), x_hat)
A_here.round(3)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The first two columns show that a position error stays the same. The third column describes the heading: a
# small heading error moves the end by {= A_here[0, 2]:.2f =} m per radian in $x$
# and by {= A_here[1, 2]:.2f =} m per radian in $y$. This vector points across the path, and its length
# is the distance, 3 m.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** Propagate the covariance `P` of the start pose through the motion.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
P_end = ...  # from A_here and P
compare(P_end, noise.Q(A_here, P))

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# P_end = A_here @ P @ A_here.T
# ```
#
# The check uses the library's function for $W C W^{\mathsf T}$, because the formula is the same for every linear map.
#
# </details>

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The 95 % confidence ellipse
#
# We draw a covariance in the plane as an ellipse. How large must this ellipse be? Along two axes the errors are
# uncorrelated. We divide each of these two errors by its $\sigma$. The sum of the two squares is the squared **Mahalanobis
# distance**. For Gaussian errors the sum has the $\chi^2$ distribution of lesson 03, with two degrees of
# freedom, one for each coordinate. In the plane this distribution has
# a simple form:
#
# $\displaystyle \Pr(\text{squared distance} \le c^2) = 1 - \mathrm e^{-c^2/2} = 0.95 \quad\Rightarrow\quad
# c^2 = -2 \ln 0.05 = 5.99, \quad c = 2.45$
#
# So the semi-axes of the **95 % confidence ellipse** are 2.45 standard deviations long. In one dimension 1.96
# standard deviations are enough, because only one error has to be small.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for level in (0.68, 0.95, 0.99):
    print(f"{100 * level:.0f} %: {chi2.ppf(level, 1) ** 0.5:.2f} σ on a line,", end=" ")
    print(f"{chi2.ppf(level, 2) ** 0.5:.2f} σ in the plane")

# %% slideshow={"slide_type": "subslide"}
ellipse = {"A P Aᵀ, 95 %": A_here @ P @ A_here.T}
fig, _ = views.cloud(ends, ellipse, "Covariance propagation", (8, 5), [path], centre=end)
predicted_share = share_in_ellipse(Belief(end, A_here @ P @ A_here.T), ends)
views.show(
    fig,
    f"The same end points and the ellipse A P Aᵀ around the estimated end; "
    f"{100 * predicted_share:.0f} % of the points lie inside.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# We computed this 95 % confidence ellipse by (04.3), without using any of the dots, and drew it around
# $f(\hat x)$, the estimated end. Of the 1000 robots {= 100 * predicted_share:.0f =} % end inside it. This share is slightly less than 95 %, because the streak is slightly bent. A Kalman filter that works with such
# Jacobians is called an **extended Kalman filter** (**EKF**).

# %% [markdown] slideshow={"slide_type": "slide"} minutes=9
# ## The error of the linearisation
#
# We computed the Jacobian at one heading, 0.7 rad. What is the effect if the true heading may be far from this value?

# %% slideshow={"slide_type": "fragment"}
ask(
    "04-bias",
    "Now σ of the heading is 0.6 rad (34°). The filter still estimates the end as f(x̂), the end of a "
    "robot with exactly the estimated heading. Where do the 1000 robots end **on average**?",
    {
        "at f(x̂): left and right cancel": "the errors to the sides do cancel. But a robot "
        "that veers to the left or to the right also advances less.",
        "nearer to the start than f(x̂)": "every robot that veers to one side advances less than "
        "the estimate, and no robot advances more.",
        "farther from the start than f(x̂)": "all robots drive 3 m, so their average cannot be "
        "farther than 3 m from the start.",
    },
    right="nearer to the start than f(x̂)",
)


# %% slideshow={"slide_type": "subslide"}
def propagate(heading_sigma, distance):
    """1000 end poses of a motion, and the EKF's estimate and covariance of the end."""
    u, P = np.array([distance, 0.3]), np.diag([0.05, 0.05, heading_sigma]) ** 2
    A = jacobians.A_odometry(x_hat, u)
    ends = error_propagation.sample_end_poses(x_hat, P, u, exact, np.random.default_rng(4))
    return ends, Belief(models.f_odometry(x_hat, u), A @ P @ A.T)


# %% slideshow={"slide_type": "fragment"} answers="04-bias" tags=["folded"]
def banana(heading_sigma, distance):
    ends, b = propagate(heading_sigma, distance)
    path = Poses("the estimated path", [x_hat, b.x])
    title = f"{100 * share_in_ellipse(b, ends):.0f} % of the robots are inside the ellipse"
    return views.cloud(ends, {"A P Aᵀ, 95 %": b.P}, title, (8, 5), [path], centre=b.x)[0]


views.explore(
    banana,
    lambda heading_sigma, distance: (
        f"End points after {distance:.1f} m, σ of the heading {heading_sigma:.2f} rad: they form an "
        "arc around the start, and the ellipse of the linearisation is straight; "
        f"{100 * share_in_ellipse(*propagate(heading_sigma, distance)[::-1]):.0f} % are inside."
    ),
    heading_sigma=(0.02, 1.5, 0.6),
    distance=(0.5, 6.0, 3.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="04-bias"
# The end points form an arc around the start, like a banana. The ellipse cannot bend, because a linear map
# turns an ellipse into an ellipse. The ellipse is too long, far too thin, and at the wrong position. Decrease
# $\sigma$ of the heading to 0.1 rad: arc and ellipse almost agree. Then increase the distance: fewer and fewer
# robots are inside the ellipse, because the arc bends farther away from it, while the thickness of the ellipse
# stays the same.

# %% [markdown] slideshow={"slide_type": "subslide"} answers="04-bias"
# ### The second-order term
#
# How large is the part that (04.1) neglects? The next term of the Taylor series contains the second
# derivatives. Only the heading enters our model nonlinearly, and differentiating $d \cos\theta$
# and $d \sin\theta$ twice by $\theta$ gives $-d\cos\theta$ and $-d\sin\theta$. So the position has
# the second-order term
#
# $\displaystyle -\tfrac12\, d\, \tilde\theta^2 \begin{bmatrix} \cos\hat\theta \\ \sin\hat\theta \end{bmatrix},
# \qquad \text{on average} \qquad
# -\tfrac12\, d\, \sigma_\theta^2 \begin{bmatrix} \cos\hat\theta \\ \sin\hat\theta \end{bmatrix}.$
#
# This term points back along the path for both signs of the heading error. Therefore its mean is not zero: the
# EKF's prediction has a **bias**.

# %% [markdown] slideshow={"slide_type": "subslide"} answers="04-bias"
# **Your turn.** Compute the length of the average second-order term for 3 m and
# $\sigma_\theta$ = 0.6 rad.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"] answers="04-bias"
second_order = ...  # [m]
compare(second_order, np.trace(np.diag([0, 0, 3.0]) @ np.diag([0.05, 0.05, 0.6]) ** 2) / 2)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="04-bias"
# <details><summary>Answer</summary>
#
# ```python
# second_order = 0.5 * 3.0 * 0.6**2
# ```
#
# In general the average second-order term of a component is half the trace of its matrix of second
# derivatives times $P$.
#
# </details>

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="04-bias"
print("σ of θ   inside   mean is short of f(x̂) by   second order   ellipse along the path")
for heading_sigma in (0.1, 0.3, 0.6):
    ends_then, b = propagate(heading_sigma, 3.0)
    short = (b.x - ends_then.mean(axis=0))[:2] @ along
    semi_axis = 2.45 * np.sqrt(along @ b.P[:2, :2] @ along)  # 95 %
    inside = f"{100 * share_in_ellipse(b, ends_then):5.0f} %"
    print(f"{heading_sigma} rad {inside} {short:18.2f} m", end="")
    print(f"{0.5 * 3.0 * heading_sigma**2:18.2f} m {semi_axis:16.2f} m")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="04-bias"
# At 0.6 rad the robots end on average {= short:.2f =} m short of the estimate, while the 95 %
# ellipse reaches only {= semi_axis:.2f =} m along the path. The second-order term is close to the simulated
# bias. Equation (04.3) does not contain this bias, because $A$ contains first derivatives only.
#
# **A linearisation is good if the second-order term is small compared with the ellipse** in the same direction.
# An EKF therefore needs a heading with a small variance. Particles (lesson 11) need no
# linearisation. The *unscented transform* (below, for reading at home) uses the model itself in place of
# its Jacobian.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let the students find the σ at which they would no longer trust the ellipse. Then ask
# whether a longer distance or a larger σ of the heading increases the bias more. (The bias is proportional
# to the distance and to the square of σ.)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## The motion model and its Jacobian A
#
# A matrix of numbers is valid at one pose only. A filter needs $A$ at every step, so we derive it once,
# in symbols.
#
# Odometry provides a *control input* $u = (d, \Delta\theta)$: the robot drove the distance $d$ along its old
# heading and then turned by $\Delta\theta$. The motion model below describes this motion. (In $f(x, u)$ the
# letter $x$ is the whole pose; inside the brackets $x$ is the first coordinate, as in most books. Lesson 12
# replaces the straight line by an arc.)
#
# $$f(x, u) = \begin{bmatrix} x + d\cos\theta \\ y + d\sin\theta \\ \theta + \Delta\theta
# \end{bmatrix} \tag{04.4}$$

# %% [markdown] slideshow={"slide_type": "notes"} name="note-the-motion-model-and-its-jacobian-a"
# *For the lecturer:* Ask for the third column before it appears: the step, rotated by 90°. The *Try* with the
# minus sign removed is worth showing, because the computer rejects a wrong line.

# %% slideshow={"slide_type": "fragment"}
from slamlab.models.symbolic import beta, d, dtheta, p_x, p_y, r, theta, x, y

pose, control, landmark, measurement = [x, y, theta], [d, dtheta], [p_x, p_y], [r, beta]
dx, dy = sp.symbols("Δx Δy", real=True)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
f = sp.Matrix([x + d * sp.cos(theta), y + d * sp.sin(theta), theta + dtheta])  # the model
A_steps = (
    derive("A", partials(f, pose), "by definition (04.2)")
    .step("by x and by y", differentiate(x, y))
    .step("by θ", differentiate(theta))
)
A = A_steps.result
with_step = sp.Matrix([[1, 0, -dy], [0, 1, dx], [0, 0, 1]])
A_steps.step("with the step's own Δx and Δy", with_step, given={dx: f[0] - x, dy: f[1] - y})

# %% [markdown] slideshow={"slide_type": "fragment"}
# New parts of a line are blue and underlined, and new fractions are in a box. The computer has compared each
# line with the line before.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The entries of A
#
# $$A = \begin{bmatrix} 1 & 0 & -\Delta y \\ 0 & 1 & \Delta x \\ 0 & 0 & 1 \end{bmatrix} \tag{04.5}$$
#
# Here $(\Delta x, \Delta y)$ is the step of the robot in world coordinates, and $(-\Delta y, \Delta x)$ is this
# step rotated by 90°, the direction of the streak across the path. The result is also clear without calculus: a
# small heading error rotates the whole step about its start, so the end of the step moves at right angles to
# the step.
#
# **Try** a robot that turns *before* it drives: write $\theta + \Delta\theta$ in the cosine and the sine. The
# computer still accepts all lines, and (04.5) still holds. Then remove the minus sign before `dy`: the computer
# rejects this line, and shows a point at which the two lines differ.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## Control noise: W and Q
#
# Real wheels slip, so the control input has an error $\tilde u$ as well, with a covariance $C$. The Jacobian of
# $f$ with respect to $u$, which we call $W$, propagates this error:
#
# $$\tilde x \leftarrow A\,\tilde x + W \tilde u, \qquad W = \frac{\partial f}{\partial u} \tag{04.6}$$
#
# The error of the pose comes from earlier steps, so we assume that it is uncorrelated with the error
# of this step. Then, as in lesson 03, the covariances add:
#
# $$P \leftarrow A P A^{\mathsf T} + Q, \qquad Q = W C W^{\mathsf T} \tag{04.7}$$

# %% [markdown] slideshow={"slide_type": "notes"} name="note-control-noise-w-and-q"
# *For the lecturer:* The usual mistake is to put standard deviations into $C$. Let the class state the unit
# of every entry of $W C W^{\mathsf T}$.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
C, W_here = noise.C_odometry(u, 0.1, 0.1), jacobians.W_odometry(x_hat, u)  # for our robot
W = f.jacobian(control)
W

# %% [markdown] slideshow={"slide_type": "fragment"}
# The first column describes an error of the distance and points **along** the heading. The second column
# describes an error of the turn, which changes only the heading, because the robot turns at the end of the
# step.
#
# A check of the units reveals many mistakes. $C$ contains the *variances* of $d$ and of $\Delta\theta$, in
# m² and rad². $W$ maps the errors to the pose, so the process noise $Q$ has m² in its upper left block and rad²
# in its lower right corner.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** Equation (04.7) is the prediction of the EKF. The distance and the turn each have a standard
# deviation of 10 % of their value. `C` contains their variances. The predicted pose is $f(\hat x, u)$, as
# before. Compute the covariance of the predicted pose.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
P_predicted = ...  # from A_here, P, W_here and C
compare(P_predicted, predict(Belief(x_hat, P), end, A_here, noise.Q(W_here, C)).P)

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# P_predicted = A_here @ P @ A_here.T + W_here @ C @ W_here.T
# ```
#
# </details>


# %% slideshow={"slide_type": "subslide"} tags=["folded"]
def with_control_noise(distance_error, heading_sigma):
    """1000 end poses with control noise, and the covariance with Q and without it."""
    P, C = np.diag([0.05, 0.05, heading_sigma]) ** 2, noise.C_odometry(u, distance_error, 0.1)
    ends = error_propagation.sample_end_poses(x_hat, P, u, C, np.random.default_rng(4))
    without = A_here @ P @ A_here.T
    ellipses = {"A P Aᵀ + Q, 95 %": without + noise.Q(jacobians.W_odometry(x_hat, u), C)}
    ellipses |= {"A P Aᵀ, 95 %": without}
    inside = share_in_ellipse(Belief(end, ellipses["A P Aᵀ + Q, 95 %"]), ends)
    title = f"{100 * inside:.0f} % inside the solid ellipse"
    return views.cloud(ends, ellipses, title, (8, 5), [path], centre=end)[0]


views.explore(
    with_control_noise,
    lambda distance_error, heading_sigma: (
        f"End points with σ of the distance {100 * distance_error:.0f} % and σ of the heading "
        f"{heading_sigma:.2f} rad. The first widens the distribution along the path, the second "
        "across the path; the solid ellipse includes both, the dashed ellipse only the second."
    ),
    distance_error=(0.0, 0.2, 0.1),
    heading_sigma=(0.0, 0.2, 0.1),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# With a distance error of 10 %, the distribution is nearly round. The heading error, propagated by $A$, widens
# it across the path, and the control noise, propagated by $W$, widens it along the path. The dashed ellipse
# neglects the control noise. Set one slider to zero to see the effect of the other error alone.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=9
# ## Part two: the measurement model and its Jacobian H
#
# This is a good place for a break. So far the robot has only moved; now it also measures. A landmark stands at
# $p = (p_x, p_y)$, and the sensor measures its range $r$ and its bearing $\beta$. The theorem of Pythagoras gives the range. The bearing is the direction of the landmark in the world frame, minus the heading of the robot. Both equations together form the **measurement model** (also **observation model**):
#
# $$h(x, p) = \begin{bmatrix} \sqrt{(p_x - x)^2 + (p_y - y)^2} \\
# \operatorname{atan2}(p_y - y,\ p_x - x) - \theta \end{bmatrix} \tag{04.8}$$
#
# The filter of lesson 03 needs a matrix $H$ that maps a small error of the state to the measurement.
# Again this matrix is the Jacobian.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask what atan2 can distinguish that the arctangent of the quotient cannot. Then
# demonstrate the next derivation: look at a student, step to your left, and ask the class in which direction
# this student has moved in your field of view.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The derivative of atan2
#
# Write $\delta_x = p_x - x$ and $\delta_y = p_y - y$ for the vector from the robot to the landmark,
# $r$ for its length, and $\varphi = \operatorname{atan2}(\delta_y, \delta_x)$ for its direction. The numbers $r$ and $\varphi$ are polar coordinates: $\delta_x = r\cos\varphi$ and $\delta_y = r\sin\varphi$. We differentiate both equations:
#
# $\displaystyle \mathrm d\delta_x = \cos\varphi\, \mathrm dr - r\sin\varphi\, \mathrm d\varphi, \qquad
# \mathrm d\delta_y = \sin\varphi\, \mathrm dr + r\cos\varphi\, \mathrm d\varphi$
#
# We multiply the first equation by $-\sin\varphi$, the second by $\cos\varphi$, and add both, so that
# $\mathrm dr$ cancels:
#
# $\displaystyle r\, \mathrm d\varphi = \cos\varphi\, \mathrm d\delta_y - \sin\varphi\, \mathrm d\delta_x
# \quad\Rightarrow\quad \mathrm d\varphi = \frac{\delta_x\, \mathrm d\delta_y - \delta_y\, \mathrm
# d\delta_x}{r^2}$
#
# So only motion across the line of sight changes the direction, and the change is smaller at a larger distance.


# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
to_x, to_y = sp.symbols("delta_x delta_y", real=True)
root = sp.sqrt(to_x**2 + to_y**2)
G_steps = (
    derive("G", partials(sp.Matrix([root, sp.atan2(to_y, to_x)]), [to_x, to_y]), "by definition")
    .step("by δx: the rule for the root, and the derivative above", differentiate(to_x))
    .step("by δy", differentiate(to_y))
    .step("the root is r", lambda line: line.subs(to_x**2 + to_y**2, r**2), given={r: root})
)
G_steps

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The chain rule
#
# $G$ contains the derivatives with respect to the vector $(\delta_x, \delta_y)$. If the robot moves
# slightly in $x$, then $\delta_x$ *decreases* by the same amount, and likewise in $y$:
# $\partial\delta_x/\partial x = \partial\delta_y/\partial y = -1$. A turn of the robot does not change the vector, but the bearing decreases by the angle of the turn.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
vector_by_pose = sp.Matrix([[-1, 0, 0], [0, -1, 0]])
turn_of_bearing = sp.Matrix([[0, 0, 0], [0, 0, -1]])
derive("H_r", G_steps.result * vector_by_pose + turn_of_bearing, "G by the chain rule")

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The entries of the Jacobian H
#
# $$H_{\mathrm r} = \frac{\partial h}{\partial x} = \begin{bmatrix}
# -\dfrac{p_x - x}{r} & -\dfrac{p_y - y}{r} & 0 \\[2ex]
# \dfrac{p_y - y}{r^2} & -\dfrac{p_x - x}{r^2} & -1 \end{bmatrix} \tag{04.9}$$
#
# The roman subscript r means the robot. The row of the range is the unit vector from the landmark
# to the robot: a step in this direction changes the range by the length of the step, and a turn does not change
# the range. In the row of the bearing, the $-1$ shows that all bearings decrease when the robot
# turns left.

# %% slideshow={"slide_type": "fragment"}
ask(
    "04-far",
    "Another landmark stands in the same direction, twice as far away. How do the first two "
    "columns of (04.9) change?",
    {
        "both rows become half as large": "the row of the range is a unit vector: numerator and r "
        "double together.",
        "only the row of the bearing becomes half as large": "its numerators double, its r² "
        "becomes four times as large.",
        "both stay the same": "if you walk past a distant tower and a near lamp post, the bearing of "
        "the lamp post changes faster.",
    },
    right="only the row of the bearing becomes half as large",
)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="04-far"
here = np.zeros(3)
for p in ([2.0, 1.0], [4.0, 2.0]):
    print(f"landmark at {p}:", jacobians.H_robot(here, p).round(3).tolist())

# %% [markdown] slideshow={"slide_type": "fragment"} answers="04-far"
# The units explain this difference. The row of the range has no unit (metres per metre). The row of the bearing
# has the unit radians per metre, so its denominator contains a second factor $r$. Compare a distant and a near
# landmark that
# are measured with the same σ. The distant landmark's **bearing** constrains the position more weakly,
# but the heading equally strongly. Its **range** constrains the position along the line of sight equally strongly.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** Another sensor measures the *square* of the range,
# $h_2 = (p_x - x)^2 + (p_y - y)^2$. Write the Jacobian of $h_2$ with respect to the pose, one row of three partial derivatives.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
H_2 = ...  # sp.Matrix([[by x, by y, by θ]])
compare(H_2, sp.Matrix([(p_x - x) ** 2 + (p_y - y) ** 2]).jacobian(pose))

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# H_2 = sp.Matrix([[-2 * (p_x - x), -2 * (p_y - y), 0]])
# ```
#
# This row is the first row of (04.9) times $2r$. By the chain rule, the derivative of $r^2$ is $2r$ times the
# derivative of $r$.
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## What measurements cannot determine: observability
#
# In SLAM the position of the landmark is unknown, too, so $H$ also has columns for the landmark. We need not
# differentiate again. Equation (04.8) contains only the *differences* of $p$ and $(x, y)$, so the columns of
# the landmark are the negatives of the first two columns of the robot:
#
# $$H_{\mathrm p} = \frac{\partial h}{\partial p} = \begin{bmatrix}
# \dfrac{p_x - x}{r} & \dfrac{p_y - y}{r} \\[2ex]
# -\dfrac{p_y - y}{r^2} & \dfrac{p_x - x}{r^2} \end{bmatrix} \tag{04.10}$$

# %% [markdown] slideshow={"slide_type": "notes"} name="note-what-measurements-cannot-determine-obser"
# *For the lecturer:* Students expect that enough measurements of one landmark finally determine the pose.
# Point at the rank of "both, from two poses" in the printed table, and let a student walk round a chair while
# looking at it.

# %% slideshow={"slide_type": "fragment"}
ask(
    "04-hall",
    "Suppose that the whole hall, with the robot and all landmarks in it, is moved by 1 m to the "
    "north and turned by 10°. What does the robot measure after this motion? (Neglect the noise.)",
    {
        "all bearings have changed by 10°": "this would require that only the robot or only the "
        "landmarks turn. The heading of the robot has turned along with the landmarks.",
        "some ranges have changed by up to 1 m": "this would require that only the robot is "
        "shifted. The landmarks were shifted along with the robot.",
        "exactly what it measured before": "ranges and bearings depend on relative positions and "
        "headings only, and these are the same as before.",
    },
    right="exactly what it measured before",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="04-hall"
# A small shift moves the robot and the landmark alike. A small turn by $\delta$ about the origin moves a
# point $(x, y)$ by $\delta\,(-y, x)$ and adds $\delta$ to the heading. The measurements do not change
# under these motions, so $H$ must map both to zero:
#
# $$H_{\mathrm r}\begin{bmatrix} 1 & 0 & -y \\ 0 & 1 & x \\ 0 & 0 & 1 \end{bmatrix} + H_{\mathrm p}
# \begin{bmatrix} 1 & 0 & -p_y \\ 0 & 1 & p_x \end{bmatrix} = 0 \tag{04.11}$$

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="04-hall"
h = sp.Matrix([sp.sqrt((p_x - x) ** 2 + (p_y - y) ** 2), sp.atan2(p_y - y, p_x - x) - theta])
H_r, H_p = h.jacobian(pose), h.jacobian(landmark)
moved_robot = sp.Matrix([[1, 0, -y], [0, 1, x], [0, 0, 1]])  # columns: both shifts, the turn
moved_landmark = sp.Matrix([[1, 0, -p_y], [0, 1, p_x]])
sp.simplify(H_r * moved_robot + H_p * moved_landmark)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="04-hall"
# So from such measurements, SLAM can determine a map only **up to a translation and a rotation**. We choose the
# origin and the direction of the $x$ axis; the usual choice is the first pose of the robot.
#
# A change of the state is **unobservable** if it does not change any measurement. We stack the matrices $H$ of
# all measurements. For small changes, the unobservable directions are the directions that the stacked matrix
# maps to zero. Its rank is the number of the other directions. (An EKF computes each $H$ at another estimate.
# So its $P$ may shrink in an unobservable direction, although the measurements contain no information about
# this direction; lesson 06 shows this inconsistency.)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="04-hall"
# ### One landmark, two, and a robot that moves
#
# Now the map is known and only the pose (three numbers) is unknown. Which components of the pose do the
# measurements determine?
# After a motion with the Jacobian $A$, the measurement's Jacobian with respect to the *first* pose is
# $H A$. All rows together form the *observability matrix*.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="04-hall"
rank, first, second = np.linalg.matrix_rank, np.array([2.0, 1.0]), np.array([0.5, 3.0])
H_first, H_second = jacobians.H_robot(here, first), jacobians.H_robot(here, second)
ahead = np.array([1.0, 0.0])  # 1 m ahead, no turn
H_later = jacobians.H_robot(models.f_odometry(here, ahead), first)
HA_later = H_later @ jacobians.A_odometry(here, ahead)
print("bearing of one landmark:            rank", rank(H_first[1:]))
print("range and bearing of one landmark:  rank", rank(H_first))
print("both, from two poses:               rank", rank(np.vstack([H_first, HA_later])))
print("its bearing from two poses:         rank", rank(np.vstack([H_first[1:], HA_later[1:]])))
print("range and bearing of two landmarks: rank", rank(np.vstack([H_first, H_second])))

# %% [markdown] slideshow={"slide_type": "fragment"} answers="04-hall"
# The range and bearing of one landmark do not determine the pose, however often the robot moves and
# measures: the rank stays 2. A single bearing gives rank 1; a second bearing from another pose also determines
# the distance, so the rank is 2. Two landmarks determine all three numbers of the pose.

# %% [markdown] slideshow={"slide_type": "subslide"} answers="04-hall"
# **Your turn.** With one landmark at $p$ = (2, 1), one direction remains unobservable: a motion of the robot on
# a circle about the landmark, with an equal turn. The robot stands at the origin. Compute the
# derivatives of $x$, $y$ and $\theta$ with respect to the angle of this turn.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"] answers="04-hall"
circle = ...  # np.array([of x, of y, 1.0])
kernel = null_space(H_first)[:, 0]  # the direction that H maps to zero
compare(circle, kernel / kernel[2])

# %% [markdown] slideshow={"slide_type": "fragment"} answers="04-hall"
# <details><summary>Answer</summary>
#
# ```python
# circle = np.array([1.0, -2.0, 1.0])
# kernel = null_space(H_first)[:, 0]
# ```
#
# A turn about $p$ moves the robot by $(-(y - p_y),\ x - p_x)$, as it moves every point.
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## The innovation and the wrapping of angles
#
# The filter corrects the estimate by the *innovation* $v = z - h(\hat x, p)$, measured minus
# predicted. The second component is an angle, and angles repeat after a full turn.

# %% slideshow={"slide_type": "fragment"}
ask(
    "04-wrap",
    "A landmark is nearly behind the robot. The predicted bearing is 179°, the measured one "
    "−179°. What innovation should the filter get?",
    right=2,
    tolerance=0.5,
    unit="degrees",
    reason="−179° is the same direction as 181°, and 181° − 179° = 2°.",
    wrong={
        -358: "this is the plain difference. It is nearly a full turn, and the filter would correct "
        "the heading by nearly as much.",
        358: "measured minus predicted has the other sign, and 358° is the same direction as −2°.",
        -2: "this has the wrong sign: the measured bearing lies farther to the left.",
    },
)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="04-wrap"
predicted, measured = np.array([3.0, np.radians(179)]), np.array([3.0, np.radians(-179)])
H_behind = jacobians.H_robot(here, models.g(here, predicted))
P_start, R = np.diag([0.1, 0.1, 0.1]) ** 2, noise.R(3.0, range_error=0.01, bearing_sigma=0.02)
K = P_start @ H_behind.T @ np.linalg.inv(H_behind @ P_start @ H_behind.T + R)
v = measured - predicted
for name, bearing in {"difference": v[1], "wrapped": wrap(v[1])}.items():
    correction = K @ [v[0], bearing]
    print(f"{name:10}: heading {np.degrees(correction[2]):6.1f}°, y {correction[1]:6.2f} m")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="04-wrap"
# The plain difference changes the estimated heading by almost a full turn; the wrapped difference changes it by
# {= abs(np.degrees(correction[2])):.1f =}°. So we *wrap* the innovation of the bearing,
#
# $$v_\beta = \operatorname{wrap}(z_\beta - h_\beta(\hat x, p)) \in (-\pi, \pi]. \tag{04.12}$$
#
# (Another method compares unit vectors.) The Jacobian does not show that wrapping is needed: derivatives are
# local and do not depend on the jump. All angles are in **radians**, because only in radians the derivative of
# the sine is the cosine.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* This fault appears only when a landmark passes behind the robot; tests with all landmarks
# in front of the robot do not find it. Ask which students have had such a bug with a compass or a clock.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## The extended Kalman filter
#
# We now have all parts of the filter. We linearise the measurement model at the predicted pose. With the
# measurement noise $\varepsilon$ the innovation is
#
# $\displaystyle v = z - h(\hat x, p) \approx H_{\mathrm r}\,\tilde x + \varepsilon.$
#
# This is the linear measurement of lesson 03, with the Jacobian in place of the matrix $H$. So the gain and the
# update are the same. The EKF differs from the Kalman filter in three respects. The nonlinear models $f$ and
# $h$ predict the pose and the measurement. The filter computes the matrices again at every step. All results
# hold only to first order: $P$ approximates the covariance of the error, and $K$ is no longer exactly the best
# linear gain.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-the-extended-kalman-filter"
# *For the lecturer:* Ask which lines of the box differ from the box of lesson 03. The true end lies outside
# the last ellipse; ask how often this may happen before you show the answer.

# %% [markdown] slideshow={"slide_type": "subslide"}
# > **Algorithm: extended Kalman filter (EKF)** (Smith, Schmidt and McGee 1962; *Probabilistic
# > Robotics*, table 3.3, there with $(I - K H) P$ in step 7)
# >
# > **Input:** estimate $\hat x$ and covariance $P$; control input $u$ with covariance $C$;
# > measurement $z$ with covariance $R$; models $f$, $h$
# >
# > 1. Jacobians of the motion: $A = \partial f/\partial x$, $W = \partial f/\partial u$ at
# >    $(\hat x, u)$
# > 2. Predict: $\hat x \leftarrow f(\hat x, u)$, $\quad P \leftarrow A P A^{\mathsf T} + W C
# >    W^{\mathsf T}$
# > 3. Jacobian of the measurement: $H = \partial h/\partial x$ at the predicted $\hat x$
# > 4. Innovation: $v = z - h(\hat x)$, with angles wrapped
# > 5. Innovation covariance: $S = H P H^{\mathsf T} + R$
# > 6. Kalman gain: $K = P H^{\mathsf T} S^{-1}$
# > 7. Update: $\hat x \leftarrow \hat x + K v$, $\quad P \leftarrow (I - K H)\,P\,(I - K
# >    H)^{\mathsf T} + K R K^{\mathsf T}$
# >
# > **Output:** $\hat x$, $P$

# %% slideshow={"slide_type": "subslide"} tags=["code"]
motion_noise, R_step = (0.1, 0.1), noise.R(3.0, range_error=0.02, bearing_sigma=0.02)
known_map = error_propagation.LANDMARKS


def ekf_step(b, u, z, p):
    """One step of the EKF: belief b, control input u, measurement z of the known landmark p."""
    A, W = jacobians.A_odometry(b.x, u), jacobians.W_odometry(b.x, u)
    C = noise.C_odometry(u, *motion_noise)
    x_hat, P = models.f_odometry(b.x, u), A @ b.P @ A.T + W @ C @ W.T  # predict
    H, v = jacobians.H_robot(x_hat, p), z - models.h(x_hat, p)
    v[1] = wrap(v[1])
    after, _ = correct(Belief(x_hat, P), v, H, R_step)  # gain and update of lesson 03
    return after


# %% [markdown] slideshow={"slide_type": "subslide"}
# ### A run
#
# A robot drives 24 steps on a circle. At each step it measures one of three known landmarks, in turn, and it
# knows which landmark it measures. For simplicity, the noise has the covariance `R_step` at any range. For
# comparison we also compute the pose by odometry alone.

# %% slideshow={"slide_type": "fragment"}
# simulate the run: in each step drive, measure one landmark, and call ekf_step
rng, step = np.random.default_rng(4), np.array([0.4, 2 * np.pi / 24])
truth, b = [np.array([1.0, 0.5, 0.0])], Belief(np.array([1.0, 0.5, 0.0]), 0.01**2 * np.eye(3))
odometry, beliefs = [truth[0]], [b]
for k in range(24):
    driven = rng.multivariate_normal(step, noise.C_odometry(step, *motion_noise))
    truth.append(models.f_odometry(truth[-1], driven))
    p = known_map[k % 3]
    z = models.h(truth[-1], p) + rng.multivariate_normal([0, 0], R_step)
    beliefs.append(ekf_step(beliefs[-1], step, z, p))
    odometry.append(models.f_odometry(odometry[-1], step))
P_last, H_last = beliefs[-1].P, jacobians.H_robot(beliefs[-1].x, known_map[1])

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
fig, ax = views.axes(size=(8, 5))
estimate = np.array([b.x for b in beliefs])
for layer in (
    Points("landmark", known_map),
    Poses("truth", truth),
    Poses("naive", odometry),
    Poses("corrected", estimate),
    Ellipses("robot", estimate[::4, :2], np.array([b.P[:2, :2] for b in beliefs[::4]])),
):
    views.draw(ax, layer)
views.legend_below(fig)
off = {n: np.hypot(*(np.array(p) - truth)[-1, :2]) for n, p in (("o", odometry), ("e", estimate))}
views.show(
    fig,
    f"A circle. Odometry ends {100 * off['o']:.0f} cm from the true end, the EKF {100 * off['e']:.0f} "
    "cm; its confidence ellipses lie along the path.",
)
error_xy, sigma_xy = (truth[-1] - estimate[-1])[:2], np.sqrt(np.trace(P_last[:2, :2]))

# %% [markdown] slideshow={"slide_type": "fragment"}
# In this run odometry alone ends {= 100 * off["o"]:.0f =} cm from the true position, the EKF
# {= 100 * off["e"]:.0f =} cm. The ellipses of the EKF stay small, because each step corrects the estimate. At the
# end $\sqrt{\operatorname{trace} P_{xy}}$ is {= 100 * sigma_xy:.0f =} cm ($P_{xy}$ is the block of $x$ and
# $y$). The true end lies outside the last 95 % ellipse: its $d^2$ (03.9) is
# {= nees(error_xy[None], P_last[None, :2, :2])[0]:.1f =}, and the limit is 5.99. Even in a consistent filter,
# about one pose in twenty lies outside its ellipse. A test of $P$ requires many runs (lesson 03).

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** The robot at the last estimate measures the second landmark. Compute the innovation
# covariance `S` of this measurement (step 5 of the box).

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
S = ...  # from H_last, P_last and R_step
compare(S, correct(beliefs[-1], np.zeros(2), H_last, R_step)[1].S)

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# S = H_last @ P_last @ H_last.T + R_step
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## A new landmark: the inverse measurement model
#
# When a landmark is measured for the first time, the filter computes its position from the pose and
# the measurement. The solution of $z = h(x, p)$ for $p$ is the **inverse measurement model**:
#
# $$p = g(x, z) = \begin{bmatrix} x + r\cos(\theta + \beta) \\ y + r\sin(\theta + \beta)
# \end{bmatrix} \tag{04.13}$$
#
# The result has an error because the pose and the measurement have errors. So covariance propagation needs two
# Jacobians, with respect to the pose and to the measurement.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-a-new-landmark-the-inverse-measurement-m"
# *For the lecturer:* Hold a pointer in front of you. Shift it, then turn with it: its tip shows the columns
# of $J_{\mathrm r}$. If time is short, show (04.14) and skip both derivations.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
g = sp.Matrix([x + r * sp.cos(theta + beta), y + r * sp.sin(theta + beta)])  # the model
(
    derive("J_r", partials(g, pose), "by definition: ∂g by the pose")
    .step("by x and by y: the landmark moves with the robot", differentiate(x, y))
    .step("by θ: the landmark moves on a circle about the robot", differentiate(theta))
)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
(
    derive("J_z", partials(g, measurement), "by definition: ∂g by range and bearing")
    .step("by r: along the line of sight", differentiate(r))
    .step("by β: across the line of sight, in proportion to the range", differentiate(beta))
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The entries of both Jacobians
#
# With $\varphi = \theta + \beta$, the direction of the landmark in the world frame, the results are
#
# $$J_{\mathrm r} = \begin{bmatrix} 1 & 0 & -r\sin\varphi \\ 0 & 1 & r\cos\varphi \end{bmatrix},
# \qquad J_z = \begin{bmatrix} \cos\varphi & -r\sin\varphi \\ \sin\varphi & r\cos\varphi
# \end{bmatrix}. \tag{04.14}$$
#
# Imagine a stick of length $r$ that is fixed to the robot; the landmark is the end of this stick. If the robot
# is shifted, the end moves by the same vector. If the robot turns, the end moves sideways, as the end of the
# step does in (04.5).

# %% [markdown] slideshow={"slide_type": "fragment"}
# How large is the measurement noise? The diagonal of a covariance contains the *squares* of standard
# deviations. The library models three independent errors of the range. The first is a share $c_1$ of the range,
# the second is a constant $\sigma_0$, and the third grows with the square of the range, as for triangulation.
# Lesson 02 estimated such parameters of a sensor from data.
#
# $$R = \begin{bmatrix} (c_1\,r)^2 + \sigma_0^2 + (c_2\,r^2)^2 & 0 \\ 0 & \sigma_\beta^2
# \end{bmatrix} \tag{04.15}$$
#
# In this lesson $\sigma_0 = c_2 = 0$, so only the first part remains. The bearing has the same
# $\sigma_\beta$ at every range.

# %% slideshow={"slide_type": "subslide"}
ask(
    "04-stick",
    "The position of a robot has σ = 0.15 m in x and y, its heading 0.08 rad. It measures a landmark "
    "5 m away, with σ = 2 % of the range and 0.02 rad of the bearing. In which direction does the "
    "new landmark have the largest variance?",
    {
        "along the line of sight": "in this direction only the errors of the robot's position and "
        "of the range count: 0.15 m and 2 % of 5 m.",
        "across the line of sight": "5 m times 0.08 rad is 0.4 m, more than all other errors.",
        "in all directions alike": "the robot's position error is the same in all directions, but "
        "the heading error moves the landmark only sideways.",
    },
    right="across the line of sight",
)


# %% slideshow={"slide_type": "subslide"} answers="04-stick" tags=["folded"]
def new_landmarks(landmark_range, heading_sigma):
    """1000 positions of a landmark that was measured once, and the ellipse of (04.17)."""
    x_hat, z = np.array([0, 0, 0.4]), np.array([landmark_range, 0.8])
    P, R = np.diag([0.15, 0.15, heading_sigma]) ** 2, noise.R(landmark_range, 0.02, 0.02)
    marks = error_propagation.sample_landmarks(x_hat, P, z, R, np.random.default_rng(4))
    J_r, J_z = jacobians.J_xr(x_hat, z), jacobians.J_z(x_hat, z)
    P_nn, p = error_propagation.new_landmark(P, J_r, J_z, R), models.g(x_hat, z)
    line = Poses("the line of sight", [x_hat, [*p, 1.2]])
    inside = 100 * np.mean(nees(marks - p, P_nn) < chi2.ppf(0.95, 2))
    title = f"{inside:.0f} % of the positions are inside the ellipse"
    return views.cloud(marks, {"P_nn of (04.17), 95 %": P_nn}, title, (8, 5), [line], centre=p)[0]


views.explore(
    new_landmarks,
    lambda landmark_range, heading_sigma: (
        f"Positions of a landmark measured once at {landmark_range:.1f} m by robots with σ of the "
        f"heading {heading_sigma:.2f} rad, and their confidence ellipse. Its width across the line of "
        "sight grows with the range and with σ."
    ),
    landmark_range=(1.0, 10.0, 5.0),
    heading_sigma=(0.0, 0.3, 0.08),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="04-stick"
# The distribution is wide across the line of sight. At a range of 1 m it is nearly round, because the heading
# error moves a near landmark less. At 10 m, increase $\sigma$ of the heading: the positions again form an arc.
# The next section derives the ellipse.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## The cross-covariances of a new landmark
#
# Let $n$ be the new landmark. To first order its error consists of the error of the robot and of the
# measurement noise $\varepsilon$:
#
# $$\tilde p_n = J_{\mathrm r}\,\tilde x + J_z\,\varepsilon \tag{04.16}$$
#
# The map may contain older landmarks. Let $i$ be a landmark whose error is correlated with the error of the
# robot's pose, with the cross-covariance $P_{\mathrm ri}$.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-the-cross-covariances-of-a-new-landmark"
# *For the lecturer:* Zero is the most common answer. Ask how the estimates of *both* landmarks would change
# if we learned that the robot had stood 10 cm farther to the left.

# %% slideshow={"slide_type": "fragment"}
ask(
    "04-cross",
    "The new landmark n has just been initialised. What is the cross-covariance of its error and "
    "the error of landmark i, which the robot does not measure in this step?",
    {
        "zero: the two were never measured together": "a common measurement is not necessary. "
        "The error of i is correlated with the pose, and the position of n was computed from the "
        "pose.",
        "not zero": "the error of n contains the error of the pose, which is correlated with the "
        "error of i.",
        "unknown, until both are measured at once": "equation (04.16) is enough to compute it.",
    },
    right="not zero",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="04-cross"
# As in lesson 03, we multiply two errors and take the expected value. The noise of this measurement is
# uncorrelated with all earlier errors.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="04-cross"
x_error, p_i, eps = (sp.MatrixSymbol(n, k, 1) for n, k in [("x", 3), ("p_i", 2), ("eps", 2)])
P_rr, P_ii, R_ = symmetric("P_rr", 3), symmetric("P_ii", 2), symmetric("R", 2)
P_ri, J_r, J_z = (sp.MatrixSymbol(*n) for n in [("P_ri", 3, 2), ("J_r", 2, 3), ("J_z", 2, 2)])
known = {x_error * x_error.T: P_rr, x_error * p_i.T: P_ri, p_i * p_i.T: P_ii, eps * eps.T: R_}
J_m, J_n = (sp.MatrixSymbol(name, 2, 3) for name in ("J_m", "J_n"))  # of two more landmarks
E = expectation(known)
p_n = J_r * x_error + J_z * eps
print("P_nn =", E(p_n * p_n.T))
print("P_rn =", E(x_error * p_n.T))
print("P_ni =", E(p_n * p_i.T))

# %% [markdown] slideshow={"slide_type": "subslide"} answers="04-cross"
# $$\begin{aligned}
# P_{nn} &= J_{\mathrm r} P_{\mathrm{rr}} J_{\mathrm r}^{\mathsf T} + J_z R J_z^{\mathsf T} \\
# P_{\mathrm rn} &= P_{\mathrm{rr}} J_{\mathrm r}^{\mathsf T} \\
# P_{ni} &= J_{\mathrm r} P_{\mathrm ri} \end{aligned} \tag{04.17}$$
#
# A new landmark is correlated with the pose, and with every landmark that the pose is correlated
# with. If you set $P_{\mathrm rn}$ and $P_{ni}$ to zero, the filter ignores that the landmarks of its
# map share errors of the robot. Lesson 07 shows the consequences.

# %% [markdown] slideshow={"slide_type": "subslide"} answers="04-cross"
# **Your turn.** Two landmarks, $m$ and $n$, are both new and are measured from the same pose, with
# independent noise. Multiply $\tilde p_m = J_m \tilde x + \dots$ by $\tilde p_n^{\mathsf T}$: what is
# their cross-covariance?

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"] answers="04-cross"
P_mn = ...  # from J_m, P_rr and J_n
compare(P_mn, E(J_m * x_error * (J_n * x_error).T))

# %% [markdown] slideshow={"slide_type": "fragment"} answers="04-cross"
# <details><summary>Answer</summary>
#
# ```python
# P_mn = J_m * P_rr * J_n.T
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## How to test a Jacobian
#
# A derivation may contain a mistake, a program may contain a mistake, and finite differences depend on
# their step size. But all three are hardly ever wrong in the same way. So we compare three matrices at one
# typical pose: the derived matrix, the matrix that the code of `slamlab` computes, and the `numerical_jacobian`
# of the model itself.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-how-to-test-a-jacobian"
# *For the lecturer:* Before the last paragraph appears, ask what this test cannot find. (A wrong model: all
# three matrices come from it.)

# %% slideshow={"slide_type": "fragment"}
# each Jacobian three times: as derived, by the code, by finite differences
at = {x: 1.2, y: -0.7, theta: 0.9, p_x: -1.5, p_y: 2.2, d: 1.3, dtheta: 0.4, r: 3.1, beta: 1.1}
X, U, LANDMARK, Z = (np.array([at[one] for one in n]) for n in (pose, control, landmark, [r, beta]))
numeric = numerical_jacobian
three_ways = {
    "A": (A, jacobians.A_odometry(X, U), numeric(lambda x: models.f_odometry(x, U), X)),
    "W": (W, jacobians.W_odometry(X, U), numeric(lambda u: models.f_odometry(X, u), U)),
    "H_r": (H_r, jacobians.H_robot(X, LANDMARK), numeric(lambda x: models.h(x, LANDMARK), X)),
    "H_p": (H_p, jacobians.H_landmark(X, LANDMARK), numeric(lambda p: models.h(X, p), LANDMARK)),
    "J_r": (g.jacobian(pose), jacobians.J_xr(X, Z), numeric(lambda x: models.g(x, Z), X)),
    "J_z": (g.jacobian(measurement), jacobians.J_z(X, Z), numeric(lambda z: models.g(X, z), Z)),
}


# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
def compare_three(name, formula, code, differences, at=at):
    """Print the largest difference of a derivation from the code and from finite differences."""
    value = np.array(formula.subs(at).evalf(), dtype=float)
    off = [abs(value - other).max() for other in (code, differences)]
    print(f"{name:3}  derivation − code {off[0]:.6f}   derivation − differences {off[1]:.6f}")


for name, three in three_ways.items():
    compare_three(name, *three)

# %% [markdown] slideshow={"slide_type": "fragment"}
# All differences are zero. Such a test takes one line for each matrix, and finds every entry that is wrong at
# this pose. Test every Jacobian in this way.
#
# But all three matrices come from the same **model**. The test shows that the Jacobian belongs to the model; it
# does not show that the model is right. With `arctan` of the quotient in place of `atan2`, all three matrices
# would agree again, although this model predicts the same bearing for landmarks in opposite directions.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## The effect of one wrong sign
#
# Suppose that we had not tested the Jacobian. In the row of the bearing of $H_{\mathrm r}$, the minus sign
# before $(p_x - x)/r^2$ is missing. So the sign of one of six entries is wrong. A robot stands still and
# corrects its
# pose 20 times with three landmarks of a known map.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-the-effect-of-one-wrong-sign"
# *For the lecturer:* Most students expect that a filter with such a fault reports a large σ. Move the slider
# slowly from 1 to −1, and let the class say when the error begins to grow.

# %% slideshow={"slide_type": "fragment"}
ask(
    "04-sign",
    "What is the state of the filter after 20 measurements with one wrong sign in H?",
    {
        "its error stays large, and so does its σ": "σ comes from P, and P depends on its "
        "initial value, H and R only. P shrinks with every measurement, for any measured values.",
        "its error stays large, but its σ becomes small": "P shrinks with every measurement, as "
        "it would with a right H, while the corrections go in the wrong direction.",
        "its error becomes small, only more slowly": "some of the corrections go in the wrong "
        "direction, and more such corrections do not help.",
    },
    right="its error stays large, but its σ becomes small",
)


# %% slideshow={"slide_type": "subslide"} answers="04-sign" tags=["folded"]
def wrong_entry(factor, landmarks):
    """Errors of 100 robots whose ∂β/∂y is multiplied by a factor, and their estimated σ."""
    (right, _), (wrong, claimed) = (
        error_propagation.localisation_errors(k, landmarks) for k in (1, factor)
    )
    steps = np.arange(1, 21)
    title = f"The entry ∂β/∂y of H, multiplied by {factor:.2f}".replace("-", "−")
    fig, ax = views.chart("number of measurements", "error, √(trace P_xy) [m]", title, (8, 4.4))
    lines = {
        "median position error, right H": (right, "corrected", "-"),
        "median position error, wrong H": (wrong, "naive", "--"),
    }
    lines |= {"√(trace P_xy) with the wrong H": (claimed, "limit", "-.")}
    for name, (values, colour, dash) in lines.items():
        ax.plot(steps, values, dash, color=views.COLOURS[colour], label=name)
    ax.set(ylim=(0, None), xticks=[1, 5, 10, 15, 20])
    views.legend(ax)
    return fig


# %% slideshow={"slide_type": "fragment"} answers="04-sign" tags=["folded"]
def last(factor, landmarks):
    """Median error and √(trace P_xy) after the last measurement."""
    return [each[-1] for each in error_propagation.localisation_errors(factor, landmarks)]


views.explore(
    wrong_entry,
    lambda factor, landmarks: (
        f"Median errors fall to {last(1, landmarks)[0]:.2f} m with the right H; with one wrong entry "
        f"to {last(factor, landmarks)[0]:.2f} m, while P states {last(factor, landmarks)[1]:.2f} m."
    ),
    factor=(-1.0, 1.0, -1.0),
    landmarks=(1, 3, 3),
)
(right, _), (wrong, claimed), (half, _) = last(1, 3), last(-1, 3), last(0.5, 3)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="04-sign"
# With the wrong sign the median position error of 100 robots is {= 100 * wrong:.1f =} cm after 20 measurements;
# with the right $H$ it is {= 100 * right:.1f =} cm. The filter with the wrong sign reports
# $\sqrt{\operatorname{trace} P_{xy}}$ = {= 100 * claimed:.1f =} cm. This filter is *overconfident*: it computes $P$ as if its $H$ were right, and no innovation enters the formulas for $P$ (lesson 03).
#
# Move the slider of the factor. With the factor 0.5, the error is {= 100 * half:.1f =} cm, nearly the same as
# with the right entry, because each measurement corrects a part of the remaining error. In this experiment a
# wrong *size*
# does little harm, but a wrong *sign* makes the filter correct in the wrong direction. The reported $\sigma$
# shows neither of the two faults. So test your Jacobians before the filter runs. While the filter runs, the NIS
# test of lesson 03 can find such a fault: with the wrong sign the innovations are much larger than $S$ allows.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Literature
#
# - C. G. J. Jacobi, "De determinantibus functionalibus", *Journal für die reine und angewandte
#   Mathematik* 22, 1841: the origin of the name "Jacobian".
# - G. L. Smith, S. F. Schmidt and L. A. McGee, *Application of statistical filter theory to the optimal
#   estimation of position and velocity on board a circumlunar vehicle*, NASA TR R-135, 1962:
#   linearisation in the Kalman filter, for the flight to the Moon.
# - R. Smith, M. Self and P. Cheeseman, "Estimating uncertain spatial relationships in robotics", in
#   *Autonomous Robot Vehicles*, Springer, 1990: the blocks of a new landmark.
# - S. J. Julier and J. K. Uhlmann, "Unscented filtering and nonlinear estimation", *Proceedings of the
#   IEEE* 92(3), 2004: sigma points instead of Jacobians.
# - B. M. Bell and F. W. Cathey, "The iterated Kalman filter update as a Gauss–Newton method", *IEEE
#   Transactions on Automatic Control* 38(2), 1993.
#
# **Read next:** S. Thrun, W. Burgard and D. Fox, *Probabilistic Robotics*, MIT Press, 2005, chapters 3,
# 5 and 6.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-literature"
# *For the lecturer:* The filter was extended for the flight to the Moon. Ask what Schmidt changed: he
# linearised at the current estimate and not along a planned path.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## What you can do now
#
# You can derive a Jacobian, explain its entries with units and figures, test it in three ways, run an EKF, and
# state when its linearisation fails: if the errors are large.
#
# **What comes next:** [lesson 05](05_localisation_and_mapping.ipynb) uses $A$ and $H$ in two filters. The first
# filter estimates the pose in a known map, and the second estimates the landmarks from known poses.
#
# The sections below this one are optional. [In print](in_print.ipynb) collects the mistakes in
# published derivations of these Jacobians.
#
# **Exercise:**
# [04 · Motion and measurement models, Jacobians and the EKF](../exercises/ex04_models_and_jacobians.ipynb). You
# write $H$ and the Jacobians of a new landmark, derive the prediction of a robot with two wheels and the
# Jacobian of a camera, and improve on the linearisation where it fails.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-what-you-can-do-now"
# *For the lecturer:* Close with a question: which three matrices does the test compare, and which fault does
# it miss?

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: a robot that steers
#
# The robot of the MAK thesis is a car. Its control input is a speed $V$ and a steering angle
# $\gamma$; its wheelbase (the distance between the axles) is $B$, and a step lasts the time $T$:
#
# $$f(x, u) = \begin{bmatrix} x + T V \cos(\theta + \gamma) \\ y + T V \sin(\theta + \gamma) \\
# \theta + \tfrac{T V}{B} \sin\gamma \end{bmatrix} \tag{04.18}$$
#
# How does $A$ change?

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-a-robot-that-steers"
# *For the lecturer:* Ask first whether $A$ will change. The section suits a class that works with car-like
# vehicles.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
from slamlab.models.symbolic import B, T, V, gamma

X_ahead, Y_ahead = x + T * V * sp.cos(theta + gamma), y + T * V * sp.sin(theta + gamma)
f_steered = sp.Matrix([X_ahead, Y_ahead, theta + T * V / B * sp.sin(gamma)])
(
    derive("A", partials(f_steered, pose), "by definition")
    .step("differentiate", differentiate())
    .step("name the step", with_step, given={dx: X_ahead - x, dy: Y_ahead - y})
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# The matrix $A$ does not change: it is (04.5) again. In every motion model of this kind, an error of the
# heading rotates the step. Only $W$ differs, because the noise is now in $V$ and $\gamma$:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
W_steered = f_steered.jacobian([V, gamma])
W_steered

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
command, car = np.array([0.8, -0.3]), (0.5, 0.25)  # V and γ; B and T
there = at | dict(zip((V, gamma, B, T), (*command, *car), strict=True))
by_u = numerical_jacobian(lambda u: models.f_steered(X, u, *car), command)
compare_three("W", W_steered, jacobians.W_steered(X, command, *car), by_u, there)

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: the Jacobians of h and g
#
# The function $g$ computes the position of a landmark from a measurement, and $h$ predicts the same measurement
# from this position: $h(x, g(x, z)) = z$. We differentiate both sides with respect to $z$ and to $x$, by the
# chain rule:
#
# $$H_{\mathrm p} J_z = I, \qquad H_{\mathrm r} + H_{\mathrm p} J_{\mathrm r} = 0 \tag{04.19}$$

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-the-jacobians-of-h-and-g"
# *For the lecturer:* The two products can be computed on the board without a computer.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
initialised = {p_x: g[0], p_y: g[1]}
print(sp.simplify(H_p.subs(initialised) * g.jacobian(measurement)))
print(sp.simplify(H_r.subs(initialised) + H_p.subs(initialised) * g.jacobian(pose)))

# %% [markdown] slideshow={"slide_type": "fragment"}
# Equation (04.19) provides a fourth test, which needs no computer: if the Jacobians of one of the two functions
# are right, you can test the Jacobians of the other function by multiplication.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: the unscented transform
#
# Can we propagate a covariance without a Jacobian, and more accurately? As an example, a sonar measures the
# range precisely and the bearing poorly: $z$ = (5 m, 0.5 rad) with $\sigma$ = 0.1 m and 0.5 rad. What are the
# mean and the covariance of the landmark's position?
#
# The **unscented transform** chooses a few points with the same mean and covariance as the Gaussian,
# the **sigma points**. It maps these points through the model itself, and computes the weighted mean and
# covariance of the results. For $n$ dimensions and $P = L L^{\mathsf T}$ (Cholesky) there are $2n + 1$ points:
#
# $$\chi_0 = \hat z, \quad \chi_{\pm j} = \hat z \pm \sqrt{n + \kappa}\; L_j, \qquad
# w_0 = \frac{\kappa}{n + \kappa}, \quad w_{\pm j} = \frac{1}{2(n + \kappa)} \tag{04.20}$$
#
# $L_j$ is column $j$ of $L$. With $\kappa = 3 - n$, the points also have the fourth moment of a Gaussian along each axis.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-the-unscented-transform"
# *For the lecturer:* Ask how many samples a Monte Carlo method needs for this accuracy. The agreement holds
# for this bearing noise; with a larger σ the five points have an error, too.

# %% slideshow={"slide_type": "subslide"} tags=["code"]
z_hat, R_sonar = np.array([5.0, 0.5]), np.diag([0.1, 0.5]) ** 2
L = np.linalg.cholesky((2 + 1) * R_sonar)  # n = 2, κ = 1
sigma_points = z_hat + np.vstack([np.zeros(2), L.T, -L.T])
weights = np.array([1 / 3, *4 * [1 / 6]])
mapped = np.array([models.g(here, each) for each in sigma_points])
mean = weights @ mapped
P_unscented = (mapped - mean).T @ np.diag(weights) @ (mapped - mean)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
samples = models.g(here, np.random.default_rng(4).multivariate_normal(z_hat, R_sonar, 20_000))
J = jacobians.J_z(here, z_hat)
for name, m, cov in (
    ("20 000 samples", samples.mean(axis=0), np.cov(samples.T)),
    ("linearisation", models.g(here, z_hat), J @ R_sonar @ J.T),
    ("5 sigma points", mean, P_unscented),
):
    across, along_it = np.sqrt(np.linalg.eigvalsh(cov)[::-1])
    print(f"{name:14}  mean {m.round(2)} m,  σ {across:.2f} m across and {along_it:.2f} m along")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The exact mean lies in the direction $\hat\beta$ at the distance $\hat r\,\mathrm e^{-\sigma_\beta^2/2}$
# = {= 5 * np.exp(-(0.5**2) / 2):.2f =} m. The mean by linearisation is wrong by
# {= 5 * (1 - np.exp(-(0.5**2) / 2)):.2f =} m, and its ellipse is far too thin along the line of sight. The mean
# of the five sigma points is wrong by only
# {= 100 * np.hypot(*(mean - 5 * np.exp(-(0.5**2) / 2) * np.array([np.cos(0.5), np.sin(0.5)]))):.1f =} cm.
# The sigma points include the effect of the second-order term without any derivative. A Kalman filter whose
# prediction and update use this transform is called the **unscented Kalman filter** (**UKF**).

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
centre, linearised = models.g(here, z_hat), {"linearisation, 95 %": J @ R_sonar @ J.T}
fig, ax = views.cloud(samples[:800], linearised, None, (8, 5), centre=centre)
views.draw(ax, Ellipses("unscented, 95 %", [mean], [P_unscented]), color=views.COLOURS["naive"])
views.draw(ax, Points("truth", mapped), label="sigma points", markersize=10)
views.legend(ax)
views.show(
    fig,
    "An arc of samples. The linearised ellipse is thin and lies beyond the arc; the other covers "
    "most of it.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The linearised ellipse is thin and lies beyond the arc. The ellipse of the sigma points covers most of the
# arc, but also much empty space: no single Gaussian has the shape of an arc.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: the iterated EKF
#
# The EKF linearises $h$ at the *predicted* pose. If this pose has a large error, $H$ is inaccurate, too. After
# the update we have a better pose, so we can linearise again at this pose. With $x_0 = \hat x$ and the
# predicted $P$, the iteration is
#
# $$x_{i+1} = \hat x + K_i \left[ z - h(x_i) - H_i\, (\hat x - x_i) \right], \qquad
# K_i = P H_i^{\mathsf T} (H_i P H_i^{\mathsf T} + R)^{-1}. \tag{04.21}$$
#
# This is the **iterated EKF**. The first iteration is the EKF's update. All iterations are Gauss–Newton steps
# (lesson 13) towards the minimum of the cost
#
# $\displaystyle \chi^2(x) = (x - \hat x)^{\mathsf T} P^{-1} (x - \hat x) + (z - h(x))^{\mathsf T} R^{-1}
# (z - h(x)).$
#
# For Gaussian errors this minimum is the most probable pose (*maximum a posteriori*). The filter updates the
# covariance once, at the end, with the last $H_i$ and $K_i$.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-the-iterated-ekf"
# *For the lecturer:* Point at the second row: one more iteration does nearly all of the work. Ask why the
# covariance is updated only once.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
# five iterations of the update
prior, P_prior = np.zeros(3), np.diag([0.5, 0.5, 0.3]) ** 2
near, R_near = np.array([1.0, 0.3]), np.diag([0.02, 0.02]) ** 2
z = models.h(np.array([0.7, -0.7, 0.5]), near)  # from the true pose
i_x = prior
for i in range(5):
    H = jacobians.H_robot(i_x, near)
    K = P_prior @ H.T @ np.linalg.inv(H @ P_prior @ H.T + R_near)
    i_x = prior + K @ (z - models.h(i_x, near) - H @ (prior - i_x))
    miss = z - models.h(i_x, near)
    cost = i_x @ np.linalg.inv(P_prior) @ i_x + miss @ np.linalg.inv(R_near) @ miss
    print(f"iteration {i + 1}: cost {cost:8.2f}, range off by {100 * miss[0]:6.2f} cm")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The plain EKF stops after the first iteration: the range predicted from its pose differs from the measured
# range by about three times the measurement's σ of 2 cm. One more iteration nearly removes this difference. The
# iterated EKF helps where the measurement is much more accurate than the prediction. It does not help against a false measurement, and
# Gauss–Newton may also diverge.
