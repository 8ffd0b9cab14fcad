/// The words of a sample's line in an ASC file.
#pragma once

#include <array>
#include <string_view>

namespace overt {

struct AscSampleWords {
    std::string_view time;
    std::array<std::string_view, 6> values; ///< the first: place and pupil of one eye, perhaps of the other
    int count = 0;                          ///< of all values before the status, those of further columns too
    std::string_view further;               ///< the seventh value; empty if there is none
    std::string_view status;                ///< empty if there is none
};

AscSampleWords split_at_blanks(std::string_view line);

/// Where words may have blanks in them, or be missing: columns between tabs.
AscSampleWords split_at_tabs(std::string_view line);

} // namespace overt
