#!/usr/bin/python3
"""Makes the complete files of a robot that is described by its differences from another robot.

The folder of such a robot has a robot.yaml with the line "extends: BASE". A file that only one of both folders has is
taken as it is. Of YAML files with the same name, each section (a key at the beginning of a line, with the comments
directly above it) of the robot's own file replaces the base's. Of URDF files with the same name, each part (inertial,
visual, collision, origin, limit ...) of the robot's own links and joints replaces those of the same kind in the base's.
Only the standard library is used."""

import argparse
import re
import shutil
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
from output_file import replace_file  # noqa: E402

# Files of a robot that programs read; the same as data/robots/CMakeLists.txt copies.
PATTERNS = ("*.urdf", "*.yaml", "actions/*.yaml")


class DeriveError(Exception):
    """Its text says what is wrong, where, and what to do."""


def sections(text):
    """Splits the text of a YAML file. @return the head before the first section, and a dictionary of key to text."""
    head, found, key = [], {}, None
    comments = []  # directly above the next key
    for line in text.splitlines(keepends=True):
        match = re.match(r"([A-Za-z_]\w*):", line)
        if match:
            key = match[1]
            if key in found:
                raise DeriveError(f"the section '{key}' is there twice; remove one")
            found[key] = [*comments, line]
            comments = []
        elif line.startswith("#"):
            comments.append(line)
        else:
            (found[key] if key else head).extend([*comments, line])
            comments = []
    (found[key] if key else head).extend(comments)
    return "".join(head), {key: "".join(lines) for key, lines in found.items()}


def merge_yaml(base, own):
    """Text of the base's file with the sections of the own one."""
    head, merged = sections(base)
    own_sections = sections(own)[1]
    own_sections.pop("extends", None)
    for key, text in own_sections.items():
        # As far from the next section as the base's was.
        merged[key] = text.rstrip("\n") + "\n" * max(1, len(merged.get(key, "\n")) - len(merged.get(key, "").rstrip("\n")))
    return head + "".join(merged.values())


def merge_urdf(base, own):
    """Text of the base's URDF with the parts of the own one."""
    def read(text):
        return ET.fromstring(text, ET.XMLParser(target=ET.TreeBuilder(insert_comments=True)))

    robot, changes = read(base), read(own)
    robot.set("name", changes.get("name"))
    for change in changes:
        if not isinstance(change.tag, str):  # a comment
            continue
        found = [element for element in robot if element.tag == change.tag and element.get("name") == change.get("name")]
        if not found:
            raise DeriveError(f"the base has no {change.tag} '{change.get('name')}'; there only can be changes")
        element = found[0]
        parts = [part for part in change if isinstance(part.tag, str)]
        for old in [old for old in element if old.tag in {part.tag for part in parts}]:
            element.remove(old)
        for index, part in enumerate(parts):
            element.insert(index, part)
    ET.indent(robot)
    return '<?xml version="1.0"?>\n' + ET.tostring(robot, encoding="unicode") + "\n"


def files_of(folder):
    """Names of a robot's files, relative to its folder."""
    return sorted(str(file.relative_to(folder)) for pattern in PATTERNS for file in folder.glob(pattern))


def derive(base, own, output):
    """Writes the complete files. @param base, own, output  Folders."""
    base_files, own_files = files_of(base), files_of(own)
    for name in sorted({*base_files, *own_files}):
        target = output / name
        target.parent.mkdir(parents=True, exist_ok=True)
        if name not in own_files:
            shutil.copyfile(base / name, target)
        elif name not in base_files:
            shutil.copyfile(own / name, target)
        else:
            merge = merge_urdf if name.endswith(".urdf") else merge_yaml
            try:
                text = merge((base / name).read_text(), (own / name).read_text())
            except (DeriveError, ET.ParseError) as error:
                raise DeriveError(f"{own / name}: {error}") from error
            replace_file(target, text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("base", type=Path, help="folder of the other robot")
    parser.add_argument("own", type=Path, help="folder of the differences")
    parser.add_argument("output", type=Path, help="folder for the complete files")
    options = parser.parse_args()
    try:
        derive(options.base, options.own, options.output)
    except DeriveError as error:
        print(f"derive.py: {error}", file=sys.stderr)
        sys.exit(1)


if __name__ == "__main__":
    main()
