"""docs/your-own-log.md: its tables, and its example run to the estimates."""

import re

import pandas as pd

from repro.pages.log_topics import log_topics
from tests.conftest import ROOT
from tests.workflow.conftest import Project

PAGE = (ROOT / "docs/your-own-log.md").read_text()


def test_the_page_lists_the_topics_that_the_studies_name():
    assert PAGE.endswith(log_topics(ROOT / "params") + "\n"), "see repro.pages.log_topics"


def test_the_example_of_the_page_runs_to_its_table(tmp_path, monkeypatch):
    project = Project(tmp_path)
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"```(\w+)\n(.*?)```", PAGE, flags=re.DOTALL)
    for kind, text in blocks:
        if kind == "python":
            exec(compile(text, "docs/your-own-log.md", "exec"), {})
    (yaml_,) = (text for kind, text in blocks if kind == "yaml")
    (tmp_path / "robot.yaml").write_text(yaml_)
    (command,) = (text.split() for kind, text in blocks if kind == "sh")
    tables = []
    for log in ("robot.mcap", "robot_ros2.mcap"):
        project.snakemake(*(word.replace("robot.mcap", log) for word in command[2:]))
        tables.append(pd.read_csv(tmp_path / command[2]))
    pd.testing.assert_frame_equal(*tables)
    assert list(tables[0].columns) == ["trial", "k", "p1", "v1", "a1", "p2", "v2", "a2"]
    assert len(tables[0]) == 21 and abs(tables[0]["p1"].iloc[-1] - 140.0) < 10.0
