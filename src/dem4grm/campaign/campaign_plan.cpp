// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/campaign/campaign_plan.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <numeric>

#include "dem4grm/runs/preparation_store.hpp"
#include "dem4grm/runs/run_forecast.hpp"

namespace dem {
namespace {

constexpr std::size_t k_most_trials = 12;  // of different grains
constexpr double k_longest_trial = 0.5;    // s, of one kind of grains
constexpr double k_crew_trial = 0.3;       // s, for each way to use the machine
// Of the preparation of a test that finds fill, e_min and e_max of another stress in the store, and of one that finds all
// branches of its own stress. A search takes 4.5 branches as a rule (runs/run_forecast.cpp).
// Without a search they share the fill alone.
constexpr double k_share_with_trials = 0.45, k_share_with_all = 0.12, k_share_with_fill = 0.7;
constexpr double k_memory_margin = 1.3;  // a forecast of memory is as good as that

/// The case without what does not matter to the speed of a step.
std::string grains_text(TestCase test) {
  std::visit([](auto& t) { t.name.clear(); }, test);
  if (auto* shear = std::get_if<DirectShearCase>(&test)) {
    shear->seed = 1;
    return preparation_text(*shear);
  }
  return "grain";
}

/// The case without name and seed: what its facts follow from, but for the draw of the grains.
std::string facts_text(TestCase test) {
  std::visit([](auto& t) { t.name.clear(); }, test);
  if (auto* shear = std::get_if<DirectShearCase>(&test)) shear->seed = 1;
  return resolved_toml(test);
}

/// Of each test the number of its grains: tests of one number step alike.
struct Grains {
  std::vector<std::size_t> of_test;
  std::vector<std::size_t> first;  ///< a test with these grains
};

Grains sort_by_grains(const Study& study) {
  Grains grains;
  std::map<std::string, std::size_t> known;
  for (std::size_t k = 0; k < study.tests.size(); ++k) {
    const auto [found, is_new] = known.emplace(grains_text(study.tests[k].loaded.test), grains.first.size());
    if (is_new) grains.first.push_back(k);
    grains.of_test.push_back(found->second);
  }
  return grains;
}

std::vector<CaseFacts> facts_of_all(const Study& study) {
  std::map<std::string, CaseFacts> known;
  std::vector<CaseFacts> all;
  for (const StudyTest& test : study.tests) {
    const std::string text = facts_text(test.loaded.test);
    auto found = known.find(text);
    if (found == known.end()) found = known.emplace(text, derive_facts(test.loaded.test)).first;
    all.push_back(found->second);
  }
  return all;
}

/// A trial for each kind of grains; where there are many kinds, of some of them, evenly spread by the number of balls.
std::vector<StepTrial> try_all(const Study& study, const Grains& grains, const std::vector<CaseFacts>& facts,
                               double seconds) {
  const std::size_t n = grains.first.size();
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto balls = [&](std::size_t kind) { return facts[grains.first[kind]].balls; };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return balls(a) < balls(b); });
  const std::size_t tried = std::min(n, k_most_trials);
  std::vector<StepTrial> trials(n);
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < tried; ++k) {
    const std::size_t place = tried == 1 ? 0 : k * (n - 1) / (tried - 1);
    places.push_back(place);
    trials[order[place]] = try_steps(study.tests[grains.first[order[place]]].loaded.test,
                                     std::min(k_longest_trial, seconds / static_cast<double>(tried)), 1);
  }
  for (std::size_t place = 0; place < n; ++place) {
    const auto nearest = *std::min_element(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
      return std::abs(balls(order[a]) - balls(order[place])) < std::abs(balls(order[b]) - balls(order[place]));
    });
    if (nearest == place) continue;
    StepTrial trial = trials[order[nearest]];
    const double ratio = static_cast<double>(balls(order[place])) / std::max(1, balls(order[nearest]));
    trial.step_time *= ratio;
    trial.contacts *= ratio;
    trial.solid_volume *= ratio;
    trials[order[place]] = trial;
  }
  return trials;
}

