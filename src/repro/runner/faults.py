"""A filter that fails, or takes long: one line that says where, and its own traceback."""

import sys
import time
import traceback
from collections.abc import Iterator
from contextlib import contextmanager
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


@contextmanager
def inside(task: Task, where: str) -> Iterator[None]:
    """A call into a filter: its exceptions become one line, with its own part of the traceback."""
    try:
        yield
    except ReproError as error:  # already one line: of a channel or a setting
        text = str(error)
        if text.startswith(str(task)):
            raise
        raise ReproError(f"{task}: {where}: {text.removeprefix(f'filter {task.name}: ')}") from None
    except Exception as error:
        frames = traceback.extract_tb(error.__traceback__)
        own = [frame for frame in frames if Path(frame.filename).parent != RUNNER]
        raise FilterError(
            f"{task}: {where}: {type(error).__name__}: {error}",
            "".join(traceback.format_list(own)),
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
