"""Commands of eMIR, each encoded as the frame that goes over the line."""

from slamlab.devices.emir.frames import frame

STOP, MOVE, TRANSLATE, ROTATE, BEEP, SENSORS, OUTPUT = range(7)
INFO, MIN_DISTANCE, MAX_SPEED, MAX_ROTATION, RESET_AZIMUTH, RESET_COUNTERS = range(0x10, 0x16)
OFF = 0xFF  # opcodes of the protocol


def command(opcode, a=0, b=0):
    """Encode a command with two arguments, −128 to 255 each.

    Returns
    -------
    bytes
    """
    return frame(bytes([opcode, a % 256, b % 256]))


def stop():
    """Command to stop."""
    return command(STOP)


def move(v, omega):
    """Command to drive with a speed and turn rate, until the next one.

    Parameters
    ----------
    v, omega : float, speed and turn rate, −100 to 100, cut off there [%]

    Returns
    -------
    bytes
    """
    return command(MOVE, _clipped(v, -100, 100), _clipped(omega, -100, 100))


def translate(way, speed=50):
    """Command to drive a distance and stop.

    Parameters
    ----------
    way : float, −1 to 1 [m]
    speed : float, 10 to 100 [%]

    Returns
    -------
    bytes
    """
    return command(TRANSLATE, _clipped(100 * way, -100, 100), _clipped(speed, 10, 100))


def rotate(degrees, speed=50):
    """Command to rotate by an angle and stop.

    Parameters
    ----------
    degrees : float, −180 to 180 [degree]
    speed : float, 10 to 100 [%]

    Returns
    -------
    bytes
    """
    return command(ROTATE, _clipped(degrees / 2, -90, 90), _clipped(speed, 10, 100))


def beep(seconds):
    """Command to beep for 0 to 25.5 s."""
    return command(BEEP, _clipped(10 * seconds, 0, 255))


def sensors(on):
    """Command to switch the distance sensors on or off."""
    return command(SENSORS, int(on))


def output(bit, on):
    """Command to set a digital output, 0 to 3; 4 is all of them."""
    return command(OUTPUT, _clipped(bit, 0, 4), int(on))


def info(on):
    """Command to start or stop the stream of status frames."""
    return command(INFO, int(on))


def min_distance(metres):
    """Command to set the obstacle distance at which the robot stops by itself, 0 to 0.5 m."""
    return command(MIN_DISTANCE, _clipped(100 * metres, 0, 50))


def max_speed(percent):
    """Command to limit the speed, 10 to 100 %."""
    return command(MAX_SPEED, _clipped(percent, 10, 100))


def max_rotation(percent):
    """Command to limit the turn rate, 10 to 100 %."""
    return command(MAX_ROTATION, _clipped(percent, 10, 100))


def reset_azimuth():
    """Command to reset the azimuth: the present heading is 0."""
    return command(RESET_AZIMUTH)


def reset_counters():
    """Command to reset the path and angle counters to 0."""
    return command(RESET_COUNTERS)


def power_off():
    """Command to switch the robot off."""
    return command(OFF)


def _clipped(value, low, high):
    """Clip to limits and round to a whole number."""
    if value != value:  # not a number: rather stand still
        return max(low, 0)
    return round(min(max(value, low), high))
