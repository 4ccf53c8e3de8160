#!/usr/bin/python3
"""Writes C++ that lists every number of every message by name.

Usage: generate_fields.py OUTPUT.cpp FILE.lcm...

lcm-gen's C++ keeps no names at run time, but the viewer plots any field that a person picks. A list
whose length is shared by a list of names is labelled by it: joint_position[HeadYaw].
"""

import re
import sys

NUMBERS = {"double", "float", "int8_t", "int16_t", "int32_t", "int64_t", "boolean"}


def read_struct(path):
    """(struct name, [(type, field name, [dimensions])]) of one .lcm file."""
    with open(path, encoding="utf-8") as file:
        text = re.sub(r"/\*.*?\*/|//[^\n]*", "", file.read(), flags=re.S)
    name, body = re.search(r"struct\s+(\w+)\s*\{(.*)\}", text, re.S).groups()
    fields = []
    for statement in body.split(";"):
        match = re.match(r"\s*(\w[\w.]*)\s+(\w+)\s*((?:\[\w+\]\s*)*)$", statement)
        if match and match[1] != "const":
            fields.append((match[1], match[2], re.findall(r"\[(\w+)\]", match[3])))
    return name, fields


def write_visit(name, fields, structs, out):
    labels = {dims[0]: field for kind, field, dims in fields if kind == "string" and len(dims) == 1}
    out.write(f"void visit(const naolcm::{name}& m, const std::string& prefix, "
              "const FieldVisitor& v) {\n")
    for kind, field, dims in fields:
        if kind not in NUMBERS and kind not in structs:
            continue  # strings and bytes have no curve
        access, label, indent = f"m.{field}", f'prefix + "{field}"', "  "
        for depth, dim in enumerate(dims):
            index = "ij"[depth]
            length = dim if dim.isdigit() else f"m.{dim}"
            out.write(f"{indent}for (int {index} = 0; {index} < {length}; ++{index}) {{\n")
            access += f"[{index}]"
            if dim in labels and depth == 0:
                label += f' + "[" + m.{labels[dim]}[{index}] + "]"'
            else:
                label += f' + "[" + std::to_string({index}) + "]"'
            indent += "  "
        if kind in structs:
            out.write(f'{indent}visit({access}, {label} + ".", v);\n')
        else:
            out.write(f"{indent}v({label}, static_cast<double>({access}));\n")
        for _ in dims:
            indent = indent[2:]
            out.write(f"{indent}}}\n")
    out.write("  (void)m;\n  (void)prefix;\n  (void)v;\n}\n\n")


def main():
    output, paths = sys.argv[1], sorted(sys.argv[2:])
    structs = dict(read_struct(path) for path in paths)
    with open(output, "w", encoding="utf-8") as out:
        out.write('// Written by generate_fields.py.\n#include "viewer/message_fields.h"\n\n')
        for name in structs:
            out.write(f"#include <naolcm/{name}.hpp>\n")
        out.write("\nnamespace nao {\nnamespace {\n\n")
        for name in structs:
            out.write(f"void visit(const naolcm::{name}& m, const std::string& prefix, "
                      "const FieldVisitor& v);\n")
        out.write("\n")
        for name, fields in structs.items():
            write_visit(name, fields, structs, out)
        out.write("template <class Message>\nbool try_visit(const uint8_t* data, int num_bytes, "
                  "const FieldVisitor& v) {\n  Message message;\n"
                  "  if (message.decode(data, 0, num_bytes) < 0) return false;\n"
                  '  visit(message, "", v);\n  return true;\n}\n\n}  // namespace\n\n')
        out.write("bool visit_fields(const uint8_t* data, int num_bytes, const FieldVisitor& v) {\n"
                  "  return")
        out.write(" ||\n         ".join(
            f" try_visit<naolcm::{name}>(data, num_bytes, v)" for name in structs))
        out.write(";\n}\n\n}  // namespace nao\n")


main()
