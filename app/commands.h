/// The commands of the program: each takes its options and gives the exit code, 0 done, 1 failed. Bad input
/// is thrown as InputError, which main turns into exit code 2.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiment/past_step.h"
#include "experiment/protocol/protocol.h"
#include "render/gl_context.h"

namespace overt {

/// Which context a command draws in; nothing: the best one there is.
using ContextChoice = std::optional<ContextKind>;

struct CheckOptions {
    std::filesystem::path protocol;
    std::string observer; ///< show this observer's order; empty: the first
    bool all_observers = false;
    double answer_time_s = 8.0;
    std::optional<std::uint64_t> seed; ///< of the orders shown, where the protocol fixes none
    bool frames = false;               ///< read every frame, and say what light of it the display cannot show
    bool json = false;
};
int run_check(const CheckOptions& options);

/// Where the observer's form is filled in as far as the command line does not.
enum class AskAt { window, terminal, nobody };

/// When the hidden maps are drawn: before the session, or while their frames are shown.
enum class MapTime { automatic, prepared, live };

struct RunOptions {
    std::filesystem::path protocol;
    std::string observer;
    std::optional<int> session_number;
    std::optional<ResumePolicy> resume; ///< take up an interrupted session: this one, or the last there is
    std::optional<std::uint64_t> seed;
    std::optional<std::uint64_t> simulate_observer;
    std::vector<std::string> observer_fields; ///< ID=VALUE
    AskAt ask_at = AskAt::window;
    std::vector<std::string> operator_keys; ///< of a simulated operator, see read_operator_key()
    ContextChoice context;
    bool virtual_time = false;
    bool windowed = false;
    std::filesystem::path sessions = "sessions";
    std::optional<int> trials; ///< only the first so many
    MapTime maps = MapTime::automatic;
    bool verify_output = false;   ///< decode every page before the first trial
    std::filesystem::path faults; ///< of a display that only keeps time; empty: none
    bool realtime = false;        ///< ask for priority and locked memory
    std::optional<int> processor; ///< the only one for the session's thread
    std::filesystem::path print_session_to;
    std::optional<int> monitor;         ///< from 1
    double refresh_check_s = 5.0;       ///< measure a real screen's refresh for so long; 0: take its word
    std::optional<BakeQuality> quality; ///< that the frames have at least; nothing: the protocol's
};
int run_session(const RunOptions& options);

struct NewOptions {
    std::filesystem::path protocol; ///< to write; never over a file that is there
};
int run_new(const NewOptions& options);

/// Prints the JSON Schema of protocols.
int run_schema();

struct PlayOptions {
    std::filesystem::path protocol;
    std::string stimulus;
    ContextChoice context;
    std::optional<int> frame;
    std::filesystem::path picture;
    double repeat_s = 8.0;
    bool live = false; ///< drawn now, to be turned with the mouse, instead of the frames
};
int run_play(const PlayOptions& options);

struct BakeOptions {
    std::filesystem::path protocol;
    std::optional<BakeQuality>
        quality; ///< nothing: the protocol's, if it is better than a preview, else standard
    std::optional<int> samples;
    std::optional<double> target_error_de;
    std::vector<std::string> only; ///< SCULPTURE/MATERIAL; empty: all that are not given as frames
    std::string frames = "all";    ///< "7", "0-30"
    std::string shard;             ///< "1/4"
    std::filesystem::path out;     ///< folder for numbered frames, or empty
    std::string as = "display";    ///< or xyz, spectra
    bool png16 = false;
    bool force = false;
    std::filesystem::path sheet, strip; ///< pictures to look at, or empty
    bool dry_run = false;
    bool json = false;
    ContextChoice context;
};
int run_bake(const BakeOptions& options);

struct ExportOptions {
    std::vector<std::filesystem::path> sessions;
    std::string format = "tsv"; ///< or csv, asc, bids
    std::filesystem::path out;
    bool overwrite = false;
    std::optional<double> cone_deg; ///< add the probabilities of a gaze cone of this accuracy
    bool fractional_times = false;  ///< of the samples in ASC
    bool with_answers = false;      ///< spoken ones, in BIDS
};
int run_export(const ExportOptions& options);

struct ImportOptions {
    std::filesystem::path file;
    std::filesystem::path into; ///< a session whose gaze it becomes; empty: a session of its own
    std::filesystem::path out;
    std::filesystem::path sessions = "sessions";
    std::string observer; ///< empty: letters and digits of the file's name
    std::optional<int> session_number;
    std::string task = "imported";
    std::vector<double> screen_mm; ///< width and height, or empty
    std::optional<double> distance_mm;
    std::filesystem::path print_session_to;
    bool json = false;
};
int run_import(const ImportOptions& options);

struct VerifyOptions {
    std::vector<std::filesystem::path> sessions;
    bool json = false;
};
int run_verify(const VerifyOptions& options);

struct ShowOptions {
    std::filesystem::path session;
    std::optional<int> trial;
    std::filesystem::path picture;
    std::filesystem::path plot; ///< of the presentation's timing, SVG
    bool order = false;         ///< the order that was planned, made again from protocol and seed
    bool json = false;
};
int run_show(const ShowOptions& options);

struct DoctorOptions {
    bool json = false;
    bool window = false; ///< show a dark screen and measure its refreshes
    bool windowed = false;
    std::optional<int> monitor; ///< from 1
    double seconds = 10.0;      ///< of measuring
    bool photodiode = false;    ///< show a square for a sensor
    std::string sensor;         ///< serial port, «simulated», or nobody compares
    ContextChoice context;      ///< of the square; headless: in virtual time
};
int run_doctor(const DoctorOptions& options);

struct LutOptions {
    std::filesystem::path protocol;
    std::string stimulus;        ///< SCULPTURE or SCULPTURE/MATERIAL: the map is the same for all materials
    std::optional<int> frame;    ///< nothing: all
    std::filesystem::path out;   ///< folder; empty: luts/SCULPTURE, or with `check` nothing is written
    std::string format = "both"; ///< exr, png16 or both
    int scale = 65535;           ///< of 16-bit codes, or 65536
    ContextChoice context;
    bool check = false;
    bool overwrite = false;
    bool json = false;
};
int run_lut(const LutOptions& options);

struct ReconstructOptions {
    std::filesystem::path protocol;
    std::string stimulus;      ///< SCULPTURE or SCULPTURE/MATERIAL
    std::optional<int> frame;  ///< nothing: all
    bool points = false;       ///< a cloud also of one frame
    double spacing = 0.0;      ///< of a cloud's points, in the unit of the mesh; 0: as the pixels have it
    std::filesystem::path out; ///< .ply or .obj
    ContextChoice context;
    bool overwrite = false;
    bool json = false;
};
int run_reconstruct(const ReconstructOptions& options);

struct DisplayVerifyOptions {
    std::filesystem::path protocol; ///< its screen and its stimuli, too; empty: a screen of 1920 x 1080
    std::string stimulus;           ///< SCULPTURE/MATERIAL; empty: all of the protocol's
    std::vector<std::string> modes; ///< as in a protocol; empty: all
    ContextChoice context;          ///< nothing: all there are
    bool json = false;
};
int run_display_verify(const DisplayVerifyOptions& options);

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
    std::optional<int> monitor; ///< from 1
    bool windowed = false;
    bool force = false;
    bool json = false;
};
int run_display_characterise(const DisplayCharacteriseOptions& options);

