"""Cost of writing and reading a log, a message: python benchmarks/logs.py (targets: 5 and 1 us)."""

import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from mcap.reader import make_reader

from repro.logs import read_log, write_log
from repro.parameters.load import load_paper
from repro.simulate import simulated

ROOT = Path(__file__).parent.parent
STUDY, POINT, TRIALS = "linear_delays", "arrival=0.5", 250


def cpu_us_per_message(function: Callable[[], object], messages: int) -> float:
    start = time.process_time()
    function()
    return (time.process_time() - start) / messages * 1e6


def main() -> None:
    paper = load_paper(ROOT / "params" / "packet_delays.yaml")
    parameters = paper.studies[STUDY][POINT].parameters
    log = simulated(STUDY, POINT, parameters, 1, np.arange(TRIALS))
    messages = TRIALS * log.steps * len(log.fields)
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
