"""An exercise: the tasks of one notebook, and the modules that its solutions may import."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from classroom.exercises.references import Reference
from classroom.exercises.task import Task
from classroom.exercises.verdict import Verdict


@dataclass(frozen=True)
class Exercise:
    """The tasks of one notebook and the modules that its solutions may import."""

    id: str  # the lesson's number, such as "04"
    notebook: str  # name, also of nbgrader's assignment: "04_models_and_jacobians"
    title: str
    tasks: tuple[Task, ...]  # in the notebook's order
    calls: str  # module of the function calls: "course.exercises.ex06_ekf_slam.calls"
    allows: tuple[str, ...] = ()  # modules in the worker, with their import closure
    answers: tuple[str, ...] = ()  # modules of slamlab that solve it; never in the worker
    hides: tuple[str, ...] = ()  # other packages that solve it: not readable in the worker

    def __post_init__(self):
        seen = set()
        for task in self.tasks:
            if not seen.issuperset(task.needs):
                raise ValueError(f"{task.id} needs a task that does not precede it")
            if any(not self.task(need).references for need in task.needs):
                raise ValueError(f"{task.id} needs a task without references")
            seen.add(task.id)

    def task(self, id) -> Task:
        for task in self.tasks:
            if task.id == id:
                return task
        raise KeyError(id)

    @property
    def file(self):
        """The name of the notebook's file, which begins with "ex"."""
        return f"ex{self.notebook}.ipynb"

    @property
    def points(self):
        return sum(task.points for task in self.tasks)

    def verdicts(
        self, judge_one: Callable[[Task, tuple[Reference, ...]], Verdict], only=None
    ) -> dict[str, Verdict]:
        """Judge the tasks in order, and return the verdicts by id. A task that needs tasks without
        full marks is judged with their references in place of the student's functions.

        only : ids of the tasks to judge, together with the tasks that they need; None for all."""
        ids = [task.id for task in self.tasks] if only is None else only
        wanted = set().union(*(self._required(id) for id in ids))
        found = {}
        for task in self.tasks:
            if task.id not in wanted:
                continue
            needed = self._required(task.id) - {task.id}
            wrong = [need for need in self.tasks if need.id in needed and not found[need.id].full]
            references = tuple(reference for need in wrong for reference in need.references)
            names = tuple(reference.function for reference in references)
            found[task.id] = replace(judge_one(task, references), replaced=names)
        return found

    def _required(self, id):
        return {id}.union(*(self._required(need) for need in self.task(id).needs))
