// A number of a published reference file, written there as text so that no
// digit is lost.

#ifndef EMMY_VERIFICATION_RUNS_PUBLISHED_NUMBER_H_
#define EMMY_VERIFICATION_RUNS_PUBLISHED_NUMBER_H_

#include <nlohmann/json.hpp>
#include <string>

#include "absl/strings/numbers.h"

namespace emmy::verification {

// The double nearest to the text, however many digits it has. Throws what the
// JSON library throws for a value of the wrong type if it is not a number.
inline double PublishedNumber(const nlohmann::json& json) {
  double value = 0.0;
  if (!absl::SimpleAtod(json.get<std::string>(), &value)) {
    throw nlohmann::json::other_error::create(
        501, "not a number: " + json.dump(), &json);
  }
  return value;
}

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_RUNS_PUBLISHED_NUMBER_H_
