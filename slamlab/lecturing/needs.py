"""Needs of a lesson's code besides itself, found in what its cells import and call.

An import alone needs nothing; a use does. Names are followed to the module they come from, in the
order of the cells, so ``from slamlab import sources`` makes ``sources.open("intel")`` a recording.
What a program puts together at run time (a name in a variable) is not seen.
"""

import ast

from slamlab.files.errors import SourceError
from slamlab.files.published_recordings import RECORDINGS, recording

DEVICES = (
    "serial",
    "slamlab.devices.RPLidar",
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


def needs(codes):
    """Find what cells need: a device, a network, a recording.

    Parameters
    ----------
    codes : list of str, the cells' code in their order; "" for what is no code

    Returns
    -------
    list of list of str, for each cell what it needs, such as "a device (slamlab.devices.RPLidar)"
    """
    names, found = {}, []
    for code in codes:
        try:
            tree = ast.parse(code)
        except SyntaxError:  # a magic, such as %matplotlib
            found.append([])
            continue
        names |= _imported(tree)
        found.append(list(dict.fromkeys(filter(None, (_need(n, names) for n in ast.walk(tree))))))
    return found


def _imported(tree):
    """Names that a cell imports, with where each comes from."""
    names = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                root = alias.name.split(".")[0]
                names[alias.asname or root] = alias.name if alias.asname else root
        elif isinstance(node, ast.ImportFrom) and node.module:
            names |= {a.asname or a.name: f"{node.module}.{a.name}" for a in node.names}
    return names


def _need(node, names):
    """What one node of a cell needs, or None."""
    if isinstance(node, ast.Constant) and node.value == ENVIRONMENT:
        return f"a recording ({ENVIRONMENT})"
    if isinstance(node, ast.Call) and _origin(node.func, names) in OPENERS:
        return _opened(node)
    if isinstance(node, ast.Name | ast.Attribute):
        origin = _origin(node, names)
        for kind, prefixes in (("a device", DEVICES), ("a network", NETWORK)):
            if any(origin == p or origin.startswith(p + ".") for p in prefixes):
                return f"{kind} ({origin})"
    return None


def _origin(node, names):
    """The dotted name that a node stands for, "" where it stands for none that was imported."""
    if isinstance(node, ast.Name):
        return names.get(node.id, "")
    if isinstance(node, ast.Attribute):
        base = _origin(node.value, names)
        return f"{base}.{node.attr}" if base else ""
    return ""


def _opened(call):
    """What it needs to open a source, if its name stands there."""
    spec = call.args[0].value if call.args and isinstance(call.args[0], ast.Constant) else None
    if isinstance(spec, str) and spec.startswith("devices:"):
        return f"a device ({spec})"
    if spec not in RECORDINGS:
        return None
    try:
        recording(spec)
    except SourceError:
        return f"the recording {spec!r}, which is not on this machine"
    return f"the recording {spec!r}, which is here"
