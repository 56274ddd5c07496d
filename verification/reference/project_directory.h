// Where the project's own files are: reference data, documents.

#ifndef EMMY_VERIFICATION_REFERENCE_PROJECT_DIRECTORY_H_
#define EMMY_VERIFICATION_REFERENCE_PROJECT_DIRECTORY_H_

#include <string>

namespace emmy::verification {

// The sources this program was built from; the environment variable
// EMMY_PROJECT_DIRECTORY, if that is set and not empty.
std::string ProjectDirectory();

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_REFERENCE_PROJECT_DIRECTORY_H_
