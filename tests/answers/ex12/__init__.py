"""Independent answers to exercise 12: right ones, and students' mistakes."""
