"""Real recordings by name; they are other people's and are not part of the project."""

import os
from pathlib import Path

from slamlab.sources.base import SourceError

FILES = {"intel": "intel/intel-raw-odometry.log.gz", "intel-relations": "intel/intel.relations.gz"}
ABOUT = {
    "intel": "the Intel Research Lab log of Dirk Hähnel, raw odometry, as a CARMEN log",
    "intel-relations": "the relations of Kümmerle et al. 2009 for the Intel Research Lab log",
}
HERE = Path(__file__).resolve().parents[2] / "data"


def recording(name):
    """Where a recording lies: below the folder SLAMLAB_DATA names, else ``data/`` in the project.

    Parameters
    ----------
    name : str, one of FILES

    Returns
    -------
    Path

    Raises
    ------
    SourceError : no such recording is known, or it is not on this machine
    """
    if name not in FILES:
        raise SourceError(f"no recording is called {name!r}; there are: {', '.join(FILES)}")
    path = Path(os.environ.get("SLAMLAB_DATA") or HERE) / FILES[name]
    if not path.is_file():
        raise SourceError(
            f"the recording {name!r} is not here ({path}): it is {ABOUT[name]}; such logs are "
            "published with the SLAM benchmark of the University of Freiburg. Set SLAMLAB_DATA to "
            "the folder that holds it"
        )
    return path
