#!/usr/bin/env python3
"""Makes what the pages of docs/gallery/ show of each protocol: a picture of the screen in a trial, the design in words as
`overt check` says it, how many observers find an effect as `overt power` says it, and the main figure of the report of a study of simulated observers.

    bench/gallery_pages.py [--overt PROGRAM] [--studies FOLDER] [--only screen|design|figure|power] [PROTOCOL…]

Pages are text; between the lines `<!-- made: design -->` and `<!-- end -->` this script writes, and nowhere else. Studies are
kept in FOLDER, made by `overt replicate`, and used again. Needs Xvfb for the pictures of screens, and Chromium for the
figures, which it has the report's page save as its buttons do.
"""
import argparse
import html
import json
import os
import pathlib
import re
import signal
import struct
import subprocess
import sys
import tempfile
import time
import zlib

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGES = ROOT / "docs" / "gallery"
# Of each protocol's report the figure that answers its question, as the page names it.
FIGURES = {
    "overt_2019": "figure4", "gloss_scaling": "scales_of_comparisons", "gloss_matching": "matches", "material_ratings": "ratings_and_numbers",
    "gauge_figure": "reliefs_of_gauge_settings", "surface_points": "places_that_were_pointed_at", "shape_recognition": "how_often_how_right_how_fast",
    "mesh_saliency": "figure4", "active_exploration": "matches", "odd_one_out": "what_stays_together",
    "material_search": "what_goes_with_a_number", "delayed_match": "how_often_how_right_how_fast", "gaze_contingent": "figure4", "pictures": "figure4",
    "which_is_glossier": "psychometric_functions"}


# What a study of each kind may be planned for; the others measure what `overt power` has no effect for.
EFFECTS = {
    "overt_2019": "head:material=rough:odds=1.5", "material_ratings": "rating:material=clay:shift=0.7",
    "mesh_saliency": "area=crest:material=shiny:odds=1.5", "gaze_contingent": "area=crest:material=shiny:odds=1.5",
    "pictures": "area=face:task=find:odds=0.7", "active_exploration": "head:motion=explore:odds=1.5",
    "surface_points": "head:task=grasp:odds=1.5"}
NO_EFFECT = {
    "gloss_scaling": "a scale or a threshold of one material", "gloss_matching": "matches", "gauge_figure": "settings of gauges",
    "shape_recognition": "levels that observers see in different trials of one test", "odd_one_out": "what stays together",
    "material_search": "response times", "delayed_match": "a share of correct answers against chance",
    "which_is_glossier": "a scale of one object"}


def begun(program, name, folder, more_display=""):
    """A study of one's own from a shipped protocol, with live frames."""
    protocol = folder / f"{name}.toml"
    if not protocol.exists():
        subprocess.run([program, "new", str(protocol), "--from", name], check=True, stdout=subprocess.DEVNULL)
        text = protocol.read_text()
        if "[bake]" not in text:
            text += '\n[bake]\nquality = "live"\n'
        protocol.write_text(text.replace("[display]\n", "[display]\n" + more_display, 1))
    return protocol


def design_of(program, name):
    said = subprocess.run([program, "check", f"protocols/{name}.toml"], cwd=ROOT, capture_output=True, text=True).stdout
    lines, kept, wanted = said.splitlines(), [], False
    for line in lines:
        head = line[2:13].strip() if line.startswith("  ") else ""
        if head:
            wanted = head in ("Design", "Columns", "Trials", "Animation", "Motion", "Slots", "Session")
        elif not line.startswith("    "):
            wanted = False
        if wanted:
            kept.append(line[2:])
    return "\n".join(kept)


