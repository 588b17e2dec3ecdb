# %% [markdown]
# # Exercise 15 · Closing the loop
#
# **You will be able to** write the heart of a graph SLAM: the error of an edge, its Jacobians, and a
# step that shares out the error among all poses. You will then derive an edge that measures nothing but a
# distance, and draw a map of a building although some of its loops are false.
#
# **60 minutes. Before:** lesson [15 · Closing the loop](../notebooks/15_closing_the_loop.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below it, as
# often as you like. A check tries random graphs and graphs at the edges of what the text promises. Where a law
# is broken it shows a small case that breaks it, and `hint("15-step")` in a cell of your own leads on.
#
# Lengths are in metres and angles in radians. A pose is `[x, y, θ]`, an array of three numbers, and its heading
# lies between $-\pi$ and $\pi$. No function may change its arguments, because whoever called it still needs
# them.
#
# In the code and in the hints some letters are those of the literature: `A` is $J_i$, `B` is $J_j$, `H` is
# $\Lambda_x$, `b` is the sum on the right of (15.5), and `R` a rotation matrix.

# %%
import numpy as np

from slamlab import views
from slamlab.checks import ask, attempt, check
from slamlab.geometry import between, compose, wrap
from slamlab.layers import Poses, Segments

# %% [markdown]
# ## 1 · The error of an edge
#
# An edge says that pose $j$, as seen from pose $i$, is $z$. Where $z$ puts pose $j$ and where it is believed to be
# may differ. The **error** is pose $j$ as seen from where $z$ puts it, as in (15.2):
#
# $$e = \ominus z \oplus (\ominus x_i \oplus x_j) = \begin{bmatrix} \mathrm{Rot}(\theta_z)^{\mathsf T} \left(
# \mathrm{Rot}(\theta_i)^{\mathsf T} (p_j - p_i) - p_z \right) \\ \theta_j - \theta_i - \theta_z \end{bmatrix},
# \qquad p = \begin{bmatrix} x \\ y \end{bmatrix}.$$
#
# The last component is an angle, and it has to lie between $-\pi$ and $\pi$: a robot that turned by 350° too much
# is wrong by 10°. `wrap` brings angles there.
#
# **Your task.** Return $e$. Any two poses may be joined by an edge, also two in one place, and $z$ may be no motion
# at all.


# %% name="error"
def error(x_i, x_j, z):
    """How far pose j is from where the edge puts it.

    x_i, x_j : (3,) poses;  z : (3,) measured pose of j as seen from i [m, m, rad]
    returns e (3,) [m, m, rad], the angle wrapped
    """
    ### BEGIN SOLUTION

    def back(angle, way):
        c, s = np.cos(angle), np.sin(angle)
        return np.array([c * way[0] + s * way[1], c * way[1] - s * way[0]])

    way = back(z[2], back(x_i[2], x_j[:2] - x_i[:2]) - z[:2])
    return np.array([*way, wrap(x_j[2] - x_i[2] - z[2])])
    ### END SOLUTION


# %%
check("15-error")

# %% [markdown]
# ## 2 · How the error feels its poses
#
# To know which poses to move, and by how much, a graph has to know how $e$ changes when a pose moves:
# $J_i = \partial e/\partial x_i$ and $J_j = \partial e/\partial x_j$. The lesson has read off most of them, in
# (15.3):
#
# - If pose $j$ moves, $e$ changes by the same motion, seen from a frame that looks along $\theta_i + \theta_z$.
# - If pose $i$ moves, $e$ changes by the opposite.
# - If pose $i$ *turns*, all that it sees swings round it. Only the part
#   $\mathrm{Rot}(\theta_i)^{\mathsf T}(p_j - p_i)$ of $e$ holds $\theta_i$, so the swing is the derivative of that.

