"""Authentication: login by a token or a code, session cookies, and bearer tokens."""

import secrets
import time

from slamlab.live.web_server.rate_limits import ClientBuckets, Rate

LETTERS = "ABCDEFGHJKMNPRSTWXYZ"  # without letters that are easily confused with others or digits
# Two hundred people may share one address, and each may mistype once: so many attempts it has.
# In two hours all have 38 000 attempts, which find one of 20**8 codes once in 600 000 sessions.
ATTEMPTS, ALL_ATTEMPTS = Rate(400, 2), Rate(2000, 5)


class LoginRefused(Exception):
    """The login is refused; ``status`` is the HTTP status."""

    def __init__(self, status):
        super().__init__(status)
        self.status = status


class Sessions:
    """Session cookies, issued for a token (128 bits, for a QR code) or a code of 8 letters.
    ``name`` is the cookie's name. At most ``max_clients`` can log in.
    """

    def __init__(self, name, clock=time.monotonic, max_clients=1000):
        self.name, self._max_clients = name, max_clients
        self.token = secrets.token_urlsafe(16)
        self.code = "".join(secrets.choice(LETTERS) for _ in range(8))
        self._cookies, self._attempts = set(), ClientBuckets(ATTEMPTS, ALL_ATTEMPTS, clock)

    @property
    def client_count(self):
        return len(self._cookies)

    def client(self, handler):
        """Return the cookie of a handler's request, or None."""
        cookie = handler.get_cookie(self.name)
        return cookie if cookie in self._cookies else None

    def log_in(self, key, address):
        """Exchange a token or code for a cookie. LoginRefused: wrong key (403), too many attempts
        (429) or too many clients (503).
        """
        key = key.strip().encode(errors="replace")
        correct = secrets.compare_digest(key, self.token.encode())
        if not correct:  # a correct token is accepted whatever others at its address try
            if not self._attempts.take(address):
                raise LoginRefused(429)
            letters = key.upper().replace(b"-", b"").replace(b" ", b"")
            correct = secrets.compare_digest(letters, self.code.encode())
        if not correct:
            raise LoginRefused(403)
        if len(self._cookies) >= self._max_clients:
            raise LoginRefused(503)
        cookie = secrets.token_urlsafe(16)
        self._cookies.add(cookie)
        return cookie


class BearerToken:
    """A token of 128 bits, sent with each request: ``Authorization: Bearer ...``."""

    def __init__(self):
        self.token = secrets.token_urlsafe(16)

    def client(self, handler):
        sent = handler.request.headers.get("Authorization", "")
        return "bearer" if secrets.compare_digest(sent.encode(), self._expected) else None

    @property
    def _expected(self):
        return f"Bearer {self.token}".encode()
