"""What eMIR can be told, each as the frame that goes over the line."""

from slamlab.devices.emir.frames import frame

STOP, MOVE, TRANSLATE, ROTATE, BEEP, SENSORS, OUTPUT = range(7)
INFO, MIN_DISTANCE, MAX_SPEED, MAX_ROTATION, RESET_AZIMUTH, RESET_COUNTERS = range(0x10, 0x16)
OFF = 0xFF


def command(opcode, a=0, b=0):
    """A command with two arguments, −128 to 255 each.

    Returns
    -------
    bytes
    """
    return frame(bytes([opcode, a % 256, b % 256]))


def stop():
    """Stand still."""
    return command(STOP)


def move(v, omega):
    """Drive on and on.

    Parameters
    ----------
    v, omega : float, speed and turn rate, −100 to 100, cut off there [%]

    Returns
    -------
    bytes
    """
    return command(MOVE, _limited(v, -100, 100), _limited(omega, -100, 100))


def translate(way, speed=50):
    """Drive a way and stand still.

    Parameters
    ----------
    way : float, −1 to 1 [m]
    speed : float, 10 to 100 [%]

    Returns
    -------
    bytes
    """
    return command(TRANSLATE, _limited(100 * way, -100, 100), _limited(speed, 10, 100))


def rotate(degrees, speed=50):
    """Turn by an angle and stand still.

    Parameters
    ----------
    degrees : float, −180 to 180 [degree]
    speed : float, 10 to 100 [%]

    Returns
    -------
    bytes
    """
    return command(ROTATE, _limited(degrees / 2, -90, 90), _limited(speed, 10, 100))


def beep(seconds):
    """Beep, for 0 to 25.5 s."""
    return command(BEEP, _limited(10 * seconds, 0, 255))


def sensors(on):
    """Switch the distance sensors on or off."""
    return command(SENSORS, int(on))


def output(bit, on):
    """Set one of the digital outputs, 0 to 3; 4 is all of them."""
    return command(OUTPUT, _limited(bit, 0, 4), int(on))


def info(on):
    """Begin or end the stream of status frames."""
    return command(INFO, int(on))


def min_distance(metres):
    """How near an obstacle may come before the robot stops by itself, 0 to 0.5 m."""
    return command(MIN_DISTANCE, _limited(100 * metres, 0, 50))


def max_speed(percent):
    """Limit the speed, 10 to 100 %."""
    return command(MAX_SPEED, _limited(percent, 10, 100))


def max_rotation(percent):
    """Limit the turn rate, 10 to 100 %."""
    return command(MAX_ROTATION, _limited(percent, 10, 100))


def reset_azimuth():
    """Call the present heading 0."""
    return command(RESET_AZIMUTH)


def reset_counters():
    """Set path and angle to 0."""
    return command(RESET_COUNTERS)


def power_off():
    """Switch the robot off."""
    return command(OFF)


def _limited(value, low, high):
    """The nearest whole number within limits."""
    if value != value:  # not a number: rather stand still
        return max(low, 0)
    return round(min(max(value, low), high))
