"""Laws of checking and grading."""
