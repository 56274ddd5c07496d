// The Python module emmy._emmy: what Python sees of the library. Words for
// people, help() too, are in python/emmy/_emmy.pyi.

#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_split.h"
#include "absl/strings/string_view.h"
#include "emmy/base/build_info.h"
#include "emmy/diagnostics/body_motion.h"
#include "emmy/diagnostics/invariant_monitor.h"
#include "emmy/diagnostics/structure_motion.h"
#include "emmy/io/case.h"
#include "emmy/io/case_writer.h"
#include "python/docstrings.h"
#include "python/history.h"
#include "python/lock.h"
#include "python/simulation.h"
#include "python/views.h"

namespace emmy::python {
namespace {

namespace py = pybind11;

// Invariants rounded to doubles.
struct InvariantValues {
  double kinetic_energy, penalty_energy, elastic_energy, gravity_energy;
  double load_work, internal_energy, total_energy;
  Vector3d momentum, angular_momentum;
};

InvariantValues Rounded(const Invariants& exact) {
  return {.kinetic_energy = exact.kinetic_energy.ToDouble(),
          .penalty_energy = exact.penalty_energy.ToDouble(),
          .elastic_energy = exact.elastic_energy.ToDouble(),
          .gravity_energy = exact.gravity_energy.ToDouble(),
          .load_work = exact.load_work.ToDouble(),
          .internal_energy = exact.InternalEnergy().ToDouble(),
          .total_energy = exact.TotalEnergy().ToDouble(),
          .momentum = exact.momentum.ToDouble(),
          .angular_momentum = exact.angular_momentum.ToDouble()};
}

// Of a function or method. Those of classes and properties: SetDocstrings.
const char* Doc(const std::string& name) { return Docstrings().at(name); }

void SetDocstrings(const py::module_& module) {
  for (const auto& [name, text] : Docstrings()) {
    py::object item = module;
    const std::vector<std::string> path = absl::StrSplit(name, '.');
    for (const std::string& part : path) item = item.attr(part.c_str());
    if (PyType_Check(item.ptr()) || Py_IS_TYPE(item.ptr(), &PyProperty_Type)) {
      item.attr("__doc__") = text;
    }
  }
}

template <typename Named>
std::vector<std::string> Names(const std::vector<Named>& parts) {
  std::vector<std::string> names;
  for (const Named& part : parts) names.push_back(part.name);
  return names;
}

template <typename Named>
size_t IndexOf(const std::string& name, const std::vector<Named>& parts) {
  for (size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].name == name) return i;
  }
  throw py::key_error(
      absl::StrCat(name, ": there are: ", absl::StrJoin(Names(parts), ", ")));
}

// The result of a call that may run any code of Python.
template <typename Function>
py::object Result(const Function& function) {
  PyObject* const result = CallPython(function);
  if (result == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::object>(result);
}

// module.function(value)
py::object Call(const char* module, const char* function,
                const py::object& value) {
  const py::object callable = py::module_::import(module).attr(function);
  return Result(
      [&] { return PyObject_CallOneArg(callable.ptr(), value.ptr()); });
}

// "pointer=value" as the program's --set has it.
std::vector<std::string> Overrides(const py::object& overrides) {
  return Call("emmy._case", "settings", overrides)
      .cast<std::vector<std::string>>();
}

// The bytes of a file's name, which need not be UTF-8.
std::string FileName(const py::object& path) {
  const py::bytes bytes = Result([&]() -> PyObject* {
    PyObject* converted = nullptr;
    return PyUnicode_FSConverter(path.ptr(), &converted) != 0 ? converted
                                                              : nullptr;
  });
  return bytes;
}

int64_t NotNegative(int64_t value, const char* name) {
  if (value >= 0) return value;
  throw InputError(
      absl::StrCat(name, ": must be a whole number >= 0, got ", value));
}

int NumThreads(int value) {
  if (value >= 1) return value;
  throw InputError(
      absl::StrCat("threads: must be a whole number >= 1, got ", value));
}

std::shared_ptr<History> Run(Simulation& simulation,
                             std::optional<int64_t> steps,
                             std::optional<int64_t> every,
                             const py::object& progress) {
  if (!progress.is_none() && PyCallable_Check(progress.ptr()) == 0) {
    throw py::type_error(absl::StrCat("progress: must be callable, got ",
                                      Py_TYPE(progress.ptr())->tp_name));
  }
  const Case& description = simulation.description();
  const int64_t record_every = every.value_or(description.output_every);
  if (record_every < 1) {
    throw InputError(
        absl::StrCat("every: must be a whole number > 0, got ", record_every));
  }
  const int64_t num_steps =
      steps.value_or(NumberOfSteps(description.integrator));
  simulation.Run({.num_steps = NotNegative(num_steps, "steps"),
                  .record_every = record_every,
                  .progress = progress});
  return simulation.history();
}

py::array ColumnView(const py::object& self, const std::string& name) {
  const auto& history = self.cast<const History&>();
  const History::Columns found = history.Find(name);
  if (found.count == 0) {
    throw py::key_error(absl::StrCat(
        name, ": there are: ", absl::StrJoin(history.columns(), ", ")));
  }
  const auto rows = static_cast<py::ssize_t>(history.num_rows());
  const auto item = static_cast<py::ssize_t>(sizeof(double));
  const auto row = static_cast<py::ssize_t>(history.columns().size()) * item;
  const double* first = history.data() + found.first;
  if (!found.is_vector) return View(first, {rows}, {row}, self);
  return View(first, {rows, static_cast<py::ssize_t>(found.count)}, {row, item},
              self);
}

// Makes `Error` a class of Python's. Its message may hold the name of a file:
// bytes that are not UTF-8 become what os.fsdecode makes of them.
template <typename Error>
void BindError(py::module_& module, const char* name, PyObject* base) {
  static const py::handle error_class =
      py::exception<Error>(module, name, base).release();
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown != nullptr) std::rethrow_exception(std::move(thrown));
    } catch (const Error& error) {
      const absl::string_view message = error.what();
      const auto text = py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(
          message.data(), static_cast<py::ssize_t>(message.size()),
          "surrogateescape"));
      if (text) PyErr_SetObject(error_class.ptr(), text.ptr());
    }
  });
}

