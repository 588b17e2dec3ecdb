"""``slamlab replay FILE``: replay a raw recording of devices on two ports."""

from slamlab.cli.common import refuse
from slamlab.cli.emulate import add_ports, announce, listen, tcp_of
from slamlab.cli.parsers import add_command


def add_parser(subparsers):
    parser = add_command(
        subparsers,
        "replay",
        "Play a raw recording on two ports, as the devices sent it.",
        "drive.rec.gz --info",
        "drive.rec.gz --speed 2",
    )
    add = parser.add_argument
    add("file", metavar="FILE", help="Raw recording, plain or .gz")
    add("--speed", metavar="X", type=float, default=1.0, help="Speed of the replay (default: 1)")
    add("--salvage", action="store_true", help="Read a damaged file up to the damage")
    add("--info", action="store_true", help="Only print the contents of the recording")
    add_ports(parser)
    parser.set_defaults(run=run)


def run(arguments) -> int:
    # imported late: a help text should come at once
    from slamlab.devices.emulator.emulator_runner import EmulatorRunner, attach_ports
    from slamlab.devices.errors import SlamlabError
    from slamlab.devices.recording import load
    from slamlab.devices.recording.playback import playback

    try:
        recording = load(arguments.file, arguments.salvage)
        for line in contents(recording):
            print(line)
        if arguments.info:
            return 0
        devices = playback(recording, arguments.speed)
        if not devices:
            raise ValueError(f"{arguments.file} contains no bytes of any device")
        running = EmulatorRunner(attach_ports(devices, tcp_of(arguments)))
    except (SlamlabError, ValueError) as error:
        return refuse("replay", error)
    with running:
        announce(running)
        return listen(running)


def contents(recording):
    """Yield lines that describe a recording: length, bytes and messages of each device."""
    from hashlib import sha256

    from slamlab.devices.recording.decoding import RecordedLidar, statuses
    from slamlab.devices.recording.recording_file import CHANNELS, EVENT

    if recording.truncated:
        yield f"{recording.truncated}; the file was read up to that point"
    created = recording.header.get("created", "at an unknown time")
    yield f"{recording.seconds:.1f} s, recorded {created}"
    for channel in CHANNELS:
        received = recording.received(channel)
        if received:
            counts = {"statuses": sum(1 for _ in statuses(recording))}
            if channel == "lidar":
                lidar = RecordedLidar(recording.baud(channel))
                turns = sum(len(lidar.feed(record)) for record in recording.of(channel))
                counts = {"revolutions": turns, **lidar.damage}
            counted = ", ".join(f"{count} {what}" for what, count in counts.items())
            digest = sha256(received).hexdigest()[:16]
            at = f"{recording.baud(channel)} baud"
            yield f"{channel}: {len(received)} bytes (SHA-256 {digest}…) at {at}, {counted}"
        for event in recording.of(channel, EVENT):
            text = event.data.decode(errors="replace")
            yield f"{channel}: at {event.time - recording.begin:.1f} s {text}"
