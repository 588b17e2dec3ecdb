"""HTTP client of an LMS's services: an access token for a signed assertion, and bounded requests.
The token is sent only to the origin in the course file, even if a response contains other URLs.
Redirects are not followed.
"""

import json

from classroom.grading.lti.keys import LtiError, library, load_key
from classroom.grading.lti.settings import check_url, origin

SCOPES = (
    "https://purl.imsglobal.org/spec/lti-nrps/scope/contextmembership.readonly",
    "https://purl.imsglobal.org/spec/lti-ags/scope/lineitem",
    "https://purl.imsglobal.org/spec/lti-ags/scope/score",
)
TIMEOUT = 30  # for a connection, and between two chunks of an answer [s]
MAX_BYTES = 20_000_000  # of an answer
MAX_PAGES = 200


class Service:
    """A session with an LMS. The constructor and every method can raise LtiError."""

    def __init__(self, settings):
        client, rfc7523, _ = library()
        key = load_key(settings.key)
        self._origin = origin(settings.token_url)
        self._session = client.OAuth2Session(
            settings.client_id,
            key,
            token_endpoint_auth_method="private_key_jwt",
            scope=" ".join(SCOPES),
            default_timeout=TIMEOUT,
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
        """Yield the JSON of all pages of a list."""
        seen = set()
        while url:
            if url in seen or len(seen) == MAX_PAGES:
                raise LtiError(f"{url[:200]}: the list has no end")
            seen.add(url)
            answer = self._send("GET", url, headers={"Accept": media})
            yield answer.json
            url = answer.next

    def post(self, url, media, body):
        """Send plain values; return the JSON of the response."""
        data = json.dumps(body).encode()
        headers = {"Content-Type": media, "Accept": f"{media}, application/json, */*"}
        return self._send("POST", url, data=data, headers=headers).json

    def _send(self, method, url, **given):
        try:
            check_url(url, "a URL from the LMS")
        except ValueError as error:
            raise LtiError(str(error)) from None
        if origin(url) != self._origin:
            raise LtiError(f"the LMS refers to another host, {url[:200]}; no token is sent to it")
        return self._asked(url, lambda: self._answer(method, url, given))

    def _answer(self, method, url, given):
        with self._session.request(method, url, stream=True, **given) as response:
            data = b""
            for piece in response.iter_content(65_536):
                data += piece
                if len(data) > MAX_BYTES:
                    limit = MAX_BYTES // 1_000_000
                    raise LtiError(f"{url[:200]}: the response has more than {limit} MB")
            if not response.ok:
                message = _printable(data[:200].decode("utf-8", "replace"))
                raise LtiError(f"{url[:200]}: HTTP {response.status_code}: {message}")
            return _Answer(url, response, data)

    def _asked(self, url, request):
        import requests
        from authlib.common.errors import AuthlibBaseError
        from joserfc.errors import JoseError

        try:
            return request()
        except requests.exceptions.TooManyRedirects:
            raise LtiError(f"{url[:200]} redirects; give the URL of the target") from None
        except (requests.RequestException, AuthlibBaseError, JoseError, ValueError) as error:
            message = _printable(f"{type(error).__name__}: {error}")[:300]
            raise LtiError(f"{url[:200]} gave no valid LTI response: {message}") from None


class _Answer:
    def __init__(self, url, response, data):
        self.next = response.links.get("next", {}).get("url")
        try:
            self.json = json.loads(data) if data.strip() else None
        except (ValueError, RecursionError):
            raise LtiError(f"{url[:200]}: the response is not JSON") from None


def _printable(text):
    return "".join(c if c.isprintable() else " " for c in text)
