"""How the cases advance: a bar that moves on a terminal, a line a case elsewhere."""

import os
import shutil
import sys
import threading
import time
from typing import TextIO


def clock(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes}:{rest:02d}"


def bar_text(fraction: float, done: int, total: int, running: list[str], left: float | None, width: int) -> str:
    """One line of at most `width` characters: bar, cases done, time left, names of those that run."""
    length = 24
    filled = round(min(max(fraction, 0.0), 1.0) * length)
    remaining = "time left unknown" if left is None else f"{clock(left)} left"
    return f"[{'#' * filled:.<{length}}] {done}/{total}  {remaining}  {', '.join(running)}"[:width]


class CaseProgress:
    """Told when a case starts and ends, from any thread. `expected` are the seconds that a case took before."""

    def __init__(self, names: list[str], expected: dict[str, float], stream: TextIO = sys.stderr):
        usual = sum(expected.values()) / len(expected) if expected else 10.0
        self._weights = {name: expected.get(name, usual) for name in names}
        self._stream = stream
        self._bar = stream.isatty() and os.environ.get("TERM", "dumb") != "dumb"
        self._begin = time.monotonic()
        self._started: dict[str, float] = {}
        self._done: list[str] = []
        self._lock = threading.Lock()
        self._ended = threading.Event()
        self._painter = threading.Thread(target=self._keep_painting, daemon=True)

    def __enter__(self) -> "CaseProgress":
        if self._bar:
            self._painter.start()
        return self

    def __exit__(self, *_) -> None:
        self._ended.set()
        if self._bar:
            self._painter.join()
            self._stream.write("\r\x1b[K")
            self._stream.flush()

    def started(self, name: str) -> None:
        with self._lock:
            self._started[name] = time.monotonic()

    def finished(self, name: str, remark: str) -> None:
        with self._lock:
            seconds = time.monotonic() - self._started[name]
            self._done.append(name)
            line = f"[{len(self._done)}/{len(self._weights)}] {name}  {seconds:.0f} s{remark and '  ' + remark}\n"
            self._stream.write(("\r\x1b[K" if self._bar else "") + line)
            self._stream.flush()

    def fraction(self, now: float) -> float:
        """Of the work that is done; a running case counts by its time, but never as finished."""
        work = sum(self._weights[name] for name in self._done)
        for name in self._running():
            work += min(now - self._started[name], 0.95 * self._weights[name])
        return work / sum(self._weights.values())

    def _running(self) -> list[str]:
        return [name for name in self._started if name not in self._done]

    def _keep_painting(self) -> None:
        while not self._ended.wait(0.3):
            with self._lock:
                now = time.monotonic()
                fraction = self.fraction(now)
                left = (now - self._begin) * (1 / fraction - 1) if fraction > 0.02 else None
                width = shutil.get_terminal_size().columns - 1
                text = bar_text(fraction, len(self._done), len(self._weights), self._running(), left, width)
                self._stream.write("\r\x1b[K" + text)
                self._stream.flush()
