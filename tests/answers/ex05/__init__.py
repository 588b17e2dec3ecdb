"""Independent answers to exercise 05: right ones, and students' mistakes."""
