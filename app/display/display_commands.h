/// The commands for the display, and what the command doctor finds of it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/chosen_command.h"
#include "app/cli/context_choice.h"
#include "app/cli/figures.h"
#include "devices/display_box/display_plus_plus.h"
#include "render/gl/gl_context.h"
#include "render/window/screen_check.h"
#include "render/window/window_context.h"

namespace overt {

void add_display_commands(CLI::App& app, ChosenCommand& chosen);

struct DoctorOptions {
    bool json = false;
    bool window = false; ///< show a dark screen and measure its refreshes
    bool windowed = false;
    std::string monitor;            ///< see MonitorWish; empty: the protocol's
    double seconds = 10.0;          ///< of measuring
    bool photodiode = false;        ///< show a square for a sensor
    std::filesystem::path protocol; ///< whose screen and mode the square is shown in; empty: 8 bits
    std::string sensor;             ///< serial port or "simulated"; empty: no comparison
    ContextChoice context;          ///< of the square; headless: in virtual time
    std::filesystem::path report;   ///< a page (Markdown) to be written of all that is found; empty: none
};
int run_doctor(const DoctorOptions& options);

struct DisplayVerifyOptions {
    std::filesystem::path protocol; ///< its screen and its stimuli, too; empty: a screen of 1920 x 1080
    std::string stimulus;           ///< OBJECT/MATERIAL; empty: all of the protocol's
    std::vector<std::string> modes; ///< as in a protocol; empty: all
    ContextChoice context;          ///< nothing: all there are
    bool json = false;
};
int run_display_verify(const DisplayVerifyOptions& options);
/// What was drawn in memory, read back and decoded; `refused`: why of the rest nothing could be, a sentence
/// each. Throws GraphicsError for what was asked for by name and cannot be drawn.
BenchFigures verify_drawn_output(const DisplayVerifyOptions& options, std::vector<std::string>& refused);

struct DisplayCharacteriseOptions {
    std::filesystem::path protocol; ///< its screen; empty: 1920 x 1080
    std::filesystem::path out = "display.toml";
    std::filesystem::path readings;         ///< from this table instead of a photometer
    bool typed = false;                     ///< somebody types in what an instrument shows
    std::optional<std::uint64_t> simulated; ///< a display and photometer that are not there, by seed
    std::string port;                       ///< of the ColorCAL; empty: the only one there is
    std::string name = "display";
    std::string instrument; ///< in words, for readings that were typed or come from a table
    std::string mode;       ///< as in a protocol; empty: the protocol's, or native-8bit
    std::string model = "table";
    int levels = 17, mixed = 24, repeats = 3;
    std::uint64_t seed = 1; ///< of the order of patches
    double settle_s = 0.5, warm_up_min = 0.0;
    double size_deg = 0.0;  ///< of the patch; 0: the whole screen
    double surround = 0.0;  ///< signal around the patch
    double crosstalk = 0.0; ///< of the simulated display
    ContextChoice context;
    std::string monitor; ///< see MonitorWish; empty: the protocol's
    bool windowed = false;
    bool force = false;
    bool json = false;
};
int run_display_characterise(const DisplayCharacteriseOptions& options);

/// From colours to a characterised display's light, and back. One of the four is given.
struct DisplayStereoOptions {
    std::filesystem::path protocol; ///< with [stereo]
    std::filesystem::path picture;  ///< of the screen, to be written instead of a window; empty: none
    std::string monitor;            ///< see MonitorWish; empty: the protocol's
    bool windowed = false;
};
/// Shows both eyes what tells whether their pictures lie on each other, lets keys move them, and prints the
/// keys of the protocol that say where they are then.
int run_display_stereo(const DisplayStereoOptions& options);

struct DisplayColourOptions {
    std::filesystem::path characterisation;
    std::vector<double> xyz, cones, rgb; ///< three numbers each, or none
    std::filesystem::path spectra;       ///< table of radiances
    std::string observer = "cie1931";    ///< for whom xyz and spectra are matched
    bool json = false;
};
int run_display_colour(const DisplayColourOptions& options);

struct DisplayHardwareOptions {
    std::string port;    ///< of the box; empty: look for it
    std::string monitor; ///< that is connected to the box, see MonitorWish; empty: the only one
    bool json = false;
};
/// Draws known lines, has the display box send back what it received, and keeps what was found
/// (keep_video_check()).
struct CheckedHardware {
    BenchFigures figures; ///< changed bytes, line by line
    BoxIdentity box;
    GlDescription graphics;
    MonitorInfo monitor;
    double video_rate_hz = 0.0; ///< as the box receives it
    bool is_good = false;
    std::string verdict;                 ///< in a sentence
    std::vector<ScreenFinding> findings; ///< what may change the signal
};
/// Throws InputError without a display, DeviceError without a box.
CheckedHardware check_display_hardware(const DisplayHardwareOptions& options);
/// The same, and prints it.
int run_display_hardware_check(const DisplayHardwareOptions& options);

struct DisplayStatusOptions {
    std::string port; ///< empty: all
    bool json = false;
};
int run_display_status(const DisplayStatusOptions& options);

struct DisplayModeOptions {
    std::string mode; ///< bits++, mono++ or color++
    std::string port; ///< empty: look for it
    bool json = false;
};
int run_display_mode(const DisplayModeOptions& options);

} // namespace overt
