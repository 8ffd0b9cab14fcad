/// What the entries of the lists have in common that stimuli are made of.
#pragma once

#include <string>

#include "experiment/base/named_words.h"

namespace overt {

/// Base of the struct of a list's entries.
struct ListEntry {
    std::string id = {};
    std::string title = {};
    /// What is said of it besides, for orders and tables; what a series sets is among it.
    NamedWords columns = {};
    Series series = {}; ///< that it was written out from
};

} // namespace overt
