"""The table ``[lti]`` of a course file: where an LMS offers LTI Advantage's services."""

from dataclasses import dataclass
from pathlib import Path
from urllib.parse import urlsplit

_URLS = ("token_url", "members_url", "line_items_url")
_ALLOWED = ("client_id", *_URLS, "audience", "key")
_LOOPBACK = ("localhost", "127.0.0.1", "::1")


@dataclass(frozen=True)
class Settings:
    """What there is to know of an LMS.

    Parameters
    ----------
    client_id : str, which the LMS gave when the tool was registered
    token_url, members_url, line_items_url : str, all of one origin
    audience : str, of the assertion; what most LMSs want is the token's URL
    key : Path, the private key, PEM
    """

    client_id: str
    token_url: str
    members_url: str
    line_items_url: str
    audience: str
    key: Path


def settings(table, folder):
    """Check the table.

    Parameters
    ----------
    table : dict
    folder : Path, of the course file

    Returns
    -------
    Settings

    Raises
    ------
    ValueError
    """
    for name, value in table.items():
        if name not in _ALLOWED:
            raise ValueError(f"there is no setting lti.{name}; there are {', '.join(_ALLOWED)}")
        if not isinstance(value, str) or not value:
            raise ValueError(f"lti.{name} is text in quotes, not {value!r}")
    missing = [name for name in ("client_id", *_URLS) if name not in table]
    if missing:
        raise ValueError(f"[lti] says no {', '.join(missing)}: the LMS told it")
    for name in _URLS:
        check_url(table[name], f"lti.{name}")
    if len({origin(table[name]) for name in _URLS}) > 1:
        raise ValueError("[lti]: all URLs must be of one host, for a token is sent to each")
    return Settings(
        **{name: table[name] for name in ("client_id", *_URLS)},
        audience=table.get("audience", table["token_url"]),
        key=folder / table.get("key", "lti.pem"),
    )


def check_url(url, name):
    """Refuse a URL that a token must not be sent to.

    Raises
    ------
    ValueError
    """
    try:
        parts = urlsplit(url)
        known = parts.hostname and (parts.port or True)
    except ValueError:
        known = False
    if not known or parts.username is not None or parts.fragment:
        raise ValueError(f"{name} is a URL such as https://lms.example/…, not {url[:200]!r}")
    if parts.scheme != "https" and not (parts.scheme == "http" and parts.hostname in _LOOPBACK):
        raise ValueError(f"{name} must begin with https://, for a token is sent to it")


def origin(url):
    """Scheme, host and port of a URL.

    Parameters
    ----------
    url : str

    Returns
    -------
    tuple
    """
    parts = urlsplit(url)
    return parts.scheme, parts.hostname, parts.port or {"https": 443, "http": 80}.get(parts.scheme)
