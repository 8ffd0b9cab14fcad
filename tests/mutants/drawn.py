"""Changes drawn by chance in the sources of a room, all of them in one build, each behind a switch (places.py finds them)."""
import collections
import hashlib
import json
import os
import pathlib
import random
import re
import shlex
import subprocess
import sys
import time
import tomllib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import places

here = pathlib.Path(__file__).resolve().parent
least_noticed = 0.9
# Test programs that can reach a room, those that say most in the least time first.
programs = ["experiment_tests", "devices_tests", "umockdev_tests", "presentation_tests"]
# What a program is started by: devices behind the kernel's own interfaces are there for it alone.
started_by = {"umockdev_tests": ["umockdev-wrapper"]}


class Test:
    def __init__(self, program, name, file, seconds, reached):
        self.program, self.name, self.file, self.seconds, self.reached = program, name, file, seconds, reached


def targets_of(root, room, text=""):
    """The targets of CMake whose sources a room is: its own or, of a folder without sources, those below it. Only those that
    have a source whose path holds `text`."""
    folders = [room] if list((root / room).glob("*.cpp")) else sorted(
        {str(path.parent.relative_to(root)) for path in (root / room).rglob("*.cpp")})
    folders = [folder for folder in folders if any(text in f"{folder}/{path.name}" for path in (root / folder).glob("*.cpp"))]
    if not folders:
        sys.exit(f"{room}: no sources there" + (f" whose path holds \"{text}\"" if text else ""))
    return {folder: "overt_" + folder.replace("/", "_") for folder in folders}


