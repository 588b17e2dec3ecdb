"""What tests through real ports share."""

import pytest

from slamlab.devices.emir import session
from slamlab.devices.rplidar import scan_stream
from tests.slamlab.devices.recorded_devices import SCANS, record
from tests.timeouts import PATIENCE


@pytest.fixture
def busy_machine(monkeypatch):
    """Emulators that others on this machine keep from running for a while are not taken for lost.

    How soon a silent device is, tests in simulated time say, and the benchmark in real time.
    """
    for module in (session, scan_stream):
        monkeypatch.setattr(module, "RECEIVE_TIMEOUT", PATIENCE)


@pytest.fixture(scope="session")
def recorded(tmp_path_factory):
    """A path by scan mode: a lidar and a robot, 3 s of each, in simulated time."""
    return {name: record(tmp_path_factory.mktemp("raw") / "a.raw", name) for name in SCANS}
