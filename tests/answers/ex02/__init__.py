"""Independent answers to exercise 02: right ones, and students' mistakes."""
