"""Independent answers to exercise 09: right ones, and students' mistakes."""
