#include "verification/exact/principal_axes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "absl/strings/str_cat.h"

namespace emmy::exact {
namespace {

using std::abs;
using std::isfinite;
using std::sqrt;

template <typename T>
bool IsFinite(const Matrix3<T>& a) {
  for (int i = 0; i < 9; ++i) {
    if (!isfinite(a(i / 3, i % 3))) return false;
  }
  return true;
}

// Rotates the axes p, q so that a(p, q) becomes zero.
template <typename T>
void Rotate(int p, int q, Matrix3<T>* a, Matrix3<T>* axes) {
  if ((*a)(p, q) == 0) return;
  const T theta = ((*a)(q, q) - (*a)(p, p)) / (2 * (*a)(p, q));
  const T size = abs(theta) + sqrt(theta * theta + 1);
  const T tangent = (theta < 0 ? T{-1} : T{1}) / size;
  const T c = 1 / sqrt(tangent * tangent + 1);
  const T s = tangent * c;
  Matrix3<T> turn = Matrix3<T>::Identity();
  turn(p, p) = c;
  turn(q, q) = c;
  turn(p, q) = s;
  turn(q, p) = -s;
  *a = (turn.transpose() * *a * turn).eval();
  (*a)(p, q) = T{0};
  (*a)(q, p) = T{0};
  *axes = (*axes * turn).eval();
}

// Diagonalises *a, symmetric; convergence is quadratic, so eight sweeps are
// more than any precision needs.
template <typename T>
Matrix3<T> Diagonalize(Matrix3<T>* a) {
  Matrix3<T> axes = Matrix3<T>::Identity();
  for (int sweep = 0; sweep < 8; ++sweep) {
    Rotate(0, 1, a, &axes);
    Rotate(0, 2, a, &axes);
    Rotate(1, 2, a, &axes);
  }
  return axes;
}

}  // namespace

template <typename T>
absl::StatusOr<PrincipalAxes<T>> FindPrincipalAxes(const Matrix3<T>& inertia) {
  if (!IsFinite(inertia)) {
    return absl::InvalidArgumentError("inertia must be finite [kg m^2]");
  }
  const Matrix3<T> transposed = inertia.transpose();
  if (inertia != transposed) {
    return absl::InvalidArgumentError("inertia must be symmetric");
  }
  Matrix3<T> a = inertia;
  const Matrix3<T> axes = Diagonalize(&a);
  std::array<int, 3> order = {0, 1, 2};
  std::stable_sort(order.begin(), order.end(),
                   [&a](int i, int j) { return a(i, i) < a(j, j); });

  PrincipalAxes<T> result;
  for (int i = 0; i < 3; ++i) {
    const int from = order[static_cast<size_t>(i)];
    result.moments(i) = a(from, from);
    result.axes.col(i) = axes.col(from);
  }
  // An odd permutation is made a rotation again by turning one axis round.
  const Vector3<T> third = result.axes.col(0).cross(result.axes.col(1));
  if (third.dot(result.axes.col(2)) < 0) {
    result.axes.col(2) = -result.axes.col(2);
  }
  const Vector3<T>& j = result.moments;
  if (!(j(0) > 0) || !(j(0) + j(1) > j(2))) {
    return absl::InvalidArgumentError(absl::StrCat(
        "inertia must have principal moments with J1 > 0 and J1 + J2 > J3 "
        "[kg m^2], got ",
        static_cast<double>(j(0)), ", ", static_cast<double>(j(1)), ", ",
        static_cast<double>(j(2))));
  }
  return result;
}

template absl::StatusOr<PrincipalAxes<double>> FindPrincipalAxes(
    const Matrix3<double>&);
template absl::StatusOr<PrincipalAxes<Quad>> FindPrincipalAxes(
    const Matrix3<Quad>&);

}  // namespace emmy::exact
