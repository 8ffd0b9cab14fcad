"""Reads what overt writes: read_study(FOLDER) gives its tables and meshes.

FOLDER is what `overt export SESSION... --out FOLDER` wrote (tsv, csv or jsonl; one session or several), what `overt
analyze SESSION... --out FOLDER` wrote, or a session's own folder. Needs nothing but Python 3.8; where pandas is
installed, tables are its DataFrames, else lists with a dict for each row. Missing values are None (pandas: NA).

    study = overt.read_study("tables")
    study.trials, study.answers, study.fixations, study.participants, study.stimuli
    overt.read_study("tables", samples=["x_px", "y_px", "part"]).samples
    study.table("steps")                    # any other table of the folder
    study.units["fixations"]["duration_s"]  # "s"
    study.meshes["muse"].vertices, .faces, .values["saliency"]
"""
import csv
import io
import json
import struct
import sys
from pathlib import Path

__all__ = ["Mesh", "Study", "StudyError", "read_mesh", "read_study"]

ENDINGS = ("tsv", "csv", "jsonl")
ROW_KEY = ("observer", "session", "session_folder", "trial")


class StudyError(Exception):
    """What cannot be read, in which file, and what helps."""


def read_study(folder, samples=False, attempts=False, pandas=None):
    """Gives the Study in `folder`.

    samples: True, or the names of the columns that are needed, as samples are many (those that name a row's trial come
    with them). attempts: with the trials also those attempts that do not count. pandas: whether tables are DataFrames;
    None: where pandas is installed. Raises StudyError.
    """
    folder = Path(folder)
    if not folder.is_dir():
        raise StudyError(f"{folder}: there is no such folder")
    if pandas is None:
        pandas = _has_pandas()
    parts = _parts_of(folder)
    if not parts:
        raise StudyError(f"{folder}: holds no tables of overt (dictionary.json beside them) and no session "
                         "(session.sqlite): give the folder that `overt export` or `overt analyze` wrote")
    return Study(folder, parts, samples, attempts, pandas)


