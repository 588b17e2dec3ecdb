# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 04 · Models and Jacobians
#
# **You will be able to** derive every Jacobian that EKF-SLAM needs, say in words what its entries
# mean, test one that you find in a book or in a program before you trust it, and say where even a
# right one fails.
#
# **60 minutes,** in two parts. **Before:** lesson [00](00_start_here.ipynb) for the symbols, lesson
# [03](03_kalman_filter.ipynb) for covariances and the update; partial derivatives.
#
# *Key:* a model says what happens. Its Jacobian says what happens to a small error.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Part one is about moving, part two about seeing; each can be a lecture of its
# own. Every line of a derivation comes at a key press, so ask the class for the next line before
# you press. Good questions for a poll are the first two, the one on the carried hall, the one on
# the new landmark and the last. What follows "What you can do now" is for reading at home.

# %% slideshow={"slide_type": "skip"} tags=["folded"]
import numpy as np
import sympy as sp

from slamlab import models, views
from slamlab.checks import ask
from slamlab.derivation import derive, differentiate, expectation, partials, symmetric
from slamlab.evaluation import nees
from slamlab.filters import Belief
from slamlab.geometry import wrap
from slamlab.layers import Poses
from slamlab.models import jacobians, noise
from slamlab.models.differences import slopes
from slamlab.studies import small_errors
from slamlab.studies.agreeing_poses import share_inside

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## What a small error becomes
#
# The cart of lesson 03 obeyed a matrix. A robot in the plane does not: it drives where it heads, so
# sines and cosines come in. Can the Kalman filter still be of use?
#
# Here is such a robot. It believes that it stands at the origin with the heading 0.7 rad (40°). Its
# place may be off by $\sigma$ = 5 cm in $x$ and in $y$, its heading by $\sigma$ = 0.1 rad (6°). Now
# it drives 3 m ahead and then turns by 0.3 rad. Its wheels are exact.

# %% slideshow={"slide_type": "fragment"}
ask(
    "04-streak",
    "We let 1000 robots start wherever the belief allows, and drive. What does the cloud of their "
    "end points look like?",
    {
        "a round spot, 5 cm wide": "that is the cloud at the start; but a heading that is off takes "
        "its robot farther off with every metre.",
        "a streak along the path": "that is what wheels do that miscount. These wheels are exact: "
        "every robot drives 3 m.",
        "a streak across the path": "0.1 rad of heading times 3 m is 0.3 m to the side, six times "
        "what the place was off by.",
    },
    right="a streak across the path",
)

# %% slideshow={"slide_type": "subslide"}
x_hat, u = np.array([0, 0, 0.7]), np.array([3.0, 0.3])  # what it believes; distance and turn
P, exact = np.diag([0.05, 0.05, 0.1]) ** 2, np.zeros((2, 2))
ends = small_errors.driven(x_hat, P, u, exact, np.random.default_rng(4))
end = models.f_odometry(x_hat, u)
way = Poses("the path, as believed", [x_hat, end])

