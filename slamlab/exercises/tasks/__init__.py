"""The tasks of the exercises: inputs, laws, diagnoses. The judge's side; never in a worker."""
