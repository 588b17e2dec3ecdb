"""Exercise 12, three filters and one robot: what it asks and what its solutions may import.

- ``odometry``: ticks of two encoders to a motion, the lesson's own derivation
- ``lost``, ``interval``: what a study counts, and how sure it is
- ``paired``: the reasoning of ``interval``, for the median of what is different on the same drive
- ``hall``: drives among posts that look alike, in which the robot is lifted away
- ``relocalise``: a filter that notices it, and finds itself again
"""

from slamlab.exercises.exercise import Exercise
from slamlab.exercises.tasks.ex12.interval import INTERVAL
from slamlab.exercises.tasks.ex12.lost import LOST
from slamlab.exercises.tasks.ex12.odometry import ODOMETRY
from slamlab.exercises.tasks.ex12.paired import PAIRED
from slamlab.exercises.tasks.ex12.relocalise import RELOCALISE

EXERCISE = Exercise(
    id="12",
    notebook="12_three_filters",
    title="Three filters, one robot",
    tasks=(ODOMETRY, LOST, INTERVAL, PAIRED, RELOCALISE),
    drives="slamlab.exercises.drives.ex12",
    allows=("slamlab.geometry", "slamlab.layers", "slamlab.views"),
    answers=(
        "slamlab.estimators",
        "slamlab.simulation.wall_follower",
        "slamlab.simulation.differential_drive",
        "slamlab.sources",
        "slamlab.studies",
    ),
)
