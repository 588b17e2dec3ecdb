"""Linked plots: a landmark map beside the correlation matrix of its estimates, coloured alike."""

from matplotlib.patches import Rectangle
from matplotlib.patheffects import withStroke

from slamlab.views.colours import COLOURS
from slamlab.views.figures import panels
from slamlab.views.layer_drawing import draw
from slamlab.views.matrix_plot import correlation


def linked(landmarks, rho, names, marked=0, layers=(), room=None, view=None, size=(9.5, 4.2)):
    """Linked plots of landmarks and the correlation matrix of [robot, landmarks], coloured alike.

    A landmark on the map is coloured by its correlation with the marked one: the mean of that of
    the two x and that of the two y, which stand in the framed rows and columns of the matrix.

    Parameters
    ----------
    landmarks : (N, 2) [m]
    rho : (3 + 2N, 3 + 2N) correlations, such as ``evaluation.correlation(P)``
    names : N names of the landmarks
    marked : int, row of landmarks to mark
    layers : what else to draw on the map
    room : int or None, landmarks to leave room for, so that a growing matrix keeps its place
    view : (x_min, x_max, y_min, y_max) [m], or None for all
    size : (width, height) [80 pixels of the page]

    Returns
    -------
    Figure, (map, matrix) Axes
    """
    fig, (left, right) = panels([None, None], size, shared=False)
    for ax in (left, right):
        ax.set_aspect("equal", adjustable="box")
    for layer in layers:
        draw(left, layer)
    correlation(rho, ["r", *map(str, names)], ax=right)
    (picture,) = right.images
    own = 3 + 2 * marked
    beside = [(rho[own, k] + rho[own + 1, k + 1]) / 2 for k in range(3, len(rho), 2)]
    alike = {"cmap": picture.get_cmap(), "norm": picture.norm}
    left.scatter(
        *landmarks.T, c=beside, s=50, edgecolors=COLOURS["truth"], linewidths=0.7, zorder=3, **alike
    )
    left.scatter(
        *landmarks[marked], s=260, marker="s", facecolors="none", edgecolors=COLOURS["truth"]
    )
    rim = [withStroke(linewidth=2.5, foreground="#FFFFFF")]  # names stand on ellipses
    for name, place in zip(names, landmarks, strict=True):
        name = left.annotate(str(name), place, xytext=(4, 3), textcoords="offset points")
        name.set(fontsize=9, path_effects=rim)
    if view is not None:
        left.set(xlim=view[:2], ylim=view[2:])
    end = 3 + 2 * (len(names) if room is None else room) - 0.5
    right.set(xlim=(-0.5, end), ylim=(end, -0.5), xlabel="", ylabel="")
    for corner, wide, high in [
        ((-0.5, own - 0.5), len(rho), 2),
        ((own - 0.5, -0.5), 2, len(rho)),
    ]:
        right.add_patch(
            Rectangle(corner, wide, high, fill=False, edgecolor=COLOURS["truth"], linewidth=1.5)
        )
    bar = fig.colorbar(picture, ax=right, shrink=0.8, label="correlation")
    bar.set_ticks([-1, 0, 1])
    return fig, (left, right)
