"""A simulated robot, navigation that explores with it, and the network between them."""

import re
import shutil
import signal
import subprocess
import time
from pathlib import Path

from .logs import RobotLog, RunLog
from .proxy import Proxy

PROJECT = Path(__file__).resolve().parent.parent.parent


class Failure(Exception):
    """What a trial shows that must not be."""


def wait(limit_s, what, condition):
    end = time.time() + limit_s
    while time.time() < end:
        found = condition()
        if found:
            return found
        time.sleep(0.005)
    raise Failure(f"waited {limit_s} s in vain for {what}")


class Exploration:
    """Its folder has `robot`, with the robot's log, and a run directory per process of navigation: `run`, `run-2`, ..."""

    def __init__(self, options, folder, seed):
        self.options, self.folder, self.seed = options, folder, seed
        self.log = RobotLog(folder / "robot")
        self.runs = []
        self.processes = []
        self.robot = self.navigation = self.proxy = None
        self.robot_port = 0

    @property
    def run(self):
        """The log of the latest process of navigation."""
        return self.runs[-1]

    def begin(self):
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        self.start_robot()
        self.proxy = Proxy(self.robot_port)
        self.proxy.start()
        self.start_navigation(
            "run", str(PROJECT / "scenarios" / "robot.toml"), "--set", f"robot.address=ws://127.0.0.1:{self.proxy.port}",
            "--set", f"run.save_every_s={self.options.save_every}", "--duration", "100000", "--seed", str(self.seed))
        wait(60, "the first motion", self.log.moves)

    def end(self):
        for process in reversed(self.processes):
            if process.poll() is None:
                process.send_signal(signal.SIGINT)
                try:
                    process.wait(20)
                except subprocess.TimeoutExpired:
                    process.kill()
                    process.wait()
        if self.proxy:
            self.proxy.is_over = True
            self.proxy.join()

    def start(self, name, arguments):
        with open(self.folder / f"{name}.txt", "a") as output:
            process = subprocess.Popen([self.options.program, *arguments], stdout=output, stderr=output)
        self.processes.append(process)
        return process

    def start_robot(self, *more):
        said = self.folder / "robot.txt"
        address = lambda: re.findall(r"the robot is at ws://[^:]*:(\d+)", said.read_text())
        starts = len(address()) if said.exists() else 0
        self.robot = self.start("robot", [
            "robot", "explore-terrain", "--port", str(self.robot_port), "--watchdog", str(self.options.watchdog), "--out",
            str(self.folder / "robot"), "--seed", str(self.seed), *more])
        wait(30, "the robot's address", lambda: len(address()) > starts)
        self.robot_port = int(address()[-1])

    def start_navigation(self, *arguments):
        number = len(self.runs) + 1
        out = self.folder / ("run" if number == 1 else f"run-{number}")
        self.runs.append(RunLog(out))
        self.navigation = self.start("navigation", [*arguments, "--no-figures", "--out", str(out)])

    def saved(self):
        """The newest saved state of navigation; none before the first."""
        return next((run.state for run in reversed(self.runs) if run.state.exists()), None)

    def resume_navigation(self):
        self.start_navigation("run", "--resume", str(self.saved()))

    def check_navigation(self):
        code = self.navigation.poll()
        if code is not None:
            last = (self.folder / "navigation.txt").read_text().strip().split("\n")[-1]
            raise Failure(f"navigation ended with code {code}: {last}")
