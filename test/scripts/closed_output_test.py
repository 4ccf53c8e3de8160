#!/usr/bin/python3
"""A script whose reader ends, as in scripts/status | head, ends without a traceback."""

import os
import signal
import subprocess
import sys
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


if __name__ == "__main__":
    unittest.main()
