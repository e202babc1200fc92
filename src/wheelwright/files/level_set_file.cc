#include "wheelwright/files/level_set_file.h"

namespace wheelwright {
namespace {

constexpr std::string_view kind = "LSET";
constexpr std::uint32_t version = 1;
constexpr std::string_view tag = "LSET";

/// Far more than any grid has, but few enough that numbers of nodes do not overflow 64 bits in 3D.
constexpr int max_cells = 1'000'000;

template <int dim>
void append(const PolarGrid<dim>& grid, ByteWriter& writer) {
  for (const double length : {grid.inner_radius, grid.outer_radius, grid.width}) writer.number(length);
  writer.integer(grid.n_sectors);
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
  for (int& cells : grid.cells)
    cells = static_cast<int>(reader.integer(1, max_cells, "a number of cells of the grid"));
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
