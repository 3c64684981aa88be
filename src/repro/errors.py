"""The one exception that means: the input is at fault, not the program."""

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np


class ReproError(Exception):
    """Bad input. Its text is one line: the file, the key or topic, the cause and the fix."""

    details = ""  # what a reader may want to see besides: a traceback of code of one's own

    def __init__(self, text: str):
        # Names in a file are anyone's: what a terminal would obey is shown escaped.
        shown = (c if c.isprintable() or c in "\r\n" else repr(c)[1:-1] for c in text)
        super().__init__(" ".join("".join(shown).splitlines()))


@contextmanager
def computing(what: str) -> Iterator[None]:
    """Values that each are allowed may not go together: a singular matrix is then their fault."""
    try:
        yield
    except (ArithmeticError, np.linalg.LinAlgError) as error:
        raise ReproError(f"{what}: {error}: fix the parameters or settings") from error
