#!/usr/bin/env python3
"""How exact the recorded times of keys are: a session in real time in a window, and a keyboard that is played.

    bench/press_times.py [--overt PROGRAM] [--trials N] [--json]

Keys go down at times drawn by chance, through the X server's own test extension (XTEST), as those of a keyboard do once
the kernel has them: what a keyboard and USB take before that, some 5 to 30 ms, no program can see. The session's clock is
related to this script's by the codes that it sends to a terminal. Needs Xvfb, libX11 and libXtst. Exit code 1 if a press
is on record that nobody made, or before it was made. Presses between two trials are not told to an answer.
"""
import argparse
import ctypes
import json
import os
import pathlib
import random
import sqlite3
import statistics
import subprocess
import sys
import tempfile
import threading
import time
import tty

HERE = pathlib.Path(__file__).resolve().parent.parent
KEYS = "asdfghjk"
WIDTH_PX, HEIGHT_PX = 544, 192
# Of the relation of both clocks: a code is read this long after it was sent at most, at best.
CLOCKS_NS = 1_000_000

PROTOCOL = """
[protocol]
name = "keys"
title = "Keys"
[display]
width_px = {width}
height_px = {height}
refresh_hz = 60
width_mm = 272
height_mm = 96
viewing_distance_mm = 573
output = "native-8bit"
gamma = 2.2
linearised_by = "none"
timing = "unproven"
background = 0.1
[bake]
quality = "live"
[tracker]
kind = "none"
[screens]
welcome_text = ""
farewell_text = ""
[view]
width_px = 64
height_px = 64
[animation]
frame_count = 11
frame_rate_hz = 30
duration_s = 1.5
[[object]]
id = "thing"
title = "Thing"
mesh = "thing.ply"
[[material]]
id = "matt"
kind = "diffuse"
[[task]]
id = "press"
question = "Press."
steps = [
  {{ fixation = 0.3 }},
  {{ show = "centre", for_s = 1.5, until = "answer" }},
  {{ answer = "key", limit_s = 1.5 }},
]
[[task.answer]]
id = "key"
kind = "key"
keys = [{keys}]
counts = "last"
ends_stimulus = false
ends_step = false
[[block]]
id = "all"
tasks = "press"
repetitions = {trials}
[[marker_output]]
id = "clock"
address = "{port}"
pulse_ms = 0
codes = ["trial 1", "onset 2", "end 3", "result 4"]
"""
MESH = """ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
element face 4
property list uchar int vertex_indices
end_header
0 0 100
100 0 0
-50 87 0
-50 -87 0
3 0 1 2
3 0 2 3
3 0 3 1
3 1 3 2
"""


class Keyboard:
    """Keys of an X server, down and up at once."""

    def __init__(self, display):
        self.x = ctypes.CDLL("libX11.so.6")
        self.test = ctypes.CDLL("libXtst.so.6")
        self.x.XOpenDisplay.restype = ctypes.c_void_p
        self.display = ctypes.c_void_p(self.x.XOpenDisplay(display.encode()))
        self.codes = {key: self.x.XKeysymToKeycode(self.display, ctypes.c_ulong(ord(key))) for key in KEYS}

    def window(self):
        """The session's, once it is there."""
        root, parent = ctypes.c_ulong(), ctypes.c_ulong()
        children, count = ctypes.POINTER(ctypes.c_ulong)(), ctypes.c_uint()
        top = ctypes.c_ulong(self.x.XDefaultRootWindow(self.display))
        self.x.XQueryTree(self.display, top, ctypes.byref(root), ctypes.byref(parent), ctypes.byref(children),
                          ctypes.byref(count))
        for i in range(count.value):
            place = [ctypes.c_int() for _ in range(2)]
            size = [ctypes.c_uint() for _ in range(4)]
            self.x.XGetGeometry(self.display, ctypes.c_ulong(children[i]), ctypes.byref(root),
                                *map(ctypes.byref, place), *map(ctypes.byref, size))
            if (size[0].value, size[1].value) == (WIDTH_PX, HEIGHT_PX):
                return children[i]
        return None

    def take_focus(self, window):
        self.x.XSetInputFocus(self.display, ctypes.c_ulong(window), 2, ctypes.c_ulong(0))
        self.x.XSync(self.display, 0)

    def press(self, key):
        """Gives when the server was told, by CLOCK_MONOTONIC."""
        at = time.monotonic_ns()
        self.test.XTestFakeKeyEvent(self.display, self.codes[key], 1, ctypes.c_ulong(0))
        self.x.XFlush(self.display)
        time.sleep(0.01)
        self.test.XTestFakeKeyEvent(self.display, self.codes[key], 0, ctypes.c_ulong(0))
        self.x.XFlush(self.display)
        return at


def start_server():
    reading, writing = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(writing), "-screen", "0", "800x600x24", "-nolisten", "tcp",
                               "-noreset"], pass_fds=[writing], stderr=subprocess.DEVNULL)
    os.close(writing)
    number = os.read(reading, 16).decode().strip()
    return server, f":{number}"


