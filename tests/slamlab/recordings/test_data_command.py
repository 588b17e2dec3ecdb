"""Recordings by name: fetched whole and as published, listed, copied and checked."""

import gzip
import http.server
import os
import shutil
import socket
import threading
from dataclasses import replace
from pathlib import Path

import pooch  # noqa: F401 - the extra, without which this file is skipped
import pytest

from slamlab import sources
from slamlab.cli import main
from slamlab.sources.public_datasets import RECORDINGS, resolve
from tests.slamlab.recordings.web_server import FILES, LOG, PUBLISHED, content, files, send
from tests.timeouts import PATIENCE

CONTENTS = PUBLISHED | {"log": LOG}


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


def test_a_published_file_in_place_of_its_log_is_replaced(folder):
    path = folder / FILES["log"]
    path.parent.mkdir(parents=True)
    path.write_bytes(PUBLISHED["log"])
    assert main(["data", "get", "log"]) == 0 and content(path) == LOG


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
