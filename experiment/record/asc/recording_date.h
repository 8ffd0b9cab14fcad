/// Dates as EyeLink files have them, from and to ISO 8601.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace overt {

/// "Thu Feb 29 23:59:59 2024" of "2024-02-29T23:59:59Z"; the begin of 1970 of what is no date.
std::string asc_date(std::string_view iso);

/// The way back; nothing of what is no date. An EyeLink's date is local time: it is taken as it is.
std::optional<std::string> iso_date(std::string_view asc);

} // namespace overt
