"""What tests of the library share: tables of refusals, given readings, public recordings."""

import pytest

from slamlab import sources


def refuses(call, *cases, error=ValueError):
    """A test that ``call`` refuses each case, (argument, message): the message is a pattern."""

    @pytest.mark.parametrize(("given", "message"), cases)
    def test(given, message):
        with pytest.raises(error, match=message):
            call(given)

    return test


def public(name):
    """The path of a public recording; where it is not on this computer, the test is skipped."""
    try:
        return sources.recording(name)
    except sources.SourceError as missing:
        pytest.skip(str(missing))


class Given(sources.Source):
    """A source of given readings, with the robot and sensor of another and more attributes."""

    name = "given"

    def __init__(self, readings, like=sources.Source, **more):
        super().__init__()
        self.readings, self.robot, self.sensor = readings, like.robot, like.sensor
        vars(self).update(more)

    def __iter__(self):
        return iter(self.readings)

    def __len__(self):
        return len(self.readings)
