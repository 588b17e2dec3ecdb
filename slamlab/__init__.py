"""A library for simultaneous localisation and mapping (SLAM) in the plane, small enough to read.

A source yields readings, from which an estimator estimates the pose and the map. Each module or
subpackage imports only those above it in this list, which is in the order of the data flow:

geometry      poses in the plane: angle wrapping, composition, rigid transformations
readings      sensor data: scans, landmark observations, odometry increments
deskewing     correction of motion distortion (deskewing), merging of scans
layers        layers of an estimator's drawing, as plain arrays
extras        messages about missing optional packages
files         text files, plain or compressed, complete or truncated
parallel      Monte Carlo trials on processes or a Dask cluster
models        motion models, measurement models, Jacobians, noise, SymPy derivations
simulation    worlds, exact ray casting, range scanners, a differential-drive robot
devices       RPLIDAR and eMIR: drivers, emulators, raw recordings
landmarks     line extraction by RANSAC, corners, track management
scanmatching  ICP, scan-to-map matching, submaps: ``match``
filters       Kalman filter, EKF-SLAM, set-membership filter, particle filters, data association
posegraph     pose-graph optimisation (Gauss-Newton), robust kernel, marginal covariances
gridmap       occupancy grids, ROS map_server files
sources       simulations, logs, recordings, live devices: ``sources.open``
estimators    SLAM algorithms, loop closure: ``estimators.make``, ``estimators.run``
evaluation    consistency (NEES), trajectory errors, relations error
views         drawings: figures, sliders
live          live views in a notebook or a browser, films, an editor for worlds
cli           the command ``slamlab``, to which other packages can add subcommands

Units: metres, radians, seconds. A pose is ``[x, y, theta]`` with theta counter-clockwise from +x.
"""

__version__ = "0.1.0"
