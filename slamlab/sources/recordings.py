"""Real recordings by name; they are other people's and are not part of the project."""

import os
from dataclasses import dataclass
from pathlib import Path

from slamlab.sources.base import SourceError

FREIBURG = "the SLAM benchmark of the University of Freiburg"


@dataclass(frozen=True)
class Published:
    """A recording: its file below the data folder, what it is, where such logs are published."""

    file: str
    about: str
    where: str


RECORDINGS = {
    "intel": Published(
        "intel/intel-raw-odometry.log.gz",
        "the Intel Research Lab log of Dirk Hähnel, raw odometry, as a CARMEN log",
        FREIBURG,
    ),
    "intel-relations": Published(
        "intel/intel.relations.gz",
        "the relations of Kümmerle et al. 2009 for the Intel Research Lab log",
        FREIBURG,
    ),
    **{
        f"rplidar-a2-{number}": Published(
            f"rplidar_a2/{file}",
            "an RPLIDAR A2 standing still in a room, as the SDK's grabber printed it",
            "the repository aKhalili147/RPLidar_A2_Testing",
        )
        for number, file in enumerate(("output_test.csv", "test12.csv", "test13.csv"), 1)
    },
    "exp1": Published(
        "breezyslam/exp1.dat",
        "a robot with a Hokuyo URG-04LX in a building, as a BreezySLAM log",
        "the repository simondlevy/BreezySLAM",
    ),
}
HERE = Path(__file__).resolve().parents[2] / "data"


def recording(name):
    """Where a recording lies: below the folder SLAMLAB_DATA names, else ``data/`` in the project.

    Parameters
    ----------
    name : str, one of RECORDINGS

    Returns
    -------
    Path

    Raises
    ------
    SourceError : no such recording is known, or it is not on this machine
    """
    if name not in RECORDINGS:
        raise SourceError(f"no recording is called {name!r}; there are: {', '.join(RECORDINGS)}")
    published = RECORDINGS[name]
    path = Path(os.environ.get("SLAMLAB_DATA") or HERE) / published.file
    if not path.is_file():
        raise SourceError(
            f"the recording {name!r} is not here ({path}): it is {published.about}; such logs are "
            f"published with {published.where}. Set SLAMLAB_DATA to the folder that holds it"
        )
    return path


def located(spec):
    """The file that a recording's name stands for; everything else stands for itself.

    Parameters
    ----------
    spec : str or Path

    Returns
    -------
    str

    Raises
    ------
    SourceError : the recording is not on this machine
    """
    return str(recording(spec) if spec in RECORDINGS else spec)
