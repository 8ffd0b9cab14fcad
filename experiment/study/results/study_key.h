#pragma once

#include <string>

namespace overt {

/// A column of the table of trials, or a field of the observer's form, and what stands in it.
struct StudyKey {
    std::string column;
    std::string value; ///< as in the exported tables; n/a where nothing stands
    friend bool operator==(const StudyKey&, const StudyKey&) = default;
};

} // namespace overt
