"""Independent answers to exercise 01: right ones, and students' mistakes."""
