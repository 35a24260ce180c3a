// SPDX-License-Identifier: BSD-3-Clause
// Published and measured curves of oblique impacts, read off figures by others (reference files of the benchmarks in
// Kratos Multiphysics), so good to about 1 % of a figure's height.
#pragma once

#include <array>

namespace dem::verify {

struct CurvePoint {
  double x = 0.0, y = 0.0;
};

// Chung & Ooi (2011), test 4, aluminium oxide: impact angle (deg) against tangential restitution (1) and spin (rad/s).
inline constexpr std::array<CurvePoint, 12> k_oxide_restitution{{{5.17, .948},
                                                                 {10.16, .687},
                                                                 {14.99, .624},
                                                                 {20.06, .616},
                                                                 {25.05, .634},
                                                                 {30.12, .684},
                                                                 {35.03, .737},
                                                                 {40.02, .781},
                                                                 {50.00, .845},
                                                                 {59.98, .893},
                                                                 {69.96, .932},
                                                                 {80.02, .966}}};
inline constexpr std::array<CurvePoint, 12> k_oxide_spin{{{4.95, 19.3},
                                                          {10.08, 213.0},
                                                          {14.97, 377.8},
                                                          {19.94, 510.6},
                                                          {24.91, 599.4},
                                                          {29.96, 616.5},
                                                          {34.93, 582.3},
                                                          {39.98, 544.8},
                                                          {50.00, 457.0},
                                                          {60.02, 357.5},
                                                          {69.96, 246.2},
                                                          {80.06, 126.3}}};

// Kharaz, Gorham & Salman (2001), measured: aluminium oxide spheres of 5 mm on a glass anvil.
inline constexpr std::array<CurvePoint, 9> k_measured_restitution{{{2.24, .797},
                                                                   {4.22, .746},
                                                                   {9.84, .675},
                                                                   {20.22, .599},
                                                                   {30.36, .690},
                                                                   {39.54, .774},
                                                                   {49.60, .848},
                                                                   {71.07, .937},
                                                                   {79.20, .970}}};
inline constexpr std::array<CurvePoint, 9> k_measured_spin{{{5.90, 134.9},
                                                            {10.87, 261.2},
                                                            {21.12, 573.7},
                                                            {31.14, 612.2},
                                                            {38.95, 595.1},
                                                            {50.24, 449.5},
                                                            {60.10, 375.7},
                                                            {69.96, 243.0},
                                                            {78.56, 142.4}}};

// Chung & Ooi (2011), test 5, steel: V_s/(mu V_n) before against V_s/(mu V_n) and R spin/(mu V_n) after.
inline constexpr std::array<CurvePoint, 8> k_steel_sliding{
    {{0.33, -.28}, {1.01, -.75}, {2.0, -1.53}, {2.99, -2.44}, {4.0, -2.79}, {5.0, -2.00}, {6.0, -1.01}, {10.0, 3.01}}};
inline constexpr std::array<CurvePoint, 9> k_steel_spin{{{0.353, .430},
                                                         {0.994, 1.250},
                                                         {1.341, 1.664},
                                                         {2.000, 2.524},
                                                         {2.988, 3.904},
                                                         {3.994, 4.837},
                                                         {5.000, 5.007},
                                                         {6.006, 5.006},
                                                         {10.01, 5.004}}};
// The same, finite elements with partial slip in the contact patch.
inline constexpr std::array<CurvePoint, 8> k_element_sliding{{{1.19, -.21},
                                                              {2.31, -.95},
                                                              {3.32, -1.52},
                                                              {3.97, -1.72},
                                                              {4.76, -1.71},
                                                              {5.76, -1.20},
                                                              {7.12, .13},
                                                              {9.12, 2.15}}};

// Chung & Ooi (2011), test 6, aluminium alloy: V_s/V_n before against V_s/V_n after.
inline constexpr std::array<CurvePoint, 7> k_spin_on_plane{
    {{0.465, .09}, {1.0, -.15}, {1.43, -.35}, {1.73, -.38}, {2.747, 1.27}, {3.733, 3.25}, {5.677, 7.13}}};

}  // namespace dem::verify
