"""Connection limits: if too many connections are open, the client with the most loses its oldest
one. Anonymous clients do not compete with authenticated ones (with a cookie or a bearer token).
"""

ANONYMOUS, AUTHENTICATED = 512, 1536
SPARE = 64  # other files that the process has open


class ConnectionPool:
    """Open connections of one kind, at most ``capacity``."""

    def __init__(self, capacity):
        self._capacity, self._open, self._count = capacity, {}, 0

    def add(self, client, stream):
        """Add a client's IOStream; above the capacity, close the oldest stream of the client that
        has the most streams.
        """
        self._open.setdefault(client, []).append(stream)
        self._count += 1
        if self._count > self._capacity:
            self._forget_closed()
        if self._count > self._capacity:
            max(self._open.values(), key=len).pop(0).close()
            self._count -= 1

    def remove(self, client, stream):
        if stream in self._open.get(client, ()):
            self._open[client].remove(stream)
            self._count -= 1

    def _forget_closed(self):
        still = {who: [s for s in streams if not s.closed()] for who, streams in self._open.items()}
        self._open = {who: streams for who, streams in still.items() if streams}
        self._count = sum(map(len, self._open.values()))


class ConnectionLimits:
    """Limits of all open connections, scaled to the number of files that the process may open."""

    def __init__(self, files):
        share = min(1.0, (files - SPARE) / (ANONYMOUS + AUTHENTICATED))
        self._anonymous = ConnectionPool(int(ANONYMOUS * share))
        self._authenticated = ConnectionPool(int(AUTHENTICATED * share))

    def add(self, address, stream):
        """Add a new connection, whose client is not yet known."""
        self._anonymous.add(address, stream)

    def authenticate(self, address, client, stream):
        """From now on, count a connection as one of its client."""
        self._anonymous.remove(address, stream)
        self._authenticated.remove(client, stream)
        self._authenticated.add(client, stream)


def raise_file_limit():
    """Raise the number of files that this process may open; return the new limit."""
    wanted = ANONYMOUS + AUTHENTICATED + SPARE
    try:
        import resource
    except ImportError:  # Windows has no such limit
        return wanted
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    infinite = resource.RLIM_INFINITY
    if soft != infinite and soft < wanted:
        soft = wanted if hard == infinite else min(wanted, hard)
        resource.setrlimit(resource.RLIMIT_NOFILE, (soft, hard))
    return wanted if soft == infinite else soft