void BindHistory(py::module_& module) {
  py::class_<History, std::shared_ptr<History>> bound(module, "History");
  bound.def_property_readonly("columns", &History::columns)
      .def_property_readonly(
          "data",
          [](const py::object& self) {
            const auto& history = self.cast<const History&>();
            const auto columns =
                static_cast<py::ssize_t>(history.columns().size());
            const auto item = static_cast<py::ssize_t>(sizeof(double));
            return View(history.data(),
                        {static_cast<py::ssize_t>(history.num_rows()), columns},
                        {columns * item, item}, self);
          })
      .def("__getitem__", &ColumnView, py::arg("name"),
           Doc("History.__getitem__"))
      .def("__contains__",
           [](const History& self, const std::string& name) {
             return self.Find(name).count > 0;
           })
      .def("__contains__",
           [](const History&, const py::object&) { return false; })
      .def("__iter__",
           [](const History& self) {
             return py::iter(py::cast(self.columns()));
           })
      .def("__len__",
           [](const History& self) { return self.columns().size(); });
  // What every mapping has by these.
  const py::object mapping =
      py::module_::import("collections.abc").attr("Mapping");
  for (const char* name : {"keys", "values", "items", "get"}) {
    bound.attr(name) = mapping.attr(name);
  }
  mapping.attr("register")(bound);
}

void BindResults(py::module_& module) {
  py::class_<InvariantValues>(module, "Invariants")
      .def_readonly("kinetic_energy", &InvariantValues::kinetic_energy)
      .def_readonly("penalty_energy", &InvariantValues::penalty_energy)
      .def_readonly("elastic_energy", &InvariantValues::elastic_energy)
      .def_readonly("gravity_energy", &InvariantValues::gravity_energy)
      .def_readonly("load_work", &InvariantValues::load_work)
      .def_readonly("internal_energy", &InvariantValues::internal_energy)
      .def_readonly("total_energy", &InvariantValues::total_energy)
      .def_readonly("momentum", &InvariantValues::momentum)
      .def_readonly("angular_momentum", &InvariantValues::angular_momentum);
  const auto bind_record = [&](auto record_class) {
    using Record = typename decltype(record_class)::type;
    record_class.def_readonly("initial", &Record::initial)
        .def_readonly("final", &Record::final)
        .def_readonly("max_error", &Record::max_error)
        .def_readonly("scale", &Record::scale)
        .def_readonly("conserved", &Record::conserved)
        .def_property_readonly("max_relative_error",
                               &Record::max_relative_error);
  };
  bind_record(py::class_<EnergyRecord>(module, "EnergyRecord"));
  bind_record(py::class_<MomentumRecord>(module, "MomentumRecord"));
  py::class_<BodyMotion>(module, "BodyMotion")
      .def_readonly("position", &BodyMotion::position)
      .def_readonly("velocity", &BodyMotion::velocity)
      .def_readonly("quaternion", &BodyMotion::quaternion)
      .def_readonly("omega", &BodyMotion::omega_locked)
      .def_readonly("omega_polar", &BodyMotion::omega_polar)
      .def_readonly("omega_polar_exact", &BodyMotion::omega_polar_exact);
  py::class_<PointMotion>(module, "PointMotion")
      .def_readonly("position", &PointMotion::position)
      .def_readonly("velocity", &PointMotion::velocity);
  py::class_<LineObservation>(module, "LineMotion")
      .def_readonly("strain", &LineObservation::strain)
      .def_readonly("force", &LineObservation::force);
}

// A property that shows a vector of the state in place.
template <CompensatedVector State::*kMember>
py::array StateView(const py::object& self) {
  return View((self.cast<const Simulation&>().state().*kMember).value, self);
}

