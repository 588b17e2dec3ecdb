# %% [markdown] slideshow={"slide_type": "slide"}
# # 06 · EKF-SLAM: the MAK filter
#
# **You will be able to** build EKF-SLAM from nothing: predict, augment and update a state that
# holds the robot *and* its landmarks, say for every block of the covariance where it comes from,
# and tell what happens when one is forgotten.
#
# **80 minutes** (45 to build the filter, 35 to drive it, break it and weigh it). **Before:**
# lessons 03 (update, NEES), 04 (H, A, J_xr, J_z) and 05 (two halves that cannot be kept apart).
#
# Sources: MAK thesis, 4.3.1 and 4.3.2; Smolec, sections 2.6, 4.1 and 5; the EKF note.
#
# *Key:* one state, one covariance: what robot and map share is kept, not guessed.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The first half is the filter, and each of its three functions is derived in
# front of the class with block matrices; have them name each block before it is printed. The
# second half is a loop, driven with the class they have just seen grow. MAK means map-augmented
# Kalman filter; elsewhere it is called EKF-SLAM.

# %% slideshow={"slide_type": "skip"}
import numpy as np
import sympy as sp

from slamlab import evaluation, models, views
from slamlab.models import jacobians
from slamlab.estimators import Estimator
from slamlab.estimators.mak_slam import MakSlam, Q_arc
from slamlab.filters import MAK
from slamlab.geometry import compose, wrap
from slamlab.layers import Ellipses, Points, Poses, Segments
from slamlab.estimators import run
from slamlab.sources.landmark_runs import LandmarkRun, Loop

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Two errors in one innovation
#
# In lesson 05 either the map or the pose was known. In SLAM neither is. A robot that believes to be
# at x̂ sees landmark i, believed at p̂, and forms v = z − h(x̂, p̂).
#
# **Question.** Which errors are in v?
#
# **Predict** how many terms its covariance S has.

# %% [markdown] slideshow={"slide_type": "fragment"}
# To first order v = H_r x̃ + H_p p̃ + w: the robot's error, the landmark's, the sensor's. The first
# two have the covariance

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
P_rr, P_ri, P_ii, R = (
    sp.MatrixSymbol(name, *shape)
    for name, shape in [("P_rr", (3, 3)), ("P_ri", (3, 2)), ("P_ii", (2, 2)), ("R", (2, 2))]
)
H_r, H_p = sp.MatrixSymbol("H_r", 2, 3), sp.MatrixSymbol("H_p", 2, 2)
P = sp.BlockMatrix([[P_rr, P_ri], [P_ri.T, P_ii]])
P

# %% [markdown] slideshow={"slide_type": "fragment"}
# and v has the Jacobian [H_r H_p] by them. So S = H P Hᵀ + R is

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
H = sp.BlockMatrix([[H_r, H_p]])
sp.expand(sp.block_collapse(H * P * H.T) + R)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Five terms, and two of them hold P_ri. Two separate filters, one for the pose and one for the
# landmark, have no P_ri: for them these terms are zero.

# %% [markdown] slideshow={"slide_type": "slide"}
# **Question.** Does it matter? A robot unsure of its pose places a landmark 5 m away and at once
# looks again. **Predict** how large the second look's innovation is: as large as the pose's doubt
# makes it, or as small as the sensor's noise?

# %% slideshow={"slide_type": "fragment"}
rng = np.random.default_rng(6)
believed, seen = np.array([0, 0, 0.4]), np.array([5.0, 0.8])
P_pose, R_look = np.diag([0.15, 0.15, 0.08]) ** 2, np.diag([0.1, 0.02]) ** 2
placed = models.g(believed, seen)
true_poses = rng.multivariate_normal(believed, P_pose, 1000)
first, second = rng.multivariate_normal([0, 0], R_look, (2, 1000))
true_landmarks = np.array([models.g(x, seen - w) for x, w in zip(true_poses, first, strict=True)])
pairs = zip(true_poses, true_landmarks, second, strict=True)
v = np.array([models.h(x, p) + w - models.h(believed, placed) for x, p, w in pairs])
v[:, 1] = wrap(v[:, 1])

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
J_xr, J_z = jacobians.J_xr(believed, seen), jacobians.J_z(believed, seen)
Hr, Hp = jacobians.H_robot(believed, placed), jacobians.H_landmark(believed, placed)
P_new, P_both = J_xr @ P_pose @ J_xr.T + J_z @ R_look @ J_z.T, P_pose @ J_xr.T
apart = Hr @ P_pose @ Hr.T + Hp @ P_new @ Hp.T + R_look
together = apart + Hr @ P_both @ Hp.T + Hp @ P_both.T @ Hr.T
for name, S in [("without P_ri", apart), ("with P_ri", together), ("1000 robots", np.cov(v.T))]:
    print(f"{name:13} σ of range {np.sqrt(S[0, 0]):.2f} m, of bearing {np.sqrt(S[1, 1]):.3f} rad")

# %% [markdown] slideshow={"slide_type": "fragment"}
# As small as the sensor's noise (twice its variance: two looks). The landmark errs *with* the robot,
# and the innovation sees only the difference. Without P_ri a filter expects a bearing off by four
# times as much, and when a small innovation comes it believes to have learned how right its pose
# is. It has learned nothing of the kind.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Say it with a boat: you are lost at sea, throw a buoy overboard and measure
# your distance to it. However often you measure, you do not know where you are.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## The augmented state
#
# So the innovation depends on an error that no single filter holds. The MAK thesis' way out (its
# (4.1), (4.2)): make *one* state of it all,
#
# $$x = \begin{bmatrix} x_r \\ p_1 \\ \vdots \\ p_N \end{bmatrix}, \qquad
# P = \begin{bmatrix} P_{rr} & P_{r1} & \cdots & P_{rN} \\ P_{1r} & P_{11} & \cdots & P_{1N} \\
# \vdots & \vdots & \ddots & \vdots \\ P_{Nr} & P_{N1} & \cdots & P_{NN} \end{bmatrix}$$
#
# Now the innovation depends on the error of *the state* and on noise, no more: COIN holds again,
# and lesson 03's filter may be used as it is. What is left is to say what its matrices look like.

