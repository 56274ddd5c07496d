#include "emmy/base/crc64.h"

#include <array>
#include <cstddef>

namespace emmy {
namespace {

constexpr uint64_t kReflectedPolynomial = 0xC96C5795D7870F42U;

// Entry i: what the byte i contributes.
constexpr std::array<uint64_t, 256> MakeTable() {
  std::array<uint64_t, 256> table = {};
  for (size_t i = 0; i < table.size(); ++i) {
    uint64_t value = i;
    for (int bit = 0; bit < 8; ++bit) {
      value = (value >> 1) ^ ((value & 1U) != 0 ? kReflectedPolynomial : 0U);
    }
    table[i] = value;
  }
  return table;
}

constexpr std::array<uint64_t, 256> kTable = MakeTable();

}  // namespace

uint64_t Crc64(std::string_view bytes, uint64_t before) {
  uint64_t value = ~before;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    value = kTable[(value ^ byte) & 0xFFU] ^ (value >> 8);
  }
  return ~value;
}

}  // namespace emmy
