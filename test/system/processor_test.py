#!/usr/bin/python3
"""The programs run on the processor of a real robot: x86-64-v2, without AVX."""

import json
import shutil
import signal
import struct
import tempfile
import unittest
from pathlib import Path

from stack import BIN_DIR, run

QEMU = shutil.which("qemu-x86_64")
# Like the robot's Silvermont: SSE4.2, no AVX.
PROCESSOR = "Nehalem"


def tiny_program(code):
    """A Linux program, ELF, that executes this machine code."""
    base, headers = 0x400000, 64 + 56
    header = struct.pack("<16sHHIQQQIHHHHHH", b"\x7fELF\x02\x01\x01", 2, 62, 1, base + headers, 64, 0, 0, 64, 56, 1, 0, 0, 0)
    segment = struct.pack("<IIQQQQQQ", 1, 5, 0, base, base, headers + len(code), headers + len(code), 0x1000)
    return header + segment + code


class Processor(unittest.TestCase):
    def emulated(self, *command):
        return run([QEMU, "-cpu", PROCESSOR, *command])

    def test_nothing_is_compiled_for_another_processor(self):
        commands = BIN_DIR.parent / "compile_commands.json"
        if not commands.exists():
            self.skipTest(f"no {commands}")
        for entry in json.loads(commands.read_text()):
            words = entry["command"].split()
            for word in words:
                self.assertFalse(word.startswith(("-march", "-mavx", "-mfma", "-mcpu", "-mtune")), f"{entry['file']}: {word}")

    @unittest.skipUnless(QEMU, "no qemu-x86_64: scripts/setup --with test")
    def test_the_emulated_processor_has_no_avx(self):
        exit_0 = bytes.fromhex("b83c000000 31ff 0f05")  # mov eax, 60; xor edi, edi; syscall
        for name, code, status in (("sse", bytes.fromhex("0f57c0"), 0), ("avx", bytes.fromhex("c5f857c0"), -signal.SIGILL)):
            with self.subTest(name), tempfile.TemporaryDirectory(prefix="nao-") as folder:
                program = Path(folder) / name
                program.write_bytes(tiny_program(code + exit_0))
                program.chmod(0o755)
                self.assertEqual(self.emulated(program).returncode, status)

    @unittest.skipUnless(QEMU, "no qemu-x86_64: scripts/setup --with test")
    def test_every_program_starts(self):
        # nao-bare-sender is the baseline that nao-bench-gateway starts; it has no --help.
        programs = sorted(file for file in BIN_DIR.glob("nao*") if "_" not in file.name and file.name != "nao-bare-sender")
        self.assertIn(BIN_DIR / "nao-robot", programs)
        for program in programs:
            with self.subTest(program.name):
                result = self.emulated(program, "--help")
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertIn("Usage", result.stdout)

    @unittest.skipUnless(QEMU, "no qemu-x86_64: scripts/setup --with test")
    def test_the_walk_is_computed(self):
        result = self.emulated(BIN_DIR / "nao-trial", "walk", "--vx", "0.1", "--duration", "3", "--seeds", "1")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("1 of 1 succeeded", result.stdout)


if __name__ == "__main__":
    unittest.main()
