"""Single faults in C sources: where one can be planted, and what the text is with it.

Source(path, text) splits a file into tokens (comments, strings and directives are none that count),
walks over its statements to learn which tokens are code that runs or fills a table, and lists
faults by line and kind. Not touched are: declarators and with them array sizes, enumerators, members,
case labels, sizeof, assertions, attributes; in headers all but the bodies of functions.

This is no parser: what it takes for a fault may not compile. Who uses it draws another then.
"""
import collections
import random
import re

KINDS = {
    "arithmetic": "+ - * / % << >> & | ^ and their assignments, ++ and --, each for its counterpart",
    "comparison": "< <= > >= == !=, each for a neighbour",
    "logic": "&& for || and back",
    "sign": "a minus is dropped",
    "number": "a float by 10 %, a small integer by 1, a large one by 10 %",
    "drop": "an assignment, call or guarded return, continue, break or goto is left out",
    "swap": "two neighbouring arguments of a call change places",
    "negate": "a condition means its contrary: of if or while, after !, or of ?:",
}

Token = collections.namedtuple("Token", "kind text start end line")
Fault = collections.namedtuple("Fault", "path line kind start end text")  # text replaces [start, end)

SCANNER = re.compile(r"""
    (?P<directive> ^[ \t]*\#(?:\\\n|/\*.*?\*/|[^\n])* )
  | (?P<comment>   //(?:\\\n|[^\n])* | /\*.*?\*/ )
  | (?P<string>    (?:u8|[LuU])?"(?:\\.|[^"\\\n])*" )
  | (?P<char>      [LuU]?'(?:\\.|[^'\\\n])*' )
  | (?P<number>    \.?[0-9](?:[eEpP][+-]|[\w.])* )
  | (?P<name>      [A-Za-z_]\w* )
  | (?P<operator>  \.\.\.|<<=|>>=|->|\+\+|--|<<|>>|[<>=!]=|&&|\|\||[-+*/%&|^]=|[^\s\w] )
""", re.X | re.S | re.M)

ARITHMETIC = {"+": "-", "-": "+", "*": "/", "/": "*", "%": "/", "<<": ">>", ">>": "<<", "&": "|", "|": "&",
              "^": "|", "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*=", "|=": "&=", "&=": "|=",
              "<<=": ">>=", ">>=": "<<=", "++": "--", "--": "++"}
COMPARISON = {"<": ("<=", ">"), "<=": ("<", ">="), ">": (">=", "<"), ">=": (">", "<="), "==": ("!=",), "!=": ("==",)}
LOGIC = {"&&": "||", "||": "&&"}
TYPE_WORDS = set("const static register volatile extern inline struct union enum typedef unsigned signed long short "
                 "int char float double void _Bool bool _Thread_local _Atomic".split())
JUMPS = {"return", "continue", "break", "goto"}
HEADS = {"if", "while", "for", "switch"}
KEYWORDS = TYPE_WORDS | JUMPS | HEADS | {"else", "do", "case", "default", "sizeof"}
NOT_CODE = {"sizeof", "_Static_assert", "static_assert", "assert", "offsetof", "__attribute__", "_Alignas", "_Alignof"}
# Their arguments may change places; f32v and the like end in the width.
COMMUTATIVE = re.compile(r"(^|_)(f?min|f?max|add|mul|and|or|xor|dot|equal|same)[fl]?(_?[a-z]?[0-9]*)?$", re.I)
CLOSING = {"(": ")", "[": "]", "{": "}"}


def tokens_of(text):
    """The tokens of a text, without comments and directives."""
    tokens, line, at = [], 1, 0
    for match in SCANNER.finditer(text):
        line += text.count("\n", at, match.start())
        at = match.start()
        if match.lastgroup not in ("directive", "comment"):
            tokens.append(Token(match.lastgroup, match.group(), match.start(), match.end(), line))
    return tokens


def partners_of(tokens):
    """Index of each opening bracket -> index of the closing one; the last token where there is none."""
    partners, stack = {}, []
    for i, token in enumerate(tokens):
        if token.text in CLOSING and token.kind == "operator":
            stack.append(i)
        elif token.kind == "operator" and stack and token.text == CLOSING[tokens[stack[-1]].text]:
            partners[stack.pop()] = i
    partners.update((i, len(tokens) - 1) for i in stack)
    return partners


