#include "render/signal/mode_coding.h"

#include <utility>

namespace overt {

const ModeCoding& coding_of(OutputMode mode) {
    using Coding = const ModeCoding& (*)();
    constexpr auto codings = []<std::size_t... i>(std::index_sequence<i...>) {
        return std::array<Coding, sizeof...(i)>{&mode_coding<output_modes[i].mode>...};
    }
    (std::make_index_sequence<output_modes.size()>());
    return codings[static_cast<std::size_t>(mode)]();
}

} // namespace overt
