# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 03 · The Kalman filter
#
# **You will be able to** derive the Kalman filter, explain each of its steps, show that it is a special case of
# the Bayes filter, and test and tune a filter by its own innovations.
#
# **105 minutes**, in two parts: the filter derived (60), and its foundations and tests (45).
# **Before:** lessons [00](00_start_here.ipynb) and [01](01_why_slam.ipynb); matrix products; variance
# and covariance.
#
# The main idea: from the covariance of its error, a robot can compute how much weight each measurement should
# get, so every measurement improves the estimate.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Part one uses one recipe throughout: "write the error, multiply it by its transpose,
# take the expected value". Let the class apply it once by hand, for the prediction. Part two contains the
# theory that many departments require: Bayes filter, consistency, tuning. Part two can be a separate lecture.
# Before the first poll, collect guesses for the fused position on the board. Spend time on the correlation of
# position and speed that grows while the cart rolls: robot and landmarks become correlated in the same way, and
# lessons 06 and 07 use such correlations. The sections called *Deeper* are for reading at home.

# %% slideshow={"slide_type": "skip"} tags=["folded"]
import numpy as np
import sympy as sp
from scipy.optimize import brentq
from scipy.stats import norm

from classroom.checks import ask, compare
from classroom.derivation import expectation, symmetric
from slamlab import sources, views
from slamlab.evaluation import band, consistency, nees, nis
from slamlab.filters import kalman_filter
from slamlab.layers import Ellipses, Points
from slamlab.simulation import RPLIDAR_A2, worlds
from slamlab.simulation import linear_system as cart

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## Two estimates of one position
#
# A robot rolls along a corridor. According to its odometry, the robot is 4.0 m from the wall behind it; the
# odometry has a standard deviation of $\sigma = 0.6$ m. The range finder measures 5.0 m, with $\sigma = 0.3$ m.
# Both errors have mean zero. The two values differ by a metre, but this difference is plausible for such
# standard deviations.
#
# The robot need not choose one of the two values. It can form a **weighted mean**, the **fused estimate**,
# with the weight $w$ for the range finder and the weight $1 - w$ for the odometry:
#
# $$\hat x = (1 - w)\,x_{\text{odometry}} + w\,z \tag{03.1}$$

# %% [markdown] slideshow={"slide_type": "notes"} name="note-two-estimates-of-one-position"
# *For the lecturer:* Many students expect that a poor estimate makes the result worse. Ask what happens if σ
# of the odometry is 100 m: its weight goes to zero, and it does no harm.

