#include "render/signal/signal_decoder.h"

#include "render/signal/mode_coding.h"

namespace overt {

ReceivedLight receive_light(const SignalScreen& screen, OutputMode mode) {
    return coding_of(mode).decode(ScreenReader(screen));
}

} // namespace overt
