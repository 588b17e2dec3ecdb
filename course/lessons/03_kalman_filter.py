# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 03 · The Kalman filter
#
# **You will be able to** derive the Kalman filter from a single recipe, say what each of its lines
# is for, and test whether a filter tells the truth about its own errors.
#
# **60 minutes.** **Before:** lessons [00](00_start_here.ipynb) and [01](01_why_slam.ipynb); matrix
# products; what a variance and a covariance are.
#
# *Key:* a robot that knows how wrong it may be can learn from every measurement, and exactly as
# much as that measurement deserves.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* One idea carries the lesson: every covariance comes from the same recipe,
# "write the error, multiply it by its transpose, take the expected value". Let the class do it once
# by hand, for the prediction; the machine does the rest. To stop after 50 minutes, leave out "Where
# bell curves come in" and "How much doubt a measurement removes". The sections called *Deeper* and
# *In print* behind the last slide are for reading at home.

# %% slideshow={"slide_type": "skip"} tags=["folded"]
import numpy as np
import sympy as sp
from scipy.stats import norm

from slamlab import views
from slamlab.checks import ask
from slamlab.derivation import expectation, symmetric
from slamlab.evaluation import band, consistency, nees
from slamlab.filters import linear_kalman
from slamlab.layers import Ellipses, Points
from slamlab.simulation import cart

# %% [markdown] slideshow={"slide_type": "slide"} minutes=9
# ## A belief: a number, and how wrong it may be
#
# A robot rolls along a corridor. Its wheels say that it is 4.0 m from the wall behind it; wheels
# like these are off by $\sigma = 0.6$ m. Its range finder says 5.0 m, and is off by $\sigma = 0.3$
# m. The two are a metre apart, yet neither is lying: each is a number with a doubt.
#
# The robot need not choose between them. It can give the range finder the weight $w$, and the
# wheels the rest:
#
# $$\hat x = (1 - w)\,x_{\text{wheels}} + w\,z \tag{03.1}$$

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Before the poll, collect guesses for the place itself on the board. Most
# people go towards 5 m, few can say how far. Ask what they would do without the two σ: there is
# nothing left but the mean, 4.5 m. That is what a σ is good for.

