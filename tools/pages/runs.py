"""Makes the runs of the list. What a run writes is under out/docs/ID; a run whose commands, program and inputs are
those of the last time is not made again, unless it measures time."""

import fcntl
import hashlib
import os
import re
import resource
import shutil
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

from pages.listing import Listing, Run


class RunError(Exception):
    """A command of the list failed; the message has its last words."""


def processor_seconds() -> float:
    """Of all children that have ended: unlike the clock on the wall, hardly changed by what else the machine does."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def this_machine() -> str:
    """Its processor, and that other work was going on, which makes times longer."""
    models = [line.partition(":")[2].strip() for line in Path("/proc/cpuinfo").read_text().split("\n")
              if line.startswith("model name")]
    load = os.getloadavg()[0]
    busy = f", busy (load {load:.1f} before the run)" if load > 0.5 * os.cpu_count() else ""
    return f"{models[0] if models else 'unnamed processor'}, {os.cpu_count()} cores{busy}"


class Runner:
    def __init__(self, project: Path, build: str, listing: Listing):
        self.project, self.build, self.listing = project, build, listing
        self.output_folder = project / "out" / "docs"
        self.timed_now: set[str] = set()  # times are measured anew by every call of the tool, once

    def folder(self, run: Run) -> Path:
        return self.output_folder / run.id

    def printed(self, run: Run) -> Path:
        return self.output_folder / f"{run.id}.stdout"

    def missing_recordings(self, run: Run) -> bool:
        if not run.recordings:
            return False
        named = os.environ.get("INCOGNITA_DATA")
        places = [Path(named)] if named else [self.project / "data", self.project / ".." / "shared" / "data"]
        return not any((place / run.recordings).exists() for place in places)

    @contextmanager
    def alone(self):
        """While it lasts no other process makes runs in the same folder. Throws RunError where one does already."""
        self.output_folder.mkdir(parents=True, exist_ok=True)
        with (self.output_folder / "lock").open("w") as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                raise RunError(f"{self.output_folder}: another tools/make-docs is at work there; wait for its end") from None
            yield

    def make(self, run: Run) -> None:
        """Makes the run and those it uses, if need be. Throws RunError."""
        for other in run.uses:
            self.make(self.listing.runs[other])
        stamp, key = self.output_folder / f"{run.id}.stamp", self.key(run)
        begun, done = f"begun {key}\n", f"done {key}\n"
        state = stamp.read_text() if stamp.exists() else ""
        if state == done and not (run.timed and run.id not in self.timed_now):
            return
        if state != begun:  # what another program left would be taken for this one's; an interrupted campaign goes on
            shutil.rmtree(self.folder(run), ignore_errors=True)
        stamp.write_text(begun)
        self.execute(run)
        stamp.write_text(done)
        self.timed_now.add(run.id)

    def execute(self, run: Run) -> None:
        print(f"{run.id}: about {run.seconds:g} s of processor time", end="", flush=True, file=sys.stderr)
        start, machine = processor_seconds(), this_machine()
        commands = re.sub(r"(?m)(^|(?<=[ (]))build/", self.build.rstrip("/") + "/", run.commands)
        self.folder(run).mkdir(exist_ok=True)
        ended = subprocess.run(["bash", "-euo", "pipefail", "-c", commands], cwd=self.project, text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        print(f", took {processor_seconds() - start:.1f} s", file=sys.stderr)
        if ended.returncode != 0:
            raise RunError(f"{run.id}: code {ended.returncode} of\n{run.commands}\n{ended.stderr[-2000:]}")
        self.printed(run).write_text(ended.stdout)
        (self.output_folder / f"{run.id}.machine").write_text(machine)

    def key(self, run: Run) -> str:
        """Of everything the result depends on: the commands, the files they name, and the runs they use."""
        digest = hashlib.sha256(run.commands.encode())
        for word in re.findall(r"[\w./-]+", run.commands):
            path = Path(self.build) / word.removeprefix("build/") if word.startswith("build/") else Path(word)
            path = self.project / path
            if path.is_file() and not word.startswith("out/"):
                digest.update(path.read_bytes())
        for other in run.uses:
            digest.update(self.key(self.listing.runs[other]).encode())
        return digest.hexdigest()