Statement = collections.namedtuple("Statement", "first last head block")
# Of tokens first to last, the last a semicolon; head is the keyword that rules it, block that of the block
# that holds it; both may be None.


class Source:
    def __init__(self, path, text):
        self.path, self.text = path, text
        self.tokens = tokens_of(text)
        self.partners = partners_of(self.tokens)
        self.code = [False] * len(self.tokens)  # does this token run, or fill a table?
        self.statements = []
        self.conditions = []  # (opening, closing) of the parentheses after if and while
        self._walk()
        self._leave_out()
        if path.endswith(".h"):
            self._leave_out_tables()

    # -- statements

    def _walk(self):
        """Fills statements, conditions and code, in one pass that steps over brackets."""
        tokens, blocks = self.tokens, []  # blocks: keyword of each open block, "" for none
        start = i = 0
        head = None
        while i < len(tokens):
            text = tokens[i].text if tokens[i].kind not in ("string", "char") else '""'
            if text in HEADS and blocks and i + 1 < len(tokens) and tokens[i + 1].text == "(":
                head, i = text, self._head(i)
                start = i
            elif text in ("else", "do") and blocks:
                head, i = text, i + 1
                start = i
            elif i == start and blocks and self._label_end(i):
                i = start = self._label_end(i)
            elif text == "{" and self._opens_block(start, i, blocks):
                blocks.append(head or "")
                head, i = None, i + 1
                start = i
            elif text == "}":
                if blocks:
                    blocks.pop()
                head, i = None, i + 1
                start = i
            elif text == ";":
                self._statement(Statement(start, i, head, blocks[-1] if blocks else None), bool(blocks))
                head, i = None, i + 1
                start = i
            else:
                i = self.partners.get(i, i) + 1
        self.balanced = not blocks

    def _head(self, i):
        """Takes in `if (…)` and its like at i; returns where the statement behind it begins."""
        opening, closing = i + 1, self.partners[i + 1]
        self.code[i:closing + 1] = [True] * (closing + 1 - i)
        if self.tokens[i].text in ("if", "while"):
            self.conditions.append((opening, closing))
        if self.tokens[i].text == "for":
            end = next((k for k in range(opening + 1, closing) if self.tokens[k].text == ";"), opening)
            self._leave_out_declarators(opening + 1, end)
        return closing + 1

    def _label_end(self, i):
        """Where the text goes on behind the label at i, 0 if there is none."""
        if self.tokens[i].text == "case":
            while i < len(self.tokens) and self.tokens[i].text != ":":
                i += 1
            return i + 1
        named = self.tokens[i].kind == "name" and i + 1 < len(self.tokens) and self.tokens[i + 1].text == ":"
        return i + 2 if named else 0

    def _opens_block(self, start, i, blocks):
        """Does the brace at i open a block, rather than an initializer, a struct or an enum?"""
        if i == start:
            return True
        before = self.tokens[i - 1]
        if not blocks:
            attribute = before.text == ")" and any(t.text == "__attribute__" for t in self.tokens[start:i])
            return before.kind == "string" or (before.text == ")" and not attribute)
        return self.tokens[start].kind == "name" and self.partners.get(start + 1) == i - 1 \
            and self.tokens[start].text not in KEYWORDS  # a macro that loops

    def _statement(self, statement, in_body):
        first, last = statement.first, statement.last
        declares = self.declares(first, last)
        if in_body:
            self.code[first:last + 1] = [True] * (last + 1 - first)
            self.statements.append(statement)
            if declares:
                self._leave_out_declarators(first, last)
        elif declares and self.tokens[first].text != "typedef":
            self.code[first:last + 1] = [True] * (last + 1 - first)
            self._leave_out_declarators(first, last)

    def declares(self, first, last):
        """Is this a declaration? `type name`, `type *name =`, or it begins with a word of a type."""
        if first >= last:
            return False
        if self.tokens[first].text in TYPE_WORDS:
            return True
        if self.tokens[first].kind != "name" or self.tokens[first].text in KEYWORDS:
            return False
        i = first + 1
        while i < last and self.tokens[i].text in ("*", "const", "restrict"):
            i += 1
        if i == first + 1:
            return self.tokens[i].kind == "name"
        return self.tokens[i].kind == "name" and self.tokens[i + 1].text in ("=", ";", ",", "[")

    def _leave_out_declarators(self, first, last):
        """Of a declaration's tokens only the initializers stay code."""
        if not self.declares(first, last):
            return
        i, declarator = first, True
        while i <= last:
            end = self.partners.get(i, i)
            if self.tokens[i].text in (",", "="):
                declarator = self.tokens[i].text == ","
                self.code[i] = False
            elif declarator:
                self.code[i:end + 1] = [False] * (end + 1 - i)
            i = end + 1

    def _leave_out(self):
        """What sizeof, assertions and attributes hold, and designators, are not code."""
        for i, token in enumerate(self.tokens):
            if token.text in NOT_CODE and token.kind == "name":
                end = self.partners.get(i + 1, i + 1)
                self.code[i:end + 1] = [False] * (end + 1 - i)
            if token.text == "[" and self.tokens[i - 1].text in ("{", ","):
                end = self.partners[i]
                self.code[i:end + 1] = [False] * (end + 1 - i)

    def _leave_out_tables(self):
        """In a header only bodies are code: what lies outside braces of functions is not."""
        inside = [False] * len(self.tokens)
        for statement in self.statements:
            inside[statement.first:statement.last + 1] = [True] * (statement.last + 1 - statement.first)
        for opening, closing in self.conditions:
            inside[opening - 1:closing + 1] = [True] * (closing + 2 - opening)
        self.code = [code and within for code, within in zip(self.code, inside)]

    # -- faults

    def lines(self):
        """The numbers of the lines that hold code."""
        return sorted({token.line for token, code in zip(self.tokens, self.code) if code and token.text not in "{};"})

    def faults(self):
        """line -> kind -> faults."""
        found = collections.defaultdict(lambda: collections.defaultdict(list))
        for fault in self._all():
            found[fault.line][fault.kind].append(fault)
        return found

    def _all(self):
        for i, token in enumerate(self.tokens):
            if self.code[i]:
                yield from self._operator(i, token)
                yield from self._number(i, token)
                yield from self._swap(i, token)
        for statement in self.statements:
            yield from self._drop(statement)
        for opening, closing in self.conditions:
            if self.code[opening]:
                text = "(!" + self.text[self.tokens[opening].start:self.tokens[closing].end] + ")"
                yield self._fault("negate", opening, closing, text)

    def _fault(self, kind, first, last, text):
        start, end = self.tokens[first].start, self.tokens[last].end
        text += "\n" * (self.text.count("\n", start, end) - text.count("\n"))  # lines keep their numbers
        return Fault(self.path, self.tokens[first].line, kind, start, end, text)

    def _is_binary(self, i):
        before, after = self.tokens[i - 1], self.tokens[i + 1]
        return (before.kind in ("number", "char") or before.text in (")", "]")
                or (before.kind == "name" and before.text not in KEYWORDS)) and after.text not in (")", ",", ";")

    def _operator(self, i, token):
        if token.kind != "operator":
            return
        text = token.text
        if text in ARITHMETIC and (len(text) > 1 and text not in ("<<", ">>") or self._is_binary(i)):
            yield self._fault("arithmetic", i, i, ARITHMETIC[text])
        elif text == "-":
            yield self._fault("sign", i, i, "")
        elif text in COMPARISON:
            yield from (self._fault("comparison", i, i, other) for other in COMPARISON[text])
        elif text in LOGIC:
            yield self._fault("logic", i, i, LOGIC[text])
        elif text == "!":
            yield self._fault("negate", i, i, "")
        elif text == "?":
            yield from self._swap_branches(i)

    def _swap_branches(self, i):
        """c ? a : b becomes c ? b : a."""
        colon, end, depth = None, i + 1, 0
        while end < len(self.tokens) and self.tokens[end].text not in (",", ";", ")", "]", "}"):
            text = self.tokens[end].text
            if text == ":" and depth == 0 and colon is None:
                colon = end
            elif text in ("?", ":"):
                depth += 1 if text == "?" else -1
            end = self.partners.get(end, end) + 1
        if colon and colon > i + 1 and end > colon + 1:
            yes = self.text[self.tokens[i + 1].start:self.tokens[colon - 1].end]
            no = self.text[self.tokens[colon + 1].start:self.tokens[end - 1].end]
            if yes != no:
                yield self._fault("negate", i, end - 1, f"? {no} : {yes}")

    def _number(self, i, token):
        if token.kind == "number":
            yield from (self._fault("number", i, i, text) for text in other_numbers(token.text))

    def _swap(self, i, token):
        if token.kind != "name" or token.text in KEYWORDS or COMMUTATIVE.search(token.text) \
                or i + 1 not in self.partners or self.tokens[i + 1].text != "(":
            return
        arguments, first, k, end = [], i + 2, i + 2, self.partners[i + 1]
        while k <= end:
            if k == end or self.tokens[k].text == ",":
                if k > first:
                    arguments.append((first, k - 1))
                first = k + 1
            k = self.partners.get(k, k) + 1
        words = [self.text[self.tokens[a].start:self.tokens[b].end] for a, b in arguments]
        for n in range(len(words) - 1):
            if words[n] != words[n + 1]:
                between = self.text[self.tokens[arguments[n][1]].end:self.tokens[arguments[n + 1][0]].start]
                yield self._fault("swap", arguments[n][0], arguments[n + 1][1], words[n + 1] + between + words[n])

    def _drop(self, statement):
        first, last = statement.first, statement.last
        token = self.tokens[first]
        if first >= last or not self.code[first] or self.declares(first, last):
            return
        if token.text in JUMPS:
            closes_if = statement.block == "if" and self.tokens[last + 1].text == "}" and not statement.head
            if statement.head == "if" or closes_if:
                yield self._fault("drop", first, last, ";")
        elif token.kind == "name" and token.text not in KEYWORDS or token.text in ("*", "++", "--", "("):
            is_void = [t.text for t in self.tokens[first:first + 3]] == ["(", "void", ")"]
            if not is_void or self.tokens[last - 1].text == ")":
                yield self._fault("drop", first, last, ";")


