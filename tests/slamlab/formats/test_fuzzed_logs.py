"""Mutated logs of every kind raise nothing but a SourceError, or give readings that make sense."""

import numpy as np
import pytest
from hypothesis import given, settings

from slamlab import sources
from slamlab.sources import SourceError
from tests.slamlab.formats import carmen_writing as carmen
from tests.slamlab.formats import test_rplidar_text as rplidar
from tests.slamlab.formats.mutations import mutated
from tests.slamlab.test_other_logs import breezy_lines

WILD = [
    *(b"nan", b"inf", b"-inf", b"1e308", b"1e39", b"-1", b"0", b"9" * 40, b"1e8", b"0x10", b"1_0"),
    *(b"", b"\xff\xfe", b"\xef\xbb\xbf", b"\0", b"FLASER", b"True", b"[(", b"}", b"#COUNT=1", b";"),
]


def joined(lines):
    return "\n".join(lines).encode() + b"\n"


LOGS = {
    "CARMEN": joined(
        [
            carmen.param("laser_front_laser_fov", 180),
            carmen.param("laser_front_laser_flipped", 1),
            *carmen.LINES[:8],
            *carmen.log(carmen.robotlaser)[8:12],
            *carmen.log(carmen.rawlaser)[:6],
            *carmen.odoms()[:30],
        ]
    ),
    "gfs": joined(carmen.gfs()[:40]),
    "SDK": joined(rplidar.SDK[:560]),
    "RoboStudio": joined(rplidar.READ["RoboStudio, one scan after the other"][:560]),
    "tuples": joined(rplidar.READ["measurements a line"][:560]),
    "lists": joined(rplidar.READ["scans a line"][:3]),
    "dictionaries": joined(rplidar.READ["dictionaries"][:560]),
    "table": joined(rplidar.READ["table with dates"][:560]),
    "columns": joined(rplidar.READ["columns angle, distance"][:560]),
    "BreezySLAM": joined(breezy_lines([(10 * k, 12 * k) for k in range(6)])),
}


@pytest.mark.parametrize("kind", LOGS)
def test_mutated_logs_raise_nothing_but_a_source_error(tmp_path, kind):
    path = tmp_path / "log"

    @settings(max_examples=60, derandomize=True, database=None)
    @given(mutated(LOGS[kind], WILD))
    def law(content):
        path.write_bytes(content)
        try:
            source = sources.open(path)
        except SourceError as refused:
            assert "\n" not in str(refused) and str(path) in str(refused)
            return
        readings = list(source)
        assert len(readings) == len(source) > 0
        for reading in readings:
            assert np.isfinite(reading.time)
            assert (reading.odometry is None) == (not source.has_odometry)
            assert reading.odometry is None or np.isfinite(reading.odometry).all()
            scan = reading.scan
            assert len(scan.angles) == len(scan.ranges) and np.isfinite(scan.angles).all()
            assert np.isfinite(scan.points()).all()
            assert scan.times is None or np.isfinite(scan.times).all()

    law()
