// The JSON text of a case: the inverse of reading it.

#ifndef EMMY_IO_CASE_WRITER_H_
#define EMMY_IO_CASE_WRITER_H_

#include <string>

#include "emmy/base/export.h"
#include "emmy/io/case.h"

namespace emmy {

// Text of the format emmy-case/1. Reading it gives the same case, bit for bit:
// every double is written with the digits that determine it. Keys with their
// default value are written too, except empty lists and an empty purpose.
// Needs finite numbers (JSON has no others).
EMMY_EXPORT std::string WriteCase(const Case& value);

}  // namespace emmy

#endif  // EMMY_IO_CASE_WRITER_H_
