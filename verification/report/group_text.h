// What a group of claims is about.

#ifndef EMMY_VERIFICATION_REPORT_GROUP_TEXT_H_
#define EMMY_VERIFICATION_REPORT_GROUP_TEXT_H_

#include <string>
#include <string_view>

namespace emmy::verification {

struct GroupText {
  std::string title;
  std::string introduction;  // "" for a group that has none.
};

// For a group that is not known: its id with spaces, and no introduction.
GroupText DescribeGroup(std::string_view group);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_REPORT_GROUP_TEXT_H_
