/// The lists of which a stimulus is one entry each: all that the program knows of how many there are.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "experiment/trial.h"

namespace overt {

/// One list of a protocol.
struct StimulusList {
    std::string_view name;   ///< of its sections, its columns and the factor
    std::string_view plural; ///< key of [[block]] and [[group]] that chooses of it
    int Stimulus::*index;
    bool decides_map;   ///< another entry may have another point of the surface in a pixel
    bool decides_light; ///< another entry may have other light in a pixel
    /// Tables have its column, and words its entry, though it may have one entry only; else with several.
    bool is_always_named;
    std::string_view shown; ///< what the column of a table tells
    /// Keys by which an entry is called that has no id: the first that it has, a word or a file's name. An
    /// entry that has none of them is called by the list.
    std::array<std::string_view, 3> named_by = {};
};

/// Orders, checks, the record, tables and commands go by these rows, in their order. Where a protocol has the
/// entries: entries_of_lists (experiment/protocol/protocol.h).
inline constexpr std::array stimulus_lists{
    StimulusList{"object",
                 "objects",
                 &Stimulus::object,
                 true,
                 true,
                 true,
                 "Which object was shown",
                 {"shipped", "mesh", "picture"}},
    StimulusList{"material",
                 "materials",
                 &Stimulus::material,
                 false,
                 true,
                 true,
                 "In which material it was shown",
                 {"kind"}},
    StimulusList{
        "light", "lights", &Stimulus::light, false, true, false, "Under which light it was shown", {"probe"}},
    StimulusList{
        "motion", "motions", &Stimulus::motion, true, true, false, "In which motion it was shown", {"kind"}},
    StimulusList{"view", "views", &Stimulus::view, true, true, false, "In which view it was shown"},
    StimulusList{"background",
                 "backgrounds",
                 &Stimulus::background,
                 false,
                 true,
                 false,
                 "Before which background it was shown",
                 {"picture"}},
};
static_assert(stimulus_lists.size() * sizeof(int) == sizeof(Stimulus), "each index is one of a list");

} // namespace overt
