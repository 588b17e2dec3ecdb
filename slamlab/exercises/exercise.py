"""An exercise: the tasks of one notebook, in their order, and what its solutions may import."""

from collections.abc import Callable
from dataclasses import dataclass

from slamlab.exercises.task import Task
from slamlab.exercises.verdict import Verdict


@dataclass(frozen=True)
class Exercise:
    """The tasks of one notebook and what its solutions may import.

    Parameters
    ----------
    id : str, the lesson's number such as "04"
    notebook : str, its own name, and nbgrader's assignment, such as "04_models_and_jacobians"
    title : str
    tasks : in the notebook's order
    drives : str, the module of the drives, such as "slamlab.exercises.drives.ex04"
    allows : whitelist of slamlab modules that the worker holds, with their import closure
    answers : modules of slamlab that answer the exercise; never in the worker
    hides : other installed packages that answer it, by the names they are imported by; their files
        cannot be read in the worker either
    """

    id: str
    notebook: str
    title: str
    tasks: tuple[Task, ...]
    drives: str
    allows: tuple[str, ...] = ()
    answers: tuple[str, ...] = ()
    hides: tuple[str, ...] = ()

    def __post_init__(self):
        seen = set()
        for task in self.tasks:
            if not seen.issuperset(task.needs):
                raise ValueError(f"{task.id} needs a task that does not stand before it")
            seen.add(task.id)

    def task(self, id) -> Task:
        """Look up a task of this exercise by its id.

        Raises
        ------
        KeyError
        """
        for task in self.tasks:
            if task.id == id:
                return task
        raise KeyError(id)

    @property
    def file(self):
        """The name of the notebook's file, told from the lesson's by its first two letters."""
        return f"ex{self.notebook}.ipynb"

    @property
    def points(self):
        """The maximum score of the exercise."""
        return sum(task.points for task in self.tasks)

    def verdicts(self, judge_one: Callable[[Task], Verdict], only=None) -> dict[str, Verdict]:
        """Judge the tasks in order; one whose prerequisites are not solved fails without being run.

        Parameters
        ----------
        judge_one : task -> Verdict
        only : ids of tasks, to judge just these and what they need; None for all

        Returns
        -------
        task id to Verdict
        """
        ids = [task.id for task in self.tasks] if only is None else only
        wanted = set().union(*(self._required(id) for id in ids))
        found = {}
        for task in self.tasks:
            if task.id not in wanted:
                continue
            unsolved = [need for need in task.needs if not found[need].solved]
            if unsolved:
                names = " and ".join(unsolved)
                found[task.id] = task.failed("needs", f"needs {names}, solved and run first")
            else:
                found[task.id] = judge_one(task)
        return found

    def _required(self, id):
        return {id}.union(*(self._required(need) for need in self.task(id).needs))
