"""Commands of eMIR, encoded as frames; the arguments are clipped to their limits."""

from slamlab.devices.emir.frames import frame

STOP, MOVE, TRANSLATE, ROTATE, BEEP, SENSORS, OUTPUT = range(7)
INFO, MIN_DISTANCE, MAX_SPEED, MAX_ROTATION, RESET_AZIMUTH, RESET_COUNTERS = range(0x10, 0x16)
OFF = 0xFF  # opcodes of the protocol


def command(opcode, a=0, b=0):
    """Encode a command that has two arguments, each from −128 to 255."""
    return frame(bytes([opcode, a % 256, b % 256]))


def stop():
    return command(STOP)


def move(v, omega):
    """Encode a motion at a speed and a turn rate, −100 to 100 [%], which the next command ends."""
    return command(MOVE, _clipped(v, -100, 100), _clipped(omega, -100, 100))


def translate(distance, speed=50):
    """Encode a translation by −1 to 1 [m] at a speed of 10 to 100 [%]."""
    return command(TRANSLATE, _clipped(100 * distance, -100, 100), _clipped(speed, 10, 100))


def rotate(degrees, speed=50):
    """Encode a rotation by −180 to 180 [degree] at a turn rate of 10 to 100 [%]."""
    return command(ROTATE, _clipped(degrees / 2, -90, 90), _clipped(speed, 10, 100))


def beep(seconds):
    """Encode a beep with a duration of 0 to 25.5 [s]."""
    return command(BEEP, _clipped(10 * seconds, 0, 255))


def sensors(on):
    return command(SENSORS, int(on))


def output(bit, on):
    """Encode a command that switches one digital output (number 0 to 3) or all outputs (4)."""
    return command(OUTPUT, _clipped(bit, 0, 4), int(on))


def info(on):
    """Encode a command that switches the stream of status frames on or off."""
    return command(INFO, int(on))


def min_distance(metres):
    """Encode the distance from an obstacle, 0 to 0.5 [m], at which the robot stops."""
    return command(MIN_DISTANCE, _clipped(100 * metres, 0, 50))


def max_speed(percent):
    """Encode a command that sets the speed limit, 10 to 100 [%]."""
    return command(MAX_SPEED, _clipped(percent, 10, 100))


def max_rotation(percent):
    """Encode a command that sets the limit of the turn rate, 10 to 100 [%]."""
    return command(MAX_ROTATION, _clipped(percent, 10, 100))


def reset_azimuth():
    """Encode a command that defines the present heading as 0."""
    return command(RESET_AZIMUTH)


def reset_counters():
    return command(RESET_COUNTERS)


def power_off():
    return command(OFF)


def _clipped(value, low, high):
    if value != value:  # NaN: stand still
        return max(low, 0)
    return round(min(max(value, low), high))
