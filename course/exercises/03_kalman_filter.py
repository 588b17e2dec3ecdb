# %% [markdown]
# # Exercise 03 · The Kalman filter
#
# **You will be able to** write a Kalman filter from its parts, and say of each part what it
# promises.
#
# **45 minutes. Before:** lesson [03 · The Kalman filter](../notebooks/03_kalman_filter.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it, as often as you like. A check draws random beliefs and matrices, tells you which law is
# broken, and what the mistake is where it knows it. It never looks at your formulas: it moves
# samples, and solves least squares problems.
#
# A belief is a state `x` (n,) and the covariance `P` (n, n) of its error. All sizes are general:
# three states and two measured numbers in the checks, the cart's two states and one range in the
# pictures.

# %%
import numpy as np

from slamlab import views
from slamlab.checks import attempt, check
from slamlab.layers import Ellipses

# %% [markdown]
# The cart of the pictures: position [m] and speed [m/s], steps of half a second, no motor. It
# slips, and a range finder with σ = 0.3 m sees its position.

# %% name="cart"
CART = {
    "F": np.array([[1, 0.5], [0, 1]]),
    "Q": np.diag([0.02, 0.05]) ** 2,
    "H": np.array([[1.0, 0.0]]),
    "R": np.array([[0.3**2]]),
}
START = {"x": np.array([2.0, 0.5]), "P": np.diag([0.4, 0.3]) ** 2}

# %% [markdown]
# ## 1 · Prediction
#
# A step moves the truth to F x + q; q has mean zero and the covariance Q, and knows nothing of the
# errors so far. What does the belief become?
#
# **Predict first.** Position and speed of the start are unrelated. After one step, are they still?
#
# **Your task.** The belief after the step.


# %% name="predict"
def predict(x, P, F, Q):
    """The belief after a step.

    x : (n,) state;  P : (n, n) covariance of its error
    F : (n, n) how the state moves;  Q : (n, n) covariance of the slip;  returns x (n,), P (n, n)
    """
    ### BEGIN SOLUTION
    return F @ x, F @ P @ F.T + Q
    ### END SOLUTION


# %%
check("03-predict")

# %% [markdown]
# Your P as an ellipse, over 500 carts that rolled for two seconds. 95 of 100 should be inside.


# %% name="rolling-carts"
@attempt
def _():
    rng = np.random.default_rng(3)
    x, P = START["x"], START["P"]
    carts = rng.multivariate_normal(x, P, 500)
    for _ in range(4):
        carts = carts @ CART["F"].T + rng.multivariate_normal([0, 0], CART["Q"], 500)
        x, P = predict(x, P, CART["F"], CART["Q"])
    fig, ax = views.cloud(carts, {"your P, 95 %": P}, "after two seconds")
    ax.plot(*x, "x", color=views.COLOURS["truth"], markersize=10, label="your x")
    ax.set(xlabel="position [m]", ylabel="speed [m/s]")
    ax.legend()
    views.show(fig, alt="500 carts after two seconds and the ellipse of your P.")


# %% [markdown]
# ## 2 · The innovation
#
# A measurement is z = H x + r of the true x; the noise r has the covariance R. The innovation v is
# what is *new* in z. S is its covariance: how large innovations are, if the belief is right.
#
# **Predict first.** The cart's position is known to 0.4 m, the range finder errs by 0.3 m. Which σ
# has the innovation: 0.3, 0.4, 0.5 or 0.7 m?
#
# **Your task.** v and S.


# %% name="innovation"
def innovation(x, P, z, H, R):
    """What is new in a measurement, and the covariance of that.

    x : (n,), P : (n, n) belief;  z : (m,) measurement;  H : (m, n) what is measured of the state
    R : (m, m) covariance of the measurement's noise;  returns v (m,), S (m, m)
    """
    ### BEGIN SOLUTION
    return z - H @ x, H @ P @ H.T + R
    ### END SOLUTION


# %%
check("03-innovation")

# %% [markdown]
# How surprised should the cart be? The innovation in units of its σ; above 3, something is wrong
# with the belief, or with the measurement.


# %% name="surprise"
@attempt
def _():
    for measured in (2.1, 2.6, 5.0):
        v, S = innovation(START["x"], START["P"], np.array([measured]), CART["H"], CART["R"])
        print(f"measured {measured} m: v = {v[0]:+.2f} m, that is {v[0] / np.sqrt(S[0, 0]):+.1f} σ")


# %% [markdown]
# ## 3 · The gain
#
# Correct the estimate by K v. A small K ignores what was measured, a large one copies its noise.
# The best K leaves the least mean square error, summed over all states.
#
# **Predict first.** The belief says that who is farther is also faster. The range comes out longer
# than expected. Should the *speed* be corrected? What if P is diagonal?
#
# **Your task.** The best K. The check changes each entry of your K a little, both ways, and looks
# whether samples come out better.


# %% name="gain"
def gain(P, H, R):
    """The gain that leaves the least mean square error.

    P : (n, n) belief;  H : (m, n);  R : (m, m);  returns K (n, m)
    """
    ### BEGIN SOLUTION
    S = H @ P @ H.T + R
    return P @ H.T @ np.linalg.inv(S)
    ### END SOLUTION


