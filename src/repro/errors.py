"""The one exception that means: the input is at fault, not the program."""


class ReproError(Exception):
    """Bad input. Its text is one line: the file, the key or topic, the cause and the mend."""
