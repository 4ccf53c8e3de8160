#!/usr/bin/python3
"""The package is installed by its README, without a network: from its sources, and from the wheel and the source archive."""

import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
import venv
from pathlib import Path

from built_package import ROOT

SOURCES = ROOT / "phone-gateway/clients/python"
# What an installed package must do without the repository.
USE = "import nao_remote, nao_remote.remote_pb2, nao_remote.simulation; print(nao_remote.__version__, nao_remote.Address.parse('nao.local').port)"


def run(*command, **options):
    """Runs a command that must succeed, without this build's package. @return its output."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    result = subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                            check=False, env=environment, **options)
    if result.returncode != 0:
        raise AssertionError(f"{command}: {result.returncode}\n{result.stdout}{result.stderr}")
    return result.stdout


class Package(unittest.TestCase):
    def setUp(self):
        for module in ("setuptools", "wheel", "ensurepip"):
            if importlib.util.find_spec(module) is None:
                self.skipTest(f"python module {module} is missing (Debian: python3-setuptools, python3-wheel, python3-venv)")
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        # Builds write into the sources' folder.
        self.sources = self.folder / "repository/phone-gateway/clients/python"
        shutil.copytree(SOURCES, self.sources, ignore=shutil.ignore_patterns("build", "dist", "*.egg-info", "__pycache__"))
        for proto in ("phone-gateway/protocol/remote.proto", "tools/simulation-server/simulation.proto"):
            (self.folder / "repository" / proto).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / proto, self.folder / "repository" / proto)

    def install(self, *packages):
        """Installs each into a virtual environment, and uses it there."""
        environment = self.folder / "venv"
        venv.create(environment, system_site_packages=True, with_pip=True)
        for package in packages:
            run(environment / "bin/pip", "install", "--no-build-isolation", "--no-index", "--force-reinstall", "--no-deps", package)
            self.assertEqual(run(environment / "bin/python", "-c", USE, cwd=self.folder), "0.1.0 8080\n")

    def test_it_is_installed_from_its_sources(self):
        self.install(self.sources)

    def test_wheel_and_source_archive_are_complete(self):
        if importlib.util.find_spec("build") is None:
            self.skipTest("python module build is missing (Debian: python3-build)")
        run(sys.executable, "-m", "build", "--no-isolation", "--outdir", self.folder / "dist", self.sources)
        wheel, = (self.folder / "dist").glob("*-py3-none-any.whl")
        archive, = (self.folder / "dist").glob("*.tar.gz")
        shutil.rmtree(self.folder / "repository")
        self.install(wheel, archive)


if __name__ == "__main__":
    unittest.main()
