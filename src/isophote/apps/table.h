#pragma once

#include <string>
#include <vector>

namespace isophote::app {

using Row = std::vector<std::string>;

/// Prints columns as wide as what they hold; all rows have as many cells as the first, the heading.
void print_table(const std::vector<Row>& rows);

}  // namespace isophote::app
