// SPDX-License-Identifier: BSD-3-Clause
// Campaigns on this machine, through the functions that the command line calls.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <csignal>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "beside.hpp"
#include "dem4grm/campaign/collect.hpp"
#include "dem4grm/campaign/local_campaign.hpp"
#include "dem4grm/runs/folder_lock.hpp"
#include "dem4grm/runs/stop_cause.hpp"
#include "module.hpp"

namespace dem {
namespace {

namespace py = pybind11;

void make_folder(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw IoError(fmt::format("{}: the folder cannot be made: {}", path.string(), error.message()));
}

/// Tells the waiting thread the status of all tests, about once a second and at every end of a test.
class StatusTeller : public CampaignListener {
 public:
  StatusTeller(Letterbox<std::string>& box, const CampaignFolder& folder, const CampaignRecord& record)
      : box_(box), folder_(folder), record_(record) {}
  void ended(const TestStatus& /*test*/) override { tell(); }
  void progress(const std::vector<TestStatus>& /*running*/, const StateCounts& /*all*/,
                double /*seconds_left*/) override {
    tell();
  }

 private:
  void tell() { box_.put(json_text(status_as_json(record_, status_of_all(folder_, record_)))); }

  Letterbox<std::string>& box_;
  const CampaignFolder& folder_;
  const CampaignRecord& record_;
};

struct CampaignWish {
  std::filesystem::path folder, program;
  int workers = 0, threads = 0;
  double memory = 0.0;  ///< bytes
  bool retries_physics = false;
  py::object progress = py::none(), stop = py::none();
};

void run_tests(const Study& study, const CampaignWish& wish, const volatile std::sig_atomic_t& stop_flag,
               Letterbox<std::string>& box) {
  const CampaignFolder folder(wish.folder);
  make_folder(folder.root());
  const FolderLock lock(folder.root());
  const double memory = wish.memory > 0.0 ? wish.memory : free_memory();
  const CampaignPlan plan = plan_campaign(study, {wish.workers, wish.threads}, memory);
  write_campaign(folder, study, plan);
  const CampaignRecord record = read_campaign(folder);
  StatusTeller teller(box, folder, record);
  LocalSettings settings;
  settings.program = wish.program;
  settings.crew = plan.crew;
  settings.memory = memory;
  settings.retries_physics = wish.retries_physics;
  settings.stop_flag = &stop_flag;
  settings.listener = &teller;
  const LocalOutcome outcome = run_locally(folder, plan, record, settings);
  if (outcome.was_stopped) {
    throw Error(ExitCode::stopped,
                fmt::format("stopped on request; the same call goes on with {}", wish.folder.string()));
  }
}

void run_campaign(const Study& study, const CampaignWish& wish) {
  volatile std::sig_atomic_t stop_flag = k_no_stop;
  const auto handle = [&](const std::string& status) {
    if (wish.progress.is_none()) return;
    if (wish.progress(status).ptr() == Py_False) stop_flag = k_stop_on_request;
  };
  const auto look = [&] {
    if (!wish.stop.is_none() && wish.stop.attr("is_set")().cast<bool>()) stop_flag = k_stop_on_request;
  };
  run_beside<std::string>([&](Letterbox<std::string>& box) { run_tests(study, wish, stop_flag, box); }, handle, look,
                          [&] { stop_flag = k_stop_on_request; });
}

/// Returns the warnings about tests that were left out.
std::vector<std::string> collect(const std::filesystem::path& root, const std::filesystem::path& output) {
  const CampaignFolder folder(root);
  std::vector<CollectedTest> finished;
  for (const RecordedTest& test : read_campaign(folder).tests) {
    if (status_of(folder, test).state == TestState::done) {
      finished.push_back({test.name, test.values, folder.test(test.name)});
    }
  }
  if (finished.empty()) throw MissingFileError(fmt::format("{}: no test of the study is done yet", root.string()));
  const Collection collection = read_collection(finished);
  make_folder(output);
  write_collection(collection, output);
  return collection.warnings;
}

std::vector<std::string> names_of(const Study& study) {
  std::vector<std::string> names;
  for (const StudyTest& test : study.tests) names.push_back(test.name);
  return names;
}

}  // namespace

void bind_campaigns(py::module_& m) {
  py::class_<Study>(m, "Study")
      .def_readonly("name", &Study::name)
      .def_readonly("warnings", &Study::warnings)
      .def_property_readonly("tests", &names_of)
      .def("case", [](const Study& study, const std::string& name) {
        for (const StudyTest& test : study.tests) {
          if (test.name == name) return test.loaded;
        }
        throw py::key_error(name);
      });
  m.def("load_study", &load_study);
  m.def("plan_campaign", [](const Study& study, int workers, int threads, double memory) {
    std::string text;
    run_beside([&] {
      text = json_text(
          plan_as_json(study, plan_campaign(study, {workers, threads}, memory > 0.0 ? memory : free_memory())));
    });
    return text;
  });
  m.def("run_campaign",
        [](const Study& study, const std::filesystem::path& folder, const std::filesystem::path& program, int workers,
           int threads, double memory, bool retries_physics, const py::object& progress, const py::object& stop) {
          run_campaign(study, {folder, program, workers, threads, memory, retries_physics, progress, stop});
        });
  m.def("campaign_status", [](const std::filesystem::path& root) {
    const CampaignFolder folder(root);
    const CampaignRecord record = read_campaign(folder);
    return json_text(status_as_json(record, status_of_all(folder, record)));
  });
  m.def("collect_campaign", [](const std::filesystem::path& root, const std::filesystem::path& output) {
    const py::gil_scoped_release unlocked;
    return collect(root, output);
  });
}

}  // namespace dem
