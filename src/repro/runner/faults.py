"""A filter that fails, or takes long: one line that says where, and its own traceback."""

import sys
import time
import traceback
from pathlib import Path
from typing import NamedTuple

from repro.errors import ReproError

PROGRESS_EVERY = 20.0  # s between two lines about a filter that takes longer
RUNNER = Path(__file__).parent


class FilterError(ReproError):
    """A fault inside a filter: one line, and the filter's own part of the traceback."""

    def __init__(self, text: str, details: str):
        super().__init__(text)
        self.details = details


class Task(NamedTuple):
    """A filter, and where it runs; for messages."""

    name: str
    place: str  # study and point

    def __str__(self) -> str:
        return f"filter {self.name} on {self.place}"


class Inside:
    """A call into a filter: its exceptions become one line, with its own part of the traceback.

    `where` is in pieces, joined when there is something to say: a run enters this at every step.
    """

    __slots__ = ("_task", "_where")

    def __init__(self, task: Task, *where: object):
        self._task, self._where = task, where

    def __enter__(self) -> None:
        pass

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> None:
        if not isinstance(error, Exception):
            return
        task, text = self._task, str(error)
        if isinstance(error, ReproError) and text.startswith(str(task)):
            return
        where = f"{task}: {''.join(map(str, self._where))}"
        if isinstance(error, ReproError):  # already one line: of a channel or a setting
            text = text.removeprefix(f"filter {task.name}: ")
            raise ReproError(f"{where}: {text}") from None
        frames = traceback.extract_tb(error.__traceback__)
        own = [frame for frame in frames if Path(frame.filename).parent != RUNNER]
        raise FilterError(
            f"{where}: {type(error).__name__}: {text}", "".join(traceback.format_list(own))
        ) from error


class Progress:
    """Lines on standard error about a filter that takes long."""

    def __init__(self, task: Task, trials: int):
        self._task, self._trials, self._done = task, trials, 0.0
        self._begun = self._told = time.monotonic()

    def done(self, trials: float) -> None:
        """So many more trials are done; steps of a block count as parts of its trials."""
        self._done += trials
        now = time.monotonic()
        if now - self._told > PROGRESS_EVERY:
            self._told = now
            left = (now - self._begun) * (self._trials / self._done - 1)
            print(
                f"{self._task}: {self._done:.0f} of {self._trials} trials, about {left:.0f} s left",
                file=sys.stderr,
                flush=True,
            )
