"""Sources of a console: what they are made by, and devices whose ports outlive this program."""

from contextlib import contextmanager

from slamlab import sources
from slamlab.console.lease import LENGTH
from slamlab.devices.errors import SlamlabError
from slamlab.devices.kept_port import opener
from slamlab.devices.recording.recorder import Recorder
from slamlab.files.errors import SourceError
from slamlab.sources.live_devices import LiveDevices, devices
from slamlab.sources.opener import DEVICES_PREFIX, SIMULATION_PREFIX
from slamlab.sources.simulated_robot import simulation

CHANNELS = {"lidar": 115200, "emir": 57600}  # and the baud rates of their ports [bit/s]


@contextmanager
def source_for(spec, merge=None, tour=False, record=None):
    """What makes the source of a run, or the source itself where it is a pair of devices.

    Parameters
    ----------
    spec : str, as of :func:`slamlab.sources.open`
    merge : int or None, turns of a lidar that become one scan
    tour : bool, whether a simulated robot drives its tour before it waits for commands
    record : Path or None, a new file for every byte of devices

    Yields
    ------
    callable(rng) -> Source, or Source

    Raises
    ------
    SourceError : it cannot be opened
    """
    if not spec.startswith(DEVICES_PREFIX):
        if record is not None:
            raise SourceError(f"only devices have bytes to record; {spec} is none: leave --record")
        yield lambda rng: _ready(_opened(spec, rng, tour), merge)
        return
    ports = spec.removeprefix(DEVICES_PREFIX)
    openers, recorder = {channel: opener(channel) for channel in CHANNELS}, None
    if record is not None:
        recorder = _recorder(record, ports)
        openers = {name: recorder.opener(name, each) for name, each in openers.items()}
    try:
        with devices(
            ports, reconnect=True, watchdog=LENGTH, openers=tuple(openers.values())
        ) as opened:
            yield _ready(opened, merge)
    finally:
        if recorder is not None:
            recorder.close()


def _ready(source, merge):
    """A source whose robot drives only while its driver says so, not while readings are taken."""
    if merge is not None:
        source.merge(merge)
    if isinstance(source, LiveDevices):
        source.renewed_by_readings = False
    return source


def _opened(spec, rng, tour):
    if spec.startswith(SIMULATION_PREFIX):
        return simulation(spec.removeprefix(SIMULATION_PREFIX), rng, tour=tour)
    return sources.open(spec, rng)


def _recorder(path, ports):
    named = zip(CHANNELS.items(), ports.split(","), strict=False)
    known = {channel: {"port": port, "baud": baud} for (channel, baud), port in named if port}
    try:
        return Recorder(path, known)
    except FileExistsError:
        raise SourceError(f"{path} is there already: name a new file") from None
    except (OSError, SlamlabError) as error:
        raise SourceError(f"{path} cannot be written: {error}") from None
