#!/usr/bin/env python3
"""Turns the contract from YAML into JSON, inside a C++ source that defines coppice::openapi_json().

usage: embed_openapi.py OPENAPI_YAML OUT_CPP
"""
import json
import sys

import yaml


class Strict(yaml.SafeLoader):
    """YAML as JSON understands it: no key twice, and keys are text (YAML reads 200 as a number)."""

    def construct_mapping(self, node, deep=False):
        seen = set()
        for key, _ in node.value:
            if key.tag != "tag:yaml.org,2002:str":
                raise SystemExit(f"line {key.start_mark.line + 1}: {key.value} is not text; quote it")
            if key.value in seen:
                raise SystemExit(f"line {key.start_mark.line + 1}: {key.value} is there twice")
            seen.add(key.value)
        return super().construct_mapping(node, deep)


def main(source, target):
    with open(source, encoding="utf-8") as file:
        document = yaml.load(file, Loader=Strict)
    text = json.dumps(document, ensure_ascii=False, separators=(",", ":"))
    delimiter = "openapi"
    assert f"){delimiter}\"" not in text
    # Compilers must take literals of 65536 characters, and no more.
    pieces = [text[i:i + 16000] for i in range(0, len(text), 16000)]
    with open(target, "w", encoding="utf-8") as file:
        file.write('#include "proto/openapi.h"\n\nnamespace coppice {\n\n')
        file.write("std::string_view openapi_json() {\n    return\n")
        file.write("\n".join(f'        R"{delimiter}({piece}){delimiter}"' for piece in pieces))
        file.write(";\n}\n\n}  // namespace coppice\n")


main(*sys.argv[1:])
