"""Three recordings, the web server that publishes them, and the folder that they are fetched to."""

import http.server
import threading

import pytest

from slamlab.sources.public_datasets import RECORDINGS, PublicDataset
from tests.slamlab.recordings.web_server import FILES, LOG, PUBLISHED, Handler, sha256


@pytest.fixture
def server():
    made = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    made.daemon_threads, made.fault, made.over = True, None, threading.Event()
    made.address = f"http://127.0.0.1:{made.server_port}"
    threading.Thread(target=made.serve_forever, args=[0.01], daemon=True).start()
    yield made
    made.over.set()
    made.shutdown()
    made.server_close()


@pytest.fixture
def folder(server, monkeypatch, tmp_path):
    """An empty data folder, for three recordings that the server publishes."""
    known = dict(RECORDINGS)
    RECORDINGS.clear()
    for name, content in PUBLISHED.items():
        converted = sha256(LOG) if name == "log" else ""
        described = sha256(content), converted, "not stated", "Nobody", "a test"
        address = f"{server.address}/published/{name}"
        RECORDINGS[name] = PublicDataset(name, FILES[name], len(content), *described, address)
    for name in ("HTTP_PROXY", "HTTPS_PROXY", "ALL_PROXY", "REQUESTS_CA_BUNDLE"):
        monkeypatch.delenv(name, raising=False)
        monkeypatch.delenv(name.lower(), raising=False)
    monkeypatch.setenv("SLAMLAB_DATA", str(tmp_path / "data"))
    yield tmp_path / "data"
    RECORDINGS.clear()
    RECORDINGS.update(known)
