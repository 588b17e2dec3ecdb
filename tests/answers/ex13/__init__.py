"""Independent answers to exercise 13: right ones, and students' mistakes."""
