"""The one exception that means: the input is at fault, not the program."""

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np


class ReproError(Exception):
    """Bad input. Its text is one line: the file, the key or topic, the cause and the fix."""

    def __init__(self, text: str):
        super().__init__(" ".join(text.splitlines()))


@contextmanager
def computing(what: str) -> Iterator[None]:
    """Values that each are allowed may not go together: a singular matrix is then their fault."""
    try:
        yield
    except (ArithmeticError, np.linalg.LinAlgError) as error:
        raise ReproError(f"{what}: {error}: fix the parameters or settings") from error