def play(program, folder, trials):
    """Runs a session and plays its keyboard. Gives presses [key, time], codes [code, time] and the session's file."""
    port, other_end = os.openpty()
    tty.setraw(port)
    tty.setraw(other_end)
    (folder / "thing.ply").write_text(MESH)
    protocol = folder / "keys.toml"
    protocol.write_text(PROTOCOL.format(width=WIDTH_PX, height=HEIGHT_PX, trials=trials, port=os.ttyname(other_end),
                                        keys=", ".join(f'"{key}"' for key in KEYS)))
    server, display = start_server()
    codes, presses = [], []

    def read_codes():
        while True:
            try:
                got = os.read(port, 1)
            except OSError:
                return
            if got[0] != 0:  # with which a port begins
                codes.append((got[0], time.monotonic_ns()))

    threading.Thread(target=read_codes, daemon=True).start()
    run = None
    try:
        environment = dict(os.environ, DISPLAY=display, WAYLAND_DISPLAY="", XDG_SESSION_TYPE="",
                           OVERT_CACHE=str(folder / "cache"))
        run = subprocess.Popen([program, "run", str(protocol), "--observer", "01", "--context", "window", "--windowed",
                                "--refresh-check", "0", "--sessions", str(folder / "sessions")], env=environment,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        keyboard = Keyboard(display)
        chance = random.Random(1)
        window = None
        while run.poll() is None and not window:
            time.sleep(0.05)
            window = keyboard.window()
        while run.poll() is None and not codes:  # the first trial
            time.sleep(0.005)
        if window and run.poll() is None:
            keyboard.take_focus(window)
        while run.poll() is None and sum(code == 4 for code, _ in codes) < trials:
            key = chance.choice(KEYS)
            presses.append((key, keyboard.press(key)))
            time.sleep(chance.uniform(0.04, 0.12))
        said = run.communicate(timeout=60)[0]
        if run.returncode != 0:
            sys.exit(f"{program} run failed: {said}")
    finally:
        if run and run.poll() is None:
            run.kill()
        server.terminate()
        server.wait()
    return presses, codes, next((folder / "sessions").rglob("session.sqlite"))


def figures_of(presses, codes, file):
    with sqlite3.connect(f"file:{file}?mode=ro", uri=True) as database:
        sent = database.execute("select code, not_after_ns from marker where is_sent order by id").fetchall()
        keys = database.execute(
            "select key, at_ns, uncertainty_ns, presentation_end_ns, state from answer_input join trial using (trial_id) "
            "where kind = 'key down' order by at_ns").fetchall()
    if [code for code, _ in sent] != [code for code, _ in codes][:len(sent)]:
        sys.exit(f"the codes that were read are not those that are on record: {codes[:12]}, {sent[:12]}")
    offset = min(read - at for (_, read), (_, at) in zip(codes, sent))
    groups = {"while the stimulus is shown": [], "on the screen of the answer": []}
    unmatched, early, beyond, used = 0, 0, 0, set()
    for key, at, uncertainty, shown_until, _ in keys:
        candidates = [i for i, (pressed, when) in enumerate(presses)
                      if pressed == key and i not in used and when <= at + offset + CLOCKS_NS]
        if not candidates or at + offset - presses[candidates[-1]][1] > 300_000_000:
            unmatched += 1
            continue
        used.add(candidates[-1])
        error = at + offset - presses[candidates[-1]][1]
        early += error < -CLOCKS_NS
        beyond += error > uncertainty + CLOCKS_NS
        groups["while the stimulus is shown" if at < shown_until else "on the screen of the answer"].append(
            (1e-6 * error, 1e-6 * uncertainty))
    first, last = keys[0][1] + offset, keys[-1][1] + offset
    made = sum(first - CLOCKS_NS <= when <= last - 50_000_000 for _, when in presses)
    figures = {"presses_recorded": len(keys), "presses_made_meanwhile": made, "without_a_press": unmatched,
               "before_their_press": early, "longer_after_than_their_uncertainty": beyond}
    for name, found in groups.items():
        errors = sorted(error for error, _ in found)
        figures[name] = {"presses": len(errors), "median_error_ms": statistics.median(errors),
                         "error_of_95_percent_ms": errors[int(0.95 * (len(errors) - 1))], "largest_error_ms": errors[-1],
                         "standard_deviation_ms": statistics.stdev(errors),
                         "median_uncertainty_ms": statistics.median(uncertainty for _, uncertainty in found)}
    return figures


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--overt", default=str(HERE / "build/release/app/overt"))
    parser.add_argument("--trials", type=int, default=10)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        figures = figures_of(*play(options.overt, pathlib.Path(folder), options.trials))
    if options.json:
        print(json.dumps(figures, indent=2))
    else:
        for name, value in figures.items():
            for what, number in value.items() if isinstance(value, dict) else [("", value)]:
                print(f"{name + (': ' if what else '') + what:64} {number:.2f}" if isinstance(number, float) else
                      f"{name + (': ' if what else '') + what:64} {number}")
    return 1 if figures["without_a_press"] + figures["before_their_press"] else 0


if __name__ == "__main__":
    sys.exit(main())
