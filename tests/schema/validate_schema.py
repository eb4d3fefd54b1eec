#!/usr/bin/python3
"""Validates JSON files against a schema of docs/.

usage: validate_schema.py SCHEMA FILE...

Exits with 0 where all files are valid, 1 where one is not (one line each on standard error), 2 on
bad usage or a schema that is none.
"""

import json
import sys

import jsonschema


def _refuse_constant(text):
    raise ValueError(f"{text} is not JSON")


def _unique_members(pairs):
    members = dict(pairs)
    if len(members) != len(pairs):
        raise ValueError("a key is repeated")
    return members


def load(path):
    """The file's JSON value, as strictly as the programs read it."""
    with open(path, encoding="utf-8-sig") as file:
        return json.load(
            file, parse_constant=_refuse_constant, object_pairs_hook=_unique_members
        )


def validator(schema_path):
    """The validator of a schema file, which must itself be valid."""
    schema = load(schema_path)
    kind = jsonschema.validators.validator_for(schema, default=None)
    if kind is None:
        raise ValueError("names no known draft of JSON Schema")
    kind.check_schema(schema)
    return kind(schema)


def complaints(schema_validator, value):
    """One line for each breach, the place first."""
    lines = []
    for error in schema_validator.iter_errors(value):
        place = "/" + "/".join(str(part) for part in error.absolute_path)
        lines.append(f"{place}: {error.message}")
    return sorted(lines)


def main(arguments):
    if len(arguments) < 2:
        print(__doc__, file=sys.stderr)
        return 2
    try:
        schema_validator = validator(arguments[0])
    except (OSError, ValueError, jsonschema.SchemaError) as error:
        print(f"{arguments[0]}: {error}", file=sys.stderr)
        return 2
    status = 0
    for path in arguments[1:]:
        try:
            lines = complaints(schema_validator, load(path))
        except (OSError, ValueError) as error:
            lines = [str(error)]
        for line in lines:
            print(f"{path}: {line}", file=sys.stderr)
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
