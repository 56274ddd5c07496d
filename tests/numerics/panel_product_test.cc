#include "emmy/numerics/panel_product.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <string>
#include <vector>

#include "emmy/base/types.h"
#include "tests/support/instruction_sets.h"
#include "tests/support/random_source.h"

namespace emmy {
namespace {

template <typename Scalar>
using Panel = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
template <typename Scalar>
using Entries = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

template <typename Scalar>
class PanelProductTest : public InstructionSetTest {
 protected:
  // Every remainder of blocks of rows and columns.
  static std::vector<std::pair<int, int>> Shapes() {
    std::vector<std::pair<int, int>> shapes;
    for (const int rows : {1, 2, 3, 4, 5, 7, 8, 9, 16, 17, 23, 40}) {
      for (const int columns : {1, 2, 3, 4, 5, 9}) {
        shapes.emplace_back(rows * kPanelRowUnit<Scalar>, columns);
      }
    }
    return shapes;
  }

  static Panel<Scalar> RandomPanel(int rows, int columns,
                                   RandomSource* random) {
    Panel<Scalar> panel(rows, columns);
    for (Eigen::Index i = 0; i < panel.size(); ++i) {
      panel(i) = static_cast<Scalar>(random->Uniform(-1.0, 1.0));
    }
    return panel;
  }
};

using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(PanelProductTest, Scalars);

// Whole numbers: every order of the sum gives the same, so that one wrong
// element shows.
TYPED_TEST(PanelProductTest, ProductsOfWholeNumbersAreExact) {
  RandomSource random(3);
  for (const auto& [rows, columns] : this->Shapes()) {
    const Panel<TypeParam> panel =
        (TypeParam(100) * this->RandomPanel(rows, columns, &random))
            .array()
            .round();
    const Entries<TypeParam> x =
        (TypeParam(10) * this->RandomPanel(columns, 1, &random))
            .array()
            .round();
    const Entries<TypeParam> v =
        (TypeParam(10) * this->RandomPanel(rows, 1, &random)).array().round();
    Entries<TypeParam> y(rows);
    PanelTimes(panel.data(), rows, columns, x.data(), y.data());
    EXPECT_EQ(y, panel * x) << rows << " x " << columns;
    Entries<TypeParam> z(columns);
    TransposedPanelTimes(panel.data(), rows, columns, v.data(), z.data());
    EXPECT_EQ(z, panel.transpose() * v) << rows << " x " << columns;
  }
}

TYPED_TEST(PanelProductTest, EveryInstructionSetGivesTheSameBits) {
  const std::vector<int64_t> targets = this->InstructionSets();
  RandomSource random(4);
  for (const auto& [rows, columns] : this->Shapes()) {
    const Panel<TypeParam> panel = this->RandomPanel(rows, columns, &random);
    const Entries<TypeParam> x = this->RandomPanel(columns, 1, &random);
    const Entries<TypeParam> v = this->RandomPanel(rows, 1, &random);
    Entries<TypeParam> first_y;
    Entries<TypeParam> first_z;
    for (const int64_t target : targets) {
      ChooseInstructionSet(target);
      Entries<TypeParam> y(rows);
      Entries<TypeParam> z(columns);
      PanelTimes(panel.data(), rows, columns, x.data(), y.data());
      TransposedPanelTimes(panel.data(), rows, columns, v.data(), z.data());
      if (first_y.size() == 0) {
        first_y = y;
        first_z = z;
      }
      EXPECT_EQ(y, first_y) << hwy::TargetName(target) << ' ' << rows;
      EXPECT_EQ(z, first_z) << hwy::TargetName(target) << ' ' << rows;
    }
  }
}

// What is fetched for later is read by nobody, wherever it lies.
TYPED_TEST(PanelProductTest, FetchingTheNextPanelChangesNoBit) {
  RandomSource random(5);
  for (const auto& [rows, columns] : this->Shapes()) {
    const Panel<TypeParam> panel = this->RandomPanel(rows, columns, &random);
    const Entries<TypeParam> x = this->RandomPanel(columns, 1, &random);
    const Entries<TypeParam> v = this->RandomPanel(rows, 1, &random);
    const TypeParam last = 0;
    Entries<TypeParam> y(rows);
    Entries<TypeParam> fetching_y(rows);
    Entries<TypeParam> z(columns);
    Entries<TypeParam> fetching_z(columns);
    PanelTimes(panel.data(), rows, columns, x.data(), y.data());
    PanelTimes(panel.data(), rows, columns, x.data(), fetching_y.data(), &last);
    EXPECT_EQ(fetching_y, y) << rows << " x " << columns;
    TransposedPanelTimes(panel.data(), rows, columns, v.data(), z.data());
    TransposedPanelTimes(panel.data(), rows, columns, v.data(),
                         fetching_z.data(), &last);
    EXPECT_EQ(fetching_z, z) << rows << " x " << columns;
  }
}

}  // namespace
}  // namespace emmy
