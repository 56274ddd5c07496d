// Every field of a case as text, with all bits of every number: two cases are
// the same if and only if their texts are. Independent of the JSON format.

#ifndef EMMY_TESTS_IO_CASE_TEXT_H_
#define EMMY_TESTS_IO_CASE_TEXT_H_

#include <string>

#include "emmy/io/case.h"

namespace emmy {

std::string CaseText(const Case& value);

}  // namespace emmy

#endif  // EMMY_TESTS_IO_CASE_TEXT_H_
