"""Lets a test import the package nao_remote of the build folder, and what the gateway's tests share.

NAO_BIN_DIR (set by CTest) is the folder of the programs.
"""

import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[4]
BIN_DIR = Path(os.environ.get("NAO_BIN_DIR", ROOT / "build/dev/bin"))
PACKAGE_DIR = BIN_DIR.parent / "python"
sys.path[:0] = [str(PACKAGE_DIR), str(ROOT / "test/phone-gateway")]
# For programs that a test starts.
os.environ["PYTHONPATH"] = str(PACKAGE_DIR)
