#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "wheelwright/cad/drawing/drawing.h"

namespace wheelwright {

/// A group of a DXF file: a code and its value.
struct DxfGroup {
  int line;  ///< of the code, from 1
  int code;
  std::string_view value;  ///< without the spaces about it; of the file's bytes

  double number() const;  ///< NaN if it is not a number; "nan" and "inf" are not
  bool is_malformed()
      const;            ///< whether a number belongs there by its code (10 to 59, 210 to 239), and is not
  int integer() const;  ///< 0 if it is not an integer
};

/// A group with code 0 and those after it up to the next one: an entity, or a part of the file's structure.
struct DxfRecord {
  int line;
  std::string_view type;
  std::vector<DxfGroup> groups;

  bool has(int code) const;
  double number(int code, double absent) const;
  int integer(int code, int absent) const;
  std::string_view text(int code) const;
  Point point(int x_code) const;  ///< the groups x_code and x_code + 10
  std::vector<double> numbers(int code) const;
};

/// All records of a file; those before the first group with code 0 are lost. Adds a problem where the file
/// does not consist of groups.
std::vector<DxfRecord> dxf_records(std::string_view bytes, std::vector<DrawingProblem>& problems);

}  // namespace wheelwright
