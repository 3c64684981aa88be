"""A log that no job names as its input is made again, or read again, like any other."""

ASKED = ("results/runs/linear_delays/main/prior/0.npz", "--config", "trials=4")


def test_a_deleted_log_is_made_again_and_a_changed_one_is_read_again(trimmed):
    trimmed.keep_filters("prior")
    trimmed.snakemake(*ASKED)
    log = trimmed.folder / "results/logs/linear_delays/arrival=0.9/0.mcap"  # not the first
    content = log.read_bytes()
    log.unlink()
    trimmed.snakemake(*ASKED)
    assert log.read_bytes() == content
    log.write_bytes(content[:-100])
    output = trimmed.snakemake(*ASKED, fails=True)
    assert f"error: {log.relative_to(trimmed.folder)}" in output
