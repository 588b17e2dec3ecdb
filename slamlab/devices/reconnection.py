"""Automatic reconnection (reconnect) after unplugging, with exponential back-off between retries.

The drivers of ``rplidar`` and ``emir`` reconnect in ``_reconnect``. ``serial_ports.find_port``
finds the port of the same USB adapter again.
"""

BACKOFF = 0.5, 5.0  # first and longest delay before an attempt [s]
STOP_CHECK = 0.05  # period at which a delay checks whether to stop [s]


def backoff(clock, stopping):
    """Wait and yield before each attempt to reconnect, until the Event ``stopping`` is set.

    The delay doubles after each attempt (exponential back-off).
    """
    delay, longest = BACKOFF
    while True:
        end = clock.now() + delay
        while clock.now() < end and not stopping.is_set():
            clock.sleep(STOP_CHECK)
        if stopping.is_set():
            return
        yield
        delay = min(2 * delay, longest)