class Study:
    """Tables of one or several sessions, one below the other.

    trials        those that count, with what they showed
    answers       what was answered, as it was asked (table given_answers), else the trial's one answer (responses)
    fixations     with their place on the surface, their part (the areas that they lie in) and what their trial showed
    samples       None unless read_study() was asked for them
    participants, stimuli
    meshes        by name, read when they are first asked for: of an analysis its maps (`overt analyze --meshes`), of
                  a session its objects
    units         by table and column, where it has one
    dictionary    by table and column: Description, Units, Levels, Format
    """

    def __init__(self, folder, parts, samples, attempts, pandas):
        self.folder, self._parts, self._pandas, self._meshes = folder, parts, pandas, None
        self.dictionary = {}
        self.samples = None
        trials = self._rows("trials")
        self.trials = self._frame("trials", trials if attempts else [row for row in trials if _counts(row)])
        self.answers = self._frame("answers", self._answers())
        self.fixations = self._frame("fixations", self._fixations(trials))
        self.participants = self._frame("participants", self._rows("participants", needed=False))
        self.stimuli = self._frame("stimuli", self._rows("stimuli", needed=False))
        if samples:
            self.samples = self.table("samples", None if samples is True else samples)
        self.units = {table: {name: what["Units"] for name, what in columns.items() if "Units" in what}
                      for table, columns in self.dictionary.items()}

    def table(self, name, columns=None):
        """Any table of the folder by the name of its file, without the ending; `columns`: only these."""
        return self._frame(name, self._rows(name, columns))

    @property
    def meshes(self):
        if self._meshes is None:
            self._meshes = {}
            for part in self._parts:
                for file in sorted(Path(part.folder, "meshes").glob("*.ply")):
                    self._meshes.setdefault(file.stem, read_mesh(file))
        return self._meshes

    def _rows(self, name, columns=None, needed=True):
        rows, is_there = [], False
        for part in self._parts:
            found = part.rows(name, columns)
            if found is None:
                continue
            is_there = True
            rows += found
            for column, what in part.columns(name).items():
                self.dictionary.setdefault(name, {}).setdefault(column, {}).update(what)
        if not is_there and needed:
            raise StudyError(f"{self.folder}: has no table {name}; {self._parts[0].remedy(name)}")
        return rows

    def _answers(self):
        if not any(part.has("given_answers") for part in self._parts):
            # An analysis has its trials' answers in a table of its own.
            name = next((name for name in ("answer_trials", "responses")
                         if any(part.has(name) for part in self._parts)), None)
            rows = self._rows(name) if name else []
            self.dictionary["answers"] = self.dictionary.get(name, {})
            return rows
        asked, plain = self._rows("given_answers"), self._rows("responses", needed=False)
        self.dictionary["answers"] = {**self.dictionary.get("responses", {}), **self.dictionary["given_answers"]}
        asked = [row for row in asked if _counts(row)]
        sessions = {(row["observer"], row["session"]) for row in asked}
        return asked + [row for row in plain if (row["observer"], row["session"]) not in sessions]

    def _fixations(self, trials):
        if any(part.has("fixations") for part in self._parts):
            return self._rows("fixations")
        events = [row for row in self._rows("gaze_events") if row["kind"] == "fixation"]
        slots = self._rows("presentations", needed=False)
        shown = {}
        for rows, key in ((trials, ROW_KEY), (slots, ROW_KEY + ("slot",))):
            for row in rows:
                if _counts(row):
                    shown[tuple(row.get(name) for name in key)] = {
                        name: row[name] for name in _design_columns(row) if name in row}
        self.dictionary["fixations"] = {**self.dictionary["gaze_events"],
                                        **{name: what for name, what in self.dictionary["trials"].items()
                                           if name in _design_columns(trials[0] if trials else {})}}
        joined = []
        for row in events:
            of_trial = tuple(row.get(name) for name in ROW_KEY)
            design = {**shown.get(of_trial, {}), **shown.get(of_trial + (row.get("slot"),), {})}
            joined.append({**row, **{name: value for name, value in design.items() if name not in row}})
        return joined

    def _frame(self, name, rows):
        names = list(self.dictionary.get(name, {}))
        if rows:
            held = {column for row in rows for column in row}
            names = [column for column in names if column in held] + [
                column for column in dict.fromkeys(column for row in rows for column in row) if column not in
                self.dictionary.get(name, {})]
        rows = [{column: row.get(column) for column in names} for row in rows]
        if not self._pandas:
            return rows
        import pandas
        frame = pandas.DataFrame(rows, columns=names)
        for column in names:
            form = self.dictionary.get(name, {}).get(column, {}).get("Format")
            if form == "integer":
                frame[column] = frame[column].astype("Int64" if frame[column].isna().any() else "int64")
            elif form == "number":
                frame[column] = frame[column].astype("float64")
        frame.attrs["units"] = {column: what["Units"] for column, what in self.dictionary.get(name, {}).items()
                                if "Units" in what and column in names}
        return frame


def _has_pandas():
    try:
        import pandas  # noqa: F401
        return True
    except ImportError:
        return False


def _counts(row):
    return row.get("counts", "yes") != "no"


def _design_columns(row):
    """What a trial showed stands between its question and how it ended; a presentation says its slot's."""
    names = list(row)
    if "task" not in names:
        return names[names.index("slot") + 1:] if "slot" in names else []
    end = names.index("status") if "status" in names else names.index("excluded") if "excluded" in names else len(names)
    return names[names.index("task"):end]


def _parts_of(folder, depth=3):
    """The folders with tables, or the sessions, in the order of their names."""
    if (folder / "dictionary.json").is_file():
        return [_Tables(folder)]
    if (folder / "session.sqlite").is_file():
        return [_Session(folder)]
    parts = []
    if depth > 0:
        for inner in sorted(folder.iterdir()):
            if inner.is_dir() and not inner.name.startswith("."):
                parts += _parts_of(inner, depth - 1)
    return parts