def power_of(program, name):
    """How many observers find an effect, as `overt power` says it."""
    if name not in EFFECTS:
        return (f"`overt power` plans differences between levels of a factor; for {NO_EFFECT[name]} it has no effect. `overt replicate my_study.toml "
                "--observers 12` plays a whole study with what the protocol plants, and its report tells how wide the intervals are.")
    command = ["overt", "power", f"protocols/{name}.toml", "--effect", EFFECTS[name], "--observers", "6:24:6", "--studies", "100"]
    with tempfile.TemporaryDirectory() as scratch:
        said = subprocess.run([program, *command[1:], "--out", f"{scratch}/power"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    kept = [line for line in said.splitlines() if line and not line.startswith(("power:", "studies:", "  tested as:", "note:", "assumed"))]
    notes = [line for line in said.splitlines() if line.startswith(("note:", "assumed"))]
    return f"```text\n$ {' '.join(command)}\n" + "\n".join(kept + notes) + "\n```"


def replace_made(page, what, text):
    content = page.read_text()
    pattern = re.compile(rf"(<!-- made: {what} -->\n).*?(<!-- end -->)", re.S)
    if not pattern.search(content):
        sys.exit(f"{page}: there is no place for the {what}")
    page.write_text(pattern.sub(lambda found: found[1] + text + "\n" + found[2], content, count=1))


def png(width, height, rgb):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + rgb[3 * width * y:3 * width * (y + 1)] for y in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def pixels_of(frame_buffer):
    """Of Xvfb's own file, in the format of xwd: width, height and its rows of blue, green, red and nothing."""
    data = frame_buffer.read_bytes()
    head = struct.unpack(">25I", data[:100])
    header_size, width, height, row_bytes, colours = head[0], head[4], head[5], head[12], head[19]
    begin = header_size + 12 * colours
    return width, height, [data[begin + y * row_bytes:begin + y * row_bytes + 4 * width] for y in range(height)]


def smaller(width, height, rows, factor):
    """Means of squares of pixels."""
    out = bytearray()
    for y in range(0, height - factor + 1, factor):
        for x in range(0, width - factor + 1, factor):
            for channel in (2, 1, 0):
                total = 0
                for row in rows[y:y + factor]:
                    total += sum(row[4 * x + channel:4 * (x + factor) + channel:4])
                out.append(round(total / factor ** 2))
    return width // factor, height // factor, bytes(out)


def variety(rows):
    """How much there is to see: different colours at places of a coarse grid."""
    return len({bytes(row[4 * x:4 * x + 3]) for row in rows[::9] for x in range(0, len(row) // 4, 9)})


def screen_of(program, name, folder, wait_s):
    """The richest of the pictures that a session has on its screen in the first seconds of its trials."""
    protocol = begun(program, name, folder, 'timing = "unproven"\nbox = "none"\n')
    # A screen without the display's box shows modes of 16 bits as a pattern of pairs of pixels.
    protocol.write_text(re.sub(r'^output = ".*"$', 'output = "native-8bit"', protocol.read_text(), flags=re.M))
    display = 90 + os.getpid() % 100
    server = subprocess.Popen(["Xvfb", f":{display}", "-screen", "0", "1920x1080x24", "-fbdir", str(folder)],
                              stderr=subprocess.DEVNULL)
    time.sleep(2)
    session = subprocess.Popen([program, "run", str(protocol), "--observer", "P01", "--simulate-observer", "1", "--context", "window", "--refresh-check", "0",
                                "--sessions", str(folder / "screens")], env=os.environ | {"DISPLAY": f":{display}"},
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, start_new_session=True)
    best, most, until, since = None, 0, time.monotonic() + wait_s, time.monotonic()
    # Until nothing richer comes for a while.
    while time.monotonic() < until and session.poll() is None and (most < 40 or time.monotonic() - since < 40):
        time.sleep(0.4)
        width, height, rows = pixels_of(folder / "Xvfb_screen0")
        seen = variety(rows)
        if seen > most:
            best, most, since = (width, height, rows), seen, time.monotonic()
    if session.poll() is None:
        os.killpg(session.pid, signal.SIGTERM)
    said = session.communicate()[1]
    server.terminate()
    server.wait()
    if not best or most < 20:
        sys.exit(f"{name}: nothing was seen on the screen\n{said}")
    (PAGES / f"{name}_screen.png").write_bytes(png(*smaller(*best, 3)))


def figure_of(program, name, studies):
    study = studies / name
    if not (study / "sessions").is_dir():
        subprocess.run([program, "replicate", str(begun(program, name, studies)), "--observers", "6", "--context", "osmesa",
                        "--out", str(study)], check=True, stdout=subprocess.DEVNULL)
    sessions = sorted(str(path.parent) for path in (study / "sessions").rglob("session.sqlite"))
    report = study / "gallery"
    subprocess.run([program, "analyze", *sessions, "--out", str(report), "--overwrite"], check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    page = (report / "report.html").read_text()
    end = page.rindex("</body>")
    script = """<script>setTimeout(() => { const out = {};
      for (const chart of document.querySelectorAll('.chart, .panels')) { if (chart.parentElement.closest('.chart, .panels')) continue;
        const figure = figure_of(chart, 170), name = name_of_figure(chart);
        if (figure && !(name in out)) out[name] = new XMLSerializer().serializeToString(figure); }
      const note = document.createElement('pre'); note.id = 'saved'; note.textContent = JSON.stringify(out); document.body.append(note);
    }, 1500)</script>"""
    # Beside the analysis: an analysis with a file that is not its own is not written over.
    saving = studies / f"{name}_figures.html"
    saving.write_text(page[:end] + script + page[end:])
    with tempfile.TemporaryDirectory() as profile:
        seen = subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking",
                               f"--user-data-dir={profile}", "--window-size=1400,1000", "--virtual-time-budget=9000", "--dump-dom",
                               saving.as_uri()], capture_output=True, text=True).stdout
    saved = json.loads(html.unescape(re.search(r'<pre id="saved">(.*?)</pre>', seen, re.S)[1]))
    if FIGURES[name] not in saved:
        sys.exit(f"{name}: the report has no figure {FIGURES[name]}, but {', '.join(saved)}")
    (PAGES / f"{name}_figure.svg").write_text(saved[FIGURES[name]] + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("protocols", nargs="*", choices=[[], *FIGURES])
    parser.add_argument("--overt", default=str(ROOT / "build/release/app/overt"))
    parser.add_argument("--studies", type=lambda given: pathlib.Path(given).resolve())
    parser.add_argument("--wait-s", type=float, default=400, help="how long a session may take until its first picture")
    parser.add_argument("--only", choices=["screen", "design", "figure", "power"])
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        studies = options.studies or pathlib.Path(scratch) / "studies"
        studies.mkdir(parents=True, exist_ok=True)
        for name in options.protocols or FIGURES:
            if options.only in (None, "design"):
                replace_made(PAGES / f"{name}.md", "design", f"```text\n{design_of(options.overt, name)}\n```")
            if options.only in (None, "power"):
                replace_made(PAGES / f"{name}.md", "power", power_of(options.overt, name))
            if options.only in (None, "screen"):
                folder = pathlib.Path(scratch) / name
                folder.mkdir()
                screen_of(options.overt, name, folder, options.wait_s)
            if options.only in (None, "figure"):
                figure_of(options.overt, name, studies)
            print(name, file=sys.stderr)


if __name__ == "__main__":
    main()
