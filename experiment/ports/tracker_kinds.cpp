#include "experiment/ports/tracker_kinds.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"

namespace overt {

TrackerKind tracker_kind_called(std::string_view name) {
    const auto found = std::ranges::find(names_of<TrackerKind>, name);
    if (found == names_of<TrackerKind>.end())
        throw InputError(fmt::format("there is no kind of eye tracker called \"{}\"; there are {}", name,
                                     fmt::join(names_of<TrackerKind>, ", ")));
    return static_cast<TrackerKind>(found - names_of<TrackerKind>.begin());
}

} // namespace overt
