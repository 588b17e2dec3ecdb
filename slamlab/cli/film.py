"""``slamlab film FILE``: write a film as a self-contained web page, and open the page."""

from pathlib import Path

from slamlab.cli.common import refuse
from slamlab.cli.parsers import add_command


def add_parser(subparsers):
    parser = add_command(
        subparsers,
        "film",
        "Write a recorded film as one web page and open the page.",
        "two.film",
        "two.film --out two.html --no-open",
    )
    add = parser.add_argument
    add("file", metavar="FILE", type=Path, help="Film that slamlab run --film recorded")
    add("--out", metavar="PAGE", type=Path, help="Page to write (default: FILE.html)")
    add("--no-open", action="store_true", help="Only write the page")
    parser.set_defaults(run=run)


def run(arguments) -> int:
    # imported late: a help text should come at once
    import webbrowser

    from slamlab.files import SourceError
    from slamlab.live.films import load, page
    from slamlab.live.films.film_page import MARK

    # beside the film, not in a folder for temporary files: packed browsers may not look into that
    out = arguments.out or arguments.file.with_name(f"{arguments.file.name}.html")
    try:
        film = load(arguments.file)
        if out.exists():
            with out.open("rb") as there:
                if MARK.encode() not in there.read(500):
                    what = "exists and is not a film page. Name a new page with --out"
                    raise SourceError(f"{out} {what}")
        out.write_text(page(arguments.file), encoding="utf-8")
    except SourceError as error:
        return refuse("film", error)
    except OSError as error:
        why = f"{error.strerror}. Name another page with --out"
        return refuse("film", f"{out} cannot be written: {why}")
    print(f"written to {out}: {len(film)} frames, a page that plays them")
    if not arguments.no_open and not webbrowser.open(out.resolve().as_uri()):
        print("No browser was found. Open the page in a browser.")
    return 0
