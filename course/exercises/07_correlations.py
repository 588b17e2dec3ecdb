# %% [markdown]
# # 07 · Correlations: exercise
#
# **You will be able to** say what two estimates share, follow how landmarks come to share it, use
# it (relative vectors, honest fusion), and show what becomes of a filter that forgets it.
#
# **50 minutes. Before:** lessons 03 to 07.
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it, as often as you like. A check tries random inputs and tells you which law is broken.
#
# Metres and radians throughout. The state is the robot's pose, three rows, and then two rows for
# each landmark; `P` is its covariance.

# %%
import numpy as np

from slamlab import views
from slamlab.checks import attempt, check
from slamlab.geometry import compose
from slamlab.models import H_landmark, H_robot

# %% [markdown]
# ## 1 · What is shared, without units
#
# The entries of P are in m², m·rad and rad²: hard to compare. The correlation is a pure number,
# $\rho_{ij} = P_{ij} / (\sigma_i \sigma_j)$, from −1 to 1.
#
# A robot at its start defines where the map lies: `P_rr = 0`. What is certain errs together with
# nobody else, so put 0 beside the diagonal in its rows and columns. On the diagonal 0 and 1 are
# both fine there.
#
# **Predict first.** What stands on the diagonal? What becomes of ρ when the map is drawn in
# centimetres?
#
# **Your task.** The matrix of all ρ.


# %%
def correlation(P):
    """The correlations ρ_ij = P_ij / (σ_i σ_j); beside the diagonal 0 where a variance is 0.

    P : (n, n) covariance;  returns (n, n)
    """
    ### BEGIN SOLUTION
    sigma = np.sqrt(np.diag(P))
    scale = np.zeros_like(sigma)
    scale[sigma > 0] = 1 / sigma[sigma > 0]
    return P * np.outer(scale, scale)
    ### END SOLUTION


# %%
check("07-correlation")

# %% [markdown]
# Your function on the MAK filter, half a loop after its start.


# %%
@attempt
def _():
    from slamlab.estimators import MakSlam
    from slamlab.sources.landmark_runs import LandmarkRun, Loop

    source = LandmarkRun(Loop(landmarks=8, steps=50), np.random.default_rng(7))
    slam = MakSlam(source.robot, source.sensor)
    for reading in source:
        slam.step(reading)
    names = ["r", *(f"p{i}" for i in slam.filter.ids)]
    fig, _ = views.correlation(correlation(slam.filter.P), names)
    views.show(fig, alt="The correlation matrix of a robot and the landmarks it has seen.")


# %% [markdown]
# **See:** the first landmarks were placed by a robot that was still certain, and share next to
# nothing. From then on each was placed by a robot in error, so all of them err together, with each
# other and with the robot.
#
# ## 2 · Two observations
#
# The example of the MAK thesis. Robot and two landmarks, P block-diagonal: nobody shares anything
# yet. The robot sees p1, then p2; it does not move in between. H_1 and H_2 are the whole (2, 7)
# Jacobians $[H_r\ \ H_p\ \ 0]$ and $[H_r\ \ 0\ \ H_p]$.
#
# **Predict first.** Which blocks of P are non-zero after the first sight? Which after the second?
# The robot learns something when it sees p2: does p1 get any surer?
#
# **Your task.** P after the first sight and after both. The thesis prints its formulas with several
# slips: derive, do not copy. The check also tries covariances that are full from the start.


# %%
def two_updates(P, H_1, H_2, R):
    """The covariance after one landmark was seen, and after the other was seen as well.

    P : (7, 7);  H_1, H_2 : (2, 7), by the whole state;  R : (2, 2), the noise of either sight
    returns P_first (7, 7), P_both (7, 7)
    """

    ### BEGIN SOLUTION
    def update(P, H):
        S = H @ P @ H.T + R
        K = P @ H.T @ np.linalg.inv(S)
        return P - K @ S @ K.T

    P_first = update(P, H_1)
    P_both = update(P_first, H_2)
    return P_first, P_both
    ### END SOLUTION


# %%
check("07-two-updates")

# %% [markdown]
# How the blocks fill up, one sight after the other:


