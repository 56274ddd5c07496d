// NumPy arrays that show memory of the library without copying it.

#ifndef EMMY_PYTHON_VIEWS_H_
#define EMMY_PYTHON_VIEWS_H_

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <utility>
#include <vector>

#include "emmy/base/types.h"

namespace emmy::python {

// An array over `data`, which belongs to `owner`: the array keeps it alive and
// cannot be written to, because a state changed from outside would no longer
// fit its strains and compensations. `strides` are in bytes.
inline pybind11::array View(const double* data,
                            std::vector<pybind11::ssize_t> shape,
                            std::vector<pybind11::ssize_t> strides,
                            const pybind11::object& owner) {
  pybind11::array_t<double> array(std::move(shape), std::move(strides), data,
                                  owner);
  array.attr("setflags")(pybind11::arg("write") = false);
  return array;
}

inline pybind11::array View(const VectorXd& vector,
                            const pybind11::object& owner) {
  return View(vector.data(), {vector.size()},
              {static_cast<pybind11::ssize_t>(sizeof(double))}, owner);
}

}  // namespace emmy::python

#endif  // EMMY_PYTHON_VIEWS_H_
