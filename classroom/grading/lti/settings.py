"""LTI settings: the table ``[lti]`` of a course file, with the URLs of an LMS's services."""

from dataclasses import dataclass
from pathlib import Path
from urllib.parse import urlsplit

_URLS = ("token_url", "members_url", "line_items_url")
_ALLOWED = ("client_id", *_URLS, "audience", "key")
_LOOPBACK = ("localhost", "127.0.0.1", "::1")


@dataclass(frozen=True)
class Settings:
    """LTI settings of an LMS; all URLs have one origin."""

    client_id: str  # issued by the LMS when the tool was registered
    token_url: str
    members_url: str
    line_items_url: str
    audience: str  # of the assertion; most LMSs require the token URL
    key: Path  # the private key (PEM)


def settings(table, folder):
    """Check a table and return its Settings. Raises ValueError."""
    for name, value in table.items():
        if name not in _ALLOWED:
            raise ValueError(
                f"setting lti.{name} does not exist; the settings are {', '.join(_ALLOWED)}"
            )
        if not isinstance(value, str) or not value:
            raise ValueError(f"lti.{name} must be text in quotes, not {value!r}")
    missing = [name for name in ("client_id", *_URLS) if name not in table]
    if missing:
        raise ValueError(f"[lti] lacks {', '.join(missing)}; copy the values from the LMS")
    for name in _URLS:
        check_url(table[name], f"lti.{name}")
    if len({origin(table[name]) for name in _URLS}) > 1:
        raise ValueError("[lti]: all URLs must have the same host, because each gets the token")
    return Settings(
        **{name: table[name] for name in ("client_id", *_URLS)},
        audience=table.get("audience", table["token_url"]),
        key=folder / table.get("key", "lti.pem"),
    )


def check_url(url, name):
    """Raise ValueError for a URL to which no access token may be sent."""
    try:
        parts = urlsplit(url)
        known = parts.hostname and (parts.port or True)
    except ValueError:
        known = False
    if not known or parts.username is not None or parts.fragment:
        raise ValueError(f"{name} must be a URL such as https://lms.example/…, not {url[:200]!r}")
    if parts.scheme != "https" and not (parts.scheme == "http" and parts.hostname in _LOOPBACK):
        raise ValueError(f"{name} must begin with https://, because a token is sent to it")


def origin(url):
    parts = urlsplit(url)
    return parts.scheme, parts.hostname, parts.port or {"https": 443, "http": 80}.get(parts.scheme)
