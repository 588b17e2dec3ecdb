"""Families of small mistakes without a specific name (mutation operators), and their hints."""

MISTAKE_FAMILIES = {
    "sign": "With one + in place of a −, or one − in place of a +, a correct solution gives "
    "exactly your numbers.",
    "factor": "With one constant larger or smaller, or with a sum in place of a mean, a correct "
    "solution gives exactly your numbers.",
    "square": "Without a square or a square root, or with one too many, a correct solution gives "
    "exactly your numbers. Variances are σ², and C, R and P contain variances.",
    "transpose": "With one matrix transposed, or without a transpose, a correct solution gives "
    "exactly your numbers. The shape of a square matrix does not reveal this.",
    "order": "With two factors, the sides of a difference or two arguments exchanged, a correct "
    "solution gives exactly your numbers.",
    "trigonometry": "With a sine in place of a cosine or vice versa, or a function in place of "
    "its inverse, a correct solution gives exactly your numbers.",
    "degrees": "Degrees and radians are mixed: NumPy's functions take and return radians.",
    "wrap": "An angle is not wrapped where it should be: 179° and −179° differ by 2°.",
    "axis": "A sum, mean or stack is taken along the wrong axis, or along all axes.",
    "stale": "If one line uses a value from before a change, or from after it, a correct solution "
    "gives exactly your numbers.",
    "missing": "Without one term, factor or line, a correct solution gives exactly your numbers.",
    "guard": "With a wrong condition (<, ≤, and, or, not, both sides equal), a correct solution "
    "gives exactly your numbers.",
    "index": "With an integer off by one, a correct solution gives exactly your numbers.",
    "inverse": "With a matrix in place of its inverse, or a fraction upside down, a correct "
    "solution gives exactly your numbers.",
    "name": "With one variable in place of another, a correct solution gives exactly your numbers.",
    "twice": "With one line or one factor too many, a correct solution gives exactly your numbers.",
}
"""Hints by the name of their family; ``course.mutation_operators`` makes the changes."""

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
