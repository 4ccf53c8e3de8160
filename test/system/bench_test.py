#!/usr/bin/python3
"""scripts/bench with fake benchmark programs: its output, errors and document."""

import datetime
import json
import shutil
import tempfile
import unittest
from pathlib import Path

from stack import ROOT, run

PAGE = "# Performance\n\n## Camera\n\nBy hand.\n"


class Bench(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="nao-")
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.page = self.root / "docs/performance.md"
        for name in ("bin", "docs", "scripts"):
            (self.root / name).mkdir()
        for name in ("bench", "output_file.py"):
            shutil.copy(ROOT / "scripts" / name, self.root / "scripts")
        self.page.write_text(PAGE)
        self.put("bus", 35, baseline="UDP", baseline_value=12, ratio=35 / 12)
        self.put("camera", 8.6)

    def put(self, part, value, **baseline):
        """A fake benchmark that reports `value`."""
        figure = {"name": f"{part}.time", "value": value, "unit": "ms", "baseline": None, "baseline_value": None, "ratio": None}
        program = self.root / "bin" / f"nao-bench-{part}"
        program.write_text(f"#!/bin/sh\ncat > \"$2\" <<'END'\n{json.dumps([{**figure, **baseline}])}\nEND\n")
        program.chmod(0o755)

    def bench(self, *arguments):
        return run([self.root / "scripts/bench", "--bin", self.root / "bin", *arguments])

    def document(self, *parts):
        result = self.bench("--document", *(word for part in parts for word in ("--only", part)))
        self.assertEqual(result.returncode, 0, result.stderr)
        return self.page.read_text()

    def test_only_the_named_parts_are_measured(self):
        self.put("gateway", 1)
        result = self.bench("--only", "bus", "--only", "camera", "--json", self.root / "figures.json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual([one["name"] for one in json.loads((self.root / "figures.json").read_text())],
                         ["bus.time", "camera.time"])
        self.assertIn("UDP: 12, ratio 2.92", result.stdout)

    def test_a_part_that_is_not_there_is_refused(self):
        result = self.bench("--only", "buss")
        self.assertEqual(result.returncode, 2)
        self.assertIn("there are: bus, camera, stack, small, viewer, vision, match, build", result.stderr)

    def test_a_part_that_fails_is_named(self):
        (self.root / "bin/nao-bench-bus").write_text("#!/bin/sh\nexit 3\n")
        result = self.bench("--only", "bus")
        self.assertEqual(result.returncode, 1)
        self.assertIn("bus: ", result.stderr)
        self.assertIn("status 3", result.stderr)

    def test_a_figure_that_could_not_be_measured_hides_no_other(self):
        self.put("camera", None, baseline="floor", baseline_value=0, ratio=None)
        result = self.bench("--only", "bus", "--only", "camera")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("UDP: 12, ratio 2.92", result.stdout)
        self.assertRegex(result.stdout, r"camera\.time +- +ms +floor: 0, ratio -\n")

    def test_the_document_keeps_what_was_written_by_hand_and_joins_parts_of_one_run(self):
        first = self.document("bus")
        self.assertTrue(first.startswith(PAGE + "\n## All figures\n"), first)
        both = self.document("camera")
        self.assertTrue(both.startswith(PAGE + "\n## All figures\n"), both)
        today = datetime.date.today()
        self.assertIn(f"| Figure | Unit | {today} | Against |\n", both)
        self.assertIn("| `bus.time` | ms | 35 | UDP: 12, ratio 2.92 |\n", both)
        self.assertIn("| `camera.time` | ms | 8.6 |  |\n", both)

    def test_the_document_remembers_the_last_runs(self):
        today = str(datetime.date.today())
        for day in range(6):
            self.put("bus", 10 + day)
            self.document("bus", *(["camera"] if day == 0 else []))
            self.page.write_text(self.page.read_text().replace(today, f"2026-01-0{day + 1}"))
        page = self.page.read_text()
        self.assertIn("| Figure | Unit | 2026-01-06 | 2026-01-05 | 2026-01-04 | 2026-01-03 | 2026-01-02 | Against |", page)
        self.assertIn("| `bus.time` | ms | 15 | 14 | 13 | 12 | 11 |  |\n", page)
        self.assertNotIn("camera.time", page, "it was last measured six runs ago")


if __name__ == "__main__":
    unittest.main()