# %% slideshow={"slide_type": "fragment"}
ask(
    "03-surer",
    "Wheels: σ = 0.6 m. Range finder: σ = 0.3 m. The robot mixes the two as well as it can. "
    "How sure is it of the mixture?",
    {
        "less sure than the range finder alone": "the wheels do bring their error in, but only with "
        "a small weight, and two independent errors partly cancel.",
        "just as sure as the range finder": "that is what you get by ignoring the wheels. They are "
        "worse, but they are not worthless.",
        "surer than the range finder": "two independent sources together know more than the better "
        "one alone.",
    },
    right="surer than the range finder",
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The best weight
#
# The two errors have nothing to do with each other, so their variances add. A factor $w$ on an
# error puts $w^2$ on its variance. With $P$ for the variance of the wheels and $R$ for that of the
# range finder, the mixture has the variance
#
# $$\sigma^2(w) = (1 - w)^2 P + w^2 R \tag{03.2}$$
#
# It is smallest where its slope is zero, and we let the machine find that place:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="03-surer"
w, P, R = sp.symbols("w P R", positive=True)
mixed = (1 - w) ** 2 * P + w**2 * R
(best_weight,) = sp.solve(mixed.diff(w), w)
best_weight

# %% [markdown] slideshow={"slide_type": "fragment"}
# The range finder's weight is the doubt about the wheels as a share of all the doubt:
#
# $$w = \frac{P}{P + R} \tag{03.3}$$

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### What the best weight leaves
#
# By (03.3), a robot that is unsure of itself listens to its sensor. How sure is it afterwards? The
# variance that is left is simplest when it is written upside down:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="03-surer"
sp.expand(1 / sp.simplify(mixed.subs(w, best_weight)))

# %% [markdown] slideshow={"slide_type": "fragment"}
# One over a variance is called *information*, and the information of independent sources adds up:
#
# $$\frac{1}{\sigma^2} = \frac{1}{P} + \frac{1}{R} \tag{03.4}$$
#
# So two sources always know more than the better one alone, if only by a little. In numbers:


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="03-surer"
def fuse(a, variance_a, z, variance_z):
    """The best mixture of two independent numbers, and its variance."""
    weight = variance_a / (variance_a + variance_z)
    return a + weight * (z - a), (1 - weight) * variance_a


place, variance = fuse(4.0, 0.6**2, 5.0, 0.3**2)
print(f"{place:.2f} m, σ = {np.sqrt(variance):.2f} m")

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The same as a picture
#
# Let us draw how likely each place is, with bell curves (Gaussians). The sliders set how good the
# wheels and the range finder are, each by its $\sigma$ in metres.


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
def two_bells(wheels, range_finder):
    """Three bells: the wheels', the range finder's, and their mixture's; given are both σ."""
    mean, left = fuse(4.0, wheels**2, 5.0, range_finder**2)
    title = f"mixture: {mean:.2f} m, σ = {np.sqrt(left):.2f} m"
    fig, ax = views.chart("distance to the wall [m]", "density [1/m]", title, size=(8, 3.6))
    bells = {"wheels": (4, wheels, "naive", "--"), "range finder": (5, range_finder, "scan", ":")}
    bells["mixture"] = mean, np.sqrt(left), "corrected", "-"
    at = np.linspace(1.5, 7.5, 400)
    for name, (mean, sigma, colour, line) in bells.items():
        ax.plot(at, norm.pdf(at, mean, sigma), line, color=views.COLOURS[colour], label=name)
    views.legend(ax)
    return fig


# %% slideshow={"slide_type": "fragment"}
views.explore(
    two_bells,
    lambda wheels, range_finder: (
        f"The wheels' bell at {4.0:.1f} m, the range finder's at {5.0:.1f} m, the mixture's at "
        f"{fuse(4.0, wheels**2, 5.0, range_finder**2)[0]:.2f} m, higher and narrower than both."
    ),
    wheels=(0.1, 2.0, 0.6),
    range_finder=(0.1, 2.0, 0.3),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the mixture stands nearer to the surer source and is narrower than both. A poor range
# finder ($\sigma = 2$ m) hardly moves the mixture, but it never widens it.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Bayes' rule was there all the time
#
# A place is likely if both sources call it likely. So take the height of one bell times the height
# of the other, at every place, and stretch the product until its area is one. That is Bayes' rule
# for two independent sources. Does it give another answer than our best weight?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
at = np.linspace(0, 10, 2001)
product = norm.pdf(at, 4.0, 0.6) * norm.pdf(at, 5.0, 0.3)
product /= product.sum() * (at[1] - at[0])
apart = abs(product - norm.pdf(at, place, np.sqrt(variance))).max()
print(f"largest difference of the two curves: {apart:.9f}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# It does not: for bell curves, least squares and Bayes' rule agree. Whether they agree for other
# errors, too, is a question that we shall come back to.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## A belief of two numbers
#
# From now on our robot is a cart in that corridor. Its *state* $x$ holds its position [m] and its
# speed [m/s]. Every $T = 0.5$ s, the motor gives it a known push $u$ [m/s²]. A step does this:
#
# $$x_k = F x_{k-1} + G u_k + q_k \tag{03.5}$$
#
# $$F = \begin{bmatrix} 1 & T \\ 0 & 1 \end{bmatrix}, \qquad
#   G = \begin{bmatrix} T^2/2 \\ T \end{bmatrix} \tag{03.6}$$
#
# $F$ moves the cart on by its speed, $G$ adds the push. And $q$ is what nobody tells the robot:
# wheels slip, and motors are not exact.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Mean and covariance
#
# What the slip $q$ will be cannot be known, but how large it usually is can: it is random, zero on
# average, and its covariance is $Q$. In the same way the robot's *belief* about its state is an
# estimate $\hat x$ and a covariance $P$. On the diagonal of $P$ stand the variances of position and
# speed; off the diagonal stands their covariance, which says how far the two errors go together.
#
# At the start they do not: $P$ is diagonal, with $\sigma = 0.4$ m and $0.3$ m/s.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Dwell on the correlation in the next picture: a bit later the cart measures
# its position only, and thanks to this very streak corrects its speed. Robot and landmarks will be
# tied together in the same way, and lessons 06 and 07 rest on it.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Two seconds later
#
# Now let time pass, and nothing else.

# %% slideshow={"slide_type": "fragment"}
ask(
    "03-streak",
    "1000 carts start wherever the belief allows and roll for two seconds, without a push. "
    "We draw a dot for each: position to the right, speed upwards. Which shape is the cloud?",
    {
        "an upright ellipse that has grown": "then speed and position would still be unrelated; "
        "but a cart that is faster than believed soon is farther, too.",
        "a streak that rises to the right": "a cart that is faster than believed is, two seconds "
        "later, also farther than believed.",
        "a streak that falls to the right": "then the faster carts would have to be the nearer ones.",
    },
    right="a streak that rises to the right",
)


# %% slideshow={"slide_type": "fragment"} answers="03-streak" tags=["folded"]
def rolling(steps):
    """1000 carts after some steps, and what the filter believes of them."""
    rng, b = np.random.default_rng(3), linear_kalman.belief(cart.START_X, cart.START_P)
    carts = rng.multivariate_normal(b.x, b.P, 1000)
    for _ in range(steps):
        carts = carts @ cart.F.T + rng.multivariate_normal([0, 0], cart.Q, 1000)
        b = linear_kalman.predict(b, cart.F, cart.Q)
    fig, ax = views.axes(f"after {steps * cart.T:.1f} s", size=(8, 4))
    views.draw(ax, Points("carts", carts), color=views.COLOURS["sample"])
    views.draw(ax, Ellipses("predicted", [b.x], [b.P]), label="belief, 95 %")
    ax.set(xlabel="position [m]", ylabel="speed [m/s]")
    views.legend(ax)
    return fig


# %% slideshow={"slide_type": "fragment"} answers="03-streak"
views.explore(
    rolling,
    lambda steps: (
        f"Carts after {steps * cart.T:.1f} s and the ellipse of the belief: the longer the carts "
        "roll, the longer the streak that rises to the right."
    ),
    steps=(0, 12, 4),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="03-streak"
# **See:** a streak that rises to the right, and an ellipse that holds it. Position and speed have
# become *correlated*, though nothing but time has passed. Put the slider to 0 and go on step by
# step. The filter draws this ellipse without knowing any of the dots. How does it do that?

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Prediction, derived
#
# The *error* of an estimate is the truth minus the estimate, $\tilde x = x - \hat x$. The truth
# moves by (03.5). The estimate moves in the same way, but without $q$, of which it knows nothing.
# Subtract one from the other, and the push cancels, because what is known adds no doubt:
#
# $$\tilde x \leftarrow F \tilde x + q \tag{03.7}$$
#
# A covariance is, by definition, the expected value of the error times its transpose,
# $P = E[\tilde x \tilde x^{\mathsf T}]$. So we multiply.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
n, m = sp.symbols("n m", integer=True, positive=True)  # any number of states, and of measured ones
F, P, Q = sp.MatrixSymbol("F", n, n), symmetric("P", n), symmetric("Q", n)
error, q = sp.MatrixSymbol(r"\tilde{x}", n, 1), sp.MatrixSymbol("q", n, 1)
error_ahead = F * error + q
sp.expand(error_ahead * error_ahead.T)

# %% slideshow={"slide_type": "fragment"}
ask(
    "03-cross",
    r"The product has four terms. What is the expected value of $F\tilde x\,q^{\mathsf T}$, in which "
    "the old error meets the new slip?",
    {
        "zero": "the slip of this step knows nothing of the errors so far, so that products of either "
        "sign are equally likely.",
        "F Q": "Q is the expected value of q qᵀ, the slip with itself. Here it meets another error.",
        "F P": "P is the expected value of the old error with itself. Here it meets the slip.",
    },
    right="zero",
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Take the expected value
#
# Matrices that are not random pass through the expected value. A random vector times its own
# transpose becomes its covariance, and a product of two unrelated ones becomes zero. These rules
# are all that `expectation` knows:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="03-cross"
E = expectation({error * error.T: P, q * q.T: Q})
E(error_ahead * error_ahead.T)

# %% [markdown] slideshow={"slide_type": "fragment"}
# That is the **prediction**: the old doubt, carried along by $F$, plus what the step adds.
#
# $$\hat x \leftarrow F \hat x + G u, \qquad P \leftarrow F P F^{\mathsf T} + Q \tag{03.8}$$
#
# Remember the recipe: **write the error, multiply it by its transpose, take the expected value.**
# It will do for everything else as well.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Where Q comes from
#
# From the recipe, too. Our cart slips in position and in speed, each by itself, so its $Q$ is
# diagonal. But suppose that the push were the only thing unknown, wrong by $\delta$ with the
# variance $\sigma_\delta^2$. Then $q = G \delta$, and $Q = \sigma_\delta^2\,G G^{\mathsf T}$. This
# matrix is *not* diagonal: a single cause makes both numbers wrong, so their errors go together.
#
# Whenever you model a system, ask what its unknown causes are, and what each of them does to every
# component of the state.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## A measurement: the innovation
#
# The range finder measures the position, and adds a noise $\varepsilon$ with covariance $R$. In
# general a sensor shows a part of the state, or a mixture of its components, and a matrix $H$ says
# which; for our cart $H = [1\;\;0]$.
#
# $$z = H x + \varepsilon \tag{03.9}$$
#
# The robot knows which measurement it *expects*, $H \hat x$. What is new is only the difference,
# the **innovation**. Put in (03.9), and you see what it is made of:
#
# $$v = z - H \hat x = H \tilde x + \varepsilon \tag{03.10}$$

# %% slideshow={"slide_type": "fragment"}
ask(
    "03-surprise",
    "The robot's position is off by σ = 0.4 m, its range finder by σ = 0.3 m. How large is σ of the "
    "innovation?",
    right=0.5,
    tolerance=0.02,
    unit="m",
    reason="the errors are unrelated, so their variances add: 0.16 + 0.09 = 0.25, whose root is 0.5.",
    wrong={
        0.7: "that is the sum of both σ. They would add only if both errors always went the same way.",
        0.3: "that is the noise alone: what is expected is wrong as well.",
        0.4: "that is the error of the position alone: the range finder errs as well.",
        0.1: "that is the difference. Two unrelated errors do not take each other away.",
        0.25: "that is the variance, in square metres; σ is its root.",
    },
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### How large innovations are
#
# We apply the recipe to (03.10). The error and the noise are unrelated:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="03-surprise"
H, R = sp.MatrixSymbol("H", m, n), symmetric("R", m)
noise = sp.MatrixSymbol("varepsilon", m, 1)
E = expectation({error * error.T: P, q * q.T: Q, noise * noise.T: R})
innovation = H * error + noise
E(innovation * innovation.T)

# %% [markdown] slideshow={"slide_type": "fragment"}
# So the doubt of the belief, as the sensor sees it, and the noise add up to the covariance $S$ of
# the innovation:
#
# $$S = H P H^{\mathsf T} + R \tag{03.11}$$

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### What an innovation says about the error
#
# Nobody sees the error $\tilde x$, everybody sees the innovation $v$. What do they have in common?
# The recipe again, this time with two different vectors:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
E(error * innovation.T)

# %% [markdown] slideshow={"slide_type": "fragment"}
# $$S_{xv} = E[\tilde x v^{\mathsf T}] = P H^{\mathsf T} \tag{03.12}$$
#
# For our cart this is the first *column* of $P$: the variance of the position, and below it the
# covariance of position and speed. Over this bridge a measurement of the position reaches the
# speed.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### A hundred thousand carts agree
#
# Formulas ought to be tested against what they speak of. Here are 100 000 carts with errors like
# those of the streak, each with a range finder of its own.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
streak = linear_kalman.belief(np.array([3.0, 0.5]), cart.START_P)
for _ in range(4):
    streak = linear_kalman.predict(streak, cart.F, cart.Q)
after, step = linear_kalman.update(streak, [4.0], cart.H, cart.R)

rng = np.random.default_rng(5)
errors = rng.multivariate_normal([0, 0], streak.P, 100_000)
innovations = errors @ cart.H.T + rng.normal(0, 0.3, (100_000, 1))
together = np.cov(np.hstack([errors, innovations]).T)  # of position, speed, innovation
print("S    of the carts", together[2, 2].round(2), "       by (03.11)", step.S[0, 0].round(2))
print("S_xv of the carts", together[:2, 2].round(2), "by (03.12)", streak.P[:, 0].round(2))

# %% [markdown] slideshow={"slide_type": "fragment"}
# Only two things enter this innovation: the error of the estimate and the noise of the sensor. The
# MAK thesis calls such an observation *COIN*, for constrained innovation. It is what makes
# filtering easy, and lesson 05 builds on it. Where the landmark's place is unknown as well, a third
# error enters; lesson 06 will cure that.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=10
# ## The gain, derived
#
# We correct the estimate by a share of the innovation. The share is the **gain** $K$, a matrix with
# a row for each component of the state and a column for each measured number:
#
# $$\hat x \leftarrow \hat x + K v \tag{03.13}$$
#
# Which $K$ is the best? First we ask what *any* $K$ does to the error. The truth stays where it is,
# so the error loses what the estimate gains. With (03.10),
#
# $$\tilde x \leftarrow \tilde x - K v = (I - K H)\,\tilde x - K \varepsilon \tag{03.14}$$

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The error that is left
#
# The recipe once more, now for (03.14):

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
K = sp.MatrixSymbol("K", n, m)
error_after = sp.expand(error - K * innovation)
P_after = E(error_after * error_after.T)
P_after

# %% [markdown] slideshow={"slide_type": "fragment"}
# The same five terms can be written as two squares, one of what is left of the old error, one of
# the noise that comes in with the correction. This is **Joseph's form**:
#
# $$P \leftarrow (I - K H)\,P\,(I - K H)^{\mathsf T} + K R K^{\mathsf T} \tag{03.15}$$
#
# A sum of squares cannot be negative. So whatever $K$ is, this remains a covariance.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
I_KH = sp.Identity(n) - K * H
print("difference:", sp.expand(P_after - (I_KH * P * I_KH.T + K * R * K.T)).doit())

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The least error
#
# The trace of $P$ is the sum of all mean square errors, of the position and of the speed. We want
# it small. With the letter $S$ for $H P H^{\mathsf T} + R$, the machine differentiates it by all
# entries of $K$ at once:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
S = symmetric("S", m)
P_of_K = P - K * H * P - P * H.T * K.T + K * S * K.T
sp.expand(sp.Trace(P_of_K).diff(K))

# %% [markdown] slideshow={"slide_type": "fragment"}
# The slope is zero where $K S = P H^{\mathsf T}$, and that is the **Kalman gain**:
#
# $$K = P H^{\mathsf T} S^{-1} = S_{xv}\,S^{-1} \tag{03.16}$$
#
# Read it as a sentence: *how much error and innovation have in common, divided by how large
# innovations are anyway.* With one state and one measurement it is the weight (03.3).

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* What usually goes wrong is that $S^{-1}$ is left out. Ask for the units of K
# with our state: the position's row has none, the speed's is in 1/s. $P H^{\mathsf T}$ alone has m²
# and m²/s, so it cannot be a gain. Units find this mistake at once.

# %% slideshow={"slide_type": "fragment"}
ask(
    "03-speed",
    "The sensor sees the position only, and P is diagonal: the errors of position and speed are "
    "unrelated. The range comes out longer than expected. What does the best gain do to the speed?",
    {
        "it raises it": "it would if the errors were correlated, as in the streak. Here a cart that "
        "is farther than believed is as likely slower as faster.",
        "it leaves it alone": "the measurement says something about the position, and that says "
        "nothing about the speed.",
        "it lowers it": "that would need errors that go against each other.",
    },
    right="it leaves it alone",
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Letter by letter, for the cart
#
# If you do not trust matrix calculus, here is the same with plain letters. The belief has the
# variances $a$ and $b$ and the covariance $c$; we look for the two gains with the least trace.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="03-speed"
a, b, c, k_1, k_2, R_1 = sp.symbols("a b c k_1 k_2 R")
gains, rest = sp.Matrix([k_1, k_2]), sp.Matrix([[1 - k_1, 0], [-k_2, 1]])
left = rest * sp.Matrix([[a, c], [c, b]]) * rest.T + gains * R_1 * gains.T
best = sp.solve([left.trace().diff(k_1), left.trace().diff(k_2)], [k_1, k_2])
gains.subs(best)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="03-speed"
# The speed's gain is $c / (a + R)$: **without a covariance there is no correction.** Nobody
# measures the speed. It is corrected through what it shares with the position, and through nothing
# else.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Find it by hand
#
# The 100 000 carts of the streak are corrected with any two gains you like. The lines of the map
# join gains that leave the same error.


# %% slideshow={"slide_type": "fragment"}
def mean_square(*gains):
    """What is left of the carts' errors after a correction with these gains, both states added."""
    corrected = np.column_stack([np.eye(2), -np.array(gains)])
    return np.trace(corrected @ together @ corrected.T)


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
def bowl(position_gain, speed_gain):
    """Contours of the error that is left over both gains, the chosen pair and the best."""
    first, second = np.linspace(0, 1.5, 41), np.linspace(-0.3, 0.9, 41)
    heights = [[mean_square(i, j) for i in first] for j in second]
    title = f"mean square error left: {mean_square(position_gain, speed_gain):.3f}"
    fig, ax = views.chart("gain of the position [1]", "gain of the speed [1/s]", title, (8, 4.2))
    ax.clabel(ax.contour(first, second, heights, np.arange(0.16, 1.5, 0.12)), fontsize=9)
    ax.plot(*step.K, "*", color=views.COLOURS["corrected"], markersize=14, label="Kalman gain")
    yours = {"color": views.COLOURS["naive"], "markersize": 10, "label": "your gains"}
    ax.plot(position_gain, speed_gain, "o", **yours)
    views.legend_below(fig)
    return fig


# %% slideshow={"slide_type": "fragment"}
views.explore(
    bowl,
    lambda position_gain, speed_gain: (
        "Contours of a bowl. A star at its lowest point, the Kalman gain "
        f"({step.K[0, 0]:.2f}, {step.K[1, 0]:.2f}); a dot at ({position_gain:.2f}, {speed_gain:.2f})."
    ),
    position_gain=(0.0, 1.5, 0.5),
    speed_gain=(-0.3, 0.9, 0.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the contours are those of a bowl. The red dot corrects half of the position and leaves
# the speed alone. The blue star is $P H^{\mathsf T} S^{-1}$, and it lies at the bottom. Move the
# dot there: before the measurement the error was {= mean_square(0, 0):.3f =}, and no gain leaves
# less than {= mean_square(*step.K[:, 0]):.3f =}.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Where bell curves come in
#
# Look back: nowhere did the derivation ask what *shape* the errors have. It used their means, their
# covariances, and the fact that slips and noises are unrelated to the errors so far.
#
# So let us take errors whose density is not a bell curve. A range finder is good most of the time, but
# two readings in a hundred are far off, because somebody walks by. Altogether its $\sigma$ is again
# 0.3 m, so $R$ is the same, and so is the gain.

# %% slideshow={"slide_type": "fragment"}
ask(
    "03-shape",
    "Mostly good, seldom far off, σ = 0.3 m altogether. Which of our results survive?",
    {
        "none: the filter needs bell curves": "the derivation asked for means and covariances only, "
        "and these are the same.",
        "P is right, but K is no longer the best correction": "K is the best of all corrections that "
        "are a factor times the innovation. Nobody said that the best correction is of that kind.",
        "all: P is right, and K cannot be beaten": "P is right, and no other factor beats K. But a "
        "correction need not be a factor times the innovation.",
    },
    right="P is right, but K is no longer the best correction",
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Ask the carts themselves
#
# The best correction of all can be found without any formula: sort the carts by their innovation
# into narrow bins, and take the average error in each. No other rule that looks at the innovation
# alone leaves a smaller mean square, but for the width of the bins. The slider sets $\sigma$ of the
# 98 usual readings, in metres.


# %% slideshow={"slide_type": "fragment"} answers="03-shape"
def odd_readings(usual, share=0.02):
    """Errors of the carts' positions, and innovations: few readings are far off, σ is 0.3 m."""
    far = np.sqrt((0.3**2 - (1 - share) * usual**2) / share)
    rng = np.random.default_rng(6)
    sigmas = np.where(rng.random(len(errors)) < share, far, usual)
    return errors[:, 0], errors[:, 0] + sigmas * rng.standard_normal(len(errors))


def by_bins(error, v, edges):
    """The average error of the carts in each bin of innovations, and the errors that it leaves."""
    bins = np.clip(np.digitize(v, edges), 1, len(edges) - 1) - 1
    average = np.bincount(bins, error) / np.bincount(bins)
    return average, error - average[bins]


# %% slideshow={"slide_type": "fragment"} answers="03-shape" tags=["folded"]
def corrections(usual_sigma):
    """The best correction over the innovation: that of the carts, and the Kalman gain's line."""
    (error, v), edges = odd_readings(usual_sigma), np.linspace(-3, 3, 61)
    average, remaining = by_bins(error, v, edges)
    linear = np.std(error - step.K[0, 0] * v)
    title = f"error left: Kalman gain {linear:.2f} m, best of all {np.std(remaining):.2f} m"
    fig, ax = views.chart("innovation [m]", "correction of the position [m]", title, (8, 3.8))
    middle = (edges[1:] + edges[:-1]) / 2
    ax.plot(middle, average, "o", color=views.COLOURS["truth"], markersize=4, label="best of all")
    ax.plot(middle, step.K[0, 0] * middle, color=views.COLOURS["corrected"], label="Kalman gain")
    views.legend(ax)
    return fig


# %% slideshow={"slide_type": "fragment"} answers="03-shape"
views.explore(
    corrections,
    f"A straight line with the slope {step.K[0, 0]:.2f}, the Kalman gain. The carts' dots follow it for "
    "small innovations and bend back from it for large ones, unless all readings are equally good.",
    usual_sigma=(0.05, 0.3, 0.1),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="03-shape"
# **See:** the carts believe a small innovation almost fully, and a very large one hardly at all.
# The straight line of a gain can do neither. Now move the slider to the right end, where all
# readings are equally good and the noise is a bell: the dots lie on the line.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The doubt depends on the reading, too
#
# After the best correction, how wrong are the carts that measured about what they expected, and how
# wrong are those whose reading was a surprise?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="03-shape"
odd_errors, odd_v = odd_readings(0.1)
_, remaining = by_bins(odd_errors, odd_v, np.linspace(-3, 3, 61))
for low, high in [(0, 0.5), (2, 2.5)]:
    those = (abs(odd_v) > low) & (abs(odd_v) < high)
    print(f"innovation {low} to {high} m: error left {np.std(remaining[those]):.2f} m")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="03-shape"
# A reading far off leaves a robot in doubt: was it the reading that was wrong, or its own belief?
# The filter's $P$ is the same for all readings. It is right on average, and wrong for each of the
# two groups.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### What needs a bell, and what does not
#
# - **No bell needed:** prediction, $S$, Joseph's form, and that $K$ is the best *linear* correction.
#   Here $P$ promises an error of {= np.sqrt(after.P[0, 0]):.2f =} m, and
#   {= np.std(odd_errors - step.K[0, 0] * odd_v):.2f =} m are left.
# - **Promised for bells only:** that no other rule does better, that the ellipse holds 95 %, and the
#   bands of the tests below.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* This is the most common overstatement about the filter: "optimal" in textbooks
# means among linear rules, or for Gaussians. The last task of the exercise builds on this slide; do
# not solve it here.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## How much doubt a measurement removes
#
# With the best gain, and only with it, $P H^{\mathsf T}$ may be replaced by $K S$ in the five
# terms. They shrink to two:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
P_of_K.subs(P * H.T, K * S).subs(H * P, S * K.T).doit()

# %% [markdown] slideshow={"slide_type": "fragment"}
# $$P \leftarrow P - K S K^{\mathsf T} \tag{03.17}$$
#
# What is subtracted is the covariance of the correction $K v$. $P$ is doubt, so read: *the doubt
# that is left is the old doubt, less what the corrections explain of it.* The carts say the same:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
explained = np.cov((innovations @ step.K.T).T)
print("covariance of the carts' corrections", explained.round(2).tolist())
print("old doubt less new doubt            ", (streak.P - after.P).round(2).tolist())

# %% slideshow={"slide_type": "fragment"}
ask(
    "03-double",
    "Somebody's gain is twice the best one. How wrong are the carts after the correction?",
    {
        "less wrong than with the best gain": "the best gain is at the bottom of the bowl.",
        "more wrong than with the best gain, but less than without a measurement": "this holds for "
        "1.5 times the best gain. At twice the best gain the bowl has risen farther.",
        "as wrong as if they had not measured": "the bowl is a parabola in the factor, lowest at 1. "
        "At 2 it is as high as at 0.",
    },
    right="as wrong as if they had not measured",
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### A gain that is not the best
#
# Real gains are not always the best: a model is approximate, somebody rounds, or leaves
# correlations out. Take $s\,K$ with the share $s$ from 0 to 2, and compare what the short form
# (03.17) claims with what happens to the carts.

# %% slideshow={"slide_type": "fragment"} answers="03-double" tags=["folded"]
shares = np.linspace(0, 2, 21)
happens = [mean_square(*(share * step.K[:, 0])) for share in shares]
claims = np.trace(streak.P) - shares**2 * np.trace(streak.P - after.P)
fig, ax = views.chart("s: gain / best gain [1]", "sum of mean squares", size=(8, 3.6))
ax.plot(shares, happens, "o", color=views.COLOURS["truth"], label="100 000 carts")
ax.plot(shares, claims, "--", color=views.COLOURS["naive"], label="claim of the short form")
views.legend(ax)
views.show(
    fig,
    f"The carts' error falls from {happens[0]:.2f} to {happens[10]:.2f} at the best gain and rises "
    f"to {happens[-1]:.2f}; the claim falls all the way to {claims[-1]:.2f}, below zero.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="03-double"
# **See:** the short form is right at $s = 0$ and $s = 1$ only. With a smaller gain it is too
# modest, and with a larger one it claims too much: at $s = 2$ it claims a *negative* mean square.
# Joseph's form (03.15) would pass through all the dots, and programs prefer it.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## The whole filter on a drive
#
# Time passes: predict, (03.8). A measurement comes: take the innovation (03.10) and its covariance
# (03.11), the gain (03.16), correct estimate and covariance by (03.13) and (03.15). That is the
# whole filter, and you will write it in the exercise. The package has one, too:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
start, SECONDS = linear_kalman.belief(cart.START_X, cart.START_P), cart.T * np.arange(1, 61)
ahead = linear_kalman.predict(start, cart.F, cart.Q, cart.G, cart.PUSHES[0])
now, step_1 = linear_kalman.update(ahead, [2.6], cart.H, cart.R)
print("expected", ahead.x.round(2), " innovation", step_1.innovation.round(2))
print("gain    ", step_1.K.ravel().round(2), " believed now", now.x.round(2))
# %% [markdown] slideshow={"slide_type": "fragment"}
# A whole drive goes through it in one call:


# %% slideshow={"slide_type": "fragment"}
def filtered(zs, slip=1.0, noise=1.0):
    """The filter on drives; it believes in σ of slip and noise that are so many times the true."""
    Q, R = slip**2 * cart.Q, noise**2 * cart.R
    return linear_kalman.filter_runs(start, zs, cart.F, Q, cart.H, R, cart.G, cart.PUSHES)


# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Thirty seconds (simulated)
#
# The motor pushes for 3 s, the cart rolls, the motor brakes for 3 s. From 12 s on, somebody stands
# before the range finder for a while: no measurement. The baseline is a robot without a range
# finder, which only adds up its pushes.


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
def draw_errors(ax, errors, sigma):
    """Errors by name; the filter's with its band of ±2σ."""
    views.two_sigma(ax, SECONDS, errors["filter"], sigma, "filter")
    ax.plot(SECONDS, errors["pushes only"], "--", color=views.COLOURS["naive"], label="pushes only")
    if "range finder" in errors:
        orange = {"color": views.COLOURS["scan"], "label": "range finder"}
        ax.plot(SECONDS, errors["range finder"], ".", **orange)
    ax.axhline(0, color=views.COLOURS["truth"], linewidth=1, label="truth")


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
def drive_chart(seconds_blocked, drive):
    """Errors, truth less estimate, of position and speed on one drive."""
    rng, blocked = np.random.default_rng(drive), slice(24, 24 + round(seconds_blocked / cart.T))
    truth, zs = cart.drives(rng, 1, blocked)
    each = {"filter": filtered(zs), "pushes only": filtered(np.full_like(zs, np.nan))}
    fig, panels = views.panels(["position", "speed"], (11, 3.8), shared=False)
    for k, (ax, unit, limit) in enumerate(zip(panels, ["m", "m/s"], [2.5, 1.0], strict=True)):
        errors = {name: (truth - found.x)[0, :, k] for name, found in each.items()}
        errors |= {"range finder": (truth[..., :1] - zs)[0, :, 0]} if k == 0 else {}
        draw_errors(ax, errors, np.sqrt(each["filter"].P[:, k, k]))
        ax.set(aspect="auto", xlabel="time [s]", ylabel=f"error [{unit}]", ylim=(-limit, limit))
    views.legend_below(fig)
    return fig


# %% slideshow={"slide_type": "fragment"}
views.explore(
    drive_chart,
    lambda seconds_blocked, drive: (
        f"The filter's error with its shaded band, which swells for {seconds_blocked} s while nothing "
        "is measured and holds the truth most of the time; the error of the pushes drifts away."
    ),
    seconds_blocked=(0, 12, 6),
    drive=(1, 30, 4),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the truth (the black line) stays mostly inside the band of $\pm 2\sigma$ round the filter
# (blue). While nothing is measured, the band swells; one measurement later it is narrow again. The
# band of the *speed* becomes narrow within seconds, although no speed is ever measured: that is the
# bridge $S_{xv}$ at work. Adding up pushes (red, dashed) ends in the drift of lesson 01. Try other
# drives.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### One drive proves nothing
#
# So we take 200 drives, each with its own start, slips and noise, and compare the three estimates
# on each of them, wherever there was a measurement:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
truth, zs = cart.drives(np.random.default_rng(34), 200)
seen = np.isfinite(zs[0, :, 0])
found, pushes = filtered(zs), filtered(np.full_like(zs, np.nan))
estimates = {"pushes only": pushes.x, "range finder": zs, "filter": found.x}
rms = {
    name: np.sqrt(np.mean((estimate - truth)[:, seen, 0] ** 2, axis=1))
    for name, estimate in estimates.items()
}
for name, values in rms.items():
    print(f"{name:13} rms error of the position, median of 200 drives: {np.median(values):.2f} m")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The filter is nearer to the truth than its pushes on
# {= np.sum(rms["filter"] < rms["pushes only"]) =} of the 200 drives, and nearer than its range
# finder on {= np.sum(rms["filter"] < rms["range finder"]) =}.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## Does the filter tell the truth?
#
# Look at (03.8), (03.11), (03.15) and (03.16) once more: $P$ is made of its start, $F$, $Q$, $H$
# and $R$. **No measurement enters it.** The filter would believe in its $P$ even if every
# measurement were nonsense. So somebody else has to ask whether it is true.
#
# An estimate is **consistent** with $P$ if its errors are, in no direction, larger on average than
# $P$ says. In a formula, the following matrix has no eigenvalue below zero:
#
# $$P - E[\tilde x \tilde x^{\mathsf T}] \succeq 0 \tag{03.18}$$

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### One number for it
#
# Errors of different units cannot be compared, so we measure them by what the filter believes of
# them. The *normalised estimation error squared* does that:
#
# $$\text{NEES} = \tilde x^{\mathsf T} P^{-1} \tilde x \tag{03.19}$$
#
# If $P$ is exactly right, it is 2 on average for two states. Over 200 independent drives the
# average of bell-shaped errors lies between {= band(2, 200)[0]:.2f =} and {= band(2, 200)[1]:.2f =}
# in 95 % of the cases; call that the band. An average far outside it says that $P$ is wrong.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Students like small ellipses. After the poll, ask which of two wrong filters
# they would take on board. The modest one is merely slow to learn; the proud one will one day
# reject a right measurement, or drive into a wall that it believes to be elsewhere.

# %% slideshow={"slide_type": "fragment"}
ask(
    "03-half-slip",
    "A filter believes that the slip is half as large as it is. It knows everything else exactly. "
    "Where is "
    "its average NEES?",
    {
        "below the band": "NEES is below where errors are smaller than P says. This filter's P is "
        "too small, not too large.",
        "inside the band": "measurements do correct its estimate, but never its P.",
        "above the band": "its ellipses are too small for the errors it makes.",
    },
    right="above the band",
)


# %% slideshow={"slide_type": "subslide"} answers="03-half-slip"
def mean_nees(*believed):
    """The mean NEES over all drives and steps of a filter that believes in other slip and noise."""
    wrong = filtered(zs, *believed)
    return nees(truth - wrong.x, wrong.P).mean()


def whiteness(found):
    """The mean NIS, and how far normalised innovations resemble the ones before them."""
    white = found.innovations[:, seen, 0] / np.sqrt(found.S[seen, 0, 0])
    return np.mean(white**2), np.mean(white[:, 1:] * white[:, :-1]) / np.mean(white**2)


# %% slideshow={"slide_type": "fragment"} answers="03-half-slip" tags=["folded"]
def nees_chart(believed_slip, believed_noise):
    """Mean NEES over time of a filter that believes in other slip and noise, and of the right one."""
    wrong = filtered(zs, believed_slip, believed_noise)
    title = "NIS of the wrong filter {:.2f}, neighbours alike {:+.2f}".format(*whiteness(wrong))
    fig, ax = views.chart("time [s]", "NEES, mean of 200 drives [1]", title, (8, 3.8))
    for each, colour, line in [(wrong, "naive", "--"), (found, "corrected", "-")]:
        mean = nees(truth - each.x, each.P).mean(axis=0)
        ax.plot(SECONDS, mean, line, color=views.COLOURS[colour])
    views.band(ax, *band(2, 200), "95 % band")
    ax.legend(["wrong filter", "right filter", "95 % band"])
    ax.set_ylim(0, 8)
    return fig


# %% slideshow={"slide_type": "fragment"} answers="03-half-slip"
views.explore(
    nees_chart,
    lambda believed_slip, believed_noise: (
        "The right filter's NEES lies in a grey band. That of a filter which believes in "
        f"{believed_slip:.2f} times the slip and {believed_noise:.2f} times the noise is "
        f"{mean_nees(believed_slip, believed_noise):.1f} on average."
    ),
    believed_slip=(0.1, 2.0, 0.5),
    believed_noise=(0.5, 2.0, 1.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="03-half-slip"
# **See:** the right filter (blue) stays in the band. The other one (red) leaves it within seconds,
# and is worst where nothing is measured and its trust in the wheels is all it has. Believe in
# *twice* the slip, and NEES falls below the band. That is consistent by (03.18), but knowledge is
# thrown away.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Without the truth
#
# NEES needs the truth, which nobody has on a real robot. What everybody has are innovations:
#
# $$\text{NIS} = v^{\mathsf T} S^{-1} v \tag{03.20}$$
#
# It is 1 on average for each measured number, if $S$ is right. And if the filter has learned
# everything from the past, each innovation is news: nothing of it could be foretold from the one
# before.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="03-half-slip"
cases = {"right": (1, 1), "slip × 0.5": (0.5, 1), "slip × 0.1, noise × 2": (0.1, 2)}
for name, believed in cases.items():
    nis, alike = whiteness(filtered(zs, *believed))
    print(f"{name:22} mean NIS {nis:.2f}   neighbours alike {alike:+.2f}")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="03-half-slip"
# The last filter is wrong twice, and its NIS hardly shows it: one mistake makes innovations larger,
# the other makes $S$ larger, too. But its innovations resemble their neighbours. It is surprised to
# the same side again and again, and learns nothing from it. So look at both numbers.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The definition itself
#
# At the last step of the 200 drives we can test (03.18) itself. In no direction should the mean
# square of the errors, in units of the variance believed, be above 1 by more than chance allows:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="03-half-slip"
for slip in (0.5, 1, 2):
    wrong = filtered(zs, slip)
    result = consistency((truth - wrong.x)[:, -1], np.tile(wrong.P[-1], (200, 1, 1)))
    verdict = "refuted" if result.refuted else "nothing against it"
    print(f"slip × {slip:3}: largest {result.largest:.2f}, limit {result.limit:.2f}: {verdict}")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="03-half-slip"
# Half the slip is refuted. Twice the slip is not: (03.18) allows a filter to be too modest. That is why
# NEES has a band with two ends.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## Who had the idea, and what comes next
#
# - **The filter:** R. E. Kalman, "A New Approach to Linear Filtering and Prediction Problems", *Journal
#   of Basic Engineering* 82, 1960. **Joseph's form:** R. S. Bucy and P. D. Joseph, *Filtering for
#   Stochastic Processes with Applications to Guidance*, 1968.
# - **The least variance among linear rules:** C. F. Gauss, *Theoria combinationis observationum*, 1823.
# - **NEES and NIS:** Y. Bar-Shalom, X. R. Li, T. Kirubarajan, *Estimation with Applications to Tracking
#   and Navigation*, 2001, chapter 5.
# - **COIN**, and (03.18): the MAK thesis, chapter 2.
# - **Read next:** R. Labbe, *Kalman and Bayesian Filters in Python*, free notebooks.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### What you can do now
#
# You can derive prediction, innovation and gain by one recipe, say which part of it needs bell
# curves, and put the right question to any filter: is its $P$ true?
#
# **Exercise:** [write the filter, piece by piece](../exercises/ex03_kalman_filter.ipynb).
#
# **Next:** we needed motion and measurement to be *linear*, and a robot that turns is not. Lesson
# [04 · Models and Jacobians](04_models_and_jacobians.ipynb) makes real models straight, near where
# the robot is. What stands below is optional.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: best for every state at once
#
# The trace adds square metres to squared metres per second. Does this make sense? Look at what any
# other gain costs, with the letters of the cart:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
K_best = gains.subs(best)
off = gains - K_best
sp.simplify(left - left.subs(best) - off * (a + R_1) * off.T)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Any other gain $K'$ adds a square to the best covariance:
#
# $$P(K') = P(K) + (K' - K)\,S\,(K' - K)^{\mathsf T} \tag{03.21}$$
#
# A square harms, or at best does nothing, in every direction. So the Kalman gain is best for the
# position, for the speed and for any mixture of the two, whatever their units.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: was anything lost on the way?
#
# The filter looks at each measurement once and throws it away. Somebody patient keeps them all and
# solves, at the end, for all states at once: those for which the weighted squares of *everything*,
# the start, the slips and the measurements, are least. Does the patient one know the last state any
# better?


# %% slideshow={"slide_type": "fragment"}
def equations(zs):
    """Whitened equations (block by step, value) of a drive: its start, its steps, its measurements."""
    yield {0: np.eye(2)}, start.x, start.P
    for k, (u, z) in enumerate(zip(cart.PUSHES, zs, strict=True)):
        yield {k: -cart.F, k + 1: np.eye(2)}, cart.G @ u, cart.Q
        if np.isfinite(z).all():
            yield {k + 1: cart.H}, z, cart.R


# %% slideshow={"slide_type": "fragment"}
def least_squares(zs):
    """All states of a drive at once; the last one, and its covariance."""
    A, y, size = [], [], len(zs) + 1
    for blocks, value, covariance in equations(zs):
        white, row = np.linalg.inv(np.linalg.cholesky(covariance)), np.zeros((len(value), 2 * size))
        for k, block in blocks.items():
            row[:, 2 * k : 2 * k + 2] = block
        A.append(white @ row)
        y.append(white @ value)
    A, y = np.vstack(A), np.concatenate(y)
    return np.linalg.lstsq(A, y)[0][-2:], np.linalg.inv(A.T @ A)[-2:, -2:]


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
x_patient, P_patient = least_squares(zs[0])
print("filter", found.x[0, -1].round(6), " all at once", x_patient.round(6))
print("x apart by less than 1e-9: ", bool(abs(found.x[0, -1] - x_patient).max() < 1e-9))
print("P apart by less than 1e-12:", bool(abs(found.P[-1] - P_patient).max() < 1e-12))

# %% [markdown] slideshow={"slide_type": "fragment"}
# Nothing was lost: the belief $(\hat x, P)$ holds *everything* that the past has to say about now.
# The filter is least squares done step by step, with a memory of five numbers, two of $\hat x$ and
# three of $P$. The patient one does know the *earlier* states better, because it has seen what came
# after them; lesson 15 comes back to that.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: why programs use Joseph's form
#
# With the best gain, (03.15), (03.17) and the often printed $(I - K H) P$ are equal on paper. In a
# computer they are not. Let a state be known to a kilometre, and measure it ever more exactly; how
# often does the updated $P$ have a negative variance in some direction?


# %% slideshow={"slide_type": "fragment"}
def negative(sensor_sigma, rng):
    """Whether the updated P has a negative eigenvalue: by each of the three forms."""
    root, H = rng.normal(0, 1000, (2, 2)), np.array([[1.0, 0.7], [0.2, 1.0]])
    b = linear_kalman.belief([0, 0], root @ root.T)
    joseph, told = linear_kalman.update(b, [0, 0], H, sensor_sigma**2 * np.eye(2))
    short, shorter = b.P - told.K @ told.S @ told.K.T, (np.eye(2) - told.K @ H) @ b.P
    return [np.linalg.eigvalsh((P + P.T) / 2)[0] < 0 for P in (short, shorter, joseph.P)]


# %% slideshow={"slide_type": "fragment"}
rng = np.random.default_rng(6)
print("σ of the sensor   P − K S Kᵀ   (I − K H) P   Joseph")
for sigma in (1, 1e-5, 1e-6):
    share = np.mean([negative(sigma, rng) for _ in range(500)], axis=0)
    print(f"{sigma:13g} m" + "".join(f"{100 * value:10.0f} %" for value in share))

# %% [markdown] slideshow={"slide_type": "fragment"}
# Where nearly all of a large number is taken away, what is left is rounding. Joseph's form adds two
# squares, and cannot fail in this way. With everyday numbers (first row) none of the three forms
# fails, so Joseph's form is an insurance, which costs a few more products.
#
# Ready-made filters pay for it. Here is `filterpy`, which many robots use, on the first of our 200
# drives:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
from filterpy.kalman import KalmanFilter

theirs = KalmanFilter(dim_x=2, dim_z=1)
theirs.x, theirs.P, theirs.F, theirs.B = start.x, start.P, cart.F, cart.G
theirs.Q, theirs.H, theirs.R = cart.Q, cart.H, cart.R
measured = [z if np.isfinite(z).all() else None for z in zs[0]]
means, covariances, *_ = theirs.batch_filter(measured, us=cart.PUSHES)
print("x apart by less than 1e-9: ", bool(abs(means - found.x[0]).max() < 1e-9))
print("P apart by less than 1e-12:", bool(abs(covariances - found.P).max() < 1e-12))

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: which gains are consistent?
#
# Take the gain $s K$ with a share $s$ of the best one, and let the filter claim the short form
# (03.17). By how much does the claimed covariance exceed the true one? With the letters of the
# cart:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
s = sp.symbols("s", real=True)
true_P = left.subs(dict(zip(gains, s * K_best, strict=True)))
claimed = sp.Matrix([[a, c], [c, b]]) - s**2 * K_best * (a + R_1) * K_best.T
excess = (claimed - true_P).applyfunc(sp.factor)
sp.simplify(excess - 2 * s * (1 - s) * K_best * (a + R_1) * K_best.T)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The last line prints zero, so the excess is a factor times a square:
#
# $$P_{\text{claimed}} - P_{\text{true}} = 2 s (1 - s)\, K S K^{\mathsf T} \tag{03.22}$$
#
# It is positive semidefinite for every $0 \le s \le 1$. All these gains are consistent by (03.18);
# only $s = 0$ and $s = 1$ claim exactly what is true.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## In print: four slips of the thesis (optional)
#
# The lesson follows the MAK thesis, chapter 2. Four of its lines are misprinted or say too much.
# You need this only if you read the original.
#
# | Where | Printed | Right | Harm |
# | --- | --- | --- | --- |
# | definition of COIN | the innovation is *smaller than* error and noise | it *depends only on* them | innovations are the largest of the three; a test on size rejects good ones |
# | (2.11) | $S_{xv} = S_{xv}^{\mathsf T}$ | $S_{xv} = S_{vx}^{\mathsf T}$ | the shapes do not fit |
# | 2.6 | consistent *if and only if* $K = S_{xv} S^{-1}$ | *if*; see (03.22) | good filters pass for inconsistent |
# | 2.4 | $E[\tilde x^{\mathsf T} \tilde x] = P$ | $E[\tilde x \tilde x^{\mathsf T}] = P$ | a number stands for a matrix |

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Found by machine
#
# The first by the carts, the second and the fourth by shapes, the third by the eigenvalues of
# (03.22):

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
noises = innovations - errors[:, :1]
smaller = (abs(innovations) < abs(errors[:, :1])) & (abs(innovations) < abs(noises))
sigmas = [each.std().round(2) for each in (innovations, errors[:, 0], noises)]
coin = f"COIN: smaller than both on {100 * smaller.mean():.0f} %"
print(f"{coin}; σ of innovation, error, noise:", *sigmas)
print("2.11: S_xv", E(error * innovation.T).shape, " S_vx", E(innovation * error.T).shape)
for share in (-0.1, 0.5, 1.0, 1.1):
    least = np.linalg.eigvalsh(2 * share * (1 - share) * (streak.P - after.P)).min()
    print(f"2.6:  s = {share:4.1f}", "consistent" if least > -1e-12 else "not consistent")
mean = np.mean(np.sum(errors**2, axis=1))
print(f"2.4:  E[x̃ᵀx̃] = {mean:.2f}, one number; trace P = {np.trace(streak.P):.2f}")
