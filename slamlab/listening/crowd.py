"""How many connections may be open; when there are too many, who holds most gives one up.

Who has shown a cookie or a key and who has not do not compete: strangers push out strangers only.
So one machine that opens thousands of connections closes its own, and nobody else waits.
"""

STRANGERS, ADMITTED = 512, 1536
SPARE = 64  # files that a process has open besides


class Hall:
    """The open connections of one kind.

    Parameters
    ----------
    room : int, how many there may be
    """

    def __init__(self, room):
        self._room, self._held, self._count = room, {}, 0

    def enter(self, holder, stream):
        """Let a connection in; if that is one too many, close the oldest of who holds most.

        Parameters
        ----------
        holder : str, an address or a client
        stream : IOStream of tornado
        """
        self._held.setdefault(holder, []).append(stream)
        self._count += 1
        if self._count > self._room:
            self._forget_closed()
        if self._count > self._room:
            max(self._held.values(), key=len).pop(0).close()
            self._count -= 1

    def leave(self, holder, stream):
        """Let a connection go without closing it."""
        if stream in self._held.get(holder, ()):
            self._held[holder].remove(stream)
            self._count -= 1

    def _forget_closed(self):
        held = {who: [s for s in streams if not s.closed()] for who, streams in self._held.items()}
        self._held = {who: streams for who, streams in held.items() if streams}
        self._count = sum(map(len, self._held.values()))


class Crowd:
    """All open connections of a listener.

    Parameters
    ----------
    files : int, how many files the process may have open
    """

    def __init__(self, files):
        part = min(1.0, (files - SPARE) / (STRANGERS + ADMITTED))
        self._strangers, self._admitted = Hall(int(STRANGERS * part)), Hall(int(ADMITTED * part))

    def enter(self, address, stream):
        """Let in a connection of whom nothing is known but the address."""
        self._strangers.enter(address, stream)

    def admit(self, address, client, stream):
        """A connection's owner is known from now on.

        Parameters
        ----------
        address, client : str
        stream : IOStream of tornado
        """
        self._strangers.leave(address, stream)
        self._admitted.leave(client, stream)
        self._admitted.enter(client, stream)


def files_to_open():
    """Raise how many files this process may have open, where it may.

    Returns
    -------
    int, how many that are
    """
    wanted = STRANGERS + ADMITTED + SPARE
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
