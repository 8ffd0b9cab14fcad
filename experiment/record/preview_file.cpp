#include "experiment/record/preview_file.h"

#include <fmt/format.h>

namespace overt {

std::string preview_file(const SessionHeader& header, const Condition& condition) {
    return fmt::format("stimuli/{}_{}.png",
                       header.sculptures[static_cast<std::size_t>(condition.sculpture)].id,
                       header.materials[static_cast<std::size_t>(condition.material)].id);
}

} // namespace overt
