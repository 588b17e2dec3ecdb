"""``slamlab record devices:LIDAR,EMIR --out FILE``: record the devices' bytes and their times.

A port is ``/dev/ttyUSB0`` or, with its baud rate, ``/dev/ttyUSB0@256000``. Without a port, the
command searches for a lidar.
"""

import contextlib
import sys
import threading

from slamlab.cli.common import FAILED, refuse
from slamlab.cli.parsers import add_command

DEVICES = "devices:"
CHANNELS = "lidar", "emir"
COUNTED = "revolutions", "revolutions dropped", "bytes dropped"  # others where they are not 0
EMIR_COUNTED = "bad frames", "bytes dropped", "reconnects"


def add_parser(subparsers):
    parser = add_command(
        subparsers,
        "record",
        "Record every byte from and to an RPLIDAR and an eMIR robot.",
        "devices: --out flat.rec.gz",
        "devices:/dev/ttyUSB0@256000 --out drive.rec --seconds 60",
    )
    ports = "Ports, each with an optional @BAUD; EMIR is optional (default: search for a lidar)"
    add = parser.add_argument
    add("devices", metavar="devices:LIDAR,EMIR", nargs="?", default=DEVICES, help=ports)
    out = "New file to write; compressed if its name ends in .gz"
    add("--out", metavar="FILE", required=True, help=out)
    mode = "Scan mode of the lidar, by name or number (default: the recommended one)"
    add("--mode", metavar="NAME", help=mode)
    seconds = "Length of the recording [s] (default: until Ctrl-C)"
    add("--seconds", metavar="S", type=float, help=seconds)
    parser.set_defaults(run=run)


def run(arguments) -> int:
    # imported late: a help text should come at once
    from slamlab.devices.errors import SlamlabError
    from slamlab.devices.recording.recorder import Recorder
    from slamlab.devices.serial_ports import find_lidar_port, split_baud

    spec = arguments.devices
    names = [name.strip() for name in spec.removeprefix(DEVICES).split(",")]
    if not spec.startswith(DEVICES) or len(names) > 2:
        return refuse("record", f"{spec!r} must be devices:LIDAR,EMIR, such as devices:COM3")
    recorder = None
    try:
        if not split_baud(names[0])[0]:
            names[0] = find_lidar_port() + names[0]
        ports = {channel: port for channel, port in zip(CHANNELS, names, strict=False) if port}
        # the baud rates are those at which they are opened
        known = {name: {"port": split_baud(port)[0], "baud": None} for name, port in ports.items()}
        with Recorder(arguments.out, known) as recorder:
            counts = _record(recorder, ports, arguments.mode, arguments.seconds)
    except FileExistsError:
        return refuse("record", f"{arguments.out} exists. Name a new file with --out")
    except (SlamlabError, OSError) as error:
        code = refuse("record", error)
        if recorder is not None and recorder.received:
            print(f"{recorder.path} contains the bytes received before the error.", file=sys.stderr)
            return FAILED
        elif recorder is not None:
            recorder.path.unlink(missing_ok=True)
        return code
    if recorder.error is not None:
        refuse("record", f"{recorder.path} is incomplete: {recorder.error}")
        return FAILED
    counted = ", ".join(f"{name}: {n}" for name, n in counts.items() if n or name in COUNTED)
    print(f"written to {recorder.path} ({counted})")
    return 0


def _record(recorder, ports, mode, seconds):
    from slamlab.devices.emir import Emir
    from slamlab.devices.rplidar import RPLidar

    with contextlib.ExitStack() as devices:
        emir = None
        if "emir" in ports:
            emir = devices.enter_context(Emir(ports["emir"], opener=recorder.opener("emir")))
        lidar = devices.enter_context(RPLidar(ports["lidar"], opener=recorder.opener("lidar")))
        _start(lidar, int(mode) if mode and mode.isdecimal() else mode)
        at = f"at {lidar.baud} baud in mode {lidar.mode.name}"
        print(f"{lidar} {at}; press Ctrl-C to end the recording", flush=True)
        if emir is not None:
            threading.Thread(target=_drive_by_lines, args=(emir,), daemon=True).start()
        with contextlib.suppress(KeyboardInterrupt):
            _take_turns(lidar, emir, recorder, seconds)
        counts = {name: n for name, n in lidar.stats.items() if name != "bytes"}
        if emir is not None:
            counts |= {f"eMIR's {name}": emir.stats[name] for name in EMIR_COUNTED}
        return counts


def _start(lidar, mode):
    """Start a scan in the given mode or, if the lidar does not have it, in the standard mode."""
    from slamlab.devices.errors import UnsupportedMode

    try:
        lidar.start(mode)
    except UnsupportedMode as error:
        print(f"warning: {error.what}. The lidar scans in mode 0; {error.step}", file=sys.stderr)
        lidar.start(0)


def _take_turns(lidar, emir, recorder, seconds):
    """Record revolutions until the recording time is over, and print each warning once."""
    begin, warned = lidar.clock.now(), set()
    for _ in lidar:
        for warning in set(lidar.warnings) - warned:
            warned.add(warning)
            print(f"warning: {warning}", file=sys.stderr, flush=True)
        if emir is not None:
            if emir.error is not None:
                raise emir.error
            emir.renew()  # the user watches, and may press Ctrl-C
        if recorder.error is not None:
            return
        if seconds is not None and lidar.clock.now() - begin > seconds:
            return


def _drive_by_lines(emir):
    from slamlab.devices.errors import SlamlabError

    for line in sys.stdin:
        try:
            if line.strip():
                v, omega = (float(word) for word in line.split(","))
                emir.move(v, omega)
            else:
                emir.stop()
        except ValueError:
            print("Type speed and turn rate [%], as in 20,5; press Enter to stop.", file=sys.stderr)
        except SlamlabError:
            return  # the recording ends with this error
