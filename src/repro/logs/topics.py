"""Messages in the order of trials and steps: complete, and alike in every topic."""

from collections.abc import Callable, Collection, Mapping

import numpy as np

from repro.logs.content import Content
from repro.logs.format import LogError

COUNTER_END = 2**32  # trial and step are uint32

# Numbers of the trials, (trials,), and values, (trials, messages a trial, fields).
Topic = tuple[np.ndarray, np.ndarray]


def read_topics(
    content: Content,
    fields: Mapping[str, tuple[str, ...]],
    read: Callable[[Content, str, tuple[str, ...]], Topic],
    once: Collection[str] = (),
    between: Collection[str] = (),
) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Trials, and the values of each topic by `read`.

    Raises LogError unless all numbers are finite and all topics have the same trials, and as many
    messages a trial; those of `once` have one, and those of `between`, which lie between the
    steps, one fewer.
    """
    topics = {topic: read(content, topic, names) for topic, names in fields.items()}
    if not topics:
        raise LogError(f"{content.path}: the log has no topic")
    trials, _ = next(iter(topics.values()))
    for topic, (of_topic, values) in topics.items():
        _check_finite(f"{content.path}: topic {topic}", fields[topic], of_topic, values)
        if not np.array_equal(of_topic, trials):
            raise LogError(f"{content.path}: topic {topic}: other trials than the topics before it")
    lengths = {topic: values.shape[1] for topic, (_, values) in topics.items()}
    longest = max(lengths, key=lambda topic: lengths[topic])
    for topic, length in lengths.items():
        if topic in once and length > 1:
            raise LogError(
                f"{content.path}: topic {topic}: a trial has {length} messages; it must have one"
            )
        if topic not in once and length < lengths[longest] - (topic in between):
            raise LogError(
                f"{content.path}: topic {topic}: a trial has {length} messages, but "
                f"{lengths[longest]} on {longest}"
            )
    return trials, {topic: values for topic, (_, values) in topics.items()}


def arrange(where: str, trial: np.ndarray, step: np.ndarray, values: np.ndarray) -> Topic:
    """Messages in the order of trial and step, complete and without repetition."""
    steps = int((trial == trial[0]).argmin()) or len(trial)  # if it is in order
    if step.dtype.kind == "u" and len(trial) % steps == 0:
        numbers = trial[::steps]
        ascending = (np.diff(numbers.astype(int)) > 0).all()
        in_order = (step.reshape(-1, steps) == np.arange(steps)).all()
        if ascending and in_order and (trial.reshape(-1, steps) == numbers[:, None]).all():
            return numbers.astype(int), values.reshape(len(numbers), steps, -1)
    for name, counter in (("trial", trial), ("step", step)):
        with np.errstate(invalid="ignore"):
            valid = (counter >= 0) & (counter < COUNTER_END) & (counter % 1 == 0)
        if not valid.all():
            raise LogError(f"{where}: the field '{name}' must be an integer from 0 to 2^32 - 1")
    numbers, counts = np.unique(trial, return_counts=True)
    steps = int(counts.max())
    if (counts < steps).any():
        short = numbers[counts < steps][0]
        raise LogError(f"{where}: trial {short:g} has fewer than {steps} messages")
    expected_trial = np.repeat(numbers, steps)
    expected_step = np.tile(np.arange(steps), len(numbers))
    if not (np.array_equal(trial, expected_trial) and np.array_equal(step, expected_step)):
        order = np.lexsort((step, trial))
        trial, step, values = trial[order], step[order], values[order]
        if not np.array_equal(step, expected_step):
            wrong = trial[step != expected_step][0]
            raise LogError(f"{where}: trial {wrong:g} has a missing or repeated step")
    return numbers.astype(int), np.ascontiguousarray(values).reshape(len(numbers), steps, -1)


def _check_finite(
    where: str, names: tuple[str, ...], trials: np.ndarray, values: np.ndarray
) -> None:
    with np.errstate(invalid="ignore", over="ignore"):
        total = values.sum()  # in one pass; it may also be too large
    if np.isfinite(total):
        return
    finite = np.isfinite(values)
    if not finite.all():
        trial, step, field = np.argwhere(~finite)[0]
        raise LogError(
            f"{where}: the field '{names[field]}' of trial {trials[trial]}, step {step} is "
            f"{values[trial, step, field]}; it must be a finite number"
        )
