"""Write files atomically: killing the process at any moment loses no data."""

import json
import os
import tempfile
from datetime import datetime
from pathlib import Path


def write(path: Path, data: bytes):
    """Write a file atomically: a reader sees either the old or the new bytes."""
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
    """Encode JSON in the format of Jupyter's notebooks: one line per entry, sorted keys."""
    text = json.dumps(value, indent=1, sort_keys=True, ensure_ascii=False)
    return text.encode() + b"\n"


def back_up_beside(path: Path, now: datetime) -> Path:
    """Save a copy of a file in its folder, with the date in its name."""
    data = path.read_bytes()
    for count in range(1000):
        more = f"-{count}" if count else ""
        copy = path.with_name(f"{path.stem} {now:%Y-%m-%d %H-%M-%S}{more}{path.suffix}")
        if not copy.exists():
            write(copy, data)
            return copy
    raise OSError(f"{path.name} already has 1000 copies from this second")