# %%
ask(
    "ex15-swing",
    "Pose $j$ stands straight ahead of pose $i$. Now pose $i$ turns a little to the *left*. **Where "
    "does pose $j$ go, as seen from pose $i$?**",
    {
        "to the left, too": "the robot turns, and the world does not turn with it.",
        "to the right, the farther the longer the arm": "what a robot sees swings the other way round it, on an arm as long as the distance.",
        "to the right, by the same at any distance": "the angle is the same at any distance. How far the pose goes is the angle times the distance.",
        "nowhere: it is straight ahead": "it was. The robot looks elsewhere now.",
    },
    right="to the right, the farther the longer the arm",
)

# %% [markdown]
# **Your task.** Derive the swing, and return $J_i$ and $J_j$, for the same edges as in task 1.


# %% name="jacobians"
def jacobians(x_i, x_j, z):
    """A = ∂e/∂x_i and B = ∂e/∂x_j, each (3, 3): a row per component of e.

    x_i, x_j, z : (3,) [m, m, rad]
    """
    ### BEGIN SOLUTION
    angle = x_i[2] + z[2]
    c, s = np.cos(angle), np.sin(angle)
    dx, dy = x_j[0] - x_i[0], x_j[1] - x_i[1]
    A = np.array([[-c, -s, c * dy - s * dx], [s, -c, -c * dx - s * dy], [0, 0, -1]])
    B = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
    return A, B
    ### END SOLUTION


# %%
check("15-jacobians")

# %% [markdown]
# ## 3 · One step of Gauss and Newton
#
# All edges together cost $\chi^2 = \sum e^{\mathsf T}\Lambda\,e$, with $\Lambda$ the information of that edge's $e$,
# the inverse of its covariance. Near the present poses $e(x + \delta) \approx e + J\delta$, and by (15.5) the best
# $\delta$ solves
#
# $$\Lambda_x\, \delta = -\sum J^{\mathsf T}\Lambda\, e, \qquad \Lambda_x = \sum J^{\mathsf T}\Lambda\, J.$$
#
# The $J$ of an edge has $J_i$ in the columns of pose $i$, $J_j$ in those of pose $j$, and zeros elsewhere. So an edge
# adds to four blocks of $\Lambda_x$, and to two parts of the sum on the right.
#
# Edges say only how poses lie relative to each other, so without more $\Lambda_x$ is singular: **hold pose 0**. Then add
# $\delta$ to the poses, number by number, and wrap the headings.
#
# **Your task.** Take one step and return the new poses. Do not take more, because whoever calls `step` goes on. Use
# your `error` and `jacobians`. There are two poses or more, and each of them is tied to pose 0 by some chain of
# edges. Edges come in any order, they may point back ($i$ larger than $j$), and several may join the same two
# poses.


# %% name="step"
def step(poses, edges):
    """The poses after one step of Gauss and Newton; pose 0 stays.

    poses : (n, 3) [m, m, rad]
    edges : list of (i, j, z, information): two numbers, z (3,), the matrix Λ (3, 3) of e
    returns (n, 3), headings wrapped
    """
    ### BEGIN SOLUTION
    n = len(poses)
    H, b = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i, j, z, information in edges:
        J = np.zeros((3, 3 * n))
        J[:, 3 * i : 3 * i + 3], J[:, 3 * j : 3 * j + 3] = jacobians(poses[i], poses[j], z)
        H += J.T @ information @ J
        b += J.T @ information @ error(poses[i], poses[j], z)
    delta = -np.linalg.solve(H[3:, 3:], b[3:])
    better = poses.copy()
    better[1:] += delta.reshape(-1, 3)
    better[:, 2] = wrap(better[:, 2])
    return better
    ### END SOLUTION


# %%
check("15-step")

# %%
ask(
    "ex15-steps",
    "A robot drives round a hall, ten poses, and its wheels report each turn of 36° as 31°. At the "
    "end it sees the start, one step ahead. **After how many steps of Gauss and Newton do you see no "
    "more change?**",
    {
        "one: least squares is solved at once": "it would be, if e were linear in the poses. Over such turns it is bent.",
        "three": "the first step goes astray, for e bends. From then on it is nearly straight.",
        "about twenty: each step mends a little": "so it would be downhill along the slope. Gauss and Newton step to where the bottom would be if e "
        "were straight.",
    },
    right="three",
)


