#include "wheelwright/case/case_key.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "wheelwright/case/read.h"
#include "wheelwright/case/single_load.h"

namespace wheelwright {
namespace {

template <class SomeSection>
std::string path_of(const SomeSection& section) {
  if constexpr (requires { section.path(); })
    return section.path();
  else
    return std::string(section.name);
}

/// Expects that every one of the members has a key.
template <class Struct, class... Members>
void expect_keys(const Struct& s, const Members&... members) {
  const auto& section = section_of<Struct>();
  std::set<const void*> places;
  for (const auto& key : section.keys) places.insert(place(key, s));
  const std::set<const void*> all{&members...};
  for (const void* member : all)
    EXPECT_TRUE(places.contains(member))
        << path_of(section) << ": the member at byte "
        << static_cast<const char*>(member) - reinterpret_cast<const char*>(&s) << " has no key";
  EXPECT_EQ(places, all) << path_of(section);
}

// Each binding names all members of a struct: a new member does not compile until it is here, and then needs
// a key. Members without a key of their own are not passed on.

TEST(CaseKey, EveryMemberOfATableHasAKey) {
  const Wheel w;
  const auto& [dimension, inner, outer, width, sectors, sides] = w;
  expect_keys(w, dimension, inner, outer, width, sectors, sides);
  const RingMaterial m;
  const auto& [modulus, ratio, plane, density, loss, strength, conductivity, warmest] =
      static_cast<const Material&>(m);
  const auto& [measure, limit, strain, cycles, exponent, pressure_factor, ultimate] =
      static_cast<const FatigueConstants&>(m);
  const auto& [model, second_share] = static_cast<const LargeStrainConstants&>(m);
  const auto& [e_r, e_t, e_z, nu_rt, nu_rz, nu_tz, g_rt, g_rz, g_tz] =
      static_cast<const OrthotropicConstants&>(m);
  expect_keys(m, modulus, ratio, plane, density, loss, conductivity, warmest, model, second_share, measure,
              limit, strain, cycles, exponent, pressure_factor, ultimate, e_r, e_t, e_z, nu_rt, nu_rz, nu_tz,
              g_rt, g_rz, g_tz);
  const Load l;
  const auto& [force, travel, along, lateral, camber, torque, body, pressure, speed, ground, ground_radius,
               ground_height, ground_place, ground_profile, positions, own, cases] = l;
  expect_keys(l, force, travel, along, lateral, camber, torque, body, pressure, speed, ground, ground_radius,
              ground_height, ground_place, ground_profile, positions);
  const Heat h;
  const auto& [ambient, rim, convection, of_tread, of_holes, of_sides] = h;
  expect_keys(h, ambient, rim, convection, of_tread, of_holes, of_sides);
  const Contact t;
  const auto& [with, method, theta, gamma_0, friction, points] = t;
  expect_keys(t, with, method, theta, gamma_0, friction, points);
  const Grid g;
  const auto& [radial, angular, axial, degree, dilatation, level_set_degree, levels] = g;
  expect_keys(g, radial, angular, axial, degree, dilatation, level_set_degree, levels);
  const GhostPenalty p;
  const auto& [kind, xi] = p;
  expect_keys(p, kind, xi);
  const Volume v;
  const auto& [control, target, rate] = v;
  expect_keys(v, control, target, rate);
}

TEST(CaseKey, EveryMemberOfAnOptimizationHasAKey) {
  const Objective j;
  const auto& [minimize, layer, over, energy, annulus, dual, l2, matches, thickness, length, mean, norm,
               terms] = j;
  expect_keys(j, minimize, layer, over, energy, annulus, dual, l2, matches, thickness, length, mean, norm);
  const Optimizer o;
  const auto& [method, iterations, coarse, velocity, velocity_length, step, halvings, increase, tolerance,
               redistance, smoothing, smooth, rim, tread, wall, gap, radius, nucleation, made, parting_plane,
               parting, draft, overhang, stands_on] = o;
  expect_keys(o, method, iterations, coarse, velocity, velocity_length, step, halvings, increase, tolerance,
              redistance, smoothing, smooth, rim, tread, wall, gap, radius, nucleation, made, parting_plane,
              parting, draft, overhang, stands_on);
  const Output f;
  const auto& [folder, vtu, pictures, checkpoints, seconds, errors] = f;
  expect_keys(f, folder, vtu, pictures, checkpoints, seconds, errors);
}

TEST(CaseKey, EveryMemberOfAnArrayHasAKey) {
  const CaseLoad l;
  const auto& [name, weight, share, force, travel, along, torque, body, pressure, speed, ground,
               ground_radius, ground_height, ground_place, ground_profile, own] = l;
  expect_keys(l, name, weight, share, force, travel, along, torque, body, pressure, speed, ground,
              ground_radius, ground_height, ground_place, ground_profile);
  const Constraint b;
  const auto& [bounded, layer, at_least, at_most, equals, over, load_case] = b;
  expect_keys(b, bounded, layer, at_least, at_most, equals, over, load_case);
  const Expectation e;
  const auto& [expected, of_layer, value, margin, iteration, of_case] = e;
  expect_keys(e, expected, of_layer, value, margin, iteration, of_case);
}

TEST(CaseKey, EveryMemberOfAShapeHasAKey) {
  const HoleRing r;
  const auto& [count, center_radius, radius, phase] = r;
  expect_keys(r, count, center_radius, radius, phase);
  const HoleCircle c;
  const auto& [center, circle_radius] = c;
  expect_keys(c, center, circle_radius);
  const HoleSphere s;
  const auto& [spheres, sphere_center, sphere_radius, z, sphere_phase] = s;
  expect_keys(s, spheres, sphere_center, sphere_radius, z, sphere_phase);
  const HoleTapered t;
  const auto& [tapered, tapered_center, profile, tapered_phase] = t;
  expect_keys(t, tapered, tapered_center, profile, tapered_phase);
  const HoleGroove g;
  const auto& [inner_side, outer_side, depth, outer_depth, fillet, side] = g;
  expect_keys(g, inner_side, outer_side, depth, outer_depth, fillet, side);
  const SpokeShape k;
  const auto& [order, as, kind, spokes, thickness, angle, bend, spread, fork, inner, outer, spoke_phase] = k;
  expect_keys(k, as, kind, spokes, thickness, angle, bend, spread, fork, inner, outer, spoke_phase);
  const FileShape f;
  const auto& [file_order, file_as, path, unit, axle, copies, turn, checksum, drawing] = f;
  expect_keys(f, file_as, path, unit, axle, copies, turn, checksum);
  const PictureShape p;
  const auto& [picture_order, picture_as, file, layout, width, threshold, parts, turned, digest, picture] = p;
  expect_keys(p, picture_as, file, layout, width, threshold, parts, turned, digest);
  const SavedShape v;
  const auto& [from, saved_digest, saved] = v;
  expect_keys(v, from, saved_digest);
}

TEST(CaseKey, EveryMemberOfADrawnShapeHasAKey) {
  const CircleShape c;
  const auto& [circle_order, circle_as, circles, circle_center, circle_radius, circle_phase] = c;
  expect_keys(c, circle_as, circles, circle_center, circle_radius, circle_phase);
  const EllipseShape e;
  const auto& [ellipse_order, ellipse_as, ellipses, center, length, width, angle, phase] = e;
  expect_keys(e, ellipse_as, ellipses, center, length, width, angle, phase);
  const SlotShape s;
  const auto& [slot_order, slot_as, slots, slot_center, slot_length, slot_width, slot_angle, slot_phase] = s;
  expect_keys(s, slot_as, slots, slot_center, slot_length, slot_width, slot_angle, slot_phase);
  const PolygonShape p;
  const auto& [polygon_order, polygon_as, polygons, points, turned] = p;
  expect_keys(p, polygon_as, polygons, points, turned);
  const AnnulusShape a;
  const auto& [annulus_order, annulus_as, inner, outer] = a;
  expect_keys(a, annulus_as, inner, outer);
  const ObjectiveTerm t;
  const auto& [quantity, layer, weight] = t;
  expect_keys(t, quantity, layer, weight);
}

TEST(CaseKey, HasThePathOfTheFile) {
  EXPECT_EQ(key_of(&Case::title).path(), "title");
  EXPECT_EQ(key_of(&Wheel::sectors).path(), "wheel.sectors");
  EXPECT_EQ(key_of(&Material::plane).path(), "material.plane");
  EXPECT_EQ(key_of(&HoleRing::radius, 1).path(), "holes.ring[2].radius");
  EXPECT_EQ(table_of<FileShape>(0).path(), "shape.file[1]");
  const auto paths = key_of(&Load::force).paths();
  EXPECT_EQ(paths, (std::vector<std::string>{"load.force", "load.mass"}));
}

TEST(CaseKey, OfALoadIsWhereTheLoadCaseSetsIt) {
  Case c;
  CaseLoad kerb, road;
  kerb.name = "kerb";
  kerb.torque = 3;
  road.name = "road";
  road.force = 100;
  c.load.cases = {kerb, road};
  const auto loads = single_loads(c);
  ASSERT_EQ(loads.size(), 2u);
  EXPECT_EQ(loads[0].key(&Load::torque).path(), "load.case[1].torque");
  EXPECT_EQ(loads[0].key(&Load::force).path(), "load.force");
  EXPECT_EQ(loads[1].key(&Load::torque).path(), "load.torque");
  EXPECT_EQ(loads[1].key(&Load::force).paths(),
            (std::vector<std::string>{"load.case[2].force", "load.case[2].mass"}));
  EXPECT_EQ(loads[0].key(&Load::positions).path(), "load.positions");
}

TEST(CaseKey, AConflictIsBlamedOnTheNameThatTheFileGives) {
  for (const char* name : {"mass", "force"}) {
    const auto problems = parse_case(std::string("[load]\n") + name + " = 1e7\n", "heavy.toml").problems;
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_EQ(problems[0].key, std::string("load.") + name);
    EXPECT_EQ(problems[0].line, 2);
  }
}

/// All keys and tables of the case file, e.g. "load.force" and "load.case".
std::set<std::string> known_paths() {
  std::set<std::string> paths;
  for_each_section([&](const auto& section) {
    paths.insert(path_of(section));
    for (const auto& key : section.keys) paths.insert(path_of(section) + "." + std::string(key.name));
  });
  return paths;
}

/// The first words of the paths, as alternatives of a regular expression.
std::string first_words(const std::set<std::string>& paths) {
  std::set<std::string> words;
  for (const std::string& path : paths)
    if (!path.empty() && path.front() != '.') words.insert(path.substr(0, path.find('.')));
  std::string result;
  for (const std::string& word : words) result += (result.empty() ? "" : "|") + word;
  return result;
}

TEST(CaseKey, EveryKeyThatATextOfTheProgramNamesExists) {
  const std::set<std::string> paths = known_paths(), files{"shape.svg", "shape.stl", "shape.levelset"};
  const std::regex literal(R"("(?:[^"\\]|\\.)*")"),
      key("(?:^|[^\\w./-])((?:" + first_words(paths) + ")\\.[a-z_]+)(?![\\w(])");
  int n_found = 0;
  const std::filesystem::path folder(WHEELWRIGHT_SOURCE_DIR "/src/wheelwright");
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".cc" && entry.path().extension() != ".h") continue;
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line);) {
      if (line.starts_with("#include")) continue;
      for (std::sregex_iterator text(line.begin(), line.end(), literal), end; text != end; ++text) {
        const std::string said = text->str();
        for (std::sregex_iterator named(said.begin(), said.end(), key); named != end; ++named) {
          if (files.contains(named->str(1))) continue;
          EXPECT_TRUE(paths.contains(named->str(1))) << entry.path() << ": " << said;
          ++n_found;
        }
      }
    }
  }
  EXPECT_GT(n_found, 30);
}

}  // namespace
}  // namespace wheelwright
