"""``slamlab emulate``: emulate an RPLIDAR and an eMIR on pseudo-terminals or TCP ports."""

import contextlib
import sys
import threading

from slamlab.cli.common import generator, refuse
from slamlab.cli.listings import check_world
from slamlab.cli.parsers import add_command


def add_parser(subparsers):
    parser = add_command(
        subparsers,
        "emulate",
        "Emulate an RPLIDAR and an eMIR robot on two ports.",
        "--world room --seed 3",
        "--carried --fault 'flip lidar 0.0001'",
    )
    add = parser.add_argument
    world = "World by name or file (default: polygon; with --carried: flat)"
    add("--world", metavar="WORLD", help=world)
    add("--carried", action="store_true", help="Carry only the lidar by hand through a flat")
    add_ports(parser)
    models = "a1, a2m8, a2m12, a3, c1, s1, s2 or s3"
    add("--model", metavar="NAME", default="a2m8", help=f"Lidar: {models} (default: a2m8)")
    add("--firmware", metavar="X.Y", help="Firmware of the lidar (default: its model's)")
    add("--typical", metavar="MODE", type=int, help="Number of the recommended scan mode")
    add("--stopped", action="store_true", help="Keep the motor stopped until a command starts it")
    add("--saturates", action="store_true", help="Let eMIR's counters saturate, not wrap around")
    watchdog = "Time without commands after which eMIR stops [s] (default: never)"
    add("--watchdog", metavar="S", type=float, help=watchdog)
    fault = "Fault to inject from the start, such as 'flip lidar 0.0001'; repeatable"
    add("--fault", metavar="TEXT", action="append", default=[], help=fault)
    help = "Random seed of noise, slip and faults (default: 0)"
    add("--seed", metavar="N", type=int, default=0, help=help)
    parser.set_defaults(run=run)


def run(arguments) -> int:
    # imported late: a help text should come at once
    from slamlab.devices.emulator.emulator_runner import run_emulators
    from slamlab.devices.emulator.fault_injection import inject_fault
    from slamlab.devices.emulator.lidar_models import lidar_model
    from slamlab.devices.errors import SlamlabError
    from slamlab.simulation.pedestrians import carrier

    try:
        rng = generator(arguments.seed)
        modes = range(len(lidar_model(arguments.model).modes))
        options = {"model": arguments.model, "typical": arguments.typical}
        if arguments.typical is not None and arguments.typical not in modes:
            known = f"{', '.join(map(str, modes[:-1]))} or {modes[-1]}"
            raise ValueError(f"--typical must be {known}, not {arguments.typical}")
        if arguments.firmware is not None:
            options["firmware"] = _version(arguments.firmware)
        world = _world(arguments.world or ("flat" if arguments.carried else "polygon"))
        running = run_emulators(
            world,
            rng,
            tcp_of(arguments),
            lidar=options | {"spinning": not arguments.stopped},
            emir={"saturates": arguments.saturates, "watchdog": arguments.watchdog},
            carrier=carrier(world.name, rng) if arguments.carried else None,
        )
    except (SlamlabError, ValueError) as error:
        return refuse("emulate", error)
    with running:
        try:
            for text in arguments.fault:
                inject_fault(running, text, rng)
        except ValueError as error:
            return refuse("emulate", error)
        announce(running)
        return listen(running, lambda text: inject_fault(running, text, rng))


def add_ports(parser):
    add = parser.add_argument
    add("--tcp", action="store_true", help="Use TCP instead of pseudo-terminals, as on Windows")
    add("--host", metavar="HOST", help="Address of --tcp (default: 127.0.0.1)")
    ports = "TCP ports of lidar and eMIR (default: any free ports)"
    add("--ports", metavar="N", nargs=2, type=int, default=(0, 0), help=ports)


def tcp_of(arguments):
    """Return the TCP address and the ports that the emulators open; None for pseudo-terminals.
    Raises ValueError if an address or ports are given without --tcp."""
    if not arguments.tcp and (arguments.host or any(arguments.ports)):
        raise ValueError("--host and --ports set a TCP address: add --tcp")
    return (arguments.host or "127.0.0.1", *arguments.ports) if arguments.tcp else None


def announce(running):
    for name, port in running.ports.items():
        print(f"{name:5}  {port}")
    print(f"Example: slamlab live devices:{','.join(running.ports.values())}")
    print("Press Ctrl-C to end.", flush=True)


def listen(running, act=None):
    """Wait for Ctrl-C; meanwhile, pass each typed line to the function ``act`` if it is given."""
    with contextlib.suppress(KeyboardInterrupt):
        for line in sys.stdin if act is not None else ():
            try:
                if line.strip():
                    act(line)
            except ValueError as error:
                print(error, file=sys.stderr)
        threading.Event().wait()  # at the end of the input: until Ctrl-C
    for name, count in running.dropped.items():
        if count:
            print(f"{name}: {count} bytes dropped because no client read them in time")
    return 0


def _world(name):
    from pathlib import Path

    from slamlab.simulation import worlds

    if Path(name).is_file():
        return worlds.load(name)
    check_world(name)
    return worlds.by_name(name)


def _version(text):
    try:
        major, minor = (int(number) for number in text.split("."))
    except ValueError:
        raise ValueError(f"--firmware must be two numbers such as 1.29, not {text!r}") from None
    if not (0 <= major <= 255 and 0 <= minor <= 255):
        raise ValueError(f"--firmware must have numbers from 0 to 255, not {text!r}")
    return major, minor
