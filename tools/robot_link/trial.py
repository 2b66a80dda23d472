"""One interruption of an exploration, and what is checked of it."""

import math
import time

from .exploration import Failure, wait
from .logs import image_of, position_errors, rms

KINDS = ["navigation", "socket", "silence", "robot"]
LOGGED_S = 1e-4  # rounding of the robot's log
ON_THE_WAY_S = 0.05  # what was sent before an interruption may arrive some milliseconds after it
TRACKING = ("tracking", "relocated")


class Trial:
    def __init__(self, exploration, kind, random):
        self.exploration, self.kind, self.random = exploration, kind, random
        self.options = exploration.options
        self.log = exploration.log
        self.at = self.back = math.nan  # when it began, and when the process or the network was there again
        self.result = {"kind": kind}

    def run(self):
        """What was measured. Throws Failure."""
        exploration = self.exploration
        time.sleep(self.random.uniform(0.5, 8))
        if self.kind == "navigation":
            wait(60, "a saved state", exploration.saved)
        wait(60, "motion", self.log.moves)
        exploration.check_navigation()
        interrupt = {"navigation": self.kill_navigation, "robot": self.kill_robot}.get(self.kind, self.interrupt_network)
        interrupt(max(self.random.uniform(1, 4), self.options.watchdog + 0.5))
        self.check_resumed()
        self.check_every_step()
        return self.result

    # ---- interruptions

    def kill_navigation(self, pause_s):
        self.at = time.time()
        self.exploration.navigation.kill()
        self.exploration.navigation.wait()
        time.sleep(pause_s)
        self.measure_stop()
        self.result["save_age_s"] = self.at - self.exploration.saved().stat().st_mtime
        self.back = time.time()
        self.exploration.resume_navigation()

    def interrupt_network(self, pause_s):
        proxy = self.exploration.proxy
        self.at = time.time()
        proxy.is_cut, proxy.is_silent = self.kind == "socket", self.kind == "silence"
        time.sleep(pause_s)
        self.measure_stop()
        self.back = time.time()
        proxy.is_cut = proxy.is_silent = False

    def kill_robot(self, pause_s):
        """It stands because it does not exist; the next process must start where it was, and not move without a command."""
        self.at = time.time()
        self.exploration.robot.kill()
        self.exploration.robot.wait()
        before = len(self.log.steps.all())
        last = self.log.steps.all()[-1]
        self.result["stopped_s"] = max(0.0, last["t"] - self.at)
        time.sleep(pause_s)
        self.back = time.time()
        self.exploration.start_robot("--resume")
        first = wait(30, "the robot's first step", lambda: self.log.steps.all()[before:before + 1])[0]
        if math.dist(first["place"], last["place"]) > 1e-3:
            raise Failure("the robot did not start where it was")
        if first["moves"]:
            raise Failure("the robot moved before it had a command")

    # ---- checks

    def measure_stop(self):
        """Time from the interruption to the last step that moved. Fails if the robot still moves, or did for too long."""
        steps = self.log.steps.all()
        if steps[-1]["t"] < self.at + self.options.watchdog:
            raise Failure("the robot's log ends before its watchdog time")
        if steps[-1]["moves"]:
            raise Failure(f"the robot still moves {steps[-1]['t'] - self.at:.2f} s after the interruption")
        last_moved = next(step["t"] for step in reversed(steps) if step["moves"])
        stopped_s = max(0.0, last_moved - self.at)
        if stopped_s > self.options.watchdog + ON_THE_WAY_S:
            raise Failure(f"the robot moved for {stopped_s:.3f} s after the interruption")
        self.result["stopped_s"] = stopped_s

    def check_every_step(self):
        """In every step of the whole exploration that moved, the last command was not older than the watchdog time."""
        for step in self.log.steps.all():
            age_s = step["t"] - step["command_t"]
            if step["moves"] and not age_s <= self.options.watchdog + LOGGED_S:
                raise Failure(f"at t = {step['t']:.3f} s the robot moved by a command from {age_s:.3f} s before")

    def check_resumed(self):
        """Navigation tracks again, in the map that it had; it drives the robot, and knows where it is."""
        exploration, limit_s = self.exploration, self.options.limit
        seen = lambda: exploration.navigation.poll() is not None or any(
            frame["state"] in TRACKING for frame in exploration.run.frames.since(self.back))
        wait(limit_s, "navigation to track again", seen)
        exploration.check_navigation()
        tracks = next(frame for frame in exploration.run.frames.since(self.back) if frame["state"] in TRACKING)
        self.result["tracking_s"] = tracks["t"] - self.back
        wait(limit_s, "a command after the interruption", lambda: self.log.obeys_command_since(self.back))
        until = tracks["t"] + self.options.after
        wait(self.options.after + 10, "further images",
             lambda: exploration.navigation.poll() is not None or exploration.run.frames.since(until))
        exploration.check_navigation()
        newest = lambda: exploration.run.frames.since(self.back)[-1]["state"]
        self.result["lost_again"] = newest() == "lost"
        wait(limit_s, "navigation, lost again, to track", lambda: exploration.navigation.poll() is not None or newest() in TRACKING)
        exploration.check_navigation()
        self.check_states()
        self.check_map(tracks["t"])
        self.check_errors()

    def check_states(self):
        frames = self.exploration.run.frames.since(self.back)
        states = [frame["state"] for frame in frames]
        if "starting" in states:
            raise Failure("navigation started anew, without its map")
        images = {image_of(pose) for pose in self.log.poses.all()}
        self.result["lost_images"] = sum(frame["state"] == "lost" and image_of(frame) in images for frame in frames)

    def check_map(self, first_t):
        """When it tracks again, it matches landmarks that it had matched before the interruption."""
        before = set().union(*(run.matched_ids(0, self.at) for run in self.exploration.runs))
        again = self.exploration.run.matched_ids(first_t, first_t)
        self.result["known_again"] = len(again & before)
        if len(again & before) < max(3, 0.5 * len(again)):
            raise Failure(f"of {len(again)} landmarks matched after the interruption {len(again & before)} were known before")

    def check_errors(self):
        true = self.log.poses.all()
        before = [pose for run in self.exploration.runs for pose in run.poses.since(self.at - self.options.after) if pose["t"] < self.at]
        after = position_errors(self.exploration.run.poses.since(self.back), true)
        self.result["error_before_m"] = rms(position_errors(before, true))
        self.result["error_m"], self.result["largest_error_m"] = rms(after), max(after, default=math.nan)
        if not self.result["error_m"] <= self.result["error_before_m"] + self.options.max_growth:
            raise Failure(f"position error {self.result['error_m']:.3f} m rms after the interruption, largest "
                          f"{self.result['largest_error_m']:.3f} m, before it {self.result['error_before_m']:.3f} m rms")
