#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/own_folders.h"
#include "app/display/display_commands.h"
#include "devices/display_box/display_plus_plus_search.h"
#include "devices/display_box/switch_record.h"
#include "devices/host/clocks.h"
#include "devices/link/serial_port.h"
#include "experiment/base/error.h"

namespace overt {
namespace {

std::optional<std::string> port_from(const std::string& option) {
    return option.empty() ? std::nullopt : std::optional(option);
}

std::string in_words(const AskedPort& asked) {
    if (!asked.box)
        return asked.otherwise;
    return fmt::format("{}, serial number {}, firmware {}, {}", asked.box->product, asked.box->serial_number,
                       asked.box->firmware_date,
                       asked.video_rate_hz > 0.0 ? fmt::format("sees video at {:.2f} Hz", asked.video_rate_hz)
                                                 : std::string("sees no video"));
}

/// What was done about a box that was left switched, or why nothing could be.
struct Recovery {
    std::optional<std::string> done, failed;
};

Recovery switch_back(Clock& clock) {
    DisplayPlusPlusSettings settings;
    settings.record_folder = state_folder();
    try {
        return {recover_display(serial_ports(), serial_port_opener(clock), clock, settings), {}};
    } catch (const Error& error) {
        return {{}, error.what()};
    }
}

std::string mode_in_words(const std::optional<SwitchRecord>& note) {
    if (!note)
        return "a box cannot be asked for its mode; nothing of ours has left one in another than Bits++";
    if (note->kept)
        return fmt::format("{} was switched to {} by `overt display mode`, and stays so", note->serial_number,
                           note->mode);
    return fmt::format("{} was switched to {} by a run that is still at it, or was killed",
                       note->serial_number, note->mode);
}

nlohmann::ordered_json to_json(const std::vector<AskedPort>& ports, const Recovery& recovery,
                               const std::optional<SwitchRecord>& note) {
    const auto or_null = [](const std::optional<std::string>& text) {
        return text ? nlohmann::ordered_json(*text) : nlohmann::ordered_json();
    };
    auto list = nlohmann::ordered_json::array();
    for (const AskedPort& asked : ports) {
        nlohmann::ordered_json item{{"port", asked.port.path}, {"usb", describe(asked.port)}};
        if (asked.box) {
            item["product"] = asked.box->product;
            item["serial_number"] = asked.box->serial_number;
            item["firmware_date"] = asked.box->firmware_date;
            item["video_rate_hz"] = asked.video_rate_hz;
        } else {
            item["otherwise"] = asked.otherwise;
        }
        list.push_back(std::move(item));
    }
    nlohmann::ordered_json json{{"ports", list},
                                {"switched_back", or_null(recovery.done)},
                                {"switching_back_failed", or_null(recovery.failed)},
                                {"note", nullptr}};
    if (note)
        json["note"] = {{"port", note->port},
                        {"serial_number", note->serial_number},
                        {"mode", note->mode},
                        {"kept", note->kept}};
    return json;
}

void print_status(const std::vector<AskedPort>& ports, const Recovery& recovery,
                  const std::optional<SwitchRecord>& note, bool found) {
    for (const AskedPort& asked : ports)
        fmt::print("{}: {}\n", describe(asked.port), in_words(asked));
    if (ports.empty())
        fmt::print("there is no USB serial port (/dev/ttyACM*)\n");
    if (!found)
        fmt::print("no display box was found: see that it is on, its USB cable in and its USB mode CDC, not "
                   "mass storage\n");
    if (recovery.done)
        fmt::print("{}\n", *recovery.done);
    if (recovery.failed)
        fmt::print("{}\n", *recovery.failed);
    fmt::print("mode: {}\n", mode_in_words(note));
}

} // namespace

int run_display_status(const DisplayStatusOptions& options) {
    SteadyClock clock;
    const Recovery recovery = switch_back(clock);
    const std::vector<AskedPort> ports =
        ask_for_display_boxes(serial_ports(), port_from(options.port), serial_port_opener(clock), clock);
    const std::optional<SwitchRecord> note = read_switch_record(state_folder());
    bool found = false;
    for (const AskedPort& asked : ports)
        found = found || asked.box;
    if (options.json)
        fmt::print("{}\n", to_json(ports, recovery, note).dump(2));
    else
        print_status(ports, recovery, note, found);
    return found && !recovery.failed ? 0 : 1;
}

int run_display_mode(const DisplayModeOptions& options) {
    SteadyClock clock;
    DisplayPlusPlusSettings settings;
    settings.record_folder = state_folder();
    const auto box = find_display_plus_plus(serial_ports(), port_from(options.port),
                                            serial_port_opener(clock), clock, settings);
    const BoxMode mode = box_mode_called(options.mode).value(); // the command line has only these
    const ModeSwitch done = box->set_mode(mode);
    if (mode == BoxMode::bits_plus_plus)
        box->restore_desktop(); // a note of this box has no more to say
    else
        box->keep_mode();
    const BoxIdentity& identity = box->identity();
    if (options.json) {
        const nlohmann::ordered_json json{{"port", identity.port},
                                          {"product", identity.product},
                                          {"serial_number", identity.serial_number},
                                          {"mode_told", name_of(mode)},
                                          {"settled_after_s", to_seconds(done.settled_after)},
                                          {"video_rate_hz", done.rate_hz},
                                          {"mode_read_back", nullptr}};
        fmt::print("{}\n", json.dump(2));
        return 0;
    }
    fmt::print("{} ({}) at {} was told {}\n"
               "proved: it answers as before, and measured {:.2f} Hz twice in a row after {:.2f} s\n"
               "not proved: that it shows {}; a box cannot be asked for its mode. A session sees it by the "
               "box's clock, a photometer by the light\n",
               identity.product, identity.serial_number, identity.port, name_of(mode), done.rate_hz,
               to_seconds(done.settled_after), name_of(mode));
    if (mode != BoxMode::bits_plus_plus)
        fmt::print("it stays so until `overt display mode bits++` or the end of a session\n");
    return 0;
}

} // namespace overt
