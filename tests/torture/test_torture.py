"""The short form of `python -m tests.torture`: the seed of a failure is in its message."""

import random
import secrets

import pytest

from tests.torture.hosts import faults_of_two_hosts
from tests.torture.kills import KILLS, clear, kill_and_resume, undisturbed
from tests.torture.paper import smallest_paper
from tests.torture.wrong_logs import WRONG, fault_of, right_runs

LOGS = 100


@pytest.fixture
def seed():
    return secrets.randbelow(10**6)


def test_one_paper_killed_at_random_moments(tmp_path, seed):
    chance, project = random.Random(seed), smallest_paper(tmp_path)
    expected = undisturbed(project)
    for kind in KILLS:
        clear(project)
        moment, faults = kill_and_resume(project, expected, kind, chance)
        assert not faults, f"seed {seed}: kill of {kind} {moment}: {faults}"
    assert not faults_of_two_hosts(project)


def test_a_hundred_wrong_logs(tmp_path, seed):
    chance, right = random.Random(seed), right_runs(tmp_path)
    kinds = [*WRONG, *chance.choices(sorted(WRONG), k=LOGS - len(WRONG))]
    faults = [fault_of(kind, chance, tmp_path, right) for kind in kinds]
    assert not any(faults), f"seed {seed}: {[fault for fault in faults if fault]}"
