"""What ``slamlab live`` refuses before anything is opened."""

import pytest

from slamlab.cli import main


@pytest.mark.parametrize("port", ["-1", "65536", "99999"])
def test_a_port_that_there_is_none_of_is_refused(port, capsys):
    assert main(["live", "sim:situation-2", "--no-open", "--port", port]) == 2
    assert f"--port is 0 to 65535, not {port}" in capsys.readouterr().err
