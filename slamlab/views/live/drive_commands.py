"""Drive commands (teleoperation): velocity commands of buttons, keyboard and typed lines."""

import numpy as np

COMMANDS = {"forward": (1, 0), "back": (-1, 0), "left": (0, 1), "right": (0, -1), "stop": None}
"""Command by name: shares of top speed and top turn rate [1]; None stops."""

WORD_COMMANDS = "reset", "exit"  # typed commands without numbers
MAX_MOVE = 100.0, 3600.0  # that can be typed [m, degree]


def velocities(name, tops):
    """Velocities, linear and angular, that a named drive command stands for.

    Parameters
    ----------
    name : str, one of COMMANDS
    tops : (speed, turn rate) at most [m/s, rad/s]

    Returns
    -------
    (2,) [m/s, rad/s], or None for stop
    """
    if COMMANDS[name] is None:
        return None
    (v, omega), (v_top, omega_top) = COMMANDS[name], tops
    return v * v_top, omega * omega_top


def parse_command(text):
    """Parse a typed drive command: Tuček's console, with the units that its prompt leaves out.

    Parameters
    ----------
    text : str, ``distance, angle`` in metres and degrees, ``reset`` or ``exit``

    Returns
    -------
    "reset", "exit", or (distance, angle) [m, rad]

    Raises
    ------
    ValueError : it means nothing; the text says what would
    """
    word, shown = text.strip().lower(), repr(text.strip()[:20])
    if word in WORD_COMMANDS:
        return word
    try:
        distance, angle = (float(part) for part in text.split(","))
    except ValueError:
        raise ValueError(
            f"{shown} is no command: type metres, degrees (such as 0.5, 30), reset or exit"
        ) from None
    metres, degrees = MAX_MOVE
    if not (abs(distance) <= metres and abs(angle) <= degrees):
        raise ValueError(f"{shown} is too far: at most {metres:g} m and {degrees:g}°")
    return distance, float(np.radians(angle))
