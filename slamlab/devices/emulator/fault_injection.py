"""Fault injection: text commands start and end faults of emulated devices."""

from slamlab.devices.emulator.emulator_runner import EMIR, LIDAR

HELP = """\
unplug DEVICE | plug DEVICE      unplug or plug in a device, lidar or emir
stall | run                      block or release the lidar's motor
blind | see                      stop or resume the lidar's measurements
unknown-type | known-type        send data of an unknown type, except in the standard scan
flip DEVICE SHARE                flip a bit in this share of the bytes, such as 0.0001
lose DEVICE SHARE                lose this share of the bytes
stale DEVICE N                   send N old bytes before the next response
silent DEVICE HEX | answer DEVICE  ignore this command, or respond to all commands again
health STATUS CODE               set the health that the lidar reports, such as 2 4
spin-up SECONDS                  set the time until the motor rotates steadily"""


SWITCHES = {  # faults of the lidar by command: attribute, value
    "stall": ("stalled", True),
    "run": ("stalled", False),
    "blind": ("blind", True),
    "see": ("blind", False),
    "unknown-type": ("unknown_type", True),
    "known-type": ("unknown_type", False),
}


def inject_fault(running, text, rng):
    """Inject or end a fault with one of the commands that HELP lists. Raises ValueError."""
    words = text.split()
    try:
        _inject_fault(running, *words, rng=rng)
    except (TypeError, ValueError, KeyError):
        raise ValueError(f"unknown command {text.strip()!r}. Commands:\n{HELP}") from None


def _inject_fault(running, word, *rest, rng):
    if word in SWITCHES:
        () = rest
        name, on = SWITCHES[word]
        setattr(running[LIDAR].faults, name, on)
    elif word == "health":
        status, code = (int(number, 0) for number in rest)
        if not (0 <= status <= 255 and 0 <= code <= 65535):
            raise ValueError
        running[LIDAR].health = status, code
    elif word == "spin-up":
        (seconds,) = rest
        running[LIDAR].motor.spin_up = float(seconds)
    else:
        name, *rest = rest
        if name not in (LIDAR, EMIR):
            raise ValueError
        _fault(running[name].faults, word, rest, rng)


def _fault(faults, word, rest, rng):
    if word in ("unplug", "plug"):
        () = rest
        faults.unplugged = word == "unplug"
    elif word == "answer":
        () = rest
        faults.silent.clear()
    elif word in ("flip", "lose"):
        (share,) = (float(number) for number in rest)
        if not 0 <= share <= 1:
            raise ValueError
        setattr(faults, word, share)
    elif word == "stale":
        (count,) = rest
        faults.stale = rng.bytes(int(count))
    elif word == "silent":
        (command,) = rest
        faults.silent.add(int(command, 16))
    else:
        raise ValueError