# %% [markdown] slideshow={"slide_type": "fragment"}
# | step | when | what it does to the state |
# | --- | --- | --- |
# | **predict** | the robot moved | robot's part changes |
# | **update** | a known landmark was seen | everything changes |
# | **augment** | a new landmark was seen | two numbers are appended |

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Predict: landmarks stand still
#
# The robot drives, the map does not: x_r ← f(x_r, u), p_i ← p_i.
#
# **Question.** What is the Jacobian F of that, for a state of robot r and landmarks i, j?
#
# **Predict** which blocks of F P Fᵀ + Q differ from those of P.

# %% slideshow={"slide_type": "fragment"}
A, Q = sp.MatrixSymbol("A", 3, 3), sp.MatrixSymbol("Q", 3, 3)
P_rj, P_ij, P_jj = (
    sp.MatrixSymbol(name, *shape)
    for name, shape in [("P_rj", (3, 2)), ("P_ij", (2, 2)), ("P_jj", (2, 2))]
)
O, I = sp.ZeroMatrix, sp.Identity
P = sp.BlockMatrix([[P_rr, P_ri, P_rj], [P_ri.T, P_ii, P_ij], [P_rj.T, P_ij.T, P_jj]])

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
F = sp.BlockMatrix([[A, O(3, 2), O(3, 2)], [O(2, 3), I(2), O(2, 2)], [O(2, 3), O(2, 2), I(2)]])
moved = sp.block_collapse(F * P * F.T).blocks
moved

# %% [markdown] slideshow={"slide_type": "fragment"}
# Q, the noise of the motion, is the robot's alone: it adds to the corner. So
#
# - P_rr ← A P_rr Aᵀ + Q: as in lesson 04,
# - P_ri ← A P_ri: what robot and landmark share is swung by A, without any noise,
# - P_ii, P_ij: untouched. Driving tells nothing about the map.

# %% [markdown] slideshow={"slide_type": "fragment"}
# Smolec says "P is updated with A" and writes neither Q nor the cross blocks down.


# %% slideshow={"slide_type": "fragment"}
def predict(x, P, odometry, Q):
    """Drive: odometry (3,) is the motion in the robot's own frame, Q its covariance."""
    x, P = x.copy(), P.copy()
    moved = compose(x[:3], odometry)
    dx, dy = moved[:2] - x[:2]
    A = np.array([[1, 0, -dy], [0, 1, dx], [0, 0, 1]])
    x[:3] = moved
    P[:3, :3] = A @ P[:3, :3] @ A.T + Q
    P[:3, 3:] = A @ P[:3, 3:]
    P[3:, :3] = P[:3, 3:].T
    return x, P


