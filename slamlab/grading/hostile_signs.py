"""Hostile signs: what a submission's code has that no exercise asks for; a hint, not a verdict.

The judge needs none of this: what code may do is bounded by the sandbox, and what it earns by laws.
A person who looks wants to know where to look.
"""

import ast
import functools
import math
import re

from slamlab.grading import syntax

MOST = 20  # signs told of one submission
MAX_CHARACTERS = 100_000  # letters; nobody writes more by hand
KEPT = 256  # cells whose signs are kept: most are as they were handed out, in every submission
KEPT_CHARACTERS = 10_000  # of a cell that is kept
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
COURSE = ("slamlab.grading", "slamlab.exercises")
MODULES, CALLS = frozenset(_MODULES.split()), frozenset(_CALLS.split())
INNER = frozenset(_INNER.split())
"""Attributes and methods by which code reaches into its interpreter, or lies about its answers."""
BEYOND = "a number beyond all measure"
OWN_NAMES = frozenset(("check", "attempt", "hint"))
NUMBERS = frozenset(("ndarray", "float", "int", "complex"))  # what answers are made of
HUGE, POWER = 1e100, 100  # numbers and powers of which no answer is made
LONG_TEXT = 100_000  # letters of a text that is repeated
_SHELL = re.compile(r"^\s*(?:\w+ *= *)?(!|%%(?:bash|sh|script|javascript|html)\b)(?!pip )", re.M)


def signs(cells):
    """The signs in a notebook's cells.

    Parameters
    ----------
    cells : list of (number, source)

    Returns
    -------
    tuple of str, such as "cell 3: imports os"
    """
    found, letters, own = {}, 0, frozenset()
    for number, source in cells:
        letters += len(source)
        if letters > MAX_CHARACTERS:
            found[f"cell {number}: more than anybody writes by hand"] = None
            break
        look = _of_cell if len(source) <= KEPT_CHARACTERS else _of_cell.__wrapped__
        told, own = look(source, own)
        found |= dict.fromkeys(f"cell {number}: {said}" for said in told)
    return tuple(found)[:MOST]


def behaviour(record):
    """What a submission did while it was judged that an honest one seldom does.

    Parameters
    ----------
    record : Record

    Returns
    -------
    list of str
    """
    said = [f"{v.task}: ended its process" for v in record.verdicts if v.kind == "died"]
    for number, problem in record.cells.items():
        if problem.startswith("ended the whole"):
            said.append(f"cell {number}: ended its process")
        elif re.match(r"PermissionError|BlockingIOError|OSError", problem):
            said.append(f"cell {number}: was refused by the system")
    return said


@functools.lru_cache(KEPT)
def _of_cell(source, own):
    """The signs in one cell, and the names of modules and functions up to it."""
    names = set(own)
    told = tuple(_told(source, names))
    return told, own if own == names else frozenset(names)


def _told(source, own):
    """The signs in one cell; own are the names of modules and functions so far, added to."""
    if shell := _SHELL.search(source):
        yield f"a line for a shell or a page, {shell[1]}"
    try:
        by_kind = _by_kind(syntax.parse(source))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        for word in sorted(set(re.findall(r"\w+", source[:MAX_CHARACTERS])) & (MODULES | INNER)):
            yield f"names {word}"
        return
    own.update(node.name for node in by_kind.get(ast.FunctionDef, ()))
    for kind, look in _LOOKS.items():
        for node in by_kind.get(kind, ()):
            yield from look(node, own)


def _by_kind(tree):
    """The nodes of a tree by their kind; as ``ast.walk`` finds them, in half the time."""
    found, waiting = {}, [tree]
    for node in waiting:  # it grows meanwhile
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
    elif node.id in OWN_NAMES and isinstance(node.ctx, ast.Store):
        yield f"changes {node.id}"


def _of_function(node, own):
    if node.name in INNER:
        yield f"defines {node.name}"


def _of_class(node, own):
    made_of = {ast.unparse(base).rpartition(".")[2] for base in node.bases} & NUMBERS
    yield from (f"makes {node.name}, a kind of {base}" for base in sorted(made_of))


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
                yield "a text longer than anybody reads"


def _whole(node):
    """The size of a whole number, or of two by which one is raised or shifted; 0 for others."""
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
