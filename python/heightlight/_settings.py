"""The arguments on accuracy and limits that all calls share."""

from __future__ import annotations

import operator
from typing import Any, Optional

from . import _native


class _Bars:
    """Shows progress as one tqdm bar per step."""

    def __init__(self, tqdm: Any) -> None:
        self._tqdm = tqdm
        self._bar: Any = None

    def __call__(self, name: str, done: int, total: int, ended: bool) -> None:
        if self._bar is None or self._bar.desc != name:
            self.close()
            self._bar = self._tqdm(total=total or None, desc=name, leave=False)
        self._bar.update(done - self._bar.n)
        if ended:
            self.close()

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()
            self._bar = None


def progress_of(wanted: Any) -> Any:
    """The progress function (name, done, total, ended) for the argument `progress`, or None."""
    if callable(wanted):
        return wanted
    if not wanted:
        return None
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None
    return _Bars(tqdm)


def integer(name: str, value: Any, least: int = 0, most: int = 2**31 - 1) -> int:
    """Checks that a value is a whole number in a range. Raises ValueError naming the argument."""
    try:
        number = operator.index(value)
    except TypeError:
        raise ValueError(f"{name} {value!r}: must be a whole number") from None
    if not least <= number <= most:
        raise ValueError(f"{name} {number}: must be from {least} to {most}")
    return number


def real(name: str, value: Any) -> float:
    """Converts a value to a float. Raises ValueError naming the argument."""
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f"{name} {value!r}: must be a number") from None


def settings(
    error: Any = 1e-3,
    azimuths: Any = None,
    rays: Any = None,
    seed: Any = 1,
    threads: Any = None,
    memory: Any = None,
    progress: Any = False,
) -> Any:
    """The settings for the compiled part. Raises ValueError for an argument out of its range."""
    return _native.Settings(
        error=real("error", error),
        azimuths=0 if azimuths is None else integer("azimuths", azimuths, 2, 65536),
        rays=0 if rays is None else integer("rays", rays, 1, 65536),
        seed=integer("seed", seed, 0, 2**64 - 1),
        threads=0 if threads is None else integer("threads", threads, 1, 65536),
        memory=0 if memory is None else integer("memory", memory, 1, 2**64 - 1),
        progress=progress_of(progress),
    )


def one_of(name: str, value: Any, known: tuple[str, ...]) -> str:
    """Checks that a value is one of the known words. Raises ValueError naming the argument and these words."""
    if value not in known:
        raise ValueError(f"{name} {value!r}: must be one of {', '.join(known)}")
    return value


FALLOFFS = ("none", "linear", "sqrt", "exponential")


def max_distance_of(max_distance: Any, falloff: Any) -> tuple[Optional[float], str]:
    """Checks a maximum distance, in world units or None, and the falloff of occluders within it."""
    return (None if max_distance is None else real("max_distance", max_distance)), one_of("falloff", falloff, FALLOFFS)
