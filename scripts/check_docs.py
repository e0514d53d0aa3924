#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Enfilade authors
# SPDX-License-Identifier: Apache-2.0
"""Checks the documentation: usage check_docs.py ROOT

Fails, naming file and line, when
* a relative link of a Markdown file leads nowhere,
* docs/architecture.md does not name a module, or names a source file that does not exist,
* a header's or source's mention of docs/… leads nowhere.
"""
import pathlib
import re
import sys

LINK = re.compile(r"\[[^\]]*\]\(([^)#\s]+)(?:#[^)]*)?\)")
SOURCE_NAME = re.compile(r"`((?:src|apps|cmake|scripts|tests)/[\w./]+\.(?:cc|h|py|cmake|sh))`")
HEADER_NAME = re.compile(r"`(\w+/\w+\.h)`")
DOC_NAME = re.compile(r"docs/[\w/-]+\.md")
SKIPPED_FOLDERS = {"build", "out", ".git"}


def files(root, *suffixes):
    """Files below `root` with one of the suffixes, without build outputs."""
    for path in sorted(root.rglob("*")):
        if path.suffix in suffixes and not SKIPPED_FOLDERS & set(path.relative_to(root).parts):
            yield path


def dead_links(root):
    for path in files(root, ".md"):
        for number, line in enumerate(path.read_text().splitlines(), 1):
            for target in LINK.findall(line):
                if ":" not in target and not (path.parent / target).exists():
                    yield f"{path.relative_to(root)}:{number}: link to {target}, which does not exist"


def dead_mentions(root):
    for path in files(root, ".h", ".cc"):
        for number, line in enumerate(path.read_text().splitlines(), 1):
            for target in DOC_NAME.findall(line):
                if not (root / target).exists():
                    yield f"{path.relative_to(root)}:{number}: names {target}, which does not exist"


def architecture_problems(root):
    text = (root / "docs/architecture.md").read_text()
    cmake = (root / "cmake/EnfiladeModule.cmake").read_text()
    for module in re.search(r"set\(ENFILADE_MODULES(.*?)\)", cmake, re.S)[1].split():
        if f"| `{module}` |" not in text:
            yield f"docs/architecture.md: the module {module} is missing from the table"
    names = SOURCE_NAME.findall(text) + [f"include/enfilade/{name}" for name in HEADER_NAME.findall(text)]
    for name in names:
        if not (root / name).exists():
            yield f"docs/architecture.md: names {name}, which does not exist"


def main():
    root = pathlib.Path(sys.argv[1])
    problems = [*dead_links(root), *dead_mentions(root), *architecture_problems(root)]
    print("\n".join(problems) or "all links and names lead somewhere")
    sys.exit(bool(problems))


if __name__ == "__main__":
    main()
