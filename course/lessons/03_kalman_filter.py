# %% [markdown] slideshow={"slide_type": "slide"}
# # 03 · The Kalman filter
#
# **You will be able to** derive the Kalman filter line by line, write it in ten lines, say what
# each line is for, and test whether a filter that you are shown tells the truth about its errors.
#
# **75 minutes.** **Before:** lessons [00](00_start_here.ipynb) and [01](01_why_slam.ipynb); matrix
# products; what a covariance is.
#
# Source: MAK thesis, chapter 2, with its errata.
#
# *Key:* an estimate that knows how wrong it may be can be mended by every measurement, each by as
# much as it deserves.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Two halves: derivation up to the gain (40 minutes), then the filter at work
# and what consistency means (35). One idea carries the first: every covariance below comes from
# *one* recipe, "write the error, multiply it by its transpose, take the expected value". Let the
# class do it by hand once, for the prediction; the machine does it three more times.

# %% slideshow={"slide_type": "skip"}
import numpy as np
import sympy as sp

from slamlab import views
from slamlab.evaluation import band, consistency, nees

# %% [markdown] slideshow={"slide_type": "slide"}
# ## A belief: a number, and how wrong it may be
#
# A robot drives along a corridor. Its wheels say that it is 4.0 m from the wall behind it; they may
# be off by σ = 0.6 m. Its range finder says 5.0 m, with σ = 0.3 m.
#
# **Question.** Where is it? **Predict** a number. Then predict how sure you may be of it: worse
# than 0.3 m, as good, better?

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Collect answers on the board. Most people say "nearer to 5". Almost nobody
# expects the result to be *surer than the better of the two*. Without the two σ there is no answer
# but the mean, 4.5: that is what a covariance is good for.

# %% [markdown] slideshow={"slide_type": "fragment"}
# Mix the two numbers: (1 − w) · wheels + w · range finder. Both errors are independent, so their
# variances P and R add, each times its weight squared:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
w, p, rho = sp.symbols("w P R", positive=True)
variance = (1 - w) ** 2 * p + w**2 * rho
variance

# %% [markdown] slideshow={"slide_type": "fragment"}
# The best weight makes that as small as it can be:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
sp.diff(variance, w)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
(best_weight,) = sp.solve(sp.diff(variance, w), w)
best_weight

# %% [markdown] slideshow={"slide_type": "fragment"}
# My own doubt, divided by all the doubt there is. What is left of it?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
left = sp.simplify(variance.subs(w, best_weight))
print("variance left:", left, "   1 / variance:", sp.expand(1 / left))

# %% [markdown] slideshow={"slide_type": "fragment"}
# One over the variance, call it *information*, simply adds up. So two sources always know more than
# the better one alone.


# %% slideshow={"slide_type": "slide"}
def fuse(a, variance_a, z, variance_z):
    """The best mixture of two independent numbers, and its variance."""
    weight = variance_a / (variance_a + variance_z)
    return a + weight * (z - a), (1 - weight) * variance_a


def bell(at, mean, variance):
    """The density of a Gaussian."""
    return np.exp(-((at - mean) ** 2) / (2 * variance)) / np.sqrt(2 * np.pi * variance)


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
place, left_over = fuse(4.0, 0.6**2, 5.0, 0.3**2)
print(f"{place:.2f} m, σ = {np.sqrt(left_over):.2f} m")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The same as a picture: how likely is each place? Where both say "likely", it is. **Predict** where
# the fused bell goes when the range finder gets worse; then move the slider.


# %% slideshow={"slide_type": "fragment"}
def two_bells(range_sigma):
    at = np.linspace(1.5, 7.5, 400)
    mean, variance = fuse(4.0, 0.36, 5.0, range_sigma**2)
    shown = {
        "fused": bell(at, mean, variance),
        "range finder": bell(at, 5.0, range_sigma**2),
        "wheels": bell(at, 4.0, 0.36),
    }
    title = f"fused: {mean:.2f} m, σ = {np.sqrt(variance):.2f} m"
    return views.curves(at, shown, "distance to the wall [m]", "density [1/m]", title)[0]


