"""A client of an LMS's services: a token by a signed assertion, and bounded requests.

A token goes to the origin of the course file alone, whatever URLs an answer names, and no
redirection is followed.
"""

import json

from slamlab.grading.lti.keys import LtiError, library, load_key
from slamlab.grading.lti.settings import check_url, origin

SCOPES = (
    "https://purl.imsglobal.org/spec/lti-nrps/scope/contextmembership.readonly",
    "https://purl.imsglobal.org/spec/lti-ags/scope/lineitem",
    "https://purl.imsglobal.org/spec/lti-ags/scope/score",
)
PATIENCE = 30  # for a connection, and between two pieces of an answer [s]
MOST_BYTES = 20_000_000  # of an answer
MOST_PAGES = 200


class Service:
    """A session with an LMS.

    Parameters
    ----------
    settings : Settings

    Raises
    ------
    LtiError : here and from every method
    """

    def __init__(self, settings):
        client, rfc7523, _ = library()
        key = load_key(settings.key)
        self._origin = origin(settings.token_url)
        self._session = client.OAuth2Session(
            settings.client_id,
            key,
            token_endpoint_auth_method="private_key_jwt",
            scope=" ".join(SCOPES),
            default_timeout=PATIENCE,
        )
        self._session.max_redirects = 0
        signed = rfc7523.PrivateKeyJWT(settings.audience, headers={"kid": key.thumbprint()})
        self._session.register_client_auth_method(signed)
        url = settings.token_url
        self._asked(url, lambda: self._session.fetch_token(url, grant_type="client_credentials"))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._session.close()

    def pages(self, url, media):
        """All pages of a list.

        Parameters
        ----------
        url : str
        media : str, the type of what is asked for

        Yields
        ------
        what JSON holds
        """
        seen = set()
        while url:
            if url in seen or len(seen) == MOST_PAGES:
                raise LtiError(f"{url[:200]}: a list without an end")
            seen.add(url)
            answer = self._send("GET", url, headers={"Accept": media})
            yield answer.json
            url = answer.next

    def post(self, url, media, body):
        """Send something.

        Parameters
        ----------
        url : str
        media : str, the type of what is sent
        body : dict of plain values

        Returns
        -------
        what JSON holds; None for nothing
        """
        data = json.dumps(body).encode()
        headers = {"Content-Type": media, "Accept": f"{media}, application/json, */*"}
        return self._send("POST", url, data=data, headers=headers).json

    def _send(self, method, url, **given):
        try:
            check_url(url, "a URL that the LMS told")
        except ValueError as error:
            raise LtiError(str(error)) from None
        if origin(url) != self._origin:
            raise LtiError(f"the LMS names another host, {url[:200]}: no token is sent there")
        return self._asked(url, lambda: self._answer(method, url, given))

    def _answer(self, method, url, given):
        with self._session.request(method, url, stream=True, **given) as response:
            data = b""
            for piece in response.iter_content(65_536):
                data += piece
                if len(data) > MOST_BYTES:
                    raise LtiError(f"{url[:200]}: more than {MOST_BYTES // 1_000_000} MB")
            if not response.ok:
                said = _printable(data[:200].decode("utf-8", "replace"))
                raise LtiError(f"{url[:200]}: HTTP {response.status_code}: {said}")
            return _Answer(url, response, data)

    def _asked(self, url, deed):
        import requests
        from authlib.common.errors import AuthlibBaseError
        from joserfc.errors import JoseError

        try:
            return deed()
        except requests.exceptions.TooManyRedirects:
            raise LtiError(f"{url[:200]} leads elsewhere; say the URL it leads to") from None
        except (requests.RequestException, AuthlibBaseError, JoseError, ValueError) as error:
            said = _printable(f"{type(error).__name__}: {error}")
            raise LtiError(f"{url[:200]} does not answer as LTI has it: {said[:300]}") from None


class _Answer:
    """What came back: JSON, and the URL of the next page, None for none."""

    def __init__(self, url, response, data):
        self.next = response.links.get("next", {}).get("url")
        try:
            self.json = json.loads(data) if data.strip() else None
        except (ValueError, RecursionError):
            raise LtiError(f"{url[:200]}: no JSON") from None


def _printable(text):
    return "".join(c if c.isprintable() else " " for c in text)
