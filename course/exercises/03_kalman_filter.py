# %% [markdown]
# # Exercise 03 · The Kalman filter
#
# **You will be able to** turn the best gain into code, write the filter around it, find $F$, $Q$
# and $H$ of a system that nobody has modelled for you, and repair a filter whose measurements are
# not what was promised.
#
# **60 minutes. Before:** lesson [03 · The Kalman filter](../notebooks/03_kalman_filter.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it, as often as you like. A check draws random inputs and tells you which law is broken; where it
# recognises a mistake, it tells you that, too. It never looks at your formulas: it moves samples
# and solves least squares problems. When you are stuck, `hint("03-gain")` asks a question that
# leads on.
#
# A belief is a state `x` (n,) and the covariance `P` (n, n) of its error. In tasks 1 to 3 all sizes
# are general: there may be one state or many, and one measured number, a few, or even more than
# there are states. $P$, $Q$ and $R$ are symmetric and positive definite. A function may not change
# its arguments, because whoever called it still needs them.

# %%
import numpy as np

from slamlab import views
from slamlab.checks import ask, attempt, check
from slamlab.layers import Ellipses, Points

# %% [markdown]
# Two pieces of the filter are ready, because each follows from the lesson's recipe in a line. The
# **prediction** is (03.8): a step moves the truth to $F x + q$, and $q$ has the covariance $Q$. The
# **innovation** is (03.10) and (03.11): a measurement is $z = H x + \varepsilon$ of the true $x$,
# and $\varepsilon$ has the covariance $R$; $v$ is what is new in $z$, and $S$ is the covariance of
# $v$.


# %% name="ready"
def predict(x, P, F, Q):
    """The belief after a step: x (n,), P (n, n)."""
    return F @ x, F @ P @ F.T + Q


def innovation(x, P, z, H, R):
    """What is new in a measurement, v (m,), and its covariance, S (m, m)."""
    return z - H @ x, H @ P @ H.T + R


# %% [markdown]
# The cart in the pictures is the lesson's. Its state is position [m] and speed [m/s], a step takes
# half a second, and a range finder with $\sigma = 0.3$ m sees its position.

# %% name="cart"
CART = {
    "F": np.array([[1, 0.5], [0, 1]]),
    "Q": np.diag([0.02, 0.05]) ** 2,
    "H": np.array([[1.0, 0.0]]),
    "R": np.array([[0.3**2]]),
}
START = {"x": np.array([2.0, 0.5]), "P": np.diag([0.4, 0.3]) ** 2}

# %% [markdown]
# ## 1 · The gain
#
# The estimate is corrected by $K v$. A small $K$ ignores what was measured, a large one copies its
# noise. The best $K$ leaves the least mean square error, summed over all states; and since every
# other gain adds a square to what is left, the same $K$ is best for each state by itself.

# %%
ask(
    "ex03-height",
    "The belief is a leaning ellipse: a cart that is farther is also faster. Only the *position* is "
    "measured, and the range comes out longer than expected. **What happens to the speed and to its "
    "doubt?**",
    {
        "nothing: the speed was not measured": "that is right where P is diagonal. Here a cart "
        "that is farther is probably faster.",
        "the speed goes up, and its doubt gets smaller": "K has a row for the speed, since its error goes with that of the position.",
        "the speed goes up, and its doubt stays": "what moves the speed also tells something about it.",
        "the speed goes up, and its doubt grows, because it was off": "a surprise moves x. It never makes P larger.",
    },
    right="the speed goes up, and its doubt gets smaller",
)

# %% [markdown]
# **Your task.** Return the best $K$, (n, m). $H$ may be any matrix. A sensor may even see nothing
# of the state, and then $H$ is zero.


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
# Here 20 000 carts are corrected with shares of your gain, from none of it to twice as much. Where
# must the lowest point be?


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
    fig, ax = views.chart("share of your gain [1]", "mean square error left", size=(8, 3.6))
    ax.plot(shares, left, color=views.COLOURS["corrected"])
    lowest = shares[np.argmin(left)]
    views.show(fig, alt=f"A curve over the share of your gain, lowest at {lowest:.1f}.")


# %% [markdown]
# ## 2 · The update
#
# **Your task.** Return the belief after a measurement, `x` (n,) and `P` (n, n). Use your `gain` and
# the ready `innovation`, or write everything anew. For $P$ take whichever form you like: with the
# best gain all forms of the lesson are equal. Take in every measurement, however far off it is.


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
# The picture shows the cart's belief after two seconds, and what your update makes of it when a
# range of 4.0 m is measured. The width of an ellipse is the doubt about the position, and its height
# that about the speed.


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
    views.show(fig, alt="A wide leaning ellipse before, a small one near the measured line after.")


