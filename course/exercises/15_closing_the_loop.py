# %% [markdown]
# # Exercise 15 · Closing the loop
#
# **You will be able to** write the heart of a graph SLAM: the error of an edge, its Jacobians, a
# step that shares out the error among all poses, a weight that lets a false loop go, and a map cell
# that changes its mind.
#
# **75 minutes. Before:** lesson [15 · Closing the loop](../notebooks/15_closing_the_loop.ipynb).
#
# Replace each `raise NotImplementedError(...)` by your code, run the cell, then run the check below
# it, as often as you like. A check tries random graphs and says which law is broken, and what the
# mistake is where it knows it.
#
# Metres and radians. A pose is `[x, y, θ]`, an array of three numbers.

# %%
import numpy as np

from slamlab import views
from slamlab.checks import attempt, check
from slamlab.geometry import compose, wrap
from slamlab.layers import Poses, Segments

# %% [markdown]
# ## 1 · The error of an edge
#
# An edge says: pose j, seen from pose i, is z. Where z puts it and where pose j really is may
# differ. The **error** is pose j as seen from where z puts it:
#
# $$e = z^{-1} \oplus (x_i^{-1} \oplus x_j) = \begin{bmatrix}
# R(\theta_z)^{\mathsf T}\left(R(\theta_i)^{\mathsf T}(t_j - t_i) - t_z\right)\\
# \theta_j - \theta_i - \theta_z\end{bmatrix}, \qquad t = \begin{bmatrix}x\\y\end{bmatrix}$$
#
# Mind the last component: it is an angle. `wrap` brings angles to (−π, π].


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
# Derive $A = \partial e/\partial x_i$ and $B = \partial e/\partial x_j$, or read them off the
# lesson's derivation. With $R$ the rotation by $\theta_i + \theta_z$:
#
# - move pose j: e's change is the same, written in a turned frame;
# - move pose i: the opposite; **turn** pose i: all that it sees swings round it.
#
# A hint for the third column of A: only $R(\theta_i)^{\mathsf T}(t_j - t_i)$ holds θ_i.


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
# All edges together cost $\chi^2 = \sum e^{\mathsf T}\Lambda\,e$. Each Λ is the information of its e,
# in the frame that z leads to: whoever made the edge has turned it there. Near the present poses
# $e(x + \delta) \approx e + J\delta$, and the best δ solves
#
# $$H\,\delta = -b, \qquad H = \sum J^{\mathsf T}\Lambda J, \qquad b = \sum J^{\mathsf T}\Lambda\,e$$
#
# J of an edge has A in the columns of pose i, B in those of pose j and nothing else: so its part of
# H is four blocks, its part of b two.
#
# **Hold pose 0**: without that H is singular. Then add δ to the poses, and wrap the headings. One
# step, not more: whoever calls it goes on. Use your `error` and `jacobians`.


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

# %% [markdown]
# A robot drives round a hall, ten poses; each of its turns is told too small. At the end it sees the
# start, one step ahead. **Before you run it:** after how many steps do you expect to see no more change?
# Then move the slider.


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


# %% name="watch"
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
        ax.legend(loc="center")
        return fig

    views.explore(draw, alt="A ring of ten poses and its loop after some steps.", steps=(0, 6, 3))


# %% [markdown]
# The first step takes e for straight over turns that are far from small, so it only halves χ². The
# second puts nearly all right, and after the third nothing moves. Every turn has got its share.

# %% [markdown]
# ## 4 · What a doubtful edge counts
#
# A loop may be false. Up to Φ its cost is χ², as any edge's; beyond, it levels off:
#
# $$\rho(\chi^2) = 3\Phi - \frac{4\Phi^2}{\Phi + \chi^2} \quad (\chi^2 > \Phi)$$
#
# Whoever lowers ρ instead of χ² scales the edge's Λ by the **slope** of ρ. Return that factor: with
# $s = \min\left(1, \frac{2\Phi}{\Phi + \chi^2}\right)$ it is $s^2$.


# %% name="weight"
def weight(chi2, phi):
    """What an edge counts, the slope of ρ: in (0, 1].

    chi2 : float, the edge's eᵀΛe;  phi : float, Φ
    """
    ### BEGIN SOLUTION
    return min(1.0, 2 * phi / (phi + chi2)) ** 2
    ### END SOLUTION


# %%
check("15-weight")

# %% [markdown]
# The same hall, and a liar: an edge that claims pose 6 was next to pose 1. **Before you run it:**
# what will the hall look like if the liar is trusted, and what if both loops are weighed? (Φ begins
# large and shrinks from step to step: at the start the true loop looks as false as the liar.)


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
# ## 5 · A cell changes its mind
#
# A cell of an occupancy grid keeps the log odds that it is occupied, $l = \log\frac{P}{1-P}$. A new
# scan alone says: occupied with probability p. Bayes' rule adds log odds:
#
# $$l \leftarrow l + \log\frac{p}{1-p}$$
#
# And no cell may be believed more occupied than `most`, nor more free: bound l on **both** sides by
# the log odds of `most`.


# %% name="update"
def update(l, p, most):
    """The log odds of a cell after one more scan.

    l : float, before;  p : float, what the scan alone says;  most : float, a probability
    """
    ### BEGIN SOLUTION
    bound = np.log(most / (1 - most))
    return float(np.clip(l + np.log(p / (1 - p)), -bound, bound))
    ### END SOLUTION


# %%
check("15-cell")

# %% [markdown]
# A door: 40 scans see it closed (p = 0.7), then 40 see through it (p = 0.4). **Before you run it:**
# which of the three is the first to call it open (P below 0.2)?


# %% name="door"
@attempt
def _():
    curves, scans = {}, np.arange(81)
    for most in (0.97, 0.9999, 1 - 1e-12):
        l, believed = 0.0, [0.5]
        for k in range(80):
            l = update(l, 0.7 if k < 40 else 0.4, most)
            believed.append(1 / (1 + np.exp(-l)))
        curves[f"most = {most:.4f}"] = np.array(believed)
    fig, _ = views.curves(scans, curves, "scan", "P(occupied)", "A door that opens at scan 40")
    views.show(fig, alt="Three curves rise to one; after the door opens they fall, soon or late.")


# %% [markdown]
# The surer a cell may become, the longer it clings to the past. A bound of 0.97 costs nothing while
# the door is closed, and lets go after 13 scans.
#
# **Next:** this was the last lesson. Point `slamlab run … --estimator graph` at a log of your own.
