"""Suspicious code: static analysis that lists constructs of a submission that no exercise needs. A
grader should look at these constructs; they are not a verdict. The judge ignores such constructs:
the sandbox limits what code can do, and laws decide the score.
"""

import ast
import functools
import math
import re

from classroom.grading import syntax

MAX_SIGNS = 20  # listed for one submission
MAX_CHARACTERS = 100_000  # nobody writes more by hand
CACHE_SIZE = 256  # cells whose signs are cached; most cells are the same in every submission
MAX_CACHED_CHARACTERS = 10_000  # of a cached cell
_MODULES = """
os subprocess socket ctypes signal gc inspect resource fcntl multiprocessing threading shutil glob
atexit faulthandler builtins importlib mmap pickle pty urllib requests http asyncio codecs copyreg
marshal posix runpy selectors tempfile tracemalloc types weakref _thread _posixsubprocess
"""
_CALLS = """
open eval exec compile __import__ breakpoint input exit quit SystemExit get_ipython BaseException
KeyboardInterrupt bytearray memoryview globals locals vars setattr delattr
"""
_INNER = """
_getframe settrace setprofile f_back f_locals f_globals ast_transformers __subclasses__ __globals__
__code__ __closure__ __bases__ __mro__ __builtins__ __reduce__ __reduce_ex__ __eq__ __array__
__array_ufunc__ __array_function__ __getattribute__ modules __new__ __del__ __dict__ __defaults__
__wrapped__ __array_interface__ __array_priority__ __float__ __index__ __setstate__ __loader__
tb_frame gi_frame cr_frame addaudithook monitoring setrecursionlimit setswitchinterval meta_path
memmap as_strided ctypeslib sleep __context__ __cause__ __traceback__
"""
COURSE = ("classroom.grading", "classroom.exercises")
MODULES, CALLS = frozenset(_MODULES.split()), frozenset(_CALLS.split())
INNER = frozenset(_INNER.split())
"""Attributes and methods that give access to the interpreter or can forge answers."""
BEYOND = "an extremely large number"
OWN_NAMES = frozenset(("check", "attempt", "hint"))
NUMBERS = frozenset(("ndarray", "float", "int", "complex"))  # what answers are made of
HUGE, POWER = 1e100, 100  # larger numbers and powers occur in no answer
LONG_TEXT = 100_000  # repetitions of a text
_SHELL = re.compile(r"^\s*(?:\w+ *= *)?(!|%%(?:bash|sh|script|javascript|html)\b)(?!pip )", re.M)


def signs(cells):
    """List suspicious constructs in cells (number, source), such as "cell 3: imports os"."""
    found, letters, own = {}, 0, frozenset()
    for number, source in cells:
        letters += len(source)
        if letters > MAX_CHARACTERS:
            found[f"cell {number}: too much code to be written by hand"] = None
            break
        look = _of_cell if len(source) <= MAX_CACHED_CHARACTERS else _of_cell.__wrapped__
        signs_of_cell, own = look(source, own)
        found |= dict.fromkeys(f"cell {number}: {sign}" for sign in signs_of_cell)
    return tuple(found)[:MAX_SIGNS]


def suspicious_behaviour(record):
    """List suspicious behaviour of a submission during grading."""
    found = [f"{v.task}: ended its process" for v in record.verdicts if v.kind == "died"]
    for number, problem in record.cells.items():
        if problem.startswith("ended the whole"):
            found.append(f"cell {number}: ended its process")
        elif re.match(r"PermissionError|BlockingIOError|OSError", problem):
            found.append(f"cell {number}: the system refused an action")
    return found


@functools.lru_cache(CACHE_SIZE)
def _of_cell(source, own):
    names = set(own)
    found = tuple(_signs_of(source, names))
    return found, own if own == names else frozenset(names)


