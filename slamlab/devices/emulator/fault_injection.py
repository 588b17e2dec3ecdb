"""Fault injection into emulated devices, by words: at the start, or typed while they run."""

from slamlab.devices.emulator.emulator_runner import EMIR, LIDAR

HELP = """\
unplug DEVICE | plug DEVICE      pull the plug of lidar or emir, put it in again
stall | run                      block the lidar's motor, let it go
flip DEVICE SHARE                flip a bit in that share of its bytes, such as 0.0001
lose DEVICE SHARE                lose that share of its bytes
stale DEVICE N                   N bytes of former times come before its next answer
silent DEVICE HEX | answer DEVICE  do not answer that command; answer all again
health STATUS CODE               what the lidar says of itself, such as 2 4
spin-up SECONDS                  how long its motor takes to turn evenly"""


def inject_fault(running, text, rng):
    """Inject a fault, or end it.

    Parameters
    ----------
    running : EmulatorRunner with a lidar and an emir
    text : str, one of the lines of HELP
    rng : numpy.random.Generator, of stale bytes

    Raises
    ------
    ValueError : there is no such switch
    """
    words = text.split()
    try:
        _inject_fault(running, *words, rng=rng)
    except (TypeError, ValueError, KeyError):
        raise ValueError(f"no such switch: {text.strip()!r}; there are\n{HELP}") from None


def _inject_fault(running, word, *rest, rng):
    if word in ("stall", "run"):
        () = rest
        running[LIDAR].faults.stalled = word == "stall"
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