# %%
check("03-gain")

# %% [markdown]
# Your gain, made smaller and larger, on 20 000 carts. Where must the lowest point be?


# %% name="too-much-or-too-little"
@attempt
def _():
    rng = np.random.default_rng(4)
    H, R, P = CART["H"], CART["R"], np.array([[0.5, 0.2], [0.2, 0.15]])
    errors = rng.multivariate_normal([0, 0], P, 20_000)
    innovations = errors @ H.T + rng.multivariate_normal([0], R, 20_000)
    shares = np.linspace(0, 2, 21)
    left = [
        np.mean(np.sum((errors - innovations @ (share * gain(P, H, R)).T) ** 2, axis=1))
        for share in shares
    ]
    fig, _ = views.curves(
        shares, {"20 000 carts": left}, "share of your gain", "mean square error left"
    )
    views.show(fig, alt="A curve over the share of your gain, lowest where the share is one.")


# %% [markdown]
# ## 4 · The update
#
# **Predict first.** Does P after the update depend on what was measured?
#
# **Your task.** The belief after a measurement. Use your `innovation` and `gain`, or write it anew.
# For P take the form you like: with the best gain all of the lesson's forms are equal.


# %% name="update"
def update(x, P, z, H, R):
    """The belief after a measurement.

    x : (n,), P : (n, n) belief before;  z : (m,);  H : (m, n);  R : (m, m)
    returns x (n,), P (n, n)
    """
    ### BEGIN SOLUTION
    v, S = innovation(x, P, z, H, R)
    K = gain(P, H, R)
    return x + K @ v, P - K @ S @ K.T
    ### END SOLUTION


# %%
check("03-update")

# %% [markdown]
# The cart's belief after two seconds, before and after it measures a range of 4.0 m. Only the
# position is measured. **Before you run it:** what happens to the ellipse's height?


# %% name="before-and-after"
@attempt
def _():
    x, P = np.array([3.0, 0.5]), np.array([[0.5, 0.2], [0.2, 0.15]])
    after, P_after = update(x, P, np.array([4.0]), CART["H"], CART["R"])
    rng = np.random.default_rng(5)
    fig, ax = views.cloud(rng.multivariate_normal(x, P, 500), {"before": P})
    views.draw(ax, Ellipses("after", [after], [P_after]), color=views.COLOURS["naive"])
    ax.axvline(4.0, color=views.COLOURS["truth"], linestyle=":", label="measured")
    ax.set(xlabel="position [m]", ylabel="speed [m/s]")
    views.legend(ax, loc="lower right")
    views.show(fig, alt="A wide leaning ellipse before, a small one near the measured line after.")


# %% [markdown]
# The ellipse has moved towards the measured line *and* upwards: the cart is farther than it
# believed, so it is probably faster, too.

# %% [markdown]
# ## 5 · The whole filter
#
# **Your task.** Run it, with your `predict` and `update` (the check asks for these two first). The
# start is the belief *before* the first step; each row of `zs` is measured after one more step.
# Return all beliefs, one after each measurement, the start left out.
#
# The check lets your filter follow 60 drives and asks two things: does it know, at each step, as
# much as a least squares solution that keeps *everything*? And are the errors as large as P says
# (NEES)?


# %% name="kalman-filter"
def kalman_filter(x, P, zs, F, Q, H, R):
    """The beliefs of a whole drive.

    x : (n,), P : (n, n) belief before the first step;  zs : (steps, m) measurements
    F, Q : (n, n);  H : (m, n);  R : (m, m)
    returns xs (steps, n), Ps (steps, n, n) : the belief after each measurement
    """
    ### BEGIN SOLUTION
    xs, Ps = [], []
    for z in zs:
        x, P = predict(x, P, F, Q)
        x, P = update(x, P, z, H, R)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
    ### END SOLUTION


# %%
check("03-filter")

# %% [markdown]
# Your filter on a drive of 20 s: what it believes of the speed, which is never measured.


# %% name="drive"
@attempt
def _():
    rng = np.random.default_rng(6)
    truth, states, zs = rng.multivariate_normal(START["x"], START["P"]), [], []
    for _ in range(40):
        truth = CART["F"] @ truth + rng.multivariate_normal([0, 0], CART["Q"])
        states.append(truth)
        zs.append(CART["H"] @ truth + rng.normal(0, 0.3, 1))
    xs, Ps = kalman_filter(START["x"], START["P"], np.array(zs), **CART)
    seconds, two_sigma = 0.5 * np.arange(1, 41), 2 * np.sqrt(Ps[:, 1, 1])
    shown = {"your speed": xs[:, 1], "true speed": np.array(states)[:, 1]}
    fig, ax = views.curves(seconds, shown, "time [s]", "speed [m/s]")
    blue = views.COLOURS["corrected"]
    ax.fill_between(seconds, xs[:, 1] - two_sigma, xs[:, 1] + two_sigma, color=blue, alpha=0.2)
    views.show(fig, alt="Your speed with its band of two σ, and the true speed inside it.")


# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then says what the grader will say about it;
# the grader draws other inputs. **Next:** lesson
# [04 · Models and Jacobians](../notebooks/04_models_and_jacobians.ipynb): F and H of a robot that
# turns.
