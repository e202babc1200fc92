#include "wheelwright/files/level_set_file.h"

namespace wheelwright {
namespace {

constexpr std::string_view kind = "LSET";
constexpr std::uint32_t version = 1;
constexpr std::string_view tag = "LSET";

/// Far more than any grid has, but few enough that numbers of nodes do not overflow 64 bits in 3D.
constexpr int max_cells = 1'000'000;

/// In place of the number of radial cells, which follows, 0 and the fixed lines.
void append(const std::vector<FixedLine>& lines, ByteWriter& writer) {
  writer.integer(0);
  writer.integer(static_cast<int>(lines.size()));
  for (const auto& [line, radius] : lines) {
    writer.integer(line);
    writer.number(radius);
  }
}

std::vector<FixedLine> read_fixed_lines(ByteReader& reader) {
  std::vector<FixedLine> lines;
  const std::size_t n = reader.count(2 * sizeof(double));
  for (std::size_t k = 0; k < n && reader.ok(); ++k) {
    const int line = static_cast<int>(reader.integer(1, max_cells, "a fixed line of the grid"));
    lines.push_back({line, reader.finite_number("a radius of the grid")});
  }
  if (lines.empty()) reader.fail("the grid has no radial cells");
  return lines;
}

/// Whether the fixed lines and their radii increase from the rim to the tread.
template <int dim>
bool are_in_order(const PolarGrid<dim>& grid) {
  FixedLine last{0, grid.inner_radius};
  for (const FixedLine& fixed : grid.fixed_lines) {
    if (fixed.line <= last.line || !(fixed.radius > last.radius)) return false;
    last = fixed;
  }
  return last.line < grid.cells[0] && last.radius < grid.outer_radius;
}

template <int dim>
void append(const PolarGrid<dim>& grid, ByteWriter& writer) {
  for (const double length : {grid.inner_radius, grid.outer_radius, grid.width}) writer.number(length);
  writer.integer(grid.n_sectors);
  if (!grid.fixed_lines.empty()) append(grid.fixed_lines, writer);
  for (const int cells : grid.cells) writer.integer(cells);
}

template <int dim>
PolarGrid<dim> read_grid(ByteReader& reader) {
  PolarGrid<dim> grid;
  for (double* length : {&grid.inner_radius, &grid.outer_radius, &grid.width})
    *length = reader.finite_number("a length of the grid");
  if (!(0 < grid.inner_radius && grid.inner_radius < grid.outer_radius && grid.width > 0))
    reader.fail("the grid's radii or width do not form a ring");
  grid.n_sectors = static_cast<int>(reader.integer(1, max_cells, "the number of sectors"));
  const auto read_cells = [&](int least) {
    return static_cast<int>(reader.integer(least, max_cells, "a number of cells of the grid"));
  };
  grid.cells[0] = read_cells(0);
  if (grid.cells[0] == 0) {
    grid.fixed_lines = read_fixed_lines(reader);
    grid.cells[0] = read_cells(1);
  }
  for (int d = 1; d < dim; ++d) grid.cells[d] = read_cells(1);
  if (!are_in_order(grid)) reader.fail("the fixed lines of the grid are not in order");
  return grid;
}

template <int dim>
std::uint64_t number_of_nodes(const PolarGrid<dim>& grid, int degree) {
  std::uint64_t n = 1;
  for (int d = 0; d < dim; ++d) n *= std::uint64_t(degree) * grid.cells[d] + (d == 1 ? 0 : 1);
  return n;
}

}  // namespace

template <int dim>
void append(const LevelSet<dim>& psi, ByteWriter& writer) {
  writer.integer(dim);
  append(psi.lattice.grid(), writer);
  writer.integer(psi.lattice.degree());
  writer.numbers(psi.values);
}

template <int dim>
std::optional<LevelSet<dim>> read_level_set(ByteReader& reader) {
  reader.integer(dim, dim, "the dimension");
  const auto grid = read_grid<dim>(reader);
  const int degree = static_cast<int>(reader.integer(1, 2, "the degree of the level set"));
  auto values = reader.finite_numbers("the values of the level set");
  if (values.size() != number_of_nodes(grid, degree)) reader.fail("the level set does not fit its grid");
  if (!reader.ok()) return {};
  return LevelSet<dim>{Lattice<dim>(grid, degree), std::move(values)};
}

template <int dim>
std::string level_set_file(const LevelSet<dim>& psi) {
  ByteWriter writer;
  append(psi, writer);
  return block_file(kind, version, {{std::string(tag), writer.bytes()}});
}

template <int dim>
Expected<LevelSet<dim>, FormatError> parse_level_set_file(std::string_view bytes) {
  const auto payloads = parse_block_file(bytes, kind, version, {tag});
  if (!payloads) return payloads.failure();
  ByteReader reader(payloads->front());
  auto psi = read_level_set<dim>(reader);
  reader.finish();
  if (!reader.ok()) return FormatError{FormatFault::invalid_value, reader.problem()};
  return *std::move(psi);
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                 \
  template void append(const LevelSet<dim>&, ByteWriter&);           \
  template std::optional<LevelSet<dim>> read_level_set(ByteReader&); \
  template std::string level_set_file(const LevelSet<dim>&);         \
  template Expected<LevelSet<dim>, FormatError> parse_level_set_file<dim>(std::string_view);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
