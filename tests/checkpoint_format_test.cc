#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/checkpoint_sample.h"
#include "wheelwright/files/level_set_file.h"
#include "wheelwright/run/checkpoints/checkpoint.h"

namespace wheelwright {
namespace {

constexpr std::uint32_t format_version = 12;  // of the format

using testing::Random;
using testing::small_grid;
using testing::some_checkpoint;
using testing::some_level_set;

const std::vector<std::string_view> checkpoint_tags{"CASE", "STAT", "INIT", "HOLE", "RUN "};

template <int dim>
std::string round_trip(const std::string& bytes) {
  const auto parsed = parse_checkpoint_file<dim>(bytes);
  return parsed ? checkpoint_file(*parsed) : parsed.failure().detail;
}

TEST(CheckpointFormat, RoundTripIsExactIn2DAnd3D) {
  const std::string flat = checkpoint_file(some_checkpoint<2>()),
                    solid = checkpoint_file(some_checkpoint<3>());
  EXPECT_EQ(round_trip<2>(flat), flat);
  EXPECT_EQ(round_trip<3>(solid), solid);
}

template <int dim>
void expect_parts_come_back() {
  const auto state = some_checkpoint<dim>().state;
  const std::string bytes = state_file(state), of_evaluation = evaluation_file(state.evaluation);
  const auto parsed = parse_state_file<dim>(bytes);
  ASSERT_TRUE(parsed) << parsed.failure().detail;
  EXPECT_EQ(state_file(*parsed), bytes);
  EXPECT_EQ(evaluation_file(parsed->evaluation), of_evaluation);
  const auto evaluation = parse_evaluation_file<dim>(of_evaluation);
  ASSERT_TRUE(evaluation) << evaluation.failure().detail;
  EXPECT_EQ(evaluation_file(*evaluation), of_evaluation);
}

TEST(CheckpointFormat, StatesAndEvaluationsHaveFilesOfTheirOwn) {
  expect_parts_come_back<2>();
  expect_parts_come_back<3>();
  const auto state = some_checkpoint<2>().state;
  EXPECT_FALSE(parse_evaluation_file<2>(state_file(state)));
  auto unequal = state.evaluation;
  unequal.functions[0].gradient.pop_back();
  EXPECT_FALSE(parse_evaluation_file<2>(evaluation_file(unequal)));
}

/// The text stands in the file: the number of an own unit is that of a process.
TEST(CheckpointFormat, OwnUnitsComeBackByTheirText) {
  auto evaluation = some_checkpoint<2>().state.evaluation;
  evaluation.functions[0].unit = own_unit("Pa^2 m");
  const std::string bytes = evaluation_file(evaluation);
  EXPECT_NE(bytes.find("Pa^2 m"), std::string::npos);
  EXPECT_EQ(parse_evaluation_file<2>(bytes)->functions[0].unit, own_unit("Pa^2 m"));
}

TEST(CheckpointFormat, ContainsTheWholeState) {
  const auto written = some_checkpoint<2>();
  const auto parsed = parse_checkpoint_file<2>(checkpoint_file(written));
  ASSERT_TRUE(parsed);
  const auto &a = written.state, &b = parsed->state;
  EXPECT_EQ(a.shape.values, b.shape.values);
  EXPECT_EQ(a.shape.lattice.degree(), b.shape.lattice.degree());
  EXPECT_EQ(a.shape.lattice.grid().cells, b.shape.lattice.grid().cells);
  EXPECT_EQ(a.shape.lattice.grid().outer_radius, b.shape.lattice.grid().outer_radius);
  ASSERT_EQ(b.evaluation.functions.size(), 2);
  for (int k = 0; k < 2; ++k) {
    const FunctionValue &f = a.evaluation.functions[k], &g = b.evaluation.functions[k];
    EXPECT_EQ(f.name, g.name);
    EXPECT_EQ(f.value, g.value);
    EXPECT_EQ(f.by_position, g.by_position);
    EXPECT_EQ(f.gradient, g.gradient);
    EXPECT_EQ(f.bounds.lower, g.bounds.lower);
    EXPECT_EQ(f.bounds.upper, g.bounds.upper);
    EXPECT_EQ(f.unit, g.unit);
    EXPECT_EQ(a.evaluation.terms[k].name, b.evaluation.terms[k].name);
    EXPECT_EQ(a.evaluation.terms[k].value, b.evaluation.terms[k].value);
    EXPECT_EQ(a.evaluation.terms[k].by_position, b.evaluation.terms[k].by_position);
  }
  EXPECT_EQ(a.evaluation.boundary[0].normal, b.evaluation.boundary[0].normal);
  EXPECT_EQ(a.evaluation.boundary[1].weight, b.evaluation.boundary[1].weight);
  EXPECT_TRUE(std::signbit(b.evaluation.functions[0].gradient[1]));
  EXPECT_EQ(a.evaluation.newton_iterations, b.evaluation.newton_iterations);
  EXPECT_EQ(a.evaluation.mean_observations.entries(), b.evaluation.mean_observations.entries());
  EXPECT_EQ(a.evaluation.mean_observations.rows(), b.evaluation.mean_observations.rows());
  EXPECT_EQ(a.evaluation.phases[1].seconds, b.evaluation.phases[1].seconds);
  EXPECT_TRUE(std::isnan(b.evaluation.measures[1].value));
  EXPECT_EQ(a.measure, b.measure);
  EXPECT_EQ(a.target_measure, b.target_measure);
  EXPECT_EQ(a.iteration, b.iteration);
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.since_redistance, b.since_redistance);
  EXPECT_EQ(a.since_smoothing, b.since_smoothing);
  ASSERT_EQ(a.memory.pairs.size(), b.memory.pairs.size());
  EXPECT_EQ(a.memory.pairs[1].move, b.memory.pairs[1].move);
  EXPECT_EQ(a.memory.pairs[0].change, b.memory.pairs[0].change);
  EXPECT_EQ(a.memory.penalties, b.memory.penalties);
  EXPECT_EQ(a.memory.multipliers, b.memory.multipliers);
  EXPECT_EQ(a.history, b.history);
  EXPECT_EQ(a.history_begin, b.history_begin);
  EXPECT_EQ(a.final_widths, b.final_widths);
  EXPECT_EQ(written.initial.shape.values, parsed->initial.shape.values);
  EXPECT_EQ(written.initial.objective, parsed->initial.objective);
  EXPECT_EQ(written.found[1].quantity, parsed->found[1].quantity);
  EXPECT_EQ(written.found[0].iteration, parsed->found[0].iteration);
  EXPECT_EQ(written.found[0].value, parsed->found[0].value);
  EXPECT_EQ(written.history.bytes, parsed->history.bytes);
  EXPECT_EQ(written.history.checksum, parsed->history.checksum);
  EXPECT_EQ(written.elapsed_seconds, parsed->elapsed_seconds);
  EXPECT_EQ(written.finished, parsed->finished);
  EXPECT_EQ(written.provenance.resolved_case, parsed->provenance.resolved_case);
  EXPECT_EQ(written.provenance.program, parsed->provenance.program);
}

/// Cuts the file at every length, flips every bit, and appends: `parse` must fail each time, and say why.
template <class Parse>
void expect_every_damage_is_seen(const std::string& good, Parse parse) {
  ASSERT_TRUE(parse(good));
  for (std::size_t length = 0; length < good.size(); ++length) {
    const auto parsed = parse(good.substr(0, length));
    ASSERT_FALSE(parsed) << length;
    EXPECT_EQ(parsed.failure().fault, FormatFault::truncated) << length;
    EXPECT_FALSE(parsed.failure().detail.empty());
  }
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
    std::string bad = good;
    bad[bit / 8] = static_cast<char>(bad[bit / 8] ^ (1 << bit % 8));
    ASSERT_FALSE(parse(bad)) << bit;
  }
  EXPECT_EQ(parse(good + '\0').failure().fault, FormatFault::wrong_block);
}