# %% name="hall"
SURE, UNSURE = np.diag([2500.0, 2500.0, 3000.0]), np.diag([100.0, 100.0, 100.0])


def hall():
    """Ten poses as the wheels tell them (10, 3); nine edges of the wheels and a loop's."""
    poses, edges = [np.zeros(3)], []
    for k in range(9):
        z = np.array([1.5, 0.0, np.radians(31)])  # in truth it turned by 36 degrees
        edges.append((k, k + 1, z, UNSURE))
        poses.append(compose(poses[-1], z))
    edges.append((9, 0, np.array([1.5, 0.0, np.radians(36)]), SURE))
    return np.array(poses), edges


def chi2(poses, edges):
    """The sum of eᵀΛe."""
    found = [(error(poses[i], poses[j], z), information) for i, j, z, information in edges]
    return sum(e @ information @ e for e, information in found)


# %% name="watch" answers="ex15-steps"
@attempt
def _():
    start, edges = hall()

    def draw(steps):
        poses = start
        for _ in range(steps):
            poses = step(poses, edges)
        loops = [[*poses[i, :2], *poses[j, :2]] for i, j, *_ in edges[9:]]
        title = f"after {steps} steps: χ² = {chi2(poses, edges):.1f}"
        fig, ax = views.axes(title, size=(5.5, 4.5))
        views.draw(ax, Segments("loop", loops))
        views.draw(ax, Poses("corrected", poses), marker=".", markersize=6)
        views.legend(ax, loc="center")
        return fig

    views.explore(draw, alt="A ring of ten poses and its loop after some steps.", steps=(0, 6, 3))


# %% [markdown] answers="ex15-steps"
# The first step treats $e$ as linear over turns that are far from small, so it only halves
# $\chi^2$. The second step corrects nearly everything, and after the third nothing moves any more.
# Every turn has got its share.


# %% [markdown]
# ## 4 · An edge by radio
#
# Two robots carry radios. From the time that a signal takes, each pair of radios knows its **distance** $r$, and
# nothing else: no direction and no heading. A radio seldom sits at its robot's centre, so let $a_i$ and $a_j$ be the
# places of the two radios in their own robots' frames. The way from the one to the other, and the error of the edge, are
#
# $$d = \left(p_j + \mathrm{Rot}(\theta_j)\,a_j\right) - \left(p_i + \mathrm{Rot}(\theta_i)\,a_i\right), \qquad
# e = \lVert d\rVert - r.$$
#
# Such an edge belongs in the same graph as all the others. Only its $e$ is now one number, and
# $J_i$ and $J_j$ are single rows. What does a small motion of pose $i$ do to $d$, and how much of
# that changes the length of $d$?
#
# One case is easy to check: if a radio sits at the centre of its robot, one entry of $J_i$ is zero. Which one, and
# why?
#
# **Your task.** Return $e$ and the two rows. The radios are at least 10 cm apart. They may sit at the centres, and the
# robots may look in any direction.


# %% name="range"
def range_edge(x_i, x_j, r, a_i, a_j):
    """The error of a measured distance, and how it changes with the two poses.

    x_i, x_j : (3,) poses [m, m, rad];  r : float, the measured distance [m]
    a_i, a_j : (2,) place of each radio in its robot's frame [m]
    returns e, a float [m], and A = ∂e/∂x_i and B = ∂e/∂x_j, each (3,)
    """
    ### BEGIN SOLUTION

    def radio(x, a):
        c, s = np.cos(x[2]), np.sin(x[2])
        arm = np.array([c * a[0] - s * a[1], s * a[0] + c * a[1]])
        return x[:2] + arm, np.array([-arm[1], arm[0]])

    (from_i, turned_i), (from_j, turned_j) = radio(x_i, a_i), radio(x_j, a_j)
    d = from_j - from_i
    distance = np.hypot(d[0], d[1])
    u = d / distance
    A = np.array([-u[0], -u[1], -u @ turned_i])
    B = np.array([u[0], u[1], u @ turned_j])
    return distance - r, A, B
    ### END SOLUTION


