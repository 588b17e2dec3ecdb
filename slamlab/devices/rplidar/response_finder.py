"""Response descriptor search: finds one response in a byte stream with stale and damaged bytes."""

from slamlab.devices.rplidar.responses import DESCRIPTOR_SIZE, DESCRIPTOR_SYNC, Descriptor


class ResponseFinder:
    """Finds the response descriptor of one request among old scan data, boot text and damage.

    Parameters
    ----------
    type : AnswerType, or a collection of types that will do
    loop : bool, whether an endless answer is wanted: then its descriptor is all there is to find
    length : int, of the payload, or None where that is free

    ``skipped`` counts bytes that belonged to nothing, ``others`` are descriptors passed over.
    """

    def __init__(self, type, loop=False, length=None):
        self._types = {type} if isinstance(type, int) else set(type)
        self._loop, self._length = loop, length
        self._buffer = b""
        self.skipped, self.others, self.rest = 0, [], b""

    def feed(self, data):
        """Search bytes as they come.

        Parameters
        ----------
        data : bytes

        Returns
        -------
        (Descriptor, bytes payload), or None while it has not come; what follows is in ``rest``
        """
        self._buffer += data
        found = self._next()
        if found is not None:
            self.rest, self._buffer = self._buffer, b""
        return found

    def _fits(self, descriptor):
        length_fits = self._length in (None, descriptor.length)
        return descriptor.type in self._types and descriptor.loop == self._loop and length_fits

    def _next(self):
        """Find the wanted descriptor with its payload, once all of it is there."""
        while (at := self._buffer.find(DESCRIPTOR_SYNC)) >= 0:
            descriptor = Descriptor.unpack(self._buffer[at : at + DESCRIPTOR_SIZE])
            if descriptor is None and len(self._buffer) - at >= DESCRIPTOR_SIZE:
                self._skip(at + 1)
                continue
            self._skip(at)
            if descriptor is None:
                return None
            if not self._fits(descriptor):  # perhaps chance: the wanted one may begin inside it
                self.others = [*self.others[-9:], descriptor]
                self._skip(len(DESCRIPTOR_SYNC))
                continue
            end = DESCRIPTOR_SIZE + (0 if descriptor.loop else descriptor.length)
            if len(self._buffer) < end:
                return None
            payload, self._buffer = self._buffer[DESCRIPTOR_SIZE:end], self._buffer[end:]
            return descriptor, payload
        self._skip(len(self._buffer) - self._buffer.endswith(DESCRIPTOR_SYNC[:1]))
        return None

    def _skip(self, n):
        self.skipped += n
        self._buffer = self._buffer[n:]
