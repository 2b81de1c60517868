"""Real reports of each solver fit the schema that describes them, and damaged ones do not.

    check_report.py PENUMBRA SCHEMA SCRATCH
"""

import copy
import json
import pathlib
import subprocess
import sys

import jsonschema

program, schema_path, scratch = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
scratch.mkdir(parents=True, exist_ok=True)


def demand(condition, what):
    if not condition:
        sys.exit("failed: " + what)


schema = json.loads(schema_path.read_text())
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)
SOLVES = {
    "hierarchical": ["--bounces", "2"],
    "dense": ["--divisions", "1"],
    "sampled": ["--rays", "16"],
}
for solver, options in SOLVES.items():
    subprocess.run([program, "solve", "furnace", "--solver", solver, "--error", "0.3", "--error-points", "20", *options,
                    "--report", "report.json"], cwd=scratch, check=True, capture_output=True)
    report = json.loads((scratch / "report.json").read_text())
    errors = [f"{list(e.absolute_path)}: {e.message}" for e in validator.iter_errors(report)]
    demand(not errors, f"{solver}: " + "; ".join(errors[:5]))
    # Every member is described: a name that the schema does not know is a misspelt one, or a new one to describe.
    known = schema["properties"]
    demand(set(report) <= set(known), f"{solver}: {set(report) - set(known)} is not described")
    demand(set(report["error"]) <= set(known["error"]["properties"]), f"{solver}: errors are described")
    demand(set(report["counts"]) <= set(known["counts"]["properties"]), f"{solver}: counts are described")

for key in schema["required"]:
    damaged = copy.deepcopy(report)
    del damaged[key]
    demand(not validator.is_valid(damaged), f"a report without {key} is none")
damaged = copy.deepcopy(report)
damaged["phases"] = damaged["phases"][1:]
demand(not validator.is_valid(damaged), "each phase is told")
damaged = copy.deepcopy(report)
damaged["counts"]["patches"] = -1
demand(not validator.is_valid(damaged), "nothing is counted below 0")
