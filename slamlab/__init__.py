"""Simultaneous localisation and mapping, small enough to read.

A source yields readings, an estimator takes them in and believes a pose and a map. The rooms, along
the data's way:

geometry         poses in the plane: wrapping angles, composition, transforms
readings         what every source yields: scans, landmark observations, odometry
layers           what an estimator shows: named layers of plain arrays
files            text files, published recordings
displays         what a notebook shows, in a form that its file keeps
models           motion and observation models, their Jacobians, noise, derivation by sympy
worlds           walls and circles, exact ray casting, ready worlds
simulation       range scanners, a differential-drive robot with encoders, a wall follower
devices          RPLIDAR and eMIR: drivers, emulators, raw recordings
sources          simulations, logs, recordings, live devices: ``sources.open``
landmarks        walls' lines by RANSAC, corners, tentative and confirmed landmarks
scanmatching     ICP and scan-to-map matching: ``match``
filters          Kalman filter, EKF-SLAM (``MAK``), boxes (``BOR``), particle filters
posegraph        pose-graph optimisation, robust kernel, marginal covariances
gridmap          occupancy grids
estimators       every SLAM of the course: ``estimators.make``, ``estimators.run``
evaluation       NEES, trajectory errors, relations
views            every drawing and widget: figures, sliders, the live view, the world editor
films            recordings of a live view's frames, and the page that plays one

The course's own machinery:

derivation       derivations line by line, each line checked by machine: ``derive``
exercises        what each task asks, and the laws its answers are judged by
project          worlds nobody has seen, and what a student's own SLAM is worth in them
coursework       a student's folder: progress, reset, update
parallel         many runs on processes or a Dask cluster
grading          judge, sandbox, gradebook, late policy, likeness
contest          a class's own SLAMs on the same hidden worlds: a board, a page each
checks           what notebooks call: ``check``, ``hint``, ``ask``, ``validate``
lecturing        a lesson's slides rehearsed and printed, in a browser without a window
studies          tables of many runs, each made by a command
listening        one guard for whatever listens on the network
reviewing        a class's marks in a page, changed by hand: ``slamlab grade review``
console          SLAM live in a page of the browser, driven there: ``slamlab live``
audience         a lecture's class: its phones see the slide and are asked; ``audience.start``
cli              the command ``slamlab``

Each room imports only rooms that stand above it in this list.

Metres, radians, seconds. A pose is ``[x, y, theta]`` with theta counter-clockwise from +x.
"""

from slamlab import _renamed

__version__ = "0.1.0"

_renamed.install()
