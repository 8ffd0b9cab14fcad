#include "app/stimuli/live_errors.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/protocol/material_kind.h"

namespace overt {

std::string live_differences_of(const Protocol& protocol) {
    std::string text;
    for (const LiveDifference& one : live_differences)
        if (std::ranges::find(protocol.materials, one.kind, &MaterialSettings::kind) !=
            protocol.materials.end())
            text += fmt::format("{}{} {:.1f} and {:.0f}", text.empty() ? "" : ", ", name_of(one.kind),
                                one.median, one.most);
    return text.empty()
               ? text
               : fmt::format("Live frames differ from baked ones, in CIEDE2000 in the median and of 95 % of "
                             "the pixels, under the overcast sky as overt bench live holds it, by up to: {}. "
                             "Under small sources and in folds it is more.",
                             text);
}

} // namespace overt
