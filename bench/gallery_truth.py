#!/usr/bin/env python3
"""What simulated observers of each protocol that comes with overt were given, beside what the analysis finds.

    bench/gallery_truth.py [--overt PROGRAM] [--observers N] [--trials N] [--studies FOLDER] [--out FILE.md] [PROTOCOL…]

Each protocol is begun with `overt new --from`, played by simulated observers with live frames, and analysed, by
`overt replicate`; in FOLDER the studies stay, and those that are there are not played again. The table has a row for each number that has a planted value: of answers, areas and spreads. Exit code
1 if a command fails.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent.parent
NUMBER = r"-?\d[\d.e+-]*"
SHARE = r"\d\.\d{3}"
ANSWER = re.compile(rf"^(?P<what>.+?)\s+(?P<planted>{NUMBER})\s+(?P<found>{NUMBER})"
                    rf"(?:\s+(?P<low>{NUMBER}) … (?P<high>{NUMBER}))?$")
AREA = re.compile(rf"^(?P<what>.+?)\s+(?P<planted>{SHARE})(?:\s+(?P<drawn>{SHARE}))?\s+{SHARE}\s+(?P<found>{SHARE})"
                  rf"\s+(?P<low>{NUMBER}) … (?P<high>{NUMBER})$")


def rows_of(said):
    """Of what `overt replicate` prints: what, planted, drawn, found, low, high; None where there is no interval, or nothing drawn."""
    rows, pattern = [], None
    for line in said.splitlines():
        if line.startswith("share of fixations on areas"):
            pattern = AREA
        elif line.startswith("answers, over observers"):
            pattern = ANSWER
        elif pattern and (found := pattern.match(line.rstrip())):
            what = ("share of fixations corrected: " if pattern is AREA else "") + found["what"].strip()
            rows.append((what, found["planted"], found.groupdict().get("drawn"), found["found"], found["low"], found["high"]))
    return rows


def replicate(program, name, folder, options):
    protocol, said = folder / f"{name}.toml", folder / f"{name}.txt"
    if said.exists():
        return rows_of(said.read_text())
    subprocess.run([program, "new", str(protocol), "--from", name], check=True, stdout=subprocess.DEVNULL)
    if "\n[bake]" not in protocol.read_text():
        with open(protocol, "a", encoding="utf-8") as text:
            text.write('\n[bake]\nquality = "live"\n')
    command = [program, "replicate", str(protocol), "--observers", str(options.observers), "--context", "osmesa", "--out",
               str(folder / name)]
    if options.trials:
        command += ["--trials", str(options.trials)]
    ran = subprocess.run(command, capture_output=True, text=True)
    if ran.returncode != 0:
        sys.exit(f"{' '.join(command)}: {ran.stderr}")
    said.write_text(ran.stdout)
    return rows_of(ran.stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("protocols", nargs="*")
    parser.add_argument("--overt", default=str(HERE / "build/release/app/overt"))
    parser.add_argument("--observers", type=int, default=6)
    parser.add_argument("--trials", type=int)
    parser.add_argument("--studies", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path)
    options = parser.parse_args()
    names = options.protocols or sorted(path.stem for path in (HERE / "protocols").glob("*.toml"))
    lines = ["| protocol | what | planted | drawn | found | interval | holds |", "| --- | --- | --- | --- | --- | --- | --- |"]
    intervals = holding = 0
    with tempfile.TemporaryDirectory() as scratch:
        folder = options.studies or pathlib.Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        for name in names:
            rows = replicate(options.overt, name, folder, options)
            if not rows:
                lines.append(f"| {name} | nothing is planted | | | | | |")
            for what, planted, drawn, found, low, high in rows:
                holds = low is not None and float(low) <= float(planted) <= float(high)
                # The ends of a scale are 0 and 1 by its making.
                told = low is not None and low != high
                intervals += told
                holding += told and holds
                shown = f"{low} … {high}" if told else ""
                lines.append(f"| {name} | {what} | {planted} | {drawn or ''} | {found} | {shown} | {('yes' if holds else 'no') if told else ''} |")
            print(f"{name}: {len(rows)} numbers", file=sys.stderr)
    text = "\n".join(lines) + f"\n\n{holding} of {intervals} intervals hold what was planted.\n"
    if options.out:
        options.out.write_text(text, encoding="utf-8")
    else:
        print(text, end="")


if __name__ == "__main__":
    main()