def other_numbers(text):
    """What a numeric constant may become: two texts, or one for 0, or none."""
    whole = re.fullmatch(r"(0[xX][0-9a-fA-F]+|[0-9]+)([uUlL]*)", text)
    if whole:
        value = int(whole[1], 16) if whole[1][:2] in ("0x", "0X") else int(whole[1])
        step = 1 if value <= 64 or whole[1][:2] in ("0x", "0X") else value // 10
        shown = hex if whole[1][:2] in ("0x", "0X") else str
        return [shown(v) + whole[2] for v in (value + step, value - step) if v >= 0]
    real = re.fullmatch(r"([0-9]*\.?[0-9]*(?:[eE][-+]?[0-9]+)?)([fFlL]?)", text)
    if not real:
        return []
    value = float(real[1])
    texts = [f"{v:.9g}" for v in ((0.1,) if value == 0 else (value * 1.1, value * 0.9))]
    return [(t if "." in t or "e" in t else t + ".0") + real[2] for t in texts]


def draw(sources, seed):
    """Endless faults: a line of code, all equally likely, then a kind, then one of that kind there."""
    lines = [(source, line) for source in sources for line in source.lines()]
    faults = {source.path: source.faults() for source in sources}
    random_of_seed = random.Random(seed)
    seen = set()
    most = sum(len(f) for by_line in faults.values() for by_kind in by_line.values() for f in by_kind.values())
    while len(seen) < most:
        source, line = random_of_seed.choice(lines)
        kinds = faults[source.path].get(line)
        if kinds:
            fault = random_of_seed.choice(kinds[random_of_seed.choice(sorted(kinds))])
            if fault not in seen:
                seen.add(fault)
                yield fault


def planted(text, fault):
    return text[:fault.start] + fault.text + text[fault.end:]


def shown(text, fault):
    """The line with «what was → what is», blanks squeezed."""
    begin = text.rfind("\n", 0, fault.start) + 1
    end = text.find("\n", fault.end)
    before, after = text[begin:fault.start], text[fault.end:end if end >= 0 else len(text)]
    now = fault.text.strip() or "nothing"
    return re.sub(r"\s+", " ", f"{before}«{text[fault.start:fault.end]} → {now}»{after}").strip()
