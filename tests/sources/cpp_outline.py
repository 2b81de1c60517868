"""What a C++ file defines, as far as rules about its layout need to know: functions with their lines and parameters, and
the names that its anonymous namespaces define.

No compiler is asked: the file is split into tokens, and scopes are told apart by what stands before their brace. That
suffices for code that clang-format has laid out and that defines nothing by macros of its own.
"""

import re
from dataclasses import dataclass

TOKEN = re.compile(
    r"""(?P<skip>\s+|//[^\n]*|/\*.*?\*/|^[ \t]*\#(?:[^\n\\]|\\.|\\\n)*)
      |(?P<raw>(?:u8|[uUL])?R"(?P<delimiter>[^(\s]*)\(.*?\)(?P=delimiter)")
      |(?P<string>(?:u8|[uUL])?"(?:[^"\\\n]|\\.)*")
      |(?P<number>\.?\d(?:[eEpP][+-]|'?[\w.])*)
      |(?P<character>[uUL]?'(?:[^'\\\n]|\\.)+')
      |(?P<name>[A-Za-z_]\w*)
      |(?P<sign>::|->\*?|\.\.\.|<=>|[<>=!+\-*/%&|^]=|&&|\|\||\+\+|--|.)""",
    re.VERBOSE | re.DOTALL | re.MULTILINE,
)

CLOSING = {"(": ")", "[": "]", "{": "}"}
# What may stand before a parenthesis that opens no list of parameters.
NO_FUNCTION = {"decltype", "alignas", "noexcept", "requires", "explicit", "__attribute__", "sizeof", "static_assert"}
# What may stand between a list of parameters and the body.
AFTER_PARAMETERS = {"const", "noexcept", "override", "final", "&", "&&", "->", "requires", "mutable", "="}


@dataclass(frozen=True)
class Token:
    kind: str
    text: str
    line: int


@dataclass(frozen=True)
class Function:
    """A function or lambda: `lines` from the first of its declaration to its last brace, 0 without a body."""

    name: str
    line: int
    lines: int
    parameters: int


@dataclass(frozen=True)
class HiddenName:
    """A name that an anonymous namespace defines. `meaning` has the types of a function's parameters, or what another name
    stands for; two definitions of a name go together if both have meanings, and these differ (functions) or not (names)."""

    name: str
    kind: str  # "function", "alias", or "" for what may be defined only once
    meaning: str
    line: int


def tokens_of(text):
    tokens, line = [], 1
    for match in TOKEN.finditer(text):
        kind, found = match.lastgroup, match.group()
        if match.group("raw") is not None:
            kind = "string"
        if kind != "skip":
            tokens.append(Token(kind, found, line))
        line += found.count("\n")
    return tokens


