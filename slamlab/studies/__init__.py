"""Tables that take many runs: each module is a command that writes one under slamlab/data."""
