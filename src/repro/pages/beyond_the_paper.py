"""What a referee asks next, on the page of a paper: sentences that the run has computed."""

from collections.abc import Collection
from pathlib import Path

import pandas as pd

from repro.pages.markdown import markdown_line

TOPICS = {
    "consistency": "Are the filters' own covariances true, and how near is the best possible?",
    "convergence": "Are the particles enough?",
    "mismatch": "What does a wrong parameter cost?",
    "tails": "What does a mean hide?",
    "decidable": "Would the paper's number of runs have decided?",
}
PICTURES = {"consistency": ("consistency", "bounds")}  # of a topic; else the one of its name


def beyond_the_paper(
    findings: pd.DataFrame, consistency: str | Path | None, pictures: Collection[str], folder: str
) -> list[str]:
    """Lines of the section: the paper's rows of results/findings.csv, and the file of consistency.

    `pictures` are those that the paper has, in `folder`.
    """
    told: dict[str, list[str]] = {}
    for topic, sentence in zip(findings["topic"], findings["sentence"], strict=True):
        told.setdefault(topic, []).append(f"- {markdown_line(sentence)}")
    if consistency is not None:
        told["consistency"] = Path(consistency).read_text(encoding="utf-8").rstrip().split("\n")
    text = ["", "## Beyond the paper"]
    for topic, question in TOPICS.items():
        if topic in told:
            shown = [p for p in PICTURES.get(topic, (topic,)) if p in pictures]
            links = "; ".join(f"[{name}]({folder}/{name}.png)" for name in shown)
            text += ["", f"**{question}** {links}".rstrip(), "", *told[topic]]
    return text
