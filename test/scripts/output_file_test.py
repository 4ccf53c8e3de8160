#!/usr/bin/python3
"""A result file of a script appears whole or not at all."""

import os
import re
import resource
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from output_file import replace_file  # noqa: E402


class OutputFile(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.file = self.folder / "result"

    def test_an_error_keeps_the_old_file_and_leaves_no_other(self):
        replace_file(self.file, "old")
        limit = resource.getrlimit(resource.RLIMIT_FSIZE)
        handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        try:
            resource.setrlimit(resource.RLIMIT_FSIZE, (1000, limit[1]))
            with self.assertRaises(OSError):
                replace_file(self.file, "x" * 10000)
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, limit)
            signal.signal(signal.SIGXFSZ, handler)
        self.assertEqual(self.file.read_text(), "old")
        self.assertEqual(os.listdir(self.folder), ["result"])

    def test_an_error_while_writing_names_the_file(self):
        file = self.folder / "file"
        code = f"import sys; sys.path.insert(0, {str(ROOT / 'scripts')!r}); import stack, output_file; " \
               f"stack.run_script(lambda: output_file.replace_file({str(file)!r}, 'x' * 1000))"
        ended = subprocess.run(["prlimit", "--fsize=100", "sh", "-c", "trap '' XFSZ; exec \"$@\"", "sh", sys.executable, "-B", "-c", code],
                               capture_output=True, text=True, check=False)
        self.assertEqual(ended.returncode, 1)
        self.assertIn(f"{file}: File too large", ended.stderr)

    def test_links_and_permissions_stay(self):
        replace_file(self.file, b"old", 0o600)
        link = self.folder / "link"
        link.symlink_to("result")
        replace_file(link, "new")
        self.assertTrue(link.is_symlink())
        self.assertEqual(self.file.read_text(), "new")
        self.assertEqual(self.file.stat().st_mode & 0o777, 0o600)

    def test_every_tool_uses_it(self):
        """Streams that grow (logs), locks, files of the kernel, generated sources and examples for users' programs are not results."""
        direct = {"*.py": r"write_text\(|write_bytes\(|open\([^)]*, \"w", "*.cpp": r"ofstream|fopen\([^)]*\"w|imwrite\("}
        allowed = {
            "libs/message_reflection/generate_message_layouts.py", "phone-gateway/clients/python/examples/teach_and_replay.py",
            "phone-gateway/clients/python/nao_remote/messages.py", "scripts/output_file.py", "scripts/start.py",
            "daemons/referee/referee_daemon.cpp", "tools/nao-tools/log_writer.cpp", "scripts/bench_small.py", "tools/bench/emulated_link.cpp", "libs/common/output_file.cpp",
        }
        found = set()
        for pattern, direct_writing in direct.items():
            files = subprocess.run(["git", "-C", ROOT, "ls-files", pattern, *(["scripts"] if pattern == "*.py" else [])],
                                   check=True, stdout=subprocess.PIPE, text=True).stdout.splitlines()
            found |= {name for name in files if not name.startswith("test/") and (ROOT / name).is_file()
                      and re.search(direct_writing, (ROOT / name).read_text())}
        self.assertLessEqual(found, allowed)


if __name__ == "__main__":
    unittest.main()