# %% slideshow={"slide_type": "fragment"} answers="04-streak"
fig, _ = views.cloud(ends, {}, "Where 1000 robots end", (8, 5), [way])
along, across = np.array([[np.cos(0.7), np.sin(0.7)], [-np.sin(0.7), np.cos(0.7)]])
sigmas = [np.std(ends[:, :2] @ axis) for axis in (along, across)]
views.show(
    fig,
    f"End points in a streak across the path: σ is {sigmas[1]:.2f} m across it, {sigmas[0]:.2f} "
    f"along.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="04-streak"
# The streak lies **across** the path: $\sigma$ is {= sigmas[1]:.2f =} m to the side and
# {= sigmas[0]:.2f =} m ahead. The distance works like a lever on an error of the heading.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### A tangent
#
# Call the motion $f$. It is not linear, but our errors are small, and seen from close up a smooth
# function looks like its tangent. With the error $\tilde x = x - \hat x$,
#
# $$f(\hat x + \tilde x) \approx f(\hat x) + A\,\tilde x. \tag{04.1}$$
#
# The matrix $A$ of this tangent is the **Jacobian** of $f$. It holds all the slopes: row $i$, column
# $j$ says how the end's component $i$ moves when the start's component $j$ moves by a little,
#
# $$A_{ij} = \left.\frac{\partial f_i}{\partial x_j}\right|_{\hat x}. \tag{04.2}$$

# %% [markdown] slideshow={"slide_type": "fragment"}
# By (04.1) a drive turns the error $\tilde x$ into $A \tilde x$. This is the situation of lesson 03,
# with $A$ for $F$, and the recipe gives the same answer:
#
# $$P \leftarrow A P A^{\mathsf T} \tag{04.3}$$

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The matrix of our drive
#
# The definition (04.2) can be carried out without any calculus: move one component of the start by
# a millionth, see by how much the end moves, and divide. `slopes` does so, column by column.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
A_here = slopes(lambda x: models.f_odometry(x, u), x_hat)
A_here.round(3)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The first two columns say that an error of the place stays what it is. The third belongs to the
# heading: for each radian that it is off, the end is off by {= A_here[0, 2]:.2f =} m in $x$ and by
# {= A_here[1, 2]:.2f =} m in $y$. That is across the path, and 3 m long.

# %% slideshow={"slide_type": "subslide"}
ellipse = {"A P Aᵀ, 95 %": A_here @ P @ A_here.T}
fig, _ = views.cloud(ends, ellipse, "Foretold by one matrix", (8, 5), [way], centre=end)
foretold = share_inside(Belief(end, A_here @ P @ A_here.T), ends)
views.show(
    fig,
    f"The same streak and the ellipse A P Aᵀ round the believed end; {100 * foretold:.0f} % lie inside.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The ellipse was computed without any of the dots, by (04.3). It was drawn round $f(\hat x)$, where the
# filter believes the robot to be, and of the 1000 robots {= 100 * foretold:.0f =} % end inside; 95 %
# would be perfect. A Kalman filter that works with such tangents is called *extended*: EKF.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Where a tangent is not enough
#
# The tangent was taken at one heading, 0.7 rad. What if the true heading may be far from there?

# %% slideshow={"slide_type": "fragment"}
ask(
    "04-bias",
    "Now σ of the heading is 0.6 rad (34°). Still the filter believes in f(x̂), the end of a robot "
    "with just the believed heading. Where do the 1000 robots end **on average**?",
    {
        "at f(x̂): left and right cancel": "the errors to the sides do cancel. But a robot that heads off to "
        "a side also gets less far ahead, on whichever side.",
        "nearer to the start than f(x̂)": "every robot that heads off to a side gets less far ahead "
        "than the believed one, and none gets farther.",
        "farther from the start than f(x̂)": "all of them drive 3 m, so none can be farther than "
        "3 m from where it started.",
    },
    right="nearer to the start than f(x̂)",
)


# %% slideshow={"slide_type": "subslide"}
def drive(heading_sigma, distance):
    """1000 robots after a drive, and what an EKF believes of them."""
    u, P = np.array([distance, 0.3]), np.diag([0.05, 0.05, heading_sigma]) ** 2
    A = jacobians.A_odometry(x_hat, u)
    ends = small_errors.driven(x_hat, P, u, exact, np.random.default_rng(4))
    return ends, Belief(models.f_odometry(x_hat, u), A @ P @ A.T)


# %% slideshow={"slide_type": "fragment"} answers="04-bias" tags=["folded"]
def banana(heading_sigma, distance):
    ends, b = drive(heading_sigma, distance)
    way = Poses("the path, as believed", [x_hat, b.x])
    title = f"{100 * share_inside(b, ends):.0f} % of the robots are inside the ellipse"
    return views.cloud(ends, {"A P Aᵀ, 95 %": b.P}, title, (8, 5), [way], centre=b.x)[0]


views.explore(
    banana,
    lambda heading_sigma, distance: (
        f"End points after {distance:.1f} m, σ of the heading {heading_sigma:.2f} rad: they bend "
        "round the start, the ellipse of the tangent is straight; "
        f"{100 * share_inside(*drive(heading_sigma, distance)[::-1]):.0f} % are inside."
    ),
    heading_sigma=(0.02, 1.5, 0.6),
    distance=(0.5, 6.0, 3.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="04-bias"
# The end points bend round the start like a banana. The ellipse is straight, as a tangent is: it is
# too long, far too thin, and in the wrong place. Move $\sigma$ of the heading down to 0.1 rad, and the two
# agree. Then lengthen the drive: the bend grows with it, and ever fewer robots are inside.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="04-bias"
print("σ of θ   inside   their average is off f(x̂) by")
for heading_sigma in (0.1, 0.3, 0.6):
    ends_then, b = drive(heading_sigma, 3.0)
    off = np.hypot(*(ends_then.mean(axis=0) - b.x)[:2])
    print(f"{heading_sigma:3} rad {100 * share_inside(b, ends_then):6.0f} % {off:13.2f} m")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="04-bias"
# At 0.6 rad the robots end on average {= off:.2f =} m short of where the filter believes. Nothing
# in (04.3) tells it so, because a tangent does not know how its curve bends.
#
# **A Jacobian is a promise about small errors.** An EKF must never let its heading get this unsure.
# Samples (lesson 11) need no tangent, and in the exercise you will do better than (04.3), too.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let somebody find the σ at which they would no longer sign for the ellipse.
# Then ask which of the two, a longer drive or a vaguer heading, is the more dangerous.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## The motion and its Jacobian A
#
# A matrix of numbers holds at one pose only. A filter needs $A$ at every step, so we derive it once,
# in letters.
#
# Odometry reports a control $u = (d, \Delta\theta)$: the robot drove the distance $d$ along its old
# heading and then turned by $\Delta\theta$. That is our motion model:
#
# $$f(x, u) = \begin{bmatrix} x + d\cos\theta \\ y + d\sin\theta \\ \theta + \Delta\theta
# \end{bmatrix} \tag{04.4}$$

# %% slideshow={"slide_type": "fragment"}
from slamlab.models.symbolic import beta, d, dtheta, p_x, p_y, r, theta, x, y

pose, control, landmark, sight = [x, y, theta], [d, dtheta], [p_x, p_y], [r, beta]
dx, dy = sp.symbols("Δx Δy", real=True)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
f = sp.Matrix([x + d * sp.cos(theta), y + d * sp.sin(theta), theta + dtheta])  # the model
A_steps = (
    derive("A", partials(f, pose), "by definition (04.2)")
    .step("by x and by y", differentiate(x, y))
    .step("by θ", differentiate(theta))
)
A = A_steps.result
by_hand = sp.Matrix([[1, 0, -dy], [0, 1, dx], [0, 0, 1]])
A_steps.step("with the step's own Δx and Δy", by_hand, given={dx: f[0] - x, dy: f[1] - y})

# %% [markdown] slideshow={"slide_type": "fragment"}
# What is new in a line is blue and underlined, and the machine has checked each line against the
# one before.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Read it
#
# $$A = \begin{bmatrix} 1 & 0 & -\Delta y \\ 0 & 1 & \Delta x \\ 0 & 0 & 1 \end{bmatrix} \tag{04.5}$$
#
# Here $(\Delta x, \Delta y)$ is the step that the robot made in the world, and $(-\Delta y, \Delta x)$
# is that step turned by 90°: the streak across the path. You can see it without calculus. If the
# heading is off, the whole step swings round its start, and its end moves at right angles to it.
#
# **Try** a robot that turns *before* it drives: write $\theta + \Delta\theta$ in the cosine and the
# sine. All lines follow, and (04.5) still holds. Then take the minus before `dy` away: the machine
# refuses that line, and shows a point where the two differ.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Wheels err, too: W and Q
#
# Real wheels slip, so the control has an error $\tilde u$ as well, with a covariance $C$. The tangent of
# $f$ in the direction of $u$ says what that does, and its matrix is called $W$:
#
# $$\tilde x \leftarrow A\,\tilde x + W \tilde u, \qquad W = \frac{\partial f}{\partial u} \tag{04.6}$$
#
# The robot's error and this step's slip have nothing to do with each other, so the recipe of lesson
# 03 adds their covariances:
#
# $$P \leftarrow A P A^{\mathsf T} + Q, \qquad Q = W C W^{\mathsf T} \tag{04.7}$$

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
W = f.jacobian(control)
W

# %% [markdown] slideshow={"slide_type": "fragment"}
# The first column, for an error of the distance, points **along** the heading. The second, for an error
# of the turn, changes the heading only, as the turn comes last.
#
# A look at the units finds many mistakes. $C$ holds the *variances* of $d$ and of $\Delta\theta$,
# in m² and rad². $W$ carries them to the pose, so that $Q$ has m² in its upper left block and rad²
# in its corner.


# %% slideshow={"slide_type": "subslide"}
def wheels(distance_error, heading_sigma):
    """1000 robots with wheels that err by a share of the distance: with Q and without."""
    P, C = np.diag([0.05, 0.05, heading_sigma]) ** 2, noise.C_odometry(u, distance_error, 0.1)
    ends = small_errors.driven(x_hat, P, u, C, np.random.default_rng(4))
    trusted = A_here @ P @ A_here.T
    claims = {"A P Aᵀ + Q": trusted + noise.Q(jacobians.W_odometry(x_hat, u), C)}
    claims |= {"A P Aᵀ, wheels trusted": trusted}
    inside = share_inside(Belief(end, claims["A P Aᵀ + Q"]), ends)
    title = f"{100 * inside:.0f} % inside the solid ellipse"
    return views.cloud(ends, claims, title, (8, 5), [way], centre=end)[0]


# %% slideshow={"slide_type": "fragment"}
views.explore(
    wheels,
    lambda distance_error, heading_sigma: (
        f"End points with wheels off by {100 * distance_error:.0f} % of the path and a heading off by "
        f"{heading_sigma:.2f} rad. The first widens the cloud along the path, the second across "
        f"it; "
        "the solid ellipse follows both, the dashed one only the second."
    ),
    distance_error=(0.0, 0.2, 0.1),
    heading_sigma=(0.0, 0.2, 0.1),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# With wheels that err by 10 % of the distance, the streak has become nearly round. $A$ widens it across the
# path, $W$ along it: two errors at right angles. A filter that trusts its wheels believes in the dashed
# ellipse. Set either slider to zero to see the other error alone.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## Part two: what the robot sees, and H
#
# So much for moving; this is a good place for a break. Now the robot looks. It sees a landmark at
# $p = (p_x, p_y)$ and measures a range $r$ and a bearing $\beta$. Pythagoras gives the range. The
# bearing is the landmark's direction in the world, less the robot's own heading. Together they are
# the observation model:
#
# $$h(x, p) = \begin{bmatrix} \sqrt{(p_x - x)^2 + (p_y - y)^2} \\
# \operatorname{atan2}(p_y - y,\ p_x - x) - \theta \end{bmatrix} \tag{04.8}$$
#
# The filter of lesson 03 needs a matrix $H$ that says how a small error of the pose shows in the
# measurement. Once more that is the Jacobian.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask what atan2 can tell that the arctangent of the quotient cannot. Then do
# the next derivation with the body: look at a student, step to your left, and let the class say
# where that student has gone in your view.


# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
def in_r(expression):
    """Write r for the root."""
    return sp.simplify(expression.subs((p_x - x) ** 2 + (p_y - y) ** 2, r**2))


root = sp.sqrt((p_x - x) ** 2 + (p_y - y) ** 2)
h = sp.Matrix([root, sp.atan2(p_y - y, p_x - x) - theta])  # the model
H_steps = (
    derive("H_r", partials(h, pose), "by definition")
    .step("by x; the derivative of atan2 has r² below", differentiate(x))
    .step("by y", differentiate(y))
    .step("by θ: turning on the spot brings no landmark nearer", differentiate(theta))
)
H_steps.step("the root is r again: give it its name", in_r, given={r: root})

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Read it
#
# $$H_{\mathrm r} = \frac{\partial h}{\partial x} = \begin{bmatrix}
# -\dfrac{p_x - x}{r} & -\dfrac{p_y - y}{r} & 0 \\[2ex]
# \dfrac{p_y - y}{r^2} & -\dfrac{p_x - x}{r^2} & -1 \end{bmatrix} \tag{04.9}$$
#
# The roman subscript stands for the robot. The row of the range is the unit vector that points from
# the landmark to the robot: a step in this direction changes the range by its full length, and a
# turn does not change it. In the row of the bearing, the $-1$ says that whoever turns left sees the
# whole world turn right.

# %% slideshow={"slide_type": "fragment"}
ask(
    "04-far",
    "Another landmark stands in the same direction, twice as far away. What becomes of the first two "
    "columns of (04.9)?",
    {
        "both rows become half as large": "the row of the range is a unit vector: numerator and r "
        "double together.",
        "only the row of the bearing becomes half as large": "its numerators double, its r² "
        "becomes four times as large.",
        "both stay what they are": "walk past a tower on the horizon and past a lamp post: the bearing "
        "of which of them changes faster?",
    },
    right="only the row of the bearing becomes half as large",
)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="04-far"
here = np.zeros(3)
for p in ([2.0, 1.0], [4.0, 2.0]):
    print(f"landmark at {p}:", jacobians.H_robot(here, p).round(3).tolist())

# %% [markdown] slideshow={"slide_type": "fragment"} answers="04-far"
# Units explain it. The row of the range has none, metres per metre; the row of the bearing is in
# radians per metre, hence the second $r$ below. So the **bearing** of a far landmark says little about
# where you are, though as much as that of a near one about where you look. The **range** of a far landmark
# says as much about where you are as that of a near one.
#
# **Try** a sensor that measures the square of the range, `root**2`, in the derivation above. Every line
# follows.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## What no sight can tell
#
# In SLAM the landmark is unknown, too, and $H$ gets columns for it. We need not differentiate again:
# (04.8) holds only the *differences* of $p$ and $(x, y)$, so the landmark's columns are minus the robot's
# first two.
#
# $$H_{\mathrm p} = \frac{\partial h}{\partial p} = \begin{bmatrix}
# \dfrac{p_x - x}{r} & \dfrac{p_y - y}{r} \\[2ex]
# -\dfrac{p_y - y}{r^2} & \dfrac{p_x - x}{r^2} \end{bmatrix} \tag{04.10}$$

# %% slideshow={"slide_type": "fragment"}
ask(
    "04-hall",
    "At night somebody carries the whole hall away, the robot and all landmarks in it: 1 m to the "
    "north, and turned by 10°. What does the robot see in the morning?",
    {
        "all bearings have changed by 10°": "they would if only the robot or only the landmarks had been "
        "turned. Its heading has turned along with the landmarks.",
        "some ranges have changed by up to 1 m": "they would if only the robot had been shifted. The "
        "landmarks came along.",
        "exactly what it saw before": "ranges and bearings depend on where things stand relative to "
        "each other, and that is as before.",
    },
    right="exactly what it saw before",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="04-hall"
# A small shift moves robot and landmark alike. A small turn by $\delta$ about the origin moves a
# point $(x, y)$ by $\delta\,(-y, x)$ and adds $\delta$ to the heading. If sights cannot tell, $H$ must
# say zero to both:
#
# $$H_{\mathrm r}\begin{bmatrix} 1 & 0 & -y \\ 0 & 1 & x \\ 0 & 0 & 1 \end{bmatrix} + H_{\mathrm p}
# \begin{bmatrix} 1 & 0 & -p_y \\ 0 & 1 & p_x \end{bmatrix} = 0 \tag{04.11}$$

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="04-hall"
H_r, H_p = h.jacobian(pose), h.jacobian(landmark)
carried_robot = sp.Matrix([[1, 0, -y], [0, 1, x], [0, 0, 1]])  # columns: both shifts, the turn
carried_landmark = sp.Matrix([[1, 0, -p_y], [0, 1, p_x]])
sp.simplify(H_r * carried_robot + H_p * carried_landmark)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="04-hall"
# So SLAM can find a map only **up to a shift and a turn**. Where the origin is, and where $x$ points to,
# is for us to choose; the usual choice is the robot's first pose.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Angles jump, derivatives do not
#
# The filter corrects by the innovation $v = z - h(\hat x, p)$, measured minus predicted. One half of it
# is an angle, and angles start again after a full turn.

# %% slideshow={"slide_type": "fragment"}
ask(
    "04-wrap",
    "A landmark is nearly behind the robot. The predicted bearing is 179°, the measured one −179°. Which "
    "innovation should the filter get?",
    right=2,
    tolerance=0.5,
    unit="degrees",
    reason="from 179° on to 181°, which is the same direction as −179°.",
    wrong={
        -358: "that is what subtraction says. It is nearly a full turn, and the filter would believe "
        "that it was wrong by as much.",
        358: "measured minus predicted has the other sign; and nearly a full turn is a small angle.",
        -2: "the other way round: the measured bearing lies farther to the left.",
    },
)

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="04-wrap"
predicted, measured = np.array([3.0, np.radians(179)]), np.array([3.0, np.radians(-179)])
H_behind = jacobians.H_robot(here, models.g(here, predicted))
P_place, R = np.diag([0.1, 0.1, 0.1]) ** 2, noise.R(3.0, range_error=0.01, bearing_sigma=0.02)
K = P_place @ H_behind.T @ np.linalg.inv(H_behind @ P_place @ H_behind.T + R)
v = measured - predicted
for name, bearing in {"subtracted": v[1], "wrapped": wrap(v[1])}.items():
    correction = K @ [v[0], bearing]
    print(f"{name:10}: heading {np.degrees(correction[2]):6.1f}°, y {correction[1]:6.2f} m")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="04-wrap"
# Subtracted, the innovation throws the robot almost once round; wrapped, it moves the heading by
# {= abs(np.degrees(correction[2])):.1f =}°. So every filter that works wraps the innovation of the
# bearing,
#
# $$v_\beta = \operatorname{wrap}(z_\beta - h_\beta(\hat x, p)) \in (-\pi, \pi], \tag{04.12}$$
#
# although no derivation asks for it, since a slope does not see the jump. And all angles are in
# **radians**, because only then is the slope of the sine a cosine.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* This fault shows only when a landmark passes behind the robot; tests with everything
# in front stay green. Ask who has had such a bug in a compass or a clock.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## A new landmark
#
# A landmark that is seen for the first time goes into the map where pose and sight put it. That is $h$
# the other way round:
#
# $$p = g(x, z) = \begin{bmatrix} x + r\cos(\theta + \beta) \\ y + r\sin(\theta + \beta)
# \end{bmatrix} \tag{04.13}$$
#
# The place will be wrong because the pose is wrong, and because the sight is. Each of the two has its
# Jacobian.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
g = sp.Matrix([x + r * sp.cos(theta + beta), y + r * sp.sin(theta + beta)])  # the model
(
    derive("J_r", partials(g, pose), "by definition: ∂g by the robot's pose")
    .step("by x and by y: the landmark goes where the robot goes", differentiate(x, y))
    .step("by θ: it swings round the robot", differentiate(theta))
)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
(
    derive("J_z", partials(g, sight), "by definition: ∂g by range and bearing")
    .step("by r: along the line of sight", differentiate(r))
    .step("by β: across it, and the more the farther", differentiate(beta))
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Read it
#
# With $\varphi = \theta + \beta$, the direction of the landmark in the world,
#
# $$J_{\mathrm r} = \begin{bmatrix} 1 & 0 & -r\sin\varphi \\ 0 & 1 & r\cos\varphi \end{bmatrix},
# \qquad J_z = \begin{bmatrix} \cos\varphi & -r\sin\varphi \\ \sin\varphi & r\cos\varphi
# \end{bmatrix}. \tag{04.14}$$
#
# A landmark is the end of a stick of length $r$ that is fixed to the robot. Shift the robot, and the end
# goes along; turn it, and the end swings sideways, as the step did in (04.5).

# %% [markdown] slideshow={"slide_type": "fragment"}
# How wrong is a sight? As in lesson 02, the range errs by a share $c_1$ of itself, and the bearing
# by the same $\sigma_\beta$ at every range. A covariance holds the *squares*:
#
# $$R = \begin{bmatrix} (c_1\,r)^2 & 0 \\ 0 & \sigma_\beta^2 \end{bmatrix} \tag{04.15}$$

# %% slideshow={"slide_type": "subslide"}
ask(
    "04-stick",
    "The place of a robot is known to 0.15 m, its heading to 0.08 rad. It sees a landmark 5 m away; the "
    "range is good to 2 %, the bearing to 0.02 rad. In which direction is the new landmark least sure?",
    {
        "along the line of sight": "there only the place of the robot and the range count: 0.15 m and "
        "2 % of 5 m.",
        "across the line of sight": "5 m times 0.08 rad is 0.4 m, more than anything else.",
        "in all directions alike": "the place of the robot does count alike in all directions; but the "
        "heading swings the landmark to the sides only.",
    },
    right="across the line of sight",
)


# %% slideshow={"slide_type": "subslide"} answers="04-stick"
def first_sight(landmark_range, heading_sigma):
    """1000 places where a landmark may be that was seen once, and the ellipse of (04.17)."""
    x_hat, z = np.array([0, 0, 0.4]), np.array([landmark_range, 0.8])
    P, R = np.diag([0.15, 0.15, heading_sigma]) ** 2, noise.R(landmark_range, 0.02, 0.02)
    marks = small_errors.placed(x_hat, P, z, R, np.random.default_rng(4))
    J_r, J_z = jacobians.J_xr(x_hat, z), jacobians.J_z(x_hat, z)
    P_nn, p = small_errors.new_landmark(P, J_r, J_z, R), models.g(x_hat, z)
    line = Poses("the line of sight", [x_hat, [*p, 1.2]])
    title = (
        f"{100 * np.mean(nees(marks - p, P_nn) < 5.99):.0f} % of the places are inside the ellipse"
    )
    return views.cloud(marks, {"P_nn of (04.17), 95 %": P_nn}, title, (8, 5), [line], centre=p)[0]


# %% slideshow={"slide_type": "fragment"} answers="04-stick"
views.explore(
    first_sight,
    lambda landmark_range, heading_sigma: (
        f"Places of a landmark seen once at {landmark_range:.1f} m by robots whose heading is off by "
        f"{heading_sigma:.2f} rad, and their ellipse: the farther, and the vaguer the heading, the "
        "wider across the line of sight."
    ),
    landmark_range=(1.0, 10.0, 5.0),
    heading_sigma=(0.0, 0.3, 0.08),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="04-stick"
# The cloud is wide across the line of sight. Bring the landmark to 1 m, and the cloud is nearly round:
# the lever is gone. Make the heading vaguer at 10 m, and you meet the banana again. The next section
# computes the ellipse.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Whom a new landmark knows
#
# Let $n$ be the new landmark. To first order its error is made of the robot's error and of the sight's
# noise $\varepsilon$:
#
# $$\tilde p_n = J_{\mathrm r}\,\tilde x + J_z\,\varepsilon \tag{04.16}$$
#
# The map may hold older landmarks. Take one, $i$, whose error has something in common with the
# robot's: their covariance is $P_{\mathrm ri}$.

# %% slideshow={"slide_type": "fragment"}
ask(
    "04-cross",
    "The new landmark n has just been placed. What is the covariance of its error and that of landmark i, "
    "which the robot does not see at the moment?",
    {
        "zero: the two were never seen together": "they need not be. The error of i is tied to the "
        "robot's, and n was placed from where the robot believed it was.",
        "not zero": "the error of the robot is in n, and it has something in common with that of i.",
        "unknown, until both are seen at once": "(04.16) says all that is needed.",
    },
    right="not zero",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="04-cross"
# The recipe of lesson 03 answers: multiply two errors, take the expected value. The noise of this sight
# has nothing to do with any earlier error.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="04-cross"
x_error, p_i, eps = (sp.MatrixSymbol(n, k, 1) for n, k in [("x", 3), ("p_i", 2), ("eps", 2)])
P_rr, P_ii, R_ = symmetric("P_rr", 3), symmetric("P_ii", 2), symmetric("R", 2)
P_ri, J_r, J_z = (sp.MatrixSymbol(*n) for n in [("P_ri", 3, 2), ("J_r", 2, 3), ("J_z", 2, 2)])
known = {x_error * x_error.T: P_rr, x_error * p_i.T: P_ri, p_i * p_i.T: P_ii, eps * eps.T: R_}
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
# A new landmark is born as a relative of the robot, and of all that the robot is related to. Whoever sets
# $P_{\mathrm rn}$ and $P_{ni}$ to zero makes the filter forget that its whole map shares errors. Lesson
# 07 shows what that costs. (Two students who copied from the same neighbour make the same mistakes, though
# they have never met.)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## Trust nothing: three ways to the same matrix
#
# A derivation can be mistyped, a program can be mistyped, and differences depend on their step
# size. It is hardly possible that all three go wrong in the same way. So, at one pose with nothing
# special about it, we compare three matrices: the one derived, the one that the code of `slamlab`
# computes, and the `slopes` of the model itself.

# %% slideshow={"slide_type": "fragment"}
at = {x: 1.2, y: -0.7, theta: 0.9, p_x: -1.5, p_y: 2.2, d: 1.3, dtheta: 0.4, r: 3.1, beta: 1.1}
X, U, LANDMARK, Z = (np.array([at[one] for one in n]) for n in (pose, control, landmark, sight))
ways = {
    "A": (A, jacobians.A_odometry(X, U), slopes(lambda x: models.f_odometry(x, U), X)),
    "W": (W, jacobians.W_odometry(X, U), slopes(lambda u: models.f_odometry(X, u), U)),
    "H_r": (H_r, jacobians.H_robot(X, LANDMARK), slopes(lambda x: models.h(x, LANDMARK), X)),
    "H_p": (H_p, jacobians.H_landmark(X, LANDMARK), slopes(lambda p: models.h(X, p), LANDMARK)),
    "J_r": (g.jacobian(pose), jacobians.J_xr(X, Z), slopes(lambda x: models.g(x, Z), X)),
    "J_z": (g.jacobian(sight), jacobians.J_z(X, Z), slopes(lambda z: models.g(X, z), Z)),
}


# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
def hold(name, formula, code, slope, at=at):
    """Print by how much a derivation differs from the code and from the slopes of the model."""
    value = np.array(formula.subs(at).evalf(), dtype=float)
    off = [abs(value - other).max() for other in (code, slope)]
    print(f"{name:3}  derivation − code {off[0]:.6f}   derivation − slopes {off[1]:.6f}")


for name, three in ways.items():
    hold(name, *three)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Zeros all the way down. Such a test costs a line for each matrix and needs no idea of what the right
# answer is, and no entry that is wrong at this pose escapes it. Make it your habit.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## What one wrong sign does
#
# Suppose we had not tested. In the row of the bearing of $H_{\mathrm r}$, somebody has lost the minus
# before $(p_x - x)/r^2$. One sign in six entries; everything else is right. A robot stands still and
# corrects its pose 20 times by three landmarks that it knows.

# %% slideshow={"slide_type": "fragment"}
ask(
    "04-sign",
    "How does the filter fare after 20 sights with one wrong sign in H?",
    {
        "its error stays large, and so does its σ": "σ comes from P, and P is computed from H and R "
        "alone. It shrinks with every sight, whatever is measured.",
        "its error stays large, but its σ becomes small": "P shrinks with every sight, as it would with "
        "a right H, while the corrections go astray.",
        "its error becomes small, only more slowly": "some of the corrections go the wrong way; more of "
        "them do not help.",
    },
    right="its error stays large, but its σ becomes small",
)


# %% slideshow={"slide_type": "subslide"} answers="04-sign" tags=["folded"]
def spoiled(factor, landmarks):
    """Errors of 100 robots whose ∂β/∂y is multiplied by a factor, and what they believe."""
    (right, _), (wrong, believed) = (small_errors.localised(k, landmarks) for k in (1, factor))
    steps = np.arange(1, 21)
    title = f"∂β/∂y times {factor:.2f}".replace("-", "−")
    fig, ax = views.chart("sights", "place [m]", title, (8, 4))
    lines = {
        "error, right H": (right, "corrected", "-"),
        "error, spoiled H": (wrong, "naive", "--"),
    }
    lines |= {"σ believed with spoiled H": (believed, "limit", "-.")}
    for name, (values, colour, dash) in lines.items():
        ax.plot(steps, values, dash, color=views.COLOURS[colour], label=name)
    ax.set(ylim=(0, None), xticks=[1, 5, 10, 15, 20])
    views.legend(ax)
    return fig


# %% slideshow={"slide_type": "fragment"} answers="04-sign" tags=["folded"]
def last(factor, landmarks):
    """Median error and believed σ after the last sight."""
    return [each[-1] for each in small_errors.localised(factor, landmarks)]


views.explore(
    spoiled,
    lambda factor, landmarks: (
        f"Median errors fall to {last(1, landmarks)[0]:.2f} m with the right H; with one entry "
        f"spoiled to {last(factor, landmarks)[0]:.2f} m, {last(factor, landmarks)[1]:.2f} m believed."
    ),
    factor=(-1.0, 1.0, -1.0),
    landmarks=(1, 3, 3),
)
(right, _), (wrong, believed), (forgiven, _) = last(1, 3), last(-1, 3), last(0.5, 3)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="04-sign"
# With the wrong sign the median error is {= 100 * wrong:.1f =} cm after 20 sights, with the right
# $H$ {= 100 * right:.1f =} cm. And the filter believes in {= 100 * believed:.1f =} cm: it is sure
# of something wrong, because no innovation enters $P$ (lesson 03).
#
# Move the factor. At one half the error is {= 100 * forgiven:.1f =} cm, nearly as good as right:
# the next sight mends what the last one missed. A wrong *size* may be forgiven; a wrong *sign*
# sends the robot the wrong way. Neither shows in the believed $\sigma$. Only a test finds them.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Literature
#
# - C. G. J. Jacobi, "De determinantibus functionalibus", *Journal für die reine und angewandte
#   Mathematik* 22, 1841: the matrix's name.
# - G. L. Smith, S. F. Schmidt and L. A. McGee, *Application of statistical filter theory to the optimal
#   estimation of position and velocity on board a circumlunar vehicle*, NASA TR R-135, 1962: tangents in
#   the Kalman filter, for the way to the Moon.
# - R. Smith, M. Self and P. Cheeseman, "Estimating uncertain spatial relationships in robotics", in
#   *Autonomous Robot Vehicles*, Springer, 1990: the blocks of a new landmark.
# - S. J. Julier and J. K. Uhlmann, "Unscented filtering and nonlinear estimation", *Proceedings of the
#   IEEE* 92(3), 2004: better than a tangent.
#
# **Read next:** S. Thrun, W. Burgard and D. Fox, *Probabilistic Robotics*, MIT Press, 2005, chapters 5
# and 6.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## What you can do now
#
# You can derive a Jacobian, read it with units and pictures, test it in three ways, and say where it fails:
# at large errors.
#
# **What comes next:** [lesson 05](05_two_easy_halves.ipynb) puts $A$ and $H$ to work. Where am I in a known
# map, and where are the landmarks if I know where I am?
#
# The sections below this one are optional.
#
# **Exercise:** [04 · Models and Jacobians](../exercises/ex04_models_and_jacobians.ipynb). You write
# $H$ and the Jacobians of a new landmark, derive the Jacobian of a camera that is in no book, and
# beat the tangent where it fails. The models judge you, not a stored answer.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: a robot that steers
#
# The robot of the MAK thesis is a car. It is told a speed $V$ and a steering angle $\gamma$; its axles are
# $B$ apart, and a step takes the time $T$:
#
# $$f(x, u) = \begin{bmatrix} x + T V \cos(\theta + \gamma) \\ y + T V \sin(\theta + \gamma) \\
# \theta + \tfrac{T V}{B} \sin\gamma \end{bmatrix} \tag{04.18}$$
#
# What will be different in $A$?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
from slamlab.models.symbolic import B, T, V, gamma

X_ahead, Y_ahead = x + T * V * sp.cos(theta + gamma), y + T * V * sp.sin(theta + gamma)
f_steered = sp.Matrix([X_ahead, Y_ahead, theta + T * V / B * sp.sin(gamma)])
(
    derive("A", partials(f_steered, pose), "by definition")
    .step("differentiate", differentiate())
    .step("name the step", by_hand, given={dx: X_ahead - x, dy: Y_ahead - y})
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# Nothing: it is (04.5) again. Whatever drives a robot, an error of its heading swings the step that
# it makes. Only $W$ differs, because the noise is now in $V$ and $\gamma$:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
W_steered = f_steered.jacobian([V, gamma])
W_steered

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
command, car = np.array([0.8, -0.3]), (0.5, 0.25)  # V and γ; B and T
there = at | dict(zip((V, gamma, B, T), (*command, *car), strict=True))
by_u = slopes(lambda u: models.f_steered(X, u, *car), command)
hold("W", W_steered, jacobians.W_steered(X, command, *car), by_u, there)

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: Jacobians that undo each other
#
# $g$ places what $h$ sees, so seeing a landmark that was just placed gives back the sight:
# $h(x, g(x, z)) = z$. Differentiate both sides by $z$ and by $x$, with the chain rule:
#
# $$H_{\mathrm p} J_z = I, \qquad H_{\mathrm r} + H_{\mathrm p} J_{\mathrm r} = 0 \tag{04.19}$$

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
placed = {p_x: g[0], p_y: g[1]}
print(sp.simplify(H_p.subs(placed) * g.jacobian(sight)))
print(sp.simplify(H_r.subs(placed) + H_p.subs(placed) * g.jacobian(pose)))

# %% [markdown] slideshow={"slide_type": "fragment"}
# That is a fourth test, and one that needs no computer: whoever has one right Jacobian and doubts the
# other multiplies the two.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## In print
#
# Optional: how two theses and a note print this lesson's formulas. They are good theses, and
# committees have read them; every text of this size has such slips. The machine subtracts what is
# derived from what is printed. We then say in words what the difference does to a robot, since a
# slip that harms nobody is only a spelling mistake.


# %% slideshow={"slide_type": "fragment"}
def compare(place, printed, derived):
    """Print what a printed formula has too much: entry by entry, nothing where they are equal."""
    off = (printed - derived).applyfunc(sp.simplify).todok()
    words = [f"row {i + 1}, column {k + 1}: {entry}" for (i, k), entry in off.items()]
    print(f"{place:18}", "; ".join(words) or "equal")


# %% [markdown] slideshow={"slide_type": "subslide"}
# ### In print: seeing

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
H = H_r.applyfunc(in_r)
arctan, reverse = sp.atan((p_y - y) / (p_x - x)), sp.atan2(y - p_y, x - p_x)
compare("Smolec (1), h", sp.Matrix([root, arctan - theta]), h)
compare("MAK (2.29), h", sp.Matrix([root, reverse - theta]), h)
compare(
    "Smolec (2), H", sp.Matrix([H[0, :], H[1, :].multiply_elementwise(sp.Matrix([[1, -1, 1]]))]), H
)
compare("Smolec (3), H", -H[:, :2], H_p.applyfunc(in_r))

# %% [markdown] slideshow={"slide_type": "fragment"}
# | place | printed | right | harm |
# | --- | --- | --- | --- |
# | Smolec (1) | $\tan^{-1}\frac{p_y - y}{p_x - x}$ | atan2 | 180° off for all that lies behind: it is seen ahead |
# | MAK (2.29) | the same, from object to robot | $p - x$, atan2 | read as atan2, each bearing is 180° off |
# | Smolec (2) | $+(p_x - x)/r^2$ | $-(p_x - x)/r^2$ | {= 100 * wrong:.1f =} cm off after 20 sights, {= 100 * right:.1f =} cm with the right sign |
# | Smolec (3) | minus columns of (2) | right once (2) is | else the wrong sign comes twice |

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### In print: moving

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
Dx, Dy = d * sp.cos(theta), d * sp.sin(theta)
A_5 = sp.Matrix([[1, 0, -Dy * sp.sin(theta)], [0, 1, Dx * sp.cos(theta)], [0, 0, 1]])
compare("Smolec (4), f", sp.Matrix([x + sp.cos(theta), y + sp.sin(theta), theta + dtheta]), f)
compare("Smolec (5), A", A_5, A)
compare("Smolec §4.1, A", by_hand.subs({dx: Dx, dy: Dy}), A)
given_step = sp.Matrix([x + dx, y + dy, theta + dtheta])
compare("(12) with §4.1, A", by_hand, given_step.jacobian(pose))
deg = sp.Symbol("deg", real=True)
A_deg = f.subs(theta, deg * sp.pi / 180).jacobian([x, y, deg]).subs(deg, 180 * theta / sp.pi)
compare("degrees, A", A[:2, :], A_deg[:2, :])

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
west = A_5.subs({theta: np.radians(150), d: 3.0}), A.subs({theta: np.radians(150), d: 3.0})
told = [np.array(each * sp.Matrix(P) * each.T, dtype=float) for each in west]
correlations = [each[0, 1] / np.sqrt(each[0, 0] * each[1, 1]) for each in told]
print("correlation of x and y, heading 150°: (5) {:+.1f}, derived {:+.1f}".format(*correlations))
sigma_claimed = np.sqrt(0.05**2 + (3.0 * 0.1) ** 2)  # (12) with A of §4.1, 3 m to the north

# %% [markdown] slideshow={"slide_type": "subslide"}
# | place | printed | right | harm |
# | --- | --- | --- | --- |
# | Smolec (4) | $x + \cos\theta$ | $x + d\cos\theta$ | every step is 1 m long |
# | Smolec (5) | $-\Delta y \sin\theta$, $\Delta x \cos\theta$ | $-\Delta y$, $\Delta x$ | at 150° the ellipse leans to the wrong side |
# | Smolec (12) with $A$ of §4.1 | $x + \Delta x$ | $A = I$ for *given* steps | 3 m to the north: claims $\sigma_x$ = {= sigma_claimed:.2f =} m where it is 0.05 m |
# | degrees in the state | (04.5) | $\times\, \pi/180$ | 5° and 3 m: {= 3 * 5 =} m to the side, not {= 3 * np.radians(5):.2f =} m |
#
# $A$ of Smolec's §4.1 and of the EKF note is right, with a step *along the estimated heading*: a model and
# its Jacobian are a pair.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### In print: noise

# %% slideshow={"slide_type": "fragment"} tags=["folded", "nbval-check-output"]
c, c_1, dt = sp.symbols("c c_1 Δt", positive=True)
C_8 = sp.diag(c * dx**2, c * dy**2, c * dt**2)
W_6 = sp.Matrix([dt * sp.cos(theta), dt * sp.sin(theta), dtheta])
try:
    W_6 * C_8 * W_6.T
except sp.ShapeError:
    print("Smolec (8), Q: refused,", W_6.shape, "times", C_8.shape)
meant = sp.Matrix([Dx, Dy, dtheta])
Q_8, Q = c * meant * meant.T, W * sp.diag(c_1, c) * W.T
print("rank of what (8) means:", Q_8.rank(), " of W C Wᵀ:", Q.rank())
print("its variance of the heading, driving straight on:", Q_8[2, 2].subs(dtheta, 0))
b, s = sp.symbols("b sigma_beta", positive=True)
compare("Smolec (9), R", sp.diag(r * c, b * beta), sp.diag((c_1 * r) ** 2, s**2))
C_step = noise.C_odometry([0.1, 0], 0.05, 0.05, turn_per_metre=0.05)
true_sigma = np.degrees(np.sqrt(50 * C_step[1, 1]))  # 50 steps of 10 cm

# %% [markdown] slideshow={"slide_type": "fragment"}
# | place | printed | right | harm |
# | --- | --- | --- | --- |
# | Smolec (6)–(8) | $C$ is 3 × 3, $W$ is 3 × 1; rank one | (04.7) | 5 m straight on: $\sigma_\theta$ = 0°, where wheels that pick up 0.05 rad a metre give {= true_sigma:.1f =}° |
# | EKF note | noise by $\Delta x, \Delta y, \Delta t$ | $\Delta\theta$ for $\Delta t$ | the same rank of one |
# | Smolec (9) | $r c$, $\beta b$; "variance 1 cm → $c$ = 0.01" | (04.15) | 1 % of 4 m: {= 100 * np.sqrt(4 * 0.01):.0f =} cm in a program that counts metres, {= np.sqrt(4000 * 0.01) / 10:.1f =} cm in one that counts millimetres |

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### In print: new landmarks

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
turned = theta + beta
J_10 = sp.Matrix([[1, 0, -sp.sin(theta)], [0, 1, sp.cos(theta)]])
J_11 = sp.Matrix([[sp.cos(turned), -sp.sin(turned)], [sp.sin(turned), sp.cos(turned)]])
compare("Smolec (10), J_r", J_10, g.jacobian(pose))
compare("Smolec (11), J_z", J_11, g.jacobian(sight))
fits = E(p_n * p_n.T) == J_r * P_rr * J_r.T + J_z * R_ * J_z.T, E(x_error * p_n.T) == P_rr * J_r.T
print("Smolec (16), (17): equal", *fits)
try:
    J_r * P_ri.T
except sp.ShapeError:
    print("Smolec (18), P_ni: refused,", J_r.shape, "times", P_ri.T.shape)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
where, z, R_z = np.array([0, 0, 0.4]), np.array([5.0, 0.8]), noise.R(5, 0.02, 0.02)
P_where, values = np.diag([0.15, 0.15, 0.08]) ** 2, {theta: 0.4, beta: 0.8}
J10, J11 = (np.array(each.subs(values), dtype=float) for each in (J_10, J_11))
pairs = (P_where, J10, jacobians.J_z(where, z)), (0 * P_where, jacobians.J_xr(where, z), J11)
nees_10, nees_11 = (small_errors.landmark_nees(where, z, R_z, *each) for each in pairs)
print(f"(10): NEES {nees_10:.0f}; (11), where SLAM starts with P = 0: {nees_11:.0f}; 2 is right")

# %% [markdown] slideshow={"slide_type": "subslide"}
# | place | printed | right | harm |
# | --- | --- | --- | --- |
# | Smolec (10) | $-\sin\theta$, $\cos\theta$ | $-r\sin\varphi$, $r\cos\varphi$ | errors {= np.sqrt(nees_10 / 2):.1f =} times as large as believed |
# | Smolec (11) | no $r$ | $r$ in the second column | {= np.sqrt(nees_11 / 2):.1f =} times, where SLAM starts |
# | Smolec (16)–(18) | $P_{ni} = J_{\mathrm r} P_{\mathrm ri}^{\mathsf T}$ | $J_{\mathrm r} P_{\mathrm ri}$ | shapes do not fit; (16) and (17) are right |
#
# A filter with such an ellipse refuses its own landmark when it sees it again, or bends its pose to it.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### In print: the update

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
estimate, correction_ = sp.Matrix([sp.Symbol("x")]), sp.Matrix([sp.Symbol("K*v")])
compare("Smolec (15), x", correction_, estimate + correction_)
marks = [sp.symbols(f"p{i}_x p{i}_y", real=True) for i in (1, 2, 3, 4)]
third = h.subs(dict(zip(landmark, marks[2], strict=True)))
filled = ["H" if not third.jacobian(part).is_zero_matrix else 0 for part in (pose, *marks)]
print("MAK (4.9), H_3: printed [0, 0, 'H', 'H', 0], differentiated", filled)

# %% [markdown] slideshow={"slide_type": "fragment"}
# | place | printed | right | harm |
# | --- | --- | --- | --- |
# | Smolec (15) | $x \leftarrow K v$; no update of $P$ | $x + K v$ | the state forgets itself; its $\sigma$ never shrinks |
# | MAK (4.9), landmark 3 | $[0\;\,0\;\,H_{\mathrm r}\;\,H_{\mathrm p}\;\,0]$ | $[H_{\mathrm r}\;\,0\;\,0\;\,H_{\mathrm p}\;\,0]$ | $H_{\mathrm r}$ has three columns, a landmark's place two: shapes do not fit |

# %% [markdown] slideshow={"slide_type": "fragment"}
# What does not multiply is harmless: it stops at once. The others run, draw an ellipse, and are wrong;
# only a test finds them.