/// Tests whose preparations have states in common; the one with the largest normal stress leads, since its branches rest
/// at the smaller stresses on their way.
void find_groups(const Study& study, CampaignPlan& plan) {
  std::map<std::string, std::vector<std::size_t>> groups;
  for (std::size_t k = 0; k < study.tests.size(); ++k) {
    const auto* shear = std::get_if<DirectShearCase>(&study.tests[k].loaded.test);
    if (shear != nullptr) groups[preparation_text(*shear)].push_back(k);
  }
  const auto stress_of = [&](std::size_t k) {
    return std::get<DirectShearCase>(study.tests[k].loaded.test).shear.normal_stress;
  };
  for (const auto& [text, members] : groups) {
    if (members.size() < 2) continue;
    const std::size_t leader = *std::max_element(
        members.begin(), members.end(), [&](std::size_t a, std::size_t b) { return stress_of(a) < stress_of(b); });
    std::vector<double> stresses{stress_of(leader)};
    for (const std::size_t k : members) {
      PlannedTest& test = plan.tests[k];
      test.group = study.tests[leader].name;
      test.leads = k == leader;
      if (test.leads) continue;
      const bool has_all = std::find(stresses.begin(), stresses.end(), stress_of(k)) != stresses.end();
      stresses.push_back(stress_of(k));
      const auto& specimen = std::get<DirectShearCase>(study.tests[k].loaded.test).specimen;
      const double with_search = has_all ? k_share_with_all : k_share_with_trials;
      test.preparation_time *= specimen.preparation_friction ? k_share_with_fill : with_search;
      test.store_size *= has_all ? 0.0 : k_share_with_trials;
    }
  }
}

Crew choose_crew(const Study& study, const CrewWish& wish, const CampaignPlan& plan, double memory) {
  const int processors = omp_get_num_procs();
  const int n = static_cast<int>(study.tests.size());
  if (wish.workers > 0) {
    return {wish.workers, wish.threads > 0 ? wish.threads : std::max(1, processors / wish.workers)};
  }
  const auto largest = std::max_element(plan.tests.begin(), plan.tests.end(),
                                        [](const PlannedTest& a, const PlannedTest& b) { return a.memory < b.memory; });
  int most = n;
  if (memory > 0.0) most = std::clamp(static_cast<int>(memory / (k_memory_margin * largest->memory)), 1, n);
  if (wish.threads > 0) return {std::clamp(processors / wish.threads, 1, most), wish.threads};
  if (n == 1 || most == 1 || processors == 1) return {1, processors};
  const auto& test = study.tests[static_cast<std::size_t>(largest - plan.tests.begin())].loaded.test;
  return best_crew(processors, most, [&](const Crew& crew) { return steps_together(test, crew, k_crew_trial); });
}

/// By how much a step of the largest test takes longer than in its own trial when it has this crew around it.
double slowdown(const Study& study, const CampaignPlan& plan) {
  if (plan.crew == Crew{1, 1}) return 1.0;
  const auto longest = std::max_element(plan.tests.begin(), plan.tests.end(),
                                        [](const PlannedTest& a, const PlannedTest& b) { return a.time() < b.time(); });
  const auto k = static_cast<std::size_t>(longest - plan.tests.begin());
  const TestCase& test = study.tests[k].loaded.test;
  const double alone = steps_together(test, {1, 1}, k_crew_trial);
  const double together = steps_together(test, plan.crew, k_crew_trial);
  return together > 0.0 ? alone * plan.crew.workers / together : 1.0;
}

}  // namespace

double free_memory() {
  std::ifstream file("/proc/meminfo");
  std::string name, unit;
  double value = 0.0;
  while (file >> name >> value) {
    std::getline(file, unit);
    if (name == "MemAvailable:") return 1024.0 * value;
  }
  return 0.0;
}

