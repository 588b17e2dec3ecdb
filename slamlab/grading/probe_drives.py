"""Empty drives: for the worker of the sandbox self-test, which has no tasks."""

DRIVES = {}
