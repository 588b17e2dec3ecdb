# %% [markdown]
# # Exercise 03 · The Kalman filter
#
# **You will be able to** write the Kalman filter, test whether a filter is consistent and which of
# its noises is wrong, derive $F$, $Q$ and $H$ of a new system, and filter measurements with outliers.
#
# **60 minutes. Before:** lesson [03 · The Kalman filter](../notebooks/03_kalman_filter.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it. You can repeat this as often as you like. A check draws random inputs and names the law that
# your answer breaks. The check does not read your formulas. It compares your results with statistics
# of samples and with least-squares estimates. When you are stuck, `hint("03-update")` asks a question
# about your mistake; run it again for more.
#
# A belief is an estimate `x` (n,) of the state and the covariance `P` (n, n) of its error. In tasks
# 1 and 2 your functions must work for all sizes $n$ and $m$, where $m$ is the number of measured
# values. $m$ may be larger than $n$. $P$, $Q$ and $R$ are symmetric and positive definite. A
# function must not change its arguments, because its caller still needs them.

# %%
import numpy as np
from scipy.special import gammaincinv

from classroom.checks import ask, attempt, check
from slamlab import views
from slamlab.layers import Ellipses, Points

# %% [markdown]
# Two parts of the filter are given. The **prediction** is equation (03.11) without a control input.
# A step changes the true state to $F x + q$, and the process noise $q$ has the covariance $Q$. The
# **innovation** $v$ and its covariance $S$ are equations (03.13) and (03.14). A measurement of the
# true state is $z = H x + \varepsilon$, and the measurement noise $\varepsilon$ has the covariance
# $R$.


# %% name="ready"
def predict(x, P, F, Q):
    """The prior after a step: x (n,), P (n, n)."""
    return F @ x, F @ P @ F.T + Q


def innovation(x, P, z, H, R):
    """The innovation of a measurement, v (m,), and its covariance, S (m, m)."""
    return z - H @ x, H @ P @ H.T + R


# %% [markdown]
# The figures show the cart of the lesson. Its state consists of the position [m] and the speed
# [m/s]. A step takes half a second, and a range finder measures the position with $\sigma = 0.3$ m.

# %% name="cart"
CART = {
    "F": np.array([[1, 0.5], [0, 1]]),
    "Q": np.diag([0.02, 0.05]) ** 2,
    "H": np.array([[1.0, 0.0]]),
    "R": np.array([[0.3**2]]),
}
START = {"x": np.array([2.0, 0.5]), "P": np.diag([0.4, 0.3]) ** 2}

# %% [markdown]
# ## 1 · The update
#
# The update corrects the estimate by $K v$ (03.16). If $K$ is too small, the update makes little
# use of the measurement. If $K$ is too large, the update adds much of the measurement noise.

# %%
ask(
    "ex03-height",
    "The errors of position and speed are positively correlated. Only the *position* is measured, and "
    "the range comes out longer than predicted. **What happens to the estimated speed and to its "
    "variance?**",
    {
        "nothing: the speed was not measured": "this would be right if P were diagonal. Here a "
        "cart that is farther than estimated is on average also faster.",
        "the speed increases, and its variance decreases": "the row of K for the speed is positive, because the errors of speed and position are positively correlated.",
        "the speed increases, and its variance stays": "a measurement that corrects the speed also holds information about it.",
        "the speed increases, and so does its variance": "a large innovation changes x strongly, but an update never makes P larger.",
    },
    right="the speed increases, and its variance decreases",
)

# %% [markdown]
# **Your task.** Return the posterior after a measurement, `x` (n,) and `P` (n, n). You can use the
# given `innovation`. You can compute $P$ by (03.18), by
# (03.20) or by $(I - K H) P$. With the Kalman gain, all three results are equal. Use every
# measurement, however large its innovation is. The check compares your `x` and `P` with the
# weighted least-squares estimate and its covariance.


