"""``slamlab film FILE``: play a recorded film in the browser, in a page that can be sent around."""

import sys
from pathlib import Path


def add_parser(subparsers):
    """Add the command to the command line."""
    parser = subparsers.add_parser(
        "film",
        help="play a film that slamlab run --film recorded",
        description=(
            "Make a page of a film and open it in the browser. The page is one file, holds the "
            "film and asks no other host for anything: it can be sent and put on a site."
        ),
    )
    parser.add_argument("file", metavar="FILE", type=Path, help="a film")
    parser.add_argument(
        "--out", metavar="PAGE", type=Path, help="where to write the page (FILE.html)"
    )
    parser.add_argument("--no-open", action="store_true", help="only write the page")
    parser.set_defaults(run=run)


def run(arguments) -> int:
    """Play; 0 when the page is written, 2 when the film or the page cannot be used."""
    from slamlab.files.errors import SourceError
    from slamlab.films import load, page  # late: a help text should come at once

    # beside the film, not in a folder for temporary files: packed browsers may not look into that
    out = arguments.out or arguments.file.with_name(f"{arguments.file.name}.html")
    try:
        film = load(arguments.file)
        _require_page(out)
        out.write_text(page(arguments.file), encoding="utf-8")
    except SourceError as error:
        print(f"slamlab film: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        told = f"{out} cannot be written: {error.strerror}; name another page by --out"
        print(f"slamlab film: {told}", file=sys.stderr)
        return 2
    print(f"written to {out}: {len(film)} frames, a page that plays them")
    if not arguments.no_open and not _opened(out):
        print("no browser was found: open the page in one")
    return 0


def _require_page(path):
    """Refuse to write over what is no page of a film."""
    from slamlab.files.errors import SourceError
    from slamlab.films.film_page import MARK

    if not path.exists():
        return
    with open(path, "rb") as file:
        if MARK.encode() not in file.read(500):
            raise SourceError(f"{path} is there and is no film's page: name a new one by --out")


def _opened(page):
    import webbrowser

    return webbrowser.open(page.resolve().as_uri())
