"""Drives of no exercise: for a worker that only tries its own walls."""

DRIVES = {}
