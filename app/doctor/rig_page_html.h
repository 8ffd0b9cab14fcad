/// The page of a rig, to be read in a browser.
#pragma once

#include <string>

#include "app/rig/rig_page.h"

namespace overt {

/// One file that opens offline, in the look of a study's report: what is proved, what failed and what is not
/// proved, with each step's figures.
std::string rig_page_html(const RigPage& page);

} // namespace overt
