#include "devices/display_box/display_plus_plus.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "devices/display_box/switch_record.h"
#include "devices/link/text_line.h"
#include "experiment/base/error.h"

namespace overt {
namespace {

/// The first field of a reply.
std::string first_field(const std::string& reply) {
    const auto fields = bits_fields(reply);
    return fields.empty() ? std::string() : std::string(fields.front());
}

std::optional<double> rate_in(const std::string& reply) {
    const auto rate = decimal_number(first_field(reply));
    // The panel does 120 Hz; a number beyond 1000 is a damaged reply.
    return rate && *rate >= 0.0 && *rate < 1000.0 ? rate : std::nullopt;
}

/// Two measurements of one rate, each good to a few hundredths of a hertz.
bool same_rate(double a_hz, double b_hz) { return a_hz > 0.0 && std::abs(a_hz - b_hz) <= 0.005 * a_hz; }

struct BoxModeRow {
    BoxMode mode;
    std::string_view name, output; ///< as people write it, and as a protocol has the output that it reads
    std::array<std::string_view, 2> commands;
};

/// In the order of BoxMode. Both spellings of colour are in use with boxes in the field and neither is
/// answered, so both are said.
constexpr BoxModeRow box_modes[] = {
    {BoxMode::bits_plus_plus, "Bits++", "bits++", {"BitsPlusPlus"}},
    {BoxMode::mono_plus_plus, "Mono++", "mono++", {"monoPlusPlus"}},
    {BoxMode::color_plus_plus, "Color++", "color++", {"colorPlusPlus", "colourPlusPlus"}},
};

const BoxModeRow& row_of(BoxMode mode) { return box_modes[static_cast<std::size_t>(mode)]; }

constexpr SessionDuration between_questions = std::chrono::milliseconds(100);

} // namespace

std::string_view name_of(BoxMode mode) { return row_of(mode).name; }

std::optional<BoxMode> box_mode_called(std::string_view output) {
    for (const BoxModeRow& row : box_modes) {
        if (row.output == output)
            return row.mode;
    }
    return std::nullopt;
}

DisplayPlusPlus::DisplayPlusPlus(std::unique_ptr<ByteTransport> transport, Clock& clock,
                                 DisplayPlusPlusSettings settings)
    : clock_(clock), settings_(std::move(settings)), link_(std::move(transport), clock, settings_.timeouts),
      identity_(ask_identity()) {}

DisplayPlusPlus::~DisplayPlusPlus() {
    try {
        leave();
    } catch (const Error&) {
        // The note on disk stays; recover_display() takes it up at the next start.
    }
}

BoxIdentity DisplayPlusPlus::ask_identity() {
    link_.hush();
    // A program that was killed may have left half a command in the box. "$Stop" then only ended that, and
    // the first question meets a running stream or silence; so everything is said once more.
    auto product = link_.try_ask("ProductType");
    if (!product) {
        link_.hush();
        product = link_.ask("ProductType");
    }
    BoxIdentity identity{link_.port(), first_field(*product), {}, {}};
    if (identity.product.empty())
        throw DeviceError(
            fmt::format("{}: \"$ProductType\" was answered without a name; this is no Display++ or Bits#.",
                        link_.port()));
    identity.serial_number = first_field(link_.ask("SerialNumber"));
    identity.firmware_date = first_field(link_.ask("FirmwareDate"));
    return identity;
}

double DisplayPlusPlus::video_rate_hz() {
    const std::string reply = link_.ask("VideoFrameRate");
    if (const auto rate = rate_in(reply))
        return *rate;
    throw DeviceError(fmt::format(
        "{}: \"$VideoFrameRate\" was answered with \"{}\", which is no rate; switch the box off and on.",
        link_.port(), printable(reply)));
}

void DisplayPlusPlus::tell_mode(BoxMode mode) {
    for (const std::string_view command : row_of(mode).commands) {
        if (!command.empty())
            link_.tell(command);
    }
}

ModeSwitch DisplayPlusPlus::settle(SessionTime since) {
    const SessionTime give_up = since + settings_.settle;
    std::optional<double> last;
    std::string seen = "no reply";
    while (clock_.now() < give_up) {
        const auto reply = link_.try_ask("VideoFrameRate");
        const auto rate = reply ? rate_in(*reply) : std::nullopt;
        if (reply)
            seen = fmt::format("\"{}\"", printable(*reply));
        if (rate && last && same_rate(*rate, *last)) {
            const auto product = link_.try_ask("ProductType");
            if (product && first_field(*product) == identity_.product)
                return {clock_.now() - since, *rate};
        }
        last = rate;
        clock_.wait_until(clock_.now() + between_questions);
    }
    throw DeviceError(fmt::format(
        "{}: within {:.0f} s after a change of mode the box did not measure a steady video rate (last: "
        "{}); see that the video cable is in and the screen is not asleep.",
        link_.port(), to_seconds(settings_.settle), seen));
}

void DisplayPlusPlus::note_away(std::string_view mode) {
    if (!settings_.record_folder.empty() && noted_ != mode)
        write_switch_record(settings_.record_folder,
                            {identity_.port, identity_.serial_number, std::string(mode)});
    noted_ = mode;
    away_from_desktop_ = true;
}

ModeSwitch DisplayPlusPlus::set_mode(BoxMode mode) {
    mode_.reset();
    if (mode != BoxMode::bits_plus_plus)
        note_away(name_of(mode));
    const SessionTime since = clock_.now();
    tell_mode(mode);
    const ModeSwitch result = settle(since);
    mode_ = wanted_ = mode;
    return result;
}

void DisplayPlusPlus::disable_temporal_dithering() { link_.tell("TemporalDithering", "OFF"); }

void DisplayPlusPlus::select_gamma_table(std::string_view file) {
    constexpr std::string_view allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-";
    if (file.empty() || file.size() > 64 || file.find_first_not_of(allowed) != std::string_view::npos)
        throw InputError(fmt::format(
            "\"{}\" is no name of a gamma table on the box: give a file name of letters, digits, dots, "
            "dashes and underscores, such as 13bitLinearLUT.txt.",
            printable(file)));
    link_.tell("enableGammaCorrection", file);
}

std::vector<RgbBytes> DisplayPlusPlus::read_video_line(int line, int pixels) {
    OVERT_EXPECTS(line >= 0 && pixels >= 1 && pixels <= 3840);
    mode_.reset();
    note_away("status screen"); // which is no desktop either
    const std::string reply = link_.ask("GetVideoLine", fmt::format("{}, {}", line, pixels));
    VideoLine read = parse_video_line(reply, pixels);
    if (!read.fault.empty())
        throw DeviceError(
            fmt::format("{}: the reply to \"$GetVideoLine=[{}, {}]\" is damaged: {}; try again, and with a "
                        "shorter or another USB cable if it happens again.",
                        link_.port(), line, pixels, read.fault));
    return std::move(read.pixels);
}

VideoLineReport DisplayPlusPlus::check_video(const std::function<std::vector<DrawnLine>()>& draw,
                                             int repetitions) {
    OVERT_EXPECTS(repetitions >= 1);
    VideoLineReport report;
    for (const DrawnLine& drawn : draw()) {
        std::vector<std::vector<RgbBytes>> readings;
        for (int i = 0; i < repetitions; ++i)
            readings.push_back(read_video_line(drawn.line, static_cast<int>(drawn.pixels.size())));
        compare_video_line(drawn, readings, report);
    }
    if (wanted_)
        set_mode(*wanted_);
    return report;
}

void DisplayPlusPlus::start_status() {
    link_.hush();
    link_.tell("Start");
    streaming_ = true;
}

void DisplayPlusPlus::stop_status() {
    streaming_ = false;
    link_.hush();
}

BoxClockPair DisplayPlusPlus::read_clocks() {
    link_.hush();
    const SessionTime before = clock_.now();
    link_.tell("Start");
    const SessionTime give_up = before + settings_.timeouts.reply;
    std::array<ArrivedStatus, 2> samples;
    for (std::size_t count = 0; count < samples.size();) {
        if (!link_.wait_for_status(give_up))
            throw DeviceError(fmt::format(
                "{}: no two status lines came within {:.1f} s of \"$Start\", but {}; see that the box's "
                "config.xml leaves all status fields on and that no touch stream runs.",
                link_.port(), to_seconds(settings_.timeouts.reply), link_.what_came()));
        count += link_.poll_status(std::span(samples).subspan(count));
    }
    link_.hush();
    if (streaming_)
        link_.tell("Start");
    return {before, samples[1].sample.at, samples[1].read_at};
}

std::vector<BoxClockPair> DisplayPlusPlus::relate_clocks(const std::function<ShownClockReset()>& show_reset) {
    constexpr int readings = 5;
    const SessionTime give_up = clock_.now() + settings_.settle;
    const auto count = [](SessionDuration time) { return static_cast<double>(time.count()) * 1e-9; };
    for (;;) {
        const ShownClockReset shown = show_reset();
        std::vector<BoxClockPair> pairs;
        for (int i = 0; i < readings; ++i)
            pairs.push_back(read_clocks());
        const BoxClockPair& first = pairs.front();
        // As long after the reset as the box says, give or take what the two clocks may differ in rate (200
        // ppm) and a tick.
        const double box_s = to_seconds(first.other);
        const double slack_s = 1e-6 * (1.0 + BoxClockMap::largest_drift_ppm * box_s);
        const double least_s = count(first.before - shown.latest),
                     most_s = count(first.after - shown.earliest);
        if (box_s >= least_s - slack_s && box_s <= most_s + slack_s) {
            pairs.insert(pairs.begin(), {shown.earliest, BoxTime(), shown.latest});
            return pairs;
        }
        if (clock_.now() >= give_up)
            throw DeviceError(fmt::format("{}: the box's clock did not restart with the clock reset line: it "
                                          "shows {:.6f} s where {:.6f} to {:.6f} s "
                                          "have passed; see that the line's first pixel is the screen's "
                                          "leftmost, that its bytes arrive unchanged, and that "
                                          "the box is in Bits++, Mono++ or Color++ mode.",
                                          link_.port(), box_s, least_s, most_s));
    }
}

void DisplayPlusPlus::restore_desktop() {
    tell_mode(BoxMode::bits_plus_plus);
    // An answer shows that the command before it was read. A box may be deaf while it changes its mode.
    const SessionTime give_up = clock_.now() + settings_.settle;
    while (!link_.try_ask("ProductType")) {
        if (clock_.now() >= give_up)
            throw DeviceError(fmt::format("{}: the box did not answer within {:.0f} s after it was switched "
                                          "back to Bits++; switch it off and on.",
                                          link_.port(), to_seconds(settings_.settle)));
    }
    mode_ = BoxMode::bits_plus_plus;
    away_from_desktop_ = false;
    noted_.clear();
    if (!settings_.record_folder.empty())
        remove_switch_record(settings_.record_folder);
}

void DisplayPlusPlus::keep_mode() {
    if (!away_from_desktop_ || !mode_)
        return;
    if (!settings_.record_folder.empty())
        write_switch_record(settings_.record_folder,
                            {identity_.port, identity_.serial_number, std::string(name_of(*mode_)), true});
    away_from_desktop_ = false;
    noted_.clear();
}

void DisplayPlusPlus::leave() {
    if (streaming_)
        stop_status();
    if (away_from_desktop_)
        restore_desktop();
}

} // namespace overt