# %% slideshow={"slide_type": "fragment"}
ask(
    "03-surer",
    "Odometry: σ = 0.6 m. Range finder: σ = 0.3 m. Their errors are independent. The robot forms the "
    "weighted mean with the smallest variance. How large is its σ?",
    {
        "larger than that of the range finder": "the odometry error does enter, but only with a "
        "small weight, and two independent errors partly cancel.",
        "equal to that of the range finder": "this is the result without the odometry, which is less "
        "precise but still contains information.",
        "smaller than that of the range finder": "two independent estimates together are more "
        "precise than the better one alone.",
    },
    right="smaller than that of the range finder",
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The best weight
#
# The two errors are independent, so their variances add. A factor $w$ on an error multiplies its
# variance by $w^2$. Let $P$ be the variance of the odometry and $R$ that of the range finder. The weighted
# mean then has the variance
#
# $$\sigma^2(w) = (1 - w)^2 P + w^2 R \tag{03.2}$$
#
# This variance is smallest where its derivative is zero. The computer solves for the weight:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="03-surer"
w, P, R = sp.symbols("w P R", positive=True)
fused_variance = (1 - w) ** 2 * P + w**2 * R
(best_weight,) = sp.solve(fused_variance.diff(w), w)
best_weight

# %% [markdown] slideshow={"slide_type": "fragment"}
# The best weight of the range finder is the odometry's share of the total variance:
#
# $$w = \frac{P}{P + R} \tag{03.3}$$
#
# The larger the variance of the odometry, the more weight the sensor gets. What is the variance of the fused
# estimate with this weight? The reciprocal of this variance has the simplest form:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="03-surer"
sp.expand(1 / sp.simplify(fused_variance.subs(w, best_weight)))

# %% [markdown] slideshow={"slide_type": "fragment"}
# The reciprocal of a variance is called **information**, and the information of independent
# estimates adds up:
#
# $$\frac{1}{\sigma^2} = \frac{1}{P} + \frac{1}{R} \tag{03.4}$$
#
# So with the best weight, the fused estimate of two independent estimates is always more precise than the
# better one alone, sometimes only slightly. For our robot the numbers are:


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="03-surer"
def fuse(a, variance_a, z, variance_z):
    """The weighted mean of two independent estimates with the smallest variance; that variance."""
    weight = variance_a / (variance_a + variance_z)
    return a + weight * (z - a), (1 - weight) * variance_a


position, variance = fuse(4.0, 0.6**2, 5.0, 0.3**2)
print(f"{position:.2f} m, σ = {np.sqrt(variance):.2f} m")

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** A camera measures the position, too: 4.6 m with σ = 0.5 m, independent of the other
# two. Compute the information of all three estimates together. `variance` is the variance of the fused estimate
# of the first two.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
information = ...  # [1/m²]
compare(information, 1 / fuse(position, variance, 4.6, 0.5**2)[1])

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# information = 1 / variance + 1 / 0.5**2
# ```
#
# The error of the fused estimate is independent of that of the camera, so (03.4) holds again.
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## The Gaussian density and Bayes' rule
#
# How probable is each position? The usual model is the **Gaussian density** (also *normal
# distribution*) with mean $\mu$ and variance $\sigma^2$. We write $x \sim \mathcal N(\mu,
# \sigma^2)$:
#
# $$p(x) = \frac{1}{\sqrt{2\pi}\,\sigma}\exp\left(-\frac{(x - \mu)^2}{2\sigma^2}\right)
#   \tag{03.5}$$
#
# The graph of this density is a bell-shaped curve. {= 100 * (norm.cdf(1) - norm.cdf(-1)):.0f =} % of its area
# lies within one
# σ of the mean, and 95 % within {= norm.ppf(0.975):.2f =} σ. The second range is the **95 % interval**; figures
# often round it to ±2σ. The sliders set σ of the odometry and of the range finder, in metres.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-the-gaussian-density-and-bayes-rule"
# *For the lecturer:* The likelihood is the difficult term: the measured $z$ is fixed, and $x$ varies. Cover
# the legend and ask which curve is which. If time is short, show the formula of Bayes' rule and skip the
# numerical check.


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
def three_gaussians(odometry, range_finder):
    """Densities of the odometry, the range finder and the fused estimate, from both σ."""
    mean, left = fuse(4.0, odometry**2, 5.0, range_finder**2)
    title = f"fused estimate: {mean:.2f} m, σ = {np.sqrt(left):.2f} m"
    fig, ax = views.chart("distance to the wall [m]", "density [1/m]", title, size=(8, 3.6))
    curves = {"odometry": (4, odometry, "naive", "--")}
    curves |= {"range finder": (5, range_finder, "scan", ":")}
    curves["fused estimate"] = mean, np.sqrt(left), "corrected", "-"
    at = np.linspace(1.5, 7.5, 400)
    for name, (mean, sigma, colour, line) in curves.items():
        ax.plot(at, norm.pdf(at, mean, sigma), line, color=views.COLOURS[colour], label=name)
    views.legend(ax)
    return fig


# %% slideshow={"slide_type": "fragment"}
views.explore(
    three_gaussians,
    lambda odometry, range_finder: (
        f"The density of the odometry has its peak at {4.0:.1f} m, that of the range finder at "
        f"{5.0:.1f} m. The density of the fused estimate has its peak at "
        f"{fuse(4.0, odometry**2, 5.0, range_finder**2)[0]:.2f} m and is higher and narrower than both."
    ),
    odometry=(0.1, 2.0, 0.6),
    range_finder=(0.1, 2.0, 0.3),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The fused estimate lies nearer to the more precise of the two estimates, and its density is narrower than
# both. A poor range finder ($\sigma = 2$ m) hardly changes the estimate by odometry, but it never makes this
# estimate less precise.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Bayes' rule
#
# The joint density of position *and* measurement can be written in two ways: $p(x, z) = p(z \mid
# x)\,p(x) = p(x \mid z)\,p(z)$. Division by $p(z)$ gives **Bayes' rule**:
#
# $$\underbrace{p(x \mid z)}_{\text{posterior}} = \frac{1}{p(z)}\,
#   \underbrace{p(z \mid x)}_{\text{likelihood}}\,\underbrace{p(x)}_{\text{prior}} \tag{03.6}$$
#
# The **prior** is the density before the measurement; here the odometry provides it. The
# **likelihood** is the density of the value that was measured, as a function of $x$. The
# **posterior** is the density after the measurement, and $p(z)$ only scales its area to one. Does Bayes' rule
# give another result than our best weight?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
at = np.linspace(0, 10, 2001)
prior, likelihood = norm.pdf(at, 4.0, 0.6), norm.pdf(5.0, at, 0.3)
posterior = likelihood * prior
posterior /= posterior.sum() * (at[1] - at[0])
difference = abs(posterior - norm.pdf(at, position, np.sqrt(variance))).max()
print(f"largest difference of the two densities: {difference:.9f} per metre")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The two results agree. As functions of $x$, the exponents of two Gaussians add up to a parabola again, with
# the second derivative $-(1/P + 1/R)$. By (03.4) this derivative is $-1/\sigma^2$. So for Gaussian errors, the
# minimum variance and Bayes' rule give the same estimate. Part two examines other errors.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=9
# ## State, control input and process noise
#
# From now on our robot is a cart in that corridor. The **state** $x$ contains everything about the past that
# the future of the cart depends on: its position [m] and its speed [m/s]. During each step of $T = 0.5$ s, the
# motor
# accelerates it by a known and constant **control input** $u$ [m/s²]. A step changes the state:
#
# $$x_k = F x_{k-1} + G u_k + q_k \tag{03.7}$$
#
# $$F = \begin{bmatrix} 1 & T \\ 0 & 1 \end{bmatrix}, \qquad
#   G = \begin{bmatrix} T^2/2 \\ T \end{bmatrix} \tag{03.8}$$
#
# $F$ adds the distance that the cart covers at its speed, and $G$ adds the effect of the control
# input. The **process noise** $q$ is the unknown part of the motion: wheels slip, and motors are not exact.
# This noise is random, with mean zero and covariance $Q$, and independent from step to step.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-state-control-input-and-process-noise"
# *For the lecturer:* Ask what else the future of a real cart depends on, such as friction or the slope of the
# floor: whatever the state leaves out becomes process noise. Start the slider at 0 and move it one step at a
# time.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Mean and covariance
#
# The robot's *belief* about its state is an estimate $\hat x$ and the covariance $P$ of its error.
# The diagonal of $P$ contains the variances of position and speed. The off-diagonal entry is their
# covariance: it is positive if a cart that is farther than estimated is, on average, also faster than
# estimated. At the start the errors are independent: $P$ is diagonal, with $\sigma = 0.4$ m and $0.3$
# m/s.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The 95 % ellipse
#
# The Gaussian density of $n$ numbers has a quadratic form in its exponent:
#
# $$p(x) = \frac{1}{\sqrt{(2\pi)^n \det P}}\exp\left(-\tfrac12 d^2\right), \qquad
#   d^2 = (x - \hat x)^{\mathsf T} P^{-1} (x - \hat x) \tag{03.9}$$
#
# The contours of this density are the ellipses of constant $d$. Which ellipse contains 95 % of the probability?
# With $P = L L^{\mathsf T}$,
# the vector $\xi = L^{-1}(x - \hat x)$ has independent Gaussian components with $\sigma = 1$. For two
# of them, $d^2 = \xi_1^2 + \xi_2^2$. Such a sum of $n$ squares has the **χ² distribution**
# (chi-squared) with $n$ degrees of freedom. For $n = 2$, the ring with radius $d$ has the circumference
# $2\pi d$ and the density $e^{-d^2/2}/2\pi$, so we can integrate:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
d, radius = sp.symbols("d r", positive=True)
inside = sp.integrate(d * sp.exp(-(d**2) / 2), (d, 0, radius))
(limit,) = sp.solve(sp.Eq(inside, sp.Rational(95, 100)), radius)
print("share inside d = r:", inside, "  95 % at r =", limit.evalf(4), " r² =", (limit**2).evalf(4))

# %% [markdown] slideshow={"slide_type": "fragment"}
# The **95 % ellipse** has the semi-axes {= float(limit):.2f =} σ, where σ is the standard deviation
# along each axis. In one dimension the same rule, with one degree of freedom, gives
# {= norm.ppf(0.975):.2f =} σ.

# %% slideshow={"slide_type": "subslide"}
ask(
    "03-streak",
    "1000 carts start with errors drawn from the belief, and roll for two seconds with no control "
    "input. We draw a dot for each: position to the right, speed upwards. What shape do the dots "
    "form?",
    {
        "an upright ellipse that has grown": "then speed and position would still be "
        "uncorrelated; but a cart that is faster than estimated is soon also farther than "
        "estimated.",
        "an ellipse that rises to the right": "a cart that is faster than estimated is, two seconds "
        "later, also farther than estimated.",
        "an ellipse that falls to the right": "then the faster carts would be nearer than estimated.",
    },
    right="an ellipse that rises to the right",
)


# %% slideshow={"slide_type": "fragment"} answers="03-streak" tags=["folded"]
def rolling(steps):
    """1000 carts after some steps, and the filter's predicted 95 % ellipse."""
    rng, b = np.random.default_rng(3), kalman_filter.belief(cart.START_X, cart.START_P)
    carts = rng.multivariate_normal(b.x, b.P, 1000)
    for _ in range(steps):
        carts = carts @ cart.F.T + rng.multivariate_normal([0, 0], cart.Q, 1000)
        b = kalman_filter.predict(b, cart.F, cart.Q)
    fig, ax = views.axes(f"after {steps * cart.T:.1f} s", size=(8, 4))
    views.draw(ax, Points("carts", carts), color=views.COLOURS["sample"])
    views.draw(ax, Ellipses("predicted", [b.x], [b.P]), label="predicted, 95 % ellipse")
    ax.set(xlabel="position [m]", ylabel="speed [m/s]")
    views.legend(ax)
    return fig


# %% slideshow={"slide_type": "fragment"} answers="03-streak"
views.explore(
    rolling,
    lambda steps: (
        f"Carts after {steps * cart.T:.1f} s and the predicted ellipse: the longer the carts "
        "roll, the longer the ellipse, and it rises to the right."
    ),
    steps=(0, 12, 4),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="03-streak"
# The dots form an ellipse that rises to the right. Position and speed have become **correlated**, although the
# cart has only rolled. Set the slider to 0 and move it step by step. The filter computes the ellipse without
# using any of the dots. How does it compute the ellipse?

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## Prediction, derived
#
# The **error** of an estimate is the truth minus the estimate, $\tilde x = x - \hat x$. The true state changes
# by (03.7). The estimate changes in the same way, but without the unknown $q$. We subtract the estimate
# from the truth. The control input cancels, because a known input adds no uncertainty:
#
# $$\tilde x \leftarrow F \tilde x + q \tag{03.10}$$
#
# An estimate is **unbiased** if its error has mean zero, $E[\tilde x] = 0$. By (03.10) an unbiased
# estimate stays unbiased, because $q$ has mean zero. The covariance of its
# error is then the expected value of the error times its transpose, $P = E[\tilde x \tilde x^{\mathsf
# T}]$. So we multiply the error by its transpose.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-prediction-derived"
# *For the lecturer:* Let the class multiply the four terms by hand before the outputs appear; the two mixed
# terms are the only difficulty. If time is short, skip "Where Q comes from".

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
n, m = sp.symbols("n m", integer=True, positive=True)  # any number of states, and of measured ones
F, P, Q = sp.MatrixSymbol("F", n, n), symmetric("P", n), symmetric("Q", n)
error, q = sp.MatrixSymbol(r"\tilde{x}", n, 1), sp.MatrixSymbol("q", n, 1)
error_ahead = F * error + q
sp.expand(error_ahead * error_ahead.T)

# %% slideshow={"slide_type": "fragment"}
ask(
    "03-cross",
    r"The product has four terms. What is the expected value of $F\tilde x\,q^{\mathsf T}$, the product of "
    "the old error and the new process noise?",
    {
        "zero": "the process noise of this step is independent of the errors so far, so the mean "
        "of the product is the product of the means; both means are zero.",
        "F Q": "Q is the expected value of q qᵀ. This term has the old error in place of the first q.",
        "F P": "P is the expected value of x̃ x̃ᵀ. This term has the noise in place of the second x̃.",
    },
    right="zero",
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The expected value of the product
#
# Matrices that are not random can be taken out of the expected value. A random vector of mean zero times
# its own transpose becomes its covariance. The product of one such vector and the transpose of
# another, uncorrelated one becomes zero. `expectation` applies these rules:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="03-cross"
E = expectation({error * error.T: P, q * q.T: Q})
E(error_ahead * error_ahead.T)

# %% [markdown] slideshow={"slide_type": "fragment"}
# This is the **prediction** (also *time update*). $F$ transforms the old covariance, and the process noise adds $Q$:
#
# $$\hat x \leftarrow F \hat x + G u, \qquad P \leftarrow F P F^{\mathsf T} + Q \tag{03.11}$$
#
# Remember the recipe: **write the error, multiply it by its transpose, take the expected value.**
# We will derive all other results with the same recipe.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** Predict the covariance of the cart one step after its start.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
start = kalman_filter.belief(cart.START_X, cart.START_P)
P_ahead = ...  # from cart.F, start.P and cart.Q
compare(P_ahead, kalman_filter.predict(start, cart.F, cart.Q).P)

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# start = kalman_filter.belief(cart.START_X, cart.START_P)
# P_ahead = cart.F @ start.P @ cart.F.T + cart.Q
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Where Q comes from
#
# $Q$ follows from the same recipe. Our cart's position and speed have independent process noise, so its $Q$ is
# diagonal. But suppose that only the acceleration is uncertain, with an error $\delta$ that has the
# variance $\sigma_\delta^2$. Then $q = G \delta$, and $Q = \sigma_\delta^2\,G G^{\mathsf T}$. This matrix is *not*
# diagonal: a single cause disturbs both position and speed, so their noises are correlated.
#
# For the model of any system, list the unknown disturbances, and how each of them affects every component of
# the state.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## The innovation and its covariance
#
# The range finder measures the position with the **measurement noise** $\varepsilon$. It has mean zero
# and covariance $R$, and it is independent of the error of the estimate and from step to step. In
# general a linear sensor measures some components of the state, or linear combinations of them. The matrix $H$
# contains these combinations; for our cart $H = [1\;\;0]$.
#
# $$z = H x + \varepsilon \tag{03.12}$$
#
# The robot predicts the measurement as $H \hat x$. Only the difference between measurement and prediction is
# new information. This difference is called the **innovation** (also *measurement residual*). With (03.12) it
# has two parts:
#
# $$v = z - H \hat x = H \tilde x + \varepsilon \tag{03.13}$$

# %% [markdown] slideshow={"slide_type": "notes"} name="note-the-innovation-and-its-covariance"
# *For the lecturer:* Whoever answers 0.7 adds standard deviations, a mistake that returns in every later
# lesson. Spend a minute on it. Then point at the second number of $S_{xv}$: it is the reason why a position
# sensor can correct a speed.

# %% slideshow={"slide_type": "fragment"}
ask(
    "03-surprise",
    "The error of the estimated position has σ = 0.4 m, the error of the range finder σ = 0.3 m, and "
    "the two errors are independent. How large is σ of the innovation?",
    right=0.5,
    tolerance=0.02,
    unit="m",
    reason="the errors are independent, so their variances add: 0.16 + 0.09 = 0.25, whose root "
    "is 0.5.",
    wrong={
        0.7: "this is the sum of the two σ, which is right only for errors with the correlation 1.",
        0.3: "this is the noise alone, but the predicted measurement has an error as well.",
        0.4: "this is the error of the position alone, but the range finder has an error as well.",
        0.1: "this is the difference, but two independent errors do not cancel systematically.",
        0.25: "this is the variance, in square metres; σ is its root.",
    },
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The innovation covariance
#
# We apply the recipe to (03.13). The measurement noise is independent of the error:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="03-surprise"
H, R = sp.MatrixSymbol("H", m, n), symmetric("R", m)
noise = sp.MatrixSymbol("varepsilon", m, 1)
E = expectation({error * error.T: P, q * q.T: Q, noise * noise.T: R})
innovation = H * error + noise
E(innovation * innovation.T)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The covariance of the predicted measurement and that of the noise add up to the **innovation
# covariance** $S$:
#
# $$S = H P H^{\mathsf T} + R \tag{03.14}$$
#
# As an example, we let the cart roll for two seconds, and then measure a range of 4.6 m:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
rolled = kalman_filter.belief(np.array([3.0, 0.5]), cart.START_P)
for _ in range(4):
    rolled = kalman_filter.predict(rolled, cart.F, cart.Q)
after, step = kalman_filter.update(rolled, [4.6], cart.H, cart.R)
print("predicted range", rolled.x[0], "m, innovation", step.innovation[0].round(2), "m")

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** Compute the innovation covariance of this measurement, a 1 × 1 matrix.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
S_rolled = ...  # from cart.H, rolled.P and cart.R
compare(S_rolled, step.S)

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# S_rolled = cart.H @ rolled.P @ cart.H.T + cart.R
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The cross-covariance of error and innovation
#
# The error $\tilde x$ cannot be observed; the innovation $v$ can. How are they related? We use the recipe
# again, with two different vectors: $E[\tilde x v^{\mathsf T}] = E[\tilde x \tilde
# x^{\mathsf T}] H^{\mathsf T} + E[\tilde x \varepsilon^{\mathsf T}]$, and the second term is zero. So
# the **cross-covariance** of error and innovation is
#
# $$S_{xv} = E[\tilde x v^{\mathsf T}] = P H^{\mathsf T} \tag{03.15}$$
#
# For our cart the cross-covariance is the first *column* of $P$: the variance of the position, and below it the
# covariance of position and speed. Because of this covariance, a measurement of the position can correct the
# speed. We test both formulas with 100 000 carts, each with its own range finder. Their errors have the
# covariance of the rolled cart:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
rng = np.random.default_rng(5)
errors = rng.multivariate_normal([0, 0], rolled.P, 100_000)
innovations = errors @ cart.H.T + rng.normal(0, 0.3, (100_000, 1))
together = np.cov(np.hstack([errors, innovations]).T)  # of position, speed, innovation
print("S    of the carts", together[2, 2].round(2), "       by (03.14)", step.S[0, 0].round(2))
print("S_xv of the carts", together[:2, 2].round(2), "by (03.15)", rolled.P[:, 0].round(2))

# %% [markdown] slideshow={"slide_type": "slide"} minutes=10
# ## The Kalman gain, derived
#
# The **measurement update** (also *correction*) adds a share of the innovation to the estimate. The
# share is the gain $K$, a matrix with a row for each component of the state and a column for each
# measured number:
#
# $$\hat x \leftarrow \hat x + K v \tag{03.16}$$
#
# Which $K$ is the best? We first derive how *any* $K$ changes the error. The truth does not change in the
# update, so the new error is the old error minus the correction. With (03.13),
#
# $$\tilde x \leftarrow \tilde x - K v = (I - K H)\,\tilde x - K \varepsilon \tag{03.17}$$
#
# The mean of the error stays zero, so the estimate stays unbiased. The recipe gives the covariance of the error:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
K, I = sp.MatrixSymbol("K", n, m), sp.Identity(n)
error_after = sp.expand(error - K * innovation)
P_after = E(error_after * error_after.T)
joseph = (I - K * H) * P * (I - K * H).T + K * R * K.T
print("difference from (03.18):", sp.expand(P_after - joseph).doit())
P_after

# %% [markdown] slideshow={"slide_type": "fragment"}
# We can write the same five terms as two squares, one of the remaining old error and one of the noise in the
# correction. The result is the **Joseph form**:
#
# $$P \leftarrow (I - K H)\,P\,(I - K H)^{\mathsf T} + K R K^{\mathsf T} \tag{03.18}$$
#
# A sum of squares cannot be negative. So for any $K$, the right side is a valid covariance.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The minimum mean square error
#
# The trace of $P$ is the sum of the mean square errors of position and speed. The best gain minimises this
# trace. The computer differentiates the trace with respect to all entries of $K$ at once, with the letter
# $S$ for $H P H^{\mathsf T} + R$:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
S = symmetric("S", m)
P_of_K = P - K * H * P - P * H.T * K.T + K * S * K.T
sp.expand(sp.Trace(P_of_K).diff(K))

# %% [markdown] slideshow={"slide_type": "fragment"}
# The derivative is zero where $K S = P H^{\mathsf T}$. At this $K$ the trace is minimal, because the trace is
# quadratic in $K$ and $S$ is positive definite. The solution is the **Kalman gain**:
#
# $$K = P H^{\mathsf T} S^{-1} = S_{xv}\,S^{-1} \tag{03.19}$$
#
# The Kalman gain is *the cross-covariance of error and innovation, divided by the innovation covariance.* With
# one state and one measurement it equals the weight (03.3). The estimate with this gain has the
# **minimum mean square error** (MMSE) among all linear corrections (LMMSE).

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* A common mistake is to leave out $S^{-1}$. Ask for the units of K with our
# state: the position's row has no unit; the speed's row has the unit 1/s. $P H^{\mathsf T}$ alone has m² and m²/s,
# so it cannot be a gain. A check of the units reveals this mistake. For classes without matrix calculus, a
# section *Deeper*
# solves for the two gains of the cart in symbols.

# %% slideshow={"slide_type": "fragment"}
ask(
    "03-speed",
    "The sensor measures the position only, and P is diagonal: the errors of position and speed are "
    "uncorrelated. The measured range is longer than predicted. How does the Kalman gain change "
    "the speed?",
    {
        "it raises the speed": "this would require positively correlated errors, as after "
        "rolling. Here a cart that is farther than estimated is on average neither faster nor "
        "slower than estimated.",
        "it leaves the speed unchanged": "the cross-covariance of speed and innovation is zero, and "
        "so is the speed's row of K.",
        "it lowers the speed": "this would require negatively correlated errors.",
    },
    right="it leaves the speed unchanged",
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The gain found by hand
#
# By (03.15) and (03.19) the speed's gain is the covariance of position and speed divided by $S$:
# **without a covariance there is no correction.** After two seconds of rolling, position and speed have a
# covariance. Correct the 100 000 carts with any two gains. Each contour of the figure connects gains with the
# same sum of the mean square errors.


# %% slideshow={"slide_type": "fragment"} answers="03-speed"
def mean_square(*gains):
    """Sum of the mean square errors of the carts' states after a correction with these gains."""
    corrected = np.column_stack([np.eye(2), -np.array(gains)])
    return np.trace(corrected @ together @ corrected.T)


# %% slideshow={"slide_type": "fragment"} tags=["folded"] answers="03-speed"
def bowl(position_gain, speed_gain):
    """Contours of the remaining error over both gains, the chosen pair and the best."""
    first, second = np.linspace(0, 1.5, 41), np.linspace(-0.3, 0.9, 41)
    heights = [[mean_square(i, j) for i in first] for j in second]
    title = f"sum of the mean square errors: {mean_square(position_gain, speed_gain):.3f} [m² and m²/s²]"
    fig, ax = views.chart("gain of the position [1]", "gain of the speed [1/s]", title, (8, 4.2))
    ax.clabel(ax.contour(first, second, heights, np.arange(0.16, 1.5, 0.12)), fontsize=9)
    ax.plot(*step.K, "*", color=views.COLOURS["corrected"], markersize=14, label="Kalman gain")
    yours = {"color": views.COLOURS["naive"], "markersize": 10, "label": "your gains"}
    ax.plot(position_gain, speed_gain, "o", **yours)
    views.legend_below(fig)
    return fig


# %% slideshow={"slide_type": "fragment"} answers="03-speed"
views.explore(
    bowl,
    lambda position_gain, speed_gain: (
        "Contours with one minimum. A star at the minimum, the Kalman gain "
        f"({step.K[0, 0]:.2f}, {step.K[1, 0]:.2f}); a dot at ({position_gain:.2f}, {speed_gain:.2f})."
    ),
    position_gain=(0.0, 1.5, 0.5),
    speed_gain=(-0.3, 0.9, 0.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="03-speed"
# The contours surround a single minimum. With the gains of the red dot, the update adds half of the innovation
# to the position and leaves the speed unchanged. The blue star is $P H^{\mathsf T} S^{-1}$, and it lies at the
# minimum. Move the dot to the star. Before the measurement the sum of the carts' mean square errors was
# {= mean_square(0, 0):.3f =}; with the Kalman gain the sum becomes {= mean_square(*step.K[:, 0]):.3f =}.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### How much a measurement reduces the uncertainty
#
# For the Kalman gain, and for no other gain, $P H^{\mathsf T} = K S$. We insert this into $P - K H P - P
# H^{\mathsf T} K^{\mathsf T} + K S K^{\mathsf T}$: the last three terms become $-K S K^{\mathsf T} - K S
# K^{\mathsf T} + K S K^{\mathsf T}$, and the result is
#
# $$P \leftarrow P - K S K^{\mathsf T} \tag{03.20}$$
#
# $K S K^{\mathsf T}$ is the covariance of the correction $K v$. So *the posterior covariance is the
# prior covariance minus the covariance of the corrections.* Many books print the equivalent form $(I - K H) P$.
# With most other gains both forms are wrong; a section *Deeper* computes the error of (03.20).

# %% [markdown] slideshow={"slide_type": "slide"} minutes=9
# ## The Kalman filter on a run
#
# > **Algorithm: Kalman filter** (Kalman 1960; *Probabilistic Robotics*, table 3.1, there with $(I - K H)
# > P$ in step 7)
# >
# > **Input:** estimate $\hat x$ and covariance $P$ of the last step; control input $u$; measurement
# > $z$; the model $F, G, Q, H, R$
# >
# > 1. Predict the state: $\hat x \leftarrow F \hat x + G u$
# > 2. Predict its covariance: $P \leftarrow F P F^{\mathsf T} + Q$
# > 3. Innovation: $v = z - H \hat x$
# > 4. Innovation covariance: $S = H P H^{\mathsf T} + R$
# > 5. Kalman gain: $K = P H^{\mathsf T} S^{-1}$
# > 6. Update the state: $\hat x \leftarrow \hat x + K v$
# > 7. Update its covariance: $P \leftarrow (I - K H)\,P\,(I - K H)^{\mathsf T} + K R K^{\mathsf T}$
# >
# > **Output:** $\hat x$ and $P$. Without a measurement, leave out steps 3 to 7.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-the-kalman-filter-on-a-run"
# *For the lecturer:* Before you move the slider, ask what both bands do while the person stands in front of
# the sensor. Students expect a wide band for the speed, because nothing measures it.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
prior = kalman_filter.predict(start, cart.F, cart.Q, cart.G, cart.CONTROLS[0])  # steps 1 and 2
posterior, step_1 = kalman_filter.update(prior, [2.6], cart.H, cart.R)  # steps 3 to 7
print("prior    ", prior.x.round(2), " σ", np.sqrt(np.diag(prior.P)).round(2))
print("gain     ", step_1.K.ravel().round(2), " innovation", step_1.innovation.round(2))
print("posterior", posterior.x.round(2), " σ", np.sqrt(np.diag(posterior.P)).round(2))


def filtered(zs, process_noise=1.0, measurement_noise=1.0):
    """The filter on runs zs; it assumes the true σ of both noises times these two factors."""
    Q, R = process_noise**2 * cart.Q, measurement_noise**2 * cart.R
    return kalman_filter.filter_runs(start, zs, cart.F, Q, cart.H, R, cart.G, cart.CONTROLS)


# %% [markdown] slideshow={"slide_type": "subslide"}
# ### A simulated run of 30 seconds
#
# Each time step is one **prediction and update**. The estimate before the measurement is also called the
# **prior** (in books $\hat x^-$ or $\hat x_{k \mid k-1}$), the estimate after it the **posterior** ($\hat
# x^+$ or $\hat x_{k \mid k}$). You will write the filter in the exercise; `filtered` applies the
# library's filter to whole runs.
#
# The motor accelerates the cart for 3 s, the cart rolls, and the motor brakes for 3 s. From 12 s on, a person
# stands in front of the range finder for some seconds, and the robot gets no measurement. The baseline is **dead
# reckoning**: it uses the control inputs only, and no range finder.


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
SECONDS = cart.T * np.arange(1, 61)


def run_chart(seconds_blocked, run):
    """Errors, truth minus estimate, of position and speed in one run."""
    rng, blocked = np.random.default_rng(run), slice(24, 24 + round(seconds_blocked / cart.T))
    truth, zs = cart.simulate_runs(rng, 1, blocked)
    one, dead = filtered(zs), filtered(np.full_like(zs, np.nan))
    lines = {"range finder": (zs, "scan", "."), "dead reckoning": (dead.x, "naive", "--")}
    lines["filter"] = one.x, "corrected", "-"
    fig, panels = views.panels(["position", "speed"], (9, 4), shared=False)
    for k, (ax, unit, limit) in enumerate(zip(panels, ["m", "m/s"], [2.5, 1.0], strict=True)):
        bound, blue = 2 * np.sqrt(one.P[:, k, k]), views.COLOURS["corrected"]
        ax.fill_between(SECONDS, -bound, bound, color=blue, alpha=0.2, label="±2σ of the filter")
        for name, (estimate, colour, line) in lines.items():
            if k < estimate.shape[-1]:  # the speed is not measured
                errors = (truth[..., k] - estimate[..., k])[0]
                ax.plot(SECONDS, errors, line, color=views.COLOURS[colour], label=name)
        ax.set(aspect="auto", xlabel="time [s]", ylabel=f"error [{unit}]", ylim=(-limit, limit))
    views.legend_below(fig)
    return fig


# %% slideshow={"slide_type": "fragment"}
views.explore(
    run_chart,
    lambda seconds_blocked, run: (
        f"The error of the filter in its band of two σ, which widens for {seconds_blocked} s "
        "without measurements; the error of dead reckoning grows."
    ),
    seconds_blocked=(0, 12, 6),
    run=(1, 30, 4),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The error of the filter (blue) stays mostly within its $\pm 2\sigma$. Without measurements the band widens;
# after a few measurements it is narrow again. The band of the *speed* becomes narrow within seconds, although
# the sensor never measures the speed: because of the cross-covariance $S_{xv}$, the innovation also corrects
# the speed. Dead reckoning (red, dashed) shows the drift of lesson 01. Look at other runs, too.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The rms errors of 200 runs
#
# One run is not a proof. So we simulate 200 runs, each with its own start and noise, and compare the rms
# (root mean square) errors of the three estimates at all steps that have a measurement:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# 200 runs: dead reckoning, the range finder alone, and the filter
truth, zs = cart.simulate_runs(np.random.default_rng(34), 200)
measured = np.isfinite(zs[0, :, 0])
found, reckoned = filtered(zs), filtered(np.full_like(zs, np.nan))
estimates = {"dead reckoning": reckoned.x, "range finder": zs, "filter": found.x}
rms = {
    name: np.sqrt(np.mean((estimate - truth)[:, measured, 0] ** 2, axis=1))
    for name, estimate in estimates.items()
}
for name, values in rms.items():
    print(f"{name:14} rms error of the position, median of 200 runs: {np.median(values):.2f} m")
least = np.minimum(rms["dead reckoning"], rms["range finder"])
print("The filter's rms error is the smallest in", np.sum(rms["filter"] < least), "of 200 runs.")

# %% [markdown] slideshow={"slide_type": "slide"} minutes=10
# ## Part two: the Bayes filter
#
# Part one used means and covariances only. The Bayes filter answers a more general question: what density does
# the state have, given all control inputs $u_{1:k}$ and measurements $z_{1:k}$ so far? Its derivation needs one
# assumption. By the **Markov assumption** the state $x_{k-1}$ contains all of the past that
# matters: given $x_{k-1}$ and $u_k$, the next state does not depend on earlier data, and given $x_k$, the
# measurement does not depend on any other variable. Moreover, the choice of $u_k$ must not reveal more about
# $x_{k-1}$
# than the data do.
#
# We integrate over all previous states (the law of total probability), and use the first part of the assumption:
#
# $$p(x_k \mid z_{1:k-1}, u_{1:k}) = \int p(x_k \mid x_{k-1}, u_k)\;
#   p(x_{k-1} \mid z_{1:k-1}, u_{1:k-1})\,\mathrm d x_{k-1} \tag{03.21}$$
#
# Then we apply Bayes' rule (03.6) to the new measurement, and use the second part of the assumption:
#
# $$p(x_k \mid z_{1:k}, u_{1:k}) = \eta\; p(z_k \mid x_k)\; p(x_k \mid z_{1:k-1}, u_{1:k}) \tag{03.22}$$
#
# The number $\eta$ scales the density to the area one. This alternation of **prediction and update** is a
# recursion: the filter need not store past data.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask for violations of the Markov assumption: a person who stands in front of the sensor
# for several seconds, a floor that is slippery in one corner, a sensor whose error changes with its
# temperature. The usual solution is to add the cause to the state. The grid filter below returns in lesson 11,
# with particles in place of the grid.

# %% [markdown] slideshow={"slide_type": "subslide"}
# > **Algorithm: Bayes filter** (*Probabilistic Robotics*, table 2.1)
# >
# > **Input:** density $p(x_{k-1})$ of the last state, given all data so far; control input $u_k$;
# > measurement $z_k$; motion model $p(x_k \mid x_{k-1}, u_k)$ and measurement model $p(z_k \mid x_k)$
# >
# > 1. Prediction, for all $x_k$:
# >    $\bar p(x_k) = \int p(x_k \mid x_{k-1}, u_k)\,p(x_{k-1})\,\mathrm d x_{k-1}$
# > 2. Update, for all $x_k$: $p(x_k) = p(z_k \mid x_k)\,\bar p(x_k)$
# > 3. Normalise: divide $p(x_k)$ by its integral
# >
# > **Output:** density $p(x_k)$, given all data including $z_k$. It is exact under the Markov assumption.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The Kalman filter is its linear Gaussian case
#
# Suppose that the prior is Gaussian, the models are linear, and both noises are Gaussian and independent
# from step to step, as the Markov assumption requires. Then (03.21) is the density of a sum of
# independent Gaussians, which is Gaussian again; its mean and covariance are (03.11). And (03.22) is a
# product of Gaussians, which is Gaussian as well; its mean and covariance are those of the measurement
# update (the *information form* in *Deeper* adds the exponents). So all densities stay Gaussian, and a mean and
# a covariance describe each density completely. The next cell compares a Bayes filter on a grid of positions
# with the Kalman filter:


# %% slideshow={"slide_type": "fragment"} tags=["code", "nbval-check-output"]
GRID = np.linspace(0, 10, 1001)  # positions [m]


def bayes_filter(p, u, likelihood, sigma_q=0.1):
    """One step of a Bayes filter for the position, on the grid; its model is x + u + noise."""
    predicted = norm.pdf(GRID[:, None], GRID + u, sigma_q) @ p
    return likelihood * predicted / np.sum(likelihood * predicted)


p, b = norm.pdf(GRID, 2.0, 0.6), kalman_filter.belief([2.0], [[0.6**2]])
for u, z in [(0.4, 2.7), (0.4, 3.0), (0.4, 3.1)]:
    p = bayes_filter(p, u, norm.pdf(z, GRID, 0.3))
    b = kalman_filter.predict(b, [[1.0]], [[0.1**2]], [[1.0]], [u])
    b, _ = kalman_filter.update(b, [z], [[1.0]], [[0.3**2]])
mean = GRID @ p
print(f"grid:          {mean:.4f} m, σ = {np.sqrt((GRID - mean) ** 2 @ p):.4f} m")
print(f"Kalman filter: {b.x[0]:.4f} m, σ = {np.sqrt(b.P[0, 0]):.4f} m")

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** The two filters agree. The Kalman filter stores two numbers, and the grid stores
# {= len(GRID) =}, but the grid can represent a density of *any* shape. Suppose that a sensor detects doors. The
# corridor has two doors, at 2 m and at 5 m. The prior is Gaussian about 4 m, and the sensor reports a
# door. Compute the posterior on the grid by Bayes' rule, and scale it so that its sum is one.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
before = norm.pdf(GRID, 4.0, 1.0)
door = np.where((abs(GRID - 2) < 0.3) | (abs(GRID - 5) < 0.3), 0.8, 0.1)  # the likelihood
at_door = ...  # from `before` and `door`
compare(at_door, bayes_filter(before, 0.0, door, sigma_q=1e-3))

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# before = norm.pdf(GRID, 4.0, 1.0)
# door = np.where((abs(GRID - 2) < 0.3) | (abs(GRID - 5) < 0.3), 0.8, 0.1)  # the likelihood
# at_door = door * before / np.sum(door * before)
# ```
#
# This posterior is not Gaussian: it jumps at the edges of each door. Lesson 11 shows a filter for such densities.
# </details>

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## What needs Gaussian errors
#
# The derivation in part one makes no assumption about the *shape* of the error densities. It assumes that the
# means are zero, that the covariances are known, and that the noises are uncorrelated with the errors so far.
#
# We now examine errors that are not Gaussian. Of a hundred ranges, two on average have a very large error,
# positive as often as negative: they are **outliers**. Over all ranges, the mean error is again zero and
# $\sigma$ is again 0.3 m, so $R$ and the gain are the same as before.

# %% slideshow={"slide_type": "fragment"}
ask(
    "03-shape",
    "98 % of the measurements are good, 2 % are outliers; over all of them the mean error is zero and "
    "σ = 0.3 m. Which of our results still hold?",
    {
        "none: the filter needs Gaussian errors": "the derivation used means and covariances "
        "only, and the outliers do not change them.",
        "P is right, but K is no longer the best correction": "K is the best of all linear "
        "corrections, K times the innovation. The derivation did not compare other corrections.",
        "all: P is right, and no correction is better than K": "P is right, and no other gain is "
        "better. But a correction need not be linear in the innovation.",
    },
    right="P is right, but K is no longer the best correction",
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### The conditional mean
#
# The correction with the minimum mean square error is the **conditional mean** $E[\tilde x \mid v]$:
# the mean error of all carts that have the same innovation. We can compute it without a formula: we sort the
# carts into narrow bins of the innovation, and average the error in each bin. In every bin, the mean is the
# correction with the smallest mean square error. The slider sets $\sigma$ of the good measurements, in metres.


# %% slideshow={"slide_type": "fragment"} answers="03-shape" tags=["folded"]
def with_outliers(good, share=0.02):
    """Errors of the carts' positions, and innovations with a share of outliers; σ is 0.3 m."""
    far = np.sqrt((0.3**2 - (1 - share) * good**2) / share)
    rng = np.random.default_rng(6)
    sigmas = np.where(rng.random(len(errors)) < share, far, good)
    return errors[:, 0], errors[:, 0] + sigmas * rng.standard_normal(len(errors))


def corrections(good_sigma):
    """The conditional mean of the carts' errors over the innovation, and the Kalman gain's line."""
    (error, v), edges = with_outliers(good_sigma), np.linspace(-3, 3, 61)
    bins = np.clip(np.digitize(v, edges), 1, len(edges) - 1) - 1
    average = np.bincount(bins, error) / np.bincount(bins)
    linear, least = np.std(error - step.K[0, 0] * v), np.std(error - average[bins])
    title = f"rms error: Kalman gain {linear:.2f} m, conditional mean {least:.2f} m"
    fig, ax = views.chart("innovation [m]", "correction of the position [m]", title, (8, 3.8))
    middle = (edges[1:] + edges[:-1]) / 2
    dots = {"color": views.COLOURS["truth"], "markersize": 4, "label": "conditional mean"}
    ax.plot(middle, average, "o", **dots)
    ax.plot(middle, step.K[0, 0] * middle, color=views.COLOURS["corrected"], label="Kalman gain")
    views.legend(ax)
    return fig


# %% slideshow={"slide_type": "fragment"} answers="03-shape"
views.explore(
    corrections,
    f"A straight line with the slope {step.K[0, 0]:.2f}, the Kalman gain. The conditional mean follows it "
    "for small innovations and bends back for large ones, unless all measurements are equally good.",
    good_sigma=(0.05, 0.3, 0.1),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="03-shape"
# The best correction is almost as large as a small innovation, but nearly zero for a very large innovation,
# which is probably caused by an outlier. No straight line has both properties. Now move the slider to the right
# end, where all measurements are equally good and the noise is Gaussian: the dots lie on the line.
#
# - **For errors of any shape**, with mean zero and the right covariances: the prediction, $S$ and the Joseph
#   form hold, and $K$ is the best *linear* correction. By $P$ the rms error is
#   {= np.sqrt(after.P[0, 0]):.2f =} m here; the rms error of the carts is
#   {= np.std(with_outliers(0.1)[0] - step.K[0, 0] * with_outliers(0.1)[1]):.2f =} m.
# - **For Gaussian errors, and in general not for others:** no other correction is better, the ellipse contains
#   95 %, and the χ² intervals of the tests below hold.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Many texts call the Kalman filter optimal, but do not state the condition. In
# textbooks, optimal means
# best among linear corrections, or for Gaussian errors. The last task of the exercise uses this slide; do not
# solve that task here.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=10
# ## Consistency and the NEES
#
# Is the covariance correct? By the algorithm above, $P$ depends on its initial value, $F$, $Q$, $H$ and $R$
# only. **No measurement enters $P$.** The filter would report the same $P$ even if every measurement were
# false. So we have to test $P$. Three terms describe the result of such a test:
#
# - A filter is **consistent** (Bar-Shalom) if its error has mean zero and the covariance that the filter
#   reports, and its innovations have mean zero, the covariance $S$, and no correlation over time.
# - Its covariance is **conservative** if the mean square of the errors is in no direction larger than reported.
#   As a formula, the following matrix has no negative eigenvalue:
#
# $$P - E[\tilde x \tilde x^{\mathsf T}] \succeq 0 \tag{03.23}$$
#
# - Its covariance is **overconfident** if the mean square of the errors is in some direction larger than reported.
#
# Note that Julier and Uhlmann, and the MAK thesis, call a covariance with (03.23) *consistent*.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Normalised estimation error squared
#
# Errors with different units cannot be added, so we normalise them by the covariance. The **normalised
# estimation error squared** (NEES) is the $d^2$ of (03.9) at the truth:
#
# $$\text{NEES} = \tilde x^{\mathsf T} P^{-1} \tilde x \tag{03.24}$$
#
# For a consistent filter its mean is 2 for two states. With Gaussian errors, each NEES has the χ²
# distribution with 2 degrees of freedom, and the sum over 200 independent runs has the χ² distribution with 400
# degrees of freedom. So
# the mean over the runs lies between {= band(2, 200)[0]:.2f =} and {= band(2, 200)[1]:.2f =} with 95 %
# probability. This is its **χ² interval**. A mean far outside shows that $P$ is wrong or that the
# estimate is biased, unless the errors are far from Gaussian.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Students often think that a small ellipse is always better. After the poll, ask which of
# two wrong filters they would choose for a robot. The conservative filter only uses measurements with too
# little weight; the overconfident filter may reject a right measurement, and the robot may drive into a wall.

# %% slideshow={"slide_type": "fragment"}
ask(
    "03-half-slip",
    "A filter assumes half the true σ of the process noise. Everything else in its model is exact. "
    "Where is its mean NEES after ten seconds?",
    {
        "below the χ² interval": "the NEES is below the interval if P is too large. The P of this "
        "filter is too small.",
        "inside the χ² interval": "the values of the measurements correct its estimate, but its P does not depend on them.",
        "above the χ² interval": "its P is too small for its errors: it is overconfident.",
    },
    right="above the χ² interval",
)


# %% slideshow={"slide_type": "fragment"} answers="03-half-slip" tags=["folded"]
def nees_chart(process_noise, measurement_noise):
    """Mean NEES over time of a filter that assumes other σ of the noises, and of the right one."""
    wrong = filtered(zs, process_noise, measurement_noise)
    fig, ax = views.chart("time [s]", "NEES, mean of 200 runs [1]", size=(8, 3.8))
    for each, colour, line in [(wrong, "naive", "--"), (found, "corrected", "-")]:
        mean = nees(truth - each.x, each.P).mean(axis=0)
        ax.plot(SECONDS, mean, line, color=views.COLOURS[colour])
    views.band(ax, *band(2, 200), "95 % χ² interval")
    ax.legend(["wrong noise", "true noise", "95 % χ² interval"])
    ax.set_ylim(0, 8)
    return fig


def mean_nees(*assumed):
    """The mean NEES over all runs and steps of a filter that assumes other noises."""
    wrong = filtered(zs, *assumed)
    return nees(truth - wrong.x, wrong.P).mean()


# %% slideshow={"slide_type": "fragment"} answers="03-half-slip"
views.explore(
    nees_chart,
    lambda process_noise, measurement_noise: (
        "The NEES with the true noise lies in a grey band. That of a filter which assumes "
        f"{process_noise:.2f} times the σ of the process noise and {measurement_noise:.2f} times the σ of "
        f"the measurement noise is {mean_nees(process_noise, measurement_noise):.1f} on average."
    ),
    process_noise=(0.1, 2.0, 0.5),
    measurement_noise=(0.5, 2.0, 1.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="03-half-slip"
# With the true noise (blue), the mean NEES stays in the χ² interval; by chance it may be outside in one step
# out of twenty. The mean NEES of the other filter (red) leaves the interval within seconds. It is largest while
# the robot gets no measurements, because the effect of the wrong $Q$ then accumulates without a correction. If
# you assume
# *twice* the process noise, the mean NEES falls below the interval: this filter is conservative, but it does
# not use all the information.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## Tests without the truth: NIS and whiteness
#
# The NEES needs the true state, which a real robot does not know. But the robot knows its innovations. The **normalised
# innovation squared** (NIS) is
#
# $$\text{NIS} = v^{\mathsf T} S^{-1} v \tag{03.25}$$
#
# For a consistent filter its mean is the number of measured values, here 1. With Gaussian errors its mean
# over runs and steps has a χ² interval, too. A second test is the **whiteness** of the innovations: in a
# consistent filter they are uncorrelated over time (white). Otherwise we could predict a part of each
# innovation from the innovation before, and the filter would not use all its information. The test computes the **autocorrelation**
# of the innovations over one step, which should be near zero.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-tests-without-the-truth-nis-and-whitenes"
# *For the lecturer:* Cover the last column of the table and ask which filters the class would accept by the
# NIS alone. Then uncover it: one filter with a NIS near 1 has by far the largest NEES.


# %% slideshow={"slide_type": "fragment"}
def innovation_tests(found, steps):
    """Mean NIS over the steps, and autocorrelation of the normalised innovations over one step."""
    v, S = found.innovations[:, steps], found.S[steps]
    white = v[..., 0] / np.sqrt(S[:, 0, 0])
    return nis(v, S).mean(), np.mean(white[:, 1:] * white[:, :-1]) / np.mean(white**2)


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# the tests of filters that assume a wrong noise
cases = {"true noise": (zs, 1, 1), "process noise × 0.5": (zs, 0.5, 1)}
cases |= {"process noise × 2": (zs, 2, 1), "measurement noise × 0.5": (zs, 1, 0.5)}
cases |= {"measurement noise × 2": (zs, 1, 2), "process × 0.1, measurement × 2": (zs, 0.1, 2)}
cases["true noise, range finder + 0.2 m"] = zs + 0.2, 1, 1
print("factors on σ                     NIS  autocorrelation  mean NEES")
for name, assumed in cases.items():
    each = filtered(*assumed)
    row = *innovation_tests(each, measured), nees(truth - each.x, each.P).mean()
    print("{:32} {:.2f} {:+10.2f} {:14.2f}".format(name, *row))

# %% [markdown] slideshow={"slide_type": "fragment"}
# The 95 % intervals are {= band(1, 200 * measured.sum())[0]:.2f =} to
# {= band(1, 200 * measured.sum())[1]:.2f =} for the NIS, and ±{= 1.96 / np.sqrt(200 * measured.sum()):.2f =}
# for the autocorrelation of white innovations. The filter with two wrong factors has a NIS close to 1: the
# wrong factors make the innovations larger, but they make $S$ larger, too. Its autocorrelation shows that the
# filter is not consistent. So check both numbers.
#
# In the last row, the range finder always measures 0.2 m too much. The estimate gets the same bias, so the
# innovations look right; only the NEES, which needs the truth, shows the bias. A good NIS is necessary for
# consistency, but not sufficient.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=8
# ## Tuning Q and R
#
# The true $Q$ and $R$ of a robot are not known. **Tuning Q and R** means choosing them so that the
# filter passes the tests. The table above suggests a method. Its two numbers, NIS and autocorrelation,
# determine two unknowns, one factor for $Q$ and one for $R$.
#
# - The **autocorrelation** depends on the gain, and so on the ratio of $Q$ and $R$. If it is positive, the
#   filter follows too slowly: raise $Q$, or lower $R$. If it is negative, do the opposite.
# - The **NIS** then fixes the scale. Multiply the initial $P$, $Q$ and $R$ by the same factor $\alpha$: every
#   gain and every innovation stay the same, $S$ becomes $\alpha S$, and the NIS is divided by $\alpha$. So
#   choose $\alpha$ equal to the mean NIS, and the new mean NIS is 1.
#
# Tune on one run and test on another run. First find $R$ with the robot at rest, where $Q = 0$.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-tuning-q-and-r"
# *For the lecturer:* Ask which of the two numbers fixes the ratio of $Q$ and $R$, and which one their scale.
# Then ask what is wrong with tuning and testing on the same run.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### A real lidar at rest
#
# Lesson 02 used recordings of an RPLIDAR A2 at rest in a room. For each direction in which the lidar measures a
# steady wall, we run one filter. The state of a filter is one constant: the distance divided by the median of
# its measurements. So $F = H = 1$ and $Q = 0$. A first guess of the noise is σ = 1 % of the
# distance.


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
def steady_ranges(turns):
    """Ranges (directions, turns, 1) of a lidar at rest over their median, for steady walls."""
    directions = np.radians(np.arange(0, 360, 2))
    apart = [abs((t.angles - directions[:, None] + np.pi) % (2 * np.pi) - np.pi) for t in turns]
    nearest = zip(turns, apart, strict=True)
    ranges = np.column_stack([t.ranges[each.argmin(axis=1)] for t, each in nearest])
    middle = np.median(ranges, axis=1)  # NaN if a turn has no return
    slope = abs(np.gradient(middle)) / np.radians(2) / middle
    steady = (
        (slope < 0.2) & (middle < 4) & (abs(ranges - middle[:, None]).max(axis=1) < 0.03 * middle)
    )
    return (ranges[steady] / middle[steady, None])[..., None]


def recordings_at_rest():
    """The turns of two recordings, or of a simulated A2 if they are not on this machine."""
    try:
        return [[r.scan for r in sources.open(f"rplidar-a2-{number}")] for number in (2, 3)]
    except sources.SourceError as missing:
        print(f"A simulated A2 replaces the recordings, because {missing}.")
        rng, room = np.random.default_rng(2), worlds.room()
        scan = (RPLIDAR_A2.scan(room, np.zeros(3), rng) for _ in range(40))
        return [[next(scan) for _ in range(20)] for _ in range(2)]


tuned_on, tested_on = map(steady_ranges, recordings_at_rest())


# %% slideshow={"slide_type": "fragment"} tags=["code"]
def range_tests(zs, R):
    """Mean NIS and autocorrelation of one filter for each direction, without the first turn."""
    one, prior = np.eye(1), kalman_filter.belief([1.0], [[0.1**2]])
    found = kalman_filter.filter_runs(prior, zs, one, 0 * one, one, R * one)
    return innovation_tests(found, slice(1, None))


def report(name, zs, R):
    """Print the tests of the filters of a recording with their 95 % intervals; the mean NIS."""
    (mean, correlation), count = range_tests(zs, R), zs[:, 1:].size
    low, high = band(1, count)
    print(f"{name}: {len(zs)} directions, {zs.shape[1]} turns, σ = {100 * np.sqrt(R):.2f} %")
    print(f"  NIS {mean:.2f} (χ² interval {low:.2f} to {high:.2f})", end=", ")
    print(f"autocorrelation {correlation:+.2f} (±{1.96 / np.sqrt(count):.2f} if white)")
    return mean


R_guess = 0.01**2
nis_guess = report("first guess", tuned_on, R_guess)

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** The NIS is far below its χ² interval, but the autocorrelation is inside its 95 % interval. So
# the test finds no sign of a wrong gain, but the scale of $R$ is much too large. Tune $R$ by the rule for the
# NIS. The check compares your value with the result of a numerical search.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
R_tuned = ...  # from R_guess and nis_guess
compare(R_tuned, brentq(lambda R: range_tests(tuned_on, R)[0] - 1, 1e-7, 1e-3), tolerance=0.02)

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# R_tuned = R_guess * nis_guess
# ```
#
# The initial $P$ is so large that it need not be scaled.
# </details>

# %% slideshow={"slide_type": "fragment"}
_ = report("tuned, the other recording", tested_on, R_guess * nis_guess)

# %% [markdown] slideshow={"slide_type": "fragment"}
# With the first guess, the NIS of the real recording is {= nis_guess:.2f =}, far below its expected value 1. With the
# tuned σ, the NIS of the other recording lies just below its interval: for this recording, the tuned σ is
# slightly conservative. (The intervals assume Gaussian errors that are independent also between directions.)
# The
# same relative σ for all distances is only a model, and lesson 02 has shown its limits. This test also cannot
# find a bias: a lidar at rest does not reveal an error that repeats in all revolutions.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=2
# ## Sources, and what comes next
#
# - **The filter:** R. E. Kalman, "A New Approach to Linear Filtering and Prediction Problems", *Journal
#   of Basic Engineering* 82, 1960. **Joseph form:** R. S. Bucy and P. D. Joseph, *Filtering for
#   Stochastic Processes with Applications to Guidance*, 1968.
# - **The minimum variance among linear estimates:** C. F. Gauss, *Theoria combinationis observationum*, 1823.
# - **The Bayes filter:** S. Thrun, W. Burgard, D. Fox, *Probabilistic Robotics*, 2005, chapters 2 and 3.
# - **Consistency, NEES, NIS, whiteness, tuning:** Y. Bar-Shalom, X. R. Li, T. Kirubarajan, *Estimation
#   with Applications to Tracking and Navigation*, 2001, chapter 5. **Conservative:** S. Julier, J. Uhlmann,
#   "A non-divergent estimation algorithm in the presence of unknown correlations", 1997; the MAK thesis,
#   chapter 2.
# - **Read next:** R. Labbe, *Kalman and Bayesian Filters in Python*, free notebooks.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-sources-and-what-comes-next"
# *For the lecturer:* If a student asks why Gauss is in the list: he proved that least squares has the
# smallest variance among the linear unbiased estimates, and the Kalman filter computes this estimate step by
# step.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### What you can do now
#
# You can derive prediction, innovation and gain by one recipe, state which results need Gaussian errors,
# and test and tune any filter by its innovations.
#
# **Exercise:** [write the filter, piece by piece](../exercises/ex03_kalman_filter.ipynb).
#
# **Next:** this lesson needed *linear* models, but the motion model of a robot that turns is not linear. Lesson
# [04](04_models_and_jacobians.ipynb) linearises real models at the robot's estimate. The sections
# below are optional.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: the Kalman gain is best for every component
#
# The trace adds m² to (m/s)². Is the minimum of such a sum meaningful? For the
# cart we can solve for both gains in symbols: $P$ has the variances $a$ and $b$ and the covariance $c$.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-the-kalman-gain-is-best-for-every"
# *For the lecturer:* Ask whether the minimum would move if the speed were given in cm/s. (It would not, by
# (03.26).)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
a, b, c, k_1, k_2, R_1 = sp.symbols("a b c k_1 k_2 R")
gains, rest = sp.Matrix([k_1, k_2]), sp.Matrix([[1 - k_1, 0], [-k_2, 1]])
left = rest * sp.Matrix([[a, c], [c, b]]) * rest.T + gains * R_1 * gains.T
best = sp.solve([left.trace().diff(k_1), left.trace().diff(k_2)], [k_1, k_2])
K_best = gains.subs(best)
off = gains - K_best
print("zero:", list(sp.simplify(left - left.subs(best) - off * (a + R_1) * off.T)))
K_best

# %% [markdown] slideshow={"slide_type": "fragment"}
# The zeros show that any other gain $K'$ adds a square to the best covariance:
#
# $$P(K') = P(K) + (K' - K)\,S\,(K' - K)^{\mathsf T} \tag{03.26}$$
#
# The added matrix has no negative eigenvalue. So the Kalman gain is best for the position, for the
# speed and for any linear combination of the two, whatever their units.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: the covariance with a suboptimal gain
#
# In practice a gain is often not the best one, because a model is approximate, or because a filter neglects
# correlations. We use the gain $s\,K$ with the factor $s$ from 0 to 2, and compare the covariance by (03.20)
# with the errors of the carts.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-the-covariance-with-a-suboptimal"
# *For the lecturer:* At $s = 2$, ask what a negative mean square means. The formula is not wrong; it is used
# outside its condition.

# %% slideshow={"slide_type": "fragment"}
ask(
    "03-double",
    "A filter uses twice the best gain. How large is the mean square error of the carts after "
    "the update?",
    {
        "smaller than with the best gain": "no gain gives a smaller error than the best gain.",
        "larger than with the best gain, but smaller than without a measurement": "this holds for 1.5 "
        "times the best gain. At twice the best gain the error is larger.",
        "as large as without a measurement": "the error is a parabola in the factor with its "
        "minimum at 1. At 2 the error is as large as at 0.",
    },
    right="as large as without a measurement",
)

# %% slideshow={"slide_type": "fragment"} answers="03-double" tags=["folded"]
factors = np.linspace(0, 2, 21)
happens = [mean_square(*(factor * step.K[:, 0])) for factor in factors]
reported = np.trace(rolled.P) - factors**2 * np.trace(rolled.P - after.P)
labels = "s: gain / best gain [1]", "trace of P [m² and m²/s²]"
fig, ax = views.chart(*labels, size=(8, 3.6))
ax.plot(factors, happens, "o", color=views.COLOURS["truth"], label="100 000 carts")
ax.plot(factors, reported, "--", color=views.COLOURS["naive"], label="reported by (03.20)")
views.legend(ax)
views.show(
    fig,
    f"The carts' error falls from {happens[0]:.2f} to {happens[10]:.2f} at the best gain and rises "
    f"to {happens[-1]:.2f}; the reported error falls to {reported[-1]:.2f}, below zero.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="03-double"
# Equation (03.20) is right at $s = 0$ and $s = 1$ only. For $s$ between 0 and 1 it is conservative, for larger
# $s$ overconfident: at $s = 2$ it gives a *negative* mean square. The Joseph form (03.18) holds for
# every $s$. By how much does the reported covariance exceed the true covariance?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
s = sp.symbols("s", real=True)
true_P = left.subs(dict(zip(gains, s * K_best, strict=True)))
short_form = sp.Matrix([[a, c], [c, b]]) - s**2 * K_best * (a + R_1) * K_best.T
excess = (short_form - true_P).applyfunc(sp.factor)
sp.simplify(excess - 2 * s * (1 - s) * K_best * (a + R_1) * K_best.T)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The output is zero, so the excess is a factor times a square:
#
# $$P_{\text{reported}} - P_{\text{true}} = 2 s (1 - s)\, K S K^{\mathsf T} \tag{03.27}$$
#
# This excess is positive semidefinite for every $0 \le s \le 1$. All these gains are conservative by (03.23);
# only $s = 0$ and $s = 1$ report exactly the true covariance.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: a test for a conservative covariance
#
# With the 200 runs we can also test (03.23) itself. We divide the mean square of the errors in each direction
# by the reported variance. In no direction may the ratio exceed 1 by more than random variation explains. The
# next cell tests the last step:

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-a-test-for-a-conservative-covaria"
# *For the lecturer:* Ask why the program prints "may be conservative" and not "is". A test of this kind can
# only refute.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for factor in (0.5, 1, 2):
    wrong = filtered(zs, factor)
    result = consistency((truth - wrong.x)[:, -1], np.tile(wrong.P[-1], (200, 1, 1)))
    verdict = "overconfident" if result.refuted else "may be conservative"
    value = f"largest mean square {result.largest:.2f} P, limit {result.limit:.2f} P"
    print(f"process noise × {factor:3}: {value}: {verdict}")

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: the information form
#
# Equation (03.4) also has a matrix form. In the product of two Gaussians the exponents add up, and so do the
# inverse covariances:
#
# $$P^{-1} \leftarrow P^{-1} + H^{\mathsf T} R^{-1} H, \qquad
#   P^{-1}\hat x \leftarrow P^{-1} \hat x + H^{\mathsf T} R^{-1} z \tag{03.28}$$
#
# $P^{-1}$ is the **information matrix**, $P^{-1} \hat x$ the *information vector*. A filter that stores these two is in **information form** (an *information filter*). In information form an update is a sum, and a
# prediction needs inverses. Lesson 15 solves whole graphs in information form.

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-the-information-form"
# *For the lecturer:* Show this section if your course reaches lesson 15: there, every measurement adds such a
# term to one large matrix.

# %% [markdown] slideshow={"slide_type": "subslide"}
# **Your turn.** Compute the information matrix of the rolled cart after its measurement.

# %% slideshow={"slide_type": "fragment"} tags=["your-turn"]
prior_information = np.linalg.inv(rolled.P)
posterior_information = ...  # from prior_information, cart.H and cart.R
compare(posterior_information, np.linalg.inv(after.P))

# %% [markdown] slideshow={"slide_type": "fragment"}
# <details><summary>Answer</summary>
#
# ```python
# prior_information = np.linalg.inv(rolled.P)
# posterior_information = prior_information + cart.H.T @ np.linalg.inv(cart.R) @ cart.H
# ```
#
# </details>

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: the Joseph form and rounding errors
#
# With the Kalman gain, (03.18), (03.20) and $(I - K H) P$ are equal in exact arithmetic. With rounding errors
# they differ. Let the prior $\sigma$ be about a kilometre, and measure the state more and more exactly. How
# often does
# the updated $P$ have a negative variance in some direction?

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-the-joseph-form-and-rounding-erro"
# *For the lecturer:* Use this table if somebody asks why the boxes contain the long form.


# %% slideshow={"slide_type": "fragment"}
# whether the updated P has a negative eigenvalue, by each of the three forms
def negative(sensor_sigma, rng):
    """Whether the updated P has a negative eigenvalue: by each of the three forms."""
    root, H = rng.normal(0, 1000, (2, 2)), np.array([[1.0, 0.7], [0.2, 1.0]])
    b = kalman_filter.belief([0, 0], root @ root.T)
    joseph, used = kalman_filter.update(b, [0, 0], H, sensor_sigma**2 * np.eye(2))
    short, shorter = b.P - used.K @ used.S @ used.K.T, (np.eye(2) - used.K @ H) @ b.P
    return [np.linalg.eigvalsh((P + P.T) / 2)[0] < 0 for P in (short, shorter, joseph.P)]


# %% slideshow={"slide_type": "fragment"}
rng = np.random.default_rng(6)
print("σ of the sensor   P − K S Kᵀ   (I − K H) P   Joseph")
for sigma in (1, 1e-5, 1e-6):
    share = np.mean([negative(sigma, rng) for _ in range(500)], axis=0)
    print(f"{sigma:13g} m" + "".join(f"{100 * value:10.0f} %" for value in share))

# %% [markdown] slideshow={"slide_type": "fragment"}
# The difference of two large and nearly equal numbers consists mostly of rounding errors. The Joseph form adds
# two squares instead, and it never fails in these runs. With ordinary numbers (first row) none of the three
# forms fails. So the Joseph form is a precaution, which costs a few more products. The library `filterpy` uses
# the Joseph form, too. The next cell runs the Kalman filter of this library on the first of our 200 runs:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
# the same runs by the library filterpy
from filterpy.kalman import KalmanFilter

theirs = KalmanFilter(dim_x=2, dim_z=1)
theirs.x, theirs.P, theirs.F, theirs.B = start.x, start.P, cart.F, cart.G
theirs.Q, theirs.H, theirs.R = cart.Q, cart.H, cart.R
readings = [z if np.isfinite(z).all() else None for z in zs[0]]
means, covariances, *_ = theirs.batch_filter(readings, us=cart.CONTROLS)
print("x differs by less than 1e-9: ", bool(abs(means - found.x[0]).max() < 1e-9))
print("P differs by less than 1e-12:", bool(abs(covariances - found.P).max() < 1e-12))

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: batch least squares
#
# The filter uses each measurement once and forgets it. **Batch least squares** keeps all measurements
# and solves for all states at once. It minimises the weighted sum of *all* squares: the squares of the initial
# error, of the process noise and of the measurement noise. Is its estimate of the last state better than that
# of the filter?

# %% [markdown] slideshow={"slide_type": "notes"} name="note-deeper-batch-least-squares"
# *For the lecturer:* Ask before you run the cell whether a method that keeps all data estimates the *last*
# state better. Most students expect that it does.


# %% slideshow={"slide_type": "fragment"}
# the equations of a run: its start, its steps, its measurements
def equations(zs):
    """Equations (block by step, value, covariance) of a run: its start, steps and measurements."""
    yield {0: np.eye(2)}, start.x, start.P
    for k, (u, z) in enumerate(zip(cart.CONTROLS, zs, strict=True)):
        yield {k: -cart.F, k + 1: np.eye(2)}, cart.G @ u, cart.Q
        if np.isfinite(z).all():
            yield {k + 1: cart.H}, z, cart.R


# %% slideshow={"slide_type": "fragment"} tags=["folded"]
def least_squares(zs):
    """The last state of a run, estimated with all others at once, and its covariance."""
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
x_batch, P_batch = least_squares(zs[0])
print("filter", found.x[0, -1].round(6), " batch", x_batch.round(6))
print("x differs by less than 1e-9: ", bool(abs(found.x[0, -1] - x_batch).max() < 1e-9))
print("P differs by less than 1e-12:", bool(abs(found.P[-1] - P_batch).max() < 1e-12))

# %% [markdown] slideshow={"slide_type": "fragment"}
# Both estimates of the last state are equal. With linear models and Gaussian errors, $\hat x$ and $P$ contain *all*
# the information about the present state that the past measurements provide. The filter solves the same
# least-squares problem step by step, and stores five numbers only, two of $\hat x$ and three of $P$. But batch
# least squares does estimate the *earlier* states better, because it also uses later measurements for them.
# Estimation of earlier states with later measurements is called **smoothing**; lesson 15 returns to it.
