#include "devices/lsl/lsl_known_apps.h"

#include <algorithm>
#include <array>
#include <span>

namespace overt {
namespace {

struct AppRow {
    std::string_view app;
    std::string_view stream; ///< the beginning of its name; empty: channels alone tell
    std::size_t channels;    ///< how many it has; 0: any number
    StreamUnit unit;
    std::span<const std::string_view> needed;   ///< assignments: without these labels it is another program
    std::span<const std::string_view> optional; ///< some versions have them
    std::span<const double> missing;
};

// github.com/labstreaminglayer/App-EyeLink: gaze as the tracker has it, -32768 where the eye is lost, and 0
// for an eye that is not measured.
constexpr std::string_view eyelink_needed[] = {"left x leftEyeX", "left y leftEyeY", "right x rightEyeX",
                                               "right y rightEyeY"};
constexpr std::string_view eyelink_optional[] = {"left pupil leftPupilArea", "right pupil rightPupilArea"};
constexpr double eyelink_missing[] = {-32768.0, 0.0};

// LSLGazepoint.py of Gazepoint: shares of one, whose unit it calls "percent"; each point has a flag of its
// own.
constexpr std::string_view gazepoint_needed[] = {"left x LPOGX",  "left y LPOGY",  "left valid LPOGV",
                                                 "right x RPOGX", "right y RPOGY", "right valid RPOGV"};
constexpr std::string_view gazepoint_optional[] = {"x BPOGX", "y BPOGY", "valid BPOGV", "left pupil LPMM",
                                                   "right pupil RPMM"};

// github.com/labstreaminglayer/App-EyeTechDS: per cent, which it calls a direction.
constexpr std::string_view eyetech_needed[] = {"left x LeftEye_GazePoint_X",   "left y LeftEye_GazePoint_Y",
                                               "left valid LeftEye_Found",     "right x RightEye_GazePoint_X",
                                               "right y RightEye_GazePoint_Y", "right valid RightEye_Found"};
constexpr std::string_view eyetech_optional[] = {
    "left pupil LeftEye_PupilDiameter", "right pupil RightEye_PupilDiameter", "x WeightedGazePoint_X",
    "y WeightedGazePoint_Y", "valid WeightedGazePoint_Valid"};
constexpr double zero_missing[] = {0.0};

// github.com/labstreaminglayer/App-TobiiStreamEngine: shares of one, without a word on its channels.
constexpr std::string_view stream_engine_needed[] = {"x 1", "y 2"};

constexpr AppRow apps[] = {
    {"App-EyeLink", "", 0, StreamUnit::px, eyelink_needed, eyelink_optional, eyelink_missing},
    {"LSLGazepoint", "", 0, StreamUnit::normalized, gazepoint_needed, gazepoint_optional, {}},
    {"App-EyeTechDS", "", 0, StreamUnit::percent, eyetech_needed, eyetech_optional, zero_missing},
    {"App-TobiiStreamEngine", "TobiiStreamEngine", 2, StreamUnit::normalized, stream_engine_needed, {}, {}},
    // SMI's iViewX: it tells its channels, and sends 0 for an eye that is lost.
    {"App-SMIEyetracker", "iViewX", 0, StreamUnit::as_told, {}, {}, zero_missing},
};

bool has_label(const std::vector<LslChannel>& channels, const LslAssignment& assignment) {
    return std::ranges::find(channels, assignment.label, &LslChannel::label) != channels.end();
}

bool is_from(const AppRow& row, const std::string& stream, const std::vector<LslChannel>& channels) {
    if (!stream.starts_with(row.stream) || (row.channels != 0 && channels.size() != row.channels))
        return false;
    // Where channels are counted, their numbers are all that there is.
    return row.channels != 0 || std::ranges::all_of(row.needed, [&](std::string_view needed) {
               return has_label(channels, parse_lsl_assignment(needed));
           });
}

} // namespace

LslKnownApp with_known_app(LslLayoutSettings settings, const std::string& stream,
                           const std::vector<LslChannel>& channels) {
    const auto row =
        std::ranges::find_if(apps, [&](const AppRow& each) { return is_from(each, stream, channels); });
    if (row == std::end(apps))
        return {"", std::move(settings)};
    if (settings.unit == StreamUnit::as_told)
        settings.unit = row->unit;
    if (settings.missing.empty())
        settings.missing.assign(row->missing.begin(), row->missing.end());
    if (settings.assignments.empty()) {
        for (const std::string_view needed : row->needed)
            settings.assignments.push_back(parse_lsl_assignment(needed));
        for (const std::string_view optional : row->optional)
            if (LslAssignment assignment = parse_lsl_assignment(optional); has_label(channels, assignment))
                settings.assignments.push_back(std::move(assignment));
    }
    return {row->app, std::move(settings)};
}

} // namespace overt
