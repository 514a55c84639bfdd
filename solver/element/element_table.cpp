// SPDX-License-Identifier: Apache-2.0
#include "solver/element/element_table.hpp"

#include <fmt/format.h>

#include <iterator>

namespace scree {
namespace {

/// The column names of a field; empty where it is not for output.
std::vector<std::string> names_of(const StateField& field) {
  if (!field.output) return {};
  if (field.components == 1) return {field.name};
  std::vector<std::string> names;
  if (field.components == 3) {
    for (const char* i : {"_1", "_2", "_3"}) names.push_back(field.name + i);
  } else if (field.components == 6) {
    for (const char* ij : {"_11", "_12", "_13", "_22", "_23", "_33"}) {
      names.push_back(field.name + ij);
    }
  } else {
    for (int k = 0; k < field.components; ++k) {
      names.push_back(fmt::format("{}_{}{}", field.name, k / 3 + 1, k % 3 + 1));
    }
  }
  return names;
}

void append_row(std::string& text, const ElementRow& row, const std::vector<StateField>& fields) {
  const auto out = std::back_inserter(text);
  const auto& s = row.cauchy;
  // 0.0 - x: compression positive without a "-0".
  fmt::format_to(out, "{},{},{},{},{},{},{},{},{},{},{}", row.step, row.strain.axial,
                 0.0 + row.strain.volumetric, row.strain.shear, 0.0 + row.pressure(),
                 row.deviatoric(), 0.0 - s.xx, 0.0 - s.yy, 0.0 - s.zz, 0.0 + s.xy, row.void_ratio);
  std::size_t first = 0;
  for (const StateField& field : fields) {
    const auto count = static_cast<std::size_t>(field.components);
    for (std::size_t k = 0; k < count && field.output; ++k) {
      fmt::format_to(out, ",{}", row.entries[first + k]);
    }
    first += count;
  }
  if (row.pore_pressure) fmt::format_to(out, ",{}", *row.pore_pressure);
  text += '\n';
}

}  // namespace

const char* const element_columns =
    "step,strain_axial,strain_volumetric,strain_shear,p,q,sigma_1,sigma_2,sigma_3,tau_12,"
    "void_ratio";

std::string element_csv(const ElementResult& result) {
  std::string text = element_columns;
  for (const StateField& field : result.fields) {
    for (const std::string& name : names_of(field)) text += "," + name;
  }
  if (result.rows.front().pore_pressure) text += ",pore_pressure";
  text += '\n';
  for (const ElementRow& row : result.rows) append_row(text, row, result.fields);
  return text;
}

}  // namespace scree
