/// How tables call columns that stand beside a protocol's own.
#pragma once

#include <string_view>

namespace overt {

/// Whether a column of the entries of a list (`columns = {…}`, or a series) may not be called so, since a
/// table in which it would stand has another column of that name. Names of factors apart
/// (is_name_of_factor()). What trials have of their own may be called so: tables call it own_NAME there.
bool is_column_of_tables(std::string_view name);

} // namespace overt
