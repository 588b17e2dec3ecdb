"""What a robot that is driven by hand can be told."""

COMMANDS = {"forward": (1, 0), "back": (-1, 0), "left": (0, 1), "right": (0, -1), "stop": None}
"""By name: shares of top speed and top turn rate."""


def velocities(name, tops):
    """The speed and turn rate that a command stands for.

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
