"""``python -m course.studies.ultrasound_walls``: Monte Carlo runs of wall SLAM with ultrasonic
ranges, in the room of lesson 01.

The study compares odometry, lines from the sensor's cone model, and lines from RANSAC without the
cone.
"""

import sys
from dataclasses import replace

import numpy as np

from course.studies import foot_point_ablation, study_command
from course.studies.line_extraction_errors import expected_from, lines_of
from course.studies.study_command import TABLES, first_runs, package_versions, rounded, seeds
from course.studies.wall_slam_faults import errors
from slamlab.estimators.dead_reckoning import DeadReckoning
from slamlab.estimators.wall_slam import GATE, WallSlam
from slamlab.evaluation import band, nees, pose_nees
from slamlab.geometry import wrap
from slamlab.landmarks.sonar_lines import sonar_lines
from slamlab.parallel import map_runs
from slamlab.simulation.range_scanners import ULTRASONIC
from slamlab.sources.simulated_robot import THESIS_ROBOT, simulation

TABLE = TABLES / "ultrasound_walls.json"
WORLD = "room-ultrasonic"
LEAST = foot_point_ablation.LEAST
BEARING_SPANS = (0, 10, 20, 25, 30)  # minimum range of bearings over which a wall is observed [deg]
INCIDENCES = (90, 30, 20, 10)  # beyond which a smooth wall reflects the sound away [deg]
STEPS = slice(15, 80, 13)  # at which NEES is taken
CONE, RAYS, SLIP, WHEELS = "cone model", "lidar's lines", "cone model, wheels slip", "odometry"


def rays(sensor):
    """Return the sensor model without its cone."""
    return replace(sensor, half_cone=0.0)


def is_no_wall(line, pose, walls):
    """Return whether a line observed at a true pose is outside the gate of every wall (n, 4)
    [m]."""
    off = line.z - expected_from(pose, lines_of(walls))
    off[:, 1] = wrap(off[:, 1])
    return bool(nees(off, np.broadcast_to(line.R, (len(off), 2, 2))).min() > GATE)


def errors_of(seed):
    """Evaluate one run; return dicts from name to (rms [m], NEES (2, 5) in the map and along arcs,
    walls), slope to (lines, false lines), incidence to (echoes, lines)."""
    source = simulation(WORLD, np.random.default_rng(seed))
    slipping = simulation(WORLD, np.random.default_rng(seed), robot=THESIS_ROBOT)
    rng = np.random.default_rng(0)
    found = {
        WHEELS: _driven(source, DeadReckoning()),
        RAYS: _driven(source, WallSlam(source.robot, rays(source.sensor), rng)),
        CONE: _driven(source, WallSlam(source.robot, source.sensor, rng)),
        SLIP: _driven(slipping, WallSlam(slipping.robot, slipping.sensor, rng)),
    }
    readings = list(source)
    for slope in BEARING_SPANS:
        no_wall = [
            is_no_wall(line, pose, source.world.walls)
            for reading, pose in zip(readings, source.truth.poses, strict=True)
            for line in sonar_lines(reading.scan, ULTRASONIC.model, np.radians(slope))
        ]
        found[f"slope {slope}"] = len(no_wall), sum(no_wall)
    for incidence in INCIDENCES:
        mirror = replace(ULTRASONIC, max_incidence=np.radians(incidence))
        scans = [r.scan for r in simulation(WORLD, np.random.default_rng(seed), lidar=mirror)]
        count = sum(len(sonar_lines(scan, ULTRASONIC.model)) for scan in scans)
        found[f"incidence {incidence}"] = sum(scan.valid.sum() for scan in scans), count
    return found


def _driven(source, slam):
    poses, P = [], []
    for reading in source:
        slam.step(reading)
        poses.append(slam.pose.copy())
        if hasattr(slam, "filter"):
            P.append(slam.filter.block([0, 1, 2]))
    poses = np.array(poses)
    off = errors(source, poses)
    rms = np.sqrt(np.mean(np.sum(off[:, :2] ** 2, axis=1)))
    if not P:
        return rms, np.full((2, 5), np.nan), 0
    P, true = np.array(P)[STEPS], source.truth.poses[STEPS]
    size = nees(off[STEPS], P), pose_nees(poses[STEPS], P, true)
    return rms, np.array(size), len(slam.filter.ids)


def study(runs, jobs=None, scheduler=None):
    """Make the tables: medians [m], paired differences to odometry, mean NEES, lines by slope and
    incidence [degree]; raise ValueError for fewer than 6 runs."""
    results = map_runs(errors_of, seeds(runs, LEAST), jobs, scheduler)
    wheels = np.array([one[WHEELS][0] for one in results])
    errors_by_name = {}
    for name in (WHEELS, RAYS, CONE):
        off = np.array([one[name][0] for one in results])
        walls = np.median([one[name][2] for one in results])
        errors_by_name[name] = foot_point_ablation.row(off, wheels) | {
            "better": np.sum(off < wheels),
            "walls": walls,
        }
    sizes = {name: np.mean([one[name][1] for one in results], axis=0) for name in (CONE, SLIP)}
    return {
        "versions": package_versions(),
        "seeds": [0, runs - 1],
        "first_runs": first_runs(results),
        "band_95": band(3, runs),
        "drives": rounded(errors_by_name),
        "nees": {name: row[0].round(4).tolist() for name, row in sizes.items()},
        "nees_along_arcs": {name: row[1].round(4).tolist() for name, row in sizes.items()},
        "slopes": [
            dict(zip(("degrees", "lines", "no_wall"), _sums(results, "slope", each), strict=True))
            for each in BEARING_SPANS
        ],
        "incidences": [
            dict(
                zip(("degrees", "echoes", "lines"), _sums(results, "incidence", each), strict=True)
            )
            for each in INCIDENCES
        ],
    }


def _sums(results, name, degrees):
    counts = np.sum([one[f"{name} {degrees}"] for one in results], axis=0)
    return [degrees, *map(int, counts)]


def main(argv=None):
    return study_command.main("ultrasound_walls", 20, study, argv)


if __name__ == "__main__":
    sys.exit(main())
