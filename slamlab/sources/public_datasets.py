"""Public recordings by name; ``recordings.tsv`` lists them, and the files are not distributed."""

import csv
import os
from dataclasses import dataclass
from pathlib import Path

from slamlab.files import SourceError

TABLE = Path(__file__).with_name("recordings.tsv")
REPOSITORY = Path(__file__).resolve().parents[2]  # if the library is not installed elsewhere


@dataclass(frozen=True)
class PublicDataset:
    """A row of the table; ``file`` is the path in the data folder, ``address`` the published file.

    ``bytes`` and ``sha256`` belong to the published file. ``converted`` is the SHA-256 of the log
    that is made from it, or "". ``cite`` names the authors.
    """

    name: str
    file: str
    bytes: int
    sha256: str
    converted: str
    licence: str
    cite: str
    about: str
    address: str

    @property
    def path(self):
        """Path of the recording in :func:`data_folder`."""
        return data_folder() / self.file

    @property
    def size(self):
        return f"{max(self.bytes / 1e6, 0.1):.1f} MB"


def _table():
    with TABLE.open(encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file, delimiter="\t", quoting=csv.QUOTE_NONE):
            yield PublicDataset(bytes=int(row.pop("bytes")), **row)


RECORDINGS = {row.name: row for row in _table()}


def data_folder():
    """Return the folder of the recordings: SLAMLAB_DATA, ``data/`` of a clone, or a cache."""
    if named := os.environ.get("SLAMLAB_DATA"):
        return Path(named)
    cloned = (REPOSITORY / "pyproject.toml").is_file()
    return REPOSITORY / "data" if cloned else Path.home() / ".cache" / "slamlab"


def recording(name):
    """Return the path of a recording in the folder that SLAMLAB_DATA names (default: ``data/``).

    name : str, one of RECORDINGS. Raises SourceError if the name is unknown or the file is not on
    this machine.
    """
    if name not in RECORDINGS:
        raise SourceError(f"there is no recording {name!r}; available: {', '.join(RECORDINGS)}")
    path = RECORDINGS[name].path
    if not path.is_file():
        fetch = f"the command 'slamlab data get {name}' fetches it ({RECORDINGS[name].size})"
        raise SourceError(f"the recording {name!r} is not on this computer; {fetch}")
    return path


def resolve(spec):
    """Return the path of a recording by its name; return any other string or file unchanged."""
    return str(recording(spec) if spec in RECORDINGS and not os.path.isfile(spec) else spec)
