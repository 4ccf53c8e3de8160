"""The messages of remote.proto as Python classes, generated when this module is imported.

Needs Debian's packages protobuf-compiler and python3-protobuf, nothing else.
"""

import importlib.util
import subprocess
import sys
import tempfile
from pathlib import Path

PROTO = Path(__file__).resolve().parents[2] / "protocol" / "remote.proto"


def _generate():
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["protoc", f"--proto_path={PROTO.parent}", f"--python_out={folder}", PROTO.name], check=True)
        spec = importlib.util.spec_from_file_location("remote_pb2", Path(folder) / "remote_pb2.py")
        module = importlib.util.module_from_spec(spec)
        sys.modules["remote_pb2"] = module
        spec.loader.exec_module(module)
        return module


remote_pb2 = _generate()
