"""Independent answers to exercise 10 (boxes): right ones and students' mistakes."""
