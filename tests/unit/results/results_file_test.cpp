// SPDX-License-Identifier: BSD-3-Clause
// results.h5 of a tiny simulation, read back with the C library of HDF5.
#include "dem4grm/results/results_file.hpp"

#include <gtest/gtest.h>

#include <array>

#include "dem4grm/core/error.hpp"
#include "dem4grm/engine/observe.hpp"
#include "dem4grm/results/hdf5_handle.hpp"
#include "support/run_program.hpp"
#include "support/scene_builder.hpp"

namespace dem {
namespace {

using test::read_all;
using test::TemporaryFolder;
using test::write_all;

const ResultsOrigin k_origin{"direct_shear", "tiny", "name = \"tiny\"  # \xc3\xa4\n", "resolved\n"};

/// A rubber grain pressed by two spheres and a floor.
Simulation pressed_grain() {
  Scene scene = test::model_scene();
  scene.grains.push_back({{10e-3, 10e-3, 1.4 * k_grain_lattice * 0.63e-3}, {}});
  const double half = (k_grain_lattice + 0.98) * 0.63e-3;
  const Vec3 centre = scene.grains[0].position;
  test::add_sphere(scene, centre + Vec3{half + 2e-3, 0, 0}, 2e-3);
  test::add_sphere(scene, centre - Vec3{half + 2e-3, 0.1e-3, 0}, 2e-3);
  scene.wall_list = test::closed_box({20e-3, 20e-3, 20e-3}, 0.5);
  scene.wall_list[0].corner.z = centre.z - half;
  Simulation s(scene);
  s.set_time_step(1e-7);
  test::run_steps(s, 20);
  return s;
}

Vec3 row_of(const std::vector<double>& values, std::size_t row) {
  return {values[3 * row], values[3 * row + 1], values[3 * row + 2]};
}

class ResultsTest : public ::testing::Test {
 protected:
  ResultsTest() : path_(folder_ / "results.h5") {
    ResultsFile file(path_, k_origin);
    file.add_frame(simulation_, {0, 2e-3, simulation_.state_hash()});
    file.add_frame(simulation_, {1, 4e-3, simulation_.state_hash()});
    TableFile table(folder_ / "shear.csv", shear_columns());
    ShearRow row;
    row.shear_stress = 5e3;
    table.append(shear_values(row, 0.5));
    file.add_tables(std::array<NamedTable, 1>{{{"shear", &table}}});
  }

