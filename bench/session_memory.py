#!/usr/bin/env python3
"""Memory of a whole session: runs `overt run` in virtual time with a simulated observer and watches what is resident.

    bench/session_memory.py [--overt PROGRAM] [--json] [PROTOCOL]

Gives the peak from the first trial on, and by how much the last third of the trials' peak is above that of the
second third: what a session keeps of each trial would show there. Exit code 1 if a bound is missed.
"""
import argparse
import json
import pathlib
import sqlite3
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent.parent
MOST_MB = 1000.0
MOST_GROWTH_MB = 10.0


def resident_mb(pid):
    """Of a process, in MB of 10^6 bytes, as [now, highest so far]; nothing once it has ended."""
    try:
        lines = pathlib.Path(f"/proc/{pid}/status").read_text().splitlines()
    except OSError:
        return None
    fields = dict(line.split(":", 1) for line in lines if ":" in line)
    if "VmRSS" not in fields:
        return None
    return [int(fields[key].split()[0]) * 1024e-6 for key in ("VmRSS", "VmHWM")]


def trials_done(folder):
    """Finished trials of the one session under the folder; nothing before there is one."""
    for file in pathlib.Path(folder).rglob("session.sqlite"):
        try:
            with sqlite3.connect(f"file:{file}?mode=ro", uri=True) as database:
                return database.execute("select count(*) from trial where status = 'completed'").fetchone()[0]
        except sqlite3.Error:
            pass
    return None


def watch(program, protocol, folder):
    """Samples [trials done, resident MB] while a session runs."""
    run = subprocess.Popen(
        [program, "run", protocol, "--observer", "P01", "--simulate-observer", "1", "--virtual-time",
         "--context", "osmesa", "--sessions", folder, "--seed", "1"],
        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    samples = []
    while run.poll() is None:
        memory, done = resident_mb(run.pid), trials_done(folder)
        if memory and done is not None:
            samples.append((done, memory[0]))
        time.sleep(0.1)
    if run.returncode != 0:
        sys.exit(f"{program} run failed: {run.stderr.read()}")
    return samples


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--overt", default=str(HERE / "build/release/app/overt"))
    arguments.add_argument("--json", action="store_true")
    arguments.add_argument("protocol", nargs="?", default=str(HERE / "protocols/overt_2019.toml"))
    given = arguments.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        samples = watch(given.overt, given.protocol, folder)
    if not samples:
        sys.exit("the session was too short to be watched")
    trials = samples[-1][0]
    peak = max(mb for _, mb in samples)
    middle = max(mb for done, mb in samples if trials / 3 <= done < 2 * trials / 3)
    late = max(mb for done, mb in samples if done >= 2 * trials / 3)
    figures = [
        {"figure": "session, trials", "value": trials, "unit": ""},
        {"figure": "session, resident memory, peak", "value": round(peak, 1), "unit": "MB",
         "target": f"<= {MOST_MB:g}", "holds": peak <= MOST_MB},
        {"figure": "session, peak of the last third of trials above the second's", "value": round(late - middle, 1),
         "unit": "MB", "target": f"<= {MOST_GROWTH_MB:g}", "holds": late - middle <= MOST_GROWTH_MB},
    ]
    if given.json:
        print(json.dumps({"figures": figures}, indent=2))
    else:
        for figure in figures:
            print(f"{figure['figure']:70} {figure['value']:>10} {figure['unit']:4} {figure.get('target', '')}")
    sys.exit(0 if all(figure.get("holds", True) for figure in figures) else 1)


if __name__ == "__main__":
    main()
