"""Requirements of a lesson's code (devices, network, recordings), by static analysis.

A requirement is a use of an imported name. Names that are computed at run time are not found."""

import ast

from slamlab.devices import LIDARS
from slamlab.files import SourceError
from slamlab.sources.public_datasets import RECORDINGS, recording

DEVICES = (
    "serial",
    *(f"slamlab.devices.{driver}" for driver in LIDARS.values()),
    "slamlab.devices.Emir",
    "slamlab.devices.rplidar.RPLidar",
    "slamlab.devices.rplidar.driver",
    "slamlab.devices.emir.Emir",
    "slamlab.devices.emir.driver",
    "slamlab.sources.live_devices",
)
NETWORK = ("socket", "urllib.request", "http.client", "ftplib", "requests", "httpx", "aiohttp")
OPENERS = ("slamlab.sources.open", "slamlab.sources.recording")
ENVIRONMENT = "SLAMLAB_DATA"


def requirements(codes):
    """Return the requirements of each cell, such as "a device (…)": list of lists of str."""
    names, found = {}, []
    for code in codes:
        try:
            tree = ast.parse(code)
        except SyntaxError:  # a magic command, such as %matplotlib
            found.append([])
            continue
        names |= _imported(tree)
        found.append(
            list(dict.fromkeys(filter(None, (_requirement(n, names) for n in ast.walk(tree)))))
        )
    return found


def _imported(tree):
    names = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                root = alias.name.split(".")[0]
                names[alias.asname or root] = alias.name if alias.asname else root
        elif isinstance(node, ast.ImportFrom) and node.module:
            names |= {a.asname or a.name: f"{node.module}.{a.name}" for a in node.names}
    return names


def _requirement(node, names):
    if isinstance(node, ast.Constant) and node.value == ENVIRONMENT:
        return f"a recording ({ENVIRONMENT})"
    if isinstance(node, ast.Call) and _origin(node.func, names) in OPENERS:
        return _source_requirement(node)
    if isinstance(node, ast.Name | ast.Attribute):
        origin = _origin(node, names)
        for kind, prefixes in (("a device", DEVICES), ("a network", NETWORK)):
            if any(origin == p or origin.startswith(p + ".") for p in prefixes):
                return f"{kind} ({origin})"
    return None


def _origin(node, names):
    """Return the dotted name of a node, or "" if it was not imported."""
    if isinstance(node, ast.Name):
        return names.get(node.id, "")
    if isinstance(node, ast.Attribute):
        base = _origin(node.value, names)
        return f"{base}.{node.attr}" if base else ""
    return ""


def _source_requirement(call):
    """Return the requirement for opening a source, if its name is a constant."""
    spec = call.args[0].value if call.args and isinstance(call.args[0], ast.Constant) else None
    if isinstance(spec, str) and spec.startswith(tuple(LIDARS)):
        return f"a device ({spec})"
    if spec not in RECORDINGS:
        return None
    try:
        recording(spec)
    except SourceError:
        return f"the recording {spec!r}, which is not on this machine"
    return f"the recording {spec!r}, which is on this machine"
