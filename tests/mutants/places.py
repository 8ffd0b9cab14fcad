"""Where C++ sources can be changed, and how: found by libclang in the sources of a room, compiled as the build compiles them.

A change is a number of edits of one file; each edit puts something instead of a range of bytes, in which {old} stands for
what is there and {n} for the change's number. With its switch off a changed program does what it did.
"""
import bisect
import glob
import json
import re
import shlex
import sys

operators = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "+": "-", "-": "+", "*": "/", "/": "*",
             "&&": "||", "||": "&&"}
opposite = {"<": ">=", "<=": ">", ">": "<=", ">=": "<"}
compound = {"+=": "-=", "-=": "+=", "*=": "/=", "/=": "*="}
# What gives the same either way round, and what changes nothing that can be seen.
symmetric = {"min", "max", "swap", "hypot", "dot", "distance", "fmin", "fmax", "minmax", "equal", "gcd", "lcm"}
without_effect = {"reserve", "shrink_to_fit", "reset_statement"}
longest_change = 400


def clang():
    """The bindings of libclang, or an end with the name of the package that has them."""
    try:
        import clang.cindex as bindings
    except ImportError:
        sys.path.append("/usr/lib/python3/dist-packages")
        try:
            import clang.cindex as bindings
        except ImportError:
            sys.exit("drawn changes are found with libclang, whose Python package is missing: apt install python3-clang")
    if not bindings.Config.loaded:
        library = library_of_bindings()
        if library:
            bindings.Config.set_library_file(library)
    return bindings


def library_of_bindings():
    """libclang of the bindings' own version, since the numbers of its kinds change from one to the next. Empty where Debian's
    package of the bindings is not there: others bring their library or find it."""
    versions = [int(path.rsplit("-", 1)[1]) for path in glob.glob("/usr/share/doc/python3-clang-[0-9]*")]
    for version in sorted(versions, reverse=True):
        for library in sorted(glob.glob(f"/usr/lib/llvm-{version}/lib/libclang-*.so.1")
                              + glob.glob(f"/usr/lib/llvm-{version}/lib/libclang.so.1")):
            return library
    return ""


class Change:
    def __init__(self, file, kind, function, line, last_line, before, after, edits):
        self.file, self.kind, self.function = file, kind, function
        self.line, self.last_line = line, last_line
        self.before, self.after, self.edits = before, after, edits

    def key(self):
        return (self.file, self.function, self.before, self.after)


class Source:
    """A source, its tokens without comments, and the ranges in which macros stand."""

    def __init__(self, path, name):
        self.path, self.name = path, name
        self.bytes = open(path, "rb").read()
        self.tokens, self.macros, self.constants = [], [], set()

    def inside(self, start, end):
        """The tokens of a range."""
        first = bisect.bisect_left(self.tokens, (start,))
        last = first
        while last < len(self.tokens) and self.tokens[last][1] <= end:
            last += 1
        return self.tokens[first:last]

    def words(self, start, end):
        return [word for _, _, word in self.inside(start, end)]

    def text(self, start, end):
        """The range in one line, without comments and line breaks."""
        parts, stopped = [], None
        for at, stop, word in self.inside(start, end):
            if stopped is not None and at > stopped:
                parts.append(" ")
            parts.append(word)
            stopped = stop
        return "".join(parts)

    def line(self, at):
        return self.bytes.count(b"\n", 0, at) + 1

    def has_macro(self, start, end):
        return any(first < end and last > start for first, last in self.macros)

    def word_before(self, at):
        first = bisect.bisect_left(self.tokens, (at,))
        return self.tokens[first - 1][2] if first else ""

    def word_after(self, at):
        first = bisect.bisect_left(self.tokens, (at,))
        return self.tokens[first][2] if first < len(self.tokens) else ""


