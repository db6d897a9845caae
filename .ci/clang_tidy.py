#!/usr/bin/env python3
"""Runs clang-tidy over every source of a build, several sources at a time.

Most of clang-tidy's time goes into the headers of Eigen, GoogleTest and the standard library, which
it parses and walks once for each source. So the sources of a target are included into one file, and
that is checked. Sources whose names clash are told apart by a look of the compiler's first.

  clang_tidy.py <build folder with compile_commands.json> [<part of a source's path>]...
"""
import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent
ours = f"^{root}/(response|scenes|engine_adapter|render|examples|tests)/"
largest_batch = 24


def read_commands(build, parts):
    """{flags: [source]}: sources of one target with the same flags, each source once."""
    groups, seen = {}, set()
    for entry in json.loads((build / "compile_commands.json").read_text()):
        source = os.path.realpath(os.path.join(entry["directory"], entry["file"]))
        if source in seen or not re.match(ours, source) or not all(p in source for p in parts):
            continue
        seen.add(source)
        flags, output = entry["command"].split(" -o ")
        flags = re.sub(r" -Winvalid-pch -include \S+", "", flags)
        flags = flags[flags.index(" -") :]
        groups.setdefault((entry["directory"], flags, output.split(".dir/")[0]), []).append(source)
    return groups


def unity(sources):
    """Text that includes the sources. Tests get a namespace each, since they define nothing for
    others but repeat names; for that all headers come before them."""
    is_test = lambda source: source.endswith("_test.cpp")
    lines = []
    for source in sources:
        if len(sources) > 1 and is_test(source):
            text = pathlib.Path(source).read_text()
            for header in re.findall(r'^#include [<"](.*)[>"]', text, re.MULTILINE):
                beside = pathlib.Path(source).parent / header
                lines.append(f'#include "{beside}"' if beside.exists() else f"#include <{header}>")
    lines = sorted(set(lines))
    for number, source in enumerate(sorted(sources, key=is_test)):
        include = f'#include "{source}"  // NOLINT(bugprone-suspicious-include)'
        if len(sources) > 1 and is_test(source):
            lines += [f"#define tests tests::source{number}", include, "#undef tests"]
        else:
            lines.append(include)
    return "\n".join(lines) + "\n"


def run(command, directory, sources):
    """Runs a command on the source, or on a file that includes the sources."""
    with tempfile.NamedTemporaryFile("w", suffix=".cpp") as file:
        file.write(unity(sources))
        file.flush()
        name = sources[0] if len(sources) == 1 else file.name
        return subprocess.run([name if word == "FILE" else word for word in command],
                              cwd=directory, capture_output=True, text=True)


def split(directory, flags, sources):
    """Lists of sources that compile as one."""
    if len(sources) == 1:
        return [sources]
    result = run(["clang++", *flags, "-w", "-fsyntax-only", "-ferror-limit=0", "FILE"], directory,
                 sources)
    if result.returncode == 0:
        return [sources]
    clash = set(re.findall(r"^(\S+?):\d+:\d+: error:", result.stderr, re.MULTILINE))
    rest = [source for source in sources if source not in clash]
    clash = [source for source in sources if source in clash]
    if not clash or not rest:
        return [[source] for source in sources]
    return split(directory, flags, rest) + split(directory, flags, clash)


def check(directory, flags, sources):
    """What clang-tidy says of the sources; nothing if it is content."""
    config = subprocess.run(["clang-tidy", "--dump-config", sources[0]], cwd=root,
                            capture_output=True, text=True, check=True).stdout
    # Some of the options that clang-tidy 14 dumps it does not read back; we set none.
    config = re.sub(r"^CheckOptions:.*?^(?=\w|\.)", "", config, flags=re.MULTILINE | re.DOTALL)
    output = ""
    # The static analyser looks at nothing that is included: it gets each source alone.
    analyser = "-clang-analyzer-*" not in config
    rounds = [(together, ["--checks=-clang-analyzer-*"])
              for together in split(directory, flags, sources)]
    if analyser:
        rounds += [([source], ["--checks=-*,clang-analyzer-*"]) for source in sources]
    for together, checks in rounds:
        # -Wshadow would see one source's name hide another's; the builds ask it of each alone.
        result = run(["clang-tidy", "--quiet", f"--config={config}", *checks,
                      f"--header-filter={ours}", "FILE", "--", *flags, "-Wno-shadow"], directory,
                     together)
        if result.returncode != 0:
            output += result.stdout + result.stderr
    return output


def main():
    batches = []
    for (directory, flags, _), sources in read_commands(pathlib.Path(sys.argv[1]), sys.argv[2:]).items():
        count = -(-len(sources) // largest_batch)
        batches += [(directory, shlex.split(flags), sources[k::count]) for k in range(count)]
    batches.sort(key=lambda batch: -len(batch[2]))
    failed = False
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for output in pool.map(lambda batch: check(*batch), batches):
            if output:
                failed = True
                print(output, flush=True)
    sys.exit(failed)


if __name__ == "__main__":
    main()
