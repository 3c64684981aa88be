"""Whether this machine gives the bytes that are committed: python -m tests.reference [--write]"""

import sys

from tests.conftest import points
from tests.reference import COMMITTED, digests

lines = [line for study in points() for line in digests(study)]
if "--write" in sys.argv[1:]:
    COMMITTED.write_text("\n".join(lines) + "\n")
else:
    committed = COMMITTED.read_text().splitlines()
    other = [line for line in lines if line not in committed]
    print("\n".join(other) or f"all {len(lines)} digests are as committed")
    sys.exit(bool(other) or len(lines) != len(committed))
