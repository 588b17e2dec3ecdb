"""Independent answers to exercise 15: right ones and wrong ones, as students would type them."""