/// From colours to a characterised display's light, and back. One of the four is given.
struct DisplayColourOptions {
    std::filesystem::path characterisation;
    std::vector<double> xyz, cones, rgb; ///< three numbers each, or none
    std::filesystem::path spectra;       ///< table of radiances
    std::string observer = "cie1931";    ///< for whom xyz and spectra are matched
    bool json = false;
};
int run_display_colour(const DisplayColourOptions& options);

struct DisplayHardwareOptions {
    std::string port;           ///< of the box; empty: look for it
    std::optional<int> monitor; ///< that is connected to the box, from 1; nothing: the primary one
    bool json = false;
};
/// Draws known lines and has the display box send back what it received.
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

struct BenchOptions {
    std::string what;            ///< which benchmark
    std::filesystem::path mesh;  ///< measure on this one instead of the shipped sculptures
    std::string up = "z";        ///< axis of the mesh file that points up
    int size_px = 1024;          ///< width and height of the picture
    std::filesystem::path probe; ///< bake: surroundings other than the overcast sky
    int samples = 16;            ///< bake: of a pixel, of the frames whose time is taken
    int reference_size_px = 128; ///< bake: of the pictures whose errors are measured
    ContextChoice context;
    bool json = false;
};
int run_bench(const BenchOptions& options);

} // namespace overt
