#!/usr/bin/env python3
"""Runs clang-tidy on the sources that changed, or on all of them.

usage: clang_tidy.py ROOT BUILD [--all]

"Changed" is what differs from the place where this branch left origin/main; on main itself, from the commit before.
Sources that passed are remembered by the content of everything they include, and are not looked at again.
"""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys

SKIPPED = 77
FOLDERS = ("core/", "proto/", "server/", "cli/", "tests/", "bench/", "fuzz/")


def run(*command, cwd=None):
    done = subprocess.run(command, cwd=cwd, capture_output=True, text=True, check=False)
    return done.stdout if done.returncode == 0 else ""


def lines(text):
    return [line for line in text.splitlines() if line]


def changed_files(root):
    head = run("git", "rev-parse", "HEAD", cwd=root).strip()
    base = run("git", "merge-base", "HEAD", "origin/main", cwd=root).strip()
    if not base or base == head:
        base = run("git", "rev-parse", "--verify", "--quiet", "HEAD~1", cwd=root).strip()
    # Without a base (the first commit, a shallow clone) only what is not committed counts.
    committed = lines(run("git", "diff", "--name-only", base or "HEAD", cwd=root))
    untracked = lines(run("git", "ls-files", "--others", "--exclude-standard", cwd=root))
    return set(committed + untracked)


def dependencies(root, build):
    """Object file -> the files of this repository that went into it, as ninja recorded them."""
    found, current = {}, None
    for line in run("ninja", "-C", str(build), "-t", "deps").splitlines():
        if line and not line[0].isspace():
            current = found.setdefault(line.split(":")[0], [])
        elif line.strip() and current is not None:
            path = os.path.normpath(os.path.join(build, line.strip()))
            if path.startswith(str(root) + os.sep) and not path.startswith(str(build) + os.sep):
                current.append(path)
    return found


def key_of(root, command, paths):
    digest = hashlib.sha256((root / ".clang-tidy").read_bytes() + command.encode())
    for path in sorted(set(paths)):
        digest.update(path.encode() + b"\0" + pathlib.Path(path).read_bytes())
    return digest.hexdigest()


def without_precompiled_headers(command):
    """g++'s precompiled headers are nothing that clang could read, and every source must do without them."""
    return re.sub(r" -Winvalid-pch| -fpch-preprocess| -include \S+/cmake_pch\.hxx", "", command)


def check(database, source):
    done = subprocess.run(
        # g++ knows warnings that clang does not, and clang finds g++'s command line otherwise fit
        ["clang-tidy", "-p", str(database), "--quiet", "--extra-arg=-Wno-unknown-warning-option",
         "--extra-arg=-Wno-ignored-optimization-argument", source],
        capture_output=True, text=True, check=False,
    )
    # The count of what was suppressed in system headers says nothing.
    return done.returncode, done.stdout + re.sub(r"(?m)^\d+ warnings? generated\.\n", "", done.stderr)


def main(root, build, everything):
    version = re.search(r"version (\d+)", run("clang-tidy", "--version"))
    if not version or version.group(1) != "14":
        print(f"skipped: .clang-tidy is for clang-tidy 14, and this machine has {version and version.group(1)}")
        return SKIPPED
    changed = changed_files(root)
    depends = dependencies(root, build)
    passed_before = build / "clang-tidy"
    passed_before.mkdir(exist_ok=True)
    todo = []
    entries = json.loads((build / "compile_commands.json").read_text())
    for entry in entries:
        entry["command"] = without_precompiled_headers(entry["command"])
    (passed_before / "compile_commands.json").write_text(json.dumps(entries))
    for entry in entries:
        source = os.path.normpath(os.path.join(entry["directory"], entry["file"]))
        name = os.path.relpath(source, root)
        if not name.startswith(FOLDERS):
            continue
        command = entry["command"]
        output = entry.get("output") or re.search(r" -o (\S+)", command).group(1)
        output = os.path.relpath(os.path.join(entry["directory"], output), build)
        paths = [source] + depends.get(output, [])
        # A changed header is judged through its own .cpp; all that include it would be too many.
        own_header = os.path.splitext(name)[0] + ".h"
        if everything or name in changed or own_header in changed:
            todo.append((name, source, passed_before / key_of(root, command, paths)))
    waiting = sorted(item for item in todo if not item[2].exists())
    print(f"{len(todo)} sources to check, {len(todo) - len(waiting)} of them passed before", flush=True)
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for (name, _, stamp), (code, text) in zip(waiting, pool.map(lambda item: check(passed_before, item[1]), waiting)):
            if code == 0:
                stamp.touch()
            else:
                failed += 1
                print(f"{name}:\n{text}", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(), "--all" in sys.argv))
