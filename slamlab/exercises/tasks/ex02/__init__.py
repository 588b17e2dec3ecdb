"""Exercise 02, sensors and worlds: what it asks and what its solutions may import.

- ``walls``: beams and walls in general; ``ray``: how far a beam flies to a wall
- ``echo``: the nearest place in a cone of sound; ``points``: a device's readings in the world
- ``readings``, ``noise``, ``noise_mistakes``: readings as a real sensor makes them
- ``busy``: how noisy a sensor in a busy room is
"""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex02.busy import BUSY
from slamlab.exercises.tasks.ex02.echo import ECHO
from slamlab.exercises.tasks.ex02.noise import NOISE
from slamlab.exercises.tasks.ex02.points import TO_POINTS
from slamlab.exercises.tasks.ex02.ray import RAY_WALL

EXERCISE = Exercise(
    id="02",
    notebook="02_sensors_and_worlds",
    title="Sensors and worlds",
    tasks=(RAY_WALL, ECHO, TO_POINTS, NOISE, BUSY),
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
