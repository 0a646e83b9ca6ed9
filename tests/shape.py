#!/usr/bin/env python3
"""Checks shapes and words of the Rust files that git knows, in a second. Run it from any folder, without arguments.

Outside tests: a file has at most 350 lines before its tests, a function 60 and a step 100 (blank lines are not counted), five
parameters after opening tuples, without self; a package has one type for each name. Everywhere: no word of WORDS in a name, a comment
or a file's name, no comment that begins with "The same", no #[path] that leaves its folder. EXCEPTIONS holds what is not there yet: it
only becomes shorter, and an exception that nothing needs is a mistake, too.
"""

import re
import subprocess
import sys
from pathlib import Path

FILE, FUNCTION, STEP, PARAMETERS = 350, 60, 100, 5

# The function that reads as the step's table of contents.
STEPS = {("core/src/solver.rs", "step")}

# Words of a household, and the words of the trade for them.
WORDS = {
    "heard": "received, inbox, message",
    "mail": "inbox, message",
    "wish": "request, limits, settings",
    "flight": "pending, outstanding",
    "doors": "sockets, listeners, reconnect",
    "shelf": "cache, store",
    "kept": "stored, saved, held, history",
    "told": "sent, reported, notified",
}

BOARDS = "one program for each board: what differs has one name"
WORDING = "words of a household, which are replaced"
CITED = "documentation that still refers to its neighbour"
UNITS = "public in SI units, and within the solver in units of the body"
TODAY = "not yet in pieces"
SHARED = "modules that a package has to take over"
BINDING = "an interface: one value for each that Python or JavaScript passes"

# (file, or folder with a slash at its end; rule; most that is allowed: the largest size, or the number of places; reason)
EXCEPTIONS = [
    ("host-sim/python/src/run.rs", "parameters", 7, BINDING),
    ("host-sim/python/src/solver.rs", "parameters", 6, BINDING),
    ("firmware/", "same", 3, CITED),
    ("core/", "types", 4, UNITS),
    ("firmware/boards/", "types", 13, BOARDS),
    ("firmware/c/", "types", 1, BOARDS),
    ("firmware/template/", "types", 1, BOARDS),
    ("host-sim/src/board/", "types", 1, TODAY),
    ("firmware/", "types", 4, BOARDS),
]

# One piece of Rust in which no code is: a comment, or a text.
PIECE = re.compile(
    r'(?P<comment>//[^\n]*|/\*.*?\*/)'
    r'|(?P<text>\bb?r(?P<hash>#*)".*?"(?P=hash)|b?"(?:[^"\\]|\\.)*"|b?\'(?:\\[^\n]{1,10}?|[^\\\'\n])\')',
    re.DOTALL,
)
WORD = re.compile(
    "(?<![A-Za-z])(?:{0})(?![a-z])|(?:{1})(?![a-z])|(?<![A-Z])(?:{2})(?![A-Z])".format(
        "|".join(WORDS), "|".join(w.capitalize() for w in WORDS), "|".join(w.upper() for w in WORDS)
    )
)
FN = re.compile(r"\bfn\s+([A-Za-z_]\w*)\s*[<(]")
TESTS = re.compile(r"^#\[cfg\((?:all\()?test\b[^\n]*\n(?:#\[[^\n]*\n)*(?:pub(?:\([a-z]+\))? )?mod \w+(?: \{|;)", re.MULTILINE)
TYPE = re.compile(r"^(?:(?:pub(?:\([a-z: ]+\))? )?type|[ \t]*(?:pub(?:\([a-z: ]+\))? )?(?:struct|enum|trait|union)) ([A-Z]\w*)", re.MULTILINE)
OPEN, CLOSE = "([{", ")]}"
BRACKET = re.compile(r"[(\[{}\])]")


def blank(text):
    return " " * len(text) if "\n" not in text else re.sub(r"[^\n]", " ", text)


def blanked(text):
    """The text without literals, and the text without literals and comments: spaces are in their places."""
    words, code, at = [], [], 0
    for match in PIECE.finditer(text):
        before, empty = text[at : match.start()], blank(match[0])
        words += (before, match[0] if match["comment"] else empty)
        code += (before, empty)
        at = match.end()
    return "".join([*words, text[at:]]), "".join([*code, text[at:]])


def closing(code, at):
    """The place of the bracket that closes the one at `at`."""
    depth = 0
    for match in BRACKET.finditer(code, at):
        depth += 1 if match[0] in OPEN else -1
        if depth == 0:
            return match.start()
    return len(code)


def parts(text):
    """The text between the commas that no bracket encloses."""
    found, depth, begin = [], 0, 0
    for at, char in enumerate(text):
        if char in OPEN or char == "<":
            depth += 1
        elif char in CLOSE or (char == ">" and text[at - 1] not in "-="):
            depth -= 1
        elif char == "," and depth == 0:
            found.append(text[begin:at])
            begin = at + 1
    return [part.strip() for part in [*found, text[begin:]] if part.strip()]


def members(type_):
    """How many values a type holds once its tuples are open."""
    bare = re.sub(r"^(?:&\s*(?:'\w+\s+)?(?:mut\s+)?)+", "", type_.strip())
    if bare.startswith("(") and bare.endswith(")"):
        return sum(members(part) for part in parts(bare[1:-1]))
    return 1


def parameters(signature):
    count = 0
    for part in parts(signature):
        part = re.sub(r"#\[[^\]]*\]\s*", "", part)
        if re.match(r"(?:&\s*(?:'\w+\s+)?)?(?:mut\s+)?self\b", part):
            continue
        depth = 0
        for at, char in enumerate(part):
            depth += (char in OPEN) - (char in CLOSE)
            if char == ":" and depth == 0 and part[at + 1 : at + 2] != ":":
                count += members(part[at + 1 :])
                break
    return count


