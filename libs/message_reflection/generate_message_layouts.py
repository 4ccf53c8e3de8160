#!/usr/bin/python3
"""Writes C++ that lists the fields of every message type, with their comments and enumerations.

Usage: generate_message_layouts.py OUTPUT.cpp FILE.lcm...

lcm-gen's C++ keeps neither names nor comments at run time, but the tools turn messages of any type into
tables, JSON, JSON schemas and plots.
"""

import json
import re
import sys

KINDS = {"int8_t": "kInt8", "int16_t": "kInt16", "int32_t": "kInt32", "int64_t": "kInt64", "float": "kFloat",
         "double": "kDouble", "boolean": "kBoolean", "byte": "kByte", "string": "kString"}
INTEGERS = {"int8_t", "int16_t", "int32_t", "int64_t"}
COMMENT = r"/\*.*?\*/|//[^\n]*"


def plain_text(comments):
    """The text of comments on one line, without comment marks."""
    text = " ".join(comments)
    return " ".join(re.sub(r"/\*\*?|\*/|//|(?m:^\s*\*)", " ", text).split())


def read_constants(path, statement):
    """(type, [(name, value)]) of one `const TYPE NAME = VALUE, ...;`."""
    kind, definitions = re.match(r"\s*const\s+(\w+)\s+(.*);$", statement, re.S).groups()
    constants = []
    for definition in definitions.split(","):
        match = re.match(r"\s*(\w+)\s*=\s*(\S+)\s*$", definition)
        if match is None:
            raise SystemExit(f"{path}: cannot read the constant: {definition.strip()}")
        constants.append((match[1], match[2]))
    return kind, constants


def assign_constants(fields, constants):
    """{field name: [(constant name, value)]}: each integer constant goes to the field of its own type whose
    name, in capitals and followed by "_", is the longest prefix of the constant's name."""
    assigned = {}
    for kind, name, value in constants:
        candidates = [field for field_kind, field, _, _ in fields
                      if field_kind == kind and kind in INTEGERS and name.startswith(field.upper() + "_")]
        if candidates:
            assigned.setdefault(max(candidates, key=len), []).append((name, int(value, 0)))
    return assigned


def read_struct(path):
    """(struct name, comment, [(type, field name, [dimensions], comment)], [(type, constant name, value)])
    of one .lcm file."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    head, name, body = re.search(r"package\s+\w+;(.*)struct\s+(\w+)\s*\{(.*)\}", text, re.S).groups()
    fields, constants, comments, shared = [], [], [], []
    # A comment stands above the fields that it explains: all up to an empty line or the next comment.
    for token in re.findall(COMMENT + r"|[^;/]+;", body, re.S):
        if token.startswith("/"):
            comments.append(token)
            continue
        if re.match(r"\s*const\s", token):
            kind, definitions = read_constants(path, token)
            constants += [(kind, *definition) for definition in definitions]
            comments = []
            continue
        match = re.match(r"\s*([\w.]+)\s+(\w+)\s*((?:\[\w+\]\s*)*);$", token)
        if match is None:
            raise SystemExit(f"{path}: cannot read the field: {token.strip()}")
        if comments or re.match(r"\s*\n\s*\n", token):
            shared = comments
        fields.append((match[1], match[2], re.findall(r"\[(\w+)\]", match[3]), plain_text(shared)))
        comments = []
    return name, plain_text(re.findall(COMMENT, head, re.S)), fields, constants


def write_fields(out, message, fields, constants):
    """The tables of one message's enumerations, and of its fields."""
    assigned = assign_constants(fields, constants)
    for field, values in assigned.items():
        rows = ", ".join(f"{{{json.dumps(name)}, {value}}}" for name, value in values)
        out.write(f"constexpr ConstantRow kConstants_{message}_{field}[] = {{{rows}}};\n")
    out.write(f"constexpr FieldRow kFields_{message}[] = {{\n")
    for kind, field, dimensions, description in fields:
        named_values = f"kConstants_{message}_{field}" if field in assigned else "{}"
        out.write(f"    {{FieldKind::{KINDS.get(kind, 'kStruct')}, {json.dumps(kind)}, {json.dumps(field)}, "
                  f"{json.dumps(' '.join(dimensions))}, {json.dumps(description)}, {named_values}}},\n")
    out.write("};\n")


def main():
    output, paths = sys.argv[1], sorted(sys.argv[2:])
    with open(output, "w", encoding="utf-8") as out:
        out.write("// Written by generate_message_layouts.py.\n"
                  '#include "message_reflection/layout_table.h"\n\nnamespace nao {\nnamespace {\n\n')
        messages = []
        for path in paths:
            name, comment, fields, constants = read_struct(path)
            write_fields(out, name, fields, constants)
            messages.append(f"    {{{json.dumps(name)}, {json.dumps(comment)}, kFields_{name}}},\n")
        out.write("\nconstexpr MessageRow kMessages[] = {\n" + "".join(messages) + "};\n\n}  // namespace\n\n"
                  "std::span<const MessageRow> layout_table() { return kMessages; }\n\n}  // namespace nao\n")


main()
