# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 04 · Models and Jacobians
#
# **You will be able to** derive every Jacobian that EKF-SLAM needs (H, A, W, J_xr, J_z), test one
# that you find in a book before you trust it, and say what a wrong one does to a robot.
#
# **90 minutes** (45 for the derivations, 45 for the errata). **Before:** lesson 00 for notation;
# partial derivatives; what a covariance is. The update step comes from lesson 03.
#
# Sources: MAK thesis, chapter 3; the EKF note; Smolec, sections 2.6 and 4.1.
#
# *Key:* a model says what happens, its Jacobian says what happens to a small error.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Each line of a derivation is a cell of its own: press the key, and ask the
# class for the next line before it appears. The first half stands alone as a lecture; the errata
# make a second one, or homework in pairs: one types the printed formula, the other predicts the
# harm.
#
# *In 90 minutes:* all of it. *In 45:* up to "Whom a new landmark knows", whose last sentence leads to
# lesson 07; the errata are homework.

# %% slideshow={"slide_type": "skip"}
import numpy as np
import sympy as sp
from IPython.display import Markdown

from slamlab import models, views
from slamlab.derivation import derive, differentiate, partials
from slamlab.models import jacobians, noise, symbolic
from slamlab.geometry import wrap
from slamlab.layers import Poses

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## What a Jacobian is
#
# A robot believes it stands at the origin with heading 0.7 rad. It is sure of its place to 5 cm and
# of its heading to 0.1 rad (6°). It drives 3 m.
#
# **Question.** Where may it be now? Say we let 1000 robots start where the belief allows and drive.
#
# **Predict** the shape of the 1000 end points: a disc, a streak along the way, a streak across it?

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Take a vote before you go on; what to say to it stands below the picture.

# %% slideshow={"slide_type": "fragment"}
rng = np.random.default_rng(4)
home, three_metres = np.array([0, 0, 0.7]), np.array([3.0, 0.3])
P_home = np.diag([0.05, 0.05, 0.1]) ** 2
starts = rng.multivariate_normal(home, P_home, 1000)
ends = np.array([models.f_odometry(pose, three_metres) for pose in starts])

# %% [markdown] slideshow={"slide_type": "fragment"}
# The Jacobian A of the motion f holds, in column j, how the end moves when component j of the start
# moves by a little. That sentence is a program:


# %% slideshow={"slide_type": "fragment"} tags=["code", "nbval-check-output"]
def slopes(f, x, step=1e-6):
    """∂f/∂x by differences: move one component of x a little, see what f does."""
    return np.column_stack([(f(x + e) - f(x - e)) / (2 * step) for e in step * np.eye(len(x))])


A_home = slopes(lambda pose: models.f_odometry(pose, three_metres), home)
A_home.round(3)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Near the start, f is as good as the straight map "error of the start → A · error of the start". A
# straight map turns the covariance P into A P Aᵀ.

