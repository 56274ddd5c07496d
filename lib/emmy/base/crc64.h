// A checksum that finds damage and mix-ups: CRC-64.
//
//   the remainder of message(x) · x⁶⁴ divided by
//   x⁶⁴ + x⁶² + x⁵⁷ + … + x⁴ + x + 1, the polynomial of ECMA-182,
// bits reflected, register and result inverted; known as CRC-64/XZ.
// Any change within 64 consecutive bits is found, every other with
// probability 1 − 2⁻⁶⁴. No protection against intent: who wants to, can make
// another message with the same sum.

#ifndef EMMY_BASE_CRC64_H_
#define EMMY_BASE_CRC64_H_

#include <cstdint>
#include <string_view>

namespace emmy {

// The sum of a message whose first part has the sum `before` and
// whose rest is `bytes`; the sum of nothing is 0.
uint64_t Crc64(std::string_view bytes, uint64_t before = 0);

}  // namespace emmy

#endif  // EMMY_BASE_CRC64_H_
