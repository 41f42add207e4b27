#!/usr/bin/env python3
"""Every label finds a test, and every test has a label that CONTRIBUTING.md explains.

usage: labels.py ROOT BUILD CTEST
"""
import json
import pathlib
import re
import subprocess
import sys


def main(root, listing):
    explained = set(re.findall(r"^\| `(\w+)` \|", (pathlib.Path(root) / "CONTRIBUTING.md").read_text(), re.M))
    used, faults = set(), []
    for test in listing["tests"]:
        labels = {
            label
            for entry in test.get("properties", [])
            if entry["name"] == "LABELS"
            for label in entry["value"]
        }
        used |= labels
        if not labels & explained:
            faults.append(f"the test {test['name']} has no label that CONTRIBUTING.md explains")
    faults += [f"the label {label} is explained in CONTRIBUTING.md, and finds no test" for label in explained - used]
    faults += [f"the label {label} is not explained in CONTRIBUTING.md" for label in used - explained]
    if not explained:
        faults.append("CONTRIBUTING.md explains no label")
    print("\n".join(sorted(faults)) or f"{len(listing['tests'])} tests, {len(used)} labels")
    return 1 if faults else 0


if __name__ == "__main__":
    shown = subprocess.run(
        [sys.argv[3], "--test-dir", sys.argv[2], "--show-only=json-v1"], capture_output=True, text=True, check=True
    )
    sys.exit(main(sys.argv[1], json.loads(shown.stdout)))
