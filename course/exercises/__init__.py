"""The exercises: one folder each, with a folder for each task."""
