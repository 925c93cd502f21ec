#!/usr/bin/python3
"""Judges messages of VDA 5050 a second time, by python3-jsonschema and rules.json, and compares the verdicts.

usage: second_engine_test.py CASES_PROGRAM RULES [SEED COUNT]
"""

import json
import subprocess
import sys

import jsonschema

MOST_SHOWN = 5


def main() -> int:
    program, rules_file = sys.argv[1:3]
    seed, count = sys.argv[3:5] if len(sys.argv) > 3 else ("20261123", "1200")
    with open(rules_file, encoding="utf-8") as file:
        rules = json.load(file)
    jsonschema.Draft202012Validator.check_schema(rules)
    topics = ("order", "instantActions", "state", "visualization", "connection", "factsheet")
    judges = {t: jsonschema.Draft202012Validator({"$ref": f"#/$defs/{t}", "$defs": rules["$defs"]}) for t in topics}
    cases = subprocess.run([program, seed, count], check=True, capture_output=True, text=True).stdout.splitlines()
    differ, sound, refused, of_topic = [], 0, 0, dict.fromkeys(topics, 0)
    for line in cases:
        case = json.loads(line)
        accepted = judges[case["topic"]].is_valid(json.loads(case["text"]))
        sound += case["sound"]
        refused += not accepted
        of_topic[case["topic"]] += not accepted
        if accepted != case["shape"]:
            differ.append((accepted, case))
    print(f"{len(cases)} messages: {sound} sound, {refused} refused by both, {len(differ)} judged differently")
    for accepted, case in differ[:MOST_SHOWN]:
        error = "" if accepted else jsonschema.exceptions.best_match(judges[case["topic"]].iter_errors(json.loads(case["text"])))
        print(f"{case['topic']}: the second engine {'accepts' if accepted else 'refuses'}: {case['text']}\n  {error}")
    # Else there is nothing to compare.
    enough = sound > 60 and refused > int(count) // 4 and min(of_topic.values()) > 0
    if not enough:
        print(f"too few cases of a kind: {of_topic}")
    return 0 if enough and not differ else 1


if __name__ == "__main__":
    sys.exit(main())
