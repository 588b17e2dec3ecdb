# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# # 08 · Landmarks from scans
#
# **You will be able to** find walls and corners in a lidar scan, say how sure they are, measure how
# many are missed and how many invented, and decide which of them the robot has seen before.
#
# **75 minutes**, with a break after the first 45. **Before:** lessons
# [04](04_models_and_jacobians.ipynb) (models and their Jacobians) and [06](06_ekf_slam.ipynb) (the
# filter that will use what we find here).
#
# *Key:* a scan holds no landmarks. It holds ranges, and we have to decide which thing each of them
# belongs to.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* The lesson answers three questions. Which line fits these points? Which points
# are of one wall? Which wall of the map is it? If you have one lecture only, take the two sections on
# RANSAC, the foot of the perpendicular, and the two walls between which Pythagoras chooses. For a
# poll: the questions on the vertical wall, on the far wall, on the foot, and on walls A and B.

# %% slideshow={"slide_type": "skip"} tags=["folded"]
from dataclasses import replace

import numpy as np
import sympy as sp

from slamlab import models, views, worlds
from slamlab.checks import ask
from slamlab.derivation import derive, differentiate, partials
from slamlab.evaluation import nees
from slamlab.filters import MAK
from slamlab.filters.data_association import nearest_neighbours
from slamlab.filters.landmark_models import LINES
from slamlab.geometry import wrap
from slamlab.landmarks.corners import corners
from slamlab.landmarks.line_fitting import Cloud, cloud, fit, total_least_squares
from slamlab.landmarks.ransac import THESIS, Ransac, lines
from slamlab.landmarks.sampled_lines import ordinary_least_squares
from slamlab.landmarks.spikes import spikes
from slamlab.layers import Ellipses, Points, Poses, Segments
from slamlab.models import jacobians, symbolic
from slamlab.readings import Scan
from slamlab.sources.simulated_robot import THESIS_LIDAR as LIDAR  # 400 beams, 1 % noise
from slamlab.studies import found_walls, walls_on_trial
from slamlab.worlds import World

HOME = np.zeros(3)
ROBOT = Poses("robot", [HOME])


# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## What a landmark must be
#
# So far somebody told the filter: "this is landmark 7, at 2.31 m and 14°". A lidar says nothing of the
# kind. It turns once and returns 400 ranges.
#
# To drive through a building, the robot has to find landmarks in these ranges by itself. A good
# landmark is seen *again* from other places, can be *told apart* from others, and *stands still*. And
# there should be *many* of them.

# %% slideshow={"slide_type": "subslide"} tags=["folded"]
rng = np.random.default_rng(8)
legs, rooms = worlds.table_legs(), worlds.situation_1()
turns = {world.name: LIDAR.scan(world, HOME, rng) for world in (legs, rooms)}
shown = {
    w.name: [Segments("walls", w.outline()), Points("scan", turns[w.name].points()), ROBOT]
    for w in (legs, rooms)
}
fig, _ = views.side_by_side(shown, size=(10, 5), shared=False)
views.show(fig, "Left, readings that stand alone before the walls; right, nothing but lines.")

# %% [markdown] slideshow={"slide_type": "fragment"}
# In the left room, some readings stand alone in front of the walls: these are table legs. On the
# right there is nothing but lines. A single reading on a wall is never seen again, since from the
# next place the beams fall beside it; the *wall* is seen again. People walk about, and one table
# leg looks like another. So this lesson looks for walls and for the corners where they meet. But
# first, briefly, the legs.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Spikes
#
# Smolec's thesis on wall SLAM begins with the simplest extractor. Walk along the scan, from beam to
# beam. Where the range falls by more than a threshold, and soon rises again by as much, something
# narrow stands in front of the background.
#
# The left room has 20 legs. Below is the range over the bearing. Change the threshold, and the number
# of beams in a turn: can you find all 20, and none where there is no leg?


# %% slideshow={"slide_type": "subslide"} tags=["folded"]
def spikes_in(world, jump=0.5, beams=400):
    scan = replace(LIDAR, beams=beams).scan(world, HOME, np.random.default_rng(8))
    return scan, spikes(scan, jump=jump).z


def spiked(jump, beams):
    fig, both = views.panels([None, None], size=(11, 4.2), shared=False)
    for ax, world in zip(both, (legs, rooms), strict=True):
        scan, z = spikes_in(world, jump, beams)
        ax.plot(np.degrees(scan.angles), scan.ranges, ".", color=views.COLOURS["scan"], ms=3)
        ax.plot(*(z[:, ::-1] * [180 / np.pi, 1]).T, "v", color=views.COLOURS["landmark"], ms=8)
        words = {"title": f"{world.name}: {len(z)} spikes", "xlabel": "bearing [°]"}
        ax.set(aspect="auto", ylabel="range [m]", ylim=(0, None), **words)
    return fig


# %% slideshow={"slide_type": "fragment"}
views.explore(
    spiked,
    lambda jump, beams: (
        f"Range over bearing with {beams} beams: short dips deeper than {jump:.2f} m are marked by "
        "triangles, many in the room with legs."
    ),
    jump=(0.05, 2.0, 0.5),
    beams=[400, 100, 200, 800],
)
counted = {key: len(spikes_in(legs, beams=key)[1]) for key in (400, 100)}
in_rooms = {jump: len(spikes_in(rooms, jump)[1]) for jump in (0.5, 0.05)}

# %% [markdown] slideshow={"slide_type": "subslide"}
# With 400 beams and a threshold of 0.5 m, {= counted[400] =} of the 20 legs are marked, and in the
# rooms {= in_rooms[0.5] =} spikes. A leg that no beam meets is missed, and so is a leg that another
# one hides. In a sparse scan of 100 beams {= counted[100] =} legs are left. A lower threshold does
# not help: at 0.05 m, noise makes dips of its own, {= in_rooms[0.05] =} of them in rooms without a
# single leg.
#
# And the legs that are found all look alike. To tell them apart we would have to know where we are.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask how one could tell the legs apart when the robot has moved on. The filter
# can, since it expects each of them somewhere; that is association, which comes at the end.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## Fitting a wall the way school does it
#
# We begin with the easiest case: somebody hands us readings that all belong to one wall. Which line is
# it? Smolec fits the line as school teaches it,
#
# $$y = m\,x + c, \tag{08.1}$$
#
# with the slope $m$ and the intercept $c$ that make the sum of the squared errors of $y$ least.

# %% slideshow={"slide_type": "fragment"}
ask(
    "08-school",
    "A wall straight ahead runs along the map's y axis, at x = 2 m. It gives 60 readings, each 2 cm off. "
    "What line does (08.1) fit to them?",
    {
        "nearly the wall: 60 readings average the noise out": "they would, if the errors stood in y. But "
        "they stand in x, and (08.1) takes every x for exact.",
        "a line across the wall": "x is 2 m and a little noise, and from that noise it has to tell y. "
        "The slope is an accident.",
        "none: it divides by zero": "it would, if all x were equal. Noise sees to it that they are not, so "
        "there is an answer, and it is wrong.",
    },
    right="a line across the wall",
)

# %% slideshow={"slide_type": "fragment"}
FITS = {"least distances": total_least_squares, "y = m x + c": ordinary_least_squares}


def wall_points(normal, rng, noise=0.02, rho=2.0, n=60):
    """Points of a wall whose normal points in a direction, each off by noise across it."""
    across, way = rho + noise * rng.standard_normal(n), rng.uniform(-1, 1, n)
    c, s = np.cos(normal), np.sin(normal)
    return np.column_stack([across * c - way * s, across * s + way * c])


# %% slideshow={"slide_type": "subslide"} answers="08-school" tags=["folded"]
def draw_all(ax, layers, **styles):
    """Draw layers by their labels; a style's name is the label's first word."""
    for label, layer in layers.items():
        views.draw(ax, layer, label=label, **styles.get(label.split()[0].strip(","), {}))


def along(rho, alpha, low=-1.3, high=1.3):
    """A piece of a line, as a row x1 y1 x2 y2."""
    c, s = np.cos(alpha), np.sin(alpha)
    return [[rho * c - low * s, rho * s + low * c, rho * c - high * s, rho * s + high * c]]


