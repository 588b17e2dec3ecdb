"""``slamlab emulate``: emulate an RPLIDAR on an eMIR, behind pseudo-terminals or TCP ports."""

import contextlib
import sys
import threading


def add_parser(subparsers):
    """Add the command to the command line."""
    parser = subparsers.add_parser(
        "emulate",
        help="emulate an RPLIDAR on an eMIR, behind two ports",
        description=(
            "Emulate an RPLIDAR A2M8 on an eMIR in a world. Programs open the two ports that are "
            "printed as if the devices hung there. Runs until Ctrl-C; faults can be typed "
            "meanwhile: any other word lists them."
        ),
    )
    parser.add_argument("--world", metavar="WORLD", default="polygon", help="a ready world or file")
    add_ports(parser)
    parser.add_argument("--firmware", metavar="X.Y", default="1.29", help="the lidar's (1.29)")
    parser.add_argument(
        "--typical", metavar="MODE", type=int, default=2, help="0 standard, 1 express, 2 boost (2)"
    )
    parser.add_argument("--stopped", action="store_true", help="the motor stands until it is told")
    parser.add_argument(
        "--saturates", action="store_true", help="eMIR's counters stop at their end"
    )
    parser.add_argument(
        "--watchdog", metavar="S", type=float, help="eMIR stops without commands for so long"
    )
    parser.add_argument(
        "--fault",
        metavar="TEXT",
        action="append",
        default=[],
        help="a fault from the start, such as 'flip lidar 0.0001'; may be repeated",
    )
    parser.add_argument("--seed", metavar="N", type=int, default=0, help="of noise, slip, damage")
    parser.set_defaults(run=run)


def run(arguments) -> int:
    """Emulate; 0 when ended, 2 when something is wrong with the words or the ports."""
    # imported late: what a help text needs should come at once
    from slamlab.cli.common import generator
    from slamlab.devices.emulator.emulator_runner import run_emulators
    from slamlab.devices.emulator.fault_injection import inject_fault
    from slamlab.devices.errors import SlamlabError

    try:
        rng = generator(arguments.seed)
        options = {"firmware": _version(arguments.firmware), "typical": arguments.typical}
        if not 0 <= arguments.typical <= 2:
            raise ValueError(f"--typical is 0, 1 or 2, not {arguments.typical}")
        robot = {"saturates": arguments.saturates, "watchdog": arguments.watchdog}
        running = run_emulators(
            _world(arguments.world),
            rng,
            tcp_of(arguments),
            lidar=options | {"spinning": not arguments.stopped},
            emir=robot,
        )
    except (SlamlabError, ValueError) as error:
        print(f"slamlab emulate: {error}", file=sys.stderr)
        return 2
    with running:
        try:
            for text in arguments.fault:
                inject_fault(running, text, rng)
        except ValueError as error:
            print(f"slamlab emulate: {error}", file=sys.stderr)
            return 2
        announce(running)
        return listen(running, lambda text: inject_fault(running, text, rng))


def add_ports(parser):
    """Add the command-line options of the emulated ports."""
    parser.add_argument(
        "--tcp", action="store_true", help="TCP instead of pseudo-terminals (Windows, remote use)"
    )
    parser.add_argument(
        "--host", metavar="HOST", default="127.0.0.1", help="where to listen (127.0.0.1)"
    )
    parser.add_argument(
        "--ports",
        metavar="N",
        nargs=2,
        type=int,
        default=(0, 0),
        help="TCP ports of lidar and eMIR; any that are free by default",
    )


def tcp_of(arguments):
    """The TCP address to listen on, None for pseudo-terminals."""
    return (arguments.host, *arguments.ports) if arguments.tcp else None


def announce(running):
    """Print the emulated ports.

    Parameters
    ----------
    running : EmulatorRunner
    """
    for name, port in running.ports.items():
        print(f"{name:5}  {port}")
    print(f"e. g.: slamlab run devices:{','.join(running.ports.values())}")
    print("Ctrl-C ends it.", flush=True)


def listen(running, act=None):
    """Handle typed commands until Ctrl-C.

    Parameters
    ----------
    running : EmulatorRunner
    act : callable(text) that raises ValueError, or None where typing does nothing

    Returns
    -------
    int, 0
    """
    with contextlib.suppress(KeyboardInterrupt):
        for line in sys.stdin if act is not None else ():
            try:
                if line.strip():
                    act(line)
            except ValueError as error:
                print(error, file=sys.stderr)
        threading.Event().wait()  # nobody types: until Ctrl-C
    for name, count in running.dropped.items():
        if count:
            print(f"{name}: {count} bytes dropped that no client read in time")
    return 0


def _world(name):
    from pathlib import Path

    from slamlab import worlds

    return worlds.load(name) if Path(name).is_file() else worlds.by_name(name)


def _version(text):
    try:
        major, minor = (int(number) for number in text.split("."))
    except ValueError:
        raise ValueError(f"--firmware is two numbers such as 1.29, not {text!r}") from None
    if not (0 <= major <= 255 and 0 <= minor <= 255):
        raise ValueError(f"--firmware has numbers up to 255, not {text!r}")
    return major, minor
