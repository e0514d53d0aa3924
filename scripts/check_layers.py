#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Enfilade authors
# SPDX-License-Identifier: Apache-2.0
"""Checks that data flows one way: usage check_layers.py ROOT

Fails when a module lists in USES a module that does not stand before it in ENFILADE_MODULES, when a
file includes a header of a module that its own module does not list, when library code includes
synthetic (for tests, benchmarks and the program only), or when anything includes apps/.
"""
import pathlib
import re
import sys

INCLUDE = re.compile(r'\s*#\s*include\s+[<"](?:enfilade|src)/(\w+)/')
APP_INCLUDE = re.compile(r'\s*#\s*include\s+[<"]apps/')
KEYS = {"NAME", "HEADERS", "SOURCES", "USES", "PUBLIC_LIBS", "PRIVATE_LIBS"}


def parse_modules(root):
    """Module order, and module -> set of modules that it lists in USES."""
    text = (root / "cmake/EnfiladeModule.cmake").read_text()
    order = re.search(r"set\(ENFILADE_MODULES(.*?)\)", text, re.S)[1].split()
    uses = {}
    for path in sorted(root.glob("src/*/CMakeLists.txt")):
        body = re.search(r"enfilade_add_module\((.*?)\)", path.read_text(), re.S)
        if not body:
            continue
        key, lists = None, {}
        for word in body[1].split():
            if word in KEYS:
                key = word
                lists[key] = []
            else:
                lists[key].append(word)
        uses[lists["NAME"][0]] = set(lists.get("USES", []))
    return order, uses


def check(root):
    order, uses = parse_modules(root)
    problems = []
    for module, used in sorted(uses.items()):
        if module not in order:
            problems.append(f"{module} is not in ENFILADE_MODULES")
            continue
        for other in sorted(used):
            if other not in order or order.index(other) >= order.index(module):
                problems.append(f"src/{module}/CMakeLists.txt: {module} may not use {other}, which does not stand before it")
        if "synthetic" in used and module != "pipeline":
            problems.append(f"src/{module}/CMakeLists.txt: {module} may not use synthetic")
        files = [*root.glob(f"src/{module}/**/*"), *root.glob(f"include/enfilade/{module}/**/*")]
        for path in sorted(f for f in files if f.suffix in (".h", ".cc")):
            for number, line in enumerate(path.read_text().splitlines(), 1):
                hit = INCLUDE.match(line)
                if hit and hit[1] not in used | {module}:
                    problems.append(f"{path.relative_to(root)}:{number}: {module} may not include {hit[1]}")
                if APP_INCLUDE.match(line):
                    problems.append(f"{path.relative_to(root)}:{number}: {module} may not include apps")
    return len(uses), problems


def main():
    num_modules, problems = check(pathlib.Path(sys.argv[1]))
    print("\n".join(problems) or f"{num_modules} modules, no forbidden include")
    sys.exit(bool(problems))


if __name__ == "__main__":
    main()
