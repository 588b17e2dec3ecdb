"""Exercise 02, sensors and worlds: what it asks and what its solutions may import."""

from slamlab.checks.exercise import Exercise
from slamlab.checks.tasks.ex02_fit import FIT
from slamlab.checks.tasks.ex02_noise import NOISE
from slamlab.checks.tasks.ex02_points import TO_POINTS
from slamlab.checks.tasks.ex02_ray import RAY_WALL
from slamlab.checks.tasks.ex02_scan import SCAN

EXERCISE = Exercise(
    id="02",
    notebook="02_sensors_and_worlds",
    title="Sensors and worlds",
    tasks=(RAY_WALL, SCAN, TO_POINTS, NOISE, FIT),
    drives="slamlab.checks.drives.ex02",
    allows=("slamlab.geometry", "slamlab.layers", "slamlab.views"),
    answers=(
        "slamlab.raycast",
        "slamlab.readings",
        "slamlab.sensors",
        "slamlab.sources",
        "slamlab.world",
        "slamlab.worlds",
    ),
)