TEST(CheckpointFormat, RejectsEveryTruncationAndEveryFlippedBit) {
  expect_every_damage_is_seen(checkpoint_file(some_checkpoint<2>()), parse_checkpoint_file<2>);
}

TEST(LevelSetFile, RoundTripIsExactAndCorruptionIsRejected) {
  Random random;
  const auto psi = some_level_set<3>(random, 2);
  const std::string bytes = level_set_file(psi);
  EXPECT_EQ(parse_level_set_file<3>(bytes)->values, psi.values);
  EXPECT_EQ(parse_level_set_file<2>(bytes).failure().fault, FormatFault::invalid_value);
  expect_every_damage_is_seen(bytes, parse_level_set_file<3>);
}

TEST(CheckpointFormat, NamesTheFault) {
  const std::string good = checkpoint_file(some_checkpoint<2>());
  const auto fault = [](const std::string& bytes) { return parse_checkpoint_file<2>(bytes).failure().fault; };
  EXPECT_EQ(fault("no such file, but one that is long enough for a header"), FormatFault::wrong_kind);
  EXPECT_EQ(fault(block_file("LSET", 1, {})), FormatFault::wrong_kind);
  EXPECT_EQ(fault(block_file("CKPT", format_version - 1, {})), FormatFault::unsupported_version);
  EXPECT_EQ(fault(block_file("CKPT", format_version + 1, {})), FormatFault::unsupported_version);
  EXPECT_EQ(fault(block_file("CKPT", format_version, {{"STAT", ""}, {"CASE", ""}})),
            FormatFault::wrong_block);
  EXPECT_EQ(fault(block_file("CKPT", format_version, {})), FormatFault::wrong_block);
  std::string bad = good;
  bad[good.size() / 2] ^= 1;
  EXPECT_EQ(fault(bad), FormatFault::wrong_checksum);
}

