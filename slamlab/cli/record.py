"""``slamlab record devices:LIDAR,EMIR --out FILE``: record all device bytes, timestamped."""

import contextlib
import sys

DEVICES = "devices:"
COUNTED = "turns", "turns dropped", "bytes dropped"


def add_parser(subparsers):
    """Add the command to the command line."""
    parser = subparsers.add_parser(
        "record",
        help="record the bytes of lidar and robot",
        description=(
            "Open lidar and eMIR and record every byte from and to them, until Ctrl-C. Lines typed "
            "meanwhile drive: two numbers V,OMEGA in percent; an empty line stops."
        ),
    )
    parser.add_argument(
        "devices",
        metavar="devices:LIDAR,EMIR",
        help="their ports; the lidar's alone will do",
    )
    parser.add_argument(
        "--out", metavar="FILE", required=True, help="a new file; .gz at its end packs it"
    )
    parser.add_argument("--mode", metavar="NAME", help="the lidar's scan mode, by name or number")
    parser.add_argument("--seconds", metavar="S", type=float, help="end by itself after so long")
    parser.set_defaults(run=run)


def run(arguments) -> int:
    """Record; 0 when ended, 2 when a port or the file cannot be used or is lost."""
    # imported late: what a help text needs should come at once
    from slamlab.devices.errors import SlamlabError
    from slamlab.devices.recording.recorder import Recorder

    spec = arguments.devices
    names = [name.strip() for name in spec.removeprefix(DEVICES).split(",")]
    if not spec.startswith(DEVICES) or len(names) > 2 or not names[0]:
        print(f"slamlab record: {spec!r} is not devices:LIDAR,EMIR", file=sys.stderr)
        return 2
    ports = dict(zip(("lidar", "emir"), names, strict=False))
    bauds = {"lidar": 115200, "emir": 57600}
    known = {name: {"port": port, "baud": bauds[name]} for name, port in ports.items() if port}
    recorder = None
    try:
        with Recorder(arguments.out, known) as recorder:
            counts = _record(recorder, known, arguments.mode, arguments.seconds)
    except FileExistsError:
        print(f"slamlab record: {arguments.out} is there already: name a new file", file=sys.stderr)
        return 2
    except (SlamlabError, OSError) as error:
        print(f"slamlab record: {error}", file=sys.stderr)
        if recorder is not None:
            _keep(recorder)
        return 2
    if recorder.error is not None:
        print(f"slamlab record: {recorder.path} is incomplete: {recorder.error}", file=sys.stderr)
        return 2
    told = ", ".join(f"{name}: {counts[name]}" for name in COUNTED)
    print(f"written to {recorder.path} ({told})")
    return 0


def _keep(recorder):
    """Say where the recording is that ended too early; one of nothing is removed."""
    if recorder.received:
        print(f"what came until then is in {recorder.path}", file=sys.stderr)
    else:
        recorder.path.unlink(missing_ok=True)


def _record(recorder, ports, mode, seconds):
    """Let the devices run until the time is over or Ctrl-C; the lidar's counts."""
    from slamlab.devices.emir import Emir
    from slamlab.devices.rplidar import RPLidar

    with contextlib.ExitStack() as devices:
        emir = None
        if "emir" in ports:
            emir = Emir(ports["emir"]["port"], opener=recorder.opener("emir"))
            devices.enter_context(emir)
        lidar = devices.enter_context(
            RPLidar(ports["lidar"]["port"], opener=recorder.opener("lidar"))
        )
        lidar.start(int(mode) if mode and mode.isdigit() else mode)
        print(f"{lidar} in mode {lidar.mode.name}; Ctrl-C ends the recording", flush=True)
        _driven_by_lines(emir)
        begin = lidar.clock.now()
        with contextlib.suppress(KeyboardInterrupt):
            for _ in lidar:
                if emir is not None:
                    if emir.error is not None:
                        raise emir.error
                    emir.renew()  # somebody watches, and may press Ctrl-C
                if recorder.error is not None:
                    break
                if seconds is not None and lidar.clock.now() - begin > seconds:
                    break
        return lidar.stats


def _driven_by_lines(emir):
    """Let a thread drive by what is typed."""
    import threading

    if emir is not None:
        threading.Thread(target=_drive, args=(emir,), daemon=True).start()


def _drive(emir):
    from slamlab.devices.errors import SlamlabError

    for line in sys.stdin:
        try:
            if line.strip():
                v, omega = (float(word) for word in line.split(","))
                emir.move(v, omega)
            else:
                emir.stop()
        except ValueError:
            print("two numbers: speed, turn rate [%]; or an empty line to stop", file=sys.stderr)
        except SlamlabError:
            return  # the recording says so
