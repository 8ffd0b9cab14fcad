/// Programs that send gaze over the Lab Streaming Layer and do not say of their channels what they mean, or
/// not all of it: what their published sources say instead.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "devices/lsl/lsl_gaze_layout.h"

namespace overt {

/// What is to be known of a stream besides what it tells.
struct LslKnownApp {
    std::string_view app; ///< such as "App-EyeLink"; empty: it is none that is known
    LslLayoutSettings settings;
};

/// Completes what the protocol says (which counts before all else) by what is known of the program that sends
/// `stream`, the stream's name. It is recognised by that name where channels do not tell, else by the labels
/// of its channels, so that a stream may be called otherwise.
LslKnownApp with_known_app(LslLayoutSettings settings, const std::string& stream,
                           const std::vector<LslChannel>& channels);

} // namespace overt
