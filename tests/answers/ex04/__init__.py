"""Independent answers to exercise 04: RIGHT ones and students' mistakes (WRONG)."""