# %% [markdown] answers="ex03-height"
# With a right update, the ellipse has moved towards the measured line *and* upwards: the cart is
# farther than it believed, so it is probably faster, too. And the ellipse has become flatter.

# %% [markdown]
# ## 3 · The whole filter
#
# **Your task.** Run the filter over a whole drive, with the ready `predict` and with your `update`,
# which the check asks for first. The start is the belief *before* the first step. Each row of `zs`
# is measured after one more step, and there is at least one row. Return all beliefs, one after each
# measurement, without the start.
#
# The check takes all measurements up to each step *at once*, like the patient one in the lesson's
# section *Deeper: was anything lost on the way?* Your filter has to know as much at each step,
# although it looks at each measurement only once.


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
# On a drive of 20 s, this is what your filter believes of the speed, which is never measured.


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
# ## 4 · A system that is no cart
#
# A filter does not know what its states are. Here they are two voltages, that of a capacitor,
# $V_C$, and that of the source that charges it through a resistor, $V_S$. The state is
# $x = (V_C, V_S)$ in volts. In a step of $dt$ seconds two things happen:
#
# 1. The source wanders. At the *beginning* of the step it jumps by an unknown voltage $j$, whose mean
#    is zero and whose variance is $\sigma^2\,dt$. Afterwards it keeps its voltage to the end of the
#    step.
# 2. The capacitor follows the source. Of the difference between the two voltages, the share
#    $e^{-dt/\tau}$ is left at the end of the step; $\tau$ is the product of resistance and capacitance,
#    ohms · farads.
#
# Then two meters are read, each with a noise of its own. A voltmeter shows $V_C$. An ammeter shows
# the current through the resistor, in amperes, which is positive while the capacitor is charged.
#
# Think of a single jump $j$ first. What does it make of each of the two voltages, by the end of the
# step?
#
# **Your task.** Derive $F$, $Q$ and $H$, each (2, 2), by the lesson's recipe: write the error,
# multiply it by its transpose, take the expected value. Resistance and capacitance are positive. A
# step may be short or long or take no time at all, and `sigma` may be zero.


# %% name="capacitor"
def capacitor(dt, ohms, farads, sigma):
    """The system for a step of dt seconds.

    dt : time [s];  ohms : resistance [Ω];  farads : capacitance [F]
    sigma : by how much the source wanders in a second [V], one standard deviation
    returns F (2, 2), Q (2, 2), H (2, 2)
    """
    ### BEGIN SOLUTION
    left = np.exp(-dt / (ohms * farads))
    F = np.array([[left, 1 - left], [0, 1]])
    jump = np.array([1 - left, 1])  # what one volt of j makes of both voltages
    Q = sigma**2 * dt * np.outer(jump, jump)
    H = np.array([[1, 0], [-1 / ohms, 1 / ohms]])
    return F, Q, H
    ### END SOLUTION


# %%
check("03-capacitor")

# %% [markdown]
# Now your filter runs with your matrices. Nobody measures the source, and both meters are bad: the
# voltmeter has $\sigma = 0.3$ V, the ammeter $\sigma = 0.3$ A.