class _Tables:
    """A folder of tables with its dictionary."""

    def __init__(self, folder):
        self.folder = folder
        file = folder / "dictionary.json"
        try:
            dictionary = json.loads(file.read_text(encoding="utf-8"))
        except ValueError as reason:
            raise StudyError(f"{file}: is damaged ({reason}): write the tables again") from None
        self.is_analysis = "Files" not in dictionary
        self._files = dictionary if self.is_analysis else dictionary["Files"]

    def _file(self, name):
        for ending in ENDINGS:
            if (self.folder / f"{name}.{ending}").is_file():
                return self.folder / f"{name}.{ending}"
        return None

    def has(self, name):
        return self._file(name) is not None

    def columns(self, name):
        file = self._file(name)
        return self._files.get(file.name, {}).get("Columns", {}) if file else {}

    def remedy(self, name):
        return ("an analysis has no such table: read what `overt export` wrote of its sessions" if self.is_analysis
                else "export the sessions again with this version of overt")

    def rows(self, name, columns=None):
        file = self._file(name)
        if not file:
            return None
        dictionary = self.columns(name)
        lines = _cells(file)
        names = next(lines, [])
        if columns is not None:
            absent = [column for column in columns if column not in names]
            if absent and names:
                raise StudyError(f"{file}: has no column {absent[0]}; it has {', '.join(names)}")
        wanted = [i for i, column in enumerate(names) if columns is None or column in columns or column in ROW_KEY]
        casts = {i: _cast_of(names[i], dictionary.get(names[i], {})) for i in wanted}
        rows = []
        for line, cells in enumerate(lines, 2):
            if len(cells) != len(names):
                raise StudyError(f"{file}:{line}: {len(cells)} cells where there are {len(names)} columns: the file "
                                 "was cut off or changed; write the tables again")
            row = {}
            for i in wanted:
                try:
                    row[names[i]] = casts[i](cells[i])
                except ValueError:
                    raise StudyError(f"{file}:{line}: {names[i]} is {cells[i]!r}, and no number as dictionary.json "
                                     "says: the file was changed; write the tables again") from None
            rows.append(row)
        return rows


def _cells(file):
    """The names of the columns, then the cells of each row: texts, or None; of jsonl the values."""
    with open(file, encoding="utf-8", newline="") as stream:
        if file.suffix == ".jsonl":
            for line, text in enumerate(stream, 1):
                try:
                    row = json.loads(text)
                except ValueError:
                    raise StudyError(f"{file}:{line}: is no JSON: write the tables again") from None
                if line == 1:
                    yield list(row)
                yield list(row.values())
        elif file.suffix == ".csv":
            for cells in csv.reader(stream):
                yield [None if cell == "n/a" else _without_guard(cell) for cell in cells]
        else:
            for text in stream:
                yield [None if cell == "n/a" else _without_guard(_unescaped(cell))
                       for cell in text.rstrip("\n").split("\t")]


def _unescaped(cell):
    if "\\" not in cell:
        return cell
    out, letters = [], iter(cell)
    for letter in letters:
        out.append({"t": "\t", "n": "\n", "r": "\r"}.get(after := next(letters, ""), after) if letter == "\\"
                   else letter)
    return "".join(out)


def _without_guard(cell):
    """Without the apostrophe that keeps a spreadsheet from taking a text for a formula."""
    return cell[1:] if len(cell) > 2 and cell[0] == "'" and cell[1] in "=+-@\t\r" else cell


def _cast_of(name, what):
    form = what.get("Format")
    if form is None:  # written by an earlier version
        form = "number" if "Units" in what else "string" if "Levels" in what or name == "observer" else "either"
    if form == "string":
        return lambda cell: cell if cell is None else str(cell)
    if form == "either":
        return _number_or_text
    number = int if form == "integer" else float
    return lambda cell: None if cell is None else number(cell)


def _number_or_text(cell):
    if not isinstance(cell, str):
        return cell  # of JSON
    for number in (int, float):
        try:
            return number(cell)
        except ValueError:
            pass
    return cell


