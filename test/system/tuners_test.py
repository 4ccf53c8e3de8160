#!/usr/bin/python3
"""The tuners give the same files with any number of threads and processes, and after an interruption."""

import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import unittest

from open_mpi import MPI_ENVIRONMENT
from stack import BIN_DIR

# A search of two generations; every candidate gets up twice.
GET_UP = ["nao-transition-tuner", "--sequence", "get-up-belly", "--start", "belly", "--population", "4",
          "--generations", "2", "--trials", "1", "--disturbances", "default,real"]
WALK = ["nao-walk-tuner", "--population", "4", "--generations", "1", "--courses", "1"]


def has_open_mpi():
    if shutil.which("mpirun") is None:
        return False
    return "libmpi" in subprocess.run(["ldd", BIN_DIR / GET_UP[0]], capture_output=True, text=True, check=False).stdout


class Tuners(unittest.TestCase):
    get_up_result = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def command(self, command, name, *more, mpirun=()):
        return [*mpirun, str(BIN_DIR / command[0]), *command[1:], "--output", str(self.folder / name), *more]

    def files(self, name):
        return (self.folder / name).read_text(), (self.folder / f"{name}.checkpoint").read_text()

    def run_tuner(self, command, name, *more, mpirun=()):
        """Output file and checkpoint."""
        done = subprocess.run(self.command(command, name, *more, mpirun=mpirun), env={**os.environ, **MPI_ENVIRONMENT},
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return self.files(name)

    def get_up_of_one_thread(self):
        """What all tests of GET_UP compare with; computed once."""
        if Tuners.get_up_result is None:
            Tuners.get_up_result = self.run_tuner(GET_UP, "1", "--jobs", "1")
        return Tuners.get_up_result

    def test_get_up_motions_do_not_depend_on_the_number_of_threads(self):
        one = self.get_up_of_one_thread()
        for jobs in ("2", "3"):
            self.assertEqual(self.run_tuner(GET_UP, jobs, "--jobs", jobs), one)

    @unittest.skipUnless(has_open_mpi(), "without Open MPI")
    def test_get_up_motions_do_not_depend_on_the_number_of_processes(self):
        threads = self.get_up_of_one_thread()
        for processes in ("1", "2"):
            self.assertEqual(self.run_tuner(GET_UP, processes, mpirun=["mpirun", "-n", processes]), threads)
        self.assertEqual(self.run_tuner(GET_UP, "both", "--jobs", "2", mpirun=["mpirun", "-n", "2"]), threads)

    @unittest.skipUnless(has_open_mpi(), "without Open MPI")
    def test_the_gait_does_not_depend_on_the_number_of_processes(self):
        self.assertEqual(self.run_tuner(WALK, "processes", mpirun=["mpirun", "-n", "2"]),
                         self.run_tuner(WALK, "threads"))

    @unittest.skipUnless(has_open_mpi(), "without Open MPI")
    def test_a_failure_ends_all_processes(self):
        done = subprocess.run(self.command(GET_UP, "none", "--resume", "/no/such/file", mpirun=["mpirun", "-n", "2"]),
                              env={**os.environ, **MPI_ENVIRONMENT}, capture_output=True, text=True)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn("cannot read /no/such/file", done.stderr)

    def test_an_interrupted_search_goes_on_to_the_same_result(self):
        whole = self.get_up_of_one_thread()
        with subprocess.Popen(self.command(GET_UP, "part"), stdout=subprocess.PIPE, text=True) as process:
            # The search runs, its handler is there: the first generation has been printed.
            first = process.stdout.readline()
            process.send_signal(signal.SIGINT)
            rest = process.stdout.read()
        self.assertEqual(process.returncode, 0)
        self.assertRegex(first, "^generation 1 of 2: ")
        self.assertIn("--resume", rest)
        checkpoint = str(self.folder / "part.checkpoint")
        self.assertEqual(self.run_tuner(GET_UP, "part", "--resume", checkpoint), whole)


if __name__ == "__main__":
    unittest.main()
