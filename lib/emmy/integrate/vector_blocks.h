// Blocks of neighbouring vectors of a large structure.
//
// What joins two vectors of one block is added up by one thread, block by
// block; what joins two blocks comes after all blocks. The blocks depend on
// the structure alone, and so does the order of every sum.

#ifndef EMMY_INTEGRATE_VECTOR_BLOCKS_H_
#define EMMY_INTEGRATE_VECTOR_BLOCKS_H_

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "emmy/base/work_team.h"

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

// Items that each join two vectors: those of every block, and the rest.
template <typename Item>
class BlockedItems {
 public:
  explicit BlockedItems(int num_vectors)
      : blocks_(num_vectors), of_block_(blocks_.count()) {}

  // Whether the item belongs to a block.
  bool Add(Item item, int first, int second) {
    const std::optional<size_t> block = blocks_.Common(first, second);
    (block.has_value() ? of_block_[*block] : rest_).push_back(std::move(item));
    return block.has_value();
  }

  // Calls work(item) for those of blocks: of one block one after the other,
  // blocks at the same time.
  template <typename Work>
  void ForBlocks(WorkTeam* team, const Work& work) const {
    if (of_block_.empty()) return;
    team->Run(of_block_.size(),
              [&](size_t /*member*/, size_t first, size_t end) {
                for (size_t block = first; block < end; ++block) {
                  for (const Item& item : of_block_[block]) work(item);
                }
              });
  }

  // Those of no block, in the order in which they were added.
  const std::vector<Item>& rest() const { return rest_; }

 private:
  VectorBlocks blocks_;
  std::vector<std::vector<Item>> of_block_;
  std::vector<Item> rest_;
};

}  // namespace emmy

#endif  // EMMY_INTEGRATE_VECTOR_BLOCKS_H_