# %% name="update"
def update(x, P, z, H, R):
    """The posterior after a measurement.

    x : (n,), P : (n, n) prior;  z : (m,);  H : (m, n);  R : (m, m)
    returns x (n,), P (n, n)
    """
    ### BEGIN SOLUTION
    v, S = innovation(x, P, z, H, R)
    K = P @ H.T @ np.linalg.inv(S)
    return x + K @ v, P - K @ S @ K.T
    ### END SOLUTION


# %%
check("03-update")

# %% [markdown]
# The figure shows the prior of the cart after two seconds, and your posterior after a measured
# range of 4.0 m. The width of an ellipse shows the uncertainty of the position. Its height shows
# the uncertainty of the speed.


# %% name="before-and-after" answers="ex03-height"
@attempt
def _():
    x, P = np.array([3.0, 0.5]), np.array([[0.5, 0.2], [0.2, 0.15]])
    after, P_after = update(x, P, np.array([4.0]), CART["H"], CART["R"])
    rng = np.random.default_rng(5)
    fig, ax = views.axes(size=(8, 4.2))
    views.draw(
        ax, Points("carts", rng.multivariate_normal(x, P, 500)), color=views.COLOURS["sample"]
    )
    views.draw(ax, Ellipses("predicted", [x], [P]))
    views.draw(ax, Ellipses("corrected", [after], [P_after]), label="corrected")
    ax.axvline(4.0, color=views.COLOURS["scan"], linestyle=":", label="measured")
    ax.set(xlabel="position [m]", ylabel="speed [m/s]")
    views.legend(ax, loc="lower right")
    views.show(
        fig,
        alt="A wide ellipse that rises to the right, and a small ellipse at the measured range.",
    )


# %% [markdown] answers="ex03-height"
# With a correct update, the ellipse has moved towards the measured range *and* upwards. The cart is
# farther than estimated, so the cart is probably also faster. Both its width and its height have
# decreased.

# %% [markdown]
# ## 2 · The Kalman filter on a run
#
# **Your task.** Run the filter over a whole run, with the given `predict` and with your `update`.
# (You must solve task 1 first.) The arguments `x` and `P` are the belief *before* the first step.
# Row $k$ of `zs` is measured after step $k$, and `zs` has at least one row. Return one posterior
# for each measurement. Do not return the initial belief.
#
# The check estimates the state at each step from all measurements so far *at once*, as in the section
# *Deeper: batch least squares* of the lesson. Your `xs` and `Ps` must be equal to these estimates and
# their covariances, although your filter uses each measurement only once.


