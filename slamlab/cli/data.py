"""``slamlab data``: list the public recordings; fetch, copy or check them by name."""

from pathlib import Path

from slamlab.cli.common import FAILED, refuse
from slamlab.cli.listings import check_name
from slamlab.cli.parsers import UsageError, add_command
from slamlab.cli.progress_line import progress_line
from slamlab.extras import needs
from slamlab.files import SourceError
from slamlab.sources.public_datasets import RECORDINGS, data_folder


def add_parser(subparsers):
    about = "List the public recordings with their size, licence and authors."
    add_command(subparsers, "data", about, "", "get intel").set_defaults(run=_list)
    about = "Fetch public recordings by name and check their hashes."
    examples = "intel intel-relations", "--all --from /media/stick"
    parser = add_command(subparsers, "data get", about, *examples)
    add = parser.add_argument
    add("names", metavar="NAME", nargs="*", help="Recording that slamlab data lists")
    add("--all", action="store_true", help="Fetch all recordings")
    origin = "Folder or address with the files (default: where they are published)"
    add("--from", metavar="FOLDER", dest="origin", default="", help=origin)
    parser.set_defaults(run=_get, also=[])  # named by an option that another package adds
    about = "Copy the recordings on this computer into a folder."
    parser = add_command(subparsers, "data mirror", about, "/media/stick", "/srv/www/recordings")
    parser.add_argument("folder", metavar="DIR", type=Path, help="Folder to write")
    parser.set_defaults(run=_mirror)
    about = "Ask each published address for the size of its file."
    add_command(subparsers, "data check", about, "", "> sizes.txt").set_defaults(run=_check)


def _list(arguments):
    print(f"Folder of the recordings (the variable SLAMLAB_DATA names another): {data_folder()}")
    for name, row in RECORDINGS.items():
        here = "here" if row.path.is_file() else "-"
        print(f"{name:15} {row.size:>6}  {here:4}  {row.about}")
        print(f"{'':16}licence: {row.licence}; cite: {row.cite}")
    return 0


def _get(arguments):
    names = arguments.names + arguments.also
    try:
        if bool(names) == arguments.all:
            raise UsageError("give either names of recordings or --all")
        for name in names:
            check_name("recording", name, RECORDINGS, "slamlab data")
    except UsageError as error:
        return refuse("data get", error)
    return _fetch_all("data get", names or RECORDINGS, arguments.origin)


def _mirror(arguments):
    here = [name for name, row in RECORDINGS.items() if row.path.is_file()]
    if missing := [name for name in RECORDINGS if name not in here]:
        print(f"not on this computer, so not copied: {', '.join(missing)}")
    return _fetch_all("data mirror", here, str(data_folder()), arguments.folder)


def _fetch_all(command, names, origin, folder=None):
    from slamlab.sources.downloading import Unavailable, fetch  # late: a help should come at once

    codes = []
    for name in names:
        try:
            with progress_line(100, name) as advance:
                path, new = fetch(name, origin, folder, advance)
            print(f"{name}: {'written to' if new else 'already at'} {path}")
            codes.append(0)
        except SourceError as error:
            codes.append(refuse(command, error))
            if isinstance(error, Unavailable):
                break
    return FAILED if len(set(codes)) > 1 else max(codes, default=0)


def _check(arguments):
    with needs("data"):
        import requests
    options = {"headers": {"Accept-Encoding": "identity"}, "timeout": 10, "allow_redirects": True}
    wrong = 0
    for name, row in RECORDINGS.items():
        try:
            answer = requests.head(row.address, **options)
            answer.raise_for_status()
            found = answer.headers.get("Content-Length", "no size")
        except requests.RequestException as error:
            found = type(error).__name__
        same = found == str(row.bytes)
        wrong += not same
        print(f"{name:15} {row.bytes:>8}  {'same size' if same else found}")
    return FAILED if wrong else 0
