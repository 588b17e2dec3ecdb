# %% [markdown] slideshow={"slide_type": "slide"}
# # In print: errata of the sources
#
# This course follows three theses and a note on the extended Kalman filter (EKF). They are good texts,
# and committees have read them. But every text of this length contains errors. This appendix lists
# these errors, lesson by lesson: the printed formula, the correct formula, and the consequence of the
# difference for a robot. Programs find most of these errors, and the cells below run these programs.
#
# You need this appendix only if you read the original texts. Overview of the course:
# [Start here](00_start_here.ipynb).

# %% slideshow={"slide_type": "skip"} tags=["folded"]
from itertools import pairwise

import numpy as np
import sympy as sp
from IPython.display import Markdown

from classroom.derivation import symmetric
from course.studies import corridor, error_propagation, foot_point_ablation, landmark_correlations
from course.studies import ekf_slam_faults, line_extraction_errors, published_drivers as printed
from course.studies import particle_filter_1d, wall_confirmation, wall_slam_faults
from course.studies.bound_violations import count_landmarks, cut_off
from course.studies.study_command import stored
from slamlab import estimators, views
from slamlab.devices.emir import commands
from slamlab.devices.emir.frames import COMMAND, Framer
from slamlab.devices.emir.status import Status
from slamlab.devices.emulator.emir_emulator import EmirEmulator
from slamlab.devices.emulator.emulated_robot import EmulatedRobot
from slamlab.estimators.runner import run
from slamlab.evaluation import nees
from slamlab.filters import kalman_filter
from slamlab.filters.landmark_models import LINES
from slamlab.filters.set_membership.angle_intervals import angle_interval, contains
from slamlab.geometry import compose, matrix, transform
from slamlab.landmarks.ransac import THESIS
from slamlab.layers import Ellipses, Segments
from slamlab.models import jacobians, noise
from slamlab.models.symbolic import beta, d, dtheta, p_x, p_y, r, theta, x, y
from slamlab.scanmatching import point_to_line
from slamlab.simulation import linear_system, worlds
from slamlab.simulation.worlds import World
from slamlab.sources import simulation
from slamlab.sources.landmark_runs import LandmarkRun, Loop

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Lesson 02: the quadrant of a beam
#
# | place | printed | correct | consequence |
# | --- | --- | --- | --- |
# | Smolec, chapter 3, simulated lidar | an intersection counts if it is in the same quadrant as the beam | it counts if $r \ge 0$, (02.2) | a beam along an axis is in no quadrant; rounding decides what it measures |

# %% slideshow={"slide_type": "fragment"} name="quadrants" tags=["nbval-check-output"]
for degrees in (0, 25, 90, 180, 270):
    n = np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))]).round(9)
    intersection = 3.0 * n  # with a wall perpendicular to the beam, 3 m away
    same = bool(np.all(n * intersection > 0))
    print(f"{degrees:3}°: same quadrant {same!s:5}  r = {n @ intersection:.0f} m: the beam hits")

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Lesson 03: the Kalman filter
#
# | place | printed | correct | consequence |
# | --- | --- | --- | --- |
# | MAK, definition of COIN | the innovation is *smaller than* error and noise | it *depends only on* them | the innovation is usually the largest of the three; a test of its size rejects good measurements |
# | MAK (2.11) | $S_{xv} = S_{xv}^{\mathsf T}$ | $S_{xv} = S_{vx}^{\mathsf T}$ | the shapes do not fit |
# | MAK 2.6 | consistent *if and only if* $K = S_{xv} S^{-1}$ | *if*; see (03.27) | good filters are called inconsistent |
# | MAK 2.4 | $E[\tilde x^{\mathsf T} \tilde x] = P$ | $E[\tilde x \tilde x^{\mathsf T}] = P$ | a number in place of a matrix |

# %% slideshow={"slide_type": "subslide"} tags=["code", "nbval-check-output"]
prior = kalman_filter.belief(np.array([3.0, 0.5]), linear_system.START_P)
for _ in range(4):
    prior = kalman_filter.predict(prior, linear_system.F, linear_system.Q)
posterior, _ = kalman_filter.update(prior, [4.0], linear_system.H, linear_system.R)
rng = np.random.default_rng(5)
errors = rng.multivariate_normal([0, 0], prior.P, 100_000)
noises = rng.normal(0, 0.3, 100_000)
innovations = errors[:, 0] + noises
smaller = (abs(innovations) < abs(errors[:, 0])) & (abs(innovations) < abs(noises))
sigmas = [each.std().round(2) for each in (innovations, errors[:, 0], noises)]
print(f"COIN: smaller than both in {100 * smaller.mean():.0f} %; σ of v, x̃, ε:", *sigmas)
for share in (-0.1, 0.5, 1.0, 1.1):
    smallest = np.linalg.eigvalsh(2 * share * (1 - share) * (prior.P - posterior.P)).min()
    print(f"2.6: {share:4.1f} K is", "conservative" if smallest > -1e-12 else "overconfident")
mean = np.mean(np.sum(errors**2, axis=1))
print(f"2.4: E[x̃ᵀx̃] = {mean:.2f}, one number; trace P = {np.trace(prior.P):.2f}")

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Lesson 04: the measurement model
#
# The next cells subtract the derived formula from the printed formula.


# %% slideshow={"slide_type": "skip"} tags=["folded"]
def print_difference(place, printed_formula, derived):
    """Print the entries in which a printed formula differs from the derived one."""
    difference = (printed_formula - derived).applyfunc(sp.simplify).todok()
    entries = [f"row {i + 1}, column {k + 1}: {entry}" for (i, k), entry in difference.items()]
    print(f"{place:18}", "; ".join(entries) or "equal")


