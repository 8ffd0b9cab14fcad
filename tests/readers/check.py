"""check.py READERS FOLDER: what readers/overt.py has to read in what tests/readers/run made."""
import struct
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, sys.argv[1])
import overt  # noqa: E402

folder = Path(sys.argv[2])


def close(a, b, within=1e-6):
    assert abs(a - b) <= within * max(1.0, abs(b)), (a, b)


def raises(text, what):
    try:
        what()
    except overt.StudyError as error:
        assert text in str(error), error
    else:
        raise AssertionError(f"nothing said of: {text}")


tables = overt.read_study(folder / "tsv", samples=True, pandas=False)
for form in ("csv", "jsonl"):
    other = overt.read_study(folder / form, samples=True, pandas=False)
    for name in ("trials", "answers", "fixations", "samples", "participants", "stimuli"):
        assert getattr(tables, name) == getattr(other, name), (form, name)
    assert tables.units == other.units

# Words stay words, numbers are numbers, what is missing is None.
assert [row["observer"] for row in tables.participants] == ["07", "8"]
assert [row["note"] for row in tables.participants] == ["=1+1 \\ü", "8\\ü"]
assert len(tables.trials) == 4
for row in tables.trials:
    assert type(row["trial"]) is int and type(row["session"]) is int and type(row["presentation_onset_s"]) is float and row["block"] is None
    assert row["shininess"] == {"rough": 0.25, "smooth": 0.75}[row["material"]]
assert tables.units["fixations"]["duration_s"] == "s" and tables.units["samples"]["surface_x"] == "mm"
assert tables.dictionary["trials"]["object"]["Levels"]["ball"] == "Bällchen"
assert len(tables.answers) == 4 and all(row["answer"] for row in tables.answers)

# Fixations have their place, and what their trial showed; each lies where the samples in it do.
material = {(row["observer"], row["trial"]): row["material"] for row in tables.trials}
counted = [row for row in tables.fixations if row["place"] == "counted"]
assert len(counted) > 5
for row in tables.fixations:
    assert row["kind"] == "fixation" and row["material"] == material[row["observer"], row["trial"]]
for row in counted:
    close(sum(row[f"surface_{axis}"] ** 2 for axis in "xyz") ** 0.5, 60, 0.05)
    assert row["part"] in ("cap", "rest")
    within = [s["x_px"] for s in tables.samples if s["observer"] == row["observer"] and s["trial"] == row["trial"]
              and s["time_s"] is not None and row["start_s"] - 1e-6 <= s["time_s"] <= row["end_s"] + 1e-6
              and s["x_px"] is not None]
    close(sum(within) / len(within), row["x_px"], 1e-3)
few = overt.read_study(folder / "tsv", samples=["x_px", "part"], pandas=False).samples
assert list(few[0]) == ["observer", "session", "trial", "x_px", "part"] and len(few) == len(tables.samples)
assert len(tables.table("flips")) == 4 * 60

# An analysis has the same fixations, and maps whose density times area is the time looked in a trial.
analysis = overt.read_study(folder / "analysis", pandas=False)
assert sum(row["counted"] for row in analysis.fixations) == len(counted)
maps = [row for row in analysis.table("maps") if row["weighting"] == "duration" and row["absent"] is None]
totals = []
for mesh in analysis.meshes.values():
    if "saliency" in mesh.values and not any("difference" in line for line in mesh.comments):
        total = 0.0
        for a, b, c in mesh.faces:
            u, v = ([mesh.vertices[p][i] - mesh.vertices[a][i] for i in range(3)] for p in (b, c))
            cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
            area = 0.5 * sum(x * x for x in cross) ** 0.5
            total += area * sum(mesh.values["saliency"][p] for p in (a, b, c)) / 3
        totals.append(total)
for row in maps:
    assert any(abs(total - row["total"]) < 1e-3 * row["total"] for total in totals), (row["total"], totals)

