"""Published recordings (data sets) by name; they are other people's, not part of the project."""

import os
from dataclasses import dataclass
from pathlib import Path

from slamlab.files.errors import SourceError

FREIBURG = "the SLAM benchmark of the University of Freiburg"


@dataclass(frozen=True)
class PublishedRecording:
    """A published recording (data set): its file in the data folder, what it is, its source."""

    file: str
    about: str
    where: str


RECORDINGS = {
    "intel": PublishedRecording(
        "intel/intel-raw-odometry.log.gz",
        "the Intel Research Lab log of Dirk Hähnel, raw odometry, as a CARMEN log",
        FREIBURG,
    ),
    "intel-relations": PublishedRecording(
        "intel/intel.relations.gz",
        "the relations of Kümmerle et al. 2009 for the Intel Research Lab log",
        FREIBURG,
    ),
    **{
        f"rplidar-a2-{number}": PublishedRecording(
            f"rplidar_a2/{file}",
            "an RPLIDAR A2 standing still in a room, as the SDK's grabber printed it",
            "the repository aKhalili147/RPLidar_A2_Testing",
        )
        for number, file in enumerate(("output_test.csv", "test12.csv", "test13.csv"), 1)
    },
    "exp1": PublishedRecording(
        "breezyslam/exp1.dat",
        "a robot with a Hokuyo URG-04LX in a building, as a BreezySLAM log",
        "the repository simondlevy/BreezySLAM",
    ),
}
DATA_FOLDER = Path(__file__).resolve().parents[2] / "data"  # where SLAMLAB_DATA is not set


def recording(name):
    """Path of a recording: below the folder SLAMLAB_DATA names, else ``data/`` in the project.

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
    path = Path(os.environ.get("SLAMLAB_DATA") or DATA_FOLDER) / published.file
    if not path.is_file():
        raise SourceError(
            f"the recording {name!r} is not here ({path}): it is {published.about}; such logs are "
            f"published with {published.where}. Set SLAMLAB_DATA to the folder that holds it"
        )
    return path


def resolve(spec):
    """Resolve a recording's name to its file; everything else stands for itself.

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
