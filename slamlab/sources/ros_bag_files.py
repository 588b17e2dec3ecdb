"""Files of ROS bags: formats by magic number, files in a folder, repair of truncated files."""

import os
import re
import shutil
import sqlite3
import struct
from contextlib import closing, suppress
from pathlib import Path
from urllib.parse import quote

from slamlab.files import SourceError, reason

ROS1, SQLITE, MCAP = b"#ROSBAG V", b"SQLite format 3\0", b"\x89MCAP0\r\n"  # magic numbers
SUFFIXES = {SQLITE: ".db3", MCAP: ".mcap", ROS1: ".bag"}
# what to do about a truncated file, for example after a power failure
REMEDIES = {
    ROS1: "'rosbag reindex' may restore it",
    SQLITE: "the command '.recover' of sqlite3 may restore it",
    MCAP: "'mcap recover' may restore it",
}
MCAP_FOOTER, MCAP_END_OF_DATA = 0x02, 0x0F  # types of records
METADATA = "metadata.yaml"
# file name at the end of a line of the metadata
NAMED_FILE = re.compile(r"([^/\\:\n'\"]+\.(?:db3|mcap)(?:\.zstd)?)['\"]?\s*$", re.MULTILINE)
ZSTD = b"\x28\xb5\x2f\xfd"  # magic number of Zstandard


def is_bag(path):
    """Return whether a path is a ROS bag: a file, a folder, or the metadata in the folder."""
    path = folder_of(Path(path))
    try:
        if path.is_dir():
            return (path / METADATA).is_file() or bool(_storage_files(path))
        magic = magic_number(path) if path.is_file() else None  # a pipe can be read only once
    except (OSError, ValueError):
        return False  # the reader of logs reports the error
    return magic in SUFFIXES or (magic == ZSTD and Path(path.stem).suffix in SUFFIXES.values())


def magic_number(path):
    """Return the magic number of a file, or None if it is unknown."""
    with path.open("rb") as file:
        head = file.read(16)
    return next((magic for magic in (*SUFFIXES, ZSTD) if head.startswith(magic)), None)


def folder_of(path):
    return path.parent if path.name == METADATA else path


def _storage_files(folder):
    """Return the message files in a folder; an uncompressed file replaces its compressed copy."""
    files = {}
    for path in sorted(folder.iterdir(), reverse=True):
        plain = path.stem if path.suffix in (".zstd", ".zst") else path.name
        if Path(plain).suffix in (".db3", ".mcap") and path.is_file():
            files[plain] = path
    return sorted(files.values())


def files_of(path):
    """Return the paths of the files of a bag, and the number of missing files."""
    if not path.is_dir():
        return [path], 0
    try:
        present = _storage_files(path)
        text = (path / METADATA).read_text("utf-8", errors="replace")
    except FileNotFoundError:  # the recorder was killed
        return present, 0
    except OSError as error:
        raise SourceError(f"{path} cannot be read: {reason(error)}") from None
    named = {name.strip(" -").removesuffix(".zstd") for name in NAMED_FILE.findall(text)}
    found = [each for each in present if each.name.removesuffix(".zstd") in named]
    # none of the files: they were renamed
    return (found, len(named) - len(found)) if found else (present, 0)


def part_of(file):
    """Return the name of the recording to which a file belongs: run for run_0.mcap, run_1.mcap …"""
    return re.sub(r"(_\d+)?(\.[a-z0-9]+)+$", "", file.name)


def quoted(path):
    """Quote a path for a URI of SQLite."""
    return quote(path.absolute().as_posix(), safe="/:")


def write_ahead_log(database):
    """Return the path of an SQLite database's write-ahead log, which remains after a crash."""
    return database.with_name(f"{database.name}-wal")


def with_write_ahead_log(database, folder):
    """Copy an SQLite database with the contents of its write-ahead log; return the path."""
    log = write_ahead_log(database)
    copy = Path(folder) / database.name
    shutil.copy(database, copy)
    shutil.copy(log, copy.with_name(log.name))
    with closing(sqlite3.connect(copy)) as connection:
        connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    return copy


def with_footer(mcap, folder):
    """Copy the whole records of a truncated MCAP file and add a footer; return the path."""
    copy = Path(folder) / mcap.name
    shutil.copyfile(mcap, copy)
    with copy.open("r+b") as file:
        size, at = file.seek(0, os.SEEK_END), len(MCAP)
        while at + 9 <= size:
            file.seek(at)
            kind, length = struct.unpack("<BQ", file.read(9))
            if at + 9 + length > size or kind in (MCAP_FOOTER, MCAP_END_OF_DATA):
                break
            at += 9 + length
        file.seek(at)
        file.truncate()
        file.write(struct.pack("<BQ", MCAP_FOOTER, 20) + bytes(20) + MCAP)
    return copy


def _is_other_database(file):
    """Return whether a file is an SQLite database without the tables of a bag."""
    try:
        uri = f"file:{quoted(file)}?immutable=1"
        with closing(sqlite3.connect(uri, uri=True)) as connection:
            tables = connection.execute("SELECT name FROM sqlite_master").fetchall()
    except (sqlite3.Error, UnicodeDecodeError):  # the latter in a damaged schema
        return False
    return not {("messages",), ("topics",)} <= set(tables)


def fault(file, magic):
    """Return why a file cannot be opened, and what the user can do."""
    with suppress(OSError), file.open("rb") as opened:
        head = opened.read(64)
        if magic == ROS1 and not head.startswith(ROS1 + b"2.0"):
            version = head.split(b"\n")[0].removeprefix(b"#ROSBAG ").decode("ascii", "replace")
            return f"its format {version} is older than 2010; 'rosbag fix' converts it to V2.0"
        # magic number, record type and length, length of the profile's name
        profile = head[21 : 21 + head[17]] if len(head) == 64 else b"ros2"
        if magic == MCAP and profile != b"ros2":
            profile = profile.decode("ascii", "replace")
            return f"its MCAP profile is {profile!r}; only 'ros2' is supported"
    if magic == SQLITE and _is_other_database(file):
        return "it is a database of another program"
    return f"it is truncated or damaged; {REMEDIES.get(magic, 'record it again')}"