# %% slideshow={"slide_type": "slide"}
way = Poses("the way, as believed", [home, models.f_odometry(home, three_metres)])
ellipse = {"A P Aᵀ, 95 %": A_home @ P_home @ A_home.T}
fig, ax = views.cloud(ends, ellipse, "1000 robots after 3 m", layers=[way])
views.show(
    fig,
    f"End points of {len(ends)} robots form a streak across the way; the ellipse A P Aᵀ covers it.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the streak lies *across* the way (the robots drove to the upper right), about 0.3 m to
# either side per standard deviation: 3 m · 0.1 rad. One multiplication with A foretold what 1000
# robots did.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Most say "along the way", because they think of wheels that slip. Nothing
# slips here: the control is exact, the streak comes from the heading alone.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## Where a Jacobian fails
#
# **Question.** A is taken at one heading. What if the heading may be far from there?
#
# **Predict** what becomes of the streak when σ of the heading is 0.6 rad (34°). Then move the
# slider.


# %% slideshow={"slide_type": "fragment"}
def banana(heading_sigma):
    P = np.diag([0.05, 0.05, heading_sigma]) ** 2
    starts = np.random.default_rng(4).multivariate_normal(home, P, 1000)
    ends = np.array([models.f_odometry(pose, three_metres) for pose in starts])
    ellipse = {"A P Aᵀ, 95 %": A_home @ P @ A_home.T}
    fig, _ = views.cloud(ends, ellipse, f"σ of θ: {heading_sigma:.2f} rad", layers=[way])
    return fig


views.explore(
    banana,
    "The less sure the heading, the more the end points bend to a banana that the ellipse misses.",
    heading_sigma=(0.02, 1.5, 0.6),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the end points bend round the start like a banana; the ellipse is straight, too long,
# and its middle holds no robot. At 0.1 rad the two agree. A Jacobian is a promise for *small*
# errors: an EKF must never let its heading get this bad, for its formulas will not tell.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Let someone find the σ at which they would stop trusting the ellipse (0.2 to
# 0.3 rad, most say). Ask: would a longer drive help? No: the banana only grows. Samples (lesson
# 11) have no such limit.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## The observation model h
#
# The robot at (x, y, θ) sees a landmark at (p_x, p_y): at which range r and which bearing β?

# %% slideshow={"slide_type": "fragment"}
x, y, theta, p_x, p_y, d, beta = sp.symbols("x y theta p_x p_y d beta", real=True)
r = sp.symbols("r", positive=True)
turn = sp.symbols("Δθ", real=True)
pose, landmark = [x, y, theta], [p_x, p_y]

# %% [markdown] slideshow={"slide_type": "fragment"}
# The range is Pythagoras:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
range_of = sp.sqrt((p_x - x) ** 2 + (p_y - y) ** 2)
range_of

# %% [markdown] slideshow={"slide_type": "fragment"}
# The bearing is the landmark's direction in the world, less the robot's heading:

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask what atan2 has that tan⁻¹ of the quotient has not (the landmark behind
# the robot). Leave it at that: the harm is shown below.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
bearing_of = sp.atan2(p_y - y, p_x - x) - theta
bearing_of

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## H, derived line by line
#
# **Question.** Six numbers: how do range and bearing change when the robot's x, y or θ does?
#
# **Predict** which of the six is zero, and which is −1 whatever the landmark.


# %% slideshow={"slide_type": "fragment"}
def in_r(expression):
    """Write r for the root."""
    return sp.simplify(expression.subs((p_x - x) ** 2 + (p_y - y) ** 2, r**2))


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
h = sp.Matrix([range_of, bearing_of])  # the model: change this line
H_steps = (
    derive("H", partials(h, pose), "by definition: ∂h/∂(x, y, θ)")
    .step("by x; the derivative of atan2 has r² below", differentiate(x))
    .step("by y", differentiate(y))
    .step("by θ: turning on the spot brings no landmark nearer", differentiate(theta))
)
H_robot = H_steps.result
H_steps.step("the root is r again: give it its name", in_r, given={r: range_of})

# %% [markdown] slideshow={"slide_type": "fragment"}
# What is new in a line is blue and underlined, and the machine has checked each line against the
# one before. Turn left, and the whole world turns right: −1.
#
# **Try** `range_of**2`, a sensor that tells the square of the range: every line follows, and in the
# last one the first row has no r below any more: it grows with the distance.

# %% [markdown] slideshow={"slide_type": "fragment"}
# **Read it with units.** The first row has none (metres per metre): it is the unit vector from the
# landmark to the robot. The second is in rad/m and fades with 1/r: a far landmark says little about
# where you are, and as much as a near one about where you look.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* What usually goes wrong: the sign of the second row's second entry. Do it
# with the body: look at a student, step left, the student moves to the right: the bearing shrinks.
# So −(p_x − x)/r².

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## Trust nothing: three ways to the same matrix
#
# A derivation can be mistyped, code can be mistyped, a step size can be bad; all three alike,
# hardly. At one point with nothing special about it we compare the derivation with
# `slamlab.models.symbolic`, with the fast code in `slamlab.models.jacobians`, and with differences of
# the model itself.

# %% slideshow={"slide_type": "fragment"}
POINT = {x: 1.2, y: -0.7, theta: 0.9, p_x: -1.5, p_y: 2.2, d: 1.3, turn: 0.4, r: 3.1, beta: 1.1}
POSE, LANDMARK, DRIVE, SEEN = (
    np.array([POINT[symbol] for symbol in names])
    for names in (pose, landmark, [d, turn], [r, beta])
)


def hold(name, derived, twin, code, differences, point=POINT):
    """Print by how much a derivation differs from its twin, from the code and from the model."""
    value = np.array(derived.subs(point).evalf(), dtype=float)
    print(
        f"{name:10} − symbolic: {sp.simplify(derived - twin).norm()}"
        f"   − code: {abs(value - code).max():.6f}"
        f"   − differences: {abs(value - differences).max():.6f}"
    )


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
by_differences = slopes(lambda pose: models.h(pose, LANDMARK), POSE)
hold("H_robot", H_robot, symbolic.H_robot, jacobians.H_robot(POSE, LANDMARK), by_differences)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Three zeros: the derivation, the code and the model agree.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## The landmark's part of H
#
# In SLAM the landmarks are unknown too, so H has columns for them.
#
# **Question.** Robot and landmark both move 1 m north. What changes in r and β? **Predict** from
# that how these columns look, without differentiating.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
H_landmark = sp.Matrix([range_of, bearing_of]).jacobian(landmark)
H_landmark.applyfunc(in_r)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
sp.simplify(H_robot[:, :2] + H_landmark)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Nothing changes, so the two parts cancel: only the offset between robot and landmark is seen.
# That is why SLAM finds a map only up to a shift and a turn: h cannot tell.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
by_differences = slopes(lambda landmark: models.h(POSE, landmark), LANDMARK)
by_code = jacobians.H_landmark(POSE, LANDMARK)
hold("H_landmark", H_landmark, symbolic.H_landmark, by_code, by_differences)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## The innovation must be wrapped
#
# The filter corrects by the *innovation*, measured minus predicted. Angles count modulo 2π.
#
# **Question.** The robot predicts a bearing of 179° and measures −179°. By how much was it wrong?
# What does a filter believe that subtracts?


# %% slideshow={"slide_type": "fragment"} tags=["code"]
def update(x, P, z, p, H, R, wrapped=True):
    """One step of the EKF (lesson 03): a known landmark p was seen at z."""
    innovation = z - models.h(x, p)
    if wrapped:
        innovation[1] = wrap(innovation[1])
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ innovation, P - K @ S @ K.T


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
believed, behind = np.array([0, 0, 0.0]), np.array([-3.0, 0.05])
measured, P = np.array([3.0, -np.radians(179)]), np.diag([0.1, 0.1, 0.1]) ** 2
H_behind, R = jacobians.H_robot(believed, behind), noise.R(3, 0.01, 0.02)
for wrapped in (True, False):
    after, _ = update(believed, P, measured, behind, H_behind, R, wrapped)
    print(f"wrapped {wrapped!s:5}: heading {np.degrees(after[2]):7.1f}°, y {after[1]:6.2f} m")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Wrapped, the heading moves by 2°. Unwrapped, the filter sees an error of 358° and throws the robot
# almost once round. No source says "wrap"; every one that runs must.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* This bug shows only when a landmark passes behind the robot: tests with
# everything in front are green. Ask who has had such a bug in a compass or a clock.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## The motion model f, and A
#
# Odometry gives a distance d and a turn Δθ: drive along the old heading, to x + d cos θ and
# y + d sin θ, then turn, to θ + Δθ.
#
# **Predict** the columns of A: what does an error of the old x do to the new pose? And one of the
# old θ?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
f = sp.Matrix([x + d * sp.cos(theta), y + d * sp.sin(theta), theta + turn])  # the model
dx, dy = sp.symbols("Δx Δy", real=True)
A_steps = (
    derive("A", partials(f, pose), "by definition: ∂f/∂(x, y, θ)")
    .step("by x and by y", differentiate(x, y))
    .step("by θ", differentiate(theta))
)
A = A_steps.result
by_hand = sp.Matrix([[1, 0, -dy], [0, 1, dx], [0, 0, 1]])
A_steps.step("with the step's own Δx and Δy", by_hand, given={dx: f[0] - x, dy: f[1] - y})

# %% [markdown] slideshow={"slide_type": "fragment"}
# An error of position stays as it is. An error of heading swings the step's end sideways: (−Δy,
# Δx) is the step (Δx, Δy) turned by 90°. That was the streak across the way.
#
# **Try** a robot that turns first: θ + Δθ in cosine and sine. Every line follows, and the last one,
# written by hand, holds as well. Then take the minus before dy away: that line is refused, with a
# point where the two differ.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
by_differences = slopes(lambda pose: models.f_odometry(pose, DRIVE), POSE)
hold("A", A, symbolic.A_odometry, jacobians.A_odometry(POSE, DRIVE), by_differences)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## W: what the controls' noise does
#
# **Question.** Now d and Δθ are wrong as well. Which derivative says what that does to the pose,
# and which shape has it?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
W = f.jacobian([d, turn])
W

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
by_differences = slopes(lambda drive: models.f_odometry(POSE, drive), DRIVE)
hold("W", W, symbolic.W_odometry, jacobians.W_odometry(POSE, DRIVE), by_differences)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## The steered robot
#
# The MAK thesis drives a car: speed V, steering angle γ, wheel base B, period T (its (2.27)).

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
V, gamma = sp.symbols("V gamma", real=True)
B, T = sp.symbols("B T", positive=True)
f_steered = sp.Matrix(
    [
        x + T * V * sp.cos(theta + gamma),
        y + T * V * sp.sin(theta + gamma),
        theta + T * V / B * sp.sin(gamma),
    ]
)
f_steered

# %% [markdown] slideshow={"slide_type": "fragment"}
# **Predict** A: what differs from the odometry's?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
A_steered = f_steered.jacobian(pose)
A_steered

# %% [markdown] slideshow={"slide_type": "slide"}
# Again (−Δy, Δx): only the step's direction is another. The noise adds to V and γ, so W has their
# two columns:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
W_steered = f_steered.jacobian([V, gamma])
W_steered

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
car, command = (0.5, 0.25), np.array([0.8, -0.3])
at = POINT | {V: 0.8, gamma: -0.3, B: 0.5, T: 0.25}
by_pose = slopes(lambda pose: models.f_steered(pose, command, *car), POSE)
by_command = slopes(lambda command: models.f_steered(POSE, command, *car), command)
by_code = jacobians.A_steered(POSE, command, *car), jacobians.W_steered(POSE, command, *car)
hold("A steered", A_steered, symbolic.A_steered, by_code[0], by_pose, at)
hold("W steered", W_steered, symbolic.W_steered, by_code[1], by_command, at)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## Q: the motion's noise, and units
#
# The controls have a covariance C. W carries it over to the pose: Q = W C Wᵀ.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
s_d, s_turn = sp.symbols("sigma_d sigma_Δθ", positive=True)
C = sp.diag(s_d**2, s_turn**2)
Q = W * C * W.T
Q

# %% [markdown] slideshow={"slide_type": "slide"}
# Units: σ_d in metres, σ_Δθ in radians, so the upper left block is in m², the corner in rad².
# Angles in degrees would be legal here; they are not in A, as we shall see.
#
# **Question.** Is A P Aᵀ + Q what 1000 robots with noisy wheels show? Compare standard deviations.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
rng = np.random.default_rng(4)
C_wheels = noise.C_odometry(three_metres, distance_error=0.05, turn_error=0.1)
drives = rng.multivariate_normal(three_metres, C_wheels, 1000)
ends = np.array([models.f_odometry(*pair) for pair in zip(starts, drives, strict=True)])
wheels_trusted = A_home @ P_home @ A_home.T
predicted = wheels_trusted + noise.Q(jacobians.W_odometry(home, three_metres), C_wheels)
print("samples ", ends.std(axis=0).round(2))
print("formula ", np.sqrt(np.diag(predicted)).round(2), " [m, m, rad]")

# %% slideshow={"slide_type": "slide"}
ellipses = {"A P Aᵀ + Q": predicted, "A P Aᵀ, wheels trusted": wheels_trusted}
fig, ax = views.cloud(ends, ellipses, "The same 3 m with noisy wheels", layers=[way])
views.show(fig, "The cloud is wider along the way than without wheel noise; A P Aᵀ + Q covers it.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the noise of the distance widens the streak *along* the way, from the dashed ellipse to
# the solid one. What A does and what W does are at right angles here.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## R: the measurement's noise
#
# A lidar's range error grows with the range (σ_r = k r), its bearing error does not. A covariance
# holds *variances*:
#
# $$R = \begin{bmatrix} (k r)^2 & 0 \\ 0 & \sigma_\beta^2 \end{bmatrix}$$
#
# **Predict** R's corners in m² and rad² at 4 m, for k = 1 % and σ_β = 0.3°.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
R = noise.R(4.0, 0.01, np.radians(0.3))
print("variances ", [f"{v:.1e}" for v in np.diag(R)], "[m², rad²]")
print("deviations", np.sqrt(np.diag(R)).round(4), "[m, rad]")

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## A new landmark: g, J_xr, J_z
#
# A landmark seen for the first time is placed where pose and measurement put it: at
# x + r cos(θ + β), y + r sin(θ + β).
#
# **Predict:** two things can be wrong, the pose and the measurement. What do they do to the
# landmark?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
g = sp.Matrix([x + r * sp.cos(theta + beta), y + r * sp.sin(theta + beta)])  # the model
J_xr_steps = (
    derive("J_xr", partials(g, pose), "by definition: ∂g/∂(x, y, θ)")
    .step("by x and by y: the landmark goes where the robot goes", differentiate(x, y))
    .step("by θ", differentiate(theta))
)
J_xr = J_xr_steps.result
J_xr_steps

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
J_z_steps = (
    derive("J_z", partials(g, [r, beta]), "by definition: ∂g/∂(r, β)")
    .step("by r: along the line of sight", differentiate(r))
    .step("by β: across it, and the more the further", differentiate(beta))
)
J_z = J_z_steps.result
J_z_steps

# %% [markdown] slideshow={"slide_type": "fragment"}
# **Try** a sensor that looks to the left, θ + β + π/2 in cosine and sine, and run both cells: sine
# and cosine change places, and it is still a stick of length r.

# %% [markdown] slideshow={"slide_type": "slide"}
# J_xr looks like two rows of A: the landmark is a point at the end of a stick of length r, and a
# turn swings it sideways. J_z is a turn into the world's frame whose second column is stretched by
# r.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
by_pose = slopes(lambda pose: models.g(pose, SEEN), POSE)
by_measurement = slopes(lambda z: models.g(POSE, z), SEEN)
hold("J_xr", J_xr, symbolic.J_xr, jacobians.J_xr(POSE, SEEN), by_pose)
hold("J_z", J_z, symbolic.J_z, jacobians.J_z(POSE, SEEN), by_measurement)

# %% [markdown] slideshow={"slide_type": "fragment"}
# One more test, for free: g undoes h, so their Jacobians undo each other. See a landmark, place it:
# H_landmark J_z must be I, and moving the robot must change nothing, H_robot + H_landmark J_xr = 0.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The chain rule as a test. A student who has one right Jacobian and doubts the
# other can use it in an exam without a computer: multiply the two.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
there = {p_x: g[0], p_y: g[1]}
print(sp.simplify(H_landmark.subs(there) * J_z))
print(sp.simplify(H_robot.subs(there) + H_landmark.subs(there) * J_xr))

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## Whom a new landmark knows
#
# The state holds the robot r and a landmark i already; the new landmark n is made from the pose
# and the measurement. **Question.** Which blocks does the covariance get? Let the machine multiply
# blocks:

# %% slideshow={"slide_type": "fragment"}
P_rr, P_ri, P_ii = (
    sp.MatrixSymbol(f"P_{n}", *size) for n, size in [("rr", (3, 3)), ("ri", (3, 2)), ("ii", (2, 2))]
)
JXR, JZ, RR = (sp.MatrixSymbol(n, 2, k) for n, k in [("J_xr", 3), ("J_z", 2), ("R", 2)])
O, I = sp.ZeroMatrix, sp.Identity
before = sp.BlockMatrix([[P_rr, P_ri, O(3, 2)], [P_ri.T, P_ii, O(2, 2)], [O(2, 3), O(2, 2), RR]])
grow = sp.BlockMatrix([[I(3), O(3, 2), O(3, 2)], [O(2, 3), I(2), O(2, 2)], [JXR, O(2, 2), JZ]])
after = sp.block_collapse(grow * before * grow.T).blocks

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
print("P_nn =", after[2, 2])
print("P_rn =", after[0, 2])
print("P_ni =", after[2, 1])

# %% [markdown] slideshow={"slide_type": "fragment"}
# The new landmark is born a relative of the robot (P_rn) and of all that the robot knows (P_ni).
# Set these blocks to zero, as many programs do, and the filter forgets that its map shares one
# error: lesson 07 shows the price.

# %% slideshow={"slide_type": "fragment"}
rng = np.random.default_rng(4)
where, seen = np.array([0, 0, 0.4]), np.array([5.0, 0.8])
P_where, R_seen = np.diag([0.15, 0.15, 0.08]) ** 2, noise.R(5.0, 0.02, 0.02)
poses = rng.multivariate_normal(where, P_where, 1000)
sights = rng.multivariate_normal(seen, R_seen, 1000)
placed = np.array([models.g(*pair) for pair in zip(poses, sights, strict=True)])


def P_new(J_xr, J_z, P=P_where):
    return J_xr @ P @ J_xr.T + J_z @ R_seen @ J_z.T


# %% slideshow={"slide_type": "slide"}
J_right = jacobians.J_xr(where, seen), jacobians.J_z(where, seen)
line = Poses("the line of sight", [where, [*models.g(where, seen), sum(where[2:] + seen[1:])]])
ellipse = {"J_xr P J_xrᵀ + J_z R J_zᵀ": P_new(*J_right)}
fig, ax = views.cloud(placed, ellipse, "A landmark seen once, at 5 m", layers=[line])
views.show(
    fig,
    f"{len(placed)} placed landmarks in a broad streak across the line of sight, and the ellipse.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the landmark is least sure across the line of sight, where the heading's error is levered
# by 5 m. The ellipse of the derivation holds the samples.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## A printed formula is a claim
#
# Now we hold what is printed in the sources against the derivation. The machine subtracts; we look
# at the harm, since a wrong formula that harms nobody is a spelling mistake.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Say it once: these are good theses, read by committees, and every text of
# this size has such errors. The point is the method. Our own formulas were tested the same way a
# minute ago.

# %% slideshow={"slide_type": "fragment"}
errata = {}


def compare(where, printed, derived):
    """Printed minus derived, simplified, kept for the table at the end."""
    difference = (printed - derived).applyfunc(sp.simplify)
    errata[where] = {"printed": printed, "derived": derived, "difference": difference}
    return difference


def harm(where, text):
    """Keep what the mistake does, in numbers."""
    errata[where]["harm"] = text
    print(text)


# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Smolec (1): tan⁻¹ of a quotient
#
# Section 2.6 prints the bearing as tan⁻¹((λ_y − y)/(λ_x − x)) − θ, with λ for our p.
#
# **Predict:** for which landmarks is that wrong, and by how much?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
printed_h = sp.Matrix([range_of, sp.atan((p_y - y) / (p_x - x)) - theta])
compare("Smolec (1), h", printed_h, h)

# %% slideshow={"slide_type": "fragment"}
directions = np.radians(np.arange(-179, 180, 2))
of = sp.lambdify([p_x, p_y], [e.subs({x: 0, y: 0, theta: 0}) for e in (bearing_of, printed_h[1])])
bearings, printed_bearings = np.degrees(of(np.cos(directions), np.sin(directions)))
fig, ax = views.curves(
    np.degrees(directions),
    {"atan2": bearings, "tan⁻¹, as printed": printed_bearings},
    "direction of the landmark [°]",
    "bearing [°]",
)
off = np.abs(bearings - printed_bearings).max()
views.show(fig, f"One curve follows the direction all round; tan⁻¹ is {off:.0f}° off behind.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the dashed line jumps: all that lies behind (beyond ±90°) is seen in front. The quotient
# forgets the signs of its two parts.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
off = np.abs(wrap(np.radians(printed_bearings - bearings)))
share = np.mean(off > 1e-6)
harm("Smolec (1), h", f"{share:.0%} of all directions come out {np.degrees(off.max()):.0f}° off")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The MAK thesis has the same tan⁻¹ in (2.29), taken from the object to the robot: read as atan2,
# that order would be 180° off everywhere.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
reverse = sp.Matrix([range_of, sp.atan2(y - p_y, x - p_x) - theta])
compare("MAK (2.29), h", reverse, h)
error = (reverse - h)[1].subs(POINT).evalf()
harm("MAK (2.29), h", f"read as atan2, every bearing is {abs(np.degrees(float(error))):.0f}° off")

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Smolec (2) and (3): a sign in H
#
# Printed, second row of (2): (λ_y − y)/r², **(λ_x − x)/r²**, −1.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
H = H_robot.applyfunc(in_r)
printed_H = sp.Matrix([[(x - p_x) / r, (y - p_y) / r, 0], [(p_y - y) / r**2, (p_x - x) / r**2, -1]])
compare("Smolec (2), H", printed_H, H)

# %% [markdown] slideshow={"slide_type": "fragment"}
# One sign. **Predict:** a robot that knows three landmarks corrects its pose again and again. Does
# the wrong sign slow it down, stop it, or drive it away?


# %% slideshow={"slide_type": "fragment"}
def H_as_printed(x, p):
    H = jacobians.H_robot(x, p)
    H[1, 1] = -H[1, 1]
    return H


truth, P_start = np.array([1.0, 1.0, 0.5]), np.diag([0.3, 0.3, 0.1]) ** 2
known, R_known = np.array([[4, 1], [2, 4.5], [-2, 2.5]]), np.diag([0.05, 0.02]) ** 2


def localise(H_of, rng, steps=20):
    """Errors of position after each sighting of a known landmark, and the last covariance."""
    x, P, errors = rng.multivariate_normal(truth, P_start), P_start, []
    for k in range(steps):
        p = known[k % 3]
        z = rng.multivariate_normal(models.h(truth, p), R_known)
        x, P = update(x, P, z, p, H_of(x, p), R_known)
        errors.append(np.hypot(*(x - truth)[:2]))
    return errors, P


# %% slideshow={"slide_type": "slide"}
runs = {
    name: [localise(H_of, np.random.default_rng(seed)) for seed in range(100)]
    for name, H_of in [("derived H", jacobians.H_robot), ("H as printed in (2)", H_as_printed)]
}
medians = {name: np.median([errors for errors, _ in run], axis=0) for name, run in runs.items()}
fig, ax = views.curves(
    np.arange(1, 21), medians, "sightings", "error of position [m]", "Median of 100 robots"
)
right, wrong = (100 * errors[-1] for errors in medians.values())
views.show(
    fig, f"With the derived H the error falls to {right:.0f} cm, else it stays at {wrong:.0f}."
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** after two sightings the dashed error does not fall any more, the solid one does. And how
# sure is the filter of its wrong place?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
good, bad = (run[-1] for run in medians.values())
sigma = np.median([np.sqrt(np.trace(P[:2, :2])) for _, P in runs["H as printed in (2)"]])
harm(
    "Smolec (2), H",
    f"after 20 sightings {100 * bad:.0f} cm off instead of {100 * good:.0f} cm, "
    f"and sure of {100 * sigma:.0f} cm",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Worse than the error: the covariance shrinks all the same. The filter is sure of something wrong.

# %% [markdown] slideshow={"slide_type": "fragment"}
# (3) repeats the entries for the landmark with the other sign. Once (2) is mended, that is right:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
difference = compare("Smolec (3), H", -H[:, :2], H_landmark.applyfunc(in_r))
harm("Smolec (3), H", "none once (2) is mended; else the wrong sign comes twice")
difference

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## Smolec (4): a step of which length?
#
# Printed: x + cosθ + q cosθ and so on, q being the noise. We leave the noise out.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
printed_f = sp.Matrix([x + sp.cos(theta), y + sp.sin(theta), theta + turn])
compare("Smolec (4), f", printed_f, f)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The distance d is missing. **Predict** where a robot is believed that drives 20 steps of 10 cm.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
move = sp.lambdify([x, y, theta, d, turn], list(printed_f))
right, printed = np.zeros(3), np.zeros(3)
for _ in range(20):
    right = models.f_odometry(right, np.array([0.1, 0.05]))
    printed = np.array(move(*printed, 0.1, 0.05))
harm("Smolec (4), f", f"2 m driven, {np.hypot(*(printed - right)[:2]):.1f} m off")

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Smolec (5), (12) and §4.1: three times A
#
# Printed in (5): −Δy·sinθ and Δx·cosθ in the third column; in §4.1: −Δy and Δx.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
Dx, Dy = d * sp.cos(theta), d * sp.sin(theta)
printed_A = sp.Matrix([[1, 0, -Dy * sp.sin(theta)], [0, 1, Dx * sp.cos(theta)], [0, 0, 1]])
compare("Smolec (5), A", printed_A, A)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
compare("Smolec §4.1 and EKF note, A", sp.Matrix([[1, 0, -Dy], [0, 1, Dx], [0, 0, 1]]), A)

# %% [markdown] slideshow={"slide_type": "fragment"}
# §4.1 is right. (5) turns the step twice. **Predict** what its ellipse looks like beside the
# samples, for a robot that looks to the upper left (150°).

# %% slideshow={"slide_type": "slide"}
rng = np.random.default_rng(4)
west, straight_on = np.array([0, 0, np.radians(150)]), np.array([3.0, 0.0])
starts = rng.multivariate_normal(west, P_home, 1000)
ends = np.array([models.f_odometry(pose, straight_on) for pose in starts])
by_name = {
    "derived A": jacobians.A_odometry(west, straight_on),
    "A as printed in (5)": sp.lambdify([theta, d], printed_A)(west[2], straight_on[0]),
}
claims = {name: A @ P_home @ A.T for name, A in by_name.items()}
westward = Poses("the way, as believed", [west, models.f_odometry(west, straight_on)])
fig, ax = views.cloud(ends, claims, "Heading 150°, 3 m driven", layers=[westward])
views.show(fig, "The derived ellipse covers the samples; the printed one leans the other way.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the dashed ellipse leans the wrong way: the filter will take a landmark's hint to the
# left for one to the right.


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
def correlation(P):
    return P[0, 1] / np.sqrt(P[0, 0] * P[1, 1])


told = [correlation(P) for P in (np.cov(ends.T), *claims.values())]
text = "correlation of x and y: samples {:+.1f}, derived {:+.1f}, printed {:+.1f}"
harm("Smolec (5), A", text.format(*told))
harm("Smolec §4.1 and EKF note, A", "none: this one is right")

# %% [markdown] slideshow={"slide_type": "slide"}
# (12) *adds* (Δx, Δy, Δθ) as odometry gives it. If these are global increments that come from the
# wheels' own count and not from the estimated θ, then A is something else:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
given = sp.Matrix([x + dx, y + dy, theta + turn])
printed_beside = sp.Matrix([[1, 0, -dy], [0, 1, dx], [0, 0, 1]])
compare("Smolec (12) with A of §4.1", printed_beside, given.jacobian(pose))

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
A_beside = np.array(printed_beside.subs({dx: 0, dy: 3}), dtype=float)
sigma_x = np.sqrt((A_beside @ P_home @ A_beside.T)[0, 0])
harm(
    "Smolec (12) with A of §4.1",
    f"if the increments are global, it claims σ = {sigma_x:.2f} m where it is 0.05 m",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# A model and its Jacobian are a pair: (12) goes with A = I, §4.1's A with a step *along the
# estimated heading*. The EKF note uses the second pair: its A, [[1, 0, −Δy], [0, 1, Δx], [0, 0,
# 1]], is right.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* which is it on a real robot? The wheels count distance and turn; any Δx, Δy
# was made with some heading. If that heading is the filter's, A is as in §4.1. If it is the
# odometry's own, A = I is right for one step, but the same heading error enters every step, and a
# Q with independent steps does not know it.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Smolec (6)–(8): a Q that does not multiply
#
# Printed: C is 3×3, W is 3×1, Q = W C Wᵀ. **Predict** what the machine says.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
c, dt = sp.symbols("c Δt", positive=True)
printed_C = sp.diag(c * dx**2, c * dy**2, c * dt**2)
printed_W = sp.Matrix([dt * sp.cos(theta), dt * sp.sin(theta), turn])
try:
    printed_W * printed_C * printed_W.T
except sp.matrices.exceptions.ShapeError:
    print("refused:", printed_W.shape, "times", printed_C.shape)

# %% [markdown] slideshow={"slide_type": "slide"}
# The third component is Δt in (6) and (8), Δθ in (7). What (8) means is c·w wᵀ with w = (Δx, Δy,
# Δθ). Beside the derived W C Wᵀ:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
w = sp.Matrix([Dx, Dy, turn])
compare("Smolec (8), Q", c * w * w.T, Q)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
print("rank of (8):", (w * w.T).rank(), "  rank of W C Wᵀ:", Q.rank())

# %% [markdown] slideshow={"slide_type": "fragment"}
# Rank one: all errors are one error; who drives too far also turns too far, by as much.
#
# **Predict:** the robot drives straight on, Δθ = 0. What does (8) say about its heading?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
rng = np.random.default_rng(4)
straight = np.array([0.1, 0.0])
C_step = noise.C_odometry(straight, 0.05, 0.05, turn_per_metre=0.05)
headings = rng.normal(0, np.sqrt(C_step[1, 1]), (1000, 50)).sum(axis=1)
claimed = float(50 * (c * w * w.T)[2, 2].subs({turn: 0}))
harm(
    "Smolec (8), Q",
    f"after 5 m straight on: σ of the heading {np.degrees(headings.std()):.1f}°, "
    f"claimed {np.degrees(np.sqrt(claimed)):.1f}°",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# A filter that is sure of its heading takes no correction of it. The EKF note too makes the noise
# proportional to Δx, Δy and Δt (it calls Δt the change of speed; by its formulas it is the length
# of the step). The third should be Δθ, and even so the rank is one.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## Smolec (9): deviation or variance?
#
# Printed: VRVᵀ = diag(r c, b d), with the advice "variance 1 cm → c = 0.01".

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
b, s_beta, k = sp.symbols("b sigma_beta k", positive=True)
compare("Smolec (9), R", sp.diag(r * c, b * d), sp.diag((k * r) ** 2, s_beta**2))

# %% [markdown] slideshow={"slide_type": "fragment"}
# r·c grows like a deviation and stands where a variance must. **Predict** what 1 % (c = 0.01)
# means at 4 m, if the program counts in metres, and if it counts in millimetres.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
in_metres, in_millimetres = np.sqrt(4 * 0.01), np.sqrt(4000 * 0.01) / 1000
harm(
    "Smolec (9), R",
    f"1 % of 4 m is 4 cm; (9) says {100 * in_metres:.0f} cm in metres, "
    f"{100 * in_millimetres:.1f} cm in millimetres",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# A formula that changes its meaning with the unit has a wrong unit. And a standard deviation of 1
# cm is a variance of 0.0001 m²; 0.01 m² would be 10 cm.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Smolec (10) and (11): a landmark on a short stick
#
# Printed: J_xr with −sinθ and cosθ; J_z as a turn by θ + Δθ. We read Δθ as the bearing.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
printed_J_xr = sp.Matrix([[1, 0, -sp.sin(theta)], [0, 1, sp.cos(theta)]])
compare("Smolec (10), J_xr", printed_J_xr, J_xr)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
c_there, s_there = sp.cos(theta + beta), sp.sin(theta + beta)
printed_J_z = sp.Matrix([[c_there, -s_there], [s_there, c_there]])
compare("Smolec (11), J_z", printed_J_z, J_z)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The range is missing in both, the bearing in the first. **Predict** the ellipse, beside the
# samples of the landmark seen at 5 m.

# %% slideshow={"slide_type": "slide"}
numbers = [0, 0, where[2], *seen]
as_printed = [sp.lambdify([x, y, theta, r, beta], J)(*numbers) for J in (printed_J_xr, printed_J_z)]
claims = {"derived": P_new(*J_right), "as printed in (10), (11)": P_new(*as_printed)}
fig, ax = views.cloud(placed, claims, "The landmark seen once, at 5 m")
views.show(fig, "The derived ellipse covers the samples, the printed one is far too narrow.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the printed ellipse is short across the line of sight, where the landmark is least sure.
# A filter with a gate will refuse its own landmark when it sees it again; one without will bend
# the robot's pose to it.
#
# How bad is each alone? The *squared error in units of the covariance* is 2 on average where the
# covariance is right. (11) shows where SLAM starts: there the pose is exact, P = 0.


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
def surprise(landmarks, covariance):
    """Mean squared error in units of the covariance: 2 where it is right."""
    errors = landmarks - landmarks.mean(axis=0)
    return np.einsum("ni,ij,nj->n", errors, np.linalg.inv(covariance), errors).mean()


from_home = models.g(where, sights)
at_start = surprise(from_home, P_new(J_right[0], as_printed[1], P=np.zeros((3, 3))))
check = surprise(placed, P_new(*J_right)), surprise(from_home, P_new(*J_right, P=np.zeros((3, 3))))
print("derived J_xr and J_z:", np.round(check, 1))
told = surprise(placed, P_new(as_printed[0], J_right[1]))
harm("Smolec (10), J_xr", f"squared error {told:.1f} instead of 2 in units of P_nn")
harm("Smolec (11), J_z", f"squared error {at_start:.0f} instead of 2 at SLAM's start")

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## Degrees
#
# The thesis keeps millimetres and degrees in the state, with these Jacobians. **Predict** what that
# does to A. Let the machine differentiate with a heading in degrees:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
degrees = sp.symbols("theta_deg", real=True)
f_degrees = f.subs(theta, degrees * sp.pi / 180)
A_degrees = f_degrees[:2, :].jacobian([x, y, degrees]).subs(degrees, 180 / sp.pi * theta)
compare("degrees in the state, A", A[:2, :], A_degrees)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
sigma_heading = 5.0  # degrees
right, printed = 3 * np.radians(sigma_heading), 3 * sigma_heading
harm(
    "degrees in the state, A",
    f"σ = 5° of heading, 3 m driven: claimed {printed:.0f} m to the side, truly {right:.2f} m",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Derivatives of sine and cosine are what they are only in radians: every entry by an angle lacks
# π/180, and H's bearing row lacks 180/π. In `slamlab` angles are radians, and degrees exist at the
# edge only: in drivers, and on plots.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## Smolec (15): the state that forgets itself
#
# Printed: X = K · innovation; and P is not updated anywhere in the text.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
X, correction = sp.Matrix([sp.Symbol("X")]), sp.Matrix([sp.Symbol("K*innovation")])
compare("Smolec (15), X", correction, X + correction)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
believed, p = np.array([4.0, 3.0, 0.5]), np.array([6.0, 4.0])
P, R = np.diag([0.1, 0.1, 0.05]) ** 2, np.diag([0.05, 0.02]) ** 2
z = models.h(believed, p) + np.array([0.03, 0.01])
after, P_after = update(believed, P, z, p, jacobians.H_robot(believed, p), R)
step = after - believed
harm(
    "Smolec (15), X",
    f"a correction of {100 * np.hypot(*step[:2]):.0f} cm becomes an error of "
    f"{np.hypot(*(step - after)[:2]):.1f} m; σ of x stays 10 cm, should be "
    f"{100 * np.sqrt(P_after[0, 0]):.0f} cm",
)

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## Smolec (16)–(18): a transpose too many
#
# Printed: P_nn = J_xr P_rr J_xrᵀ + J_z R J_zᵀ (16), P_rn = P_rr J_xrᵀ (17), P_ni = J_xr (P_ri)ᵀ
# (18).
#
# **Predict** which of the three agree with the block product above.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
blocks = sp.block_collapse(grow * before * grow.T).blocks
print("(16):", blocks[2, 2] == JXR * P_rr * JXR.T + JZ * RR * JZ.T)
print("(17):", blocks[0, 2] == P_rr * JXR.T)
try:
    JXR * P_ri.T
except sp.matrices.exceptions.ShapeError:
    print("(18): refused,", JXR.shape, "times", P_ri.T.shape)
errata["Smolec (18), P_ni"] = {
    "printed": sp.Symbol("J_{xr} (P_{ri})^T"),
    "derived": sp.Symbol("J_{xr} P_{ri}"),
    "difference": "2×3 times 2×3: does not multiply",
}
harm("Smolec (18), P_ni", "stops, or, with a block stored transposed, is right by accident")

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## MAK (4.9): a row that lost its robot
#
# In SLAM, H spans the whole state: robot, landmark 1, landmark 2, … The thesis prints for landmark
# 3: H₃ = [0 0 H_r H_p 0 …].
#
# **Predict** the blocks of H₃. Then let the machine differentiate by a state of four landmarks:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
marks = [sp.symbols(f"p{i}_x p{i}_y", real=True) for i in (1, 2, 3, 4)]
third = h.subs(dict(zip(landmark, marks[2], strict=True)))
names = {"robot": pose, **{f"p{i}": mark for i, mark in enumerate(marks, 1)}}
filled = {name: not third.jacobian(part).is_zero_matrix for name, part in names.items()}
print(filled)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
H_r, H_p = sp.symbols("H_r H_p")
blocks = [(H_r if name == "robot" else H_p) if yes else 0 for name, yes in filled.items()]
difference = compare("MAK (4.9), H₃", sp.Matrix([[0, 0, H_r, H_p, 0]]), sp.Matrix([blocks]))
harm("MAK (4.9), H₃", "H_r has 3 columns, a landmark's place 2: does not fit")
difference

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## All of them, by machine
#
# The table is built from what the cells above found. Where shapes do not fit there is no
# difference to form, and words say so.


# %% slideshow={"slide_type": "fragment"}
def tex(entry):
    """LaTeX of a formula; a sentence stays a sentence."""
    if isinstance(entry, str):
        return entry
    zero = isinstance(entry, sp.MatrixBase) and entry.is_zero_matrix
    return "$0$" if zero else f"${sp.latex(entry, mat_str='smallmatrix')}$"


def table(places):
    lines = ["| formula, harm | printed, derived | difference |", "|---|---|---|"]
    for where in places:
        found = errata[where]
        both = f"{tex(found['printed'])}<br><br>{tex(found['derived'])}"
        cells = f"**{where}**<br>{found['harm']}", both, tex(found["difference"])
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


places = list(errata)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
Markdown(table(places[:3]))

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
Markdown(table(places[3:7]))

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
Markdown(table(places[7:10]))

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
Markdown(table(places[10:13]))

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
Markdown(table(places[13:]))

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** where the difference is zero, the print is right: A of §4.1, and (3) once (2) is mended.
# What does not multiply is harmless: it stops at once. The others run, draw an ellipse, and are
# wrong; only a test finds them.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask: which of these would you have found by reading? And which by driving a
# robot? The rank of Q and the sign in A pass every quick look at a plot. Homework: take the
# EKF-SLAM you used last year and hold its Jacobians against differences.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## What you can do now
#
# Derive a Jacobian, test it in three ways, and tell from a formula's units and shapes that
# something is off before the robot finds out.
#
# **Next:** lesson 05 puts H and A to work in two easy halves: where am I in a known map, and where
# are the landmarks if I know where I am?
#
# **Exercise:** [write H, J_xr, J_z and a new landmark's covariance, derive the Jacobian of a
# camera that is in no book, and beat the linearised step where it
# fails](../exercises/ex04_models_and_jacobians.ipynb). The models judge them, not a stored answer.
