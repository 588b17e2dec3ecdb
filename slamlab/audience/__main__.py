"""``python -m slamlab.audience``: listen for a class's phones; a lecture's deck starts it."""

import argparse

from slamlab.audience import process, starting


def main():
    """Parse the command line and listen until the lecture is over."""
    parser = argparse.ArgumentParser(prog="python -m slamlab.audience", description=__doc__)
    parser.add_argument("origin", type=starting.origin, help="of JupyterLab: http://localhost:8888")
    parser.add_argument("--host", default="127.0.0.1", help="0.0.0.0 for phones (127.0.0.1)")
    parser.add_argument("--port", type=int, default=starting.PORT, help="(%(default)s)")
    parser.add_argument("--state", help="the file to keep the addresses in while it runs")
    parser.add_argument(
        "--patience", type=float, default=600.0, help="[s] without the lecturer's page (600)"
    )
    process.run(parser.parse_args())


if __name__ == "__main__":
    main()
