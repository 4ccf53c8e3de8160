#!/usr/bin/python3
"""Writes C++ that lists the fields of every message, with what their comments say.

Usage: generate_message_layouts.py OUTPUT.cpp FILE.lcm...

lcm-gen's C++ keeps neither names nor comments at run time, but `nao log` turns messages of any type into
tables, JSON and JSON schemas.
"""

import json
import re
import sys

KINDS = {"int8_t": "kInt8", "int16_t": "kInt16", "int32_t": "kInt32", "int64_t": "kInt64", "float": "kFloat",
         "double": "kDouble", "boolean": "kBoolean", "byte": "kByte", "string": "kString"}
COMMENT = r"/\*.*?\*/|//[^\n]*"


def words_of(comments):
    """The text of some comments on one line, without their marks."""
    text = " ".join(comments)
    return " ".join(re.sub(r"/\*\*?|\*/|//|(?m:^\s*\*)", " ", text).split())


def read_struct(path):
    """(struct name, comment, [(type, field name, [dimensions], comment)]) of one .lcm file."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    head, name, body = re.search(r"package\s+\w+;(.*)struct\s+(\w+)\s*\{(.*)\}", text, re.S).groups()
    fields = []
    comments = []
    # A comment stands above the field that it explains.
    for token in re.findall(COMMENT + r"|[^;/]+;", body, re.S):
        if token.startswith("/"):
            comments.append(token)
            continue
        match = re.match(r"\s*([\w.]+)\s+(\w+)\s*((?:\[\w+\]\s*)*);$", token)
        if match is None:
            raise SystemExit(f"{path}: cannot read: {token.strip()}")
        fields.append((match[1], match[2], re.findall(r"\[(\w+)\]", match[3]), words_of(comments)))
        comments = []
    return name, words_of(re.findall(COMMENT, head, re.S)), fields


def main():
    output, paths = sys.argv[1], sorted(sys.argv[2:])
    with open(output, "w", encoding="utf-8") as out:
        out.write('// Written by generate_message_layouts.py.\n#include "tools/nao/message_layout.h"\n\n'
                  "namespace nao {\n\nconst std::vector<MessageLayout>& message_layouts() {\n"
                  "  static const std::vector<MessageLayout> kLayouts{\n")
        for name, comment, fields in map(read_struct, paths):
            out.write(f"      {{{json.dumps(name)}, {json.dumps(comment)},\n       {{\n")
            for kind, field, dimensions, words in fields:
                out.write(f"           {{FieldKind::{KINDS.get(kind, 'kStruct')}, {json.dumps(kind)}, "
                          f"{json.dumps(field)}, {{{', '.join(map(json.dumps, dimensions))}}}, "
                          f"{json.dumps(words)}}},\n")
            out.write("       }},\n")
        out.write("  };\n  return kLayouts;\n}\n\n}  // namespace nao\n")


main()
