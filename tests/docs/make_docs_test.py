"""tools/make-docs on a small project: reproduced blocks pass; stale, unmarked and unlisted ones do not."""

import fcntl
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

TOOL = Path(__file__).resolve().parents[2] / "tools" / "make-docs"

LIST = """
[run.drive]
commands = "printf 'error 3.412 m in 10 runs\\\\n'; printf 'P %s' 1 > out/docs/drive/map.svg"
seconds = 0
sample = true

[block.drive]
page = "docs/page.md"
runs = ["drive"]
tolerance = 0.01
text = '''
{printed("drive")}
'''

[picture.map]
run = "drive"
file = "map.svg"
to = "docs/images/map.svg"
"""
PAGE = "Before.\n\n<!-- generated: drive -->\n    error 3.412 m in 10 runs\n<!-- end -->\n\n![map](images/map.svg)\n"


class MakeDocs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.project = Path(folder.name)
        (self.project / "docs" / "images").mkdir(parents=True)
        (self.project / "README.md").write_text("# A project\n")
        self.write(PAGE, LIST)

    def write(self, page: str, numbers: str = LIST, picture: str = "P 1"):
        (self.project / "docs" / "page.md").write_text(page)
        (self.project / "docs" / "numbers.toml").write_text(numbers)
        (self.project / "docs" / "images" / "map.svg").write_text(picture)

    def page(self) -> str:
        return (self.project / "docs" / "page.md").read_text()

    def run_tool(self, *words: str) -> subprocess.CompletedProcess:
        return subprocess.run([sys.executable, TOOL, "--project", self.project, *words], text=True, capture_output=True)

    def expect(self, code: int, *words: str, said: str = ""):
        ended = self.run_tool(*words)
        self.assertEqual(ended.returncode, code, ended.stdout + ended.stderr)
        self.assertIn(said, ended.stdout + ended.stderr)

    def test_reproduced_blocks_pass(self):
        self.expect(0, "--check", said="0 stale")
        self.expect(0, "--check", "--sample", said="2 blocks and pictures")

    def test_a_stale_number_fails_and_is_shown_with_the_remedy(self):
        self.write(PAGE.replace("3.412", "3.612"))
        self.expect(1, "--check", said="tools/make-docs drive")
        self.expect(1, "--check", "--sample", said="+    error 3.412 m")
        self.assertIn("3.612", self.page())

    def test_a_number_within_the_tolerance_passes(self):
        self.write(PAGE.replace("3.412", "3.440"))
        self.expect(0, "--check", said="within 1 %")

    def test_without_a_tolerance_every_digit_counts(self):
        self.write(PAGE.replace("3.412", "3.413"), LIST.replace("tolerance = 0.01", "tolerance = 0"))
        self.expect(1, "--check", said="is stale")

    def test_one_unit_of_the_last_decimal_passes_and_a_count_does_not(self):
        self.write(PAGE.replace("3.412", "3.413"), LIST.replace("tolerance = 0.01", "tolerance = 1e-9"))
        self.expect(0, "--check", said="0 stale")
        self.write(PAGE.replace("10 runs", "11 runs"))
        self.expect(1, "--check", said="is stale")

    def test_words_are_compared_exactly(self):
        self.write(PAGE.replace("error", "drift"))
        self.expect(1, "--check", said="is stale")

    def test_a_number_more_or_less_is_stale(self):
        self.write(PAGE.replace("3.412 m", "3.412 3.412 m"))
        self.expect(1, "--check", said="is stale")

    def test_a_stale_picture_fails(self):
        self.write(PAGE, picture="P 2")
        self.expect(1, "--check", said="docs/images/map.svg is stale")

    def test_making_writes_only_the_block_and_the_picture(self):
        self.write(PAGE.replace("3.412", "9"), picture="old")
        self.expect(0, said="drive: changed")
        self.assertEqual(self.page(), PAGE)
        self.assertEqual((self.project / "docs" / "images" / "map.svg").read_text(), "P 1")
        self.expect(0, said="drive: as it was")

    def test_an_indented_block_keeps_its_indentation(self):
        indented = PAGE.replace("<!--", "  <!--").replace("    error", "      error")
        self.write(indented.replace("3.412", "9"))
        self.expect(0)
        self.assertEqual(self.page(), indented)

    def test_a_marker_without_an_entry_is_found(self):
        self.write(PAGE + "\n<!-- generated: walk -->\n<!-- end -->\n")
        self.expect(1, "--lint", said="block walk has no entry")

    def test_an_entry_without_a_marker_is_found(self):
        self.write("![map](images/map.svg)\n")
        self.expect(1, "--lint", said="has no block <!-- generated: drive -->")

    def test_a_picture_that_no_command_makes_is_found(self):
        self.write(PAGE, LIST[:LIST.index("[picture.map]")])
        self.expect(1, "--lint", said="docs/images/map.svg: no command")

    def test_a_marker_that_is_never_closed_is_refused(self):
        self.write(PAGE.replace("<!-- end -->", ""))
        self.expect(2, "--lint", said="never closed")

    def test_a_run_that_writes_elsewhere_is_refused(self):
        self.write(PAGE, LIST.replace("> out/docs/drive/map.svg", "> out/elsewhere"))
        self.expect(2, "--lint", said="belongs under out/docs/drive")

    def test_a_changed_input_repeats_the_run(self):
        numbers = LIST.replace("printf 'error 3.412 m in 10 runs\\\\n'", "cat input.txt")
        self.write(PAGE, numbers)
        (self.project / "input.txt").write_text("error 3.412 m in 10 runs\n")
        self.expect(0, "--check")
        (self.project / "input.txt").write_text("error 4.5 m in 10 runs\n")
        self.expect(1, "--check", said="+    error 4.5 m")

    def test_a_command_that_fails_is_an_error(self):
        self.write(PAGE, LIST.replace("printf 'P %s'", "false; printf 'P %s'"))
        self.expect(1, "--check", said="drive: code 1 of")

    def test_a_picture_that_the_run_did_not_leave_is_an_error(self):
        self.write(PAGE, LIST.replace('file = "map.svg"', 'file = "figures/map.svg"'))
        self.expect(1, "--check", said="run drive left no figures/map.svg")

    def test_two_at_once_are_refused(self):
        (self.project / "out" / "docs").mkdir(parents=True)
        with (self.project / "out" / "docs" / "lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            self.expect(1, "--check", said="another tools/make-docs is at work")
        self.expect(0, "--check")

    def test_missing_recordings_are_reported_and_skipped(self):
        self.write(PAGE.replace("3.412", "9"), LIST.replace("seconds = 0", 'seconds = 0\nrecordings = "nowhere"'))
        self.expect(0, "--check", said="skipped, recordings nowhere are not there")

    def test_times_are_never_compared_and_measured_only_on_request(self):
        self.write(PAGE.replace("3.412", "9"), LIST.replace("sample = true", "timed = true"))
        self.expect(0, "--check", "drive", said="0 stale")
        self.expect(0, said="0 blocks and pictures")
        self.expect(0, "--timed", said="drive: changed")
        for _ in range(2):  # measured again by each call, but once for several blocks
            ended = self.run_tool("--timed")
            self.assertEqual(ended.stderr.count("drive: about"), 1, ended.stderr)

    def test_an_unknown_id_suggests_the_nearest(self):
        self.expect(2, "--check", "drvie", said="the nearest is `drive`")


def png(path: Path, rows: list[bytes]):
    """A gray PNG of lines that already have their filter byte."""
    def chunk(kind: bytes, content: bytes) -> bytes:
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    header = struct.pack(">IIBBBBB", len(rows[0]) - 1, len(rows), 8, 0, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(b"".join(rows))) +
                     chunk(b"IEND", b""))


