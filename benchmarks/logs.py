"""Cost of writing and reading a log, a message: python benchmarks/logs.py (targets: 5 and 1 us)."""

import tempfile
import time
from pathlib import Path

import numpy as np
from mcap.reader import make_reader

from repro.logs import Log, read_log, write_log

TRIALS, STEPS = 250, 300
FIELDS = {"/truth": ("x1", "x2"), "/sensor": ("z",), "/received": ("y",), "/network": ("gamma",)}


def cpu_us_per_message(function, messages: int) -> float:
    start = time.process_time()
    function()
    return (time.process_time() - start) / messages * 1e6


def main() -> None:
    generator = np.random.default_rng(0)
    values = {t: generator.normal(size=(TRIALS, STEPS, len(f))) for t, f in FIELDS.items()}
    log = Log("benchmark", "base", 0, {}, np.arange(TRIALS), FIELDS, values)
    messages = TRIALS * STEPS * len(FIELDS)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "0.mcap"
        written = cpu_us_per_message(lambda: write_log(path, log, 1.0), messages)
        read = [cpu_us_per_message(lambda: read_log(path), messages) for _ in range(3)]
        with path.open("rb") as stream:
            reader = make_reader(stream, validate_crcs=True)
            official = cpu_us_per_message(lambda: list(reader.iter_messages()), messages)
        print(f"{messages} messages, {path.stat().st_size / 1e6:.1f} MB")
    print(f"write              {written:6.2f} us a message")
    print(f"read, first        {read[0]:6.2f} us a message")
    print(f"read, again        {min(read[1:]):6.2f} us a message")
    print(f"official reader    {official:6.2f} us a message, undecoded")


if __name__ == "__main__":
    main()
