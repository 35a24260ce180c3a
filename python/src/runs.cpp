// SPDX-License-Identifier: BSD-3-Clause
// A case into its output folder, with a callback of Python that hears of it and may stop it.
#include <omp.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <optional>
#include <string>
#include <utility>

#include "beside.hpp"
#include "dem4grm/core/thread_choice.hpp"
#include "dem4grm/runs/run_case.hpp"
#include "module.hpp"

namespace dem {
namespace {

namespace py = pybind11;

double clock_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// What a callback is told: where the test stands.
struct ProgressReport {
  Progress now;
  Forecast forecast;
  double steps_per_second = 0.0;
  double wall_time = 0.0;  ///< s, since this call
};

/// A report, or a note or warning with its text.
struct RunEvent {
  std::optional<ProgressReport> report;
  std::string text;
  bool is_warning = false;
};

/// Hears the test in its own thread, chooses the number of threads, and passes on what Python wants to hear. Between two reports
/// lie `interval` seconds at least, but for a new stage and the end of one.
class Listener : public LabObserver {
 public:
  Listener(Letterbox<RunEvent>& box, RemainingTime remaining, double interval, int threads, bool may_choose)
      : box_(box), remaining_(std::move(remaining)), interval_(interval), choice_(threads), may_choose_(may_choose) {}

  void progress(const Progress& now) override {
    const double clock = clock_seconds();
    if (may_choose_) omp_set_num_threads(choice_.update(clock, now.steps));
    remaining_.update(now, clock - start_);
    const bool is_new = now.stage != stage_, is_over = now.fraction >= 1.0 && !was_over_;
    if (!is_new && !is_over && clock - last_ < interval_) return;
    stage_ = now.stage;
    was_over_ = now.fraction >= 1.0;
    RunEvent event;
    event.report = ProgressReport{now, remaining_.forecast(), remaining_.steps_per_second(), clock - start_};
    box_.put(std::move(event));
    last_ = clock_seconds();
  }
  void note(const std::string& text) override { box_.put({std::nullopt, text, false}); }
  void warning(const std::string& text) override { box_.put({std::nullopt, text, true}); }