# %%
@attempt
def _():
    P = np.diag([0.2, 0.2, 0.1, 0.5, 0.5, 0.5, 0.5]) ** 2
    H_a, H_b = (H_robot(np.array([0, 0, 0.3]), p) for p in ([2.0, 1.0], [1.0, -2.0]))
    none = np.zeros((2, 2))
    H_1, H_2 = np.hstack([H_a, -H_a[:, :2], none]), np.hstack([H_b, none, -H_b[:, :2]])
    P_first, P_both = two_updates(P, H_1, H_2, np.diag([0.05, 0.03]) ** 2)
    fig, axes = views.panels(["before", "p1 seen", "p2 seen, too"], (10, 3.4), shared=False)
    for ax, covariance in zip(axes, [P, P_first, P_both], strict=True):
        views.correlation(correlation(covariance), ["r", "p1", "p2"], ax=ax)
        ax.set(xlabel="", ylabel="", aspect="equal", adjustable="box")
    views.show(fig, alt="Three correlation matrices: diagonal, then r and p1 linked, then all.")
    sigmas = [np.sqrt(C[3, 3]) for C in (P, P_first, P_both)]
    print("σ of p1's x [m], before and after each sight:", np.round(sigmas, 3))


# %% [markdown]
# **See:** the last matrix has no white block left. Nobody ever measured from p1 to p2, and still they
# share an error: the robot's. And p1 got a little surer by the sight of p2.
#
# ## 3 · From one landmark to another
#
# The map may lie askew in the world and still be right in itself. What counts in it are the
# vectors from landmark to landmark, $\Delta p = p_j - p_i$.
#
# **Predict first.** Two landmarks are each known to ± 1 m, and share all of their error. How well
# is Δp known?
#
# **Your task.** Δp and its covariance, from the state. Python counts from 0, so does `i`: landmark
# `i` stands in the rows 3 + 2i and 4 + 2i.


# %%
def relative(x, P, i, j):
    """The vector from landmark i to landmark j, and its covariance.

    x : (3 + 2N,) state;  P : (3 + 2N, 3 + 2N);  i, j : which landmarks, counted from 0
    returns delta (2,), P_delta (2, 2)
    """
    ### BEGIN SOLUTION
    a, b = slice(3 + 2 * i, 5 + 2 * i), slice(3 + 2 * j, 5 + 2 * j)
    P_delta = P[a, a] - P[a, b] - P[b, a] + P[b, b]
    return x[b] - x[a], P_delta
    ### END SOLUTION


# %%
check("07-relative")

# %% [markdown]
# Two laps of a loop. The two landmarks lie on its far side, where the robot is least sure.


# %%
@attempt
def _():
    from slamlab.estimators import MakSlam
    from slamlab.sources.landmark_runs import LandmarkRun, Loop

    source, spreads = LandmarkRun(Loop(steps=170), np.random.default_rng(7)), []
    slam = MakSlam(source.robot, source.sensor)
    for reading in source:
        slam.step(reading)
        if {5, 6} <= set(slam.filter.ids):
            i, j = slam.filter.ids.index(5), slam.filter.ids.index(6)
            _, P_delta = relative(slam.filter.x, slam.filter.P, i, j)
            blocks = [slam.filter.block(slam.filter.rows([k])) for k in (5, 6)]
            spreads.append([np.sqrt(np.trace(C)) for C in (*blocks, P_delta)])
    steps = np.arange(len(source) - len(spreads), len(source))
    ys = dict(zip(["p5", "p6", "Δp, by your function"], np.transpose(spreads), strict=True))
    fig, _ = views.curves(steps, ys, "step", "root of the trace [m]")
    views.show(fig, alt="How unsure two landmarks and the vector between them are, over two laps.")


# %% [markdown]
# **See:** Δp is known far better than either end, and no curve ever rises. About step 67 the robot
# is back where it began and all three fall at once, with neither landmark in sight: that is what
# correlations do.
#
# ## 4 · Two estimates that share an error
#
# The same landmark was estimated twice, as `a` and as `b`, by a robot that was lost by the same
# bit both times. Their errors $\tilde a, \tilde b$ have covariances `P_a`, `P_b`, and share
# $P_{ab} = E[\tilde a\,\tilde b^T]$. We look for $x = a + K\,(b - a)$.
#
# Take $b - a$ for the innovation. From lesson 03 you know the best gain, $K = S_{xv} S^{-1}$: the
# covariance of the error of a with that of the innovation, $\tilde a - \tilde b$, times the inverse
# of the innovation's own. Then $P = P_a - K S K^T$. But what are $S_{xv}$ and $S$ here?
#
# **Predict first.** `P_a = P_b = I`. How sure is the best x if the two share nothing? And if they
# share nearly everything?
#
# **Your task.** x and its covariance. The check simulates many pairs, has you fuse each, and
# measures the errors that come out: your P must be their covariance, and nothing may be left
# in a − b that would make x better.


