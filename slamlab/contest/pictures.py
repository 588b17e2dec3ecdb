"""What a student's page shows of a world: a map with the tracks, and a film of the drive."""

import numpy as np

from slamlab.films import FilmRecorder, page
from slamlab.geometry import between, compose, transform
from slamlab.layers import Points, Poses, Segments
from slamlab.project.drive_errors import aligned
from slamlab.views.colours import COLOURS
from slamlab.views.live.frame_packing import Scene
from slamlab.views.live.thinning import FirstOfCells

WIDTH, MARGIN = 640, 0.6  # of a map [pixels, m]
CELL = 0.1  # of the film's points one a cell is kept [m]


def in_the_world(poses, world):
    """Poses as given online, moved so that the first one is the true one: (n, 3).

    In a recorded log, whose truth nobody knows, so that it is the origin.
    """
    start = np.zeros(3) if world.truth is None else world.truth.poses[0]
    return compose(start, between(poses[0], poses)) if len(poses) else poses


def _frame(arena):
    """Lowest and highest x and y of a picture: of the walls, in a log of the package's own tracks.

    Not of the estimate's: who runs off leaves the picture, and does not make it endless.
    """
    if arena.world.truth is None:
        own = [in_the_world(driven.online, arena.world) for driven in arena.drives.values()]
        corners = np.concatenate(own)[:, :2]
    else:
        corners = arena.world.floor.outline().reshape(-1, 2)
    return corners.min(axis=0) - MARGIN, corners.max(axis=0) + MARGIN


def _near(rows, arena):
    """Which rows (n, 2 or 3) are finite and in the picture, or beside it by its size at most."""
    low, high = _frame(arena)
    size = (high - low).max()
    inside = (rows[:, :2] > low - size) & (rows[:, :2] < high + size)
    return np.isfinite(rows).all(axis=1) & inside.all(axis=1)


def map_picture(arena, drive, moment=None):
    """Draw a map of a world: its walls, the true track, odometry's and the estimate's.

    Of a recorded log, which has neither walls nor truth, the two tracks.

    Parameters
    ----------
    arena : Arena
    drive : Drive
    moment : Moment or None, which is marked on the true track

    Returns
    -------
    str, SVG
    """
    world = arena.world
    odometry = in_the_world(arena.drives["odometry"].online, world)
    online = in_the_world(drive.online, world)
    if world.truth is None:
        walls, truth = np.empty((0, 4)), np.empty((0, 3))
        title = "Two tracks of a recorded log: odometry, estimate"
    else:
        walls, truth = world.floor.outline(), world.truth.poses
        title = "Map of the world with three tracks: true, odometry, estimate"
    low, high = _frame(arena)
    scale = WIDTH / (high[0] - low[0])
    height = scale * (high[1] - low[1])

    def points(xy):
        x, y = ((xy - low) * scale).T
        return " ".join(f"{a:.1f},{height - b:.1f}" for a, b in zip(x, y, strict=True))

    def track(poses, name):
        poses = poses[np.isfinite(poses).all(axis=1)]
        line = f'<polyline points="{points(poses[:, :2])}" stroke="{COLOURS[name]}"'
        return f'{line} fill="none" stroke-width="2"/>'

    segments = "".join(
        f'<polyline points="{points(wall.reshape(2, 2))}" stroke="{COLOURS["walls"]}"/>'
        for wall in walls
    )
    marked = ""
    if moment is not None:
        x, y = points(truth[moment.reading - 1 : moment.reading, :2]).split(",")
        colour = COLOURS["robot"]
        marked = (
            f'<circle cx="{x}" cy="{y}" r="14" fill="none" stroke="{colour}" stroke-width="4"/>'
        )
    return (
        f'<svg viewBox="0 0 {WIDTH} {height:.0f}" role="img" xmlns="http://www.w3.org/2000/svg">'
        f"<title>{title}</title>{segments}"
        f"{track(odometry, 'naive')}{track(truth, 'truth')}"
        f"{track(online, 'corrected')}{marked}</svg>"
    )


def film_page(arena, drive, title, file):
    """Record a film of a drive beside truth and odometry, and make its page.

    A frame a reading: scans are drawn where the robot was believed to be; the last frame shows the
    trajectory and the map as they were given at the end.

    Parameters
    ----------
    arena : Arena
    drive : Drive
    title : str
    file : Path, of the film, beside which nothing is left

    Returns
    -------
    str, HTML
    """
    shown = "" if arena.world.truth is None else "walls, the true track, "
    alt = (
        f"A map of the world from above, reading by reading: {shown}odometry's track, "
        "the estimate's, and the scans where the estimate put them."
    )
    with FilmRecorder(file, title, alt) as film:
        for scene in _scenes(arena, drive):
            film.add(scene)
    try:
        return page(file)
    finally:
        file.unlink()


def _scenes(arena, drive):
    world = arena.world
    known_track = world.truth is not None
    truth = world.truth.poses if known_track else None
    walls = Segments("walls", world.floor.outline()) if known_track else None
    odometry = in_the_world(arena.drives["odometry"].online, world)
    online = in_the_world(drive.online, world)
    known = _near(online, arena)
    cloud, cells = np.empty((0, 2)), FirstOfCells(CELL)
    for i, reading in enumerate(arena.readings):
        if known[i] and reading.scan is not None:
            seen = transform(online[i], reading.scan.points())
            cloud = np.concatenate([cloud, cells.add(seen)])
        own = online[: i + 1][known[: i + 1]]
        status = f"reading {i + 1} of {len(online)}"
        if known_track:
            status += f", {world.metres[i]:.1f} m of way"
        so_far = truth[: i + 1] if known_track else None
        yield _scene(walls, so_far, odometry[: i + 1], own, cloud, status)
    # where there is no truth the track of the end is laid on what was given online
    there = truth if known_track else online
    motion = aligned(np.where(np.isfinite(there), drive.trajectory, np.nan), there)
    final = drive.trajectory[np.isfinite(drive.trajectory).all(axis=1)]
    laid, points = compose(motion, final) if len(final) else final, transform(motion, drive.points)
    laid, points = laid[_near(laid, arena)], points[_near(points, arena)]
    yield _scene(walls, truth, odometry, laid, points, "the trajectory and the map at the end")


def _scene(walls, truth, odometry, own, points, status):
    layers = [Points("map", points), Poses("naive", odometry), Poses("corrected", own)]
    if truth is not None:
        layers = [walls, layers[0], Poses("truth", truth), *layers[1:]]
    return Scene(layers, status)
