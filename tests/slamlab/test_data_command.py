"""Recordings by name: fetched whole and as published, or refused in one line with nothing lost."""

import contextlib
import gzip
import hashlib
import http.server
import json
import os
import shutil
import socket
import ssl
import subprocess
import threading
from dataclasses import replace
from pathlib import Path

import pooch  # noqa: F401 - the extra, without which this file is skipped
import pytest

from slamlab import sources
from slamlab.cli import main
from slamlab.sources import downloading
from slamlab.sources.public_datasets import RECORDINGS, PublicDataset, resolve
from tests.timeouts import PATIENCE

OLD = b"what was there before"
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
CONTENTS = PUBLISHED | {"log": LOG}
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


def content(path):
    return gzip.decompress(path.read_bytes()) if path.suffix == ".gz" else path.read_bytes()


def files(folder):
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}


def holds_all(folder):
    return files(folder) == set(FILES.values()) and all(
        content(folder / file) == CONTENTS[name] for name, file in FILES.items()
    )


@pytest.mark.parametrize("words", [["--all"], list(FILES)])
def test_recordings_are_fetched_through_redirects_byte_for_byte(words, folder, capsys):
    assert main(["data", "get", *words]) == 0
    assert holds_all(folder)
    assert capsys.readouterr().out.count(": written to ") == 3
    assert main(["data", "get", *words]) == 0
    assert capsys.readouterr().out.count(": already at ") == 3


def test_a_converted_log_is_read_with_the_published_stamps_odometry_and_ranges(folder):
    main(["data", "get", "log"])
    first, second = sources.open("log")
    assert second.time - first.time == pytest.approx(2.198289, abs=1e-6)
    assert second.odometry[0] == pytest.approx(1.5 * 0.995004, abs=1e-5)
    assert list(second.scan.ranges) == [2.0, 3.25]


def test_a_compressing_server_changes_nothing(server, folder):
    server.fault = lambda h, c: send(h, gzip.compress(c), Content_Encoding="gzip")
    assert main(["data", "get", "--all", "--from", f"{server.address}/fault"]) == 0
    assert holds_all(folder)


def test_a_mirror_serves_as_a_folder_and_from_a_web_server(folder, tmp_path, monkeypatch, capsys):
    main(["data", "get", "plain", "packed"])
    mirror = tmp_path / "stick"
    assert main(["data", "mirror", str(mirror)]) == 0
    assert "not copied: log" in capsys.readouterr().out
    main(["data", "get", "log"])
    assert main(["data", "mirror", str(mirror)]) == 0 and holds_all(mirror)
    handler = type("Files", (http.server.SimpleHTTPRequestHandler,), {"directory": str(mirror)})
    monkeypatch.setattr(handler, "__init__", _in(mirror))
    monkeypatch.setattr(handler, "log_message", lambda *words: None)
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as site:
        threading.Thread(target=site.serve_forever, args=[0.01], daemon=True).start()
        for origin in (str(mirror), f"http://127.0.0.1:{site.server_port}/"):
            shutil.rmtree(folder)
            assert main(["data", "get", "--all", "--from", origin]) == 0
            assert holds_all(folder)
        site.shutdown()


def _in(directory):
    def begin(self, *words, **more):
        http.server.SimpleHTTPRequestHandler.__init__(self, *words, directory=directory, **more)

    return begin


def test_a_file_fetched_by_hand_is_found_by_its_published_name(folder, tmp_path):
    (tmp_path / "log").write_bytes(PUBLISHED["log"])
    assert main(["data", "get", "log", "--from", str(tmp_path)]) == 0
    assert content(folder / FILES["log"]) == LOG


def test_two_at_once_both_succeed(server, folder):
    both = threading.Barrier(2)

    def together(handler, sent):
        both.wait(PATIENCE)
        send(handler, sent)

    server.fault, codes = together, []
    words = ["data", "get", "packed", "--from", f"{server.address}/fault"]
    runs = [threading.Thread(target=lambda: codes.append(main(words))) for _ in range(2)]
    for run in runs:
        run.start()
    for run in runs:
        run.join(PATIENCE)
    assert codes == [0, 0] and files(folder) == {FILES["packed"]}


