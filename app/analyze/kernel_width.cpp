#include "app/analyze/kernel_width.h"

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

KernelWidth kernel_width(const std::string& text) {
    KernelWidth width;
    std::size_t end = 0;
    try {
        width.value = std::stod(text, &end);
    } catch (const std::exception&) {
        end = 0;
    }
    const std::size_t unit_at = text.find_first_not_of(' ', end);
    const std::string unit = unit_at == std::string::npos ? "" : text.substr(unit_at);
    width.is_mm = unit == "mm";
    if (end == 0 || !(width.value > 0.0) || width.value > 1e4 ||
        (!unit.empty() && unit != "mm" && unit != "deg"))
        throw InputError(fmt::format(
            "--sigma {}: a width above 0 with its unit is expected, such as 1deg or 30mm.", text));
    return width;
}

} // namespace overt
