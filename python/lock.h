// Python's lock, which the library gives up while it computes.
//
// A thread that asks for the lock while the interpreter shuts down does not
// get it. Python up to 3.13 ends such a thread by unwinding its stack, which
// stops the whole process at the first noexcept destructor and releases
// Python's objects without the lock elsewhere; Python 3.14 lets it wait until
// the process is gone. So does everything here, with any Python.
// (pybind11::gil_scoped_release does not.)

#ifndef EMMY_PYTHON_LOCK_H_
#define EMMY_PYTHON_LOCK_H_

#include <pybind11/pybind11.h>
#include <unistd.h>

namespace emmy::python {

// function(), which calls Python and may lose the lock there for good. No
// object with a destructor may be alive in it during that call, and it throws
// nothing: what arrives here is Python unwinding the thread.
template <typename Function>
auto CallPython(const Function& function) -> decltype(function()) {
  try {
    return function();
  } catch (...) {
    while (true) pause();
  }
}

// No lock from here to the end of the scope.
class Unlocked {
 public:
  Unlocked() : thread_(PyEval_SaveThread()) {}
  ~Unlocked() { Lock(); }
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

 private:
  friend class Locked;
  void Lock() {
    CallPython([this] { PyEval_RestoreThread(thread_); });
  }

  PyThreadState* thread_;
};

// The lock from here to the end of the scope, within an Unlocked scope of the
// same thread.
class Locked {
 public:
  explicit Locked(Unlocked& unlocked) : unlocked_(unlocked) {
    unlocked_.Lock();
  }
  ~Locked() { unlocked_.thread_ = PyEval_SaveThread(); }
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;

 private:
  Unlocked& unlocked_;
};

}  // namespace emmy::python

#endif  // EMMY_PYTHON_LOCK_H_
