#!/usr/bin/python3
"""A script whose reader ends, as in scripts/status | head, ends without a traceback."""

import os
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


class ClosedOutput(unittest.TestCase):
    def check(self, main):
        reader, writer = os.pipe()
        os.close(reader)
        program = f"import sys; sys.path.insert(0, {str(ROOT / 'scripts')!r}); import stack; stack.run_script({main})"
        ended = subprocess.run([sys.executable, "-B", "-c", program], stdout=writer, stderr=subprocess.PIPE, text=True)
        os.close(writer)
        self.assertEqual(ended.stderr, "")
        self.assertEqual(ended.returncode, 128 + signal.SIGPIPE)

    def test_a_short_output_that_is_written_at_the_end_is_no_error(self):
        self.check("lambda: print('line')")

    def test_a_long_output_is_no_error(self):
        self.check("lambda: print('line' * 100000)")

    def test_closed_descriptors_are_none_of_the_files_that_are_opened(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "file"
            program = (f"import subprocess, sys; sys.path.insert(0, {str(ROOT / 'scripts')!r}); import stack\n"
                       f"def main():\n    file = open({str(file)!r}, 'w'); print('said'); subprocess.run(['echo', 'said'])\n"
                       "    return 7 if file.fileno() > 2 else 1\nstack.run_script(main)")
            ended = subprocess.run(["sh", "-c", '"$@" <&- >&- 2>&-', "sh", sys.executable, "-B", "-c", program], check=False)
            self.assertEqual((ended.returncode, file.read_text()), (7, ""))

    def test_a_file_that_cannot_be_written_is_named_without_a_traceback(self):
        ended = subprocess.run([ROOT / "scripts/start", "--run-dir", "/dev/full"], capture_output=True, text=True, check=False)
        self.assertEqual((ended.returncode, ended.stderr), (1, "start: /dev/full/logs: Not a directory\n"))


if __name__ == "__main__":
    unittest.main()
