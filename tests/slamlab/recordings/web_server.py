"""A web server that publishes three recordings."""

import gzip
import hashlib
import http.server
import json
from pathlib import Path

from slamlab.sources import downloading

SCANS = {"976052892.4424": (1.0, [2, 3.25]), "976052890.244111": (-0.5, [81.83, 0.1])}
PUBLISHED = {
    "plain": bytes(range(10, 250)) * 300,
    "packed": b"EDGE_SE2 0 1 1.0 0.0 0.1\n" * 9000,
    "log": json.dumps(
        {"map": {t: {"x": x, "y": 0, "theta": 0.1, "range": r} for t, (x, r) in SCANS.items()}}
    ).encode(),
}
LOG = downloading.INTEL_HEAD.encode() + (
    b"\nFLASER 2 81.83 0.10 -0.500000 0.000000 0.100000 -0.500000 0.000000 0.100000 "
    b"976052890.244111 intel 0.000000"
    b"\nFLASER 2 2.00 3.25 1.000000 0.000000 0.100000 1.000000 0.000000 0.100000 "
    b"976052892.442400 intel 2.198289\n"
)
FILES = {"plain": "a/plain.dat", "packed": "b/packed.g2o.gz", "log": "a/log.log.gz"}


def sha256(content):
    return hashlib.sha256(content).hexdigest()


class Handler(http.server.BaseHTTPRequestHandler):
    """Answers /fault/NAME as the server's ``fault`` does, other paths with the published files."""

    def do_GET(self):
        kind, _, name = self.path.strip("/").rpartition("/")
        name = {Path(file).name: known for known, file in FILES.items()}.get(name, name)
        content = PUBLISHED[name]
        if kind == "published":  # as a repository's address does
            redirect(self, f"http://{self.headers['Host']}/elsewhere/{name}")
        elif kind == "elsewhere":
            redirect(self, f"/content/{name}")
        elif kind == "content" or self.server.fault is None:
            send(self, content)
        else:
            self.server.fault(self, content)

    do_HEAD = do_GET

    def log_message(self, *words):
        pass


def send(handler, content, length=None, status=200, **headers):
    handler.send_response(status)
    handler.send_header("Content-Length", str(len(content) if length is None else length))
    for name, value in headers.items():
        handler.send_header(name.replace("_", "-"), value)
    handler.end_headers()
    if handler.command == "GET":
        handler.wfile.write(content)


def redirect(handler, address):
    send(handler, b"", status=302, Location=address)


def content(path):
    return gzip.decompress(path.read_bytes()) if path.suffix == ".gz" else path.read_bytes()


def files(folder):
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}
