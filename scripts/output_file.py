"""Result files that appear whole or not at all."""

import os
from pathlib import Path


def replace_file(path, content, mode=0o666):
    """Writes text or bytes beside the file as FILE.part, flushes them to the disk and renames; an error leaves the old file.
    A device or pipe is written directly. mode: permissions of a new file, before the umask."""
    path = Path(os.path.realpath(path))
    content = content.encode() if isinstance(content, str) else content
    if path.exists() and not path.is_file():
        path.write_bytes(content)
        return
    if path.exists():
        mode &= path.stat().st_mode
    part = path.with_name(path.name + ".part")
    part.unlink(missing_ok=True)
    try:
        with os.fdopen(os.open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL, mode), "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        part.replace(path)
    except BaseException as error:
        part.unlink(missing_ok=True)
        if isinstance(error, OSError):
            error.filename = error.filename or str(path)
        raise