pose, landmark = [x, y, theta], [p_x, p_y]
dx, dy = sp.symbols("Δx Δy", real=True)
f = sp.Matrix([x + d * sp.cos(theta), y + d * sp.sin(theta), theta + dtheta])
A, W = f.jacobian(pose), f.jacobian([d, dtheta])
root = sp.sqrt((p_x - x) ** 2 + (p_y - y) ** 2)
h = sp.Matrix([root, sp.atan2(p_y - y, p_x - x) - theta])
g = sp.Matrix([x + r * sp.cos(theta + beta), y + r * sp.sin(theta + beta)])
in_r = {(p_x - x) ** 2 + (p_y - y) ** 2: r**2}
H, H_p = (h.jacobian(each).subs(in_r).applyfunc(sp.simplify) for each in (pose, landmark))

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
arctan, reverse = sp.atan((p_y - y) / (p_x - x)), sp.atan2(y - p_y, x - p_x)
print_difference("Smolec (1), h", sp.Matrix([root, arctan - theta]), h)
print_difference("MAK (2.29), h", sp.Matrix([root, reverse - theta]), h)
smolec_2 = sp.Matrix([H[0, :], H[1, :].multiply_elementwise(sp.Matrix([[1, -1, 1]]))])
print_difference("Smolec (2), H", smolec_2, H)
print_difference("Smolec (3), H", -H[:, :2], H_p)
right, wrong = (error_propagation.localisation_errors(sign, 3)[0][-1] for sign in (1, -1))

# %% [markdown] slideshow={"slide_type": "fragment"}
# | place | printed | correct | consequence |
# | --- | --- | --- | --- |
# | Smolec (1) | $\tan^{-1}\frac{p_y - y}{p_x - x}$ | atan2 | 180° off for every landmark behind the robot |
# | MAK (2.29) | the same, from landmark to robot | $p - x$, atan2 | read as atan2, each bearing is 180° off |
# | Smolec (2) | $+(p_x - x)/r^2$ | $-(p_x - x)/r^2$ | median error {= 100 * wrong:.1f =} cm after 20 measurements, {= 100 * right:.1f =} cm with the correct sign |
# | Smolec (3) | minus columns of (2) | correct once (2) is | otherwise the wrong sign appears twice |

# %% [markdown] slideshow={"slide_type": "slide"}
# ### The motion model

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
Dx, Dy = d * sp.cos(theta), d * sp.sin(theta)
A_5 = sp.Matrix([[1, 0, -Dy * sp.sin(theta)], [0, 1, Dx * sp.cos(theta)], [0, 0, 1]])
A_given = sp.Matrix([[1, 0, -dy], [0, 1, dx], [0, 0, 1]])
print_difference(
    "Smolec (4), f", sp.Matrix([x + sp.cos(theta), y + sp.sin(theta), theta + dtheta]), f
)
print_difference("Smolec (5), A", A_5, A)
print_difference("Smolec §4.1, A", A_given.subs({dx: Dx, dy: Dy}), A)
print_difference(
    "(12) with §4.1, A", A_given, sp.Matrix([x + dx, y + dy, theta + dtheta]).jacobian(pose)
)
deg = sp.Symbol("deg", real=True)
A_deg = f.subs(theta, deg * sp.pi / 180).jacobian([x, y, deg]).subs(deg, 180 * theta / sp.pi)
print_difference("degrees, A", A[:2, :], A_deg[:2, :])

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
P_start = np.diag([0.05, 0.05, 0.1]) ** 2
at_150 = [each.subs({theta: np.radians(150), d: 3.0}) for each in (A_5, A)]
P_end = [np.array(each * sp.Matrix(P_start) * each.T, dtype=float) for each in at_150]
rho = [each[0, 1] / np.sqrt(each[0, 0] * each[1, 1]) for each in P_end]
print("correlation of x and y, heading 150°: (5) {:+.1f}, derived {:+.1f}".format(*rho))
sigma_claimed = np.sqrt(0.05**2 + (3.0 * 0.1) ** 2)  # (12) with A of §4.1, 3 m to the north

# %% [markdown] slideshow={"slide_type": "subslide"}
# | place | printed | correct | consequence |
# | --- | --- | --- | --- |
# | Smolec (4) | $x + \cos\theta$ | $x + d\cos\theta$ | every step is 1 m long |
# | Smolec (5) | $-\Delta y \sin\theta$, $\Delta x \cos\theta$ | $-\Delta y$, $\Delta x$ | at 150° the correlation has the wrong sign |
# | Smolec (12) with $A$ of §4.1 | $x + \Delta x$ | $A = I$ for *given* steps | 3 m to the north: reports $\sigma_x$ = {= sigma_claimed:.2f =} m where it is 0.05 m |
# | degrees in the state | (04.5) | $\times\, \pi/180$ | 5° and 3 m: {= 3 * 5 =} m to the side in place of {= 3 * np.radians(5):.2f =} m |
#
# $A$ of Smolec's §4.1 and of the EKF note is correct for a step *along the estimated heading*: a
# Jacobian is correct only for the model from which it was derived.

# %% [markdown] slideshow={"slide_type": "slide"}
# ### The process noise and the measurement noise

# %% slideshow={"slide_type": "fragment"} tags=["code", "nbval-check-output"]
c, c_1, dt = sp.symbols("c c_1 Δt", positive=True)
try:
    sp.Matrix([dt * sp.cos(theta), dt * sp.sin(theta), dtheta]) * sp.diag(c, c, c)
except sp.ShapeError:
    print("Smolec (8), Q: W is 3 × 1 and C is 3 × 3: they cannot be multiplied")
meant = sp.Matrix([Dx, Dy, dtheta])
Q_8, Q = c * meant * meant.T, W * sp.diag(c_1, c) * W.T
print("rank of what (8) means:", Q_8.rank(), " of W C Wᵀ:", Q.rank())
print("its variance of the heading on a straight line:", Q_8[2, 2].subs(dtheta, 0))
b, s = sp.symbols("b sigma_beta", positive=True)
print_difference("Smolec (9), R", sp.diag(r * c, b * beta), sp.diag((c_1 * r) ** 2, s**2))
C_step = noise.C_odometry([0.1, 0], 0.05, 0.05, turn_per_metre=0.05)
true_sigma = np.degrees(np.sqrt(50 * C_step[1, 1]))  # 50 steps of 10 cm

