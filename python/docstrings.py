"""The docstrings of a stub file as C++, for python/docstrings.h.

    docstrings.py STUBS OUTPUT
"""

import ast
import pathlib
import sys


def documented(body, prefix=""):
    for node in body:
        if not isinstance(node, (ast.ClassDef, ast.FunctionDef)):
            continue
        if ast.get_docstring(node):
            yield prefix + node.name, ast.get_docstring(node)
        if isinstance(node, ast.ClassDef):
            yield from documented(node.body, node.name + ".")


stubs, output = map(pathlib.Path, sys.argv[1:])
texts = documented(ast.parse(stubs.read_text(encoding="utf-8")).body)
lines = "\n".join(f'      {{"{name}", R"doc({text})doc"}},' for name, text in texts)
output.write_text(f"""#include "python/docstrings.h"

namespace emmy::python {{

const std::map<std::string, const char*>& Docstrings() {{
  static const std::map<std::string, const char*> texts = {{
{lines}
  }};
  return texts;
}}

}}  // namespace emmy::python
""", encoding="utf-8")
