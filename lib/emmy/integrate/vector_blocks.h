// Blocks of neighbouring vectors of a large structure.
//
// What joins two vectors of one block is added up by one thread, block by
// block; what joins two blocks comes after all blocks. The blocks depend on
// the structure alone, and so does the order of every sum.

#ifndef EMMY_INTEGRATE_VECTOR_BLOCKS_H_
#define EMMY_INTEGRATE_VECTOR_BLOCKS_H_

#include <cstddef>
#include <optional>

namespace emmy {

class VectorBlocks {
 public:
  explicit VectorBlocks(int num_vectors)
      : num_vectors_(static_cast<size_t>(num_vectors)) {}

  // Number of blocks; 0 where waking a thread takes longer than the work.
  size_t count() const { return num_vectors_ < kManyVectors ? 0 : kBlocks; }

  // The block that both vectors belong to, if there is one.
  std::optional<size_t> Common(int first, int second) const {
    if (count() == 0 || Of(first) != Of(second)) return std::nullopt;
    return Of(first);
  }

 private:
  static constexpr size_t kManyVectors = 4000;
  static constexpr size_t kBlocks = 8;

  size_t Of(int vector) const {
    return static_cast<size_t>(vector) * kBlocks / num_vectors_;
  }

  size_t num_vectors_;
};

}  // namespace emmy

#endif  // EMMY_INTEGRATE_VECTOR_BLOCKS_H_
