// Columns of a table by their names.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "vantage/report/report_data.hpp"

namespace vantage::support {

/// Past the last one, and a failure of the test, if there is none of that name.
inline std::size_t column_index(const CsvTable& table, std::string_view name) {
  const auto found = std::ranges::find(table.columns, name);
  EXPECT_NE(found, table.columns.end()) << "no column " << name;
  return static_cast<std::size_t>(found - table.columns.begin());
}

}  // namespace vantage::support
