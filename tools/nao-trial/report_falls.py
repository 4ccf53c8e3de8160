#!/usr/bin/python3
"""Which disturbance costs how many falls: runs a scenario of nao-trial with each entry of
data/disturbances/real.yaml alone, and with whole files, and prints a table in Markdown."""

import argparse
import json
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent


def parse_arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, epilog="Further options are nao-trial's: --vx 0.2 --duration 12, --distance 3")
    parser.add_argument("scenario", nargs="?", default="sprint", help="scenario of nao-trial")
    parser.add_argument("--seeds", default="1-40", help="first and last seed (%(default)s)")
    parser.add_argument("--files", default="default,moderate,real",
                        help="whole files, with commas between them (%(default)s)")
    parser.add_argument("--entries", help="entries of real, with commas between them (all)")
    parser.add_argument("--jobs", type=int, default=1, help="trials at the same time (%(default)s)")
    parser.add_argument("--program", default=str(ROOT / "build/dev/bin/nao-trial"),
                        help="nao-trial (%(default)s)")
    return parser.parse_known_args()


def entries_of_real():
    text = (ROOT / "data/disturbances/real.yaml").read_text()
    return re.findall(r"^([a-z_]+):", text, re.MULTILINE)


def run(program, scenario, seeds, disturbances, options):
    """@return the summary that nao-trial writes."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "summary.json"
        command = [program, scenario, "--seeds", seeds, "--disturbances", disturbances, "--json", str(file)]
        done = subprocess.run(command + options, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if done.returncode != 0:
            sys.exit(f"report_falls: {' '.join(command)} failed:\n{done.stderr}")
        return json.loads(file.read_text())


def main():
    arguments, options = parse_arguments()
    entries = arguments.entries.split(",") if arguments.entries else entries_of_real()
    cases = [name for name in arguments.files.split(",") if name] + entries
    with ThreadPoolExecutor(arguments.jobs) as pool:
        summaries = pool.map(lambda case: run(arguments.program, arguments.scenario, arguments.seeds, case, options),
                             cases)
        print(f"`nao-trial {' '.join([arguments.scenario, '--seeds', arguments.seeds] + options)} "
              "--disturbances ...`:\n")
        print("| Disturbances | Failed | Of | Speed, m/s (median) |\n| --- | --- | --- | --- |")
        for case, summary in zip(cases, summaries):
            speed = summary["metrics"].get("speed_mps")
            print(f"| {case} | {summary['runs'] - summary['successes']} | {summary['runs']} | "
                  f"{'' if speed is None else format(speed['median'], '.3f')} |", flush=True)


if __name__ == "__main__":
    main()
