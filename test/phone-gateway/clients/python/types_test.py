#!/usr/bin/python3
"""The package has no error of types, checked strictly by Debian's mypy; skipped without it."""

import importlib.util
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from built_package import ROOT

import nao_remote


class Types(unittest.TestCase):
    def test_mypy_strict_is_clean(self):
        if importlib.util.find_spec("mypy") is None:
            self.skipTest("mypy is missing (Debian: mypy)")
        # The folder with the generated classes, not the sources.
        folder = Path(nao_remote.__path__[0]).parent
        with tempfile.TemporaryDirectory() as cache:
            result = subprocess.run(
                [sys.executable, "-m", "mypy", "--cache-dir", cache, "--config-file",
                 str(ROOT / "phone-gateway/clients/python/pyproject.toml"), "--package", "nao_remote"],
                cwd=folder, capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)


if __name__ == "__main__":
    unittest.main()