views.explore(
    two_bells,
    "Three bells: left the wheels', right the range finder's; the fused one between, narrowest.",
    range_sigma=(0.1, 2.0, 0.3),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the fused bell stands between the two, nearer to the surer one, and is narrower than
# both. A useless range finder (σ = 2 m) hardly moves it, but never widens it. And it *is* the
# product of the two bells, brought to area one:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
at = np.linspace(0, 10, 2001)
product = bell(at, 4.0, 0.36) * bell(at, 5.0, 0.09)
product /= product.sum() * (at[1] - at[0])
print("largest difference:", abs(product - bell(at, place, left_over)).max().round(9))

# %% [markdown] slideshow={"slide_type": "slide"}
# ## A belief of two numbers
#
# Our robot is a cart in that corridor. Its *state* is its position [m] (distance to the wall) and
# its speed [m/s]. Every T = 0.5 s the motor gives a known push u [m/s²]:
#
# $$x^+ = F x + G u + q$$
#
# q is what nobody tells the robot: wheels slip, the motor is not exact. It is random, its mean is
# zero, its covariance is Q. The *belief* is a mean x and a covariance P.

# %% slideshow={"slide_type": "fragment"}
T = 0.5
F = np.array([[1, T], [0, 1]])
G = np.array([[T**2 / 2], [T]])
Q = np.diag([0.02, 0.05]) ** 2
x_start, P_start = np.array([2.0, 0.0]), np.diag([0.4, 0.3]) ** 2

# %% [markdown] slideshow={"slide_type": "fragment"}
# Position and speed of this belief are unrelated: P_start is diagonal.
#
# **Question.** The cart rolls for two seconds, without a push. What becomes of the 1000 places and
# speeds it may have? **Predict** the shape of the cloud: a disc, a streak? Leaning which way?


# %% slideshow={"slide_type": "fragment"}
def rolling(steps):
    rng = np.random.default_rng(3)
    carts, P = rng.multivariate_normal(x_start, P_start, 1000), P_start
    for _ in range(steps):
        carts = carts @ F.T + rng.multivariate_normal([0, 0], Q, 1000)
        P = F @ P @ F.T + Q
    fig, ax = views.cloud(carts, {"F P Fᵀ + Q, 95 %": P}, f"after {steps * T:.1f} s")
    ax.set(xlabel="position [m]", ylabel="speed [m/s]")
    return fig


views.explore(
    rolling,
    lambda steps: (
        f"Carts after {steps * T:.1f} s: the longer they roll, the more they form a streak."
    ),
    steps=(0, 12, 4),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** a streak that leans to the right, and an ellipse that holds it. Whoever is faster than
# believed is also farther than believed: position and speed have become *correlated*. Put the
# slider to 0 and go step by step. The ellipse is one line of code; now derive it.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Dwell on the correlation: a bit later the cart measures its position only, and
# *because of this streak* learns its speed. In SLAM, robot and landmarks will hang together like
# this, and everything in lessons 06 and 07 rests on it.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Prediction, derived
#
# The *error* is truth minus estimate, x̃ = x − x̂. The truth moves with q, the estimate without:

# %% slideshow={"slide_type": "fragment"}
n, m, k = sp.symbols("n m k", integer=True, positive=True)
FF, PP, QQ = (sp.MatrixSymbol(name, n, n) for name in "FPQ")
GG, uu = sp.MatrixSymbol("G", n, k), sp.MatrixSymbol("u", k, 1)
truth, estimate = sp.MatrixSymbol("x", n, 1), sp.MatrixSymbol(r"\hat{x}", n, 1)
err, qq = sp.MatrixSymbol(r"\tilde{x}", n, 1), sp.MatrixSymbol("q", n, 1)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
sp.expand((FF * truth + GG * uu + qq) - (FF * estimate + GG * uu))

# %% [markdown] slideshow={"slide_type": "fragment"}
# The push cancels: what is known adds no doubt. With x̃ for x − x̂ the new error is

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
err_ahead = FF * err + qq
err_ahead

# %% [markdown] slideshow={"slide_type": "fragment"}
# A covariance is, by definition, the expected value of the error times its transpose. So multiply:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
sp.expand(err_ahead * err_ahead.T)

# %% [markdown] slideshow={"slide_type": "slide"}
# Now the expected value. **Predict** what becomes of each of the four terms.
#
# Matrices that are not random go through. Each pair of errors becomes its covariance: x̃x̃ᵀ becomes
# P, qqᵀ becomes Q; x̃qᵀ becomes zero, for the slip of this step knows nothing of the errors so far.
# That is all, and it is a program:

# %% slideshow={"slide_type": "fragment"}
rr = sp.MatrixSymbol("r", m, 1)  # the range finder's error, needed below
RR = sp.MatrixSymbol("R", m, m)
COVARIANCE = {err * err.T: PP, qq * qq.T: QQ, rr * rr.T: RR}


def E(product):
    """Expected value: pairs of errors become covariances, pairs of unrelated ones vanish."""
    total = sp.ZeroMatrix(*product.shape)
    for term in sp.Add.make_args(sp.expand(product)):
        sign, factors = term.as_coeff_matrices()
        at = next(i for i, factor in enumerate(factors) if factor in (err, qq, rr))
        covariance = COVARIANCE.get(factors[at] * factors[at + 1])
        if covariance is not None:
            total += sign * sp.MatMul(*factors[:at], covariance, *factors[at + 2 :])
    return total


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
E(err_ahead * err_ahead.T)

# %% [markdown] slideshow={"slide_type": "fragment"}
# That is the prediction: what there was, carried along by F, plus what the step adds. Remember the
# recipe: *write the error, multiply it by its transpose, take E*. It is used three times more.


# %% slideshow={"slide_type": "fragment"}
def predict(x, P, u, Q=Q):
    """Let a step of T seconds pass, with push u."""
    return F @ x + G @ u, F @ P @ F.T + Q


# %% [markdown] slideshow={"slide_type": "slide"}
# ## A measurement: the innovation
#
# The range finder measures z = H x + r: here the position, so H = [1 0], with σ = 0.3 m. The robot
# knows what it *expects* to measure, H x̂. What is new is the difference, the **innovation**
# v = z − H x̂.
#
# **Question.** The robot's position may be off by 0.4 m (σ), the range finder by 0.3 m. How large
# an innovation is nothing to worry about? **Predict** its σ.

# %% slideshow={"slide_type": "fragment"}
H, R = np.array([[1.0, 0.0]]), np.array([[0.3**2]])
HH, KK = sp.MatrixSymbol("H", m, n), sp.MatrixSymbol("K", n, m)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
sp.expand((HH * truth + rr) - HH * estimate)

# %% [markdown] slideshow={"slide_type": "fragment"}
# So v = H x̃ + r. Its covariance is called S. The recipe:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
innovation = HH * err + rr
E(innovation * innovation.T)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Two unrelated errors: their covariances add. For the question above, in metres:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
np.sqrt(H @ P_start @ H.T + R).item()

# %% [markdown] slideshow={"slide_type": "fragment"}
# And how do the error (which nobody sees) and the innovation (which everybody sees) hang together?
# Their cross covariance S_xv = E[x̃ vᵀ]:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
E(err * innovation.T)

# %% [markdown] slideshow={"slide_type": "fragment"}
# This is the bridge over which a measurement of the position reaches the speed. Hold all of it
# against 100 000 carts of the streak above:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
rng = np.random.default_rng(5)
P_streak = P_start
for _ in range(4):
    P_streak = F @ P_streak @ F.T + Q
errors = rng.multivariate_normal([0, 0], P_streak, 100_000)
noises = rng.normal(0, 0.3, (100_000, 1))
innovations = errors @ H.T + noises
S_streak = H @ P_streak @ H.T + R
print("S    carts", np.cov(innovations.T).round(2), "  formula", S_streak[0, 0].round(2))
S_xv = errors.T @ innovations / len(errors)
print("S_xv carts", S_xv.ravel().round(2), " formula", (P_streak @ H.T).ravel().round(2))

# %% [markdown] slideshow={"slide_type": "slide"}
# ## COIN, and two misprints
#
# An observation whose innovation depends on two things only, the estimate's error and the
# observation's noise, has a **constrained innovation**: the MAK thesis calls it *COIN*. Then P and R
# are all one needs to know. Ours is one: v = H x̃ + r, nothing else.
#
# The thesis defines it as an innovation "smaller than the error and the noise". **Predict:** how
# often is an innovation smaller than both?

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
smaller = (abs(innovations) < abs(errors[:, :1])) & (abs(innovations) < abs(noises))
print(
    f"smaller than both: {smaller.mean():.0%} of the carts; σ of the innovation: "
    f"{innovations.std():.2f} m, of position {errors[:, 0].std():.2f} m, of noise 0.30 m"
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Innovations are the *largest* of the three: S is a sum. "Depends only on" is meant. Seen from a
# robot that knows neither its own place nor the landmark's, an observation is not COIN for the
# robot alone: two errors are in it. That is SLAM's trouble, and lesson 06's cure is to put both
# into one state.
#
# Thesis (2.11) says S_xv = S_xvᵀ. **Predict** what the machine says to that.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
S_vx = E(innovation * err.T)
print("S_xv =", E(err * innovation.T), "has shape", E(err * innovation.T).shape)
print("S_vx =", S_vx, "has shape", S_vx.shape)

# %% [markdown] slideshow={"slide_type": "slide"}
# ## The gain, derived
#
# Correct the estimate by a share of the innovation: x̂⁺ = x̂ + K v. K is a matrix with a row for each
# component of the state. **Question.** Which K is best?
#
# First, what *any* K does to the error:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
err_after = err - KK * innovation
sp.expand(err_after)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The recipe again. **Predict** how many terms are left.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
P_after = E(sp.expand(err_after) * sp.expand(err_after).T)
P_after

# %% [markdown] slideshow={"slide_type": "fragment"}
# The same sum, written as two squares, is called **Joseph's form**. As a sum of squares it can
# never turn negative, whatever K is:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
I_KH = sp.Identity(n) - KK * HH
joseph_form = I_KH * PP * I_KH.T + KK * RR * KK.T
print("difference:", sp.expand(P_after - joseph_form).doit())
joseph_form

# %% [markdown] slideshow={"slide_type": "fragment"}
# Its trace is the sum of all squared errors to expect (position's and speed's). With S for
# H P Hᵀ + R, differentiate it by all entries of K at once:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
SS = sp.MatrixSymbol("S", m, m)
in_S = PP - KK * HH * PP - PP * HH.T * KK.T + KK * SS * KK.T
symmetric = sp.Q.symmetric(PP) & sp.Q.symmetric(SS)
slope = sp.expand(sp.refine(sp.Trace(in_S).diff(KK), symmetric))
slope

# %% [markdown] slideshow={"slide_type": "fragment"}
# Zero where K S = P Hᵀ, which is where
#
# $$K = P H^{\mathsf T} S^{-1} = S_{xv}\,S^{-1}$$
#
# Read it: *how much error and innovation have in common, divided by how large innovations are
# anyway*. In one dimension it is P / (P + R), the weight of the first slide.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* What usually goes wrong: S⁻¹ is left out (the thesis does so in (4.19) and
# others). Ask for the units of K with our state: position row [1], speed row [1/s]. P Hᵀ alone has
# [m²] and [m²/s]: it cannot be a gain. Units find this mistake at once.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Letter by letter, for the cart
#
# Trust the machine's matrix calculus? Do it once more with plain letters: two states, one
# measurement.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
a, b, c, k1, k2 = sp.symbols("a b c k_1 k_2")
P2, H2, R2 = sp.Matrix([[a, c], [c, b]]), sp.Matrix([[1, 0]]), sp.Matrix([[rho]])
K2 = sp.Matrix([k1, k2])
left2 = (sp.eye(2) - K2 * H2) * P2 * (sp.eye(2) - K2 * H2).T + K2 * R2 * K2.T
sp.collect(sp.expand(left2.trace()), [k1, k2])

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
best = sp.solve([left2.trace().diff(k1), left2.trace().diff(k2)], [k1, k2])
by_formula = P2 * H2.T * (H2 * P2 * H2.T + R2).inv()
print("difference to P Hᵀ S⁻¹:", sp.simplify(K2.subs(best) - by_formula).T)
K2.subs(best)

# %% [markdown] slideshow={"slide_type": "fragment"}
# The speed's gain is c / (a + R): **no covariance c, no correction**. The speed is never measured;
# it is corrected through what it shares with the position.
#
# May one add m² of position to (m/s)² of speed? Look at what any other gain costs:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
S2 = H2 * P2 * H2.T + R2
off = K2 - by_formula
sp.simplify(left2 - left2.subs(best) - off * S2 * off.T)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Every other gain adds (K − best) S (K − best)ᵀ, a square: it harms, or at best does nothing, in
# *every* state. So the best gain is best for position, for speed and for any mixture of the two,
# whatever their units.
#
# The trace is a bowl over k₁ and k₂. **Predict** where its lowest point is for the streak; find it
# with the sliders.


# %% slideshow={"slide_type": "fragment"}
def trace_left(K, P=P_streak, H=H, R=R):
    """Sum of squared errors to expect after a correction with gain K: trace of Joseph's form."""
    rest = np.eye(2) - K @ H
    return np.trace(rest @ P @ rest.T + K @ R @ K.T)


def bowl(position_gain, speed_gain):
    first, second = np.linspace(0, 1.5, 41), np.linspace(-0.3, 0.9, 41)
    heights = [[trace_left(np.array([[i], [j]])) for i in first] for j in second]
    here = trace_left(np.array([[position_gain], [speed_gain]]))
    title = f"trace P⁺ = {here:.3f}   (before: {np.trace(P_streak):.3f})"
    fig, ax = views.chart("k₁, gain of position [1]", "k₂, gain of speed [1/s]", title)
    lines = ax.contour(first, second, heights, np.arange(0.16, 1.5, 0.12), cmap="viridis")
    ax.clabel(lines, fontsize=9)
    ax.plot(position_gain, speed_gain, "o", color=views.COLOURS["naive"], markersize=10)
    ax.plot(*(P_streak @ H.T / S_streak), "*", color=views.COLOURS["corrected"], markersize=14)
    return fig


views.explore(
    bowl,
    "Contours of a bowl over both gains; a star at its lowest point, a dot away from it.",
    position_gain=(0.0, 1.5, 0.5),
    speed_gain=(-0.3, 0.9, 0.0),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** contours of a bowl. The dot (red) corrects half the position and leaves the speed
# alone; the star (blue) is K = P Hᵀ S⁻¹, at the bottom. Nothing you do with the sliders gets lower.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## The short form, and what a wrong gain does to it
#
# With the best K, and only with it, P Hᵀ may be replaced by K S:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
sp.refine(in_S.subs(PP * HH.T, KK * SS).subs(HH * PP, SS * KK.T), symmetric).doit()

# %% [markdown] slideshow={"slide_type": "fragment"}
# That is the thesis' (2.14), P⁺ = P − K S Kᵀ: what is known is what was known less what was
# learned. Three short factors instead of Joseph's six.
#
# **Question.** Somebody's gain is wrong by a factor α: K = α P Hᵀ S⁻¹. What does each of the two
# forms claim, and what happens to the carts? **Predict** for α = 2.

# %% slideshow={"slide_type": "fragment"}
K_best = P_streak @ H.T @ np.linalg.inv(S_streak)
alphas = np.linspace(0, 2, 21)
gains = [factor * K_best for factor in alphas]
short = [np.trace(P_streak - K @ S_streak @ K.T) for K in gains]
joseph = [trace_left(K) for K in gains]
carts = [np.sum((errors - innovations @ K.T) ** 2, axis=1).mean() for K in gains]

# %% slideshow={"slide_type": "fragment"}
claims = {"Joseph's form": joseph, "P − K S Kᵀ": short}
fig, ax = views.curves(alphas, claims, "α: gain / best gain", "trace P⁺ (m and m/s, squared)")
ax.plot(alphas, carts, "o", color=views.COLOURS["truth"], label="100 000 carts")
ax.axhline(0, color=views.COLOURS["guide"])
views.legend(ax)
views.show(
    fig, "Joseph's curve goes through the carts, lowest at the best gain; the short form falls."
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** Joseph's form tells what happens to the carts for every gain, and is lowest at α = 1. The
# short form agrees at 0 and at 1 only. For smaller gains it is too modest, for larger ones it
# boasts: with twice the gain the carts are as badly off as before, and the short form claims a
# *negative* sum of squares.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask for a gain that is wrong in practice: an EKF's Jacobian taken at the wrong
# place (lesson 07), a gain rounded or clipped, correlations set to zero. Then Joseph's form is the
# honest one, but only as far as P and R themselves are true.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## The whole filter
#
# All of it, derived above, in ten lines with `predict`:


# %% slideshow={"slide_type": "fragment"}
def update(x, P, z):
    """Take a measurement in."""
    v = z - H @ x
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    rest = np.eye(len(P)) - K @ H
    return x + K @ v, rest @ P @ rest.T + K @ R @ K.T, v, S


# %% [markdown] slideshow={"slide_type": "fragment"}
# A drive of 30 s: the motor pushes for 3 s, the cart rolls, the motor brakes for 3 s. From 12 s to
# 18 s somebody stands before the range finder: no measurement.

# %% slideshow={"slide_type": "fragment"}
pushes = np.zeros((60, 1))
pushes[:6], pushes[44:50] = 0.3, -0.3
BLOCKED = slice(24, 36)


def drive(rng):
    """One drive: the true states (60, 2) and the measurements (60, 1), nan where blocked."""
    x, truth, z = rng.multivariate_normal(x_start, P_start), [], []
    for u in pushes:
        x = F @ x + G @ u + rng.multivariate_normal([0, 0], Q)
        truth.append(x)
        z.append(H @ x + rng.normal(0, 0.3, 1))
    z = np.array(z)
    z[BLOCKED] = np.nan
    return np.array(truth), z


# %% slideshow={"slide_type": "fragment"}
def run(zs, Q=Q):
    """The filter on a drive: x, P, v and S after every step."""
    x, P, beliefs = x_start, P_start, []
    for u, z in zip(pushes, zs, strict=True):
        x, P = predict(x, P, u, Q)
        v, S = np.full(1, np.nan), np.full((1, 1), np.nan)
        if np.isfinite(z).all():
            x, P, v, S = update(x, P, z)
        beliefs.append((x, P, v, S))
    return [np.array(values) for values in zip(*beliefs, strict=True)]


# %% [markdown] slideshow={"slide_type": "fragment"}
# **Predict:** what does the band of ±2σ do while the range finder is blocked? And what will the
# estimate of the *speed* look like, which nobody measures?

# %% slideshow={"slide_type": "fragment"}
true_states, zs = drive(np.random.default_rng(34))
xs, Ps, vs, Ss = run(zs)
dead = run(np.full_like(zs, np.nan))[0]
seconds = T * np.arange(1, 61)


def band_chart(component, quantity):
    """One component of the state: truth, estimate and its band of ±2σ."""
    shown = {"filter, ±2σ": xs[:, component], "pushes only": dead[:, component]}
    fig, ax = views.curves(seconds, shown, "time [s]", quantity, size=(7, 3.4))
    two_sigma = 2 * np.sqrt(Ps[:, component, component])
    low, high = xs[:, component] - two_sigma, xs[:, component] + two_sigma
    ax.fill_between(seconds, low, high, color=views.COLOURS["corrected"], alpha=0.2)
    ax.plot(seconds, true_states[:, component], color=views.COLOURS["truth"], label="truth")
    return fig, ax


# %% slideshow={"slide_type": "slide"}
fig, ax = band_chart(0, "position [m]")
ax.plot(seconds, zs, ".", color=views.COLOURS["scan"], label="measured")
views.legend(ax, loc="upper left")
views.show(fig, "Truth inside the filter's band, which swells while nothing is measured.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the filter (blue) follows the truth (black) more closely than the single measurements do.
# While nothing is measured the band swells, and one measurement later it is narrow again. Who only
# adds up the pushes (red, dashed) loses the cart: lesson 01's drift. In numbers, where there was
# a measurement:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
seen = np.isfinite(zs[:, 0])
for name, found in {"measured": zs[:, 0], "filter": xs[:, 0], "pushes only": dead[:, 0]}.items():
    rms = np.sqrt(np.mean((found - true_states[:, 0])[seen] ** 2))
    print(f"{name:11}  root mean square error {rms:.2f} m")

# %% slideshow={"slide_type": "fragment"}
fig, ax = band_chart(1, "speed [m/s]")
views.legend(ax, loc="lower center")
views.show(fig, "The speed, never measured, is followed within its band.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the speed's band starts wide and narrows within a few steps, although no speed is ever
# measured: that is S_xv at work.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## The innovations of a right filter
#
# Nobody who drives a real robot has the black line. What everybody has is the innovation and its S.
#
# **Question.** If everything was learned from the measurements so far, what does the next
# innovation look like? **Predict:** how does it hang together with the one before it?

# %% slideshow={"slide_type": "fragment"}
DRIVES = [drive(np.random.default_rng(seed)) for seed in range(200)]


def innovations_of(Q):
    """v/√S of 200 drives: (200, 48), blocked steps left out."""
    found = [run(zs, Q) for _, zs in DRIVES]
    return np.array([(v / np.sqrt(S[:, 0]))[np.isfinite(v)] for _, _, v, S in found])


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for name, believed in {"Q as it is": Q, "Q / 100": Q / 100}.items():
    white = innovations_of(believed)
    lag = np.mean(white[:, 1:] * white[:, :-1]) / np.mean(white**2)
    print(f"{name:10}  mean NIS {np.mean(white**2):.2f}   with the one before: {lag:+.2f}")
print("95 % band of the mean NIS:", np.round(band(size=1, runs=white.size), 2))

# %% [markdown] slideshow={"slide_type": "fragment"}
# The *normalised innovation squared*, NIS = vᵀ S⁻¹ v, is 1 on average per measured number, and each
# innovation is news: it has nothing in common with the one before (so all 9600 count, and the band
# is narrow). A filter that thinks too well of its motor (Q / 100) is surprised again and again, to
# the same side: innovations tell, without any truth.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Consistency: does P tell the truth?
#
# Look at `run` again: P is computed from F, Q, H and R. **No measurement enters it.** The filter
# would believe in its P if every measurement were nonsense. So somebody else has to ask whether P
# is true.
#
# The thesis defines: an estimate is **consistent** with P when
#
# $$P - E[\tilde x\,\tilde x^{\mathsf T}] \succeq 0$$
#
# (no eigenvalue below zero): in no direction is the error larger, on average, than P says. Its
# number is NEES = x̃ᵀ P⁻¹ x̃: 2 on average for two states, when P is exactly right.


# %% slideshow={"slide_type": "fragment"}
def errors_of(Q):
    """Errors (200, 60, 2) of the filter on 200 drives, and P (60, 2, 2), common to all."""
    found = [(run(zs, Q), truth) for truth, zs in DRIVES]
    return np.array([truth - xs for (xs, *_), truth in found]), found[0][0][1]


# %% [markdown] slideshow={"slide_type": "fragment"}
# **Predict:** a filter believes that σ of the slip is half of what it is. Where does its average
# NEES go? And if it believes in twice as much?


# %% slideshow={"slide_type": "fragment"}
def nees_chart(believed_slip):
    low, high = band(size=2, runs=200)
    shown = {}
    for name, share in {"slip as it is": 1.0, f"slip × {believed_slip:.2f}": believed_slip}.items():
        found, P = errors_of(share**2 * Q)
        shown[name] = nees(found, P).mean(axis=0)
    fig, ax = views.curves(seconds, shown, "time [s]", "NEES, mean of 200 drives [1]")
    views.band(ax, low, high, "95 % band")
    ax.set_ylim(0, 8)
    views.legend(ax, loc="upper left")
    return fig


views.explore(
    nees_chart,
    "NEES of the right filter stays in its band; of one too sure it is above, too modest below.",
    believed_slip=(0.1, 3.0, 0.5),
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# **See:** the right filter stays in the band round 2 (now and then out: it is a 95 % band). The one
# that believes in half the slip leaves it within seconds: its ellipses are too small, most of all
# until 18 s, while nothing is measured and it has nothing but its trust in the motor. Too *much*
# slip brings NEES below the band: consistent by the definition, but it throws knowledge away.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Students like small ellipses. Ask which of the two wrong filters they would
# take on board: the modest one is merely slow to learn; the proud one will one day reject a right
# measurement, or drive into a wall it believes to be elsewhere.

# %% [markdown] slideshow={"slide_type": "fragment"}
# And the definition itself, at the last step: the largest mean square of an error in units of its
# variance, over all directions. It should be at most 1, but for chance:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
for name, share in {"slip / 2": 1 / 2, "as it is": 1, "slip × 2": 2}.items():
    found, P = errors_of(share**2 * Q)
    result = consistency(found[:, -1], np.broadcast_to(P[-1], (200, 2, 2)))
    verdict = "refuted" if result.refuted else "nothing against it"
    print(f"{name:9} largest {result.largest:.2f}, limit {result.limit:.2f}: {verdict}")

# %% [markdown] slideshow={"slide_type": "slide"}
# ## "If and only if": a claim to test
#
# Thesis, 2.6: the filter with P⁺ = P − K S Kᵀ is consistent *if and only if* K = S_xv S⁻¹. We have
# seen the curves over α. **Predict:** is it true that every other gain is inconsistent?
#
# Claimed minus true covariance for K = α S_xv S⁻¹, by machine:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
alpha = sp.symbols("α", real=True)
K_alpha = alpha * by_formula
claimed = P2 - K_alpha * S2 * K_alpha.T
rest2 = sp.eye(2) - K_alpha * H2
really = rest2 * P2 * rest2.T + K_alpha * R2 * K_alpha.T
gap = (claimed - really).applyfunc(sp.factor)
gap

# %% [markdown] slideshow={"slide_type": "fragment"}
# That is 2α(1 − α) K S Kᵀ with the best K: a factor times a square. By eigenvalues, for the streak:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
learned = K_best @ S_streak @ K_best.T
for share in (-0.1, 0.0, 0.25, 0.5, 0.75, 1.0, 1.1):
    values = np.linalg.eigvalsh(2 * share * (1 - share) * learned)
    word = "consistent" if values.min() > -1e-12 else "not consistent"
    print(f"α = {share:5.2f}: eigenvalues {values.round(3) + 0.0}  {word}")

# %% [markdown] slideshow={"slide_type": "fragment"}
# Every gain with 0 ≤ α ≤ 1 is consistent: the thesis' condition is sufficient, not necessary. Its
# 2.4 has one more, "E[x̃ᵀx̃] equals P":

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
mean_square = np.mean(np.sum(errors**2, axis=1))
print(
    f"E[x̃ᵀx̃] = {mean_square:.2f}, one number; P has shape {P_streak.shape}; "
    f"trace P = {np.trace(P_streak):.2f}"
)

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Was anything lost on the way?
#
# The filter looks at each measurement once and throws it away. Somebody patient keeps all of them
# and solves, at the end, for all states at once: the states for which the weighted squares of
# *everything* (start, slips, measurements) are least.
#
# **Predict:** by how much does the patient one know the last position better?


# %% slideshow={"slide_type": "fragment"}
def batch(zs):
    """All states of a drive by one weighted least squares problem: last state and its P."""
    size, rows, right = 2 * (len(zs) + 1), [], []

    def equation(blocks, value, covariance):
        """Σ block · state = value, with an error of that covariance: whitened by its root."""
        white = np.linalg.inv(np.linalg.cholesky(covariance))
        row = np.zeros((len(value), size))
        for step, block in blocks.items():
            row[:, 2 * step : 2 * step + 2] = block
        rows.append(white @ row)
        right.append(white @ value)

    equation({0: np.eye(2)}, x_start, P_start)
    for step, (u, z) in enumerate(zip(pushes, zs, strict=True)):
        equation({step: -F, step + 1: np.eye(2)}, G @ u, Q)
        if np.isfinite(z).all():
            equation({step + 1: H}, z, R)
    A, y = np.vstack(rows), np.concatenate(right)
    states = np.linalg.lstsq(A, y, rcond=None)[0]
    return states[-2:], np.linalg.inv(A.T @ A)[-2:, -2:]


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
x_batch, P_batch = batch(zs)
print("filter", xs[-1].round(6), " least squares", x_batch.round(6))
print("apart by less than 1e-11:", bool(abs(xs[-1] - x_batch).max() < 1e-11))
print("P apart by less than 1e-12:", bool(abs(Ps[-1] - P_batch).max() < 1e-12))

# %% [markdown] slideshow={"slide_type": "fragment"}
# Nothing was lost: the belief (x, P) holds *everything* the past has to say about now. The filter
# is least squares, done step by step, with five numbers of memory: two of x, three of P. (The
# patient one does know the *earlier* states better: it saw what came after. Lesson 15 comes back to
# that.)

# %% [markdown] slideshow={"slide_type": "slide"}
# ## The tools of the trade
#
# Two ready-made filters on the same drive: `filterpy`, which many robots use, and the course's own
# `slamlab.filters.linear_kalman`. **Predict** in how many digits they agree with ours.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
from filterpy.kalman import KalmanFilter

from slamlab.filters import linear_kalman

theirs, ours = KalmanFilter(dim_x=2, dim_z=1), linear_kalman.belief(x_start, P_start)
theirs.x, theirs.P, theirs.F, theirs.B = x_start, P_start, F, G
theirs.Q, theirs.H, theirs.R = Q, H, R
for u, z in zip(pushes, zs, strict=True):
    theirs.predict(u)
    ours = linear_kalman.predict(ours, F, Q, G, u)
    if np.isfinite(z).all():
        theirs.update(z)
        ours, step = linear_kalman.update(ours, z, H, R)
print("filterpy:", abs(theirs.x - xs[-1]).max().round(12), abs(theirs.P - Ps[-1]).max().round(12))
print("slamlab: ", abs(ours.x - xs[-1]).max().round(12), abs(ours.P - Ps[-1]).max().round(12))

# %% [markdown] slideshow={"slide_type": "fragment"}
# Both use Joseph's form. Why, if the gain is the best one?
#
# **Predict:** a state known to a kilometre is measured to a millimetre. What may a computer with 16
# digits make of P − K S Kᵀ, and what if the sensor is better still?

# %% slideshow={"slide_type": "fragment"}
ROUND = np.random.default_rng(6)
BOTH = np.array([[1.0, 0.7], [0.2, 1.0]])  # a sensor that sees both states, mixed


def three_forms(sensor_sigma):
    """Least eigenvalue after one update, by each of three forms, all exact on paper."""
    root, R = ROUND.normal(0, 1000, (2, 2)), sensor_sigma**2 * np.eye(2)
    P = root @ root.T
    S = BOTH @ P @ BOTH.T + R
    K = P @ BOTH.T @ np.linalg.inv(S)
    rest = np.eye(2) - K @ BOTH
    forms = P - K @ S @ K.T, rest @ P, rest @ P @ rest.T + K @ R @ K.T
    return [np.linalg.eigvalsh((form + form.T) / 2)[0] for form in forms]


# %% slideshow={"slide_type": "fragment"}
print("negative:   P − K S Kᵀ   (I − K H) P   Joseph")
for sensor in (1, 1e-3, 1e-5):
    share = np.mean([np.array(three_forms(sensor)) < 0 for _ in range(1000)], axis=0)
    print(f"{sensor:6g} m   " + "".join(f"{value:10.0%}" for value in share))

# %% [markdown] slideshow={"slide_type": "fragment"}
# Where something large loses nearly all of itself, P − K S Kᵀ is a difference of two large, nearly
# equal numbers, and what is left is rounding: a covariance with a negative variance. Joseph's form
# adds two squares and cannot. With everyday numbers (first row) all three agree: Joseph's form is
# an insurance, and it costs a few products more.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## What you can do now
#
# Derive prediction, innovation and gain by one recipe; write the filter; and ask the right question
# of any filter: is P true?
#
# What we needed: motion and measurement are *linear*. A robot that turns is not. **Next:** lesson
# [04 · Models and Jacobians](04_models_and_jacobians.ipynb) makes real models straight, near
# where the robot is.
#
# **Exercise:** [write the filter, piece by piece](../exercises/ex03_kalman_filter.ipynb), and have it
# judged by what it promises: least squares, and errors that P foretold.
