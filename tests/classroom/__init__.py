"""Laws of the classroom."""