# %% name="kalman-filter"
def kalman_filter(x, P, zs, F, Q, H, R):
    """The posteriors of a whole run.

    x : (n,), P : (n, n) belief before the first step;  zs : (steps, m) measurements
    F, Q : (n, n);  H : (m, n);  R : (m, m)
    returns xs (steps, n), Ps (steps, n, n) : the posterior after each measurement
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
# The figure shows your filter's estimate of the speed in a run of 20 s. The speed is never
# measured.


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
    fig, ax = views.curves(
        seconds, {"your speed": xs[:, 1]}, "time [s]", "speed [m/s]", size=(8, 3.6)
    )
    ax.plot(seconds, np.array(states)[:, 1], color=views.COLOURS["truth"], label="true speed")
    blue = views.COLOURS["corrected"]
    ax.fill_between(seconds, xs[:, 1] - two_sigma, xs[:, 1] + two_sigma, color=blue, alpha=0.2)
    views.legend(ax)
    views.show(fig, alt="Your speed with its band of two σ, and the true speed beside it.")


# %% [markdown]
# ## 3 · Is the filter consistent?
#
# Two logs of a filter show whether its covariances are right. The first log contains $N$ independent
# runs at one time: the error $\tilde x$ of each run, which only a simulation knows, and the reported
# $P$. The second log contains one run: the innovation $v$ of each step, one number, and its reported
# variance $S$. At most one of $Q$ and $R$ in this run is wrong. Its $\sigma$ is then too small or
# too large, by a factor of at least 1.6.
#
# **Your task.** Return the mean NEES (03.24) of the runs and the mean NIS (03.25) of the steps, each
# followed by both bounds of its 95 % χ² interval, as in the lesson. Return also which noise is wrong.
# No function of the lesson states this. Which statistic of the innovations shows that a filter
# follows too slowly, and does a filter with too small a $Q$ follow too slowly, or one with too small
# an $R$?
#
# | what is judged | allowed error | points |
# | --- | --- | --- |
# | the means of `nees` and `nis` | 0.001 % | 1 |
# | the intervals of `nees` and `nis`, of 0.95 probability, 0.025 on each side | 0.001 % | 1 |
# | `wrong`, in runs of 400 steps of which the statistics show it clearly | all right | 1 |


# %% name="quantile"
def chi2_quantile(p, degrees):
    """The number below which χ² with these degrees of freedom lies with the probability p."""
    return 2 * gammaincinv(degrees / 2, p)


# %% name="consistency"
def consistency(errors, Ps, vs, Ss):
    """Tests of consistency, and which noise is wrong.

    errors : (N, n), Ps : (N, n, n) of N runs;  vs : (steps,), Ss : (steps,) of one run
    returns nees (3,), nis (3,) : mean, lower and upper bound;  wrong (2,) : for Q and for R,
    1 if it is too small, -1 if it is too large, 0 otherwise
    """
    ### BEGIN SOLUTION
    N, n = errors.shape
    steps = len(vs)
    total = np.einsum("ki,kij,kj", errors, np.linalg.inv(Ps), errors)
    white = vs / np.sqrt(Ss)
    nis = np.mean(white**2)
    tails = [0.025, 0.975]
    nees_interval = chi2_quantile(tails, n * N) / N
    nis_interval = chi2_quantile(tails, steps) / steps
    follows = np.mean(white[1:] * white[:-1])  # > 0: the filter follows too slowly
    size = int(nis > nis_interval[1]) - int(nis < nis_interval[0])
    wrong = [size, 0] if size * follows > 0 else [0, size]
    return [total / N, *nees_interval], [nis, *nis_interval], wrong
    ### END SOLUTION


# %%
check("03-consistent")

# %% [markdown]
# The next cell applies your functions to the cart. Its filter assumes noises that are wrong by the
# factors in the table.


# %% name="wrong-noises"
@attempt
def _():
    F, Q, H, R = CART.values()
    print("factors on σ: process, measurement   mean NIS   wrong")
    for q, r in [(1, 1), (0.25, 1), (4, 1), (1, 0.5), (1, 2)]:
        rng, truth, x, P = np.random.default_rng(7), START["x"], START["x"], START["P"]
        vs, Ss = np.zeros((2, 400))
        for k in range(400):
            truth = F @ truth + rng.multivariate_normal([0, 0], Q)
            z = H @ truth + rng.multivariate_normal([0], R)
            x, P = predict(x, P, F, q**2 * Q)
            vs[k], Ss[k] = (array.item() for array in innovation(x, P, z, H, r**2 * R))
            x, P = update(x, P, z, H, r**2 * R)
        _, nis, wrong = consistency(np.array([x - truth]), np.array([P]), vs, Ss)
        print(f"{q:18} {r:12} {nis[0]:14.2f}    {np.array(wrong).tolist()}")


# %% [markdown]
# ## 4 · Another system: a capacitor and its source
#
# The Kalman filter works for every linear system. Here the state $x = (V_C, V_S)$ holds two voltages
# in volts: $V_C$ of a capacitor, and $V_S$ of the source that charges it through a resistor. In a step
# of $dt$ seconds two things happen:
#
# 1. The voltage of the source is a random walk. At the *beginning* of the step it jumps by an unknown
#    voltage $j$, with mean zero and variance $\sigma^2\,dt$. After that it is constant until the end of
#    the step.
# 2. The voltage of the capacitor approaches the voltage of the source. During the step, the
#    difference between the two voltages is multiplied by $e^{-dt/\tau}$. The time constant $\tau$
#    is the product of resistance and capacitance (`ohms * farads`).
#
# Then two meters are read, each with its own measurement noise. A voltmeter measures $V_C$. An
# ammeter measures the current through the resistor, in amperes. The current is positive if $V_S >
# V_C$.
#
# Consider a single jump $j$ first. By how much does this jump change each of the two voltages at
# the end of the step?
#
# **Your task.** Derive $F$, $Q$ and $H$, each (2, 2), by the method of the lesson. For $Q$, write
# the error as a vector, multiply this vector by its transpose, and take the expected value. There
# is no control input. Resistance and capacitance are positive. `dt` may be small, large or zero,
# and `sigma` may be zero. The check compares each matrix with the effect of unit voltages and of
# jumps in a simulated step.


# %% name="capacitor"
def capacitor(dt, ohms, farads, sigma):
    """The matrices of the system for a step of dt seconds.

    dt : time [s];  ohms : resistance [Ω];  farads : capacitance [F]
    sigma : standard deviation of the source's change in one second [V]
    returns F (2, 2), Q (2, 2), H (2, 2)
    """
    ### BEGIN SOLUTION
    left = np.exp(-dt / (ohms * farads))
    F = np.array([[left, 1 - left], [0, 1]])
    jump = np.array([1 - left, 1])  # effect of a jump of 1 V on both voltages
    Q = sigma**2 * dt * np.outer(jump, jump)
    H = np.array([[1, 0], [-1 / ohms, 1 / ohms]])
    return F, Q, H
    ### END SOLUTION


# %%
check("03-capacitor")

# %% [markdown]
# Now your filter uses your matrices. No meter measures the source directly. Both meters are noisy:
# the voltmeter has $\sigma = 0.3$ V, and the ammeter has $\sigma = 0.3$ A.

# %%
ask(
    "ex03-lag",
    "The voltage of the capacitor lags behind the voltage of the source. **Does the estimated "
    "voltage of the source also lag behind the true voltage of the source?**",
    {
        "yes, by seconds, as the capacitor does": "the model contains this lag: F describes it, and the current is proportional to the difference of the voltages.",
        "hardly: one second after a jump, the estimate contains nearly all of the jump": "F models the lag of the capacitor, and the current measures the difference of the voltages.",
        "no, not even at the first reading": "each reading is noisy, so the first correction is only about two thirds of a jump.",
    },
    right="hardly: one second after a jump, the estimate contains nearly all of the jump",
)


# %% name="source" answers="ex03-lag"
@attempt
def _():
    rng, dt, steps = np.random.default_rng(12), 0.5, 80
    F, Q, H = (np.asarray(M, dtype=float) for M in capacitor(dt, 1.0, 4.0, 0.5))
    R, volts, source, states, zs = 0.3**2 * np.eye(2), 0.0, 5.0, [], []
    for _ in range(steps):
        source += rng.normal(0, 0.5 * np.sqrt(dt))
        volts = source + (volts - source) * np.exp(-dt / 4)
        states.append([volts, source])
        zs.append(np.array([volts, source - volts]) + rng.normal(0, 0.3, 2))
    xs, Ps = kalman_filter(np.array([0.0, 5.0]), np.eye(2), np.array(zs), F, Q, H, R)
    seconds, two_sigma = dt * np.arange(1, steps + 1), 2 * np.sqrt(Ps[:, 1, 1])
    true_volts, true_source = np.array(states).T
    shown = {"your source": xs[:, 1]}
    fig, ax = views.curves(seconds, shown, "time [s]", "voltage [V]", size=(8, 3.6))
    black = views.COLOURS["truth"]
    ax.plot(seconds, true_source, color=black, label="true source")
    ax.plot(seconds, true_volts, ":", color=black, label="true capacitor")
    blue = views.COLOURS["corrected"]
    ax.fill_between(seconds, xs[:, 1] - two_sigma, xs[:, 1] + two_sigma, color=blue, alpha=0.2)
    views.legend(ax)
    views.show(fig, alt="Your source, the true source, and the capacitor, which lags behind it.")


# %% [markdown] answers="ex03-lag"
# With correct matrices the estimate hardly lags. $F$ models the lag of the capacitor, and the
# current measures the difference of the two voltages. In a long run of this model, the error of the
# estimate after the first reading is on average a third of a jump. One second later the error is a
# twentieth of the jump. At that time the voltage of the capacitor still differs from the voltage of
# the source by two thirds of the jump.

# %% [markdown]
# ## 5 · Make it better: a filter for outliers
#
# The cart again measures its distance to a wall, and people walk through its corridor. Each reading
# is an **outlier** (false measurement) with the probability 1/4. An outlier does not depend on the
# state: it is uniformly distributed between 0 m and 10 m. The other readings are measurements as
# before, with the covariance $R$. The outliers are not marked. The odometry of the cart measures
# the change that each step adds to the state. Row $k$ of the argument `us` is this change $u$ in
# step $k$, so the true state becomes $F x + u + q$. It is the whole product $G u$ of (03.7), and
# you need no $G$.

# %%
ask(
    "ex03-outlier",
    "An outlier lies 4 m from the predicted range, and the Kalman filter uses it as a measurement. "
    "**What happens to its $P$?**",
    {
        "it grows, because the reading contradicts the prior": "the posterior P does not depend on the measured value. The contradiction changes x only.",
        "it stays the same": "the filter treats this reading as a measurement, and every measurement reduces P.",
        "it shrinks, as after any measurement": "x jumps, and P shrinks, because P does not depend on the innovation. The filter is then overconfident.",
    },
    right="it shrinks, as after any measurement",
)


# %% name="outliers"
OUTLIERS = 0.25  # probability that a reading is an outlier
REACH = 10.0  # outliers are uniform between 0 and this [m]


def run_with_outliers(rng, steps=50):
    """One run to and fro: the true states, and the arguments of wary_filter."""
    F, H = CART["F"], CART["H"]
    P, Q, R = np.diag([0.3, 0.2]) ** 2, np.diag([0.03, 0.08]) ** 2, np.array([[0.1**2]])
    position = 5 + 2.5 * np.sin(0.5 * np.arange(steps + 1) * 2 * np.pi / 15)
    truth = np.stack([position, np.gradient(position, 0.5)], axis=1)
    x = rng.multivariate_normal(truth[0], P)
    us = truth[1:] - truth[:-1] @ F.T + rng.multivariate_normal([0, 0], Q, steps)
    zs = truth[1:, :1] + rng.normal(0, 0.1, (steps, 1))
    outliers = rng.random((steps, 1)) < OUTLIERS
    zs[outliers] = rng.uniform(0, REACH, outliers.sum())
    return truth[1:], (x, P, us, zs, F, Q, H, R)


# %% [markdown]
# **Your task.** Write a filter that is robust to outliers. The noise is not Gaussian here, so
# another estimator can be better than the Kalman filter. Any method is allowed. You can reject
# readings with a large NIS, or give them less weight. You can weight both hypotheses (measurement
# or outlier) by their likelihoods. You can also follow several hypotheses, or process rejected
# readings again when later readings show that they were correct. The function gets the whole run at
# once, and row $k$ of your result may depend on any reading, also on later ones. The check judges
# only the results. Each row of `zs` contains one number. `OUTLIERS` and `REACH` are the same in all
# runs.
#
# The check runs your filter on 160 runs of 50 steps. The check ignores the first five steps of each
# run. The *typical error* is the median over the runs of the rms error of the position. The *doubtful*
# steps are the tenth of all steps in which a good filter has the largest variance of the position,
# because a reading may be an outlier or a measurement; the *clear* steps are the half with the
# smallest variances.
#
# | row | what is judged | limit | points |
# | --- | --- | --- | --- |
# | 1 | the typical error | at most a quarter of the typical error of the Kalman filter | 1 |
# | 2 | the typical error | at most 1.5 times the typical error of a Kalman filter that knows and omits the outliers | 1.5 |
# | 3 | the mean NEES (03.24), without the 10 % of the runs with the largest NEES | 1.62 to 2.2 in clear steps; in doubtful steps 0.6 to 1.28 times that of clear steps | 2 |
#
# The points of all rows that you reach are added. Row 3 also requires row 1, but not row 2. Leaving
# the arguments unchanged is worth another 0.5 points. A gate is welcome: with the right width it
# reaches rows 1 and 2. Row 3 is the hardest, and one factor on the $P$ of a gate does not reach it: the
# mean NEES must be near 2, as that of a consistent filter, in clear and in doubtful steps. Each $P$
# must be positive definite. The check stops after 20 s.


# %% name="wary-filter"
def wary_filter(x, P, us, zs, F, Q, H, R):
    """The posteriors of a run with outliers.

    x : (2,), P : (2, 2) belief before the first step;  us : (steps, 2) measured change in each step
    zs : (steps, 1) readings;  F, Q : (2, 2);  H : (1, 2);  R : (1, 1)
    returns xs (steps, 2), Ps (steps, 2, 2) : the posterior after each reading
    """
    ### BEGIN SOLUTION
    xs, Ps = [], []
    for u, z in zip(us, zs, strict=True):
        x, P = predict(x, P, F, Q)
        x = x + u
        v, S = (array.item() for array in innovation(x, P, z, H, R))
        K = P @ H[0] / S
        # density times prior probability, for both hypotheses: measurement and outlier
        real = (1 - OUTLIERS) * np.exp(-(v**2) / S / 2) / np.sqrt(2 * np.pi * S)
        share = real / (real + OUTLIERS / REACH)
        # mean and covariance over both hypotheses: the distance between their means adds variance
        x = x + share * v * K
        apart = share * (1 - share) * v**2
        P = P + (apart - share * S) * np.outer(K, K)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
    ### END SOLUTION


# %%
check("03-outliers")

# %% [markdown]
# The figure shows one run: the readings, your estimate and the true position.


# %% name="among-outliers"
@attempt
def _():
    truth, given = run_with_outliers(np.random.default_rng(8))
    xs, Ps = wary_filter(*given)
    seconds, two_sigma = 0.5 * np.arange(1, 51), 2 * np.sqrt(Ps[:, 0, 0])
    shown = {"your position": xs[:, 0]}
    fig, ax = views.curves(seconds, shown, "time [s]", "position [m]", size=(8, 3.8))
    ax.plot(seconds, truth[:, 0], color=views.COLOURS["truth"], label="true position")
    blue = views.COLOURS["corrected"]
    ax.fill_between(seconds, xs[:, 0] - two_sigma, xs[:, 0] + two_sigma, color=blue, alpha=0.2)
    ax.plot(seconds, given[3], ".", color=views.COLOURS["scan"], label="readings")
    ax.set_ylim(-0.5, 13)
    views.legend(ax, loc="upper center", ncols=3)
    views.show(
        fig,
        alt="Your position, the true position, and the readings: outliers are far from the true position.",
    )


# %% [markdown]
# **See:** your line should ignore the outliers, which are the dots far from the true position. The
# band of two σ should become wider where your filter rejects readings, or where a reading may be a
# measurement or an outlier.

# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then shows the grader's verdict. The grader draws other inputs.
# **Next:** lesson [04 · Motion and measurement models, Jacobians and the
# EKF](../notebooks/04_models_and_jacobians.ipynb) derives the matrices of a robot that turns.
