"""``slamlab run`` and ``record`` on devices behind real ports, and how they end."""

import json
import os
import signal

import pytest

from slamlab import sources
from slamlab.cli import main
from slamlab.devices.emir import commands
from slamlab.devices.recording import load
from slamlab.devices.recording.decoding import revolutions
from slamlab.devices.rplidar.requests import Command
from slamlab.devices.shutdown import TERMINATION_SIGNALS
from tests.slamlab.devices.test_emulator_ports import ENDS, LOCAL, command, needs_pty, running
from tests.timeouts import PATIENCE, until

pytestmark = pytest.mark.usefixtures("busy_machine")
signals = pytest.mark.skipif(os.name != "posix", reason="signals cannot be sent to one there")


def scanned(it, seconds):
    """Whether the lidar has scanned for so long."""
    scan = it["lidar"]._scan
    return scan is not None and scan._taken * scan._mode.period > seconds


def started(it, *words):
    """A command on both devices, once they send and the robot moves."""
    process = command(words[0], "devices:" + ",".join(it.ports.values()), *words[1:])
    until(lambda: scanned(it, 2.0) or process.poll() is not None)
    it["emir"]._drive(20, 30, 1)  # as somebody else drives it
    until(lambda: moving(it))
    return process


def moving(it):
    return it.body._speeds.any()


def ended(process, number):
    process.send_signal(number)
    output, _ = process.communicate(timeout=PATIENCE)
    return output


def assert_at_rest(it):
    """Robot and motor are stopped, both by commands and not by a timeout."""
    until(lambda: it["lidar"].pwm == 0 and it["lidar"]._scan is None and not moving(it))
    assert it["lidar"].requests[-1] == (Command.SET_MOTOR_PWM, b"\0\0")
    assert (commands.STOP, 0, 0) in it["emir"].commands[-3:]


@pytest.mark.slow
@signals
@pytest.mark.parametrize("tcp", ENDS)
def test_ctrl_c_ends_a_live_run_and_what_it_came_to_is_written(tcp, tmp_path):
    with running(tcp) as it:
        process = started(it, "run", "--estimator", "icp", "--out", str(tmp_path))
        output = ended(process, signal.SIGINT)
        assert process.returncode == 130, output
        assert "ended by Ctrl-C" in output and "mapped" in output
        assert_at_rest(it)
    assert json.loads((tmp_path / "summary.json").read_text())["frames"] > 3
    assert (tmp_path / "map.png").exists() and (tmp_path / "trajectory.csv").exists()


@pytest.mark.slow
@signals
def test_ctrl_c_ends_a_live_conversion_with_a_whole_log(tmp_path):
    with running(LOCAL) as it:
        process = started(it, "convert", str(tmp_path / "log.gz"))
        output = ended(process, signal.SIGINT)
        assert process.returncode == 130, output
        assert_at_rest(it)
    log = sources.open(tmp_path / "log.gz")
    assert len(log) > 3 and not log.damage
    assert f"{len(log)} readings written" in output


@pytest.mark.slow
@signals
@pytest.mark.parametrize("word", ["run", "record"])
@pytest.mark.parametrize("number", TERMINATION_SIGNALS)
def test_terminated_the_program_leaves_motor_and_robot_at_rest(word, number, tmp_path):
    with running() as it:
        more = ["--out", str(tmp_path / "a.raw")] if word == "record" else []
        process = started(it, word, *more)
        output = ended(process, number)
        assert process.returncode == -number, output
        assert_at_rest(it)
    if word == "record":
        recording = load(tmp_path / "a.raw")
        assert not recording.truncated and len(list(revolutions(recording))) > 10


@pytest.mark.slow
@needs_pty
def test_a_recording_is_kept_after_a_lost_lidar_and_an_empty_one_is_deleted(tmp_path):
    path = tmp_path / "a.raw.gz"
    with running() as it:
        process = started(it, "record", "--out", str(path))
        it["lidar"].faults.unplugged = True
        output, _ = process.communicate(timeout=PATIENCE)
        assert process.returncode == 1
        assert "What to do: " in output and str(path) in output
        assert len(list(revolutions(load(path)))) > 10
    path.unlink()
    process = command("record", "devices:/dev/ttyNOSUCH0,", "--out", str(path))
    assert "does not exist" in process.communicate(timeout=PATIENCE)[0]
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
@needs_pty
def test_a_lost_lidar_ends_a_run_with_its_results(tmp_path):
    with running() as it:
        process = started(it, "run", "--estimator", "odometry", "--out", str(tmp_path))
        it["lidar"].faults.unplugged = True
        output, _ = process.communicate(timeout=PATIENCE)
        assert process.returncode == 1
        assert "What to do: " in output and "up to that point" in output
        until(lambda: not moving(it))
    assert json.loads((tmp_path / "summary.json").read_text())["frames"] > 3


@pytest.mark.parametrize("word", ["run", "convert"])
def test_the_help_names_live_devices_and_recordings(word, capsys):
    with pytest.raises(SystemExit):
        main([word, "--help"])
    output = " ".join(capsys.readouterr().out.split())
    for words in ("devices:LIDAR_PORT,EMIR_PORT", "raw recording", "sim:WORLD", "--list-sources"):
        assert words in output
