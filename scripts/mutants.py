# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Finds the mutants of C++ sources, and writes sources that contain many mutants, of which one is chosen at run time (for
scripts/mutation_score).

A mutant replaces one token, or leaves one statement out. The expression around it, its slot, becomes
`(corotet_mutant(17) ? (mutated) : (original))`. A slot ends at brackets, commas, assignments, `?`, `:`, `;` and keywords, and at `&&` and
`||` unless one of these is mutated, so that the parentheses change nothing. Sources are read as tokens. They are formatted by
clang-format, so binary operators are known by blanks on both sides. A mutant that is made wrongly does not compile, and is left out.
"""

import bisect
import collections
import re

# One mutant: text[edit] becomes new. slot is the expression or statement that is written twice. edit and slot are pairs of offsets.
Mutant = collections.namedtuple("Mutant", "file line edit new slot statement kind")

TOKEN = re.compile(r"""
    (?P<number>(?:\d[\d']*\.?\d*|\.\d+)(?:[eE][-+]?\d+)?[uUlLfF]*)
  | (?P<name>[A-Za-z_]\w*)
  | (?P<string>"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*')
  | (?P<sign>->|::|\+\+|--|<<=|>>=|<=>|[-+*/%&|^=!<>]=|&&|\|\||<<|[-+*/%&|^=!<>~?:;,.(){}\[\]\\@$`#])
""", re.VERBOSE)
Token = collections.namedtuple("Token", "kind text start end")

ASSIGNMENTS = {"=", "+=", "-=", "*=", "/=", "%=", "|=", "&=", "^=", "<<=", ">>="}
BINARY = {"+": ["-"], "-": ["+"], "*": ["/"], "/": ["*"], "%": ["/"], "<": ["<=", ">="], "<=": ["<", ">"], ">": [">=", "<="], ">=": [">", "<"],
          "==": ["!="], "!=": ["=="], "&&": ["||"], "||": ["&&"]}
UPDATES = {"+=": ["-="], "-=": ["+="], "*=": ["/="], "/=": ["*="]}
NAMES = {"min": "max", "max": "min", "true": "false", "false": "true", "sin": "cos", "cos": "sin"}
BOUND_NAMES = {"return", "throw", "else", "do", "case", "default", "new", "delete", "const", "in"}
# Arguments of these are not mutated: they are not run, are for developers only, or only spare time.
UNEVALUATED = {"sizeof", "decltype", "noexcept", "static_assert", "requires", "alignas", "Assert", "AssertThrow", "AssertDimension",
               "AssertIndexRange", "__builtin_expect", "reserve"}
# Statements that are never left out, because no result depends on them: only time, memory, or a line of the log.
NO_RESULT = re.compile(r"\breserve\(|\bshrink_to_fit\(|^\(void\)|Assert|^COROTET|^DEAL_II|Scope|\bTimer|^static_cast<void>|\blog\.\w+\(")


def blanks(match):
    """As many blanks as the match is long; a string is kept as it is."""
    return match.group(0) if match.group(0)[0] in "\"'" else re.sub(r"[^\n]", " ", match.group(0))


def without_comments(text):
    return re.sub(r"//[^\n]*|/\*.*?\*/|\"(?:[^\"\\\n]|\\.)*\"|(?<![\w'])'(?:[^'\\\n]|\\.)+'", blanks, text, flags=re.DOTALL)


def without_preprocessor(text):
    return re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", blanks, text, flags=re.MULTILINE)


class Source:
    """A file with its tokens and its pairs of brackets."""

    def __init__(self, name, text):
        # Comments and the preprocessor's lines are replaced by blanks, so that offsets are the same in all texts.
        self.name, self.code = name, without_comments(text)
        self.text = without_preprocessor(self.code)
        self.tokens = [Token(match.lastgroup, match.group(0), match.start(), match.end()) for match in TOKEN.finditer(self.text)]
        self.line_starts = [0] + [i + 1 for i, letter in enumerate(text) if letter == "\n"]
        self.match_brackets()
        self.find_templates()

    def line(self, offset):
        return bisect.bisect_right(self.line_starts, offset)

    def match_brackets(self):
        """Finds the partner of each bracket, and for each token the innermost bracket that it is in."""
        self.partner, self.outer, open_brackets = {}, [], []
        for i, token in enumerate(self.tokens):
            if token.kind == "sign" and token.text in ")]}" and open_brackets:
                self.partner[i] = open_brackets.pop()
                self.partner[self.partner[i]] = i
            self.outer.append(open_brackets[-1] if open_brackets else None)
            if token.kind == "sign" and token.text in "([{":
                open_brackets.append(i)

    def find_templates(self):
        """Finds the tokens that are arguments of templates."""
        self.in_template, depth, brackets = [False] * len(self.tokens), [], 0
        for i, token in enumerate(self.tokens):
            if token.text == "<" and i and self.tokens[i - 1].kind == "name" and (not self.blank(token.start - 1) or self.tokens[i - 1].text == "template"):
                depth.append(brackets)
            elif token.text in (">", ">>") and depth and depth[-1] == brackets and not (self.blank(token.start - 1) and self.blank(token.end)):
                for _ in token.text:
                    if depth:
                        depth.pop()
            elif token.text in (";", "{") and depth and depth[-1] == brackets:
                depth.clear()
            elif token.text in "([":
                brackets += 1
            elif token.text in ")]":
                brackets -= 1
            self.in_template[i] = bool(depth)

    def blank(self, offset):
        return self.text[offset:offset + 1].isspace()

    def begins_line(self, i):
        start = self.tokens[i].start
        return not self.text[self.line_starts[self.line(start) - 1]:start].strip()

    def is_block(self, i):
        """Whether a brace opens a block of statements or a class, and not a list of values."""
        return self.begins_line(i) and not self.tokens[i - 1].text in ("=", ",", "(", "{", "return") or self.tokens[i - 1].text in (")", "]", "const", "mutable", "noexcept")

    def is_bound(self, i, logical):
        text, kind = self.tokens[i].text, self.tokens[i].kind
        if text == "," and self.in_template[i]:
            return False
        return text in (",", ";", "?", ":") or text in ASSIGNMENTS or (kind == "name" and text in BOUND_NAMES) or (logical and text in ("&&", "||"))

    def slot(self, first, last, logical):
        """The first and the last token of the expression around the tokens first ... last. With @p logical the expression ends at && and ||."""
        while first > 0 and not self.is_bound(first - 1, logical) and self.tokens[first - 1].text not in ("(", "[", "{"):
            if self.tokens[first - 1].text in (")", "]", "}"):
                start = self.partner[first - 1]
                if self.tokens[first - 1].text == "}" and self.is_block(start):
                    break
                before = start - 1
                if self.tokens[before].text == "constexpr":
                    before -= 1
                if self.tokens[first - 1].text == ")" and self.tokens[before].text in ("if", "for", "while", "switch"):
                    break
                first = start
            else:
                first -= 1
        while last + 1 < len(self.tokens) and not self.is_bound(last + 1, logical) and self.tokens[last + 1].text not in (")", "]", "}"):
            if self.tokens[last + 1].text in ("(", "[", "{"):
                if self.tokens[last + 1].text == "{" and self.is_block(last + 1):
                    break
                last = self.partner[last + 1] - 1
            last += 1
        return first, last

    def is_run(self, i):
        """Whether the token is in code that runs, and not in a constant, type, template argument or assertion."""
        if self.in_template[i]:
            return False
        outer = self.outer[i]
        inside_function = False
        while outer is not None:
            before = self.tokens[outer - 1].text
            if self.tokens[outer].text == "(" and (before in UNEVALUATED or before == "constexpr"):
                return False
            inside_function = inside_function or (self.tokens[outer].text == "{" and before in (")", "const", "override", "noexcept", "]", "else", "do"))
            outer = self.outer[outer]
        k = i
        while k >= 0 and self.tokens[k].text not in (";", "{", "}"):
            if self.tokens[k].text in ("constexpr", "static_assert", "using", "enum", "case", "template", "requires", "operator", "typedef"):
                return False
            k -= 1
        return inside_function or self.in_initializer(i)

    def in_initializer(self, i):
        """Whether the token is in `: member(...)` of a constructor."""
        outer = self.outer[i]
        while outer is not None and self.tokens[outer].text != "{":
            name = outer - 1
            if self.tokens[outer].text == "(" and self.tokens[name].kind == "name" and self.tokens[name - 1].text in (":", ",") and self.begins_line(name - 1):
                return True
            outer = self.outer[outer]
        return False

    def statement(self, i):
        """The first and the last token of the expression statement that begins with token i, with its semicolon. None if token i does not begin such a
        statement."""
        before, token = self.tokens[i - 1], self.tokens[i]
        starts = before.text in (";", "else") or (before.text == "{" and self.is_block(i - 1)) or \
            (before.text == "}" and (i - 1) in self.partner and self.is_block(self.partner[i - 1])) or \
            (before.text == ")" and self.tokens[self.partner[i - 1] - 1].text in ("if", "for", "while"))
        if not starts or (self.outer[i] is not None and self.tokens[self.outer[i]].text != "{"):
            return None
        end = i
        while end < len(self.tokens) and self.tokens[end].text != ";":
            if self.tokens[end].text in ("(", "[", "{"):
                if end not in self.partner or (self.tokens[end].text == "{" and self.begins_line(end)):
                    return None
                end = self.partner[end]
            elif self.tokens[end].text in (")", "]", "}"):
                return None
            end += 1
        text = self.text[token.start:self.tokens[end].end] if end < len(self.tokens) else ""
        head = re.match(r"(\+\+|--|\*|\()?([A-Za-z_][\w:]*)(<[^;()]*>)?(\.|->|\(|\[| [-+*/|&]?= |;)", text)
        if not head or head.group(2) in BOUND_NAMES | {"if", "for", "while", "using", "break", "continue", "switch", "auto", "double"} or \
                NO_RESULT.search(text) or (head.group(2)[0].isupper() and head.group(4) == "("):
            return None
        return i, end

    def mutant(self, i, new, slot, statement, kind):
        start, end = self.tokens[slot[0]].start, self.tokens[slot[1]].end
        edit = (start, end) if kind == "dropped statement" else (self.tokens[i].start, self.tokens[i].end)
        return Mutant(self.name, self.line(edit[0]), edit, new, (start, end), statement, kind)

    def operator(self, i):
        """Mutants of an operator."""
        token, before = self.tokens[i], self.tokens[i - 1]
        spaced = self.blank(token.start - 1) and self.blank(token.end)
        operand = before.kind in ("number", "name") and before.text not in BOUND_NAMES or before.text in (")", "]")
        is_text = token.text == "+" and "string" in (before.kind, self.tokens[i + 1].kind)
        if token.text in BINARY and spaced and operand and not is_text:
            slot = self.slot(i, i, token.text not in ("&&", "||"))
            for new in BINARY[token.text]:
                yield self.mutant(i, new, slot, False, "operator")
        elif token.text == "-" and not operand and not self.blank(token.end):
            yield self.mutant(i, " ", self.slot(i, i, True), False, "sign")
        elif token.text == "!":
            yield self.mutant(i, " ", self.slot(i, i, True), False, "negation")

    def is_length(self, i):
        """Whether the token stands in the brackets of an array's declaration."""
        outer = self.outer[i]
        if outer is None or self.tokens[outer].text != "[":
            return False
        while self.tokens[outer - 1].text == "]":
            outer = self.partner[outer - 1]
        name, before = self.tokens[outer - 1], self.tokens[outer - 2]
        return name.text == ")" or (name.kind == "name" and (before.text in (">", "&", "*") or before.kind == "name") and before.text not in BOUND_NAMES
                                    and self.blank(name.start - 1) or (before.text == "," and self.in_declaration(outer - 2)))

    def in_declaration(self, i):
        """Whether the statement of token i begins with a type."""
        while i > 0 and self.tokens[i].text not in (";", "{", "}"):
            i -= 1
        first = self.text[self.tokens[i + 1].start:self.tokens[i + 1].start + 80]
        return re.match(r"[A-Za-z_][\w:]*(<[^;()]*>)?\s+[A-Za-z_]\w*[\[,;{]", first) is not None

    def literal(self, i):
        """Mutants of a number."""
        if self.is_length(i):
            return
        match = re.fullmatch(r"(\d+)([uUlL]*)", self.tokens[i].text)
        if match:
            value, suffix = int(match.group(1)), match.group(2)
            for new in {value + 1, value - 1 if value > 1 else value + 1}:
                yield self.mutant(i, f"{new}{suffix}", (i, i), False, "integer")
        elif re.search(r"[.eE]", self.tokens[i].text):
            value = float(self.tokens[i].text.rstrip("fFlL"))
            # Smaller numbers are bounds of round-off, and are not mutated.
            if value == 0 or value > 1e-4:
                yield self.mutant(i, f"(2 * {self.tokens[i].text})" if value else "1.", (i, i), False, "factor")

    def indices(self, i):
        """Mutants that exchange two indices: x[i][j] becomes x[j][i]."""
        texts = [token.text for token in self.tokens[i:i + 6]]
        if len(texts) == 6 and texts[0] == texts[3] == "[" and texts[2] == texts[5] == "]" and texts[1] != texts[4] and \
                all(self.tokens[k].kind in ("name", "number") for k in (i + 1, i + 4)):
            first = i
            while first > 0 and (self.tokens[first - 1].text in (".", "->", "::") or self.tokens[first - 1].kind == "name") and \
                    self.tokens[first - 1].text not in BOUND_NAMES and not self.blank(self.tokens[first].start - 1):
                first -= 1
            if first < i and self.tokens[first - 1].kind != "name":
                slot = (self.tokens[first].start, self.tokens[i + 5].end)
                yield Mutant(self.name, self.line(slot[0]), (self.tokens[i].start, slot[1]), f"[{texts[4]}][{texts[1]}]", slot, False, "indices")

    def mutants(self):
        """All mutants of the file: a list of alternatives for each place."""
        for i in range(1, len(self.tokens)):
            token, found = self.tokens[i], []
            if not self.is_run(i):
                continue
            if token.kind == "sign" and token.text in BINARY or token.text == "!":
                found += self.operator(i)
            elif token.text == "[":
                found += self.indices(i)
            elif token.kind == "number":
                found += self.literal(i)
            elif token.kind == "name" and token.text in NAMES:
                found.append(self.mutant(i, NAMES[token.text], self.slot(i, i, True), False, "name"))
            if found:
                yield found
            statement = self.statement(i)
            if statement:
                yield [self.mutant(i, "", statement, True, "dropped statement")]
                for k in range(statement[0], statement[1]):
                    if self.tokens[k].text in UPDATES and self.outer[k] == self.outer[i]:
                        yield [self.mutant(k, new, statement, True, "update") for new in UPDATES[self.tokens[k].text]]


def one_line(text):
    return " ".join(text.split())


def shown(source, mutant):
    """Two texts: the original code of the slot, and its code with the mutant."""
    (start, end), (first, last) = mutant.slot, mutant.edit
    return one_line(source.text[start:end]), one_line(source.text[start:first] + mutant.new + source.text[last:end])


def with_mutants(source, numbered):
    """Writes mutants (a dictionary number -> mutant) into a source. Returns its text, and for each line the set of numbers of mutants in it."""
    slots = collections.defaultdict(list)
    for number, mutant in sorted(numbered.items()):
        slots[(mutant.slot, mutant.statement)].append(number)
    ordered = sorted(slots, key=lambda slot: (slot[0][0], -slot[0][1], not slot[1]))
    pieces, lines, line = [], collections.defaultdict(set), 1

    def write(text, numbers=()):
        nonlocal line
        for number in numbers:
            for k in range(text.count("\n") + 1):
                lines[line + k].add(number)
        line += text.count("\n")
        pieces.append(text)

    def render(start, end, inner, numbers):
        while inner:
            (slot, statement), rest = inner[0], inner[1:]
            inside = [other for other in rest if other[0][1] <= slot[1]]
            write(source.code[start:slot[0]], numbers)
            here = slots[inner[0]]
            for number in here:
                mutated = shown(source, numbered[number])[1]
                write(f"\n{'{ ' if number == here[0] and statement else '('}" if number == here[0] else "\n", numbers)
                write(f"if (corotet_mutant({number})) {{ {mutated} }} else" if statement else f"corotet_mutant({number}) ? ({mutated}) :", (number,))
            write("\n{ " if statement else "\n(", numbers)
            render(slot[0], slot[1], inside, [*numbers, *here])
            write(" } }" if statement else "))", numbers)
            start, inner = slot[1], rest[len(inside):]
        write(source.code[start:end], numbers)

    write("#include <corotet/mutant.h>\n")
    render(0, len(source.code), ordered, [])
    return "".join(pieces), lines