# A session as it lies there, without a program: the same trials and places on the screen.
session = overt.read_study(folder / "sessions", samples=True, pandas=False)
assert [row["trial"] for row in session.trials] == [row["trial"] for row in tables.trials]
assert len(session.samples) == len(tables.samples)
assert [row["answer"] for row in session.answers] == [row["answer"] for row in tables.answers]
assert [row["note"] for row in session.participants] == [row["note"] for row in tables.participants]
assert [row["tracker_start_us"] for row in session.fixations] == [row["tracker_start_us"] for row in tables.fixations]
assert len(session.meshes["ball"].faces) == 2 * 11 * 24

# Meshes of each form: polygons of three and four corners, a value of each vertex and face.
head = ("ply\nformat {} 1.0\ncomment unit mm\nelement vertex 5\nproperty float x\nproperty double y\nproperty short z\n"
        "property uchar red\nelement face 2\nproperty list uchar uint vertex_index\nproperty int part\nend_header\n")
vertices = [(0, 0, 0, 1), (1, 0, 0, 2), (1, 1, 0, 3), (0, 1, -2, 4), (0.5, 2.25, 300, 255)]
faces = [((0, 1, 2, 3), -7), ((3, 2, 4), 9)]
files = {"ascii": "".join(f"{x} {y} {z} {red}\n" for x, y, z, red in vertices).encode()
         + "".join(f"{len(c)} {' '.join(map(str, c))} {part}\n" for c, part in faces).encode()}
for order, form in (("<", "binary_little_endian"), (">", "binary_big_endian")):
    files[form] = (b"".join(struct.pack(order + "fdhB", *row) for row in vertices)
                   + b"".join(struct.pack(f"{order}B{len(c)}Ii", len(c), *c, part) for c, part in faces))
for form, body in files.items():
    file = folder / f"{form}.ply"
    file.write_bytes(head.format(form).encode() + body)
    mesh = overt.read_mesh(file)
    assert mesh.vertices == [row[:3] for row in vertices], form
    assert mesh.faces == [corners for corners, _ in faces] and mesh.face_values == {"part": [-7, 9]}, form
    assert mesh.values == {"red": [1, 2, 3, 4, 255]} and mesh.comments == ["unit mm"], form
    file.write_bytes(head.format(form).encode() + body[:-3])
    raises("cut off", lambda: overt.read_mesh(file))

# What cannot be read is named, with what helps.
raises("there is no such folder", lambda: overt.read_study(folder / "nothing"))
raises("overt export", lambda: overt.read_study(folder / "cache"))
raises("has no column z_px; it has observer, ", lambda: overt.read_study(folder / "tsv", samples=["z_px"]))
raises("read what `overt export` wrote", lambda: overt.read_study(folder / "analysis", samples=True))
raises("has no table gauge_settings", lambda: tables.table("gauge_settings"))
damaged = folder / "tsv/sub-07_ses-01/trials.tsv"
text = damaged.read_text(encoding="utf-8").split("\n")
cells = text[1].split("\t")
cells[2] = "one"
damaged.write_text("\n".join([text[0], "\t".join(cells)] + text[2:]), encoding="utf-8")
raises("trials.tsv:2: trial is 'one'", lambda: overt.read_study(folder / "tsv"))
damaged.write_text("\n".join([text[0], text[1][:30]]), encoding="utf-8")
raises("trials.tsv:2: ", lambda: overt.read_study(folder / "tsv"))

try:
    import pandas  # noqa: F401
    frames = overt.read_study(folder / "csv", samples=True)
    assert len(frames.fixations) == len(tables.fixations) and str(frames.fixations["trial"].dtype) == "int64"
    assert str(frames.fixations["triangle"].dtype) == "Int64"
    assert frames.fixations.attrs["units"]["x_px"] == "px" and str(frames.samples["surface_x"].dtype) == "float64"
    assert list(frames.participants["note"]) == ["=1+1 \\ü", "8\\ü"]
except ImportError:
    print("pandas is not installed: its frames were not tried")
