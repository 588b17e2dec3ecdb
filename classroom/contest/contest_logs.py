"""Recorded logs of a contest, identified by their hashes; the contest stores no copies."""

import hashlib
from dataclasses import dataclass
from pathlib import Path

from classroom.contest.seed_commitment import ContestError, LogHashes
from classroom.project.recorded_logs import recorded_log
from classroom.project.world_parameters import WORLD_FAMILIES
from slamlab import sources
from slamlab.evaluation.relations import load_relations
from slamlab.sources.public_datasets import RECORDINGS, resolve

RELATIONS = "-relations"  # suffix of the name of a published recording's relations
HOW = "the name of a recording with relations, such as intel, or two files: LOG,RELATIONS"


@dataclass(frozen=True)
class LogFiles:
    """The paths of a log's file and of the file with its relations."""

    name: str
    log: str
    relations: str

    @property
    def hashes(self):
        digests = (hashlib.sha256(Path(f).read_bytes()).hexdigest()
                   for f in (self.log, self.relations))  # fmt: skip
        return LogHashes(self.name, *digests)


def log_files(spec):
    """Return the LogFiles for a value of ``--log``: a recording's name, or ``LOG,RELATIONS``.

    Raises ContestError for an invalid ``spec``, SourceError if a recording is not available."""
    log, comma, relations = spec.rpartition(",")
    if not comma:
        if spec + RELATIONS not in RECORDINGS:
            raise ContestError(f"--log {spec}: give {HOW}")
        return LogFiles(spec, resolve(spec), resolve(spec + RELATIONS))
    name = Path(log).name.split(".")[0]
    if not name or name in WORLD_FAMILIES:
        raise ContestError(f"--log {spec}: a log cannot have the name {name!r}; rename the file")
    for file in (log, relations):
        if not Path(file).is_file():
            raise ContestError(f"--log {spec}: the file {file} does not exist; give {HOW}")
    return LogFiles(name, log, relations)


def hash_logs(specs):
    """Check that logs can be used and return their LogHashes. Raises ContestError, SourceError."""
    found = [log_files(spec) for spec in specs]
    for files in found:
        _opened(files)
    hashes = tuple(files.hashes for files in found)
    if len({one.name for one in hashes}) < len(hashes):
        raise ContestError("two logs have the same name: rename a file")
    return hashes


def open_logs(contest, specs):
    """Open the logs of a contest and check their hashes. Raises ContestError, SourceError.

    specs : files of the logs that are not published recordings."""
    given = {files.hashes: files for files in map(log_files, specs)}
    foreign = [files.name for hashes, files in given.items() if hashes not in contest.logs]
    if foreign:
        raise ContestError(
            f"the contest was made without the log {foreign[0]}, or with another file of that "
            "name, and cannot be changed: make a new contest with another --out"
        )
    return [_opened(given.get(wanted) or _published(wanted)) for wanted in contest.logs]


def _published(wanted):
    """Return the files of a contest's log, which must be a published recording."""
    if wanted.name + RELATIONS not in RECORDINGS:
        raise ContestError(
            f"this contest includes the log {wanted.name}: give its files with --log LOG,RELATIONS"
        )
    files = log_files(wanted.name)
    if files.hashes != wanted:
        raise ContestError(
            f"the recording {wanted.name} on this machine differs from the one in this contest"
        )
    return files


def _opened(files):
    try:
        with sources.open(files.log) as source:
            return recorded_log(files.name, source, load_relations(files.relations))
    except sources.SourceError:
        raise
    except ValueError as error:
        raise ContestError(str(error)) from None