  TemporaryFolder folder_;
  std::filesystem::path path_;
  Simulation simulation_ = pressed_grain();
};

TEST_F(ResultsTest, OutlineNamesEverything) {
  const StoredResults stored = read_outline(path_);
  EXPECT_EQ(stored.case_name, "tiny");
  EXPECT_EQ(stored.test, "direct_shear");
  EXPECT_EQ(stored.table_rows, 1U);
  ASSERT_EQ(stored.frames.size(), 2U);
  EXPECT_EQ(stored.frames[1].name, "0001");
  EXPECT_EQ(stored.frames[1].displacement, 4e-3);
  EXPECT_EQ(stored.frames[0].state_hash, simulation_.state_hash());
  EXPECT_EQ(stored.frames[0].balls, 37U);
  EXPECT_EQ(stored.frames[0].clumps, 2U);
  EXPECT_EQ(stored.frames[0].rubber_grains, 1U);
  EXPECT_EQ(stored.frames[0].bonds, 64U);
  EXPECT_GT(stored.frames[0].contacts, 2U);
}

TEST_F(ResultsTest, BallsAndWallsAreThoseOfTheState) {
  const hdf5::Handle file = hdf5::open_file(path_, hdf5::Access::read);
  const hdf5::Handle balls = hdf5::open_group(file, "frames/0000/balls");
  const std::vector<double> position = hdf5::read_dataset(balls, "position");
  const std::vector<double> radius = hdf5::read_dataset(balls, "radius");
  const std::vector<double> body = hdf5::read_dataset(balls, "body");
  ASSERT_EQ(hdf5::dataset_shape(balls, "position"), (std::vector<std::size_t>{37, 3}));
  for (int id = 0; id < 37; ++id) {
    const auto row = static_cast<std::size_t>(id);
    const int index = simulation_.balls.index_of_id(id);
    EXPECT_EQ(norm(row_of(position, row) - simulation_.balls.position(index)), 0.0);
    EXPECT_EQ(radius[row], simulation_.balls.radius_of_id(id));
    EXPECT_EQ(body[row], simulation_.body_of_ball(id));
  }
  const hdf5::Handle walls = hdf5::open_group(file, "frames/0000/walls");
  EXPECT_EQ(row_of(hdf5::read_dataset(walls, "force"), 0).z, simulation_.reactions[0].force.z);
  EXPECT_LT(simulation_.reactions[0].force.z, 0.0);
}

/// The contacts must add up to what the simulation says about bodies and walls: signs, directions and bodies at once.
TEST_F(ResultsTest, ContactForcesAddUp) {
  const hdf5::Handle file = hdf5::open_file(path_, hdf5::Access::read);
  const hdf5::Handle contacts = hdf5::open_group(file, "frames/0000/contacts");
  const std::vector<double> normal = hdf5::read_dataset(contacts, "normal");
  const std::vector<double> normal_force = hdf5::read_dataset(contacts, "normal_force");
  const std::vector<double> shear_force = hdf5::read_dataset(contacts, "shear_force");
  const std::vector<double> point = hdf5::read_dataset(contacts, "point");
  const std::vector<double> body_i = hdf5::read_dataset(contacts, "body_i");
  const std::vector<double> body_j = hdf5::read_dataset(contacts, "body_j");
  const std::vector<double> wall = hdf5::read_dataset(contacts, "wall");
  std::vector<Vec3> on_body(static_cast<std::size_t>(simulation_.n_bodies())), on_wall(6);
  for (std::size_t c = 0; c < normal_force.size(); ++c) {
    const Vec3 n = row_of(normal, c), t = row_of(shear_force, c);
    const Vec3 on_i = t - n * normal_force[c];
    EXPECT_NEAR(norm(n), 1.0, 1e-14);
    EXPECT_NEAR(dot(n, t), 0.0, 1e-12);
    EXPECT_GE(normal_force[c], 0.0);
    on_body[static_cast<std::size_t>(body_i[c])] += on_i;
    if (wall[c] >= 0.0) {
      EXPECT_EQ(body_j[c], -1.0);
      EXPECT_NEAR(row_of(point, c).z, simulation_.walls[0].corner.z, 2e-5);
      on_wall[static_cast<std::size_t>(wall[c])] -= on_i;
    } else {
      on_body[static_cast<std::size_t>(body_j[c])] -= on_i;
    }
  }
  const std::vector<Vec3> net = net_contact_forces(simulation_);
  for (std::size_t k = 0; k < net.size(); ++k) EXPECT_NEAR(norm(on_body[k] - net[k]), 0.0, 1e-12);
  for (std::size_t w = 0; w < 6; ++w) EXPECT_NEAR(norm(on_wall[w] - simulation_.reactions[w].force), 0.0, 1e-12);
}

TEST_F(ResultsTest, BondsAreCompressionPositive) {
  const hdf5::Handle file = hdf5::open_file(path_, hdf5::Access::read);
  const hdf5::Handle bonds = hdf5::open_group(file, "frames/0000/bonds");
  const std::vector<double> length = hdf5::read_dataset(bonds, "length");
  const std::vector<double> force = hdf5::read_dataset(bonds, "normal_force");
  int compressed = 0;
  for (std::size_t b = 0; b < length.size(); ++b) {
    if (length[b] < 2.0 * 0.63e-3 * (1.0 - 1e-9)) {
      EXPECT_GT(force[b], 0.0);
      ++compressed;
    }
  }
  EXPECT_GT(compressed, 0);
}

herr_t check_dataset(hid_t root, const char* name, const H5O_info_t* info, void* count) {
  if (info->type != H5O_TYPE_DATASET) return 0;
  const hid_t dataset = H5Dopen2(root, name, H5P_DEFAULT);
  for (const char* attribute : {"unit", "description"}) EXPECT_GT(H5Aexists(dataset, attribute), 0) << name;
  EXPECT_EQ(info->mtime, 0) << name << " holds a time";
  H5Dclose(dataset);
  ++*static_cast<int*>(count);
  return 0;
}

TEST_F(ResultsTest, EveryDatasetHasUnitAndDescriptionAndNoTime) {
  const hdf5::Handle file = hdf5::open_file(path_, hdf5::Access::read);
  int datasets = 0;
  ASSERT_GE(H5Ovisit(file.id(), H5_INDEX_NAME, H5_ITER_INC, check_dataset, &datasets), 0);
  EXPECT_GT(datasets, 60);
}

TEST_F(ResultsTest, EqualContentGivesEqualBytes) {
  ResultsFile file(folder_ / "again.h5", k_origin);
  file.add_frame(simulation_, {0, 2e-3, simulation_.state_hash()});
  file.add_frame(simulation_, {1, 4e-3, simulation_.state_hash()});
  TableFile table(folder_ / "again.csv", shear_columns());
  ShearRow row;
  row.shear_stress = 5e3;
  table.append(shear_values(row, 0.5));
  file.add_tables(std::array<NamedTable, 1>{{{"shear", &table}}});
  EXPECT_EQ(read_all(folder_ / "again.h5"), read_all(path_));
}

TEST_F(ResultsTest, CutAndForeignFilesAreRefusedWithTheirName) {
  const std::string whole = read_all(path_);
  for (const std::size_t length : {std::size_t{0}, std::size_t{100}, whole.size() / 2, whole.size() - 1}) {
    write_all(folder_ / "cut.h5", whole.substr(0, length));
    try {
      read_outline(folder_ / "cut.h5");
      ADD_FAILURE() << "cut at " << length;
    } catch (const IoError& error) {
      EXPECT_NE(std::string(error.what()).find("cut.h5"), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(read_outline(folder_ / "missing.h5"), MissingFileError);
}

TEST_F(ResultsTest, AChangeThatFailsLeavesTheFileAndNoDraft) {
  const std::string before = read_all(path_);
  EXPECT_THROW(change_sealed_file(path_,
                                  [](const hdf5::Handle& file) {
                                    hdf5::create_group(file, "half");
                                    throw IoError("no more");
                                  }),
               IoError);
  EXPECT_EQ(read_all(path_), before);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "results.h5.tmp"));
}

TEST_F(ResultsTest, AnOpenReaderKeepsTheStatesThatItOpened) {
  const hdf5::Handle reader = hdf5::open_file(path_, hdf5::Access::read);
  change_sealed_file(path_, [](const hdf5::Handle& file) { hdf5::create_group(file, "later"); });
  EXPECT_EQ(hdf5::names_in(reader), (std::vector<std::string>{"frames", "meta", "shear"}));
  EXPECT_EQ(hdf5::names_in(open_results(path_)), (std::vector<std::string>{"frames", "later", "meta", "shear"}));
}

TEST(Results, FolderThatCannotBeWrittenIsAnIoError) {
  try {
    ResultsFile file("/proc/results.h5", k_origin);
    ADD_FAILURE();
  } catch (const IoError& error) {
    EXPECT_NE(std::string(error.what()).find("/proc/results.h5"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace dem
