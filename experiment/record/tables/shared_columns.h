/// Columns that several tables share.
#pragma once

#include <string>

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
    /// Levels name the session's own tasks, sculptures and materials.
    explicit SharedColumns(const SessionHeader& header);

    TableColumn trial, task, sculpture, material, angle;
};

/// A time by the session's clock.
TableColumn session_seconds(std::string name, const std::string& meaning);

} // namespace overt
