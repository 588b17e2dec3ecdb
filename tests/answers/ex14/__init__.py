"""Independent answers to exercise 14, written before any check was seen."""
