"""``python -m classroom.audience``: run the audience server for the students' phones. The lecture
mode starts this command."""

import argparse

from classroom.audience import server, server_start


def main():
    parser = argparse.ArgumentParser(prog="python -m classroom.audience", description=__doc__)
    parser.add_argument(
        "origin",
        type=server_start.origin,
        help="origin of JupyterLab, such as http://localhost:8888",
    )
    parser.add_argument("--host", default="127.0.0.1", help="0.0.0.0 for phones (127.0.0.1)")
    parser.add_argument("--port", type=int, default=server_start.PORT, help="(%(default)s)")
    parser.add_argument("--state", help="file that contains the addresses while the server runs")
    parser.add_argument(
        "--patience",
        type=float,
        default=600.0,
        help="timeout [s] without a request from the lecturer's page (600)",
    )
    server.run(parser.parse_args())


if __name__ == "__main__":
    main()
