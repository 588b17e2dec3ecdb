"""Pictures for a student's page: a map with trajectories, and a film of the run."""

import numpy as np

from classroom.project.estimate_errors import aligned
from slamlab.geometry import between, compose, transform
from slamlab.layers import Points, Poses, Segments
from slamlab.live.films import FilmRecorder, page
from slamlab.live.frame_packing import Scene
from slamlab.live.voxel_filter import VoxelFilter
from slamlab.views.colours import COLOURS

WIDTH, MARGIN = 640, 0.6  # of a map [pixels, m]
CELL = 0.1  # cell size of the grid that thins the points of the film [m]


def in_the_world(poses, world):
    """Move poses (n, 3) so that the first one equals the true first pose (in a log: the origin)."""
    start = np.zeros(3) if world.truth is None else world.truth.poses[0]
    return compose(start, between(poses[0], poses)) if len(poses) else poses


def _frame(prepared_world):
    """Return the lowest and highest x and y of the walls (in a log: of the baselines' poses)."""
    if prepared_world.world.truth is None:
        own = [
            in_the_world(run.online, prepared_world.world) for run in prepared_world.runs.values()
        ]
        corners = np.concatenate(own)[:, :2]
    else:
        corners = prepared_world.world.floor.outline().reshape(-1, 2)
    return corners.min(axis=0) - MARGIN, corners.max(axis=0) + MARGIN


def _near(rows, prepared_world):
    """Return (n,) bool: whether each row (n, 2 or 3) is finite and near the picture."""
    low, high = _frame(prepared_world)
    size = (high - low).max()
    inside = (rows[:, :2] > low - size) & (rows[:, :2] < high + size)
    return np.isfinite(rows).all(axis=1) & inside.all(axis=1)


def map_picture(prepared_world, run, error=None):
    """Draw a map as SVG: walls, true trajectory (not in a log), odometry and estimate.

    error : LargeError to mark on the true trajectory, or None."""
    world = prepared_world.world
    odometry = in_the_world(prepared_world.runs["odometry"].online, world)
    online = in_the_world(run.online, world)
    if world.truth is None:
        walls, truth = np.empty((0, 4)), np.empty((0, 3))
        title = "Two trajectories of a recorded log: odometry, estimate"
    else:
        walls, truth = world.floor.outline(), world.truth.poses
        title = "Map of the world with three trajectories: ground truth, odometry, estimate"
    low, high = _frame(prepared_world)
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
    if error is not None:
        x, y = points(truth[error.reading - 1 : error.reading, :2]).split(",")
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


def film_page(prepared_world, run, title, file):
    """Create the HTML page of a film that shows a run with ground truth and odometry.

    Each frame shows a reading, with scans at the estimated poses. The last frame shows the final
    estimates of trajectory and map. file : temporary file of the film."""
    shown = "" if prepared_world.world.truth is None else "walls, the true trajectory, "
    alt = (
        f"A map of the world from above, reading by reading: {shown}odometry, "
        "the estimated trajectory, and the scans at the estimated poses."
    )
    with FilmRecorder(file, title, alt) as film:
        for scene in _scenes(prepared_world, run):
            film.add(scene)
    try:
        return page(file)
    finally:
        file.unlink()


def _scenes(prepared_world, run):
    world = prepared_world.world
    known_track = world.truth is not None
    truth = world.truth.poses if known_track else None
    walls = Segments("walls", world.floor.outline()) if known_track else None
    odometry = in_the_world(prepared_world.runs["odometry"].online, world)
    online = in_the_world(run.online, world)
    known = _near(online, prepared_world)
    cloud, cells = np.empty((0, 2)), VoxelFilter(CELL)
    for i, reading in enumerate(prepared_world.readings):
        if known[i] and reading.scan is not None:
            seen = transform(online[i], reading.scan.points())
            cloud = np.concatenate([cloud, cells.add(seen)])
        own = online[: i + 1][known[: i + 1]]
        status = f"reading {i + 1} of {len(online)}"
        if known_track:
            status += f", {world.metres[i]:.1f} m"
        so_far = truth[: i + 1] if known_track else None
        yield _scene(walls, so_far, odometry[: i + 1], own, cloud, status)
    # without ground truth the final trajectory is aligned to the online one
    there = truth if known_track else online
    motion = aligned(np.where(np.isfinite(there), run.trajectory, np.nan), there)
    final = run.trajectory[np.isfinite(run.trajectory).all(axis=1)]
    laid, points = compose(motion, final) if len(final) else final, transform(motion, run.points)
    laid, points = laid[_near(laid, prepared_world)], points[_near(points, prepared_world)]
    yield _scene(walls, truth, odometry, laid, points, "the trajectory and the map at the end")


def _scene(walls, truth, odometry, own, points, status):
    layers = [Points("map", points), Poses("naive", odometry), Poses("corrected", own)]
    if truth is not None:
        layers = [walls, layers[0], Poses("truth", truth), *layers[1:]]
    return Scene(layers, status)
