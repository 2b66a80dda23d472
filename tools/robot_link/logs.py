"""What the robot and navigation write while they run. Times are those of the robot's clock, s since 1970."""

import math


class Rows:
    """The whole rows of a text file that another process writes, each read once. `make` gives what is kept of the cells of a row."""

    def __init__(self, file, make, separator=",", has_header=True):
        self.file, self.make, self.separator = file, make, separator
        self.columns = None if has_header else []
        self.position = 0
        self.kept = []

    def all(self):
        try:
            with open(self.file, "rb") as opened:
                opened.seek(self.position)
                data = opened.read()
        except OSError:
            return self.kept
        whole = data[:data.rfind(b"\n") + 1]
        self.position += len(whole)
        for line in whole.decode().splitlines():
            cells = line.split(self.separator)
            if self.columns is None:
                self.columns = cells
            elif not line.startswith("#"):
                self.kept.append(self.make(dict(zip(self.columns, cells)) if self.columns else cells))
        return self.kept

    def since(self, t):
        return [row for row in self.all() if row["t"] > t]


def pose_of(cells):
    return {"t": float(cells[0]), "position": [float(cell) for cell in cells[1:4]]}


class RobotLog:
    """robot.csv and truth.tum."""

    def __init__(self, folder):
        self.steps = Rows(folder / "robot.csv", lambda row: {
            "t": float(row["t"]),
            "command_t": float(row["command_t"] or "nan"),
            "moves": float(row["speed_m_s"]) != 0 or float(row["turn_rate_rad_s"]) != 0,
            "place": [float(row["x_m"]), float(row["y_m"])]})
        self.poses = Rows(folder / "truth.tum", pose_of, " ", has_header=False)

    def moves(self):
        """Whether the last step moved."""
        steps = self.steps.all()
        return bool(steps) and steps[-1]["moves"]

    def obeys_command_since(self, t):
        """Whether a command of after that time is in force; it may be to stand, where the strategy decides so."""
        steps = self.steps.all()
        return bool(steps) and steps[-1]["command_t"] > t


class RunLog:
    """series.csv, measurements.csv and estimate.tum of a run directory; navigation writes them once a second."""

    def __init__(self, folder):
        self.folder = folder
        self.state = folder / "run.state"
        self.frames = Rows(folder / "series.csv", lambda row: {
            "t": float(row["t"]), "state": row["state"], "matched": int(row["matched"])})
        self.matches = Rows(folder / "measurements.csv", lambda row: {
            "t": float(row["t"]), "id": int(row["id"]),
            "is_matched": row["outcome"] == "matched" and row["kind"] in ("landmark", "anchor")})
        self.poses = Rows(folder / "estimate.tum", pose_of, " ", has_header=False)

    def matched_ids(self, first_t, last_t):
        return {row["id"] for row in self.matches.all() if row["is_matched"] and first_t <= row["t"] <= last_t}


def image_of(row):
    """The stamp of its image, in us. Ticks without an image have times that no image has."""
    return round(1e6 * row["t"])


def position_errors(estimated, true):
    """Distances in m of the estimated positions from the true ones of the same image; both are in the frame of the target."""
    at = {image_of(row): row["position"] for row in true}
    return [math.dist(row["position"], at[image_of(row)]) for row in estimated if image_of(row) in at]


def rms(values):
    return math.sqrt(sum(value * value for value in values) / len(values)) if values else math.nan
