"""Arguments that ``slamlab live`` refuses before it opens anything."""

import pytest

from slamlab.cli import main


@pytest.mark.parametrize("port", ["-1", "65536", "99999"])
def test_a_port_out_of_range_is_refused(port, capsys):
    assert main(["live", "sim:situation-2", "--no-open", "--port", port]) == 2
    assert f"--port must be from 0 to 65535, not {port}" in capsys.readouterr().err
