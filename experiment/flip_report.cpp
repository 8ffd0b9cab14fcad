#include "experiment/flip_report.h"

namespace overt {

std::string_view name_of(VblankSource source) {
    switch (source) {
    case VblankSource::virtual_display:
        return "virtual display";
    case VblankSource::swap_return:
        return "return of the buffer swap";
    }
    return "unknown";
}

} // namespace overt