# %%
def fuse(a, P_a, b, P_b, P_ab):
    """The best estimate from two that share an error, and its covariance.

    a, b : (2,) [m];  P_a, P_b : (2, 2) [m²];  P_ab : (2, 2), row for the error of a, column for b
    returns x (2,), P (2, 2)
    """
    ### BEGIN SOLUTION
    S = P_a + P_b - P_ab - P_ab.T
    K = (P_a - P_ab) @ np.linalg.inv(S)
    return a + K @ (b - a), P_a - K @ S @ K.T
    ### END SOLUTION


# %%
check("07-fuse")

# %% [markdown]
# 500 pairs whose errors have a large share in common, fused by you, and by you without P_ab.


# %%
@attempt
def _():
    common, own = np.diag([0.30, 0.15]) ** 2, np.diag([0.10, 0.10]) ** 2
    P_a, P_b, P_ab = common + own, common + 2 * own, common
    joint = np.block([[P_a, P_ab], [P_ab.T, P_b]])
    pairs = np.random.default_rng(7).multivariate_normal(np.zeros(4), joint, 500)
    errors = np.array([fuse(e[:2], P_a, e[2:], P_b, P_ab)[0] for e in pairs])
    claims = {
        "your P, 95 %": fuse(np.zeros(2), P_a, np.zeros(2), P_b, P_ab)[1],
        "P_ab ignored": fuse(np.zeros(2), P_a, np.zeros(2), P_b, 0 * P_ab)[1],
    }
    fig, _ = views.cloud(errors, claims)
    views.show(fig, alt="The errors of 500 fused estimates and two ellipses claimed for them.")


# %% [markdown]
# **See:** 95 of 100 errors should lie in your ellipse. The other one claims that two estimates halve
# a doubt that both have from the same source.
#
# ## 5 · SLAM in a corridor
#
# A robot in one dimension: `x[0]` is its position, `x[1]`, `x[2]`, … are doors. It drives a way
# `d` (variance `q`) and then sees door `i` at the distance `z` ahead (variance `r`), negative if
# the door lies behind: $z = x_i - x_0 + \text{noise}$. All is linear, so the filter is exact.
#
# **Predict first.** The robot has seen all doors, then drives far and sees door 1 again, 30 cm
# nearer than expected. Which estimates change? Do those of doors 2 and 3?
#
# **Your task.** One step: drive, then see. The check runs 90 walks with it and asks whether the
# errors at the end are as large as your P says (NEES).


# %%
def step(x, P, d, q, i, z, r):
    """Drive by d, then see door i at the distance z.

    x : (n,) robot, then doors [m];  P : (n, n);  d [m], q [m²] : the drive and its variance
    i : which entry of x is the door;  z [m], r [m²] : its distance and its variance
    returns x (n,), P (n, n)
    """
    ### BEGIN SOLUTION
    x, P = x.copy(), P.copy()
    x[0] += d
    P[0, 0] += q
    H = np.zeros(len(x))
    H[0], H[i] = -1, 1
    S = H @ P @ H + r
    K = P @ H / S
    return x + K * (z - H @ x), P - S * np.outer(K, K)
    ### END SOLUTION


# %%
check("07-corridor")

# %% [markdown]
# And now forget. The same filter, with everything beside the diagonal thrown away after each step:


# %%
@attempt
def _():
    from slamlab.evaluation import band, nees

    rng, runs, steps = np.random.default_rng(7), 60, 18
    doors, means = np.array([2.0, 5.0, 9.0]), {}
    for name, kept in [("kept", np.ones((4, 4))), ("forgotten", np.eye(4))]:
        found = np.zeros((runs, steps))
        for run in range(runs):
            true, P = np.concatenate([[0], doors]), np.diag([0, 4.0, 4.0, 4.0])
            x = true + [0, 2, 2, 2] * rng.standard_normal(4)
            for k in range(steps):
                true[0] = 4 + 4 * np.sin(0.7 * k - 0.2)
                d = true[0] - (4 + 4 * np.sin(0.7 * k - 0.9) if k else 0)
                i, z_noise = 1 + k % 3, 0.06 * rng.standard_normal()
                z = true[i] - true[0] + z_noise
                x, P = step(x, P, d + 0.1 * rng.standard_normal(), 0.01, i, z, 0.0036)
                P = P * kept
                found[run, k] = nees(x - true, P)
        means[f"correlations {name}"] = found.mean(axis=0)
    low, high = band(4, runs)
    fig, ax = views.curves(np.arange(1, steps + 1), means, "step", "mean NEES of 60 runs")
    ax.axhspan(low, high, color=views.COLOURS["guide"], zorder=0)
    views.show(fig, alt="Mean NEES over steps: inside its band, and far above it when forgotten.")


