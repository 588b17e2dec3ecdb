"""Request parser, the device's side: finds requests in a byte stream, split, joined or damaged."""

from slamlab.devices.rplidar.requests import SYNC, WITH_PAYLOAD, checksum

PARTIAL_TIMEOUT = 5.0  # until an incomplete request is dropped [s]


class RequestParser:
    """Parser that splits a byte stream into requests and checks their checksum; skips the rest."""

    def __init__(self):
        self._buffer, self._since = b"", 0.0

    def feed(self, data, now):
        """Parse bytes as they come.

        Parameters
        ----------
        data : bytes
        now : float [s]

        Returns
        -------
        list of (command, payload)
        """
        if self._buffer and now - self._since > PARTIAL_TIMEOUT:
            self._buffer = b""
        if data and not self._buffer:
            self._since = now
        self._buffer += data
        found = []
        while (request := self._next()) is not None:
            found.append(request)
            self._since = now
        return found

    def _next(self):
        while True:
            self._buffer = self._buffer[self._buffer.find(SYNC) :] if SYNC in self._buffer else b""
            if len(self._buffer) < 2:
                return None
            command = self._buffer[1]
            if not command & WITH_PAYLOAD:
                self._buffer = self._buffer[2:]
                if command != SYNC:
                    return command, b""
                continue
            if len(self._buffer) < 3:
                return None
            end = 4 + self._buffer[2]
            if len(self._buffer) < end:
                return None
            whole, self._buffer = self._buffer[:end], self._buffer[end:]
            if checksum(whole[:-1]) == whole[-1]:
                return command, whole[3:-1]
