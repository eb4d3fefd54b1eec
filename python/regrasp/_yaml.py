"""Strict YAML reader: only data, unique keys, and a bounded expansion of aliases."""

from __future__ import annotations

import re

import yaml

from . import _arguments
from ._regrasp import InputError


class _Loader(yaml.SafeLoader):

    def construct_mapping(self, node, deep=False):
        seen = set()
        for key, _ in node.value if isinstance(node, yaml.MappingNode) else ():
            if isinstance(key, yaml.ScalarNode):
                if key.value in seen:
                    raise yaml.constructor.ConstructorError(
                        problem=f"key {_arguments.shown(key.value)} is repeated",
                        problem_mark=key.start_mark)
                seen.add(key.value)
        return super().construct_mapping(node, deep)


# YAML 1.1 treats numbers such as 1e-05, without a point or a sign, as text. JSON writes them so.
_Loader.add_implicit_resolver("tag:yaml.org,2002:float", re.compile(
    r"[-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)[eE][-+]?[0-9]+$"), list("-+.0123456789"))


def read(path: str) -> object:
    """Return the content of a file: dictionaries, lists, texts and numbers.

    Raises:
        InputError: If the file is not valid YAML, has a duplicate key, or aliases that expand too
            far.
    """
    try:
        with open(path, encoding="utf-8") as file:
            data = yaml.load(file, _Loader)
    except OSError:
        raise
    except RecursionError:
        raise InputError(f"{path}: not a YAML file: nested too deep") from None
    except Exception as error:  # parser errors, and invalid numbers and dates
        raise InputError(f"{path}: not a YAML file: {' '.join(str(error).split())}") from None
    return _arguments.bounded(path, data)
