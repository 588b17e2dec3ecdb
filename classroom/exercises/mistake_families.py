"""Families of small mistakes without a specific name (mutation operators), and their hints."""

FAMILY_HINT = (
    "Your numbers are exactly those of a correct solution with {}. Your code may get these numbers "
    "in another way."
)
MISTAKE_FAMILIES = {
    "sign": "one + in place of a −, or one − in place of a +",
    "factor": "one constant too large or too small, or a sum in place of a mean",
    "square": "one square or square root too many, or without one (variances are σ²; C, R and P "
    "contain variances)",
    "transpose": "one matrix transposed, or without a transpose (the shape of a square matrix does "
    "not reveal this)",
    "order": "two factors, two arguments or the sides of a difference exchanged",
    "trigonometry": "a sine in place of a cosine or vice versa, or a function in place of its "
    "inverse",
    "degrees": "degrees in place of radians or vice versa (NumPy's functions take and return "
    "radians)",
    "wrap": "one angle that is not wrapped where it should be (179° and −179° differ by 2°)",
    "axis": "a sum, mean or stack along another axis, or along all axes",
    "stale": "a value from before a change in place of the value after it, or vice versa",
    "missing": "one term, factor or line missing",
    "guard": "another condition (<, ≤, and, or, not, or both sides equal)",
    "index": "an integer off by one",
    "inverse": "a matrix in place of its inverse, or a fraction upside down",
    "name": "one variable in place of another",
    "twice": "one line or one factor too many",
}
"""What is wrong, by the name of the family; ``course.mutation_operators`` makes the changes."""

FAMILY_QUESTIONS = {
    "sign": "Which of its terms must be added, and which must be subtracted?",
    "factor": "How often does each of its terms count?",
    "square": "Which unit does each of its terms have, and which unit should the result have?",
    "transpose": "Which index of each matrix is the row? Test the shapes on a non-square example.",
    "order": "Which operand comes first, and would it matter if you exchanged the two?",
    "trigonometry": "Draw the angle and the triangle: which side does each function give?",
    "degrees": "In which unit is each angle here?",
    "wrap": "Which values can this angle have, and which values should it have?",
    "axis": "Which axis of the array counts what, and over which one do you compute?",
    "stale": "Which version of each variable does this line use, the old or the new one?",
    "missing": "Which terms and factors does the equation have, and does your code have them all?",
    "guard": "For which inputs should it hold, and what happens where both sides are equal?",
    "index": "Which is the first index, which is the last, and where does counting begin?",
    "inverse": "If one of its terms grows, does the result grow or shrink? Should it?",
    "name": "Which variable does each symbol of the equation stand for?",
    "twice": "How often does each step have to be done?",
    "": "What should it give, by hand, for the case that check shows? Where does your code differ?",
}
"""First questions by family, about the quantity that the mistake hits; "" for no family."""
