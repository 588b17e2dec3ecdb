"""Independent answers to exercise 11: right ones, and students' mistakes."""
