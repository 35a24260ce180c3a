// SPDX-License-Identifier: BSD-3-Clause
// Cases: the energy ledger of a squeezed box.
#include <cmath>

#include "dem4grm/core/random.hpp"
#include "dem4grm/verify/cases.hpp"
#include "dem4grm/verify/energy_balance.hpp"
#include "dem4grm/verify/mindlin_ledger.hpp"
#include "dem4grm/verify/scenes.hpp"
#include "dem4grm/verify/shear_test.hpp"

namespace dem {

namespace {

using namespace verify;

struct SqueezeSettings {
  double friction = 0.0, local_damping = 0.0, dashpot = 0.0;
  int hz_mode = 0;
  BondForm form = BondForm::history_free;
};

/// Works and energies at the end, J.
struct Squeezed {
  EnergyBalance balance;
  double mindlin = 0.0;  ///< gained by the shear springs without work
  [[nodiscard]] double closure() const { return balance.sum() / balance.work; }
  [[nodiscard]] double closure_with_springs() const { return (balance.sum() - mindlin) / balance.work; }
};

/// A closed box of 18 clumps and 9 rubber grains.
Scene small_box(const SqueezeSettings& settings) {
  Scene scene = model_scene();
  scene.gravel.friction = scene.rubber.friction = settings.friction;
  scene.integration.local_damping = settings.local_damping;
  scene.contact.hz_mode = settings.hz_mode;
  scene.contact.normal_damping_ratio = settings.dashpot;
  scene.bond.form = settings.form;
  scene.rubber_ball_radius = 0.75e-3;
  scene.shapes = {*find_clump_template("T1"), *find_clump_template("T5")};
  const double cell = 5.5e-3;
  RandomSequence random(21, RandomStream::test, 0);
  for (int k = 0; k < 27; ++k) {
    const int x = k % 3, y = k / 3 % 3, z = k / 9;
    const Vec3 at{(x + 0.5) * cell, (y + 0.5) * cell, (z + 0.5) * cell};
    const Quaternion q = random.orientation();
    if ((x + y + z) % 3 == 0) {
      scene.grains.push_back({at, {}});  // square to the box: fits its cell whatever happens
    } else {
      scene.clumps.push_back({(x + y) % 2, 3.9e-3, {at, q}, k_gravel});
    }
  }
  scene.wall_list = closed_box({3 * cell, 3 * cell, 3 * cell}, settings.friction);
  return scene;
}

/// The lid comes down by 4.5 mm at 0.5 m/s and stops; the works up to 2 ms later. With a picture, every hundredth step
/// is kept.
Squeezed squeeze(const SqueezeSettings& settings, Picture* picture = nullptr) {
  Simulation s(small_box(settings));
  s.set_time_step(1e-6);
  s.walls[5].velocity = {0, 0, -0.5};
  MindlinLedger springs;
  for (int k = 0; k < 11000; ++k) {
    if (k == 9000) s.walls[5].velocity = {};
    s.step();
    springs.add_step(s);
    if (picture != nullptr && k % 100 == 99) add_levels(*picture, s.time * 1e3, balance_of(s.energy()));
  }
  return {balance_of(s.energy()), springs.gained()};
}

constexpr const char* k_balance = "conservation of energy";

void run_smooth_box(Findings& f) {
  SqueezeSettings settings;
  const Squeezed plain = squeeze(settings);
  f.at_least("work of the walls", "J", 1e-3, plain.balance.work, "the box is squeezed");
  f.absolute("no friction, no damping: stored and lost over the work of the walls", "1", 1.0, plain.closure(), 1e-3,
             k_balance);
  f.absolute("no friction: slip work", "J", 0.0, plain.balance.slip, 0.0, "nothing slips");
  f.absolute("no local damping: its loss", "J", 0.0, plain.balance.damping, 0.0, "nothing is damped");
  settings.local_damping = 0.2;
  settings.dashpot = 0.1;
  const Squeezed damped = squeeze(settings);
  f.absolute("no friction, damping and dashpots: stored and lost over the work", "1", 1.0, damped.closure(), 1.5e-3,
             k_balance);
  f.at_least("share of the dashpots", "1", 0.02, damped.balance.dashpot / damped.balance.work, "not idle");
  f.at_least("share of local damping", "1", 0.02, damped.balance.damping / damped.balance.work, "not idle");
}

void run_rough_box(Findings& f) {
  Picture picture = energy_picture("energy-of-squeeze", "Energies of a squeezed box, one upon the other", "time (ms)");
  for (const BondForm form : {BondForm::history_free, BondForm::incremental}) {
    const bool first = form == BondForm::history_free;
    const Squeezed c = squeeze({0.4, 0.2, 0.1, 0, form}, first ? &picture : nullptr);
    const std::string what = first ? "bonds without history: " : "incremental bonds: ";
    f.absolute(what + "stored and lost over the work", "1", 1.0, c.closure(), 0.01, k_balance);
    f.absolute(what + "the same less the gain of the shear springs", "1", 1.0, c.closure_with_springs(),
               first ? 4e-3 : 1e-3, k_balance);
    f.at_least(what + "share of slip", "1", 0.02, c.balance.slip / c.balance.work, "not idle");
  }
  f.picture(picture);
  const Squeezed rescaled = squeeze({0.4, 0.2, 0.1, 1, BondForm::history_free});
  f.absolute("unloading rule 1: stored and lost over the work", "1", 1.0, rescaled.closure(), 0.03,
             "conservation of energy; what the rule takes out of the shear springs is not booked");
  f.absolute("unloading rule 1: the same less the loss of the shear springs", "1", 1.0, rescaled.closure_with_springs(),
             4e-3, k_balance);
  f.remark(
      "With the change of the shear springs counted, incremental bonds leave a gap of 0.01 %. Bonds without history "
      "leave "
      "0.2 %, which halving the time step does not change and which is absent without friction; the tolerance is set "
      "for "
      "it, its cause has not been traced.");
}

}  // namespace

void add_energy_cases(std::vector<VerificationCase>& cases) {
  cases.push_back({"energy-smooth-box", "Energy of a squeezed box without friction",
                   "18 clumps and 9 rubber grains in a closed box, squeezed by the lid. The work of the walls must be "
                   "found again as "
                   "strain energy of contacts and bonds, kinetic energy, and losses in dashpots and local damping (J).",
                   Extent::quick, run_smooth_box});
  cases.push_back(
      {"energy-rough-box", "Energy of a squeezed box with friction",
       "The same box with friction 0.4. By unloading rule 0 a shear spring keeps its force $F_s$ while its stiffness "
       "$k_s$ (N/m) follows the normal force; its energy $F_s^2 / 2 k_s$ then changes by "
       "$\\frac{1}{2} F_s^2 (1/k_s - 1/k_s')$ without work. The case adds these changes up over all contacts and "
       "steps: "
       "less this gain the ledger must close better than with it.",
       Extent::quick, run_rough_box});
  add_shear_test_cases(cases);
}

}  // namespace dem
