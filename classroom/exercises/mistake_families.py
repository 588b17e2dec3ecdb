"""Families of small mistakes without a specific name (mutation operators), and their hints."""

MISTAKE_FAMILIES = {
    "sign": "A sign is wrong: with one + in place of a −, or one − in place of a +, a correct "
    "solution gives exactly your numbers.",
    "factor": "A factor is wrong: with one constant larger or smaller, or with a sum in place of "
    "a mean, a correct solution gives exactly your numbers.",
    "square": "A square or a square root is missing, or there is one too many. Variances are σ², "
    "and C, R and P contain variances.",
    "transpose": "One matrix is transposed, or a transpose is missing. The shape of a square "
    "matrix does not reveal this.",
    "order": "Two things are in the wrong order: two factors of a product, the two sides of a "
    "difference, or the arguments of a function.",
    "trigonometry": "A sine is used in place of a cosine or vice versa, or a function is used in "
    "place of its inverse.",
    "degrees": "Degrees and radians are mixed: NumPy's functions take and return radians.",
    "wrap": "An angle is not wrapped where it should be: 179° and −179° differ by 2°.",
    "axis": "A sum, mean or stack is taken along the wrong axis, or along all axes.",
    "stale": "A line uses a value from before a change, or from after it: two lines are in the "
    "wrong order, or one has no effect.",
    "missing": "Something is missing: one term of a sum, one factor of a product, or one line.",
    "guard": "A condition is wrong for some inputs: check <, ≤, and, or, not, and the case in "
    "which both sides are equal.",
    "index": "An integer is off by one: an index, a bound, or an entry of a matrix.",
    "inverse": "Something is inverted: a matrix is used in place of its inverse, or a fraction is "
    "upside down.",
    "name": "One variable is used in place of another: check what each line reads and assigns.",
    "twice": "Something is done twice: there is one line or one factor too many.",
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
