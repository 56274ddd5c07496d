// What help() says: the docstrings of the stubs, python/emmy/_emmy.pyi.

#ifndef EMMY_PYTHON_DOCSTRINGS_H_
#define EMMY_PYTHON_DOCSTRINGS_H_

#include <map>
#include <string>

namespace emmy::python {

// By "Class", "Class.member" or "function". Written by python/docstrings.py.
const std::map<std::string, const char*>& Docstrings();

}  // namespace emmy::python

#endif  // EMMY_PYTHON_DOCSTRINGS_H_
