"""Reads the structs and enums of a C header, with the comments that stand at them.

A comment belongs to the declaration that it follows on the same line, else to the one that it
stands before. Headers must be regular: every type is `typedef struct|enum NAME { … } NAME;`,
without braces inside. What is not of that form is passed over; a test compares the result with
what the compiler saw.
"""

import re
import textwrap
from dataclasses import dataclass, field

COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)
MARK = re.compile("\x01(\\d+)\x02")  # where a comment was
TYPE = re.compile(r"(?:\x01(\d+)\x02\s*)?typedef (struct|enum) (\w+) \{([^{}]*)\} \3;")
DECLARATION = re.compile(r"^(?:const )?(\w+)\s+(.*)$", re.DOTALL)
DECLARATOR = re.compile(r"^((?:\*\s*(?:const )?)*)(\w+)((?:\[\w+\])*)$")


@dataclass
class Member:
    """A field of a struct, or a constant of an enum."""

    name: str
    doc: str
    type: str = ""  # without const and stars; empty: a function pointer, or a constant
    stars: int = 0
    sizes: list[str] = field(default_factory=list)  # of an array, as written


@dataclass
class Type:
    """A struct or an enum."""

    kind: str
    name: str
    doc: str
    members: list[Member]


def clean(comment):
    """A comment's text: paragraphs keep their lines, the stars go."""
    lines = [re.sub(r"^\s*\* ?", "", line) for line in comment[2:-2].strip().splitlines()]
    return textwrap.dedent("\n".join([lines[0].strip(), *lines[1:]])).strip()


def pieces(body, separator):
    """The declarations of a body: text and comment of each."""
    found = []
    for part in re.finditer(rf"([^{separator}]*)({separator}|$)([ \t]*\x01\d+\x02)?", body):
        text = MARK.sub("", part.group(1)).strip()
        marks = MARK.findall(part.group(0))
        if text:
            found.append((text, marks))
    return found


def declared(text, doc):
    """The members that one declaration of a struct declares."""
    base, rest = DECLARATION.match(text).groups()
    if "(" in rest:
        return [Member(re.search(r"\(\*(\w+)\)", rest).group(1), doc)]
    members = []
    for part in rest.split(","):
        stars, name, sizes = DECLARATOR.match(part.strip()).groups()
        members.append(Member(name, doc, base, stars.count("*"), re.findall(r"\w+", sizes)))
    return members


def parse(text):
    """The types of a header's text, by name."""
    comments = []

    def mark(match):
        comments.append(clean(match.group(0)))
        return f"\x01{len(comments) - 1}\x02"

    types = {}
    for doc, kind, name, body in TYPE.findall(COMMENT.sub(mark, text)):
        members = []
        for piece, marks in pieces(body, ";" if kind == "struct" else ","):
            note = "\n".join(comments[int(number)] for number in marks)
            if kind == "struct":
                members += declared(piece, note)
            else:
                members.append(Member(piece.split("=")[0].strip(), note))
        types[name] = Type(kind, name, comments[int(doc)] if doc else "", members)
    return types
