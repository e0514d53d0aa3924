#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Enfilade authors
# SPDX-License-Identifier: Apache-2.0
"""Checks that data flows one way: usage check_layers.py ROOT

Fails, naming file, line and module, when
* a module's USES names a module that does not stand before it in ENFILADE_MODULES (so no cycles),
* a module's USES names synthetic, which is for tests, benchmarks and the program only,
* a file includes a header of a module that its own module does not list in USES,
* a file includes private headers of another module, a header of apps/ or tests/, or a path with ..,
* a public header includes anything but the standard library, Eigen, nlohmann/json_fwd.hpp and ours,
* a source in a module's folder is missing from its CMakeLists.txt (it would never be compiled),
* headers of two modules define a type of one name, or a function of one name and one list of types:
  the linker would take one of the two for both.
"""
import pathlib
import re
import sys

INCLUDE = re.compile(r'\s*#\s*include\s+([<"])([^>"]+)[>"]')
PUBLIC_THIRD_PARTY = re.compile(r"[a-z_0-9]+|Eigen/\w+|nlohmann/json_fwd\.hpp")
# A function at namespace scope, as the formatter leaves it: its name and its parameters.
FUNCTION = re.compile(r"^(?=\S)(?!template|using|struct|class|enum|#|\}|public|private)[^;{}()=]*?\b(\w+)\(([^;{}]*?)\)"
                      r"(?: noexcept)?\s*[;{]", re.M)
TYPE = re.compile(r"^(?:class|struct|enum class) (\w+)[^;(){}]*\{", re.M)
KEYS = {"NAME", "HEADERS", "SOURCES", "USES", "PUBLIC_LIBS", "PRIVATE_LIBS"}
TESTING_MODULE = "synthetic"


def strip_comments(cmake):
    return re.sub(r"#.*", "", cmake)


def parse_module(path):
    """Keyword -> words of the enfilade_add_module call in a CMakeLists.txt, or None."""
    body = re.search(r"enfilade_add_module\((.*?)\)", strip_comments(path.read_text()), re.S)
    if not body:
        return None
    key, lists = None, {key: [] for key in KEYS}
    for word in body[1].split():
        if word in KEYS:
            key = word
        else:
            lists[key].append(word)
    return lists


def parse_tree(root):
    """Order of the modules, and module name -> its lists."""
    text = strip_comments((root / "cmake/EnfiladeModule.cmake").read_text())
    order = re.search(r"set\(ENFILADE_MODULES(.*?)\)", text, re.S)[1].split()
    parsed = [parse_module(path) for path in sorted(root.glob("src/*/CMakeLists.txt"))]
    return order, {lists["NAME"][0]: lists for lists in parsed if lists}


def check_uses(module, used, order):
    """Problems of one USES list."""
    if module not in order:
        return [f"src/{module}/CMakeLists.txt: {module} is not in ENFILADE_MODULES"]
    problems = []
    for other in used:
        if other not in order or order.index(other) >= order.index(module):
            problems.append(f"src/{module}/CMakeLists.txt: {module} may not use {other}, "
                            "which does not stand before it")
        if other == TESTING_MODULE:
            problems.append(f"src/{module}/CMakeLists.txt: {module} may not use {other}, "
                            "which is for tests and the program")
    return problems


def forbidden_include(module, used, is_public, bracket, header):
    """What is wrong with an include of a file of `module`, or None."""
    parts = pathlib.PurePosixPath(header).parts
    if ".." in parts:
        return f"{module} may not include a path with .."
    if parts[0] == "enfilade":
        return None if parts[1] in {module, *used} else f"{module} may not include {parts[1]}"
    if parts[0] == "src":
        return None if parts[1] == module and not is_public else \
            f"{module} may not include private headers: {header}"
    if parts[0] in ("apps", "tests"):
        return f"{module} may not include {parts[0]}"
    if is_public and (bracket == '"' or not PUBLIC_THIRD_PARTY.fullmatch(header)):
        return f"a public header may not include {header}"
    return None


def check_includes(root, module, used):
    """Problems of all files of one module."""
    problems = []
    files = [*root.glob(f"src/{module}/**/*"), *root.glob(f"include/enfilade/{module}/**/*")]
    for path in sorted(f for f in files if f.suffix in (".h", ".cc")):
        name = path.relative_to(root)
        for number, line in enumerate(path.read_text().splitlines(), 1):
            hit = INCLUDE.match(line)
            problem = hit and forbidden_include(module, used, name.parts[0] == "include", *hit.groups())
            if problem:
                problems.append(f"{name}:{number}: {problem}")
    return problems


def check_lists(root, module, lists):
    """Files that exist but are not listed."""
    problems = []
    for folder, suffix, key in ((f"src/{module}", ".cc", "SOURCES"),
                                (f"include/enfilade/{module}", ".h", "HEADERS")):
        for path in sorted((root / folder).glob("**/*" + suffix)):
            if path.relative_to(root / folder).as_posix() not in lists[key]:
                problems.append(f"{path.relative_to(root)}: missing from {key} in "
                                f"src/{module}/CMakeLists.txt")
    return problems


def types_of(parameters):
    """The types of a parameter list, without names and default values."""
    types, depth = [""], 0
    for letter in re.sub(r"\s+", " ", parameters):
        depth += (letter in "<({") - (letter in ">)}")
        if letter == "," and depth == 0:
            types.append("")
        else:
            types[-1] += letter
    types = [re.sub(r"\s*=.*", "", text).strip() for text in types]
    return tuple(re.sub(r"(?<=[\w>&*]) \w+$", "", re.sub(r"([&*])(\w)", r"\1 \2", text))
                 .removeprefix("const ") for text in types)


def check_names(root):
    """Types and functions that headers of two modules declare."""
    declared = {}
    for path in sorted([*root.glob("include/enfilade/*/*.h"), *root.glob("src/*/*.h")]):
        text = re.sub(r"//.*", "", path.read_text())
        names = [hit[1] for hit in TYPE.finditer(text)]
        names += [f"{hit[1]}({', '.join(types_of(hit[2]))})" for hit in FUNCTION.finditer(text)]
        for name in names:
            declared.setdefault(name, {}).setdefault(path.parent.name, path.relative_to(root))
    return [f"{' and '.join(map(str, where.values()))}: two modules declare {name}"
            for name, where in declared.items() if len(where) > 1]


def check(root):
    """Number of modules, and one line a problem."""
    order, modules = parse_tree(root)
    problems = []
    for module, lists in sorted(modules.items()):
        problems += check_uses(module, lists["USES"], order)
        problems += check_includes(root, module, lists["USES"])
        problems += check_lists(root, module, lists)
    problems += check_names(root)
    return len(modules), problems


def main():
    num_modules, problems = check(pathlib.Path(sys.argv[1]))
    print("\n".join(problems) or f"{num_modules} modules, no forbidden include")
    sys.exit(bool(problems))


if __name__ == "__main__":
    main()
