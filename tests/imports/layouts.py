"""A simulated session, written down as other programs would have presented and recorded it: in the layout of each program's own
files, with clocks of their own. Each source_NAME(truth, here) writes its files into the folder `here` and gives the words of
`overt import` and what its check may expect.
"""
import json
import math
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "readers"))
import overt  # noqa: E402

PROGRAM = os.environ.get("OVERT_PROGRAM", str(ROOT / "build/release/app/overt"))


def program(*arguments, expect=0):
    done = subprocess.run([PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, text=True)
    if done.returncode != expect:
        raise AssertionError(f"overt {' '.join(map(str, arguments))}\nended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr if expect else done.stdout


class Truth:
    """A session that was simulated, of its exported tables. `screen`: its pixels; `px_per_mm`, `distance_mm`: for angles."""

    def __init__(self, folder, screen, px_per_mm, distance_mm):
        self.screen, self.px_per_mm, self.distance_mm = screen, px_per_mm, distance_mm
        self.study = overt.read_study(folder, samples=True, pandas=False)
        self.trials, self.samples = self.study.trials, [row for row in self.study.samples if row["time_s"] is not None]
        self.flips = self.study.table("flips")
        # Both clocks run evenly here: two samples tell how they go together.
        a, b = self.samples[0], self.samples[-1]
        self.rate = (b["tracker_time_us"] - a["tracker_time_us"]) / (b["time_s"] - a["time_s"])
        self.zero = (a["tracker_time_us"], a["time_s"])

    def tracker_us(self, time_s):
        return self.zero[0] + self.rate * (time_s - self.zero[1])

    def answers(self, trial):
        return next(row for row in self.study.answers if row["trial"] == trial["trial"])


def rows(file, lines, separator=","):
    def text(cell):
        word = "" if cell is None else str(cell)
        return f'"{word}"' if separator == "," and "," in word and not word.startswith('"') else word
    file.write_text("".join(separator.join(map(text, line)) + "\n" for line in lines), encoding="utf-8")
    return file


def trial_rows(truth, time_of, unit=1.0, duration=True):
    """The plain log of trials: when, what, and what was answered."""
    lines = [["trial", "onset", "duration", "object", "material", "task", "answer", "response_time"]]
    for row in truth.trials:
        answer = truth.answers(row)
        lines.append([row["trial"], "%.6f" % (time_of(row["presentation_onset_s"]) * unit),
                      "%.6f" % ((row["presentation_end_s"] - row["presentation_onset_s"]) * unit), row["object"], row["material"],
                      row["task"], answer["answer"], "%.6f" % ((answer["responded_s"] - row["presentation_onset_s"]) * unit)])
    return lines if duration else [[cell for i, cell in enumerate(line) if i != 2] for line in lines]


def tracker_s(truth):
    return lambda time_s: truth.tracker_us(time_s) * 1e-6


def onset_of(truth, sample):
    return next((row for row in truth.trials if row["presentation_onset_s"] - 1e-9 <= sample["time_s"] < row["presentation_end_s"]), None)


def source_csv(truth, here):
    gaze = [["t", "gx", "gy", "pupil"]] + [["%.6f" % (s["tracker_time_us"] * 1e-6), s["x_px"], s["y_px"], s["pupil_area"]] for s in truth.samples]
    rows(here / "gaze.csv", gaze)
    rows(here / "trials.csv", trial_rows(truth, tracker_s(truth)))
    return ["gaze.csv", "--columns", "time=t,x=gx,y=gy,pupil=pupil", "--trial-log", "trials.csv"], {"bound_ms": (0, 0.01)}


def source_both_eyes(truth, here):
    """Normalised places of both eyes, semicolons and decimal commas, lost samples told by validity alone, unit of time not said."""
    def cell(number):
        return ("%.7f" % number).replace(".", ",")
    gaze = [["Zeit", "lx", "ly", "lv", "rx", "ry", "rv"]]
    for s in truth.samples:
        lost = s["x_px"] is None
        x, y = (0.5, 0.5) if lost else (s["x_px"] / truth.screen[0], s["y_px"] / truth.screen[1])
        gaze.append([cell(s["tracker_time_us"] * 1e-3), "n/a", "n/a", 0, cell(x), cell(y), 0 if lost else 1])
    rows(here / "gaze.csv", gaze, ";")
    rows(here / "trials.tsv", trial_rows(truth, tracker_s(truth), 1e3, duration=False), "\t")
    return ["gaze.csv", "--columns", "time=Zeit,unit=normalised,left_x=lx,left_y=ly,left_validity=lv,right_x=rx,right_y=ry,right_validity=rv",
            "--trial-log", "trials.tsv", "--trial-columns", "unit=ms"], {"eye": "right"}


def source_degrees(truth, here):
    def angle(px, middle_px):
        return math.degrees(math.atan((px - middle_px) / truth.px_per_mm / truth.distance_mm))
    gaze = [["time", "x", "y"]] + [["%.3f" % (s["tracker_time_us"] * 1e-3), None, None] if s["x_px"] is None else
                                   ["%.3f" % (s["tracker_time_us"] * 1e-3), "%.6f" % angle(s["x_px"], truth.screen[0] / 2), "%.6f" % -angle(s["y_px"], truth.screen[1] / 2)]
                                   for s in truth.samples]
    rows(here / "gaze.tsv", gaze, "\t")
    rows(here / "trials.csv", trial_rows(truth, tracker_s(truth)))
    return ["gaze.tsv", "--columns", "time=time,x=x,y=y,unit=degrees", "--trial-log", "trials.csv"], {}


JITTER_MS = (0.31, -0.12, 0.05, -0.4, 0.2, -0.05, 0.11, 0.0)


def own_clock(time_s, trial=0):
    """The presenter's clock: 1000 s ahead, 40 ppm fast; the marker of a trial arrives late or early."""
    return 1000 + time_s * 1.00004


def source_markers(truth, here):
    gaze = [["us", "x", "y", "message"]]
    marks = {}
    for i, row in enumerate(truth.trials):
        marks[truth.tracker_us(row["presentation_onset_s"]) + JITTER_MS[i] * 1e3] = f"ONSET {row['trial']}"
    lines = [[s["tracker_time_us"], s["x_px"], s["y_px"], None] for s in truth.samples]
    lines += [[int(round(at)), None, None, text] for at, text in marks.items()]
    rows(here / "gaze.csv", gaze + sorted(lines, key=lambda line: line[0]))
    log = trial_rows(truth, lambda t: own_clock(t))
    rows(here / "trials.csv", [[*line, "marker" if i == 0 else f"ONSET {line[0]}"] for i, line in enumerate(log)])
    return ["gaze.csv", "--columns", "time=us,x=x,y=y,mark=message,time_unit=us", "--trial-log", "trials.csv"], {
        "bound_ms": (0.1, 0.8), "off_s": 0.0006, "frames": 0.97}


def source_frames(truth, here):
    """What was lit was not what the protocol plans: the log of frames says it."""
    args, _ = source_csv(truth, here)
    rows(here / "frames.csv", [["time", "trial", "frame"]] + [
        ["%.6f" % (truth.tracker_us(f["onset_s"]) * 1e-6), f["trial"], 30 - f["shown_frame"]] for f in truth.flips if f["state"] == "flipped"])
    return [*args, "--frame-log", "frames.csv"], {"turned": True}


def source_angles(truth, here):
    args, _ = source_csv(truth, here)
    last, lines = None, []
    for f in truth.flips:
        if (f["trial"], f["angle_deg"]) != last: # only where it changes
            lines.append(["%.3f" % (truth.tracker_us(f["onset_s"]) * 1e-3), "%.2f" % f["angle_deg"]])
        last = (f["trial"], f["angle_deg"])
    rows(here / "frames.csv", [["ms", "turn"]] + lines)
    return [*args, "--frame-log", "frames.csv", "--frame-columns", "time=ms,angle=turn,unit=ms"], {"same_angle": True}


def source_bids(truth, here):
    program("export", truth.session, "--format", "bids", "--out", here / "dataset")
    beh = next((here / "dataset").glob("sub-*/ses-*/beh"))
    return [next(beh.glob("*_physio.tsv.gz"))], {"exact": True, "bound_ms": (0, 0.01)}


def source_bids_plain(truth, here):
    """BIDS as others write it: onsets by StartTime of the first sample, no time of the tracker's in the events."""
    source_bids(truth, here)
    beh = next((here / "dataset").glob("sub-*/ses-*/beh"))
    first = truth.samples[0]["tracker_time_us"]
    side_car = next(beh.glob("*_physio.json"))
    side_car.write_text(json.dumps({**json.loads(side_car.read_text()), "StartTime": -2.5}))
    lines = [["onset", "duration", "trial_type", "object", "material", "task"]]
    lines += [["%.6f" % ((truth.tracker_us(r["presentation_onset_s"]) - first) * 1e-6 - 2.5), "1.0", "presentation", r["object"], r["material"], r["task"]]
              for r in truth.trials]
    rows(here / "sub-1_task-elsewhere_events.tsv", lines, "\t")
    return [next(beh.glob("*_physio.tsv.gz")), "--trial-log", "sub-1_task-elsewhere_events.tsv"], {"answers": False}


def source_tobii(truth, here):
    """Tobii Pro Lab: microseconds, a row for each event, the name of what was shown in each row."""
    names = ["Recording timestamp", "Computer timestamp", "Sensor", "Project name", "Export date", "Participant name", "Recording name",
             "Recording resolution height", "Recording resolution width", "Event", "Event value", "Gaze point X", "Gaze point Y",
             "Gaze point left X", "Gaze point left Y", "Gaze point right X", "Gaze point right Y", "Pupil diameter left", "Pupil diameter right",
             "Validity left", "Validity right", "Presented Stimulus name", "Presented Media width", "Eye movement type"]

    def line(at, sensor, **cells):
        values = {"Recording timestamp": at, "Computer timestamp": at + 7, "Sensor": sensor, "Project name": "Bälle", "Export date": "27.11.2026",
                  "Participant name": "P01", "Recording name": "Recording 1", "Recording resolution height": truth.screen[1],
                  "Recording resolution width": truth.screen[0], **cells}
        return [values.get(name) for name in names]
    first = truth.samples[0]["tracker_time_us"]
    lines = [line(0, None, Event="RecordingStart"), line(3, None, Event="Eyetracker Calibration", **{"Presented Stimulus name": "Eyetracker Calibration"})]
    for s in truth.samples:
        shown = onset_of(truth, s)
        name = f"{shown['object']}_{shown['material']}.png" if shown else None
        x, y = (None, None) if s["x_px"] is None else (("%.3f" % s[c]).replace(".", ",") for c in ("x_px", "y_px"))
        valid = "Invalid" if s["x_px"] is None else "Valid"
        lines.append(line(s["tracker_time_us"] - first + 10, "Eye Tracker", **{
            "Gaze point right X": x, "Gaze point right Y": y, "Gaze point left X": None, "Gaze point left Y": None, "Pupil diameter right": "3,11",
            "Validity left": "Invalid", "Validity right": valid, "Presented Stimulus name": name, "Eye movement type": "Fixation"}))
        lines.append(line(s["tracker_time_us"] - first + 11, "Mouse", **{"Presented Stimulus name": name}))
    text = "".join("\t".join("" if c is None else str(c) for c in line) + "\r\n" for line in [names] + lines)
    (here / "Data export.tsv").write_bytes(b"\xef\xbb\xbf" + text.encode("utf-8"))
    return ["Data export.tsv", "--protocol", "one_task.toml"], {"answers": False, "eye": "right", "shift_us": 10 - first, "frames": 0.75, "off_s": 0.0041,
                                                               "task": False, "program": "Tobii Pro Lab"}


def source_gazepoint(truth, here):
    first = truth.samples[0]["tracker_time_us"]
    names = ["MEDIA_ID", "MEDIA_NAME", "CNT", "TIME(2026/11/27 10:00:00.000)", "TIMETICK(f=10000000)", "FPOGX", "FPOGY", "FPOGS", "FPOGD", "FPOGID",
             "FPOGV", "BPOGX", "BPOGY", "BPOGV", "CX", "CY", "CS", "KB", "KBS", "USER", "LPCX", "LPCY", "LPD", "LPS", "LPV", "RPCX", "RPCY",
             "RPD", "RPS", "RPV", "BKID", "BKDUR", "BKPMIN", "LPMM", "LPMMV", "RPMM", "RPMMV", "SACCADE_MAG", "SACCADE_DIR", "LPOGX", "LPOGY", "LPOGV",
             "RPOGX", "RPOGY", "RPOGV", ""]
    lines = []
    user = ""
    for n, s in enumerate(truth.samples):
        shown = onset_of(truth, s)
        if shown:
            user = f"TRIAL{shown['trial']}"
        x, y, v = (0, 0, 0) if s["x_px"] is None else ("%.5f" % (s["x_px"] / truth.screen[0]), "%.5f" % (s["y_px"] / truth.screen[1]), 1)
        cells = {"MEDIA_ID": 0, "MEDIA_NAME": "NewMedia", "CNT": n, names[3]: "%.5f" % ((s["tracker_time_us"] - first) * 1e-6), names[4]: n, "USER": user,
                 "BPOGX": x, "BPOGY": y, "BPOGV": v, "LPOGX": 0, "LPOGY": 0, "LPOGV": 0, "RPOGX": x, "RPOGY": y, "RPOGV": v, "RPMM": 3.2, "LPMM": 0}
        lines.append([cells.get(name, 0) for name in names[:-1]] + [""])
    rows(here / "P1_all_gaze.csv", [names] + lines)
    log = trial_rows(truth, lambda t: (truth.tracker_us(t) - first) * 1e-6)
    rows(here / "trials.csv", log)
    return ["P1_all_gaze.csv", "--trial-log", "trials.csv"], {"eye": "right", "shift_us": -first, "program": "Gazepoint", "off_mm": 0.2}


def source_pupil(truth, here):
    """A surface of Pupil Player, its annotations, and a log of the presenter's own clock."""
    base = 215_000.0
    first = truth.samples[0]["tracker_time_us"]
    lines = [["world_timestamp", "world_index", "gaze_timestamp", "x_norm", "y_norm", "x_scaled", "y_scaled", "on_surf", "confidence"]]
    for n, s in enumerate(truth.samples):
        at = base + (s["tracker_time_us"] - first) * 1e-6
        x, y, c = (0.1, 0.1, 0.0) if s["x_px"] is None else (s["x_px"] / truth.screen[0], 1 - s["y_px"] / truth.screen[1], 0.98)
        lines.append(["%.6f" % at, n // 8, "%.6f" % at, "%.7f" % x, "%.7f" % y, "%.4f" % x, "%.4f" % y, "True", c])
    (here / "surfaces").mkdir(exist_ok=True)
    rows(here / "surfaces/gaze_positions_on_surface_screen.csv", lines)
    rows(here / "annotations.csv", [["index", "timestamp", "label", "duration"]] + [
        [i, "%.6f" % (base + (truth.tracker_us(r["presentation_onset_s"]) - first) * 1e-6), f"onset_{r['trial']}", 0.0] for i, r in enumerate(truth.trials)])
    log = trial_rows(truth, lambda t: own_clock(t))
    rows(here / "trials.csv", [[*line, "sent" if i == 0 else f"onset_{line[0]}"] for i, line in enumerate(log)])
    return ["surfaces/gaze_positions_on_surface_screen.csv", "annotations.csv", "--trial-log", "trials.csv", "--trial-columns", "marker=sent"], {
        "shift_us": base * 1e6 - first, "program": "Pupil Core", "bound_ms": (0, 0.02)}


def source_smi(truth, here):
    """SMI's IDF Converter with messages, and a log of PsychoPy's."""
    head = ["## [iView]", "## Converted from:\tp01.idf", "## Date:\t27.11.2026 10:00:00", "## Version:\tIDF Converter 3.0.9", "## Sample Rate:\t250",
            f"## Calibration Area:\t{truth.screen[0]}\t{truth.screen[1]}", "## [Geometry]", "## Stimulus Dimension [mm]:\t272\t96", "## Head Distance [mm]:\t573", "## "]
    lines = [["Time", "Type", "Trial", "R Raw X [px]", "R Raw Y [px]", "R Mapped Diameter [mm]", "R CR1 X [px]", "R POR X [px]", "R POR Y [px]", "Timing"]]
    body = [[s["tracker_time_us"], "SMP", 1, 300.5, 200.5, "3.31", 310.0, *(("0.00", "0.00") if s["x_px"] is None else
                                                                         ("%.2f" % s["x_px"], "%.2f" % s["y_px"])), 0] for s in truth.samples]
    body += [[int(truth.tracker_us(r["presentation_onset_s"]) + JITTER_MS[i] * 1e3), "MSG", 1, f"# Message: trial_{r['trial']}"]
             for i, r in enumerate(truth.trials)]
    text = "\n".join(head) + "\n" + "".join("\t".join(map(str, line)) + "\n" for line in lines + sorted(body, key=lambda line: line[0]))
    (here / "p01 Samples.txt").write_text(text)
    names = ["trials.thisN", "object", "material", "task", "key_resp.keys", "key_resp.rt", "key_resp.started", "instructions.text", "face.started",
             "face.stopped", "msg", "participant", "expName", "psychopyVersion", "frameRate", ""]
    log = [names, [None, None, None, None, None, None, None, '"Look,\nplease"', None, None, None, 1, "elsewhere", "2023.2.3", 60.0, None]]
    for i, r in enumerate(truth.trials):
        answer = truth.answers(r)
        at = own_clock(r["presentation_onset_s"])
        log.append([i, r["object"], r["material"], r["task"], answer["answer"], "[%.6f]" % (answer["responded_s"] - r["presentation_onset_s"]),
                    "%.6f" % at, None, "%.6f" % at, "%.6f" % own_clock(r["presentation_end_s"]), f"trial_{r['trial']}", 1, "elsewhere", "2023.2.3", 60.0, None])
    rows(here / "01_elsewhere_2026.csv", log)
    return ["p01 Samples.txt", "--trial-log", "01_elsewhere_2026.csv", "--trial-columns", "marker=msg"], {
        "program": "SMI", "bound_ms": (0.1, 0.8), "off_s": 0.0006, "frames": 0.97, "eye": "right"}


def source_opensesame(truth, here):
    source_csv(truth, here)
    names = ["subject_nr", "count_new_trial", "object", "material", "task", "time_new_sketch", "response", "response_time", "correct", "datetime", "opensesame_version"]
    log = [names]
    for i, r in enumerate(truth.trials):
        answer = truth.answers(r)
        log.append([1, i, r["object"], r["material"], r["task"], "%.3f" % (truth.tracker_us(r["presentation_onset_s"]) * 1e-3), f'"{answer["answer"]}"',
                    "%.3f" % ((answer["responded_s"] - r["presentation_onset_s"]) * 1e3), "undefined", '"Fri Nov 27 10:00:00 2026"', "4.0.5"])
    rows(here / "subject-1.csv", log)
    return ["gaze.csv", "--columns", "time=t,x=gx,y=gy,pupil=pupil", "--trial-log", "subject-1.csv"], {}


def source_tobii_studio(truth, here):
    """Tobii Studio: milliseconds with the tracker's microseconds beside them, codes of validity, events and media in each row."""
    names = ["ExportDate", "StudioVersionRec", "ParticipantName", "RecordingName", "RecordingResolution", "MediaName", "RecordingTimestamp", "StudioEvent",
             "StudioEventData", "EyeTrackerTimestamp", "GazePointLeftX (ADCSpx)", "GazePointLeftY (ADCSpx)", "GazePointRightX (ADCSpx)",
             "GazePointRightY (ADCSpx)", "PupilLeft", "PupilRight", "ValidityLeft", "ValidityRight", "GazeEventType"]
    first = truth.samples[0]["tracker_time_us"]
    lines = []
    for s in truth.samples:
        shown = onset_of(truth, s)
        at = s["tracker_time_us"] - first
        gone = s["x_px"] is None
        cells = {"ExportDate": "27.11.2026", "StudioVersionRec": "3.4.8", "ParticipantName": "P01", "RecordingName": "Rec 01",
                 "RecordingResolution": f"{truth.screen[0]} x {truth.screen[1]}", "MediaName": f"{shown['object']}_{shown['material']}.png" if shown else None,
                 "RecordingTimestamp": at // 1000, "EyeTrackerTimestamp": 1_400_000_000_000_000 + at, "GazeEventType": "Fixation",
                 names[12]: None if gone else "%.2f" % s["x_px"], names[13]: None if gone else "%.2f" % s["y_px"], "PupilRight": None if gone else "3.11",
                 "ValidityLeft": 4, "ValidityRight": 4 if gone else 0}
        lines.append([cells.get(name) for name in names])
    rows(here / "P01_Rec 01.tsv", [names] + lines, "\t")
    return ["P01_Rec 01.tsv", "--protocol", "one_task.toml"], {"answers": False, "eye": "right", "shift_us": -first, "frames": 0.7, "off_s": 0.0055, "task": False,
                                                               "program": "Tobii Studio", "coarse_us": 1200}


def source_neon(truth, here):
    """The Marker Mapper's gaze of a Neon, its recording's events, and a log of the presenter's own clock."""
    base = 1_700_000_000_000_000_000
    first = truth.samples[0]["tracker_time_us"]
    recording = "4337ff0f-0000-4000-8000-000000000001"
    lines = [["section id", "recording id", "timestamp [ns]", "gaze detected on surface", "gaze position on surface x [normalized]",
              "gaze position on surface y [normalized]", "fixation id", "blink id"]]
    for s in truth.samples:
        x, y = (None, None) if s["x_px"] is None else ("%.7f" % (s["x_px"] / truth.screen[0]), "%.7f" % (s["y_px"] / truth.screen[1]))
        lines.append([recording, recording, base + (s["tracker_time_us"] - first) * 1000, x is not None, x, y, None, None])
    rows(here / "gaze.csv", lines)
    rows(here / "events.csv", [["recording id", "timestamp [ns]", "name", "type"], [recording, base, "recording.begin", "recording"]] + [
        [recording, base + int((truth.tracker_us(r["presentation_onset_s"]) - first) * 1000), f"onset_{r['trial']}", "recording"] for r in truth.trials])
    log = trial_rows(truth, lambda t: own_clock(t))
    rows(here / "trials.csv", [[*line, "sent" if i == 0 else f"onset_{line[0]}"] for i, line in enumerate(log)])
    return ["gaze.csv", "events.csv", "--trial-log", "trials.csv", "--trial-columns", "marker=sent"], {
        "shift_us": base / 1e3 - first, "program": "Pupil Labs Neon", "bound_ms": (0, 0.02)}


def source_eyelink(truth, here):
    """The recording's own messages for Data Viewer say which trials there were."""
    program("export", truth.session, "--format", "asc", "--out", here / "asc")
    # Onsets as other presenters name them.
    (here / "p01.asc").write_text(next((here / "asc").rglob("*.asc")).read_text().replace("PRESENTATION_ONSET", "SYNCTIME"))
    return ["p01.asc"], {"program": "EyeLink", "answers": False, "off_s": 0.0011, "frames": 0.95}


def source_eyelink_psychopy(truth, here):
    """A log of PsychoPy's; the recording has the same message at each onset."""
    source_eyelink(truth, here)
    text = [line for line in (here / "p01.asc").read_text().splitlines() if not line.startswith("MSG") or " !V " not in line and "TRIAL" not in line]
    (here / "p01.asc").write_text("\n".join(text) + "\n")
    names = ["trials.thisN", "object", "material", "task", "key_resp.keys", "key_resp.rt", "face.started", "face.stopped", "psychopyVersion", "frameRate"]
    log = [names]
    for i, r in enumerate(truth.trials):
        answer = truth.answers(r)
        log.append([i, r["object"], r["material"], r["task"], answer["answer"], "%.6f" % (answer["responded_s"] - r["presentation_onset_s"]),
                    "%.6f" % own_clock(r["presentation_onset_s"]), "%.6f" % own_clock(r["presentation_end_s"]), "2026.1.1", 60.0])
    rows(here / "p01.csv", log)
    return ["p01.asc", "--trial-log", "p01.csv", "--trial-columns", "marker_text=SYNCTIME"], {
        "program": "EyeLink", "bound_ms": (0.1, 1.6), "off_s": 0.0011, "frames": 0.95}
