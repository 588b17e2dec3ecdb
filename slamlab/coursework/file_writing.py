"""Writing files so that being killed at any moment loses nothing."""

import json
import os
import tempfile
from datetime import datetime
from pathlib import Path


def write(path: Path, data: bytes):
    """Write a file whole or not at all (atomically): a reader sees the old bytes or the new ones.

    Parameters
    ----------
    path : Path
    data : bytes

    Raises
    ------
    OSError
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        os.chmod(name, 0o644)
        os.replace(name, path)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise


def json_bytes(value) -> bytes:
    """JSON as Jupyter writes a notebook: a line an entry, keys in order.

    Parameters
    ----------
    value : what JSON can hold

    Returns
    -------
    bytes
    """
    text = json.dumps(value, indent=1, sort_keys=True, ensure_ascii=False)
    return text.encode() + b"\n"


def keep_beside(path: Path, now: datetime) -> Path:
    """Keep a copy of a file beside it, its name with the date; nothing is overwritten.

    Parameters
    ----------
    path : Path
    now : datetime

    Returns
    -------
    Path, of the copy

    Raises
    ------
    OSError
    """
    data = path.read_bytes()
    for count in range(1000):
        more = f"-{count}" if count else ""
        copy = path.with_name(f"{path.stem} {now:%Y-%m-%d %H-%M-%S}{more}{path.suffix}")
        if not copy.exists():
            write(copy, data)
            return copy
    raise OSError(f"there are a thousand copies of {path.name} from this second")
