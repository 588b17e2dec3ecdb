"""Exercise 02, sensors and worlds: what it asks and what its solutions may import."""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex02_fit import FIT
from slamlab.exercises.tasks.ex02_noise import NOISE
from slamlab.exercises.tasks.ex02_points import TO_POINTS
from slamlab.exercises.tasks.ex02_ray import RAY_WALL
from slamlab.exercises.tasks.ex02_scan import SCAN

EXERCISE = Exercise(
    id="02",
    notebook="02_sensors_and_worlds",
    title="Sensors and worlds",
    tasks=(RAY_WALL, SCAN, TO_POINTS, NOISE, FIT),
    drives="slamlab.exercises.drives.ex02",
    allows=("slamlab.geometry", "slamlab.layers", "slamlab.views"),
    answers=(
        "slamlab.worlds.ray_casting",
        "slamlab.readings",
        "slamlab.simulation.range_scanners",
        "slamlab.sources",
        "slamlab.worlds.world",
        "slamlab.worlds",
    ),
)