def draw(found, count, seed):
    """Some of the places, each equally likely, at most a few of a function; a sixth more than asked for, since some may not
    compile."""
    chance = random.Random(seed)
    found = sorted(found, key=lambda change: (change.file, change.edits[0][0], change.edits[0][1], change.kind, change.after))
    chance.shuffle(found)
    functions = len({(change.file, change.function) for change in found})
    most = max(3, -(-2 * count // max(1, functions)))
    drawn, of_function = [], collections.Counter()
    for change in found:
        where = (change.file, change.function)
        if of_function[where] < most:
            of_function[where] += 1
            drawn.append(change)
        if len(drawn) >= count + max(3, count // 6):
            break
    return drawn


def in_files(found, text):
    """The places in files whose path holds `text`."""
    return [change for change in found if text in change.file]


def place_of(change):
    return change.file, tuple(change.edits)


def argued(rows, found, texts):
    """Why, by place, of the changes that equivalent.toml argues to change nothing: each row is of one place. Where several
    of a function read the same, `at` says which, from 1."""
    places_of = collections.defaultdict(list)
    for change in sorted(found, key=lambda change: change.edits[0][:2]):
        places_of[change.key()].append(change)
    reasons = {}
    for row in rows:
        if row["file"] not in texts:
            continue
        alike = places_of[(row["file"], row["in"], row["from"], row["to"])]
        at = row.get("at", 1)
        if not 1 <= at <= len(alike) or len(alike) > 1 and "at" not in row:
            lines = ", ".join(str(change.line) for change in alike)
            sys.exit(f"equivalent.toml: {row['file']}, in {row['in']}: \"{row['from']}\": "
                     + (f"stands in lines {lines}: at = 1 to {len(alike)} says which" if alike else "is not there"))
        reasons[place_of(alike[at - 1])] = row["why"]
    return reasons


def compiled(root, build, folder, commands, texts, drawn):
    """Compiles the room with all changes in it; leaves out those that the compiler refuses. Objects by target."""
    left = dict(enumerate(drawn, 1))
    objects = collections.defaultdict(list)
    for at, (file, directory, command) in enumerate(commands):
        source = pathlib.Path(file)
        target = re.search(r"/(overt_\w+)\.dir/", command[command.index("-o") + 1]).group(1)
        # One file that takes in the changed sources, as that of a unity build takes in the sound ones.
        parts = re.findall(r'#include "(.*)"', source.read_text()) if "/Unity/" in file else [file]
        names = [str(pathlib.Path(part).relative_to(root)) for part in parts]
        made = folder / f"{at}.cpp"
        object_file = folder / f"{at}.o"
        for _ in range(8):
            for name in names:
                own = [(number, change) for number, change in left.items() if change.file == name]
                path = folder / "source" / name
                path.parent.mkdir(parents=True, exist_ok=True)
                written_if_new(path, places.changed(texts[name], own) if name in texts else (root / name).read_bytes())
            written_if_new(made, "".join(f'#include "{folder / "source" / name}"\n' for name in names).encode())
            newest = max([made.stat().st_mtime] + [(folder / "source" / name).stat().st_mtime for name in names]
                         + [header.stat().st_mtime for top in ("experiment", "devices") for header in root.glob(f"{top}/**/*.h")])
            if object_file.exists() and object_file.stat().st_mtime > newest:
                break
            words = [word for word in command if word not in ("-Winvalid-pch",)]
            words = words[:words.index("-o")] + ["-O1", "-include", str(here / "switch.h"), "-w", "-Wno-narrowing", "-fmax-errors=0",
                                                 "-o", str(object_file), "-c", str(made)]
            ran = subprocess.run(words, cwd=directory, capture_output=True, text=True)
            if ran.returncode == 0:
                break
            bad = set()
            for path, line in re.findall(r"^(\S+?):(\d+):\d+: (?:fatal )?(?:error|note)", ran.stderr, re.MULTILINE):
                bad |= {number for number, change in left.items() if str(folder / "source" / change.file) == path
                        and change.line <= int(line) <= change.last_line}
            if not bad:
                sys.exit(f"{made} does not compile:\n{ran.stderr[:3000]}")
            for number in bad:
                del left[number]
        else:
            sys.exit(f"{made} does not compile")
        objects[target].append(object_file)
    return objects, left


def written_if_new(path, text):
    if not path.exists() or path.read_bytes() != text:
        path.write_bytes(text)


def command_of(program):
    return started_by.get(program.name, []) + [str(program)]


def link_command(build, program):
    rows = subprocess.run(["ninja", "-C", str(build), "-t", "commands", program], capture_output=True, text=True, check=True)
    row = next(row for row in reversed(rows.stdout.splitlines()) if re.search(rf" -o (\S+/)?{program} ", row))
    return re.sub(r"^: && ", "", row).split(" && ")[0]


def linked(build, folder, program, libraries, switches):
    """The test program with the changed libraries in place of the sound ones; None where it has none of them."""
    command = shlex.split(link_command(build, program))
    hit, words = False, []
    for word in command:
        name = re.sub(r"^lib|\.a$", "", word.split("/")[-1])
        if word.endswith(".a") and name in libraries:
            hit, word = True, str(libraries[name])
        words.append(word)
    if not hit:
        return None
    at = words.index("-o")
    out = folder / program
    words[at + 1] = str(out)
    words[at:at] = [str(switch) for switch in switches]
    subprocess.run(words, cwd=build, check=True)
    # Where a program looks for the parts of it that it loads.
    if not (folder.parent / "lib").exists():
        (folder.parent / "lib").symlink_to(build / "lib")
    return out


def linked_sessions(build, folder, libraries, switches):
    """The tests of whole sessions and studies, which start the program: a changed one, whose path they are given."""
    program = linked(build, folder, "overt", libraries, switches[:1])
    if not program:
        return None
    started = folder.parent.parent / "app/overt"
    started.parent.mkdir(exist_ok=True)
    started.unlink(missing_ok=True)
    program.rename(started)
    tests = linked(build, folder, "app_tests", libraries, switches)
    sound = str(build / "app/overt").encode()
    at = str(started).encode()
    if len(at) > len(sound):
        sys.exit(f"{started}: a longer path than that of {build / 'app/overt'}; --build names a folder with a shorter one")
    at = at.replace(b"/app/", b"/" * (1 + len(sound) - len(at)) + b"app/")
    tests.write_bytes(tests.read_bytes().replace(sound, at))
    if not (started.parent.parent / "lib").exists():
        (started.parent.parent / "lib").symlink_to(build / "lib")
    return tests


def names_for_catch(names):
    return "".join(name.replace("\\", "\\\\").replace(",", "\\,") + "\n" for name in names)


def reach(program, spec, folder, environment, drawn, longest):
    """What each sound test takes and reaches. Kept beside the program: of the same changes, only tests whose files are others
    now are run again; and of any changes, none that took longer than `longest` before."""
    table, kept_file, times_file = (folder / f"{program.name}.{word}" for word in ("tests", "reached", "seconds"))
    digest_of = lambda file: hashlib.sha256(pathlib.Path(file).read_bytes()).hexdigest() if pathlib.Path(file).is_file() else ""
    kept = json.loads(kept_file.read_text()) if kept_file.exists() else {}
    of_drawn = hashlib.sha256(repr([(number, change.key(), change.line) for number, change in sorted(drawn.items())]).encode()).hexdigest()
    if kept.get("drawn") != of_drawn:
        kept = {"drawn": of_drawn, "tests": {}}
    times = json.loads(times_file.read_text()) if times_file.exists() else {}
    listed = subprocess.run([*command_of(program), "--list-test-names-only", *spec], cwd=folder, capture_output=True, text=True).stdout
    names = [name.strip() for name in listed.splitlines() if name.strip()]
    now = {}
    sound = lambda row: now.setdefault(row["file"], digest_of(row["file"])) == row["digest"]
    kept["tests"] = {name: row for name, row in kept["tests"].items() if sound(row)}
    asked = [name for name in names if name not in kept["tests"] and times.get(name, 0.0) <= longest]
    table.unlink(missing_ok=True)
    if asked:
        (folder / "names").write_text(names_for_catch(asked))
        ran = subprocess.run([*command_of(program), "-f", str(folder / "names")], cwd=folder, capture_output=True,
                             env=environment | {"OVERT_MUTANTS_TESTS": str(table), "OVERT_MUTANTS_REACHED": str(folder / "reached")})
        if ran.returncode < 0:
            print(f"{program.name} ended by a signal without a change", flush=True)
    for row in table.read_text(errors="replace").splitlines() if table.exists() else []:
        name, file, seconds, outcome, reached = row.split("\t")
        if outcome == "before":
            kept["before"] = [int(word) for word in reached.split()]
            continue
        times[name] = min(float(seconds), times.get(name, float(seconds)))
        kept["tests"][name] = {"file": file, "digest": digest_of(file), "seconds": float(seconds), "outcome": outcome,
                               "reached": [int(word) for word in reached.split()]}
    kept_file.write_text(json.dumps(kept))
    times_file.write_text(json.dumps(times))
    tests = []
    for name in names:
        if row := kept["tests"].get(name):
            if row["outcome"] == "passed":
                tests.append(Test(program, name, row["file"], row["seconds"], frozenset(row["reached"])))
            else:
                print(f"fails without a change, and is left out: {name}", flush=True)
    # A number with a name has its value before any test begins: it is for those that reach its file.
    before = set(kept.get("before", [])) & set(drawn)
    for test in tests:
        files = {drawn[number].file for number in test.reached - before if number in drawn}
        test.reached |= {number for number in before if drawn[number].file in files}
    return tests


def order(change, tests):
    """Those that are likeliest to notice first: of a file or folder of the same name; then the quickest."""
    stem, folder = pathlib.Path(change.file).stem, pathlib.Path(change.file).parent
    def rank(test):
        file = pathlib.Path(test.file)
        kin = file.stem.removesuffix("_test") == stem, str(file.parent).endswith("tests/" + str(folder))
        return (not kin[0], not kin[1], test.seconds)
    return sorted(tests, key=rank)


def batches(tests):
    """Runs of tests of one program, the first short, so that what fails at once costs little."""
    most, batch, seconds = 0.5, [], 0.0
    for test in tests:
        if batch and (seconds + test.seconds > most or batch[-1].program != test.program):
            yield batch
            batch, seconds, most = [], 0.0, min(8.0, 2 * most)
        batch.append(test)
        seconds += test.seconds
    if batch:
        yield batch


def first_failure(output):
    rows = output.splitlines()
    for i, row in enumerate(rows):
        if "FAILED:" in row or "FATAL" in row:
            rules = [k for k in range(i) if rows[k].startswith("-----")]
            if len(rules) >= 2:
                return " ".join(line.strip() for line in rows[rules[-2] + 1:rules[-1]] if line.strip())
    return "ended by a signal"


def judge(number, change, tests, folder, environment):
    """Who noticed, or None; "unreached" where no test comes to the place."""
    reaching = [test for test in tests if number in test.reached]
    if not reaching:
        return None, 0
    # What is made once is reached by the first test alone; those of the file's own tests ask for it, too.
    stem = pathlib.Path(change.file).stem
    reaching = order(change, reaching + [test for test in tests if number not in test.reached
                                         and pathlib.Path(test.file).stem.startswith(stem)])
    names = folder / "names"
    for batch in batches(reaching):
        names.write_text(names_for_catch([test.name for test in batch]))
        try:
            ran = subprocess.run([*command_of(batch[0].program), "--abort", "-f", str(names)], cwd=folder, capture_output=True,
                                 text=True, errors="replace", timeout=10 + 8 * sum(test.seconds for test in batch),
                                 env=environment | {"OVERT_MUTANT": str(number)})
        except subprocess.TimeoutExpired:
            return "took too long: " + batch[0].name, len(reaching)
        if ran.returncode not in (0, 77):
            return first_failure(ran.stdout), len(reaching)
    return None, len(reaching)


def diff(root, change):
    """The change as the lines of a diff."""
    line = (root / change.file).read_text().splitlines()[change.line - 1].strip()
    if change.kind == "statement":
        return f"    - {change.before};"
    if change.line == change.last_line and line.count(change.before) == 1:
        return f"    - {line}\n    + {line.replace(change.before, change.after)}"
    return f"    - {change.before}\n    + {change.after}"


def table(results):
    """Noticed of all, less those argued to be equivalent, by room and by kind."""
    rows = collections.defaultdict(lambda: [0, 0, 0, 0])
    for result in results:
        for name in (result["room"], "  " + result["kind"]):
            row = rows[(result["room"], name)]
            row[0] += 1
            row[1] += result["noticed_by"] is not None
            row[2] += result["equivalent"] is not None
            row[3] += result["tests"] == 0
    lines = [f"{'':34}{'drawn':>8}{'noticed':>9}{'argued':>8}{'unreached':>11}{'share':>8}"]
    for (room, name), (count, noticed, argued, unreached) in sorted(rows.items(), key=lambda row: (row[0][0], row[0][1][0] == " ", row[0][1])):
        share = noticed / (count - argued) if count > argued else 1.0
        lines.append(f"{name:34}{count:8}{noticed:9}{argued:8}{unreached:11}{share:8.0%}")
    return "\n".join(lines)


def main(root, options):
    build = options.reuse
    if not (build / "compile_commands.json").exists():
        sys.exit(f"{build}: no build there to take the rest of the program from; --reuse FOLDER names one")
    rows = tomllib.loads((here / "equivalent.toml").read_text()).get("equivalent", [])
    environment = dict(os.environ)
    results = []
    for room in options.generate:
        targets = targets_of(root, room, options.file)
        folder = options.build / "drawn" / room.replace("/", "_")
        folder.mkdir(parents=True, exist_ok=True)
        commands = places.commands_of(build, targets.values())
        found, texts = {}, {}
        name_of = lambda path: (str(pathlib.Path(path).relative_to(root)) if path.endswith(".cpp")
                                and pathlib.Path(path).is_relative_to(root)
                                and str(pathlib.Path(path).parent.relative_to(root)) in targets else "")
        for file, directory, command in commands:
            changes, read = places.find(root, name_of, file, places.words_for_clang(root, command))
            texts |= read
            for change in changes:
                found[(change.file, tuple(change.edits))] = change
        arguments = argued(rows, list(found.values()), texts)
        places_there = in_files(found.values(), options.file)
        drawn = draw(places_there, options.count, options.seed)
        print(f"{room}: {len(places_there)} places" + (f" in files whose path holds {options.file}" if options.file else ""), flush=True)
        if options.list:
            for change in drawn[:options.count]:
                print(f"{change.file}:{change.line}: {change.kind}, in {change.function}\n{diff(root, change)}")
            continue
        objects, left = compiled(root, build, folder, commands, texts, drawn)
        left = dict(list(left.items())[:options.count])
        libraries = {}
        for target, files in objects.items():
            libraries[target] = folder / f"lib{target}.a"
            libraries[target].unlink(missing_ok=True)
            subprocess.run(["ar", "rcs", str(libraries[target])] + [str(file) for file in files], check=True)
        switches = [folder / "switch.o", folder / "switches.o"]
        for switch in switches:
            subprocess.run(["c++", "-std=c++20", "-O1", "-w", f"-I{root}", "-c", str(here / (switch.stem + ".cpp")), "-o",
                            str(switch)], check=True)
        tests = []
        for program in programs + (["app_tests"] if options.sessions else []):
            if program in started_by and not (build / "tests" / program).exists():
                continue
            made = (linked_sessions(build, folder, libraries, switches) if program == "app_tests"
                    else linked(build, folder, program, libraries, switches))
            if made:
                began = time.monotonic()
                tests += reach(made, ["-#", options.tests] if options.tests else [], folder, environment, left, options.longest)
                print(f"{program}: run without a change in {time.monotonic() - began:.0f} s", flush=True)
        if not tests:
            sys.exit(f"{room}: no test program has it, or none of its tests passes without a change")
        tests = [test for test in tests if test.seconds <= options.longest]
        chosen = {int(word) for word in options.numbers.split(",") if word}
        for number, change in left.items():
            if chosen and number not in chosen:
                continue
            began = time.monotonic()
            why = arguments.get(place_of(change))
            by, reaching = (None, -1) if why else judge(number, change, tests, folder, environment)
            results.append({"room": room, "number": number, "file": change.file, "line": change.line, "kind": change.kind,
                            "in": change.function, "from": change.before, "to": change.after, "tests": reaching,
                            "noticed_by": by, "equivalent": why, "seconds": round(time.monotonic() - began, 1)})
            word = "noticed" if by else "equivalent" if why else "UNREACHED" if reaching == 0 else "UNNOTICED"
            print(f"{number:4}/{len(left)}  {word:10} {change.file}:{change.line}: {change.kind}, in {change.function}"
                  + (f"\n{'':17}by: {by}" if by else f"\n{diff(root, change)}"), flush=True)
        if options.json:
            options.json.write_text(json.dumps({"seed": options.seed, "results": results}, indent=2) + "\n")
    if not results:
        return 0
    print(table(results))
    shares = []
    for room in options.generate:
        own = [r for r in results if r["room"] == room and r["equivalent"] is None]
        shares.append(sum(r["noticed_by"] is not None for r in own) >= least_noticed * len(own))
    return 0 if all(shares) else 1
