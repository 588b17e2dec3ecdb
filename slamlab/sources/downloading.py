"""Download of public recordings: checked by hash, converted, and written as a whole or not at all.

pooch downloads. A folder or a web server with the same files can replace the published addresses.
"""

import gzip
import hashlib
import json
import os
import threading
import time
from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory
from urllib.parse import urlsplit

from slamlab.extras import needs
from slamlab.files import SourceError, read_bytes, reason
from slamlab.sources.public_datasets import RECORDINGS, data_folder

FIRST_BYTE, SILENCE = 4.0, 20.0  # longest time until the first byte, and between two [s]
CHUNK = 1 << 14  # [bytes]
DIFFERS = "the file differs from the published one"
INTEL_HEAD = (
    "# Intel Research Lab, Seattle; recorded by Dirk Haehnel. CARMEN FLASER lines: pose fields "
    "and odometry fields both hold the RAW odometry."
)


class Unavailable(SourceError):
    """The network or the disk cannot be used, so no other recording can be fetched either."""


def fetch(name, origin="", folder=None, progress=lambda percent: None):
    """Fetch a public recording, unless it is there already. Returns (path, whether the file was
    fetched now).

    ``origin`` is a folder or address that has the files, by default their published addresses;
    ``folder`` is by default the data folder; ``progress`` is called with the arrived part [%].
    Raises SourceError, and leaves a file that was there unchanged; ExtraMissing without pooch.
    """
    published = RECORDINGS[name]
    path = (folder or data_folder()) / published.file
    there, wanted = path.is_file(), published.converted or published.sha256
    try:
        if there and hashlib.sha256(read_bytes(path)[0]).hexdigest() == wanted:
            return path, False
        with TemporaryDirectory(ignore_cleanup_errors=True) as temporary:
            if origin and "://" not in origin:
                file = _in_folder(published, Path(origin))
            else:
                file = _download(published, origin, temporary, progress)
            content = read_bytes(file)[0]
        if published.converted and content.startswith(b"{"):
            content = carmen_log(content)
        if hashlib.sha256(content).hexdigest() != wanted:
            raise SourceError(DIFFERS)
        _write(path, content)
    except (OSError, ValueError) as error:
        kind = Unavailable if isinstance(error, OSError | Unavailable) else SourceError
        why = reason(error) if isinstance(error, OSError) else error
        why = f"{error.filename}: {why}" if getattr(error, "filename", None) else why
        kept = f"{path} is unchanged" if there else "Nothing was written"
        by_hand = f"To fetch it by hand, save {published.address} in a folder FOLDER and run"
        command = f"'slamlab data get {name} --from FOLDER'"
        raise kind(f"{name}: {why}. {kept}. {by_hand} {command}") from None
    return path, True


def carmen_log(content):
    """Convert JSON ``{"map": {stamp: {"range", "x", "y", "theta"}}}`` to a CARMEN log (bytes).

    Raises SourceError for any other content."""
    lines = [INTEL_HEAD]
    try:
        scans = {float(stamp): scan for stamp, scan in json.loads(content)["map"].items()}
        for stamp, scan in sorted(scans.items()):
            ranges = [f"{r:.2f}" for r in scan["range"]]
            pose = [f"{scan[name]:.6f}" for name in ("x", "y", "theta")]
            times = [f"{stamp:.6f}", "intel", f"{stamp - min(scans):.6f}"]
            lines.append(" ".join(["FLASER", str(len(ranges)), *ranges, *pose, *pose, *times]))
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        raise SourceError(DIFFERS) from None
    return "\n".join([*lines, ""]).encode()


def _in_folder(published, folder):
    """Return the path of a recording in a copy of the data folder, or as its publisher names it."""
    names = published.file, Path(published.address).name
    for path in (folder / name for name in names):
        if path.is_file():
            return path
    raise SourceError(f"{folder} contains neither {names[0]} nor {names[1]}")


def _download(published, origin, folder, progress):
    """Download a file into an empty folder and return its path."""
    with needs("data"):
        import pooch
        from requests import exceptions
    address = f"{origin.rstrip('/')}/{published.file}" if origin else published.address
    known = None if origin else f"sha256:{published.sha256}"  # a mirror compresses some files
    host, outcome, size, due = urlsplit(address).netloc, [], 0, time.monotonic() + FIRST_BYTE
    loader = pooch.HTTPDownloader(chunk_size=CHUNK, timeout=2 * SILENCE)

    def retrieve():
        try:
            outcome.append(pooch.retrieve(address, known, "file", folder, downloader=loader))
        except Exception as error:
            outcome.append(error)

    pooch.get_logger().setLevel("ERROR")
    # a thread, because no timeout of requests limits the search for the host's address
    thread = threading.Thread(target=retrieve, daemon=True)
    thread.start()
    while not outcome:
        thread.join(0.05)
        with suppress(FileNotFoundError):  # pooch renames the file
            arrived = sum(entry.stat().st_size for entry in os.scandir(folder))
            if arrived > size:
                size, due = arrived, time.monotonic() + SILENCE
                progress(min(100, 100 * size // published.bytes))
        if size > 2 * published.bytes:
            raise Unavailable(f"{host} sends more than the published file")
        if time.monotonic() > due:
            outcome.append(exceptions.Timeout())
    if isinstance(outcome[0], Exception):
        raise _explained(outcome[0], host, exceptions)
    return Path(outcome[0])


def _explained(error, host, exceptions):
    """Return the error of a download as one that states what to do; ``exceptions`` of requests."""
    trust = "If your network inspects traffic, set REQUESTS_CA_BUNDLE to its certificates"
    answer = getattr(error, "response", None)
    status = f"{answer.status_code} {answer.reason}" if answer is not None else ""
    for kind, raised, why in (
        (exceptions.SSLError, Unavailable, f"the certificate of {host} is not trusted. {trust}"),
        (exceptions.ProxyError, Unavailable, "the proxy does not connect. Check HTTPS_PROXY"),
        (exceptions.Timeout, Unavailable, f"{host} does not answer. Check the network"),
        (exceptions.ConnectionError, Unavailable, f"{host} cannot be reached. Check the network"),
        (exceptions.HTTPError, SourceError, f"{host} answers {status}"),
        (exceptions.RequestException, SourceError, f"the transfer from {host} failed"),
        (ValueError, SourceError, DIFFERS),
    ):
        if isinstance(error, kind):
            return raised(why)
    return error


def _write(path, content):
    path.parent.mkdir(parents=True, exist_ok=True)
    with TemporaryDirectory(dir=path.parent, prefix=".") as beside:
        part = Path(beside, path.name)
        part.write_bytes(gzip.compress(content, mtime=0) if path.suffix == ".gz" else content)
        os.replace(part, path)
