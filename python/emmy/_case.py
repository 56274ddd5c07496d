"""From Python values to the JSON text that the library reads and checks."""

import json
import math
from collections.abc import Mapping

from ._emmy import InputError


def _plain(value, pointer):
    """`value` as JSON has it: NumPy's arrays and numbers become Python's."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, str):
        return _unicode(value, pointer)
    if isinstance(value, Mapping):
        for key in value:
            if not isinstance(key, str):
                raise InputError(f"{pointer}: keys must be text, got {key!r}")
            _unicode(key, pointer)
        return {
            key: _plain(item, pointer + "/" + _part(key))
            for key, item in value.items()
        }
    if isinstance(value, (list, tuple)):
        return [_plain(item, f"{pointer}/{i}") for i, item in enumerate(value)]
    if isinstance(value, float) and not math.isfinite(value):
        raise InputError(f"{pointer}: must be a finite number, got {value}")
    if value is None or isinstance(value, (bool, int, float)):
        return value
    raise InputError(
        f"{pointer}: must be a value that JSON has, got {type(value).__name__}"
    )


def _unicode(text, place):
    """`text`, if UTF-8 has it: Python's texts may hold half a character."""
    try:
        text.encode()
    except UnicodeEncodeError as error:
        raise InputError(
            f"{place}: must be Unicode text, got {text[error.start]!a} "
            f"at position {error.start}"
        ) from None
    return text


def _part(key):
    return key.replace("~", "~0").replace("/", "~1")


def text(case):
    """The JSON text of a case: a mapping, or text as it is."""
    if isinstance(case, str):
        return _unicode(case, "case")
    if not isinstance(case, Mapping):
        raise TypeError(
            "a case is a dict or JSON text; for a file: Simulation.from_file"
        )
    return json.dumps(_plain(case, ""), ensure_ascii=False)


def settings(overrides):
    """{"/json/pointer": value} as the program's --set has it."""
    if overrides is None:
        return []
    return [
        _unicode(f"{pointer}={json.dumps(_plain(value, pointer))}", "overrides")
        for pointer, value in overrides.items()
    ]
