"""``slamlab replay FILE``: what a raw recording holds, and its devices again, behind two ports."""

import sys


def add_parser(subparsers):
    """Add the command to the command line."""
    from slamlab.cli.emulate import add_ports

    parser = subparsers.add_parser(
        "replay",
        help="play a raw recording as if its devices were there",
        description=(
            "Say what a raw recording holds, then play it: programs open the ports that are "
            "printed and get what the devices once answered and sent. Runs until Ctrl-C."
        ),
    )
    parser.add_argument("file", metavar="FILE", help="a raw recording, plain or .gz")
    parser.add_argument(
        "--speed", metavar="X", type=float, default=1.0, help="times as fast as it was (1)"
    )
    parser.add_argument(
        "--salvage", action="store_true", help="of a damaged file take what is whole before it"
    )
    parser.add_argument("--info", action="store_true", help="only say what it holds")
    add_ports(parser)
    parser.set_defaults(run=run)


def run(arguments) -> int:
    """Replay; 0 when ended, 2 when the file or a port cannot be used."""
    # imported late: what a help text needs should come at once
    from slamlab.cli.emulate import announce, listen, tcp_of
    from slamlab.devices.emulator.emulator_runner import EmulatorRunner, attach_ports
    from slamlab.devices.errors import SlamlabError
    from slamlab.devices.recording import load
    from slamlab.devices.recording.playback import playback

    try:
        recording = load(arguments.file, arguments.salvage)
        for line in held(recording):
            print(line)
        if arguments.info:
            return 0
        devices = playback(recording, arguments.speed)
        if not devices:
            raise ValueError(f"{arguments.file} holds no bytes of any device")
        running = EmulatorRunner(attach_ports(devices, tcp_of(arguments)))
    except (SlamlabError, ValueError) as error:
        print(f"slamlab replay: {error}", file=sys.stderr)
        return 2
    with running:
        announce(running)
        return listen(running)


def held(recording):
    """Summarise a recording: length, bytes and messages of each device.

    Parameters
    ----------
    recording : Recording

    Yields
    ------
    str, lines
    """
    from hashlib import sha256

    from slamlab.devices.recording.decoding import statuses, turns
    from slamlab.devices.recording.recording_file import CHANNELS, EVENT

    if recording.truncated:
        yield f"{recording.truncated}: read up to there"
    yield f"{recording.seconds:.1f} s, recorded {recording.header.get('created', 'some time')}"
    decoded = {"lidar": (turns, "turns"), "emir": (statuses, "statuses")}
    for channel in CHANNELS:
        received = recording.received(channel)
        if received:
            decode, what = decoded[channel]
            count = sum(1 for _ in decode(recording))
            digest = sha256(received).hexdigest()[:16]
            yield f"{channel}: {len(received)} bytes (SHA-256 {digest}…), {count} {what}"
        for event in recording.of(channel, EVENT):
            told = event.data.decode(errors="replace")
            yield f"{channel}: at {event.time - recording.begin:.1f} s {told}"
