"""Writes drypoint/_generated.py: enums and dataclasses whose names, defaults and texts are the
headers'.

Zero is the default of every field in C, and so it is in Python: 0, False, an enum's first member,
    None
for colours. What zero means is said by the field's comment, which becomes its documentation.
"""

import re
import textwrap

# Structs that become dataclasses, and their names where these are not just C's.
INPUTS = {
    "dp_line_style": "",
    "dp_stroke_style": "Stroke",
    "dp_pattern": "",
    "dp_line_light": "",
    "dp_hidden": "",
    "dp_shade": "",
    "dp_edge_map": "",
    "dp_mirror": "",
    "dp_style": "",
    "dp_fit": "",
    "dp_clip_plane": "",
    "dp_clip": "",
    "dp_deform": "",
    "dp_drawing_desc": "Cleaning",
}
OUTPUTS = {"dp_stats": "", "dp_extent": "", "dp_drawing_info": ""}

# What the types do not tell: sets of lines, counts of what Python sees as one list, and what is
# C's own.
SETS = {("dp_style", "lines")}
COUNTS = {("dp_clip", "planes"): "plane_count", ("dp_edge_map", "enhanced"): "enhanced_count"}
LEFT_OUT = {("dp_deform", "vertices"), ("dp_deform", "user"), ("dp_deform", "normals")}
INDEXED = {"DP_LINE_COUNT": "Line"}  # arrays with an element for each member of an enum

PLAIN = {"bool": ("bool", "False"), "float": ("float", "0.0"), "double": ("float", "0.0")}
HEAD = '''"""Made from the headers of include/drypoint by build_drypoint/classes.py: not to be edited.

Constants that texts name by C's names, DP_LINE_RIDGE say, are members of enums here: Line.RIDGE.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import field
from enum import IntEnum
from typing import ClassVar

from ._struct import Color, Lines, Pixels, Struct, TextureLike, struct

'''


def title(name):
    """dp_line_style: LineStyle."""
    return "".join(word.capitalize() for word in name.split("_")[1:])


def documentation(text, indent):
    """A comment as lines of a docstring."""
    text = text.replace("\\", "\\\\").replace('"""', "'''")
    return textwrap.indent(re.sub(r"\n {8,}", " ", text), " " * indent)


def enum_class(enum):
    """An IntEnum without the constants' common prefix, and without the one that counts them."""
    members = [m for m in enum.members if not m.name.endswith("_COUNT")]
    names = [member.name for member in members]
    common = min(names), max(names)
    length = next((i for i, (a, b) in enumerate(zip(*common)) if a != b), 0)
    prefix = common[0][:length].rpartition("_")[0] + "_"
    text = f"class {title(enum.name)}(IntEnum):\n"
    text += f'    """{documentation(enum.doc, 4).strip() or title(enum.name) + "."}\n\n'
    for member in members:
        note = documentation(member.doc, 8).strip()
        name = member.name.removeprefix(prefix)
        text += f"    {name}: {note}\n" if note else f"    {name}\n"
    text = text.rstrip() + '\n    """\n\n'
    for number, member in enumerate(members):
        text += f"    {member.name.removeprefix(prefix)} = {number}\n"
    return text


class Writer:
    """Writes classes for types that headers.parse has read."""

    def __init__(self, types):
        self.types = types
        self.names = {name: given or title(name) for name, given in (INPUTS | OUTPUTS).items()}

    def typed(self, owner, member):
        """(annotation, default, kind) of a field; kind: how _struct.py is to treat it, if
        specially."""
        base, sizes = member.type, member.sizes
        if (owner, member.name) in SETS:
            return "Lines", "None", "lines"
        if (owner, member.name) in COUNTS:
            element = self.names.get(base, "")
            kind = f"counted {COUNTS[owner, member.name]} {element}".strip()
            return f"Sequence[{element or 'int'}]", "()", kind
        if base == "dp_color":
            return "Color", "None", "color"
        if base == "dp_texture":
            return "TextureLike", "None", "texture"
        if base == "dp_image":
            return "Pixels", "None", "image"
        if base in self.names:
            return self.nested(base, sizes)
        if base in self.types:
            name = title(base)
            return f"{name} | str | int", f"{name}(0)", f"enum {name}"
        plain, default = PLAIN.get(base, ("int", "0"))
        if sizes and sizes[0].isdigit():
            return f"Sequence[{plain}]", "(" + ", ".join([default] * int(sizes[0])) + ")", ""
        return (f"Sequence[{plain}]", "()", "") if sizes else (plain, default, "")

    def nested(self, base, sizes):
        """The same for structs in structs and arrays of them."""
        name = self.names[base]
        if not sizes:
            return (
                f"{name} | Mapping[str, object]",
                f"field(default_factory={name})",
                f"struct {name}",
            )
        index = INDEXED[sizes[-1]]
        inner = f"Mapping[{index} | str, {name} | Mapping[str, object]]"
        if len(sizes) == 1:
            return inner, "field(default_factory=dict)", f"by {index} {name}"
        return f"Sequence[{inner}]", "()", f"levels {index} {name}"

    def struct_class(self, name):
        """A dataclass."""
        counts = {count for (owner, _), count in COUNTS.items() if owner == name}
        members = [
            m
            for m in self.types[name].members
            if (name, m.name) not in LEFT_OUT and m.name not in counts
        ]
        kinds, fields = {}, ""
        doc = documentation(self.types[name].doc, 4).strip() or f"C's {name}."
        text = f'@struct\nclass {self.names[name]}(Struct):\n    """{doc}\n\n    Attributes:\n'
        for member in members:
            annotation, default, kind = self.typed(name, member)
            if kind:
                kinds[member.name] = kind
            fields += f"    {member.name}: {annotation} = {default}\n"
            note = documentation(member.doc, 12).strip() or "see " + annotation.split(" ")[0]
            text += f"        {member.name}: {note}\n"
        text = "\n".join(line.rstrip() for line in text.splitlines()) + '\n    """\n\n'
        text += (
            f'    _c: ClassVar[str] = "{name}"\n    _kinds: ClassVar[dict[str, str]] = {kinds}\n\n'
        )
        return text + fields

    def module(self, version, colors):
        """The whole module. colors: {name: 0xRRGGBB}."""
        parts = [f"VERSION = {version}  # of the headers\n"]
        parts.append(
            "COLORS = {\n" + "".join(f'    "{n}": 0x{rgb:06X},\n' for n, rgb in colors) + "}\n"
        )
        parts += [enum_class(t) for t in self.types.values() if t.kind == "enum"]
        parts += [self.struct_class(name) for name in self.names]
        return HEAD + "\n\n".join(parts)


def colors_of(text):
    """The colours that the program knows by name, from the table in tools/colors.c."""
    return [
        (name, int(rgb, 16)) for name, rgb in re.findall(r'\{"([a-z]+)", 0x([0-9A-F]{6})\}', text)
    ]
