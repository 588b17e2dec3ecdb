"""Commitment to the seed of the worlds (hash commitment).

The hash of the seed is published before the contest, and the seed after it. The hash reveals
nothing about the 256 random bits, and no other bits have the same hash. Therefore the worlds cannot
be chosen afterwards."""

import hashlib
import json
import secrets
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import NamedTuple

from classroom.grading.import_closure import closure
from classroom.grading.judge import versions
from classroom.grading.records import write_atomically
from classroom.project.estimator_runs import Budget
from classroom.project.world_generation import WORLDS_PER_FAMILY
from classroom.project.world_parameters import WORLD_FAMILIES
from slamlab import __version__

SECRET, COMMITMENT, REVEALED = "secret.json", "commitment.txt", "revealed.json"
"""Files of a contest: one is private, one is published before and one after the contest."""
BITS = 256
DECIDES = ("classroom.project.scores", "classroom.project.estimator_worker")
"""Modules that draw the worlds and compute the scores; their imports are hashed, too."""


class ContestError(Exception):
    """A contest cannot be run as requested; the message states the reason."""


class LogHashes(NamedTuple):
    """The name of a recorded log, the SHA-256 of its file, and the SHA-256 of its relations."""

    name: str
    log: str
    relations: str


@dataclass(frozen=True)
class Contest:
    """The seed and all settings of a contest."""

    seed: str  # 256 bits in hexadecimal
    families: tuple[str, ...]
    worlds: int  # of each family
    budget: dict  # the limits of Budget [s]
    code: str  # SHA-256 of the modules that draw and score
    versions: dict  # of the course and the libraries
    logs: tuple[LogHashes, ...] = ()  # scored in addition to the worlds

    @property
    def number(self):
        return int(self.seed, 16)

    @property
    def worlds_in_order(self):
        """The worlds in order, as (name of the family or log, number from 1)."""
        drawn = ((name, k + 1) for name in self.families for k in range(self.worlds))
        return (*drawn, *((log.name, 1) for log in self.logs))

    @property
    def text(self):
        """The text that is revealed after the contest; its hash is the commitment."""
        return json.dumps(asdict(self), indent=1, sort_keys=True) + "\n"

    @property
    def commitment(self):
        """SHA-256 of :attr:`text`, in hexadecimal."""
        return hashlib.sha256(self.text.encode()).hexdigest()


def draw_contest(families=tuple(WORLD_FAMILIES), worlds=WORLDS_PER_FAMILY, logs=()):
    """Draw a contest with the random generator of the system; worlds : their number per family."""
    limits = {name: getattr(Budget, name) for name in ("total", "reading", "ending", "patience")}
    seed = secrets.token_hex(BITS // 8)
    return Contest(seed, tuple(families), worlds, limits, code_digest(), versions(), tuple(logs))


def read_contest(file, committed=None):
    """Read a contest and check that this version of the course can judge it. Raises ContestError.

    committed : file with the commitment, which must equal the contest's hash, or None."""
    try:
        text = Path(file).read_text("utf-8")
        found = Contest(**json.loads(text))
        logs = tuple(LogHashes(*log) for log in found.logs)
        found = replace(found, families=tuple(found.families), logs=logs)
        unknown = set(found.families) - set(WORLD_FAMILIES)
        int(found.seed, 16)
    except OSError as error:
        raise ContestError(f"{file} cannot be read: {error.strerror}") from None
    except (ValueError, TypeError) as error:
        raise ContestError(f"{file} is not a contest file: {error}") from None
    digest = hashlib.sha256(text.encode()).hexdigest()
    if committed is not None and digest != _read_commitment(committed):
        raise ContestError(f"the hash of {file} differs from that in {committed}")
    if unknown:
        raise ContestError(f"this course does not contain the families {sorted(unknown)}")
    if found.code != code_digest():
        was = f"slamlab {found.versions.get('slamlab')}, code {found.code[:12]}"
        now = f"slamlab {__version__}, code {code_digest()[:12]}"
        raise ContestError(f"{file} was made by {was}, but this is {now}: use the same version")
    return found


def commit(out, worlds=None, logs=()):
    """Return the contest of a folder, or draw one and write the commitment.

    worlds : their number per family; None for the default number. Raises ContestError."""
    if (out / SECRET).exists():
        contest = read_contest(out / SECRET, out / COMMITMENT)
        if worlds not in (None, contest.worlds):
            raise ContestError(
                f"this contest has {contest.worlds} worlds of each family, and cannot be changed: "
                "make a new contest with another --out"
            )
        return contest
    contest = draw_contest(worlds=worlds or WORLDS_PER_FAMILY, logs=logs)
    write_atomically(out / SECRET, contest.text)
    write_atomically(out / COMMITMENT, commitment_text(contest))
    return contest


def commitment_text(contest):
    """Return the text to publish before the contest: the hash, and all settings except the seed."""
    known = "\n".join(f"{name}: {value}" for name, value in asdict(contest).items()
                      if name != "seed")  # fmt: skip
    return (
        f"{contest.commitment}\n\nThis is the SHA-256 of {REVEALED}, which will be published when "
        f"the contest is over: compare it with `sha256sum {REVEALED}`.\n\n{known}\n"
    )


def code_digest():
    """Return the SHA-256 of the modules that draw the worlds and compute the scores."""
    digest = hashlib.sha256()
    for name, file in sorted(closure(DECIDES).items()):
        digest.update(name.encode() + b"\0" + file.read_bytes().replace(b"\r\n", b"\n") + b"\0")
    return digest.hexdigest()


def _read_commitment(file):
    try:
        return Path(file).read_text("utf-8").split()[0]
    except (OSError, IndexError):
        raise ContestError(f"{file}, which contains the commitment, cannot be read") from None
