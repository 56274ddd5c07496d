// The checksum is the one it is said to be, and finds what it promises.

#include "emmy/base/crc64.h"

#include <gtest/gtest.h>

#include <string>

namespace emmy {
namespace {

// The check value that catalogues of such sums list for CRC-64/XZ.
TEST(Crc64Test, HasThePublishedCheckValue) {
  EXPECT_EQ(Crc64("123456789"), 0x995DC9BBDF1939FAU);
  EXPECT_EQ(Crc64(""), 0U);
}

TEST(Crc64Test, GoesOnFromAnyPlace) {
  const std::string text = "a message in two parts";
  for (size_t i = 0; i <= text.size(); ++i) {
    EXPECT_EQ(Crc64(text.substr(i), Crc64(text.substr(0, i))), Crc64(text));
  }
}

TEST(Crc64Test, FindsEveryFlippedBit) {
  const std::string text = "a message with one wrong bit";
  for (size_t i = 0; i < 8 * text.size(); ++i) {
    std::string wrong = text;
    wrong[i / 8] = static_cast<char>(wrong[i / 8] ^ (1 << (i % 8)));
    EXPECT_NE(Crc64(wrong), Crc64(text)) << "bit " << i;
  }
}

}  // namespace
}  // namespace emmy