# %% [markdown]
# **See:** in the grey band 95 of 100 honest filters lie (4 unknowns, so 4 on average). The filter
# that forgets leaves it as soon as doors come in sight a second time, and gets ever surer of itself:
# it takes the same old error for news.
#
# ## 6 · First estimates
#
# Whatever a robot sees, nobody can tell it where the whole map lies: a shift along x, along y and a
# turn of *everything* change no range and no bearing. A step of the filter carries an error by A,
# a sight looks at it by H. So for these three directions $H_k A_{k-1} \cdots A_0$ must give zero.
#
# It does at the truth. But the EKF takes its Jacobians at estimates, and every update moves them: it
# reads a heading off its own corrections. The cure is to use for each thing the *first* estimate
# there was of it: of a pose, the predicted one; of a landmark, the one it was placed with.
#
# **Predict first.** Which of the three directions is in danger, and why not the other two?
#
# **Your task.** A and H of a whole run. For any motion, with the displacement (Δx, Δy) from pose to
# pose, $A = \begin{bmatrix}1&0&-\Delta y\\0&1&\Delta x\\0&0&1\end{bmatrix}$. `H_robot(x, p)` (2, 3)
# and `H_landmark(x, p)` (2, 2) of lesson 04 are there already.


# %%
def first_estimates(predicted, updated, landmarks):
    """A and H of a run with one landmark, at the first estimates.

    predicted, updated : (n, 3) the pose of each step before and after its update
    landmarks : (n, 2) the landmark, as each step found it; row 0 is where it was placed
    returns A (n - 1, 3, 3) from each step to the next, H (n, 2, 5) by robot and landmark
    """
    ### BEGIN SOLUTION
    A = np.tile(np.eye(3), (len(predicted) - 1, 1, 1))
    dx, dy = np.diff(predicted[:, :2], axis=0).T
    A[:, 0, 2], A[:, 1, 2] = -dy, dx
    H_r = np.array([H_robot(x, landmarks[0]) for x in predicted])
    return A, np.concatenate([H_r, -H_r[:, :, :2]], axis=2)
    ### END SOLUTION


# %%
check("07-first-estimates")

# %% [markdown]
# What a real run's sights seem to tell of a turn of the whole map, with your Jacobians and with
# the usual ones, those at the latest estimates:


# %%
@attempt
def _():
    from slamlab.estimators import MakSlam
    from slamlab.sources.landmark_runs import LandmarkRun, Loop

    source = LandmarkRun(Loop(landmarks=6, steps=80, range_max=12), np.random.default_rng(7))
    slam, poses, ends, places = MakSlam(source.robot, source.sensor), [], [], []
    for reading in source:
        begun = slam.filter.landmarks()
        before = compose(slam.filter.pose, reading.odometry)
        slam.step(reading)
        if len(begun):
            poses, ends = [*poses, before], [*ends, slam.filter.pose]
            places.append(begun[0])
    poses, ends, places = np.array(poses), np.array(ends), np.array(places)
    yours = first_estimates(poses.copy(), ends.copy(), places.copy())
    usual = np.tile(np.eye(3), (len(poses) - 1, 1, 1))
    usual[:, 0, 2], usual[:, 1, 2] = (ends[:-1] - poses[1:])[:, 1], (poses[1:] - ends[:-1])[:, 0]
    at = list(zip(poses, places, strict=True))
    H = np.array([np.hstack([H_robot(x, p), H_landmark(x, p)]) for x, p in at])
    told = {}
    for name, (As, Hs) in {"usual Jacobians": (usual, H), "yours": yours}.items():
        turn = np.array([-poses[0, 1], poses[0, 0], 1, -places[0, 1], places[0, 0]])
        seen = []
        for k in range(len(poses)):
            seen.append(np.sum((Hs[k] @ turn / [0.1, np.radians(2)]) ** 2))
            turn[:3] = As[min(k, len(As) - 1)] @ turn[:3]
        told[name] = np.cumsum(seen)
    fig, _ = views.curves(np.arange(len(poses)), told, "step", "information on the turn [1/rad²]")
    views.show(fig, alt="Information on the map's heading: growing, and zero with first estimates.")


# %% [markdown]
# **See:** nothing in this world tells which way the map is turned. The usual EKF believes to learn
# it, a little with each update, and the noisier the wheels, the more: this is how its NEES leaves
# the band. Yours learns nothing, as is right.
#
# ## Done?
#
# Save the notebook. The cell below then says what the grader will say about it;
# the grader draws other inputs. Correlations stay with you: in lesson 08 the landmarks lose their
# names, and S, with all it shares, decides which is which.
