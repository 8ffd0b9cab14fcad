/// What a graphics driver does to the bytes of a picture on their way into the cable.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiment/protocol/output_mode.h"

namespace overt {

/// One setting of an output, as the driver has it now.
struct SignalSetting {
    enum class Source : std::uint8_t {
        randr,      ///< a property of the output
        randr_crtc, ///< what xrandr --rotate and --transform set
        nvidia      ///< as nvidia-settings tells it
    };
    std::string name, value; ///< numbers of an array stand apart by a blank
    Source source = Source::randr;
    bool operator==(const SignalSetting&) const = default;
};

/// All settings of an output, named as in MonitorInfo::name ("DP-1"), with its rotation and transformation;
/// of NVIDIA's driver also what its program `nvidia_settings`, looked for in PATH, tells of colour range,
/// colour space and dithering. Blocks of bytes, such as the EDID, and tables of more than 18 numbers are left
/// out. Asks the server that DISPLAY names, over a connection of its own; empty where it tells nothing. Waits
/// for NVIDIA's program 5 s at most. Never throws.
std::vector<SignalSetting> read_signal_settings(const std::string& output,
                                                const std::string& nvidia_settings = "nvidia-settings");

/// What is asked of NVIDIA's program. A program that does not answer gives one setting, "nvidia-settings",
/// whose value says so. Never throws.
std::vector<SignalSetting> read_nvidia_settings(const std::string& output, const std::string& program);

/// How a setting is, for a mode of the output.
struct SignalVerdict {
    bool is_safe = true;
    std::string finding; ///< the value, and where it is not safe what it does and the command that mends it
};

/// Of settings that change no byte: nothing is known against them. Property names and values: RandR
/// properties of the Linux kernel's drivers (documentation "KMS properties"), of xf86-video-amdgpu and of
/// nouveau; those of NVIDIA's driver are from memory of its README, and untried on its hardware.
SignalVerdict judge_signal_setting(const SignalSetting& setting, OutputMode mode, const std::string& output);

} // namespace overt
