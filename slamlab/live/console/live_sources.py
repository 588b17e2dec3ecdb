"""Opening of a console's source, whose devices are stopped when this program ends."""

from contextlib import contextmanager

from slamlab import sources
from slamlab.devices import LIDARS
from slamlab.devices.errors import SlamlabError
from slamlab.devices.port_watchdog_client import opener
from slamlab.devices.recording.recorder import Recorder
from slamlab.devices.transport import open_port
from slamlab.files import SourceError
from slamlab.live.console.drive_lock import LOCK_TIMEOUT
from slamlab.sources.calibration_overrides import override_calibration
from slamlab.sources.live_devices import LiveDevices, devices
from slamlab.sources.opener import SIMULATION_PREFIX
from slamlab.sources.simulated_robot import simulation

RPLIDAR_PREFIX = "devices:"
CHANNELS = "lidar", "emir"


@contextmanager
def source_for(spec, merge=None, tour=False, record=None, carried=False, read=None):
    """Context manager of a source, or of a function of rng that creates a source. SourceError: the
    source cannot be opened. ``merge`` revolutions of a lidar become one scan. ``record`` is a new
    file for all bytes from the devices. ``carried`` has the same meaning as in ``sources.open``.
    ``read`` are the source's CalibrationOverrides, if any.
    """
    if record is not None and not spec.startswith(RPLIDAR_PREFIX):
        raise SourceError(f"--record requires a source devices:..., not {spec}. Omit --record")
    if not spec.startswith(tuple(LIDARS)):
        yield lambda rng: _ready(_opened(spec, rng, tour, carried), merge, read)
        return
    at = spec.index(":") + 1
    prefix, ports = spec[:at], spec[at:]
    openers, recorder = {channel: opener(channel) for channel in CHANNELS}, None
    if prefix != RPLIDAR_PREFIX:
        openers["lidar"] = open_port  # the port watchdog sends an RPLIDAR's stop command
    if record is not None:
        recorder = _recorder(record, ports)
        openers = {name: recorder.opener(name, each) for name, each in openers.items()}
    try:
        with devices(
            ports,
            reconnect=True,
            watchdog=LOCK_TIMEOUT,
            openers=tuple(openers.values()),
            prefix=prefix,
        ) as opened:
            yield _ready(opened, merge, read)
    finally:
        if recorder is not None:
            recorder.close()


def _ready(source, merge, read):
    """Set up a source so that the driving client, not a reading, renews a robot's command."""
    if merge is not None:
        source.merge(merge)
    if isinstance(source, LiveDevices):
        source.renewed_by_readings = False
    return source if read is None else override_calibration(source, read)


def _opened(spec, rng, tour, carried):
    if spec.startswith(SIMULATION_PREFIX):
        return simulation(spec.removeprefix(SIMULATION_PREFIX), rng, tour=tour)
    return sources.open(spec, rng, carried=carried)


def _recorder(path, ports):
    named = zip(CHANNELS, ports.split(","), strict=False)
    # the baud rates are those at which they are opened
    known = {channel: {"port": port, "baud": None} for channel, port in named}
    try:
        return Recorder(path, known)
    except FileExistsError:
        raise SourceError(f"{path} exists. Name a new file") from None
    except (OSError, SlamlabError) as error:
        raise SourceError(f"{path} cannot be written: {error}") from None
