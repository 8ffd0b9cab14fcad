#include "experiment/protocol/protocol_keys.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/ports/tracker_kinds.h"
#include "experiment/protocol/key_rows.h"

namespace overt {

const KeyTable& protocol_keys() {
    static const KeyTable table({key_rows::protocol(),
                                 key_rows::display(),
                                 key_rows::tracker(),
                                 key_rows::further_tracker(),
                                 key_rows::calibration(),
                                 key_rows::events(),
                                 key_rows::view(),
                                 key_rows::light(),
                                 key_rows::bake(),
                                 key_rows::animation(),
                                 key_rows::schedule(),
                                 key_rows::screens(),
                                 key_rows::consent(),
                                 key_rows::instructions(),
                                 key_rows::observer_fields(),
                                 key_rows::operators(),
                                 key_rows::button_box(),
                                 key_rows::marker_output(),
                                 key_rows::answers(),
                                 key_rows::task(),
                                 key_rows::block(),
                                 key_rows::group(),
                                 key_rows::practice(),
                                 key_rows::breaks(),
                                 key_rows::repeat(),
                                 key_rows::simulated_observers(),
                                 key_rows::simulated_effect(),
                                 key_rows::sculpture(),
                                 key_rows::material(),
                                 key_rows::frames(),
                                 key_rows::words(),
                                 key_rows::dataset()},
                                "include");
    return table;
}

TrackerKind tracker_kind_called(std::string_view name) {
    const auto found = std::ranges::find(tracker_names, name);
    if (found == tracker_names.end())
        throw InputError(fmt::format("there is no kind of eye tracker called \"{}\"; there are {}", name,
                                     fmt::join(tracker_names, ", ")));
    return static_cast<TrackerKind>(found - tracker_names.begin());
}

bool measures_gaze(TrackerKind kind) { return tracker_kinds[static_cast<std::size_t>(kind)].measures_gaze; }

std::string_view name_of(TrackerKind kind) { return tracker_names[static_cast<std::size_t>(kind)]; }

} // namespace overt
