#include "emmy/numerics/panel_update.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstddef>
#include <vector>

#include "tests/support/instruction_sets.h"
#include "tests/support/random_source.h"

namespace emmy {
namespace {

using PanelUpdateTest = InstructionSetTest;

// A and B in arrays, and what the header says of C without vectors.
struct Product {
  Product(int rows, int inner, int columns, RandomSource* random)
      : a(static_cast<size_t>((rows + 3) * inner + kPanelUpdateUnit)),
        b(static_cast<size_t>(inner * columns)),
        expected(static_cast<size_t>(rows * columns)) {
    for (double& x : a) x = random->Uniform(-1.0, 1.0);
    for (double& x : b) x = random->Uniform(-1.0, 1.0);
    for (int j = 0; j < columns; ++j) {
      for (int i = 0; i < rows; ++i) {
        double sum = 0.0;
        for (int k = 0; k < inner; ++k) {
          const double product = a[static_cast<size_t>(k * (rows + 3) + i)] *
                                 b[static_cast<size_t>(k * columns + j)];
          sum += product;
        }
        expected[static_cast<size_t>(j * rows + i)] = sum;
      }
    }
  }
  std::vector<double> a;  // Columns three numbers longer than there are rows.
  std::vector<double> b;
  std::vector<double> expected;
};

// Sizes on both sides of the blocks of rows and columns.
TEST_F(PanelUpdateTest, EveryInstructionSetGivesTheBitsOfPlainSums) {
  const std::vector<int64_t> targets = InstructionSets();
  RandomSource random(5);
  for (const int rows : {1, 2, 7, 16, 17, 33}) {
    for (const int inner : {1, 3, 8}) {
      for (const int columns : {1, 3, 4, 5, 9}) {
        const Product product(rows, inner, columns, &random);
        const ptrdiff_t stride =
            (rows + kPanelUpdateUnit - 1) / kPanelUpdateUnit * kPanelUpdateUnit;
        for (const int64_t target : targets) {
          ChooseInstructionSet(target);
          std::vector<double> c(static_cast<size_t>(stride * columns));
          PanelUpdate(product.a.data(), rows + 3, rows, inner, product.b.data(),
                      columns, c.data(), stride);
          for (int j = 0; j < columns; ++j) {
            for (int i = 0; i < rows; ++i) {
              EXPECT_EQ(c[static_cast<size_t>(j * stride + i)],
                        product.expected[static_cast<size_t>(j * rows + i)])
                  << hwy::TargetName(target) << ' ' << rows << " x " << inner
                  << " x " << columns;
            }
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace emmy
