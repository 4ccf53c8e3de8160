"""Generates the classes of the protocols from the .proto files when the package is built."""

import shutil
import subprocess
from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py
from setuptools.command.sdist import sdist

HERE = Path(__file__).resolve().parent
# In the repository, or beside this file in a source archive.
PROTOS = ["phone-gateway/protocol/remote.proto", "tools/simulation-server/simulation.proto"]


def find(proto):
    for candidate in (HERE / "protocols" / Path(proto).name, *(folder / proto for folder in HERE.parents)):
        if candidate.is_file():
            return candidate
    raise SystemExit(f"{proto} is missing: build from the repository or from a source archive")


class BuildWithProtocols(build_py):
    def run(self):
        super().run()
        if self.editable_mode:
            raise SystemExit("editable installations are not supported; use the build folder's python/ instead")
        target = Path(self.build_lib) / "nao_remote"
        for proto in map(find, PROTOS):
            try:
                subprocess.run(["protoc", f"--python_out={target}", f"--pyi_out={target}", f"--proto_path={proto.parent}",
                                str(proto)], check=True)
            except FileNotFoundError:
                raise SystemExit("protoc is missing (Debian: protobuf-compiler)") from None


class SourceArchiveWithProtocols(sdist):
    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, files)
        folder = Path(base_dir) / "protocols"
        folder.mkdir(exist_ok=True)
        for proto in map(find, PROTOS):
            shutil.copy(proto, folder)


setup(cmdclass={"build_py": BuildWithProtocols, "sdist": SourceArchiveWithProtocols})
