/// The proof that a display box receives the bytes that are drawn (overt display verify --hardware), kept
/// between runs, and asked for before a session that sends a packed signal through a box.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "devices/display_box/display_plus_plus.h"
#include "render/window/screen_check.h"
#include "render/window/window_context.h"

namespace overt {

/// All that has to be the same for a check to hold: one of these changed, and other bytes may arrive.
struct VideoPath {
    std::string product, serial_number; ///< of the box
    std::string graphics, driver;       ///< renderer and version as OpenGL names them
    std::string output;                 ///< of the graphics card, such as "DP-1"
    int width_px = 0, height_px = 0;
    double refresh_hz = 0.0; ///< of the mode, to 0.01 Hz
    bool operator==(const VideoPath&) const = default;
};

VideoPath video_path(const BoxIdentity& box, const GlDescription& graphics, const MonitorInfo& monitor);

struct VideoCheck {
    VideoPath path;
    std::string checked_utc; ///< as utc_now() writes it
    bool passed = false;
    std::string verdict; ///< in a sentence
    bool operator==(const VideoCheck&) const = default;
};

/// video_checks.json in state_folder().
std::filesystem::path video_check_file();

/// Those that were kept, the latest of each path. Empty if there is no file. Throws InputError naming the
/// file if it is damaged.
std::vector<VideoCheck> read_video_checks(const std::filesystem::path& file);

/// Puts a check in the place of the one before it of its path. Throws as read_video_checks(), and Error if
/// the file cannot be written; a file is replaced at once or not at all.
void keep_video_check(const std::filesystem::path& file, const VideoCheck& check);

/// What a session's record says of it. `days`: how old a check may be, `now_utc` as utc_now() writes it; with
/// 0 days none is asked for, and that is a risk. Throws InputError if the latest check of this path did not
/// pass, is older, or if there is none; which says what was the same in those that there are, and how to go
/// on.
ScreenFinding require_video_check(const std::vector<VideoCheck>& checks, const VideoPath& path, int days,
                                  const std::string& now_utc);

} // namespace overt
