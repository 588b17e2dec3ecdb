"""A simulated LMS for tests: token, pages of members, line items and scores."""

import json
import threading
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from urllib.parse import parse_qs, urlsplit

from joserfc import jwk, jwt

from classroom.grading.lti.grade_passback import LINE_ITEM, LINE_ITEMS, SCORE
from classroom.grading.lti.names_and_roles import MEDIA
from classroom.grading.lti.service import SCOPES

CLIENT = "slam-42"
LEARNER = "http://purl.imsglobal.org/vocab/lis/v2/membership#Learner"
TEACHER = "http://purl.imsglobal.org/vocab/lis/v2/membership#Instructor"


class FakeLms:
    """What it knows and what it received; ``answers`` overrides paths with (status, headers, data).

    Parameters
    ----------
    members : list of dict
    """

    def __init__(self, members):
        self.members, self.items, self.scores, self.asked = members, [], [], []
        self.answers, self.key, self.jtis = {}, None, set()
        self.url, self.refused = None, ()

    def trust(self, public):
        """Register the tool's public key, a JWK."""
        self.key = jwk.RSAKey.import_key(public)
        self.kid = public["kid"]

    def token(self, form):
        """A token for an assertion that holds; None for another."""
        try:
            signed = jwt.decode(form["client_assertion"][0], self.key, algorithms=["RS256"])
        except Exception:
            return None
        claims = signed.claims
        fits = (
            signed.header.get("kid") == self.kid
            and claims["iss"] == claims["sub"] == CLIENT
            and claims["aud"] in (f"{self.url}/token", [f"{self.url}/token"])
            and claims["exp"] > claims["iat"]
            and claims["jti"] not in self.jtis
            and form["grant_type"] == ["client_credentials"]
            and set(form["scope"][0].split()) == set(SCOPES)
        )
        self.jtis.add(claims["jti"])
        return "secret-token" if fits else None


@contextmanager
def fake_lms(members):
    """A FakeLms that answers."""
    lms = FakeLms(members)

    class Handler(BaseHTTPRequestHandler):
        def log_message(self, *_):
            pass

        def reply(self, body, media="application/json", status=200, **headers):
            data = body if isinstance(body, bytes) else json.dumps(body).encode()
            self.send_response(status)
            for name, value in (
                {"Content-Type": media, "Content-Length": len(data)} | headers
            ).items():
                self.send_header(name, str(value))
            self.end_headers()
            self.wfile.write(data)

        def may(self):
            lms.asked.append((self.command, self.path))
            path = urlsplit(self.path).path
            if path in lms.answers:
                status, headers, data = lms.answers[path]
                self.reply(data, status=status, **headers)
            elif self.headers.get("Authorization") == "Bearer secret-token":
                return True
            else:
                self.reply({"error": "no token"}, status=401)
            return False

        def do_GET(self):
            if not self.may():
                return
            parts = urlsplit(self.path)
            query = parse_qs(parts.query)
            if parts.path == "/members" and self.headers["Accept"] == MEDIA:
                page = int(query.get("page", ["0"])[0])
                some = lms.members[2 * page : 2 * page + 2]
                more = {}
                if lms.members[2 * page + 2 :]:
                    more = {"Link": f'<{lms.url}/members?page={page + 1}>; rel="next"'}
                self.reply({"id": "x", "members": some}, MEDIA, **more)
            elif parts.path == "/items" and self.headers["Accept"] == LINE_ITEMS:
                self.reply(lms.items, LINE_ITEMS)
            else:
                self.reply({}, status=404)

        def do_POST(self):
            data = self.rfile.read(int(self.headers["Content-Length"]))
            path, media = urlsplit(self.path).path, self.headers["Content-Type"]
            if path == "/token" and path not in lms.answers:
                token = lms.token(parse_qs(data.decode()))
                reported = {"access_token": token, "token_type": "Bearer", "expires_in": 3600}
                self.reply(
                    reported if token else {"error": "invalid_client"}, status=200 if token else 400
                )
            elif not self.may():
                return
            elif path == "/items" and media == LINE_ITEM:
                item = json.loads(data) | {"id": f"{lms.url}/items/7/lineitem?type=1"}
                lms.items.append(item)
                self.reply(item, LINE_ITEM, 201)
            elif path == "/items/7/lineitem/scores" and media == SCORE:
                score = json.loads(data)
                if score["userId"] in lms.refused:
                    self.reply({"error": "no such user"}, status=422)
                else:
                    lms.scores.append(score)
                    self.reply(b"", status=204)
            else:
                self.reply({}, status=404)

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    lms.url = f"http://127.0.0.1:{server.server_port}"
    thread = threading.Thread(target=server.serve_forever, daemon=True)
    thread.start()
    try:
        yield lms
    finally:
        server.shutdown()
        thread.join()
        server.server_close()
