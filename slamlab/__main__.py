"""``python -m slamlab`` runs the command ``slamlab`` even if the command is not on the path."""

import sys

from slamlab.cli import main

if __name__ == "__main__":
    sys.exit(main())
