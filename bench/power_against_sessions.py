#!/usr/bin/env python3
"""Whether whole studies find an effect as often as `overt power` says.

    bench/power_against_sessions.py [--overt PROGRAM] [--observers N] [--studies N] [--jobs N] [--out DIR] [--json]
                                    [--head-odds X | --spot-share X | --wss-ratio X --spread S] [--material ID --against ID] PROTOCOL

Plants the effect in a copy of the protocol as `[[simulated_effect]]`, simulates studies of whole sessions with
`overt replicate` (schedule, presentation in virtual time, tracker, detected fixations, maps, analysis), and counts in
how many table1_pairs has p <= 0.05; beside it the share that `overt power` predicts for the same design. Exit code 1 if
the two differ at the 1 % level (Fisher's exact test). Of head fractions and WSS it also compares the sizes that were
found, mean and standard deviation over studies, which tells more than shares do. A ratio of WSS is planted by the spread that `overt power` prints for it.
What is finished in --out is not done again.
"""
import argparse
import csv
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent.parent
ALPHA = 0.05


def fisher_p(found_a, of_a, found_b, of_b):
    """Two-sided, by adding up all tables that are not more likely than this one."""
    found = found_a + found_b

    def chance(first):
        return math.exp(sum(math.lgamma(n + 1) - math.lgamma(k + 1) - math.lgamma(n - k + 1)
                            for n, k in ((of_a, first), (of_b, found - first)))
                        - (math.lgamma(of_a + of_b + 1) - math.lgamma(found + 1)
                           - math.lgamma(of_a + of_b - found + 1)))

    here = chance(found_a)
    return min(1.0, sum(p for p in map(chance, range(max(0, found - of_b), min(of_a, found) + 1))
                        if p <= here * (1 + 1e-9)))


def difference_of_means(a, b):
    """Mean and standard deviation of both, and their difference in standard errors."""
    def moments(values):
        mean = sum(values) / len(values)
        return mean, math.sqrt(sum((v - mean) ** 2 for v in values) / max(1, len(values) - 1))
    (mean_a, sd_a), (mean_b, sd_b) = moments(a), moments(b)
    error = math.sqrt(sd_a ** 2 / len(a) + sd_b ** 2 / len(b))
    return {"mean": mean_a, "sd": sd_a, "predicted_mean": mean_b, "predicted_sd": sd_b,
            "difference_in_standard_errors": (mean_a - mean_b) / error if error > 0 else None}