# %%
check("15-range")

# %%
ask(
    "ex15-nine",
    "The hall again, but this time nobody sees the start. Instead the robot hears a radio that stands "
    "where it began, and the radio on its mast tells it nine distances, one at each pose. **Can nine "
    "distances mend nine turns?**",
    {
        "no: no distance says anything about a direction": "by itself it does not. But the wheels know the shape of each step, and only some bends of the "
        "whole way fit all distances.",
        "nearly": "the distances say how the steps must be bent together. A little is left open.",
        "only with a second radio: with one the whole way may be turned about it": "pose 0 is held, and the heading of the first step with it.",
    },
    right="nearly",
)


# %% name="heard" answers="ex15-nine"
@attempt
def _():
    start, edges = hall()
    mast, station, steps = np.array([0.3, 0.4]), np.zeros(2), [np.zeros(3)]
    for _ in range(9):
        steps.append(compose(steps[-1], np.array([1.5, 0.0, np.radians(36)])))
    truth = np.array(steps)
    r = [range_edge(truth[0], x, 0.0, station, mast)[0] for x in truth]
    poses = start.copy()
    for _ in range(6):
        H, b = np.zeros((30, 30)), np.zeros(30)
        for i, j, z, L in edges[:9]:
            J = np.zeros((3, 30))
            at_i, at_j = slice(3 * i, 3 * i + 3), slice(3 * j, 3 * j + 3)
            J[:, at_i], J[:, at_j] = jacobians(poses[i], poses[j], z)
            H, b = H + J.T @ L @ J, b + J.T @ L @ error(poses[i], poses[j], z)
        for k in range(1, 10):
            e, _, B = range_edge(poses[0], poses[k], r[k], station, mast)
            at = slice(3 * k, 3 * k + 3)
            H[at, at] += 2500 * np.outer(B, B)
            b[at] += 2500 * np.array(B) * e
        poses[1:] -= np.linalg.solve(H[3:, 3:], b[3:]).reshape(-1, 3)
    shown = {
        "by wheels": [Poses("truth", truth), Poses("naive", start)],
        "wheels and nine distances": [Poses("truth", truth), Poses("corrected", poses)],
    }
    fig, _ = views.side_by_side(shown, size=(9, 3.8))
    views.show(fig, alt="An open ring of poses beside the true one, and a ring that lies on it.")


# %% [markdown] answers="ex15-nine"
# Nearly. The wheels know the shape of each step, and the distances tell how the steps must be bent for all of them to
# fit. What is left of the error is what the distances leave open.


# %% [markdown]
# ## 5 · A map in spite of liars
#
# A loop may be false: one door looks like the next. The lesson's remedy is to lower the weight of an edge whose $\chi^2$ is
# beyond $\Phi$. Such an edge pays the cost (15.9) in place of its $\chi^2$, so its $\Lambda$ is multiplied by the slope
# of that cost, the weight (15.10). Here it is, ready to use:


# %% name="weight"
def weight(chi2, phi):
    """What an edge counts, the slope of ρ: in (0, 1]."""
    return min(1.0, 2 * phi / (phi + chi2)) ** 2


# %% [markdown]
# The hall once more, with its true loop and a liar: an edge that claims that pose 6 was next to pose 1.
# The picture shows the hall with the true loop alone, with the liar trusted, and with both loops weighed. ($\Phi$ begins large and
# shrinks from step to step, because at the start the true loop looks as false as the liar.)


# %% name="liar"
@attempt
def _():
    start, edges = hall()
    edges = [*edges, (1, 6, np.array([0.2, 0.1, 0.3]), SURE)]

    def weighed(poses, k):
        scaled, phi = list(edges[:9]), max(11.3, 1e5 / 2**k)
        for i, j, z, information in edges[9:]:
            e = error(poses[i], poses[j], z)
            scaled.append((i, j, z, weight(e @ information @ e, phi) * information))
        return scaled

    def settled(graph):
        poses = start
        for k in range(40):
            poses = step(poses, graph(poses, k))
        return poses

    graphs = {"true loop only": lambda *_: edges[:10], "liar trusted": lambda *_: edges}
    graphs["both weighed"] = weighed
    shown = {title: [Poses("corrected", settled(graph))] for title, graph in graphs.items()}
    fig, _ = views.side_by_side(shown, size=(11, 3.6))
    views.show(fig, alt="Three rings: closed, crushed by a false loop, closed in spite of it.")


