"""What tests through real ports share."""

import pytest

from slamlab.devices.emir import session
from slamlab.devices.rplidar import scan_stream
from tests.timeouts import PATIENCE


@pytest.fixture
def busy_machine(monkeypatch):
    """Emulators that others on this machine keep from running for a while are not taken for lost.

    How soon a silent device is, tests in simulated time say, and the benchmark in real time.
    """
    for module in (session, scan_stream):
        monkeypatch.setattr(module, "RECEIVE_TIMEOUT", PATIENCE)
