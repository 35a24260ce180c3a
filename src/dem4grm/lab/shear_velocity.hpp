// SPDX-License-Identifier: BSD-3-Clause
// How fast a test shears: as the case says, or as fast as an inertial number allows.
#pragma once

#include "dem4grm/lab/case.hpp"
#include "dem4grm/specimen/specimen.hpp"

namespace dem {

/// Velocity of the halves against each other, m/s: that of the case, or
///
///   v = gamma H,  rounded down to three significant digits
///     gamma  shear rate that has the inertial number of the case, 1/s (laws/inertial_number.hpp)
///     H      height of the specimen before shear, m
///
/// so that the recorded inertial number begins at most 1 % below the one asked for. It follows from the case and the
/// specimen alone, and typed into a case as "2.67 mm/s" it is the same number to the last bit.
double shear_velocity(const ShearSettings& shear, const SpecimenReport& specimen);

/// Inertial number of a specimen that is sheared with a velocity (m/s) under a normal stress (Pa).
double inertial_number_at(double velocity, const SpecimenReport& specimen, double normal_stress);

/// Largest speed of the top plate in shear, m/s: never below the shear velocity, and where that is chosen at least five
/// times it, as the default is five times the published velocity.
double plate_speed_cap(const DirectShearCase& test, double velocity);

/// What is known of the specimen before it is made: its solids, and the nominal height.
SpecimenReport expected_specimen(const DirectShearCase& test, const GrainList& grains);

/// The velocity for the nominal height, m/s. Draws the grains where it has to be chosen; throws InputError when they
/// cannot be drawn.
double expected_shear_velocity(const DirectShearCase& test);

}  // namespace dem