class _Session:
    """A session as it lies on the disk: gaze on the screen, in the tracker's time. Places on the surface are what
    `overt export` adds."""

    QUERIES = {
        "trials": """SELECT s.observer_label AS observer, s.session_number AS session, t.trial + 1 AS trial, t.attempt,
            t.sitting, k.id AS task, o.id AS object, m.id AS material, t.status,
            CASE WHEN t.trial_id IN (SELECT trial_id FROM counted_trial) THEN 'yes' ELSE 'no' END AS counts,
            t.presentation_onset_ns / 1e9 AS presentation_onset_s, t.presentation_end_ns / 1e9 AS presentation_end_s,
            t.response_screen_onset_ns / 1e9 AS response_screen_onset_s, t.responded_ns / 1e9 AS responded_s, t.answer
            FROM trial t, session s LEFT JOIN task k USING (task) LEFT JOIN object o USING (object)
            LEFT JOIN material m USING (material) ORDER BY t.trial_id""",
        "responses": """SELECT s.observer_label AS observer, s.session_number AS session, t.trial + 1 AS trial,
            k.id AS task, t.answer, (t.responded_ns - t.response_screen_onset_ns) / 1e9 AS response_time_s
            FROM counted_trial t, session s LEFT JOIN task k USING (task) WHERE t.answer IS NOT NULL
            ORDER BY t.trial_id""",
        "given_answers": """SELECT s.observer_label AS observer, s.session_number AS session, t.trial + 1 AS trial,
            a.id, a.item, a.kind, a.value AS answer, a.number, a.is_correct, (a.answered_ns - a.screen_onset_ns) / 1e9 AS
            after_screen_s FROM given_answer a JOIN counted_trial t USING (trial_id), session s
            ORDER BY a.trial_id, a.n""",
        "gaze_events": """SELECT s.observer_label AS observer, s.session_number AS session, t.trial + 1 AS trial,
            e.kind, CASE e.eye WHEN 0 THEN 'left' WHEN 1 THEN 'right' END AS eye, e.start_us AS tracker_start_us,
            e.end_us AS tracker_end_us, e.duration_us / 1e6 AS duration_s, e.x_px, e.y_px, e.pupil
            FROM gaze_event e JOIN counted_trial t USING (trial_id), session s ORDER BY e.trial_id, e.n""",
        "samples": """SELECT s.observer_label AS observer, s.session_number AS session, t.trial + 1 AS trial,
            p.tracker_us AS tracker_time_us, CASE p.eye WHEN 0 THEN 'left' ELSE 'right' END AS eye, p.x_px, p.y_px,
            p.pupil_area AS pupil FROM sample p JOIN counted_trial t USING (trial_id), session s
            ORDER BY p.trial_id, p.n""",
        "stimuli": """SELECT s.observer_label AS observer, s.session_number AS session, o.id AS object,
            m.id AS material, i.source, o.mesh_file FROM stimulus i, session s LEFT JOIN object o USING (object)
            LEFT JOIN material m USING (material)""",
    }
    UNITS = {"s": "s", "us": "us", "px": "px"}

    def __init__(self, folder):
        import sqlite3
        self.folder, self.is_analysis, self._columns = folder, False, {}
        self._errors = sqlite3.Error
        # A path with a question mark or a hash would end the address.
        self._database = sqlite3.connect((folder / "session.sqlite").resolve().as_uri() + "?mode=ro", uri=True)
        self._database.row_factory = sqlite3.Row

    def has(self, name):
        if name == "given_answers":
            return bool(self.rows(name))
        return name in self.QUERIES or name == "participants"

    def columns(self, name):
        return {column: {"Units": self.UNITS[column.rsplit("_", 1)[1]]} if column.rsplit("_", 1)[-1] in self.UNITS
                and "_" in column else {} for column in self._columns.get(name, [])}

    def remedy(self, name):
        return f"`overt export {self.folder} --out tables` writes it"

    def rows(self, name, columns=None):
        try:
            if name == "participants":
                label, number = self._database.execute("SELECT observer_label, session_number FROM session").fetchone()
                found = [{"observer": label, "session": number, **{
                    row["id"]: row["value"] for row in self._optional("SELECT id, value FROM observer_field ORDER BY n")}}]
            elif name in self.QUERIES:
                query = self.QUERIES[name]
                found = self._optional(query) if name == "given_answers" else self._database.execute(query).fetchall()
                found = [dict(row) for row in found]
            else:
                return None
        except self._errors as reason:
            raise StudyError(f"{self.folder / 'session.sqlite'}: {reason}: `overt verify {self.folder}` says what is "
                             "damaged; sessions of earlier programs are read by `overt export`") from None
        self._columns[name] = list(found[0]) if found else []
        if columns is not None:
            found = [{column: row[column] for column in row if column in columns or column in ROW_KEY} for row in found]
        return found

    def _optional(self, query):
        """Earlier programs did not write every table."""
        try:
            return self._database.execute(query).fetchall()
        except self._errors as reason:
            if "no such table" in str(reason):
                return []
            raise


class Mesh:
    """vertices: (x, y, z) each. faces: the numbers of their vertices, from 0. values, face_values: by name, one for each
    vertex or face, such as `saliency`, the density of a map. comments: what the file says of itself, its legend."""

    def __init__(self, vertices, faces, values, face_values, comments):
        self.vertices, self.faces, self.comments = vertices, faces, comments
        self.values, self.face_values = values, face_values