class Pictures(unittest.TestCase):
    """Lines of PNG specification, 9.2, computed by hand: each filter restores 10 20 30."""

    def test_filters_are_inverted(self):
        sys.path.insert(0, str(TOOL.parent))
        from pages.png import mean_difference, samples
        with tempfile.TemporaryDirectory() as folder:
            a, b = Path(folder) / "a.png", Path(folder) / "b.png"
            png(a, [bytes([0, 10, 20, 30]), bytes([1, 10, 10, 10]), bytes([2, 0, 0, 0]), bytes([3, 5, 5, 5]),
                    bytes([4, 0, 0, 0])])
            self.assertEqual(samples(a), ((3, 5, 1), bytes([10, 20, 30] * 3 + [10, 20, 30] * 2)))
            png(b, [bytes([0, 10, 20, 30])] * 4 + [bytes([0, 10, 20, 81])])
            self.assertAlmostEqual(mean_difference(a, b), 51 / 255 / 15)


class Tables(unittest.TestCase):
    def test_noise_of_the_room(self):
        """Medians of the runs that are done; lost frames of all."""
        sys.path.insert(0, str(TOOL.parent))
        from pages import tables
        from pages.results import Results
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "room").mkdir()
            columns = "variant,seed,status,mean_nees,mean_nis,ate_m,overconfident_frames,frames,consistency.outlier_share,lost_frames"
            (Path(folder) / "room" / "runs.csv").write_text(
                f"{columns}\nroom,1,done,0.9,0.7,0.001,0,1000,0.01,0\nroom,2,done,1.1,0.9,0.002,2,1000,0.03,5\n"
                "room,3,failed,9,9,9,9,1000,0.9,7\nroom,4,failed,nan,nan,nan,nan,nan,nan,nan\n")
            self.assertEqual(tables.noise_cells(Results(Path(folder), {}), "room"),
                             "1.00 (0.90 to 1.10) | 0.80 | 1.50 | 0.10 % | 2.0 % | 12 |")


if __name__ == "__main__":
    unittest.main()
