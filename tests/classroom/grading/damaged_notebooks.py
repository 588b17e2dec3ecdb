"""Damaged notebooks, handed in by accident or on purpose, as functions of a text."""

import json


def _changed(text, **changes):
    return json.dumps({k: v for k, v in (json.loads(text) | changes).items() if v}).encode()


def _ordinary(text, **changes):
    return json.dumps(json.loads(text) | changes).encode()


def _cells(text, **changes):
    cells = json.loads(text)["cells"]
    return _ordinary(text, cells=[cell | changes for cell in cells])


def _named(text, exercise):
    return _ordinary(text, metadata={"slamlab": {"exercise": exercise}})


def _with(text, value):
    """The notebook with a value in its metadata, as it is written."""
    return text.replace('"metadata": {"slamlab"', f'"metadata": {{"x": {value}, "slamlab"').encode()


DAMAGED = {
    "truncated": lambda text: text[: len(text) // 2].encode(),
    "empty": lambda text: b"",
    "bytes of zero": lambda text: bytes(1000),
    "latin-1": lambda text: text.replace("import", "# é\\nimport", 1).encode("latin-1"),
    "nested": lambda text: b'{"cells": ' + b"[" * 100_000 + b"]" * 100_000 + b"}",
    "no cells": lambda text: b'{"cells": [], "metadata": {}, "nbformat": 4, "nbformat_minor": 5}',
    "a list": lambda text: b"[1, 2, 3]",
    "version 3": lambda text: b'{"worksheets": [{"cells": []}], "metadata": {}, "nbformat": 3}',
    "not JSON": lambda text: b"PK\x03\x04 a zip",
    "a wrong kernel": lambda text: text.replace(
        '"metadata": {"slamlab"', '"metadata": {"kernelspec": {"name": "nowhere"}, "slamlab"'
    ).encode(),
    "a hundred megabytes": lambda text: text.encode() + b" " * (100 << 20),
    "no metadata": lambda text: _changed(text, metadata=None),
    "deleted cells": lambda text: _changed(text, cells=json.loads(text)["cells"][:1]),
    "duplicated cells": lambda text: _changed(text, cells=json.loads(text)["cells"] * 3),
    "a folder": lambda text: None,
    "an integer of 5000 digits": lambda text: _with(text, "9" * 5000),
    "a number that is none": lambda text: _with(text, "[NaN, -Infinity, 1e999]"),
    "folders of lists": lambda text: _with(text, "[" * 900 + "]" * 900),
    "half a letter": lambda text: _with(text, '"\\ud800\\udfff"'),
    "a key twice": lambda text: text.replace('{"cells"', '{"cells": [], "cells"', 1).encode(),
    "ids that are none": lambda text: _cells(text, id=["x" * 10**5, {"a": None}]),
    "attachments": lambda text: _cells(text, attachments={"../x.png": {"image/png": "A" * 10**6}}),
    "metadata of another type": lambda text: _ordinary(text, metadata=[1, "x"]),
    "cells of other types": lambda text: _cells(text, metadata=None, outputs=5, execution_count=""),
    "words behind its end": lambda text: text.encode() + b" {}",
    "32 bits a letter": lambda text: text.encode("utf-32"),
    "an exercise of another alphabet": lambda text: _named(text, "\uff19\uff19"),
    "an exercise that is a path": lambda text: _named(text, "../../99"),
    "an exercise that is a list": lambda text: _named(text, ["99"]),
    "cells without end": lambda text: _ordinary(text, cells=json.loads(text)["cells"] * 600),
}
"""Name to a function that damages an ordinary notebook's text; None for a folder."""

GRADED = {
    "latin-1", "a wrong kernel", "no metadata", "duplicated cells",
    "a number that is none", "folders of lists", "half a letter", "a key twice",
    "ids that are none", "attachments", "metadata of another type", "cells of other types",
    "an exercise that is a list",
}  # fmt: skip
"""Damaged notebooks that still contain all code of the ordinary one."""
