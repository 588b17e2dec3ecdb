"""Independent answers to exercise 08: right ones and students' mistakes."""
