"""The longer form: python -m tests.torture [--minutes 10] [--seed N]; prints what it tried."""

import argparse
import random
import secrets
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

from tests.torture.hosts import faults_of_two_hosts
from tests.torture.kills import KILLS, clear, kill_and_resume, undisturbed
from tests.torture.paper import smallest_paper
from tests.torture.wrong_logs import WRONG, fault_of, right_runs

LOGS_A_ROUND = 50


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.torture", description=__doc__)
    parser.add_argument("--minutes", type=float, default=10)
    parser.add_argument("--seed", type=int, default=secrets.randbelow(10**6))
    given = parser.parse_args()
    print(f"seed {given.seed} (repeat: python -m tests.torture --seed {given.seed})", flush=True)
    chance, end = random.Random(given.seed), time.monotonic() + 60 * given.minutes
    tried, faults = Counter(), []

    def found(new: list[str]) -> str:
        faults.extend(new)
        return "ok" if not new else "FAULT: " + "; ".join(new)

    with tempfile.TemporaryDirectory() as folder:
        logs = Path(folder, "logs")
        logs.mkdir()
        (copy := Path(folder, "project")).mkdir()
        project = smallest_paper(copy)
        expected = undisturbed(project)
        right = right_runs(logs)
        while True:
            for kind in KILLS:
                clear(project)
                moment, new = kill_and_resume(project, expected, kind, chance)
                tried[f"kill of {kind}"] += 1
                print(f"kill of {kind} {moment}: {found(new)}", flush=True)
            tried["two hosts"] += 1
            print(f"two hosts: {found(faults_of_two_hosts(project))}", flush=True)
            for _ in range(LOGS_A_ROUND):
                kind = chance.choice(sorted(WRONG))
                tried[f"log: {kind}"] += 1
                if fault := fault_of(kind, chance, logs, right):
                    print(f"log: {found([fault])}", flush=True)
            if time.monotonic() > end:
                break
    for name, count in sorted(tried.items()):
        print(f"{count:6d} {name}")
    print(f"{len(faults)} faults found with seed {given.seed}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
