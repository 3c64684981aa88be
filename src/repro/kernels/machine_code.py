"""Where the machine code of kernels is kept.

numba's own cache has one index a function. Two jobs that save at once can lose an entry, or leave
an index whose entry names the code of another signature or of another kind of CPU; a corrupt index
is a traceback; and a change of a kernel that is called from another file goes unnoticed. Here every
entry is a file of its own, named by all that its code depends on and checked when it is read.
"""

import fcntl
import hashlib
import os
import pickle
import platform
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import llvmlite
import numba
import numpy as np
from numba.core import config
from numba.core.caching import NullCache
from numba.core.codegen import get_host_cpu_features
from numba.core.compiler import CompileResult
from numba.core.serialize import dumps

SUFFIX = ".kernel"
_PACKAGE = Path(__file__).parent
_DIGEST = hashlib.sha256().digest_size
_PATIENCE = 60.0  # s, after which a kernel is compiled though another process does so too


def _widen_vectors() -> None:
    """Vectors of 512 bits on CPUs that run them at full clock, as LLVM takes 256 on its own.

    Those with VBMI2; the CPUs before lowered their clock. The bits of results do not depend on it.
    """
    features = get_host_cpu_features()
    named = _setting("CPU_NAME") or _setting("CPU_FEATURES") is not None
    if not named and "+avx512vbmi2" in features:
        setattr(config, "CPU_FEATURES", f"{features},-prefer-256-bit")  # noqa: B010


def compiled(function: Callable, **options: Any) -> Any:
    """numba's dispatcher of a kernel; without compilation, the function itself."""
    dispatcher: Any = numba.jit(nopython=True, **options)(function)
    if hasattr(dispatcher, "_cache"):  # not so under NUMBA_DISABLE_JIT
        dispatcher._cache = KernelCache(function)
    return dispatcher


class KernelCache(NullCache):
    """Machine code of one kernel, one file for each signature, kind of CPU and source."""

    def __init__(self, function: Callable):
        self._source = Path(function.__code__.co_filename)
        self._name = f"{function.__module__}.{function.__qualname__}"
        self._turn = _turn(self._source)

    @property
    def cache_path(self) -> str | None:
        """Where a new entry would be looked for first."""
        return next((str(place) for place in self._places()), None)

    def load_overload(self, sig: Any, target_context: Any) -> CompileResult | None:
        """The compiled signature, or None if there is none or it cannot be read.

        None begins a turn, which `save_overload` ends.
        """
        target_context.refresh()
        name = self._file_name(sig, target_context.codegen())
        found = self._read(name, target_context)
        if found is None:
            self._turn.begin()
            found = self._read(name, target_context)  # of the process that had the turn before
            if found is not None:
                self._turn.end()
        return found

    def _read(self, name: str, target_context: Any) -> CompileResult | None:
        for place in self._places():
            try:
                stored = (place / name).read_bytes()
                payload = stored[_DIGEST:]
                if hashlib.sha256(payload).digest() == stored[:_DIGEST]:
                    return CompileResult._rebuild(target_context, *pickle.loads(payload))
            except Exception:  # whatever is wrong with an entry, the kernel can be compiled anew
                continue
        return None

    def save_overload(self, sig: Any, data: CompileResult) -> None:
        """Keep a compiled signature in the first place that can be written, if there is one."""
        try:
            self._save(sig, data)
        finally:
            self._turn.end()

    def _save(self, sig: Any, data: CompileResult) -> None:
        if data.library.has_dynamic_globals or any(not lifted.can_cache for lifted in data.lifted):
            raise TypeError(f"kernel {self._name} holds an address or a large array as a global")
        payload = dumps(data._reduce())
        name = self._file_name(sig, data.codegen)
        for place in self._places():
            try:
                place.mkdir(parents=True, exist_ok=True)
                _write(place / name, hashlib.sha256(payload).digest() + payload)
                self._drop_stale(place)
            except OSError:  # not writable, or full
                continue
            return

    def _places(self) -> Iterator[Path]:
        """NUMBA_CACHE_DIR alone, if it is set; else beside the source, else the user's cache."""
        folder = self._source.resolve().parent
        own = hashlib.sha256(str(folder).encode()).hexdigest()[:16]
        named = _setting("CACHE_DIR")
        if named:
            yield Path(named) / f"repro-{own}"
            return
        yield folder / "__pycache__"
        home = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")  # noqa: PTH111
        if Path(home).is_absolute():  # there is no home of an unknown user
            yield Path(home) / "repro" / own

    def _file_name(self, sig: Any, codegen: Any) -> str:
        depends_on = (
            repr(sig),
            codegen.magic_tuple(),
            [_setting(n) for n in ("OPT", "LOOP_VECTORIZE", "SLP_VECTORIZE", "BOUNDSCHECK")],
            (numba.__version__, llvmlite.__version__, np.__version__),
            (platform.python_implementation(), sys.version_info[:3], getattr(sys, "abiflags", "")),
        )
        key = hashlib.sha256(repr(depends_on).encode()).hexdigest()[:32]
        return f"{self._name}.{self._stamp()}.{key}{SUFFIX}"

    def _stamp(self) -> str:
        """Digest of every source that the code may come from: all kernels, and its own file."""
        own = None if self._source.is_relative_to(_PACKAGE) else self._source
        return _digest_of_sources(own)

    def _drop_stale(self, place: Path) -> None:
        """Remove what earlier sources of the kernel left."""
        for entry in place.glob(f"{self._name}.*{SUFFIX}"):
            if not entry.name.startswith(f"{self._name}.{self._stamp()}."):
                entry.unlink(missing_ok=True)


class Turn:
    """One process at a time compiles kernels of a source: the others take what it has kept.

    Jobs of filters that share kernels start together. A turn may hold others within: of the kernels
    that a kernel calls. It ends with its process.
    """

    def __init__(self, source: Path):
        self._source, self._depth, self._file = source, 0, -1

    def begin(self) -> None:
        """Wait for the turn, but not for ever, nor where files cannot be locked."""
        self._depth += 1
        if self._depth > 1:
            return
        give_up = time.monotonic() + _PATIENCE
        try:
            self._file = os.open(self._source, os.O_RDONLY)
            while not self._locked() and time.monotonic() < give_up:
                time.sleep(0.02)
        except OSError:
            return

    def _locked(self) -> bool:
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        return True

    def end(self) -> None:
        """Let the next process begin."""
        self._depth -= 1
        if self._depth == 0 and self._file >= 0:
            os.close(self._file)
            self._file = -1


_turn = cache(Turn)


def _setting(name: str) -> Any:
    """A setting of numba, from its environment variable NUMBA_<name>."""
    return getattr(config, name)


@cache
def _digest_of_sources(other: Path | None) -> str:
    """Of the kernels' sources, and of one other file, as they are when first asked for."""
    digest = hashlib.sha256()
    for path in [*sorted(_PACKAGE.rglob("*.py")), *([other] if other else [])]:
        digest.update(path.name.encode() + b"\0" + hashlib.sha256(path.read_bytes()).digest())
    return digest.hexdigest()[:16]


def _write(path: Path, content: bytes) -> None:
    """Write a file that appears whole or not at all."""
    descriptor, part = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name[:40]}")
    try:
        with os.fdopen(descriptor, "wb") as stream:
            stream.write(content)
        Path(part).chmod(0o644)
        Path(part).replace(path)
    except BaseException:
        Path(part).unlink(missing_ok=True)
        raise


_widen_vectors()
