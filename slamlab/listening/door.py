"""Who comes in: a token or a code, changed into a cookie; or a key shown with each request."""

import secrets
import time

from slamlab.listening.rates import Buckets, Rate

LETTERS = "ABCDEFGHJKMNPRSTWXYZ"  # none that is read as another one or as a digit
# A class of 200 may stand behind one address, and each may mistype once: so many tries it has. In
# two hours all together have 38 000 tries, and find one of 20**8 codes once in 600 000 lectures.
TRIES, ALL_TRIES = Rate(400, 2), Rate(2000, 5)


class Refused(Exception):
    """Nobody comes in; the number is HTTP's word for why."""

    def __init__(self, status):
        super().__init__(status)
        self.status = status


class Door:
    """A token (128 bits, for a QR code) or a code of 8 letters opens it; a cookie keeps it open.

    Parameters
    ----------
    name : str, of the cookie
    clock : callable -> float [s]
    admits : int, how many cookies there may be; 1 makes the token and the code good for one use
    """

    def __init__(self, name, clock=time.monotonic, admits=1000):
        self.name, self._admits = name, admits
        self.token = secrets.token_urlsafe(16)
        self.code = "".join(secrets.choice(LETTERS) for _ in range(8))
        self._cookies, self._tries = set(), Buckets(TRIES, ALL_TRIES, clock)

    @property
    def clients(self):
        """int, how many have come in."""
        return len(self._cookies)

    def client(self, handler):
        """Who asks.

        Parameters
        ----------
        handler : RequestHandler of tornado

        Returns
        -------
        str or None
        """
        cookie = handler.get_cookie(self.name)
        return cookie if cookie in self._cookies else None

    def enter(self, given, address):
        """Change a token or a code into a cookie.

        Parameters
        ----------
        given : str
        address : str, whose it is

        Returns
        -------
        str, the cookie

        Raises
        ------
        Refused : 403 wrong, 429 too many tries, 503 nobody more comes in
        """
        given = given.strip().encode(errors="replace")
        right = secrets.compare_digest(given, self.token.encode())
        if not right:  # a right token is let in whatever others at its address try
            if not self._tries.take(address):
                raise Refused(429)
            letters = given.upper().replace(b"-", b"").replace(b" ", b"")
            right = secrets.compare_digest(letters, self.code.encode())
        if not right:
            raise Refused(403)
        if len(self._cookies) >= self._admits:
            raise Refused(503)
        cookie = secrets.token_urlsafe(16)
        self._cookies.add(cookie)
        return cookie


class Key:
    """A key of 128 bits, shown with each request: ``Authorization: Bearer ...``."""

    def __init__(self):
        self.token = secrets.token_urlsafe(16)

    def client(self, handler):
        """Who asks: "key", or None where the key is wrong or missing."""
        shown = handler.request.headers.get("Authorization", "")
        return "key" if secrets.compare_digest(shown.encode(), self._expected) else None

    @property
    def _expected(self):
        return f"Bearer {self.token}".encode()
