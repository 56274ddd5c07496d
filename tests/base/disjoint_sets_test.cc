#include "emmy/base/disjoint_sets.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/random_source.h"

namespace emmy {
namespace {

TEST(DisjointSetsTest, EveryNumberIsASetByItselfAtFirst) {
  const DisjointSets sets(3);
  EXPECT_EQ(sets.size(), 3U);
  for (size_t i = 0; i < 3; ++i) EXPECT_EQ(sets.Find(i), i);
}

TEST(DisjointSetsTest, WhatStandsForTheFirstStandsForBoth) {
  DisjointSets sets(5);
  sets.Join(3, 1);
  sets.Join(1, 4);  // 3 stands for 1, hence for 4.
  EXPECT_EQ(sets.Find(4), 3U);
  sets.Join(0, 4);
  for (const size_t i : {0U, 1U, 3U, 4U}) EXPECT_EQ(sets.Find(i), 0U);
  EXPECT_EQ(sets.Find(2), 2U);
  sets.Join(4, 0);  // One set already.
  EXPECT_EQ(sets.Find(3), 0U);
}

TEST(DisjointSetsTest, AgreeWithRelabellingEveryNumber) {
  constexpr size_t kSize = 100;
  RandomSource random(20261123);
  DisjointSets sets(kSize);
  std::vector<size_t> label(kSize);
  for (size_t i = 0; i < kSize; ++i) label[i] = i;
  for (int join = 0; join < 200; ++join) {
    const auto kept = static_cast<size_t>(random.Uniform(0.0, kSize));
    const auto joined = static_cast<size_t>(random.Uniform(0.0, kSize));
    sets.Join(kept, joined);
    const size_t replaced = label[joined];
    const size_t by = label[kept];
    for (size_t& l : label) {
      if (l == replaced) l = by;
    }
    for (size_t i = 0; i < kSize; ++i) ASSERT_EQ(sets.Find(i), label[i]);
  }
}

// Each joined to the next: without shortening, finding all takes n²/2 steps.
TEST(DisjointSetsTest, FindsAMillionNumbersInOneLongRow) {
  constexpr size_t kSize = 1000000;
  DisjointSets sets(kSize);
  for (size_t i = 1; i < kSize; ++i) sets.Join(i, i - 1);
  for (size_t i = 0; i < kSize; ++i) ASSERT_EQ(sets.Find(i), kSize - 1);
}

}  // namespace
}  // namespace emmy
