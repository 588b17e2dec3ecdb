"""Where odometry and scans disagree, a run names what may explain it."""

from dataclasses import replace

import numpy as np
import pytest

from slamlab import sources
from slamlab.estimators.odometry_check import OdometryCheck
from slamlab.sources.calibration_overrides import CalibrationOverrides, OverriddenSource
from tests.slamlab.support import Given

ROOM = sources.open("sim:room", np.random.default_rng(5))
READINGS = list(ROOM)


def report(odometry=None, scan=None):
    """Warnings of a run whose odometry increments and scans were changed."""
    check = OdometryCheck(ROOM.sensor)
    for reading in READINGS:
        if odometry is not None:
            reading = replace(reading, odometry=odometry(reading.odometry))
        if scan is not None:
            reading = replace(reading, scan=scan(reading.scan))
        check.step(reading)
    return " ".join(check.warnings)


def scaled(*factors):
    return lambda odometry: odometry * np.array(factors)


def mirrored(scan):
    return replace(scan, angles=-scan.angles)


def turned(scan):
    return replace(scan, angles=scan.angles + 0.7)


FAULTS = {
    "turns of the other sign": ({"odometry": scaled(1, -1, -1)}, "--turn-scale -1"),
    "a lidar upside down": ({"scan": mirrored}, "--upside-down"),
    "turns that are half": ({"odometry": scaled(1, 1, 0.5)}, "--turn-scale 2"),
    "a dead encoder": ({"odometry": scaled(1, 1, 0)}, "an encoder may be defective"),
    "odometry that stands still": ({"odometry": scaled(0, 0, 0)}, "an encoder may be defective"),
    "millimetres": ({"odometry": scaled(1000, 1000, 1)}, "--odometry-scale 0.001"),
    "distances that are double": ({"odometry": scaled(2, 2, 1)}, "--odometry-scale 0.5"),
    "a scan that is repeated": ({"scan": lambda scan: READINGS[0].scan}, "may repeat an old scan"),
    "a lidar turned on its robot": ({"scan": turned}, "--lidar-yaw -40"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_is_named_with_its_remedy(fault):
    changes, remedy = FAULTS[fault]
    assert remedy in report(**changes)


def test_right_odometry_is_not_suspected():
    assert report() == ""


@pytest.mark.parametrize(
    ("changed", "how"),
    [
        (lambda r: replace(r, odometry=r.odometry * [1, 1, -1]), {"turn_scale": -1.0}),
        (lambda r: replace(r, odometry=r.odometry * [1000, 1000, 1]), {"odometry_scale": 0.001}),
        (lambda r: replace(r, scan=mirrored(r.scan)), {"upside_down": True}),
    ],
)
def test_a_source_read_as_advised_is_as_it_should_have_been(changed, how):
    source = Given(list(map(changed, READINGS)))
    as_advised = OverriddenSource(source, CalibrationOverrides(**how))
    for found, reading in zip(as_advised, READINGS, strict=True):
        np.testing.assert_allclose(found.odometry, reading.odometry, atol=1e-12)
        np.testing.assert_allclose(found.scan.points(), reading.scan.points(), atol=1e-12)
