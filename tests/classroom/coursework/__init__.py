"""A student's folder: progress, reset, update."""
