"""Similarity report (plagiarism): solutions alike but for names and layout; a hint, not a verdict.

Short tasks have few right answers, so that likeness says something of long ones only.
"""

import ast
import hashlib

MIN_NODES = 40  # of the syntax tree; what is shorter is alike by chance
MAX_CHARACTERS = 100_000  # letters; nobody writes more by hand
NAME_FIELDS = {ast.Name: "id", ast.arg: "arg", ast.keyword: "arg"}


def fingerprints(cells, exercise):
    """Fingerprints of a submission: a hash of the normalised functions of each task.

    Parameters
    ----------
    cells : list of (number, source)
    exercise : Exercise

    Returns
    -------
    dict, task to a hash; tasks whose functions are missing or short are left out
    """
    functions, letters = {}, 0
    for _, source in cells:
        letters += len(source)
        if letters > MAX_CHARACTERS:
            return {}
        functions |= _functions(source)
    found = {}
    for task in exercise.tasks:
        mine = [functions[name] for name in task.drive.functions if name in functions]
        if len(mine) == len(task.drive.functions) and sum(size for size, _ in mine) >= MIN_NODES:
            text = "\n".join(text for _, text in mine)
            found[task.id] = hashlib.sha256(text.encode()).hexdigest()
    return found


def clusters(records):
    """Clusters of similar submissions: equal fingerprints of different students.

    Parameters
    ----------
    records : list of Record

    Returns
    -------
    list of (task, list of Record), the largest first
    """
    alike = {}
    for record in records:
        for task, print in record.fingerprints.items():
            alike.setdefault((task, print), []).append(record)
    several = [(task, who) for (task, _), who in alike.items() if len({r.student for r in who}) > 1]
    return sorted(several, key=lambda pair: (-len(pair[1]), pair[0]))


def _functions(source):
    """Name to (size, normal form) of the functions a cell defines at its top."""
    try:
        tree = ast.parse(source)
        return {
            node.name: _normal_form(node) for node in tree.body if isinstance(node, ast.FunctionDef)
        }
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return {}


def _normal_form(function):
    """A function without docstring, its own names numbered in the order they come."""
    first = function.body[0]
    if isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant):
        function.body = function.body[1:] or [ast.Pass()]
    nodes = list(ast.walk(function))
    own = {node.arg for node in nodes if isinstance(node, ast.arg)}
    own |= {n.id for n in nodes if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)}
    numbers = {}
    for node in nodes:
        field = NAME_FIELDS.get(type(node))
        name = getattr(node, field) if field else None
        if name in own:
            setattr(node, field, f"_{numbers.setdefault(name, len(numbers))}")
    return len(nodes), ast.dump(function, annotate_fields=False)