# %% [markdown] slideshow={"slide_type": "fragment"}
# | place | printed | correct | consequence |
# | --- | --- | --- | --- |
# | Smolec (6)–(8) | $C$ is 3 × 3, $W$ is 3 × 1; rank one | (04.7) | 5 m straight ahead: $\sigma_\theta$ = 0°, where wheels with 0.05 rad per metre give {= true_sigma:.1f =}° |
# | EKF note | noise by $\Delta x, \Delta y, \Delta t$ | $\Delta\theta$ for $\Delta t$ | the same rank of one |
# | Smolec (9) | $r c$, $\beta b$; "variance 1 cm → $c$ = 0.01" | (04.15) | 1 % of 4 m becomes {= 100 * np.sqrt(4 * 0.01):.0f =} cm in a program that uses metres, {= np.sqrt(4000 * 0.01) / 10:.1f =} cm in one that uses millimetres |

# %% [markdown] slideshow={"slide_type": "slide"}
# ### The inverse measurement model and the update

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
turned = theta + beta
J_10 = sp.Matrix([[1, 0, -sp.sin(theta)], [0, 1, sp.cos(theta)]])
J_11 = sp.Matrix([[sp.cos(turned), -sp.sin(turned)], [sp.sin(turned), sp.cos(turned)]])
print_difference("Smolec (10), J_r", J_10, g.jacobian(pose))
print_difference("Smolec (11), J_z", J_11, g.jacobian([r, beta]))
sites = [sp.symbols(f"p{i}_x p{i}_y", real=True) for i in (1, 2, 3, 4)]
third = h.subs(dict(zip(landmark, sites[2], strict=True)))
filled = ["H" if not third.jacobian(part).is_zero_matrix else 0 for part in (pose, *sites)]
print("MAK (4.9), H_3: printed [0, 0, 'H', 'H', 0], differentiated", filled)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
start, z, R_z = np.array([0, 0, 0.4]), np.array([5.0, 0.8]), noise.R(5, 0.02, 0.02)
P_pose, values = np.diag([0.15, 0.15, 0.08]) ** 2, {theta: 0.4, beta: 0.8}
J10, J11 = (np.array(each.subs(values), dtype=float) for each in (J_10, J_11))
pairs = (P_pose, J10, jacobians.J_z(start, z)), (0 * P_pose, jacobians.J_xr(start, z), J11)
nees_10, nees_11 = (error_propagation.landmark_nees(start, z, R_z, *each) for each in pairs)
print(f"(10): NEES {nees_10:.0f}; (11), where SLAM starts with P = 0: {nees_11:.0f}; expected: 2")

