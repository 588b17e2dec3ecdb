"""Independent answers to exercise 03: right ones, and students' mistakes."""
