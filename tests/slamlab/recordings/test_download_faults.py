"""Recordings that cannot be fetched: refused in one line, and nothing that was there is lost."""

import contextlib
import gzip
import shutil
import socket
import ssl
import subprocess
import threading
from dataclasses import replace

import pooch  # noqa: F401 - the extra, without which this file is skipped
import pytest

from slamlab.cli import main
from slamlab.sources import downloading
from slamlab.sources.public_datasets import RECORDINGS
from tests.slamlab.recordings.web_server import FILES, PUBLISHED, content, files, redirect, send
from tests.timeouts import PATIENCE

OLD = b"what was there before"


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
