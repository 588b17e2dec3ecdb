"""Independent answers to exercise 06, right and wrong ones, as students would type them."""