class Finder:
    def __init__(self, sources):
        self.sources, self.changes = sources, []
        self.kinds = clang().CursorKind
        types = clang().TypeKind
        self.whole = {types.BOOL, types.CHAR_U, types.UCHAR, types.USHORT, types.UINT, types.ULONG, types.ULONGLONG, types.CHAR_S,
                      types.SCHAR, types.SHORT, types.INT, types.LONG, types.LONGLONG}
        self.broken = {types.FLOAT, types.DOUBLE, types.LONGDOUBLE}
        self.boolean = types.BOOL
        k = self.kinds
        self.functions = {k.FUNCTION_DECL, k.CXX_METHOD, k.CONSTRUCTOR, k.DESTRUCTOR, k.CONVERSION_FUNCTION}
        self.left_alone = {k.FUNCTION_TEMPLATE, k.CLASS_TEMPLATE, k.CLASS_TEMPLATE_PARTIAL_SPECIALIZATION, k.STATIC_ASSERT,
                           k.ENUM_DECL, k.PARM_DECL, k.FIELD_DECL, k.TYPE_ALIAS_DECL, k.TYPEDEF_DECL, k.TYPE_REF,
                           k.TEMPLATE_REF}

    def numeric(self, cursor, classes=False):
        type = cursor.type.get_canonical()
        return type.kind in self.whole | self.broken or classes and type.spelling.replace("const ", "").startswith("glm::vec<")

    def is_broken(self, cursor):
        return cursor.type.get_canonical().kind in self.broken

    def add(self, source, kind, function, start, end, instead, after, extra=(), before=None):
        """`instead`: what stands there in the changed program, with {old} and {n}; `after`: what it amounts to."""
        if source.has_macro(start, end) or len(after) > longest_change or "{" in after and "[" in after and "](" in after:
            return
        before = source.text(start, end) if before is None else before
        self.changes.append(Change(source.name, kind, function, source.line(start), source.line(end), before, after,
                                   [(start, end, kind == "statement", instead)] + list(extra)))

    def instead_of(self, source, kind, function, start, end, other, extra=()):
        plain = other.replace("{", "{{").replace("}", "}}")
        self.add(source, kind, function, start, end, "(overt_mutant({n}) ? (" + plain + ") : ({old}))", other, extra)

    def visit(self, cursor, parent, function, extra=()):
        k = self.kinds
        try:
            kind = cursor.kind
        except ValueError:  # what the bindings have no name for, such as a concept in those of clang 16
            return
        if kind in self.left_alone:
            return
        place = cursor.extent.start.file
        source = self.sources.get(place.name) if place else None
        if source is None:
            if kind in (k.NAMESPACE, k.LINKAGE_SPEC, k.UNEXPOSED_DECL, k.TRANSLATION_UNIT):
                for child in cursor.get_children():
                    self.visit(child, cursor, function)
            return
        start, end = cursor.extent.start.offset, cursor.extent.end.offset
        if kind in self.functions:
            if not cursor.is_definition():
                return
            words = source.words(start, end)
            if {"constexpr", "consteval"} & set(words[:words.index("(")] if "(" in words else words):
                return
            owner = cursor.semantic_parent.spelling if cursor.semantic_parent.kind in (k.CLASS_DECL, k.STRUCT_DECL) else ""
            function = (owner + "::" if owner else "") + cursor.spelling
        elif kind == k.VAR_DECL:
            words = source.words(start, end)
            if "constexpr" in words[:3]:
                # A number with a name: no longer known to the compiler, and so only where none is asked for.
                if not self.numeric(cursor) or extra:
                    return
                at = next(first for first, _, word in source.inside(start, end) if word == "constexpr")
                extra = [(at, at + len("constexpr"), False, "const")]
                function = function or cursor.spelling
            elif not function:
                return
        if function and kind not in self.functions:
            self.look(cursor, parent, source, function, start, end, extra)
        children = list(cursor.get_children())
        if kind == k.CASE_STMT:
            children = children[1:]
        if kind == k.IF_STMT and source.words(start, end)[1:2] == ["constexpr"]:
            children = children[1:]
        for child in children:
            self.visit(child, cursor, function, extra)

    def look(self, cursor, parent, source, function, start, end, extra):
        k = self.kinds
        kind = cursor.kind
        children = list(cursor.get_children())
        if kind == k.BINARY_OPERATOR and len(children) == 2:
            self.binary(children[0], children[1], source, function, start, end, extra)
        elif kind == k.COMPOUND_ASSIGNMENT_OPERATOR and len(children) == 2:
            left, right = children
            word = source.word_after(left.extent.end.offset)
            if word in compound and self.numeric(left) and self.numeric(right):
                a, b = self.both(source, left, right)
                self.instead_of(source, "arithmetic", function, start, end, f"{a} {compound[word]} {b}")
        elif kind == k.UNARY_OPERATOR and len(children) == 1:
            word = source.word_after(start)
            inner = source.text(children[0].extent.start.offset, end)
            if word == "-" and self.numeric(cursor):
                self.instead_of(source, "sign", function, start, end, inner, extra)
            elif word == "!":
                self.instead_of(source, "negation", function, start, end, f"!!({inner})")
        elif kind in (k.INTEGER_LITERAL, k.FLOATING_LITERAL):
            self.constant(cursor, source, function, start, end, extra)
        elif kind == k.CALL_EXPR:
            self.call(cursor, source, function, start, end, extra)
        elif kind == k.IF_STMT or kind == k.CONDITIONAL_OPERATOR:
            self.condition(children, source, function)
        elif kind == k.RETURN_STMT and children and children[0].type.get_canonical().kind == self.boolean:
            self.negated(children[0], source, "returned", function)
        elif kind in (k.FOR_STMT, k.CXX_FOR_RANGE_STMT) and children and children[-1].kind == k.COMPOUND_STMT:
            body = children[-1].extent
            last = body.end.offset - 1
            self.add(source, "loop", function, last, last, "if (overt_mutant({n})) break; ", "break; }",
                     before="} of " + source.text(start, body.start.offset))
        if parent.kind in (k.COMPOUND_STMT, k.IF_STMT, k.FOR_STMT, k.CXX_FOR_RANGE_STMT):
            self.statement(cursor, parent, children, source, function, start, end)

    def both(self, source, left, right):
        return (source.text(left.extent.start.offset, left.extent.end.offset),
                source.text(right.extent.start.offset, right.extent.end.offset))

    def binary(self, left, right, source, function, start, end, extra):
        word = source.word_after(left.extent.end.offset)
        if word not in operators:
            return
        a, b = self.both(source, left, right)
        if not a or not b:
            return
        if word in ("&&", "||"):
            return self.instead_of(source, "and, or", function, start, end, f"({a}) {operators[word]} ({b})", extra)
        if word in ("==", "!="):
            return self.instead_of(source, "comparison", function, start, end, f"{a} {operators[word]} {b}", extra)
        if not self.numeric(left, True) or not self.numeric(right, True):
            return
        if word in opposite:
            # Where measured numbers are compared with each other, they are alike by chance alone.
            number = re.compile(r"^[\d.']+[a-z]*$|^[a-z][a-z_0-9]*$")
            if not self.is_broken(left) or number.match(a) or number.match(b):
                self.instead_of(source, "bound", function, start, end, f"{a} {operators[word]} {b}", extra)
            return self.instead_of(source, "comparison", function, start, end, f"{a} {opposite[word]} {b}", extra)
        if not (word == "/" and not self.numeric(right)):
            self.instead_of(source, "arithmetic", function, start, end, f"({a}) {operators[word]} ({b})", extra)
        if left.type.get_canonical().spelling.replace("const ", "") == right.type.get_canonical().spelling.replace("const ", ""):
            self.instead_of(source, "term", function, start, end, a, extra)

    def constant(self, cursor, source, function, start, end, extra):
        text = source.text(start, end)
        if not text or not text[0].isdigit() and text[0] != ".":
            return
        if source.bytes[start - 1:start] == b"<" or source.bytes[end:end + 1] == b">":
            return
        if re.fullmatch(r"0[uUlLzZ]*", text):
            other = text.replace("0", "1", 1)
        elif re.fullmatch(r"1[uUlLzZ]*", text):
            other = text.replace("1", "0", 1)
        elif re.fullmatch(r"0*\.0*f?|0+\.0*f?", text):
            other = "1.0f" if text.endswith("f") else "1.0"
        elif cursor.kind == self.kinds.INTEGER_LITERAL:
            other = f"{text} + 1"
        else:
            other = f"2 * {text}"
        self.instead_of(source, "constant", function, start, end, other, extra)

    def call(self, cursor, source, function, start, end, extra):
        called = cursor.referenced
        name = cursor.spelling
        arguments = list(cursor.get_arguments())
        if name.startswith("operator"):
            if len(arguments) == 2 and all(self.numeric(each, True) or name in ("operator==", "operator!=") for each in arguments):
                left, right = arguments
                if source.word_after(left.extent.end.offset) == name[len("operator"):]:
                    self.binary(left, right, source, function, start, end, extra)
            return
        if called is None or called.kind == self.kinds.CONSTRUCTOR or name in symmetric or len(arguments) < 2:
            return
        spans = [(each.extent.start.offset, each.extent.end.offset) for each in arguments if each.extent.start.file]
        if len(spans) != len(arguments):
            return
        for i in range(len(arguments) - 1):
            one, other = spans[i], spans[i + 1]
            if not (start <= one[0] < one[1] <= other[0] < other[1] <= end):
                continue
            types = [re.sub(r"\bconst\b|&", "", each.type.get_canonical().spelling).strip() for each in arguments[i:i + 2]]
            a, b = source.text(*one), source.text(*other)
            if types[0] != types[1] or a == b or re.search(r"\[[&=\w]*\]\s*[({]|std::move|std::forward", a + b):
                continue
            text = source.text(start, one[0]) + b + ", " + a + source.text(other[1], end)
            if re.search(r"\[[&=]?\w*\]\s*[({]|std::move", text):
                continue
            self.instead_of(source, "arguments", function, start, end, text, extra)

    def condition(self, children, source, function):
        if children and children[0].kind.is_expression():
            self.negated(children[0], source, "condition", function)

    def negated(self, cursor, source, kind, function):
        start, end = cursor.extent.start.offset, cursor.extent.end.offset
        text = source.text(start, end)
        if text in ("true", "false") or not text:
            return
        self.add(source, kind, function, start, end, "(overt_mutant({n}) != static_cast<bool>({old}))", f"!({text})")

    def statement(self, cursor, parent, children, source, function, start, end):
        k = self.kinds
        if not cursor.kind.is_expression() or source.word_after(end) != ";":
            return
        if parent.kind != k.COMPOUND_STMT and source.word_before(start) not in (")", "else"):
            return
        text = source.text(start, end)
        word = source.word_after(start)
        if word in ("throw", "co_return", "co_yield") and parent.kind == k.COMPOUND_STMT or not text:
            return
        if any(f"{name}(" in text for name in without_effect) or text.startswith(("(void)", "static_cast<void>", "std::ignore")):
            return
        self.add(source, "statement", function, start, end, "if (overt_mutant({n})) {{}} else {old}", "")