# %% [markdown]
# One liar is easily refused. Now the robot drives two laps round a building on poor wheels, which err by 5° a step, and its
# scanner reports eighteen loops. Ten of them are true. Two are false, each in its own way. The other six **agree with each
# other**: one after the other they take a place for its twin 2.5 m away, as the lesson's two rooms did. Where liars agree,
# the honest may look like the outliers, and weights alone no longer help.
#
# **Your task.** Draw the best map that you can. Any method is allowed: refuse loops before you
# trust any, look for loops that support each other, weigh them, or try several beginnings and
# compare what they cost. A few questions that may lead on:
#
# - How far may the wheels have drifted between two poses, and which loops claim more than that?
# - Once one loop is trusted, the doubt about all other poses shrinks. What does this say about the loops that have not been
#   judged yet?
# - How would you compare a map that trusts one group of loops with a map that trusts another?
#
# The error of a map is how far its poses are off (rms, with pose 0 known). Sixteen drives are tried. The first step of the
# ladder asks for eight maps that are off by less than 0.9 m, the second for eight that are off by less than 0.38 m, and the
# third for eleven below 0.6 m. The wheels alone are off by more than a metre, and so is the map that trusts all loops.
# The check stops after 10 s.
#
# The edges of the wheels are honest: there is one from each pose to the next, in their order. `poses` is what the wheels make
# of them, so it is the map without a loop. There is at least one loop, and a true one errs by about 5 cm and 1°, as its
# $\Lambda$ says. Drives may have any length, and perhaps all of their loops are true.


# %% name="liars"
def close_loops(poses, edges, loops):
    """The best map of a drive, some of whose loops may be false; pose 0 stays.

    poses : (n, 3) by the wheels alone [m, m, rad]
    edges : list of (i, j, z, information), those of the wheels, all of them honest
    loops : list of the same kind, some of which may be false
    returns (n, 3)
    """
    ### BEGIN SOLUTION
    n = len(poses)

    def linear(some, at):
        """J without pose 0, and e, of some edges, in units of their own doubt."""
        i, j = np.array([edge[:2] for edge in some]).T
        z, information = (np.array([edge[k] for edge in some]) for k in (2, 3))
        angle, (dx, dy) = at[i, 2] + z[:, 2], (at[j] - at[i])[:, :2].T
        c, s, count = np.cos(angle), np.sin(angle), np.arange(len(some))
        B = np.zeros((len(some), 3, 3))
        B[:, 0, 0], B[:, 0, 1], B[:, 1, 0], B[:, 1, 1], B[:, 2, 2] = c, s, -s, c, 1
        A = -B
        A[:, 0, 2], A[:, 1, 2] = c * dy - s * dx, -c * dx - s * dy
        J = np.zeros((len(some), n, 3, 3))
        J[count, i], J[count, j] = A, B
        U = np.linalg.cholesky(information).swapaxes(1, 2)
        e = U @ between(z, between(at[i], at[j]))[..., None]
        return (U @ J.swapaxes(1, 2).reshape(-1, 3, 3 * n)).reshape(-1, 3 * n)[:, 3:], e.ravel()

    def settled(some, at):
        """The best poses for some edges."""
        at = at.copy()
        for _ in range(3):
            J, e = linear(some, at)
            at[1:] -= np.linalg.solve(J.T @ J, J.T @ e).reshape(-1, 3)
            at[:, 2] = wrap(at[:, 2])
        return at

    def agreeing(at):
        """The loops that agree with the wheels and with each other: the cheapest set of them."""
        J, e = linear(edges, at)
        P = np.linalg.inv(J.T @ J)
        K, v = linear(loops, at)
        v, S = v - K @ P @ J.T @ e, K @ P @ K.T + np.eye(len(v))
        rows, best, tried = np.arange(len(v)).reshape(-1, 3), (0.0, []), set()
        for first in range(len(loops)):
            if first in tried:
                continue
            w, T, cost, chosen, k = v, S, 0.0, [], first
            while len(chosen) < len(loops):
                blocks = T[rows[:, :, None], rows[:, None, :]] + 1e-9 * np.eye(3)
                d2 = np.sum(w[rows] * np.linalg.solve(blocks, w[rows][..., None])[..., 0], axis=1)
                d2[chosen] = np.inf
                k = int(np.argmin(d2)) if chosen else first
                if d2[k] > 16:
                    break
                cost, at_k = cost + d2[k] - 16, rows[k]
                gain = T[:, at_k] @ np.linalg.inv(T[np.ix_(at_k, at_k)])
                w, T, chosen = w - gain @ w[at_k], T - gain @ T[at_k], [*chosen, k]
            best, tried = min(best, (cost, chosen)), tried.union(chosen)
        return [loops[k] for k in best[1]]

    found = poses
    for _ in range(2):  # the second time nearer to the best poses, where e is straighter
        found = settled([*edges, *agreeing(found)], found)
    return found
    ### END SOLUTION


