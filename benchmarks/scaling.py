"""Cost of a study over the number of trials and of shards, for docs/cluster.md.

    python benchmarks/scaling.py linear_delays 400

runs the study's table with 1, 4 and 16 times so many trials, and the last with 2, 4 and 8 shards,
each into a temporary folder with two jobs at a time, and prints wall time, CPU time of the jobs,
the largest job of simulation and filters, that of the table, and whether the tables agree.
"""

import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).parent.parent
USAGE = re.compile(r"usage: cpu_s=([\d.]+) peak_mb=([\d.]+)")


def measured(study: str, trials: int, shards: int) -> tuple[str, bytes]:
    """A row of the table, and the study's table as written."""
    with tempfile.TemporaryDirectory() as into:
        table = Path(into) / "results" / "tables" / f"{study}.csv"
        config = [f"trials={trials}", f"shards={shards}", f"into={into}"]
        begun = time.perf_counter()
        ended = subprocess.run(
            ["snakemake", "-j2", "--quiet", "all", "--config", *config, "--", str(table)],
            cwd=ROOT,
            capture_output=True,
            text=True,
        )
        if ended.returncode != 0:
            sys.exit(ended.stderr)
        wall = time.perf_counter() - begun
        logs = list((Path(into) / "results" / "job_logs").rglob("*.log"))
        usage = {log: [float(x) for x in USAGE.findall(log.read_text())[-1]] for log in logs}
        of_table = [memory for log, (_, memory) in usage.items() if log.parent.name == "table"]
        others = [memory for log, (_, memory) in usage.items() if log.parent.name != "table"]
        cpu = sum(cpu for cpu, _ in usage.values())
        row = [trials, shards, len(logs), wall, cpu, max(others), max(of_table)]
        return " | ".join(f"{value:.0f}" for value in row), table.read_bytes()


def main() -> None:
    study, trials = sys.argv[1], int(sys.argv[2])
    print("| trials | shards | jobs | wall s | CPU s | largest job MB | table MB |")
    print("|---|---|---|---|---|---|---|")
    tables = {}
    for factor, shards in ((1, 1), (4, 1), (16, 1), (16, 2), (16, 4), (16, 8)):
        row, tables[factor, shards] = measured(study, factor * trials, shards)
        print(f"| {row} |", flush=True)
    agree = len({table for (factor, _), table in tables.items() if factor == 16}) == 1
    print("the tables of all shards agree" if agree else "THE TABLES DIFFER")


if __name__ == "__main__":
    main()
