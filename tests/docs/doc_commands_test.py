"""tools/check-doc-commands reports every kind of wrong command in a page, for the program given on the command line."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOL = Path(__file__).resolve().parents[2] / "tools" / "check-doc-commands"
PROGRAM = ""


class DocCommands(unittest.TestCase):
    def said(self, page: str) -> tuple[int, str]:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "page.md"
            path.write_text(page)
            ended = subprocess.run([sys.executable, TOOL, "--program", PROGRAM, path], text=True, capture_output=True)
            return ended.returncode, ended.stdout + ended.stderr

    def expect_fault(self, command: str, fault: str):
        code, said = self.said(f"Text.\n\n    build/incognita {command}\n")
        self.assertEqual(code, 1, said)
        self.assertIn(fault, said)

    def test_correct_commands_pass(self):
        code, said = self.said("Text.\n\n    build/incognita run circle --set controller.law=tracking --seed 3   # a comment\n"
                               "    build/incognita campaign circle --seeds 1..3 \\\n        --vary run.rate_hz=10,20\n\n"
                               "```sh\nbuild/incognita reproduce 3.1 fig-3.4\n```\n")
        self.assertEqual(code, 0, said)
        self.assertIn("3 commands, 0 wrong", said)

    def test_a_page_without_commands_fails(self):
        self.assertEqual(self.said("    make build\n")[0], 1)

    def test_faults_are_found(self):
        self.expect_fault("walk circle", "no command `walk`")
        self.expect_fault("run circle --sede 3", "no option --sede")
        self.expect_fault("run circel", "circel")
        self.expect_fault("run circle --set controller.low=tracking", "controller.low")
        self.expect_fault("run circle --duration -5", "run.duration_s")
        self.expect_fault("campaign circle --vary run.rate_hz=10,fast", "run.rate_hz")
        self.expect_fault("campaign circle --seeds 1..2 \\\n        --set run.rate=2", "run.rate")
        self.expect_fault("reproduce 3.99", "3.99")
        self.expect_fault("observe planer", "planer")


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
