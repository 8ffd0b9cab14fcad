/// Fields of an observer's form for tests.
#pragma once

#include <string>
#include <vector>

#include "experiment/ports/observer_field.h"

namespace overt::test {

/// Two known fields, which must be filled in, and one of this name that need not be.
inline std::vector<ObserverFieldSettings> three_observer_fields(const std::string& optional_one) {
    std::vector<ObserverFieldSettings> fields(3);
    fields[0].id = "age";
    fields[1].id = "handedness";
    fields[2].id = optional_one;
    fields[2].required = false;
    for (ObserverFieldSettings& field : fields)
        complete_field(field, false);
    return fields;
}

} // namespace overt::test