def commands_of(build, targets):
    """What the sources of targets of CMake are compiled with: file and words of the compiler's command."""
    rows = json.loads((build / "compile_commands.json").read_text())
    wanted = [f"/{target}.dir/" for target in targets]
    return [(row["file"], row["directory"], shlex.split(row["command"])) for row in rows
            if any(folder in row["command"] for folder in wanted)]


def words_for_clang(root, command):
    words, skip = [], False
    for word in command[1:]:
        if skip:
            skip = False
        elif word in ("-o", "-c", "--param"):
            skip = True
        elif word.endswith("cmake_pch.hxx"):
            words.append(str(root / "cmake/precompiled.h"))
        elif word.startswith(("-W", "-fpch", "-ffp-contract")) or word.endswith(("ccache", "c++", "g++")):
            continue
        else:
            words.append(word)
    return words + ["-w"]


def find(root, name_of, file, words):
    """All changes of the sources that `file` is or includes and that `name_of(path)` gives a name."""
    bindings = clang()
    index = bindings.Index.create()
    unit = index.parse(file, args=words, options=bindings.TranslationUnit.PARSE_DETAILED_PROCESSING_RECORD)
    paths = {file} | {str(each.include) for each in unit.get_includes()}
    sources = {path: Source(path, name_of(path)) for path in sorted(paths) if name_of(path)}
    for path, source in sources.items():
        place = unit.get_file(path)
        extent = bindings.SourceRange.from_locations(bindings.SourceLocation.from_offset(unit, place, 0),
                                                     bindings.SourceLocation.from_offset(unit, place, len(source.bytes)))
        for token in unit.get_tokens(extent=extent):
            if token.kind != bindings.TokenKind.COMMENT:
                at = token.extent.start.offset
                source.tokens.append((at, at + len(token.spelling.encode()), token.spelling))
    finder = Finder(sources)
    for cursor in unit.cursor.get_children():
        if cursor.kind == bindings.CursorKind.MACRO_INSTANTIATION:
            place = cursor.extent.start.file
            if place and place.name in sources:
                sources[place.name].macros.append((cursor.extent.start.offset, cursor.extent.end.offset))
    for cursor in unit.cursor.get_children():
        finder.visit(cursor, unit.cursor, "")
    return finder.changes, {source.name: source.bytes for source in sources.values()}