# %%
check("15-liars")

# %% [markdown]
# To try your method, here are drives whose truth is known. Change the number of the drive, and look at those on which your map
# is still wrong: which loops did it believe?


# %% name="two-laps"
def two_laps(number):
    """The true poses of a drive, those by its wheels, its wheels' edges, and its loops."""
    rng = np.random.default_rng(number)
    wheels, eyes = np.array([0.1, 0.06, np.radians(5)]), np.array([0.05, 0.05, 0.015])
    truth, poses, edges = [np.zeros(3)], [np.zeros(3)], []
    for k in range(23):
        step = np.array([2.0, 0.0, np.pi / 2 if k % 3 == 2 else 0.0])
        step, z = step, step + wheels * rng.standard_normal(3)
        truth, poses = [*truth, compose(truth[-1], step)], [*poses, compose(poses[-1], z)]
        edges.append((k, k + 1, z, np.diag(1 / wheels**2)))
    truth, loops = np.array(truth), []
    slips = [np.zeros(3)] * 10 + [np.array([2.5, 0.2, 0.1])] * 6 + list(rng.uniform(-2, 2, (2, 3)))
    gang = rng.integers(11, 19) + np.arange(6)
    later = [*rng.integers(11, 24, 10), *gang, *rng.integers(11, 24, 2)]
    for j, slip in zip(later, slips, strict=True):
        i, twin = max(j - 12 + rng.integers(-1, 2), 0), truth[gang[0]]
        believed = compose(compose(twin, slip), between(twin, truth[j]))
        z = between(truth[i], believed) + eyes * rng.standard_normal(3)
        loops.append((int(i), int(j), z, np.diag(1 / eyes**2)))
    return truth, np.array(poses), edges, loops


# %% name="mapped"
@attempt
def _():
    def draw(drive):
        truth, poses, edges, loops = two_laps(drive)
        tracks = {"by wheels": poses, "your map": np.asarray(close_loops(poses, edges, loops))}
        shown = {}
        for title, track in tracks.items():
            off = np.sqrt(np.mean(np.sum((track - truth)[:, :2] ** 2, axis=1)))
            name = "naive" if title == "by wheels" else "corrected"
            shown[f"{title}: {off:.2f} m off"] = [Poses("truth", truth), Poses(name, track)]
        return views.side_by_side(shown, size=(9, 4))[0]

    views.explore(
        draw, alt="Two laps by wheels and as mapped, over the true ones.", drive=(0, 20, 3)
    )


# %% [markdown]
# ## Done?
#
# Save the notebook. The cell below then says what the grader will say about it; the grader draws other graphs. If you
# have a log of your own, point `slamlab run … --estimator graph` at it.
#
# **Next:** [lesson 16 · Your own SLAM](../notebooks/16_your_own_slam.ipynb) hands you the whole robot.