def functions(code):
    """Name, place, parameters and lines of each function that has a body."""
    for match in FN.finditer(code):
        at = match.end() - 1
        if code[at] == "<":  # the generics: to the bracket of the parameters, which no angle encloses
            depth = 0
            while at < len(code):
                depth += (code[at] == "<") - (code[at] == ">" and code[at - 1] not in "-=")
                at += 1
                if depth == 0:
                    break
            at = code.find("(", at)
        end = closing(code, at)
        body = re.compile(r"[{;]").search(code, end)
        while body and body[0] == ";" and code.count("[", end, body.start()) > code.count("]", end, body.start()):
            body = re.compile(r"[{;]").search(code, body.end())
        if not body:
            continue
        stop = closing(code, body.start()) if body[0] == "{" else body.start()
        yield match[1], match.start(), parameters(code[at + 1 : end]), (match.start(), stop + 1)


def is_test(path):
    return path.startswith("tests/") or re.search(r"(^|/)(tests|benches|fuzz)(/|\.rs$)|/tests?\.rs$|_tests?\.rs$", path) is not None


def lines(text):
    return sum(1 for line in text.split("\n") if line.strip())


def repeated_types(packages):
    """Each type of a package with the name of another one, outside tests: file, line, description."""
    for package, names in packages.items():
        for name, places in names.items():
            for path, line in places[1:]:
                before = ":".join(map(str, places[0]))
                yield path, line, f"another type {name} of this package is at {before}; allowed: one type for each word"


def faults(path, text):
    """Each fault as rule, place, size (0: its places are counted), description."""
    words, code = blanked(text)
    if not is_test(path):
        tests = TESTS.search(text)
        before = lines(text[: tests.start()] if tests else text)
        if before > FILE:
            yield "file", 0, before, f"{before} lines before its tests; allowed: {FILE}"
        for name, at, count, (begin, end) in functions(code):
            if tests and at > tests.start():
                break
            most = STEP if (path, name) in STEPS else FUNCTION
            length = lines(text[begin:end])
            if length > most:
                yield "function", at, length, f"{name} has {length} lines; allowed: {most}"
            if count > PARAMETERS:
                yield "parameters", at, count, f"{name} has {count} parameters after opening tuples; allowed: {PARAMETERS}"
    for match in WORD.finditer(words):
        word = match[0].lower()
        if word == "flight" and words[: match.start()].endswith("in "):
            continue
        yield "words", match.start(), 0, f"`{word}`; allowed, for instance: {WORDS[word]}"
    for match in re.finditer(r"(?<!//)(?<!//\n)^[ \t]*//[/!]?[ ]The same\b", words, re.MULTILINE):
        before = words[: match.start()].rstrip("\n").rsplit("\n", 1)[-1].strip()
        if not before.startswith("//"):
            yield "same", match.end(), 0, 'the comment begins with "The same": say what it is'
    for match in re.finditer(r'#\[path = "([^"]*)"', text):
        if match[1].startswith(("../", "/")):
            yield "path", match.start(), 0, f"#[path] to {match[1]}; allowed: a package, or a module of this folder"


def main():
    root = Path(__file__).resolve().parent.parent
    names = subprocess.run(["git", "ls-files"], cwd=root, capture_output=True, text=True, check=True).stdout.split("\n")
    names = [name for name in names if name and (root / name).is_file()]
    faulty = []  # file, rule, line, size (0: places are counted), description
    folders = sorted((name[: -len("Cargo.toml")] for name in names if name.endswith("Cargo.toml")), key=len, reverse=True)
    packages = {}
    for path in names:
        if word := WORD.search(path):
            faulty.append((path, "words", 1, 0, f"the file's name has `{word[0].lower()}`"))
        if path.endswith(".rs"):
            text = (root / path).read_text(encoding="utf-8")
            faulty += [(path, rule, text.count("\n", 0, at) + 1, size, what) for rule, at, size, what in faults(path, text)]
            if not is_test(path) and "/examples/" not in path:
                types = packages.setdefault(next(folder for folder in folders if path.startswith(folder)), {})
                tests = TESTS.search(text)
                for match in TYPE.finditer(text, 0, tests.start() if tests else len(text)):
                    types.setdefault(match[1], []).append((path, text.count("\n", 0, match.start()) + 1))
    faulty += [(path, "types", line, 0, what) for path, line, what in repeated_types(packages)]

    mistakes, notes, excused = [], [], set()
    for exception in EXCEPTIONS:
        where, rule, most, _ = exception
        of = [f for f in faulty if f[1] == rule and (f[0] == where or (where.endswith("/") and f[0].startswith(where))) and f not in excused]
        now = max((f[3] for f in of), default=0) or len(of)
        if now <= most:
            excused.update(of)
        if now == 0:
            mistakes.append(f"tests/shape.py: the exception ({where}, {rule}) is not needed any more: delete it")
        elif now < most:
            notes.append(f"note: the exception ({where}, {rule}) may be {now} instead of {most}")
        elif now > most:
            mistakes.append(f"tests/shape.py: the exception ({where}, {rule}) allows {most}, and {now} are there:")
    mistakes += [f"{path}:{line}: {what}" for path, rule, line, size, what in faulty if (path, rule, line, size, what) not in excused]
    print("\n".join([*mistakes, *notes, f"shapes and words: {len(names)} files, {len(mistakes)} mistakes, {len(EXCEPTIONS)} exceptions"]))
    return 1 if mistakes else 0


if __name__ == "__main__":
    sys.exit(main())
