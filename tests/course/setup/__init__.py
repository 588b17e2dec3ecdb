"""Set-up: declared packages, locked packages, and the script that installs them."""

from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