# %%
ask(
    "ex03-lag",
    "The capacitor lags behind the source that charges it. **Will the estimate of the source lag "
    "behind it, too?**",
    {
        "yes, by seconds, as the capacitor does: all that we know comes through it": "it does, but F says how the capacitor follows, and the current says how far it is behind.",
        "hardly: a second after a jump it has found nearly all of it": "the model knows why the capacitor is behind, and the current says by how much.",
        "not even by one reading": "each reading is noisy, so the filter takes over only some two thirds of a jump at once.",
    },
    right="hardly: a second after a jump it has found nearly all of it",
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
# With right matrices the estimate hardly lags. From $F$ the filter knows *why* the capacitor is
# behind, and from the current by how much. In a long run of this model the estimate misses a third of
# a jump at the first reading, and a twentieth of it a second later; the capacitor then still misses
# two thirds.

# %% [markdown]
# ## 5 · Make it better: ghosts
#
# The cart again faces a wall, and people walk through its corridor. One reading in four is a
# *ghost*: it has nothing to do with the cart, and says anything between 0 m and 10 m, each as
# likely as the other. The other three are measurements as before, with the covariance $R$. No
# reading tells which of the two it is. The cart also has sensors of its own, which tell in each
# step what was added to its state: the truth becomes $F x + u + q$.

# %%
ask(
    "ex03-ghost",
    "The lesson's filter takes a ghost that is 4 m off for a measurement. **What becomes of its $P$?**",
    {
        "it grows, since the reading contradicts the belief": "P after an update does not depend on what was measured. The contradiction moves x, and leaves no "
        "other trace.",
        "it stays as it is": "the filter believes that it has learned something, as from any reading.",
        "it shrinks, as after any measurement": "x jumps, and the filter claims to be surer than before. Nothing in P says that something was odd.",
    },
    right="it shrinks, as after any measurement",
)


# %% name="ghosts"
GHOSTS = 0.25  # the share of ghosts among the readings
REACH = 10.0  # a ghost says anything between 0 and this [m]


def ghost_drive(rng, steps=50):
    """One drive to and fro: the true states, and the arguments of wary_filter."""
    F, H = CART["F"], CART["H"]
    P, Q, R = np.diag([0.3, 0.2]) ** 2, np.diag([0.03, 0.08]) ** 2, np.array([[0.1**2]])
    place = 5 + 2.5 * np.sin(0.5 * np.arange(steps + 1) * 2 * np.pi / 15)
    way = np.stack([place, np.gradient(place, 0.5)], axis=1)
    x = rng.multivariate_normal(way[0], P)
    us = way[1:] - way[:-1] @ F.T + rng.multivariate_normal([0, 0], Q, steps)
    zs = way[1:, :1] + rng.normal(0, 0.1, (steps, 1))
    ghosts = rng.random((steps, 1)) < GHOSTS
    zs[ghosts] = rng.uniform(0, REACH, ghosts.sum())
    return way[1:], (x, P, us, zs, F, Q, H, R)


# %% [markdown]
# **Your task.** Write a filter that copes with ghosts. The noise is not bell-shaped here, so what
# the lesson promised for bells only does not hold, and another rule may do better. Any method goes,
# and there are many: refuse what does not fit, trust it less, weigh the two cases by how likely
# they are, follow both, look again at what you refused. `zs` has one number in each row. `GHOSTS`
# and `REACH` hold in all drives.
#
# The check lets your filter follow 40 drives of 50 steps and looks at three things: how far off it
# is on a typical drive, compared with the lesson's filter; how far off it is compared with a filter
# that is *told* which readings are ghosts; and whether its $P$ is honest, which is the hardest of
# the three. The first steps of a drive do not count, and neither does the worst tenth of the drives
# for its $P$. The check stops after 10 s.


# %% name="wary-filter"
def wary_filter(x, P, us, zs, F, Q, H, R):
    """The beliefs of a drive among ghosts.

    x : (2,), P : (2, 2) belief before the first step;  us : (steps, 2) what each step adds, as told
    zs : (steps, 1) readings;  F, Q : (2, 2);  H : (1, 2);  R : (1, 1)
    returns xs (steps, 2), Ps (steps, 2, 2) : the belief after each reading
    """
    ### BEGIN SOLUTION
    xs, Ps = [], []
    for u, z in zip(us, zs, strict=True):
        x, P = predict(x, P, F, Q)
        x = x + u
        v, S = (array.item() for array in innovation(x, P, z, H, R))
        K = P @ H[0] / S
        # how likely such a reading is: as a measurement, and as a ghost
        real = (1 - GHOSTS) * np.exp(-(v**2) / S / 2) / np.sqrt(2 * np.pi * S)
        share = real / (real + GHOSTS / REACH)
        # the mean of both cases, and their covariance: how far they are apart is doubt as well
        x = x + share * v * K
        apart = share * (1 - share) * v**2
        P = P + (apart - share * S) * np.outer(K, K)
        xs.append(x)
        Ps.append(P)
    return np.array(xs), np.array(Ps)
    ### END SOLUTION


# %%
check("03-ghosts")

# %% [markdown]
# This is one drive: what was read, what you believe, and where the cart was.


# %% name="among-ghosts"
@attempt
def _():
    way, told = ghost_drive(np.random.default_rng(8))
    xs, Ps = wary_filter(*told)
    seconds, two_sigma = 0.5 * np.arange(1, 51), 2 * np.sqrt(Ps[:, 0, 0])
    shown = {"your position": xs[:, 0]}
    fig, ax = views.curves(seconds, shown, "time [s]", "position [m]", size=(8, 3.8))
    ax.plot(seconds, way[:, 0], color=views.COLOURS["truth"], label="true position")
    blue = views.COLOURS["corrected"]
    ax.fill_between(seconds, xs[:, 0] - two_sigma, xs[:, 0] + two_sigma, color=blue, alpha=0.2)
    ax.plot(seconds, told[3], ".", color=views.COLOURS["scan"], label="read")
    ax.set_ylim(-0.5, 13)
    views.legend(ax, loc="upper center", ncols=3)
    views.show(fig, alt="Your position, the true one, and readings: ghosts lie scattered around.")


# %% [markdown]
# **See:** your line should pass by the dots that lie far off. The band should widen where readings
# had to be left out, or may have been either.

# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then says what the grader will say about it; the grader draws
# other inputs. **Next:** lesson
# [04 · Models and Jacobians](../notebooks/04_models_and_jacobians.ipynb) finds the matrices of a
# robot that turns.