# %% [markdown] slideshow={"slide_type": "subslide"}
# | place | printed | correct | consequence |
# | --- | --- | --- | --- |
# | Smolec (10) | $-\sin\theta$, $\cos\theta$ | $-r\sin\varphi$, $r\cos\varphi$ | errors {= np.sqrt(nees_10 / 2):.1f =} times as large as reported |
# | Smolec (11) | no $r$ | $r$ in the second column | {= np.sqrt(nees_11 / 2):.1f =} times, where SLAM starts |
# | Smolec (15) | $x \leftarrow K v$; no update of $P$ | $x + K v$ | the estimate is discarded; $\sigma$ never shrinks |
# | MAK (4.9), landmark 3 | $[0\;\,0\;\,H_{\mathrm r}\;\,H_{\mathrm p}\;\,0]$ | $[H_{\mathrm r}\;\,0\;\,0\;\,H_{\mathrm p}\;\,0]$ | $H_{\mathrm r}$ has three columns, a landmark's position has two entries: the shapes do not fit |
#
# A formula whose shapes do not fit stops a program at once. With the other wrong formulas a program
# runs and draws a wrong ellipse; only a test finds these errors.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Lesson 05: the gain of a landmark that is not measured
#
# | place | printed | correct | consequence |
# | --- | --- | --- | --- |
# | MAK, gain before (4.10) | $S_{\mathrm{rr}}^{-1}$ | $S_{vv}^{-1}$, our $S^{-1}$ | the shapes do not fit |
# | MAK, row $j$ before (4.10) | $P_{j\mathrm r} H_{\mathrm r}^{\mathsf T} + P_{ij} H_{\mathrm p}^{\mathsf T}$ | $P_{ji}$, as in (05.12) | wrong gain for landmarks that are not measured |
#
# $P_{ij}$ is the transpose of $P_{ji}$ and has the same shape, so a program runs without an error
# message.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
P_rr, P_ii = symmetric("P_rr", 3), symmetric("P_ii", 2)
P_ri, P_jr, P_ji = (sp.MatrixSymbol(*n) for n in [("P_ri", 3, 2), ("P_jr", 2, 3), ("P_ji", 2, 2)])
H_r, H_p = sp.MatrixSymbol("H_r", 2, 3), sp.MatrixSymbol("H_p", 2, 2)
columns = sp.BlockMatrix([[P_rr, P_ri], [P_ri.T, P_ii], [P_jr, P_ji]])
derived = sp.block_collapse(columns * sp.BlockMatrix([[H_r, H_p]]).T).blocks[2, 0]
print("row j, derived − printed:", sp.expand(derived - (P_jr * H_r.T + P_ji.T * H_p.T)))

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Lesson 06: EKF-SLAM
#
# The thesis prints Smolec's program in figures only. We infer its operations from line numbers and from
# the text, so the last row may be wrong.
#
# | place | printed | correct | consequence |
# | --- | --- | --- | --- |
# | Smolec, prediction | "$P$ is updated with $A$" | (06.3), with $Q$ and $P_{\mathrm ri}$ | overconfident; wrong cross-covariances |
# | Smolec (18) | $P_{ni} = J_{\mathrm r} (P_{\mathrm ri})^{\mathsf T}$ | $J_{\mathrm r} P_{\mathrm ri}$, (06.6) | the shapes do not fit; (16), (17) are correct |
# | Smolec (15) | $x = K v$ | $x + K v$, (06.9) | the map collapses |
# | Smolec, update | $P$ is unchanged | (06.9) | $P$ never shrinks; a worse map |
# | Smolec, program | predicts after it adds landmarks | predict, update, augment | landmarks are one step behind |

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output", "nearly"]
ten = [LandmarkRun(Loop(steps=100), np.random.default_rng(seed)) for seed in range(10)]
correct = ekf_slam_faults.final_errors(ten)
reset = ekf_slam_faults.final_errors(ten, ekf_slam_faults.PriorMeanLost)
never = ekf_slam_faults.final_errors(ten, ekf_slam_faults.MeanOnlyUpdate)
print(f"{'10 runs, rms at the end':28} map [m]  robot [m]  reported [m]  NEES")
table = {"the filter": correct, "x = K v": reset, "P is never updated": never}
for name, end in table.items():
    # where P is nearly singular, the last digits depend on the processor's rounding
    size = f"{end.nees:7.1f}" if end.nees < 1000 else "  > 1000"
    print(f"{name:28} {end.landmarks:6.2f} {end.robot:10.2f} {end.claimed:12.2f} {size}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# With (15) each update moves the robot and the map close to the origin, and the error becomes as large
# as the loop. Without the update of $P$ the filter weights each measurement as if
# no earlier measurement had been used. The NEES of this filter is far below 3: the filter is conservative, and its map error is
# {= never.landmarks / correct.landmarks:.1f =} times as large.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Lesson 07: the two updates of the MAK thesis
#
# The MAK thesis prints all blocks of both updates, (4.18) to (4.39), with $W$ for the gain $K$. For
# every block it prints a first line with $W$ and a second line with the blocks of $P$.
#
# | place | printed | correct | consequence |
# |---|---|---|---|
# | (4.22)–(4.27), (4.33)–(4.38), first lines | $P - [W S^{-1} W]$ | $P - W S W^{\mathsf T}$ | the robot's cannot be multiplied; the others run and are wrong |
# | (4.34), second line | begins with $P_{\mathrm r2}$ | $P_{\mathrm r1}$ | the correlation with landmark 1 is lost |
# | (4.37) | $P_{12}(1 \mid 0)$ | $P_{12}(2 \mid 1)$ | none: both are zero |
# | (4.19), (4.20), (4.30)–(4.32) | $P H^{\mathsf T} v$ | $P H^{\mathsf T} S^{-1} v$ | corrections of a wrong size and unit |

# %% [markdown] slideshow={"slide_type": "subslide"}
# | place | printed | correct | consequence |
# |---|---|---|---|
# | second update | $S$ from $P(2 \mid 2)$ | from $P(2 \mid 1)$ | $P(2 \mid 2)$ is computed from $S$ |
# | second update | $x(2 \mid 2) = x(2 \mid 2) + W v$ | $x(2 \mid 1) + W v$ | true only if $W v = 0$ |
# | before (4.22) | without $H_{\mathrm r}$, only $v(1 \mid 0)$ is affected | $p_1(1 \mid 0)$ | an innovation is not updated |
# | 4.3.4 | a prediction does not change the covariance | the *map's* covariance | (07.5); the end of 4.3.5 is correct |
# | 4.3.5 | memory at least $o(N^2)$ | $\Omega(N^2)$ | $o(N^2)$ means *less* than $N^2$ |
#
# The gains (4.18) and (4.29) are correct, and so are eleven of the twelve second lines. The program
# evaluates both lines with the numbers of the example in lesson 07, and compares the results with the
# filter. The table states each difference as a multiple of the correct change.

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
Z = sp.ZeroMatrix
P_11, P_22, S = symmetric("P_11", 2), symmetric("P_22", 2), symmetric("S", 2)
P_r1 = sp.MatrixSymbol("P_r1", 3, 2)
SECOND_LINES = [  # as printed, by block; P_r2, with which (4.34) begins, is zero before update 2
    {
        "rr": P_rr - P_rr * H_r.T * S.I * H_r * P_rr,
        "r1": -P_rr * H_r.T * S.I * H_p * P_11,
        "r2": Z(3, 2),
        "11": P_11 - P_11 * H_p.T * S.I * H_p * P_11,
        "12": Z(2, 2),
        "22": P_22,
    },
    {
        "rr": P_rr - P_rr * H_r.T * S.I * H_r * P_rr,
        "r1": Z(3, 2) - P_rr * H_r.T * S.I * H_r * P_r1,
        "r2": -P_rr * H_r.T * S.I * H_p * P_22,
        "11": P_11 - P_r1.T * H_r.T * S.I * H_r * P_r1,
        "12": -P_r1.T * H_r.T * S.I * H_p * P_22,
        "22": P_22 - P_22 * H_p.T * S.I * H_p * P_22,
    },
]
stages, steps = landmark_correlations.two_observations(0.1, heading_sigma=0.05, prior_sigma=0.2)
ROWS = {"r": slice(0, 3), "1": slice(3, 5), "2": slice(5, 7)}


# %% slideshow={"slide_type": "subslide"} tags=["code"]
def numbers(expression, k):
    """A formula of blocks with the numbers of update k = 0, 1."""
    known = [stages[k][ROWS[a], ROWS[b]] for a, b in ("rr", "r1", "11", "22")]
    known += [steps[k].H[:, :3], steps[k].H[:, 3:], steps[k].S]
    return sp.lambdify((P_rr, P_r1, P_11, P_22, H_r, H_p, S), expression)(*known)


def first_line(k, a, b):
    """P − [W_a S⁻¹ W_b], as printed."""
    W, S = steps[k].K, steps[k].S
    return stages[k][ROWS[a], ROWS[b]] - W[ROWS[a]] @ np.linalg.inv(S) @ W[ROWS[b]]


def difference(value, k, a, b):
    """The difference of a block after update k, in units of the correct change."""
    before, after = (stages[k + j][ROWS[a], ROWS[b]] for j in (0, 1))
    size = np.linalg.norm(value - after)
    return size / np.linalg.norm(after - before) if size > 1e-9 else 0.0


# %% slideshow={"slide_type": "subslide"} tags=["folded", "nbval-check-output"]
rows, factors = ["| update | block | first line | second line |", "|---" * 4 + "|"], []
for k, printed_lines in enumerate(SECOND_LINES):
    for (a, b), second_line in printed_lines.items():
        try:
            factors.append(difference(first_line(k, a, b), k, a, b))
            first = f"{factors[-1]:.3g}"
        except ValueError:
            first = "cannot be multiplied"
        second = difference(numbers(second_line, k), k, a, b)
        rows.append(f"| {k + 1} | {a}{b} | {first} | {second:.3g} |")
Markdown("\n".join(rows))

# %% [markdown] slideshow={"slide_type": "fragment"}
# Of the first lines, only those of blocks that do not change are correct; the errors of the others are
# {= min(f for f in factors if f):.0f =} to {= max(factors):.0f =} times the correct change. (In other
# units these numbers would differ, since the lines contain $S^{-1}$ in place of $S$.) Of the second
# lines only (4.34) is wrong, that of $P_{\mathrm r1}$ in the second update.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
H_2 = np.zeros((2, 7))
H_2[:, steps[1].columns] = steps[1].H
from_21, from_22 = (H_2 @ stages[k] @ H_2.T + landmark_correlations.R for k in (1, 2))
off = 100 * np.linalg.norm(from_22 - from_21) / np.linalg.norm(from_21)
print(f"S from P(2|1): off by {abs(from_21 - steps[1].S).max():.9f}; from P(2|2): by {off:.0f} %")
v = np.array([0.1, -0.05])  # any innovation
for number, part in {30: "r", 31: "1", 32: "2"}.items():
    W_part = steps[1].K[ROWS[part]]
    moved = np.linalg.norm(W_part @ steps[1].S @ v) / np.linalg.norm(W_part @ v)
    print(f"(4.{number}) changes x by {moved:.3f} times the correct amount")
N = sp.symbols("N", positive=True)
print("(3 + 2N)² / N² tends to", sp.limit((3 + 2 * N) ** 2 / N**2, N, sp.oo), "and not to 0")

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Lesson 08: landmarks from scans
#
# | place | printed | correct | consequence |
# | --- | --- | --- | --- |
# | Smolec 2.4 | $y = m x + c$, (08.1) | total least squares, (08.6) | walls straight ahead are not found |
# | Smolec 2.4 | inliers within 15 mm | within some $\sigma$ of each measurement | distant walls are never found |
# | Smolec, filter | the foot point as a point landmark | $(\rho, \alpha)$, (08.10) | overconfident along the wall |
# | Smolec 4.4 | the *first* landmark below a constant | the nearest, by (08.11) | the order of the map decides |
# | Smolec, program | landmarks enter the map at once | tentative first, and compared | duplicate walls |
#
# Lesson 08 shows the first three errors. The next cell shows the other two:


# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
EXPECTED = np.array([[3.0, 0.3], [2.78, 0.05]])  # two walls of a map, as the robot predicts them
H_robot, H_wall = LINES.H(np.zeros(3), EXPECTED)
P_robot, R_wall = np.diag([0.05, 0.05, 0.15]) ** 2, np.diag([0.02, 0.01]) ** 2
S_walls = H_robot @ P_robot @ H_robot.transpose(0, 2, 1) + R_wall
S_walls += H_wall @ R_wall @ H_wall.transpose(0, 2, 1)
distance = np.sqrt(nees(np.array([2.98, 0.05]) - EXPECTED, S_walls))
for order in ([0, 1], [1, 0]):
    found = next(k for k in order if distance[k] < 5.0)
    print("map in the order", *("AB"[k] for k in order), ": the first below 5 σ is", "AB"[found])
bare, duplicates = World(worlds.box((0, 0), (3.0, 2.5))), {}
observed = wall_confirmation.observed_walls(bare, THESIS)
for name, within_scan in {"not compared": False, "compared": True}.items():
    walls = wall_confirmation.confirmed_walls(observed, within_scan=within_scan)
    duplicates[name] = wall_confirmation.duplicate_walls(walls).sum()
    print(f"new walls of a scan {name}: {len(walls)} in the map, duplicates: {duplicates[name]}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The bare room has four walls. Of the walls that enter the map at their first measurement,
# {= duplicates["not compared"] =} are duplicates of another wall in the same scan, and no later
# comparison removes these duplicates.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Lesson 09: SLAM with walls
#
# The thesis prints Smolec's program in figures only, so "printed" refers to the text and the formulas
# of the thesis.
#
# | place | printed | correct | consequence |
# |---|---|---|---|
# | §2.6 | state in degrees, Jacobians for radians | radians | NEES in the hundreds, duplicate walls |
# | line fit | least squares for $y = a x + b$ | total least squares | NEES outside its interval |
# | landmark | measured foot of the perpendicular | (09.1) | overconfident; diverges in corridors |
# | landmark | one for each infinite line | one for each piece | two walls 0.5 m apart are one |
# | §4.4 | the first landmark within the offset | the nearest | wrong where two are near |
# | map | a landmark at its first measurement | after several measurements | with windows, more walls than exist |
# | program | predict after data association | predict first | wrong heading while the robot turns |
# | protocol | SCAN measures once and waits | it streams until STOP | the program reads an old scan |

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
rooms = {
    name: simulation(name, np.random.default_rng(1)) for name in ("situation-1", "situation-2")
}
true_walls = rooms["situation-1"].world.walls
foot_points = corridor.foot_points(line_extraction_errors.lines_of(true_walls))
different = np.unique(foot_points.round(6) + 0.0, axis=0)
apart = np.hypot(*(different[:, None] - different).T)
near = np.argwhere(np.triu(apart <= 0.5 + 1e-9, 1))
print(f"{len(true_walls)} pieces of wall, {len(different)} different foot points;", end=" ")
print(f"{len(different) - len(near)} can be distinguished at 0.5 m:")
for i, j in near:
    print(f"{different[i].tolist()} and {different[j].tolist()} are {apart[i, j]:.1f} m apart")

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
found = wall_slam_faults.extracted_lines(rooms["situation-1"])
counts = line_extraction_errors.choices(rooms["situation-1"], found, 0.5)
total, ambiguous = counts["observations"], counts["with a choice"]
print(f"{total} measured lines at the true poses; several walls within 0.5 m: {ambiguous}")
for rule in ("the first", "the nearest"):
    print(f"{rule} is correct in {100 * counts[rule] / counts['with a choice']:.0f} %")

# %% [markdown] slideshow={"slide_type": "slide"}
# ### The program of the thesis and its corrections
#
# The class `FootPointSlam` of the library contains all parts of this program that can run, with a
# switch for each correction (`slamlab run sim:situation-2 --estimator walls-foot-points`). In each row
# of the table one correction is left out; the last column contains the median of the additional error
# and its 95 % confidence interval.

# %% slideshow={"slide_type": "fragment"} tags=["folded", "nbval-check-output"]
ablation = stored("foot_point_ablation")


def additional_error(row):
    """The median additional error and its 95 % confidence interval."""
    bounds = (round(100 * row[key]) for key in ("more_m", "low_m", "high_m"))
    return "{:+d} cm ({:+d} to {:+d})".format(*bounds)


def corrections(names):
    """Table of some corrections: what is printed, what is correct, the error without it."""
    rows = ["| correction | printed | corrected | without it |", "|---" * 4 + "|"]
    for name in names:
        each, row = estimators.CORRECTIONS[name], ablation["left_out"][name]
        rows.append(f"| {name} | {each.printed} | {each.corrected} | {additional_error(row)} |")
    return Markdown("\n".join(rows))


corrections(list(estimators.CORRECTIONS)[:6])

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
corrections(list(estimators.CORRECTIONS)[6:])

# %% [markdown] slideshow={"slide_type": "subslide"}
# The table was computed from {= ablation["seeds"][1] + 1 =} runs in situation 2. Is the corrected
# program better than odometry? The answer depends on the slip of the wheels and on the number of beams,
# as the next table shows:

# %% slideshow={"slide_type": "fragment"} tags=["folded", "nbval-check-output"]
rows = [
    "| slip | beams | odometry | as printed | all corrections | (ρ, α), grown |",
    "|---" * 6 + "|",
]
for row in ablation["verdicts"]:
    names = ("as printed", "all corrections", "walls")
    others = " | ".join(additional_error(row[name]) for name in names)
    odometry = 100 * row["odometry"]["rms_m"]
    rows.append(f"| × {row['slip']} | {row['beams']} | {odometry:.0f} cm | {others} |")
Markdown("\n".join(rows))

# %% [markdown] slideshow={"slide_type": "fragment"}
# As printed, the program is worse than odometry in every row. With all corrections and 360 or 900 beams, the
# intervals contain zero. With 3600 beams the program is worse than odometry: 25 measurements span only
# 2.5°, and such a short piece of wall hardly determines a direction. Only the line landmarks
# $(\rho, \alpha)$ with grown lines are better than odometry in every row.

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
red, blue, green = (views.COLOURS[name] for name in ("naive", "corrected", "landmark"))
THESIS_COLOURS = {"scan": red, "axes": red, "landmark": blue, "corrected": green}
LABELS = {"landmark": "foot point", "corrected": "trajectory", "scan": "lidar"}
fig, both = views.panels(["corrected", "as printed"], (9, 4), shared=False)
for ax, switches in zip(both, (estimators.CORRECTIONS, ()), strict=True):
    slam = foot_point_ablation.listing("situation-2", 60, 400, corrections=switches)[0]
    for layer in [Segments("axes", [[0, 0, 1, 0], [0, 0, 0, 1]]), *slam.layers()]:
        if not isinstance(layer, Ellipses):
            colour = THESIS_COLOURS.get(layer.name, views.colour(layer))
            views.draw(ax, layer, color=colour, label=LABELS.get(layer.name, layer.name))
views.legend_below(fig)
views.show(
    fig,
    "Corrected: one map of the irregular room, with blue foot points of its walls joined to the origin by "
    "perpendiculars. As printed: the trajectory jumps by metres, and the room is drawn many times.",
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The figure shows situation 2 after 60 scans, with the colours of the thesis. With the printed program,
# the trajectory jumps by metres, and the room is drawn many times.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Lesson 10: the BOR filter
#
# | place | printed | correct | consequence |
# | --- | --- | --- | --- |
# | MAK 5.2.3 | the heading's left end comes first | 5.2.4 has right first; one order, (10.2) | all wrong headings and not the true one |
# | 5.2.6 | four edges, for any $d_{\mathrm{abs}}$ | only below $\pi/2$ | the true value is cut off |
# | 5.2.9, 5.2.10 | several candidate landmarks: not described; then: a new one | ignore the measurement | duplicates |
# | 5.2.9 | contains the text on the heading, and cites 5.2.7 | belongs to 5.2.8, means 5.2.6 | none |
# | 5.2 | the cost of a measurement is constant | only with known data association | see "Deeper: time and memory" in lesson 10 |
# | 5.2 | nothing on empty intersections | report them | the filter fails silently |

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
true_heading, heading = 0.05, (-0.1, 0.2)
swapped = angle_interval(heading[1], heading[0] + 2 * np.pi)  # left read as right
print("5.2.3 read as 5.2.4 contains the heading:", contains(swapped, true_heading))
print(f"edges at d_abs = 2.5 cut off {100 * cut_off(0.2, 2.5):.0f} % of the feasible set")
for rule, add_ambiguous in {"ignored": False, "a new one": True}.items():
    made = [count_landmarks(seed, add_ambiguous) for seed in range(10)]
    print(f"ambiguous: {rule:9}: {np.median(made):5.1f} landmarks for 6 (median of 10 runs)")

# %% [markdown] slideshow={"slide_type": "fragment"}
# With the printed rule every ambiguous measurement adds a landmark, and so the next measurement is more
# ambiguous.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Lesson 11: particle filters
#
# | place | printed | correct | consequence |
# | --- | --- | --- | --- |
# | MAK 5.3.2, algorithm 1 | "the sample with the largest weight" | draw in proportion to the weights | the particles do not represent the posterior |
# | algorithm 1, steps 2 and 4 | $\Pr(x_k \mid x_{k-1}, u_k)$ in the weight | (11.5) | half the process noise |
# | 5.3.2, Bayes | the last measurement is missing on the left side | (11.3) | none |
#
# In another place the thesis states "by its weight", and the error in the last row may be a misprint of
# an index.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
zs = particle_filter_1d.measured(seed=1)
rules = particle_filter_1d.RIGHT, particle_filter_1d.TWICE, particle_filter_1d.LARGEST
for rule in rules:
    mean, sigma = particle_filter_1d.by_samples(zs, np.random.default_rng(2), 20_000, rule)
    print(f"{rule:20} {mean:6.2f} m ± {100 * sigma:4.1f} cm")
by_kalman = particle_filter_1d.by_kalman(zs)
print(f"{'Kalman filter':20} {by_kalman[0]:6.2f} m ± {100 * by_kalman[1]:4.1f} cm (σ)")

# %% [markdown] slideshow={"slide_type": "fragment"}
# If all particles are copies of the particle with the largest weight, the prior is reduced to one
# point. In this run the mean differs by {= 100 * abs(mean - by_kalman[0]):.0f =} cm from that of the
# Kalman filter. The $\sigma$ of the Kalman filter is {= 100 * by_kalman[1]:.0f =} cm, and that of the
# particles is {= 100 * sigma:.0f =} cm.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Lesson 12: the wall-following robot
#
# | place | printed | correct | consequence |
# | --- | --- | --- | --- |
# | MAK 7.3, listing | the last loop lacks a bracket `)` and a brace `{` | both | it cannot be compiled |
# | 7.3, listing | no speed is set before the last loop | set one | the robot never moves |
# | 7.3, listing | `target` is never set | the start of this motion | the loop ends after one measurement |
# | 7.3, comment | drive *more* than 4 cm | the loop drives 4 cm at most | none |
# | 3, 6 | the model of a steered robot, for two wheels | distance and rotation | cannot rotate on the spot |
# | 8 | "got lost", without a definition | a threshold, and a time | the count cannot be reproduced |


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
def last_loop(speed, target, x=0.5, polls=2000):
    """The listing's last loop, starting at x, with the wall far enough all the time."""
    start, dist = x, 0.0
    for poll in range(polls):
        if not dist < 0.04 - 1e-9:
            return f"{100 * (x - start):.0f} cm, measurements: {poll}"
        x += 0.1 * speed  # ten measurements a second
        dist = abs(target - x)
    return f"{100 * (x - start):.0f} cm, and the loop never ends"


print("as printed, brackets added:", last_loop(speed=0.0, target=0.5))
print("with a speed:              ", last_loop(speed=0.1, target=0.0))
print("with a speed and a target: ", last_loop(speed=0.1, target=0.5))

# %% [markdown] slideshow={"slide_type": "fragment"}
# The corrected program is `slamlab.simulation.wall_follower.WallFollower`.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Lesson 13: scan matching
#
# | place | printed | correct | consequence |
# | --- | --- | --- | --- |
# | Tuček §3.1, step 5 | continue while the error is above a bound | stop when it no longer changes, as `icp.py` does | it never ends, or ends too soon |
# | `icp.py` | tolerance 0.001, no unit | its data are in millimetres | in metres it stops before the rotation has converged |
# | `slam.py` | the second scan is only stored | the first is the map *and* the previous scan | the first motion is lost |
# | `slam.py` | a scan of fewer than three points deletes the previous one | keep it | the next motion is lost |


# %% slideshow={"slide_type": "subslide"} tags=["code"]
def as_printed(scans):
    """The pose after Tuček's add_new_scan and calculate_transformation, in their own logic."""
    begun, previous, current = False, None, np.zeros(3)
    for scan, odometry in scans:
        if not begun:
            begun = True
        elif previous is None or len(scan) < 3:
            previous = scan if len(scan) >= 3 else None
        else:
            current = compose(current, point_to_line(scan, previous, odometry).pose)
            previous = scan
    return current


def corrected(scans):
    """The pose after all matches of consecutive scans."""
    current = np.zeros(3)
    for (before, _), (scan, odometry) in pairwise(scans):
        current = compose(current, point_to_line(scan, before, odometry).pose)
    return current


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
polygon = simulation("polygon-wrong", np.random.default_rng(1))
scans = [(reading.scan.points(), reading.odometry) for reading in polygon]
with_empty = [*scans[:3], (np.empty((0, 2)), np.zeros(3)), scans[3]]
poses = {"truth": polygon.truth.poses[-1], "corrected": corrected(scans)}
poses |= {"as printed": as_printed(scans), "with one empty scan": as_printed(with_empty)}
for name, end in poses.items():
    print(f"{name:>19}: {end[0]:.2f} m, {end[1]:.2f} m, {np.degrees(end[2]):.0f}°")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The printed program loses the first motion although every match is good. The figures 3.15 and 3.17 of
# the thesis show one polygon, so they cannot come from this listing.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Lesson 14: the listing
#
# | place | printed | correct | consequence |
# | --- | --- | --- | --- |
# | `move` | checksum 256 − 1 − speed − turn, of bytes | (14.6) | half of all commands are malformed |
# | odometry | read the counters, then reset them | differences, (14.7) | the motion between the two is lost |
# | every write | `flushOutput()` right after it | leave it out | discards bytes that have not been sent |
# | `main` | neither `start()` nor `robot_control()` is called | call both | nothing happens |
# | `exit` | never sends a stop | stop first | the robot continues to move |

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
for pair in ((50, 0), (30, -20), (-10, 10), (-1, -1)):
    print(f"{pair!s:>9}  printed {printed.move(*pair):12}  correct {commands.move(*pair).decode()}")
every = [(v, omega) for v in range(-100, 101) for omega in range(-100, 101)]
dropped = [pair for pair in every if not Framer(COMMAND).feed(printed.move(*pair).encode())]
print(f"{views.grouped(len(dropped))} of {views.grouped(len(every))} commands are dropped")
both = sum(v < 0 and omega < 0 for v, omega in dropped)
print(f"both negative: {views.grouped(both)}; one negative: {views.grouped(len(dropped) - both)}")

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
body = EmulatedRobot(worlds.corridor(), np.random.default_rng(1))
emir, framer, total = EmirEmulator(body), Framer(), 0
emir.feed(commands.info(True) + commands.move(50, 0), 0.0)
for now in 0.95 + np.arange(14):
    total += Status.unpack(framer.feed(emir.feed(b"", now))[-1]).path
    emir.feed(commands.reset_counters(), now)
print(f"read, then reset: {total} counts; the wheels made {body.counters()[0]}")
for milliseconds in (0.1, 1, 2):
    sent = printed.bytes_sent(milliseconds / 1000)
    print(f"flushed {milliseconds} ms after the write: {sent:2} of 10 bytes were sent")
print("called by main:", printed.main().called)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The name `flushOutput` suggests that it sends the data at once, but it *discards* the data that wait to be sent.
# At 57 600 bits per second a byte takes 174 µs. The number of bytes that are sent depends on the
# buffers of the system and on timing, so the fault may appear on one computer and not on another.

# %% [markdown] slideshow={"slide_type": "subslide"}
# | place | printed | correct | consequence |
# | --- | --- | --- | --- |
# | `transformation_is_zero` | the entries of `T` add up to 0 | `T` is the identity | a robot at rest is never detected |
# | sensors | number `> 0` | `>= 0` | sensor 0 is never returned |
# | sensors | all 17 bytes are signed | six of them | a compass at 300° shows −212° |
# | bad frame | returns an empty list | skip it and count | unpacking fails in the caller |
# | `slam_routine` | ends at the first empty scan | skip it and count | the map ends without a message |
# | `App` | the map is created in the class body | in `__init__` | two programs share one map |
# | lidar | `next(iter_scans())` for each revolution | keep one generator | one measurement of every revolution is lost |

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
print("a robot at rest is detected:", printed.transformation_is_zero(np.eye(3)))
text = Status(proximity=(35, 80, 80, 80, 62, 41), azimuth=150, path=-3, angle=7).pack().decode()
print("sensors 0, 14, 15:", printed.values_for_sensors(text, [0, 14, 15]))
print("compass:", 2 * printed.values_for_sensors(text, [13])[0], "degrees")
rng = np.random.default_rng(5)
scans = [[] if rng.random() < 0.02 else [1] for _ in range(1000)]
print(f"scans used: {printed.slam_routine(scans)} of {len(scans)}")
printed.App().points.append("a scan of robot one")
print("robot two has:", printed.App().points)
measurements = iter([(k % 5 == 0, k) for k in range(20)])  # revolutions of five measurements
print("revolutions:", *printed.requested_turns(measurements, 3))

# %% [markdown] slideshow={"slide_type": "slide"}
# ### The pseudo-code
#
# | place | printed | correct | consequence |
# | --- | --- | --- | --- |
# | ARRAY_TO_HOMOGENEOUS | the third coordinate is never set | set it to 1 | no point is ever translated |
# | DotProduct(points, T) | `T` on the right | on the left of columns | the shapes do not fit |
# | SLAM_ROUTINE | `while is_running is not True` | `while is_running` | the loop never begins |
# | START | `is not None` | `is None` | opens a lidar only if scans are passed |
# | SLAM_ROUTINE | calls a method of the app on the lidar | call it on the app | fails at once |
# | 4.2.5 | naive points moved by one *step* | by the whole motion | the naive map stays at its origin |

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
points, T = np.array([[1.0, 2.0], [3.0, 4.0]]), matrix([5, 0, 0])
print("moved by 5 m:", (T @ printed.to_homogeneous(points))[:2].T.tolist())
print("correct:     ", transform([5, 0, 0], points).tolist())
print("SLAM_ROUTINE:", printed.slam_routine_iterations(), "iterations")

# %% [markdown] slideshow={"slide_type": "subslide"}
# No test in this appendix covers these errors:
#
# | place | printed | correct |
# | --- | --- | --- |
# | listing | two poor scans in a row: ICP on fewer than 3 points | count the points first |
# | `get_coordinates` | calls `scan()`: endless loop, two readers of a port | wait, with a time limit |
# | 4.2.5 | "after a gap no overlay is possible" | odometry continues: match with it |
# | recorded script | true steps are called "simulated error", and the wrong ones run | name them correctly |
# | prompt | "distance, angle" are sent as speeds in percent | see lesson [14](14_devices_and_live_slam.ipynb) |

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Lesson 15: loop closure
#
# | place | printed | correct | consequence |
# | --- | --- | --- | --- |
# | Tuček, chapter 3 | *loop closure* is the matching of two consecutive scans | that is scan matching (lesson [13](13_scan_matching.ipynb)) | the loop stays open |
# | chapter 3, first figure | the ends of a corridor meet | the chapter builds nothing that makes them meet | the figure has no program |
# | further work | areas that are seen again should be updated | a grid with clamped log-odds does this | points accumulate for ever |
#
# The next cell runs the matcher of the thesis, plain ICP with all correspondences, on the scans of the
# corridor in lesson 15:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
loop = simulation("corridor", np.random.default_rng(0))
ways = {"plain ICP": estimators.make("icp-plain", loop), "odometry": estimators.DeadReckoning()}
for name, estimator in ways.items():
    end = run(loop, estimator).trajectory.poses[-1]
    gap = 100 * np.hypot(*(end - loop.truth.poses[-1])[:2])
    print(f"{name:>9}: the last position is off by {gap:.0f} cm")

# %% [markdown] slideshow={"slide_type": "fragment"}
# In this run plain ICP is worse than odometry, because it uses all correspondences, including those of
# points that only one of the two scans contains.