double makespan(const std::vector<PlannedTest>& tests, int workers) {
  std::vector<double> free_at(static_cast<std::size_t>(std::max(1, workers)), 0.0);
  std::map<std::string, double> ready_at;  // of the members of a group
  std::vector<const PlannedTest*> left;
  left.reserve(tests.size());
  for (const PlannedTest& test : tests) left.push_back(&test);
  // Those that lead first, then the longest; the order in which a campaign starts them.
  std::stable_sort(left.begin(), left.end(), [](const PlannedTest* a, const PlannedTest* b) {
    return a->leads != b->leads ? a->leads : a->time() > b->time();
  });
  double last = 0.0;
  while (!left.empty()) {
    auto worker = std::min_element(free_at.begin(), free_at.end());
    const auto start_of = [&](const PlannedTest* test) {
      if (test->group.empty() || test->leads) return *worker;
      return std::max(*worker, ready_at[test->group]);
    };
    auto chosen = left.begin();
    for (auto candidate = left.begin(); candidate != left.end(); ++candidate) {
      if (start_of(*candidate) < start_of(*chosen)) chosen = candidate;
    }
    const double start = start_of(*chosen);
    if ((*chosen)->leads) ready_at[(*chosen)->group] = start + (*chosen)->preparation_time;
    *worker = start + (*chosen)->time();
    last = std::max(last, *worker);
    left.erase(chosen);
  }
  return last;
}

CampaignPlan plan_campaign(const Study& study, const CrewWish& wish, double memory, double trial) {
  const double room = memory > 0.0 ? memory : free_memory();
  const Grains grains = sort_by_grains(study);
  const std::vector<CaseFacts> facts = facts_of_all(study);
  const std::vector<StepTrial> trials = try_all(study, grains, facts, trial);
  CampaignPlan plan;
  for (std::size_t k = 0; k < study.tests.size(); ++k) {
    const RunForecast f = forecast_run(study.tests[k].loaded.test, facts[k], trials[grains.of_test[k]]);
    PlannedTest test;
    test.name = study.tests[k].name;
    test.preparation_time = f.preparation_time;
    test.test_time = f.test_time;
    test.memory = facts[k].memory;
    test.results_size = f.results_size;
    test.store_size = f.store_size;
    test.steps = f.steps;
    test.clumps = facts[k].clumps;
    test.rubber_grains = facts[k].rubber_grains;
    test.inertial_number = facts[k].inertial_number;
    plan.tests.push_back(std::move(test));
  }
  find_groups(study, plan);
  plan.crew = choose_crew(study, wish, plan, room);
  const double factor = trial > k_crew_trial ? slowdown(study, plan) : 1.0;
  std::vector<double> memories;
  for (PlannedTest& test : plan.tests) {
    test.preparation_time *= factor;
    test.test_time *= factor;
    plan.processor_time += test.time();
    plan.disk += test.results_size + test.store_size;
    memories.push_back(test.memory);
  }
  std::sort(memories.begin(), memories.end(), std::greater<>());
  for (std::size_t k = 0; k < std::min(memories.size(), static_cast<std::size_t>(plan.crew.workers)); ++k) {
    plan.memory += memories[k];
  }
  plan.time = makespan(plan.tests, plan.crew.workers);
  return plan;
}

JsonObject plan_as_json(const Study& study, const CampaignPlan& plan) {
  JsonList tests;
  for (std::size_t k = 0; k < plan.tests.size(); ++k) {
    const PlannedTest& t = plan.tests[k];
    JsonObject values;
    for (const StudyValue& v : study.tests[k].values) {
      values.push_back({v.column, v.number ? JsonValue(*v.number) : JsonValue(v.text)});
    }
    tests.emplace_back(JsonObject{{"name", t.name},
                                  {"values", values},
                                  {"clumps", t.clumps},
                                  {"rubber_grains", t.rubber_grains},
                                  {"inertial_number", t.inertial_number},
                                  {"steps", t.steps},
                                  {"forecast_preparation_s", t.preparation_time},
                                  {"forecast_test_s", t.test_time},
                                  {"memory_MB", t.memory / 1e6},
                                  {"results_MB", t.results_size / 1e6},
                                  {"shares_preparation_with", t.group.empty() ? JsonValue() : JsonValue(t.group)},
                                  {"makes_preparation", t.leads}});
  }
  return {{"study", study.name},
          {"workers", plan.crew.workers},
          {"threads", plan.crew.threads},
          {"forecast_time_s", plan.time},
          {"forecast_worker_time_s", plan.processor_time},
          {"memory_MB", plan.memory / 1e6},
          {"disk_MB", plan.disk / 1e6},
          {"tests", tests}};
}

}  // namespace dem
