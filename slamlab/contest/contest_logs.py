"""Recorded logs of a contest: fixed by their hashes, found again by them, never kept.

Recordings are other people's. A contest tells the name and the SHA-256 of each log and of its
relations, so whoever has the same files can judge again.
"""

import hashlib
from dataclasses import dataclass
from pathlib import Path

from slamlab import sources
from slamlab.contest.commitment import ContestError, LogHashes
from slamlab.evaluation.relations import load_relations
from slamlab.files.published_recordings import RECORDINGS, resolve
from slamlab.project.recorded_logs import recorded_log
from slamlab.project.world_families import FAMILIES

RELATIONS = "-relations"  # a published recording's relations are called so, after its name
HOW = "a recording's name that has relations, such as intel, or LOG,RELATIONS: two files"


@dataclass(frozen=True)
class LogFiles:
    """A log and its relations.

    Parameters
    ----------
    name : str
    log, relations : str, paths
    """

    name: str
    log: str
    relations: str

    @property
    def hashes(self):
        """What is told of them."""
        digests = (hashlib.sha256(Path(f).read_bytes()).hexdigest()
                   for f in (self.log, self.relations))  # fmt: skip
        return LogHashes(self.name, *digests)


def log_files(spec):
    """The files that ``--log`` names.

    Parameters
    ----------
    spec : str, a recording's name, or ``LOG,RELATIONS``

    Returns
    -------
    LogFiles

    Raises
    ------
    ContestError : it names no log with relations
    SourceError : a recording is not on this machine
    """
    log, comma, relations = spec.rpartition(",")
    if not comma:
        if spec + RELATIONS not in RECORDINGS:
            raise ContestError(f"--log {spec}: it takes {HOW}")
        return LogFiles(spec, resolve(spec), resolve(spec + RELATIONS))
    name = Path(log).name.split(".")[0]
    if not name or name in FAMILIES:
        raise ContestError(f"--log {spec}: a log cannot be called {name!r}, rename the file")
    for file in (log, relations):
        if not Path(file).is_file():
            raise ContestError(f"--log {spec}: there is no file {file}; --log takes {HOW}")
    return LogFiles(name, log, relations)


def hashes_of(specs):
    """What is told of some logs, each of which can be driven.

    Parameters
    ----------
    specs : list of str

    Returns
    -------
    tuple of LogHashes

    Raises
    ------
    ContestError, SourceError
    """
    found = [log_files(spec) for spec in specs]
    for files in found:
        _opened(files)
    hashes = tuple(files.hashes for files in found)
    if len({one.name for one in hashes}) < len(hashes):
        raise ContestError("two logs have one name: rename a file")
    return hashes


def open_logs(contest, specs):
    """Open the logs of a contest, found by their hashes.

    Parameters
    ----------
    contest : Contest
    specs : list of str, where logs are that are no published recordings

    Returns
    -------
    list of RecordedLog

    Raises
    ------
    ContestError, SourceError : a log is not here, or another one
    """
    given = {files.hashes: files for files in map(log_files, specs)}
    foreign = [files.name for hashes, files in given.items() if hashes not in contest.logs]
    if foreign:
        raise ContestError(
            f"the contest was made without the log {foreign[0]}, or with another file of that "
            "name, and cannot be changed: make a new one, with another --out"
        )
    return [_opened(given.get(wanted) or _published(wanted)) for wanted in contest.logs]


def _published(wanted):
    """A contest's log that was not named, which may be a published recording."""
    if wanted.name + RELATIONS not in RECORDINGS:
        raise ContestError(
            f"this contest drives a log, too, {wanted.name}: say where it is with "
            "--log LOG,RELATIONS"
        )
    files = log_files(wanted.name)
    if files.hashes != wanted:
        raise ContestError(f"the recording {wanted.name} here is not the one of this contest")
    return files


def _opened(files):
    try:
        with sources.open(files.log) as source:
            return recorded_log(files.name, source, load_relations(files.relations))
    except sources.SourceError:
        raise
    except ValueError as error:
        raise ContestError(str(error)) from None