class Outline:
    """All functions of a file, declared or defined, its lambdas, and the names that are hidden in it."""

    def __init__(self, text):
        self.functions = []
        self.hidden = []
        self._tokens = tokens_of(text)
        self._match()
        self._scope(0, len(self._tokens), hidden=False, in_class=False)
        self._lambdas()

    def _match(self):
        """For each opening bracket the place of its closing one, and the reverse."""
        self._partner, open_at = {}, []
        for i, token in enumerate(self._tokens):
            if token.kind != "sign":
                continue
            if token.text in CLOSING:
                open_at.append(i)
            elif token.text in CLOSING.values():
                begin = open_at.pop() if open_at else None
                if begin is None or CLOSING[self._tokens[begin].text] != token.text:
                    raise ValueError(f"line {token.line}: {token.text} closes nothing")
                self._partner[begin], self._partner[i] = i, begin
        if open_at:
            raise ValueError(f"line {self._tokens[open_at[-1]].line}: a bracket stays open")

    def _text(self, i):
        return self._tokens[i].text if 0 <= i < len(self._tokens) else ""

    def _scope(self, begin, end, hidden, in_class):
        """The declarations of a namespace or class between two places."""
        i = begin
        while i < end:
            text = self._text(i)
            if text in (";", "}"):
                i += 1
            elif text in ("public", "private", "protected") and self._text(i + 1) == ":":
                i += 2
            else:
                i = self._declaration(i, end, hidden, in_class)

    def _after_template(self, i):
        """The place after `template <...>` and a `requires (...)` behind it."""
        while self._text(i) == "template":
            i = self._after_angles(i + 1)
            while self._text(i) == "requires":
                i = self._partner[i + 1] + 1 if self._text(i + 1) == "(" else self._after_angles(i + 2)
        return i

    def _after_angles(self, i):
        depth = 0
        while i < len(self._tokens):
            text = self._text(i)
            if text in ("(", "[", "{"):
                i = self._partner[i]
            elif text == "<":
                depth += 1
            elif text == ">":
                depth -= 1
                if depth == 0:
                    return i + 1
            i += 1
        return i

    def _declaration(self, begin, end, hidden, in_class):
        """Reads one declaration. Returns the place behind it."""
        first = self._after_template(begin)
        text = self._text(first)
        if text == "inline" and self._text(first + 1) == "namespace":
            first, text = first + 1, "namespace"
        if text == "namespace" or (text == "extern" and self._tokens[first + 1].kind == "string"):
            brace = first
            while self._text(brace) not in ("{", ";"):
                brace += 1
            if self._text(brace) == ";":
                return brace + 1
            anonymous = text == "namespace" and brace == first + 1
            self._scope(brace + 1, self._partner[brace], hidden or anonymous, in_class=False)
            return self._partner[brace] + 1
        if text in ("using", "typedef", "friend", "static_assert", "concept"):
            if text == "using" and self._text(first + 2) == "=" and hidden and not in_class:
                after = self._to_semicolon(first, end)
                self._hide(self._tokens[first + 1], "alias", " ".join(self._text(i) for i in range(first + 3, after - 1)))
            return self._to_semicolon(first, end)
        if text in ("class", "struct", "union", "enum"):
            return self._type(first, end, hidden, in_class)
        return self._function_or_variable(begin, first, end, hidden, in_class)

    def _hide(self, token, kind="", meaning=""):
        self.hidden.append(HiddenName(token.text, kind, meaning, token.line))

    def _to_semicolon(self, i, end):
        while i < end and self._text(i) != ";":
            i = self._partner[i] if self._text(i) in CLOSING else i
            i += 1
        return i + 1

    def _type(self, first, end, hidden, in_class):
        """A class or an enumeration, or what has the type of one."""
        i, name = first + 1, None
        while i < end and self._text(i) not in ("{", ";", "=", "("):
            if self._text(i) == "[":
                i = self._partner[i]
            elif self._text(i) == "<":
                i = self._after_angles(i) - 1
            elif name is None and self._tokens[i].kind == "name" and self._text(i) not in ("class", "struct", "alignas"):
                name = self._tokens[i]
            i += 1
        if self._text(i) == "(":
            return self._function_or_variable(first, first, end, hidden, in_class)
        if self._text(i) != "{":
            return self._to_semicolon(first, end)
        if hidden and not in_class and name is not None and self._text(first + 2) != "::":
            self._hide(name)
        if self._text(first) != "enum":
            self._scope(i + 1, self._partner[i], hidden, in_class=True)
        return self._to_semicolon(self._partner[i], end)

    def _function_or_variable(self, begin, first, end, hidden, in_class):
        i, parameters, operator = first, None, None
        while i < end and self._text(i) not in ("{", ";", "=", ":"):
            text = self._text(i)
            if text == "(" and parameters is None and (i == operator or self._opens_parameters(i)):
                if self._text(i - 1) == "operator":  # operator()
                    i = self._partner[i] + 1
                parameters = i
                i = self._end_of_head(self._partner[i] + 1, end)
                break
            if text == "operator" and self._text(i + 1) != "(":
                i = i + 1
                while self._text(i) not in ("(", ";"):
                    i += 1
                operator = i
                continue
            if text == "<":
                i = self._after_angles(i)
                continue
            if text in CLOSING:
                i = self._partner[i]
            i += 1
        if parameters is None:
            if hidden and not in_class and self._tokens[i - 1].kind in ("name", "sign") and i > first + 1:
                self._hide_variable(first, i)
            return self._to_semicolon(i, end)
        name = self._name_before(parameters)
        count = self._count(parameters)
        line = self._tokens[begin].line
        if self._text(i) != "{":
            self.functions.append(Function(name, line, 0, count))
            return self._to_semicolon(i, end)
        close = self._partner[i]
        self.functions.append(Function(name, line, self._tokens[close].line - line + 1, count))
        if hidden and not in_class and "::" not in name:
            self._hide(self._tokens[parameters - 1], "function", self._types(parameters))
        self._local_types(i + 1, close)
        return close + 1

    def _hide_variable(self, first, end):
        """The variables of a declaration, the first of which ends before `end`."""
        i = end - 1
        while i > first and self._text(i) in ("]", ")"):
            i = self._partner[i] - 1
        if self._tokens[i].kind != "name" or self._text(i - 1) == "::":
            return
        self._hide(self._tokens[i])
        i = end
        while self._text(i) != ";":
            if self._text(i) == "," and self._tokens[i + 1].kind == "name" and self._text(i + 2) in ("=", "{", ",", ";"):
                self._hide(self._tokens[i + 1])
            i = self._partner[i] + 1 if self._text(i) in CLOSING else i + 1

    def _opens_parameters(self, i):
        before = self._text(i - 1)
        if before in NO_FUNCTION:
            return False
        return self._tokens[i - 1].kind == "name" or before in ("operator", ">")

    def _end_of_head(self, i, end):
        """From behind the parameters to the body, or to what stands in its place."""
        while i < end and self._text(i) not in ("{", ";", "="):
            text = self._text(i)
            if text == ":":  # members that a constructor initialises
                i += 1
                while True:
                    while self._text(i) not in ("(", "{"):
                        i = self._after_angles(i) if self._text(i) == "<" else i + 1
                    i = self._partner[i] + 1
                    if self._text(i) == "...":
                        i += 1
                    if self._text(i) != ",":
                        return i
                    i += 1
            i = self._partner[i] + 1 if text in ("(", "[") else i + 1
        return i

    def _name_before(self, parameters):
        i = parameters - 1
        name = self._text(i)
        while self._text(i - 1) in ("::", "~", "operator"):
            i -= 1
            name = self._text(i) + name
            if self._text(i) == "::" and self._tokens[i - 1].kind == "name":
                i -= 1
                name = self._text(i) + name
        return name

    def _parts(self, begin):
        """The places of the tokens of each parameter of a list that opens at `begin`."""
        parts, now, depth, i = [], [], 0, begin + 1
        while i < self._partner[begin]:
            text = self._text(i)
            if text in CLOSING:
                now.extend(range(i, self._partner[i] + 1))
                i = self._partner[i] + 1
                continue
            depth += (text == "<") - (text == ">")
            if text == "," and depth == 0:
                parts.append(now)
                now = []
            else:
                now.append(i)
            i += 1
        if now:
            parts.append(now)
        return [] if parts and [self._text(k) for k in parts[0]] == ["void"] else parts

    def _count(self, begin):
        return len(self._parts(begin))

    def _types(self, begin):
        """The parameters' types, one after the other."""
        types = []
        for part in self._parts(begin):
            texts = [self._text(k) for k in part]
            if "=" in texts:
                texts = texts[: texts.index("=")]
            if len(texts) > 1 and self._tokens[part[len(texts) - 1]].kind == "name" and texts[-2] != "::":
                texts.pop()
            types.append(" ".join(texts))
        return "(" + ", ".join(types) + ")"

    def _local_types(self, begin, end):
        """Classes within a function, whose members are functions too."""
        i = begin
        while i < end:
            if self._text(i) in ("struct", "class") and self._text(i - 1) in (";", "{", "}"):
                i = self._type(i, end, hidden=False, in_class=True)
            else:
                i += 1

    def _lambdas(self):
        for i, token in enumerate(self._tokens):
            if token.text != "[" or token.kind != "sign" or self._text(i + 1) == "[" or self._text(i - 1) == "[":
                continue
            before = self._tokens[i - 1] if i > 0 else None
            is_index = before and (before.kind in ("name", "string") or before.text in (")", "]", "}", "operator"))
            if is_index and before.text != "return":
                continue
            after, count = self._partner[i] + 1, 0
            if self._text(after) == "<":
                after = self._after_angles(after)
            if self._text(after) == "(":
                count = self._count(after)
                after = self._partner[after] + 1
                while self._text(after) not in ("{", ";", ")", ","):
                    after = self._partner[after] + 1 if self._text(after) == "(" else after + 1
            if self._text(after) == "{":
                lines = self._tokens[self._partner[after]].line - token.line + 1
                self.functions.append(Function("lambda", token.line, lines, count))
