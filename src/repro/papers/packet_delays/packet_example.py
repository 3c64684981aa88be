"""Which packet is used in which step, for the printed flags [packet_delays Table 1]."""

from pathlib import Path
from typing import Any

import numpy as np

from repro.network import packet_delays
from repro.tables.csv_file import write_csv


def tabulate(name: str, example: dict[str, Any], path: str | Path) -> None:
    """Write the packet that arrives at k = 1, 2, ... for the flags (N, steps) of an example."""
    flags = np.array(example["flags"], dtype=float)
    before = np.ones((1, len(flags), 1))  # k = 0, which the table leaves out
    delay = packet_delays.delays(
        np.concatenate([before, flags[None]], axis=2), example["packet_bound"]
    )
    origin = packet_delays.origins(delay)[0, 1:]
    write_csv(
        [
            {"study": "packet_example", "point": name, "filter": "-", "metric": "received_packet"}
            | {"component": f"k={k}", "value": int(packet), "mcse": 0.0, "trials": 1}
            for k, packet in enumerate(origin, start=1)
        ],
        path,
    )
