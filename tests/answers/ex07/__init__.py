"""Independent answers to exercise 07 (stand-in for a class): right ones and wrong ones."""
