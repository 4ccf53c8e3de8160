"""A robot from a URDF for scripts/start --model FILE.urdf: imported once, into a cache."""

import hashlib
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from stack import ROOT, Failure

# Draws shells where the URDF names no mesh; only in a clone, not in an installed copy.
DRAW_ROBOT = ROOT / "data/robots/draw_robot.py"


def data_folder(bin_dir):
    """Where the programs read scenes and robots."""
    return Path(os.environ.get("NAO_REMOTE_DATA") or bin_dir.parent / "share/nao-remote")


def robot_name(urdf):
    """A folder's name from the file's: small letters, digits and underscores."""
    stem = urdf.stem if urdf.stem.lower() not in ("robot", "model", "urdf") else urdf.absolute().parent.name
    return re.sub("[^a-z0-9]+", "_", stem.lower()).strip("_") or "robot"


def cache_of(urdf, data, tool):
    """A folder of the cache: another one for other contents of the file, other data or another import."""
    root = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    digest = hashlib.sha256(urdf.read_bytes())
    for words in (urdf.absolute(), data.absolute(), tool.stat().st_size, tool.stat().st_mtime_ns):
        digest.update(f"{words}\n".encode())
    return root / "nao-remote" / digest.hexdigest()[:16]


def draw_shells(folder, name):
    """Meshes for a robot whose file names none: the app draws nothing else."""
    urdf = folder / f"{name}.urdf"
    if not DRAW_ROBOT.exists() or "<mesh" in urdf.read_text(encoding="utf-8"):
        return
    for words in ([DRAW_ROBOT, "--add-visuals", urdf], [DRAW_ROBOT, urdf, folder / "meshes"]):
        subprocess.run([sys.executable, "-B", *words], check=True, stdout=subprocess.DEVNULL)


def import_model(file, bin_dir):
    """Imports a URDF, and lets the programs that are started read its files beside the installed ones. @return its name"""
    urdf = Path(file)
    if not urdf.is_file():
        raise Failure(f"there is no {urdf}; give --model a robot's name or the path of a URDF")
    tool = bin_dir / "nao-tools"
    data = data_folder(bin_dir)
    name = robot_name(urdf)
    cache = cache_of(urdf, data, tool)
    if not cache.exists():
        print(f"Importing {urdf}: once, for up to two minutes.", flush=True)
        making = cache.with_suffix(f".{os.getpid()}")
        shutil.rmtree(making, ignore_errors=True)
        (making / "robots").mkdir(parents=True)
        for entry in data.iterdir():
            if entry.name != "robots":
                (making / entry.name).symlink_to(entry.absolute())
        for robot in (data / "robots").iterdir():
            if robot.name != name:
                (making / "robots" / robot.name).symlink_to(robot.absolute())
        command = [tool, "robot", "import", urdf, "--name", name, "--folder", making / "robots"]
        try:
            if subprocess.run(command, check=False).returncode != 0:
                raise Failure(f"{urdf} is not imported: see above")
            draw_shells(making / "robots" / name, name)
            making.rename(cache)
        finally:
            shutil.rmtree(making, ignore_errors=True)
    os.environ["NAO_REMOTE_DATA"] = str(cache)
    return name