void BindModel(py::class_<Simulation>& simulation) {
  simulation
      .def_property_readonly("case",
                             [](const Simulation& self) {
                               return Call(
                                   "json", "loads",
                                   py::str(WriteCase(self.description())));
                             })
      .def_property_readonly(
          "name",
          [](const Simulation& self) { return self.description().name; })
      .def_property_readonly(
          "bodies",
          [](const Simulation& self) { return Names(self.model().bodies()); })
      .def_property_readonly(
          "nodes",
          [](const Simulation& self) { return Names(self.model().nodes()); })
      .def_property_readonly(
          "lines",
          [](const Simulation& self) { return Names(self.model().lines()); })
      .def_property_readonly("degrees_of_freedom",
                             [](const Simulation& self) {
                               return self.model().degrees_of_freedom();
                             })
      .def_property_readonly("time_step", [](const Simulation& self) {
        return self.description().integrator.time_step;
      });
}

void BindState(py::class_<Simulation>& simulation) {
  simulation
      .def_property_readonly(
          "step", [](const Simulation& self) { return self.state().step; })
      .def_property_readonly(
          "time",
          [](const Simulation& self) { return self.state().time.value; })
      .def_property_readonly("position", &StateView<&State::position>)
      .def_property_readonly("velocity", &StateView<&State::velocity>)
      .def_property_readonly("strain", &StateView<&State::strain>)
      .def(
          "body",
          [](const Simulation& self, const std::string& name) {
            return ObserveBody(self.model(), self.state(),
                               IndexOf(name, self.model().bodies()));
          },
          py::arg("name"), Doc("Simulation.body"))
      .def(
          "node",
          [](const Simulation& self, const std::string& name) {
            return ObserveNode(self.model(), self.state(),
                               IndexOf(name, self.model().nodes()));
          },
          py::arg("name"), Doc("Simulation.node"))
      .def(
          "line",
          [](const Simulation& self, const std::string& name) {
            return ObserveLine(self.model(), self.state(),
                               IndexOf(name, self.model().lines()));
          },
          py::arg("name"), Doc("Simulation.line"))
      .def_property_readonly("invariants",
                             [](const Simulation& self) {
                               return Rounded(self.monitor().latest());
                             })
      .def_property_readonly(
          "energy",
          [](const Simulation& self) { return self.monitor().energy(); })
      .def_property_readonly(
          "momentum",
          [](const Simulation& self) { return self.monitor().momentum(); })
      .def_property_readonly("angular_momentum", [](const Simulation& self) {
        return self.monitor().angular_momentum();
      });
}

void BindSimulation(py::module_& module) {
  py::class_<Simulation> simulation(module, "Simulation");
  simulation
      .def(py::init([](const py::object& description,
                       const py::object& overrides, int threads) {
             return Simulation::FromText(
                 Call("emmy._case", "text", description).cast<std::string>(),
                 Overrides(overrides), NumThreads(threads));
           }),
           py::arg("case"), py::kw_only(), py::arg("overrides") = py::none(),
           py::arg("threads") = 1, Doc("Simulation.__init__"))
      .def_static(
          "from_file",
          [](const py::object& path, const py::object& overrides, int threads) {
            return Simulation::FromFile(FileName(path), Overrides(overrides),
                                        NumThreads(threads));
          },
          py::arg("path"), py::kw_only(), py::arg("overrides") = py::none(),
          py::arg("threads") = 1, Doc("Simulation.from_file"))
      .def("run", &Run, py::arg("steps") = py::none(), py::kw_only(),
           py::arg("every") = py::none(), py::arg("progress") = py::none(),
           Doc("Simulation.run"))
      .def(
          "advance",
          [](Simulation& self, int64_t steps) {
            self.Run({.num_steps = NotNegative(steps, "steps")});
          },
          py::arg("steps") = 1, Doc("Simulation.advance"))
      .def_property_readonly("history", &Simulation::history);
  BindModel(simulation);
  BindState(simulation);
}

}  // namespace
}  // namespace emmy::python

PYBIND11_MODULE(_emmy, module) {
  namespace py = pybind11;
  using emmy::python::InputError;
  using emmy::python::StepError;
  // Their full names are what users see in a traceback.
  py::module_ scope = module;
  scope.attr("__name__") = "emmy";
  emmy::python::BindError<InputError>(scope, "InputError", PyExc_ValueError);
  emmy::python::BindError<StepError>(scope, "StepError", PyExc_RuntimeError);
  emmy::python::BindHistory(scope);
  emmy::python::BindResults(scope);
  emmy::python::BindSimulation(scope);
  scope.attr("__name__") = "emmy._emmy";
  module.def(
      "build_info",
      [] {
        const emmy::BuildInfo build = emmy::GetBuildInfo();
        return py::dict(py::arg("version") = build.version,
                        py::arg("compiler") = build.compiler,
                        py::arg("flags") = build.flags);
      },
      emmy::python::Doc("build_info"));
  emmy::python::SetDocstrings(module);
}
