"""Bubblewrap (bwrap): a sandbox of Linux namespaces without network, other processes or files."""

import os
import shutil
from pathlib import Path

from classroom.grading import hidden_packages, quotas, staging

# folders of the system at the root, bound read-only
SYSTEM_FOLDERS = {Path(p) for p in ("/bin", "/sbin", "/lib", "/lib64", "/lib32")}


def executable():
    return shutil.which("bwrap")


def drops_privileges():
    """Return whether the judge runs as root, so that workers must drop its privileges."""
    return hasattr(os, "geteuid") and os.geteuid() == 0


def command(folder, home, python, hidden=()):
    """Return the command line to put before the worker's command line. The writable ``home`` exists
    only in memory inside the sandbox; ``hidden`` paths are covered.
    """
    words = [executable(), "--die-with-parent", "--new-session", "--cap-drop", "ALL"]
    if drops_privileges():
        words += ["--unshare-ipc", "--unshare-pid", "--unshare-net", "--unshare-uts"]
        words += ["--unshare-cgroup-try", "--cap-add", "CAP_SETUID", "--cap-add", "CAP_SETGID"]
    else:
        words += ["--unshare-all", "--uid", "65534", "--gid", "65534"]
    for path in sorted(SYSTEM_FOLDERS):
        if path.is_symlink():
            words += ["--symlink", os.readlink(path), str(path)]
        elif path.is_dir():
            words += ["--ro-bind", str(path), str(path)]
    words += ["--ro-bind", "/usr", "/usr", "--proc", "/proc", "--dev", "/dev"]
    words += ["--perms", "0755", "--dir", "/etc"]
    for path in ("/etc/ld.so.cache", "/etc/alternatives"):
        words += ["--ro-bind-try", path, path]
    shown = [
        p
        for p in staging.python_folders()
        if p not in SYSTEM_FOLDERS and not _below(p, ["/usr", "/etc"])
    ]
    shown += [
        p for p in (*hidden_packages.library_folders(), folder) if not _below(p, ["/usr", *shown])
    ]
    if not _below(python, ["/usr", *shown]):
        shown.append(python)
    for path in shown:
        words += [*_parent_directories(path), "--ro-bind", str(path), str(path)]
    for path in (Path("/usr"), *(p for p in SYSTEM_FOLDERS if not p.is_symlink()), *shown):
        for entry in (entry for entry in hidden if entry.is_relative_to(path.resolve())):
            hide = ["--tmpfs"] if entry.is_dir() else ["--ro-bind", "/dev/null"]
            words += [*hide, str(path / entry.relative_to(path.resolve()))]
    words += ["--perms", "0777", "--size", str(quotas.MAX_BYTES), "--tmpfs", str(home)]
    return [*words, "--chdir", str(home), "--"]


def _below(path, folders):
    return any(Path(path).is_relative_to(folder) for folder in folders)


def _parent_directories(path):
    """Return options that create a path's parent folders, readable by all users."""
    above = [p for p in reversed(path.parents) if p != Path("/") and not _below(p, ["/usr"])]
    return [word for p in above for word in ("--perms", "0755", "--dir", str(p))]