# %% [markdown] slideshow={"slide_type": "fragment"}
# A is lesson 04's: the step turned by 90°, whatever the robot is driven by.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## What predicting costs
#
# **Question.** P has (3 + 2N)² numbers. How many does `predict` touch?
#
# **Predict** for N = 100 landmarks: some 40 000, some 1000, nine?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
rng = np.random.default_rng(6)
step, Q_step = np.array([0.3, 0.01, 0.1]), np.diag([0.02, 0.01, 0.012]) ** 2
for N in (1, 10, 100, 1000):
    n = 3 + 2 * N
    before = np.eye(n) + 0.1
    _, after = predict(rng.standard_normal(n), before, step, Q_step)
    print(f"N = {N:4}: {np.sum(after != before):5} changed of {n * n:7}; 9 + 8 N = {9 + 8 * N}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# O(N), a stripe along two edges: the corner's 9, and of each landmark's 12 the 8 with the robot's x
# and y. (What it shares with the heading stays, since A's last row is 0 0 1.) Whoever multiplies
# F P Fᵀ as full matrices pays O(N³) for the same numbers.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask: does driving change the *correlation* of robot and landmark? A P_ri
# hardly changes, yet P_rr grows by Q, so the correlation falls. Driving forgets, by noise.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Augment: a landmark is born
#
# A new landmark n is placed at g(x_r, z). Its error comes from the pose, by J_xr, and from the
# measurement, by J_z. Nobody else moves.
#
# **Question.** Write [x_r, p_i, p_n] as a function of [x_r, p_i, z]. What is its Jacobian?
#
# **Predict** P_ni: the new landmark and an old one have never been seen together. Is it zero?

# %% slideshow={"slide_type": "fragment"}
JXR, JZ = sp.MatrixSymbol("J_xr", 2, 3), sp.MatrixSymbol("J_z", 2, 2)
grow = sp.BlockMatrix([[I(3), O(3, 2), O(3, 2)], [O(2, 3), I(2), O(2, 2)], [JXR, O(2, 2), JZ]])
before = sp.BlockMatrix([[P_rr, P_ri, O(3, 2)], [P_ri.T, P_ii, O(2, 2)], [O(2, 3), O(2, 2), R]])
after = sp.block_collapse(grow * before * grow.T).blocks

# %% [markdown] slideshow={"slide_type": "fragment"}
# The measurement's noise is new, it shares nothing with the state: hence the zeros in `before`.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
after[2, 2]

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
after[2, 0]

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
after[2, 1]

# %% [markdown] slideshow={"slide_type": "fragment"}
# P_nn is (16) of Smolec's, P_nr the transpose of his (17). P_ni is not zero: whatever the robot
# shares with landmark i, it hands on. One rule for both: **the new rows are J_xr times the robot's
# rows**, P_n· = J_xr P_r·.


# %% slideshow={"slide_type": "fragment"}
def augment(x, P, z, R):
    """A landmark seen for the first time, at z = [r, β], is appended."""
    J_xr, J_z = jacobians.J_xr(x[:3], z), jacobians.J_z(x[:3], z)
    row = J_xr @ P[:3]
    P_nn = J_xr @ P[:3, :3] @ J_xr.T + J_z @ R @ J_z.T
    return np.append(x, models.g(x[:3], z)), np.block([[P, row.T], [row, P_nn]])


# %% [markdown] slideshow={"slide_type": "slide"}
# ## Smolec's (18), and a trap
#
# Printed: P_ni = J_xr (P_ri)ᵀ. **Predict** what the machine says to that, with P_ri as it stands in
# P, and with the block below the diagonal.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
names = {"J_xr P_ri": P_ri, "J_xr (P_ri)ᵀ, as printed": P_ri.T, "J_xr (P_ir)ᵀ": P_ri.T.T}
for name, block in names.items():
    try:
        print(f"{name:24} {(JXR * block).shape}")
    except sp.matrices.exceptions.ShapeError:
        print(f"{name:24} {JXR.shape} times {block.shape}: refused")

# %% [markdown] slideshow={"slide_type": "fragment"}
# (18) is right only for who stores the block below the diagonal under the name of the one above.
# The trap: with a state whose blocks are square, all of these multiply, and one is wrong.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Do 2000 robots agree?
#
# A robot knows landmark i (they share an error) and now places n. **Question.** The errors of i and
# of n: do they hang together as the formula says, though no sensor ever saw the two at once?

# %% slideshow={"slide_type": "fragment"}
rng = np.random.default_rng(6)
R_sharp = np.diag([0.05, 0.01]) ** 2
x, P = augment(np.array([0, 0, 0.4]), np.diag([0.15, 0.15, 0.06]) ** 2, [4.0, 0.8], R_sharp)
x, P = predict(x, P, np.array([1.0, 0.1, 0.2]), Q_step)
z = np.array([3.0, -0.9])
x_grown, P_grown = augment(x, P, z, R_sharp)
true_states = rng.multivariate_normal(x, P, 2000)
sights = rng.multivariate_normal(z, R_sharp, 2000)
born = np.array([models.g(s[:3], w) for s, w in zip(true_states, sights, strict=True)])
samples = np.hstack([true_states, born])

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
sigma = np.sqrt(np.diag(P_grown))
off = np.abs(np.cov(samples.T) - P_grown) / np.outer(sigma, sigma)
for name, block in {"P_nn": np.s_[5:, 5:], "P_nr": np.s_[5:, :3], "P_ni": np.s_[5:, 3:5]}.items():
    print(f"{name}: samples and formula differ by {off[block].max():.2f} of the two σ, at most")

# %% slideshow={"slide_type": "slide"}
pair = [4, 6]  # the y of landmark i and the y of landmark n
independent = np.diag(np.diag(P_grown)[pair])
claims = {"P with P_ni": P_grown[np.ix_(pair, pair)], "P_ni forgotten": independent}
fig, ax = views.cloud(samples[:500, pair], claims, "An old landmark and a new one", size=(5, 4))
ax.set(xlabel="y of landmark i [m]", ylabel="y of landmark n [m]")
views.show(
    fig,
    "Samples form a leaning streak that the ellipse with P_ni covers and a straight "
    "one without it does not.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the streak leans: where landmark i lies farther up than believed, so does n. They share
# the robot that placed them. The dashed ellipse, without P_ni, allows what never happens (upper
# left) and cuts off what does.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## The covariance grows, as a picture
#
# A small story: the robot starts exactly known, sees landmark a, drives on, sees b. We draw the
# *correlations* P_ij / (σ_i σ_j): they have no unit, so x, θ and landmarks fit into one picture.
#
# **Predict** at which of the three moments robot and a, robot and b, a and b get a colour.

# %% slideshow={"slide_type": "fragment"}
stages = {}
Q_slip = np.diag([0.05, 0.03, 0.02]) ** 2
x, P = augment(np.zeros(3), np.zeros((3, 3)), [2.0, 0.9], R_sharp)
stages["a placed"] = P
for _ in range(10):
    x, P = predict(x, P, step, Q_slip)
stages["3 m driven"] = P
x, P = augment(x, P, [2.5, 0.5], R_sharp)
stages["b placed"] = P
story = x, P


# %% slideshow={"slide_type": "fragment"}
def strip(stages, names, size=(11, 3.6)):
    """Correlation matrices of several covariances, side by side."""
    fig, all_axes = views.panels(list(stages), size, shared=False)
    for ax, P in zip(all_axes, stages.values(), strict=True):
        blocks = names[: 1 + (len(P) - 3) // 2]
        views.correlation(evaluation.correlation(P), blocks, ax=ax)
        ax.set_aspect("equal", adjustable="box")
        ax.set(xlabel=None, ylabel=None)
    return fig


# %% slideshow={"slide_type": "slide"}
views.show(
    strip(stages, ["robot", "a", "b"]),
    "Three correlation matrices: first only a's own block has a colour; after driving the robot's "
    "own block, too; then b, coloured against the robot and white against a.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** from an exact pose, a is born without relatives: its error is the sensor's alone. Driving
# colours the robot's own block (heading and place err together) and nothing else. b is born a
# relative of the robot, and still a stranger to a: the robot has nothing of a's error to hand on.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask what has to happen for the last white block, a and b, to get a colour.
# Seeing a again will do it: that is the update, next.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Update: H over the whole state
#
# Landmark j of N is seen. h depends on the pose and on p_j only.
#
# **Predict** the shape of H for N = 4, and which of its columns are not zero when the third
# landmark is seen.


# %% slideshow={"slide_type": "fragment"}
def H_of(x, j):
    """The Jacobian of the sight of landmark j (0, 1, …) by the whole state: (2, 3 + 2N)."""
    at = 3 + 2 * j
    p = x[at : at + 2]
    H = np.zeros((2, len(x)))
    H[:, :3] = jacobians.H_robot(x[:3], p)
    H[:, at : at + 2] = jacobians.H_landmark(x[:3], p)
    return H


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
four = np.array([1.2, -0.7, 0.9, 3.0, 1.0, -2.0, 2.0, -1.5, 2.2, 0.5, -3.0])
H_of(four, 2).round(2)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Trust nothing: move each of the eleven numbers by a little and see what the model does.


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
def slopes(f, x, step=1e-6):
    """∂f/∂x by differences, as in lesson 04."""
    return np.column_stack([(f(x + e) - f(x - e)) / (2 * step) for e in step * np.eye(len(x))])


by_differences = slopes(lambda x: models.h(x[:3], x[7:9]), four)
print("H − differences:", f"{np.abs(H_of(four, 2) - by_differences).max():.6f}")
print("columns that are not zero:", np.flatnonzero(np.abs(by_differences).max(axis=0) > 1e-9))

# %% [markdown] slideshow={"slide_type": "fragment"}
# H = [H_r 0 0 H_p 0]. The thesis prints [0 0 H_r H_p 0 …] in (4.9). Read as blocks, that does not
# even fit: H_r is three wide and would stand in a landmark's place of two. **The robot comes first
# in the state, so H_r comes first in H, whichever landmark is seen.**

# %% [markdown] slideshow={"slide_type": "slide"}
# ## The gain: who learns?
#
# Landmark i is seen, j is not. K = P Hᵀ S⁻¹, with a row of blocks for each part of the state.
#
# **Question.** H is zero at j. Is K?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
P = sp.BlockMatrix([[P_rr, P_ri, P_rj], [P_ri.T, P_ii, P_ij], [P_rj.T, P_ij.T, P_jj]])
H = sp.BlockMatrix([[H_r, H_p, O(2, 2)]])
PHt = sp.block_collapse(P * H.T).blocks
PHt[0, 0]

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
PHt[1, 0]

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
PHt[2, 0]

# %% [markdown] slideshow={"slide_type": "fragment"}
# These are the rows for robot, i and j, each still to be multiplied by S⁻¹. The last one: j learns
# through P_jr, what it shares with the robot, and through P_ji, what it shares with i. Only who is
# related to neither learns nothing. All of it, in ten lines, for one or for many landmarks of a
# scan:

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Three things usually go wrong here: the bearing of v is not wrapped; the
# heading is not wrapped after the correction; K is applied to the robot and the seen landmark only.
# The exercise's check finds the first and the last. The second it lets pass: headings that differ
# by 2π are the same heading, and whoever wraps v never notices.


# %% slideshow={"slide_type": "fragment"}
def update(x, P, seen, z, R):
    """Landmarks `seen` (m indices) were seen again at z (m, 2): all of them at once."""
    H = np.vstack([H_of(x, j) for j in seen])
    v = z - models.h(x[:3], x[3:].reshape(-1, 2)[seen])
    v[:, 1] = wrap(v[:, 1])
    S = H @ P @ H.T + np.kron(np.eye(len(seen)), R)
    K = P @ H.T @ np.linalg.inv(S)
    x = x + K @ v.ravel()
    x[2] = wrap(x[2])
    return x, P - K @ S @ K.T


# %% [markdown] slideshow={"slide_type": "slide"}
# ## Predict who moves
#
# Back to the story: the robot turned round, drives back, and sees a again, 0.2 rad to the left of
# where it expected it.
#
# **Predict** from the last picture: does b move, though nobody looked at it? And does b become
# surer?

# %% slideshow={"slide_type": "fragment"}
x, P = predict(*story, np.array([0, 0, np.pi]), Q_slip)
for _ in range(5):
    x, P = predict(x, P, step * [1, 1, 0], Q_slip)
z = models.h(x[:3], x[3:5]) + np.array([0.0, 0.2])
x_after, P_after = update(x, P, [0], z[None], R_sharp)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
H = H_of(x, 0)
K = P @ H.T @ np.linalg.inv(H @ P @ H.T + R_sharp)
sigma, sigma_after = np.sqrt(np.diag(P)), np.sqrt(np.diag(P_after))
for name, rows in {"robot": np.s_[:2], "a": np.s_[3:5], "b": np.s_[5:7]}.items():
    print(
        f"{name:5} largest entry of K {np.abs(K[rows]).max():.2f},"
        f" moves {100 * np.hypot(*(x_after - x)[rows]):2.0f} cm,"
        f" σ {100 * np.hypot(*sigma[rows]):.0f} → {100 * np.hypot(*sigma_after[rows]):.0f} cm"
    )

# %% slideshow={"slide_type": "slide"}
fig, ax = views.axes("Landmark a was seen again", size=(7, 4.2))
for name, (mean, cov) in {"naive": (x, P), "corrected": (x_after, P_after)}.items():
    parts = [slice(0, 2), slice(3, 5), slice(5, 7)]
    layer = Ellipses(name, [mean[s] for s in parts], [cov[s, s] for s in parts])
    when, line = ("before", "dashed") if name == "naive" else ("after", "solid")
    views.draw(ax, layer, label=when, linestyle=line)
ways = [[*x[s], *x_after[s]] for s in parts]
views.draw(ax, Segments("truth", ways), linewidth=2.5, label="moved")
for name, s in zip(["robot", "a", "b"], parts, strict=True):
    ax.annotate(name, x_after[s], xytext=(18, 12), textcoords="offset points", fontsize=12)
for line, style in zip(views.legend(ax).legend_handles, ["dashed", "solid"], strict=False):
    line.set_linestyle(style)
views.show(
    fig,
    "Ellipses before and after: those of the robot and of b shrink and move, that of "
    "a stays nearly as it was.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** b moved and its ellipse shrank, unseen: it had been placed by the robot, and the robot
# learned how wrong it was. a hardly moved: it was the sure one. The information came from a and
# went to who needed it.

# %% slideshow={"slide_type": "slide"}
views.show(
    strip({"before a is seen again": P, "after": P_after}, ["robot", "a", "b"], size=(8, 3.8)),
    "Correlations before the update, where a is white against all others, and after it, where "
    "every block has a colour.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** after one update no block is white. Everyone is now related to everyone, and it stays so:
# this is why P cannot be kept as N little matrices. Lesson 07 asks what happens if one tries.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## The whole filter
#
# Three functions, some thirty lines. What is left is to call them in the right order, and to know
# which landmark stands where.


# %% slideshow={"slide_type": "fragment"}
class TextbookSlam(Estimator):
    """EKF-SLAM with known ids, from the three functions above."""

    def __init__(self, robot, sensor):
        super().__init__()
        self.x, self.P, self.ids = np.zeros(3), np.zeros((3, 3)), []
        self.robot, self.R = robot, np.diag([sensor.range_sigma, sensor.bearing_sigma]) ** 2

    def step(self, reading):
        seen = reading.observations
        known = np.isin(seen.ids, self.ids)
        self.move(reading.odometry)
        self.see(seen.ids[known], seen.z[known])
        self.place(seen.ids[~known], seen.z[~known])
        self.pose = self.x[:3]
        self.record(reading.time)

    def move(self, odometry):
        Q = Q_arc(self.x[:3], odometry, self.robot)
        self.x, self.P = predict(self.x, self.P, odometry, Q)

    def see(self, ids, z):
        if len(ids):
            rows = [self.ids.index(i) for i in ids]
            self.x, self.P = update(self.x, self.P, rows, z, self.R)

    def place(self, ids, z):
        for i, one in zip(ids, z, strict=True):
            self.x, self.P = augment(self.x, self.P, one, self.R)
            self.ids.append(i)


# %% [markdown] slideshow={"slide_type": "fragment"}
# Q_arc is W C Wᵀ, lesson 04's Q, for a robot that drives arcs.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Round a loop
#
# `sim:landmarks` is a circle of 4 m radius with twenty landmarks; the robot sees 2.5 m far. One
# round takes 84 steps, we drive 100.
#
# **Question.** New landmarks come into view and old ones go out of it. **Predict** the robot's error
# over the steps, beside odometry's: always small, growing, growing and then not?

# %% slideshow={"slide_type": "fragment"}
LOOP, SEED = Loop(steps=100), 16
source = LandmarkRun(LOOP, np.random.default_rng(SEED))
kept = []  # x, P and ids after every step


def keep(reading, slam):
    kept.append((slam.x.copy(), slam.P.copy(), list(slam.ids)))


result = run(source, TextbookSlam(source.robot, source.sensor), keep)


# %% slideshow={"slide_type": "slide"}
truth = source.truth.poses[:, :2]
errors = {
    "the filter's error": np.hypot(*(result.trajectory.poses[:, :2] - truth).T),
    "odometry's error": np.hypot(*(result.naive.poses[:, :2] - truth).T),
    "the filter's σ": [np.sqrt(np.trace(P[:2, :2])) for _, P, _ in kept],
}
fig, ax = views.curves(np.arange(101), errors, "step", "position [m]", size=(6.5, 3.2))
own = errors["the filter's error"]
views.show(
    fig,
    f"The filter's error grows to {own.max():.1f} m at step {own.argmax()} and falls to "
    f"{100 * own[-1]:.0f} cm, its σ with it; odometry's error goes on growing.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** while all landmarks are new the filter drifts, here for fifty steps slower than odometry
# and in the end as far: a map of its own making cannot tell it where it is. It knows that: σ grows
# along with the error. Then, at step 71, something happens that odometry has no part in.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## The loop closes
#
# The robot has come nearly round, and the landmarks it saw first come into view again.
#
# **Predict** which ellipses shrink: those of the landmarks seen now, those of the last ones, all?


# %% slideshow={"slide_type": "fragment"}
def picture(k):
    """Layers of the map after step k."""
    x, P, ids = kept[k]
    marks = [slice(i, i + 2) for i in range(3, len(x), 2)]
    return [
        Points("truth", source.landmarks[ids]),
        Ellipses("landmark", [x[s] for s in marks], [P[s, s] for s in marks]),
        Poses("truth", source.truth.poses[: k + 1]),
        Poses("naive", result.naive.poses[: k + 1]),
        Poses("corrected", result.trajectory.poses[: k + 1]),
        Ellipses("robot", [x[:2]], [P[:2, :2]]),
    ]


NAMES = {"landmark": "landmarks, 95 %", "robot": "robot, 95 %", "naive": "odometry alone"}


def draw_map(ax, k):
    for layer in picture(k):
        if isinstance(layer, Points):
            views.draw(ax, layer, marker="+", mew=1, markersize=7, label="true landmarks")
        else:
            views.draw(ax, layer, label=NAMES.get(layer.name, layer.name))


# %% slideshow={"slide_type": "fragment"}
first_again = next(
    k for k in range(40, 101) if set(source.seen(source.truth.poses[k])) & set(kept[0][2])
)
before, after = first_again - 1, first_again + 5

# %% slideshow={"slide_type": "slide"}
titles = [f"step {before}: about to close", f"step {after}: closed"]
fig, all_axes = views.panels(titles, size=(9.6, 3.8))
for ax, k in zip(all_axes, (before, after), strict=True):
    draw_map(ax, k)
views.legend(all_axes[1], loc="upper left", bbox_to_anchor=(1, 1))
views.show(fig, "Before, the ellipses grow along the round; six scans later all of them are small.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** six scans, and every ellipse has shrunk: those on the far side too, which the robot has
# not seen for forty steps. The first landmarks are the surest of the map; the robot meets them,
# learns its own error, and with it the error of all that it placed on the way. By how much, told in
# the order in which they were found:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
(x0, P0, ids0), (x1, P1, _) = kept[before], kept[after]


def areas(P):
    """The areas of the landmarks' ellipses, but for a factor."""
    return np.sqrt([np.linalg.det(P[i : i + 2, i : i + 2]) for i in range(3, len(P0), 2)])


shrunk = 1 - areas(P1) / areas(P0)
print(f"{np.sum(shrunk > 0)} of {len(ids0)} ellipses shrank; by (first to last found)")
print(" ".join(f"{share:.0%}" for share in shrunk))
error = [np.hypot(*(x[:2] - source.truth.poses[k][:2])) for x, k in ((x0, before), (x1, after))]
print(f"the robot's error fell from {100 * error[0]:.0f} cm to {100 * error[1]:.0f} cm")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Who was placed late, by a robot far from sure, learns most; the first ones had little to learn.

# %% slideshow={"slide_type": "slide"}
stages = {f"step {k}": kept[k][1] for k in (before, after)}
order = [str(i) for i in ids0]
views.show(
    strip(stages, ["robot", *order], size=(7, 3.9)),
    "Correlation matrices before and after closing the loop: pale among the first "
    "landmarks, deep colours among the later ones, and many blocks changed by the closing.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** landmarks stand in the order in which they were found. The first ones, placed from a pose
# almost exact, are pale: they share little. The later ones share the error that the robot had by
# then, and are the closer relatives the later they came. Closing the loop changes them all, also
# pairs that were never in view together.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* This is the moment of the lesson; leave time for it. Ask: could a program
# that stores each landmark with its own 2×2 covariance do that? It could shrink what it sees.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Break it: what is printed
#
# Smolec's (15) reads X = K · innovation, without the old X, and his text never updates P.
#
# **Predict** both: what does the map look like, and what does the robot believe of its error?


# %% slideshow={"slide_type": "fragment"}
class Forgets(TextbookSlam):
    """(15) as printed: X = K · innovation."""

    def see(self, ids, z):
        x = self.x
        super().see(ids, z)
        if len(ids):
            self.x = self.x - x


class NeverSure(TextbookSlam):
    """P is not updated."""

    def see(self, ids, z):
        P = self.P
        super().see(ids, z)
        self.P = P


# %% slideshow={"slide_type": "fragment"}
def weigh(make, seeds=range(20), loop=LOOP):
    """Mean over runs: landmark error [m], robot's error [m], its claimed σ [m], NEES, at the end."""
    rows = []
    for seed in seeds:
        source = LandmarkRun(loop, np.random.default_rng(seed))
        slam = run(source, make(source.robot, source.sensor)).estimator
        off = slam.x[3:].reshape(-1, 2) - source.landmarks[slam.ids]
        error = slam.x[:3] - source.truth.poses[-1]
        error[2] = wrap(error[2])
        P = slam.P[:3, :3]
        rows.append(
            [
                np.sum(off**2, axis=1).mean(),
                np.sum(error[:2] ** 2),
                np.trace(P[:2, :2]),
                evaluation.nees(error, P),
            ]
        )
    squares = np.mean(rows, axis=0)
    return [*np.sqrt(squares[:3]), squares[3]]


def tell(makers):
    print(f"{'':34} map [m]  robot [m]  claimed [m]   NEES")
    for name, make in makers.items():
        *metres, nees = weigh(make)
        # beyond, P is nearly singular: the last digits are this processor's rounding
        told = f"{nees:6.1f}" if nees < 1000 else "> 1000"
        print("{:34} {:7.2f} {:10.2f} {:12.2f} {}".format(name, *metres, told))


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
tell(
    {
        "the filter": TextbookSlam,
        "(15) as printed, X = K · innovation": Forgets,
        "P is never updated": NeverSure,
    }
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** with (15) every update throws the whole state to near zero, the robot and the map with
# it: the error is the size of the loop. Without the update of P the filter stays as unsure as
# odometry is and listens to each new measurement as if it knew nothing: NEES far *below* 3 tells
# of a filter that claims too little, and its map is worse.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## The order matters
#
# In Smolec's program predict() is called *after* the association of landmarks. The robot has moved,
# its measurement is new, its pose in the state is still the old one.
#
# **Predict:** what is wrong with a landmark placed then, and by how much? (A step is 0.3 m.)


# %% slideshow={"slide_type": "fragment"}
class PlacesFirst(TextbookSlam):
    """New landmarks are placed before the robot's pose is predicted."""

    def step(self, reading):
        seen = reading.observations
        known = np.isin(seen.ids, self.ids)
        self.place(seen.ids[~known], seen.z[~known])
        self.move(reading.odometry)
        self.see(seen.ids[known], seen.z[known])
        self.pose = self.x[:3]
        self.record(reading.time)


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
tell({"predict, update, augment": TextbookSlam, "augment, predict, update": PlacesFirst})

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** each landmark starts a step behind, turned by the step's turn as well, and P says nothing
# of it. The filter believes its map and bends the robot to it: NEES is far above 3. The error is no
# noise: it is the same at each sight, so it does not average out.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Smolec's program stands in figures only; what it does is told by its line
# numbers and prose. Say "probably". Such a bug survives because the map still looks like a map.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## May P start at zero?
#
# Ours does: the robot stands where it starts, by definition, so nothing is in doubt. Smolec warns of
# it (§2.6): without some doubt on P's diagonal a *singular* matrix often turns up, so put some
# there, even if you believe the start.
#
# **Question.** What does the filter invert? **Predict** what changes if the robot starts with 10 cm
# and 5° of doubt: its error, what it claims, how sure it is of the distance of two landmarks?


# %% slideshow={"slide_type": "fragment"}
class StartsInDoubt(TextbookSlam):
    """P starts with 10 cm and 5° on its diagonal."""

    def __init__(self, robot, sensor):
        super().__init__(robot, sensor)
        self.P = np.diag([0.1, 0.1, np.radians(5)]) ** 2


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
tell({"P starts at zero": TextbookSlam, "P starts at 10 cm, 5°": StartsInDoubt})

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
exact, doubting = (
    run(source, make(source.robot, source.sensor)).estimator
    for make in (TextbookSlam, StartsInDoubt)
)
maps = [slam.x[3:].reshape(-1, 2) for slam in (exact, doubting)]
shapes = [np.hypot(*(m[:, None] - m).T) for m in maps]  # all distances within each map
print(f"landmarks up to {100 * np.hypot(*(maps[0] - maps[1]).T).max():.0f} cm apart,", end=" ")
print(f"distances between two of them up to {100 * np.abs(shapes[0] - shapes[1]).max():.0f} cm")
D = np.hstack([-np.eye(2), np.eye(2)])  # of the first two landmarks: p_b − p_a
for name, P in (("zero", exact.P), ("10 cm", doubting.P)):
    ab = P[3:7, 3:7]
    place, apart = np.sqrt(np.trace(ab[:2, :2])), np.sqrt(np.linalg.eigvalsh(D @ ab @ D.T)[0])
    print(f"P from {name:5}: σ of a's place {100 * place:4.1f} cm, of a to b {100 * apart:.1f} cm")
try:
    np.linalg.inv(np.zeros((3, 3)))
except np.linalg.LinAlgError as error:
    print("P⁻¹ at the start:", error)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** what is inverted is S = H P Hᵀ + R, and R alone keeps S regular; in neither run is
# anything singular. P itself is, at the start: who inverts P (lesson 03's NEES, or a filter that
# carries P⁻¹) has to wait for the first steps, as we do. And the doubt buys nothing here: both maps
# have the same shape and are as sure of it, but the second is moved and turned as a whole, so its
# errors and what it claims of them are some four times as large. It is honest about a question that
# nobody asked: where the start lies in a frame that begins there. Doubt belongs into P when the
# frame is given from outside, say by a map that was there before the robot.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## The package's MAK
#
# `slamlab.filters.mak.MAK` is the same filter, and `MakSlam` puts it behind a source.
#
# **Predict** how far apart the two end after 100 steps: millimetres, or rounding?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
apart = []


def compare(reading, slam):
    x, P, _ = kept[len(apart)]
    apart.append(max(np.abs(slam.filter.x - x).max(), np.abs(slam.filter.P - P).max()))


packaged = run(source, MakSlam(source.robot, source.sensor), compare)
print(f"{len(apart)} steps, largest difference in x and P below 1e-9: {max(apart) < 1e-9}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Rounding. What it does differently is thrift:
#
# - P is symmetric, so it keeps *one triangle*, in place; new landmarks go to memory allocated
#   ahead.
# - A scan of m landmarks is *one* update. With S = L Lᵀ and B = P Hᵀ L⁻ᵀ, P ← P − B Bᵀ: a change of
#   rank 2m, for which no gain and no inverse is formed.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
mak = MAK(np.zeros(3), np.zeros((3, 3)))
mak.add(["a", "b", "c"], [[2.0, 0.9], [3.0, -0.5], [2.5, 2.0]], R_look)
mak.predict(compose(mak.pose, step), Q_step)
before = mak.P
z = models.h(mak.pose, mak.landmarks()[[0, 2]]) + np.array([[0.05, 0.01], [-0.1, 0.02]])
made = mak.update(["a", "c"], z, R_look)
print("B", made.B.shape, " K", made.K.shape)
print(f"B Bᵀ − K S Kᵀ: {np.abs(made.B @ made.B.T - made.K @ made.S @ made.K.T).max():.6f}")
print(f"P − (before − B Bᵀ): {np.abs(mak.P - (before - made.B @ made.B.T)).max():.6f}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# What a scan costs in a map of 200 landmarks, on the machine that made this page:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-ignore-output"]
from timeit import repeat

big = MAK(np.zeros(3), np.diag([0.1, 0.1, 0.05]) ** 2, capacity=200)
around = np.column_stack([np.linspace(2, 6, 200), np.linspace(-3, 3, 200)])
big.add(range(200), around, R_look)
again, rows = models.h(big.pose, big.landmarks()[:5]), list(range(5))
x, P = big.x.copy(), big.P
times = {
    "textbook": min(repeat(lambda: update(x, P, rows, again, R_look), number=3, repeat=5)) / 3,
    "package": min(repeat(lambda: big.update(rows, again, R_look), number=3, repeat=5)) / 3,
}
for name, seconds in times.items():
    print(f"{name:9} {1000 * seconds:6.2f} ms for an update with 5 of 200 landmarks")

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Removing a landmark
#
# A landmark may turn out to be a chair that was moved. **Question.** What has to be done to P when
# it goes? **Predict** whether the others get less sure.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
before, left = mak.P, [0, 1, 2, 3, 4, 7, 8]  # rows of robot, a, c
mak.remove(["b"])
print("left:", mak.ids, " P unchanged for them:", np.array_equal(mak.P, before[np.ix_(left, left)]))

# %% [markdown] slideshow={"slide_type": "fragment"}
# Its rows and columns are struck out, that is all: leaving out a component of a Gaussian
# (*marginalising*) changes nobody else. What b once taught the others stays with them.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Without a notebook
#
# The same from a terminal: `slamlab run sim:landmarks --estimator mak`. With `--out FOLDER` it
# writes the trajectory, the map and a summary. `sim:landmarks` drives about seven rounds.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-ignore-output"]
import subprocess
import sys

command = [sys.executable, "-c", "from slamlab.cli import main; main()"]  # slamlab, anywhere
words = ["run", "sim:landmarks", "--estimator", "mak"]
print(subprocess.run(command + words, capture_output=True, text=True).stdout)

# %% [markdown] slideshow={"slide_type": "fragment"}
# In a program it is `run(source, MakSlam(source.robot, source.sensor))`, as above: any source with
# landmark observations will do.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Does it tell the truth about itself?
#
# One run proves little. We drive 30 loops, each with landmarks and noise of its own, and average
# the NEES of the pose at each step: lesson 03's test. Then again with a worse robot: turns four
# times as noisy, bearings to 5° instead of 2°. The filter is told.
#
# **Predict:** it knows each noise exactly and keeps every correlation. Is it consistent in both?

# %% slideshow={"slide_type": "fragment"}
RUNS, SETTLED = 30, 10  # the pose's covariance is zero at first and cannot be inverted
WORSE = Loop(steps=100, omega_sigma=0.05, bearing_sigma=np.radians(5))


def nees_of(loop, seed):
    """NEES of the pose at each step of a run."""
    source, rows = LandmarkRun(loop, np.random.default_rng(seed)), []
    slam = MakSlam(source.robot, source.sensor)
    for reading, truth in zip(source, source.truth.poses, strict=True):
        slam.step(reading)
        error = slam.pose - truth
        error[2] = wrap(error[2])
        rows.append((error, slam.filter.block([0, 1, 2])))
    errors, P = map(np.array, zip(*rows[SETTLED:], strict=True))
    return evaluation.nees(errors, P)


means = {
    name: np.mean([nees_of(loop, seed) for seed in range(RUNS)], axis=0)
    for name, loop in [("this robot", LOOP), ("a worse one", WORSE)]
}

# %% slideshow={"slide_type": "slide"}
low, high = evaluation.band(3, RUNS)
steps = np.arange(SETTLED, LOOP.steps + 1)
fig, ax = views.curves(steps, means, "step", "mean NEES of the pose", size=(6.5, 3.2))
views.band(ax, low, high, "band, 95 %")
ax.set_ylim(0)
views.legend(ax, loc="lower right")
views.show(
    fig,
    "This robot's NEES stays in the band, the worse one's climbs out of it, falls back "
    "when the loop closes and climbs out again.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** this robot's curve stays in the band: with all correlations kept, EKF-SLAM is honest here.
# The worse one's leaves it for the second half of the round, while its heading is unsure, comes
# back as the loop closes (about step 80), and is out again from step 89 on. No block is missing: the
# Jacobians are straight lines taken where the robot *believes* to be (lesson 04's banana), and what
# the filter was too sure of it stays too sure of. Lesson 07 looks at
# both: at the gain from better places for the Jacobians, and at what dropped blocks cost.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The steps of a run hang together, so one excursion is one event, not ten.
# `python -m slamlab.studies.consistency` drives a hundred runs of seven rounds and writes the
# table: standard, first-estimates and ideal Jacobians on the same readings.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for name, mean in means.items():
    print(f"{name:11} mean {mean.mean():.1f}, steps above the band {np.mean(mean > high):.0%}")

# %% [markdown] slideshow={"slide_type": "slide"}
# ## One more step: a recursive filter behind the filter
#
# The EKF note adds a step: after the update, a recursive filter lowers the noise of the robot's
# position. Its formula is lost; the plainest one keeps a *shown* pose s beside the estimate x̂:
#
# 1. s ← s ⊕ odometry, as the robot moves,
# 2. s ← x̂ + λ (s − x̂): a share λ of the old gap to the estimate is kept.
#
# λ = 0 shows the estimate. **Predict:** is the shown pose nearer to the truth for some λ > 0? Is it
# smoother?


# %% slideshow={"slide_type": "fragment"}
def shown(estimates, driven, keep):
    """The shown poses for a share λ = `keep`, from estimates (n, 3) and odometry (n, 3)."""
    s, poses = np.zeros(3), []
    for x, u in zip(estimates, driven, strict=True):
        gap = compose(s, u) - x
        gap[2] = wrap(gap[2])
        s = x + keep * gap
        poses.append(s)
    return np.array(poses)


# %% [markdown] slideshow={"slide_type": "fragment"}
# `MakSlam` has it as an option. Is it the same?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
driven = np.array([reading.odometry for reading in source])
estimates = packaged.trajectory.poses
by_option = run(source, MakSlam(source.robot, source.sensor, smoothing=0.8)).trajectory.poses
print(f"difference {np.abs(wrap(shown(estimates, driven, 0.8) - by_option)).max():.6f}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Over 40 loops: the error on the way, the error once the loop is closed (the last 16 steps), and by
# how much the shown pose jumps beside the odometry from one step to the next.

# %% slideshow={"slide_type": "fragment"}
runs = []
for seed in range(40):
    one = LandmarkRun(LOOP, np.random.default_rng(seed))
    way = run(one, MakSlam(one.robot, one.sensor)).trajectory.poses
    runs.append((one.truth.poses, way, np.array([reading.odometry for reading in one])))


def rms(squares):
    return 100 * np.sqrt(np.mean(squares))  # [cm]


def weigh_shown(keep):
    errors, jumps = [], []
    for truth, way, driven in runs:
        poses = shown(way, driven, keep)
        errors.append(np.sum((poses - truth)[:, :2] ** 2, axis=1))
        jumps.append(np.sum((poses[1:] - compose(poses[:-1], driven[1:]))[:, :2] ** 2, axis=1))
    errors = np.array(errors)
    return rms(errors[:, :84]), rms(errors[:, 84:]), rms(jumps)


# %% slideshow={"slide_type": "slide"}
shares = np.array([0, 0.2, 0.4, 0.6, 0.8, 0.9, 0.95])
on_the_way, closed, jump = np.transpose([weigh_shown(share) for share in shares])
lines = {"error once the loop is closed": closed, "jump beside the odometry": jump}
fig, ax = views.curves(shares, lines, "share λ of the old gap", "root mean square [cm]")
ax.set_ylim(0)
views.show(fig, "The jumps fall with λ to a fifth; the error rises, slowly and then steeply.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the shown pose gets calmer with every bit of λ and never more accurate; beyond 0.6 it is
# plainly less so, once the loop is closed. Before, all drift together and λ hardly matters. The
# estimate is the best that can be made of the measurements so far; who mixes an old gap into it
# mixes in what the last measurement has just refuted. For a display the calm may be worth it; a
# controller should get the estimate.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for row in zip(shares, on_the_way, closed, jump, strict=True):
    print("λ {:.2f}: error {:4.1f} cm on the way, {:4.1f} cm closed; jump {:3.1f} cm".format(*row))

# %% [markdown] slideshow={"slide_type": "fragment"}
# Where the price is paid: move λ and look at the moment the loop closes.


# %% slideshow={"slide_type": "slide"}
def at_closure(λ, estimates=estimates, driven=driven, truth=source.truth.poses):
    tracks = {"estimate, λ = 0": 0, f"shown, λ = {λ:.2f}": λ}
    off = {
        name: np.hypot(*(shown(estimates, driven, keep) - truth)[60:, :2].T)
        for name, keep in tracks.items()
    }
    fig, ax = views.curves(np.arange(60, 101), off, "step", "error of position [m]", size=(6, 3))
    ax.set_ylim(0)
    return fig


views.explore(
    at_closure,
    "The estimate's error drops at once as the loop closes, the shown pose's decays slowly.",
    λ=(0.0, 0.95, 0.8),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the filter learns its error within a few scans. The shown pose glides after it and is
# plainly the worse one for more than ten steps.

# %% [markdown] slideshow={"slide_type": "slide"}
# The note smooths the landmarks, too. They stand still, so their step 1 falls away:
# $m \leftarrow \hat{m} + \lambda\,(m - \hat{m})$ for each one *shown*; the filter keeps its own.
#
# **Predict:** does that cost as much as it did for the pose?


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
def landmarks_shown(keep):
    """How far shown landmarks are off at the end and move from step to step, ten drives [cm]."""
    errors, moves = [], []
    for seed in range(10):
        one, before = LandmarkRun(LOOP, np.random.default_rng(seed)), {}
        slam = MakSlam(one.robot, one.sensor, landmark_smoothing=keep)
        for reading in one:
            slam.step(reading)
            now = dict(zip(slam.filter.ids, slam.landmarks(), strict=True))
            moves += [np.sum((now[i] - before[i]) ** 2) for i in before]
            before = now
        errors += [np.sum((p - one.landmarks[i]) ** 2) for i, p in now.items()]
    return rms(errors), rms(moves)


for share in (0, 0.5, 0.8, 0.95):
    print("λ {:.2f}: error {:.1f} cm, step {:.2f} cm".format(share, *landmarks_shown(share)))

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** as for the pose, the calm is paid for, and never does the error fall. Up to λ = 0.8 the
# price is small, at 0.95 it is plain: when the loop closes all estimates move at once, and the shown
# landmarks have not caught up by the end of the drive.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask where smoothing *does* make sense: where the future is used as well, as in
# lesson 15.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## What you can do now
#
# Build EKF-SLAM from three functions, name every block of its covariance and who made it, and tell
# by NEES and by a map which one was forgotten.
#
# **Next:** [lesson 07](07_correlations.ipynb) looks at the white and the coloured blocks: why
# correlations cannot be dropped, why they only grow, and what they cost.
#
# **Exercise:** [write predict, augment, H, update and the whole
# filter](../exercises/ex06_ekf_slam.ipynb), and have them judged by what robots really do.