/// The checkpoint with right checksums, after a change of the payload of one block.
template <class Change>
std::string reframed(const std::string& good, std::size_t block, Change change) {
  const auto payloads = parse_block_file(good, "CKPT", format_version, checkpoint_tags);
  std::vector<Block> blocks;
  for (std::size_t k = 0; k < checkpoint_tags.size(); ++k) {
    std::string payload((*payloads)[k]);
    if (k == block) change(payload);
    blocks.push_back({std::string(checkpoint_tags[k]), std::move(payload)});
  }
  return block_file("CKPT", format_version, blocks);
}

// Checksums do not protect from files that were made to harm: sizes and values are checked too.

TEST(CheckpointFormat, RejectsInconsistentDataWithValidChecksums) {
  const std::string good = checkpoint_file(some_checkpoint<2>());
  int rejected = 0;
  for (std::size_t block = 0; block < checkpoint_tags.size(); ++block) {
    const std::size_t size = (*parse_block_file(good, "CKPT", format_version, checkpoint_tags))[block].size();
    for (std::size_t at = 0; at < size; ++at)
      for (const char value : {'\x00', '\x01', '\x7f', '\x80', '\xff'}) {
        const auto parsed = parse_checkpoint_file<2>(
            reframed(good, block, [&](std::string& payload) { payload[at] = value; }));
        if (parsed) continue;
        ++rejected;
        ASSERT_EQ(parsed.failure().fault, FormatFault::invalid_value);
      }
    EXPECT_FALSE(
        parse_checkpoint_file<2>(reframed(good, block, [](std::string& payload) { payload += "more"; })));
    for (std::size_t length = 0; length < size; ++length)
      ASSERT_FALSE(parse_checkpoint_file<2>(
          reframed(good, block, [&](std::string& payload) { payload.resize(length); })))
          << block << ' ' << length;
  }
  EXPECT_GT(rejected, 1000);
}

TEST(CheckpointFormat, AllocatesNothingForClaimedSizes) {
  for (const std::int64_t claim : {std::int64_t{1} << 40, std::numeric_limits<std::int64_t>::max(),
                                   std::int64_t{-1}, std::numeric_limits<std::int64_t>::min()}) {
    ByteWriter writer;
    writer.integer(claim);
    for (int k = 0; k < 8; ++k) writer.number(k);
    EXPECT_EQ(ByteReader(writer.bytes()).count(1), 0u);
    EXPECT_TRUE(ByteReader(writer.bytes()).numbers().empty());
    EXPECT_TRUE(ByteReader(writer.bytes()).text().empty());
    ByteReader reader(writer.bytes());
    reader.text();
    EXPECT_FALSE(reader.ok());
    EXPECT_EQ(reader.number(), 0);
  }
}

template <class Change>
bool accepts(Change change) {
  auto checkpoint = some_checkpoint<2>();
  change(checkpoint);
  return bool(parse_checkpoint_file<2>(checkpoint_file(checkpoint)));
}

TEST(CheckpointFormat, RejectsImpossibleStates) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(accepts([](auto&) {}));
  EXPECT_FALSE(accepts([](auto& c) { c.state.evaluation.boundary[0].cell = 6; }));
  EXPECT_FALSE(accepts([](auto& c) { c.state.evaluation.boundary[0].cell = -1; }));
  EXPECT_FALSE(accepts([](auto& c) { c.state.evaluation.functions[1].gradient.pop_back(); }));
  EXPECT_FALSE(accepts([](auto& c) { c.state.shape.values.pop_back(); }));
  EXPECT_FALSE(accepts([&](auto& c) { c.state.shape.values[3] = nan; }));
  EXPECT_FALSE(accepts([&](auto& c) { c.initial.objective = nan; }));
  EXPECT_FALSE(accepts([](auto& c) { c.state.history.pop_back(); }));
  EXPECT_FALSE(accepts([](auto& c) { c.state.history_begin = 1; }));
  EXPECT_FALSE(accepts([](auto& c) { c.state.history_begin = c.state.iteration + 1; }));
  EXPECT_TRUE(accepts([](auto& c) {
    c.state.history_begin = 1;
    c.state.history.pop_back();
  }));
  EXPECT_FALSE(accepts([](auto& c) { c.state.iteration = -1; }));
  EXPECT_FALSE(accepts([](auto& c) { c.state.step = 0; }));
  EXPECT_FALSE(accepts([](auto& c) { c.state.final_widths = static_cast<FinalWidths>(4); }));
  EXPECT_FALSE(accepts([](auto& c) { c.state.memory.pairs[1].change.pop_back(); }));
  EXPECT_FALSE(accepts([&](auto& c) { c.state.memory.multipliers[0] = nan; }));
  EXPECT_FALSE(accepts([](auto& c) { c.state.evaluation.mean_observations.entries().pop_back(); }));
}

}  // namespace
}  // namespace wheelwright
