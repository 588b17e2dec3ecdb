"""Families of small mistakes that need no name of their own, with what is said of each."""

FAMILIES = {
    "sign": "A sign is turned: with one + for a −, or one − for a +, a right solution gives "
    "exactly "
    "your numbers.",
    "factor": "A factor is off: with one constant larger or smaller, or with a sum for a mean, a "
    "right solution gives exactly your numbers.",
    "square": "A square or a root is missing or too many: variances are σ², and C, R and P hold "
    "variances.",
    "transpose": "One matrix is transposed, or lacks its transpose. Where it is square no shape "
    "tells.",
    "order": "Two things stand in the wrong order: two factors of a product, the two sides of a "
    "difference, or the arguments of a function.",
    "trigonometry": "A sine stands for a cosine, or a function for its inverse.",
    "degrees": "Degrees and radians are mixed: NumPy's functions take and return radians.",
    "wrap": "An angle is not wrapped where it should be: 179° and −179° are 2° apart.",
    "axis": "A sum, mean or stack runs along another axis than it should, or along all of them.",
    "stale": "A line uses a value from before a change, or after it: two lines are in the wrong "
    "order, or one has no effect.",
    "missing": "Something is left out: one term of a sum, one factor of a product, or one line.",
    "guard": "A condition decides the other way at some inputs: look at <, ≤, and, or, not, and at "
    "what happens when both sides are equal.",
    "index": "A whole number is off by one: an index, a bound, or an entry of a matrix.",
    "inverse": "Something is upside down: a matrix stands where its inverse should, or a fraction "
    "is turned over.",
    "name": "One name stands where another should: look at what each line reads and what it keeps.",
    "twice": "Something is done twice: one line, or one factor, too many.",
}
"""Family's name to its hint; ``course.mutation`` makes the changes."""
