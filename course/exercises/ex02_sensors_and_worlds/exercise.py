"""Exercise 02, sensors and worlds. In this order: ``walls``, ``ray_wall`` (ray casting), ``echo``
(cone of an ultrasonic sensor), ``readings``, ``noise``, ``noise_mistakes`` (noise model), ``beam``
(likelihood of a scan), ``busy_room`` (parameters of the noise, estimated)."""

from classroom.exercises.exercise import Exercise
from course.exercises.ex02_sensors_and_worlds.beam.task import BEAM
from course.exercises.ex02_sensors_and_worlds.busy_room.task import BUSY
from course.exercises.ex02_sensors_and_worlds.echo.task import ECHO
from course.exercises.ex02_sensors_and_worlds.noise.task import NOISE
from course.exercises.ex02_sensors_and_worlds.ray_wall.task import RAY_WALL

EXERCISE = Exercise(
    id="02",
    notebook="02_sensors_and_worlds",
    title="Sensors, odometry and simulated worlds",
    tasks=(RAY_WALL, ECHO, NOISE, BEAM, BUSY),
    calls="course.exercises.ex02_sensors_and_worlds.calls",
    allows=("slamlab.geometry", "slamlab.layers", "slamlab.views"),
    answers=(
        "slamlab.simulation.worlds.ray_casting",
        "slamlab.readings",
        "slamlab.simulation.range_scanners",
        "slamlab.sources",
        "slamlab.simulation.worlds.world",
        "slamlab.simulation.worlds",
    ),
)