# %% slideshow={"slide_type": "fragment"} answers="08-school" tags=["folded"]
def turned_wall(normal, noise):
    points = wall_points(np.radians(normal), np.random.default_rng(1), noise)
    least, school = (along(*find(points)) for find in FITS.values())
    fig, ax = views.axes(f"a wall whose normal points to {normal:.0f}°", size=(8, 5.4))
    layers = {
        "readings": Points("scan", points),
        "robot": ROBOT,
        "y = m x + c": Segments("naive", school),
        "least distances": Segments("corrected", least),
    }
    draw_all(ax, layers, readings={"markersize": 6}, y={"lw": 2, "ls": "--"}, least={"lw": 2})
    ax.set(aspect="equal", adjustable="box", xlim=(-0.6, 3.6), ylim=(-1.5, 3.2))
    views.legend(ax, loc="upper right")
    return fig


views.explore(
    turned_wall,
    lambda normal, noise: (
        f"A wall with its normal at {normal:.0f}° and noise of {100 * noise:.0f} cm: the line of least "
        "distances follows it; that of y = m x + c turns away from it as the normal nears the x axis."
    ),
    normal=(0.0, 90.0, 0.0),
    noise=(0.0, 0.1, 0.02),
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="08-school"
# The dashed line cuts across the wall. On the map the wall is *vertical*, so $y$ is no function of
# $x$: least squares explains two metres of $y$ by two centimetres of noise in $x$. Turn the wall, and
# see where the two lines begin to agree. Then take the noise away.
#
# The solid line is what we are going to derive. Here is how far both are off on average, for walls of
# every direction:

# %% slideshow={"slide_type": "subslide"} tags=["folded", "nbval-check-output"] answers="08-school"
directions, off = np.radians(np.arange(0, 181, 3)), {}
for name, find in FITS.items():
    rng = np.random.default_rng(2)
    each = [
        [wrap(find(wall_points(alpha, rng))[1] - alpha) for _ in range(20)] for alpha in directions
    ]
    off[name] = np.degrees(np.abs(each).mean(axis=1))
fig, ax = views.curves(
    np.degrees(directions), off, "direction of the wall's normal [°]", "mean error [°]", size=(9, 4)
)
ax.set(yscale="log", xticks=range(0, 181, 30))
least, school = off.values()
views.show(
    fig,
    f"The error of y = m x + c rises to {school.max():.0f}° at both ends; that of least distances is "
    f"{least.mean():.1f}° in all directions.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="08-school"
# The scale is logarithmic. The line of least distances is off by {= least.mean():.1f =}° whatever the
# direction. That of (08.1) is as good for walls to the robot's side, at 90°, and off by
# {= school.max():.0f =}° for a wall straight ahead.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Somebody will propose to exchange x and y where the slope is large. It works,
# but the error still depends on the direction, and it jumps where one changes over.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## A line that may have any direction
#
# The slope is what fails: a vertical line has none. So we describe a wall by numbers that every
# line has. Its **normal** points from the origin straight at the line, in the direction $\alpha$,
# and $\rho$ is the distance from the origin to the line. The line is then all points
# $p = (p_x, p_y)$ with
#
# $$p_x \cos\alpha + p_y \sin\alpha = \rho. \tag{08.2}$$
#
# The left side is how far $p$ lies along the normal. So the signed distance of *any* point from the
# line is the difference of the two sides:
#
# $$e = p_x \cos\alpha + p_y \sin\alpha - \rho. \tag{08.3}$$
#
# We look for the line for which the mean of $e^2$ over all readings is least. Try it by hand first.


# %% slideshow={"slide_type": "subslide"} tags=["folded"]
SOME = wall_points(np.radians(40), np.random.default_rng(3), noise=0.12, n=25)


def by_hand(alpha, rho):
    alpha = np.radians(alpha)
    normal = np.array([np.cos(alpha), np.sin(alpha)])
    e = SOME @ normal - rho
    fig, ax = views.axes(f"mean of e²: {1e4 * np.mean(e**2):.0f} cm²", (8, 5.4))
    layers = {
        "your line": Segments("corrected", along(rho, alpha, -2, 2)),
        "e": Segments("naive", np.hstack([SOME, SOME - np.outer(e, normal)])),
        "readings": Points("scan", SOME),
    }
    draw_all(ax, layers, readings={"markersize": 8}, e={"lw": 1})
    ax.set(aspect="equal", adjustable="box", xlim=(-0.5, 3.5), ylim=(-0.5, 3))
    views.legend(ax)
    return fig


# %% slideshow={"slide_type": "fragment"}
views.explore(
    by_hand,
    lambda alpha, rho: (
        f"Your line at {alpha:.0f}° and {rho:.2f} m, and the distance of each reading from it."
    ),
    alpha=(0.0, 180.0, 75.0),
    rho=(0.0, 3.0, 2.0),
)
least_rho, least_alpha = total_least_squares(SOME)
least_e = SOME @ [np.cos(least_alpha), np.sin(least_alpha)] - least_rho

# %% [markdown] slideshow={"slide_type": "fragment"}
# You have two numbers to choose, and one to make small. The best line there is has a mean of
# {= 1e4 * np.mean(least_e**2):.0f =} cm². How near do you get?

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### First the distance
#
# Let $\bar p$ be the centroid of the readings, and $\sigma_x^2$, $\sigma_{xy}$, $\sigma_y^2$ their
# variances and covariance about it. These are all that the mean of $e^2$ depends on, since a mean
# of squares is the variance plus the square of the mean:
#
# $$\overline{e^2} = \sigma_x^2 \cos^2\alpha + 2 \sigma_{xy} \sin\alpha\cos\alpha + \sigma_y^2 \sin^2\alpha
# + \left( \bar p_x \cos\alpha + \bar p_y \sin\alpha - \rho \right)^2. \tag{08.4}$$
#
# Only the last term depends on $\rho$. It is a square, and we can make it zero:
#
# $$\rho = \bar p_x \cos\alpha + \bar p_y \sin\alpha. \tag{08.5}$$
#
# By (08.2) that says: whatever its direction, **the best line goes through the centroid**.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Then the direction
#
# What is left of (08.4) depends on $\alpha$ alone. Written with the double angle it is one simple wave, which
# the machine confirms:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
alpha, rho = sp.symbols("alpha rho", real=True)
s_xx, s_yy, s_xy = sp.symbols("sigma_x^2 sigma_y^2 sigma_xy", real=True)
left_over = (
    s_xx * sp.cos(alpha) ** 2 + 2 * s_xy * sp.sin(alpha) * sp.cos(alpha) + s_yy * sp.sin(alpha) ** 2
)
wave = (s_xx + s_yy) / 2 + (s_xx - s_yy) / 2 * sp.cos(2 * alpha) + s_xy * sp.sin(2 * alpha)
derive("e^2", left_over, "(08.4) with (08.5)").step("the double angle", wave)

# %% [markdown] slideshow={"slide_type": "subslide"}
# The last two terms are the scalar product of $(\cos 2\alpha, \sin 2\alpha)$ with the vector
# $\left( \tfrac12 (\sigma_x^2 - \sigma_y^2),\, \sigma_{xy} \right)$. A scalar product with a unit vector is least
# where that points *against* the other vector:
#
# $$\alpha = \tfrac12 \operatorname{atan2}\left( -2\sigma_{xy},\; \sigma_y^2 - \sigma_x^2 \right). \tag{08.6}$$
#
# Here is the wave for the readings above, and where the package puts its line:

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Three things usually go wrong, in this order: the centroid is not subtracted;
# the crest is taken for the trough, so the line runs across the wall; $\rho$ comes out negative.
# The exercise has a hint for each. Students who know principal components will recognise them here.

# %% slideshow={"slide_type": "subslide"} tags=["folded", "nbval-check-output"]
every = np.arange(0, 180.01, 0.05)
along_normal = SOME @ [np.cos(np.radians(every)), np.sin(np.radians(every))]
cost = along_normal.var(axis=0)  # about its mean: of the lines through the centroid
lowest, found_alpha = every[cost.argmin()], np.degrees(total_least_squares(SOME)[1])
fig, ax = views.chart("α [°]", "mean of e² [cm²]", size=(9, 3.6))
ax.plot(every, 1e4 * cost, color=views.COLOURS["truth"], label="lines through the centroid")
ax.axvline(found_alpha, color=views.COLOURS["corrected"], label="total_least_squares")
ax.set(xticks=range(0, 181, 30))
views.legend(ax, loc="upper left")
views.show(
    fig, f"A wave with one trough in half a turn; the package's line is in it, at {lowest:.1f}°."
)
print(f"lowest point {lowest:.2f}°, the package {found_alpha:.2f}°")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The line stands in the trough. The crest is 90° away: there it would run across the wall. If
# $\rho$ comes out negative, turn the normal round by 180°, and $\rho$ becomes positive.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## How sure is that line?
#
# (08.6) treats all readings alike. But they differ: a lidar errs *along its beam*, by 1 % of the range. A reading
# at range $r$ and bearing $\beta$ has the distance
#
# $$e = r \cos(\beta - \alpha) - \rho \tag{08.7}$$
#
# from the line, by (08.3) with $p = r\,(\cos\beta, \sin\beta)$. So an error of the range counts with the factor
# $\cos(\beta - \alpha)$. Where the beam meets the wall straight on, all of it counts; where it grazes the wall,
# almost none, for the point then slides along its wall.
#
# The fit weighs each reading by $1/\sigma_i^2$, with $\sigma_i$ the noise across the line. To know how sure the
# result is, we also need how $e$ changes with the line.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
t, p_x, p_y = sp.symbols("t p_x p_y", real=True)
c, s = sp.cos(alpha), sp.sin(alpha)
e = sp.Matrix([p_x * c + p_y * s - rho])
(
    derive("J_i", partials(e, sp.Matrix([rho, alpha])), "∂e by the line's two numbers")
    .step("differentiate (08.3)", differentiate())
    .step(
        "a point on the line, t along it",
        sp.Matrix([[-1, t]]),
        given={p_x: rho * c - t * s, p_y: rho * s + t * c},
    )
)

# %% [markdown] slideshow={"slide_type": "fragment"}
# Here $t$ says where along the wall the point lies, counted from the foot of the normal. The
# farther out a point lies, the more it says about the direction. Information adds up, reading by
# reading (03.4), and the covariance is its inverse:
#
# $$R = \Big( \sum_i J_i^{\mathsf T} J_i / \sigma_i^2 \Big)^{-1}, \qquad J_i = [\,-1\;\; t_i\,]. \tag{08.8}$$

# %% slideshow={"slide_type": "subslide"}
ask(
    "08-streak",
    "You look along a corridor: one wall, seen far to your left only. This time the fit puts it too far "
    "away. What do you know about the error of its direction?",
    {
        "nothing: distance and direction are two different things": "they are, but both come out of the "
        "same readings, all of which lie to one side.",
        "it is wrong, too, and to a side that you can name": "the line goes through the seen piece. If it "
        "passes you too far away, it must be turned.",
        "it is wrong, too, to either side alike": "then the line would miss the seen piece, which it fits "
        "best of all.",
    },
    right="it is wrong, too, and to a side that you can name",
)


# %% slideshow={"slide_type": "fragment"} answers="08-streak"
def fits_of(first, last, count=400, truth=(3.0, 0.4), n=90):
    """Errors of fits (count, 2) to one wall, seen between two angles from its normal; their R."""
    rng, sensor = np.random.default_rng(4), replace(LIDAR.model, bearing_sigma=0.0)
    slant, clouds = np.radians(np.linspace(first, last, n)), []
    for _ in range(count):
        r = truth[0] / np.cos(slant) * (1 + sensor.range_error * rng.standard_normal(n))
        clouds.append(cloud(Scan(slant + truth[1], r), sensor, floor=1e-6))
    z, R = zip(*(fit(each, np.arange(n)) for each in clouds), strict=True)
    return np.array(z) - truth, np.array(R), clouds


# %% slideshow={"slide_type": "subslide"} answers="08-streak" tags=["folded"]
def streak(from_angle, to_angle):
    errors, R, _ = fits_of(from_angle, max(to_angle, from_angle + 5))
    R = 1e6 * R.mean(axis=0)
    fig, ax = views.chart("error of ρ [mm]", "error of α [mrad]", "400 fits of one wall", (8, 5))
    layers = {
        "fits": Points("scan", 1000 * errors),
        "R, 95 %": Ellipses("corrected", [[0, 0]], [R]),
        "its diagonal alone": Ellipses("naive", [[0, 0]], [np.diag(np.diag(R))]),
    }
    draw_all(ax, layers, R={"lw": 2}, its={"lw": 2, "linestyle": "dashed"})
    views.legend(ax, loc="upper left")
    return fig


views.explore(
    streak,
    lambda from_angle, to_angle: (
        f"A wall seen from {from_angle:.0f}° to {to_angle:.0f}° of its normal: the errors of distance and "
        "direction fill the ellipse of R, which is the more slanted the farther to one side it is seen."
    ),
    from_angle=(-60.0, 40.0, -17.0),
    to_angle=(-10.0, 65.0, 63.0),
)
errors, R_each, clouds = fits_of(-17, 63, count=1000)
sizes = nees(errors, R_each)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="08-streak"
# The errors form a slanted streak, and the ellipse of (08.8) lies on it. Their correlation is
# {= np.corrcoef(errors.T)[0, 1]:.2f =}: turn the line a little about the piece of wall that was
# seen, and its distance from the robot changes as well. If we kept only the diagonal of $R$, we
# would throw that away. Move the two angles until the wall is seen evenly to both sides, and the
# streak stands upright.
#
# Is $R$ honest? In units of $R$, the squared errors of {= len(sizes) =} fits are {= sizes.mean():.2f =} on average,
# where 2 is right.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=7
# ## Whose readings are they?
#
# To fit a wall we need its readings. To know its readings we need the wall. How do we get out of that circle?
#
# By guessing. **Guess** a line from a few neighbouring readings. **Count** how many agree with it.
# If enough do, **refit** the line to those that agree, and keep it. Many readings confirm a good
# guess, and few a bad one. This is *random sample consensus*, RANSAC.
#
# Smolec guesses from 25 neighbours, and keeps the line if at least 21 of them lie within 15 mm of it.

# %% slideshow={"slide_type": "subslide"}
ask(
    "08-far",
    "A wall is 4 m away, and 25 neighbouring readings are all of it. The lidar errs by 1 % of the range. How "
    "often do 21 of them lie within 15 mm of their line?",
    {
        "nearly always: they are all of one wall": "they are, but at 4 m each of them errs by 40 mm.",
        "in about half of all cases": "21 of 25 is a lot to ask for, when a reading is within the band less "
        "often than not.",
        "almost never": "the noise is 40 mm there, and the band 15 mm: a reading is within it less often "
        "than not.",
    },
    right="almost never",
)


# %% slideshow={"slide_type": "fragment"}
def guess(points, middle, window):
    """A line through the readings round one of them; neighbours wrap round the turn."""
    rows = (middle + np.arange(window) - window // 2) % len(points)
    return rows, total_least_squares(points[rows])


def across(points, line):
    """How far points are off a line [m]."""
    return points @ [np.cos(line[1]), np.sin(line[1])] - line[0]


# %% slideshow={"slide_type": "subslide"} answers="08-far" tags=["folded"]
def try_guess(reading, band_mm, window):
    points = turns[rooms.name].points()
    rows, line = guess(points, reading, window)
    agree = rows[np.abs(across(points[rows], line)) <= band_mm / 1000]
    verdict = "a wall" if len(agree) >= window - 4 else "no wall"
    titles = [f"reading {reading}", f"{len(agree)} of {window} agree: {verdict}"]
    fig, (whole, near) = views.panels(titles, (11, 5.2), shared=False)
    t = points[rows] @ [-np.sin(line[1]), np.cos(line[1])]
    layers = {
        "other readings": Points("before", points),
        "in the window": Points("scan", points[rows]),
        "agree": Points("corrected", points[agree]),
        "guessed line": Segments("truth", along(*line, t.min() - 0.3, t.max() + 0.3)),
    }
    for ax in (whole, near):
        draw_all(ax, layers, agree={"markersize": 7})
        ax.set(aspect="equal", adjustable="box")
    middle = points[rows].mean(axis=0)
    half = max(0.4, 0.7 * np.ptp(points[rows], axis=0).max())
    near.set(xlim=middle[0] + [-half, half], ylim=middle[1] + [-half, half])
    views.legend_below(fig)
    return fig


# %% slideshow={"slide_type": "fragment"} answers="08-far"
views.explore(
    try_guess,
    lambda reading, band_mm, window: (
        f"The line guessed from {window} readings round reading {reading}, in the scan and enlarged, and the "
        f"readings within {band_mm} mm of it."
    ),
    reading=(0, len(turns[rooms.name].points()) - 1, 200),
    band_mm=(5, 150, 15),
    window=(5, 41, 25),
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="08-far"
# All 25 readings are of one wall, 3 m away, and yet the verdict is "no wall". Move on along the scan. Round a
# corner the line cuts the corner off; in a doorway the window holds two walls. There RANSAC refuses, as it
# should. But it refuses honest walls, too, unless they are near.
#
# Widen the band until the first wall passes, and then go back to the doorway. What passes now?

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Have them find three refusals of different kinds: a corner, a door (two walls
# in one window), a far wall. The first two refusals are right; the third is the subject of the next
# slide.


# %% slideshow={"slide_type": "subslide"} tags=["folded", "nbval-check-output"] answers="08-far"
def pass_share(distance, window, needed, band=None, tries=600):
    """Share of windows that pass, all readings of one wall straight ahead; no band: 2.8 σ."""
    rng, passed = np.random.default_rng(5), 0
    angles = np.radians(0.9) * (np.arange(window) - window // 2)
    for _ in range(tries):
        r = distance / np.cos(angles) * (1 + LIDAR.range_error * rng.standard_normal(window))
        points = np.column_stack([r * np.cos(angles), r * np.sin(angles)])
        limit = band or 2.8 * LIDAR.range_error * r
        passed += np.sum(np.abs(across(points, total_least_squares(points))) <= limit) >= needed
    return passed / tries


reach = np.arange(0.4, 4.1, 0.2)
fixed = np.array([pass_share(d, 25, 21, 0.015) for d in reach])
growing = np.array([pass_share(d, 9, 8) for d in reach])
shares = {"8 of 9 within 2.8 σ": growing, "21 of 25 within 15 mm": fixed}
fig, ax = views.curves(
    reach, shares, "distance of the wall [m]", "share that passes", size=(9, 3.6)
)
views.show(
    fig,
    f"In a fixed band all windows pass at {reach[0]:.1f} m, {100 * fixed[reach.searchsorted(1.2)]:.0f} % at "
    f"{reach[reach.searchsorted(1.2)]:.1f} m, none from {reach[fixed == 0][0]:.1f} m on; in a band that "
    f"grows with the noise at least {100 * growing.min():.1f} % pass everywhere.",
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="08-far"
# The noise grows with the range, and the band does not. At 1 m one $\sigma$ is 10 mm, at 4 m it is 40 mm. No
# window passes beyond {= reach[fixed > 0][-1]:.1f =} m. So we measure the band in $\sigma$ of each reading. With 2.8 of
# them, {= 100 * growing.min():.1f =} % of the windows pass even at the worst distance. That is the default of the
# package, and Smolec's numbers are its preset `THESIS`.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Refit and grow
#
# A guess from nine readings may find a wall, but it hardly knows its direction. The wall goes on beyond the
# window. So the package refits and **grows**: it takes in each further reading that agrees, refits, and goes on
# until the wall ends. How much does that help?

# %% slideshow={"slide_type": "fragment"}
ask(
    "08-length",
    "A wall has grown from a piece of 9 readings to one four times as long, with four times as many. By which "
    "factor has $\\sigma$ of its direction $\\alpha$ fallen?",
    {
        "2: four times the readings": "that is the mean of more readings. But they also reach farther out.",
        "4: four times the length": "a lever four times as long. But there are also more readings on it.",
        "8: both together": "length counts in full, and the number of readings by its root.",
    },
    right="8: both together",
)


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="08-length"
def sigma_alpha(n):
    """σ of α of n neighbouring readings of a wall 2 m straight ahead [°]."""
    slant = np.radians(0.9) * (np.arange(n) - n // 2)
    R = fit(cloud(Scan(slant, 2 / np.cos(slant)), LIDAR.model), np.arange(n))[1]
    return np.degrees(np.sqrt(R[1, 1]))


for n in (9, 18, 36, 72):
    print(f"{n:2} readings: σ of α {sigma_alpha(n):.2f}°")

# %% [markdown] slideshow={"slide_type": "subslide"} answers="08-length"
# From 9 readings to 36, $\sigma$ falls {= sigma_alpha(9) / sigma_alpha(36):.1f =} times. (08.8) says why: the
# information about $\alpha$ is a sum of $t_i^2$, and both the number of its terms and their size grow. The scan
# of the rooms, taken apart with and without growing:

# %% slideshow={"slide_type": "fragment"} answers="08-length" tags=["folded"]
scan, found = turns[rooms.name], {}
for name, grow in {"windows of 9 readings": False, "grown": True}.items():
    found[name] = lines(scan, LIDAR.model, np.random.default_rng(1), Ransac(grow=grow))
fig, both = views.panels(list(found), size=(11, 5))
for ax, some in zip(both, found.values(), strict=True):
    views.draw(ax, Points("scan", scan.points()))
    for line, (colour, *_) in zip(some, views.SERIES * 20, strict=False):
        views.draw(ax, Segments("line", [line.ends.ravel()]), color=colour, lw=3, label="_line")
    ax.set(xlim=(-3, 4), ylim=(-2.3, 4))
pieces, walls = found.values()
typical = {
    name: np.median([np.degrees(np.sqrt(line.R[1, 1])) for line in some])
    for name, some in found.items()
}
views.show(
    fig,
    f"The room round the robot, taken apart into short pieces and into whole walls; of the scan in all, into "
    f"{len(pieces)} pieces and {len(walls)} walls.",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="08-length"
# {= len(pieces) =} pieces, with a $\sigma$ of $\alpha$ of {= typical["windows of 9 readings"]:.1f =}° in the median,
# become {= len(walls) =} walls with {= typical["grown"]:.1f =}°; {= sum(line.ends[:, 1].max() > 4 for line in walls) =} of
# them is beyond the picture. Neighbouring pieces differ in colour.
#
# Three rules make growing safe. The refit weighs each reading by its noise. A wall ends where two
# beams go *through* it; behind something that stands in the way it may go on, for 1.2 m at most.
# Readings near a corner could belong to either wall, so they only tell where both walls end, and do
# not count for the direction of either: the wall that is found first would otherwise take some of
# its neighbour's readings, always at the same end, and be turned by them.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## How good is it? Measure it
#
# A picture convinces nobody. A simulated world knows its walls, so we can judge every metre:
#
# - **recall** is the share that was found of all the wall that a scan shows;
# - **false** is the share of what was found that is no wall.
#
# Here is one scan, taken apart with Smolec's numbers. Can you raise the recall by changing these
# three numbers alone, and keep the false metres low? What does a denser scan change, and a sparser
# one?

# %% slideshow={"slide_type": "fragment"}
BY_THE_WALL = np.array([0.3, -1.1, 0.2])
GROWN = "grown lines, 2.8 σ"


def found_by(method, band_mm=15, window=25, beams=400):
    """A scan of the rooms, its lines, and how good they are."""
    ransac = replace(THESIS, window=window, min_inliers=max(3, window - 4), band=band_mm / 1000)
    rng, lidar = np.random.default_rng(14), replace(LIDAR, beams=beams)
    scan = lidar.scan(rooms, BY_THE_WALL, rng)
    found = lines(scan, lidar.model, rng, None if method == GROWN else ransac)
    return scan, found, found_walls.judge(rooms, BY_THE_WALL, scan, found)


# %% slideshow={"slide_type": "subslide"} tags=["folded"]
def taken_apart(**chosen):
    scan, found, metres = found_by(**chosen)
    fig, ax = views.axes(
        f"recall {100 * metres.recall:.0f} %, false {100 * metres.false:.0f} %", (9, 5.6)
    )
    layers = {
        "readings": Points("scan", scan.points()),
        "lines found": Segments("corrected", [line.ends.ravel() for line in found]),
        "robot": ROBOT,
    }
    draw_all(ax, layers, lines={"lw": 3})
    views.legend_below(fig)
    return fig


# %% slideshow={"slide_type": "fragment"}
views.explore(
    taken_apart,
    lambda **chosen: (
        "One scan of the rooms and the lines found in it, which cover "
        f"{100 * found_by(**chosen)[2].recall:.0f} % of the walls in view."
    ),
    method=["Smolec's windows", GROWN],
    band_mm=(5, 150, 15),
    window=(7, 41, 25),
    beams=[400, 100, 200, 800, 1600],
)

# %% [markdown] slideshow={"slide_type": "subslide"}
# One scan proves little. Let the finder run from twelve places in these rooms:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
methods = {"15 mm": THESIS, "100 mm": replace(THESIS, band=0.1), GROWN: None}
for beams in (100, 400, 1600):
    lidar, told = replace(LIDAR, beams=beams), []
    for name, ransac in methods.items():
        m = found_walls.judge_places(rooms, ransac, 12, lidar=lidar)
        told.append(f"{name}: {100 * m.recall:3.0f} % found, {100 * m.false:2.0f} % false")
    print(f"{beams:4} beams   " + "   ".join(told))

# %% [markdown] slideshow={"slide_type": "fragment"}
# A band of 15 mm finds the near walls only, however many beams there are. One of 100 mm finds more, but whatever lies
# within 10 cm of a line passes for a wall. With 1600 beams, 25 neighbours span so short a piece that the direction of
# the line becomes an accident. The grown lines need no choice between the two.

# %% [markdown] slideshow={"slide_type": "subslide"}
# ### Other worlds
#
# Rooms are easy. Here are five worlds; the last one is furnished, with a table, a cupboard and two round pillars.

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
judged = {
    name: [found_walls.judge_places(worlds.by_name(name), r, 12) for r in (THESIS, None)]
    for name in ("situation-1", "situation-2", "corridor", "table-legs", "room")
}
print(f"{'world':12}  Smolec: recall, false   grown: recall, false")
for name, both in judged.items():
    row = " ".join(f"{100 * m.recall:13.1f} % {100 * m.false:5.1f} %" for m in both)
    print(f"{name:12} {row}")
*EMPTY, FURNISHED = [both[1] for both in judged.values()]
ROOM = [FURNISHED, *(found_walls.judge_places(worlds.room(), None, 12, k) for k in (2, 3))]

# %% [markdown] slideshow={"slide_type": "fragment"}
# In the four worlds without furniture, the grown lines find at least
# {= 100 * min(m.recall for m in EMPTY):.0f =} % and invent at most
# {= 100 * max(m.false for m in EMPTY):.1f =} %. The furnished room is harder. From three draws of
# twelve places each, {= 100 * min(m.recall for m in ROOM):.0f =} to
# {= 100 * max(m.recall for m in ROOM):.0f =} % are found, and
# {= 100 * min(m.false for m in ROOM):.1f =} to {= 100 * max(m.false for m in ROOM):.1f =} % of what
# is found is false: legs and pillars cut the walls to pieces, and a few readings on a pillar can
# look flat enough to pass for a wall. In the exercise you find the pillars themselves.
#
# *This is a good place for a break.*

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask which of the two errors is worse for a map. A missed wall is seen again in the next scan;
# an invented one stays, and pairs with sightings of others. So parameters are chosen for few false metres first.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=4
# ## Corners
#
# Where two lines of a scan meet, there may be a corner. It lies on both of them, so it has to solve
# two linear equations like (08.2). They have one solution, which the machine writes down for us.
# (Corners are the landmarks of the robot in lesson 12.)

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
rho_1, alpha_1, rho_2, alpha_2 = sp.symbols("rho_1 alpha_1 rho_2 alpha_2", real=True)
on_both = [
    p_x * sp.cos(angle) + p_y * sp.sin(angle) - distance
    for distance, angle in ((rho_1, alpha_1), (rho_2, alpha_2))
]
meeting = sp.simplify(sp.Matrix(list(sp.solve(on_both, [p_x, p_y]).values())))
meeting

# %% [markdown] slideshow={"slide_type": "fragment"}
# The denominator is the sine of the angle between the walls. Walls that are nearly parallel do meet
# somewhere, but where is poorly known. The covariance needs no new idea: with $J_1$ and $J_2$ for
# the Jacobians of $p$ with respect to each line, and $R_1$ and $R_2$ for the covariances (08.8) of
# the lines,
#
# $$P = J_1 R_1 J_1^{\mathsf T} + J_2 R_2 J_2^{\mathsf T}. \tag{08.9}$$

# %% slideshow={"slide_type": "subslide"}
world, rng = worlds.situation_2(), np.random.default_rng(9)
scan = LIDAR.scan(world, HOME, rng)
found = lines(scan, LIDAR.model, rng)
met = corners(found)
J = [jacobians.J_z(HOME, each.z) for each in met]
P = [J_z @ each.R @ J_z.T for J_z, each in zip(J, met, strict=True)]
ten_times = Ellipses(
    "landmark", [models.g(HOME, each.z) for each in met], [100 * each for each in P]
)
sigmas = 100 * np.sqrt(np.linalg.eigvalsh(P)[:, 1])

# %% slideshow={"slide_type": "fragment"} tags=["folded"]
fig, ax = views.axes("Walls and corners of one scan", size=(9, 5.6))
layers = {
    "readings": Points("scan", scan.points()),
    "walls found": Segments("corrected", [line.ends.ravel() for line in found]),
    "corners, 95 %, ten times as large": ten_times,
    "robot": ROBOT,
}
draw_all(ax, layers, corners={"lw": 2})
views.legend_below(fig)
alt = f"{len(found)} walls found in a scan of situation 2, an ellipse round each of {len(met)} corners."
views.show(fig, alt)

# %% [markdown] slideshow={"slide_type": "subslide"}
# Lines go on for ever and walls do not, so only crossings near the seen ends of both walls are
# kept. The ellipses are drawn ten times too large, or they would vanish: in their worst direction
# these corners are known to between {= sigmas.min():.1f =} and {= sigmas.max():.1f =} cm
# ($\sigma$). Where the seen piece of a wall is short, its direction is poorly known, and the corner
# slides along the *other* wall.
#
# Are these ellipses honest? We take 120 scans, and compare each corner with the true one beside it:


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
def off_truth(corner):
    """How far a corner is off the nearest true one, as range and bearing."""
    errors = corner.z - models.h(HOME, world.walls[:, :2])
    errors[:, 1] = wrap(errors[:, 1])
    return errors[np.hypot(*errors.T).argmin()]


rng = np.random.default_rng(10)
scans = [LIDAR.scan(world, HOME, rng) for _ in range(120)]
seen = [corner for scan in scans for corner in corners(lines(scan, LIDAR.model, rng))]
seen = [each for each in seen if np.hypot(*off_truth(each)) < 0.2]  # else no corner of the room
sizes = np.array([nees(off_truth(each), each.R) for each in seen])
print(len(sizes), f"corners, {100 * np.mean(sizes < 5.99):.0f} % inside 95 % ellipses;", end=" ")
print(f"mean squared error {sizes.mean():.2f} ± {sizes.std() / len(sizes) ** 0.5:.2f}, 2 is right")

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## A wall as an observation
#
# Lesson 06's filter takes any landmark, if we tell it two things: what the robot expects to measure, $h$, and the
# Jacobian of that, $H$. A wall of the map is $l = (\rho, \alpha)$ in the world's frame. What does a robot at $x$, $y$,
# $\theta$ see of it?

# %% slideshow={"slide_type": "fragment"}
ask(
    "08-along",
    "A robot drives 1 m straight along a wall. What changes in the distance and the direction at which it sees "
    "the wall?",
    {
        "the distance": "the distance is measured along the normal, and the robot has moved across it.",
        "the direction": "the direction of the normal depends on how the robot is turned, not on where it is.",
        "both": "neither depends on where along the wall the robot stands.",
        "nothing": "so a wall cannot tell how far along it the robot has come.",
    },
    right="nothing",
)

# %% [markdown] slideshow={"slide_type": "subslide"} answers="08-along"
# A point that the robot sees at $(p'_x, p'_y)$ in its own frame is in the world at
# $(x, y) + \mathrm{Rot}(\theta)\,p'$. It lies on the wall, so we put that into the wall's equation (08.2), and
# sort by $p'_x$ and $p'_y$:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"] answers="08-along"
x, y, theta = sp.symbols("x y theta", real=True)
seen_x, seen_y = sp.symbols("p'_x p'_y", real=True)
turned = sp.rot_ccw_axis3(theta)[:2, :2] * sp.Matrix([seen_x, seen_y])
in_world = sp.Matrix([x, y]) + turned
wall_equation = sp.expand(in_world[0] * sp.cos(alpha) + in_world[1] * sp.sin(alpha) - rho)
sp.collect(wall_equation, [seen_x, seen_y], sp.simplify)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="08-along"
# This is the equation of a line again, now for $p'$. Its normal points to $\alpha - \theta$, and
# the terms without $p'$ together are $-\rho'$.

# %% [markdown] slideshow={"slide_type": "subslide"}
# So the robot sees the wall at
#
# $$h(x, l) = \begin{bmatrix} \rho' \\ \alpha' \end{bmatrix} = \begin{bmatrix}
# \rho - x\cos\alpha - y\sin\alpha \\ \alpha - \theta \end{bmatrix}. \tag{08.10}$$

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
h = sp.Matrix([rho - x * sp.cos(alpha) - y * sp.sin(alpha), alpha - theta])
H_robot_line = derive("H_r", partials(h, sp.Matrix([x, y, theta])), "∂h by the robot's pose")
H_robot_line.step("differentiate", differentiate())

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
H_line = derive("H_p", partials(h, sp.Matrix([rho, alpha])), "∂h by the wall")
H_line.step("differentiate", differentiate())

# %% [markdown] slideshow={"slide_type": "subslide"}
# The first row of $H_{\mathrm r}$ is the wall's normal, with a minus: driving along the wall changes nothing. One wall
# never says how far along it the robot is; for that it takes a second one, not parallel to the first. Every
# wall tells something about the heading, wherever it stands: that is the $-1$.
#
# The package has both as functions, and the machine compares:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
POSE, WALL = np.array([1.2, -0.7, 0.9]), np.array([2.1, 2.4])
numbers = dict(zip([x, y, theta, rho, alpha], [*POSE, *WALL], strict=True))
for name, steps in {"H_robot_line": H_robot_line, "H_line": H_line}.items():
    difference = sp.simplify(steps.result - getattr(symbolic, name))
    value = np.array(steps.result.subs(numbers).evalf(), dtype=float)
    code = getattr(jacobians, name)(POSE, WALL)
    print(f"{name:13} − symbolic: {difference.norm()}   − code: {abs(value - code).max():.6f}")

# %% [markdown] slideshow={"slide_type": "slide"} minutes=5
# ## The foot of the perpendicular, which nobody measured
#
# Smolec represents a wall by a single point, its **foot**: the point
# $\rho\,(\cos\alpha, \sin\alpha)$ where the perpendicular from the world's origin meets it. His
# filter is told range and bearing of the foot, as of any point landmark. To find the foot of a wall
# it sees, the robot has to know where the origin is, and takes its own estimate for that.

# %% slideshow={"slide_type": "fragment"}
ask(
    "08-foot",
    "A robot drives along a known wall. It believes that it is at x = **0.5 ± 0.3 m** and is truly at x = **1.0 m**. It "
    "looks at the wall ten times. What does Smolec's filter believe of x then?",
    {
        "about 1.0 m, and surer": "a wall says nothing about how far along it the robot is. Ten looks say "
        "ten times nothing.",
        "0.5 ± 0.3 m, as before": "so it should be; and so it is, if the wall is given to the filter as its "
        "distance and direction.",
        "about 0.5 m, and surer": "the foot was computed from the believed x. It agrees with what is "
        "believed, each time anew.",
    },
    right="about 0.5 m, and surer",
)

# %% slideshow={"slide_type": "fragment"} answers="08-foot"
wall, foot = np.array([2.0, np.pi / 2]), np.array([0.0, 2.0])
TRUE_POSE, P_START = np.array([1.0, 0.0, 0.0]), np.diag([0.3, 0.1, 0.05]) ** 2
R_wall, R_foot = np.diag([0.01, 0.01]) ** 2, np.diag([0.02, 0.01]) ** 2


# %% slideshow={"slide_type": "fragment"} answers="08-foot" tags=["code"]
def look(pose, P, z, as_foot):
    """One update of a pose by a sight z of the known wall, (06.9)."""
    if as_foot:
        rho, alpha = models.g_line(pose, z)  # through the pose as it is believed
        seen_foot = rho * np.array([np.cos(alpha), np.sin(alpha)])
        v = models.h(pose, seen_foot) - models.h(pose, foot)
        H, R = jacobians.H_robot(pose, foot), R_foot
    else:
        v = z - models.h_line(pose, wall)
        H, R = jacobians.H_robot_line(pose, wall), R_wall
    S = H @ P @ H.T + R
    K = P @ H.T @ np.linalg.inv(S)
    return pose + K @ v, P - K @ S @ K.T


# %% slideshow={"slide_type": "fragment"} answers="08-foot" tags=["folded"]
def after_looks(looks, believed_x, as_foot):
    pose, P = np.array([believed_x, 0.0, 0.0]), P_START
    rng = np.random.default_rng(11)
    for _ in range(looks):
        z = models.h_line(TRUE_POSE, wall) + 0.01 * rng.standard_normal(2)
        pose, P = look(pose, P, z, as_foot)
    return pose, P


def ten_looks(looks, believed_x):
    fig, ax = views.axes(f"after {looks} looks at the wall", size=(10, 5.4))
    as_line, as_foot = (after_looks(looks, believed_x, how) for how in (False, True))

    def place(name, pose, P):
        return Ellipses(name, [pose[:2]], [P[:2, :2]])

    layers = {
        "wall": Segments("walls", [[-1.5, 2, 3, 2]]),
        "foot of the wall": Points("landmark", [foot]),
        "true place": Points("truth", TRUE_POSE[None, :2]),
        "believed before, 95 %": place("predicted", [believed_x, 0.0], P_START),
        "(ρ, α), 95 %": place("corrected", *as_line),
        "its foot, 95 %": place("naive", *as_foot),
    }
    draw_all(ax, layers, wall={"lw": 3}, true={"markersize": 12}, its={"lw": 2})
    ax.set(xlim=(-1.5, 3), ylim=(-0.6, 2.4), aspect="equal", adjustable="box")
    views.legend_below(fig)
    return fig


# %% slideshow={"slide_type": "subslide"} answers="08-foot"
views.explore(
    ten_looks,
    lambda looks, believed_x: (
        f"After {looks} looks the ellipse of the filter with the foot has shrunk round x = {believed_x:.1f} m and "
        f"the truth is at {TRUE_POSE[0]:.1f} m; with (ρ, α) it is flat along the wall and as long as before."
    ),
    looks=(1, 30, 10),
    believed_x=(0.0, 2.0, 0.5),
)
by_foot, by_line = (after_looks(10, 0.5, as_foot) for as_foot in (True, False))

# %% [markdown] slideshow={"slide_type": "subslide"} answers="08-foot"
# With the foot, the filter believes $x$ = {= by_foot[0][0]:.2f =} ±
# {= np.sqrt(by_foot[1][0, 0]):.2f =} m. It is wrong by half a metre, and becomes surer with every
# look. With $(\rho, \alpha)$ it is {= by_line[0][0]:.2f =} ± {= np.sqrt(by_line[1][0, 0]):.2f =} m,
# as before. What a wall can tell, the second filter has learned: $\sigma$ of $y$ is
# {= 1000 * np.sqrt(by_line[1][1, 1]):.0f =} mm.
#
# Why? An innovation is *measured minus predicted*. Along the wall, the foot was never measured: it
# was computed through the believed pose. So it agrees with the belief whatever the truth is, and
# the filter counts ten such agreements as ten measurements. It listens to itself.
#
# Lesson 09 drives both variants through buildings, and measures what it costs.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* This is the deepest point of the lesson, so let the class say it in their own words. In lesson
# 03's terms: the noise of this "measurement" is the pose's own error, so it is not independent of what is believed.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## Which wall was it?
#
# The scan shows a wall, and the map holds several. **Association** decides which one it is, or that
# it is new. Smolec takes a landmark whose Euclidean distance from the sighting is below a constant.
#
# A robot knows its place to 5 cm and its heading to 0.15 rad only. It sees a wall at 2.98 m and 0.05 rad, and the
# map has two:
#
# | which | expected | seen minus expected |
# | --- | --- | --- |
# | wall A | 3.00 m, 0.30 rad | −0.02 m, −0.25 rad |
# | wall B | 2.78 m, 0.05 rad | +0.20 m, 0.00 rad |

# %% slideshow={"slide_type": "fragment"}
ask(
    "08-which",
    "The place is known to **5 cm**, the heading to **0.15 rad**. Which wall does the robot see?",
    {
        "B: 0.20 is less than 0.25": "that adds metres to radians as if they were alike. With other units, the "
        "answer would be another one.",
        "B: its direction fits exactly": "but its distance is off by 20 cm, and the robot knows its place to 5.",
        "A: such an error is to be expected": "0.25 rad are less than two standard deviations of the heading, "
        "and 20 cm about four of the place.",
    },
    right="A: such an error is to be expected",
)

# %% slideshow={"slide_type": "fragment"}
EXPECTED, SEEN = np.array([[3.0, 0.3], [2.78, 0.05]]), np.array([2.98, 0.05])
R = np.diag([0.02, 0.01]) ** 2


def innovation_covariance(place_sigma, heading_sigma):
    """S (2, 2, 2) of both walls, which were mapped as well as they are seen now."""
    P_rr = np.diag([place_sigma, place_sigma, heading_sigma]) ** 2
    H_r, H_p = LINES.H(HOME, EXPECTED)
    return H_r @ P_rr @ H_r.transpose(0, 2, 1) + H_p @ R @ H_p.transpose(0, 2, 1) + R


# %% slideshow={"slide_type": "subslide"} answers="08-which" tags=["folded"]
def two_walls(place_sigma, heading_sigma):
    S = innovation_covariance(place_sigma, heading_sigma)
    far = np.sqrt(nees(SEEN - EXPECTED, S))
    title = "A is {:.1f} and B {:.1f} standard deviations away".format(*far)
    fig, ax = views.chart("ρ' [m]", "α' [rad]", title, (9, 5))
    layers = {
        "expected: S, 95 %": Ellipses("predicted", EXPECTED, S),
        "walls of the map": Points("landmark", EXPECTED),
        "seen": Points("scan", SEEN[None]),
    }
    draw_all(ax, layers, seen={"marker": "*", "markersize": 18})
    for name, spot in zip("AB", EXPECTED, strict=True):
        ax.annotate(name, spot, xytext=(8, 6), textcoords="offset points", fontsize=13)
    ax.set(xlim=(2.2, 3.6), ylim=(-0.5, 0.9))
    views.legend(ax, loc="upper left")
    return fig


views.explore(
    two_walls,
    lambda **chosen: (
        "The sighting is {} standard deviations from wall A and {} from wall B.".format(
            *np.sqrt(nees(SEEN - EXPECTED, innovation_covariance(**chosen))).round(1)
        )
    ),
    place_sigma=(0.01, 0.3, 0.05),
    heading_sigma=(0.01, 0.3, 0.15),
)
far_A, far_B = np.sqrt(nees(SEEN - EXPECTED, innovation_covariance(0.05, 0.15)))

# %% [markdown] slideshow={"slide_type": "subslide"} answers="08-which"
# The covariance $S$ of the innovation knows that headings may be off by 0.15 rad, and distances hardly at all. So we
# count in units of $S$: the **Mahalanobis distance** is
#
# $$\sqrt{v^{\mathsf T} S^{-1} v}, \tag{08.11}$$
#
# with the innovation $v$, its angle wrapped. It is a number of standard deviations; here {= far_A:.1f =} to A and
# {= far_B:.1f =} to B. Now make the robot sure of its heading and unsure of its place, and the answer flips.
# Pythagoras would never change his mind.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=3
# ## The gate
#
# Beyond which distance is it not a wall of the map, but a new one? If the pairing is true and $S$ is right, the
# *square* of the Mahalanobis distance is $\chi^2$ with two degrees of freedom. It exceeds a threshold $\tau$ with the probability
#
# $$\Pr\left( v^{\mathsf T} S^{-1} v > \tau \right) = e^{-\tau/2}. \tag{08.12}$$
#
# So we choose how many true pairings we are ready to lose, and that gives the gate. We try it on 100 000 innovations
# of a true pairing:

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
S_A, rng = innovation_covariance(0.05, 0.15)[0], np.random.default_rng(12)
squared = nees(rng.multivariate_normal(np.zeros(2), S_A, 100_000), S_A)
for lost in (0.1, 0.05, 0.01, 0.001):
    gate = -2 * np.log(lost)
    print(f"gate {gate:5.2f}: {100 * np.mean(squared > gate):4.2f} % of the true pairings refused")

# %% [markdown] slideshow={"slide_type": "subslide"}
# A threshold in metres promises nothing of the kind. It refuses true pairings when the pose is
# poorly known, and accepts false ones when it is known well.
#
# Two more rules complete an association. Each wall is paired at most once in a scan: if two
# sightings fit it, the nearer one gets it. And a sighting just outside the gate is better left
# alone than made a new wall, for it may be an old one after all.
#
# The package has all this as `nearest_neighbours`, on a filter with both walls:

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* What goes wrong in code: $S^{-1}$ forgotten, which is Euclid again; $\alpha'$ not wrapped, so a
# wall behind the robot is never found again; several sightings given to one wall. The exercise notices all three.

# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
mak = MAK(HOME, np.zeros((3, 3)), kind=LINES)
mak.add(["A", "B"], EXPECTED, R)
mak.predict(HOME, np.diag([0.05, 0.05, 0.15]) ** 2)  # a rough turn on the spot
print("paired with", nearest_neighbours(mak, SEEN[None], R, 0.95))

# %% [markdown] slideshow={"slide_type": "slide"} minutes=6
# ## What enters the map
#
# A false wall in the map spoils the pairings after it. So a new wall should wait. Smolec uses a
# landmark only after $N$ **sightings** (he takes 5), and gives it a number of **lives**. Each scan
# that does not show the landmark costs it one life; seeing it again restores all of them; when none
# is left, it is dropped.
#
# Here, walls wait *outside* of the map until they have been seen $N$ times.

# %% slideshow={"slide_type": "fragment"}
ask(
    "08-trial",
    "A wall enters the map after **N** sightings. Which false walls enter all the same, however large N is?",
    {
        "none: noise does not repeat itself so often": "true of noise. But not every error is noise.",
        "those that look the same from scan to scan": "the side of a round pillar looks flat each time, as long "
        "as the robot hardly moves.",
        "the longest ones": "a long line needs many readings that agree, so a long false one is rare to "
        "begin with.",
    },
    right="those that look the same from scan to scan",
)


# %% slideshow={"slide_type": "subslide"} answers="08-trial"
SIGHTINGS = walls_on_trial.sightings(worlds.room())


def entered(sightings, lives):
    """The walls of the map, which of them are false, and what to say of them."""
    walls = walls_on_trial.entered(SIGHTINGS, sightings, lives)
    false = walls_on_trial.false(worlds.room(), walls)
    return walls, false, f"{np.sum(~false)} true walls in the map, {false.sum()} false"


# %% slideshow={"slide_type": "fragment"} answers="08-trial" tags=["folded"]
def on_trial(sightings, lives):
    walls, false, told = entered(sightings, lives)
    rows = np.array([walls_on_trial.ends(wall).ravel() for wall in walls]).reshape(-1, 4)
    fig, ax = views.axes(told, (9, 5.6))
    layers = {
        "the room": Segments("walls", worlds.room().outline()),
        "true walls of the map": Segments("corrected", rows[~false]),
        "false ones": Segments("naive", rows[false]),
    }
    draw_all(ax, layers, true={"lw": 4}, false={"lw": 4})
    views.legend_below(fig)
    return fig


# %% slideshow={"slide_type": "fragment"} answers="08-trial"
views.explore(
    on_trial,
    lambda **chosen: f"A furnished room and its map: {entered(**chosen)[2]}.",
    sightings=(1, 8, 1),
    lives=(1, 40, 3),
)

# %% [markdown] slideshow={"slide_type": "fragment"} answers="08-trial"
# The robot makes 40 scans on a small loop in a furnished room, where round pillars look flat from some places. Choose
# $N$ and the lives: can you keep all false walls out, and all true ones in?

# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"] answers="08-trial"
trials = [(1, 3), (2, 3), (3, 3), (5, 3), (3, 1), (3, 40)]
table = {trial: entered(*trial)[1] for trial in trials}
for (n, lives), false in table.items():
    print(f"N = {n}, lives {lives:2}: {np.sum(~false):2} true walls, {false.sum()} false")

# %% [markdown] slideshow={"slide_type": "fragment"} answers="08-trial"
# Most false walls go as $N$ grows, since noise rarely makes the same wall three times running. At
# $N = 5$, {= np.sum(~table[1, 3]) - np.sum(~table[5, 3]) =} true ones have gone with them, and
# {= table[5, 3].sum() =} false wall is still there: the side of a pillar that is passed slowly
# looks flat in scan after scan. A second sighting proves nothing if it repeats the error of the
# first.
#
# Lives decide how long a wall may wait. With a single one, a wall that is missed once starts anew: with $N = 3$ that
# leaves {= np.sum(~table[3, 1]) =} true walls and {= table[3, 1].sum() =} false ones. With forty it is
# {= np.sum(~table[3, 40]) =} and {= table[3, 40].sum() =}, as with three: in this room, more patience buys nothing.

# %% [markdown] slideshow={"slide_type": "notes"}
# *For the lecturer:* Ask what lives should do in a filter, where a landmark is tied to all others.
# To delete it means to delete its rows and columns (lesson 06). This is exact, and all it costs is
# what later sightings of the landmark could have told.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Literature
#
# M. A. Fischler and R. C. Bolles, "Random sample consensus: a paradigm for model fitting with applications to image
# analysis and automated cartography", *Communications of the ACM* 24(6), 1981: RANSAC.
#
# K. Pearson, "On lines and planes of closest fit to systems of points in space", *Philosophical Magazine* 2(11), 1901:
# the line of least distances.
#
# S. T. Pfister, S. I. Roumeliotis and J. W. Burdick, "Weighted line fitting algorithms for mobile robot map building
# and efficient data representation", *IEEE International Conference on Robotics and Automation*, 2003: each
# reading with its own noise.
#
# J. Neira and J. D. Tardós, "Data association in stochastic mapping using the joint compatibility test", *IEEE
# Transactions on Robotics and Automation* 17(6), 2001: all pairings of a scan at once.
#
# **Read next:** V. Nguyen, S. Gächter, A. Martinelli, N. Tomatis and R. Siegwart, "A comparison of line extraction
# algorithms using 2D range data for indoor mobile robotics", *Autonomous Robots* 23(2), 2007.

# %% [markdown] slideshow={"slide_type": "slide"} minutes=1
# ## What you can do now
#
# You can find walls in a scan, whatever their direction and distance, say how sure they are, and
# measure what your finder misses and invents. You can tell a filter which wall was seen and what
# was *measured* of it, and nothing else.
#
# **What comes next:** [lesson 09](09_slam_with_walls.ipynb) puts it together. It drives the whole of Smolec's system,
# live, through two buildings, and measures its flaws one by one.
#
# The sections below this one are optional.
#
# **Exercise:** [08 · Landmarks from scans](../exercises/ex08_landmarks_from_scans.ipynb). You fit a line, find where
# two walls meet, pair sightings with walls, find pillars, and take a whole scan apart.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## Deeper: weights that lean to one side
#
# The noise of a reading grows with its range, so (08.8) needs the range to compute $\sigma_i$. Which range: the
# measured one? A reading that happens to be too short then gets a *larger* weight, and one that is too long a smaller
# one. The wall is drawn towards the robot, in every scan alike. The package takes $\sigma_i$ at the range where the beam
# meets the *line*, which noise does not touch. We compare on the wall of "How sure is that line?":


# %% slideshow={"slide_type": "fragment"} tags=["nbval-check-output"]
class AsMeasured(Cloud):
    """The same readings, their noise taken at the measured range."""

    def variance(self, rows, rho, alpha):
        return (self.sensor.sigma(self.ranges[rows]) * np.cos(self.angles[rows] - alpha)) ** 2


fields = {"at the line": Cloud, "as measured": AsMeasured}
bias = {}
for name, kind in fields.items():
    some = [kind(**{key: getattr(each, key) for key in Cloud.__annotations__}) for each in clouds]
    off_rho = np.array([fit(each, np.arange(len(each)))[0][0] for each in some]) - 3.0
    bias[name] = 1000 * off_rho.mean(), 1000 * off_rho.std() / np.sqrt(len(off_rho))
    print(f"noise {name:12}: mean error of ρ {bias[name][0]:5.2f} ± {bias[name][1]:.2f} mm")
one_sigma = 1000 * np.sqrt(R_each[:, 0, 0].mean())

# %% [markdown] slideshow={"slide_type": "fragment"}
# With weights as measured, the wall is off by {= bias["as measured"][0]:.1f =} mm on average, which is
# {= abs(bias["as measured"][0] / bias["as measured"][1]):.1f =} times the uncertainty of that mean. With the package's it is
# {= abs(bias["at the line"][0] / bias["at the line"][1]):.1f =} times, no more than chance. A single scan's $\sigma$ of
# {= one_sigma:.1f =} mm hides the bias. But no filter can average it out: after
# {= (one_sigma / bias["as measured"][0]) ** 2:.0f =} scans of a wall, it is as large as the $\sigma$ that the filter
# believes.

# %% [markdown] slideshow={"slide_type": "slide"}
# ## In print
#
# Optional: what Smolec's thesis does otherwise, and what it costs.
#
# | place | printed | right | harm |
# | --- | --- | --- | --- |
# | Smolec 2.4 | $y = m x + c$, (08.1) | least distances, (08.6) | walls straight ahead are lost |
# | Smolec 2.4 | within 15 mm | within some $\sigma$ of each reading | far walls are never found |
# | Smolec, filter | the foot as a point | $(\rho, \alpha)$, (08.10) | too sure along the wall |
# | Smolec 4.4 | the *first* landmark under a constant | the nearest, by (08.11) | the map's order decides |
# | Smolec, program | landmarks enter at once | on trial, and compared | walls twice |
#
# The first three rows were found by cells above. Here are the other two.


# %% slideshow={"slide_type": "subslide"} tags=["nbval-check-output"]
def first_below(threshold, names):
    """The first wall of the map, in its order, that is near enough."""
    far = dict(zip("AB", [far_A, far_B], strict=True))
    return next(name for name in names if far[name] < threshold)


for names in ("AB", "BA"):
    print(f"map in the order {', '.join(names)}: the first below 5 σ is {first_below(5.0, names)}")

bare, twice = World(worlds.box((0, 0), (3.0, 2.5))), {}
seen_bare = walls_on_trial.sightings(bare, THESIS)
for name, within_scan in {"not compared": False, "compared": True}.items():
    walls = walls_on_trial.entered(seen_bare, within_scan=within_scan)
    twice[name] = walls_on_trial.repeated(walls).sum()
    print(f"new walls of a scan {name}: {len(walls)} in the map, {twice[name]} of them twice")

# %% [markdown] slideshow={"slide_type": "fragment"}
# The bare room has four walls. Of the walls that enter at first sight, {= twice["not compared"] =}
# repeat one that came in before them, in the same scan, and no later comparison takes them out.
# Comparing within a scan mends that. What is left are pieces of walls that do not touch. With the
# package's grown lines this room gives four walls at once.
