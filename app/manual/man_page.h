/// Manual pages in the language of man(7).
#pragma once

#include <string>

#include "app/manual/command_table.h"

namespace overt {

/// Without ending: "overt", "overt-tracker-calibrate".
std::string man_page_name(const CommandEntry& entry);

/// Section 1; `version` stands at its foot.
std::string man_page(const CommandEntry& entry, const std::string& version);

} // namespace overt
