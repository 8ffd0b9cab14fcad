/// Columns that several tables share.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "experiment/record/session_header.h"
#include "experiment/record/tables/row_layout.h"

namespace overt {

/// An item of a list of the header that is known to have it.
const auto& item(const auto& list, int index) { return list[static_cast<std::size_t>(index)]; }

/// An item of a list of the header, or null if it has no such.
template <class List> const auto* item_of(const List& list, int index) {
    return index >= 0 && static_cast<std::size_t>(index) < list.size()
               ? &list[static_cast<std::size_t>(index)]
               : nullptr;
}

struct SharedColumns {
    /// Levels name the session's own tasks, objects and materials.
    explicit SharedColumns(const SessionHeader& header);

    TableColumn trial, task, object, material, slot, angle;
    bool has_slots; ///< more than one: tables say in which something was
};

inline TableColumn eye_column() {
    return {"eye", "Which eye", "", {{"left", "left eye"}, {"right", "right eye"}}};
}
inline std::string_view word_of_eye(Eye eye) { return eye == Eye::left ? "left" : "right"; }

/// Of a clock's time, as the tracker's and boxes' own have it.
constexpr auto microseconds_of = [](auto time) -> std::int64_t { return time.time_since_epoch().count(); };

/// A time by the session's clock.
TableColumn session_seconds(std::string name, const std::string& meaning);

} // namespace overt