def _signs_of(source, own):
    """Yield the suspicious constructs in a cell; add the names that the cell defines to ``own``."""
    if shell := _SHELL.search(source):
        yield f"a shell or web page command, {shell[1]}"
    try:
        by_kind = _by_kind(syntax.parse(source))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        for word in sorted(set(re.findall(r"\w+", source[:MAX_CHARACTERS])) & (MODULES | INNER)):
            yield f"names {word}"
        return
    own.update(node.name for node in by_kind.get(ast.FunctionDef, ()))
    yield from _assigned_checks(by_kind)
    for kind, look in _LOOKS.items():
        for node in by_kind.get(kind, ()):
            yield from look(node, own)


def _by_kind(tree):
    """Return the nodes of a tree by kind, twice as fast as with ``ast.walk``."""
    found, waiting = {}, [tree]
    for node in waiting:  # the list grows in the loop
        found.setdefault(type(node), []).append(node)
        for name in node._fields:
            value = getattr(node, name, None)
            if isinstance(value, ast.AST):
                waiting.append(value)
            elif type(value) is list:
                waiting += [item for item in value if isinstance(item, ast.AST)]
    return found


def _of_import(node, own):
    if isinstance(node, ast.Import):
        names = [alias.name for alias in node.names]
        own.update((alias.asname or alias.name).split(".")[0] for alias in node.names)
    else:
        names = [node.module or ""]
    for name in names:
        if name.split(".")[0] in MODULES or name.startswith(COURSE):
            yield f"imports {name}"


def _of_attribute(node, own):
    if node.attr in INNER:
        yield f"uses {node.attr}"
    root = node
    while isinstance(root, ast.Attribute):
        root = root.value
    if not isinstance(node.ctx, ast.Load) and isinstance(root, ast.Name) and root.id in own:
        yield f"changes {ast.unparse(node)}"


def _of_name(node, own):
    if node.id in INNER or (node.id in CALLS and isinstance(node.ctx, ast.Load)):
        yield f"uses {node.id}"


def _assigned_checks(by_kind):
    """Yield the checks that a cell assigns; a local variable ``check`` of a function is none."""
    names = [node for node in by_kind.get(ast.Name, ()) if node.id in OWN_NAMES]
    assigned = [node for node in names if isinstance(node.ctx, ast.Store)]
    if assigned and ast.Global not in by_kind:
        statements = [each for node in by_kind.get(ast.FunctionDef, ()) for each in node.body]
        local = {id(node) for statement in statements for node in ast.walk(statement)}
        assigned = [node for node in assigned if id(node) not in local]
    yield from (f"changes {node.id}" for node in assigned)


def _of_function(node, own):
    if node.name in INNER:
        yield f"defines {node.name}"


def _of_class(node, own):
    made_of = {ast.unparse(base).rpartition(".")[2] for base in node.bases} & NUMBERS
    yield from (f"defines {node.name}, a subclass of {base}" for base in sorted(made_of))


def _of_constant(node, own):
    value = node.value
    if isinstance(value, str):
        if value.startswith("__") and value in INNER:
            yield f"names {value}"
    elif isinstance(value, int | float) and HUGE < abs(value) < math.inf:
        yield BEYOND


def _of_sum(node, own):
    match node:
        case ast.BinOp(op=ast.Pow(), right=ast.Constant(int() as power)) if power > POWER:
            yield BEYOND
        case ast.BinOp(op=ast.Mult(), left=ast.Constant(str() | bytes()), right=times):
            if _whole(times) > LONG_TEXT:
                yield "an extremely long text"


def _whole(node):
    """Return the value of an integer, or of a power or shift of two integers; otherwise 0."""
    match node:
        case ast.Constant(int() as number):
            return number
        case ast.BinOp(ast.Constant(int() as base), op, ast.Constant(int() as by)) if 0 <= by < 64:
            raised = base**by if isinstance(op, ast.Pow) else 0
            return base << by if isinstance(op, ast.LShift) else raised
    return 0


_LOOKS = {
    ast.Import: _of_import,
    ast.ImportFrom: _of_import,
    ast.Attribute: _of_attribute,
    ast.Name: _of_name,
    ast.FunctionDef: _of_function,
    ast.ClassDef: _of_class,
    ast.Constant: _of_constant,
    ast.BinOp: _of_sum,
}