def changed(text, changes):
    """The source with all changes in it, each behind its switch: `changes` gives each its number."""
    edits, seen = [], set()
    for number, change in changes:
        for start, end, outer, instead in change.edits:
            fixed = "{n}" not in instead
            if fixed and (start, end) in seen:
                continue
            if fixed:
                seen.add((start, end))
            edits.append((start, end, outer, instead, number))
    edits.sort(key=lambda edit: (edit[0], 0 if edit[0] == edit[1] else 1, -edit[1], not edit[2]))

    def written(start, end, inner):
        parts, at, i = [], start, 0
        while i < len(inner):
            first, last, _, instead, number = inner[i]
            parts.append(text[at:first])
            within = i + 1
            while within < len(inner) and inner[within][0] < last and inner[within][1] <= last:
                within += 1
            old = written(first, last, inner[i + 1:within])
            if "{n}" in instead:
                head, _, tail = instead.partition("{old}")
                parts.append(head.replace("{n}", str(number)).replace("{{", "{").replace("}}", "}").encode())
                if "{old}" in instead:
                    parts.append(old)
                parts.append(tail.replace("{{", "{").replace("}}", "}").encode())
            else:
                parts.append(instead.encode())
            at, i = last, within
        parts.append(text[at:end])
        return b"".join(parts)

    return written(0, len(text), edits)