def stall(handler, sent):
    """Send half of a file and then nothing."""
    handler.send_response(200)
    handler.send_header("Content-Length", str(len(sent)))
    handler.end_headers()
    handler.wfile.write(sent[: len(sent) // 2])
    handler.wfile.flush()
    handler.server.over.wait(PATIENCE)


def without_length(handler, sent):
    handler.send_response(200)
    handler.end_headers()
    handler.wfile.write(sent)


def raw(answer):
    return lambda handler, sent: handler.wfile.write(answer)


def page(handler, sent):
    send(handler, b"<html>Sign in to the network</html>", Content_Type="text/html")


def other(change):
    return lambda handler, sent: send(handler, change(sent))


def endless(handler, sent):
    """Send a file again and again, as long as anybody reads it."""
    with contextlib.suppress(OSError):
        without_length(handler, sent)
        while not handler.server.over.wait(0.001):
            handler.wfile.write(sent)


ANSWERS = {  # of a server: what it does, and what the line states
    **{
        f"status {status}": (lambda h, c, status=status: send(h, b"", status=status), str(status))
        for status in (401, 403, 404, 407, 410, 429, 500, 503)
    },
    "a redirect in a circle": (lambda h, c: redirect(h, h.path), "transfer"),
    "a redirect to a file": (lambda h, c: redirect(h, "file:///etc/passwd"), "transfer"),
    "a redirect to nowhere": (lambda h, c: redirect(h, "http://127.0.0.1:9/x"), "reached"),
    "a redirect without an address": (lambda h, c: send(h, b"", status=302), "differs"),
    "half the file": (lambda h, c: send(h, c[: len(c) // 2], len(c)), "transfer"),
    "half the file without its length": (lambda h, c: without_length(h, c[:-900]), "differs"),
    "a file without an end": (endless, "more than the published file"),
    "an empty file": (other(lambda c: b""), "differs"),
    "another byte": (other(lambda c: c[:-1] + b"?"), "differs"),
    "one more byte": (other(lambda c: c + b"\n"), "differs"),
    "the page of a hotel": (page, "differs"),
    "no gzip where gzip is announced": (
        lambda h, c: send(h, b"no gzip", Content_Encoding="gzip"), "transfer",
    ),
    "a closed connection": (lambda h, c: None, "reached"),
    "no HTTP": (raw(b"SSH-2.0-OpenSSH_9\r\n"), "reached"),
    "silence": (lambda h, c: h.server.over.wait(PATIENCE), "does not answer"),
    "silence after one half": (stall, "does not answer"),
}  # fmt: skip


@pytest.fixture(params=[False, True], ids=["nothing there", "old file there"])
def refused(request, folder, capsys):
    """A function that checks that a command is refused in one line and loses nothing."""
    old = folder / FILES["packed"]
    if request.param:
        old.parent.mkdir(parents=True)
        old.write_bytes(OLD)

    def check(expected, *words, code=2):
        before = files(folder)
        assert main(["data", "get", "packed", *words]) == code
        out, err = capsys.readouterr()
        assert out == "" and err.count("\n") == 1 and "Traceback" not in err
        assert expected in err, err
        assert RECORDINGS["packed"].address in err and "--from FOLDER" in err
        assert ("unchanged" if request.param else "Nothing was written") in err
        assert files(folder) == before and (not request.param or old.read_bytes() == OLD)

    return check


@pytest.mark.parametrize("fault", ANSWERS)
def test_a_bad_answer_is_refused_and_a_better_one_taken(
    fault, server, folder, refused, monkeypatch
):
    monkeypatch.setattr(downloading, "FIRST_BYTE", 0.3 if "silence" in fault else PATIENCE)
    monkeypatch.setattr(downloading, "SILENCE", 0.3 if "silence" in fault else PATIENCE)
    server.fault, expected = ANSWERS[fault]
    RECORDINGS["packed"] = replace(
        RECORDINGS["packed"], address=f"{server.address}/fault/packed"
    )  # fmt: skip
    refused(expected)
    refused(expected, "--from", f"{server.address}/fault")
    server.fault = None
    monkeypatch.setattr(downloading, "FIRST_BYTE", PATIENCE)
    assert main(["data", "get", "packed"]) == 0
    assert content(folder / FILES["packed"]) == PUBLISHED["packed"]


def test_a_network_that_never_answers_is_given_up(refused, monkeypatch):
    """Not even a name is found: no timeout of a connection would end that."""
    assert downloading.FIRST_BYTE < 4.5
    over = threading.Event()
    monkeypatch.setattr(downloading, "FIRST_BYTE", 0.3)
    monkeypatch.setattr(socket, "getaddrinfo", lambda *words, **more: over.wait(PATIENCE))
    refused("does not answer")
    over.set()


@pytest.mark.parametrize(
    ("variables", "origin", "expected"),
    [
        ({}, "http://127.0.0.1:9", "127.0.0.1:9 cannot be reached"),
        ({}, "http://no-such-host.invalid", "no-such-host.invalid cannot be reached"),
        ({}, "http://", "transfer"),
        ({}, "ftp://127.0.0.1", "transfer"),
        ({"HTTP_PROXY": "http://127.0.0.1:9"}, "http://example.invalid", "HTTPS_PROXY"),
        ({"HTTPS_PROXY": "http://127.0.0.1:9"}, "https://example.invalid", "HTTPS_PROXY"),
        ({"REQUESTS_CA_BUNDLE": "/no/such/file"}, "https://127.0.0.1:9", "/no/such/file"),
    ],
)
def test_a_host_that_cannot_be_reached_is_named(variables, origin, expected, refused, monkeypatch):
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    refused(expected, "--from", origin)


def test_a_certificate_that_is_not_trusted_is_refused(server, refused, tmp_path):
    if not shutil.which("openssl"):
        pytest.skip("openssl, which makes a certificate, is not installed")
    key, certificate = tmp_path / "key.pem", tmp_path / "certificate.pem"
    words = ["req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2", "-subj", "/CN=me"]
    subprocess.run(
        ["openssl", *words, "-keyout", key, "-out", certificate], check=True, capture_output=True
    )
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.load_cert_chain(certificate, key)
    server.socket = context.wrap_socket(server.socket, server_side=True)
    refused("REQUESTS_CA_BUNDLE", "--from", server.address.replace("http:", "https:"))


def truncated(folder):
    (folder / "packed").write_bytes(gzip.compress(PUBLISHED["packed"])[:-300])


@pytest.mark.parametrize(
    ("fill", "expected"),
    [
        (lambda folder: None, "contains neither"),
        (lambda folder: folder.rmdir(), "contains neither"),
        (lambda folder: (folder / "packed").mkdir(), "contains neither"),
        (lambda folder: (folder / "packed").write_bytes(OLD), "differs"),
        (lambda folder: (folder / "packed").touch(), "differs"),
        (truncated, "differs"),
    ],
)
def test_a_folder_without_the_file_is_refused(fill, expected, refused, tmp_path):
    stick = tmp_path / "stick"
    stick.mkdir()
    fill(stick)
    refused(expected, "--from", str(stick))


@pytest.mark.parametrize(
    "changed",
    [
        b"{",
        b"[]",
        b'{"map":' + 100_000 * b"[",
        b'{"map": []}',
        b'{"map": {"first": {}}}',
        b'{"map": {"1.0": {"x": 0, "y": 0, "theta": 0}}}',
        b'{"map": {"1.0": {"x": "0", "y": 0, "theta": 0, "range": [1]}}}',
        PUBLISHED["log"].replace(b"3.25", b"3.26"),
        PUBLISHED["log"].replace(b"-0.5", b"-0.6"),
        PUBLISHED["log"].replace(b"2.4424", b"2.4425"),
    ],
)
def test_a_log_with_another_number_or_form_is_refused(changed, folder, tmp_path, capsys):
    (tmp_path / "log").write_bytes(changed)
    assert main(["data", "get", "log", "--from", str(tmp_path)]) == 2
    assert "differs" in capsys.readouterr().err and not files(folder)


def test_a_published_file_in_place_of_its_log_is_replaced(folder):
    path = folder / FILES["log"]
    path.parent.mkdir(parents=True)
    path.write_bytes(PUBLISHED["log"])
    assert main(["data", "get", "log"]) == 0 and content(path) == LOG


@contextlib.contextmanager
def disk_of(size):
    """Let no file grow beyond some bytes, as on a full disk."""
    resource = pytest.importorskip("resource")  # not on Windows
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


@pytest.mark.parametrize("from_folder", [False, True])
def test_a_full_disk_is_stated(from_folder, refused, tmp_path):
    (tmp_path / "packed").write_bytes(PUBLISHED["packed"])
    with disk_of(100):
        refused("too large", *(["--from", str(tmp_path)] if from_folder else []))


def test_a_data_folder_that_cannot_be_written_ends_the_command(folder, capsys):
    folder.write_bytes(OLD)
    assert main(["data", "get", "--all"]) == 2
    assert capsys.readouterr().err.count("\n") == 1 and folder.read_bytes() == OLD


def test_one_file_that_is_gone_does_not_keep_the_others(folder, capsys):
    RECORDINGS["plain"] = replace(RECORDINGS["plain"], address="http://127.0.0.1:9/published")
    RECORDINGS["packed"] = replace(RECORDINGS["packed"], sha256="0" * 64)
    assert main(["data", "get", "packed", "log"]) == 1
    out, err = capsys.readouterr()
    assert err.startswith("slamlab data get: packed: ") and out.startswith("log: written to ")
    assert main(["data", "get", "plain", "packed"]) == 2  # nobody asks again without a network
    assert capsys.readouterr().err.count("\n") == 1


def test_the_table_states_what_is_here_without_a_network(folder, capsys, monkeypatch):
    main(["data", "get", "plain"])
    capsys.readouterr()
    monkeypatch.setattr(socket, "socket", None)
    assert main(["data"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert str(folder) in lines[0]
    for name, row in RECORDINGS.items():
        (line,) = (line for line in lines if line.startswith(f"{name} "))
        assert row.size in line and row.about in line and (" here " in line) == (name == "plain")
    assert lines[-1].endswith("licence: not stated; cite: Nobody")


def test_check_compares_the_size_at_every_address(server, folder, capsys):
    assert main(["data", "check"]) == 0
    assert capsys.readouterr().out.count("same size") == 3
    RECORDINGS["plain"] = replace(RECORDINGS["plain"], bytes=1)
    RECORDINGS["log"] = replace(RECORDINGS["log"], address="http://127.0.0.1:9/log")
    assert main(["data", "check"]) == 1
    plain, packed, log = capsys.readouterr().out.splitlines()
    assert str(len(PUBLISHED["plain"])) in plain and "same size" in packed
    assert "ConnectionError" in log


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ([], "give either"),
        (["plain", "--all"], "give either"),
        (["plian"], "Did you mean 'plain'?"),
    ],
)
def test_wrong_arguments_are_refused_in_one_line(words, expected, folder, capsys):
    assert main(["data", "get", *words]) == 2
    out, err = capsys.readouterr()
    assert expected in err and err.count("\n") == 1 and out == ""


def test_a_missing_recording_names_the_command_and_the_size(folder):
    with pytest.raises(sources.SourceError, match="slamlab data get packed") as caught:
        sources.open("packed")
    assert RECORDINGS["packed"].size in str(caught.value)
    with pytest.raises(sources.SourceError, match="available: plain"):
        sources.recording("atlantis")


def test_a_file_in_the_working_folder_comes_before_a_recording_of_its_name(
    folder, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    Path("plain").touch()
    assert resolve("plain") == "plain"


def test_every_recording_of_the_table_has_a_card():
    assert len({row.file for row in RECORDINGS.values()}) == len(RECORDINGS) > 10
    for row in RECORDINGS.values():
        assert row.bytes > 0 and row.about and row.cite and row.licence
        assert row.address.startswith("https://") and row.address.rpartition("/")[2]
        assert all(len(h) == 64 for h in (row.sha256, row.converted) if h) and row.sha256
        assert not os.path.isabs(row.file) and ".." not in row.file
