"""Commitment: what a contest draws its worlds from, told by its hash before, revealed after.

The hash of a file that holds 256 random bits tells nothing of them, and no other file has it: who
knows it before can tell, once the file is revealed, that no world was chosen afterwards.
"""

import hashlib
import json
import secrets
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import NamedTuple

from slamlab import __version__
from slamlab.grading.import_closure import closure
from slamlab.grading.judge import versions
from slamlab.grading.records import write_atomically
from slamlab.project.drawing import WORLDS_PER_FAMILY
from slamlab.project.driving import Budget
from slamlab.project.world_families import FAMILIES

SECRET, COMMITMENT, REVEALED = "secret.json", "commitment.txt", "revealed.json"
"""Files of a contest: of the judge's own; to be told before; to be told after."""
BITS = 256
DECIDES = ("slamlab.project.scores", "slamlab.project.streamed_drive")
"""Modules that, with all they import, decide what is drawn and what it is worth."""


class ContestError(Exception):
    """A contest cannot be held as asked; the text says why and what to do."""


class LogHashes(NamedTuple):
    """What is told of a recorded log: its name, and the SHA-256 of it and of its relations."""

    name: str
    log: str
    relations: str


@dataclass(frozen=True)
class Contest:
    """What a contest is drawn from.

    Parameters
    ----------
    seed : str, 256 bits in hexadecimal
    families : tuple of str
    worlds : int, of each family
    budget : dict, the limits of :class:`slamlab.project.driving.Budget` [s]
    code : str, SHA-256 of the modules that draw and score
    versions : dict, of the course and the libraries
    logs : tuple of LogHashes, recorded logs that are driven beside the worlds
    """

    seed: str
    families: tuple[str, ...]
    worlds: int
    budget: dict
    code: str
    versions: dict
    logs: tuple[LogHashes, ...] = ()

    @property
    def number(self):
        """The seed as a number."""
        return int(self.seed, 16)

    @property
    def places(self):
        """The worlds in order: tuple of (family's or log's name, number from 1)."""
        drawn = ((name, k + 1) for name in self.families for k in range(self.worlds))
        return (*drawn, *((log.name, 1) for log in self.logs))

    @property
    def text(self):
        """What is revealed, and whose hash is the commitment."""
        return json.dumps(asdict(self), indent=1, sort_keys=True) + "\n"

    @property
    def commitment(self):
        """SHA-256 of :attr:`text`, in hexadecimal."""
        return hashlib.sha256(self.text.encode()).hexdigest()


def draw_contest(families=tuple(FAMILIES), worlds=WORLDS_PER_FAMILY, logs=()):
    """Draw a contest from the system's randomness.

    Parameters
    ----------
    families : tuple of str
    worlds : int, of each family
    logs : tuple of LogHashes

    Returns
    -------
    Contest
    """
    limits = {name: getattr(Budget, name) for name in ("total", "reading", "ending", "patience")}
    seed = secrets.token_hex(BITS // 8)
    return Contest(seed, tuple(families), worlds, limits, code_digest(), versions(), tuple(logs))


def read_contest(file, told=None):
    """Read a contest, secret or revealed, and check that this course judges it alike.

    Parameters
    ----------
    file : Path
    told : Path or None, its commitment, which is to be its hash

    Returns
    -------
    Contest

    Raises
    ------
    ContestError
    """
    try:
        text = Path(file).read_text("utf-8")
        found = Contest(**json.loads(text))
        logs = tuple(LogHashes(*log) for log in found.logs)
        found = replace(found, families=tuple(found.families), logs=logs)
        unknown = set(found.families) - set(FAMILIES)
        int(found.seed, 16)
    except OSError as error:
        raise ContestError(f"{file} cannot be read: {error.strerror}") from None
    except (ValueError, TypeError) as error:
        raise ContestError(f"{file} is no contest: {error}") from None
    if told is not None and hashlib.sha256(text.encode()).hexdigest() != _committed(told):
        raise ContestError(f"{file} is not what {told} was the hash of")
    if unknown:
        raise ContestError(f"this course does not know the families {sorted(unknown)}")
    if found.code != code_digest():
        was = f"slamlab {found.versions.get('slamlab')}, code {found.code[:12]}"
        now = f"slamlab {__version__}, code {code_digest()[:12]}"
        raise ContestError(f"{file} is of {was}; this is {now}: judge with the same")
    return found


def commit(out, worlds=None, logs=()):
    """The contest of a folder; drawn, and its commitment written, where there is none.

    Parameters
    ----------
    out : Path
    worlds : int or None, of each family; None for the usual number, or what was drawn
    logs : tuple of LogHashes, of a contest that is drawn now

    Returns
    -------
    Contest

    Raises
    ------
    ContestError
    """
    if (out / SECRET).exists():
        contest = read_contest(out / SECRET, out / COMMITMENT)
        if worlds not in (None, contest.worlds):
            raise ContestError(
                f"this contest has {contest.worlds} worlds a family, and cannot be changed: make "
                "a new one, with another --out"
            )
        return contest
    contest = draw_contest(worlds=worlds or WORLDS_PER_FAMILY, logs=logs)
    write_atomically(out / SECRET, contest.text)
    write_atomically(out / COMMITMENT, commitment_text(contest))
    return contest


def commitment_text(contest):
    """What is told before: the hash, and all but the seed."""
    known = "\n".join(f"{name}: {value}" for name, value in asdict(contest).items()
                      if name != "seed")  # fmt: skip
    return (
        f"{contest.commitment}\n\nThis is the SHA-256 of {REVEALED}, which will be told when the "
        f"contest is over: compare with sha256sum {REVEALED}.\n\n{known}\n"
    )


def code_digest():
    """SHA-256 of the modules that decide what is drawn and what it is worth."""
    digest = hashlib.sha256()
    for name, file in sorted(closure(DECIDES).items()):
        digest.update(name.encode() + b"\0" + file.read_bytes().replace(b"\r\n", b"\n") + b"\0")
    return digest.hexdigest()


def _committed(file):
    try:
        return Path(file).read_text("utf-8").split()[0]
    except (OSError, IndexError):
        raise ContestError(f"{file} cannot be read: it held the hash told before") from None
