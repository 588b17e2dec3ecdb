"""Fixture: recordings of real robots, where there are any."""

import pytest

from slamlab import sources


@pytest.fixture(scope="session")
def recording():
    """Path of a recording by its name; where it is missing, the test is skipped."""

    def path(name):
        try:
            return sources.recording(name)
        except sources.SourceError as missing:
            pytest.skip(str(missing))

    return path