PLY_TYPES = {"char": "b", "int8": "b", "uchar": "B", "uint8": "B", "short": "h", "int16": "h", "ushort": "H",
             "uint16": "H", "int": "i", "int32": "i", "uint": "I", "uint32": "I", "float": "f", "float32": "f",
             "double": "d", "float64": "d"}


def read_mesh(file):
    """Gives the Mesh in a PLY file (ascii or binary). Raises StudyError."""
    file = Path(file)
    try:
        data = file.read_bytes()
    except OSError as reason:
        raise StudyError(f"{file}: {reason.strerror}") from None
    head, mark, body = data.partition(b"end_header")
    if not data.startswith(b"ply") or not mark:
        raise StudyError(f"{file}: is no PLY file: meshes with maps are written by `overt analyze --meshes`")
    body = body[body.index(b"\n") + 1:] if b"\n" in body else b""
    form, elements, comments = "", [], []
    for line in head.decode("utf-8", "replace").splitlines()[1:]:
        words = line.split()
        if not words:
            continue
        if words[0] == "format":
            form = words[1]
        elif words[0] == "comment":
            comments.append(line.partition(" ")[2])
        elif words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        elif words[0] == "property":
            elements[-1][2].append((words[-1], [PLY_TYPES[word] for word in words[1:-1] if word != "list"],
                                    words[1] == "list"))
    try:
        read = {"ascii": _ply_texts, "binary_little_endian": _ply_bytes("<"), "binary_big_endian": _ply_bytes(">")}[form]
        tables = read(body, elements)
    except (KeyError, IndexError, ValueError, struct.error):
        raise StudyError(f"{file}: is cut off, or no PLY of a known form ({form}): write it again") from None
    vertex, face = tables.get("vertex", {}), dict(tables.get("face", {}))
    faces = face.pop("vertex_indices", None) or face.pop("vertex_index", None) or []
    places = [vertex.pop(axis) for axis in "xyz" if axis in vertex]
    return Mesh(list(zip(*places)), faces, vertex, face, comments)


def _ply_texts(body, elements):
    lines = (line.split() for line in io.StringIO(body.decode("ascii", "replace")) if line.strip())
    tables = {}
    for name, count, properties in elements:
        columns = {label: [] for label, _, _ in properties}
        for _ in range(count):
            words = iter(next(lines, []))
            for label, types, is_list in properties:
                cast = float if types[-1] in "fd" else int
                try:
                    columns[label].append(tuple(cast(next(words)) for _ in range(int(next(words)))) if is_list
                                          else cast(next(words)))
                except (StopIteration, RuntimeError):
                    raise ValueError from None
        tables[name] = columns
    return tables


def _ply_bytes(order):
    def read(body, elements):
        tables, at = {}, 0
        for name, count, properties in elements:
            columns = {label: [] for label, _, _ in properties}
            # Rows of one length each, such as triangles, are read at once: those of the first row.
            letters, places = "", []
            for label, types, is_list in properties if count else []:
                length = struct.unpack_from(order + types[0], body, at + struct.calcsize(order + letters))[0] if is_list else 1
                places.append((label, is_list, len(letters), length))
                letters += types[0] + types[1] * length if is_list else types[0]
            row = struct.Struct(order + letters)
            is_there = count > 0 and at + count * row.size <= len(body)
            rows = list(row.iter_unpack(body[at:at + count * row.size])) if is_there else []
            if len(rows) == count and all(found[place] == length for _, is_list, place, length in places if is_list
                                          for found in rows):
                at += count * row.size
                for label, is_list, place, length in places:
                    columns[label] = ([found[place + 1:place + 1 + length] for found in rows] if is_list
                                      else [found[place] for found in rows])
            else:
                for _ in range(count):
                    for label, types, is_list in properties:
                        size = 1
                        if is_list:
                            size = struct.unpack_from(order + types[0], body, at)[0]
                            at += struct.calcsize(types[0])
                        values = struct.unpack_from(f"{order}{size}{types[-1]}", body, at)
                        at += struct.calcsize(order + types[-1]) * size
                        columns[label].append(values if is_list else values[0])
            tables[name] = columns
        return tables
    return read


if __name__ == "__main__":
    for argument in sys.argv[1:]:
        found = read_study(argument, pandas=False)
        print(argument)
        for title in ("trials", "answers", "fixations", "participants", "stimuli"):
            print(f"  {title}: {len(getattr(found, title))} rows")
