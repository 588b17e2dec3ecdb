"""Setting up: what is declared, what is locked, and the script that installs it."""

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