 private:
  Letterbox<RunEvent>& box_;
  RemainingTime remaining_;
  double interval_;
  ThreadChoice choice_;
  bool may_choose_;
  double start_ = clock_seconds(), last_ = 0.0;
  std::string stage_;
  bool was_over_ = false;
};

/// Options of a run as Python gives them.
struct RunWish {
  std::filesystem::path folder, store, specimen, source;
  int threads = 0;  ///< 0: as many as pay off
  double interval = 0.2, checkpoint_interval = 600.0, most_hours = 0.0;
  bool is_specimen_only = false;
  py::object progress = py::none(), message = py::none(), stop = py::none();
};

py::object outcome_of(const RunOutcome& outcome) {
  return py::make_tuple(json_text(outcome.summary), outcome.was_complete);
}

py::object run(const LoadedCase& loaded, const RunWish& wish) {
  volatile std::sig_atomic_t stop_flag = k_no_stop;
  std::optional<RunOutcome> outcome;
  const int threads = wish.threads > 0 ? wish.threads : omp_get_num_procs();
  check_threads(threads);
  const auto work = [&](Letterbox<RunEvent>& box) {
    omp_set_num_threads(threads);
    Listener listener(box, remaining_time_of(loaded.test, wish.is_specimen_only), wish.interval, threads,
                      wish.threads == 0);
    std::optional<BranchSource> source;
    if (!wish.source.empty()) source = read_branch_source(wish.source);
    RunSettings settings;
    settings.from = source ? &*source : nullptr;
    settings.folder = wish.folder;
    settings.threads = threads;
    settings.specimen = wish.specimen;
    settings.links.listener = &listener;
    settings.links.stop_flag = &stop_flag;
    settings.links.store = wish.store;
    settings.links.is_specimen_only = wish.is_specimen_only;
    settings.links.checkpoint_interval = wish.checkpoint_interval;
    outcome = run_case(loaded, settings);
  };
  const auto handle = [&](const RunEvent& event) {
    if (!event.report) {
      if (!wish.message.is_none()) wish.message(event.text, event.is_warning);
      return;
    }
    if (wish.progress.is_none()) return;
    const py::object answer = wish.progress(*event.report);
    if (answer.ptr() == Py_False && stop_flag == k_no_stop) stop_flag = k_stop_on_request;
  };
  const double start = clock_seconds();
  const auto look = [&] {
    if (stop_flag != k_no_stop) return;
    if (wish.most_hours > 0.0 && clock_seconds() - start > 3600.0 * wish.most_hours) stop_flag = k_stop_at_time_limit;
    if (!wish.stop.is_none() && wish.stop.attr("is_set")().cast<bool>()) stop_flag = k_stop_on_request;
  };
  run_beside<RunEvent>(work, handle, look, [&] { stop_flag = k_stop_on_request; });
  return outcome_of(*outcome);
}

void bind_report(py::module_& m) {
  const auto number = [](double Progress::*member) {
    return [member](const ProgressReport& r) { return r.now.*member; };
  };
  py::class_<ProgressReport>(m, "Progress", "Where a running test stands; SI units.")
      .def_property_readonly(
          "stage", [](const ProgressReport& r) { return r.now.stage; }, "name of the stage")
      .def_property_readonly("fraction", number(&Progress::fraction),
                             "of the stage, 0 to 1; below 0 when its end cannot be foreseen")
      .def_property_readonly("displacement", number(&Progress::displacement), "m, of the halves")
      .def_property_readonly("shear_stress", number(&Progress::shear_stress), "Pa")
      .def_property_readonly("normal_stress", number(&Progress::normal_stress), "Pa")
      .def_property_readonly("void_ratio", number(&Progress::void_ratio), "1")
      .def_property_readonly("inertial_number", number(&Progress::inertial_number), "1")
      .def_property_readonly("unbalanced_ratio", number(&Progress::unbalanced_ratio),
                             "mean net force over mean contact force")
      .def_property_readonly("time_step", number(&Progress::time_step), "s")
      .def_property_readonly(
          "steps", [](const ProgressReport& r) { return r.now.steps; }, "of this stage")
      .def_property_readonly("steps_per_second", [](const ProgressReport& r) { return r.steps_per_second; })
      .def_property_readonly(
          "wall_time", [](const ProgressReport& r) { return r.wall_time; }, "s, since the call")
      .def_property_readonly(
          "seconds_left", [](const ProgressReport& r) { return r.forecast.seconds; }, "forecast, s; None when unknown")
      .def("__repr__", [](const ProgressReport& r) {
        return "<dem4grm.Progress stage '" + r.now.stage + "', displacement " +
               std::to_string(r.now.displacement * 1e3) + " mm>";
      });
}

}  // namespace

void bind_runs(py::module_& m) {
  bind_report(m);
  m.def(
      "run_case",
      [](const LoadedCase& loaded, const std::filesystem::path& folder, int threads, const py::object& progress,
         double interval, const py::object& message, const py::object& stop, const std::filesystem::path& store,
         const std::filesystem::path& specimen, const std::filesystem::path& source, bool is_specimen_only,
         double checkpoint_interval, double most_hours) {
        RunWish wish;
        wish.folder = folder;
        wish.threads = threads;
        wish.progress = progress;
        wish.interval = interval;
        wish.message = message;
        wish.stop = stop;
        wish.store = store;
        wish.specimen = specimen;
        wish.source = source;
        wish.is_specimen_only = is_specimen_only;
        wish.checkpoint_interval = checkpoint_interval;
        wish.most_hours = most_hours;
        return run(loaded, wish);
      },
      py::arg("loaded"), py::arg("folder"), py::kw_only(), py::arg("threads"), py::arg("progress"), py::arg("interval"),
      py::arg("message"), py::arg("stop"), py::arg("store"), py::arg("specimen"), py::arg("source"),
      py::arg("is_specimen_only"), py::arg("checkpoint_interval"), py::arg("most_hours"));
}

}  // namespace dem