def found_in_study(analysis, args, columns):
    """p and size, of the row over everything else that compares the two materials; the size as of --material."""
    table = "area_pairs.csv" if columns[0] == "p" else "table1_pairs.csv"
    with open(analysis / table, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row.get("area", "head") != "head":
                continue
            others = [row[name] for name in ("task", "object", "observer") if name in row]
            if (row["compared"] == "material" and {row["a"], row["b"]} == {args.material, args.against}
                    and all(level == "all" for level in others)):
                size = float(row[columns[1]]) if columns[1] else None
                return float(row[columns[0]]), size if size is None or row["a"] == args.material else -size
    raise SystemExit(f"{analysis}/{table}: no row compares {args.material} with {args.against}.")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("protocol", type=pathlib.Path)
    parser.add_argument("--overt", default=str(HERE / "build/release/app/overt"))
    parser.add_argument("--observers", type=int, default=8)
    parser.add_argument("--studies", type=int, default=40)
    parser.add_argument("--predicted-studies", type=int, default=400)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--out", type=pathlib.Path)
    parser.add_argument("--material", default="rough")
    parser.add_argument("--against", default="smooth")
    parser.add_argument("--head-odds", type=float)
    parser.add_argument("--spot-share", type=float)
    parser.add_argument("--wss-ratio", type=float)
    parser.add_argument("--spread", type=float)
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()
    # What is planted, what is predicted, and the column that tells whether it was found.
    kinds = [(args.head_odds, f"head_odds = {args.head_odds}", "head", f"odds={args.head_odds}", ("p", "difference")),
             (args.spot_share, f"spot_share = {args.spot_share}", "cc", f"share={args.spot_share}", ("maps_p", None)),
             (args.wss_ratio, f"spread = {args.spread}", "wss", f"ratio={args.wss_ratio}", ("wss_p", "wss_difference_mm2"))]
    chosen = [kind[1:] for kind in kinds if kind[0] is not None]
    if len(chosen) != 1 or (args.wss_ratio is None) != (args.spread is None):
        parser.error("give one of --head-odds, --spot-share, and --wss-ratio with its --spread")
    key, measure, size, columns = chosen[0]
    effect = f"{measure}:material={args.material}:against={args.against}:{size}"
    out = args.out or pathlib.Path(tempfile.mkdtemp(prefix="power_against_sessions_"))
    out.mkdir(parents=True, exist_ok=True)
    text = args.protocol.read_text(encoding="utf-8")
    if re.search(r"^\s*\[\[simulated_effect\]\]", text, re.MULTILINE):
        raise SystemExit(f"{args.protocol}: has a [[simulated_effect]] already. Take it out.")
    # Beside the original, for its paths are relative to the file.
    planted = args.protocol.with_name(f".{args.protocol.stem}_planted.toml")
    planted.write_text(f'{text}\n[[simulated_effect]]\nmaterial = "{args.material}"\n{key}\n', encoding="utf-8")

    def overt(*arguments):
        done = subprocess.run([args.overt, *map(str, arguments)], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise SystemExit(f"overt {' '.join(map(str, arguments))}\n{done.stderr}")
        return done.stdout

    try:
        overt("power", args.protocol, "--effect", effect, "--observers", args.observers, "--studies",
              args.predicted_studies, "--out", out / "predicted", "--overwrite")
        with open(out / "predicted/power_studies.csv", newline="", encoding="utf-8") as file:
            studies = list(csv.DictReader(file))
        predicted = [float(row["p"]) for row in studies]
        values, sizes = [], []
        for study in range(args.studies):
            folder = out / f"study_{study + 1:03}"
            analyses = list(folder.rglob("table1_pairs.csv"))
            if not analyses:
                overt("replicate", planted, "--observers", args.observers, "--seed", 1000 * (study + 1), "--jobs",
                      args.jobs, "--out", folder, "--overwrite")
                analyses = list(folder.rglob("table1_pairs.csv"))
                subprocess.run(["rm", "-rf", *map(str, folder.glob("sessions"))], check=False)
            p, found_size = found_in_study(analyses[0].parent, args, columns)
            values.append(p)
            sizes.append(found_size)
            if not args.json:
                print(f"study {study + 1} of {args.studies}: p = {p:.4f}, size {found_size}", flush=True)
    finally:
        planted.unlink(missing_ok=True)
    found = sum(p <= ALPHA for p in values)
    found_predicted = sum(p <= ALPHA for p in predicted)
    p = fisher_p(found, len(values), found_predicted, len(predicted))
    result = {"effect": effect, "observers": args.observers, "studies": len(values), "found": found,
              "share": found / len(values), "predicted_studies": len(predicted),
              "predicted_share": found_predicted / len(predicted), "p_of_difference": p}
    if columns[1]:
        result["sizes"] = difference_of_means(sizes, [float(row["estimate"]) for row in studies])
    if args.json:
        print(json.dumps(result, indent=2))
    else:
        print(f"{effect}, {args.observers} observers: {found} of {len(values)} whole studies found it "
              f"({100 * result['share']:.0f} %); predicted {100 * result['predicted_share']:.1f} %; difference p = {p:.2f}")
        if columns[1]:
            print("sizes found: mean {mean:.4f}, SD {sd:.4f}; predicted {predicted_mean:.4f}, {predicted_sd:.4f}; the means "
                  "differ by {difference_in_standard_errors:.1f} standard errors".format(**result["sizes"]))
    return 1 if p < 0.01 else 0


if __name__ == "__main__":
    sys.exit(main())
